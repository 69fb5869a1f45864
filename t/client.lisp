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
      (is (equal "" (string-trim '(#\Newline)
                                 (changed errors (format nil "supergrip: 1 of 5 boxes are not valid; ~
                                                              their records say why")
                                          ""))))
      (loop for (texts line)
              in (mapcar #'list
                         '(("\"tea\"" "\"status\": \"grasp\"" "\"position\": [" "\"opening\": 75.0"
                            "\"fits\": true")
                           ("\"bad\"" "\"error\"" "row 3: y_mm is 'x', not a number")
                           ("\"wide\"" "\"cant\"" "NO GRASP IS POSSIBLE")
                           ("\"none\"" "\"error\"" "size")
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
      (is (search "client.py: the program ended with status 66 before it answered" errors)))
    (multiple-value-bind (status lines errors) (client "" "--program" "/no/such/program")
      (is (eql 0 status) "no part, no program")
      (is (null lines))
      (is (equal "" errors)))))

(test who-has-read-enough-ends-the-client-quietly
  (with-python
    (with-text-file (parts (format nil "~a~%~{~a,60,60,60,0.1~%~}" *columns*
                                   (loop for part below 300 collect part)))
      (multiple-value-bind (status output errors)
          (run-process (list "sh" "-c" (format nil "python3 \"$0\" --program \"$1\" \"$2\" --gripper ~
                                                    \"$3\" | head -n 1")
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
