;;;; machine.lisp -- a small machine that runs the forms of the grasp file.
;;;;
;;;; All numbers live in one array of doubles, the registers.  A program is a row of instructions of
;;;; four small numbers each: an operator, two registers to read, and one to write or the instruction
;;;; to jump to.  So a form is run by one loop, which boxes and allocates nothing.

(in-package :supergrip)

(deftype registers () '(simple-array double-float (*)))
(deftype register () '(unsigned-byte 16))

;;; The registers begin with what the box and the matching give.

(defconstant +u+ 0 "The register of U.")
(defconstant +v+ 1 "The register of V.")
(defconstant +distances+ 2 "The first of the registers of the distances along N, O, A.")
(defconstant +blocked+ 5 "The first of six registers, 1 for a slot whose face is constrained.")
(defconstant +inputs-end+ 11 "The first register after the inputs.")

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter +operators+
    #(:end :fail :move :+ :- :* :/ :min :max :sqrt :expt
      :jump :jump< :jump<= :jump= :jump/= :jump-blocked :jump-free)
    "The operators of the machine, each at its number."))

(deftype instructions () '(simple-array (unsigned-byte 16) (*)))
(deftype register-vector () '(simple-array (unsigned-byte 16) (*)))

(defstruct program
  "A form ready to run: INSTRUCTIONS that leave the results in the registers RESULTS, or that end
with :FAIL where the form is a test that does not hold; ROOM is how many registers they need."
  (instructions nil :type instructions)
  (results nil :type register-vector)
  (room 0 :type fixnum))

;;; Arithmetic that may have no value

(defun real-root (x)
  "The root of X, a double; an arithmetic error if X is below zero."
  (declare (double-float x))
  (if (< x 0d0)
      (error 'arithmetic-error :operation 'sqrt :operands (list x))
      (sqrt (the (double-float 0d0) x))))

(defun real-power (x y)
  "X to the power Y, doubles; an arithmetic error if that is no real."
  (declare (double-float x y))
  (let ((value (expt x y)))
    (if (typep value 'double-float)
        value
        (error 'arithmetic-error :operation 'expt :operands (list x y)))))

;;; The loop

(defun run-instructions (instructions r)
  "Run INSTRUCTIONS on the registers R.  Returns true if they end with :END.
What the checks of safe code would find out again at each step, PACK-INSTRUCTIONS and EXECUTE have
found: every register is one of R, and every jump leads to an instruction."
  (declare (type instructions instructions) (type registers r) (optimize (safety 0)))
  (let ((next 0) (a 0) (b 0) (to 0) (x 0d0) (y 0d0))
    (declare (type (unsigned-byte 24) next) (type register a b to) (double-float x y))
    (macrolet ((operators (&rest clauses)
                 ;; Each operator finds the next itself, not one place for all: a processor then
                 ;; learns what follows what.
                 (flet ((tag (op) (intern (string op))))
                   `(macrolet ((go-on ()
                                 '(let ((op (aref instructions next)))
                                   (setf a (aref instructions (+ next 1))
                                         b (aref instructions (+ next 2))
                                         to (aref instructions (+ next 3))
                                         x (aref r a)
                                         y (aref r b)
                                         next (+ next 4))
                                   (ecase op
                                     ,@(loop for (op) in clauses
                                             collect `(,(position op +operators+)
                                                       (go ,(tag op))))))))
                      (prog ()
                         (go-on)
                         ,@(loop for (op . body) in clauses
                                 append `(,(tag op) ,@body (go-on)))))))
               (put (form) `(setf (aref r to) ,form))
               (jump-if (test) `(when ,test (setf next (* 4 to)))))
      (operators
       (:end (return t))
       (:fail (return nil))
       (:move (put x))
       (:+ (put (+ x y)))
       (:- (put (- x y)))
       (:* (put (* x y)))
       (:/ (put (/ x y)))
       (:min (put (if (< y x) y x)))
       (:max (put (if (> y x) y x)))
       ;; What is called gets registers: X and Y are never boxed then.
       (:sqrt (if (< x 0d0) (put-root r a to) (put (sqrt (the (double-float 0d0) x)))))
       (:expt (put-power r a b to))
       (:jump (setf next (* 4 to)))
       (:jump< (jump-if (< x y)))
       (:jump<= (jump-if (<= x y)))
       (:jump= (jump-if (= x y)))
       (:jump/= (jump-if (/= x y)))
       (:jump-blocked (jump-if (= x 1d0)))
       (:jump-free (jump-if (/= x 1d0)))))))

(defun put-root (r a to)
  (declare (type registers r) (type register a to))
  (setf (aref r to) (real-root (aref r a))))

(defun put-power (r a b to)
  (declare (type registers r) (type register a b to))
  (setf (aref r to) (real-power (aref r a) (aref r b))))

(declaim (inline execute run-program))
(defun execute (program registers)
  "Run PROGRAM on REGISTERS, those of its grasp base.  False if it is a test that does not hold."
  (declare (type registers registers))
  (assert (<= (program-room program) (length registers)))
  (run-instructions (program-instructions program) registers))

(defun run-program (program registers)
  "Run PROGRAM on REGISTERS, and return the registers of its results."
  (execute program registers)
  (program-results program))
