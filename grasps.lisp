;;;; grasps.lisp -- the gripper and the seven grasps of SUPER-GRIP.
;;;;
;;;; This file is data: it is read by SUPER-GRIP's own reader, checked, and turned into
;;;; functions.  Nothing in it is ever evaluated by Lisp.  docs/languages.md, "Grasps",
;;;; says what may stand here.
;;;;
;;;; Frame N O A at the grasp centre; face N1 lies on the + side of N, N2 on the - side, and so
;;;; on.  Lengths in cm; forces in units of one finger's greatest normal force; torques in their
;;;; product.  U is the coefficient of friction, V (cm) that of the soft finger's torque about
;;;; its normal.  (DIST '(N1 N2)) is the distance between two opposite faces.
;;;;
;;;; Every form is marked: Printed (in the paper), Repaired (printed, but damaged in the scan)
;;;; or Reconstructed (not in the paper; the reason follows).

;;; Reconstructed: the paper names FINGER-LENGTH, FINGER-DIST, DIST-PINCH and WIDTH-HAND and
;;; prints no value.  The six qualities of its session, each to +-0.0005, bind FINGER-SPREAD,
;;; REACH-U and REACH-C, and FINGER-LENGTH and FINGER-DIST jointly: 3.0 with 4.705 (then DIST-PINCH
;;; at most 10.705), 4.0 with 9.262 or 5.0 with 11.9075 print the same session.  The others are a
;;; plausible hand's: by FINGER-WIDTH a ruler on a table can be picked up, and a coin can't.
(SETQ GRIPPER
  '(FINGER-LENGTH 3.2     ; cm, of each of a finger's two links
    FINGER-DIST   6.05    ; cm, between the bases of opposed fingers
    FINGER-SPREAD 1.7375  ; cm, between the two fingers that work side by side
    FINGER-WIDTH  0.3     ; cm, the least width of a face that a fingertip can hold.
                          ; A pair of faces closer than this is SMALL; one closer than
                          ; FINGER-SPREAD is NARROW
    DIST-PINCH    12      ; cm, the opening of the hand.  A pair of faces as far apart, or
                          ; farther, is LARGE
    WIDTH-HAND    8       ; cm, across the fingers
    REACH-U       4.85    ; cm, of thumb and palm from the closing fingers in the U-shape
    REACH-C       4.825   ; cm, the same in the C-shape
    SLIPPERY-U    0.1))   ; friction at or below which the box is SLIPPERY

;;;; ---------------------------------------------------------------- two parallel faces

