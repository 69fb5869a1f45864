;;;; notation.lisp -- a box description in JSON, turned into the paper's list.

(in-package :supergrip)

(defun json-description (value)
  "Return the box description that VALUE, as READ-JSON returns it, stands for: a list of clauses,
each beginning with its key, a string.  A value that is no object with members is returned as it
is; CANONICAL-BOX refuses it."
  (if (and (json-object-p value) (json-object-members value))
      (loop for (key . value) in (json-object-members value)
            collect (cons key (json-values key value)))
      value))

(defun json-values (key value)
  "Return what the clause of KEY would hold for VALUE: a list, or VALUE itself where KEY takes an
array and VALUE is none."
  (flet ((is (name) (string= key name)))
    (cond ((is "size") (if (json-array-p value) (json-array-elements value) value))
          ((is "constrained")
           (if (json-array-p value)
               (loop for element in (json-array-elements value)
                     collect (if (stringp element)
                                 (canonical-name (string-upcase element))
                                 element))
               value))
          ((json-array-p value)
           (list (if (member key '("force_needed" "velocity_needed") :test #'string=)
                     (json-array-elements value)
                     value)))
          (t (list value)))))

;;; For the reports

(defun json-text (value)
  "Return VALUE, a part of a description in JSON, as JSON, cut after some 200 characters."
  (cut-text (with-output-to-string (out) (write-json-value value out 0))))

(defun json-clause-text (key values)
  "Return the member of KEY, a keyword, with what JSON-VALUES made of its value, as JSON."
  (format nil "\"~a\": ~a" (box-key-json (find-key key))
          (json-text (cond ((not (listp values)) values)
                           ((member key '(:size :constrained)) (make-json-array values))
                           ((listp (first values)) (make-json-array (first values)))
                           (t (first values))))))

(defun write-json-value (value stream depth)
  "Write VALUE as JSON; of a long or deep one only the beginning."
  (flet ((text (string)
           (write-char #\" stream)
           (loop for character across (visible-text (subseq string 0 (min 201 (length string))))
                 do (when (find character "\"\\") (write-char #\\ stream))
                    (write-char character stream))
           (write-char #\" stream))
         (members (open list close writer)
           (write-string open stream)
           (loop for (element . rest) on list
                 repeat 100
                 do (funcall writer element)
                    (when rest (write-string ", " stream)))
           (write-string close stream)))
    (cond ((> depth 32) (write-string "..." stream))
          ((json-array-p value)
           (members "[" (json-array-elements value) "]"
                    (lambda (element) (write-json-value element stream (1+ depth)))))
          ((json-object-p value)
           (members "{" (json-object-members value) "}"
                    (lambda (member)
                      (text (car member))
                      (write-string ": " stream)
                      (write-json-value (cdr member) stream (1+ depth)))))
          ((json-literal-p value) (write-string (json-literal-text value) stream))
          ((stringp value) (text value))
          ((symbolp value) (text (symbol-name value)))
          (t (write-string (form-text value) stream)))))
