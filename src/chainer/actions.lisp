;;;; actions.lisp -- the actions REMEMBER and CANT, those of a standard chainer.

(in-package :supergrip-chainer)

(defun action-number (action)
  "Return the place of ACTION, being compiled, in its rule."
  (position (action-form action) (rest (fourth (rule-form *rule*))) :test #'eq))

(define-action :remember (action rulebase)
  (if (some #'negation-p (action-operands action))
      (complain (action-form action)
                "a negation can't be remembered: what is not remembered is false")
      (multiple-value-bind (predicate terms)
          (parse-sentence (action-operands action) (action-form action) nil)
        (when predicate
          (setf (action-predicate action) predicate
                (action-terms action) terms
                (action-once action) (notany #'term-variable-p terms)
                (action-function action)
                (remember-function predicate terms (action-number action)))))))

(defmethod action-conclusion ((verb (eql :remember)) operands)
  operands)

(defmethod symmetric-action-p ((verb (eql :remember)) action a b)
  ;; A list of surfaces is unordered.
  (or (action-once action)
      (eq (null (member a (action-terms action))) (null (member b (action-terms action))))))

(defmethod describe-action ((verb (eql :remember)) action)
  (format nil "remember that ~a" (sentence-text (predicate-text (action-predicate action))
                                                (find-if #'consp (action-operands action)))))

(defun remember-function (predicate terms number)
  "Return the function of the action NUMBER of the rule being read, which remembers PREDICATE of
TERMS."
  (let ((rule *rule*)
        (arity (predicate-arity predicate))
        (variables (loop for place below (length (rule-variables *rule*)) collect place)))
    (flet ((put (memory face-list binding)
             (when (put-fact memory predicate face-list)
               (log-event memory rule number binding))
             nil))
      (declare (inline put))
      (if (equal terms variables)
          ;; As often: what to remember is the binding itself.
          (lambda (memory binding)
            (put memory binding binding))
          (lambda (memory binding)
            (let ((face-list (instantiate terms binding)))
              ;; A variable may have taken a face that the action names: no list of distinct
              ;; faces, and nothing to remember.
              (when (= (face-list-count face-list) arity)
                (put memory face-list binding))))))))

(define-action :cant (action rulebase)
  (let ((words (action-operands action)))
    (if (or (null words) (notevery #'namep words))
        (complain (action-form action) "CANT needs words after it that say why")
        (let ((stop (make-stop :verdict :cant :rule *rule* :words (mapcar #'symbol-name words))))
          (setf (action-function action)
                (lambda (memory binding)
                  (declare (ignore memory binding))
                  stop))))))

(defmethod describe-action ((verb (eql :cant)) action)
  (format nil "stop: can't ~{~a~^ ~}" (action-operands action)))
