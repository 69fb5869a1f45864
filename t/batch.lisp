;;;; batch.lisp -- many boxes through the executable: every one has its record, whatever comes.

(in-package :supergrip-test)
(define-suite batch "Many boxes through the executable: every one has its record, whatever comes.")

;;; Where records begin and end

(test every-box-or-fragment-has-one-record
  (let ((pencil (one-line *pencil*)))
    (loop for (name text . expected) in
          `(("two on a line" (,pencil " " ,pencil) "grasp" "grasp")
            ("over many lines" (,*pencil* "
" ,*pencil*) "grasp" "grasp")
            ("the paper's form" ("(SETQ BOX '" ,*pencil* ")
; a comment ((
'" ,pencil) "grasp" "grasp")
            ("a parenthesis too few" (,(subseq pencil 0 (1- (length pencil))) "
" ,pencil) "line 1, column 1: this parenthesis is never closed before line 2, which starts another record" "grasp")
            ("a quote too few" ("((NAME \"a) (SIZE 1 2 3))
" ,pencil "
(setq box '" ,pencil ")") "line 1, column 8: this string is never closed before line 2, which starts another record" "grasp" "grasp")
            ("a parenthesis too many" (,pencil ")
" ,pencil) "grasp" ,(format nil "line 1, column ~d: a closing parenthesis too many" (1+ (length pencil))) "grasp")
            ("something bad inside" ("((SIZE #(1 2 3)) (NAME \"(\") ; (
) " ,pencil) "line 1, column 8: # is not allowed in a name or a number" "grasp")
            ("words" ("hello, world (( 1 2
" ,pencil) "line 1, column 6: , is not allowed in a name or a number"
                       "line 1, column 15: this parenthesis is never closed before line 2, which starts another record" "grasp")
            ("one word" ("hello world
" ,pencil) "line 1, column 1: HELLO is not a box description: it is a list such as ((SIZE 12 2 2) (WEIGHT 0.2) ...)" "grasp")
            ("a quote without a form" ("((SIZE 12 2 2) '
" ,pencil) "line 1, column 16: nothing follows this ' before line 2, which starts another record"
                                       "grasp")
            ("an open end" (,pencil "
((SIZE 12") "grasp" "line 2, column 2: this parenthesis is never closed"))
          do (let ((statuses (statuses (answers text))))
               (is (= (length expected) (length statuses)) "~a: ~s" name statuses)
               (is (every (lambda (expected status) (eql 0 (search expected status)))
                          expected statuses)
                   "~a: ~s" name statuses)))))

(test every-json-value-or-fragment-has-one-record
  (let ((pencil (one-line *json-pencil*)))
    (loop for (name text . expected) in
          `(("one a line" (,pencil "
" ,pencil) "grasp" "grasp")
            ("over many lines" (,*json-pencil* "
" ,*json-pencil*) "grasp" "grasp")
            ("an array" ("[" ,pencil ", " ,pencil "]") "grasp" "grasp")
            ("an array over many lines" ("[
" ,*json-pencil* ",
  " ,pencil "
]
") "grasp" "grasp")
            ("an empty array" ("[ ]"))
            ("a brace too few" (,(subseq pencil 0 (1- (length pencil))) "
" ,pencil) "line 1, column 1: this object is never closed before line 2" "grasp")
            ("a bracket too few" (,(remove #\] pencil :count 1) "
" ,pencil) "line 1, column" "grasp")
            ("a bracket too few in an array" ("[" ,(remove #\] pencil :count 1) ", " ,pencil "]")
             "line 1, column" "grasp")
            ("a quote too few" (,(remove #\" pencil :count 1) "
" ,pencil) "line 1, column 2: a key in double quotes was expected, not s" "grasp")
            ("words" ("hello {
" ,pencil) "line 1, column 1: hello is not JSON" "line 1, column 7: this object is never closed before line 2" "grasp")
            ("numbers" ("1 2 3
" ,pencil) "line 1, column 1: 1 is not a box description: it is an object such as {\"size\""
                                         "grasp")
            ("values in an array" ("[1, [2, 3], null, " ,pencil ", \"x\"]")
             "line 1, column 2: 1 is not" "line 1, column 5: [2, 3] is not"
             "line 1, column 13: null is not"
             "grasp" "line 1, column")
            ("no comma in an array" ("[" ,pencil " " ,pencil "]") "grasp" "line 1, column")
            ("a comma too many" ("[" ,pencil ",, " ,pencil ",]") "grasp" "line 1" "grasp" "line 1")
            ("an open array" ("[" ,pencil) "grasp" "line 1, column 1: this array is never closed")
            ("a bracket by chance" ("[
" ,pencil "
" ,pencil) "grasp" "line 1, column 1: this array is never closed" "grasp")
            ("two arrays" ("[" ,pencil "]
[" ,pencil "]") "grasp" "grasp"))
          do (let ((statuses (statuses (answers text "--input" "json"))))
               (is (= (length expected) (length statuses)) "~a: ~s" name statuses)
               (is (every (lambda (expected status) (eql 0 (search expected status)))
                          expected statuses)
                   "~a: ~s" name statuses)
               ;; That it is JSON can be told from how it begins.
               (when (find (char (first text) 0) "{[")
                 (is (equal statuses (statuses (answers text)))
                     "~a, without --input: ~s" name (statuses (answers text))))))))

(test mistakes-in-json-boxes-are-told-in-json
  (loop for (old new report) in
        '(("[12, 2, 2]" "[12, 2]" "\"size\": [12, 2] is not valid: \"size\" takes three sizes in cm, above 0: \"size\": [12, 2, 2]")
          ("[12, 2, 2]" "12" "\"size\": 12 is not valid")
          ("[12, 2, 2]" "[12, 2, \"2\"]" "\"size\": [12, 2, \"2\"] is not valid")
          ("[12, 2, 2]" "[12, 2, {\"a\": null}]" "\"size\": [12, 2, {\"a\": null}] is not valid")
          ("0.2," "[0.2]," "\"weight\": [0.2] is not valid")
          ("0.2," "true," "\"weight\": true is not valid")
          ("\"weight\"" "\"Weight\""
           "unknown key \"Weight\" (did you mean weight?); keys are \"size\", \"weight\"")
          ("\"weight\"" "\"size\"" "\"size\" is given twice")
          ("\"weight\": 0.2, " "" "\"weight\" is missing; it takes one number, 0 or more, in finger forces: \"weight\": 0.2")
          ("\"Z2\"" "\"Z3\"" "\"Z3\" is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2")
          ("\"Z2\"" "7" "7 is not a surface of a box")
          ("\"Z2\"" "\"X1\"" "\"X1\" is constrained twice")
          ("[\"Z2\", \"X1\"]" "\"Z2\"" "\"constrained\": \"Z2\" is not valid")
          ("[1, 0.8, 0.8, 0.3, 1, 1]" "[1, 1.1]" "\"force_needed\": [1, 1.1] is not valid")
          ("[1, 0.8, 0.8, 0.3, 1, 1]" "null" "\"force_needed\": null is not valid")
          ("{" "{\"name\": 12, " "\"name\": 12 is not valid: \"name\" takes one string"))
        do (let ((records (answers (changed (one-line *json-pencil*) old new))))
             (is (= 1 (length records)))
             (is (search report (getf (first records) :reason)) "~a~%~a" report records))))

(defun problem-places (record)
  "Return the line, the column and the beginning of the text of each problem of RECORD."
  (loop for problem in (getf record :problems)
        collect (list (getf problem :line) (getf problem :column)
                      (subseq (getf problem :text) 0 (min 20 (length (getf problem :text)))))))

(test every-mistake-in-a-box-has-its-place
  (is (equal '((3 11 "(WEIGHT -1) is not v") (4 18 "Q is not a surface o")
               (4 20 "X9 is not a surface ") (5 22 "(FORCE-NEEDED (1 1 2")
               (2 3 "VELOCITY-NEEDED is m") (5 32 "the box ends here; i"))
             (problem-places (first (answers "(SETQ BOX
 '((SIZE 1 2 3) (u 1)
  (WEIGHT -1) (v 1)
 (CONSTRAINED Z2 Q X9)
  (FORCE-NEEDED (1 1 2 1 1 1))))")))))
  (is (equal '((2 12 "\"weight\": -1 is not ") (3 24 "\"Q\" is not a surface")
               (3 29 "\"X9\" is not a surfac")
               (4 26 "\"force_needed\": [1, ") (1 2 "\"velocity_needed\" is")
               (4 37 "the box ends here; i"))
             (problem-places (first (answers "[{\"size\": [1, 2, 3], \"u\": 1,
 \"weight\": -1, \"v\": 1,
 \"constrained\": [\"Z2\", \"Q\", \"X9\"],
  \"force_needed\": [1, 1, 2, 1, 1, 1]}]"))))))

(test a-parenthesis-too-many-gives-one-record
  (loop for (text old new) in
        `((,*pencil* "12 2 2)" "12 2 2))") (,(one-line *pencil*) "12 2 2)" "12 2 2))")
          (,*pencil* "(0.8)" "(0.8))") (,*pencil* "X1)" "X1))") (,*pencil* "1 1))" "1 1)))")
          (,*pencil* "((SIZE" "(SIZE") (,*pencil* "(1 0.8" "(1) 0.8")
          (,(format nil "(SETQ BOX '~a)" *pencil*) "12 2 2)" "12 2 2))")
          (,*json-pencil* "2]" "2]}") (,(one-line *json-pencil*) "2]" "2]}")
          (,*json-pencil* "\"X1\"]," "\"X1\"]},")
          (,(format nil "[~a, ~a" *json-pencil* *json-pencil*) "2]" "2]}"))
        do (let ((statuses (statuses (answers (list (if (search old text) (changed text old new)
                                                        text)
                                                    (if (char= (char text 0) #\[) "]" "")
                                                    (format nil "~%")
                                                    (if (find (char text 0) "{[")
                                                        *json-pencil*
                                                        *pencil*))))))
             (when (search old text)
               (is (equal "grasp" (first (last statuses))))
               (is (= (if (char= (char text 0) #\[) 3 2) (length statuses)) "~a: ~s" text
                   statuses)))))

(test what-ends-a-box-too-early-is-told
  (loop for (text report) in
        `(("((SIZE 12 2 2)) (WEIGHT 0.2))"
           "line 1, column 15: the box ends here; if more of it follows, there is one ) too many, here or earlier")
          (,(format nil "(SETQ BOX '~a 7)" (one-line *pencil*))
           "7 stands after the end of the box: a ) before it is one too many")
          (,(format nil "[~a ~a]" *json-pencil* *json-pencil*)
           "a comma is missing before this value"))
        do (let ((reason (getf (first (last (answers text))) :reason)))
             (is (search report reason) "~a gave ~a" text reason))))

(test a-box-tells-some-of-its-problems
  (dolist (text (list (format nil "(~{(K~d 1)~})" (loop for i below 500 collect i))
                      (format nil "{~{\"k~d\": 1~^,~}}" (loop for i below 500 collect i))))
    (let ((problems (getf (first (answers text)) :problems)))
      (is (= 21 (length problems)))
      (is (equal "and 488 more problems" (getf (first (last problems)) :text))))))

(test what-stands-around-boxes-costs-itself-only
  (flet ((octets-in (text format &rest before)
           (concatenate '(vector (unsigned-byte 8)) before
                        (sb-ext:string-to-octets text :external-format format))))
    (let ((mark #(239 187 191)) (line (format nil "~%")))
      (loop for (name text . expected) in
            `(("marks" (,mark ,*pencil* ,line ,mark ,*pencil*) "grasp" "grasp")
              ("marks in JSON" (,mark ,*json-pencil* ,line ,mark ,*json-pencil*) "grasp" "grasp")
              ("a mark after an open record" ("((SIZE 1" ,line ,mark ,*pencil*) "line 1" "grasp")
              ("a text sequence" (#(30) ,*json-pencil* ,line #(30) ,*json-pencil* #(30)) "grasp"
               "grasp")
              ("a sequence with a part" (#(30) "{\"size\": [1" #(30) ,*json-pencil*) "line 1"
               "grasp")
              ("a comment" ("# boxes" ,line ,*json-pencil*) "line 1, column 1: #" "grasp")
              ("a comment of Lisp" ("; boxes" ,line ,*json-pencil*) "line 1, column 1: ;" "grasp")
              ("a line of a log" ("12:00 started" ,line ,*json-pencil*) "line 1" "grasp")
              ("a log in brackets" ("[INFO] started" ,line ,*json-pencil*) "line 1" "line 1"
               "grasp")
              ("a log before lists" ("[12:00] started" ,line ,*pencil*) "line 1" "grasp")
              ("UTF-16" (,(octets-in *json-pencil* :utf-16le 255 254))
               "line 1, column 1: this is UTF-16, but must be UTF-8")
              ("UTF-16, then UTF-8" (,(octets-in (format nil "~a~%" *pencil*) :utf-16be) ,*pencil*)
               "line 1, column 1: this is UTF-16, but must be UTF-8" "grasp")
              ("no UTF-16" (#(255 254) ,line ,*pencil*) "line 1, column 1: what is not UTF-8"
               "grasp")
              ("no name" (,(changed *json-pencil* "{" "{\"name\": null, ")) "grasp")
              ("no name in Lisp" (,(changed *pencil* "(" "((NAME NIL) ")) "grasp"))
            do (let ((statuses (statuses (answers text))))
                 (is (= (length expected) (length statuses)) "~a: ~s" name statuses)
                 (is (every (lambda (expected status) (eql 0 (search expected status)))
                            expected statuses)
                     "~a: ~s" name statuses))))))

(test terminals-have-nothing-to-obey
  (loop for format in '("json" "sexp" "trace")
        do (let* ((text (list "((NAME \"a" #(27 91 194 133 127 194 155) "\") (SIZE \"" #(27 194 155)
                              "\"))"))
                  (output (nth-value 1 (run-on text (list (program) "--format" format)))))
             (is (notany (lambda (character)
                           (and (char/= character #\Newline)
                                (or (< (char-code character) 32)
                                    (< 126 (char-code character) 160))))
                         output)
                 format))))

(test the-name-of-a-bad-box-is-in-its-record
  (dolist (text '("((NAME \"bad\") (SIZE 1))" "{\"name\": \"bad\", \"size\": 1}"))
    (is (equal "bad" (getf (first (answers text)) :name)))))

;;; Nasty input

(defparameter *nasty*
  (flet ((with (old new) (changed (one-line *pencil*) old new)))
    `(("empty" "")
      ("only blanks" ,(format nil " ~%~c~%" #\Tab))
      ("only comments" ,(format nil "; ((~%;"))
      ("to be evaluated" "#.(quit)" :any)
      ("a million parentheses" ,(make-string 1000000 :initial-element #\() "nest deeper than 32")
      ("10^400" ,(with "0.8" (format nil "1~400,,,'0a" "")) "a number of 401 characters")
      ("1e999" ,(with "0.8" "1e999") "1e999 is out of range")
      ("1e-999" ,(with "0.8" "1e-999") "1e-999 is out of range")
      ("NaN" ,(with "0.8" "NaN") "(U NAN) is not valid")
      ("1/0" ,(with "0.8" "1/0") "1/0 divides by zero")
      ("negative zero" ,(with "0.2" "-0.0") :planned)
      ("a million digits" ,(with "0.8" (make-string 1000000 :initial-element #\7))
       "longer than 65536 characters")
      ("a duplicate key" ,(with "(u 0.8)" "(u 0.8) (U 0.8)") "U is given twice")
      ("an unknown key" ,(with "(u 0.8)" "(u 0.8) (colour 1)") "unknown key COLOUR")
      ("full-width letters" ,(with "(u" "(ｕ") "ｕ is not allowed in a name")
      ("full-width digits" ,(with "12" "１２") "is not allowed in a name")
      ("UTF-8 in a name" ,(with "(u" "(NAME \"käse 😀\") (u") :planned)
      ("CRLF" ,(format nil "~a~c~%" (with "0.8" "0.8") #\Return) :planned)
      ("no final newline" ,(with "0.8" "0.8") :planned)
      ("NUL" ,(with "0.8" (format nil "0.8~c" (code-char 0)))
       "U+0000 (is this UTF-16?) is not allowed")
      ("NUL in a name" ,(with "(u" (format nil "(NAME \"a~cb\") (u" (code-char 0))) :planned)
      ("invalid UTF-8" (,(with "(u" "(NAME \"a") #(255 192 128 237 160 128) "\") (u 1)") :any)
      ("invalid UTF-8 in a name" ("((NAME \"a" #(255 192 128 237 160 128 240 159) "z\")"
                                  ,(subseq (one-line *pencil*) 1))
       :planned)
      ("a byte order mark" (#(239 187 191) ,(one-line *pencil*)) :planned)
      ("friction near the bounds" ,(with "0.8" "1e300") :planned)
      ("a thin, heavy box" ,(with "12 2 2) (WEIGHT 0.2) (u 0.8) (v 0.2) (CONSTRAINED Z2 X1)"
                                  "13 40 1e-300) (WEIGHT 1e10) (u 0.8) (v 0.2) (CONSTRAINED)")
       "NO GRASP IS POSSIBLE")
      ("a subnormal" ,(with "0.8" "5e-324") "out of range")))
  "Name, text, and what must come: nothing, :PLANNED, :ANY, or a part of the reason of the error.")

(test nasty-input-costs-its-own-record-only
  (loop for (name text expected) in *nasty*
        do (multiple-value-bind (records status errors)
               (answers (list text (format nil "~%") *pencil*))
             (is (member status '(0 65)) "~a: ~a ~a" name status errors)
             (is (equal "grasp" (getf (first (last records)) :status)) "~a: ~s" name records)
             (case expected
               ((nil) (is (= 1 (length records)) "~a: ~s" name records))
               (:any)
               (t (is (= 2 (length records)) "~a: ~s" name records)
                (if (eq expected :planned)
                    (is (equal "grasp" (getf (first records) :status)) "~a: ~s" name records)
                    (is (search expected (getf (first records) :reason)) "~a: ~s" name
                        records)))))))

(test what-is-not-utf-8-becomes-replacement-characters
  (let ((records (answers (list "((NAME \"a" #(255 192 128 237 160 128 240 159) "z\")"
                                (subseq *pencil* 1)))))
    (is (equal (format nil "a~v@{~a~:*~}z" 7 (code-char #xfffd)) (getf (first records) :name)))))

(test nasty-json-costs-its-own-record-only
  (flet ((with (old new) (changed (one-line *json-pencil*) old new)))
    (loop for (name text expected) in
          `(("empty" "")
            ("a million brackets" ,(make-string 1000000 :initial-element #\[) "never closed")
            ("a million braces" ,(repeated 300000 "{\"a\":") "nest deeper than 32")
            ("1e999" ,(with "0.8" "1e999") "1e999 is out of range")
            ("NaN" ,(with "0.8" "NaN") "NaN is not JSON")
            ("Infinity" ,(with "0.8" "Infinity") "Infinity is not JSON")
            ("a ratio" ,(with "0.8" "1/2") "a comma or } was expected, not /")
            ("negative zero" ,(with "0.2" "-0.0") :planned)
            ("a million digits" ,(with "0.8" (make-string 1000000 :initial-element #\7))
             "longer than 65536 characters")
            ("a duplicate key" ,(with "\"u\": 0.8" "\"u\": 0.8, \"u\": 0.8") "\"u\" is given twice")
            ("an unknown key" ,(with "\"u\"" "\"colour\": 1, \"u\"") "unknown key \"colour\"")
            ("a newline in a name" ,(with "{" "{\"name\": \"a\\nb\", ") :planned)
            ("NUL in a name" ,(with "{" "{\"name\": \"a\\u0000b\", ") :planned)
            ("NUL itself in a name" ,(with "{" (format nil "{\"name\": \"~c\", " (code-char 0)))
             "U+0000 must be written as \\u0000")
            ("half a character" ,(with "{" "{\"name\": \"\\ud800\", ") :planned)
            ("invalid UTF-8 in a name" ("{\"name\": \"" #(255 254) "\", "
                                        ,(subseq (one-line *json-pencil*) 1))
             :planned))
          do (multiple-value-bind (records status errors)
                 (answers (list text (format nil "~%") *json-pencil*) "--input" "json")
               (is (member status '(0 65)) "~a: ~a ~a" name status errors)
               (is (find "grasp" (last records 2) :key (lambda (record) (getf record :status))
                                                  :test #'equal)
                   "~a: ~s" name records)
               (cond ((null expected) (is (= 1 (length records)) "~a: ~s" name records))
                     ((eq expected :planned)
                      (is (equal '("grasp" "grasp") (statuses records)) "~a: ~s" name records))
                     (t (is (some (lambda (record) (search expected (getf record :reason)))
                                  records)
                            "~a: ~s" name records)))))))

(test a-line-of-a-hundred-megabytes-is-no-matter
  (is (equal '("0" "2 2")
             (lines-of
              (nth-value 1 (run-process
                            (list "bash" "-c"
                                  "{ head -c 100000000 /dev/zero | tr '\\0' x; echo; echo \"$1\"; } \\
                                   | timeout 60 \"$0\" --dynamic-space-size 256MB > \"$2\" 2> /dev/null
                                   [ $? = 65 ]; echo $?
                                   echo $(wc -l < \"$2\") $(grep -c :LINE \"$2\")"
                                  (program) (one-line *pencil*)
                                  (format nil "~a.out" (program)))))))))

(test no-input-reaches-the-end-of-the-heap
  (flet ((long (start part end)
           (format nil "~a~a~a~%" start (repeated (floor 3000000 (length part)) part) end)))
    (loop for (notation text good) in
          `(("sexp" ,(long "((NAME " "'()" "") ,(one-line *pencil*))
            ("sexp" ,(long "((a" ")" "") ,(one-line *pencil*))
            ("sexp" ,(long "(" "(a)" ")") ,(one-line *pencil*))
            ("sexp" ,(long "(" "a " ")") ,(one-line *pencil*))
            ("json" ,(long "{\"size\": [" "[]," "1]}") ,(one-line *json-pencil*))
            ("json" ,(long "{" "{}[]," "}") ,(one-line *json-pencil*)))
          do (dolist (limit '("65536" "1000000"))
               (multiple-value-bind (status output)
                   (run-on (list text good) (list (program) "--dynamic-space-size" "64MB" "--format"
                                                  "json"
                                                  "--input" notation "--record-limit" limit))
                 (let ((records (mapcar #'json-record (lines-of output))))
                   (is (eql 65 status))
                   (is (equal '("error" "grasp")
                              (mapcar (lambda (record) (getf record :status)) records))
                       "~a ~a" (subseq text 0 20) limit)))))))

;;; The same plan everywhere

(test batch-plans-as-the-repl-does
  (let ((*read-default-float-format* 'single-float) (boxes '()))
    (for-random-boxes (box 40 43) (push box boxes))
    ;; Single floats, as they are typed at the REPL.
    (push '((size 12.3 2.1 2.7) (weight 0.2) (u 0.8) (v 0.2) (constrained z2 x1)
            (force-needed (1 0.8 0.8 0.3 1 1)) (velocity-needed (0 0.8 0.8 0 0.8 0.8)))
          boxes)
    (let* ((text (let ((*print-pretty* nil) (*package* (find-package :supergrip-test)))
                   (format nil "~{~s~%~}" boxes)))
           (records (answers text)))
      (is (= (length boxes) (length records)))
      (loop for box in boxes
            for record in records
            for line from 1
            do (is (equal (supergrip::plan-record (supergrip:plan box) :line line) record)
                   "~s" box)))))

(test a-pipe-that-pauses-is-answered-at-once
  (dolist (pencil (list *pencil* *json-pencil*))
    (let ((process (uiop:launch-program (list (program)) :input :stream :output :stream)))
      (unwind-protect
           (let ((in (uiop:process-info-input process)) (out (uiop:process-info-output process)))
             (loop repeat 3
                   do (write-string (one-line pencil) in)
                      (finish-output in)
                      (is (search "PINCH-3-PARALLEL" (sb-ext:with-timeout 10 (read-line out)))))
             (close in)
             (is (eql 0 (uiop:wait-process process))))
        (uiop:terminate-process process)))))

(test what-is-spoiled-by-chance-is-answered
  (loop for (command count seed) in `(((,(program) "--dynamic-space-size" "256MB") 9000 11)
                                      (,(script "examples/batch.lisp") 1000 12))
        do (dolist (notation '(:lisp :json))
             (format t "~&   ~d spoiled boxes, seed ~d~%" count seed)
             (is (null (supergrip-fuzzer:fuzz-boxes
                        command notation count seed
                        (uiop:pathname-directory-pathname (program))))))))

(test spoiled-rules-and-grasps-are-refused-or-work
  (format t "~&   2000 spoiled rules and grasps, seed 13~%")
  (is (null (supergrip-fuzzer:fuzz-knowledge 2000 13))))

(test traces-say-which-box-they-are-of
  (flet ((box-lines (text)
           (remove "(BOX "
                   (lines-of (nth-value 1 (run-on text (list (program) "--format" "trace"))))
                   :test-not (lambda (start line) (eql 0 (search start line))))))
    (let ((pencil (one-line *pencil*)))
      (is (null (box-lines pencil)) "the paper's lines")
      (is (equal '("(BOX IN LINE 3)" "(BOX \"b\" IN LINE 4)" "(BOX \"c\" IN LINE 5)")
                 (box-lines (format nil "~a~2%~a~%((NAME \"b\") (SIZE 1))~%~a" pencil pencil
                                    (changed pencil "((" "((NAME \"c\") (")))))
      (is (equal '("(BOX \"c\" IN LINE 1)")
                 (box-lines (changed pencil "((" "((NAME \"c\") (")))))))

(test the-shipped-boxes-are-the-same-in-both-notations
  (flet ((shipped (name)
           (let ((records (answers (file-text name))))
             (dolist (record records records)
               (setf (getf record :line) nil)))))
    (let ((records (shipped "examples/boxes.lisp")))
      (is (equal '("grasp" "grasp" "grasp" "cant") (statuses records)))
      (is (equal records (shipped "examples/boxes.jsonl"))))))

(test marks-before-a-record-end-the-one-that-is-open
  ;; A byte order mark and the separator of JSON text sequences, in any order, are no part of a
  ;; record.
  (dolist (marks (list "" (string (code-char #xfeff)) (string (code-char 30))
                       (format nil "~c~c" (code-char #xfeff) (code-char 30))
                       (format nil "~c~c" (code-char 30) (code-char #xfeff))))
    (is (equal '("grasp" "grasp")
               (rest (statuses (answers (format nil "{\"size\": [1,~%~a~a~%~a~a~%"
                                                marks (substitute #\Space #\Newline *json-pencil*)
                                                marks
                                                (substitute #\Space #\Newline *json-pencil*))))))
        "~s" marks)))

(test marks-without-end-cost-their-record-only
  (let ((box (substitute #\Space #\Newline *json-pencil*)))
    (dolist (mark (list (code-char #xfeff) (code-char 30)))
      (is (equal "grasp"
                 (first (last (statuses (answers (format nil "{\"size\": [1,~%~a~%~a~%"
                                                         (make-string 200000 :initial-element mark)
                                                         box))))))
          "~s" mark))))
