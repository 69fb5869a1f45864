;;;; match.lisp -- an antecedent becomes a function that finds all its bindings.
;;;;
;;;; How it works.  A binding is a face list, variable j at place j, so matching
;;;; allocates nothing.  An antecedent becomes a chain of closures.  Each is called with the memory
;;;; and the binding so far, and calls the next once for each way in which its part can be met; the
;;;; last one collects the binding.  Which variables are bound where is known when the rule is read.
;;;; A closure is one of:
;;;;
;;;;   a walk over the facts of a clause's predicate in the order in which they were remembered,
;;;;   each in all orders of its faces, its stored order first: it binds the clause's variables;
;;;;   an enumeration of the faces for a variable that only a negated clause has;
;;;;   a test of one bit, for a clause whose variables are bound.
;;;;
;;;; Most clauses become none of them.  A clause of one or two surfaces, negated or not, leaves its
;;;; last variable to be bound a set of faces, six bits that the memory holds ready (see FACT-BITS).
;;;; So where a variable is bound, the sets of all such clauses are intersected first: they are its
;;;; filters, one integer each.  Only faces in all sets are tried.  A walk over pairs for which only
;;;; one face is left needs no walk.
;;;;
;;;; Tests and filters bind nothing.  So running them early changes neither which bindings are found
;;;; nor their order.
;;;;
;;;; Where several bindings have the same effect, only one is followed: see symmetry.lisp.  So where
;;;; the clauses left are about two variables that no action sees, one closure tests whether there
;;;; is such a pair: it intersects sets of pairs, 36 bits each.

(in-package :supergrip-chainer)

