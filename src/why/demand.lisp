;;;; demand.lisp -- whether a grasp does all that a task with absolute needs demands.

(in-package :supergrip)

(defstruct demand
  "How far a grasp does what is asked.  FITS is CANDIDATE-FITS.  SURELY and AT-MOST are radii: the
part of the forces and torques asked for, all together and in any direction, that its contacts
surely bear, and the part that they bear at most.  WEAKEST is the axis, \"about Y\", on which they
have the least to spare.  Without needs the last three are NIL."
  fits surely at-most weakest)

(defun weakest-axis (motion need)
  "Return the axis, in words, that has the greatest share in MOTION, the worst for a task NEED."
  (let ((shares (mapcar #'abs (direction-shares motion need))))
    (axis-name (position (reduce #'max shares) shares))))

(defun demand-on (candidate plan)
  "Return the DEMAND on CANDIDATE of PLAN if the needs of its box are absolute, and not too large to
compute with, or NIL."
  (when (absolute-units-p (%box-units (plan-box plan)))
    (multiple-value-bind (upper lower motion) (candidate-exact-radius candidate plan)
      (let ((fits (candidate-fits candidate plan)))
        (cond (upper
               (make-demand :fits fits :at-most upper
                            :surely (min upper (max (candidate-sure candidate plan) (or lower 0d0)))
                            :weakest (weakest-axis motion (box-force-needed (plan-box plan)))))
              ((every #'zerop (box-force-needed (plan-box plan))) (make-demand :fits fits)))))))

(defun percent-text (radius round)
  "Return RADIUS in per cent, a whole number as ROUND, a function, makes it; near 100 with the
digits that show on which side of 100 it is."
  (let ((percent (* 100 radius)))
    (if (or (= percent 100) (not (< 99 percent 101)))
        (number-text (funcall round percent))
        (first (number-texts percent 100)))))

(defun demand-text (demand)
  "Return DEMAND in a sentence."
  (let ((verdict (case (demand-fits demand)
                   ((t) "It fits")
                   (:false "It does not fit")
                   (t "Whether it fits was not proved")))
        (upper (demand-at-most demand)))
    (cond ((null upper)
           (plain-text "~a: no force is asked for, and it holds the weight." verdict))
          ((minusp upper)
           (plain-text "~a: exactly, the contacts can't hold the weight." verdict))
          (t
           (plain-text "~a: surely ~a %~:[, and at most ~a %,~;~*~] of what is asked; weakest ~a."
                       verdict (percent-text (demand-surely demand) #'floor)
                       (eq t (demand-fits demand)) (percent-text upper #'ceiling)
                       (demand-weakest demand))))))
