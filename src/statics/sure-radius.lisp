;;;; sure-radius.lisp -- a radius that the contacts surely bear, from six capacities alone.
;;;;
;;;; Six capacities, each valid in both directions, span a cross-polytope of wrenches that the
;;;; contacts can exert: those whose shares, wrench / capacity, add up to 1 at most.  The sure
;;;; radius is that of the greatest task ellipsoid, about the weight's wrench, inside it.

(in-package :supergrip-statics)

(declaim (inline moved-torque load-shares task-shares)) ; so that no number is boxed
(defun moved-torque (ox oy oz fx fy fz)
  "Return the torque of the force F at the origin about the point O: F x O."
  (declare (double-float ox oy oz fx fy fz))
  (values (- (* fy oz) (* fz oy)) (- (* fz ox) (* fx oz)) (- (* fx oy) (* fy ox))))

(defun load-shares (capacities gravity ox oy oz)
  "Return the sum of the shares of CAPACITIES, at the point O, that the wrench GRAVITY takes."
  (declare (type six capacities gravity) (double-float ox oy oz))
  (multiple-value-bind (x y z)
      (moved-torque ox oy oz (aref gravity 0) (aref gravity 1) (aref gravity 2))
    (flet ((share (k load) (/ (abs (the double-float load)) (aref capacities k))))
      (declare (inline share))
      (+ (share 0 (aref gravity 0)) (share 1 (aref gravity 1)) (share 2 (aref gravity 2))
         (share 3 (+ x (aref gravity 3))) (share 4 (+ y (aref gravity 4)))
         (share 5 (+ z (aref gravity 5)))))))

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
             (declare (double-float arm))
             (let ((share (* (aref need k) (+ (/ (aref capacities k)) (abs arm)))))
               (* share share)))
           (torque (k)
             (let ((share (/ (aref need k) (aref capacities k))))
               (* share share))))
      (declare (inline force torque))
      (dolist (sy '(1d0 -1d0))
        (declare (double-float sy))
        (dolist (sz '(1d0 -1d0))
          (declare (double-float sz))
          (multiple-value-bind (x y z) (moved-torque ox oy oz mx (* sy my) (* sz mz))
            (setf greatest (max greatest (+ (force 0 x) (force 1 y) (force 2 z)))))))
      (let ((square (+ greatest (+ (torque 3) (torque 4) (torque 5)))))
        (if (>= square 0d0) (sqrt square) square))))) ; it may be no number

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
                    (most (loop for each across need maximize each))
                    ;; Needs as small as 1e-300 have no squares.
                    (scaled (let ((scaled (copy-seq need)))
                              (dotimes (k 6 scaled)
                                (setf (aref scaled k) (/ (aref need k) most)))))
                    (radius (/ left (task-shares capacities scaled ox oy oz) most)))
               (declare (double-float left most radius) (type six scaled))
               (cond ((not (> radius 0d0)) 0d0) ; nothing is sure, or it has no value
                     ((> radius +most-sure+) +most-sure+)
                     (t radius)))))))
