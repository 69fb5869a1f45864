;;;; trace.lisp -- watching a run: levels of trace, traced rules and grasps, steps, breaks, counts.

(in-package :supergrip)

(defvar *trace-level* 1
  "What FORWARD-CHAIN prints: 0 nothing, 1 the paper's lines, 2 also which rules fire and with how
many bindings, 3 also every action and the candidates that fail, 4 also what meets each clause.")

(defvar *traced* '() "The names of the rules and grasps that are traced, strings.")
(defvar *breaks* '() "The names of rules and grasps, and the canonical facts, on which a run
stops.")

(defun check-trace-level (level)
  "Return the level of trace LEVEL, 0 for NIL."
  (cond ((null level) 0)
        ((typep level '(integer 0)) level)
        (t (refuse-argument "~a is not a trace level: levels go from 0 (nothing) to 4 (everything)"
                            (form-text level)))))

(defun check-name (name)
  "Return NAME as a string if it names a rule or a grasp, or signal a NO-RULE-ERROR."
  (let ((word (name-of name)))
    (if (and word (in-force-p word))
        word
        (error 'no-rule-error :name name :known (known-names *knowledge*)))))

(defun trace-rule (&rest names)
  "Trace the rules NAMES in full, whatever the level: at level 0, they alone are traced.  Returns
the names of all that is traced."
  (setf *traced* (union *traced* (mapcar #'check-name names) :test #'string=)))

(defun trace-grasp (&rest names)
  "Trace the grasps NAMES: show their candidates, also those that fail, whatever the level.  Returns
the names of all that is traced."
  (apply #'trace-rule names))

(defun untrace-rule (&rest names)
  "Stop tracing the rules NAMES.  Without NAMES, trace nothing any more, neither rules nor grasps.
Returns the names of all that is still traced."
  (setf *traced* (and names (set-difference *traced* (mapcar #'break-text names)
                                            :test #'string=))))

(defun untrace-grasp (&rest names)
  "Stop tracing the grasps NAMES.  Without NAMES, trace nothing any more, neither rules nor grasps.
Returns the names of all that is still traced."
  (apply #'untrace-rule names))

(defun break-on (what)
  "Stop a run of FORWARD-CHAIN in the debugger before the rule WHAT, a symbol or a string, after
each candidate of the grasp WHAT, or when the fact WHAT, as '(PARALLEL (Y2 Y1)), becomes known.
Returns all breaks."
  (unless (fact-form-p what)
    (check-name what))
  (pushnew (break-text what) *breaks* :test #'string=)
  *breaks*)

(defun break-text (what)
  "Return the text that stands for WHAT, a name or a fact with its faces in any order, among
*BREAKS*."
  (cond ((name-of what))
        ((consp what)
         (multiple-value-call #'sorted-fact-text
           (parse-fact what (knowledge-rulebase *knowledge*))))
        (t (refuse-argument "~a is not a break: a break is the name of a rule or a grasp, or a ~
                             fact, such as (PARALLEL (Y2 Y1))"
                            (form-text what)))))

(defun sorted-fact-text (predicate face-list)
  "Return the sentence of PREDICATE and the faces of FACE-LIST, these in alphabetic order."
  (plain-text "(~a~@[ (~{~a~^ ~})~])" (predicate-text predicate)
              (sort (copy-list (face-list-names face-list)) #'string<)))

(defun unbreak (&optional (what nil given))
  "Take back (BREAK-ON WHAT), or all breaks without WHAT.  Returns the breaks that are left."
  (setf *breaks* (and given (remove (break-text what) *breaks* :test #'string=))))

;;; Stops

(define-condition chain-break (condition)
  ((text :initarg :text :reader chain-break-text))
  (:report (lambda (condition stream) (write-string (chain-break-text condition) stream)))
  (:documentation "A run stopped where it was asked to.  Restarts: NEXT-RULE goes on to the next
rule, CONTINUE to the next break."))

(defvar *stepping* nil "True while a run stops before every rule.")

(defun pause (plan control &rest arguments)
  "Stop in the debugger, saying what CONTROL and ARGUMENTS say; questions asked there are about
PLAN."
  (let ((condition (make-condition 'chain-break :text (apply #'plain-text control arguments)))
        (*plan* plan))
    (restart-case (progn (signal condition) (invoke-debugger condition))
      (next-rule ()
        :report "Go on to the next rule."
        (setf *stepping* t))
      (continue ()
        :report "Go on to the next break."
        (setf *stepping* nil)))))

(defun broken-p (name)
  "True if NAME is that of a rule or a grasp to stop on."
  (member name *breaks* :test #'string=))

(defun fact-broken-p (event rulebase)
  "True if the fact of EVENT is one to stop on, its faces in any order."
  (and *breaks*
       (member (multiple-value-call #'sorted-fact-text (event-fact event rulebase)) *breaks*
               :test #'string=)))

(defun next-rule ()
  "Invoke the restart NEXT-RULE: go on to the next rule and stop there."
  (invoke-restart 'next-rule))

;;; Lines

(defun traced-p (name) (member name *traced* :test #'string=))

(defun write-clause-matches (rule memory stream)
  "Write what meets the clauses of RULE, one after the other."
  (loop for clause in (rule-clauses rule)
        for count from 1
        for bindings = (prefix-bindings rule count memory)
        do (format stream "    clause ~d, ~a: ~:[nothing~;~:*~{~a~^; ~}~]~%" count
                   (form-text (clause-form clause))
                   (and bindings
                        (mapcar (lambda (binding)
                                  (let ((text (binding-text rule binding)))
                                    (if (string= text "") "holds" text)))
                                bindings)))
        while bindings))

(defun write-failed-candidate (candidate plan stream)
  (multiple-value-bind (step text) (candidate-failure candidate plan)
    (format stream "  (~a FAILS AT ~a, MATCHING: (~{~a~^ ~})): ~a~%" (candidate-grasp candidate)
            (symbol-name step) (candidate-matching candidate) text)))

(defun write-tried (candidate plan level traced stream)
  "Write CANDIDATE of PLAN as LEVEL asks; in full if its grasp, or the rule that tried it, is
TRACED."
  (let ((traced (or traced (traced-p (candidate-grasp candidate)))))
    (if (candidate-quality candidate)
        (when (or traced (plusp level)) (write-candidate candidate stream))
        (when (or traced (>= level 3)) (write-failed-candidate candidate plan stream)))))

(defun write-additions (log plan in-hand level traced stream)
  "Write LOG, what an action of PLAN added to the log, of a rule that is TRACED or not.  IN-HAND
returns the plan as it is now."
  (do-log (log)
    (candidate
     (write-tried candidate plan level traced stream)
     (when (broken-p (candidate-grasp candidate))
       (pause (funcall in-hand) "~a (~{~a~^ ~}) was tried: ~:[it fails at ~a~;it is possible~]"
              (candidate-grasp candidate) (candidate-matching candidate)
              (candidate-quality candidate) (symbol-name (candidate-outcome candidate)))))
    (event
     (when (or traced (plusp level))
       (write-event event (plan-rulebase plan) stream))
     (when (fact-broken-p event (plan-rulebase plan))
       (pause (funcall in-hand)
              "~a is known" (multiple-value-call #'fact-text
                              (event-fact event (plan-rulebase plan))))))))

(defun trace-observer (plan memory level stream)
  "Return an observer of the run of PLAN on MEMORY, under way, that writes to STREAM what LEVEL asks
for."
  (flet ((full-p (rule needed) (or (>= level needed) (traced-p (rule-name rule)))))
    (lambda (what &rest arguments)
      (ecase what
        (:rule (let ((rule (first arguments)))
                 (when (or *stepping* (broken-p (rule-name rule)))
                   (pause (plan-in-hand plan memory rule nil)
                          "before ~a" (form-text (rule-form rule))))
                 (when (full-p rule 4)
                   (format stream "  RULE ~a~%" (rule-name rule))
                   (write-clause-matches rule memory stream))))
        (:bindings (destructuring-bind (rule bindings) arguments
                     (when (full-p rule 2)
                       (format stream "  RULE ~a ~:[does not fire~;fires: ~:*~d binding~:p~]~%"
                               (rule-name rule) (and bindings (length bindings))))))
        (:action (destructuring-bind (rule action binding added) arguments
                   (when (full-p rule 3)
                     (format stream "    ~a~@[ with ~a~]~:[~;: nothing left to try~]~%"
                             (form-text (action-form action))
                             (let ((text (binding-text rule binding)))
                               (and (plusp (length text)) text))
                             (and (null added) (grasp-p (action-target action)))))
                   (write-additions added plan (lambda () (plan-in-hand plan memory rule t))
                                    level (traced-p (rule-name rule)) stream)))
        (:stop nil)))))

(defun observed-plan (box knowledge gamma make-observer &rest arguments &key (index :paper)
                                                          &allow-other-keys)
  "Return the plan for BOX; its run is watched by what MAKE-OBSERVER returns for the unfinished plan
and the memory that the rules run on.  RUN-OBSERVED gets the other ARGUMENTS."
  (with-plain-floats
    (let* ((memory (start-plan box knowledge gamma index))
           (workspace (memory-client memory))
           (unfinished (%make-plan :box (workspace-box workspace) :knowledge knowledge
                                   :gamma (workspace-gamma workspace) :index index)))
      (finish-plan memory knowledge
                   (apply #'run-observed (knowledge-rulebase knowledge) memory
                          (funcall make-observer unfinished memory)
                          (uiop:remove-plist-key :index arguments))))))

(defun plan-in-hand (plan memory rule begun)
  "Return PLAN, unfinished, as it is now on MEMORY: before RULE or, if that has BEGUN, within it."
  (%make-plan :box (plan-box plan) :knowledge (plan-knowledge plan) :gamma (plan-gamma plan)
              :index (plan-index plan)
              :stop (make-stop :verdict (if begun :within :before) :rule rule)
              :best (best-so-far memory)
              :entries (reverse (memory-log memory)) :facts (save-facts memory)))

(defun traced-plan (box knowledge gamma index level step stream)
  "Return the plan for BOX, writing to STREAM what LEVEL and the traced names ask for as it comes."
  (let* ((*stepping* step)
         (plan (observed-plan box knowledge gamma
                              (lambda (plan memory)
                                (trace-observer plan memory level stream))
                              :index index)))
    (when (plusp level)
      (write-verdict plan stream)
      (format stream "--END--~%"))
    plan))

;;; Counts

(defun rule-counts (&optional (plan (last-plan)))
  "Print and return how often each rule of PLAN was matched and fired: a list of (NAME MATCHES
FIRINGS FACTS), empty if no rule ran.  MATCHES counts the bindings that met its first clause, its
first two, and so on; FIRINGS its bindings; FACTS what it added."
  (let* ((plan (need-plan plan))
         (counts (and (not (plan-tries plan)) (count-rules plan))))
    (format t "~12a ~8@a ~8@a ~8@a~%" "rule" "matches" "firings" "facts")
    (format t "~:{~12a ~8d ~8d ~8d~%~}" counts)
    counts))

(defun count-rules (plan)
  "Return what RULE-COUNTS does, from running the rules again as far as PLAN has come."
  (let ((counts '()) (rulebase (plan-rulebase plan)))
    (flet ((facts (rule)
             (count rule (plan-events plan) :key (lambda (event) (event-rule event rulebase)))))
      (observed-plan (plan-box plan) (plan-knowledge plan) (plan-gamma plan)
                     (lambda (unfinished memory)
                       (declare (ignore unfinished))
                       (lambda (what &rest arguments)
                         (case what
                           (:rule (push (list (rule-name (first arguments))
                                              (count-matches (first arguments) memory)
                                              0 (facts (first arguments)))
                                        counts))
                           (:bindings (setf (third (first counts))
                                            (length (second arguments)))))))
                     :end (count-if (lambda (rule) (reached-p rule plan))
                                    (rulebase-rules rulebase))))
    (nreverse counts)))

(defun count-matches (rule memory)
  (loop for count from 1 to (length (rule-clauses rule))
        sum (length (prefix-bindings rule count memory))))
