;;;; package.lisp -- what SUPER-GRIP exports, by topic.
;;;;
;;;; The packages are locked: a DEFUN of the user's can't replace a function of ours.  A lock also
;;;; forbids LET to bind a symbol macro; so BOX lives in a package that is not locked.

(defpackage :supergrip-words
  (:use)
  (:export #:box)
  (:documentation "The words of SUPER-GRIP that are typed like variables."))

(defpackage :supergrip
  (:use :cl :supergrip-data :supergrip-chainer :supergrip-words)
  (:shadow #:assertions)
  (:import-from :supergrip-statics #:exact-radius #:holds-p #:contact-forces #:wrench-entries
                #:least-squeeze #:least-friction #:sure-radius #:sure #:make-grip #:set-finger
                #:computable-p #:same-contacts-p #:grip-power #:grip-radius #:grip-holds-p
                #:grip-closed-p #:grip-squeeze #:six #:make-six
                #:grip-least-friction #:grip-entry #:grip-entries #:mobility)
  (:implement :supergrip :supergrip-data :supergrip-chainer)
  (:lock t)
  (:documentation "An expert system that chooses the best grasp of a three-fingered gripper on a
rectangular box: rules decide which grasps are worth trying, statics how good each one is.")
  (:export
   ;; the paper's session
   #:box #:forward-chain #:possible-grasps #:*plan*
   #:try #:keep #:assertions #:rules #:grasps #:grasp #:gripper
   ;; asking why
   #:how #:why-not #:explain-best #:requires #:describe-rule #:describe-grasp #:describe-input
   #:describe-gripper
   #:explain-fact #:explain-why-not #:explain-choice #:explain-requirement #:write-answer
   #:derivation #:derivation-p #:derivation-predicate #:derivation-faces #:derivation-rule
   #:derivation-binding #:derivation-parts #:derivation-note
   #:assumption #:unknown-fact #:unknown-fact-refusals
   #:refusal #:refusal-rule #:refusal-fired #:refusal-stop #:refusal-number #:refusal-clause
   #:refusal-bindings #:refusal-blocks
   #:not-chosen #:not-chosen-kind #:not-chosen-text #:not-chosen-grasp #:not-chosen-matching
   #:not-chosen-candidates #:not-chosen-refusals #:not-chosen-outcome #:not-chosen-margin
   #:not-chosen-faces
   #:choice #:choice-sentence #:choice-force #:choice-velocity #:choice-sure
   #:choice-demand #:demand-fits #:demand-surely #:demand-at-most #:demand-weakest #:demand-on
   #:demand-text
   #:demand #:choice-runner-up #:choice-margin
   #:choice-changes #:choice-stepped #:limit #:limit-axis #:limit-has #:limit-needs #:limit-radius
   #:change #:change-words #:change-what #:change-from #:change-to #:change-box #:change-plan
   #:change-limit #:change-size #:change-threshold
   #:requirement #:requirement-kind #:requirement-subject #:requirement-met #:requirement-changes
   #:requirement-faces #:requirement-facts #:requirement-stepped #:requirement-possible
   ;; watching
   #:*trace-level* #:trace-rule #:untrace-rule #:trace-grasp #:untrace-grasp
   #:break-on #:unbreak #:chain-break #:next-rule #:rule-counts
   ;; editing
   #:rule #:edit #:forget #:reload-knowledge #:compare-knowledge
   #:difference #:difference-box #:difference-what #:difference-old #:difference-new
   #:difference-situations
   ;; verifying
   #:verify-knowledge #:verification #:verification-p #:verification-knowledge #:verification-gamma
   #:verification-situations #:verification-kinds #:verification-seed #:verification-several
   #:verification-unseen #:verification-numbers
   #:verification-rules #:verification-findings #:verification-boxes #:verification-all-boxes
   #:rule-use #:rule-use-name #:rule-use-fires #:rule-use-matters
   #:finding #:finding-kind #:finding-rule #:finding-other #:finding-grasp #:finding-situations
   #:finding-boxes #:finding-witness #:finding-more
   ;; boxes
   #:parse-box #:box-name #:box-size #:box-weight #:box-friction #:box-soft-friction
   #:box-constrained #:box-force-needed #:box-velocity-needed #:box-value #:define-box-key
   #:box-facts
   #:box-pose #:box-centre #:box-down #:box-gravity
   ;; knowledge
   #:*knowledge* #:load-knowledge #:knowledge #:knowledge-rules #:knowledge-grasps
   #:declared-inputs #:knowledge-gripper #:knowledge-model #:knowledge-warnings #:knowledge-rulebase
   #:grasp-name #:grasp-form
   ;; plans
   #:plan #:*gamma* #:plan-box #:plan-knowledge #:plan-gamma #:plan-index #:plan-verdict
   #:plan-reason
   #:plan-best #:plan-candidates #:plan-possible #:plan-rejected #:plan-log #:plan-assertions
   #:plan-grasp #:plan-matching #:plan-quality #:plan-stop #:plan-memory #:plan-events
   #:write-transcript
   ;; candidates
   #:candidate #:candidate-grasp #:candidate-matching #:candidate-outcome #:candidate-quality
   #:candidate-force-radius #:candidate-velocity-radius
   #:candidate-force-axis #:candidate-velocity-axis
   #:candidate-offset #:candidate-contacts #:candidate-approach #:candidate-hand #:candidate-world
   #:candidate-wrench #:candidate-spare #:candidate-twist #:candidate-sure #:candidate-failure
   #:candidate-palm #:candidate-load #:candidate-force-need #:candidate-velocity-need
   #:candidate-bound-p #:candidate-exact-radius #:candidate-squeeze #:candidate-fits
   #:candidate-friction-margin
   #:candidate-powers #:motion-text
   #:try-grasp
   ;; refining
   #:refine #:refinement #:refinement-p #:refinement-candidate #:refinement-plan #:refinement-home
   #:refinement-contacts #:refinement-moved-p #:refinement-radius-before #:refinement-radius
   #:refinement-radius-bound #:refinement-radius-nearby #:refinement-quality-before
   #:refinement-quality
   #:refinement-quality-bound #:explain-refinement
   ;; directions
   #:direction-shares #:direction-text
   ;; what contacts can really do
   #:exact-radius #:holds-p #:contact-forces #:wrench-entries #:least-squeeze #:least-friction
   #:sure-radius
   ;; conditions, from the data layer
   #:supergrip-error #:input-error #:input-error-problems #:input-error-consequence #:syntax-error
   #:box-error
   #:knowledge-error #:knowledge-warning #:knowledge-warning-problems #:retry
   #:no-box-error #:no-plan-error #:no-grasp-error #:no-rule-error #:no-fact-error
   #:gamma-error #:argument-error
   ;; names of 0.1.0
   #:explain-refusal #:advise #:advice #:advice-sentence #:advice-force #:advice-velocity
   #:advice-runner-up #:advice-margin #:advice-changes #:derivation-packed
   ;; problems
   #:problem #:problem-severity #:problem-file #:problem-line #:problem-column
   #:problem-subject #:problem-place #:problem-text))

(defpackage :supergrip-user
  (:use :cl :supergrip)
  (:shadow #:setq #:try #:keep #:possible-grasps #:assertions #:rules #:grasps #:grasp #:gripper)
  (:export #:setq #:input)
  (:documentation "A package to type in.  The paper's words have symbols of their own here: the
lists can be typed like variables, and a variable of the user's may have the name of a function."))
