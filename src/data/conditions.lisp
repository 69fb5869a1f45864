;;;; conditions.lisp -- what is wrong with a file, said once, completely and in one place.

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
  (plainly (write-problem-parts problem stream)))

(defun write-problem-parts (problem stream)
  (format stream "~@[~a:~]~@[~d:~]~@[~d:~]" (problem-file problem) (problem-line problem)
          (problem-column problem))
  (when (or (problem-file problem) (problem-line problem)) (write-char #\Space stream))
  (when (eq (problem-severity problem) :warning) (write-string "warning: " stream))
  (format stream "~@[~a~]~:[~;, ~]~@[~a~]~:[~;: ~]~a"
          (problem-subject problem)
          (and (problem-subject problem) (problem-place problem))
          (problem-place problem)
          (or (problem-subject problem) (problem-place problem))
          (problem-text problem)))

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

(define-condition input-error (supergrip-error)
  ((problems :initarg :problems :reader input-error-problems
             :documentation "The list of PROBLEMs, all of them, in the order of the file."))
  (:report (lambda (condition stream)
             (format stream "~{~a~^~%~}" (input-error-problems condition))))
  (:documentation "Something that was given to SUPER-GRIP can't be used."))

(define-condition syntax-error (input-error) ()
  (:documentation "A file is not made of lists, names, numbers and strings."))

(define-condition box-error (input-error) ()
  (:documentation "A box description is not valid."))

(define-condition knowledge-error (input-error)
  ((consequence :initform nil :accessor knowledge-error-consequence
                :documentation "A sentence on what this leaves in force, or NIL."))
  (:report (lambda (condition stream)
             (format stream "~{~a~^~%~}~@[~%~a~]" (input-error-problems condition)
                     (knowledge-error-consequence condition))))
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
(defvar *comments* nil "A table from each outermost list of that file to the comment before it.")
(defvar *subject* nil "What is being checked, for the reports: \"RULE GRIP1\".")
(defvar *place* nil "Which part of it: \"clause 2\".")
(defvar *form* nil "The innermost list being checked whose line is known.")
(defvar *problems*)
(defvar *noted* nil "A table of the problems noted, so that none is noted twice.")

(defun line-of (form)
  (and *lines* (or (gethash form *lines*) (gethash *form* *lines*))))

(defun complain (form control &rest arguments)
  "Note an error in FORM, a list or a part of one, described by the format CONTROL and ARGUMENTS.
A CONTROL that is a list (:WARNING STRING) notes a warning.  Returns NIL."
  (let* ((severity (if (consp control) (first control) :error))
         (control (if (consp control) (second control) control))
         (parts (list severity *file* (line-of form) *subject* *place*
                      (apply #'format nil control arguments))))
    (unless (gethash parts *noted*)
      (setf (gethash parts *noted*) t)
      (destructuring-bind (severity file line subject place text) parts
        (push (make-problem :severity severity :file file :line line :subject subject
                            :place place :text text)
              *problems*))))
  nil)

(defvar *looks-left* nil
  "How many names SUGGESTION may still look at, NIL for any number.  Where thousands of names are
unknown, they are no slips of the pen.")

(defmacro with-problems (&body body)
  "Run BODY; return its value and the list of the problems that it complained of, in order."
  `(let ((*problems* '()) (*noted* (make-hash-table :test #'equal)) (*looks-left* 200000))
     (let ((value (plainly ,@body)))
       (values value (reverse *problems*)))))

(defun warnings-in (problems)
  "Return those of PROBLEMS that are warnings."
  (remove :warning problems :key #'problem-severity :test-not #'eq))

(defun errors-in (problems)
  "Return those of PROBLEMS that are errors."
  (remove :error problems :key #'problem-severity :test-not #'eq))
