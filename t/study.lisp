;;;; study.lisp -- measures what docs/ says about many boxes; no part of the tests.
;;;;
;;;; sbcl --script t/study.lisp                              what docs/reconstruction.md counts
;;;; sbcl --script t/study.lisp cases | python3 t/cones.py   how tight bounds are, for docs/physics.md

(load (merge-pathnames "registry.lisp" *load-truename*))

(let ((*standard-output* (make-broadcast-stream)))
  (handler-bind ((warning #'muffle-warning))
    (asdf:load-system "supergrip/test")))

(in-package :supergrip-test)

;;; Cases for a cone solver

(defun random-contacts (grasp state)
  "Return the size of a random box along N O A, its friction U and V, and a finger spread."
  (list (loop repeat 3 collect (random-between 1d0 15d0 state))
        (cond ((search "ADJACENT" grasp) (+ 1.05d0 (random 0.55d0 state)))
              ((search "CORNER" grasp) (+ 0.6d0 (random 0.8d0 state)))
              (t (+ 0.15d0 (random 0.85d0 state))))
        (+ 0.02d0 (random 0.38d0 state))
        (+ 0.5d0 (random 2d0 state))))

(defun print-cases (state)
  "Print a line for each case: the grasp, the size, u, v, the spread, and the six entries."
  (loop for (grasp . exact) in *exact*
        do (loop repeat (if (member nil exact) 2000 200)
                 do (destructuring-bind (size u v spread) (random-contacts grasp state)
                      (format t "~a~{ ~,12f~} ~,12f ~,12f ~,12f~{ ~,12f~}~%" grasp size u v spread
                              (solved-entries (list :grasp (make-symbol grasp) :size size :u u :v v
                                                    :spread spread)))))))

;;; How far the session binds the gripper

(defun same-session-p (text number)
  "True if the session comes out with NUMBER in place of the one at the end of TEXT, a part of
grasps.lisp."
  (let ((start (position #\Space text :from-end t)))
    (equal (file-text "t/pencil-session.txt")
           (session-of (list (list text (format nil "~a ~,9f" (subseq text 0 start) number)))))))

(defun furthest (text good bad)
  "Return the number nearest to BAD that leaves the session as it is; GOOD does."
  (loop repeat 24
        do (let ((middle (/ (+ good bad) 2)))
             (if (same-session-p text middle)
                 (setf good middle)
                 (setf bad middle))))
  good)

(defun print-ranges ()
  (loop for (text number) in '(("FINGER-LENGTH 3.2" 3.2d0) ("FINGER-DIST   6.05" 6.05d0)
                               ("FINGER-SPREAD 1.7375" 1.7375d0) ("REACH-U       4.85" 4.85d0)
                               ("REACH-C       4.825" 4.825d0))
        do (format t "~a: the session is the same from ~,5f to ~,5f~%" text
                   (furthest text number (* 0.95d0 number))
                   (furthest text number (* 1.05d0 number)))))

;;; Counts

(defun on-a-table (box state)
  "Return BOX with 1 to 15 cm a side, light, on a table."
  (loop for entry in box
        collect (case (first entry)
                  (size `(size ,@(loop repeat 3 collect (random-between 1d0 15d0 state))))
                  (weight `(weight ,(random 0.5d0 state)))
                  (u `(u ,(+ 0.3d0 (random 0.7d0 state))))
                  (constrained '(constrained z2))
                  (t entry))))

(defun possible-p (candidate)
  (eq :possible (supergrip:candidate-outcome candidate)))

(defun all-candidates (box)
  "Return the candidates of every grasp in every matching on BOX."
  (loop for (grasp) in *exact*
        append (supergrip:plan-candidates (supergrip:try-grasp grasp box))))

(defun same-contacts-p (u-shape c-shape)
  "True if the candidates U-SHAPE and C-SHAPE close across the same pair, have the same third
face, and the same palm."
  (destructuring-bind (n1 n2 o1 o2 a1 a2) (supergrip:candidate-matching u-shape)
    (declare (ignore n1 a1))
    (destructuring-bind (p1 p2 q1 q2 b1 b2) (supergrip:candidate-matching c-shape)
      (declare (ignore q1 b1))
      (and (equal (list n2 a2) (list q2 b2))
           (or (equal (list o1 o2) (list p1 p2)) (equal (list o2 o1) (list p1 p2)))))))

(defun u-and-c-shapes (candidates)
  "Return a list of (U . C), those of CANDIDATES with the same contacts."
  (flet ((of (name)
           (remove name candidates :key #'supergrip:candidate-grasp :test-not #'string=)))
    (loop for u in (of "PINCH-3-U-SHAPE")
          for c = (find-if (lambda (c) (same-contacts-p u c)) (of "PINCH-3-C-SHAPE"))
          when c collect (cons u c))))

(defun print-counts (kind make-box)
  (let ((tried 0) (all 0) (pairs 0) (one 0))
    (dotimes (i 3000)
      (let* ((box (funcall make-box))
             (candidates (all-candidates box)))
        (incf tried (length (supergrip:plan-candidates (supergrip:plan box))))
        (incf all (length candidates))
        (loop for (u . c) in (u-and-c-shapes candidates)
              do (when (or (possible-p u) (possible-p c))
                   (incf pairs)
                   (unless (and (possible-p u) (possible-p c)) (incf one))))))
    (format t "3000 ~a: ~,1f candidates a box by the rules, ~,1f by every grasp in every matching~%~
               ~2t~d pairs of U and C with the same contacts where one is possible; in ~d only one~%"
            kind (/ tried 3000) (/ all 3000) pairs one)))

;;; The textbook's chainer

(defun restarting (rules facts try)
  "Run RULES as SUPERGRIP-ORACLE:ORACLE-RUN-RULES does, but from the top after each that remembers or
tries something new: again with all rules up to it, until there is none."
  (let ((known facts) (log '()) (tried '()))
    (loop
      (let ((new nil) (result nil))
        (loop for rule in rules
              until new
              do (setf result (supergrip-oracle:oracle-run-rules
                               (list rule) known
                               (lambda (grasp suggestion)
                                 (let ((what (list grasp suggestion)))
                                   (unless (member what tried :test #'equal)
                                     (push what tried)
                                     (setf new t)
                                     (funcall try grasp suggestion))))))
                 (dolist (entry (getf result :log))
                   (setf new t log (cons entry log) known (append known (list (rest entry)))))
                 (when (getf result :end)
                   (return-from restarting (list* :log (reverse log) result))))
        (unless new
          (return (list :end nil :reason nil :log (reverse log))))))))

(defun print-differences (state)
  (let ((knowledge *oracle*) (once #'supergrip-oracle:oracle-run-rules) (different 0))
    (dotimes (i 3000)
      (let* ((box (random-box state))
             (plan (supergrip-oracle:oracle-plan box knowledge))
             (other (unwind-protect
                         (progn (setf (fdefinition 'supergrip-oracle:oracle-run-rules)
                                      (lambda (rules facts try)
                                        (setf (fdefinition 'supergrip-oracle:oracle-run-rules) once)
                                        (restarting rules facts try)))
                                (supergrip-oracle:oracle-plan box knowledge))
                      (setf (fdefinition 'supergrip-oracle:oracle-run-rules) once))))
        (unless (equal (supergrip-oracle:oracle-transcript plan)
                       (supergrip-oracle:oracle-transcript other))
          (incf different))))
    (format t "3000 random boxes: ~d transcripts differ if rules start again at the top~%" different)))

(if (equal (second sb-ext:*posix-argv*) "cases")
    (print-cases (sb-ext:seed-random-state 1))
    (let ((state (sb-ext:seed-random-state 1)))
      (print-ranges)
      (print-counts "random boxes" (lambda () (random-box state)))
      (print-counts "boxes on a table" (lambda () (on-a-table (random-box state) state)))
      (print-differences state)))
