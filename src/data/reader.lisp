;;;; reader.lisp -- the reader of all data files: rules, grasps, boxes.
;;;;
;;;; Lists, quoted forms, strings, ; comments, decimal numbers, ratios and names; anything else
;;;; is a SYNTAX-ERROR with line and column.  Its limits are enforced while it reads, so no input
;;;; can exhaust the stack or the heap, and it never interns.  It is used in place of READ, which
;;;; interns, recurses without bound and evaluates #. forms.

(in-package :supergrip-data)

(defparameter *depth-limit* 32 "How deep lists may nest.")
(defparameter *record-limit* 65536 "The most characters that one outermost form may have.")
(defparameter *name-limit* 64 "The most characters that a name may have.")

(defconstant +mark+ (code-char #xfeff)
  "The byte order mark, which may stand before each of several files that were put together.")

(defconstant +unbounded+ (ash 1 60) "The BOUND of a source between records.")

(defstruct (source (:constructor make-source (buffer end &key refill name)))
  "Where characters come from.  REFILL is NIL or a function without arguments that returns the
next buffer, its end and, if that is not 0, the place where its characters begin; or NIL at the
end.  DEPTH and INSIDE (NIL, :STRING or :COMMENT) tell where in a record an error was found.
BOUND is the place in the buffer where the record that is being read has all the characters that it
may have.  TRACK tells where each part of the record begins (see NOTE-PLACE)."
  (buffer "" :type (simple-array character (*)))
  (position 0 :type fixnum)
  (end 0 :type fixnum)
  (refill nil :type (or null function))
  (name nil)
  (line 1 :type fixnum)
  (offset 0 :type fixnum)               ; of the buffer's first character in the whole input
  (line-offset 0 :type fixnum)          ; of the current line's first character
  (bound +unbounded+ :type fixnum)
  (record-start-line 1 :type fixnum)
  (depth 0 :type fixnum)                ; how many lists are open
  (inside nil :type symbol)
  (lines nil)                           ; NIL or a table from list to line
  (comment '() :type list)              ; the lines of comment just before, the latest first
  (comments nil)                        ; NIL or a table from outermost list to its comment
  (track (make-array 256 :element-type 'fixnum) :type (simple-array fixnum (*)))
  (track-end 0 :type fixnum)
  (token (make-string 128) :type (simple-array character (*))))

(defun string-source (string &key name)
  "Return a source that reads STRING.  NAME is used in reports."
  (let ((buffer (coerce string '(simple-array character (*)))))
    (make-source buffer (length buffer) :name name)))

(defun source-column (source)
  "Return the column, from 1, of the next character."
  (1+ (- (+ (source-offset source) (source-position source)) (source-line-offset source))))

(defun refuse-syntax (place control &rest arguments)
  "Signal a SYNTAX-ERROR that says what CONTROL and ARGUMENTS say.  PLACE says where: some keys and
values of its problem."
  (let ((text (apply #'plain-text control arguments)))
    (error 'syntax-error :problems (list (apply #'make-problem :text text place)))))

(defun fail-at (source line column control &rest arguments)
  "Signal a SYNTAX-ERROR at LINE and COLUMN of SOURCE that says what CONTROL and ARGUMENTS say."
  (apply #'refuse-syntax (list :file (source-name source) :line line :column column)
         control arguments))

(defun fail (source control &rest arguments)
  "Signal a SYNTAX-ERROR where SOURCE stands, as FAIL-AT does."
  (apply #'fail-at source (source-line source) (source-column source) control arguments))

;;; Characters

(defun too-long (source)
  (fail source "the form that begins in line ~d is longer than ~d character~:p"
        (source-record-start-line source) *record-limit*))

(defun refill (source)
  "Get more characters.  Returns NIL at the end of the input."
  (when (source-refill source)
    (multiple-value-bind (buffer end start) (funcall (source-refill source))
      (when buffer
        (let ((start (or start 0)))
          (incf (source-offset source) (- (source-end source) start))
          (decf (source-bound source) (- (source-end source) start))
          (setf (source-buffer source) buffer
                (source-position source) start
                (source-end source) end)
          t)))))

(declaim (inline peek next))
(defun peek (source)
  "Return the next character without taking it, or NIL at the end."
  (if (or (< (source-position source) (source-end source)) (refill source))
      (schar (source-buffer source) (source-position source))
      nil))

(defun next (source)
  "Take the character that PEEK returned.  Signals a SYNTAX-ERROR if the record is too long; every
character of a record comes through here, or through TAKE-WHILE."
  (when (>= (source-position source) (source-bound source))
    (too-long source))
  (let ((character (schar (source-buffer source) (source-position source))))
    (incf (source-position source))
    (when (char= character #\Newline)
      (incf (source-line source))
      (setf (source-line-offset source) (+ (source-offset source) (source-position source))))
    character))

(declaim (inline blankp delimiterp))
(defun blankp (character)
  (or (char= character #\Space) (char= character #\Newline) (char= character #\Tab)
      (char= character #\Return) (char= character #\Page)))

(defun delimiterp (character)
  (or (blankp character) (char= character #\() (char= character #\)) (char= character #\')
      (char= character #\") (char= character #\;)))

(declaim (inline name-character-p))
(defun name-character-p (character)
  (let ((code (char-code character)))
    (and (< code 128)
         (= 1 (sbit (load-time-value
                     (let ((bits (make-array 128 :element-type 'bit :initial-element 0)))
                       (dotimes (code 128 bits)
                         (when (or (alphanumericp (code-char code))
                                   (find (code-char code) "-+*/<>=?!._%&$"))
                           (setf (sbit bits code) 1)))))
                    code)))))

(defun character-description (character)
  "Return CHARACTER, or what it is called if it can't be seen or stands for what is not UTF-8."
  (case character
    (#\Space "a space")
    (#\Newline "the end of the line")
    (#.(code-char #xfffd) "what is not UTF-8 (U+FFFD)")
    (#.(code-char 0) "U+0000 (is this UTF-16?)")
    (t (if (invisible-p character) (code-text character) (string character)))))

(defun utf-16-p (text start end)
  "True if TEXT from START to END, made of octets as if they were UTF-8, is UTF-16, whose first
characters are ASCII: every other octet of them is 0."
  (declare (type (simple-array character (*)) text))
  (let ((start (or (position (code-char #xfffd) text :start start :end (min end (+ start 2))
                                                     :test-not #'char=)
                   (min end (+ start 2)))))
    (flet ((zero-p (place) (char= (schar text place) (code-char 0))))
      (and (>= (- end start) 4)
           (loop for place from start below (+ start 3)
                 never (eq (zero-p place) (zero-p (1+ place))))))))

;;; Where the parts of a record are

(declaim (inline note-place))
(defun note-place (source depth)
  "Note that a part of the record begins here: a form, or the key of an object.  DEPTH lists are
around it."
  (declare (type (integer 0 1001) depth))
  (let ((end (source-track-end source)))
    (when (= end (length (source-track source)))
      (setf (source-track source)
            (replace (make-array (* 2 end) :element-type 'fixnum) (source-track source))))
    (setf (aref (source-track source) end)
          (logior (ash (ldb (byte 32 0) (source-column source)) 30)
                  (ash (ldb (byte 20 0) (- (source-line source) (source-record-start-line source)))
                       10)
                  (min depth 1000))
          (source-track-end source) (1+ end))))

(defun part-place (source path)
  "Return the line and the column of a part of the record read last.  PATH says which: (1 2) is the
third part of the second part of it.  Of a part that is not there, the one around it is told."
  (let* ((track (source-track source)) (end (source-track-end source)) (place 0))
    (flet ((depth (place) (ldb (byte 10 0) (aref track place))))
      (dolist (number path)
        (let ((part (loop with depth = (depth place)
                          for next from (1+ place) below end
                          while (> (depth next) depth)
                          when (and (= (depth next) (1+ depth)) (minusp (decf number)))
                            return next)))
          (if part (setf place part) (return)))))
    (values (+ (source-record-start-line source) (ldb (byte 20 10) (aref track place)))
            (ldb (byte 32 30) (aref track place)))))

(defun skip-comment (source)
  (loop for c = (peek source)
        while (and c (char/= c #\Newline))
        do (next source)))

(defun skip-blanks (source)
  "Skip white space and comments; return the next character, or NIL at the end."
  (loop for character = (peek source)
        do (cond ((null character) (return nil))
                 ((blankp character) (next source))
                 ((char= character #\;)
                  (setf (source-inside source) :comment)
                  (skip-comment source)
                  (setf (source-inside source) nil))
                 (t (return character)))))

;;; Forms

(defun end-of-data ()
  "The object that READ-DATUM returns at the end of the input."
  'end-of-data)

(defun read-datum (source)
  "Read the next outermost form of SOURCE and return it, or (END-OF-DATA).
Names become symbols that are to be compared by their letters (NAME=), in upper case; numbers
integers, ratios or doubles; 'X becomes (QUOTE X).  Signals a SYNTAX-ERROR."
  (if (skip-to-record source)
      (let ((form (read-form source 0)))
        (when (source-comments source)
          (keep-comment form source))
        form)
      (end-of-data)))

(defun keep-comment (form source)
  "Keep the comment that stands just before FORM."
  (when (consp form)
    (setf (gethash form (source-comments source)) (reverse (source-comment source))))
  (setf (source-comment source) '()))

(defun skip-to-record (source)
  "Skip white space, byte order marks and comments of any length; return the first character of the
next record, or NIL at the end."
  (end-record source)
  (loop for character = (peek source)
        do (cond ((null character) (return))
                 ((or (blankp character) (char= character #\;)) (skip-between source))
                 ((char= character +mark+) (skip-mark source))
                 (t (return))))
  (start-record source)
  (peek source))

(defun start-record (source)
  "Note that a record begins where SOURCE stands: *RECORD-LIMIT* counts from here."
  (setf (source-bound source) (+ (source-position source) (the fixnum *record-limit*))
        (source-record-start-line source) (source-line source)
        (source-track-end source) 0
        (source-depth source) 0
        (source-inside source) nil))

(defun end-record (source)
  "Let what comes have any length, until START-RECORD."
  (setf (source-bound source) +unbounded+))

(defun skip-mark (source)
  "Take a character that counts for nothing, not even as a column."
  (next source)
  (incf (source-line-offset source)))

(defun skip-between (source)
  "Skip one blank character, or a comment of any length, between outermost forms.
Where comments are wanted, the lines just before a form are kept; an empty line drops them."
  (cond ((char= (peek source) #\;)
         (if (source-comments source)
             (push (read-comment source) (source-comment source))
             (skip-comment source)))
        ((and (char= (next source) #\Newline) (eql (peek source) #\Newline))
         (setf (source-comment source) '()))))

(defun read-comment (source)
  "Read the comment that begins here and return its text, at most a line's length of it."
  (string-trim "; "
               (with-output-to-string (out)
                 (loop for c = (peek source)
                       for count from 0
                       while (and c (char/= c #\Newline))
                       do (when (< count 200) (write-char c out))
                          (next source)))))

(defun read-form (source depth)
  "Read the next form; there must be one."
  (declare (type (integer 0 1000) depth))
  (let ((character (skip-blanks source)))
    (note-place source depth)
    (cond ((char= character #\() (read-list source depth))
          ((char= character #\') (read-quoted source depth))
          ((char= character #\") (read-string source))
          ((char= character #\)) (fail source "a closing parenthesis too many"))
          (t (read-token source)))))

(defun deeper (source depth)
  "Return DEPTH plus 1; signal a SYNTAX-ERROR if that is deeper than *DEPTH-LIMIT*."
  (declare (fixnum depth))
  (when (>= depth (the fixnum *depth-limit*))
    (fail source "lists nest deeper than ~d" *depth-limit*))
  (1+ depth))

(defun read-list (source depth)
  (let* ((line (source-line source))
         (column (source-column source))
         (depth (deeper source depth))
         (head (list nil))
         (tail head))
    (next source)
    (incf (source-depth source))
    (loop for character = (skip-blanks source)
          do (cond ((null character)
                    (fail-at source line column "this parenthesis is never closed"))
                   ((char= character #\))
                    (next source)
                    (decf (source-depth source))
                    (return))
                   (t (setf (cdr tail) (list (read-form source depth))
                            tail (cdr tail)))))
    (when (and (source-lines source) (cdr head))
      (setf (gethash (cdr head) (source-lines source)) line))
    (cdr head)))

(defun read-quoted (source depth)
  (declare (type (integer 0 1000) depth))
  (let ((line (source-line source))
        (column (source-column source)))
    (next source)
    (note-place source (1+ depth))      ; as if QUOTE stood there
    (unless (skip-blanks source)
      (fail-at source line column "nothing follows this '"))
    (let ((form (list :quote (read-form source (deeper source depth)))))
      (when (source-lines source)
        (setf (gethash form (source-lines source)) line))
      form)))

(defun read-string (source)
  (let ((line (source-line source))
        (column (source-column source))
        (count 0))
    (declare (fixnum count))
    (next source)
    (setf (source-inside source) :string)
    (loop
      (let ((character (peek source)))
        (when (null character)
          (fail-at source line column "this string is never closed"))
        (next source)
        (case character
          (#\" (setf (source-inside source) nil)
           (return (subseq (source-token source) 0 count)))
          (#\\ (setf character (peek source))
           (unless (member character '(#\" #\\))
             (fail source "in a string, \\ may only come before \\ or \""))
           (next source)))
        (setf count (push-token source character count))))))

(defun push-token (source character count)
  "Put CHARACTER at COUNT into the token of SOURCE, and return the new count."
  (declare (character character) (fixnum count))
  (let ((token (source-token source)))
    (when (= count (length token))
      (setf token (replace (make-string (* 2 count)) token)
            (source-token source) token))
    (setf (schar token count) character)
    (1+ count)))

(defun put-in-token (source end count)
  "Take the characters of the buffer of SOURCE before END, put them at COUNT into its token, and
return the new count."
  (declare (fixnum end count))
  (let* ((start (source-position source))
         (new-count (+ count (- end start)))
         (token (source-token source)))
    (when (> new-count (length token))
      (setf token (replace (make-string (* 2 new-count)) token)
            (source-token source) token))
    (replace token (source-buffer source) :start1 count :start2 start :end2 end)
    (setf (source-position source) end)
    new-count))

(declaim (inline take-while))
(defun take-while (wanted source count)
  "Take the characters that come next, as long as the function WANTED is true of them, which it
never is of the end of a line; put them at COUNT into the token of SOURCE, and return the new count.
Signals a SYNTAX-ERROR if the record is too long."
  (declare (function wanted) (fixnum count))
  (loop
    (let* ((buffer (source-buffer source))
           (limit (min (source-end source) (source-bound source)))
           (end (loop for place of-type fixnum from (source-position source) below limit
                      while (funcall wanted (schar buffer place))
                      finally (return place))))
      (setf count (put-in-token source end count))
      (let ((character (and (= end limit) (peek source))))
        (unless (and character (funcall wanted character)) (return count))
        (when (>= (source-position source) (source-bound source)) (too-long source))))))

(defun read-token (source)
  (let* ((line (source-line source))
         (column (source-column source))
         (count (take-while #'name-character-p source 0))
         (character (peek source)))
    (declare (fixnum count))
    (unless (or (null character) (delimiterp character))
      (fail source "~a is not allowed in a name or a number~:[~;: a list whose entries ~
                    are computed is written (LIST 0 0 0 0 (- x) x)~]"
            (character-description character) (and (zerop count) (find character "`,"))))
    (when (zerop count)
      (fail source "~a is not allowed here" (character-description (peek source))))
    (if (number-start-p (source-token source) count)
        (token-number source count line column)
        (token-name source count line column))))

(defun number-start-p (token count)
  (declare (type (simple-array character (*)) token) (fixnum count))
  (flet ((digit-at (i) (and (< i count) (char<= #\0 (schar token i) #\9))))
    (or (digit-at 0)
        (let ((i (if (signp (schar token 0)) 1 0)))
          (or (digit-at i)
              (and (< i count) (char= (schar token i) #\.) (digit-at (1+ i))))))))

(defun token-number (source count line column)
  "Return the number that the first COUNT characters of the token of SOURCE spell, which begins at
LINE and COLUMN.  Signals a SYNTAX-ERROR if they spell none, or one out of range."
  (multiple-value-bind (number trouble) (parse-number (source-token source) count)
    (or number
        (let ((text (subseq (source-token source) 0 (min count 24))))
          (ecase trouble
            (:length (fail-at source line column "a number of ~d character~:p; at most ~d ~
                                                  ~:*~[~;is~:;are~] read"
                              count *number-limit*))
            (:range (fail-at source line column
                             "~a is out of range: numbers lie between 1e-300 and 1e300, or are 0"
                             text))
            (:zero (fail-at source line column "~a divides by zero" text))
            (:syntax (fail-at source line column
                              "~a is not a number; 12, -0.5, 1e-3 and 1/2 are" text)))))))

(defun token-name (source count line column)
  (when (> count (the fixnum *name-limit*))
    (fail-at source line column "a name of ~d character~:p; at most ~d ~:*~[~;is~:;are~] read"
             count *name-limit*))
  (let ((text (source-token source)))
    (when (and (= count 1) (char= (schar text 0) #\.))
      (fail-at source line column "dotted pairs are not read"))
    (canonical-name (nstring-upcase (subseq text 0 count)))))

(defun read-all (source &key loose-names)
  "Read all forms of SOURCE.  Returns their list, a table from each list in them, and each outermost
name, to its line, and one from each outermost list to the lines of the comment just before it.
If LOOSE-NAMES is true, whatever stands outside all lists is a name of its letters, so that it has a
line, too."
  (let ((lines (make-hash-table :test #'eq))
        (comments (make-hash-table :test #'eq)))
    (setf (source-lines source) lines
          (source-comments source) comments)
    (values (loop for datum = (read-datum source)
                  until (eq datum (end-of-data))
                  collect (let ((form (if (and loose-names (not (consp datum)))
                                          (make-symbol (form-text datum))
                                          datum)))
                            (when (namep form)
                              (setf (gethash form lines) (source-record-start-line source)))
                            form))
            lines
            comments)))

;;; Forms that come from the Lisp reader

(defun refuse-form (control &rest arguments)
  (apply #'refuse-syntax '() control arguments))

(defun refuse-entry (entry)
  (refuse-form "~a can't stand here: in a backquoted list stand numbers, and forms with a comma, ~
                as `(0 0 0 0 ,(- x) ,x)" (form-text entry)))

(defun canonical-atom (atom)
  (typecase atom
    (symbol (canonical-name (string-upcase (symbol-name atom))))
    (string (copy-seq atom))
    (rational atom)
    (float (or (as-double atom)
               (refuse-form "a number out of range: numbers lie between 1e-300 and 1e300, or ~
                             are 0")))
    (t (if (comma-p atom)
           (refuse-entry atom)
           (refuse-form "~a is not allowed in a form" (type-of atom))))))

(defun template-entry (entry)
  "Return the form of ENTRY, which stands in a backquoted list with commas."
  (multiple-value-bind (form one)
      (if (comma-p entry) (comma-form entry) (values entry (realp entry)))
    (if one form (refuse-entry entry))))

(defun canonical (form)
  "Return FORM, which may come from the Lisp reader in any package, as this file's reader would
have returned it.  A backquoted list with commas becomes (LIST ...), one without a quoted list.
Signals a SYNTAX-ERROR if FORM holds anything else, or too much of it."
  (let ((room *record-limit*))
    (labels ((walk (form depth)
               (when (minusp (decf room))
                 (refuse-form "a form of more than ~d part~:p, or a circular one" *record-limit*))
               (when (> depth *depth-limit*)
                 (refuse-form "lists nest deeper than ~d" *depth-limit*))
               (cond ((null form) nil)
                     ((backquote-p form) (walk-template (second form) depth))
                     ((consp form) (walk-list form depth #'identity))
                     (t (canonical-atom form))))
             (walk-list (list depth each)
               (loop for cell = list then (cdr cell)
                     until (null cell)
                     unless (consp cell)
                       do (refuse-form "dotted pairs are not read: ~a" (form-text list))
                     collect (walk (funcall each (car cell)) (1+ depth))))
             (walk-template (template depth)
               (if (loop for cell on (and (consp template) template)
                         repeat *record-limit*
                           thereis (comma-p (car cell)))
                   (cons :list (walk-list template depth #'template-entry))
                   (list :quote (walk template (1+ depth))))))
      (walk form 0))))
