;;;; grasps.lisp -- the one grasp of a parallel jaw.
;;;;
;;;; Frame, forms and units are those of the shipped grasps.lisp.  The gripper has a file of its own.

;;; Chosen: one pad on N1, the other on N2, the palm over A2.  A pad counts as a soft finger in its
;;; middle.  CONDITIONS: as PINCH-2-PARALLEL, and a face no narrower than a pad can hold.  OFFSET: a box
;;; higher than twice FINGER-DEPTH is held above its middle.  WRENCH: statics of two opposed soft
;;; fingers, as printed for PINCH-2-PARALLEL.  TWIST: the fingers of a jaw move nothing, the arm moves
;;; the whole hand, and as well in one direction as in another.
(SETQ JAW-PINCH
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND
                ((DIST '(A1 A2)) >= FINGER-WIDTH) AND
                ((DIST '(O1 O2)) > WIDTH-HAND) OR
                (NOT ((CONSTRAINED O1) AND (CONSTRAINED O2))))
    OFFSET (LET* ((a (POSIT (- (/ (DIST '(A1 A2)) 2) FINGER-DEPTH))))
             (LIST 0 0 0 0 (- a) a))
    WRENCH (1
            (* 2 u)
            (* 2 u)
            (* 2 v)
            (* u (DIST '(N1 N2)))
            (* u (DIST '(N1 N2))))
    TWIST (1 1 1 1 1 1)
    CONTACTS ((N1 0 0) (N2 0 0))
    PALM A2))
