;;;; proof.lisp -- what is true of the rules alone, in every situation.

(in-package :supergrip)

(defun judge (runner situations)
  "Run the rules of RUNNER in each of SITUATIONS, and note there what they answer."
  (dolist (situation situations)
    (multiple-value-bind (answer stop) (run-runner runner (situation-box situation))
      (setf (situation-answer situation) answer
            (situation-stop situation) stop
            (situation-fired situation) (copy-seq (runner-fired runner))
            (situation-done situation) (reverse (runner-done runner))))))

(defun fired-p (rule situation)
  (plusp (sbit (situation-fired situation) (rule-index rule))))

(defun total-weight (situations)
  (reduce #'+ situations :key #'situation-weight))

(defun changed-situations (runner rules situations)
  "Return those of SITUATIONS in which RULES, instead of all of RUNNER, answer something else."
  (remove-if-not (lambda (situation)
                   (changed-p (situation-answer situation)
                              (run-runner runner (situation-box situation) rules)))
                 situations))

(defun situations-finding (kind situations &rest more)
  "Return a finding of KIND that holds in SITUATIONS, the smallest first; MORE are further slots."
  (apply #'make-finding :kind kind :situations (total-weight situations)
                        :witness (and situations (situation-box (first situations)))
                        more))

;;; Each rule

(defstruct rule-use
  "How often the rule NAME fires, and how often it changes the answer: FIRES and MATTERS count
situations."
  name (fires 0) (matters 0))

(defun use-of (rule runner situations)
  "Return the RULE-USE of RULE."
  (let ((fired (remove-if-not (lambda (situation) (fired-p rule situation)) situations))
        (others (remove rule (runner-rules runner))))
    (make-rule-use :name (rule-name rule) :fires (total-weight fired)
                   :matters (total-weight (changed-situations runner others fired)))))

;;; Rules that never fire

(defun never-finding (rule runner situations)
  "Return why RULE never fires: an earlier rule ends the run where its clauses are met, or they
never are."
  (let ((met '()) (most 0))
    (dolist (situation situations)
      (start-run runner (situation-box situation))
      (dolist (earlier (ldiff (runner-rules runner) (member rule (runner-rules runner))))
        (continue-run runner (list earlier))) ; on, where a rule ends the run
      (let ((count (met-clauses rule (runner-memory runner))))
        (setf most (max most count))
        (when (= count (length (rule-clauses rule)))
          (push situation met))))
    (if met
        (situations-finding :shadowed (reverse met) :rule (rule-name rule)
                            :other (stoppers met))
        (make-finding :kind :never :rule (rule-name rule)
                      :situations (total-weight situations) :more (list :clause (1+ most))))))

(defun stoppers (situations)
  "Return the names of the rules that end the run in SITUATIONS."
  (remove-duplicates (loop for situation in situations
                           for stop = (situation-stop situation)
                           when stop collect (rule-name (stop-rule stop)))
                     :test #'string= :from-end t))

;;; Rules that can be left out

(defun effects (rule situation)
  "Return what RULE does in SITUATION: a list of lists that can be compared, matchings one by one."
  (loop for (doer action . what) in (situation-done situation)
        when (eq doer rule)
          append (cond ((action-target action)
                        (loop for matching below 24
                              when (logbitp matching what)
                                collect (list (action-target action) matching)))
                       ((action-predicate action)
                        (list (list (action-predicate action)
                                    (face-list-mask (instantiate (action-terms action) what)))))
                       (t (list (list (form-text (action-form action))))))))

(defun alike-p (rule other)
  "True if RULE and OTHER try the same grasp, remember the same predicate, or may both end the run,
or if it is not known what they do."
  (flet ((shared-p (key) (intersection (remove nil (mapcar key (rule-actions rule)))
                                       (remove nil (mapcar key (rule-actions other))))))
    (or (shared-p #'action-target) (shared-p #'action-predicate)
        (and (may-stop-p rule) (may-stop-p other))
        (opaque-p rule) (opaque-p other))))

(defun subsumes-p (other rule situations)
  "True if in each of SITUATIONS, in which RULE fires, OTHER fires too and does all that RULE does."
  (every (lambda (situation)
           (and (fired-p other situation)
                (subsetp (effects rule situation) (effects other situation) :test #'equal)))
         situations))

(defun substitute-test (rule runner situations)
  "Return a function that is true of another rule if in one of SITUATIONS, where RULE fires,
either of the two can be left out, but not both."
  (lambda (other)
    (let* ((one (remove other (runner-rules runner)))
           (both (remove rule one)))
      (some (lambda (situation)
              (and (null (changed-situations runner one (list situation)))
                   (changed-situations runner both (list situation))))
            situations))))

(defun redundant-finding (rule runner situations)
  "Return that RULE changes no answer, and which others do what it does."
  (let ((fired (remove-if-not (lambda (situation) (fired-p rule situation)) situations))
        (others (remove-if-not (lambda (other) (alike-p rule other))
                               (remove rule (runner-rules runner)))))
    (flet ((names-of (test) (mapcar #'rule-name (remove-if-not test others))))
      (let ((subsumers (names-of (lambda (other) (subsumes-p other rule fired)))))
        (situations-finding (if subsumers :subsumed :redundant) fired
                            :rule (rule-name rule)
                            :other (or subsumers
                                       (names-of (substitute-test rule runner fired))))))))

(defun rule-findings (uses runner situations)
  "Return the findings about rules, whose USES are in their order, that can be done without."
  (loop for use in uses
        for rule in (runner-rules runner)
        for number from 1
        do (note-progress "rules that can be left out" number (length uses))
        when (zerop (rule-use-fires use))
          collect (never-finding rule runner situations)
        else when (zerop (rule-use-matters use))
               collect (redundant-finding rule runner situations)))

;;; The order of two rules

(defun conclusions (rule)
  (remove nil (mapcar #'action-predicate (rule-actions rule))))

(defun tries-p (rule)
  (some #'action-target (rule-actions rule)))

(defun may-stop-p (rule)
  (some (lambda (action) (not (or (action-target action) (action-predicate action))))
        (rule-actions rule)))

(defun feeds-p (rule other)
  "True if RULE may remember what OTHER tests."
  (intersection (conclusions rule) (mapcar #'clause-predicate (rule-clauses other))))

(defun may-interfere-p (a b)
  "True if it may make a difference which of the rules A and B, side by side, comes first."
  (flet ((counts-p (rule) (or (tries-p rule) (may-stop-p rule))))
    (or (feeds-p a b) (feeds-p b a) (opaque-p a) (opaque-p b)
        (and (may-stop-p a) (counts-p b))
        (and (may-stop-p b) (counts-p a)))))

(defun call-with-near-pairs (runner situation function)
  "Call FUNCTION with two rules, BEFORE and AFTER, for all pairs of which the first comes before
the second, if AFTER would fire at a place just before or just after BEFORE.  Otherwise it is all
the same there on which side of BEFORE it stands."
  (start-run runner (situation-box situation))
  (loop with memory = (runner-memory runner)
        for (before . others) on (runner-rules runner)
        for met = (loop for rule in others collect (rule-met-p rule memory))
        for stop = (continue-run runner (list before))
        do (loop for after in others
                 for before-p in met
                 when (or before-p (rule-met-p after memory))
                   do (funcall function before after))
        until stop))

(defun near-situations (runner situations)
  "Return a table from (BEFORE . AFTER) to those of SITUATIONS in which the order of these rules
may matter."
  (let ((table (make-hash-table :test #'equal))
        (pairs (make-hash-table :test #'equal)))
    (loop for (before . others) on (runner-rules runner)
          do (dolist (after others)
               (when (may-interfere-p before after)
                 (setf (gethash (cons (rule-index before) (rule-index after)) pairs) t))))
    (dolist (situation situations table)
      (call-with-near-pairs runner situation
                            (lambda (before after)
                              (let ((key (cons (rule-index before) (rule-index after))))
                                (when (gethash key pairs)
                                  (push situation (gethash key table)))))))))

(defun order-finding (before after runner situations)
  "Return that the rule AFTER must come after BEFORE, or NIL: where it changes the answer if
AFTER is moved up to a place just before BEFORE, but not if it is moved to one just after it."
  (let* ((others (remove after (runner-rules runner)))
         (tail (member before others))
         (head (ldiff others tail))
         (kept (append head (list before after) (rest tail)))
         (moved (append head (list after before) (rest tail)))
         (moved-changed (changed-situations runner moved situations))
         (kept-changed (changed-situations runner kept moved-changed))
         (changed (remove-if (lambda (situation) (member situation kept-changed)) moved-changed)))
    (when changed
      (situations-finding :order changed :rule (rule-name after) :other (rule-name before)
                                         :more (list :how (moved-text runner moved
                                                                      (first changed)))))))

(defun moved-text (runner rules situation)
  "Return what changes in SITUATION if RULES run in their order instead of all of RUNNER in theirs."
  (let ((old (situation-answer situation))
        (new (run-runner runner (situation-box situation) rules)))
    (first (change-texts (answer-difference old new) old new
                         (mapcar #'grasp-name (knowledge-grasps (runner-knowledge runner)))))))

(defun order-findings (runner situations)
  "Return for each rule which of those before it must come before it."
  (let ((near (near-situations runner situations)))
    (loop for (after . earlier) on (reverse (runner-rules runner))
          for number from 1
          do (note-progress "order of the rules" number (length (runner-rules runner)))
          append (loop for before in earlier
                       for some = (gethash (cons (rule-index before) (rule-index after)) near)
                       for finding = (and some
                                          (order-finding before after runner (reverse some)))
                       when finding collect finding))))

;;; Situations in which nothing is suggested

(defun silent-p (situation)
  "True if the rules suggest nothing in SITUATION, and do not say that it can't be done either."
  (let ((answer (situation-answer situation)))
    (and (null (answer-cant answer)) (every #'zerop (answer-tried answer)))))
