;;;; A cube of packing foam, too wide for the hand, is lifted from the floor.
;;;;
;;;; It stands on Z2.  A little strength is needed to all sides, and it is to move up.  All its pairs of
;;;; faces are farther apart than the hand opens, and the middles of three faces that meet are too far
;;;; apart for three fingers.  A person with one hand takes a corner of it.  With the grasps of
;;;; further-work SUPER-GRIP answers the same, WIDE-CORNER: a finger on each face, no farther from the
;;;; corner than the hand reaches, since rough foam lets three faces hold.  The shipped grasps can't.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(cl:setq *knowledge* (load-knowledge
                      :hand (merge-pathnames "further-work/"
                                             (uiop:pathname-directory-pathname *load-truename*))))

(setq box '((SIZE 20 20 20)
            (WEIGHT 0.05)
            (u 0.9)
            (v 0.3)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.2 0.2 0.3 0 0 0))
            (VELOCITY-NEEDED (0 0 1 0 0 0))))

(forward-chain)
