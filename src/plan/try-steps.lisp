;;;; try-steps.lisp -- the steps through which TRY takes a candidate: a grasp in one matching.
;;;;
;;;; Grasping conditions, offset, positions of the fingers, wrench and twist rotated to X Y Z,
;;;; lifting, quality.  A candidate that passes is possible; one that fails records the step that it
;;;; failed.  An index says by what a grasp is rated.  Each index has last steps of its own.

(in-package :supergrip)

(defstruct (candidate (:constructor make-candidate (grasp matching)) (:copier nil)
                      (:conc-name %candidate-))
  "A grasp in one matching.  OUTCOME is :POSSIBLE or the step that failed: :CONDITIONS, :OFFSET,
:FINGERS, :OPEN or :LIFTING.  X Y Z is the grasp centre from the box centre, in cm.  BOUND is true
if QUALITY and FORCE-RADIUS are no more than upper bounds."
  (grasp nil :type grasp)
  (matching nil :type matching)
  (outcome :conditions :type symbol)
  (quality 0d0 :type double-float)
  (force-radius 0d0 :type double-float) (velocity-radius 0d0 :type double-float)
  (force-limit -1 :type (integer -1 5)) (velocity-limit -1 :type (integer -1 5))
  (x 0d0 :type double-float) (y 0d0 :type double-float) (z 0d0 :type double-float)
  (strength nil)                        ; see plan/exact.lisp
  (bound nil :type boolean))

(declaim (inline possible-p))
(defun possible-p (candidate)
  (eq (%candidate-outcome candidate) :possible))

(defun quality-sign (candidate)
  "Return the sign between Q and the quality of CANDIDATE: = or, for a bound, <=."
  (if (%candidate-bound candidate) "<=" "="))

(define-printing (candidate candidate) "~a (~{~a~^ ~}) ~:[~a~;Q~*~a~,3f~]"
  (grasp-name (%candidate-grasp candidate)) (matching-names (%candidate-matching candidate))
  (possible-p candidate) (%candidate-outcome candidate)
  (quality-sign candidate) (%candidate-quality candidate))

(defstruct (index (:constructor make-index (name same choose)))
  "What grasps are rated by.  NAME is a keyword.  SAME is a function of a grasp and a box: for each
matching, the set of those that the index does not tell apart.  CHOOSE is a function of a workspace
and a log: the best candidate, or NIL."
  (name nil :type keyword :read-only t)
  (same nil :type function :read-only t)
  (choose nil :type function :read-only t))

