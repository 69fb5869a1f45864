;;;; box-keys.lisp -- the keys of a box description, one row each.
;;;;
;;;; A row says what a key takes.  Parsing, both notations, messages and what EXPLAIN-BEST varies
;;;; follow from it.

(in-package :supergrip)

(defstruct box-key
  "A key of a box description.  KEY is a keyword, JSON its name in JSON.  TYPE says what follows it:
  :TEXT          a string, or nothing
  :NUMBER        a number from 0
  (:NUMBERS n)   N numbers above 0
  :PLACE         three numbers
  :POSE          a list of three numbers and one of four: see pose.lisp
  :NEEDS         a list of six numbers from 0 to 1; from 0 if the box has absolute units,
                 and there is a MEASURE
  :FACES         faces, any number of them
  :FACTS         sentences, any number of them: see box-facts.lisp
  :UNITS         the names of two units, of length and of force
  :MASS          a number from 0, in kg, in the place of the weight
  :DATA          anything.
TAKES says so in words, EXAMPLE is a list of what may follow.  OPTIONAL is true if a box may lack
it.  READER is a function of a box; SLOT, a keyword, names the slot of its own, if it has one.
WORDS name a value that may be varied, \"the weight\", NIL if none may.  MEASURE says what its
numbers are: :LENGTH, :FORCE, :WRENCH, three forces and three torques, or NIL for what has no unit;
TAKES then has ~a for the units.  ABSOLUTE is what it takes of a box with absolute units, if that is
something else.  INSTEAD is the key in whose place it stands."
  key json type takes example optional slot reader words measure absolute instead)

