;;;; motions.lisp -- a motion of the box in words.

(in-package :supergrip)

(defun signed-axes (motion from least)
  "Return the axes of the components of MOTION, six numbers, from the place FROM that are not below
LEAST, with their signs: \"+Y and -Z\"; or NIL."
  (let ((axes (loop for k below 3
                    for component = (elt motion (+ from k))
                    when (>= (abs component) least)
                      collect (format nil "~:[-~;+~]~a" (plusp component) (char "XYZ" k)))))
    (and axes (format nil "~{~a~#[~; and ~:;, ~]~}" axes))))

(defun motion-text (motion push turn)
  "Return MOTION, six numbers, in words: what is at least half as great as the greatest.  PUSH and TURN
are the verbs: \"pushed along +Y and turned about -Z\"."
  (let* ((least (* 1/2 (reduce #'max motion :key #'abs)))
         (along (signed-axes motion 0 least))
         (about (signed-axes motion 3 least)))
    (format nil "~@[~a~]~:[~; and ~]~@[~a~]"
            (and along (format nil "~a along ~a" push along))
            (and along about)
            (and about (format nil "~a about ~a" turn about)))))
