;;;; pure-wrench.lisp -- how far a closed grip reaches along one wrench, to ten places.
;;;;
;;;; The greatest multiple of a wrench d is the least of h(q), the fingers' power, over the motions
;;;; q with q.d = 1.  h has edges; so logarithms with the weight MU keep each finger from its
;;;; limits, and Newton's method finds the least for ever smaller MU (a barrier method).  There the
;;;; fingers' forces make a multiple of d and nothing else: that is a lower bound, and h(q) is an
;;;; upper one.  They differ by 15 MU for three fingers.

(in-package :supergrip-statics)

(defconstant +least-mu+ 1d-11 "How small MU becomes, in units of a finger's greatest force.")
(defconstant +most-steps+ 300 "How many steps of Newton's are tried, at most, for one wrench.")

(defstruct (barrier (:copier nil) (:conc-name b-))
  "The search with GRIP: the motion Q, of which component K stays as it is, and the wrench W that
the fingers make.  Its derivative by Q is Bt B, and it is Bt c: B and then c are COLUMNS of ROWS
numbers, that of component K the last of B's.  TRIANGLE is what makes them of orthogonal columns,
STEP what to go."
  (grip nil :type grip) (mu 1d0 :type double-float) (k 0 :type (integer 0 5))
  (q (make-six) :type six) (w (make-six) :type six) (step (make-six) :type six)
  (rows 0 :type fixnum) (columns nil :type doubles) (triangle (make-doubles 49) :type doubles))

(defconstant +most-pressed+ (- 1d0 (scale-float 1d0 -53)) "The greatest number below 1.")

(declaim (inline root))
(defun root (number)
  "Return the square root of NUMBER, 0 or more; a great number if it is no number."
  (declare (double-float number))
  (if (>= number 0d0) (sqrt (the not-negative number)) 1d300))

(declaim (inline pressing))
(defun pressing (y slip twist mu)
  "Return how much a finger presses, above 0 and below 1, where it would move by Y along its normal,
and its friction does SLIP and TWIST at most: the root n of y + (3 mu + R(slip n) + R(twist n))/n -
mu/(1-n), R(x) being the root of mu^2 + x^2."
  (declare (double-float y) (type not-negative slip twist mu) (optimize speed))
  (let* ((c (+ y slip twist)) (b (- c (* 6d0 mu)))
         (root (sqrt (the not-negative (+ (* b b) (* 20d0 mu (abs c))))))
         ;; The root if R(x) were mu + x.
         (n (cond ((< (abs c) 1d-300) (/ 5d0 6d0))
                  ((minusp c)
                   (/ (* 10d0 mu) (+ (- b) (sqrt (the not-negative
                                                      (max 0d0 (+ (* b b) (* 20d0 mu c))))))))
                  ((plusp b) (/ (+ b root) (* 2d0 c)))
                  (t (/ (* 10d0 mu) (- root b)))))
         (low 0d0) (high 1d0))
    (declare (double-float n low high))
    (unless (< 0d0 n 1d0) (setf n 0.5d0))
    (dotimes (i 60 n)
      (let* ((ru (sqrt (the not-negative (+ (* mu mu) (* slip slip n n)))))
             (rv (sqrt (the not-negative (+ (* mu mu) (* twist twist n n)))))
             (rest (- 1d0 n))
             (value (- (* rest (+ (* n y) (* 3d0 mu) ru rv)) (* mu n)))
             (slope (+ (- (+ (* n y) (* 3d0 mu) ru rv))
                       (* rest (+ y (/ (* slip slip n) ru) (/ (* twist twist n) rv)))
                       (- mu))))
        (if (plusp value) (setf low n) (setf high n))
        (let ((next (if (zerop slope) low (- n (/ value slope)))))
          (unless (< low next high)
            (setf next (* 0.5d0 (+ low high))))
          (when (<= (abs (- next n)) (* 1d-15 (min next (+ 1d-4 (- 1d0 next)))))
            (return next))
          (setf n next))))))

