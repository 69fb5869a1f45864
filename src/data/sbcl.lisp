;;;; sbcl.lisp -- what the core needs of SBCL itself: atomic lists, floating point modes,
;;;; backquotes, the heap.  Files are in files.lisp.

(in-package :supergrip-data)

;;; Lists that several threads share

(defmacro take-from (place)
  "Take the first element of the list in PLACE, a slot of a structure, or return NIL."
  `(sb-ext:atomic-pop ,place))

(defmacro give-to (place object)
  "Put OBJECT before the list in PLACE, a slot of a structure."
  `(sb-ext:atomic-push ,object ,place))

(defmacro keep-in (vector place object)
  "Put OBJECT, complete, at PLACE of the simple VECTOR, which other threads read.  Return it."
  (let ((the-object (gensym "OBJECT")))
    `(let ((,the-object ,object))
       (sb-thread:barrier (:write))
       (setf (svref ,vector ,place) ,the-object))))

;;; Floating point

(declaim (inline double-bits))
(defun double-bits (number)
  "Return an integer from 0 that the bits of the double NUMBER make."
  (declare (double-float number))
  (logxor (sb-kernel:double-float-low-bits number)
          (ash (ldb (byte 32 0) (sb-kernel:double-float-high-bits number)) 29)))

(defconstant +float-flags+ (dpb -1 sb-vm:float-sticky-bits 0)
  "The bits of the floating point modes that only say what happened.")

(defconstant +harmless-modes+
  (logior +float-flags+
          (dpb (logior sb-vm:float-overflow-trap-bit sb-vm:float-invalid-trap-bit
                       sb-vm:float-divide-by-zero-trap-bit)
               sb-vm:float-traps-byte 0))
  "The bits on which no plan depends: flags, and the traps of operations without a value, which fail
with or without a trap.")

(declaim (inline call-with-float-modes))
(defun call-with-float-modes (kept function)
  "Call FUNCTION with the bits KEPT of the floating point modes as they are, and the others 0."
  (let ((modes (sb-vm:floating-point-modes)))
    (if (zerop (logandc2 modes kept))   ; setting them costs ten times as much
        (funcall function)
        (unwind-protect
             (progn (setf (sb-vm:floating-point-modes) (logand modes kept))
                    (funcall function))
          (setf (sb-vm:floating-point-modes) modes)))))

(defmacro with-float-modes ((kept) &body body)
  (let ((function (gensym "BODY")))
    `(flet ((,function () ,@body))
       (declare (dynamic-extent #',function))
       (call-with-float-modes ,kept #',function))))

(defmacro with-plain-floats (&body body)
  "Run BODY with numbers rounded to the nearest and no trap for inexact or tiny ones, whatever the
caller has set."
  `(with-float-modes (+harmless-modes+) ,@body))

(defmacro without-float-traps (&body body)
  "As WITH-PLAIN-FLOATS; where an operation has no value, it gives an infinity or a NaN."
  `(with-float-modes (+float-flags+) ,@body))

;;; Decimals

(defun exact-decimal (number)
  "Return the rational that the shortest decimal of NUMBER, a double, is; of a rational, itself."
  (if (or (rationalp number) (zerop number))
      (rational number)
      (multiple-value-bind (exponent digits) (sb-impl::flonum-to-digits (abs number))
        (* (if (minusp number) -1 1)
           (parse-integer digits)
           (expt 10 (- exponent (length digits)))))))

;;; What the Lisp reader makes of a backquote

(defun backquote-p (form)
  "True if FORM is what SBCL's reader makes of a backquote; the second of its two elements is the
template."
  (and (consp form) (eq (first form) 'sb-int:quasiquote)
       (consp (rest form)) (null (cddr form))))

(defun comma-p (object)
  "True if OBJECT is what SBCL's reader makes of a comma."
  (sb-int:comma-p object))

(defun comma-form (comma)
  "Return the form after COMMA, and true if it is one element of the list around it, not many."
  (values (sb-int:comma-expr comma) (eql 0 (sb-int:comma-kind comma))))

;;; Random numbers

(defun seeded-state (seed)
  "Return a random state that SEED, an integer from 0, chooses."
  (sb-ext:seed-random-state seed))

;;; The heap

(defconstant +octets-of-character+ 150
  "How much of the heap a character of a record or a file takes at most until it is worked off, what
copies it when garbage is collected included.")

(defun room-for (count)
  "Return COUNT, or how many characters the heap has room for if they are fewer."
  (flet ((most ()
           (floor (- (sb-ext:dynamic-space-size) (sb-kernel:dynamic-usage)) +octets-of-character+)))
    (when (> count (most)) (sb-ext:gc :full t))
    (min count (most))))
