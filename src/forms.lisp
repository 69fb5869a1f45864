;;;; forms.lisp -- the forms of the grasp file are checked and become trees of nodes.
;;;;
;;;; First of two stages: every operator, name and count is checked here, constants are computed,
;;;; helper functions are opened up, and infix conditions are put in order.  emit.lisp turns the
;;;; trees into functions.

(in-package :supergrip)

(defstruct node
  "One step of a form.  OP and ARGS say what it does; FORM is where it stood; REGISTERS, once
emitted, are those of its operands."
  op (args '() :type list) form (registers '()))

;;; The registers, one array of doubles, begin with what the box and the matching give.

(defconstant +u+ 0 "The register of U.")
(defconstant +v+ 1 "The register of V.")
(defconstant +distances+ 2 "The first of the registers of the distances along N, O, A.")
(defconstant +blocked+ 5 "The first of six registers, 1 for a slot whose face is constrained.")
(defconstant +inputs-end+ 11 "The first register after the inputs.")

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
      (complain name "unknown name ~a~a; known are U, V, the gripper's dimensions and what LET* ~
                      binds" name
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

(defun real-root (x)
  "The root of X, a double; an arithmetic error if X is below zero."
  (declare (double-float x))
  (if (< x 0d0)
      (error 'arithmetic-error :operation 'sqrt :operands (list x))
      (sqrt (the (double-float 0d0) x))))

(defun real-power (x y)
  "X to the power Y, doubles; an arithmetic error if that is no real."
  (declare (double-float x y))
  (let ((value (expt x y)))
    (if (typep value 'double-float)
        value
        (error 'arithmetic-error :operation 'expt :operands (list x y)))))

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

;;; Tests

(defparameter +comparisons+ '("<" "<=" ">" ">=" "=") "The comparisons, prefix or infix.")

(defun test-value (node)
  "Return T or :FALSE if NODE, a test, is so whatever the box; NIL if it depends."
  (case (node-op node) (:true t) (:false :false)))

(defun connective-p (object) (or (name= object "AND") (name= object "OR")))
(defun comparison-p (object) (name-in object +comparisons+))

(defun parse-test (form scope)
  "Return the node of FORM, which is true or false, or NIL after a complaint.
Tests are T, (CONSTRAINED N1), comparisons prefix (< a b) or infix (a < b), (NOT test), and tests
joined by AND and OR, prefix or infix; infix AND and OR have equal precedence and associate to
the right: a AND b OR c is a AND (b OR c)."
  (let ((*form* (if (and (consp form) (line-known-p form)) form *form*)))
    (cond ((too-many-steps-p) nil)
          ((name= form "T") (make-node :op :true :form form))
          ((not (consp form)) (complain form "~a is not a test" (form-text form)))
          ((part-p form "CONSTRAINED") (parse-constrained form))
          ((part-p form "NOT") (parse-not form scope))
          ((connective-p (first form)) (parse-prefix-connective form scope))
          ((comparison-p (first form)) (parse-comparison form (rest form) (first form) scope))
          ((null (rest form)) (parse-test (first form) scope))
          (t (parse-infix form scope)))))

(defun parse-constrained (form)
  (let ((slot (and (= (length form) 2)
                   (slot-index (if (part-p (second form) "QUOTE")
                                   (second (second form))
                                   (second form))))))
    (if slot
        (make-node :op :blocked :args (list slot) :form form)
        (complain form "~a: CONSTRAINED takes one of N1 N2 O1 O2 A1 A2" (form-text form)))))

(defun parse-not (form scope)
  (if (/= (length form) 2)
      (complain form "~a: NOT takes one test" (form-text form))
      (let ((test (parse-test (second form) scope)))
        (and test (negation test form)))))

(defun negation (test form)
  (case (node-op test)
    (:true (make-node :op :false :form form))
    (:false (make-node :op :true :form form))
    (t (make-node :op :not :args (list test) :form form))))

(defun parse-prefix-connective (form scope)
  (let ((tests (loop for test in (rest form) collect (parse-test test scope))))
    (cond ((null tests) (complain form "~a joins no tests" (first form)))
          ((member nil tests) nil)
          (t (reduce (lambda (a b) (connective (first form) a b form)) tests :from-end t)))))

(defun connective (name a b form)
  (let ((and-p (name= name "AND")))
    (cond ((eq (node-op a) (if and-p :true :false)) b)
          ((eq (node-op a) (if and-p :false :true)) a)
          (t (make-node :op (if and-p :and :or) :args (list a b) :form form)))))

(defun parse-infix (form scope)
  (let ((place (position-if #'connective-p form)))
    (cond ((null place)
           (if (and (= (length form) 3) (comparison-p (second form)))
               (parse-comparison form (list (first form) (third form)) (second form) scope)
               (complain form "~a is not a test: write (a < b), and join tests by AND and OR"
                         (form-text form))))
          ((or (zerop place) (= place (1- (length form))))
           (complain form "~a: ~a stands between two tests" (form-text form) (nth place form)))
          (t
           (let ((a (parse-test (infix-part (subseq form 0 place)) scope))
                 (b (parse-test (infix-part (nthcdr (1+ place) form)) scope)))
             (and a b (connective (nth place form) a b form)))))))

(defun infix-part (part)
  (if (rest part) part (first part)))

(defun parse-comparison (form operands name scope)
  (if (/= (length operands) 2)
      (complain form "~a: ~a compares two numbers" (form-text form) name)
      (let ((a (parse-number-form (first operands) scope))
            (b (parse-number-form (second operands) scope)))
        (and a b
             (let ((op (find-symbol (symbol-name name) :keyword)))
               (if (and (constant-p a) (constant-p b))
                   (make-node :op (if (funcall (comparison-function op)
                                               (constant-value a) (constant-value b))
                                      :true :false)
                              :form form)
                   (make-node :op op :args (list a b) :form form)))))))

(defun comparison-function (op)
  (ecase op (:< #'<) (:<= #'<=) (:> #'>) (:>= #'>=) (:= #'=)))

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