(defvar *indices* '() "All indices; the first is used by default.")

(defun index-named (name)
  "Return the index NAME, a keyword, or signal an ARGUMENT-ERROR."
  (or (loop for index of-type index in *indices*
            when (eq name (index-name index)) return index)
      (refuse-argument "index is ~a, but must be ~{~s~^ or ~}" (form-text name)
                       (mapcar #'index-name *indices*))))

(defstruct (workspace (:constructor %make-workspace (registers tried)))
  "All that trying grasps on one box needs and leaves: the registers, what was tried of each grasp
(a set of matchings), and the BEST candidate.  The arrays are the current candidate's, in the box
frame: WRENCH and TWIST what the grasp can do, AHEAD and BEHIND what it exerts along and against the
axes if its WRENCH says so, then BEARING what it exerts against the load and COUNTER the other way;
BEARS is that of them, or WRENCH, which bears the load; LOAD what gravity asks, SPARE what it leaves
of WRENCH, FORCE-NEEDS and VELOCITY-NEEDS what the task asks at the grasp centre."
  (box nil :type (or null box)) (gamma 0.5d0 :type double-float)
  (index (first *indices*) :type index) (steps '() :type list)
  (registers nil :type registers)
  (tried nil :type matching-sets)
  (best nil)
  (lengths (make-three) :type three) (centre (make-three) :type three)
  (offset (make-three) :type three)
  (wrench (make-six) :type six) (twist (make-six) :type six)
  (ahead (make-six) :type six) (behind (make-six) :type six)
  (bearing (make-six) :type six) (counter (make-six) :type six)
  (bears (make-six) :type six)
  (load (make-six) :type six) (spare (make-six) :type six)
  (force-needs (make-six) :type six) (velocity-needs (make-six) :type six))

(define-printing (workspace workspace) "~@[at ~a~]" (workspace-box workspace))

(defun same-by-axes (grasp box)
  "Return, for each matching of GRASP, the set of those that six numbers, one an axis, do not tell
apart on BOX.  Where gravity is along an axis through the middle, it does not matter to which side
the grasp centre lies."
  (declare (type grasp grasp) (type box box))
  (let ((axis (%box-gravity-axis box)))
    (if axis (svref (grasp-same-lying grasp) axis) (grasp-same-centre grasp))))

(setf *indices* (with-row (make-index :paper #'same-by-axes (lambda (workspace log)
                                                            (declare (ignore log))
                                                            (workspace-best workspace)))
                  *indices* #'index-name))

(defvar *steps* '((:paper) (:exact))
  "For each index, by its name, the steps that DEFINE-STEP has defined, in the order in which
they are taken.")

(declaim (inline steps-of))
(defun steps-of (index)
  (rest (assoc index *steps* :test #'eq)))

(defun make-workspace (graspbase)
  "Return a workspace with the grasps of GRASPBASE, at no box yet."
  (%make-workspace (copy-seq (graspbase-registers graspbase))
                   (make-array (length (graspbase-grasps graspbase)) :element-type 'matching-set)))

(defun start-workspace (workspace box gamma &optional (index (first *indices*)))
  "Make WORKSPACE, which may have been used, one at BOX with nothing tried yet.  Return it."
  (declare (type workspace workspace) (type box box))
  (setf (workspace-box workspace) box
        (workspace-gamma workspace) gamma
        (workspace-index workspace) index
        (workspace-steps workspace) (steps-of (index-name index))
        (workspace-best workspace) nil
        (aref (workspace-registers workspace) +u+) (%box-friction box)
        (aref (workspace-registers workspace) +v+) (%box-soft-friction box))
  (fill (workspace-tried workspace) 0)
  workspace)

;;; The table.  Why a candidate failed a step, and by how much, is told in why/failures.lisp, one
;;; row each.

(defstruct (try-step (:constructor make-try-step (outcome name test)))
  "A step of TRY.  OUTCOME is what a candidate that fails it has; TEST, a function of the candidate
and the workspace, returns true if it passes.  NAME is a symbol."
  (outcome nil :type keyword) (name nil :type symbol) (test nil :type function))

(defun add-try-step (step &optional index)
  "Make STEP one of the steps of INDEX, a keyword, or of all."
  (setf *steps* (loop for (name . steps) in *steps*
                      collect (cons name (if (member index (list nil name))
                                             (with-row step steps #'try-step-name)
                                             steps)))))

(defmacro define-step (name outcome (candidate workspace) &body body)
  "Define the step NAME of TRY, the last one if it is new; NAME may be (NAME INDEX), if only that
index, a keyword, takes it.  BODY is true if CANDIDATE passes; it leaves in WORKSPACE what later
steps need.  A candidate that fails has OUTCOME, a keyword."
  (destructuring-bind (name &optional index) (if (listp name) name (list name))
    `(add-try-step (make-try-step ,outcome ',name
                                  (lambda (,candidate ,workspace)
                                    (declare (type candidate ,candidate)
                                             (type workspace ,workspace)
                                             (ignorable ,candidate ,workspace))
                                    ,@body))
                   ,index)))

(defun run-steps (workspace candidate)
  "Take CANDIDATE through the steps; its OUTCOME is the one it failed, or :POSSIBLE."
  (declare (type candidate candidate) (type workspace workspace))
  (let ((outcome :possible))
    (handler-case
        (loop for step of-type try-step in (workspace-steps workspace)
              do (setf outcome (try-step-outcome step))
              always (funcall (try-step-test step) candidate workspace)
              finally (setf outcome :possible))
      ;; What has no value fails the step that it stands in.  The steps find it out by themselves;
      ;; where a float trap is enabled, it may come first.
      (arithmetic-error () nil))
    (setf (%candidate-outcome candidate) outcome)))

(defun step-outcomes ()
  "Return what candidates may have, in the order of the steps; the last is :POSSIBLE."
  (append (remove-duplicates (loop for (nil . steps) in *steps*
                                   append (mapcar #'try-step-outcome steps))
                             :from-end t)
          '(:possible)))

;;; The rows

(declaim (inline place-box))
(defun place-box (workspace matching)
  "Put the distances of the faces, and which are constrained, into the registers."
  (declare (type workspace workspace) (type matching matching))
  (let* ((registers (workspace-registers workspace))
         (box (workspace-box workspace))
         (size (%box-size box))
         (constrained (%box-constrained box)))
    (dotimes (i 3)
      (let ((length (aref size (aref (matching-axes matching) i))))
        (setf (aref (workspace-lengths workspace) i) length
              (aref registers (+ +distances+ i)) length)))
    (dotimes (grasp-face 6)
      (setf (aref registers (+ +blocked+ grasp-face))
            (if (logbitp (the face (svref (matching-faces matching) grasp-face)) constrained)
                1d0 0d0)))))

(define-step conditions :conditions (candidate workspace)
  (place-box workspace (%candidate-matching candidate))
  (execute (grasp-conditions (%candidate-grasp candidate)) (workspace-registers workspace)))

(define-step offset :offset (candidate workspace)
  ;; Entries for opposite faces say the same shift, so they must be opposite numbers.
  (let* ((registers (workspace-registers workspace))
         (program (grasp-offset (%candidate-grasp candidate)))
         (results (program-results program))
         (centre (workspace-centre workspace)))
    (and (execute program registers)
         (dotimes (i 3 t)
           (let* ((plus (aref registers (aref results (* 2 i))))
                  (minus (aref registers (aref results (1+ (* 2 i)))))
                  (both (- plus minus)))
             (unless (and (<= (abs (+ plus minus)) (* 1d-9 (+ 1d0 (abs plus)))) (finite-p both))
               (return nil))
             (setf (aref centre i) (* 0.5d0 both)))))))

(declaim (inline turn-centre inside-p))
(defun inside-p (place length)
  (declare (double-float place length))
  (<= (abs place) (* 0.5d0 length (+ 1d0 1d-9))))

(define-step fingers :fingers (candidate workspace)
  (let* ((registers (workspace-registers workspace))
         (centre (workspace-centre workspace))
         (lengths (workspace-lengths workspace))
         (grasp (%candidate-grasp candidate))
         (places (grasp-places grasp)))
    (and (execute (grasp-positions grasp) registers)
         (loop for place from 0 below (length places) by 2
               always (let ((axis (aref places place))
                            (register (aref places (1+ place))))
                        (inside-p (+ (aref centre axis) (aref registers register))
                                  (aref lengths axis)))))))

(declaim (inline turn-entries))
(defun turn-entries (program candidate workspace out least)
  "Put the six values of PROGRAM, on the axes of CANDIDATE, into OUT.  NIL if one is not above
LEAST."
  (declare (type program program) (type workspace workspace) (type six out) (double-float least))
  (let ((registers (workspace-registers workspace)))
    (and (execute program registers)
         (loop for axis across (matching-axes (%candidate-matching candidate))
               for register across (program-results program)
               always (let ((entry (aref registers register)))
                        (when (> entry least)
                          (setf (aref out axis) entry)
                          t))))))

(defun turn-both-ways (program candidate workspace)
  "Put the twelve values of PROGRAM, those along the axes of CANDIDATE and those against them, into
the workspace: AHEAD and BEHIND of the axes of the box, and the lesser of both.  NIL if one is not
above 0."
  (declare (type program program) (type workspace workspace))
  (let* ((registers (workspace-registers workspace)) (results (program-results program))
         (matching (%candidate-matching candidate))
         (wrench (workspace-wrench workspace))
         (ahead (workspace-ahead workspace)) (behind (workspace-behind workspace)))
    (and (execute program registers)
         (dotimes (i 6 t)
           (let* ((axis (aref (matching-axes matching) i))
                  (along (aref registers (aref results i)))
                  (against (aref registers (aref results (+ i 6)))))
             (when (minusp (aref (matching-signs matching) (mod i 3)))
               (rotatef along against))
             (setf (aref ahead axis) along
                   (aref behind axis) against
                   (aref wrench axis) (min along against))
             (unless (> (aref wrench axis) 0d0) (return nil)))))))

(declaim (inline both-ways-p))
(defun both-ways-p (candidate)
  "True if the WRENCH of CANDIDATE has an entry for each way along an axis: twelve."
  (declare (type candidate candidate))
  (let ((program (grasp-wrench (%candidate-grasp candidate))))
    (declare (type program program))
    (/= 6 (length (program-results program)))))

(declaim (inline turn-wrench))
(defun turn-wrench (candidate workspace)
  "Put what CANDIDATE exerts into the workspace.  NIL if there is an axis along which it exerts
nothing."
  (declare (type candidate candidate) (type workspace workspace))
  (let ((program (grasp-wrench (%candidate-grasp candidate))))
    (if (both-ways-p candidate)
        (turn-both-ways program candidate workspace)
        (turn-entries program candidate workspace (workspace-wrench workspace) 0d0))))

(define-step (closure :paper) :open (candidate workspace)
  (let ((grasp (%candidate-grasp candidate)))
    (and (turn-wrench candidate workspace)
         (turn-entries (grasp-twist grasp) candidate workspace (workspace-twist workspace)
                       -1d-300))))

(defun turn-centre (workspace matching candidate)
  "Put the grasp centre into CANDIDATE, in the box frame."
  (declare (type workspace workspace) (type matching matching) (type candidate candidate))
  (let ((offset (workspace-offset workspace)))
    (dotimes (i 3)
      (setf (aref offset (aref (matching-axes matching) i))
            (* (aref (matching-signs matching) i) (aref (workspace-centre workspace) i))))
    (setf (%candidate-x candidate) (aref offset 0)
          (%candidate-y candidate) (aref offset 1)
          (%candidate-z candidate) (aref offset 2))
    ;; From here on only the lever arms matter.
    (dotimes (i 3)
      (setf (aref offset i) (abs (aref offset i))))))

(defun choose-sides (candidate workspace)
  "Put what CANDIDATE exerts against the load of its axes into BEARING, and the other way into
COUNTER.  Return BEARING."
  (let ((bearing (workspace-bearing workspace)) (counter (workspace-counter workspace))
        (borne (workspace-spare workspace)))
    (put-borne (workspace-box workspace) (%candidate-x candidate) (%candidate-y candidate)
               (%candidate-z candidate) borne)
    (dotimes (axis 6 bearing)
      (let ((ahead (aref (workspace-ahead workspace) axis))
            (behind (aref (workspace-behind workspace) axis)))
        (when (minusp (aref borne axis))
          (rotatef ahead behind))
        (setf (aref bearing axis) ahead
              (aref counter axis) behind)))))

(declaim (inline bearing-sides))
(defun bearing-sides (candidate workspace)
  "Return what CANDIDATE exerts against the load of its axes, and let the workspace know it."
  (setf (workspace-bears workspace)
        (if (both-ways-p candidate)
            (choose-sides candidate workspace)
            (workspace-wrench workspace))))

(define-step (lifting :paper) :lifting (candidate workspace)
  ;; Each axis may be loaded by a share of what the grasp bears there alone; the shares may not
  ;; exceed 1 together, since the axes use the same friction.  Sound: the six capacities, both ways,
  ;; span a cross-polytope of wrenches that the contacts can exert.
  (let ((load (workspace-load workspace))
        (shares 0d0))
    (declare (double-float shares))
    (turn-centre workspace (%candidate-matching candidate) candidate)
    (put-load (workspace-box workspace) (%candidate-x candidate) (%candidate-y candidate)
              (%candidate-z candidate) load)
    (let ((bearing (bearing-sides candidate workspace)))
      (declare (type six bearing))
      (dotimes (axis 6 (<= shares 1d0))
        (incf shares (/ (aref load axis) (aref bearing axis)))))))

(defun put-spare-both-ways (workspace)
  "Put what BEARING leaves beside the load into SPARE, or COUNTER with gravity's help if that is
less."
  (declare (type workspace workspace))
  (let ((spare (workspace-spare workspace)) (load (workspace-load workspace))
        (bearing (workspace-bearing workspace)) (counter (workspace-counter workspace)))
    (dotimes (axis 6)
      (setf (aref spare axis) (min (- (aref bearing axis) (aref load axis))
                                   (+ (aref counter axis) (aref load axis)))))))

(declaim (inline put-spare))
(defun put-spare (workspace)
  "Put what the candidate exerts beside the load, both ways, into SPARE, and return it."
  (declare (type workspace workspace))
  (let ((spare (workspace-spare workspace)) (load (workspace-load workspace))
        (wrench (workspace-wrench workspace)))
    (if (eq wrench (workspace-bears workspace))
        (dotimes (axis 6)
          (setf (aref spare axis) (- (aref wrench axis) (aref load axis))))
        (put-spare-both-ways workspace))
    spare))

(declaim (inline rate-velocity rate))
(defun rate-velocity (candidate workspace)
  "Put u_t into CANDIDATE, and the axis that limits it."
  (declare (type candidate candidate) (type workspace workspace))
  (shift-velocity (%box-velocity (workspace-box workspace)) (workspace-offset workspace)
                  (workspace-velocity-needs workspace))
  (setf (values (%candidate-velocity-radius candidate) (%candidate-velocity-limit candidate))
        (embedded-radius (workspace-velocity-needs workspace) (workspace-twist workspace))))

(defun rate (candidate workspace radius limit)
  "Put RADIUS, u_w, the axis LIMIT and the quality into CANDIDATE.  True if the last is finite."
  (declare (type candidate candidate) (type workspace workspace) (double-float radius))
  (setf (%candidate-force-radius candidate) radius
        (%candidate-force-limit candidate) limit
        (%candidate-quality candidate)
        (quality-index (workspace-gamma workspace) (%candidate-velocity-radius candidate)
                       (%candidate-velocity-limit candidate) radius limit))
  (finite-p (%candidate-quality candidate)))

(define-step (quality :paper) :open (candidate workspace)
  (shift-force (%box-force (workspace-box workspace)) (workspace-offset workspace)
               (workspace-force-needs workspace))
  (rate-velocity candidate workspace)
  (multiple-value-bind (radius limit)
      (embedded-radius (workspace-force-needs workspace) (put-spare workspace))
    (rate candidate workspace radius limit)))
