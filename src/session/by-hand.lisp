;;;; by-hand.lisp -- TRY and KEEP, typed: the paper's lower level without its rules.
;;;;
;;;; What is tried by hand is a plan in which no rule has run.  One more TRY makes a new plan of all
;;;; that was tried, so everything in it is of one box, one knowledge and one gamma.

(in-package :supergrip)

(defun suggested-set (suggestion)
  "Return the set of the matchings that SUGGESTION allows: six faces for N1 N2 O1 O2 A1 A2, ? for
any; NIL allows all."
  (flet ((refuse ()
           (refuse-argument "~a is not a suggested matching: that is six faces, for N1 N2 O1 O2 A1 ~
                             A2, with ? for any, such as (? X2 Y2 Y1 ? Z1)"
                            (form-text suggestion))))
    (let* ((words (and suggestion (or (six-words suggestion) (refuse))))
           (set (matchings-giving (loop for word in words
                                        collect (and (string/= word "?")
                                                     (or (face-index word) (refuse)))))))
      (when (zerop set)
        (refuse-argument "no matching has ~a: N O A must be a proper rotation of X Y Z, N1 ~
                          opposite N2, and so on" (form-text suggestion)))
      set)))

(defun tried-before (box knowledge)
  "Return what was tried by hand on BOX since the last run of rules, as far as KNOWLEDGE has it."
  (and (plan-p *plan*)
       (equalp box (plan-box *plan*))
       (remove-if-not (lambda (name) (find-grasp (knowledge-graspbase knowledge) name))
                      (plan-tries *plan*) :key #'car)))

(defun put-try (grasp set tries box index)
  "Return TRIES on BOX with GRASP in the matchings SET as the last, and no equal of these by INDEX
before it."
  (let ((same (loop with same = (funcall (index-same (index-named index)) grasp box)
                    for matching below (length +matchings+)
                    when (logbitp matching set)
                      collect (aref same matching))))
    (append (loop for (name . earlier) in tries
                  for left = (if (string= name (grasp-name grasp))
                                 (logandc2 earlier (reduce #'logior same))
                                 earlier)
                  unless (zerop left) collect (cons name left))
            (list (cons (grasp-name grasp) set)))))

(defun try (name &rest arguments)
  "(TRY NAME [SUGGESTION] &KEY BOX KNOWLEDGE GAMMA INDEX STREAM): try the grasp NAME on the box,
without rules, in all matchings that use no constrained face, equivalent ones once.  SUGGESTION
leaves only the matchings that have its faces: six for N1 N2 O1 O2 A1 A2, ? for any, as (? X2 Y2 Y1
? Z1).  Print the paper's line for each that is possible, and return the candidates, all that were
tried.

*PLAN* becomes a plan of all that was tried by hand since the last FORWARD-CHAIN or change of the
box; what was tried again is in it once.  BOX is by default what (setq box ...) gave, other keys are
as for FORWARD-CHAIN.  Signals a NO-GRASP-ERROR, a NO-BOX-ERROR or an ARGUMENT-ERROR.

Source: the paper, Low-level System."
  (check-listed arguments 'try name)
  (multiple-value-bind (suggestion keys)
      (if (keywordp (first arguments))
          (values nil arguments)
          (values (first arguments) (rest arguments)))
    (apply #'try-by-hand name suggestion
           (checked-keys keys 'try '(:box :knowledge :gamma :index :stream)
                         "(try 'pinch-3-parallel :gamma 0.3)"))))

(defun try-by-hand (name suggestion &key ((:box given) *box*) (knowledge *knowledge*)
                                      (gamma *gamma*) (index :paper)
                                      (stream *standard-output*))
  "Do what TRY does."
  (let* ((box (ready-box (or given (error 'no-box-error)) (check-knowledge-argument knowledge)))
         (grasp (need-grasp name knowledge))
         (set (suggested-set suggestion))
         (stream (output-stream stream))
         (plan (try-without-rules (put-try grasp set (tried-before box knowledge) box
                                           index)
                                  box :knowledge knowledge :gamma gamma :index index))
         (tried (remove-if-not (lambda (candidate)
                                 (logbitp (matching-index (%candidate-matching candidate)) set))
                               (candidates-of plan grasp))))
    (when stream
      (plainly (write-all-tried grasp tried plan stream)))
    (make-last plan)
    tried))

(defun write-all-tried (grasp tried plan stream)
  "Write TRIED, the candidates of PLAN that trying GRASP gave; if none is possible, why."
  (let ((level (max 1 (check-trace-level *trace-level*))))
    (dolist (candidate tried)
      (write-tried candidate plan level nil stream))
    (when (notany #'candidate-quality tried)
      (let ((miss (and tried (nearest-miss tried plan))))
        (format stream "(~a IS NOT O.K.~@[, NEAREST MATCHING: (~{~a~^ ~})~]: ~a)~%"
                (grasp-name grasp) (and miss (candidate-matching miss))
                (if miss
                    (miss-text miss plan)
                    "EVERY MATCHING ASKED FOR WOULD USE A CONSTRAINED FACE"))))))

(defun keep (what &optional (plan (last-plan)))
  "(KEEP 'BEST): print the paper's closing lines for what was tried in PLAN, by hand or by rules.
Return the best candidate, NIL if none is possible."
  (unless (equal (name-of what) "BEST")
    (refuse-argument "~a can't be kept: only the best can, by (keep 'best)" (form-text what)))
  (plainly (write-verdict (need-plan plan) *standard-output*))
  (plan-best plan))
