;;;; explain.lisp -- what HOW, WHY-NOT, EXPLAIN-BEST, descriptions, traces and breaks tell.

(in-package :supergrip-test)
(define-suite explain "What HOW, WHY-NOT, EXPLAIN-BEST, descriptions, traces and breaks tell.")

;;; HOW

(test how-tells-the-tree-down-to-the-box
  (is (equal '("(PARALLEL (Y2 Y1)): RULE SURFACES1 with S1 = Y2, S2 = Y1"
               "  (OPPOSED (Y2 Y1)): input, opposite faces of the box"
               "  not (CONSTRAINED (Y2)): assumed, nothing had said so when SURFACES1 was tried"
               "  not (CONSTRAINED (Y1)): assumed, nothing had said so when SURFACES1 was tried")
             (printed (supergrip:how '(parallel (y1 y2)) (pencil-plan)))))
  (is (equal '("(CONSTRAINED (X1)): input, the box says so")
             (printed (supergrip:how '(constrained (x1)) (pencil-plan)))))
  (is (equal '("(LARGE (X2 X1)): input, they are 12 cm apart, no less than DIST-PINCH, 12")
             (printed (supergrip:how '(large (x1 x2)) (pencil-plan))))))

(test how-tells-why-a-fact-is-not-known
  (is (equal '("(WIDE (Y2 Y1)) is not known."
               "RULE SURFACES4 did not fire: clause 2, (LARGE (S1 S2)), fails for every binding of the clauses before it."
               "  Tried: S1 = Y2, S2 = Y1; S1 = Y1, S2 = Y2"
               "  LARGE is an input, and the box does not give it for these faces.")
             (printed (supergrip:how '(wide (y2 y1)) (pencil-plan)))))
  (is (equal '("(PARALLEL (Z2 Z1)) is not known."
               "RULE SURFACES1 did fire, but not for this: clause 3, (NOT CONSTRAINED (S2)), fails for every binding of the clauses before it."
               "  Tried: S1 = Z1, S2 = Z2"
               "  This stands in its way:"
               "    (CONSTRAINED (Z2)): input, the box says so")
             (printed (supergrip:why-not '(parallel (z2 z1)) (pencil-plan)))))
  (is (equal '("(SLIPPERY) is not known." "It is an input, which this box does not give.")
             (printed (supergrip:how '(slippery) (pencil-plan))))))

(test questions-about-nothing-are-refused
  (loop for (form report) in
        '(((paralel (y2 y1)) "(PARALEL (Y2 Y1)) is not a fact that could be known: nothing speaks of PARALEL (did you mean PARALLEL?); known are OPPOSED, SMALL, NARROW, LARGE, CONSTRAINED, SLIPPERY, PARALLEL, OBJECT HAS PARALLEL SURFACES, ADJACENT, OBJECT HAS ADJACENT SURFACES, CORNER, OBJECT HAS FREE CORNERS, WIDE, OBJECT HAS OTHER PARALLEL SURFACES")
          ((not parallel (y2 y1)) "(NOT PARALLEL (Y2 Y1)) is not a fact that could be known: ask about the sentence without NOT or NO")
          (parallel "PARALLEL is not a fact that could be known: a fact is a list, such as (PARALLEL (Y2 Y1)) or (OBJECT HAS FREE CORNERS)")
          ((parallel 7)
           "(PARALLEL 7) is not a fact that could be known: 7 is not allowed in a fact")
          ((parallel (y2)) "(PARALLEL (Y2)) is not a fact that could be known: PARALLEL takes 2 different surfaces of X1 X2 Y1 Y2 Z1 Z2")
          ((parallel (y2 y3)) "(PARALLEL (Y2 Y3)) is not a fact that could be known: PARALLEL takes 2 different surfaces of X1 X2 Y1 Y2 Z1 Z2"))
        do (is (equal report (handler-case (supergrip:how form (pencil-plan))
                               (supergrip:no-fact-error (condition) (princ-to-string condition))))))
  (is (search "there is no rule or grasp GRIP12 (did you mean GRIP1"
              (handler-case (supergrip:why-not 'grip12 nil (pencil-plan))
                (supergrip:no-rule-error (condition) (princ-to-string condition)))))
  (let ((supergrip:*plan* nil))
    (signals supergrip:no-plan-error (supergrip:how '(slippery)))
    (signals supergrip:no-plan-error (supergrip:why-not 'grip1))
    (signals supergrip:no-plan-error (supergrip:explain-best))))

;;; WHY-NOT, rules

(test why-not-names-the-clause-and-what-blocks-a-negation
  (is (equal '("RULE GRIP4 did not fire: clause 1, (OBJECT HAS NO PARALLEL SURFACES), fails."
               "  This stands in its way:"
               "    (OBJECT HAS PARALLEL SURFACES): RULE SURFACES1 with S1 = Y2, S2 = Y1"
               "      (OPPOSED (Y2 Y1)): input, opposite faces of the box"
               "      not (CONSTRAINED (Y2)): assumed, nothing had said so when SURFACES1 was tried"
               "      not (CONSTRAINED (Y1)): assumed, nothing had said so when SURFACES1 was tried")
             (printed (supergrip:why-not 'grip4 nil (pencil-plan)))))
  (is (equal '("RULE GRIP10 did not fire: clause 1, (WIDE (S1 S2)), fails."
               "  No rule before it said WIDE.")
             (printed (supergrip:why-not 'grip10 nil (pencil-plan)))))
  (is (equal '("RULE SURFACES1 did fire, with S1 = Y2, S2 = Y1; S1 = Y1, S2 = Y2.")
             (printed (supergrip:why-not 'surfaces1 nil (pencil-plan))))))

(test why-not-knows-what-was-not-reached
  (is (equal '("RULE SURFACES1 was not reached: RULE GRIP2 ended the run, CANT GRASP TOO SLIPPERY TO PICK UP.")
             (printed (supergrip:why-not 'surfaces1 nil (plan-of '(8 5 3) 0.05d0 '(z2))))))
  (is (equal '("RULE GRIP7 was not reached: RULE GRIP6 ended the run, KEEP BEST.")
             (printed (supergrip:why-not 'grip7 nil (plan-of '(4 4 6) 1.5d0 '(z2 z1 x2 y2)))))))

;;; WHY-NOT, grasps: each of the lower level's reasons

(test how-and-why-not-answer-for-each-other
  (let ((supergrip:*plan* (pencil-plan)))
    (dolist (name '(grip8 grip4 pinch-2-parallel pinch-3-parallel pinch-3-corner))
      (is (equal (printed (supergrip:why-not name)) (printed (supergrip:how name)))))
    (is (equal '("PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): it is the best grasp."
                 "Ask (explain-best) why.")
               (printed (supergrip:how 'pinch-3-parallel))))
    (dolist (fact '((parallel (y2 y1)) (adjacent (z1 y2) (z1 y1))))
      (is (equal (cons "That is so; this is how:" (printed (supergrip:how fact)))
                 (printed (supergrip:why-not fact)))))
    (dolist (fact '(slippery "slippery" (slippery)))
      (is (equal '("(SLIPPERY) is not known." "It is an input, which this box does not give.")
                 (printed (supergrip:how fact))))
      (is (equal (printed (supergrip:how fact)) (printed (supergrip:why-not fact)))))
    (is (search "GRIP99 is not a fact" (error-text (supergrip:how 'grip99))))
    (is (search "there is no rule or grasp GRIP99" (error-text (supergrip:why-not 'grip99))))))

(test how-wants-one-list
  (let ((supergrip:*plan* (pencil-plan)))
    (loop for (text . arguments)
            in `(("a fact is one list: (how '(PARALLEL (Y2 Y1)))" parallel (y2 y1))
                 ("a fact is one list: (how '(PARALLEL (Y2 Y1)))" parallel y2 y1)
                 ("a fact is one list: (how '(OBJECT HAS CORNERS))" object has "corners")
                 ("HOW takes a fact and a plan; 3 is too much" (parallel (y2 y1)) ,supergrip:*plan*
                  3)
                 ("GRIP8 is not a plan: FORWARD-CHAIN, PLAN and TRY-GRASP return plans; HOW, WHY-NOT and REQUIRES answer about a name or a fact"
                  (parallel (y2 y1)) grip8))
          do (is (equal text (error-text (apply #'supergrip:how arguments)))))
    (is (search "answer about a name or a fact"
                (error-text (supergrip:explain-best 'pinch-3-corner))))))

(test why-not-wants-its-faces-in-a-list
  (let ((supergrip:*plan* (pencil-plan)))
    (is (equal "the six faces go in one list: (why-not 'PINCH-3-PARALLEL '(Y2 Y1 X2 X1 Z2 Z1))"
               (error-text (supergrip:why-not 'pinch-3-parallel 'y2 'y1 'x2 'x1 'z2 'z1))))
    (is (equal "WHY-NOT takes a name, a list of six faces, and a plan; 3, 4 is too much"
               (error-text (supergrip:why-not 'grip8 nil supergrip:*plan* 3 4))))))

(test why-not-tells-each-lower-level-reason
  (let ((pencil (pencil-plan)))
    (loop for (plan grasp matching line) in
          `((,pencil pinch-2-parallel nil "PINCH-2-PARALLEL: no rule tried it.")
            (,pencil pinch-3-parallel (z1 z2 x1 x2 y1 y2)
             "PINCH-3-PARALLEL (Z1 Z2 X1 X2 Y1 Y2): it would use Z2, which is constrained.")
            (,pencil pinch-3-parallel (y1 y2 x1 x2 z2 z1)
             "PINCH-3-PARALLEL (Y1 Y2 X1 X2 Z2 Z1): the same grasp was tried as (Y2 Y1 X2 X1 Z2 Z1).")
            (,pencil pinch-3-parallel (y1 y2 x2 x1 z2 z1)
             "PINCH-3-PARALLEL: (Y1 Y2 X2 X1 Z2 Z1) is not a matching: N O A must be a proper rotation of X Y Z, N1 opposite N2, and so on.")
            (,pencil pinch-3-u-shape nil
             "PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1): its Q is 0.770, 0.08965 below PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1).")
            (,pencil pinch-3-parallel nil
             "PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): it is the best grasp.")
            (,(plan-of '(30 20 30) 0.5d0 '(z2)) pinch-3-u-shape nil
             "PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1): Y2 and Y1 are 20 cm apart, the hand opens to 12.")
            (,(plan-of '(20 10 5) 0.8d0 '(z2) :weight 11) pinch-3-parallel nil
             "PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): it can't hold the weight: the load along Z is 11, the grasp bears 1.6.")
            (,(plan-of '(4 4 4) 0.6d0 '(z2 y2 x2)) pinch-2-adjacent nil
             "PINCH-2-ADJACENT (Z1 Z2 X1 X2 Y1 Y2): u is 0.6, must be > 1.")
            (,(plan-of '(6 3 2) 0.9d0 '(x2 y2 z2)) pinch-3-corner nil
             "PINCH-3-CORNER (Z1 Z2 X1 X2 Y1 Y2): open: the contacts don't close on this shape; needs u > 1.342, has 0.9."))
          do (is (equal line (why-not-line plan grasp matching)) "~a: ~a" grasp
                 (why-not-line plan grasp matching)))))

(test why-not-tells-what-would-have-come-of-it
  (let ((lines (printed (supergrip:why-not 'pinch-2-parallel nil (pencil-plan)))))
    (is (equal "If tried, it would be possible, with Q=0.325 in (Y2 Y1 X2 X1 Z2 Z1)."
               (first (last lines))))
    (is (equal "RULE GRIP7 did not fire: clause 3, (NARROW (S3 S4)), fails for every binding of the clauses before it."
               (second lines)))))

;;; EXPLAIN-BEST, descriptions

(test explain-best-tells-what-limits-and-what-would-change
  (is (equal '("PINCH-3-PARALLEL: two fingers on Y2, a finger on Y1; the palm over Z1, coming from above."
               "Force is limited about Y: the grasp exerts 1.095 beyond the weight's load, the task needs 1; radius 1.095."
               "Velocity is limited about Y: the grasp moves with 0.5, the task needs 0.8; radius 0.625."
               "What is sure: together, and in any direction, the contacts bear 0.5752 times the forces and torques asked for."
               "Exactly, they bear from 0.8724 to 0.8812 times as much; least where the box is pushed along -Y and turned about +Y."
               "The contacts bear at most 0.8812 of the force asked for, which is enough if the needs only say what matters more."
               "The grasp moves with only 0.625 of the velocity asked for about Y, which is enough if the needs only say what matters more."
               "Q, 0.860, only compares grasps for one task; it is not a probability of success."
               "Next is PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1), with a Q lower by 0.08965."
               "The choice would change if one of these were different:"
               "  the torsional friction v: 0.11, not 0.2; then PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1)"
               "  the force needed along Y: 0.699, not 0.8; then PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1)"
               "  the friction u: 0.1, not 0.8; then it can't be grasped"
               "  the weight: 1.61, not 0.2; then it can't be grasped")
             (printed (supergrip:explain-best (pencil-plan)))))
  (is (search "The box can't be grasped: CANT GRASP TOO SLIPPERY TO PICK UP: u is 0.05, no more than SLIPPERY-U, 0.1."
              (first (printed (supergrip:explain-best (plan-of '(8 5 3) 0.05d0 '(z2))))))))

(test descriptions-tell-form-words-mark-and-use
  (let ((lines (printed (supergrip:describe-rule 'surfaces4))))
    (is (equal "(RULE SURFACES4" (first lines)))
    (is (search "Reconstructed: the fourth rule of its group." (format nil "~{~a ~}" lines)))
    (is (find "In words: if S1 and S2 are PARALLEL, and S1 and S2 are LARGE, then remember that S1 and S2 are WIDE."
              lines :test #'string=))
    (is (find "PARALLEL comes from SURFACES1." lines :test #'string=))
    (is (find "WIDE is tested by GRIP5, GRIP7, GRIP9, GRIP10." lines :test #'string=)))
  (let ((lines (printed (supergrip:describe-grasp 'pinch-2-parallel))))
    (is (find-if (lambda (line) (search "Repaired:" line)) lines))
    (is (find "In words: a finger on N1, a finger on N2; the palm over A2; N1 N2 A2 must be free."
              lines :test #'string=))
    (is (find "It is tried by GRIP7." lines :test #'string=)))
  (signals supergrip:no-rule-error (supergrip:describe-grasp 'pinch-9)))

(test every-rule-and-grasp-has-its-mark
  (flet ((check (name comment &rest marks)
           (is (member (first comment) marks :test (lambda (line mark) (eql 0 (search mark line))))
               "~a" name)))
    (dolist (rule (shipped-rules))
      (check (supergrip-chainer:rule-name rule) (supergrip-chainer:rule-comment rule)
             "Printed" "Reconstructed"))
    (dolist (grasp (shipped-grasps))
      (check (supergrip:grasp-name grasp) (supergrip::draft-comment (supergrip::grasp-draft grasp))
             "Repaired" "Reconstructed"))))

;;; Properties

(defun plan-facts (plan)
  "Return the facts at the end of PLAN as lists, as HOW takes them."
  (loop for assertion in (supergrip:plan-assertions plan)
        for words = (mapcar #'make-symbol (remove-if #'consp assertion))
        for lists = (remove-if-not #'consp assertion)
        append (if lists
                   (loop for list in lists
                         collect (append words (list (mapcar #'make-symbol list))))
                   (list words))))

(defun leaf-facts (derivation)
  (if (supergrip:derivation-rule derivation)
      (loop for part in (supergrip:derivation-parts derivation)
            when (supergrip:derivation-p part) append (leaf-facts part))
      (list derivation)))

(defun tree-rules (derivation)
  (when (supergrip:derivation-rule derivation)
    (cons (supergrip:derivation-rule derivation)
          (loop for part in (supergrip:derivation-parts derivation)
                when (supergrip:derivation-p part) append (tree-rules part)))))

(defun how-fault (box)
  "Return a fact of the plan for BOX that the rules of its tree do not derive from its leaves."
  (let ((plan (supergrip:plan box)))
    (dolist (fact (plan-facts plan))
      (let ((tree (supergrip:explain-fact fact plan))
            (memory (supergrip::new-memory (supergrip:plan-knowledge plan))))
        (supergrip::start-workspace (supergrip-chainer:memory-client memory)
                                  (supergrip:plan-box plan) 0.5d0)
        (dolist (leaf (leaf-facts tree))
          (unless (supergrip-chainer:predicate-given (supergrip:derivation-predicate leaf))
            (return-from how-fault (list fact "a leaf that is no input")))
          (supergrip-chainer:remember memory (supergrip:derivation-predicate leaf)
                                      (supergrip::derivation-face-list leaf)))
        (dolist (rule (sort (remove-duplicates (tree-rules tree)) #'<
                            :key #'supergrip-chainer:rule-index))
          (dolist (binding (supergrip-chainer:rule-bindings rule memory))
            (dolist (action (supergrip-chainer:rule-actions rule))
              (when (supergrip-chainer:action-predicate action)
                (funcall (supergrip-chainer:action-function action) memory rule binding)))))
        (unless (supergrip-chainer:recall memory (supergrip:derivation-predicate tree)
                                          (supergrip::derivation-face-list tree))
          (return-from how-fault (list fact "not derived from its leaves")))))))

(test every-fact-follows-from-the-leaves-of-its-tree
  (is (null (first-fault #'how-fault (random-boxes 2000 11)))))

(test every-grasp-not-chosen-has-a-reason
  (is (null (first-fault
             (lambda (box)
               (let ((plan (supergrip:plan box)))
                 (dolist (grasp (supergrip:knowledge-grasps supergrip:*knowledge*))
                   (let* ((name (supergrip:grasp-name grasp))
                          (answer (supergrip:explain-why-not name nil plan)))
                     (when (or (string= "" (supergrip:not-chosen-text answer))
                               (not (eq (eq :chosen (supergrip:not-chosen-kind answer))
                                        (equal name (supergrip:plan-grasp plan))))
                               (string= "" (with-output-to-string (out)
                                             (supergrip:write-answer answer out))))
                       (return name))))))
             (random-boxes 2000 12)))))

(test advice-on-a-grasp-alone-tries-it-alone
  (let ((changes (supergrip:choice-changes
                  (supergrip:explain-choice (supergrip:try-grasp "PINCH-3-CORNER" (paper-box))))))
    (is (notany (lambda (change) (equal "PINCH-3-PARALLEL"
                                        (supergrip:plan-grasp (supergrip:change-plan change))))
                changes))))

(defun last-place (text)
  "Return the value of the last digit's place of TEXT, a decimal."
  (let* ((e (or (position #\e text) (length text)))
         (point (position #\. text))
         (power (if (= e (length text)) 0 (parse-integer text :start (1+ e)))))
    (expt 10 (- power (if point (- e point 1) 0)))))

(defun change-fault (plan change)
  "Return what is wrong with CHANGE of PLAN, as it is printed."
  (let* ((from (supergrip:change-from change))
         (to (supergrip:change-to change))
         (text (supergrip::exact-number-text to))
         (back (rational (first (read-text text))))
         (step (* (last-place text) (if (> to from) -1 1)))
         (box (supergrip:plan-box plan)))
    (flet ((chosen (value)
             (dolist (row supergrip::*box-keys*)
               (dotimes (index 6)
                 (when (equal (supergrip:change-what change) (supergrip::value-name row index))
                   (return-from chosen
                     (supergrip::same-choice-p
                      plan (supergrip:plan
                            (supergrip::box-with-at box row index
                                                 (coerce value 'double-float))))))))))
      (cond ((chosen back) (list text "does not change the choice"))
            ((supergrip::at-once-p from (supergrip::change-size change))
             (and (chosen 1d-11) (list text "is not at once")))
            ((and (<= (abs step) (abs (- back (rational from))))
                  (not (chosen (+ back step))))
             (list text "is not the first that changes the choice"))))))

(test what-must-change-does-change-the-choice
  (is (null (first-fault
             (lambda (box)
               (let* ((plan (supergrip:plan box))
                      (changes (supergrip:choice-changes (supergrip:explain-choice plan)))
                      (sizes (mapcar #'supergrip::change-size changes)))
                 (or (loop for change in changes thereis (change-fault plan change))
                     (and sizes (not (apply #'<= sizes)) sizes))))
             (random-boxes 1000 13))))
  (let ((lines (printed (supergrip:explain-best
                         (plan-of '(12 2 2) 0.8d0 '(z2 x1) :weight 1d-10 :force '(1 0 0 0 0 0))))))
    (is (find "  the velocity needed along X: anything above 0, not 0; then PINCH-3-PARALLEL (Y2 Y1 Z2 Z1 X1 X2)"
              lines :test #'string=)))
  (is (search "the weight: 1.61, not 1e-10;"
              (format nil "~{~a~}"
                      (printed (supergrip:explain-best
                                (plan-of '(12 2 2) 0.8d0 '(z2 x1) :weight 1d-10
                                         :force '(1 0.8d0 0.8d0 0.3d0 1 1)
                                         :velocity '(0 0.8d0 0.8d0 0 0.8d0 0.8d0)))))))) 

(test figures-have-the-digits-that-they-need
  (loop for (number text) in '((999999999.03d0 "1e+9") (0.0625d0 "0.0625") (0.00123456d0 "0.001235")
                               (9999.96d0 "10000") (1234567.8d0 "1234568") (0 "0")
                               (-0.07071d0 "-0.07071")
                               (1d-12 "1e-12") (1d300 "1e+300") (0.99996d0 "1")
                               (1.2346d-5 "1.235e-5"))
        do (is (equal text (supergrip::number-text number))))
  (loop for (numbers . texts) in '(((0.6d0 0.59999d0) "0.6" "0.59999") ((12 12) "12" "12")
                                   ((0.70710678118d0 0.7071067811865476d0)
                                    "0.70710678118" "0.70710678119"))
        do (is (equal texts (apply #'supergrip::number-texts numbers))))
  (let ((state (sb-ext:seed-random-state 5)))
    (is (null (loop repeat 2000
                    for number = (* (random 10d0 state) (expt 10d0 (- (random 40 state) 20)))
                    unless (eql number (supergrip-data:as-double
                                        (first (read-text (supergrip::exact-number-text number)))))
                      collect number)))))

(test a-radius-is-told-in-plain-words
  (flet ((lines (force &optional (u 0.8d0))
           (printed (supergrip:explain-best
                     (plan-of '(12 2 2) u '(z2 x1) :force force)))))
    (is (find "The contacts bear at most 0.4616 of the force asked for, which is enough if the needs only say what matters more."
              (lines '(1 1 1 1 1 1) 0.4d0) :test #'string=))
    (is (notany (lambda (line) (search "enough if" line)) (lines '(0.1 0 0 0 0 0))))))

;;; Traces, breaks, counts

(test traces-have-levels
  (flet ((lines (level)
           (length (printed (supergrip:forward-chain :box (paper-box) :trace level)))))
    (is (= 0 (lines 0)))
    (is (= 20 (lines 1)))
    (is (< 20 (lines 2) (lines 3) (lines 4))))
  (let ((lines (printed (supergrip:forward-chain :box (paper-box) :trace 4))))
    (is (equal (lines-of (file-text "t/pencil-session.txt"))
               (remove-if (lambda (line) (char= (char line 0) #\Space)) lines))
        "a trace only adds to the paper's lines")))

(test rules-and-grasps-are-traced-by-name
  (unwind-protect
       (progn
         (supergrip:trace-rule 'grip4)
         (let ((lines (printed (supergrip:forward-chain :box (paper-box)))))
           (is (= 23 (length lines)))
           (is (find "    clause 1, (OBJECT HAS NO PARALLEL SURFACES): nothing" lines
                     :test #'string=)))
         (supergrip:untrace-rule 'grip4)
         (supergrip:trace-grasp 'pinch-3-u-shape)
         (is (find-if (lambda (line) (search "(PINCH-3-U-SHAPE FAILS AT CONDITIONS" line))
                      (printed (supergrip:forward-chain
                                :box (supergrip:plan-box (plan-of '(30 20 30) 0.5d0 '(z2)))))))
         (signals supergrip:no-rule-error (supergrip:trace-rule 'grip99))
         (supergrip:untrace-grasp)
         (supergrip:trace-rule 'grip9)
         (let ((lines (printed (supergrip:forward-chain :box (paper-box) :trace 0))))
           (is (equal '("  RULE GRIP9" "  RULE GRIP9 fires: 8 bindings")
                      (remove-if-not (lambda (line) (search "RULE" line)) lines)))
           (is (= 2 (count-if (lambda (line) (search "IS O.K." line)) lines))
               "at level 0 what is traced is alone")))
    (supergrip:untrace-rule)))

(defun stops (function)
  "Return where FUNCTION stops, going on to the next break each time."
  (let ((stops '()))
    (handler-bind ((supergrip:chain-break
                     (lambda (condition)
                       (push (princ-to-string condition) stops)
                       (invoke-restart 'continue))))
      (funcall function))
    (nreverse stops)))

(test a-run-stops-where-it-is-told-to
  (unwind-protect
       (flet ((go-on () (printed (supergrip:forward-chain :box (paper-box)))))
         (supergrip:break-on 'grip8)
         (is (= 1 (length (stops #'go-on))))
         (is (search "before (RULE GRIP8" (first (stops #'go-on))))
         (supergrip:unbreak)
         (supergrip:break-on '(corner (x2 z1 y1)))
         (is (equal '("(CORNER (Z1 Y1 X2)) is known") (stops #'go-on)))
         (supergrip:break-on 'pinch-3-c-shape)
         (is (equal '("(CORNER (Z1 Y1 X2)) is known"
                      "PINCH-3-C-SHAPE (Y2 Y1 Z2 Z1 X1 X2) was tried: it is possible"
                      "PINCH-3-C-SHAPE (Y1 Y2 X1 X2 Z2 Z1) was tried: it is possible")
                    (stops #'go-on)))
         (supergrip:unbreak "pinch-3-c-shape")
         (supergrip:unbreak '(corner (x2 z1 y1)))
         (is (null (stops #'go-on))))
    (supergrip:unbreak)))

(test a-rule-that-is-running-has-not-said-all-yet
  (let ((lines '()))
    (unwind-protect
         (handler-bind ((supergrip:chain-break
                          (lambda (condition)
                            (declare (ignore condition))
                            (setf lines (printed (supergrip:how '(corner (z1 y1 x2)))))
                            (invoke-restart 'continue))))
           (supergrip:break-on '(corner (z1 y2 x2)))
           (printed (supergrip:forward-chain :box (paper-box))))
      (supergrip:unbreak))
    (is (equal "(CORNER (Z1 Y1 X2)) is not known." (first lines)))
    (is (search "RULE SURFACES3 is running, with " (second lines)))
    (is (search ", and has not come to this yet." (second lines)))))

(test steps-go-from-rule-to-rule
  (let ((count 0))
    (handler-bind ((supergrip:chain-break (lambda (condition)
                                            (declare (ignore condition))
                                            (incf count)
                                            (invoke-restart 'supergrip:next-rule))))
      (printed (supergrip:forward-chain :box (paper-box) :step t)))
    (is (= (rule-total) count))))

(test counts-are-of-matches-firings-and-facts
  (let ((counts nil))
    (printed (setf counts (supergrip:rule-counts (pencil-plan))))
    (is (equal '("GRIP8" 6 4 0) (assoc "GRIP8" counts :test #'string=)))
    (is (equal '("SURFACES2" 50 10 6) (assoc "SURFACES2" counts :test #'string=)))
    (is (= (rule-total) (length counts)))))

(test a-watched-run-is-the-same-plan
  (is (null (first-fault
             (lambda (box)
               (not (equal (plan-figures (supergrip:plan box))
                           (plan-figures (supergrip::observed-plan
                                          box supergrip:*knowledge* 0.5d0
                                          (constantly (constantly nil)))))))
             (random-boxes 2000 14)))))

;;; Other knowledge

(test how-tells-why-a-rule-said-no-more
  (flet ((answer (fact &optional (plan (pencil-plan)))
           (printed (supergrip:how fact plan))))
    (with-knowledge-restored
      (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
        (supergrip:edit '(rule grip0 (if (constrained (s1)) (small (s2 s3)))
                          (then (remember w (s1)) (remember w (s2))))
                        :before 'grip1)
        (supergrip:edit '(rule grip11 (if (object has parallel surfaces))
                          (then (keep best) (remember late)))))
      (is (find "RULE GRIP0 did not fire: clause 2, (SMALL (S2 S3)), fails for every binding of the clauses before it."
                (answer '(w (y1))) :test #'string=)
          "the second action might have said so")
      (is (equal '("(LATE) is not known."
                   "RULE GRIP11 did fire, and ended the run before, KEEP BEST.")
                 (answer '(late)))))
    (is (equal '("(PARALLEL (X1 X2)) is not known."
                 "RULE SURFACES1 did fire, but not for this: clause 3, (NOT CONSTRAINED (S2)), fails for every binding of the clauses before it.")
               (subseq (answer '(parallel (x1 x2))) 0 2)))
    (is (equal '("(PARALLEL (Y2 Y1)) is not known."
                 "RULE SURFACES1 did not run: PINCH-3-PARALLEL was tried without rules.")
               (answer '(parallel (y2 y1)) (supergrip:try-grasp "PINCH-3-PARALLEL" (paper-box)))))))

(test what-many-facts-follow-from-is-derived-once
  (with-knowledge-restored
    (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
      (loop for i from 1 to 40
            do (supergrip:edit `(rule ,(make-symbol (format nil "A~d" i))
                                      (if (,(if (= i 1) 'opposed
                                                (make-symbol (format nil "P~d" (1- i))))
                                           (s1 s2))
                                          (,(if (= i 1) 'opposed
                                                (make-symbol (format nil "P~d" (1- i))))
                                           (s3 s4)))
                                      (then (remember ,(make-symbol (format nil "P~d" i)) (s1 s2))))
                               :before 'grip1)))
    ;; From its definition the tree has 2^40 leaves.
    (is (< 80 (length (printed (supergrip:how '(p40 (z1 z2)) (pencil-plan)))) 1000))))

(test a-suggestion-that-is-no-matching-is-told
  (with-knowledge-restored
    (supergrip:rule mine (if (corner (s1 s2 s3))) (then (try pinch-3-corner (s1 s2 s3 ? ? ?))))
    (let ((lines (printed (supergrip:why-not 'pinch-3-corner nil (pencil-plan)))))
      (is (equal "PINCH-3-CORNER: what the rules suggest is not a matching, or would use a constrained face."
                 (first lines)))
      (is (find-if (lambda (line) (search "RULE MINE did fire" line)) lines)))))

(test a-name-of-the-other-kind-is-told
  (is (equal "PINCH-3-PARALLEL is a grasp: see DESCRIBE-GRASP"
             (handler-case (supergrip:describe-rule 'pinch-3-parallel)
               (supergrip:no-rule-error (condition) (princ-to-string condition)))))
  (is (equal "GRIP9 is a rule: see DESCRIBE-RULE"
             (handler-case (supergrip:describe-grasp 'grip9)
               (supergrip:no-rule-error (condition) (princ-to-string condition)))))
  (is (search "surfaces go in a list of their own: (PARALLEL (Y2 Y1))"
              (handler-case (supergrip:how '(parallel y2 y1) (pencil-plan))
                (supergrip:no-fact-error (condition) (princ-to-string condition))))))

(test objects-print-what-they-are
  (is (equal "#<CANDIDATE PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1) Q=0.770>"
             (let ((*package* (find-package :supergrip)))
               (prin1-to-string (first (supergrip:plan-candidates (pencil-plan))))))))

;;; Equals

(defun next-line (plan)
  "Return the line of EXPLAIN-BEST on PLAN that tells of the next candidate."
  (find-if (lambda (line) (eql 0 (search "Next is " line))) (printed (supergrip:explain-best plan))))

(defun twin-plan (mobilities)
  "Return a plan in which the pinches P1, P2, and so on, one for each of MOBILITIES, texts, that is its
TWIST along O, are tried in one matching each."
  (let ((numbers (loop for nil in mobilities for number from 1 collect number)))
    (supergrip:plan
     '((size 6 4 4) (weight 0.1d0) (u 0.5d0) (v 0.2d0) (constrained z2) (force-needed (0 0 0 0 0 0))
       (velocity-needed (1 0 0 0 0 0)))
     :knowledge
     (text-knowledge
      (format nil "(RULE R (IF (OPPOSED (Y1 Y2))) (THEN ~{(TRY P~a (y2 y1 x2 x1 z2 z1))~}))" numbers)
      (format nil "(SETQ GRIPPER '(DIST-PINCH 12))~{~{~%(SETQ P~a '(USED-SURFACES (N1 N2 A2) CONDITIONS (T)
  OFFSET (0 0 0 0 0 0) WRENCH (9 9 9 9 9 9) TWIST (1 ~a 1 1 1 1) CONTACTS ((N1 0 0) (N2 0 0))))~}~}"
              (mapcar #'list numbers mobilities))))))

(test of-equals-the-first-tried-is-kept-and-it-is-said-so
  (loop for (mobilities . line) in
        '((("0.8" "0.8") . "Next is P2 (Y2 Y1 X2 X1 Z2 Z1), with the same Q, but tried later: of equals the first tried is kept.")
          (("0.8" "0.8" "0.8") . "Next is P2 (Y2 Y1 X2 X1 Z2 Z1), with the same Q, but tried later, as was another: of equals the first tried is kept.")
          (("0.8" "0.8" "0.7" "0.8") . "Next is P2 (Y2 Y1 X2 X1 Z2 Z1), with the same Q, but tried later, as was another: of equals the first tried is kept.")
          (("0.8" "0.8" "0.8" "0.8") . "Next is P2 (Y2 Y1 X2 X1 Z2 Z1), with the same Q, but tried later, as were two others: of equals the first tried is kept.")
          ;; What differs by no more than rounding is equal, also if the later is the greater.
          (("0.8" "0.80000000001") . "Next is P2 (Y2 Y1 X2 X1 Z2 Z1), with the same Q, but tried later: of equals the first tried is kept.")
          (("0.7" "0.8") . "Next is P1 (Y2 Y1 X2 X1 Z2 Z1), with a Q lower by 0.1."))
        do (is (equal line (next-line (twin-plan mobilities))) "~a" mobilities))
  (is (equal "P1" (supergrip:plan-grasp (twin-plan '("0.8" "0.80000000001"))))))
