;;;; grasps.lisp -- grasps that need no formulas: the seven of the paper, a lateral and a wide one.
;;;;
;;;; A grasp says which faces it uses, when it may be tried, how far the hand reaches and where the
;;;; fingers go.  What the contacts exert and how well the fingers move is computed from that:
;;;; docs/further-work.md compares it with the grasps that ship.  docs/languages.md, "Grasps", says what
;;;; may stand here.
;;;;
;;;; The gripper, USED-SURFACES, CONDITIONS, CONTACTS and PALM of the first seven are those of the
;;;; shipped grasps.lisp, which gives their sources.

(SETQ GRIPPER
  '(FINGER-LENGTH 3.2     ; cm, of each of a finger's two links
    FINGER-DIST   6.05    ; cm, between the bases of opposed fingers
    FINGER-SPREAD 1.7375  ; cm, between the two fingers that work side by side
    FINGER-WIDTH  0.3     ; cm, the least width of a face that a fingertip can hold
    DIST-PINCH    12      ; cm, the opening of the hand
    WIDTH-HAND    8       ; cm, across the fingers
    REACH-U       4.85    ; cm, of thumb and palm from the closing fingers in the U-shape
    REACH-C       4.825   ; cm, the same in the C-shape
    SLIPPERY-U    0.1))   ; friction at or below which the box is SLIPPERY

;;;; ---------------------------------------------------------------- two parallel faces

;;; Reconstructed: the printed grasp; FROM-FINGERS is its printed OFFSET.
(SETQ PINCH-2-PARALLEL
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED O1) AND (CONSTRAINED O2))))
    REACH (A FROM-FINGERS)
    CONTACTS ((N1 0 0) (N2 0 0))
    PALM A2))

;;; Reconstructed: the shipped grasp without formulas.
(SETQ PINCH-3-PARALLEL
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) >= FINGER-SPREAD) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED O1) AND (CONSTRAINED O2))))
    REACH (A FROM-FINGERS)
    CONTACTS ((N1 (/ FINGER-SPREAD 2) 0) (N1 (- (/ FINGER-SPREAD 2)) 0) (N2 0 0))
    PALM A2))

;;;; ---------------------------------------------------------------- a pair and a third face

;;; Reconstructed: the shipped grasp without formulas.
(SETQ PINCH-3-U-SHAPE
  '(USED-SURFACES (N2 O1 O2 A2)
    CONDITIONS (((DIST '(O1 O2)) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH))
    REACH (N REACH-U A REACH-U)
    CONTACTS ((O1 0 0) (O2 0 0) (N2 0 0))
    PALM A2))

;;; Reconstructed: the shipped grasp without formulas.
(SETQ PINCH-3-C-SHAPE
  '(USED-SURFACES (N1 N2 O2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH))
    REACH (O REACH-C A REACH-C)
    CONTACTS ((N1 0 0) (N2 0 0) (O2 0 0))
    PALM A2))

;;;; ---------------------------------------------------------------- adjacent faces

;;; Reconstructed: the shipped grasp without formulas.
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
    OFFSET (0 0 0 0 0 0)
    WRENCH FROM-CONTACTS
    TWIST FROM-CONTACTS
    CONTACTS ((N1 0 0) (O1 0 0))
    PALM O1))

;;; Reconstructed: the shipped grasp without formulas.
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
    OFFSET (0 0 0 0 0 0)
    WRENCH FROM-CONTACTS
    TWIST FROM-CONTACTS
    CONTACTS ((N1 0 (/ FINGER-SPREAD 2)) (N1 0 (- (/ FINGER-SPREAD 2))) (O1 0 0))
    PALM O1))

;;;; ---------------------------------------------------------------- a corner

;;; Reconstructed: the shipped grasp without formulas.
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
    OFFSET (0 0 0 0 0 0)
    WRENCH FROM-CONTACTS
    TWIST FROM-CONTACTS
    CONTACTS ((N1 0 0) (O1 0 0) (A1 0 0))
    PALM A1))

;;;; ---------------------------------------------------------------- the lateral and the wide grasp

;;; Ours: the thumb against the sides of two fingers that lie along the face, one tip deeper than the
;;; other by FINGER-SPREAD, as a key is held.  Where the hand can only come from one side, this is what
;;; holds against turning about O.
(SETQ LATERAL
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) >= FINGER-SPREAD) AND
                ((DIST '(A1 A2)) >= FINGER-SPREAD) AND
                ((DIST '(O1 O2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED O1) AND (CONSTRAINED O2))))
    REACH (A FROM-FINGERS)
    CONTACTS ((N1 (/ FINGER-SPREAD 2) (/ FINGER-SPREAD 2))
              (N1 (- (/ FINGER-SPREAD 2)) (- (/ FINGER-SPREAD 2)))
              (N2 0 0))
    PALM A2))

;;; Ours: a fingertip on each of three faces that meet in a corner, no farther from it than the hand
;;; reaches: so a box of any size can be held.  As for PINCH-3-CORNER, no friction below the root of 1/2
;;; closes it.
(SETQ WIDE-CORNER
  '(USED-SURFACES (N1 O1 A1)
    CONDITIONS ((u > (SQRT 1/2)) AND
                ((DIST '(N1 N2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH))
    REACH (N REACH-U O REACH-U A REACH-U)
    CONTACTS ((N1 0 0) (O1 0 0) (A1 0 0))
    PALM A1))
