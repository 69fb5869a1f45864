;;;; compile-forms.lisp -- trees of nodes become chains of closures.
;;;;
;;;; A program is the first closure of a chain.  Called with the registers, each writes one number
;;;; and calls the next; a comparison calls one of two.  The last returns true.  A test that is
;;;; false ends with NIL, and so does what has no value (see operators.lisp).
;;;;
;;;; Registers hold first what the box and the matching give, then the constants of all forms, then
;;;; results, until another program is run.  What was already computed on every way to a step is not
;;;; computed again.
;;;;
;;;; A closure can be made only when its registers and the next closure are known.  The registers
;;;; become known from the beginning of a chain on, the next closures from its end on.  So each step
;;;; first becomes a function from the next closure to its own.  These functions are linked
;;;; afterwards, from the end.

(in-package :supergrip)

(defstruct program
  "A form ready to run: FUNCTION, called with the registers, puts the results into the registers
RESULTS and returns true; NIL if they have no value, or if the form is a test that is false."
  (function nil :type function :read-only t)
  (results nil :type register-vector :read-only t))

(declaim (inline execute))
(defun execute (program registers)
  "Run PROGRAM on REGISTERS, those of its grasp base.  Return NIL if it is a test that is false or a
result has no value.  An arithmetic error is possible where the caller's float traps ask for it."
  (declare (type registers registers))
  (funcall (program-function program) registers))

;;; Registers

