;;;; describe.lisp -- rules and grasps in words.

(in-package :supergrip)

(defun given-predicate (name knowledge)
  "Return the predicate of the words NAME, a string, that the input of KNOWLEDGE may give, or NIL."
  (let ((predicate (find-predicate (knowledge-rulebase knowledge) (list name))))
    (and predicate (predicate-given predicate) predicate)))

(defun find-named (name knowledge kind)
  "Return the rule, grasp or input, as KIND says, NAME of KNOWLEDGE, or signal a NO-RULE-ERROR."
  (let* ((word (name-of name))
         (rule (and word (find-rule (knowledge-rulebase knowledge) word)))
         (grasp (and word (find-grasp (knowledge-graspbase knowledge) word)))
         (input (and word (given-predicate word knowledge))))
    (or (ecase kind (:rule rule) (:grasp grasp) (:input input))
        (error 'no-rule-error :name name
                              :hint (cond (rule "a rule: see DESCRIBE-RULE")
                                          (grasp "a grasp: see DESCRIBE-GRASP")
                                          (input "an input: see DESCRIBE-INPUT"))
                              :known (ecase kind
                                       (:rule (mapcar #'rule-name (knowledge-rules knowledge)))
                                       (:grasp (mapcar #'grasp-name (knowledge-grasps knowledge)))
                                       (:input (known-inputs knowledge)))
                              :kind (if (eq kind :input) "input" "rule or grasp")))))

(defun known-inputs (knowledge)
  "Return the words of all that the input of KNOWLEDGE may give, strings."
  (loop for predicate across (rulebase-predicates (knowledge-rulebase knowledge))
        when (predicate-given predicate) collect (predicate-text predicate)))

(defun write-comment (comment stream)
  "Write COMMENT, the lines before a form: its mark, printed or reconstructed, and the reason."
  (when comment
    (format stream "~{~a~^ ~}~%" comment)))

(defun antecedent-text (clause)
  (let* ((form (clause-form clause))
         (text (sentence-text (predicate-text (clause-predicate clause)) (find-if #'consp form))))
    (if (clause-negated clause) (format nil "nothing says that ~a" text) text)))

(defun testers (predicate knowledge)
  "Return the names of the rules that test PREDICATE."
  (loop for rule in (knowledge-rules knowledge)
        when (find predicate (rule-clauses rule) :key #'clause-predicate)
          collect (rule-name rule)))

(defun given-text (predicate)
  "Return who gives PREDICATE, which the input may give."
  (if (declared-p predicate)
      (format nil "the box, as ~a declares"
              (full-text (input-declaration-form (predicate-given predicate))))
      "the input"))

(defun sources (predicate knowledge)
  "Return who provides PREDICATE: names of rules, and \"the input\"."
  (append (and (predicate-given predicate) (list (given-text predicate)))
          (loop for rule in (knowledge-rules knowledge)
                when (find predicate (rule-actions rule) :key #'action-predicate)
                  collect (rule-name rule))))

(defun describe-rule (name &key (knowledge *knowledge*) (stream *standard-output*))
  "Write the rule NAME to STREAM: its form, in words, where it is from, who derives what it tests,
and who tests what it derives.  Returns the rule."
  (let ((rule (find-named name knowledge :rule)))
    (plainly
      (write-rule-form rule stream)
      (write-comment (rule-comment rule) stream)
      (format stream "In words: if ~{~a~^, and ~}, then ~{~a~^; then ~}.~%"
              (mapcar #'antecedent-text (rule-clauses rule))
              (loop for action in (rule-actions rule)
                    collect (describe-action (verb-key (action-verb action)) action)))
      (dolist (predicate (remove-duplicates (mapcar #'clause-predicate (rule-clauses rule))
                                            :from-end t))
        (format stream "~a comes from ~a.~%" (predicate-text predicate)
                (listed (or (sources predicate knowledge) '("nobody")))))
      (dolist (predicate (remove nil (mapcar #'action-predicate (rule-actions rule))))
        (format stream "~a is tested by ~a.~%" (predicate-text predicate)
                (listed (or (testers predicate knowledge) '("no rule"))))))
    rule))

(defun write-rule-form (rule stream)
  (destructuring-bind (rule-word name (if-word . clauses) (then-word . actions)) (rule-form rule)
    (declare (ignore rule-word if-word then-word))
    (format stream "(RULE ~a~%  (IF ~{~a~^~%      ~})~%  (THEN ~{~a~^~%        ~}))~%" name
            (mapcar #'full-text clauses) (mapcar #'full-text actions))))

(defun full-text (form) (form-text form nil))

(defun describe-input (name &key (knowledge *knowledge*) (stream *standard-output*))
  "Write the input whose words are NAME to STREAM: its declaration, where that is from, and which
rules test it.  A preliminary assertion has a threshold in the place of a declaration.  Returns the
predicate of the input."
  (let* ((predicate (find-named name knowledge :input))
         (words (predicate-text predicate))
         (surfaces (loop for number from 1 to (predicate-arity predicate)
                         collect (format nil "S~d" number)))
         (input (find predicate (knowledge-inputs knowledge) :key #'prepared-input-predicate)))
    (plainly
      (cond ((declared-p predicate)
             (format stream "~a~%" (full-text (input-declaration-form (predicate-given predicate))))
             (write-comment (input-declaration-comment (predicate-given predicate)) stream)
             (format stream "In words: a box may say that ~a.  What it does not say is false.~%"
                     (sentence-text words surfaces)))
            (t (format stream "~a~@[ (~{~a~^ ~})~] is a preliminary assertion~@[; its threshold is ~
                               ~a~].~%" words surfaces (threshold-text words input))))
      (format stream "It is tested by ~a.~%"
              (listed (or (testers predicate knowledge) '("no rule")))))
    predicate))

(defun threshold-text (words input)
  "Return the threshold of the prepared INPUT, \"FINGER-WIDTH, 0.6\", or NIL if it has none.  INPUT
is NIL if the gripper lacks that of the assertion WORDS."
  (let ((name (input-row-dimension (if input
                                       (prepared-input-row input)
                                       (find words *inputs* :key #'input-row-name
                                             :test #'string=)))))
    (cond (input (and name
                      (format nil "~a, ~a" name (number-text (prepared-input-threshold input)))))
          (t (format nil "~a, which the gripper lacks, so it never holds" name)))))

(defun dimension-users (name knowledge)
  "Return the rules and grasps of KNOWLEDGE that use the gripper's dimension NAME."
  (remove-duplicates (loop for use in (knowledge-uses knowledge)
                           when (string= name (dimension-use-dimension use))
                             collect (dimension-use-user use))
                     :test #'string= :from-end t))

(defun describe-gripper (&key (knowledge *knowledge*) (stream *standard-output*))
  "Write the gripper of KNOWLEDGE to STREAM: its model, where it is from, its dimensions, and which
rules and grasps use each.  Returns its dimensions, an alist from name to double."
  (let ((knowledge (check-knowledge-argument knowledge)))
    (plainly
      (format stream "~:[This gripper~;~:*~a~]~@[ is from ~a~].~%"
              (and (knowledge-model knowledge) (visible-text (knowledge-model knowledge)))
              (data-file-name (gripper-source knowledge)))
      (loop for (name . number) in (knowledge-gripper knowledge)
            for (nil nil meaning part) = (assoc name
                                                (graspbase-rows (knowledge-graspbase knowledge))
                                                :test #'string=)
            for users = (append (dimension-users name knowledge) (and part (list part)))
            do (format stream "~a ~a~@[ ~a~].~%  Used by ~a.~%" name (number-text number) meaning
                       (listed (or users '("no rule and no grasp"))))))
    (knowledge-gripper knowledge)))

(defun describe-grasp (name &key (knowledge *knowledge*) (stream *standard-output*))
  "Write the grasp NAME to STREAM: its form, in words, where it is from, and which rules try it.
Returns the grasp."
  (let ((grasp (find-named name knowledge :grasp)))
    (plainly
      (write-grasp-form grasp stream)
      (write-comment (draft-comment (grasp-draft grasp)) stream)
      (write-derived (draft-derived (grasp-draft grasp)) stream)
      (format stream "In words: ~{~a on ~a~^, ~}; the palm over ~a; ~{~a~^ ~} must be free.~%"
              (fingers-on grasp (lambda (grasp-face) (svref +grasp-faces+ grasp-face)))
              (svref +grasp-faces+ (grasp-palm grasp))
              (mapcar (lambda (grasp-face) (svref +grasp-faces+ grasp-face)) (grasp-used grasp)))
      (format stream "It is tried by ~a.~%"
              (listed (or (loop for rule in (knowledge-rules knowledge)
                                when (find grasp (rule-actions rule) :key #'action-target)
                                  collect (rule-name rule))
                          '("no rule")))))
    grasp))

(defun write-derived (parts stream)
  "Write to STREAM what was derived for a grasp, PARTS: lists of a key and a form, and sentences."
  (dolist (part parts)
    (cond ((consp part)
           (format stream "Derived: ~a " (first part))
           (write-filled (second part) (+ 10 (length (first part))) stream))
          (t (write-string part stream)))
    (terpri stream)))

(defun write-grasp-form (grasp stream)
  (format stream "(SETQ ~a~%  '(" (grasp-name grasp))
  (loop for (key value . rest) on (second (third (grasp-form grasp))) by #'cddr
        do (format stream "~a " key)
           (write-filled value (+ 5 (length (symbol-name key))) stream)
           (when rest (format stream "~%    ")))
  (format stream "))~%"))

(defparameter +line-width+ 96 "How wide the lines of a form are, where its parts allow it.")

(defun write-filled (form column stream)
  "Write FORM to STREAM from COLUMN, in several lines if one does not hold it.  Returns the column
after it."
  (let ((text (full-text form)))
    (cond ((or (atom form) (<= (+ column (length text)) +line-width+))
           (write-string text stream)
           (+ column (length text)))
          ((part-p form "QUOTE")
           (write-string "'" stream)
           (write-filled (second form) (1+ column) stream))
          (t (write-string "(" stream)
             (let ((place (1+ column)))
               (loop for (part . rest) on form
                     do (setf place (write-filled part place stream))
                        (when rest
                          (cond ((<= (+ place 1 (length (full-text (first rest)))) +line-width+)
                                 (write-string " " stream)
                                 (incf place))
                                (t (format stream "~%~vt" (1+ column))
                                   (setf place (1+ column))))))
               (write-string ")" stream)
               (1+ place))))))
