;;;; derivation.lisp -- how a fact came to be known: the tree of rules, bindings and facts down to
;;;; the box.
;;;;
;;;; The log of a plan holds the rule, the action and the binding of every fact, so nothing has to
;;;; be recorded for this while planning.

(in-package :supergrip)

(defstruct (derivation (:include explanation))
  "How a fact is known.  PREDICATE and FACE-LIST are the fact; RULE the rule that remembered it,
under BINDING, NIL for an input; PARTS what met its clauses, DERIVATIONs and ASSUMPTIONs; NOTE, for
an input, where it comes from."
  predicate face-list rule binding (parts '()) note)

(defun derivation-faces (derivation)
  "Return the names of the faces of the fact that DERIVATION is about, a list of strings."
  (face-list-names (derivation-face-list derivation)))

(defstruct assumption
  "A negation that was met: nothing said PREDICATE of the faces of FACE-LIST when RULE was tried."
  predicate face-list rule)

(defun fact-event (plan predicate face-list)
  "Return the event that remembered the fact in PLAN, or NIL."
  (find-if (lambda (event)
             (multiple-value-bind (other faces) (event-fact event (plan-rulebase plan))
               (and (eq other predicate)
                    (= (face-list-mask faces) (face-list-mask face-list)))))
           (plan-events plan)))

(defun input-note (predicate face-list plan)
  "Return why the preliminary assertion PREDICATE of FACE-LIST holds in PLAN."
  (let ((input (find predicate (knowledge-inputs (plan-knowledge plan))
                     :key #'prepared-input-predicate)))
    (if input
        (let ((*units* (%box-units (plan-box plan))))
          (funcall (input-row-note (prepared-input-row input))
                   face-list (plan-box plan) (prepared-input-threshold input)))
        "the box says so")))

;;; A fact follows only from what was known before it, so the derivations of a whole log are made in
;;; its order, each from those before: however long a chain is, nothing nests.

(defun fact-key (predicate face-list)
  (+ (* 64 (predicate-index predicate)) (face-list-mask face-list)))

(defun derivations (plan)
  "Return a table from FACT-KEYs to the derivations of all that the rules of PLAN remembered."
  (let ((table (make-hash-table)) (rulebase (plan-rulebase plan)) (memory (plan-memory plan)))
    (dolist (event (plan-events plan) table)
      (multiple-value-bind (predicate face-list) (event-fact event rulebase)
        (let ((rule (event-rule event rulebase)) (binding (event-binding event)))
          (setf (gethash (fact-key predicate face-list) table)
                (make-derivation :predicate predicate :face-list face-list :rule rule
                                 :binding binding
                                 :parts (loop for clause in (rule-clauses rule)
                                              collect (clause-part clause rule binding table
                                                                   memory plan)))))))))

(defun clause-part (clause rule binding table memory plan)
  "Return what met CLAUSE of RULE under BINDING: a derivation, from TABLE if it has it, or an
assumption."
  (let ((face-list (instantiate (clause-terms clause) binding)))
    (if (clause-negated clause)
        (make-assumption :predicate (clause-predicate clause) :face-list face-list :rule rule)
        (derivation-in table (clause-predicate clause) face-list memory plan))))

(defun derivation-in (table predicate face-list memory plan)
  "Return the derivation of a fact that MEMORY holds: from TABLE, or, for an input, a new one."
  (or (gethash (fact-key predicate face-list) table)
      (make-derivation :predicate predicate
                       :face-list (find (face-list-mask face-list) (facts memory predicate)
                                        :key #'face-list-mask)
                       :note (input-note predicate face-list plan))))

(defun derive (plan predicate face-list)
  "Return the derivation of a fact that is known at the end of PLAN."
  (derivation-in (derivations plan) predicate face-list (plan-memory plan) plan))

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
          (format stream "~d more derived fact~:p in this tree ~:*~[~;is~:;are~] left out."
                  left))))))

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
          (fact-text (assumption-predicate assumption) (assumption-face-list assumption))
          (rule-name (assumption-rule assumption))))

(defmethod topic ((explanation derivation))
  (fact-text (derivation-predicate explanation) (derivation-face-list explanation)))
