;;;; boot.lisp -- makes a script ready to draw: (load "../src/draw/boot.lisp") loads SUPER-GRIP and
;;;; its pictures quietly.
;;;;
;;;; The pictures need cl-who, Debian's package of this name.

(in-package :cl-user)

(load (merge-pathnames "../boot.lisp" *load-truename*))

(let ((cl-who (probe-file "/usr/share/common-lisp/source/cl-who/")))
  (unless cl-who
    (format *error-output* "The pictures need cl-who: apt-get install cl-who~%")
    (finish-output *error-output*)
    (sb-ext:exit :code 69 :abort t))
  (asdf:initialize-source-registry
   `(:source-registry
     (:directory ,(merge-pathnames "../../" (make-pathname :name nil :type nil
                                                           :defaults *load-truename*)))
     (:directory ,cl-who)
     :ignore-inherited-configuration)))

(let ((*compile-verbose* nil) (*compile-print* nil) (*load-verbose* nil)
      (output (make-broadcast-stream)))
  (flet ((quietly (operation)
           (let ((*standard-output* output) (*error-output* output) (*trace-output* output))
             (handler-bind ((warning #'muffle-warning))
               (asdf:operate operation "supergrip/draw")))))
    (handler-case (quietly 'asdf:load-op)
      (error () (quietly 'asdf:load-source-op)))))
