;;;; check-contacts.lisp -- contacts that can't be meant are warned of, and no others.

(in-package :supergrip-test)
(define-suite check-contacts "Contacts that can't be meant are warned of, and no others.")

(defun contact-warnings (&rest changes)
  "Return what is said of the grasp G of GRASP-TEXT with CHANGES, whose gripper is *SMALL-GRIPPER*."
  (mapcar #'princ-to-string
          (nth-value 1 (text-knowledge "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                                       (format nil "~a~%~a" *small-gripper*
                                               (apply #'grasp-text changes))))))

(test fingers-that-nothing-opposes-are-warned-of
  (is (equal '("grasps.lisp:8: warning: GRASP G, CONTACTS: ((N1 0 0)): a single finger, on N1, can push the box, and not hold it; add a finger on a face that opposes, such as (N2 0 0)")
             (contact-warnings :contacts "((N1 0 0))")))
  (is (equal '("grasps.lisp:8: warning: GRASP G, CONTACTS: ((N1 0 0) (N1 1 0)): all fingers are on N1: they can push the box, and not hold it; add a finger on a face that opposes, such as (N2 0 0)")
             (contact-warnings :contacts "((N1 0 0) (N1 1 0))")))
  (is (equal '("grasps.lisp:3: warning: GRASP G, CONTACTS: a single finger, on N1, can push the box, and not hold it; add a finger on a face that opposes, such as (N2 0 0), and N2 to USED-SURFACES")
             (contact-warnings :used-surfaces "(N1 A2)" :contacts nil)))
  (is (null (contact-warnings :used-surfaces "(N1 O1 A2)" :contacts "((N1 0 0) (O1 0 0))"))
      "two adjacent faces hold with enough friction"))

(test fingers-farther-out-than-the-hand-is-long-are-warned-of
  (is (equal '("grasps.lisp:9: warning: GRASP G, CONTACTS: (N2 50 0): this is 50 cm from the grasp centre along O, and the hand's greatest dimension is DIST-PINCH, 12; places are lengths in cm; where a finger is that far out, let the gripper name how far")
             (contact-warnings :contacts (format nil "((N1 0 0)~% (N2 50 0))"))))
  (is (= 2 (length (contact-warnings :contacts "((N1 0 (- 13)) (N2 (+ 13 (DIST '(O1 O2))) 0))"))))
  (is (null (contact-warnings :contacts "((N1 0 0) (N2 12 0))")))
  (is (null (contact-warnings :contacts "((N1 0 0) (N2 (/ (DIST '(O1 O2)) 2) 0))"))
      "what grows with the box is within reach on small ones")
  (is (null (mapcar #'princ-to-string
                    (nth-value 1 (text-knowledge
                                  "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                                  (format nil "~a~%~a"
                                          (changed *small-gripper* "WIDTH-HAND 8"
                                                   "WIDTH-HAND 8 BAR 60")
                                          (grasp-text :contacts "((N1 BAR 0) (N2 0 0))"))))))
      "the gripper names how far"))

(test fingers-on-no-box-that-the-conditions-allow-are-warned-of
  (is (equal '("grasps.lisp:8: warning: GRASP G, CONTACTS: (N2 10 0): of 21964 boxes that CONDITIONS allow, on none is this a place of N2 that the hand reaches; at best it is 4.006 cm beyond the edge along O; places are lengths from the grasp centre, in cm")
             (contact-warnings :contacts "((N1 0 0) (N2 10 0))"
                               :conditions "((DIST '(O1 O2)) < DIST-PINCH)")))
  (is (null (contact-warnings :contacts "((N1 0 0) (N2 10 0))"
                              :conditions "((DIST '(N1 N2)) < DIST-PINCH)"))
      "it may be a long box")
  (is (null (contact-warnings :contacts "((N1 0 0) (N2 5 0))"
                              :conditions "((u > 99) AND ((DIST '(O1 O2)) < 3))"))
      "no box was looked at that the conditions allow")
  (is (null (contact-warnings :contacts "((N1 0 0) (N2 5 0))"
                              :conditions "((u > 1.5) AND (CONSTRAINED O1) AND ((DIST '(N1 N2)) < 0.7))"))))

(test a-reach-beyond-the-hand-is-warned-of
  (flet ((warnings (reach)
           (contact-warnings :offset nil :wrench nil :twist nil
                             :palm (format nil "A2~% REACH (A ~a)" reach))))
    (is (equal '("grasps.lisp:7: warning: GRASP G, REACH: the reach along A is 48.5 cm, and the hand's greatest dimension is DIST-PINCH, 12; where the hand reaches that far, let the gripper name how far")
               (warnings "48.5")))
    (is (null (warnings "12")))
    (is (null (warnings "FROM-FINGERS")))))

(test no-contact-of-what-is-shipped-is-warned-of
  (flet ((warned (knowledge) (supergrip:knowledge-warnings knowledge)))
    (is (null (warned (supergrip:load-knowledge))))
    (is (null (warned (supergrip:load-knowledge
                       :hand (project-file "examples/further-work/")))))
    (dolist (file (uiop:directory-files (project-file "examples/hands/")))
      (is (null (warned (supergrip:load-knowledge :gripper file))) "~a" file))
    (is (null (warned (supergrip:load-knowledge
                       :hand (project-file "examples/hands/robotiq-2f-85/")))))))
