;;;; edit.lisp -- changing knowledge while at work, and seeing what a change changes.
;;;;
;;;; Knowledge is immutable: an edit makes new knowledge of the old forms and the new one, and only
;;;; if that is valid does it take effect.  Plans made before keep the old one.

(in-package :supergrip)

(defun put-into-force (accept make)
  "Put the knowledge that ACCEPT, a function, makes of MAKE into force; if it is wrong, the former
stays, and the KNOWLEDGE-ERROR says so."
  (setf *knowledge*
        (handler-bind ((knowledge-error
                         (lambda (condition)
                           (setf (knowledge-error-consequence condition)
                                 "The knowledge in force stays as it was."))))
          (funcall accept make))))

(defun accept-edit (make)
  "Return the knowledge that MAKE makes; if it is wrong, the restart CONTINUE returns the former."
  (restart-case (accept-knowledge make)
    (continue ()
      :report "Leave the knowledge in force as it was."
      *knowledge*)))

(defun reload-knowledge (&key rules grasps)
  "Read the files of the knowledge in force again, or the files RULES and GRASPS, and put what they
hold into force.  On a KNOWLEDGE-ERROR the former knowledge stays in force."
  (flet ((file (given in-force)
           (or given in-force)))
    (put-into-force #'accept-files
                    (lambda ()
                      (build-knowledge
                       (read-data-file (file rules (knowledge-rule-file *knowledge*)))
                       (read-data-file (file grasps (knowledge-grasp-file *knowledge*))))))))

(defun same-definition-p (form other)
  "True if FORM and OTHER define the same name in the same way."
  (and (consp form) (consp other) (consp (rest form)) (consp (rest other))
       (name= (first form) (first other)) (name= (second form) (second other))))

(defun place-of-new (form forms before)
  "Return where in FORMS the new FORM goes: before the rule BEFORE, or, if that is NIL, a rule before
the last one, which keeps the best; anything else at the end."
  (cond (before
         (or (position-if (lambda (other) (and (consp (rest other))
                                              (name= (second other) (or (name-of before) ""))))
                          forms)
             (error 'no-rule-error :name before
                                   :known (mapcar #'rule-name (knowledge-rules *knowledge*)))))
        ((part-p form "RULE") (max 0 (1- (length forms))))
        (t (length forms))))

(defun put-form (form forms before)
  "Return FORMS with FORM in the place of the one of its name; or, if there is none or BEFORE is
given, in a place of its own."
  (flet ((same-p (other) (same-definition-p form other)))
    (if (and (null before) (find-if #'same-p forms))
        (substitute-if form #'same-p forms)
        (let* ((others (remove-if #'same-p forms))
               (place (place-of-new form others before)))
          (append (subseq others 0 place) (list form) (nthcdr place others))))))

(defun edited-file (file edit)
  "Return the data file FILE with the forms that EDIT, a function, makes of its own."
  (let ((copy (copy-data-file file)))
    (setf (data-file-forms copy) (funcall edit (data-file-forms file)))
    copy))

(defun edit (form &key before)
  "Put FORM, (RULE ...), (SETQ grasp '(...)), (SETQ GRIPPER '(...)) or (DEFUN ...), into the knowledge
in force, in place of the one of its name.  A rule goes before the rule BEFORE if that is given; a
new one goes before the last by default.  A new grasp goes last.  Returns the new knowledge.

On a KNOWLEDGE-ERROR the former knowledge stays in force; the restart CONTINUE goes on with it.  The
files stay as they are: RELOAD-KNOWLEDGE takes edits back."
  (let ((form (canonical form)))
    (change-knowledge (part-p form "RULE") (lambda (forms) (put-form form forms before)))))

(defun change-knowledge (rules-p edit)
  "Put into force what becomes of the knowledge when EDIT, a function, changes the forms of its rules,
or of its grasps if RULES-P is false."
  (let ((rules (knowledge-rule-file *knowledge*))
        (grasps (knowledge-grasp-file *knowledge*)))
    (put-into-force #'accept-edit
                    (lambda ()
                      (if rules-p
                          (build-knowledge (edited-file rules edit) grasps)
                          (build-knowledge rules (edited-file grasps edit)))))))

(defun forget (name)
  "Take the rule or the grasp NAME, a symbol or a string, out of the knowledge in force, and return
the new knowledge.  On a KNOWLEDGE-ERROR, as when a rule still tries the grasp, the former stays.
The files stay as they are: RELOAD-KNOWLEDGE takes it back."
  (let* ((name (check-name name))
         (rule-p (find-rule (knowledge-rulebase *knowledge*) name)))
    (flet ((of-name-p (form)
             (and (part-p form (if rule-p "RULE" "SETQ")) (name= (second form) name))))
      (change-knowledge rule-p (lambda (forms) (remove-if #'of-name-p forms))))))

(defmacro rule (&whole form name &rest parts)
  "Put the rule NAME into the knowledge in force, as EDIT does: (RULE name (IF ...) (THEN ...))."
  (declare (ignore name parts))
  `(edit ',(cons 'rule (rest form))))

;;; SETQ at top level

(defun proper-list-p (object)
  "True if OBJECT is a list that ends."
  (and (listp object)
       (handler-case (list-length object)
         (type-error () nil))))         ; a dotted one

(defun quoted-list (form)
  "Return the list that FORM quotes, or NIL."
  (and (proper-list-p form) (eq (first form) 'quote) (= (length form) 2)
       (proper-list-p (second form))
       (second form)))

(defun definition-p (name list)
  "True if (SETQ NAME 'LIST) is a grasp or the gripper."
  (and list
       (or (name= name "GRIPPER")
           (loop for (key) on list by #'cddr thereis (name= key "USED-SURFACES")))))

(defun unquoted-p (name form)
  "True if FORM is a box, a grasp or a gripper whose quote was forgotten."
  (and (consp form)
       (or (and (name= name "BOX") (consp (first form)) (not (eq (caar form) 'lambda)))
           (and (name= name "GRIPPER") (assoc (first form) (knowledge-gripper *knowledge*)
                                              :test #'name=))
           (name= (first form) "USED-SURFACES"))))

(defmacro supergrip-user::setq (&rest pairs &environment environment)
  "SETQ, but at top level (SETQ name '(USED-SURFACES ...)) and (SETQ GRIPPER '(...)) edit the
knowledge in force.  Where a variable is meant, as inside a function, it is SETQ alone."
  (destructuring-bind (&optional name value)
      (if (and (proper-list-p pairs) (= (length pairs) 2)) pairs '())
    (cond ((not (and (namep name) (global-name-p name environment '(box))))
           `(cl:setq ,@pairs))
          ((definition-p name (quoted-list value))
           `(edit '(setq ,name ,value)))
          ((unquoted-p name value)
           `(refuse-argument "the quote is missing: write (setq ~(~a~) '(...))" ',name))
          (t `(cl:setq ,@pairs)))))
