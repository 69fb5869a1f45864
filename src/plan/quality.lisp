;;;; quality.lisp -- how good a grasp is for a task: embedded radii, and their mixture.

(in-package :supergrip)

;;; Inline, so that the numbers that they take and give are not boxed.
(declaim (inline embedded-radius put-load put-borne quality-index shift-force shift-velocity))

(defun embedded-radius (need have)
  "Return the radius of the largest NEED ellipsoid inside HAVE, and the axis that limits it.

NEED  six doubles >= 0: what the task asks along X, Y, Z and about X, Y, Z, the effect of the
      offset included.
HAVE  six doubles on the same axes: what the grasp exerts, gravity's load taken off.

The radius is the least HAVE/NEED over the axes with NEED > 0; the second value is that axis, 0 to
5, or -1 if no axis is needed.  The radius is infinite if a need or a ratio is out of range.

Source: the paper, Description, u_t and u_w.  Of two ellipsoids with common axes this is the radius
itself.  What the contacts can really do is no ellipsoid: with the needs that an offset makes grow,
or a load, the radius is neither an upper nor a lower bound of their strength."
  (declare (type six need have))
  (let ((radius 0d0) (limit -1))
    (declare (double-float radius) (type (integer -1 5) limit))
    (dotimes (axis 6 (values radius limit))
      (let ((needed (aref need axis)))
        (when (> needed 0d0)
          (let ((ratio (/ (aref have axis) needed)))
            (unless (and (finite-p needed) (finite-p ratio))
              (return (values sb-ext:double-float-positive-infinity axis)))
            (when (or (minusp limit) (< ratio radius))
              (setf radius ratio limit axis))))))))

(declaim (inline add-turned))
(defun add-turned (offset from needs out to)
  "Add to OUT, from the place TO, what an OFFSET (three lengths, not below 0) of the grasp centre
makes of NEEDS from the place FROM: |o_Y| n_Z + |o_Z| n_Y to the first, and so on cyclically."
  (declare (type three offset) (type six needs out) (type (integer 0 3) from to))
  (macrolet ((add (i j k)
               `(incf (aref out (+ to ,i))
                      (+ (* (aref offset ,j) (aref needs (+ from ,k)))
                         (* (aref offset ,k) (aref needs (+ from ,j)))))))
    (add 0 1 2) (add 1 2 0) (add 2 0 1)))

(defun shift-force (needs offset out)
  "Put into OUT the forces and torques NEEDS at the box centre as they are at the grasp centre,
OFFSET from it: the torques grow.  Source: reconstructed, see docs/physics.md."
  (declare (type six needs out) (type three offset))
  (replace out needs)
  (add-turned offset 0 needs out 3))

(defun shift-velocity (needs offset out)
  "Put into OUT the velocities NEEDS at the box centre as they are at the grasp centre, OFFSET from
it: those along the axes grow.  Source: reconstructed, see docs/physics.md."
  (declare (type six needs out) (type three offset))
  (replace out needs)
  (add-turned offset 3 needs out 0))

(defun put-borne (box x y z out)
  "Put into OUT what contacts exert about X Y Z, from the centre of BOX, as they bear its weight:
the opposite of gravity's wrench there, with signs."
  (declare (type box box) (double-float x y z) (type six out))
  (let* ((weight (%box-weight box)) (down (%box-down box)) (centre (%box-mass-centre box))
         (gx (aref down 0)) (gy (aref down 1)) (gz (aref down 2))
         (x (- x (aref centre 0))) (y (- y (aref centre 1))) (z (- z (aref centre 2))))
    (setf (aref out 0) (- (* weight gx))
          (aref out 1) (- (* weight gy))
          (aref out 2) (- (* weight gz))
          (aref out 3) (* weight (- (* y gz) (* z gy)))
          (aref out 4) (* weight (- (* z gx) (* x gz)))
          (aref out 5) (* weight (- (* x gy) (* y gx))))))

(defun put-load (box x y z out)
  "Put into OUT the load of gravity at a grasp centre X Y Z from the centre of BOX: the weight along
the axes, and the torques that it causes there, all without signs."
  (declare (type box box) (double-float x y z) (type six out))
  (let ((weight (%box-weight box)))
    (if (%box-plain box)
        (setf (aref out 0) 0d0
              (aref out 1) 0d0
              (aref out 2) weight
              (aref out 3) (* weight (abs y))
              (aref out 4) (* weight (abs x))
              (aref out 5) 0d0)
        (put-turned-load box x y z out))))

(defun put-turned-load (box x y z out)
  "As PUT-LOAD, wherever gravity points and the centre of mass is."
  (declare (type box box) (double-float x y z) (type six out))
  (put-borne box x y z out)
  (dotimes (axis 6)
    (setf (aref out axis) (abs (aref out axis)))))

(defun quality-index (gamma velocity-radius velocity-limit force-radius force-limit)
  "Return Q = GAMMA u_t + (1 - GAMMA) u_w; where a task needs only forces or only velocities (its
other limit is -1), the radius of that kind alone.  Source: the paper, Description."
  (declare (double-float gamma velocity-radius force-radius) (fixnum velocity-limit force-limit))
  (cond ((minusp velocity-limit) force-radius)
        ((minusp force-limit) velocity-radius)
        (t (+ (* gamma velocity-radius) (* (- 1d0 gamma) force-radius)))))

(defun direction-shares (motion need)
  "Return the share that each force and torque has in the direction of MOTION: six numbers, whose
squares add up to 1.

MOTION  six numbers, velocities along X Y Z and rotations about X Y Z, as EXACT-RADIUS returns.
NEED    six numbers, forces along X Y Z and torques about X Y Z: the task ellipsoid.

The ellipsoid reaches farthest in MOTION at the wrench whose components are these shares of the
needs.  If MOTION moves nothing that is needed, they are the shares in MOTION itself."
  (let ((needed (mapcar #'* motion need)))
    (unit-length (loop for part in (if (every #'zerop needed) motion needed)
                       collect (coerce part 'double-float)))))
