;;;; sessions.lisp -- the pencil session and its parts, ready to be measured; and what must be
;;;; equal before anything is.

(in-package :supergrip-bench)

(defparameter *pencil*
  '((size 12 2 2) (weight 0.2d0) (u 0.8d0) (v 0.2d0) (constrained z2 x1)
    (force-needed (1 0.8d0 0.8d0 0.3d0 1 1)) (velocity-needed (0 0.8d0 0.8d0 0 0.8d0 0.8d0)))
  "The box of the paper's session.")

(defvar *box* (supergrip:parse-box *pencil*))

(defun project-file (name)
  (asdf:system-relative-pathname "supergrip" name))

;;; The rule part: the shipped rules with PASS, which notes its binding in the log, for TRY

(supergrip-chainer:define-action :pass (action client)
  (let ((number (supergrip-chainer:action-number action)))
    (supergrip-chainer:finish-action
     action
     (lambda (memory rule binding)
       (supergrip-chainer:log-event memory rule number binding)
       nil)
     :terms (supergrip::parse-suggestion (rest (supergrip-chainer:action-operands action)) action))))

(defmethod supergrip-chainer:action-sees-p ((verb (eql :pass)) action variable)
  (supergrip-chainer:action-sees-p :try action variable))

(defun without-try (rule)
  "Return the form RULE with PASS in the place of TRY."
  (destructuring-bind (operator name antecedent (then . actions)) rule
    (list operator name antecedent
          (cons then (loop for (verb . operands) in actions
                           collect (cons (if (string= verb "TRY") 'pass verb) operands))))))

(defun rules-alone (forms)
  "Return the rule base of the rule FORMS without TRY."
  (supergrip-chainer:build-rulebase (mapcar #'without-try forms) (supergrip::input-predicates)))

(defun shipped-rules ()
  (supergrip::data-file-forms (supergrip::read-data-file (project-file "rules.lisp"))))

(defun rules-function (rulebase)
  "Return a function of a box that runs RULEBASE on it as PLAN does, in a memory that is used again,
and returns the verdict and the log, the newest event first."
  (let ((inputs (supergrip::prepare-inputs
                 rulebase (supergrip::knowledge-graspbase supergrip:*knowledge*)))
        (memory (supergrip-chainer:make-memory rulebase)))
    (lambda (box)
      (supergrip-chainer:clear-memory memory rulebase)
      (supergrip::assert-box memory inputs box)
      (let ((stop (supergrip-chainer:run-rules rulebase memory)))
        (values (and stop (supergrip-chainer:stop-verdict stop))
                (supergrip-chainer:memory-log memory))))))

;;; The TRY part, and one form

(defun try-function (plan)
  "Return a function that tries the candidates of PLAN again."
  (let* ((workspace (supergrip::make-workspace
                   (supergrip::knowledge-graspbase (supergrip:plan-knowledge plan))))
         (tries (loop for candidate in (supergrip:plan-candidates plan)
                      collect (cons (supergrip::%candidate-grasp candidate)
                                    (supergrip::%candidate-matching candidate)))))
    (lambda ()
      (supergrip::start-workspace workspace (supergrip:plan-box plan) 0.5d0)
      (loop for (grasp . matching) in tries
            do (supergrip::try-matching workspace grasp matching)))))

(defun form-function (plan)
  "Return a function that evaluates the WRENCH of the first candidate of PLAN."
  (let* ((candidate (first (supergrip:plan-candidates plan)))
         (workspace (supergrip::start-workspace
                   (supergrip::make-workspace
                    (supergrip::knowledge-graspbase (supergrip:plan-knowledge plan)))
                   (supergrip:plan-box plan) 0.5d0))
         (registers (supergrip::workspace-registers (supergrip::replay candidate workspace)))
         (program (supergrip::grasp-wrench (supergrip::%candidate-grasp candidate))))
    (lambda () (supergrip::execute program registers))))

;;; The reference engine, of the tests

(defvar *oracle*
  (supergrip-oracle:load-oracle-knowledge (project-file "rules.lisp")
                                          (project-file "grasps.lisp")))

(defun oracle-rules-function ()
  "Return a function that runs the rules of the reference engine on the pencil, TRY left out."
  (let ((rules (supergrip-oracle::knowledge-rules *oracle*)))
    (lambda ()
      (supergrip-oracle:oracle-run-rules
       rules (supergrip-oracle:oracle-initial-facts *pencil* *oracle*) (constantly nil)))))

;;; What must be equal

(defun check-floor ()
  "Signal an error unless the floor gives the six qualities of the session."
  (let ((ours (mapcar #'supergrip:candidate-quality
                      (supergrip:plan-candidates (supergrip:plan *box*))))
        (floor (coerce (pencil-qualities (box-task *box*) (new-six)) 'list)))
    (unless (and (= 6 (length ours))
                 (every (lambda (a b) (< (abs (- a b)) 1d-12)) ours floor))
      (error "the floor gives ~a, the plan ~a" floor ours))))

(defun check-bits (boxes)
  "Signal an error unless the bit code gives the log of the rules on all BOXES."
  (let ((rules (rules-function (rules-alone (shipped-rules)))))
    (dolist (box boxes)
      (unless (equal (multiple-value-list (bit-rules box))
                     (multiple-value-list (funcall rules box)))
        (error "the bit code and the rules differ on ~a" box)))))
