;;;; boot.lisp -- makes a script ready: (load "../src/boot.lisp") loads SUPER-GRIP quietly.
;;;;
;;;; Compiled files are kept where ASDF keeps them.  Where that can't be written, or there is no
;;;; home directory, the sources are loaded instead, which takes a few seconds.

(in-package :cl-user)

(require :asdf)

;;; Naming the one directory keeps ASDF from searching, and from upgrading itself.
(asdf:initialize-source-registry
 `(:source-registry
   (:directory ,(merge-pathnames "../" (make-pathname :name nil :type nil
                                                      :defaults *load-truename*)))
   :ignore-inherited-configuration))

(flet ((quietly (operation)
         (let* ((*compile-verbose* nil) (*compile-print* nil) (*load-verbose* nil)
                (output (make-broadcast-stream))
                (*standard-output* output) (*error-output* output) (*trace-output* output))
           (handler-bind ((warning #'muffle-warning))
             (asdf:operate operation "supergrip"))))
       (knowledge-error-p (condition)
         (let ((package (find-package :supergrip-data)))
           (and package (typep condition (find-symbol "KNOWLEDGE-ERROR" package)))))
       (tell (condition)
         (format sb-sys:*stderr* "~a~%" condition)
         (finish-output sb-sys:*stderr*)
         ;; A script ends; at the REPL there are the restarts.
         (when sb-ext:*invoke-debugger-hook*
           (sb-ext:exit :code 65 :abort t))))
  (block ready
    (handler-bind ((error (lambda (condition)
                            (if (knowledge-error-p condition)
                                (tell condition)
                                (return-from ready (quietly 'asdf:load-source-op))))))
      (quietly 'asdf:load-op))))
