;;;; from-contacts.lisp -- grasps that need no formulas: REACH, and WRENCH and TWIST FROM-CONTACTS.

(in-package :supergrip-test)
(define-suite from-contacts
  "Grasps that need no formulas: REACH, and WRENCH and TWIST FROM-CONTACTS.")

(defun further-work ()
  "Return the knowledge of examples/further-work, without its warnings."
  (handler-bind ((warning #'muffle-warning))
    (supergrip:load-knowledge :hand (project-file "examples/further-work/"))))

(defparameter *pencil-lines* 4 "How many of the best grasps of the pencil are those of the paper.")

;;; What is wrong is said

(defun reach-reports (&rest changes)
  "Return what is said of a grasp that has REACH, with CHANGES, as of GRASP-REPORTS."
  (apply #'grasp-reports
         (append changes '(:offset nil :wrench nil :twist nil))))

(test a-grasp-of-five-lines-is-good
  (is (null (reach-reports :contacts "((N1 0 0) (N2 0 0)) REACH (A 4)")))
  (is (null (reach-reports :contacts nil :palm "A2 REACH (A FROM-FINGERS)")))
  (is (null (reach-reports :palm "A2 REACH (A (+ FINGER-LENGTH 1))"))))

(test mistakes-in-a-reach-are-named
  (loop for (reach . reports) in
        '(("(A)" "REACH: (A): REACH gives axes and lengths in turn, such as (N 4.85 A 4.85) or (A FROM-FINGERS)")
          ("(X 4)" "REACH: X is not an axis: REACH is along N, O or A")
          ("(A2 4)" "REACH: A2 is not an axis (did you mean A?): REACH is along N, O or A")
          ("(A 4 A 5)" "REACH: the reach along A is given twice")
          ("(A 0)" "REACH: the reach along A is 0, but must be above 0")
          ("(A (- FINGER-LENGTH 5))" "REACH: the reach along A is (- FINGER-LENGTH 5), -2, but must be above 0")
          ("(A (LET* ((x 3)) (- x 3)))" "REACH: the reach along A is (LET* ((X 3)) (- X 3)), 0, but must be above 0")
          ("(N 4)" "REACH: the hand does not come over N1 or N2, since both are used; leave the reach along N out")
          ("(O 4)" "REACH: the hand does not come over O1 or O2, since neither is used; leave the reach along O out")
          ("(A FINGER-LENGHT)" "REACH: FINGER-LENGHT is not a length (did you mean FINGER-LENGTH?); a reach is FROM-FINGERS, a number, or a form of the gripper's dimensions")
          ("(A FROM-FINGER)" "REACH: FROM-FINGER is not a length (did you mean FROM-FINGERS?); a reach is FROM-FINGERS, a number, or a form of the gripper's dimensions")
          ("(A (* 2 FROM-FINGERS))" "REACH: (* 2 FROM-FINGERS): FROM-FINGERS stands alone, in place of a length")
          ("(A (* 2 FINGER-LENGHT))" "REACH: unknown name FINGER-LENGHT (did you mean FINGER-LENGTH?); known are U, V, the gripper's dimensions, a helper's parameters and what LET* binds")
          ("(A 4) OFFSET (0 0 0 0 0 0)" ": REACH stands in place of OFFSET; give one of them"))
        do (is (equal (loop for report in reports
                            collect (format nil "grasps.lisp:7: GRASP G~:[, ~;~]~a"
                                            (eql #\: (char report 0)) report))
                      (reach-reports :palm (format nil "A2~% REACH ~a" reach)))
               "~a" reach))
  (is (equal '("grasps.lisp:3: GRASP G, REACH: FROM-FINGER: REACH gives axes and lengths in turn, such as (N 4.85 A 4.85) or (A FROM-FINGERS) (did you mean FROM-FINGERS?)")
             (reach-reports :palm "A2 REACH FROM-FINGER")))
  (is (equal '("grasps.lisp:7: GRASP G, REACH: FROM-FINGERS along A needs fingers on two opposite faces of one other axis; write a length instead")
             (reach-reports :used-surfaces "(N1 O1 A2)" :contacts "((N1 0 0) (O1 0 0))"
                            :palm (format nil "A2~% REACH (A FROM-FINGERS)")))))

(test mistakes-in-words-are-named
  (is (equal '("grasps.lisp:3: GRASP G, WRENCH: FROM-CONTACT is not a list of six entries (did you mean FROM-CONTACTS?); WRENCH FROM-CONTACTS computes it")
             (grasp-reports :wrench "FROM-CONTACT")))
  (is (equal '("grasps.lisp:7: GRASP G, TWIST: (FROM-CONTACT) is not a list of six entries (did you mean FROM-CONTACTS?); TWIST FROM-CONTACTS computes it")
             (grasp-reports :twist "(FROM-CONTACT)")))
  (is (equal '("grasps.lisp:6: GRASP G, WRENCH: (FROM-CONTACTS 1 1 1 1 1): FROM-CONTACTS stands alone, in place of six entries")
             (grasp-reports :wrench "(FROM-CONTACTS 1 1 1 1 1)")))
  (is (equal '("grasps.lisp:3: GRASP G, OFFSET: FROM-FINGERS is not a list of six entries; REACH may take the place of OFFSET, such as REACH (A FROM-FINGERS)")
             (grasp-reports :offset "FROM-FINGERS")))
  (is (null (grasp-reports :wrench "FROM-CONTACTS" :twist "from-contacts"))))

(test what-is-computed-waits-for-the-parts-that-it-needs
  "A part that is wrong is reported, and nothing is computed of it."
  (loop for changes in '((:palm "A1") (:palm "Q") (:used-surfaces "(N1 N2)") (:used-surfaces "(Q)")
                         (:used-surfaces nil) (:contacts "((N1 0))") (:contacts "((Q 0 0) (N2 0 0))")
                         (:contacts "((N1 P 0) (N2 0 0))") (:offset "(LIST 0 0 Q 0 0 0)")
                         (:offset nil) (:used-surfaces "(N1 N2)" :palm nil))
        do (is (= 1 (length (apply #'grasp-reports :twist "FROM-CONTACTS" :wrench "FROM-CONTACTS"
                                   changes)))
               "~a" changes)
           (unless (member :offset changes)
             (is (= 1 (length (apply #'reach-reports
                                     (append changes
                                             (list :conditions (format nil "(T)~% REACH (A 4)"))))))
                 "~a beside REACH" changes))))

;;; What is derived

(defun shipped-and-derived (name)
  "Return the grasp NAME of the shipped knowledge, and that of examples/further-work."
  (values (shipped-grasp name)
          (supergrip::find-grasp (supergrip::knowledge-graspbase (further-work)) name)))

(defun program-values (program graspbase size u v)
  "Return the results of PROGRAM on a box of SIZE along N O A, or NIL."
  (let ((registers (copy-seq (supergrip::graspbase-registers graspbase))))
    (setf (aref registers supergrip::+u+) u (aref registers supergrip::+v+) v)
    (replace registers size :start1 supergrip::+distances+)
    (and (supergrip-data:without-float-traps (supergrip::execute program registers))
         (loop for register across (supergrip::program-results program)
               collect (aref registers register)))))

(defun random-sizes (state)
  (loop repeat 3 collect (random-between 0.6d0 20d0 state)))

(test offsets-are-those-of-the-shipped-grasps
  (let ((state (sb-ext:seed-random-state 5))
        (shipped (supergrip::knowledge-graspbase supergrip:*knowledge*))
        (derived (supergrip::knowledge-graspbase (further-work))))
    (dolist (grasp (supergrip:knowledge-grasps supergrip:*knowledge*))
      (let ((other (supergrip::find-grasp derived (supergrip:grasp-name grasp))))
        (is (loop repeat 300
                  for size = (random-sizes state)
                  always (equalp (program-values (supergrip::grasp-offset grasp) shipped size 0.5d0
                                                 0.2d0)
                                 (program-values (supergrip::grasp-offset other) derived size
                                                 0.5d0 0.2d0)))
            "~a" grasp)))))

(defun exact-p (name axis)
  (nth axis (rest (assoc name *exact* :test #'string=))))

(test entries-agree-with-the-shipped-ones
  (let ((state (sb-ext:seed-random-state 11))
        (shipped (supergrip::knowledge-graspbase supergrip:*knowledge*))
        (derived (supergrip::knowledge-graspbase (further-work))) (compared 0))
    (dolist (grasp (supergrip:knowledge-grasps supergrip:*knowledge*))
      (let* ((name (supergrip:grasp-name grasp)) (other (supergrip::find-grasp derived name)))
        (loop repeat 12
              for size = (random-sizes state)
              for u = (random 2d0 state) for v = (random 0.4d0 state)
              for old = (program-values (supergrip::grasp-wrench grasp) shipped size u v)
              for new = (and old (program-values (supergrip::grasp-wrench other) derived size u v))
              when (and new (every #'plusp new) (every #'plusp old))
                do (incf compared)
                   (loop for a in old
                         for b in (both-ways new)
                         for axis from 0
                         do (is (if (exact-p name axis)
                                    (< (abs (- a b)) (* 1d-6 a))
                                    (<= a (* b (+ 1 1d-9))))
                                "~a, ~a, u ~a, v ~a: entry ~d: ~a, shipped ~a" name size u v axis b
                                a)))))
    (is (> compared 30))))

(test the-pencil-keeps-its-winner
  (let ((lines (lambda (knowledge)
                 (loop for candidate in (supergrip:plan-possible
                                         (supergrip:plan (paper-box) :knowledge knowledge))
                       repeat *pencil-lines*
                       collect (list (supergrip:candidate-grasp candidate)
                                     (supergrip:candidate-matching candidate))))))
    (is (equal (funcall lines supergrip:*knowledge*) (funcall lines (further-work))))))

(test what-is-derived-is-described
  (let* ((knowledge (further-work))
         (text (with-output-to-string (out)
                 (supergrip:describe-grasp "PINCH-3-C-SHAPE" :knowledge knowledge :stream out))))
    (is (search "Derived: OFFSET" text))
    (is (search "(POSIT (- (/ (DIST '(O1 O2)) 2) REACH-C))" text))
    (is (search "WRENCH is what the contacts exert" text))
    (is (search "TWIST is how well" text))))

;;; Any friction

(test a-box-that-sticks-like-glue-is-planned-for
  (let ((knowledge (further-work)))
    (dolist (u '(100 1d5 1d12 1d60))
      (is (supergrip:plan-best (supergrip:plan (changed-box :u u) :knowledge knowledge)) "u ~a" u))))

;;; The way of gravity counts

(defun row-box (weight &rest others)
  "Return a box of WEIGHT in the air, with OTHERS as clauses."
  (supergrip:parse-box `((size 6 4 3) (weight ,weight) (u 0.5) (v 0.2) (constrained)
                         (force-needed (1 1 1 0 0 0)) (velocity-needed (0 0 0 0 0 0)) ,@others)))

(defun possible-n1-faces (knowledge box)
  "Return the faces on which PINCH-3-PARALLEL of KNOWLEDGE may have two fingers on BOX."
  (sort (remove-duplicates
         (loop for candidate in (supergrip:plan-possible
                                 (supergrip:try-grasp "PINCH-3-PARALLEL" box :knowledge knowledge))
               collect (first (supergrip:candidate-matching candidate)))
         :test #'string=)
        #'string<))

(test two-fingers-below-carry-more-than-one
  ;; Alone across the weight, friction bears 1 finger force; on the faces above and below, a pair of
  ;; fingers bears 2 and the thumb 1.
  (let ((knowledge (further-work)))
    (is (equal '() (possible-n1-faces supergrip:*knowledge* (row-box 1.5d0))))
    (is (equal '("Z2") (possible-n1-faces knowledge (row-box 1.5d0))))
    ;; Upside down, and on its side.
    (is (equal '("Z1") (possible-n1-faces knowledge (row-box 1.5d0 '(pose (0 0 0) (1 0 0 0))))))
    (let ((root (sqrt 0.5d0)))
      (is (equal '("Y2") (possible-n1-faces knowledge
                                            (row-box 1.5d0 `(pose (0 0 0) (,root 0 0 ,root)))))))))

(test gravity-helps-the-other-way
  ;; Held from below and above, with 1.5 of weight: .5 is left upward; downward 1 and the weight.
  (let* ((knowledge (further-work))
         (plan (supergrip:try-grasp "PINCH-3-PARALLEL" (row-box 1.5d0) :knowledge knowledge))
         (candidate (first (supergrip:plan-possible plan))))
    (is (nearly-p 1 (third (supergrip:candidate-wrench candidate plan))))
    (is (nearly-p 0.5 (third (supergrip:candidate-spare candidate plan))))
    (is (nearly-p 0.5 (supergrip:candidate-force-radius candidate)))))

(test grasps-that-gravity-tells-apart-are-both-tried
  (flet ((tried (knowledge &rest others)
           (length (supergrip:plan-candidates
                    (supergrip:try-grasp "PINCH-3-PARALLEL" (apply #'row-box 0.1d0 others)
                                         :knowledge knowledge)))))
    ;; Where N is vertical, which of 24 matchings is 8, it matters on which face two fingers are.
    (is (= 12 (tried supergrip:*knowledge*)))
    (is (= 16 (tried (further-work))))
    (is (= 24 (tried (further-work) '(pose (0 0 0) (0.6d0 0 0 0.8d0)))))))

;;; The lateral and the wide grasp

(defun example-box (name)
  "Return the box that the example NAME sets."
  (let ((text (file-text (format nil "examples/~a.lisp" name)))
        (*package* (find-package :supergrip-user))
        (*read-default-float-format* 'double-float))
    (second (third (read-from-string text t nil :start (search "(setq box" text))))))

(test the-new-grasps-win-where-they-should
  (loop for (name grasp shipped) in '(("tile-in-rack" "LATERAL" "PINCH-3-PARALLEL")
                                      ("foam-cube" "WIDE-CORNER" nil))
        for box = (example-box name)
        do (is (equal grasp (supergrip:plan-grasp (supergrip:plan box :knowledge (further-work)))))
           (is (equal shipped (supergrip:plan-grasp (supergrip:plan box))))))

(test the-new-grasps-lose-nothing
  (let ((state (sb-ext:seed-random-state 12)) (further (further-work))
        (seven (handler-bind ((warning #'muffle-warning))
                 (supergrip:load-knowledge
                  :grasps (project-file "examples/further-work/grasps.lisp")))))
    (loop for maker in (list #'table-box #'household-box #'rubber-box)
          do (loop repeat 15
                   do (let* ((box (supergrip:parse-box (funcall maker state)))
                             (before (supergrip:plan-quality (supergrip:plan box :knowledge seven)))
                             (after (supergrip:plan-quality (supergrip:plan box
                                                                            :knowledge further))))
                        (is-true (or (null before) (and after (>= after (- before 1d-9))))
                                 "~a: ~a, was ~a" box after before))))))

(test sheets-are-held-where-lateral-can
  "Where the hand spans only the thin side, LATERAL is tried before the box is given up."
  (let ((state (sb-ext:seed-random-state 3)) (further (further-work)) (held 0))
    (loop repeat 60
          for box = `((size ,(random-between 12d0 25d0 state) ,(random-between 12d0 25d0 state)
                            ,(random-between 0.3d0 4d0 state))
                      (weight ,(random-between 0.01d0 1d0 state))
                      (u ,(random-between 0.101d0 1d0 state)) (v 0.2d0) (constrained)
                      (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1)))
          for plan = (supergrip:plan box :knowledge further)
          do (if (supergrip:plan-best plan)
                 (when (equal "LATERAL" (supergrip:plan-grasp plan)) (incf held))
                 (is (null (supergrip:plan-best
                            (supergrip:try-grasp "LATERAL" box :knowledge further)))
                     "~s" box)))
    (is (plusp held))))
