;;;; changes.lisp -- in which situations two rule bases give different answers.

(in-package :supergrip)

(defstruct (rule-change (:constructor make-rule-change (what texts)))
  "A kind of change.  WHAT is as ANSWER-DIFFERENCE has it, TEXTS say what is different,
SITUATIONS in how many situations it is; BOX is the smallest that shows it."
  what texts (situations 0) (box nil))

(defun renumbered (answer knowledge names)
  "Return ANSWER, of the rules of KNOWLEDGE, with the place of its name in NAMES for the number
of each grasp."
  (let ((places (loop for grasp in (knowledge-grasps knowledge)
                      collect (position (grasp-name grasp) names :test #'string=)))
        (tried (make-array (length names) :element-type '(unsigned-byte 24) :initial-element 0)))
    (loop for place in places
          for set across (answer-tried answer)
          do (setf (aref tried place) set))
    (make-answer :cant (answer-cant answer) :tried tried
                 :order (loop for (grasp . matching) in (answer-order answer)
                              collect (cons (nth grasp places) matching)))))

;;; The comparison

(defun note-change (changes what old new names box)
  "Note in CHANGES, a table, that the answers OLD and NEW for BOX differ as WHAT says."
  (let* ((texts (change-texts what old new names))
         (change (or (gethash texts changes)
                     (setf (gethash texts changes) (make-rule-change what texts)))))
    (incf (rule-change-situations change))
    (when (or (null (rule-change-box change)) (plainer-p box (rule-change-box change)))
      (setf (rule-change-box change) box))))

(defun both-answers (old new names)
  "Return a function of a box that returns the answers of the rules of OLD and of NEW, with the
numbers of the grasps NAMES."
  (flet ((answerer (knowledge)
           (let ((runner (make-runner knowledge))
                 (own (mapcar #'grasp-name (knowledge-grasps knowledge))))
             (lambda (box)
               (let ((answer (run-runner runner box)))
                 (if (equal own names) answer (renumbered answer knowledge names)))))))
    (let ((old-answer (answerer old)) (new-answer (answerer new)))
      (lambda (box)
        (values (funcall old-answer box) (funcall new-answer box))))))

(defun compare-rules (old new)
  "Return the RULE-CHANGEs from the knowledge OLD to NEW, over all situations that the rules of
either can tell apart, the most frequent first of each kind; how many situations there are; and
the seed with which they were drawn, if there were too many, or NIL."
  (with-plain-floats
    (let* ((domain (make-domain old new))
           (names (remove-duplicates (mapcar #'grasp-name (append (knowledge-grasps old)
                                                                  (knowledge-grasps new)))
                                     :test #'string= :from-end t))
           (answers (both-answers old new names))
           (changes (make-hash-table :test #'equal))
           (indices (distinct-indices domain)))
      (loop for index being the hash-values of indices
            for done from 1
            for box = (index-box domain index)
            do (when (zerop (mod done 1000))
                 (note-progress "situations" done (hash-table-count indices)))
               (multiple-value-bind (old-answer new-answer) (funcall answers box)
                 (let ((what (answer-difference old-answer new-answer)))
                   (when what
                     (note-change changes what old-answer new-answer names box)))))
      (values (stable-sort (loop for change being the hash-values of changes collect change)
                           (lambda (a b)
                             (let ((kinds '(:cant :tried :order)))
                               (or (< (position (rule-change-what a) kinds)
                                      (position (rule-change-what b) kinds))
                                   (and (eq (rule-change-what a) (rule-change-what b))
                                        (> (rule-change-situations a)
                                           (rule-change-situations b)))))))
              (hash-table-count indices)
              (and (domain-sampled domain) *situation-seed*)))))
