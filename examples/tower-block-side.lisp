;;;; An outer block of a layer in a tower of wooden blocks is to be drawn out.
;;;;
;;;; It is the neighbour of the block in tower-block-middle.lisp: its side Y1 is free as well as
;;;; its ends, and it is to come out along Y.  A person takes the two ends between finger and
;;;; thumb, palm towards Y1, and wriggles it out.  SUPER-GRIP answers that it can't.  It tries
;;;; the same grasp, PINCH-2-PARALLEL, but refuses it because the faces above and below the hand
;;;; are both blocked and the block is thinner than the hand is wide: it takes the hand to be
;;;; shut in between the layers, which in fact end where the block ends.  It is too careful here.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 7.5 2.5 1.5)
            (WEIGHT 0.02)
            (u 0.4)
            (v 0.13)
            (CONSTRAINED Y2 Z1 Z2)
            (FORCE-NEEDED (0.2 1 0.2 0.1 0.1 0.2))
            (VELOCITY-NEEDED (0.2 1 0 0 0 0.2))))

(forward-chain)
