;;;; A sanding block is pushed to and fro along X on a board.
;;;;
;;;; Its bottom Z2 carries the sandpaper and does the work.  Strength is needed along X against
;;;; the rubbing, along Z to press, and about Y, where the rubbing wants to tip it; velocity
;;;; along X alone.  A person lays the palm on top, with thumb and fingers on the sides.
;;;; SUPER-GRIP answers PINCH-3-U-SHAPE with the same three faces: two fingers close on the
;;;; sides, the thumb is on the top.  But its palm is at the end of the block, because this grasp
;;;; moves best along its own line of approach; as the fingers don't quite reach the middle, it
;;;; has an offset along X.  PINCH-3-PARALLEL is too weak against tipping from the end, and
;;;; slower from above.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 11 6.5 4)
            (WEIGHT 0.17)
            (u 0.8)
            (v 0.27)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (1 0.3 0.8 0.2 0.6 0.2))
            (VELOCITY-NEEDED (1 0.2 0 0 0 0.1))))

(forward-chain)
