;;;; rules.lisp -- the rules that try the grasps of this directory: the paper's fifteen and three.
;;;;
;;;; This file is data: read by SUPER-GRIP's own reader, checked and turned into functions.
;;;; docs/languages.md, "Rules", says what may stand here.  Rules run in the order of this
;;;; file, each once: a rule that determines a property stands before the rules that use it.
;;;;
;;;; From the box and the gripper come: OPPOSED (s1 s2), SMALL (s1 s2), NARROW (s1 s2),
;;;; LARGE (s1 s2), CONSTRAINED (s1) and SLIPPERY.
;;;;
;;;; The fifteen are those of the shipped rules.lisp, which try WIDE-CORNER too where all that is left is
;;;; a corner: GRIP4, GRIP5 and GRIP10.
;;;;
;;;; Every rule is marked: Printed (in the paper) or Reconstructed (not in the paper; the reason
;;;; follows).

;;;; ---------------------------------------------------------------- (1) obvious cases

;;; Printed.
(RULE GRIP1
  (IF (SMALL (s1 s2))
      (CONSTRAINED (s1)))
  (THEN (CANT GRASP TOO SMALL TO PICK UP)))

;;; Reconstructed: "too slippery".  At SLIPPERY-U the friction cone is 6 degrees to a side, less
;;; than what the fingers' placement, or the faces' being parallel, can be relied upon.
(RULE GRIP2
  (IF (SLIPPERY))
  (THEN (CANT GRASP TOO SLIPPERY TO PICK UP)))

;;; Reconstructed: "too constrained".  With two opposed pairs blocked, the two faces that remain
;;; leave no place for the palm; no grasp of the database can be valid.
(RULE GRIP3
  (IF (OPPOSED (s1 s2))
      (CONSTRAINED (s1))
      (CONSTRAINED (s2))
      (OPPOSED (s3 s4))
      (CONSTRAINED (s3))
      (CONSTRAINED (s4)))
  (THEN (CANT GRASP TOO CONSTRAINED TO PICK UP)))

;;;; ---------------------------------------------------------------- (2) availability of surfaces

;;; Printed.
(RULE SURFACES1
  (IF (OPPOSED (s1 s2))
      (NOT CONSTRAINED (s1))
      (NOT CONSTRAINED (s2)))
  (THEN (REMEMBER PARALLEL (s1 s2))
        (REMEMBER OBJECT HAS PARALLEL SURFACES)))

;;; Reconstructed: ADJACENT is free and not opposed; the session gives the sentences and, by the
;;; order of its lines, the order of the clauses.
(RULE SURFACES2
  (IF (NOT OPPOSED (s1 s2))
      (NOT CONSTRAINED (s1))
      (NOT CONSTRAINED (s2)))
  (THEN (REMEMBER ADJACENT (s1 s2))
        (REMEMBER OBJECT HAS ADJACENT SURFACES)))

;;; Reconstructed: a free corner is three faces adjacent to each other; sentences from the session.
(RULE SURFACES3
  (IF (ADJACENT (s1 s2))
      (ADJACENT (s1 s3))
      (ADJACENT (s2 s3)))
  (THEN (REMEMBER CORNER (s1 s2 s3))
        (REMEMBER OBJECT HAS FREE CORNERS)))

;;; Reconstructed: the fourth rule of its group.  Parallel faces too far apart for the hand need
;;; other grasps than those that close across them.
(RULE SURFACES4
  (IF (PARALLEL (s1 s2))
      (LARGE (s1 s2)))
  (THEN (REMEMBER WIDE (s1 s2))))

;;;; ---------------------------------------------------------------- (3) poor grasps

;;; Reconstructed: without parallel faces a free corner is the best there is; each is tried, then
;;; the adjacent faces, and the search ends.
(RULE GRIP4
  (IF (OBJECT HAS NO PARALLEL SURFACES)
      (CORNER (s1 s2 s3)))
  (THEN (TRY PINCH-3-CORNER (s1 ? s2 ? s3 ?))
        (TRY WIDE-CORNER (s1 ? s2 ? s3 ?))
        (TRY PINCH-2-ADJACENT)
        (TRY PINCH-3-ADJACENT)
        (KEEP BEST)))

