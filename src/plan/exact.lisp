;;;; exact.lisp -- the exact index: closure, lifting and u_w are what the contacts can really do.
;;;;
;;;; A candidate whose fingers reach their places is possible if its contacts are closed and hold
;;;; the weight.  Its u_w is the certified radius.  That takes a thousand times as long as all the
;;;; rest, so the best is searched for with bounds: the candidate of the greatest Q is looked at
;;;; more closely, until its radius is certified.  Those that can't be better keep their bound.

(in-package :supergrip)

(defstruct (strength (:constructor make-strength (grip)) (:copier nil))
  "What is known of the exact radius of GRIP, the contacts of a candidate: UPPER, a bound, which the
motion WORST shows; LOWER, certified, or NIL.  STAGE says what UPPER comes of: the :AXES, :DESCENTS
from them, or a whole :SEARCH."
  grip (upper 0d0 :type double-float) (lower nil) (worst nil) (stage :axes :type symbol))

(defconstant +gap+ 0.01d0 "How far below the upper value a certified one may be, relative.")
(defconstant +absolute+ 0.002d0 "The same, if that is more.")

(defun contacts-grip (candidate workspace
                      &optional (friction (%box-friction (workspace-box workspace))))
  "Return the contacts of CANDIDATE, whose figures WORKSPACE holds, as a grip with FRICTION."
  (let* ((box (workspace-box workspace))
         (contacts (contacts-of candidate workspace))
         (grip (make-grip (length contacts) friction (%box-soft-friction box))))
    (loop for contact in contacts
          for index from 0
          do (apply #'set-finger grip index (append (getf contact :position)
                                                    (getf contact :normal))))
    grip))

;;; Steps

(define-step (contact-closure :exact) :open (candidate workspace)
  (without-float-traps
    (let ((grasp (%candidate-grasp candidate)))
      ;; The WRENCH entries decide nothing here; they are only shown.
      (unless (turn-wrench candidate workspace)
        (fill (workspace-wrench workspace) 0d0))
      (when (turn-entries (grasp-twist grasp) candidate workspace (workspace-twist workspace)
                          -1d-300)
        (turn-centre workspace (%candidate-matching candidate) candidate)
        (let ((grip (contacts-grip candidate workspace)))
          (setf (%candidate-strength candidate) (make-strength grip))
          (and (computable-p grip (gravity-on (workspace-box workspace)))
               (grip-closed-p grip)))))))

(define-step (contact-lifting :exact) :lifting (candidate workspace)
  (let ((gravity (gravity-on (workspace-box workspace))))
    (or (zerop (%box-weight (workspace-box workspace)))
        (grip-holds-p (strength-grip (%candidate-strength candidate)) gravity))))

(define-step (exact-quality :exact) :open (candidate workspace)
  (without-float-traps
    (rate-velocity candidate workspace)
    (look-along-axes (%candidate-strength candidate) (workspace-box workspace))
    (rate-exactly candidate workspace)))

;;; Strength

