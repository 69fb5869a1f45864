;;;; error-reports.lisp -- what is wrong with a file is collected, and told all at once.
;;;;
;;;; The texts of messages stand in the file that finds the mistake: those about characters and
;;;; parentheses in reader.lisp, those about files that can't be opened in files.lisp.

(in-package :supergrip-data)

(defstruct problem
  "One thing that is wrong.  SEVERITY is :ERROR or :WARNING; FILE, LINE and COLUMN say where, as
far as it is known; SUBJECT is the rule, grasp or box (\"RULE GRIP1\"), PLACE the part of it
(\"clause 2\"); TEXT says what is wrong and how to mend it."
  (severity :error :type (member :error :warning))
  (file nil) (line nil) (column nil)
  (subject nil) (place nil)
  (text "" :type string))

(defun write-problem (problem stream)
  "Write PROBLEM as FILE:LINE:COLUMN: SUBJECT, PLACE: TEXT, without the parts that are not known."
  (let ((subject (problem-subject problem)) (place (problem-place problem)))
    (plainly
      (format stream "~@[~a:~]~@[~d:~]~@[~d:~]~:[~; ~]~:[~;warning: ~]~
                      ~@[~a~]~:[~;, ~]~@[~a~]~:[~;: ~]~a"
              (problem-file problem) (problem-line problem) (problem-column problem)
              (or (problem-file problem) (problem-line problem))
              (eq (problem-severity problem) :warning)
              subject (and subject place) place (or subject place) (problem-text problem)))))

(defmethod print-object ((problem problem) stream)
  (if *print-escape*
      (print-unreadable-object (problem stream :type t) (write-problem problem stream))
      (write-problem problem stream)))

;;; Conditions

(define-condition supergrip-error (error) ()
  (:documentation "Everything that SUPER-GRIP itself signals."))

(defmethod print-object :around ((condition supergrip-error) stream)
  (declare (ignorable stream))
  (plainly (call-next-method)))

(define-condition argument-error (supergrip-error)
  ((text :initarg :text))
  (:report (lambda (condition stream) (write-string (slot-value condition 'text) stream)))
  (:documentation "A function was given something that it can't use."))

(defun refuse-argument (control &rest arguments)
  "Signal an ARGUMENT-ERROR that says what CONTROL and ARGUMENTS say."
  (error 'argument-error :text (apply #'plain-text control arguments)))

(define-condition input-error (supergrip-error)
  ((problems :initarg :problems :reader input-error-problems
             :documentation "The list of PROBLEMs, all of them, in the order of the file.")
   (consequence :initform nil :accessor input-error-consequence
                :accessor knowledge-error-consequence
                :documentation "A sentence on what this leaves in force, or NIL."))
  (:report (lambda (condition stream)
             (format stream "~{~a~^~%~}~@[~%~a~]" (input-error-problems condition)
                     (input-error-consequence condition))))
  (:documentation "Something that was given to SUPER-GRIP can't be used."))

(define-condition syntax-error (input-error) ()
  (:documentation "A file is not made of lists, names, numbers and strings."))

(define-condition box-error (input-error) ()
  (:documentation "A box description is not valid."))

(define-condition knowledge-error (input-error) ()
  (:documentation "Rules or grasps are not valid.  Restarts: RETRY reads the files again, CONTINUE
goes on without the rules and grasps that are wrong."))

(define-condition knowledge-warning (warning)
  ((problems :initarg :problems :reader knowledge-warning-problems
             :documentation "The list of PROBLEMs, all of them, in the order of the files."))
  (:report (lambda (condition stream)
             (format stream "~{~a~^~%~}" (knowledge-warning-problems condition))))
  (:documentation "Rules or grasps are valid but can't be meant so."))

(defmethod print-object :around ((condition knowledge-warning) stream)
  (declare (ignorable stream))
  (plainly (call-next-method)))

(defun retry ()
  "Invoke the restart RETRY: read the knowledge files again."
  (invoke-restart 'retry))

;;; Collecting problems

(defvar *file* nil "The name of the file whose contents are being checked, or NIL.")
(defvar *lines* nil "A table from each list read from that file to its line, or NIL.")
(defvar *places* nil "Instead of *LINES*: a function that returns the line and the column of a
form.")
(defvar *comments* nil "A table from each outermost list of that file to the comment before it.")
(defvar *subject* nil "What is being checked, for the reports: \"RULE GRIP1\".")
(defvar *place* nil "Which part of it: \"clause 2\".")
(defvar *form* nil "The innermost list being checked whose line is known.")

(defparameter *problem-limit* 20
  "How many problems of one rule, grasp or box are told; of the others only how many there are.")
(defparameter *problems-limit* 1000 "How many problems of one file or box are told.")

(defstruct tally
  "How many problems of a subject were TOLD, how many only counted, UNTOLD, and the problem MORE
that says so."
  (told 0 :type fixnum) (untold 0 :type fixnum) (more nil))

(defstruct report
  "What was complained of.  PROBLEMS, the latest first; COUNT, how many were told; NOTED, a table of
their texts, so that none is noted twice; TALLIES, one from subject to tally."
  (problems '() :type list)
  (count 0 :type fixnum)
  (noted nil)
  (tallies nil))

(defvar *report*)
(setf (documentation '*report* 'variable) "The report that COMPLAIN adds to.")

(defvar *looks-left* nil
  "How many names SUGGESTION may still look at, NIL for any number.  Where thousands of names are
unknown, they are no slips of the pen.")

(defun form-line (form)
  "Return the line of FORM, or of the list around it, if it was read from the file being checked."
  (and *lines* (or (gethash form *lines*) (gethash *form* *lines*))))

(defun form-file (form)
  "Return the name of the file being checked, unless FORM is not from there."
  (and (or (form-line form) (not (or form *form*)))
       *file*))

(defun form-comment (form)
  "Return the lines of the comment before FORM in that file, or NIL if they are not known."
  (and *comments* (gethash form *comments*)))

(defun form-place-text (form)
  "Return the file and the line of FORM as a text, as far as they are known, or NIL."
  (and (form-file form) (format nil "~a~@[:~d~]" (form-file form) (form-line form))))

(defun form-place (form)
  "Return the line and the column of FORM, as far as they are known."
  (if *places*
      (funcall *places* form)
      (values (form-line form) nil)))

(defmacro complain (form control &rest arguments)
  "Note an error in FORM, a list or a part of one, described by the format CONTROL and ARGUMENTS.
A CONTROL that is a list (:WARNING STRING) notes a warning.  Returns NIL.  ARGUMENTS are not
computed if enough was told already."
  `(note-problem ,form ,control (lambda () (list ,@arguments))))

(defun note-problem (form control arguments)
  (destructuring-bind (severity control) (if (consp control) control (list :error control))
    (let* ((full (>= (report-count *report*) (the fixnum *problems-limit*)))
           (subject (if full nil *subject*))
           (tally (tally-of (if full :others subject))))
      (flet ((problem ()
               (multiple-value-bind (line column) (form-place form)
                 (make-problem :severity severity :file (form-file form) :line line
                               :column column :subject subject))))
        (cond ((not (or full (>= (tally-told tally) (the fixnum *problem-limit*))))
               (tell-problem (problem) tally (apply #'format nil control (funcall arguments))))
              (t
               ;; Nothing but counting, or a long record would take more than linear time.
               (unless (tally-more tally)
                 (push (setf (tally-more tally) (problem)) (report-problems *report*)))
               (count-problem severity tally))))))
  nil)

(defun tally-of (subject)
  "Return the tally of SUBJECT in *REPORT*."
  (unless (report-tallies *report*)
    (setf (report-tallies *report*) (make-hash-table :test #'equal)
          (report-noted *report*) (make-hash-table :test #'equal)))
  (let ((tallies (report-tallies *report*)))
    (or (gethash subject tallies)
        (setf (gethash subject tallies) (make-tally)))))

(defun tell-problem (problem tally text)
  "Add PROBLEM with TEXT to *REPORT*, if it is not there yet."
  (setf (problem-place problem) *place*
        (problem-text problem) text)
  (let ((noted (report-noted *report*))
        ;; A string: of a list, only the first elements would be hashed.
        (key (format nil "~a ~a" (problem-severity problem) problem)))
    (unless (gethash key noted)
      (setf (gethash key noted) t)
      (incf (tally-told tally))
      (incf (report-count *report*))
      (push problem (report-problems *report*)))))

(defun count-problem (severity tally)
  "Count a problem of SEVERITY that is not told.  What stands for all such is an error if one is."
  (when (eq severity :error)
    (setf (problem-severity (tally-more tally)) :error))
  (setf (problem-text (tally-more tally))
        (format nil "and ~d more problem~:p" (incf (tally-untold tally)))))

(defmacro with-problems (&body body)
  "Run BODY; return its value and the list of the problems that it complained of, in order."
  `(let ((*report* (make-report)) (*looks-left* 200000))
     (let ((value (plainly ,@body)))
       (values value (reverse (report-problems *report*))))))

(defun refused-p (subject)
  "True if an error of SUBJECT was complained of."
  (find-if (lambda (problem)
             (and (eq (problem-severity problem) :error) (equal (problem-subject problem) subject)))
           (report-problems *report*)))

(defun warnings-in (problems)
  "Return those of PROBLEMS that are warnings."
  (remove :warning problems :key #'problem-severity :test-not #'eq))

(defun errors-in (problems)
  "Return those of PROBLEMS that are errors."
  (remove :error problems :key #'problem-severity :test-not #'eq))
