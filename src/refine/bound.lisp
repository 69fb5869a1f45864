;;;; bound.lisp -- how good a placement can be at most: branch and bound over all legal ones.
;;;;
;;;; A region holds all placements between two.  The power of a finger in a motion is a convex
;;;; function of its place, so it is greatest at a corner of the finger's rectangle; the fingers'
;;;; greatest powers together bound the cut in the region.  A mixture of cuts, in which the size of
;;;; the task is at most 1 too, bounds it as well, and mostly better: what is good for one motion is
;;;; bad for another.  The region with the greatest bound is cut in two, until none is left that may
;;;; hold a placement much better than the best known.  The middle of each gives a new cut, or a
;;;; better placement.

(in-package :supergrip)

(defconstant +mixings+ 15 "How often the mixture of a region is improved.")

(defstruct (region (:copier nil) (:conc-name g-))
  "The placements from LOW to HIGH.  None has a radius above BOUND; WEIGHTS, of the cuts there were
then, the latest first, are those of a mixture that shows it, or NIL."
  (low nil :type doubles) (high nil :type doubles)
  (bound 1d300 :type double-float) (weights nil :type (or null doubles)))

(defun put-corners (refining cut region powers start)
  "Put the powers in CUT of each finger at the four corners of its rectangle in REGION into POWERS
from START, then that of gravity."
  (declare (type refining refining) (type motion-cut cut) (type doubles powers) (fixnum start)
           (optimize speed))
  (let ((low (g-low region)) (high (g-high region)))
    (dotimes (i (r-count refining))
      (declare (type (integer 0 1000) i))
      (let ((normal (svref (r-normals refining) i)) (from (* 3 i)))
        (declare (type (integer 0 2) normal))
        (dotimes (corner 4)
          (flet ((at (axis)
                   (declare (type (integer 0 2) axis))
                   ;; The rectangle has no extent along the normal.
                   (if (logbitp (if (= axis (mod (1+ normal) 3)) 0 1) corner)
                       (aref high (+ from axis))
                       (aref low (+ from axis)))))
            (declare (inline at))
            (setf (aref powers (+ start (* 4 i) corner))
                  (finger-power cut normal (aref (r-signs refining) i)
                                (r-u refining) (r-v refining) (at 0) (at 1) (at 2)))))))
    (setf (aref powers (+ start (* 4 (r-count refining)))) (aref cut 6))))

(defun line-bound (powers start count tops)
  "Return the greatest sum of the line of POWERS from START, for COUNT fingers; put the corners that
it takes, one a finger, into TOPS."
  (declare (type doubles powers) (fixnum start count) (type (simple-array fixnum (*)) tops)
           (optimize speed))
  (let ((sum (aref powers (+ start (* 4 count)))))
    (declare (double-float sum))
    (dotimes (i count sum)
      (declare (type (integer 0 1000) i))
      (let* ((place (* 4 i)) (most (aref powers (+ start place))))
        (declare (fixnum place) (double-float most))
        (setf (aref tops i) place)
        (loop for other of-type fixnum from (1+ place) below (+ place 4)
              when (> (aref powers (+ start other)) most)
                do (setf most (aref powers (+ start other)) (aref tops i) other))
        (incf sum most)))))

(defun put-mixture (powers lines width weights mixture)
  "Put the mixture of the LINES of POWERS, WIDTH numbers each, by WEIGHTS, made to add up to 1, into
MIXTURE."
  (declare (type doubles powers weights mixture) (fixnum lines width) (optimize speed))
  (let ((sum 0d0))
    (declare (double-float sum))
    (dotimes (j lines) (incf sum (aref weights j)))
    (fill mixture 0d0)
    (dotimes (j lines)
      (let ((weight (/ (aref weights j) sum)) (start (* j width)))
        (declare (fixnum start))
        (setf (aref weights j) weight)
        (dotimes (k width)
          (incf (aref mixture k) (* weight (aref powers (+ start k)))))))))

(defun shift-weights (powers lines width weights tops count bound pace)
  "Give the lines of POWERS that are below BOUND where the mixture of WEIGHTS is greatest, at TOPS,
more weight, the others less."
  (declare (type doubles powers weights) (fixnum lines width count)
           (type (simple-array fixnum (*)) tops) (double-float bound pace) (optimize speed))
  (dotimes (j lines)
    (let* ((start (* j width)) (value (aref powers (+ start (* 4 count)))))
      (declare (fixnum start) (double-float value))
      (dotimes (i count)
        (incf value (aref powers (+ start (aref tops i)))))
      (setf (aref weights j)
            (max 1d-9 (* (aref weights j)
                         (exp (max -3d0 (min 3d0 (* pace (- 1d0 (/ value bound))))))))))))

