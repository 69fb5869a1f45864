;;;; The middle block of a layer in a tower of wooden blocks is to be drawn out.
;;;;
;;;; Its neighbours touch Y1 and Y2, the layers below and above Z2 and Z1; only its ends X1 and
;;;; X2 are free.  A person pokes it out with one fingertip, which is no grasp, and takes it when
;;;; it sticks out.  SUPER-GRIP answers at once that it can't: with two pairs of opposite faces
;;;; blocked it is too constrained to pick up, since the two ends leave no place for the palm.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 7.5 2.5 1.5)
            (WEIGHT 0.02)
            (u 0.4)
            (v 0.13)
            (CONSTRAINED Y1 Y2 Z1 Z2)
            (FORCE-NEEDED (1 0.2 0.2 0.1 0.1 0.1))
            (VELOCITY-NEEDED (1 0 0 0 0 0))))

(forward-chain)
