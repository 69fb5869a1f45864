;;;; engines.lisp -- the engine and the reference engine agree on random rules and forms, too.

(in-package :supergrip-test)
(define-suite engines "The engine and the reference engine agree on random rules and forms, too.")

;;; Random rule bases.  They are valid: each predicate keeps its arity, each list holds distinct
;;; surfaces, actions use variables that a clause has, and the last rule remembers everything that
;;; a clause may ask for.

(defparameter *given-predicates*
  '((opposed 2) (small 2) (narrow 2) (large 2) (constrained 1) (slippery 0)))

(defparameter *six-variables* '(s1 s2 s3 s4 s5 s6))
(defparameter *six-faces* '(x1 x2 y1 y2 z1 z2))

(defun random-surfaces (count variables state)
  "Return COUNT distinct surfaces, most of them from VARIABLES, as far as these reach."
  (loop with free = (shuffle variables state) and faces = (shuffle *six-faces* state)
        repeat count
        collect (if (and free (chance 85 state)) (pop free) (pop faces))))

(defun sentence-of (predicate surfaces)
  (destructuring-bind (name arity) predicate
    (cons name (and (plusp arity) (list (subseq surfaces 0 arity))))))

(defun random-clause (predicates state)
  (let* ((predicate (random-element predicates state))
         (sentence (sentence-of predicate
                                (random-surfaces (second predicate) *six-variables* state)))
         (hundredths (random 100 state)))
    (cond ((< hundredths 18) (cons 'not sentence))
          ((< hundredths 35) (list* (first sentence) 'not (rest sentence)))
          (t sentence))))

(defun variables-in (clauses)
  (remove-if-not (lambda (variable)
                   (some (lambda (clause) (member variable (first (last clause)))) clauses))
                 *six-variables*))

(defun list-clauses (clauses)
  "Return those of CLAUSES that end in a list."
  (remove-if-not (lambda (clause) (consp (first (last clause)))) clauses))

(defun random-suggestion (variables state)
  "Return the operands of a TRY after the grasp: nothing, or a matching of which most is open."
  (unless (chance 40 state)
    (list (loop for surface in (random-surfaces 6 variables state)
                collect (if (chance 70 state) '? surface)))))

(defun random-action (predicates variables state)
  (if (chance 70 state)
      (let ((predicate (random-element predicates state)))
        `(remember ,@(sentence-of predicate (random-surfaces 3 variables state))))
      (let ((grasp (random-element (supergrip:knowledge-grasps supergrip:*knowledge*) state)))
        `(try ,(make-symbol (supergrip:grasp-name grasp))
              ,@(random-suggestion variables state)))))

(defun random-rule (number predicates state)
  (let* ((clauses (loop repeat (1+ (random 4 state))
                        collect (random-clause (append *given-predicates* predicates) state)))
         (variables (variables-in (list-clauses clauses))))
    `(rule ,(make-symbol (format nil "R~d" number))
           (if ,@clauses)
           (then ,@(loop repeat (1+ (random 3 state))
                         collect (random-action predicates variables state))
                 ,@(when (chance 4 state) '((cant be done)))
                 ,@(when (chance 4 state) '((keep best)))))))

(defun exchanged (a b tree)
  (sublis (list (cons a b) (cons b a)) tree))

(defun same-after-exchange-p (a b action)
  "True if ACTION remembers the same after the exchange of A and B: lists are unordered."
  (and (eq (first action) 'remember)
       (null (set-exclusive-or (first (last action))
                               (exchanged a b (first (last action)))))))

(defun symmetric-rule (rule state)
  "Return RULE, or a rule made of it that says the same of two of its variables."
  (destructuring-bind (operator name (if . clauses) (then . actions)) rule
    (let ((variables (shuffle (variables-in (list-clauses clauses)) state)))
      (if (or (null (rest variables)) (chance 60 state))
          rule
          (destructuring-bind (a b . rest) variables
            (declare (ignore rest))
            `(,operator ,name
                        (,if ,@(shuffle (remove-duplicates
                                         (append clauses (exchanged a b clauses)) :test #'equal)
                                        state))
                        (,then ,@(remove-if-not (lambda (action)
                                                  (and (consp (first (last action)))
                                                       (same-after-exchange-p a b action)))
                                                actions)
                               (remember both ,(list a b)))))))))

(defun exchanging-rules (knowledge)
  "Return those rules of KNOWLEDGE that have interchangeable variables."
  (remove-if-not (lambda (rule)
                   (supergrip-chainer::interchangeable-pairs
                    (supergrip-chainer:rule-clauses rule) (supergrip-chainer:rule-actions rule)
                    (length (supergrip-chainer:rule-variables rule))))
                 (supergrip:knowledge-rules knowledge)))

(defun random-rules (state)
  "Return the forms of a random rule base."
  (let ((predicates (loop for name in '(p q r tt uu) collect (list name (random 4 state)))))
    (append (loop for number from 1 to (+ 3 (random 8 state))
                  collect (symmetric-rule (random-rule number predicates state) state))
            `((rule ,(make-symbol "LAST")
                    (if (opposed (s1 s2)) (opposed (s3 s4)))
                    (then ,@(loop for predicate in predicates
                                  collect `(remember ,@(sentence-of predicate '(s1 s2 s3))))
                          ,@(when (chance 50 state) '((keep best)))))))))

(defun knowledge-of-rules (rules)
  "Return the knowledge of the forms RULES, written and read again, and the shipped grasps."
  (multiple-value-bind (knowledge problems)
      (supergrip::build-knowledge
       (text-file (with-standard-io-syntax (format nil "~{~:a~%~}" rules)) "rules")
       (supergrip::read-data-file (project-file "grasps.lisp")))
    (is (null (supergrip-data:errors-in problems)) "~s~%~{~a~%~}" rules problems)
    knowledge))

;;; What both know at the end

(defun oracle-assertions (box oracle)
  "Return what the reference engine knows of BOX in the end, as PLAN-ASSERTIONS has it, in no
order of predicates."
  (let ((facts (append (supergrip-oracle::names
                        (supergrip-oracle:oracle-initial-facts box oracle))
                       (mapcar #'rest (getf (supergrip-oracle:oracle-plan box oracle) :log))))
        (assertions '()))
    (dolist (fact facts (reverse assertions))
      (let* ((words (remove-if #'consp fact))
             (entry (find words assertions :key (lambda (entry) (remove-if #'consp entry))
                                           :test #'equal)))
        (if entry
            (nconc entry (remove-if-not #'consp fact))
            (push (copy-list fact) assertions))))))

(defun assertions-differ-p (plan box oracle)
  (set-exclusive-or (supergrip:plan-assertions plan) (oracle-assertions box oracle)
                    :test #'equal))

(defun watched-run-differs-p (box knowledge)
  "True if a run that is watched, which leaves out no binding, remembers or tries anything else."
  (flet ((story (plan)
           (list (log-facts plan)
                 (loop for candidate in (supergrip:plan-candidates plan)
                       collect (supergrip:candidate-grasp candidate)
                       collect (supergrip:candidate-matching candidate)
                       collect (supergrip:candidate-quality candidate)))))
    (not (equal (story (supergrip:plan box :knowledge knowledge))
                (story (supergrip::observed-plan (supergrip:parse-box box) knowledge 0.5d0
                                                 (constantly (constantly nil))))))))

(test both-engines-agree-on-random-rules
  (let ((state (sb-ext:seed-random-state 200))
        (fired 0) (exchanging 0))
    (format t "~&   200 random rule bases, seed 200~%")
    (dotimes (i 200)
      (let* ((rules (random-rules state))
             (knowledge (knowledge-of-rules rules))
             (oracle (supergrip-oracle:with-oracle-rules rules *oracle*))
             (boxes (loop repeat 8 collect (random-box state))))
        (incf exchanging (length (exchanging-rules knowledge)))
        (dolist (box boxes)
          (incf fired (length (log-facts (supergrip:plan box :knowledge knowledge)))))
        (is (null (first-fault
                   (lambda (box)
                     (or (plan-difference box knowledge oracle)
                         (assertions-differ-p (supergrip:plan box :knowledge knowledge)
                                              box oracle)
                         (watched-run-differs-p box knowledge)))
                   boxes))
            "~{~s~%~}" rules)))
    ;; Rules that never fire would agree about nothing.
    (is (> fired 10000) "only ~d facts were remembered" fired)
    (is (> exchanging 200) "only ~d rules have interchangeable variables" exchanging)))

;;; Rules that only try, so that bindings may be left out

(defun trying-rule (number state)
  "Return a rule that only tries, and whose actions see few of its variables."
  (let* ((clauses (cons (random-element '((opposed (s1 s2)) (not narrow (s1 s2)) (large (s2 s1)))
                                        state)
                        (loop repeat (1+ (random 3 state))
                              collect (random-clause *given-predicates* state))))
         (others (set-difference (variables-in (list-clauses clauses)) '(s1 s2)))
         (a1 (if others (random-element (list* '? '? others) state) '?)))
    `(rule ,(make-symbol (format nil "R~d" number))
           (if ,@(shuffle clauses state))
           (then (try ,(random-element '(pinch-3-parallel pinch-2-parallel pinch-3-corner) state)
                      ,(random-element `((s1 s2 ? ? ,a1 ?) (? ? s2 s1 ,a1 ?) (s1 ? s2 ? ? ?)
                                         (s1 ? ? ? ? ,a1))
                                       state))
                 ,@(when (chance 4 state) '((cant be done)))))))

(defun left-out (rule box knowledge)
  "Return how many bindings of RULE a run leaves out that finds it as BOX does in the beginning."
  (let ((memory (supergrip::start-plan box knowledge 0.5d0)))
    (- (length (supergrip-chainer:rule-bindings rule memory))
       (supergrip-chainer::find-bindings (supergrip-chainer::rule-matcher rule) memory))))

(test what-is-left-out-would-have-tried-nothing-new
  (let ((state (sb-ext:seed-random-state 500))
        (left-out 0) (tested 0))
    (format t "~&   100 random rule bases, seed 500~%")
    (dotimes (i 100)
      (let* ((rules (loop for number from 1 to 5 collect (trying-rule number state)))
             (knowledge (knowledge-of-rules rules))
             (oracle (supergrip-oracle:with-oracle-rules rules *oracle*))
             (boxes (loop repeat 6 collect (random-box state))))
        (dolist (rule (supergrip:knowledge-rules knowledge))
          (dolist (box boxes)
            (incf tested)
            (incf left-out (left-out rule box knowledge))))
        (is (null (first-fault (lambda (box)
                                 (or (plan-difference box knowledge oracle)
                                     (watched-run-differs-p box knowledge)))
                               boxes))
            "~{~s~%~}" rules)))
    ;; If nothing were left out, this would say nothing.
    (is (> left-out tested) "only ~d bindings were left out in ~d runs of a rule" left-out tested)))

(test what-is-left-out-would-have-tried-nothing-new-in-exact-mode
  ;; The exact index tells apart what half a turn leaves the same for the paper's.
  (flet ((tried (plan)
           (loop for candidate in (supergrip:plan-candidates plan)
                 collect (supergrip:candidate-grasp candidate)
                 collect (supergrip:candidate-matching candidate))))
    (let ((box (supergrip:parse-box *good-box*)))
      (is (equal (tried (supergrip:plan box :index :exact))
                 (tried (supergrip::observed-plan box supergrip:*knowledge* 0.5d0
                                                  (constantly (constantly nil))
                                                  :index :exact)))))))

(test a-pair-that-no-action-sees-is-of-two-faces
  (let ((knowledge (knowledge-of-rules '((rule one (if (constrained (s1)) (constrained (s2))
                                                       (not narrow (s1 s2)))
                                                   (then (cant be done)))))))
    (loop for (faces reason) in '(((:z2) "NO RULE SUGGESTS A GRASP WHOSE SURFACES ARE FREE")
                                  ((:z2 :x1) "CANT BE DONE: X1, Z2 are constrained"))
          do (is (equal reason (supergrip:plan-reason
                                (supergrip:plan
                                 (substitute `(:constrained ,@faces) :constrained *good-box*
                                             :key #'first)
                                 :knowledge knowledge)))))))

;;; Random facts of one's own

(defparameter *declared* '((fragile 1) (wet 0) (like 2) (trio 3))
  "Predicates that random boxes have facts of.")

(defun input-form (name arity)
  `(input ,name ,@(when (plusp arity) (list (subseq *six-variables* 0 arity)))))

(test both-engines-agree-on-random-facts
  (let ((state (sb-ext:seed-random-state 400))
        (*given-predicates* (append *declared* *declared* *given-predicates*))
        (without 0))
    (format t "~&   60 random rule bases, seed 400~%")
    (dotimes (i 60)
      (let* ((rules (append (loop for (name arity) in *declared* collect (input-form name arity))
                            (random-rules state)))
             (knowledge (knowledge-of-rules rules))
             (oracle (supergrip-oracle:with-oracle-rules rules *oracle*))
             (boxes (loop repeat 6
                          collect (cons (cons 'facts (random-facts *declared* state))
                                        (random-box state)))))
        (is (null (first-fault
                   (lambda (box)
                     (or (plan-difference box knowledge oracle)
                         (assertions-differ-p (supergrip:plan box :knowledge knowledge) box oracle)
                         (watched-run-differs-p box knowledge)))
                   boxes))
            "~{~s~%~}" rules)
        (dolist (box boxes)
          (unless (equal (log-facts (supergrip:plan box :knowledge knowledge))
                         (log-facts (supergrip:plan (rest box) :knowledge knowledge)))
            (incf without)))))
    ;; Facts that change nothing would agree about nothing.
    (is (> without 100) "facts made a difference to ~d plans" without)))

;;; Random grasps.  The reference engine lets Lisp itself compile their forms.

(defun oracle-of-grasps (forms knowledge)
  "Return the reference's knowledge of the grasp FORMS and one rule; or NIL if KNOWLEDGE, the
engine's, has computed a constant and so sees that a turn changes nothing where the reference does
not."
  (let* ((oracle (supergrip-oracle:make-oracle-knowledge :rules *try-g* :grasps forms))
         (turns (length (supergrip::allowed-turns
                         (supergrip::grasp-draft
                          (first (supergrip:knowledge-grasps knowledge))))))
         (others (length (supergrip-oracle::grasp-symmetries
                          (first (supergrip-oracle::knowledge-grasps oracle))))))
    (is (>= turns others))
    (and (= turns others) oracle)))

(test both-engines-agree-on-random-forms
  (let ((state (sb-ext:seed-random-state 300))
        (outcomes '()))
    (format t "~&   200 random grasps, seed 300~%")
    (loop with agreed = 0
          until (= agreed 200)
          do (let* ((forms (random-grasp-forms state))
                    (knowledge (knowledge-of-grasps forms))
                    (boxes (loop repeat 8 collect (random-box state)))
                    (oracle (and (supergrip::knowledge-p knowledge)
                                 (oracle-of-grasps forms knowledge))))
               (when oracle
                 (incf agreed)
                 (dolist (box boxes)
                   (dolist (candidate (supergrip:plan-candidates
                                       (supergrip:plan box :knowledge knowledge)))
                     (incf (getf outcomes (supergrip:candidate-outcome candidate) 0))))
                 (is (null (first-fault (lambda (box) (plan-difference box knowledge oracle))
                                        boxes))
                     "~s ~s"
                     (first-fault (lambda (box) (plan-difference box knowledge oracle)) boxes)
                     forms))))
    ;; Agreement about candidates that all fail at once would say little.
    (loop for outcome in '(:possible :conditions :offset :fingers :open :lifting)
          do (is (> (getf outcomes outcome 0) 20) "~a: ~a" outcome outcomes))))
