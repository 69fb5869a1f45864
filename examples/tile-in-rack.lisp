;;;; A tile stands in a rack and is held by its upper half while something pushes against it.
;;;;
;;;; The rack's posts are at X1 and X2, it stands on Z2.  Strength is needed against tilting, about X.
;;;; The hand comes from above, since there is no other way, and fingers side by side would stand along
;;;; the very line about which the tile tilts.  A person lays the fingers down one side of the tile and
;;;; presses the thumb against the other.  With the grasps of further-work SUPER-GRIP answers the same,
;;;; LATERAL across Y: one tip is deeper than the other.  The shipped grasps hold it as well as
;;;; PINCH-3-PARALLEL can.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(cl:setq *knowledge* (load-knowledge
                      :hand (merge-pathnames "further-work/"
                                             (uiop:pathname-directory-pathname *load-truename*))))

(setq box '((SIZE 12 2 8)
            (WEIGHT 0.1)
            (u 0.4)
            (v 0.15)
            (CONSTRAINED X1 X2 Z2)
            (FORCE-NEEDED (0 0.2 0.3 1 0 0))
            (VELOCITY-NEEDED (0 0 0 0 0 0))))

(forward-chain)
