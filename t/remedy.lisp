;;;; remedy.lisp -- what lets a box pass the rule that refused it is so, and nothing else is denied.

(in-package :supergrip-test)
(define-suite remedy
  "What lets a box pass the rule that refused it: it does, and nothing else is denied.")

(defun numbers-after (mark text)
  "Return the part of TEXT after MARK, or NIL."
  (let ((place (search mark text)))
    (and place (subseq text (+ place (length mark))))))

(test what-a-reason-asks-for-lets-the-box-pass
  "A size or a friction that is asked for, and a face that is to be free, help alone."
  (let ((helped 0))
    (dolist (box (random-boxes 600 31))
      (let* ((plan (supergrip:plan box)) (stop (supergrip::plan-stop plan))
             (wanted (and stop (numbers-after "pass that rule with "
                                             (or (supergrip::remedy-sentence plan) "")))))
        (flet ((passes-p (change)
                 (not (equalp (supergrip::stop-text stop)
                              (supergrip::short-reason
                               (supergrip:plan (substitute change (first change) box :key #'first)))))))
          (dolist (face '("X1" "X2" "Y1" "Y2" "Z1" "Z2"))
            (when (and wanted (search (format nil "or ~a free" face) wanted))
              (incf helped)
              (is (passes-p `(constrained ,@(remove face (rest (assoc 'constrained box))
                                                    :test #'string=)))
                  "~s" box)))
          (when (and wanted (search "u of more than 0.1" wanted))
            (incf helped)
            (is (passes-p '(u 0.1000001d0)) "~s" box)))))
    (is (> helped 50))))


(defun remedy-of (rules box)
  "Return what lets BOX pass the rule that refuses it, of RULES, a text."
  (second (refusal box rules)))

(test what-is-on-the-threshold-must-go-beyond-it
  (is (equal "It would pass that rule with X of less than 12 cm"
             (remedy-of "(RULE R (IF (LARGE (s1 s2))) (THEN (CANT HOLD)))"
                        (refused-box '(12 3 4) 0.5d0 '()))))
  (is (equal "It would pass that rule with u of more than 0.1"
             (remedy-of "(RULE R (IF (SLIPPERY)) (THEN (CANT HOLD)))"
                        (refused-box '(2 3 4) 0.1d0 '())))))

(test a-rounded-number-that-is-asked-for-is-enough
  (let ((rules "(RULE R (IF (SMALL (s1 s2))) (THEN (CANT HOLD)))"))
    (is (equal "It would pass that rule with X of 0.3938 in or more"
               (remedy-of rules (refused-box '(0.2d0 3 4) 0.5d0 '() '(units in finger)))))
    (is (null (remedy-of rules (refused-box '(0.3938d0 3 4) 0.5d0 '() '(units in finger))))))
  (is (equal "It would pass that rule with X of less than 4.724 in"
             (remedy-of "(RULE R (IF (LARGE (s1 s2))) (THEN (CANT HOLD)))"
                        (refused-box '(5 3 4) 0.5d0 '() '(units in finger)))))
  (is (equal '("1.234e+7" "1.235e+7" "0" "0.3333" "1000000" "1000001")
             (loop for (number up) in '((12345678d0 nil) (12345678d0 t) (0d0 t)
                                        (0.3333333333333333d0 nil) (1000000.5d0 nil)
                                        (1000000.5d0 t))
                   collect (supergrip::number-text-rounded number up)))))

(test what-an-earlier-rule-refuses-passes-no-rule
  (is (equal "No single change lets it pass that rule"
             (remedy-of "(RULE BIG (IF (NOT SMALL (s1 s2)) (OPPOSED (s1 s2)) (SLIPPERY))
                               (THEN (CANT LIFT)))
                         (RULE R (IF (SMALL (s1 s2)) (SLIPPERY)) (THEN (CANT HOLD)))
                         (RULE S (IF (NOT SLIPPERY)) (THEN (CANT GUESS)))"
                        (refused-box '(0.1d0 0.2d0 0.3d0) 0.5d0 '())))
      "a slippery box is refused by R, one that is larger, too, by BIG"))

(defparameter *single-change-rules*
  '("(INPUT WET)
     (RULE R (IF (NOT WET) (NARROW (s1 s2))) (THEN (CANT HOLD)))"
    "(RULE R (IF (NARROW (s1 s2)) (NOT SLIPPERY)) (THEN (CANT HOLD)))"
    "(INPUT FRAGILE (s1 s2))
     (RULE R (IF (LARGE (s1 s2)) (NOT FRAGILE (s1 s2)) (NOT SMALL (s3 s4))) (THEN (CANT HOLD)))"
    "(RULE P (IF (LARGE (s1 s2))) (THEN (REMEMBER P (s1))))
     (RULE Q (IF (P (s1)) (NOT CONSTRAINED (s1))) (THEN (REMEMBER Q)))
     (RULE R (IF (NO Q) (NARROW (s1 s2))) (THEN (CANT HOLD)))")
  "Rules that one change of the box satisfies, which none of the facts that they go by names.")

(defun changed-once (box)
  "Return descriptions that differ from BOX, which says no facts, in one thing."
  (flet ((with (key &rest values) (substitute (cons key values) key box :key #'first)))
    (append (loop for axis from 1 to 3
                  append (loop for size in '(0.9d0 1.5d0 5 12 20)
                               collect (let ((clause (copy-list (assoc 'size box))))
                                         (setf (nth axis clause) size)
                                         (apply #'with clause))))
            (list (with 'u 0.05d0) (with 'u 0.5d0))
            (loop for face in '(x1 x2 y1 y2 z1 z2)
                  for faces = (box-part box 'constrained)
                  collect (apply #'with 'constrained (if (member face faces)
                                                         (remove face faces)
                                                         (cons face faces)))))))

(test that-no-single-change-helps-is-not-said-where-one-does
  (let ((denied 0) (state (sb-ext:seed-random-state 3)))
    (flet ((held-p (box rules)
             (equal "CANT HOLD" (let ((reason (first (refusal box rules))))
                                  (subseq reason 0 (min 9 (length reason)))))))
      (dolist (rules *single-change-rules*)
        (loop repeat 40
              for box = (refused-box (loop repeat 3
                                           collect (random-element '(0.5d0 1 1.5d0 2 12 13) state))
                                     (random-element '(0.05d0 0.5d0) state) (random-faces state))
              when (and (held-p box rules)
                        (equal "No single change lets it pass that rule" (remedy-of rules box)))
                do (incf denied)
                   (is (loop for other in (changed-once box) always (held-p other rules))
                       "~a~%~s" rules box))))
    (is (null (remedy-of (first *single-change-rules*) (refused-box '(1 1 4) 0.5d0 '())))
        "a fact would do")
    (is (null (remedy-of (second *single-change-rules*) (refused-box '(1 1 4) 0.5d0 '())))
        "so would less friction")
    (is (> denied 3))))
