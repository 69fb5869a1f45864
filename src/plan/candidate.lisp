;;;; candidate.lisp -- what a candidate is, for those who read a plan.

(in-package :supergrip)

(defun candidate-grasp (candidate)
  "Return the name of the grasp of CANDIDATE, a string."
  (grasp-name (%candidate-grasp candidate)))

(defun candidate-matching (candidate)
  "Return the names of the box faces that N1 N2 O1 O2 A1 A2 of CANDIDATE take."
  (matching-names (%candidate-matching candidate)))

(defun candidate-outcome (candidate)
  "Return :POSSIBLE, or the step that CANDIDATE failed: :CONDITIONS, :OFFSET, :FINGERS, :OPEN or
:LIFTING."
  (%candidate-outcome candidate))

(defun candidate-quality (candidate)
  "Return the quality index of CANDIDATE, a double, or NIL if it is not possible."
  (and (possible-p candidate) (%candidate-quality candidate)))

(defun axis-or-nil (candidate limit)
  (and (possible-p candidate) (>= limit 0) (axis-name limit)))

(defun candidate-force-axis (candidate)
  "Return the axis that limits u_w of CANDIDATE, as \"about Y\", or NIL if no force is needed.  In a
plan by the exact index it is that of the greatest component of the worst motion."
  (axis-or-nil candidate (%candidate-force-limit candidate)))

(defun candidate-velocity-axis (candidate)
  "Return the axis that limits u_t of CANDIDATE, as \"along Z\", or NIL if no velocity is needed."
  (axis-or-nil candidate (%candidate-velocity-limit candidate)))

(defun candidate-force-radius (candidate)
  "Return u_w of CANDIDATE, or NIL if the task needs no force or it is not possible.  In a plan by
the exact index it is the certified radius; or the sure one if there is no certificate; or, if
CANDIDATE-BOUND-P, an upper bound."
  (and (candidate-force-axis candidate) (%candidate-force-radius candidate)))

(defun candidate-velocity-radius (candidate)
  "Return u_t of CANDIDATE, or NIL if the task needs no velocity or it is not possible."
  (and (candidate-velocity-axis candidate) (%candidate-velocity-radius candidate)))

(declaim (inline without-sign-of-zero))
(defun without-sign-of-zero (number)
  (+ number 0d0))

(defun candidate-offset (candidate)
  "Return the grasp centre of CANDIDATE from the box centre: three numbers along X Y Z, in cm."
  (mapcar #'without-sign-of-zero
          (list (%candidate-x candidate) (%candidate-y candidate) (%candidate-z candidate))))

