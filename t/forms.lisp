;;;; forms.lisp -- operators are rows, and what they give does not depend on float traps.

(in-package :supergrip-test)
(define-suite forms "Operators are rows, and what they give does not depend on float traps.")

(defun small-knowledge (&rest changes)
  "Return the knowledge of the grasp G with CHANGES (see GRASP-TEXT) and a rule that tries it."
  (multiple-value-bind (knowledge problems)
      (text-knowledge "(RULE R (IF (OPPOSED (s1 s2))) (THEN (TRY G)))"
                      (format nil "~a~%~a" *small-gripper* (apply #'grasp-text changes)))
    (is (null (supergrip-data:errors-in problems)) "~{~a~}" problems)
    knowledge))

(defun small-box (u)
  `((size 4 4 4) (weight 0) (u ,u) (v 0.25d0) (constrained)
    (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1))))

(test an-operator-is-one-row
  (let ((supergrip::*operators* supergrip::*operators*))
    ;; Parameters may have any names.
    (supergrip::define-operator "HYPOTENUSE" (a value) (sqrt (+ (* a a) (* value value))))
    (supergrip::define-operator "LN" (x) (log x) :when (> x 0d0))
    (supergrip::define-operator "GCD" (x y) (float (gcd (round x) (round y)) 1d0) :counts (1))
    (let ((knowledge (small-knowledge :wrench "((HYPOTENUSE (* 3 u) (* 4 u)) (GCD 12 (* 9 u) 6) 1 1
                                                (HYPOTENUSE 3 4) (+ 9 (LN u)))")))
      (flet ((wrench (u)
               (let ((plan (supergrip:try-grasp "G" (small-box u) :knowledge knowledge)))
                 (supergrip:candidate-wrench (first (supergrip:plan-candidates plan)) plan))))
        (is (close-to '(1 1 3 5 5 9) (sort (wrench 1) #'<)))
        (is (null (wrench 0)) "the logarithm of 0 has no value")))
    (is (equal '("grasps.lisp:6: GRASP G, WRENCH: HYPOTENUSE takes 2 arguments, here 1: (HYPOTENUSE 1)")
               (grasp-reports :wrench "((HYPOTENUSE 1) 1 1 1 1 1)"))))
  (is (equal 1 (length (grasp-reports :wrench "((HYPOTENUSE 1 1) 1 1 1 1 1)")))
      "the row is gone"))

(test a-comparison-is-one-row
  (let ((supergrip::*operators* supergrip::*operators*))
    (supergrip::define-comparison "NEAR" (x y) (< (abs (- x y)) 0.1d0))
    (let ((knowledge (small-knowledge :conditions "((u NEAR 1) AND (NEAR u 1))")))
      (flet ((failure (u)
               (let* ((plan (supergrip:try-grasp "G" (small-box u) :knowledge knowledge))
                      (candidate (first (supergrip:plan-candidates plan))))
                 (multiple-value-list (supergrip:candidate-failure candidate plan)))))
        (is (equal '(nil) (failure 1.05d0)))
        (is (equal '(:conditions "u is 2, must be NEAR 1; u is 2, must be NEAR 1") (failure 2)))))))

(test no-kind-of-node-is-forgotten
  (signals error (macroexpand-1 '(supergrip::node-case (:six node) (:list () 1) (:let () 2))))
  (signals error (macroexpand-1 '(supergrip::node-case (:six node)
                                  (:list () 1) (:let () 2) (:cond () 3) (:not () 4))))
  (finishes (macroexpand-1
             '(supergrip::node-case (:six node) ((:list :let :cond :computed) () 1)))))

(test a-negative-twist-is-found-in-every-clause
  (loop for twist in '("(COND ((u > 1) (LIST 1 1 1 1 1 -1)) (T (LIST 1 1 1 1 1 1)))"
                       "(LET ((x 1)) (IF (u > 1) (1 1 1 1 1 x) (1 1 1 1 1 (- x 2))))")
        do (is (equal '("grasps.lisp:7: GRASP G, TWIST: an entry is below 0, but a mobility must be 0 or more")
                      (grasp-reports :twist twist)))))

;;; Float traps

(defparameter *float-traps*
  '((:overflow :invalid :divide-by-zero) () (:overflow) (:invalid :divide-by-zero))
  "Which float traps a caller may have enabled, SBCL's own first.")

(defun call-in-modes (function &rest modes)
  "Call FUNCTION with the floating point MODES set, as for SB-INT:SET-FLOATING-POINT-MODES."
  (let ((before (sb-int:get-floating-point-modes)))
    (unwind-protect (progn (apply #'sb-int:set-floating-point-modes modes)
                           (funcall function))
      (apply #'sb-int:set-floating-point-modes before))))

(defun plan-story (plan)
  "Return what was tried in PLAN, with what came of it."
  (loop for candidate in (supergrip:plan-candidates plan)
        collect (list (supergrip:candidate-grasp candidate)
                      (supergrip:candidate-outcome candidate)
                      (supergrip:candidate-quality candidate))))

(defun plan-texts (plan)
  "Return what is said of PLAN and of each of its failures."
  (cons (supergrip:plan-reason plan)
        (loop for candidate in (supergrip:plan-rejected plan)
              collect (nth-value 1 (supergrip:candidate-failure candidate plan)))))

(defun traps-matter-p (function)
  "True if what FUNCTION returns depends on the traps that are enabled."
  (let ((expected (call-in-modes function :traps (first *float-traps*))))
    (notevery (lambda (traps) (equal expected (call-in-modes function :traps traps)))
              (rest *float-traps*))))

(test plans-do-not-depend-on-float-traps
  (let* ((state (sb-ext:seed-random-state 41))
         (boxes (loop repeat 20000 collect (supergrip:parse-box (extreme-box state)))))
    (format t "~&   20000 extreme boxes, seed 41~%")
    (is (not (traps-matter-p (lambda ()
                               (loop for box in boxes
                                     collect (plan-story (supergrip:plan box)))))))
    (is (not (traps-matter-p (lambda ()
                               (loop for (box) on boxes by (lambda (list) (nthcdr 60 list))
                                     collect (plan-texts (supergrip:plan box)))))))))

(test plans-do-not-depend-on-rounding
  ;; The modes are set for the plan alone: SBCL itself does not bear a trap for inexact numbers.
  (let ((state (sb-ext:seed-random-state 43)))
    (loop repeat 300
          do (let* ((box (supergrip:parse-box (random-box state)))
                    (expected (plan-story (supergrip:plan box))))
               (loop for modes in '((:traps (:underflow :inexact))
                                    (:traps () :rounding-mode :positive-infinity))
                     do (is (equal expected
                                   (plan-story (apply #'call-in-modes
                                                      (lambda () (supergrip:plan box))
                                                      modes)))
                            "~s ~s" box modes))))))

(test random-forms-do-not-depend-on-float-traps
  (let ((state (sb-ext:seed-random-state 42)) (outcomes '()))
    (format t "~&   60 random grasps on 60 extreme boxes, seed 42~%")
    (loop with count = 0
          until (= count 60)
          do (let* ((forms (random-grasp-forms state))
                    (knowledge (knowledge-of-grasps forms))
                    (boxes (loop repeat 60 collect (extreme-box state))))
               (when (supergrip::knowledge-p knowledge)
                 (incf count)
                 (flet ((stories ()
                          (loop for box in boxes
                                collect (plan-story (supergrip:plan box :knowledge knowledge)))))
                   (loop for (nil outcome) in (reduce #'append (stories))
                         do (incf (getf outcomes outcome 0)))
                   (is (not (traps-matter-p #'stories)) "~s" forms)))))
    (loop for outcome in '(:conditions :offset :fingers :open :lifting :possible)
          do (is (plusp (getf outcomes outcome 0)) "no candidate ended at ~a" outcome))))

(test what-has-no-value-fails-its-step-with-or-without-traps
  (loop for (changes u outcome)
          in '(;; A false part of AND, and a true one of OR, hide what comes after it.
               ((:conditions "((u > 0) AND ((/ 1 u) > 1/2))") 0 :conditions)
               ((:conditions "((u > 0) AND ((/ 1 u) > 1/2))") 1 nil)
               ((:conditions "((u = 0) OR ((/ 1 u) > 1/2))" :wrench "(1 1 1 1 1 1)") 0 nil)
               ((:conditions "(NOT ((/ 1 u) > 1/2))") 0 :conditions)
               ((:conditions "(((/ 1 u) > 1/2) OR T)") 0 :conditions)
               ((:conditions "(((/ 1 u) < 1/2) OR T)") 0 :conditions)
               ;; An infinity or a NaN would be lost in each of these.
               ((:wrench "((MIN 1 (/ 1 u)) 1 1 1 1 1)") 0 :open)
               ((:wrench "((MAX 1 (/ -1 u)) 1 1 1 1 1)") 0 :open)
               ((:wrench "((/ 1 (/ 1 u)) 1 1 1 1 1)") 0 :open)
               ((:wrench "((+ 1 (/ 1 (* 1e300 u u))) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((POSIT (- 1 (* 1e300 u))) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((MAX 1 (SQRT (- u 1))) 1 1 1 1 1)") 0 :open)
               ((:wrench "((MAX 1 (EXPT u -1)) 1 1 1 1 1)") 0 :open)
               ((:wrench "((MIN 1 (EXPT u 99)) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((MIN 1 (* 1e300 u)) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((MAX (- 1 (* 1e300 u)) 1) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((/ 1 (* 1e300 u)) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((IF (< (* 1e300 u) 1) 1 2) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((+ 1 (SQRT (* 1e300 u)) 1) 1 1 1 1 1)") 1e10 :open)
               ((:wrench "((LET ((x (/ 1 u))) 1) 1 1 1 1 1)") 0 :open)
               ((:wrench "((COND ((< (/ 1 u) 1) 1) (T 2)) 1 1 1 1 1)") 0 :open)
               ((:wrench "((COND ((= u 0) 1) (T (/ 1 u))) 1 1 1 1 1)") 0 nil)
               ((:wrench "((IF (> (/ 1 u) 1) 1 2) 1 1 1 1 1)") 0 :open)
               ((:twist "((MIN 1 (/ 1 u)) 1 1 1 1 1)") 0 :open)
               ((:contacts "((N1 (MIN 0 (/ 1 u)) 0))" :wrench "(1 1 1 1 1 1)") 0 :fingers)
               ((:offset "(LET ((x (* 1e300 u))) (LIST 0 0 0 0 x (- x)))") 1e8 :offset)
               ((:offset "(LET ((x (* 1e300 u))) (LIST 0 0 0 0 (- x) x))") 170000000 :offset))
        do (let ((knowledge (apply #'small-knowledge changes)))
             (dolist (traps *float-traps*)
               (let* ((plan (call-in-modes (lambda ()
                                             (supergrip:try-grasp "G" (small-box u)
                                                                  :knowledge knowledge))
                                           :traps traps))
                      (candidate (first (supergrip:plan-candidates plan))))
                 (is (eq (or outcome :possible) (supergrip:candidate-outcome candidate))
                     "~s at ~a: ~a with ~s" changes u (supergrip:candidate-outcome candidate)
                     traps))))))

(test constants-without-a-value-are-reported-with-or-without-traps
  (dolist (traps *float-traps*)
    (flet ((reports (wrench)
             (call-in-modes (lambda ()
                              (grasp-reports :wrench (format nil "(~a 1 1 1 1 1)" wrench)))
                            :traps traps)))
      (loop for form in '("(/ 1 0)" "(EXPT 10 999)" "(EXPT 0 -1)" "(EXPT -8 1/3)"
                          "(SQRT -4)")
            do (is (equal (list (format nil "grasps.lisp:6: GRASP G, WRENCH: ~a has no value" form))
                          (reports form))
                   "~s" traps))
      (is (null (reports "(/ 1 3)"))))))
