;;;; reader.lisp -- what data files may hold, what is refused, and at which line and column.

(in-package :supergrip-test)
(define-suite reader "What data files may hold, what is refused, and at which line and column.")

(defun read-failure (text)
  "Return the report of the syntax error in TEXT, or NIL."
  (first (problem-texts (lambda () (read-text text)))))

(test reader-reads-what-data-files-hold
  (loop for (text . forms) in
        '(("" . ())
          ("; only a comment" . ())
          ("(a B c1-d ?)" ("A" "B" "C1-D" "?"))
          ("'(N1 N2)" ("QUOTE" ("N1" "N2")))
          ("()" ())
          ("(a(b)\"x y\"'c)" ("A" ("B") "x y" ("QUOTE" "C")))
          ("\"a\\\"b\\\\\"" "a\"b\\")
          ("(a ; comment )
             b)" ("A" "B"))
          ("1 -2 +3 1/2 -4/8" 1 -2 3 1/2 -1/2)
          ("0.5 .5 -1.25 12. 1e3 1E-3 2d0 1.5e+2" 0.5d0 0.5d0 -1.25d0 12d0 1d3 1d-3 2d0 150d0)
          ("(- a) (+) (1)" ("-" "A") ("+") (1))
          ("-0.0 0e999" 0d0 0d0))
        do (is (equalp forms (read-text text)) "~s gave ~s" text (read-text text))))

