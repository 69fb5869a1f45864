;;;; package.lisp -- what SUPER-GRIP exports, by topic.

(defpackage :supergrip
  (:use :cl :supergrip-data :supergrip-chainer)
  (:documentation "An expert system that chooses the best grasp of a three-fingered gripper on a
rectangular box: rules decide which grasps are worth trying, statics how good each one is.")
  (:export
   ;; the paper's session
   #:box #:forward-chain #:possible-grasps #:*plan*
   ;; boxes
   #:parse-box #:box-name #:box-size #:box-weight #:box-friction #:box-soft-friction
   #:box-constrained #:box-force-needed #:box-velocity-needed
   ;; knowledge
   #:*knowledge* #:load-knowledge #:knowledge #:knowledge-rules #:knowledge-grasps
   #:knowledge-gripper #:knowledge-warnings
   ;; plans
   #:plan #:*gamma* #:plan-box #:plan-knowledge #:plan-gamma #:plan-verdict #:plan-reason
   #:plan-best #:plan-candidates #:plan-possible #:plan-rejected #:plan-log #:plan-assertions
   #:plan-grasp #:plan-matching #:plan-quality
   #:write-transcript
   ;; candidates
   #:candidate #:candidate-grasp #:candidate-matching #:candidate-outcome #:candidate-quality
   #:candidate-force-radius #:candidate-velocity-radius
   #:candidate-force-axis #:candidate-velocity-axis
   #:candidate-offset #:candidate-contacts #:candidate-approach
   #:candidate-wrench #:candidate-twist #:candidate-failure
   #:try-grasp
   ;; conditions, from the data layer
   #:supergrip-error #:input-error #:input-error-problems #:syntax-error #:box-error
   #:knowledge-error #:retry #:no-box-error #:no-plan-error #:no-grasp-error #:gamma-error
   #:problem #:problem-severity #:problem-file #:problem-line #:problem-column
   #:problem-subject #:problem-place #:problem-text))

(defpackage :supergrip-user
  (:use :cl :supergrip)
  (:documentation "A package to type in."))
