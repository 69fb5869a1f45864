;;;; operators.lisp -- the operators on numbers and the comparisons: one row each.
;;;;
;;;; All numbers live in one array of doubles, the registers.  An operator on some of them is a
;;;; closure that reads its registers, writes one, and calls the next closure: nothing is boxed.  No
;;;; register ever holds an infinity or a NaN: a closure that would write one ends its chain, which
;;;; then returns NIL.  So results do not depend on the float traps of the caller.

(in-package :supergrip)

(deftype registers () '(simple-array double-float (*)))
(deftype register () '(unsigned-byte 16))
(deftype register-vector () '(simple-array (unsigned-byte 16) (*)))

;;; The registers begin with what the box and the matching give.

(defconstant +u+ 0 "The register of U.")
(defconstant +v+ 1 "The register of V.")
(defconstant +distances+ 2 "The first of the registers of the distances along N, O, A.")
(defconstant +blocked+ 5 "The first of six registers, 1 for a grasp-face whose face is constrained.")
(defconstant +inputs-end+ 11 "The first register after the inputs.")

(declaim (inline finite-p))
(defun finite-p (number)
  "True if the double NUMBER is neither infinite nor a NaN."
  (declare (double-float number))
  (<= (abs number) most-positive-double-float))

;;; The table

(defvar *operators* '() "All that may stand first in a form or a test, as operators, in order.")

(defstruct operator
  "What may stand first in a form.  GIVES lists what it can give: :NUMBER, :SIX (numbers), :TEST.
PARSE is a function of the form, its scope and what is wanted of it; it returns a node, or NIL after
a complaint."
  (name "" :type string) (gives '() :type list) (parse nil :type (or symbol function)))

(defstruct (arithmetic (:include operator (gives '(:number)) (parse 'parse-arithmetic)))
  "An operator on numbers.  LEAST and MOST (NIL: any) count its arguments; FIRST is the number that
stands before a single argument, or NIL.  STEP makes its closure, from the next closure, the
register to write and those to read."
  (least 1 :type fixnum) (most nil :type (or null fixnum)) (first nil :type (or null double-float))
  (step nil :type function))

(defstruct (comparison (:include operator (gives '(:test)) (parse 'parse-prefix-comparison)))
  "A comparison of two numbers.  STEP makes its closure, from the closures to call next if it holds
and if it does not, and the registers of the two numbers.  For texts, OPPOSITE names what holds where
it does not, and MIRROR the comparison that says the same of the numbers exchanged, or they are NIL."
  (step nil :type function) (opposite nil) (mirror nil))

(defmethod print-object ((operator operator) stream)
  (print-unreadable-object (operator stream :type t)
    (write-string (operator-name operator) stream)))

(defun find-operator (name)
  "Return the operator that NAME, a string, names, or NIL."
  (find name *operators* :key #'operator-name :test #'string=))

(defun add-operator (operator)
  "Put OPERATOR into the table, in the place of one of its name or at the end."
  (let ((place (position (find-operator (operator-name operator)) *operators*)))
    (setf *operators* (append (subseq *operators* 0 place)
                              (list operator)
                              (and place (nthcdr (1+ place) *operators*))))
    operator))

(defmacro with-closure-names (names &body body)
  "Run BODY with NAMES bound to fresh symbols, which no form of a row can mean."
  `(let ,(loop for name in names collect `(,name (gensym ,(string name))))
     ,@body))

(defmacro define-operator (name (x &optional y) value
                           &key (counts (if y '(2 2) '(1 1))) first (when t)
                             (parse 'parse-arithmetic))
  "Define NAME as an operator that gives VALUE, a form that makes a double of the doubles X and Y.
It has no value where WHEN is false, nor where VALUE is no finite double.  COUNTS are the least and
the greatest count of arguments; more than two are taken from the left, and one alone stands for
itself, or follows the number FIRST."
  (with-closure-names (next to a b registers result)
    (let ((from (if y (list a b) (list a))))
      `(add-operator
        (make-arithmetic
         :name ,name :least ,(first counts) :most ,(second counts) :first ,first :parse ',parse
         :step (lambda (,next ,to ,@from)
                 (declare (function ,next) (type register ,to ,@from))
                 (lambda (,registers)
                   (declare (type registers ,registers))
                   (let ((,x (aref ,registers ,a))
                         ,@(and y `((,y (aref ,registers ,b)))))
                     (when ,when
                       (let ((,result ,value))
                         (when (and (typep ,result 'double-float) (finite-p ,result))
                           (setf (aref ,registers ,to) ,result)
                           (funcall ,next ,registers))))))))))))

(defmacro define-comparison (name (x y) test &key opposite mirror)
  "Define NAME as a comparison, which holds if TEST is true of the doubles X and Y.  OPPOSITE and MIRROR
are for texts: see COMPARISON."
  (with-closure-names (then else a b registers)
    `(add-operator
      (make-comparison
       :name ,name :opposite ,opposite :mirror ,mirror
       :step (lambda (,then ,else ,a ,b)
               (declare (function ,then ,else) (type register ,a ,b))
               (lambda (,registers)
                 (declare (type registers ,registers))
                 (let ((,x (aref ,registers ,a))
                       (,y (aref ,registers ,b)))
                   (if ,test (funcall ,then ,registers) (funcall ,else ,registers)))))))))

;;; The rows

(define-operator "+" (x y) (+ x y) :counts (1))
(define-operator "-" (x y) (- x y) :counts (1) :first 0d0)
(define-operator "*" (x y) (* x y) :counts (1))
(define-operator "/" (x y) (/ x y) :counts (1 2) :first 1d0 :when (/= y 0d0))
(define-operator "SQRT" (x) (sqrt (the (double-float 0d0) x)) :when (>= x 0d0))
;; A power of a negative number may be complex: then there is no value.
(define-operator "EXPT" (x y) (expt x y) :parse parse-power)
(define-operator "MIN" (x y) (if (< y x) y x) :counts (1))
(define-operator "MAX" (x y) (if (> y x) y x) :counts (1))
(define-operator "ABS" (x) (abs x))
(define-operator "POSIT" (x) (if (> x 0d0) x 0d0))

(define-comparison "<" (x y) (< x y) :opposite ">=" :mirror ">")
(define-comparison "<=" (x y) (<= x y) :opposite ">" :mirror ">=")
(define-comparison ">" (x y) (> x y) :opposite "<=" :mirror "<")
(define-comparison ">=" (x y) (>= x y) :opposite "<" :mirror "<=")
(define-comparison "=" (x y) (= x y) :opposite "other than" :mirror "=")

;;; Results on numbers alone

(defun operator-value (operator numbers)
  "Return what the arithmetic OPERATOR gives for NUMBERS, one or two doubles, or NIL."
  (let ((registers (coerce (append numbers '(0d0)) 'registers))
        (to (length numbers)))
    (handler-case
        (and (funcall (apply (arithmetic-step operator) (constantly t) to
                             (loop for register below to collect register))
                      registers)
             (aref registers to))
      (arithmetic-error () nil))))

(defun comparison-true-p (comparison a b)
  "True if COMPARISON holds between the doubles A and B."
  (funcall (funcall (comparison-step comparison) (constantly t) (constantly nil) 0 1)
           (coerce (list a b) 'registers)))
