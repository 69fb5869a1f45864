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

(defun binding-text (rule binding)
  "Return BINDING of RULE as \"S1 = Z1, S2 = Y2\".  Variables are bound in their order, so those
that are not bound yet are the last."
  (format nil "~{~a = ~a~^, ~}" (loop for name in (rule-variables rule)
                                      for surface in (face-list-names binding)
                                      collect name collect surface)))
