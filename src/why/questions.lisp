;;;; questions.lisp -- HOW and WHY-NOT, as they are typed.  A question that is meant for the other
;;;; is answered by the other.

(in-package :supergrip)

(defun fact-form-p (object)
  "True if OBJECT is a list, or a string that spells one, and no rule or grasp in force."
  (or (and (consp object) (null (name-of object)))
      (and (stringp object) (find #\( object))))

(defun asked-fact (object plan)
  "Return the fact that OBJECT is in a question about PLAN: a list, a string of one, or the one word
of a sentence without faces, if that names no rule or grasp.  NIL if it is none."
  (let* ((name (name-of object))
         (knowledge (plan-knowledge (need-plan plan)))
         (predicate (and name (find-predicate (knowledge-rulebase knowledge) (list name)))))
    (cond ((fact-form-p object) object)
          ((and predicate (zerop (predicate-arity predicate)) (not (known-name-p name knowledge)))
           (list name)))))

(defun print-answers (answers)
  "Print ANSWERS, and return their list, or the only one."
  (mapc #'print-answer answers)
  (if (rest answers) answers (first answers)))

(defun check-one-list (fact arguments)
  "Signal an ARGUMENT-ERROR if ARGUMENTS, those of HOW after the word FACT, are its other parts."
  (labels ((parts (object)
             (if (consp object)
                 (append (parts (car object)) (parts (cdr object)))
                 (and (word-text object) (list (word-text object))))))
    (let ((parts (and (namep fact) (parts arguments))))
      (when parts
        (refuse-argument "a fact is one list: (how '(~a~{ ~a~}~@[ (~{~a~^ ~})~]))" fact
                         (remove-if #'face-index parts) (remove-if-not #'face-index parts))))))

(defun how (fact &rest arguments)
  "(HOW FACT [PLAN]): print and return how FACT, as '(PARALLEL (Y2 Y1)), came to be known in PLAN,
by default *PLAN*: the tree of rules, bindings and facts down to the box; negations as assumed when
they were tested.  Of a FACT with several lists of faces, as ASSERTIONS has them, return the list of
the answers.  Where FACT is the name of a rule or a grasp, the answer is WHY-NOT's."
  (check-one-list fact arguments)
  (let* ((plan (if arguments (pop arguments) (last-plan)))
         (asked (asked-fact fact plan))
         (name (name-of fact)))
    (when arguments
      (refuse-argument "HOW takes a fact and a plan; ~{~a~^, ~} is too much"
                       (mapcar #'form-text arguments)))
    (if (and (null asked) name (known-name-p name (plan-knowledge plan)))
        (print-answer (explain-why-not name nil plan))
        (print-answers (explain-facts (or asked fact) plan)))))

(defun why-not (name &rest arguments)
  "(WHY-NOT NAME [MATCHING] [PLAN]): print and return why the rule NAME did not fire in PLAN, by
default *PLAN*, or why the grasp NAME was not chosen, in MATCHING, six faces, if that is given.
NAME is a symbol or a string; where it is a fact, the answer is HOW's."
  (check-listed arguments 'why-not name)
  (let* ((matching (and arguments (not (plan-p (first arguments))) (pop arguments)))
         (plan (if arguments (pop arguments) (last-plan)))
         (fact (asked-fact name plan)))
    (when arguments
      (refuse-argument "WHY-NOT takes a name, a list of six faces, and a plan; ~{~a~^, ~} is too ~
                        much"
                       (mapcar #'form-text arguments)))
    (if fact
        (let ((answers (explain-facts fact plan)))
          (when (some #'derivation-p answers)
            (format t "That is so; this is how:~%"))
          (print-answers answers))
        (print-answer (explain-why-not name matching plan)))))
