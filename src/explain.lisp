;;;; explain.lisp -- how a fact came to be known.
;;;;
;;;; Each answer is an object; WRITE-ANSWER prints it, and HOW and WHY-NOT do both.  A log of a plan
;;;; holds the rule, the action and the binding of every fact, so nothing has to be recorded for
;;;; this while planning.

(in-package :supergrip)

(define-condition no-fact-error (supergrip-error)
  ((form :initarg :form) (text :initarg :text))
  (:report (lambda (condition stream)
             (with-slots (form text) condition
               (format stream "~a is no fact that could be known: ~a" (form-text form) text))))
  (:documentation "A question was asked about a sentence that no rule or input speaks of."))

(define-condition no-rule-error (supergrip-error)
  ((name :initarg :name) (known :initarg :known) (hint :initarg :hint :initform nil))
  (:report (lambda (condition stream)
             (with-slots (name known hint) condition
               (if hint
                   (format stream "~a is ~a" name hint)
                   (format stream "there is no rule or grasp ~a~a; there are ~{~a~^, ~}~@[~%~a~]"
                           name (suggestion (string-upcase name) known) known
                           (and (in-force-p name)
                                "The knowledge in force has it, but the plan was made before: call (forward-chain) again."))))))
  (:documentation "A question was asked about a name that is neither a rule's nor a grasp's."))

(defstruct explanation "What all answers to a question have in common.")

(defgeneric topic (explanation)
  (:documentation "Return what EXPLANATION is about, a string."))

(defmethod print-object ((explanation explanation) stream)
  (print-unreadable-object (explanation stream :type t)
    (write-string (topic explanation) stream)))

