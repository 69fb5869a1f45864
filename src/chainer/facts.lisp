;;;; facts.lisp -- predicates and the working memory: remember and recall.

(in-package :supergrip-chainer)

(defstruct predicate
  "What a sentence says of its surfaces.  WORDS are its strings, ARITY the number of surfaces that
its lists have (0 for an ordinary predicate such as OBJECT HAS FREE CORNERS), INDEX its number in
its rule base.  GIVEN is true if the input provides it: an INPUT-DECLARATION, if a rule
file declares it."
  (words '() :type list :read-only t)
  (arity 0 :type (integer 0 6) :read-only t)
  (index 0 :type (unsigned-byte 24) :read-only t)
  (given nil :read-only t))

(define-printing (predicate predicate) "~{~a~^ ~}" (predicate-words predicate))

(defun predicate-text (predicate)
  "Return the words of PREDICATE as one string."
  (format nil "~{~a~^ ~}" (predicate-words predicate)))

(defstruct input-declaration
  "That the input may say a sentence: FORM is the (INPUT ...), COMMENT the list of the lines before
it in its file."
  (form '() :type list :read-only t) (comment '() :type list :read-only t))

(defun declared-p (predicate)
  "True if a rule file declares PREDICATE by (INPUT ...)."
  (input-declaration-p (predicate-given predicate)))

(defun input-line (words count)
  "Return the line that declares the sentence WORDS, one string, with a list of COUNT surfaces."
  (format nil "(INPUT ~a~@[ (~{S~d~^ ~})~])" words
          (loop for number from 1 to count collect number)))

;;; What is remembered of a predicate is kept twice: as bits, to test, and in order, to walk.

(deftype relations () '(simple-array (unsigned-byte 64) (*)))
(deftype face-lists () '(simple-array (unsigned-byte 32) (*)))

(defconstant +most-facts+ 20
  "How many facts a predicate can have: there are 20 sets of three faces, and fewer of any other
number.")

(defstruct (memory (:constructor %make-memory))
  "A working memory.  RELATIONS holds, for each predicate, the bits of what is remembered (see
FACT-BITS).  FACTS holds the face lists in the order in which they were remembered, those of each
predicate from +MOST-FACTS+ times its index on, and COUNTS how many it has.  USED holds the indices
of the predicates that have facts, USED-COUNT of them.  AWAKE has a bit for each rule that may fire,
and SLEEPERS, for each predicate, the list of the rules that its first fact wakes (see
SLEEPING-RULES).  BINDINGS holds the FOUND bindings of the rule being run.  LOG holds the events of
a run, the newest first.  CLIENT is whatever the actions of the lower level need."
  (relations nil :type relations)
  (facts nil :type face-lists)
  (counts nil :type face-lists)
  (used nil :type face-lists)
  (used-count 0 :type fixnum)
  (awake nil :type simple-bit-vector)
  (sleepers nil :type simple-vector)
  (bindings nil :type face-lists)
  (found 0 :type fixnum)
  (log '() :type list)
  (client nil))

(define-printing (memory memory) "~d predicate~:p with facts" (memory-used-count memory))

(declaim (inline fact-bits known-p))
(defun fact-bits (arity face-list)
  "Return the bits that stand for the faces of FACE-LIST, in any order, among the facts of a
predicate of ARITY: for one face that of the face, so that six bits are the set of them; for two, a
and b, the bits 6a+b and 6b+a, so that the six bits from 6a are the set of the partners of a; for
more the bit whose number is the set."
  (declare (type (integer 0 6) arity) (type face-list face-list))
  (the (unsigned-byte 64)
       (case arity
         (0 1)
         (1 (face-list-mask face-list))
         (2 (let ((a (face-list-ref face-list 0)) (b (face-list-ref face-list 1)))
              (declare (type face a b))
              (logior (ash 1 (+ (* 6 a) b)) (ash 1 (+ (* 6 b) a)))))
         (t (ash 1 (face-list-mask face-list))))))

(defun known-p (memory index bits)
  (declare (type memory memory) (fixnum index) (type (unsigned-byte 64) bits))
  (logtest bits (aref (memory-relations memory) index)))

(defun recall (memory predicate face-list)
  "True if MEMORY holds that PREDICATE is true of the faces of FACE-LIST, in any order."
  (known-p memory (predicate-index predicate) (fact-bits (predicate-arity predicate) face-list)))

(declaim (inline wake-rules put-fact))
(defun wake-rules (memory index)
  "Note that the predicate INDEX has its first fact, and wake the rules that wait for it."
  (declare (type memory memory) (type (unsigned-byte 24) index))
  (setf (aref (memory-used memory) (memory-used-count memory)) index)
  (incf (memory-used-count memory))
  (dolist (rule (svref (memory-sleepers memory) index))
    (setf (sbit (memory-awake memory) rule) 1)))

(defun put-fact (memory predicate face-list)
  "As REMEMBER; FACE-LIST must hold as many faces as the lists of PREDICATE have."
  (declare (type memory memory) (type predicate predicate) (type face-list face-list))
  (let* ((index (predicate-index predicate))
         (bits (fact-bits (predicate-arity predicate) face-list))
         (count (aref (memory-counts memory) index)))
    (unless (known-p memory index bits)
      (setf (aref (memory-relations memory) index)
            (logior (aref (memory-relations memory) index) bits)
            (aref (memory-facts memory) (+ (* +most-facts+ index) count)) face-list
            (aref (memory-counts memory) index) (1+ count))
      (when (zerop count)
        (wake-rules memory index))
      t)))

(defun remember (memory predicate face-list)
  "Put into MEMORY that PREDICATE is true of the faces of FACE-LIST, a list of as many faces as
those of PREDICATE have.  True if it was not there."
  (declare (type face-list face-list))
  (assert (= (face-list-count face-list) (predicate-arity predicate)) (face-list)
          "~a takes ~d different surface~:p, not those of ~a" (predicate-text predicate)
          (predicate-arity predicate) (face-list-names face-list))
  (put-fact memory predicate face-list))

(defmacro do-facts ((fact memory index) &body body)
  "Run BODY with FACT each face list of the predicate INDEX, in the order in which they were
remembered.  BODY must remember nothing."
  (let ((start (gensym)) (place (gensym)))
    `(let ((,start (* +most-facts+ ,index)))
       (declare (type (unsigned-byte 32) ,start))
       (loop for ,place of-type (unsigned-byte 32)
               from ,start below (+ ,start (aref (memory-counts ,memory) ,index))
             do (let ((,fact (aref (memory-facts ,memory) ,place)))
                  (declare (type face-list ,fact))
                  ,@body)))))

(defun facts (memory predicate)
  "Return the face lists of PREDICATE in MEMORY, in the order in which they were remembered."
  (let ((list '()))
    (do-facts (fact memory (predicate-index predicate))
      (push fact list))
    (nreverse list)))

(deftype saved-facts ()
  "What a memory holds, in one vector: face lists, and above each the index of its predicate."
  '(simple-array (unsigned-byte 62) (*)))

(defun save-facts (memory)
  "Return all that MEMORY holds in one vector, for RESTORE-FACTS."
  (declare (type memory memory))
  (let* ((used (memory-used memory))
         (count (loop for i of-type fixnum below (memory-used-count memory)
                      sum (aref (memory-counts memory) (aref used i)) of-type fixnum))
         (saved (make-array count :element-type '(unsigned-byte 62)))
         (place 0))
    (declare (fixnum count place))
    (dotimes (i (memory-used-count memory) saved)
      (let ((index (aref used i)))
        (declare (type (unsigned-byte 24) index))
        (do-facts (fact memory index)
          (setf (aref saved place) (logior fact (ash index 24)))
          (incf place))))))

(defun restore-facts (memory predicates saved)
  "Put what SAVE-FACTS has SAVED into MEMORY, whose PREDICATES are those of its rule base."
  (loop for fact across (the saved-facts saved)
        do (put-fact memory (svref predicates (ash fact -24)) (ldb (byte 24 0) fact))))

(defun assertions (memory predicates)
  "Return the contents of MEMORY as the paper has it: one list a predicate, its words followed by
all its lists of surfaces, as strings."
  (loop for predicate across predicates
        for facts = (facts memory predicate)
        when facts
          collect (append (predicate-words predicate)
                          (and (plusp (predicate-arity predicate))
                               (mapcar #'face-list-names facts)))))
