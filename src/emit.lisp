;;;; emit.lisp -- trees of nodes become programs of the machine.
;;;;
;;;; All numbers live in its registers: first what the box and the matching give, then the constants
;;;; of all forms, then intermediate results.  What was already computed on every way to an
;;;; instruction is not computed again.

(in-package :supergrip)

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
  "A program being emitted: STEPS, instructions and labels, the latest first; DONE, what is already
computed, by node and by an integer of operator and registers; LAYOUT."
  (steps '()) (done '()) layout)

(defstruct label "A place in a program." (place nil))

(defun new-register (code)
  (let ((layout (code-layout code)))
    (prog1 (layout-top layout)
      (incf (layout-top layout))
      (setf (layout-most layout) (max (layout-most layout) (layout-top layout))))))

(defun emit-step (code op &optional (a 0) (b 0) (to 0))
  (push (list op a b to) (code-steps code)))

(defun emit-label (code label)
  (push label (code-steps code)))

(defmacro perhaps-run ((code) &body body)
  "Run BODY, which emits what is not always run: what it computes is not done for what follows."
  `(let ((done (code-done ,code)))
     (prog1 (progn ,@body)
       (setf (code-done ,code) done))))

(defmacro in-branch ((code) &body body)
  "As PERHAPS-RUN; the registers that BODY takes are free again after it."
  `(let* ((layout (code-layout ,code))
          (top (layout-top layout)))
     (prog1 (perhaps-run (,code) ,@body)
       (setf (layout-top layout) top))))

;;; Numbers

