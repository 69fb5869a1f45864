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
          (funcall accept make)))
  (define-grasp-words)
  *knowledge*)

(defun told-of-others (names)
  "Return the warnings of the knowledge in force that are not about the rules and grasps NAMES."
  (remove-if (lambda (problem)
               (loop for name in names
                       thereis (member (problem-subject problem)
                                       (list (plain-text "RULE ~a" name)
                                             (plain-text "GRASP ~a" name))
                                       :test #'equal)))
             (knowledge-warnings *knowledge*)))

(defun accept-edit (make names)
  "Return the knowledge that MAKE makes, in which NAMES are new; if it is wrong, CONTINUE, a
restart, returns the former."
  (restart-case (accept-knowledge make (told-of-others names))
    (continue ()
      :report "Leave the knowledge in force as it was."
      *knowledge*)))

(defun reload-knowledge (&key (hand nil hand-p)
                           (rules (if hand-p
                                      (knowledge-file "rules.lisp" hand)
                                      (knowledge-rule-file *knowledge*)))
                           (grasps (if hand-p
                                       (knowledge-file "grasps.lisp" hand)
                                       (knowledge-grasp-file *knowledge*)))
                           (gripper (if hand-p
                                        (and hand (hand-gripper hand))
                                        (knowledge-gripper-file *knowledge*))))
  "Read the files of the knowledge in force again, or the files RULES, GRASPS and GRIPPER, or those
of the folder HAND, as LOAD-KNOWLEDGE does, and put what they hold into force.  If HAND is given
and NIL, the files are those that are shipped.  If GRIPPER is NIL, the gripper is that of the grasp
file.  On a KNOWLEDGE-ERROR the former knowledge stays in force."
  (let ((files (list* rules grasps (and gripper (list gripper)))))
    (put-into-force #'accept-files
                    (lambda () (apply #'build-knowledge (mapcar #'read-data-file files))))))

(defun same-definition-p (form other)
  "True if FORM and OTHER define the same name, or declare the same sentence, in the same way."
  (and (consp form) (consp other) (consp (rest form)) (consp (rest other))
       (name= (first form) (first other))
       (if (input-form-p form)
           (equal (mapcar #'symbol-name (input-words form))
                  (mapcar #'symbol-name (input-words other)))
           (name= (second form) (second other)))))

(defun place-of-new (form forms before)
  "Return where in FORMS the new FORM goes: before the rule BEFORE, or, if that is NIL, a rule
before the last one, which keeps the best; anything else at the end."
  (cond (before
         (or (position-if (lambda (other) (and (consp (rest other))
                                              (name= (second other) (or (name-of before) ""))))
                          forms)
             (error 'no-rule-error :name before
                                   :known (mapcar #'rule-name (knowledge-rules *knowledge*)))))
        ((part-p form "RULE")
         (or (position-if-not #'input-form-p forms :from-end t) (length forms)))
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

;;; Definitions

(defun proper-list-p (object)
  "True if OBJECT is a list that ends."
  (and (listp object)
       (handler-case (list-length object)
         (type-error () nil))))         ; a dotted one

(defun quoted-form (form)
  "Return what FORM quotes, or else FORM."
  (if (and (part-p form "QUOTE") (proper-list-p form) (= (length form) 2))
      (second form)
      form))

(defun dimension-name-p (name)
  "True if NAME is that of a dimension that the gripper in force has, or may have."
  (or (assoc name (knowledge-gripper *knowledge*) :test #'name=)
      (assoc name +dimensions+ :test #'name=)))

(defun subject-of (name)
  "Return what NAME, which SETQ defines, is called in reports."
  (plain-text (cond ((name= name "GRIPPER") "~a")
                    ((dimension-name-p name) "GRIPPER, ~a")
                    (t "GRASP ~a"))
              name))

(defun put-definition (form forms before)
  "Return FORMS with the definition FORM put into them (see PUT-FORM)."
  (let* ((name (and (part-p form "SETQ") (= (length form) 3) (second form)))
         (value (and name (quoted-form (third form)))))
    (flet ((refuse (wanted)
             (error 'knowledge-error
                    :problems (list (make-problem
                                     :subject (subject-of name)
                                     :text (plain-text "~a is wanted, not ~a" wanted
                                                       (form-text value)))))))
      (cond ((not (namep name)) (put-form form forms before))
            ((not (dimension-name-p name))
             (when (atom value)
               (refuse (if (name= name "GRIPPER")
                           "a list '(FINGER-LENGTH 3.2 ...)"
                           "a list '(USED-SURFACES (N1 N2 A2) ...)")))
             (put-form form forms before))
            ((realp value) (with-dimension name value forms))
            (t (refuse "a number"))))))

(defun definitions (form)
  "Return the list of the definitions in FORM, of which a SETQ may hold several."
  (if (and (part-p form "SETQ") (nthcdr 3 form) (oddp (length form)))
      (loop for (name value) on (rest form) by #'cddr
            collect (list (first form) name value))
      (list form)))

(defun unreadable-key (list)
  "Return the key of LIST, that of a grasp, whose value can't be read, or NIL."
  (and (proper-list-p list)
       (loop for (key parts) in (split-entries list)
             when (handler-case (progn (canonical parts) nil)
                    (syntax-error () t))
               return (and (namep key) (string key)))))

(defun defined-name (form)
  "Return the name that FORM defines, as far as it has one."
  (and (consp form) (consp (rest form)) (second form)))

(defun with-names-for-strings (form)
  "Return FORM with the names that its strings spell in their place."
  (if (consp form)
      (loop for part in form
            append (or (and (stringp part) (words-in part))
                       (list (with-names-for-strings part))))
      form))

(defun canonical-definition (form)
  "Return FORM as the data reader would have returned it, with names for strings.  Of what can't be
read, the name of the grasp and the key are told."
  (handler-bind ((syntax-error
                   (lambda (condition)
                     (when (and (part-p form "SETQ") (proper-list-p form) (namep (second form)))
                       (dolist (problem (input-error-problems condition))
                         (setf (problem-subject problem) (subject-of (second form))
                               (problem-place problem)
                               (unreadable-key (quoted-form (third form)))))))))
    (let ((form (canonical form)))
      (if (part-p form "DEFUN") form (with-names-for-strings form)))))

(defun edit (form &key before)
  "Put FORM, (RULE ...), (INPUT ...), (SETQ grasp '(...)), (SETQ GRIPPER '(...)), (SETQ dimension
number) or (DEFUN ...), into the knowledge in force, in place of the one of its name.  A rule goes
before the rule BEFORE if that is given; a new one goes before the last by default.  A new grasp
goes last.  What one SETQ defines takes effect together.  Returns the new knowledge.

On a KNOWLEDGE-ERROR the former knowledge stays in force; the restart CONTINUE goes on with it.  The
files stay as they are: RELOAD-KNOWLEDGE takes edits back."
  (let ((form (canonical-definition form)))
    (change-knowledge (mapcar (lambda (definition)
                                (list (file-kind definition)
                                      (lambda (forms) (put-definition definition forms before))))
                              (definitions form))
                      (mapcar #'defined-name (definitions form)))))

(defun file-kind (definition)
  "Return which file DEFINITION belongs to: :RULES, :GRASPS or :GRIPPER."
  (cond ((or (part-p definition "RULE") (input-form-p definition)) :rules)
        ((or (gripper-form-p definition)
             (and (part-p definition "SETQ") (dimension-name-p (defined-name definition))))
         :gripper)
        (t :grasps)))

(defun change-knowledge (edits &optional names)
  "Put into force what becomes of the knowledge with EDITS, a list of (KIND FUNCTION), in which each
FUNCTION changes the forms of the file of its KIND (see FILE-KIND); NAMES are those of what is new."
  (let* ((rules (knowledge-rule-file *knowledge*))
         (grasps (knowledge-grasp-file *knowledge*))
         (gripper (knowledge-gripper-file *knowledge*)))
    (put-into-force (lambda (make) (accept-edit make names))
                    (lambda ()
                      (loop for (kind edit) in edits
                            do (cond ((eq kind :rules) (setf rules (edited-file rules edit)))
                                     ((and gripper (eq kind :gripper))
                                      (setf gripper (edited-file gripper edit)))
                                     (t (setf grasps (edited-file grasps edit)))))
                      (build-knowledge rules grasps gripper)))))

(defun forget (name)
  "Take the rule or the grasp NAME, a symbol or a string, or the declaration of the words NAME, out
of the knowledge in force, and return the new knowledge.  On a KNOWLEDGE-ERROR, as when a rule still
tries the grasp, the former stays.  The files stay as they are: RELOAD-KNOWLEDGE takes it back."
  (let ((declaration (named-declaration name)))
    (if declaration
        (change-knowledge `((:rules ,(lambda (forms)
                                       (remove-if (lambda (form)
                                                    (same-definition-p declaration form))
                                                  forms)))))
        (let* ((name (check-name name))
               (rule-p (find-rule (knowledge-rulebase *knowledge*) name)))
          (flet ((of-name-p (form)
                   (and (part-p form (if rule-p "RULE" "SETQ")) (name= (second form) name))))
            (change-knowledge `((,(if rule-p :rules :grasps)
                                 ,(lambda (forms) (remove-if #'of-name-p forms))))))))))

(defun named-declaration (name)
  "Return the (INPUT ...) in force of the words NAME, unless a rule or a grasp has this name; or
NIL."
  (let* ((words (name-of name))
         (predicate (and words (not (in-force-p words))
                         (find-predicate (knowledge-rulebase *knowledge*) (list words)))))
    (and predicate (declared-p predicate)
         (input-declaration-form (predicate-given predicate)))))

(defmacro rule (&whole form name &rest parts)
  "Put the rule NAME into the knowledge in force, as EDIT does: (RULE name (IF ...) (THEN ...))."
  (declare (ignore name parts))
  `(edit ',(cons 'rule (rest form))))

(defmacro supergrip-user:input (&whole form &rest sentence)
  "Declare that boxes may say SENTENCE, as EDIT does: (INPUT FRAGILE (s1))."
  (declare (ignore sentence))
  `(edit ',(cons 'input (rest form))))

;;; SETQ, of words that are typed like variables and at top level

(defun (setf word) (value name)
  "Make VALUE the grasp NAME, the gripper or its dimension NAME; the other words only show."
  (when (member name '("POSSIBLE-GRASPS" "ASSERTIONS" "RULES" "GRASPS") :test #'string=)
    (refuse-argument "~a shows what SUPER-GRIP holds, and can't be set: give your variable another ~
                      name" name))
  (edit `(setq ,(make-symbol name) ',value))
  value)

(defun listed-form (form)
  "Return the list that FORM, '(...), `(...) or (LIST ...), makes, as far as one sees; or NIL."
  (let ((list (cond ((backquote-p form) (second form))
                    ((and (proper-list-p form) (eq (first form) 'list))
                     (mapcar #'quoted-form (rest form)))
                    ((not (eq form (quoted-form form))) (quoted-form form)))))
    (and (proper-list-p list) list)))

(defun defining-list-p (list)
  "True if LIST is meant to be a grasp or a gripper: it begins with USED-SURFACES, or gives values
to two keys."
  (flet ((count-given (keys)
           (loop for (part next) on list
                 count (and (begins-entry-p part keys)
                            (if (consp part)
                                (rest part)
                                (and next (not (begins-entry-p next keys))))))))
    (or (and (proper-list-p (first list)) (rest (first list)) (null (rest list))
             (defining-list-p (first list))) ; a parenthesis too many
        (begins-entry-p (first list) '("USED-SURFACES"))
        (> (count-given +grasp-keys+) 1)
        (> (count-given (mapcar #'first +dimensions+)) 1))))

(defun defined-name-p (name)
  "True if NAME has a meaning in the grasp file in force."
  (or (name= name "GRIPPER")
      (dimension-name-p name)
      (find-grasp (knowledge-graspbase *knowledge*) (string name))))

(defun quote-missing-p (name form)
  "True if FORM is a box, a grasp or a gripper whose quote was forgotten."
  (and (proper-list-p form) form
       (or (and (name= name "BOX") (consp (first form)) (not (eq (caar form) 'lambda)))
           (and (name= name "GRIPPER") (dimension-name-p (first form)))
           (begins-entry-p (first form) '("USED-SURFACES"))
           (and (begins-entry-p (first form)) (defining-list-p form)))))

(defun meant-dimension (name)
  "Return the phrase that suggests the dimension that NAME was probably meant to be."
  (suggestion name (mapcar #'car (append (knowledge-gripper *knowledge*) +dimensions+))))

(defun set-variable (name value)
  "Give the variable NAME the VALUE, unless that is a number for a dimension that is misspelt."
  (when (realp value)
    (refuse-argument "~a is not a dimension of the gripper~a; (cl:setq ~(~a~) ~a) sets a variable"
                     name (meant-dimension name) name (form-text value)))
  (set name value))

(defun assignment (name value environment)
  "Return a form that gives the variable NAME the VALUE, a form; or, if that is a definition, NIL
and forms of the name and the value of a SETQ for EDIT."
  (cond ((not (and (namep name) (global-name-p name environment (cons 'box *typed-words*))))
         `(cl:setq ,name ,value))
        ((quote-missing-p name value)
         `(refuse-argument "the quote is missing: write (setq ~(~a~) '(...))" ',name))
        ((or (defined-name-p name) (defining-list-p (listed-form value)))
         (values nil `(',name (list 'quote ,value))))
        ((string= "" (meant-dimension name)) `(cl:setq ,name ,value))
        ;; A call: where it is not, SBCL expands the macro again, no more at top level.
        (t `(set-variable ',name ,value))))

(defmacro supergrip-user:setq (&rest pairs &environment environment)
  "Do what CL:SETQ does; but at top level (SETQ name '(USED-SURFACES ...)), (SETQ GRIPPER '(...))
and (SETQ dimension number) edit the knowledge in force.  Several pairs at once take effect
together.  Where a variable is meant, as inside a function, it is CL:SETQ alone."
  (let ((forms '()) (definitions '()))
    (flet ((add (form)
             (when definitions
               (push `(edit (list 'setq ,@(shiftf definitions '()))) forms))
             (when form (push form forms))))
      (if (and (proper-list-p pairs) (evenp (length pairs)))
          (loop for (name value) on pairs by #'cddr
                do (multiple-value-bind (form definition) (assignment name value environment)
                     (if form (add form) (setf definitions (append definitions definition)))))
          (add `(cl:setq ,@pairs)))
      (add nil)
      (if (rest forms) `(progn ,@(reverse forms)) (first forms)))))
