;;;; refined-places.lisp -- a judge of refined grasps: where fingers may stand, and what they gain.
;;;;
;;;; It shares nothing with src/refine/.  Its limits are those of docs/refining.md, "Where a finger
;;;; may stand", from the contacts of a shipped grasp alone.  `sbcl --script t/study.lisp legal`
;;;; judges many refined grasps.  The tests here spoil placements, and see each refused.

(in-package :supergrip-test)
(define-suite refined-places
  "A judge of refined grasps: where fingers may stand, and what they gain.")

;;; Faces and lengths

(defun gripper-length (name)
  (rest (assoc name (supergrip:knowledge-gripper supergrip:*knowledge*) :test #'string=)))

(defun face-normal-axis (face) (position (char face 0) "XYZ"))
(defun side-of (face) (if (char= (char face 1) #\1) 1 -1))
(defun other-side (face) (format nil "~a~a" (char face 0) (if (= 1 (side-of face)) 2 1)))

(defun place-along (axis contact) (nth axis (getf contact :position)))

(defun over-p (number most)
  "True if NUMBER, in cm, is above MOST by more than rounding."
  (> number (+ most 1d-7)))

;;; Each finger

(defun edge-fault (contact home size)
  "Return what is wrong with the place of CONTACT, which was HOME, on its face of a box of SIZE, or
NIL."
  (let ((face (getf contact :surface)) (width (gripper-length "FINGER-WIDTH")))
    (if (and (equal face (getf home :surface)) (equal (getf contact :normal) (getf home :normal)))
        (loop for axis below 3
              for half in (mapcar (lambda (s) (/ s 2)) size)
              for place = (place-along axis contact)
              thereis (if (= axis (face-normal-axis face))
                          (unless (close-to place (* (side-of face) half))
                            "off its face")
                          (when (over-p (abs place) (max 0 (- half (/ width 2))))
                            "too near an edge")))
        "on another face")))

(defun reaches (grasp matching size)
  "Return how far the hand of GRASP, a shipped one, reaches from which face: a list of (FACE CM)."
  (flet ((face (name) (nth (position name '(n1 n2 o1 o2 a1 a2)) matching)))
    (let* ((d (nth (face-normal-axis (face 'n1)) size)) (link (gripper-length "FINGER-LENGTH"))
           (base (gripper-length "FINGER-DIST"))
           (inner (if (> base d) (sqrt (- (expt link 2) (expt (/ (- d base) 2) 2))) 0)))
      (cond ((search "U-SHAPE" grasp)
             `((,(face 'n2) ,(gripper-length "REACH-U")) (,(face 'a2) ,(gripper-length "REACH-U"))))
            ((search "C-SHAPE" grasp)
             `((,(face 'o2) ,(gripper-length "REACH-C")) (,(face 'a2) ,(gripper-length "REACH-C"))))
            ((search "-PARALLEL" grasp) `((,(face 'a2) ,(+ link inner))))))))

(defun depth-fault (contact home grasp matching size)
  "Return that CONTACT is deeper than the hand of GRASP in MATCHING reaches, and than its HOME, or
NIL."
  (loop for (face reach) in (reaches grasp matching size)
        for axis = (face-normal-axis face)
        thereis (flet ((depth (contact)
                         (- (/ (nth axis size) 2) (* (side-of face) (place-along axis contact)))))
                  (when (over-p (depth contact) (max reach (depth home)))
                    "too deep"))))

(defun room-fault (contact home box)
  "Return that a hand with the finger of CONTACT, which was at HOME, has no room between two
constrained faces of BOX, or NIL."
  (loop for face in '("X1" "Y1" "Z1")
        for axis from 0
        for length = (nth axis (supergrip:box-size box))
        for room = (max 0 (/ (- length (gripper-length "WIDTH-HAND")) 2))
        thereis (and (subsetp (list face (other-side face)) (supergrip:box-constrained box)
                              :test #'string=)
                     (over-p (abs (place-along axis contact))
                             (max (+ room (/ (gripper-length "FINGER-SPREAD") 2))
                                  (abs (place-along axis home))))
                     "without room for the hand")))

;;; Every two fingers

(defun apart (one two)
  "Return how far the contacts ONE and TWO are apart, in cm, the axis of opposite faces left out."
  (let ((skip (and (equal (getf one :surface) (other-side (getf two :surface)))
                   (face-normal-axis (getf one :surface)))))
    (norm (loop for axis below 3
                collect (if (eql axis skip)
                            0
                            (- (place-along axis one) (place-along axis two)))))))

(defun distance-fault (one two home-one home-two)
  "Return what is wrong with the distance of the contacts ONE and TWO, which were HOME-ONE and
HOME-TWO, or NIL.  The homes show what the hand can do at least."
  (let ((home (apart home-one home-two)) (spread (gripper-length "FINGER-SPREAD")))
    (flet ((beyond-p (most) (over-p (apart one two) (max most home))))
      (cond ((equal (getf one :surface) (getf two :surface))
             (cond ((over-p (min (gripper-length "FINGER-WIDTH") home) (apart one two))
                    "on one face too near each other")
                   ((beyond-p spread) "on one face too far apart")))
            ((equal (getf one :surface) (other-side (getf two :surface)))
             (when (beyond-p (/ spread 2)) "on opposite faces too far apart"))
            ((beyond-p (gripper-length "DIST-PINCH")) "on adjacent faces too far apart")))))

(defun crossing-fault (one two home-one home-two)
  "Return that the fingers of ONE and TWO, on one face, have changed sides since HOME-ONE and
HOME-TWO, or NIL."
  (flet ((way (from to) (mapcar #'- (getf to :position) (getf from :position))))
    (and (equal (getf one :surface) (getf two :surface))
         (minusp (+ 1d-7 (dot (way one two) (way home-one home-two))))
         "crossed")))

(defun placement-faults (contacts homes grasp matching box)
  "Return a list of what is wrong with CONTACTS on BOX, the places of the fingers of GRASP in
MATCHING, which were HOMES."
  (let ((size (supergrip:box-size box)))
    (remove nil
            (append
             (loop for contact in contacts
                   for home in homes
                   collect (edge-fault contact home size)
                   collect (depth-fault contact home grasp matching size)
                   collect (room-fault contact home box))
             (loop for (one . others) on contacts
                   for (home-one . other-homes) on homes
                   append (loop for two in others
                                for home-two in other-homes
                                collect (distance-fault one two home-one home-two)
                                collect (crossing-fault one two home-one home-two)))))))

;;; What is gained

(defun contacts-case (contacts box)
  "Return the case of CONTACTS, plists, with the task of BOX, as EXACT-RADIUS-OF takes it."
  (list (loop for contact in contacts
              collect (list (getf contact :position) (getf contact :normal)))
        (supergrip:box-friction box) (supergrip:box-soft-friction box)
        (coerce (supergrip:box-force-needed box) 'list) (supergrip:box-gravity box)))

(defun radius-anew (contacts box)
  "Return the exact radius of CONTACTS on BOX, the upper value and the certified one, or 0: computed
from nothing, closer than REFINE does it."
  (loop for (gap absolute) in '((2d-4 1d-5) (1d-2 1d-3))
        for (upper lower) = (multiple-value-list
                             (exact-radius-of (contacts-case contacts box)
                                              :gap gap :absolute absolute))
        when lower return (values upper lower)
        finally (return (values upper 0))))

(defun mixed-quality (force velocity gamma)
  "Return the quality of the radii FORCE and VELOCITY, NIL where there is none."
  (cond ((null velocity) force)
        ((null force) velocity)
        (t (+ (* gamma velocity) (* (- 1 gamma) force)))))

(defun quality-anew (radius refinement)
  "Return the exact quality of the grasp of REFINEMENT with the certified RADIUS."
  (mixed-quality (max 0 radius)
                 (supergrip:candidate-velocity-radius (supergrip:refinement-candidate refinement))
                 (supergrip:plan-gamma (supergrip:refinement-plan refinement))))

(defun gain-faults (refinement)
  "Return a list of what is wrong with the radius and the quality that REFINEMENT, whose fingers
have moved, says it has."
  (let ((box (supergrip:plan-box (supergrip:refinement-plan refinement)))
        (contacts (supergrip:refinement-contacts refinement)))
    (multiple-value-bind (upper lower) (radius-anew contacts box)
      (destructuring-bind (sure most) (supergrip:refinement-radius refinement)
        (let ((before (nth-value 1 (radius-anew (supergrip:refinement-home refinement) box)))
              (met (least-ratio-met (contacts-case contacts box) 6)))
          (remove nil
                  (list (when (< (quality-anew lower refinement) (quality-anew before refinement))
                          (format nil "worse: ~,6f, was ~,6f" lower before))
                        (when (or (> sure (+ upper 1d-7)) (> lower (+ most 1d-7)))
                          (format nil "radius ~,6f to ~,6f, anew ~,6f to ~,6f"
                                  sure most lower upper))
                        (when (> sure (+ met 1d-7))
                          (format nil "radius ~,6f, a motion gives ~,6f" sure met))
                        (unless (close-to (supergrip:refinement-quality refinement)
                                          (quality-anew sure refinement))
                          (format nil "quality ~,6f"
                                  (supergrip:refinement-quality refinement))))))))))

(defun refinement-faults (refinement)
  "Return a list of what is wrong with REFINEMENT; fingers that were not moved may stay."
  (let ((candidate (supergrip:refinement-candidate refinement)))
    (and (supergrip:refinement-moved-p refinement)
         (append (placement-faults (supergrip:refinement-contacts refinement)
                                   (supergrip:refinement-home refinement)
                                   (supergrip:candidate-grasp candidate)
                                   (supergrip:candidate-matching candidate)
                                   (supergrip:plan-box (supergrip:refinement-plan refinement)))
                 (gain-faults refinement)))))

;;; Many boxes

(defun plans-to-refine (count)
  "Return a function that gives the plans of COUNT boxes of four kinds that have a grasp, then NIL."
  (let ((state (sb-ext:seed-random-state 11)) (number 0) (found 0))
    (lambda ()
      (when (< found count)
        (loop for maker = (nth (mod number 4) '(random-box table-box household-box rubber-box))
              for plan = (supergrip:plan (laid (funcall maker state) state :pose 25 :centre 25))
              do (incf number)
              when (supergrip:plan-best plan)
                do (incf found)
                   (return plan))))))

(defun print-legal (count)
  "Judge the three best grasps, refined, of COUNT random boxes that have a grasp.  Print what was
found, and progress on the error output.  Return true if there is no fault."
  (let ((grasps 0) (moved 0) (fingers 0) (faults 0) (next (plans-to-refine count)))
    (loop for plan = (funcall next)
          for box from 1
          while plan
          do (dolist (refinement (nth-value 1 (supergrip:refine plan)))
               (incf grasps)
               (when (supergrip:refinement-moved-p refinement)
                 (incf moved)
                 (incf fingers (length (supergrip:refinement-contacts refinement))))
               (loop for fault in (refinement-faults refinement)
                     do (incf faults)
                        (format t "box ~d, ~a: ~a~%" box refinement fault)))
             (when (or (= box count) (zerop (mod box 20)))
               (format *error-output* "~d of ~d boxes, ~d grasps, ~d fault~:p~%"
                       box count grasps faults)
               (finish-output *error-output*)))
    (format t "~d boxes with a grasp, ~d grasps refined: fingers moved in ~d, ~d fingers; ~
               ~d fault~:p~%"
            count grasps moved fingers faults)
    (zerop faults)))

;;; Tests

(defun at (surface x y z)
  "Return the contact of a finger at X Y Z on SURFACE."
  (list :surface surface :position (list x y z)
        :normal (loop for axis below 3
                      collect (if (= axis (face-normal-axis surface)) (- (side-of surface)) 0))))

(defparameter *long-box*
  '((:size 20 5 20) (:weight 0.2d0) (:u 0.8d0) (:v 0.2d0) (:constrained :z2)
    (:force-needed (1 1 1 1 1 1)) (:velocity-needed (1 1 1 1 1 1))))

(defparameter *placements*
  `(("PINCH-3-PARALLEL" ("Y2" "Y1" "X2" "X1" "Z2" "Z1")
     (,(at "Y2" -0.6d0 -2.5d0 4) ,(at "Y2" 0.6d0 -2.5d0 4) ,(at "Y1" 0 2.5d0 4)))
    ("PINCH-3-C-SHAPE" ("Y2" "Y1" "X2" "X1" "Z2" "Z1")
     (,(at "Y2" 6 -2.5d0 6) ,(at "Y1" 6 2.5d0 6) ,(at "X1" 10 0 6)))
    ("PINCH-3-U-SHAPE" ("X2" "X1" "Y2" "Y1" "Z2" "Z1")
     (,(at "Y2" 6 -2.5d0 6) ,(at "Y1" 6 2.5d0 6) ,(at "X1" 10 0 6)))
    ("PINCH-2-ADJACENT" ("X1" "X2" "Z1" "Z2" "Y1" "Y2") (,(at "X1" 10 0 3) ,(at "Z1" 3 0 10)))
    ("PINCH-3-ADJACENT" ("X1" "X2" "Z1" "Z2" "Y1" "Y2")
     (,(at "X1" 10 -0.6d0 3) ,(at "X1" 10 0.6d0 3) ,(at "Z1" 3 0 10))))
  "Grasps of the long box, each with its matching and legal places.")

(defun faults-at (grasp places &key (box *long-box*))
  "Return the faults of GRASP with PLACES, a list of (FINGER AXIS CM), changed in its legal ones."
  (destructuring-bind (matching homes) (rest (assoc grasp *placements* :test #'string=))
    (let ((contacts (loop for home in homes
                          collect (list* :position (copy-list (getf home :position)) home))))
      (loop for (finger axis place) in places
            do (setf (nth axis (getf (nth finger contacts) :position)) place))
      (placement-faults contacts homes grasp matching (supergrip:parse-box box)))))

(defparameter *spoiled-places*
  '(("too near an edge" "PINCH-3-C-SHAPE" (0 2 9.86d0) (1 2 9.86d0))
    ("off its face" "PINCH-3-C-SHAPE" (2 0 9.9d0))
    ("too deep" "PINCH-3-PARALLEL" (2 2 3.63d0))
    ("too deep" "PINCH-3-C-SHAPE" (0 0 5.17d0))
    ("too deep" "PINCH-3-C-SHAPE" (2 2 5.17d0))
    ("too deep" "PINCH-3-U-SHAPE" (0 0 5.14d0))
    ("too deep" "PINCH-3-U-SHAPE" (2 2 5.14d0))
    ("on one face too near each other" "PINCH-3-PARALLEL" (0 0 0.31d0))
    ("on one face too far apart" "PINCH-3-ADJACENT" (0 1 -1.14d0))
    ("on opposite faces too far apart" "PINCH-3-PARALLEL" (0 2 4.64d0))
    ("on opposite faces too far apart" "PINCH-3-C-SHAPE" (0 0 6.88d0))
    ("on adjacent faces too far apart" "PINCH-2-ADJACENT" (0 2 -1.2d0) (1 0 5.6d0))
    ("crossed" "PINCH-3-PARALLEL" (0 0 0.3d0) (1 0 -0.3d0)))
  "What is wrong if some legal places of a grasp are changed; each change is (FINGER AXIS CM).")

(test places-beyond-a-limit-are-refused
  (loop for (fault grasp . places) in *spoiled-places*
        do (is (null (faults-at grasp '())) "~a: ~a" grasp (faults-at grasp '()))
           (let ((faults (faults-at grasp places)))
             (is (and faults (every (lambda (found) (string= found fault)) faults))
                 "~a ~a: ~a" grasp places faults))))

(test places-just-within-a-limit-are-legal
  (loop for (grasp . places) in '(("PINCH-3-C-SHAPE" (0 2 9.84d0) (1 2 9.84d0))
                                  ("PINCH-3-PARALLEL" (2 2 3.65d0))
                                  ("PINCH-3-C-SHAPE" (0 0 5.18d0))
                                  ("PINCH-3-U-SHAPE" (0 0 5.16d0))
                                  ("PINCH-3-PARALLEL" (0 0 0.29d0))
                                  ("PINCH-3-PARALLEL" (0 2 4.62d0))
                                  ("PINCH-3-C-SHAPE" (0 0 6.86d0))
                                  ("PINCH-3-ADJACENT" (0 1 -1.13d0))
                                  ("PINCH-2-ADJACENT" (0 2 -1.2d0) (1 0 5.8d0)))
        do (is (null (faults-at grasp places)) "~a ~a: ~a" grasp places (faults-at grasp places))))

(test a-finger-on-another-face-or-without-room-is-refused
  (let ((between (with-entries *long-box* :constrained '(:x1 :x2)))
        (homes (third (assoc "PINCH-3-PARALLEL" *placements* :test #'string=))))
    (is (equal '("on another face")
               (placement-faults (list (first homes) (second homes) (at "X1" 10 0 4)) homes
                                 "PINCH-3-PARALLEL" '("Y2" "Y1" "X2" "X1" "Z2" "Z1")
                                 (supergrip:parse-box *long-box*))))
    (flet ((moved (x)
             (faults-at "PINCH-3-PARALLEL" `((0 0 ,(- x 0.6d0)) (1 0 ,(+ x 0.6d0)) (2 0 ,x))
                        :box between)))
      (is (null (moved 6.2d0)))
      (is (equal '("without room for the hand") (moved 6.3d0))))))

(test what-refining-says-it-gains-is-checked
  (let ((refinement (supergrip:refine (pencil-plan) :count 1 :regions 50)))
    (flet ((faults (&rest changes)
             (let ((spoiled (copy-structure refinement)))
               (loop for (writer value) on changes by #'cddr
                     do (funcall (fdefinition (list 'setf writer)) value spoiled))
               (mapcar (lambda (fault) (subseq fault 0 (position-if-not #'alpha-char-p fault)))
                       (gain-faults spoiled)))))
      (is (supergrip:refinement-moved-p refinement))
      (is (null (refinement-faults refinement)))
      (is (member "worse" (faults 'supergrip:refinement-contacts
                                  (supergrip:refinement-home refinement)
                                  'supergrip:refinement-home
                                  (supergrip:refinement-contacts refinement))
                  :test #'string=))
      (destructuring-bind (lower upper) (supergrip:refinement-radius refinement)
        (is (equal '("radius" "radius")
                   (faults 'supergrip:refinement-radius
                           (list (* 1.02d0 upper) (* 1.03d0 upper)))))
        (is (equal '("radius")
                   (faults 'supergrip:refinement-radius
                           (list (* 0.97d0 lower) (* 0.98d0 lower)))))))))

(test a-judge-of-many-refined-grasps-finds-no-fault
  (let (legal)
    (let ((lines (printed (let ((*error-output* (make-broadcast-stream)))
                            (setf legal (print-legal 4))))))
      (is (eq t legal))
      (is (equal (list (format nil "4 boxes with a grasp, 12 grasps refined: fingers moved in 5, ~
                                    15 fingers; 0 faults"))
                 lines)))))
