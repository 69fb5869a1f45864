;;;; memory.lisp -- predicates and the working memory: remember and recall.

(in-package :supergrip-chainer)

(defstruct predicate
  "What a sentence says of its surfaces.  WORDS are its strings, ARITY the number of surfaces that
its lists have (0 for an ordinary predicate such as OBJECT HAS FREE CORNERS), INDEX its number in
its rule base and START the place of its facts in a memory.  GIVEN is true if the input provides
it."
  (words '() :type list)
  (arity 0 :type (integer 0 6))
  (index 0 :type fixnum)
  (start 0 :type fixnum)
  (given nil))

(defun predicate-text (predicate)
  "Return the words of PREDICATE as one string."
  (format nil "~{~a~^ ~}" (predicate-words predicate)))

(defun predicate-room (predicate)
  "Return how many different facts PREDICATE can have: its lists are unordered."
  (aref #(1 6 15 20 15 6 1) (predicate-arity predicate)))

(deftype bitmaps () '(simple-array (unsigned-byte 64) (*)))
(deftype packs () '(simple-array (unsigned-byte 32) (*)))
(deftype counts () '(simple-array (unsigned-byte 8) (*)))

(defstruct (memory (:constructor %make-memory))
  "A working memory.  For each predicate BITMAPS holds which sets of faces are remembered (bit m
for the set m of six bits; bit 0 for an ordinary predicate), COUNTS how many, and FACTS the lists
as they were remembered, in order.  BINDINGS holds the FOUND
bindings of the rule being run.  LOG holds the events of a run, the newest first.  CLIENT is
whatever the actions of the lower level need."
  (bitmaps nil :type bitmaps)
  (counts nil :type counts)
  (facts nil :type packs)
  (bindings nil :type packs)
  (found 0 :type fixnum)
  (log '() :type list)
  (client nil))

(defun make-memory (predicates &optional client)
  "Return an empty memory for PREDICATES, a vector in the order of their indices."
  (declare (simple-vector predicates))
  (let ((last (if (plusp (length predicates)) (svref predicates (1- (length predicates))))))
    (%make-memory :bitmaps (make-array (length predicates) :element-type '(unsigned-byte 64)
                                                           :initial-element 0)
                  :counts (make-array (length predicates) :element-type '(unsigned-byte 8)
                                                          :initial-element 0)
                  :facts (make-array (if last (+ (predicate-start last) (predicate-room last)) 0)
                                     :element-type '(unsigned-byte 32))
                  :bindings (make-array 32 :element-type '(unsigned-byte 32))
                  :client client)))

(declaim (inline known-p))
(defun known-p (memory index mask)
  (declare (type memory memory) (fixnum index) (type (unsigned-byte 6) mask))
  (logbitp mask (aref (memory-bitmaps memory) index)))

(defun recall (memory predicate packed)
  "True if MEMORY holds that PREDICATE is true of the faces of PACKED, in any order."
  (known-p memory (predicate-index predicate) (pack-mask packed)))

(declaim (inline remember))
(defun remember (memory predicate packed)
  "Put into MEMORY that PREDICATE is true of the faces of PACKED.  True if it was not there."
  (declare (type memory memory) (type predicate predicate) (type packed packed)
          )
  (let* ((index (predicate-index predicate))
         (mask (pack-mask packed))
         (count (aref (memory-counts memory) index)))
    (unless (known-p memory index mask)
      (setf (aref (memory-bitmaps memory) index)
            (logior (aref (memory-bitmaps memory) index) (the (unsigned-byte 64) (ash 1 mask)))
            (aref (memory-facts memory) (+ (predicate-start predicate) count)) packed
            (aref (memory-counts memory) index) (1+ count))
      t)))

(defun facts (memory predicate)
  "Return the packed lists of PREDICATE in MEMORY, in the order in which they were remembered."
  (loop for i from (predicate-start predicate)
        repeat (aref (memory-counts memory) (predicate-index predicate))
        collect (aref (memory-facts memory) i)))

(defun assertions (memory predicates)
  "Return the contents of MEMORY as the paper has it: one list a predicate, its words followed by
all its lists of surfaces, as strings."
  (loop for predicate across predicates
        for facts = (facts memory predicate)
        when facts
          collect (append (predicate-words predicate)
                          (and (plusp (predicate-arity predicate)) (mapcar #'pack-names facts)))))
