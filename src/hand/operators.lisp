;;;; operators.lisp -- the operators on numbers and the comparisons: one row each.
;;;;
;;;; All numbers live in one array of doubles, the registers.  An operator on some of them is a
;;;; closure that reads its registers, writes one, and calls the next closure: nothing is boxed.
;;;; Where an argument is a sum, a difference or a product, the closure computes it too, so that one
;;;; call does two operations.
;;;;
;;;; No register ever holds an infinity or a NaN: a closure that would write one ends its chain,
;;;; which then returns NIL.  So results do not depend on the float traps of the caller.

(in-package :supergrip)

(deftype registers () '(simple-array double-float (*)))
(deftype register () '(unsigned-byte 16))
(deftype register-vector () '(simple-array (unsigned-byte 16) (*)))

;;; The registers begin with what the box and the matching give.

(defconstant +u+ 0 "The register of U.")
(defconstant +v+ 1 "The register of V.")
(defconstant +distances+ 2 "The first of the registers of the distances along N, O, A.")
(defconstant +blocked+ 5 "The first of six registers, 1 for a grasp-face whose face is
constrained.")
(defconstant +inputs-end+ 11 "The first register after the inputs.")

;;; The table

(defvar *operators* '() "All that may stand first in a form or a test, as operators, in order.")

(defstruct operator
  "What may stand first in a form.  GIVES lists what it can give: :NUMBER, :SIX (numbers), :TEST.
PARSE is a function of the form, its scope and what is wanted of it; it returns a node, or NIL after
a complaint."
  (name "" :type string :read-only t) (gives '() :type list :read-only t)
  (parse nil :type (or symbol function) :read-only t))

(defstruct (arithmetic (:include operator (gives '(:number)) (parse 'parse-arithmetic)))
  "An operator on numbers.  LEAST and MOST (NIL: any) count its arguments; FIRST is the number that
stands before a single argument, or NIL.  STEP makes its closure, from the next closure, the
register to write and the operands to read; INNER is what the operator is called in operands, or NIL
(see CLOSURE-ON).  BOUNDS puts the least and the greatest of what it gives on intervals into
another, or is NIL: see BOUNDS-FUNCTION.  SLOPE is a form, or NIL: see DEFINE-OPERATOR.  KIND is
NIL, :SYMMETRIC or :SELECTIVE."
  (least 1 :type fixnum :read-only t) (most nil :type (or null fixnum) :read-only t)
  (first nil :type (or null double-float) :read-only t)
  (inner nil :type symbol :read-only t) (step nil :type function :read-only t)
  (bounds nil :type (or null function) :read-only t) (slope nil :read-only t)
  (kind nil :type symbol :read-only t))

(defstruct (comparison (:include operator (gives '(:test)) (parse 'parse-prefix-comparison)))
  "A comparison of two numbers.  TEST is a function of them.  STEP makes its closure, from the
closures to call next if it holds and if it does not, and the operands, which give the two numbers.
For texts, OPPOSITE names what holds where it does not, and MIRROR the comparison that says the same
of the numbers exchanged, or they are NIL."
  (test nil :type function :read-only t) (step nil :type function :read-only t)
  (opposite nil :read-only t) (mirror nil :read-only t))

(define-printing (operator operator) "~a" (operator-name operator))

(defun find-operator (name)
  "Return the operator that NAME, a string, names, or NIL."
  (loop for operator of-type operator in *operators*
        for known = (operator-name operator)
        ;; Most differ in length: STRING= is slower.
        when (and (= (length known) (length name)) (string= known name)) return operator))

(defun add-operator (operator)
  (setf *operators* (with-row operator *operators* #'operator-name)))

(defmacro with-closure-names (names &body body)
  "Run BODY with NAMES bound to fresh symbols, which no form of a row can mean."
  `(let ,(loop for name in names collect `(,name (gensym ,(string name))))
     ,@body))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter +inner-operators+ '(+ - *)
    "Functions that a closure computes itself of two registers, before its own operation.  Their
result is not finite if one of their arguments is not."))

(defmacro closure-on ((registers checked &rest bindings) &body body)
  "Return a closure of REGISTERS that runs BODY with the numbers of operands.  Each of BINDINGS is a
variable and a place that holds its operand: a register, or a list of one of +INNER-OPERATORS+ and
two registers.  A closure is compiled for each.  If CHECKED is true, it returns NIL where an inner
operator gives no finite number."
  (if (null bindings)
      `(lambda (,registers)
         (declare (type registers ,registers))
         ,@body)
      (destructuring-bind ((variable operand) . others) bindings
        (with-closure-names (a b)
          (flet ((closure-with (form inner)
                   `(closure-on (,registers ,checked ,@others)
                      (let ((,variable ,form))
                        ,@(if (and inner checked)
                              `((when (finite-p ,variable) ,@body))
                              body)))))
            `(if (integerp ,operand)
                 (let ((,a ,operand))
                   (declare (type register ,a))
                   ,(closure-with `(aref ,registers ,a) nil))
                 (let ((,a (second ,operand)) (,b (third ,operand)))
                   (declare (type register ,a ,b))
                   (ecase (first ,operand)
                     ,@(loop for operator in +inner-operators+
                             collect `(,operator
                                       ,(closure-with `(,operator (aref ,registers ,a)
                                                                  (aref ,registers ,b))
                                                      t)))))))))))

(deftype interval () "The least and the greatest of some numbers." '(simple-array double-float (2)))

(defmacro do-ends ((x interval at-0) &body body)
  "Run BODY with X each end of INTERVAL; with 0 too if AT-0 is true and 0 is within."
  (with-closure-names (least most place)
    `(let ((,least (aref ,interval 0)) (,most (aref ,interval 1)))
       (dotimes (,place 3)
         (when (case ,place
                 (0 t)
                 (1 (< ,least ,most))
                 (t (and ,at-0 (< ,least 0d0 ,most))))
           (let ((,x (case ,place (0 ,least) (1 ,most) (t 0d0))))
             ,@body))))))

(defmacro bounds-function ((x &optional y) value when monotone)
  "Return a function of one or two intervals and a third, into which it puts the least and the
greatest VALUE on them, and which returns whether there is one: 2 in any case, 1 perhaps, 0
nowhere.  VALUE is monotone, so it has them at the ends.  Rounding is monotone too: the bounds are
true of what the doubles between the ends give, rounded.  Where VALUE is out of range at an end, it
may be in range elsewhere."
  (with-closure-names (a b out good bad huge least most result)
    (let* ((at-0 (eq monotone :but-at-0))
           (visit `(let ((,result (and ,when ,value)))
                     (cond ((not (typep ,result 'double-float)) (incf ,bad))
                           ((not (finite-p ,result)) (incf ,huge))
                           (t (incf ,good)
                              (when (< ,result ,least) (setf ,least ,result))
                              (when (> ,result ,most) (setf ,most ,result)))))))
      `(lambda (,a ,@(and y (list b)) ,out)
         (declare (type interval ,a ,@(and y (list b)) ,out))
         (let ((,good 0) (,bad 0) (,huge 0)
               (,least most-positive-double-float) (,most most-negative-double-float))
           (declare (fixnum ,good ,bad ,huge) (double-float ,least ,most))
           (do-ends (,x ,a ,at-0)
             ,(if y `(do-ends (,y ,b ,at-0) ,visit) visit))
           (when (plusp (+ ,bad ,huge))
             (setf ,least most-negative-double-float ,most most-positive-double-float))
           (setf (aref ,out 0) ,least (aref ,out 1) ,most)
           (cond ((zerop (+ ,bad ,huge)) 2)
                 ((and (zerop ,good) (or (zerop ,huge) (= 1 (+ ,bad ,huge)))) 0)
                 (t 1)))))))

(defmacro define-operator (name (x &optional y) value
                           &key (counts (if y '(2 2) '(1 1))) first inner finite (when t)
                             (parse 'parse-arithmetic) monotone slope kind)
  "Define NAME as an operator that gives VALUE, a form that makes a double of the doubles X and Y.
It has no value where WHEN is false, nor where VALUE is no finite double, which is not looked at if
it is FINITE in any case.  COUNTS are the least and the greatest count of arguments; more than two
are taken from the left, and one alone stands for itself, or follows the number FIRST.  INNER is the
function of +INNER-OPERATORS+ that does the same, if there is one.

What follows serves EXPLAIN-BEST and REQUIRES; they look only at single places where it is not
known.  MONOTONE is true if VALUE only rises, or only falls, with each argument while the other
stays, as far as it has a value; :BUT-AT-0 if an argument may be 0 where it turns.  SLOPE is
VALUE's derivative, of X, Y, DX, DY and VALUE, a form of +, -, *, / and (IF (< x y) a b).  KIND is
:SYMMETRIC if two arguments may be exchanged, :SELECTIVE if VALUE is one of them where it does not
turn, and the order of many is all one."
  (with-closure-names (next to a b registers result)
    `(add-operator
      (make-arithmetic
       :name ,name :least ,(first counts) :most ,(second counts) :first ,first :parse ',parse
       :inner ',inner
       :bounds ,(and monotone `(bounds-function (,x ,@(and y (list y))) ,value ,when ,monotone))
       :slope ',slope :kind ,kind
       :step (lambda (,next ,to ,a ,@(and y (list b)))
               (declare (function ,next) (type register ,to))
               (closure-on (,registers ,(not inner) (,x ,a) ,@(and y `((,y ,b))))
                 (when ,when
                   (let ((,result ,value))
                     (when ,(or finite `(and (typep ,result 'double-float) (finite-p ,result)))
                       (setf (aref ,registers ,to) ,result)
                       (funcall ,next ,registers))))))))))

(defmacro define-comparison (name (x y) test &key opposite mirror)
  "Define NAME as a comparison, which holds if TEST is true of the doubles X and Y.  OPPOSITE and
MIRROR are for texts: see COMPARISON."
  (with-closure-names (then else a b registers)
    `(add-operator
      (make-comparison
       :name ,name :opposite ,opposite :mirror ,mirror
       :test (lambda (,x ,y)
               (declare (double-float ,x ,y))
               ,test)
       :step (lambda (,then ,else ,a ,b)
               (declare (function ,then ,else))
               (closure-on (,registers t (,x ,a) (,y ,b))
                 (if ,test (funcall ,then ,registers) (funcall ,else ,registers))))))))

;;; The rows

(define-operator "+" (x y) (+ x y) :counts (1) :inner +
  :monotone t :slope (+ dx dy) :kind :symmetric)
(define-operator "-" (x y) (- x y) :counts (1) :first 0d0 :inner -
  :monotone t :slope (- dx dy))
(define-operator "*" (x y) (* x y) :counts (1) :inner *
  :monotone t :slope (+ (* dx y) (* x dy)) :kind :symmetric)
(define-operator "/" (x y) (/ x y) :counts (1 2) :first 1d0 :when (/= y 0d0)
  :monotone :but-at-0 :slope (/ (- dx (* value dy)) y))
(define-operator "SQRT" (x) (sqrt (the (double-float 0d0) x)) :when (>= x 0d0) :finite t
  :monotone t :slope (/ dx (* 2 value)))
;; A power of a negative number may be complex: then there is no value.
(define-operator "EXPT" (x y) (expt x y) :parse parse-power
  :monotone :but-at-0)
(define-operator "MIN" (x y) (if (< y x) y x) :counts (1) :finite t
  :monotone t :slope (if (< y x) dy dx) :kind :selective)
(define-operator "MAX" (x y) (if (> y x) y x) :counts (1) :finite t
  :monotone t :slope (if (< x y) dy dx) :kind :selective)
(define-operator "ABS" (x) (abs x) :finite t
  :monotone :but-at-0 :slope (if (< x 0) (- 0 dx) dx) :kind :selective)
(define-operator "POSIT" (x) (if (> x 0d0) x 0d0) :finite t
  :monotone t :slope (if (< 0 x) dx 0) :kind :selective)

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
  (funcall (comparison-test comparison) a b))
