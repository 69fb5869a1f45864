;;;; testforms.lisp -- forms that are true or false: CONDITIONS, and the tests of COND and IF.

(in-package :supergrip)

(defparameter +comparisons+ '("<" "<=" ">" ">=" "=") "The comparisons, prefix or infix.")

(defun test-value (node)
  "Return T or :FALSE if NODE, a test, is so whatever the box; NIL if it depends."
  (case (node-op node) (:true t) (:false :false)))

(defun connective-p (object) (or (name= object "AND") (name= object "OR")))
(defun comparison-p (object) (name-in object +comparisons+))

(defun parse-test (form scope)
  "Return the node of FORM, which is true or false, or NIL after a complaint.
Tests are T, (CONSTRAINED N1), comparisons prefix (< a b) or infix (a < b), (NOT test), and tests
joined by AND and OR, prefix or infix; infix AND and OR have equal precedence and associate to
the right: a AND b OR c is a AND (b OR c)."
  (let ((*form* (if (and (consp form) (line-known-p form)) form *form*)))
    (cond ((too-many-steps-p) nil)
          ((name= form "T") (make-node :op :true :form form))
          ((not (consp form)) (complain form "~a is not a test" (form-text form)))
          ((part-p form "CONSTRAINED") (parse-constrained form))
          ((part-p form "NOT") (parse-not form scope))
          ((connective-p (first form)) (parse-prefix-connective form scope))
          ((comparison-p (first form)) (parse-comparison form (rest form) (first form) scope))
          ((null (rest form)) (parse-test (first form) scope))
          (t (parse-infix form scope)))))

(defun parse-constrained (form)
  (let ((slot (and (= (length form) 2)
                   (slot-index (if (part-p (second form) "QUOTE")
                                   (second (second form))
                                   (second form))))))
    (if slot
        (make-node :op :blocked :args (list slot) :form form)
        (complain form "~a: CONSTRAINED takes one of N1 N2 O1 O2 A1 A2" (form-text form)))))

(defun parse-not (form scope)
  (if (/= (length form) 2)
      (complain form "~a: NOT takes one test" (form-text form))
      (let ((test (parse-test (second form) scope)))
        (and test (negation test form)))))

(defun negation (test form)
  (case (node-op test)
    (:true (make-node :op :false :form form))
    (:false (make-node :op :true :form form))
    (t (make-node :op :not :args (list test) :form form))))

(defun parse-prefix-connective (form scope)
  (let ((tests (loop for test in (rest form) collect (parse-test test scope))))
    (cond ((null tests) (complain form "~a joins no tests" (first form)))
          ((member nil tests) nil)
          (t (reduce (lambda (a b) (connective (first form) a b form)) tests :from-end t)))))

(defun connective (name a b form)
  (let ((and-p (name= name "AND")))
    (cond ((eq (node-op a) (if and-p :true :false)) b)
          ((eq (node-op a) (if and-p :false :true)) a)
          (t (make-node :op (if and-p :and :or) :args (list a b) :form form)))))

(defun parse-infix (form scope)
  (let ((place (position-if #'connective-p form)))
    (cond ((null place)
           (if (and (= (length form) 3) (comparison-p (second form)))
               (parse-comparison form (list (first form) (third form)) (second form) scope)
               (complain form "~a is not a test: write (a < b), and join tests by AND and OR"
                         (form-text form))))
          ((or (zerop place) (= place (1- (length form))))
           (complain form "~a: ~a stands between two tests" (form-text form) (nth place form)))
          (t
           (let ((a (parse-test (infix-part (subseq form 0 place)) scope))
                 (b (parse-test (infix-part (nthcdr (1+ place) form)) scope)))
             (and a b (connective (nth place form) a b form)))))))

(defun infix-part (part)
  (if (rest part) part (first part)))

(defun parse-comparison (form operands name scope)
  (if (/= (length operands) 2)
      (complain form "~a: ~a compares two numbers" (form-text form) name)
      (let ((a (parse-number-form (first operands) scope))
            (b (parse-number-form (second operands) scope)))
        (and a b
             (let ((op (find-symbol (symbol-name name) :keyword)))
               (if (and (constant-p a) (constant-p b))
                   (make-node :op (if (funcall (comparison-function op)
                                               (constant-value a) (constant-value b))
                                      :true :false)
                              :form form)
                   (make-node :op op :args (list a b) :form form)))))))

(defun comparison-function (op)
  (ecase op (:< #'<) (:<= #'<=) (:> #'>) (:>= #'>=) (:= #'=)))
