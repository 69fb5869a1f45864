;;;; reason.lisp -- why a box can't be grasped: what a rule said and the figures behind it, or the
;;;; nearest miss.

(in-package :supergrip)

;;; What a rule that refused the box went by: facts that the box itself gives

(defun prepared-row (predicate plan)
  "Return the prepared preliminary assertion of PREDICATE in PLAN, or NIL."
  (find predicate (knowledge-inputs (plan-knowledge plan)) :key #'prepared-input-predicate))

(defun constrained-p (predicate)
  (equal '("CONSTRAINED") (predicate-words predicate)))

(defun telling-p (derivation plan)
  "True if DERIVATION, of a fact that the box gives, tells more than that faces are opposite."
  (let ((input (prepared-row (derivation-predicate derivation) plan)))
    (or (null input) (constrained-p (derivation-predicate derivation))
        (input-row-dimension (prepared-input-row input)))))

(defun leaves (derivation plan)
  "Return the derivations of what the box gives that DERIVATION follows from, those that tell
something."
  (cond ((assumption-p derivation) '())
        ((derivation-rule derivation)
         (loop for part in (derivation-parts derivation) append (leaves part plan)))
        ((telling-p derivation plan) (list derivation))))

(defun block-leaves (predicate memory plan)
  "Return what of the box keeps all rules of PLAN from saying PREDICATE, as far as facts stand in
their way; MEMORY holds what was known."
  (loop for rule in (deriving-rules predicate plan)
        for refusal = (failing-clause rule memory plan (constantly t))
        when refusal
          append (loop for block in (refusal-blocks refusal) append (leaves block plan))))

(defun clause-leaves (clause rule binding table memory plan)
  "Return the derivations of what of the box met CLAUSE of RULE under BINDING."
  (if (clause-negated clause)
      (and (null (prepared-row (clause-predicate clause) plan))
           (block-leaves (clause-predicate clause) memory plan))
      (leaves (clause-part clause rule binding table memory plan) plan)))

(defun same-leaf-p (a b)
  (and (eq (derivation-predicate a) (derivation-predicate b))
       (= (face-list-mask (derivation-face-list a)) (face-list-mask (derivation-face-list b)))))

(defun stop-leaves (rule plan)
  "Return the derivations of what of the box let RULE fire, which ended PLAN, each once."
  (let ((memory (plan-memory plan)) (table (derivations plan)) (seen '()) (leaves '()))
    (dolist (binding (rule-bindings rule memory))
      (dolist (clause (rule-clauses rule))
        (let ((key (fact-key (clause-predicate clause)
                             (instantiate (clause-terms clause) binding))))
          ;; Most bindings go by the same facts.
          (unless (member key seen)
            (push key seen)
            (dolist (leaf (clause-leaves clause rule binding table memory plan))
              (pushnew leaf leaves :test #'same-leaf-p))))))
    (nreverse leaves)))

;;; In words.  Where many boxes are refused, FORMAT would take most of the time.

(defun words (&rest texts)
  "Return TEXTS in one string."
  (apply #'concatenate 'string texts))

(defun joined (between texts)
  "Return TEXTS in one string, with BETWEEN between them."
  (apply #'words (loop for (text . more) on texts collect text when more collect between)))

(defun leaf-faces (leaf)
  "Return the names of the faces of LEAF, in order."
  (sort (copy-list (face-list-names (derivation-face-list leaf))) #'string<))

(defun leaf-text (leaf)
  "Return in words what the box gives, of which LEAF is the derivation."
  (let* ((predicate (derivation-predicate leaf)) (note (derivation-note leaf))
         (faces (leaf-faces leaf)))
    (cond ((eql 0 (search "they are " note))
           (words (first faces) " and " (second faces) " " (subseq note (length "they "))))
          ((string= note "the box says so")
           (words "the box says " (fact-text predicate (derivation-face-list leaf))))
          ((null faces) note)
          (t (words (fact-text predicate (derivation-face-list leaf)) ": " note)))))

(defun blocked-text (faces)
  "Return in words that FACES, names, are constrained."
  (words (joined ", " faces) (if (rest faces) " are constrained" " is constrained")))

;;; What would have to change

(defun let-pass-p (rule box plan)
  "True if RULE, which ended PLAN, does not end a run for BOX.  Rules after it are not run."
  (let* ((knowledge (plan-knowledge plan))
         (rules (subseq (knowledge-rules knowledge) 0 (1+ (rule-index rule)))))
    (with-plain-floats
      (let* ((memory (start-plan box knowledge (plan-gamma plan)))
             (stop (run-in-order rules memory
                                 (lambda (rule action binding)
                                   (funcall (action-function action) memory rule binding)))))
        (give-back memory knowledge)
        (not (and stop (eq (stop-rule stop) rule)))))))

(defun beside (threshold now)
  "Return THRESHOLD and what is just beyond it, seen from NOW: lists, each with the words before
and after the number."
  (let ((up (<= now threshold)))
    (list (list threshold "" (if up " or more" " or less"))
          (list (* threshold (if up (+ 1 1d-9) (- 1 1d-9))) (if up "more than " "less than ") ""))))

(defun value-remedy (rule plan row index name threshold)
  "Return in words to what the value of the key ROW, at INDEX, called NAME, must change past
THRESHOLD so that RULE lets the box of PLAN pass; NIL if that does not help."
  (let* ((box (plan-box plan)) (measure (box-key-measure row)))
    (loop for (value before after) in (beside threshold (value-at box row index))
          when (and (plusp value) (let-pass-p rule (box-with-at box row index value) plan))
            return (words name " of " before
                          (with-unit (number-text (in-units threshold measure)) measure) after))))

(defun leaf-remedy (leaf rule plan)
  "Return in words how the value that LEAF tells of would have to change so that RULE lets the box
of PLAN pass; NIL if that alone does not help.  The second value is true if that is not known."
  (let* ((input (prepared-row (derivation-predicate leaf) plan))
         (dimension (and input (input-row-dimension (prepared-input-row input))))
         (faces (derivation-face-list leaf)))
    (flet ((value-remedy (key index name)
             (value-remedy rule plan (find-key key) index name (prepared-input-threshold input))))
      (cond ((null dimension) (values nil t))
            ((= 2 (input-row-arity (prepared-input-row input)))
             (let ((axis (face-axis (face-list-ref faces 0))))
               (value-remedy :size axis (string (char "XYZ" axis)))))
            ((string= "SLIPPERY-U" dimension) (value-remedy :u 0 "u"))
            (t (values nil t))))))

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

(defparameter +most-leaves+ 4
  "Of how many things of the box a reason tells, constrained faces apart.")

(defun refusal-parts (rule plan)
  "Return what RULE, which ended PLAN, went by: derivations of what the box gives, and the names of
faces that are constrained."
  (let* ((leaves (stop-leaves rule plan))
         (others (remove-if #'constrained-p leaves :key #'derivation-predicate)))
    (values others
            (sort (loop for leaf in leaves
                        unless (member leaf others) append (leaf-faces leaf))
                  #'string<))))

(defun refusal-figures (rule plan)
  "Return the figures of the box of PLAN that RULE, which ended it, went by, in words; NIL if it
went by none."
  (let ((*units* (%box-units (plan-box plan))))
    (multiple-value-bind (leaves faces) (refusal-parts rule plan)
      (and (or leaves faces)
           (joined "; " (append (loop for leaf in leaves repeat +most-leaves+
                                      collect (leaf-text leaf))
                                (and (nthcdr +most-leaves+ leaves)
                                     (list (plain-text "~d more of the kind"
                                                       (- (length leaves) +most-leaves+))))
                                (and faces (list (blocked-text faces)))))))))

(defun refusal-remedies (rule plan)
  "Return the single changes with which RULE, which ended PLAN, lets the box pass, each in words.
The second value is true if there may be others."
  (let ((*units* (%box-units (plan-box plan))))
    (multiple-value-bind (leaves faces) (refusal-parts rule plan)
      (let ((open (nthcdr +most-leaves+ leaves)) (remedies '()))
        (loop for leaf in leaves repeat +most-leaves+
              do (multiple-value-bind (remedy unknown) (leaf-remedy leaf rule plan)
                   (when remedy (push remedy remedies))
                   (when unknown (setf open t))))
        (let ((free (and faces (face-remedy faces rule plan))))
          (when free (push free remedies)))
        (values (nreverse remedies) (or open (and (null leaves) (null faces))))))))

(defun remedy-sentence (plan)
  "Return in a sentence which single change lets the box of PLAN pass the rule that refused it; NIL
if no rule did, or that is not known."
  (let ((stop (plan-stop plan)))
    (when (and stop (eq (stop-verdict stop) :cant))
      (multiple-value-bind (remedies open) (refusal-remedies (stop-rule stop) plan)
        (cond (remedies (plain-text "To pass that rule it takes ~{~a~^, or ~}" remedies))
              (open nil)
              (t "To pass that rule it takes more than one change"))))))

;;; The reason

(defun plan-reason (&optional (plan (last-plan)))
  "Return why the box of PLAN can't be grasped, a string: what the rule said, with the figures
that it went by, or the nearest miss.  NIL if it can."
  (let* ((stop (plan-stop (need-plan plan)))
         (said (and stop (eq (stop-verdict stop) :cant)))
         (miss (and (not said) (not (plan-best plan)) (nearest-miss (plan-candidates plan) plan))))
    (cond ((plan-best plan) nil)
          ((unfinished-p plan) "THE RUN IS NOT OVER")
          (said (plainly
                  (let ((figures (refusal-figures (stop-rule stop) plan)))
                    (if figures (words (stop-text stop) ": " figures) (stop-text stop)))))
          (miss (plain-text "NO GRASP IS POSSIBLE, NEAREST MISS: ~a (~{~a~^ ~}): ~a"
                            (candidate-grasp miss) (candidate-matching miss)
                            (plainly (miss-text miss plan))))
          ((plan-tries plan) "WHAT WAS TRIED WOULD USE A CONSTRAINED FACE")
          (t "NO RULE SUGGESTS A GRASP WHOSE SURFACES ARE FREE"))))

(defun short-reason (plan)
  "Return why the box of PLAN can't be grasped, without the figures of a rule that refused it."
  (let ((stop (plan-stop plan)))
    (if (and stop (eq (stop-verdict stop) :cant)) (stop-text stop) (plan-reason plan))))

(defmethod print-object ((plan plan) stream)
  (print-unreadable-object (plan stream :type t)
    (plainly
      (if (plan-best plan)
          (format stream "~a (~{~a~^ ~}) Q=~,3f" (plan-grasp plan) (plan-matching plan)
                  (plan-quality plan))
          (format stream "~:[can't: ~;~]~a" (unfinished-p plan) (short-reason plan))))))
