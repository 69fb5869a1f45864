;;;; client.lisp -- the client in Python, and the table that is made with it.

(in-package :supergrip-test)
(define-suite client "The client in Python, and the table that is made with it.")

(defmacro with-python (&body body)
  "Run BODY if there is a python3."
  `(if (zerop (run-process '("sh" "-c" "command -v python3")))
       (progn ,@body)
       (skip "no python3")))

(defun client (input &rest options)
  "Return the status, the output's lines and the errors of the client for INPUT, a CSV, with the
executable."
  (with-text-file (parts input)
    (multiple-value-bind (status output errors)
        (run-process (list* "python3" (uiop:native-namestring (project-file "examples/client.py"))
                            "--program" (program) parts options))
      (values status (lines-of output) errors))))

(defun robotiq ()
  (uiop:native-namestring (project-file "examples/hands/robotiq-3-finger.lisp")))

(defparameter *columns* "name,x_mm,y_mm,z_mm,mass_kg")

(defun found-p (texts line)
  (every (lambda (text) (search text line)) texts))

(test every-part-has-an-answer-in-order
  (with-python
    (multiple-value-bind (status lines errors)
        (client (format nil "~a,u~%tea,130,75,70,0.12,~%bad,1,x,3,1,~%wide,300,200,150,1.2,0.6~%~
                             none,0,1,1,1,0.6~%short,1~%soap,85,55,30,0.1,0.05~%last,60,60,60,0.1,~%"
                        *columns*)
                "--gripper" (robotiq))
      (is (eql 1 status) "two rows are wrong")
      (is (equal "" errors))
      (loop for (texts line)
              in (mapcar #'list
                         '(("\"tea\"" "\"status\": \"grasp\"" "\"position\": [" "\"opening\": 75.0"
                            "\"fits\": true")
                           ("\"bad\"" "\"error\"" "row 3: y_mm is 'x', not a number")
                           ("\"wide\"" "\"cant\"" "NO GRASP IS POSSIBLE")
                           ("\"none\"" "\"error\"" "row 5: x_mm is 0, but must be more than 0")
                           ("\"short\"" "\"error\"" "row 6: there is no")
                           ("\"soap\"" "\"cant\"" "TOO SLIPPERY")
                           ("\"last\"" "\"grasp\""))
                         lines)
            do (is (found-p texts line) "~a" line))
      (is (= 7 (length lines))))))

(test a-program-that-dies-is-started-again
  (with-python
    ;; A stand-in answers one box, and then ends.
    (with-text-file (program (format nil "#!/bin/sh~%read -r box; \"~a\" \"$@\" <<END~%$box~%END~%"
                                     (program)))
      (run-process (list "chmod" "+x" program))
      (multiple-value-bind (status lines)
          (client (format nil "~a~%~{~a,60,60,60,0.1~%~}" *columns* '("a" "b" "c"))
                  "--program" program "--gripper" (robotiq))
        (is (eql 1 status))
        (is (equal '("grasp" "error" "grasp")
                   (loop for line in lines
                         collect (if (search "before it answered" line) "error" "grasp"))))))))

(test a-program-that-can-not-start-ends-the-client
  (with-python
    (multiple-value-bind (status lines errors)
        (client (format nil "~a~%a,60,60,60,0.1~%b,60,60,60,0.1~%" *columns*)
                "--gripper" "/no/such/gripper.lisp")
      (is (eql 1 status))
      (is (null lines))
      (is (search "/no/such/gripper.lisp: can't be opened" errors))
      (is (search "client.py: the program ended with status 66 before it answered" errors)))))

(test a-wrong-value-is-named-with-row-column-and-rule
  (with-python
    (multiple-value-bind (status lines)
        (client (format nil "~a~%~{~a~%~}"
                        "name,x_mm,y_mm,z_mm,mass_kg,u,on,at_x_mm,at_y_mm,yaw_deg"
                        '("a,90,60,30,-1,-0.5" "b,nan,inf,1_0,\"0,1\"" "" ",90,60,30,0.1,7"
                          "d,90,5,60,30,0.1,,,,,1" "e,90,60,30,0.1,,bottom" "f,90,60,30,0.1,,,4"
                          "g,90,60,30,0.1,,,,,9" ",90,60,30,0.1,,none,,,,,"))
                "--gripper" (robotiq))
      (is (eql 1 status))
      (loop for text
              in '("\"row 2: mass_kg is -1, but must be more than 0; u is -0.5, but must be from"
                   "\"row 3: x_mm is 'nan', not a number; y_mm is 'inf', not a number; z_mm is"
                   "{\"name\": \"row 5\", \"status\": \"error\", \"reason\": \"row 5: u is 7, but"
                   "row 6: there are 11 fields, but 10 columns: write decimals with a point"
                   "row 7: on is 'bottom', but must be faces"
                   "row 8: at_x_mm is given, but at_y_mm is not: give both"
                   "row 9: yaw_deg is given, but at_x_mm is not"
                   "{\"name\": \"row 10\", \"status\": \"grasp\"")
            for line in lines
            do (is (search text line) "~a" line))
      (is (search "'0,1', not a number: write decimals with a point" (second lines)))
      (is (= 8 (length lines))))))

(test what-the-program-finds-wrong-is-said-by-row
  (with-python
    (with-text-file (file (changed (file-text "examples/hands/robotiq-3-finger.lisp")
                                   "FINGER-FORCE  60" ""))
      (let ((answer (first (nth-value 1 (client (format nil "~a~%a,60,60,60,0.1~%" *columns*)
                                                "--gripper" file)))))
        (is (search "\"error\"" answer))
        (is (search "\"reason\": \"row 2: \\\"units\\\": " answer) "~a" answer)
        (is (search "needs FINGER-FORCE" answer))))))

(test a-file-without-parts-or-with-other-columns-is-refused
  (with-python
    (loop for (text . message)
            in `(("" . "the file is empty; its first row must name columns: name, x_mm")
                 ("~a" . "there are no parts below the columns' names")
                 ("mu,~a~%" . "no column 'mu' (did you mean u?); its columns are 'mu', 'name'")
                 ("~a,at_x~%" . "no column 'at_x' (did you mean at_x_mm?)")
                 ("~a,yaw~%" . "no column 'yaw' (did you mean yaw_deg?)")
                 ("~a,name~%" . "the column name is there twice")
                 ("name,x_mm,y_mm~%" . "without z_mm, mass_kg: these columns are needed")
                 ("name;x_mm~%a;1~%" . "its columns have ; between them; commas are needed: name,x_mm")
                 ("name x_mm~%a 1~%" . "no column 'name x_mm'; its columns are 'name x_mm'"))
          do (multiple-value-bind (status lines errors)
                 (client (format nil text *columns*) "--gripper" (robotiq))
               (is (eql 65 status))
               (is (null lines))
               (is (search message errors) "~a" errors)
               (is (= 1 (length (lines-of errors))))))))

