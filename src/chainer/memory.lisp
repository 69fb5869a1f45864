;;;; memory.lisp -- predicates and the working memory: remember and recall.

(in-package :supergrip-chainer)

(defstruct predicate
  "What a sentence says of its surfaces.  WORDS are its strings, ARITY the number of surfaces that
its lists have (0 for an ordinary predicate such as OBJECT HAS FREE CORNERS), INDEX its number in
its rule base.  GIVEN is true if the input provides it."
  (words '() :type list)
  (arity 0 :type (integer 0 6))
  (index 0 :type (unsigned-byte 24))
  (given nil))

(defun predicate-text (predicate)
  "Return the words of PREDICATE as one string."
  (format nil "~{~a~^ ~}" (predicate-words predicate)))

;;; What is remembered of a predicate is kept twice: as bits, to test, and in order, to walk.

(deftype relations () '(simple-array (unsigned-byte 64) (*)))
(deftype links () '(simple-array (unsigned-byte 62) (*)))
(deftype packs () '(simple-array (unsigned-byte 32) (*)))

(defstruct (memory (:constructor %make-memory))
  "A working memory.  RELATIONS holds, for each predicate, the bits of what is remembered (see
FACT-BITS).  FACTS holds the lists as they were remembered, from place 1: a packed list, and above
it the place of the predicate's next, or 0; ENDS holds the places of each predicate's first and
last, or 0, and FREE is the first place without one.  BINDINGS holds the FOUND bindings of the rule
being run.  LOG holds the events of a run, the newest first.  CLIENT is whatever the actions of the
lower level need."
  (relations nil :type relations)
  (facts nil :type links)
  (ends nil :type packs)
  (free 1 :type (unsigned-byte 32))
  (bindings nil :type packs)
  (found 0 :type fixnum)
  (log '() :type list)
  (client nil))

(defun make-memory (predicates &optional client)
  "Return an empty memory for PREDICATES, a vector in the order of their indices."
  (declare (simple-vector predicates))
  (let ((count (length predicates)))
    (%make-memory :relations (make-array count :element-type '(unsigned-byte 64)
                                               :initial-element 0)
                  :ends (make-array (* 2 count) :element-type '(unsigned-byte 32)
                                                :initial-element 0)
                  :facts (make-array 24 :element-type '(unsigned-byte 62))
                  :bindings (make-array 16 :element-type '(unsigned-byte 32))
                  :client client)))

(declaim (inline fact-bits known-p))
(defun fact-bits (arity packed)
  "Return the bits that stand for the faces of PACKED, in any order, among the facts of a predicate
of ARITY: for one face that of the face, so that six bits are the set of them; for two, a and b, the
bits 6a+b and 6b+a, so that the six bits from 6a are the set of the partners of a; for more the bit
whose number is the set."
  (declare (type (integer 0 6) arity) (type packed packed))
  (the (unsigned-byte 64)
       (case arity
         (0 1)
         (1 (pack-mask packed))
         (2 (let ((a (pack-ref packed 0)) (b (pack-ref packed 1)))
              (declare (type surface a b))
              (logior (ash 1 (+ (* 6 a) b)) (ash 1 (+ (* 6 b) a)))))
         (t (ash 1 (pack-mask packed))))))

(defun known-p (memory index bits)
  (declare (type memory memory) (fixnum index) (type (unsigned-byte 64) bits))
  (logtest bits (aref (memory-relations memory) index)))

(defun recall (memory predicate packed)
  "True if MEMORY holds that PREDICATE is true of the faces of PACKED, in any order."
  (known-p memory (predicate-index predicate) (fact-bits (predicate-arity predicate) packed)))

(declaim (inline link-fact link-next))
(defun link-fact (link)
  (declare (type (unsigned-byte 62) link))
  (ldb (byte 24 0) link))

(defun link-next (link)
  (declare (type (unsigned-byte 62) link))
  (ash link -24))

(defun append-fact (memory index packed)
  "Put PACKED after the last fact of the predicate INDEX."
  (declare (type memory memory) (type (unsigned-byte 24) index) (type packed packed))
  (let* ((place (memory-free memory))
         (ends (memory-ends memory))
         (last (aref ends (1+ (* 2 index)))))
    (when (= place (length (memory-facts memory)))
      (setf (memory-facts memory)
            (replace (make-array (* 2 place) :element-type '(unsigned-byte 62))
                     (memory-facts memory))))
    (let ((facts (memory-facts memory)))
      (setf (aref facts place) packed)
      (if (zerop last)
          (setf (aref ends (* 2 index)) place)
          (setf (aref facts last) (logior (aref facts last) (ash place 24)))))
    (setf (aref ends (1+ (* 2 index))) place
          (memory-free memory) (1+ place))))

(declaim (inline remember))
(defun remember (memory predicate packed)
  "Put into MEMORY that PREDICATE is true of the faces of PACKED.  True if it was not there."
  (declare (type memory memory) (type predicate predicate) (type packed packed))
  (let ((index (predicate-index predicate))
        (bits (fact-bits (predicate-arity predicate) packed)))
    (unless (known-p memory index bits)
      (setf (aref (memory-relations memory) index)
            (logior (aref (memory-relations memory) index) bits))
      (append-fact memory index packed)
      t)))

(defmacro do-facts ((fact memory index) &body body)
  "Run BODY with FACT each packed list of the predicate INDEX, in the order in which they were
remembered.  BODY must remember nothing."
  (let ((facts (gensym)) (place (gensym)) (link (gensym)))
    `(let ((,facts (memory-facts ,memory))
           (,place (aref (memory-ends ,memory) (* 2 ,index))))
       (declare (type (unsigned-byte 38) ,place))
       (loop until (zerop ,place)
             do (let* ((,link (aref ,facts ,place))
                       (,fact (link-fact ,link)))
                  (setf ,place (link-next ,link))
                  ,@body)))))

(defun facts (memory predicate)
  "Return the packed lists of PREDICATE in MEMORY, in the order in which they were remembered."
  (let ((list '()))
    (do-facts (fact memory (predicate-index predicate))
      (push fact list))
    (nreverse list)))

(defun assertions (memory predicates)
  "Return the contents of MEMORY as the paper has it: one list a predicate, its words followed by
all its lists of surfaces, as strings."
  (loop for predicate across predicates
        for facts = (facts memory predicate)
        when facts
          collect (append (predicate-words predicate)
                          (and (plusp (predicate-arity predicate)) (mapcar #'pack-names facts)))))
