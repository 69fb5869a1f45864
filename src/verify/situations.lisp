;;;; situations.lisp -- all that rules can tell apart, each with the smallest box that shows it.

(in-package :supergrip)

(defparameter *situation-limit* 1000000
  "The most situations that are gone through one by one; of more, *SITUATION-SAMPLE* are drawn.")
(defparameter *situation-sample* 50000 "How many situations are drawn where there are too many.")
(defparameter *situation-seed* 1 "The seed with which situations are drawn.")

(defstruct (domain (:constructor %make-domain (views quantities facts)))
  "The situations that VIEWS can tell apart.  QUANTITIES are all numbers of a box; DIGITS those of
more than one class; FACTS is the list of the facts of its own that a box may have.  SIZE is the
number of combinations: of classes, of the 64 sets of constrained faces, and of the sets of FACTS.
An index below it stands for one.  ATOMS is a table from what may be seen to its number, PLAIN the
values of a plain box."
  (views '() :type list) (quantities '() :type list) (facts '() :type list)
  (digits '() :type list)
  (size 0 :type integer)
  (sampled nil)
  (atoms (make-hash-table)) (plain (plain-values)))

(defun sets-of-faces (count)
  "Return the face lists of COUNT faces, one for each set of them."
  (loop for set below 64
        when (= (logcount set) count)
          collect (make-face-list (loop for face below 6 when (logbitp face set) collect face))))

(defun possible-facts (knowledges)
  "Return the facts of its own that a box may have and that a rule of KNOWLEDGES tests, a list."
  (let ((kinds (loop for knowledge in knowledges
                     append (loop for predicate in (tested-declarations knowledge)
                                  collect (cons (predicate-text predicate)
                                                (predicate-arity predicate))))))
    (loop for (words . arity) in (remove-duplicates kinds :test #'equal)
          append (loop for face-list in (sets-of-faces arity)
                       collect (make-box-fact words face-list nil)))))

(defun make-domain (&rest knowledges)
  "Return the domain of what the rules of KNOWLEDGES can tell apart."
  (let* ((quantities (all-quantities))
         (facts (possible-facts knowledges))
         (domain (%make-domain (mapcar #'make-view knowledges) quantities facts)))
    (classify quantities (domain-views domain))
    (setf (domain-digits domain)
          (remove-if-not (lambda (quantity) (rest (quantity-classes quantity))) quantities)
          (domain-size domain)
          (reduce #'* (domain-digits domain) :initial-value (* 64 (expt 2 (length facts)))
                  :key (lambda (quantity) (length (quantity-classes quantity))))
          (domain-sampled domain) (> (domain-size domain) *situation-limit*))
    domain))

;;; From an index to a box

(defun index-values (domain index)
  "Return the plist of the values of the plainest box that INDEX stands for."
  (multiple-value-bind (rest constrained) (floor index 64)
    (loop with values = (list* :constrained constrained (domain-plain domain))
          for quantity in (domain-digits domain)
          for numbers = (quantity-numbers quantity)
          do (multiple-value-bind (next digit) (floor rest (length numbers))
               (setf rest next)
               (unless (zerop digit)
                 (setf values (values-with values quantity (nth digit numbers)))))
          finally (return (list* :facts (loop for fact in (domain-facts domain)
                                              for place from 0
                                              when (logbitp place rest) collect fact)
                                 values)))))

(defun index-class (domain index quantity)
  "Return the class of QUANTITY, one of those of DOMAIN, that INDEX stands for."
  (loop with rest = (floor index 64)
        for digit in (domain-digits domain)
        for classes = (quantity-classes digit)
        when (eq digit quantity)
          return (nth (mod rest (length classes)) classes)
        do (setf rest (floor rest (length classes)))
        finally (return (first (quantity-classes quantity)))))

(defun index-box (domain index)
  "Return the plainest box that INDEX stands for."
  (make-box (index-values domain index) nil))

(defun call-with-indices (domain function)
  "Call FUNCTION with each index of DOMAIN, or with those of a sample."
  (if (domain-sampled domain)
      (loop with state = (seeded-state *situation-seed*)
            repeat *situation-sample*
            do (funcall function (random (domain-size domain) state)))
      (dotimes (index (domain-size domain))
        (funcall function index))))

;;; What is seen, as a set of bits

(defun atom-number (domain key)
  (let ((atoms (domain-atoms domain)))
    (or (gethash key atoms)
        (setf (gethash key atoms) (hash-table-count atoms)))))

(defun predicate-code (view-number predicate)
  "Return the number that stands for PREDICATE of the view of VIEW-NUMBER in the keys of atoms."
  (+ 1 (* 1000000 view-number) (predicate-index predicate)))

(defun unseen-inputs (domain)
  "Return the names of the preliminary assertions that rules test and that were true of no box that
was looked at."
  (let ((codes (loop for key being the hash-keys of (domain-atoms domain) collect (ash key -6))))
    (remove-duplicates
     (loop for view in (domain-views domain)
           for number from 0
           append (loop for input in (view-inputs view)
                        for predicate = (prepared-input-predicate input)
                        unless (member (predicate-code number predicate) codes)
                          collect (predicate-text predicate)))
     :test #'string=)))

(defun seen-bits (domain box)
  "Return what the views of DOMAIN see of BOX, and which faces of it are constrained, as an integer:
a bit for each atom."
  (let ((bits 0))
    (dotimes (face 6)
      (when (logbitp face (%box-constrained box))
        (setf bits (logior bits (ash 1 (atom-number domain (ash 1 face)))))))
    (loop for view in (domain-views domain)
          for number from 0
          do (loop for (predicate . fact) in (seen-facts view box)
                   for key = (logior (ash (predicate-code number predicate) 6)
                                     (face-list-mask fact))
                   do (setf bits (logior bits (ash 1 (atom-number domain key))))))
    bits))

;;; The symmetries of the box: its rotations.  (A mirror would turn a proper matching into none.)

(defun rotations ()
  "Return the 24 rotations of a box, each a vector from face to face."
  (loop with from = (matching-faces (svref +matchings+ 0))
        for matching across +matchings+
        collect (let ((rotation (make-array 6)))
                  (loop for face across from
                        for to across (matching-faces matching)
                        do (setf (svref rotation face) to))
                  rotation)))

(defun named-faces (form)
  "Return the faces that FORM, a rule, names."
  (cond ((consp form) (union (named-faces (car form)) (named-faces (cdr form))))
        ((and form (namep form) (face-index form)) (list (face-index form)))))

(defun domain-rules (domain)
  "Return the rules of all views of DOMAIN."
  (loop for view in (domain-views domain)
        append (knowledge-rules (view-knowledge view))))

(defun domain-rotations (domain)
  "Return the rotations after which the rules answer alike: those that leave every face that a rule
names where it is; only that which leaves all, if it is not known what rules do."
  (let ((still (if (some #'opaque-p (domain-rules domain))
                   '(0 1 2 3 4 5)
                   (mapcan #'named-faces (mapcar #'rule-form (domain-rules domain))))))
    (remove-if-not (lambda (rotation)
                     (every (lambda (face) (= face (svref rotation face))) still))
                   (rotations))))

(defun turned-mask (mask rotation)
  (loop with turned = 0
        for face below 6
        when (logbitp face mask)
          do (setf turned (logior turned (ash 1 (svref rotation face))))
        finally (return turned)))

(defun turned-atoms (domain rotation)
  "Return the vector from the number of an atom to that of what ROTATION makes of it, or NIL."
  (let ((turned (make-array (hash-table-count (domain-atoms domain)) :initial-element nil)))
    (loop for key being the hash-keys of (domain-atoms domain) using (hash-value number)
          do (setf (svref turned number)
                   (gethash (logior (logandc2 key 63) (turned-mask (logand key 63) rotation))
                            (domain-atoms domain))))
    turned))

(defun turned-bits (bits turned)
  "Return what BITS become where TURNED says what becomes of each atom, or NIL."
  (loop with result = 0
        for number below (integer-length bits)
        when (logbitp number bits)
          do (let ((target (svref turned number)))
               (if target
                   (setf result (logior result (ash 1 target)))
                   (return nil)))
        finally (return result)))

;;; The situations

(defstruct situation
  "What rules can't tell apart.  BOX is the plainest box in it, INDEX stands for it in its
domain; WEIGHT is how many situations it stands for, itself included: those into which a rotation
of the box turns it.  ANSWER is that of the rules, STOP what ended them; FIRED and DONE are as those
of a RUNNER, but DONE is in order."
  index box (weight 0) answer stop fired done)

(defun distinct-indices (domain)
  "Return a table from each set of bits that is seen in DOMAIN to the first index that stands for
it."
  (let ((table (make-hash-table)) (done 0)
        (all (if (domain-sampled domain) *situation-sample* (domain-size domain))))
    (call-with-indices domain
                       (lambda (index)
                         (let ((bits (handler-case (seen-bits domain (index-box domain index))
                                       ;; A test has no value there, so no plan can be made.
                                       (arithmetic-error () nil))))
                           (unless (or (null bits) (gethash bits table))
                             (setf (gethash bits table) index)))
                         (when (zerop (mod (incf done) 1000))
                           (note-progress "boxes looked at" done all))))
    table))

(defun find-situations (domain)
  "Return the situations of DOMAIN, one for all into which rotations turn it, the plainest first;
and how many there are in all."
  (let* ((table (distinct-indices domain))
         (turned (mapcar (lambda (rotation) (turned-atoms domain rotation))
                         (domain-rotations domain)))
         (done (make-hash-table))
         (situations '()))
    (loop for bits being the hash-keys of table using (hash-value index)
          unless (gethash bits done)
            do (let ((situation (make-situation :index index :box (index-box domain index))))
                 (dolist (atoms turned)
                   (let ((other (turned-bits bits atoms)))
                     (when (and other (gethash other table) (not (gethash other done)))
                       (setf (gethash other done) t)
                       (incf (situation-weight situation)))))
                 (push situation situations)))
    (values (stable-sort (reverse situations) #'<
                         :key (lambda (situation) (box-length (situation-box situation))))
            (hash-table-count table))))