(defun first-weights (lines before best)
  "Return weights for LINES cuts: those of BEFORE, for the older ones, or else the one of the cut
BEST, and a little for all."
  (let ((weights (make-array lines :element-type 'double-float :initial-element (/ 0.3d0 lines))))
    (if before
        (loop for weight across before
              for j from (- lines (length before))
              do (incf (aref weights j) (* 0.7d0 weight)))
        (incf (aref weights best) 0.7d0))
    weights))

(defun bound-region (refining region goal)
  "Find a BOUND for REGION, and a mixture that shows it, that is not above GOAL if possible.
Return the bound."
  (let* ((cuts (r-cuts refining)) (lines (length cuts)) (count (r-count refining))
         (width (1+ (* 4 count))) (best 0)
         (powers (make-array (* lines width) :element-type 'double-float))
         (tops (make-array count :element-type 'fixnum)))
    (loop for cut in cuts
          for j from 0
          do (put-corners refining cut region powers (* j width))
             (let ((bound (line-bound powers (* j width) count tops)))
               (when (< bound (g-bound region))
                 (setf (g-bound region) bound best j))))
    (when (> (g-bound region) goal)
      (let ((weights (first-weights lines (g-weights region) best))
            (mixture (make-array width :element-type 'double-float)))
        (loop repeat +mixings+
              for pace = 4d0 then (* 0.95d0 pace)
              do (put-mixture powers lines width weights mixture)
                 (let ((bound (line-bound mixture 0 count tops)))
                   (when (< bound (g-bound region))
                     (setf (g-bound region) bound (g-weights region) (copy-seq weights)))
                   (when (<= (g-bound region) goal) (return))
                   (shift-weights powers lines width weights tops count bound pace)))))
    (g-bound region)))

;;; Regions

(defun tighten-pair (low high limit)
  "Leave out of the region from LOW to HIGH what LIMIT rules out.  Return NIL if that is all."
  (declare (type doubles low high))
  (let ((most (* (limit-between-most limit) (+ 1d0 1d-9))) (gaps 0d0) (spans 0d0))
    (dotimes (axis 3)
      (unless (eql axis (limit-between-skip limit))
        (let ((p (+ axis (* 3 (limit-between-one limit))))
              (q (+ axis (* 3 (limit-between-two limit)))))
          (setf (aref low p) (max (aref low p) (- (aref low q) most))
                (aref low q) (max (aref low q) (- (aref low p) most))
                (aref high p) (min (aref high p) (+ (aref high q) most))
                (aref high q) (min (aref high q) (+ (aref high p) most)))
          (incf gaps (expt (max 0d0 (- (aref low p) (aref high q)) (- (aref low q) (aref high p)))
                           2))
          (incf spans (expt (max (- (aref high p) (aref low q)) (- (aref high q) (aref low p)))
                            2)))))
    (and (<= gaps (* most most))
         (>= spans (* (- 1d0 1d-9) (expt (limit-between-least limit) 2)))
         (every (lambda (low high) (<= low (+ high (* 1d-9 (+ 1d0 (abs high)))))) low high))))

(defun make-tight-region (low high weights freedom)
  "Return the region from LOW to HIGH without what FREEDOM rules out, or NIL if that is all."
  (and (loop for limit in (freedom-between freedom) always (tighten-pair low high limit))
       (make-region :low low :high high :weights weights)))

(defun halves (region freedom)
  "Return the two halves of REGION, without what FREEDOM rules out: a list of regions."
  (let* ((place (widest (g-low region) (g-high region)))
         (middle (/ (+ (aref (g-low region) place) (aref (g-high region) place)) 2)))
    (loop for half below 2
          for low = (copy-seq (g-low region))
          for high = (copy-seq (g-high region))
          for part = (progn (setf (aref (if (= half 0) high low) place) middle)
                            (make-tight-region low high (g-weights region) freedom))
          when part
            collect part)))

(defun try-middle (refining region placement value goal)
  "Return a better placement than PLACEMENT, with the radius VALUE, found from the middle of REGION,
and its radius; or those two.  GOAL is the radius that is worth asking for."
  (let* ((middle (map 'doubles (lambda (low high) (/ (+ low high) 2))
                      (g-low region) (g-high region)))
         (middle (make-legal middle (r-freedom refining))))
    (when (and middle (may-ask-p refining) (> (cuts-radius refining middle) goal))
      (let ((radius (radius-at refining middle value)))
        (when (> radius value)
          (multiple-value-bind (other radius) (climb-surely refining middle radius)
            (when (> radius value) (setf placement other value radius))))))
    (values placement value)))

(defun branch-and-bound (refining placement value gap most-regions)
  "Return the best placement known, at first PLACEMENT, with the radius VALUE; its radius; and a
radius that no legal placement exceeds, at most GAP above it unless MOST-REGIONS are not enough for
that."
  (let* ((freedom (r-freedom refining)) (dropped value) (seen 1)
         (root (make-tight-region (copy-seq (freedom-low freedom)) (copy-seq (freedom-high freedom))
                                  nil freedom))
         (queue '()))
    (flet ((goal () (max 0d0 (* value (+ 1d0 gap)))))
      (labels ((sort-in (region least)
                 (bound-region refining region (goal))
                 (setf (g-bound region) (min least (g-bound region)))
                 (if (> (g-bound region) (goal))
                     (setf queue (merge 'list queue (list region) #'> :key #'g-bound))
                     (setf dropped (max dropped (g-bound region))))))
        (when root (sort-in root 1d300))
        (loop while (and queue (> (g-bound (first queue)) (goal)) (< seen most-regions))
              do (let ((region (pop queue)))
                   (multiple-value-setq (placement value)
                     (try-middle refining region placement value (goal)))
                   (dolist (half (halves region freedom))
                     (incf seen)
                     (sort-in half (g-bound region)))))))
    (values placement value (max dropped value (if queue (g-bound (first queue)) 0d0)))))
