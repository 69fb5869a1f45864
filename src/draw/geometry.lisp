;;;; geometry.lisp -- vectors, faces of a box, cameras, and outlines in the plane.
;;;;
;;;; A vector is a list of three doubles along X Y Z, in cm.  A point of a picture is a list of two
;;;; numbers, x to the right and y down, in the picture's units.

(in-package :supergrip-draw)

(defun v+ (&rest vectors) "Return the sum of VECTORS." (apply #'mapcar #'+ vectors))
(defun v- (a b) "Return the vector from B to A." (mapcar #'- a b))
(defun v* (number vector) "Return VECTOR times NUMBER." (mapcar (lambda (x) (* number x)) vector))
(defun dot (a b) "Return the inner product of A and B." (reduce #'+ (mapcar #'* a b)))
(defun distance (a b)
  "Return the distance of A and B, of any dimension."
  (sqrt (reduce #'+ (mapcar (lambda (x y) (expt (- x y) 2)) a b))))
(defun middle (points)
  "Return the mean of POINTS, of any dimension."
  (mapcar (lambda (sum) (/ sum (length points))) (apply #'mapcar #'+ points)))

(defun axis-vector (axis &optional (length 1d0))
  "Return the vector of LENGTH along AXIS: 0, 1 or 2."
  (loop for i below 3 collect (if (= i axis) (* 1d0 length) 0d0)))

(defun with-part (vector axis value)
  "Return VECTOR with VALUE along AXIS."
  (loop for i below 3 for part in vector collect (if (= i axis) value part)))

;;; Faces and boxes

(defun face-normal (face)
  "Return the outward normal of FACE, 0 to 5 (see FACE-INDEX)."
  (axis-vector (face-axis face) (face-sign face)))

(defun face-corners (face low high)
  "Return the four corners of FACE of the box from LOW to HIGH, in a round."
  (let* ((axis (face-axis face))
         (i (mod (+ axis 1) 3))
         (j (mod (+ axis 2) 3))
         (level (nth axis (if (plusp (face-sign face)) high low))))
    (loop for (a b) in '((nil nil) (t nil) (t t) (nil t))
          collect (with-part (with-part (axis-vector axis level) i (nth i (if a high low)))
                    j (nth j (if b high low))))))

(defun box-corners (low high)
  "Return the eight corners of the box from LOW to HIGH."
  (append (face-corners 0 low high) (face-corners 1 low high)))

;;; Cameras: parallel projection

(defstruct camera
  "Where a picture is seen from, infinitely far away: three unit vectors to the right, up, and
TOWARD the viewer.  AZIMUTH and ELEVATION, in degrees, are those of the viewer over the face TOP."
  right up toward azimuth elevation (top 1))

(defun frame-over (top)
  "Return three unit vectors, right-handed, the third of which is the normal of the face TOP: X Y Z
for Z1."
  (let* ((axis (face-axis top))
         (i (axis-vector (mod (+ axis 1) 3)))
         (j (axis-vector (mod (+ axis 2) 3))))
    (if (plusp (face-sign top))
        (list i j (face-normal top))
        (list j i (face-normal top)))))

(defun camera-at (azimuth elevation &optional (top 1))
  "Return the camera that sees from AZIMUTH and ELEVATION, in degrees, the face TOP being above.
Over Z1 azimuth runs from X to Y (see FRAME-OVER)."
  (let* ((a (* azimuth (/ pi 180))) (e (* elevation (/ pi 180)))
         (sin-a (sin a)) (cos-a (cos a)) (sin-e (sin e)) (cos-e (cos e))
         (frame (frame-over top)))
    (flet ((vector-of (&rest parts) (apply #'v+ (mapcar #'v* parts frame))))
      (make-camera :azimuth azimuth :elevation elevation :top top
                   :right (vector-of (- sin-a) cos-a 0)
                   :up (vector-of (- (* sin-e cos-a)) (- (* sin-e sin-a)) cos-e)
                   :toward (vector-of (* cos-e cos-a) (* cos-e sin-a) sin-e)))))

(defun facing (normal camera)
  "Return 1 if a face of NORMAL is turned to CAMERA, -1 if away, 0 if it is seen edge-on."
  (let ((cosine (dot normal (camera-toward camera))))
    (cond ((> cosine 1d-6) 1) ((< cosine -1d-6) -1) (t 0))))

(defstruct view
  "A CAMERA and its place in a picture: SCALE units a cm, and ORIGIN, the point of the box centre."
  camera (scale 1d0) (origin '(0d0 0d0)))

(defun project (view vector)
  "Return the point of VIEW at which VECTOR is seen."
  (let ((camera (view-camera view)))
    (list (+ (first (view-origin view)) (* (view-scale view) (dot vector (camera-right camera))))
          (- (second (view-origin view)) (* (view-scale view) (dot vector (camera-up camera)))))))

(defun bounds (points)
  "Return the rectangle (x y width height) around POINTS."
  (let ((xs (mapcar #'first points)) (ys (mapcar #'second points)))
    (list (reduce #'min xs) (reduce #'min ys)
          (- (reduce #'max xs) (reduce #'min xs)) (- (reduce #'max ys) (reduce #'min ys)))))

(defun fit-view (camera vectors rectangle &optional scale)
  "Return the view in which CAMERA sees VECTORS in the middle of RECTANGLE, as large as they fit in,
or in SCALE."
  (destructuring-bind (x y width height) rectangle
    (destructuring-bind (left top wide high)
        (bounds (mapcar (lambda (vector) (project (make-view :camera camera) vector)) vectors))
      (let ((scale (or scale (min (/ width (max wide 1d-6)) (/ height (max high 1d-6))))))
        (make-view :camera camera :scale scale
                   :origin (list (- (+ x (/ width 2)) (* scale (+ left (/ wide 2))))
                                 (- (+ y (/ height 2)) (* scale (+ top (/ high 2))))))))))

;;; Outlines

(defun turn (a b c)
  "Return a number above 0 if the points A B C turn one way, below 0 if the other."
  (- (* (- (first b) (first a)) (- (second c) (second a)))
     (* (- (second b) (second a)) (- (first c) (first a)))))

(defun hull (points)
  "Return the convex hull of POINTS, in a round (Andrew's monotone chain)."
  (let ((sorted (sort (copy-list points) (lambda (a b)
                                           (if (= (first a) (first b))
                                               (< (second a) (second b))
                                               (< (first a) (first b)))))))
    (flet ((chain (points)
             (let ((chain '()))
               (dolist (point points (rest chain))
                 (loop while (and (rest chain) (<= (turn (second chain) (first chain) point) 0))
                       do (pop chain))
                 (push point chain)))))
      (append (reverse (chain sorted)) (reverse (chain (reverse sorted)))))))

(defun along (a b part)
  "Return the point that is PART, 0 to 1, of the way from A to B."
  (mapcar (lambda (p q) (+ p (* part (- q p)))) a b))

(defun inside-part (a b outline)
  "Return the part of the segment from A to B that lies inside OUTLINE, convex: two numbers from 0
to 1, or NIL if none does."
  (let ((from 0d0) (to 1d0))
    (loop for (p . rest) on outline
          for q = (or (first rest) (first outline))
          for at-a = (turn p q a)
          for at-b = (turn p q b)
          do (cond ((and (<= at-a 0) (<= at-b 0)) (return-from inside-part nil))
                   ((< at-a 0) (setf from (max from (/ at-a (- at-a at-b)))))
                   ((< at-b 0) (setf to (min to (/ at-a (- at-a at-b)))))))
    (and (< from to) (values from to))))
