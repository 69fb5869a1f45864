;;;; run.lisp -- the rules run, in order, each once.

(in-package :supergrip-chainer)

(defstruct stop
  "Why a run ended: VERDICT is :CANT, or what another action gives; RULE the rule that ended it;
WORDS what it said, as strings."
  verdict rule words)

;;; The log.  An event is one integer: the numbers of the rule and of the action, and the binding
;;; under which the action was done; so everything about it can be told later.

(declaim (inline log-event))
(defun log-event (memory rule action binding)
  "Note in the log of MEMORY that RULE did its ACTION, a number, under BINDING."
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
            (let ((stop (funcall function memory (aref bindings i))))
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

;;; The two actions of a standard chainer

(defun action-number (action)
  "Return the place of ACTION, being compiled, in its rule."
  (position (action-form action) (rest (fourth (rule-form *rule*))) :test #'eq))

(defun negation-in (words)
  (find-if (lambda (word) (or (name= word "NO") (name= word "NOT"))) words))

(define-action :remember (action rulebase)
  (if (negation-in (action-operands action))
      (complain (action-form action)
                "a negation can't be remembered: what is not remembered is false")
      (multiple-value-bind (predicate terms)
          (parse-sentence (action-operands action) (action-form action) nil)
        (when predicate
          (setf (action-predicate action) predicate
                (action-terms action) terms
                (action-once action) (notany #'term-variable-p terms)
                (action-function action)
                (remember-function predicate terms (action-number action)))))))

(defmethod action-conclusion ((verb (eql :remember)) operands)
  operands)

(defmethod symmetric-action-p ((verb (eql :remember)) action a b)
  ;; A list of surfaces is unordered.
  (or (action-once action)
      (eq (null (member a (action-terms action))) (null (member b (action-terms action))))))

(defmethod describe-action ((verb (eql :remember)) action)
  (format nil "remember that ~a" (sentence-text (predicate-text (action-predicate action))
                                                (find-if #'consp (action-operands action)))))

(defun remember-function (predicate terms number)
  "Return the function of the action NUMBER of the rule being read, which remembers PREDICATE of
TERMS."
  (let ((rule *rule*)
        (arity (predicate-arity predicate))
        (variables (loop for place below (length (rule-variables *rule*)) collect place)))
    (flet ((put (memory face-list binding)
             (when (put-fact memory predicate face-list)
               (log-event memory rule number binding))
             nil))
      (declare (inline put))
      (if (equal terms variables)
          ;; As often: what to remember is the binding itself.
          (lambda (memory binding)
            (put memory binding binding))
          (lambda (memory binding)
            (let ((face-list (instantiate terms binding)))
              ;; A variable may have taken a face that the action names: no list of distinct
              ;; faces, and nothing to remember.
              (when (= (face-list-count face-list) arity)
                (put memory face-list binding))))))))

(define-action :cant (action rulebase)
  (let ((words (action-operands action)))
    (if (or (null words) (notevery #'namep words))
        (complain (action-form action) "CANT needs words after it that say why")
        (let ((stop (make-stop :verdict :cant :rule *rule* :words (mapcar #'symbol-name words))))
          (setf (action-function action)
                (lambda (memory binding)
                  (declare (ignore memory binding))
                  stop))))))

(defmethod describe-action ((verb (eql :cant)) action)
  (format nil "stop: can't ~{~a~^ ~}" (action-operands action)))