(deftype matcher () '(function (memory face-list) t))
(deftype filters () '(simple-array (unsigned-byte 62) (*)))

;;; From clauses to matchers

(defun compile-antecedent (clauses actions count)
  "Return the matcher of a rule of CLAUSES and ACTIONS, which has COUNT variables.  It leaves out
some of the bindings that would do nothing."
  (let ((*interchangeable* (interchangeable-pairs clauses actions count))
        (*unseen* (unseen-variables actions count)))
    (compile-clauses clauses '())))

(declaim (inline find-bindings))
(defun find-bindings (matcher memory)
  "Put the bindings that MATCHER finds into MEMORY, and return how many there are."
  (declare (function matcher) (type memory memory))
  (setf (memory-found memory) 0)
  (funcall matcher memory 0)
  (memory-found memory))

(defun compile-clauses (clauses bound)
  "Return the matcher of CLAUSES, where the variables BOUND are bound before the first."
  (let ((test (find-if-not (lambda (clause) (unbound-variables clause bound)) clauses))
        (clause (first clauses)))
    (cond ((null clauses) #'collect-binding)
          (test (compile-test test (compile-clauses (remove test clauses) bound)))
          ((unseen-pair clauses bound)
           (compile-pair-test (unseen-pair clauses bound) clauses bound))
          ((clause-negated clause)
           (compile-enumeration (first (unbound-variables clause bound)) clauses bound))
          (t (compile-walk clause (rest clauses) bound)))))

(defun clause-variables (clause)
  (remove-if-not #'term-variable-p (clause-terms clause)))

(defun unbound-variables (clause bound)
  (set-difference-in-order (clause-variables clause) bound))

(defun set-difference-in-order (list others)
  (remove-if (lambda (element) (member element others)) list))

(defun collect-binding (memory binding)
  (declare (type memory memory) (type face-list binding))
  (let ((bindings (memory-bindings memory))
        (count (memory-found memory)))
    (when (= count (length bindings))
      (setf bindings (replace (make-array (* 2 count) :element-type '(unsigned-byte 32)) bindings)
            (memory-bindings memory) bindings))
    (setf (aref bindings count) binding
          (memory-found memory) (1+ count))))

;;; The faces that terms stand for

(declaim (inline face-bit only-face several-p))
(defun face-bit (binding place)
  "Return the set of the one face at PLACE of BINDING."
  (declare (type face-list binding) (type (integer 0 5) place))
  (the (unsigned-byte 6) (ash 1 (the face (face-list-ref binding place)))))

(defun only-face (set)
  "Return the one face of SET."
  (declare (type (integer 1 63) set))
  (the face (1- (integer-length set))))

(defun several-p (set)
  "True if SET has more than one face."
  (declare (type (integer 1 63) set))
  (logtest set (1- set)))

(defun constant-set (terms)
  "Return the set of those of TERMS that are faces."
  (reduce #'logior (remove-if #'term-variable-p terms)
          :key (lambda (term) (ash 1 (- -1 term)))))

(declaim (inline face-set))
(defun face-set (constants variables binding)
  "Return the set of the faces of CONSTANTS, a set, and of those that VARIABLES have under BINDING."
  (declare (type (unsigned-byte 6) constants))
  (let ((set constants))
    (declare (type (unsigned-byte 6) set))
    (dolist (place variables set)
      (setf set (logior set (face-bit binding place))))))

;;; Filters.  One is an integer: where in the binding the other face of its clause stands, a face
;;; that it names itself, times six, whether it is negated, the faces that it leaves, and the index
;;; of its predicate.

(defun pack-filter (clause variable)
  "Return the filter that CLAUSE, of one or two surfaces, is for VARIABLE."
  (let* ((other (first (remove variable (clause-terms clause))))
         (face (and other (not (term-variable-p other)) (- -1 other))))
    ;; Place 6 of a binding is always empty: it reads as face 0.
    (logior (+ 6 (* 3 (if (or (null other) face) 6 other)))
            (ash (* 6 (or face 0)) 5)
            (ash (if (clause-negated clause) 63 0) 10)
            ;; The faces of a list are distinct.
            (ash (if face (logxor 63 (ash 1 face)) 63) 16)
            (ash (predicate-index (clause-predicate clause)) 22))))

(declaim (inline allowed-faces))
(defun allowed-faces (memory binding filters)
  "Return the set of the faces that are not in BINDING and that all FILTERS leave."
  (declare (type memory memory) (type face-list binding) (type filters filters))
  (let ((set (logxor 63 (face-list-mask binding)))
        (relations (memory-relations memory)))
    (declare (type (unsigned-byte 6) set))
    (loop for filter across filters
          do (let* ((other (ldb (byte 3 0) (ash binding (- (ldb (byte 5 0) filter)))))
                    (shift (+ (ldb (byte 5 5) filter) (* 6 other)))
                    (partners (ash (aref relations (ash filter -22)) (- shift))))
               (setf set (logand set
                                 (logxor (ldb (byte 6 0) partners) (ldb (byte 6 10) filter))
                                 (ldb (byte 6 16) filter)))))
    set))

(defun filter-clauses (variable clauses bound)
  "Return those of CLAUSES that are filters for VARIABLE, to be bound after BOUND."
  (remove-if-not (lambda (clause)
                   (and (<= (length (clause-terms clause)) 2)
                        (equal (list variable) (unbound-variables clause bound))))
                 clauses))

(defun pack-filters (clauses variable)
  (coerce (loop for clause in clauses collect (pack-filter clause variable)) 'filters))

;;; A test of one bit

(defun compile-test (clause next)
  "Return a matcher of CLAUSE, all of whose variables are bound, that goes on with NEXT."
  (if (clause-variables clause)
      (compile-variable-test clause next)
      (let ((bits (fact-bits (length (clause-terms clause))
                             (make-face-list (mapcar (lambda (term) (- -1 term))
                                                     (clause-terms clause)))))
            (index (predicate-index (clause-predicate clause)))
            (wanted (not (clause-negated clause))))
        (declare (function next))
        (lambda (memory binding)
          (declare (type memory memory) (type face-list binding))
          (when (eq wanted (known-p memory index bits))
            (funcall next memory binding))))))

(defun compile-variable-test (clause next)
  "Return a matcher of CLAUSE, of three or more surfaces, bound variables among them."
  (let* ((terms (clause-terms clause))
         (index (predicate-index (clause-predicate clause)))
         (arity (length terms))
         (wanted (not (clause-negated clause)))
         (constants (constant-set terms))
         (variables (clause-variables clause)))
    (declare (function next))
    (lambda (memory binding)
      (declare (type memory memory) (type face-list binding))
      (let ((set (face-set constants variables binding)))
        ;; A variable may have taken a face that the clause names: no list of distinct faces.
        (when (and (= (logcount set) arity)
                   (eq wanted (known-p memory index (ash 1 set))))
          (funcall next memory binding))))))

;;; A test whether there is a pair

(defparameter +rows+
  (let ((rows (make-array 64 :element-type '(unsigned-byte 62) :initial-element 0)))
    (dotimes (set 64 rows)
      (dotimes (face 6)
        (setf (ldb (byte 6 (* 6 face)) (aref rows set)) (if (logbitp face set) 63 0)))))
  "For each set of faces, the bits of all pairs (see FACT-BITS) whose first face is in it.")
(declaim (type (simple-array (unsigned-byte 62) (64)) +rows+))

(defconstant +no-pairs+ #o402010040201 "The bits of a face with itself.")

(defun unseen-pair (clauses bound)
  "Return the two variables that CLAUSES bind after BOUND, if no action sees them and all CLAUSES
are of one or two surfaces; else NIL."
  (let ((unbound (remove-duplicates
                  (loop for clause in clauses append (unbound-variables clause bound))
                  :from-end t)))
    (and (= (length unbound) 2)
         (subsetp unbound *unseen*)
         (every (lambda (clause) (<= (length (clause-terms clause)) 2)) clauses)
         unbound)))

(defun pack-pair-filter (clause)
  "Return the filter of pairs that CLAUSE, of two variables, is: 36 bits, all set if it is negated,
and the index of its predicate."
  (logior (if (clause-negated clause) (1- (ash 1 36)) 0)
          (ash (predicate-index (clause-predicate clause)) 36)))

(defun compile-pair-test (pair clauses bound)
  "Return a matcher that collects the binding as it is if the variables PAIR could be bound so that
all CLAUSES are met."
  (let* ((own (loop for variable in pair collect (filter-clauses variable clauses bound)))
         (both (set-difference-in-order clauses (reduce #'append own)))
         (pair-filters (coerce (mapcar #'pack-pair-filter both) 'filters)))
    (destructuring-bind (filters1 filters2) (mapcar #'pack-filters own pair)
      (declare (type filters filters1 filters2 pair-filters))
      (lambda (memory binding)
        (declare (type memory memory) (type face-list binding))
        (let ((relations (memory-relations memory))
              (pairs (logand (aref +rows+ (allowed-faces memory binding filters1))
                             (* #o10101010101 (allowed-faces memory binding filters2))
                             (lognot +no-pairs+))))
          (declare (type (unsigned-byte 36) pairs))
          (loop for filter across pair-filters
                do (setf pairs (logand pairs (logxor filter (aref relations (ash filter -36))))))
          (unless (zerop pairs)
            (collect-binding memory binding)))))))

;;; An enumeration of faces

(defun compile-enumeration (place clauses bound)
  "Return a matcher that binds the variable PLACE to each face not bound yet, in ascending order,
and goes on with CLAUSES."
  (let* ((filter-clauses (filter-clauses place clauses bound))
         (filters (pack-filters filter-clauses place))
         ;; Of two such bindings the one with the ascending faces comes first.
         (partner (find-if (lambda (other) (interchangeable-p (list place other))) *ascending*))
         (next (let ((*ascending* (cons place *ascending*)))
                 (compile-clauses (set-difference-in-order clauses filter-clauses)
                                  (cons place bound)))))
    (declare (type (integer 0 5) place) (type (or null (integer 0 5)) partner) (function next)
             (type filters filters))
    (lambda (memory binding)
      (declare (type memory memory) (type face-list binding))
      (let ((left (allowed-faces memory binding filters)))
        (declare (type (unsigned-byte 6) left))
        (when partner
          (setf left (logandc2 left (1- (face-bit binding partner)))))
        (loop until (zerop left)
              do (let ((face (only-face (logand left (- left)))))
                   (setf left (logand left (1- left)))
                   (funcall next memory (face-list-with binding place face))))))))

;;; A walk over facts

(defun compile-walk (clause clauses bound)
  "Return a matcher that meets CLAUSE with each fact of its predicate, in each order, and goes on
with CLAUSES."
  (let* ((unbound (unbound-variables clause bound))
         (filters (loop for variable in unbound
                        collect (let ((own (filter-clauses variable clauses bound)))
                                  (setf clauses (set-difference-in-order clauses own))
                                  (push variable bound)
                                  (pack-filters own variable))))
         (next (compile-clauses clauses bound)))
    (case (length unbound)
      (1 (compile-walk-for-one clause (first unbound) (first filters) next))
      (2 (compile-walk-for-two clause unbound filters next))
      (t (compile-walk-for-several clause unbound filters next)))))

(defun required-terms (clause unbound)
  "Return the terms of CLAUSE that stand for a face before it binds the variables UNBOUND: the set
of those that are faces, and the variables."
  (let ((terms (set-difference-in-order (clause-terms clause) unbound)))
    (values (constant-set terms) (remove-if-not #'term-variable-p terms) (length terms))))

(defun compile-walk-for-one (clause place filters next)
  "Return a matcher that meets CLAUSE, of which only the variable PLACE is not bound."
  (multiple-value-bind (constants variables count) (required-terms clause (list place))
    (let* ((index (predicate-index (clause-predicate clause)))
           (pairs (<= count 1))
           ;; With one or two surfaces CLAUSE is a filter itself: all that it leaves are facts.
           (filters (if pairs
                        (concatenate 'filters (list (pack-filter clause place)) filters)
                        filters)))
      (declare (type (integer 0 5) place) (function next) (type filters filters))
      (lambda (memory binding)
        (declare (type memory memory) (type face-list binding))
        (let ((allowed (allowed-faces memory binding filters)))
          (declare (type (unsigned-byte 6) allowed))
          (cond ((zerop allowed))
                ((and pairs (not (several-p allowed)))
                 (funcall next memory (face-list-with binding place (only-face allowed))))
                (t
                 (let ((set (face-set constants variables binding)))
                   (do-facts (fact memory index)
                     (let ((left (logandc2 (face-list-mask fact) set)))
                       ;; All faces but one are those that the clause asks for.
                       (when (and (logtest left allowed) (not (several-p left)))
                         (funcall next memory
                                  (face-list-with binding place (only-face left))))))))))))))

(defmacro fact-matcher ((fact left allowed) (clause unbound filters) (memory binding) &body body)
  "Return a matcher, a function of MEMORY and BINDING, that runs BODY with each FACT that can meet
CLAUSE, in their order.  LEFT is the set of its faces that the variables UNBOUND can take, as many
as they are, and ALLOWED that of the faces that FILTERS leave to the first of them."
  `(multiple-value-bind (constants variables count) (required-terms ,clause ,unbound)
     (let ((index (predicate-index (clause-predicate ,clause))))
       (declare (fixnum count) (type (unsigned-byte 24) index))
       (lambda (,memory ,binding)
         (declare (type memory ,memory) (type face-list ,binding))
         (let* ((set (face-set constants variables ,binding))
                (taken (logior set (face-list-mask ,binding)))
                (,allowed (allowed-faces ,memory ,binding ,filters)))
           ;; A variable may have taken a face that the clause names: no list of distinct faces.
           (when (and (= (logcount set) count) (plusp ,allowed))
             (do-facts (,fact ,memory index)
               (let ((,left (logandc2 (face-list-mask ,fact) set)))
                 ;; What the fact has of the faces taken is what the clause asks for.
                 (when (and (= set (logand taken ,fact)) (logtest ,left ,allowed))
                   ,@body)))))))))

(declaim (inline first-face))
(defun first-face (fact set)
  "Return the first face of the list FACT that is in SET, which holds one of them at least."
  (declare (type face-list fact) (type (integer 1 63) set))
  (loop for rest of-type face-list = (ash fact -6) then (ash rest -3)
        when (logbitp (logand rest 7) set) return (the face (logand rest 7))))

(defun compile-walk-for-two (clause unbound filters next)
  "Return a matcher that meets CLAUSE, of which the two variables UNBOUND are not bound; they have
FILTERS, two."
  (destructuring-bind ((place1 place2) (filters1 filters2)) (list unbound filters)
    (declare (type (integer 0 5) place1 place2) (type filters filters1 filters2) (function next))
    (let ((symmetric (interchangeable-p unbound)))
      (fact-matcher (fact left allowed) (clause unbound filters1) (memory binding)
        (flet ((give (face1 face2)
                 (when (logbitp face1 allowed)
                   (let ((binding (face-list-with binding place1 face1)))
                     (when (logbitp face2 (allowed-faces memory binding filters2))
                       (funcall next memory (face-list-with binding place2 face2)))))))
          (declare (inline give))
          (let* ((face1 (first-face fact left))
                 (face2 (only-face (logandc2 left (ash 1 face1)))))
            (give face1 face2)
            (unless symmetric
              (give face2 face1))))))))

(defun compile-walk-for-several (clause unbound filters next)
  "Return a matcher that meets CLAUSE, of which the variables UNBOUND are not bound; they have
FILTERS, a list."
  (destructuring-bind (filters1 . others) filters
    (declare (type filters filters1))
    (let ((places (compile-places unbound others next)))
      (declare (function places))
      (fact-matcher (fact left allowed) (clause unbound filters1) (memory binding)
        (funcall places memory binding fact left allowed)))))

(defun compile-places (variables filters next)
  "Return a function of a memory, a binding, a fact, the set of its faces that are left, as many as
VARIABLES, and the set of the faces allowed for the first: it gives them those faces in all orders,
and goes on with NEXT.  FILTERS are those of the other variables."
  (let ((place (first variables)))
    (if (null (rest variables))
        (lambda (memory binding fact left allowed)
          (declare (type face-list binding) (type (unsigned-byte 6) left allowed) (ignore fact))
          (when (logtest left allowed)
            (funcall (the function next) memory (face-list-with binding place (only-face left)))))
        (let ((further (compile-places (rest variables) (rest filters) next))
              (filter (first filters)))
          (declare (type (integer 0 5) place) (function further) (type filters filter))
          (lambda (memory binding fact left allowed)
            (declare (type memory memory) (type face-list binding fact)
                     (type (unsigned-byte 6) left allowed))
            (dotimes (j (logcount (face-list-mask fact)))
              (let ((face (face-list-ref fact (the (integer 0 5) j))))
                (declare (type face face))
                (when (logbitp face (logand left allowed))
                  (let ((binding (face-list-with binding place face)))
                    (funcall further memory binding fact (logandc2 left (ash 1 face))
                             (allowed-faces memory binding filter)))))))))))
