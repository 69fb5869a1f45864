;;;; observe.lisp -- a run that is watched: for traces, steps, counts and explanations.
;;;;
;;;; RUN-RULES does not use this, so plans pay nothing for it.

(in-package :supergrip-chainer)

(defun rule-bindings (rule memory)
  "Return all bindings of RULE on MEMORY, face-list, in their order."
  (prefix-bindings rule (length (rule-clauses rule)) memory))

(defun prefix-bindings (rule count memory)
  "Return the bindings that meet the first COUNT clauses of RULE on MEMORY."
  (let ((bindings (memory-bindings memory)) (found (memory-found memory)))
    ;; An action may ask while a run goes through the bindings of its own rule.
    (setf (memory-bindings memory) (copy-seq bindings))
    (prog1 (loop repeat (find-bindings (compile-clauses (subseq (rule-clauses rule) 0 count) '())
                                       memory)
                 for i from 0
                 collect (aref (memory-bindings memory) i))
      (setf (memory-bindings memory) bindings
            (memory-found memory) found))))

(defun run-observed (rulebase memory observer &key (end (length (rulebase-rules rulebase))))
  "Run the first END rules of RULEBASE on MEMORY as RUN-RULES does, and call OBSERVER with

  :RULE rule          before a rule is matched,
  :BINDINGS rule list when its bindings are found,
  :ACTION rule action binding, and a list of what the action added to the log, after each action,
  :STOP stop          when an action ends the run.

Returns the STOP, or NIL."
  (loop for rule across (subseq (rulebase-rules rulebase) 0 end)
        do (funcall observer :rule rule)
           (let ((bindings (rule-bindings rule memory)))
             (funcall observer :bindings rule bindings)
             (dolist (action (rule-actions rule))
               (dolist (binding bindings)
                 (let* ((before (memory-log memory))
                        (stop (funcall (action-function action) memory rule binding)))
                   (funcall observer :action rule action binding
                            (reverse (ldiff (memory-log memory) before)))
                   (when stop
                     (funcall observer :stop stop)
                     (return-from run-observed stop)))))))
  nil)

(defun run-in-order (rules memory perform)
  "Run RULES, a list of rules of one rule base in any order, on MEMORY as RUN-RULES does, but call
PERFORM, a function of a rule, an action and a binding, in place of the function of the action.
Returns what PERFORM returned to end the run, or NIL."
  (declare (type memory memory) (function perform))
  (dolist (rule rules)
    (when (plusp (sbit (memory-awake memory) (rule-index rule)))
      (let ((count (find-bindings (rule-matcher rule) memory)))
        (when (plusp count)
          (dolist (action (rule-actions rule))
            (dotimes (i (if (action-once action) 1 count))
              (let ((stop (funcall perform rule action (aref (memory-bindings memory) i))))
                (when stop
                  (return-from run-in-order stop))))))))))

(defun rule-met-p (rule memory)
  "True if all clauses of RULE are met together on MEMORY, that of a run which has come to a rule."
  (and (plusp (sbit (memory-awake memory) (rule-index rule)))
       (plusp (find-bindings (rule-matcher rule) memory))))

(defun met-clauses (rule memory)
  "Return how many clauses of RULE, from the first on, MEMORY meets together."
  (loop for count downfrom (length (rule-clauses rule)) above 0
        when (prefix-bindings rule count memory) return count
        finally (return 0)))

(defun binding-text (rule binding)
  "Return BINDING of RULE as \"S1 = Z1, S2 = Y2\".  Variables are bound in their order, so those
that are not bound yet are the last."
  (format nil "~{~a = ~a~^, ~}" (loop for name in (rule-variables rule)
                                      for surface in (face-list-names binding)
                                      collect name collect surface)))
