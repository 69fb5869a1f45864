;;;; refined-fingers.lisp -- what moving the fingers of a grasp has gained, in words.

(in-package :supergrip)

(defun finger-place-text (place)
  "Return PLACE, three numbers in cm, to 0.1 mm: as (-0.87 -1 0), or with its unit if *UNITS* are
others."
  (let ((text (plain-text "(~{~a~^ ~})"
                          (loop for number in place
                                collect (number-text (in-units (/ (round (* 100 number)) 100d0)
                                                               :length))))))
    (if *units* (with-unit text :length) text)))

(defun write-moves (refinement stream)
  "Write where each finger of REFINEMENT was, and where it is now."
  (loop for home in (refinement-home refinement)
        for contact in (refinement-contacts refinement)
        do (format stream "  ~a on ~a: from ~a to ~a~%"
                   (getf contact :finger) (getf contact :surface)
                   (finger-place-text (getf home :position))
                   (finger-place-text (getf contact :position)))))

(defun gain-text (from to)
  "Return by how much TO, a quality, is above FROM, in percent: \"12.3 %\"."
  (if (plusp from)
      (plain-text "~,1f %" (* 100 (/ (- to from) from)))
      "any part"))

(defun quality-change-text (from to)
  "Return in words that a quality is TO, and was FROM."
  (if (= from to)
      (plain-text "stays ~,3f" to) ; where velocities alone count
      (let ((texts (list (three-decimals to) (three-decimals from))))
        (plain-text "is ~{~a, not ~a~}: ~a more"
                    (if (equal (first texts) (second texts)) (number-texts to from) texts)
                    (gain-text from to)))))

(defun write-radius (words radius stream)
  (destructuring-bind (lower upper) radius
    (format stream "~a ~a~@[, proved~*~]" words
            (if lower
                (plain-text "~,3f to ~,3f" lower upper)
                (plain-text "at most ~,3f, nothing proved" upper))
            lower)))

(defmethod write-answer :around ((answer refinement) stream)
  (declare (ignore stream))
  (let ((*units* (%box-units (plan-box (refinement-plan answer)))))
    (call-next-method)))

(defmethod write-answer ((answer refinement) stream)
  (let ((before (refinement-quality-before answer)) (after (refinement-quality answer))
        (candidate (refinement-candidate answer)))
    (format stream "~a (~{~a~^ ~}): " (candidate-grasp candidate) (candidate-matching candidate))
    (cond ((null (refinement-radius answer))
           (format stream "the task needs no force, or it is too large to compute with, so the ~
                           fingers stay.~%"))
          ((refinement-moved-p answer)
           (format stream "with its fingers moved, the exact Q ~a.~%"
                   (quality-change-text before after))
           (write-moves answer stream))
          (t (format stream "no better places were found, so the fingers stay; the exact Q is ~
                             ~,3f.~%" after)))
    (when (refinement-radius answer)
      (write-radius "The exact radius of forces is" (refinement-radius answer) stream)
      (when (refinement-moved-p answer)
        (write-radius "; it was" (refinement-radius-before answer) stream))
      (format stream ".~%No legal places of these fingers give a Q above ~,3f: ~a more at most.~%"
              (refinement-quality-bound answer)
              (gain-text after (refinement-quality-bound answer))))))

(defun write-plans-best (refinement refinements stream)
  "Write what REFINEMENTS, all that were made, say of the plan's best grasp, if REFINEMENT is not of
it."
  (let ((best (find (plan-best (refinement-plan refinement)) refinements
                    :key #'refinement-candidate)))
    (unless (or (null best) (eq best refinement))
      (format stream "The plan's best grasp is ~a (~{~a~^ ~}).  Its exact Q is ~:[~,3f~*; its ~
                      fingers stay~;~,3f, and ~,3f with its fingers moved~].~%"
              (candidate-grasp (refinement-candidate best))
              (candidate-matching (refinement-candidate best))
              (refinement-moved-p best)
              (refinement-quality-before best) (refinement-quality best)))))

(defun explain-refinement (&rest arguments)
  "Refine a plan as REFINE does, with the same ARGUMENTS; print in words what this gained for the
best refined grasp, and return its REFINEMENT.  If the plan's best was another grasp, also print
what it gained.  In place of the plan may stand a refinement that REFINE has returned."
  (multiple-value-bind (plan keys) (plan-and-keys arguments 'explain-refinement)
    (if (refinement-p plan)
        (print-answer plan)
        (let* ((refinements (apply #'refine-grasps plan keys)) (best (first refinements)))
          (if best
              (progn (print-answer best)
                     (write-plans-best best refinements *standard-output*))
              (format t "There is no grasp to refine: ~a~%" (plan-reason plan)))
          best))))
