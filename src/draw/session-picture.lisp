;;;; session-picture.lisp -- DRAW-SESSION: the best grasps of a plan side by side, the paper's
;;;; Figure 4.

(in-package :supergrip-draw)

(defun best-candidates (plan count)
  "Return the COUNT best possible candidates of PLAN, or all if there are fewer."
  (loop for candidate in (plan-possible plan) repeat count collect candidate))

(defun cell-scale (camera subjects width height)
  "Return the scale in which CAMERA sees each of SUBJECTS whole in a cell of WIDTH x HEIGHT."
  (loop for subject in subjects
        minimize (view-scale (fit-view camera (subject-vectors subject)
                                       (cell-room 0 0 width height)))))

(defun cell-room (x y width height)
  "Return the rectangle for box and hand in a cell."
  (list (+ x 28) (+ y 84) (- width 56) (- height 182)))

(defun draw-session-cell (candidate subject place camera scale x y width height)
  "Draw CANDIDATE, the PLACEth best, seen by CAMERA in SCALE, in a cell."
  (draw-text (fitting (format nil "~d  ~a" place (candidate-title candidate)) "bold" (- width 20))
             (list (+ x 12) (+ y 22)) :class "bold")
  (draw-text (fitting (matching-text (candidate-matching candidate)) "soft" (- width 20))
             (list (+ x 12) (+ y 42)) :class "soft")
  (draw-axes camera (list (+ x 40) (+ y height -40)) '("X" "Y" "Z") 24)
  (occupy (list (+ x 2) (+ y height -80) 76 78))
  (draw-scale-bar scale (list (+ x 92) (+ y height -28)))
  (draw-subject subject (fit-view camera (subject-vectors subject) (cell-room x y width height)
                                  scale))
  (place-labels (list (+ x 6) (+ y 50) (- width 12) (- height 52))))

(defun session-picture (plan count)
  "Return the picture of the COUNT best candidates of PLAN, three in a row."
  (let* ((candidates (best-candidates plan count))
         (subjects (loop for candidate in candidates
                         collect (grasp-subject candidate plan)))
         (wide 330) (high 350)
         (columns (max 2 (min 3 (length candidates))))
         (rows (ceiling (length candidates) columns))
         (width (+ 24 (* wide columns))))
    (with-picture (width (+ 122 (* high rows))
                   (format nil "Best grasps, ~a" (box-text (plan-box plan)))
                   (format nil "~:[No grasp is possible.~;~:*~{~a~^ ~}~]"
                           (loop for candidate in candidates
                                 for subject in subjects
                                 collect (candidate-description candidate plan subject))))
      (draw-heading (format nil "~:[No grasp is possible~;The best grasps~]" candidates)
                    (list (format nil "~a. ~a" (box-text (plan-box plan))
                                  (constrained-text (plan-box plan))))
                    width)
      (when candidates
        (let* ((camera (best-camera subjects))
               (scale (cell-scale camera subjects wide (- high 8))))
          (loop for candidate in candidates
                for subject in subjects
                for place from 1
                do (multiple-value-bind (row column) (floor (1- place) columns)
                     (let ((x (+ 12 (* column wide))) (y (+ 72 (* row high))))
                       (draw-rectangle (+ x 3) y (- wide 6) (- high 8) "frame")
                       (draw-session-cell candidate subject place camera scale
                                          x y wide (- high 8)))))))
      (draw-key 24 (+ 72 (* high rows) 18) (- width 48)))))

(defun draw-session (plan file &key (count 3))
  "Draw the COUNT best possible grasps of PLAN side by side, all seen from one place, into FILE, an
SVG picture: for the pencil, the paper's Figure 4.  Returns FILE."
  (drawing ((need-plan plan)) (save-picture (session-picture plan count) file)))