;;; Repaired: (+ 2 u), (+ 2 v), (+ u (DIST ...)) are products; D1 D2 are O1 O2; a parenthesis
;;; misplaced in (- DIST '(N1 N2)) FINGER-DIST); the result of OFFSET is written with LIST; the
;;; listing is a property list.  CONTACTS and PALM are ours.
(SETQ PINCH-2-PARALLEL
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED O1) AND
                      (CONSTRAINED O2))))
    OFFSET (LET* ((r (/ (- (DIST '(N1 N2)) FINGER-DIST) 2))
                  (depth (SQRT (- (EXPT FINGER-LENGTH 2)
                                  (EXPT r 2))))
                  (offset (POSIT (- (/ (DIST '(A1 A2)) 2)
                                    FINGER-LENGTH
                                    (COND ((> FINGER-DIST
                                              (DIST '(N1 N2)))
                                           depth)
                                          (T 0))))))
             (LIST 0 0 0 0 (- offset) offset))
    WRENCH (1
            (* 2 u)
            (* 2 u)
            (* 2 v)
            (* u (DIST '(N1 N2)))
            (* u (DIST '(N1 N2))))
    TWIST (0.8 0.5 1 0.2 1 1)
    CONTACTS ((N1 0 0) (N2 0 0))
    PALM A2))

;;; Reconstructed: two fingers spread along O on N1 against the thumb on N2.  CONDITIONS and
;;; OFFSET as printed for PINCH-2-PARALLEL, and room for both fingers on the faces.  TWIST: the
;;; printed one with an easier rotation about N, for which the session's 0.860 and 0.646 ask.
(SETQ PINCH-3-PARALLEL
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) >= FINGER-SPREAD) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED O1) AND (CONSTRAINED O2))))
    OFFSET (LET* ((r (/ (- (DIST '(N1 N2)) FINGER-DIST) 2))
                  (depth (SQRT (- (EXPT FINGER-LENGTH 2) (EXPT r 2))))
                  (offset (POSIT (- (/ (DIST '(A1 A2)) 2)
                                    FINGER-LENGTH
                                    (COND ((> FINGER-DIST (DIST '(N1 N2))) depth)
                                          (T 0))))))
             (LIST 0 0 0 0 (- offset) offset))
    WRENCH (1
            (* 2 u)
            (* 2 u)
            (+ (* 2 v) (* u (/ FINGER-SPREAD 2)))
            (* u (DIST '(N1 N2)))
            (+ (* u (DIST '(N1 N2))) (/ FINGER-SPREAD 2)))
    TWIST (0.8 0.5 1 0.5 1 1)
    CONTACTS ((N1 (/ FINGER-SPREAD 2) 0) (N1 (- (/ FINGER-SPREAD 2)) 0) (N2 0 0))
    PALM A2))

;;;; ---------------------------------------------------------------- a pair and a third face

;;; The statics of a pair that closes across the distance d and a third finger at the distance
;;; q from it, along that finger's axis.  Exact (docs/physics.md).

;;; Reconstructed: statics, the greatest force along the axis of the pair.
(DEFUN PAIR-FORCE (d q)
  (LET* ((r (/ d (* 2 q))))
    (MAX 1 (COND ((<= (* 2 r u) (+ u r)) (/ (* 2 u u r) (+ u r)))
                 (T (+ 1 u (- (/ (+ u r) (* 2 r u)))))))))

;;; Reconstructed: statics, the greatest force along the axis that no finger faces.
(DEFUN SIDE-FORCE (q)
  (LET* ((x (MIN (/ (* u u) (SQRT (+ 1 (* u u))))
                 (COND ((>= (* 2 v) (* u q)) 1/2)
                       (T (/ v (* u q)))))))
    (+ (* 2 (SQRT (POSIT (- (* u u) (* x x))))) (* 2 u x))))

;;; Reconstructed: statics, the greatest torque about the axis of the pair.
(DEFUN PAIR-TORQUE (q)
  (+ (* 2 v) (* u q (MIN 1 (/ (* 2 u) (SQRT (+ 1 (* u u))))))))

;;; Reconstructed: statics, the greatest torque about the axis of the third finger.
(DEFUN THIRD-TORQUE (d)
  (LET* ((x (MIN 1/2 (/ (* 2 u v) (SQRT (+ (* d d) (* 4 v v)))))))
    (+ (* d (SQRT (POSIT (- (* u u) (* x x))))) (* 2 v x))))

;;; Reconstructed: statics, the greatest torque about the axis that no finger faces.
(DEFUN SIDE-TORQUE (d q)
  (+ (* u d)
     (COND ((> (* 2 u q) (+ (* 2 u u d) d))
            (* (MIN 1 (/ (* 2 u u) (+ 1 (* u u))))
               (- q (* u d) (/ d (* 2 u)))))
           (T 0))))

;;; Reconstructed: two fingers close across O, the thumb is on N2, the palm over A2.  What half
;;; the box exceeds REACH-U, along N and along A, is the offset: the paper suggests the reach
;;; of a grasp as its simpler information.  No hand's room is asked for: three of the four
;;; faces around the palm are free.  TWIST: chosen so that the session's 0.770 and 0.311 hold.
(SETQ PINCH-3-U-SHAPE
  '(USED-SURFACES (N2 O1 O2 A2)
    CONDITIONS (((DIST '(O1 O2)) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH))
    OFFSET (LET* ((n (POSIT (- (/ (DIST '(N1 N2)) 2) REACH-U)))
                  (a (POSIT (- (/ (DIST '(A1 A2)) 2) REACH-U))))
             (LIST (- n) n 0 0 (- a) a))
    WRENCH (LET* ((d (DIST '(O1 O2)))
                  (q (MIN (/ (DIST '(N1 N2)) 2) REACH-U)))
             (LIST (* 2 u)
                   (PAIR-FORCE d q)
                   (SIDE-FORCE q)
                   (THIRD-TORQUE d)
                   (PAIR-TORQUE q)
                   (SIDE-TORQUE d q)))
    TWIST (0.2 0.5 0.8 0.4 0.5 0.5)
    CONTACTS ((O1 0 0) (O2 0 0) (N2 0 0))
    PALM A2))

;;; Reconstructed: finger and thumb close across N, the other finger is on O2, the palm over A2.
;;; OFFSET and CONDITIONS as for the U-shape, with its own reach.  TWIST: chosen so that the
;;; session's 0.436 and 0.769 hold.
(SETQ PINCH-3-C-SHAPE
  '(USED-SURFACES (N1 N2 O2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH))
    OFFSET (LET* ((o (POSIT (- (/ (DIST '(O1 O2)) 2) REACH-C)))
                  (a (POSIT (- (/ (DIST '(A1 A2)) 2) REACH-C))))
             (LIST 0 0 (- o) o (- a) a))
    WRENCH (LET* ((d (DIST '(N1 N2)))
                  (q (MIN (/ (DIST '(O1 O2)) 2) REACH-C)))
             (LIST (PAIR-FORCE d q)
                   (* 2 u)
                   (SIDE-FORCE q)
                   (PAIR-TORQUE q)
                   (THIRD-TORQUE d)
                   (SIDE-TORQUE d q)))
    TWIST (0.7 0.7 0.5 0.3 0.5 0.4)
    CONTACTS ((N1 0 0) (N2 0 0) (O2 0 0))
    PALM A2))

;;;; ---------------------------------------------------------------- adjacent faces

;;; Reconstructed: the root of x, nothing below zero.
(DEFUN ROOT (x) (SQRT (POSIT x)))

;;; Reconstructed: a - b/u, nothing where friction does not close the grasp.
(DEFUN SLACK (a b) (COND ((> (* u a) b) (- a (/ b u))) (T 0)))

;;; Reconstructed: statics of two fingertips on adjacent faces, at the half sizes a and b from
;;; the box centre, loaded to k: the greatest force along A.
(DEFUN EDGE-FORCE (k a b)
  (* k (+ (MIN (ROOT (- (* u u a a) (* b b))) (/ (* v b) a))
          (MIN (ROOT (- (* u u b b) (* a a))) (/ (* v a) b)))))

;;; Reconstructed: statics, the greatest tangential share in a torque about N; exchange a and b
;;; for the torque about O.
(DEFUN EDGE-SHARE (a b)
  (MIN (ROOT (- (* u u a a) (* b b)))
       (ROOT (- (* u u b b) (* a a)))
       (/ (* v b) a)))

;;; Reconstructed: fingers on N1 and O1 only, the palm over O1: the rule that needs it finds one
;;; pair of faces blocked altogether, which must be A1 A2, so the hand needs room along A.
;;; Closed only for u > 1.  TWIST: less sure in every direction than PINCH-2-PARALLEL.
(SETQ PINCH-2-ADJACENT
  '(USED-SURFACES (N1 O1)
    CONDITIONS ((u > (MAX (/ (DIST '(N1 N2)) (DIST '(O1 O2)))
                          (/ (DIST '(O1 O2)) (DIST '(N1 N2))))) AND
                ((SQRT (+ (EXPT (/ (DIST '(N1 N2)) 2) 2)
                          (EXPT (/ (DIST '(O1 O2)) 2) 2))) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED A1) AND (CONSTRAINED A2))))
    OFFSET (LIST 0 0 0 0 0 0)
    WRENCH (LET* ((a (/ (DIST '(N1 N2)) 2))
                  (b (/ (DIST '(O1 O2)) 2))
                  (k (/ 1 (MAX a b))))
             (LIST (MIN 1 (/ (SLACK a b) b))
                   (MIN 1 (/ (SLACK b a) a))
                   (EDGE-FORCE k a b)
                   (* k (+ (* v a) (* b (EDGE-SHARE a b))))
                   (* k (+ (* v b) (* a (EDGE-SHARE b a))))
                   (MIN (SLACK a b) (SLACK b a))))
    TWIST (0.4 0.4 0.6 0.2 0.2 0.5)
    CONTACTS ((N1 0 0) (O1 0 0))
    PALM O1))

;;; Reconstructed: statics of PINCH-3-ADJACENT, the torque about N with the tangential share x
;;; and the two fingers at the distance h from the middle.
(DEFUN SPREAD-TORQUE-N (k a b h x)
  (* k (+ (* v a) (* b x) (* h (- (ROOT (- (* u u a a) (* x x))) b)))))

;;; Reconstructed: statics, the torque about O with the tangential share x and the uneven
;;; share e of the two fingers.
(DEFUN SPREAD-TORQUE-O (a b h x e)
  (* (MIN (/ 2 (+ a e)) (/ 1 b)) (+ (* v b) (* a x) (* h e))))

;;; Reconstructed: statics, the best of three uneven shares for a given x.
(DEFUN SPREAD-BEST-O (a b h x)
  (LET* ((most (SLACK a (SQRT (+ (* b b) (* x x))))))
    (MAX (SPREAD-TORQUE-O a b h x 0)
         (SPREAD-TORQUE-O a b h x most)
         (SPREAD-TORQUE-O a b h x (MIN most (POSIT (- (* 2 b) a)))))))

;;; Reconstructed: as PINCH-2-ADJACENT, with two fingers spread along A on N1.  TWIST: a
;;; third contact takes the weakness of the rotation about O, and some mobility.
(SETQ PINCH-3-ADJACENT
  '(USED-SURFACES (N1 O1)
    CONDITIONS ((u > (MAX (/ (DIST '(N1 N2)) (DIST '(O1 O2)))
                          (/ (DIST '(O1 O2)) (DIST '(N1 N2))))) AND
                ((SQRT (+ (EXPT (/ (DIST '(N1 N2)) 2) 2)
                          (EXPT (/ (DIST '(O1 O2)) 2) 2))) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-SPREAD) AND
                ((DIST '(A1 A2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED A1) AND (CONSTRAINED A2))))
    OFFSET (LIST 0 0 0 0 0 0)
    WRENCH (LET* ((a (/ (DIST '(N1 N2)) 2))
                  (b (/ (DIST '(O1 O2)) 2))
                  (h (/ FINGER-SPREAD 2))
                  (k (MIN (/ 2 a) (/ 1 b)))
                  (m (MIN 2 u)))
             (LIST (MIN 2 (/ (SLACK a b) b))
                   (MIN 1 (* m (/ (SLACK b a) a)))
                   (EDGE-FORCE k a b)
                   (MAX (SPREAD-TORQUE-N k a b h 0)
                        (SPREAD-TORQUE-N k a b h (EDGE-SHARE a b)))
                   (MAX (SPREAD-BEST-O a b h 0)
                        (SPREAD-BEST-O a b h (EDGE-SHARE b a)))
                   (MIN (SLACK a b) (* m (SLACK b a)))))
    TWIST (0.4 0.4 0.5 0.3 0.4 0.4)
    CONTACTS ((N1 0 (/ FINGER-SPREAD 2)) (N1 0 (- (/ FINGER-SPREAD 2))) (O1 0 0))
    PALM O1))

;;;; ---------------------------------------------------------------- a corner

;;; In the three helpers a, b, c are the half sizes along the axis in question and the two next.

;;; Reconstructed: statics of the corner grasp, the greatest force along the axis of a.
(DEFUN CORNER-FORCE (a b c)
  (LET* ((n1 (+ (/ b c) (/ c b)))
         (n2 (+ (/ a c) (/ c a)))
         (n3 (+ (/ a b) (/ b a))))
    (COND ((> u 0)
           (LET* ((m1 (/ (SQRT (+ (* b b) (* c c))) (* u a))))
             (MIN 1
                  (/ (+ n1
                        (- m1)
                        (MIN (- (ROOT (- (* u u n2 n2) (EXPT (/ a b) 2))) (/ c b)) (/ (* v n3) b))
                        (MIN (- (ROOT (- (* u u n3 n3) (EXPT (/ a c) 2))) (/ b c)) (/ (* v n2) c)))
                     (MAX m1 n2 n3)))))
          (T 0))))

;;; Reconstructed: statics, a torque about the axis of n1 with the uneven share e on n3.
(DEFUN CORNER-SHARE (n1 n2 n3 arm e)
  (/ (+ (* v n1) (* arm e)) (MAX n1 n2 (+ n3 e))))

;;; Reconstructed: statics, the best of three uneven shares e between 0 and most.
(DEFUN CORNER-BEST (n1 n2 n3 arm most)
  (COND ((< most 0) 0)
        (T (MAX (CORNER-SHARE n1 n2 n3 arm 0)
                (CORNER-SHARE n1 n2 n3 arm (MIN most (POSIT (- (MAX n1 n2) n3))))
                (CORNER-SHARE n1 n2 n3 arm most)))))

;;; Reconstructed: statics of the corner grasp, the greatest torque about the axis of a.  The shares
;;; ask of the finger on that axis what only enough friction gives.
(DEFUN CORNER-TORQUE (a b c)
  (LET* ((n1 (+ (/ b c) (/ c b)))
         (n2 (+ (/ a c) (/ c a)))
         (n3 (+ (/ a b) (/ b a))))
    (COND ((< (* u a n1) (SQRT (+ (* b b) (* c c)))) 0)
          (T (MIN (CORNER-BEST n1 n2 n3 b
                               (- (ROOT (- (* u u n2 n2) (EXPT (/ c b) 2))) (/ a b)))
                  (CORNER-BEST n1 n3 n2 c
                               (- (ROOT (- (* u u n3 n3) (EXPT (/ b c) 2))) (/ a c))))))))

;;; Reconstructed: a fingertip in the middle of each of three faces that meet in a corner, the
;;; palm over A1.  No friction below the root of 1/2 closes it.  A hand that opens to
;;; DIST-PINCH holds three face centres no farther apart.  TWIST: each tip can roll on its
;;; face, none can give way far; the same along and about the three axes.
(SETQ PINCH-3-CORNER
  '(USED-SURFACES (N1 O1 A1)
    CONDITIONS ((u > (SQRT 1/2)) AND
                ((SQRT (+ (EXPT (/ (DIST '(N1 N2)) 2) 2)
                          (EXPT (/ (DIST '(O1 O2)) 2) 2))) < DIST-PINCH) AND
                ((SQRT (+ (EXPT (/ (DIST '(O1 O2)) 2) 2)
                          (EXPT (/ (DIST '(A1 A2)) 2) 2))) < DIST-PINCH) AND
                ((SQRT (+ (EXPT (/ (DIST '(A1 A2)) 2) 2)
                          (EXPT (/ (DIST '(N1 N2)) 2) 2))) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH))
    OFFSET (LIST 0 0 0 0 0 0)
    WRENCH (LET* ((a (/ (DIST '(N1 N2)) 2))
                  (b (/ (DIST '(O1 O2)) 2))
                  (c (/ (DIST '(A1 A2)) 2)))
             (LIST (CORNER-FORCE a b c)
                   (CORNER-FORCE b c a)
                   (CORNER-FORCE c a b)
                   (CORNER-TORQUE a b c)
                   (CORNER-TORQUE b c a)
                   (CORNER-TORQUE c a b)))
    TWIST (0.5 0.5 0.5 0.3 0.3 0.3)
    CONTACTS ((N1 0 0) (O1 0 0) (A1 0 0))
    PALM A1))
