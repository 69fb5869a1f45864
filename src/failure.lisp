;;;; failure.lisp -- why a candidate failed, and why a box can't be grasped, with the figures.

(in-package :supergrip)

;;; Conditions

(defun test-holds-p (node registers)
  "True if the test NODE holds; its comparisons must have been run on REGISTERS."
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

(defun failing-test (node registers)
  "Return the first part of the test NODE, joined by AND, that is false."
  (if (eq (node-op node) :and)
      (failing-test (find-if-not (lambda (test) (test-holds-p test registers)) (node-args node))
                    registers)
      node))

(defun face-of (slot matching)
  (surface-name (svref (matching-faces matching) slot)))

(defun operand-forms (form)
  "Return the forms of the two operands of the comparison FORM, infix or prefix."
  (if (comparison-p (first form)) (rest form) (list (first form) (third form))))

(defun describe-operand (form matching)
  "Return FORM, an operand of a comparison, in words."
  (cond ((and (part-p form "DIST") (quoted-slots (second form)))
         (format nil "the distance of ~{~a and ~a~}"
                 (loop for slot in (quoted-slots (second form)) collect (face-of slot matching))))
        ((or (name= form "U") (name= form "V")) (string-downcase form))
        (t (form-text form))))

(defun describe-comparison (node registers matching)
  (destructuring-bind (a b) (operand-forms (node-form node))
    (destructuring-bind (x y) (mapcar (lambda (register) (aref registers register))
                                      (node-registers node))
      (format nil "~a is ~a, must be ~a ~a~@[ (~a)~]" (describe-operand a matching) (figure x)
              (symbol-name (node-op node)) (figure y) (and (namep b) b)))))

(defun describe-negation (node matching)
  "Return the negation NODE, which is false, in words."
  (let* ((test (first (node-args node)))
         (blocked (if (eq (node-op test) :and) (node-args test) (list test))))
    (if (every (lambda (part) (eq (node-op part) :blocked)) blocked)
        (format nil "~{~a~^ and ~} ~[~;is~:;are both~] constrained"
                (loop for part in blocked collect (face-of (first (node-args part)) matching))
                (length blocked))
        (format nil "~a does not hold" (form-text (node-form node))))))

(defun describe-test (node registers matching)
  "Return NODE, a test that is false, in words with its figures."
  (case (node-op node)
    ((:< :<= :> :>= :=) (describe-comparison node registers matching))
    (:or (format nil "~{~a, and ~a~}" (loop for part in (node-args node)
                                            collect (describe-test part registers matching))))
    (:and (describe-test (failing-test node registers) registers matching))
    (:not (describe-negation node matching))
    (:blocked (format nil "~a is not constrained" (face-of (first (node-args node)) matching)))
    (t (format nil "~a does not hold" (form-text (node-form node))))))

(defun failing-condition (candidate attempt)
  "Return the part of the conditions of CANDIDATE that fails, or NIL if a form has no value."
  (let ((grasp (%candidate-grasp candidate))
        (registers (attempt-registers attempt)))
    (handler-case
        (progn (execute (grasp-conditions grasp) registers)
               (failing-test (grasp-conditions-node grasp) registers))
      (arithmetic-error () nil))))

(defun describe-condition-failure (candidate attempt)
  (let ((node (failing-condition candidate attempt)))
    (if node
        (describe-test node (attempt-registers attempt) (%candidate-matching candidate))
        "a form of CONDITIONS has no value")))

;;; The other steps

(defun describe-offset-failure (candidate attempt)
  (handler-case
      (progn (execute (grasp-offset (%candidate-grasp candidate)) (attempt-registers attempt))
             "OFFSET's entries for two opposite faces are not opposite numbers")
    (arithmetic-error () "the fingers can't reach: a root or a quotient of OFFSET has no value")))

(defun describe-finger-failure (candidate attempt)
  "Return which finger of CANDIDATE would stand beyond an edge, and where."
  (handler-case
      (let ((registers (attempt-registers attempt)))
        (execute (grasp-positions (%candidate-grasp candidate)) registers)
        (loop for (slot p q) in (grasp-contacts (%candidate-grasp candidate))
              do (loop for axis in (remove (floor slot 2) '(0 1 2))
                       for register in (list p q)
                       for place = (+ (aref (attempt-centre attempt) axis)
                                      (aref registers register))
                       for length = (aref (attempt-lengths attempt) axis)
                       unless (inside-p place length)
                         do (return-from describe-finger-failure
                              (format nil "a finger on ~a would stand at ~a cm along ~a, beyond ~
                                           the edge at ~a"
                                      (face-of slot (%candidate-matching candidate))
                                      (figure place) (char "NOA" axis)
                                      (figure (* (signum place) 0.5d0 length)))))))
    (arithmetic-error () "a form of CONTACTS has no value")))

(defun program-value-p (program registers)
  "True if PROGRAM has a value on REGISTERS."
  (handler-case (progn (execute program registers) t)
    (arithmetic-error () nil)))

(defun closed-at-p (grasp registers u)
  "True if GRASP is closed at friction U, the rest as in REGISTERS."
  (setf (aref registers +u+) u)
  (handler-case
      (loop for register across (run-program (grasp-wrench grasp) registers)
            always (> (aref registers register) 0d0))
    (arithmetic-error () nil)))

(defun closing-friction (grasp registers)
  "Return the least friction above that in REGISTERS that closes GRASP, or NIL; and the greatest that
does not."
  (let ((low (aref registers +u+))
        (high (max 1d0 (* 2 (aref registers +u+)))))
    (loop until (or (closed-at-p grasp registers high) (> high 100d0))
          do (setf high (* 2 high)))
    (when (closed-at-p grasp registers high)
      (loop repeat 40
            do (let ((middle (/ (+ low high) 2)))
                 (if (closed-at-p grasp registers middle)
                     (setf high middle)
                     (setf low middle))))
      (values high low))))

(defun describe-open (candidate attempt)
  (let* ((grasp (%candidate-grasp candidate))
         (registers (copy-seq (attempt-registers attempt)))
         (u (aref registers +u+)))
    (cond ((not (program-value-p (grasp-wrench grasp) registers)) "a form of WRENCH has no value")
          ((closed-at-p grasp registers u) "a form of TWIST, or the index, has no value in range")
          (t
           (multiple-value-bind (needed too-little) (closing-friction grasp registers)
             (if needed
                 (apply #'format nil "open: the contacts don't close on this shape; needs u > ~a, ~
                                      has ~a" (figures too-little u))
                 "open: the contacts don't close on this shape with any friction"))))))

(defun bounded-ratio (a b)
  "Return A / B, above 0, or the greatest double where that overflows."
  (handler-case (/ a b)
    (arithmetic-error () most-positive-double-float)))

(defun load-shares (attempt)
  "Return the shares, six, that the load takes of what the grasp bears alone on each axis."
  (map 'list #'bounded-ratio (attempt-load attempt) (attempt-wrench attempt)))

(defun total-share (shares)
  "Return the sum of SHARES, at most the greatest double."
  (handler-case (reduce #'+ shares)
    (arithmetic-error () most-positive-double-float)))

(defun describe-lifting-failure (attempt)
  "Return in words that the load is too much: on one axis, or on several together."
  (let* ((shares (load-shares attempt))
         (worst (reduce #'max shares))
         (axis (position worst shares)))
    (if (> worst 1)
        (format nil "it can't hold the weight: the load ~a is ~a, the grasp bears ~a"
                (axis-name axis) (figure (aref (attempt-load attempt) axis))
                (figure (aref (attempt-wrench attempt) axis)))
        (format nil "it can't hold the weight: the load takes ~{~a of what the grasp bears ~a~^, ~
                     ~}, together ~a; the axes share the same friction, so 1 is the most"
                (loop for share in shares for axis from 0
                      when (plusp share) collect (figure share) and collect (axis-name axis))
                (figure (total-share shares))))))

(defun candidate-failure (candidate &optional (plan *plan*))
  "Return why CANDIDATE of PLAN is not possible: the step (see CANDIDATE-OUTCOME) and a sentence
with the figures.  NIL if it is possible."
  (let ((outcome (candidate-outcome candidate)))
    (unless (eq outcome :possible)
      (with-replay (attempt candidate plan)
        (values outcome
                (plainly
                  (ecase outcome
                    (:conditions (describe-condition-failure candidate attempt))
                    (:offset (describe-offset-failure candidate attempt))
                    (:fingers (describe-finger-failure candidate attempt))
                    (:open (describe-open candidate attempt))
                    (:lifting (describe-lifting-failure attempt)))))))))

;;; The nearest miss

(defparameter +steps+ '(:conditions :offset :fingers :open :lifting :possible)
  "The steps of TRY, in order.")

(defun friction-shortfall (grasp registers least)
  "Return by how much the friction in REGISTERS misses what closes GRASP, relative; 1 if nothing
does, or if it is no less than LEAST, unless that is NIL."
  (let* ((u (aref registers +u+))
         (needed (and (or (null least)
                          ;; One look here saves most of the searches.
                          (closed-at-p grasp registers (bounded-ratio u (- 1 (- least +tie+)))))
                      (progn (setf (aref registers +u+) u)
                             (closing-friction grasp registers)))))
    (if needed (- 1 (/ u needed)) 1)))

(defun shortfall (candidate attempt least)
  "Return by how much CANDIDATE missed the step that it failed: 0 to 1, relative; 1 where that can't
be said, or if it is no less than LEAST.  ATTEMPT, at its box, is used to replay it."
  (let ((attempt (replay candidate attempt)))
    (case (candidate-outcome candidate)
      (:conditions
       (let ((node (failing-condition candidate attempt)))
         (if (and node (node-registers node))
             (destructuring-bind (a b) (mapcar (lambda (register)
                                                 (abs (aref (attempt-registers attempt) register)))
                                               (node-registers node))
               (if (= a b) 0 (/ (abs (- a b)) (max a b))))
             1)))
      (:open (friction-shortfall (%candidate-grasp candidate)
                                 (copy-seq (attempt-registers attempt)) least))
      (:lifting (- 1 (/ (total-share (load-shares attempt)))))
      (t 1))))

(defun nearest-of (candidates plan)
  "Return the one of CANDIDATES of PLAN that got farthest; of several, the one that missed by least."
  (let* ((step (find-if (lambda (step) (find step candidates :key #'candidate-outcome))
                        (reverse +steps+)))
         (best nil) (least nil))
    (with-attempt (attempt plan)
      (dolist (candidate candidates best)
        (when (eq step (candidate-outcome candidate))
          (let ((shortfall (shortfall candidate attempt least)))
            (when (or (null least) (< shortfall (- least +tie+)))
              (setf best candidate least shortfall))))))))

(defun plan-reason (&optional (plan *plan*))
  "Return why the box of PLAN can't be grasped, a string: what the rule said, or the nearest miss.
NIL if it can."
  (let* ((stop (plan-stop (need-plan plan)))
         (said (and stop (eq (stop-verdict stop) :cant)))
         (miss (and (not said) (not (plan-best plan)) (nearest-of (plan-candidates plan) plan))))
    (cond ((plan-best plan) nil)
          (said (format nil "CANT ~{~a~^ ~}" (stop-words stop)))
          (miss (format nil "NO GRASP IS POSSIBLE, NEAREST MISS: ~a (~{~a~^ ~}): ~a"
                        (candidate-grasp miss) (candidate-matching miss)
                        (nth-value 1 (candidate-failure miss plan))))
          (t "NO RULE SUGGESTS A GRASP WHOSE SURFACES ARE FREE"))))
