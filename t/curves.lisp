;;;; curves.lisp -- bounds of forms, of their slopes and of candidates are true of what plans
;;;; compute.

(in-package :supergrip-test)
(define-suite curves
  "Bounds of forms, of their slopes and of candidates are true of what plans compute.")

(defun curve-fault (curve places true-value)
  "Return where CURVE says what is not so of TRUE-VALUE, a function of a place that returns a
number, or NIL for no value: at PLACES, an ascending list, or between the first and the last of
them."
  (let ((stamp 0) (least (first places)) (most (first (last places))))
    (flet ((bounds (curve least most)
             (supergrip::settle supergrip::*variable* least most 2)
             (setf stamp (incf supergrip::*stamp*))
             (supergrip::bounds curve stamp)))
      (loop for place in places
            for value = (funcall true-value place)
            do (let* ((point (bounds curve place place))
                      (at (supergrip::curve-least point))
                      (certainty (supergrip::curve-certainty point)))
                 (when (or (/= certainty (if value 2 0)) (and value (/= at value)))
                   (return (list place value at certainty)))
                 (let* ((range (bounds curve least most))
                        (certainty (supergrip::curve-certainty range)))
                   (when (or (and value (zerop certainty)) (and (null value) (= certainty 2))
                             (and value (not (<= (supergrip::curve-least range) value
                                                 (supergrip::curve-most range)))))
                     (return (list place value :outside least most)))))))))

(defun slope-fault (curve places true-value)
  "Return two of PLACES between which the numbers of TRUE-VALUE rise or fall faster than CURVE
says."
  (let ((slope (supergrip::slope curve)))
    (when slope
      (supergrip::settle supergrip::*variable* (first places) (first (last places)) 2)
      (supergrip::bounds slope (incf supergrip::*stamp*))
      (when (= 2 (supergrip::curve-certainty slope)
               (supergrip::curve-certainty (supergrip::bounds curve supergrip::*stamp*)))
        (loop for (a b) on places
              for rise = (and b (- (funcall true-value b) (funcall true-value a)))
              for noise = (and b (* 1d-9 (+ 1 (abs (funcall true-value a)) (abs rise))))
              when (and b (not (<= (- (* (supergrip::curve-least slope) (- b a)) noise)
                                   rise
                                   (+ (* (supergrip::curve-most slope) (- b a)) noise))))
                return (list a b :slope))))))

(defun ascending-places (state)
  (let ((least (random 3d0 state)) (width (expt 10d0 (- (random 4d0 state) 3))))
    (sort (list* least (+ least width) (loop repeat 6 collect (+ least (random width state))))
          #'<)))

(defun parsed-number (form variables)
  "Return the node of FORM, which gives a number; VARIABLES are the names of the first registers."
  (let ((scope (supergrip::make-scope
                :variables (loop for name in variables
                                 for register from 0
                                 collect (cons name (supergrip::input-node register))))))
    (values (supergrip-data:with-problems
              (cons (supergrip::parse-form (supergrip-data:canonical form) scope :number) scope)))))

(defun form-value (program registers)
  (and (supergrip::has-value-p program registers)
       (aref registers (aref (supergrip::program-results program) 0))))

(defun form-fault (form places v)
  "Return what curves say of FORM that is not so where u is one of PLACES, and V is V."
  (destructuring-bind (node . scope) (parsed-number form '("U" "V"))
    (when node
      (let* ((layout (supergrip::scope-layout scope))
             (program (supergrip::numbers-program (list node) layout))
             (registers (supergrip::make-registers layout)))
        (flet ((true-value (u)
                 (setf (aref registers supergrip::+u+) u
                       (aref registers supergrip::+v+) v
                       (aref registers supergrip::+distances+) 3d0
                       (aref registers (+ 1 supergrip::+distances+)) 1.5d0
                       (aref registers (+ 2 supergrip::+distances+)) 8d0
                       (aref registers (+ 3 supergrip::+blocked+)) 1d0
                       (aref registers (+ 4 supergrip::+blocked+)) 1d0)
                 (form-value program registers)))
          (supergrip::with-curves ()
            (let ((curve (supergrip::node-curve
                          node (map 'vector (lambda (number)
                                              (if number
                                                  (supergrip::constant-curve number)
                                                  supergrip::*variable*))
                                    (list nil v 3d0 1.5d0 8d0 0d0 0d0 0d0 1d0 1d0 0d0))
                          (make-hash-table))))
              (or (curve-fault curve places #'true-value)
                  (slope-fault curve places #'true-value)))))))))

(test what-is-out-of-range-at-the-ends-may-be-in-range-between
  (is (null (supergrip-data::without-float-traps
              (form-fault '(expt (/ 2 (cond ((< u 1) 0) (t v))) 3) '(0.9d0 1.05d0 1.1d0) 0.5d0)))))

(test bounds-and-slopes-hold-between-any-two-places
  (let ((state (sb-ext:seed-random-state 61)))
    (format t "~&   random forms, seed 61~%")
    (is (null (supergrip-data::without-float-traps
                (loop repeat 1500
                      for form = (random-form 4 '(u v) '() state)
                      for places = (ascending-places state)
                      for fault = (form-fault form places (random 2d0 state))
                      when fault return (list form fault)))))))

(defun candidate-fault (candidate line)
  "Return how the curves of CANDIDATE say something else of it than it is, at the place on LINE
where it was tried."
  (let ((prospect (supergrip::prospect-of line candidate))
        (quality (supergrip:candidate-quality candidate))
        (from (supergrip::line-from line)))
    (supergrip::enter-interval from from)
    (flet ((least (curve) (supergrip::curve-least (supergrip::bounds curve supergrip::*stamp*))))
      (let ((possible (and prospect (plusp (least (supergrip::prospect-possible prospect))))))
        (unless (and (eq possible (and quality t))
                     (or (null quality)
                         (= quality (least (supergrip::prospect-quality prospect)))))
          (list candidate possible (supergrip::line-row line)))))))

(defun prospect-fault (box)
  "Return the first candidate that is not possible, or has not the Q, that its curves say."
  (let ((candidates (loop for grasp in (supergrip:knowledge-grasps supergrip:*knowledge*)
                          append (supergrip:plan-candidates (supergrip:try-grasp grasp box))))
        (rows (remove nil supergrip::*box-keys* :key #'supergrip::box-key-words)))
    (supergrip::with-curves ()
      (loop for line in (supergrip::lines-of (supergrip:plan box)
                                               (supergrip::make-goal :test #'identity) rows)
            thereis (loop for candidate in candidates
                          thereis (candidate-fault candidate line))))))

(test curves-of-candidates-say-what-plans-say
  (is (null (supergrip-data::without-float-traps
              (first-fault #'prospect-fault (random-boxes 60 62))))))
