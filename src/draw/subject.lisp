;;;; subject.lisp -- what a picture of a grasp shows, in the box frame: the box, or the part of it
;;;; around the grasp, and the contacts, to scale; fingers and palm as a diagram of them.

(in-package :supergrip-draw)

(defstruct contact
  "A finger's contact: FINGER, its name, the FACE it is on, its POSITION in cm, and PATH, the
diagram of the finger from the palm to the position."
  finger face position path)

(defstruct subject
  "A box to be drawn, and a grasp of it if PALM, the face that the palm is over, is not NIL.
LOW and HIGH are the corners of what is shown of it; GAP the length, in cm, from which all that is
not to scale is made.  PALM-LOW and PALM-HIGH are the corners of the palm's plate.  NAMER returns
the name of a face.  LOAD is the weight as text, or NIL for no weight to be drawn; it acts at MASS
in the direction DOWN.  LABELLED is NIL if the grasp centre is to be drawn without words.  GHOSTS
are the places where the fingers were before they were moved."
  size low high (gap 0) (blocked '()) (contacts '()) (centre '(0d0 0d0 0d0)) (palm nil)
  palm-low palm-high (namer #'face-name) (load nil) (mass '(0d0 0d0 0d0)) (down '(0d0 0d0 -1d0))
  (labelled t) (ghosts '()))

(defun subject-cut-p (subject)
  "True if only part of the box is shown."
  (notevery (lambda (low high size) (> (- high low) (* 0.999 size)))
            (subject-low subject) (subject-high subject) (subject-size subject)))

;;; What is shown of the box

(defun window-along (low high half length)
  "Return the part of a box, from -HALF to HALF, that LENGTH around LOW to HIGH shows: two values.
All of it is shown if that is not much more."
  (let ((from (- (/ (+ low high) 2) (/ length 2)))
        (to (+ (/ (+ low high) 2) (/ length 2))))
    (if (<= (* 2 half) (* 1.6 length))
        (values (- half) half)
        (values (if (< from (* -0.9 half)) (- half) from)
                (if (> to (* 0.9 half)) half to)))))

(defun least-distance (places)
  "Return the least of the distances between PLACES, or 0 if there is only one."
  (loop for (p . rest) on places
        append (mapcar (lambda (q) (distance p q)) rest) into distances
        finally (return (if distances (reduce #'min distances) 0))))

(defun find-window (size places palm)
  "Return the corners of what is shown of a box of SIZE, held at PLACES, up to the face PALM: all of
it, if that leaves the contacts apart from each other."
  (let* ((lows (apply #'mapcar #'min places))
         (highs (apply #'mapcar #'max places))
         (hold (max (reduce #'max (mapcar #'- highs lows)) (reduce #'min size)))
         (whole (<= (reduce #'max size) (* 14 (max (least-distance places) (* 0.2 hold)))))
         (low '()) (high '()))
    (loop for axis below 3
          for half = (/ (nth axis size) 2)
          do (multiple-value-bind (from to)
                 (if whole
                     (values (- half) half)
                     (window-along (nth axis lows) (nth axis highs) half (* 3.5 hold)))
               (when (= axis (face-axis palm))
                 (if (plusp (face-sign palm)) (setf to half) (setf from (- half))))
               (push from low)
               (push to high)))
    (values (reverse low) (reverse high))))

;;; Fingers and palm

(defun raised (vector palm level)
  "Return VECTOR moved along the normal of the face PALM to LEVEL."
  (with-part vector (face-axis palm) level))

(defun side-step (position palm subject)
  "Return POSITION, on the face opposed to PALM, moved past the nearest edge, for a finger to pass."
  (let ((best nil) (least nil))
    (loop for axis below 3
          unless (= axis (face-axis palm))
            do (loop for edge in (list (nth axis (subject-low subject))
                                       (nth axis (subject-high subject)))
                     for way = (abs (- edge (nth axis position)))
                     do (when (or (null least) (< way least))
                          (setf least way
                                best (with-part position axis
                                       (+ edge (* (signum edge) (subject-gap subject))))))))
    best))

(defun finger-path (position face palm level subject)
  "Return the diagram of a finger from the palm's plane, LEVEL, to POSITION on FACE."
  (let ((knee (v+ position (v* (subject-gap subject) (face-normal face)))))
    (cond ((= face palm) (list (raised position palm level) position))
          ((= face (opposite palm))
           (let ((side (side-step knee palm subject)))
             (list (raised side palm level) side knee position)))
          (t (list (raised knee palm level) knee position)))))

(defun palm-level (palm low high contacts gap)
  "Return where the palm's plane is along the normal of the face PALM."
  (let ((axis (face-axis palm)))
    (* (face-sign palm)
       (+ (* 1.9 gap)
          (reduce #'max (mapcar (lambda (vector) (* (face-sign palm) (nth axis vector)))
                                (list* low high contacts)))))))

(defun place-palm (subject level)
  "Put into SUBJECT the corners of the palm's plate at LEVEL: it covers the roots of the fingers."
  (let* ((palm (subject-palm subject)) (gap (subject-gap subject))
         (roots (cons (raised (subject-centre subject) palm level)
                      (mapcar (lambda (contact) (first (contact-path contact)))
                              (subject-contacts subject))))
         (low (apply #'mapcar #'min roots))
         (high (apply #'mapcar #'max roots))
         (thickness (* 0.3 gap (face-sign palm))))
    (loop for axis below 3
          do (if (= axis (face-axis palm))
                 (setf low (with-part low axis (min level (+ level thickness)))
                       high (with-part high axis (max level (+ level thickness))))
                 (let ((more (max (* 0.4 gap)
                                  (- (* 0.7 gap) (/ (- (nth axis high) (nth axis low)) 2)))))
                   (setf low (with-part low axis (- (nth axis low) more))
                         high (with-part high axis (+ (nth axis high) more))))))
    (setf (subject-palm-low subject) low
          (subject-palm-high subject) high)
    subject))

(defun gap-of (low high)
  "Return the length from which the diagram of the hand is made, for what is shown of a box."
  (let ((sizes (sort (mapcar #'- high low) #'>)))
    (+ (* 0.08 (first sizes)) (* 0.13 (second sizes)))))

(defun grasp-subject (candidate plan &rest options &key whole found &allow-other-keys)
  "Return the subject of CANDIDATE, which is possible in PLAN.  If WHOLE, the whole box is shown.
FOUND are its contacts, if not those of the plan.  OPTIONS are other slots of the subject."
  (let* ((size (box-size (plan-box plan)))
         (palm (palm-face candidate))
         (found (or found (candidate-contacts candidate plan)))
         (positions (mapcar (lambda (contact) (getf contact :position)) found))
         (half (v* 0.5d0 size)))
    (multiple-value-bind (low high)
        (if whole
            (values (v* -1 half) half)
            (find-window size positions palm))
      (let* ((gap (gap-of low high))
             (level (palm-level palm low high positions gap))
             (subject (apply #'make-subject :size size :low low :high high :gap gap :palm palm
                             :blocked (blocked-faces (plan-box plan))
                             :mass (box-centre (plan-box plan)) :down (box-down (plan-box plan))
                             :centre (candidate-offset candidate) :allow-other-keys t options)))
        (setf (subject-contacts subject)
              (loop for contact in found
                    for face = (face-index (getf contact :surface))
                    for position = (getf contact :position)
                    collect (make-contact :finger (getf contact :finger) :face face
                                          :position position
                                          :path (finger-path position face palm level subject))))
        (place-palm subject level)))))

(defun palm-face (candidate)
  "Return the face that the palm of CANDIDATE is over."
  (face-index (candidate-palm candidate)))

(defun blocked-faces (box)
  (mapcar #'face-index (box-constrained box)))

(defun box-subject (box &rest options)
  "Return the subject of BOX without a grasp; OPTIONS are other slots."
  (let* ((size (box-size box)) (half (v* 0.5d0 size)) (low (v* -1 half)))
    (apply #'make-subject :size size :low low :high half :gap (gap-of low half)
                          :blocked (blocked-faces box) :mass (box-centre box)
                          :down (box-down box) options)))

;;; What follows from a subject

(defun closing-pairs (subject)
  "Return, for each axis across which fingers oppose each other, the mean places of those on either
side."
  (loop for face in '(0 2 4)
        for (one other) = (loop for side in (list face (opposite face))
                                collect (loop for contact in (subject-contacts subject)
                                              when (= side (contact-face contact))
                                                collect (contact-position contact)))
        when (and one other) collect (list (middle one) (middle other))))

(defun arrow-ends (subject)
  "Return where the arrow of approach begins and ends."
  (let* ((normal (face-normal (subject-palm subject)))
         (top (v+ (middle (list (subject-palm-low subject) (subject-palm-high subject)))
                  (v* (* 0.15 (subject-gap subject)) normal))))
    (list (v+ top (v* (* 1.25 (subject-gap subject)) normal))
          (v+ top (v* (* 0.15 (subject-gap subject)) normal)))))

(defun weight-ends (subject)
  "Return where the arrow of weight begins and ends: it leaves the box below."
  (let* ((mass (subject-mass subject)) (down (subject-down subject))
         (way (loop for low in (subject-low subject)
                    for high in (subject-high subject)
                    for at in mass
                    for part in down
                    unless (zerop part)
                      minimize (/ (- (if (plusp part) high low) at) part))))
    (list mass (v+ mass (v* (+ way (* 1.1 (subject-gap subject))) down)))))

(defun weight-shown-p (subject)
  "True if the weight of SUBJECT is to be drawn: it acts in what is shown."
  (and (subject-load subject)
       (every #'<= (subject-low subject) (subject-mass subject) (subject-high subject))))

(defun upper-face (subject)
  "Return the face of SUBJECT that looks up most."
  (let ((up (mapcar #'- (subject-down subject))))
    (reduce (lambda (a b) (if (> (dot up (face-normal b)) (dot up (face-normal a))) b a))
            '(1 0 3 2 5 4))))

(defun lies-as-drawn-p (subject)
  "True if Z1 is above, as in the box frame."
  (equal (subject-down subject) '(0d0 0d0 -1d0)))

(defun plate-corners (face subject)
  "Return the corners, low and high, of the plate that stands for what constrains FACE."
  (let* ((axis (face-axis face)) (gap (subject-gap subject))
         (low (subject-low subject)) (high (subject-high subject))
         (margin (list (* 0.3 gap) (* 0.3 gap) (* 0.3 gap)))
         (from (v- low margin)) (to (v+ high margin)))
    (if (plusp (face-sign face))
        (values (with-part from axis (nth axis high))
                (with-part to axis (+ (nth axis high) (* 0.25 gap))))
        (values (with-part from axis (- (nth axis low) (* 0.25 gap)))
                (with-part to axis (nth axis low))))))

(defun shown-face-p (face subject)
  "True if FACE is an end of what is shown, not the cut of a box that goes on."
  (let ((axis (face-axis face)))
    (< (abs (- (abs (nth axis (if (plusp (face-sign face))
                                  (subject-high subject)
                                  (subject-low subject))))
               (/ (nth axis (subject-size subject)) 2)))
       1d-9)))

(defun centre-shown-p (subject)
  "True if the box centre lies in what is shown."
  (every (lambda (low high) (<= low 0 high)) (subject-low subject) (subject-high subject)))

(defun subject-vectors (subject)
  "Return all places that a view of SUBJECT must have room for."
  (append (box-corners (subject-low subject) (subject-high subject))
          (loop for face in (subject-blocked subject)
                when (shown-face-p face subject)
                  append (multiple-value-call #'box-corners (plate-corners face subject)))
          (when (subject-palm subject)
            (append (box-corners (subject-palm-low subject) (subject-palm-high subject))
                    (arrow-ends subject)
                    (mapcan (lambda (contact) (copy-list (contact-path contact)))
                            (subject-contacts subject))))
          (when (weight-shown-p subject)
            (weight-ends subject))))
