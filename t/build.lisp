;;;; build.lisp -- sbcl --script t/build.lisp builds everything; any warning is a failure.
;;;;
;;;; Only what is compiled now can warn: give it an empty cache, by XDG_CACHE_HOME.

(load (merge-pathnames "registry.lisp" *load-truename*))

(defvar *warnings* '())

;;; Without the libraries nothing can be said of warnings.
(dolist (library '("fiveam" "cl-who"))
  (handler-bind ((asdf/parse-defsystem:bad-system-name #'muffle-warning))
    (unless (asdf:find-system library nil)
      (format *error-output* "t/build.lisp needs ~a: apt-get install ~a~%" library
              (if (string= library "fiveam") "cl-fiveam" library))
      (finish-output *error-output*)
      (sb-ext:exit :code 69 :abort t))))

(let ((*standard-output* (make-broadcast-stream)))
  (asdf:load-system "fiveam")
  (handler-bind ((asdf/parse-defsystem:bad-system-name #'muffle-warning))
    (asdf:load-system "cl-who"))
  ;; SBCL notes that loading a file defines again the macros that compiling it has defined.
  (handler-bind ((sb-kernel:redefinition-with-defmacro #'muffle-warning)
                 (warning (lambda (warning) (push (princ-to-string warning) *warnings*))))
    (asdf:load-system "supergrip/test" :force '("supergrip" "supergrip/chainer"
                                                "supergrip/statics" "supergrip/chainer-test"
                                                "supergrip/oracle" "supergrip/test-tools"
                                                "supergrip/test"))
    (asdf:load-system "supergrip/bench" :force '("supergrip/bench"))
    (asdf:load-system "supergrip/draw-test" :force '("supergrip/draw" "supergrip/draw-test"))))

(format t "~{~a~%~}~d warning~:p~%" (reverse *warnings*) (length *warnings*))
(finish-output)
(sb-ext:exit :code (if *warnings* 1 0) :abort t)