(defun look-along-axes (strength box)
  "Bound the radius of STRENGTH by motions along and about the axes that the task of BOX needs."
  (let ((need (%box-force box)) (gravity (gravity-on box)) (motion (make-six)) (scratch (make-six)))
    (setf (strength-upper strength) sb-ext:double-float-positive-infinity)
    (dotimes (axis 6)
      (when (plusp (aref need axis))
        (dolist (way '(1d0 -1d0))
          (fill motion 0d0)
          (setf (aref motion axis) way)
          (let ((radius (/ (+ (grip-power (strength-grip strength) motion scratch)
                              (* (aref gravity axis) way))
                           (aref need axis))))
            (when (< radius (strength-upper strength))
              (setf (aref motion axis) (/ way (aref need axis))
                    (strength-upper strength) (max radius 0d0)
                    (strength-worst strength) (copy-seq motion)))))))
    (unless (strength-worst strength)   ; nothing is needed
      (setf (strength-stage strength) :search))))

(defun look-closer (strength box)
  "Go to the next stage of STRENGTH, at the task of BOX."
  (flet ((look (&rest how)
           (multiple-value-bind (upper lower worst)
               (apply #'grip-radius (strength-grip strength) (%box-force box) (gravity-on box) how)
             (setf (strength-upper strength) upper
                   (strength-lower strength) lower
                   (strength-worst strength) worst))))
    (ecase (strength-stage strength)
      (:axes (look +gap+ +absolute+ 0)
       (setf (strength-stage strength) (if (strength-lower strength) :search :descents)))
      (:descents (look +gap+ +absolute+)
       (setf (strength-stage strength) :search)))))

(defun worst-axis (worst need)
  "Return the axis, 0 to 5, of the greatest component of the motion WORST among those that the task
NEED needs; -1 if there is none."
  (let ((greatest -1))
    (dotimes (axis 6 greatest)
      (when (and (plusp (aref need axis))
                 (or (minusp greatest)
                     (> (abs (aref worst axis)) (abs (aref worst greatest)))))
        (setf greatest axis)))))

(defun counted-radius (candidate workspace)
  "Return the radius with which CANDIDATE counts: a bound until the search is over, then the
certified one or, if there is none, the sure radius."
  (let ((strength (%candidate-strength candidate)))
    (cond ((null (strength-worst strength)) 0d0)
          ((%candidate-bound candidate) (strength-upper strength))
          ((strength-lower strength))
          (t (replay candidate workspace)
             (sure-of candidate workspace)))))

(defun rate-exactly (candidate workspace)
  "Put into CANDIDATE the radius and the quality that its strength gives.  True if it is finite."
  (let ((strength (%candidate-strength candidate)))
    (setf (%candidate-bound candidate) (not (eq (strength-stage strength) :search)))
    (rate candidate workspace (counted-radius candidate workspace)
          (worst-axis (strength-worst strength) (%box-force (workspace-box workspace))))))

;;; The best

(defvar *certified* 1
  "How many of the best candidates of a plan exact mode looks at until their qualities are no
bounds.")

(defun better-p (a b)
  "True if the candidate A comes before B: by its quality, and if these are the same, by being no
bound."
  (let ((one (%candidate-quality a)) (other (%candidate-quality b)))
    (or (> one other)
        (and (= one other) (%candidate-bound b) (not (%candidate-bound a))))))

(defun share-strengths (candidates workspace)
  "Let those of CANDIDATES that have the same contacts have one strength, that of the first."
  (loop for (candidate . others) on candidates
        for strength = (%candidate-strength candidate)
        do (dolist (other others)
             (when (and (not (eq (%candidate-strength other) strength))
                        (same-contacts-p (strength-grip (%candidate-strength other))
                                         (strength-grip strength)))
               (setf (%candidate-strength other) strength)
               (rate-exactly other workspace)))))

(defun choose-exactly (workspace log)
  "Return the best candidate in LOG, the latest first, at the box of WORKSPACE, or NIL.  Its quality
is no bound, and no less than that of any other, bound or not; and so are the next ones, *CERTIFIED*
in all."
  (without-float-traps
    (let ((possible (reverse (remove-if-not (lambda (entry)
                                              (and (candidate-p entry) (possible-p entry)))
                                            log))))
      (share-strengths possible workspace)
      (loop
        (let* ((ranked (stable-sort (copy-list possible) #'better-p))
               (next (find-if #'%candidate-bound ranked
                              :end (min *certified* (length ranked)))))
          (unless next (return (first ranked)))
          (look-closer (%candidate-strength next) (workspace-box workspace))
          (dolist (candidate possible)
            (when (eq (%candidate-strength candidate) (%candidate-strength next))
              (rate-exactly candidate workspace))))))))

(defparameter +each-alone+
  (coerce (loop for matching below 24 collect (ash 1 matching)) 'matching-sets)
  "For each matching, the set of itself: gravity has a direction, so half a turn makes a
difference.")

(setf *indices* (with-row (make-index :exact (constantly +each-alone+) #'choose-exactly)
                  *indices* #'index-name))

;;; Answers, for plans by any index

(defun candidate-bound-p (candidate)
  "True if the quality and u_w of CANDIDATE are only upper bounds.  In exact mode this is so of a
candidate that could not become the best, and so was not looked at more closely."
  (%candidate-bound candidate))

(defmacro with-grip ((grip box candidate plan) &body body)
  "Run BODY with GRIP, the contacts of CANDIDATE of PLAN, and BOX; NIL if it is not possible, or
can't be computed with."
  (let ((workspace (gensym)))
    `(and (possible-p ,candidate)
          (with-replay (,workspace ,candidate ,plan)
            (let ((,grip (contacts-grip ,candidate ,workspace)) (,box (workspace-box ,workspace)))
              (and (computable-p ,grip (gravity-on ,box))
                   (progn ,@body)))))))

(defun candidate-exact-radius (candidate plan &key (gap +gap+) (absolute +absolute+))
  "Return the exact force radius of the contacts of CANDIDATE of PLAN, by whatever index the plan
was made.  The three values are those of EXACT-RADIUS: an upper value; the certified lower one, or
NIL; and the worst motion, a list of six.  GAP and ABSOLUTE are explained there.  Returns NIL if
CANDIDATE is not possible, if the task needs no force, or if places or weight are too large to
compute with."
  (let ((gap (coerce gap 'double-float)) (absolute (coerce absolute 'double-float))
        (strength (%candidate-strength candidate)))
    (cond ((every #'zerop (%box-force (plan-box (need-plan plan)))) nil)
          ((and strength (eq (strength-stage strength) :search)
                (= gap +gap+) (= absolute +absolute+)
                (find candidate (plan-entries plan)))
           (values (strength-upper strength) (strength-lower strength)
                   (coerce (strength-worst strength) 'list)))
          (t (with-grip (grip box candidate plan)
               (multiple-value-bind (upper lower worst)
                   (grip-radius grip (%box-force box) (gravity-on box) gap absolute)
                 (values upper lower (coerce worst 'list))))))))

(defun candidate-fits (candidate &optional (plan *plan*))
  "Say whether the contacts of CANDIDATE of PLAN do the task at radius 1: all forces and torques
together and in any direction, beside the weight.  T if they surely do: the sure radius or the
certified one is 1 or more.  :FALSE if they surely do not: the upper value is below 1.  NIL if
neither was proved, or if CANDIDATE is not possible.  This is for tasks whose needs are absolute."
  (flet ((proved (&rest how)
           (multiple-value-bind (upper lower) (apply #'candidate-exact-radius candidate plan how)
             (cond ((null upper) nil)   ; too large to compute with
                   ((and lower (>= lower 1)) t)
                   ((< upper 1) :false)))))
    (cond ((not (possible-p candidate)) nil)
          ((every #'zerop (%box-force (plan-box (need-plan plan)))) t)
          ;; Where there is much to spare, a rough proof does; in exact mode there is a fine one.
          ((and (eq (plan-index plan) :paper) (proved :gap 0.5d0)))
          ((>= (candidate-sure candidate plan) 1) t)
          ((proved))
          ((proved :gap 1d-4 :absolute 1d-5)))))

(defun candidate-squeeze (candidate &optional (plan *plan*))
  "Return the least cap on each finger's force with which the contacts of CANDIDATE of PLAN surely
do the task at radius 1 and hold the weight, in units of a finger's greatest force.  It is 1 or less
if the greatest force is enough.  NIL if no cap is enough, if none was proved to be, if CANDIDATE is
not possible, or if there is neither need nor weight.  See LEAST-SQUEEZE."
  (with-grip (grip box candidate plan)
    (and (or (plusp (%box-weight box)) (some #'plusp (%box-force box)))
         (values (grip-squeeze grip (%box-force box) (gravity-on box))))))

(defun candidate-friction-margin (candidate &optional (plan *plan*))
  "Return how much less the friction u may be, so that the contacts of CANDIDATE of PLAN surely
still do the task at radius 1 and hold the weight.  The number is below 0 if they need more
friction.  NIL if no u is enough, if none was proved to be, or if CANDIDATE is not possible.  See
LEAST-FRICTION."
  (with-grip (grip box candidate plan)
    (let ((least (grip-least-friction grip (%box-force box) (gravity-on box))))
      (and least (- (%box-friction box) least)))))

(defun finger-powers (position normal u v motion)
  "Return what a finger at POSITION with the inward NORMAL, lists of three, can do at most in
MOTION, a list of six, by pressing, by friction U and by its tip's torque V: nothing if it can't
help."
  (let* ((spin (nthcdr 3 motion))
         (velocity (mapcar #'+ motion (cross-product spin position)))
         (along (dot-product normal velocity))
         (across (loop for k in velocity for n in normal sum (expt (- k (* along n)) 2)))
         (powers (list along (* u (sqrt across)) (* v (abs (dot-product normal spin))))))
    (if (plusp (reduce #'+ powers)) powers '(0d0 0d0 0d0))))

(defun candidate-powers (candidate motion &optional (plan *plan*))
  "Return the greatest power of the contacts of CANDIDATE of PLAN in MOTION, a list of six, such as
the worst that CANDIDATE-EXACT-RADIUS gives: four numbers, the power of pressing, of friction, of
the fingertips' torque and of the weight.  Together they are the radius times what the task needs
there."
  (let ((box (plan-box (need-plan plan))))
    (append (reduce (lambda (a b) (mapcar #'+ a b))
                    (loop for contact in (candidate-contacts candidate plan)
                          collect (finger-powers (getf contact :position) (getf contact :normal)
                                                 (%box-friction box) (%box-soft-friction box)
                                                 motion)))
            (list (dot-product (coerce (gravity-on box) 'list) motion)))))
