;;;; plan.lisp -- a plan is a value: asking it changes nothing; a grasp that passes holds its box.

(in-package :supergrip-test)
(define-suite plan
  "A plan is a value: asking it changes nothing; a grasp that passes holds its box.")

(defun readers-of (prefix)
  "Return the exported functions whose names begin with PREFIX, sorted."
  (let ((readers '()))
    (do-external-symbols (symbol :supergrip (sort readers #'string<))
      (when (and (fboundp symbol) (not (macro-function symbol))
                 (not (member symbol '(supergrip:box-value           ; they want
                                       supergrip:candidate-powers))) ; something more
                 (not (typep (fdefinition symbol) 'generic-function))
                 (eql 0 (search prefix (symbol-name symbol))))
        (push symbol readers)))))

(defun ask (reader object plan)
  "Return the answer of READER about OBJECT, of PLAN if it wants that as well."
  (if (member reader '(supergrip:candidate-exact-radius supergrip:candidate-squeeze
                       supergrip:candidate-friction-margin supergrip:candidate-contacts
                       supergrip:candidate-hand supergrip:candidate-world
                       supergrip:candidate-wrench supergrip:candidate-twist
                       supergrip:candidate-sure supergrip:candidate-spare
                       supergrip:candidate-fits supergrip:candidate-failure
                       supergrip:candidate-load supergrip:candidate-force-need
                       supergrip:candidate-velocity-need))
      (funcall reader object plan)
      (funcall reader object)))

(defun reader-answers (plan)
  "Return a list of (READER . TEXT) for every exported reader of PLAN, its box, its knowledge and
its candidates."
  (flet ((texts (prefix object)
           (loop for reader in (readers-of prefix)
                 collect (cons reader (prin1-to-string (ask reader object plan))))))
    (append (texts "PLAN-" plan)
            (texts "BOX-" (supergrip:plan-box plan))
            (texts "KNOWLEDGE-" (supergrip:plan-knowledge plan))
            (list (cons 'supergrip:possible-grasps
                        (prin1-to-string (supergrip:possible-grasps plan))))
            (loop for grasp in (supergrip:knowledge-grasps (supergrip:plan-knowledge plan))
                  append (texts "GRASP-" grasp))
            (loop for candidate in (supergrip:plan-candidates plan)
                  append (texts "CANDIDATE-" candidate)))))

(defun destroy (object)
  "Destroy OBJECT, if it is a list, and the lists in it."
  (loop while (consp object)
        do (destroy (car object))
           (setf (car object) nil)
           (shiftf object (cdr object) nil)))

(defun spoil (plan)
  "Destroy every list that a reader of PLAN returns, as a caller may who sorts it."
  (flet ((spoil-answers (prefix object)
           (dolist (reader (readers-of prefix))
             (destroy (ask reader object plan)))))
    (let ((candidates (supergrip:plan-candidates plan)))
      (dolist (grasp (supergrip:knowledge-grasps (supergrip:plan-knowledge plan)))
        (spoil-answers "GRASP-" grasp))
      (spoil-answers "PLAN-" plan)
      (spoil-answers "BOX-" (supergrip:plan-box plan))
      (spoil-answers "KNOWLEDGE-" (supergrip:plan-knowledge plan))
      (fill (supergrip:possible-grasps plan) nil)
      (dolist (candidate candidates)
        (spoil-answers "CANDIDATE-" candidate)))))

(test asking-a-plan-changes-nothing
  (let ((supergrip:*knowledge* (supergrip:load-knowledge)))
    (flet ((check (plan)
             (let ((first (reader-answers plan)))
               (is (equal first (reader-answers plan)))
               (spoil plan)
               (is (equal first (reader-answers plan))))))
      (check (supergrip:plan (paper-box)))
      (check (supergrip:try-grasp "PINCH-3-PARALLEL" (paper-box)))
      (check (supergrip:plan (append *good-box*
                                     '((:pose (1 2 3) (0.6d0 0 0 0.8d0)) (:centre 1 0 0)))))
      (for-random-boxes (box 100 271828)
        (check (supergrip:plan box))))))

;;; What is read does not change

(defun structures-in (object seen)
  "Put OBJECT, if it is a structure, and all structures in its slots, lists and vectors into the
table SEEN.  Return it."
  (typecase object
    (structure-object
     (unless (gethash object seen)
       (setf (gethash object seen) t)
       (dolist (slot (sb-mop:class-slots (class-of object)))
         (structures-in (slot-value object (sb-mop:slot-definition-name slot)) seen))))
    (cons (structures-in (car object) seen)
     (structures-in (cdr object) seen))
    (simple-vector (map nil (lambda (element) (structures-in element seen)) object)))
  seen)

(defun writable-slots (class-name)
  "Return the names of those slots of the structures CLASS-NAME that SETF can set."
  (loop for slot in (sb-kernel:dd-slots (sb-kernel:find-defstruct-description class-name))
        unless (sb-kernel:dsd-read-only slot) collect (sb-kernel:dsd-name slot)))

(test knowledge-is-read-only
  (let ((kinds '()))
    (loop for part in (list (supergrip::knowledge-rulebase supergrip:*knowledge*)
                            (supergrip::knowledge-graspbase supergrip:*knowledge*)
                            (supergrip::knowledge-inputs supergrip:*knowledge*)
                            (supergrip:plan-box (supergrip:plan (paper-box))))
          do (loop for structure being the hash-keys of (structures-in part (make-hash-table))
                   unless (hash-table-p structure) ; the predicates, by their words
                     do (pushnew (type-of structure) kinds)))
    (is (subsetp '(supergrip-chainer:rulebase supergrip-chainer:rule supergrip-chainer::clause
                   supergrip-chainer:action supergrip-chainer:predicate supergrip::grasp
                   supergrip::program supergrip::node supergrip::box)
                 kinds)
        "~s" kinds)
    (dolist (kind kinds)
      (is (null (writable-slots kind)) "~a: ~a" kind (writable-slots kind)))
    (is (equal '(supergrip::spare) (mapcar (lambda (name) (intern (string name) :supergrip))
                                           (writable-slots 'supergrip::knowledge))))
    (signals error
      (eval `(setf (supergrip-chainer:rule-name
                    ,(aref (supergrip-chainer:rulebase-rules
                            (supergrip::knowledge-rulebase supergrip:*knowledge*))
                           0))
                   "X")))))

;;; Lifting

(test the-axes-share-what-holds-the-weight
  (let* ((plan (supergrip:plan '((size 12 2 2) (weight 0.75) (u 0.8) (v 0.2) (constrained z2 x1)
                                  (force-needed (1 0 0 0 0 0)) (velocity-needed (0 0 0 0 0 0)))))
         (heavy (find :lifting (supergrip:plan-candidates plan)
                      :key #'supergrip:candidate-outcome)))
    (is (not (null heavy)))
    (when heavy
      (let* ((wrench (supergrip:candidate-wrench heavy plan))
             (offset (supergrip:candidate-offset heavy))
             (load (list 0 0 0.75 (* 0.75 (abs (second offset))) (* 0.75 (abs (first offset))) 0)))
        (is (every #'<= load wrench) "~a ~a" load wrench)
        (is (> (reduce #'+ (mapcar #'/ load wrench)) 1))
        (is (search "together" (nth-value 1 (supergrip:candidate-failure heavy plan))))))))

(test what-is-possible-bears-its-load
  (for-random-boxes (box 1000 161803)
    (let ((plan (supergrip:plan box)))
      (dolist (candidate (supergrip:plan-possible plan))
        (destructuring-bind (x y z) (supergrip:candidate-offset candidate)
          (declare (ignore z))
          (let* ((weight (first (box-part box 'weight)))
                 (load (list 0 0 weight (* weight (abs y)) (* weight (abs x)) 0)))
            (unless (<= (reduce #'+ (mapcar #'/ load (supergrip:candidate-wrench candidate plan)))
                        (+ 1 1d-12))
              (fail "~a of ~a drops the box" candidate box)))))))
  (pass))
