;;;; compare.lisp -- what a change of the knowledge changes, box by box.

(in-package :supergrip)

(defstruct difference
  "A box for which two knowledge bases differ.  WHAT is :VERDICT, :GRASP (or its matching) or
:QUALITY; OLD and NEW are the plans."
  box what old new)

(define-printing (difference difference) "~a" (difference-what difference))

(defun plan-difference (old new)
  "Return what of the plans OLD and NEW differs, or NIL."
  (cond ((not (eq (plan-verdict old) (plan-verdict new))) :verdict)
        ((null (plan-best old)) nil)
        ((not (same-choice-p old new)) :grasp)
        ((> (abs (- (plan-quality old) (plan-quality new))) +tie+) :quality)))

(defun box-known-to (knowledge box other)
  "Return BOX without the facts that OTHER declares and KNOWLEDGE does not: no rule of it tests them."
  (flet ((declared-p (fact knowledge) (fact-predicate fact (knowledge-rulebase knowledge))))
    (let ((facts (remove-if (lambda (fact)
                              (and (declared-p fact other) (not (declared-p fact knowledge))))
                            (%box-facts box))))
      (if (equal facts (%box-facts box))
          box
          (box-with box (find-key :facts) facts)))))

(defun one-box-p (object)
  "True if OBJECT is a box, or describes one, and is no list of boxes."
  (or (and object (atom object))
      (namep (first object))            ; (SETQ BOX '...), '...
      (some (lambda (clause) (and (consp clause) (namep (first clause)) (key-named (first clause))))
            object)))

(defun compare-knowledge (old new boxes &key (gamma *gamma*) (stream *standard-output*))
  "Plan each of BOXES, or the one box, with the knowledge OLD and with NEW; write what differs to
STREAM (NIL: do not) and return a list of DIFFERENCEs, in the order of BOXES.  A fact of a box that
only one of the two declares is left out for the other."
  (mapc #'check-knowledge-argument (list old new))
  (unless (or (box-p boxes) (proper-list-p boxes))
    (refuse-argument "~a is not a list of boxes" (form-text boxes)))
  (let* ((boxes (if (one-box-p boxes) (list boxes) boxes))
         (differences
          (loop for given in boxes
                for box = (if (box-p given) given (parse-box given))
                for old-plan = (plan (box-known-to old box new) :knowledge old :gamma gamma)
                for new-plan = (plan (box-known-to new box old) :knowledge new :gamma gamma)
                for what = (plan-difference old-plan new-plan)
                when what
                  collect (make-difference :box box :what what
                                           :old old-plan :new new-plan))))
    (when stream
      (dolist (difference differences)
        (write-difference difference stream))
      (plainly
        (format stream "~d of ~d boxes differ: ~d in verdict, ~d in grasp, ~d in quality.~%"
                (length differences) (length boxes)
                (count :verdict differences :key #'difference-what)
                (count :grasp differences :key #'difference-what)
                (count :quality differences :key #'difference-what))))
    differences))

(defun quality-texts (old new)
  "Return the qualities OLD and NEW, NIL for none, with three decimals, or more if that shows no
difference."
  (let ((texts (loop for quality in (list old new)
                     collect (and quality (three-decimals quality)))))
    (if (and old new (/= old new) (string= (first texts) (second texts)))
        (number-texts old new)
        texts)))

(defun write-difference (difference stream)
  (let ((old (difference-old difference)) (new (difference-new difference)))
    (destructuring-bind (old-quality new-quality)
        (quality-texts (plan-quality old) (plan-quality new))
      (plainly
        (format stream "~a: ~:[can't~*~;~:*~a Q=~a~], was ~:[can't~*~;~:*~a Q=~a~]~%"
                (or (box-name (difference-box difference))
                    (format nil "~{~a~^ x ~} cm"
                            (mapcar #'number-text (box-size (difference-box difference)))))
                (and new-quality (choice-text new)) new-quality
                (and old-quality (choice-text old)) old-quality)))))