(defun unit-vector (face sign)
  "Return the outward normal of the box face FACE, times SIGN, as a list along X Y Z."
  (loop for axis below 3
        collect (if (= axis (face-axis face))
                    (coerce (* sign (face-sign face)) 'double-float)
                    0d0)))

(defun candidate-approach (candidate)
  "Return the direction of approach of CANDIDATE: a unit vector in the box frame, from the palm to
the box."
  (unit-vector (svref (matching-faces (%candidate-matching candidate))
                      (grasp-palm (%candidate-grasp candidate)))
               -1))

(defun replay (candidate workspace)
  "Take CANDIDATE through the steps again, in WORKSPACE, at its box; return WORKSPACE, which holds
its figures."
  (run-steps workspace (make-candidate (%candidate-grasp candidate)
                                     (%candidate-matching candidate)))
  workspace)

(defmacro with-workspace ((workspace plan) &body body)
  "Run BODY with WORKSPACE, one at the box of PLAN, which is given back after it.  Numbers are put
into words in the units of the box."
  (let ((memory (gensym)) (the-plan (gensym)))
    `(without-float-traps
       (let* ((,the-plan (need-plan ,plan))
              (,memory (spare-memory (plan-knowledge ,the-plan))) ; nothing is asked of the rules
              (,workspace (start-workspace (memory-client ,memory) (plan-box ,the-plan)
                                           (plan-gamma ,the-plan)
                                           (index-named (plan-index ,the-plan))))
              (*units* (%box-units (plan-box ,the-plan))))
         (multiple-value-prog1 (progn ,@body)
           (give-back ,memory (plan-knowledge ,the-plan)))))))

(defmacro with-replay ((workspace candidate plan) &body body)
  "Run BODY with WORKSPACE, which holds the figures of CANDIDATE of PLAN and is given back after
it."
  `(with-workspace (,workspace ,plan)
     (replay ,candidate ,workspace)
     ,@body))

(defparameter +finger-names+
  (coerce (loop for number from 1 to +most-contacts+ collect (format nil "F~d" number))
          'simple-vector)
  "The names of the fingers, in the order of a grasp's CONTACTS: F1, not to be taken for a face as
N1.")

(defun candidate-contacts (candidate &optional (plan *plan*))
  "Return the contacts of CANDIDATE, which is possible in PLAN: a list of plists with :SURFACE, the
name of a box face; :POSITION and :NORMAL, lists along X Y Z in the box frame at the box centre,
positions in cm, the normals pointing inward; and :FINGER, the finger's name in the pictures, as
\"F1\"."
  (with-replay (workspace candidate plan)
    (contacts-of candidate workspace)))

(defun contacts-of (candidate workspace)
  "Return what CANDIDATE-CONTACTS does; WORKSPACE holds the figures of CANDIDATE.  Where the fingers
are is computed anew: the registers hold it only until another program is run."
  (execute (grasp-positions (%candidate-grasp candidate)) (workspace-registers workspace))
  (loop with registers of-type registers = (workspace-registers workspace)
        with matching = (%candidate-matching candidate)
        for (grasp-face p q) in (grasp-contacts (%candidate-grasp candidate))
        for finger across +finger-names+
        for face = (svref (matching-faces matching) grasp-face)
        collect (list :surface (face-name face)
                      :position (contact-position workspace matching grasp-face
                                                  (aref registers p) (aref registers q))
                      :normal (unit-vector face -1)
                      :finger finger)))

(defun contact-position (workspace matching grasp-face p q)
  "Return the place, along X Y Z, of a finger on GRASP-FACE at P, Q along its two other axes."
  (declare (type workspace workspace) (type matching matching) (type face grasp-face))
  (let ((position (make-list 3))
        (rest (list p q)))
    (dotimes (i 3 position)
      (setf (nth (aref (matching-axes matching) i) position)
            (without-sign-of-zero
             (* (aref (matching-signs matching) i)
                (if (= i (floor grasp-face 2))
                    (* (if (evenp grasp-face) 0.5d0 -0.5d0) (aref (workspace-lengths workspace) i))
                    (+ (aref (workspace-centre workspace) i)
                       (the double-float (pop rest))))))))))

(defun replayed-six (capacities candidate plan)
  "Return what CAPACITIES, a function of a workspace, gives for CANDIDATE of PLAN, a list; NIL where
it failed before they were known."
  (and (member (candidate-outcome candidate) '(:possible :lifting))
       (with-replay (workspace candidate plan)
         (coerce (funcall capacities workspace) 'list))))

(defun candidate-wrench (candidate &optional (plan *plan*))
  "Return what CANDIDATE of PLAN exerts along X Y Z and about X Y Z, gravity's load not taken off:
six numbers, forces in finger forces, torques in finger force x cm.  NIL if CANDIDATE failed at an
earlier step."
  (replayed-six #'workspace-wrench candidate plan))

(defun candidate-twist (candidate &optional (plan *plan*))
  "Return the mobility of CANDIDATE of PLAN along X Y Z and about X Y Z, six numbers.  NIL if
CANDIDATE failed at an earlier step."
  (replayed-six #'workspace-twist candidate plan))

(defun candidate-sure (candidate &optional (plan *plan*))
  "Return the sure radius of CANDIDATE of PLAN, a double, 0 or more.  Its contacts surely bear this
multiple of the forces and torques that the task needs, all together and in any direction, beside
the weight.  NIL if CANDIDATE is not possible, or the task needs no force.  u_w looks at one axis at
a time, and promises no such thing.  Source: SURE-RADIUS."
  (and (possible-p candidate)
       (with-replay (workspace candidate plan)
         (sure-of candidate workspace))))

(defun sure-of (candidate workspace)
  "Return the sure radius of CANDIDATE, whose figures WORKSPACE holds; NIL if the task needs no
force."
  (let ((box (workspace-box workspace)))
    (sure (workspace-wrench workspace) (%box-force box) (gravity-on box)
          (%candidate-x candidate) (%candidate-y candidate) (%candidate-z candidate))))

(defun candidate-palm (candidate)
  "Return the name of the box face that the palm of CANDIDATE is over."
  (face-name (svref (matching-faces (%candidate-matching candidate))
                       (grasp-palm (%candidate-grasp candidate)))))

(defun six-at-centre (function given candidate)
  "Return the list of six that FUNCTION, of what is GIVEN at the box centre, an offset and a result,
makes of it at the grasp centre of CANDIDATE."
  (let ((offset (map 'three #'abs (candidate-offset candidate)))
        (result (make-six)))
    (funcall function given offset result)
    (coerce result 'list)))

(defun candidate-force-need (candidate plan)
  "Return the forces and torques that the task of PLAN needs at the grasp centre of CANDIDATE: six
numbers along X Y Z and about X Y Z."
  (six-at-centre #'shift-force (%box-force (plan-box plan)) candidate))

(defun candidate-velocity-need (candidate plan)
  "Return the velocities and rotations that the task of PLAN needs at the grasp centre of CANDIDATE:
six numbers along X Y Z and about X Y Z."
  (six-at-centre #'shift-velocity (%box-velocity (plan-box plan)) candidate))

(defun candidate-load (candidate plan)
  "Return the load of gravity at the grasp centre of CANDIDATE: six numbers along X Y Z and about
X Y Z."
  (let ((load (make-six)))
    (put-load (plan-box plan) (%candidate-x candidate) (%candidate-y candidate)
              (%candidate-z candidate) load)
    (coerce load 'list)))

(defun candidate-spare (candidate &optional (plan *plan*))
  "Return what CANDIDATE of PLAN can exert for the task along X Y Z and about X Y Z, while it bears
the load of gravity: six numbers, each for the weaker of the two directions.  NIL if CANDIDATE
failed at an earlier step."
  (replayed-six (lambda (workspace)
                  (put-load (workspace-box workspace) (%candidate-x candidate)
                            (%candidate-y candidate) (%candidate-z candidate)
                            (workspace-load workspace))
                  (bearing-sides candidate workspace)
                  (put-spare workspace))
                candidate plan))

;;; The best one of a plan

(defun plan-grasp (&optional (plan (last-plan)))
  "Return the name of the best grasp of PLAN, a string, or NIL."
  (and (plan-best (need-plan plan)) (candidate-grasp (plan-best plan))))

(defun plan-matching (&optional (plan (last-plan)))
  "Return the matching of the best grasp of PLAN: the names of the faces that N1 N2 O1 O2 A1 A2
take; or NIL."
  (and (plan-best (need-plan plan)) (candidate-matching (plan-best plan))))

(defun plan-quality (&optional (plan (last-plan)))
  "Return the quality index of the best grasp of PLAN, a double, or NIL."
  (and (plan-best (need-plan plan)) (candidate-quality (plan-best plan))))

