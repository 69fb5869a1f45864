;;;; how.lisp -- how a fact came to be known, or why it is not known.

(in-package :supergrip)

(define-condition no-fact-error (supergrip-error)
  ((form :initarg :form) (text :initarg :text))
  (:report (lambda (condition stream)
             (with-slots (form text) condition
               (format stream "~a is not a fact that could be known: ~a" (form-text form) text))))
  (:documentation "A question was asked about a sentence that no rule or input speaks of."))

(defun deriving-rules (predicate plan)
  "Return the rules of PLAN that remember PREDICATE."
  (loop for rule across (rulebase-rules (plan-rulebase plan))
        when (find predicate (rule-actions rule) :key #'action-predicate)
          collect rule))

(defun spelled (object)
  "Return what OBJECT, a string, spells: its one list, or the list of what stands in it.  Anything
else is returned as it is, and so is a string that can't be read."
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
                            :text (plain-text "~a; a fact is a list, such as (PARALLEL (Y2 Y1))"
                                              (problem-text
                                               (first (input-error-problems condition))))))))

(defun parse-fact (form rulebase)
  "Return the predicate and the face list that FORM, as (PARALLEL (Y2 Y1)), means in RULEBASE.  FORM
may be a string, or have strings for names."
  (let* ((form (canonical-fact form))
         (lists (and (consp form) (remove-if-not #'consp form)))
         (words (and (consp form) (loop for word in form when (namep word)
                                        collect (symbol-name word))))
         (predicate (find-predicate rulebase words))
         (faces (loop for face in (first lists)
                      collect (and (namep face) (face-index face)))))
    (flet ((refuse (control &rest arguments)
             (error 'no-fact-error :form form :text (apply #'plain-text control arguments)))
           (known () (map 'list #'predicate-text (rulebase-predicates rulebase))))
      (cond ((null words)
             (refuse "a fact is a list, such as (PARALLEL (Y2 Y1)) or (OBJECT HAS FREE CORNERS)"))
            ((intersection '("NOT" "NO") words :test #'string=)
             (refuse "ask about the sentence without NOT or NO"))
            ((and (null lists) (find-if #'loose-surface-p form))
             (refuse "surfaces go in a list of their own: ~a" (form-text (list-surfaces form))))
            ((rest lists) (refuse "ask about one list of surfaces at a time"))
            ((find-if-not #'namep (remove-if #'consp form))
             (refuse "~a is not allowed in a fact"
                     (form-text (find-if-not #'namep (remove-if #'consp form)))))
            ((null predicate)
             (refuse "nothing speaks of ~{~a~^ ~}~a; known are ~a" words
                     (suggestion (format nil "~{~a~^ ~}" words) (known)) (listed (known))))
            ((or (member nil faces) (/= (length faces) (length (remove-duplicates faces)))
                 (/= (length faces) (predicate-arity predicate)))
             (refuse "~a takes ~[no surfaces~;one surface~:;~:*~d different surfaces~] of X1 X2 Y1 ~
                      Y2 Z1 Z2" (predicate-text predicate) (predicate-arity predicate)))
            (t (values predicate (make-face-list faces)))))))

(defstruct (unknown-fact (:include explanation))
  "A fact that is not known at the end of a plan.  REFUSALS says why each rule that could have
derived it did not.  If these are many, it has only the first; MORE is how many are left out."
  predicate face-list refusals (more 0))

(defparameter +most-refusals+ 20 "Of how many rules an answer says why they did not fire.")

(defun explain-fact (form &optional (plan (last-plan)))
  "Return how the fact FORM came to be known in PLAN: a DERIVATION, or an UNKNOWN-FACT."
  (let ((plan (need-plan plan)))
    (multiple-value-bind (predicate face-list) (parse-fact form (plan-rulebase plan))
      (plainly
        (if (recall (plan-memory plan) predicate face-list)
            (derive plan predicate face-list)
            (let* ((rules (deriving-rules predicate plan))
                   (most (min +most-refusals+ (length rules))))
              (make-unknown-fact :predicate predicate :face-list face-list
                                 :more (- (length rules) most)
                                 :refusals (loop for rule in (subseq rules 0 most)
                                                 collect (refuse-conclusion rule predicate face-list
                                                                            plan)))))))))

(defun single-facts (fact)
  "Return the list of the facts in FACT, which may have several lists of faces."
  (let* ((form (canonical-fact fact))
         (lists (and (consp form) (remove-if-not #'consp form))))
    (if (rest lists)
        (loop for list in lists
              collect (append (remove-if #'consp form) (list list)))
        (list fact))))

(defun explain-facts (fact plan)
  "Return the list of the answers on FACT, which may have several lists of faces."
  (loop for single in (single-facts fact) collect (explain-fact single plan)))

(defmethod write-answer ((answer unknown-fact) stream)
  (format stream "~a is not known.~%"
          (fact-text (unknown-fact-predicate answer) (unknown-fact-face-list answer)))
  (let ((given (predicate-given (unknown-fact-predicate answer))))
    (when given
      (format stream "It is an input, which this box does not give.~%"))
    (if (or given (unknown-fact-refusals answer))
        (write-refusals (unknown-fact-refusals answer) (unknown-fact-more answer) stream)
        (format stream "Nothing provides it.~%"))))

;;; In print

(defmethod topic ((explanation unknown-fact))
  (fact-text (unknown-fact-predicate explanation) (unknown-fact-face-list explanation)))
