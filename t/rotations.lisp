;;;; rotations.lisp -- quaternions and matrices, compared with each other and their definitions.

(in-package :supergrip-test)
(define-suite rotations "Rotations of space.")

(defun random-quaternion (state)
  "Return a random unit quaternion; in a third of the cases one or two components are 0."
  (loop for numbers = (loop repeat 4 collect (if (chance 20 state) 0d0 (- (random 2d0 state) 1d0)))
        for length = (sqrt (reduce #'+ (mapcar #'* numbers numbers)))
        when (< 0.1d0 length 1d0)
          return (mapcar (lambda (number) (/ number length)) numbers)))

(defun axis-quaternion (axis angle)
  "Return the quaternion of the turn by ANGLE about AXIS, a unit vector: by definition."
  (append (mapcar (lambda (part) (* part (sin (/ angle 2)))) axis) (list (cos (/ angle 2)))))

(defun turned-about (axis angle vector)
  "Return VECTOR turned by ANGLE about AXIS, a unit vector, as Rodrigues has it."
  (mapcar (lambda (v c a)
            (+ (* (cos angle) v) (* (sin angle) c)
               (* (- 1 (cos angle)) a (reduce #'+ (mapcar #'* axis vector)))))
          vector (supergrip::cross-product axis vector) axis))

(defun turned-back (matrix vector)
  "Return VECTOR, in the outer frame, as the frame that MATRIX turns has it."
  (loop for column in matrix collect (supergrip::dot-product column vector)))

(test a-quaternion-turns-as-its-axis-and-angle-say
  (let ((state (sb-ext:seed-random-state 1)))
    (loop repeat 300
          do (let* ((axis (supergrip::unit-length
                           (loop repeat 3 collect (- (random 2d0 state) 1d0))))
                    (angle (- (random 12d0 state) 6d0))
                    (vector (loop repeat 3 collect (- (random 20d0 state) 10d0)))
                    (matrix (supergrip::quaternion-matrix (axis-quaternion axis angle)))
                    (turned (supergrip::turned-vector matrix vector)))
               (is (close-to (turned-about axis angle vector) turned 1d-14))
               (is (close-to vector (turned-back matrix turned) 1d-14))))))

(test quaternion-and-matrix-say-the-same
  (let ((state (sb-ext:seed-random-state 2)))
    (loop repeat 1000
          do (let* ((q (random-quaternion state))
                    (matrix (supergrip::quaternion-matrix q))
                    (back (supergrip::matrix-quaternion matrix)))
               (destructuring-bind (x y z) matrix
                 (is (close-to z (supergrip::cross-product x y) 1d-14) "right-handed"))
               (is (plusp (find-if-not #'zerop (cons (fourth back) back))))
               (is (or (close-to q back 1d-14) (close-to (mapcar #'- q) back 1d-14)))
               (is (close-to matrix (supergrip::quaternion-matrix back) 1d-14))))))

(test half-turns-have-one-quaternion
  (is (equal '(0d0 0d0 0d0 1d0)
             (supergrip::matrix-quaternion '((1d0 0d0 0d0) (0d0 1d0 0d0) (0d0 0d0 1d0)))))
  (is (equal '(1d0 0d0 0d0 0d0)
             (supergrip::matrix-quaternion '((1d0 0d0 0d0) (0d0 -1d0 -0d0) (0d0 0d0 -1d0)))))
  (is (equal '(0d0 0d0 1d0 0d0)
             (supergrip::matrix-quaternion '((-1d0 0d0 0d0) (0d0 -1d0 0d0) (0d0 0d0 1d0)))))
  (let ((state (sb-ext:seed-random-state 3)))
    (loop repeat 200
          do (let* ((axis (loop for part in (random-quaternion state) repeat 3 collect part))
                    (q (supergrip::standard-quaternion
                        (append (supergrip::unit-length (mapcar #'+ axis '(1d-9 0d0 0d0)))
                                '(1d-17)))))
               (is (plusp (find-if-not #'zerop q)))
               (is (zerop (fourth q)))
               (is (close-to q (supergrip::standard-quaternion (mapcar #'- q)) 1d-15))
               (is (close-to q (supergrip::matrix-quaternion (supergrip::quaternion-matrix q))
                             1d-14))))))

(test the-product-turns-by-both
  (let ((state (sb-ext:seed-random-state 4)))
    (loop repeat 200
          do (let* ((a (random-quaternion state)) (b (random-quaternion state))
                    (a-matrix (supergrip::quaternion-matrix a))
                    (product (supergrip::quaternion-product a b)))
               (is (close-to (loop for column in (supergrip::quaternion-matrix b)
                                   collect (supergrip::turned-vector a-matrix column))
                             (supergrip::quaternion-matrix product)
                             1d-14))
               (is (close-to b (supergrip::quaternion-product (quaternion-inverse a) product)
                             1d-14))))))

(test lengths-of-any-size
  (is (= 5d0 (supergrip::vector-length '(3d0 0d0 -4d0))))
  (is (= 0d0 (supergrip::vector-length '(0d0 0d0))))
  (is (null (supergrip::unit-length '(0d0 0d0 0d0))))
  (is (equal '(0.6d0 -0.8d0) (supergrip::unit-length '(3d200 -4d200))))
  (is (close-to '(0.6d0 -0.8d0) (supergrip::unit-length '(3d-310 -4d-310)) 1d-12))
  (is (supergrip::unit-quaternion-p '(0d0 0d0 0d0 1.0000009d0)))
  (is (not (supergrip::unit-quaternion-p '(0d0 0d0 0d0 1.0000011d0))))
  (is (not (supergrip::unit-quaternion-p '(0d0 0d0 0d0 0d0)))))
