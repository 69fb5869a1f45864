;;;; why-not-rule.lisp -- why a rule did not fire, or did not say a fact.

(in-package :supergrip)

(defstruct (refusal (:include explanation))
  "Why RULE did not fire, or not for what was asked about.  If no rule ran, TRIED has the names of
the grasps that were tried without rules.  If RULE did fire, FIRED holds its bindings.  If the run
ended before RULE, or before its action, STOP is the STOP that ended it.  Otherwise a clause failed:
NUMBER   which clause it is, counted from 1
CLAUSE   the clause
BINDINGS those that met all clauses before it
BLOCKS   for a negation, under each binding the derivations of the facts that contradict it.
FIRED-FOR-OTHERS is true if RULE fired for something else than what was asked about."
  rule (tried '()) (fired '()) stop number clause (bindings '()) (blocks '()) fired-for-others)

(defun memory-before (plan rule)
  "Return the memory of PLAN as it was when RULE was tried, and, if it was not, the STOP before it."
  (let* ((knowledge (plan-knowledge plan))
         (memory (prepare-memory (new-memory knowledge) (plan-box plan) knowledge
                                 (plan-gamma plan))))
    (values memory
            (or (run-observed (plan-rulebase plan) memory (constantly nil) :end (rule-index rule))
                (and (not (reached-p rule plan)) (plan-stop plan))))))

