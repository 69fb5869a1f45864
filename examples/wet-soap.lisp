;;;; A wet bar of soap lies in its dish and is to be picked up.
;;;;
;;;; It rests on Z2; a film of water and soap leaves next to no friction.  A person doesn't pinch
;;;; it either, but puts the whole hand around it or scoops it up, so that it rests in the hand
;;;; without friction.  SUPER-GRIP only knows grasps with the fingertips, which hold by friction
;;;; alone, and answers at once that it can't: the soap is too slippery to pick up.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 8.5 5.5 2.5)
            (WEIGHT 0.12)
            (u 0.05)
            (v 0.02)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.3 0.3 1 0.3 0.3 0.3))
            (VELOCITY-NEEDED (0.5 0.5 1 0 0 0.3))))

(forward-chain)