;;; Reconstructed: a pair too wide for the hand is not available.  Beside it a corner can be held
;;; from the side; where the hand can span another pair, no other poor grasp is worth trying.
(RULE GRIP5
  (IF (WIDE (s1 s2))
      (PARALLEL (s3 s4))
      (NOT WIDE (s3 s4)))
  (THEN (REMEMBER OBJECT HAS OTHER PARALLEL SURFACES)
        (TRY PINCH-3-CORNER (s1 ? ? ? ? ?))))

;;; Printed.
(RULE GRIP6
  (IF (OBJECT HAS NO FREE CORNERS)
      (OBJECT HAS NO PARALLEL SURFACES))
  (THEN (TRY PINCH-2-ADJACENT)
        (TRY PINCH-3-ADJACENT)
        (KEEP BEST)))

;;;; ---------------------------------------------------------------- (4) other cases

;;; Reconstructed: two fingers do where the faces are too narrow for three, if no edge of them is
;;; too thin for a fingertip: the printed grasp itself asks for no width.  (On wider faces
;;; PINCH-3-PARALLEL is never worse in the same matching.)
(RULE GRIP7
  (IF (PARALLEL (s1 s2))
      (NOT WIDE (s1 s2))
      (NARROW (s3 s4))
      (NOT SMALL (s3 s4))
      (OPPOSED (s5 s6))
      (NOT SMALL (s5 s6)))
  (THEN (TRY PINCH-2-PARALLEL (s1 s2 s3 s4 s5 s6))))

;;; Printed.
(RULE GRIP8
  (IF (PARALLEL (s1 s2))
      (CORNER (s1 s3 s4)))
  (THEN (TRY PINCH-3-U-SHAPE (? s3 s1 s2 ? s4))
        (TRY PINCH-3-C-SHAPE (s1 s2 ? s3 ? s4))))

;;; Reconstructed: the good grasp across every parallel pair that the hand can span, the palm over
;;; any free face beside it, where two fingers have room side by side; the session gives its place,
;;; after GRIP8, and the order of s5 s6 before s3 s4.
(RULE GRIP9
  (IF (PARALLEL (s1 s2))
      (NOT WIDE (s1 s2))
      (OPPOSED (s5 s6))
      (NOT CONSTRAINED (s6))
      (OPPOSED (s3 s4))
      (NOT NARROW (s3 s4)))
  (THEN (TRY PINCH-3-PARALLEL (s1 s2 ? ? s5 s6))))

;;; Ours: the grasp across every parallel pair between two blocked faces: the hand can't be turned so
;;; that fingers side by side hold against turning about the line through these faces.
(RULE LATERAL1
  (IF (OPPOSED (s3 s4))
      (CONSTRAINED (s3))
      (CONSTRAINED (s4))
      (NOT NARROW (s3 s4))
      (PARALLEL (s1 s2))
      (NOT WIDE (s1 s2)))
  (THEN (TRY LATERAL (s1 s2 s3 s4 ? ?))))

;;; Ours: very thin things, free on both sides, are held like a key.
(RULE LATERAL2
  (IF (PARALLEL (s1 s2))
      (SMALL (s1 s2)))
  (THEN (TRY LATERAL (s1 s2 ? ? ? ?))))

;;; Ours: a sheet so large that the hand spans only its thin side.  It reaches far from the fingers,
;;; and none but fingers that lie along it hold it where it is heavy or smooth.
(RULE LATERAL3
  (IF (LARGE (s3 s4))
      (LARGE (s5 s6))
      (PARALLEL (s1 s2))
      (NOT WIDE (s1 s2)))
  (THEN (TRY LATERAL (s1 s2 ? ? ? ?))))

;;; Reconstructed: all parallel pairs are too wide.  What is left is a corner, which the paper lists
;;; among the grasps of this group, and adjacent faces.
(RULE GRIP10
  (IF (WIDE (s1 s2))
      (OBJECT HAS NO OTHER PARALLEL SURFACES))
  (THEN (TRY PINCH-3-CORNER (s1 ? ? ? ? ?))
        (TRY WIDE-CORNER (s1 ? ? ? ? ?))
        (TRY PINCH-2-ADJACENT)
        (TRY PINCH-3-ADJACENT)))

;;; Reconstructed: the end of the search, as in GRIP6.
(RULE GRIP11
  (IF (OBJECT HAS PARALLEL SURFACES))
  (THEN (KEEP BEST)))
