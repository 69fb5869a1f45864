;;;; hand-frame.lisp -- where the hand of a candidate is.

(in-package :supergrip-test)
(define-suite hand-frame "Where the hand of a candidate is.")

(defun turned-by (quaternion vector)
  "Return VECTOR turned by QUATERNION, (X Y Z W): v + 2 q x (q x v + w v)."
  (destructuring-bind (x y z w) quaternion
    (flet ((cross (a b)
             (destructuring-bind ((ax ay az) (bx by bz)) (list a b)
               (list (- (* ay bz) (* az by)) (- (* az bx) (* ax bz)) (- (* ax by) (* ay bx))))))
      (let ((axis (list x y z)))
        (mapcar (lambda (v c) (+ v (* 2 c)))
                vector
                (cross axis (mapcar (lambda (c v) (+ c (* w v))) (cross axis vector) vector)))))))

(defun hand-axes (hand)
  "Return x y z of HAND in the box frame, three lists."
  (loop for axis in '((1 0 0) (0 1 0) (0 0 1)) collect (turned-by (getf hand :orientation) axis)))

(defun outward-normal (face)
  "Return the outward normal of the box face FACE, a name."
  (loop for axis across "XYZ"
        collect (if (char= axis (char face 0)) (if (char= (char face 1) #\1) 1d0 -1d0) 0d0)))

(defun in-grasp-frame (vector candidate)
  "Return VECTOR, in the box frame, along N O A of CANDIDATE."
  (loop for (face) on (supergrip:candidate-matching candidate) by #'cddr
        collect (reduce #'+ (mapcar #'* vector (outward-normal face)))))

(defun check-hand (candidate plan)
  "Check what holds of the hand of any CANDIDATE of PLAN."
  (let* ((hand (supergrip:candidate-hand candidate plan))
         (axes (hand-axes hand))
         (contacts (supergrip:candidate-contacts candidate plan))
         (faces (mapcar (lambda (contact) (getf contact :surface)) contacts)))
    (is (<= 0 (fourth (getf hand :orientation))))
    (is (close-to 1 (reduce #'+ (mapcar #'* (getf hand :orientation) (getf hand :orientation)))))
    (is (close-to (first axes) (getf hand :closing)))
    (is (close-to (third axes)
                  (mapcar #'- (outward-normal (supergrip:candidate-palm candidate)))))
    (is (equal (getf hand :position) (supergrip:candidate-offset candidate)))
    (let* ((axis (and (getf hand :opening) (position 0 (getf hand :closing) :test #'/=)))
           (letter (and axis (char "XYZ" axis))))
      (if axis
          (progn
            (is (= (getf hand :opening) (nth axis (supergrip:box-size (supergrip:plan-box plan)))))
            (is (subsetp (list (format nil "~c1" letter) (format nil "~c2" letter)) faces
                         :test #'equal)))
          (is (notany (lambda (face) (find (opposite-name face) faces :test #'equal))
                      faces))))))

(defun opposite-name (face)
  (format nil "~c~d" (char face 0) (if (char= (char face 1) #\1) 2 1)))

(test hands-are-right-handed-and-face-the-box
  (let ((seen '()))
    (for-random-boxes (box 300 51)
      (let ((plan (supergrip:plan box)))
        (dolist (candidate (supergrip:plan-possible plan))
          (pushnew (supergrip:candidate-grasp candidate) seen :test #'equal)
          (check-hand candidate plan))))
    (is (< 4 (length seen)) "~s" seen)))

(defun possible-of (name)
  "Return a possible candidate of the grasp NAME and its plan."
  (let ((plan (supergrip:try-grasp name '((size 5 4 3) (weight 0.02) (u 1.7) (v 0.5) (constrained)
                                          (force-needed (1 1 1 1 1 1))
                                          (velocity-needed (1 1 1 1 1 1))))))
    (values (or (first (supergrip:plan-possible plan)) (error "~a is not possible" name)) plan)))

(test each-shipped-grasp-has-its-hand
  "Closing and approach along N O A; and whether fingers oppose."
  (loop for (name closing approach opens) in
        '(("PINCH-2-PARALLEL" (1 0 0) (0 0 1) t) ("PINCH-3-PARALLEL" (1 0 0) (0 0 1) t)
          ("PINCH-3-U-SHAPE" (0 1 0) (0 0 1) t) ("PINCH-3-C-SHAPE" (1 0 0) (0 0 1) t)
          ("PINCH-2-ADJACENT" (-1 0 0) (0 -1 0) nil) ("PINCH-3-ADJACENT" (-1 0 0) (0 -1 0) nil)
          ("PINCH-3-CORNER" nil (0 0 -1) nil))
        do (multiple-value-bind (candidate plan) (possible-of name)
             (let ((hand (supergrip:candidate-hand candidate plan)))
               (is (eq opens (and (getf hand :opening) t)))
               (is (close-to approach (in-grasp-frame (third (hand-axes hand)) candidate)))
               (if closing
                   (is (close-to closing (in-grasp-frame (getf hand :closing) candidate)) "~a" name)
                   (destructuring-bind (n o a)
                       (in-grasp-frame (getf hand :closing) candidate)
                     (let ((size (supergrip:box-size (supergrip:plan-box plan))))
                       (is (close-to 0 a))
                       (is (minusp n))
                       (is (close-to (/ o n)
                                     (- (/ (nth (axis-of candidate 2) size)
                                           (nth (axis-of candidate 0) size))))))))))))

(defun axis-of (candidate grasp-face)
  "Return the axis, 0 to 2, of the box face that GRASP-FACE, 0 to 5, of CANDIDATE has."
  (position (char (nth grasp-face (supergrip:candidate-matching candidate)) 0) "XYZ"))

(test any-grasp-of-a-user-has-a-hand
  "Contacts and palm of a grasp, and the closing direction along N O A."
  (loop for (contacts palm closing opens) in
        '(("((N1 0 0))" "A2" (-1 0 0) nil)                          ; one finger
          ("((A2 0 0))" "A2" (1 0 0) nil)                           ; only under the palm
          ("((N1 0 0))" "N1" (0 1 0) nil)
          ("((A1 0 0) (A2 0 0))" "A2" (1 0 0) nil)                  ; opposed along the approach
          ("((A1 0 0) (A2 0 0) (O2 0 0))" "A2" (0 1 0) nil)
          ("((N1 0 0) (N2 0 0) (O1 0 0) (O2 0 0))" "A2" (1 0 0) t)  ; two pairs
          ("((N1 0 0) (N2 0 0) (O1 0 0) (O2 0 0))" "N2" (0 1 0) t)
          ("((N1 0 0.1) (N1 0 -0.1) (O2 0 0))" "A2" (0 1 0) nil)    ; a lone one
          ("((N1 0 0.1) (N1 0 -0.1) (N1 0 0) (O1 0 0))" "A2" (0 -1 0) nil)
          ("((N1 0 0.1) (N1 0 -0.1) (O1 0 0.1) (O1 0 -0.1))" "A2" (-1 0 0) nil)
          ("((O2 0 0) (N2 0 0))" "A1" (0 1 0) nil)                  ; adjacent
          ("((N1 0 0) (O1 0 0) (A1 0 0))" "N1" (0 1 0) nil))        ; a corner, from the side
        for grasp = (grasp-text :contacts contacts :palm palm
                                :used-surfaces "(N1 N2 O1 O2 A1 A2)")
        for knowledge = (text-knowledge "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                                        (format nil "~a~%~a" *small-gripper* grasp))
        for plan = (supergrip:try-grasp "G" '((size 5 4 3) (weight 0) (u 0.5) (v 0.2) (constrained)
                                              (force-needed (1 1 1 1 1 1))
                                              (velocity-needed (0 0 0 0 0 0)))
                                        :knowledge knowledge)
        for candidate = (first (supergrip:plan-possible plan))
        for hand = (supergrip:candidate-hand candidate plan)
        do (is (close-to closing (in-grasp-frame (getf hand :closing) candidate)) "~a ~a" contacts
               palm)
           (is (eq opens (and (getf hand :opening) t)) "~a ~a" contacts palm)
           (is (close-to (first (hand-axes hand)) (getf hand :closing)))))

(test the-fingers-of-a-record-are-those-of-the-pictures
  (let ((contacts (getf (supergrip::plan-record (pencil-plan)) :contacts)))
    (is (equal '("F1" "F2" "F3") (mapcar (lambda (contact) (getf contact :finger)) contacts)))
    (is (equal '(:surface :position :normal :finger)
               (loop for (key) on (first contacts) by #'cddr collect key)))))
