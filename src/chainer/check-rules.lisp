;;;; check-rules.lisp -- warnings: what is well formed in a rule base, but almost certainly a
;;;; mistake.
;;;;
;;;; A misspelt predicate is not an error to a chainer: under the closed-world assumption it is just
;;;; never true.  So every sentence is followed from the rules that derive it to those that test it.
;;;; This works on the forms, so an error in one rule causes no warning in another.

(in-package :supergrip-chainer)

(defstruct (use (:constructor make-use (rule name place words surfaces form negated)))
  "A sentence in a rule: the number and the NAME of the RULE, the PLACE in it (\"clause 2\"), its
WORDS and its SURFACES, sorted, each as one text."
  rule name place words surfaces form negated)

(defun sentence-use (sentence form number name place)
  "Return the use of SENTENCE, a list of words, in FORM, or NIL if it is not well formed."
  (let* ((list (find-if #'consp sentence))
         (names (remove-if-not #'namep sentence))
         (words (mapcar #'symbol-name (remove-if #'negation-p names))))
    (and words
         (notany #'loose-surface-p names)
         (make-use number name place (words-text words)
                   (words-text (sort (mapcar #'form-text list) #'string<))
                   form (some #'negation-p names)))))

(defun rule-uses (form number)
  "Return the sentences that the rule FORM tests, and those that it remembers."
  (let ((name (and (namep (second form)) (symbol-name (second form)))))
    (flet ((uses (key label sentence-of)
             (loop for part in (rest (find-if (lambda (part) (part-p part key)) form))
                   for k from 1
                   for sentence = (and (consp part) (listp (cdr (last part)))
                                       (funcall sentence-of part))
                   for use = (and sentence (sentence-use sentence part number name
                                                         (format nil "~a ~d" label k)))
                   when use collect use)))
      (values (uses "IF" "clause" #'identity)
              (uses "THEN" "action" (lambda (action)
                                      (and (namep (first action))
                                           (action-conclusion (verb-key (first action))
                                                              (rest action)))))))))

(defun collect-uses (forms)
  "Return all tests and all conclusions of the rules FORMS."
  (let ((tests '()) (conclusions '()))
    (loop for form in forms
          for number from 0
          when (part-p form "RULE")
            do (multiple-value-bind (tested remembered) (rule-uses form number)
                 (setf tests (revappend tested tests)
                       conclusions (revappend remembered conclusions))))
    (values (reverse tests) (reverse conclusions))))

(defun tested-sentences (forms)
  "Return what the rules FORMS test: a list of (RULE WORDS CLAUSE), the name of a rule, the words of
a clause as one text, and its form."
  (loop for use in (collect-uses forms)
        collect (list (use-name use) (use-words use) (use-form use))))

(defstruct (sources (:constructor make-sources (given derivers names)))
  "Where sentences come from: tables from the words of one to true if it is GIVEN, an input, and to
the conclusions that are its DERIVERS, a list of the first and, in order, of all that CHECK-ORDER
has not passed yet; and the NAMES of all."
  given derivers names)

(defun collect-sources (conclusions inputs)
  "Return the sources that CONCLUSIONS and INPUTS are."
  (let ((given (make-hash-table :test #'equal))
        (derivers (make-hash-table :test #'equal))
        (names '()))
    (loop for (words) in inputs
          do (setf (gethash (words-text words) given) t)
             (push (words-text words) names))
    (dolist (use (reverse conclusions))
      (push use (gethash (use-words use) derivers)))
    (loop for words being the hash-keys of derivers using (hash-value uses)
          do (setf (gethash words derivers) (cons (first uses) uses))
             (unless (gethash words given) (push words names)))
    (make-sources given derivers (sort names #'string<))))

(defun provided-p (words sources)
  (or (gethash words (sources-given sources)) (gethash words (sources-derivers sources))))

(defmacro about-use ((use) &body body)
  `(let ((*subject* (format nil "RULE ~a" (use-name ,use)))
         (*place* (use-place ,use)))
     ,@body))

(defun check-provided (test sources)
  "Warn if nothing provides what TEST tests.  Returns true if so."
  (unless (provided-p (use-words test) sources)
    (about-use (test)
      (let ((close (suggestion (use-words test) (sources-names sources))))
        (complain (use-form test)
                  '(:warning "nothing provides ~a~a, so ~:[the rule can never fire~;this always ~
                              holds~]~@[; if a box is to say it, add ~a~]")
                  (use-words test) close (use-negated test)
                  (and (string= close "")
                       (input-line (use-words test)
                                   (length (find-if #'consp (use-form test))))))))
    t))

(defun check-order (test sources)
  "Warn if TEST comes before a rule that derives what it tests.  Tests are checked in order."
  (let* ((derivers (gethash (use-words test) (sources-derivers sources)))
         (later (first (loop while (and (rest derivers)
                                        (<= (use-rule (second derivers)) (use-rule test)))
                             do (pop (rest derivers))
                             finally (return (rest derivers))))))
    (when later
      (about-use (test)
        (complain (use-form test)
                  '(:warning "~:[~;the absence of ~]~a is tested here, but ~:[~;also ~]RULE ~a, ~
                              which derives it, comes later; rules run in order, each once")
                  (use-negated test) (use-words test)
                  (or (gethash (use-words test) (sources-given sources))
                      (< (use-rule (first derivers)) (use-rule test)))
                  (use-name later))))))

(defun check-contradictions (tests)
  "Warn if TESTS hold a sentence and its negation in one rule."
  (let ((firsts (make-hash-table :test #'equal)))
    (flet ((key (test negated)
             (format nil "~d ~:[~;NOT ~]~a (~a)" (use-rule test) negated (use-words test)
                     (use-surfaces test))))
      (dolist (test tests)
        (let ((contrary (gethash (key test (not (use-negated test))) firsts))
              (own (key test (use-negated test))))
          (when contrary
            (about-use (test)
              (complain (use-form test)
                        '(:warning "this contradicts ~a, so the rule can never fire")
                        (use-place contrary))))
          (unless (gethash own firsts)
            (setf (gethash own firsts) test)))))))

(defun check-rules (forms inputs)
  "Warn of what can't be meant in FORMS, the rules of a file in their order (see WITH-PROBLEMS).
INPUTS are the predicates that the input always provides, as in BUILD-RULEBASE."
  (multiple-value-bind (tests conclusions) (collect-uses forms)
    (let* ((declared (input-uses forms inputs))
           (provided (loop for use in declared collect (list (list (use-words use)))))
           (sources (collect-sources conclusions (append inputs provided)))
           (tested (tested-words tests)))
      (dolist (test tests)
        (or (check-provided test sources)
            (check-order test sources)))
      (check-contradictions tests)
      (check-unused conclusions tested sources)
      (check-untested declared tested))))

(defun tested-words (tests)
  "Return a table of the words of TESTS."
  (let ((tested (make-hash-table :test #'equal)))
    (dolist (test tests tested)
      (setf (gethash (use-words test) tested) t))))

(defun input-uses (forms inputs)
  "Return the sentences that the (INPUT ...) forms among FORMS declare, without those of INPUTS."
  (loop with given = (loop for (words) in inputs collect (words-text words))
        for form in (remove-if-not #'input-form-p forms)
        for use = (sentence-use (rest form) form nil (input-subject form) nil)
        when (and use (not (member (use-words use) given :test #'string=))) collect use))

(defun check-untested (declared tested)
  "Warn of what is DECLARED, uses, and not among the words TESTED."
  (dolist (use declared)
    (unless (or (refused-p (use-name use)) (gethash (use-words use) tested))
      (let ((*subject* (use-name use)) (*place* nil))
        (complain (use-form use) '(:warning "no rule tests it"))))))

(defun check-unused (conclusions tested sources)
  "Warn of CONCLUSIONS that are not among the words TESTED and look like something known that is."
  (let ((texts (sort (loop for words being the hash-keys of tested
                           when (provided-p words sources) collect words)
                     #'string<)))
    (dolist (conclusion conclusions)
      (unless (gethash (use-words conclusion) tested)
        (let ((close (suggestion (use-words conclusion) texts)))
          (unless (string= close "")
            (about-use (conclusion)
              (complain (use-form conclusion) '(:warning "no rule tests ~a~a")
                        (use-words conclusion) close))))))))
