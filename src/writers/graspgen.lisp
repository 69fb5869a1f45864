;;;; graspgen.lisp -- grasps as the data of GraspGen: one JSON object a line.
;;;;
;;;; Source: NVIDIA GraspGen, "Gripper Description": approach along z of the gripper, closing along
;;;; x. That is the hand's frame.

(in-package :supergrip)

(defun put-transform (candidate plan out)
  "Write the frame of the palm of CANDIDATE of PLAN, in that of the box, as a matrix 4 x 4 to OUT."
  (let* ((hand (candidate-hand candidate plan))
         (columns (append (hand-matrix hand candidate)
                          (list (palm-position hand candidate plan)))))
    (write-char #\[ out)
    (dotimes (row 3)
      (format out "[~a], " (numbers-in-text (mapcar (lambda (column) (nth row column)) columns))))
    (write-string "[0.0, 0.0, 0.0, 1.0]]" out)))

(define-writer :graspgen "GraspGen's data" (name grasps plan reason)
  (with-output-to-string (out)
    (format out "{\"object\": {\"file\": ~a, \"scale\": 1.0}, \"grasps\": {\"transforms\": ["
            (quoted-text (format nil "~a.obj" (file-stem name)) :json))
    (loop for (candidate . others) on grasps
          do (put-transform candidate plan out)
             (when others (write-string ", " out)))
    (format out "], \"object_in_gripper\": [~a]}}~%"
            (list-in-text (mapcar (constantly "true") grasps)))))
