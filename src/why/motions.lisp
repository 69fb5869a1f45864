;;;; motions.lisp -- a motion of the box in words, and the direction in which contacts have the
;;;; least to spare.

(in-package :supergrip)

(defparameter *part-that-counts* 1/3
  "The words of a motion name a component that is this part of the greatest, or more.")

(defun signed-axes (motion from least)
  "Return the axes of the components of MOTION, six numbers, from the place FROM that are not below
LEAST, with their signs: \"+Y and -Z\"; or NIL."
  (let ((axes (loop for k below 3
                    for component = (elt motion (+ from k))
                    when (>= (abs component) least)
                      collect (plain-text "~:[-~;+~]~a" (plusp component) (char "XYZ" k)))))
    (and axes (plain-text "~{~a~#[~; and ~:;, ~]~}" axes))))

(defun motion-text (motion push turn)
  "Return MOTION, six numbers along X Y Z and about X Y Z, in words: the components that count.
PUSH and TURN are the verbs: \"pushed along +Y and turned about -Z\"."
  (let* ((least (* *part-that-counts* (reduce #'max motion :key #'abs)))
         (along (signed-axes motion 0 least))
         (about (signed-axes motion 3 least)))
    (plain-text "~@[~a~]~:[~; and ~]~@[~a~]"
                (and along (plain-text "~a along ~a" push along))
                (and along about)
                (and about (plain-text "~a about ~a" turn about)))))

(defun direction-text (motion need)
  "Return MOTION, the worst one of a task NEED, in words: \"pushed along +Y and turned about -Z\".

MOTION  six numbers, velocities along X Y Z and rotations about X Y Z, as EXACT-RADIUS returns.
NEED    six numbers, forces along X Y Z and torques about X Y Z, about the box centre.

The grasp is to push and turn the box in this way where it has the least to spare.  Components of
the wrench with a large share are named: see DIRECTION-SHARES."
  (motion-text (direction-shares motion need) "pushed" "turned"))
