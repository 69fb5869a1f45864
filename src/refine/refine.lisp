;;;; refine.lisp -- the third module: the fingers of the best grasps are moved to better places.

(in-package :supergrip)

(defstruct (refinement (:copier nil))
  "What moving the fingers of CANDIDATE, a possible one of PLAN, has gained.  HOME and CONTACTS are
where they were and where they are now, as CANDIDATE-CONTACTS has it; RADIUS-BEFORE and RADIUS are
(LOWER UPPER), the exact radius then and now, LOWER certified or NIL, or NIL where there is none;
RADIUS-BOUND is what no legal placement exceeds; RADIUS-NEARBY what climbing from HOME alone
reached, within 1 %."
  candidate plan home contacts radius-before radius radius-bound radius-nearby)

(defun radius-quality (refinement radius)
  "Return the quality that the candidate of REFINEMENT has with RADIUS, a force radius or NIL, which
is 0."
  (let ((candidate (refinement-candidate refinement)))
    (quality-index (plan-gamma (refinement-plan refinement))
                   (%candidate-velocity-radius candidate) (%candidate-velocity-limit candidate)
                   (max 0d0 (or radius 0d0)) (if (refinement-radius refinement) 0 -1))))

(defun refinement-quality-before (refinement)
  "Return the exact quality of REFINEMENT's grasp as planned: that of its certified exact radius."
  (radius-quality refinement (first (refinement-radius-before refinement))))

(defun refinement-quality (refinement)
  "Return the exact quality of REFINEMENT's grasp with its fingers moved."
  (radius-quality refinement (first (refinement-radius refinement))))

(defun refinement-quality-bound (refinement)
  "Return a quality that REFINEMENT's grasp does not exceed, wherever its fingers legally stand."
  (radius-quality refinement (refinement-radius-bound refinement)))

(defun refinement-moved-p (refinement)
  "True if the fingers of REFINEMENT stand elsewhere than the plan had them."
  (not (eq (refinement-home refinement) (refinement-contacts refinement))))

