;;;; units.lisp -- a box may count in other units: the answers are the same, in these.

(in-package :supergrip-test)
(define-suite units "A box may count in other units: the answers are the same, in these.")

(defparameter *unit-sizes*
  '((:cm :finger 1 1) (:mm :n 1/10 1/20) (:m :n 100 1/20)
    (:in :lbf 254/100 44482216152605/200000000000000))
  "Units of length and force: how many cm and how many finger forces of 20 N one is.")

(defun box-in (description length force cm fingers)
  "Return DESCRIPTION, of a box in cm and finger forces, in the units LENGTH and FORCE."
  (flet ((parts (key &rest factors)
           (flet ((part-in (number factor) (/ (supergrip-data:exact-decimal number) factor)))
             (loop for part in (box-part description key)
                   collect (if (consp part)
                               (mapcar #'part-in part factors)
                               (part-in part (first factors)))))))
    (let ((torque (* fingers cm)))
      `((units ,length ,force)
        ,@(and (assoc 'centre description) `((centre ,@(parts 'centre cm))))
        ,@(let ((pose (box-part description 'pose)))
            (and pose `((pose ,(loop for number in (first pose)
                                     collect (/ (supergrip-data:exact-decimal number) cm))
                              ,(second pose)))))
        (size ,@(parts 'size cm)) (weight ,@(parts 'weight fingers)) ,(assoc 'u description)
        (v ,@(parts 'v cm)) ,(assoc 'constrained description)
        (force-needed ,@(parts 'force-needed fingers fingers fingers torque torque torque))
        ,(assoc 'velocity-needed description)))))

(defun record-of (description knowledge &rest how)
  "Return the record of the box of DESCRIPTION as it is written."
  (let ((plan (apply #'supergrip:plan description :knowledge knowledge how)))
    (supergrip::record-in-units (supergrip::plan-record plan)
                                (supergrip::%box-units (supergrip:plan-box plan)))))

(defun same-records-p (a b cm fingers)
  "True if the record A, in cm and finger forces, says what B says in units of CM and FINGERS."
  (labels ((same (a b factor)
             (cond ((realp a) (and (realp b) (close-to a (* b factor))))
                   ((consp a)
                    (and (consp b) (= (length a) (length b))
                         (if (keywordp (first a))
                             (loop for (key x) on a by #'cddr
                                   for (other y) on b by #'cddr
                                   always (and (eq key other) (same x y (factor key))))
                             (every (lambda (x y) (same x y factor)) a b))))
                   (t (equal a b))))
           (factor (key)
             (case key
               ((:offset :position :opening) cm)
               (:squeeze fingers)
               (t 1))))
    (same (uiop:remove-plist-key :reason a)
          (uiop:remove-plist-key :reason (uiop:remove-plist-key :fits b)) 1)))

(defparameter *parcel*
  '((units mm n) (name "parcel") (size 300 60 50) (mass 1.2) (u 0.8) (v 2) (constrained z2)
    (force-needed (5 5 10 100 100 100)) (velocity-needed (1 0 0 0 0 0))))

(defparameter *plain-pencil*
  '((size 12 2 2) (weight 0.2d0) (u 0.8d0) (v 0.2d0) (constrained z2 x1)
    (force-needed (1 0.8d0 0.8d0 0.3d0 1 1)) (velocity-needed (0 0.8d0 0.8d0 0 0.8d0 0.8d0))))

(test the-same-box-in-other-units-has-the-same-record
  (let ((knowledge (force-knowledge)))
    (for-random-boxes (box 60 4101)
      (let ((record (record-of box knowledge)))
        (loop for (length force cm fingers) in *unit-sizes*
              do (let ((other (record-of (box-in box length force cm fingers) knowledge)))
                   (is (same-records-p record other cm fingers) "~s in ~a ~a:~%~s~%~s"
                       box length force record other)
                   (is (eq (eq force :finger)
                           (eq :none (getf other :fits :none))))))))))

(test how-a-box-lies-is-in-its-units
  (let ((knowledge (force-knowledge)))
    (for-random-boxes (box 15 4104)
      (let* ((size (box-part box 'size))
             (box (list* `(pose (40.5d0 -3 12.25d0) (0.6d0 0 0 0.8d0))
                         `(centre ,@(loop for length in size collect (* length 0.2d0)))
                         box))
             (record (record-of box knowledge)))
        (loop for (length force cm fingers) in (rest *unit-sizes*)
              do (is (same-records-p record
                                     (record-of (box-in box length force cm fingers) knowledge)
                                     cm fingers))))))
  (is (search "along X it is 400 from the box centre, and the box ends at 150"
              (first (box-reports (list* '(centre 400 0 0) *parcel*)))))
  (is (equal '("BOX: (POSE 1) is not valid: POSE takes the place of the box centre in the world, x y z in mm, and a unit quaternion x y z w, which turns the box there: (POSE (400 0 125) (0 0 0 1))")
             (box-reports (list* '(pose 1) *parcel*)))))

(test alternatives-are-in-units-too
  (let ((knowledge (force-knowledge)) (checked 0))
    (for-random-boxes (box 25 4106)
      (flet ((alternatives (description)
               (let ((plan (supergrip:plan description :knowledge knowledge)))
                 (getf (supergrip::record-in-units
                        (supergrip::plan-record plan :all 3)
                        (supergrip::%box-units (supergrip:plan-box plan)))
                       :alternatives))))
        (loop for one in (alternatives box)
              for other in (alternatives (box-in box :mm :n 1/10 1/20))
              do (incf checked)
                 (is (same-records-p one other 1/10 1/20)))))
    (is (< 5 checked))))

(defun in-short (description)
  "Return DESCRIPTION with numbers of four decimals."
  (labels ((short (part)
             (cond ((consp part) (mapcar #'short part))
                   ((floatp part) (/ (max 1 (round (* part 10000))) 10000d0))
                   (t part))))
    (mapcar #'short description)))

(test exact-answers-are-the-same-in-other-units
  "Where no digit is lost: the searches of exact mode make much of the last bit."
  (let ((knowledge (force-knowledge)))
    (for-random-boxes (box 10 4102)
      (let* ((box (in-short box)) (record (record-of box knowledge :index :exact)))
        (loop for (length force cm fingers) in (subseq *unit-sizes* 1 3)
              do (is (same-records-p record (record-of (box-in box length force cm fingers)
                                                       knowledge
                                                       :index :exact)
                                     cm fingers)))))))

(test a-number-in-other-units-is-the-one-that-a-person-would-write
  "6 mm, 0.006 m and 0.6 cm are the same double: they are on the same side of each threshold."
  (flet ((size (length &rest numbers)
           (supergrip:box-size (supergrip:parse-box `((units ,length finger)
                                                      ,@(apply #'changed-box :size numbers))))))
    (is (equal '(0.6d0 1.2d0 30d0) (size :cm 0.6d0 1.2d0 30)))
    (is (equal '(0.6d0 1.2d0 30d0) (size :mm 6 12 300)))
    (is (equal '(0.6d0 1.2d0 30d0) (size :m 0.006d0 0.012d0 0.3d0)))
    (is (equal '(2.54d0 1.27d0 0.254d0) (size :in 1 0.5d0 1/10)))))

(test a-mass-stands-in-the-place-of-the-weight
  (flet ((weight (description &optional (newtons 20))
           (supergrip:box-weight (supergrip:plan-box
                                  (supergrip:plan description
                                                  :knowledge (force-knowledge newtons))))))
    (is (close-to (/ (* 1.2d0 9.80665d0) 20) (weight *parcel*)))
    (is (close-to (/ (* 1.2d0 9.80665d0) 50) (weight *parcel* 50)))
    (is (close-to (/ (* 1.2d0 9.80665d0) 20) (weight (cons '(units cm lbf) (rest *parcel*)))))
    (let ((fingers (cons '(mass 1.2d0) (remove :weight *good-box* :key #'first))))
      (is (close-to (/ (* 1.2d0 9.80665d0) 20) (weight fingers)))
      (is (equal (supergrip:box-force-needed (supergrip:parse-box *good-box*))
                 (supergrip:box-force-needed
                  (supergrip:plan-box (supergrip:plan fingers :knowledge (force-knowledge)))))
          "with FINGER the needs stay relative"))))

(test a-plan-s-box-may-be-planned-with-another-gripper
  (let ((box (supergrip:plan-box (supergrip:plan *parcel* :knowledge (force-knowledge 20)))))
    (is (eq box (supergrip:plan-box (supergrip:plan box :knowledge (force-knowledge 20)))))
    (is (equalp (record-of *parcel* (force-knowledge 35)) (record-of box (force-knowledge 35))))))

(test json-has-units-and-mass
  (flet ((json (units)
           (json-box (format nil "{\"units\": ~a, \"size\": [300, 60, 50], \"mass\": 1.2, \"u\": ~
                                  0.8, \"v\": 2, \"constrained\": [\"Z2\"], \"name\": \"parcel\",
                                  \"force_needed\": [5, 5, 10, 100, 100, 100],
                                  \"velocity_needed\": [1, 0, 0, 0, 0, 0]}" units))))
    (dolist (units '("[\"mm\", \"N\"]" "[\"MM\", \"n\"]"))
      (is (equalp (record-of *parcel* (force-knowledge))
                  (record-of (json units) (force-knowledge)))))
    (is (equal '("1: BOX: \"kg\" is not a unit of forces: \"units\" takes a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER: \"units\": [\"MM\", \"N\"]")
               (problem-texts (lambda () (json "[\"mm\", \"kg\"]")))))))

(test what-a-box-gives-is-in-its-units
  (let ((box (supergrip:plan-box (supergrip:plan *parcel* :knowledge (force-knowledge)))))
    (is (equalp #(300d0 60d0 50d0) (supergrip:box-value box :size)))
    (is (equalp #(5d0 5d0 10d0 100d0 100d0 100d0) (supergrip:box-value box :force-needed)))
    (is (equal '("MM" "N") (supergrip:box-value box :units)))
    (is (eql 11.76798d0 (supergrip:box-value box :weight)))
    (is (equal "#<BOX \"parcel\" 300.0 x 60.0 x 50.0 mm>" (princ-to-string box)))))

;;; Fits

(test a-task-fits-where-that-is-proved
  (let ((knowledge (force-knowledge)) (seen '()))
    (flet ((fits (force &optional (weight 2))
             (getf (record-of (list* `(weight ,weight) `(force-needed ,force)
                                     (remove 'force-needed (remove 'mass *parcel* :key #'first)
                                             :key #'first))
                              knowledge)
                   :fits)))
      (is (eq t (fits '(1 1 1 1 1 1))))
      (is (eq t (fits '(0 0 0 0 0 0))) "what needs no force only has to be lifted")
      (is (eq :false (fits '(50 50 50 1000 1000 1000))))
      (is (eq nil (fits '(1 1 1 1 1 1) 1000)) "without a grasp nothing is proved")
      (is (<= 0.87d0
              (let ((plan (supergrip:plan (box-in *plain-pencil* :mm :n 1/10 1/20)
                                          :knowledge knowledge)))
                (supergrip::confidence (supergrip:plan-best plan) plan))
              0.89d0)
          "so does the confidence of a writer")
      ;; Near 1 the proof goes closer.
      (loop for factor from 1/4 to 8 by 1/4
            do (pushnew (fits (loop for need in '(5 5 10 100 100 100) collect (* factor need)))
                        seen)))
    (is (null (set-exclusive-or seen '(t :false))))))

(test extreme-boxes-in-units-have-records
  (let ((knowledge (force-knowledge)) (state (sb-ext:seed-random-state 5)))
    (dotimes (i 40)
      (let ((box (apply #'box-in (extreme-box state) (random-element (rest *unit-sizes*) state))))
        (dolist (index '(:paper :exact))
          (let ((plan (supergrip:plan box :knowledge knowledge :index index)))
            (is (stringp (json-line (supergrip::record-in-units
                                     (supergrip::plan-record plan)
                                     (supergrip::%box-units (supergrip:plan-box plan))))))
            (when (supergrip:plan-best plan)
              (finishes (supergrip:demand-on (supergrip:plan-best plan) plan)))))))))

;;; Margin

(test a-margin-multiplies-weight-and-absolute-needs
  (let ((knowledge (force-knowledge)))
    (flet ((box (description margin)
             (supergrip:plan-box (supergrip:plan description :knowledge knowledge :margin margin))))
      (let ((one (box *parcel* nil)) (more (box *parcel* 3/2)))
        (is (close-to (* 1.5d0 (supergrip:box-weight one)) (supergrip:box-weight more)))
        (is (close-to (mapcar (lambda (need) (* 1.5d0 need)) (supergrip:box-force-needed one))
                      (supergrip:box-force-needed more)))
        (is (equal (supergrip:box-velocity-needed one) (supergrip:box-velocity-needed more))))
      (is (close-to 0.3d0 (supergrip:box-weight (box *good-box* 1.5))))
      (is (equal (supergrip:box-force-needed (box *good-box* nil))
                 (supergrip:box-force-needed (box *good-box* 1.5)))
          "relative needs stay")
      (is (equalp (box *good-box* 1.5)
                  (supergrip:plan-box (supergrip:forward-chain :box *good-box* :margin 1.5
                                                               :knowledge knowledge :stream nil)))))
    (loop for (margin text) in
          '((0 "margin is 0, but must be a number above 0; the weight and absolute needs are multiplied by it")
            (:x "margin is X, but must be a number above 0; the weight and absolute needs are multiplied by it")
            (1d300 "BOX \"parcel\": with a margin of 1e+300 its forces are out of range: they must lie between 1e-300 and 1e300"))
          do (is (equal text (error-text (supergrip:plan *parcel* :knowledge knowledge
                                                                  :margin margin)))))))

;;; Mistakes

(test mistakes-of-units-are-named
  (flet ((reports (&rest changes)
           (let ((box *parcel*))
             (loop for (key clause) on changes by #'cddr
                   do (setf box (remove nil (substitute-if clause
                                                           (lambda (part) (eq (first part) key))
                                                           box))))
             (box-reports box))))
    (loop for (changes report) in
          '(((units (units mm kg))
             "BOX: KG is not a unit of forces: UNITS takes a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER: (UNITS MM N)")
            ((units (units cmm n))
             "BOX: CMM is not a unit of lengths (did you mean MM?): UNITS takes a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER: (UNITS MM N)")
            ((units (units mm fingr))
             "BOX: FINGR is not a unit of forces (did you mean FINGER?): UNITS takes a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER: (UNITS MM N)")
            ((units (units n mm))
             "BOX: (UNITS N MM) is not valid: UNITS takes a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER: (UNITS MM N)")
            ((units (units mm))
             "BOX: (UNITS MM) is not valid: UNITS takes a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER: (UNITS MM N)")
            ((units nil)
             "BOX: (FORCE-NEEDED (5 5 10 100 100 100)) is not valid: FORCE-NEEDED takes a list of six numbers from 0 to 1: (FORCE-NEEDED (1 0.8 0.8 0.3 1 1)); with (UNITS CM N) needs may be absolute")
            ((units (units mm finger))
             "BOX: (FORCE-NEEDED (5 5 10 100 100 100)) is not valid: FORCE-NEEDED takes a list of six numbers from 0 to 1: (FORCE-NEEDED (1 0.8 0.8 0.3 1 1)); with (UNITS MM N) needs may be absolute")
            ((velocity-needed (velocity-needed (2 0 0 0 0 0)))
             "BOX: (VELOCITY-NEEDED (2 0 0 0 0 0)) is not valid: VELOCITY-NEEDED takes a list of six numbers from 0 to 1: (VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))")
            ((mass (mass -1))
             "BOX: (MASS -1) is not valid: MASS takes one number, 0 or more, in kg: (MASS 1.2)")
            ((u (weight 1))
             "BOX: MASS and WEIGHT are both given; give only one of them"
             "BOX: U is missing; it takes one coefficient of friction, 0 or more: (U 0.8)")
            ((mass nil)
             "BOX: WEIGHT is missing; it takes one number, 0 or more, in N: (WEIGHT 0.2)")
            ((size (size 12 2))
             "BOX: (SIZE 12 2) is not valid: SIZE takes three sizes in mm, above 0: (SIZE 120 20 20)")
            ((force-needed (force-needed (1 2 3)))
             "BOX: (FORCE-NEEDED (1 2 3)) is not valid: FORCE-NEEDED takes a list of six numbers, 0 or more, in N and N mm: (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))")
            ((mass (mass 1d300))
             "BOX: (MASS 1.0e300) is out of range: in cm or N, it must lie between 1e-300 and 1e300")
            ((units (units m n) size (size 1 1 1d300))
             "BOX: (SIZE 1 1 1.0e300) is out of range: in cm or N, it must lie between 1e-300 and 1e300"))
          do (is (equal report (first (apply #'reports changes))))))
  (is (equal '("BOX: UNITS is given twice") (box-reports (cons '(units m n) *parcel*)))))

(test a-force-without-finger-force-is-one-error
  (flet ((text (description &rest how)
           (error-text (apply #'supergrip:plan description how))))
    (is (equal "BOX \"parcel\": (UNITS MM N) needs FINGER-FORCE, one finger's greatest normal force in N, which the gripper does not name: add FINGER-FORCE and a number to (SETQ GRIPPER ...) in grasps.lisp"
               (text *parcel*)))
    (is (equal "BOX: MASS needs FINGER-FORCE, one finger's greatest normal force in N, which the gripper does not name: add FINGER-FORCE and a number to (SETQ GRIPPER ...) in grasps.lisp"
               (text (cons '(mass 1) (remove :weight *good-box* :key #'first)))))
    (is (search "in finger forces of 1e-300 N its forces are out of range: they must lie between 1e-300 and 1e300"
                (text (list* '(mass 100) (remove 'mass *parcel* :key #'first))
                      :knowledge (force-knowledge "1e-300"))))
    (signals supergrip:box-error (supergrip:forward-chain :box *parcel* :stream nil))
    (signals supergrip:box-error (supergrip:try "PINCH-2-PARALLEL" :box *parcel* :stream nil))))

(test a-box-that-can-not-be-converted-costs-its-record-only
  (let ((parcel "((UNITS MM N) (NAME \"p\") (SIZE 300 60 50) (MASS 1.2) (U 0.8) (V 2) (CONSTRAINED Z2) (FORCE-NEEDED (5 5 10 100 100 100)) (VELOCITY-NEEDED (0 0 0 0 0 0)))"))
    (destructuring-bind (bad good) (answers (format nil "~%~a~%~a" parcel (one-line *pencil*)))
      (is (equal '("p" 2 "error" "line 2, column 2: (UNITS MM N) needs FINGER-FORCE, one finger's greatest normal force in N, which the gripper does not name: add FINGER-FORCE and a number to (SETQ GRIPPER ...) in grasps.lisp")
                 (loop for key in '(:name :line :status :reason) collect (getf bad key))))
      (is (equal "grasp" (getf good :status))))
    (with-text-file (grasps (force-grasps))
      (destructuring-bind (one two) (append (answers parcel "--grasps" grasps)
                                            (answers parcel "--grasps" grasps "--margin" "2"))
        (is (equal '("grasp" t) (list (getf one :status) (getf one :fits))))
        (is (= 30d0 (abs (second (getf (first (getf one :contacts)) :position)))) "in mm")
        (is (< (* 1.9d0 (getf two :sure)) (getf one :sure)) "a margin of 2")))
    (is (search "--margin must be a number above 0, not -1"
                (nth-value 2 (answers parcel "--margin" "-1"))))))

;;; In words

(defun words (function)
  "Return what FUNCTION prints, in one line."
  (format nil "~{~a~^ ~}" (lines-of (with-output-to-string (*standard-output*)
                                      (funcall function)))))

(test answers-are-in-the-units-of-the-box
  (let* ((knowledge (force-knowledge))
         (plan (supergrip:plan (box-in *plain-pencil* :mm :n 1/10 1/20) :knowledge knowledge))
         (best (words (lambda () (supergrip:explain-best plan)))))
    (dolist (part '("Force is limited about Y: the grasp exerts 219 N mm beyond the weight's load, the task needs 200 N mm; radius 1.095."
                    "It does not fit: surely 87 %, and at most 89 %, of what is asked; weakest about Y."
                    "the torsional friction v: 1.1 mm, not 2 mm; then"
                    "the force needed along Y: 13.9 N, not 16 N; then"
                    "the friction u: 0.1, not 0.8; then"
                    "the weight: 32.1 N, not 4 N; then"))
      (is (search part best) "~a~%~a" part best))
    (is (not (search "which is enough if the needs only say"
                     (subseq best 0 (search "Velocity" best)))))
    (is (search "the size along Y: 2.99 mm, not 20 mm (less than FINGER-WIDTH, 3 mm)"
                (words (lambda () (supergrip:requires '(small (y2 y1)) plan)))))
    (flet ((plan-with (&rest clauses)
             (supergrip:plan (append clauses
                                     (remove-if (lambda (clause)
                                                  (find (first clause) clauses :key #'first))
                                                *parcel*))
                             :knowledge knowledge)))
      (loop for (plan text) in
            (list (list (plan-with '(mass 30) '(size 200 50 60))
                        "the load along Z is 294.2 N, the grasp bears 32")
                  (list (plan-with '(size 200 250 260))
                        "the narrowest free pair, X, is 200 mm; the hand opens to 120"))
            do (is (search text (supergrip:plan-reason plan)) "~a: ~a" text
                   (supergrip:plan-reason plan)))
      (is (search "they are 250 mm apart, no less than DIST-PINCH, 120"
                  (words (lambda ()
                           (supergrip:how '(large (y2 y1)) (plan-with '(size 200 250 260))))))))
    (is (search "F3 on Y1: from (0 10 0) mm to ("
                (words (lambda () (supergrip:explain-refinement
                                   (supergrip:plan (box-in *plain-pencil* :mm :n 1/10 1/20)
                                                   :knowledge knowledge))))))
    (is (equal "#<BOX 12.0 x 2.0 x 2.0 cm>" (princ-to-string (supergrip:parse-box *good-box*))))))

(test a-change-in-units-changes-the-choice
  "What EXPLAIN-BEST names is in the units of the box: the box with it, described anew, is one for
which something else is chosen; in finger forces and cm the limit is the same."
  (let ((knowledge (force-knowledge)) (checked 0))
    (for-random-boxes (box 30 4103)
      (flet ((changes (description)
               (supergrip:choice-changes
                (supergrip:explain-choice (supergrip:plan description :knowledge knowledge)))))
        (let ((before (changes box))
              (plan (supergrip:plan (box-in box :mm :n 1/10 1/20) :knowledge knowledge)))
          (dolist (change (changes (box-in box :mm :n 1/10 1/20)))
            (incf checked)
            (let ((anew (supergrip:parse-box (supergrip::box-description (supergrip:change-box change)))))
              (is (not (supergrip::same-choice-p plan (supergrip:plan anew :knowledge knowledge)))))
            (let ((same (find (supergrip:change-what change) before
                              :key #'supergrip:change-what :test #'string=))
                  (measure (supergrip::change-measure change)))
              ;; An absolute need may be any; one that is not ends at 1.
              (when same
                (is (close-to (supergrip:change-limit same)
                              (* (supergrip:change-limit change)
                                 (case measure (:length 1/10) (:force 1/20) (:torque 1/200) (t 1)))
                              1d-6))))))))
    (is (< 5 checked))))

(test demands-in-words
  (loop for (fits surely at-most text) in
        '((t 1.408d0 1.42d0 "It fits: surely 140 % of what is asked; weakest about Y.")
          (t 1d0 1.42d0 "It fits: surely 100 % of what is asked; weakest about Y.")
          (:false 0.9995d0 0.99991d0
           "It does not fit: surely 99.95 %, and at most 99.99 %, of what is asked; weakest about Y.")
          (:false -0.5d0 -0.5d0 "It does not fit: exactly, the contacts can't hold the weight.")
          (nil 0.99999d0 1.00001d0
           "Whether it fits was not proved: surely 99.999 %, and at most 100.001 %, of what is asked; weakest about Y.")
          (t nil nil "It fits: no force is asked for, and it holds the weight."))
        do (is (equal text (supergrip:demand-text
                            (supergrip::make-demand :fits fits :surely surely :at-most at-most
                                                    :weakest "about Y"))))))

(test what-is-given-comes-back-as-it-was-given
  (let ((units (supergrip::%box-units
                (supergrip:plan-box
                 (supergrip:plan '((units mm n) (size 90 60 30) (mass 0.1) (u 0.6) (v 3.2)
                                   (constrained) (force-needed (1 1 1 1 1 1))
                                   (velocity-needed (0 0 0 0 0 0)))
                                 :knowledge (supergrip:load-knowledge
                                             :gripper (project-file
                                                       "examples/hands/robotiq-3-finger.lisp"))))))
        (state (sb-ext:seed-random-state 7)))
    (flet ((back (number measure)
             (supergrip::in-units (supergrip::from-units number measure units) measure units)))
      (is (eql 0.2d0 (back 0.2d0 :force)))
      (is (loop repeat 2000
                for number = (/ (random 10000000 state) (expt 10d0 (random 12 state)))
                always (loop for measure in '(:length :force :torque)
                             always (eql number (back number measure))))))))
