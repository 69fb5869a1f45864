;;;; A carton of juice, a third full, is taken off a chute that slopes down by 30 degrees.
;;;;
;;;; It lies on its side Y2 and leans with its bottom, Z2, against the stop at the lower end.  POSE
;;;; says so: in the world, Z up, the carton's Y is (1/2, 0, 0.866), square to the chute, and its Z
;;;; (-0.866, 0, 1/2), up along it.  The juice has run down, so the mass lies 1 cm nearer to Z2 than
;;;; the middle: CENTRE.  It is to be drawn off the chute, along Y.  A person reaches down square to
;;;; the chute and takes the carton by the two sides that are free.  SUPER-GRIP answers the same:
;;;; PINCH-3-PARALLEL across X, the palm over Y1, which comes from obliquely above.  If the mass lay
;;;; 4 cm from the middle, the carton would turn between the fingers: it can't be grasped then.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 7 7 20)
            (WEIGHT 0.4)
            (u 0.6)
            (v 0.2)
            (CONSTRAINED Y2 Z2)
            (FORCE-NEEDED (0.3 1 0.6 0.2 0.2 0.2))
            (VELOCITY-NEEDED (0.3 1 0.5 0.5 0 0.3))
            (POSE (60 0 90) (0.353553391 -0.353553391 -0.612372436 0.612372436))
            (CENTRE 0 0 -1)))

(forward-chain)
