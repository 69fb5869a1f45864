;;;; rulebase.lisp -- rules are read and compiled; all together are numbered, and put to sleep.
;;;;
;;;; A rule that asks for a fact of some predicate can't fire before there is one.  So it waits for
;;;; one of the predicates that it asks for, the one that the fewest rules ask for, and sleeps until
;;;; the first fact of it is remembered (see WAKE-RULES).  Rules that sleep cost a run nothing.

(in-package :supergrip-chainer)

;;; Rules

(defparameter *clause-limit* 500 "The most clauses that a rule may have.")

(defun parse-parts (parse forms label)
  "Return what PARSE makes of each of FORMS and its number, from 0; or NIL if one of them is wrong.
The place in the reports is LABEL and a number from 1."
  (let ((parts (loop for form in forms
                     for number from 0
                     for *place* = (format nil "~a ~d" label (1+ number))
                     collect (let ((*form* (if (consp form) form *form*)))
                               (funcall parse form number)))))
    (and (notany #'null parts) parts)))

(defun parse-rule (form index)
  "Return the rule that FORM, (RULE name (IF clause...) (THEN action...)), spells, the one with
INDEX.  NIL after a complaint."
  (let* ((name (and (consp form) (namep (second form)) (second form)))
         (*subject* (if name (format nil "RULE ~a" name) "RULE without a name"))
         (*place* nil)
         (*form* form))
    (cond ((not (part-p form "RULE"))
           (let ((*subject* nil))
             (complain form "~a is not a rule: a rule file holds (RULE name (IF clause...) (THEN ~
                             action...)) and (INPUT sentence)" (form-text form))))
          ((or (null name) (/= (length form) 4)
               (not (part-p (third form) "IF")) (not (part-p (fourth form) "THEN")))
           (complain form "a rule is (RULE name (IF clause...) (THEN action...))"))
          ((null (rest (third form)))
           (complain form "IF has no clause"))
          ((null (rest (fourth form)))
           (complain form "THEN has no action"))
          ((nthcdr *clause-limit* (rest (third form)))
           (complain form "more than ~d clauses" *clause-limit*))
          (t (parse-rule-parts form index)))))

(defun parse-rule-parts (form index)
  "Return the rule of FORM, which has the parts of one, or NIL after complaints."
  (let* ((*variables* '())
         (clauses (parse-parts #'parse-clause (rest (third form)) "clause"))
         (*clause-failed* (null clauses))
         (actions (parse-parts #'parse-action (rest (fourth form)) "action")))
    (and clauses actions
         (make-rule :name (symbol-name (second form)) :form form :comment (form-comment form)
                    :index index :variables *variables* :clauses clauses :actions actions
                    :matcher (compile-antecedent clauses actions (length *variables*))))))

;;; All together

(defun build-rulebase (forms inputs &key client)
  "Return a rule base of FORMS: (RULE ...) forms in the order in which they are to run, and
(INPUT ...) forms, whose places do not matter.  INPUTS are the predicates that the input always
provides: a list of (WORDS ARITY), WORDS a list of strings.  CLIENT is what the actions of the lower
level are compiled against.

Forms that are wrong are left out after a complaint (see WITH-PROBLEMS)."
  (let ((*predicates* (make-hash-table :test #'equal))
        (*client* client))
    (loop for (words arity) in inputs
          do (intern-predicate words arity nil :given t))
    (mapc #'parse-input (remove-if-not #'input-form-p forms))
    (let* ((rules (read-rules (remove-if #'input-form-p forms)))
           (predicates (make-array (hash-table-count *predicates*))))
      (loop for predicate being the hash-values of *predicates*
            do (setf (svref predicates (predicate-index predicate)) predicate))
      (multiple-value-bind (awake sleepers) (sleeping-rules rules (length predicates))
        (%make-rulebase rules predicates awake sleepers *predicates*)))))

(defun read-rules (forms)
  "Return a vector of the rules of FORMS, each at its index; complain of those that are wrong."
  (let ((rules '())
        (names (make-hash-table :test #'equal)))
    (dolist (form forms (coerce (nreverse rules) 'simple-vector))
      (let ((rule (parse-rule form (length rules))))
        (cond ((null rule))
              ((gethash (rule-name rule) names)
               (let ((*subject* (format nil "RULE ~a" (rule-name rule))))
                 (complain form "an earlier rule has this name")))
              (t (setf (gethash (rule-name rule) names) t)
                 (push rule rules)))))))

(defun asked-predicates (rule)
  "Return the predicates of which the antecedent of RULE asks for a fact."
  (remove-duplicates (mapcar #'clause-predicate
                             (remove-if #'clause-negated (rule-clauses rule)))
                     :from-end t))

(defun sleeping-rules (rules count)
  "Return which of RULES may fire whatever is known, one bit each; and for each of COUNT predicates,
the list of the indices of the others that wait for its first fact."
  (let ((awake (make-array (length rules) :element-type 'bit :initial-element 0))
        (sleepers (make-array count :initial-element '()))
        (askers (make-array count :initial-element 0)))
    (flet ((askers (predicate) (aref askers (predicate-index predicate))))
      (loop for rule across rules
            do (dolist (predicate (asked-predicates rule))
                 (incf (aref askers (predicate-index predicate)))))
      (loop for rule across rules
            for awaited = (first (stable-sort (asked-predicates rule) #'< :key #'askers))
            do (if awaited
                   (push (rule-index rule) (aref sleepers (predicate-index awaited)))
                   (setf (sbit awake (rule-index rule)) 1))))
    (values awake sleepers)))
