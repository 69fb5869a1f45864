;;;; emit.lisp -- trees of nodes become functions over registers.
;;;;
;;;; Second of two stages.  All numbers live in one array of doubles, the registers: first what
;;;; the box and the matching give, then the constants of all forms, then intermediate results.
;;;; A form becomes a list of steps.  A step is an operation, packed in one integer, that reads two
;;;; registers and writes one, or a function that takes a branch; so nothing is boxed.  A step that
;;;; was already done in the same list is not done again.

(in-package :supergrip)

(deftype registers () '(simple-array double-float (*)))
(deftype register () '(unsigned-byte 16))

(defstruct layout
  "Where numbers are: CONSTANTS maps the nodes of constants to registers, which end at BASE; TOP is
the first register that is free, MOST the most that were ever used."
  (constants (make-hash-table :test #'eq))
  (base +inputs-end+ :type register) (top +inputs-end+ :type register)
  (most +inputs-end+ :type register))

(defun scope-layout (scope)
  "Return a layout with registers for all constants of SCOPE."
  (let ((layout (make-layout)))
    (loop for node being the hash-values of (scope-constants scope)
          do (setf (gethash node (layout-constants layout)) (layout-base layout))
             (incf (layout-base layout)))
    (release-registers layout)
    layout))

(defun release-registers (layout)
  "Let the next form use the registers of intermediate results again."
  (setf (layout-most layout) (max (layout-most layout) (layout-base layout))
        (layout-top layout) (layout-base layout)))

(defun make-registers (layout)
  "Return registers for LAYOUT, the constants in place."
  (let ((registers (make-array (layout-most layout) :element-type 'double-float
                                                    :initial-element 0d0)))
    (loop for node being the hash-keys of (layout-constants layout) using (hash-value register)
          do (setf (aref registers register) (constant-value node)))
    registers))

(defstruct code
  "A list of steps being emitted: STEPS, the latest first; DONE, what is already computed, by node
and by operator and registers; LAYOUT."
  (steps '()) (done '()) layout)

(defun inner-code (code)
  "Return an empty list of steps that run after those of CODE, perhaps not always."
  (make-code :done (code-done code) :layout (code-layout code)))

(defun new-register (code)
  (let ((layout (code-layout code)))
    (prog1 (layout-top layout)
      (incf (layout-top layout))
      (setf (layout-most layout) (max (layout-most layout) (layout-top layout))))))

(defmacro with-branch-registers ((code) &body body)
  "Run BODY, which emits a branch for CODE; the registers that it takes are free again after it."
  `(let* ((layout (code-layout ,code))
          (top (layout-top layout)))
     (prog1 (progn ,@body)
       (setf (layout-top layout) top))))

(defmacro step-function ((registers) &body body)
  `(lambda (,registers)
     (declare (type registers ,registers))
     ,@body))

(defun emit (node code)
  "Emit NODE, which gives a number, and return the register that will hold it."
  (or (cdr (assoc node (code-done code) :test #'eq))
      (let ((register (emit-node node code)))
        (push (cons node register) (code-done code))
        register)))

(defun emit-node (node code)
  (ecase (node-op node)
    (:constant (gethash node (layout-constants (code-layout code))))
    (:input (first (node-args node)))
    (:let (dolist (eager (first (node-args node)))
            (emit eager code))
     (emit (second (node-args node)) code))
    (:cond (emit-cond node code))
    ((:sqrt) (emit-operation (node-op node) (emit (first (node-args node)) code) 0 code))
    ((:+ :- :* :/ :min :max :expt)
     (let* ((a (emit (first (node-args node)) code))
            (b (emit (second (node-args node)) code)))
       (emit-operation (node-op node) a b code)))))

(defun emit-operation (op a b code)
  "Emit OP on the registers A and B, unless it is already done."
  (let ((key (list op a b)))
    (or (cdr (assoc key (code-done code) :test #'equal))
        (let ((register (new-register code)))
          (push (pack-operation op a b register) (code-steps code))
          (push (cons key register) (code-done code))
          register))))

;;; Operations: the number of the operator, and the registers of two operands and of the result.

(deftype operations () '(simple-array (unsigned-byte 62) (*)))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter +operators+ #(:+ :- :* :/ :min :max :sqrt :expt)))

(defun pack-operation (op a b to)
  "Return the operation that stores OP of the registers A and B in the register TO."
  (declare (type register a b to))
  (logior (position op +operators+) (ash a 4) (ash b 20) (ash to 36)))

(defun run-operations (operations r)
  "Do OPERATIONS, in order, on the registers R."
  (declare (type operations operations) (type registers r))
  (loop for operation across operations
        do (symbol-macrolet ((a (aref r (ldb (byte 16 4) operation)))
                             (b (aref r (ldb (byte 16 20) operation)))
                             (to (aref r (ldb (byte 16 36) operation))))
             (let ((x a) (y b))
               (macrolet ((store (&rest results)
                            `(ecase (ldb (byte 4 0) operation)
                               ,@(loop for (op form) in results
                                       collect `(,(position op +operators+) (setf to ,form))))))
                 ;; What is called gets A and B: X and Y are never boxed then.
                 (store (:+ (+ x y))
                        (:- (- x y))
                        (:* (* x y))
                        (:/ (/ x y))
                        (:min (if (< y x) y x))
                        (:max (if (> y x) y x))
                        (:sqrt (if (< x 0d0) (real-root a) (sqrt (the (double-float 0d0) x))))
                        (:expt (real-power a b))))))))

(defun run-function (code)
  "Return a function of registers that runs the steps of CODE, or NIL if there are none."
  (labels ((chain (steps)
             (let* ((end (or (position-if #'functionp steps) (length steps)))
                    (operations (coerce (subseq steps 0 end) 'operations))
                    (branch (nth end steps))
                    (further (and branch (chain (nthcdr (1+ end) steps)))))
               (declare (type operations operations))
               (if (null branch)
                   (step-function (r) (run-operations operations r))
                   (step-function (r)
                     (run-operations operations r)
                     (funcall (the function branch) r)
                     (funcall (the function further) r))))))
    (and (code-steps code) (chain (reverse (code-steps code))))))

(defun emit-cond (node code)
  "Emit a COND that gives a number."
  (let ((to (new-register code)))
    (declare (type register to))
    (push (branch-step (loop for (test value) in (node-args node)
                             collect (with-branch-registers (code)
                                       (let* ((inner (inner-code code))
                                              (from (emit value inner)))
                                         (list (emit-test test code) (run-function inner)
                                               (list from) (list to))))))
          (code-steps code))
    to))

(defun branch-step (branches)
  "Return a step that runs the first of BRANCHES whose test is true.
A branch is a test, a function or NIL, registers to read, registers to write."
  (destructuring-bind (test run from to) (first branches)
    (declare (function test))
    (let ((move (move-step from to))
          (else (and (rest branches) (branch-step (rest branches)))))
      (declare (function move))
      (step-function (r)
        (cond ((funcall test r)
               (when run (funcall (the function run) r))
               (funcall move r))
              (else (funcall (the function else) r)))))))

(defun move-step (from to)
  (step-function (r)
    (loop for a of-type register in from
          for b of-type register in to
          do (setf (aref r b) (aref r a)))))

;;; Tests

(defun emit-test (node code)
  "Return a function of registers that is true where NODE, a test, is.
What it needs that CODE has not computed, it computes itself."
  (ecase (node-op node)
    (:true (step-function (r) (declare (ignore r)) t))
    (:false (step-function (r) (declare (ignore r)) nil))
    (:not (let ((test (emit-test (first (node-args node)) code)))
            (declare (function test))
            (step-function (r) (not (funcall test r)))))
    ((:and :or) (emit-connective node code))
    (:blocked (let ((register (+ +blocked+ (first (node-args node)))))
                (declare (type register register))
                (step-function (r) (= 1d0 (aref r register)))))
    ((:< :<= :> :>= :=) (emit-comparison node code))))

(defun emit-connective (node code)
  (let ((a (emit-test (first (node-args node)) code))
        (b (emit-test (second (node-args node)) code)))
    (declare (function a b))
    (if (eq (node-op node) :and)
        (step-function (r) (and (funcall a r) (funcall b r)))
        (step-function (r) (or (funcall a r) (funcall b r))))))

(defun emit-comparison (node code)
  (let* ((inner (inner-code code))
         (a (emit (first (node-args node)) inner))
         (b (emit (second (node-args node)) inner))
         (run (run-function inner)))
    (declare (type register a b) (type (or null function) run))
    (setf (node-registers node) (list a b))
    (macrolet ((comparison (op)
                 `(step-function (r)
                    (when run (funcall run r))
                    (,op (aref r a) (aref r b)))))
      (ecase (node-op node)
        (:< (comparison <))
        (:<= (comparison <=))
        (:> (comparison >))
        (:>= (comparison >=))
        (:= (comparison =))))))

;;; Lists of six

(defun emit-six (node code)
  "Emit NODE, which gives six numbers, and return the registers that will hold them."
  (ecase (node-op node)
    (:list (loop for entry in (node-args node) collect (emit entry code)))
    (:let (dolist (eager (first (node-args node)))
            (emit eager code))
     (emit-six (second (node-args node)) code))
    (:cond
     (let ((to (loop repeat 6 collect (new-register code))))
       (push (branch-step (loop for (test value) in (node-args node)
                                collect (with-branch-registers (code)
                                          (let* ((inner (inner-code code))
                                                 (from (emit-six value inner)))
                                            (list (emit-test test code) (run-function inner)
                                                  from to)))))
             (code-steps code))
       to))))

(defstruct program
  "A form ready to run: RUN, a function of registers or NIL, leaves the results in RESULTS."
  (run nil :type (or null function))
  (results '() :type list))

(defun emit-program (layout emit-results)
  "Return the program that the function EMIT-RESULTS, called with an empty list of steps, emits;
it returns the registers of the results."
  (let* ((code (make-code :layout layout))
         (results (funcall emit-results code)))
    (make-program :run (run-function code) :results results)))

(declaim (inline run-program))
(defun run-program (program registers)
  "Run PROGRAM on REGISTERS and return the list of the registers of its results."
  (when (program-run program)
    (funcall (the function (program-run program)) registers))
  (program-results program))
