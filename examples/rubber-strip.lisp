;;;; A square strip of rubber lies in the angle of a shelf and is to be turned and slid.
;;;;
;;;; It touches the wall with Y2 and the shelf with Z2; its ends X1 and X2 carry wet glue, which
;;;; the task needs.  It is to be turned about its own length and moved along it, so strength and
;;;; velocity are needed mainly along and about X.  A person would draw it forward with a
;;;; fingertip and then turn it between finger and thumb.  SUPER-GRIP doesn't plan such a first
;;;; step and answers PINCH-2-ADJACENT, one finger on the top and one on the front: rubber has
;;;; friction enough, and two fingertips turn and slide a strip more freely than three.  Whether
;;;; the palm is above or in front makes no difference to the figures; the first tried is taken.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 10 1.5 1.5)
            (WEIGHT 0.03)
            (u 1.3)
            (v 0.43)
            (CONSTRAINED X1 X2 Y2 Z2)
            (FORCE-NEEDED (1 0.2 0.2 0.4 0 0))
            (VELOCITY-NEEDED (0.6 0.3 0.3 0.6 0 0))))

(forward-chain)
