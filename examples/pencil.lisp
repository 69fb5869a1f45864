;;;; A pencil is picked up from a table and used to write: the session that the paper prints.
;;;;
;;;; It lies on Z2 and writes with X1.  Strength is needed along its axis, moments and velocities
;;;; across it.  A person holds a pencil between thumb and two fingers, from above and across:
;;;; SUPER-GRIP answers the same, PINCH-3-PARALLEL across Y.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 12 2 2)
            (WEIGHT 0.2)
            (u 0.8)
            (v 0.2)
            (CONSTRAINED Z2 X1)
            (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))
            (VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))))

(forward-chain)
