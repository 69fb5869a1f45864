;;;; offset-picture.lisp -- DRAW-OFFSET: why a grasp can't always be in the middle, the paper's
;;;; Figure 2.
;;;;
;;;; Two tall boxes held by PINCH-2-PARALLEL, seen along O.  A finger has two links.  The outer one
;;;; lies along the face; the inner one reaches down beside the box only if the box is narrower than
;;;; the distance of the fingers' bases.  The place of the contacts is that of the plan.

(in-package :supergrip-draw)

(defparameter +offset-boxes+ '((5.4d0 15) (8 12))
  "The two boxes: their sizes along N and A, in cm.")

(defun offset-plan (across along knowledge)
  "Return a plan and a candidate in which PINCH-2-PARALLEL holds the box from above across X."
  (let* ((plan (try-grasp "PINCH-2-PARALLEL"
                          `((size ,across 5 ,along) (weight 0) (u 0.8) (v 0.2)
                            (constrained z2)
                            (force-needed (1 0 0 0 0 0)) (velocity-needed (0 0 0 0 0 0)))
                          :knowledge knowledge))
         (candidate (find-if (lambda (candidate)
                               (and (= 1 (palm-face candidate))
                                    (find (first (candidate-matching candidate)) '("X1" "X2")
                                          :test #'string=)))
                             (plan-possible plan))))
    (values candidate plan)))

(defun gripper-size (name knowledge)
  (cdr (assoc name (knowledge-gripper knowledge) :test #'string=)))

(defun finger-links (side across top knowledge)
  "Return base, knuckle and tip, as (n a), of the finger on SIDE, 1 or -1, of a box ACROSS wide
whose top is at TOP."
  (let* ((length (gripper-size "FINGER-LENGTH" knowledge))
         (base (/ (gripper-size "FINGER-DIST" knowledge) 2))
         (depth (sqrt (max 0 (- (expt length 2) (expt (- (/ across 2) base) 2)))))
         (knuckle (if (< across (* 2 base)) (- top depth) top)))
    (list (list (* side base) (+ knuckle depth))
          (list (* side (/ across 2)) knuckle)
          (list (* side (/ across 2)) (- knuckle length)))))

(defun draw-dimension (a b text &key (side '(0 0)) leader)
  "Draw a line with ticks between the points A and B, and TEXT at its middle moved by SIDE, with a
LEADER if it is far."
  (let* ((length (max 1 (distance a b)))
         (across (list (* 4 (/ (- (second b) (second a)) length))
                       (* 4 (/ (- (first a) (first b)) length)))))
    (draw-line a b "thin")
    (dolist (end (list a b))
      (draw-line (mapcar #'+ end across) (mapcar #'- end across) "thin"))
    (note-strokes (list a b))
    (ask-for-label text (mapcar #'+ (along a b 1/2) side) :class "soft" :away 6
                   :toward side :leader leader)))

(defun draw-offset-hand (across top place knowledge)
  "Draw palm, links and joints; PLACE turns (n a) into a point."
  (let* ((fingers (loop for side in '(-1 1) collect (finger-links side across top knowledge)))
         (bases (mapcar #'first fingers))
         (left (funcall place (first (first bases)) (second (first bases))))
         (right (funcall place (first (second bases)) (second (second bases)))))
    (draw-polygon (outline-of (list (- (first left) 14) (- (second left) 16)
                                    (+ 28 (- (first right) (first left))) 16))
                  "palm")
    (occupy (list (- (first left) 14) (- (second left) 16)
                  (+ 28 (- (first right) (first left))) 16))
    (ask-for-label "palm" (list (+ 14 (first right)) (- (second right) 8)) :class "soft" :away 6
                   :toward '(1 0))
    (dolist (finger fingers)
      (let ((points (loop for (n a) in finger collect (funcall place n a))))
        (note-strokes points)
        (draw-finger-line points)
        (dolist (joint (butlast points))
          (draw-circle joint 3.4 "tip-hidden"))))
    fingers))

(defun draw-offset-dimensions (across along offset fingers place knowledge)
  (flet ((at (n a &optional (right 0) (down 0))
           (mapcar #'+ (funcall place n a) (list right down))))
    (destructuring-bind ((left-base &rest rest) (right-base right-knuckle right-tip)) fingers
      (declare (ignore rest))
      (let ((top (/ along 2)) (half (/ across 2)) (reach (second right-tip)))
        (draw-dimension (at (first left-base) (second left-base) 0 -34)
                        (at (first right-base) (second right-base) 0 -34)
                        (format nil "FINGER-DIST ~a"
                                (length-text (gripper-size "FINGER-DIST" knowledge)))
                        :side '(0 -1))
        (draw-dimension (at half (second right-knuckle) 18) (at half reach 18)
                        (format nil "FINGER-LENGTH ~a"
                                (length-text (gripper-size "FINGER-LENGTH" knowledge)))
                        :side '(1 0))
        (when (< (second right-knuckle) (- top 1d-6))
          (draw-dimension (at half top 18) (at half (second right-knuckle) 18)
                          (format nil "depth ~a" (length-text (- top (second right-knuckle))))
                          :side '(1 0)))
        (draw-dimension (at (- half) (- top) 0 20) (at half (- top) 0 20)
                        (format nil "DIST (N1 N2) ~a" (length-text across)) :side '(0 1))
        (draw-dimension (at half offset 18) (at half 0 18)
                        (format nil "offset ~a" (length-text offset)) :side '(1 0))
        (draw-line (at 0 0) (at 0 offset) "thin")
        (draw-line (at 0 0) (at half 0 18) "hidden")
        (draw-line (at 0 0) (at (- half) 0 -18) "hidden")
        (draw-dimension (at (- half) top -18) (at (- half) 0 -18)
                        (format nil "half of DIST ~a" (length-text top))
                        :side '(-1 0))))))

(defun draw-offset-case (across along caption x y width height scale knowledge)
  "Draw the box ACROSS x ALONG cm, how it is held, and the dimensions that matter."
  (multiple-value-bind (candidate plan) (offset-plan across along knowledge)
    (unless candidate
      (error 'drawing-error
             :what "the offset"
             :reason (format nil "PINCH-2-PARALLEL can't hold a box of ~a from above"
                             (size-text (list across 5 along)))))
    (let* ((top (/ along 2))
           (middle (list (+ x (/ width 2) -20) (+ y 150 (* scale top))))
           (offset (third (candidate-offset candidate))))
      (flet ((place (n a) (list (+ (first middle) (* scale n)) (- (second middle) (* scale a)))))
        (draw-text caption (list (+ x 12) (+ y 22)) :class "bold")
        (let ((outline (loop for (n a) in '((-1 1) (1 1) (1 -1) (-1 -1))
                             collect (place (* n across 1/2) (* a top)))))
          (draw-polygon outline "face")
          (draw-polygon outline "edge")
          (note-strokes (append outline (list (first outline)))))
        (draw-circle (place 0 0) 3 "force-tip")
        (occupy-around (place 0 0) 6)
        (ask-for-label "box centre" (place 0 0) :class "soft" :toward '(-1 1))
        (draw-cross (place 0 offset))
        (occupy-around (place 0 offset) 6)
        (ask-for-label "grasp centre" (place 0 offset) :class "soft" :toward '(-1 -1))
        (let ((fingers (draw-offset-hand across top #'place knowledge)))
          (loop for contact in (candidate-contacts candidate plan)
                for (n nil a) = (getf contact :position)
                do (draw-circle (place n a) 3.4 "contact"
                                :title (format nil "Contact on ~a" (getf contact :surface)))
                   (occupy-around (place n a) 6))
          (draw-offset-dimensions across along offset fingers #'place knowledge))
        (place-labels (list (+ x 4) (+ y 28) (- width 8) (- height 30)))))))

(defun offset-picture (knowledge)
  "Return the picture of the offset."
  (with-picture (1000 600 "Offset"
                 "Two tall boxes held by two fingers from above. The fingers do not reach the
middle of the faces; the grasp centre is offset from the box centre towards the palm. Where the box
is narrower than the distance of the fingers' bases, the inner links reach down beside it, too.")
    (draw-heading "Offset: the fingers can’t reach the middle"
                  '("PINCH-2-PARALLEL, seen along O; lengths in cm, to scale.") 1000)
    (loop for (across along) in +offset-boxes+
          for caption in '("Narrower than FINGER-DIST: both links reach down"
                           "Wider than FINGER-DIST: only the outer links do")
          for x in '(12 506)
          do (draw-rectangle x 72 482 516 "frame")
             (draw-offset-case across along caption x 72 482 516 19 knowledge))))

(defun draw-offset (file &key (knowledge *knowledge*))
  "Draw what the offset of a grasp is, on two boxes too tall for the gripper of KNOWLEDGE, into
FILE, an SVG picture: the paper's Figure 2.  KNOWLEDGE must have PINCH-2-PARALLEL, and its
gripper one of the shipped one's size, or a DRAWING-ERROR says so.  Returns FILE."
  (drawing ("the offset")
    (save-picture (offset-picture (check-knowledge-argument knowledge)) file)))
