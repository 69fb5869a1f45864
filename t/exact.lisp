;;;; exact.lisp -- exact mode: what the contacts can really do decides, and the choice is the best
;;;; by it.

(in-package :supergrip-test)
(define-suite exact
  "Exact mode: what the contacts can really do decides, and the choice is the best by it.")

(defun exact-plan (box &rest keys) (apply #'supergrip:plan box :index :exact keys))

(defun needed (plan) (coerce (supergrip:box-force-needed (supergrip:plan-box plan)) 'list))

;;; What is possible

(defun dropped (plan)
  "Return the possible candidates of PLAN that can't hold the weight."
  (remove-if (lambda (candidate)
               (destructuring-bind (contacts u v need gravity)
                   (candidate-case candidate plan '(1 1 1 1 1 1))
                 (declare (ignore need))
                 (supergrip:holds-p contacts u v gravity)))
             (supergrip:plan-possible plan)))

(test nothing-possible-drops-its-box
  (for-random-boxes (box 150 31)
    (dolist (index '(:paper :exact))
      (let ((plan (supergrip:plan box :index index)))
        (unless (null (dropped plan)) (fail "~s ~s" index box)))))
  (pass))

(defun moving-contacts-knowledge ()
  "Return knowledge of a grasp whose contacts vary with the box, as do its WRENCH and its TWIST."
  (text-knowledge *good-rules*
                  (format nil "~a~a" *small-gripper*
                          (grasp-text :contacts "((N1 (/ (DIST '(O1 O2)) 5) 0)
                                                  (N1 (- (/ (DIST '(O1 O2)) 4)) (/ (DIST '(A1 A2)) 7))
                                                  (N2 0 (/ (DIST '(A1 A2)) 6)))"
                                      :wrench "(1 (SQRT (+ u 1)) (* 3 u) (+ v 0.3) (SQRT (+ v 2))
                                                (/ 9 (DIST '(N1 N2))))"
                                      :twist "((SQRT (+ 1 v)) (* u 0.9) 1 (/ 3 (DIST '(O1 O2))) 1 1)"))))

(test contacts-are-where-they-are-whatever-was-computed-after-them
  "Exact statics and refining know them as CANDIDATE-CONTACTS does."
  (let ((knowledge (moving-contacts-knowledge)) (compared 0))
    (dolist (size '((3 4 5) (6 2 3) (5 5 2)))
      (dolist (index '(:paper :exact))
        (let ((plan (supergrip:plan (with-entries *good-box* :size size :constrained '(:z2))
                                    :knowledge knowledge :index index)))
          (dolist (candidate (supergrip:plan-possible plan))
            (incf compared)
            (multiple-value-bind (upper lower) (supergrip:candidate-exact-radius candidate plan)
              (multiple-value-bind (true-upper true-lower)
                  (exact-radius-of (candidate-case candidate plan (needed plan)))
                (is (<= lower (+ true-upper 1d-9)))
                (is (<= true-lower (+ upper 1d-9))))))
          (let* ((refinement (supergrip:refine plan :count 1 :regions 5))
                 (candidate (supergrip:refinement-candidate refinement)))
            (multiple-value-bind (upper lower)
                (exact-radius-of (candidate-case candidate plan (needed plan)))
              (destructuring-bind (sure most) (supergrip:refinement-radius-before refinement)
                (is (<= sure (+ upper 1d-9)))
                (is (<= lower (+ most 1d-9)))))))))
    (is (> compared 8))))

(test an-exact-plan-agrees-with-itself
  (for-random-boxes (box 150 32)
    (let* ((plan (exact-plan box)) (best (supergrip:plan-best plan)))
      (dolist (candidate (supergrip:plan-possible plan))
        (is (<= (supergrip:candidate-quality candidate) (supergrip:candidate-quality best)))
        (is (not (and (eq candidate best) (supergrip:candidate-bound-p best))))
        (unless (supergrip:candidate-bound-p candidate)
          (multiple-value-bind (upper lower) (supergrip:candidate-exact-radius candidate plan)
            (when lower
              (is (= lower (supergrip:candidate-force-radius candidate)))
              (is (<= (- upper (max (* 0.01d0 upper) 0.002d0) 1d-9) lower upper)
                  "~s ~a ~a" box lower upper))))))))

(test what-contacts-close-is-closed-where-a-formula-gives-up
  (let ((box '((size 5 4 3.2) (weight 0.05) (u 0.8) (v 0.2) (constrained z2 x1 y1)
               (force-needed (1 1 1 1 1 1)) (velocity-needed (0 0 0 0 0 0)))))
    (flet ((outcomes (index)
             (mapcar #'supergrip:candidate-outcome
                     (supergrip:plan-candidates (supergrip:try-grasp "PINCH-3-CORNER" box
                                                                     :index index)))))
      (is (member :open (outcomes :paper)))
      (is (< (count :open (outcomes :exact)) (count :open (outcomes :paper)))))))

(test a-candidate-is-asked-about-in-the-plan-that-is-given
  "What a plan has certified is said again; in a plan for another box the same candidate is
another."
  (let* ((plan (exact-plan (paper-box))) (best (supergrip:plan-best plan))
         (other (supergrip:plan (changed-box :u 0.5d0))))
    (flet ((radius (plan)
             (multiple-value-list (supergrip:candidate-exact-radius best plan))))
      (is (equal (radius (pencil-plan)) (radius plan)))
      (is (< (first (radius other)) (* 0.9d0 (first (radius plan))))))))

(test half-turns-are-told-apart-by-the-weight
  (flet ((tried (index)
           (length (supergrip:plan-candidates
                    (supergrip:try-grasp "PINCH-3-PARALLEL" (paper-box) :index index)))))
    (is (< (tried :paper) (tried :exact)))))

(test a-task-without-forces-has-no-radius
  (let* ((plan (exact-plan '((size 12 2 2) (weight 0.2) (u 0.8) (v 0.2) (constrained z2 x1)
                             (force-needed (0 0 0 0 0 0)) (velocity-needed (1 1 1 1 1 1)))))
         (best (supergrip:plan-best plan))
         (record (supergrip::plan-record plan)))
    (is (null (supergrip:candidate-force-radius best)))
    (is (null (supergrip:candidate-exact-radius best plan)))
    (is (= (supergrip:candidate-quality best) (supergrip:candidate-velocity-radius best)))
    (is (null (getf record :beta)))
    (is (plusp (getf record :squeeze)))))

;;; The choice, candidate by candidate

(defun greatest-wrench (contacts u v motion)
  "Return the wrench of the fingers at CONTACTS that does most power in MOTION."
  (loop with turn = (nthcdr 3 motion) and sum = '(0 0 0 0 0 0)
        for (place normal) in contacts
        for velocity = (mapcar #'+ (subseq motion 0 3) (vector-product turn place))
        for along = (dot velocity normal)
        for across = (mapcar (lambda (g n) (- g (* along n))) velocity normal)
        for slip = (norm across)
        for twist = (dot turn normal)
        for force = (mapcar (lambda (n g) (+ n (if (plusp slip) (* u (/ g slip)) 0))) normal across)
        when (plusp (+ along (* u slip) (* v (abs twist))))
          do (setf sum (mapcar #'+ sum
                               (append force
                                       (mapcar (lambda (torque n) (+ torque (* v (signum twist) n)))
                                               (vector-product place force) normal))))
        finally (return sum)))

(defun unit (x) (let ((length (norm x))) (mapcar (lambda (each) (/ each length)) x)))

(defun ways-to-look ()
  "Return the twelve directions along six axes, and the sixty between two of them."
  (flet ((ways (k) (loop for sign in '(1 -1)
                         collect (loop for l below 6 collect (if (= k l) sign 0)))))
    (loop for k below 6
          append (ways k)
          append (loop for l from (1+ k) below 6
                       append (loop for a in (ways k)
                                    append (loop for b in (ways l)
                                                 collect (unit (mapcar #'+ a b))))))))

(defun reach-of (case)
  "Return how far the fingers of CASE reach on each axis, the lesser way: in these units all ways
are alike."
  (destructuring-bind (contacts u v &rest rest) case
    (declare (ignore rest))
    (loop for k below 6
          collect (loop for way in (ways-to-look)
                        when (= 1 (abs (nth k way)))
                          minimize (max 1d-3 (power-of contacts u v way))))))

(defun ratio-met (case x reach)
  "Return the power / demand of CASE in the motion X, in units of REACH, and its slope; NIL if
nothing is demanded there."
  (destructuring-bind (contacts u v need gravity) case
    (let* ((motion (mapcar #'/ x reach)) (demand (norm (mapcar #'* need motion))))
      (when (plusp demand)
        (let* ((wrench (mapcar #'+ gravity (greatest-wrench contacts u v motion)))
               (ratio (/ (dot wrench motion) demand)))
          (values ratio (mapcar (lambda (w f q r) (/ (- w (/ (* ratio f f q) demand)) r))
                                wrench need motion reach)))))))

(defun least-ratio-met (case starts)
  "Return the least power / demand of CASE, which needs something, in many motions: 72 ways, and
forty steps down from each of the STARTS best.  The radius is not above it."
  (let* ((least nil) (reach (reach-of case)))
    (flet ((look (x)
             (multiple-value-bind (ratio slope) (ratio-met case x reach)
               (when (and ratio (or (null least) (< ratio least)))
                 (setf least ratio))
               (values ratio slope))))
      (let ((best (sort (loop for way in (ways-to-look)
                              for ratio = (look way)
                              when ratio collect (cons ratio way))
                        #'< :key #'first)))
        (loop for (nil . x) in best
              repeat starts
              do (loop repeat 40
                       for length = 0.25d0 then (* 0.88d0 length)
                       for slope = (nth-value 1 (look x))
                       while (and slope (plusp (norm slope)))
                       do (setf x (unit (mapcar (lambda (x s) (- x (* length s)))
                                                x (unit slope))))))
        least))))

(defun alike-p (a b plan)
  "True if the candidates A and B of PLAN have the same contacts, in whatever order."
  (flet ((contacts (candidate)
           (first (candidate-case candidate plan nil))))
    (null (set-exclusive-or (contacts a) (contacts b) :test #'equal))))

(defun first-alike (candidate plan)
  "Return the first of the possible candidates of PLAN, as they were tried, with the contacts of
CANDIDATE.  With its fingers in another order, a proof may go another way."
  (find-if (lambda (other)
             (and (eq :possible (supergrip:candidate-outcome other))
                  (alike-p other candidate plan)))
           (supergrip:plan-candidates plan)))

(defun radius-alone (candidate plan starts)
  "Return what u_w of CANDIDATE of PLAN, by the exact index, is if it is certified alone; what is
wrong with that, or NIL; and the least ratio met, from STARTS, over its upper value."
  (let ((case (candidate-case (first-alike candidate plan) plan (needed plan))))
    (multiple-value-bind (upper lower) (exact-radius-of case)
      (let ((met (least-ratio-met case starts)))
        (values (or lower (supergrip:candidate-sure candidate plan))
                (cond ((> (or lower 0) (+ met 1d-9))
                       (format nil "~a is certified, a motion gives ~a" lower met))
                      ((minusp upper) "it drops the box"))
                (/ met (max upper 1d-9)))))))

(defun quality-with (candidate plan radius)
  "Return Q of CANDIDATE of PLAN if its u_w is RADIUS, NIL if no force is needed."
  (let ((u-t (supergrip:candidate-velocity-radius candidate)) (gamma (supergrip:plan-gamma plan)))
    (cond ((null u-t) radius)
          ((null radius) u-t)
          (t (+ (* gamma u-t) (* (- 1 gamma) radius))))))

(defun choice-faults (plan starts)
  "Return what is wrong with the choice of PLAN, by the exact index, if each possible candidate is
certified alone and looked at from STARTS; how many there are; and the last values of RADIUS-ALONE."
  (loop with force = (notevery #'zerop (needed plan))
        with best = (supergrip:plan-best plan)
        for candidate in (supergrip:plan-possible plan)
        for (radius fault ratio) = (and force (multiple-value-list
                                               (radius-alone candidate plan starts)))
        for alone = (quality-with candidate plan radius)
        for given = (supergrip:candidate-quality candidate)
        count t into count
        when ratio collect ratio into ratios
        when fault collect fault into faults
        unless (<= alone (+ 1d-9 (if (supergrip:candidate-bound-p candidate)
                                     (min given (supergrip:plan-quality plan))
                                     given)))
          collect (format nil "~a: certified alone ~a" candidate alone) into faults
        when (and (eq candidate best) (not (close-to alone given)))
          collect (format nil "~a: the choice is ~a" candidate alone) into faults
        finally (return (values faults count ratios))))

(test the-choice-is-the-best-of-all-certified-one-by-one
  (let ((several 0))
    (for-random-boxes (box 120 76)
      (multiple-value-bind (faults count) (choice-faults (exact-plan box) 2)
        (is (null faults) "~s:~{ ~a~}" box faults)
        (when (> count 1) (incf several))))
    (is (< 10 several))))

;;; The pencil

(test the-pencil-by-the-exact-index
  (let* ((plan (exact-plan (paper-box))) (best (supergrip:plan-best plan))
         (record (supergrip::plan-record plan)))
    (is (equal "PINCH-3-PARALLEL" (supergrip:plan-grasp plan)))
    (destructuring-bind (lower upper) (getf record :beta)
      (is (<= lower 0.880d0 upper))      ; by cone programming
      (is (= lower (getf record :u-w)))
      (is (<= (- (* 0.99d0 upper) 1d-9) lower)))
    (is (< 1.12d0 (getf record :squeeze) 1.15d0))
    (is (minusp (getf record :friction-margin)))
    (is (equal '(:beta :squeeze :friction-margin)
               (last (loop for key in record by #'cddr collect key) 3)))
    (is (= (position (reduce #'max (multiple-value-bind (upper lower worst)
                                       (supergrip:candidate-exact-radius best plan)
                                     (declare (ignore upper lower))
                                     worst)
                             :key #'abs)
                     (nth-value 2 (supergrip:candidate-exact-radius best plan)) :key #'abs)
           (supergrip::%candidate-force-limit best)))
    (is (close-to (first (multiple-value-list (supergrip:candidate-exact-radius best plan)))
                  (reduce #'+ (supergrip:candidate-powers
                               best (nth-value 2 (supergrip:candidate-exact-radius best plan))
                               plan))))
    (is (equal record (json-record (json-line record))))))

(test candidates-with-the-same-contacts-have-the-same-numbers
  "In whatever order their fingers come: they are looked at together."
  (let ((same 0))
    (for-random-boxes (box 40 15)
      (let ((plan (exact-plan box)))
        (loop for (a . others) on (supergrip:plan-possible plan)
              do (dolist (b others)
                   (when (alike-p a b plan)
                     (incf same)
                     (is (eql (supergrip:candidate-force-radius a)
                              (supergrip:candidate-force-radius b)))
                     (is (eq (supergrip:candidate-bound-p a)
                             (supergrip:candidate-bound-p b))))))))
    (is (< 3 same)))
  ;; Two fingers in one place count twice.
  (flet ((grip (&rest places)
           (let ((grip (supergrip-statics:make-grip 3 0.5d0 0.2d0)))
             (loop for y in places
                   for index from 0
                   do (supergrip-statics:set-finger grip index 0d0 y 0d0 0d0 (- y) 0d0))
             grip)))
    (is (supergrip-statics:same-contacts-p (grip 1d0 1d0 -1d0) (grip -1d0 1d0 1d0)))
    (is (not (supergrip-statics:same-contacts-p (grip 1d0 1d0 -1d0) (grip -1d0 -1d0 1d0))))))

;;; Explanations: each figure is computed in another way

(defun powers-at (case motion)
  "Return what pressing, friction, torques and the weight of CASE do at most in MOTION, four
numbers."
  (destructuring-bind (contacts u v need gravity) case
    (declare (ignore need))
    (loop with turn = (nthcdr 3 motion)
          for (place normal) in contacts
          for velocity = (mapcar #'+ (subseq motion 0 3) (vector-product turn place))
          for along = (dot velocity normal)
          for slip = (* u (sqrt (max 0 (- (dot velocity velocity) (* along along)))))
          for twist = (* v (abs (dot turn normal)))
          when (plusp (+ along slip twist))
            sum along into pressing and sum slip into friction and sum twist into torque
          finally (return (list pressing friction torque (dot gravity motion))))))

(test what-limits-an-exact-choice-is-told-with-its-figures
  (let* ((plan (exact-plan (paper-box))) (best (supergrip:plan-best plan))
         (case (candidate-case best plan (needed plan)))
         (lines (printed (supergrip:explain-best plan))))
    (multiple-value-bind (upper lower worst) (exact-radius-of case)
      (is (<= lower 0.880d0 upper 0.8885d0)) ; by cone programming, and the gap
      (is (equal (list (format nil "Force is limited where the box is pushed along -Y and turned ~
                                    about +Y: radius ~,3f, proved, and at most ~,3f." lower upper)
                       (format nil "  There pressing gives ~,3f, friction ~,3f, the fingertips' ~
                                    torque ~,3f, the weight ~,3f; the task needs 1."
                               . #1=((first (powers-at case worst)) (second (powers-at case worst))
                                     (third (powers-at case worst))
                                     (fourth (powers-at case worst)))))
                 (subseq lines 1 3)))
      (is (close-to upper (+ . #1#)))
      (is (find (format nil "The contacts bear at most ~,4f of the force asked for, which is ~
                             enough if the needs only say what matters more." upper)
                lines :test #'string=))
      (is (notany (lambda (line) (search "Exactly, " line)) lines)))))

(test what-is-told-of-the-default-choice-is-true
  "What is sure, what is exact, and what is asked for, against a search over many motions."
  (let ((told 0))
    (for-random-boxes (box 100 12)
      (let* ((plan (supergrip:plan box)) (best (supergrip:plan-best plan)))
        (when (and best (notevery #'zerop (needed plan)))
          (let* ((choice (supergrip:explain-choice plan))
                 (upper (supergrip::exact-limit-upper (supergrip::choice-truth choice)))
                 (met (least-ratio-met (candidate-case best plan (needed plan)) 10))
                 (lines (printed (supergrip:write-answer choice *standard-output*)))
                 (short (find "The contacts bear at most " lines :test #'search)))
            (is (<= (supergrip:choice-sure choice) (+ met 1d-9)))
            (is (<= (or (supergrip::exact-limit-certified (supergrip::choice-truth choice)) 0)
                    (+ met 1d-9)))
            (is (eq (and short t) (< upper (- 1 1d-9))))
            (when short (incf told))))))
    (is (< 3 told))))

(test grasps-that-promise-more-than-their-contacts-can-do-are-told-of
  (let ((knowledge (text-knowledge "(RULE R (IF (OPPOSED (s1 s2))) (THEN (TRY G) (KEEP BEST)))"
                                   (format nil "~a~%~a" *small-gripper*
                                           (grasp-text :wrench "(9 9 9 9 9 9)")))))
    (is (search "more than the contacts can exert."
                (format nil "~{~a~}"
                        (printed (supergrip:explain-best
                                  (supergrip:plan (changed-box :size 2 2 2)
                                                  :knowledge knowledge))))))))

(test a-bound-of-q-is-told-as-one
  (let* ((plan (exact-plan (paper-box)))
         (other (find-if #'supergrip:candidate-bound-p (supergrip:plan-possible plan)))
         (bound (supergrip:candidate-quality other)))
    (is (equal (format nil "~a (~{~a~^ ~}): its Q is at most ~,3f, at least ~a below ~a (~{~a~^ ~
                            ~})."
                       (supergrip:candidate-grasp other) (supergrip:candidate-matching other) bound
                       (supergrip::number-text (- (supergrip:plan-quality plan) bound))
                       (supergrip:plan-grasp plan) (supergrip:plan-matching plan))
               (why-not-line plan (supergrip:candidate-grasp other)
                             (supergrip:candidate-matching other))))
    (is (<= (quality-with other plan (radius-alone other plan 10)) bound))))

(test what-contacts-do-not-close-needs-the-friction-that-is-told
  (let* ((plan (supergrip:try-grasp "PINCH-3-CORNER" (paper-box) :index :exact))
         (other (find :open (supergrip:plan-rejected plan) :key #'supergrip:candidate-outcome)))
    (is (equal "open: the contacts don't close on this shape; needs u > 0.9535, has 0.8"
               (nth-value 1 (supergrip:candidate-failure other plan))))
    (destructuring-bind (contacts u v &rest rest) (candidate-case other plan '(1 1 1 1 1 1))
      (declare (ignore u rest))
      (flet ((radius (u) (supergrip:exact-radius contacts u v '(1 1 1 1 1 1) :absolute 0)))
        (is (zerop (radius 0.9534d0)))
        (is (plusp (radius 0.9536d0))))))
  ;; Nothing resists a turn about the line between two fingers.
  (let ((plan (supergrip:try-grasp "PINCH-2-PARALLEL" (changed-box :v 0) :index :exact)))
    (is (search "open: the contacts don't close on this shape with any friction"
                (supergrip:plan-reason plan))))
  ;; A form may say that friction takes from what a grasp exerts.
  (let ((plan (supergrip:plan
               (changed-box :u 2)
               :knowledge (text-knowledge *good-rules*
                                          (format nil "~a~a" *small-gripper*
                                                  (grasp-text :wrench "(1 (- 1 u) 1 1 1 1)"))))))
    (is (search "open: the contacts don't close on this shape with u of 2; with 0.5 they do"
                (supergrip:plan-reason plan)))))

(test what-contacts-do-not-hold-is-told-with-what-they-bear
  ;; Two fingers press as much as the third, which presses with 1: friction gives 2 u.
  (let ((plan (supergrip:try-grasp "PINCH-3-PARALLEL" (changed-box :weight 1.8d0) :index :exact)))
    (is (eql 0 (search "it can't hold the weight: the load is 1.8, the contacts bear 1.6 in this direction; the box would give way, moving along -Z"
                       (nth-value 1 (supergrip:candidate-failure
                                     (find :lifting (supergrip:plan-rejected plan)
                                           :key #'supergrip:candidate-outcome)
                                     plan)))))))

(test rejected-candidates-are-open-or-drop-the-box
  "By a motion in which the fingers can do nothing, or less than the weight."
  (let ((open 0) (dropping 0))
    (for-random-boxes (box 100 14)
      (let ((plan (exact-plan box)))
        (dolist (candidate (supergrip:plan-rejected plan))
          (case (supergrip:candidate-outcome candidate)
            (:open
             (incf open)
             (destructuring-bind (contacts u v need gravity)
                 (candidate-case candidate plan '(1 1 1 1 1 1))
               (declare (ignore gravity))
               (let ((worst (nth-value 2 (supergrip:exact-radius contacts u v need))))
                 (is (< (power-of contacts u v worst) 1d-3)))))
            (:lifting
             (incf dropping)
             (let ((case (candidate-case candidate plan '(1 1 1 1 1 1))))
               (is (minusp (spare-power case (nth-value 1 (supergrip:holds-p
                                                           (first case) (second case) (third case)
                                                           (fifth case))))))))))))
    (is (< 3 open))
    (is (< 10 dropping))))

;;; The squeeze

(test the-squeeze-is-where-the-radius-is-one
  (for-random-boxes (box 60 5)
    (let* ((plan (exact-plan box)) (best (supergrip:plan-best plan)) (need (needed plan))
           (squeeze (and best (supergrip:candidate-squeeze best plan))))
      (when (and squeeze (notevery #'zerop need))
        ;; With all forces scaled, the radius scales: a weight and a task less by the cap.
        (destructuring-bind (contacts u v need gravity) (candidate-case best plan need)
          (flet ((radius (cap)
                   (flet ((less (six) (mapcar (lambda (number) (/ number cap)) six)))
                     (supergrip:exact-radius contacts u v (less need) :gravity (less gravity)))))
            (is (<= (- 1d0 1d-9) (radius squeeze)) "~a" box)
            (is (<= (* 0.99d0 (radius (* 0.985d0 squeeze))) 1d0) "~a" box)))))))

(test an-unknown-index-is-told-of
  (is (equal "gamma is 2, but must be a number from 0 (forces alone) to 1 (velocities alone)"
             (error-text (supergrip:plan (paper-box) :gamma 2))))
  (is (equal "index is EXAKT, but must be :PAPER or :EXACT"
             (error-text (supergrip:plan (paper-box) :index :exakt)))))

(test exact-plans-do-not-depend-on-float-traps
  (let* ((plan (exact-plan (paper-box))) (box (supergrip:plan-box plan)))
    (is (equal (plan-figures plan)
               (plan-figures (call-in-modes (lambda () (exact-plan box))
                                            :traps '(:underflow :inexact)
                                            :rounding-mode :positive-infinity))))
    (is (not (traps-matter-p (lambda () (plan-figures (exact-plan box))))))))

(test extreme-boxes-have-records-by-either-index
  "Whatever sizes, friction, weight and needs are, a plan has a record, and no number of it is
none."
  (let ((state (sb-ext:seed-random-state 3)))
    (flet ((one-of (&rest numbers) (nth (random (length numbers) state) numbers)))
      (dotimes (i 150)
        (let ((box `((:size ,(one-of 12 1d-3 1d100 1d-300 2 1d300 5) ,(one-of 2 1d-3 3 1d10)
                            ,(one-of 2 3 1d-100 1d20 1d300))
                     (:weight ,(one-of 0 .2d0 1d-300 1d300 1d-8))
                     (:u ,(one-of .8d0 1.5d0 1d300 1d-300 0 1d150))
                     (:v ,(one-of .2d0 1d300 0 1d-300))
                     (:constrained :z2)
                     (:force-needed ,(loop repeat 6 collect (one-of 0 1 1d-300 .5d0 1d-150)))
                     (:velocity-needed (0 1 1d-300 .5d0 0 1)))))
          (dolist (index '(:paper :exact))
            (let ((plan (supergrip:plan box :index index)))
              (is (equal (supergrip::plan-record plan)
                         (lisp-record (lisp-line (supergrip::plan-record plan))))
                  "~s ~s" index box))))))))