(defun refinement-shift (refinement)
  "Return how far the middle of the fingers of REFINEMENT moved, along X Y Z, in cm."
  (let ((count (length (refinement-home refinement))))
    (flet ((middle (contacts)
             (mapcar (lambda (sum) (/ sum count))
                     (reduce (lambda (a b) (mapcar #'+ a b)) contacts
                             :key (lambda (contact) (getf contact :position))))))
      (mapcar #'- (middle (refinement-contacts refinement))
              (middle (refinement-home refinement))))))

(define-printing (refinement refinement) "~a (~{~a~^ ~}) Q~,3f -> ~,3f, at most ~,3f"
  (candidate-grasp (refinement-candidate refinement))
  (candidate-matching (refinement-candidate refinement))
  (refinement-quality-before refinement) (refinement-quality refinement)
  (refinement-quality-bound refinement))

;;; The search

(defun start-refining (candidate workspace graspbase)
  "Return the search for better places of the fingers of CANDIDATE, whose figures WORKSPACE holds;
and the unit of its needs."
  (let* ((box (workspace-box workspace))
         (freedom (freedom-of candidate workspace graspbase))
         (unit (reduce #'max (%box-force box)))
         (refining (make-refining
                    :freedom freedom :count (freedom-count freedom)
                    :normals (map 'simple-vector #'face-axis (freedom-faces freedom))
                    :signs (map 'doubles (lambda (face) (float (- (face-sign face)) 1d0))
                                (freedom-faces freedom))
                    :u (%box-friction box) :v (%box-soft-friction box)
                    :need (map 'six (lambda (need) (/ need unit)) (%box-force box))
                    :gravity (gravity-on box) :grip (contacts-grip candidate workspace))))
    (dotimes (axis 6)
      (dolist (way '(1d0 -1d0))
        (let ((motion (make-six)))
          (setf (aref motion axis) way)
          (add-cut refining motion))))
    (values refining unit)))

(defun certify (refining placement)
  "Return the exact radius of REFINING at PLACEMENT, (LOWER UPPER), certified within 0.1 % if
possible, else 0.3 % or 1 %; LOWER is NIL if that is not possible either."
  (let ((best nil))
    (loop for gap in '(1d-3 3d-3 1d-2)
          do (multiple-value-bind (upper lower) (ask refining placement gap (* 0.2d0 gap) 30000)
               (setf best (list lower upper))
               (when lower (return))))
    best))

(defun scan-and-climb (refining placement value)
  "Return PLACEMENT, with the radius VALUE, or a better one, found from a lattice of all legal
placements and then from one of those near the best; and its radius."
  (dolist (part '(1 1/2))
    (multiple-value-bind (other radius) (scan refining part placement value)
      (when (> radius value)
        (multiple-value-bind (other radius) (climb-surely refining other radius)
          (when (> radius value) (setf placement other value radius))))))
  (values placement value))

(defun better-places (refining before gap regions)
  "Return a placement of REFINING that is surely better than the plan's, whose radius is BEFORE, or
NIL; its radius; the bound of all radii; and the radius that climbing from the plan's places
reached."
  (let* ((freedom (r-freedom refining))
         (home (copy-seq (freedom-home freedom)))
         (start (or (make-legal home freedom) (freedom-home freedom))))
    (multiple-value-bind (placement nearby)
        (climb-surely refining start (radius-at refining start -1d300))
      (multiple-value-bind (placement value) (scan-and-climb refining placement nearby)
        (multiple-value-bind (placement value bound)
            (branch-and-bound refining placement value gap regions)
          (declare (ignore value))
          (let ((after (certify refining placement)))
            (values (and (first after) (> (first after) (max 0d0 (second before))) placement)
                    after (max bound (second before) (second after)) nearby)))))))

(defun square-of-way (from to)
  "Return the square of the distance of the places FROM and TO, lists of three."
  (reduce #'+ (mapcar (lambda (a b) (expt (- a b) 2)) from to)))

(defun untangle (places contacts)
  "Exchange PLACES, a vector, of CONTACTS on the same face while that shortens the ways of two
fingers together, so that they do not cross.  Return PLACES."
  (flet ((shorter-exchanged-p (a one b other)
           (let ((a (getf a :position)) (b (getf b :position)))
             (< (+ (square-of-way a other) (square-of-way b one))
                (- (+ (square-of-way a one) (square-of-way b other)) +tie+)))))
    (loop while (loop for (a . others) on contacts
                      for i from 0
                      thereis (loop for b in others
                                    for j from (1+ i)
                                    when (and (equal (getf a :surface) (getf b :surface))
                                              (shorter-exchanged-p a (aref places i)
                                                                   b (aref places j)))
                                      do (rotatef (aref places i) (aref places j))
                                         (return t)))
          finally (return places))))

(defun placed-contacts (contacts placement)
  "Return CONTACTS, plists, at PLACEMENT.  Fingers on one face are alike: which of them takes which
place there is chosen so that their ways are short."
  (let ((places (coerce (loop for place from 0 below (length placement) by 3
                              collect (map 'list #'without-sign-of-zero
                                           (subseq placement place (+ place 3))))
                        'vector)))
    (loop for contact in (mapcar #'copy-list contacts)
          for place across (untangle places contacts)
          do (setf (getf contact :position) place)
          collect contact)))

(defun refine-candidate (candidate plan gap regions)
  "Return the REFINEMENT of CANDIDATE, a possible one of PLAN."
  (with-replay (workspace candidate plan)
    (let* ((home (candidate-contacts candidate plan))
           (refinement (make-refinement :candidate candidate :plan plan :home home :contacts home)))
      (when (refinable-p candidate workspace)
        (multiple-value-bind (refining unit)
            (start-refining candidate workspace (knowledge-graspbase (plan-knowledge plan)))
          (flet ((in-units (radius) (mapcar (lambda (r) (and r (/ r unit))) radius)))
            (let ((before (certify refining (freedom-home (r-freedom refining)))))
              (multiple-value-bind (placement after bound nearby)
                  (better-places refining before gap regions)
                (when placement
                  (setf (refinement-contacts refinement) (placed-contacts home placement)))
                (setf (refinement-radius-before refinement) (in-units before)
                      (refinement-radius refinement) (in-units (if placement after before))
                      (refinement-radius-bound refinement) (/ bound unit)
                      (refinement-radius-nearby refinement) (/ nearby unit)))))))
      refinement)))

(defun refinable-p (candidate workspace)
  "True if CANDIDATE, whose figures WORKSPACE holds, has an exact radius that can be computed."
  (let ((box (workspace-box workspace)))
    (and (some #'plusp (%box-force box))
         (computable-p (contacts-grip candidate workspace) (gravity-on box)))))

(defun best-first (refinements)
  "Return REFINEMENTS, which are in the order of their plan, by quality.  Proofs of radii hardly
tell qualities within 0.1 % apart: of those of the best, the first in the plan comes first."
  (let* ((sorted (stable-sort (copy-list refinements) #'> :key #'refinement-quality))
         (best (find-if (lambda (refinement)
                          (>= (refinement-quality refinement)
                              (* 0.999d0 (refinement-quality (first sorted)))))
                        refinements)))
    (and best (cons best (remove best sorted)))))

(defun refine-grasps (plan &key (count 3) (gap 0.02d0) (regions 1000))
  "Return the REFINEMENTs of the COUNT best grasps of PLAN, the best first: see REFINE."
  (unless (typep count '(integer 1))
    (refuse-argument "count is ~a, but must be how many grasps to refine, 1 or more"
                     (form-text count)))
  (unless (typep regions '(and fixnum (integer 0)))
    (refuse-argument "regions is ~a, but must be a number of regions, such as 1000"
                     (form-text regions)))
  (unless (and (realp gap) (as-double gap) (<= 0 gap 1))
    (refuse-argument "gap is ~a, but must be a number from 0 to 1, such as 0.02" (form-text gap)))
  (let ((refinements (without-float-traps
                       (loop for candidate in (best-grasps (need-plan plan) count)
                             collect (refine-candidate candidate plan (as-double gap) regions)))))
    (best-first refinements)))

(defun plan-and-keys (arguments function)
  "Return the plan that ARGUMENTS, those of FUNCTION, begin with, or else the last one; and the keys
after it."
  (let ((given (and arguments (not (keywordp (first arguments))))))
    (values (if given (first arguments) (last-plan))
            (checked-keys (if given (rest arguments) arguments) function '(:count :gap :regions)
                          (plain-text "(~(~a~) plan :count 1)" function)))))

(defun refine (&rest arguments)
  "(REFINE [PLAN] &KEY COUNT GAP REGIONS): move the fingers of the best grasps of PLAN, by default
the last one, so that their exact quality is as great as possible, and return the best REFINEMENT,
or NIL if the plan has no grasp.  The second value is the list of all, the best first.  Of qualities
within 0.1 % of the best, the plan's order decides which is the best.  COUNT is how many grasps, 3
by default; GAP is 0.02 by default, REGIONS 1000.

The exact quality is Q with the exact radius (see EXACT-RADIUS) in the place of u_w; u_t, a
judgement of the grasp, stays.  Fingers stay on their faces and within what hand and faces allow.
They move only if the new places are surely better: the certified radius of the new places is above
the upper value of the old ones.  The search ends when it is proved that no places are better by
more than the share GAP, or after REGIONS regions of places."
  (multiple-value-bind (plan keys) (plan-and-keys arguments 'refine)
    (let ((refinements (apply #'refine-grasps plan keys)))
      (values (first refinements) refinements))))
