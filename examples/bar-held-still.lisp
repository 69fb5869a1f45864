;;;; A wooden bar is held on a bench while a screw is driven into its end X1.
;;;;
;;;; It lies on Z2; the end X1 is needed for the screw.  Nothing is to move, so VELOCITY-NEEDED
;;;; is all 0 and the quality is that of the forces alone: strength along X against the push, and
;;;; about X against the turning.  A person grips the bar from above or behind and backs its far
;;;; end with the palm.  SUPER-GRIP answers PINCH-3-U-SHAPE: two fingers on the sides, the thumb
;;;; on the top and the palm behind, at X2; but it counts on the three fingers only, since its
;;;; palm never presses.  As forces go PINCH-3-C-SHAPE, with the fingers on the same faces, is
;;;; equal, and was tried later.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 10 4 4)
            (WEIGHT 0.1)
            (u 0.5)
            (v 0.17)
            (CONSTRAINED Z2 X1)
            (FORCE-NEEDED (0.6 0.2 0.3 1 0.3 0.3))
            (VELOCITY-NEEDED (0 0 0 0 0 0))))

(forward-chain)
