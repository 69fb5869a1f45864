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

(defparameter +later-plan+
  "The knowledge in force has it, but the plan was made before: call (forward-chain) again."
  "What is said of a name that a plan's knowledge lacks.")

(define-condition no-rule-error (supergrip-error)
  ((name :initarg :name) (known :initarg :known) (hint :initarg :hint :initform nil))
  (:report (lambda (condition stream)
             (with-slots (name known hint) condition
               (cond (hint (format stream "~a is ~a" (form-text name) hint))
                     ((null (name-of name))
                      (format stream "~a is no name: rules and grasps are named by symbols or strings"
                              (form-text name)))
                     (t (format stream "there is no rule or grasp ~a~a; there are ~a~@[~%~a~]"
                                (form-text (make-symbol (name-of name)))
                                (suggestion (name-of name) known) (listed known)
                                (and (in-force-p (name-of name)) +later-plan+)))))))
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

(defmethod write-answer :around (answer stream)
  (declare (ignorable answer stream))
  (plainly (call-next-method)))

(defun print-answer (object)
  "Print OBJECT, an explanation, and return it."
  (write-answer object *standard-output*)
  (fresh-line)
  object)

(defun plan-rulebase (plan)
  (knowledge-rulebase (plan-knowledge plan)))

(defun fact-text (predicate packed)
  "Return the sentence of PREDICATE and the faces of PACKED as a list in print."
  (plain-text "(~a~@[ (~{~a~^ ~})~])" (predicate-text predicate) (pack-names packed)))

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
  "Return why the preliminary assertion PREDICATE of PACKED holds in PLAN."
  (let ((input (find predicate (knowledge-inputs (plan-knowledge plan))
                     :key #'prepared-input-predicate)))
    (if input
        (funcall (input-row-note (prepared-input-row input))
                 packed (plan-box plan) (prepared-input-threshold input))
        "an input")))

;;; A fact follows only from what was known before it, so the derivations of a whole log are made in its
;;; order, each from those before: however long a chain is, nothing nests.

(defun fact-key (predicate packed)
  (+ (* 64 (predicate-index predicate)) (pack-mask packed)))

(defun derivations (plan)
  "Return a table from FACT-KEYs to the derivations of all that the rules of PLAN remembered."
  (let ((table (make-hash-table)) (rulebase (plan-rulebase plan)) (memory (plan-memory plan)))
    (dolist (event (plan-log plan) table)
      (when (integerp event)
        (multiple-value-bind (predicate packed) (event-fact event rulebase)
          (let ((rule (event-rule event rulebase)) (binding (event-binding event)))
            (setf (gethash (fact-key predicate packed) table)
                  (make-derivation :predicate predicate :packed packed :rule rule :binding binding
                                   :parts (loop for clause in (rule-clauses rule)
                                                collect (clause-part clause rule binding table
                                                                     memory plan))))))))))

(defun clause-part (clause rule binding table memory plan)
  "Return what met CLAUSE of RULE under BINDING: a derivation, from TABLE if it has it, or an
assumption."
  (let ((packed (instantiate (clause-terms clause) binding)))
    (if (clause-negated clause)
        (make-assumption :predicate (clause-predicate clause) :packed packed :rule rule)
        (derivation-in table (clause-predicate clause) packed memory plan))))

(defun derivation-in (table predicate packed memory plan)
  "Return the derivation of a fact that MEMORY holds: from TABLE, or, for an input, a new one."
  (or (gethash (fact-key predicate packed) table)
      (make-derivation :predicate predicate
                       :packed (find (pack-mask packed) (facts memory predicate) :key #'pack-mask)
                       :note (input-note predicate packed plan))))

(defun derive (plan predicate packed)
  "Return the derivation of a fact that is known at the end of PLAN."
  (derivation-in (derivations plan) predicate packed (plan-memory plan) plan))

(defun spelled (object)
  "Return what OBJECT, a string, spells: its one list, or the list of what stands in it.  Anything else
is returned as it is, and so is a string that can't be read."
  (if (stringp object)
      (let ((forms (handler-case (read-all (string-source object))
                     (syntax-error () (list object)))))
        (if (consp (first forms)) (first forms) forms))
      object))

(defun word-text (object)
  "Return the letters of OBJECT, a name or a string, as our reader would read them; else NIL."
  (and (or (namep object) (stringp object)) (string-upcase object)))

(defun canonical-fact (form)
  "Return FORM, which may be a string or hold strings, as our reader would have read it, or signal a
NO-FACT-ERROR."
  (handler-case (let ((form (canonical (spelled form))))
                  (labels ((walk (part)
                             (cond ((stringp part) (canonical-name (string-upcase part)))
                                   ((consp part) (mapcar #'walk part))
                                   (t part))))
                    (walk form)))
    (syntax-error (condition)
      (error 'no-fact-error :form form
                            :text (plain-text "~a; a fact is a list, as (PARALLEL (Y2 Y1))"
                                              (problem-text
                                               (first (input-error-problems condition))))))))

(defun parse-fact (form rulebase)
  "Return the predicate and the packed faces that FORM, as (PARALLEL (Y2 Y1)), means in RULEBASE.  FORM
may be a string, or have strings for names."
  (let* ((form (canonical-fact form))
         (lists (and (consp form) (remove-if-not #'consp form)))
         (words (and (consp form) (loop for word in form when (namep word)
                                        collect (symbol-name word))))
         (predicate (find-predicate rulebase words))
         (faces (loop for face in (first lists)
                      collect (and (namep face) (surface-index face)))))
    (flet ((refuse (control &rest arguments)
             (error 'no-fact-error :form form :text (apply #'plain-text control arguments)))
           (known () (map 'list #'predicate-text (rulebase-predicates rulebase))))
      (cond ((null words)
             (refuse "a fact is a list, as (PARALLEL (Y2 Y1)) or (OBJECT HAS FREE CORNERS)"))
            ((intersection '("NOT" "NO") words :test #'string=)
             (refuse "ask about the sentence without NOT or NO"))
            ((and (null lists) (find-if #'loose-surface-p form))
             (refuse "surfaces stand in a list of their own: ~a" (form-text (list-surfaces form))))
            ((rest lists) (refuse "ask about one list of surfaces at a time"))
            ((find-if-not #'namep (remove-if #'consp form))
             (refuse "~a can't stand in a fact"
                     (form-text (find-if-not #'namep (remove-if #'consp form)))))
            ((null predicate)
             (refuse "nothing speaks of ~{~a~^ ~}~a; known are ~a" words
                     (suggestion (format nil "~{~a~^ ~}" words) (known)) (listed (known))))
            ((or (member nil faces) (/= (length faces) (length (remove-duplicates faces)))
                 (/= (length faces) (predicate-arity predicate)))
             (refuse "~a takes ~[no surfaces~;one surface~:;~:*~d different surfaces~] of X1 X2 Y1 ~
                      Y2 Z1 Z2" (predicate-text predicate) (predicate-arity predicate)))
            (t (values predicate (pack faces)))))))

(defstruct (unknown-fact (:include explanation))
  "A fact that is not known at the end of a plan.  REFUSALS says why each rule that could have
derived it did not, of many rules for the first; MORE is how many are left out."
  predicate packed refusals (more 0))

(defparameter +most-refusals+ 20 "Of how many rules an answer says why they did not fire.")

(defun explain-fact (form &optional (plan *plan*))
  "Return how the fact FORM came to be known in PLAN: a DERIVATION, or an UNKNOWN-FACT."
  (let ((plan (need-plan plan)))
    (multiple-value-bind (predicate packed) (parse-fact form (plan-rulebase plan))
      (plainly
        (if (recall (plan-memory plan) predicate packed)
            (derive plan predicate packed)
            (let* ((rules (deriving-rules predicate plan))
                   (most (min +most-refusals+ (length rules))))
              (make-unknown-fact :predicate predicate :packed packed
                                 :more (- (length rules) most)
                                 :refusals (loop for rule in (subseq rules 0 most)
                                                 collect (refuse-conclusion rule predicate packed
                                                                            plan)))))))))

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
  (write-tree answer stream 0))

(defparameter +most-lines+ 400 "How many lines of a tree are written.")
(defparameter +most-depth+ 50 "How deep a tree is written.")

(defun write-tree (derivation stream depth)
  "Write DERIVATION and what it follows from, at DEPTH, each fact once.  Of a great tree a part is
written, and how much is left out."
  (let ((told (make-hash-table :test #'eq)) (lines 0))
    (labels ((write-it (derivation level)
               (incf lines)
               (write-indent stream level)
               (write-string (topic derivation) stream)
               (cond ((null (derivation-rule derivation))
                      (format stream ": input, ~a" (derivation-note derivation)))
                     ((gethash derivation told) (write-string ": as above" stream))
                     ((>= (- level depth) +most-depth+)
                      (format stream ": ask (how '~a)" (topic derivation)))
                     (t (setf (gethash derivation told) t)
                        (write-rule-line derivation stream)
                        (dolist (part (derivation-parts derivation))
                          (when (< lines +most-lines+)
                            (if (assumption-p part)
                                (progn (incf lines) (write-assumption part stream (1+ level)))
                                (write-it part (1+ level)))))))))
      (write-it derivation depth)
      (let ((left (- (count-derived derivation) (hash-table-count told))))
        (when (plusp left)
          (write-indent stream depth)
          (format stream "~d more derived fact~:p in this tree ~:*~[~;is~:;are~] left out." left))))))

(defun count-derived (derivation)
  "Return how many facts the tree of DERIVATION derives by rules."
  (let ((seen (make-hash-table :test #'eq)) (left (list derivation)))
    (loop while left
          do (let ((next (pop left)))
               (when (and (derivation-p next) (derivation-rule next) (not (gethash next seen)))
                 (setf (gethash next seen) t)
                 (dolist (part (derivation-parts next)) (push part left)))))
    (hash-table-count seen)))

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
      (write-refusals (unknown-fact-refusals answer) (unknown-fact-more answer) stream)
      (format stream "It is an input, which this box does not give.~%")))

;;; In print

(defmethod topic ((explanation derivation))
  (fact-text (derivation-predicate explanation) (derivation-packed explanation)))

(defmethod topic ((explanation unknown-fact))
  (fact-text (unknown-fact-predicate explanation) (unknown-fact-packed explanation)))
