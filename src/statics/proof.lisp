;;;; proof.lisp -- the search for the worst motion, and the proof that there is none much worse.
;;;;
;;;; A proof is about a grip in a frame.  For a motion x, SUPPLY is what the fingers can do at most,
;;;; plus a wrench's power; DEMAND is the size of the task in x, plus another wrench's power.  UPPER
;;;; is the least SUPPLY / DEMAND that was met.  To be proved: SUPPLY >= GOAL DEMAND for all x, GOAL
;;;; a little below UPPER.
;;;;
;;;; The motions on the faces of the cube |x| = 1 are cut into boxes.  A wrench w that the fingers
;;;; can exert gives SUPPLY >= w.x for all x, and w.x - GOAL DEMAND is concave.  So if it is not
;;;; below 0 at the vertices of a box, the box is proved.  A box inherits the wrench of the one that
;;;; it was cut from, and improves it by mixing others in, so that the squares of what fails at the
;;;; vertices become least.  The first wrench that is mixed in is TOUCH: there the task would touch
;;;; the border of what the fingers can exert in the worst motion met.  Each later one is the
;;;; greatest wrench in the mean of the vertices where the box fails, weighed by how much it fails
;;;; there.  If even the greatest power in the mean is less than the mean of GOAL DEMAND, no wrench
;;;; proves the box.  Then, or when it fails slowly, the box is cut across an edge: where W and the
;;;; task differ most over it.
;;;;
;;;; With FRICTION sought, GOAL is 1, and the friction U grows instead of GOAL falling: it is kept a
;;;; little above LEAST, the greatest friction that a motion was found to need.

(in-package :supergrip-statics)

(deftype vertices () '(simple-array double-float (32)))

(defconstant +box+ 20 "How many numbers a box on the stack has: middle, halves, wrench, face.")
(defconstant +deepest+ 200 "How many boxes the stack can hold.")
(defconstant +tries+ 16 "How often the wrench of a box is improved at most.")
(defconstant +slow+ 0.7d0 "Failing by more than this share of before is failing slowly.")
(defconstant +greatest-friction+ 100d0 "No friction above this is looked for.")
(defconstant +nothing+ 1d-12 "A ratio of supply and demand that is 0 but for rounding.")

(defstruct (proof (:copier nil) (:conc-name p-))
  "See above.  COUNT to ROWS are the grip's, in the frame; A makes the size of the task, SUPPLY and
DEMAND are the two wrenches.  WORST is the motion of UPPER.  HALVES and FLAT are sets of
coordinates: those that a mirror lets be positive, those on which nothing depends.  FINDER is one
for the same grip in the same frame.  All else is scratch of one box."
  (count 0 :type finger-count) (u 0d0 :type not-negative) (v 0d0 :type not-negative)
  (coupled nil :type boolean) (rows nil :type doubles)
  (a nil :type six) (supply (make-six) :type six) (demand (make-six) :type six)
  (halves 0 :type (unsigned-byte 6)) (flat 0 :type (unsigned-byte 6))
  (gap 0d0 :type double-float) (absolute 0d0 :type double-float)
  (finder nil :type finder) (touch (make-six) :type six)
  (friction nil :type boolean) (least 0d0 :type not-negative)
  (upper 1d200 :type double-float) (goal 0d0 :type double-float)
  (worst (make-six) :type six)
  (evaluations 0 :type fixnum) (boxes 0 :type fixnum)
  (stack (make-doubles (* +box+ +deepest+)) :type doubles) (top 0 :type fixnum)
  (face 0 :type (integer 0 5)) (middle (make-six) :type six) (half (make-six) :type six)
  (wrench (make-six) :type six)
  (x (make-six) :type six) (w (make-six) :type six)
  (sizes (make-doubles 32) :type vertices) (values (make-doubles 32) :type vertices)
  (others (make-doubles 32) :type vertices)
  (mean-size 0d0 :type double-float) (failing 0d0 :type double-float))

;;; What a motion says

(declaim (inline size-of))
(defun size-of (a x)
  (declare (type six a x) (optimize speed))
  (sqrt (the not-negative
             (macrolet ((squares () `(+ ,@(loop for k below 6
                                                collect `(* (aref a ,k) (aref x ,k) (aref x ,k))))))
               (squares)))))

