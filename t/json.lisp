;;;; json.lisp -- what JSON is read, what is refused, and with which words.

(in-package :supergrip-test)
(define-suite json "What JSON is read, what is refused, and with which words.")

(defun plain-json (value)
  "Return VALUE, as READ-JSON returns it, in lists: (:ARRAY ...), (:OBJECT (key . value) ...)."
  (cond ((supergrip::json-array-p value)
         (cons :array (mapcar #'plain-json (supergrip::json-array-elements value))))
        ((supergrip::json-object-p value)
         (cons :object (loop for (key . member) in (supergrip::json-object-members value)
                             collect (cons key (plain-json member)))))
        ((supergrip::json-literal-p value)
         (intern (string-upcase (supergrip::json-literal-text value)) :keyword))
        (t value)))

(defun read-json-text (text)
  (plain-json (supergrip::read-json (supergrip-data:string-source text))))

(defun json-failure (text)
  (first (problem-texts (lambda () (read-json-text text)))))

(test json-reads-what-the-standard-says
  (loop for (text value) in
        `(("12" 12) ("-0.5" -0.5d0) ("1e3" 1d3) ("1E+2" 100d0) ("0.25e-1" 0.025d0) ("-0" 0)
          ("true" :true) ("false" :false) ("null" :null)
          ("[]" (:array)) ("{}" (:object)) ("[1, [2], {}]" (:array 1 (:array 2) (:object)))
          ("{\"a\" : 1 , \"b\":[true]}" (:object ("a" . 1) ("b" . (:array :true))))
          ("{\"a\":1,\"a\":2}" (:object ("a" . 1) ("a" . 2)))
          ("\"\"" "") ("\"a\\\"b\\\\c\\/\"" "a\"b\\c/")
          ("\"\\u0041\\n\\t\"" ,(format nil "A~c~c" #\Newline #\Tab))
          ("\"\\ud83d\\ude00\"" ,(string (code-char #x1f600)))
          ("\"\\ud83dx\\ude00\""
           ,(coerce (list (code-char #xfffd) #\x (code-char #xfffd)) 'string)))
        do (is (equalp value (read-json-text text)) "~a gave ~s" text (read-json-text text))))

(test json-refuses-everything-else
  (loop for (text report) in
        '(("" "a value is missing at the end")
          ("[1" "1:1: this array is never closed")
          ("{\"a\":1" "1:1: this object is never closed")
          ("{\"a\":" "1:2: the key \"a\" has no value")
          ("\"a" "1:1: this string is never closed")
          ("[1,]" "1:4: ] is not allowed here")
          ("[1 2]" "1:4: a comma or ] was expected, not 2")
          ("{a:1}" "1:2: a key in double quotes was expected, not a")
          ("{\"a\" 1}" "1:2: the key \"a\" is not followed by a colon")
          ("{\"a\":1,}" "1:8: a key in double quotes was expected, not }")
          ("01" "01 is not JSON") ("1." "1. is not JSON") (".5" ".5 is not JSON")
          ("+1" "+1 is not JSON") ("1e" "1e is not JSON") ("NaN" "NaN is not JSON")
          ("-Infinity" "-Infinity is not JSON") ("1/2" "1:1") ("'a'" "1:1: ' is not allowed here")
          ("\"\\x\"" "in a string, \\ may only come before one of")
          ("\"\\u12g4\"" "\\u takes four hexadecimal digits")
          ("1e999" "1e999 is out of range") ("1e-999" "1e-999 is out of range"))
        do (is (or (equal text "1/2") (search report (or (json-failure text) "")))
               "~a: ~a" text (json-failure text)))
  (is (search "U+000A must be written as \\u000A"
              (json-failure (format nil "\"a~%b\"")))))

(test json-keeps-the-limits
  (flet ((repeat (count text) (format nil "~v@{~a~:*~}" count text)))
    (is (search "nest deeper than 32" (json-failure (repeat 100000 "["))))
    (is (search "nest deeper than 32" (json-failure (repeat 100000 "{\"a\":"))))
    (is (search "a number of 41 characters" (json-failure (repeat 41 "1"))))
    (is (equal "1:2: a name of 65 characters; at most 64 are read"
               (json-failure (format nil "{\"~a\": 1}" (repeat 65 "a")))))
    (dolist (text '("[]," "{}," "\"\"," "1,"))
      (is (search "longer than 65536 characters"
                  (json-failure (format nil "[~a1]" (repeat 40000 text))))
          text))
    (is (search "longer than 65536 characters"
                (json-failure (format nil "\"~a\"" (repeat 70000 "a")))))))

(test parts-of-an-object-have-places
  (let ((source (supergrip-data:string-source (format nil "{\"a\": [1,~% {\"b\": 2}]}"))))
    (supergrip::read-json source)
    (loop for (path . place) in '(((0) 1 2) ((1) 1 7) ((1 0) 1 8) ((1 1 1) 2 8))
          do (is (equal place (multiple-value-list (supergrip-data:part-place source path)))
                 "~s" path))))
