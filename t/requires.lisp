;;;; requires.lisp -- what would have to change: no smaller change escapes, and each does what it
;;;; says.

(in-package :supergrip-test)
(define-suite requires
  "What would have to change: no smaller change escapes, and each does what it says.")

;;; The same question, asked at many places of a line and then by halving, with plans alone.

(defun value-clauses (box &key all)
  "Return, for each value of BOX that may be changed, a list of its name, its clause's key, its
place in the clause or NIL, what it is, and how far to look: ALL farther, or only sizes."
  (flet ((numbers (key)
           (let ((part (box-part box key)))
             (if (consp (first part)) (first part) part)))
         (far (from) (if all (max 48 (* 4 from)) (max 2d0 (* 4 from))))
         (names (words axes) (loop for axis in axes collect (format nil "~a ~a" words axis))))
    (append
     (loop for (key name) in '((weight "the weight") (u "the friction u")
                               (v "the torsional friction v"))
           for from = (first (numbers key))
           collect (list name key 0 from (far from)))
     (loop for (key words axes most) in
           '((size "the size" ("along X" "along Y" "along Z") 48)
             (force-needed "the force needed"
              ("along X" "along Y" "along Z" "about X" "about Y" "about Z") 1)
             (velocity-needed "the velocity needed"
              ("along X" "along Y" "along Z" "about X" "about Y" "about Z") 1))
           append (loop for name in (names words axes)
                        for from in (numbers key)
                        for place from 0
                              collect (list name key place from
                                         (if (eq key 'size) (max most (* 4 from)) most)))))))

(defun box-with-value (box key place value)
  "Return BOX with VALUE at PLACE of the clause KEY, or NIL if that is no box."
  (flet ((changed-list (list) (loop for number in list for i from 0
                                    collect (if (= i place) value number))))
    (let ((new (loop for (name . part) in box
                     collect (cons name
                                   (cond ((not (eq name key)) part)
                                         ((consp (first part)) (list (changed-list (first part))))
                                         (t (changed-list part)))))))
      (and (or (some #'plusp (first (box-part new 'force-needed)))
               (some #'plusp (first (box-part new 'velocity-needed))))
           (every (lambda (mass size) (<= (* 2 (abs mass)) size))
                  (box-part new 'centre) (box-part new 'size))
           new))))

(defun scan-places (from far end count state)
  "Return about COUNT places from FROM to FAR, the nearest first: evenly spread, near FROM, and
near END."
  (flet ((between (share) (+ from (* share (- far from))))
         (small (digits) (expt 10d0 (- (random digits state)))))
    (let ((places (append (loop for i from 1 to (floor count 2)
                                collect (between (/ i (floor count 2) 1d0)))
                          (loop repeat (floor count 4) collect (between (small 9d0)))
                          (loop repeat (floor count 4)
                                collect (+ end (* (- far end) (small 6d0)))))))
      (remove-if (lambda (place) (< 0 place 1d-6))
                 (sort places (if (< from far) #'< #'>))))))

(defun nearest-by-halving (from places true-p)
  "Return the first of PLACES of which TRUE-P is true, or rather where it becomes so between it
and the one before; or NIL."
  (loop for before = from then place
        for place in places
        when (funcall true-p place)
          return (loop repeat 60
                       for middle = (/ (+ before place) 2)
                       do (if (funcall true-p middle) (setf place middle) (setf before middle))
                       finally (return place))))

(defun value-fault (box value change goal count state)
  "Return what is wrong with CHANGE, or with there being none, as that of VALUE, a list as
VALUE-CLAUSES returns, with which GOAL is true of the plan for BOX: at COUNT places each way."
  (destructuring-bind (name key place from most) value
    (flet ((true-p (number)
             (let ((new (box-with-value box key place (coerce number 'double-float))))
               (and new (funcall goal (supergrip:plan new)) t))))
      (let* ((limit (and change (supergrip:change-limit change)))
             (size (and change (supergrip:change-size change)))
             (least (if (eq key 'size) (min from 1d-6) 0))
             (found (loop for end in (list most least)
                          for far = (cond ((null size) end)
                                          ((> end from) (min end (+ from size)))
                                          (t (max end (- from size))))
                          for nearest = (and (/= from far)
                                             (nearest-by-halving
                                              from (scan-places from far end count state) #'true-p))
                          ;; What changes at once is looked at from a millionth on.
                          when nearest collect (if (zerop from) (max nearest 1d-6) nearest)))
             (nearest (and found (reduce #'min found :key (lambda (place) (abs (- place from)))))))
        (cond ((null change) (and found (list name :missed found)))
              ((not (true-p limit)) (list name limit :not-true))
              ((not (true-p (supergrip:change-to change)))
               (list name (supergrip:change-to change) :not-true-as-printed))
              ((and nearest (> size (+ nearest (* 1d-6 (max 1 nearest)))))
               (list name :nearer found limit))
              ((and (> size 1d-6) (true-p (- limit (* 1d-9 (signum (- limit from)) (max 1 limit)))))
               (list name limit :not-the-first)))))))

(defun changes-fault (box changes stepped values goal count state)
  "Return what is wrong with CHANGES, those of the VALUES of BOX with which GOAL is true of its
plan; those with names in STEPPED may be."
  (loop for value in values
        for change = (find (first value) changes :key #'supergrip:change-what :test #'string=)
        thereis (and (not (member (first value) stepped :test #'string=))
                     (value-fault box value change goal count state))))

(defun choice-scan-fault (box count state)
  "Return what EXPLAIN-BEST says wrong of what would change the choice for BOX."
  (let* ((plan (supergrip:plan box))
         (grasp (supergrip:plan-grasp plan)) (matching (supergrip:plan-matching plan))
         (choice (supergrip:explain-choice plan)))
    (changes-fault box (supergrip:choice-changes choice) (supergrip:choice-stepped choice)
                   (remove 'size (value-clauses box) :key #'second)
                   (lambda (other)
                     (not (and (equal grasp (supergrip:plan-grasp other))
                               (equal matching (supergrip:plan-matching other)))))
                   count state)))

(defun requirement-fault (box answer goal count state)
  "Return what is wrong with ANSWER, the requirement of BOX for GOAL."
  (changes-fault box (supergrip:requirement-changes answer) (supergrip:requirement-stepped answer)
                 (value-clauses box :all (eq :fact (supergrip:requirement-kind answer)))
                 goal count state))

(defun grasp-scan-fault (box count state)
  "Return what REQUIRES says wrong of what would make a random grasp the best for BOX."
  (let* ((grasp (random-element (mapcar #'supergrip:grasp-name (shipped-grasps)) state))
         (goal (lambda (plan) (equal grasp (supergrip:plan-grasp plan))))
         (answer (supergrip:explain-requirement grasp (supergrip:plan box))))
    (cond ((supergrip:requirement-met answer)
           (and (not (funcall goal (supergrip:plan box))) (list grasp :met)))
          ((requirement-fault box answer goal count state))
          ((faces-fault box (supergrip:requirement-faces answer) goal)))))

(defun fact-goal (fact)
  "Return a function of a plan that is true if FACT, words and a list of faces, is known in it."
  (let ((words (mapcar #'string (remove-if #'consp fact)))
        (faces (mapcar #'string (find-if #'consp fact))))
    (lambda (plan)
      (flet ((same-p (list) (null (set-exclusive-or list faces :test #'string=))))
        (loop for assertion in (supergrip:plan-assertions plan)
                thereis (and (equal words (remove-if #'consp assertion))
                             (or (null faces)
                                 (some #'same-p (remove-if-not #'consp assertion)))))))))

(defun fact-scan-fault (box count state)
  (let* ((fact (random-element '((small (x1 x2)) (narrow (z1 z2)) (large (y2 y1)) (slippery)
                                 (constrained (x1)) (parallel (z1 z2)) (adjacent (z1 x1))
                                 (corner (z1 y1 x1)) (wide (z2 z1)) (object has free corners))
                               state))
         (goal (fact-goal fact))
         (answer (supergrip:explain-requirement fact (supergrip:plan box))))
    (if (supergrip:requirement-met answer)
        (and (not (funcall goal (supergrip:plan box))) (list fact :met))
        (or (requirement-fault box answer goal count state)
            (faces-fault box (supergrip:requirement-faces answer) goal)))))

(defun faces-fault (box changes goal)
  "Return what is wrong with CHANGES, those of constrained faces with which GOAL is true of BOX:
one does not do it, or a subset of its faces does, or nothing is said where all faces freed would
do."
  (flet ((true-p (faces)
           (let ((clause (cons 'constrained (mapcar #'make-symbol faces))))
             (funcall goal (supergrip:plan (substitute clause 'constrained box :key #'first))))))
    (let ((now (mapcar #'string (box-part box 'constrained))))
      (or (loop for change in changes
                for to = (supergrip:change-to change)
                for moved = (set-exclusive-or now to :test #'string=)
                unless (true-p to) return (list to :does-nothing)
                do (dolist (face (and (rest moved) moved))
                     (when (true-p (set-exclusive-or to (list face) :test #'string=))
                       (return-from faces-fault (list to :too-many face)))))
          (and (null changes)
               (loop for face in '("X1" "X2" "Y1" "Y2" "Z1" "Z2")
                     when (true-p (set-exclusive-or now (list face) :test #'string=))
                       return (list :missed face)))))))

(defun scan-fault (box count state)
  "Return what EXPLAIN-BEST or REQUIRES says wrong of BOX, looked at COUNT places of each value
each way."
  (or (choice-scan-fault box count state)
      (grasp-scan-fault box count state)
      (fact-scan-fault box count state)))

(defun even-box (state)
  "Return the description of a box of round sizes, two or three of them the same, whose grasps
often tie."
  (let* ((a (1+ (random 12 state))) (b (if (zerop (random 3 state)) a (1+ (random 12 state))))
         (force (random-need state)) (velocity (random-need state)))
    (when (and (every #'zerop force) (every #'zerop velocity))
      (setf (first force) 1))
    `((size ,@(random-element (list (list a a b) (list a b a) (list b a a)) state))
      (weight ,(/ (random 20 state) 10d0)) (u ,(/ (random 20 state) 10d0))
      (v ,(/ (random 5 state) 10d0)) (constrained ,@(random-faces state))
      (force-needed ,force) (velocity-needed ,velocity))))

(test no-smaller-change-escapes
  (let ((state (sb-ext:seed-random-state 71)))
    (is (null (first-fault (lambda (box) (scan-fault box 40 state))
                           (append (random-boxes 25 72)
                                   (loop repeat 10 collect (even-box state))))))))

;;; What is said

(defun required-lines (what &optional (plan (pencil-plan)))
  (printed (supergrip:requires what plan)))

(test of-equal-dimensions-the-one-that-decides-is-named
  (with-knowledge-restored
    (supergrip:edit '(setq gripper '(palm-depth 12 finger-length 3.2 finger-dist 6.05 finger-spread
                                     1.7375
                                    finger-width 0.3 nail 0.3 dist-pinch 12 width-hand 8 reach-u
                                     4.85
                                    reach-c 4.825 slippery-u 0.1)))
    (loop for (what . line)
            in '(((large (z1 z2)) . "  the size along Z: 12, not 2 (no less than DIST-PINCH, 12)")
                 ((small (y1 y2))
                  . "  the size along Y: 0.299, not 2 (less than FINGER-WIDTH, 0.3)"))
          do (is (equal line (second (required-lines what)))))
    (supergrip:edit '(setq pinch-2-adjacent
                      '(used-surfaces (n1 n2 a2) conditions ((dist '(n1 n2)) > 8)
                        offset (0 0 0 0 0 0) wrench (1 1 1 1 1 1) twist (1 1 1 1 1 1))))
    (supergrip:edit '(rule grip12 (if (opposed (s1 s2))) (then (try pinch-2-adjacent))))
    (is (equal "  the size along Y: 8.01, not 2; then PINCH-2-ADJACENT (Y2 Y1 X2 X1 Z2 Z1)"
               (second (required-lines 'pinch-2-adjacent)))
        "a form may hold the value of a dimension")))

(test requires-tells-the-least-changes
  (loop for (what . lines) in
        '(((small (y2 y1)) "(SMALL (Y2 Y1)) would hold with one of these changes:"
           "  the size along Y: 0.299, not 2 (less than FINGER-WIDTH, 0.3)")
          ("(LARGE (Z1 Z2))" "(LARGE (Z1 Z2)) would hold with one of these changes:"
           "  the size along Z: 12, not 2 (no less than DIST-PINCH, 12)")
          ((parallel (z1 z2)) "(PARALLEL (Z1 Z2)) would hold with one of these changes:"
           "  Z2 free")
          ((constrained (y1)) "(CONSTRAINED (Y1)) would hold with one of these changes:"
           "  Y1 constrained")
          ((parallel (y1 y2)) "(PARALLEL (Y1 Y2)) holds already.")
          ((wide (z1 z2))
           "No change of one value, or of constrained faces, makes (WIDE (Z1 Z2)) hold.")
          ((object has no parallel surfaces)
           "not (OBJECT HAS PARALLEL SURFACES) would hold with one of these changes:"
           "  the size along Z: 0.299, not 2 (less than FINGER-WIDTH, 0.3)"
           "  the friction u: 0.1, not 0.8 (no more than SLIPPERY-U, 0.1)"
           "  the size along X: 0.299, not 12 (less than FINGER-WIDTH, 0.3)"
           "  Y2 constrained" "  Y1 constrained" "  X2 and Z1 constrained")
          (grip2 "RULE GRIP2 would fire with one of these changes:"
           "  the friction u: 0.1, not 0.8 (no more than SLIPPERY-U, 0.1)")
          (grip6 "RULE GRIP6 would fire with one of these changes:"
           "  Y2 and Z1 constrained" "  Y1 and Z1 constrained" "  Y1 and Y2 constrained"
           "  X2 and Y2 constrained" "  X2 and Y1 constrained")
          (grip11 "RULE GRIP11 fires already.")
          (pinch-3-parallel "PINCH-3-PARALLEL is the best grasp already.")
          (pinch-3-u-shape "PINCH-3-U-SHAPE would be the best grasp with one of these changes:"
           "  the force needed along Y: 0.699, not 0.8; then PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1)"
           "  the size along X: 10.3, not 12; then PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1)"
           "  the torsional friction v: 0.11, not 0.2; then PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1)"
           "  the size along Y: 0.343, not 2; then PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1)")
          (pinch-2-parallel
           "No change of one value, or of constrained faces, makes PINCH-2-PARALLEL the best grasp."
           "PINCH-2-PARALLEL is possible, if it is tried.")
          (pinch-3-corner
           "No change of one value, or of constrained faces, makes PINCH-3-CORNER the best grasp."
           "PINCH-3-CORNER would be possible, if it is tried, with one of these changes:"
           "  the friction u: 1.1, not 0.8" "  the size along X: 2.52, not 12"))
        do (is (equal lines (required-lines what)) "~a" what))
  (is (equal '("No change of one value, or of constrained faces, makes PINCH-3-CORNER the best grasp."
               "No change of one value, or of constrained faces, makes PINCH-3-CORNER possible.")
             (required-lines 'pinch-3-corner (plan-of '(50 50 50) 0.3d0 '(x1 x2 y1 y2 z1))))))

(test requires-answers-with-data
  (let* ((answer (supergrip:explain-requirement '(small (y2 y1)) (pencil-plan)))
         (change (first (supergrip:requirement-changes answer))))
    (is (eq :fact (supergrip:requirement-kind answer)))
    (is (not (supergrip:requirement-met answer)))
    (is (= (supergrip:change-limit change) (- 0.3d0 (expt 2d0 -54))) "the double before 0.3")
    (is (equal '("less than" "FINGER-WIDTH" 0.3d0) (supergrip:change-threshold change)))
    (is (equal '(0.299d0 2d0 t)
               (list (supergrip:change-to change) (supergrip:change-from change)
                     (null (supergrip:requirement-stepped answer))))))
  (let ((faces (supergrip:requirement-faces
                (supergrip:explain-requirement '(parallel (z1 z2)) (pencil-plan)))))
    (is (equal '((("Z2" "X1") ("X1")))
               (loop for change in faces
                     collect (list (supergrip:change-from change) (supergrip:change-to change))))))
  (is (equal (supergrip:requirement-changes
              (supergrip:explain-requirement 'pinch-3-parallel
                                             (supergrip:try-grasp 'pinch-3-corner (paper-box))))
             '())
      "a question is about the rules, whatever was tried alone"))

(test requires-refuses-what-is-neither-fact-nor-rule-nor-grasp
  (is (search "there is no rule or grasp GRIP77"
              (error-text (supergrip:requires 'grip77 (pencil-plan)))))
  (is (search "SMALL takes 2 different surfaces"
              (error-text (supergrip:requires '(small (y2)) (pencil-plan)))))
  (is (search "there is no plan yet"
              (let ((supergrip:*plan* nil)) (error-text (supergrip:requires 'grip7))))))

(test requires-adds-and-drops-declared-facts
  (let ((knowledge (text-knowledge "(INPUT FRAGILE (s1)) (INPUT WET)
(RULE R (IF (FRAGILE (s1)) (NOT WET)) (THEN (REMEMBER CAREFUL)))"
                                   (format nil "~a~%~a" *small-gripper* (grasp-text)))))
    (flet ((lines (what &rest facts)
             (required-lines what (supergrip:plan (append (small-box 1) `((facts ,@facts)))
                                                  :knowledge knowledge))))
      (is (equal '("(CAREFUL) would hold with one of these changes:" "  without the fact (WET)")
                 (lines '(careful) '(wet) '(fragile (z1)))))
      (is (equal '("RULE R would fire with one of these changes:"
                   "  with the fact (FRAGILE (X1))" "  with the fact (FRAGILE (X2))"
                   "  with the fact (FRAGILE (Y1))" "  with the fact (FRAGILE (Y2))"
                   "  with the fact (FRAGILE (Z1))" "  with the fact (FRAGILE (Z2))")
                 (sort-after-first (lines 'r))))
      (is (equal '("No change of one value, of one fact, or of constrained faces, makes (CAREFUL) hold.")
                 (lines '(careful) '(wet)))))))

(defun sort-after-first (lines)
  (cons (first lines) (sort (copy-list (rest lines)) #'string<)))

;;; What a scan by steps would miss, and where only steps are left

(defun change-of (what answer)
  (find what (supergrip:choice-changes answer) :key #'supergrip:change-what :test #'string=))

(defun choice-with (conditions u)
  "Return the CHOICE on a grasp alone that has CONDITIONS, on a box with friction U."
  (supergrip:explain-choice
   (supergrip:try-grasp "G" (small-box u) :knowledge (small-knowledge :conditions conditions))))

(test a-gap-between-two-steps-is-found
  (loop for (conditions . limit) in '(("((u < 1/2) OR (u > 0.5000001))" . 0.5d0)
                                      ("(((* u u) < 1/4) OR (u > 0.50001))" . 0.5d0)
                                      ("(NOT ((ABS (- u 0.7)) < 1/1000000))" . 0.699999d0))
        for choice = (choice-with conditions 0.4d0)
        for change = (change-of "the friction u" choice)
        do (is (close-to limit (supergrip:change-limit change) 1d-9) "~a" conditions)
           (is (null (supergrip:choice-stepped choice)))))

(test what-has-no-bounds-is-looked-at-in-steps
  (let ((supergrip::*operators* supergrip::*operators*))
    (flet ((check (stepped)
             (let ((choice (choice-with "((LN u) < -1/2)" 0.5d0)))
               (is (close-to (exp -0.5d0)
                             (supergrip:change-limit (change-of "the friction u" choice))))
               (is (equal stepped (supergrip:choice-stepped choice)))
               (is (eq (and stepped t)
                       (and (search "Looked at only in 500 steps: the friction u."
                                    (with-output-to-string (out)
                                      (supergrip:write-answer choice out)))
                            t))))))
      (supergrip::define-operator "LN" (x) (log x) :when (> x 0d0))
      (check '("the friction u"))
      (supergrip::define-operator "LN" (x) (log x) :when (> x 0d0) :monotone t :slope (/ dx x))
      (check '()))))

(test an-assertion-of-ones-own-has-an-exact-threshold
  (let ((supergrip::*inputs* supergrip::*inputs*))
    (supergrip::define-input "HEAVY" (:box box) (most "WIDTH-HAND")
      (> (supergrip:box-weight box) (* most 1/3))
      "it is heavy")
    (let* ((knowledge (supergrip:load-knowledge))
           (answer (supergrip:explain-requirement
                    '(heavy) (supergrip:plan (paper-box) :knowledge knowledge)))
           (change (first (supergrip:requirement-changes answer))))
      (is (= 2.67d0 (supergrip:change-to change)))
      (is (< (* 8 1/3) (rational (supergrip:change-limit change)) (+ (* 8 1/3) 1d-15))))))
