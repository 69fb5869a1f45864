;;;; batch.lisp -- boxes in, records out: one for each box or fragment, in the same order.
;;;;
;;;; Nothing is kept from one record to the next, so the input may have any length.  A malformed
;;;; record affects no other.

(in-package :supergrip)

(defstruct (batch (:constructor make-batch (knowledge gamma index notation format output)))
  "What records are made with, and how many were.  NOTATION is :LISP, :JSON or NIL, to tell from
the input; FORMAT is :TRACE, :LISP, :JSON, the name of a writer, or NIL, as the input.  BAD counts
the error records; BROKEN is true if one of them was an internal error.  LAST, after an error
record, whose box may go on, is the line where it ended, or :REST once it did go on.  PLANS holds
the plans for a report, the latest first, if KEEP is true; MARGIN is as for PLAN.  ALL says how many
alternatives a record has, NIL for none; REFINE is true if it tells what refining gives.
MODELS says where a file of each box goes, if not NIL; LOST is true if one could not be written."
  (knowledge nil :type knowledge)
  (gamma 0.5d0 :type double-float)
  (index :paper :type keyword)
  notation format
  (output nil :type output)
  (done 0 :type fixnum)
  (bad 0 :type fixnum)
  (broken nil)
  (last nil)
  (keep nil) (plans '() :type list)
  (all nil :type (or null fixnum))
  (refine nil) (models nil) (lost nil)
  (margin nil)
  (after-record nil :type (or null function)))

(defun run-batch (batch descriptor)
  "Read boxes from DESCRIPTOR to its end, or until *SIGNAL* is set, and write their records.
Signals a SYSTEM-FAILURE if the one can't be read or the other not written."
  (let* ((input (make-input descriptor (lambda () (flush-output (batch-output batch)))))
         (source (input-source input nil))
         (notation (or (batch-notation batch) (told-notation input source))))
    (setf (input-notation input) notation
          (batch-last batch) nil)
    ;; An empty input is in no notation.
    (unless (or (batch-format batch) (null (skip-to-json source)))
      (setf (batch-format batch) notation))
    (let ((*notation* notation)
          (*places* (lambda (spot) (spot-place source spot))))
      (skip-to-json source)
      (when (utf-16-p (source-buffer source) (source-position source) (source-end source))
        (answer-utf-16 batch source))
      (if (eq notation :json)
          (run-json batch source input)
          (run-lisp batch source input)))
    (flush-output (batch-output batch))))

(defun spot-place (source spot)
  "Return the line and the column of SPOT (see VALUE-SPOT) in the record read last; :END is where it
ends."
  (if (eq spot :end)
      (values (source-line source) (1- (source-column source)))
      (part-place source spot)))

(defun next-record (input source skip)
  "Go by the function SKIP to the next record, and return its first character, or NIL at the end
or if a signal came."
  (setf (input-open input) nil
        (input-cut input) nil)
  (let ((character (funcall (the function skip) source)))
    (setf (input-open input) t)
    (and (not *signal*) character)))

;;; Lisp

(defun run-lisp (batch source input)
  (loop while (next-record input source #'skip-to-record)
        do (let ((line (source-line source))
                 (column (source-column source)))
             (multiple-value-bind (form problems) (read-lisp-box source input)
               (when (and problems *signal*) (return))
               (if (rest-of-box-p batch form problems line)
                   (setf (batch-last batch) :rest)
                   (answer batch form problems line column (end-line source)))))))

(defun end-line (source)
  "Return the line in which what SOURCE has read ends."
  (- (source-line source) (if (= (source-column source) 1) 1 0)))

(defun rest-of-box-p (batch form problems line)
  "True if FORM, or what has PROBLEMS, is what is left of a box that a parenthesis too many ended."
  (if problems
      (and (goes-on-p batch line)
           (search "a closing parenthesis too many" (problem-text (first problems))))
      (and (batch-last batch) (consp form) (namep (first form)) (key-named (first form)))))

(defun goes-on-p (batch line)
  "True if what closes something in LINE may belong to the box of the error record before."
  (member (batch-last batch) (list line :rest)))

(defun read-lisp-box (source input)
  "Return the form of the next record, or NIL and the list of what is wrong."
  (handler-case
      (let ((form (read-datum source)))
        (unless (listp form)
          (skip-record source))
        form)
    (syntax-error (condition)
      (skip-record source)
      (values nil (problems-of condition source input)))))

(defun problems-of (condition source input)
  "Return the problems of CONDITION, the syntax error of a record that has been skipped."
  (let ((problems (input-error-problems condition)))
    (when (and (input-cut input)
               (find-if (lambda (end) (search end (problem-text (first problems))))
                        '("never closed" "nothing follows")))
      (setf (problem-text (first problems))
            (format nil "~a before line ~d, which starts another record"
                    (problem-text (first problems)) (source-line source))))
    problems))

;;; JSON

(defun run-json (batch source input)
  "STATE is what may come next: :START, an object or an array of objects; :FIRST, a value or the
end of the array; :VALUE, after a comma; :COMMA, after a value; :ANY, after an error."
  (let ((state :start) (array-line 0) (array-column 0))
    (loop for character = (next-record input source #'skip-to-json)
          while character
          unless (and (goes-on-p batch (source-line source))
                      (find character (if (eq state :start) ",}" "}"))
                      (take-character source)) ; of the box before
          do (let ((line (source-line source))
                   (column (source-column source)))
               (flet ((bad (text)
                        (answer-mistake batch text line column)))
                 ;; An object at the beginning of a line, no comma before it, is no part of an
                 ;; array.
                 (when (and (eq state :comma) (char= character #\{) (= column 1))
                   (answer-mistake batch "this array is never closed" array-line array-column)
                   (setf state :start))
                 (cond ((eq state :start)
                        (if (char= character #\[)
                            (progn (take-character source)
                                   (setf state :first array-line line array-column column))
                            (run-json-value batch source input state line column)))
                       ((char= character #\])
                        (when (eq state :value)
                          (bad "a comma stands before the end of the array"))
                        (take-character source)
                        (setf state :start))
                       ((char= character #\,)
                        (when (member state '(:first :value))
                          (bad "a comma too many"))
                        (loop do (take-character source)
                              while (and (eq state :value) (eql (skip-to-json source) #\,)))
                        (setf state :value))
                       (t
                        (setf state (run-json-value batch source input state line column)))))))
    (unless (or *signal* (eq state :start))
      (answer-mistake batch "this array is never closed" array-line array-column))))

(defun answer-utf-16 (batch source)
  "Write the one record of text in UTF-16, and skip it: its lines begin with half of a character."
  (answer-mistake batch
                  "this is UTF-16, but must be UTF-8; iconv -f UTF-16 -t UTF-8 converts it"
                  (source-line source) (source-column source))
  (loop while (and (peek source)
                   (or (char/= (take-character source) #\Newline)
                       (eql (peek source) (code-char 0))))))

(defun answer-mistake (batch text line column)
  "Write the record of a fragment at LINE and COLUMN that is no value."
  (answer batch nil (list (make-problem :line line :column column :text text)) line))

(defun run-json-value (batch source input state line column)
  "Answer the value that SOURCE stands at, and return the state after it if it is in an array."
  (multiple-value-bind (value problems)
      (read-json-box source input (eq state :start) (batch-last batch))
    (when (eq problems :rest)
      (setf (batch-last batch) :rest)
      (return-from run-json-value :any))
    (when (and (null problems) (eq state :comma))
      (setf problems (list (make-problem :line line :column column
                                         :text "a comma is missing before this value"))))
    (unless (and problems *signal*)
      (answer batch (json-description value) problems line column (end-line source)))
    (if problems :any :comma)))

(defun read-json-box (source input alone after-error)
  "Return the value of the next record, or NIL and the list of what is wrong.  ALONE is true if it
is not in an array, so that the rest of its line belongs to it if it is no object.  Where a key
stands AFTER-ERROR, a brace before it was one too many: what it ended is skipped; the list is :REST
then."
  (let ((stops (if alone "{" ",]{")))
    (handler-case
        (let ((value (read-json source)))
          (cond ((and after-error (stringp value) (eql (peek source) #\:))
                 (skip-json source "" 1)
                 (values nil :rest))
                (t (when (and alone (not (json-object-p value)))
                     (skip-json source stops))
                   value)))
      (syntax-error (condition)
        (skip-json source stops)
        (values nil (problems-of condition source input))))))

;;; Records

(defun answer (batch description problems line &optional column end)
  "Write the record of the box that DESCRIPTION describes, or of PROBLEMS.  It begins at LINE and
COLUMN, and ends in the line END."
  (multiple-value-bind (result problems broken)
      (if problems
          (values nil problems nil)
          (plan-result batch description line column))
    (let ((result (or result (problem-result batch description problems line)))
          (output (batch-output batch)))
      (when problems (incf (batch-bad batch)))
      (setf (batch-last batch) (and problems end))
      (when broken (setf (batch-broken batch) t))
      (case (batch-format batch)
        (:lisp (write-lisp-record result output))
        (:json (write-json-record result output))
        (t (when (eq (batch-format batch) :trace)
             (put-box-line batch description line))
           (put-text output result)))
      (incf (batch-done batch))
      (when (batch-after-record batch)
        (funcall (batch-after-record batch))))))

(defun put-box-line (batch description line)
  "Say before the trace of a box which it is; but a single box without a name has the paper's
lines."
  (let ((name (description-name description))
        (output (batch-output batch)))
    (when (or name (plusp (batch-done batch)))
      (put-text output "(BOX ")
      (when name
        (put-lisp-string name output)
        (put-octet output 32))
      (put-text output "IN LINE ")
      (put-integer output line)
      (put-text output (format nil ")~%")))))

(defun plan-result (batch description line column)
  "Return the record, or the lines, of the plan for the box of DESCRIPTION; or NIL, the problems,
and whether they are ours."
  (handler-case
      (let ((plan (plan (canonical-box description nil line)
                        :knowledge (batch-knowledge batch) :gamma (batch-gamma batch)
                        :index (batch-index batch) :margin (batch-margin batch))))
        (when (batch-keep batch)
          (push plan (batch-plans batch)))
        (when (batch-models batch)
          (write-model batch plan line))
        (case (batch-format batch)
          (:trace (with-output-to-string (out) (write-transcript plan out)))
          ((:lisp :json)
           (record-in-units (plan-record plan :line line :all (batch-all batch)
                                              :refine (batch-refine batch))
                            (%box-units (plan-box plan))))
          (t (writer-result batch plan line))))
    (box-error (condition)
      (let ((problems (input-error-problems condition)))
        (dolist (problem problems)
          (unless (problem-column problem) (setf (problem-column problem) column)))
        (values nil problems nil)))
    ((or error storage-condition) (condition)
      (values nil
              (list (make-problem :line line :column column
                                  :text (format nil "internal error: ~a (a bug in SUPER-GRIP; to ~
                                                     report it, send this box)"
                                                condition)))
              t))))

(defun writer-result (batch plan line)
  "Return what the writer that the format of BATCH names makes of PLAN, of the box in LINE."
  (let ((writer (find-writer (batch-format batch))))
    (unless (plan-best plan)
      (tell-of-none (writer-kind writer) (box-name (plan-box plan)) line (plan-reason plan)))
    (let ((palms (palms-inside-text (best-grasps plan (batch-all batch)) plan)))
      (when palms
        (tell "supergrip: line ~d~@[, ~s~]: ~a" line (box-name (plan-box plan)) palms)))
    (written-plan writer plan (batch-all batch))))

(defun tell-of-none (kind name line reason)
  "Say on standard error that the box NAME in LINE has no grasp for output called KIND, and why."
  (tell "supergrip: line ~d~@[, ~s~]: no grasp for ~a: ~a" line name kind reason))

(defun problem-result (batch description problems line)
  "Return the record, or the lines, of PROBLEMS."
  (let ((name (description-name description)) (reason (problems-reason problems)))
    (when (batch-models batch)
      (tell-of-none +model-kind+ name line reason))
    (case (batch-format batch)
      (:trace (format nil "~{(BAD BOX: ~a)~%~}--END--~%"
                      (loop for problem in problems
                            collect (visible-text (problem-reason problem)))))
      ((:lisp :json) (error-record problems :name name :line line :index (batch-index batch)
                                            :all (batch-all batch)
                                            :refine (batch-refine batch)
                                            :carried (description-carried description)))
      (t (let ((writer (find-writer (batch-format batch))))
           (tell-of-none (writer-kind writer) name line reason)
           (written-mistake writer name reason))))))

;;; Files, one a box

(defstruct (models (:constructor make-models (directory)))
  "Where the models of the boxes of a run go: DIRECTORY, a string; NAMES has those of the files that
are there already, without type."
  (directory nil :type string :read-only t)
  (names (make-hash-table :test #'equal) :read-only t))

(defun new-stem (name models)
  "Return the name of a file, without type, for the box NAME, a string or NIL: no other box of the
run has it."
  (let ((names (models-names models)) (stem (file-stem name)))
    (loop for number from 1
          for try = (if (= number 1) stem (format nil "~a-~d" stem number))
          unless (gethash try names)
            do (setf (gethash try names) t)
               (return try))))

(defun write-model (batch plan line)
  "Write the model of the best grasp of PLAN, of the box in LINE, into a file of its own; or tell
why there is none."
  (let ((models (batch-models batch)) (name (box-name (plan-box plan))))
    (if (null (plan-best plan))
        (tell-of-none +model-kind+ name line (plan-reason plan))
        (let ((file (format nil "~a/~a.xml" (string-right-trim "/" (models-directory models))
                            (new-stem name models))))
          (handler-case (write-file file (mjcf-text plan line))
            (system-failure (condition)
              (setf (batch-lost batch) t)
              (tell "supergrip: ~a: ~a" file condition)))))))

(defun described (key description)
  "Return the clause for KEY, a keyword, in DESCRIPTION, which need not be valid, or NIL."
  (let* ((clauses (unwrap-box description))
         (number (and (listp clauses) (clause-number key clauses)))
         (clause (and number (nth number clauses))))
    (and (listp (rest clause)) clause)))

(defun description-name (description)
  "Return the name in DESCRIPTION, which need not be valid, or NIL."
  (let ((name (second (described :name description))))
    (and (stringp name) name)))

(defun description-carried (description)
  "Return what the box of DESCRIPTION, which need not be valid, carries along, or NIL."
  (let ((clause (described :data description)))
    (and clause (key-value (find-key :data) (rest clause)))))
