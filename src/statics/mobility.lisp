;;;; mobility.lisp -- how easily two-link fingers move what they hold, along and about each axis.
;;;;
;;;; A finger stands on the plane of the palm, half the distance between the bases outward from the
;;;; middle.  Its two links bend in the plane of the approach and the outward direction, the elbow
;;;; outward; its base turns about the approach.  No joint turns faster than 1.  A tip stays on its
;;;; place, and may pivot a little about the normal there beyond what the joints do.

(in-package :supergrip-statics)

(deftype vector-3 () '(simple-array double-float (3)))

(defconstant +clearance+ 0.3d0 "How far the palm stays away from what is held, in cm, at least.")
(defconstant +pivot-at-rest+ 0.2d0
  "The part of the greatest rotation that a tip pivots at most if no tip is moved.")
(defconstant +pivot+ 0.5d0 "The same if one is moved.")
(defconstant +rotation+ 2d0 "The rotation, in rad/s, that is full mobility.")

(defun vector-3 (x y z)
  (let ((vector (make-array 3 :element-type 'double-float)))
    (setf (aref vector 0) x (aref vector 1) y (aref vector 2) z)
    vector))

(declaim (inline dot-3))
(defun dot-3 (a b)
  (declare (type vector-3 a b))
  (+ (* (aref a 0) (aref b 0)) (* (aref a 1) (aref b 1)) (* (aref a 2) (aref b 2))))

(defun cross-3 (a b)
  "Return A x B."
  (declare (type vector-3 a b))
  (flet ((part (i j) (- (* (aref a i) (aref b j)) (* (aref a j) (aref b i)))))
    (vector-3 (part 1 2) (part 2 0) (part 0 1))))

(defun across-3 (vector approach)
  "Return the direction of VECTOR across the unit vector APPROACH, of length 1, or NIL if it has
none."
  (declare (type vector-3 vector approach))
  (let* ((along (dot-3 vector approach))
         (part (map 'vector-3 (lambda (a b) (- a (* along b))) vector approach))
         (length (sqrt (the not-negative (dot-3 part part)))))
    (and (> length 1d-6)
         (map 'vector-3 (lambda (a) (/ a length)) part))))

;;; Fingers

(defstruct (finger (:conc-name finger-) (:copier nil))
  "A finger at rest.  PLACE is that of its tip, NORMAL inward there, OUTWARD the direction from the
middle of the palm to its base.  Once the palm is placed: SINES of the first joint and of the tip's
place seen from the base: INNER and TIP are vectors (outward, along the approach) of the second
link, and from the base to the tip; SIDE, the direction of the tip's motion as the base turns."
  (place nil :type vector-3) (normal nil :type vector-3) (outward nil :type vector-3)
  (side nil :type vector-3)
  (lever 0d0 :type double-float) (depth 0d0 :type double-float)
  (outer-lever 0d0 :type double-float) (outer-depth 0d0 :type double-float)
  (reaches nil :type boolean))

(defun outward-directions (normals approach)
  "Return the direction of the base of each finger from the middle of the palm, unit vectors across
APPROACH.  A finger closes along its inward normal; one whose normal is along APPROACH stands
opposite to the others."
  (let* ((directions (loop for normal in normals
                           collect (across-3 (map 'vector-3 #'- normal) approach)))
         (sum (reduce (lambda (a b) (map 'vector-3 #'+ a b)) (remove nil directions)
                      :initial-value (vector-3 0d0 0d0 0d0)))
         (opposite (or (across-3 (map 'vector-3 #'- sum) approach)
                       (across-3 (vector-3 1d0 0d0 0d0) approach)
                       (vector-3 0d0 1d0 0d0))))
    (loop for direction in directions collect (or direction opposite))))

(defun root-posit (number)
  (declare (double-float number))
  (sqrt (max 0d0 number)))

(defun palm-depth (levers length clearance)
  "Return how far the palm is behind the grasp centre: half of what the finger that reaches least
reaches, or where it clears the face, CLEARANCE away.  LEVERS are the distances of the tips from
their bases across the approach."
  (max (/ (loop for lever in levers
                minimize (+ length (root-posit (- (* length length) (* lever lever)))))
          2)
       clearance))

(defun bend (finger depth length)
  "Bend FINGER, of two links of LENGTH, so that its tip is DEPTH from its base along the approach."
  (let* ((lever (finger-lever finger))
         (square (+ (* lever lever) (* depth depth)))
         (half (/ (sqrt (the not-negative square)) 2))
         (height (root-posit (- (* length length) (* half half)))))
    (setf (finger-depth finger) depth
          (finger-reaches finger) (and (> half 0d0) (<= half length)))
    (when (finger-reaches finger)
      ;; From the elbow to the tip: half the way, and back from where the elbow stands out.
      (let ((up (/ height (* 2 half))))
        (setf (finger-outer-lever finger) (- (/ lever 2) (* up depth))
              (finger-outer-depth finger) (+ (/ depth 2) (* up lever)))))
    finger))

(defun fingers-at (places normals approach face length distance)
  "Return the fingers, of two links of LENGTH, whose bases stand DISTANCE apart, at PLACES with the
inward NORMALS, the palm over the face that is FACE behind the grasp centre, against APPROACH."
  (let* ((outward (outward-directions normals approach))
         (levers (loop for place in places for out in outward
                       collect (- (dot-3 place out) (/ distance 2))))
         (depth (palm-depth levers length (+ face +clearance+))))
    (loop for place in places
          for normal in normals
          for out in outward
          for lever in levers
          collect (bend (make-finger :place place :normal normal :outward out
                                     :side (cross-3 approach out) :lever lever)
                        (+ depth (dot-3 place approach))
                        length))))

;;; How fast

(defun joint-rates (finger out along)
  "Return the rates of the two joints of FINGER whose tip moves by OUT outward and ALONG the
approach, for each unit of it; NIL if there are none."
  (declare (double-float out along))
  ;; A rate r turns a vector (lever, depth) by r (-depth, lever): both joints turn towards outward.
  (let* ((l1 (finger-lever finger)) (d1 (finger-depth finger))
         (l2 (finger-outer-lever finger)) (d2 (finger-outer-depth finger))
         (determinant (- (* d2 l1) (* d1 l2))))
    (cond ((and (zerop out) (zerop along)) (values 0d0 0d0))
          ((< (abs determinant) 1d-9) nil)
          (t (values (/ (- (* out (- l2)) (* along d2)) (- determinant))
                     (/ (+ (* out l1) (* along d1)) (- determinant)))))))

(defun finger-speed (finger velocity rotation approach pivot)
  "Return how many times FINGER can move its tip by VELOCITY, and what it holds by ROTATION, at the
most: infinity if it need not move.  PIVOT is the greatest rotation of the tip about its normal that
no joint drives."
  (declare (type vector-3 velocity rotation approach) (double-float pivot))
  (let ((most sb-ext:double-float-positive-infinity)
        (turn (dot-3 velocity (finger-side finger)))
        (lever (finger-lever finger))
        (spin (dot-3 rotation (finger-normal finger)))
        (drive (dot-3 approach (finger-normal finger))))
    (flet ((limit (rate greatest)
             (let ((rate (abs rate)))
               (when (> rate 1d-12) (setf most (min most (/ greatest rate)))))))
      (multiple-value-bind (first second)
          (joint-rates finger (dot-3 velocity (finger-outward finger)) (dot-3 velocity approach))
        (unless (and first (finger-reaches finger))
          (return-from finger-speed 0d0))
        (limit first 1d0)
        (limit second 1d0))
      (cond ((> (abs lever) 1d-9)
             (limit (/ turn lever) 1d0)
             (limit (- spin (* drive (/ turn lever))) pivot))
            ((> (abs turn) 1d-12) (return-from finger-speed 0d0))
            (t (limit spin (+ pivot (abs drive)))))
      most)))

(defun unit-3 (k)
  (let ((vector (vector-3 0d0 0d0 0d0)))
    (setf (aref vector k) 1d0)
    vector))

(defun mobility-entry (fingers approach k length)
  "Return the mobility of FINGERS, of two links of LENGTH, along axis K, 0 to 2, or about it, 3 to
5."
  (let* ((still (vector-3 0d0 0d0 0d0)) (about (>= k 3)) (axis (unit-3 (mod k 3)))
         (rotation (if about axis still))
         (velocities (loop for finger in fingers
                           collect (if about (cross-3 axis (finger-place finger)) axis)))
         (at-rest (every (lambda (velocity) (every #'zerop velocity)) velocities))
         (pivot (* +rotation+ (if at-rest +pivot-at-rest+ +pivot+)))
         (speed (loop for finger in fingers
                      for velocity in velocities
                      minimize (finger-speed finger velocity rotation approach pivot))))
    (min 1d0 (/ speed (if about +rotation+ length)))))

(defun mobility (places normals approach face length distance)
  "Return how well fingers move what they hold along X Y Z and about X Y Z: six numbers from 0, not
at all, to 1, freely: a list.

PLACES, NORMALS  lists of arrays of three doubles: the tips from the grasp centre, in cm, and their
                 inward unit normals.
APPROACH         the unit vector from the palm to the grasp centre.
FACE             how far the face under the palm is from the grasp centre, in cm.
LENGTH, DISTANCE of each of a finger's two links; between the bases of opposed fingers: in cm.

An entry is s / LENGTH along an axis, s / (2 rad/s) about one, at most 1: s is the greatest speed
for which each finger has joint rates of at most 1 that move its tip along, and for which the
rotation about the normal that its joints do not drive is at most 0.4 rad/s if no tip moves, else 1
rad/s.  A finger that does not reach its place moves nothing.
Source: docs/physics.md, how entries are computed from the contacts."
  (without-float-traps
    (let ((fingers (fingers-at places normals approach face length distance)))
      (loop for k below 6 collect (mobility-entry fingers approach k length)))))
