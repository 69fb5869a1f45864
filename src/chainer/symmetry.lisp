;;;; symmetry.lisp -- bindings that have the same effect as another, and can be left out.
;;;;
;;;; Many rules say the same when two of their variables are exchanged, such as (ADJACENT (s1 s2)).
;;;; Then every binding has a twin.  The later of the two changes nothing, so a run leaves it out.

(in-package :supergrip-chainer)

(defvar *interchangeable* '()
  "The pairs of variables, a list of lists, of whose twin bindings one is enough.")

(defvar *ascending* '()
  "Those of the variables bound so far that take their faces in ascending order, the latest first.")

(defun interchangeable-p (pair)
  (or (member pair *interchangeable* :test #'equal)
      (member (reverse pair) *interchangeable* :test #'equal)))

(defun interchangeable-pairs (rule)
  "Return the pairs of variables whose exchange leaves RULE as it was: its clauses, and what its
actions do.  Lists of surfaces are unordered."
  (let ((variables (loop for place below (length (rule-variables rule)) collect place)))
    (loop for (a . others) on variables
          append (loop for b in others
                       when (and (same-clauses-p rule a b)
                                 (every (lambda (action)
                                          (symmetric-action-p (verb-key (action-verb action))
                                                              action a b))
                                        (rule-actions rule)))
                         collect (list a b)))))

(defun same-clauses-p (rule a b)
  (flet ((key (clause) (list* (clause-negated clause) (clause-predicate clause)
                              (sort (copy-list (clause-terms clause)) #'<)))
         (exchanged (clause)
           (let ((other (copy-clause clause)))
             (setf (clause-terms other) (sublis (list (cons a b) (cons b a)) (clause-terms clause)))
             other)))
    (let ((clauses (rule-clauses rule)))
      (null (set-exclusive-or (mapcar #'key clauses)
                              (mapcar (lambda (clause) (key (exchanged clause))) clauses)
                              :test #'equal)))))
