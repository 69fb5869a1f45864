;;;; numbers.lisp -- numbers and lists as readers see them, and what can't be drawn.
;;;;
;;;; All is computed with rationals, so that every Lisp writes the same picture.

(in-package :supergrip-draw)

(defparameter +minus+ (code-char #x2212) "A true minus sign.")

(defun finite (number)
  "Return NUMBER; signal an error if it is infinite or not a number, as where traps are masked."
  (if (<= (abs number) most-positive-double-float)
      number
      (error 'floating-point-overflow :operation 'finite :operands (list number))))

(defun rounded (number digits)
  "Return the whole number nearest to NUMBER x 10^DIGITS, halves away from zero."
  (let ((scaled (* (rationalize (finite number)) (expt 10 digits))))
    (* (signum scaled) (floor (+ (abs scaled) 1/2)))))

(defun fixed (number digits &optional (minus +minus+))
  "Return NUMBER with DIGITS decimals, as 0.770."
  (let ((scaled (rounded number digits)))
    (multiple-value-bind (whole part) (floor (abs scaled) (expt 10 digits))
      (format nil "~:[~;~:*~c~]~d~:[~;~:*.~v,'0d~]" (and (minusp scaled) minus) whole
              (and (plusp digits) digits) part))))

(defun decimal (number &optional (digits 2))
  "Return NUMBER with DIGITS decimals at most."
  (let ((text (fixed number digits)))
    (if (find #\. text)
        (string-right-trim "." (string-right-trim "0" text))
        text)))

(defun index-text (number)
  "Return NUMBER, a quality or a radius, with three decimals as the session has it."
  (if (< (abs number) 1d7) (fixed number 3) (quantity number)))

(defun magnitude (number)
  "Return the power of ten of the first digit of NUMBER, not zero: 0 for 1 to 9.99."
  (let* ((exact (abs (rational (finite number))))
         (guess (floor (* (- (integer-length (numerator exact))
                             (integer-length (denominator exact)))
                          0.30103d0))))
    (loop while (< exact (expt 10 guess)) do (decf guess))
    (loop while (>= exact (expt 10 (1+ guess))) do (incf guess))
    guess))

(defun quantity (number &optional (digits 3))
  "Return NUMBER with DIGITS significant digits, and all digits before the point; as 1e300 if it is
very large or small.  What is not zero is not written as zero."
  (if (zerop number)
      "0"
      (let ((power (magnitude number)))
        (if (< -5 power 7)
            (decimal number (max 0 (- digits 1 power)))
            (scientific number power digits)))))

(defun scientific (number power digits)
  (let ((first-digits (decimal (/ (rational number) (expt 10 power)) (1- digits))))
    (if (member first-digits '("10" "−10") :test #'string=)
        (format nil "~ae~d" (subseq first-digits 0 (1- (length first-digits))) (1+ power))
        (format nil "~ae~d" first-digits power))))

(defun length-text (number)
  "Return NUMBER, a length in cm, for a reader, in *UNITS*."
  (quantity (in-units number :length) 3))

(defun size-text (sizes)
  "Return the SIZES of a box, in cm, for a reader, in *UNITS*."
  (with-unit (format nil "~{~a~^ × ~}" (mapcar (lambda (size) (quantity (in-units size :length) 4))
                                               sizes))
    :length))

(defun list-text (items)
  "Return ITEMS as \"a\", \"a and b\", or \"a, b and c\"."
  (format nil "~{~a~^, ~}~:[~; and ~]~a" (butlast items) (rest items) (first (last items))))

;;; What can't be drawn

(define-condition drawing-error (supergrip-error)
  ((what :initarg :what :reader drawing-error-what)
   (reason :initarg :reason :reader drawing-error-reason))
  (:report (lambda (condition stream)
             (format stream "~a can't be drawn: ~a" (drawing-error-what condition)
                     (drawing-error-reason condition))))
  (:documentation "A picture or a page can't be drawn.  Nothing was written."))

(setf (documentation 'drawing-error-what 'function)
      "Return what can't be drawn, as text: a box with its sizes, or the name of a picture."
      (documentation 'drawing-error-reason 'function)
      "Return why it can't be drawn, as text.")

(defparameter +drawable-sizes+ '(1d-6 1d9)
  "The least and the greatest size of a box, in cm, that can be drawn.")

(defun box-text (box)
  "Return name and sizes of BOX, in its units, for a heading."
  (let ((*units* (%box-units box)))
    (format nil "~@[~a, ~]~a" (box-name box) (size-text (box-size box)))))

(defun call-drawing (what function)
  "Call FUNCTION.  Numbers that leave the range of doubles in it are a DRAWING-ERROR about WHAT."
  (handler-case (funcall function)
    (arithmetic-error ()
      (error 'drawing-error :what what :reason "a length or a figure is too large or too small"))))

(defun call-drawing-box (box function)
  "Call FUNCTION, which draws BOX, or signal a DRAWING-ERROR."
  (destructuring-bind (least most) +drawable-sizes+
    (unless (every (lambda (size) (<= least size most)) (box-size box))
      (error 'drawing-error :what (box-text box)
                            :reason (format nil "sizes from ~a to ~a cm can be"
                                            (quantity least) (quantity most)))))
  (call-drawing (box-text box) function))

(defmacro drawing ((what) &body body)
  "Run BODY, which draws WHAT, a plan or the name of a picture, in the units of its box; signal a
DRAWING-ERROR if it can't."
  (let ((value (gensym "WHAT")) (run (gensym "RUN")))
    `(let ((,value ,what))
       (flet ((,run () (with-standard-io-syntax
                         (let ((*print-readably* nil) (*read-eval* nil))
                           ,@body))))
         (cond ((stringp ,value) (call-drawing ,value #',run))
               (t (let ((*units* (%box-units (plan-box ,value))))
                    (call-drawing-box (plan-box ,value) #',run))))))))

(defun check-coordinate (number)
  "Return NUMBER, a coordinate of a picture, or signal an error if no picture can have it."
  (if (< -1d7 number 1d7)
      number
      (error 'floating-point-overflow :operation 'check-coordinate :operands (list number))))
