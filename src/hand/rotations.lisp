;;;; rotations.lisp -- rotations of space, as unit quaternions and as matrices.
;;;;
;;;; A quaternion is a list (X Y Z W) of doubles, W the real part.  A matrix is the list of its
;;;; three columns, each a list of three: the axes X Y Z of the turned frame, as the outer frame has
;;;; them.  It is right-handed: X x Y = Z.

(in-package :supergrip)

(defconstant +unit+ 1d-6 "A quaternion whose length differs from 1 by no more is a rotation.")

(defun dot-product (a b)
  "Return the inner product of A and B, lists of numbers."
  (reduce #'+ (mapcar #'* a b)))

(defun cross-product (a b)
  "Return A x B, lists of three numbers."
  (destructuring-bind (ax ay az) a
    (destructuring-bind (bx by bz) b
      (list (- (* ay bz) (* az by))
            (- (* az bx) (* ax bz))
            (- (* ax by) (* ay bx))))))

(defun largest-size (vector)
  "Return the greatest of the sizes of the numbers in VECTOR, a list of doubles."
  (loop for number of-type double-float in vector maximize (abs number) of-type double-float))

(defun vector-length (vector)
  "Return the length of VECTOR, a list of doubles.  No number is too large or too small for it."
  (let ((most (largest-size vector)) (sum 0d0))
    (declare (type (double-float 0d0) most sum))
    (if (zerop most)
        0d0
        (dolist (number vector (* most (sqrt sum)))
          (incf sum (expt (/ (the double-float number) most) 2))))))

(defun unit-length (vector)
  "Return VECTOR, a list of doubles, made of length 1; NIL if all of it is 0."
  (flet ((divided (vector divisor)
           (declare (double-float divisor))
           (loop for number of-type double-float in vector collect (/ number divisor))))
    (let ((most (largest-size vector)))
      (unless (zerop most)
        ;; Twice, so that no length is out of range.
        (let ((vector (divided vector most)))
          (divided vector (vector-length vector)))))))

(defun unit-quaternion-p (quaternion)
  "True if the length of QUATERNION is 1 within 1e-6."
  (<= (abs (- (vector-length quaternion) 1d0)) +unit+))

(defun standard-quaternion (quaternion)
  "Return the unit quaternion of the rotation of QUATERNION, any but 0, with W not below 0; if W is
0, the first of X Y Z that is not 0 is above it.  What is below 1e-15 becomes 0: it is rounding, and
would decide about the signs."
  (destructuring-bind (x y z w) (loop for number of-type double-float in (unit-length quaternion)
                                      collect (if (< (abs number) 1d-15) 0d0 number))
    (if (minusp (or (find 0d0 (list w x y z) :test #'/=) 0d0))
        (loop for number in (list x y z w) collect (- 0d0 number))
        (list x y z w))))

(defun quaternion-product (a b)
  "Return the quaternion of the rotation B followed by the rotation A."
  (destructuring-bind (ax ay az aw) a
    (destructuring-bind (bx by bz bw) b
      (list (+ (* aw bx) (* ax bw) (- (* ay bz) (* az by)))
            (+ (* aw by) (* ay bw) (- (* az bx) (* ax bz)))
            (+ (* aw bz) (* az bw) (- (* ax by) (* ay bx)))
            (- (* aw bw) (* ax bx) (* ay by) (* az bz))))))

(defun quaternion-matrix (quaternion)
  "Return the matrix of QUATERNION, a unit quaternion."
  (destructuring-bind (x y z w) quaternion
    (flet ((diagonal (a b) (- 1d0 (* 2d0 (+ (* a a) (* b b)))))
           (twice (a b sign c) (* 2d0 (+ (* a b) (* sign c w)))))
      (list (list (diagonal y z) (twice x y 1 z) (twice x z -1 y))
            (list (twice x y -1 z) (diagonal x z) (twice y z 1 x))
            (list (twice x z 1 y) (twice y z -1 x) (diagonal x y))))))

(defun matrix-quaternion (matrix)
  "Return the unit quaternion of MATRIX, a rotation: of the two, the one that STANDARD-QUATERNION
returns.

Each list below is 4 Q times one of the components X Y Z W of Q.  That of the greatest component is
taken, so that nothing small is divided by."
  (destructuring-bind ((xx yx zx) (xy yy zy) (xz yz zz)) matrix
    (declare (double-float xx yx zx xy yy zy xz yz zz))
    (let* ((x (+ 1 xx (- yy) (- zz)))
           (y (+ 1 yy (- xx) (- zz)))
           (z (+ 1 zz (- xx) (- yy)))
           (w (+ 1 xx yy zz))
           (most (max x y z w)))
      (standard-quaternion
       (cond ((= most x) (list x (+ yx xy) (+ zx xz) (- zy yz)))
             ((= most y) (list (+ yx xy) y (+ zy yz) (- xz zx)))
             ((= most z) (list (+ zx xz) (+ zy yz) z (- yx xy)))
             (t (list (- zy yz) (- xz zx) (- yx xy) w)))))))

(defun turned-vector (matrix vector)
  "Return VECTOR, a list of three in the frame that MATRIX turns, as the outer frame has it."
  (apply #'mapcar #'+ (loop for column in matrix
                            for number in vector
                            collect (loop for part in column collect (* part number)))))
