;;;; exact-statics.lisp -- what contacts can really do, against a solver's values; its properties.

(in-package :supergrip-test)
(define-suite exact-statics
  "What contacts can really do, against a solver's values, and its properties.")

;;; Cases

(defun read-radii ()
  "Return the solver's cases: lists of contacts, u, v, need, gravity, the radius, and what multiple
of the weight is held."
  (with-open-file (in (project-file "t/exact-radius.sexp"))
    (let ((*read-eval* nil) (*read-default-float-format* 'double-float)
          (*package* (find-package :supergrip-test)))
      (loop for entry = (read in nil)
            while entry
            collect (flet ((value (key) (second (assoc key entry))))
                      (list (rest (assoc 'contacts entry)) (value 'u) (value 'v) (value 'need)
                            (value 'gravity) (value 'beta) (value 'held)))))))

(defun every-nth (n list)
  (loop for element in list for i from 0 when (zerop (mod i n)) collect element))

(defun held-cases (step)
  "Return every STEPth case in which the weight is held."
  (every-nth step (remove -1 (read-radii) :key #'sixth :test #'=)))

;;; The definitions once more, in plain lists

(defun dot (a b) (reduce #'+ (mapcar #'* a b)))
(defun norm (a) (sqrt (dot a a)))

(defun vector-product (a b)
  (destructuring-bind (a1 a2 a3) a
    (destructuring-bind (b1 b2 b3) b
      (list (- (* a2 b3) (* a3 b2)) (- (* a3 b1) (* a1 b3)) (- (* a1 b2) (* a2 b1))))))

(defun power-of (contacts u v motion &key coupled)
  "Return the greatest power of the fingers at CONTACTS in MOTION: their support function."
  (loop with turn = (nthcdr 3 motion)
        for (place normal) in contacts
        for velocity = (mapcar #'+ (subseq motion 0 3) (vector-product turn place))
        for along = (dot velocity normal)
        for slip = (* u (norm (mapcar (lambda (g n) (- g (* along n))) velocity normal)))
        for twist = (* v (abs (dot turn normal)))
        sum (max 0 (+ along (if coupled (norm (list slip twist)) (+ slip twist))))))

(defun spare-power (case motion)
  "Return the greatest power in MOTION of the fingers of CASE and gravity together."
  (destructuring-bind (contacts u v need gravity &rest rest) case
    (declare (ignore need rest))
    (+ (power-of contacts u v motion) (dot gravity motion))))


(defun bounds (case &rest keys)
  "Return the upper and the lower value of CASE; both are numbers."
  (multiple-value-bind (upper lower) (apply #'exact-radius-of case keys)
    (assert lower)
    (list upper lower)))

(defun agree-p (a b)
  "True if the bounds A and B may be those of one radius."
  (and (<= (second a) (+ (first b) 1d-7)) (<= (second b) (+ (first a) 1d-7))))

;;; A solver's radii

(defun radius-fault (case)
  "Return what is wrong with the values of CASE beside the solver's, or NIL; and true if they are
certified."
  (multiple-value-bind (upper lower worst) (exact-radius-of case)
    (destructuring-bind (need gravity beta held) (nthcdr 3 case)
      (declare (ignore gravity held))
      (values
       (cond ((= beta -1)
              (unless (and (eql upper lower) (<= upper 0)
                           (close-to (spare-power case worst) upper 1d-9))
                (format nil "can't hold: ~a ~a ~a" upper lower worst)))
             ((> upper (+ beta (max (* 0.015d0 beta) 0.003d0))) (format nil "~a: ~a" beta upper))
             ((> beta (+ upper 1d-5)) (format nil "~a: upper is ~a" beta upper))
             ((and lower (> lower (+ beta 1d-5))) (format nil "~a: lower is ~a" beta lower))
             ((not (close-to upper (/ (spare-power case worst)
                                      (norm (mapcar #'* need worst)))
                             1d-7))
              (format nil "~a: ~a is not that of ~a" beta upper worst)))
       lower))))

(test exact-radius-is-that-of-a-solver
  (let ((cases (read-radii)) (certified 0))
    (is (= 240 (length cases)))
    (dolist (case cases)
      (multiple-value-bind (fault lower) (radius-fault case)
        (is (null fault) "~a" fault)
        (when lower (incf certified))))
    (is (>= certified (* 0.97d0 (length cases))) "~d are certified" certified)))

(test what-can-hold-the-weight-is-that-of-a-solver
  (dolist (case (read-radii))
    (destructuring-bind (contacts u v need gravity beta held) case
      (declare (ignore need beta))
      (multiple-value-bind (holds witness) (supergrip:holds-p contacts u v gravity)
        (is (eq holds (>= held 1)))
        (unless holds
          (is (< (spare-power case witness) 0)))))))

(test exact-entries-are-those-of-a-solver
  (let ((worst 0))
    (dolist (maxima (read-maxima))
      (loop for (plus minus) in (supergrip:wrench-entries
                                 (getf maxima :contacts) (getf maxima :u) (getf maxima :v))
            for true in (getf maxima :axis-maxima)
            do (setf worst (max worst (/ (abs (- (min plus minus) true)) (+ 1 true))))))
    (is (< worst 2d-6) "~a" worst)))

(test a-task-along-one-axis-has-the-radius-of-its-exact-entry
  (dolist (maxima (every-nth 7 (read-maxima)))
    (loop for true in (getf maxima :axis-maxima)
          for axis from 0
          do (multiple-value-bind (upper lower)
                 (supergrip:exact-radius (getf maxima :contacts) (getf maxima :u) (getf maxima :v)
                                         (loop for k below 6 collect (if (= k axis) 1 0)))
               (is (<= (- true 1d-6) upper (+ true (max 0.002d0 (* 0.015d0 true)))))
               (is (or (null lower) (<= lower (+ true 1d-6))))))))

;;; What statics asks of every radius

(defun turned (function case)
  "Return CASE with FUNCTION of vectors, a turn of the box by right angles, applied to all."
  (destructuring-bind (contacts u v need gravity &rest rest) case
    (flet ((both (six)
             (append (funcall function (subseq six 0 3)) (funcall function (nthcdr 3 six)))))
      (list* (loop for contact in contacts collect (mapcar function contact))
             u v (both need) (both gravity) rest))))

(test radii-are-the-same-however-all-is-turned
  (dolist (case (held-cases 12))
    (let ((bounds (bounds case)))
      (dolist (turn (list (lambda (v) (destructuring-bind (x y z) v (list y z x)))
                          (lambda (v) (destructuring-bind (x y z) v (list (- y) x z)))
                          (lambda (v) (destructuring-bind (x y z) v (list x (- y) (- z))))))
        (is (agree-p bounds (bounds (turned turn case))))))))

(test round-tasks-are-the-same-however-the-box-is-turned
  ;; By an angle that no mirror outlasts.
  (flet ((turn (v)
           (destructuring-bind (x y z) v
             (let* ((x2 (- (* 0.8d0 x) (* 0.6d0 y))) (y2 (+ (* 0.6d0 x) (* 0.8d0 y))))
               (list (- (* 0.28d0 x2) (* 0.96d0 z)) y2 (+ (* 0.96d0 x2) (* 0.28d0 z)))))))
    (dolist (case (held-cases 16))
      (let ((round (copy-list case)))
        (setf (fourth round) '(0.5d0 0.5d0 0.5d0 0.7d0 0.7d0 0.7d0))
        (let ((other (turned #'turn round)))
          (setf (fourth other) (fourth round))
          (is (agree-p (bounds round) (bounds other))))))))

(test twice-the-needs-halve-the-radius
  (dolist (case (held-cases 10))
    (destructuring-bind (upper lower) (bounds case :absolute 0)
      (let ((doubled (copy-list case)))
        (setf (fourth doubled) (mapcar (lambda (f) (* -2 f)) (fourth case)))
        (destructuring-bind (half-upper half-lower) (bounds doubled :absolute 0)
          (is (close-to upper (* 2 half-upper) 1d-6))
          (is (close-to lower (* 2 half-lower) 1d-6)))))))

(test a-finger-more-never-lowers-the-radius
  (dolist (case (held-cases 10))
    (destructuring-bind (contacts . rest) case
      (let* ((place (first (first contacts)))
             (more (list (mapcar #'- place) (mapcar #'- (second (first contacts))))))
        (is (>= (first (bounds (cons (append contacts (list more)) rest)))
                (second (bounds case))))))))

(defparameter *two-fingers* '(((0 1 0) (0 -1 0)) ((0 -1 0) (0 1 0)))
  "A finger on each side of a box, 2 cm apart.")

(test without-friction-there-is-no-force-across
  (flet ((radius (need u v)
           (multiple-value-list (supergrip:exact-radius *two-fingers* u v need))))
    (destructuring-bind (upper lower worst) (radius '(0 1 0 0 0 0) 0 0)
      (is (close-to 1 upper))
      (is (<= 0.9899d0 lower 1))
      (is (equal '(0 1 0 0 0 0) (mapcar #'round worst))))
    (is (equal '(0d0 0d0) (subseq (radius '(1 1 0 0 0 0) 0 0) 0 2)))
    (is (equal '(0d0 0d0) (subseq (radius '(1 1 1 1 1 1) 0.5d0 0) 0 2)))
    ;; What is not needed may be free.
    (is (plusp (second (radius '(1 1 1 1 0 1) 0.5d0 0))))
    (is (close-to 0.4d0 (first (radius '(0 0 0 0 -1 0) 0.5d0 0.2d0))))))

(test friction-that-is-shared-is-less
  ;; Two fingers turn about their normal with 2 v; a weight of 0.8 takes 4/5 of the friction, and
  ;; leaves 3/5 of the torque if both are one friction.
  (flet ((radius (coupled)
           (supergrip:exact-radius *two-fingers* 0.5d0 0.2d0 '(0 0 0 0 1 0) :coupled coupled
                                   :gravity '(0 0 -0.8d0 0 0 0))))
    (is (close-to 0.4d0 (radius nil) 1d-3))
    (is (close-to 0.24d0 (radius t) 3d-3)))
  (dolist (case (held-cases 12))
    (destructuring-bind (contacts u v need gravity &rest rest) case
      (declare (ignore rest))
      (multiple-value-bind (upper lower worst) (exact-radius-of case :coupled t)
        (is (<= lower (first (bounds case))))
        (unless (<= upper 0)
          (is (close-to upper (/ (+ (power-of contacts u v worst :coupled t) (dot gravity worst))
                                 (norm (mapcar #'* need worst)))
                        1d-7)))))))

(test the-gap-is-kept
  (dolist (case (held-cases 16))
    (destructuring-bind (upper lower) (bounds case :gap 0.05d0 :absolute 0)
      (is (>= upper lower (* 0.9499d0 upper)))
      (is (agree-p (bounds case :gap 0.003d0) (list upper lower)))))
  (multiple-value-bind (upper lower) (exact-radius-of (first (held-cases 1)) :budget 0)
    (is (plusp upper))
    (is (null lower))))

;;; Forces, squeeze, friction

(defun sum-of-wrenches (contacts forces)
  (loop with sum = '(0 0 0 0 0 0)
        for (place normal) in contacts
        for (force torque) in forces
        do (setf sum (mapcar #'+ sum
                             (append force
                                     (mapcar #'+ (vector-product place force)
                                             (mapcar (lambda (n) (* torque n)) normal)))))
        finally (return sum)))

(defun finger-overdoes-p (normal force torque u v)
  "True if a finger can't exert FORCE and TORQUE."
  (let* ((press (dot force normal))
         (across (norm (mapcar (lambda (f n) (- f (* press n))) force normal))))
    (not (and (<= -1d-9 press (+ 1 1d-9))
              (<= across (+ (* u press) 1d-9))
              (<= (abs torque) (+ (* v press) 1d-9))))))

(test contact-forces-exert-the-wrench
  (dolist (case (held-cases 4))
    (destructuring-bind (contacts u v need gravity &rest rest) case
      (declare (ignore need rest))
      (let* ((wrench (mapcar #'- gravity))
             (forces (supergrip:contact-forces contacts u v wrench)))
        (is (every (lambda (a b) (close-to a b 1d-8)) wrench (sum-of-wrenches contacts forces)))
        (is (notany (lambda (contact finger)
                      (finger-overdoes-p (second contact) (first finger) (second finger) u v))
                    contacts forces)))))
  (multiple-value-bind (forces witness)
      (supergrip:contact-forces *two-fingers* 0.5d0 0.2d0 '(0.8d0 0 0.7d0 0 0 0))
    (is (null forces))
    (is (< (power-of *two-fingers* 0.5d0 0.2d0 witness) (dot witness '(0.8d0 0 0.7d0 0 0 0))))))

(test with-the-least-squeeze-the-radius-is-one
  (dolist (case (held-cases 8))
    (destructuring-bind (contacts u v need gravity &rest rest) case
      (declare (ignore rest))
      (multiple-value-bind (sure least)
          (supergrip:least-squeeze contacts u v need :gravity gravity)
        (flet ((with-cap (cap)        ; as fingers of force 1 see it
                 (flet ((shrunk (six) (mapcar (lambda (x) (/ x cap)) six)))
                   (supergrip:exact-radius contacts u v (shrunk need) :gravity (shrunk gravity)))))
          (is (<= least sure (* 1.0102d0 least)))
          (is (>= (with-cap sure) (- 1 1d-9)))
          (is (<= (with-cap least) 1.011d0))))))
  (flet ((squeeze (u v need gravity)
           (multiple-value-list (supergrip:least-squeeze *two-fingers* u v need :gravity gravity))))
    (is (close-to 0.5d0 (first (squeeze 0.5d0 0.2d0 '(0 0 0 0 0 0) '(0 0 -0.5d0 0 0 0)))))
    (is (equal '(nil nil) (squeeze 0 0 '(1 0 0 0 0 0) '(0 0 0 0 0 0))))))

(test with-the-least-friction-the-radius-is-one
  (dolist (case (held-cases 16))
    (destructuring-bind (contacts u v need gravity &rest rest) case
      (declare (ignore u rest))
      (multiple-value-bind (sure least) (supergrip:least-friction contacts v need :gravity gravity)
        (flet ((with-friction (u) (supergrip:exact-radius contacts u v need :gravity gravity)))
          (when sure
            (is (>= (with-friction sure) (- 1 1d-9)))
            (is (or (zerop least) (<= (with-friction least) 1.011d0))))))))
  (flet ((friction (contacts v need gravity)
           (multiple-value-list (supergrip:least-friction contacts v need :gravity gravity))))
    ;; Two fingers lift 2u, so a weight of 1/2 needs 1/4.
    (destructuring-bind (sure least) (friction *two-fingers* 0.2d0 '(0 0 0 0 0 0)
                                               '(0 0 -0.5d0 0 0 0))
      (is (<= least 0.25d0 sure 0.253d0)))
    (destructuring-bind (sure least) (friction *two-fingers* 0 '(0 0 0.5d0 0 0 0) '(0 0 0 0 0 0))
      (is (<= least (+ 0.25d0 1d-9) sure 0.255d0)))
    (is (equal '(nil nil) (friction (list (first *two-fingers*)) 0.2d0 '(1 1 1 0 0 0)
                                    '(0 0 0 0 0 0))))))

;;; The sure radius

(defun sure-radius-by-signs (capacities need gravity offset)
  "Return the radius in the cross-polytope, by all 64 vectors of signs."
  (flet ((moved (wrench)                ; to the point OFFSET
           (append (subseq wrench 0 3)
                   (mapcar #'- (nthcdr 3 wrench) (vector-product offset (subseq wrench 0 3))))))
    (let ((task (loop for f in need for k from 0
                      collect (moved (loop for i below 6 collect (if (= i k) f 0)))))
          (left (- 1 (reduce #'+ (mapcar #'/ (mapcar #'abs (moved gravity)) capacities)))))
      (/ (max 0 left)
         (loop for signs below 64
               maximize (let ((s/c (loop for c in capacities for k from 0
                                         collect (if (logbitp k signs) (/ c) (- (/ c))))))
                          (norm (mapcar (lambda (column) (dot column s/c)) task))))))))

(test sure-radius-is-that-of-the-cross-polytope
  (let ((state (sb-ext:seed-random-state 3)))
    (flet ((numbers (count low high)
             (loop repeat count collect (+ low (random (- high low) state)))))
      (dotimes (i 200)
        (let ((capacities (numbers 6 0.1d0 4d0)) (need (numbers 6 -1d0 1d0))
              (gravity (append (numbers 3 -0.1d0 0.1d0) '(0d0 0d0 0d0)))
              (offset (numbers 3 -2d0 2d0)))
          (is (close-to (sure-radius-by-signs capacities need gravity offset)
                        (supergrip:sure-radius capacities need :gravity gravity
                                                               :offset offset)))))))
  (is (null (supergrip:sure-radius '(1 1 1 1 1 1) '(0 0 0 0 0 0))))
  (is (zerop (supergrip:sure-radius '(1 1 1 0 1 1) '(1 0 0 0 0 0))))
  (is (zerop (supergrip:sure-radius '(1 1 1 1 1 1) '(1 0 0 0 0 0) :gravity '(0 0 -2 0 0 0)))))

(defun candidate-sure-radius (candidate plan case)
  (supergrip:sure-radius (supergrip:candidate-wrench candidate plan) (fourth case)
                         :gravity (fifth case) :offset (supergrip:candidate-offset candidate)))

(defun random-candidate-cases (count state &optional (make-box #'random-box))
  "Return COUNT lists of a case and its sure radius, of possible candidates on random boxes, as
MAKE-BOX makes them of STATE, with random needs."
  (let ((cases '()))
    (loop
      (let ((plan (supergrip:plan (funcall make-box state))))
        (dolist (candidate (supergrip:plan-possible plan))
          (let ((need (random-need state)))
            (unless (every #'zerop need)
              (let ((case (candidate-case candidate plan need)))
                (push (list case (candidate-sure-radius candidate plan case)) cases)
                (when (= (length cases) count) (return-from random-candidate-cases cases))))))))))

(test the-sure-radius-is-never-above-the-exact-one
  (loop for (case sure) in (random-candidate-cases 150 (sb-ext:seed-random-state 12))
        do (is (<= sure (+ (exact-radius-of case :budget 0) 1d-9)) "~a: ~a" case sure)))

;;; Whoever calls

(test exact-statics-do-not-depend-on-float-traps
  (let ((case (first (held-cases 1))))
    (is (not (traps-matter-p (lambda () (multiple-value-list (exact-radius-of case))))))
    (is (equal (multiple-value-list (exact-radius-of case))
               (call-in-modes (lambda () (multiple-value-list (exact-radius-of case)))
                              :traps '(:underflow :inexact)
                              :rounding-mode :positive-infinity)))))

(test exact-statics-are-the-same-in-several-threads
  (let* ((cases (held-cases 12))
         (alone (mapcar #'bounds cases))
         (threads (loop repeat 4
                        collect (sb-thread:make-thread (lambda () (mapcar #'bounds cases))))))
    (dolist (thread threads)
      (is (equal alone (sb-thread:join-thread thread))))))

(defun refusal-of (function arguments)
  (handler-case (progn (apply function arguments) "no error")
    (supergrip:argument-error (condition) (princ-to-string condition))))

(test exact-statics-refuse-what-they-can-not-use
  (loop with two = *two-fingers*
        with need = '(1 1 1 1 1 1)
        for (function arguments text)
          in `((supergrip:exact-radius (,two 0.5d0 0.2d0 (0 0 0 0 0 0))
                "the task needs no force and no torque, so it has no radius; ~
                 (holds-p contacts u v gravity) says whether the contacts hold the weight")
               (supergrip:exact-radius (() 0.5d0 0.2d0 ,need)
                "contacts are (), but must be a list of (position inward-normal), as ~
                 (((0 1 0) (0 -1 0)) ((0 -1 0) (0 1 0))), at most 1000")
               (supergrip:exact-radius ((((0 1 0) (0 -1 0)) ((0 -1 0) (0 0 0))) 0.5d0 0.2d0 ,need)
                "contact 2 is ((0 -1 0) (0 0 0)); a contact is (position inward-normal), three ~
                 numbers each, as ((0 1 0) (0 -1 0))")
               (supergrip:exact-radius (,two -1 0.2d0 ,need) "u is -1, but must be a number from 0")
               (supergrip:holds-p (,two 0.5d0 "v" ,need) "v is \"v\", but must be a number from 0")
               (supergrip:exact-radius (,two 0.5d0 0.2d0 (1 1 1))
                "need is (1 1 1), but must be a list of six numbers: forces along X Y Z, torques ~
                 about X Y Z")
               (supergrip:exact-radius (,two 0.5d0 0.2d0 ,need :gap 1)
                "gap is 1, but must be a number not below 0 and below 1")
               (supergrip:exact-radius (,two 0.5d0 0.2d0 ,need :budget -1)
                "budget is -1, but must be a number of boxes, such as 100000")
               (supergrip:sure-radius (,need ,need :offset 3)
                "offset is 3, but must be a list of three numbers, along X Y Z"))
        do (is (string= (format nil text) (refusal-of function arguments)))))

(test needs-may-be-as-small-as-they-like
  "Needs 1e-200 times as large have a radius 1e200 times as large, and so has what is sure."
  (let ((need '(1 0.8d0 0.8d0 0.3d0 1 1)) (gravity '(0 0 -0.2d0 0 0 0)))
    (flet ((small (number) (* 1d-200 number)))
      (loop for function in (list (lambda (need)
                                    (supergrip:exact-radius *two-fingers* 0.5d0 0.2d0 need
                                                            :gravity gravity :absolute 0))
                                  (lambda (need)
                                    (supergrip:sure-radius '(1 1 1 1 1 1) need :gravity gravity
                                                                               :offset '(0 1 2))))
            for radius = (funcall function need)
            do (is (close-to 1 (/ (small (funcall function (mapcar #'small need))) radius)
                             1d-2))))))
