;;;; read-gripper.lisp -- (SETQ GRIPPER ...) is read and checked; who uses which dimension.

(in-package :supergrip)

(defparameter +dimensions+
  '(("FINGER-LENGTH" 3.2d0 "cm, of each of a finger's two links")
    ("FINGER-DIST" 6.05d0 "cm, between the bases of opposed fingers")
    ("FINGER-SPREAD" 1.7375d0 "cm, between the two fingers that work side by side")
    ("FINGER-WIDTH" 0.3d0 "cm, the least width of a face that a fingertip can hold")
    ("DIST-PINCH" 12d0 "cm, the opening of the hand")
    ("WIDTH-HAND" 8d0 "cm, across the fingers")
    ("REACH-U" 4.85d0 "cm, of thumb and palm from the closing fingers in the U-shape")
    ("REACH-C" 4.825d0 "cm, the same in the C-shape")
    ("SLIPPERY-U" 0.1d0 "friction at or below which the box is SLIPPERY")
    ("FINGER-FORCE" 15d0 "N, the greatest normal force of a finger"
     "boxes with forces in N or LBF, or with a mass")
    ("PALM-DEPTH" 8d0 "cm, from the palm's frame to the grasp centre"
     "formats that place the palm"))
  "The dimensions that shipped knowledge or SUPER-GRIP itself may use: the name, a number such as a
hand has, its unit and meaning, and which part of SUPER-GRIP uses it.  A gripper
names those that are used, and may have others.")

