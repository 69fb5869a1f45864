;;;; section-picture.lisp -- DRAW-SECTION: what the contacts of the best grasp can really do, beside
;;;; what the index takes for it, in one plane.
;;;;
;;;; The plane is that of the two forces or torques that count most where the grasp has the least to
;;;; spare.  Each is measured in what the task needs of it, so the task is a circle of radius 1.

(in-package :supergrip-draw)

(defparameter +section-points+ 360 "How many points the outline of a section has.")

(defun section-axes (motion need)
  "Return the two axes, 0 to 5, that count most in MOTION, the worst one of the task NEED: axes that
are needed before others."
  (let ((shares (direction-shares motion need)))
    (sort (subseq (sort (list 0 1 2 3 4 5) #'>
                        :key (lambda (axis)
                               (if (plusp (nth axis need)) (1+ (abs (nth axis shares))) 0)))
                  0 2)
          #'<)))

(defun circle-points (width height)
  "Return points of the ellipse around 0 0 that reaches WIDTH to each side and HEIGHT up and down."
  (loop for step below +section-points+
        for angle = (/ (* 2 pi step) +section-points+)
        collect (list (* width (cos angle)) (* height (sin angle)))))

(defun greatest-multiple (true-p)
  "Return the greatest number for which TRUE-P is true, as it is from 0 up to that number."
  (let ((low 0d0) (high 1d0))
    (loop while (funcall true-p high)
          do (setf low high
                   high (* 2 high)))
    (loop repeat 16
          do (let ((middle (/ (+ low high) 2)))
               (if (funcall true-p middle)
                   (setf low middle)
                   (setf high middle))))
    low))

(defun section-points (candidate plan axes)
  "Return the outline of what CANDIDATE of PLAN can do beside the weight in the plane of two AXES,
no other force or torque being exerted: points in units of what the task needs."
  (let* ((box (plan-box plan))
         (contacts (loop for contact in (candidate-contacts candidate plan)
                         collect (list (getf contact :position) (getf contact :normal))))
         (scales (mapcar (lambda (axis) (need-or-one (nth axis (box-force-needed box)))) axes)))
    (flet ((held-p (number x y)
             (let ((load (box-gravity box)))
               (loop for axis in axes
                     for scale in scales
                     for part in (list x y)
                     do (decf (nth axis load) (* number scale part)))
               (holds-p contacts (box-friction box) (box-soft-friction box) load))))
      (loop for (x y) in (circle-points 1 1)
            for number = (greatest-multiple (lambda (number) (held-p number x y)))
            collect (list (* number x) (* number y))))))

(defun need-or-one (need) (if (plusp need) need 1))

(defun index-ratios (candidate plan axes)
  "Return how many times the need CANDIDATE has, as the index sees it, on each of AXES."
  (loop with rows = (force-rows candidate plan)
        for axis in axes
        collect (destructuring-bind (have need) (nth axis rows) (/ have (need-or-one need)))))

;;; The picture

(defun section-signs (strength)
  "Return what the picture shows for STRENGTH: lists of class, number and text."
  (remove nil
          `(("need" "1" "what the task needs, in every direction")
            ,(and (strength-u-w strength)
                  `("hidden" ,(index-text (strength-u-w strength))
                             "u_w, the paper’s index. It looks at one axis at a time, and takes ~
                              the dashed line for what the grasp can do."))
            ("ring" ,(true-radius-text strength)
                    "the true radius, on all axes together. In this plane, the contacts can ~
                     really do what is filled.")
            ,(and (strength-sure strength)
                  `("dots" ,(sure-text strength)
                           "what is sure from the strength on each axis alone")))))

(defun draw-signs (signs x y width)
  "Draw the key of SIGNS, lists of class, number and text, from X Y, WIDTH wide."
  (loop for (class number text) in signs
        do (draw-line (list x (- y 4)) (list (+ x 34) (- y 4)) class)
           (draw-text number (list (+ x 46) y) :class "bold")
           (loop for line in (filled (format nil text) "plain" (- width 46))
                 do (incf y 19)
                    (draw-text line (list (+ x 46) y)))
           (incf y 32))
  y)

(defparameter +most-needs+ 4 "How many needs, or true radii if they are more, are shown each way.")

(defun cut-off (points reach)
  "Return POINTS of an outline around 0 0, those that are farther than REACH along an axis moved to
there, straight towards 0 0."
  (loop for (x y) in points
        for part = (min 1 (/ reach (max (abs x) (abs y))))
        collect (list (* part x) (* part y))))

(defun fit-points (points area)
  "Return a function that maps a point, y upward, into AREA so that all POINTS are in it, in one
scale."
  (destructuring-bind (x y width height) area
    (destructuring-bind (left low wide high) (bounds points)
      (let ((unit (min (/ width wide) (/ height high))))
        (lambda (point)
          (list (+ x (/ (- width (* unit wide)) 2) (* unit (- (first point) left)))
                (- (+ y (/ (+ height (* unit high)) 2)) (* unit (- (second point) low)))))))))

(defun draw-section-plot (strength plan axes area)
  "Draw the section of STRENGTH of PLAN in the plane of AXES into AREA."
  (let* ((candidate (strength-candidate strength))
         (reach (section-reach strength))
         (section (cut-off (section-points candidate plan axes) reach))
         (index (and (strength-u-w strength)
                     (cut-off (apply #'circle-points (index-ratios candidate plan axes)) reach)))
         (task (circle-points 1 1))
         (place (fit-points (append section index task) area)))
    (flet ((outline (points class) (draw-polygon (mapcar place points) class))
           (axis (from to)
             (draw-line (funcall place from) (funcall place to) "frame")))
      (outline section "have")
      (destructuring-bind (left low wide high) (bounds (append section index task))
        (axis (list left 0) (list (+ left wide) 0))
        (axis (list 0 low) (list 0 (+ low high))))
      (when index (outline index "hidden"))
      (outline task "need")
      (loop for (radius class) in `((,(shown-radius strength) "ring")
                                    (,(strength-sure strength) "dots"))
            when (and radius (plusp radius))
              do (outline (circle-points radius radius) class)))))

(defun axis-words (axis)
  (format nil "~:[torque~;force~] ~a" (< axis 3) (nth axis +axis-names+)))

(defun section-reach (strength)
  "Return how far the section of STRENGTH is shown, in needs."
  (* +most-needs+ (max 1 (shown-radius strength))))

(defun section-heading (strength plan axes)
  "Return the lines below the heading of the section of STRENGTH of PLAN in the plane of AXES."
  (list (format nil "~a: ~a." (box-text (plan-box plan))
                (candidate-title (strength-candidate strength)))
        (format nil "To the right: ~a; up: ~a." (axis-words (first axes))
                (axis-words (second axes)))
        (format nil "Both in units of what the task needs, up to ~a; the weight is borne as well."
                (quantity (section-reach strength)))))

(defun draw-section-of (strength plan width)
  "Draw the section of STRENGTH of PLAN, with its heading and its signs, WIDTH wide."
  (let ((axes (section-axes (strength-motion strength) (box-force-needed (plan-box plan)))))
    (draw-heading "What the contacts can do, and what the index takes for it"
                  (section-heading strength plan axes) width)
    (draw-section-plot strength plan axes '(24 112 456 430))
    (let ((y (draw-signs (section-signs strength) 510 132 (- width 534))))
      (loop for line in (filled (format nil "The least to spare: ~a." (strength-worst strength))
                                "plain" (- width 534))
            for below from y by 19
            do (draw-text line (list 510 below))))))

(defun section-picture (plan)
  "Return the picture of what the best grasp of PLAN can do in the plane where it is weakest."
  (let* ((best (plan-best plan))
         (strength (and best (find-strength best plan)))
         (nothing (cond ((null best) "No grasp is possible")
                        ((null (strength-upper strength)) "The task needs no force")))
         (width 900))
    (with-picture (width (if nothing 80 560)
                         (format nil "What the contacts can do, ~a" (box-text (plan-box plan)))
                         (if nothing (format nil "~a." nothing) (strength-words strength)))
      (if nothing
          (draw-heading nothing (list (box-text (plan-box plan))) width)
          (draw-section-of strength plan width)))))

(defun draw-section (plan file)
  "Draw what the contacts of the best grasp of PLAN can do beside the weight, what the index takes
for it, and what the task needs, into FILE, an SVG picture.  Returns FILE.

It is a section: the plane of the two forces or torques that count most where the grasp has the
least to spare, every other one being 0.  The radii in words are those on all axes together."
  (drawing ((need-plan plan)) (save-picture (section-picture plan) file)))
