;;;; define-action.lisp -- what an action of a rule is: DEFINE-ACTION, and what a verb tells of
;;;; itself.
;;;;
;;;; REMEMBER and CANT are defined in remember-and-cant.lisp, TRY and KEEP in
;;;; plan/try-and-keep.lisp.

(in-package :supergrip-chainer)

(defstruct action
  "One action of a consequent.  VERB is its first word, a string, OPERANDS the rest of FORM, NUMBER
its place in the rule.  FUNCTION is called with a memory, the rule and a binding; it returns NIL, or
a STOP to end the run.  ONCE is true if no binding after the first makes a difference.  PREDICATE
and TERMS are what it remembers, TARGET what else it names, if anything."
  (verb "" :type string :read-only t) (operands '() :read-only t) (form nil :read-only t)
  (number 0 :type (unsigned-byte 16) :read-only t)
  (function nil :type (or null function) :read-only t) (once nil :read-only t)
  (predicate nil :read-only t) (terms '() :type list :read-only t) (target nil :read-only t))

(defvar *action-verbs* '() "The verbs that DEFINE-ACTION has defined.")

(defun action-verbs ()
  "Return the verbs that actions may begin with, as strings, in the order of their definition."
  *action-verbs*)

(defun finish-action (action function &key once predicate terms target)
  "Return ACTION, which was read, with its FUNCTION, and what else is known of it."
  (make-action :verb (action-verb action) :operands (action-operands action)
               :form (action-form action) :number (action-number action)
               :function function :once once :predicate predicate :terms terms :target target))

(defgeneric compile-action (verb action client)
  (:documentation "Return ACTION, which begins with VERB, a keyword, finished by FINISH-ACTION, or
NIL after complaints.  CLIENT is that of BUILD-RULEBASE.  This is where an action is attached:
DEFINE-ACTION adds a method.")
  (:method (verb action client)
    (declare (ignore client))
    (complain (action-form action) "~a is not an action; actions are ~{~a~^, ~}~a" verb
              (action-verbs) (suggestion verb (action-verbs)))))

;;; What else is known of an action.  By default, as little as can be; a verb adds methods.

(defgeneric action-conclusion (verb operands)
  (:documentation "Return the sentence that an action VERB, a keyword, of OPERANDS remembers, or
NIL.")
  (:method (verb operands)
    (declare (ignore verb operands))
    nil))

(defgeneric action-mentions (verb operands)
  (:documentation "Return the names, symbols, of what an action VERB of OPERANDS uses of the lower
level, as the grasp that it tries.")
  (:method (verb operands)
    (declare (ignore verb operands))
    '()))

(defgeneric action-sees-p (verb action variable)
  (:documentation "True if it makes a difference to ACTION which face VARIABLE has.")
  (:method (verb action variable)
    (declare (ignore verb action variable))
    t))

(defgeneric symmetric-action-p (verb action a b)
  (:documentation "True if ACTION does the same after the variables A and B were exchanged.")
  (:method (verb action a b)
    (or (action-once action)
        (not (or (action-sees-p verb action a) (action-sees-p verb action b))))))

(defgeneric describe-action (verb action)
  (:documentation "Return what ACTION does, in words.")
  (:method (verb action)
    (declare (ignore verb))
    (form-text (action-form action))))

(defun verb-key (verb)
  "Return the keyword that VERB, a name or a string, stands for in the methods above; or VERB itself
if no action has it."
  (or (find-symbol (string verb) :keyword) verb))

(defmacro define-action (verb (action client) &body body)
  "Define the action VERB, a keyword.  BODY checks the ACTION-OPERANDS of ACTION, and returns what
FINISH-ACTION makes of it, or NIL after complaints.  Its function must not keep the memory that it
is called with, which serves other runs, too; and it may be called again when a question about the
run is asked."
  `(progn
     (setf *action-verbs* (with-row ,(symbol-name verb) *action-verbs* #'identity))
     (defmethod compile-action ((verb (eql ,verb)) ,action ,client)
       (declare (ignorable ,client))
       ,@body)))
