;;;; json.lisp -- the reader of JSON (RFC 8259, RFC 7464), with the tokens, limits and reports of
;;;; reader.lisp.

(in-package :supergrip)

(defstruct (json-array (:constructor make-json-array (elements)))
  "A JSON array; ELEMENTS is a list."
  (elements '() :type list))

(defstruct (json-object (:constructor make-json-object (members)))
  "A JSON object; MEMBERS is a list of (KEY . VALUE), in order, equal keys included."
  (members '() :type list))

(defstruct (json-literal (:constructor make-json-literal (text)))
  "true, false or null, by its TEXT."
  (text "" :type string))

(defstruct (json-number (:constructor make-json-number (text value)))
  "A number whose TEXT is kept; VALUE is as READ-DATUM returns it."
  (text "" :type string) value)

(defparameter +verbatim-key+ "data"
  "The key of an outermost object in whose value numbers keep their text.")
(defvar *verbatim* nil "True while such a value is being read.")

(defparameter +literals+
  (mapcar #'make-json-literal '("true" "false" "null"))
  "The three literals.")

(defconstant +separator+ (code-char 30)
  "The record separator, which stands before each value in JSON text sequences, and in no value.")

(declaim (inline json-blank-p))
(defun json-blank-p (character)
  (or (char= character #\Space) (char= character #\Newline) (char= character #\Return)
      (char= character #\Tab)))

(defun skip-white (source)
  "Skip white space; return the next character, or NIL at the end."
  (loop for character = (peek source)
        while (and character (json-blank-p character))
        do (next source)
        finally (return character)))

(defun skip-to-json (source)
  "Skip white space of any length, byte order marks, and the separators of text sequences; return
the first character of the next value, or NIL at the end."
  (end-record source)
  (loop for character = (peek source)
        do (cond ((null character) (return))
                 ((json-blank-p character) (next source))
                 ((or (char= character +mark+) (char= character +separator+)) (skip-mark source))
                 (t (return))))
  (start-record source)
  (peek source))

(defun take-character (source)
  "Take the character that SOURCE stands at."
  (next source))

(defun read-json (source)
  "Read the JSON value that SOURCE stands at, and return it: a number as READ-DATUM returns it, a
string, a JSON-ARRAY, a JSON-OBJECT or a JSON-LITERAL; under the key data of an object,
JSON-NUMBERs for numbers.  Signals a SYNTAX-ERROR."
  (start-record source)
  (read-value source 0))

(defun read-value (source depth)
  (declare (type (integer 0 1000) depth))
  (let ((character (skip-white source)))
    (note-place source depth)
    (case character
      ((nil) (fail source "a value is missing at the end"))
      (#\{ (read-object source (deeper source depth)))
      (#\[ (read-array source (deeper source depth)))
      (#\" (read-json-string source))
      (t (read-json-token source)))))

(defun read-members (source close what read)
  "Read what stands between commas as far as CLOSE by READ, a function, and return the list.
WHAT names it for the reports."
  (declare (function read))
  (let ((line (source-line source))
        (column (source-column source))
        (head (list nil)))
    (next source)
    (flet ((look ()
             (or (skip-white source)
                 (fail-at source line column "this ~a is never closed" what))))
      (unless (char= (look) close)
        (loop with tail = head
              do (look)
                 (setf (cdr tail) (list (funcall read source))
                       tail (cdr tail))
                 (let ((character (look)))
                   (cond ((char= character close) (return))
                         ((char= character #\,) (next source))
                         (t (fail source "a comma or ~a was expected, not ~a" close
                                  (character-description character)))))))
      (next source)
      (cdr head))))

(defun read-array (source depth)
  (make-json-array (read-members source #\] "array" (lambda (source) (read-value source depth)))))

(defun read-object (source depth)
  (incf (source-depth source))
  (let ((members (read-members source #\} "object"
                               (lambda (source) (read-member source depth)))))
    (decf (source-depth source))
    (make-json-object members)))

(defun read-member (source depth)
  "Read a key, which is a name, and its value."
  (unless (eql (peek source) #\")
    (fail source "a key in double quotes was expected, not ~a"
          (character-description (peek source))))
  (note-place source depth)
  (let ((line (source-line source))
        (column (source-column source))
        (key (read-json-string source)))
    (when (> (length key) (the fixnum *name-limit*))
      (fail-at source line column "a name of ~d character~:p; at most ~d ~:*~[~;is~:;are~] read"
               (length key) *name-limit*))
    (unless (eql (skip-white source) #\:)
      (fail-at source line column "the key \"~a\" is not followed by a colon" (excerpt key)))
    (next source)
    (unless (skip-white source)
      (fail-at source line column "the key \"~a\" has no value" (excerpt key)))
    (cons key (if (and (= depth 1) (string= key +verbatim-key+))
                  (let ((*verbatim* t)) (read-value source depth))
                  (read-value source depth)))))

(defun excerpt (text)
  "Return the first characters of TEXT, for a report."
  (visible-text (subseq text 0 (min 40 (length text)))))

;;; Strings

(declaim (inline plain-character-p))
(defun plain-character-p (character)
  "True if CHARACTER stands for itself in a string."
  (and (char>= character #\Space) (char/= character #\") (char/= character #\\)))

(defun read-json-string (source)
  (let ((line (source-line source))
        (column (source-column source))
        (count 0))
    (declare (fixnum count))
    (next source)
    (setf (source-inside source) :string)
    (loop
      (setf count (take-while #'plain-character-p source count))
      (let ((character (peek source)))
        (cond ((null character) (fail-at source line column "this string is never closed"))
              ((char< character #\Space)
               (fail source "in a string, ~a must be written as \\u~4,'0x"
                     (code-text character) (char-code character))))
        (next source)
        (when (char= character #\")
          (setf (source-inside source) nil)
          (let ((text (subseq (source-token source) 0 count)))
            (return (if (find-if #'surrogatep text) (join-surrogates text) text))))
        (setf count (push-token source (read-escape source) count))))))

(defun read-escape (source)
  "Return the character that the escape sequence after a \\ stands for."
  (let* ((character (peek source))
         (place (and character (position character "\"\\/bfnrt"))))
    (cond (place
           (next source)
           (schar (load-time-value
                   (coerce (list #\" #\\ #\/ #\Backspace #\Page #\Newline #\Return #\Tab)
                           'simple-string))
                  place))
          ((eql character #\u)
           (next source)
           (code-char (read-hex source)))
          (t (fail source "in a string, \\ may only come before one of \" \\ / b f n r t u")))))

(defun read-hex (source)
  "Read four hexadecimal digits."
  (let ((code 0))
    (dotimes (i 4 code)
      (let* ((character (peek source))
             (digit (and character (char< character (code-char 128))
                         (digit-char-p character 16))))
        (unless digit
          (fail source "\\u takes four hexadecimal digits"))
        (next source)
        (setf code (+ (* 16 code) digit))))))

(defun surrogatep (character)
  (char<= #.(code-char #xd800) character #.(code-char #xdfff)))

(defun join-surrogates (text)
  "Return TEXT with each pair of surrogates, as \\u escapes give them, made one character.
A surrogate alone, which is no character, becomes U+FFFD, as bytes that are not UTF-8 do."
  (let ((high nil))
    (with-output-to-string (out)
      (flet ((flush ()
               (when high (write-char (code-char #xfffd) out))
               (setf high nil)))
        (loop for character across text
              for code = (char-code character)
              do (cond ((<= #xd800 code #xdbff) (flush) (setf high code))
                       ((not (surrogatep character)) (flush) (write-char character out))
                       (high (write-char (code-char (+ #x10000 (ash (- high #xd800) 10)
                                                       (- code #xdc00)))
                                         out)
                             (setf high nil))
                       (t (write-char (code-char #xfffd) out))))
        (flush)))))

;;; Numbers and literals

(declaim (inline json-token-character-p))
(defun json-token-character-p (character)
  (or (char<= #\0 character #\9) (char<= #\a character #\z) (char<= #\A character #\Z)
      (char= character #\+) (char= character #\-) (char= character #\.)
      (char= character #\_)))

(defun read-json-token (source)
  "Read a number, true, false or null."
  (let* ((line (source-line source))
         (column (source-column source))
         (count (take-while #'json-token-character-p source 0)))
    (declare (fixnum count))
    (when (zerop count)
      (fail source "~a is not allowed here" (character-description (peek source))))
    (let ((token (source-token source)))
      (cond ((number-text-p token count)
             (let ((number (token-number source count line column)))
               (if *verbatim* (make-json-number (subseq token 0 count) number) number)))
            ((find-literal token count))
            (t (fail-at source line column
                        "~a is not JSON; 12, -0.5, 1e-3, \"a name\", true, false and null are"
                        (subseq token 0 (min count 24))))))))

(defun find-literal (token count)
  (find-if (lambda (literal)
             (let ((text (json-literal-text literal)))
               (and (= count (length text)) (string= token text :end1 count))))
           +literals+))

(defun number-text-p (token count)
  "True if the first COUNT characters of TOKEN are a number of JSON's grammar: no + before it, no 0
before its digits, and digits on both sides of a point."
  (declare (type (simple-array character (*)) token) (fixnum count))
  (flet ((at (place characters)
           (declare (fixnum place))
           (and (< place count) (find (schar token place) (the simple-string characters)))))
    (let* ((start (if (at 0 "-") 1 0))
           (end (digits-end token start count)))
      (declare (fixnum start end))
      (and (> end start)
           (or (= end (1+ start)) (not (at start "0")))
           (or (not (at end "."))
               (let ((fraction (digits-end token (1+ end) count)))
                 (prog1 (> fraction (1+ end))
                   (setf end fraction))))
           (or (not (at end "eE"))
               (let* ((first (if (at (1+ end) "+-") (+ end 2) (1+ end)))
                      (last (digits-end token first count)))
                 (prog1 (> last first)
                   (setf end last))))
           (= end count)))))

;;; Going on after an error

(defun skip-json (source stops &optional depth)
  "Skip what is left of a value in which READ-JSON has found an error: as far as the brace that
closes it.  Outside all braces, skip as far as one of the characters STOPS or the end of the line.
Brackets count for nothing inside braces, since the value may lack one; a separator before a brace
ends it.  DEPTH, if it is given, tells how many braces are open."
  (end-record source)
  (when depth (setf (source-depth source) depth))
  (loop for character = (peek source)
        while character
        until (and (zerop (source-depth source)) (null (source-inside source))
                   (find character (the simple-string stops)))
        do (next source)
           (when (skip-json-character source character)
             (return))))

(defun skip-json-character (source character)
  "Note what CHARACTER, just skipped, opens or closes; true if it ends the value."
  (cond ((char= character +separator+) (eql (peek source) #\{))
        ((char= character #\Newline)
         ;; No string goes on in the next line.
         (setf (source-inside source) nil)
         (zerop (source-depth source)))
        ((source-inside source)
         (case character
           (#\\ (unless (member (peek source) '(nil #\Newline)) (next source)))
           (#\" (setf (source-inside source) nil)))
         nil)
        (t
         (case character
           (#\" (setf (source-inside source) :string)
            nil)
           (#\{ (incf (source-depth source))
            nil)
           (#\} (and (plusp (source-depth source))
                     (zerop (decf (source-depth source)))))))))
