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

(defstruct (attempt (:constructor %make-attempt (registers tried)))
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

(defmethod print-object ((attempt attempt) stream)
  (print-unreadable-object (attempt stream :type t)
    (plainly
      (format stream "~@[at ~a~]" (attempt-box attempt)))))

(defun make-attempt (graspbase)
  "Return an attempt with the grasps of GRASPBASE, at no box yet."
  (%make-attempt (copy-seq (graspbase-registers graspbase))
                 (make-array (length (graspbase-grasps graspbase))
                             :element-type '(unsigned-byte 24))))

(defun start-attempt (attempt box gamma)
  "Make ATTEMPT, which may have been used, one at BOX with nothing tried yet.  Return it."
  (declare (type attempt attempt) (type box box))
  (setf (attempt-box attempt) box
        (attempt-gamma attempt) gamma
        (attempt-best attempt) nil
        (aref (attempt-registers attempt) +u+) (%box-u box)
        (aref (attempt-registers attempt) +v+) (%box-v box))
  (fill (attempt-tried attempt) 0)
  attempt)

;;; The steps.  Each returns true if the candidate passes.

(defun place-box (attempt matching)
  "Put the distances of the faces, and which are constrained, into the registers."
  (declare (type attempt attempt) (type matching matching))
  (let* ((registers (attempt-registers attempt))
         (box (attempt-box attempt))
         (size (%box-size box))
         (constrained (%box-constrained box)))
    (dotimes (i 3)
      (let ((length (aref size (aref (matching-axes matching) i))))
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
         (results (program-results (grasp-offset grasp)))
         (centre (attempt-centre attempt)))
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

(defun fingers-on-faces-p (attempt grasp)
  "True if every finger is inside the edges of its face."
  (declare (type attempt attempt))
  (let ((registers (attempt-registers attempt))
        (centre (attempt-centre attempt))
        (lengths (attempt-lengths attempt)))
    (and (execute (grasp-positions grasp) registers)
         (loop with places = (grasp-places grasp)
               for place from 0 below (length places) by 2
               always (let ((axis (aref places place))
                            (register (aref places (1+ place))))
                        (inside-p (+ (aref centre axis) (aref registers register))
                                  (aref lengths axis)))))))

(defun compute-capacities (attempt grasp matching)
  "Put wrench and twist, rotated to X Y Z, into the attempt.  True if the grasp is closed."
  (declare (type attempt attempt) (type matching matching))
  (let ((registers (attempt-registers attempt)))
    (flet ((rotate (program out least)
             (declare (type six out) (double-float least))
             (and (execute program registers)
                  (dotimes (i 6 t)
                    (let ((entry (aref registers (aref (program-results program) i))))
                      (unless (> entry least) (return nil))
                      (setf (aref out (aref (matching-axes matching) i)) entry))))))
      (and (rotate (grasp-wrench grasp) (attempt-wrench attempt) 0d0)
           (rotate (grasp-twist grasp) (attempt-twist attempt) -1d-300)))))

(defun turn-centre (attempt matching candidate)
  "Put the grasp centre into CANDIDATE, in the box frame."
  (declare (type attempt attempt) (type matching matching) (type candidate candidate))
  (let ((offset (attempt-offset attempt)))
    (dotimes (i 3)
      (setf (aref offset (aref (matching-axes matching) i))
            (* (aref (matching-signs matching) i) (aref (attempt-centre attempt) i))))
    (setf (%candidate-x candidate) (aref offset 0)
          (%candidate-y candidate) (aref offset 1)
          (%candidate-z candidate) (aref offset 2))
    ;; From here on only the lever arms matter.
    (dotimes (i 3)
      (setf (aref offset i) (abs (aref offset i))))))

(defun bears-load-p (attempt)
  "Put gravity's load into the attempt.  True if the wrench bears it.
Each axis may be loaded by a share of what the grasp bears there alone; the shares may not exceed 1
together, since the axes use the same friction.  Sound: the six capacities, both ways, span a
cross-polytope of wrenches that the contacts can exert."
  (let ((load (attempt-load attempt))
        (wrench (attempt-wrench attempt))
        (shares 0d0))
    (declare (double-float shares))
    (put-load (%box-weight (attempt-box attempt)) (attempt-offset attempt) load)
    (dotimes (axis 6 (<= shares 1d0))
      (incf shares (/ (aref load axis) (aref wrench axis))))))

(defun rate (attempt candidate)
  "Compute the radii and the quality of CANDIDATE.  True if they are numbers in range."
  (declare (type attempt attempt) (type candidate candidate))
  (let ((box (attempt-box attempt))
        (offset (attempt-offset attempt))
        (spare (attempt-spare attempt)))
    (dotimes (axis 6)
      (setf (aref spare axis)
            (- (aref (attempt-wrench attempt) axis) (aref (attempt-load attempt) axis))))
    (shift-force (%box-force box) offset (attempt-force-needs attempt))
    (shift-velocity (%box-velocity box) offset (attempt-velocity-needs attempt))
    (multiple-value-bind (force-radius force-limit)
        (embedded-radius (attempt-force-needs attempt) spare)
      (multiple-value-bind (velocity-radius velocity-limit)
          (embedded-radius (attempt-velocity-needs attempt) (attempt-twist attempt))
        (setf (%candidate-force-radius candidate) force-radius
              (%candidate-force-limit candidate) force-limit
              (%candidate-velocity-radius candidate) velocity-radius
              (%candidate-velocity-limit candidate) velocity-limit
              (%candidate-quality candidate)
              (quality-index (attempt-gamma attempt) velocity-radius velocity-limit
                             force-radius force-limit))
        (finite-p (%candidate-quality candidate))))))

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
                 (:open (compute-capacities attempt grasp matching))
                 (:lifting (progn (turn-centre attempt matching candidate)
                                  (bears-load-p attempt)))
                 (:open (rate attempt candidate)))
        ;; What has no value fails the step that it stands in.  The steps find it out by themselves;
        ;; where a float trap is enabled, it may come first.
        (arithmetic-error () nil)))))

;;; TRY

(defconstant +tie+ 1d-9 "Qualities that differ by no more are equal.")

(defun try-matching (attempt grasp matching)
  "Try GRASP in MATCHING, and return the candidate."
  (let ((candidate (make-candidate grasp matching)))
    (run-steps attempt candidate)
    (when (eq (%candidate-outcome candidate) :possible)
      (let ((best (attempt-best attempt)))
        (when (or (null best)
                  (> (%candidate-quality candidate) (+ (%candidate-quality best) +tie+)))
          (setf (attempt-best attempt) candidate))))
    candidate))

(defun try-matchings (memory grasp suggested)
  "Try GRASP on the box of the attempt that is the client of MEMORY, in those matchings of the set
SUGGESTED that use no constrained face, and that neither they nor their equivalents were tried
before.  The log of MEMORY gets the candidates."
  (declare (type grasp grasp) (type matching-set suggested))
  (let* ((attempt (memory-client memory))
         (tried (attempt-tried attempt))
         (index (grasp-index grasp))
         (open (logand suggested
                       (aref (grasp-usable grasp) (%box-constrained (attempt-box attempt))))))
    (declare (type attempt attempt) (type matching-set open))
    (loop
      (let ((left (logandc2 open (aref tried index))))
        (declare (type matching-set left))
        (when (zerop left) (return))
        (let ((matching (1- (integer-length (logand left (- left))))))
          (setf (aref tried index) (logior (aref tried index) (aref (grasp-same grasp) matching)))
          (push (try-matching attempt grasp (svref +matchings+ matching))
                (memory-log memory)))))))

;;; The actions

(defun constant-matchings (terms)
  "Return the set of the matchings that give the slots the faces among TERMS, six of them, NIL for
any."
  (reduce #'logand (loop for term in terms
                         for slot from 0
                         when (and term (not (term-variable-p term)))
                           collect (aref +matchings-with+ slot (term-value term 0)))
          :initial-value +all-matchings+))

(defun variable-slots (terms)
  "Return a list of (SLOT . TERM) for those of TERMS, six, that are variables."
  (loop for term in terms
        for slot from 0
        when (and term (term-variable-p term)) collect (cons slot term)))

(defun suggested-matchings (set slots binding)
  "Return those of the matchings SET that give SLOTS, a list of (SLOT . VARIABLE), the faces that the
variables have under BINDING."
  (declare (type matching-set set))
  (loop for (slot . variable) of-type ((integer 0 5) . (integer 0 5)) in slots
        do (setf set (logand set (aref +matchings-with+ slot (term-value variable binding)))))
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
                  (slots (variable-slots terms)))
              (lambda (memory binding)
                (try-matchings memory grasp (suggested-matchings set slots binding))
                nil))))))

(defmethod action-mentions ((verb (eql :try)) operands)
  (and (consp operands) (namep (first operands)) (list (first operands))))

(defmethod describe-action ((verb (eql :try)) action)
  (destructuring-bind (grasp &optional suggestion) (action-operands action)
    (format nil "try ~a~@[ with ~{~a~^, ~}~]" grasp
            (loop for element in suggestion
                  for slot across +slots+
                  unless (name= element "?") collect (format nil "~a = ~a" slot element)))))

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
