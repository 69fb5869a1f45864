;;;; candidate-curves.lisp -- a candidate as a function of one value of the box: whether it is
;;;; possible, and its Q.
;;;;
;;;; The steps of TRY once more, as curves: one row each.  They compute what the steps compute, in
;;;; the same order, so that their bounds are bounds of the plan's own numbers.

(in-package :supergrip)

;;; Single values of a box

(defun value-at (box row index)
  "Return the value of the key ROW of BOX, at INDEX if that is several numbers."
  (let ((value (funcall (box-key-reader row) box)))
    (if (arrayp value) (aref value index) value)))

(defun box-with-at (box row index value)
  "Return a box as BOX with VALUE for the key ROW, at INDEX if that is several numbers."
  (let ((numbers (funcall (box-key-reader row) box)))
    (if (arrayp numbers)
        (let ((copy (copy-seq numbers)))
          (setf (aref copy index) value)
          (box-with box row copy))
        (box-with box row value))))

(defun value-count (row)
  "Return how many numbers the key ROW has."
  (let ((type (box-key-type row)))
    (cond ((eq type :needs) 6) ((consp type) (second type)) (t 1))))

(defun value-name (row index)
  (format nil "~a~@[ ~a~]" (box-key-words row)
          (and (> (value-count row) 1) (axis-name index))))

;;; Lines, and candidates along them

