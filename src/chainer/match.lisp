;;;; match.lisp -- an antecedent becomes a function that finds all its bindings.
;;;;
;;;; How it works.  A binding is a packed list of faces, variable j at place j, so matching
;;;; allocates nothing.  Each clause becomes one closure that is called with the memory and the
;;;; binding so far, and calls the closure of the next clause once for each way in which it can be
;;;; met; the last one collects the binding.  Since clauses are met in order, which variables are
;;;; bound where is known when the rule is read, and a clause becomes one of:
;;;;
;;;;   a test of one bit, if all its variables are bound (see MEMORY: a set of faces is a number
;;;;   below 64, and each predicate holds a 64-bit map of the sets remembered), positive or not;
;;;;   a walk over the predicate's facts in the order in which they were remembered, each tried
;;;;   in all orders of its faces, its stored order first;
;;;;   for a negated clause, an enumeration of its unbound variables over the faces of the box.

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
  (if (null clauses)
      #'collect-binding
      (let* ((clause (first clauses))
             (next (compile-clauses (rest clauses) (union bound (clause-variables clause)))))
        (cond ((subsetp (clause-variables clause) bound)
               (compile-test clause next))
              ((clause-negated clause)
               (compile-enumeration (set-difference* (clause-variables clause) bound)
                                    (compile-test clause next)))
              (t (compile-walk clause bound next))))))

