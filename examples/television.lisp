;;;; A television stands on its foot and is to be lifted and turned to the sofa.
;;;;
;;;; Z2 is the foot; the screen has a broad frame, so that its front and back may be touched
;;;; there.  The gripper is a strong one: the weight is given for fingers that press with 50 N
;;;; each.  A person takes it with both hands, left and right.  SUPER-GRIP has one hand, which
;;;; can't span the width: PINCH-3-PARALLEL across the thickness is left, from above, and because
;;;; the fingers don't reach the middle the grasp has a large offset, to the upper edge.  The set
;;;; then hangs straight below the hand, and anything that pushes it swings it: this is what
;;;; limits the quality, and why a person would not trust this grasp.  From the side the weight
;;;; would twist it out of the fingers.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 73 8 47)
            (WEIGHT 0.9)
            (u 0.6)
            (v 0.2)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.2 0.2 1 0.3 0 0.5))
            (VELOCITY-NEEDED (0.2 0.2 0.3 0 0 1))))

(forward-chain)
