;;;; scan.lisp -- all placements of a lattice, most of which the cuts rule out unasked.
;;;;
;;;; There are two lattices: one of all legal placements, and a finer one of those near the best
;;;; known.  What the cuts allow most is moved to where they allow still more, and only then asked.

(in-package :supergrip)

(defparameter +most-scanned+ 3000 "How many placements the lattice has at most.")

(defparameter +most-tried+ 400000 "How many places of one finger are tried for that, at most.")

(defun finger-lattice (freedom finger count)
  "Return the places of FINGER of FREEDOM on a lattice of COUNT by COUNT: lists along X Y Z."
  (flet ((along (axis)
           (let* ((place (+ (* 3 finger) axis)) (low (aref (freedom-low freedom) place))
                  (way (- (aref (freedom-high freedom) place) low)))
             (if (plusp way)
                 (loop for k below count collect (+ low (* way (/ k (1- count)))))
                 (list low)))))
    (loop for x in (along 0)
          append (loop for y in (along 1)
                       append (loop for z in (along 2) collect (list x y z))))))

(defun lattice (freedom count)
  "Return the legal placements of FREEDOM in which each finger stands on a lattice of COUNT by
COUNT; NIL if there are too many."
  (let* ((found '()) (left +most-scanned+) (tries +most-tried+) (fingers (freedom-count freedom))
         (places (loop for finger below fingers collect (finger-lattice freedom finger count)))
         (placement (copy-seq (freedom-home freedom))))
    (labels ((apart-p (finger)
               (loop for limit in (freedom-between freedom)
                     always (or (/= finger (limit-between-two limit))
                                (within-limit-p placement limit))))
             (place-from (finger places)
               (if (= finger fingers)
                   (progn (push (copy-seq placement) found)
                          (when (minusp (decf left)) (return-from lattice nil)))
                   (dolist (place (first places))
                     (when (minusp (decf tries)) (return-from lattice nil))
                     (replace placement place :start1 (* 3 finger))
                     (when (apart-p finger) (place-from (1+ finger) (rest places)))))))
      (place-from 0 places)
      found)))

(defun finest-lattice (freedom)
  "Return the legal placements on the finest lattice that has not too many."
  (loop with finest = '()
        for count from 3 to 15 by 2
        for placements = (lattice freedom count)
        do (when (and (null placements) finest) (return finest))
           (when placements (setf finest placements))
        finally (return finest)))

(defun freedom-near (freedom placement part)
  "Return FREEDOM with PART of the way that each finger has, around PLACEMENT; with 1, FREEDOM
itself."
  (when (= part 1) (return-from freedom-near freedom))
  (let ((low (copy-seq (freedom-low freedom))) (high (copy-seq (freedom-high freedom))))
    (map-into low (lambda (low high here) (max low (- here (* part 1/2 (- high low)))))
              (freedom-low freedom) (freedom-high freedom) placement)
    (map-into high (lambda (low high here) (min high (+ here (* part 1/2 (- high low)))))
              (freedom-low freedom) (freedom-high freedom) placement)
    (make-freedom :count (freedom-count freedom) :faces (freedom-faces freedom)
                  :home (freedom-home freedom) :low low :high high
                  :between (freedom-between freedom))))

(defun raise (refining placement step)
  "Return a placement of which the cuts of REFINING allow most, found from PLACEMENT by moves of
STEP cm and shorter ones; and what they allow.  Nothing is asked."
  (let* ((freedom (r-freedom refining)) (moves (unit-moves freedom))
         (allowed (cuts-radius refining placement)))
    (flet ((try (move way)
             (let* ((new (moved placement move way freedom))
                    (radius (if new (cuts-radius refining new) -1d300)))
               (when (> radius (+ allowed (* 1d-3 (abs allowed))))
                 (setf placement new allowed radius)))))
      (loop with least = (/ step 16)
            while (> step least)
            do (let ((before allowed))
                 (dolist (move moves)
                   (try move step)
                   (try move (- step)))
                 (when (= before allowed) (setf step (/ step 2))))))
    (values placement allowed)))

(defparameter +most-raised+ 40 "How many placements of a lattice are raised at most.")

(defun scan (refining part placement value)
  "Return the best placement, within 1 %, found from a lattice of PART of the way that each finger
has, around PLACEMENT; and its radius.  If that is not above VALUE, the radius of PLACEMENT, return
these two.  Only where the cuts allow more is the radius asked."
  (let* ((near (freedom-near (r-freedom refining) placement part))
         (step (/ (nth-value 1 (widest (freedom-low near) (freedom-high near))) 8))
         (ways (loop for other in (finest-lattice near)
                     collect (cons (cuts-radius refining other) other))))
    (loop repeat +most-raised+
          while (may-ask-p refining)
          do (let ((least (+ (* 1.01d0 (max value 0d0)) 1d-9)))
               (setf ways (most-allowed ways least))
               (when (null ways) (return))
               (multiple-value-bind (other allowed) (raise refining (cdr (pop ways)) step)
                 (when (> allowed least)
                   (let ((radius (radius-at refining other least)))
                     (when (> radius least) (setf placement other value radius)))
                   (allow-less ways refining)))))
    (values placement value)))
