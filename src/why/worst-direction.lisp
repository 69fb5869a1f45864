;;;; worst-direction.lisp -- the direction in which contacts have the least to spare, in words.

(in-package :supergrip)

(defparameter *share-that-counts* 1/3
  "A direction's words name a force or torque whose share is this part of the greatest, or more.")

(defun direction-text (motion need)
  "Return MOTION, the worst one of a task NEED, in words: \"pushed along +Y and turned about -Z\".

MOTION  six numbers, velocities along X Y Z and rotations about X Y Z, as EXACT-RADIUS returns.
NEED    six numbers, forces along X Y Z and torques about X Y Z, about the box centre.

It is how the grasp is to push and turn the box where it has the least to spare.  Only the forces
and torques that count are named: those that have at least a third of the greatest share in the
wrench there."
  (let* ((shares (direction-shares motion need))
         (least (* *share-that-counts* (reduce #'max shares :key #'abs))))
    (flet ((part (verb start)
             (let ((names (loop for axis from start below (+ start 3)
                                for share = (nth axis shares)
                                when (>= (abs share) least)
                                  collect (plain-text "~:[+~;-~]~c" (minusp share)
                                                      (char "XYZ" (mod axis 3))))))
               (and names
                    (list (plain-text "~a ~{~a~^, ~}~:[~; and ~]~a" verb (butlast names)
                                      (rest names) (first (last names))))))))
      (plain-text "~{~a~^ and ~}" (append (part "pushed along" 0) (part "turned about" 3))))))
