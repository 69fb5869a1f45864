;;;; same-forms.lisp -- turns of the hand that the forms of a grasp tell apart are tried both ways.

(in-package :supergrip-test)
(define-suite same-forms
  "Turns of the hand that the forms of a grasp tell apart are tried both ways.")

(defun kinds-of-turns (&rest changes)
  "Return the kinds of the turns that leave the grasp G with CHANGES the same."
  (let ((knowledge (text-knowledge "(RULE R (IF (NOT SLIPPERY)) (THEN (TRY G)))"
                                   (format nil "~a~a" *small-gripper*
                                           (apply #'grasp-text changes)))))
    (mapcar #'first (supergrip::allowed-turns
                     (supergrip::grasp-draft (first (supergrip:knowledge-grasps knowledge)))))))

(test a-half-turn-is-told-by-what-is-constrained
  (loop for (key text) in '((:conditions "(NOT (CONSTRAINED O1))")
                            (:conditions "((CONSTRAINED O1) AND (NOT (CONSTRAINED O2)))")
                            (:twist "((IF (CONSTRAINED O1) 0.2 1) 1 1 1 1 1)")
                            (:wrench "(1 (COND ((CONSTRAINED O2) u) (T 1)) 1 1 1 1)")
                            (:offset "(LIST 0 0 0 0 (IF (CONSTRAINED O1) -1 0) (IF (CONSTRAINED O1) 1 0))")
                            (:contacts "((N1 0 (IF (CONSTRAINED O1) 1 0)) (N2 0 0))"))
        do (is (null (kinds-of-turns key text)) "~a" text))
  (loop for (key text) in '((:conditions "(NOT ((CONSTRAINED O1) AND (CONSTRAINED O2)))")
                            (:conditions "((CONSTRAINED O2) OR (u > 1) OR (CONSTRAINED O1))")
                            (:conditions "(NOT (CONSTRAINED N1))")
                            (:conditions "(NOT (CONSTRAINED A1))")
                            (:twist "((+ (IF (CONSTRAINED O1) 1 0) (IF (CONSTRAINED O2) 1 0)) 1 1 1 1 1)"))
        do (is (equal '(:half-turn) (kinds-of-turns key text)) "~a" text)))

(test a-third-turn-is-told-by-what-differs-between-axes
  (flet ((kinds (&rest changes)
           (apply #'kinds-of-turns :used-surfaces "(N1 O1 A1)" :palm "A1"
                  :contacts "((N1 0 0) (O1 0 0) (A1 0 0))"
                  (append changes '(:wrench "(u u u v v v)")))))
    (is (equal '(:third-turn :third-turn) (kinds)))
    (is (equal '(:third-turn :third-turn)
               (kinds :wrench "((DIST '(N1 N2)) (DIST '(O1 O2)) (DIST '(A1 A2)) 1 1 1)")))
    (is (null (kinds :wrench "((DIST '(O1 O2)) (DIST '(N1 N2)) (DIST '(A1 A2)) 1 1 1)")))
    (is (null (kinds :twist "(1 0.5 1 1 1 1)")))
    (is (null (kinds :conditions "((DIST '(N1 N2)) < 5)")))))

(test no-grasp-is-lost-by-what-its-conditions-ask-of-one-side
  "With O1 free asked for, the box is held with its free side there, whichever that is."
  (let ((knowledge (text-knowledge
                    "(RULE R (IF (NOT SLIPPERY)) (THEN (TRY G)))"
                    (format nil "~a~a" *small-gripper*
                            (grasp-text :conditions "(NOT (CONSTRAINED O1))")))))
    (dolist (constrained '((:x1 :z2) (:x2 :z2) (:z1 :x1) (:z1 :x2)))
      (let ((plan (supergrip:plan (with-entries *good-box* :size '(4 4 4) :constrained constrained)
                                  :knowledge knowledge)))
        (is (= 2 (length (supergrip:plan-possible plan))) "~a" constrained)))))
