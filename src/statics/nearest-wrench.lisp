;;;; nearest-wrench.lisp -- whether fingers can exert one wrench, how, and how far they reach along
;;;; one.
;;;;
;;;; Wolfe's method finds the wrench of a grip that is nearest to a target.  It keeps at most seven
;;;; wrenches, and their mixture that is nearest to the target.  In each step the grip's greatest
;;;; wrench towards the target joins them, and those leave that the nearest mixture does not need.
;;;; If the target can't be reached, the way to it from the nearest wrench is a motion that shows
;;;; it.

(in-package :supergrip-statics)

(defconstant +close+ 1d-9 "A target that is no farther away, in a round frame, is reached.")
(defconstant +near+ 1d-7 "So is one that is no farther away where rounding lets it come no closer.")
(defconstant +little+ 1d-5 "How far a closed grip reaches in a round frame, at least.")
(defconstant +corners+ 8 "How many wrenches the mixture has at most.")
(declaim (type six *all-needed*))
(defvar *all-needed* (map 'six #'identity '(1d0 1d0 1d0 1d0 1d0 1d0))
  "A task with a need along each axis.")

(defstruct (finder (:copier nil) (:conc-name f-))
  "The search for the wrench nearest to TARGET: COUNT to ROWS are the grip's in FRAME.  There are
SIZE CORNERS, wrenches less the target, each with the motion that gave it and its SHARE; X is the
mixture. POWER is the greatest in the motion Q, from X to the target."
  (count 0 :type finger-count) (u 0d0 :type not-negative) (v 0d0 :type not-negative)
  (coupled nil :type boolean) (rows nil :type doubles) (frame nil :type matrix)
  (target (make-six) :type six)
  (size 0 :type (integer 0 8))
  (corners (make-doubles (* 6 +corners+)) :type doubles)
  (motions (make-doubles (* 6 +corners+)) :type doubles)
  (shares (make-doubles +corners+) :type doubles)
  (wanted (make-doubles +corners+) :type doubles)
  (basis (make-doubles (* 6 +corners+)) :type doubles)
  (triangle (make-doubles (* +corners+ +corners+)) :type doubles)
  (x (make-six) :type six) (q (make-six) :type six) (w (make-six) :type six)
  (witness (make-six) :type six)
  (power 0d0 :type double-float) (evaluations 0 :type fixnum))

(defun rows-in-frame (grip frame)
  "Return the rows of GRIP in FRAME."
  (let* ((rows (grip-rows grip)) (framed (make-doubles (length rows))))
    (loop for start from 0 below (length rows) by +row+
          do (into-frame frame rows start framed))
    framed))

(defun find-in (grip &optional (frame (round-frame grip *all-needed* 0))
                       (rows (rows-in-frame grip frame)))
  "Return a finder for GRIP, in FRAME, in which it has ROWS."
  (make-finder :count (grip-count grip) :u (grip-friction grip) :v (grip-soft-friction grip)
               :coupled (grip-coupled grip) :rows rows :frame frame))

(defmacro corner-dot (a i b j)
  "The product of line I of A and line J of B, six numbers each."
  `(let ((i (* 6 ,i)) (j (* 6 ,j)))
     (declare (type (integer 0 100) i j))
     (+ ,@(loop for k below 6 collect `(* (aref ,a (+ i ,k)) (aref ,b (+ j ,k)))))))

