;;;; box-facts.lisp -- facts of one's own: a box says them, the rules declare and test them.

(in-package :supergrip-test)
(define-suite box-facts "Facts of one's own: a box says them, the rules declare and test them.")

(defparameter *gentle-rules*
  "(INPUT FRAGILE (s1)) (INPUT WET) (INPUT LIKE (s1 s2))
   (RULE WET1 (IF (WET)) (THEN (CANT GRASP IT WET)))
   (RULE GENTLE1 (IF (FRAGILE (s1)) (OPPOSED (s1 s2)) (NOT FRAGILE (s2)))
                 (THEN (TRY PINCH-2-PARALLEL (s1 s2 ? ? ? ?))
                       (TRY PINCH-3-PARALLEL (s1 s2 ? ? ? ?))))
   (RULE GENTLE2 (IF (LIKE (s1 s2)) (NOT OPPOSED (s1 s2)))
                 (THEN (TRY PINCH-3-U-SHAPE (s1 ? s2 ? ? ?))))
   (RULE GENTLE3 (IF (FRAGILE (s1)) (NOT LIKE (s1 s2)))
                 (THEN (TRY PINCH-3-CORNER (s1 ? s2 ? ? ?)) (KEEP BEST)))")

(defun gentle-knowledge ()
  (values (text-knowledge *gentle-rules* (file-text "grasps.lisp"))))

(defun box-saying (&rest facts)
  (append *good-box* `((:facts ,@facts))))

(defun gentle-plan (&rest facts)
  (supergrip:plan (apply #'box-saying facts) :knowledge (gentle-knowledge)))

(defun said-of (&rest facts)
  "Return what is wrong with a box of FACTS, by itself or for the gentle rules."
  (problem-texts (lambda () (apply #'gentle-plan facts))))

(test rules-test-the-facts-of-a-box
  (let ((plan (gentle-plan '(fragile (y1)))))
    (is (equal '("Y1" "Y2") (subseq (supergrip:plan-matching plan) 0 2)))
    (is (every (lambda (candidate)
                 (or (equal "PINCH-3-CORNER" (supergrip:candidate-grasp candidate))
                     (equal '("Y1" "Y2") (subseq (supergrip:candidate-matching candidate) 0 2))))
               (supergrip:plan-candidates plan)))
    (is (find '("FRAGILE" ("Y1")) (supergrip:plan-assertions plan) :test #'equal)))
  (is (equal "CANT GRASP IT WET: the box says (WET)" (supergrip:plan-reason (gentle-plan '(wet)))))
  (is (null (supergrip:plan-candidates (gentle-plan))) "what no box says is false"))

(test a-box-returns-its-facts
  (let* ((facts '((fragile (y1)) (wet) ("like" ("z1" x2))))
         (box (supergrip:parse-box (apply #'box-saying facts))))
    (is (equal '(("FRAGILE" ("Y1")) ("WET") ("LIKE" ("Z1" "X2"))) (supergrip:box-facts box)))
    (is (equal (supergrip:box-facts box)
               (supergrip:box-facts (supergrip:parse-box
                                     (apply #'box-saying (supergrip:box-facts box))))))
    (is (equal (supergrip:box-facts box) (supergrip:box-value box :facts)))
    (is (null (supergrip:box-facts (supergrip:parse-box (box-saying)))))
    (is (null (supergrip:box-facts (supergrip:parse-box (paper-box)))))))

(test facts-are-the-same-in-json
  (flet ((json (facts)
           (json-box (changed *json-pencil* "\"constrained\""
                              (format nil "\"facts\": ~a, \"constrained\"" facts)))))
    (is (equal '(("FRAGILE" ("Y1")) ("WET") ("OBJECT" "HAS" "LID"))
               (supergrip:box-facts
                (json "[[\"FRAGILE\", [\"Y1\"]], [\"wet\"], [\"OBJECT HAS\", \"LID\"]]"))))
    (is (null (supergrip:box-facts (json "[]"))))
    (loop for (facts . reports) in
          '(("null"
             "\"facts\": null is not valid: \"facts\" takes lists of words, each of which may end in one list of faces: \"facts\": [[\"FRAGILE\", [\"Z1\"]], [\"WET\"]]")
            ("[[\"A\", \"Z1\"]]"
             "[\"A\", \"Z1\"] is not a fact: its faces belong in a list of their own, at the end: [\"A\", [\"Z1\"]]")
            ("[[\"A\", [\"Z3\", 1]]]"
             "\"Z3\" is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2"
             "1 is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2"))
          do (is (equal (loop for report in reports collect (format nil "1: BOX: ~a" report))
                        (problem-texts (lambda () (json facts))))
                 "~a" facts))))

(test facts-that-are-none-are-refused
  (let ((takes "FACTS takes lists of words, each of which may end in one list of faces: (FACTS (FRAGILE (Z1)) (WET))"))
    (loop for (fact text) in
          `((wet ,takes) ((wet ()) ,takes) (((z1)) ,takes) ((wet (z1) (z2)) ,takes) ((wet 3) ,takes)
            (() ,takes) (("") ,takes) (("(") ,takes)
            ((wet z1) "its faces belong in a list of their own, at the end: (WET (Z1))")
            ((not wet)
             "a fact can't be negated; leave it out, since what a box does not say is false"))
          do (is (equal (list (format nil "BOX: ~a is not a fact: ~a"
                                      (supergrip-data:form-text fact)
                                      text))
                        (said-of fact))
                 "~s" fact)))
  (is (equal '("BOX: Z9 is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2"
               "BOX: X1 occurs twice in one list of faces"
               "BOX: the fact (LIKE (Y1 Z1)) is given twice")
             (said-of '(fragile (z9)) '(like (x1 x1)) '(like (z1 y1)) '(like (y1 z1))))))

