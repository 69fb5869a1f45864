;;;; climb.lisp -- a pattern search for the placement of the greatest exact radius.

(in-package :supergrip)

(defun unit-moves (freedom)
  "Return the moves that the search tries: lists of (PLACE . PART), PART of a step for the
coordinate PLACE of a placement.  They move one finger, all fingers, two fingers together, or
apart."
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

(defun add-slope (refining cut placement weight slope)
  "Add WEIGHT times the slope of CUT at PLACEMENT, along each coordinate that is free, to SLOPE."
  (let ((freedom (r-freedom refining)) (small 1d-6))
    (dotimes (place (length slope))
      (when (> (aref (freedom-high freedom) place) (aref (freedom-low freedom) place))
        (let ((here (aref placement place)))
          (flet ((power (there)
                   (setf (aref placement place) there)
                   (cut-power refining cut placement)))
            (incf (aref slope place)
                  (* weight (- (power (+ here small)) (power (- here small)))))
            (setf (aref placement place) here)))))))

(defun slope-move (refining placement value part)
  "Return the move that raises the cuts of REFINING that are least at PLACEMENT, VALUE, or more by
about PART of it, the least ones most; NIL if none does."
  (let ((slope (make-array (length placement) :element-type 'double-float :initial-element 0d0))
        (soft (+ 1d-12 (* part (abs value)))))
    (dolist (cut (r-cuts refining))
      (let ((above (/ (- (cut-power refining cut placement) value) soft)))
        (when (< above 10d0)
          (add-slope refining cut placement (exp (- (max 0d0 above))) slope))))
    (let ((most (reduce #'max slope :key #'abs)))
      (and (plusp most)
           (loop for part across slope
                 for place from 0
                 unless (zerop part)
                   collect (cons place (/ part most)))))))

(defparameter +softness+ '(0.1d0 0.03d0 0.01d0 0.003d0 0.001d0)
  "Within which part of the radius cuts count for a move along the slope.")

(defun better-ways (refining placement value moves step)
  "Return what MOVES by STEP, and those along slopes, make of PLACEMENT, if the cuts of REFINING
allow it more than VALUE: a list of (RADIUS . PLACEMENT), RADIUS the least that the cuts allow."
  (let ((slopes (remove nil (loop for part in +softness+
                                  collect (slope-move refining placement value part)))))
    (loop for move in (append slopes moves)
          append (loop for way in (list step (- step))
                       for new = (moved placement move way (r-freedom refining))
                       for radius = (and new (cuts-radius refining new))
                       when (and radius (> radius value))
                         collect (cons radius new)))))

(defun most-allowed (ways least)
  "Return those of WAYS, a list of (RADIUS . PLACEMENT), with a RADIUS above LEAST, the greatest
first."
  (stable-sort (remove least ways :key #'car :test #'>=) #'> :key #'car))

(defun allow-less (ways refining)
  "Let the radii of WAYS be no greater than the latest cut of REFINING allows."
  (let ((cut (first (r-cuts refining))))
    (dolist (way ways)
      (setf (car way) (min (car way) (cut-power refining cut (cdr way)))))))

(defun first-above (refining ways least most)
  "Ask for the radii of at most MOST of WAYS, (RADIUS . PLACEMENT), the most promising first, until
one is above LEAST.  Return its placement and its radius, or NIL.  What is asked makes cuts, which
rule out others."
  (loop repeat most
        while (may-ask-p refining)
        do (setf ways (most-allowed ways least))
           (when (null ways) (return nil))
           (let* ((new (cdr (pop ways))) (radius (radius-at refining new least)))
             (when (> radius least) (return (values new radius)))
             (allow-less ways refining))))

(defun widest (low high)
  "Return the place where LOW and HIGH, vectors, differ most, and by how much."
  (let ((place 0) (most 0d0))
    (dotimes (k (length low) (values place most))
      (when (> (- (aref high k) (aref low k)) most)
        (setf place k most (- (aref high k) (aref low k)))))))

(defparameter +worth+ 2d-3 "Which part of the radius a move has to gain.")
(defparameter +most-asked+ 8 "How many moves of one length may fail before shorter ones are tried.")

(defun climb (refining placement value)
  "Return a placement that no small move betters, found from PLACEMENT, with the radius VALUE; and
its radius.  The first step is a quarter of the way that a finger has, the last one 0.1 mm or less."
  (let* ((freedom (r-freedom refining)) (moves (unit-moves freedom))
         (way (nth-value 1 (widest (freedom-low freedom) (freedom-high freedom)))))
    (loop with step = (/ way 4)
          repeat 400
          while (> step (min 5d-3 (/ way 500)))
          do (multiple-value-bind (new radius)
                 (let ((least (+ value (* +worth+ (abs value)) 1d-9)))
                   (first-above refining (better-ways refining placement least moves step) least
                                +most-asked+))
               (if new
                   (setf placement new value radius)
                   (setf step (/ step 2)))))
    (values placement value)))

(defun climb-surely (refining placement value)
  "Climb from PLACEMENT, with the radius VALUE, until what is found is as good as it was taken for.
Return the placement and its radius, an upper value within 1 % if that can be proved."
  (loop repeat 5
        do (multiple-value-setq (placement value) (climb refining placement value))
           (let ((upper (ask refining placement 0.01d0 1d-3 30000)))
             (when (>= upper (* 0.995d0 value)) (return))
             (setf value upper)))
  (values placement value))
