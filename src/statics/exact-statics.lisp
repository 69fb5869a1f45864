;;;; exact-statics.lisp -- what contacts can really do: questions with lists as arguments, which are
;;;; checked here.

(in-package :supergrip-statics)

;;; Arguments

(defun proper-length (object)
  "Return the length of OBJECT, or NIL if it is no list that ends."
  (and (listp object) (ignore-errors (list-length object))))

(defun as-numbers (object count)
  "Return OBJECT, a list of COUNT reals, as a list of doubles, or NIL if it is none."
  (and (eql (proper-length object) count)
       (let ((numbers (mapcar (lambda (element) (and (realp element) (as-double element))) object)))
         (and (notany #'null numbers) numbers))))

(defun check-six (object what)
  "Return OBJECT, WHAT it is, as a six."
  (let ((numbers (as-numbers object 6)))
    (unless numbers
      (refuse-argument "~a is ~a, but must be a list of six numbers: forces along X Y Z, ~
                        torques about X Y Z"
                       what (form-text object)))
    (map 'six #'identity numbers)))

(defun check-number (object what &optional below)
  "Return OBJECT, WHAT it is, as a double not below 0 and, if BELOW is 1, below that."
  (let ((number (and (realp object) (as-double object))))
    (unless (and number (>= number 0d0) (or (null below) (< number below)))
      (refuse-argument "~a is ~a, but must be a number ~:[from 0~;not below 0 and below 1~]"
                       what (form-text object) below))
    number))

(defun check-budget (budget)
  (if (typep budget '(and fixnum (integer 0)))
      budget
      (refuse-argument "budget is ~a, but must be a number of boxes, such as 100000"
                       (form-text budget))))

(defun check-contact (contact number)
  "Return place and inward unit normal of CONTACT, the one of NUMBER: six doubles, a list."
  (let* ((parts (and (eql (proper-length contact) 2)
                     (mapcar (lambda (part) (as-numbers part 3)) contact)))
         (normal (second parts))
         (greatest (reduce #'max normal :key #'abs :initial-value 0d0)))
    (unless (and (first parts) (plusp greatest))
      (refuse-argument "contact ~d is ~a; a contact is (position inward-normal), three ~
                        numbers each, ~
                        as ((0 1 0) (0 -1 0))" number (form-text contact)))
    (let* ((normal (mapcar (lambda (n) (/ n greatest)) normal))
           (length (sqrt (reduce #'+ normal :key (lambda (n) (* n n))))))
      (append (first parts) (mapcar (lambda (n) (/ n length)) normal)))))

(defun check-grip (contacts u v coupled)
  "Return the grip of CONTACTS, a list of (position inward-normal), with the friction U and V."
  (let ((count (proper-length contacts)))
    (unless (typep count '(integer 1 1000))
      (refuse-argument "contacts are ~a, but must be a list of (position inward-normal), as ~
                        (((0 1 0) (0 -1 0)) ((0 -1 0) (0 1 0))), at most 1000"
                       (form-text contacts)))
    (let ((grip (make-grip count (check-number u "u") (check-number v "v") coupled)))
      (loop for contact in contacts
            for index from 0
            do (apply #'set-finger grip index (check-contact contact (1+ index))))
      (unless (computable-p grip (make-six))
        (refuse-argument "the contacts are too far away, or u or v too large, to compute with"))
      grip)))

(defun check-result (number)
  "Return NUMBER, a double or NIL."
  (if (or (null number) (< (abs number) +largest+))
      number
      (refuse-argument "the answer is no number: places, needs and gravity are too far apart ~
                        in size")))

(defparameter *nothing* '(0 0 0 0 0 0) "No force and no torque.")

(defun as-list (six)
  (and six (coerce six 'list)))

;;; Questions

(defun exact-radius (contacts u v need &key (gravity *nothing*) (gap 0.01d0) (absolute 0.002d0)
                                         (budget 100000) coupled)
  "Return the exact force radius of CONTACTS for the task NEED: the greatest factor by which the
task ellipsoid can grow, so that the contacts can exert all its wrenches while they bear gravity's.

CONTACTS  a list of (position inward-normal), each three numbers, from the box centre, in cm.
U, V      the coefficients of friction and of the soft finger's torque, V in cm, not below 0.
NEED      six numbers, forces along X Y Z and torques about X Y Z, about the box centre: the
          semi-axes of the task ellipsoid of radius 1.  0 is not needed, signs do not matter.
GRAVITY   six numbers likewise: the wrench of the weight on the box, as (0 0 -0.2 0 0 0).
GAP, ABSOLUTE  how far the lower value may be below the upper one: GAP times it, or ABSOLUTE.
BUDGET    how many cells of motions are looked at, at most, to prove the lower value.
COUPLED   true: friction force and torque of a finger share its friction.

Forces are in units of a finger's greatest normal force, torques in its product with cm.

Three values: an upper value; a lower one, certified, or NIL if BUDGET was too small to prove one;
and the worst motion, a list of six, velocities along and rotations about X Y Z, in which the
contacts have the least to spare.  It is scaled to |F q| = 1 for the needs F, so that the power of
the contacts in it is the upper value.  If the contacts can't hold the weight, both numbers are the
same, and not above 0: the power, with gravity's, in the third value, a motion of length 1.  If they
can hold it, but bear no task ellipsoid, both are 0.

A task that needs nothing has no radius: an ARGUMENT-ERROR, as for arguments that can't be used.

Assumes points of contact with a soft finger: a normal force from 0 to 1, friction force and torque
about the normal within U and V times it, independent of each other unless COUPLED.
Source: docs/physics.md, what the contacts can really do."
  (without-float-traps
    (let ((grip (check-grip contacts u v coupled))
          (need (map 'six #'abs (check-six need "need")))
          (gravity (check-six gravity "gravity"))
          (gap (check-number gap "gap" 1d0))
          (absolute (check-number absolute "absolute"))
          (budget (check-budget budget)))
      (when (needs-nothing-p need)
        (refuse-argument "the task needs no force and no torque, so it has no radius; ~
                          (holds-p contacts u v gravity) says whether the contacts hold the ~
                          weight"))
      (multiple-value-bind (upper lower worst) (grip-radius grip need gravity gap absolute budget)
        (values (check-result upper) (check-result lower) (as-list worst))))))

(defun holds-p (contacts u v gravity &key coupled)
  "True if CONTACTS can hold the box against the wrench GRAVITY.  If not, the second value is a
motion, a list of six, in which their greatest power and gravity's together are below 0.  Arguments,
units and assumptions are those of EXACT-RADIUS.  On the border, a wrench that is outside by up to
1e-7 of the contacts' reach counts as held."
  (without-float-traps
    (multiple-value-bind (holds witness)
        (grip-holds-p (check-grip contacts u v coupled) (check-six gravity "gravity"))
      (values holds (as-list witness)))))

(defun finger-wrench (grip forces index)
  "Return what finger INDEX of GRIP does with its FORCES: (force torque), its force on the box, a
list along X Y Z, and its torque about the inward normal."
  (let ((rows (grip-rows grip)) (start (* +finger+ index)))
    (list (loop for k below 3
                collect (loop for part below 3
                              sum (* (aref forces (+ (* 4 index) part))
                                     (aref rows (+ start (* +row+ part) k)))))
          (aref forces (+ (* 4 index) 3)))))

(defun contact-forces (contacts u v wrench &key coupled)
  "Return forces of the fingers at CONTACTS that together exert WRENCH, six numbers about the box
centre: a list with (force torque) for each contact, the force on the box along X Y Z, a list, and
the torque about the inward normal, a number.  To hold the box, WRENCH is the opposite of gravity's.
If there are none, return NIL and a motion, a list of six, in which the greatest power of the
fingers is below that of WRENCH.  Arguments, units and assumptions are those of EXACT-RADIUS."
  (without-float-traps
    (let ((grip (check-grip contacts u v coupled)))
      (multiple-value-bind (forces witness) (grip-forces grip (check-six wrench "wrench"))
        (if forces
            (loop for index below (grip-count grip) collect (finger-wrench grip forces index))
            (values nil (as-list witness)))))))

(defun wrench-entries (contacts u v &key coupled)
  "Return how far CONTACTS reach along each axis: a list of six (plus minus), the greatest pure
force along X Y Z or pure torque about X Y Z each way, exact within 1e-6 of the reach.  The lesser
of the two is the exact WRENCH entry.  Arguments, units and assumptions are those of EXACT-RADIUS."
  (without-float-traps
    (let* ((grip (check-grip contacts u v coupled))
           (finder (find-in grip))
           (way (make-six)))
      (loop for axis below 6
            collect (loop for sign in '(1d0 -1d0)
                          do (fill way 0d0)
                             (setf (aref way axis) sign)
                          collect (check-result (grip-entry grip way finder)))))))

(defun least-squeeze (contacts u v need &key (gravity *nothing*) (gap 0.01d0) (budget 100000)
                                         coupled)
  "Return the least cap on each finger's force with which CONTACTS still do the task NEED at radius
1 and hold the weight.  There are two values: a cap that is surely enough, and one below which none
is enough.  The second is less by at most GAP times the first.  Both are NIL if no cap is enough.
The first alone is NIL if BUDGET was too small for the proof.  Arguments, units and assumptions are
those of EXACT-RADIUS; NEED may be nothing."
  (without-float-traps
    (let ((need (map 'six #'abs (check-six need "need"))))
      (multiple-value-bind (sure least)
          (grip-squeeze (check-grip contacts u v coupled) need (check-six gravity "gravity")
                        (check-number gap "gap" 1d0) (check-budget budget))
        (values (check-result sure) (check-result least))))))

(defun least-friction (contacts v need &key (gravity *nothing*) (gap 0.01d0) (absolute 0.002d0)
                                         (budget 20000) coupled)
  "Return the least coefficient of friction u with which CONTACTS still do the task NEED at radius 1
and hold the weight.  There are two values: a u that is surely enough, and a u below which none is
enough.  V stays as it is.  They differ by at most GAP times the second, or ABSOLUTE.  If BUDGET is
too small to prove this, they may differ by up to 64 times as much; if that can't be proved either,
the first is NIL.  Both are NIL if no u up to 100 is enough.  Arguments, units and assumptions are
those of EXACT-RADIUS; NEED may be nothing."
  (without-float-traps
    (let ((need (map 'six #'abs (check-six need "need"))))
      (multiple-value-bind (sure least)
          (grip-least-friction (check-grip contacts 0.5d0 v coupled) need
                               (check-six gravity "gravity") (check-number gap "gap" 1d0)
                               (check-number absolute "absolute") (check-budget budget))
        (values (check-result sure) (check-result least))))))

(defun sure-radius (capacities need &key (gravity *nothing*) (offset '(0 0 0)))
  "Return a radius that contacts surely bear if they exert CAPACITIES along and about each axis, in
both directions.  It is at most the exact radius of any such contacts, and at least 0.  Returns NIL
if nothing is needed.

CAPACITIES  six numbers along X Y Z and about X Y Z, about the point OFFSET: WRENCH entries.
NEED        six numbers about the box centre, the effect of the offset not included.
GRAVITY     six numbers about the box centre, the wrench of the weight.
OFFSET      three numbers, from the box centre, in cm.

It is (1 - sum |L_k|/c_k) / max_s |(T F)t (s/c)|, T being the move to OFFSET, L gravity's wrench
there, s vectors of signs: exactly the radius in the cross-polytope that the capacities span.  0
where a capacity is not above 0.  Source: docs/physics.md."
  (without-float-traps
    (let ((place (or (as-numbers offset 3)
                     (refuse-argument "offset is ~a, but must be a list of three numbers, along ~
                                      X Y Z"
                                      (form-text offset)))))
      (check-result (apply #'sure (check-six capacities "capacities")
                           (map 'six #'abs (check-six need "need")) (check-six gravity "gravity")
                           place)))))
