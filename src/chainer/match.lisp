;;;; match.lisp -- an antecedent becomes a function that finds all its bindings.
;;;;
;;;; How it works.  A binding is a packed list of faces, variable j at place j, so matching
;;;; allocates nothing.  Each clause becomes one closure that is called with the memory and the
;;;; binding so far, and calls the closure of the next clause once for each way in which it can be
;;;; met; the last one collects the binding.  Which variables are bound where is known when the
;;;; rule is read, and a clause becomes one of:
;;;;
;;;;   a test of one bit, if all its variables are bound (see MEMORY: a set of faces is a number
;;;;   below 64, and each predicate holds a 64-bit map of the sets remembered), positive or not;
;;;;   a walk over the predicate's facts in the order in which they were remembered, each tried
;;;;   in all orders of its faces, its stored order first;
;;;;   for a negated clause, an enumeration of its unbound variables over the faces of the box,
;;;;   which makes a test of it.
;;;;
;;;; Clauses are met in their order, but a test is made as soon as its variables are bound: it
;;;; binds nothing, so which bindings are found, and in which order, does not change.

(in-package :supergrip-chainer)

(deftype matcher () '(function (memory packed) t))

(defun compile-antecedent (rule)
  "Return a function of a memory that collects the bindings of RULE into it and returns how many
there are."
  (let ((matcher (compile-clauses (rule-clauses rule) '())))
    (declare (function matcher))
    (lambda (memory)
      (setf (memory-found memory) 0)
      (funcall matcher memory 0)
      (memory-found memory))))

(defun compile-clauses (clauses bound)
  "Return the matcher of CLAUSES, where the variables BOUND are bound before the first."
  (flet ((unbound (clause)
           (remove-if (lambda (variable) (member variable bound)) (clause-variables clause))))
    (let ((test (find-if-not #'unbound clauses))
          (clause (first clauses)))
      (cond ((null clauses) #'collect-binding)
            (test (compile-test test (compile-clauses (remove test clauses) bound)))
            ((clause-negated clause)
             (let ((variable (first (unbound clause))))
               (compile-enumeration variable
                                    (compile-clauses clauses (cons variable bound)))))
            (t (compile-walk clause (unbound clause)
                             (compile-clauses (rest clauses) (append (unbound clause) bound))))))))

(defun clause-variables (clause)
  (remove-if-not #'term-variable-p (clause-terms clause)))

(defun collect-binding (memory binding)
  (declare (type memory memory) (type packed binding))
  (let ((bindings (memory-bindings memory))
        (count (memory-found memory)))
    (when (= count (length bindings))
      (setf bindings (replace (make-array (* 2 count) :element-type '(unsigned-byte 32)) bindings)
            (memory-bindings memory) bindings))
    (setf (aref bindings count) binding
          (memory-found memory) (1+ count))))

;;; The faces that terms stand for

(declaim (inline face-bit))
(defun face-bit (binding place)
  "Return the set of the one face at PLACE of BINDING."
  (declare (type packed binding) (type (integer 0 5) place))
  (the (unsigned-byte 6) (ash 1 (the surface (pack-ref binding place)))))

(defun constant-set (terms)
  "Return the set of those of TERMS that are faces."
  (reduce #'logior (remove-if #'term-variable-p terms)
          :key (lambda (term) (ash 1 (- -1 term)))))

(defmacro with-face-set ((set terms binding) matcher)
  "Return MATCHER, a LAMBDA form of a parameter BINDING, in which SET is the set of the faces that
TERMS stand for.  It is compiled for each count of variables, since it is what matching does most."
  `(let ((constants (constant-set ,terms))
         (variables (remove-if-not #'term-variable-p ,terms)))
     (declare (type (unsigned-byte 6) constants))
     (case (length variables)
       (0 (symbol-macrolet ((,set constants)) ,matcher))
       (1 (let ((a (first variables)))
            (declare (type (integer 0 5) a))
            (symbol-macrolet ((,set (logior constants (face-bit ,binding a)))) ,matcher)))
       (2 (destructuring-bind (a b) variables
            (declare (type (integer 0 5) a b))
            (symbol-macrolet ((,set (logior constants (face-bit ,binding a)
                                            (face-bit ,binding b))))
              ,matcher)))
       (t (symbol-macrolet ((,set (logior constants (variable-set variables ,binding))))
            ,matcher)))))

(defun variable-set (variables binding)
  "Return the set of the faces that VARIABLES have under BINDING."
  (let ((set 0))
    (declare (type (unsigned-byte 6) set))
    (dolist (place variables set)
      (setf set (logior set (face-bit binding place))))))

;;; A test of one bit

(defun compile-test (clause next)
  "Return a matcher of CLAUSE, all of whose variables are bound, that goes on with NEXT."
  (let* ((terms (clause-terms clause))
         (index (predicate-index (clause-predicate clause)))
         (arity (length terms)))
    (declare (function next) (fixnum index))
    (if (clause-negated clause)
        (with-face-set (faces terms binding)
          (lambda (memory binding)
            (declare (type memory memory) (type packed binding) (ignorable binding))
            (let ((set faces))
              ;; A variable may have taken a face that the clause names: no list of distinct faces.
              (when (and (= (logcount set) arity) (not (known-p memory index set)))
                (funcall next memory binding)))))
        (with-face-set (faces terms binding)
          (lambda (memory binding)
            (declare (type memory memory) (type packed binding))
            (when (known-p memory index faces)
              (funcall next memory binding)))))))

;;; An enumeration of faces

(defun compile-enumeration (place next)
  "Return a matcher that binds the variable PLACE to each face not bound yet, and goes on with
NEXT."
  (declare (type (integer 0 5) place) (function next))
  (lambda (memory binding)
    (declare (type packed binding))
    (dotimes (surface 6)
      (unless (logbitp surface binding)
        (funcall next memory (pack-with binding place surface))))))

;;; A walk over facts

(declaim (inline only-face))
(defun only-face (set)
  "Return the one face of SET."
  (declare (type (integer 1 63) set))
  (the surface (1- (integer-length set))))

(defun compile-walk (clause unbound next)
  "Return a matcher that meets CLAUSE with each fact of its predicate, in each order, and goes on
with NEXT.  UNBOUND are the variables of CLAUSE that it binds."
  (let* ((predicate (clause-predicate clause))
         (index (predicate-index predicate))
         (start (predicate-start predicate))
         (only (and (null (rest unbound)) (first unbound)))
         (places (compile-places unbound next))
         (required (remove-if (lambda (term) (member term unbound)) (clause-terms clause)))
         (count (length required)))
    (declare (fixnum index) (type (unsigned-byte 20) start) (function next places)
             (type (or null (integer 0 5)) only))
    (with-face-set (faces required binding)
      (lambda (memory binding)
        (declare (type memory memory) (type packed binding))
        (let* ((set faces)
               (taken (logior set (pack-mask binding)))
               (facts (memory-facts memory)))
          ;; A variable may have taken a face that the clause names: no list of distinct faces.
          (when (= (logcount set) count)
            (loop for i of-type (unsigned-byte 24) from start
                  repeat (aref (memory-counts memory) index)
                  do (let* ((fact (aref facts i))
                            (left (logandc2 (pack-mask fact) set)))
                       (declare (type packed fact))
                       ;; What the fact has of the faces taken is what the clause asks for.
                       (when (= set (logand taken fact))
                         ;; The face of an only variable is what is left: no places to try.
                         (if only
                             (funcall next memory (pack-with binding only (only-face left)))
                             (funcall places memory binding fact left)))))))))))

(defun compile-places (variables next)
  "Return a function of a memory, a binding, a fact and the set of its faces that are left, as many
as VARIABLES: it gives them those faces in all orders, and goes on with NEXT."
  (declare (function next))
  (let ((place (first variables)))
    (declare (type (integer 0 5) place))
    (if (null (rest variables))
        (lambda (memory binding fact left)
          (declare (type packed binding) (ignore fact))
          (funcall next memory (pack-with binding place (only-face left))))
        (let ((further (compile-places (rest variables) next)))
          (declare (function further))
          (lambda (memory binding fact left)
            (declare (type packed binding fact) (type (unsigned-byte 6) left))
            (dotimes (j (logcount (pack-mask fact)))
              (let ((surface (pack-ref fact (the (integer 0 5) j))))
                (declare (type surface surface))
                (when (logbitp surface left)
                  (funcall further memory (pack-with binding place surface) fact
                           (logandc2 left (ash 1 surface)))))))))))
