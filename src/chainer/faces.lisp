;;;; faces.lisp -- the six faces of a box, and lists of them in one integer.
;;;;
;;;; A face is its place, 0 to 5, in the order in which the paper's session enumerates faces.
;;;; A list of distinct faces is packed: bits 0-5 are the set of its members, and bits 6+3j to
;;;; 8+3j hold the face at place j.  The same layout serves for bindings, place j being the
;;;; variable j.

(in-package :supergrip-chainer)

(deftype surface () "A face: 0 to 5." '(integer 0 5))
(deftype packed () "A list of at most six distinct faces." '(unsigned-byte 24))

(defparameter +surfaces+ #(:z2 :z1 :y2 :y1 :x2 :x1)
  "The faces in the order in which they are enumerated: x1 to z2, the newest first.")

(defun surface-index (name)
  "Return the face that NAME, a symbol or a string, names, or NIL."
  (position (string name) +surfaces+ :test #'string-equal :key #'string))

(defun surface-name (surface)
  "Return the name of SURFACE, a string such as \"Z2\"."
  (symbol-name (svref +surfaces+ surface)))

(declaim (inline opposite surface-axis surface-sign))
(defun opposite (surface)
  "Return the face opposed to SURFACE."
  (declare (type surface surface))
  (logxor surface 1))

(defun surface-axis (surface)
  "Return the axis normal to SURFACE: 0 for X, 1 for Y, 2 for Z."
  (declare (type surface surface))
  (- 2 (ash surface -1)))

(defun surface-sign (surface)
  "Return 1 for a face on the + side of its axis (X1, Y1, Z1), -1 for one on the - side."
  (declare (type surface surface))
  (if (logtest surface 1) 1 -1))

(declaim (inline pack-mask pack-ref pack-with pack-count))
(defun pack-mask (packed)
  "Return the set of the faces of PACKED, one bit each."
  (declare (type packed packed))
  (logand packed 63))

(defun pack-ref (packed place)
  "Return the face at PLACE of PACKED."
  (declare (type packed packed) (type (integer 0 5) place))
  (logand 7 (ash packed (- (+ 6 (* 3 place))))))

(defun pack-with (packed place surface)
  "Return PACKED with SURFACE at PLACE, which was empty."
  (declare (type packed packed) (type (integer 0 5) place) (type surface surface))
  (logior packed (ash 1 surface) (the packed (ash surface (+ 6 (* 3 place))))))

(defun pack-count (packed)
  "Return how many faces PACKED holds."
  (declare (type packed packed))
  (logcount (pack-mask packed)))

(defun pack (surfaces)
  "Return SURFACES, a list of distinct faces, packed."
  (let ((packed 0))
    (loop for surface in surfaces
          for place from 0
          do (setf packed (pack-with packed place surface)))
    packed))

(defun pack-elements (packed)
  "Return the list of the faces of PACKED, in order."
  (loop for place below (pack-count packed) collect (pack-ref packed place)))

(defun pack-names (packed)
  "Return the list of the names of the faces of PACKED, in order."
  (mapcar #'surface-name (pack-elements packed)))
