;;;; A long block of eraser rubber fills a slot and is to be taken out of it.
;;;;
;;;; The slot touches both ends, X1 and X2, the back Y2 and the bottom Z2: the top Z1 and the
;;;; front Y1 are free.  A person presses a finger on the top, another on the front, and draws
;;;; the block out by friction.  SUPER-GRIP answers the same: PINCH-3-ADJACENT with two fingers
;;;; on the front and one on the top, the palm above.  Such a grasp closes only if friction can
;;;; be greater than the force that presses, as it is on rubber and not on wood; two fingers on
;;;; the front bear more than one.  The ends being blocked, the block must also be longer than
;;;; the hand is wide.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 10 2.2 2)
            (WEIGHT 0.06)
            (u 1.4)
            (v 0.45)
            (CONSTRAINED X1 X2 Y2 Z2)
            (FORCE-NEEDED (0.2 0.3 0.5 0.2 0.2 0.2))
            (VELOCITY-NEEDED (0 0.5 1 0 0 0))))

(forward-chain)
