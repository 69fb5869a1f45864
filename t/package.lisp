;;;; package.lisp -- the test suite: counting, and what all tests share.

(defpackage :supergrip-test
  (:use :cl :fiveam)
  (:documentation "The tests of SUPER-GRIP.")
  (:export #:run-tests))

(in-package :supergrip-test)

(def-suite all :description "All tests.")
(in-suite all)

(defun run-tests ()
  "Run all tests that are loaded, print what failed and the line `N passed, N failed`.
Signals an error, after that line, if something failed or nothing ran."
  (let* ((results (let ((*test-dribble* *standard-output*)) (run 'all)))
         (failed (remove-if #'passed-p results))
         (passed (- (length results) (length failed))))
    (when failed
      (explain! failed))
    (format t "~&~d passed, ~d failed~%" passed (length failed))
    (finish-output)
    (when (or failed (zerop passed))
      (error "the tests did not pass"))))

(defun passed-p (result)
  (typep result 'fiveam::test-passed))

(defun problem-texts (function)
  "Return the report lines of the input error that FUNCTION signals, or NIL."
  (handler-case (progn (funcall function) nil)
    (supergrip-data:input-error (condition)
      (mapcar #'princ-to-string (supergrip-data:input-error-problems condition)))))

(defun lines-of (string)
  "Return the list of the lines of STRING."
  (with-input-from-string (in string)
    (loop for line = (read-line in nil) while line collect line)))
