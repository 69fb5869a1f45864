;;;; carried-data.lisp -- what a box carries along comes back as it was.

(in-package :supergrip-test)
(define-suite carried-data "What a box carries along comes back as it was.")

(defun carried (notation text)
  "Return what a record says of a box in NOTATION with the data TEXT."
  (let ((supergrip::*notation* notation))
    (list :data (getf (supergrip::%box-others
                       (supergrip::canonical-box
                        (if (eq notation :json)
                            (supergrip::json-description
                             (supergrip::read-json
                              (supergrip-data:string-source
                               (format nil "~a, \"data\": ~a}"
                                       (string-right-trim "}" *json-pencil*) text))))
                            (cons (first (supergrip-data:read-all
                                          (supergrip-data:string-source
                                           (format nil "(DATA ~a)" text))))
                                  *good-box*))
                        nil 1))
                      :data))))

(defun data-in-json (notation text)
  (let ((line (json-line (carried notation text))))
    (subseq line (length "{\"data\":") (- (length line) 2))))

(defun data-in-lisp (notation text)
  (let ((line (lisp-line (carried notation text))))
    (is (= 1 (count #\Newline line)) "a record is one line")
    (subseq line (length "(:DATA ") (- (length line) 2))))

(test json-data-come-back-as-they-were
  (dolist (text '("null" "true" "false" "{}" "[]" "[[]]" "[{}]" "\"\"" "0" "-0" "1.10" "1E5" "1e-7"
                  "123456789012345678901234567890123456789" "0.1000000000000000055511151231257827"
                  "[1,[2,[3,[]]],{\"a\":{\"data\":1.50}}]" "{\"b\":1,\"a\":2,\"b\":3}"
                  "\"a\\u000Ab\\u0000\\u001B\\u007F\\u0085\\u2028\\\"\\\\/\""
                  "[null,false,[],{},0,\"\"]"))
    (is (equal text (data-in-json :json text))))
  (is (equal "[1,{\"a\":2}]" (data-in-json :json (format nil " [ 1 ,~%{ \"a\" : 2 } ] "))))
  (let ((deep (concatenate 'string (make-string 31 :initial-element #\[)
                           (make-string 31 :initial-element #\]))))
    (is (equal deep (data-in-json :json deep)) "as deep as a box may nest")
    (signals supergrip:syntax-error (data-in-json :json (format nil "[~a]" deep)))))

(test lisp-data-come-back-as-read
  (loop for (text result) in
        '(("" "NIL") ("foo 1 -7 1/2 0.5 1e30" "(FOO 1 -7 1/2 0.5d0 1.0d30)")
          ("\"a\\\\b\\\"c\" (a (b ()) 'c)" "(\"a\\\\b\\\"c\" (A (B NIL) (QUOTE C)))"))
        do (is (equal result (data-in-lisp :lisp text))))
  (is (equal "((:STRING \"a\" 10 9 \"b\"))" (data-in-lisp :lisp (format nil "\"a~%~cb\"" #\Tab)))))

(test data-in-the-other-notation
  (loop for (json lisp) in
        '(("null" ":NULL") ("true" ":TRUE") ("false" ":FALSE") ("[]" "NIL") ("{}" "(:OBJECT)")
          ("[1,\"a\",[]]" "(1 \"a\" NIL)")
          ("{\"a\":{\"B\":null}}" "(:OBJECT \"a\" (:OBJECT \"B\" :NULL))")
          ("1.5" "1.5d0") ("[\"a\\u000Ab\"]" "((:STRING \"a\" 10 \"b\"))")
          ("\"\\u001B\"" "(:STRING 27)"))
        do (is (equal lisp (data-in-lisp :json json)))
           ;; After DATA stand any number of forms: JSON has them in an array.
           (is (equal (format nil "[~a]" json) (data-in-json :lisp (remove #\: lisp)))))
  (loop for (lisp json) in
        '(("" "[]") ("foo (a b)" "[\"FOO\",[\"A\",\"B\"]]") ("1/4" "[0.25]")
          ("(object a 1)" "[[\"OBJECT\",\"A\",1]]") ("(object \"a\")" "[[\"OBJECT\",\"a\"]]")
          ("(string a)" "[[\"STRING\",\"A\"]]"))
        do (is (equal json (data-in-json :lisp lisp)))))

(test every-record-of-a-box-with-data-has-them-last
  (let* ((good (changed *json-pencil* "}" ", \"data\": {\"part\": 17.0}}"))
         (bad (changed good "[12, 2, 2]" "[12, 2]")))
    (multiple-value-bind (status output) (run-on (format nil "~a~%~a~%~a" (one-line good)
                                                         (one-line bad)
                                                         (one-line *json-pencil*))
                                                 (list (program) "--format" "json"))
      (is (= 65 status))
      (loop for line in (lines-of output)
            for data in '(t t nil)
            do (is (eq data (and (search ",\"data\":{\"part\":17.0}}" line :from-end t) t)))
               (is (eq data (and (search "\"data\"" line) t)))))))

(test data-at-the-repl
  (let ((box (supergrip:parse-box (cons '(data foo (1 "x")) *good-box*))))
    (is (equal "(FOO (1 \"x\"))" (supergrip-data:form-text (supergrip:box-value box :data))))
    (is (equal '("BOX: DATA is given twice")
               (box-reports (list* '(data 1) '(data 2) *good-box*))))))
