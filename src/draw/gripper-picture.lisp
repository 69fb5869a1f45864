;;;; gripper-picture.lisp -- DRAW-GRIPPER: what the dimensions of a gripper measure.
;;;;
;;;; Three views of one hand in one scale: along O, with opposed fingers; along N, with fingers side
;;;; by side; and along A, with the third finger of the U-shape.  The boxes are chosen to suit the
;;;; hand.

(in-package :supergrip-draw)

(defparameter +drawn-dimensions+
  '("FINGER-LENGTH" "FINGER-DIST" "FINGER-SPREAD" "FINGER-WIDTH" "DIST-PINCH" "WIDTH-HAND"
    "REACH-U")
  "The dimensions without which a gripper can't be drawn.")

(defun need-dimensions (knowledge)
  "Signal a DRAWING-ERROR if the gripper of KNOWLEDGE lacks one of +DRAWN-DIMENSIONS+."
  (let ((absent (remove-if (lambda (name) (gripper-size name knowledge)) +drawn-dimensions+)))
    (when absent
      (error 'drawing-error :what "the gripper"
                            :reason (format nil "it names no ~a" (list-text absent))))))

(defun draw-size (a b name knowledge side)
  "Draw a line from the point A to B with the dimension NAME of the gripper, on its SIDE."
  (draw-dimension a b (format nil "~a ~a" name (length-text (gripper-size name knowledge)))
                  :side side :leader t))

