;;;; numbers-in-print.lisp -- numbers in print, each with as many digits as its sentence needs.

(in-package :supergrip)

(defun decimal-exponent (exact)
  "Return the E for which EXACT, a rational above 0, is at least 10^E and below 10^(E+1)."
  (let ((exponent (floor (* (- (integer-length (numerator exact))
                               (integer-length (denominator exact)))
                            0.30103d0))))
    (loop while (>= exact (expt 10 (1+ exponent))) do (incf exponent))
    (loop while (< exact (expt 10 exponent)) do (decf exponent))
    exponent))

(defun rounded-decimal (exact digits)
  "Return the whole number M and the exponent E for which M x 10^E is EXACT, a rational above 0,
rounded to DIGITS significant digits; M ends in no zero."
  (let* ((exponent (- (decimal-exponent exact) (1- digits)))
         (whole (floor (+ 1/2 (/ exact (expt 10 exponent))))))
    (loop while (zerop (mod whole 10))
          do (setf whole (/ whole 10))
             (incf exponent))
    (values whole exponent)))

(defun decimal-text (whole exponent)
  "Return WHOLE x 10^EXPONENT as a decimal, or, where that is long, as 1.25e+9."
  (let* ((digits (format nil "~d" whole))
         (count (length digits))
         (point (+ count exponent)))    ; how many digits stand before the point
    (flet ((zeros (count) (make-string count :initial-element #\0)))
      (cond ((not (<= -2 point 7))
             (format nil "~a~@[.~a~]e~@d" (char digits 0) (and (> count 1) (subseq digits 1))
                     (1- point)))
            ((>= exponent 0) (concatenate 'string digits (zeros exponent)))
            ((plusp point)
             (concatenate 'string (subseq digits 0 point) "." (subseq digits point)))
            (t (concatenate 'string "0." (zeros (- point)) digits))))))

(defun number-text (number &optional (digits 4))
  "Return NUMBER for a report: DIGITS significant digits at most, but all of those before the point
of a number up to a million."
  (let ((size (abs number)))
    (cond ((zerop number) "0")
          ((and (floatp size) (> size most-positive-double-float)) "more than any number")
          (t (multiple-value-bind (whole exponent)
                 (rounded-decimal (rational size) (if (< size 1d7)
                                                      (max digits
                                                           (1+ (decimal-exponent (rational size))))
                                                      digits))
               (let ((text (plainly (decimal-text whole exponent))))
                 (if (minusp number) (concatenate 'string "-" text) text)))))))

(defun number-text-rounded (number up)
  "Return NUMBER, from 0, with as many digits as NUMBER-TEXT, rounded up if UP, else down.  Zeros at
the end are dropped."
  (let ((exact (exact-decimal number)))
    (if (zerop exact)
        "0"
        (let* ((exponent (- (decimal-exponent exact)
                            (if (< exact 10000000) (max 3 (decimal-exponent exact)) 3)))
               (unit (expt 10 exponent)))
          (number-text (* unit (if up (ceiling exact unit) (floor exact unit))))))))

(defun number-texts (&rest numbers)
  "Return texts of NUMBERS, with four significant digits, or as many more as show which differ."
  (loop for digits from 4
        for texts = (loop for number in numbers collect (number-text number digits))
        until (or (= digits 17)
                  (loop for (number . others) on numbers
                        for (text . other-texts) on texts
                        always (loop for other in others
                                     for other-text in other-texts
                                     always (or (= number other) (string/= text other-text)))))
        finally (return texts)))

(defun exact-number-text (number)
  "Return the shortest decimal that reads back as NUMBER, a double."
  (loop for digits from 1 to 17
        for text = (number-text number digits)
        when (eql number (as-double (first (read-all (string-source text))))) return text
        finally (return text)))

(defun plain-real (number)
  "Return NUMBER as an integer, if it is a whole one that is written shorter so."
  (if (and (< (abs number) 1d6) (= number (fround number)))
      (round number)
      number))

;;; As the paper prints qualities

(defun three-decimals (number)
  "Return NUMBER with three decimals, as 0.770."
  (format nil "~,3f" number))
