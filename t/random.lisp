;;;; random.lisp -- random boxes that can be had again from their seed.

(in-package :supergrip-test)

(defun random-between (low high state)
  "Return a double between LOW and HIGH, all magnitudes alike."
  (let ((number (exp (+ (log low) (random (log (/ high low)) state)))))
    (max low (min high number))))

(defun random-need (state)
  "Return six needs from 0 to 1, about a third of them 0."
  (loop repeat 6 collect (if (zerop (random 3 state)) 0 (/ (random 1001 state) 1000d0))))

(defun random-faces (state)
  "Return a random set of faces, each of the 64 sets alike."
  (let ((set (random 64 state)))
    (loop for face in '(x1 x2 y1 y2 z1 z2)
          for place from 0
          when (logbitp place set) collect face)))

(defun random-box (state &key (weight t))
  "Return the description of a box of 0.1 to 100 cm with any constraints and a random task.
Half of the boxes are of a size that a hand can hold."
  (let ((most (if (zerop (random 2 state)) 100d0 15d0))
        (force (random-need state))
        (velocity (random-need state)))
    (when (and (every #'zerop force) (every #'zerop velocity))
      (setf (first force) 1))
    `((size ,@(loop repeat 3 collect (random-between 0.1d0 most state)))
      (weight ,(if (and weight (plusp (random 4 state))) (random-between 0.01d0 3d0 state) 0))
      (u ,(random 2d0 state))
      (v ,(if (zerop (random 8 state)) 0 (random 0.5d0 state)))
      (constrained ,@(random-faces state))
      (force-needed ,force)
      (velocity-needed ,velocity))))

(defmacro for-random-boxes ((box count seed &rest keys) &body body)
  "Run BODY with BOX bound to COUNT random boxes.  The seed is printed, and chooses them."
  (let ((state (gensym "STATE")))
    `(let ((,state (sb-ext:seed-random-state ,seed)))
       (format t "~&   ~d random boxes, seed ~d~%" ,count ,seed)
       (dotimes (i ,count)
         (let ((,box (random-box ,state ,@keys)))
           ,@body)))))

(defun close-to (a b &optional (tolerance 1d-9))
  "True if A and B, numbers or lists of numbers, are equal within TOLERANCE, relative to 1 or more."
  (cond ((and (null a) (null b)) t)
        ((and (consp a) (consp b))
         (and (= (length a) (length b)) (every (lambda (x y) (close-to x y tolerance)) a b)))
        ((and (realp a) (realp b))
         (<= (abs (- a b)) (* tolerance (max 1 (abs a) (abs b)))))))

(defun box-part (box key)
  "Return what the description BOX gives for KEY."
  (rest (assoc key box)))
