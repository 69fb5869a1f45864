;;;; remedy.lisp -- what lets a box pass the rule that refused it.
;;;;
;;;; What is said is tried: the rules run again, up to that rule, for the box with the change.

(in-package :supergrip)

(defun let-pass-p (rule box plan)
  "True if neither RULE, which ended PLAN, nor one before it refuses BOX.  Rules after it are not
run."
  (let* ((knowledge (plan-knowledge plan))
         (rules (subseq (knowledge-rules knowledge) 0 (1+ (rule-index rule)))))
    (with-plain-floats
      (let* ((memory (start-plan box knowledge (plan-gamma plan)))
             (stop (run-in-order rules memory
                                 (lambda (rule action binding)
                                   (funcall (action-function action) memory rule binding)))))
        (give-back memory knowledge)
        (not (and stop (eq (stop-verdict stop) :cant)))))))

;;; Of what the rule went by

(defun just-beyond (threshold up)
  "Return a number a little above THRESHOLD, from 0, if UP; else a little below it."
  (cond ((plusp threshold) (* threshold (if up (+ 1 1d-9) (- 1 1d-9))))
        (up 1d-9)
        (t threshold)))

(defun beside (threshold now)
  "Return THRESHOLD and what is just beyond it, seen from NOW; what is beyond on both sides, if the
two are equal.  Lists of a number, the words before and after it, and whether it is to be rounded
up."
  (flet ((beyond (up)
           (list (just-beyond threshold up) (if up "more than " "less than ") "" up)))
    (cond ((= now threshold) (list (beyond t) (beyond nil)))
          ((< now threshold) (list (list threshold "" " or more" t) (beyond t)))
          (t (list (list threshold "" " or less" nil) (beyond nil))))))

(defun value-remedy (rule plan row index name threshold)
  "Return in words to what the value of the key ROW, at INDEX, called NAME, must change past
THRESHOLD so that RULE lets the box of PLAN pass; NIL if that does not help."
  (let* ((box (plan-box plan)) (measure (box-key-measure row)))
    (loop for (value before after up) in (beside threshold (value-at box row index))
          when (and (plusp value) (let-pass-p rule (box-with-at box row index value) plan))
            return (words name " of " before
                          (with-unit (number-text-rounded (in-units threshold measure) up) measure)
                          after))))

(defun leaf-remedy (leaf rule plan)
  "Return in words how the value that LEAF tells of would have to change so that RULE lets the box
of PLAN pass; NIL if that alone does not help."
  (let* ((input (prepared-row (derivation-predicate leaf) plan))
         (kind (and input (value-kind input)))
         (faces (derivation-face-list leaf)))
    (flet ((value-remedy (key index name)
             (value-remedy rule plan (find-key key) index name (prepared-input-threshold input))))
      (ecase kind
        (:size (let ((axis (face-axis (face-list-ref faces 0))))
                 (value-remedy :size axis (string (char "XYZ" axis)))))
        (:u (value-remedy :u 0 "u"))
        ((nil) nil)))))

