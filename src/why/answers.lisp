;;;; answers.lisp -- what all answers have in common.
;;;;
;;;; Each answer is an object; WRITE-ANSWER prints it.

(in-package :supergrip)

(defparameter +later-plan+
  "The knowledge in force has it, but the plan was made before: call (forward-chain) again."
  "What is said of a name that a plan's knowledge lacks.")

(define-condition no-rule-error (supergrip-error)
  ((name :initarg :name) (known :initarg :known) (hint :initarg :hint :initform nil)
   (kind :initarg :kind :initform "rule or grasp"))
  (:report (lambda (condition stream)
             (with-slots (name known hint kind) condition
               (cond (hint (format stream "~a is ~a" (form-text name) hint))
                     ((null (name-of name))
                      (format stream "~a is not a name: rules and grasps are named by symbols or ~
                                      strings"
                              (form-text name)))
                     (t (format stream "there is no ~a ~a~a; there are ~a~@[~%~a~]" kind
                                (form-text (make-symbol (name-of name)))
                                (suggestion (name-of name) known) (listed known)
                                (and (in-force-p (name-of name)) +later-plan+)))))))
  (:documentation "A question was asked about a name that is neither a rule's nor a grasp's."))

(defstruct explanation "What all answers to a question have in common.")

(defgeneric topic (explanation)
  (:documentation "Return what EXPLANATION is about, a string."))

(defmethod print-object ((explanation explanation) stream)
  (print-unreadable-object (explanation stream :type t)
    (write-string (topic explanation) stream)))

(defun known-names (knowledge)
  "Return the names of the rules and the grasps of KNOWLEDGE."
  (append (mapcar #'rule-name (knowledge-rules knowledge))
          (mapcar #'grasp-name (knowledge-grasps knowledge))))

(defun known-name-p (name knowledge)
  "True if KNOWLEDGE has a rule or a grasp NAME."
  (or (find-rule (knowledge-rulebase knowledge) name)
      (find-grasp (knowledge-graspbase knowledge) name)))

(defun in-force-p (name)
  "True if the knowledge in force has a rule or a grasp NAME."
  (known-name-p name *knowledge*))

(defgeneric write-answer (answer stream)
  (:documentation "Write ANSWER, an explanation, to STREAM in words."))

(defmethod write-answer :around (answer stream)
  (declare (ignorable answer stream))
  (plainly (call-next-method)))

(defun print-answer (object)
  "Print OBJECT, an explanation, and return it."
  (write-answer object *standard-output*)
  (fresh-line)
  object)

(defun plan-rulebase (plan)
  (knowledge-rulebase (plan-knowledge plan)))

(defun fact-text (predicate face-list)
  "Return the sentence of PREDICATE and the faces of FACE-LIST as a list in print."
  (plain-text "(~a~@[ (~{~a~^ ~})~])" (predicate-text predicate) (face-list-names face-list)))

(defun write-indent (stream depth)
  (fresh-line stream)
  (loop repeat depth do (write-string "  " stream)))