(declaim (inline friction-part))
(defun friction-part (most velocity n mu)
  "Return the friction force where it is MOST N at most and VELOCITY is that of the tip, how much it
changes with N, how much with VELOCITY, and with a velocity across it."
  (declare (type not-negative most n mu) (double-float velocity))
  (let* ((limit (* most n))
         (root (+ mu (sqrt (the not-negative (+ (* mu mu) (* velocity velocity limit limit))))))
         (across (/ (* limit limit) root)) ; half of what is left of LIMIT^2, over MU
         (force (* across velocity))
         (square (+ (* limit limit) (* force force))))
    (if (zerop square)
        (values 0d0 0d0 0d0 0d0)
        (values force
                (/ (* 2d0 most limit force) square)
                (/ (* 2d0 mu across across) square)
                across))))

(declaim (inline curvature))
(defun curvature (most n force)
  "Return what friction adds to how fast the barrier rises with N."
  (declare (double-float most n force))
  (if (zerop most)
      (/ 2d0 (* n n))
      (/ (* 2d0 most most) (+ (* most most n n) (* force force)))))

(declaim (inline column-of))
(defun column-of (component k)
  "Return the column of COMPONENT, 0 to 5, where that of K is the last."
  (declare (type (integer 0 5) component k))
  (cond ((< component k) component) ((= component k) 5) (t (1- component))))

(declaim (inline put-row))
(defun put-row (b row factor start normal first second third rest)
  "Let ROW of B be FACTOR times the sum of the rows of the grip from START with the factors NORMAL
to THIRD, and c there be REST."
  (declare (type barrier b) (fixnum row start) (double-float factor normal first second third rest)
           (optimize speed))
  (let ((columns (b-columns b)) (count (b-rows b)) (rows (grip-rows (b-grip b))))
    (dotimes (k 6)
      (setf (aref columns (+ row (the fixnum (* (column-of k (b-k b)) count))))
            (* factor (+ (* normal (aref rows (+ start k)))
                         (* first (aref rows (+ start 6 k)))
                         (* second (aref rows (+ start 12 k)))
                         (* third (aref rows (+ start 18 k)))))))
    (setf (aref columns (+ row (the fixnum (* 6 count)))) rest)))

(declaim (inline quotient))
(defun quotient (a b)
  (declare (double-float a b))
  (if (zerop b) 0d0 (/ a b)))

(defun add-finger (b index)
  "Put what finger INDEX does in the motion of B into its rows, and add it to W."
  (declare (type barrier b) (type finger-count index) (optimize speed))
  (let* ((grip (b-grip b)) (rows (grip-rows grip)) (mu (b-mu b)) (q (b-q b)) (w (b-w b))
         (start (* +finger+ index)) (row (* 4 index))
         (u (grip-friction grip)) (v (grip-soft-friction grip))
         (one (row-dot rows (+ start 6) q)) (two (row-dot rows (+ start 12) q))
         (turn (row-dot rows (+ start 18) q))
         (slide (sqrt (the not-negative (+ (* one one) (* two two)))))
         ;; By rounding, a finger may press as much as it can, or not at all.
         (n (max 1d-100 (min +most-pressed+
                             (pressing (row-dot rows start q) (* u slide) (* v (abs turn))
                                       (the not-negative mu)))))
         (c (if (plusp slide) (/ one slide) 1d0)) (s (if (plusp slide) (/ two slide) 0d0)))
    (declare (double-float mu c s) (type not-negative n))
    (multiple-value-bind (force by-n by-slide by-across) (friction-part u slide n mu)
      (multiple-value-bind (torque torque-by-n by-turn) (friction-part v turn n mu)
        (declare (double-float force by-n by-slide by-across torque torque-by-n by-turn))
        (let ((stiff (/ (sqrt (the not-negative
                                   (* mu (+ (/ (* n n)) (/ (* (- 1d0 n) (- 1d0 n)))
                                            (curvature u n force) (curvature v n torque)))))))
              (slides (sqrt (the not-negative by-slide)))
              (turns (sqrt (the not-negative by-turn))))
          (put-row b row stiff start 1d0 (* by-n c) (* by-n s) torque-by-n (/ n stiff))
          (put-row b (+ row 1) slides start 0d0 c s 0d0 (quotient (- force (* n by-n)) slides))
          (put-row b (+ row 2) (sqrt (the not-negative by-across)) start 0d0 (- s) c 0d0 0d0)
          (put-row b (+ row 3) turns start 0d0 0d0 0d0 1d0
                   (quotient (- torque (* n torque-by-n)) turns))
          (dotimes (k 6)
            (incf (aref w k) (+ (* n (aref rows (+ start k)))
                                (* force (+ (* c (aref rows (+ start 6 k)))
                                            (* s (aref rows (+ start 12 k)))))
                                (* torque (aref rows (+ start 18 k)))))))))))

