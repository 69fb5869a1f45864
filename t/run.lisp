;;;; run.lisp -- sbcl --script t/run.lisp [SYSTEM] runs all tests, or those of one test system.

(load (merge-pathnames "registry.lisp" *load-truename*))

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
