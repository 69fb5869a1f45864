;;;; curves.lisp -- forms as functions of one value of the box, and bounds of them between two
;;;; places.
;;;;
;;;; A curve is a number, or a test, that depends on one value, VARIABLE, while the rest of the
;;;; box stays.  What does not depend on it is computed at once, and curves that are made in the
;;;; same way are the same object.  Bounds are those of the doubles that a plan computes: see
;;;; BOUNDS-FUNCTION.

(in-package :supergrip)

(defstruct (curve (:constructor make-curve (number kind args)) (:copier nil))
  "A number or a test.  KIND and ARGS, which are curves, say how it is made:
  :CONSTANT, :VARIABLE     an arithmetic operator, a comparison
  :NOT :AND :OR            :IF test a b
  :FORK test a b  the same, without value where TEST is not decided
  :GUARD a b...  A, without value where one of the others has none
  :HOLDS test    TEST, false where it has no value
  :VALUE a       whether A has a value
  a component    that of a computation, of numbers
  :UNKNOWN       a test of which nothing is known.
RANGE is what it is at least and at most, of a test 0 for false and 1 for true, CERTAINTY 2 if it
has a value in any case, 1 perhaps, 0 nowhere; both in the interval that has the number STAMP.
SLOPE is the curve of its derivative, NIL if that is not known, or :UNMADE.  PLAINER is a curve
that is the same in the interval PLAINER-STAMP: see PLAINER.  OPAQUE is true if its bounds may say
nothing, however narrow the interval is."
  (number 0 :type fixnum) (kind nil) (args '() :type list)
  (range (make-array 2 :element-type 'double-float :initial-element 0d0) :type interval)
  (certainty 2 :type (integer 0 2)) (stamp -1 :type fixnum) (slope :unmade)
  (plainer nil) (plainer-stamp -1 :type fixnum) (opaque nil))

(define-printing (curve curve) "~d ~a" (curve-number curve) (curve-kind curve))

(declaim (inline curve-least curve-most))
(defun curve-least (curve) (aref (curve-range curve) 0))
(defun curve-most (curve) (aref (curve-range curve) 1))

(defun fixed-p (curve) (eq (curve-kind curve) :constant))

(defvar *curves* nil "A table of the curves being made, from how they are made.")
(defvar *variable* nil "The curve of the value that varies.")
(defvar *stamp* 0 "The number of the interval at hand.")
(declaim (type fixnum *stamp*))

(defmacro with-curves (() &body body)
  "Run BODY with curves of their own."
  `(let* ((*curves* (make-hash-table :test #'equal))
          (*variable* (make-curve 0 :variable '()))
         (*stamp* 0))
     ,@body))

;;; Making them

(defun constant-curve (number &optional (certainty 2))
  "Return the curve of NUMBER; of what has no value if CERTAINTY is 0."
  (let ((key (list* :constant certainty (rational number))))
    (or (gethash key *curves*)
        (let ((curve (make-curve (1+ (hash-table-count *curves*)) :constant '())))
          (fill (curve-range curve) number)
          (setf (curve-certainty curve) certainty
                (curve-slope curve) curve
                (gethash key *curves*) curve)))))

(defun new-curve (kind args)
  "Return the curve of KIND with ARGS: a constant if they are."
  (let ((key (cons kind (mapcar #'curve-number args))))
    (or (gethash key *curves*)
        (let ((curve (make-curve (1+ (hash-table-count *curves*)) kind args)))
          (setf (gethash key *curves*)
                (if (and args (every #'fixed-p args))
                    (let ((bound (compute-bounds curve 0)))
                      (constant-curve (if (zerop (curve-certainty bound)) 0d0 (curve-least bound))
                                      (curve-certainty bound)))
                    (progn (setf (curve-opaque curve)
                                 (or (opaque-kind-p kind args) (some #'curve-opaque args)))
                           curve)))))))

(defun opaque-kind-p (kind args)
  "True if nothing is known of a curve of KIND with ARGS but at single places."
  (cond ((arithmetic-p kind) (null (arithmetic-bounds kind)))
        ((component-p kind) (not (only-rises-p kind args)))
        ((comparison-p kind) (null (comparison-mirror kind)))
        (t (eq kind :unknown))))

(defun curve-order (curves)
  (sort (copy-list curves) #'< :key #'curve-number))

(defun joined-curves (operator curve)
  "Return the curves that OPERATOR joins in CURVE."
  (if (eq operator (curve-kind curve))
      (loop for arg in (curve-args curve) append (joined-curves operator arg))
      (list curve)))

(defun operation-curve (operator args)
  "Return the curve of OPERATOR on ARGS, one or two."
  (let ((kind (arithmetic-kind operator)))
    (cond ((or (null (rest args)) (null kind)) (new-curve operator args))
          ((eq kind :symmetric) (new-curve operator (curve-order args)))
          (t (reduce (lambda (a b) (new-curve operator (curve-order (list a b))))
                     (curve-order (remove-duplicates
                                   (loop for arg in args
                                         append (joined-curves operator arg)))))))))

(defun if-curve (kind test a b)
  (cond ((not (fixed-p test))
         (if (and (eq a b) (eq kind :if))
             (guard-curve a (list test))
             (new-curve kind (list test a b))))
        ((zerop (curve-certainty test)) test)
        ((plusp (curve-least test)) a)
        (t b)))

(defun guard-curve (curve others)
  "Return CURVE, without a value where one of OTHERS has none."
  (let ((others (remove-if (lambda (other) (or (eq other curve) (eq (curve-kind other) :variable)
                                               (and (fixed-p other) (= 2 (curve-certainty other)))))
                           (remove-duplicates others))))
    (if others (new-curve :guard (cons curve (curve-order others))) curve)))

(defun both-curve (kind a b)
  "Return the curve of A and B joined by KIND, :AND or :OR."
  (cond ((not (fixed-p a)) (new-curve kind (list a b)))
        ((zerop (curve-certainty a)) a)
        ((eq (plusp (curve-least a)) (eq kind :and)) b)
        (t a)))

(defmacro the-operator (name)
  "Return the operator that NAME, a literal, named when this was loaded."
  `(load-time-value (find-operator ,name)))

(defmacro as-curve (form)
  "Return the curve of FORM: operators and comparisons on numbers and on what other forms return,
curves; AND, OR, NOT and IF."
  (flet ((name-p (name) (and (symbolp name) (find-operator (symbol-name name)))))
    (cond ((realp form) `(constant-curve ,(coerce form 'double-float)))
          ((atom form) form)
          (t (let ((args (loop for part in (rest form) collect `(as-curve ,part))))
               (case (first form)
                 (and (reduce (lambda (a b) `(both-curve :and ,a ,b)) args :from-end t))
                 (or (reduce (lambda (a b) `(both-curve :or ,a ,b)) args :from-end t))
                 (not `(new-curve :not (list ,@args)))
                 (if `(if-curve :if ,@args))
                 (t (cond ((not (name-p (first form))) form)
                          ((comparison-p (name-p (first form)))
                           `(new-curve (the-operator ,(string (first form))) (list ,@args)))
                          (t `(operation-curve (the-operator ,(string (first form)))
                                               (list ,@args)))))))))))

