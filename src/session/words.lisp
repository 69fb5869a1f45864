;;;; words.lisp -- the paper's lists, typed: assertions, rules, grasps, the gripper.
;;;;
;;;; What these functions return has the symbols of the current package, and numbers as one would
;;;; type them, so that it can be used as data.  In SUPERGRIP-USER the words may be typed like
;;;; variables.

(in-package :supergrip)

(defun as-typed (form)
  "Return FORM, of names, strings for names, and numbers, as the Lisp reader would return it in the
current package."
  (typecase form
    (null nil)
    (cons (mapcar #'as-typed form))
    ((or symbol string) (typed-name (string form)))
    (double-float (or (typed-number form) form))
    (t form)))

(defun typed-number (number &key rounded)
  "Return the single float that NUMBER, a double, would be typed as, if floats are read as singles
and that stands for NUMBER, or, if ROUNDED, is next to it; else NIL."
  (and (member *read-default-float-format* '(single-float short-float))
       (let ((single (handler-case (coerce number 'single-float)
                       (arithmetic-error () nil))))
         (and single (as-double single)
              (or rounded (= (as-double single) number))
              single))))

(defun assertions (&optional (plan (last-plan)))
  "Return all that is known at the end of PLAN, or now if its run has stopped.  There is one list
for each predicate: its words, then its lists of faces.  All are symbols of the current package.
PLAN-ASSERTIONS gives strings."
  (as-typed (plan-assertions plan)))

(defun rules (&optional (knowledge *knowledge*))
  "Return the rules of KNOWLEDGE, in order, as (RULE name (IF ...) (THEN ...)), with the symbols of
the current package.  KNOWLEDGE-RULES gives objects."
  (as-typed (mapcar #'rule-form
                    (knowledge-rules (check-knowledge-argument
                                      knowledge "(describe-rule name) shows one rule")))))

(defun grasps (&optional (knowledge *knowledge*))
  "Return the names of the grasps of KNOWLEDGE, in order, symbols of the current package.  GRASP
gives what they stand for, KNOWLEDGE-GRASPS objects."
  (as-typed (mapcar #'grasp-name
                    (knowledge-grasps (check-knowledge-argument
                                       knowledge "(grasp name) shows one grasp")))))

(defun grasp (name &optional (knowledge *knowledge*))
  "Return the property list of the grasp NAME of KNOWLEDGE, (USED-SURFACES (N1 N2 A2) ...), with the
symbols of the current package.  Signals a NO-GRASP-ERROR."
  (as-typed (grasp-properties (need-grasp name (check-knowledge-argument knowledge)))))

(defun gripper (&optional (knowledge *knowledge*))
  "Return the property list of the gripper of KNOWLEDGE, (FINGER-LENGTH 4 ...), in cm, with the
symbols of the current package.  KNOWLEDGE-GRIPPER gives strings and doubles."
  (let ((file (gripper-source (check-knowledge-argument
                               knowledge "(getf (gripper) name) gives one dimension"))))
    (loop for part in (flat-list (nth-value 1 (definition-form (find-if #'gripper-form-p
                                                                        (data-file-forms file)))))
          collect (if (stringp part) part (as-typed part))))) ; MODEL is a string

(defun typed-possible-grasps ()
  "Return POSSIBLE-GRASPS of *PLAN*, the best first: name, quality, matching, as one would type
them."
  (loop for (name quality matching) in (possible-grasps)
        collect (list (as-typed name) (or (typed-number quality :rounded t) quality)
                      (as-typed matching))))

;;; Typed like variables

(defvar *typed-words* '() "The symbols of SUPERGRIP-USER that may be typed like variables.")

(defun word (name)
  "Return what NAME, a string, stands for where it is typed like a variable."
  (cond ((string= name "POSSIBLE-GRASPS") (typed-possible-grasps))
        ((string= name "ASSERTIONS") (assertions))
        ((string= name "RULES") (rules))
        ((string= name "GRASPS") (grasps))
        ((string= name "GRIPPER") (gripper))
        ((dimension (knowledge-graspbase *knowledge*) name)
         (as-typed (dimension (knowledge-graspbase *knowledge*) name)))
        (t (grasp name))))

(defun define-word (name)
  "Let NAME, a string, be typed like a variable in SUPERGRIP-USER, if it means nothing else there."
  (let ((symbol (define-typed-word name (find-package :supergrip-user) `(word ,name))))
    (when symbol
      (pushnew symbol *typed-words*))))

(defun define-grasp-words ()
  "Let the names of all grasps and dimensions in force be typed like variables."
  (mapc #'define-word (append (mapcar #'grasp-name (knowledge-grasps *knowledge*))
                              (mapcar #'car (knowledge-gripper *knowledge*)))))

(macrolet ((define-functions (&rest names)
             `(setf ,@(loop for name in names
                            collect `(fdefinition ',(find-symbol (string name) :supergrip-user))
                            collect `#',name))))
  (define-functions try possible-grasps assertions rules grasps grasp gripper))

(mapc #'define-word '("POSSIBLE-GRASPS" "ASSERTIONS" "RULES" "GRASPS" "GRIPPER"))
(define-grasp-words)

;;; A quote that was forgotten

(defmacro supergrip-user::keep (what &rest plan &environment environment)
  "KEEP, but (KEEP BEST) means (KEEP 'BEST), as in a rule, if BEST is no variable."
  `(keep ,(if (and (name= what "BEST") (global-name-p what environment '())) `',what what) ,@plan))

(defun call-of-face (form environment)
  "Return, as a macro does, what becomes of FORM, which begins with a face."
  (declare (ignore environment))
  `(refuse-argument "the quote is missing: write '~a" (form-text ',form)))

(defun define-face-calls ()
  "Let a list that begins with a face, or ?, say in SUPERGRIP-USER that its quote is missing."
  (dolist (name '("?" "X1" "X2" "Y1" "Y2" "Z1" "Z2"))
    (let ((symbol (intern name :supergrip-user)))
      (unless (fboundp symbol)
        (setf (macro-function symbol) #'call-of-face)))))

(define-face-calls)
