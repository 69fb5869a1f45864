;;;; preliminary-assertions.lisp -- a preliminary assertion is one row, and everything follows from
;;;; it.

(in-package :supergrip-test)
(define-suite preliminary-assertions "A preliminary assertion is one row, and everything follows from it.")

(defun knowledge-with-rule (text)
  "Return the shipped knowledge with the rule TEXT before all others, and the list of the problems."
  (text-knowledge (format nil "~a~%~a" text (file-text "rules.lisp")) (file-text "grasps.lisp")))

(test an-input-is-one-row
  (let ((supergrip::*inputs* supergrip::*inputs*)
        (rule "(RULE TALL1 (IF (TALL (s1 s2)) (NOT HEAVY)) (THEN (REMEMBER UPRIGHT (s1))))"))
    (is (= 2 (length (nth-value 1 (knowledge-with-rule rule)))))
    (supergrip::define-input "TALL" (:pair distance) (length "WIDTH-HAND")
      (> distance length)
      (format nil "~d cm are more than WIDTH-HAND" (round distance)))
    (supergrip::define-input "HEAVY" (:box box) ()
      (> (supergrip:box-weight box) 1)
      (format nil "it weighs ~a" (supergrip:box-weight box)))
    (multiple-value-bind (knowledge problems) (knowledge-with-rule rule)
      (is (null problems))
      (let ((light (supergrip:plan (paper-box) :knowledge knowledge))
            (heavy (supergrip:plan '((size 12 2 2) (weight 2) (u 0.8) (v 0.2) (constrained z2 x1)
                                      (force-needed (1 0 0 0 0 0))
                                      (velocity-needed (0 1 0 0 0 0)))
                                    :knowledge knowledge)))
        (flet ((said (function &rest arguments)
                 (with-output-to-string (*standard-output*) (apply function arguments))))
          (is (search "UPRIGHT (X2)" (transcript light)))
          (is (not (search "UPRIGHT" (transcript heavy))))
          (is (search "(TALL (X2 X1)): input, 12 cm are more than WIDTH-HAND"
                      (said #'supergrip:how '(upright (x2)) light)))
          (is (search "(HEAVY): input, it weighs 2.0" (said #'supergrip:why-not 'tall1 heavy))))))))