(defun power-and-slope (p x u)
  "Return how much power the fingers of P can do in the motion X with friction U, and how much it
grows with U."
  (declare (type proof p) (type six x) (type not-negative u))
  (let ((power 0d0) (slope 0d0) (rows (p-rows p)) (v (p-v p)))
    (declare (double-float power slope))
    (dotimes (i (p-count p) (values power slope))
      (let* ((start (* +finger+ i))
             (one (row-dot rows (+ start 6) x)) (two (row-dot rows (+ start 12) x))
             (along (row-dot rows start x)))
        (multiple-value-bind (share ones twos)
            (finger-share u v (p-coupled p) one two (row-dot rows (+ start 18) x))
          (declare (double-float share ones twos))
          (when (> (+ along share) 0d0)
            (incf power (+ along share))
            (when (> u 0d0)
              (incf slope (/ (+ (* ones one) (* twos two)) u)))))))))

(defun friction-for (p x)
  "Return the least friction, from what P has, with which the fingers meet the demand in X, or NIL."
  (declare (type proof p) (type six x))
  ;; The power is convex in U, so each step of Newton's but the first goes down to the root.
  (let* ((need (- (+ (size-of (p-a p) x) (row-dot (p-demand p) 0 x)) (row-dot (p-supply p) 0 x)))
         (u (max (p-u p) 1d-3)))
    (declare (double-float need) (type not-negative u))
    (loop repeat 60
          do (multiple-value-bind (power slope) (power-and-slope p x u)
               (declare (double-float power slope))
               (cond ((> slope 0d0)
                      (let ((next (max 0d0 (+ u (/ (- need power) slope)))))
                        (when (<= (abs (- next u)) (* 1d-12 u)) (return next))
                        (setf u next)))
                     ((>= power need) (return u))
                     (t (setf u (* 8d0 u))))
               (when (> u +greatest-friction+) (return nil)))
          finally (return u))))

(defun little-more (p u)
  "Return the friction with which P is proved if motions are known to need U."
  (declare (type proof p) (type not-negative u))
  (+ (* u (+ 1d0 (p-gap p))) (p-absolute p)))

(defun demand-friction (p x)
  "Let P have the friction that the motion X needs, and a little more; if none is enough, UPPER is
0."
  (declare (type proof p) (type six x))
  (let ((u (friction-for p x)))
    (cond ((null u) (setf (p-upper p) 0d0))
          ((> (the double-float u) (p-least p))
           (setf (p-least p) u
                 (p-u p) (little-more p u))))
    (replace (p-worst p) x)))

(defun note (p x w)
  "Put the wrench of most power in the motion X into W, and let P take note of X."
  (declare (type proof p) (type six x w) (optimize speed))
  (incf (p-evaluations p))
  (replace w (p-supply p))
  (let ((supply (+ (add-support (p-count p) (p-rows p) (p-u p) (p-v p) (p-coupled p) x w)
                   (row-dot (p-supply p) 0 x)))
        (demand (+ (size-of (p-a p) x) (row-dot (p-demand p) 0 x))))
    (when (> demand 0d0)
      (cond ((p-friction p)
             (when (< supply demand) (demand-friction p x)))
            ((< supply (* (p-upper p) demand))
             (let ((ratio (/ supply demand)))
               (setf (p-upper p) ratio
                     (p-goal p) (max 0d0 (min (* (- 1d0 (p-gap p)) ratio)
                                              (- ratio (p-absolute p)))))
               (replace (p-worst p) x)))))))

(defun worse-p (p upper least)
  "True if P has found a motion much worse than when it had UPPER and LEAST."
  (declare (type proof p) (double-float upper least))
  (or (< (p-upper p) (* 0.999d0 upper)) (> (p-least p) (* 1.001d0 least))))

