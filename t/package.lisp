;;;; package.lisp -- the test suite: counting, and what all tests share.

(defpackage :supergrip-test
  (:use :cl :fiveam)
  (:documentation "The tests of SUPER-GRIP.")
  (:export #:run-tests))

(in-package :supergrip-test)

(def-suite all :description "All tests.")
(in-suite all)

(defun run-tests ()
  "Run all tests that are loaded, print what failed or was skipped, and the line
`N passed, N failed`.  Signals an error, after that line, if something failed or nothing ran."
  (let* ((results (let ((*test-dribble* *standard-output*)) (run 'all)))
         (passed (count-if (lambda (result) (typep result 'fiveam::test-passed)) results))
         (skipped (remove 'fiveam::test-skipped results :key #'type-of :test-not #'eq))
         (failed (- (length results) passed (length skipped))))
    (when (plusp failed)
      (explain! results))
    (format t "~&~:{~a skipped: ~a~%~}"
            (loop for result in skipped
                  collect (list (fiveam::name (fiveam::test-case result))
                                (fiveam::reason result))))
    (format t "~d passed, ~d failed~%" passed failed)
    (finish-output)
    (when (or (plusp failed) (zerop passed))
      (error "the tests did not pass"))))

(defun problem-texts (function)
  "Return the report lines of the input error that FUNCTION signals, or NIL."
  (handler-case (progn (funcall function) nil)
    (supergrip-data:input-error (condition)
      (mapcar #'princ-to-string (supergrip-data:input-error-problems condition)))))

(defun lines-of (string)
  "Return the list of the lines of STRING."
  (with-input-from-string (in string)
    (loop for line = (read-line in nil) while line collect line)))
