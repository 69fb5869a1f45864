;;;; search.lisp -- a pattern search for the placement of the greatest exact radius.

(in-package :supergrip)

(defun unit-moves (freedom)
  "Return the moves that the search tries: lists of (PLACE . PART), PART of a step for the coordinate
PLACE of a placement.  They move one finger, all fingers, two fingers together, or apart."
  (flet ((free-p (place)
           (> (aref (freedom-high freedom) place) (aref (freedom-low freedom) place)))
         (move (axis &rest fingers-and-parts)
           (loop for (finger part) on fingers-and-parts by #'cddr
                 collect (cons (+ (* 3 finger) axis) part))))
    (let ((count (freedom-count freedom)) (moves '()))
      (dotimes (axis 3)
        (let ((fingers (loop for i below count when (free-p (+ (* 3 i) axis)) collect i)))
          (dolist (i fingers) (push (move axis i 1d0) moves))
          (when (> (length fingers) 2)
            (push (apply #'move axis (loop for i in fingers append (list i 1d0))) moves))
          (loop for (i . others) on fingers
                do (dolist (j others)
                     (push (move axis i 1d0 j 1d0) moves)
                     (push (move axis i 1d0 j -1d0) moves)))))
      (nreverse moves))))

(defun moved (placement move step freedom)
  "Return PLACEMENT after MOVE by STEP, made legal, or NIL."
  (let ((new (copy-seq placement)))
    (loop for (place . part) in move do (incf (aref new place) (* step part)))
    (make-legal new freedom)))

(defun slope-move (refining placement value step)
  "Return the move that raises the cuts of REFINING that are least at PLACEMENT, VALUE, or little more."
  (let* ((freedom (r-freedom refining)) (size (length placement))
         (slope (make-array size :element-type 'double-float :initial-element 0d0))
         (soft (+ 1d-12 (* 0.05d0 (abs value) (min 1d0 step)))))
    (dolist (cut (r-cuts refining))
      (let ((weight (exp (- (min 50d0 (/ (- (cut-power refining cut placement) value) soft))))))
        (when (> weight 1d-4)
          (dotimes (place size)
            (when (> (aref (freedom-high freedom) place) (aref (freedom-low freedom) place))
              (let ((old (aref placement place)) (small 1d-6))
                (setf (aref placement place) (+ old small))
                (let ((up (cut-power refining cut placement)))
                  (setf (aref placement place) (- old small))
                  (incf (aref slope place)
                        (* weight (- up (cut-power refining cut placement)))))
                (setf (aref placement place) old)))))))
    (let ((most (reduce #'max slope :key #'abs)))
      (when (plusp most)
        (list (loop for place below size
                    unless (zerop (aref slope place))
                      collect (cons place (/ (aref slope place) most))))))))

(defun better-placement (refining placement value moves step)
  "Return a placement that one of MOVES by STEP, or one along the slope, makes of PLACEMENT, and its
radius, if that is above VALUE; else NIL."
  (let* ((least (+ value (* 1d-4 (abs value)) 1d-9))
         (ways (loop for move in (append (slope-move refining placement value step) moves)
                     append (loop for way in (list step (- step))
                                  for new = (moved placement move way (r-freedom refining))
                                  for radius = (and new (cuts-radius refining new))
                                  when (and radius (> radius least))
                                    collect (cons radius new)))))
    (loop
      (setf ways (stable-sort (remove least ways :key #'car :test #'>=) #'> :key #'car))
      (when (null ways) (return nil))
      (let* ((new (cdr (pop ways))) (radius (radius-at refining new least)))
        (when (> radius least) (return (values new radius)))
        (dolist (way ways)
          (setf (car way)
                (min (car way) (cut-power refining (first (r-cuts refining)) (cdr way)))))))))

(defun widest (low high)
  "Return the place where LOW and HIGH, vectors, differ most, and by how much."
  (let ((place 0) (most 0d0))
    (dotimes (k (length low) (values place most))
      (when (> (- (aref high k) (aref low k)) most)
        (setf place k most (- (aref high k) (aref low k)))))))

(defun climb (refining placement value)
  "Return a placement that no small move betters, found from PLACEMENT, with the radius VALUE; and its
radius.  The first step is a quarter of the way that a finger has, the last one 0.1 mm or less."
  (let* ((freedom (r-freedom refining)) (moves (unit-moves freedom))
         (way (nth-value 1 (widest (freedom-low freedom) (freedom-high freedom)))))
    (loop with step = (/ way 4)
          while (> step (min 5d-3 (/ way 500)))
          do (multiple-value-bind (new radius) (better-placement refining placement value moves step)
               (if new
                   (setf placement new value radius)
                   (setf step (/ step 2)))))
    (values placement value)))
