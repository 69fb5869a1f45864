;;;; boot.lisp -- makes a script ready: (load "../src/boot.lisp") loads SUPER-GRIP quietly.
;;;;
;;;; Compiled files are kept where ASDF keeps them.  Where that can't be written, or there is no
;;;; home directory, the sources are loaded instead, which takes a few seconds.

(require :asdf)

(defpackage :supergrip-boot
  (:use :cl)
  (:export #:load-quietly))

(in-package :supergrip-boot)

(defparameter *root*
  (merge-pathnames "../" (make-pathname :name nil :type nil :defaults *load-truename*))
  "The directory of SUPER-GRIP.")

;;; At the REPL, where this file was loaded, an example loads it again.
(unless (fboundp 'load-quietly)

  (defun operate-quietly (operation system)
    "Do OPERATION on SYSTEM without a word."
    (let* ((*compile-verbose* nil) (*compile-print* nil) (*load-verbose* nil)
           (output (make-broadcast-stream))
           (*standard-output* output) (*error-output* output) (*trace-output* output))
      (handler-bind ((warning #'muffle-warning))
        (asdf:operate operation system))))

  (defun knowledge-error-p (condition)
    (let ((package (find-package :supergrip-data)))
      (and package (typep condition (find-symbol "KNOWLEDGE-ERROR" package)))))

  (defun tell (condition)
    "Print CONDITION; a script ends here, at the REPL there are the restarts."
    (format sb-sys:*stderr* "~a~%" condition)
    (finish-output sb-sys:*stderr*)
    (when sb-ext:*invoke-debugger-hook*
      (sb-ext:exit :code 65 :abort t)))

  (defun load-quietly (system &rest directories)
    "Load SYSTEM, which is in SUPER-GRIP's directory; what it needs is in DIRECTORIES."
    ;; Naming all directories keeps ASDF from searching, and from upgrading itself.
    (asdf:initialize-source-registry
     `(:source-registry ,@(loop for directory in (cons *root* directories)
                                collect `(:directory ,directory))
                        :ignore-inherited-configuration))
    (handler-bind ((error (lambda (condition)
                            (if (knowledge-error-p condition)
                                (tell condition)
                                (return-from load-quietly
                                  (operate-quietly 'asdf:load-source-op system))))))
      (operate-quietly 'asdf:load-op system))))

(load-quietly "supergrip")

(in-package :cl-user)