(test a-hand-is-asked-for-once
  (with-python
    (multiple-value-bind (status lines errors)
        (client (format nil "~a~%a,60,60,60,0.1~%b,60,60,60,0.1~%" *columns*))
      (is (eql 2 status))
      (is (null lines))
      (is (= 1 (count-if (lambda (line) (search "pass --gripper FILE" line)) (lines-of errors)))))))

(test standard-input-may-begin-with-a-byte-order-mark
  (with-python
    (with-text-file (parts (format nil "~c~a,,~%a,60,60,60,0.1,,~%,,,,~%" (code-char #xfeff)
                                   *columns*))
      (multiple-value-bind (status output)
          (run-process (list "sh" "-c" "python3 \"$0\" --boxes - < \"$1\""
                             (uiop:native-namestring (project-file "examples/client.py")) parts))
        (is (eql 0 status))
        (is (search "{\"name\": \"a\"" output))
        (is (= 1 (length (lines-of output))))))))

(test equal-names-are-told
  (with-python
    (multiple-value-bind (status lines errors)
        (client (format nil "~a~%~{~a,60,60,60,0.1~%~}" *columns* '("a" "b" "a"))
                "--gripper" (robotiq))
      (is (eql 0 status))
      (is (= 3 (length lines)))
      (is (equal '("client.py: row 4: the name 'a' is that of row 2, too") (lines-of errors))))))

(test boxes-are-printed-for-the-program
  (with-python
    (multiple-value-bind (status lines errors)
        (client (format nil "~a,on~%a,60,50,40,0.1,none~%b,60,-50,40,0.1~%" *columns*) "--boxes")
      (is (eql 1 status))
      (is (= 1 (length lines)))
      (is (found-p '("\"size\": [60.0, 50.0, 40.0]" "\"constrained\": []"
                     "\"velocity_needed\": [0, 0, 1, 0, 0, 0]")
                   (first lines)))
      (is (search "row 3: y_mm is -50, but must be more than 0" errors)))))

(test a-flat-part-is-taken-from-above
  (with-python
    (let* ((gripper (changed (file-text "examples/hands/robotiq-3-finger.lisp")
                             "WIDTH-HAND    9.7" "WIDTH-HAND    7.8")))
      (with-text-file (file gripper)
        (let ((line (first (nth-value 1 (client (format nil "~a~%soap,90,60,30,0.1~%" *columns*)
                                                "--gripper" file)))))
          ;; The palm is PALM-DEPTH above the point between the fingertips.
          (is (found-p '("\"position\": [0.0, 0.0, 0.0]" "\"palm\": [0.0, 0.0, 87.5]") line)
              "~a" line))))))

(test options-are-passed-on
  (with-python
    (let ((part (format nil "~a,at_x_mm,at_y_mm~%a,60,50,40,1,400,0~%" *columns*)))
      (is (found-p '("\"alternatives\": [{\"grasp\"" "\"squeeze\": " "\"world\": {"
                     "\"fits\": true")
                   (first (nth-value 1 (client part "--gripper" (robotiq) "--all" "2"
                                               "--index" "exact")))))
      (is (search "can't hold the weight"
                  (first (nth-value 1 (client part "--gripper" (robotiq) "--margin" "9"))))))))

(test who-has-read-enough-ends-the-client-quietly
  (with-python
    (with-text-file (parts (format nil "~a~%~{~a,60,60,60,0.1~%~}" *columns*
                                   (loop for part below 300 collect part)))
      (multiple-value-bind (status output errors)
          (run-process (list "sh" "-c" (format nil "python3 \"$0\" --program \"$1\" \"$2\" ~
                                                    --gripper \"$3\" | head -n 1")
                             (uiop:native-namestring (project-file "examples/client.py"))
                             (program) parts (robotiq)))
        (is (eql 0 status))
        (is (= 1 (length (lines-of output))))
        (is (null (search "Traceback" errors)) "~a" errors)))))

(test the-table-of-objects-is-current
  (with-python
    (multiple-value-bind (status output errors)
        (run-process (list "python3" (uiop:native-namestring (project-file "examples/ycb.py"))
                           "--program" (program)))
      (is (eql 0 status))
      (is (equal "" errors))
      (is (= 32 (length (lines-of output))))
      (is (search output (file-text "docs/ycb.md"))))))
