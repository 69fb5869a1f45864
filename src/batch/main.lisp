;;;; main.lisp -- the command: files, progress, checks, reports, exit statuses.

(in-package :supergrip)

;;; Standard error

(defun follow-progress (batch)
  "Return a function, to be called after each record of BATCH, that shows on the terminal how far a
run of more than two seconds has come."
  (let* ((start (get-internal-real-time))
         (due (+ start (* 2 internal-time-units-per-second)))
         (output (make-output 2)))
    (lambda ()
      (when (zerop (mod (batch-done batch) 64))
        (let ((now (get-internal-real-time)))
          (when (>= now due)
            (setf due (+ now (floor internal-time-units-per-second 2)))
            (show-progress batch (/ (- now start) internal-time-units-per-second) output)))))))

(defun show-progress (batch seconds output)
  (handler-case
      (progn
        (put-text output (format nil "~c~d box~:*~[es~;~:;es~], ~d a second, ~d bad~c[K" #\Return
                                 (batch-done batch) (floor (batch-done batch) seconds)
                                 (batch-bad batch) (code-char 27)))
        (flush-output output))
    (system-failure () nil)))

;;; Knowledge

(defun knowledge-options (options)
  "Return those of OPTIONS, a plist, that are arguments of LOAD-KNOWLEDGE."
  (loop for key in '(:hand :rules :grasps :gripper)
        for file = (getf options key)
        when file append (list key file)))

