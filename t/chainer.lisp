;;;; chainer.lisp -- rules without grasps: matching, negation, order, and all that is wrong with a
;;;; rule.

(in-package :supergrip-test)
(define-suite chainer
  "Rules without grasps: matching, negation, order, and all that is wrong with a rule.")

(defun rule-forms (text)
  (supergrip-data:read-all (supergrip-data:string-source text)))

(defparameter *inputs* '((("OPPOSED") 2) (("SMALL") 2) (("CONSTRAINED") 1) (("SLIPPERY") 0)))

(defun build (text)
  "Return the rule base of TEXT and the reports of what is wrong with it."
  (multiple-value-bind (rulebase problems)
      (supergrip-data:with-problems
        (supergrip-chainer:build-rulebase (rule-forms text) *inputs*))
    (values rulebase (mapcar #'princ-to-string problems))))

(defun run-text (text facts)
  "Run the rules of TEXT on FACTS, a list of (WORD FACE...).
Returns what the rules said, a list of strings, and the stop."
  (multiple-value-bind (rulebase problems) (build text)
    (assert (null problems) () "~{~a~%~}" problems)
    (run-on-facts rulebase (supergrip-chainer:make-memory rulebase) facts)))

(defun run-on-facts (rulebase memory facts)
  "Run RULEBASE on MEMORY, an empty one, and FACTS.  Returns what RUN-TEXT does."
  (loop for (word . faces) in facts
        do (supergrip-chainer:remember
            memory
            (supergrip-chainer:find-predicate rulebase (list (symbol-name word)))
            (supergrip-chainer:make-face-list (mapcar #'supergrip-chainer:face-index faces))))
  (let ((stop (supergrip-chainer:run-rules rulebase memory)))
    (values (loop for event in (reverse (supergrip-chainer:memory-log memory))
                  collect (event-text event rulebase))
            stop)))

(defparameter *pairs* '((opposed z2 z1) (opposed y2 y1) (opposed x2 x1)))

(test surfaces-pack
  (is (equal '("Z2" "X1" "Y1")
             (supergrip-chainer:face-list-names
              (supergrip-chainer:make-face-list (mapcar #'supergrip-chainer:face-index
                                                        '(z2 x1 y1))))))
  (is (equal '("Z2" "Z1" "Y2" "Y1" "X2" "X1")
             (supergrip-chainer:face-list-names (supergrip-chainer:make-face-list '(0 1 2 3 4 5)))))
  (loop for (name axis sign) in '((x1 0 1) (x2 0 -1) (y1 1 1) (y2 1 -1) (z1 2 1) (z2 2 -1))
        for face = (supergrip-chainer:face-index name)
        do (is (= axis (supergrip-chainer:face-axis face)))
           (is (= sign (supergrip-chainer:face-sign face)))
           (is (= axis (supergrip-chainer:face-axis (supergrip-chainer:opposite face))))
           (is (/= face (supergrip-chainer:opposite face)))))

(test facts-are-matched-in-order-and-in-all-orders
  (is (equal '("R: P Z2" "R: P Z1" "R: P Y2" "R: P Y1" "R: P X2" "R: P X1")
             (run-text "(RULE R (IF (OPPOSED (s1 s2))) (THEN (REMEMBER P (s1))))" *pairs*)))
  (is (equal '("A: T Z2 Y2 X2" "B: Q Z2 Y2" "B: Q Z2 X2" "B: Q Y2 X2")
             (run-text "(RULE A (IF (OPPOSED (Z2 s2))) (THEN (REMEMBER T (Z2 Y2 X2))))
                        (RULE B (IF (T (s1 s2 s3))) (THEN (REMEMBER Q (s1 s2)) (REMEMBER Q (s2 s1))))"
                       *pairs*))
      "unordered facts are said once")
  (is (equal '("A: T Z2 Y2 X2" "B: FIRST Y2" "B: FIRST X2" "B: FIRST Z2")
             (run-text "(RULE A (IF (OPPOSED (Z2 s2))) (THEN (REMEMBER T (Z2 Y2 X2))))
                        (RULE B (IF (T (s1 s2 s3))) (THEN (REMEMBER FIRST (s2))))"
                       *pairs*))
      "the orders of a list of three: by the places in which they are stored"))

(test all-bindings-first-then-action-by-action
  (is (equal '("R: P Z2" "R: P Z1" "R: P Y2" "R: P Y1" "R: P X2" "R: P X1" "R: DONE")
             (run-text "(RULE R (IF (OPPOSED (s1 s2))) (THEN (REMEMBER P (s1)) (REMEMBER DONE)))"
                       *pairs*)))
  (is (equal '("R: CONSTRAINED Y1" "R: CONSTRAINED Y2")
             (run-text "(RULE R (IF (OPPOSED (s1 s2)) (NOT CONSTRAINED (s1)) (SMALL (s1 s2)))
                              (THEN (REMEMBER CONSTRAINED (s2))))"
                       (append *pairs* '((small y1 y2)))))
      "what an action remembers does not change the bindings of its own rule"))

(test negation-is-absence
  (is (equal '("R: FREE Z1" "R: FREE X1")
             (run-text "(RULE R (IF (OPPOSED (s1 s2)) (CONSTRAINED (s1)) (NOT CONSTRAINED (s2)))
                              (THEN (REMEMBER FREE (s2))))"
                       (append *pairs* '((constrained z2) (constrained x2) (constrained y1)
                                         (constrained y2))))))
  (is (equal '("A: OBJECT HAS X" "C: YES")
             (run-text "(RULE A (IF (OBJECT HAS NO X)) (THEN (REMEMBER OBJECT HAS X)))
                        (RULE B (IF (OBJECT HAS NO X)) (THEN (REMEMBER NEVER)))
                        (RULE C (IF (OBJECT HAS X)) (THEN (REMEMBER YES)))
                        (RULE D (IF (NOT OBJECT HAS X)) (THEN (REMEMBER NEVER)))"
                       '()))
      "rules run in order, each once"))

(test negation-binds-over-the-faces
  (is (equal '("R: FREE Z1" "R: FREE Y2" "R: FREE Y1" "R: FREE X2" "R: FREE X1")
             (run-text "(RULE R (IF (NOT CONSTRAINED (s1))) (THEN (REMEMBER FREE (s1))))"
                       '((constrained z2)))))
  (is (= 12 (length (run-text "(RULE R (IF (NOT OPPOSED (s1 s2))) (THEN (REMEMBER EDGE (s1 s2))))"
                              *pairs*)))
      "a box has twelve edges")
  (is (equal '("R: EDGE Z1 Y2" "R: EDGE Z1 Y1" "R: EDGE Z1 X2" "R: EDGE Z1 X1")
             (run-text "(RULE R (IF (NOT OPPOSED (Z1 s1))) (THEN (REMEMBER EDGE (Z1 s1))))"
                       *pairs*))
      "a list holds distinct surfaces, constants too"))

(test distinct-variables-bind-distinct-surfaces
  (is (null (run-text "(RULE R (IF (CONSTRAINED (s1)) (CONSTRAINED (s2))) (THEN (REMEMBER TWO)))"
                      '((constrained z2)))))
  (is (equal '("R: TWO")
             (run-text "(RULE R (IF (CONSTRAINED (s1)) (CONSTRAINED (s2))) (THEN (REMEMBER TWO)))"
                       '((constrained z2) (constrained x1))))))

(defparameter *sleepers*
  "(RULE A (IF (SMALL (s1 s2)) (CONSTRAINED (s1))) (THEN (REMEMBER P (s2))))
   (RULE B (IF (P (s1)) (OPPOSED (s1 s2))) (THEN (REMEMBER Q (s1 s2))))
   (RULE C (IF (Q (s1 s2)) (P (s1)) (OPPOSED (s1 s2))) (THEN (REMEMBER R)))
   (RULE D (IF (R)) (THEN (REMEMBER S)))
   (RULE E (IF (NOT R)) (THEN (REMEMBER T)))
   (RULE F (IF (OPPOSED (s1 s2)) (NOT SMALL (s1 s2))) (THEN (REMEMBER U (s1 s2))))"
  "Rules some of which wake others.")

(defun awake-rules (memory rulebase)
  (loop for rule across (supergrip-chainer:rulebase-rules rulebase)
        for bit across (supergrip-chainer::memory-awake memory)
        when (= bit 1) collect (supergrip-chainer:rule-name rule)))

(test rules-sleep-until-what-they-ask-for-is-known
  (let* ((rulebase (build *sleepers*))
         (memory (supergrip-chainer:make-memory rulebase)))
    (is (equal '("E") (awake-rules memory rulebase)) "it asks for nothing that must be there")
    (is (equal '("E: T" "F: U Z2 Z1" "F: U Y2 Y1" "F: U X2 X1")
               (run-on-facts rulebase memory *pairs*)))
    (is (equal '("E" "F") (awake-rules memory rulebase))
        "each watches what fewest ask for, not OPPOSED")
    (supergrip-chainer:clear-memory memory rulebase)
    (is (equal '("E") (awake-rules memory rulebase)))))

(test a-cleared-memory-is-as-a-new-one
  (let* ((rulebase (build *sleepers*))
         (used (supergrip-chainer:make-memory rulebase))
         (inputs (list (append *pairs* '((small y2 y1) (constrained y2)))
                       *pairs*
                       (append *pairs* '((small x2 x1) (constrained x1)))
                       (append *pairs* '((constrained x1)))
                       '())))
    (dolist (facts inputs)
      (let ((new (supergrip-chainer:make-memory rulebase)))
        (is (equal (run-on-facts rulebase new facts) (run-on-facts rulebase used facts)))
        (loop for predicate across (supergrip-chainer:rulebase-predicates rulebase)
              do (is (equal (supergrip-chainer:facts new predicate)
                            (supergrip-chainer:facts used predicate)))))
      (supergrip-chainer:clear-memory used rulebase))))

(test cant-ends-the-run
  (multiple-value-bind (said stop)
      (run-text "(RULE A (IF (SLIPPERY)) (THEN (REMEMBER SEEN) (CANT GRASP IT)
                                               (REMEMBER NEVER)))
                 (RULE B (IF (SEEN)) (THEN (REMEMBER NEVER)))"
                '((slippery)))
    (is (equal '("A: SEEN") said))
    (is (eq :cant (supergrip-chainer:stop-verdict stop)))
    (is (equal '("GRASP" "IT") (supergrip-chainer:stop-words stop)))
    (is (equal "A" (supergrip-chainer:rule-name (supergrip-chainer:stop-rule stop))))))

(supergrip-chainer:define-action :shout (action client)
  (supergrip-chainer:finish-action action (lambda (memory rule binding)
                                            (declare (ignore memory rule binding))
                                            (supergrip-chainer:make-stop :verdict :shouted))))

;; The reports of other tests list the verbs that ship.
(setf supergrip-chainer::*action-verbs* (remove "SHOUT" (supergrip-chainer:action-verbs)
                                                :test #'string=))

(defvar *asked* '() "What the action ASK was told.")

(supergrip-chainer:define-action :ask (action client)
  ;; Asks for the bindings of the rule while it runs, and notes how often it is called.
  (supergrip-chainer:finish-action
   action
   (lambda (memory rule binding)
     (declare (ignore binding))
     (push (length (supergrip-chainer:rule-bindings rule memory)) *asked*)
     nil)))

(setf supergrip-chainer::*action-verbs* (remove "ASK" (supergrip-chainer:action-verbs)
                                                :test #'string=))

(test an-action-may-ask-and-is-called-for-every-binding
  (let ((*asked* '()))
    (is (= 3 (length (run-text "(RULE A (IF (OPPOSED (s1 s2))) (THEN (ASK) (REMEMBER P (s1 s2))))"
                               *pairs*))))
    (is (equal '(6 6 6 6 6 6) *asked*))))

(test rules-may-have-many-actions
  (let ((said (run-text (format nil "(RULE A (IF (SLIPPERY)) (THEN~{ (REMEMBER P~d)~}))"
                                (loop for i below 1000 collect i))
                        '((slippery)))))
    (is (= 1000 (length said)))
    (is (equal "A: P999" (first (last said))))))

(test what-is-remembered-has-its-arity
  (let* ((rulebase (build "(RULE A (IF (OPPOSED (s1 s2))) (THEN (REMEMBER P)))"))
         (memory (supergrip-chainer:make-memory rulebase)))
    (signals error
      (supergrip-chainer:remember memory (supergrip-chainer:find-predicate rulebase '("OPPOSED"))
                                  (supergrip-chainer:make-face-list '(0))))))

(test saved-facts-are-restored
  (let* ((rulebase (build *sleepers*))
         (memory (supergrip-chainer:make-memory rulebase))
         (other (supergrip-chainer:make-memory rulebase))
         (predicates (supergrip-chainer:rulebase-predicates rulebase)))
    (run-on-facts rulebase memory (append *pairs* '((small y2 y1) (constrained y2))))
    (supergrip-chainer:restore-facts other predicates (supergrip-chainer:save-facts memory))
    (is (equal (supergrip-chainer:assertions memory predicates)
               (supergrip-chainer:assertions other predicates)))))

(test a-new-action-is-attached-from-outside
  (is (eq :shouted (supergrip-chainer:stop-verdict
                    (nth-value 1 (run-text "(RULE A (IF (SLIPPERY)) (THEN (SHOUT)))"
                                           '((slippery))))))))

(test wrong-rules-are-refused
  (loop for (text report) in
        '(("(RULE)" "RULE without a name: a rule is (RULE name (IF clause...) (THEN action...))")
          ("(RULE A (IF (P)))" "RULE A: a rule is (RULE name (IF clause...) (THEN action...))")
          ("(RULE A (IF) (THEN (REMEMBER P)))" "RULE A: IF has no clause")
          ("(RULE A (IF (SLIPPERY)) (THEN))" "RULE A: THEN has no action")
          ("(RULE A (IF SLIPPERY) (THEN (REMEMBER P)))"
           "RULE A, clause 1: SLIPPERY is not a clause: a clause is a list")
          ("(RULE A (IF (SMALL (s1 s2))) (THEN (REMEMBER P (s3))))"
           "RULE A, action 1: the variable S3 occurs in no clause of IF")
          ("(RULE A (IF (SMALL (s1))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: SMALL takes 2 surfaces; here it has 1")
          ("(RULE A (IF (SMALL)) (THEN (REMEMBER P)))"
           "RULE A, clause 1: SMALL takes 2 surfaces; here it has none")
          ("(RULE A (IF (SMALL (s1 s1))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: the same surface twice in (S1 S1): lists of surfaces hold distinct ones")
          ("(RULE A (IF (CONSTRAINED (Z3))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: Z3 is neither a surface (X1 to Z2) nor a variable (a name that begins with S, as S1)")
          ("(RULE A (IF (NOT NO SLIPPERY)) (THEN (REMEMBER P)))"
           "RULE A, clause 1: (NOT NO SLIPPERY) is negated twice")
          ("(RULE A (IF (NOT (SMALL (s1 s2)))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: write (NOT SMALL (S1 S2)): NOT stands before the words, without a list of its own")
          ("(RULE A (IF (NOT (NOT SLIPPERY))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: NOT inside NOT")
          ("(RULE A (IF (NOT (s1 s2))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: NOT (S1 S2) names no predicate")
          ("(RULE A (IF (SLIPPERY)) (THEN (REMEMBER NOT P)))"
           "RULE A, action 1: a negation can't be remembered: what is not remembered is false")
          ("(RULE A (IF (SLIPPERY)) (THEN (REMEMBER OBJECT HAS NO P)))"
           "RULE A, action 1: a negation can't be remembered: what is not remembered is false")
          ("(RULE A (IF (SLIPPERY)) (THEN (REMEBMER P)))"
           "RULE A, action 1: REMEBMER is not an action; actions are REMEMBER, CANT")
          ("(RULE A (IF (SLIPPERY)) (THEN (CANT)))"
           "RULE A, action 1: CANT needs words after it that say why")
          ("(RULE A (IF (SLIPPERY)) (THEN (REMEMBER P)))
            (RULE A (IF (SLIPPERY)) (THEN (REMEMBER P)))"
           "RULE A: an earlier rule has this name"))
        do (let ((reports (nth-value 1 (build text))))
             (is (= 1 (length reports)))
             (is (eql 0 (search report (or (first reports) ""))) "~a~%gave ~s" text reports))))

(defun declared (rulebase)
  (loop for predicate across (supergrip-chainer:rulebase-predicates rulebase)
        when (supergrip-chainer:declared-p predicate)
          collect (list (supergrip-chainer:predicate-text predicate)
                        (supergrip-chainer:predicate-arity predicate))))

(test what-the-input-may-say-is-declared
  (multiple-value-bind (rulebase reports)
      (build "(RULE A (IF (FRAGILE (s1)) (OBJECT HAS NO LID)) (THEN (REMEMBER P (s1))))
              (INPUT WET) (INPUT FRAGILE (s1)) (INPUT OBJECT HAS LID) (INPUT LIKE (s2 s1))")
    (is (null reports))
    (is (equal '(("WET" 0) ("FRAGILE" 1) ("OBJECT HAS LID" 0) ("LIKE" 2)) (declared rulebase)))
    (is (equal '("A: P Z1")
               (run-on-facts rulebase (supergrip-chainer:make-memory rulebase) '((fragile z1)))))))

(test wrong-declarations-are-refused
  (loop for (text report) in
        '(("(INPUT)" "INPUT: an empty sentence")
          ("(INPUT (s1))" "INPUT: an empty sentence")
          ("(INPUT NOT WET)"
           "INPUT NOT WET: a negation can't be declared: what the input does not say is false")
          ("(INPUT WET) (INPUT WET (s1))" "INPUT WET: (INPUT WET) declares it already")
          ("(INPUT SMALL (s1 s2))"
           "INPUT SMALL: it is a preliminary assertion, which holds or not whatever the input says")
          ("(INPUT LIKE (Z1 s2))"
           "INPUT LIKE: a declaration holds for all surfaces: (INPUT LIKE (S1 S2))")
          ("(INPUT FRAGILE s1)"
           "INPUT FRAGILE S1: surfaces go in a list of their own, at the end: (FRAGILE (S1))")
          ("(INPUT WET) (RULE A (IF (WET (s1))) (THEN (REMEMBER P)))"
           "RULE A, clause 1: WET takes no list of surfaces, as (INPUT WET) says; here it has 1"))
        do (is (equal (list report) (nth-value 1 (build text))) "~a" text)))

(defun warnings-of (text)
  (mapcar #'supergrip-data:problem-text
          (nth-value 1 (supergrip-data:with-problems
                         (supergrip-chainer:check-rules (rule-forms text) *inputs*)))))

(test the-checker-learns-of-declarations
  (is (null (warnings-of "(RULE A (IF (FRAGILE (s1))) (THEN (REMEMBER P)))
                          (RULE B (IF (P)) (THEN (CANT DO)))
                          (INPUT FRAGILE (s1))"))
      "wherever they stand")
  (is (equal '("nothing provides FRAGLE (did you mean FRAGILE?), so the rule can never fire"
               "no rule tests it")
             (warnings-of "(INPUT FRAGILE (s1)) (RULE A (IF (FRAGLE (s1))) (THEN (CANT DO)))")))
  (is (equal '("the absence of WET is tested here, but also RULE B, which derives it, comes later; rules run in order, each once")
             (warnings-of "(INPUT WET) (RULE A (IF (NOT WET)) (THEN (CANT DO)))
                           (RULE B (IF (SLIPPERY)) (THEN (REMEMBER WET)))"))
      "rules may add to what the input says")
  (is (null (warnings-of "(INPUT NOT WET) (INPUT SMALL) (RULE A (IF (WET)) (THEN (CANT DO)))"))
      "what follows from a wrong declaration is no news"))

(test all-mistakes-are-reported-and-good-rules-stay
  (multiple-value-bind (rulebase reports)
      (build "(RULE A (IF (SMALL (s1)) (NOT)) (THEN (FROB) (REMEMBER P (s9))))
              (RULE B (IF (SLIPPERY)) (THEN (REMEMBER P (Z1))))")
    (is (= 3 (length reports)) "~{~a~%~}" reports)
    (is (equal '("B") (map 'list #'supergrip-chainer:rule-name
                           (supergrip-chainer:rulebase-rules rulebase))))))

(test suggestions-are-for-slips-of-the-pen
  (let* ((forms (rule-forms (format nil "~{(RULE R~d (IF (P~:*~dX)) (THEN (REMEMBER P~:*~d)))~}"
                                    (loop for i from 1000 below 3000 collect i))))
         (problems (nth-value 1 (supergrip-data:with-problems
                                  (supergrip-chainer:check-rules forms *inputs*))))
         (suggestions (count-if (lambda (problem)
                                  (search "did you mean" (supergrip-data:problem-text problem)))
                                problems)))
    (is (= 1001 (length problems)))
    (is (equal "and 1000 more problems"
               (supergrip-data:problem-text (first (last problems)))))
    (is (search "nothing provides P1000X (did you mean P1000?)"
                (supergrip-data:problem-text (first problems))))
    (is (< 10 suggestions 1000) "~d suggestions among 2000 unknown names" suggestions)))
