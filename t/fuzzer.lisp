;;;; fuzzer.lisp -- spoiled boxes, rules and grasps, random but repeatable, and what must hold.
;;;;
;;;; Between any two spoiled boxes stands a good one, on a line of its own: it must get its record
;;;; whatever precedes it, the records must be in order, and a box that is spoiled only inside must
;;;; get exactly one.  Needs no FiveAM: t/fuzz.lisp is the long run, t/batch.lisp the short one.

(defpackage :supergrip-fuzzer
  (:use :cl)
  (:documentation "Spoils boxes, rules and grasps, and checks what comes of them.")
  (:export #:write-spoiled-boxes #:fuzz-boxes #:fuzz-knowledge))

(in-package :supergrip-fuzzer)

(defvar *state* nil "The random state.")

(defun chance (n) "True once in N times." (zerop (random n *state*)))
(defun pick (list) (nth (random (length list) *state*) list))

;;; Boxes by a grammar, nearly valid

(defparameter *numbers*
  '("1" "0" "2.5" "0.8" "-1" "1e999" "1e-999" "1/2" "1/0" "-0.0" "NaN" "Infinity" "1e400" "0.1e2"
    "12345678901234567890123456789012345678901234567890" "1." ".5" "+1" "0x10" "1_000" "--1" "1e"
    "9007199254740993" "1e308" "1e-300" "#.(quit)" "true" "null" "\"1\"" "()" "[]" "{}" ""))

(defun number-text ()
  (if (chance 30) (pick *numbers*) (format nil "~,3f" (random 2d0 *state*))))

(defun numbers (count separator)
  (let ((count (if (chance 40) (random 9 *state*) count)))
    (format nil (concatenate 'string "~{~a~^" separator "~}")
            (loop repeat count collect (number-text)))))

(defun faces (format separator)
  (format nil (concatenate 'string "~{~a~^" separator "~}")
          (loop for face in '("X1" "X2" "Y1" "Y2" "Z1" "Z2" "x1" "Q" "12")
                when (chance (if (= (length face) 2) 4 60))
                  collect (format nil format face))))

(defun name-text ()
  (pick '("pencil" "" "a b" "caf\\u00e9" "\\ud83d\\ude00" "\\ud800" "x\\\\y" "a;b" "(" "))" "{"
          "]")))

(defun shuffled (list)
  (sort (mapcar (lambda (item) (cons (random 1d0 *state*) item)) list) #'< :key #'car))

(defun some-parts (parts)
  "Return PARTS in a random order, now and then without one or with one twice."
  (let ((parts (mapcar #'cdr (shuffled parts))))
    (cond ((chance 30) (rest parts))
          ((chance 30) (cons (first (last parts)) parts))
          (t parts))))

(defun lisp-box ()
  (format nil (if (chance 10) "(SETQ BOX '(~{~a~^ ~}))" "(~{~a~^ ~})")
          (some-parts (list (format nil "(SIZE ~a)" (numbers 3 " "))
                            (format nil "(WEIGHT ~a)" (numbers 1 " "))
                            (format nil "(POSE (~a) (~a))" (numbers 3 " ")
                                    (if (chance 9) (numbers 4 " ") "0 -0.6 0 0.8"))
                            (format nil "(CENTRE ~a)" (if (chance 9) (numbers 3 " ") "0 0 0"))
                            (format nil "(u ~a)" (numbers 1 " "))
                            (format nil "(v ~a)" (numbers 1 " "))
                            (format nil "(CONSTRAINED ~a)" (faces "~a" " "))
                            (format nil "(FORCE-NEEDED (~a))" (numbers 6 " "))
                            (format nil "(VELOCITY-NEEDED (~a))" (numbers 6 " "))
                            (if (chance 9)
                                (format nil "(FACTS (WET) (FRAGILE (~a)))" (faces "~a" " "))
                                "(FACTS)")
                            (pick '("(UNITS MM N)" "(units in Finger)" "(UNITS M)" "(DATA)"
                                    "(DATA 1)"
                                    "(DATA (a (\"b\")) 1/2)" "(MASS 1)" "(MASS 1e300)"
                                    "(UNITS mm kg)"))
                            (format nil "(POSE (~a) (~a))" (numbers 3 " ")
                                    (if (chance 9) (numbers 4 " ") "0 -0.6 0 0.8"))
                            (format nil "(CENTRE ~a)" (if (chance 9) (numbers 3 " ") "0 0 0"))
                            (format nil "(NAME \"~a\")" (substitute #\_ #\\ (name-text)))))))

(defun json-box ()
  (format nil "{~{~a~^, ~}}"
          (some-parts (list (format nil "\"size\": [~a]" (numbers 3 ", "))
                            (format nil "\"weight\": ~a" (number-text))
                            (format nil "\"pose\": {\"position\": [~a], \"orientation\": [~a]}"
                                    (numbers 3 ", ")
                                    (if (chance 9) (numbers 4 ", ") "0, -0.6, 0, 0.8"))
                            (format nil "\"centre\": [~a]"
                                    (if (chance 9) (numbers 3 ", ") "0, 0, 0"))
                            (format nil "\"u\": ~a" (number-text))
                            (format nil "\"v\": ~a" (number-text))
                            (format nil "\"constrained\": [~a]" (faces "\"~a\"" ", "))
                            (format nil "\"force_needed\": [~a]" (numbers 6 ", "))
                            (format nil "\"velocity_needed\": [~a]" (numbers 6 ", "))
                            (if (chance 9)
                                (format nil "\"facts\": [[\"WET\"], [\"FRAGILE\", [~a]]]"
                                        (faces "\"~a\"" ", "))
                                "\"facts\": []")
                            (pick '("\"units\": [\"mm\", \"N\"]" "\"units\": [\"in\", \"finger\"]"
                                    "\"units\": \"mm\"" "\"data\": null"
                                    "\"data\": [1.50, {\"a\": []}]"
                                    "\"data\": {}" "\"mass\": 1" "\"mass\": 1e300"))
                            (format nil "\"pose\": {\"position\": [~a], \"orientation\": [~a]}"
                                    (numbers 3 ", ")
                                    (if (chance 9) (numbers 4 ", ") "0, -0.6, 0, 0.8"))
                            (format nil "\"centre\": [~a]"
                                    (if (chance 9) (numbers 3 ", ") "0, 0, 0"))
                            (format nil "\"name\": \"~a\"" (name-text))))))

(defun good-box (notation number)
  "Return the line of a good box whose name is NUMBER."
  (format nil (ecase notation
                (:lisp "((SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED Z2 X1) ~
                        (FORCE-NEEDED (1 1 1 1 1 1)) (VELOCITY-NEEDED (0 1 1 0 1 1)) ~
                        (NAME \"good ~d\"))")
                (:json "{\"size\": [12, 2, 2], \"weight\": 0.2, \"u\": 0.8, \"v\": 0.2, ~
                        \"constrained\": [\"Z2\", \"X1\"], \"force_needed\": [1, 1, 1, 1, 1, 1], ~
                        \"velocity_needed\": [0, 1, 1, 0, 1, 1], \"name\": \"good ~d\"}"))
          number))

;;; Spoiling

(defun octets-of (text) (sb-ext:string-to-octets text :external-format :utf-8))

(defun mild-octet ()
  "Return an octet that neither opens nor closes anything."
  (loop for octet = (random 256 *state*)
        unless (find (code-char octet) (format nil "()[]{}\"';,\\~c" #\Newline))
          return octet))

(defun any-octet ()
  (if (chance 2)
      (random 256 *state*)
      (char-code (pick (coerce (format nil "()[]{}\"';,:\\#|`.-+e09 ~c~c" #\Newline #\Return)
                               'list)))))

(defun spoil (octets octet start)
  "Return OCTETS with some changed, taken out or put in from START on; OCTET is a function that
gives new ones."
  (let ((list (coerce octets 'list)))
    (loop repeat (1+ (random 4 *state*))
          do (let* ((place (+ start (random (max 1 (- (length list) start 1)) *state*)))
                    (before (subseq list 0 (min place (length list))))
                    (after (nthcdr place list)))
               (setf list (ecase (random 4 *state*)
                            (0 (append before (list (funcall octet)) (rest after)))
                            (1 (append before (loop repeat (1+ (random 5 *state*))
                                                    collect (funcall octet))
                                       after))
                            (2 (append before (list (funcall octet)) after))
                            (3 (if (eq octet 'any-octet)
                                   (append before (nthcdr (random 20 *state*) after))
                                   list))))))
    (coerce list '(vector (unsigned-byte 8)))))

(defun spoiled-box (notation)
  "Return the octets of a box that is spoiled in some way."
  (let ((octets (octets-of (if (eq notation :lisp) (lisp-box) (json-box)))))
    (ecase (random 3 *state*)
      (0 octets)
      (1 (spoil octets 'any-octet 0))
      (2 (spoil octets 'mild-octet 2)))))

(defun one-fragment-p (octets notation)
  "True if OCTETS, one line, are one fragment in NOTATION for certain: what opens first is closed
by the last octet and not before."
  (destructuring-bind (open close) (if (eq notation :lisp) '(40 41) '(123 125))
    (let ((depth 0) (string nil) (last (1- (length octets))))
      (and (plusp last)
           (not (find 10 octets))
           (not (find 30 octets))       ; a mark between records, as before an object in a box
           (= (aref octets 0) open)
           (loop for place from 0 to last
                 for octet = (aref octets place)
                 do (cond ((and (= octet 59) (not string) (eq notation :lisp)) (return nil))
                          ((and string (= octet 92)) (incf place))
                          ((= octet 34) (setf string (not string)))
                          (string)
                          ((= octet open) (incf depth))
                          ((= octet close) (decf depth)))
                    (when (and (zerop depth) (not string))
                      (return (= place last))))))))

;;; A run

(defun write-spoiled-boxes (file notation count seed)
  "Write COUNT spoiled boxes in NOTATION, chosen by SEED, each followed by a good one, to FILE.
Return a list that tells, for each of them, whether it must get exactly one record."
  (let ((*state* (sb-ext:seed-random-state seed))
        (*read-default-float-format* 'double-float))
    (with-open-file (out file :direction :output :if-exists :supersede
                              :element-type '(unsigned-byte 8))
      (loop for number below count
            collect (let ((octets (spoiled-box notation)))
                      (write-sequence octets out)
                      (write-byte 10 out)
                      (write-sequence (octets-of (good-box notation number)) out)
                      (write-byte 10 out)
                      (one-fragment-p octets notation))))))

(defun records-between (file ones)
  "Return a string that says what is wrong with the JSON records in FILE, or NIL.  ONES as
WRITE-SPOILED-BOXES returns it."
  (with-open-file (in file :external-format :utf-8)
    (loop with number = 0 and between = 0
          for line = (read-line in nil)
          while line
          do (cond ((not (search "\"reason\":" line)) (return (format nil "no record: ~a" line)))
                   ;; What a spoiled box opened by chance is reported where it ends.
                   ((search "this array is never closed" line))
                   ((not (eql 0 (search "{\"name\":\"good " line))) (incf between))
                   ((not (eql 0 (search (format nil "{\"name\":\"good ~d\"" number) line)))
                    (return (format nil "not good box ~d: ~a" number line)))
                   ((not (search "\"status\":\"grasp\"" line))
                    (return (format nil "a good box got: ~a" line)))
                   ((and (pop ones) (/= between 1))
                    (return (format nil "~d records before good box ~d" between number)))
                   (t (incf number)
                      (setf between 0)))
          finally (return (and ones (format nil "only ~d good boxes have records" number))))))

(defun run-program (command input output)
  "Run COMMAND on the file INPUT.  Return what is wrong, or NIL."
  (multiple-value-bind (ignored errors status)
      (uiop:run-program (append '("timeout" "300") command) :input input :output output
                                                            :error-output :string
                                                            :ignore-error-status t)
    (declare (ignore ignored))
    (cond ((not (member status '(0 65))) (format nil "status ~d: ~a" status errors))
          ((> (count #\Newline errors) 1) (format nil "said: ~a" errors)))))

(defun notation-told-p (input notation)
  "True if the first octet of INPUT that is not blank tells that it is in NOTATION."
  (with-open-file (in input :element-type '(unsigned-byte 8))
    (let ((first (loop for octet = (read-byte in nil)
                       while (member octet '(9 10 12 13 32))
                       finally (return octet))))
      (eq (and (member first '(91 123)) t) (eq notation :json)))))

(defun fuzz-boxes (command notation count seed directory)
  "Let COMMAND, a list of strings, answer COUNT spoiled boxes in NOTATION, :LISP or :JSON, chosen by
SEED.  Files are kept in DIRECTORY.  Return NIL, or a string that says what is wrong."
  (let* ((input (merge-pathnames (format nil "fuzz-~(~a~).in" notation) directory))
         (output (merge-pathnames (format nil "fuzz-~(~a~).out" notation) directory))
         (ones (write-spoiled-boxes input notation count seed)))
    (or (run-program (append command '("--format" "json")
                             (unless (notation-told-p input notation)
                               (list "--input" (if (eq notation :json) "json" "sexp"))))
                     input output)
        (records-between output ones))))

;;; Rules and grasps

(defun file-forms (file)
  "Return the texts of the outermost forms of FILE, of the project."
  (let* ((text (uiop:read-file-string (asdf:system-relative-pathname "supergrip" file)))
         (starts (loop for start = (search (format nil "~%(") text)
                         then (search (format nil "~%(") text :start2 (1+ start))
                       while start collect (1+ start))))
    (loop for (start end) on starts collect (subseq text start end))))

(defun spoiled-text (text)
  (let ((text (sb-ext:octets-to-string (coerce (spoil (octets-of text) 'any-octet 0)
                                               '(vector (unsigned-byte 8)))
                                       :external-format '(:utf-8 :replacement #\?))))
    (if (chance 4) (subseq text 0 (random (1+ (length text)) *state*)) text)))

(defun text-forms (text)
  (supergrip-data:read-all (supergrip-data:string-source text :name "spoiled")))

(defun text-file (text name)
  "Return the data file NAME that holds TEXT."
  (multiple-value-bind (forms lines comments) (text-forms text)
    (supergrip::make-data-file :name name :forms forms :lines lines :comments comments)))

(defun try-forms (rules grasps)
  "Read the texts RULES and GRASPS, and plan with them if they are valid.  True if they are."
  (handler-case
      (multiple-value-bind (knowledge problems)
          (supergrip::build-knowledge (text-file rules "rules") (text-file grasps "grasps"))
        (mapc #'princ-to-string problems)
        (unless (supergrip-data:errors-in problems)
          (let ((plan (supergrip:plan (first (text-forms (good-box :lisp 0)))
                                      :knowledge knowledge)))
            (supergrip::plan-record plan)
            t)))
    (supergrip-data:syntax-error () nil)))

(defun fuzz-knowledge (count seed)
  "Read COUNT rules and grasps that are spoiled, chosen by SEED, and plan with those that are still
valid.  Return NIL, or a string that says which one failed."
  (let* ((*state* (sb-ext:seed-random-state seed))
         (rules (file-forms "rules.lisp"))
         (grasps (file-forms "grasps.lisp"))
         (gripper (find-if (lambda (text) (search "GRIPPER" text)) grasps))
         (helpers (format nil "~{~a~%~}" (remove 0 grasps :test-not #'eql
                                                          :key (lambda (text)
                                                                 (search "(DEFUN" text)))))
         (grasp-forms (remove-if (lambda (text) (or (search "GRIPPER '" text)
                                                    (eql 0 (search "(DEFUN" text))))
                                 grasps)))
    (loop repeat count
          do (let ((rule (pick rules)) (grasp (pick grasp-forms)) (hand gripper))
               (ecase (random 3 *state*)
                 (0 (setf rule (spoiled-text rule)))
                 (1 (setf grasp (spoiled-text grasp)))
                 (2 (setf hand (spoiled-text hand))))
               (handler-case
                   (sb-ext:with-timeout 10
                     (try-forms rule (format nil "~a~%~a~%~a" hand helpers grasp)))
                 (serious-condition (condition)
                   (return (format nil "~a: ~a~%~a~%~a~%~a" (type-of condition) condition rule
                                   hand grasp))))))))
