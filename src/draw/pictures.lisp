;;;; pictures.lisp -- what all pictures of grasps share: where to look from, headings, the key.

(in-package :supergrip-draw)

(defparameter +azimuths+ '(-58 32 122 212 -32 58 148 238)
  "The directions from which a box may be seen, in degrees; the first are preferred.")

(defun contact-score (contact camera)
  "Return how well CONTACT is seen: how far its face is turned to CAMERA."
  (let ((cosine (dot (face-normal (contact-face contact)) (camera-toward camera))))
    (if (plusp cosine) (+ 1 (* 0.5 cosine)) 0)))

(defun spread-score (subject camera)
  "Return by how little the contacts of SUBJECT cover each other: the least of their distances as
seen, in gaps, 1 at most."
  (let* ((view (make-view :camera camera))
         (points (loop for contact in (subject-contacts subject)
                       collect (project view (contact-position contact)))))
    (loop with least = 1
          for (p . rest) on points
          do (dolist (q rest) (setf least (min least (/ (distance p q) (subject-gap subject)))))
          finally (return least))))

(defun view-score (subject camera)
  "Return how well the contacts of SUBJECT are seen by CAMERA."
  (+ (reduce #'+ (mapcar (lambda (contact) (contact-score contact camera))
                         (subject-contacts subject)))
     (spread-score subject camera)))

(defun best-camera (subjects &optional (elevation 28) (top (upper-face (first subjects))))
  "Return the camera that sees the contacts of SUBJECTS best, the face TOP being above, and how
well it does."
  (let ((best nil) (most nil))
    (loop for azimuth in +azimuths+
          for place from 0
          for camera = (camera-at azimuth elevation top)
          for score = (- (reduce #'+ (mapcar (lambda (subject) (view-score subject camera))
                                             subjects))
                         (* 0.02 place))
          do (when (or (null most) (> score most))
               (setf best camera most score)))
    (values best most)))

(defun at-most-text (candidate number)
  "Return NUMBER, Q or u_w of CANDIDATE, with a sign if it is only a bound."
  (format nil "~:[~;≤ ~]~a" (candidate-bound-p candidate) (index-text number)))

(defun quality-text (candidate)
  (format nil "Q ~:[= ~;~]~a" (candidate-bound-p candidate)
          (at-most-text candidate (candidate-quality candidate))))

(defun matching-text (matching)
  (format nil "N1 N2 O1 O2 A1 A2 = ~{~a~^ ~}" matching))

(defun weight-text (box)
  "Return the weight of BOX as its arrow is labelled, or NIL if it has none."
  (and (plusp (box-weight box))
       (format nil "weight ~a~:[, at the centre of mass~;~]"
               (with-unit (quantity (in-units (box-weight box) :force)) :force)
               (every #'zerop (box-centre box)))))

(defun down-text (box)
  "Return where down is for BOX, as \"-Y\" or as a unit vector."
  (let ((down (box-down box)))
    (if (find 1 down :key #'abs)
        (format nil "~:[+~;~a~]~a" (minusp (reduce #'+ down)) +minus+
                (char "XYZ" (position 1 down :key #'abs)))
        (format nil "(~{~a~^, ~})" (mapcar #'decimal down)))))

(defun lying-text (box)
  "Return how BOX lies, a sentence, if it has a pose or a centre of mass of its own, or NIL."
  (let ((parts (append (and (box-pose box) (list (format nil "down is ~a" (down-text box))))
                       (and (notevery #'zerop (box-centre box))
                            (list (format nil "the centre of mass is at ~a"
                                          (place-text (box-centre box))))))))
    (and parts (format nil "In the box frame ~a." (list-text parts)))))

(defun draw-heading (heading lines width)
  "Write HEADING and LINES at the top of a picture WIDTH wide."
  (let ((room (- width 48)))
    (draw-text (fitting heading "heading" room) '(24 34) :class "heading")
    (loop for line in lines
          for y from 56 by 19
          do (draw-text (fitting line "soft" room) (list 24 y) :class "soft"))))

;;; The key

(defparameter +scale-words+
  "Box and contacts are to scale; fingers and palm are a diagram of where they come from."
  "What is to scale.")

(defun key-contact (x y) (draw-circle (list x y) 3 "contact"))
(defun key-hidden (x y) (draw-circle (list x y) 3 "contact-hidden"))
(defun key-blocked (x y)
  (let ((outline (outline-of (list (- x 9) (- y 6) 18 12))))
    (draw-polygon outline "blocked")
    (draw-hatching outline)))
(defun key-closing (x y) (draw-line (list (- x 14) y) (list (+ x 14) y) "centre"))
(defun key-centre (x y) (draw-cross (list x y)))
(defun key-away (x y) (draw-end-on (list x y) nil nil))
(defun key-toward (x y) (draw-end-on (list x y) t nil))

(defparameter +key+
  '((key-contact 8 "contact") (key-hidden 8 "contact behind")
    (key-away 12 "points away") (key-toward 12 "points to you")
    (key-closing 30 "opposed fingers") (key-blocked 20 "constrained"))
  "The signs of the key: how each is drawn, how wide it is, what it means.")

(defun key-ghost (x y) (draw-circle (list x y) 5 "thin"))
(defparameter +ghost-key+ '((key-ghost 12 "where a finger was")) "The sign that moved fingers add.")

(defun key-have (x y) (draw-rectangle (- x 12) (- y 6) 24 12 "have"))
(defun key-need (x y) (draw-line (list x (- y 8)) (list x (+ y 8)) "need"))

(defun key-sure (x y) (draw-rectangle (- x 12) (- y 2) 24 5 "sure"))
(defun key-index (x y) (draw-line (list x (- y 8)) (list x (+ y 8)) "hidden"))

(defparameter +quality-key+
  '((key-have 26 "what the grasp has, gravity’s load taken off")
    (key-need 6 "what the task needs at the grasp centre")
    (list 0 "◀ the axis that limits")
    (key-sure 26 "what it surely bears on all axes together")
    (key-index 6 "u_w, the paper’s index"))
  "The key to the bars.")

(defun key-places (signs x y width)
  "Return where each of SIGNS stands, in lines from X Y no wider than WIDTH: lists of the left end
and the y of its line, the sign, how wide it is, and its text."
  (loop with left = x
        for (sign wide text) in signs
        for more = (+ wide 8 (text-width text "soft") 18)
        when (> (+ left more) (+ x width))
          do (setf left x)
             (incf y 22)
        collect (list left y sign wide text)
        do (incf left more)))

(defun key-height (signs width)
  "Return how far below its first line the last line of the key of SIGNS is."
  (second (first (last (key-places signs 0 0 width)))))

(defun draw-key (x y width &key (signs +key+))
  "Draw the key of SIGNS from X Y in lines no wider than WIDTH."
  (loop for (left y sign wide text) in (key-places signs x y width)
        do (funcall sign (+ left (/ wide 2)) (- y 4))
           (draw-text text (list (+ left wide 8) y) :class "soft")))
