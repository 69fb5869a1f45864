;;;; run.lisp -- sbcl --script t/run.lisp [SYSTEM] runs all tests, or those of one test system.

(require :asdf)

;; Debian's FiveAM and what it needs, and cl-who for the pictures, each directory named: a search
;; could find another ASDF.
(asdf:initialize-source-registry
 `(:source-registry
   (:directory ,(merge-pathnames "../" (make-pathname :name nil :type nil :defaults *load-truename*)))
   ,@(loop for name in '("fiveam" "alexandria" "asdf-flv" "trivial-backtrace" "cl-who")
           collect `(:directory ,(format nil "/usr/share/common-lisp/source/~a/" name)))
   :inherit-configuration))

(handler-case
    (progn
      (let ((*standard-output* (make-broadcast-stream)))
        ;; cl-who's own system file has a second system whose name ASDF does not like.
        (handler-bind ((asdf/parse-defsystem:bad-system-name #'muffle-warning))
          (asdf:load-system (or (second sb-ext:*posix-argv*) "supergrip/test"))))
      (uiop:symbol-call :supergrip-test :run-tests))
  (error (condition)
    (format *error-output* "~&~a~%" condition)
    (sb-ext:exit :code 1 :abort t)))
