;;;; plan.lisp -- a plan: a pure function of a box, knowledge and gamma.

(in-package :supergrip)

(defparameter *gamma* 0.5d0
  "The selection parameter of the quality index: Q = gamma u_t + (1 - gamma) u_w.")

(defvar *plan* nil "The plan that FORWARD-CHAIN or TRY made last, or NIL.")

(defvar *box* nil "The box that BOX was set to last, or NIL.")

(define-condition no-box-error (supergrip-error) ()
  (:report "there is no box yet: set one with (setq box '((SIZE 12 2 2) (WEIGHT 0.2) ...))")
  (:documentation "Something was asked about the box before one was set."))

(defun need-box ()
  "Return the box that was set last, or signal a NO-BOX-ERROR."
  (or *box* (error 'no-box-error)))

(define-condition no-plan-error (supergrip-error)
  ((given :initarg :given :initform nil))
  (:report (lambda (condition stream)
             (with-slots (given) condition
               (if given
                   (format stream "~a is not a plan: FORWARD-CHAIN, PLAN and TRY-GRASP return ~
                                   plans~:[~;; HOW, WHY-NOT and REQUIRES answer about a name or a ~
                                   fact~]"
                           (form-text given) (or (namep given) (consp given) (stringp given)))
                   (write-string "there is no plan yet: call (forward-chain) first" stream)))))
  (:documentation "A question about a plan was asked before there was a plan, or about something
that is no plan."))

(defvar *made-in* '()
  "The plan that was made last, and what was in force then: the box, the knowledge and gamma.")

(defun make-last (plan)
  "Make PLAN the one that questions are about."
  (setf *made-in* (list plan *box* *knowledge* *gamma*)
        *plan* plan))

(defstruct (plan (:constructor %make-plan) (:copier nil))
  "What was decided for a box, and all that led to it."
  (box nil :type box :read-only t)
  (knowledge nil :type knowledge :read-only t)
  (gamma 0.5d0 :type double-float :read-only t)
  (index :paper :type keyword :read-only t)
  (stop nil :read-only t)
  (best nil :read-only t)
  (entries '() :type list :read-only t) ; in order: see PLAN-LOG
  (facts nil :type (or null saved-facts) :read-only t)
  (tries '() :type list :read-only t))  ; if no rule ran, what was tried: see TRY-WITHOUT-RULES

(define-condition outdated-plan (warning)
  ((changed :initarg :changed) (by-hand :initarg :by-hand))
  (:report (lambda (condition stream)
             (with-slots (changed by-hand) condition
               (format stream "~{~a~^ and ~} changed after this plan was made; ~:[(forward-chain)~;~
                               (try ...)~] makes a new one" changed by-hand))))
  (:documentation "A question was asked about *PLAN*, but the box, the knowledge or gamma
is not any more what it was when that was made."))

(defun changed-since (plan)
  "Return what is not any more as it was when PLAN, the last one, was made, nor as in PLAN: texts."
  (destructuring-bind (&optional last box knowledge gamma) *made-in*
    (and last (eq plan last)
         (loop for (name now . thens) in `(("the box" ,*box* ,box ,(plan-box plan))
                                           ("the knowledge" ,*knowledge* ,knowledge
                                                            ,(plan-knowledge plan))
                                           ("gamma" ,*gamma* ,gamma ,(plan-gamma plan)))
               unless (member now thens :test (if (knowledge-p now) #'eq #'equalp))
                 collect name))))

(defun last-plan ()
  "Return *PLAN*, what questions are about if no other is given.  Warns if it is outdated."
  (let ((changed (and (plan-p *plan*) (changed-since *plan*))))
    (when changed
      (warn 'outdated-plan :changed changed :by-hand (plan-tries *plan*)))
    *plan*))

(defun check-knowledge-argument (object &optional instead)
  "Return OBJECT if it is knowledge.  INSTEAD says what else may have been meant."
  (if (knowledge-p object)
      object
      (refuse-argument "~a is not knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in ~
                        force~@[; ~a~]"
                       (form-text object) instead)))

(defun name-of (designator)
  "Return the name that DESIGNATOR, a symbol of any package, a string in any case, a rule, a grasp,
the form of a rule or the property list of a grasp in force, stands for; NIL if it is none of
these."
  (typecase designator
    (rule (rule-name designator))
    (grasp (grasp-name designator))
    ((or symbol string) (string-upcase designator))
    (cons (name-defined-by designator))))

(defun name-defined-by (definition)
  "Return the name of the rule in force whose form, or the grasp whose property list, is DEFINITION;
or NIL."
  (flet ((text (form) (form-text form *record-limit*)))
    (let ((text (text definition)))
      (or (loop for rule in (knowledge-rules *knowledge*)
                when (string= text (text (rule-form rule))) return (rule-name rule))
          (loop for grasp in (knowledge-grasps *knowledge*)
                when (string= text (text (grasp-properties grasp))) return (grasp-name grasp))))))

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

(defun plan-events (plan)
  "Return the events of PLAN, each a fact that a rule remembered, a new list in order: see
EVENT-FACT."
  ;; REMOVE-IF might share its end with the log.
  (loop for entry in (plan-entries plan) unless (candidate-p entry) collect entry))

(defun plan-log (plan)
  "Return all that happened in PLAN, in order: candidates, and events (see PLAN-EVENTS)."
  (copy-list (plan-entries plan)))

(defun checked-keys (arguments function keys example)
  "Return ARGUMENTS, keys and values for FUNCTION, if each key is one of KEYS.  EXAMPLE is a right
call."
  (loop for (key . rest) on arguments by #'cddr
        unless (member key keys)
          do (refuse-argument "~a is not a key of ~a: keys are ~{:~a~^, ~}~@[; a value goes ~
                               after its key, as in ~a~]" (form-text key) function keys
                              (and (not (namep key)) example))
        unless rest
          do (refuse-argument "there is no value after the key :~a of ~a" key function))
  arguments)

(defun need-plan (plan)
  (if (plan-p plan) plan (error 'no-plan-error :given plan)))

(defun plan (box &key (knowledge *knowledge*) (gamma *gamma*) (index :paper) margin)
  "Return the plan for BOX, a box or a description of one (see PARSE-BOX).
KNOWLEDGE holds the rules and grasps to use, GAMMA from 0 to 1 weighs velocities against forces.
INDEX is :PAPER, or :EXACT: then closure, lifting and u_w are what the contacts can really do,
proved (see docs/physics.md).  MARGIN, a number above 0, multiplies the weight of BOX, and its needs
if they are absolute, as in (UNITS CM N).
A box that can't be grasped is a result: see PLAN-VERDICT.  Safe to call from several threads."
  (with-plain-floats
    (let ((memory (start-plan (box-at-margin box margin) knowledge gamma index)))
      (finish-plan memory knowledge (run-rules (knowledge-rulebase knowledge) memory)))))

(defun try-grasp (name &rest arguments)
  "(TRY-GRASP NAME [BOX] &KEY KNOWLEDGE GAMMA INDEX): return a plan for BOX, by default what (setq
box ...) gave, in which no rule has run: the grasp NAME, a string or a symbol, was tried in all
matchings that use no constrained face, equivalent ones once.  Other arguments as for PLAN."
  (if (or (null arguments) (keywordp (first arguments)))
      (apply #'try-only name (need-box) arguments)
      (apply #'try-only name arguments)))

(defun try-only (name box &rest arguments)
  (apply #'try-without-rules (list (cons name +all-matchings+)) box arguments))

(defun try-without-rules (tries box &key (knowledge *knowledge*) (gamma *gamma*) (index :paper))
  "Return a plan for BOX in which no rule has run.  TRIES is a list of (NAME . SET): the grasp NAME
was tried in the matchings SET, but for those that use a constrained face, equivalent ones once."
  (with-plain-floats
    (let ((tries (loop for (name . set) in tries collect (cons (need-grasp name knowledge) set)))
          (memory (start-plan box knowledge gamma index)))
      (loop for (grasp . set) in tries do (try-matchings memory grasp set))
      (finish-plan memory knowledge nil
                   (loop for (grasp . set) in tries collect (cons (grasp-name grasp) set))))))

(defun need-grasp (name knowledge)
  "Return the grasp NAME of KNOWLEDGE, or signal a NO-GRASP-ERROR."
  (or (and (name-of name)
           (find-grasp (knowledge-graspbase knowledge) (name-of name)))
      (error 'no-grasp-error :name name :knowledge knowledge)))

(define-condition no-grasp-error (supergrip-error)
  ((name :initarg :name) (knowledge :initarg :knowledge))
  (:report (lambda (condition stream)
             (with-slots (name knowledge) condition
               (let ((known (mapcar #'grasp-name (knowledge-grasps knowledge))))
                 (format stream "there is no grasp ~a~a; grasps are ~a"
                         (form-text (if (name-of name) (make-symbol (name-of name)) name))
                         (suggestion (name-of name) known) (listed known))))))
  (:documentation "A grasp was named that the database lacks."))

(defun new-memory (knowledge)
  "Return a memory for the rules of KNOWLEDGE, whose client is an workspace with its grasps."
  (make-memory (knowledge-rulebase knowledge) (make-workspace (knowledge-graspbase knowledge))))

(defun prepare-memory (memory box knowledge gamma &optional (index (first *indices*)))
  "Make MEMORY, an empty one, ready for a plan for BOX: it holds the preliminary assertions and the
facts of BOX, and its workspace has tried nothing yet.  Return it."
  (start-workspace (memory-client memory) box gamma index)
  (assert-box memory (knowledge-inputs knowledge) box)
  (when (%box-facts box)
    (assert-facts memory box (knowledge-rulebase knowledge)
                  (or (data-file-name (knowledge-rule-file knowledge)) "the rules")))
  memory)

(defun ready-box (box knowledge)
  "Return BOX, or the box that it describes, ready for plans with KNOWLEDGE."
  (let ((box (box-of box)))
    (if (%box-units box)
        (box-for-gripper box (knowledge-graspbase knowledge)
                         (or (data-file-name (gripper-source knowledge)) "the grasp file"))
        box)))

(defun box-at-margin (box margin)
  "Return BOX, or the box that it describes, with MARGIN; with NIL as it is."
  (if margin (box-with-margin (box-of box) margin) (box-of box)))

(defun spare-memory (knowledge)
  "Return an empty memory for the rules of KNOWLEDGE: one that another plan gave back, or a new
one."
  (or (take-from (knowledge-spare knowledge)) (new-memory knowledge)))

(defun start-plan (box knowledge gamma &optional (index :paper))
  "Return a memory ready for a plan for BOX."
  (let ((box (ready-box box knowledge))
        (gamma (check-gamma gamma))
        (index (index-named index)))
    (prepare-memory (spare-memory knowledge) box knowledge gamma index)))

(defun give-back (memory knowledge)
  "Let another plan use MEMORY."
  (clear-memory memory (knowledge-rulebase knowledge))
  (setf (workspace-box (memory-client memory)) nil
        (workspace-best (memory-client memory)) nil)
  (give-to (knowledge-spare knowledge) memory))

(defun best-so-far (memory)
  "Return the best of the candidates that the log of MEMORY, the latest first, holds, or NIL."
  (let ((workspace (memory-client memory)))
    (declare (type workspace workspace))
    (funcall (index-choose (workspace-index workspace)) workspace (memory-log memory))))

(defun finish-plan (memory knowledge stop &optional tries)
  "Return the plan that MEMORY holds, of what TRIES says if no rule has run, and give MEMORY back.
Rules that end without KEEP or CANT keep the best."
  (let ((workspace (memory-client memory)))
    (declare (type workspace workspace))
    (prog1 (%make-plan :box (workspace-box workspace) :knowledge knowledge
                       :gamma (workspace-gamma workspace) :stop stop :tries tries
                       :index (index-name (workspace-index workspace))
                       :best (and (not (and stop (eq (stop-verdict stop) :cant)))
                                  (best-so-far memory))
                       :entries (nreverse (memory-log memory)) :facts (save-facts memory))
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
  ((gamma :initarg :gamma))
  (:report (lambda (condition stream)
             (format stream "gamma is ~a, but must be a number from 0 (forces alone) to 1 ~
                             (velocities alone)" (form-text (slot-value condition 'gamma)))))
  (:documentation "The selection parameter is no number from 0 to 1."))

(defun plan-verdict (&optional (plan (last-plan)))
  "Return :GRASP if PLAN found a grasp, :CANT if the box can't be grasped, :UNFINISHED if the run
stands at a break or a step.  The best grasp of PLAN is then the best so far."
  (cond ((unfinished-p (need-plan plan)) :unfinished)
        ((plan-best plan) :grasp)
        (t :cant)))

(defun plan-candidates (&optional (plan (last-plan)))
  "Return the candidates of PLAN, a new list, in the order in which they were tried."
  (loop for entry in (plan-entries (need-plan plan)) when (candidate-p entry) collect entry))

(defun plan-possible (&optional (plan (last-plan)))
  "Return the possible grasps of PLAN, candidates, the best first; those of equal quality are in the
order in which they were tried."
  ;; STABLE-SORT destroys its list: it gets one that nobody else holds.
  (stable-sort (loop for candidate in (plan-candidates plan)
                     when (possible-p candidate) collect candidate)
               #'> :key #'%candidate-quality))

(defun best-grasps (plan &optional most)
  "Return the possible grasps of PLAN, its best grasp first, the others by quality: at most MOST of
them.  None if the box can't be grasped."
  (let ((best (plan-best plan)))
    (and best
         (let ((grasps (cons best (remove best (plan-possible plan)))))
           (subseq grasps 0 (and most (min most (length grasps))))))))

(defun plan-rejected (&optional (plan (last-plan)))
  "Return the candidates of PLAN that failed, in the order in which they were tried."
  (remove-if #'possible-p (plan-candidates plan)))

(defun plan-assertions (&optional (plan (last-plan)))
  "Return the assertions at the end of PLAN: a list a predicate, its words followed by its lists of
surfaces, all strings."
  (supergrip-chainer:assertions (plan-memory (need-plan plan))
                                (rulebase-predicates (knowledge-rulebase (plan-knowledge plan)))))
