;;;; faces.lisp -- the six faces of a box, and lists of them in one integer.
;;;;
;;;; A face is its place, 0 to 5, in the order in which the paper's session enumerates faces.
;;;; A list of distinct faces is one integer: bits 0-5 are the set of its members, and bits 6+3j to
;;;; 8+3j hold the face at place j.  The same layout serves for bindings, place j being the
;;;; variable j.

(in-package :supergrip-chainer)

(deftype face () "A face: 0 to 5." '(integer 0 5))
(deftype face-list () "A list of at most six distinct faces." '(unsigned-byte 24))

(defparameter +faces+ #(:z2 :z1 :y2 :y1 :x2 :x1)
  "The faces in the order in which they are enumerated: x1 to z2, the newest first.")

(defun face-index (name)
  "Return the face that NAME, a symbol or a string, names, or NIL."
  (or (position name +faces+)           ; as the reader returns it
      (position (string name) +faces+ :test #'string-equal)))

(defun face-name (face)
  "Return the name of FACE, a string such as \"Z2\"."
  (symbol-name (svref +faces+ face)))

(declaim (inline opposite face-axis face-sign))
(defun opposite (face)
  "Return the face opposed to FACE."
  (declare (type face face))
  (logxor face 1))

(defun face-axis (face)
  "Return the axis normal to FACE: 0 for X, 1 for Y, 2 for Z."
  (declare (type face face))
  (- 2 (ash face -1)))

(defun face-sign (face)
  "Return 1 for a face on the + side of its axis (X1, Y1, Z1), -1 for one on the - side."
  (declare (type face face))
  (if (logtest face 1) 1 -1))

(declaim (inline face-list-mask face-list-ref face-list-with face-list-count))
(defun face-list-mask (face-list)
  "Return the set of the faces of FACE-LIST, one bit each."
  (declare (type face-list face-list))
  (logand face-list 63))

(defun face-list-ref (face-list place)
  "Return the face at PLACE of FACE-LIST."
  (declare (type face-list face-list) (type (integer 0 5) place))
  (logand 7 (ash face-list (- (+ 6 (* 3 place))))))

(defun face-list-with (face-list place face)
  "Return FACE-LIST with FACE at PLACE, which was empty."
  (declare (type face-list face-list) (type (integer 0 5) place) (type face face))
  (logior face-list (ash 1 face) (the face-list (ash face (+ 6 (* 3 place))))))

(defun face-list-count (face-list)
  "Return how many faces FACE-LIST holds."
  (declare (type face-list face-list))
  (logcount (face-list-mask face-list)))

(defun make-face-list (faces)
  "Return FACES, a list of distinct faces, as a face list."
  (let ((face-list 0))
    (loop for face in faces
          for place from 0
          do (setf face-list (face-list-with face-list place face)))
    face-list))

(defun face-list-elements (face-list)
  "Return the list of the faces of FACE-LIST, in order."
  (loop for place below (face-list-count face-list) collect (face-list-ref face-list place)))

(defun face-list-names (face-list)
  "Return the list of the names of the faces of FACE-LIST, in order."
  (mapcar #'face-name (face-list-elements face-list)))
