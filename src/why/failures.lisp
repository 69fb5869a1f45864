;;;; failures.lisp -- why a candidate failed, and why a box can't be grasped, with the figures.

(in-package :supergrip)

(defun describe-offset-failure (candidate workspace)
  (if (has-value-p (grasp-offset (%candidate-grasp candidate)) (workspace-registers workspace))
      "OFFSET's entries for two opposite faces are not opposite numbers"
      "the fingers can't reach: a root or a quotient of OFFSET has no value"))

(defun overhangs (candidate workspace)
  "Return a list of (SHORTFALL GRASP-FACE AXIS PLACE LENGTH), one for each coordinate of a finger of
CANDIDATE that is beyond an edge of its face, the worst first; :NONE if a form has no value."
  (let* ((grasp (%candidate-grasp candidate))
         (registers (workspace-registers workspace)))
    (if (has-value-p (grasp-positions grasp) registers)
        (stable-sort
         (loop for (grasp-face p q) in (grasp-contacts grasp)
               append (loop for axis in (remove (floor grasp-face 2) '(0 1 2))
                            for register in (list p q)
                            for place = (+ (aref (workspace-centre workspace) axis)
                                           (aref registers register))
                            for length = (aref (workspace-lengths workspace) axis)
                            unless (inside-p place length)
                              collect (list (relative-difference (abs place) (* 0.5d0 length))
                                            grasp-face axis place length)))
         #'> :key #'first)
        :none)))

(defun describe-finger-failure (candidate workspace)
  "Return which finger of CANDIDATE would stand farthest beyond an edge, and where."
  (let ((overhangs (overhangs candidate workspace)))
    (if (consp overhangs)
        (destructuring-bind (shortfall grasp-face axis place length) (first overhangs)
          (declare (ignore shortfall))
          (destructuring-bind (place edge)
              (texts-in-units :length place (* (signum place) 0.5d0 length))
            (format nil "a finger on ~a would stand at ~a along ~a, beyond the edge at ~a"
                    (face-of grasp-face (%candidate-matching candidate)) (with-unit place :length)
                    (char "NOA" axis) edge)))
        "a form of CONTACTS has no value")))

(defun closed-at-p (grasp registers u)
  "True if GRASP is closed at friction U, the rest as in REGISTERS."
  (setf (aref registers +u+) u)
  (and (has-value-p (grasp-wrench grasp) registers)
       (loop for register across (program-results (grasp-wrench grasp))
             always (> (aref registers register) 0d0))))

(defun entries-closed-at (candidate workspace)
  "Return a function of a friction: true if, with it, the WRENCH entries of CANDIDATE close it."
  (let ((registers (copy-seq (workspace-registers workspace))))
    (lambda (u) (closed-at-p (%candidate-grasp candidate) registers u))))

(defun contacts-closed-at (candidate workspace)
  "Return a function of a friction: true if, with it, the contacts of CANDIDATE are closed."
  (lambda (u) (grip-closed-p (contacts-grip candidate workspace u))))

(defun closing-friction (u closed-at)
  "Return the least friction above U that closes a grasp, or NIL; and the greatest that does not.
CLOSED-AT tells of a friction whether it does."
  (let ((low u)
        (high (max 1d0 (* 2 u))))
    (loop until (or (funcall closed-at high) (> high 100d0))
          do (setf high (* 2 high)))
    (when (funcall closed-at high)
      (loop repeat 40
            do (let ((middle (/ (+ low high) 2)))
                 (if (funcall closed-at middle)
                     (setf high middle)
                     (setf low middle))))
      (values high low))))

(defun lesser-closing-friction (u closed-at)
  "Return a friction below U that closes a grasp, or NIL.  More friction only helps; but forms may
say otherwise, and next to very much of it a finger's pressing counts for nothing."
  (find-if (lambda (less) (and (< less u) (funcall closed-at less))) '(100d0 10d0 1d0 0.5d0)))

(defun describe-open (workspace closed-at)
  "Return why a candidate is open, whose figures WORKSPACE holds; CLOSED-AT as for
CLOSING-FRICTION."
  (let ((u (%box-friction (workspace-box workspace))))
    (if (funcall closed-at u)
        "a form of TWIST, or the index, has no value in range"
        (multiple-value-bind (needed too-little) (closing-friction u closed-at)
          (let ((less (and (not needed) (lesser-closing-friction u closed-at))))
            (cond (needed
                   (apply #'format nil
                          "open: the contacts don't close on this shape; needs u > ~a, has ~a"
                          (number-texts too-little u)))
                  (less
                   (apply #'format nil
                          "open: the contacts don't close on this shape with u of ~a; ~
                           with ~a they do"
                          (number-texts u less)))
                  (t "open: the contacts don't close on this shape with any friction")))))))

(defun bounded (number)
  "Return NUMBER, or the greatest double if it is infinite: a replay traps nothing."
  (min number most-positive-double-float))

(defun bounded-ratio (a b)
  (bounded (/ a b)))

(defun load-shares (workspace)
  "Return the shares, six, that the load takes of what the grasp bears alone on each axis."
  (declare (type workspace workspace))
  (loop for load across (workspace-load workspace)
        for borne across (workspace-bears workspace)
        collect (min (/ load borne) most-positive-double-float)))

(defun total-share (shares)
  "Return the sum of SHARES, doubles, at most the greatest double."
  (let ((sum 0d0))
    (declare (double-float sum))
    (dolist (share shares (bounded sum))
      (incf sum (the double-float share)))))

(defun describe-lifting-failure (workspace)
  "Return in words that the load is too much: on one axis, or on several together."
  (let* ((shares (load-shares workspace))
         (worst (reduce #'max shares))
         (axis (position worst shares)))
    (if (> worst 1)
        (destructuring-bind (load bears)
            (texts-in-units (axis-measure axis) (bounded (aref (workspace-load workspace) axis))
                            (aref (workspace-bears workspace) axis))
          (format nil "it can't hold the weight: the load ~a is ~a, the grasp bears ~a"
                  (axis-name axis) (with-unit load (axis-measure axis)) bears))
        (format nil "it can't hold the weight: the load takes ~{~a of what the grasp bears ~a~^, ~
                     ~}, together ~a; the axes share the same friction, so the sum may be at most 1"
                (loop for share in shares for axis from 0
                      when (plusp share) collect (number-text share) and collect (axis-name axis))
                (first (number-texts (total-share shares) 1))))))

(defun friction-shortfall (workspace closed-at least)
  "Return by how much the friction of the box of WORKSPACE misses what closes a grasp, relative; 1
if nothing does, or if it is no less than LEAST, unless that is NIL.  CLOSED-AT as for
CLOSING-FRICTION."
  (let* ((u (%box-friction (workspace-box workspace)))
         (needed (and (or (null least)
                          ;; One look here saves most of the searches.
                          (funcall closed-at (bounded-ratio u (- 1 (- least +tie+)))))
                      (closing-friction u closed-at))))
    (if needed (- 1 (/ u needed)) 1)))

(defun held-share (candidate workspace)
  "Return which part of the weight, 0 to 1, the contacts of CANDIDATE hold, and a motion in which
they can do no more."
  (let ((gravity (gravity-on (workspace-box workspace))))
    (multiple-value-bind (share witness)
        (grip-entry (contacts-grip candidate workspace) (map 'six #'- gravity))
      (values (min 1d0 share) witness))))

(defun describe-drop (candidate workspace)
  "Return in words that the contacts of CANDIDATE can't hold the weight, and how the box gives way."
  (let ((weight (in-units (%box-weight (workspace-box workspace)) :force)))
    (multiple-value-bind (share witness) (held-share candidate workspace)
      (format nil "it can't hold the weight: the load is ~a, the contacts bear ~:[no ~
                   weight~;~:*~a~] in this direction; the box would give way, ~a"
              (with-unit (number-text weight) :force)
              (and (plusp share) (number-text (* share weight)))
              (motion-text (map 'vector #'- witness) "moving" "turning")))))

(defun finger-shortfall (candidate workspace)
  "Return by how much a finger of CANDIDATE is beyond an edge, relative; 1 if a form has no value."
  (let ((overhangs (overhangs candidate workspace)))
    (if (consp overhangs) (first (first overhangs)) 1)))

(defun condition-shortfalls (candidate workspace)
  "Return by how much CANDIDATE misses its conditions, the worst first.  One that one clear thing
prevents is nearer than any other: its list begins with 0, not 1."
  (let ((faults (candidate-faults candidate workspace)))
    (list* (if (clear-p faults) 0 1)
           (or (mapcar #'fault-shortfall faults) '(1)))))

;;; One row for each outcome

(defgeneric failure-text (outcome index candidate workspace)
  (:documentation "Return why CANDIDATE, whose figures WORKSPACE holds, has OUTCOME by INDEX, a
keyword: a sentence.")
  (:method (outcome index candidate workspace)
    (declare (ignore index candidate workspace))
    (format nil "it fails the step ~a" outcome)))

(defgeneric failure-shortfalls (outcome index candidate workspace least)
  (:documentation "Return by how much CANDIDATE, whose figures WORKSPACE holds, missed the step of
OUTCOME by INDEX, a keyword: a list to compare by MISSES-LESS-P.  Each number is 0 to 1, relative; 1
where that can't be said.  A number may be 1, too, if it is no less than LEAST, unless that is
NIL.")
  (:method (outcome index candidate workspace least)
    (declare (ignore outcome index candidate workspace least))
    '(1)))

(defmacro define-failure (outcome (candidate workspace &optional (least (gensym)))
                          &key why shortfalls)
  "Say of the candidates that have OUTCOME, a keyword (see DEFINE-STEP): WHY, a form that returns a
sentence, and SHORTFALLS, one that returns a list (see FAILURE-SHORTFALLS).  OUTCOME may be (OUTCOME
INDEX), if that is so by one index only."
  (destructuring-bind (outcome &optional index) (if (listp outcome) outcome (list outcome))
    (let ((specializers `((outcome (eql ,outcome)) ,(if index `(index (eql ,index)) 'index))))
      `(progn
         (defmethod failure-text (,@specializers ,candidate ,workspace)
           (declare (ignorable index ,candidate ,workspace))
           ,why)
         ,@(when shortfalls
             `((defmethod failure-shortfalls (,@specializers ,candidate ,workspace ,least)
                 (declare (ignorable index ,candidate ,workspace ,least))
                 ,shortfalls)))))))

(define-failure :conditions (candidate workspace)
  :why (describe-condition-failure candidate workspace)
  :shortfalls (condition-shortfalls candidate workspace))

(define-failure :offset (candidate workspace)
  :why (describe-offset-failure candidate workspace))

(define-failure :fingers (candidate workspace)
  :why (describe-finger-failure candidate workspace)
  :shortfalls (list (finger-shortfall candidate workspace)))

(define-failure (:open :paper) (candidate workspace least)
  :why (if (has-value-p (grasp-wrench (%candidate-grasp candidate)) (workspace-registers workspace))
           (describe-open workspace (entries-closed-at candidate workspace))
           "a form of WRENCH has no value")
  :shortfalls (list (friction-shortfall workspace (entries-closed-at candidate workspace) least)))

(define-failure (:lifting :paper) (candidate workspace)
  :why (describe-lifting-failure workspace)
  :shortfalls (list (- 1 (/ (total-share (load-shares workspace))))))

(define-failure (:open :exact) (candidate workspace least)
  :why (describe-open workspace (contacts-closed-at candidate workspace))
  :shortfalls (list (friction-shortfall workspace (contacts-closed-at candidate workspace) least)))

(define-failure (:lifting :exact) (candidate workspace)
  :why (describe-drop candidate workspace)
  :shortfalls (list (- 1 (held-share candidate workspace))))

(defun candidate-failure (candidate &optional (plan *plan*))
  "Return why CANDIDATE of PLAN is not possible: the step (see CANDIDATE-OUTCOME) and a sentence
with the figures.  NIL if it is possible."
  (let ((outcome (candidate-outcome candidate)))
    (unless (eq outcome :possible)
      (with-replay (workspace candidate plan)
        (values outcome
                (plainly (failure-text outcome (plan-index plan) candidate workspace)))))))

;;; The nearest miss

(defun misses-less-p (a b)
  "True if the SHORTFALLS A are less than B: the first that differ decide, or else that A are
fewer."
  (cond ((null b) nil)
        ((null a) t)
        ((< (first a) (- (first b) +tie+)) t)
        ((> (first a) (+ (first b) +tie+)) nil)
        (t (misses-less-p (rest a) (rest b)))))

(defun farthest (candidates)
  "Return those of CANDIDATES that failed the last step that one of them failed."
  (loop for step in (reverse (step-outcomes))
        thereis (loop for candidate in candidates
                      when (eq step (candidate-outcome candidate)) collect candidate)))

(defun nearest-miss (candidates plan)
  "Return the one of CANDIDATES of PLAN that got farthest; of several, the one that missed by
least."
  (let* ((farthest (farthest candidates))
         (best (first farthest)) (least nil))
    (when (rest farthest)
      (with-workspace (workspace plan)
        (dolist (candidate farthest)
          (let ((shortfalls (failure-shortfalls (candidate-outcome candidate) (plan-index plan)
                                                candidate
                                                (replay candidate workspace) (first least))))
            (when (or (null least) (misses-less-p shortfalls least))
              (setf best candidate least shortfalls))))))
    best))

(defun miss-text (candidate plan)
  "Return why CANDIDATE, the nearest miss of PLAN, is not possible."
  (with-replay (workspace candidate plan)
    (or (and (eq (candidate-outcome candidate) :conditions)
             (too-wide-text candidate workspace))
        (failure-text (candidate-outcome candidate) (plan-index plan) candidate workspace))))
