;;;; compare.lisp -- what a change of the knowledge changes, box by box.

(in-package :supergrip)

(defstruct difference
  "A box for which two knowledge bases differ.  WHAT is :VERDICT, :GRASP (or its matching) or
:QUALITY; OLD and NEW are the plans.  Where situations are compared, BOX is the smallest of
SITUATIONS alike, and WHAT is :CANT (whether, and in which words, rules refuse the box), :TRIED
(what they suggest) or :ORDER (of what they suggest)."
  box what old new (situations nil))

(define-printing (difference difference) "~a" (difference-what difference))

(defun plan-difference (old new)
  "Return what of the plans OLD and NEW differs, or NIL."
  (cond ((not (eq (plan-verdict old) (plan-verdict new))) :verdict)
        ((null (plan-best old)) nil)
        ((not (same-choice-p old new)) :grasp)
        ((> (abs (- (plan-quality old) (plan-quality new))) +tie+) :quality)))

(defun box-known-to (knowledge box other)
  "Return BOX without the facts that OTHER declares and KNOWLEDGE does not: no rule of it tests
them."
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

(defun compare-knowledge (old new boxes &key (gamma *gamma*) (index :paper)
                                          (stream *standard-output*))
  "Plan each of BOXES, or the one box, with the knowledge OLD and with NEW; write what differs to
STREAM, or nothing if that is NIL, and return a list of DIFFERENCEs, in the order of BOXES.  A fact
of a box that only one of the two declares is left out for the other.

If BOXES is :SITUATIONS, compare instead what the rules answer in all situations that the rules of
either can tell apart: whether they refuse the box, what they suggest, and in which order.  There
is a DIFFERENCE for each kind of change, with the smallest box that shows it."
  (mapc #'check-knowledge-argument (list old new))
  (cond ((eq boxes :situations)
         (compare-situations old new gamma stream))
        ((or (box-p boxes) (proper-list-p boxes))
         (compare-boxes old new (if (one-box-p boxes) (list boxes) boxes) gamma index stream))
        (t (refuse-argument "~a is not a list of boxes" (form-text boxes)))))

(defun make-plans-difference (box what old new gamma &optional situations (index :paper))
  "Return the DIFFERENCE for BOX between the plans with the knowledge OLD and NEW, or NIL if WHAT, a
function of the two plans, returns that."
  (let* ((old-plan (plan (box-known-to old box new) :knowledge old :gamma gamma :index index))
         (new-plan (plan (box-known-to new box old) :knowledge new :gamma gamma :index index))
         (what (funcall what old-plan new-plan)))
    (and what
         (make-difference :box box :what what :old old-plan :new new-plan
                          :situations situations))))

(defun compare-boxes (old new boxes gamma index stream)
  (let ((differences
          (loop for given in boxes
                for box = (box-of given)
                for difference = (make-plans-difference box #'plan-difference old new gamma
                                                             '() index)
                when difference collect difference)))
    (when stream
      (dolist (difference differences)
        (write-difference difference stream))
      (plainly
        (format stream "~d of ~d box~:*~[es~;~:;es~] ~:[differ~;differs~]: ~d in verdict, ~d in ~
                        grasp, ~d in quality.~%"
                (length differences) (length boxes)
                (member 1 (list (length differences) (length boxes)))
                (count :verdict differences :key #'difference-what)
                (count :grasp differences :key #'difference-what)
                (count :quality differences :key #'difference-what))))
    differences))

(defun compare-situations (old new gamma stream)
  (multiple-value-bind (changes count seed) (with-progress (compare-rules old new))
    (when stream
      (plainly
        (dolist (change changes)
          (format stream "~{~a~^; ~}: ~d situation~:p, as~%  ~a~%" (rule-change-texts change)
                  (rule-change-situations change) (box-text (rule-change-box change))))
        (format stream "The rules answer something else in ~d of ~d situation~:p~@[ that were ~
                        drawn with the seed ~d~].~%"
                (reduce #'+ changes :key #'rule-change-situations) count seed)))
    (loop for change in changes
          collect (make-plans-difference (rule-change-box change)
                                         (constantly (rule-change-what change)) old new gamma
                                         (rule-change-situations change)))))

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
                    (sizes-text (difference-box difference) #'number-text))
                (and new-quality (choice-text new)) new-quality
                (and old-quality (choice-text old)) old-quality)))))
