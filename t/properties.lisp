;;;; properties.lisp -- what must hold for every box, tried on random ones, and beside an oracle.

(in-package :supergrip-test)
(define-suite properties
  "What must hold for every box, tried on random ones, and beside an oracle.")

;;; The same plan from the definitions

(test plans-equal-the-definitions
  (let ((boxes (random-boxes 10000 1989)))
    (is (null (first-fault #'plan-difference boxes))
        "~s" (first-fault #'plan-difference boxes))))

;;; What a possible grasp promises

(defun promise-fault (box)
  "Return what a possible grasp of BOX breaks, or NIL."
  (let ((plan (supergrip:plan box))
        (constrained (mapcar #'symbol-name (box-part box 'constrained)))
        (size (box-part box 'size))
        (weight (first (box-part box 'weight))))
    (dolist (candidate (supergrip:plan-possible plan))
      (let ((contacts (supergrip:candidate-contacts candidate plan))
            (wrench (supergrip:candidate-wrench candidate plan))
            (offset (supergrip:candidate-offset candidate)))
        (dolist (contact contacts)
          (when (member (getf contact :surface) constrained :test #'string=)
            (return-from promise-fault "a finger on a constrained face"))
          (when (finger-fault contact size)
            (return-from promise-fault (finger-fault contact size))))
        (when (member (palm-face candidate) constrained :test #'string=)
          (return-from promise-fault "the palm on a constrained face"))
        (unless (and (every #'plusp wrench)
                     (<= weight (third wrench))
                     (<= (* weight (abs (second offset))) (* (fourth wrench) (+ 1 1d-12)))
                     (<= (* weight (abs (first offset))) (* (fifth wrench) (+ 1 1d-12))))
          (return-from promise-fault "the load is not held"))))))

(defun finger-fault (contact size)
  "Return what is wrong with the place of CONTACT on a box of SIZE, or NIL."
  (let* ((axis (position (char (getf contact :surface) 0) "XYZ"))
         (sign (if (char= (char (getf contact :surface) 1) #\1) 1 -1)))
    (loop for length in size
          for place in (getf contact :position)
          for normal in (getf contact :normal)
          for i from 0
          do (cond ((/= i axis)
                    (when (or (> (abs place) (* (/ length 2) (+ 1 1d-8))) (/= normal 0))
                      (return "a finger beyond an edge")))
                   ((not (and (close-to place (* sign (/ length 2)))
                              (= normal (- sign))))
                    (return "a finger that is not on its face"))))))

(defun palm-face (candidate)
  "Return the name of the face that the palm of CANDIDATE is over, from its approach."
  (let ((axis (position-if-not #'zerop (supergrip:candidate-approach candidate))))
    (format nil "~c~d" (char "XYZ" axis)
            (if (minusp (nth axis (supergrip:candidate-approach candidate))) 1 2))))

(test possible-grasps-keep-their-promises
  (let ((boxes (random-boxes 10000 2)))
    (is (null (first-fault #'promise-fault boxes)) "~s" (first-fault #'promise-fault boxes))))

;;; What must not matter

(test the-order-of-keys-and-faces-does-not-matter
  (let ((state (sb-ext:seed-random-state 3)))
    (is (null (first-fault
               (lambda (box)
                 (let ((shuffled (loop for (key . values) in (shuffle box state)
                                       collect (cons key (if (eq key 'constrained)
                                                             (shuffle values state)
                                                             values)))))
                   (not (equal (plan-figures (supergrip:plan box))
                               (plan-figures (supergrip:plan shuffled))))))
               (random-boxes 10000 3))))))

(defun turn-list (list matching)
  "Return LIST, three numbers along N O A, as they are along X Y Z after the turn that MATCHING is."
  (let ((turned (make-list 3)))
    (loop for number in list
          for axis across (supergrip::matching-axes matching)
          do (setf (nth axis turned) number))
    turned))

(defun turn-box (box matching)
  "Return BOX with all that belongs to X Y Z turned by the rotation that MATCHING is."
  (flet ((turn-six (six)
           (append (turn-list (subseq six 0 3) matching) (turn-list (subseq six 3) matching)))
         (turn-face (face)
           (let ((slot (position face '(x1 x2 y1 y2 z1 z2))))
             (intern (supergrip-chainer:face-name
                      (svref (supergrip::matching-faces matching) slot))
                     :supergrip-test))))
    (loop for (key . values) in box
          collect (cons key (case key
                              (size (turn-list values matching))
                              (constrained (mapcar #'turn-face values))
                              (facts (loop for (word faces) in values
                                           collect (cons word (and faces (list (mapcar #'turn-face
                                                                                       faces))))))
                              ((force-needed velocity-needed) (list (turn-six (first values))))
                              (t values))))))

(defun qualities (plan)
  "Return the grasps and qualities that are possible in PLAN, in an order of their own."
  (sort (loop for candidate in (supergrip:plan-possible plan)
              collect (list (supergrip:candidate-grasp candidate)
                            (supergrip:candidate-quality candidate)))
        (lambda (a b) (or (string< (first a) (first b))
                          (and (string= (first a) (first b)) (< (second a) (second b)))))))

(defun same-qualities-p (a b)
  (and (equal (mapcar #'first a) (mapcar #'first b))
       (close-to (mapcar #'second a) (mapcar #'second b))))

(defun turn-fault (box rotations planner)
  (let ((qualities (qualities (funcall planner box))))
    (loop for matching in rotations
          unless (same-qualities-p qualities (qualities (funcall planner (turn-box box matching))))
            return (supergrip::matching-names matching))))

(defun try-all (box)
  "Return a function from a grasp to the plan of trying it on BOX."
  (lambda (name) (supergrip:try-grasp name box)))

(defparameter *rotations* (coerce supergrip::+matchings+ 'list))

(defparameter *turns-about-z*
  (remove-if-not (lambda (matching) (= 1 (svref (supergrip::matching-faces matching) 4)))
                 *rotations*)
  "The rotations that leave Z1 on top.")

(test turning-the-problem-turns-the-answer
  (is (= 4 (length *turns-about-z*)))
  (is (null (first-fault (lambda (box) (turn-fault box *rotations* #'supergrip:plan))
                         (random-boxes 10000 4 :weight nil)))
      "no weight: all 24 rotations")
  (is (null (first-fault (lambda (box) (turn-fault box *turns-about-z* #'supergrip:plan))
                         (random-boxes 10000 5)))
      "with weight: those about Z"))

(test turning-the-problem-turns-every-grasp-tried-alone
  (dolist (name (mapcar #'supergrip:grasp-name (supergrip:knowledge-grasps supergrip:*knowledge*)))
    (flet ((try (box) (supergrip:try-grasp name box)))
      (is (null (first-fault (lambda (box) (turn-fault box *rotations* #'try))
                             (random-boxes 500 6 :weight nil)))
          name)
      (is (null (first-fault (lambda (box) (turn-fault box *turns-about-z* #'try))
                             (random-boxes 500 7)))
          name))))

(test one-more-constraint-never-adds-a-matching
  (flet ((possible (name box)
           (mapcar #'supergrip:candidate-matching
                   (supergrip:plan-possible (supergrip:try-grasp name box))))
         (constrain (box face)
           (loop for (key . values) in box
                 collect (cons key (if (eq key 'constrained) (adjoin face values) values)))))
    (dolist (name (mapcar #'supergrip:grasp-name
                          (supergrip:knowledge-grasps supergrip:*knowledge*)))
      (is (null (first-fault
                 (lambda (box)
                   (let ((before (possible name box)))
                     (loop for face in '(x1 x2 y1 y2 z1 z2)
                           thereis (set-difference (possible name (constrain box face)) before
                                                   :test #'equal))))
                 (random-boxes 1500 8)))
          name))))

(test a-task-of-one-kind-has-the-index-of-that-kind
  (let ((force-only (supergrip:plan '((size 12 2 2) (weight 0.2d0) (u 0.8d0) (v 0.2d0)
                                       (constrained z2 x1) (force-needed (1 0 0 0 0 0))
                                       (velocity-needed (0 0 0 0 0 0)))))
        (velocity-only (supergrip:plan '((size 12 2 2) (weight 0.2d0) (u 0.8d0) (v 0.2d0)
                                          (constrained z2 x1) (force-needed (0 0 0 0 0 0))
                                          (velocity-needed (0 1 0 0 0 0))))))
    (let ((best (supergrip:plan-best force-only)))
      (is (= (supergrip:candidate-quality best) (supergrip:candidate-force-radius best)))
      (is (null (supergrip:candidate-velocity-radius best))))
    (let ((best (supergrip:plan-best velocity-only)))
      (is (= (supergrip:candidate-quality best) (supergrip:candidate-velocity-radius best)))
      (is (null (supergrip:candidate-force-axis best))))))

(test gamma-weighs-velocities-against-forces
  (flet ((best (gamma) (supergrip:plan-best (supergrip:plan (paper-box) :gamma gamma))))
    (is (close-to (supergrip:candidate-quality (best 1))
                  (supergrip:candidate-velocity-radius (best 1))))
    (is (close-to (supergrip:candidate-quality (best 0))
                  (supergrip:candidate-force-radius (best 0))))
    (is (close-to (supergrip:candidate-quality (best 1/4))
                  (+ (* 1/4 (supergrip:candidate-velocity-radius (best 1/4)))
                     (* 3/4 (supergrip:candidate-force-radius (best 1/4)))))))
  (dolist (gamma '(-0.1 2 "half" nil))
    (signals supergrip:gamma-error (supergrip:plan (paper-box) :gamma gamma))))

(defun plain-nearest (candidates plan)
  "Return the nearest miss among CANDIDATES of PLAN, from its definition: each is looked at in
full."
  (let ((step (find-if (lambda (step) (find step candidates :key #'supergrip:candidate-outcome))
                       (reverse (supergrip::step-outcomes))))
        (best nil) (least nil))
    (supergrip::with-workspace (workspace plan)
      (dolist (candidate candidates best)
        (when (eq step (supergrip:candidate-outcome candidate))
          (let ((shortfalls (supergrip::failure-shortfalls step :paper candidate
                                                            (supergrip::replay candidate workspace)
                                                            nil)))
            (when (or (null best) (supergrip::misses-less-p shortfalls least))
              (setf best candidate least shortfalls))))))))

(test the-nearest-miss-is-the-nearest
  (let ((open 0))
    (is (null (first-fault
               (lambda (box)
                 ;; Every grasp in all matchings: some that no friction closes, some that it would.
                 (let* ((plans (loop for name in '("PINCH-2-ADJACENT" "PINCH-3-ADJACENT"
                                                   "PINCH-3-CORNER" "PINCH-3-C-SHAPE")
                                     collect (supergrip:try-grasp name box)))
                        (candidates (reduce #'append (mapcar #'supergrip:plan-rejected plans))))
                   (incf open (count :open candidates :key #'supergrip:candidate-outcome))
                   (and candidates
                        (not (eq (supergrip::nearest-miss candidates (first plans))
                                 (plain-nearest candidates (first plans)))))))
               (random-boxes 5000 31))))
    (is (> open 500) "only ~d open candidates" open)))

(test extreme-boxes-get-a-verdict-in-words
  (let ((state (sb-ext:seed-random-state 77)))
    (is (null (first-fault
               (lambda (box)
                 (handler-case (let ((plan (supergrip:plan box)))
                                 (supergrip:write-transcript plan (make-broadcast-stream))
                                 (dolist (candidate (supergrip:plan-rejected plan))
                                   (supergrip:candidate-failure candidate plan))
                                 nil)
                   (error (condition) (princ-to-string condition))))
               (loop repeat 3000 collect (extreme-box state)))))))

(test plans-are-the-same-in-several-threads
  (let* ((boxes (random-boxes 400 9))
         (alone (mapcar (lambda (box) (plan-figures (supergrip:plan box))) boxes))
         (threads (loop repeat 4
                        collect (sb-thread:make-thread
                                 (lambda ()
                                   (mapcar (lambda (box) (plan-figures (supergrip:plan box)))
                                           boxes))))))
    (dolist (thread threads)
      (is (equal alone (sb-thread:join-thread thread))))))
