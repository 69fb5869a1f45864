;;;; read-gripper.lisp -- the gripper's dimensions are checked; the numbers stand in grasps.lisp, (SETQ GRIPPER ...).

(in-package :supergrip)

(defparameter +dimensions+
  '("FINGER-LENGTH" "FINGER-DIST" "FINGER-SPREAD" "FINGER-WIDTH" "DIST-PINCH" "WIDTH-HAND"
    "SLIPPERY-U")
  "The dimensions that SUPER-GRIP itself or the printed grasp needs; a gripper may have others.")

(defparameter +most-dimensions+ 200 "The most dimensions that a gripper may have.")

(defun parse-dimension (name value form)
  (cond ((name-in name '("U" "V" "T"))
         (complain form "~a can't be a dimension: it means something else in a form" name))
        ((not (and (as-double value) (>= value 0)))
         (complain form "~a is ~a; a dimension is a number from 0" name (form-text value)))
        (t (cons (symbol-name name) (as-double value)))))

(defun flat-list (list)
  "Return LIST with the elements of the lists in it in their places."
  (loop for part in list
        if (consp part) append part
          else collect part))

(defun parse-gripper (list form)
  "Return the alist of the dimensions in LIST, names and numbers in turn, complaining of what is
wrong.  A name and its number may have a list of their own."
  (let ((dimensions '()) (names '()) (list (flat-list list)))
    (when (nthcdr (* 2 +most-dimensions+) list)
      (return-from parse-gripper
        (complain form "more than ~d dimensions" +most-dimensions+)))
    (loop while list
          do (let ((name (pop list)))
               (cond ((not (namep name))
                      (complain form "~a is not the name of a dimension" (form-text name)))
                     ((not (realp (first list)))
                      (push name names)
                      (complain form "~a has no number after it" name))
                     ((name-in name names)
                      (complain form "~a is given twice" name)
                      (pop list))
                     (t (push name names)
                        (let ((entry (parse-dimension name (pop list) form)))
                          (when entry (push entry dimensions)))))))
    (dolist (name +dimensions+)
      (unless (find-if (lambda (given) (name= given name)) names)
        (complain form "~a is missing" name)))
    (check-gripper dimensions form)
    (nreverse dimensions)))

(defun check-gripper (dimensions form)
  "Complain of DIMENSIONS that contradict each other."
  (flet ((size (name) (cdr (assoc name dimensions :test #'string=)))
         (compare (control &rest numbers)
           (complain form "~?" control (apply #'number-texts numbers))))
    (let ((length (size "FINGER-LENGTH")) (dist (size "FINGER-DIST"))
          (pinch (size "DIST-PINCH")) (width (size "FINGER-WIDTH"))
          (spread (size "FINGER-SPREAD")))
      (when (and length dist pinch (> pinch (+ dist (* 2 length))))
        (compare "DIST-PINCH is ~a, but fingers of two links of ~a cm that start ~a cm apart open to ~
                  ~a at most" pinch length dist (+ dist (* 2 length))))
      (when (and width spread (> width spread))
        (compare "FINGER-WIDTH is ~a, more than FINGER-SPREAD, ~a" width spread))
      (when (and spread pinch (> spread pinch))
        (compare "FINGER-SPREAD is ~a, more than DIST-PINCH, ~a" spread pinch)))))

(defun definition-form (form)
  "Return the name and the list of FORM, (SETQ name '(...)), or NIL after a complaint."
  (if (and (part-p form "SETQ") (= (length form) 3) (namep (second form))
           (part-p (third form) "QUOTE") (consp (second (third form))))
      (values (second form) (second (third form)))
      (complain form "a grasp file holds (SETQ GRIPPER '(...)), (DEFUN name (parameter...) form) ~
                      and (SETQ grasp '(...)), not ~a" (form-text form))))

(defun gripper-form-p (form)
  (and (part-p form "SETQ") (consp (rest form)) (name= (second form) "GRIPPER")))

(defun build-gripper (forms)
  "Return the gripper that the one (SETQ GRIPPER ...) among FORMS gives, or complain."
  (let* ((grippers (remove-if-not #'gripper-form-p forms))
         (*form* (first grippers))
         (*subject* "GRIPPER"))
    (cond ((null grippers) (complain nil "there is no (SETQ GRIPPER '(...))"))
          (t
           (dolist (second (rest grippers))
             (complain second "the gripper is given twice"))
           (multiple-value-bind (name plist) (definition-form (first grippers))
             (and name (parse-gripper plist (first grippers))))))))
