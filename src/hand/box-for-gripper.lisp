;;;; box-for-gripper.lisp -- a box in N or kg becomes one in the finger forces of a gripper.
;;;;
;;;; A box is read without a gripper, so it is a plan that checks whether the finger force is known.

(in-package :supergrip)

(defun finger-force (graspbase)
  "Return one finger's greatest normal force, in N, that the gripper of GRASPBASE names, or NIL."
  (let ((force (dimension graspbase "FINGER-FORCE")))
    (and force (plusp force) (exact-decimal force))))

(defun box-for-gripper (box graspbase file)
  "Return BOX with its forces in finger forces of the gripper of GRASPBASE, which the file named
FILE holds.  Signals a BOX-ERROR if they can't be known, or are out of range."
  (let* ((units (%box-units box))
         (force (finger-force graspbase)))
    (cond ((null (units-finger units)) box)
          ((null force) (refuse-unknown-force box file))
          ((= force (units-finger units)) box)
          (t (box-with-finger box force)))))

(defun refuse-box-of (box control &rest arguments)
  "Signal a BOX-ERROR about the forces of BOX."
  (let ((*file* nil) (*lines* nil) (*place* nil)
        (*subject* (plain-text "BOX~@[ ~s~]" (box-name box)))
        (units (%box-units box)))
    (refuse-box (nth-value 1 (with-problems
                               (complain (and units (units-spot units)) "~?" control arguments)))
                nil (%box-line box))))

(defun refuse-unknown-force (box file)
  (let ((units (%box-units box)))
    (refuse-box-of box "~a needs FINGER-FORCE, one finger's greatest normal force in N, which ~
                        the gripper does not name: add FINGER-FORCE and a number to (SETQ ~
                        GRIPPER ...) in ~a"
                   (if (absolute-units-p units)
                       (clause-text *notation* (find-key :units)
                                    (list (canonical-name (unit-name (units-length units)))
                                          (canonical-name (unit-name (units-force units)))))
                       (key-name *notation* (find-key :mass)))
                   file)))

(defun box-with-forces (box units force)
  "Return BOX with UNITS, and with its weight, and its forces needed if they are absolute, FORCE
times as great; NIL if one is then out of range."
  (let ((values (box-values-of box)))
    (setf (getf values :units) units)
    (dolist (row *box-keys* (make-box values (%box-line box)))
      (when (or (eq (box-key-measure row) :force)
                (and (eq (box-key-measure row) :wrench) (absolute-units-p units)))
        (setf (getf values (box-key-key row))
              (or (measured-value row (funcall (box-key-reader row) box)
                                  (lambda (number measure)
                                    (declare (ignore measure))
                                    (exactly-times number force)))
                  (return nil)))))))

(defun box-with-finger (box force)
  "Return BOX as it is for a gripper with fingers of FORCE N."
  (let ((units (%box-units box)))
    (or (box-with-forces box
                         (make-units (units-length units) (units-force units) force
                                     (units-spot units))
                         (/ (units-finger units) force))
        (refuse-box-of box "in finger forces of ~a N its forces are out of range: they must lie ~
                            between 1e-300 and 1e300"
                       (number-text force)))))

(defun check-margin (margin)
  "Return MARGIN, a number above 0, exact, or signal an ARGUMENT-ERROR."
  (let ((number (and (realp margin) (as-double margin))))
    (if (and number (plusp number))
        (exact-decimal number)
        (refuse-argument "margin is ~a, but must be a number above 0; the weight and absolute ~
                          needs are multiplied by it" (form-text margin)))))

(defun box-with-margin (box margin)
  "Return BOX with its weight, and its forces needed if they are absolute, MARGIN times as great.
Signals a BOX-ERROR if they are then out of range."
  (or (box-with-forces box (%box-units box) (check-margin margin))
      (refuse-box-of box "with a margin of ~a its forces are out of range: they must lie between ~
                          1e-300 and 1e300"
                     (number-text margin))))
