;;;; study-picture.lisp -- the picture of docs/study.md; t/study.lisp loads it where cl-who is.

(in-package :supergrip-test)

(defun draw-way-bars (ways x y width)
  "Draw for each of WAYS the mean part of the best exact Q, and how long a box takes."
  (let* ((parts (way-parts ways)) (left (+ x 190)) (scale (/ (- width 190 110) 1.2)))
    (supergrip-draw::draw-text "Exact Q, as a part of the best without moving fingers"
                               (list x y) :class "bold")
    (loop for way in ways
          for numbers in parts
          for mean = (/ (reduce #'+ numbers) (length numbers))
          for top from (+ y 18) by 34
          do (supergrip-draw::draw-text (way-name way) (list x (+ top 14)))
             (supergrip-draw::draw-rectangle left (+ top 2) (* scale mean) 14 "have")
             (supergrip-draw::draw-text (format nil "~,3f; ~a" mean (ms-text (way-time way)))
                                        (list (+ left (* scale (max 1 mean)) 8) (+ top 14))
                                        :class "soft"))
    (supergrip-draw::draw-line (list (+ left scale) (+ y 12)) (list (+ left scale) (+ y 186))
                               "hidden")))

(defun ms-text (ms)
  (cond ((< ms 1) (format nil "~d µs" (round (* 1000 ms))))
        ((< ms 10) (format nil "~,1f ms" ms))
        (t (format nil "~d ms" (round ms)))))

(defun sorted-points (numbers most x y width height)
  "Return the points of the sorted NUMBERS, from 1 at the bottom to MOST at the top."
  (let* ((sorted (sort (copy-list numbers) #'<)) (count (max 1 (1- (length sorted)))))
    (loop for number in sorted
          for place from 0
          collect (list (+ x (* width (/ place count)))
                        (- (+ y height) (* height (/ (- (min most number) 1) (- most 1))))))))

(defun draw-gain-curves (refinements x y width height)
  "Draw, grasp by grasp in order, by how much Q grew, and how much it could have grown at most."
  (let ((most 2d0) (left (+ x 46)) (room (- width 46)))
    (supergrip-draw::draw-text "Q of a refined grasp, as a part of its exact Q before"
                               (list x y) :class "bold")
    (loop for level in '(1 1.25d0 1.5d0 1.75d0 2)
          for line = (- (+ y 24 height) (* height (/ (- level 1) (- most 1))))
          do (supergrip-draw::draw-line (list left line) (list (+ left room) line) "frame")
             (supergrip-draw::draw-text (format nil "~,2f" level) (list (- left 8) (+ line 4))
                                        :class "soft" :anchor :end))
    (flet ((curve (reader class)
             (supergrip-draw::draw-path
              (sorted-points (loop for r in refinements
                                   for before = (supergrip:refinement-quality-before r)
                                   when (plusp before) collect (/ (funcall reader r) before))
                             most left (+ y 24) room height)
              class)))
      (curve #'supergrip:refinement-quality-bound "dots")
      (curve #'supergrip:refinement-quality "ring"))
    (supergrip-draw::draw-text "line: reached; dots: proved to be the most; each in its own order"
                               (list left (+ y 24 height 20)) :class "soft")))

(defun draw-study (ways refinements file)
  "Draw what WAYS and REFINEMENTS, those of PRINT-STUDY, came to into FILE."
  (supergrip-draw::save-picture
   (supergrip-draw::with-picture
       (1000 300 "Rules, trying everything, and refining"
             "Bars: the exact quality that five ways to choose a grasp reach. Curves: by how much refining raises it, and by how much it could at most.")
     (draw-way-bars ways 24 36 500)
     (draw-gain-curves (remove nil refinements :key #'supergrip:refinement-radius)
                       560 36 410 190))
   file))
