;;;; forms.lisp -- the forms of the grasp file are checked and become trees of nodes.
;;;;
;;;; First of two stages: every operator, name and count is checked here, constants are computed,
;;;; and helper functions are opened up.  testforms.lisp does the same for what is true or false;
;;;; emit.lisp turns the trees into programs of the machine.

(in-package :supergrip)

(defstruct node
  "One step of a form.  OP and ARGS say what it does; FORM is where it stood."
  op (args '() :type list) form)

(defun input-node (register)
  (make-node :op :input :args (list register)))

(defstruct scope
  "What names mean in a form: VARIABLES, an alist from name to node, of which GLOBALS are what
every form sees; FUNCTIONS, an alist from name to (PARAMETERS . BODY), the latest first, and BROKEN,
the names of those that are wrong; CONSTANTS, a table of the nodes of all forms' numbers."
  (variables '()) (globals '()) (functions '()) (broken '()) (constants (make-hash-table)))

(defparameter +most-steps+ 8000
  "How many steps a form may have once its helpers are opened up: each may call the last twice.")

(defparameter +most-constants+ 16000
  "How many different numbers a grasp file may have.  Six forms of a grasp, each with the most steps,
and these take fewer registers than there are.")

(defvar *steps-left* +most-steps+ "How many steps the form being read may still have.")
(defvar *counted-form* nil "The form whose steps are counted.")

(defmacro counting-steps ((form) &body body)
  "Run BODY, which reads FORM and complains if it has too many steps."
  `(let ((*steps-left* +most-steps+) (*counted-form* ,form))
     ,@body))

(defun too-many-steps-p ()
  "Count a step, and return true, after a complaint at the first, if it is one too many."
  (when (minusp (decf *steps-left*))
    (when (= *steps-left* -1)
      (complain *counted-form* "more than ~d steps, with the helpers that it calls put in their ~
                                places" +most-steps+))
    t))

(defun constant-node (scope number)
  (let* ((number (as-double number))
         (constants (scope-constants scope))
         ;; Doubles hash badly.
         (key (if (zerop number) number (rational number))))
    (cond ((gethash key constants))
          ((>= (hash-table-count constants) +most-constants+)
           (complain nil "more than ~d different numbers in one file" +most-constants+))
          (t (setf (gethash key constants)
                   (make-node :op :constant :args (list number)))))))

(defun constant-p (node) (eq (node-op node) :constant))
(defun constant-value (node) (first (node-args node)))

(defun bind-variable (scope name node)
  "Return SCOPE with the variable NAME, a string, bound to NODE."
  (let ((new (copy-scope scope)))
    (push (cons name node) (scope-variables new))
    new))

;;; Numbers

(defparameter +arithmetic+
  '(("+" 1) ("-" 1) ("*" 1) ("/" 1 2) ("SQRT" 1 1) ("EXPT" 2 2) ("MIN" 1) ("MAX" 1) ("ABS" 1 1)
    ("POSIT" 1 1))
  "The operators on numbers, with their least and greatest count of arguments.")

(defparameter +special-forms+ '("DIST" "COND" "IF" "LET" "LET*")
  "The other operators of a form that gives a number.")

(defun parse-number-form (form scope)
  "Return the node of FORM, which gives a number, or NIL after a complaint."
  (let ((*form* (if (and (consp form) (line-known-p form)) form *form*)))
    (cond ((too-many-steps-p) nil)
          ((realp form)
           (if (as-double form) (constant-node scope form) (complain form "~a is out of range" form)))
          ((namep form) (parse-variable form scope))
          ((and (consp form) (namep (first form))) (parse-operation form scope))
          (t (complain form "~a is not a number, a name or an operation" (form-text form))))))

(defun line-known-p (form) (and *lines* (gethash form *lines*)))

(defun parse-variable (name scope)
  (or (cdr (assoc name (scope-variables scope) :test #'name=))
      (complain name "unknown name ~a~a; known are U, V, the gripper's dimensions, a helper's ~
                      parameters and what LET* binds" name
                (suggestion (symbol-name name) (mapcar #'car (scope-variables scope))))))

(defun parse-operation (form scope)
  (let* ((name (symbol-name (first form)))
         (arithmetic (assoc name +arithmetic+ :test #'string=))
         (function (assoc name (scope-functions scope) :test #'string=)))
    (cond (arithmetic (parse-arithmetic form scope (second arithmetic) (third arithmetic)))
          (function (parse-call form scope function))
          ((string= name "DIST") (parse-dist form))
          ((string= name "COND") (parse-cond form scope #'parse-number-form))
          ((string= name "IF") (parse-if form scope #'parse-number-form))
          ((string= name "LET*") (parse-let form scope #'parse-number-form t))
          ((string= name "LET") (parse-let form scope #'parse-number-form nil))
          ;; Of the helper enough was said.
          ((member name (scope-broken scope) :test #'string=) (parse-arguments form scope) nil)
          (t (complain form "unknown operator ~a~a in ~a; operators are ~{~a~^ ~}" name
                       (suggestion name (operators scope)) (form-text form) (operators scope))))))

(defun operators (scope)
  (append (mapcar #'first +arithmetic+) +special-forms+ (mapcar #'car (scope-functions scope))))

(defun wrong-count (form least most)
  "Complain, and return true, if FORM does not have LEAST to MOST arguments."
  (let ((count (length (rest form))))
    (when (or (< count least) (and most (> count most)))
      (complain form "~a takes ~d~@[ to ~d~] argument~p~:[~; or more~], here ~d: ~a"
                (first form) least (and most (/= least most) most) (or most least) (null most)
                count (form-text form))
      t)))

(defun parse-arguments (form scope)
  "Return the nodes of the arguments of FORM, or NIL after a complaint."
  (let ((nodes (loop for argument in (rest form) collect (parse-number-form argument scope))))
    (and (notany #'null nodes) nodes)))

(defun parse-arithmetic (form scope least most)
  (unless (wrong-count form least most)
    (let ((nodes (parse-arguments form scope)))
      (and nodes (arithmetic-node (symbol-name (first form)) nodes form scope)))))

(defun arithmetic-node (name nodes form scope)
  "Return the node of the operator NAME on NODES: operators of many arguments become pairs."
  (flet ((make (op &rest nodes) (operation op nodes form scope))
         (zero () (constant-node scope 0)))
    (cond ((string= name "POSIT") (make :max (first nodes) (zero)))
          ((string= name "ABS")
           (make :max (first nodes) (make :- (zero) (first nodes))))
          ((string= name "SQRT") (make :sqrt (first nodes)))
          ((string= name "EXPT") (power-node nodes form scope))
          ((and (string= name "-") (null (rest nodes))) (make :- (zero) (first nodes)))
          ((and (string= name "/") (null (rest nodes)))
           (make :/ (constant-node scope 1) (first nodes)))
          (t (reduce (lambda (a b) (make (find-symbol name :keyword) a b)) nodes)))))

(defun power-node (nodes form scope)
  "Return the node of a power; small whole powers are products."
  (destructuring-bind (base power) nodes
    (if (and (constant-p power) (member (constant-value power) '(1d0 2d0 3d0 4d0)))
        (let ((node base))
          (loop repeat (1- (round (constant-value power)))
                do (setf node (operation :* (list node base) form scope)))
          node)
        (operation :expt nodes form scope))))

(defun operation (op nodes form scope)
  "Return the node of OP on NODES, computed at once if they are constants.  NIL if one is NIL."
  (cond ((member nil nodes) nil)
        ((every #'constant-p nodes)
         (handler-case
             (let ((value (as-double (apply (operator-function op)
                                            (mapcar #'constant-value nodes)))))
               (if value
                   (constant-node scope value)
                   (complain form "~a is out of range" (form-text form))))
           (arithmetic-error () (complain form "~a has no value" (form-text form)))))
        (t (make-node :op op :args nodes :form form))))

(defun operator-function (op)
  (ecase op (:+ #'+) (:- #'-) (:* #'*) (:/ #'/) (:min #'min) (:max #'max)
    (:sqrt #'real-root) (:expt #'real-power)))

(defun quoted-slots (form)
  "Return the slots that FORM, '(N1 N2), lists, or NIL."
  (let* ((list (and (part-p form "QUOTE") (second form)))
         (slots (and (consp list) (mapcar #'slot-index list))))
    (and slots (notany #'null slots) slots)))

(defun parse-dist (form)
  (let ((slots (and (= (length form) 2) (quoted-slots (second form)))))
    (if (and (= (length slots) 2) (= 1 (logxor (first slots) (second slots))))
        (input-node (+ +distances+ (floor (first slots) 2)))
        (complain form "~a: DIST takes two opposite faces, as (DIST '(N1 N2))" (form-text form)))))

(defun parse-call (form scope function)
  (destructuring-bind (name parameters . body) function
    (declare (ignore name))
    (unless (wrong-count form (length parameters) (length parameters))
      (let ((nodes (parse-arguments form scope)))
        (and nodes
             (let ((inner (copy-scope scope)))
               (setf (scope-variables inner)
                     (append (mapcar #'cons parameters nodes) (scope-globals scope))
                     ;; A helper sees those before it, so none can call itself.
                     (scope-functions inner) (rest (member function (scope-functions scope))))
               (let ((body (parse-number-form body inner)))
                 (and body (eager-node nodes body form)))))))))

(defun eager-node (nodes body form)
  "Return a node that computes NODES, as a Lisp call does, whether BODY uses them or not."
  (let ((nodes (remove-if (lambda (node) (member (node-op node) '(:constant :input))) nodes)))
    (if nodes
        (make-node :op :let :args (list nodes body) :form form)
        body)))

;;; LET, COND and IF serve numbers and lists of six alike; PARSE reads what they give.

(defun parse-binding (binding scope form)
  "Return the name and the node of BINDING, or NIL after a complaint."
  (if (and (consp binding) (namep (first binding)) (= (length binding) 2))
      (let ((node (parse-number-form (second binding) scope)))
        (and node (cons (symbol-name (first binding)) node)))
      (complain form "~a is not a binding, as (r (/ (DIST '(N1 N2)) 2))" (form-text binding))))

(defun parse-let (form scope parse sequential)
  (if (not (and (= (length form) 3) (listp (second form))))
      (complain form "~a is (~:*~a ((name form)...) form)" (first form))
      (let ((inner scope) (nodes '()) (good t))
        (dolist (binding (second form))
          (let ((entry (parse-binding binding (if sequential inner scope) form)))
            (cond (entry (setf inner (bind-variable inner (car entry) (cdr entry)))
                         (push (cdr entry) nodes))
                  (t (setf good nil)))))
        (and good
             (let ((body (funcall parse (third form) inner)))
               (and body (eager-node (nreverse nodes) body form)))))))

(defun parse-cond (form scope parse)
  (let ((branches
          (loop for clause in (rest form)
                collect (if (and (consp clause) (= (length clause) 2))
                            (let ((test (parse-test (first clause) scope))
                                  (value (funcall parse (second clause) scope)))
                              (and test value (list test value)))
                            (complain form "~a is not a clause of COND, as (T 0)"
                                      (form-text clause))))))
    (cond ((or (null branches) (member nil branches))
           (if branches nil (complain form "COND has no clause")))
          ((not (eq t (test-value (first (first (last branches))))))
           (complain form "the last clause of COND must be (T ...), or a case has no value"))
          (t (make-node :op :cond :args branches :form form)))))

(defun parse-if (form scope parse)
  (if (/= (length form) 4)
      (complain form "IF is (IF test then else)")
      (let ((test (parse-test (second form) scope))
            (then (funcall parse (third form) scope))
            (else (funcall parse (fourth form) scope)))
        (and test then else
             (make-node :op :cond :form form
                        :args (list (list test then) (list (make-node :op :true) else)))))))

;;; Lists of six

(defun parse-six (form scope)
  "Return the node of FORM, which gives six numbers: a list of six entries, or one form, LIST,
LET*, LET, COND or IF, that gives them.  NIL after a complaint."
  (let ((*form* (if (and (consp form) (line-known-p form)) form *form*)))
    (cond ((not (consp form)) (complain form "~a is not a list of six entries" (form-text form)))
          ((part-p form "LIST") (parse-six-entries form (rest form) scope))
          ((part-p form "LET*") (parse-let form scope #'parse-six t))
          ((part-p form "LET") (parse-let form scope #'parse-six nil))
          ((part-p form "COND") (parse-cond form scope #'parse-six))
          ((part-p form "IF") (parse-if form scope #'parse-six))
          (t (parse-six-entries form form scope)))))

(defun parse-six-entries (form entries scope)
  (let ((nodes (loop for entry in entries collect (parse-number-form entry scope))))
    (cond ((/= (length entries) 6)
           (complain form "~d entr~:@p, six are needed: along N O A, about N O A (OFFSET: N1 N2 O1 ~
                           O2 A1 A2)" (length entries)))
          ((notany #'null nodes)
           (make-node :op :list :args nodes :form form)))))
