;;;; requires.lisp -- the least change of the box with which a fact holds, a rule fires, or a
;;;; grasp wins.

(in-package :supergrip)

(defstruct (requirement (:include explanation))
  "What the box requires for SUBJECT, a text, which is of KIND
  :FACT      a fact that is to be known when the rules have run
  :RULE      a rule that is to fire
  :GRASP     a grasp that is to be the best
  :POSSIBLE  a grasp that is to be possible, if it is tried.
MET is true if it is so already.  Three lists hold CHANGEs, each of which is enough by itself.
CHANGES are of single values: one for each value that can do it, the least first, relative to the
greater of the old and the new value.  FACES are of constrained faces, the fewest first.  FACTS are
of single facts that the rules declare.  STEPPED are the names of values that were only looked at in
steps.
POSSIBLE, for a grasp that nothing makes the best, is the requirement of kind :POSSIBLE."
  plan kind subject met (changes '()) (faces '()) (facts '()) (stepped '())
  (possible nil))

(defun whole-plan (plan)
  "Return PLAN, or, if its rules have not run to their end or it is not by the paper's index, the
plan by that for its box: what is known of the box is the same."
  (if (or (plan-tries plan) (unfinished-p plan) (not (eq (plan-index plan) :paper)))
      (plan (plan-box plan) :knowledge (plan-knowledge plan) :gamma (plan-gamma plan))
      plan))

(defun change-share (change)
  "Return how great CHANGE, that of a value, is, relative to the greater of the two."
  (relative-difference (change-from change) (change-limit change)))

