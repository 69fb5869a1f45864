;;;; A carton of juice, half full, is lifted and poured out over its edge X1.
;;;;
;;;; It stands on Z2.  To pour is to turn it about Y, and to lift it is strength along Z.  A
;;;; person reaches forward along Y, holds it with the thumb on one side and fingers on the
;;;; other, and pours sideways by turning the forearm.  SUPER-GRIP answers the same:
;;;; PINCH-3-PARALLEL across X, the palm at a face of Y, so that the turn is about its own line
;;;; of approach, where it is most mobile.  Across Y it would have to turn the carton about the
;;;; line through the fingers, where it is not.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 7 7 20)
            (WEIGHT 0.6)
            (u 0.6)
            (v 0.2)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.3 0.2 1 0.2 0.8 0.2))
            (VELOCITY-NEEDED (0.5 0.3 0.5 0 1 0))))

(forward-chain)
