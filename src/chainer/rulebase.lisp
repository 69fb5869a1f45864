;;;; rulebase.lisp -- all rules together: numbered, compiled, and put to sleep.
;;;;
;;;; A rule that asks for a fact of some predicate can't fire before there is one.  So it waits for
;;;; one of the predicates that it asks for, the one that the fewest rules ask for, and sleeps until
;;;; the first fact of it is remembered (see WAKE-RULES).  Rules that sleep cost a run nothing.

(in-package :supergrip-chainer)

(defun build-rulebase (forms inputs &key client)
  "Return a rule base of FORMS: (RULE ...) forms in the order in which they are to run, and
(INPUT ...) forms, whose places do not matter.  INPUTS are the predicates that the input always
provides: a list of (WORDS ARITY), WORDS a list of strings.  CLIENT is what the actions of the lower
level are compiled against.

Forms that are wrong are left out after a complaint (see WITH-PROBLEMS)."
  (let ((*rulebase* (%make-rulebase :client client))
        (rules '())
        (names (make-hash-table :test #'equal)))
    (loop for (words arity) in inputs
          do (intern-predicate words arity nil :given t))
    (mapc #'parse-input (remove-if-not #'input-form-p forms))
    (dolist (form (remove-if #'input-form-p forms))
      (let ((rule (parse-rule form)))
        (cond ((null rule))
              ((gethash (rule-name rule) names)
               (let ((*subject* (format nil "RULE ~a" (rule-name rule))))
                 (complain form "an earlier rule has this name")))
              (t (setf (gethash (rule-name rule) names) t)
                 (push rule rules)))))
    (setf (rulebase-rules *rulebase*) (coerce (reverse rules) 'simple-vector))
    (loop for rule across (rulebase-rules *rulebase*)
          for index from 0
          do (setf (rule-index rule) index))
    (number-predicates *rulebase*)
    (loop for rule across (rulebase-rules *rulebase*)
          do (setf (rule-matcher rule) (compile-antecedent rule)))
    (put-to-sleep *rulebase*)
    *rulebase*))

(defun number-predicates (rulebase)
  "Put all predicates of RULEBASE into one vector, each at its index."
  (let ((predicates (make-array (hash-table-count (rulebase-table rulebase)))))
    (loop for predicate being the hash-values of (rulebase-table rulebase)
          do (setf (svref predicates (predicate-index predicate)) predicate))
    (setf (rulebase-predicates rulebase) predicates)))

(defun asked-predicates (rule)
  "Return the predicates of which the antecedent of RULE asks for a fact."
  (remove-duplicates (mapcar #'clause-predicate
                             (remove-if #'clause-negated (rule-clauses rule)))
                     :from-end t))

(defun put-to-sleep (rulebase)
  "Put into AWAKE of RULEBASE which rules may fire whatever is known, one bit a rule, and into SLEEPERS,
for each predicate, the list of the indices of the others that wait for its first fact."
  (let* ((rules (rulebase-rules rulebase))
         (count (length (rulebase-predicates rulebase)))
         (awake (make-array (length rules) :element-type 'bit :initial-element 0))
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
    (setf (rulebase-awake rulebase) awake
          (rulebase-sleepers rulebase) sleepers)))
