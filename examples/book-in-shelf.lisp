;;;; A book stands in a full row on a shelf and is to be pulled out.
;;;;
;;;; Its neighbours touch Y1 and Y2, the shelf Z2, the wall behind X2; the spine X1 and the top
;;;; Z1 are free.  The task is a pull along X, and some turning about Y.  A person hooks a finger
;;;; over the top edge of the spine and tilts the book out, or pushes the neighbours back to
;;;; reach its sides.  SUPER-GRIP answers that it can't: two adjacent faces are all that is left,
;;;; and to hold the book by these would take friction that no book cover has, and room between
;;;; the neighbours.  It has no grasp that hooks, and it doesn't move the neighbours.  See
;;;; book-pulled-out.lisp for the next step.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 17 3 24)
            (WEIGHT 0.9)
            (u 0.5)
            (v 0.17)
            (CONSTRAINED Y1 Y2 X2 Z2)
            (FORCE-NEEDED (1 0 0.3 0 0.5 0))
            (VELOCITY-NEEDED (1 0 0 0 0.5 0))))

(forward-chain)
