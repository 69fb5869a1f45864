;;;; package.lisp -- the package of the tests, how they run, and what the chainer's tests share with
;;;; the others: the chainer is tested with nothing else loaded.  All else that is shared:
;;;; tools.lisp.

(defpackage :supergrip-test
  (:use :cl :fiveam)
  (:documentation "The tests of SUPER-GRIP.")
  (:export #:run-tests #:print-tests))

(in-package :supergrip-test)

(def-suite all :description "All tests.")

(defmacro define-suite (name description)
  "Make the suite NAME of ALL, which holds the tests of this file."
  `(progn
     (def-suite ,name :in all :description ,description)
     (in-suite ,name)))

;;; Running

(defun shuffle (list state)
  (let ((vector (coerce list 'vector)))
    (loop for i from (1- (length vector)) downto 1
          do (rotatef (aref vector i) (aref vector (random (1+ i) state))))
    (coerce vector 'list)))

(defun tests-of (name)
  "Return the names of the tests that NAME, a symbol, names: one, or those of a suite, in order."
  (let ((test (get-test name)))
    (if (typep test 'fiveam::test-suite)
        (mapcan #'tests-of (members-of test))
        (list name))))

(defun members-of (suite)
  "Return the names of the tests and suites in SUITE, in order.  FiveAM 1.4.2 keeps them in a
table, 1.4.3 in an object of its own."
  (let ((members (fiveam::tests suite))
        (reader (find-symbol "%TEST-NAMES" :fiveam)))
    (if reader
        (reverse (funcall reader members))
        (loop for member being the hash-keys of members collect member))))

(defun named-tests (names)
  "Return the names of the tests that NAMES, strings, name; without NAMES, of all."
  (if names
      (loop for name in names
            for symbol = (find-symbol (string-upcase name) :supergrip-test)
            unless (and symbol (get-test symbol))
              do (error "there is no test and no suite ~a" name)
            append (tests-of symbol))
      (tests-of 'all)))

(defun print-tests (&optional names)
  "Print the names of the tests that NAMES name, each on a line."
  (format t "~(~{~a~%~}~)" (named-tests names)))

(defun run-tests (&key names seed)
  "Run the tests and suites called NAMES, strings, or all; given SEED, a number, in the random order
that it chooses.  Print what failed or was skipped, and the line `N passed, N failed`.
Signals an error, after that line, if something failed or nothing ran."
  (let* ((tests (named-tests names))
         (results (let ((*test-dribble* *standard-output*))
                    (run (if seed
                             (shuffle tests (sb-ext:seed-random-state seed))
                             tests))))
         (passed (count-if (lambda (result) (typep result 'fiveam::test-passed)) results))
         (skipped (remove 'fiveam::test-skipped results :key #'type-of :test-not #'eq))
         (failed (- (length results) passed (length skipped))))
    (when (plusp failed)
      (explain! results))
    (format t "~&~:{~a skipped: ~a~%~}"
            (loop for result in skipped
                  collect (list (fiveam::name (fiveam::test-case result))
                                (fiveam::reason result))))
    (when seed
      (format t "in the order of seed ~d~%" seed))
    (format t "~d passed, ~d failed~%" passed failed)
    (finish-output)
    (when (or (plusp failed) (null results))
      (error "the tests did not pass"))))

;;; What the tests of the chainer share with others

(defun problem-texts (function)
  "Return the report lines of the input error that FUNCTION signals, or NIL."
  (handler-case (progn (funcall function) nil)
    (supergrip-data:input-error (condition)
      (mapcar #'princ-to-string (supergrip-data:input-error-problems condition)))))

(defun read-text (text)
  "Return the forms of TEXT, names as strings."
  (labels ((plain (form)
             (cond ((null form) nil)
                   ((symbolp form) (symbol-name form))
                   ((consp form) (mapcar #'plain form))
                   (t form))))
    (plain (supergrip-data:read-all (supergrip-data:string-source text)))))

(defun event-text (event rulebase)
  (multiple-value-bind (predicate face-list) (supergrip-chainer:event-fact event rulebase)
    (format nil "~a: ~a~{ ~a~}"
            (supergrip-chainer:rule-name (supergrip-chainer:event-rule event rulebase))
            (supergrip-chainer:predicate-text predicate)
            (supergrip-chainer:face-list-names face-list))))