(defun node-curve (node inputs done)
  "Return the curve of NODE, which gives a number or is a test.  INPUTS are the curves of the
registers that box and matching give, DONE a table of the nodes that have a curve already."
  (or (gethash node done)
      (setf (gethash node done)
            (flet ((curve (node) (node-curve node inputs done)))
              (destructuring-bind (&optional first &rest others) (node-args node)
                (ecase (node-kind node)
                  (:constant (constant-curve first))
                  (:input (svref inputs first))
                  (:operation (operation-curve first (mapcar #'curve others)))
                  (:let (guard-curve (curve (first others)) (mapcar #'curve first)))
                  (:cond (clauses-curve (node-args node) #'curve))
                  (:true (constant-curve 1d0))
                  (:false (constant-curve 0d0))
                  (:not (new-curve :not (list (curve first))))
                  ((:and :or) (both-curve (node-kind node) (curve first) (curve (first others))))
                  (:constrained (svref inputs (+ +blocked+ first)))
                  (:comparison (new-curve first (mapcar #'curve others)))))))))

(defun clauses-curve (clauses curve)
  "Return the curve of CLAUSES, tests and values; CURVE gives that of a node."
  (destructuring-bind ((test value) . others) clauses
    (let ((test (funcall curve test)))
      (if (and (fixed-p test) (plusp (curve-least test)))
          (funcall curve value)
          (if-curve :if test (funcall curve value) (clauses-curve others curve))))))

(defun six-curves (node inputs done)
  "Return the six curves of NODE, which gives six numbers, as NODE-CURVE does."
  (node-case (:six node)
    (:list (&rest entries)
      (loop for entry in entries collect (node-curve entry inputs done)))
    (:let (nodes body)
      (let ((guards (loop for node in nodes collect (node-curve node inputs done))))
        (loop for curve in (six-curves body inputs done) collect (guard-curve curve guards))))
    (:cond (&rest clauses)
      (destructuring-bind ((test value) . others) clauses
        (if (null others)
            (six-curves value inputs done)
            (mapcar (lambda (a b) (if-curve :if (node-curve test inputs done) a b))
                    (six-curves value inputs done)
                    (six-curves (node :cond nil (first others)) inputs done)))))
    (:computed (computation &rest nodes)
      (let ((numbers (loop for node in nodes collect (node-curve node inputs done))))
        (loop for component across (computation-components computation)
              collect (new-curve component numbers))))))

;;; Slopes

(defun slope (curve)
  "Return the curve of the derivative of CURVE, or NIL if it is not known."
  (when (eq (curve-slope curve) :unmade)
    (setf (curve-slope curve) (new-slope curve)))
  (if (fixed-p curve) (constant-curve 0d0) (curve-slope curve)))

(defun new-slope (curve)
  (let ((kind (curve-kind curve)) (args (curve-args curve)))
    (case kind
      (:variable (constant-curve 1d0))
      (:guard (slope (first args)))
      (:if (let ((a (slope (second args))) (b (slope (third args))))
             ;; A curve may jump where the test changes.
             (and a b (if-curve :fork (first args) a b))))
      (t (when (and (arithmetic-p kind) (arithmetic-slope kind))
           (let ((slopes (mapcar #'slope args)))
             (and (notany #'null slopes)
                  (slope-curve (arithmetic-slope kind)
                               (list (cons 'x (first args)) (cons 'y (second args))
                                     (cons 'dx (first slopes)) (cons 'dy (second slopes))
                                     (cons 'value curve))))))))))

(defun slope-curve (form names)
  "Return the curve of FORM, the slope of an operator; NAMES, an alist, gives those of its
symbols."
  (flet ((zero-p (curve) (and (fixed-p curve) (zerop (curve-least curve)))))
    (cond ((realp form) (constant-curve (coerce form 'double-float)))
          ((symbolp form) (cdr (assoc form names)))
          ((eq (first form) 'if)
           (destructuring-bind ((comparison a b) . branches) (rest form)
             (apply #'if-curve :if (new-curve (find-operator (string comparison))
                                              (list (slope-curve a names) (slope-curve b names)))
                    (loop for branch in branches collect (slope-curve branch names)))))
          (t (let ((a (slope-curve (second form) names)) (b (slope-curve (third form) names)))
               (case (first form)
                 (+ (cond ((zero-p a) b) ((zero-p b) a) (t (as-curve (+ a b)))))
                 (- (if (zero-p b) a (as-curve (- a b))))
                 (* (cond ((zero-p a) a) ((zero-p b) b) (t (as-curve (* a b)))))
                 (/ (if (zero-p a) a (as-curve (/ a b))))))))))

;;; Bounds

(defun bounds (curve stamp)
  "Compute RANGE and CERTAINTY of CURVE for the interval with the number STAMP, and return CURVE.
The variable has those of the interval already."
  (declare (type curve curve) (fixnum stamp))
  (unless (or (= stamp (curve-stamp curve)) (member (curve-kind curve) '(:constant :variable)))
    (setf (curve-stamp curve) stamp)
    (compute-bounds curve stamp))
  curve)

(declaim (inline settle))
(defun settle (curve least most certainty)
  (declare (double-float least most))
  (setf (aref (curve-range curve) 0) least
        (aref (curve-range curve) 1) most
        (curve-certainty curve) certainty)
  curve)

(defun settle-as (curve other certainty)
  "Give CURVE the range of OTHER, and a certainty of no more than CERTAINTY."
  (settle curve (curve-least other) (curve-most other) (min certainty (curve-certainty other))))

(defun compute-bounds (curve stamp)
  (let ((kind (curve-kind curve)) (args (curve-args curve)))
    (flet ((arg (number) (bounds (nth number args) stamp)))
      (declare (inline arg))
      (cond ((arithmetic-p kind) (operation-bounds curve kind args stamp))
            ((component-p kind) (component-bounds curve kind args stamp))
            ((comparison-p kind) (comparison-bounds curve kind (arg 0) (arg 1)))
            (t (ecase kind
                 (:not (let ((a (arg 0)))
                         (settle curve (- 1d0 (curve-most a)) (- 1d0 (curve-least a))
                                 (curve-certainty a))))
                 ((:and :or) (both-bounds curve (eq kind :and) (arg 0) (second args) stamp))
                 ((:if :fork) (if-bounds curve (arg 0) (second args) (third args) stamp))
                 (:guard (settle-as curve (arg 0)
                                    (loop for other in (rest args)
                                          minimize (curve-certainty (bounds other stamp)))))
                 (:holds (let ((a (arg 0)))
                           (settle curve (if (= 2 (curve-certainty a)) (curve-least a) 0d0)
                                   (if (zerop (curve-certainty a)) 0d0 (curve-most a)) 2)))
                 (:value (let ((certainty (curve-certainty (arg 0))))
                           (settle curve (if (= 2 certainty) 1d0 0d0)
                                   (if (zerop certainty) 0d0 1d0) 2)))
                 (:unknown (settle curve 0d0 1d0 2))))))))

(defun point-p (curve) (= (curve-least curve) (curve-most curve)))

(defun operation-bounds (curve operator args stamp)
  (let* ((a (bounds (first args) stamp))
         (b (and (rest args) (bounds (second args) stamp)))
         (certainty (min (curve-certainty a) (if b (curve-certainty b) 2)))
         (function (arithmetic-bounds operator)))
    (cond ((zerop certainty) (settle curve 0d0 0d0 0))
          ((or function (and (point-p a) (or (null b) (point-p b))))
           (let ((own (cond ((null function) (value-at-point operator a b (curve-range curve)))
                            (b (funcall (the function function) (curve-range a) (curve-range b)
                                        (curve-range curve)))
                            (t (funcall (the function function) (curve-range a)
                                        (curve-range curve))))))
             (declare (type (integer 0 2) own))
             (setf (curve-certainty curve) (min own certainty))
             curve))
          (t (settle curve most-negative-double-float most-positive-double-float 1)))))

(defun value-at-point (operator a b range)
  "Put into RANGE what OPERATOR gives on the curves A and B (or NIL), which are points."
  (let ((value (operator-value operator (cons (curve-least a) (and b (list (curve-least b)))))))
    (fill range (or value 0d0))
    (if value 2 0)))

(defun only-rises-p (component args)
  "True if COMPONENT never falls while those of ARGS rise that vary."
  (loop for arg in args
        for rising in (computation-rising (component-computation component))
        always (or rising (fixed-p arg))))

(defun component-bounds (curve component args stamp)
  "Give CURVE the bounds of COMPONENT, a number that is computed of ARGS."
  (let* ((args (loop for arg in args collect (bounds arg stamp)))
         (points (every #'point-p args)))
    (flet ((result-at (end)
             (let ((results (computed-results (component-computation component) (mapcar end args))))
               (and results (nth (component-index component) results)))))
      (if (or points (only-rises-p component args))
          (let ((least (result-at #'curve-least)) (most (result-at #'curve-most)))
            (if (and least most)
                (settle curve least most (loop for arg in args minimize (curve-certainty arg)))
                (settle curve most-negative-double-float most-positive-double-float
                        (if points 0 1))))
          (settle curve most-negative-double-float most-positive-double-float 1)))))

(defun comparison-bounds (curve comparison a b)
  "Give CURVE the bounds of COMPARISON between A and B.  One of order is decided where it is so at
all ends; equality where the two are apart."
  (let ((certainty (min (curve-certainty a) (curve-certainty b)))
        (apart (or (< (curve-most a) (curve-least b)) (< (curve-most b) (curve-least a))))
        (ordered (and (comparison-mirror comparison)
                      (string/= (comparison-mirror comparison) (comparison-name comparison)))))
    (flet ((true-p (x y) (comparison-true-p comparison x y)))
      (let ((one (true-p (curve-least a) (curve-most b)))
            (other (true-p (curve-most a) (curve-least b))))
        (cond ((zerop certainty) (settle curve 0d0 0d0 0))
              ((and (eq (not one) (not other))
                    (or ordered (and apart (comparison-mirror comparison))
                        (and (point-p a) (point-p b))))
               (let ((truth (if one 1d0 0d0)))
                 (settle curve truth truth certainty)))
              (t (settle curve 0d0 1d0 certainty)))))))

(defun both-bounds (curve and-p a b stamp)
  "Give CURVE the bounds of A and B, or of A or B.  B is not asked for its value where A decides."
  (let ((decided (if and-p (zerop (curve-most a)) (plusp (curve-least a))))
        (open (if and-p (plusp (curve-least a)) (zerop (curve-most a)))))
    (cond ((or decided (zerop (curve-certainty a))) (settle-as curve a 2))
          (open (settle-as curve (bounds b stamp) (curve-certainty a)))
          (t (let* ((b (bounds b stamp)) (has-p (plusp (curve-certainty b))))
               (settle curve
                       (if and-p 0d0 (if has-p (curve-least b) 1d0))
                       (if and-p (if has-p (curve-most b) 0d0) 1d0)
                       (min (curve-certainty a) (max 1 (curve-certainty b)))))))))

(defun if-bounds (curve test a b stamp)
  (cond ((zerop (curve-certainty test)) (settle curve 0d0 0d0 0))
        ((plusp (curve-least test)) (settle-as curve (bounds a stamp) (curve-certainty test)))
        ((zerop (curve-most test)) (settle-as curve (bounds b stamp) (curve-certainty test)))
        ((eq (curve-kind curve) :fork) (settle curve 0d0 0d0 0))
        (t (either-bounds curve test (bounds a stamp) (bounds b stamp)))))

(defun either-bounds (curve test a b)
  "Give CURVE the bounds of A and of B together, as TEST is not decided."
  (cond ((zerop (curve-certainty a)) (settle-as curve b 1))
        ((zerop (curve-certainty b)) (settle-as curve a 1))
        (t (settle curve (min (curve-least a) (curve-least b)) (max (curve-most a) (curve-most b))
                   (min (curve-certainty test) (curve-certainty a) (curve-certainty b))))))

;;; Plainer curves

(defun plainer (curve stamp)
  "Return a curve that is the same as CURVE in the interval with the number STAMP, in which its
variable is: without what is decided there."
  (cond ((member (curve-kind curve) '(:constant :variable)) curve)
        ((= stamp (curve-plainer-stamp curve)) (curve-plainer curve))
        (t (setf (curve-plainer-stamp curve) stamp
                 (curve-plainer curve) (new-plainer (bounds curve stamp) stamp)))))

(defun new-plainer (curve stamp)
  (let ((kind (curve-kind curve)) (args (curve-args curve)))
    (cond ((zerop (curve-certainty curve)) curve)
          ((and (= 2 (curve-certainty curve)) (point-p curve)) (constant-curve (curve-least curve)))
          ((and (arithmetic-p kind) (eq :selective (arithmetic-kind kind)))
           (let ((selected (selected kind args stamp)))
             (if selected (plainer selected stamp) (plainer-with kind args curve stamp))))
          ((and (eq kind :if) (= 2 (curve-certainty (bounds (first args) stamp)))
                (point-p (first args)))
           (plainer (if (plusp (curve-least (first args))) (second args) (third args)) stamp))
          ((or (arithmetic-p kind) (eq kind :guard)) (plainer-with kind args curve stamp))
          (t curve))))

(defun selected (operator args stamp)
  "Return the one of ARGS that OPERATOR, a selective one, gives in all of the interval STAMP, or
NIL."
  (destructuring-bind (a &optional b) (loop for arg in args collect (bounds arg stamp))
    (flet ((gives-p (curve &rest numbers)
             (and (eql (first numbers) (operator-value operator numbers)) curve)))
      (cond ((null b) (and (gives-p a (curve-least a)) (gives-p a (curve-most a))))
            ((<= (curve-most a) (curve-least b))
             (or (gives-p a (curve-least a) (curve-most b)) b))
            ((<= (curve-most b) (curve-least a))
             (or (gives-p b (curve-least b) (curve-most a)) a))))))

(defun plainer-with (kind args curve stamp)
  "Return CURVE, of KIND with ARGS, with plainer ones."
  (let ((plainer (loop for arg in args collect (plainer arg stamp))))
    (cond ((every #'eq args plainer) curve)
          ((arithmetic-p kind) (operation-curve kind plainer))
          (t (guard-curve (first plainer) (rest plainer))))))

(defun smooth-p (curve)
  "True if CURVE neither bends nor jumps where it has a value."
  (flet ((bends-p (form) (or (null form) (and (consp form) (eq (first form) 'if)))))
    (let ((kind (curve-kind curve)))
      (cond ((member kind '(:constant :variable)) t)
            ((or (eq kind :guard) (and (arithmetic-p kind) (not (bends-p (arithmetic-slope kind)))))
             (every #'smooth-p (curve-args curve)))))))
