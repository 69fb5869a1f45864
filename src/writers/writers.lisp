;;;; writers.lisp -- formats of other programs, one row each; and what they have in common.
;;;;
;;;; A writer makes a text of a box and its grasps, in metres and newtons, in the frame of the box.
;;;; It takes them from the plan, which counts in cm and finger forces, whatever the units of the
;;;; box are.

(in-package :supergrip)

(defstruct (writer (:copier nil))
  "A format.  NAME is a keyword, KIND what its output is called.  TEXT is a function of the name of
a box, its grasps, candidates, the best first, its plan, and why there are none, a string.  Without
grasps PLAN may be NIL."
  (name nil :type keyword :read-only t)
  (kind nil :type string :read-only t)
  (text nil :type function :read-only t))

(defvar *writers* '() "The rows that DEFINE-WRITER has defined, in order.")

(defun add-writer (writer)
  (setf *writers* (with-row writer *writers* #'writer-name)))

(defmacro define-writer (name kind (box-name grasps plan reason) &body body)
  "Define the format NAME, a keyword, whose output is called KIND.  BODY returns the text, as
WRITER says."
  `(add-writer (make-writer :name ,name :kind ,kind
                            :text (lambda (,box-name ,grasps ,plan ,reason)
                                    (declare (ignorable ,plan ,reason))
                                    ,@body))))

(defun find-writer (name)
  "Return the writer NAME, a keyword, or NIL."
  (find name *writers* :key #'writer-name))

(defun written-plan (writer plan most)
  "Return the text of WRITER for the box of PLAN and its possible grasps, at most MOST of them; NIL
for all."
  (funcall (writer-text writer) (box-name (plan-box plan)) (best-grasps plan most) plan
           (plan-reason plan)))

(defun written-mistake (writer name reason)
  "Return the text of WRITER for a box that can't be used, because of REASON."
  (funcall (writer-text writer) name '() nil reason))

;;; Units

(defun gripper-number (plan name default)
  "Return the dimension NAME, a string, of the gripper of PLAN, or DEFAULT if it has none."
  (let ((entry (assoc name (knowledge-gripper (plan-knowledge plan)) :test #'string=)))
    (if entry (cdr entry) default)))

(defun finger-newtons (plan)
  "Return the greatest normal force of a finger in newtons, or NIL if the gripper does not say."
  (gripper-number plan "FINGER-FORCE" nil))

(defun metres (lengths)
  "Return LENGTHS, a list in cm, in metres."
  (mapcar (lambda (length) (/ length 100d0)) lengths))

;;; The palm's frame

(defun hand-matrix (hand candidate)
  "Return the columns x y z of the frame of HAND, that of CANDIDATE, in the frame of the box."
  (let ((x (getf hand :closing)) (z (candidate-approach candidate)))
    (list x (mapcar #'without-sign-of-zero (cross-product z x)) z)))

(defun palm-position (hand candidate plan)
  "Return the origin of the palm's frame of CANDIDATE of PLAN with HAND, in metres: PALM-DEPTH of
the gripper, 0 if it has none, behind the grasp centre."
  (let ((depth (gripper-number plan "PALM-DEPTH" 0d0)))
    (metres (mapcar (lambda (place part) (- place (* depth part)))
                    (getf hand :position) (candidate-approach candidate)))))

(defun palm-inside (candidate plan)
  "Return how deep, in cm, the palm's frame of CANDIDATE of PLAN lies in the box; 0 if it does not,
or if the gripper does not name PALM-DEPTH."
  (let ((approach (candidate-approach candidate)) (depth (gripper-number plan "PALM-DEPTH" 0d0)))
    (if (zerop depth)
        0d0
        (max 0d0 (- (loop for size in (box-size (plan-box plan))
                          for centre in (candidate-offset candidate)
                          for part in approach
                          sum (* part (+ (* 0.5d0 size part) centre)))
                    depth)))))

(defun palms-inside-text (grasps plan)
  "Return in words how many of GRASPS of PLAN have their palm in the box, or NIL if none has."
  (let* ((depths (loop for grasp in grasps collect (palm-inside grasp plan)))
         (inside (count-if (lambda (depth) (> depth 1d-6)) depths)))
    (when (plusp inside)
      (format nil "~d of ~d palm~:p ~[~;lies~:;lie~] inside the box, up to ~a cm deep: fingers ~
                   reach deeper than the PALM-DEPTH of the gripper, ~a cm"
              inside (length grasps) inside (number-text (reduce #'max depths))
              (number-text (gripper-number plan "PALM-DEPTH" 0d0))))))

(defun grasp-words (candidate)
  "Return the name of the grasp of CANDIDATE, and its matching."
  (format nil "~a ~{~a~^ ~}" (candidate-grasp candidate) (candidate-matching candidate)))
