;;;; try.lisp -- TRY: a grasp is tried in each matching that may be possible.
;;;;
;;;; TRY-MATCHINGS is the paper's function: rules call it, and so does TRY when it is typed.
;;;; The suggestion and the constrained faces rule some matchings out.  TRY takes each of the
;;;; others, in order, through the steps of try-steps.lisp.

(in-package :supergrip)

(defconstant +tie+ 1d-9 "Qualities that differ by no more are equal.")

(defun try-matching (workspace grasp matching)
  "Try GRASP in MATCHING, and return the candidate."
  (let ((candidate (make-candidate grasp matching)))
    (run-steps workspace candidate)
    (when (possible-p candidate)
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
    (unless (zerop (logandc2 open (aref tried index)))
      (let ((same (funcall (index-same (workspace-index workspace)) grasp
                           (workspace-box workspace))))
        (declare (type matching-sets same))
        (loop
          (let ((left (logandc2 open (aref tried index))))
            (declare (type matching-set left))
            (when (zerop left) (return))
            (let ((matching (1- (integer-length (logand left (- left))))))
              (setf (aref tried index) (logior (aref tried index) (aref same matching)))
              (push (try-matching workspace grasp (svref +matchings+ matching))
                    (memory-log memory)))))))))

(defun matchings-giving (faces)
  "Return the set of the matchings that give the grasp faces the FACES, six of them, NIL for any."
  (reduce #'logand (loop for face in faces
                         for grasp-face from 0
                         when face collect (aref +matchings-with+ grasp-face face))
          :initial-value +all-matchings+))
