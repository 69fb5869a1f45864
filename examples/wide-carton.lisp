;;;; An empty removal carton stands on the floor and is to be carried away.
;;;;
;;;; Only its bottom Z2 is blocked, and it weighs little, but each of its faces is farther from
;;;; the opposite one than the hand opens.  A person takes it between two hands or holds it by a
;;;; flap.  SUPER-GRIP has one hand and no grasp that could hold a flap.  It answers that it
;;;; can't: the narrowest pair of faces that a grasp could close across is 30 cm, and the hand
;;;; opens to 12.  A corner is no way out, whatever the friction: the middles of its faces are
;;;; farther apart than that, too.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(setq box '((SIZE 40 30 25)
            (WEIGHT 0.4)
            (u 0.5)
            (v 0.17)
            (CONSTRAINED Z2)
            (FORCE-NEEDED (0.3 0.3 1 0.3 0.3 0.3))
            (VELOCITY-NEEDED (0.5 0.5 0.5 0 0 0.3))))

(forward-chain)
