;;;; choice.lisp -- why the best grasp is the best, and what would change the choice.

(in-package :supergrip)

(defstruct limit
  "What limits a radius: the AXIS in words, what the grasp HAS there, what the task NEEDS there with
the effect of the offset, in the units of the box, and the RADIUS.  MEASURE says what HAS and NEEDS
measure: :FORCE, :TORQUE or NIL."
  axis has needs radius measure)

(defstruct (choice (:include explanation))
  "Why the best grasp of PLAN is the best.  SENTENCE says how it holds the box; FORCE and VELOCITY
are LIMITs or NIL; SURE is CANDIDATE-SURE of the best; TRUTH is the EXACT-LIMIT of its forces,
whatever the index is, or NIL; DEMAND is a DEMAND, of absolute needs, or NIL; RUNNER-UP is the next
candidate or NIL, MARGIN its distance in Q; EQUALS counts the candidates, RUNNER-UP included, that
have the same Q as the best; CHANGES is a list of CHANGEs, the smallest first; STEPPED are the names
of values that were only looked at in steps."
  plan sentence force velocity sure truth demand runner-up margin (equals 0) (changes '())
  (stepped '()))

;;; How it holds the box

(defun approach-text (face box)
  "Return where a palm over FACE of BOX comes from: \"above\" up to 30 degrees from there, a side up
to 30 degrees from level."
  (let ((up (- (* (face-sign face) (aref (%box-down box) (face-axis face))))))
    (cond ((<= (abs up) 0.5d0) (format nil "the side ~a" (face-name face)))
          (t (format nil "~:[obliquely ~;~]~:[below~;above~]" (> (abs up) (sqrt 0.75d0))
                     (plusp up))))))

(defun fingers-on (grasp face-name)
  "Return what stands on each face that GRASP touches, and the face as FACE-NAME, a function of its
grasp-face, calls it: \"two fingers\" \"N1\" \"a finger\" \"N2\"."
  (loop with grasp-faces = (mapcar #'first (grasp-contacts grasp))
        for grasp-face in (remove-duplicates grasp-faces :from-end t)
        for count = (count grasp-face grasp-faces)
        collect (if (= count 1) "a finger" (format nil "~r fingers" count))
        collect (funcall face-name grasp-face)))

(defun grasp-sentence (candidate box)
  "Return how CANDIDATE holds BOX, in a sentence that a person would say."
  (let* ((grasp (%candidate-grasp candidate))
         (faces (matching-faces (%candidate-matching candidate)))
         (palm (svref faces (grasp-palm grasp))))
    (format nil "~a: ~{~a on ~a~^, ~}; the palm over ~a, coming from ~a"
            (grasp-name grasp)
            (fingers-on grasp (lambda (grasp-face) (face-name (svref faces grasp-face))))
            (face-name palm) (approach-text palm box))))

(defun limit-at (axis has needs radius &optional measure)
  "Return the LIMIT of RADIUS on AXIS, 0 to 5, where the grasp HAS, and the task NEEDS, six
numbers of MEASURE."
  (let ((measure (part-measure measure axis)))
    (make-limit :axis (axis-name axis) :has (in-units (aref has axis) measure)
                :needs (in-units (aref needs axis) measure) :radius radius :measure measure)))

(defstruct (exact-limit (:include limit))
  "What limits an exact radius: AXIS is that of the greatest component of MOTION, the worst, in
which the task NEEDS the power 1 times the radius; HAS is a list of what pressing, friction, the
fingertips' torque and the weight give there, together UPPER; RADIUS is what the grasp counts with,
and CERTIFIED the proved one, or NIL.  DIRECTION is MOTION in words."
  motion direction upper certified)

(defun exact-force-limit (candidate plan)
  "Return the EXACT-LIMIT of the forces of CANDIDATE, or NIL if none is needed or it can't be
computed."
  (multiple-value-bind (upper certified motion) (candidate-exact-radius candidate plan)
    (and upper
         (make-exact-limit :axis (candidate-force-axis candidate) :needs 1d0
                           :has (candidate-powers candidate motion plan)
                           :radius (candidate-force-radius candidate)
                           :motion motion :upper upper
                           :direction (direction-text motion (box-force-needed (plan-box plan)))
                           :certified certified))))

(defgeneric force-limit-by (index truth candidate plan)
  (:documentation "Return the LIMIT of u_w of CANDIDATE of PLAN, which is by INDEX; TRUTH is its
EXACT-LIMIT.")
  (:method ((index (eql :exact)) truth candidate plan)
    (declare (ignore candidate plan))
    truth)
  (:method ((index (eql :paper)) truth candidate plan)
    (declare (ignore truth))
    (with-replay (workspace candidate plan)
      (limit-at (%candidate-force-limit candidate) (workspace-spare workspace)
                (workspace-force-needs workspace) (candidate-force-radius candidate) :wrench))))

(defun force-limit (truth candidate plan)
  "Return the LIMIT of u_w of CANDIDATE, whose EXACT-LIMIT is TRUTH, or NIL if no force is needed."
  (and (candidate-force-axis candidate)
       (force-limit-by (plan-index plan) truth candidate plan)))

(defun velocity-limit (candidate plan)
  "Return the LIMIT of u_t of CANDIDATE, or NIL if no velocity is needed."
  (when (candidate-velocity-axis candidate)
    (with-replay (workspace candidate plan)
      (limit-at (%candidate-velocity-limit candidate) (workspace-twist workspace)
                (workspace-velocity-needs workspace) (candidate-velocity-radius candidate)))))

;;; What would change the choice

(defun same-choice-p (a b)
  "True if the plans A and B chose the same grasp in the same matching, or both none."
  (and (equal (plan-grasp a) (plan-grasp b))
       (equal (plan-matching a) (plan-matching b))))

(defun other-choice (plan)
  "Return the goal that another grasp, another matching or none is chosen than in PLAN."
  (let ((best (plan-best plan)))
    (make-goal :test (lambda (other) (not (same-choice-p plan other)))
               :winner (lambda (prospect)
                         (not (if (and prospect best)
                                  (and (eq (prospect-grasp prospect) (%candidate-grasp best))
                                       (eq (prospect-matching prospect) (%candidate-matching best)))
                                  (eq prospect best)))))))

(defun task-keys ()
  "Return the keys whose values belong to the task and the material, not to the shape of the box."
  (remove-if (lambda (row) (or (null (box-key-words row)) (consp (box-key-type row)))) *box-keys*))

(defun choice-changes-of (plan)
  "Return what FIND-CHANGES does of the choice of PLAN; nothing if it is not by the paper's index."
  (and (eq (plan-index plan) :paper)
       (find-changes plan (other-choice plan) (task-keys))))

;;; The answer

(defun equals-p (other best)
  "True if the candidate OTHER is surely as good as BEST."
  (and (not (candidate-bound-p other))
       (<= (- (candidate-quality best) (candidate-quality other)) +tie+)))

(defun explain-choice (&optional (plan (last-plan)))
  "Return the CHOICE on PLAN: why its best grasp is the best, and what would change the choice."
  (when (unfinished-p (need-plan plan))
    (refuse-argument "the run is not over, so there is no best grasp yet"))
  (let* ((best (plan-best plan))
         (truth (and best (exact-force-limit best plan)))
         (others (rest (best-grasps plan)))
         (runner-up (first others)))
    (multiple-value-bind (changes stepped) (choice-changes-of plan)
      (make-choice :plan plan
                   :sentence (if best
                                 (grasp-sentence best (plan-box plan))
                                 (format nil "The box can't be grasped: ~a~@[.~%~a~]"
                                         (plan-reason plan) (remedy-sentence plan)))
                   :force (and best (force-limit truth best plan))
                   :truth truth
                   :velocity (and best (velocity-limit best plan))
                   :sure (and best (candidate-sure best plan))
                   :demand (and best (demand-on best plan))
                   :runner-up runner-up
                   :margin (and runner-up
                                (- (candidate-quality best) (candidate-quality runner-up)))
                   :equals (count-if (lambda (other) (equals-p other best)) others)
                   :changes (stable-sort changes #'< :key #'change-distance)
                   :stepped stepped))))

(defun explain-best (&optional (plan (last-plan)))
  "Print and return why the best grasp of PLAN is the best: how it holds the box, what limits it,
the runner-up, and which single need, friction or weight would have to change, and to what, for the
choice to change."
  (print-answer (explain-choice plan)))

(defmethod write-answer :around ((answer choice) stream)
  (declare (ignore stream))
  (let ((*units* (%box-units (plan-box (choice-plan answer)))))
    (call-next-method)))

(defmethod write-answer ((answer choice) stream)
  (format stream "~a.~%" (choice-sentence answer))
  (write-force-limit (choice-force answer) stream)
  (write-limit "Velocity" "moves with" nil (choice-velocity answer) stream)
  (cond ((choice-demand answer) (format stream "~a~%" (demand-text (choice-demand answer))))
        (t (write-sure (choice-sure answer) (choice-truth answer) stream)
           (unless (eq (choice-truth answer) (choice-force answer))
             (write-truth (choice-truth answer) stream))))
  (write-meaning answer stream)
  (write-runner-up answer stream)
  (cond ((choice-changes answer) (write-changes (choice-changes answer) stream))
        ((eq (plan-index (choice-plan answer)) :paper)
         (format stream "No single need, friction or weight would change the choice.~%"))
        (t (format stream "What would change the choice is searched for by the paper's index ~
                           only.~%")))
  (write-stepped (choice-stepped answer) (choice-plan answer) stream))

(defun write-runner-up (answer stream)
  "Write which candidate is next to the best one of ANSWER, and how near it is."
  (let ((next (choice-runner-up answer)) (margin (choice-margin answer))
        (equals (choice-equals answer)))
    (when next
      (format stream "Next is ~a (~{~a~^ ~}), with " (candidate-grasp next)
              (candidate-matching next))
      (cond ((> margin +tie+)
             (format stream "a Q lower by ~@[at least ~*~]~a.~%" (candidate-bound-p next)
                     (number-text margin)))
            ((candidate-bound-p next)
             (format stream "no more than the same Q, and tried later.~%"))
            (t (format stream "the same Q, but tried later~[~;, as was another~:;, as were ~:*~r ~
                               others~]: of equals the first tried is kept.~%"
                       (1- equals)))))))

(defgeneric write-force-limit (limit stream)
  (:documentation "Write what limits u_w, LIMIT, or nothing for NIL.")
  (:method (limit stream)
    (write-limit "Force" "exerts" "beyond the weight's load" limit stream))
  (:method ((limit exact-limit) stream)
    (format stream "Force is limited where the box is ~a: radius ~a~:[, not proved~;, proved~], ~
                    and at most ~a.~%"
            (exact-limit-direction limit)
            (three-decimals (limit-radius limit)) (exact-limit-certified limit)
            (three-decimals (exact-limit-upper limit)))
    (format stream "  There pressing gives ~a, friction ~a, the fingertips' torque ~a, the weight ~
                    ~a; the task needs 1.~%"
            (three-decimals (first (limit-has limit))) (three-decimals (second (limit-has limit)))
            (three-decimals (third (limit-has limit)))
            (three-decimals (fourth (limit-has limit))))))

(defun write-limit (kind verb beyond limit stream)
  (when limit
    (destructuring-bind (has needs radius one)
        (number-texts (limit-has limit) (limit-needs limit) (limit-radius limit) 1)
      (declare (ignore one))
      (format stream "~a is limited ~a: the grasp ~a ~a~@[ ~a~], the task needs ~a; radius ~a.~%"
              kind
              (limit-axis limit) verb (with-unit has (limit-measure limit)) beyond
              (with-unit needs (limit-measure limit)) radius))))

(defun write-sure (sure truth stream)
  "Write what SURE, a sure radius, is, if it is one; TRUTH is the EXACT-LIMIT, or NIL."
  (cond ((null sure))
        ((and truth (> sure (* (+ 1 +tie+) (exact-limit-upper truth))))
         (format stream "WRENCH promises ~a times the forces and torques asked for, which is ~
                         more than the contacts can exert.~%" (number-text sure)))
        (t (format stream "What is sure: together, and in any direction, the contacts bear ~a ~
                           times the forces and torques asked for.~%" (number-text sure)))))

(defun write-truth (truth stream)
  "Write what TRUTH, an EXACT-LIMIT, says of the contacts, if there is one."
  (cond ((null truth))
        ((minusp (exact-limit-upper truth))
         (format stream "Exactly, the contacts can't hold the weight.~%"))
        (t (destructuring-bind (lower upper one)
               (number-texts (or (exact-limit-certified truth) 0) (exact-limit-upper truth) 1)
             (declare (ignore one))
             (format stream "Exactly, they bear ~:[at most ~*~;from ~a to ~]~a times as much; ~
                             least where the box is ~a.~%"
                     (exact-limit-certified truth) lower upper (exact-limit-direction truth))))))

(defun below-one-p (number) (< number (- 1 +tie+)))

(defun write-meaning (answer stream)
  "Write what a radius below 1, and Q, mean."
  (let ((truth (choice-truth answer)) (velocity (choice-velocity answer))
        (meaning "which is enough if the needs only say what matters more"))
    (when (and truth (null (choice-demand answer))
               (<= 0 (exact-limit-upper truth)) (below-one-p (exact-limit-upper truth)))
      (format stream "The contacts bear at most ~a of the force asked for, ~a.~%"
              (first (number-texts (exact-limit-upper truth) 1)) meaning))
    (when (and velocity (below-one-p (limit-radius velocity)))
      (format stream "The grasp moves with only ~a of the velocity asked for ~a, ~a.~%"
              (first (number-texts (limit-radius velocity) 1)) (limit-axis velocity) meaning)))
  (let ((best (plan-best (choice-plan answer))))
    (when best
      (format stream "Q, ~a, only compares grasps for one task; it is not a probability of ~
                      success.~%"
              (three-decimals (candidate-quality best))))))

(defun write-changes (changes stream)
  (format stream "The choice would change if one of these were different:~%")
  (loop for change in (subseq changes 0 (min 5 (length changes)))
        do (format stream "  ~{~a: ~a, not ~a; then ~a~}~%" (change-words change))))

(defun change-words (change)
  "Return four texts of CHANGE: what is to be different, the value that it would have, the value
that it has now, and what would then be chosen."
  (list (change-what change)
        (if (change-at-once change) "anything above 0" (change-text (change-to change) change))
        (change-text (change-from change) change)
        (choice-text (change-plan change))))

(defun change-text (number change)
  "Return NUMBER, of what CHANGE changes, with its unit if its box counts in some of its own."
  (let ((units (%box-units (change-box change))))
    (if units
        (with-unit (exact-number-text number) (change-measure change) units)
        (exact-number-text number))))

(defun choice-text (plan)
  (if (plan-best plan)
      (format nil "~a (~{~a~^ ~})" (plan-grasp plan) (plan-matching plan))
      "it can't be grasped"))

(defmethod topic ((explanation choice))
  (choice-text (choice-plan explanation)))