(defun make-orthogonal (b)
  "Make the first five columns of B orthogonal and of length 1, each of what those before it leave
of it.  TRIANGLE says how they were made, and what of the others they take."
  (declare (type barrier b) (optimize speed))
  (let ((columns (b-columns b)) (count (b-rows b)) (triangle (b-triangle b)))
    (dotimes (j 5)
      (let* ((start (the fixnum (* j count))) (square 0d0))
        (declare (double-float square))
        (dotimes (i count)
          (let ((part (aref columns (+ start i))))
            (incf square (* part part))))
        (let ((length (root square)))
          (setf (aref triangle (* 8 j)) length)
          (when (> length 0d0)
            (dotimes (i count)
              (setf (aref columns (+ start i)) (/ (aref columns (+ start i)) length)))
            (loop for l of-type fixnum from (1+ j) to 6
                  do (let ((other (the fixnum (* l count))) (sum 0d0))
                       (declare (double-float sum))
                       (dotimes (i count)
                         (incf sum (* (aref columns (+ start i)) (aref columns (+ other i)))))
                       (setf (aref triangle (+ (* 7 j) l)) sum)
                       (dotimes (i count)
                         (decf (aref columns (+ other i))
                               (* sum (aref columns (+ start i)))))))))))))

(defun solve-step (b)
  "Put Newton's step, which leaves component K alone, into STEP; return the square of how far that
is, in MU, and by how much component K of W grows, if the others become 0."
  (declare (type barrier b) (optimize speed))
  (make-orthogonal b)
  (let ((triangle (b-triangle b)) (step (b-step b)) (square 0d0) (growth 0d0))
    (declare (double-float square growth))
    (setf (aref step 5) 0d0)
    (loop for j of-type (integer -1 5) from 4 downto 0
          do (let ((length (aref triangle (* 8 j))) (sum (aref triangle (+ (* 7 j) 6))))
               (cond ((> length 0d0)
                      (incf square (* sum sum))
                      (decf growth (* sum (aref triangle (+ (* 7 j) 5))))
                      (loop for l of-type (integer 0 6) from (1+ j) below 5
                            do (incf sum (* (aref triangle (+ (* 7 j) l)) (aref step l))))
                      (setf (aref step j) (- (/ sum length))))
                     (t (setf (aref step j) 0d0)))))
    (values (/ square (b-mu b)) growth)))

(defun newton-step (b)
  "Go one step of Newton's with B, shorter where it is long.  Return how far it was, in MU, and what
component K of W is if the whole step is taken: forces in reach make that and nothing else, if it is
shorter than 1."
  (declare (type barrier b) (optimize speed))
  (fill (b-w b) 0d0)
  (dotimes (i (grip-count (b-grip b)))
    (add-finger b i))
  (multiple-value-bind (square growth) (solve-step b)
    (let* ((length (root square))
           (part (if (> length 0.25d0) (/ (+ 1d0 length)) 1d0)))
      (dotimes (k 6)
        (incf (aref (b-q b) k) (* part (aref (b-step b) (column-of k (b-k b))))))
      (values length (+ (aref (b-w b) (b-k b)) (the double-float growth))))))

(defun pure-wrench (grip k sign)
  "Return how far GRIP, a closed one, reaches along axis K, 0 to 5, in the direction of SIGN: what
it surely exerts, and what it surely can't exceed; NIL if that was not found."
  (declare (type grip grip) (type (integer 0 5) k) (double-float sign))
  (let* ((rows (* 4 (grip-count grip)))
         (b (make-barrier :grip grip :k k :rows rows :columns (make-doubles (* 7 rows)))))
    (setf (aref (b-q b) k) sign)
    (loop repeat +most-steps+
          do (multiple-value-bind (length most) (newton-step b)
               (declare (double-float length most))
               (cond ((not (< length 1d10)) (return nil))
                     ((>= length 0.9d0))
                     ((> (b-mu b) +least-mu+)
                      (setf (b-mu b) (max +least-mu+ (* 0.03d0 (b-mu b)))))
                     (t (let ((power (grip-power grip (b-q b) (make-six))))
                          (return (values (min power (* sign most)) power)))))))))
