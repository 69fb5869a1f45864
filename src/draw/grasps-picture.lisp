;;;; grasps-picture.lisp -- DRAW-GRASPS: the grasp modes, the paper's Figure 1.
;;;;
;;;; Each grasp is tried on reference boxes, smaller and larger ones, till one can be held, and is
;;;; drawn with the palm above: so a grasp that a user has added is drawn, too, from its data.

(in-package :supergrip-draw)

(defparameter +reference-sizes+
  '((5 4.4 3.8) (4 4 4) (8 7 6) (3 2.5 2) (12 11 10) (1.2 1.2 1.2) (10 4 2) (20 18 16))
  "Sizes of the reference boxes, in cm, in the order in which they are tried.")

(defun reference-box (size u)
  "Return the description of a reference box, free on all sides, whose task needs a little of all."
  `((size ,@size) (weight 0) (u ,u) (v 0.2) (constrained)
    (force-needed (0.1 0.1 0.1 0.1 0.1 0.1)) (velocity-needed (0 0 0 0 0 0))))

(defun reference-plans (name knowledge)
  "Return a function that gives plans in which the grasp NAME was tried, each on another box."
  (loop for u in '(1.5d0 0.8d0 3d0)
        append (loop for size in +reference-sizes+
                     collect (list name (reference-box size u) knowledge))))

(defun reference-candidate (name knowledge)
  "Return a possible candidate of the grasp NAME with the palm above, and its plan; or NIL."
  (loop for (name box knowledge) in (reference-plans name knowledge)
        for plan = (try-grasp name box :knowledge knowledge)
        for candidates = (plan-possible plan)
        for above = (remove 1 candidates :key #'palm-face :test-not #'=)
        do (when candidates
             (return (values (best-seen (or above candidates) plan) plan)))))

(defun best-seen (candidates plan)
  "Return the one of CANDIDATES whose contacts are seen best from the usual place."
  (let ((camera (camera-at -58 28)) (best nil) (most nil))
    (dolist (candidate candidates best)
      (let* ((subject (grasp-subject candidate plan))
             (score (+ (reduce #'+ (mapcar (lambda (contact) (contact-score contact camera))
                                           (subject-contacts subject)))
                       (spread-score subject camera))))
        (when (or (null most) (> score (+ most 1d-6)))
          (setf best candidate most score))))))

(defun slot-namer (candidate)
  "Return a function that gives the grasp's own name of a face of the box."
  (lambda (face)
    (aref #("N1" "N2" "O1" "O2" "A1" "A2")
          (position (surface-name face) (candidate-matching candidate) :test #'string=))))

(defun slot-axes (candidate)
  "Return the vectors of N, O and A."
  (loop for (face) on (candidate-matching candidate) by #'cddr
        collect (face-normal (surface-index face))))

(defun draw-slot-axes (camera candidate point)
  "Draw the axes N O A of CANDIDATE at POINT."
  (let ((view (make-view :camera camera :scale 26 :origin point)))
    (loop for vector in (slot-axes candidate)
          for name in '("N" "O" "A")
          for end = (project view vector)
          for way = (max 1 (distance point end))
          do (draw-axis point end)
             (draw-text name (let ((beyond (along point end (/ (+ way 9) way))))
                               (list (first beyond) (+ 4 (second beyond))))
                        :class "soft" :anchor :middle))))

(defun grasp-summary (subject)
  "Return in words which fingers oppose which, and where the palm is."
  (let* ((name (subject-namer subject))
         (by-face (loop for face in '(1 0 3 2 5 4)
                        for numbers = (loop for contact in (subject-contacts subject)
                                            when (= face (contact-face contact))
                                              collect (contact-number contact))
                        when numbers
                          collect (cons face (format nil "~{~d~^ and ~}" numbers))))
         (pairs (loop for (face . numbers) in by-face
                      for other = (cdr (assoc (opposite face) by-face))
                      when (and other (oddp face))
                        collect (format nil "~a against ~a" numbers other))))
    (format nil "~:[no two fingers oppose~;~:*~{~a~^, ~}~]; palm over ~a" pairs
            (funcall name (subject-palm subject)))))

(defun draw-grasp-cell (name knowledge x y width height)
  "Draw the grasp NAME in a cell of a table of pictures.  Returns what it shows, in words."
  (multiple-value-bind (candidate plan) (reference-candidate name knowledge)
    (draw-text (fitting name "bold" (- width 16)) (list (+ x 10) (+ y 22)) :class "bold")
    (if (null candidate)
        (progn
          (loop for line in (filled "possible on none of the reference boxes" "soft" (- width 20))
                for below from (+ y 60) by 18
                do (draw-text line (list (+ x 10) below) :class "soft"))
          (format nil "~a: possible on none of the reference boxes." name))
        (draw-reference candidate plan x y width height))))

(defun draw-reference (candidate plan x y width height)
  (let* ((subject (grasp-subject candidate plan :namer (slot-namer candidate)))
         (camera (best-camera (list subject) 26))
         (view (fit-view camera (subject-vectors subject)
                         (list (+ x 34) (+ y 60) (- width 76) (- height 108))))
         (summary (grasp-summary subject)))
    (draw-text summary (list (+ x 10) (+ y 41)) :class "soft")
    (draw-slot-axes camera candidate (list (+ x 40) (+ y height -40)))
    (occupy (list (+ x 2) (+ y height -78) 76 76))
    (draw-subject subject view)
    (place-labels (list (+ x 4) (+ y 48) (- width 8) (- height 52)))
    (format nil "~a: ~{~a~^, ~}; ~a." (candidate-grasp candidate)
            (loop for contact in (subject-contacts subject)
                  collect (format nil "finger ~d on ~a" (contact-number contact)
                                  (funcall (subject-namer subject) (contact-face contact))))
            summary)))

(defun grasp-names (knowledge)
  (mapcar #'supergrip::grasp-name (knowledge-grasps knowledge)))

(defun grasps-picture (knowledge)
  "Return the picture of all grasps of KNOWLEDGE."
  (let* ((names (grasp-names knowledge))
         (columns (min 3 (max 1 (length names))))
         (rows (ceiling (length names) columns))
         (wide 330) (high 320)
         (width (+ 24 (* columns wide)))
         (height (+ 78 (* rows high) 36))
         (words '()))
    (let ((picture
            (with-picture (width height "Grasp modes" "")
              (draw-heading "Grasp modes"
                            '("Each on a reference box, the palm above. Box and contacts to scale; ~
                               fingers and palm are a diagram.")
                            width)
              (loop for name in names
                    for i from 0
                    do (multiple-value-bind (row column) (floor i columns)
                         (let ((x (+ 12 (* column wide))) (y (+ 72 (* row high))))
                           (draw-rectangle (+ x 3) y (- wide 6) (- high 8) "frame")
                           (push (draw-grasp-cell name knowledge x y wide (- high 8)) words))))
              (draw-key 24 (+ 72 (* rows high) 20) (- width 48)))))
      (setf (picture-description picture) (format nil "~{~a~^ ~}" (reverse words)))
      picture)))

(defun draw-grasps (file &key (knowledge *knowledge*))
  "Draw all grasps of KNOWLEDGE, each on a reference box, into FILE, an SVG picture: the paper's
Figure 1.  Only the data of a grasp are used, so a new one is drawn, too.  Returns FILE."
  (save-picture (grasps-picture knowledge) file))
