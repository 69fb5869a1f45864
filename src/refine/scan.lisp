;;;; scan.lisp -- all placements of a lattice, most of which the cuts rule out unasked.

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
  "Return the legal placements of FREEDOM in which each finger stands on a lattice of COUNT by COUNT; NIL
if there are too many."
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

(defun scan (refining placement value)
  "Return the best placement on a lattice, within 1 %, and its radius, if that is above VALUE, the radius of
PLACEMENT; else those two.  Only where the cuts allow more than VALUE is the radius asked."
  (let ((ways (loop for other in (finest-lattice (r-freedom refining))
                    collect (cons (cuts-radius refining other) other))))
    (loop
      (let ((least (+ (* 1.01d0 (max value 0d0)) 1d-9)))
        (multiple-value-bind (other radius) (first-above refining ways least 40)
          (if other
              (setf placement other value radius)
              (return (values placement value))))))))
