;;;; pose.lisp -- how a box lies: its frame in the world, its centre of mass, and gravity.
;;;;
;;;; The world's Z points up.  Without a POSE the box frame is turned as the world is, so Z2 is the
;;;; bottom.  Without a CENTRE the centre of mass is the box centre.

(in-package :supergrip)

(defstruct (pose (:constructor make-pose (position orientation)))
  "The frame of a box in the world: POSITION, that of the box centre, a list of three, in cm;
ORIENTATION, a list of four, the quaternion (see rotations.lisp) that turns it there, of length 1 as
nearly as it was given."
  (position nil :type list :read-only t) (orientation nil :type list :read-only t))

(define-box-key :pose :pose
  #.(format nil "the place of the box centre in the world, x y z in ~~a, and a unit quaternion ~
                 x y z w, which turns the box there")
  ((40 0 12.5d0) (0 0 0 1))
  :measure :length :optional t)
(define-box-key :centre :place "three numbers in ~a, the centre of mass from the box centre"
  (0 0 -0.5d0)
  :measure :length :optional t)

;;; Reading

(defmethod each-number ((pose pose) function)
  (let ((position (loop for number in (pose-position pose)
                        collect (or (funcall function number 0) (return nil)))))
    (and position (make-pose position (pose-orientation pose)))))

(defmethod parse-values ((type (eql :place)) row values)
  (number-list row values 3 nil nil values))

(defmethod parse-values ((type (eql :pose)) row values)
  (if (and (= (length values) 2) (every #'consp values))
      (let ((position (number-list row (first values) 3 nil nil values 0))
            (orientation (number-list row (second values) 4 nil nil values 1)))
        (and position orientation
             (checked-pose row (coerce position 'list) (coerce orientation 'list))))
      (refuse-value row values)))

(defun rounded-place (number digits)
  "Return NUMBER, a double, rounded to DIGITS places after the point."
  (coerce (/ (round (* (rational number) (expt 10 digits))) (expt 10 digits)) 'double-float))

(defun checked-pose (row position orientation)
  "Return the pose of POSITION and ORIENTATION, lists of doubles that the key ROW gives, or
complain."
  (flet ((text (numbers)
           (value-text *notation* (mapcar #'plain-real numbers))))
    (cond ((unit-quaternion-p orientation)
           (make-pose position orientation))
          ((every #'zerop orientation)
           (complain (value-spot row 1) "~a is no rotation; a box that stands upright has ~a"
                     (text orientation) (text '(0d0 0d0 0d0 1d0))))
          (t
           (complain (value-spot row 1) "~a is no unit quaternion: its length is ~a, not 1; the ~
                                         same rotation has ~a"
                     (text orientation) (first (number-texts (vector-length orientation) 1))
                     (text (loop for number in (unit-length orientation)
                                 collect (rounded-place number 9))))))))

(defun centre-fault (values)
  "Return in words that the centre of mass in VALUES, a plist, lies outside the box; or NIL."
  (let* ((centre (getf values :centre)) (size (getf values :size))
         (axis (and centre size
                    (position-if #'plusp (map 'list (lambda (c s) (- (abs c) (/ s 2)))
                                              centre size)))))
    (when axis
      (let ((at (aref centre axis)))
        (destructuring-bind (at end) (number-texts at (* (signum at) 0.5d0 (aref size axis)))
          (format nil "the centre of mass lies outside the box: ~a it is ~a from the box centre, ~
                       and the box ends at ~a" (axis-name axis) at end))))))

;;; Gravity

(defconstant +down-digits+ 12
  "To how many places the direction of gravity is rounded: the rest is the rounding of quaternions,
and would tell apart what is the same.")

(defparameter +upright+ (coerce '(0d0 0d0 -1d0) 'three) "Where down is for a box without a pose.")
(defparameter +box-centre+ (make-three))

(defun pose-matrix (pose)
  "Return the matrix of the rotation of POSE: its columns are the axes of the box in the world."
  (quaternion-matrix (unit-length (pose-orientation pose))))

(defun down-of (pose)
  "Return the unit vector down in the frame of a box of POSE, which may be NIL."
  (if pose
      (map 'three (lambda (column) (+ 0d0 (rounded-place (- (third column)) +down-digits+)))
           (pose-matrix pose))
      +upright+))

(defun gravity-slots (others)
  "Return the slots of a box that say what gravity does to it, a plist; OTHERS has its pose and
centre."
  (let* ((down (down-of (getf others :pose))) (centre (getf others :centre +box-centre+))
         (middle (equalp centre +box-centre+)))
    (list :down down :mass-centre centre :plain (and middle (equalp down +upright+))
          :gravity-axis (and middle (= 1 (count 0d0 down :test #'/=))
                             (position 0d0 down :test #'/=)))))

(defun gravity-on (box)
  "Return the wrench of the weight of BOX about its centre, an array of six."
  (let ((wrench (make-six)) (centre (%box-mass-centre box)))
    (flet ((torque (i j k)
             (setf (aref wrench (+ 3 i)) (+ 0d0 (- (* (aref centre j) (aref wrench k))
                                                   (* (aref centre k) (aref wrench j)))))))
      (dotimes (axis 3)
        (setf (aref wrench axis) (+ 0d0 (* (%box-weight box) (aref (%box-down box) axis)))))
      (torque 0 1 2)
      (torque 1 2 0)
      (torque 2 0 1))
    wrench))

(defun box-gravity (box)
  "Return the wrench of the weight of BOX about the box centre, a list of six: a force along X Y Z,
a torque about X Y Z, in finger forces and finger force x cm.  EXACT-RADIUS and HOLDS-P take it."
  (let ((gravity (without-float-traps (gravity-on box))))
    (unless (every #'finite-p gravity)
      (refuse-argument "the torque of the weight of ~a is out of range" box))
    (coerce gravity 'list)))

(defun %box-pose (box)
  "Return the POSE of BOX, or NIL."
  (getf (%box-others box) :pose))

(defun box-pose (box)
  "Return the pose of BOX, as it was given, or NIL: a list of the box centre in the world, in cm,
and the quaternion (X Y Z W) that turns the box frame there."
  (shown-value :pose (%box-pose box)))

(defmethod shown-value ((type (eql :pose)) pose)
  (and pose (list (copy-list (pose-position pose)) (copy-list (pose-orientation pose)))))

(defun box-centre (box)
  "Return the centre of mass of BOX from the box centre, a list along X Y Z, in cm."
  (coerce (%box-mass-centre box) 'list))

(defmethod shown-value ((type (eql :place)) place)
  (and place (coerce place 'list)))

(defun box-down (box)
  "Return the unit vector down, in the frame of BOX, a list."
  (coerce (%box-down box) 'list))
