;;;; scripts.lisp -- what a user starts, run as processes of their own.

(in-package :supergrip-test)
(in-suite all)

(defun run-process (command &rest keys &key directory (environment '()) (input nil))
  "Run COMMAND, a list of strings, with ENVIRONMENT, a list of NAME=VALUE or -uNAME.
Returns its status, standard output and standard error."
  (declare (ignorable keys))
  (multiple-value-bind (output errors status)
      (uiop:run-program (append '("env") environment command)
                        :directory directory :input input :output :string :error-output :string
                        :ignore-error-status t)
    (values status output errors)))

(defun script (name)
  (list "sbcl" "--script" (uiop:native-namestring (project-file name))))

(test the-pencil-session-prints-wherever-it-runs
  (let ((session (file-text "t/pencil-session.txt")))
    (uiop:with-temporary-file (:pathname file :keep nil)
      (let ((cold (format nil "XDG_CACHE_HOME=~a-cache" (uiop:native-namestring file))))
        (loop for (name directory . environment) in
              `(("as usual" nil)
                ("from another directory" "/")
                ("with a cold cache" nil ,cold)
                ("without HOME" nil "-u" "HOME")
                ("without a cache that can be made" nil "XDG_CACHE_HOME=/dev/null/cache")
                ("with HOME nowhere" nil "HOME=/nonexistent" "XDG_CACHE_HOME="))
              do (multiple-value-bind (status output errors)
                     (run-process (script "examples/pencil.lisp") :directory directory
                                                                  :environment environment)
                   (is (eql 0 status) name)
                   (is (equal session output) name)
                   (is (equal "" errors) name)))))))

(test every-example-runs-and-ends
  (let ((examples (remove-if (lambda (name)
                               (member name '("pencil" "batch" "figures" "boxes") :test #'string=))
                             (uiop:directory-files (project-file "examples/"))
                             :key #'pathname-name)))
    (is (>= (length examples) 8))
    (dolist (example examples)
      (multiple-value-bind (status output errors)
          (run-process (list "sbcl" "--script" (uiop:native-namestring example)))
        (is (eql 0 status) "~a" example)
        (is (equal "" errors) "~a: ~a" example errors)
        (is (equal "--END--" (first (last (lines-of output)))) "~a" example)))))

(defun copy-project (directory)
  "Copy what a script needs into DIRECTORY, with a mistake in the rules."
  (dolist (name '("supergrip.asd" "rules.lisp" "grasps.lisp" "examples/pencil.lisp"))
    (ensure-directories-exist (merge-pathnames name directory))
    (uiop:copy-file (project-file name) (merge-pathnames name directory)))
  (uiop:run-program (list "cp" "-r" (uiop:native-namestring (project-file "src"))
                          (uiop:native-namestring directory)))
  (with-open-file (out (merge-pathnames "rules.lisp" directory) :direction :output
                                                                :if-exists :supersede)
    (write-string (replace-once (file-text "rules.lisp") "(KEEP BEST)))

;;;; ----" "(KEEP IT)))

;;;; ----")
                  out)))

(test a-script-with-spoiled-rules-says-so-and-ends
  (let ((directory (uiop:ensure-directory-pathname
                    (format nil "~asupergrip-test-~d/" (uiop:native-namestring
                                                        (uiop:temporary-directory))
                            (random 1000000000 (make-random-state t))))))
    (unwind-protect
         (progn
           (copy-project directory)
           (multiple-value-bind (status output errors)
               (run-process (list "sbcl" "--script"
                                  (uiop:native-namestring
                                   (merge-pathnames "examples/pencil.lisp" directory)))
                            :environment (list (format nil "XDG_CACHE_HOME=~acache"
                                                       (uiop:native-namestring directory))))
             (is (eql 65 status))
             (is (equal "" output))
             (is (equal '("rules.lisp:94: RULE GRIP6, action 3: KEEP is (KEEP BEST)")
                        (lines-of errors)))))
      (uiop:delete-directory-tree directory :validate t :if-does-not-exist :ignore))))
