;;;; matchings.lisp -- the 24 matchings between the faces of the box and those of the grasp.
;;;;
;;;; The grasp has six faces of its own, the grasp faces N1 N2 O1 O2 A1 A2, numbered 0 to 5.  A
;;;; matching gives each of them a face of the box, so that N O A is a proper rotation of X Y Z.

(in-package :supergrip)

(defparameter +grasp-faces+ #(:n1 :n2 :o1 :o2 :a1 :a2)
  "The faces of a grasp.  N1 lies on the + side of the axis N, N2 on the - side, and so on.")

(defun grasp-face-index (name)
  "Return the grasp face, 0 to 5, that NAME names, or NIL."
  (and (namep name) (position (symbol-name name) +grasp-faces+ :test #'string=)))

(defstruct matching
  "FACES holds the box face of each grasp face; AXES, six, which axis of the box frame (0 to 5, see
AXIS-NAME) is that along, or about, each of N O A; SIGNS 1 where N, O, A points the way that its box
axis does, -1 where it does not."
  (index 0 :type fixnum :read-only t)
  (faces nil :type simple-vector :read-only t)
  (axes nil :type (simple-array (unsigned-byte 8) (6)) :read-only t)
  (signs nil :type (simple-array double-float (3)) :read-only t))

(define-printing (matching matching) "~{~a~^ ~}" (matching-names matching))

(defun permutation-sign (axes)
  "Return 1 if the three AXES are an even permutation of 0 1 2, else -1."
  (if (member axes '((0 1 2) (1 2 0) (2 0 1)) :test #'equal) 1 -1))

(defun third-face (n1 a1)
  "Return the face O1 that makes a proper rotation of N1 and A1."
  (let* ((axis (- 3 (face-axis n1) (face-axis a1)))
         (sign (* (face-sign n1) (face-sign a1)
                  (permutation-sign (list (face-axis n1) axis (face-axis a1))))))
    (find-if (lambda (face) (and (= (face-axis face) axis) (= (face-sign face) sign)))
             '(0 1 2 3 4 5))))

(defun box-axes (faces)
  "Return the axes of the box frame along, then about which FACES, those of N1 O1 A1, lie."
  (coerce (append (mapcar #'face-axis faces)
                  (loop for face in faces collect (+ 3 (face-axis face))))
          '(simple-array (unsigned-byte 8) (6))))

(defun box-signs (faces)
  (map '(simple-array double-float (3)) (lambda (face) (float (face-sign face) 1d0)) faces))

(defun all-matchings ()
  "Return the 24 matchings in the order in which TRY enumerates them: N1, then A1, each in the
order of the faces; O follows."
  (let ((index -1))
    (coerce (loop for n1 below 6
                  append (loop for a1 below 6
                               unless (= (face-axis n1) (face-axis a1))
                                 collect (let* ((o1 (third-face n1 a1))
                                                (firsts (list n1 o1 a1)))
                                           (make-matching
                                            :index (incf index)
                                            :faces (coerce (loop for face in firsts
                                                                 collect face
                                                                 collect (opposite face))
                                                           'simple-vector)
                                            :axes (box-axes firsts)
                                            :signs (box-signs firsts)))))
            'simple-vector)))

(defparameter +matchings+ (all-matchings)
  "The 24 matchings, in order.  Sets of them are integers, one bit each.")

(deftype matching-set () '(unsigned-byte 24))
(deftype matching-sets (&optional (count '*)) `(simple-array matching-set (,count)))

(defparameter +all-matchings+ (1- (ash 1 24)) "The set of all matchings.")

(defparameter +matchings-with+
  (let ((sets (make-array '(6 6) :element-type '(unsigned-byte 24) :initial-element 0)))
    (loop for matching across +matchings+
          do (loop for face across (matching-faces matching)
                   for grasp-face from 0
                   do (incf (aref sets grasp-face face) (ash 1 (matching-index matching)))))
    sets)
  "The set of the matchings that give a grasp face (first index) a face of the box (second).")
(declaim (type (simple-array (unsigned-byte 24) (6 6)) +matchings-with+))

(defun turned (matching turn)
  "Return MATCHING after a TURN of the grasp, a vector: grasp face i takes the box face of TURN[i]."
  (let ((faces (map 'simple-vector
                    (lambda (grasp-face) (svref (matching-faces matching) grasp-face)) turn)))
    (find faces +matchings+ :key #'matching-faces :test #'equalp)))

(defparameter +turns+
  (loop for (kind turn) in '((:half-turn #(1 0 3 2 4 5))
                             (:third-turn #(2 3 4 5 0 1))
                             (:third-turn #(4 5 0 1 2 3)))
        collect (list kind turn (map 'vector (lambda (matching)
                                               (ash 1 (matching-index (turned matching turn))))
                                     +matchings+)))
  "The turns that may leave a grasp the same: the half-turn about A, and the two third-turns about
the corner of N1 O1 A1.  Of each, its kind, where it takes the grasp faces, and for each matching
the set of the one that it becomes.")

(defun axis-name (axis)
  "Return the name of AXIS, 0 to 5, of the box frame: \"along X\" to \"about Z\"."
  (aref #("along X" "along Y" "along Z" "about X" "about Y" "about Z") axis))

(defun matching-names (matching)
  "Return the names of the box faces of MATCHING, in the order N1 N2 O1 O2 A1 A2."
  (map 'list #'face-name (matching-faces matching)))
