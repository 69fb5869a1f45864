;;;; verify.lisp -- VERIFY-KNOWLEDGE: what is proved of the rules, what was found by a search,
;;;; and the report.

(in-package :supergrip)

(defstruct (verification (:include explanation))
  "What is known of KNOWLEDGE.  Its rules can tell SITUATIONS situations apart.  KINDS is how many
these are if those that a rotation of the box turns into one another count once.  SEED is NIL, or
the seed with which situations were drawn because there were too many.  SEVERAL names the assertions
that depend on more than one number of the box, so that their situations were searched, too.  UNSEEN
names those that were true of no box that was looked at.  RULES is a list of RULE-USEs, in order;
FINDINGS is a list of FINDINGs.  BOXES were searched, of ALL-BOXES that there are, with GAMMA.
NUMBERS is an alist from the keys of a box to the numbers that were searched."
  knowledge gamma situations kinds seed (several '()) (unseen '()) (rules '()) (findings '())
  boxes all-boxes (numbers '()))

(defmethod topic ((explanation verification))
  (format nil "~d situation~:p, ~d finding~:p" (verification-situations explanation)
          (length (verification-findings explanation))))

(defun silent-findings (situations)
  "Return that the rules suggest nothing in some of SITUATIONS, a list of one finding or none."
  (let ((silent (remove-if-not #'silent-p situations)))
    (and silent (list (situations-finding :silent silent)))))

(defun prove-rules (runner situations)
  "Return the RULE-USEs of the rules of RUNNER in SITUATIONS, and the findings about them."
  (judge runner situations)
  (let ((uses (loop for rule in (runner-rules runner)
                    collect (use-of rule runner situations))))
    (values uses (append (rule-findings uses runner situations)
                         (order-findings runner situations)
                         (silent-findings situations)))))

(defun verify (knowledge gamma)
  "Return the VERIFICATION of KNOWLEDGE; qualities are those of GAMMA."
  (with-plain-floats
    (let ((domain (make-domain knowledge))
          (runner (make-runner knowledge)))
      (multiple-value-bind (situations count) (find-situations domain)
        (multiple-value-bind (uses proved) (prove-rules runner situations)
          (multiple-value-bind (found boxes all) (search-grasps knowledge domain situations gamma)
            (make-verification
             :knowledge knowledge :gamma gamma :situations count :kinds (length situations)
             :seed (and (domain-sampled domain) *situation-seed*)
             :several (several-numbers (domain-quantities domain))
             :unseen (unseen-inputs domain)
             :numbers (all-searched domain knowledge)
             :rules uses :findings (append proved found) :boxes boxes :all-boxes all)))))))

;;; In words

(defparameter +finding-kinds+
  '((:never "Rules that never fire:"
     "~a: clause ~*~*~d never holds together with those before it"
     "Every rule fires in some situation.")
    (:shadowed "Rules that never fire, since an earlier rule has always ended the run:"
     "~a: ~a")
    (:subsumed "Rules that can be left out, since another does all that they do whenever they fire:"
     "~a: ~a")
    (:redundant "Rules that can be left out, since that changes no answer:"
     "~a~@[; but then not also ~a~]"
     "No rule can be left out without a change of some answer.")
    (:order "Rules that must come after others: just before them, they change answers:"
     "~a after ~a; else ~*~a")
    (:silent "The rules suggest nothing that is free, and do not refuse the box either:"
     "nothing is tried"
     "Where the rules do not refuse the box, they suggest something that is free.")
    (:nothing-suggested "A grasp is possible, but the rules suggest none:"
     "~*~*~a"
     "Where the rules suggest nothing, no grasp was possible.")
    (:all-fail "A grasp is possible, but all that the rules suggest fails:"
     "~*~*~a"
     "Where a grasp was possible, not all that the rules suggest failed.")
    (:worse "A grasp is better than the best that the rules suggest:"
     "~*~a is chosen, ~a is better, by a Q of ~a at most"
     "No grasp was better than the best that the rules suggest.")
    (:refused "A rule refuses the box, but a grasp is possible:"
     "~a refuses it, ~*~a is possible"
     "Where a rule refuses the box, no grasp was possible.")
    (:vain "A rule suggests a grasp that is possible for no box of the situation:"
     "~a suggests ~*~a"
     "What a rule suggests was possible for some box of each situation."))
  "For each kind of finding a heading; a control for a line, of rule, other, grasp, and a figure;
and what is said if there are none.  Those from :NOTHING-SUGGESTED on are searched.")

(defparameter +searched-kinds+
  (mapcar #'first (member :nothing-suggested +finding-kinds+ :key #'first))
  "The kinds of finding that are searched, not proved.")

(defun finding-text (finding)
  "Return what FINDING says, without how often."
  (let ((more (finding-more finding)) (other (finding-other finding)))
    (format nil (third (assoc (finding-kind finding) +finding-kinds+))
            (finding-rule finding)
            (if (listp other) (and other (listed other)) other)
            (finding-grasp finding)
            (or (getf more :clause) (getf more :how)
                (and (getf more :loss) (number-text (getf more :loss)))))))

(defun witness-number (box witnesses)
  "Return the number of BOX in WITNESSES, a table from texts to numbers, after it is entered there."
  (let ((text (box-text box)))
    (or (gethash text witnesses)
        (setf (gethash text witnesses) (1+ (hash-table-count witnesses))))))

(defun write-finding (finding witnesses stream)
  (let* ((witness (finding-witness finding))
         (worst (getf (finding-more finding) :worst))
         (boxes (finding-boxes finding)))
    (format stream "  ~a: ~d situation~:p" (finding-text finding) (finding-situations finding))
    (when boxes
      (format stream ", ~d box~:[es~;~]" boxes (= boxes 1)))
    (when witness
      (format stream ", see box ~d" (witness-number witness witnesses)))
    (when (and worst (not (eq worst witness)))
      (format stream "; for the most see box ~d" (witness-number worst witnesses)))
    (terpri stream)))

(defun write-kind (kind findings witnesses stream)
  "Write those of FINDINGS that are of KIND, a row, the most frequent first."
  (destructuring-bind (key heading line &optional none) kind
    (declare (ignore line))
    (let ((own (remove key findings :key #'finding-kind :test-not #'eq)))
      (cond (own
             (format stream "~a~%" heading)
             (dolist (finding (if (member key +searched-kinds+)
                                  (stable-sort (copy-list own) #'> :key #'finding-situations)
                                  own))
               (write-finding finding witnesses stream)))
            (none (format stream "~a~%" none))))))

(defun write-kinds (verification searched witnesses stream)
  "Write the findings that are SEARCHED, or those that are not."
  (loop for kind in +finding-kinds+
        when (eq searched (not (null (member (first kind) +searched-kinds+))))
          do (write-kind kind (verification-findings verification) witnesses stream)))

(defun write-rule-uses (uses stream)
  (let ((width (reduce #'max uses :key (lambda (use) (length (rule-use-name use)))
                                  :initial-value 4)))
    (format stream "  ~va ~10@a ~20@a~%" width "rule" "fires in" "changes the answer in")
    (dolist (use uses)
      (format stream "  ~va ~10d ~20d~%" width (rule-use-name use) (rule-use-fires use)
              (rule-use-matters use)))))

(defun write-extent (verification stream)
  "Write for how many situations what is said of the rules is true."
  (let ((situations (verification-situations verification))
        (seed (verification-seed verification)))
    (if seed
        (format stream "The rules alone.  They can tell more than ~d situations apart.  What ~
                        follows is true of ~d that were drawn with the seed ~d; nothing is ~
                        proved.~%"
                *situation-limit* situations seed)
        (format stream "The rules alone.  They can tell ~d situation~:p apart, ~d up to the ~
                        rotations of the box.  What follows is proved for all of them.~%"
                situations (verification-kinds verification))))
  (when (verification-several verification)
    (format stream "Situations were searched where ~a depends on several numbers of the box.~%"
            (listed (verification-several verification))))
  (when (verification-unseen verification)
    (format stream "No box was found of which ~{~a~^ or ~} is true: of such boxes nothing is ~
                    proved.~%"
            (verification-unseen verification))))

(defun write-search (verification stream)
  "Write for how many boxes what is said of the grasps is true."
  (let ((boxes (verification-boxes verification)) (all (verification-all-boxes verification)))
    (format stream "~%Rules and grasps.  Every grasp was tried in every matching on ~d ~
                    box~:*~[es~;~:;es~]~@[ of ~d, drawn with the seed ~d~].  This is searched, not ~
                    proved.~%"
            boxes (and (< boxes all) all) *situation-seed*)
    (loop for (key . numbers) in (verification-numbers verification)
          do (format stream "  ~a: ~{~a~^ ~}~%" key (mapcar #'exact-number-text numbers)))))

(defmethod write-answer ((answer verification) stream)
  (let ((witnesses (make-hash-table :test #'equal)))
    (write-extent answer stream)
    (write-rule-uses (verification-rules answer) stream)
    (write-kinds answer nil witnesses stream)
    (write-search answer stream)
    (write-kinds answer t witnesses stream)
    (when (plusp (hash-table-count witnesses))
      (format stream "~%Boxes, the smallest for each line:~%")
      (loop for text being the hash-keys of witnesses using (hash-value number)
            do (format stream "  ~d ~a~%" number text)))))

;;; For users

(defun verify-knowledge (&rest arguments)
  "(VERIFY-KNOWLEDGE [KNOWLEDGE] &KEY GAMMA STREAM): say what is wrong with the rules of KNOWLEDGE,
by default what is in force, and where they and its grasps disagree.  Prints to STREAM, or nothing
if that is NIL, and returns a VERIFICATION, which holds FINDINGs."
  (if (or (null arguments) (keywordp (first arguments)))
      (apply #'verify-and-print *knowledge* arguments)
      (apply #'verify-and-print arguments)))

(defun verify-and-print (knowledge &key (gamma *gamma*) (stream *standard-output*))
  (let* ((knowledge (check-knowledge-argument knowledge))
         (gamma (check-gamma gamma))
         (verification (with-progress (verify knowledge gamma))))
    (when stream
      (write-answer verification (if (eq stream t) *standard-output* stream)))
    verification))
