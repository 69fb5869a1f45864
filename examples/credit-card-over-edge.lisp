;;;; The card of credit-card-on-table.lisp, pushed half over the edge of the table.
;;;;
;;;; The half towards X1 sticks out, so fingers reach it from above and from below; the side X2
;;;; is still on the table.  It is then put into a slot: strength and velocity along X, a little
;;;; turning about Z.  A person takes the free edge, thumb above and fingers below, from outside.
;;;; SUPER-GRIP answers the same, PINCH-3-PARALLEL across Z with the palm at X1, because two
;;;; fingers side by side keep the card from turning and the hand moves best along X.  It knows
;;;; faces only as a whole, and so puts the fingers in the middle of the card, where a person
;;;; would stay nearer to the free edge.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 8.6 5.4 0.08)
            (WEIGHT 0.005)
            (u 0.4)
            (v 0.13)
            (CONSTRAINED X2)
            (FORCE-NEEDED (1 0.3 0.3 0.3 0 0.3))
            (VELOCITY-NEEDED (1 0.3 0.3 0 0 0.5))))

(forward-chain)
