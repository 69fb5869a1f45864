;;;; A lead brick lies on a bench and is to be lifted on to a stack.
;;;;
;;;; It rests on Z2; every other face is free, and the hand can span it easily.  Its weight is
;;;; given for fingers that press with 10 N each, the weight of a litre of milk.  A person takes
;;;; it with both hands under its ends.  SUPER-GRIP answers that it can't: it finds grasps that
;;;; fit the brick, but under so much weight, with the low friction of metal, the fingers of all
;;;; of them would slip.  The reason names the load and what the grasp can bear.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 20 10 5)
            (WEIGHT 11.3)
            (u 0.4)
            (v 0.13)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.3 0.3 1 0.3 0.3 0.3))
            (VELOCITY-NEEDED (0.5 0.5 0.5 0 0 0.3))))

(forward-chain)
