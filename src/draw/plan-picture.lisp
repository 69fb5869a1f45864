;;;; plan-picture.lisp -- DRAW-PLAN: a plan's box, and where the hand goes.

(in-package :supergrip-draw)

(defparameter +flat-views+
  '((0 90 "from above" ("X" "Y" ""))
    (-90 0 "from the front" ("X" "" "Z"))
    (0 0 "from the right" ("" "Y" "Z")))
  "Azimuth, elevation, caption and visible axes of the flat views.")

(defun flat-caption (subject index)
  "Return from where the flat view INDEX sees SUBJECT; or what it sees, if the box does not stand on
Z2."
  (if (lies-as-drawn-p subject)
      (third (nth index +flat-views+))
      (format nil "onto ~a" (nth index '("Z1" "Y2" "X1")))))

(defun flat-camera (azimuth elevation)
  (if (= elevation 90)
      (make-camera :azimuth -90 :elevation 90 :right (axis-vector 0) :up (axis-vector 1)
                   :toward (axis-vector 2))
      (camera-at azimuth elevation)))

(defun draw-flat-views (subject x y width height)
  "Draw the three flat views of SUBJECT, all to one scale, one below the other."
  (let* ((cell (/ height 3))
         (vectors (subject-vectors subject))
         (areas (loop for i below 3
                      collect (list (+ x 66) (+ y (* i cell) 26) (- width 82) (- cell 44))))
         (cameras (loop for (azimuth elevation) in +flat-views+
                        collect (flat-camera azimuth elevation)))
         (scale (loop for camera in cameras
                      for area in areas
                      minimize (view-scale (fit-view camera vectors area)))))
    (loop for camera in cameras
          for area in areas
          for (nil nil nil names) in +flat-views+
          for i from 0
          do (let ((cell-area (list x (+ y (* i cell)) width (- cell 8))))
               (apply #'draw-rectangle (append cell-area (list "frame")))
               (draw-text (flat-caption subject i) (list (+ x 8) (+ y (* i cell) 17)) :class "soft")
               (draw-axes camera (list (+ x 20) (+ y (* (1+ i) cell) -26)) names 20)
               (occupy (list (+ x 4) (+ y (* (1+ i) cell) -62) 48 52))
               (draw-subject subject (fit-view camera vectors area scale) :small t)
               (place-labels cell-area)))))

(defun draw-main-view (subject area)
  "Draw SUBJECT in the rectangle AREA, with axes and a scale bar."
  (destructuring-bind (x y width height) area
    (let* ((camera (best-camera (list subject)))
           (view (fit-view camera (subject-vectors subject)
                           (list (+ x 50) (+ y 26) (- width 100) (- height 90)))))
      (draw-axes camera (list (+ x 40) (+ y height -46)) '("X" "Y" "Z"))
      (occupy (list x (+ y height -92) 86 92))
      (draw-scale-bar (view-scale view) (list (+ x 110) (+ y height -26)))
      (draw-subject subject view)
      (place-labels area)
      view)))

(defun draw-overview (candidate plan area)
  "Draw the whole box of PLAN, small, and the hand, where the main view shows only a part."
  (destructuring-bind (x y width height) area
    (let* ((subject (grasp-subject candidate plan :whole t :load (weight-text (plan-box plan))))
           (vectors (subject-vectors subject)))
      (draw-rectangle x y width height "frame")
      (draw-text "the whole box" (list (+ x 8) (+ y 17)) :class "soft")
      (let ((view (fit-view (best-camera (list subject)) vectors
                            (list (+ x 14) (+ y 28) (- width 28) (- height 54)))))
        (draw-whole subject view)
        (occupy (list x (+ y height -34) 170 34))
        (place-labels area)
        (draw-scale-bar (view-scale view) (list (+ x 12) (+ y height -24)))))))

(defun draw-whole (subject view)
  "Draw the box of SUBJECT in VIEW with no more of the hand than its place and approach."
  (let ((*view* view) (*small* t))
    (with-group (:class "view" :description (view-description view))
      (draw-environment subject)
      (draw-edges subject :hidden)
      (draw-faces subject)
      (draw-outline subject)
      (draw-approach subject)
      (let ((*small* nil))
        (draw-weight subject)
        (draw-centre subject)))))

(defun fingers-text (subject)
  "Return where the fingers are, for a reader."
  (format nil "Fingers: ~{~a~^, ~}; ~a from the box centre."
          (loop for contact in (subject-contacts subject)
                collect (format nil "~a on ~a at ~a" (contact-finger contact)
                                (face-name (contact-face contact))
                                (place-text (contact-position contact))))
          (unit-text-of :length)))

(defun candidate-title (candidate)
  (format nil "~a, ~a" (candidate-grasp candidate) (quality-text candidate)))

(defun candidate-description (candidate plan subject)
  "Return what a picture of CANDIDATE shows, for those who can't see it."
  (format nil "~a holds a box, ~a, with the matching ~a. The palm is over ~a. ~a ~a~@[ ~a~]"
          (candidate-grasp candidate) (box-text (plan-box plan))
          (matching-text (candidate-matching candidate))
          (face-name (subject-palm subject)) (fingers-text subject)
          (constrained-text (plan-box plan)) (lying-text (plan-box plan))))

(defun constrained-text (box)
  "Return which faces of BOX are constrained, and its facts, for those who can't see them."
  (format nil "~:[No face is constrained~;~:*Constrained: ~{~a~^, ~}~].~
               ~@[ Facts of its own: ~{~a~^, ~}.~]"
          (box-constrained box) (fact-texts box)))

(defun fact-texts (box)
  "Return the facts of its own that BOX has, each as \"FRAGILE (Z1)\"."
  (loop for fact in (box-facts box) collect (format nil "~{~a~^ ~}" fact)))

(defun moved-slots (refinement)
  "Return the slots of a subject whose fingers REFINEMENT has moved, a plist; nothing for NIL."
  (and refinement
       (list :found (refinement-contacts refinement)
             :ghosts (mapcar (lambda (contact) (getf contact :position))
                             (refinement-home refinement)))))

(defun refinement-title (refinement)
  (format nil "~a, exact Q = ~a, not ~a; at most ~a"
          (candidate-grasp (refinement-candidate refinement))
          (index-text (refinement-quality refinement))
          (index-text (refinement-quality-before refinement))
          (index-text (refinement-quality-bound refinement))))

(defun candidate-picture (candidate plan &optional refinement)
  "Return the picture of CANDIDATE, which is possible in PLAN, or of it as REFINEMENT has moved it."
  (let* ((subject (apply #'grasp-subject candidate plan :load (weight-text (plan-box plan))
                         (moved-slots refinement)))
         (cut (subject-cut-p subject))
         (title (if refinement (refinement-title refinement) (candidate-title candidate))))
    (with-picture (1000 680 (format nil "~a, ~a" title (box-text (plan-box plan)))
                        (candidate-description candidate plan subject))
      (draw-heading title
                    (list (format nil "~a; ~a~@[; ~{~a~^, ~}~]" (box-text (plan-box plan))
                                  (matching-text (candidate-matching candidate))
                                  (fact-texts (plan-box plan))))
                    1000)
      (draw-main-view subject (list 24 72 630 (if cut 372 520)))
      (when cut
        (draw-overview candidate plan '(24 448 630 144)))
      (draw-flat-views subject 670 72 306 528)
      (draw-text (fitting (fingers-text subject) "plain" 952) '(24 624))
      (draw-key 24 652 952 :signs (if refinement (append +key+ +ghost-key+) +key+)))))

(defun cant-picture (plan)
  "Return the picture of the box of PLAN, which can't be grasped."
  (let* ((box (plan-box plan))
         (subject (box-subject box :load (weight-text box)))
         (reason (filled (plan-reason plan) "plain" 940)))
    (with-picture (1000 (+ 560 (* 19 (length reason)))
                        (format nil "Can't be grasped: ~a" (box-text box))
                        (format nil "A box, ~a, that can't be grasped. ~a ~a" (box-text box)
                                (constrained-text box) (plan-reason plan)))
      (draw-heading "Can’t be grasped"
                    (list (format nil "~a~@[; ~{~a~^, ~}~]" (box-text box) (fact-texts box)))
                    1000)
      (draw-main-view subject '(24 72 630 420))
      (draw-flat-views subject 670 72 306 420)
      (loop for line in reason
            for y from 524 by 19
            do (draw-text line (list 24 y)))
      (draw-key 24 (+ 532 (* 19 (length reason))) 952))))

(defun plan-picture (plan)
  "Return the picture of PLAN."
  (if (plan-best plan)
      (candidate-picture (plan-best plan) plan)
      (cant-picture plan)))

(defun draw-plan (plan file)
  "Draw the box of PLAN and its best grasp, or the box that can't be grasped, into FILE, an SVG
picture: in three dimensions and from three sides, to scale.  Lengths in cm.  Returns FILE."
  (drawing ((need-plan plan)) (save-picture (plan-picture plan) file)))

(defun draw-refinement (refinement file)
  "Draw the grasp of REFINEMENT with its fingers where they are now, and rings where they were, into
FILE, an SVG picture, as DRAW-PLAN does.  Returns FILE."
  (let ((plan (refinement-plan refinement)))
    (drawing (plan)
      (save-picture (candidate-picture (refinement-candidate refinement) plan refinement) file))))
