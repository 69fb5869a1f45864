;;;; study.lisp -- measures what docs/ says about many boxes; no part of the tests.
;;;;
;;;; sbcl --script t/study.lisp                             what docs/reconstruction.md counts
;;;; sbcl --script t/study.lisp cases | python3 t/cones.py  how tight bounds are, for docs/physics.md
;;;; sbcl --script t/study.lisp compare RULES GRASPS        what other files answer differently
;;;; sbcl --script t/study.lisp further-work                what docs/further-work.md counts
;;;; sbcl --script t/study.lisp sure                        how tight the sure radius is
;;;; sbcl --script t/study.lisp choice                      exact choices, candidate by candidate
;;;; sbcl --script t/study.lisp lifting                     what sound lifting loses
;;;; sbcl --script t/study.lisp lying                       what changes if a box's frame is turned
;;;; sbcl --script t/study.lisp index                       u_w beside the exact radius
;;;; sbcl --script t/study.lisp refined [COUNT]             rules, trying everything, and refining
;;;; sbcl --script t/study.lisp grid [COUNT [SEED]]         refined grasps against a grid of places
;;;; sbcl --script t/study.lisp legal [COUNT]               refined grasps: legal, and no worse
;;;; sbcl --script t/study.lisp radii | python3 t/radii.py  exact radii by other means

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

;;; The rules against every grasp in every matching

(defparameter *kinds*
  '(("all sizes" random-box) ("on a table" table-box) ("household" household-box)
    ("rubber" rubber-box))
  "Kinds of random boxes, and the function that makes one.")

(defun boxes-of (maker count seed)
  (loop with state = (sb-ext:seed-random-state seed)
        repeat count collect (supergrip:parse-box (funcall maker state))))

(defun plans (boxes knowledge &optional (gamma 0.5d0))
  (loop for box in boxes collect (supergrip:plan box :knowledge knowledge :gamma gamma)))

(defun count-worse (ours others)
  "Return how many of OURS, plans, have a grasp of lower quality than those of OTHERS have."
  (loop for our in ours for other in others
        count (and (supergrip:plan-grasp our) (supergrip:plan-grasp other)
                   (< (supergrip:plan-quality our) (- (supergrip:plan-quality other) 1d-9)))))

(defun microseconds (boxes knowledge &optional (index :paper))
  "Return the processor time of a plan by INDEX, the mean of BOXES by KNOWLEDGE, in microseconds."
  (let ((start (get-internal-run-time)))
    (dolist (box boxes)
      (supergrip:plan box :knowledge knowledge :index index))
    (/ (- (get-internal-run-time) start)
       (/ internal-time-units-per-second 1000000d0) (length boxes))))

(defun least-times (boxes &rest several)
  "Return the least time of a plan of BOXES by each knowledge of SEVERAL, measured in turn."
  (loop with least = (mapcar (constantly 1d9) several)
        repeat 20
        do (setf least (loop for knowledge in several for time in least
                             collect (min time (microseconds boxes knowledge))))
        finally (return least)))

(defun tried (plans)
  (/ (loop for plan in plans sum (length (supergrip:plan-candidates plan))) (length plans)))

(defun reason-p (text plan)
  (eql 0 (search text (supergrip:plan-reason plan))))

(defun why-missed (ours wide)
  "Return why OURS, a plan, has no grasp though some grasp in some matching is possible; WIDE is the
plan by every grasp on faces as wide as a fingertip."
  (cond ((reason-p "CANT GRASP TOO SLIPPERY" ours) :slippery)
        ((null (supergrip:plan-grasp wide)) :thin)
        (t :other)))

(defun misses (ours all wide)
  "Return how many plans of ALL have a grasp, but not of OURS: too slippery, too thin, others."
  (loop for our in ours for one in all for w in wide
        for missed = (and (supergrip:plan-grasp one) (null (supergrip:plan-grasp our))
                          (why-missed our w))
        count (eq missed :slippery) into slippery
        count (eq missed :thin) into thin
        count (eq missed :other) into other
        finally (return (list slippery thin other))))

