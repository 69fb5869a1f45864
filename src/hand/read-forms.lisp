;;;; read-forms.lisp -- the forms of the grasp file are checked and become trees of nodes.
;;;;
;;;; The first of two stages: every operator, name and count is checked here, constants are
;;;; computed, and helper functions are opened up.  compile-forms.lisp turns the trees into
;;;; closures.
;;;;
;;;; A form gives a number, six numbers, or is true or false.  What may stand first in one is a row:
;;;; of operators.lisp, or a DEFINE-FORM here.

(in-package :supergrip)

(defstruct node
  "One step of a form.  KIND and ARGS say what it does, FORM is where it stood.  What the ARGS of
each kind are:

:CONSTANT number               :TRUE, :FALSE
:INPUT register                :NOT test
:OPERATION operator number...  :AND test test, :OR test test
:LET (node...) body            :CONSTRAINED grasp-face
:COND (test value)...          :COMPARISON comparison number number
:LIST number...
:COMPUTED computation number...

A :LET computes its nodes, whether its body uses them or not."
  (kind nil :read-only t) (args '() :type list :read-only t) (form nil :read-only t))

(defun node (kind form &rest args)
  (make-node :kind kind :args args :form form))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter +node-kinds+
    '((:number :constant :input :operation :let :cond)
      (:six :list :let :cond :computed)
      (:test :true :false :not :and :or :constrained :comparison))
    "What a node gives, and the kinds of the nodes that give it."))

(defmacro node-case ((gives node) &body clauses)
  "Run that one of CLAUSES which is for the kind of NODE.  A clause is (KIND PARAMETERS form...) or
((KIND...) PARAMETERS form...); PARAMETERS take the arguments of the node.  What NODE GIVES is
known; an error at compile time says so if one of its kinds has no clause."
  (let ((kinds (rest (assoc gives +node-kinds+)))
        (handled (loop for (kinds) in clauses append (if (listp kinds) kinds (list kinds))))
        (the-node (gensym "NODE")))
    (when (set-exclusive-or kinds handled)
      (error "NODE-CASE: the kinds of nodes that give a ~a are ~s; this handles ~s" gives kinds
             handled))
    `(let ((,the-node ,node))
       (ecase (node-kind ,the-node)
         ,@(loop for (kinds parameters . body) in clauses
                 collect `(,kinds ,(if parameters
                                       `(destructuring-bind ,parameters (node-args ,the-node)
                                          ,@body)
                                       `(progn ,@body))))))))

(defun input-node (register)
  (node :input nil register))

(defun constant-p (node) (eq (node-kind node) :constant))
(defun constant-value (node) (first (node-args node)))
(defun zero-node-p (node) (and (constant-p node) (zerop (constant-value node))))

(defun test-value (node)
  "Return T or :FALSE if NODE, a test, is so whatever the box; NIL if it depends."
  (node-case (:test node)
    (:true () t)
    (:false () :false)
    ((:not :and :or :constrained :comparison) () nil)))

;;; What names mean

