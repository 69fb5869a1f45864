;;;; session-picture.lisp -- DRAW-SESSION: the best grasps of a plan side by side, the paper's
;;;; Figure 4.

(in-package :supergrip-draw)

(defun best-candidates (plan count)
  "Return the COUNT best possible candidates of PLAN, or all if there are fewer."
  (loop for candidate in (plan-possible plan) repeat count collect candidate))

(defun draw-session-cell (candidate subject place camera x y width height)
  "Draw CANDIDATE, the PLACEth best, seen by CAMERA, in a cell."
  (draw-text (fitting (format nil "~d  ~a" place (candidate-title candidate)) "bold" (- width 20))
             (list (+ x 12) (+ y 22)) :class "bold")
  (draw-text (fitting (matching-text (candidate-matching candidate)) "soft" (- width 20))
             (list (+ x 12) (+ y 42)) :class "soft")
  (let ((view (fit-view camera (subject-vectors subject)
                        (list (+ x 34) (+ y 80) (- width 68) (- height 134)))))
    (draw-axes camera (list (+ x 40) (+ y height -34)) '("X" "Y" "Z") 24)
    (occupy (list (+ x 2) (+ y height -74) 76 72))
    (draw-scale-bar (view-scale view) (list (+ x 92) (+ y height -28)))
    (draw-subject subject view)
    (place-labels (list (+ x 6) (+ y 50) (- width 12) (- height 52)))))

(defun session-picture (plan count)
  "Return the picture of the COUNT best candidates of PLAN."
  (let* ((candidates (best-candidates plan count))
         (subjects (loop for candidate in candidates
                         collect (grasp-subject candidate plan)))
         (wide 400) (high 400)
         (width (max 500 (+ 24 (* wide (length candidates))))))
    (with-picture (width (+ 122 high)
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
        (let ((camera (best-camera subjects)))
          (loop for candidate in candidates
                for subject in subjects
                for place from 1
                for x from 12 by wide
                do (draw-rectangle (+ x 3) 72 (- wide 6) high "frame")
                   (draw-session-cell candidate subject place camera x 72 wide high))))
      (draw-key 24 (+ 72 high 26) (- width 48)))))

(defun draw-session (plan file &key (count 3))
  "Draw the COUNT best possible grasps of PLAN side by side, all seen from one place, into FILE, an
SVG picture: for the pencil, the paper's Figure 4.  Returns FILE."
  (drawing (plan) (save-picture (session-picture plan count) file)))