(defun straighten (f j)
  "Make the edge from corner 0 of F to corner J orthogonal to those before it, and of length 1: it
is the sum over i of entry ij of TRIANGLE times line i of BASIS.  One that depends on them becomes
0."
  (declare (type finder f) (type (integer 0 7) j) (optimize speed))
  (let ((corners (f-corners f)) (basis (f-basis f)) (triangle (f-triangle f)) (start (* 6 j)))
    (dotimes (k 6)
      (setf (aref basis (+ start k)) (- (aref corners (+ start k)) (aref corners k))))
    (loop for i from 1 below j
          do (setf (aref triangle (+ (* +corners+ i) j)) 0d0))
    (let ((before (corner-dot basis j basis j)))
      (loop repeat 2                    ; once more, for what rounding left
            do (loop for i of-type (integer 0 8) from 1 below j
                     do (let ((part (corner-dot basis i basis j)))
                          (incf (aref triangle (+ (* +corners+ i) j)) part)
                          (dotimes (k 6)
                            (decf (aref basis (+ start k))
                                  (* part (aref basis (+ (* 6 i) k))))))))
      (let* ((after (corner-dot basis j basis j))
             (length (if (> after (* 1d-20 before)) (sqrt (the not-negative after)) 0d0)))
        (setf (aref triangle (+ (* +corners+ j) j)) length)
        (dotimes (k 6)
          (setf (aref basis (+ start k))
                (if (> length 0d0) (/ (aref basis (+ start k)) length) 0d0)))))))

(defun want-shares (f)
  "Put into WANTED the shares, of whatever sign, with which the corners of F come nearest to 0.  A
corner that depends on those before it gets 0."
  (declare (type finder f) (optimize speed))
  (let ((size (f-size f)) (triangle (f-triangle f)) (wanted (f-wanted f)) (rest 1d0))
    (declare (double-float rest))
    (loop for j of-type (integer 0 8) from 1 below size
          do (straighten f j))
    (loop for j of-type (integer -1 8) from (1- size) downto 1
          do (let ((length (aref triangle (+ (* +corners+ j) j)))
                   (sum (- (corner-dot (f-basis f) j (f-corners f) 0))))
               (declare (double-float sum))
               (loop for i of-type (integer 0 8) from (1+ j) below size
                     do (decf sum (* (aref triangle (+ (* +corners+ j) i)) (aref wanted i))))
               (setf (aref wanted j) (if (> length 0d0) (/ sum length) 0d0))
               (decf rest (aref wanted j))))
    (setf (aref wanted 0) rest)))

(defun drop-corner (f i)
  "Take corner I of F away; the last one takes its place."
  (declare (type finder f) (type (integer 0 7) i))
  (let ((last (1- (f-size f))))
    (setf (f-size f) last
          (aref (f-shares f) i) (aref (f-shares f) last))
    (dolist (lines (list (f-corners f) (f-motions f)))
      (declare (type doubles lines))
      (replace lines lines :start1 (* 6 i) :start2 (* 6 last) :end2 (* 6 (1+ last))))))

(defun share-out (f)
  "Give the corners of F the shares of the mixture nearest to 0, all above 0, and drop the others."
  (declare (type finder f) (optimize speed))
  (let ((shares (f-shares f)) (wanted (f-wanted f)))
    (loop
      (want-shares f)
      ;; As far as all shares stay above 0.
      (let ((step 1d0) (first -1))
        (declare (double-float step) (type (integer -1 7) first))
        (dotimes (i (f-size f))
          (let ((want (aref wanted i)) (have (aref shares i)))
            (when (<= want 1d-14)
              (let ((limit (if (> have want) (/ have (- have want)) 0d0)))
                (when (or (< first 0) (< limit step))
                  (setf step (min step limit) first i))))))
        (dotimes (i (f-size f))
          (incf (aref shares i) (* step (- (aref wanted i) (aref shares i)))))
        (when (or (< first 0) (<= (f-size f) 1))
          (return))
        (drop-corner f first)))))

(defun mix-corners (f)
  "Put the mixture of the corners of F into X, and the way back from it into Q.  Return its square."
  (declare (type finder f) (optimize speed))
  (let ((x (f-x f)) (square 0d0))
    (declare (double-float square))
    (dotimes (k 6 square)
      (let ((sum 0d0))
        (declare (double-float sum))
        (dotimes (i (f-size f))
          (incf sum (* (aref (f-shares f) i) (aref (f-corners f) (+ (* 6 i) k)))))
        (setf (aref x k) sum
              (aref (f-q f) k) (- sum))
        (incf square (* sum sum))))))

