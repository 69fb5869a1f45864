;;;; read-rules.lisp -- what a rule is; its clauses and actions are read, and checked.

(in-package :supergrip-chainer)

(defstruct clause
  "One clause of an antecedent.  TERMS are variables and faces (see TERM-VALUE)."
  (negated nil :read-only t) (predicate nil :read-only t) (terms '() :type list :read-only t)
  (form nil :read-only t))

(defstruct rule
  "A rule.  COMMENT is the list of the lines before it in its file.  VARIABLES are the names of its
variables; the place of one is its number."
  (name nil :read-only t) (form nil :read-only t)
  (comment '() :read-only t)
  (index 0 :type fixnum :read-only t)
  (variables '() :type list :read-only t)
  (clauses '() :type list :read-only t)
  (actions '() :type list :read-only t)
  (matcher nil :type function :read-only t))

(define-printing (rule rule) "~a" (rule-name rule))

(defstruct (rulebase (:constructor %make-rulebase (rules predicates awake sleepers table)))
  "Ordered rules and the predicates that they speak of, in a vector and in a table by their words.
AWAKE and SLEEPERS are what SLEEPING-RULES returns."
  (rules #() :type simple-vector :read-only t)
  (predicates #() :type simple-vector :read-only t)
  (awake #* :type simple-bit-vector :read-only t)
  (sleepers #() :type simple-vector :read-only t)
  (table nil :type hash-table :read-only t))

(define-printing (rulebase rulebase) "~d rule~:p" (length (rulebase-rules rulebase)))

(defun find-rule (rulebase name)
  "Return the rule of RULEBASE that has NAME, or NIL."
  (find name (rulebase-rules rulebase) :key #'rule-name :test #'string-equal))

(defun find-predicate (rulebase words)
  "Return the predicate of RULEBASE that has WORDS, a list of strings, or NIL."
  (gethash (words-text words) (rulebase-table rulebase)))

(defun words-text (words)
  "Return WORDS, a list of strings, as one.  As a key it is hashed wholly; of a list only the first
elements would be."
  (with-output-to-string (out)
    (loop for (word . rest) on words
          do (write-string word out)
             (when rest (write-char #\Space out)))))

;;; Terms: a variable is its number, 0 to 5; a face f is the number -1-f.

(declaim (inline term-variable-p term-value instantiate))
(defun term-variable-p (term)
  "True if TERM is a variable, not a face."
  (declare (fixnum term))
  (>= term 0))

(defun term-value (term binding)
  "Return the face that TERM stands for under BINDING, a face list."
  (declare (type (integer -6 5) term) (type face-list binding))
  (if (term-variable-p term)
      (face-list-ref binding term)
      (- -1 term)))

(defun instantiate (terms binding)
  "Return TERMS under BINDING, face-list in the order of TERMS."
  (let ((face-list 0))
    (declare (type face-list face-list))
    (loop for term in terms
          for place of-type (integer 0 6) from 0
          do (setf face-list (face-list-with face-list place (term-value term binding))))
    face-list))

;;; Sentences

(defvar *predicates*)
(setf (documentation '*predicates* 'variable)
      "The predicates of the rule base being read: a table by their words (see WORDS-TEXT).")
(defvar *client*)
(setf (documentation '*client* 'variable) "What the actions being read are compiled against.")
(defvar *variables*)
(setf (documentation '*variables* 'variable) "The names of the variables of the rule being read.")

(defvar *clause-failed* nil "True if a clause of the rule being read is wrong.")

(defun variable-name-p (name)
  (and (namep name)
       (char= (char (symbol-name name) 0) #\S)
       (> (length (symbol-name name)) 1)))

(defun intern-variable (name bind form)
  "Return the number of the variable NAME; new ones are allowed if BIND is true."
  (or (position (symbol-name name) *variables* :test #'string=)
      (cond ((not (or bind *clause-failed*)) ; it may stand in the clause that is wrong
             (complain form "the variable ~a occurs in no clause of IF" name))
            ((= (length *variables*) 6)
             (complain form "more than six variables: a box has six surfaces"))
            (t
             (setf *variables* (append *variables* (list (symbol-name name))))
             (1- (length *variables*))))))

(defun parse-surface (element bind form)
  "Return the term that ELEMENT of the list FORM stands for, or NIL after a complaint."
  (cond ((not (namep element))
         (complain form "~a is not a surface" (form-text element)))
        ((face-index element) (- -1 (face-index element)))
        ((variable-name-p element) (intern-variable element bind form))
        (t (complain form "~a is neither a surface (X1 to Z2) nor a variable ~
                           (a name that begins with S, as S1)" element))))

(defun parse-surfaces (list bind)
  "Return the terms of LIST, distinct surfaces and variables.  Variables that the rule does not
have yet are allowed if BIND is true.  Complains, and returns NIL and true, of anything else."
  (let ((terms (loop for element in list collect (parse-surface element bind list))))
    (cond ((member nil terms) (values nil t))
          ((/= (length terms) (length (remove-duplicates terms)))
           (complain list "the same surface twice in ~a: lists of surfaces hold distinct ones"
                     (form-text list))
           (values nil t))
          (t (values terms nil)))))

(defun intern-predicate (words arity form &key given)
  "Return the predicate of WORDS, made if it is new, with lists of ARITY surfaces."
  (let* ((key (words-text words))
         (predicate (gethash key *predicates*)))
    (cond ((null predicate)
           (setf (gethash key *predicates*)
                 (make-predicate :words words :arity arity :given given
                                 :index (hash-table-count *predicates*))))
          ((/= arity (predicate-arity predicate))
           (complain form "~a takes ~[no list of surfaces~;1 surface~:;~:*~d surfaces~]~@[, as ~a ~
                           says~]; here it has ~[none~:;~:*~d~]"
                     (predicate-text predicate) (predicate-arity predicate)
                     (and (declared-p predicate)
                          (form-text (input-declaration-form (predicate-given predicate))))
                     arity))
          (t predicate))))

(defun loose-surface-p (name)
  "True if NAME, a word of a sentence, can only be meant as a surface: X1 to Z2, S1 and so on."
  (and (namep name)
       (or (face-index name)
           (and (variable-name-p name) (every #'digit-char-p (subseq (symbol-name name) 1))))))

(defun list-surfaces (words &optional list)
  "Return the sentence WORDS, those that are surfaces put into a list at its end, before LIST."
  (append (remove-if #'loose-surface-p words)
          (list (append (remove-if-not #'loose-surface-p words) list))))

(defun parse-sentence (words form bind &optional given)
  "Return the predicate and the terms of the sentence WORDS, the words of FORM that matter: names,
the last perhaps a list of surfaces.  GIVEN is that of a predicate made here.  Returns NIL after a
complaint."
  (let* ((last (first (last words)))
         (list (and (consp last) last))
         (names (if list (butlast words) words)))
    (cond ((null names)
           (complain form "an empty sentence"))
          ((find-if #'loose-surface-p names)
           (complain form "surfaces go in a list of their own, at the end: ~a"
                     (form-text (list-surfaces names list))))
          ((some (lambda (name) (not (namep name))) names)
           (complain form "~a: a sentence is made of words, and may end in one list of surfaces"
                     (form-text form)))
          (t
           (multiple-value-bind (terms bad) (if list (parse-surfaces list bind) '())
             (unless bad
               (let ((predicate (intern-predicate (mapcar #'symbol-name names) (length terms) form
                                                  :given given)))
                 (and predicate (values predicate terms)))))))))

(defun negation-p (word)
  "True if WORD, a part of a sentence, negates it, wherever it stands."
  (or (name= word "NO") (name= word "NOT")))

(defun parse-clause (form number)
  "Return the clause that FORM spells, or NIL after a complaint."
  (declare (ignore number))
  (cond ((not (consp form))
         (complain form "~a is not a clause: a clause is a list" (form-text form)))
        ((and (name= (first form) "NOT") (consp (second form)) (name= (first (second form)) "NOT"))
         (complain form "NOT inside NOT"))
        ((and (name= (first form) "NOT") (consp (second form)) (namep (first (second form))))
         (if (surface-list-p (second form))
             (complain form "NOT ~a names no predicate" (form-text (second form)))
             (complain form "write (NOT ~{~a~^ ~}): NOT stands before the words, without a list ~
                             of its own" (mapcar #'form-text (second form)))))
        ((> (count-if #'negation-p form) 1)
         (complain form "~a is negated twice" (form-text form)))
        (t
         (multiple-value-bind (predicate terms)
             (parse-sentence (remove-if #'negation-p form) form t)
           (and predicate
                (make-clause :negated (some #'negation-p form) :predicate predicate
                             :terms terms :form form))))))

(defun sentence-text (words surfaces)
  "Return a sentence in words: \"S1 and S2 are PARALLEL\", \"OBJECT HAS FREE CORNERS\"."
  (if surfaces
      (format nil "~{~a~#[~; and ~:;, ~]~} ~:[is~;are~] ~a" surfaces (rest surfaces) words)
      words))

(defun surface-list-p (list)
  (every (lambda (element) (and (namep element)
                                (or (face-index element) (variable-name-p element))))
         list))

;;; Actions

(defun parse-action (form number)
  "Return the action that FORM, at the place NUMBER of its rule, spells, or NIL after a complaint."
  (if (not (and (consp form) (namep (first form))))
      (complain form "~a is not an action: an action is a list that begins with ~{~a~^, ~}"
                (form-text form) (action-verbs))
      (compile-action (verb-key (first form))
                      (make-action :verb (symbol-name (first form)) :operands (rest form)
                                   :form form :number number)
                      *client*)))
