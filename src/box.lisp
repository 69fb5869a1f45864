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
    (format stream "~@[~s ~]~{~a~^ x ~} cm" (box-name box) (mapcar #'form-text (box-size box)))))

;;; Reading

(defparameter +box-keys+
  '((:size "three sizes in cm, above 0: (SIZE 12 2 2)")
    (:weight "one number from 0, in finger forces: (WEIGHT 0.2)")
    (:u "one coefficient of friction from 0: (U 0.8)")
    (:v "one coefficient of torsional friction from 0, in cm: (V 0.2)")
    (:constrained "faces among X1 X2 Y1 Y2 Z1 Z2, or nothing: (CONSTRAINED Z2 X1)")
    (:force-needed "a list of six numbers from 0 to 1: (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))")
    (:velocity-needed "a list of six numbers from 0 to 1: (VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))")
    (:name "one string: (NAME \"pencil\")"))
  "The keys of a box description and what each takes.")

(defun refuse-value (key values)
  (complain nil "(~a~{ ~a~}) is not valid: ~a takes ~a" key (mapcar #'form-text values) key
            (second (assoc key +box-keys+))))

(defun number-in (value least most)
  "Return VALUE as a double if it is a real from LEAST to MOST (NIL for no bound), or NIL."
  (let ((number (and (realp value) (as-double value))))
    (and number (>= number least) (or (null most) (<= number most)) number)))

(defun number-list (key list count least most values)
  "Return LIST, COUNT numbers from LEAST to MOST, as an array of doubles, or complain."
  (let ((numbers (and (consp list) (loop for value in list collect (number-in value least most)))))
    (if (and (= (length numbers) count) (notany #'null numbers))
        (coerce numbers `(simple-array double-float (,count)))
        (refuse-value key values))))

(defun face-set (values)
  "Return the set of faces that VALUES name, or complain."
  (let ((set 0))
    (dolist (value values set)
      (let ((face (and (namep value) (surface-index value))))
        (cond ((null face)
               (return (complain nil "~a is no surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2, ~
                                       without parentheses of their own" (form-text value))))
              ((logbitp face set)
               (return (complain nil "~a is constrained twice" value)))
              (t (setf set (logior set (ash 1 face)))))))))

(defun box-value (key values)
  "Return the value of KEY that VALUES, the rest of its clause, give.  NIL after a complaint."
  (flet ((only (value) (if (and value (null (rest values))) value (refuse-value key values))))
    (ecase key
      (:name (only (and (stringp (first values)) (first values))))
      (:size (let ((size (number-list key values 3 0 nil values)))
               (cond ((null size) nil)
                     ((every #'plusp size) size)
                     (t (refuse-value key values)))))
      ((:weight :u :v) (only (number-in (first values) 0 nil)))
      (:constrained (face-set values))
      ((:force-needed :velocity-needed)
       (if (rest values)
           (refuse-value key values)
           (number-list key (first values) 6 0 1 values))))))

(defun unwrap-box (form)
  "Return the description in FORM, which may be '(...), or (SETQ BOX '(...))."
  (cond ((and (consp form) (name= (first form) "QUOTE") (= (length form) 2))
         (unwrap-box (second form)))
        ((and (consp form) (name= (first form) "SETQ") (= (length form) 3)
              (name= (second form) "BOX"))
         (unwrap-box (third form)))
        (t form)))

(defun clause-key (clause keys)
  "Return the key of CLAUSE if it is a good one that is not in KEYS yet, or complain."
  (let* ((name (and (consp clause) (namep (first clause)) (first clause)))
         (key (and name (name-in name (mapcar #'first +box-keys+)))))
    (cond ((null name)
           (complain nil "~a is not a part of a box description: its parts are lists as ~
                          (SIZE 12 2 2)" (form-text clause)))
          ((null key)
           (complain nil "unknown key ~a~a; keys are ~{~a~^, ~}" name
                     (suggestion (symbol-name name) (mapcar #'symbol-name
                                                            (mapcar #'first +box-keys+)))
                     (mapcar #'first +box-keys+)))
          ((member key keys) (complain nil "~a is given twice" key))
          (t key))))

(defun box-values (description)
  "Return a plist of the values in DESCRIPTION, a list of clauses, complaining of what is wrong."
  (let ((values '()) (keys '()))
    (dolist (clause description)
      (let ((key (clause-key clause keys)))
        (when key
          (push key keys)
          (setf (getf values key) (box-value key (rest clause))))))
    (loop for (key takes) in +box-keys+
          unless (or (eq key :name) (member key keys))
            do (complain nil "~a is missing; it takes ~a" key takes))
    (when (and (getf values :force-needed) (getf values :velocity-needed)
               (every #'zerop (getf values :force-needed))
               (every #'zerop (getf values :velocity-needed)))
      (complain nil "the task needs nothing: FORCE-NEEDED and VELOCITY-NEEDED are all 0"))
    values))

(defun parse-box (form &key file line)
  "Return the box that FORM describes: the paper's list
((SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED Z2 X1) (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))
(VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))), in any order, with an optional (NAME \"pencil\"), also
inside (SETQ BOX '...).  Names may be of any package.  FILE and LINE are used in reports.

Sizes in cm; weight in units of one finger's greatest normal force; V in cm; needs from 0 to 1.
Signals a BOX-ERROR that holds all that is wrong with it."
  (let ((description (unwrap-box (handler-case (canonical form)
                                   (syntax-error (condition)
                                     (error 'box-error
                                            :problems (input-error-problems condition)))))))
    (canonical-box description file line)))

(defun canonical-box (description file line)
  "Return the box of DESCRIPTION, as the data reader returns it, or signal a BOX-ERROR."
  (multiple-value-bind (values problems)
      (let ((*file* nil) (*lines* nil) (*subject* "BOX") (*place* nil))
        (with-problems
          (if (and (consp description) (some #'consp description))
              (box-values description)
              (complain nil "~a is not a box description: it is a list as ~
                             ((SIZE 12 2 2) (WEIGHT 0.2) ...)" (form-text description)))))
    (when problems
      (dolist (problem problems)
        (setf (problem-file problem) file (problem-line problem) line))
      (error 'box-error :problems problems))
    (%make-box :name (getf values :name) :size (getf values :size)
               :weight (getf values :weight) :u (getf values :u) :v (getf values :v)
               :constrained (getf values :constrained)
               :force (getf values :force-needed) :velocity (getf values :velocity-needed)
               :line line)))

;;; Preliminary assertions

(defparameter +inputs+
  '((("OPPOSED") 2) (("SMALL") 2) (("NARROW") 2) (("LARGE") 2) (("CONSTRAINED") 1)
    (("SLIPPERY") 0))
  "The predicates that the preliminary assertions use, in their order in a rule base.")

(defun assert-box (memory predicates box finger-width finger-spread dist-pinch slippery-u)
  "Put into MEMORY what is known of BOX before any rule runs.
A pair of opposed faces is SMALL if it is closer than FINGER-WIDTH, NARROW if closer than
FINGER-SPREAD, LARGE if DIST-PINCH apart or farther (cm); the box is SLIPPERY if its friction is
SLIPPERY-U or less."
  (declare (simple-vector predicates)
           (double-float finger-width finger-spread dist-pinch slippery-u))
  (loop for face of-type fixnum in '(0 2 4)
        for pair in (load-time-value (list (pack '(0 1)) (pack '(2 3)) (pack '(4 5))))
        for distance = (aref (%box-size box) (surface-axis face))
        do (remember memory (svref predicates 0) pair)
           (when (< distance finger-width) (remember memory (svref predicates 1) pair))
           (when (< distance finger-spread) (remember memory (svref predicates 2) pair))
           (when (>= distance dist-pinch) (remember memory (svref predicates 3) pair)))
  (loop for face below 6
        for single in (load-time-value (loop for face below 6 collect (pack (list face))))
        when (logbitp face (%box-constrained box))
          do (remember memory (svref predicates 4) single))
  (when (<= (%box-u box) slippery-u)
    (remember memory (svref predicates 5) 0)))
