;;;; text.lisp -- numbers and strings as YAML, JSON and XML all read them; names that are safe for
;;;; files.

(in-package :supergrip)

(defun number-in-text (number)
  "Return NUMBER, a double, as its shortest decimal: 0.86, 12.0, 1.5e-7, 1.0e+22.  YAML takes what
has no point, or no sign in its exponent, for a string."
  (let* ((text (let ((*read-default-float-format* 'double-float))
                 (prin1-to-string (without-sign-of-zero number))))
         (mark (position #\e text)))
    (if (and mark (digit-char-p (char text (1+ mark))))
        (format nil "~a+~a" (subseq text 0 (1+ mark)) (subseq text (1+ mark)))
        text)))

(defun numbers-in-text (numbers &optional (between ", "))
  "Return NUMBERS, a list of doubles, with BETWEEN between them."
  (list-in-text (mapcar #'number-in-text numbers) between))

(defun list-in-text (texts &optional (between ", "))
  "Return TEXTS, a list of strings, as one, with BETWEEN between them."
  (with-output-to-string (out)
    (loop for (text . others) on texts
          do (write-string text out)
             (when others (write-string between out)))))

(defun escaped (character notation)
  "Return what stands for CHARACTER in a string of NOTATION, :YAML or :JSON, between double quotes."
  (let ((code (char-code character)))
    (cond ((find character "\"\\") (format nil "\\~c" character))
          ((or (<= 32 code 126) (and (> code 160) (alphanumericp character)))
           (string character))
          ((< code #x10000) (format nil "\\u~4,'0x" code))
          ((eq notation :yaml) (format nil "\\U~8,'0x" code))
          (t (format nil "\\u~4,'0x\\u~4,'0x" (+ #xd800 (ash (- code #x10000) -10))
                     (+ #xdc00 (logand code #x3ff)))))))

(defun quoted-text (text notation)
  "Return TEXT, a string, between double quotes, on one line, as NOTATION, :YAML or :JSON, has it."
  (with-output-to-string (out)
    (write-char #\" out)
    (loop for character across text
          do (write-string (escaped character notation) out))
    (write-char #\" out)))

(defun file-stem (name)
  "Return NAME, that of a box or NIL, as the name of a file without its type: small letters and
digits of ASCII, and -; 40 at most."
  (let* ((name (or name ""))
         (letters (map 'string (lambda (character)
                                 (if (and (< (char-code character) 128) (alphanumericp character))
                                     (char-downcase character)
                                     #\-))
                       (subseq name 0 (min 40 (length name)))))
         (stem (string-trim "-" letters)))
    (if (string= stem "") "box" stem)))
