;;;; remember-and-cant.lisp -- the actions REMEMBER and CANT, those of a standard chainer.

(in-package :supergrip-chainer)

(define-action :remember (action client)
  (if (some #'negation-p (action-operands action))
      (complain (action-form action)
                "a negation can't be remembered: what is not remembered is false")
      (multiple-value-bind (predicate terms)
          (parse-sentence (action-operands action) (action-form action) nil)
        (and predicate
             (finish-action action (remember-function predicate terms (action-number action))
                            :once (notany #'term-variable-p terms)
                            :predicate predicate :terms terms)))))

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
  (let ((arity (predicate-arity predicate))
        (variables (loop for place below (length *variables*) collect place)))
    (flet ((put (memory rule face-list binding)
             (when (put-fact memory predicate face-list)
               (log-event memory rule number binding))
             nil))
      (declare (inline put))
      (if (equal terms variables)
          ;; As often: what to remember is the binding itself.
          (lambda (memory rule binding)
            (put memory rule binding binding))
          (lambda (memory rule binding)
            (let ((face-list (instantiate terms binding)))
              ;; A variable may have taken a face that the action names: no list of distinct
              ;; faces, and nothing to remember.
              (when (= (face-list-count face-list) arity)
                (put memory rule face-list binding))))))))

(define-action :cant (action client)
  (let ((words (action-operands action)))
    (if (or (null words) (notevery #'namep words))
        (complain (action-form action) "CANT needs words after it that say why")
        (let ((words (mapcar #'symbol-name words)))
          (finish-action action (lambda (memory rule binding)
                                  (declare (ignore memory binding))
                                  (make-stop :verdict :cant :rule rule :words words)))))))

(defmethod action-sees-p ((verb (eql :cant)) action variable)
  (declare (ignore action variable))
  nil)

(defmethod describe-action ((verb (eql :cant)) action)
  (format nil "stop: can't ~{~a~^ ~}" (action-operands action)))
