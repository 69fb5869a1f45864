;;;; box.lisp -- the description of a box and of a task, checked.

(in-package :supergrip)

(deftype six () "Six numbers: along X Y Z, about X Y Z." '(simple-array double-float (6)))
(deftype three () "Three numbers: along X Y Z." '(simple-array double-float (3)))

(defstruct (box (:conc-name %box-) (:constructor %make-box) (:copier nil) (:predicate box-p))
  "A box and what is to be done with it.  SIZE along X Y Z in cm; WEIGHT in finger forces; U the
coefficient of friction; V that of the soft finger's torque, in cm; CONSTRAINED a set of faces;
FORCE and VELOCITY what the task needs, 0 to 1, along and about X Y Z."
  (name nil)
  (size nil :type three)
  (weight 0d0 :type double-float)
  (u 0d0 :type double-float)
  (v 0d0 :type double-float)
  (constrained 0 :type (unsigned-byte 6))
  (force nil :type six)
  (velocity nil :type six)
  (line nil))

(defun box-name (box) "Return the name of BOX, a string, or NIL." (%box-name box))
(defun box-size (box) "Return the sizes of BOX along X Y Z, a list, in cm."
  (coerce (%box-size box) 'list))
(defun box-weight (box) "Return the weight of BOX, in units of one finger's greatest normal force."
  (%box-weight box))
(defun box-friction (box) "Return the coefficient of friction of BOX, U." (%box-u box))
(defun box-soft-friction (box)
  "Return the coefficient of the soft finger's torque about its normal, V, in cm."
  (%box-v box))
(defun box-constrained (box) "Return the names of the constrained faces of BOX."
  (loop for face below 6
        when (logbitp face (%box-constrained box)) collect (surface-name face)))
(defun box-force-needed (box)
  "Return the forces along X Y Z and the torques about X Y Z that the task needs, a list, 0 to 1."
  (coerce (%box-force box) 'list))
(defun box-velocity-needed (box)
  "Return the velocities along and about X Y Z that the task needs, a list, 0 to 1."
  (coerce (%box-velocity box) 'list))

(defmethod print-object ((box box) stream)
  (print-unreadable-object (box stream :type t)
    (plainly
      (format stream "~@[~s ~]~{~a~^ x ~} cm" (box-name box) (mapcar #'form-text (box-size box))))))

;;; Reading

(defstruct (box-key (:constructor box-key (key json takes example json-example)))
  "A part of a box description: its KEY, its name in JSON, what it TAKES in words, and an example
in each of the two notations."
  key json takes example json-example)

(defparameter +box-keys+
  (list (box-key :size "size" "three sizes in cm, above 0" "(SIZE 12 2 2)" "\"size\": [12, 2, 2]")
        (box-key :weight "weight" "one number from 0, in finger forces" "(WEIGHT 0.2)"
                 "\"weight\": 0.2")
        (box-key :u "u" "one coefficient of friction from 0" "(U 0.8)" "\"u\": 0.8")
        (box-key :v "v" "one coefficient of torsional friction from 0, in cm" "(V 0.2)"
                 "\"v\": 0.2")
        (box-key :constrained "constrained" "faces among X1 X2 Y1 Y2 Z1 Z2, or nothing"
                 "(CONSTRAINED Z2 X1)" "\"constrained\": [\"Z2\", \"X1\"]")
        (box-key :force-needed "force_needed" "a list of six numbers from 0 to 1"
                 "(FORCE-NEEDED (1 0.8 0.8 0.3 1 1))"
                 "\"force_needed\": [1, 0.8, 0.8, 0.3, 1, 1]")
        (box-key :velocity-needed "velocity_needed" "a list of six numbers from 0 to 1"
                 "(VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))"
                 "\"velocity_needed\": [0, 0.8, 0.8, 0, 0.8, 0.8]")
        (box-key :name "name" "one string" "(NAME \"pencil\")" "\"name\": \"pencil\""))
  "The keys of a box description and what each takes.")

(defvar *notation* :lisp
  "How the description being checked was written, for the reports: :LISP or :JSON.")

(defun key-name (entry)
  "Return the name of the key ENTRY as the user writes it."
  (if (eq *notation* :json)
      (format nil "\"~a\"" (box-key-json entry))
      (symbol-name (box-key-key entry))))

(defun key-takes (entry)
  "Return what the key ENTRY takes, with an example."
  (format nil "~a: ~a" (box-key-takes entry)
          (if (eq *notation* :json) (box-key-json-example entry) (box-key-example entry))))

(defun find-key (key)
  (find key +box-keys+ :key #'box-key-key))

(defun value-text (value)
  "Return VALUE as the user wrote it, cut after some 200 characters."
  (if (eq *notation* :json) (json-text value) (form-text value)))

(defun clause-text (key values)
  "Return the clause of KEY with VALUES as the user wrote it."
  (if (eq *notation* :json)
      (json-clause-text key values)
      (form-text (cons key values))))

;;; Where a part stands: for the reports, a list of numbers that PART-PLACE understands.

(defvar *path* '() "Where in its record the description being checked is: '() or inside QUOTE and SETQ.")
(defvar *clause* 0 "The number, from 0, of the clause being checked.")

(defun clause-spot ()
  "Return where the clause being checked begins."
  (append *path* (list (if (eq *notation* :json) (* 2 *clause*) *clause*))))

(defun value-spot (key &rest numbers)
  "Return where a part of the value of KEY in the clause being checked begins: as NUMBERS say, a value,
and an element of that."
  (append *path*
          (cond ((not (eq *notation* :json)) (cons *clause* (cons (1+ (first numbers)) (rest numbers))))
                ((member key '(:size :constrained)) (cons (1+ (* 2 *clause*)) numbers))
                (t (cons (1+ (* 2 *clause*)) (rest numbers))))))

(defun refuse-value (key values &optional (spot (clause-spot)))
  (let ((entry (find-key key)))
    (complain spot "~a is not valid: ~a takes ~a" (clause-text key values) (key-name entry)
              (key-takes entry))))

(defun number-in (value least most)
  "Return VALUE as a double if it is a real from LEAST to MOST (NIL for no bound), or NIL."
  (let ((number (and (realp value) (as-double value))))
    (and number (>= number least) (or (null most) (<= number most)) number)))

(defun number-list (key list count least most values &rest spot)
  "Return LIST, COUNT numbers from LEAST to MOST, as an array of doubles, or complain.  SPOT are the
numbers of the place of LIST among VALUES, for VALUE-SPOT."
  (let ((numbers (make-array count :element-type 'double-float))
        (place 0))
    (dolist (value (and (listp list) list))
      (let ((number (and (< place count) (number-in value least most))))
        (unless number
          (return-from number-list
            (refuse-value key values (apply #'value-spot key (append spot (list place))))))
        (setf (aref numbers place) number)
        (incf place)))
    (if (= place count)
        numbers
        (refuse-value key values))))

(defun face-set (values)
  "Return the set of faces that VALUES name, or complain."
  (let ((set 0) (good t))
    (loop for value in values
          for number from 0
          do (let ((face (and (namep value) (surface-index value))))
               (cond ((null face)
                      (setf good (complain (value-spot :constrained number)
                                           "~a is no surface of a box: surfaces are X1 X2 Y1 Y2 Z1 ~
                                            Z2~:[~;, without parentheses of their own~]"
                                           (value-text value) (consp value))))
                     ((logbitp face set)
                      (setf good (complain (value-spot :constrained number)
                                           "~a is constrained twice" (value-text value))))
                     (t (setf set (logior set (ash 1 face)))))))
    (and good set)))

(defun null-name-p (value)
  "True if VALUE is what stands for no name in our records: NIL or null."
  (or (null value) (name= value "NIL")
      (and (json-literal-p value) (string= (json-literal-text value) "null"))))

(defun box-value (key values)
  "Return the value of KEY that VALUES, the rest of its clause, give.  NIL after a complaint."
  (flet ((only (value)
           (cond ((rest values) (refuse-value key values))
                 (value)
                 (t (refuse-value key values (value-spot key 0))))))
    (unless (listp values)
      (return-from box-value (refuse-value key values)))
    (ecase key
      (:name (if (and values (null (rest values)) (null-name-p (first values)))
                 nil
                 (only (and (stringp (first values)) (first values)))))
      (:size (let ((size (number-list key values 3 0 nil values)))
               (cond ((null size) nil)
                     ((every #'plusp size) size)
                     (t (refuse-value key values
                                      (value-spot key (position-if-not #'plusp size)))))))
      ((:weight :u :v) (only (number-in (first values) 0 nil)))
      (:constrained (face-set values))
      ((:force-needed :velocity-needed)
       (if (rest values)
           (refuse-value key values)
           (number-list key (first values) 6 0 1 values 0))))))

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
  "Return the entry of the key NAME, a symbol or, in JSON, a string; or NIL."
  (dolist (entry +box-keys+)
    (when (if (stringp name)
              (string= name (box-key-json entry))
              (or (eq name (box-key-key entry)) (name= name (box-key-key entry))))
      (return entry))))

(defun clause-key (clause keys)
  "Return the key of CLAUSE if it is a good one that is not in KEYS yet, or complain."
  (let* ((name (and (consp clause) (or (stringp (first clause)) (namep (first clause)))
                    (or (eq *notation* :json) (not (stringp (first clause))))
                    (first clause)))
         (entry (and name (key-named name))))
    (cond ((null name)
           (complain (clause-spot) "~a is not a part of a box description: its parts are lists as ~
                                    (SIZE 12 2 2)" (value-text clause)))
          ((null entry)
           (complain (clause-spot) "unknown key ~a~a; keys are ~{~a~^, ~}" (value-text name)
                     (suggestion (string name) (mapcar (if (stringp name)
                                                           #'box-key-json
                                                           (lambda (entry)
                                                             (symbol-name (box-key-key entry))))
                                                       +box-keys+))
                     (mapcar #'key-name +box-keys+)))
          ((member (box-key-key entry) keys)
           (complain (clause-spot) "~a is given twice" (key-name entry)))
          (t (box-key-key entry)))))

(defun box-values (description)
  "Return a plist of the values in DESCRIPTION, a list of clauses, complaining of what is wrong."
  (let ((values '()) (keys '()) (*clause* 0))
    (dolist (clause description)
      (let ((key (clause-key clause keys)))
        (when key
          (push key keys)
          (setf (getf values key) (box-value key (rest clause)))))
      (incf *clause*))
    (complain-of-missing keys)
    (when (and (getf values :force-needed) (getf values :velocity-needed)
               (every #'zerop (the six (getf values :force-needed)))
               (every #'zerop (the six (getf values :velocity-needed))))
      (complain *path* "the task needs nothing: ~a and ~a are all 0"
                (key-name (find-key :force-needed)) (key-name (find-key :velocity-needed))))
    values))

(defun complain-of-missing (keys)
  "Complain if KEYS lack one that a box must have.  Where the box was read, a parenthesis too many may
have ended it."
  (let ((missing (remove-if (lambda (entry)
                              (or (eq (box-key-key entry) :name) (member (box-key-key entry) keys)))
                            +box-keys+)))
    (dolist (entry missing)
      (complain *path* "~a is missing; it takes ~a" (key-name entry) (key-takes entry)))
    (when (and missing *places*)
      (complain :end "the box ends here; if parts of it follow, one ~a too many stands here or before"
                (if (eq *notation* :json) "}" ")")))))

(defun parse-box (form &key file line)
  "Return the box that FORM describes: the paper's list
((SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED Z2 X1) (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))
(VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))), in any order, with an optional (NAME \"pencil\"), also
inside (SETQ BOX '...).  Names may be of any package.  FILE and LINE are used in reports.

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
      (dolist (problem problems)
        (setf (problem-file problem) file)
        (unless (problem-line problem) (setf (problem-line problem) line)))
      (error 'box-error :problems problems))
    (%make-box :name (getf values :name) :size (getf values :size)
               :weight (getf values :weight) :u (getf values :u) :v (getf values :v)
               :constrained (getf values :constrained)
               :force (getf values :force-needed) :velocity (getf values :velocity-needed)
               :line line)))

(defun check-description (description)
  "Return the plist of the values in DESCRIPTION, and the list of the problems in it."
  (let ((*file* nil) (*lines* nil) (*subject* "BOX") (*place* nil))
    (with-problems
      (cond ((and (part-p description "SETQ") (nthcdr 3 description))
             (complain (list 3) "~a stands after the end of the box: a ) before it is one too many"
                       (value-text (fourth description))))
            ((and (consp description) (some #'consp description))
             (box-values description))
            (t (complain *path* "~a is not a box description: ~a" (value-text description)
                         (if (eq *notation* :json)
                             "it is an object as {\"size\": [12, 2, 2], \"weight\": 0.2, ...}"
                             "it is a list as ((SIZE 12 2 2) (WEIGHT 0.2) ...)")))))))
