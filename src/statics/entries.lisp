;;;; entries.lisp -- how far a grip reaches along each axis, both ways, certified.
;;;;
;;;; Forces of the fingers that nearly make a pure wrench are the lower bound: what they do beside
;;;; it is measured by the twelve wrenches themselves, and taken off.  A motion in which the fingers
;;;; can do no more is the upper bound.

(in-package :supergrip-statics)

(deftype twelve () "Six numbers along the axes, then six against them."
  '(simple-array double-float (12)))

(defun wrench-of-forces (grip forces)
  "Return the wrench that FORCES, four numbers a finger of GRIP, make together, a six."
  (declare (type grip grip) (type doubles forces))
  (let ((wrench (make-six)) (rows (grip-rows grip)))
    (dotimes (i (length forces) wrench)
      (add-row (aref forces i) rows (* +row+ i) wrench))))

(defun reached (grip f k sign)
  "Return the greatest multiple of the unit wrench along axis K, 0 to 5, times SIGN that GRIP, which F
searches, can exert at most, and the wrench of forces that come near it, a six."
  (declare (type finder f) (type (integer 0 5) k) (double-float sign))
  (let ((direction (make-six)) (way (make-six)))
    (setf (aref direction k) sign)
    (into-frame (f-frame f) direction 0 way)
    (let ((most (farthest f way (make-six))))
      (values most (if (plusp most) (wrench-of-forces grip (nearest-forces f)) (make-six))))))

(defun beside-share (wrench place most)
  "Return the share of MOST, a twelve, that takes off what WRENCH, the one at PLACE, does beside its
axis."
  (declare (type six wrench) (type twelve most))
  (loop for k below 6
        for part = (aref wrench k)
        unless (= k (mod place 6))
          sum (/ (abs part) (aref most (if (plusp part) (+ k 6) k))) of-type double-float))

(defun certified-entries (most wrenches)
  "Return what is surely exerted each way, a twelve, where MOST is reached nearly by WRENCHES.
Let P be what the wrenches' own parts along the axes span, and e how much of P, at most, takes off
what one does beside its axis.  Then the wrenches span (1 - e) P at least: for each motion, the one
that does most in P does no less than 1 - e of it."
  (declare (type twelve most))
  (let ((along (make-array 12 :element-type 'double-float)))
    (dotimes (place 12)
      (let ((part (aref (the six (svref wrenches place)) (mod place 6))))
        (setf (aref along place) (min (aref most place) (if (< place 6) part (- part))))))
    (if (notevery #'plusp along)
        (fill along 0d0)
        (let ((most-beside (loop for place below 12
                                 maximize (beside-share (svref wrenches place) place along))))
          (map-into along (lambda (entry) (* entry (max 0d0 (- 1d0 most-beside)))) along)))))

(defun mirrored-wrench (wrench mirror)
  "Return the mirror image of WRENCH along the axis MIRROR, a six."
  (declare (type six wrench))
  (let ((image (make-six)))
    (dotimes (k 6 image)
      (setf (aref image k) (if (flips-p mirror k) (- (aref wrench k)) (aref wrench k))))))

(defun grip-entries (grip)
  "Return how far GRIP reaches along each axis: its exact WRENCH entries, six along and six against X Y
Z and about X Y Z.  Two twelves: what it surely exerts, and what it surely can't exceed.  The first
are all 0 if one way can't be gone at all: the grip is open.
Where GRIP is its own mirror image, one way is as far as the other."
  (declare (type grip grip))
  (without-float-traps
    (let ((most (make-array 12 :element-type 'double-float :initial-element 0d0))
          (wrenches (make-array 12)) (nothing (make-six)))
      (if (not (computable-p grip nothing))
          (values most most)
          (let ((f (find-in grip)) (mirrors (mirrors grip nothing)))
            (dotimes (k 6 (values (certified-entries most wrenches) most))
              (let ((mirror (loop for mirror below 3
                                  when (and (logbitp mirror mirrors) (flips-p mirror k))
                                    return mirror)))
                (dolist (place (list k (+ k 6)))
                  (multiple-value-bind (reach wrench)
                      (if (and mirror (>= place 6))
                          (values (aref most k) (mirrored-wrench (svref wrenches k) mirror))
                          (reached grip f k (if (< place 6) 1d0 -1d0)))
                    (setf (aref most place) reach (svref wrenches place) wrench)
                    (unless (plusp reach)
                      (return-from grip-entries (values (fill most 0d0) most))))))))))))
