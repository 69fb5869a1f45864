;;;; A small rubber-coated cube lies in the corner of a tray and is to be lifted out.
;;;;
;;;; Bottom, back and one side touch the tray: Z2, X2 and Y2.  Of every pair of opposite faces
;;;; one is blocked, so that nothing can be pinched; the three faces that meet in the free corner
;;;; are left.  A person would drag the cube out of the corner with a fingertip and then pinch
;;;; it.  SUPER-GRIP doesn't plan such a first step, but it needs none: PINCH-3-CORNER, a
;;;; fingertip on each free face, holds where friction is as high as here.  For PINCH-2-ADJACENT
;;;; and PINCH-3-ADJACENT the friction is not enough.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 3 3 3)
            (WEIGHT 0.03)
            (u 0.9)
            (v 0.3)
            (CONSTRAINED X2 Y2 Z2)
            (FORCE-NEEDED (0.5 0.5 1 0.2 0.2 0.2))
            (VELOCITY-NEEDED (0.5 0.5 1 0 0 0))))

(forward-chain)
