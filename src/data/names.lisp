;;;; names.lisp -- names, which are compared by their letters, whatever package they were read in.

(in-package :supergrip-data)

(declaim (inline namep))
(defun namep (object)
  "True if OBJECT is a name: any symbol but NIL, which is the empty list."
  (and object (symbolp object)))

(defun name= (name other)
  "True if NAME is a name with the letters of OTHER, a symbol or a string."
  (and (namep name) (string= (symbol-name name) (string other))))

(defun name-in (name names)
  "Return the one of NAMES, symbols or strings, that has the letters of NAME, or NIL."
  (and (namep name) (find (symbol-name name) names :test #'string= :key #'string)))

(defun part-p (form name)
  "True if FORM is a list that begins with NAME."
  (and (consp form) (name= (first form) name)))

(defun canonical-name (text)
  "Return the symbol that stands for TEXT.  A name that the program itself knows becomes the
keyword that its code uses; any other becomes a fresh symbol, which can be collected: reading
never interns."
  (or (find-symbol text :keyword) (make-symbol text)))

;;; Tables of rows

(defun with-row (row rows name)
  "Return ROWS, a list, with ROW in the place of the one for which the function NAME gives the same,
or last."
  (let ((old (find (funcall name row) rows :key name :test #'equal)))
    (if old (substitute row old rows) (append rows (list row)))))

;;; Characters that show nothing

(defparameter +invisible+
  '((#x0 #x1f) (#x7f #xa0) #xad (#x300 #x36f) #x61c (#x115f #x1160) #x1680 (#x17b4 #x17b5)
    (#x180b #x180f) (#x2000 #x200f) (#x2028 #x202f) (#x205f #x206f) (#x20d0 #x20ff) #x2800 #x3000
    #x3164 (#xd800 #xf8ff) (#xfe00 #xfe0f) (#xfe20 #xfe2f) #xfeff #xffa0 (#xfff0 #xfffb)
    (#xfffe #xffff) (#x1bca0 #x1bca3) (#x1d173 #x1d17a) (#xe0000 #x10ffff))
  "Codes and ranges of codes of what shows nothing by itself, but the space: controls, blanks, marks
that change what stands beside them, and what has no shape of its own.")

(defun invisible-p (character)
  "True if CHARACTER shows nothing and is no space."
  (let ((code (char-code character)))
    (and (or (< code 32) (> code 126))
         (some (lambda (range)
                 (if (consp range) (<= (first range) code (second range)) (= range code)))
               +invisible+))))

(defun code-text (character)
  "Return what CHARACTER is called: U+00A0."
  (format nil "U+~4,'0x" (char-code character)))

(defun visible-text (text)
  "Return TEXT, a string, with what shows nothing called by its name: <U+00A0>."
  (if (notany #'invisible-p text)
      text
      (with-output-to-string (out)
        (loop for character across text
              do (if (invisible-p character)
                     (format out "<~a>" (code-text character))
                     (write-char character out))))))

;;; Forms in reports

(defun cut-text (text)
  "Return TEXT, a string, cut after some 200 characters."
  (if (> (length text) 200)
      (concatenate 'string (subseq text 0 197) "...")
      text))

(defun form-text (form &optional (most 200))
  "Return FORM as it would stand in a file, cut after MOST characters; in full if MOST is NIL, which
is for forms that were read."
  (let ((room most))
    (with-output-to-string (out)
      (flet ((put (text)
               (let ((length (length text)))
                 (cond ((or (null room) (<= length room))
                        (write-string text out)
                        (and room (decf room length)))
                       (t (write-string text out :end room)
                          (return-from form-text
                            (concatenate 'string
                                         (subseq (get-output-stream-string out) 0 (- most 3))
                                         "...")))))))
        (plainly (write-form form #'put))))))

(defun write-form (form put)
  "Call PUT, a function, with each piece of the text of FORM.  A form that never ends is no harm if
PUT ends it."
  (flet ((put (text) (funcall put text)))
    (cond ((null form) (put "()"))
          ((symbolp form) (put (visible-text (symbol-name form))))
          ((stringp form) (put (prin1-to-string (visible-text form))))
          ((floatp form) (put (float-text form)))
          ((comma-p form)
           (multiple-value-bind (form one) (comma-form form)
             (put (if one "," ",@"))
             (write-form form put)))
          ((atom form) (put (princ-to-string form)))
          ((and (name= (first form) "QUOTE") (consp (rest form)) (null (cddr form)))
           (put "'")
           (write-form (second form) put))
          ((backquote-p form)
           (put "`")
           (write-form (second form) put))
          (t (put "(")
             (loop for cell = form then (cdr cell)
                   do (write-form (car cell) put)
                      (cond ((null (cdr cell)) (return))
                            ((atom (cdr cell))
                             (put " . ")
                             (write-form (cdr cell) put)
                             (return))
                            (t (put " "))))
             (put ")")))))

(defun float-text (number)
  "Return the shortest decimal that reads back as NUMBER, without a mark of its type."
  (let ((*read-default-float-format* (if (typep number 'double-float) 'double-float 'single-float)))
    (princ-to-string number)))