(defstruct scope
  "What names mean in a form: VARIABLES, an alist from name to node, of which GLOBALS are what
every form sees; FUNCTIONS, an alist from name to (PARAMETERS . BODY), the latest first, and BROKEN,
the names of those that are wrong; CONSTANTS, a table of the nodes of all forms' numbers.

DIMENSIONS are the entries of VARIABLES for the gripper's dimensions, ABSENT for those that it
lacks; USES is a table from such an entry to the DIMENSION-USEs of it, the latest first.  GRASP is
the name of the grasp that is being read.  GRIPPER-PLACE says where the gripper is, if not in the
same file."
  (variables '()) (globals '()) (functions '()) (broken '()) (constants (make-hash-table))
  (dimensions '()) (absent '()) (uses (make-hash-table :test #'eq)) (grasp nil) (gripper-place nil))

(defparameter +most-constants+ 16000
  "How many different numbers a grasp file may have.  They and the steps of a form take fewer
registers than there are.")

(defun constant-node (scope number)
  "Return the node of NUMBER, or NIL after a complaint if there are too many."
  (let* ((number (as-double number))
         (constants (scope-constants scope))
         ;; Doubles hash badly.
         (key (if (zerop number) number (rational number))))
    (cond ((gethash key constants))
          ((>= (hash-table-count constants) +most-constants+)
           (complain nil "more than ~d different numbers in one file" +most-constants+))
          (t (setf (gethash key constants) (node :constant nil number))))))

(defun bind-variable (scope name node)
  "Return SCOPE with the variable NAME, a string, bound to NODE."
  (let ((new (copy-scope scope)))
    (push (cons name node) (scope-variables new))
    new))

;;; Steps are counted

(defparameter +most-steps+ 8000
  "How many steps a form may have once its helpers are opened up: each may call the last twice.")

(defvar *steps-left* +most-steps+ "How many steps the form being read may still have.")
(defvar *counted-form* nil "The form whose steps are counted.")

(defmacro counting-steps ((form) &body body)
  "Run BODY, which reads FORM and complains if it has too many steps."
  `(let ((*steps-left* +most-steps+) (*counted-form* ,form))
     ,@body))

(defun count-step ()
  "Count a step.  Return NIL if it is one too many, after a complaint at the first."
  (decf *steps-left*)
  (when (= *steps-left* -1)
    (complain *counted-form* "more than ~d steps; each call of a helper counts as all steps of ~
                              the helper"
              +most-steps+))
  (>= *steps-left* 0))

;;; Forms, whatever they give

(defmacro define-form (name gives (form scope &optional (wanted (gensym "WANTED"))) &body body)
  "Define what a form that begins with NAME is, where one of what it GIVES is WANTED.  BODY returns
the node of FORM in SCOPE, or NIL after a complaint."
  `(add-operator (make-operator :name ,name :gives ',gives
                                :parse (lambda (,form ,scope ,wanted)
                                         (declare (ignorable ,scope ,wanted))
                                         ,@body))))

(defun placed (form)
  "Return FORM if it is a list whose line is known, or else *FORM*."
  (if (and (consp form) *lines* (gethash form *lines*)) form *form*))

(defun parse-form (form scope wanted)
  "Return the node of FORM, which gives what is WANTED: :NUMBER, :SIX or :TEST.  NIL after a
complaint."
  (let ((*form* (placed form)) (operator (form-operator form wanted)))
    (cond ((not (or (eq wanted :six) (count-step))) nil)
          (operator (funcall (operator-parse operator) form scope wanted))
          (t (ecase wanted
               (:number (parse-number-form form scope))
               (:six (parse-six form scope))
               (:test (parse-test form scope)))))))

(defun parse-forms (forms scope wanted)
  "Return the nodes of FORMS, or NIL after complaints."
  (let ((nodes (loop for form in forms collect (parse-form form scope wanted))))
    (and (notany #'null nodes) nodes)))

(defun form-operator (form wanted)
  "Return the operator that FORM begins with, if it can give what is WANTED, or NIL."
  (let ((operator (and (consp form) (namep (first form))
                       (find-operator (symbol-name (first form))))))
    (and operator (member wanted (operator-gives operator)) operator)))

(defun operator-names (wanted)
  "Return the names of the operators that give what is WANTED."
  (loop for operator in *operators*
        when (member wanted (operator-gives operator)) collect (operator-name operator)))

(defun check-argument-count (form least most)
  "Return true if FORM has LEAST to MOST (NIL: any) arguments, or complain."
  (let ((count (length (rest form))))
    (or (and (>= count least) (or (null most) (<= count most)))
        (complain form "~a takes ~d~@[ to ~d~] argument~p~:[~; or more~], here ~d: ~a"
                  (first form) least (and most (/= least most) most) (or most least) (null most)
                  count (form-text form)))))

;;; Numbers

(defun parse-number-form (form scope)
  "Return the node of FORM, which begins with no operator: a number, a name or a call of a helper."
  (cond ((realp form)
         (if (as-double form)
             (constant-node scope form)
             (complain form "~a is out of range" form)))
        ((namep form) (parse-variable form scope))
        ((and (consp form) (namep (first form))) (parse-call form scope))
        (t (complain form "~a is not a number, a name or an operation" (form-text form)))))

(defun note-use (entry scope)
  "Note that the grasp that is being read in SCOPE uses ENTRY, if that is a dimension."
  (let ((grasp (scope-grasp scope)))
    (when (and grasp (or (member entry (scope-dimensions scope) :test #'eq)
                         (member entry (scope-absent scope) :test #'eq)))
      (pushnew (make-dimension-use :dimension (car entry) :user grasp
                                   :place (form-place-text *form*))
               (gethash entry (scope-uses scope))
               :key #'dimension-use-user :test #'string=))))

(defun parse-variable (name scope)
  (let ((entry (assoc name (scope-variables scope) :test #'name=)))
    (cond (entry (note-use entry scope)
                 (cdr entry))
          (t (complain name "unknown name ~a~a; known are U, V, the gripper's dimensions~@[ ~
                             (~a)~], a helper's parameters and what LET* binds" name
                       (suggestion name (mapcar #'car (scope-variables scope)))
                       (scope-gripper-place scope))))))

(defun parse-arithmetic (form scope wanted)
  (declare (ignore wanted))
  (let ((operator (form-operator form :number)))
    (when (check-argument-count form (arithmetic-least operator) (arithmetic-most operator))
      (let ((nodes (parse-forms (rest form) scope :number)))
        (when nodes
          (check-sum form nodes)
          (arithmetic-node operator nodes form scope))))))

(defun arithmetic-node (operator nodes form scope)
  "Return the node of OPERATOR on NODES, which are more than it takes at once, or fewer."
  (let ((first (arithmetic-first operator)))
    (cond ((and first (null (rest nodes)))
           (operation-node operator (list (constant-node scope first) (first nodes)) form scope))
          ((eql 1 (arithmetic-most operator)) (operation-node operator nodes form scope))
          (t (reduce (lambda (a b) (operation-node operator (list a b) form scope)) nodes)))))

(defun operation-node (operator nodes form scope)
  "Return the node of OPERATOR on NODES, as many as it takes at once.  It is computed now if they
are constants.  NIL if one of them is NIL."
  (cond ((member nil nodes) nil)
        ((every #'constant-p nodes)
         (let ((value (operator-value operator (mapcar #'constant-value nodes))))
           (cond ((null value) (complain form "~a has no value" (form-text form)))
                 ((as-double value) (constant-node scope value))
                 (t (complain form "~a is out of range" (form-text form))))))
        (t (make-node :kind :operation :args (cons operator nodes) :form form))))

(defun parse-power (form scope wanted)
  "Return the node of FORM, a power; small whole powers are products."
  (declare (ignore wanted))
  (let ((nodes (and (check-argument-count form 2 2) (parse-forms (rest form) scope :number))))
    (when nodes
      (destructuring-bind (base power) nodes
        (if (and (constant-p power) (member (constant-value power) '(1d0 2d0 3d0 4d0)))
            (arithmetic-node (find-operator "*")
                             (loop repeat (round (constant-value power)) collect base)
                             form scope)
            (operation-node (form-operator form :number) nodes form scope))))))

(defun quoted-faces (form)
  "Return the grasp-faces that FORM, '(N1 N2), lists, or NIL."
  (let* ((list (and (part-p form "QUOTE") (second form)))
         (grasp-faces (and (consp list) (mapcar #'grasp-face-index list))))
    (and grasp-faces (notany #'null grasp-faces) grasp-faces)))

(define-form "DIST" (:number) (form scope)
  (let ((grasp-faces (and (= (length form) 2) (quoted-faces (second form)))))
    (if (and (= (length grasp-faces) 2) (= 1 (logxor (first grasp-faces) (second grasp-faces))))
        (input-node (+ +distances+ (floor (first grasp-faces) 2)))
        (complain form "~a: DIST takes two opposite faces, such as (DIST '(N1 N2))"
                  (form-text form)))))

;;; Sums that were products once: the scan of the paper reads (* 2 u) as (+ 2 u)

(defvar *sums* nil
  "NIL, or true in a form where each sum that was probably meant to be a product is warned of: in
one of six entries its number, else T.")

(defun friction-p (node)
  (and (eq (node-kind node) :input) (member (first (node-args node)) (list +u+ +v+))))

(defun factor-p (form node)
  "True if FORM, whose node is NODE, is a friction, a distance, or a number other than 1: a factor
as it stands.  Nobody multiplies by 1."
  (and (or (atom form) (part-p form "DIST"))
       (or (eq (node-kind node) :input)
           (and (constant-p node) (/= 1 (constant-value node))))))

(defun check-sum (form nodes)
  "Warn if FORM, with the NODES of its arguments, is a sum of factors, frictions and others."
  (when (and *sums* (part-p form "+")
             (every #'factor-p (rest form) nodes)
             (some #'friction-p nodes)
             (notevery #'friction-p nodes))
    (complain form '(:warning "~@[entry ~d: ~]~a is taken as it stands, a sum; the product ~a was ~
                               probably meant")
              (and (integerp *sums*) *sums*) (form-text form) (form-text (cons :* (rest form))))))

;;; Helper functions

(defun parse-call (form scope)
  "Return the node of FORM, a call of a helper of SCOPE: its body, opened up."
  (let* ((name (symbol-name (first form)))
         (function (assoc name (scope-functions scope) :test #'string=))
         (known (append (operator-names :number) (mapcar #'car (scope-functions scope)))))
    (cond (function (open-call form scope function))
          ;; The helper was already reported.
          ((member name (scope-broken scope) :test #'string=)
           (parse-forms (rest form) scope :number)
           nil)
          (t (complain form "unknown operator ~a~a in ~a; operators are ~{~a~^ ~}" name
                       (suggestion name known) (form-text form) known)))))

(defun open-call (form scope function)
  (destructuring-bind (name parameters . body) function
    (declare (ignore name))
    (when (check-argument-count form (length parameters) (length parameters))
      (let ((nodes (loop for argument in (rest form)
                         collect (parse-form argument scope :number)))
            (inner (copy-scope scope)))
        (unless (member nil nodes)
          (setf (scope-variables inner)
                (append (mapcar #'cons parameters nodes) (scope-globals scope))
                ;; A helper sees those before it, so none can call itself.
                (scope-functions inner) (rest (member function (scope-functions scope))))
          (let-node nodes (let ((*sums* nil)) (parse-form body inner :number)) form))))))

(defun let-node (nodes body form)
  "Return a node that computes NODES, as a Lisp call does, whether BODY uses them or not.  NIL if
BODY is."
  (let ((nodes (remove-if (lambda (node) (member (node-kind node) '(:constant :input))) nodes)))
    (if (and body nodes)
        (node :let form nodes body)
        body)))

;;; What numbers and lists of six have in common

(defun parse-binding (binding scope form)
  "Return the name and the node of BINDING, or NIL after a complaint."
  (if (and (consp binding) (namep (first binding)) (= (length binding) 2))
      (let ((node (parse-form (second binding) scope :number)))
        (and node (cons (symbol-name (first binding)) node)))
      (complain form "~a is not a binding, such as (r (/ (DIST '(N1 N2)) 2))" (form-text binding))))

(defun parse-let (form scope wanted sequential)
  (if (not (and (= (length form) 3) (listp (second form))))
      (complain form "~a is written (~:*~a ((name form)...) form)" (first form))
      (let ((inner scope) (nodes '()) (good t))
        (dolist (binding (second form))
          (let ((entry (parse-binding binding (if sequential inner scope) form)))
            (cond (entry (setf inner (bind-variable inner (car entry) (cdr entry)))
                         (push (cdr entry) nodes))
                  (t (setf good nil)))))
        (and good
             (let-node (nreverse nodes) (parse-form (third form) inner wanted) form)))))

(defun parse-clause (clause scope wanted form)
  "Return the test and the value of CLAUSE, or NIL after a complaint."
  (if (and (consp clause) (= (length clause) 2))
      (let ((test (parse-form (first clause) scope :test))
            (value (parse-form (second clause) scope wanted)))
        (and test value (list test value)))
      (complain form "~a is not a clause of COND, such as (T 0)" (form-text clause))))

(define-form "COND" (:number :six) (form scope wanted)
  (let ((clauses (loop for clause in (rest form)
                       collect (parse-clause clause scope wanted form))))
    (cond ((null clauses) (complain form "COND has no clause"))
          ((member nil clauses) nil)
          ((not (eq t (test-value (first (first (last clauses))))))
           (complain form "the last clause of COND must be (T ...), or a case has no value"))
          (t (make-node :kind :cond :args clauses :form form)))))

(define-form "IF" (:number :six) (form scope wanted)
  (if (/= (length form) 4)
      (complain form "IF is (IF test then else)")
      (let ((test (parse-form (second form) scope :test))
            (then (parse-form (third form) scope wanted))
            (else (parse-form (fourth form) scope wanted)))
        (and test then else
             (node :cond form (list test then) (list (node :true form) else))))))

(define-form "LET" (:number :six) (form scope wanted)
  (parse-let form scope wanted nil))

(define-form "LET*" (:number :six) (form scope wanted)
  (parse-let form scope wanted t))

;;; Lists of six

(defun parse-six (form scope)
  "Return the node of FORM, which begins with no operator: a list of six entries."
  (if (consp form)
      (parse-six-entries form form scope)
      (complain form "~a is not a list of six entries" (form-text form))))

(defun parse-six-entries (form entries scope)
  (let ((nodes (loop for entry in entries
                     for number from 1
                     collect (let ((*sums* (and *sums* number)))
                               (parse-form entry scope :number)))))
    (cond ((/= (length entries) 6)
           (complain form "~d entr~:@p, six are needed: along N O A, about N O A (OFFSET: N1 N2 O1 ~
                           O2 A1 A2)" (length entries)))
          ((notany #'null nodes) (make-node :kind :list :args nodes :form form)))))

(define-form "LIST" (:six) (form scope)
  (parse-six-entries form (rest form) scope))

(define-form "QUOTE" (:six) (form scope)
  (let ((entries (second form)))
    (if (and (listp entries) (every #'realp entries))
        (parse-six-entries form entries scope)
        (complain form "~a: what is quoted is not computed; write ~a" (form-text form)
                  (form-text (if (listp entries) (cons :list entries) '(:list 0 0 0 0 0 0)))))))

(defun entry-lists (node)
  "Return the lists of six nodes that NODE, which gives six numbers, has for its cases; none if it
computes them."
  (node-case (:six node)
    (:list (&rest entries) (list entries))
    (:let (nodes body) (declare (ignore nodes)) (entry-lists body))
    (:cond (&rest clauses) (loop for (nil value) in clauses append (entry-lists value)))
    (:computed () '())))

;;; Tests: T, (CONSTRAINED N1), comparisons prefix (< a b) or infix (a < b), (NOT test), and tests
;;; joined by AND and OR, prefix or infix; infix AND and OR have equal precedence and associate to
;;; the right: a AND b OR c is a AND (b OR c).

(defun connective-p (object) (or (name= object "AND") (name= object "OR")))

(defun named-comparison (object)
  "Return the comparison that OBJECT names, or NIL."
  (let ((operator (form-operator (list object) :test)))
    (and (comparison-p operator) operator)))

(defun parse-test (form scope)
  "Return the node of FORM, a test that begins with no operator, or NIL after a complaint."
  (cond ((name= form "T") (node :true form))
        ((not (consp form)) (complain form "~a is not a test" (form-text form)))
        ((null (rest form)) (parse-form (first form) scope :test))
        (t (parse-infix form scope))))

(define-form "CONSTRAINED" (:test) (form scope)
  (let ((grasp-face (and (= (length form) 2)
                   (grasp-face-index (if (part-p (second form) "QUOTE")
                                   (second (second form))
                                   (second form))))))
    (if grasp-face
        (node :constrained form grasp-face)
        (complain form "~a: CONSTRAINED takes one of N1 N2 O1 O2 A1 A2" (form-text form)))))

(define-form "NOT" (:test) (form scope)
  (if (/= (length form) 2)
      (complain form "~a: NOT takes one test" (form-text form))
      (let ((test (parse-form (second form) scope :test)))
        (and test
             (case (test-value test)
               ((t) (node :false form))
               (:false (node :true form))
               (t (node :not form test)))))))

(define-form "AND" (:test) (form scope)
  (parse-connective form scope))

(define-form "OR" (:test) (form scope)
  (parse-connective form scope))

(defun parse-connective (form scope)
  (let ((tests (parse-forms (rest form) scope :test)))
    (cond ((null (rest form)) (complain form "~a joins no tests" (first form)))
          (tests (reduce (lambda (a b) (connective-node (first form) a b form)) tests
                         :from-end t)))))

(defun connective-node (name a b form)
  "Return the node of A and B joined by NAME, AND or OR; of one that decides nothing, the other."
  (let* ((and-p (name= name "AND"))
         (value (test-value a)))
    (cond ((null value) (node (if and-p :and :or) form a b))
          ((eq and-p (eq value t)) b)
          (t a))))

(defun parse-infix (form scope)
  (let ((place (position-if #'connective-p form))
        (comparison (and (= (length form) 3) (named-comparison (second form)))))
    (cond ((and (null place) comparison)
           (comparison-node comparison (list (first form) (third form)) form scope))
          ((null place)
           (complain form "~a is not a test: write (a < b), and join tests by AND and OR"
                     (form-text form)))
          ((or (zerop place) (= place (1- (length form))))
           (complain form "~a: ~a stands between two tests" (form-text form) (nth place form)))
          (t
           (let ((a (parse-form (infix-part (subseq form 0 place)) scope :test))
                 (b (parse-form (infix-part (nthcdr (1+ place) form)) scope :test)))
             (and a b (connective-node (nth place form) a b form)))))))

(defun infix-part (part)
  (if (rest part) part (first part)))

(defun parse-prefix-comparison (form scope wanted)
  (declare (ignore wanted))
  (if (/= (length form) 3)
      (complain form "~a: ~a compares two numbers" (form-text form) (first form))
      (comparison-node (form-operator form :test) (rest form) form scope)))

(defun comparison-node (comparison operands form scope)
  "Return the node of COMPARISON between OPERANDS, two forms.  It is decided now if they are
constants."
  (let ((nodes (parse-forms operands scope :number)))
    (cond ((null nodes) nil)
          ((every #'constant-p nodes)
           (node (if (apply #'comparison-true-p comparison (mapcar #'constant-value nodes))
                     :true :false)
                 form))
          (t (make-node :kind :comparison :args (cons comparison nodes) :form form)))))
