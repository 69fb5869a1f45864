;;;; mutants.lisp -- sbcl --script t/mutants.lisp [COUNT [SEED]] compares mutants of rules.lisp.
;;;;
;;;; Each of COUNT mutants, 500 by default, has one random change.  COMPARE-KNOWLEDGE must find a
;;;; box for each that changes an answer in some situation, count these situations, and find
;;;; nothing for the others: the plans of a box of each situation say which.  Then the shipped rules
;;;; and 100 rules are verified, and the times are printed.

(load (merge-pathnames "registry.lisp" *load-truename*))

(let ((*standard-output* (make-broadcast-stream)))
  (handler-bind ((warning #'muffle-warning))
    (asdf:load-system "supergrip/test")))

(in-package :supergrip-test)

(defun compare-mutants (count seed)
  "Compare COUNT mutants, print how many there were of each sort, and return true if none was
missed."
  (let* ((state (sb-ext:seed-random-state seed))
         (old (shipped-knowledge))
         (boxes (situation-boxes))
         (old-answers (plan-answers old boxes))
         (changing 0) (faults '()))
    (loop for number from 1 to count
          do (multiple-value-bind (fault changed) (mutant-fault old old-answers boxes state)
               (when changed (incf changing))
               (when fault (push (list number fault) faults))))
    (format t "~d mutants, seed ~d: ~d change an answer, ~d faults~%~:{  mutant ~d: ~a~%~}"
            count seed changing (length faults) (reverse faults))
    (null faults)))

(defun many-rules (count seed)
  "Return the forms of COUNT rules: those that are shipped, and before the last one mutants of
them."
  (let* ((state (sb-ext:seed-random-state seed))
         (forms (shipped-rule-forms))
         (last (last forms)))
    (append (butlast forms)
            (loop for number from (1+ (length forms)) to count
                  for (nil nil if then) = (random-element (mutant (butlast forms) state) state)
                  collect (list (supergrip-data:canonical-name "RULE")
                                (supergrip-data:canonical-name (format nil "MUTANT~d" number))
                                if then))
            last)))

(defun seconds (function)
  "Return how many seconds of the processor a call of FUNCTION takes."
  (let ((start (get-internal-run-time)))
    (funcall function)
    (/ (- (get-internal-run-time) start) internal-time-units-per-second)))

(defun print-times (name knowledge)
  "Print how long it takes to verify KNOWLEDGE: the proof, and all."
  (flet ((prove ()
           (let ((domain (supergrip::make-domain knowledge)))
             (supergrip::prove-rules (supergrip::make-runner knowledge)
                                     (supergrip::find-situations domain))))
         (verify () (supergrip:verify-knowledge knowledge :stream nil)))
    (format t "~a: proved in ~,3f s, verified in ~,1f s~%" name (seconds #'prove)
            (seconds #'verify))))

(let* ((arguments (mapcar #'parse-integer (rest sb-ext:*posix-argv*)))
       (count (or (first arguments) 500))
       (seed (or (second arguments) 1))
       (good (compare-mutants count seed)))
  (print-times "the shipped rules" (shipped-knowledge))
  (print-times (format nil "100 rules, seed ~d" seed) (rule-forms-knowledge (many-rules 100 seed)))
  (sb-ext:exit :code (if good 0 1)))
