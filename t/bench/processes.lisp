;;;; processes.lisp -- SUPER-GRIP as a user runs it: the script, the executable, and batches.

(in-package :supergrip-bench)

(defmacro with-executable ((name) &body body)
  "Run BODY with NAME bound to the name of an executable made for it, in a directory of its own."
  (let ((directory (gensym)))
    `(let* ((,directory (uiop:ensure-pathname
                         (format nil "~asupergrip-bench-~36r/"
                                 (uiop:native-namestring (uiop:temporary-directory))
                                 (random (expt 36 8) (make-random-state t)))
                         :ensure-directories-exist t))
            (,name (uiop:native-namestring (merge-pathnames "supergrip" ,directory))))
       (unwind-protect
            (progn (uiop:run-program (list "sbcl" "--script"
                                           (uiop:native-namestring (project-file "src/build.lisp"))
                                           ,name))
                   ,@body)
         (uiop:delete-directory-tree ,directory :validate t)))))

(defun process-seconds (times input &rest command)
  "Return how many seconds a run of COMMAND, strings, on the file INPUT takes, from TIMES runs.  A
shell starts them: it does so faster than this process."
  (let ((script "times=$1 input=$2; shift 2
while [ $times -gt 0 ]; do \"$@\" < \"$input\" > /dev/null || exit; times=$((times - 1)); done"))
    (/ (seconds-of (lambda ()
                     (uiop:run-program (list* "sh" "-c" script "sh" (princ-to-string times) input
                                              command)))
                   1)
       times)))

(defun box-text (box)
  "Return the description of BOX as one line."
  (format nil "((size~{ ~f~}) (weight ~f) (u ~f) (v ~f) (constrained~{ ~a~}) (force-needed ~
               (~{~f~^ ~})) (velocity-needed (~{~f~^ ~})))"
          (supergrip:box-size box) (supergrip:box-weight box) (supergrip:box-friction box)
          (supergrip:box-soft-friction box) (supergrip:box-constrained box)
          (supergrip:box-force-needed box) (supergrip:box-velocity-needed box)))

(defun box-json (box)
  "Return the description of BOX as one line of JSON."
  (format nil "{\"size\": [~{~f~^, ~}], \"weight\": ~f, \"u\": ~f, \"v\": ~f, \"constrained\": ~
               [~{\"~a\"~^, ~}], \"force_needed\": [~{~f~^, ~}], \"velocity_needed\": ~
               [~{~f~^, ~}]}"
          (supergrip:box-size box) (supergrip:box-weight box) (supergrip:box-friction box)
          (supergrip:box-soft-friction box) (supergrip:box-constrained box)
          (supergrip:box-force-needed box) (supergrip:box-velocity-needed box)))

(defun start-up-figures (executable)
  "Return figures of the pencil as a process, everything compiled: the script, and EXECUTABLE."
  (uiop:with-temporary-file (:stream out :pathname pencil)
    (write-string (box-text *box*) out)
    :close-stream
    (let* ((pencil (uiop:native-namestring pencil))
           (script (uiop:native-namestring (project-file "examples/pencil.lisp")))
           (seconds (loop repeat *batches*
                          collect (list (process-seconds 1 "/dev/null" "sbcl" "--script" script)
                                        (process-seconds 20 pencil executable)))))
      (list (figure-of "`sbcl --script examples/pencil.lisp`" (mapcar #'first seconds))
            (figure-of "the pencil by the executable" (mapcar #'second seconds))))))

;;; Batches

(defun batch-figure (name executable boxes times text)
  "Return the figure per box of a batch of BOXES, TIMES over, each written by the function TEXT, by
EXECUTABLE; records look as boxes do."
  (uiop:with-temporary-file (:stream out :pathname input)
    (let ((lines (mapcar text boxes)))
      (loop repeat times do (format out "~{~a~%~}" lines)))
    :close-stream
    (let ((input (uiop:native-namestring input))
          (count (* times (length boxes))))
      (figure-of name (loop repeat *batches*
                            collect (/ (process-seconds 1 input executable) count))))))

(defun batch-figures (executable times)
  "Return figures per box of batches of 1000 random boxes, TIMES over, in both notations."
  (let ((boxes (random-boxes 1000 1989)))
    (list (batch-figure "a box in a batch, as s-expressions" executable boxes times #'box-text)
          (batch-figure "a box in a batch, as JSON" executable boxes times #'box-json))))