(defun exact-decimal (text)
  "Return the rational that TEXT, digits with a point or an exponent or both, spells."
  (let* ((mark (or (position #\e text) (length text)))
         (point (or (position #\. text) mark))
         (digits (remove #\. (subseq text 0 mark)))
         (power (if (< mark (length text)) (parse-integer text :start (1+ mark)) 0)))
    (* (parse-integer digits) (expt 10 (- power (max 0 (- mark point 1)))))))

(test reader-rounds-to-the-nearest
  ;; The oracle is exact arithmetic: the readers of some Lisps are a bit off for 1e23.
  (loop for text in '("0.1" "0.2" "1.7375" "123456789.123456789" "1e22" "1e23"
                      "1.7976931348623157e299" "2.2250738585072014e-299"
                      "3.14159265358979323846264338"
                      "0.30000000000000004" "5e-300" "123e-20" "9007199254740993.0")
        do (is (nearest-p (first (read-text text)) (exact-decimal text)) text)))

(defun nearest-p (double exact)
  "True if no double is nearer to the rational EXACT than DOUBLE; of two as near, one is even."
  (multiple-value-bind (mantissa exponent) (integer-decode-float double)
    (flet ((distance (mantissa) (abs (- exact (* mantissa (expt 2 exponent))))))
      (let ((own (distance mantissa))
            (other (min (distance (1+ mantissa))
                        ;; Below a power of two the next double is half as far.
                        (distance (- mantissa (if (= mantissa (expt 2 52)) 1/2 1))))))
        (or (< own other) (and (= own other) (evenp mantissa)))))))

(defun random-decimal (state)
  "Return the text of a random decimal above 0, and the rational that it spells."
  (let* ((digits (format nil "~d" (1+ (random (expt 10 (1+ (random 30 state))) state))))
         (count (random (length digits) state)) ; after the point
         (power (if (zerop (random 3 state)) (- (random 500 state) 250) 0))
         (point (- (length digits) count)))
    (values (format nil "~a.~a~[~:;~:*e~d~]" (subseq digits 0 point) (subseq digits point) power)
            (* (parse-integer digits) (expt 10 (- power count))))))

(test reader-gives-the-nearest-double
  ;; The oracle is exact arithmetic: SBCL's own reader takes 9534732981376689.5 for ...688.
  (is (eql 9534732981376690d0 (first (read-text "9534732981376689.5"))))
  (let ((state (sb-ext:seed-random-state 17)) (faults '()))
    (loop repeat 20000
          do (multiple-value-bind (text exact) (random-decimal state)
               (unless (nearest-p (first (read-text text)) exact)
                 (push text faults))))
    (is (null faults) "seed 17: ~{~a~%~}" faults)))

(test reader-refuses-everything-else
  (loop for (text report) in
        '(("(a" "1:1: this parenthesis is never closed")
          ("(a
  (b c)" "1:1: this parenthesis is never closed")
          (")" "1:1: a closing parenthesis too many")
          ("(a) )" "1:5: a closing parenthesis too many")
          ("\"abc" "1:1: this string is never closed")
          ("\"a\\nb\"" "1:4: in a string, \\ may only come before \\ or \"")
          ("#.(quit)" "1:1: # is not allowed in a name or a number")
          ("(a #(1))" "1:4: # is not allowed in a name or a number")
          ("`(a ,b)" "1:1: ` is not allowed in a name or a number: a list whose entries are computed is written (LIST 0 0 0 0 (- x) x)")
          ("'(0 0 ,(- x) ,x)" "1:7: , is not allowed in a name or a number: a list whose entries are computed is written (LIST 0 0 0 0 (- x) x)")
          ("(12, 2)" "1:4: , is not allowed in a name or a number")
          ("a|b|" "1:2: | is not allowed in a name or a number")
          ("cl:car" "1:3: : is not allowed in a name or a number")
          ("(a . b)" "1:4: dotted pairs are not read")
          ("12x" "1:1: 12x is not a number; 12, -0.5, 1e-3 and 1/2 are")
          ("1.2.3" "1:1: 1.2.3 is not a number; 12, -0.5, 1e-3 and 1/2 are")
          ("1/0" "1:1: 1/0 divides by zero")
          ("1e999" "1:1: 1e999 is out of range: numbers lie between 1e-300 and 1e300, or are 0")
          ("1e-999" "1:1: 1e-999 is out of range: numbers lie between 1e-300 and 1e300, or are 0")
          ("1e99999999999"
           "1:1: 1e99999999999 is out of range: numbers lie between 1e-300 and 1e300, or are 0")
          ("'" "1:1: nothing follows this '"))
        do (is (equal report (read-failure text)) "~s: ~s" text (read-failure text))))

(test reader-keeps-its-limits
  (flet ((repeat (count text)
           (with-output-to-string (out)
             (loop repeat count do (write-string text out)))))
    (is (search "never closed" (read-failure (repeat 32 "("))) "not too deep")
    (is (search "nest deeper than 32" (read-failure (repeat 33 "("))))
    (is (search "nest deeper than 32" (read-failure (repeat 100000 "("))))
    (is (search "nest deeper than 32" (read-failure (repeat 100000 "'"))))
    (is (search "a number of 41 characters" (read-failure (repeat 41 "1"))))
    (is (search "a name of 65 characters" (read-failure (repeat 65 "a"))))
    (is (search "longer than 65536 characters"
                (read-failure (format nil "(~a)" (repeat 40000 "a ")))))
    (is (search "longer than 65536 characters"
                (read-failure (format nil "\"~a\"" (repeat 70000 "a")))))
    (is (= 40000 (length (read-text (repeat 40000 "a "))))
        "the limit is on a form, not on the file")
    ;; Every character counts, whatever it does.
    (dolist (text '("()" "'()" "(a)" "\"\"" "1 " "'1" ";
"))
      (is (search "longer than 65536 characters"
                  (read-failure (format nil "(~a)" (repeat 40000 text))))
          text))
    (let ((supergrip-data:*record-limit* 12))
      (is (null (read-failure "(a '(1 \"b\"))   (a '(1 \"b\"))")))
      (is (equal "1:13: the form that begins in line 1 is longer than 12 characters"
                 (read-failure "(a '(1 \"bc\"))"))))))

(test marks-between-files-count-for-nothing
  (let ((mark (code-char #xfeff)))
    (is (equal '(("A") ("B") ("C"))
               (read-text (format nil "~c(a)~c~%~c (b)~c(c)" mark mark mark mark))))
    (is (equal "1:2: U+FEFF is not allowed in a name or a number"
               (read-failure (format nil "(~c)" mark))))
    (is (equal "1:2: # is not allowed in a name or a number"
               (read-failure (format nil "~c(#)" mark)))
        "nor as a column")))

(test what-shows-nothing-is-called-by-its-code
  (loop for (code name) in '((#xa0 "U+00A0") (#x200b "U+200B") (#x202e "U+202E") (#x85 "U+0085")
                             (#x7f "U+007F") (1 "U+0001") (#x3000 "U+3000") (#xe0041 "U+E0041"))
        do (is (eql 0 (search (format nil "1:3: ~a is not allowed" name)
                              (read-failure (format nil "(a~c)" (code-char code)))))
               name)
           (is (equal (format nil "\"x<~a>y\"" name)
                      (supergrip-data:form-text (format nil "x~cy" (code-char code))))))
  (is (equal "ü x" (supergrip-data:visible-text "ü x"))))

(test parts-of-a-record-have-places
  (let ((source (supergrip-data:string-source (format nil "x ((a b)~%  '(c (d e)))"))))
    (supergrip-data:read-datum source)
    (supergrip-data:read-datum source)
    (loop for (path . place) in '((() 1 3) ((0) 1 4) ((0 1) 1 7) ((1) 2 3) ((1 1) 2 4)
                                  ((1 1 1 1) 2 10)
                                  ((7) 1 3) ((0 7) 1 4))
          do (is (equal place (multiple-value-list (supergrip-data:part-place source path)))
                 "~s" path))))

(test problems-are-bounded
  (flet ((problems (count)
           (nth-value 1 (supergrip-data:with-problems
                          (let ((supergrip-data:*subject* "BOX"))
                            (supergrip-data:complain nil '(:warning "first"))
                            (dotimes (i count)
                              (supergrip-data:complain nil "problem ~d" i)))))))
    (is (= 20 (length (problems 19))))
    (let ((more (first (last (problems 119)))))
      (is (equal "BOX: and 100 more problems" (princ-to-string more)))
      (is (eq :error (supergrip-data:problem-severity more))))))

(test utf-16-is-known
  (flet ((known (text format &rest before)
           (let ((text (sb-ext:octets-to-string
                        (concatenate '(vector (unsigned-byte 8)) before
                                     (sb-ext:string-to-octets text :external-format format))
                        :external-format '(:utf-8 :replacement #.(code-char #xfffd)))))
             (and (supergrip-data:utf-16-p (coerce text '(simple-array character (*)))
                                           0 (length text))
                  t))))
    (is (equal '(t t t t nil nil nil)
               (list (known "((SIZE" :utf-16le) (known "((SIZE" :utf-16be)
                     (known "((SIZE" :utf-16le 255 254) (known "{ü" :utf-16be 254 255)
                     (known "((SIZE" :utf-8) (known "((SIZE" :utf-8 255 254) (known "" :utf-8))))))

(test reader-interns-nothing
  (let ((name "a-name-that-no-program-uses"))
    (read-text (format nil "(~a ~a)" name name))
    (is (null (find-symbol (string-upcase name) :keyword)))
    (is (null (find-symbol (string-upcase name) :supergrip-data)))))

(test reader-knows-the-line-of-every-list
  (multiple-value-bind (forms lines)
      (supergrip-data:read-all
       (supergrip-data:string-source (format nil "(a~%  (b)~%~%(c))~%; x~%(d)")))
    (is (equal '(1 6) (mapcar (lambda (form) (gethash form lines)) forms)))
    (is (equal '(2 4) (mapcar (lambda (form) (gethash form lines)) (rest (first forms)))))))

(defun stream-source (stream)
  "Return a source that reads STREAM, a character stream, to its end."
  (let ((buffer (make-string 4096)))
    (supergrip-data:make-source buffer 0
                                :refill (lambda ()
                                          (let ((end (read-sequence buffer stream)))
                                            (and (plusp end) (values buffer end)))))))

(test reader-reads-a-stream-in-pieces
  (let ((text (format nil "~{(~a \"string ~:*~a\" 0.5)~%~}" (loop for i below 2000 collect i))))
    (with-input-from-string (in text)
      (let ((forms (supergrip-data:read-all (stream-source in))))
        (is (= 2000 (length forms)))
        (is (equal '(1999 "string 1999" 0.5d0) (first (last forms))))))))

(defun circular-list (&rest elements)
  "Return a list of ELEMENTS that never ends."
  (setf (rest (last elements)) elements))

(defun nested-list (depth)
  "Return a list DEPTH lists deep."
  (loop repeat depth for list = '() then (list list) finally (return list)))

(test forms-of-the-repl-become-data
  (is (equalp '(:size 12 0.2d0 1/2)
              (supergrip-data:canonical '(size 12 0.2 1/2))))
  (is (eql 0.1d0 (supergrip-data:as-double 0.1)))
  (is (eql 0.8d0 (supergrip-data:as-double 0.8f0)))
  (is (eql 1d10 (supergrip-data:as-double 1e10)))
  (is (eql 0d0 (supergrip-data:as-double -0.0)))
  (is (null (supergrip-data:as-double (expt 10 400))))
  (is (null (supergrip-data:as-double sb-ext:double-float-positive-infinity)))
  (loop for (form . report) in
        `((,(circular-list 1 2) . "a form of more than 65536 parts, or a circular one")
          (,(nested-list 40) . "lists nest deeper than 32")
          ((a . b) . "dotted pairs are not read: (A . B)")
          ((#\a) . "STANDARD-CHAR is not allowed in a form")
          ((1e30 #c(1 2)) . "is not allowed in a form")
          ((1d301) . "a number out of range: numbers lie between 1e-300 and 1e300, or are 0"))
        do (is (search report
                       (or (first (problem-texts (lambda () (supergrip-data:canonical form))))
                           "")))))

(test forms-print-as-they-were-written
  (is (equal "((DIST '(N1 N2)) < 0.5 () \"x\")"
             (supergrip-data:form-text
              (supergrip-data:canonical '((dist '(n1 n2)) < 0.5 () "x"))))))

(test suggestions-are-close
  (is (equal " (did you mean PARALLEL?)"
             (supergrip-data:suggestion "PARALEL" '("OPPOSED" "PARALLEL"))))
  (is (equal " (did you mean OPPOSED?)"
             (supergrip-data:suggestion "OPPSOED" '("OPPOSED" "PARALLEL"))))
  (is (equal "" (supergrip-data:suggestion "XYZZY" '("OPPOSED" "PARALLEL")))))

(defun plain-distance (a b)
  "The edit distance of the lists A and B, from its definition."
  (cond ((null a) (length b))
        ((null b) (length a))
        ((eql (first a) (first b)) (plain-distance (rest a) (rest b)))
        (t (1+ (min (plain-distance (rest a) b)
                    (plain-distance a (rest b))
                    (plain-distance (rest a) (rest b))
                    (if (and (rest a) (eql (first a) (second b)) (eql (second a) (first b)))
                        (plain-distance (cddr a) (cddr b))
                        100))))))

(test distances-are-those-of-the-definition
  (let ((state (sb-ext:seed-random-state 9)) (faults '()))
    (flet ((word () (map-into (make-string (random 7 state))
                              (lambda () (char "ABC" (random 3 state))))))
      (loop repeat 3000
            do (let* ((a (word)) (b (word)) (most (random 4 state))
                      (plain (plain-distance (coerce a 'list) (coerce b 'list))))
                 (unless (eql (and (<= plain most) plain)
                              (supergrip-data::distance-within a b most))
                   (push (list a b most plain) faults)))))
    (is (null faults) "seed 9: ~s" faults)))