(defstruct gripper
  "A gripper as it was read.  DIMENSIONS, an alist from name to double; NAMES, those that it gives,
rightly or not; MODEL, a string, or NIL; FORM, (SETQ GRIPPER '(...)), or NIL if there is none;
PLACE, its file and line as a text, if it has a file of its own."
  (dimensions '() :type list :read-only t) (names '() :type list :read-only t)
  (model nil :read-only t) (form nil :read-only t) (place nil :read-only t))

(defun gripper-dimension (gripper name)
  "Return the dimension NAME, a string, of GRIPPER, a double, or NIL."
  (cdr (assoc name (gripper-dimensions gripper) :test #'string=)))

(defun length-name-p (name)
  "True if the dimension NAME is a length that a finger may span: all that are not known as others."
  (let ((row (assoc name +dimensions+ :test #'string=)))
    (or (null row)
        (and (eql 0 (search "cm" (third row))) (string/= name "PALM-DEPTH")))))

(defun longest-dimension (dimensions)
  "Return that of DIMENSIONS, an alist from name to number, which is the greatest length, in cm; NIL
if there is none."
  (let ((lengths (loop for entry in dimensions
                       when (and (length-name-p (car entry)) (plusp (cdr entry))) collect entry)))
    (and lengths (reduce (lambda (a b) (if (> (cdr b) (cdr a)) b a)) lengths))))

(defparameter +most-dimensions+ 200 "The most dimensions that a gripper may have.")

(defun parse-dimension (name value form)
  "Return the entry of the dimension NAME, which VALUE, a part of FORM, follows; or complain."
  (cond ((not (realp value))
         (complain form "~a has no number after it" name))
        ((name-in name '("U" "V" "T"))
         (complain form "~a can't be a dimension: it means something else in a form" name))
        ((not (and (as-double value) (>= value 0)))
         (complain form "~a is ~a; a dimension is a number from 0" name (form-text value)))
        (t (cons (symbol-name name) (as-double value)))))

(defun flat-list (list)
  "Return LIST with the elements of the lists in it in their places."
  (loop for part in list
        if (consp part) append part
          else collect part))

(defparameter +longest-model+ 100 "The most characters that the name of a gripper's model may
have.")

(defun parse-model (value form)
  "Return VALUE, the model's name, or NIL after a complaint."
  (if (and (stringp value) (<= 1 (length value) +longest-model+))
      value
      (complain form "MODEL is the name of the hand, a string of at most ~d characters such as ~
                      \"2F-85\", not ~a" +longest-model+ (form-text value))))

(defun parse-gripper (list form place)
  "Return the gripper of LIST, names and values in turn, complaining of what is wrong.  A name and
its value may have a list of their own.  FORM holds LIST, and stands at PLACE."
  (let ((dimensions '()) (names '()) (model nil) (list (flat-list list)))
    (if (nthcdr (* 2 +most-dimensions+) list)
        (complain form "more than ~d dimensions" +most-dimensions+)
        (loop while list
              do (let ((name (pop list)))
                   (cond ((not (namep name))
                          (complain form "~a is not the name of a dimension" (form-text name)))
                         ((name-in name names) (complain form "~a is given twice" name))
                         ((name= name "MODEL") (setf model (parse-model (first list) form)))
                         (t (let ((entry (parse-dimension name (first list) form)))
                              (when entry (push entry dimensions)))))
                   (when (namep name)
                     (push (symbol-name name) names)
                     (unless (namep (first list)) (pop list))))))
    (check-gripper dimensions form)
    (make-gripper :dimensions (nreverse dimensions) :names names :model model :form form
                  :place place)))

(defparameter +widest-opening+ 50d0
  "An opening, in cm, that no hand is likely to exceed; one that does may be meant in mm.")

(defun check-gripper (dimensions form)
  "Complain of DIMENSIONS that contradict each other."
  (flet ((size (name) (cdr (assoc name dimensions :test #'string=)))
         (compare (control &rest numbers)
           (complain form "~?" control (apply #'number-texts numbers))))
    (let ((length (size "FINGER-LENGTH")) (dist (size "FINGER-DIST"))
          (pinch (size "DIST-PINCH")) (width (size "FINGER-WIDTH"))
          (spread (size "FINGER-SPREAD")))
      (when (and length dist pinch (> pinch (+ dist (* 2 length))))
        (compare "DIST-PINCH is ~a, but fingers of two links of ~a cm that start ~a cm apart open ~
                  to ~a at most" pinch length dist (+ dist (* 2 length))))
      (when (and width spread (> width spread))
        (compare "FINGER-WIDTH is ~a, more than FINGER-SPREAD, ~a" width spread))
      (when (and spread pinch (> spread pinch))
        (compare "FINGER-SPREAD is ~a, more than DIST-PINCH, ~a" spread pinch))
      (when (and pinch (> pinch +widest-opening+))
        (complain form '(:warning "DIST-PINCH is ~a cm: dimensions count in cm, not in mm")
                  (number-text pinch)))
      (when (eql 0d0 (size "FINGER-FORCE"))
        (complain form "FINGER-FORCE is 0; a finger that exerts no force holds nothing")))))

(defun definition-form (form)
  "Return the name and the list of FORM, (SETQ name '(...)), or NIL after a complaint."
  (if (and (part-p form "SETQ") (= (length form) 3) (namep (second form))
           (part-p (third form) "QUOTE") (consp (second (third form))))
      (values (second form) (second (third form)))
      (complain form "a grasp file holds (SETQ GRIPPER '(...)), (DEFUN name (parameter...) form) ~
                      and (SETQ grasp '(...)), not ~a" (form-text form))))

(defun gripper-form-p (form)
  (and (part-p form "SETQ") (consp (rest form)) (name= (second form) "GRIPPER")))

(defun build-gripper (forms &key alone)
  "Return the gripper that the one (SETQ GRIPPER ...) among FORMS gives; one without dimensions
after a complaint if it is wrong.  If ALONE is true, FORMS are those of a gripper file, which holds
nothing else."
  (let* ((grippers (remove-if-not #'gripper-form-p forms))
         (form (first grippers)))
    (when alone
      (dolist (other (remove-if #'gripper-form-p forms))
        (complain other "a gripper file holds (SETQ GRIPPER '(...)) alone, not ~a; rules and ~
                         grasps have files of their own" (form-text other))))
    (let ((*form* form) (*subject* "GRIPPER"))
      (when (null form)
        (complain nil "there is no (SETQ GRIPPER '(...))~:[ here, and no gripper file is given~;~]"
                  alone))
      (dolist (second (rest grippers))
        (complain second "the gripper is given twice"))
      (multiple-value-bind (name list) (and form (definition-form form))
        (if name
            (parse-gripper list form (and alone (form-place-text form)))
            (make-gripper))))))

;;; Which dimensions are used

(defstruct dimension-use
  "That the DIMENSION, a name, is used by USER, a rule or grasp, as KIND says, at PLACE, its file
and line as a text, if they are known; as the threshold of the ASSERTION, a name, or in a form if
that is NIL."
  (dimension nil :read-only t) (kind "GRASP" :read-only t) (user nil :read-only t)
  (place nil :read-only t) (assertion nil :read-only t))

(defun use-text (use)
  "Return who makes USE, and where."
  (format nil "~a ~a~@[, ~a,~] uses it~@[ for ~a~]" (dimension-use-kind use)
          (dimension-use-user use)
          (dimension-use-place use) (dimension-use-assertion use)))

(defun replaced-dimensions (forms)
  "Return the rows, as in +DIMENSIONS+, of the dimensions of grippers among FORMS that count no
more."
  (loop for form in (remove-if-not #'gripper-form-p forms)
        for list = (and (= (length form) 3) (part-p (third form) "QUOTE") (second (third form)))
        append (loop for (name value) on (and (listp list) (flat-list list))
                     when (and (namep name) (realp value) (as-double value))
                       collect (list (symbol-name name) (as-double value)))))

(defun known-dimensions (forms)
  "Return the rows of all dimensions that the grasp file FORMS may mean."
  (remove-duplicates (append +dimensions+ (replaced-dimensions forms))
                     :key #'first :test #'string= :from-end t))

(defun dimension-line (name rows)
  "Return what a gripper may have for the dimension NAME, one of ROWS."
  (destructuring-bind (number &optional meaning &rest parts)
      (rest (assoc name rows :test #'string=))
    (declare (ignore parts))
    (format nil "~a ~a~@[ ; ~a~]" name (number-text number) meaning)))

(defun warn-of-misspelt-dimensions (gripper uses rows)
  "Warn of each name in GRIPPER that nothing uses and that is like one of ROWS that GRIPPER lacks."
  (let ((lacking (set-difference (mapcar #'first rows) (gripper-names gripper) :test #'string=)))
    (loop for (name) in (gripper-dimensions gripper)
          for hint = (suggestion name lacking)
          unless (or (assoc name rows :test #'string=)
                     (find name uses :key #'dimension-use-dimension :test #'string=)
                     (equal hint ""))
            do (complain *form* '(:warning "nothing uses ~a~a") name hint))))

(defun check-dimensions (gripper uses rows)
  "Complain of each dimension that GRIPPER lacks, and of which there is one among USES; warn of
those that may be misspelt.  ROWS are those of all known dimensions."
  (when (gripper-form gripper)
    (let ((*form* (gripper-form gripper)) (*subject* "GRIPPER"))
      (warn-of-misspelt-dimensions gripper uses rows)
      (loop for (name) in rows
            for (first . others) = (remove name uses :key #'dimension-use-dimension
                                                     :test-not #'string=)
            when (and first (not (member name (gripper-names gripper) :test #'string=)))
              do (complain *form* "~a is missing: ~a~[~;, and 1 other does~:;, and ~:*~d others ~
                                   do~]; add it with your hand's number, as  ~a"
                           name (use-text first) (length others) (dimension-line name rows))))))
