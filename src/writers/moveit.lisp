;;;; moveit.lisp -- grasps as moveit_msgs/Grasp, as YAML: one document a grasp.
;;;;
;;;; Source: moveit_msgs/msg/Grasp.msg and GripperTranslation.msg, of ROS 1 and 2.  Headers have no
;;;; stamp, since ROS 1 and 2 name its fields differently.  A stamp that is left out is 0.

(in-package :supergrip)

(defparameter +clearance+ 5d0 "How far beyond the box, in cm, fingertips begin their approach.")
(defparameter +lift+ 10d0 "How far, in cm, a box is lifted, if there is room.")

(defun approach-distance (candidate plan)
  "Return how far, in cm, the hand of CANDIDATE of PLAN must be backed until its fingertips clear
the box: the depth of the deepest contact below the face that the palm is over."
  (let* ((approach (candidate-approach candidate))
         (axis (position-if-not #'zerop approach))
         (half (/ (nth axis (box-size (plan-box plan))) 2d0)))
    (loop for contact in (candidate-contacts candidate plan)
          maximize (+ half (* (nth axis approach) (nth axis (getf contact :position)))))))

(defun put-xyz (vector out)
  (format out "{x: ~a, y: ~a, z: ~a}" (number-in-text (first vector))
          (number-in-text (second vector)) (number-in-text (third vector))))

(defun put-posture (field out)
  "Write FIELD, an internal posture of the hand, to OUT: no joint is known."
  (format out "~a: {header: {frame_id: ''}, joint_names: [], points: []}~%" field))

(defun put-motion (field frame direction least out)
  "Write FIELD, a motion in DIRECTION, in FRAME, as text, by LEAST, in cm, at least, to OUT."
  (format out "~a:~%  direction: {header: {frame_id: ~a}, vector: " field frame)
  (put-xyz (mapcar #'without-sign-of-zero direction) out)
  (format out "}~%  desired_distance: ~a~%  min_distance: ~a~%"
          (number-in-text (/ (+ least +clearance+) 100d0)) (number-in-text (/ least 100d0))))

(defun put-moveit-pose (candidate plan out)
  "Write the pose of the palm's frame of CANDIDATE of PLAN, in the frame of the box, to OUT."
  (let ((hand (candidate-hand candidate plan)))
    (format out "grasp_pose:~%  header: {frame_id: ''}~%  pose:~%    position: ")
    (put-xyz (palm-position hand candidate plan) out)
    (format out "~%    orientation: {~{~a: ~a~^, ~}}~%"
            (loop for axis in '("x" "y" "z" "w")
                  for number in (getf hand :orientation)
                  collect axis collect (number-in-text number)))))

(defun put-moveit-grasp (name candidate plan out)
  "Write CANDIDATE of PLAN, of a box called NAME, as one message to OUT."
  (let ((frame (quoted-text (or name "") :yaml))
        (approach (candidate-approach candidate))
        (distance (approach-distance candidate plan)))
    (format out "---~%id: ~a~%" (quoted-text (format nil "~@[~a: ~]~a" name (grasp-words candidate))
                                             :yaml))
    (put-posture "pre_grasp_posture" out)
    (put-posture "grasp_posture" out)
    (put-moveit-pose candidate plan out)
    (format out "grasp_quality: ~a~%" (number-in-text (candidate-quality candidate)))
    (put-motion "pre_grasp_approach" frame approach distance out)
    (put-motion "post_grasp_retreat" frame (mapcar #'- (box-down (plan-box plan)))
                (- +lift+ +clearance+) out)
    (put-motion "post_place_retreat" frame (mapcar #'- approach) distance out)
    (format out "max_contact_force: ~a~%allowed_touch_objects: []~%"
            (number-in-text (or (finger-newtons plan) 0d0)))))

(define-writer :moveit "moveit_msgs/Grasp" (name grasps plan reason)
  (with-output-to-string (out)
    (if grasps
        (dolist (candidate grasps)
          (put-moveit-grasp name candidate plan out))
        (format out "---~%# ~@[~a: ~]~a~%" (and name (quoted-text name :yaml))
                (quoted-text reason :yaml)))))