(defun put-tangent (p way)
  "Put the wrench whose power is DEMAND in the worst motion of P, and not above it elsewhere, into
WAY.  Return NIL if there is no such motion."
  (declare (type proof p) (type six way))
  (let* ((worst (p-worst p)) (a (p-a p)) (size (size-of a worst)))
    (when (> size 0d0)
      (dotimes (k 6 t)
        (setf (aref way k) (+ (/ (* (aref a k) (aref worst k)) size) (aref (p-demand p) k)))))))

(defun descend (p)
  "Go from the worst motion of P to worse ones, as long as they are much worse.
DEMAND is not below its tangent at the worst motion, which is the power of one wrench.  So the
motion in which the fingers' reach along that wrench ends is a worse one, or as bad."
  (declare (type proof p))
  (let ((way (make-six)) (from (opposite (p-supply p))) (finder (p-finder p)) (x (p-x p)))
    (loop
      (let ((upper (p-upper p)) (least (p-least p)))
        (unless (put-tangent p way) (return))
        (setf (f-u finder) (p-u p))
        (farthest finder way from)
        (replace x (f-witness finder))
        (map-into (p-touch p) #'+ (f-x finder) (f-target finder) (p-supply p))
        (note p (scaled x (sqrt (the not-negative (row-dot x 0 x)))) (p-w p))
        ;; Rounding may put a grip that just holds below 0, where there is no end to worse motions.
        (unless (and (> (p-upper p) 0d0) (worse-p p upper least)) (return))))))

(defun look-around (p)
  "Descend from the worst of the axes of P and the ways between two of them."
  (declare (type proof p))
  (call-with-directions (lambda () (note p (p-x p) (p-w p))) (p-x p))
  (descend p))

;;; Boxes

(defun put-sizes (p)
  "Put the size of the task at the vertices of the box of P into SIZES."
  (declare (type proof p) (optimize speed))
  (let ((a (p-a p)) (middle (p-middle p)) (half (p-half p)) (face (p-face p)) (out (p-sizes p))
        (count 1))
    (declare (type (integer 0 32) count))
    (setf (aref out 0) (* (aref a face) (aref middle face) (aref middle face)))
    (dotimes (k 6)
      (unless (= k face)
        (let* ((low (- (aref middle k) (aref half k))) (high (+ (aref middle k) (aref half k)))
               (low (* (aref a k) low low)) (high (* (aref a k) high high)))
          (dotimes (i count)
            (setf (aref out (+ count i)) (+ (aref out i) high))
            (incf (aref out i) low))
          (setf count (* 2 count)))))
    (dotimes (i 32)
      (setf (aref out i) (sqrt (the not-negative (aref out i)))))))

(defun put-values (p w out)
  "Put what the wrench W has above the goal at the vertices of the box of P into OUT."
  (declare (type proof p) (type six w) (type vertices out) (optimize speed))
  (let* ((middle (p-middle p)) (half (p-half p)) (face (p-face p)) (sizes (p-sizes p))
         (goal (p-goal p)) (demand (p-demand p)) (count 1))
    (declare (type (integer 0 32) count))
    (flet ((force (k) (- (aref w k) (* goal (aref demand k)))))
      (declare (inline force))
      (setf (aref out 0) (* (force face) (aref middle face)))
      (dotimes (k 6)
        (unless (= k face)
          (let* ((force (force k))
                 (low (* force (- (aref middle k) (aref half k))))
                 (high (* force (+ (aref middle k) (aref half k)))))
            (dotimes (i count)
              (setf (aref out (+ count i)) (+ (aref out i) high))
              (incf (aref out i) low))
            (setf count (* 2 count))))))
    (dotimes (i 32)
      (decf (aref out i) (* goal (aref sizes i))))))

(defun put-mean (p)
  "Put the mean of the vertices where the wrench of the box of P fails into X, weighed by how much
it fails, and the mean size of the task there into MEAN-SIZE.  Return NIL if it fails nowhere."
  (declare (type proof p) (optimize speed))
  (let ((values (p-values p)) (sums (p-others p)) (sizes (p-sizes p)) (middle (p-middle p))
        (half (p-half p)) (face (p-face p)) (x (p-x p))
        (sum 0d0) (size 0d0) (squares 0d0) (count 32))
    (declare (double-float sum size squares) (type (integer 0 32) count))
    (dotimes (i 32)
      (let* ((value (aref values i))
             (failing (* 0.5d0 (- (abs value) value))))
        (setf (aref sums i) failing)
        (incf sum failing)
        (incf squares (* failing failing))
        (incf size (* failing (aref sizes i)))))
    (setf (p-failing p) squares)
    (unless (> sum 0d0)
      (return-from put-mean nil))
    (setf (p-mean-size p) (/ size sum))
    (loop for k of-type fixnum from 5 downto 0
          do (if (= k face)
                 (setf (aref x k) (aref middle k))
                 (let ((more 0d0))
                   (declare (double-float more))
                   (setf count (ash count -1))
                   (dotimes (i count)
                     (incf more (- (aref sums (+ count i)) (aref sums i)))
                     (incf (aref sums i) (aref sums (+ count i))))
                   (setf (aref x k) (+ (aref middle k) (/ (* (aref half k) more) sum))))))
    t))

(declaim (inline best-share))
(defun best-share (values others slack)
  "Return the share T of OTHERS in a mixture with VALUES for which the squares of what is below
SLACK are least: at most six steps of Newton's.  What is below is found without a jump."
  (declare (type vertices values others) (double-float slack) (optimize speed))
  (let ((share 0d0))
    (declare (double-float share))
    (dotimes (i 6 share)
      (let ((rise 0d0) (bend 0d0))
        (declare (double-float rise bend))
        (dotimes (j 32)
          (let* ((slope (- (aref others j) (aref values j)))
                 (below (- slack (+ (aref values j) (* share slope))))
                 (size (abs below))
                 (part (* 0.5d0 (+ size below)))          ; BELOW or 0
                 (counts (/ part (+ size 1d-290))))       ; 1 or 0
            (incf rise (* part slope))
            (incf bend (* counts slope slope))))
        (unless (> bend 0d0) (return share))
        (let ((next (max 0d0 (min 1d0 (+ share (/ rise bend))))))
          (when (<= (abs (- next share)) 1d-6) (return next))
          (setf share next))))))

(defun mix (p)
  "Mix the wrench W into the one of the box of P, as is best."
  (declare (type proof p) (optimize speed))
  (let* ((values (p-values p)) (others (p-others p)) (wrench (p-wrench p)) (w (p-w p))
         ;; A trifle more than needed, so that rounding does no harm.
         (share (best-share values others (* 1d-9 (p-goal p) (aref (p-sizes p) 0)))))
    (dotimes (i 32)
      (incf (aref values i) (* share (- (aref others i) (aref values i)))))
    (dotimes (k 6)
      (incf (aref wrench k) (* share (- (aref w k) (aref wrench k)))))))

(defun hopeless-p (p)
  "True if no wrench proves the box of P: not even the one that is greatest in the motion X, W."
  (declare (type proof p) (optimize speed))
  (let ((x (p-x p)))
    (< (row-dot (p-w p) 0 x)
       (* (p-goal p) (+ (p-mean-size p) (row-dot (p-demand p) 0 x))))))

(defun proved-p (p)
  "True if the box of P is proved."
  (declare (type proof p) (optimize speed))
  (let ((values (p-values p)) (before most-positive-double-float))
    (declare (double-float before))
    (put-sizes p)
    (put-values p (p-wrench p) values)
    (when (put-mean p)
      (replace (p-w p) (p-touch p))
      (put-values p (p-w p) (p-others p))
      (mix p))
    (dotimes (i +tries+ nil)
      (unless (put-mean p) (return t))
      (let ((failing (p-failing p)))
        (when (> failing (* +slow+ before)) (return nil))
        (setf before failing))
      (note p (p-x p) (p-w p))
      (when (hopeless-p p) (return nil))
      (put-values p (p-w p) (p-others p))
      (mix p))))

;;; All boxes

(defun push-box (p)
  (declare (type proof p) (optimize speed))
  (let ((top (p-top p)) (stack (p-stack p)))
    (declare (type (integer 0 100000) top))
    (replace stack (p-middle p) :start1 top)
    (replace stack (p-half p) :start1 (+ top 6))
    (replace stack (p-wrench p) :start1 (+ top 12))
    (setf (aref stack (+ top 18)) (coerce (p-face p) 'double-float)
          (p-top p) (+ top +box+))))

(defun pop-box (p)
  (declare (type proof p) (optimize speed))
  (let ((top (- (p-top p) +box+)) (stack (p-stack p)))
    (declare (type (integer 0 100000) top))
    (replace (p-middle p) stack :start2 top)
    (replace (p-half p) stack :start2 (+ top 6))
    (replace (p-wrench p) stack :start2 (+ top 12))
    (setf (p-face p) (the (integer 0 5)
                          (truncate (the (double-float 0d0 5d0) (aref stack (+ top 18)))))
          (p-top p) top)))

(defun edge-to-cut (p)
  "Return the axis across which to cut the box of P: of its edges, the one over which W, the wrench
of most power in the motion X, and GOAL times the task there, its tangent, differ most.  To an edge
without a difference half a wrench of length 1 is given."
  (declare (type proof p) (optimize speed))
  (let* ((half (p-half p)) (x (p-x p)) (w (p-w p)) (a (p-a p)) (demand (p-demand p))
         (goal (p-goal p)) (size (max 1d-200 (size-of a x)))
         (most -1d0) (edge 0))
    (declare (double-float most) (type (integer 0 5) edge))
    (dotimes (k 6 edge)
      (let* ((task (* goal (+ (/ (* (aref a k) (aref x k)) size) (aref demand k))))
             (difference (* (aref half k) (+ 0.5d0 (abs (- (aref w k) task))))))
        (when (> difference most)
          (setf most difference edge k))))))

(defun cut (p)
  "Put the two halves of the box of P on the stack."
  (declare (type proof p) (optimize speed))
  (let* ((middle (p-middle p)) (half (p-half p)) (edge (edge-to-cut p))
         (quarter (* 0.5d0 (aref half edge))) (centre (aref middle edge)))
    (setf (aref half edge) quarter
          (aref middle edge) (+ centre quarter))
    (push-box p)
    (setf (aref middle edge) (- centre quarter))
    (push-box p)))

(defun put-face (p face side)
  "Make the box of P the FACE of the cube on SIDE, 1 or -1, or the part of it that mirrors leave."
  (declare (type proof p))
  (let ((middle (p-middle p)) (half (p-half p)))
    (dotimes (k 6)
      (multiple-value-bind (centre length)
          (cond ((= k face) (values side 0d0))
                ((logbitp k (p-flat p)) (values 0d0 0d0))
                ((logbitp k (p-halves p)) (values 0.5d0 0.5d0))
                (t (values 0d0 1d0)))
        (setf (aref middle k) centre (aref half k) length)))
    (setf (p-face p) face)))

(defun push-faces (p)
  "Put the faces of the cube on the stack of P, those only that no mirror gives."
  (declare (type proof p))
  (dotimes (face 6)
    (unless (logbitp face (p-flat p))
      (dolist (side (if (logbitp face (p-halves p)) '(1d0) '(-1d0 1d0)))
        (put-face p face side)
        (note p (p-middle p) (p-wrench p))
        (push-box p)))))

(defun prove (p budget)
  "Prove all boxes of P, at most BUDGET of them.  True if that was done, or nothing is to be proved
any more: UPPER or GOAL is nothing."
  (declare (type proof p) (type (and fixnum (integer 0)) budget) (optimize speed))
  (setf (p-top p) 0)
  (when (plusp budget)
    (push-faces p))
  (loop until (or (<= (p-upper p) +nothing+) (<= (p-goal p) 0d0))
        do (cond ((>= (p-boxes p) budget) (return nil))
                 ((zerop (p-top p)) (return t))
                 ((>= (p-top p) (* +box+ (- +deepest+ 2))) (return nil)))
           (incf (p-boxes p))
           (pop-box p)
           (let ((upper (p-upper p)) (least (p-least p)))
             (unless (proved-p p)
               (cut p))
             (when (worse-p p upper least)
               (descend p)))
        finally (return t)))
