;;;; watches.lisp -- rules that can't fire sleep, and cost nothing.
;;;;
;;;; A rule that asks for a fact of some predicate can't fire before there is one.  So it watches a
;;;; predicate, of those that it asks for the one that the fewest rules do, and sleeps until the
;;;; first fact of it is remembered (see NOTE-USE).  A run looks only at rules that are awake.

(in-package :supergrip-chainer)

(defun asked-predicates (rule)
  "Return the predicates of which the antecedent of RULE asks for a fact."
  (remove-duplicates (mapcar #'clause-predicate
                             (remove-if #'clause-negated (rule-clauses rule)))
                     :from-end t))

(defun set-watches (rulebase)
  "Put into AWAKE of RULEBASE which rules may fire whatever is known, one bit a rule, and into WAKES
the list of the indices of the others that watch each predicate."
  (let* ((rules (rulebase-rules rulebase))
         (count (length (rulebase-predicates rulebase)))
         (awake (make-array (length rules) :element-type 'bit :initial-element 0))
         (wakes (make-array count :initial-element '()))
         (askers (make-array count :initial-element 0)))
    (flet ((askers (predicate) (aref askers (predicate-index predicate))))
      (loop for rule across rules
            do (dolist (predicate (asked-predicates rule))
                 (incf (aref askers (predicate-index predicate)))))
      (loop for rule across rules
            for watched = (first (stable-sort (asked-predicates rule) #'< :key #'askers))
            do (if watched
                   (push (rule-index rule) (aref wakes (predicate-index watched)))
                   (setf (sbit awake (rule-index rule)) 1))))
    (setf (rulebase-awake rulebase) awake
          (rulebase-wakes rulebase) wakes)))