(defun support (f)
  "Put the greatest wrench of F in the motion Q into W, and its power into POWER."
  (declare (type finder f) (optimize speed))
  (fill (f-w f) 0d0)
  (incf (f-evaluations f))
  (setf (f-power f)
        (add-support (f-count f) (f-rows f) (f-u f) (f-v f) (f-coupled f) (f-q f) (f-w f))))

(defun add-corner (f share)
  "Add the wrench W of F, given by the motion Q, to the corners."
  (declare (type finder f) (double-float share) (optimize speed))
  (let ((start (* 6 (f-size f))))
    (dotimes (k 6)
      (setf (aref (f-corners f) (+ start k)) (- (aref (f-w f) k) (aref (f-target f) k))
            (aref (f-motions f) (+ start k)) (aref (f-q f) k)))
    (setf (aref (f-shares f) (f-size f)) share)
    (incf (f-size f))))

(defun no-force (f)
  "Let F have one corner, that of no force at all."
  (declare (type finder f))
  (fill (f-w f) 0d0)
  (fill (f-q f) 0d0)
  (setf (f-size f) 0)
  (add-corner f 1d0))

(defun aim (f from multiple way)
  "Make FROM and MULTIPLE times WAY, wrenches in the frame, the target of F.  Corners stay the same
wrenches."
  (declare (type finder f) (double-float multiple) (type six from way))
  (dotimes (k 6)
    (let* ((new (+ (aref from k) (* multiple (aref way k)))) (back (- (aref (f-target f) k) new)))
      (setf (aref (f-target f) k) new)
      (dotimes (i (f-size f))
        (incf (aref (f-corners f) (+ (* 6 i) k)) back)))))

(defun reach-p (f sure close)
  "True if F can exert its target, no more than CLOSE away: X is 0 then, but for rounding.  Else,
as soon as the motion Q shows by at least SURE, 0 to below 1, of the distance that it can't, return
NIL."
  (declare (type finder f) (double-float sure close))
  (loop repeat 300
        do (share-out f)
           (let ((square (mix-corners f)))
             (declare (double-float square))
             (when (<= square (* close close)) (return t))
             (support f)
             (let ((lacks (- (row-dot (f-target f) 0 (f-q f)) (f-power f))))
               (when (and (> lacks 0d0) (>= lacks (* sure square))) (return nil))
               ;; No wrench is nearer than X, which rounding keeps from 0.
               (when (or (>= lacks (* (- 1d0 1d-9) square)) (= (f-size f) +corners+))
                 (return (<= square (* +near+ +near+))))
               (add-corner f 0d0)))
        finally (return (<= (mix-corners f) (* +near+ +near+)))))

;;; What it is for

(defun reaches-p (f wrench)
  "True if F can exert WRENCH, one in its frame.  If not, Q is a motion that shows it."
  (declare (type finder f) (type six wrench))
  (replace (f-target f) wrench)
  (no-force f)
  (reach-p f 0d0 +close+))

(defun grip-reach (grip wrench)
  "True if GRIP can exert WRENCH, a six; the second value is the finder that knows it."
  (declare (type grip grip) (type six wrench))
  (without-float-traps
    (let ((f (find-in grip)) (framed (make-six)))
      (into-frame (f-frame f) wrench 0 framed)
      (values (reaches-p f framed) f))))

(defun opposite (six)
  (declare (type six six))
  (map 'six #'- six))

(defun grip-holds-p (grip gravity)
  "True if GRIP can hold a thing against the wrench GRAVITY, a six.  If not, the second value is a
motion in which the fingers do less power than gravity takes."
  (declare (type grip grip) (type six gravity))
  (multiple-value-bind (holds finder) (grip-reach grip (opposite gravity))
    (values holds
            (and (not holds) (out-of-frame (f-frame finder) (f-q finder))))))