(defun refuse-rule (rule plan)
  "Return the REFUSAL of RULE in PLAN."
  (multiple-value-bind (memory stop) (memory-before plan rule)
    (cond ((plan-tries plan)
           (make-refusal :rule rule :tried (remove-duplicates (mapcar #'first (plan-tries plan))
                                                              :test #'string= :from-end t)))
          (stop (make-refusal :rule rule :stop stop))
          ((failing-clause rule memory plan (constantly t)))
          (t (make-refusal :rule rule :fired (rule-bindings rule memory))))))

(defun refuse-conclusion (rule predicate face-list plan)
  "Return the REFUSAL of RULE in PLAN as far as it might have said PREDICATE of the faces of
FACE-LIST."
  (multiple-value-bind (memory stop) (memory-before plan rule)
    (let ((actions (remove predicate (rule-actions rule) :key #'action-predicate :test-not #'eq)))
      (flet ((wanted-p (binding)
               (some (lambda (action)
                       (may-bind-p (action-terms action) binding (face-list-mask face-list)))
                     actions)))
        (if (or stop (plan-tries plan))
            (refuse-rule rule plan)
            (let ((refusal (failing-clause rule memory plan #'wanted-p))
                  (bindings (rule-bindings rule memory)))
              (cond (refusal
                     (setf (refusal-fired-for-others refusal) (and bindings t))
                     refusal)
                    (t (make-refusal :rule rule :fired bindings
                                     :stop (and (plan-stop plan)
                                                (eq rule (stop-rule (plan-stop plan)))
                                                (plan-stop plan)))))))))))

(defun may-bind-p (terms binding faces)
  "True if those of TERMS that BINDING binds are among FACES, a set, and the others may be."
  (loop for term in terms
        always (or (>= term (face-list-count binding))
                   (logbitp (term-value term binding) faces))))

(defun failing-clause (rule memory plan wanted)
  "Return the REFUSAL of RULE on MEMORY with regard to the bindings that are WANTED, a predicate:
the first clause that fails for all of them.  NIL if none does."
  (loop for clause in (rule-clauses rule)
        for number from 1
        for bindings = (list 0) then next
        for next = (remove-if-not wanted (prefix-bindings rule number memory))
        when (null next)
          return (make-refusal :rule rule :number number :clause clause :bindings bindings
                               :blocks (and (clause-negated clause)
                                            (blocking-facts clause bindings plan)))))

(defun blocking-facts (clause bindings plan)
  "Return the derivations of the facts that contradict CLAUSE, negated, under BINDINGS."
  (let ((table (derivations plan)) (memory (plan-memory plan))
        (predicate (clause-predicate clause)))
    (loop for face-list in (remove-duplicates
                         (loop for binding in bindings
                               when (every (lambda (term) (or (not (term-variable-p term))
                                                              (< term (face-list-count binding))))
                                           (clause-terms clause))
                                 collect (instantiate (clause-terms clause) binding))
                         :key #'face-list-mask :from-end t)
          when (recall memory predicate face-list)
            collect (derivation-in table predicate face-list memory plan))))

(defun write-refusals (refusals more stream)
  "Write REFUSALS, and that there are MORE."
  (dolist (refusal refusals)
    (write-answer refusal stream))
  (when (plusp more)
    (format stream "~d more rule~:p ~:*~[~;is~:;are~] left out.~%" more)))

(defmethod write-answer ((answer refusal) stream)
  (let ((rule (refusal-rule answer)))
    (cond ((refusal-tried answer)
           (format stream "RULE ~a did not run: ~a ~:[was~;were~] tried without rules.~%"
                   (rule-name rule) (listed (refusal-tried answer)) (rest (refusal-tried answer))))
          ((refusal-fired answer) (write-fired answer stream))
          ((and (refusal-stop answer) (waiting-p (refusal-stop answer)))
           (format stream "RULE ~a has not run yet: the run is now ~:[in~;before~] RULE ~a.~%"
                   (rule-name rule) (eq (stop-verdict (refusal-stop answer)) :before)
                   (rule-name (stop-rule (refusal-stop answer)))))
          ((refusal-stop answer)
           (format stream "RULE ~a was not reached: RULE ~a ended the run, ~a.~%" (rule-name rule)
                   (rule-name (stop-rule (refusal-stop answer)))
                   (stop-text (refusal-stop answer))))
          (t (write-failing-clause answer stream)))))

(defun stop-text (stop)
  (if (eq (stop-verdict stop) :cant)
      (format nil "CANT ~{~a~^ ~}" (stop-words stop))
      "KEEP BEST"))

(defun write-fired (refusal stream)
  (let* ((rule (refusal-rule refusal))
         (stop (refusal-stop refusal))
         (running (and stop (waiting-p stop))))
    (format stream "RULE ~a ~:[did fire~;is running~]~@[, with ~a~]~@[, and ~a~].~%"
            (rule-name rule)
            running
            (let ((texts (binding-texts rule (refusal-fired refusal))))
              (and texts (listed texts 12 "; ")))
            (cond (running "has not come to this yet")
                  (stop (format nil "ended the run before, ~a" (stop-text stop)))))))

(defun binding-texts (rule bindings)
  "Return BINDINGS of RULE in words, those without variables left out."
  (remove "" (loop for binding in bindings collect (binding-text rule binding)) :test #'string=))

(defun write-failing-clause (refusal stream)
  (let* ((rule (refusal-rule refusal))
         (clause (refusal-clause refusal)))
    (format stream "RULE ~a ~:[did not fire~;did fire, but not for this~]: clause ~d, ~a, fails~
                    ~:[~; for every binding of the clauses before it~].~%"
            (rule-name rule) (refusal-fired-for-others refusal)
            (refusal-number refusal) (form-text (clause-form clause))
            (> (refusal-number refusal) 1))
    (write-tried-bindings rule (refusal-bindings refusal) stream)
    (if (clause-negated clause)
        (dolist (block (refusal-blocks refusal))
          (format stream "  This stands in its way:~%")
          (write-tree block stream 2)
          (terpri stream))
        (format stream "  ~a~%" (missing-text clause (or (> (refusal-number refusal) 1)
                                                         (refusal-fired-for-others refusal)))))))

(defun write-tried-bindings (rule bindings stream)
  (let ((texts (binding-texts rule bindings)))
    (when texts
      (format stream "  Tried: ~a~%" (listed texts 4 "; ")))))

(defun missing-text (clause bound)
  "Return what is missing for CLAUSE; BOUND is true if clauses before it chose its surfaces."
  (let ((words (predicate-text (clause-predicate clause)))
        (these (and bound (clause-terms clause))))
    (if (predicate-given (clause-predicate clause))
        (format nil "~a is an input, and the box does not give it~:[~; for these faces~]." words
                these)
        (format nil "No rule before it said ~a~:[~; of these faces~]." words these))))

(defmethod topic ((explanation refusal))
  (rule-name (refusal-rule explanation)))
