;;;; box.lisp -- a box and a task, for those who read them.

(in-package :supergrip)

(deftype three () "Three numbers: along X Y Z." '(simple-array double-float (3)))
(defun make-three () (make-array 3 :element-type 'double-float :initial-element 0d0))

(defstruct (box (:conc-name %box-) (:constructor %make-box) (:copier nil) (:predicate box-p))
  "A box and what is to be done with it.  SIZE along X Y Z in cm; WEIGHT in finger forces;
FRICTION the coefficient u; SOFT-FRICTION v, that of the soft finger's torque, in cm; CONSTRAINED a
set of faces; FORCE and VELOCITY what the task needs, 0 to 1, along and about X Y Z; FACTS a list of
BOX-FACTs.  DOWN is the unit vector of gravity, MASS-CENTRE the centre of mass from the box centre;
PLAIN is true if these are -Z and the box centre; GRAVITY-AXIS is the axis, 0 to 2, that gravity is
along, if it acts at the box centre, or NIL.
UNITS are those that its description counts in, NIL for cm and finger forces.  Of a box in N, or
whose mass is given, a finger force is 1 N until a plan knows the gripper: see BOX-FOR-GRIPPER."
  (name nil :read-only t)
  (size nil :type three :read-only t)
  (weight 0d0 :type double-float :read-only t)
  (friction 0d0 :type double-float :read-only t)
  (soft-friction 0d0 :type double-float :read-only t)
  (constrained 0 :type (unsigned-byte 6) :read-only t)
  (force nil :type six :read-only t)
  (velocity nil :type six :read-only t)
  (facts '() :type list :read-only t)
  (units nil :type (or null units) :read-only t)
  (others '() :type list :read-only t)  ; a plist of the values of keys without a slot of their own
  (line nil :read-only t)
  (down nil :type three :read-only t)        ; see pose.lisp
  (mass-centre nil :type three :read-only t)
  (plain t :type boolean :read-only t)
  (gravity-axis 2 :type (or null (integer 0 2)) :read-only t))

(defun box-name (box) "Return the name of BOX, a string, or NIL." (%box-name box))
(defun box-size (box) "Return the sizes of BOX along X Y Z, a list, in cm."
  (coerce (%box-size box) 'list))
(defun box-weight (box)
  "Return the weight of BOX, in units of one finger's greatest normal force.  A weight that is given
in N, lbf or kg is in N until a plan is made for BOX; the box of a plan has it in finger forces."
  (%box-weight box))
(defun box-friction (box) "Return the coefficient of friction of BOX, U." (%box-friction box))
(defun box-soft-friction (box)
  "Return the coefficient of the soft finger's torque about its normal, V, in cm."
  (%box-soft-friction box))
(defun box-constrained (box) "Return the names of the constrained faces of BOX."
  (loop for face below 6
        when (logbitp face (%box-constrained box)) collect (face-name face)))
(defun box-force-needed (box)
  "Return the forces along X Y Z and the torques about X Y Z that the task needs, a list.  Relative
needs are from 0 to 1.  Absolute ones are in N and N cm until a plan is made for BOX; the box of a
plan has them in finger forces and finger force x cm."
  (coerce (%box-force box) 'list))
(defun box-velocity-needed (box)
  "Return the velocities along and about X Y Z that the task needs, a list, 0 to 1."
  (coerce (%box-velocity box) 'list))

(defun sizes-text (box &optional (text #'form-text))
  "Return the sizes of BOX in its own units, \"12.0 x 2.0 x 2.0 cm\"; TEXT makes a text of a
number."
  (let ((units (%box-units box)))
    (with-unit (format nil "~{~a~^ x ~}"
                       (loop for size in (box-size box)
                             collect (funcall text (in-units size :length units))))
      :length units)))

(define-printing (box box) "~@[~s ~]~a" (box-name box) (sizes-text box))
