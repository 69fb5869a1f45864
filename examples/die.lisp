;;;; A die lies on a table and is to be picked up, turned over and set down.
;;;;
;;;; It rests on Z2.  The task wants velocity mainly along X and Z, to carry it, and about Y, to
;;;; turn it over.  A person takes it from above between thumb and forefinger, since there is no
;;;; room for more on so small a thing, and rolls it between them.  SUPER-GRIP answers the same:
;;;; PINCH-2-PARALLEL from above.  For PINCH-3-PARALLEL the faces are narrower than the space
;;;; between two fingers, and the grasps with a third finger on another face hold more firmly but
;;;; move the die less well.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 1.2 1.2 1.2)
            (WEIGHT 0.002)
            (u 0.4)
            (v 0.13)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.5 0.5 1 0 0 0))
            (VELOCITY-NEEDED (1 0.5 1 0 1 0.5))))

(forward-chain)