(defun face-remedy (faces rule plan)
  "Return in words which of FACES, names of constrained ones, would have to be free so that RULE
lets the box of PLAN pass: those that help alone, or else all; NIL if not even that helps."
  (let* ((box (plan-box plan)) (now (%box-constrained box)))
    (flet ((help-p (names)
             (let ((set (reduce #'logior names :key (lambda (name) (ash 1 (face-index name))))))
               (let-pass-p rule (box-with box (find-key :constrained) (logandc2 now set)) plan))))
      (let ((helping (loop for name in faces when (help-p (list name)) collect name)))
        (cond ((rest helping) (words "one of " (joined ", " helping) " free"))
              (helping (words (first helping) " free"))
              ((and (rest faces) (help-p faces)) (words "all of " (joined ", " faces) " free")))))))

(defun refusal-remedies (rule plan)
  "Return what lets the box of PLAN pass RULE, which ended it, each in words: changes of what the
rule went by."
  (let ((*units* (%box-units (plan-box plan))))
    (multiple-value-bind (leaves faces) (refusal-parts rule plan)
      (remove nil (append (loop for leaf in leaves repeat +most-leaves+
                                collect (leaf-remedy leaf rule plan))
                          (and faces (list (face-remedy faces rule plan))))))))

;;; Of all that rules can see

(defun value-kind (input)
  "Return the key of the values that INPUT, a prepared preliminary assertion, compares with a
dimension, :SIZE or :U; NIL if it does not, or is not known."
  (let* ((row (prepared-input-row input)) (dimension (input-row-dimension row)))
    (cond ((null dimension) nil)
          ((= 2 (input-row-arity row)) :size)
          ((string= "SLIPPERY" (input-row-name row)) :u))))

(defun known-input-p (input)
  "True if INPUT, prepared, is one of which it is known on what of the box it depends."
  (or (value-kind input)
      (member (input-row-name (prepared-input-row input)) '("OPPOSED" "CONSTRAINED")
              :test #'string=)))

(defun boxes-with-a-value (plan)
  "Return boxes as that of PLAN with another size along one axis, or another friction: all that
differ for its rules."
  (loop for input in (knowledge-inputs (plan-knowledge plan))
        for threshold = (prepared-input-threshold input)
        for key = (value-kind input)
        when key
          append (loop for index below (if (eq key :size) 3 1)
                       append (loop for value in (list (just-beyond threshold nil) threshold
                                                       (just-beyond threshold t))
                                    when (plusp value)
                                      collect (box-with-at (plan-box plan) (find-key key) index
                                                           value)))))

(defun boxes-with-a-face (plan)
  "Return boxes as that of PLAN with one face constrained that was free, or free that was not."
  (let ((box (plan-box plan)))
    (loop for face below 6
          collect (box-with box (find-key :constrained)
                            (logxor (%box-constrained box) (ash 1 face))))))

(defun face-lists (count)
  "Return the lists of COUNT faces, each set of them once."
  (loop for mask below 64
        when (= count (logcount mask))
          collect (make-face-list (loop for face below 6 when (logbitp face mask) collect face))))

(defun boxes-with-a-fact (plan)
  "Return boxes as that of PLAN that say one fact of their own more, or one less."
  (let* ((box (plan-box plan)) (facts (%box-facts box)) (row (find-key :facts))
         (rulebase (knowledge-rulebase (plan-knowledge plan))))
    (append (loop for fact in facts collect (box-with box row (remove fact facts)))
            (loop for predicate in (coerce (rulebase-predicates rulebase) 'list)
                  when (declared-p predicate)
                    append (loop for faces in (face-lists (predicate-arity predicate))
                                 collect (box-with box row
                                                   (cons (make-box-fact (predicate-text predicate)
                                                                        faces nil)
                                                         facts)))))))

(defun no-single-change-p (rule plan)
  "True if no single change of the box of PLAN lets it pass RULE, which ended PLAN; NIL if one does,
or that is not known."
  (and (every #'known-input-p (knowledge-inputs (plan-knowledge plan)))
       (loop for boxes in (list (boxes-with-a-value plan) (boxes-with-a-face plan)
                                (boxes-with-a-fact plan))
             never (some (lambda (box) (let-pass-p rule box plan)) boxes))))

(defun remedy-sentence (plan)
  "Return in a sentence what lets the box of PLAN pass the rule that refused it; NIL if no rule did,
or that is not known."
  (let ((stop (plan-stop plan)))
    (when (and stop (eq (stop-verdict stop) :cant))
      (let ((remedies (refusal-remedies (stop-rule stop) plan)))
        (cond (remedies
               (plain-text "It would pass that rule with ~{~a~^, or ~}" remedies))
              ((no-single-change-p (stop-rule stop) plan)
               "No single change lets it pass that rule"))))))
