;;;; quality-picture.lisp -- DRAW-QUALITY: what the best candidates have, and what the task needs.

(in-package :supergrip-draw)

(defparameter +axis-names+ '("along X" "along Y" "along Z" "about X" "about Y" "about Z"))

(defun velocity-rows (candidate plan)
  "Return (have need) on each axis for velocities: the offset's effect added."
  (mapcar #'list (candidate-twist candidate plan) (candidate-velocity-need candidate plan)))

(defun greatest-of (function candidates plan)
  "Return the greatest number in the rows that FUNCTION makes of CANDIDATES of PLAN."
  (loop for candidate in candidates
        maximize (reduce #'max (mapcar (lambda (row) (apply #'max row))
                                       (funcall function candidate plan)))))

(defun draw-rows (rows limit most x y width &key (measure (constantly nil)))
  "Draw one row for each axis: a bar for what there is, a thick mark for what is needed, and their
ratio; MEASURE, a function of an axis, says what the numbers there measure; LIMIT is the name of
the limiting axis, MOST the number at the end of the scale.  Returns the y below."
  (let* ((most (max most 1d-9))
         (left (+ x 66)) (room (- width 66 156)))
    (flet ((x-of (number) (+ left (* room (/ (max 0 number) most)))))
      (loop for (have need) in rows
            for name in +axis-names+
            for axis from 0
            for top from y by 24
            for limiting = (equal name limit)
            do (draw-text name (list x (+ top 14)) :class (if limiting "bold" "plain"))
               (draw-rectangle left (+ top 3) (max 0.5 (- (x-of have) left)) 13 "have")
               (when (plusp need)
                 (draw-line (list (x-of need) top) (list (x-of need) (+ top 19)) "need"))
               (draw-text (ratio-text (in-units have (funcall measure axis))
                                      (in-units need (funcall measure axis)) limiting)
                          (list (+ left room 10) (+ top 14)) :class (if limiting "bold" "soft"))))
    (+ y (* 6 24))))

(defun ratio-number (number)
  (if (< 1d-2 (abs number) 100) (decimal number 3) (quantity number 3)))

(defun ratio-text (have need limiting)
  "Return HAVE, NEED and their ratio; the ratio alone where all of it is too long for its place."
  (if (zerop need)
      "not needed"
      (let* ((ratio (ratio-number (/ have need)))
             (all (format nil "~a / ~a = ~a" (quantity have 4) (quantity need 4) ratio)))
        (format nil "~a~:[~; ◀~]" (if (> (length all) 21) (format nil "ratio ~a" ratio) all)
                limiting))))

(defun draw-candidate-quality (strength strengths plan place x y width)
  "Draw the bars of the candidate of STRENGTH, the PLACEth best, in the scale of all STRENGTHS."
  (let ((candidate (strength-candidate strength))
        (candidates (mapcar #'strength-candidate strengths)))
    (draw-text (fitting (format nil "~d  ~a" place (candidate-title candidate)) "bold" width)
               (list x (+ y 16)) :class "bold")
    (draw-text (fitting (matching-text (candidate-matching candidate)) "soft" width)
               (list x (+ y 35)) :class "soft")
    (draw-text (force-text "Forces" candidate plan) (list x (+ y 66)))
    (let ((below (draw-rows (force-rows candidate plan) (candidate-force-axis candidate)
                            (greatest-of #'force-rows candidates plan) x (+ y 76) width
                            :measure #'axis-measure)))
      (when (strength-upper strength)
        (draw-strength strength (greatest-radius strengths) x (+ below 6) width))
      (incf below (strengths-height strengths width))
      (draw-text (radius-text "Velocities, u_t" (candidate-velocity-radius candidate)
                              (candidate-velocity-axis candidate))
                 (list x (+ below 26)))
      (draw-rows (velocity-rows candidate plan) (candidate-velocity-axis candidate)
                 (greatest-of #'velocity-rows candidates plan) x (+ below 36) width))))

(defun quality-height (strengths width)
  "Return how high the bars of one of STRENGTHS are, WIDTH wide."
  (+ 416 (strengths-height strengths width)))

(defun radius-text (name radius axis)
  (if radius
      (format nil "~a = ~a, limited ~a" name (index-text radius) axis)
      (format nil "~a: none needed" name)))

(defun force-text (kind candidate plan)
  "Return the radius of forces, called KIND, of CANDIDATE, and what radius PLAN takes for it."
  (let ((name (format nil "~a, ~:[u_w~;exact radius~]" kind (eq (plan-index plan) :exact))))
    (if (candidate-bound-p candidate)
        (format nil "~a ≤ ~a" name (index-text (candidate-force-radius candidate)))
        (radius-text name (candidate-force-radius candidate) (candidate-force-axis candidate)))))

(defun quality-words (strength plan)
  "Return what the bars of STRENGTH of PLAN show, for those who can't see them."
  (let ((candidate (strength-candidate strength)))
    (format nil "~a: ~a; ~a.~@[ ~a~]" (candidate-title candidate)
            (force-text "forces" candidate plan)
            (radius-text "velocities, u_t" (candidate-velocity-radius candidate)
                         (candidate-velocity-axis candidate))
            (strength-words strength))))

(defun quality-picture (plan count)
  "Return the picture of what the COUNT best candidates of PLAN have against what is needed."
  (let* ((strengths (find-strengths plan count))
         (wide 380) (high (+ 10 (quality-height strengths (- wide 30))))
         (columns (max 2 (min 3 (length strengths))))
         (rows (max 1 (ceiling (length strengths) columns)))
         (width (max 860 (+ 24 (* wide columns)))))
    (with-picture (width (+ 104 (* high rows) (key-height +quality-key+ (- width 48)))
                   (format nil "Have against need, ~a" (box-text (plan-box plan)))
                   (format nil "~:[No grasp is possible.~;~:*~{~a~^ ~}~]"
                           (loop for strength in strengths
                                 collect (quality-words strength plan))))
      (draw-heading (if strengths "What each grasp has, against what the task needs"
                        "No grasp is possible")
                    (list (format nil "~a. Forces in ~a, torques in ~a, gamma ~a."
                                  (box-text (plan-box plan)) (unit-phrase :force)
                                  (or (unit-text-of :torque) "finger force × cm")
                                  (quantity (plan-gamma plan))))
                    width)
      (loop for strength in strengths
            for place from 1
            do (multiple-value-bind (row column) (floor (1- place) columns)
                 (draw-candidate-quality strength strengths plan place (+ 24 (* column wide))
                                         (+ 76 (* row high)) (- wide 30))))
      (draw-key 24 (+ 82 (* high rows)) (- width 48) :signs +quality-key+))))

(defun draw-quality (plan file &key (count 3))
  "Draw, for the COUNT best candidates of PLAN, what they have against what the task needs on all
twelve axes, the limiting ones marked, into FILE, an SVG picture.  Returns FILE."
  (drawing ((need-plan plan)) (save-picture (quality-picture plan count) file)))
