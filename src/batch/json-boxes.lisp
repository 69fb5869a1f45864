;;;; json-boxes.lisp -- a box description in JSON becomes the paper's list; messages quote it as
;;;; JSON.

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
  "Return what the clause of KEY, a string, would hold for VALUE: a list, or VALUE itself where KEY
takes an array and VALUE is none."
  (let ((row (key-named key))
        (elements (and (json-array-p value) (json-array-elements value))))
    (cond ((null row) (list value))
          ((eq (box-key-type row) :pose) (json-pose value))
          ((not (json-array-p value)) (if (spread-p row) value (list value)))
          ((eq (box-key-type row) :faces) (mapcar #'json-face elements))
          ((eq (box-key-type row) :facts) (mapcar #'json-list elements))
          ((spread-p row) elements)
          ((eq (box-key-type row) :needs) (list elements))
          (t (list value)))))

(defun json-face (element)
  "Return ELEMENT, of an array of faces, as the paper has it: a name."
  (if (stringp element) (canonical-name (string-upcase element)) element))

(defparameter +pose-members+ '("position" "orientation") "The members of a pose in JSON.")

(defun json-pose (value)
  "Return VALUE, of a pose, as the paper would have it: two lists.  What is no pose stays as it is."
  (let ((members (and (json-object-p value) (json-object-members value))))
    (if (and (= (length members) 2)
             (loop for name in +pose-members+ always (assoc name members :test #'equal)))
        (loop for name in +pose-members+
              collect (json-list (cdr (assoc name members :test #'equal))))
        (list value))))

(defun json-list (value)
  "Return VALUE with lists for arrays."
  (if (json-array-p value) (mapcar #'json-list (json-array-elements value)) value))

;;; For the reports

(defmethod key-name ((notation (eql :json)) row)
  (format nil "\"~a\"" (box-key-json row)))

(defmethod value-text ((notation (eql :json)) value)
  (cut-text (with-output-to-string (out) (write-json-value value out 0))))

(defmethod clause-text ((notation (eql :json)) row values)
  (format nil "~a: ~a" (key-name notation row)
          (value-text notation (cond ((not (listp values)) values)
                                     ((spread-p row) (make-json-array values))
                                     ((and (eq (box-key-type row) :pose) (rest values))
                                      (make-json-object (mapcar #'cons +pose-members+ values)))
                                     ((listp (first values)) (make-json-array (first values)))
                                     (t (first values))))))

(defmethod nothing-p ((notation (eql :json)) value)
  (and (json-literal-p value) (string= (json-literal-text value) "null")))

(defmethod description-text ((notation (eql :json)))
  (values "an object such as {\"size\": [12, 2, 2], \"weight\": 0.2, ...}" "}"))

(defmethod spot-in-clause ((notation (eql :json)) clause row numbers)
  ;; Keys and values of an object take turns.
  (cond ((null numbers) (list (* 2 clause)))
        ((spread-p row) (cons (1+ (* 2 clause)) numbers))
        ;; The members of a pose may stand in any order.
        ((eq (box-key-type row) :pose) (list (1+ (* 2 clause))))
        (t (cons (1+ (* 2 clause)) (rest numbers)))))

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
          ((or (json-array-p value) (listp value)) ; see JSON-LIST
           (members "[" (if (listp value) value (json-array-elements value)) "]"
                    (lambda (element) (write-json-value element stream (1+ depth)))))
          ((json-object-p value)
           (members "{" (json-object-members value) "}"
                    (lambda (member)
                      (text (car member))
                      (write-string ": " stream)
                      (write-json-value (cdr member) stream (1+ depth)))))
          ((json-literal-p value) (write-string (json-literal-text value) stream))
          ((json-number-p value) (write-string (json-number-text value) stream))
          ((stringp value) (text value))
          ((symbolp value) (text (symbol-name value)))
          (t (write-string (form-text value) stream)))))
