;;;; preliminary-assertions.lisp -- the preliminary assertions: what is known of a box before any
;;;; rule runs.
;;;;
;;;; One row each.  The rule base, the checker, HOW and WHY-NOT follow from the rows.

(in-package :supergrip)

(defstruct (input-row (:constructor make-input-row (name arity dimension assert note
                                                               numbers)))
  "A preliminary assertion: its NAME, a string; how many faces its lists have, ARITY; the name of
the gripper's DIMENSION that is its threshold, or NIL; ASSERT, a function of a memory, the
predicate, a box and the threshold that remembers all that holds; NOTE, one of a face list, a box
and the threshold that returns why that holds, a sentence; NUMBERS, those that its test names
itself."
  (name "" :type string :read-only t) (arity 0 :read-only t) (dimension nil :read-only t)
  (assert nil :type function :read-only t) (note nil :type function :read-only t)
  (numbers '() :type list :read-only t))

(defvar *inputs* '() "The rows that DEFINE-INPUT has defined, in the order of their definition.")

(defun add-input (row)
  (setf *inputs* (with-row row *inputs* #'input-row-name)))

(defun input-predicates ()
  "Return the predicates of all preliminary assertions, as BUILD-RULEBASE wants them."
  (loop for row in *inputs*
        collect (list (list (input-row-name row)) (input-row-arity row))))

(defun numbers-in (form)
  "Return the numbers in FORM, that of a test."
  (cond ((realp form) (list form))
        ((consp form) (append (numbers-in (car form)) (numbers-in (cdr form))))))

(defmacro define-input (name (kind &rest variables) (&optional (threshold (gensym)) dimension)
                        test phrase)
  "Define the preliminary assertion NAME, a string.  KIND says what it is about, and what VARIABLES
stand for in TEST and PHRASE; those at the end may be left out:
  (:PAIR distance box)  each of the three pairs of opposed faces, DISTANCE apart, in cm
  (:FACE face box)      each of the six faces
  (:BOX box)            the box itself.
THRESHOLD stands for the gripper's DIMENSION, a string, if there is one.  TEST is a form, true where
the assertion holds; PHRASE a form that returns why, a string.  Knowledge that is loaded from then
on has the assertion."
  (destructuring-bind (arity faces . values)
      (ecase kind
        (:pair '(2 ((0 1) (2 3) (4 5))
                 (aref (%box-size box) (face-axis (face-list-ref face-list 0))) box))
        (:face '(1 ((0) (1) (2) (3) (4) (5)) (face-list-ref face-list 0) box))
        (:box '(0 (()) box)))
    (let ((bindings (mapcar #'list variables values)))
      `(add-input
        (make-input-row
         ,name ,arity ,dimension
         (lambda (memory predicate box ,threshold)
           (declare (type memory memory) (type predicate predicate) (type box box)
                    (double-float ,threshold) (ignorable box ,threshold))
           (dolist (face-list ',(mapcar #'make-face-list faces))
             (declare (type face-list face-list) (ignorable face-list))
             (let ,bindings
               (declare (ignorable ,@variables))
               (when ,test (put-fact memory predicate face-list)))))
         (lambda (face-list box ,threshold)
           (declare (type face-list face-list) (ignorable face-list box ,threshold))
           (let ,bindings
             (declare (ignorable ,@variables))
             ,phrase))
         (numbers-in ',test))))))

(defun apart-text (distance relation dimension threshold)
  "Return that two faces are DISTANCE apart, which stands in RELATION to the DIMENSION, THRESHOLD."
  (destructuring-bind (distance threshold) (texts-in-units :length distance threshold)
    (format nil "they are ~a apart, ~a ~a, ~a" (with-unit distance :length) relation dimension
            threshold)))

;;; Their order is that of the predicates in a rule base.

(define-input "OPPOSED" (:pair) ()
  t
  "opposite faces of the box")

(define-input "SMALL" (:pair distance) (width "FINGER-WIDTH")
  (< distance width)
  (apart-text distance "less than" "FINGER-WIDTH" width))

(define-input "NARROW" (:pair distance) (spread "FINGER-SPREAD")
  (< distance spread)
  (apart-text distance "less than" "FINGER-SPREAD" spread))

(define-input "LARGE" (:pair distance) (opening "DIST-PINCH")
  (>= distance opening)
  (apart-text distance "no less than" "DIST-PINCH" opening))

(define-input "CONSTRAINED" (:face face box) ()
  (logbitp face (%box-constrained box))
  "the box says so")

(define-input "SLIPPERY" (:box box) (friction "SLIPPERY-U")
  (<= (%box-friction box) friction)
  (apply #'format nil "u is ~a, no more than SLIPPERY-U, ~a"
         (number-texts (%box-friction box) friction)))

;;; Ready for a gripper

(defstruct (prepared-input (:constructor make-prepared-input (row predicate threshold)))
  "The ROW of a preliminary assertion with its PREDICATE in a rule base and the THRESHOLD that a
gripper gives, 0 if none."
  (row nil :type input-row :read-only t)
  (predicate nil :type predicate :read-only t)
  (threshold 0d0 :type double-float :read-only t))

(defun prepare-inputs (rulebase graspbase)
  "Return the preliminary assertions, ready for the rules of RULEBASE and the gripper of GRASPBASE.
One whose threshold the gripper lacks is left out, as no rule of RULEBASE tests it."
  (loop for row in *inputs*
        for name = (input-row-dimension row)
        for threshold = (if name (dimension graspbase name) 0d0)
        when threshold
          collect (make-prepared-input row (find-predicate rulebase (list (input-row-name row)))
                                       threshold)))

(defun assert-box (memory inputs box)
  "Put into MEMORY what INPUTS, prepared, say of BOX."
  (dolist (input inputs)
    (declare (type prepared-input input))
    (funcall (the function (input-row-assert (prepared-input-row input)))
             memory (prepared-input-predicate input) box (prepared-input-threshold input))))
