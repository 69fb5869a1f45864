;;;; read-box.lisp -- the description of a box, checked, becomes a box.

(in-package :supergrip)

(defun unwrap-box (form)
  "Return the description in FORM, which may be '(...), or (SETQ BOX '(...)); and where in FORM it is,
a list of numbers, each that of an element."
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
  (dolist (row *box-keys*)
    (when (if (stringp name)
              (string= name (box-key-json row))
              (or (eq name (box-key-key row)) (name= name (box-key-key row))))
      (return row))))

(defun clause-key (clause keys)
  "Return the row of the key of CLAUSE if it is a good one that is not in KEYS yet, or complain."
  (let* ((name (and (consp clause) (or (stringp (first clause)) (namep (first clause)))
                    (or (eq *notation* :json) (not (stringp (first clause))))
                    (first clause)))
         (row (and name (key-named name))))
    (cond ((null name)
           (complain (clause-spot) "~a is not a part of a box description: its parts are lists such as ~
                                    (SIZE 12 2 2)" (value-text *notation* clause)))
          ((null row)
           (complain (clause-spot) "unknown key ~a~a; keys are ~{~a~^, ~}"
                     (value-text *notation* name)
                     (suggestion (string name) (mapcar (if (stringp name)
                                                           #'box-key-json
                                                           (lambda (row) (symbol-name (box-key-key row))))
                                                       *box-keys*))
                     (loop for row in *box-keys* collect (key-name *notation* row))))
          ((member row keys)
           (complain (clause-spot) "~a is given twice" (key-name *notation* row)))
          (t row))))

(defun key-spot (key description)
  "Return where in DESCRIPTION, a list of clauses, that of KEY begins, as CLAUSE-SPOT does."
  (let ((*clause* (position-if (lambda (clause)
                                 (and (consp clause) (eq (key-named (first clause)) (find-key key))))
                               description)))
    (clause-spot)))

(defun complain-of-centre (values description)
  "Complain if the centre of mass in VALUES, those of DESCRIPTION, lies outside the box."
  (let ((reason (centre-fault values)))
    (when reason
      (complain (key-spot :centre description) "~a" reason))))

(defun box-values (description)
  "Return a plist of the values in DESCRIPTION, a list of clauses, complaining of what is wrong."
  (let ((values '()) (keys '()) (*clause* 0))
    (dolist (clause description)
      (let ((row (clause-key clause keys)))
        (when row
          (push row keys)
          (setf (getf values (box-key-key row)) (key-value row (rest clause)))))
      (incf *clause*))
    (complain-of-missing keys)
    (complain-of-no-need values)
    (complain-of-centre values description)
    values))

(defun complain-of-missing (keys)
  "Complain if KEYS lack one that a box must have.  Where the box was read, a parenthesis too many may
have ended it."
  (let ((missing (remove-if (lambda (row) (or (box-key-optional row) (member row keys)))
                            *box-keys*)))
    (dolist (row missing)
      (complain *path* "~a is missing; it takes ~a" (key-name *notation* row) (key-takes row)))
    (when (and missing *places*)
      (complain :end "the box ends here; if more of it follows, there is one ~a too many, here or earlier"
                (nth-value 1 (description-text *notation*))))))

(defun complain-of-no-need (values)
  "Complain if the task in VALUES needs neither forces nor velocities."
  (let ((rows (remove :needs *box-keys* :key #'box-key-type :test-not #'eq)))
    (when (loop for row in rows
                for needs = (getf values (box-key-key row))
                always (and needs (every #'zerop (the six needs))))
      (complain *path* "the task needs nothing: ~{~a~^ and ~} are all 0"
                (loop for row in rows collect (key-name *notation* row))))))

(defun parse-box (form &key file line)
  "Return the box that FORM describes: the paper's list
((SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED Z2 X1) (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))
(VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))), in any order, with an optional (NAME \"pencil\") and
(FACTS (FRAGILE (Z1)) (WET)), also inside (SETQ BOX '...).  Names may be of any package.  FILE and LINE are used in reports.

Sizes in cm; weight in units of one finger's greatest normal force; V in cm; needs from 0 to 1.
Signals a BOX-ERROR that holds all that is wrong with it."
  (canonical-box (handler-case (canonical form)
                   (syntax-error (condition)
                     (error 'box-error :problems (input-error-problems condition))))
                 file line))

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

(defun box-with (box row value)
  "Return a box as BOX with VALUE for the key ROW."
  (let ((values (loop for other in *box-keys*
                      collect (box-key-key other)
                      collect (funcall (box-key-reader other) box))))
    (setf (getf values (box-key-key row)) value)
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