(defstruct layout
  "Which registers are taken: CONSTANTS maps the nodes of constants to registers, which end at BASE;
MOST are all that are used."
  (constants (make-hash-table :test #'eq))
  (base +inputs-end+ :type register) (most +inputs-end+ :type register))

(defun scope-layout (scope)
  "Return a layout with registers for all constants of SCOPE."
  (let ((constants (make-hash-table :test #'eq)) (base +inputs-end+))
    (loop for node being the hash-values of (scope-constants scope)
          do (setf (gethash node constants) base)
             (incf base))
    (make-layout :constants constants :base base :most base)))

(defun make-registers (layout)
  "Return registers for LAYOUT, the constants in place."
  (let ((registers (make-array (layout-most layout) :element-type 'double-float
                                                    :initial-element 0d0)))
    (loop for node being the hash-keys of (layout-constants layout) using (hash-value register)
          do (setf (aref registers register) (constant-value node)))
    registers))

;;; Code

(defstruct code
  "Code being written.  STEPS, the latest first, are functions from the next closure to that of the
step.  NODES and OPERATIONS say what is already computed: alists from nodes, and from operators with
their operands, to registers.  TOP is the first free register of LAYOUT."
  (steps '()) (nodes '()) (operations '()) (top 0 :type register) layout)

(defun new-code (layout)
  (make-code :layout layout :top (layout-base layout)))

(defun branch (code)
  "Return empty code that goes on where CODE is.  What it computes CODE will not know."
  (let ((branch (copy-code code)))
    (setf (code-steps branch) '())
    branch))

(defun add-step (code step)
  (push step (code-steps code)))

(defun link (code next)
  "Return the closure of CODE, which goes on with the closure NEXT."
  (dolist (step (code-steps code) next)
    (setf next (funcall step next))))

(defun new-register (code)
  (let ((layout (code-layout code)))
    (prog1 (code-top code)
      (incf (code-top code))
      (setf (layout-most layout) (max (layout-most layout) (code-top code))))))

;;; Numbers

(defun write-number (node code &optional to)
  "Write NODE, and return the register that will hold its number: TO, if it is given and the number
is in none yet."
  (or (done-node node code)
      (let ((register (write-new-number node code to)))
        (push (cons node register) (code-nodes code))
        register)))

(defun done-node (node code)
  "Return the register that holds the number of NODE, or NIL."
  (cdr (assoc node (code-nodes code) :test #'eq)))

(defun write-new-number (node code to)
  (node-case (:number node)
    (:constant () (gethash node (layout-constants (code-layout code))))
    (:input (register) register)
    (:let (nodes body)
      (dolist (node nodes)
        (write-number node code))
      (write-number body code to))
    (:operation (operator . nodes)
      (write-operation operator (write-operands nodes code) code to))
    (:cond (&rest clauses)
      (let ((to (or to (new-register code))))
        (write-clauses clauses code (lambda (node code) (write-number-into node code to)))
        to))))

(defun done-operation (operator operands code)
  "Return the register that holds what OPERATOR gives for OPERANDS, or NIL."
  (loop for ((done . from) . register) in (code-operations code)
        when (and (eq operator done) (equal operands from)) return register))

(defun write-operands (nodes code)
  "Write NODES, one or two, and return the operand of each: the register that will hold its number,
or the inner operation that gives it (see CLOSURE-ON)."
  (loop for node in nodes
        collect (or (and (eq (node-kind node) :operation)
                         ;; The same number twice, as in a square, is computed once.
                         (not (eq (first nodes) (second nodes)))
                         (not (done-node node code))
                         (write-inner-operation (node-args node) code))
                    (write-number node code))))

(defun write-inner-operation (operation code)
  "Write the arguments of OPERATION, an operator and nodes, and return its operand; NIL if it can't
be inside another operation."
  (destructuring-bind (operator . nodes) operation
    (when (arithmetic-inner operator)
      (let ((from (loop for node in nodes collect (write-number node code))))
        (or (done-operation operator from code)
            (cons (arithmetic-inner operator) from))))))

(defun write-operation (operator operands code to)
  "Write OPERATOR on OPERANDS, unless that is done.  Return the register of the result."
  (or (done-operation operator operands code)
      (let ((to (or to (new-register code))))
        (add-step code (lambda (next) (apply (arithmetic-step operator) next to operands)))
        (push (cons (cons operator operands) to) (code-operations code))
        to)))

(defun write-number-into (node code to)
  "Write NODE, so that the register TO will hold its number."
  (write-move code (write-number node code to) to))

(defun write-move (code from to)
  "Write that the register TO gets what FROM holds, unless they are one."
  (unless (= from to)
    (add-step code (lambda (next) (move-step next to from)))))

(defun move-step (next to from)
  (declare (function next) (type register to from))
  (lambda (registers)
    (declare (type registers registers))
    (setf (aref registers to) (aref registers from))
    (funcall next registers)))

(defun write-clauses (clauses code write-value)
  "Write the CLAUSES of a COND.  The function WRITE-VALUE writes a node into code."
  (destructuring-bind ((test value) . others) clauses
    (if (eq t (test-value test))
        (funcall write-value value code)
        (let ((decide (write-test test code))
              (then (branch code))
              (else (branch code)))
          (funcall write-value value then)
          (write-clauses others else write-value)
          (add-step code (lambda (next) (funcall decide (link then next) (link else next))))))))

;;; Lists of six

(defun write-six (node code &optional (to (make-list 6)))
  "Write NODE, and return the registers that will hold its six numbers, as WRITE-NUMBER does."
  (node-case (:six node)
    (:list (&rest entries)
      (loop for entry in entries
            for register in to
            collect (write-number entry code register)))
    (:let (nodes body)
      (dolist (node nodes)
        (write-number node code))
      (write-six body code to))
    (:cond (&rest clauses)
      (let ((to (if (first to) to (loop repeat 6 collect (new-register code)))))
        (write-clauses clauses code (lambda (node code) (write-six-into node code to)))
        to))
    (:computed (computation &rest nodes)
      (let ((from (loop for node in nodes collect (write-number node code)))
            (to (loop repeat (computation-count computation) collect (new-register code))))
        (add-step code (lambda (next)
                         (computation-step computation next (coerce from 'register-vector)
                                           (first to))))
        to))))

(defun write-six-into (node code to)
  (loop for from in (write-six node code to)
        for register in to
        do (write-move code from register)))

;;; Tests

(defun write-test (node code)
  "Write what NODE, a test, computes in any case.  Return a function from the closures to call next,
where it is true and where it is false, to the closure that decides."
  (node-case (:test node)
    (:true () (lambda (then else) (declare (ignore else)) then))
    (:false () (lambda (then else) (declare (ignore then)) else))
    (:not (test)
      (let ((decide (write-test test code)))
        (lambda (then else) (funcall decide else then))))
    (:and (a b)
      (let ((first (write-test a code)) (second (write-test-aside b code)))
        (lambda (then else) (funcall first (funcall second then else) else))))
    (:or (a b)
      (let ((first (write-test a code)) (second (write-test-aside b code)))
        (lambda (then else) (funcall first then (funcall second then else)))))
    (:constrained (grasp-face)
      (lambda (then else) (constrained-step then else (+ +blocked+ grasp-face))))
    (:comparison (comparison a b)
      (destructuring-bind (a b) (write-operands (list a b) code)
        (lambda (then else) (funcall (comparison-step comparison) then else a b))))))

(defun write-test-aside (node code)
  "As WRITE-TEST, of a test that is not always run: the closure that decides comes after what NODE
computes."
  (let* ((code (branch code))
         (decide (write-test node code)))
    (lambda (then else) (link code (funcall decide then else)))))

(defun constrained-step (then else grasp-face)
  (declare (function then else) (type register grasp-face))
  (lambda (registers)
    (declare (type registers registers))
    (if (= 1d0 (aref registers grasp-face)) (funcall then registers) (funcall else registers))))

;;; Programs

(defun finish-program (code results)
  "Return the program of CODE, which leaves its results in the registers RESULTS, a list."
  (make-program :function (link code (constantly t)) :results (coerce results 'register-vector)))

(defun numbers-program (nodes layout)
  "Return the program of NODES, which give numbers."
  (let ((code (new-code layout)))
    (finish-program code (loop for node in nodes collect (write-number node code)))))

(defun six-program (node layout)
  "Return the program of NODE, which gives six numbers."
  (let ((code (new-code layout)))
    (finish-program code (write-six node code))))

(defun test-program (node layout)
  "Return the program of NODE, a test."
  (let* ((code (new-code layout))
         (decide (write-test node code)))
    (add-step code (lambda (next) (funcall decide next (constantly nil))))
    (finish-program code '())))

(defun comparison-programs (node layout)
  "Return an alist from the comparisons in the test NODE to programs of their operands."
  (node-case (:test node)
    ((:true :false :constrained) () '())
    (:not (test) (comparison-programs test layout))
    ((:and :or) (a b) (append (comparison-programs a layout) (comparison-programs b layout)))
    (:comparison (comparison &rest operands)
      (declare (ignore comparison))
      (list (cons node (numbers-program operands layout))))))
