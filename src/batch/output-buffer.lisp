;;;; output-buffer.lisp -- text and numbers as UTF-8 in a buffer, written when the buffer is full.

(in-package :supergrip)

(defstruct (decimal (:constructor make-decimal (number digits exponent)) (:conc-name %decimal-))
  "A NUMBER with what SHORTEST-DIGITS returns of it."
  (number 0d0 :type double-float :read-only t)
  (digits "" :type simple-string :read-only t) (exponent 0 :type fixnum :read-only t))

(defstruct (output (:constructor make-output (descriptor)))
  "Where records go.  END octets of BUFFER are not written yet.  DECIMALS: see DIGITS-OF."
  (descriptor 1 :type fixnum)
  (buffer (make-array 65536 :element-type '(unsigned-byte 8)) :type octets)
  (end 0 :type fixnum)
  (decimals (make-array 251 :initial-element nil) :type (simple-vector 251)))

(defun flush-output (output)
  "Write what is in the buffer of OUTPUT.  Signals a SYSTEM-FAILURE."
  (let ((end (output-end output)))
    ;; What could not be written is not written again.
    (setf (output-end output) 0)
    (write-octets (output-descriptor output) (output-buffer output) end)))

(declaim (inline put-octet))
(defun put-octet (output octet)
  (declare (type output output) (type (unsigned-byte 8) octet))
  (when (= (output-end output) (length (output-buffer output)))
    (flush-output output))
  (setf (aref (output-buffer output) (output-end output)) octet)
  (incf (output-end output)))

(defun put-code (output code)
  "Put the character CODE, above 127, as UTF-8."
  (declare (type (integer 0 #x10ffff) code))
  (flet ((tail (shift)
           (put-octet output (logior #x80 (ldb (byte 6 shift) code)))))
    (cond ((< code #x800)
           (put-octet output (logior #xc0 (ash code -6))))
          ((< code #x10000)
           (put-octet output (logior #xe0 (ash code -12)))
           (tail 6))
          (t
           (put-octet output (logior #xf0 (ash code -18)))
           (tail 12)
           (tail 6)))
    (tail 0)))

(declaim (inline put-character))
(defun put-character (output character)
  (let ((code (char-code character)))
    (if (< code 128)
        (put-octet output code)
        (put-code output code))))

(declaim (inline put-ascii))
(defun put-ascii (output text)
  "Put the characters of TEXT that are ASCII, up to the first other one, as far as there is room,
and return where they end."
  (declare (type output output))
  (let* ((buffer (output-buffer output))
         (start (output-end output))
         (room (- (length buffer) start))
         (end (loop for place of-type fixnum below (min room (length text))
                    for code = (char-code (char text place))
                    while (< code 128)
                    do (setf (aref buffer (+ start place)) code)
                    finally (return place))))
    (setf (output-end output) (+ start end))
    end))

(defun put-text (output text)
  "Put TEXT, a string, as it is."
  (flet ((put (text)
           (loop for place of-type fixnum from (put-ascii output text) below (length text)
                 do (put-character output (char text place)))))
    (declare (inline put))
    (etypecase text
      ((simple-array character (*)) (put text))
      (simple-base-string (put text))
      (string (put text)))))

(defun put-visible (output text)
  "Put TEXT, a string of one line or several, for people: what a terminal would obey goes by its
name."
  (loop for character across text
        do (if (and (or (char< character #\Space) (< 126 (char-code character) 160))
                    (char/= character #\Newline))
               (put-text output (format nil "<~a>" (code-text character)))
               (put-character output character))))

(defun put-integer (output number)
  "Put NUMBER, an integer, in decimal."
  (cond ((minusp number)
         (put-octet output 45)
         (put-integer output (- number)))
        ((typep number '(unsigned-byte 62)) (put-fixnum output number))
        (t (put-text output (princ-to-string number)))))

(defun put-fixnum (output number)
  (declare (type (unsigned-byte 62) number))
  (multiple-value-bind (tens digit) (truncate number 10)
    (when (plusp tens) (put-fixnum output tens))
    (put-octet output (+ 48 digit))))

(defun put-double (output number &optional lisp)
  "Put the shortest decimal that reads back as NUMBER, a double: 0.86, 12.0, 1.5e-7.
If LISP is true, mark it as a double: 0.86d0, 1.5d-7."
  (declare (double-float number))
  (when (minusp number) (put-octet output 45))
  (let ((size (abs number)))
    (multiple-value-bind (whole part) (if (< size 1d15) (truncate size) (values 0 size))
      (if (zerop part)
          (progn (put-fixnum output whole)
                 (put-text output (if lisp ".0d0" ".0")))
          (multiple-value-bind (digits exponent) (digits-of output size)
            (cond ((< -6 exponent 22)
                   (put-plain output digits exponent)
                   (when lisp (put-text output "d0")))
                  (t (put-scientific output digits exponent (if lisp #\d #\e)))))))))

(defun digits-of (output number)
  "Return what SHORTEST-DIGITS does of NUMBER.  A record has many numbers more than once, and some
are in all records: those that were put into OUTPUT last are kept."
  (declare (double-float number))
  (let* ((table (output-decimals output))
         (place (mod (double-bits number) (length table)))
         (known (svref table place)))
    (unless (and known (= number (%decimal-number known)))
      (multiple-value-bind (digits exponent) (shortest-digits number)
        (setf known (make-decimal number digits exponent)
              (svref table place) known)))
    (values (%decimal-digits known) (%decimal-exponent known))))

(defun put-plain (output digits exponent)
  "Put 0.DIGITS x 10^EXPONENT without an exponent."
  (declare (simple-string digits) (fixnum exponent))
  (let ((count (length digits)))
    (cond ((<= exponent 0)
           (put-text output "0.")
           (loop repeat (- exponent) do (put-octet output 48))
           (put-text output digits))
          (t
           (loop for place from 0 below (max exponent count)
                 do (when (= place exponent) (put-octet output 46))
                    (put-character output (if (< place count) (schar digits place) #\0)))
           (when (>= exponent count) (put-text output ".0"))))))

(defun put-scientific (output digits exponent mark)
  "Put 0.DIGITS x 10^EXPONENT with one digit before the point, and MARK before the exponent."
  (declare (simple-string digits) (fixnum exponent))
  (put-character output (schar digits 0))
  (put-octet output 46)
  (if (= (length digits) 1)
      (put-octet output 48)
      (loop for place from 1 below (length digits)
            do (put-character output (schar digits place))))
  (put-character output mark)
  (put-integer output (1- exponent)))

;;; Standard error

(defun tell (control &rest arguments)
  "Write a line to standard error, if that can be done."
  (let ((output (make-output 2)))
    (handler-case (progn (put-visible output (apply #'format nil control arguments))
                         (put-octet output 10)
                         (flush-output output))
      (system-failure () nil))))