(defun print-claim (everything wide)
  "Print what the rules try, find and reach, against EVERYTHING, knowledge without rules; WIDE is
the same with PINCH-2-PARALLEL on faces as wide as a fingertip."
  (loop for (kind maker) in *kinds*
        do (let* ((boxes (boxes-of maker 3000 1))
                  (ours (plans boxes supergrip:*knowledge*))
                  (all (plans boxes everything))
                  (all-wide (plans boxes wide)))
             (format t "3000 boxes, ~a~%~2tcandidates a box: ~,1f by the rules, ~,1f by all~%"
                     kind (tried ours) (tried all))
             (format t "~2tboxes with a grasp: ~d, ~d~%" (count-if #'supergrip:plan-grasp ours)
                     (count-if #'supergrip:plan-grasp all))
             (format t "~{~2tmissed: ~d too slippery, ~d too thin, ~d others~%~}"
                     (misses ours all all-wide))
             (format t "~2ta lower quality than by all: ~d; with gamma 0: ~d; with gamma 1: ~d~%"
                     (count-worse ours all-wide)
                     (count-worse (plans boxes supergrip:*knowledge* 0d0) (plans boxes wide 0d0))
                     (count-worse (plans boxes supergrip:*knowledge* 1d0) (plans boxes wide 1d0)))
             (format t "~{~2ttime of a plan: ~,1f µs, ~,1f µs~%~}"
                     (least-times boxes supergrip:*knowledge* everything)))))

(defun with-widths (grasps small face)
  "Return GRASPS, a text, with SMALL for the rules and FACE for the faces of grasps, in cm."
  (let ((name "FINGER-WIDTH  0.3"))
    (loop for place = (search ">= FINGER-WIDTH" grasps)
          while place
          do (setf grasps (format nil "~a>= FACE-WIDTH~a" (subseq grasps 0 place)
                                  (subseq grasps (+ place (length ">= FINGER-WIDTH"))))))
    (replace-once grasps name (format nil "FINGER-WIDTH ~a FACE-WIDTH ~a" small face))))

(defun print-widths ()
  "Print what other widths of a fingertip would do, one for rules and grasps or one for each."
  (let ((boxes (boxes-of 'household-box 3000 2)) (grasps (file-text "grasps.lisp")))
    (loop for (small face) in '((0.6 0.6) (0.5 0.5) (0.4 0.4) (0.3 0.3) (0.2 0.2) (0.1 0.1)
                                (0.3 0.6) (0.6 0.3))
          do (let* ((text (with-widths grasps small face))
                    (wide (with-widths (with-wide-faces grasps) small face))
                    (ours (plans boxes (text-knowledge (file-text "rules.lisp") text))))
               (destructuring-bind (slippery thin others)
                   (misses ours (plans boxes (everything-knowledge text))
                           (plans boxes (everything-knowledge wide)))
                 (declare (ignore slippery))
                 (format t "SMALL below ~a cm, faces from ~a cm: ~d of 3000 household boxes have a ~
                            grasp; missed: ~d that PINCH-2-PARALLEL alone holds, ~d others~%"
                         small face (count-if #'supergrip:plan-grasp ours) thin others))))))

;;; U and C

(defun possible-p (candidate)
  (eq :possible (supergrip:candidate-outcome candidate)))

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

(defun print-shapes (everything)
  (loop for (kind maker) in (subseq *kinds* 0 2)
        do (let ((pairs 0) (one 0))
             (dolist (plan (plans (boxes-of maker 3000 1) everything))
               (loop for (u . c) in (u-and-c-shapes (supergrip:plan-candidates plan))
                     do (when (or (possible-p u) (possible-p c)) (incf pairs))
                        (unless (eq (possible-p u) (possible-p c)) (incf one))))
             (format t "3000 boxes, ~a: ~d pairs of U and C with the same contacts where one is ~
                        possible; in ~d only one~%" kind pairs one))))

;;; The textbook's chainer

(defun restarting (rules facts try)
  "Run RULES as SUPERGRIP-ORACLE:ORACLE-RUN-RULES does, but from the top after each that remembers
or tries something new: again with all rules up to it, until there is none."
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

;;; Other knowledge

(defun print-comparison (rules grasps)
  "Print which of 10,000 random boxes the files RULES and GRASPS answer differently."
  (supergrip:compare-knowledge (supergrip:load-knowledge :rules rules :grasps grasps)
                               supergrip:*knowledge* (boxes-of 'random-box 10000 2026)))

;;; Grasps without formulas

(defun quantile (share numbers)
  (let ((sorted (sort (coerce numbers 'vector) #'<)))
    (aref sorted (floor (* share (1- (length sorted)))))))

(defun choices (differences)
  "Return what is chosen in DIFFERENCES, and how often: a list of (OLD NEW COUNT), the most frequent
first."
  (let ((table (make-hash-table :test #'equal)))
    (dolist (difference differences)
      (incf (gethash (list (or (supergrip:plan-grasp (supergrip:difference-old difference)) "can't")
                           (or (supergrip:plan-grasp (supergrip:difference-new difference)) "can't"))
                     table 0)))
    (sort (loop for (old new) being the hash-keys of table using (hash-value count)
                collect (list old new count))
          #'> :key #'third)))

(defun print-changes (what old new boxes)
  "Print what differs for BOXES between the knowledge OLD and NEW, WHAT they are; return the
differences."
  (let ((differences (supergrip:compare-knowledge old new boxes :stream nil)))
    (flet ((of (kind) (count kind differences :key #'supergrip:difference-what)))
      (format t "~a: of ~d boxes ~d differ in verdict, ~d in grasp, ~d in quality alone~%~:{  ~a, now ~
                 ~a: ~d~%~}"
              what (length boxes) (of :verdict) (of :grasp) (of :quality)
              (choices (remove :quality differences :key #'supergrip:difference-what))))
    differences))

(defun lost (differences)
  "Return how many of DIFFERENCES have no grasp any more, or one of lower quality."
  (loop for difference in differences
        for old = (supergrip:plan-quality (supergrip:difference-old difference))
        for new = (supergrip:plan-quality (supergrip:difference-new difference))
        count (and old (or (null new) (< new (- old 1d-9))))))

(defun print-plan-times (knowledge boxes)
  "Print how long plans of BOXES by KNOWLEDGE take, at first and again, beside the shipped ones."
  (let ((first (loop for box in boxes collect (microseconds (list box) knowledge)))
        (ratios (loop for box in boxes
                      collect (apply #'/ (least-times (make-list 200 :initial-element box)
                                                      knowledge supergrip:*knowledge*)))))
    (format t "~d boxes: a plan takes ~,1f ms at first, median, ~,1f for one in ten, ~,1f at most; ~
               again, it takes ~,2f times as long as a shipped one, median, ~,2f for one in ten~%"
            (length boxes) (/ (quantile 0.5 first) 1000) (/ (quantile 0.9 first) 1000)
            (/ (quantile 1 first) 1000) (quantile 0.5 ratios) (quantile 0.9 ratios))))

(defun print-further-work ()
  (let* ((directory (project-file "examples/further-work/"))
         (further (supergrip:load-knowledge :hand directory))
         (seven (handler-bind ((warning #'muffle-warning))
                  (supergrip:load-knowledge :grasps (merge-pathnames "grasps.lisp" directory))))
         (boxes (append (boxes-of 'table-box 400 2026) (boxes-of 'household-box 400 2026)
                        (boxes-of 'rubber-box 200 2026))))
    (print-changes "the seven grasps without formulas, the shipped rules" supergrip:*knowledge* seven
                   boxes)
    (format t "lost by LATERAL and WIDE-CORNER: ~d~%"
            (lost (print-changes "with LATERAL and WIDE-CORNER" seven further boxes)))
    (print-plan-times (supergrip:load-knowledge :hand directory) (subseq boxes 300 500))))

;;; What contacts can really do

(defun print-radii (count state)
  "Print COUNT cases for radii.py, a third of them coupled, most of boxes that lie askew."
  (loop for (case) in (random-candidate-cases count state
                                              (lambda (state) (laid (random-box state) state)))
        for number from 0
        for coupled = (zerop (mod number 3))
        do (destructuring-bind (contacts u v need gravity) case
             (multiple-value-bind (upper lower worst)
                 (supergrip:exact-radius contacts u v need :gravity gravity :coupled coupled)
               (let ((*read-default-float-format* 'double-float))
                 (format t "~d~{ ~f~} ~f ~f ~d~{ ~f~}~{ ~f~} ~f ~:[nan~;~:*~f~]~{ ~f~}~%"
                         (length contacts) (reduce #'append (reduce #'append contacts))
                         u v (if coupled 1 0) need gravity upper lower worst))))))

(defun print-sure (count state)
  "Print how the sure radius compares with the exact one on COUNT candidates."
  (let ((above 0) (not-certified 0) (ratios '()))
    (loop for (case sure) in (random-candidate-cases count state)
          do (multiple-value-bind (upper lower) (exact-radius-of case)
               (unless lower (incf not-certified))
               (when (> sure (+ upper 1d-9)) (incf above))
               (when (plusp upper) (push (/ sure upper) ratios))))
    (let ((sorted (sort (coerce ratios 'vector) #'<)))
      (flet ((quantile (share) (aref sorted (floor (* share (1- (length sorted)))))))
        (format t "~d candidates: the sure radius is above the exact one in ~d; sure / exact: median ~
                   ~,2f, 10 % are below ~,2f, least ~,2f, greatest ~,3f; ~d exact ones not certified~%"
                count above (quantile 0.5) (quantile 0.1) (quantile 0) (quantile 1)
                not-certified)))))

(defun print-choices (count)
  "Print whether the choices of exact mode on COUNT boxes with a grasp are the best, each possible
candidate certified alone."
  (let ((state (sb-ext:seed-random-state 1)) (faults '()) (boxes 0) (candidates 0) (ratios '()))
    (loop until (= boxes count)
          do (let ((plan (exact-plan (random-box state))))
               (when (supergrip:plan-best plan)
                 (incf boxes)
                 (multiple-value-bind (wrong possible met) (choice-faults plan 30)
                   (incf candidates possible)
                   (setf faults (append wrong faults) ratios (append met ratios))))))
    (let ((sorted (sort (coerce ratios 'vector) #'<)))
      (format t "~d boxes with a grasp, ~d possible candidates: ~d faults~%~{~a~%~}" boxes
              candidates (length faults) faults)
      (format t "least ratio met / upper value: least ~,4f, median ~,4f, 90 % below ~,4f~%"
              (aref sorted 0) (aref sorted (floor (length sorted) 2))
              (aref sorted (floor (* 0.9 (length sorted))))))))

(defun quantiles (numbers shares)
  (let ((sorted (sort (coerce numbers 'vector) #'<)))
    (loop for share in shares collect (aref sorted (floor (* share (1- (length sorted))))))))

(defun print-index (kind boxes)
  "Print how the exact radius of the best grasps of BOXES of KIND compares with u_w, by default."
  (loop for plan in (plans boxes supergrip:*knowledge*)
        for best = (supergrip:plan-best plan)
        for u-w = (and best (supergrip:candidate-force-radius best))
        for (upper lower) = (and u-w (multiple-value-list
                                      (supergrip:candidate-exact-radius best plan)))
        when u-w
          count t into all and collect (/ upper u-w) into ratios
          and count (and lower (> lower (* 1.0001d0 u-w))) into above
          and count (< upper (* 0.9999d0 u-w)) into below
          and count (>= u-w 1) into enough
          and count (and (>= u-w 1) (< upper 1)) into not-enough
        finally (format t "~d best grasps, ~a: exact radius / u_w: ~{least ~,2f, 5 % below ~,2f, ~
                           median ~,2f, 95 % below ~,2f, greatest ~,2f~}~%"
                        all kind (quantiles ratios '(0 0.05 0.5 0.95 1)))
                (format t "~2tthe exact radius is above u_w in ~d, below it in ~d; of ~d with u_w from ~
                           1 on, ~d can't do the task~%"
                        above below enough not-enough)))

(defun up-to-half-turns (candidates)
  "Return what CANDIDATES are, a list: those that the paper's index takes for the same are one."
  (let ((same (supergrip::index-same (supergrip::index-named :paper))))
    (remove-duplicates
     (loop for candidate in candidates
           for grasp = (supergrip::%candidate-grasp candidate)
           for matching = (supergrip::%candidate-matching candidate)
           collect (list (supergrip:candidate-grasp candidate)
                         (aref (funcall same grasp) (supergrip::matching-index matching))))
     :test #'equal)))

(defun lost-at (outcome plan exact)
  "Return how many candidates of PLAN that failed with OUTCOME are possible in EXACT."
  (length (intersection (up-to-half-turns
                         (remove outcome (supergrip:plan-rejected plan)
                                 :key #'supergrip:candidate-outcome :test-not #'eq))
                        (up-to-half-turns (supergrip:plan-possible exact)) :test #'equal)))

(defun possible-count (plan) (length (supergrip:plan-possible plan)))

(defun print-exact-time (boxes)
  (format t "~2ttime of a plan by the exact index: ~,1f ms, the mean of those with a grasp~%"
          (/ (microseconds (remove-if-not (lambda (box) (supergrip:plan-best (exact-plan box))) boxes)
                           supergrip:*knowledge* :exact)
             1000)))

(defun print-lifting (kind boxes)
  "Print what closure and lifting by the paper's index lose on BOXES of KIND, against the exact
one."
  (let ((plans (plans boxes supergrip:*knowledge*)) (exact (mapcar #'exact-plan boxes)))
    (flet ((grasps (plans) (count-if #'supergrip:plan-best plans))
           (sum (function plans) (reduce #'+ (mapcar function plans)))
           (only (plans others)
             (count t (mapcar (lambda (plan other)
                                (and (supergrip:plan-best plan) (null (supergrip:plan-best other))))
                              plans others)))
           (lost (outcome)
             (reduce #'+ (mapcar (lambda (plan exact) (lost-at outcome plan exact)) plans exact))))
      (format t "~d boxes, ~a~%~2tpossible candidates: ~d by the paper's index, ~d by the exact ~
                 one (~d with half-turns); ~d are lost at lifting, ~d at closure~%"
              (length boxes) kind (sum #'possible-count plans)
              (sum (lambda (plan) (length (up-to-half-turns (supergrip:plan-possible plan)))) exact)
              (sum #'possible-count exact) (lost :lifting) (lost :open))
      (format t "~2tboxes with a grasp: ~d by the paper's index, ~d by the exact one; only by the ~
                 exact one: ~d, only by the paper's: ~d~%~
                 ~2tpossible candidates that drop the box: ~d, ~d~%"
              (grasps plans) (grasps exact) (only exact plans) (only plans exact)
              (sum (lambda (plan) (length (dropped plan))) plans)
              (sum (lambda (plan) (length (dropped plan))) exact)))))

;;; How boxes lie

(defun held-places (plan back)
  "Return the best grasp of PLAN, and where its contacts are after BACK, a function of a place, in
an order of their own; or NIL."
  (let ((best (supergrip:plan-best plan)))
    (and best
         (list (supergrip:plan-grasp plan)
               (sort (loop for contact in (supergrip:candidate-contacts best plan)
                           collect (funcall back (getf contact :position)))
                     #'< :key (lambda (place) (reduce #'+ (mapcar #'* '(1d0 1.37d0 1.91d0) place))))))))

(defun turned-back-by (matching)
  "Return a function of a place after the turn that MATCHING is: the place before it."
  (lambda (place)
    (loop for axis across (supergrip::matching-axes matching)
          for sign across (supergrip::matching-signs matching)
          collect (* sign (nth axis place)))))

(defun lying-changes (box)
  "Return, for each of the 24 turns of the frame of BOX, the change of the best Q, and :MOVED if
another grasp, or one elsewhere on the box, is then the best."
  (let* ((plan (supergrip:plan box)) (quality (supergrip:plan-quality plan))
         (held (held-places plan #'identity)))
    (loop for matching in *rotations*
          for turned = (supergrip:plan (turn-laid box matching))
          for other = (supergrip:plan-quality turned)
          collect (list (cond ((and quality other) (abs (- quality other)))
                              ((or quality other) 1d0)
                              (t 0d0))
                        (unless (same-places-p held (held-places turned (turned-back-by matching)))
                          :moved)))))

(defun same-places-p (a b)
  (and (equal (first a) (first b)) (close-to (second a) (second b) 1d-6)))

(defun print-lying (count)
  "Print what the 24 turns of the frames of COUNT boxes that lie somehow change."
  (let ((boxes (laid-boxes count 1)) (moved 0) (greatest 0d0) (askew 0) (grasps 0) (upright 0))
    (dolist (box boxes)
      (let ((changes (lying-changes box)) (plan (supergrip:plan box)))
        (setf greatest (reduce #'max (mapcar #'first changes) :initial-value greatest))
        (when (find :moved changes :key #'second) (incf moved))
        (when (supergrip:plan-best plan) (incf grasps))
        (let ((other (supergrip:plan (without box 'pose 'centre))))
          (when (supergrip:plan-best other) (incf upright))
          (unless (equal (list (supergrip:plan-grasp plan) (supergrip:plan-matching plan))
                         (list (supergrip:plan-grasp other) (supergrip:plan-matching other)))
            (incf askew)))))
    (format t "~d boxes that lie somehow, 24 turns of each frame: Q changes by ~,1e at most; in ~d boxes ~
               the best grasp is another one of equal Q in some turn~%~
               ~d have a grasp, ~d if POSE and CENTRE are left out; ~d answers differ~%"
            count greatest moved grasps upright askew)))

(defun draw-if-possible (ways refinements)
  "Draw the study into docs/study.svg, if the pictures can be loaded."
  (when (ignore-errors (let ((*standard-output* (make-broadcast-stream)))
                         (asdf:load-system "supergrip/draw")))
    (load (project-file "t/study-picture.lisp"))
    (format t "~%~a~%" (uiop:symbol-call :supergrip-test :draw-study ways refinements
                                         (project-file "docs/study.svg")))))

(destructuring-bind (&optional what . files) (rest sb-ext:*posix-argv*)
  (cond ((equal what "cases") (print-cases (sb-ext:seed-random-state 1)))
        ((equal what "further-work") (print-further-work))
        ((equal what "sure") (print-sure 10000 (sb-ext:seed-random-state 1)))
        ((equal what "choice") (print-choices 500))
        ((equal what "lifting") (loop for (kind maker) in (subseq *kinds* 0 2)
                                         do (let ((boxes (boxes-of maker 2000 1)))
                                              (print-lifting kind boxes)
                                              (print-exact-time (subseq boxes 0 500)))))
        ((equal what "lying") (print-lying 1000))
        ((equal what "index") (loop for (kind maker) in (subseq *kinds* 0 2)
                                    do (print-index kind (boxes-of maker 2000 1))))
        ((equal what "refined")
         (let ((count (parse-integer (or (first files) "1000"))))
           (multiple-value-bind (ways refinements) (print-study count)
             (print-times ways)
             (draw-if-possible ways refinements))))
        ((equal what "grid") (print-grid (parse-integer (or (first files) "200"))
                                         (parse-integer (or (second files) "7"))))
        ((equal what "legal")
         (unless (print-legal (parse-integer (or (first files) "200")))
           (sb-ext:exit :code 1)))
        ((equal what "radii") (print-radii 300 (sb-ext:seed-random-state 1)))
        ((equal what "compare") (apply #'print-comparison files))
        (t
         (let ((everything (everything-knowledge))
               (wide (everything-knowledge (with-wide-faces (file-text "grasps.lisp")))))
           (print-ranges)
           (print-claim everything wide)
           (print-widths)
           (print-shapes everything)
           (print-differences (sb-ext:seed-random-state 1))))))
