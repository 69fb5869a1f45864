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

(defun vector-length (vector)
  "Return the length of VECTOR, a list of doubles.  No number is too large or too small for it."
  (let ((most (reduce #'max vector :key #'abs)))
    (if (zerop most)
        0d0
        (* most (sqrt (loop for number in vector sum (expt (/ number most) 2)))))))

(defun unit-length (vector)
  "Return VECTOR, a list of doubles, made of length 1; NIL if all of it is 0."
  (let ((most (reduce #'max vector :key #'abs)))
    (unless (zerop most)
      ;; Twice, so that no length is out of range.
      (let* ((vector (mapcar (lambda (number) (/ number most)) vector))
             (length (vector-length vector)))
        (mapcar (lambda (number) (/ number length)) vector)))))

(defun unit-quaternion-p (quaternion)
  "True if the length of QUATERNION is 1 within 1e-6."
  (<= (abs (- (vector-length quaternion) 1d0)) +unit+))

(defun standard-quaternion (quaternion)
  "Return the unit quaternion of the rotation of QUATERNION, any but 0, with W not below 0; if W is
0, the first of X Y Z that is not 0 is above it.  What is below 1e-15 becomes 0: it is rounding, and
would decide about the signs."
  (destructuring-bind (x y z w) (loop for number in (unit-length quaternion)
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

(defun quaternion-inverse (quaternion)
  "Return the quaternion of the opposite rotation of QUATERNION, a unit quaternion."
  (destructuring-bind (x y z w) quaternion
    (list (- 0d0 x) (- 0d0 y) (- 0d0 z) w)))

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

Each row below is 4 Q times one of the components X Y Z W of Q.  The row of the greatest component
is taken, so that nothing small is divided by."
  (destructuring-bind ((xx yx zx) (xy yy zy) (xz yz zz)) matrix
    (let ((rows (list (list (+ 1 xx (- yy) (- zz)) (+ yx xy) (+ zx xz) (- zy yz))
                      (list (+ yx xy) (+ 1 yy (- xx) (- zz)) (+ zy yz) (- xz zx))
                      (list (+ zx xz) (+ zy yz) (+ 1 zz (- xx) (- yy)) (- yx xy))
                      (list (- zy yz) (- xz zx) (- yx xy) (+ 1 xx yy zz)))))
      (standard-quaternion
       (loop with best = (first rows) and most = (first (first rows))
             for row in (rest rows)
             for place from 1
             when (> (nth place row) most) do (setf best row most (nth place row))
             finally (return best))))))

(defun turned-vector (matrix vector)
  "Return VECTOR, a list of three in the frame that MATRIX turns, as the outer frame has it."
  (apply #'mapcar #'+ (loop for column in matrix
                            for number in vector
                            collect (loop for part in column collect (* part number)))))

(defun turned-back (matrix vector)
  "Return VECTOR, a list of three in the outer frame, as the frame that MATRIX turns has it."
  (loop for column in matrix collect (dot-product column vector)))
