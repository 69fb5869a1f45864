;;;; scripts.lisp -- what a user starts, run as processes of their own.

(in-package :supergrip-test)
(define-suite scripts "What a user starts, run as processes of their own.")

(defun call-with-cold-cache (function)
  "Call FUNCTION with the name of a directory that is not there; remove what it has made of it."
  (uiop:with-temporary-file (:pathname file :keep nil)
    (let ((cache (uiop:ensure-directory-pathname
                  (format nil "~a-cache" (uiop:native-namestring file)))))
      (unwind-protect (funcall function (uiop:native-namestring cache))
        (uiop:delete-directory-tree cache :validate t :if-does-not-exist :ignore)))))

(defun check-session (name directory environment)
  "Check that the session NAME of the pencil, run in DIRECTORY with ENVIRONMENT, is the paper's."
  (multiple-value-bind (status output errors)
      (run-process (script "examples/pencil.lisp") :directory directory :environment environment)
    (is (eql 0 status) name)
    (is (equal (file-text "t/pencil-session.txt") output) name)
    (is (equal "" errors) name)))

(test the-pencil-session-prints-wherever-it-runs
  (call-with-cold-cache
   (lambda (cold)
     (loop for (name directory . environment) in
           `(("as usual" nil)
             ("from another directory" "/")
             ("with a cold cache" nil ,(format nil "XDG_CACHE_HOME=~a" cold))
             ("without HOME" nil "-u" "HOME")
             ("without a cache that can be made" nil "XDG_CACHE_HOME=/dev/null/cache")
             ("with HOME nowhere" nil "HOME=/nonexistent" "XDG_CACHE_HOME="))
           do (check-session name directory environment)))))

(test compiling-shows-on-a-terminal-how-far-it-is
  ;; However fast the machine: it began three seconds ago.
  (let ((command (format nil "sbcl --noinform --no-userinit --non-interactive --load '~a' --eval ~
                              '~a'"
                         (uiop:native-namestring (project-file "src/boot.lisp"))
                         "(funcall (supergrip-boot::progress nil (- (get-internal-real-time) (* 3
                          internal-time-units-per-second))))"))
        (shown "SUPER-GRIP is compiled, which is done once: 1 file"))
    (multiple-value-bind (status output errors) (run-process (list "sh" "-c" command))
      (is (equal '(0 "" "") (list status output errors))))
    (if (zerop (run-process '("sh" "-c" "script -qec true /dev/null < /dev/null")))
        (is (search shown (nth-value 1 (run-process (list "script" "-qec" command "/dev/null")))))
        (skip "no terminal"))))

(test every-example-runs-and-ends
  (let ((examples (remove-if (lambda (name)
                               (member name '("pencil" "batch" "figures" "boxes") :test #'string=))
                             (uiop:directory-files (project-file "examples/") "*.lisp")
                             :key #'pathname-name)))
    (is (>= (length examples) 8))
    (dolist (example examples)
      (multiple-value-bind (status output errors)
          (run-process (list "sbcl" "--script" (uiop:native-namestring example)))
        (is (eql 0 status) "~a" example)
        (is (equal "" errors) "~a: ~a" example errors)
        (is (equal "--END--" (first (last (lines-of output)))) "~a" example)))))

;;; A copy of the project, with a cache of its own

(defun spoiled-rules ()
  (replace-once (file-text "rules.lisp") "(KEEP BEST)))

;;;; ----" "(KEEP IT)))

;;;; ----"))

(defun write-file (text name)
  (ensure-directories-exist name)
  (with-open-file (out name :direction :output :if-exists :supersede)
    (write-string text out)))

(defun copy-project (directory)
  "Copy what a script needs into DIRECTORY."
  (dolist (name '("supergrip.asd" "rules.lisp" "grasps.lisp" "examples/pencil.lisp"))
    (write-file (file-text name) (merge-pathnames name directory)))
  (uiop:run-program (list "cp" "-r" (uiop:native-namestring (project-file "src"))
                          (uiop:native-namestring directory))))

(defun call-with-project (function)
  "Call FUNCTION with the directory of a copy of the project, and a function that runs a command, a
list of strings, there, with a cache of its own."
  (let ((directory (uiop:ensure-directory-pathname
                    (format nil "~asupergrip-test-~d/" (uiop:native-namestring
                                                        (uiop:temporary-directory))
                            (random 1000000000 (make-random-state t))))))
    (unwind-protect
         (progn
           (copy-project directory)
           (funcall function directory
                    (lambda (&rest command)
                      (run-process command
                                   :directory directory
                                   :environment (list (format nil "XDG_CACHE_HOME=~acache"
                                                              (uiop:native-namestring
                                                               directory)))))))
      (uiop:delete-directory-tree directory :validate t :if-does-not-exist :ignore))))

(defparameter *session-of-a-user* "
(require :asdf)
(asdf:initialize-source-registry
 `(:source-registry (:directory ,(merge-pathnames \"mine/\" *default-pathname-defaults*))
                    :ignore-inherited-configuration))
(setf sb-ext:*invoke-debugger-hook*
      (lambda (condition hook)
        (declare (ignore hook))
        (format t \"~a~%\" (type-of condition))
        (invoke-restart (find-restart 'continue condition)))
      *read-default-float-format* 'double-float
      *print-case* :downcase)
(let ((*default-pathname-defaults* (merge-pathnames \"src/\"))
      (functions asdf:*system-definition-search-functions*))
  (load \"boot.lisp\")
  (load \"boot.lisp\")
  (format t \"~a~%\" (list (package-name *package*) *read-default-float-format*
                           (eq functions asdf:*system-definition-search-functions*)
                           (not (null (asdf:find-system \"mine\" nil)))
                           (not (null (asdf:find-system \"supergrip/draw\" nil))))))
(format t \"~d~%\" (length (supergrip:knowledge-rules supergrip:*knowledge*)))
(sb-ext:exit)
" "A session with a debugger and settings of its own, as one under SLIME.")

(defun damage (name directory length)
  "Cut the compiled file NAME in the cache of DIRECTORY after LENGTH octets; it looks as old as
before."
  (let ((file (find name (directory (merge-pathnames "cache/**/*.fasl" directory))
                    :key #'pathname-name :test #'string=)))
    (uiop:run-program
     (list "sh" "-c" "touch -r $1 $1.time; truncate -s $0 $1; touch -r $1.time $1"
           (princ-to-string length) (uiop:native-namestring file)))
    file))

(test loading-leaves-the-session-and-mends-the-cache
  (call-with-project
   (lambda (directory run)
     (flet ((pencil () (funcall run "sbcl" "--script" "examples/pencil.lisp")))
       (write-file (spoiled-rules) (merge-pathnames "rules.lisp" directory))
       (multiple-value-bind (status output errors) (pencil)
         (is (eql 65 status) "a script says what is wrong with the rules, and ends")
         (is (equal "" output))
         (is (equal '("rules.lisp:99: RULE GRIP6, action 3: KEEP is (KEEP BEST)")
                    (lines-of errors))))
       (write-file *session-of-a-user* (merge-pathnames "session.lisp" directory))
       (write-file "(defsystem \"mine\")" (merge-pathnames "mine/mine.asd" directory))
       (is (equal '("KNOWLEDGE-ERROR" "(COMMON-LISP-USER double-float t t t)" "14")
                  (lines-of (nth-value 1 (funcall run "sbcl" "--noinform" "--no-userinit"
                                                  "--load" "session.lisp"))))
           "a session has restarts, and stays as it was")
       (write-file (file-text "rules.lisp") (merge-pathnames "rules.lisp" directory))
       (let ((damaged (list (damage "error-reports" directory 0) (damage "trace" directory 3000)
                            (damage "plan" directory 20))))
         (multiple-value-bind (status output errors) (pencil)
           (is (eql 0 status))
           (is (equal (file-text "t/pencil-session.txt") output))
           (dolist (file damaged)
             (is (search (uiop:native-namestring file) errors) "~a is told of" file))))
       (multiple-value-bind (status output errors) (pencil)
         (is (eql 0 status))
         (is (equal (file-text "t/pencil-session.txt") output))
         (is (equal "" errors) "the cache is mended"))))))

(test a-library-that-is-missing-gives-69
  (let ((environment '("CL_SOURCE_REGISTRY=(:source-registry :ignore-inherited-configuration)")))
    (dolist (command (list (script "examples/figures.lisp")
                           (append (script "examples/batch.lisp") '("--report" "/tmp/none/"))))
      (multiple-value-bind (status output errors)
          (run-process command :environment environment)
        (is (eql 69 status))
        (is (equal "" output))
        (is (search "cl-who is missing" errors))
        (is (= 1 (length (lines-of errors))))))))

(test another-lisp-is-told-that-sbcl-is-needed
  ;; What another Lisp reads of these files first, its features being others.
  (dolist (name '("supergrip.asd" "src/boot.lisp"))
    (with-open-file (in (project-file name))
      (let* ((*features* (remove :sbcl *features*))
             (*package* (find-package :asdf-user))
             (form (read in)))
        (is (search "SUPER-GRIP needs SBCL"
                    (handler-case (progn (eval form) "")
                      (error (condition) (princ-to-string condition)))))))))
