;;;; advice.lisp -- why the best grasp is the best, and what would change the choice.

(in-package :supergrip)

(defstruct limit
  "What limits a radius: the AXIS in words, what the grasp HAS there, what the task NEEDS there with
the effect of the offset, and the RADIUS."
  axis has needs radius)

(defstruct change
  "A single value of the box that changes the choice: WHAT it is, FROM and TO, and the PLAN that
results.  BOX is the changed box."
  what from to box plan)

(defstruct (advice (:include explanation))
  "Why the best grasp of PLAN is the best.  SENTENCE says how it holds the box; FORCE and VELOCITY are
LIMITs or NIL; RUNNER-UP is the next candidate or NIL, MARGIN its distance in Q; CHANGES is a list
of CHANGEs, the smallest first."
  plan sentence force velocity runner-up margin (changes '()))

;;; How it holds the box

(defparameter +approaches+ #("below" "above" "the side Y2" "the side Y1" "the side X2" "the side X1")
  "Where a palm over each face comes from.")

(defun fingers-on (grasp face-name)
  "Return what stands on each face that GRASP touches, and the face as FACE-NAME, a function of its
slot, calls it: \"two fingers\" \"N1\" \"a finger\" \"N2\"."
  (loop with slots = (mapcar #'first (grasp-contacts grasp))
        for slot in (remove-duplicates slots :from-end t)
        for count = (count slot slots)
        collect (if (= count 1) "a finger" (format nil "~r fingers" count))
        collect (funcall face-name slot)))

(defun grasp-sentence (candidate)
  "Return how CANDIDATE holds the box, in a sentence that a person would say."
  (let* ((grasp (%candidate-grasp candidate))
         (faces (matching-faces (%candidate-matching candidate)))
         (palm (svref faces (grasp-palm grasp))))
    (format nil "~a: ~{~a on ~a~^, ~}; the palm over ~a, coming from ~a"
            (grasp-name grasp)
            (fingers-on grasp (lambda (slot) (surface-name (svref faces slot))))
            (surface-name palm) (svref +approaches+ palm))))

(defun limit-at (axis has needs radius)
  "Return the LIMIT of RADIUS on AXIS, 0 to 5, where the grasp HAS, and the task NEEDS, six numbers."
  (make-limit :axis (axis-name axis) :has (aref has axis) :needs (aref needs axis) :radius radius))

(defun force-limit (candidate plan)
  "Return the LIMIT of u_w of CANDIDATE, or NIL if no force is needed."
  (when (candidate-force-axis candidate)
    (with-replay (attempt candidate plan)
      (limit-at (%candidate-force-limit candidate) (attempt-spare attempt)
                (attempt-force-needs attempt) (candidate-force-radius candidate)))))

(defun velocity-limit (candidate plan)
  "Return the LIMIT of u_t of CANDIDATE, or NIL if no velocity is needed."
  (when (candidate-velocity-axis candidate)
    (with-replay (attempt candidate plan)
      (limit-at (%candidate-velocity-limit candidate) (attempt-twist attempt)
                (attempt-velocity-needs attempt) (candidate-velocity-radius candidate)))))

;;; What would change the choice.  Each value of the task, the friction and the weight alone is moved
;;; away from what it is, until the plan chooses otherwise; then the place is found by halving.

(defun box-value-at (box key index)
  (ecase key
    (:force (aref (%box-force box) index))
    (:velocity (aref (%box-velocity box) index))
    (:u (%box-u box))
    (:v (%box-v box))
    (:weight (%box-weight box))))

(defun box-with (box key index value)
  "Return BOX with VALUE for KEY, at INDEX if that is six numbers."
  (let ((new (copy-structure box)))
    (flet ((six-with (six)
             (let ((copy (copy-seq six))) (setf (aref copy index) value) copy)))
      (ecase key
        (:force (setf (%box-force new) (six-with (%box-force box))))
        (:velocity (setf (%box-velocity new) (six-with (%box-velocity box))))
        (:u (setf (%box-u new) value))
        (:v (setf (%box-v new) value))
        (:weight (setf (%box-weight new) value))))
    new))

(defun value-name (key index)
  (ecase key
    (:force (format nil "the force needed ~a" (axis-name index)))
    (:velocity (format nil "the velocity needed ~a" (axis-name index)))
    (:u "the friction u")
    (:v "the torsional friction v")
    (:weight "the weight")))

(defun same-choice-p (a b)
  "True if the plans A and B chose the same grasp in the same matching, or both none."
  (and (equal (plan-grasp a) (plan-grasp b))
       (equal (plan-matching a) (plan-matching b))))

(defun needs-something-p (box)
  (or (some #'plusp (%box-force box)) (some #'plusp (%box-velocity box))))

(defun plan-like (plan box)
  "Return the plan for BOX, made as PLAN was."
  (if (plan-alone plan)
      (try-alone (plan-alone plan) box :knowledge (plan-knowledge plan) :gamma (plan-gamma plan))
      (plan box :knowledge (plan-knowledge plan) :gamma (plan-gamma plan))))

(defun find-change (plan key index)
  "Return the CHANGE of one value that is nearest to what it is, or NIL if none up to its bound does."
  (let* ((box (plan-box plan))
         (from (box-value-at box key index))
         (most (if (member key '(:force :velocity)) 1d0 (max 2d0 (* 4 from))))
         (step (/ most 50)))
    (labels ((other-p (value)
               (let ((new (box-with box key index value)))
                 (and (needs-something-p new)
                      (not (same-choice-p plan (plan-like plan new))))))
             (edge (same other)
               (loop repeat 40
                     do (let ((middle (/ (+ same other) 2)))
                          (if (other-p middle) (setf other middle) (setf same middle))))
               (rounded other same))
             (rounded (other same)
               ;; The nearest short decimal on the far side, if it does.
               (loop for digits from 2 to 6
                     for unit = (expt 10d0 digits)
                     for value = (/ (if (> other same) (fceiling (* other unit)) (ffloor (* other unit)))
                                    unit)
                     when (and (<= 0 value most) (other-p value))
                       return value
                     finally (return other)))
             (change (value)
               (let ((new (box-with box key index value)))
                 (make-change :what (value-name key index) :from from :to value :box new
                              :plan (plan-like plan new)))))
      (loop for k from 1 to 50
            for up = (min most (+ from (* k step)))
            for down = (max 0d0 (- from (* k step)))
            do (when (and (> up from) (other-p up))
                 (return (change (edge (max from (- up step)) up))))
               (when (and (< down from) (other-p down))
                 (return (change (edge (min from (+ down step)) down))))))))

(defun find-changes (plan)
  "Return the CHANGEs of single values that change the choice of PLAN, the smallest first."
  (sort (loop for (key count) in '((:force 6) (:velocity 6) (:u 1) (:v 1) (:weight 1))
              append (loop for index below count
                           for change = (find-change plan key index)
                           when change collect change))
        #'< :key (lambda (change) (abs (- (change-to change) (change-from change))))))

;;; The answer

(defun advise (&optional (plan *plan*))
  "Return the ADVICE on PLAN: why its best grasp is the best, and what would change the choice."
  (let* ((plan (need-plan plan))
         (best (plan-best plan))
         (runner-up (second (plan-possible plan))))
    (make-advice :plan plan
                 :sentence (if best
                               (grasp-sentence best)
                               (format nil "The box can't be grasped: ~a" (plan-reason plan)))
                 :force (and best (force-limit best plan))
                 :velocity (and best (velocity-limit best plan))
                 :runner-up (and best runner-up)
                 :margin (and best runner-up
                              (- (candidate-quality best) (candidate-quality runner-up)))
                 :changes (find-changes plan))))

(defun explain-best (&optional (plan *plan*))
  "Print and return why the best grasp of PLAN is the best: how it holds the box, what limits it, the
runner-up, and which single need, friction or weight would have to change, and to what, for the
choice to change."
  (print-answer (advise plan)))

(defmethod write-answer ((answer advice) stream)
  (format stream "~a.~%" (advice-sentence answer))
  (write-limit "Force" "exerts" "beyond the weight's load" (advice-force answer) stream)
  (write-limit "Velocity" "moves with" nil (advice-velocity answer) stream)
  (when (advice-runner-up answer)
    (format stream "Next is ~a (~{~a~^ ~}), with ~:[the same Q, tried later~;Q ~a less~].~%"
            (candidate-grasp (advice-runner-up answer))
            (candidate-matching (advice-runner-up answer)) (> (advice-margin answer) +tie+)
            (figure (advice-margin answer))))
  (if (advice-changes answer)
      (write-changes (advice-changes answer) stream)
      (format stream "No single need, friction or weight would change the choice.~%")))

(defun write-limit (kind verb beyond limit stream)
  (when limit
    (format stream "~a is limited ~a: the grasp ~a ~a~@[ ~a~], the task needs ~a; radius ~a.~%" kind
            (limit-axis limit) verb (figure (limit-has limit)) beyond
            (figure (limit-needs limit)) (figure (limit-radius limit)))))

(defun write-changes (changes stream)
  (format stream "The choice would change if one of these were different:~%")
  (loop for change in (subseq changes 0 (min 5 (length changes)))
        do (format stream "  ~a: ~a, not ~a; then ~a~%" (change-what change)
                   (figure-exact (change-to change)) (figure-exact (change-from change))
                   (choice-text (change-plan change)))))

(defun figure-exact (number)
  "Return NUMBER in full, without zeros at its end."
  (string-right-trim "." (string-right-trim "0" (form-text number))))

(defun choice-text (plan)
  (if (plan-best plan)
      (format nil "~a (~{~a~^ ~})" (plan-grasp plan) (plan-matching plan))
      "it can't be grasped"))

(defmethod topic ((explanation advice))
  (choice-text (advice-plan explanation)))
