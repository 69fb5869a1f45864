;;;; isaac.lisp -- grasps as an isaac_grasp file, version 1.0: YAML, one document a box.
;;;;
;;;; Source: NVIDIA Isaac ROS documentation, "Isaac Grasp File".  The fields of joints are left out,
;;;; since no gripper names its joints.

(in-package :supergrip)

(defun borne-share (candidate plan)
  "Return how many times the forces needed CANDIDATE of PLAN surely bears, in exact mode and where
needs are absolute; else NIL.  NIL where no force is needed."
  (cond ((null (candidate-force-radius candidate)) nil)
        ((eq (plan-index plan) :exact) (candidate-force-radius candidate))
        ((absolute-units-p (%box-units (plan-box plan)))
         (or (nth-value 1 (candidate-exact-radius candidate plan))
             (candidate-sure candidate plan)))))

(defun confidence (candidate plan)
  "Return how sure CANDIDATE of PLAN is, 0 to 1: the share of the forces needed that it surely
bears, if BORNE-SHARE tells it; else Q/(1+Q), which orders grasps as Q does."
  (let ((share (borne-share candidate plan)) (quality (candidate-quality candidate)))
    (if share
        (min 1d0 (max 0d0 share))
        (/ quality (+ 1d0 quality)))))

(defun put-isaac-grasp (candidate plan number out)
  "Write CANDIDATE of PLAN, the grasp of NUMBER, to the stream OUT."
  (let ((hand (candidate-hand candidate plan)))
    (destructuring-bind (x y z w) (getf hand :orientation)
      (format out "  \"grasp_~d\":  # ~a~%" number (grasp-words candidate))
      (format out "    confidence: ~a~%" (number-in-text (confidence candidate plan)))
      (format out "    position: [~a]~%" (numbers-in-text (palm-position hand candidate plan)))
      (format out "    orientation: {w: ~a, xyz: [~a]}~%" (number-in-text w)
              (numbers-in-text (list x y z))))))

(define-writer :isaac "an isaac_grasp file" (name grasps plan reason)
  (with-output-to-string (out)
    (format out "---~%~@[# ~a~%~]" (and reason (quoted-text reason :yaml)))
    (format out "format: isaac_grasp~%format_version: 1.0~%~%object_frame: ~a~%~
                 gripper_frame: \"palm\"~%~%"
            (quoted-text (or name "box") :yaml))
    (format out "grasps:~:[ {}~;~]~%" grasps)
    (loop for candidate in grasps
          for number from 0
          do (put-isaac-grasp candidate plan number out))))