(defun known-names (knowledge)
  "Return the names of the rules and the grasps of KNOWLEDGE."
  (append (mapcar #'rule-name (knowledge-rules knowledge))
          (mapcar #'grasp-name (knowledge-grasps knowledge))))

(defun in-force-p (name)
  "True if the knowledge in force has a rule or a grasp NAME."
  (or (find-rule (knowledge-rulebase *knowledge*) name)
      (find-grasp (knowledge-graspbase *knowledge*) name)))

(defgeneric write-answer (answer stream)
  (:documentation "Write ANSWER, an explanation, to STREAM in words."))

(defun print-answer (object)
  "Print OBJECT, an explanation, and return it."
  (write-answer object *standard-output*)
  (fresh-line)
  object)

(defun plan-rulebase (plan)
  (knowledge-rulebase (plan-knowledge plan)))

(defun fact-text (predicate packed)
  "Return the sentence of PREDICATE and the faces of PACKED as a list in print."
  (format nil "(~a~@[ (~{~a~^ ~})~])" (predicate-text predicate) (pack-names packed)))

(defun write-indent (stream depth)
  (fresh-line stream)
  (loop repeat depth do (write-string "  " stream)))

;;; HOW

(defstruct (derivation (:include explanation))
  "How a fact is known.  PREDICATE and PACKED are the fact; RULE the rule that remembered it, under
BINDING, NIL for an input; PARTS what met its clauses, DERIVATIONs and ASSUMPTIONs; NOTE, for an
input, where it comes from."
  predicate packed rule binding (parts '()) note)

(defstruct assumption
  "A negation that was met: nothing said PREDICATE of the faces of PACKED when RULE was tried."
  predicate packed rule)

(defun fact-event (plan predicate packed)
  "Return the event that remembered the fact in PLAN, or NIL."
  (find-if (lambda (event)
             (and (integerp event)
                  (multiple-value-bind (other faces) (event-fact event (plan-rulebase plan))
                    (and (eq other predicate) (= (pack-mask faces) (pack-mask packed))))))
           (plan-log plan)))

(defun input-note (predicate packed plan)
  "Return where the input fact of PREDICATE and PACKED in PLAN comes from."
  (let* ((knowledge (plan-knowledge plan))
         (box (plan-box plan))
         (word (first (predicate-words predicate)))
         (size (and (plusp (pack-count packed))
                    (aref (%box-size box) (surface-axis (first (pack-elements packed)))))))
    (flet ((apart (relation name limit)
             (format nil "they are ~a cm apart, ~a ~a, ~a" (figure size) relation name
                     (figure limit))))
      (cond ((string= word "OPPOSED") "opposite faces of the box")
            ((string= word "CONSTRAINED") "the box says so")
            ((string= word "SMALL") (apart "less than" "FINGER-WIDTH" (knowledge-finger-width knowledge)))
            ((string= word "NARROW")
             (apart "less than" "FINGER-SPREAD" (knowledge-finger-spread knowledge)))
            ((string= word "LARGE") (apart "no less than" "DIST-PINCH" (knowledge-dist-pinch knowledge)))
            ((string= word "SLIPPERY")
             (format nil "u is ~a, no more than SLIPPERY-U, ~a" (figure (%box-u box))
                     (figure (knowledge-slippery-u knowledge))))
            (t "an input")))))

(defvar *derived* nil "A table from facts to their derivations, while a derivation is made, or NIL.")

(defun derive (plan predicate packed)
  "Return the derivation of a fact that is known at the end of PLAN."
  (let ((*derived* (or *derived* (make-hash-table :test #'equal)))
        (fact (cons (predicate-index predicate) (pack-mask packed))))
    ;; What many facts follow from is derived once.
    (or (gethash fact *derived*)
        (setf (gethash fact *derived*)
              (let ((event (fact-event plan predicate packed)))
                (if event
                    (derive-event event plan)
                    (derive-input predicate packed plan)))))))

(defun derive-input (predicate packed plan)
  (make-derivation :predicate predicate
                   :packed (find (pack-mask packed) (facts (plan-memory plan) predicate)
                                 :key #'pack-mask)
                   :note (input-note predicate packed plan)))

(defun derive-event (event plan)
  (let ((rule (event-rule event (plan-rulebase plan)))
        (binding (event-binding event)))
    (multiple-value-bind (predicate packed) (event-fact event (plan-rulebase plan))
      (make-derivation :predicate predicate :packed packed :rule rule :binding binding
                       :parts (loop for clause in (rule-clauses rule)
                                    collect (clause-part clause rule binding plan))))))

(defun clause-part (clause rule binding plan)
  "Return what met CLAUSE of RULE under BINDING."
  (let ((packed (instantiate (clause-terms clause) binding)))
    (if (clause-negated clause)
        (make-assumption :predicate (clause-predicate clause) :packed packed :rule rule)
        (derive plan (clause-predicate clause) packed))))

(defun parse-fact (form rulebase)
  "Return the predicate and the packed faces that FORM, as (PARALLEL (Y2 Y1)), means in RULEBASE."
  (let* ((form (canonical form))
         (list (and (consp form) (find-if #'consp form)))
         (words (and (consp form) (loop for word in form when (namep word)
                                        collect (symbol-name word))))
         (predicate (find-predicate rulebase words))
         (faces (loop for face in list collect (and (namep face) (surface-index face)))))
    (flet ((refuse (control &rest arguments)
             (error 'no-fact-error :form form :text (apply #'plain-text control arguments))))
      (cond ((null words)
             (refuse "a fact is a list, as (PARALLEL (Y2 Y1)) or (OBJECT HAS FREE CORNERS)"))
            ((or (member "NOT" words :test #'string=) (member "NO" words :test #'string=))
             (refuse "ask about the sentence without NOT or NO"))
            ((and (null list) (find-if #'loose-surface-p form))
             (refuse "surfaces stand in a list of their own: ~a" (form-text (list-surfaces form))))
            ((null predicate)
             (refuse "nothing speaks of ~{~a~^ ~}~a; known are ~{~a~^, ~}" words
                     (suggestion (format nil "~{~a~^ ~}" words)
                                 (map 'list #'predicate-text (rulebase-predicates rulebase)))
                     (map 'list #'predicate-text (rulebase-predicates rulebase))))
            ((or (member nil faces) (/= (length faces) (length (remove-duplicates faces)))
                 (/= (length faces) (predicate-arity predicate)))
             (refuse "~a takes ~[no surfaces~;one surface~:;~:*~d different surfaces~] of X1 X2 Y1 ~
                      Y2 Z1 Z2" (predicate-text predicate) (predicate-arity predicate)))
            (t (values predicate (pack faces)))))))

(defstruct (unknown-fact (:include explanation))
  "A fact that is not known at the end of a plan.  REFUSALS says why each rule that could have
derived it did not."
  predicate packed refusals)

(defun explain-fact (form &optional (plan *plan*))
  "Return how the fact FORM came to be known in PLAN: a DERIVATION, or an UNKNOWN-FACT."
  (let ((plan (need-plan plan)))
    (multiple-value-bind (predicate packed) (parse-fact form (plan-rulebase plan))
      (if (recall (plan-memory plan) predicate packed)
          (derive plan predicate packed)
          (make-unknown-fact :predicate predicate :packed packed
                             :refusals (loop for rule in (deriving-rules predicate plan)
                                             collect (refuse-conclusion rule predicate packed
                                                                        plan)))))))

(defun how (fact &optional (plan *plan*))
  "Print and return how FACT, as '(PARALLEL (Y2 Y1)), came to be known in PLAN: the tree of rules,
bindings and facts down to the box; negations as assumed when they were tested."
  (print-answer (explain-fact fact plan)))

(defun deriving-rules (predicate plan)
  "Return the rules of PLAN that remember PREDICATE."
  (loop for rule across (rulebase-rules (plan-rulebase plan))
        when (find predicate (rule-actions rule) :key #'action-predicate)
          collect rule))

(defmethod write-answer ((answer derivation) stream)
  (write-derivation answer stream 0 '()))

(defun write-derivation (derivation stream depth seen)
  "Write DERIVATION at DEPTH.  Returns the derivations written so far, SEEN first: what is told once
is not told again."
  (let ((text (fact-text (derivation-predicate derivation) (derivation-packed derivation))))
    (write-indent stream depth)
    (write-string text stream)
    (cond ((null (derivation-rule derivation))
           (format stream ": input, ~a" (derivation-note derivation))
           seen)
          ((member text seen :test #'string=)
           (write-string ": as above" stream)
           seen)
          (t
           (write-rule-line derivation stream)
           (push text seen)
           (dolist (part (derivation-parts derivation) seen)
             (if (assumption-p part)
                 (write-assumption part stream (1+ depth))
                 (setf seen (write-derivation part stream (1+ depth) seen))))))))

(defun write-rule-line (derivation stream)
  (let ((binding (binding-text (derivation-rule derivation) (derivation-binding derivation))))
    (format stream ": RULE ~a~:[ with ~a~;~*~]" (rule-name (derivation-rule derivation))
            (string= binding "") binding)))

(defun write-assumption (assumption stream depth)
  (write-indent stream depth)
  (format stream "not ~a: assumed, nothing had said so when ~a was tried"
          (fact-text (assumption-predicate assumption) (assumption-packed assumption))
          (rule-name (assumption-rule assumption))))

(defmethod write-answer ((answer unknown-fact) stream)
  (format stream "~a is not known.~%"
          (fact-text (unknown-fact-predicate answer) (unknown-fact-packed answer)))
  (if (unknown-fact-refusals answer)
      (dolist (refusal (unknown-fact-refusals answer))
        (write-answer refusal stream))
      (format stream "It is an input, which this box does not give.~%")))

;;; In print

(defmethod topic ((explanation derivation))
  (fact-text (derivation-predicate explanation) (derivation-packed explanation)))

(defmethod topic ((explanation unknown-fact))
  (fact-text (unknown-fact-predicate explanation) (unknown-fact-packed explanation)))
