;;;; run.lisp -- the rules run, in order, each once.

(in-package :supergrip-chainer)

(defstruct stop
  "Why a run ended: VERDICT is :CANT, or what another action gives; RULE the rule that ended it;
WORDS what it said, as strings."
  (verdict nil :read-only t) (rule nil :read-only t) (words '() :read-only t))

;;; The log.  An event is one integer: the numbers of the rule and of the action, and the binding
;;; under which the action was done; so everything about it can be told later.

(declaim (inline log-event))
(defun log-event (memory rule action binding)
  "Note in the log of MEMORY that RULE did its action with the number ACTION, under BINDING."
  (declare (type memory memory) (type face-list binding) (type (unsigned-byte 16) action))
  (push (logior binding (ash action 24) (ash (the (unsigned-byte 22) (rule-index rule)) 40))
        (memory-log memory)))

(defun event-rule (event rulebase)
  "Return the rule of EVENT."
  (svref (rulebase-rules rulebase) (ash event -40)))

(defun event-action (event rulebase)
  "Return the action of EVENT."
  (nth (ldb (byte 16 24) event) (rule-actions (event-rule event rulebase))))

(defun event-binding (event)
  "Return the binding of EVENT, a face list."
  (ldb (byte 24 0) event))

(defun event-fact (event rulebase)
  "Return the predicate and the face-list list that EVENT remembered, or NIL."
  (let ((action (event-action event rulebase)))
    (and (action-predicate action)
         (values (action-predicate action)
                 (instantiate (action-terms action) (event-binding event))))))

;;; Running

(defun make-memory (rulebase &optional client)
  "Return an empty memory for the rules of RULEBASE."
  (let ((count (length (rulebase-predicates rulebase))))
    (flet ((face-lists (length)
             (make-array length :element-type '(unsigned-byte 32) :initial-element 0)))
      (%make-memory :relations (make-array count :element-type '(unsigned-byte 64)
                                                 :initial-element 0)
                    :facts (face-lists (* +most-facts+ count))
                    :counts (face-lists count)
                    :used (face-lists count)
                    :awake (copy-seq (rulebase-awake rulebase))
                    :sleepers (rulebase-sleepers rulebase)
                    :bindings (face-lists 16)
                    :client client))))

(defun clear-memory (memory rulebase)
  "Make MEMORY, one for the rules of RULEBASE, empty again.  It takes time for what was remembered,
none for other predicates."
  (declare (type memory memory))
  (dotimes (i (memory-used-count memory))
    (let ((index (aref (memory-used memory) i)))
      (setf (aref (memory-relations memory) index) 0
            (aref (memory-counts memory) index) 0)))
  (replace (memory-awake memory) (rulebase-awake rulebase))
  (setf (memory-used-count memory) 0
        (memory-log memory) '()))

(declaim (inline run-rule))
(defun run-rule (rule memory)
  "Run RULE on MEMORY.  Returns the STOP of the action that ended the run, or NIL."
  (declare (type memory memory))
  (let ((count (find-bindings (rule-matcher rule) memory)))
    (when (plusp count)
      (dolist (action (rule-actions rule))
        (let ((function (action-function action))
              (bindings (memory-bindings memory)))
          (declare (function function))
          (dotimes (i (if (action-once action) 1 count))
            (let ((stop (funcall function memory rule (aref bindings i))))
              (when stop
                (return-from run-rule stop)))))))))

(defun run-rules (rulebase memory)
  "Run the rules of RULEBASE on MEMORY, in order, each once; rules that sleep are passed over.
All bindings of a rule are found first; then its first action is done for all of them (once, if it
is the same for all), then its second.  Returns the STOP of the action that ended the run, or NIL."
  (declare (type memory memory))
  (loop with rules = (rulebase-rules rulebase)
        with awake = (memory-awake memory)
        for index = (position 1 awake) then (position 1 awake :start (1+ index))
        while index
        do (let ((stop (run-rule (svref rules index) memory)))
             (when stop (return stop)))))
