;;;; mobility.lisp -- how well fingers move what they hold.

(in-package :supergrip-test)
(define-suite mobility "How well fingers move what they hold.")

(defun doubles-of (&rest numbers)
  (map '(simple-array double-float (*)) (lambda (number) (coerce number 'double-float)) numbers))

(defun mobility-of (contacts face &key (length 3.2d0) (distance 6.05d0) (approach '(0 0 1)))
  "Return the mobility of fingers at CONTACTS, a list of (position inward-normal)."
  (supergrip-statics:mobility
   (loop for (position) in contacts collect (apply #'doubles-of position))
   (loop for (nil normal) in contacts collect (apply #'doubles-of normal))
   (apply #'doubles-of approach) (coerce face 'double-float) length distance))

(defun rounded (numbers)
  (loop for number in numbers collect (/ (round (* 100 number)) 100)))

(test a-pinch-across-the-pencil
  (is (equal '(91/100 63/100 1 1/5 1 1)
             (rounded (mobility-of '(((1 0 0) (-1 0 0)) ((-1 0 0) (1 0 0))) 1))))
  ;; Two fingers side by side move as the box turns about the pair, so they may pivot more.
  (is (equal '(91/100 63/100 1 1/2 1 1)
             (rounded (mobility-of '(((1 1/2 0) (-1 0 0)) ((1 -1/2 0) (-1 0 0))
                                     ((-1 0 0) (1 0 0)))
                                   1)))))

(test joints-turn-no-faster-than-1
  ;; What moves the tip across is the turn of the base alone, at the arm from base to tip.
  (let ((arm (- 3.025d0 1)))
    (is (nearly-p (/ arm 3.2d0)
                  (second (mobility-of '(((1 0 0) (-1 0 0)) ((-1 0 0) (1 0 0))) 1)))))
  ;; A right angle at the elbow, the base under it: the links stand along the two axes, 3 long each.
  ;; The tip is 3 outward and 3 deep.  Outward it moves by the first joint alone, along by the
  ;; second.
  (let ((twist (mobility-of '(((6 0 0) (-1 0 0)) ((-6 0 0) (1 0 0))) 2.7d0
                            :length 3d0 :distance 6d0)))
    (is (nearly-p 1 (first twist)))
    (is (nearly-p 1 (third twist)))
    (is (nearly-p 1 (second twist)))))

(test a-finger-that-does-not-reach-moves-nothing
  (is (every #'zerop (mobility-of '(((1 0 0) (-1 0 0)) ((-1 0 0) (1 0 0))) 20))))

(test a-tip-under-its-base-is-not-moved-across
  (is (zerop (second (mobility-of '(((3.025d0 0 0) (-1 0 0)) ((-3.025d0 0 0) (1 0 0))) 1)))))

(test a-finger-on-the-palm-s-face-stands-opposite-to-the-others
  (let ((twist (mobility-of '(((2 0 0) (-1 0 0)) ((0 2 0) (0 -1 0)) ((0 0 2) (0 0 -1))) 2
                            :approach '(0 0 -1))))
    (is (every (lambda (entry) (< 0 entry 1.0000001)) twist) "~a" twist)
    ;; X and Y are the same to the three.
    (is (nearly-p (first twist) (second twist)))
    (is (nearly-p (fourth twist) (fifth twist)))))

(test any-direction-of-approach-is-as-good
  ;; A quarter turn about X of hand and contacts turns the mobility.
  (let ((twist (mobility-of '(((1 1/2 0) (-1 0 0)) ((1 -1/2 0) (-1 0 0)) ((-1 0 0) (1 0 0))) 1)))
    (destructuring-bind (x y z about-x about-y about-z)
        (mobility-of '(((1 0 1/2) (-1 0 0)) ((1 0 -1/2) (-1 0 0)) ((-1 0 0) (1 0 0))) 1
                     :approach '(0 -1 0))
      (is (every #'nearly-p twist (list x z y about-x about-z about-y))))))
