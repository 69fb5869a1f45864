;;;; A credit card lies flat on a table and is to be put into a slot.
;;;;
;;;; It rests on Z2 with its whole face and is far thinner than a fingertip.  A person can't
;;;; pinch it either, and pushes it over the edge of the table, or lifts a side with a
;;;; fingernail, which the gripper lacks.  SUPER-GRIP answers at once that it can't: the box is
;;;; too small to pick up, since two of its faces are very close together and one of these is
;;;; blocked.  The next step is credit-card-over-edge.lisp.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 8.6 5.4 0.08)
            (WEIGHT 0.005)
            (u 0.4)
            (v 0.13)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (1 0.3 0.3 0.3 0 0.3))
            (VELOCITY-NEEDED (1 0.3 0.3 0 0 0.5))))

(forward-chain)
