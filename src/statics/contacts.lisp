;;;; contacts.lisp -- fingers on a thing, and the support function of what they can exert.
;;;;
;;;; Wrenches and motions are six numbers about one point, the centre: forces then torques,
;;;; velocities then rotations.  The power of a wrench w in a motion x is w.x; the support function
;;;; of a set of wrenches says for each motion how much power they can do at most.

(in-package :supergrip-statics)

(deftype six () "Three numbers along X Y Z, three about X Y Z." '(simple-array double-float (6)))
(deftype doubles () '(simple-array double-float (*)))
(deftype finger-count () '(integer 0 1000))
(deftype not-negative () '(double-float 0d0))

(declaim (inline make-doubles make-six))
(defun make-doubles (count) (make-array count :element-type 'double-float :initial-element 0d0))
(defun make-six () (make-doubles 6))

(defconstant +row+ 6 "How many numbers a wrench has.")
(defconstant +finger+ 24 "How many numbers the four wrenches of a finger have.")

(defstruct (grip (:constructor %make-grip
                    (count friction soft-friction coupled rows places))
                 (:copier nil))
  "COUNT soft fingers on a thing.  Each presses with a normal force of 0 to 1; its friction force
is at most FRICTION times, its torque about the normal at most SOFT-FRICTION (a length) times the
normal force; if COUPLED, the squares of both shares add up to 1 at most.  ROWS has four wrenches
of each finger: its unit normal force, two unit forces across it, and a unit torque about the
normal; PLACES its place and its normal."
  (count 0 :type finger-count :read-only t)
  (friction 0d0 :type not-negative :read-only t)
  (soft-friction 0d0 :type not-negative :read-only t)
  (coupled nil :type boolean :read-only t)
  (rows nil :type doubles :read-only t)
  (places nil :type doubles :read-only t))

(defun make-grip (count friction soft-friction &optional coupled)
  "Return a grip of COUNT fingers, to be placed by SET-FINGER.  FRICTION u and SOFT-FRICTION v (cm)
are doubles not below 0."
  (%make-grip count friction soft-friction (and coupled t) (make-doubles (* +finger+ count))
              (make-doubles (* 6 count))))

(defun computable-p (grip gravity)
  "True if what GRIP does against GRAVITY, a six, can be computed: no number is so large that its
products have no value."
  (declare (type grip grip) (type six gravity))
  (flet ((small-p (number) (< (abs number) 1d75)))
    (and (small-p (grip-friction grip)) (small-p (grip-soft-friction grip))
         (every #'small-p (grip-rows grip)) (every #'small-p gravity))))

(defun same-contacts-p (a b)
  "True if the grips A and B have the same contacts, in whatever order."
  (declare (type grip a b))
  (labels ((same-p (i grip j)
             (loop for k below 6
                   always (= (aref (grip-places a) (+ (* 6 i) k))
                             (aref (grip-places grip) (+ (* 6 j) k)))))
           (times (i grip)
             (loop for j below (grip-count grip) count (same-p i grip j))))
    (and (= (grip-count a) (grip-count b))
         ;; Two fingers may be in one place.
         (loop for i below (grip-count a) always (= (times i a) (times i b))))))

(declaim (inline put-force))
(defun put-force (rows start px py pz fx fy fz)
  "Put the wrench of the force F at the place P into ROWS from START."
  (declare (type doubles rows) (fixnum start) (double-float px py pz fx fy fz))
  (setf (aref rows start) fx (aref rows (+ start 1)) fy (aref rows (+ start 2)) fz
        (aref rows (+ start 3)) (- (* py fz) (* pz fy))
        (aref rows (+ start 4)) (- (* pz fx) (* px fz))
        (aref rows (+ start 5)) (- (* px fy) (* py fx))))

(declaim (inline across))
(defun across (nx ny nz)
  "Return a unit vector across the unit vector N."
  (declare (double-float nx ny nz))
  (multiple-value-bind (x y z)
      (cond ((and (<= (abs nx) (abs ny)) (<= (abs nx) (abs nz))) (values 0d0 nz (- ny)))
            ((<= (abs ny) (abs nz)) (values (- nz) 0d0 nx))
            (t (values ny (- nx) 0d0)))
    (declare (double-float x y z))
    (let ((length (sqrt (the not-negative (+ (* x x) (* y y) (* z z))))))
      (values (/ x length) (/ y length) (/ z length)))))

(defun set-finger (grip index px py pz nx ny nz)
  "Put finger INDEX of GRIP at the place P from the centre, in cm, with the inward unit normal N:
six doubles.  Return GRIP."
  (declare (type grip grip) (type finger-count index) (double-float px py pz nx ny nz))
  (let ((rows (grip-rows grip)) (places (grip-places grip)) (start (* +finger+ index)))
    (loop for number in (list px py pz nx ny nz) for place from (* 6 index)
          do (setf (aref places place) number))
    (multiple-value-bind (ax ay az) (across nx ny nz)
      (put-force rows start px py pz nx ny nz)
      (put-force rows (+ start 6) px py pz ax ay az)
      (put-force rows (+ start 12) px py pz
                 (- (* ny az) (* nz ay)) (- (* nz ax) (* nx az)) (- (* nx ay) (* ny ax)))
      (fill rows 0d0 :start (+ start 18) :end (+ start 21))
      (replace rows places :start1 (+ start 21) :start2 (+ (* 6 index) 3) :end2 (* 6 (1+ index)))))
  grip)

;;; The support function

(defmacro row-dot (rows start x)
  "The product of the six numbers of ROWS from START, and X."
  `(+ ,@(loop for k below 6 collect `(* (aref ,rows (+ ,start ,k)) (aref ,x ,k)))))

(defmacro add-row (factor rows start sum)
  "Add FACTOR times the six numbers of ROWS from START to SUM."
  (let ((f (gensym "FACTOR")))
    `(let ((,f ,factor))
       (declare (double-float ,f))
       ,@(loop for k below 6
               collect `(incf (aref ,sum ,k) (* ,f (aref ,rows (+ ,start ,k))))))))

(declaim (inline finger-share))
(defun finger-share (u v coupled one two turn)
  "Return the greatest power of a finger that presses with force 1, its normal force left out,
where the velocities across are ONE and TWO and the rotation TURN; and the two friction forces and
the torque that do it."
  (declare (type not-negative u v) (double-float one two turn))
  (let* ((across (sqrt (the not-negative (+ (* one one) (* two two)))))
         (slip (* u across)) (twist (* v (abs turn))))
    (declare (type not-negative across slip twist))
    (if coupled
        (let ((root (sqrt (the not-negative (+ (* slip slip) (* twist twist))))))
          (if (> root 0d0)
              (values root (/ (* u u one) root) (/ (* u u two) root) (/ (* v v turn) root))
              (values 0d0 0d0 0d0 0d0)))
        (let ((share (if (> across 0d0) (/ u across) 0d0)))
          (values (+ slip twist) (* share one) (* share two) (if (>= turn 0d0) v (- v)))))))

(declaim (inline add-support))
(defun add-support (count rows u v coupled x w)
  "Add to W the wrench of COUNT fingers with ROWS that does most power in the motion X, and return
that power."
  (declare (type finger-count count) (type doubles rows) (type six x w) (type not-negative u v)
           (optimize speed))
  (let ((power 0d0))
    (declare (double-float power))
    (dotimes (i count power)
      (let* ((start (* +finger+ i))
             (along (row-dot rows start x)))
        (multiple-value-bind (share one two turn)
            (finger-share u v coupled (row-dot rows (+ start 6) x) (row-dot rows (+ start 12) x)
                          (row-dot rows (+ start 18) x))
          (declare (double-float share one two turn))
          (when (> (+ along share) 0d0)
            (incf power (+ along share))
            (add-row 1d0 rows start w)
            (add-row one rows (+ start 6) w)
            (add-row two rows (+ start 12) w)
            (add-row turn rows (+ start 18) w)))))))

(defun grip-power (grip x w)
  "Return the greatest power that GRIP can do in the motion X, a six, and put the wrench that does
it into W."
  (declare (type grip grip) (type six x w))
  (fill w 0d0)
  (add-support (grip-count grip) (grip-rows grip) (grip-friction grip) (grip-soft-friction grip)
               (grip-coupled grip) x w))

;;; Mirrors

(defun flips-p (mirror k)
  "True if the mirror along the axis MIRROR, 0 to 2, changes the sign of number K of a motion."
  (declare (type (integer 0 2) mirror) (type (integer 0 5) k))
  (if (< k 3) (= k mirror) (/= (- k 3) mirror)))

(defun mirrored-finger-p (places i j mirror)
  (declare (type doubles places) (type finger-count i j))
  (dotimes (k 6 t)
    (let ((a (aref places (+ (* 6 i) k))) (b (aref places (+ (* 6 j) k))))
      (unless (= b (if (= (mod k 3) mirror) (- a) a)) (return nil)))))

(defun mirrors (grip gravity)
  "Return the set of the axes, bits 0 to 2, along which GRIP and the wrench GRAVITY are their own
mirror images."
  (declare (type grip grip) (type six gravity))
  (let ((set 0) (count (grip-count grip)))
    (dotimes (mirror 3 set)
      (when (and (loop for k below 6 always (or (zerop (aref gravity k)) (not (flips-p mirror k))))
                 (loop for i below count
                       always (loop for j below count
                                      thereis (mirrored-finger-p (grip-places grip) i j mirror))))
        (setf set (logior set (ash 1 mirror)))))))

(defun scaled (motion size)
  "Divide MOTION, a six, by SIZE.  Return it."
  (map-into motion (lambda (q) (/ q size)) motion))