(defvar *box-keys* '() "The rows that DEFINE-BOX-KEY has defined, in order.")

(defun add-box-key (row)
  (setf *box-keys* (with-row row *box-keys* #'box-key-key)))

(defmacro define-box-key (key type takes example
                          &key slot optional words measure absolute instead
                            (json (substitute #\_ #\- (string-downcase key))))
  "Define KEY, a keyword, as a key of box descriptions.  TYPE says what it takes (see BOX-KEY), and
the text TAKES says so in words; EXAMPLE is a list of what may follow KEY.  SLOT, a keyword, names a
slot of the box for the value; without SLOT, BOX-VALUE reads the value.  MEASURE, ABSOLUTE and
INSTEAD: see BOX-KEY."
  `(add-box-key
    (make-box-key :key ,key :json ,json :type ',type :takes ,takes :example ',example
                  :optional ,optional :words ,words :slot ,slot :measure ,measure
                  :absolute ,absolute :instead ,instead
                  :reader ,(if slot
                               `#',(find-symbol (format nil "%BOX-~a" slot) :supergrip)
                               `(lambda (box) (getf (%box-others box) ,key))))))

(define-box-key :size (:numbers 3) "three sizes in ~a, above 0" (12 2 2)
  :slot :size :measure :length :words "the size")
(define-box-key :weight :number "one number, 0 or more, in ~a" (0.2d0)
  :slot :weight :measure :force :words "the weight")
(define-box-key :u :number "one coefficient of friction, 0 or more" (0.8d0)
  :slot :friction :words "the friction u")
(define-box-key :v :number "one coefficient of torsional friction, 0 or more, in ~a" (0.2d0)
  :slot :soft-friction :measure :length :words "the torsional friction v")
(define-box-key :constrained :faces "faces among X1 X2 Y1 Y2 Z1 Z2, or nothing" (:z2 :x1)
  :slot :constrained)
(define-box-key :force-needed :needs "a list of six numbers from 0 to 1"
  ((1 0.8d0 0.8d0 0.3d0 1 1))
  :slot :force :measure :wrench :absolute "a list of six numbers, 0 or more, in ~a"
  :words "the force needed")
(define-box-key :velocity-needed :needs "a list of six numbers from 0 to 1"
  ((0 0.8d0 0.8d0 0 0.8d0 0.8d0))
  :slot :velocity :words "the velocity needed")
(define-box-key :name :text "one string" ("pencil")
  :slot :name :optional t)
(define-box-key :facts :facts "lists of words, each of which may end in one list of faces"
  ((:fragile (:z1)) (:wet))
  :slot :facts :optional t)
(define-box-key :units :units
  "a unit of lengths, MM CM M or IN, and one of forces, N LBF or FINGER" (:mm :n)
  :slot :units :optional t)
(define-box-key :mass :mass "one number, 0 or more, in kg" (1.2d0)
  :optional t :instead :weight)

(define-box-key :data :data "anything, which comes back in the record" (:part 17)
  :optional t)

(defun find-key (key)
  (loop for row of-type box-key in *box-keys* when (eq key (box-key-key row)) return row))

(defgeneric shown-value (type value)
  (:documentation "Return VALUE of a key that takes what TYPE says, for those who read boxes.")
  (:method (type value)
    (declare (ignore type))
    value))

(defmethod shown-value ((type (eql :units)) units)
  (and units (list (unit-name (units-length units)) (unit-name (units-force units)))))

(defgeneric each-number (value function)
  (:documentation "Return a VALUE of a key with what FUNCTION, of a number and its place, makes of
each number that has a unit; NIL if it makes NIL of one.")
  (:method ((value real) function)
    (funcall function value 0))
  (:method ((value array) function)
    (let ((numbers (copy-seq value)))
      (dotimes (i (length numbers) numbers)
        (setf (aref numbers i) (or (funcall function (aref numbers i) i) (return nil)))))))

(defun measured-value (row value convert)
  "Return VALUE, that of the key ROW, with what CONVERT, a function of a number and its measure,
makes of each number; NIL if it makes NIL of one."
  (let ((measure (box-key-measure row)))
    (if (and measure value)
        (each-number value (lambda (number place)
                             (funcall convert number (part-measure measure place))))
        value)))

(defun box-value (box key)
  "Return what BOX gives for KEY, a symbol or a string, as the description has it; or NIL.  It
serves keys that DEFINE-BOX-KEY has added.  A set of faces is an integer, numbers are doubles, facts
and units are lists of strings."
  (let ((row (find (and (or (symbolp key) (stringp key)) (string-upcase key)) *box-keys*
                   :key #'box-key-key :test #'string=)))
    (if row
        (shown-value (box-key-type row)
                     (measured-value row (funcall (box-key-reader row) box)
                                     (lambda (number measure)
                                       (in-units number measure (%box-units box)))))
        (refuse-argument "~a is not a key of a box: keys are ~{~a~^, ~}" (form-text key)
                         (mapcar #'box-key-key *box-keys*)))))

(defun spread-p (row)
  "True if the values of the key ROW follow it one by one; in JSON they are an array."
  (or (member (box-key-type row) '(:faces :facts :place :units)) (consp (box-key-type row))))

;;; Notations.  A description is checked in the paper's form; messages speak as it was written.

(defvar *notation* :lisp "How the description being checked was written: a keyword, as :LISP.")

(defgeneric key-name (notation row)
  (:documentation "Return the name of the key ROW as NOTATION has it.")
  (:method (notation row)
    (declare (ignore notation))
    (symbol-name (box-key-key row))))

(defgeneric value-text (notation value)
  (:documentation "Return VALUE as NOTATION has it, cut after some 200 characters.")
  (:method (notation value)
    (declare (ignore notation))
    (form-text value)))

(defgeneric clause-text (notation row values)
  (:documentation "Return the part of a description that gives VALUES for the key ROW.")
  (:method (notation row values)
    (declare (ignore notation))
    (form-text (cons (box-key-key row) values))))

(defgeneric nothing-p (notation value)
  (:documentation "True if VALUE stands for nothing, as in the name of a box without one.")
  (:method (notation value)
    (declare (ignore notation))
    (or (null value) (name= value "NIL"))))

(defgeneric description-text (notation)
  (:documentation "Return what a box description is, with its beginning, and what closes it.")
  (:method (notation)
    (declare (ignore notation))
    (values "a list such as ((SIZE 12 2 2) (WEIGHT 0.2) ...)" ")")))

(defgeneric spot-in-clause (notation clause row numbers)
  (:documentation "Return where in a description a part of the clause numbered CLAUSE, that of the
key ROW, begins: NUMBERS are that of a value and of an element of it; without any, the clause
itself.")
  (:method (notation clause row numbers)
    (declare (ignore notation row))
    (if numbers (list* clause (1+ (first numbers)) (rest numbers)) (list clause))))

(defun shown-example (row)
  "Return the example of the key ROW, lengths in the units of the box at hand."
  (flet ((shown (number)
           (let ((shown (in-units number :length)))
             (if (= shown (fround shown)) (round shown) shown))))
    (let ((example (box-key-example row)))
      (cond ((not (and *units* (eq (box-key-measure row) :length))) example)
            ((consp (first example)) (cons (mapcar #'shown (first example)) (rest example)))
            (t (mapcar #'shown example))))))

(defun key-takes (row)
  "Return what the key ROW takes, with an example."
  (let ((takes (or (and (absolute-units-p *units*) (box-key-absolute row)) (box-key-takes row))))
    (format nil "~a: ~a"
            (if (box-key-measure row)
                (format nil takes (unit-phrase (box-key-measure row)))
                takes)
            (clause-text *notation* row (shown-example row)))))

(defun absolute-hint (row)
  "Return how numbers above 1 are allowed for the key ROW, or NIL."
  (and (box-key-absolute row)
       (clause-text *notation* (find-key :units)
                    (list (if *units* (canonical-name (unit-name (units-length *units*))) :cm)
                          :n))))

;;; Where a part stands: for the reports, a list of numbers that PART-PLACE understands.

(defvar *path* '() "Where in its record the description being checked is: '() or inside QUOTE and
SETQ.")
(defvar *clause* 0 "The number, from 0, of the clause being checked.")

(defun clause-spot ()
  "Return where the clause being checked begins."
  (append *path* (spot-in-clause *notation* *clause* nil '())))

(defun value-spot (row &rest numbers)
  "Return where a part of the value of the key ROW in the clause being checked begins: as NUMBERS
say, a value, and an element of that."
  (append *path* (spot-in-clause *notation* *clause* row numbers)))

;;; Values

(defun refuse-value (row values &optional (spot (clause-spot)) too-large)
  "Complain that VALUES are nothing for the key ROW, and, if one is TOO-LARGE, how it is allowed."
  (complain spot "~a is not valid: ~a takes ~a~@[; with ~a needs may be absolute~]"
            (clause-text *notation* row values) (key-name *notation* row) (key-takes row)
            (and too-large (absolute-hint row))))

(defun number-in (value least most)
  "Return VALUE as a double if it is a real from LEAST to MOST (each NIL for no bound), or NIL."
  (let ((number (and (realp value) (as-double value))))
    (and number (or (null least) (>= number least)) (or (null most) (<= number most)) number)))

(defun number-list (row list count least most values &rest spot)
  "Return LIST, COUNT numbers from LEAST to MOST, NIL for no bound, as an array of doubles, or
complain.  SPOT are the numbers of the place of LIST among VALUES, for VALUE-SPOT."
  (let ((numbers (make-array count :element-type 'double-float))
        (place 0))
    (dolist (value (and (listp list) list))
      (let ((number (and (< place count) (number-in value least most))))
        (unless number
          (return-from number-list
            (refuse-value row values (apply #'value-spot row (append spot (list place)))
                          (and most (number-in value most nil)))))
        (setf (aref numbers place) number)
        (incf place)))
    (if (= place count)
        numbers
        (refuse-value row values))))

(defgeneric parse-values (type row values)
  (:documentation "Return the value of the key ROW, which takes what TYPE says, that VALUES, the
rest of its clause, give.  NIL after a complaint."))

(defmethod parse-values ((type (eql :text)) row values)
  (cond ((and values (null (rest values)) (nothing-p *notation* (first values))) nil)
        ((rest values) (refuse-value row values))
        ((stringp (first values)) (first values))
        (t (refuse-value row values (value-spot row 0)))))

(defmethod parse-values ((type (eql :number)) row values)
  (cond ((rest values) (refuse-value row values))
        ((number-in (first values) 0 nil))
        (t (refuse-value row values (value-spot row 0)))))

(defmethod parse-values ((type cons) row values)
  (destructuring-bind (kind count) type
    (assert (eq kind :numbers))
    (let ((numbers (number-list row values count 0 nil values)))
      (cond ((null numbers) nil)
            ((every #'plusp numbers) numbers)
            (t (refuse-value row values (value-spot row (position-if-not #'plusp numbers))))))))

(defmethod parse-values ((type (eql :needs)) row values)
  (if (rest values)
      (refuse-value row values)
      (number-list row (first values) 6 0
                   (if (and (box-key-absolute row) (absolute-units-p *units*)) nil 1)
                   values 0)))

(defstruct (carried (:constructor make-carried (value)))
  "What a box carries along: VALUE, the list of the forms after DATA, or a JSON value."
  (value nil :read-only t))

(defmethod parse-values ((type (eql :data)) row values)
  (declare (ignore row))
  (make-carried (if (eq *notation* :json) (first values) values)))

(defmethod shown-value ((type (eql :data)) carried)
  (and carried (carried-value carried)))

(defmethod parse-values ((type (eql :mass)) row values)
  (parse-values :number row values))

(defun parse-unit (row values index measure)
  "Return the unit of MEASURE that stands at INDEX of VALUES, those of the key ROW, or complain."
  (let* ((name (nth index values)) (unit (unit-named name)))
    (cond ((and unit (eq measure (unit-measure unit))) unit)
          (unit
           (refuse-value row values (value-spot row index)))
          (t
           (complain (value-spot row index) "~a is not a unit of ~(~a~)s~a: ~a takes ~a"
                     (value-text *notation* name) measure
                     (suggestion (if (stringp name) (string-upcase name) name) (unit-names measure))
                     (key-name *notation* row) (key-takes row))))))

(defmethod parse-values ((type (eql :units)) row values)
  (if (/= (length values) 2)
      (refuse-value row values)
      (let ((length (parse-unit row values 0 :length)) (force (parse-unit row values 1 :force)))
        (and length force
             (not (and (string= "CM" (unit-name length)) (null (unit-size force))))
             (make-units length force (and (unit-size force) 1) (clause-spot))))))

(defun face-named (value)
  "Return the face that VALUE names, or NIL."
  (and (or (namep value) (stringp value)) (face-index value)))

(defun refuse-face (value spot)
  "Complain that VALUE at SPOT names no face."
  (complain spot "~a is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2~:[~;, without ~
                  parentheses of their own~]"
            (value-text *notation* value) (consp value)))

(defun parse-faces (values row twice &rest spot)
  "Return the faces that VALUES of the key ROW name, as a face list; NIL after complaints.  TWICE
says what is wrong with one that is there twice.  SPOT are the numbers of the place of VALUES, for
VALUE-SPOT."
  (let ((faces 0) (good t))
    (declare (type face-list faces))
    (loop for value in values
          for number from 0
          for face = (face-named value)
          do (if (and face (not (logbitp face faces)))
                 (setf faces (face-list-with faces (face-list-count faces) face))
                 (let ((place (apply #'value-spot row (append spot (list number)))))
                   (setf good (if face
                                  (complain place "~a ~a" (value-text *notation* value) twice)
                                  (refuse-face value place))))))
    (and good faces)))

(defmethod parse-values ((type (eql :faces)) row values)
  (let ((faces (parse-faces values row "is constrained twice")))
    (and faces (face-list-mask faces))))

(defun key-value (row values)
  "Return the value of the key ROW that VALUES, the rest of its clause, give.  NIL after a
complaint."
  (if (listp values)
      (parse-values (box-key-type row) row values)
      (refuse-value row values)))
