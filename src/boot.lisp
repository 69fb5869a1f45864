;;;; boot.lisp -- makes a script ready: (load "../src/boot.lisp") loads SUPER-GRIP quietly.
;;;;
;;;; Compiled files are kept where ASDF keeps them.  Where that can't be written, or there is no
;;;; home directory, the sources are loaded instead, which takes a few seconds.

(in-package :cl-user)

(require :asdf)

;;; Naming the one directory keeps ASDF from searching, and from upgrading itself.
(asdf:initialize-source-registry
 `(:source-registry
   (:directory ,(merge-pathnames "../" (make-pathname :name nil :type nil :defaults *load-truename*)))
   :ignore-inherited-configuration))

(let* ((*compile-verbose* nil) (*compile-print* nil) (*load-verbose* nil)
       (output (make-broadcast-stream)))
  (flet ((quietly (operation)
           (let ((*standard-output* output) (*error-output* output) (*trace-output* output))
             (handler-bind ((warning #'muffle-warning))
               (asdf:operate operation "supergrip")))))
    (handler-case (quietly 'asdf:load-op)
      (error () (quietly 'asdf:load-source-op)))))
