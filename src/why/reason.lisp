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
