;;;; reason.lisp -- why a box can't be grasped: what a rule said, with the figures that it went by.

(in-package :supergrip-test)
(define-suite reason "Why a box can't be grasped: what a rule said, with the figures that it went by.")

(defun refused-box (size u constrained &rest clauses)
  `(,@clauses (size ,@size) (weight 0.1d0) (u ,u) (v 0.2d0) (constrained ,@constrained)
    (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1))))

(defparameter *refused*
  `((,(refused-box '(0.1d0 4 4) 0.5d0 '(x1))
     "TOO SMALL TO PICK UP: X1 and X2 are 0.1 cm apart, less than FINGER-WIDTH, 0.3; X1 is constrained"
     "It would pass that rule with X of 0.3 cm or more, or X1 free")
    (,(refused-box '(0.1d0 4 4) 0.5d0 '(x1 x2))
     "TOO SMALL TO PICK UP: X1 and X2 are 0.1 cm apart, less than FINGER-WIDTH, 0.3; X1, X2 are constrained"
     "It would pass that rule with X of 0.3 cm or more, or all of X1, X2 free")
    (,(refused-box '(0.1d0 0.2d0 4) 0.5d0 '(x1 y2))
     "TOO SMALL TO PICK UP: Y1 and Y2 are 0.2 cm apart, less than FINGER-WIDTH, 0.3; X1 and X2 are 0.1 cm apart, less than FINGER-WIDTH, 0.3; X1, Y2 are constrained"
     "It would pass that rule with all of X1, Y2 free")
    (,(refused-box '(1 40 40) 0.5d0 '(x1) '(units mm finger))
     "TOO SMALL TO PICK UP: X1 and X2 are 1 mm apart, less than FINGER-WIDTH, 3; X1 is constrained"
     "It would pass that rule with X of 3 mm or more, or X1 free")
    (,(refused-box '(4 4 4) 0.05d0 '())
     "TOO SLIPPERY TO PICK UP: u is 0.05, no more than SLIPPERY-U, 0.1"
     "It would pass that rule with u of more than 0.1")
    (,(refused-box '(4 4 4) 0.5d0 '(x1 x2 y1 y2))
     "TOO CONSTRAINED TO PICK UP: X1, X2, Y1, Y2 are constrained"
     "It would pass that rule with one of X1, X2, Y1, Y2 free"))
  "Boxes that shipped rules refuse, the reasons, without CANT GRASP, and what lets them pass.")

(test a-rule-that-refuses-tells-its-figures
  (loop for (box reason remedy) in *refused*
        for plan = (supergrip:plan box)
        do (is (equal (format nil "CANT GRASP ~a" reason) (supergrip:plan-reason plan)))
           (is (equal (supergrip:plan-reason plan)
                      (getf (supergrip::plan-record plan) :reason)))
           (is (equal (list (format nil "The box can't be grasped: CANT GRASP ~a." reason)
                            (format nil "~a." remedy))
                      (subseq (printed (supergrip:explain-best plan)) 0 2)))))

(test both-notations-tell-the-figures
  (let ((record (supergrip::plan-record (supergrip:plan (first (first *refused*))))))
    (is (search (second (first *refused*)) (json-line record)))
    (is (search (second (first *refused*)) (lisp-line record)))))

(test the-papers-line-has-no-figures
  (let ((plan (supergrip:plan (first (first *refused*)))))
    (is (search "(RULE GRIP1 SAYS CANT GRASP TOO SMALL TO PICK UP)" (transcript plan)))
    (is (search "can't: CANT GRASP TOO SMALL TO PICK UP>" (princ-to-string plan)))))

(defun refusal (box rules)
  "Return the reason why BOX is refused by RULES, a text, and what lets it pass."
  (let ((plan (supergrip:plan box :knowledge (text-knowledge rules *good-grasps*))))
    (list (supergrip:plan-reason plan) (supergrip::remedy-sentence plan))))

(test what-several-facts-keep-from-being-said-is-told
  (is (equal '("CANT HOLD: Z1 and Z2 are 15 cm apart, no less than DIST-PINCH, 12; Y1 and Y2 are 14 cm apart, no less than DIST-PINCH, 12; X1 and X2 are 13 cm apart, no less than DIST-PINCH, 12"
               "It would pass that rule with Z of less than 12 cm, or Y of less than 12 cm, or X of less than 12 cm")
             (refusal (refused-box '(13 14 15) 0.5d0 '())
                      "(RULE ROOM (IF (OPPOSED (s1 s2)) (NOT LARGE (s1 s2)) (NOT CONSTRAINED (s1)))
                                  (THEN (REMEMBER ROOM)))
                       (RULE NONE (IF (NO ROOM)) (THEN (CANT HOLD)))")))
  (is (equal '("CANT HOLD: Y1 and Y2 are 0.2 cm apart, less than FINGER-WIDTH, 1; X1 and X2 are 0.1 cm apart, less than FINGER-WIDTH, 1"
               "No single change lets it pass that rule")
             (refusal (refused-box '(0.1d0 0.2d0 5) 0.5d0 '())
                      "(RULE R (IF (SMALL (s1 s2))) (THEN (CANT HOLD)))")))
  (is (equal '("CANT SAY" "No single change lets it pass that rule")
             (refusal (refused-box '(3 4 5) 0.5d0 '())
                      "(RULE R (IF (OPPOSED (s1 s2))) (THEN (CANT SAY)))"))
      "what no number decides"))
