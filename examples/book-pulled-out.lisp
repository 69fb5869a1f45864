;;;; A paperback has been pulled out of its row by more than half, and is taken away.
;;;;
;;;; Now its sides Y1 and Y2 can be reached from the spine X1; it stands on Z2, and its far end
;;;; X2 is still between the neighbours.  The task is a pull along X, and to bear the book.  A
;;;; person takes it by its two sides, palm towards the spine.  SUPER-GRIP answers the same:
;;;; PINCH-3-PARALLEL across Y with the palm at X1, since the hand is most mobile along its own
;;;; line of approach and the fingers reach the middle of a small book, where its weight does not
;;;; turn it.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 11 1.5 18)
            (WEIGHT 0.2)
            (u 0.5)
            (v 0.17)
            (CONSTRAINED X2 Z2)
            (FORCE-NEEDED (1 0.2 0.5 0 0.5 0.2))
            (VELOCITY-NEEDED (1 0.2 0.2 0 0.3 0))))

(forward-chain)
