;;;; main.lisp -- the command line: every option and every exit status, by running the command.

(in-package :supergrip-test)
(define-suite main "The command line: every option and every exit status, by running the command.")

(defun shell (command &rest arguments)
  "Run COMMAND by bash, the executable being $0 and ARGUMENTS $1 and so on."
  (multiple-value-bind (status output errors)
      (run-process (list* "timeout" "60" "bash" "-c" command (program) arguments))
    (list status output errors)))

(defun status-of (text &rest options)
  (nth-value 0 (run-on text (cons (program) options))))

(test the-script-does-what-the-executable-does
  (dolist (options '(() ("--format" "json") ("--format=trace") ("--help") ("--version")
                     ("--gamma" "0.9")))
    (multiple-value-bind (status output errors) (run-on *pencil* (cons (program) options))
      (is (eql 0 status))
      (is (equal "" errors))
      (multiple-value-bind (script-status script-output)
          (run-on *pencil* (append (script "examples/batch.lisp") options))
        (is (eql status script-status))
        (is (equal output script-output) "~a" options)))))

(test formats-and-notations
  (let ((session (file-text "t/pencil-session.txt")))
    (dolist (pencil (list *pencil* *json-pencil*))
      (is (equal session (nth-value 1 (run-on pencil (list (program) "--format" "trace")))))
      (is (eql #\{ (char (nth-value 1 (run-on pencil (list (program) "--format" "json"))) 0)))
      (is (eql #\( (char (nth-value 1 (run-on pencil (list (program) "--format" "sexp"))) 0)))))
  (is (eql #\( (char (nth-value 1 (run-on *pencil* (list (program)))) 0)))
  (is (eql #\{ (char (nth-value 1 (run-on *json-pencil* (list (program)))) 0)))
  (is (eql 65 (status-of *pencil* "--input" "json")))
  (is (eql 65 (status-of *json-pencil* "--input" "sexp")))
  (is (search "(BAD BOX: line 1, column 1: WEIGHT is missing"
              (nth-value 1 (run-on "((SIZE 1 1 1))" (list (program) "--format" "trace"))))))

(test gamma-weighs
  (flet ((quality (gamma)
           (getf (first (answers *pencil* "--gamma" gamma)) :quality)))
    (is (close-to (supergrip:plan-quality (supergrip:plan *good-box* :gamma 1)) (quality "1")))
    (is (close-to (supergrip:plan-quality (supergrip:plan *good-box* :gamma 0.25d0))
                  (quality "1/4")))))

(test wrong-command-lines-give-64
  (loop for (report . options) in
        '(("there is no option --fromat (did you mean --format?)" "--fromat" "json")
          ("--format must be trace, sexp, json, isaac, moveit or graspgen, not xml" "--format"
           "xml")
          ("--input must be sexp or json, not trace" "--input=trace")
          ("--format needs a value" "--format")
          ("--rules needs the name of a file" "--rules" "")
          ("--check takes no value" "--check=yes")
          ("--gamma must be a number from 0 (forces alone) to 1 (velocities alone), not 1.5"
           "--gamma" "1.5")
          ("not 0.5 foo" "--gamma" "0.5 foo") ("not 40 41" "--number-limit" "40 41")
          ("not NaN" "--gamma" "NaN") ("not #.(quit)" "--gamma" "#.(quit)")
          ("--depth-limit must be a whole number from 1 to 1000, not 1001" "--depth-limit" "1001")
          ("--record-limit must be a whole number" "--record-limit" "0.5")
          ("--number-limit must be a whole number" "--number-limit" "0")
          ("--name-limit must be a whole number" "--name-limit" "x")
          ("--all must be a whole number from 1 to 1000, not 0" "--all" "0")
          ("not 1001" "--all" "1001")
          ("not 1.5" "--all" "1.5") ("not many" "--all" "many") ("--all needs a value" "--all")
          ("--all does not go with --format trace" "--all" "2" "--format" "trace")
          ("--refine goes with --format sexp or json" "--refine" "--format" "trace")
          ("--check reads no boxes: x" "--check" "x")
          ("--verify goes with --check" "--verify" "x")
          ("there is no option -x" "-x"))
        do (multiple-value-bind (status output errors) (run-on "" (cons (program) options))
             (is (eql 64 status) "~a: ~a" options status)
             (is (equal "" output))
             (is (search report errors) "~a: ~a" options errors))))

(test limits-can-be-changed
  (loop for (options text report) in
        '((("--depth-limit" "2") "((SIZE (1)))" "nest deeper than 2")
          (("--record-limit" "9") "((SIZE 1 2 3))" "longer than 9 characters")
          (("--record-limit" "1") "((SIZE 1))" "longer than 1 character")
          (("--number-limit" "3") "((SIZE 1.000))" "a number of 5 characters; at most 3 are read")
          (("--name-limit" "1") "((SIZE 1))" "a name of 4 characters; at most 1 is read")
          (("--depth-limit" "40")
           "((((((((((((((((((((((((((((((((((((()))))))))))))))))))))))))))))))))))))"
           "is not a part of a box")
          (("--number-limit" "60") "((SIZE 1 1 1.00000000000000000000000000000000000000000000))"
           "WEIGHT is missing"))
        do (is (search report (getf (first (apply #'answers text options)) :reason))
               "~a: ~s" options (apply #'answers text options))))

(test boxes-that-are-not-valid-are-counted
  (loop for (boxes . text) in
        `(("()" . "supergrip: 1 of 1 box is not valid; its record says why")
          (,(format nil "()~%~a" (one-line *pencil*))
            . "supergrip: 1 of 2 boxes is not valid; its record says why")
          ("() ()" . "supergrip: 2 of 2 boxes are not valid; their records say why"))
        do (is (equal (list text) (lines-of (nth-value 2 (answers boxes)))) "~a" boxes)))

(test check-reads-rules-and-grasps
  (destructuring-bind (status output errors) (shell "\"$0\" --check")
    (is (eql 0 status))
    (is (equal "" output))
    (is (equal (format nil "~d rules and ~d grasps, no mistakes~%" (rule-total) (grasp-total))
               errors)))
  (with-text-file (rules "(RULE A (IF (SLIPPERY)) (THEN (TRY NO-SUCH-GRASP)))")
    (loop for options in '("--check" "")
          do (destructuring-bind (status output errors)
                 (shell (format nil "\"$0\" ~a --rules \"$1\" < /dev/null" options) rules)
               (is (eql 65 status))
               (is (equal "" output))
               (is (search ":1: RULE A, action 1: TRY names NO-SUCH-GRASP" errors))))))

(test check-verifies
  (with-text-file (rules *good-rules*)
    (with-text-file (grasps *good-grasps*)
      (destructuring-bind (status output errors)
          (shell "\"$0\" --check --verify --rules \"$1\" --grasps \"$2\"" rules grasps)
        (is (eql 0 status))
        (is (equal (with-output-to-string (out)
                     (supergrip:verify-knowledge (text-knowledge *good-rules* *good-grasps*)
                                                 :stream out))
                   output))
        (is (equal (format nil "4 rules and 1 grasp, no mistakes~%") errors))))))

(test rules-and-grasps-of-ones-own
  (with-text-file (rules "(RULE MINE (IF (CONSTRAINED (s1))) (THEN (CANT MY REASON)))")
    (is (equal "CANT MY REASON: X1, Z2 are constrained" (getf (first (answers *pencil* "--rules" rules)) :reason)))
    (with-text-file (grasps (format nil "~c~a" (code-char #xfeff) (file-text "grasps.lisp")))
      (is (equal "grasp" (getf (first (answers *pencil* "--grasps" grasps)) :status)))
      (is (equal "CANT MY REASON: X1, Z2 are constrained"
                 (getf (first (answers *pencil* "--grasps" grasps "--rules" rules)) :reason))))))

(test names-of-files-mean-nothing-to-lisp
  (dolist (name '("r[1]" "a*b?" "back\\slash" "a space" "new
line" "dots.." "..." "~" "café" "~a" "[" "*.*"))
    (destructuring-bind (status output errors)
        (shell "mkdir \"$0.odd\"; cd \"$0.odd\"
                echo '(RULE A (IF (U' > \"$1\"; \"$0\" --check --rules \"./$1\" 2>&1
                echo \"$2\" > \"$1\"; \"$0\" --rules \"./$1\" \"./$1\" 2>&1
                cd ..; rm -r \"$0.odd\""
               name "(RULE MINE (IF (CONSTRAINED (s1))) (THEN (CANT MY REASON)))")
      (declare (ignore status errors))
      (is (eql 0 (search (format nil "./~a:1:13: " name) output)) "~a" output)
      (is (search ":LINE 1 :STATUS \"error\"" output) "~a" output))))

(test rules-that-cannot-be-used
  (is (eql 66 (status-of *pencil* "--rules" "/no/such/file")))
  (is (eql 66 (status-of *pencil* "--grasps" "/no/such/file")))
  (with-text-file (empty "")
    (is (eql 65 (status-of *pencil* "--rules" empty)))
    (is (eql 65 (status-of *pencil* "--grasps" empty))))
  (with-text-file (spoiled "(RULE A (IF (SLIPPERY)) (THEN (CANT #.(quit))))")
    (destructuring-bind (status output errors) (shell "\"$0\" --rules \"$1\"" spoiled)
      (is (eql 65 status))
      (is (equal "" output))
      (is (search ":1:37: # is not allowed in a name or a number" errors))))
  (is (equal (list 66 "" (format nil "supergrip: /: can't be opened: Is a directory~%"))
             (shell "\"$0\" --rules / < /dev/null")))
  (destructuring-bind (status output errors) (shell "\"$0\" --rules $'r\\xff.lisp' < /dev/null")
    (is (eql 64 status))
    (is (equal "" output))
    (is (search "is not text in the locale's encoding" errors))))

(test files-are-read-in-turn
  (with-text-file (a *pencil*)
    (with-text-file (b *json-pencil*)
      (destructuring-bind (status output errors)
          (shell "\"$0\" --format json \"$1\" /no/such/file - -- \"$2\" < \"$1\"" a b)
        (is (eql 66 status))
        (is (= 3 (length (lines-of output))))
        (is (equal (format nil "supergrip: /no/such/file: can't be opened: No such file or ~
                                directory~%")
                   errors)))
      (is (eql 66 (first (shell "\"$0\" /no/such/file \"$1\"" (format nil "~a" a)))))
      (is (eql 66 (first (shell "echo '((' | \"$0\" / -"))) "66 before 65"))))

(test an-empty-file-does-not-choose-the-format
  (with-text-file (blank (format nil " ~%"))
    (with-text-file (json *json-pencil*)
      (is (eql #\{ (char (second (shell "\"$0\" \"$1\" \"$2\"" blank json)) 0))))))

(test statuses-of-boxes
  (is (eql 0 (status-of "")))
  (is (eql 0 (status-of (changed *pencil* "0.2" "1000"))) "a box that can't be grasped is planned")
  (is (eql 65 (status-of "((SIZE 1))"))))

(test lost-output-gives-74
  (destructuring-bind (status output errors)
      (with-text-file (pencil *pencil*)
        (shell "\"$0\" < \"$1\" > /dev/full" pencil))
    (declare (ignore output))
    (is (eql 74 status))
    (is (search "standard output: can't be written: No space left on device" errors)))
  (is (eql 74 (first (shell "\"$0\" --help > /dev/full"))))
  (is (eql 74 (first (shell "echo '((SIZE 1))' | \"$0\" / - > /dev/full"))) "74 before 66 and 65")
  (is (eql 74 (first (shell "echo '((SIZE 1))' | \"$0\" >&-")))))

(test a-reader-that-closes-early-ends-it-quietly
  (is (equal (list 0 (format nil "0~%") "")
             (shell "{ yes \"$1\" 2> /dev/null | \"$0\"; echo ${PIPESTATUS[1]} > \"$0.status\"; } | head -n 1 > /dev/null
                     cat \"$0.status\""
                    (one-line *pencil*)))))

(defun send-signal (name process)
  (uiop:run-program (format nil "kill -~a ~d" name (uiop:process-info-pid process))
                    :force-shell t))

(defun read-lines (stream)
  "Return the lines that STREAM still has."
  (loop for line = (read-line stream nil) while line collect line))

(defun signalled-run (name command records)
  "Run COMMAND, send it the signal NAME after so many RECORDS, and return its status, all its
records and what it said."
  (let* ((process (uiop:launch-program command :input :stream :output :stream
                                               :error-output :stream))
         (output (uiop:process-info-output process)))
    (write-line (one-line *pencil*) (uiop:process-info-input process))
    (finish-output (uiop:process-info-input process))
    (let ((first (loop repeat records collect (read-line output))))
      (send-signal name process)
      (let ((rest (read-lines output))
            (errors (format nil "~{~a~%~}" (read-lines (uiop:process-info-error-output process)))))
        (values (uiop:wait-process process) (append first rest) errors)))))

(test signals-end-after-the-record-in-hand
  (loop for (name status) in '(("INT" 130) ("TERM" 143))
        do (loop for (command records) in
                 `(((,(program)) 1)     ; waits for input
                   (("bash" "-c" "exec \"$0\" < <(yes \"$1\" 2> /dev/null)" ,(program)
                            ,(one-line *pencil*))
                    1000))              ; busy
                 do (multiple-value-bind (exit lines errors) (signalled-run name command records)
                      (is (eql status exit))
                      (is (equal "grasp" (getf (ignore-errors (read-from-string (first (last lines))))
                                               :status))
                          "the last record is whole")
                      (is (search (format nil "ended by SIG~a after ~d box~:*~[es~;~:;es~]" name
                                          (length lines))
                                  errors)
                          "~a ~a" (length lines) errors)))))

(test signals-end-it-from-its-beginning
  ;; From before its first instruction to after its handlers are set.
  (loop for (name status) in '(("INT" 130) ("TERM" 143))
        do (destructuring-bind (exit output errors)
               (shell "mkfifo \"$0.pipe\"; exec 3<> \"$0.pipe\"
                       for i in {1..40}; do
                         timeout --preserve-status -s $1 $(printf .%04d $((i * 3))) \"$0\" <&3 2> /dev/null
                         echo $?
                       done | sort | uniq -c; rm \"$0.pipe\"" name)
             (declare (ignore exit errors))
             (is (equal (format nil "40 ~d" status) (string-trim '(#\Space #\Newline) output)))))
  ;; And while the script loads.
  (dolist (after '(".05" ".1" ".15"))
    (is (eql 143 (nth-value 0 (run-process (list* "timeout" "--preserve-status" after
                                                  (script "examples/batch.lisp"))
                                           :input nil))))))

(test signals-end-it-whatever-it-waits-for
  (flet ((status (options &optional (input "< /dev/null"))
           (first (shell (format nil "mkfifo \"$0.pipe\"
                                      timeout --preserve-status .3 \"$0\" ~a \"$0.pipe\" ~a
                                      status=$?; rm \"$0.pipe\"; exit $status"
                                 options input)))))
    (is (eql 143 (status "")) "opening boxes")
    (is (eql 143 (status "--rules")) "opening rules")
    (is (eql 143 (status "--check --grasps" "3<> \"$0.pipe\"")) "reading grasps")
    (is (eql 143 (status "" "3<> \"$0.pipe\"")) "reading boxes"))
  (is (equal (format nil "143~%")
             (second (shell "{ { yes \"$1\" 2> /dev/null | timeout --preserve-status .3 \"$0\"; echo ${PIPESTATUS[1]} >&2; } | sleep 5; } 2>&1"
                            (one-line *pencil*))))
      "writing to a pipe that nobody empties"))

(test descriptors-may-be-non-blocking
  (if (zerop (first (shell "python3 -c 'import fcntl'")))
      (is (equal (list 0 (format nil "0 2000 2001~%") "")
                 (shell "python3 -c '
import fcntl, os, subprocess, sys, threading, time
def pipe(end):
    ends = os.pipe()
    fcntl.fcntl(ends[end], fcntl.F_SETFL, os.O_NONBLOCK)
    return ends
program, box = sys.argv[1], (sys.argv[2] + \"\\n\").encode()
(i, feed), (records, o), (errors, e) = pipe(0), pipe(1), pipe(1)
run = subprocess.Popen([program, \"-\"] + [\"/no/such/file\"] * 2000, stdin=i, stdout=o, stderr=e)
for end in i, o, e: os.close(end)
def write():
    for part in range(20):
        os.write(feed, box * 100)
        time.sleep(.002)
    os.close(feed)
def lines(end, found):
    time.sleep(.1)
    while True:
        octets = os.read(end, 5000)
        if not octets: break
        found.append(octets.count(b\"\\n\"))
out, err = [], []
threads = [threading.Thread(target=write), threading.Thread(target=lines, args=(records, out)),
           threading.Thread(target=lines, args=(errors, err))]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(run.wait() - 66, sum(out), sum(err) + 1)' \"$0\" \"$1\""
                        (one-line *pencil*))))
      (skip "no python3")))

(test on-a-terminal-it-says-that-it-waits
  (if (zerop (first (shell "script -qec true /dev/null < /dev/null")))
      (is (search "reading boxes from the terminal"
                  (second (shell "export PROGRAM=\"$0\"
                                  script -qec 'timeout 5 \"$PROGRAM\"' /dev/null < /dev/null"))))
      (skip "no terminal")))

(test progress-is-for-terminals
  ;; A run of more than two seconds, however fast the machine: the input pauses.
  (let ((input "some() { yes \"$PENCIL\" 2> /dev/null | head -n 64; }; { some; sleep 2.1; some; }"))
    (flet ((answer (command)
             (shell (format nil command input) (one-line *pencil*))))
      (is (equal "" (third (answer "PENCIL=\"$1\"; ~a | \"$0\" > /dev/null"))))
      (when (zerop (first (shell "script -qec true /dev/null < /dev/null"))) ; a terminal is to be had
        (is (search "128 boxes, "
                    (second (answer "export PENCIL=\"$1\" PROGRAM=\"$0\"
                                  script -qec '~a | \"$PROGRAM\" > /dev/null' /dev/null < /dev/null"))))))))

(defun spoiled-json ()
  "Make a file of 1000 spoiled boxes in JSON beside the executable; return its name."
  (let ((file (format nil "~a.spoiled" (program))))
    (supergrip-fuzzer:write-spoiled-boxes file :json 1000 12)
    file))

(defun without-data (record)
  (remf record :data)
  record)

(test pythons-json-reads-every-record
  (if (zerop (first (shell "python3 -c 'import json'")))
      (destructuring-bind (status output errors)
          (shell "cat \"$1\" | \"$0\" --input json --format json | python3 -c '
import json, sys
for line in sys.stdin:
    record = json.loads(line)
    assert set(record) >= {\"name\", \"line\", \"status\", \"grasp\", \"matching\", \"quality\", \"u_w\",
        \"u_t\", \"limiting\", \"offset\", \"approach\", \"contacts\", \"tried\", \"possible\", \"reason\"}
    print(json.dumps(record))' > \"$0.json\"
cat \"$1\" | \"$0\" --input json --format sexp" (spoiled-json))
        (declare (ignorable status errors))
        ;; What Python wrote, and what the other format says.
        (let ((lines (lines-of (uiop:read-file-string (format nil "~a.json" (program))
                                                      :external-format :utf-8)))
              (records (lines-of output)))
          (is (plusp (length lines)))
          (is (= (length lines) (length records)))
          ;; How data look in either notation is tested in t/carried-data.lisp.
          (loop for line in lines
                for record in records
                unless (equal (without-data (json-record line)) (without-data (lisp-record record)))
                  collect (list line record) into wrong
                finally (is (null wrong) "~{~a~%~}" (first wrong)))))
      (skip "no python3")))

(defun run-with (form &rest arguments)
  "Run the script of the batch with ARGUMENTS, FORM evaluated before it.  Return status and errors."
  (with-text-file (file (format nil "(load ~s) (supergrip-boot:load-quietly \"supergrip/batch\") ~a
                                               (supergrip::main-and-end)"
                                (uiop:native-namestring (project-file "src/boot.lisp")) form))
    (multiple-value-bind (status output errors)
        (run-on *pencil* (list* "sbcl" "--script" file arguments))
      (declare (ignore output))
      (list status errors))))

(test reports-that-cannot-be-made
  (let ((folder (format nil "~a.pages/r[1]/*" (program))))
    (flet ((reports (form &optional (folder folder))
             (run-with (format nil "(defpackage :supergrip-draw (:use :cl) (:export #:report-index))
                                    (defun supergrip-draw:report-index (plans folder) ~a)"
                               form)
                       "--report" folder)))
      (is (equal '(0 "") (reports "plans (assert (probe-file folder)) (values folder 0)")))
      (is (equal (list 74 (format nil "supergrip: ~a: 2 pages can't be drawn; index.html says ~
                                       which, and why~%"
                                  folder))
                 (reports "plans (values folder 2)")))
      (is (eql 70 (first (reports "(car folder)"))))
      (is (eql 74
               (first (reports "(open (merge-pathnames \"none/x\" folder) :direction :output)"))))
      (is (equal (list 74 (format nil "supergrip: /dev/null/x: can't be made: Not a directory~%"))
                 (reports "plans (error \"called\")" "/dev/null/x")))
      (is (equal (list 74 (format nil "supergrip: /dev/null: can't be written: Not a directory~%"))
                 (reports "plans (error \"called\")" "/dev/null"))))
    (destructuring-bind (status errors)
        (run-with "(supergrip::keep-shipped-files)"
                  "--report" folder)
      (is (eql 69 status))
      (is (search "built without cl-who" errors)))))

(test internal-errors-say-what-to-send
  (destructuring-bind (status errors) (run-with "(sb-ext:unlock-package :supergrip)
                                              (defun supergrip::run (&rest all) (car 'oops all))")
    (is (eql 70 status))
    (is (search "internal error: " errors))
    (is (search "To report it, send these lines" errors))))

(test every-status-is-documented
  (let ((page (file-text "docs/batch.md")))
    (dolist (status '("0" "64" "65" "66" "69" "70" "74" "130" "143"))
      (is (search (format nil " ~a " status) supergrip::+help+
                  :start2 (search "Exit status:" supergrip::+help+)) "--help: ~a" status)
      (is (search (format nil "~%| ~a |" status) page) "docs/batch.md: ~a" status))))

(test the-executable-goes-where-it-is-told
  (loop for (file report) in '(("/" "/: can't be written: Is a directory")
                               ("/dev/null/x/y" "/dev/null/x/y: can't be made: Not a directory"))
        do (multiple-value-bind (status output errors)
               (run-process (append (script "src/build.lisp") (list file)))
             (is (eql 66 status))
             (is (equal "" output))
             (is (search report errors) "~a" errors))))

(test the-executable-stands-alone
  (let ((copy (format nil "~a-copy" (program))))
    (uiop:copy-file (program) copy)
    (uiop:run-program (list "chmod" "+x" copy))
    (with-text-file (rules (file-text "rules.lisp"))
      (with-text-file (pencil *pencil*)
        (multiple-value-bind (status output errors)
            (run-process (list "env" "-i" "sh" "-c" "cd / && \"$0\" --rules \"$1\" < \"$2\""
                               copy rules pencil))
          (is (eql 0 status) "~a" errors)
          (is (search "PINCH-3-PARALLEL" output)))))))
