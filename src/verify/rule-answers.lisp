;;;; rule-answers.lisp -- what the rules alone answer for a box: which grasps are suggested; none
;;;; is tried.

(in-package :supergrip)

(defstruct answer
  "What the rules answer.  CANT is the list of the words with which they refuse the box, or NIL;
TRIED, for each grasp, the set of the matchings that TRY would take, with their equivalents;
ORDER the list of those that it would take, (GRASP-INDEX . MATCHING-INDEX), in order.  Where the
rules refuse the box, what they suggested before does not count.  KEEP BEST and the end of the
rules are the same: both keep the best."
  (cant '() :type list)
  (tried nil :type matching-sets)
  (order '() :type list))

(defun answer-difference (a b)
  "Return in what the answers A and B differ: :CANT, whether and in which words they refuse the box;
:TRIED, what would be tried; :ORDER, only the order of that; or NIL."
  (cond ((not (equal (answer-cant a) (answer-cant b))) :cant)
        ((answer-cant a) nil)
        ((mismatch (answer-tried a) (answer-tried b)) :tried)
        ((not (equal (answer-order a) (answer-order b))) :order)))

(defun changed-p (a b)
  "True if the answers A and B differ in more than the order of what is tried."
  (member (answer-difference a b) '(:cant :tried)))

;;; Changes in words

(defun cant-text (answer)
  (if (answer-cant answer)
      (format nil "CANT ~{~a~^ ~}" (answer-cant answer))
      "the box is not refused"))

(defun matchings-text (old new names)
  "Return which of the grasps NAMES are in other matchings in NEW than in OLD, two sets for each,
in words."
  (flet ((those (test)
           (listed (loop for name in names
                         for before across old
                         for after across new
                         when (funcall test before after) collect name))))
    (let ((gained (those (lambda (before after) (and (zerop before) (plusp after)))))
          (lost (those (lambda (before after) (and (plusp before) (zerop after)))))
          (other (those (lambda (before after)
                          (and (plusp before) (plusp after) (/= before after))))))
      (format nil "~{~a~^; ~}"
              (loop for text in (list gained lost other)
                    for control in '("tried too: ~a" "tried no longer: ~a"
                                     "tried in other matchings: ~a")
                    unless (string= text "") collect (format nil control text))))))

(defun change-texts (what old new names)
  "Return the texts of what is different in the answers OLD and NEW, a list."
  (ecase what
    (:cant (list (format nil "~a; was: ~a" (cant-text new) (cant-text old))))
    (:tried (list (matchings-text (answer-tried old) (answer-tried new) names)))
    (:order (list "the same is tried, in another order or in equivalent matchings"))))

;;; Running rules

(defstruct (runner (:constructor %make-runner (knowledge rules memory fired)))
  "What runs the RULES of KNOWLEDGE, in MEMORY.  PERFORMERS is a table from actions that try to
functions of a binding, which only note what would be tried.  After a run FIRED has a bit for
each rule that did, DONE lists what was done, (RULE ACTION . MATCHINGS), the set that is suggested,
or (RULE ACTION . BINDING), and ORDER what would be tried, both the latest first."
  (knowledge nil :type knowledge) (rules '() :type list) (memory nil :type memory)
  (fired nil :type simple-bit-vector)
  (performers (make-hash-table :test #'eq))
  (done '() :type list) (order '() :type list))

(defun make-runner (knowledge)
  "Return a runner of the rules of KNOWLEDGE."
  (let* ((rules (knowledge-rules knowledge))
         (runner (%make-runner knowledge rules (new-memory knowledge)
                               (make-array (length rules) :element-type 'bit))))
    (dolist (rule rules runner)
      (dolist (action (rule-actions rule))
        (when (grasp-p (action-target action))
          (setf (gethash action (runner-performers runner))
                (suggesting-function rule action runner)))))))

(defun suggesting-function (rule action runner)
  "Return the function that does for ACTION of RULE what TRY-MATCHINGS does, but tries nothing."
  (let* ((grasp (action-target action))
         (workspace (memory-client (runner-memory runner)))
         (set (constant-matchings (action-terms action)))
         (grasp-faces (variable-faces (action-terms action)))
         (index (grasp-index grasp)))
    (lambda (binding)
      (let* ((constrained (%box-constrained (workspace-box workspace)))
             (open (logand (suggested-matchings set grasp-faces binding)
                           (aref (grasp-usable grasp) constrained)))
             (tried (workspace-tried workspace)))
        (declare (type matching-set open))
        (push (list* rule action open) (runner-done runner))
        (loop for left of-type matching-set = (logandc2 open (aref tried index))
              until (zerop left)
              do (let ((matching (1- (integer-length (logand left (- left))))))
                   (setf (aref tried index)
                         (logior (aref tried index) (aref (grasp-same grasp) matching)))
                   (push (cons index matching) (runner-order runner))))
        nil))))

(defun refusal-words (stop)
  "Return the words with which STOP, or NIL, refuses the box, or NIL.  Whatever else ends a run
keeps the best (see FINISH-PLAN)."
  (and stop (eq (stop-verdict stop) :cant) (stop-words stop)))

(defun start-run (runner box)
  "Make RUNNER ready for BOX."
  (let ((knowledge (runner-knowledge runner)) (memory (runner-memory runner)))
    (clear-memory memory (knowledge-rulebase knowledge))
    (prepare-memory memory (declared-only box knowledge) knowledge 0.5d0)
    (fill (runner-fired runner) 0)
    (setf (runner-done runner) '()
          (runner-order runner) '())))

(defun continue-run (runner rules)
  "Run RULES, of those of RUNNER, on what its memory holds.  Return the STOP that ended the run,
or NIL."
  (let ((memory (runner-memory runner))
        (fired (runner-fired runner))
        (performers (runner-performers runner)))
    (run-in-order rules memory
                  (lambda (rule action binding)
                    (setf (sbit fired (rule-index rule)) 1)
                    (let ((performer (gethash action performers)))
                      (cond (performer (funcall (the function performer) binding))
                            (t (push (list* rule action binding) (runner-done runner))
                               (funcall (the function (action-function action)) memory rule
                                        binding))))))))

(defun run-runner (runner box &optional (rules (runner-rules runner)))
  "Run RULES, those of RUNNER or some of them, in their order, for BOX; return the answer, and
the STOP or NIL."
  (start-run runner box)
  (let ((stop (continue-run runner rules)))
    (values (make-answer :cant (refusal-words stop)
                         :tried (copy-seq (workspace-tried (memory-client (runner-memory runner))))
                         :order (reverse (runner-order runner)))
            stop)))