(defun emit (node code &optional to)
  "Emit NODE, which gives a number, and return the register that will hold it: TO, if it is given
and the number is in none yet."
  (or (cdr (assoc node (code-done code) :test #'eq))
      (let ((register (emit-node node code to)))
        (push (cons node register) (code-done code))
        register)))

(defun emit-node (node code to)
  (ecase (node-op node)
    (:constant (gethash node (layout-constants (code-layout code))))
    (:input (first (node-args node)))
    (:let (dolist (eager (first (node-args node)))
            (emit eager code))
     (emit (second (node-args node)) code to))
    (:cond
     (let ((to (or to (new-register code))))
       (emit-branches (node-args node) code (lambda (value) (emit-into value code to)))
       to))
    (:sqrt (emit-operation :sqrt (emit (first (node-args node)) code) 0 code to))
    ((:+ :- :* :/ :min :max :expt)
     (let* ((a (emit (first (node-args node)) code))
            (b (emit (second (node-args node)) code)))
       (emit-operation (node-op node) a b code to)))))

(defun emit-operation (op a b code to)
  "Emit OP on the registers A and B, unless it is already done."
  (let ((key (logior (position op +operators+) (ash a 8) (ash b 24))))
    (or (cdr (assoc key (code-done code)))
        (let ((register (or to (new-register code))))
          (emit-step code op a b register)
          (push (cons key register) (code-done code))
          register))))

(defun emit-into (node code to)
  "Emit NODE, so that the register TO will hold it."
  (let ((from (emit node code to)))
    (unless (= from to)
      (emit-step code :move from 0 to))))

(defun emit-branches (branches code give &optional (end (make-label)))
  "Emit the clauses BRANCHES of a COND; GIVE emits the value of one."
  (destructuring-bind ((test value) . others) branches
    (cond ((eq t (test-value test))
           (in-branch (code) (funcall give value))
           (emit-label code end))
          (t
           (let ((otherwise (make-label)))
             (emit-jump test nil otherwise code)
             (in-branch (code) (funcall give value))
             (emit-step code :jump 0 0 end)
             (emit-label code otherwise)
             (in-branch (code) (emit-branches others code give end)))))))

;;; Lists of six

(defun emit-six (node code &optional (to (make-list 6)))
  "Emit NODE, which gives six numbers, and return the registers that will hold them."
  (ecase (node-op node)
    (:list (loop for entry in (node-args node)
                 for register in to
                 collect (emit entry code register)))
    (:let (dolist (eager (first (node-args node)))
            (emit eager code))
     (emit-six (second (node-args node)) code to))
    (:cond
     (let ((to (if (first to) to (loop repeat 6 collect (new-register code)))))
       (emit-branches (node-args node) code (lambda (value) (emit-six-into value code to)))
       to))))

(defun emit-six-into (node code to)
  (loop for from in (emit-six node code to)
        for register in to
        unless (= from register)
          do (emit-step code :move from 0 register)))

;;; Tests

(defun emit-jump (node wanted label code)
  "Emit a jump to LABEL if NODE, a test, is true (WANTED true) or false (WANTED NIL)."
  (destructuring-bind (&optional a b) (node-args node)
    (ecase (node-op node)
      (:true (when wanted (emit-step code :jump 0 0 label)))
      (:false (unless wanted (emit-step code :jump 0 0 label)))
      (:not (emit-jump a (not wanted) label code))
      (:and (emit-connective a b wanted (not wanted) label code))
      (:or (emit-connective a b wanted wanted label code))
      (:blocked (emit-step code (if wanted :jump-blocked :jump-free) (+ +blocked+ a) 0 label))
      ((:< :<= :> :>= :=) (emit-comparison node wanted label code)))))

(defun emit-connective (a b wanted decisive label code)
  "Emit a jump to LABEL for the tests A and B.  If A alone decides the result, it is that WANTED for
the jump (DECISIVE true), or the other."
  (let ((end (make-label)))
    (emit-jump a (eq wanted decisive) (if decisive label end) code)
    (perhaps-run (code) (emit-jump b wanted label code))
    (emit-label code end)))

(defun emit-comparison (node wanted label code)
  (destructuring-bind (a b) (loop for operand in (node-args node) collect (emit operand code))
    (flet ((jump (op a b) (emit-step code op a b label)))
      ;; No register ever holds what is not a number, so what is not below is equal or above.
      (ecase (node-op node)
        (:< (if wanted (jump :jump< a b) (jump :jump<= b a)))
        (:<= (if wanted (jump :jump<= a b) (jump :jump< b a)))
        (:> (if wanted (jump :jump< b a) (jump :jump<= a b)))
        (:>= (if wanted (jump :jump<= b a) (jump :jump< a b)))
        (:= (jump (if wanted :jump= :jump/=) a b))))))

;;; Programs

(defun pack-instructions (code)
  "Return the instructions of CODE."
  (let ((steps (reverse (code-steps code))) (place 0))
    (dolist (step steps)
      (if (label-p step)
          (setf (label-place step) place)
          (incf place)))
    (let ((count (layout-most (code-layout code))))
      (coerce (loop for step in steps
                    unless (label-p step)
                      append (destructuring-bind (op a b to) step
                               ;; RUN-INSTRUCTIONS relies on it.
                               (assert (and (< a count) (< b count)
                                            (if (label-p to) (label-place to) (< to count))))
                               (list (position op +operators+) a b
                                     (if (label-p to) (label-place to) to))))
              'instructions))))

(defun emit-program (layout emit-results)
  "Return the program that the function EMIT-RESULTS, called with empty code, emits; it returns the
registers of the results."
  (let* ((code (make-code :layout layout))
         (results (funcall emit-results code)))
    (emit-step code :end)
    (make-program :instructions (pack-instructions code) :results (coerce results 'register-vector)
                  :room (layout-most layout))))

(defun emit-test (layout node)
  "Return the program of NODE, a test."
  (let ((failed (make-label)))
    (emit-program layout (lambda (code)
                           (emit-jump node nil failed code)
                           (emit-step code :end)
                           (emit-label code failed)
                           (emit-step code :fail)
                           '()))))

(defun comparison-programs (layout node)
  "Return an alist from the comparisons in NODE, a test, to the programs of their operands."
  (case (node-op node)
    ((:and :or :not)
     (loop for test in (node-args node) append (comparison-programs layout test)))
    ((:< :<= :> :>= :=)
     (list (cons node (emit-program layout (lambda (code)
                                             (loop for operand in (node-args node)
                                                   collect (emit operand code)))))))))
