;;;; labels.lisp -- words find a place in a picture: on no other word, on no contact, in the canvas.

(in-package :supergrip-draw)

(defvar *obstacles* '() "Rectangles (x y width height) that no label may touch.")
(defvar *strokes* '() "Pairs of points: lines that labels had better not cross.")
(defvar *labels* '() "Labels that wait for their place, the latest first.")

(defun occupy (rectangle)
  "Keep RECTANGLE clear of labels."
  (push rectangle *obstacles*))

(defun occupy-around (point radius)
  "Keep the place around POINT clear of labels."
  (occupy (list (- (first point) radius) (- (second point) radius) (* 2 radius) (* 2 radius))))

(defun note-strokes (points)
  "Have labels avoid the line through POINTS."
  (loop for (a b) on points while b do (push (list a b) *strokes*)))

(defun overlap-p (r s)
  "True if the rectangles R and S overlap."
  (destructuring-bind (x y width height) r
    (destructuring-bind (u v wide high) s
      (and (< x (+ u wide)) (< u (+ x width)) (< y (+ v high)) (< v (+ y height))))))

(defun within-p (r s)
  "True if the rectangle R lies in S."
  (destructuring-bind (x y width height) r
    (destructuring-bind (u v wide high) s
      (and (>= x u) (>= y v) (<= (+ x width) (+ u wide)) (<= (+ y height) (+ v high))))))

(defun outline-of (rectangle)
  (destructuring-bind (x y width height) rectangle
    (list (list x y) (list (+ x width) y) (list (+ x width) (+ y height)) (list x (+ y height)))))

(defun crossings (rectangle)
  "Return how many of the noted lines cross RECTANGLE."
  (let ((outline (outline-of rectangle)))
    (count-if (lambda (stroke) (inside-part (first stroke) (second stroke) outline)) *strokes*)))

;;; Labels are asked for while a view is drawn, and placed when all of it is known.

(defun ask-for-label (text point &key (class "plain") (away 8) optional leader toward)
  "Have TEXT placed near POINT, AWAY units or more from it, TOWARD a direction in the picture rather
than others.  If it is OPTIONAL it is left out where there is no room close by; a LEADER joins it
to the point if it is far."
  (push (list text point class away optional leader toward) *labels*))

(defparameter +directions+
  (loop for step below 16
        collect (list (cos (* step pi 1/8)) (sin (* step pi 1/8))))
  "Directions in a picture in which a label may stand from its point.")

(defun label-rectangle (text point class direction distance)
  "Return where TEXT stands so that its edge is DISTANCE from POINT in DIRECTION."
  (let* ((width (text-width text class)) (height (* 1.25 (class-size class)))
         (x (+ (first point) (* distance (first direction)) (* 1/2 width (first direction))))
         (y (+ (second point) (* distance (second direction)) (* 1/2 height (second direction)))))
    (list (- x (/ width 2)) (- y (/ height 2)) width height)))

(defun best-place (text point class away area toward reach)
  "Return the best rectangle for TEXT in AREA that touches no obstacle, or NIL."
  (let ((best nil) (least nil))
    (loop for distance from away to reach by 6
          until (and best (< least (* 1.1 (- distance away))))
          do (dolist (direction +directions+)
               (let ((place (label-rectangle text point class direction distance)))
                 (when (and (within-p place area)
                            (notany (lambda (other) (overlap-p place other)) *obstacles*))
                   (let ((cost (+ (* 1.1 (- distance away)) (* 30 (crossings place))
                                  (if toward
                                      (* 12 (- 1 (reduce #'+ (mapcar #'* direction toward))))
                                      0))))
                     (when (or (null least) (< cost least))
                       (setf best place least cost)))))))
    best))

(defun put-label (text place class)
  (destructuring-bind (x y width height) place
    (when (plusp (crossings place))
      (draw-rectangle x y width height "pad"))
    (draw-text text (list (+ x (/ width 2)) (+ y (* 0.76 height))) :class class :anchor :middle)))

(defun nearest-in (point rectangle)
  "Return the point of RECTANGLE that is nearest to POINT."
  (destructuring-bind (x y width height) rectangle
    (list (max x (min (first point) (+ x width))) (max y (min (second point) (+ y height))))))

(defun place-labels (area)
  "Place all labels asked for, in the order in which they were, in the rectangle AREA."
  (loop for (text point class away optional leader toward) in (reverse *labels*)
        do (let* ((text (fitting text class (third area)))
                  (place (best-place text point class away area toward (if optional 30 400))))
             (when place
               (let ((end (nearest-in point place)))
                 (when (and leader (> (distance point end) (+ away 12)))
                   (draw-line point end "thin")))
               (put-label text place class))))
  (setf *labels* '()))
