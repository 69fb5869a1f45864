;;;; floor.lisp -- the least that the pencil session costs: its six candidates and their qualities
;;;; by straight typed arithmetic, without rules, matchings, forms or records.
;;;;
;;;; The formulas are those of grasps.lisp, written by hand; so is the choice of the candidates.
;;;; What TRY decides is decided here, too: conditions, fingers, open, lifting.

(in-package :supergrip-bench)

(deftype six () '(simple-array double-float (6)))

(defmacro gripper (name)
  "The dimension NAME of the shipped gripper, known when this file is loaded."
  `(the double-float
        (load-time-value
         (cdr (assoc ,name (supergrip:knowledge-gripper supergrip:*knowledge*) :test #'string=)))))

(defmacro define-arithmetic (name (&rest parameters) &body body)
  "Define the inline function NAME of doubles."
  `(progn (declaim (inline ,name))
          (defun ,name ,parameters
            (declare (double-float ,@parameters) (optimize speed) (sb-ext:muffle-conditions
                                                                   sb-ext:compiler-note))
            ,@body)))

(define-arithmetic root (x) (sqrt (the (double-float 0d0) (max x 0d0))))
(define-arithmetic posit (x) (max x 0d0))

;;; The helper functions of grasps.lisp

(define-arithmetic pair-force (d q u)
  (let ((r (/ d (* 2 q))))
    (max 1d0 (if (<= (* 2 r u) (+ u r))
                 (/ (* 2 u u r) (+ u r))
                 (+ 1 u (- (/ (+ u r) (* 2 r u))))))))

(define-arithmetic side-force (q u v)
  (let ((x (min (/ (* u u) (root (+ 1 (* u u))))
                (if (>= (* 2 v) (* u q)) 0.5d0 (/ v (* u q))))))
    (+ (* 2 (root (- (* u u) (* x x)))) (* 2 u x))))

(define-arithmetic pair-torque (q u v)
  (+ (* 2 v) (* u q (min 1d0 (/ (* 2 u) (root (+ 1 (* u u))))))))

(define-arithmetic third-torque (d u v)
  (let ((x (min 0.5d0 (/ (* 2 u v) (root (+ (* d d) (* 4 v v)))))))
    (+ (* d (root (- (* u u) (* x x)))) (* 2 v x))))

(define-arithmetic side-torque (d q u)
  (+ (* u d)
     (if (> (* 2 u q) (+ (* 2 u u d) d))
         (* (min 1d0 (/ (* 2 u u) (+ 1 (* u u)))) (- q (* u d) (/ d (* 2 u))))
         0d0)))

;;; One candidate

(defstruct (task (:conc-name task-))
  "A box and its task; CAPACITY, MOBILITY, ARM and NEED are scratch, along and about X Y Z."
  (size nil :type six) (force nil :type six) (velocity nil :type six)
  (weight 0d0 :type double-float) (u 0d0 :type double-float) (v 0d0 :type double-float)
  (capacity (new-six) :type six) (mobility (new-six) :type six) (arm (new-six) :type six)
  (need (new-six) :type six))

(defun new-six () (make-array 6 :element-type 'double-float :initial-element 0d0))

(defun box-task (box)
  "Return the task of BOX."
  (flet ((six (list) (replace (new-six) list)))
    (make-task :size (six (supergrip:box-size box)) :weight (supergrip:box-weight box)
               :u (supergrip:box-friction box) :v (supergrip:box-soft-friction box)
               :force (six (supergrip:box-force-needed box))
               :velocity (six (supergrip:box-velocity-needed box)))))

(declaim (inline least-ratio))
(defun least-ratio (needs from to arm have out)
  "Return the least ratio of HAVE to NEEDS, which grow at the place TO by the lever ARM."
  (declare (type six needs arm have out) (fixnum from to) (optimize speed))
  (replace out needs)
  (loop for i below 3 for j = (mod (+ i 1) 3) for k = (mod (+ i 2) 3)
        do (incf (aref out (+ to i)) (+ (* (aref arm j) (aref needs (+ from k)))
                                        (* (aref arm k) (aref needs (+ from j))))))
  (let ((least sb-ext:double-float-positive-infinity))
    (declare (double-float least))
    (dotimes (i 6 least)
      (when (> (aref out i) 0d0)
        (setf least (min least (/ (aref have i) (aref out i))))))))

(declaim (inline quality))
(defun quality (task)
  "Return the quality that the scratch of TASK gives, or -1 where it is open or can't lift."
  (declare (type task task) (optimize speed))
  (let ((capacity (task-capacity task)) (arm (task-arm task)) (weight (task-weight task)))
    (cond ((loop for i below 6 thereis (<= (aref capacity i) 0d0)) -1d0)
          ((or (< (decf (aref capacity 2) weight) 0d0)
               (< (decf (aref capacity 3) (* weight (aref arm 1))) 0d0)
               (< (decf (aref capacity 4) (* weight (aref arm 0))) 0d0))
           -1d0)
          (t (+ (* 0.5d0 (least-ratio (task-velocity task) 3 0 arm (task-mobility task)
                                      (task-need task)))
                (* 0.5d0 (least-ratio (task-force task) 0 3 arm capacity (task-need task))))))))

(defmacro candidate (task (n o a) &key conditions (q 0d0) arms wrench twist)
  "The quality of a grasp of TASK whose N O A lie along the axes N O A, or -1.
CONDITIONS, Q, ARMS (the offset, three lengths), WRENCH and TWIST are forms of u, v and the
distances dn, do, da; WRENCH may use q, too.  No face that the candidates use is constrained."
  `(let ((dn (aref (task-size ,task) ,n)) (do (aref (task-size ,task) ,o))
         (da (aref (task-size ,task) ,a)) (u (task-u ,task)) (v (task-v ,task)))
     (declare (ignorable v))
     (if (not ,conditions)
         -1d0
         (let ((capacity (task-capacity ,task)) (mobility (task-mobility ,task))
               (arm (task-arm ,task)) (q ,q))
           (declare (ignorable q))
           ,@(loop for axis in (list n o a) for length in arms
                   collect `(setf (aref arm ,axis) ,length))
           ,@(loop for axis in (list n o a (+ 3 n) (+ 3 o) (+ 3 a))
                   for force in wrench for mobility in twist
                   collect `(setf (aref capacity ,axis) ,force
                                  (aref mobility ,axis) ,mobility))
           (if (and (<= (aref arm ,n) (/ dn 2)) (<= (aref arm ,o) (/ do 2))
                    (<= (aref arm ,a) (/ da 2)))
               (quality ,task)
               -1d0)))))

(defmacro u-shape (task axes)
  `(candidate ,task ,axes
     :conditions (and (< do (gripper "DIST-PINCH")) (>= dn (gripper "FINGER-WIDTH"))
                      (>= do (gripper "FINGER-WIDTH")) (>= da (gripper "FINGER-WIDTH")))
     :q (min (/ dn 2) (gripper "REACH-U"))
     :arms ((posit (- (/ dn 2) (gripper "REACH-U"))) 0d0 (posit (- (/ da 2) (gripper "REACH-U"))))
     :wrench ((* 2 u) (pair-force do q u) (side-force q u v)
              (third-torque do u v) (pair-torque q u v) (side-torque do q u))
     :twist (0.2d0 0.5d0 0.8d0 0.4d0 0.5d0 0.5d0)))

(defmacro c-shape (task axes)
  `(candidate ,task ,axes
     :conditions (and (< dn (gripper "DIST-PINCH")) (>= dn (gripper "FINGER-WIDTH"))
                      (>= do (gripper "FINGER-WIDTH")) (>= da (gripper "FINGER-WIDTH")))
     :q (min (/ do 2) (gripper "REACH-C"))
     :arms (0d0 (posit (- (/ do 2) (gripper "REACH-C"))) (posit (- (/ da 2) (gripper "REACH-C"))))
     :wrench ((pair-force dn q u) (* 2 u) (side-force q u v)
              (pair-torque q u v) (third-torque dn u v) (side-torque dn q u))
     :twist (0.7d0 0.7d0 0.5d0 0.3d0 0.5d0 0.4d0)))

(defmacro parallel (task axes)
  `(candidate ,task ,axes
     :conditions (and (< dn (gripper "DIST-PINCH")) (>= do (gripper "FINGER-SPREAD"))
                      (>= da (gripper "FINGER-WIDTH")))
     :arms (0d0 0d0
            (let ((r (/ (- dn (gripper "FINGER-DIST")) 2)) (length (gripper "FINGER-LENGTH")))
              (posit (- (/ da 2) length
                        (if (> (gripper "FINGER-DIST") dn)
                            (root (- (* length length) (* r r)))
                            0d0)))))
     :wrench (1d0 (* 2 u) (* 2 u) (+ (* 2 v) (* u (/ (gripper "FINGER-SPREAD") 2)))
              (* u dn) (+ (* u dn) (/ (gripper "FINGER-SPREAD") 2)))
     :twist (0.8d0 0.5d0 1d0 0.5d0 1d0 1d0)))

;;; The session

(defun pencil-qualities (task out)
  "Put the qualities of the six candidates of the pencil session, in their order, into OUT."
  (declare (type task task) (type six out) (optimize speed)
           (sb-ext:muffle-conditions sb-ext:compiler-note))
  (setf (aref out 0) (u-shape task (0 1 2))
        (aref out 1) (u-shape task (2 1 0))
        (aref out 2) (c-shape task (1 2 0))
        (aref out 3) (c-shape task (1 0 2))
        (aref out 4) (parallel task (1 0 2))
        (aref out 5) (parallel task (1 2 0)))
  out)
