;;;; cuts.lisp -- what a motion says of all placements: at most so much can the fingers do in it.
;;;;
;;;; The exact radius of a placement is the least, over all motions, of the power that the fingers
;;;; can do in it, the size of the task in it being 1.  So one motion, such as the worst one of
;;;; another placement, bounds the radius of every placement: it is a cut.  What it costs to ask a
;;;; cut is next to nothing.

(in-package :supergrip)

(deftype motion-cut () '(simple-array double-float (7)))
(deftype friction-number () '(double-float 0d0))

(defstruct (refining (:copier nil) (:conc-name r-))
  "The search for a better placement of the fingers of FREEDOM.  NORMALS has the axis that each is
normal to, SIGNS where along it the inward normal points; U and V are the coefficients of friction.
NEED is the task, GRAVITY the wrench of the weight, GRIP the fingers at the placement asked last,
ASKED how many powers were computed for that so far, CUTS a list of cuts: a motion, in which the
size of the task is 1, and gravity's power."
  (freedom nil :type freedom) (count 0 :type fixnum)
  (normals nil :type simple-vector) (signs nil :type doubles)
  (u 0d0 :type friction-number) (v 0d0 :type friction-number)
  (need nil :type six) (gravity nil :type six) (grip nil)
  (cuts '() :type list) (asked 0 :type fixnum))

(defun add-cut (refining motion)
  "Let REFINING know MOTION, a six.  One in which the task has no size says nothing."
  (let ((size (task-size (r-need refining) motion)))
    (when (> size (* 1d-9 (reduce #'max motion :key #'abs)))
      (let ((cut (make-array 7 :element-type 'double-float)))
        (dotimes (k 6)
          (setf (aref cut k) (/ (aref motion k) size))
          (incf (aref cut 6) (* (aref cut k) (aref (r-gravity refining) k))))
        (push cut (r-cuts refining))))))

(defun task-size (need motion)
  (declare (type six need motion))
  (sqrt (loop for f across need for q across motion sum (* f q f q) of-type friction-number)))

(declaim (inline finger-power))
(defun finger-power (cut normal sign u v x y z)
  "Return the greatest power, in the motion of CUT, of a finger at X Y Z."
  (declare (type motion-cut cut) (type (integer 0 2) normal) (type friction-number u v)
           (double-float sign x y z))
  (let* ((wx (aref cut 3)) (wy (aref cut 4)) (wz (aref cut 5))
         (gx (+ (aref cut 0) (- (* wy z) (* wz y))))
         (gy (+ (aref cut 1) (- (* wz x) (* wx z))))
         (gz (+ (aref cut 2) (- (* wx y) (* wy x)))))
    (declare (double-float gx gy gz))
    (flet ((power (along a b turn)
             (declare (double-float along a b turn))
             (max 0d0 (+ (* sign along) (* v (abs turn))
                         (* u (sqrt (the friction-number (+ (* a a) (* b b)))))))))
      (declare (inline power))
      (case normal
        (0 (power gx gy gz wx))
        (1 (power gy gz gx wy))
        (t (power gz gx gy wz))))))

(defun cut-power (refining cut placement)
  "Return the power that the fingers of REFINING can do in the motion of CUT if they stand at
PLACEMENT."
  (declare (type refining refining) (type motion-cut cut) (type doubles placement) (optimize speed))
  (let ((power (aref cut 6)))
    (declare (double-float power))
    (dotimes (i (r-count refining) power)
      (declare (type (integer 0 1000) i))
      (incf power (finger-power cut (svref (r-normals refining) i) (aref (r-signs refining) i)
                                (r-u refining) (r-v refining) (aref placement (* 3 i))
                                (aref placement (+ 1 (* 3 i))) (aref placement (+ 2 (* 3 i))))))))

(defun cuts-radius (refining placement)
  "Return the least that the cuts of REFINING leave of the radius at PLACEMENT."
  (let ((least 1d300))
    (declare (double-float least))
    (dolist (cut (r-cuts refining) least)
      (setf least (min least (the double-float (cut-power refining cut placement)))))))

(defun place-fingers (refining placement)
  "Put the fingers of the grip of REFINING at PLACEMENT.  Return it."
  (let ((grip (r-grip refining)))
    (dotimes (i (r-count refining) grip)
      (let ((normal (list 0d0 0d0 0d0)))
        (setf (nth (svref (r-normals refining) i) normal) (aref (r-signs refining) i))
        (apply #'set-finger grip i
               (append (coerce (subseq placement (* 3 i) (* 3 (1+ i))) 'list) normal))))))

(defun ask (refining placement gap absolute budget)
  "Return the exact radius of REFINING at PLACEMENT, an upper value and a certified one or NIL, as
GRIP-RADIUS does; the worst motion becomes a cut."
  (multiple-value-bind (upper lower worst evaluations)
      (grip-radius (place-fingers refining placement) (r-need refining) (r-gravity refining)
                   gap absolute budget)
    (incf (r-asked refining) evaluations)
    (add-cut refining worst)
    (values upper lower)))

(defparameter +most-powers+ 1000000
  "How many powers may be computed before the search ends.  Most grasps take less than a third.")

(defun may-ask-p (refining)
  (< (r-asked refining) +most-powers+))

(defun radius-at (refining placement least)
  "Return the exact radius of REFINING at PLACEMENT, an upper value, mostly within 1 %; or, if it is
not above LEAST, no more than a number between the two."
  (flet ((look (budget)
           (ask refining placement 0.01d0 1d-3 budget)
           (cuts-radius refining placement)))
    (let ((upper (look 0)))
      (if (> upper least) (look 3000) upper))))
