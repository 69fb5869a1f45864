;;;; try.lisp -- the lower level: the function TRY and the actions TRY and KEEP.
;;;;
;;;; For each matching that the suggestion and the constrained faces leave, in order: grasping
;;;; conditions, offset, positions of the fingers, wrench and twist rotated to X Y Z, lifting,
;;;; quality.  A candidate that passes is possible; one that fails keeps the step that it failed.

(in-package :supergrip)

(defstruct (candidate (:constructor make-candidate (grasp matching)) (:copier nil)
                      (:conc-name %candidate-))
  "A grasp in one matching.  OUTCOME is :POSSIBLE or the step that failed: :CONDITIONS, :OFFSET,
:FINGERS, :OPEN or :LIFTING.  X Y Z is the grasp centre from the box centre, in cm."
  (grasp nil :type grasp)
  (matching nil :type matching)
  (outcome :conditions :type symbol)
  (quality 0d0 :type double-float)
  (force-radius 0d0 :type double-float) (velocity-radius 0d0 :type double-float)
  (force-limit -1 :type (integer -1 5)) (velocity-limit -1 :type (integer -1 5))
  (x 0d0 :type double-float) (y 0d0 :type double-float) (z 0d0 :type double-float))

(defun make-six () (make-array 6 :element-type 'double-float :initial-element 0d0))
(defun make-three () (make-array 3 :element-type 'double-float :initial-element 0d0))

(defstruct (attempt (:constructor %make-attempt (registers tried)))
  "All that trying grasps on one box needs and leaves: the registers, what was tried of each grasp
(a set of matchings), and the candidates, the latest first.  The arrays are the current
candidate's, in the box frame."
  (box nil :type (or null box)) (gamma 0.5d0 :type double-float)
  (registers nil :type registers)
  (tried nil :type (simple-array (unsigned-byte 24) (*)))
  (candidates '() :type list) (best nil)
  (lengths (make-three) :type three) (centre (make-three) :type three)
  (offset (make-three) :type three)
  (wrench (make-six) :type six) (twist (make-six) :type six)
  (load (make-six) :type six) (need (make-six) :type six))

(defun make-attempt (box graspbase gamma)
  "Return an attempt at BOX with nothing tried yet: one that another plan gave back, or a new one."
  (let ((attempt (or (take-from (graspbase-spare graspbase))
                     (%make-attempt (copy-seq (graspbase-registers graspbase))
                                    (make-array (length (graspbase-grasps graspbase))
                                                :element-type '(unsigned-byte 24)
                                                :initial-element 0)))))
    (declare (type attempt attempt) (type box box))
    (setf (attempt-box attempt) box
          (attempt-gamma attempt) gamma
          (aref (attempt-registers attempt) +u+) (%box-u box)
          (aref (attempt-registers attempt) +v+) (%box-v box))
    attempt))

(defun give-back (attempt graspbase)
  "Let another plan use ATTEMPT, which is at a box no more."
  (declare (type attempt attempt))
  (fill (attempt-tried attempt) 0)
  (setf (attempt-box attempt) nil
        (attempt-candidates attempt) '()
        (attempt-best attempt) nil)
  (give-to (graspbase-spare graspbase) attempt))

;;; The steps.  Each returns true if the candidate passes.

(defun place-box (attempt matching)
  "Put the distances of the faces, and which are constrained, into the registers."
  (declare (type attempt attempt) (type matching matching))
  (let* ((registers (attempt-registers attempt))
         (box (attempt-box attempt))
         (size (%box-size box))
         (constrained (%box-constrained box)))
    (dotimes (i 3)
      (let ((length (aref size (the (integer 0 2) (svref (matching-axes matching) i)))))
        (setf (aref (attempt-lengths attempt) i) length
              (aref registers (+ +distances+ i)) length)))
    (dotimes (slot 6)
      (setf (aref registers (+ +blocked+ slot))
            (if (logbitp (the surface (svref (matching-faces matching) slot)) constrained)
                1d0 0d0)))))

(defun find-centre (attempt grasp)
  "Put the grasp centre, in the grasp frame from the box centre, into the attempt.
Entries for opposite faces say the same shift, so they must be opposite numbers."
  (declare (type attempt attempt))
  (let* ((registers (attempt-registers attempt))
         (results (run-program (grasp-offset grasp) registers))
         (centre (attempt-centre attempt)))
    (dotimes (i 3 t)
      (let ((plus (aref registers (aref results (* 2 i))))
            (minus (aref registers (aref results (1+ (* 2 i))))))
        (unless (<= (abs (+ plus minus)) (* 1d-9 (+ 1d0 (abs plus))))
          (return nil))
        (setf (aref centre i) (* 0.5d0 (- plus minus)))))))

(declaim (inline inside-p))
(defun inside-p (place length)
  (declare (double-float place length))
  (<= (abs place) (* 0.5d0 length (+ 1d0 1d-9))))

(defun fingers-on-faces-p (attempt grasp)
  "True if every finger is inside the edges of its face."
  (declare (type attempt attempt))
  (let ((registers (attempt-registers attempt))
        (centre (attempt-centre attempt))
        (lengths (attempt-lengths attempt)))
    (execute (grasp-positions grasp) registers)
    (loop for (slot p q) of-type (fixnum register register) in (grasp-contacts grasp)
          always (let* ((axis (ash slot -1))
                        (i (if (= axis 0) 1 0))
                        (j (if (= axis 2) 1 2)))
                   (and (inside-p (+ (aref centre i) (aref registers p)) (aref lengths i))
                        (inside-p (+ (aref centre j) (aref registers q)) (aref lengths j)))))))

(defun exert (attempt grasp matching)
  "Put wrench and twist, rotated to X Y Z, into the attempt.  True if the grasp is closed."
  (declare (type attempt attempt) (type matching matching))
  (let ((registers (attempt-registers attempt)))
    (flet ((rotate (results out least)
             (declare (type six out) (double-float least))
             (dotimes (i 6 t)
               (let ((entry (aref registers (aref results i))))
                 (unless (> entry least) (return nil))
                 (setf (aref out (if (< i 3)
                                     (the (integer 0 2) (svref (matching-axes matching) i))
                                     (+ 3 (the (integer 0 2)
                                               (svref (matching-axes matching) (- i 3))))))
                       entry)))))
      (and (rotate (run-program (grasp-wrench grasp) registers) (attempt-wrench attempt) 0d0)
           (rotate (run-program (grasp-twist grasp) registers) (attempt-twist attempt) -1d-300)))))

(defun turn-centre (attempt matching candidate)
  "Put the grasp centre into CANDIDATE, in the box frame."
  (declare (type attempt attempt) (type matching matching) (type candidate candidate))
  (let ((offset (attempt-offset attempt)))
    (dotimes (i 3)
      (setf (aref offset (the (integer 0 2) (svref (matching-axes matching) i)))
            (* (the (integer -1 1) (svref (matching-signs matching) i))
               (aref (attempt-centre attempt) i))))
    (setf (%candidate-x candidate) (aref offset 0)
          (%candidate-y candidate) (aref offset 1)
          (%candidate-z candidate) (aref offset 2))
    ;; From here on only the lever arms matter.
    (dotimes (i 3)
      (setf (aref offset i) (abs (aref offset i))))))

(defun lift (attempt)
  "Put gravity's load into the attempt.  True if the wrench bears it on all six axes."
  (declare (type attempt attempt))
  (put-load (%box-weight (attempt-box attempt)) (attempt-offset attempt) (attempt-load attempt))
  (dotimes (axis 6 t)
    (unless (<= (aref (attempt-load attempt) axis) (aref (attempt-wrench attempt) axis))
      (return nil))))

(defun judge (attempt candidate)
  "Compute the radii and the quality of CANDIDATE."
  (declare (type attempt attempt) (type candidate candidate))
  (let ((box (attempt-box attempt))
        (wrench (attempt-wrench attempt))
        (need (attempt-need attempt)))
    (dotimes (axis 6)
      (decf (aref wrench axis) (aref (attempt-load attempt) axis)))
    (shift-force (%box-force box) (attempt-offset attempt) need)
    (multiple-value-bind (force-radius force-limit) (embedded-radius need wrench)
      (shift-velocity (%box-velocity box) (attempt-offset attempt) need)
      (multiple-value-bind (velocity-radius velocity-limit)
          (embedded-radius need (attempt-twist attempt))
        (setf (%candidate-force-radius candidate) force-radius
              (%candidate-force-limit candidate) force-limit
              (%candidate-velocity-radius candidate) velocity-radius
              (%candidate-velocity-limit candidate) velocity-limit
              (%candidate-quality candidate)
              (quality-index (attempt-gamma attempt) velocity-radius velocity-limit
                             force-radius force-limit))))
    t))

(defun run-steps (attempt candidate)
  "Take CANDIDATE through the steps; its OUTCOME is the one it failed, or :POSSIBLE."
  (declare (type candidate candidate))
  (let ((grasp (%candidate-grasp candidate))
        (matching (%candidate-matching candidate)))
    (macrolet ((steps (&rest steps)
                 `(and ,@(loop for (outcome step) in steps
                               collect `(progn (setf (%candidate-outcome candidate) ,outcome) ,step))
                       (setf (%candidate-outcome candidate) :possible))))
      (handler-case
          (steps (:conditions (progn (place-box attempt matching)
                                     (execute (grasp-conditions grasp)
                                          (attempt-registers attempt))))
                 (:offset (find-centre attempt grasp))
                 (:fingers (fingers-on-faces-p attempt grasp))
                 (:open (exert attempt grasp matching))
                 (:lifting (progn (turn-centre attempt matching candidate)
                                  (lift attempt)))
                 (:open (judge attempt candidate)))
        ;; A root, quotient or overflow without a value fails the step that it stands in.
        (arithmetic-error () nil)))))

;;; TRY

(defconstant +tie+ 1d-9 "Qualities that differ by no more are equal.")

(defun try-matching (attempt grasp matching)
  "Try GRASP in MATCHING, and return the candidate."
  (let ((candidate (make-candidate grasp matching)))
    (push candidate (attempt-candidates attempt))
    (run-steps attempt candidate)
    (when (eq (%candidate-outcome candidate) :possible)
      (let ((best (attempt-best attempt)))
        (when (or (null best)
                  (> (%candidate-quality candidate) (+ (%candidate-quality best) +tie+)))
          (setf (attempt-best attempt) candidate))))
    candidate))

(defun usable-matchings (grasp constrained)
  "Return the set of the matchings in which GRASP uses none of the faces CONSTRAINED, a set."
  (declare (type (unsigned-byte 6) constrained))
  (let ((usable +all-matchings+))
    (declare (type matching-set usable))
    (dotimes (face 6 usable)
      (when (logbitp face constrained)
        (setf usable (logand usable (aref (grasp-valid grasp) face)))))))

(defun try-matchings (attempt grasp suggested note)
  "Try GRASP in those matchings of the set SUGGESTED that use no constrained face, and that
neither they nor their equivalents were tried before.  Calls NOTE with each candidate."
  (declare (type attempt attempt) (type grasp grasp) (type matching-set suggested)
           (function note))
  (let ((open (logand suggested (usable-matchings grasp (%box-constrained (attempt-box attempt))))))
    (declare (type matching-set open))
    (loop
      (let ((left (logandc2 open (aref (attempt-tried attempt) (grasp-index grasp)))))
        (declare (type matching-set left))
        (when (zerop left) (return))
        (let ((index (1- (integer-length (logand left (- left))))))
          (setf (aref (attempt-tried attempt) (grasp-index grasp))
                (logior (aref (attempt-tried attempt) (grasp-index grasp))
                        (aref (grasp-same grasp) index)))
          (funcall note (try-matching attempt grasp (svref +matchings+ index))))))))

;;; The actions

(defun suggested-matchings (terms binding)
  "Return the set of the matchings that give the slots the faces that TERMS, six of them or NIL
for any, stand for under BINDING."
  (let ((set +all-matchings+))
    (declare (type matching-set set))
    (loop for term in terms
          for slot of-type (integer 0 5) from 0
          when term
            do (setf set (logand set (aref +matchings-with+ slot (term-value term binding)))))
    set))

(defun parse-suggestion (operands action)
  "Return the terms of the suggested matching in OPERANDS, NIL for each that is ?; or complain, and
return true as the second value."
  (let ((list (first operands)))
    (cond ((null operands) '())
          ((or (rest operands) (not (consp list)) (/= (length list) 6))
           (when (consp list)
             (parse-surfaces (remove-if (lambda (element) (name= element "?")) list) nil))
           (complain (action-form action) "a suggested matching is one list of six, for N1 N2 O1 ~
                                           O2 A1 A2, with ? for any: (? s3 s1 s2 ? s4)")
           (values nil t))
          (t
           (multiple-value-bind (terms bad)
               (parse-surfaces (remove-if (lambda (element) (name= element "?")) list) nil)
             (if bad
                 (values nil t)
                 (loop for element in list
                       collect (if (name= element "?") nil (pop terms)))))))))

(defun compile-try (action grasp)
  "Make ACTION try GRASP, if its suggestion is good."
  (multiple-value-bind (terms bad) (parse-suggestion (rest (action-operands action)) action)
    (unless bad
      (setf (action-target action) grasp
            (action-terms action) terms
            (action-function action)
            (lambda (memory binding)
              (try-matchings (memory-client memory) grasp (suggested-matchings terms binding)
                             (lambda (candidate) (push candidate (memory-log memory))))
              nil)))))

(define-action :try (action rulebase)
  (let* ((name (first (action-operands action)))
         (graspbase (rulebase-client rulebase))
         (grasp (and (namep name) (find-grasp graspbase (symbol-name name)))))
    (unless grasp
      (parse-suggestion (rest (action-operands action)) action))
    (cond (grasp (compile-try action grasp))
          ((not (namep name))
           (complain (action-form action) "TRY names a grasp, as (TRY PINCH-3-PARALLEL)"))
          ;; Of a grasp that is wrong enough was said.
          ((name-in name (graspbase-broken graspbase)))
          (t (complain (action-form action) "TRY names ~a, which is not in the database~a" name
                       (suggestion (symbol-name name)
                                   (mapcar #'grasp-name (graspbase-grasps graspbase))))))))

(define-action :keep (action rulebase)
  (if (and (= (length (action-operands action)) 1) (name= (first (action-operands action)) "BEST"))
      (let ((stop (make-stop :verdict :keep :rule *rule*)))
        (setf (action-function action)
              (lambda (memory binding)
                (declare (ignore memory binding))
                stop)))
      (complain (action-form action) "KEEP is (KEEP BEST)")))
