;;;; pose.lisp -- how a box lies: gravity in any direction, and a centre of mass of its own.

(in-package :supergrip-test)
(define-suite pose "How a box lies: gravity in any direction, and a centre of mass of its own.")

;;; Boxes that lie

(defun random-pose (state)
  (list (loop repeat 3 collect (- (random 200d0 state) 100d0)) (random-quaternion state)))

(defun laid (box state &key (pose 75) (centre 75))
  "Return BOX with a random pose in POSE of 100 cases, and a random centre of mass in CENTRE."
  (append box
          (when (chance pose state) `((pose ,@(random-pose state))))
          (when (chance centre state)
            `((centre ,@(loop for length in (box-part box 'size)
                              collect (* length (- (random 1d0 state) 0.5d0))))))))

(defun laid-boxes (count seed &rest keys)
  (let ((state (sb-ext:seed-random-state seed)))
    (loop for box in (random-boxes count seed) collect (apply #'laid box state keys))))

(defun without (box &rest keys)
  (remove-if (lambda (clause) (member (first clause) keys)) box))

(defun all-but-the-world (box index)
  "Return the record of BOX, without its world and its line."
  (let ((record (supergrip::plan-record (supergrip:plan box :index index))))
    (loop for (key value) on record by #'cddr
          unless (eq key :world) collect key and collect value)))

(defun turned-signed (vector matching)
  "Return VECTOR, three numbers along X Y Z, after the turn that MATCHING is, with their signs."
  (let ((turned (make-list 3)))
    (loop for number in vector
          for axis across (supergrip::matching-axes matching)
          for sign across (supergrip::matching-signs matching)
          do (setf (nth axis turned) (* sign number)))
    turned))

(defun matching-quaternion (matching)
  "Return the quaternion of the turn that MATCHING is."
  (supergrip::matrix-quaternion
   (loop for unit in '((1d0 0d0 0d0) (0d0 1d0 0d0) (0d0 0d0 1d0))
         collect (turned-signed unit matching))))

(defun turn-laid (box matching)
  "Return BOX, which has a pose or is upright, with its frame turned by what MATCHING is: it lies in
the world as before."
  (let ((pose (or (box-part box 'pose) '((0 0 0) (0 0 0 1)))) (centre (box-part box 'centre)))
    (append (turn-box (without box 'pose 'centre) matching)
            `((pose ,(first pose)
                    ,(supergrip::quaternion-product
                      (mapcar (lambda (number) (coerce number 'double-float)) (second pose))
                      (quaternion-inverse (matching-quaternion matching)))))
            (and centre `((centre ,@(turned-signed centre matching)))))))

;;; The paper's index

(test plans-of-boxes-that-lie-equal-the-definitions
  (let ((boxes (laid-boxes 3000 41)))
    (is (null (first-fault #'plan-difference boxes))
        "~s" (first-fault #'plan-difference boxes))))

(defun turn-laid-fault (box rotations planner)
  (let ((qualities (qualities (funcall planner box))))
    (loop for matching in rotations
          unless (same-qualities-p qualities
                                   (qualities (funcall planner (turn-laid box matching))))
            return (supergrip::matching-names matching))))

(test turning-the-frame-of-a-box-that-lies-turns-the-answer
  (is (null (first-fault (lambda (box) (turn-laid-fault box *rotations* #'supergrip:plan))
                         (laid-boxes 400 42)))
      "upright ones, too: on their side they are the same as with other names for the faces"))

(defun candidate-count-fault (box knowledge)
  "Return how the frame of BOX must be turned for another number of candidates, or NIL."
  (flet ((candidates (box)
           (length (supergrip:plan-candidates (supergrip:plan box :knowledge knowledge)))))
    (loop with count = (candidates box)
          for matching in *rotations*
          unless (= count (candidates (turn-laid box matching)))
            return (supergrip::matching-names matching))))

(test on-its-side-a-box-has-as-many-candidates-as-with-other-names-for-its-faces
  "Grasps that are the same are tried once, along whichever axis of the box gravity is."
  (dolist (knowledge (list supergrip:*knowledge* (further-work)))
    (is (null (first-fault (lambda (box) (candidate-count-fault box knowledge))
                           (random-boxes 60 49))))))

(defun best-quality-fault (box)
  "Return how the best quality of BOX changes when its frame is turned, if it does."
  (let ((quality (supergrip:plan-quality (supergrip:plan box))))
    (loop for matching in *rotations*
          for other = (supergrip:plan-quality (supergrip:plan (turn-laid box matching)))
          unless (close-to quality other) return (list quality other))))

(test turning-the-frame-leaves-the-best-quality
  (is (null (first-fault #'best-quality-fault (laid-boxes 200 43)))))

(defun turned-about-vertical (box angle)
  "Return BOX, which has a pose, turned in the world by ANGLE about the vertical, and put
elsewhere."
  (destructuring-bind (position orientation) (box-part box 'pose)
    (append (without box 'pose)
            `((pose ,(mapcar #'1+ position)
                    ,(supergrip::quaternion-product
                      (list 0d0 0d0 (sin (/ angle 2)) (cos (/ angle 2))) orientation))))))

(test turning-about-the-vertical-changes-nothing-but-the-world
  (let ((state (sb-ext:seed-random-state 44)))
    (loop for (index count) in '((:paper 300) (:exact 40))
          do (is (null (first-fault
                        (lambda (box)
                          (not (equalp (all-but-the-world box index)
                                       (all-but-the-world (turned-about-vertical box
                                                                                 (random 6d0 state))
                                                index))))
                        (laid-boxes count 44 :pose 100)))))))

(test an-upright-pose-changes-nothing-but-the-world
  (let ((state (sb-ext:seed-random-state 45)))
    (loop for (index count) in '((:paper 300) (:exact 40))
          do (is (null (first-fault
                        (lambda (box)
                          (let ((angle (random 6d0 state)))
                            (not (equalp (all-but-the-world box index)
                                         (all-but-the-world (append box
                                                          `((pose (1 2 3)
                                                                  (0 0 ,(sin angle) ,(cos angle)))))
                                                  index)))))
                        (laid-boxes count 45 :pose 0 :centre 50)))))))

(test a-needless-centre-changes-nothing
  (is (null (first-fault (lambda (box)
                           (not (equalp (all-but-the-world box :paper)
                                        (all-but-the-world (append box '((centre 0 0 0))) :paper))))
                         (random-boxes 300 46)))))

;;; Matchings that gravity tells apart

(test half-turns-share-their-quality-however-the-box-lies
  ;; By the paper's index, which tries one of them.
  (let ((state (sb-ext:seed-random-state 47)) (compared 0))
    (dolist (box (laid-boxes 600 47))
      (dolist (grasp (shipped-grasps))
        (let* ((name (supergrip:grasp-name grasp))
               (matching (random 24 state))
               (same (aref (supergrip::grasp-same-centre grasp) matching))
               (outcomes (loop for other below 24
                               when (logbitp other same)
                                 append (mapcar #'outcome-figures
                                                (supergrip:plan-candidates
                                                 (supergrip::try-without-rules
                                                  (list (cons name (ash 1 other))) box))))))
          (is (= same (aref (supergrip::grasp-same grasp) matching)))
          (when (rest outcomes)
            (incf compared)
            (is (every (lambda (other) (close-to (first outcomes) other 1d-12)) (rest outcomes))
                "~s ~a" box name)))))
    (is (< 200 compared))))

(defun outcome-figures (candidate)
  "Return a number for the outcome of CANDIDATE, and its quality, where it has one."
  (list (position (supergrip:candidate-outcome candidate) (supergrip::step-outcomes))
        (supergrip:candidate-quality candidate)))

(test half-turns-to-another-centre-are-both-tried
  (let ((knowledge (text-knowledge "(RULE A (IF (OPPOSED (s1 s2))) (THEN (TRY G)))"
                                   (format nil "~a~%~a" *small-gripper*
                                           (grasp-text :offset "(LIST 0 0 0.5 -0.5 0 0)"
                                                       :wrench "(1 1 1 1 1 1)"))))
        (box '((size 4 4 4) (weight 0.2) (u 0.5) (v 0.2) (constrained) (force-needed (1 1 1 1 1 1))
               (velocity-needed (0 0 0 0 0 0)))))
    (flet ((tried (&rest more)
             (let ((plan (supergrip:plan (append box more) :knowledge knowledge)))
               (list (length (supergrip:plan-candidates plan))
                     (length (remove-duplicates (mapcar #'supergrip:candidate-quality
                                                        (supergrip:plan-possible plan))))))))
      (is (equal '(12 2) (tried)) "gravity through the middle can't tell them apart")
      (is (= 24 (first (tried '(centre 1 0.5 0)))))
      (is (< 2 (second (tried '(centre 1 0.5 0)))))
      (is (= 24 (first (tried '(pose (0 0 0) (0.6 0 0 0.8)))))))))

;;; What the contacts really do

(defun gravity-of (box)
  "Return the wrench of the weight of the description BOX about the box centre, by definition."
  (let* ((box (supergrip-oracle::parse-box box))
         (force (mapcar (lambda (part) (* (supergrip-oracle::box-weight box) part))
                        (supergrip-oracle::box-down box))))
    (append force (supergrip-oracle::cross (supergrip-oracle::box-mass-centre box) force))))

(test gravity-is-as-defined
  (is (null (first-fault (lambda (box)
                           (not (close-to (gravity-of box)
                                          (supergrip:box-gravity (supergrip:parse-box box)))))
                         (laid-boxes 500 48)))))

(defun holding-fault (box)
  "Return a candidate of BOX that exact mode holds and its contacts do not, or the other way round."
  (let* ((plan (exact-plan box)) (gravity (gravity-of box)))
    (find-if (lambda (candidate)
               (and (member (supergrip:candidate-outcome candidate) '(:possible :lifting))
                    (destructuring-bind (contacts u v &rest rest)
                        (candidate-case candidate plan nil)
                      (declare (ignore rest))
                      (not (eq (eq :possible (supergrip:candidate-outcome candidate))
                               (values (supergrip:holds-p contacts u v gravity)))))))
             (supergrip:plan-candidates plan))))

(test exact-mode-holds-what-the-contacts-hold-however-the-box-lies
  (is (null (first-fault #'holding-fault (laid-boxes 100 49)))))

(test nothing-possible-drops-a-box-that-lies
  (is (null (first-fault (lambda (box) (dropped (supergrip:plan box))) (laid-boxes 400 50)))))

(defun radii-fault (box)
  "Return how the radius of the best grasp of BOX changes, when its frame is turned, beyond what is
proved of it."
  (flet ((bounds-of (plan)
           (let ((best (supergrip:plan-best plan)))
             (and best (multiple-value-bind (upper lower)
                           (supergrip:candidate-exact-radius best plan)
                         (list upper (and lower (supergrip:candidate-quality best))))))))
    (destructuring-bind (&optional upper quality) (bounds-of (exact-plan box))
      (loop for matching in (list (nth 7 *rotations*) (nth 14 *rotations*))
            for (other-upper other) = (bounds-of (exact-plan (turn-laid box matching)))
            unless (or (and (null upper) (null other-upper))
                       (and quality other
                            (< (abs (- quality other)) (+ 2d-3 (* 0.011d0 (max quality other))))))
              return (list upper other-upper quality other)))))

(test turning-the-frame-leaves-the-exact-quality
  (let ((faults (remove nil (mapcar #'radii-fault (laid-boxes 60 51)))))
    (is (null (remove-if (lambda (fault) (null (third fault))) faults)) "~s" faults)
    (is (<= (length faults) 2) "not certified: ~s" faults)))

(test the-sure-radius-is-below-the-exact-one-however-the-box-lies
  (let ((compared 0))
    (dolist (box (laid-boxes 150 52))
      (let ((plan (supergrip:plan box)))
        (dolist (candidate (supergrip:plan-possible plan))
          (let ((sure (supergrip:candidate-sure candidate plan)))
            (when sure
              (incf compared)
              (is (<= sure (+ 1d-9 (supergrip:candidate-exact-radius candidate plan)))))))))
    (is (< 100 compared))))

(test the-powers-in-the-worst-motion-add-up-however-the-box-lies
  (dolist (box (laid-boxes 40 53))
    (let* ((plan (exact-plan box)) (best (supergrip:plan-best plan)))
      (when (and best (supergrip:candidate-force-radius best))
        (multiple-value-bind (upper lower worst) (supergrip:candidate-exact-radius best plan)
          (declare (ignore lower))
          (let ((needed (sqrt (reduce #'+ (mapcar (lambda (q f) (expt (* q f) 2))
                                                  worst (needed plan))))))
            (is (close-to (* upper needed)
                          (reduce #'+ (supergrip:candidate-powers best worst plan)) 1d-6))))))))

;;; Explanations

(test what-would-change-the-choice-is-right-however-the-box-lies
  (let ((changed 0))
    (dolist (box (laid-boxes 40 54 :pose 100))
      (let ((plan (supergrip:plan box)))
        (dolist (change (supergrip:choice-changes (supergrip:explain-choice plan)))
          (when (search "weight" (supergrip:change-what change))
            (incf changed)
            (flet ((choice (weight)
                     (let ((plan (supergrip:plan (substitute-if `(weight ,weight)
                                                                (lambda (clause)
                                                                  (eq 'weight (first clause)))
                                                                box))))
                       (list (supergrip:plan-grasp plan) (supergrip:plan-matching plan)))))
              (let ((limit (supergrip:change-limit change)) (from (supergrip:change-from change)))
                (is (not (equal (choice from) (choice limit))) "~s" box)
                (is (equal (choice from)
                           (choice (+ from (* 0.999999d0 (- limit from))))) "~s" box)))))))
    (is (< 5 changed))))

(test a-step-and-its-curve-agree-however-the-box-lies
  (let ((compared 0))
    (dolist (box (laid-boxes 150 55))
      (let ((plan (supergrip:plan box)))
        (supergrip::with-curves ()
          (dolist (line (supergrip::lines-of plan (supergrip::make-goal :test #'identity
                                                                        :winner #'identity)
                                             (list (supergrip::find-key :weight))))
            (let ((from (supergrip::line-from line)))
              (dolist (candidate (supergrip:plan-possible plan))
                (let ((prospect (supergrip::prospect-of line candidate)))
                  (supergrip::enter-interval from from)
                  (incf compared)
                  (is (= (supergrip:candidate-quality candidate)
                         (supergrip::curve-least
                          (supergrip::bounds (supergrip::prospect-quality prospect)
                                             supergrip::*stamp*)))))))))))
    (is (< 100 compared))))

(test where-the-hand-comes-from-is-said-as-it-is
  (flet ((from (orientation)
           (let ((text (supergrip:choice-sentence
                        (supergrip:explain-choice
                         (supergrip:plan (append *good-box* `((:pose (0 0 0) ,orientation))))))))
             (subseq text (+ 12 (search "coming from" text))))))
    (is (equal "above" (from '(0 0 0.6 0.8))))
    (is (equal "the side Z1" (from '(0.5 0.5 0.5 0.5))))
    (is (equal "below" (from '(1 0 0 0))))
    (is (equal "obliquely above" (from '(0.38268343 0 0 0.92387953))))))

(test a-drop-is-told-in-the-direction-of-gravity
  (let* ((box (append (changed-box :weight 3) '((:pose (0 0 0) (0.5 0.5 0.5 0.5)))))
         (plan (supergrip:try-grasp "PINCH-2-PARALLEL" box)))
    (is (some (lambda (candidate)
                (search "the load along Y is 3"
                        (nth-value 1 (supergrip:candidate-failure candidate plan))))
              (supergrip:plan-rejected plan)))
    (let ((exact (supergrip:try-grasp "PINCH-2-PARALLEL" box :index :exact)))
      (is (some (lambda (candidate)
                  (search "the box would give way, moving along -Y"
                          (nth-value 1 (supergrip:candidate-failure candidate exact))))
                (supergrip:plan-rejected exact))))))

(test extreme-boxes-that-lie-get-a-verdict-in-words
  (let ((state (sb-ext:seed-random-state 57)))
    (is (null (first-fault
               (lambda (box)
                 (handler-case
                     (dolist (index '(:paper :exact))
                       (let* ((plan (supergrip:plan box :index index))
                              (record (supergrip::plan-record plan)))
                         (supergrip:write-transcript plan (make-broadcast-stream))
                         (error-text (supergrip:box-gravity (supergrip:plan-box plan)))
                         (supergrip:explain-choice plan)
                         (unless (getf record :status) (return "no status"))
                         (dolist (candidate (supergrip:plan-rejected plan))
                           (supergrip:candidate-failure candidate plan))))
                   (error (condition) (princ-to-string condition))))
               (loop repeat 300 collect (laid (extreme-box state) state :pose 90 :centre 90)))))))

(test a-box-keeps-its-centre-of-mass-inside
  (flet ((smaller-p (centre)
           (let ((plan (supergrip:plan (list* (list :centre 0 centre 0)
                                              (changed-box :size 12 4 4)))))
             (find "the size along Y" (supergrip:requirement-changes
                                       (supergrip:explain-requirement '(small (y2 y1)) plan))
                   :key #'supergrip:change-what :test #'string=))))
    (is (smaller-p 0.1d0))
    (is (null (smaller-p 1.9d0)) "a box less than FINGER-WIDTH wide could not have it inside")))

;;; Reading

(defun box-laid (&rest clauses)
  (supergrip:parse-box (append *good-box* clauses)))

(defun refused (&rest clauses)
  (problem-texts (lambda () (apply #'box-laid clauses))))

(test a-box-returns-how-it-lies
  (let ((box (box-laid '(:pose (40 0 -12.5d0) (0 0 0.6d0 0.8d0)) '(:centre 1 -0.5d0 0))))
    (is (close-to '((40 0 -12.5d0) (0 0 0.6d0 0.8d0)) (supergrip:box-pose box)))
    (is (equal (supergrip:box-pose box) (supergrip:box-value box :pose)))
    (is (equal '(1d0 -0.5d0 0d0) (supergrip:box-centre box)))
    (is (equal '(1d0 -0.5d0 0d0) (supergrip:box-value box "centre")))
    (is (equal '(0d0 0d0 -1d0) (supergrip:box-down box)))
    (is (close-to '(0 0 -0.2d0 0.1d0 0.2d0 0) (supergrip:box-gravity box)))
    (is (equalp (supergrip::box-description box)
                (supergrip::box-description
                 (supergrip:parse-box (supergrip::box-description box))))))
  (let ((box (box-laid)))
    (is (null (supergrip:box-pose box)))
    (is (null (supergrip:box-value box :centre)))
    (is (equal '(0d0 0d0 0d0) (supergrip:box-centre box)))
    (is (equal '(0d0 0d0 -0.2d0 0d0 0d0 0d0) (supergrip:box-gravity box)))))

(test a-quaternion-is-computed-with-as-if-of-length-1
  (flet ((orientation (&rest numbers)
           (second (supergrip:box-pose (box-laid `(:pose (0 0 0) ,numbers))))))
    (is (equal '(0d0 0.707107d0 0d0 0.707107d0) (orientation 0 0.707107d0 0 0.707107d0)))
    (is (equal '(1d0 0d0 0d0) (supergrip:box-down
                               (box-laid '(:pose (0 0 0) (0 0.707107d0 0 0.707107d0))))))))

(test poses-that-are-none-are-refused
  (let ((takes "POSE takes the place of the box centre in the world, x y z in cm, and a unit quaternion x y z w, which turns the box there: (POSE (40 0 12.5) (0 0 0 1))"))
    (loop for (clause text) in
          `(((:pose (0 0 0) (0 0 0 2))
             "(0 0 0 2) is no unit quaternion: its length is 2, not 1; the same rotation has (0 0 0 1)")
            ((:pose (0 0 0) (0.3d0 0 1 0))
             "(0.3 0 1 0) is no unit quaternion: its length is 1.044, not 1; the same rotation has (0.287347886 0 0.957826285 0)")
            ((:pose (0 0 0) (0 0 0 1.000002d0))
             "(0 0 0 1.000002) is no unit quaternion: its length is 1.000002, not 1; the same rotation has (0 0 0 1)")
            ((:pose (0 0 0) (0 0 0 0))
             "(0 0 0 0) is no rotation; a box that stands upright has (0 0 0 1)")
            ((:pose (0 0) (0 0 0 1)) ,(format nil "(POSE (0 0) (0 0 0 1)) is not valid: ~a" takes))
            ((:pose (0 0 0) (0 0 1)) ,(format nil "(POSE (0 0 0) (0 0 1)) is not valid: ~a" takes))
            ((:pose (0 0 0) (0 0 z 1))
             ,(format nil "(POSE (0 0 0) (0 0 Z 1)) is not valid: ~a" takes))
            ((:pose 0 0 0 0 0 0 1) ,(format nil "(POSE 0 0 0 0 0 0 1) is not valid: ~a" takes))
            ((:pose) ,(format nil "(POSE) is not valid: ~a" takes)))
          do (is (equal (list (format nil "BOX: ~a" text)) (refused clause))))))

(test centres-that-are-none-are-refused
  (let ((takes "CENTRE takes three numbers in cm, the centre of mass from the box centre: (CENTRE 0 0 -0.5)"))
    (loop for (clause text) in
          `(((:centre 0 1 1.5d0)
             "the centre of mass lies outside the box: along Z it is 1.5 from the box centre, and the box ends at 1")
            ((:centre -6.1d0 0 0)
             "the centre of mass lies outside the box: along X it is -6.1 from the box centre, and the box ends at -6")
            ((:centre 0 0 1.0000001d0)
             "the centre of mass lies outside the box: along Z it is 1.0000001 from the box centre, and the box ends at 1")
            ((:centre 0 0) ,(format nil "(CENTRE 0 0) is not valid: ~a" takes))
            ((:centre (0 0 0)) ,(format nil "(CENTRE (0 0 0)) is not valid: ~a" takes))
            ((:centre 0 0 z) ,(format nil "(CENTRE 0 0 Z) is not valid: ~a" takes)))
          do (is (equal (list (format nil "BOX: ~a" text)) (refused clause)))))
  (is (null (refused '(:centre 6 -1 1))) "on a face"))

(defun json-laid (text)
  (json-box (changed *json-pencil* "\"constrained\"" (format nil "~a, \"constrained\"" text))))

(test json-says-how-a-box-lies
  (let ((box (json-laid "\"pose\": {\"orientation\": [0, 0, 0.6, 0.8], \"position\": [40, 0, -12.5]}, \"centre\": [1, -0.5, 0]")))
    (is (equalp (supergrip:box-pose box)
                (supergrip:box-pose (box-laid '(:pose (40 0 -12.5d0) (0 0 0.6d0 0.8d0))))))
    (is (equal '(1d0 -0.5d0 0d0) (supergrip:box-centre box))))
  (let ((takes "\"pose\" takes the place of the box centre in the world, x y z in cm, and a unit quaternion x y z w, which turns the box there: \"pose\": {\"position\": [40, 0, 12.5], \"orientation\": [0, 0, 0, 1]}"))
    (loop for (text report) in
          `(("\"pose\": {\"position\": [0, 0, 0], \"orientation\": [0, 0, 0, 2]}"
             "[0, 0, 0, 2] is no unit quaternion: its length is 2, not 1; the same rotation has [0, 0, 0, 1]")
            ("\"pose\": {\"position\": [0, 0, 0]}"
             ,(format nil "\"pose\": {\"position\": [0, 0, 0]} is not valid: ~a" takes))
            ("\"pose\": [0, 0, 0]" ,(format nil "\"pose\": [0, 0, 0] is not valid: ~a" takes))
            ("\"pose\": {\"position\": [0, 0, 0], \"orientation\": 1}"
             ,(format nil "\"pose\": {\"position\": [0, 0, 0], \"orientation\": 1} is not valid: ~a"
                      takes))
            ("\"centre\": [0, 0, 9]"
             "the centre of mass lies outside the box: along Z it is 9 from the box centre, and the box ends at 1")
            ("\"centre\": 3"
             "\"centre\": 3 is not valid: \"centre\" takes three numbers in cm, the centre of mass from the box centre: \"centre\": [0, 0, -0.5]"))
          do (is (equal (list (format nil "1: BOX: ~a" report))
                        (problem-texts (lambda () (json-laid text))))))))

;;; The world

(defun world-fault (box)
  "Return what is wrong with where the hand of the best grasp of BOX, which has a pose, is in the
world."
  (let* ((plan (supergrip:plan box))
         (record (supergrip::plan-record plan))
         (hand (getf record :hand)) (world (getf record :world)))
    (destructuring-bind (place orientation) (box-part box 'pose)
      (flet ((world-place (vector)
                          (mapcar #'+ place (supergrip-oracle::turned-by orientation vector)))
             (back (frame vector)
               (destructuring-bind (x y z w) (getf frame :orientation)
                 (supergrip-oracle::turned-by (list (- x) (- y) (- z) w)
                                              (mapcar #'- vector (getf frame :position))))))
        (cond ((null (supergrip:plan-best plan))
               (and (or hand world (eq record (getf record :world record)))
                    "a hand without a grasp"))
              ((not (equal world (supergrip:candidate-world (supergrip:plan-best plan) plan)))
               "the candidate's")
              ((not (eql (getf hand :opening) (getf world :opening))) "the opening")
              ((minusp (fourth (getf world :orientation))) "the quaternion")
              ((loop for contact in (getf record :contacts)
                     for at = (getf contact :position)
                       thereis (not (close-to (back hand at) (back world (world-place at)) 1d-8)))
               "a contact as the hand sees it")
              ((not (close-to (getf world :closing)
                              (supergrip-oracle::turned-by (getf world :orientation)
                                                           '(1d0 0d0 0d0))))
               "the closing direction"))))))

(test the-hand-in-the-world-is-the-hand-on-the-box
  (is (null (first-fault #'world-fault (laid-boxes 300 56 :pose 100)))))

(test only-a-box-with-a-pose-is-in-the-world
  (let ((plan (pencil-plan)))
    (is (eq :none (getf (supergrip::plan-record plan) :world :none)))
    (is (null (supergrip:candidate-world (supergrip:plan-best plan) plan))))
  (let ((keys (loop for (key) on (supergrip::plan-record
                                  (supergrip:plan (box-laid '(:pose (0 0 0) (0 0 0 1)))) :all 2)
                      by #'cddr
                    collect key)))
    (is (equal '(:hand :world :alternatives) (rest (member :sure keys))))))
