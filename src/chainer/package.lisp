;;;; package.lisp -- the upper level: a forward chainer over sentences about the faces of a box.

(defpackage :supergrip-chainer
  (:use :cl :supergrip-data)
  (:lock t)
  (:documentation "An s-expression forward chainer: ordered rules, each run once; negation under
the closed-world assumption; predicates of unordered lists of surfaces; actions attached through
one generic function.")
  (:export
   ;; faces
   #:+faces+ #:face #:face-index #:face-name #:opposite #:face-axis #:face-sign
   #:face-list #:make-face-list #:face-list-mask #:face-list-ref #:face-list-with
   #:face-list-count #:face-list-elements #:face-list-names
   ;; predicates and working memory
   #:predicate #:predicate-words #:predicate-arity #:predicate-index #:predicate-text
   #:predicate-given #:declared-p #:input-declaration-form #:input-declaration-comment #:input-line
   #:memory #:make-memory #:clear-memory #:memory-client #:memory-log
   #:recall #:remember #:put-fact #:facts #:assertions #:saved-facts #:save-facts #:restore-facts
   ;; declarations and rules
   #:input-form-p #:input-words
   #:rule #:rule-name #:rule-form #:rule-index #:rule-clauses #:rule-actions #:rule-variables
   #:rule-comment
   #:clause #:clause-negated #:clause-predicate #:clause-terms #:clause-form
   #:action #:action-verb #:action-form #:action-predicate #:action-terms #:action-target
   #:action-function #:action-operands #:action-number
   #:rulebase #:build-rulebase #:rulebase-rules #:rulebase-predicates
   #:find-rule #:find-predicate
   ;; actions
   #:define-action #:finish-action #:compile-action #:action-verbs #:verb-key #:action-conclusion
   #:action-mentions
   #:action-sees-p #:symmetric-action-p #:describe-action #:sentence-text
   #:loose-surface-p #:list-surfaces #:parse-surfaces #:parse-sentence #:negation-p
   #:term-variable-p #:term-value #:instantiate
   ;; running
   #:run-rules #:stop #:stop-verdict #:stop-rule #:stop-words #:make-stop
   #:rule-bindings #:prefix-bindings #:run-observed #:run-in-order #:rule-met-p
   #:met-clauses #:binding-text #:check-rules #:tested-sentences
   #:log-event #:event-rule #:event-binding #:event-fact
   ;; names of 0.1.0
   #:+surfaces+ #:surface #:surface-index #:surface-name #:surface-axis #:surface-sign
   #:pack #:pack-mask #:pack-count #:pack-elements #:pack-names))
