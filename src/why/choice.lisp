;;;; choice.lisp -- why the best grasp is the best, and what would change the choice.

(in-package :supergrip)

(defstruct limit
  "What limits a radius: the AXIS in words, what the grasp HAS there, what the task NEEDS there with
the effect of the offset, and the RADIUS."
  axis has needs radius)

(defstruct change
  "A single value of the box that changes the choice: WHAT it is, FROM and TO, and the PLAN that
results.  BOX is the changed box; SIZE is how far from FROM the choice changes, not rounded."
  what from to box plan size)

(defstruct (choice (:include explanation))
  "Why the best grasp of PLAN is the best.  SENTENCE says how it holds the box; FORCE and VELOCITY are
LIMITs or NIL; RUNNER-UP is the next candidate or NIL, MARGIN its distance in Q; CHANGES is a list
of CHANGEs, the smallest first."
  plan sentence force velocity runner-up margin (changes '()))

;;; How it holds the box

(defparameter +approaches+ #("below" "above" "the side Y2" "the side Y1" "the side X2" "the side X1")
  "Where a palm over each face comes from.")

(defun fingers-on (grasp face-name)
  "Return what stands on each face that GRASP touches, and the face as FACE-NAME, a function of its
grasp-face, calls it: \"two fingers\" \"N1\" \"a finger\" \"N2\"."
  (loop with grasp-faces = (mapcar #'first (grasp-contacts grasp))
        for grasp-face in (remove-duplicates grasp-faces :from-end t)
        for count = (count grasp-face grasp-faces)
        collect (if (= count 1) "a finger" (format nil "~r fingers" count))
        collect (funcall face-name grasp-face)))

(defun grasp-sentence (candidate)
  "Return how CANDIDATE holds the box, in a sentence that a person would say."
  (let* ((grasp (%candidate-grasp candidate))
         (faces (matching-faces (%candidate-matching candidate)))
         (palm (svref faces (grasp-palm grasp))))
    (format nil "~a: ~{~a on ~a~^, ~}; the palm over ~a, coming from ~a"
            (grasp-name grasp)
            (fingers-on grasp (lambda (grasp-face) (face-name (svref faces grasp-face))))
            (face-name palm) (svref +approaches+ palm))))

(defun limit-at (axis has needs radius)
  "Return the LIMIT of RADIUS on AXIS, 0 to 5, where the grasp HAS, and the task NEEDS, six numbers."
  (make-limit :axis (axis-name axis) :has (aref has axis) :needs (aref needs axis) :radius radius))

(defun force-limit (candidate plan)
  "Return the LIMIT of u_w of CANDIDATE, or NIL if no force is needed."
  (when (candidate-force-axis candidate)
    (with-replay (workspace candidate plan)
      (limit-at (%candidate-force-limit candidate) (workspace-spare workspace)
                (workspace-force-needs workspace) (candidate-force-radius candidate)))))

(defun velocity-limit (candidate plan)
  "Return the LIMIT of u_t of CANDIDATE, or NIL if no velocity is needed."
  (when (candidate-velocity-axis candidate)
    (with-replay (workspace candidate plan)
      (limit-at (%candidate-velocity-limit candidate) (workspace-twist workspace)
                (workspace-velocity-needs workspace) (candidate-velocity-radius candidate)))))

;;; What would change the choice.  Each value of the task, the friction and the weight alone is moved
;;; away from what it is, until the plan chooses otherwise; then the place is found by halving.

(defun value-at (box row index)
  "Return the value of the key ROW of BOX, at INDEX if that is six numbers."
  (let ((value (box-value box (box-key-key row))))
    (if (arrayp value) (aref value index) value)))

(defun box-with-at (box row index value)
  "Return a box as BOX with VALUE for the key ROW, at INDEX if that is six numbers."
  (let ((six (box-value box (box-key-key row))))
    (if (arrayp six)
        (let ((copy (copy-seq six)))
          (setf (aref copy index) value)
          (box-with box row copy))
        (box-with box row value))))

(defun value-name (row index)
  (format nil "~a~@[ ~a~]" (box-key-words row)
          (and (eq (box-key-type row) :needs) (axis-name index))))

(defun same-choice-p (a b)
  "True if the plans A and B chose the same grasp in the same matching, or both none."
  (and (equal (plan-grasp a) (plan-grasp b))
       (equal (plan-matching a) (plan-matching b))))

(defun needs-something-p (box)
  (or (some #'plusp (%box-force box)) (some #'plusp (%box-velocity box))))

(defun plan-like (plan box)
  "Return the plan for BOX, made as PLAN was."
  (if (plan-tries plan)
      (try-without-rules (plan-tries plan) box :knowledge (plan-knowledge plan)
                                               :gamma (plan-gamma plan))
      (plan box :knowledge (plan-knowledge plan) :gamma (plan-gamma plan))))

(defun find-change (plan row index)
  "Return the CHANGE of one value that is nearest to what it is, or NIL if none up to its bound does."
  (let* ((box (plan-box plan))
         (from (value-at box row index))
         (most (if (eq (box-key-type row) :needs) 1d0 (max 2d0 (* 4 from))))
         (step (/ most 50)))
    (labels ((other-p (value)
               (let ((new (box-with-at box row index value)))
                 (and (<= 0 value most)
                      (needs-something-p new)
                      (not (same-choice-p plan (plan-like plan new))))))
             (change (same other)
               (multiple-value-bind (same other) (halve same other #'other-p)
                 (let* ((to (if (at-once-p from other)
                                (loop for value = 0.01d0 then (/ value 10)
                                      when (other-p value) return value)
                                (short-decimal-beyond same other from #'other-p)))
                        (new (box-with-at box row index to)))
                   (make-change :what (value-name row index) :from from :to to :box new
                                :plan (plan-like plan new) :size (abs (- other from)))))))
      (loop for k from 1 to 50
            for up = (min most (+ from (* k step)))
            for down = (max 0d0 (- from (* k step)))
            do (when (and (> up from) (other-p up))
                 (return (change (max from (- up step)) up)))
               (when (and (< down from) (other-p down))
                 (return (change (min from (+ down step)) down)))))))

(defun at-once-p (from to)
  "True if a value that is 0, FROM, changes the choice as soon as it is more: at TO."
  (and (zerop from) (< to 1d-12)))

(defun halve (same other other-p)
  "Return two numbers between SAME and OTHER, as near to each other as may be, of which OTHER-P is
false and true, as of SAME and OTHER."
  (loop repeat 100
        for middle = (/ (+ same other) 2)
        until (or (= middle same) (= middle other))
        do (if (funcall other-p middle) (setf other middle) (setf same middle)))
  (values same other))

(defun short-decimal-beyond (same other from other-p)
  "Return the shortest decimal, from three digits on, that is beyond OTHER as seen from FROM, of which
OTHER-P is true, and false of the next one of as many digits towards FROM.  SAME is just before."
  (let* ((direction (if (> other same) 1 -1))
         (exponent (decimal-exponent (rational (max same other)))))
    (loop for digits from 3 to 17
          for unit = (expt 10 (- exponent digits -1))
          for value = (* unit direction (ceiling (* direction (rational other)) unit))
          for next = (- value (* direction unit))
          when (and (<= unit (* direction (- value (rational from))))
                    (funcall other-p (coerce value 'double-float))
                    (not (funcall other-p (coerce next 'double-float))))
            return (coerce value 'double-float)
          finally (return other))))

(defun find-changes (plan)
  "Return the CHANGEs of single values that change the choice of PLAN, the smallest first."
  (stable-sort (loop for row in (remove nil *box-keys* :key #'box-key-words)
                     append (loop for index below (if (eq (box-key-type row) :needs) 6 1)
                                  for change = (find-change plan row index)
                                  when change collect change))
               #'< :key #'change-size))

;;; The answer

(defun explain-choice (&optional (plan *plan*))
  "Return the CHOICE on PLAN: why its best grasp is the best, and what would change the choice."
  (when (unfinished-p (need-plan plan))
    (refuse-argument "the run is not over, so there is no best grasp yet"))
  (let* ((best (plan-best plan))
         (runner-up (second (plan-possible plan))))
    (make-choice :plan plan
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
  (print-answer (explain-choice plan)))

(defmethod write-answer ((answer choice) stream)
  (format stream "~a.~%" (choice-sentence answer))
  (write-limit "Force" "exerts" "beyond the weight's load" (choice-force answer) stream)
  (write-limit "Velocity" "moves with" nil (choice-velocity answer) stream)
  (write-meaning answer stream)
  (when (choice-runner-up answer)
    (format stream "Next is ~a (~{~a~^ ~}), with ~:[the same Q, but tried later~;a Q lower by ~a~].~%"
            (candidate-grasp (choice-runner-up answer))
            (candidate-matching (choice-runner-up answer)) (> (choice-margin answer) +tie+)
            (number-text (choice-margin answer))))
  (if (choice-changes answer)
      (write-changes (choice-changes answer) stream)
      (format stream "No single need, friction or weight would change the choice.~%")))

(defun write-limit (kind verb beyond limit stream)
  (when limit
    (destructuring-bind (has needs radius one)
        (number-texts (limit-has limit) (limit-needs limit) (limit-radius limit) 1)
      (declare (ignore one))
      (format stream "~a is limited ~a: the grasp ~a ~a~@[ ~a~], the task needs ~a; radius ~a.~%" kind
              (limit-axis limit) verb has beyond needs radius))))

(defun write-meaning (answer stream)
  "Write what a radius below 1, and Q, mean."
  (loop for limit in (list (choice-force answer) (choice-velocity answer))
        for kind in '("force" "velocity")
        when (and limit (< (limit-radius limit) (- 1 +tie+)))
          do (format stream "The grasp gives only ~a of the ~a asked for, which is enough if the needs ~
                             only say what matters more.~%"
                     (first (number-texts (limit-radius limit) 1)) kind))
  (let ((best (plan-best (choice-plan answer))))
    (when best
      (format stream "Q, ~a, only compares grasps for one task; it is not a probability of success.~%"
              (three-decimals (candidate-quality best))))))

(defun write-changes (changes stream)
  (format stream "The choice would change if one of these were different:~%")
  (loop for change in (subseq changes 0 (min 5 (length changes)))
        do (format stream "  ~{~a: ~a, not ~a; then ~a~}~%" (change-words change))))

(defun change-words (change)
  "Return four texts of CHANGE: what is to be different, the value that it would have, the value that it
has, and what would then be chosen."
  (list (change-what change)
        (if (at-once-p (change-from change) (change-size change))
            "anything above 0"
            (exact-number-text (change-to change)))
        (exact-number-text (change-from change))
        (choice-text (change-plan change))))

(defun choice-text (plan)
  (if (plan-best plan)
      (format nil "~a (~{~a~^ ~})" (plan-grasp plan) (plan-matching plan))
      "it can't be grasped"))

(defmethod topic ((explanation choice))
  (choice-text (choice-plan explanation)))
