;;;; rules.lisp -- when a parallel jaw is worth trying, and where.

;;; Chosen: as the shipped GRIP1.
(RULE THIN
  (IF (SMALL (s1 s2))
      (CONSTRAINED (s1)))
  (THEN (CANT GRASP TOO SMALL TO PICK UP)))

;;; Chosen: as the shipped GRIP2.
(RULE SMOOTH
  (IF (SLIPPERY))
  (THEN (CANT GRASP TOO SLIPPERY TO PICK UP)))

;;; Chosen: a jaw needs two free faces, opposed, that it can span, a free face beside them for the
;;; palm, S4, and room for its pads on them.
(RULE SIDES
  (IF (OPPOSED (s1 s2))
      (NOT CONSTRAINED (s1))
      (NOT CONSTRAINED (s2))
      (NOT LARGE (s1 s2))
      (OPPOSED (s3 s4))
      (NOT CONSTRAINED (s4))
      (NOT SMALL (s3 s4))
      (OPPOSED (s5 s6))
      (NOT SMALL (s5 s6)))
  (THEN (TRY JAW-PINCH (s1 s2 ? ? s3 s4))
        (REMEMBER OBJECT HAS SIDES FOR THE JAW)))

;;; Chosen: without them there is nothing to try, and it can be said why.
(RULE NOTHING
  (IF (OBJECT HAS NO SIDES FOR THE JAW))
  (THEN (CANT GRASP NO FREE PAIR OF FACES FITS INTO THE JAW)))
