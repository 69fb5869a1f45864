;;;; schemas.lisp -- what docs/box.schema.json and docs/record.schema.json say is so.

(in-package :supergrip-test)
(define-suite schemas "What docs/box.schema.json and docs/record.schema.json say is so.")

(defun json-of (text)
  (supergrip::read-json (supergrip-data:string-source text)))

(defun schema (name)
  (let ((supergrip-data:*record-limit* 100000))
    (json-of (file-text (format nil "docs/~a.schema.json" name)))))

(defun member-of (object key)
  "Return the value of KEY in OBJECT, and whether it is there."
  (let ((member (and (supergrip::json-object-p object)
                     (assoc key (supergrip::json-object-members object) :test #'string=))))
    (values (cdr member) (and member t))))

(defun keys-of (object) (mapcar #'car (supergrip::json-object-members object)))

(defun elements-of (array) (and array (supergrip::json-array-elements array)))

(defun json-type (value)
  "Return the types of JSON Schema that VALUE has."
  (cond ((supergrip::json-object-p value) '("object"))
        ((supergrip::json-array-p value) '("array"))
        ((stringp value) '("string"))
        ((integerp value) '("number" "integer"))
        ((realp value) '("number"))
        ((string= (supergrip::json-literal-text value) "null") '("null"))
        (t '("boolean"))))

(defun referred (schema root)
  (let ((place (member-of schema "$ref")))
    (if place
        (member-of (member-of root "$defs") (subseq place (length "#/$defs/")))
        schema)))

(defun number-faults (value schema)
  (loop for (key test) in `(("minimum" ,#'>=) ("maximum" ,#'<=) ("exclusiveMinimum" ,#'>))
        for bound = (member-of schema key)
        when (and bound (realp value) (not (funcall test value bound)))
          collect (format nil "~a ~a" key value)))

(defun array-faults (value schema root)
  (let ((elements (elements-of value)))
    (append (loop for (key test) in `(("minItems" ,#'>=) ("maxItems" ,#'<=))
                  for bound = (member-of schema key)
                  when (and bound (not (funcall test (length elements) bound))) collect key)
            (let ((items (member-of schema "items")))
              (and items (loop for element in elements
                               append (schema-faults element items root)))))))

(defun object-faults (value schema root)
  (let ((properties (member-of schema "properties")))
    (append (loop for key in (elements-of (member-of schema "required"))
                  unless (nth-value 1 (member-of value key)) collect (format nil "no ~a" key))
            (loop for (key . part) in (supergrip::json-object-members value)
                  for (sub known) = (multiple-value-list (member-of properties key))
                  if known append (loop for fault in (schema-faults part sub root)
                                        collect (format nil "~a: ~a" key fault))
                    else if (nth-value 1 (member-of schema "additionalProperties"))
                      collect (format nil "unknown key ~a" key)))))

(defun schema-faults (value schema &optional (root schema))
  "Return what of VALUE is not as SCHEMA, a part of ROOT, says: of JSON Schema, what ours use, but
for patterns and conditions."
  (let* ((schema (referred schema root)) (type (member-of schema "type"))
         (enum (member-of schema "enum"))
         (types (and type (if (stringp type) (list type) (elements-of type)))))
    (cond ((and types (null (intersection types (json-type value) :test #'string=)))
           (list (format nil "~a is no ~a" value types)))
          ((and enum (not (member value (elements-of enum) :test #'equal))) (list "not in enum"))
          (t (append (number-faults value schema)
                     (and (supergrip::json-array-p value) (array-faults value schema root))
                     (and (supergrip::json-object-p value) (object-faults value schema root))
                     (loop for key in '("anyOf" "oneOf")
                           for choices = (elements-of (member-of schema key))
                           when (and choices (loop for choice in choices
                                                   always (schema-faults value choice root)))
                             append (loop for choice in choices
                                          append (schema-faults value choice root))))))))

(test the-schema-of-boxes-has-the-keys-of-boxes
  (let* ((schema (schema "box")) (keys (keys-of (member-of schema "properties"))))
    (is (null (set-exclusive-or keys (mapcar #'supergrip::box-key-json supergrip::*box-keys*)
                                :test #'string=)))
    (is (null (set-exclusive-or
               (elements-of (member-of schema "required"))
               (loop for row in supergrip::*box-keys*
                     unless (or (supergrip::box-key-optional row)
                                (find (supergrip::box-key-key row) supergrip::*box-keys*
                                      :key #'supergrip::box-key-instead))
                       collect (supergrip::box-key-json row))
               :test #'string=)))
    (is (null (schema-faults (json-of *json-pencil*) schema)))
    (loop for (old new) in '(("[12, 2, 2]" "[12, 2]") ("[12, 2, 2]" "[12, 2, 0]") ("0.2" "\"0.2\"")
                             ("\"weight\": 0.2" "\"name\": \"x\"") ("\"u\"" "\"U\""))
          do (is (schema-faults (json-of (changed *json-pencil* old new)) schema)
                 "~a for ~a" new old))
    (dolist (line (lines-of (file-text "examples/boxes.jsonl")))
      (is (null (schema-faults (json-of line) schema))))))

(test records-are-as-their-schema-says
  (let ((schema (schema "record")) (seen '()) (knowledge (force-knowledge)))
    (flet ((check (record)
             (let ((value (json-of (json-line record))))
               (is (equal '() (schema-faults value schema)))
               (setf seen (union seen (keys-of value) :test #'string=)))))
      (for-random-boxes (box 12 4105)
        (dolist (box (list box (list* '(pose (0 0 5) (0 0 0 1)) '(data 1 "a")
                                      (box-in box :mm :n 1/10 1/20))))
          (dolist (index '(:paper :exact))
            (let ((plan (supergrip:plan box :knowledge knowledge :index index)))
              (check (supergrip::record-in-units
                      (supergrip::plan-record plan :line 1 :all 2)
                      (supergrip::%box-units (supergrip:plan-box plan))))))))
      (check (supergrip::plan-record (supergrip:plan *good-box*) :line 1 :refine t))
      (dolist (index '(:paper :exact))
        (check (supergrip::error-record (list (supergrip-data:make-problem :line 2 :text "bad"))
                                        :name "x" :line 2 :index index :all 3))))
    (is (null (set-exclusive-or seen (keys-of (member-of schema "properties")) :test #'string=))
        "each key of the schema is in a record")))
