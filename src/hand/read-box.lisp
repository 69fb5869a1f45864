;;;; read-box.lisp -- the description of a box, checked, becomes a box.

(in-package :supergrip)

(defun unwrap-box (form)
  "Return the description in FORM, which may be '(...), or (SETQ BOX '(...)); and where in FORM it
is, a list of numbers, each that of an element."
  (flet ((unwrap (number)
           (multiple-value-bind (description path) (unwrap-box (nth number form))
             (values description (cons number path)))))
    (cond ((and (consp form) (name= (first form) "QUOTE") (= (length form) 2))
           (unwrap 1))
          ((and (consp form) (name= (first form) "SETQ") (= (length form) 3)
                (name= (second form) "BOX"))
           (unwrap 2))
          (t (values form '())))))

(defun key-named (name)
  "Return the row of the key NAME, a symbol or, in JSON, a string; or NIL."
  (if (stringp name)
      (loop for row in *box-keys* when (string= name (box-key-json row)) return row)
      (or (find-key name)               ; as the reader returns it
          (find name *box-keys* :key #'box-key-key :test #'name=))))

(defun clause-key (clause keys)
  "Return the row of the key of CLAUSE if it is a good one that is not in KEYS yet, or complain."
  (let* ((name (and (consp clause) (or (stringp (first clause)) (namep (first clause)))
                    (or (eq *notation* :json) (not (stringp (first clause))))
                    (first clause)))
         (row (and name (key-named name))))
    (cond ((null name)
           (complain (clause-spot) "~a is not a part of a box description: its parts are lists ~
                                    such as (SIZE 12 2 2)" (value-text *notation* clause)))
          ((null row)
           (complain (clause-spot) "unknown key ~a~a; keys are ~{~a~^, ~}"
                     (value-text *notation* name)
                     (suggestion name
                                 (mapcar (if (stringp name)
                                             #'box-key-json
                                             (lambda (row) (symbol-name (box-key-key row))))
                                         *box-keys*))
                     (loop for row in *box-keys* collect (key-name *notation* row))))
          ((member row keys)
           (complain (clause-spot) "~a is given twice" (key-name *notation* row)))
          ((find-rival row keys)
           (complain (clause-spot) "~a and ~a are both given; give only one of them"
                     (key-name *notation* (if (box-key-instead row) row (find-rival row keys)))
                     (key-name *notation* (if (box-key-instead row) (find-rival row keys) row))))
          (t row))))

(defun complain-of-centre (values description)
  "Complain if the centre of mass in VALUES, those of DESCRIPTION, lies outside the box."
  (let ((reason (centre-fault values)) (*clause* (clause-number :centre description)))
    (when reason
      (complain (clause-spot) "~a" reason))))

(defun find-rival (row keys)
  "Return the one of KEYS in whose place the key ROW stands, or that stands in its place, or NIL."
  (loop for other in keys
        when (or (eq (box-key-key other) (box-key-instead row))
                 (eq (box-key-key row) (box-key-instead other)))
          return other))

(defun box-values (description)
  "Return a plist of the values in DESCRIPTION, a list of clauses, complaining of what is wrong."
  (let ((values '()) (keys '()) (*clause* 0) (*units* (described-units description)))
    (dolist (clause description)
      (let ((row (clause-key clause keys)))
        (when row
          (push row keys)
          (setf values (list* (box-key-key row) (key-value row (rest clause)) values))))
      (incf *clause*))
    (complain-of-missing keys)
    (complain-of-no-need values)
    (complain-of-centre values description)
    (if (or *units* (getf values :mass)) (converted-values values description) values)))

(defun clause-number (key description)
  "Return the number of the clause of DESCRIPTION for KEY, a keyword, or NIL."
  (loop with row = (find-key key)
        for clause in description
        for number from 0
        when (and (consp clause) (eq row (key-named (first clause)))) return number))

(defun described-units (description)
  "Return the units that DESCRIPTION, a list of clauses, names, or NIL.  In the place of wrong
ones, of which is complained where they stand, come some that allow all needs."
  (let ((number (clause-number :units description)))
    (when number
      (multiple-value-bind (units problems)
          (let ((*clause* number))
            (with-problems (key-value (find-key :units) (rest (nth number description)))))
        (if problems
            (make-units (unit-named "CM") (unit-named "N") 1)
            units)))))

(defun converted-values (values description)
  "Return VALUES, those of DESCRIPTION in *UNITS*, in cm and finger forces; a mass becomes a
weight.  As long as no gripper is known, a finger force is 1 N."
  (let* ((mass (getf values :mass))
         (units (if mass (units-with-mass (clause-number :mass description)) *units*))
         (converted (list :units units)))
    (dolist (row *box-keys*)
      (let ((value (getf values (box-key-key row))))
        (unless (or (null value) (eq (box-key-key row) :units))
          (setf (getf converted (box-key-key row))
                (or (measured-value row value (lambda (number measure)
                                                (from-units number measure units)))
                    (refuse-size row description))))))
    (when mass
      (setf (getf converted :weight) (or (exactly-times mass +standard-gravity+)
                                         (refuse-size (find-key :mass) description))))
    converted))

(defun units-with-mass (clause)
  "Return *UNITS* as they are for a box whose mass is given in the clause numbered CLAUSE."
  (let ((*clause* clause))
    (if *units*
        (make-units (units-length *units*) (units-force *units*) 1
                    (or (and (units-finger *units*) (units-spot *units*)) (clause-spot)))
        (make-units (unit-named "CM") (unit-named "FINGER") 1 (clause-spot)))))

(defun refuse-size (row description)
  "Complain that what DESCRIPTION gives for the key ROW can't be converted."
  (let ((*clause* (clause-number (box-key-key row) description)))
    (complain (clause-spot) "~a is out of range: in cm or N, it must lie between 1e-300 and ~
                             1e300"
              (clause-text *notation* row (rest (nth *clause* description))))))

(defun complain-of-missing (keys)
  "Complain if KEYS lack one that a box must have.  Where the box was read, a parenthesis too many
may have ended it."
  (let ((missing (loop for row in *box-keys*
                       unless (or (box-key-optional row) (member row keys)
                                  (find (box-key-key row) keys :key #'box-key-instead))
                         collect row)))
    (dolist (row missing)
      (complain *path* "~a is missing; it takes ~a" (key-name *notation* row) (key-takes row)))
    (when (and missing *places*)
      (complain :end "the box ends here; if more of it follows, there is one ~a too many, here or ~
                      earlier"
                (nth-value 1 (description-text *notation*))))))

(defun complain-of-no-need (values)
  "Complain if the task in VALUES needs neither forces nor velocities."
  (flet ((needs-nothing-p (row)
           (let ((needs (getf values (box-key-key row))))
             (and needs (every #'zerop (the six needs))))))
    (unless (loop for row in *box-keys*
                    thereis (and (eq :needs (box-key-type row)) (not (needs-nothing-p row))))
      (complain *path* "the task needs nothing: ~{~a~^ and ~} are all 0"
                (loop for row in *box-keys*
                      when (eq :needs (box-key-type row)) collect (key-name *notation* row))))))

(defun parse-box (form &key file line)
  "Return the box that FORM describes: the paper's list
((SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED Z2 X1) (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))
(VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))), in any order, with an optional (NAME \"pencil\") and
(FACTS (FRAGILE (Z1)) (WET)), also inside (SETQ BOX '...).  Names may be of any package.  FILE and
LINE are used in reports.

Sizes in cm; weight in units of one finger's greatest normal force; V in cm; needs from 0 to 1; or
all in the units of (UNITS MM N), and (MASS kg) for the weight: see docs/languages.md.
Signals a BOX-ERROR that holds all that is wrong with it."
  (canonical-box (handler-case (canonical form)
                   (syntax-error (condition)
                     (error 'box-error :problems (input-error-problems condition))))
                 file line))

(defun box-of (box)
  "Return BOX if it is one, or the box that it describes."
  (if (box-p box) box (parse-box box)))

(defun canonical-box (form file line)
  "Return the box of FORM, as the data reader returns it, or signal a BOX-ERROR."
  (multiple-value-bind (values problems)
      (multiple-value-bind (description *path*) (unwrap-box form)
        (check-description description))
    (when problems
      (refuse-box problems file line))
    (make-box values line)))

(defun refuse-box (problems file line)
  "Signal a BOX-ERROR that holds PROBLEMS, those of the box in FILE that begins at LINE."
  (dolist (problem problems)
    (setf (problem-file problem) file)
    (unless (problem-line problem) (setf (problem-line problem) line)))
  (error 'box-error :problems problems))

(defun make-box (values line)
  "Return the box of VALUES, a plist that has all that a box must have."
  (let ((slots '()) (others '()))
    (dolist (row *box-keys*)
      (let ((value (getf values (box-key-key row))))
        (cond ((null value))
              ((box-key-slot row) (setf slots (list* (box-key-slot row) value slots)))
              (t (setf others (list* (box-key-key row) value others))))))
    (apply #'%make-box :line line :others others (append (gravity-slots others) slots))))

(defun box-values-of (box)
  "Return the plist of the values of BOX."
  (loop for row in *box-keys*
        collect (box-key-key row)
        collect (funcall (box-key-reader row) box)))

(defun box-with (box row value)
  "Return a box as BOX with VALUE for the key ROW."
  (let ((values (box-values-of box)))
    (setf (getf values (box-key-key row)) value)
    (loop for other in *box-keys*
          when (eq (box-key-key row) (box-key-instead other))
            do (setf (getf values (box-key-key other)) nil))
    (make-box values (%box-line box))))

(defun check-description (description)
  "Return the plist of the values in DESCRIPTION, and the list of the problems in it."
  (let ((*file* nil) (*lines* nil) (*subject* "BOX") (*place* nil))
    (with-problems
      (cond ((and (part-p description "SETQ") (nthcdr 3 description))
             (complain (list 3) "~a stands after the end of the box: a ) before it is one too many"
                       (value-text *notation* (fourth description))))
            ((and (consp description) (some #'consp description))
             (box-values description))
            (t (complain *path* "~a is not a box description: it is ~a"
                         (value-text *notation* description)
                         (nth-value 0 (description-text *notation*))))))))