(defun spans-all-p (grip)
  "True if GRIP reaches seven ways that positive mixtures make all others of: each axis, and against
them all."
  (declare (type grip grip))
  (let ((f (find-in grip)) (nothing (make-six)) (way (make-six)))
    (flet ((reached-p ()
             (aim f nothing +little+ way)
             (reach-p f 0d0 +close+)))
      (no-force f)
      (and (loop for k below 6
                 always (progn (fill way 0d0)
                               (setf (aref way k) 1d0)
                               (reached-p)))
           (progn (fill way -1d0)
                  (reached-p))))))

(defun grip-closed-p (grip)
  "True if GRIP is closed: it can exert a wrench in every direction.  One that reaches less than
1e-5 as far in one direction as in the mean is not, nor one that can't be computed."
  (without-float-traps
    (and (computable-p grip (make-six))
         (spans-all-p grip))))

(defun add-forces (f motion share forces)
  "Add to FORCES, four numbers a finger, SHARE times what the fingers of F do in MOTION: how much
they press, the two forces across, and the torque about the normal."
  (declare (type finder f) (type six motion) (double-float share) (type doubles forces))
  (let ((rows (f-rows f)))
    (dotimes (i (f-count f))
      (let ((start (* +finger+ i)))
        (multiple-value-bind (power one two turn)
            (finger-share (f-u f) (f-v f) (f-coupled f) (row-dot rows (+ start 6) motion)
                          (row-dot rows (+ start 12) motion) (row-dot rows (+ start 18) motion))
          (declare (double-float power one two turn))
          (when (> (+ (row-dot rows start motion) power) 0d0)
            (loop for number in (list 1d0 one two turn) for place from (* 4 i)
                  do (incf (aref forces place) (* share number)))))))))

(defun nearest-forces (f)
  "Return the forces of the fingers of F at the nearest mixture that it has found: see GRIP-FORCES."
  (declare (type finder f))
  (let ((forces (make-doubles (* 4 (f-count f)))) (motion (make-six)))
    (dotimes (i (f-size f) forces)
      (replace motion (f-motions f) :start2 (* 6 i))
      (add-forces f motion (aref (f-shares f) i) forces))))

(defun grip-forces (grip wrench)
  "Return the forces of the fingers of GRIP that together exert WRENCH, a six: four numbers a
finger, how much it presses, two forces across (see SET-FINGER), and the torque about the normal.
If there are none, return NIL and a motion in which the fingers do less power than WRENCH."
  (declare (type grip grip) (type six wrench))
  (multiple-value-bind (reached f) (grip-reach grip wrench)
    (if reached
        (nearest-forces f)
        (values nil (out-of-frame (f-frame f) (f-q f))))))

(defun farthest (f way from)
  "Return the greatest multiple of WAY that F can exert together with FROM, wrenches in the frame; F
can exert FROM alone.  WITNESS is then a motion that shows that it is the greatest."
  (declare (type finder f) (type six way from))
  (let ((most most-positive-double-float))
    (declare (double-float most))
    (no-force f)
    (replace (f-q f) way)
    (support f)
    ;; Each motion that shows a multiple to be too great says how great it can be at most.
    (loop repeat 200
          do (let ((next (/ (- (f-power f) (row-dot from 0 (f-q f))) (row-dot way 0 (f-q f)))))
               (declare (double-float next))
               (when (>= next (* most (- 1d0 1d-12))) (return most))
               (replace (f-witness f) (f-q f))
               (when (<= next +close+) (return 0d0))
               (setf most next)
               (aim f from most way)
               (when (reach-p f 0.5d0 +near+) (return most)))
          finally (return most))))

(defun grip-entry (grip direction &optional finder)
  "Return the greatest multiple of the wrench DIRECTION, a six, that GRIP can exert, a double: with
a unit wrench along an axis, its exact WRENCH entry one way.  The second value is a motion in which
the fingers can do no more than that.  FINDER, from FIND-IN, may be used again for the same grip."
  (declare (type grip grip) (type six direction))
  (without-float-traps
    (let ((f (or finder (find-in grip))) (way (make-six)))
      (into-frame (f-frame f) direction 0 way)
      (let ((most (farthest f way (make-six))))
        (values most (out-of-frame (f-frame f) (f-witness f)))))))
