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

(defmethod print-object ((candidate candidate) stream)
  (print-unreadable-object (candidate stream :type t)
    (plainly
      (format stream "~a (~{~a~^ ~}) ~:[~a~;Q=~*~,3f~]" (grasp-name (%candidate-grasp candidate))
              (matching-names (%candidate-matching candidate))
              (eq (%candidate-outcome candidate) :possible) (%candidate-outcome candidate)
              (%candidate-quality candidate)))))

(defun make-six () (make-array 6 :element-type 'double-float :initial-element 0d0))
(defun make-three () (make-array 3 :element-type 'double-float :initial-element 0d0))

(defstruct (workspace (:constructor %make-workspace (registers tried)))
  "All that trying grasps on one box needs and leaves: the registers, what was tried of each grasp
(a set of matchings), and the BEST candidate.  The arrays are the current candidate's, in the box
frame: WRENCH and TWIST what the grasp can do, LOAD what gravity asks, SPARE what it leaves of
WRENCH, FORCE-NEEDS and VELOCITY-NEEDS what the task asks at the grasp centre."
  (box nil :type (or null box)) (gamma 0.5d0 :type double-float)
  (registers nil :type registers)
  (tried nil :type (simple-array (unsigned-byte 24) (*)))
  (best nil)
  (lengths (make-three) :type three) (centre (make-three) :type three)
  (offset (make-three) :type three)
  (wrench (make-six) :type six) (twist (make-six) :type six)
  (load (make-six) :type six) (spare (make-six) :type six)
  (force-needs (make-six) :type six) (velocity-needs (make-six) :type six))

(defmethod print-object ((workspace workspace) stream)
  (print-unreadable-object (workspace stream :type t)
    (plainly
      (format stream "~@[at ~a~]" (workspace-box workspace)))))

(defun make-workspace (graspbase)
  "Return an workspace with the grasps of GRASPBASE, at no box yet."
  (%make-workspace (copy-seq (graspbase-registers graspbase))
                 (make-array (length (graspbase-grasps graspbase))
                             :element-type '(unsigned-byte 24))))

(defun start-workspace (workspace box gamma)
  "Make WORKSPACE, which may have been used, one at BOX with nothing tried yet.  Return it."
  (declare (type workspace workspace) (type box box))
  (setf (workspace-box workspace) box
        (workspace-gamma workspace) gamma
        (workspace-best workspace) nil
        (aref (workspace-registers workspace) +u+) (%box-friction box)
        (aref (workspace-registers workspace) +v+) (%box-soft-friction box))
  (fill (workspace-tried workspace) 0)
  workspace)

;;; The steps.  Each returns true if the candidate passes.

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

(defun find-centre (workspace grasp)
  "Put the grasp centre, in the grasp frame from the box centre, into the workspace.
Entries for opposite faces say the same shift, so they must be opposite numbers."
  (declare (type workspace workspace))
  (let* ((registers (workspace-registers workspace))
         (results (program-results (grasp-offset grasp)))
         (centre (workspace-centre workspace)))
    (and (execute (grasp-offset grasp) registers)
         (dotimes (i 3 t)
           (let* ((plus (aref registers (aref results (* 2 i))))
                  (minus (aref registers (aref results (1+ (* 2 i)))))
                  (both (- plus minus)))
             (unless (and (<= (abs (+ plus minus)) (* 1d-9 (+ 1d0 (abs plus)))) (finite-p both))
               (return nil))
             (setf (aref centre i) (* 0.5d0 both)))))))

(declaim (inline inside-p))
(defun inside-p (place length)
  (declare (double-float place length))
  (<= (abs place) (* 0.5d0 length (+ 1d0 1d-9))))

(defun fingers-on-faces-p (workspace grasp)
  "True if every finger is inside the edges of its face."
  (declare (type workspace workspace))
  (let ((registers (workspace-registers workspace))
        (centre (workspace-centre workspace))
        (lengths (workspace-lengths workspace)))
    (and (execute (grasp-positions grasp) registers)
         (loop with places = (grasp-places grasp)
               for place from 0 below (length places) by 2
               always (let ((axis (aref places place))
                            (register (aref places (1+ place))))
                        (inside-p (+ (aref centre axis) (aref registers register))
                                  (aref lengths axis)))))))

(defun compute-capacities (workspace grasp matching)
  "Put wrench and twist, rotated to X Y Z, into the workspace.  True if the grasp is closed."
  (declare (type workspace workspace) (type matching matching))
  (let ((registers (workspace-registers workspace)))
    (flet ((rotate (program out least)
             (declare (type six out) (double-float least))
             (and (execute program registers)
                  (dotimes (i 6 t)
                    (let ((entry (aref registers (aref (program-results program) i))))
                      (unless (> entry least) (return nil))
                      (setf (aref out (aref (matching-axes matching) i)) entry))))))
      (and (rotate (grasp-wrench grasp) (workspace-wrench workspace) 0d0)
           (rotate (grasp-twist grasp) (workspace-twist workspace) -1d-300)))))

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

(defun bears-load-p (workspace)
  "Put gravity's load into the workspace.  True if the wrench bears it.
Each axis may be loaded by a share of what the grasp bears there alone; the shares may not exceed 1
together, since the axes use the same friction.  Sound: the six capacities, both ways, span a
cross-polytope of wrenches that the contacts can exert."
  (let ((load (workspace-load workspace))
        (wrench (workspace-wrench workspace))
        (shares 0d0))
    (declare (double-float shares))
    (put-load (%box-weight (workspace-box workspace)) (workspace-offset workspace) load)
    (dotimes (axis 6 (<= shares 1d0))
      (incf shares (/ (aref load axis) (aref wrench axis))))))

(defun rate (workspace candidate)
  "Compute the radii and the quality of CANDIDATE.  True if they are numbers in range."
  (declare (type workspace workspace) (type candidate candidate))
  (let ((box (workspace-box workspace))
        (offset (workspace-offset workspace))
        (spare (workspace-spare workspace)))
    (dotimes (axis 6)
      (setf (aref spare axis)
            (- (aref (workspace-wrench workspace) axis) (aref (workspace-load workspace) axis))))
    (shift-force (%box-force box) offset (workspace-force-needs workspace))
    (shift-velocity (%box-velocity box) offset (workspace-velocity-needs workspace))
    (multiple-value-bind (force-radius force-limit)
        (embedded-radius (workspace-force-needs workspace) spare)
      (multiple-value-bind (velocity-radius velocity-limit)
          (embedded-radius (workspace-velocity-needs workspace) (workspace-twist workspace))
        (setf (%candidate-force-radius candidate) force-radius
              (%candidate-force-limit candidate) force-limit
              (%candidate-velocity-radius candidate) velocity-radius
              (%candidate-velocity-limit candidate) velocity-limit
              (%candidate-quality candidate)
              (quality-index (workspace-gamma workspace) velocity-radius velocity-limit
                             force-radius force-limit))
        (finite-p (%candidate-quality candidate))))))

(defun run-steps (workspace candidate)
  "Take CANDIDATE through the steps; its OUTCOME is the one it failed, or :POSSIBLE."
  (declare (type candidate candidate))
  (let ((grasp (%candidate-grasp candidate))
        (matching (%candidate-matching candidate)))
    (macrolet ((steps (&rest steps)
                 `(and ,@(loop for (outcome step) in steps
                               collect `(progn (setf (%candidate-outcome candidate) ,outcome) ,step))
                       (setf (%candidate-outcome candidate) :possible))))
      (handler-case
          (steps (:conditions (progn (place-box workspace matching)
                                     (execute (grasp-conditions grasp)
                                          (workspace-registers workspace))))
                 (:offset (find-centre workspace grasp))
                 (:fingers (fingers-on-faces-p workspace grasp))
                 (:open (compute-capacities workspace grasp matching))
                 (:lifting (progn (turn-centre workspace matching candidate)
                                  (bears-load-p workspace)))
                 (:open (rate workspace candidate)))
        ;; What has no value fails the step that it stands in.  The steps find it out by themselves;
        ;; where a float trap is enabled, it may come first.
        (arithmetic-error () nil)))))

;;; TRY

(defconstant +tie+ 1d-9 "Qualities that differ by no more are equal.")

(defun try-matching (workspace grasp matching)
  "Try GRASP in MATCHING, and return the candidate."
  (let ((candidate (make-candidate grasp matching)))
    (run-steps workspace candidate)
    (when (eq (%candidate-outcome candidate) :possible)
      (let ((best (workspace-best workspace)))
        (when (or (null best)
                  (> (%candidate-quality candidate) (+ (%candidate-quality best) +tie+)))
          (setf (workspace-best workspace) candidate))))
    candidate))

(defun try-matchings (memory grasp suggested)
  "Try GRASP on the box of the workspace that is the client of MEMORY, in those matchings of the set
SUGGESTED that use no constrained face, and that neither they nor their equivalents were tried
before.  The log of MEMORY gets the candidates."
  (declare (type grasp grasp) (type matching-set suggested))
  (let* ((workspace (memory-client memory))
         (tried (workspace-tried workspace))
         (index (grasp-index grasp))
         (open (logand suggested
                       (aref (grasp-usable grasp) (%box-constrained (workspace-box workspace))))))
    (declare (type workspace workspace) (type matching-set open))
    (loop
      (let ((left (logandc2 open (aref tried index))))
        (declare (type matching-set left))
        (when (zerop left) (return))
        (let ((matching (1- (integer-length (logand left (- left))))))
          (setf (aref tried index) (logior (aref tried index) (aref (grasp-same grasp) matching)))
          (push (try-matching workspace grasp (svref +matchings+ matching))
                (memory-log memory)))))))

;;; The actions

(defun constant-matchings (terms)
  "Return the set of the matchings that give the grasp-faces the faces among TERMS, six of them, NIL for
any."
  (reduce #'logand (loop for term in terms
                         for grasp-face from 0
                         when (and term (not (term-variable-p term)))
                           collect (aref +matchings-with+ grasp-face (term-value term 0)))
          :initial-value +all-matchings+))

(defun variable-faces (terms)
  "Return a list of (GRASP-FACE . TERM) for those of TERMS, six, that are variables."
  (loop for term in terms
        for grasp-face from 0
        when (and term (term-variable-p term)) collect (cons grasp-face term)))

(defun suggested-matchings (set grasp-faces binding)
  "Return those of the matchings SET that give GRASP-FACES, a list of (GRASP-FACE . VARIABLE), the faces that the
variables have under BINDING."
  (declare (type matching-set set))
  (loop for (grasp-face . variable) of-type ((integer 0 5) . (integer 0 5)) in grasp-faces
        do (setf set (logand set (aref +matchings-with+ grasp-face (term-value variable binding)))))
  set)

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
      (when (zerop (constant-matchings terms))
        (complain (action-form action) '(:warning "no matching has these faces in these places: N O ~
                                                   A is a proper rotation of X Y Z")))
      (setf (action-target action) grasp
            (action-terms action) terms
            (action-function action)
            (let ((set (constant-matchings terms))
                  (grasp-faces (variable-faces terms)))
              (lambda (memory binding)
                (try-matchings memory grasp (suggested-matchings set grasp-faces binding))
                nil))))))

(defmethod action-mentions ((verb (eql :try)) operands)
  (and (consp operands) (namep (first operands)) (list (first operands))))

(defmethod describe-action ((verb (eql :try)) action)
  (destructuring-bind (grasp &optional suggestion) (action-operands action)
    (format nil "try ~a~@[ with ~{~a~^, ~}~]" grasp
            (loop for element in suggestion
                  for grasp-face across +grasp-faces+
                  unless (name= element "?") collect (format nil "~a = ~a" grasp-face element)))))

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

(defmethod describe-action ((verb (eql :keep)) action)
  (declare (ignore action))
  "keep the best grasp, and stop")
