;;;; numbers.lisp -- decimal numbers and ratios, exactly rounded, within bounds.

(in-package :supergrip-data)

(defparameter *number-limit* 40 "The most characters that a number may have.")

(defconstant +largest+ 1d300 "No number in a file may be farther from zero than this.")
(defconstant +smallest+ 1d-300 "No number but zero may be closer to zero than this.")

(declaim (inline finite-p))
(defun finite-p (number)
  "True if the double NUMBER is neither infinite nor a NaN."
  (declare (double-float number))
  (<= (abs number) most-positive-double-float))

(defun digits-end (text start end)
  "Return where the decimal digits of TEXT from START end."
  (declare (type (simple-array character (*)) text) (fixnum start end))
  (loop while (and (< start end) (char<= #\0 (schar text start) #\9))
        do (incf start))
  start)

(declaim (inline signp))
(defun signp (character)
  (or (char= character #\+) (char= character #\-)))

(defun digits-value (text start end value)
  "Return VALUE continued by the digits of TEXT between START and END."
  (declare (type (simple-array character (*)) text) (fixnum start end))
  (loop for i of-type fixnum from start below end
        for digit of-type (integer 0 9) = (- (char-code (schar text i)) 48)
        do (setf value (if (typep value '(unsigned-byte 58)) ; in machine arithmetic
                           (+ (* 10 value) digit)
                           (+ (* 10 value) digit))))
  value)

(defun bounded-double (mantissa exponent)
  "Return the double nearest to MANTISSA x 10^EXPONENT, or NIL and :RANGE."
  (declare (type (integer 0) mantissa) (fixnum exponent))
  (cond ((zerop mantissa) 0d0)
        ((and (< mantissa (expt 2 53)) (<= -22 exponent 22))
         ;; Both factors are exact doubles, so one operation rounds once.
         (let ((power (svref (load-time-value
                              (coerce (loop for i from 0 to 22
                                            collect (coerce (expt 10 i) 'double-float))
                                      'simple-vector))
                             (abs exponent))))
           (declare (double-float power))
           (if (minusp exponent)
               (/ (coerce mantissa 'double-float) power)
               (* (coerce mantissa 'double-float) power))))
        ;; About the decimal logarithm.
        ((> (abs (+ exponent (* 0.30103 (integer-length mantissa)))) 310.0)
         (values nil :range))
        ((minusp exponent) (bounded-quotient mantissa (expt 10 (- exponent))))
        (t (bounded-quotient (* mantissa (expt 10 exponent)) 1))))

(defun bounded-quotient (numerator denominator)
  "Return the double nearest to NUMERATOR / DENOMINATOR, integers above 0, or NIL and :RANGE."
  (declare (type (integer 1) numerator denominator))
  ;; A quotient of 56 or 57 bits, the last one set if there is a remainder, is a machine integer,
  ;; and what rounds it to a double rounds once.
  (let ((shift (- (+ 56 (integer-length denominator)) (integer-length numerator))))
    (multiple-value-bind (quotient remainder)
        (truncate (ash numerator (max shift 0)) (ash denominator (max (- shift) 0)))
      (declare (type (unsigned-byte 57) quotient))
      ;; What is far outside the bounds would overflow.
      (let ((double (and (< -960 shift 1060)
                         (scale-float (coerce (if (zerop remainder) quotient (logior quotient 1))
                                              'double-float)
                                      (- shift)))))
        (if (and double (<= +smallest+ double +largest+))
            double
            (values nil :range))))))

(defun bounded-rational (number)
  "Return the double nearest to NUMBER, a rational, or NIL and :RANGE."
  (if (zerop number)
      0d0
      (multiple-value-bind (double trouble)
          (bounded-quotient (abs (numerator number)) (denominator number))
        (values (and double (if (minusp number) (- double) double)) trouble))))

(defun parse-number (text end)
  "Return the number that the first END characters of TEXT spell: an integer, a ratio or a double.
If they do not, return NIL and :SYNTAX, :RANGE (too large or too close to zero for a double),
:ZERO (division by zero) or :LENGTH.

Grammar: [sign] digits | [sign] digits / digits | [sign] digits [. digits] [e [sign] digits],
where the digits before or after the point may be absent, and d stands for e too."
  (declare (type (simple-array character (*)) text) (fixnum end))
  (when (> end (the fixnum *number-limit*))
    (return-from parse-number (values nil :length)))
  (let* ((negative (and (plusp end) (char= (schar text 0) #\-)))
         (start (if (and (plusp end) (signp (schar text 0))) 1 0))
         (point (digits-end text start end))
         (whole (digits-value text start point 0)))
    (multiple-value-bind (value trouble)
        (cond ((< point end)
               (if (char= (schar text point) #\/)
                   (parse-ratio text start point end whole)
                   (parse-decimal text start point end whole)))
              ((> point start) whole)
              (t (values nil :syntax)))
      (if (and value negative (not (eql value 0d0))) (- value) (values value trouble)))))

(defun parse-ratio (text start slash end numerator)
  (declare (type (simple-array character (*)) text) (fixnum start slash end))
  (let* ((last (digits-end text (1+ slash) end))
         (denominator (digits-value text (1+ slash) last 0)))
    (cond ((or (= slash start) (= (1+ slash) end) (< last end))
           (values nil :syntax))
          ((zerop denominator) (values nil :zero))
          (t (/ numerator denominator)))))

(defun parse-decimal (text start point end whole)
  (declare (type (simple-array character (*)) text) (fixnum start point end))
  (let* ((dotted (char= (schar text point) #\.))
         (fraction (if dotted (1+ point) point))
         (mark (digits-end text fraction end))
         (mantissa (digits-value text fraction mark whole))
         (digits (+ (- point start) (- mark fraction))))
    (cond ((zerop digits) (values nil :syntax))
          ((= mark end) (bounded-double mantissa (- fraction mark)))
          ((not (find (schar text mark) "eEdD")) (values nil :syntax))
          (t
           (let* ((sign (1+ mark))
                  (first (if (and (< sign end) (signp (schar text sign))) (1+ sign) sign))
                  (last (digits-end text first end))
                  (power (digits-value text first last 0)))
             (cond ((or (= first last) (< last end)) (values nil :syntax))
                   ((and (> power 999) (plusp mantissa)) (values nil :range))
                   (t (bounded-double mantissa
                                      (+ (- fraction mark)
                                         (* (min power 999)
                                            (if (char= (schar text sign) #\-) -1 1)))))))))))

(defun as-double (number)
  "Return NUMBER, a real, as a double, or NIL if no double within bounds stands for it.
A single float becomes the double of its shortest decimal: 0.2 typed at the REPL is the 0.2 of a
file."
  (typecase number
    (double-float
     ;; Comparing a NaN or an infinity may trap: neither is within bounds.
     (handler-case (and (or (zerop number) (<= +smallest+ (abs number) +largest+))
                        (+ number 0d0))
       (arithmetic-error () nil)))
    (single-float
     (handler-case (and (<= (abs number) most-positive-single-float)
                        (let ((text (coerce (float-text number) '(simple-array character (*)))))
                          (values (as-double (parse-number text (length text))))))
       (arithmetic-error () nil)))
    (rational (values (bounded-rational number)))))
