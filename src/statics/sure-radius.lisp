;;;; sure-radius.lisp -- a radius that the contacts surely bear, from six capacities alone.
;;;;
;;;; Six capacities, each good both ways, span a cross-polytope of wrenches that the contacts can
;;;; exert: those whose shares, wrench / capacity, add up to 1 at most.  The sure radius is that of
;;;; the greatest task ellipsoid, about the weight's wrench, inside it.

(in-package :supergrip-statics)

(defun moved-torque (ox oy oz fx fy fz)
  "Return the torque of the force F at the origin about the point O: F x O."
  (declare (double-float ox oy oz fx fy fz))
  (values (- (* fy oz) (* fz oy)) (- (* fz ox) (* fx oz)) (- (* fx oy) (* fy ox))))

(defun load-shares (capacities gravity ox oy oz)
  "Return the sum of the shares of CAPACITIES, at the point O, that the wrench GRAVITY takes."
  (declare (type six capacities gravity) (double-float ox oy oz))
  (multiple-value-bind (x y z)
      (moved-torque ox oy oz (aref gravity 0) (aref gravity 1) (aref gravity 2))
    (loop for load in (list (aref gravity 0) (aref gravity 1) (aref gravity 2)
                            (+ x (aref gravity 3)) (+ y (aref gravity 4)) (+ z (aref gravity 5)))
          for capacity across capacities
          sum (/ (abs load) capacity) of-type double-float)))

(defun task-shares (capacities need ox oy oz)
  "Return the greatest sum of the shares of CAPACITIES, at the point O, that a wrench of the task
NEED, about the origin, takes.
Its square is, for the worst signs s, the sum of (need_k (s_k/c_k - (m x o)_k))^2 over the forces, m
being the torques' s/c, and of (need_k / c_k)^2 over the torques.  A force's own sign is free."
  (declare (type six capacities need) (double-float ox oy oz))
  (let ((mx (/ (aref capacities 3))) (my (/ (aref capacities 4))) (mz (/ (aref capacities 5)))
        (greatest 0d0))
    (declare (double-float greatest))
    (flet ((force (k arm)
             (expt (* (aref need k) (+ (/ (aref capacities k)) (abs arm))) 2)))
      (dolist (sy '(1d0 -1d0))
        (dolist (sz '(1d0 -1d0))
          (multiple-value-bind (x y z) (moved-torque ox oy oz mx (* sy my) (* sz mz))
            (setf greatest (max greatest (+ (force 0 x) (force 1 y) (force 2 z))))))))
    (sqrt (+ greatest
             (loop for k from 3 below 6
                   sum (expt (/ (aref need k) (aref capacities k)) 2) of-type double-float)))))

(defconstant +most-sure+ 1d300 "The greatest sure radius that is told: less is sure, too.")

(defun sure (capacities need gravity ox oy oz)
  "Return the radius of SURE-RADIUS, or NIL if nothing is needed.  CAPACITIES, NEED and GRAVITY are
sixes without signs but GRAVITY; O, doubles, is the point of the capacities."
  (declare (type six capacities need gravity) (double-float ox oy oz))
  (without-float-traps
    (cond ((every #'zerop need) nil)
          ;; Beyond these sizes shares can't be computed, so nothing is sure.
          ((not (and (every (lambda (capacity) (< 1d-100 capacity 1d100)) capacities)
                     (< (max (abs ox) (abs oy) (abs oz)) 1d100)))
           0d0)
          (t (let* ((left (- 1d0 (load-shares capacities gravity ox oy oz)))
                    (most (reduce #'max need))
                    ;; Needs as small as 1e-300 have no squares.
                    (scaled (map 'six (lambda (each) (/ each most)) need))
                    (radius (/ left (task-shares capacities scaled ox oy oz) most)))
               (declare (double-float left most radius))
               (cond ((not (> radius 0d0)) 0d0) ; nothing is sure, or it has no value
                     ((> radius +most-sure+) +most-sure+)
                     (t radius)))))))
