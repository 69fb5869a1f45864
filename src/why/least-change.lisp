;;;; least-change.lisp -- the nearest place along a line at which something becomes true of the
;;;; plan.
;;;;
;;;; An interval is passed over if it is certain that nothing becomes true in it: what is known of
;;;; the box does not change, so the candidates are the same, and the bounds of their curves say
;;;; which of them may be the best.  Else it is halved, down to the resolution, where only its
;;;; ends and middle are looked at.

(in-package :supergrip)

(defparameter +resolution+ 1d-9
  "How narrow an interval is, relative to its distance from 0, that is not halved any more.")

(defparameter +most-intervals+ 4000
  "How many intervals of a line are halved down to the resolution; the others only to a step.")

(defconstant +steps+ 500 "The steps of a line that is not searched throughout.")

(defconstant +most-dear-intervals+ 60 "The same as +MOST-INTERVALS+ where plans take milliseconds.")
(defconstant +dear-steps+ 40 "The same as +STEPS+ there.")

(defun computes-p (grasp)
  "True if GRASP asks for a computation."
  (or (computed-p (draft-wrench (grasp-draft grasp)))
      (computed-p (draft-twist (grasp-draft grasp)))))

(defun dear-p (plan)
  "True if a plan like PLAN takes milliseconds: a grasp of its knowledge asks for computations."
  (loop for grasp in (knowledge-grasps (plan-knowledge plan))
          thereis (computes-p grasp)))

(defun step-count (plan)
  "Return the steps of a line of PLAN that is not searched throughout."
  (if (dear-p plan) +dear-steps+ +steps+))