(defun require-of (plan kind subject goal)
  "Return the REQUIREMENT of KIND for SUBJECT, with which GOAL is true of PLAN."
  (if (funcall (goal-test goal) plan)
      (make-requirement :plan plan :kind kind :subject subject :met t)
      (multiple-value-bind (changes stepped)
          (find-changes plan goal (remove nil *box-keys* :key #'box-key-words))
        (make-requirement :plan plan :kind kind :subject subject
                          :changes (stable-sort changes #'< :key #'change-share)
                          :faces (find-face-changes plan goal)
                          :facts (find-fact-changes plan goal)
                          :stepped stepped))))

(defun changeable-p (answer)
  "True if a change does what ANSWER, a requirement, is about."
  (or (requirement-changes answer) (requirement-faces answer) (requirement-facts answer)))

;;; What may be asked for

(defun negated-fact (form)
  "Return FORM without its words NOT and NO, and whether there is one."
  (let* ((form (canonical-fact form))
         (rest (and (consp form)
                    (remove-if (lambda (part) (and (namep part) (name-in part '("NOT" "NO"))))
                               form))))
    (if (and (consp form) (/= (length rest) (length form)))
        (values rest t)
        (values form nil))))

(defun require-fact (form plan)
  (multiple-value-bind (form negated) (negated-fact form)
    (multiple-value-bind (predicate face-list) (parse-fact form (plan-rulebase plan))
      (flet ((true-p (plan)
               (eq negated (not (recall (plan-memory plan) predicate face-list)))))
        (require-of plan :fact
                    (format nil "~:[~a~;not ~a~]" negated (fact-text predicate face-list))
                    (make-goal :test #'true-p))))))

(defun require-rule (rule plan)
  (require-of plan :rule (format nil "RULE ~a" (rule-name rule))
              (make-goal :test (lambda (plan) (refusal-fired (refuse-rule rule plan))))))

(defun check-searchable (plan)
  "Signal an ARGUMENT-ERROR if what makes a grasp the best of PLAN can't be searched for."
  (unless (eq (plan-index plan) :paper)
    (refuse-argument "what a grasp requires is searched for by the paper's index only, and this ~
                      plan is by the index ~s; ask of a plan by the paper's index: (requires grasp ~
                      (plan (plan-box plan)))" (plan-index plan))))

(defun require-grasp (grasp plan)
  (flet ((true-p (plan)
           (equal (grasp-name grasp) (plan-grasp plan)))
         (winner-p (prospect) (and prospect (eq grasp (prospect-grasp prospect)))))
    (let ((answer (require-of plan :grasp (grasp-name grasp)
                              (make-goal :test #'true-p :winner #'winner-p))))
      (unless (or (requirement-met answer) (changeable-p answer))
        (setf (requirement-possible answer)
              (require-of (try-only (grasp-name grasp) (plan-box plan)
                                    :knowledge (plan-knowledge plan) :gamma (plan-gamma plan))
                          :possible (grasp-name grasp)
                          (make-goal :test #'plan-best :winner #'identity))))
      answer)))

(defun explain-requirement (what &optional (plan (last-plan)))
  "Return the REQUIREMENT of the box of PLAN for WHAT: a fact, as '(SMALL (Y2 Y1)), which may have
NOT or NO among its words, or the name of a rule or a grasp, a symbol or a string."
  (let* ((given (need-plan plan))
         (plan (whole-plan given))
         (knowledge (plan-knowledge plan))
         (word (and (not (fact-form-p what)) (name-of what)))
         (rule (and word (find-rule (knowledge-rulebase knowledge) word)))
         (grasp (and word (find-grasp (knowledge-graspbase knowledge) word))))
    (plainly
      (cond ((fact-form-p what) (require-fact what plan))
            (rule (require-rule rule plan))
            (grasp (check-searchable given)
                   (require-grasp grasp plan))
            (t (error 'no-rule-error :name what :known (known-names knowledge)))))))

(defun requires (what &optional (plan (last-plan)))
  "Print and return the least changes of the box of PLAN with which WHAT would be so.  WHAT is a
fact that is to hold, as '(SMALL (Y2 Y1)), a rule that is to fire, or a grasp that is to be the
best.  Each change is of one value, of constrained faces, or of a declared fact."
  (print-answer (explain-requirement what plan)))

;;; In print

(defun requirement-phrases (kind)
  "Return what is said of a requirement of KIND that is met, of what would meet it, and if nothing
does."
  (ecase kind
    (:fact '("holds already" "would hold" "hold"))
    (:rule '("fires already" "would fire" "fire"))
    (:grasp '("is the best grasp already" "would be the best grasp" "the best grasp"))
    (:possible '("is possible, if it is tried" "would be possible, if it is tried," "possible"))))

(defmethod write-answer ((answer requirement) stream)
  (destructuring-bind (met would it) (requirement-phrases (requirement-kind answer))
    (let ((subject (requirement-subject answer)))
      (cond ((requirement-met answer) (format stream "~a ~a.~%" subject met))
            ((changeable-p answer)
             (format stream "~a ~a with one of these changes:~%" subject would)
             (dolist (change (requirement-changes answer))
               (write-value-change change answer stream))
             (dolist (change (requirement-faces answer))
               (write-face-change change answer stream))
             (dolist (change (requirement-facts answer))
               (write-fact-change change answer stream))
             (write-stepped (requirement-stepped answer) (requirement-plan answer) stream))
            (t (format stream "No change of one value, ~:[~;of one fact, ~]or of constrained ~
                               faces, makes ~a ~a.~%"
                       (declared-inputs (plan-knowledge (requirement-plan answer))) subject it)
               (write-stepped (requirement-stepped answer) (requirement-plan answer) stream)
               (when (requirement-possible answer)
                 (write-answer (requirement-possible answer) stream)))))))

(defun write-value-change (change answer stream)
  (destructuring-bind (what to from choice) (change-words change)
    (format stream "  ~a: ~a, not ~a~@[ (~{~a ~a, ~a~})~]~@[; then ~a~]~%" what to from
            (let ((threshold (change-threshold change)))
              (and threshold (list (first threshold) (second threshold)
                                   (change-text (third threshold) change))))
            (and (eq (requirement-kind answer) :grasp) choice))))

(defun write-face-change (change answer stream)
  (let ((freed (set-difference (change-from change) (change-to change) :test #'string=))
        (added (set-difference (change-to change) (change-from change) :test #'string=)))
    (format stream "  ~{~a~#[~; and ~:;, ~]~} ~:[constrained~;free~]~@[; then ~a~]~%"
            (sort (or freed added) #'string<) freed
            (and (eq (requirement-kind answer) :grasp) (choice-text (change-plan change))))))

(defun write-fact-change (change answer stream)
  (let* ((added (set-difference (change-to change) (change-from change) :test #'equal))
         (dropped (set-difference (change-from change) (change-to change) :test #'equal))
         (fact (first (or added dropped))))
    (format stream "  ~:[without~;with~] the fact (~{~a~^ ~})~@[; then ~a~]~%" added
            (loop for part in fact
                  collect (if (consp part) (format nil "(~{~a~^ ~})" part) part))
            (and (eq (requirement-kind answer) :grasp) (choice-text (change-plan change))))))

(defmethod topic ((explanation requirement))
  (requirement-subject explanation))