(defun clause-variables (clause)
  (remove-if-not #'term-variable-p (clause-terms clause)))

(defun set-difference* (list other)
  "SET-DIFFERENCE in the order of LIST."
  (remove-if (lambda (element) (member element other)) list))

(defun collect-binding (memory binding)
  (declare (type memory memory) (type packed binding))
  (let ((bindings (memory-bindings memory))
        (count (memory-found memory)))
    (when (= count (length bindings))
      (setf bindings (replace (make-array (* 2 count) :element-type '(unsigned-byte 32)) bindings)
            (memory-bindings memory) bindings))
    (setf (aref bindings count) binding
          (memory-found memory) (1+ count))))

;;; A test of one bit

(defun compile-test (clause next)
  "Return a matcher of CLAUSE, all of whose variables are bound, that goes on with NEXT."
  (let* ((index (predicate-index (clause-predicate clause)))
         (arity (length (clause-terms clause)))
         (mask (compile-mask (clause-terms clause))))
    (declare (function next mask) (fixnum index))
    (if (clause-negated clause)
        (lambda (memory binding)
          (declare (type memory memory) (type packed binding))
          (let ((set (funcall mask binding)))
            (declare (type (unsigned-byte 6) set))
            ;; A variable may have taken a face that the clause names: no list of distinct faces.
            (when (and (= (logcount set) arity)
                       (not (known-p memory index set)))
              (funcall next memory binding))))
        (lambda (memory binding)
          (declare (type memory memory) (type packed binding))
          (when (known-p memory index (the (unsigned-byte 6) (funcall mask binding)))
            (funcall next memory binding))))))

(defun compile-mask (terms)
  "Return a function from a binding to the set of the faces of TERMS."
  (let ((constant (loop with mask = 0
                        for term in terms
                        unless (term-variable-p term)
                          do (setf mask (logior mask (ash 1 (- -1 term))))
                        finally (return mask)))
        (variables (remove-if-not #'term-variable-p terms)))
    (declare (type (unsigned-byte 6) constant))
    (flet ((bit-of (binding place)
             (declare (type packed binding) (type (integer 0 5) place))
             (the (unsigned-byte 6) (ash 1 (the (integer 0 5) (pack-ref binding place))))))
      (declare (inline bit-of))
      (case (length variables)
        (0 (lambda (binding) (declare (ignore binding)) constant))
        (1 (let ((a (first variables)))
             (declare (type (integer 0 5) a))
             (lambda (binding)
               (declare (type packed binding))
               (logior constant (bit-of binding a)))))
        (2 (destructuring-bind (a b) variables
             (declare (type (integer 0 5) a b))
             (lambda (binding)
               (declare (type packed binding))
               (logior constant (bit-of binding a) (bit-of binding b)))))
        (t (lambda (binding)
             (declare (type packed binding))
             (let ((mask constant))
               (declare (type (unsigned-byte 6) mask))
               (dolist (place variables mask)
                 (setf mask (logior mask (bit-of binding place)))))))))))

;;; An enumeration of faces

(defun compile-enumeration (variables next)
  "Return a matcher that binds VARIABLES to the faces not bound yet, and goes on with NEXT."
  (if (null variables)
      next
      (let ((place (first variables))
            (next (compile-enumeration (rest variables) next)))
        (declare (type (integer 0 5) place) (function next))
        (lambda (memory binding)
          (declare (type packed binding))
          (dotimes (surface 6)
            (unless (logbitp surface binding)
              (funcall next memory (pack-with binding place surface))))))))

;;; A walk over facts

(defun compile-walk (clause bound next)
  "Return a matcher that meets CLAUSE with each fact of its predicate, in each order, and goes on
with NEXT.  The variables BOUND are bound."
  (let* ((predicate (clause-predicate clause))
         (index (predicate-index predicate))
         (place-matcher (compile-places (clause-terms clause) bound next))
         (required (compile-mask (loop for term in (clause-terms clause)
                                       when (or (not (term-variable-p term)) (member term bound))
                                         collect term))))
    (declare (fixnum index) (function place-matcher required))
    (lambda (memory binding)
      (declare (type memory memory) (type packed binding))
      (let ((count (aref (memory-counts memory) index)))
        (when (plusp count)
          (let ((start (predicate-start predicate))
                (facts (memory-facts memory))
                (needed (funcall required binding)))
            (declare (type (unsigned-byte 6) needed) (type (unsigned-byte 20) start))
            (loop for i of-type (unsigned-byte 24) from start below (+ start count)
                  do (let ((fact (aref facts i)))
                       (declare (type packed fact))
                       (unless (logtest needed (lognot (pack-mask fact)))
                         (funcall place-matcher memory binding fact (pack-mask fact)))))))))))

(defun compile-places (terms bound next)
  "Return a function of a memory, a binding, a fact and the set of its faces that are left: it
gives each of TERMS one of those faces, and goes on with NEXT."
  (declare (function next))
  (if (null terms)
      (lambda (memory binding fact left)
        (declare (ignore fact left))
        (funcall next memory binding))
      (let ((term (first terms))
            (further (compile-places (rest terms) (adjoin (first terms) bound) next)))
        (if (or (not (term-variable-p term)) (member term bound))
            (compile-bound-place term further)
            (compile-free-place term further)))))

(defun compile-bound-place (term further)
  (declare (function further) (type (integer -6 5) term))
  (lambda (memory binding fact left)
    (declare (type packed binding) (type (unsigned-byte 6) left))
    (let ((surface (term-value term binding)))
      (declare (type surface surface))
      (when (logbitp surface left)
        (funcall further memory binding fact (logandc2 left (ash 1 surface)))))))

(defun compile-free-place (term further)
  (declare (function further) (type (integer 0 5) term))
  (lambda (memory binding fact left)
    (declare (type packed binding fact) (type (unsigned-byte 6) left))
    (let ((open (logandc2 left binding))
          (count (logcount (pack-mask fact))))
      (declare (type (unsigned-byte 6) open) (type (integer 0 6) count))
      (unless (zerop open)
        (loop for j of-type (integer 0 6) from 0 below count
              do (let ((surface (pack-ref fact (min j 5))))
                   (declare (type surface surface))
                   (when (logbitp surface open)
                     (funcall further memory (pack-with binding term surface) fact
                              (logandc2 left (ash 1 surface))))))))))