(defconstant +most-at-once+ 0.01d0 "What a change that comes with anything above 0 is tried with.")
(defconstant +least-above-0+ 1d-6
  "The least number above 0 that is looked at: where less is needed, Q is so great that rounding
decides.")

(defstruct change
  "What of the box would have to change.  WHAT names it.  FROM is what the box has, TO what is
enough: two values, TO rounded as far as it can be; or two lists, of constrained faces or of facts.
BOX is the changed box, PLAN the plan that results.  For a value, LIMIT is the nearest that is
enough, not rounded, and SIZE how far that is from FROM.  If a dimension of the gripper decides,
THRESHOLD is a list: how LIMIT stands to it, a string; its name; the dimension.  Otherwise it is
NIL.  All are in the units of the box; MEASURE is what they measure, and DISTANCE is SIZE in cm and
finger forces.  AT-ONCE is true if anything above 0 is enough."
  what from to box plan limit size threshold measure distance at-once)

(defstruct goal
  "What is to become true of a plan: TEST, a function of it.  WINNER is the same of the best, a
prospect or NIL; it is NIL itself if the test depends only on what is known of the box."
  (test nil :type function) (winner nil :type (or null function)))

;;; Plans along a line

(defun plan-like (plan box &optional (knowledge (plan-knowledge plan)))
  "Return the plan for BOX, made as PLAN was, with KNOWLEDGE."
  (if (plan-tries plan)
      (try-without-rules (plan-tries plan) box :knowledge knowledge
                                               :gamma (plan-gamma plan) :index (plan-index plan))
      (plan box :knowledge knowledge :gamma (plan-gamma plan) :index (plan-index plan))))

(defun needs-something-p (box)
  (or (some #'plusp (%box-force box)) (some #'plusp (%box-velocity box))))

(defun line-box (line value)
  "Return the box of LINE with VALUE for what varies."
  (box-with-at (plan-box (line-plan line)) (line-row line) (line-index line) value))

(defun true-at-p (line goal value)
  "True if GOAL is true of the plan for VALUE."
  (let ((box (line-box line value)))
    (and (<= (line-least line) value (line-most line))
         (needs-something-p box)
         (funcall (goal-test goal) (plan-like (line-plan line) box)))))

(defun line-facts (line value)
  "Return all that is known of the box with VALUE before any rule runs."
  (let* ((plan (line-plan line)) (knowledge (plan-knowledge plan))
         (memory (start-plan (line-box line value) knowledge (plan-gamma plan))))
    (prog1 (save-facts memory)
      (give-back memory knowledge))))

(defun follows (line goal facts value)
  "Return what follows from FACTS, those of VALUE: prospects, or whether GOAL is true."
  (let ((entry (or (assoc facts (line-known line) :test #'equalp)
                   (let ((plan (plan-like (line-plan line) (line-box line value))))
                     (first (push (cons facts (if (goal-winner goal)
                                                  (prospects-of plan line)
                                                  (and (funcall (goal-test goal) plan) t)))
                                  (line-known line)))))))
    (cdr entry)))

;;; Who may be the best in an interval

(defun enter-interval (near far)
  "Make the interval from NEAR to FAR the one at hand."
  (settle *variable* (min near far) (max near far) 2)
  (incf *stamp*))

(defun look-at (prospects)
  "Return those of PROSPECTS that may be possible in the interval at hand, their bounds in place."
  (loop for prospect in prospects
        for possible = (bounds (prospect-possible prospect) *stamp*)
        when (plusp (curve-most possible))
          collect (let ((quality (bounds (prospect-quality prospect) *stamp*)))
                    (setf (prospect-always prospect) (plusp (curve-least possible))
                          (prospect-least prospect) (curve-least quality)
                          (prospect-most prospect) (curve-most quality))
                    prospect)))

(defun not-below (prospects)
  "Return those of PROSPECTS that are not certain to be below another."
  (let ((most (loop for prospect in prospects
                    when (prospect-always prospect) maximize (prospect-least prospect))))
    (if most
        (remove-if (lambda (prospect)
                     (< (+ (prospect-most prospect) (* 1.00001d0 +tie+)) most))
                   prospects)
        prospects)))

(defun fraction (curve)
  "Return the numerator and the denominator of CURVE, a fraction that may have a constant factor;
of any other, itself and NIL."
  (flet ((operator-p (name curve) (eq (curve-kind curve) (find-operator name))))
    (destructuring-bind (&optional a b) (curve-args curve)
      (cond ((and (operator-p "/" curve) (not (fixed-p b))) (values a b))
            ((not (operator-p "*" curve)) (values curve nil))
            (t (let ((factor (find-if #'fixed-p (list a b)))
                     (fraction (find-if (lambda (arg) (operator-p "/" arg)) (list a b))))
                 (if (and factor fraction (not (fixed-p (second (curve-args fraction)))))
                     (destructuring-bind (c d) (curve-args fraction)
                       (values (as-curve (* factor c)) d))
                     (values curve nil))))))))

(defun lead-curve (a b)
  "Return the curve of how much the Q of prospect A is above that of B in the interval at hand.
Fractions with the same denominator are put together, or their difference would be lost in their
bounds."
  (let ((sums '()))
    (flet ((add (prospect sign)
             (dolist (addend (joined-curves (the-operator "+")
                                            (plainer (prospect-quality prospect) *stamp*)))
               (multiple-value-bind (numerator denominator) (fraction addend)
                 (let ((entry (or (assoc denominator sums)
                                  (first (push (list denominator '() '()) sums)))))
                   (push numerator (nth sign entry)))))))
      (add a 1)
      (add b 2))
    (sum-curve (loop for (denominator ours theirs) in sums
                     for left = (as-curve (- (sum-curve (set-left ours theirs))
                                             (sum-curve (set-left theirs ours))))
                     collect (if denominator (as-curve (/ left denominator)) left)))))

(defun set-left (curves others)
  "Return those of CURVES that are not among OTHERS, each as often as it is there more often."
  (loop for curve in curves
        for place = (position curve others)
        if place do (setf others (append (subseq others 0 place) (nthcdr (1+ place) others)))
        else collect curve))

(defun leads (leader prospects near far)
  "Return for each of PROSPECTS the least and the greatest that the Q of LEADER is above its own
from NEAR to FAR, the interval at hand: as CURVE-LIMITS has it."
  (curve-limits (loop for prospect in prospects collect (lead-curve leader prospect)) near far))

(defun curve-limits (curves near far)
  "Return, for each of CURVES, a list of its least and its greatest from NEAR to FAR, the interval
at hand: what its bounds say there; or what it is at the ends, and the bounds of its slope, if
that is better."
  (let* ((slopes (loop for curve in curves collect (slope-range curve)))
         (ranges (loop for curve in curves
                       collect (coerce (curve-range (bounds curve *stamp*)) 'list)))
         (left (values-at curves (min near far)))
         (right (values-at curves (max near far)))
         (width (abs (- far near))))
    (loop for curve in curves
          for range in ranges
          for slope in slopes
          for a in left
          for b in right
          collect (cond ((zero-throughout-p curve near far a b) '(0d0 0d0))
                        (slope (narrower range a b slope width))
                        (t range)))))

(defun values-at (curves place)
  "Return what CURVES are at PLACE; the interval at hand becomes that."
  (enter-interval place place)
  (loop for curve in curves collect (curve-least (bounds curve *stamp*))))

(defun narrower (range left right slope width)
  "Return RANGE, that of a curve in an interval of WIDTH, narrowed by what it is at its LEFT and
RIGHT end, and the range of its SLOPE."
  (destructuring-bind (fall rise) slope
    (list (max (first range) (least-between left right fall rise width))
          (min (second range) (- (least-between (- left) (- right) (- rise) (- fall) width))))))

(defun zero-throughout-p (curve near far &rest ends)
  "True if CURVE, which is ENDS at NEAR and FAR, is 0 in all of the interval, but for rounding:
one that is smooth and is so at eight places.  Forms that say the same in other ways meet like
this."
  (flet ((zero-p (number) (< (abs number) 1d-11)))
    (and (every #'zero-p ends)
         (smooth-p curve)
         (loop for part in '(0.11d0 0.27d0 0.42d0 0.58d0 0.73d0 0.89d0)
               always (zero-p (first (values-at (list curve) (+ near (* part (- far near))))))))))

(defun slope-range (curve)
  "Return the range of the slope of CURVE in the interval at hand, or NIL if it may have none."
  (let ((slope (slope curve)))
    (and slope
         (= 2 (curve-certainty (bounds slope *stamp*)))
         (coerce (curve-range slope) 'list))))

(defun least-between (left right fall rise width)
  "Return a lower bound of what is LEFT and RIGHT at the ends of an interval of WIDTH, and whose
slope is from FALL to RISE: it is above the line that falls from the left, and above that which
rises to the right."
  (declare (double-float left right fall rise width))
  (cond ((>= fall 0d0) left)
        ((<= rise 0d0) right)
        (t (let ((place (/ (+ (- left right) (* rise width)) (- rise fall))))
             (min left right (+ left (* fall (min width (max 0d0 place)))))))))

(defun beaten-p (lead earlier)
  "True if what is below another by LEAD at least is certain not to be the best; EARLIER, if the
other is tried before it.  (Unless a third, tried before both, is within two ties of them.)"
  (> lead (* +tie+ (if earlier -0.99999d0 1.00001d0))))

(defun without-beaten (prospects near far)
  "Return PROSPECTS without those that the best of them is certain to beat, or that beat it."
  (let* ((always (remove-if-not #'prospect-always prospects))
         (leader (and always (rest prospects)
                      (reduce (lambda (a b) (if (> (+ (prospect-least b) (prospect-most b))
                                                   (+ (prospect-least a) (prospect-most a)))
                                                b a))
                              always)))
         (others (and leader (remove leader prospects)))
         (lost nil))
    (if (null others)
        prospects
        (let ((left (loop for (least most) in (leads leader others near far)
                          for other in others
                          for later = (member other (member leader prospects))
                          when (and (prospect-always other) (beaten-p (- most) (not later)))
                            do (setf lost t)
                          unless (beaten-p least later)
                            collect other)))
          (remove-if-not (lambda (prospect)
                           (if (eq prospect leader) (not lost) (member prospect left)))
                         prospects)))))

(defun contenders (prospects near far)
  "Return those of PROSPECTS that may be the best somewhere from NEAR to FAR."
  (enter-interval near far)
  (without-beaten (not-below (look-at prospects)) near far))

;;; The search along a line

(defun opaque-prospect-p (prospect)
  "True if nothing is known of PROSPECT between single places."
  (or (curve-opaque (prospect-possible prospect)) (curve-opaque (prospect-quality prospect))))

(defun prospects-at (line goal known near facts prospects)
  "Return the prospects at NEAR, where KNOWN is known: PROSPECTS, if that is FACTS."
  (if (equalp known facts) prospects (follows line goal known near)))

(defun status (line goal near far facts prospects)
  "Return whether GOAL is true from NEAR to FAR, :YES, :NO or :MAYBE; and the FACTS there, and
those of the prospects that may be the best, if the given ones, of PROSPECTS, are those."
  (let ((known (line-facts line near)))
    (cond ((and (/= near far) (not (equalp known (line-facts line far)))) :maybe)
          ((null (goal-winner goal)) (if (follows line goal known near) :yes :no))
          ((and (line-dear line) (some #'opaque-prospect-p (prospects-at line goal known near facts
                                                                         prospects)))
           ;; Their bounds say nothing, and take long.
           (values :maybe known (prospects-at line goal known near facts prospects)))
          (t (let* ((left (contenders (prospects-at line goal known near facts prospects) near far))
                    (winners (if (some #'prospect-always left) left (cons nil left)))
                    (true (count-if (goal-winner goal) winners)))
               (values (cond ((zerop true) :no) ((= true (length winners)) :yes) (t :maybe))
                       known left))))))

(defun narrow-p (line near far prospects)
  "True if the interval from NEAR to FAR, where PROSPECTS may be the best, is not halved any more."
  (let ((width (abs (- far near)))
        (patience (if (line-dear line) +most-dear-intervals+ +most-intervals+))
        (steps (if (line-dear line) +dear-steps+ +steps+)))
    (or (<= width (max 1d-12 (* +resolution+ (max near far))))
        (and (or (>= (line-count line) patience) (some #'opaque-prospect-p prospects))
             (<= width (/ (line-most line) steps))
             (progn (setf (line-sure line) nil) t)))))

(defun first-place (line goal near far &optional facts prospects)
  "Return the place nearest to NEAR, up to FAR, at which GOAL is true, and one before it at which
it is not, or the place itself.  NIL if there is none."
  (multiple-value-bind (status facts prospects) (status line goal near far facts prospects)
    (incf (line-count line))
    (let ((middle (/ (+ near far) 2)))
      (ecase status
        (:no nil)
        (:yes (values near near))
        (:maybe
         (if (narrow-p line near far prospects)
             (loop for before = near then place
                   for place in (list near middle far)
                   when (true-at-p line goal place) return (values place before))
             (multiple-value-bind (place before) (first-place line goal near middle facts prospects)
               (if place
                   (values place before)
                   (first-place line goal middle far facts prospects)))))))))

(defun next-double (number direction)
  "Return the double next to NUMBER, 0 or more, in DIRECTION, 1 or -1."
  (if (zerop number)
      (if (plusp direction) +least-above-0+ 0d0)
      (multiple-value-bind (mantissa exponent) (integer-decode-float number)
        (if (and (minusp direction) (= mantissa (expt 2 52)))
            (scale-float (coerce (1- (expt 2 53)) 'double-float) (1- exponent))
            (scale-float (coerce (+ mantissa direction) 'double-float) exponent)))))

(defun thresholds-of (plan)
  "Return the dimensions of the gripper of PLAN that are lengths or friction, an alist."
  (remove "FINGER-FORCE" (knowledge-gripper (plan-knowledge plan)) :key #'car :test #'string=))

(defun cuts (line from to)
  "Return the places strictly between FROM and TO, the nearest first, at which something may
change at once: the dimensions of the gripper."
  (let* ((gripper (thresholds-of (line-plan line)))
         (cuts (remove-if-not (lambda (cut) (< (min from to) cut (max from to)))
                              (remove-duplicates (mapcar #'cdr gripper)))))
    (sort cuts (if (< from to) #'< #'>))))

(defun place-towards (line goal to)
  "Return what FIRST-PLACE does of all between what is now, not included, and TO."
  (let* ((from (line-from line))
         (direction (if (< from to) 1 -1))
         (near (next-double from direction)))
    (flet ((try (near far)
             (when (<= 0 (* direction (- far near)))
               (multiple-value-bind (place before) (first-place line goal near far)
                 (when place
                   (when (= place before)
                     (setf before (next-double place (- direction))))
                   (return-from place-towards (values place before)))))))
      (dolist (cut (cuts line from to))
        (try near (next-double cut (- direction)))
        (try cut cut)
        (setf near (next-double cut direction)))
      (if (zerop to)
          (progn (try near +least-above-0+) (try to to))
          (try near to)))))

(defun nearest-place (line goal)
  "Return the place nearest to what is now at which GOAL is true, and the one before it, both ways
searched; NIL if there is none."
  (let ((from (line-from line)))
    (labels ((true-p (value) (true-at-p line goal value))
             (search-to (to)
               (and (/= to from)
                    (multiple-value-bind (place before) (place-towards line goal to)
                      (and place (multiple-value-list (halve before place #'true-p)))))))
      (destructuring-bind (&optional before up) (search-to (line-most line))
        (let ((down (search-to (if up
                                   (max (line-least line) (- from (- up from)))
                                   (line-least line)))))
          (if (and down (or (null up) (< (- from (second down)) (- up from))))
              (values (second down) (first down))
              (values up before)))))))

(defun halve (same other other-p)
  "Return two numbers between SAME and OTHER, as near to each other as may be, of which OTHER-P is
false and true, as of SAME and OTHER."
  (loop repeat 100
        for middle = (/ (+ same other) 2)
        until (or (= middle same) (= middle other))
        do (if (funcall other-p middle) (setf other middle) (setf same middle)))
  (values same other))

;;; The change

(defun at-once-p (from to)
  "True if a value that is 0, FROM, makes a change as soon as it is more: at TO."
  (and (zerop from) (<= to +least-above-0+)))

(defun short-decimal-beyond (same other from other-p)
  "Return the shortest decimal, from three digits on, that is beyond OTHER as seen from FROM, of
which OTHER-P is true, and false of the next one of as many digits towards FROM.  SAME is just
before, or equal but for rounding."
  (let* ((direction (if (> other from) 1 -1))
         (exponent (decimal-exponent (rational (max same other)))))
    (loop for digits from 3 to 17
          for unit = (expt 10 (- exponent digits -1))
          for value = (* unit direction (ceiling (* direction (rational other)) unit))
          for next = (- value (* direction unit))
          when (and (<= unit (* direction (- value (rational from))))
                    (funcall other-p (coerce value 'double-float))
                    (not (funcall other-p (coerce next 'double-float))))
            return (coerce value 'double-float)
          finally (return other))))

(defun threshold-at (line goal place)
  "Return how PLACE, where GOAL becomes true, stands to the dimension of the gripper that decides
it, the name of that and itself; or NIL."
  (let ((up (> place (line-from line))))
    (loop for (name . number) in (and (not (eq (box-key-type (line-row line)) :needs))
                                      (thresholds-of (line-plan line)))
          for relation = (cond ((zerop number) nil)
                               ((= place number) (if up "no less than" "no more than"))
                               ((= place (next-double number (if up 1 -1)))
                                (if up "more than" "less than")))
          when (and relation
                    (decides-p name (* number (if up 1.000001d0 0.999999d0)) line goal place))
            return (list relation name number))))

(defun knowledge-with-dimension (knowledge name value)
  "Return KNOWLEDGE with VALUE for the dimension NAME of the gripper, or NIL if that is not valid."
  (flet ((edited (file)
           (edited-file file (lambda (forms) (with-dimension name value forms)))))
    (let ((grasps (knowledge-grasp-file knowledge)) (gripper (knowledge-gripper-file knowledge)))
      (multiple-value-bind (changed problems)
          (build-knowledge (knowledge-rule-file knowledge)
                           (if gripper grasps (edited grasps))
                           (and gripper (edited gripper)))
        (and (null (errors-in problems)) changed)))))

(defun decides-p (name number line goal place)
  "True if GOAL were not true at PLACE if the dimension NAME, there, were NUMBER, a little beyond
it.  Several dimensions may have one value, and a form may hold it, too."
  (let* ((plan (line-plan line))
         (knowledge (knowledge-with-dimension (plan-knowledge plan) name number)))
    (and knowledge
         (not (funcall (goal-test goal) (plan-like plan (line-box line place) knowledge))))))

(defun find-change (line goal)
  "Return the CHANGE of what varies along LINE that is nearest to what it is, of those that make
GOAL true; NIL if none does."
  (multiple-value-bind (place before) (nearest-place line goal)
    (when place
      (let* ((from (line-from line))
             (at-once (and (at-once-p from place)
                           (loop for value = +most-at-once+ then (/ value 10)
                                 while (> value place)
                                 when (true-at-p line goal value) return value
                                 finally (return place)))))
        (make-change-to line goal place (and (eql at-once +most-at-once+) t)
                        (if at-once
                            (in-line-units at-once line)
                            (decimal-beyond before place line goal)))))))

(defun line-measure (line)
  "Return what the value that varies along LINE measures."
  (part-measure (box-key-measure (line-row line)) (line-index line)))

(defun line-units (line) (%box-units (plan-box (line-plan line))))

(defun in-line-units (number line)
  "Return NUMBER, of what varies along LINE, in the units of its box."
  (in-units number (line-measure line) (line-units line)))

(defun off-line-units (number line)
  "Return NUMBER, in the units of the box of LINE, in cm and finger forces; NIL if it is out of
range."
  (from-units number (line-measure line) (line-units line)))

(defun decimal-beyond (before place line goal)
  "Return the short decimal, in the units of the box of LINE, of what varies beyond PLACE, at
which GOAL becomes true, as it is not at BEFORE."
  (short-decimal-beyond (in-line-units before line) (in-line-units place line)
                        (in-line-units (line-from line) line)
                        (lambda (value)
                          (let ((number (off-line-units value line)))
                            (and number (true-at-p line goal number))))))

(defun make-change-to (line goal place at-once to)
  "Return the CHANGE of what varies along LINE to TO, in the units of its box, PLACE being the
nearest at which GOAL is true, AT-ONCE if anything above 0."
  (let* ((from (line-from line))
         (box (line-box line (if (eql to (in-line-units place line)) ; no shorter decimal
                                 place
                                 (off-line-units to line))))
         (threshold (threshold-at line goal place)))
    (make-change :what (value-name (line-row line) (line-index line))
                 :from (in-line-units from line) :to to :box box
                 :plan (plan-like (line-plan line) box) :limit (in-line-units place line)
                 :size (in-line-units (abs (- place from)) line) :distance (abs (- place from))
                 :measure (line-measure line) :at-once at-once
                 :threshold (and threshold
                                 (list (first threshold) (second threshold)
                                       (in-line-units (third threshold) line))))))

(defun line-end (plan goal row index from)
  "Return how far a line of the key ROW, at INDEX, goes that is FROM in PLAN: needs that are not
absolute to 1, others to four times what they are or to 2; sizes, and all if GOAL only depends on
what is known of the box, also to four times the greatest dimension of the gripper."
  (let ((reach (reduce #'max (thresholds-of plan) :key #'cdr :initial-value 0d0))
        (units (%box-units (plan-box plan))))
    (cond ((and (eq (box-key-type row) :needs)
                (not (and (box-key-absolute row) (absolute-units-p units))))
           (from-units 1d0 (part-measure (box-key-measure row) index) units))
          ((or (consp (box-key-type row)) (null (goal-winner goal)))
           (max 2d0 (* 4 from) (* 4 reach)))
          (t (max 2d0 (* 4 from))))))

(defun line-start (box row index)
  "Return where the line of the value of the key ROW of BOX at INDEX begins: what is above 0 almost
there, a size where the box still has its centre of mass inside."
  (cond ((not (consp (box-key-type row))) 0d0)
        ((eq (box-key-slot row) :size)
         (max (min (value-at box row index) 1d-6) (* 2 (abs (aref (%box-mass-centre box) index)))))
        (t (min (value-at box row index) 1d-6))))

(defun lines-of (plan goal rows)
  "Return the lines of all values of the box of PLAN that the keys ROWS give, as far as LINE-END
says."
  (loop with forms = (make-hash-table :test #'equal)
        with box = (plan-box plan)
        with dear = (dear-p plan)
        for row in (remove-if-not (lambda (row) (funcall (box-key-reader row) box)) rows)
        append (loop for index below (value-count row)
                     for from = (value-at box row index)
                     collect (make-line :plan plan :row row :index index :from from :forms forms
                                        :dear (and dear (form-slot-p (box-key-slot row)))
                                        :least (line-start box row index)
                                        :most (line-end plan goal row index from)))))

(defun find-changes (plan goal rows)
  "Return the CHANGEs of single values of the keys ROWS that make GOAL true of PLAN, as far as
LINE-END says; and the names of those values that were only looked at in steps."
  (without-float-traps
    (with-curves ()
      (loop for line in (lines-of plan goal rows)
            for change = (find-change line goal)
            when change collect change into changes
            unless (line-sure line)
              collect (value-name (line-row line) (line-index line)) into stepped
            finally (return (values changes stepped))))))

(defun write-stepped (names plan stream)
  "Write that the values of PLAN with NAMES were only looked at in steps, if there are any."
  (when names
    (format stream "Looked at only in ~d steps: ~{~a~^, ~}.~%" (step-count plan) names)))

;;; Constrained faces, and facts of the box's own

(defun face-sets (faces)
  "Return the sets of some of FACES, a set, those of fewer first."
  (stable-sort (loop for set from 1 below 64
                     when (zerop (logandc2 set faces)) collect set)
               #'< :key #'logcount))

(defun find-face-changes (plan goal)
  "Return the CHANGEs of constrained faces that make GOAL true of PLAN, the fewest faces first,
none of which has another within it: faces freed or, if none does it, faces constrained."
  (let* ((box (plan-box plan)) (row (find-key :constrained)) (now (%box-constrained box)))
    (flet ((changes (faces)
             (let ((found '()))
               (dolist (set (face-sets faces) (nreverse found))
                 (unless (some (lambda (done) (zerop (logandc2 (car done) set))) found)
                   (let* ((new (box-with box row (logxor now set)))
                          (other (plan-like plan new)))
                     (when (funcall (goal-test goal) other)
                       (push (cons set (make-change :what "the constrained faces"
                                                    :from (box-constrained box)
                                                    :to (box-constrained new) :box new :plan other))
                             found))))))))
      (mapcar #'cdr (or (changes now) (changes (logandc2 63 now)))))))

(defun declared-facts (knowledge)
  "Return all facts that a box may have of its own, as the rules of KNOWLEDGE declare them."
  (loop for (words arity) in (declared-inputs knowledge)
        append (loop for set below 64
                     when (= arity (logcount set))
                       collect (make-box-fact (format nil "~{~a~^ ~}" words)
                                              (make-face-list
                                               (loop for face below 6
                                                     when (logbitp face set) collect face))
                                              nil))))

(defun same-fact-p (a b)
  (and (string= (box-fact-words a) (box-fact-words b))
       (= (face-list-mask (box-fact-face-list a)) (face-list-mask (box-fact-face-list b)))))

(defun find-fact-changes (plan goal)
  "Return the CHANGEs of a single fact of the box's own, added or left out, that make GOAL true of
PLAN."
  (let* ((box (plan-box plan)) (row (find-key :facts)) (now (%box-facts box)))
    (loop for fact in (declared-facts (plan-knowledge plan))
          for rest = (remove fact now :test #'same-fact-p)
          for new = (box-with box row (if (= (length rest) (length now))
                                          (append now (list fact))
                                          rest))
          for other = (plan-like plan new)
          when (funcall (goal-test goal) other)
            collect (make-change :what "the facts" :from (box-facts box) :to (box-facts new)
                                 :box new :plan other))))
