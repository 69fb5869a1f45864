;;;; package.lisp -- the data layer: names, problems and the reader of all data files.

(defpackage :supergrip-data
  (:use :cl)
  (:lock t)
  (:documentation "Reads rule, grasp and box files without the Lisp reader, and reports what is
wrong in them.")
  (:export
   ;; problems
   #:problem #:make-problem #:problem-severity #:problem-file #:problem-line #:problem-column
   #:problem-subject #:problem-place #:problem-text
   #:complain #:with-problems #:*file* #:*lines* #:*comments* #:*subject* #:*place* #:*form*
   #:*places* #:form-comment #:form-place-text
   #:errors-in #:warnings-in #:refused-p #:suggestion
   ;; SBCL itself
   #:backquote-p #:take-from #:give-to #:keep-in #:double-bits #:with-plain-floats
   #:without-float-traps #:seeded-state
   ;; numbers
   #:exact-decimal #:bounded-rational #:+largest+ #:finite-p
   #:system-failure #:system-failure-errno #:read-failure #:write-failure #:+is-directory+
   #:native-path #:native-name #:directory-p #:open-descriptor #:file-text #:room-for
   ;; text
   #:plainly #:plain-text #:define-printing
   ;; conditions
   #:supergrip-error #:argument-error #:refuse-argument #:input-error #:input-error-problems
   #:input-error-consequence #:syntax-error #:box-error #:knowledge-error
   #:knowledge-error-consequence #:knowledge-warning #:knowledge-warning-problems #:retry
   ;; names and forms
   #:with-row #:name= #:name-in #:namep #:part-p #:canonical #:canonical-name
   #:form-text #:as-double #:cut-text #:visible-text #:code-text
   ;; reader
   #:source #:string-source #:source-line #:source-column
   #:read-datum #:end-of-data #:read-all
   #:peek #:source-buffer #:source-position #:source-end #:utf-16-p
   #:skip-to-record #:make-source #:part-place #:+mark+
   #:*depth-limit* #:*record-limit* #:*number-limit* #:*name-limit*
   ;; the tools of readers
   #:refuse-syntax #:next #:fail #:fail-at #:deeper #:start-record #:end-record #:note-place
   #:skip-mark #:push-token #:take-while #:token-number #:digits-end #:character-description
   #:source-token #:source-depth #:source-inside))