(defun knowledge-of (options)
  "Return the knowledge of the files that OPTIONS, a plist, name, or what is built in if they name
none.  Signals a KNOWLEDGE-ERROR."
  (let ((files (knowledge-options options)))
    (if files (apply #'load-knowledge files) *knowledge*)))

(defun readable-p (file)
  "Return true if FILE, a string or NIL, can be read; tell why, if it can't."
  (handler-case (progn (when file (check-readable file))
                       t)
    (system-failure (condition)
      (tell "supergrip: ~a: ~a" file condition)
      nil)))

(defun try-knowledge (options)
  "Return the knowledge of the files that OPTIONS, a plist, name; or NIL and the exit status, after
a report."
  (if (destructuring-bind (&key hand rules grasps (gripper (and hand (hand-gripper hand)))
                           &allow-other-keys)
          options
        (every #'readable-p (list rules grasps gripper)))
      (handler-case (handler-bind ((knowledge-warning (lambda (condition)
                                                        (tell "~a" condition)
                                                        (muffle-warning condition))))
                      (knowledge-of options))
        (knowledge-error (condition)
          (tell "~a" condition)
          (values nil 65)))
      (values nil 66)))

(defun check (knowledge)
  "Report that KNOWLEDGE has no mistakes, and of how many things was warned."
  (let ((warnings (length (knowledge-warnings knowledge)))
        (gripper (knowledge-gripper-file knowledge)))
    (tell "~d rule~:p and ~d grasp~:p~@[, the gripper of ~a~]~@[ (~a)~], no mistakes~[~:;, ~:*~d ~
           warning~:p~]"
          (length (knowledge-rules knowledge)) (length (knowledge-grasps knowledge))
          (and gripper (data-file-name gripper)) (and gripper (knowledge-model knowledge))
          warnings))
  0)

(defun check-and-verify (knowledge gamma)
  "Report on KNOWLEDGE as CHECK does, and write what is proved and found about it to standard
output.  Return the exit status: what is found is no mistake."
  (check knowledge)
  (print-and-end (with-output-to-string (out)
                   (verify-knowledge knowledge :gamma gamma :stream out))))

;;; The run

(defun run-file (batch file)
  "Answer the boxes of FILE, a string, - for standard input.  Return NIL, or 66 after a report."
  (handler-case
      (let ((descriptor (if (string= file "-") 0 (open-descriptor file))))
        (when (terminal-p descriptor)
          (tell "supergrip: reading boxes from the terminal; Ctrl-D ends them, --help tells more"))
        (unwind-protect (let ((*when-asked* :note))
                          (run-batch batch descriptor))
          (unless (zerop descriptor)
            (close-descriptor descriptor)))
        nil)
    (read-failure (condition)
      (tell "supergrip: ~a: ~a" file condition)
      66)))

(defun run-files (batch files &optional directory)
  "Answer the boxes of FILES, by default of standard input, write the report into DIRECTORY if that
is given, and return the exit status."
  (let ((statuses '()))
    (handler-case
        (loop for file in (or files '("-"))
              until *signal*
              do (push (unless-signalled (run-file batch file)) statuses))
      (write-failure (condition)
        (unless (closed-pipe-p condition)
          (tell "supergrip: standard output: ~a; at most ~d record~:p ~:*~[are~;is~:;are~] complete"
                condition
                (batch-done batch))
          (push 74 statuses))))
    (when directory
      (push (unless-signalled (write-report batch directory)) statuses))
    (when (batch-lost batch) (push 74 statuses))
    (when (plusp (batch-bad batch)) (push 65 statuses))
    (when (batch-broken batch) (push 70 statuses))
    (report-end batch)
    (cond ((find 70 statuses))
          ((find 74 statuses))
          (*signal* (signal-status *signal*))
          ((find 66 statuses))
          ((find 65 statuses))
          (t 0))))

(defun report-index ()
  "Return the function that writes the pages and the index of a list of plans into a directory, a
string; NIL if the pictures are not loaded."
  (let ((name (uiop:find-symbol* "REPORT-INDEX" "SUPERGRIP-DRAW" nil)))
    (and name (fboundp name) (fdefinition name))))

(define-condition no-pictures (error)
  ((reason :initarg :reason :reader no-pictures-reason))
  (:report (lambda (condition stream)
             (format stream "--report needs the pictures, which can't be loaded: ~a"
                     (no-pictures-reason condition))))
  (:documentation "The pictures are not in this program, and can't be loaded either."))

(defun reporter ()
  "As REPORT-INDEX, loading the pictures first if they are not there.  Signals NO-PICTURES."
  (cond ((report-index))
        (*kept-files*
         (error 'no-pictures
                :reason "it was built without cl-who; install cl-who, and build it again"))
        (t (handler-case (let ((*error-output* (make-broadcast-stream))) ; SBCL's word on the file
                           (load (merge-pathnames "src/draw/boot.lisp" *home*)))
             (error (condition) (error 'no-pictures :reason condition)))
           (report-index))))

(defun write-report (batch directory)
  "Write the report of what BATCH has kept into DIRECTORY, a string.  Return NIL, or 74 after a
report of what could not be drawn or written."
  (handler-case
      (let ((lost (nth-value 1 (funcall (reporter) (reverse (batch-plans batch))
                                        (native-path directory :directory t)))))
        (when (and lost (plusp lost))
          (tell "supergrip: ~a: ~d page~:p can't be drawn; index.html says which, and why" directory
                lost)
          74))
    ((or file-error stream-error system-failure) (condition)
      (tell "supergrip: ~a: ~a" directory condition)
      74)))

(defun reportable-p (directory)
  "Return true if a report can be made and written into DIRECTORY, a string; tell why, if not."
  (reporter)
  (directory-ready-p directory))

(defun directory-ready-p (directory)
  "Return true if files can be written into DIRECTORY, a string, made if it is not there; tell why,
if not."
  (handler-case (progn (make-directories directory)
                       (check-writable directory)
                       t)
    (system-failure (condition)
      (tell "supergrip: ~a: ~a" directory condition)
      nil)))

(defun report-end (batch)
  "Say on standard error what is not as it should be."
  (when *signal*
    (tell "supergrip: ended by ~a after ~d box~:*~[es~;~:;es~]~:[~;; the report is not complete~]"
          *signal*
          (batch-done batch) (batch-keep batch)))
  (when (plusp (batch-bad batch))
    (let ((one (= 1 (batch-bad batch))))
      (tell "supergrip: ~d of ~d box~:*~[es~;~:;es~] ~:[are~;is~] not valid; ~:[their records ~
             say~;its record says~] why"
            (batch-bad batch) (batch-done batch) one one))))

(defun print-and-end (text)
  "Write TEXT to standard output, and return the exit status."
  (let ((output (make-output 1)))
    (handler-case (progn (put-text output text)
                         (flush-output output)
                         0)
      (write-failure (condition)
        (cond ((closed-pipe-p condition) 0)
              (t (tell "supergrip: standard output: ~a" condition)
                 74))))))

(defun run (options files)
  "Do what OPTIONS, a plist, and FILES say, and return the exit status."
  (when (and (getf options :check) files)
    (misused "--check reads no boxes: ~{~a~^, ~}" files))
  (when (and (getf options :verify) (not (getf options :check)))
    (misused "--verify goes with --check"))
  (when (and (getf options :all) (eq (getf options :format) :trace))
    (misused "--all does not go with --format trace, which shows all possible grasps"))
  (when (and (getf options :refine) (not (member (getf options :format) '(nil :lisp :json))))
    (misused "--refine goes with --format sexp or json, which have a place for it"))
  (multiple-value-bind (knowledge status) (try-knowledge options)
    (cond ((null knowledge) status)
          ((getf options :verify)
           (check-and-verify knowledge (getf options :gamma *gamma*)))
          ((getf options :check) (check knowledge))
          ((and (getf options :report) (not (reportable-p (getf options :report)))) 74)
          ((and (getf options :mjcf) (not (directory-ready-p (getf options :mjcf)))) 74)
          (t
           (let ((batch (make-batch knowledge (check-gamma (getf options :gamma *gamma*))
                                    (getf options :index :paper)
                                    (getf options :input) (getf options :format)
                                    (make-output 1)))
                 (*certified* (getf options :all
                                    (if (find-writer (getf options :format))
                                        most-positive-fixnum
                                        1)))
                 (*depth-limit* (getf options :depth-limit *depth-limit*))
                 (*record-limit* (room-for (getf options :record-limit *record-limit*)))
                 (*number-limit* (getf options :number-limit *number-limit*))
                 (*name-limit* (getf options :name-limit *name-limit*)))
             (when (terminal-p 2)
               (setf (batch-after-record batch) (follow-progress batch)))
             (setf (batch-keep batch) (and (getf options :report) t)
                   (batch-all batch) (getf options :all)
                   (batch-refine batch) (getf options :refine)
                   (batch-models batch) (and (getf options :mjcf)
                                             (make-models (getf options :mjcf)))
                   (batch-margin batch) (getf options :margin))
             (run-files batch files (getf options :report)))))))

(defparameter +internal-error+
  "supergrip: internal error: ~a
This is a bug in SUPER-GRIP.  To report it, send these lines, the command line, what --version
prints, and the boxes, rules and grasps it was given."
  "What is said of an error that should not be.")

(defun report-internal-error (condition)
  "Tell of CONDITION, and return the exit status."
  (tell +internal-error+ condition)
  70)

(defun do-command (arguments)
  "Do what ARGUMENTS, a list of strings, say, and return the exit status; whatever goes wrong."
  (handler-case
      (multiple-value-bind (options files) (parse-command-line arguments)
        (cond ((getf options :help) (print-and-end +help+))
              ((getf options :version)
               (print-and-end (format nil "supergrip ~a~%" +version+)))
              (t (run options files))))
    (usage-error (condition)
      (tell "supergrip: ~a~%Try supergrip --help." condition)
      64)
    (no-pictures (condition)
      (tell "supergrip: ~a" condition)
      69)
    ;; Not SIGINT: one that came while SBCL started is for NEVER-DEBUG.
    ((or error storage-condition) (condition)
      (report-internal-error condition))))

(defun main (arguments)
  "Do what ARGUMENTS, a list of strings, say, and return the exit status.  See --help."
  (or (unless-signalled (do-command arguments))
      (progn (tell "supergrip: ended by ~a" *signal*)
             (signal-status *signal*))))

(defun main-and-end ()
  "Be the program: do what the command line says, and end the process."
  (catch-signals)
  (never-debug #'report-internal-error)
  (keep-small)
  (end-process (main (command-arguments))))

;;; The executable

(defun warm-up ()
  "Answer the examples that the keys of a box make, in each notation, by each index, in each format:
the first call of a generic function takes SBCL long, and an image that is saved then has them
behind it."
  (flet ((answer-example (*notation* name rows)
           (let ((description (loop for row in rows
                                    collect (cons (funcall name row) (box-key-example row)))))
             (dolist (index (mapcar #'index-name *indices*))
               (dolist (format '(:trace :lisp :json))
                 (let ((batch (make-batch *knowledge* *gamma* index *notation* format
                                          (make-output 1)))) ; nothing is flushed
                   (setf (batch-all batch) 2)
                   (answer batch description '() 1)))))))
    ;; No rule declares the fact of the example, so with it this is an error record.  The gripper
    ;; may lack FINGER-FORCE, which some units need.
    (let ((all (remove-if #'box-key-instead *box-keys*)))
      (dolist (rows (list all (set-difference all (list (find-key :facts) (find-key :units)))))
        (answer-example :lisp #'box-key-key rows)
        (answer-example :json #'box-key-json rows)))))

(defun build ()
  "Save this image as the executable whose name the command line gives, or as supergrip in the
directory of SUPER-GRIP, and end."
  (let* ((arguments (command-arguments))
         (given (and (listp arguments) (first arguments)))
         (file (or given (native-name (merge-pathnames "supergrip" *home*)))))
    (handler-case (prepare-file file)
      (system-failure (condition)
        (tell "supergrip: ~a: ~a" file condition)
        (end-process 66)))
    (unless (report-index)
      (tell "supergrip: the executable has no --report, since cl-who is missing"))
    (keep-shipped-files)
    (warm-up)
    (never-debug #'report-internal-error)
    (save-program (native-path file) #'main-and-end)))
