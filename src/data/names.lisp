;;;; names.lisp -- names are compared by their letters, whatever package they were read in.

(in-package :supergrip-data)

(declaim (inline namep))
(defun namep (object)
  "True if OBJECT is a name: any symbol but NIL, which is the empty list."
  (and object (symbolp object)))

(defun name-text (name)
  "Return the letters of NAME, a symbol or a string."
  (string name))

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

(defun form-text (form)
  "Return FORM as it would stand in a file, cut after some 200 characters."
  (let ((text (with-output-to-string (out) (write-form form out 0))))
    (if (> (length text) 200)
        (concatenate 'string (subseq text 0 197) "...")
        text)))

(defun write-form (form stream depth)
  (cond ((null form) (write-string "()" stream))
        ((symbolp form) (write-string (symbol-name form) stream))
        ((stringp form) (prin1 form stream))
        ((floatp form) (write-string (float-text form) stream))
        ((atom form) (princ form stream))
        ((> depth 32) (write-string "..." stream))
        ((and (name= (first form) "QUOTE") (consp (rest form)) (null (cddr form)))
         (write-char #\' stream)
         (write-form (second form) stream (1+ depth)))
        (t (write-char #\( stream)
           (loop for cell = form then (cdr cell)
                 for count from 0 below 100
                 do (write-form (car cell) stream (1+ depth))
                    (cond ((null (cdr cell)) (return))
                          ((atom (cdr cell))
                           (write-string " . " stream)
                           (write-form (cdr cell) stream (1+ depth))
                           (return))
                          (t (write-char #\Space stream))))
           (write-char #\) stream))))

(defun float-text (number)
  "Return the shortest decimal that reads back as NUMBER, without a mark of its type."
  (let ((*read-default-float-format* (if (typep number 'double-float) 'double-float 'single-float)))
    (princ-to-string number)))
