;;;; refine.lisp -- fingers moved to better places: legal, surely better, and how good it can get.

(in-package :supergrip-test)
(define-suite refine "Fingers moved to better places: legal, surely better, and how good it can get.")

(defun graspable-plans (count seed)
  "Return plans that have a grasp for COUNT boxes on a table that need forces."
  (let ((state (sb-ext:seed-random-state seed)))
    (loop for plan = (supergrip:plan (table-box state))
          when (and (supergrip:plan-best plan)
                    (some #'plusp (supergrip:box-force-needed (supergrip:plan-box plan))))
            collect plan into plans
          until (= (length plans) count)
          finally (return plans))))

;;; Tests

(test refined-fingers-are-legal-and-never-worse
  (dolist (plan (graspable-plans 12 1))
    (let* ((refinement (supergrip:refine plan :count 1 :regions 200))
           (box (supergrip:plan-box plan)))
      (is (null (refinement-faults refinement)) "~a: ~a" box (refinement-faults refinement))
      (is (<= (supergrip:refinement-quality-before refinement)
              (supergrip:refinement-quality refinement)
              (supergrip:refinement-quality-bound refinement)))
      (multiple-value-bind (upper lower)
          (exact-radius-of (contacts-case (supergrip:refinement-contacts refinement) box))
        (destructuring-bind (sure most) (supergrip:refinement-radius refinement)
          (is (<= sure upper)) (is (<= lower most))))
      (when (supergrip:refinement-moved-p refinement)
        (is (< (second (supergrip:refinement-radius-before refinement))
               (first (supergrip:refinement-radius refinement))))))))

(defun random-placement (refinement state)
  "Return random legal contacts of REFINEMENT, or NIL if none was found."
  (let* ((candidate (supergrip:refinement-candidate refinement))
         (box (supergrip:plan-box (supergrip:refinement-plan refinement)))
         (homes (supergrip:refinement-home refinement)))
    (loop repeat 2000
          for shift = (loop repeat 3 collect (- (random 4d0 state) 2))
          for contacts = (loop for home in homes
                               for axis = (face-normal-axis (getf home :surface))
                               collect (list* :position
                                              (loop for place in (getf home :position)
                                                    for k below 3
                                                    for s in shift
                                                    collect (if (= k axis)
                                                                place
                                                                (+ place s (- (random 1d0 state)
                                                                              0.5d0))))
                                              home))
          unless (placement-faults contacts homes (supergrip:candidate-grasp candidate)
                                  (supergrip:candidate-matching candidate) box)
            return contacts)))

(test no-legal-placement-is-above-the-bound
  (let ((state (sb-ext:seed-random-state 5)) (checked 0))
    (dolist (plan (graspable-plans 8 2))
      (let ((refinement (supergrip:refine plan :count 1 :regions 100)))
        (loop repeat 15
              for contacts = (random-placement refinement state)
              when contacts
                do (incf checked)
                   (is (<= (or (nth-value 1 (exact-radius-of
                                             (contacts-case contacts (supergrip:plan-box plan))))
                               0)
                           (* (+ 1d0 1d-9) (supergrip:refinement-radius-bound refinement)))))))
    (is (< 40 checked))))

(defun all-places-alike-plan ()
  "Return a plan whose task is a force along Z: by friction, 2u, wherever the fingers stand."
  (supergrip:plan (with-entries *good-box* :force-needed '((0 0 1 0 0 0)) :weight '(0))))

(defun refined-pencil ()
  "Return the refinement of the pencil's best grasp, in a list."
  (list (supergrip:refine (pencil-plan) :count 1 :regions 50)))

(test where-all-places-are-as-good-the-fingers-stay
  (let* ((plan (all-places-alike-plan))
         (refinement (supergrip:refine plan :count 1)))
    (is (not (supergrip:refinement-moved-p refinement)))
    (is (close-to 1.6d0 (supergrip:refinement-radius-bound refinement) 2d-3))))

(test without-a-grasp-or-a-force-nothing-is-refined
  (is (null (supergrip:refine (supergrip:plan (plan-box-too-heavy)))))
  (let ((refinement (supergrip:refine
                     (supergrip:plan (changed-box :force-needed '(0 0 0 0 0 0))))))
    (is (not (supergrip:refinement-moved-p refinement)))
    (is (null (supergrip:refinement-radius refinement)))
    (is (= (supergrip:refinement-quality refinement)
           (supergrip:refinement-quality-bound refinement)
           (supergrip:candidate-velocity-radius (supergrip:refinement-candidate refinement)))))
  (is (equal "count is 0, but must be how many grasps to refine, 1 or more"
             (error-text (supergrip:refine (pencil-plan) :count 0))))
  (is (equal "regions is MANY, but must be a number of regions, such as 1000"
             (error-text (supergrip:refine (pencil-plan) :regions 'many))))
  (is (equal "gap is -1, but must be a number from 0 to 1, such as 0.02"
             (error-text (supergrip:refine (pencil-plan) :gap -1)))))

(test a-sheet-that-is-hardly-held-is-refined-in-the-end
  "By rounding its contacts just fail to hold it in some motions."
  (let ((refinement (supergrip:refine
                     (supergrip:plan '((size 70d0 0.9d0 7d-6) (weight 3d-10) (u 0.6d0) (v 8d0)
                                       (constrained) (force-needed (1 1 1 1 1 0.2d0))
                                       (velocity-needed (1 1 1 1 1 1d-70))))
                     :count 1 :regions 20)))
    (is (<= (supergrip:refinement-quality-before refinement)
            (supergrip:refinement-quality refinement)
            (supergrip:refinement-quality-bound refinement)))))

(test many-fingers-are-refined-in-the-end
  (let* ((fingers (loop for k below 8
                        collect (format nil "(N~d ~,2f ~,2f)" (1+ (mod k 2)) (* 0.4 (floor k 4))
                                        (* 0.4 (mod (floor k 2) 2)))))
         (knowledge (text-knowledge *good-rules*
                                    (format nil "~a~%~a" *small-gripper*
                                            (grasp-text :contacts (format nil "(~{~a~})" fingers)))))
         (refinement (supergrip:refine (supergrip:plan *good-box* :knowledge knowledge)
                                       :count 1 :regions 20)))
    (is (= 8 (length (supergrip:refinement-contacts refinement))))
    (is (<= (supergrip:refinement-quality-before refinement)
            (supergrip:refinement-quality refinement)
            (supergrip:refinement-quality-bound refinement)))))

;;; What is told

(test the-record-tells-what-refining-gives
  (let* ((plan (supergrip:plan *good-box*))
         (record (supergrip::plan-record plan :all 1 :refine t))
         (refined (getf record :refined)))
    (is (equal '(:alternatives :refined)
               (loop for (key) on (last record 4) by #'cddr collect key)))
    (is (equal record (json-record (json-line record))))
    (is (equal record (lisp-record (lisp-line record))))
    (is (equal '(:grasp :matching :quality :quality-before :quality-bound :beta :contacts :hand)
               (loop for (key) on refined by #'cddr collect key)))
    (is (<= (getf refined :quality-before) (getf refined :quality)
            (getf refined :quality-bound)))
    (is (equal (mapcar (lambda (contact) (getf contact :finger)) (getf record :contacts))
               (mapcar (lambda (contact) (getf contact :finger)) (getf refined :contacts)))))
  (is (equal '(:refined nil)
             (last (supergrip::plan-record (supergrip:plan (plan-box-too-heavy)) :refine t) 2)))
  (is (equal '(:refined nil)
             (last (supergrip::error-record (list (supergrip-data:make-problem :text "bad"))
                                            :refine t)
                   2))))

(test the-refined-hand-of-a-box-with-a-pose-is-told-in-the-world
  (let* ((pose '((10 20 30) (0 0 0.6d0 0.8d0)))
         (plan (supergrip:plan (append *good-box* `((:pose ,@pose)))))
         (refined (getf (supergrip::plan-record plan :refine t) :refined)))
    (is (equalp (supergrip::hand-in-world (getf refined :hand)
                                          (supergrip::%box-pose (supergrip:plan-box plan)))
                (getf refined :world)))
    (is (not (equalp (getf refined :hand) (getf refined :world))))))

(test what-refining-gained-is-told-in-words
  (let ((refinement (first (refined-pencil))))
    (destructuring-bind (first . others) (printed (supergrip:explain-refinement refinement))
      (is (eql 0 (search "PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): with its fingers moved, the exact Q is "
                         first)))
      (is (eql 0 (search "  F1 on Y2: from (-0.87 -1 0) to (" (first others))))
      (is (search ", proved; it was 0.880 to 0.88" (fourth others)))
      (is (eql 0 (search "No legal places of these fingers give a Q above " (fifth others))))))
  (is (equal '("PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): no better places were found, so the fingers stay; the exact Q is 1.112."
               "The exact radius of forces is 1.598 to 1.600, proved."
               "No legal places of these fingers give a Q above 1.114: 0.2 % more at most.")
             (printed (supergrip:explain-refinement (supergrip:refine (all-places-alike-plan))))))
  (is (equal "PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): with its fingers moved, the exact Q stays 0.625."
             (first (printed (supergrip:explain-refinement
                              (supergrip:plan (paper-box) :gamma 1) :count 1 :regions 20))))
      "velocities alone count")
  (is (equal '("is 0.760, not 0.750: 1.3 % more" "is 0.75021, not 0.75018: 0.0 % more" "stays 0.750")
             (loop for (from to) in '((0.75d0 0.76d0) (0.75018d0 0.75021d0) (0.75d0 0.75d0))
                   collect (supergrip::quality-change-text from to))))
  (is (search "the task needs no force" (first (printed (supergrip:explain-refinement
                                                         (supergrip:plan (changed-box :force-needed '(0 0 0 0 0 0))))))))
  (is (eql 0 (search "There is no grasp to refine: "
                     (first (printed (supergrip:explain-refinement
                                      (supergrip:plan (plan-box-too-heavy)))))))))

(test without-a-plan-the-last-one-is-refined
  (let ((supergrip::*plan* (pencil-plan)))
    (is (eq supergrip::*plan* (supergrip:refinement-plan (supergrip:refine))))
    (is (equal (printed (supergrip:explain-refinement supergrip::*plan*))
               (printed (supergrip:explain-refinement)))))
  (let ((supergrip::*plan* (pencil-plan)))
    (is (equal (princ-to-string (supergrip:refine supergrip::*plan* :count 1 :regions 20))
               (princ-to-string (supergrip:refine :count 1 :regions 20))))
    (is (equal (printed (supergrip:explain-refinement supergrip::*plan* :count 1 :regions 20))
               (printed (supergrip:explain-refinement :count 1 :regions 20))))
    (loop for (keys text) in
          '(((:grasps 1) "GRASPS is not a key of REFINE: keys are :COUNT, :GAP, :REGIONS")
            ((1 2) "2 is not a key of REFINE: keys are :COUNT, :GAP, :REGIONS; a value goes after its key, as in (refine plan :count 1)")
            ((:count) "there is no value after the key :COUNT of REFINE"))
          do (is (equal text (error-text (apply #'supergrip:refine keys))))))
  (let ((supergrip::*plan* nil))
    (is (equal "there is no plan yet: call (forward-chain) first"
               (error-text (supergrip:refine))))))

(test the-best-of-the-plan-is-told-of-if-another-is-best-refined
  (let* ((plan (loop for plan in (graspable-plans 40 3)
                     unless (eq (supergrip:plan-best plan)
                                (supergrip:refinement-candidate
                                 (supergrip:refine plan :count 2 :regions 0)))
                       return plan))
         (best (supergrip:plan-best plan))
         (own (supergrip:refine plan :count 1 :regions 0)))
    (is (equal (format nil "The plan's best grasp is ~a (~{~a~^ ~}).  Its exact Q is ~,3f~a."
                       (supergrip:candidate-grasp best) (supergrip:candidate-matching best)
                       (supergrip:refinement-quality-before own)
                       (if (supergrip:refinement-moved-p own)
                           (format nil ", and ~,3f with its fingers moved"
                                   (supergrip:refinement-quality own))
                           "; its fingers stay"))
               (first (last (printed (supergrip:explain-refinement plan :count 2
                                                                        :regions 0))))))
    (is (null (search "The plan's best grasp"
                      (format nil "~{~a~}" (printed (supergrip:explain-refinement
                                                     plan :count 1 :regions 0))))))))

(test of-equals-the-grasp-that-the-plan-put-first-is-the-best
  (flet ((refinement (radius)
           (supergrip::make-refinement :candidate (supergrip:plan-best (pencil-plan))
                                       :plan (pencil-plan) :radius (list radius radius))))
    (let ((all (mapcar #'refinement '(1d0 1.0001d0 2d0 0.5d0))))
      (is (equal (mapcar (lambda (k) (nth k all)) '(2 1 0 3)) (supergrip::best-first all)))
      (is (equal (mapcar (lambda (k) (nth k all)) '(0 1 3))
                 (supergrip::best-first (remove (third all) all)))))
    (is (null (supergrip::best-first '())))))

(test fingers-on-one-face-do-not-cross
  (flet ((contact (surface &rest place) (list :surface surface :position place)))
    (let ((contacts (list (contact "Y2" 2 -1 0) (contact "Y2" 0 -1 0) (contact "Y2" -2 -1 0)
                          (contact "Y1" 0 1 0))))
      (is (equalp #((3 -1 1) (1 -1 0) (-3 -1 0) (0 1 1))
                  (supergrip::untangle (vector '(-3 -1 0) '(3 -1 1) '(1 -1 0) '(0 1 1)) contacts)))
      (is (equalp #((2 -1 0) (0 -1 0) (-2 -1 0) (0 1 0))
                  (supergrip::untangle (map 'vector (lambda (contact) (getf contact :position))
                                            contacts)
                                       contacts))
          "who does not move"))))

(test the-hand-of-a-refined-grasp-moves-with-its-fingers
  (let* ((plan (pencil-plan))
         (refined (getf (supergrip::plan-record plan :refine t) :refined))
         (refinement (supergrip:refine plan))
         (candidate (supergrip:refinement-candidate refinement))
         (shift (supergrip::refinement-shift refinement)))
    (is (some #'plusp (mapcar #'abs shift)))
    (is (every #'close-to
               (getf (getf refined :hand) :position)
               (mapcar #'+ (supergrip:candidate-offset candidate) shift)))))
