;;;; A block of rubbery foam, wider than the hand opens, stands against a wall.
;;;;
;;;; It rests on Z2 and touches the wall with Y2; it is to be lifted and carried away.  A person
;;;; uses two hands, or digs the fingers in.  SUPER-GRIP finds X1 and X2 free and parallel, but
;;;; too far apart to be pinched.  It answers PINCH-3-CORNER: three fingertips on the top, the
;;;; front and one side, near enough to each other, hold a light block whose friction is as high
;;;; as this.  Left or right is all the same, and the first that was tried is taken.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 12.5 12 11)
            (WEIGHT 0.05)
            (u 1.0)
            (v 0.33)
            (CONSTRAINED Z2 Y2)
            (FORCE-NEEDED (0.3 0.3 1 0.2 0.2 0.2))
            (VELOCITY-NEEDED (0.3 0.5 0.5 0 0 0))))

(forward-chain)