(defun draw-side-of-box (corner opposite place)
  "Draw the side of a box between CORNER and OPPOSITE, which PLACE turns into points."
  (destructuring-bind ((left top) (right bottom)) (list corner opposite)
    (let ((outline (loop for (x y) in `((,left ,top) (,right ,top) (,right ,bottom) (,left ,bottom))
                         collect (funcall place x y))))
      (draw-polygon outline "face")
      (draw-polygon outline "edge")
      (note-strokes (append outline (list (first outline)))))))

(defun draw-fingertip (point)
  (draw-circle point 3.4 "contact")
  (occupy-around point 6))

(defun draw-whole-finger (points)
  "Draw a finger through POINTS, base, knuckle and tip, and the contact at its tip."
  (note-strokes points 4)
  (draw-finger-line points)
  (dolist (joint (butlast points)) (draw-circle joint 3.4 "tip-hidden"))
  (draw-fingertip (first (last points))))

(defun draw-palm-above (left right level place)
  "Draw the palm from LEFT to RIGHT above LEVEL, which PLACE turns into points."
  (let* ((corner (funcall place left level))
         (rectangle (list (first corner) (- (second corner) 18)
                          (- (first (funcall place right level)) (first corner)) 18)))
    (draw-polygon (outline-of rectangle) "palm")
    (occupy rectangle)))

(defun draw-opposed-fingers (knowledge place)
  "Draw the hand as it is seen along O, holding a box narrower than its bases are apart."
  (flet ((size (name) (gripper-size name knowledge))
         (at (x y &optional (right 0) (down 0)) (mapcar #'+ (funcall place x y) (list right down))))
    (let* ((half (* 0.3 (size "FINGER-DIST")))
           (fingers (loop for side in '(-1 1) collect (finger-links side (* 2 half) 0 knowledge)))
           (base (second (first (second fingers))))
           (tip (second (third (second fingers))))
           (bottom (- tip (* 0.5 (size "FINGER-LENGTH"))))
           (opening (/ (size "DIST-PINCH") 2)))
      (draw-side-of-box (list (- half) 0) (list half bottom) place)
      (draw-palm-above (* -0.62 (size "FINGER-DIST")) (* 0.62 (size "FINGER-DIST")) base place)
      (dolist (finger fingers)
        (draw-whole-finger (loop for (x y) in finger collect (at x y))))
      (draw-size (at (/ (size "FINGER-DIST") -2) base 0 -30)
                 (at (/ (size "FINGER-DIST") 2) base 0 -30)
                 "FINGER-DIST" knowledge '(0 -1))
      (draw-size (at (- half) (second (second (second fingers))) -14) (at (- half) tip -14)
                 "FINGER-LENGTH" knowledge '(-1 0))
      (dolist (side '(-1 1))
        (draw-line (at (* side opening) bottom 0 34) (at (* side opening) bottom 0 56) "hidden"))
      (draw-size (at (- opening) bottom 0 46) (at opening bottom 0 46) "DIST-PINCH" knowledge
                 '(0 1))
      (draw-palm-depth (size "PALM-DEPTH") tip place))))

(defun draw-palm-depth (depth tip place)
  "Draw the grasp centre at the level TIP, and, if DEPTH is not NIL, the palm's frame."
  (let ((centre (funcall place 0 tip)))
    (draw-cross centre)
    (occupy-around centre 6)
    (ask-for-label "grasp centre" centre :class "soft" :toward '(1 1) :leader t)
    (when depth
      (let ((frame (funcall place 0 (+ tip depth))))
        (draw-cross frame)
        (occupy-around frame 6)
        (ask-for-label "palm’s frame" frame :class "soft" :toward '(1 0) :leader t)
        (draw-line centre frame "thin")
        (ask-for-label (format nil "PALM-DEPTH ~a" (length-text depth)) (along centre frame 0.4)
                       :class "soft" :toward '(1 0) :leader t)))))

(defun draw-fingers-side-by-side (knowledge place)
  "Draw the hand as it is seen along N: two fingers on a face, and below the narrowest face."
  (flet ((size (name) (gripper-size name knowledge))
         (at (x y &optional (right 0) (down 0)) (mapcar #'+ (funcall place x y) (list right down))))
    (let* ((length (size "FINGER-LENGTH")) (spread (/ (size "FINGER-SPREAD") 2))
           (hand (/ (size "WIDTH-HAND") 2)) (half (max hand (* 1.5 spread)))
           (bottom (* -1.5 length)))
      (draw-side-of-box (list (- half) 0) (list half bottom) place)
      (draw-palm-above (- hand) hand length place)
      (dolist (side (list (- spread) spread))
        (draw-whole-finger (list (at side length) (at side 0) (at side (- length)))))
      (draw-size (at (- hand) length 0 -30) (at hand length 0 -30) "WIDTH-HAND" knowledge '(0 -1))
      (draw-size (at (- spread) (- length) 0 16) (at spread (- length) 0 16)
                 "FINGER-SPREAD" knowledge '(0 1))
      (let ((plate (- bottom (* 0.6 length))))
        (draw-side-of-box (list (- half) (+ plate (size "FINGER-WIDTH"))) (list half plate) place)
        (draw-size (at half (+ plate (size "FINGER-WIDTH")) 14) (at half plate 14) "FINGER-WIDTH"
                   knowledge '(0 1))))))

(defun draw-third-finger (knowledge place)
  "Draw the contacts of the U-shape as they are seen along A, on a box that the thumb just reaches."
  (flet ((size (name) (gripper-size name knowledge))
         (at (x y &optional (right 0) (down 0)) (mapcar #'+ (funcall place x y) (list right down))))
    (let ((reach (size "REACH-U"))
          (half (* 0.3 (size "DIST-PINCH")))
          (link (* 0.5 (size "FINGER-LENGTH"))))
      (draw-side-of-box (list (- half) (* 0.6 reach)) (list half (- reach)) place)
      (loop for (name . points) in `(("F1" (,(- half) 0) (,(- (+ half link)) 0))
                                     ("F2" (,half 0) (,(+ half link) 0))
                                     ("thumb" (0 ,(- reach)) (0 ,(- (+ reach link)))))
            for (tip base) = (loop for (x y) in points collect (at x y))
            do (draw-finger-line (list base tip))
               (note-strokes (list base tip) 4)
               (draw-fingertip tip)
               (ask-for-label name base :class "bold"))
      (draw-line (at (- half) 0) (at half 0) "centre")
      (draw-size (at (* 0.3 half) 0) (at (* 0.3 half) (- reach)) "REACH-U" knowledge '(1 0)))))

(defun gripper-picture (knowledge)
  "Return the picture of the gripper of KNOWLEDGE."
  (need-dimensions knowledge)
  (flet ((size (name) (gripper-size name knowledge)))
    (let* ((length (size "FINGER-LENGTH"))
           (scale (min (/ 230 (max (size "DIST-PINCH") (* 1.24 (size "FINGER-DIST"))
                                   (* 1.2 (size "WIDTH-HAND")) (* 1.8 (size "FINGER-SPREAD"))))
                       (/ 240 (+ (* 3.1 length) (size "FINGER-WIDTH")))
                       (/ 280 (+ (* 1.6 (size "REACH-U")) (* 0.5 length))))))
      (with-picture (1100 500 "Gripper"
                     (format nil "Three views of a hand with three fingers, and what each of its~%~
                                  dimensions measures: the distance of opposed bases, the length ~
                                  of a link, the opening; the spread of~%~
                                  fingers side by side, the width of the hand, the least width of ~
                                  a face; and the reach of the thumb."))
        (draw-heading (format nil "What a gripper’s dimensions measure~@[: ~a~]"
                              (knowledge-model knowledge))
                      '("Lengths in cm, in one scale.  Palm and links are a diagram.")
                      1100)
        (loop for (caption draw x top)
                in `(("Opposed fingers, seen along O" draw-opposed-fingers 12 170)
                     ("Side by side, seen along N" draw-fingers-side-by-side 374
                      ,(+ 170 (* scale length)))
                     ("The U-shape, seen along A" draw-third-finger 736
                      ,(+ 130 (* scale 0.6 (size "REACH-U")))))
              do (draw-view caption draw x top scale knowledge))))))

(defun draw-view (caption draw x top scale knowledge)
  "Draw a frame at X with CAPTION, and in it what DRAW draws: 0 0 is in its middle at the height
TOP."
  (draw-rectangle x 72 352 416 "frame")
  (draw-text caption (list (+ x 12) 94) :class "bold")
  (funcall draw knowledge (lambda (a b) (list (+ x 174 (* scale a)) (- top (* scale b)))))
  (place-labels (list (+ x 4) 100 344 384)))

(defun draw-gripper (file &key (knowledge *knowledge*))
  "Draw what the dimensions of the gripper of KNOWLEDGE measure into FILE, an SVG picture.  A
DRAWING-ERROR says so if it lacks some that the picture needs, as a jaw does.  Returns FILE."
  (drawing ("the gripper")
    (save-picture (gripper-picture (check-knowledge-argument knowledge)) file)))
