;;;; failure.lisp -- why a candidate failed, and why a box can't be grasped, with the figures.

(in-package :supergrip)

(defun figure (number)
  "Return NUMBER for a report: four significant digits at most."
  (if (or (zerop number) (<= 1d-3 (abs number) 1d6))
      (let* ((digits (max 0 (- 3 (floor (log (max (abs number) 1d-3) 10)))))
             (text (format nil "~,vf" digits number)))
        (string-right-trim "." (string-right-trim "0" text)))
      (format nil "~,3e" number)))

(defun failing-test (node registers)
  "Return the comparison or other leaf of the test NODE that makes it false, given REGISTERS."
  (ecase (node-op node)
    (:and (destructuring-bind (a b) (node-args node)
            (if (test-holds-p a registers) (failing-test b registers) (failing-test a registers))))
    ((:or :not :blocked :false :true :< :<= :> :>= :=) node)))

(defun test-holds-p (node registers)
  (ecase (node-op node)
    (:true t)
    (:false nil)
    (:not (not (test-holds-p (first (node-args node)) registers)))
    (:and (every (lambda (test) (test-holds-p test registers)) (node-args node)))
    (:or (some (lambda (test) (test-holds-p test registers)) (node-args node)))
    (:blocked (= 1d0 (aref registers (+ +blocked+ (first (node-args node))))))
    ((:< :<= :> :>= :=)
     (destructuring-bind (a b) (node-registers node)
       (funcall (comparison-function (node-op node)) (aref registers a) (aref registers b))))))

(defun describe-test (node registers)
  "Return NODE, a test that is false, in words with its figures."
  (case (node-op node)
    ((:< :<= :> :>= :=)
     (destructuring-bind (a b) (node-registers node)
       (format nil "~a: ~a is not ~a ~a" (form-text (node-form node))
               (figure (aref registers a)) (symbol-name (node-op node))
               (figure (aref registers b)))))
    (:or (format nil "~{~a, and ~a~}" (loop for part in (node-args node)
                                            collect (describe-test part registers))))
    (:and (describe-test (failing-test node registers) registers))
    (t (format nil "~a does not hold" (form-text (node-form node))))))

(defun describe-condition-failure (candidate attempt)
  (let ((grasp (%candidate-grasp candidate))
        (registers (attempt-registers attempt)))
    (handler-case
        (progn
          (funcall (grasp-conditions grasp) registers)
          (describe-test (failing-test (grasp-conditions-node grasp) registers) registers))
      (arithmetic-error () "a form of CONDITIONS has no value"))))

(defun describe-offset-failure (candidate attempt)
  (handler-case
      (progn (run-program (grasp-offset (%candidate-grasp candidate)) (attempt-registers attempt))
             "OFFSET's entries for two opposite faces are not opposite numbers")
    (arithmetic-error () "the fingers can't reach: a root or a quotient of OFFSET has no value")))

(defun describe-open (candidate attempt)
  (handler-case
      (let* ((registers (attempt-registers attempt))
             (results (run-program (grasp-wrench (%candidate-grasp candidate)) registers))
             (place (position-if (lambda (register) (<= (aref registers register) 0d0)) results)))
        (if place
            (format nil "not closed: the contacts exert nothing ~a"
                    (aref #("along N" "along O" "along A" "about N" "about O" "about A") place))
            "a form of TWIST has no value or one below 0"))
    (arithmetic-error () "a form of WRENCH has no value")))

(defun describe-lifting-failure (attempt)
  (let ((axis (position-if #'identity (map 'list #'> (attempt-load attempt)
                                           (attempt-wrench attempt)))))
    (format nil "it can't hold the weight: the load ~a is ~a, the grasp bears ~a" (axis-name axis)
            (figure (aref (attempt-load attempt) axis))
            (figure (aref (attempt-wrench attempt) axis)))))

(defun candidate-failure (candidate plan)
  "Return why CANDIDATE of PLAN is not possible: the step (see CANDIDATE-OUTCOME) and a sentence
with the figures.  NIL if it is possible."
  (let ((outcome (candidate-outcome candidate)))
    (unless (eq outcome :possible)
      (let ((attempt (replay candidate plan)))
        (values outcome
                (ecase outcome
                  (:conditions (describe-condition-failure candidate attempt))
                  (:offset (describe-offset-failure candidate attempt))
                  (:fingers "a finger would stand outside the edges of its face")
                  (:open (describe-open candidate attempt))
                  (:lifting (describe-lifting-failure attempt))))))))

(defparameter +steps+ '(:conditions :offset :fingers :open :lifting :possible)
  "The steps of TRY, in order.")

(defun nearest-miss (plan)
  "Return the candidate of PLAN that got farthest; of equals, the first that was tried."
  (let ((best nil))
    (dolist (candidate (plan-candidates plan) best)
      (when (or (null best)
                (> (position (candidate-outcome candidate) +steps+)
                   (position (candidate-outcome best) +steps+)))
        (setf best candidate)))))

(defun plan-reason (plan)
  "Return why the box of PLAN can't be grasped, a string: what the rule said, or the nearest miss.
NIL if it can."
  (let ((stop (plan-stop plan)))
    (cond ((plan-best plan) nil)
          ((and stop (eq (stop-verdict stop) :cant)) (format nil "~{~a~^ ~}" (stop-words stop)))
          ((nearest-miss plan)
           (let ((miss (nearest-miss plan)))
             (format nil "NO POSSIBLE GRASP; NEAREST MISS ~a (~{~a~^ ~}): ~a"
                     (candidate-grasp miss) (candidate-matching miss)
                     (nth-value 1 (candidate-failure miss plan)))))
          (t "NO POSSIBLE GRASP; NONE HAS ALL ITS SURFACES FREE"))))
