;;;; symmetry.lisp -- bindings that have the same effect as another, and can be left out.
;;;;
;;;; Many rules say the same when two of their variables are exchanged, such as (ADJACENT (s1 s2)).
;;;; Then every binding has a twin.  The later of the two changes nothing, so a run leaves it out.
;;;; Where no action sees the last two variables, it is enough to know that they can be bound.

(in-package :supergrip-chainer)

(defvar *interchangeable* '()
  "The pairs of variables, a list of lists, of whose twin bindings one is enough.")

(defvar *unseen* '() "The variables whose faces make no difference to any action.")

(defvar *ascending* '()
  "Those of the variables bound so far that take their faces in ascending order, the latest first.")

(defun interchangeable-p (pair)
  (or (member pair *interchangeable* :test #'equal)
      (member (reverse pair) *interchangeable* :test #'equal)))

(defun interchangeable-pairs (clauses actions count)
  "Return the pairs of COUNT variables whose exchange leaves a rule as it was: its CLAUSES, and what
its ACTIONS do.  Lists of surfaces are unordered."
  (loop for a below count
        append (loop for b from (1+ a) below count
                     when (and (same-clauses-p clauses a b)
                               (every (lambda (action)
                                        (symmetric-action-p (verb-key (action-verb action))
                                                            action a b))
                                      actions))
                       collect (list a b))))

(defun unseen-variables (actions count)
  "Return those of COUNT variables whose faces make no difference to ACTIONS."
  (loop for variable below count
        unless (some (lambda (action)
                       (action-sees-p (verb-key (action-verb action)) action variable))
                     actions)
          collect variable))

(defun same-clauses-p (clauses a b)
  "True if CLAUSES are the same after the variables A and B were exchanged."
  (flet ((key (clause &optional exchange)
           (list* (clause-negated clause) (clause-predicate clause)
                  (sort (sublis exchange (copy-list (clause-terms clause))) #'<))))
    (let ((exchange (list (cons a b) (cons b a))))
      (null (set-exclusive-or (mapcar #'key clauses)
                              (loop for clause in clauses collect (key clause exchange))
                              :test #'equal)))))
