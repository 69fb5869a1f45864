;;;; scene.lisp -- a subject seen by a camera.
;;;;
;;;; The box is convex, and hand and plates are outside it.  So what lies beyond a face that is
;;;; turned away can't hide any of the box, and what lies beyond a face that is turned to the viewer
;;;; can't be hidden by the box.  So what lies beyond faces that are turned away is painted first,
;;;; then the box, then the rest.  This is exact.  The faces of the box are drawn as of glass, and
;;;; what is behind them dashed, as in technical drawing.

(in-package :supergrip-draw)

(defvar *view* nil "The view being drawn.")
(defvar *small* nil "True in small views, which have fewer words.")

(defvar *crowded* nil "True if contacts are so near that their signs must be small.")

(defvar *face-names* '() "Names of faces and their rectangles, to be written if nothing is there.")

(defun at (vector) "Return the point of VECTOR in the view." (project *view* vector))
(defun face-turned (face) (facing (face-normal face) (view-camera *view*)))

(defun silhouette (subject)
  "Return the outline of what is shown of the box, as seen."
  (hull (mapcar #'at (box-corners (subject-low subject) (subject-high subject)))))

;;; Solids other than the box: plates

(defun draw-plate (low high class &key hatched)
  "Draw the faces of the plate from LOW to HIGH that are turned to the viewer."
  (dolist (face '(0 1 2 3 4 5))
    (when (= 1 (face-turned face))
      (let ((outline (mapcar #'at (face-corners face low high))))
        (draw-polygon outline class)
        (note-strokes (append outline (list (first outline))))
        (when hatched (draw-hatching outline))))))

(defun draw-environment (subject)
  "Draw what constrains faces that are turned away or seen edge-on."
  (dolist (face (subject-blocked subject))
    (when (and (shown-face-p face subject) (< (face-turned face) 1))
      (multiple-value-bind (low high) (plate-corners face subject)
        (draw-plate low high "plate" :hatched t)
        (unless *small*
          (ask-for-label (format nil "~a constrained" (funcall (subject-namer subject) face))
                         (plate-label-point face low high subject) :class "soft" :away 3
                         :leader t))))))

(defun plate-label-point (face low high subject)
  "Return a point of the plate of FACE that the box does not hide, as low in the picture as may be."
  (let* ((outline (silhouette subject))
         (corners (mapcar #'at (face-corners face low high)))
         (middles (loop for (a b) on (append corners (list (first corners)))
                        while b collect (along a b 0.5) collect a)))
    (first (sort (or (remove-if (lambda (point) (point-inside-p point outline)) middles) middles)
                 #'> :key #'second))))

(defun point-inside-p (point outline)
  "True if POINT lies inside OUTLINE, convex."
  (inside-part point (mapcar (lambda (x) (+ x 1d-3)) point) outline))

;;; The box

(defun edges (subject)
  "Return the edges of what is shown of the box: pairs of ends, each with its two faces."
  (let ((edges '()))
    (loop for f in '(0 1 2 3 4 5)
          do (loop for g in '(0 1 2 3 4 5)
                   when (and (< f g) (/= (face-axis f) (face-axis g)))
                     do (let ((ends (intersection
                                     (face-corners f (subject-low subject) (subject-high subject))
                                     (face-corners g (subject-low subject) (subject-high subject))
                                     :test #'equal)))
                          (push (list (first ends) (second ends) f g) edges))))
    edges))

(defun edge-kind (subject f g)
  "Return how the edge between the faces F and G is drawn: as an :EDGE, :BROKEN off, :HIDDEN, or not
at all."
  (cond ((and (< (face-turned f) 1) (< (face-turned g) 1))
         (and (minusp (face-turned f)) (minusp (face-turned g))
              (shown-face-p f subject) (shown-face-p g subject)
              :hidden))
        ((and (shown-face-p f subject) (shown-face-p g subject)) :edge)
        (t :broken)))

(defun draw-edges (subject kind)
  "Draw the edges of KIND of what is shown of the box."
  (loop for (a b f g) in (edges subject)
        when (eq kind (edge-kind subject f g))
          do (note-strokes (list (at a) (at b)))
             (if (eq kind :broken)
                 (draw-path (broken-line (at a) (at b)) "thin")
                 (draw-line (at a) (at b) (string-downcase kind)))))

(defun draw-outline (subject)
  "Draw the edges of the box that can be seen, and where the drawing is broken off."
  (draw-edges subject :broken)
  (draw-edges subject :edge))

(defun broken-line (a b)
  "Return the points of the line along which a drawing is broken off, from A to B."
  (let* ((length (distance a b))
         (count (if (< length 24) 1 (* 2 (round length 18)))))
    (append (list a)
            (loop for i from 1 below count
                  for (x y) = (along a b (/ i count))
                  for side = (/ (if (evenp i) -3 3) length)
                  collect (list (+ x (* side (- (second a) (second b))))
                                (+ y (* side (- (first b) (first a))))))
            (list b))))

(defun draw-faces (subject)
  "Draw the faces of the box that are turned to the viewer, constrained ones hatched."
  (dolist (face '(0 1 2 3 4 5))
    (when (= 1 (face-turned face))
      (let ((outline (mapcar #'at (face-corners face (subject-low subject)
                                                (subject-high subject)))))
        (draw-polygon outline "face")
        (when (and (shown-face-p face subject) (member face (subject-blocked subject)))
          (draw-polygon outline "blocked")
          (draw-hatching outline))))))

(defun name-faces (subject)
  "Write its name on each face that is turned to the viewer, if there is room."
  (dolist (face '(0 1 2 3 4 5))
    (when (and (= 1 (face-turned face)) (shown-face-p face subject))
      (let* ((corners (mapcar #'at (face-corners face (subject-low subject)
                                                 (subject-high subject))))
             (blocked (member face (subject-blocked subject)))
             (name (funcall (subject-namer subject) face)))
        (if blocked
            (let* ((centre (middle (silhouette subject)))
                   (edge (farthest-edge corners centre)))
              (ask-for-label (format nil "~a constrained" name) edge
                             :class "soft" :away 6 :leader t :toward (direction centre edge)))
            (let ((place (face-name-place name corners)))
              (when place
                (push (list name place) *face-names*))))))))

(defun farthest-edge (corners point)
  "Return the middle of that edge of the outline CORNERS that is farthest from POINT."
  (first (sort (loop for (a b) on (append corners (list (first corners)))
                     while b collect (along a b 0.5d0))
               #'> :key (lambda (middle) (distance middle point)))))

(defun face-name-place (name corners)
  "Return a rectangle inside the outline CORNERS where NAME can stand, near a corner, or NIL."
  (let ((centre (middle corners)))
    (loop for part in '(0.72 0.6 0.45 0.3 0.0)
          do (dolist (corner corners)
               (let ((place (label-rectangle name (along centre corner part) "soft" '(0 0) 0)))
                 (when (and (every (lambda (point) (point-inside-p point corners))
                                   (outline-of place))
                            (zerop (crossings place))
                            (notany (lambda (other) (overlap-p place other)) *obstacles*))
                   (return-from face-name-place place)))))))

;;; The hand

(defun beyond-visible-face-p (a b subject)
  "True if the segment from A to B lies beyond a face that is turned to the viewer, or beside the
box as seen edge-on, so that the box can't hide it."
  (some (lambda (face)
          (let ((axis (face-axis face)) (sign (face-sign face)))
            (and (>= (face-turned face) 0)
                 (every (lambda (end)
                          (>= (* sign (nth axis end))
                              (- (* sign (nth axis (if (plusp sign)
                                                       (subject-high subject)
                                                       (subject-low subject))))
                                 1d-9)))
                        (list a b)))))
        '(0 1 2 3 4 5)))

(defun draw-behind (a b outline)
  "Draw the part of a finger from the point A to B, which the box hides where it is inside OUTLINE."
  (multiple-value-bind (from to) (inside-part a b outline)
    (if (null from)
        (draw-finger-line (list a b))
        (progn
          (when (> from 0.02) (draw-finger-line (list a (along a b from))))
          (when (< to 0.98) (draw-finger-line (list (along a b to) b)))
          (draw-line (along a b from) (along a b to) "behind")))))

(defun draw-finger-line (points)
  (draw-path points "finger")
  (draw-path points "core"))

(defun draw-fingers (subject where)
  "Draw the fingers' segments that are :BEHIND the box, or in :FRONT of it."
  (let ((outline (silhouette subject)))
    (dolist (contact (subject-contacts subject))
      (let ((run '()))
        (flet ((end-run ()
                 (when (rest run)
                   (note-strokes run 7)
                   (draw-finger-line run))
                 (setf run '())))
          (loop for (a b) on (shortened-path contact)
                while b
                do (if (beyond-visible-face-p a b subject)
                       (when (eq where :front)
                         (unless run (setf run (list (at a))))
                         (push (at b) run))
                       (progn
                         (end-run)
                         (when (eq where :behind)
                           (note-strokes (list (at a) (at b)) 7)
                           (draw-behind (at a) (at b) outline)))))
          (end-run))))))

(defun shortened-path (contact)
  "Return the path of CONTACT without its last bit, which the fingertip's cone takes."
  (let* ((path (contact-path contact))
         (tip (first (last path)))
         (before (first (last path 2)))
         (length (max 1d-9 (distance tip before)))
         (bit (min 0.9 (/ (* 0.8 (tip-size)) (view-scale *view*) length))))
    (append (butlast path) (list (along tip before bit)))))

(defun tip-size () (if *small* 10 15))

(defun draw-tip (contact)
  "Draw the fingertip of CONTACT, a cone along the inward normal, and the contact at its apex."
  (let* ((face (contact-face contact))
         (hidden (minusp (face-turned face)))
         (apex (at (contact-position contact)))
         (base (at (v+ (contact-position contact) (face-normal face))))
         (length (distance apex base))
         (title (contact-title contact)))
    (if (< length (* 0.12 (view-scale *view*)))
        (draw-end-on apex hidden title)
        (let* ((back (along apex base (/ (tip-size) length)))
               (across (list (/ (- (second base) (second apex)) length)
                             (/ (- (first apex) (first base)) length)))
               (width (* 0.36 (tip-size))))
          (note-strokes (list apex back) (* 2 width))
          (draw-polygon (list apex
                              (mapcar (lambda (b c) (+ b (* width c))) back across)
                              (mapcar (lambda (b c) (- b (* width c))) back across))
                        (if hidden "tip-hidden" "tip"))
          (draw-circle apex (cond (*crowded* 1.3) (*small* 2.2) (t 3))
                       (if hidden "contact-hidden" "contact") :title title)))))

(defun draw-end-on (apex hidden title)
  "Draw a contact whose normal is seen end-on: a cross if it points away, a dot if to the viewer."
  (let ((d 3.6))
    (draw-circle apex 6 "tip-hidden")
    (unless hidden
      (loop for (x y) in '((1 1) (1 -1))
            do (draw-line (list (- (first apex) (* d x)) (- (second apex) (* d y)))
                          (list (+ (first apex) (* d x)) (+ (second apex) (* d y))) "edge")))
    (draw-circle apex 2.2 (if hidden "contact-hidden" "contact") :title title)))

(defun place-text (vector)
  "Return VECTOR, in cm, for a reader, in *UNITS*."
  (format nil "(~{~a~^, ~})"
          (if *units*
              (mapcar (lambda (number) (quantity (in-units number :length) 4)) vector)
              (mapcar #'decimal vector))))

(defun contact-title (contact)
  (format nil "Finger ~a on ~a at ~a" (contact-finger contact)
          (face-name (contact-face contact))
          (with-unit (place-text (contact-position contact)) :length)))

(defun label-anchor (contact)
  "Return the point of the label of CONTACT: the knee of its finger, or a place on a straight one."
  (let* ((path (contact-path contact))
         (apex (at (contact-position contact)))
         (knee (at (first (last path 2)))))
    (if (= 2 (length path)) (along apex knee 0.35) knee)))

(defun direction (from to)
  "Return the direction FROM one point TO another, or NIL if they are too near."
  (let ((length (distance from to)))
    (and (> length 4) (mapcar (lambda (a b) (/ (- b a) length)) from to))))

(defun outward (apex anchor middle)
  "Return the direction in which the label at ANCHOR had best stand: on from APEX, the contact, or,
where there is room for more than numbers, also away from the MIDDLE of the others; or NIL."
  (let ((on (direction apex anchor))
        (away (direction middle anchor)))
    (if (and on away (not *small*))
        (direction '(0 0) (mapcar (lambda (a b) (+ (* 10 a) (* 10 b))) on away))
        (or on away))))

(defun contact-label (contacts subject)
  (if *small*
      (format nil "~{~a~^, ~}" (mapcar #'contact-finger contacts))
      (format nil "~{~a~^, ~} on ~a" (mapcar #'contact-finger contacts)
              (funcall (subject-namer subject) (contact-face (first contacts))))))

(defun label-contacts (subject)
  "Ask for the labels of the fingers; those that are seen in one place have one label."
  (let ((left (subject-contacts subject))
        (middle (and (subject-contacts subject)
                     (middle (mapcar #'label-anchor (subject-contacts subject))))))
    (loop while left
          do (let* ((first (first left))
                    (anchor (label-anchor first))
                    (apex (at (contact-position first)))
                    (same (remove-if-not
                           (lambda (other)
                             (and (= (contact-face other) (contact-face first))
                                  (< (distance anchor (label-anchor other)) 9)))
                           left)))
               (ask-for-label (contact-label same subject)
                              (if (< (distance anchor apex) 1) apex anchor)
                              :class "bold" :away 7 :leader t
                              :toward (outward apex anchor middle))
               (setf left (remove-if (lambda (contact) (member contact same)) left))))))

(defun draw-approach (subject)
  "Draw the hollow arrow along which the hand comes."
  (destructuring-bind (tail tip) (mapcar #'at (arrow-ends subject))
    (let ((length (distance tail tip)))
      (when (> length 8)
        (let* ((along-unit (mapcar (lambda (a b) (/ (- a b) length)) tip tail))
               (across (list (- (second along-unit)) (first along-unit)))
               (neck (- length (min 14 (* 0.6 length)))))
          (flet ((place (way side)
                   (mapcar (lambda (p a c) (+ p (* way a) (* side c))) tail along-unit across)))
            (let ((outline (list (place 0 4) (place neck 4) (place neck 10) (place length 0)
                                 (place neck -10) (place neck -4) (place 0 -4))))
              (draw-polygon outline "approach")
              (occupy-area (hull outline))
              (unless *small*
                (ask-for-label "approach" (along tail tip 0.4) :class "soft" :away 12
                               :toward '(-1 0) :optional t)))))))))

(defun draw-palm (subject)
  "Draw the palm's plate, and ask for its label."
  (draw-plate (subject-palm-low subject) (subject-palm-high subject) "palm")
  (let ((corners (hull (mapcar #'at (box-corners (subject-palm-low subject)
                                                 (subject-palm-high subject))))))
    (occupy-area corners)
    (unless *small*
      (label-palm subject corners))))

(defun label-palm (subject corners)
  "Ask for the label of the palm, whose outline is CORNERS, on the far side from the box."
  (ask-for-label (format nil "palm, over ~a"
                         (funcall (subject-namer subject) (subject-palm subject)))
                 (append corners
                         (loop for (a b) on (append corners (list (first corners)))
                               while b collect (along a b 1/2)))
                 :away 6 :leader t
                 :toward (direction (middle (silhouette subject)) (middle corners))))

;;; Centres and weight

(defun draw-arrow (a b)
  "Draw an arrow of force from the point A to B."
  (let ((length (distance a b)))
    (when (> length 6)
      (let* ((back (along b a (/ 10 length)))
             (across (list (/ (- (second b) (second a)) length)
                           (/ (- (first a) (first b)) length))))
        (draw-line a back "force")
        (note-strokes (list a b) 5)
        (draw-polygon (list b (mapcar (lambda (p c) (+ p (* 4.5 c))) back across)
                            (mapcar (lambda (p c) (- p (* 4.5 c))) back across))
                      "force-tip")))))

(defun draw-weight (subject)
  "Draw the weight: an arrow from the centre of mass down."
  (when (weight-shown-p subject)
    (destructuring-bind (from to) (mapcar #'at (weight-ends subject))
      (draw-arrow from to)
      (unless (near-contact-p from subject)
        (draw-circle from 2.6 "force-tip"))
      (occupy-around to 7)
      (unless *small*
        (ask-for-label (subject-load subject) to :away 9 :toward '(0.9 0.4) :leader t)))))

(defun draw-closing (subject)
  "Draw a chain line between fingers that oppose each other."
  (loop for (a b) in (closing-pairs subject)
        do (when (> (distance (at a) (at b)) 10)
             (draw-line (at a) (at b) "centre")
             (note-strokes (list (at a) (at b))))))

(defun draw-cross (point)
  (destructuring-bind (x y) point
    (draw-line (list (- x 5) y) (list (+ x 5) y) "edge")
    (draw-line (list x (- y 5)) (list x (+ y 5)) "edge")))

(defun near-contact-p (point subject)
  "True if a contact of SUBJECT is so near POINT that a sign there would cover it."
  (some (lambda (contact) (< (distance point (at (contact-position contact))) 7))
        (subject-contacts subject)))

(defun crowded-p (subject)
  "True if contacts of SUBJECT on different faces are seen as one point."
  (loop for (one . others) on (subject-contacts subject)
        thereis (loop for other in others
                      thereis (and (/= (contact-face one) (contact-face other))
                                   (< (distance (at (contact-position one))
                                                (at (contact-position other)))
                                      9)))))

(defun draw-centre (subject)
  "Draw the grasp centre, a cross, and its offset from the box centre."
  (let* ((centre (at (subject-centre subject)))
         (origin (at '(0d0 0d0 0d0)))
         (offset (distance (subject-centre subject) '(0d0 0d0 0d0))))
    (unless (near-contact-p centre subject)
      (draw-cross centre)
      (occupy-around centre 5))
    (when (and (> offset 1d-9) (centre-shown-p subject))
      (draw-line origin centre "thin")
      (draw-circle origin 2.6 "force-tip")
      (note-strokes (list origin centre)))
    (unless (or *small* (not (subject-labelled subject)))
      (ask-for-label (if (> offset 1d-9)
                         (format nil "grasp centre, offset ~a"
                                 (with-unit (length-text offset) :length))
                         "grasp centre")
                     centre :away 7 :class "soft" :leader t))))

;;; All of it

(defun draw-subject (subject view &key small)
  "Draw SUBJECT in VIEW; the labels wait for PLACE-LABELS."
  (let* ((*view* view) (*small* small) (*face-names* '()) (*crowded* (crowded-p subject)))
    (with-group (:class "view" :description (view-description view))
      (dolist (contact (subject-contacts subject))
        (occupy-around (at (contact-position contact)) 7))
      (draw-environment subject)
      (draw-edges subject :hidden)
      (when (subject-palm subject)
        (let ((palm-front (beyond-visible-face-p (subject-palm-low subject)
                                                 (subject-palm-high subject) subject)))
          (unless palm-front (draw-palm subject) (draw-approach subject))
          (draw-fingers subject :behind)
          (draw-faces subject)
          (draw-tips subject -1)
          (draw-outline subject)
          (draw-closing subject)
          (draw-centre subject)
          (draw-weight subject)
          (draw-fingers subject :front)
          (draw-tips subject 0)
          (draw-ghosts subject)
          (when palm-front (draw-palm subject) (draw-approach subject))))
      (unless (subject-palm subject)
        (draw-faces subject)
        (draw-outline subject)
        (draw-weight subject))
      (label-contacts subject)
      (unless small
        (name-faces subject)
        (loop for (name place) in *face-names*
              do (occupy place)
                 (put-label name place "soft"))))))

(defun draw-ghosts (subject)
  "Draw where the fingers of SUBJECT were, and the way from there."
  (loop for ghost in (subject-ghosts subject)
        for contact in (subject-contacts subject)
        do (draw-line (at ghost) (at (contact-position contact)) "thin")
           (draw-circle (at ghost) 5 "thin")))

(defun draw-tips (subject least)
  "Draw the fingertips on faces that are turned away (LEAST -1), or that are not (0)."
  (dolist (contact (subject-contacts subject))
    (let ((turned (face-turned (contact-face contact))))
      (when (if (minusp least) (minusp turned) (>= turned 0))
        (draw-tip contact)))))

(defun view-description (view)
  "Return what VIEW is, in words: enough to find where any place of the box frame is seen."
  (let ((camera (view-camera view))
        (scale (/ (view-scale view) (in-units 1 :length))))
    (flet ((plain (number digits) (fixed number digits #\-)))
      (format nil "Seen from azimuth ~d°, elevation ~d°, ~a above; ~a units a ~a; box centre at ~
                   (~a, ~a)."
              (camera-azimuth camera) (camera-elevation camera)
              (face-name (camera-top camera))
              (plain scale (max 0 (- 6 (magnitude scale))))
              (unit-text-of :length)
              (plain (first (view-origin view)) 3) (plain (second (view-origin view)) 3)))))

;;; Furniture

(defun nice-length (most)
  "Return the greatest of 1, 2, 5, 10 ... (and their tenths) that is not above MOST."
  (loop with power = (expt 10d0 (floor (log most 10)))
        for factor in '(5 2 1)
        when (<= (* factor power) most) return (* factor power)))

(defun draw-scale-bar (scale point)
  "Draw a bar of a round length, in *UNITS*, at SCALE units a cm, its left end at POINT."
  (let* ((scale (/ scale (in-units 1 :length)))
         (length (nice-length (/ 110 scale)))
         (x (first point)) (y (second point)) (end (+ x (* length scale))))
    (draw-line point (list end y) "edge")
    (dolist (at (list x end))
      (draw-line (list at (- y 4)) (list at (+ y 4)) "edge"))
    (occupy (list x (- y 5) (- end x) 10))
    (draw-text (with-unit (quantity length) :length) (list x (+ y 18)))))

(defun draw-axes (camera point names &optional (length 30))
  "Draw the three axes, called NAMES, at POINT."
  (let ((view (make-view :camera camera :scale length :origin point)))
    (loop for axis below 3
          for name in names
          for end = (project view (axis-vector axis))
          do (when (> (distance point end) 4)
               (draw-axis point end)
               (let* ((way (distance point end))
                      (beyond (along point end (/ (+ way 10) way))))
                 (draw-text name (list (first beyond) (+ 4 (second beyond)))
                            :class "soft" :anchor :middle))))))

(defun draw-axis (a b)
  "Draw an axis from A to B with an open arrow."
  (let* ((length (distance a b))
         (back (along b a (min 0.5 (/ 7 length))))
         (across (list (/ (- (second b) (second a)) length) (/ (- (first a) (first b)) length))))
    (draw-line a b "thin")
    (draw-path (list (mapcar (lambda (p c) (+ p (* 3 c))) back across) b
                     (mapcar (lambda (p c) (- p (* 3 c))) back across))
               "thin")))
