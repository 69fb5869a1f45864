;;;; units.lisp -- the units in which a box may count: the table of them, and what converts numbers.
;;;;
;;;; All is computed in cm and finger forces, so that no answer depends on the units.  What is
;;;; said of a box is said in its own.

(in-package :supergrip)

(defstruct (unit (:constructor make-unit (name text measure size)) (:copier nil))
  "A unit of what MEASURE says, :LENGTH or :FORCE.  NAME is what a box calls it, TEXT what a reader
does, NIL for nothing.  SIZE, exact, is it in cm or in N; NIL for one finger's greatest normal
force, which the gripper gives."
  (name "" :type string :read-only t) (text nil :read-only t)
  (measure nil :read-only t) (size nil :read-only t))

(defvar *all-units* '() "The rows that DEFINE-UNIT has defined, in order.")

(defmacro define-unit (name text measure size)
  "Define the unit NAME of MEASURE; see UNIT."
  `(setf *all-units* (with-row (make-unit ,name ,text ,measure ,size) *all-units* #'unit-name)))

(define-unit "MM" "mm" :length 1/10)
(define-unit "CM" "cm" :length 1)
(define-unit "M" "m" :length 100)
(define-unit "IN" "in" :length 254/100)
(define-unit "N" "N" :force 1)
(define-unit "LBF" "lbf" :force 44482216152605/10000000000000)
(define-unit "FINGER" nil :force nil)

(defparameter +standard-gravity+ 980665/100000 "What 1 kg weighs, in N, exactly.")

(defun unit-named (name)
  "Return the unit that NAME, a name or a string in any case, stands for, or NIL."
  (and (or (namep name) (stringp name))
       (find (string-upcase name) *all-units* :key #'unit-name :test #'string=)))

(defun unit-names (measure)
  "Return the names of the units of MEASURE."
  (loop for unit in *all-units*
        when (eq measure (unit-measure unit)) collect (unit-name unit)))

(defstruct (units (:constructor make-units (length force finger &optional spot)))
  "The units of a box: LENGTH and FORCE, units.  FINGER is what a finger force is in the numbers
of the box, in N, exact; 1 as long as no gripper is known; NIL if nothing of the box is in N or
kg.  SPOT is the spot, in the description, of what needs to know it."
  (length nil :type unit :read-only t) (force nil :type unit :read-only t)
  (finger nil :read-only t) (spot nil :read-only t))

(defvar *units* nil
  "The units in which numbers are put into words: those of the box at hand, NIL for cm and finger
forces.")

(defun absolute-units-p (units)
  "True if the forces needed of a box with UNITS are absolute: in N, say, and of any size from 0."
  (and units (unit-size (units-force units)) t))

(defun part-measure (measure index)
  "Return the measure of the part INDEX, or NIL, of what has MEASURE: :WRENCH is three forces, and
three torques."
  (if (eq measure :wrench) (if (< index 3) :force :torque) measure))

(defun axis-measure (axis)
  "Return the measure of a wrench's part on AXIS, 0 to 5."
  (part-measure :wrench axis))

(defun unit-factor (measure units)
  "Return how many cm, finger forces, or their products as MEASURE says, one of UNITS is, exact."
  (ecase measure
    ((nil) 1)
    (:length (unit-size (units-length units)))
    (:force (let ((size (unit-size (units-force units))))
              (if size (/ size (units-finger units)) 1)))
    (:torque (* (unit-factor :length units) (unit-factor :force units)))))

(defun exactly-times (number factor)
  "Return the double nearest to the product of FACTOR, exact, and NUMBER, a double that stands for
its shortest decimal: 0.006 times 100 is 0.6.  NIL if it is out of range."
  (values (bounded-rational (* factor (exact-decimal number)))))

(defun rounded (rational digits)
  "Return RATIONAL, not 0, rounded to about DIGITS significant decimal digits, exact."
  (let ((scale (expt 10 (- digits (round (log (coerce (abs rational) 'double-float) 10d0))))))
    (/ (round (* rational scale)) scale)))

(defun exactly-back (number factor)
  "Return the double of which FACTOR, exact, makes NUMBER: where it is there one of 15 digits, as
0.2 and not 0.19999999999999998.  NIL if it is out of range."
  (let* ((value (/ (exact-decimal number) factor))
         (double (values (bounded-rational value)))
         (short (and double (/= double 0) (values (bounded-rational (rounded value 15))))))
    (if (and short (eql (exactly-times short factor) number))
        short
        double)))

(defun in-units (number measure &optional (units *units*))
  "Return NUMBER, in cm or finger forces as MEASURE says, in UNITS."
  (if (or (null units) (null measure))
      number
      (let ((factor (unit-factor measure units)))
        (without-float-traps
          (or (and (<= (abs number) +largest+) (exactly-back number factor))
              (/ number (coerce factor 'double-float)))))))

(defun from-units (number measure &optional (units *units*))
  "Return NUMBER of UNITS in cm or finger forces, as MEASURE says; NIL if it is out of range."
  (if (or (null units) (null measure))
      number
      (exactly-times number (unit-factor measure units))))

;;; In words

(defun texts-in-units (measure &rest numbers)
  "Return texts of NUMBERS of MEASURE, in cm or finger forces, in *UNITS*, as NUMBER-TEXTS does."
  (apply #'number-texts (loop for number in numbers collect (in-units number measure))))

(defun unit-text-of (measure &optional (units *units*))
  "Return what a number of MEASURE in UNITS counts, \"N mm\"; NIL for finger forces, with or
without cm."
  (let ((length (if units (unit-text (units-length units)) "cm"))
        (force (and units (unit-text (units-force units)))))
    (ecase measure
      ((nil) nil)
      (:length length)
      (:force force)
      (:torque (cond (force (plain-text "~a ~a" force length))
                     ((string/= length "cm") (plain-text "finger ~a" length)))))))

(defun with-unit (text measure &optional (units *units*))
  "Return TEXT, that of a number of MEASURE, with its unit: \"3.2 N\"."
  (let ((unit (unit-text-of measure units)))
    (if unit (concatenate 'string text " " unit) text)))

(defun unit-phrase (measure &optional (units *units*))
  "Return the units of what has MEASURE, for a reader: \"finger forces\", \"N and N mm\"."
  (case measure
    (:length (unit-text-of :length units))
    (:wrench (plain-text "~a and ~a" (unit-phrase :force units) (unit-text-of :torque units)))
    (t (or (unit-text-of measure units) "finger forces"))))
