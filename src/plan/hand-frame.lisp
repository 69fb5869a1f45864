;;;; hand-frame.lisp -- where the hand of a candidate is: its frame, the same for every grasp.
;;;;
;;;; Origin: the grasp centre.  z: the approach, from the palm to the box.  x: the direction in
;;;; which the hand closes.  y = z x x.  The palm is always over a face, so z lies along an axis of
;;;; the box.

(in-package :supergrip)

(defun opposed-faces (faces palm)
  "Return the first two opposite grasp faces, as N1 and N2, that are both among FACES, those of the
contacts, and across the approach to the face PALM: two values; NIL if there are none."
  (loop for one in '(0 2 4)
        for two = (1+ one)
        when (and (/= (floor palm 2) (floor one 2)) (member one faces) (member two faces))
          return (values one two)))

(defun lone-face (faces)
  "Return the one of two grasp faces that has one contact while the other has more, or NIL; FACES
are those of the contacts."
  (let ((lone (find 1 faces :key (lambda (face) (count face faces)))))
    (and lone (rest (rest faces)) (null (rest (remove-duplicates (remove lone faces))))
         lone)))

(defun corner-direction (faces contacts)
  "Return the vector from the contact on a face of N to the one on a face of O, if FACES, those of
CONTACTS, are one face of each axis; else NIL."
  (and (equal '(0 1 2) (sort (mapcar (lambda (face) (floor face 2)) faces) #'<))
       (flet ((place (axis)
                (getf (nth (position axis faces :key (lambda (face) (floor face 2))) contacts)
                      :position)))
         (mapcar #'- (place 1) (place 0)))))

(defun across-approach (vector palm)
  "Return VECTOR, along X Y Z, without its part along the normal of the box face PALM, made of
length 1; NIL if nothing is left of it."
  (unit-length (loop for number in vector
                     for axis from 0
                     collect (if (= axis (face-axis palm)) 0d0 number))))

(defun closing-direction (candidate contacts)
  "Return the unit vector, in the box frame, in which the hand of CANDIDATE, with CONTACTS, closes;
and, where it closes on two opposed faces, one of these.  See CANDIDATE-HAND."
  (let* ((grasp (%candidate-grasp candidate))
         (box-faces (matching-faces (%candidate-matching candidate)))
         (faces (mapcar #'first (grasp-contacts grasp)))
         (palm (grasp-palm grasp)))
    (flet ((outward (face) (unit-vector (svref box-faces face) 1))
           (across (vector) (and vector (across-approach vector (svref box-faces palm)))))
      (let ((opposed (opposed-faces faces palm)))
        (if opposed
            (values (outward opposed) (svref box-faces opposed))
            (or (let ((lone (lone-face faces)))
                  (and lone (across (unit-vector (svref box-faces lone) -1))))
                (across (corner-direction faces contacts))
                (some (lambda (contact) (across (getf contact :normal))) contacts)
                (outward (if (< palm 2) 2 0))))))))

(defun contacts-hand (candidate contacts box)
  "Return what CANDIDATE-HAND does; CONTACTS are those of CANDIDATE on BOX."
  (multiple-value-bind (x face) (closing-direction candidate contacts)
    (let ((z (candidate-approach candidate)))
      (list :position (candidate-offset candidate)
            :orientation (matrix-quaternion (list x (cross-product z x) z))
            :opening (and face (aref (%box-size box) (face-axis face)))
            :closing x))))

(defun candidate-hand (candidate &optional (plan *plan*))
  "Return where the hand of CANDIDATE, which is possible in PLAN, is: a plist, in the box frame.

:POSITION     the grasp centre from the box centre, three numbers along X Y Z, in cm.
:ORIENTATION  the hand's frame, a unit quaternion (X Y Z W) with W >= 0: it turns the axes of the
              box into x y z of the hand.
:OPENING      the distance, in cm, of the two opposed faces that the hand closes on, or NIL.
:CLOSING      x of the hand, a unit vector along X Y Z.

z of the hand is the approach, CANDIDATE-APPROACH: minus the outward normal of the face that the
palm is over.  y is z x x.  x is the first of these that is there, without its part along z:
- where contacts oppose each other across z, along their normals, from the face of index 2 to
  that of index 1, as N2 to N1; of several such axes the first of N O A;
- where one contact faces several on one other face, the inward normal of the lone one;
- where three contacts are on one face of N, of O and of A, from that of N to that of O;
- the inward normal of the first contact whose normal is not along z;
- the first of N O A that is not along z.
Of the shipped grasps the first holds for 2-PARALLEL, 3-PARALLEL and the C-SHAPE, x = N, and the
U-SHAPE, x = O; the third for the CORNER.  In the ADJACENT grasps the palm is over O1, so that the
lone contact's normal lies along z, and the fourth holds: x = -N."
  (contacts-hand candidate (candidate-contacts candidate plan) (plan-box plan)))

(defun hand-in-world (hand pose)
  "Return HAND, as CANDIDATE-HAND has it, as a box of POSE has it in the world."
  (destructuring-bind (&key position orientation opening closing) hand
    (let ((matrix (pose-matrix pose)))
      (list :position (mapcar #'+ (pose-position pose) (turned-vector matrix position))
            :orientation (standard-quaternion
                          (quaternion-product (unit-length (pose-orientation pose)) orientation))
            :opening opening
            :closing (turned-vector matrix closing)))))

(defun candidate-world (candidate &optional (plan *plan*))
  "Return where the hand of CANDIDATE, which is possible in PLAN, is in the world: as
CANDIDATE-HAND, but in the frame in which the POSE of the box is given; :POSITION is that of the
grasp centre.  NIL if the box has no pose."
  (let ((pose (%box-pose (plan-box (need-plan plan)))))
    (and pose (hand-in-world (candidate-hand candidate plan) pose))))
