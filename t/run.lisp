;;;; run.lisp -- sbcl --script t/run.lisp [SYSTEM] [--list | --shuffle [SEED]] [NAME...]
;;;;
;;;; Runs the tests of the test system SYSTEM, by default supergrip/test: all, or those that NAMEs
;;;; name, each a test or a suite; a suite has the name of its file.  --shuffle runs them in a
;;;; random order, which SEED chooses; it is printed.  --list prints their names and runs nothing.

(load (merge-pathnames "registry.lisp" *load-truename*))

(defun seed-after (option words)
  "Return the number after OPTION in WORDS, or one of our own; NIL without OPTION."
  (let ((place (member option words :test #'string=)))
    (when place
      (or (parse-integer (or (second place) "") :junk-allowed t)
          (random 1000000 (make-random-state t))))))

(defun run (words)
  "Do what WORDS, those of the command line, ask for."
  (let ((system (or (find "supergrip/" words :test #'search) "supergrip/test"))
        (seed (seed-after "--shuffle" words))
        (names (remove-if (lambda (word)
                            (or (search "supergrip/" word) (search "--" word)
                                (every #'digit-char-p word)))
                          words)))
    (let ((*standard-output* (make-broadcast-stream)))
      ;; cl-who's own system file has a second system whose name ASDF does not like.
      (handler-bind ((asdf/parse-defsystem:bad-system-name #'muffle-warning))
        (asdf:load-system system)))
    (if (member "--list" words :test #'string=)
        (uiop:symbol-call :supergrip-test :print-tests names)
        (uiop:symbol-call :supergrip-test :run-tests :names names :seed seed))))

(handler-case (run (rest sb-ext:*posix-argv*))
  (error (condition)
    (format *error-output* "~&~a~%" condition)
    (finish-output *error-output*)
    (sb-ext:exit :code 1)))
