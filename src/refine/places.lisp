;;;; places.lisp -- where the fingers of a candidate may stand: its legal places.
;;;;
;;;; A placement is three numbers a finger, its place along X Y Z from the box centre, in cm.  Legal
;;;; is one that keeps every finger on its face, half a FINGER-WIDTH from the edges; no deeper under
;;;; the palm than OFFSET says that the hand reaches; within the hand's room between two constrained
;;;; faces; fingers on one face between FINGER-WIDTH and FINGER-SPREAD apart; opposed fingers within
;;;; half a FINGER-SPREAD of each other; fingers on adjacent faces within DIST-PINCH.  Where
;;;; CONTACTS and OFFSET ask more of the hand than these limits, the hand can do as much as they
;;;; ask.

(in-package :supergrip)

(deftype doubles () '(simple-array double-float (*)))

(defstruct (limit-between (:constructor make-limit-between (one two skip least most)))
  "The fingers ONE and TWO are LEAST to MOST cm apart, the axis SKIP, 0 to 2 or NIL, left out."
  (one 0 :type fixnum) (two 0 :type fixnum) (skip nil) (least 0d0 :type double-float)
  (most 0d0 :type double-float))

(defstruct (freedom (:copier nil))
  "Where COUNT fingers may stand.  FACES are the box faces that they are on; HOME is the placement
of the plan, LOW and HIGH its limits, BETWEEN a list of LIMIT-BETWEENs."
  (count 0 :type fixnum) (faces '() :type list)
  (home nil :type doubles) (low nil :type doubles) (high nil :type doubles)
  (between '() :type list))

(defun finger-distance (placement one two skip)
  "Return how far apart the fingers ONE and TWO are in PLACEMENT, the axis SKIP left out, in cm."
  (declare (type doubles placement) (fixnum one two))
  (let ((sum 0d0))
    (declare (type (double-float 0d0) sum))
    (dotimes (axis 3 (sqrt sum))
      (unless (eql axis skip)
        (let ((way (- (aref placement (+ (* 3 one) axis)) (aref placement (+ (* 3 two) axis)))))
          (incf sum (* way way)))))))

(defun within-p (least number most)
  "True if NUMBER is between LEAST and MOST, but for rounding."
  (let ((little (* 1d-9 (+ 1d0 (abs number)))))
    (<= (- least little) number (+ most little))))

(defun within-limit-p (placement limit)
  "True if the fingers of LIMIT are as far apart in PLACEMENT as it says."
  (within-p (limit-between-least limit)
            (finger-distance placement (limit-between-one limit) (limit-between-two limit)
                             (limit-between-skip limit))
            (limit-between-most limit)))

(defun legal-placement-p (placement freedom)
  "True if PLACEMENT is legal, but for rounding."
  (and (every #'within-p (freedom-low freedom) placement (freedom-high freedom))
       (loop for limit in (freedom-between freedom) always (within-limit-p placement limit))))

;;; The limits

(defun reach-along (axis candidate workspace)
  "Return how far the hand reaches along the grasp's AXIS, 0 to 2, from the face that it comes over,
in cm, and the side of that face, 1 or -1; NIL if it reaches through the whole box.  OFFSET says so
of a box that is twice as long: its middle lies as deep as the far face of this one."
  (let* ((registers (workspace-registers workspace))
         (program (grasp-offset (%candidate-grasp candidate)))
         (length (aref (workspace-lengths workspace) axis))
         (centre (aref (workspace-centre workspace) axis)))
    (setf (aref registers (+ +distances+ axis)) (* 2 length))
    (let* ((known (execute program registers))
           (shift (aref registers (aref (program-results program) (* 2 axis)))))
      (setf (aref registers (+ +distances+ axis)) length)
      (cond ((not (and known (finite-p shift)))
             (unless (zerop centre) (values (- (/ length 2) (abs centre)) (signum centre))))
            ((not (zerop shift)) (values (- length (abs shift)) (signum shift)))))))

(defun limit-coordinate (freedom axis low high)
  "Let no finger of FREEDOM be below LOW or above HIGH along AXIS, 0 to 2, unless it is at home
there."
  (loop for place from axis below (* 3 (freedom-count freedom)) by 3
        for home = (aref (freedom-home freedom) place)
        do (setf (aref (freedom-low freedom) place)
                 (max (aref (freedom-low freedom) place) (min low home))
                 (aref (freedom-high freedom) place)
                 (min (aref (freedom-high freedom) place) (max high home)))))

(defun limit-by-edges (freedom size width)
  "Keep the fingers of FREEDOM, tips WIDTH wide, on their faces of a box of SIZE.  Where a face is
narrower than a tip, that is in its middle."
  (loop for face in (freedom-faces freedom)
        for finger from 0
        do (dotimes (axis 3)
             (let ((place (+ (* 3 finger) axis)) (half (/ (aref size axis) 2)))
               (multiple-value-bind (low high)
                   (if (= axis (face-axis face))
                       (let ((height (* (face-sign face) half))) (values height height))
                       (let ((room (max 0d0 (- half (/ width 2))))) (values (- room) room)))
                 (setf (aref (freedom-low freedom) place) low
                       (aref (freedom-high freedom) place) high))))))

(defun limit-by-reach (freedom candidate workspace)
  "Keep the fingers of FREEDOM no deeper than the hand of CANDIDATE reaches."
  (let ((matching (%candidate-matching candidate)))
    (dotimes (axis 3)
      (multiple-value-bind (reach side) (reach-along axis candidate workspace)
        (when reach
          (let* ((box-axis (aref (matching-axes matching) axis))
                 (side (* side (aref (matching-signs matching) axis)))
                 (deepest (* side (- (/ (aref (workspace-lengths workspace) axis) 2) reach))))
            (if (plusp side)
                (limit-coordinate freedom box-axis deepest 1d300)
                (limit-coordinate freedom box-axis -1d300 deepest))))))))

(defun limit-by-room (freedom box width spread)
  "Where both faces along an axis of BOX are constrained, keep a hand WIDTH wide, whose fingers are
up to half a SPREAD from its middle, between them."
  (loop for axis below 3
        for face in '(5 3 1)
        when (and (logbitp face (%box-constrained box))
                  (logbitp (opposite face) (%box-constrained box)))
          do (let ((most (+ (max 0d0 (/ (- (aref (%box-size box) axis) width) 2)) (/ spread 2))))
               (limit-coordinate freedom axis (- most) most))))

(defun limits-between (freedom width spread opening)
  "Return the LIMIT-BETWEENs of FREEDOM for a hand with the FINGER-WIDTH, the FINGER-SPREAD and the
DIST-PINCH given, in cm."
  (loop for (face . others) on (freedom-faces freedom)
        for one from 0
        append (loop for other in others
                     for two from (1+ one)
                     collect (let* ((skip (and (= face (opposite other)) (face-axis face)))
                                    (now (finger-distance (freedom-home freedom) one two skip)))
                               (multiple-value-bind (least most)
                                   (cond ((= face other) (values (min width now) spread))
                                         (skip (values 0d0 (/ spread 2)))
                                         (t (values 0d0 opening)))
                                 (make-limit-between one two skip least (max most now)))))))

(defun placement-of (contacts)
  "Return the placement of CONTACTS, plists."
  (coerce (loop for contact in contacts append (getf contact :position)) 'doubles))

(defun stay-where-nothing-is-legal (freedom)
  "Let the fingers of FREEDOM stay at home along an axis on which no place is legal."
  (map-into (freedom-low freedom) (lambda (low high home) (if (<= low high) low home))
            (freedom-low freedom) (freedom-high freedom) (freedom-home freedom))
  (map-into (freedom-high freedom) #'max (freedom-low freedom) (freedom-high freedom)))

(defun freedom-of (candidate workspace graspbase)
  "Return the FREEDOM of the fingers of CANDIDATE, of a hand with the dimensions of GRASPBASE, whose
figures WORKSPACE holds."
  (let* ((box (workspace-box workspace))
         (home (placement-of (contacts-of candidate workspace)))
         (faces (loop for (grasp-face) in (grasp-contacts (%candidate-grasp candidate))
                      collect (svref (matching-faces (%candidate-matching candidate)) grasp-face)))
         (freedom (make-freedom :count (length faces) :faces faces :home home
                                :low (copy-seq home) :high (copy-seq home))))
    ;; A hand that lacks a dimension is given no room by it: where its fingers stand is all it does.
    (flet ((dimension (name) (or (dimension graspbase name) 0d0)))
      (limit-by-edges freedom (%box-size box) (dimension "FINGER-WIDTH"))
      (limit-by-reach freedom candidate workspace)
      (limit-by-room freedom box (dimension "WIDTH-HAND") (dimension "FINGER-SPREAD"))
      (stay-where-nothing-is-legal freedom)
      (setf (freedom-between freedom)
            (limits-between freedom (dimension "FINGER-WIDTH") (dimension "FINGER-SPREAD")
                            (dimension "DIST-PINCH"))))
    freedom))

;;; Into the limits

(defun clamp (placement freedom)
  (map-into placement (lambda (low number high) (max low (min number high)))
            (freedom-low freedom) placement (freedom-high freedom)))

(defun part-fingers (placement limit)
  "Move the two fingers of LIMIT in PLACEMENT, along the line between them, a little inside its
limits.  True if they were outside."
  (let* ((one (* 3 (limit-between-one limit))) (two (* 3 (limit-between-two limit)))
         (skip (limit-between-skip limit))
         (apart (finger-distance placement (floor one 3) (floor two 3) skip))
         (goal (cond ((> apart (limit-between-most limit))
                      (* (limit-between-most limit) (- 1d0 1d-9)))
                     ((< apart (limit-between-least limit))
                      (* (limit-between-least limit) (+ 1d0 1d-9))))))
    (when goal
      (dotimes (axis 3 t)
        (unless (eql axis skip)
          (let ((move (if (plusp apart)
                          (* (/ (- goal apart) apart 2)
                             (- (aref placement (+ two axis)) (aref placement (+ one axis))))
                          (/ goal 4))))
            (incf (aref placement (+ two axis)) move)
            (decf (aref placement (+ one axis)) move)))))))

(defun make-legal (placement freedom)
  "Move the fingers of PLACEMENT to legal places nearby.  Return it, or NIL if that was not
possible."
  (clamp placement freedom)
  (loop repeat 40
        do (let ((moved nil))
             (dolist (limit (freedom-between freedom))
               (when (part-fingers placement limit) (setf moved t)))
             (unless moved (return))
             (clamp placement freedom)))
  (and (legal-placement-p placement freedom) placement))
