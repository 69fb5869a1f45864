;;;; contacts.lisp -- the exact radius: 100 random grasps, six needs, certified to 1 %.

(in-package :supergrip-bench)

(defun random-grasp (state)
  "Return a possible grasp on a random box, and a task: contacts, u, v, need and gravity, for
EXACT-RADIUS; or NIL."
  (flet ((between (low high) (+ low (random (- high low) state))))
    (let* ((plan (supergrip:plan `((size ,@(loop repeat 3 collect (between 1d0 15d0)))
                                   (weight ,(between 0d0 0.3d0))
                                   (u ,(between 0.2d0 1.2d0)) (v ,(between 0.15d0 0.4d0))
                                   (constrained z2)
                                   (force-needed (1 1 1 1 1 1))
                                   (velocity-needed (1 1 1 1 1 1)))))
           (box (supergrip:plan-box plan))
           (possible (supergrip:plan-possible plan)))
      (when possible
        (list (loop for contact in (supergrip:candidate-contacts
                                    (nth (random (length possible) state) possible) plan)
                    collect (list (getf contact :position) (getf contact :normal)))
              (supergrip:box-friction box) (supergrip:box-soft-friction box)
              (loop repeat 6 collect (between 0.1d0 1d0))
              (list 0 0 (- (supergrip:box-weight box)) 0 0 0))))))

(defun random-grasps (count seed)
  (let ((state (sb-ext:seed-random-state seed)))
    (loop for grasp = (random-grasp state)
          when grasp collect grasp into grasps
          until (= (length grasps) count)
          finally (return grasps))))

(defun radius-figures (grasp times)
  "Return the least seconds of TIMES certificates of GRASP, how often the support function was
computed, and true if it is certified."
  (destructuring-bind (contacts u v need gravity) grasp
    (let ((grip (supergrip-statics:make-grip (length contacts) u v)))
      (loop for (place normal) in contacts
            for index from 0
            do (apply #'supergrip-statics:set-finger grip index (append place normal)))
      (flet ((six (list) (map 'supergrip-statics:six (lambda (x) (coerce x 'double-float)) list)))
        (let ((need (six need)) (gravity (six gravity)) (lower nil) (evaluations 0))
          (values (loop repeat times
                        minimize (seconds-of
                                  (lambda ()
                                    (multiple-value-bind (upper certified worst count)
                                        (supergrip-statics:grip-radius grip need gravity 0.01d0 0d0)
                                      (declare (ignore upper worst))
                                      (setf lower certified evaluations count)))
                                  1))
                  evaluations lower))))))

(defun support-seconds ()
  "Return how long one computation of the support function of three fingers takes."
  (let ((grip (supergrip-statics:make-grip 3 0.8d0 0.2d0))
        (x (supergrip-statics:make-six)) (w (supergrip-statics:make-six)))
    (loop for (y z n) in '((-1d0 0.9d0 1d0) (-1d0 -0.9d0 1d0) (1d0 0d0 -1d0))
          for index from 0
          do (supergrip-statics:set-finger grip index 0d0 y z 0d0 n 0d0))
    (fill x 0.5d0)
    (figure-minimum (first (measure-together
                            '("support")
                            (list (lambda () (supergrip-statics:grip-power grip x w))))))))
