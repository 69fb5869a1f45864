;;;; A wooden toy block stands among others and is to be set on top of a tower.
;;;;
;;;; It rests on Z2.  To place it the hand must move it as well along X as along Y, and lift it,
;;;; with only a little turning.  A child puts thumb and fingertips around it, from above.
;;;; SUPER-GRIP answers PINCH-3-C-SHAPE from above: finger and thumb across, the third finger on
;;;; a side between them.  PINCH-3-PARALLEL comes next: it bears less, and from above it is
;;;; slower along one of the two axes.  All four ways round are alike on a cube; the first tried
;;;; is taken.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 4 4 4)
            (WEIGHT 0.04)
            (u 0.5)
            (v 0.17)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.5 0.5 1 0.2 0.2 0.4))
            (VELOCITY-NEEDED (1 1 0.7 0 0 0.3))))

(forward-chain)
