;;;; round-frame.lisp -- coordinates in which a proof is short: what a grip exerts is round in them.
;;;;
;;;; A frame is a matrix K.  A wrench w is K w in it, a motion x is q = Kt x outside it, so power is
;;;; the same.  Two forms become diagonal together: the second moment of the wrenches that a grip
;;;; exerts becomes the unit matrix, and the square of the task's size becomes diag(a).

(in-package :supergrip-statics)

(deftype matrix () "Six rows of six numbers." '(simple-array double-float (36)))

(declaim (inline make-matrix))
(defun make-matrix () (make-doubles 36))

(defmacro entry (matrix i j) `(aref ,matrix (+ (* 6 ,i) ,j)))

(defun reaches (grip)
  "Return how far the wrenches of GRIP reach along each axis: the lesser of both ways, a little
above 0 at least."
  (declare (type grip grip))
  (let ((reaches (make-six)) (x (make-six)) (w (make-six)))
    (flet ((reach (k way)
             (fill x 0d0)
             (setf (aref x k) way)
             (grip-power grip x w)))
      (dotimes (k 6 reaches)
        (setf (aref reaches k) (max 1d-6 (min (reach k 1d0) (reach k -1d0))))))))

(defun call-with-directions (function x)
  "Call FUNCTION with X each of the twelve ways along the axes and the sixty between two of them."
  (declare (type six x) (function function))
  (flet ((try (k a l b)
           (fill x 0d0)
           (setf (aref x k) a)
           (when l (setf (aref x l) b))
           (funcall function)))
    (dotimes (k 6)
      (dolist (a '(1d0 -1d0))
        (try k a nil 0d0)))
    (dotimes (k 6)
      (loop for l from (1+ k) below 6
            do (dolist (a '(1d0 -1d0))
                 (dolist (b '(1d0 -1d0))
                   (try k a l b)))))))

(defun moment (grip scale order apart)
  "Return the mean of w wt for the greatest wrenches w of GRIP in 72 directions, the axes in ORDER
and divided by SCALE.  APART is a function of two axes: true if a mirror makes their entry 0."
  (declare (type grip grip) (type six scale) (type simple-vector order) (function apart)
           (optimize speed))
  (let ((moment (make-matrix)) (x (make-six)) (w (make-six)))
    (call-with-directions
     (lambda ()
       (let ((length (sqrt (the not-negative (row-dot x 0 x)))))
         (dotimes (k 6)
           (setf (aref x k) (/ (aref x k) (* length (aref scale k))))))
       (grip-power grip x w)
       (dotimes (i 6)
         (let* ((k (the (integer 0 5) (svref order i))) (wi (/ (aref w k) (aref scale k))))
           (dotimes (j (1+ i))
             (let ((l (the (integer 0 5) (svref order j))))
               (incf (entry moment i j) (/ (* wi (aref w l)) (* 72d0 (aref scale l)))))))))
     x)
    (dotimes (i 6 moment)
      (dotimes (j i)
        (when (funcall apart (svref order i) (svref order j))
          (setf (entry moment i j) 0d0))))))

(defun add-roundness (moment)
  "Add a small round part to MOMENT, so that it has an inverse where a grip exerts nothing."
  (declare (type matrix moment))
  (let ((part (* 1d-3 (loop for i below 6 sum (entry moment i i) of-type double-float))))
    (dotimes (i 6 moment)
      (incf (entry moment i i) part))))

(defun root-inverse (m)
  "Return the inverse of L, a lower triangle, where M, of which the lower triangle is given, is L
Lt."
  (declare (type matrix m) (optimize speed))
  (let ((l (make-matrix)) (inverse (make-matrix)))
    (dotimes (j 6)
      (loop for i from j below 6
            do (let ((sum (entry m i j)))
                 (declare (double-float sum))
                 (dotimes (k j)
                   (decf sum (* (entry l i k) (entry l j k))))
                 (setf (entry l i j)
                       (if (= i j) (sqrt (the not-negative sum)) (/ sum (entry l j j)))))))
    (dotimes (j 6 inverse)
      (setf (entry inverse j j) (/ (entry l j j)))
      (loop for i from (1+ j) below 6
            do (let ((sum 0d0))
                 (declare (double-float sum))
                 (loop for k from j below i
                       do (decf sum (* (entry l i k) (entry inverse k j))))
                 (setf (entry inverse i j) (/ sum (entry l i i))))))))

(declaim (inline turn-pair))
(defun turn-pair (m from step p q c s)
  "Turn the lines P and Q of M by the angle whose cosine and sine are C and S."
  (declare (type matrix m) (fixnum from step p q) (double-float c s))
  (dotimes (k 6)
    (let* ((ip (+ (* from k) (* step p))) (iq (+ (* from k) (* step q)))
           (a (aref m ip)) (b (aref m iq)))
      (setf (aref m ip) (- (* c a) (* s b))
            (aref m iq) (+ (* s a) (* c b))))))

(defun diagonalize (m k from to)
  "Make the part of M, symmetric, on the axes FROM below TO diagonal by turning them, and the rows
of K with them (Jacobi).  Axes that an entry 0 keeps apart stay apart."
  (declare (type matrix m k) (type (integer 0 6) from to) (optimize speed))
  (dotimes (sweep 12)
    (loop for p of-type (integer 0 6) from from below to do
      (loop for q of-type (integer 0 6) from (1+ p) below to
            do (let ((off (entry m p q)))
                 (when (> (abs off) (* 1d-17 (+ (abs (entry m p p)) (abs (entry m q q)))))
                   (let* ((ratio (/ (- (entry m q q) (entry m p p)) (* 2 off)))
                          (tangent (/ (if (>= ratio 0d0) 1d0 -1d0)
                                      (+ (abs ratio)
                                         (sqrt (the not-negative (+ 1d0 (* ratio ratio)))))))
                          (c (/ (sqrt (the not-negative (+ 1d0 (* tangent tangent))))))
                          (s (* tangent c)))
                     (turn-pair m 6 1 p q c s)
                     (turn-pair m 1 6 p q c s)
                     (turn-pair k 1 6 p q c s))))))))

(defun needed-last (need)
  "Return the axes, a vector, those that are not needed first, and how many these are.  So the size
of the task does not depend on their coordinates."
  (let ((axes '(0 1 2 3 4 5)))
    (flet ((needed-p (k) (plusp (aref need k))))
      (values (coerce (append (remove-if #'needed-p axes) (remove-if-not #'needed-p axes))
                      'simple-vector)
              (count-if-not #'needed-p axes)))))

(defun ordered-axes (scale order)
  "Return the matrix that divides each axis by SCALE and puts the axes in ORDER."
  (let ((k (make-matrix)))
    (dotimes (i 6 k)
      (setf (entry k i (svref order i)) (/ (aref scale (svref order i)))))))

(defun symmetric (m)
  "Copy the lower triangle of M to the upper one.  Return M."
  (declare (type matrix m))
  (dotimes (i 6 m)
    (dotimes (j i)
      (setf (entry m j i) (entry m i j)))))

(defun product (a b)
  "Return the matrix A B."
  (declare (type matrix a b) (optimize speed))
  (let ((c (make-matrix)))
    (dotimes (i 6 c)
      (dotimes (j 6)
        (let ((sum 0d0))
          (declare (double-float sum))
          (dotimes (k 6)
            (incf sum (* (entry a i k) (entry b k j))))
          (setf (entry c i j) sum))))))

(defun flat-axes (m count)
  "Return the set of those of the first COUNT axes in which M, the moment, has nothing."
  (declare (type matrix m))
  (let ((trace (loop for i below 6 sum (entry m i i) of-type double-float)))
    (loop for i below count
          when (<= (entry m i i) (* 1d-13 trace)) sum (ash 1 i))))

(defun task-square (k need)
  "Return the square of the size of the task NEED as a form of motions in the frame K."
  (declare (type matrix k) (type six need) (optimize speed))
  (let ((square (make-matrix)))
    (dotimes (i 6 square)
      (dotimes (j 6)
        (let ((sum 0d0))
          (declare (double-float sum))
          (dotimes (l 6)
            (let ((f (aref need l)))
              (incf sum (* (entry k i l) f f (entry k j l)))))
          (setf (entry square i j) sum))))))

(defun size-entries (square unneeded)
  "Return a, the diagonal of SQUARE, 0 on the first UNNEEDED axes."
  (declare (type matrix square))
  (let* ((greatest (loop for i below 6 maximize (entry square i i)))
         ;; What rounding does to a small entry must not make the task smaller.
         (slack (* 1d-14 greatest))
         (a (make-six)))
    (loop for i from unneeded below 6
          do (setf (aref a i) (+ (max 0d0 (entry square i i)) slack)))
    a))

(defun round-frame (grip need mirrors)
  "Return a frame K in which what GRIP exerts is round and the task NEED, six doubles not below 0,
has the size sqrt(sum a x^2); a; the set of its axes in which no wrench of GRIP does anything and
nothing is needed; and the set of its axes, one for each of MIRRORS, that this mirror alone flips."
  (declare (type grip grip) (type six need))
  (multiple-value-bind (order unneeded) (needed-last need)
    (flet ((apart-p (i j)
             (loop for mirror below 3
                     thereis (and (logbitp mirror mirrors)
                                  (not (eq (flips-p mirror i) (flips-p mirror j)))))))
      (let* ((scale (reaches grip))
             (moment (symmetric (moment grip scale order #'apart-p)))
             (k (ordered-axes scale order)))
        (diagonalize moment k 0 unneeded)
        (let* ((flat (flat-axes moment unneeded))
               (k (product (root-inverse (add-roundness moment)) k))
               (square (task-square k need)))
          (diagonalize square k unneeded 6)
          (values k (size-entries square unneeded) flat
                  (loop for i below 6
                        for axis = (svref order i)
                        when (and (< axis 3) (logbitp axis mirrors)) sum (ash 1 i))))))))

(defun into-frame (k from start to)
  "Put the wrench that FROM has from START, in the frame K, into TO from START."
  (declare (type matrix k) (type doubles from to) (fixnum start) (optimize speed))
  (dotimes (i 6)
    (let ((sum 0d0))
      (declare (double-float sum))
      (dotimes (j 6)
        (incf sum (* (entry k i j) (aref from (+ start j)))))
      (setf (aref to (+ start i)) sum))))

(defun out-of-frame (k x)
  "Return the motion that X is in the frame K, a new six."
  (declare (type matrix k) (type six x))
  (let ((motion (make-six)))
    (dotimes (j 6 motion)
      (setf (aref motion j) (loop for i below 6 sum (* (entry k i j) (aref x i)) of-type
      double-float)))))
