;;;; plan.lisp -- a plan: a pure function of a box, knowledge and gamma.

(in-package :supergrip)

(defparameter *gamma* 0.5d0
  "The selection parameter of the quality index: Q = gamma u_t + (1 - gamma) u_w.")

(defvar *plan* nil "The plan that FORWARD-CHAIN made last, or NIL.")

(define-condition no-plan-error (supergrip-error)
  ((given :initarg :given :initform nil))
  (:report (lambda (condition stream)
             (with-slots (given) condition
               (if given
                   (format stream "~a is no plan: FORWARD-CHAIN, PLAN and TRY-GRASP return plans"
                           (form-text given))
                   (write-string "there is no plan yet: call (forward-chain) first" stream)))))
  (:documentation "A question about a plan was asked before there was one, or of something else."))

(define-condition argument-error (supergrip-error)
  ((text :initarg :text))
  (:report (lambda (condition stream) (write-string (slot-value condition 'text) stream)))
  (:documentation "A function was given something that it can't use."))

(defun refuse-argument (control &rest arguments)
  "Signal an ARGUMENT-ERROR that says what CONTROL and ARGUMENTS say."
  (error 'argument-error :text (apply #'format nil control arguments)))

(defun check-knowledge-argument (object)
  "Return OBJECT if it is knowledge."
  (if (knowledge-p object)
      object
      (refuse-argument "~a is no knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in force"
                       (form-text object))))

(defun name-of (designator)
  "Return the name that DESIGNATOR, a symbol of any package, a string in any case, a rule or a grasp,
stands for; NIL if it is none of these."
  (typecase designator
    (rule (rule-name designator))
    (grasp (grasp-name designator))
    ((or symbol string) (string-upcase designator))))

(defun listed (names &optional (most 40) (between ", "))
  "Return NAMES, a list of strings, with BETWEEN between them; of many the first MOST, and how many
more."
  (let ((left (- (length names) most)))
    (with-output-to-string (out)
      (loop for (name . others) on names repeat most
            do (write-string name out)
               (when others (write-string between out)))
      (when (plusp left)
        (format out "and ~d more" left)))))

(defstruct (plan (:constructor %make-plan) (:copier nil))
  "What was decided for a box, and all that led to it."
  (box nil :type box) (knowledge nil :type knowledge) (gamma 0.5d0 :type double-float)
  (stop nil) (best nil) (log '() :type list) (facts nil :type (or null saved-facts))
  (alone nil))                          ; the name of the grasp that was tried without rules

(defun need-plan (plan)
  (if (plan-p plan) plan (error 'no-plan-error :given plan)))

(defmethod print-object ((plan plan) stream)
  (print-unreadable-object (plan stream :type t)
    (plainly
      (if (plan-best plan)
          (format stream "~a (~{~a~^ ~}) Q=~,3f" (plan-grasp plan) (plan-matching plan)
                  (plan-quality plan))
          (format stream "~:[can't: ~;~]~a" (unfinished-p plan) (plan-reason plan))))))

(defun plan (box &key (knowledge *knowledge*) (gamma *gamma*))
  "Return the plan for BOX, a box or a description of one (see PARSE-BOX).
KNOWLEDGE holds the rules and grasps to use, GAMMA from 0 to 1 weighs velocities against forces.
A box that can't be grasped is a result: see PLAN-VERDICT.  Safe to call from several threads."
  (with-plain-floats
    (let ((memory (start-plan box knowledge gamma)))
      (finish-plan memory knowledge (run-rules (knowledge-rulebase knowledge) memory)))))

(defun try-grasp (name &rest arguments)
  "(TRY-GRASP NAME [BOX] &KEY KNOWLEDGE GAMMA): return a plan for BOX, by default what (setq box ...)
gave, in which no rule has run: the grasp NAME, a string or a symbol, was tried in all matchings that
use no constrained face, equivalent ones once.  Other arguments as for PLAN."
  (if (or (null arguments) (keywordp (first arguments)))
      (apply #'try-alone name (need-box) arguments)
      (apply #'try-alone name arguments)))

(defun try-alone (name box &key (knowledge *knowledge*) (gamma *gamma*))
  (with-plain-floats
    (let ((grasp (or (and (name-of name)
                          (find-grasp (knowledge-graspbase knowledge) (name-of name)))
                     (error 'no-grasp-error :name name :knowledge knowledge)))
          (memory (start-plan box knowledge gamma)))
      (try-matchings memory grasp +all-matchings+)
      (finish-plan memory knowledge nil (grasp-name grasp)))))

(define-condition no-grasp-error (supergrip-error)
  ((name :initarg :name :reader no-grasp-error-name)
   (knowledge :initarg :knowledge :reader no-grasp-error-knowledge))
  (:report (lambda (condition stream)
             (let ((name (no-grasp-error-name condition))
                   (known (mapcar #'grasp-name
                                  (knowledge-grasps (no-grasp-error-knowledge condition)))))
               (format stream "there is no grasp ~a~a; grasps are ~a" (form-text name)
                       (suggestion (or (name-of name) "") known) (listed known)))))
  (:documentation "A grasp was named that the database lacks."))

(defun new-memory (knowledge)
  "Return a memory for the rules of KNOWLEDGE, whose client is an attempt with its grasps."
  (make-memory (knowledge-rulebase knowledge) (make-attempt (knowledge-graspbase knowledge))))

(defun prepare-memory (memory box knowledge gamma)
  "Make MEMORY, an empty one, ready for a plan for BOX: it holds the preliminary assertions, and its
attempt has tried nothing yet.  Return it."
  (start-attempt (memory-client memory) box gamma)
  (assert-box memory (knowledge-inputs knowledge) box)
  memory)

(defun start-plan (box knowledge gamma)
  "Return a memory ready for a plan for BOX: one that another plan gave back, or a new one."
  (let ((box (if (box-p box) box (parse-box box)))
        (gamma (check-gamma gamma)))
    (prepare-memory (or (take-from (knowledge-spare knowledge)) (new-memory knowledge))
                    box knowledge gamma)))

(defun give-back (memory knowledge)
  "Let another plan use MEMORY."
  (clear-memory memory (knowledge-rulebase knowledge))
  (setf (attempt-box (memory-client memory)) nil
        (attempt-best (memory-client memory)) nil)
  (give-to (knowledge-spare knowledge) memory))

(defun finish-plan (memory knowledge stop &optional alone)
  "Return the plan that MEMORY holds, of the grasp ALONE if no rule has run, and give MEMORY back.
Rules that end without KEEP or CANT keep the best."
  (let ((attempt (memory-client memory)))
    (declare (type attempt attempt))
    (prog1 (%make-plan :box (attempt-box attempt) :knowledge knowledge
                       :gamma (attempt-gamma attempt) :stop stop :alone alone
                       :best (and (not (and stop (eq (stop-verdict stop) :cant)))
                                  (attempt-best attempt))
                       :log (nreverse (memory-log memory)) :facts (save-facts memory))
      (give-back memory knowledge))))

(defun waiting-p (stop)
  "True if STOP ends no run: it says where a run that the debugger has stopped stands."
  (member (stop-verdict stop) '(:before :within)))

(defun unfinished-p (plan)
  "True if PLAN is of a run that the debugger has stopped."
  (and (plan-stop plan) (waiting-p (plan-stop plan))))

(defun reached-p (rule plan)
  "True if the run of PLAN, if it is unfinished, has come to RULE."
  (or (not (unfinished-p plan))
      (let ((last (rule-index (stop-rule (plan-stop plan)))))
        (if (eq (stop-verdict (plan-stop plan)) :before)
            (< (rule-index rule) last)
            (<= (rule-index rule) last)))))

(defun plan-memory (plan)
  "Return a memory that holds all that is known at the end of PLAN."
  (let* ((rulebase (knowledge-rulebase (plan-knowledge plan)))
         (memory (make-memory rulebase)))
    (restore-facts memory (rulebase-predicates rulebase) (plan-facts plan))
    memory))

(defun check-gamma (gamma)
  (let ((number (and (realp gamma) (as-double gamma))))
    (if (and number (<= 0d0 number 1d0))
        number
        (error 'gamma-error :gamma gamma))))

(define-condition gamma-error (supergrip-error)
  ((gamma :initarg :gamma :reader gamma-error-gamma))
  (:report (lambda (condition stream)
             (format stream "gamma is ~a; it is a number from 0, forces alone, to 1, ~
                             velocities alone" (form-text (gamma-error-gamma condition)))))
  (:documentation "The selection parameter is no number from 0 to 1."))

(defun plan-verdict (&optional (plan *plan*))
  "Return :GRASP if PLAN found a grasp, :CANT if the box can't be grasped."
  (if (plan-best (need-plan plan)) :grasp :cant))

(defun plan-candidates (&optional (plan *plan*))
  "Return the candidates of PLAN, a new list, in the order in which they were tried."
  (loop for event in (plan-log (need-plan plan)) when (candidate-p event) collect event))

(defun possible-p (candidate)
  (eq (%candidate-outcome candidate) :possible))

(defun plan-possible (&optional (plan *plan*))
  "Return the possible grasps of PLAN, candidates, the best first; equals as they were tried."
  ;; STABLE-SORT destroys its list: it gets one that nobody else holds.
  (stable-sort (loop for candidate in (plan-candidates plan)
                     when (possible-p candidate) collect candidate)
               #'> :key #'%candidate-quality))

(defun plan-rejected (&optional (plan *plan*))
  "Return the candidates of PLAN that failed, in the order in which they were tried."
  (remove-if #'possible-p (plan-candidates plan)))

(defun plan-assertions (&optional (plan *plan*))
  "Return the assertions at the end of PLAN: a list a predicate, its words followed by its lists of
surfaces, all strings."
  (assertions (plan-memory (need-plan plan)) (knowledge-predicates (plan-knowledge plan))))

(defun plan-grasp (&optional (plan *plan*))
  "Return the name of the best grasp of PLAN, a string, or NIL."
  (and (plan-best (need-plan plan)) (candidate-grasp (plan-best plan))))

(defun plan-matching (&optional (plan *plan*))
  "Return the matching of the best grasp of PLAN: the names of the faces that N1 N2 O1 O2 A1 A2
take; or NIL."
  (and (plan-best (need-plan plan)) (candidate-matching (plan-best plan))))

(defun plan-quality (&optional (plan *plan*))
  "Return the quality index of the best grasp of PLAN, a double, or NIL."
  (and (plan-best (need-plan plan)) (candidate-quality (plan-best plan))))

;;; Candidates

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
  (and (eq (candidate-outcome candidate) :possible) (%candidate-quality candidate)))

(defun axis-or-nil (candidate limit)
  (and (eq (candidate-outcome candidate) :possible) (>= limit 0) (axis-name limit)))

(defun candidate-force-axis (candidate)
  "Return the axis that limits u_w of CANDIDATE, as \"about Y\", or NIL if no force is needed."
  (axis-or-nil candidate (%candidate-force-limit candidate)))

(defun candidate-velocity-axis (candidate)
  "Return the axis that limits u_t of CANDIDATE, as \"along Z\", or NIL if no velocity is needed."
  (axis-or-nil candidate (%candidate-velocity-limit candidate)))

(defun candidate-force-radius (candidate)
  "Return u_w of CANDIDATE, or NIL if the task needs no force or it is not possible."
  (and (candidate-force-axis candidate) (%candidate-force-radius candidate)))

(defun candidate-velocity-radius (candidate)
  "Return u_t of CANDIDATE, or NIL if the task needs no velocity or it is not possible."
  (and (candidate-velocity-axis candidate) (%candidate-velocity-radius candidate)))

(defun candidate-offset (candidate)
  "Return the grasp centre of CANDIDATE from the box centre: three numbers along X Y Z, in cm."
  (mapcar #'without-sign-of-zero
          (list (%candidate-x candidate) (%candidate-y candidate) (%candidate-z candidate))))

(defun without-sign-of-zero (number)
  (+ number 0d0))

(defun unit-vector (face sign)
  "Return the outward normal of the box face FACE, times SIGN, as a list along X Y Z."
  (loop for axis below 3
        collect (if (= axis (surface-axis face))
                    (coerce (* sign (surface-sign face)) 'double-float)
                    0d0)))

(defun candidate-approach (candidate)
  "Return the direction of approach of CANDIDATE: a unit vector in the box frame, from the palm to
the box."
  (unit-vector (svref (matching-faces (%candidate-matching candidate))
                      (grasp-palm (%candidate-grasp candidate)))
               -1))

(defun replay (candidate attempt)
  "Take CANDIDATE through the steps again, in ATTEMPT, at its box; return ATTEMPT, which holds its
figures."
  (run-steps attempt (make-candidate (%candidate-grasp candidate)
                                     (%candidate-matching candidate)))
  attempt)

(defmacro with-attempt ((attempt plan) &body body)
  "Run BODY with ATTEMPT, one at the box of PLAN, which is given back after it."
  (let ((memory (gensym)) (the-plan (gensym)))
    `(without-float-traps
       (let* ((,the-plan (need-plan ,plan))
              (,memory (start-plan (plan-box ,the-plan) (plan-knowledge ,the-plan)
                                   (plan-gamma ,the-plan)))
              (,attempt (memory-client ,memory)))
         (multiple-value-prog1 (progn ,@body)
           (give-back ,memory (plan-knowledge ,the-plan)))))))

(defmacro with-replay ((attempt candidate plan) &body body)
  "Run BODY with ATTEMPT, which holds the figures of CANDIDATE of PLAN and is given back after it."
  `(with-attempt (,attempt ,plan)
     (replay ,candidate ,attempt)
     ,@body))

(defun candidate-contacts (candidate &optional (plan *plan*))
  "Return the contacts of CANDIDATE, which is possible in PLAN: a list of plists with :SURFACE, the
name of a box face, :POSITION and :NORMAL, lists along X Y Z in the box frame at the box centre;
positions in cm, the normals point inward."
  (with-replay (attempt candidate plan)
    (execute (grasp-positions (%candidate-grasp candidate)) (attempt-registers attempt))
    (loop with registers = (attempt-registers attempt)
          with matching = (%candidate-matching candidate)
          for (slot p q) in (grasp-contacts (%candidate-grasp candidate))
          for face = (svref (matching-faces matching) slot)
          collect (list :surface (surface-name face)
                        :position (contact-position attempt matching slot
                                                    (aref registers p) (aref registers q))
                        :normal (unit-vector face -1)))))

(defun contact-position (attempt matching slot p q)
  "Return the place, along X Y Z, of a finger on SLOT at P, Q along its two other axes."
  (let ((position (make-list 3))
        (rest (list p q)))
    (dotimes (i 3 position)
      (setf (nth (aref (matching-axes matching) i) position)
            (without-sign-of-zero
             (* (aref (matching-signs matching) i)
                (if (= i (floor slot 2))
                    (* (if (evenp slot) 0.5d0 -0.5d0) (aref (attempt-lengths attempt) i))
                    (+ (aref (attempt-centre attempt) i) (pop rest)))))))))

(defun candidate-wrench (candidate &optional (plan *plan*))
  "Return what CANDIDATE of PLAN exerts along X Y Z and about X Y Z, gravity's load not taken off:
six numbers, forces in finger forces, torques in finger force x cm.  NIL where it failed before."
  (and (member (candidate-outcome candidate) '(:possible :lifting))
       (with-replay (attempt candidate plan)
         (coerce (attempt-wrench attempt) 'list))))

(defun candidate-twist (candidate &optional (plan *plan*))
  "Return the mobility of CANDIDATE of PLAN along X Y Z and about X Y Z, six numbers.
NIL where it failed before."
  (and (member (candidate-outcome candidate) '(:possible :lifting))
       (with-replay (attempt candidate plan)
         (coerce (attempt-twist attempt) 'list))))

(defun candidate-palm (candidate)
  "Return the name of the box face that the palm of CANDIDATE is over."
  (surface-name (svref (matching-faces (%candidate-matching candidate))
                       (grasp-palm (%candidate-grasp candidate)))))

(defun six-at-centre (function given candidate)
  "Return the list of six that FUNCTION, of what is GIVEN at the box centre, an offset and a result,
makes of it at the grasp centre of CANDIDATE."
  (let ((offset (map '(simple-array double-float (3)) #'abs (candidate-offset candidate)))
        (result (make-array 6 :element-type 'double-float)))
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
  (six-at-centre #'put-load (box-weight (plan-box plan)) candidate))
