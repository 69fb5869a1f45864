;;;; entries.lisp -- how far a grip reaches along each axis, both ways, certified.

(in-package :supergrip-statics)

(deftype twelve () "Six numbers along the axes, then six against them."
  '(simple-array double-float (12)))

(defun make-twelve () (make-array 12 :element-type 'double-float :initial-element 0d0))

(defun mirror-of (k mirrors)
  "Return one of MIRRORS, a set of axes, that turns axis K, 0 to 5, round; or NIL."
  (loop for mirror below 3
          thereis (and (logbitp mirror mirrors) (flips-p mirror k))))

(defun bounds-along (grip k sign)
  "Return how far GRIP, a closed one, reaches along axis K, 0 to 5, in the direction of SIGN: what
it surely exerts, and what it surely can't exceed."
  (multiple-value-bind (low high) (pure-wrench grip k sign)
    (if low
        (values low high)
        ;; Where friction is a thousand times what a finger presses, say, that is too much for
        ;; logarithms.  This takes longer, and is exact within 1e-6.
        (let ((way (make-six)))
          (setf (aref way k) sign)
          (let ((reach (grip-entry grip way)))
            (values (* (- 1d0 1d-6) reach) reach))))))

(defun grip-entries (grip)
  "Return how far GRIP reaches along each axis: its exact WRENCH entries, six along and six against
X Y Z and about X Y Z.  Two twelves: what it surely exerts, and what it surely can't exceed, equal
to ten places or so, or to six where friction is in the hundreds.  All are 0 if the grip is open, or
can't be computed.
Where GRIP is its own mirror image, one way is as far as the other."
  (declare (type grip grip))
  (without-float-traps
    (let ((least (make-twelve)) (most (make-twelve)))
      (when (grip-closed-p grip)
        (let ((mirrors (mirrors grip (make-six))))
          (dotimes (place 12)
            (let ((k (mod place 6)))
              (if (and (>= place 6) (mirror-of k mirrors))
                  (setf (aref least place) (aref least k) (aref most place) (aref most k))
                  (setf (values (aref least place) (aref most place))
                        (bounds-along grip k (if (< place 6) 1d0 -1d0))))))))
      (values least most))))
