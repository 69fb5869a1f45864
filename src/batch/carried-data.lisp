;;;; carried-data.lisp -- DATA, which a box carries along, is written in JSON or in Lisp, whatever
;;;; its notation was in the box.
;;;;
;;;; The file also writes strings.

(in-package :supergrip)

;;; Strings

(declaim (inline control-code-p))
(defun control-code-p (code)
  "True if CODE, above 31, is that of a character that a terminal obeys or that ends a line."
  (and (> code 126) (or (< code 160) (= code #x2028) (= code #x2029))))

(defun plain-string-p (text)
  "True if all of TEXT, a string, can stand between double quotes as it is, in Lisp and in JSON."
  (flet ((plain-p (text)
           (loop for character across text
                 always (and (char<= #\Space character #\~)
                             (char/= character #\") (char/= character #\\)))))
    (declare (inline plain-p))
    (etypecase text
      ((simple-array character (*)) (plain-p text))
      (simple-base-string (plain-p text))
      (string (plain-p text)))))

(defun put-lisp-string (text output)
  "Put TEXT between double quotes.  Lisp has no escapes for control characters, and a record is one
line: they become their pictures, as U+240A for a newline, or their names, as <U+0085>."
  (put-octet output 34)
  (if (plain-string-p text)
      (put-text output text)
      (loop for character across (the string text)
            for code = (char-code character)
            do (cond ((< code 32) (put-code output (+ #x2400 code)))
                     ((= code 127) (put-code output #x2421))
                     ((< 127 code 160) (put-text output (format nil "<~a>" (code-text character))))
                     (t (when (or (= code 34) (= code 92)) (put-octet output 92))
                        (put-character output character)))))
  (put-octet output 34))

(defun put-json-string (text output)
  (put-octet output 34)
  (if (plain-string-p text)
      (put-text output text)
      (loop for character across (the string text)
            for code = (char-code character)
            do (cond ((or (< code 32) (control-code-p code))
                      (put-text output (format nil "\\u~4,'0x" code)))
                     (t (when (or (= code 34) (= code 92)) (put-octet output 92))
                        (put-character output character)))))
  (put-octet output 34))

;;; Data, as Lisp.  What JSON has and lists have not begins with a keyword.

(defun put-lisp-list (put-first list output)
  "Put a list: what PUT-FIRST puts, if it is not NIL, then the elements of LIST."
  (put-octet output 40)
  (when put-first (put-text output put-first))
  (loop for (element . rest) on list
        for first = (null put-first) then nil
        do (unless first (put-octet output 32))
           (put-lisp-data element output))
  (put-octet output 41))

(defun string-parts (text)
  "Return TEXT as a list of strings without control characters, and the codes of those between
them."
  (let ((start 0) (parts '()))
    (flet ((part (end)
             (when (< start end) (push (subseq text start end) parts))))
      (loop for character across text
            for place from 0
            for code = (char-code character)
            when (or (< code 32) (control-code-p code))
              do (part place)
                 (push code parts)
                 (setf start (1+ place)))
      (part (length text)))
    (reverse parts)))

(defun put-lisp-data (value output)
  "Put VALUE, a form or a JSON value, as a form of one line."
  (typecase value
    (null (put-text output "NIL"))
    (string (let ((parts (string-parts value)))
              (if (or (null parts) (equal parts (list value)))
                  (put-lisp-string value output)
                  (put-lisp-list ":STRING" parts output))))
    (integer (put-integer output value))
    (double-float (put-double output value t))
    (json-number (put-lisp-data (json-number-value value) output))
    (json-array (put-lisp-data (json-array-elements value) output))
    (json-object (put-lisp-list ":OBJECT" (loop for (key . value) in (json-object-members value)
                                                collect key collect value)
                                output))
    (json-literal (put-text output (format nil ":~:@(~a~)" (json-literal-text value))))
    (cons (put-lisp-list nil value output))
    (symbol (put-text output (symbol-name value)))
    (t (put-text output (princ-to-string value)))))

;;; Data, as JSON

(defun literal-form (form)
  "Return the text of the JSON literal that FORM, as PUT-LISP-DATA writes it, stands for, or NIL."
  (let ((name (name-in form '("TRUE" "FALSE" "NULL"))))
    (and name (string-downcase name))))

(defun string-form (form)
  "Return the string that FORM, as PUT-LISP-DATA writes it, stands for, or NIL."
  (and (part-p form "STRING")
       (every (lambda (part) (or (stringp part) (typep part '(mod #.char-code-limit)))) (rest form))
       (format nil "~{~a~}" (loop for part in (rest form)
                                  collect (if (stringp part) part (code-char part))))))

(defun object-form-p (form)
  "True if FORM is an object as PUT-LISP-DATA writes it: keys, strings, and values in turn."
  (and (part-p form "OBJECT")
       (evenp (length (rest form)))
       (loop for (key) on (rest form) by #'cddr always (stringp key))))

(defun put-json-data (value output)
  "Put VALUE, a form or a JSON value, as JSON."
  (flet ((between (open elements close put)
           (put-octet output (char-code open))
           (loop for (element . rest) on elements
                 do (funcall put element)
                    (when rest (put-octet output 44)))
           (put-octet output (char-code close)))
         (member-out (member)
           (put-json-string (car member) output)
           (put-octet output 58)
           (put-json-data (cdr member) output)))
    (typecase value
      (string (put-json-string value output))
      (integer (put-integer output value))
      (double-float (put-double output value))
      (ratio (put-json-ratio value output))
      (json-number (put-text output (json-number-text value)))
      (json-literal (put-text output (json-literal-text value)))
      (json-object (between #\{ (json-object-members value) #\} #'member-out))
      (t (let ((elements (cond ((json-array-p value) (json-array-elements value))
                               ((name= value "NIL") '())
                               (t value))))
           (cond ((literal-form value) (put-text output (literal-form value)))
                 ((string-form value) (put-json-string (string-form value) output))
                 ((object-form-p value)
                  (between #\{ (loop for (key value) on (rest value) by #'cddr
                                     collect (cons key value))
                           #\} #'member-out))
                 ((listp elements)
                  (between #\[ elements #\] (lambda (element) (put-json-data element output))))
                 (t (put-json-string (symbol-name value) output))))))))

(defun put-json-ratio (ratio output)
  "Put the double nearest to RATIO, or, if none is, its text."
  (let ((double (as-double ratio)))
    (if double
        (put-double output double)
        (put-json-string (princ-to-string ratio) output))))