(defstruct line
  "One value of the box of PLAN, that of the key ROW, at INDEX if it has several, which varies: it
is FROM now, and may be LEAST to MOST.  KNOWN maps what is known of a box (see LINE-FACTS) to what
follows from it; FORMS maps a grasp and the curves that its forms start from to what they give;
COUNT counts the intervals looked at; SURE is false if some were left out; DEAR is true if plans
along it take milliseconds."
  plan row (index 0) (from 0d0) (least 0d0) (most 0d0) (known '())
  (forms (make-hash-table :test #'equal)) (count 0 :type fixnum) (sure t) (dear nil))

(defstruct prospect
  "A candidate, GRASP in MATCHING, along a line: POSSIBLE, a test, and QUALITY are curves.  ALWAYS
says whether it is possible in all of the interval at hand, where Q is from LEAST to MOST."
  grasp matching possible quality
  always (least 0d0 :type double-float) (most 0d0 :type double-float))

(defstruct sheet
  "A candidate whose curves are being made: those that its forms start from, INPUTS, and what they
and the steps give; in the box frame but for CENTRE."
  line grasp matching inputs forms (centre '()) (offset (make-array 3)) (wrench (make-array 6))
  (twist (make-array 6)) (load (make-array 6)) (spare (make-array 6)) (sides '()) quality)

(defvar *step-curves* '() "An alist from the names of steps of TRY to functions of a sheet.")

(defmacro define-step-curve (name (sheet) &body body)
  "Define the curve of the step NAME of TRY.  BODY returns a test, a curve, which is true if the
candidate of SHEET passes, and leaves in SHEET what later steps need.  Of a step without one
nothing is known."
  `(setf *step-curves* (with-row (cons ',name (lambda (,sheet) ,@body)) *step-curves* #'car)))

(defun box-curve (line slot &optional (index 0))
  "Return the curve of what the box of LINE has in its SLOT, at INDEX if that is several numbers."
  (let* ((row (find slot *box-keys* :key #'box-key-slot)))
    (if (and (eq row (line-row line)) (= index (line-index line)))
        *variable*
        (constant-curve (value-at (plan-box (line-plan line)) row index)))))

(defun form-slot-p (slot)
  "True if forms depend on what a box has in SLOT: see INPUT-CURVES."
  (member slot '(:friction :soft-friction :size)))

(defun input-curves (line matching)
  "Return the curves of the registers that box and MATCHING give."
  (let ((box (plan-box (line-plan line))) (axes (matching-axes matching)))
    (flet ((blocked (face)
             (constant-curve (if (logbitp face (%box-constrained box)) 1d0 0d0))))
      (coerce (append (list (box-curve line :friction) (box-curve line :soft-friction))
                      (loop for i below 3 collect (box-curve line :size (aref axes i)))
                      (map 'list #'blocked (matching-faces matching)))
              'simple-vector))))

(defun sheet-of (line grasp matching)
  "Return a sheet for GRASP in MATCHING along LINE."
  (let* ((inputs (input-curves line matching))
         (key (cons (grasp-index grasp) (map 'list #'curve-number inputs)))
         (forms (line-forms line)))
    (make-sheet :line line :grasp grasp :matching matching :inputs inputs
                :forms (or (gethash key forms)
                           (setf (gethash key forms) (make-hash-table :test #'eq))))))

(defun sheet-box (sheet) (plan-box (line-plan (sheet-line sheet))))

(defun sheet-number (sheet node) (node-curve node (sheet-inputs sheet) (sheet-forms sheet)))

(defun sheet-six (sheet node)
  "Return the six curves of NODE, a part of the grasp of SHEET."
  (let ((forms (sheet-forms sheet)))
    (or (gethash node forms)
        (setf (gethash node forms) (six-curves node (sheet-inputs sheet) forms)))))

(defun sheet-draft (sheet) (grasp-draft (sheet-grasp sheet)))

(defun all-of (tests)
  (reduce (lambda (a b) (both-curve :and a b)) tests
          :from-end t :initial-value (constant-curve 1d0)))

(defun sum-curve (curves)
  (if curves
      (reduce (lambda (a b) (as-curve (+ a b))) curves)
      (constant-curve 0d0)))

;;; The steps

(define-step-curve conditions (sheet)
  (sheet-number sheet (draft-conditions (sheet-draft sheet))))

(define-step-curve offset (sheet)
  (let ((entries (sheet-six sheet (draft-offset (sheet-draft sheet)))))
    (setf (sheet-centre sheet)
          (loop for (plus minus) on entries by #'cddr collect (as-curve (* 0.5d0 (- plus minus)))))
    (all-of (loop for (plus minus) on entries by #'cddr
                  collect (if (opposite-p plus minus)
                              (guard-curve (constant-curve 1d0) (list plus minus))
                              (as-curve (<= (abs (+ plus minus)) (* 1d-9 (+ 1d0 (abs plus))))))))))

(defun unguarded (curve)
  (if (eq (curve-kind curve) :guard) (unguarded (first (curve-args curve))) curve))

(defun opposite-p (a b)
  "True if the curves A and B are opposite numbers by the way they are made."
  (flet ((difference (curve)
           (and (eq (curve-kind curve) (the-operator "-")) (mapcar #'unguarded (curve-args curve))))
         (zero-p (curve) (and curve (fixed-p curve) (zerop (curve-least curve)))))
    (let ((a (unguarded a)) (b (unguarded b)))
      (destructuring-bind (&optional a1 a2) (difference a)
        (destructuring-bind (&optional b1 b2) (difference b)
          (or (and a1 (eq a1 b2) (eq a2 b1))
              (and (zero-p a1) (eq a2 b))
              (and (zero-p b1) (eq b2 a))))))))

(define-step-curve fingers (sheet)
  (let ((inputs (sheet-inputs sheet)) (margin (constant-curve (+ 1d0 1d-9))))
    (all-of (loop for (grasp-face . places) in (draft-contacts (sheet-draft sheet))
                  append (loop for axis in (remove (floor grasp-face 2) '(0 1 2))
                               for place in places
                               for at = (sheet-number sheet place)
                               for length = (svref inputs (+ +distances+ axis))
                               for centre = (nth axis (sheet-centre sheet))
                               collect (as-curve (<= (abs (+ centre at))
                                                     (* (* 0.5d0 length) margin))))))))

(define-step-curve closure (sheet)
  (let ((axes (matching-axes (sheet-matching sheet))) (draft (sheet-draft sheet)))
    (flet ((turn (entries out least)
             (loop for entry in entries
                   for axis across axes
                   do (setf (svref out axis) entry)
                   collect (as-curve (> entry least)))))
      (all-of (append (turn (wrench-curves sheet) (sheet-wrench sheet) (constant-curve 0d0))
                      (turn (sheet-six sheet (draft-twist draft)) (sheet-twist sheet)
                            (constant-curve -1d-300)))))))

(defun wrench-curves (sheet)
  "Return what the grasp of SHEET exerts, six curves.  If it has twelve entries, put them, those
along the axes of the box and those against them, into SHEET, and return the lesser of both."
  (let* ((entries (sheet-six sheet (draft-wrench (sheet-draft sheet))))
         (others (nthcdr 6 entries)) (matching (sheet-matching sheet)))
    (if (null others)
        entries
        (let ((ahead (make-array 6)) (behind (make-array 6)))
          (loop for along in entries
                for against in others
                for axis across (matching-axes matching)
                for i from 0
                for turned = (minusp (aref (matching-signs matching) (mod i 3)))
                do (setf (svref ahead axis) (if turned against along)
                         (svref behind axis) (if turned along against)))
          (setf (sheet-sides sheet) (list ahead behind))
          (loop for along in entries for against in others
                collect (as-curve (min along against)))))))

(define-step-curve lifting (sheet)
  (let ((offset (sheet-offset sheet)))
    (loop for centre in (sheet-centre sheet)
          for axis across (matching-axes (sheet-matching sheet))
          repeat 3
          do (setf (svref offset axis) (as-curve (abs centre))))
    (replace (sheet-load sheet) (load-curves sheet))
    (replace (sheet-spare sheet) (spare-curves sheet))
    (let ((shares (sum-curve (loop for load across (sheet-load sheet)
                                   for has in (bearing-curves sheet #'identity)
                                   unless (zero-curve-p load) collect (as-curve (/ load has))))))
      (as-curve (<= shares 1d0)))))

(defun bearing-curves (sheet side)
  "Return the six curves of what bears the load of SHEET; or of the other way, if SIDE is NOT, not
IDENTITY."
  (if (null (sheet-sides sheet))
      (coerce (sheet-wrench sheet) 'list)
      (destructuring-bind (ahead behind) (sheet-sides sheet)
        (loop for axis below 6
              for borne in (borne-curves sheet)
              for minus = (as-curve (< borne 0d0))
              for a = (svref ahead axis)
              for b = (svref behind axis)
              collect (if (funcall side t) (as-curve (if minus b a)) (as-curve (if minus a b)))))))

(defun spare-curves (sheet)
  "Return the six curves of what the grasp of SHEET exerts beside the load: as PUT-SPARE."
  (loop for has in (bearing-curves sheet #'identity)
        for other in (bearing-curves sheet #'not)
        for load across (sheet-load sheet)
        collect (if (sheet-sides sheet)
                    (as-curve (min (- has load) (+ other load)))
                    (as-curve (- has load)))))

(defun borne-curves (sheet)
  "Return the six curves whose signs say which way the load of SHEET is borne: as PUT-BORNE, for a
weight of 1."
  (let ((down (%box-down (sheet-box sheet))))
    (flet ((down-curve (axis) (constant-curve (aref down axis))))
      (append (loop for axis below 3 collect (constant-curve (- (aref down axis))))
              (loop for (i j) in '((1 2) (2 0) (0 1))
                    for a = (arm-curve sheet i)
                    for b = (arm-curve sheet j)
                    for down-i = (down-curve i)
                    for down-j = (down-curve j)
                    collect (as-curve (- (* a down-j) (* b down-i))))))))

(defun zero-curve-p (curve) (and (fixed-p curve) (zerop (curve-least curve))))

(defun times-curve (curve number)
  "Return CURVE times NUMBER, 0 or more."
  (cond ((zerop number) (constant-curve 0d0))
        ((= number 1d0) curve)
        (t (as-curve (* curve (constant-curve number))))))

(defun arm-curve (sheet axis)
  "Return the curve of the grasp centre of SHEET from the centre of mass, along AXIS, 0 to 2."
  (let* ((matching (sheet-matching sheet))
         (place (position axis (matching-axes matching)))
         (centre (nth place (sheet-centre sheet)))
         (signed (if (minusp (aref (matching-signs matching) place))
                     (as-curve (- 0d0 centre))
                     centre))
         (mass (constant-curve (aref (%box-mass-centre (sheet-box sheet)) axis))))
    (if (zero-curve-p mass) signed (as-curve (- signed mass)))))

(defun moment-curve (sheet i j)
  "Return the curve of the torque of a weight of 1 at the grasp centre of SHEET, without sign; I and
J are the two axes that it is not about."
  (let* ((box (sheet-box sheet))
         (down-i (aref (%box-down box) i)) (down-j (aref (%box-down box) j)))
    (flet ((size (axis)
             (if (zerop (aref (%box-mass-centre box) axis))
                 (svref (sheet-offset sheet) axis)
                 (as-curve (abs (arm-curve sheet axis))))))
      (cond ((zerop down-i) (times-curve (size i) (abs down-j)))
            ((zerop down-j) (times-curve (size j) (abs down-i)))
            (t (let ((a (arm-curve sheet i)) (b (arm-curve sheet j)))
                 (as-curve (abs (- (* a (constant-curve down-j))
                                   (* b (constant-curve down-i)))))))))))

(defun load-curves (sheet)
  "Return the six curves of the load of gravity on the candidate of SHEET: as PUT-LOAD."
  (let ((weight (box-curve (sheet-line sheet) :weight)))
    (append (loop for down across (%box-down (sheet-box sheet))
                  collect (times-curve weight (abs down)))
            (loop for (i j) in '((1 2) (2 0) (0 1))
                  for moment = (moment-curve sheet i j)
                  collect (if (zero-curve-p moment) moment (as-curve (* weight moment)))))))

(defun shifted-curves (needs from to offset)
  "Return NEEDS, six curves, at the grasp centre, OFFSET from the box centre: as ADD-TURNED."
  (let ((out (copy-seq needs)))
    (loop for (i j k) in '((0 1 2) (1 2 0) (2 0 1))
          do (setf (svref out (+ to i))
                   (as-curve (+ (svref needs (+ to i))
                                (+ (* (svref offset j) (svref needs (+ from k)))
                                   (* (svref offset k) (svref needs (+ from j))))))))
    out))

(defun radius-curve (needs have)
  "Return the curves of the radius of NEEDS inside HAVE, six curves each, and of the test whether
one is needed at all."
  (let ((tests (loop for need across needs collect (as-curve (> need 0d0)))))
    (values (reduce (lambda (a b) (as-curve (min a b)))
                    (loop for need across needs
                          for has across have
                          for test in tests
                          collect (as-curve (if test (/ has need) #.most-positive-double-float))))
            (reduce (lambda (a b) (as-curve (or a b))) tests))))

(defun needs-curves (line slot)
  (coerce (loop for axis below 6 collect (box-curve line slot axis)) 'simple-vector))

(define-step-curve quality (sheet)
  (let* ((line (sheet-line sheet)) (offset (sheet-offset sheet))
         (gamma (plan-gamma (line-plan line)))
         (one (constant-curve gamma)) (rest (constant-curve (- 1d0 gamma))))
    (multiple-value-bind (force force-p)
        (radius-curve (shifted-curves (needs-curves line :force) 0 3 offset) (sheet-spare sheet))
      (multiple-value-bind (velocity velocity-p)
          (radius-curve (shifted-curves (needs-curves line :velocity) 3 0 offset)
                        (sheet-twist sheet))
        (let ((quality (as-curve (if velocity-p
                                     (if force-p (+ (* one velocity) (* rest force)) velocity)
                                     force))))
          (setf (sheet-quality sheet) quality)
          (new-curve :value (list quality)))))))

;;; All together

(defun steps-curve (sheet)
  "Return the curve that is true where the candidate of SHEET passes all steps."
  (let ((tests '()))
    (loop for step in (steps-of (plan-index (line-plan (sheet-line sheet))))
          for row = (assoc (try-step-name step) *step-curves*)
          for test = (new-curve :holds (list (if row
                                                 (funcall (cdr row) sheet)
                                                 (new-curve :unknown '()))))
          do (push test tests)
          until (and (fixed-p test) (zerop (curve-least test))))
    (all-of (reverse tests))))

(defun prospect-of (line candidate)
  "Return the prospect of CANDIDATE along LINE, or NIL if it is possible nowhere.  After a step that
always fails no Q is computed."
  (let* ((grasp (%candidate-grasp candidate)) (matching (%candidate-matching candidate))
         (sheet (sheet-of line grasp matching))
         (possible (steps-curve sheet)))
    (and (sheet-quality sheet)
         (not (and (fixed-p possible) (zerop (curve-least possible))))
         (make-prospect :grasp grasp :matching matching :possible possible
                        :quality (sheet-quality sheet)))))

(defun same-prospect-p (a b)
  (and (eq (prospect-possible a) (prospect-possible b))
       (eq (prospect-quality a) (prospect-quality b))))

(defun prospects-of (plan line)
  "Return the prospects of the candidates of PLAN, in their order.  Of two that are the same the
later can't be the best."
  (and (not (and (plan-stop plan) (eq :cant (stop-verdict (plan-stop plan)))))
       (remove-duplicates (loop for candidate in (plan-candidates plan)
                                for prospect = (prospect-of line candidate)
                                when prospect collect prospect)
                          :test #'same-prospect-p :from-end t)))
