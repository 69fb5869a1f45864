;;;; labels.lisp -- words find a place in a picture: on no other word, on no contact, in the canvas.

(in-package :supergrip-draw)

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

(defun grown (rectangle more)
  "Return RECTANGLE with MORE on each side."
  (destructuring-bind (x y width height) rectangle
    (list (- x more) (- y more) (+ width (* 2 more)) (+ height (* 2 more)))))

(defun segment-meets-p (a b rectangle &optional (margin 0))
  "True if the line from A to B meets RECTANGLE with MARGIN on each side."
  (destructuring-bind ((p q) (r s)) (list a b)
    (destructuring-bind (x y width height) rectangle
      ;; Most lines are wholly on one side.
      (and (not (and (< p (- x margin)) (< r (- x margin))))
           (not (and (< q (- y margin)) (< s (- y margin))))
           (not (and (> p (+ x width margin)) (> r (+ x width margin))))
           (not (and (> q (+ y height margin)) (> s (+ y height margin))))
           (inside-part a b (outline-of (grown rectangle margin)))))))

(defun crossings (rectangle &optional (strokes *strokes*))
  "Return how many of STROKES cross RECTANGLE."
  (loop for (a b half) in strokes
        count (segment-meets-p a b rectangle (1+ half))))

(defun outlines-meet-p (outline other)
  "True if two convex outlines have a point in common."
  (flet ((meet-p (one two)
           (loop for (a b) on (append one (list (first one)))
                 while b thereis (inside-part a b two))))
    (or (meet-p outline other) (meet-p other outline))))

(defun free-p (rectangle)
  "True if RECTANGLE touches nothing that is to be kept clear."
  (and (notany (lambda (other) (overlap-p rectangle other)) *obstacles*)
       (zerop (crossings rectangle *leaders*))
       (notany (lambda (area) (and (overlap-p rectangle (bounds area))
                                   (outlines-meet-p (outline-of rectangle) area)))
               *areas*)))

;;; Labels are asked for while a view is drawn, and placed when all of it is known.

(defun ask-for-label (text point &key (class "plain") (away 8) optional leader toward)
  "Have TEXT placed near POINT, or near one of a list of points, AWAY units or more from it, TOWARD
a direction in the picture rather than others.  If it is OPTIONAL it is left out where there is no
room close by; a LEADER joins it to the point if it is far."
  (push (list text (if (consp (first point)) point (list point))
              class away optional leader toward)
        *labels*))

(defparameter +directions+
  (loop for step below 24
        collect (list (cos (* step pi 1/12)) (sin (* step pi 1/12))))
  "Directions in a picture in which a label may stand from its point.")

(defun label-rectangle (text point class direction distance)
  "Return where TEXT stands so that its edge is DISTANCE from POINT in DIRECTION."
  (let* ((width (text-width text class)) (height (* 1.25 (class-size class)))
         (x (+ (first point) (* distance (first direction)) (* 0.5d0 width (first direction))))
         (y (+ (second point) (* distance (second direction)) (* 0.5d0 height (second direction)))))
    (list (- x (/ width 2)) (- y (/ height 2)) width height)))

(defun nearest-in (point rectangle)
  "Return the point of RECTANGLE that is nearest to POINT."
  (destructuring-bind (x y width height) rectangle
    (list (max x (min (first point) (+ x width))) (max y (min (second point) (+ y height))))))

(defun leader-of (point place away)
  "Return the line from POINT to a label at PLACE, or NIL if the label is so near that it needs
none."
  (let ((end (nearest-in point place)))
    (and (> (distance point end) (+ away 8))
         (list (along point end (/ 3 (distance point end))) end))))

(defun leader-cost (line)
  "Return the cost of the leader LINE, or NIL if it would cut a word."
  (destructuring-bind (a b) line
    (unless (some (lambda (word) (segment-meets-p a b word 2)) *words*)
      (+ 10
         (* 60 (loop for (p q) in *leaders* count (segments-cross-p a b p q)))
         (* 8 (loop for (p q) in *strokes* count (segments-cross-p a b p q)))
         (* 25 (loop for area in *areas* count (inside-part a b area)))))))

(defun segments-cross-p (a b p q)
  "True if the segments from A to B and from P to Q cross."
  (and (minusp (* (turn a b p) (turn a b q)))
       (minusp (* (turn p q a) (turn p q b)))))

(defun place-cost (place point away distance direction toward leader)
  "Return the cost of PLACE for a label of POINT, or NIL if it can't stand there."
  (let* ((line (and leader (leader-of point place away)))
         (more (if line (leader-cost line) 0)))
    (and more
         (+ (* 1.1 (- distance away)) more (* 400 (crossings place))
            (if toward
                (* 12 (- 1 (reduce #'+ (mapcar #'* direction toward))))
                0)))))

(defun best-place (label area)
  "Return the best rectangle for LABEL in AREA and the point that it is near, or NIL if it can stand
nowhere."
  (destructuring-bind (text points class away optional leader toward) label
    (let ((best nil) (least nil) (reach (cond (optional 30) (leader 260) (t 120))))
      (loop for distance from away to reach by 5
            until (and best (< least (* 1.1 (- distance away))))
            do (dolist (point points)
                 (dolist (direction +directions+)
                   (let ((place (label-rectangle text point class direction distance)))
                     (when (and (within-p place area) (free-p place))
                       (let ((cost (place-cost place point away distance direction toward
                                               leader)))
                         (when (and cost (or (null least) (< cost least)))
                           (setf best (list place point) least cost))))))))
      ;; A word that a line would strike through is left out, but for the names of the fingers.
      (and best (or (< least 400) (string= class "bold")) (values-list best)))))

(defun put-label (text place class)
  (destructuring-bind (x y width height) place
    (draw-text text (list (+ x (/ width 2)) (+ y (* 0.76 height))) :class class :anchor :middle)))

(defun place-label (label area)
  "Place LABEL in AREA, or leave it out if there is no room."
  (destructuring-bind (text points class away optional leader toward) label
    (declare (ignore points optional toward))
    (multiple-value-bind (place point) (best-place label area)
      (when place
        (let ((line (and leader (leader-of point place away))))
          (when line
            (draw-line (first line) (second line) "thin")
            (push (append line '(0.5d0)) *leaders*)))
        (put-label text place class)))))

(defun label-weight (label)
  (destructuring-bind (text points class &rest rest) label
    (declare (ignore points rest))
    (+ (text-width text class) (if (string= class "bold") 1000 0))))

(defun place-labels (area)
  "Place all labels asked for in the rectangle AREA: bold ones first, and then the widest."
  (loop for (text . rest) in (stable-sort (reverse *labels*) #'> :key #'label-weight)
        do (place-label (cons (fitting text (second rest) (third area)) rest) area))
  (setf *labels* '() *areas* '() *strokes* '() *leaders* '()))
