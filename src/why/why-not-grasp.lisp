;;;; why-not-grasp.lisp -- why a grasp was not chosen.

(in-package :supergrip)

(defstruct (not-chosen (:include explanation))
  "Why GRASP, in MATCHING or in general (NIL), is not the best of a plan.  KIND is one of
  :CHOSEN       it is the best
  :NO-MATCHING  FACES are no proper rotation
  :CONSTRAINED  CANDIDATES is empty: it would use the constrained FACES
  :EQUIVALENT   the same grasp was tried in the matching of the first of CANDIDATES
  :NOT-TRIED    no rule tried it: REFUSALS says why each that could did not, MORE how many are left
                out; CANDIDATES is what would have come of it
  :FAILED       the first of CANDIDATES failed, OUTCOME and TEXT say at what
  :LOWER        the first of CANDIDATES is possible, but MARGIN below the best
TEXT is a sentence, PLAN the plan."
  plan kind grasp matching (faces '()) (candidates '()) (refusals '()) (more 0) outcome (text "")
  margin)

(defun trying-rules (grasp plan)
  "Return the rules of PLAN that may try GRASP."
  (loop for rule across (rulebase-rules (plan-rulebase plan))
        when (find grasp (rule-actions rule) :key #'action-target)
          collect rule))

(defun six-words (faces)
  "Return the letters of FACES, six names, strings or symbols, or one string of them; else NIL."
  (let* ((faces (spelled faces))
         (words (loop for cell = faces then (cdr cell) ; which may be dotted, or circular
                      repeat 7 while (consp cell) collect (word-text (car cell)))))
    (and (= (length words) 6) (null (nthcdr 6 faces)) (notany #'null words) words)))

(defun check-listed (arguments function name)
  "Signal an ARGUMENT-ERROR if ARGUMENTS, those of FUNCTION after NAME, begin with a face: they go
in a list."
  (let ((faces (loop for argument in arguments
                     for word = (word-text argument)
                     while (and word (or (face-index word) (string= word "?")))
                     repeat 6 collect word)))
    (when faces
      (refuse-argument "the six faces go in one list: (~(~a~) '~a '(~{~a~^ ~}~:[~; ~]~{~a~^ ~}))"
                       function (or (name-of name) (form-text name)) faces
                       (< (length faces) 6)
                       (make-list (- 6 (length faces)) :initial-element "?")))))

(defun parse-matching (faces)
  "Return the matching of FACES, six strings, or NIL."
  (let ((indices (mapcar #'face-index faces)))
    (find-if (lambda (matching) (equal indices (coerce (matching-faces matching) 'list)))
             +matchings+)))

(defun candidate-in (plan grasp matching)
  "Return the candidate of PLAN with GRASP in MATCHING, or NIL."
  (find-if (lambda (candidate) (and (eq grasp (%candidate-grasp candidate))
                                    (eq matching (%candidate-matching candidate))))
           (plan-candidates plan)))

(defun candidates-of (plan grasp)
  (remove grasp (plan-candidates plan) :key #'%candidate-grasp :test-not #'eq))

(defun explain-candidate (candidate plan)
  "Return the NOT-CHOSEN of CANDIDATE, which was tried in PLAN."
  (let ((grasp (%candidate-grasp candidate))
        (matching (%candidate-matching candidate)))
    (cond ((eq candidate (plan-best plan))
           (make-not-chosen :kind :chosen :grasp grasp :matching matching
                            :candidates (list candidate)
                            :text (if (unfinished-p plan)
                                      "it is the best grasp so far"
                                      "it is the best grasp")))
          ((eq (candidate-outcome candidate) :possible) (lower-quality candidate plan))
          (t (multiple-value-bind (outcome text) (candidate-failure candidate plan)
               (make-not-chosen :kind :failed :grasp grasp :matching matching :outcome outcome
                                :candidates (list candidate) :text text))))))

(defun lower-quality (candidate plan)
  (let* ((best (plan-best plan))
         (margin (and best (- (candidate-quality best) (candidate-quality candidate)))))
    (make-not-chosen
     :kind :lower :grasp (%candidate-grasp candidate) :matching (%candidate-matching candidate)
     :candidates (list candidate) :margin margin
     :text (cond ((null best) (format nil "it is possible, but ~a" (plan-reason plan)))
                 ((<= margin +tie+)
                  (format nil "its Q is ~a, as good as that of the best, which was tried before it"
                          (three-decimals (candidate-quality candidate))))
                 (t (format nil "its Q is ~:[~a, ~;at most ~a, at least ~]~a below ~a (~{~a~^ ~})"
                            (candidate-bound-p candidate)
                            (three-decimals (candidate-quality candidate)) (number-text margin)
                            (candidate-grasp best) (candidate-matching best)))))))

(defun used-and-constrained (grasp matching plan)
  "Return the names of the constrained faces that GRASP would use in MATCHING."
  (loop for grasp-face in (grasp-used grasp)
        for face = (svref (matching-faces matching) grasp-face)
        when (logbitp face (%box-constrained (plan-box plan)))
          collect (face-name face)))

(defun refuse-matching (grasp matching plan)
  "Return why GRASP in MATCHING is not the best of PLAN."
  (let ((candidate (candidate-in plan grasp matching))
        (constrained (used-and-constrained grasp matching plan))
        (same (find-if (lambda (other)
                         (logbitp (matching-index (%candidate-matching other))
                                  (same-grasp grasp matching plan)))
                       (candidates-of plan grasp))))
    (cond (candidate (explain-candidate candidate plan))
          (constrained
           (make-not-chosen :kind :constrained :grasp grasp :matching matching :faces constrained
                            :text (format nil "it would use ~{~a~#[~; and ~:;, ~]~}, which ~
                                               ~:[is~;are~] constrained"
                                          constrained (rest constrained))))
          (same
           (make-not-chosen :kind :equivalent :grasp grasp :matching matching
                            :candidates (list same)
                            :text (format nil "the same grasp was tried as (~{~a~^ ~})"
                                          (candidate-matching same))))
          (t (not-tried grasp matching plan)))))

(defun same-grasp (grasp matching plan)
  "Return the set of the matchings in which GRASP is, for the index of PLAN, the same as in
MATCHING."
  (aref (funcall (index-same (index-named (plan-index plan))) grasp (plan-box plan))
        (matching-index matching)))

(defun untried-candidates (grasp matching plan)
  "Return the candidates that trying GRASP, in MATCHING or in all, would have given, the best
first."
  (let* ((alone (try-only grasp (plan-box plan) :knowledge (plan-knowledge plan)
                                                 :gamma (plan-gamma plan)
                                                 :index (plan-index plan)))
         (same (and matching (same-grasp grasp matching plan))))
    (remove-if-not (lambda (candidate)
                     (or (null same)
                         (logbitp (matching-index (%candidate-matching candidate)) same)))
                   (append (plan-possible alone) (plan-rejected alone)))))

(defun not-tried (grasp matching plan)
  "Return why no rule of PLAN tried GRASP in MATCHING, or at all."
  (let* ((rules (trying-rules grasp plan))
         (candidates (untried-candidates grasp matching plan))
         (most (min +most-refusals+ (length rules)))
         (refusals (loop for rule in (subseq rules 0 most) collect (refuse-rule rule plan))))
    (make-not-chosen
     :plan plan :kind (if candidates :not-tried :constrained) :grasp grasp :matching matching
     :candidates candidates
     :refusals refusals :more (- (length rules) most)
     :text (cond ((null candidates) "in every matching it would use a constrained face")
                 ((null rules) "no rule tries it")
                 (matching "no rule tried it in this matching")
                 ((some #'refusal-fired refusals)
                  "what the rules suggest is not a matching, or would use a constrained face")
                 (t "no rule tried it")))))

(defun refuse-grasp (grasp plan)
  "Return why GRASP is not the best of PLAN: about its best candidate, or its nearest miss."
  (let* ((candidates (candidates-of plan grasp))
         (best (find grasp (plan-possible plan) :key #'%candidate-grasp))
         (miss (and candidates (not best) (nearest-miss candidates plan))))
    (cond ((and (plan-best plan) (eq grasp (%candidate-grasp (plan-best plan))))
           (explain-candidate (plan-best plan) plan))
          ((or best miss) (explain-candidate (or best miss) plan))
          (t (not-tried grasp nil plan)))))

(defun explain-why-not (name &optional matching (plan (last-plan)))
  "Return why the rule NAME did not fire in PLAN, a REFUSAL, or why the grasp NAME, in MATCHING (six
faces) if that is given, was not chosen, a NOT-CHOSEN."
  (let* ((plan (need-plan plan))
         (knowledge (plan-knowledge plan))
         (word (name-of name))
         (rule (and word (find-rule (knowledge-rulebase knowledge) word)))
         (grasp (and word (find-grasp (knowledge-graspbase knowledge) word))))
    (plainly
      (cond ((and rule (null matching)) (refuse-rule rule plan))
            ((null grasp)
             (error 'no-rule-error :name name
                                   :hint (and rule "a rule: only a grasp has a matching")
                                   :known (known-names knowledge)))
            ((null matching) (refuse-grasp grasp plan))
            (t (explain-matching grasp matching plan))))))

(defun explain-matching (grasp faces plan)
  "Return why GRASP was not chosen with FACES, which should be six, for N1 N2 O1 O2 A1 A2."
  (let* ((words (six-words faces))
         (matching (and words (parse-matching words))))
    (if matching
        (refuse-matching grasp matching plan)
        (make-not-chosen :kind :no-matching :grasp grasp :faces words
                         :text (if words
                                   (format nil "(~{~a~^ ~}) is not a matching: N O A must be a ~
                                                proper rotation of X Y Z, N1 opposite N2, and so ~
                                                on" words)
                                   (format nil "~a is not a matching: a matching is six faces, for ~
                                                N1 N2 O1 O2 A1 A2" (form-text faces)))))))

(defmethod write-answer ((answer not-chosen) stream)
  (format stream "~a~@[ (~{~a~^ ~})~]: ~a.~%" (grasp-name (not-chosen-grasp answer))
          (and (not-chosen-matching answer) (matching-names (not-chosen-matching answer)))
          (not-chosen-text answer))
  (when (eq (not-chosen-kind answer) :chosen)
    (format stream "Ask (explain-best) why.~%"))
  (when (eq (not-chosen-kind answer) :not-tried)
    (write-refusals (not-chosen-refusals answer) (not-chosen-more answer) stream)
    (let ((candidates (not-chosen-candidates answer)) (plan (not-chosen-plan answer)))
      (write-untried (or (find :possible candidates :key #'candidate-outcome)
                          (nearest-miss candidates plan))
                      plan stream))))

(defun write-untried (candidate plan stream)
  (if (eq (candidate-outcome candidate) :possible)
      (format stream "If tried, it would be possible, with Q~a~a in (~{~a~^ ~}).~%"
              (quality-sign candidate) (three-decimals (candidate-quality candidate))
              (candidate-matching candidate))
      (format stream "If tried, it would fail; nearest in (~{~a~^ ~}): ~a.~%"
              (candidate-matching candidate) (nth-value 1 (candidate-failure candidate plan)))))

(defmethod topic ((explanation not-chosen))
  (grasp-name (not-chosen-grasp explanation)))