(test facts-that-nothing-declares-are-refused
  (is (equal '("BOX: (FRAGLE (Z1)): no INPUT declares FRAGLE (did you mean FRAGILE?); to allow it, add (INPUT FRAGLE (S1)) to rules.lisp, or type (edit '(INPUT FRAGLE (S1)))"
               "BOX: (PARALLEL (Y2 Y1)): no INPUT declares PARALLEL; to allow it, add (INPUT PARALLEL (S1 S2)) to rules.lisp, or type (edit '(INPUT PARALLEL (S1 S2)))"
               "BOX: (LIKE (Z1)): LIKE takes 2 faces, not 1; (INPUT LIKE (S1 S2)) declares it so in rules.lisp"
               "BOX: (WET (Z1)): WET takes no faces, not 1; (INPUT WET) declares it so in rules.lisp"
               "BOX: (NARROW (Y2 Y1)): NARROW can't be stated as a fact: it follows from the box's other keys and the gripper")
             (said-of '(fragle (z1)) '(parallel (y2 y1)) '(fragile (y1)) '(like (z1)) '(wet (z1))
                      '(narrow (y2 y1)))))
  (is (equal '("1: BOX: (FRAGILE (Z1)): no INPUT declares FRAGILE; to allow it, add (INPUT FRAGILE (S1)) to rules.lisp")
             (problem-texts (lambda ()
                              (supergrip:plan
                               (supergrip:parse-box (box-saying '(fragile (z1))) :line 1)))))
      "by the shipped rules"))

(test facts-of-any-length-are-refused-in-few-words
  (let ((words (loop repeat 100000 collect "A")))
    (is (< (length (first (said-of words))) 1000))
    (is (< (length (first (said-of (list (format nil "~{~a~^ ~}" words))))) 1000))))

(test batches-say-where-a-fact-stands-that-nothing-declares
  (let ((text (changed *pencil* "(SIZE" (format nil "(FACTS (WET)~% (FRAGILE (Z1))) (SIZE")))
        (json (changed *json-pencil* "{" "{\"facts\": [[\"WET\"]], ")))
    (is (equal '((1 9) (2 2))
               (loop for problem in (getf (first (answers text)) :problems)
                     collect (list (getf problem :line) (getf problem :column)))))
    (is (search "line 1, column 12: [\"WET\"]: no INPUT declares WET; to allow it, add (INPUT WET) to rules.lisp"
                (getf (first (answers json)) :reason)))))

(test how-facts-are-spelled-does-not-matter
  (let ((state (sb-ext:seed-random-state 51))
        (knowledge (gentle-knowledge)))
    (for-random-boxes (box 200 52)
      (let ((facts (random-facts '((fragile 1) (like 2)) state)))
        (flet ((story (facts)
                 (let ((plan (supergrip:plan (cons (cons 'facts facts) box) :knowledge knowledge)))
                   (list (plan-figures plan) (supergrip:plan-assertions plan)))))
          (is (equal (story facts)
                     (story (loop for (word faces) in (shuffle facts state)
                                  collect (list word (shuffle faces state)))))))))))

(test turning-a-box-turns-its-facts
  (let ((state (sb-ext:seed-random-state 53))
        (knowledge (gentle-knowledge)))
    (flet ((plan (box) (supergrip:plan box :knowledge knowledge)))
      (is (null (first-fault (lambda (box) (turn-fault box *rotations* #'plan))
                             (loop for box in (random-boxes 300 54 :weight nil)
                                   collect (cons (cons 'facts (random-facts '((fragile 1) (like 2))
                                                                            state))
                                                 box))))))))

(test a-half-turn-is-the-same-grasp-whatever-the-facts
  ;; TRY knows no facts: of two matchings that are half a turn apart it takes the one suggested
  ;; first.
  (flet ((tried (grasp rules &rest facts)
           (loop with text = (format nil "(INPUT FRAGILE (s1)) ~{~a ~}" rules)
                 for candidate in (supergrip:plan-candidates
                                   (supergrip:plan (apply #'box-saying facts)
                                                   :knowledge (text-knowledge
                                                               (format nil text grasp)
                                                               (file-text "grasps.lisp"))))
                 collect (first (supergrip:candidate-matching candidate)))))
    (let ((all "(RULE ALL (IF (OPPOSED (s1 s2))) (THEN (TRY ~a (s1 s2 ? ? ? ?))))")
          (gentle "(RULE GENTLE (IF (FRAGILE (s1)) (OPPOSED (s1 s2)))
                                (THEN (TRY ~:*~a (s1 s2 ? ? ? ?))))"))
      (dolist (grasp '("PINCH-2-PARALLEL" "PINCH-3-PARALLEL"))
        (let ((without (tried grasp (list all))))
          (is (plusp (count "Y2" without :test #'string=)))
          (is (equal without (tried grasp (list all gentle) '(fragile (y1))))
              "the twins were tried")
          (dolist (face '("Y1" "Y2"))
            (is (equal (sort (substitute face "Y2" without :test #'string=) #'string<)
                       (sort (tried grasp
                                    (list (changed gentle "~:*" "") (changed all "~a" "~:*~a"))
                                    `(fragile (,face)))
                             #'string<))
                "~a first: ~a" grasp face)))))))

;;; Questions

(test questions-speak-of-facts-as-the-boxs-own
  (let* ((knowledge (gentle-knowledge))
         (plan (gentle-plan '(fragile (y1)) '(fragile (y2)))))
    (is (equal '("(FRAGILE (Y1)): input, the box says so")
               (printed (supergrip:how '(fragile (y1)) plan))))
    (is (equal '("(FRAGILE (Z1)) is not known." "It is an input, which this box does not give.")
               (printed (supergrip:how '(fragile (z1)) plan))))
    (is (equal '("RULE GENTLE1 did not fire: clause 3, (NOT FRAGILE (S2)), fails for every binding of the clauses before it."
                 "  Tried: S1 = Y2, S2 = Y1; S1 = Y1, S2 = Y2"
                 "  This stands in its way:"
                 "    (FRAGILE (Y1)): input, the box says so"
                 "  This stands in its way:"
                 "    (FRAGILE (Y2)): input, the box says so")
               (printed (supergrip:why-not 'gentle1 nil plan))))
    (is (find "  WET is an input, and the box does not give it."
              (printed (supergrip:why-not 'wet1 nil plan)) :test #'string=))
    (is (find "FRAGILE comes from the box, as (INPUT FRAGILE (S1)) declares."
              (printed (supergrip:describe-rule 'gentle1 :knowledge knowledge))
              :test #'string=))
    (let ((*standard-output* (make-broadcast-stream)))
      (is (null (supergrip:choice-changes
                 (supergrip:explain-choice (gentle-plan '(wet))))))
      (is (equal '(("FRAGILE" ("Y1")))
                 (supergrip:box-facts (supergrip:change-box
                                       (first (supergrip:choice-changes
                                               (supergrip:explain-choice
                                                (gentle-plan '(fragile (y1)))))))))
          "a changed box keeps its facts"))))

(test facts-may-also-be-derived
  (let ((plan (supergrip:plan
               (box-saying '(fragile (y1)) '(parallel (z1 z2)))
               :knowledge (knowledge-with-rule
                           "(INPUT FRAGILE (s1)) (INPUT PARALLEL (s1 s2))
                            (RULE ALSO (IF (FRAGILE (s1)) (OPPOSED (s1 s2)))
                                       (THEN (REMEMBER FRAGILE (s2)) (REMEMBER FRAGILE (s1))))"))))
    (flet ((how (fact) (printed (supergrip:how fact plan))))
      (is (equal '("(FRAGILE (Y1)): input, the box says so") (how '(fragile (y1)))))
      (is (equal '("(PARALLEL (Z2 Z1)): input, the box says so") (how '(parallel (z1 z2)))))
      (is (equal "(FRAGILE (Y2)): RULE ALSO with S1 = Y1, S2 = Y2" (first (how '(fragile (y2))))))
      (is (equal '("(FRAGILE (Z1)) is not known." "It is an input, which this box does not give."
                   "RULE ALSO did fire, but not for this: clause 2, (OPPOSED (S1 S2)), fails for every binding of the clauses before it.")
                 (subseq (how '(fragile (z1))) 0 3))))))

(test what-nothing-provides-is-not-called-an-input
  (let ((plan (supergrip:plan (paper-box)
                              :knowledge (values (knowledge-with-rule
                                                  "(RULE R (IF (NOT HOT)) (THEN (REMEMBER P)))")))))
    (is (equal '("(HOT) is not known." "Nothing provides it.")
               (printed (supergrip:how '(hot) plan))))))

(test inputs-are-described
  (let ((knowledge (values (text-knowledge (format nil "~%;;; Mine: an egg.~%~a" *gentle-rules*)
                                           (file-text "grasps.lisp")))))
    (flet ((described (name)
             (printed (supergrip:describe-input name :knowledge knowledge))))
      (is (equal '("(INPUT FRAGILE (S1))" "Mine: an egg."
                   "In words: a box may say that S1 is FRAGILE.  What it does not say is false."
                   "It is tested by GENTLE1, GENTLE3.")
                 (described 'fragile)))
      (is (equal '("SLIPPERY is a preliminary assertion; its threshold is SLIPPERY-U, 0.1."
                   "It is tested by no rule.")
                 (described "slippery")))
      (is (equal '("OPPOSED (S1 S2) is a preliminary assertion."
                   "It is tested by GENTLE1, GENTLE2.")
                 (described 'opposed)))
      (is (equal "there is no input FRAGLE (did you mean FRAGILE?); there are OPPOSED, SMALL, NARROW, LARGE, CONSTRAINED, SLIPPERY, FRAGILE, WET, LIKE"
                 (error-text (described 'fragle))))
      (is (equal "FRAGILE is an input: see DESCRIBE-INPUT"
                 (error-text (supergrip:describe-rule 'fragile :knowledge knowledge)))))
    (is (equal '((("FRAGILE") 1) (("WET") 0) (("LIKE") 2)) (supergrip:declared-inputs knowledge)))))

;;; Editing

(test declarations-are-typed-replaced-and-forgotten
  (with-knowledge-restored
    (handler-bind ((warning #'muffle-warning))
      (flet ((declared () (loop for (words count)
                                in (supergrip:declared-inputs supergrip:*knowledge*)
                                collect (format nil "~{~a~^ ~} ~d" words count))))
        (eval-in-user "(input fragile (s1))")
        (supergrip:edit '(input object has lid))
        (supergrip:edit '(input object has rim (s1)))
        (is (equal '("FRAGILE 1" "OBJECT HAS LID 0" "OBJECT HAS RIM 1") (declared)))
        (supergrip:edit '(input object has rim))
        (is (equal '("FRAGILE 1" "OBJECT HAS LID 0" "OBJECT HAS RIM 0") (declared)))
        (supergrip:rule gentle (if (fragile (s1))) (then (try pinch-2-parallel)))
        (is (equal '("GENTLE" "GRIP11")
                   (mapcar #'supergrip-chainer:rule-name
                           (last (supergrip:knowledge-rules supergrip:*knowledge*) 2)))
            "before the last rule, wherever declarations stand")
        (supergrip:plan (box-saying '(fragile (z1)) '(object has lid)))
        (supergrip:forget "object has lid")
        (supergrip:forget 'fragile)
        (is (equal '("OBJECT HAS RIM 0") (declared)))
        (signals supergrip:no-rule-error (supergrip:forget 'fragile))))))

(test comparing-leaves-out-what-only-one-declares
  (let ((new (knowledge-with-rule
              "(INPUT WET) (RULE WET1 (IF (WET)) (THEN (CANT GRASP IT WET)))"))
        (old supergrip:*knowledge*))
    (is (equal '("12 x 2 x 2 cm: can't, was PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1) Q=0.860"
                 "1 of 2 boxes differs: 1 in verdict, 0 in grasp, 0 in quality.")
               (printed (supergrip:compare-knowledge old new
                                                     (list (box-saying '(wet)) (paper-box))))))
    (is (equal '(("WET"))
               (supergrip:box-facts
                (supergrip:difference-box
                 (first (supergrip:compare-knowledge new old (box-saying '(wet)) :stream nil))))))
    (signals supergrip:box-error
      (supergrip:compare-knowledge old new (box-saying '(dry)) :stream nil))))
