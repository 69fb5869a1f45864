;;;; oracle.lisp -- a naive reference implementation of SUPER-GRIP, to test the real one against.
;;;;
;;;; It shares nothing with src/.  Facts, bindings and candidates are lists; nothing is indexed,
;;;; cached or avoided, only the forms of the grasp file are compiled once per knowledge.
;;;; Inside, every name of a rule, grasp or box is a symbol of this package; results hold strings.

(defpackage #:supergrip-oracle
  (:use #:cl)
  (:shadow #:sqrt #:expt)
  (:export #:load-oracle-knowledge #:make-oracle-knowledge #:with-oracle-rules
           #:oracle-plan #:oracle-try #:oracle-run-rules #:oracle-initial-facts
           #:oracle-transcript))

(in-package #:supergrip-oracle)

;;;; ---------------------------------------------------------------- names and numbers

(defun double (number)
  "Return NUMBER as a double-float."
  (coerce number 'double-float))

(defun own (form)
  "Return FORM with its symbols and strings as symbols of this package, its ratios and floats as
doubles."
  (typecase form
    (cons (cons (own (car form)) (own (cdr form))))
    ((or symbol string) (intern (string-upcase form) '#:supergrip-oracle))
    ((or ratio float) (double form))
    (t form)))

(defun names (tree)
  "Return TREE with the name of each symbol, other than NIL, in its place."
  (typecase tree
    (cons (cons (names (car tree)) (names (cdr tree))))
    (null '())
    (symbol (symbol-name tree))
    (t tree)))

(defun same-elements-p (list1 list2)
  "True if LIST1 and LIST2 hold the same symbols, whatever their order."
  (and (= (length list1) (length list2))
       (every (lambda (item) (= (count item list1) (count item list2))) list1)))

;;;; ---------------------------------------------------------------- knowledge

(defstruct grasp
  "A grasp of the database.  FORMS is a function of u, v, and the functions DIST and CONSTRAINED;
it returns a plist with one function of no arguments for each property to be computed."
  name used contact-faces symmetries forms)

(defstruct knowledge
  "RULES, a list of rule forms; GRIPPER, a plist of dimensions; GRASPS, a list of GRASP."
  rules gripper grasps)

(defun read-forms (file)
  "Return the list of forms in FILE."
  (with-open-file (stream file)
    (with-standard-io-syntax
      (let ((*package* (find-package '#:supergrip-oracle))
            (*read-eval* nil)
            (*read-default-float-format* 'double-float))
        (loop for form = (read stream nil stream)
              until (eq form stream)
              collect form)))))

(defun load-oracle-knowledge (rules-file grasps-file)
  "Return the knowledge in the two files."
  (make-oracle-knowledge :rules (read-forms rules-file) :grasps (read-forms grasps-file)))

(defun make-oracle-knowledge (&key rules grasps)
  "Return the knowledge in RULES and GRASPS, lists of the forms that the two files hold."
  (loop with gripper = '() and helpers = '() and listings = '()
        for (operator name . rest) in (own grasps)
        do (cond ((eq operator 'defun) (push (cons name rest) helpers))
                 ((eq name 'gripper) (setf gripper (second (first rest))))
                 (t (push (cons name (second (first rest))) listings)))
        finally (return (make-knowledge
                         :rules (own rules)
                         :gripper gripper
                         :grasps (loop for (name . properties) in (reverse listings)
                                       collect (parse-grasp name properties gripper helpers))))))

(defun with-oracle-rules (rules knowledge)
  "Return a copy of KNOWLEDGE with the rule forms RULES; the compiled grasps are shared."
  (let ((copy (copy-knowledge knowledge)))
    (setf (knowledge-rules copy) (own rules))
    copy))

(defun find-grasp (name knowledge)
  "Return the grasp called NAME, a symbol or string."
  (or (find name (knowledge-grasps knowledge) :key #'grasp-name :test #'string-equal)
      (error "There is no grasp ~A." name)))

;;;; ---------------------------------------------------------------- rules

;;; A fact is a cons of a list of words and a list of faces.

(defparameter *faces* '(z2 z1 y2 y1 x2 x1)
  "The faces of the box, in the order in which everything enumerates them.")

(defun sentence (clause)
  "Return CLAUSE as a fact, its NO or NOT taken out; the second value is true if it had one."
  (let* ((words (remove-if #'listp clause))
         (positive (remove 'not (remove 'no words))))
    (values (cons positive (find-if #'consp clause))
            (< (length positive) (length words)))))

(defun known-p (fact facts)
  "True if FACT is among FACTS, the order of its faces apart."
  (some (lambda (other)
          (and (equal (car fact) (car other)) (same-elements-p (cdr fact) (cdr other))))
        facts))

(defun permutations (list)
  "Return the permutations of LIST in the lexicographic order of its positions."
  (if (null list)
      (list '())
      (loop for (item . after) on list
            for before = '() then (append before (list previous))
            for previous = item
            append (loop for rest in (permutations (append before after))
                         collect (cons item rest)))))

(defun variable-p (item)
  "True if ITEM of a clause's list is a variable, not a face."
  (char= #\S (char (symbol-name item) 0)))

(defun instance (pattern bindings)
  "Return PATTERN with its variables replaced by the faces that they are bound to."
  (loop for item in pattern
        collect (cond ((not (variable-p item)) item)
                      ((cdr (assoc item bindings)))
                      (t (error "The variable ~A is not bound." item)))))

(defun distinct-p (pattern bindings)
  "True if no variable of PATTERN is bound to a face that PATTERN names as well."
  (loop for item in pattern
        never (and (variable-p item) (member (cdr (assoc item bindings)) pattern))))

(defun extensions (pattern bindings)
  "Return BINDINGS extended by the variables of PATTERN in all ways, the leftmost outermost."
  (let ((new (find-if (lambda (item) (and (variable-p item) (not (assoc item bindings))))
                      pattern)))
    (cond (new (loop for face in *faces*
                     unless (rassoc face bindings)
                       append (extensions pattern (acons new face bindings))))
          ((distinct-p pattern bindings) (list bindings)))))

(defun unify (pattern faces bindings)
  "Return a list of the one extension of BINDINGS that makes PATTERN into FACES, or of none."
  (loop for item in pattern
        for face in faces
        for value = (if (variable-p item) (cdr (assoc item bindings)) item)
        do (cond ((eq value face))
                 ((or value (rassoc face bindings)) (return '()))
                 (t (push (cons item face) bindings)))
        finally (return (when (distinct-p pattern bindings) (list bindings)))))

(defun match-positive (pattern bindings facts)
  "Return the extensions of BINDINGS under which the fact PATTERN is one of FACTS."
  (loop for (words . faces) in facts
        when (and (equal words (car pattern)) (= (length faces) (length (cdr pattern))))
          append (loop for permutation in (permutations faces)
                       append (unify (cdr pattern) permutation bindings))))

(defun match-negated (pattern bindings facts)
  "Return the extensions of BINDINGS under which the fact PATTERN is none of FACTS."
  (loop for extended in (extensions (cdr pattern) bindings)
        unless (known-p (cons (car pattern) (instance (cdr pattern) extended)) facts)
          collect extended))

(defun rule-bindings (clauses facts)
  "Return all bindings under which CLAUSES hold of FACTS, in depth-first order."
  (let ((all (list '())))
    (dolist (clause clauses all)
      (multiple-value-bind (pattern negated) (sentence clause)
        (setf all (loop for bindings in all
                        append (if negated
                                   (match-negated pattern bindings facts)
                                   (match-positive pattern bindings facts))))))))

(defun oracle-run-rules (rules facts try)
  "Run RULES, a list of rule forms, on FACTS, a list of sentences such as (SMALL (Y2 Y1)).

TRY is called with the name of a grasp, a symbol, and six faces or ?, or NIL.  The result is a
plist: :END is :KEEP, :CANT or, if the rules ran out, NIL; :REASON the words of CANT; :LOG a list
of (rule . fact), as strings, in the order in which the facts were remembered."
  (let ((facts (mapcar #'sentence (own facts)))
        (log '()))
    (labels ((finish (end &optional reason)
               (return-from oracle-run-rules
                 (list :end end :reason (names reason) :log (reverse log))))
             (remember (rule words faces)
               ;; A variable may have taken a face that the action names: no list then.
               (unless (or (/= (length faces) (length (remove-duplicates faces)))
                           (known-p (cons words faces) facts))
                 (setf facts (append facts (list (cons words faces))))
                 (push (names `(,rule ,@words ,@(when faces (list faces)))) log)))
             (act (rule operator arguments bindings)
               (ecase operator
                 (remember (destructuring-bind (words . pattern) (sentence arguments)
                             (remember rule words (instance pattern bindings))))
                 (try (destructuring-bind (grasp &optional suggestion) arguments
                        (funcall try grasp (instance suggestion bindings))))
                 (keep (finish :keep))
                 (cant (finish :cant (remove-if #'listp arguments))))))
      (loop for (nil name (nil . clauses) (nil . actions))
            in (remove 'input (own rules) :key #'first)
            for all = (rule-bindings clauses facts)
            do (loop for (operator . arguments) in actions
                     do (dolist (bindings all)
                          (act name operator arguments bindings))))
      (finish nil))))

;;;; ---------------------------------------------------------------- the forms of a grasp

(defparameter *labels* '(n1 n2 o1 o2 a1 a2)
  "The faces as a grasp names them, in the order of matchings, suggestions and offsets.")

(defun sqrt (x)
  "Return the root of X as a double.  A negative X is an arithmetic error, not a complex root."
  (if (minusp x)
      (error 'arithmetic-error :operation 'sqrt :operands (list x))
      (cl:sqrt (double x))))

(defun expt (base power)
  "Return BASE to the POWER as a double.  A complex result is an arithmetic error."
  (let ((result (cl:expt (double base) power)))
    (if (realp result)
        result
        (error 'arithmetic-error :operation 'expt :operands (list base power)))))

(defun finite-double (number)
  "Return NUMBER as a double; an infinite one is an arithmetic error."
  (let ((double (double number)))
    (if (<= (abs double) most-positive-double-float)
        double
        (error 'floating-point-overflow :operation 'double :operands (list number)))))

(defun prefix (condition)
  "Return CONDITION, infix with AND and OR associating to the right, as a Lisp form."
  (cond ((atom condition) condition)
        ((null (rest condition)) (prefix (first condition)))
        ((member (first condition) '(and or not))
         (cons (first condition) (mapcar #'prefix (rest condition))))
        ((member (second condition) '(and or))
         (list (second condition) (prefix (first condition)) (prefix (cddr condition))))
        ((member (second condition) '(< <= = >= >))
         (list (second condition) (first condition) (third condition)))
        (t condition)))

(defun six (entries)
  "Return a form for ENTRIES, six forms or one form whose value is a list of six."
  (if (member (first entries) '(let let* list cond if))
      entries
      `(list ,@entries)))

(defun forms-lambda (properties gripper helpers)
  "Return the lambda expression whose function is the FORMS of a grasp with PROPERTIES."
  (let ((dimensions (loop for (name value) on gripper by #'cddr
                          collect (list name (double value)))))
    `(lambda (u v dist constrained)
       ;; Safety 3, or the compiler would leave out what nobody uses, errors included.
       (declare (ignorable u v) (optimize (safety 3)))
       ;; The labels name themselves, since CONDITIONS does not quote them.
       (let (,@dimensions ,@(loop for label in *labels* collect `(,label ',label)))
         (declare (ignorable ,@(mapcar #'first dimensions) ,@*labels*))
         (labels ((dist (pair) (funcall dist (first pair)))
                  (constrained (label) (funcall constrained label))
                  (posit (x) (max x 0))
                  ,@helpers)
           (declare (ignorable #'dist #'constrained #'posit
                               ,@(loop for (name) in helpers collect `(function ,name))))
           (list :conditions (lambda () ,(prefix (getf properties 'conditions t)))
                 :offset (lambda () ,(six (getf properties 'offset)))
                 :wrench (lambda () ,(six (getf properties 'wrench)))
                 :twist (lambda () ,(six (getf properties 'twist)))
                 :contacts (lambda () (list ,@(loop for (nil p q) in (getf properties 'contacts)
                                                    append (list p q))))))))))

(defun quietly-compile (lambda-expression)
  "Return the function of LAMBDA-EXPRESSION; what the compiler thinks of a data file is lost."
  (let ((*error-output* (make-broadcast-stream)))
    (handler-bind ((warning #'muffle-warning))
      (compile nil lambda-expression))))

(defun turn (six positions)
  "Return the elements of SIX, a list, that stand at POSITIONS."
  (loop for position in positions collect (nth position six)))

(defun joined-by (operator form)
  "Return what FORM joins by OPERATOR, AND or OR, at any depth."
  (if (and (consp form) (eq (first form) operator))
      (loop for part in (rest form) append (joined-by operator part))
      (list form)))

(defun in-order (forms)
  (sort (copy-list forms) #'string< :key #'prin1-to-string))

(defun constrained-after (form positions used helpers)
  "Return FORM, its helpers opened, where CONSTRAINED asks for the faces that stand at POSITIONS; of
the faces USED none is.  What AND, OR, + and * join is put into one order."
  (labels ((after (form) (constrained-after form positions used helpers))
           (label-of (form) (if (consp form) (second form) form)))
    (cond ((atom form) form)
          ((eq (first form) 'constrained)
           (let ((label (label-of (second form))))
             (if (member label used)
                 nil
                 `(constrained ,(nth (position label *labels*) (turn *labels* positions))))))
          ((member (first form) '(and or))
           (cons (first form) (in-order (mapcar #'after (joined-by (first form) form)))))
          ((member (first form) '(+ *)) (cons (first form) (in-order (mapcar #'after (rest form)))))
          ((assoc (first form) helpers)
           (list* (after (third (assoc (first form) helpers))) (mapcar #'after (rest form))))
          (t (mapcar #'after form)))))

(defun same-when-turned-p (properties positions used helpers)
  "True if no form of PROPERTIES tells the turn to POSITIONS by what it asks for CONSTRAINED."
  (loop for form in (list (prefix (getf properties 'conditions t)) (getf properties 'offset)
                          (getf properties 'wrench) (getf properties 'twist)
                          (getf properties 'contacts))
        always (equal (constrained-after form '(0 1 2 3 4 5) used helpers)
                      (constrained-after form positions used helpers))))

(defun symmetries (used contact-faces properties helpers)
  "Return the turns, as lists of positions, that carry USED and CONTACT-FACES onto themselves:
the half-turn about A, and the two third-turns about the corner of N1, O1 and A1; but not those that
forms of PROPERTIES tell."
  (flet ((kept-p (faces positions)
           (same-elements-p faces (loop for face in faces
                                        collect (nth (position face *labels*)
                                                     (turn *labels* positions))))))
    (loop for positions in '((1 0 3 2 4 5) (2 3 4 5 0 1) (4 5 0 1 2 3))
          when (and (kept-p used positions) (kept-p contact-faces positions)
                    (same-when-turned-p properties positions used helpers))
            collect positions)))

(defun parse-grasp (name properties gripper helpers)
  "Return the grasp NAME with the property list PROPERTIES."
  (let ((used (remove-duplicates (getf properties 'used-surfaces)))
        (faces (mapcar #'first (getf properties 'contacts))))
    (make-grasp :name name
                :used used
                :contact-faces faces
                :symmetries (symmetries used (remove-duplicates faces) properties helpers)
                :forms (quietly-compile (forms-lambda properties gripper helpers)))))

;;;; ---------------------------------------------------------------- matchings

;;; A matching is the list of the box faces that N1 N2 O1 O2 A1 A2 are.

(defun axis (name)
  "Return 0, 1 or 2 for a face of the box on X, Y, Z or of a grasp on N, O, A."
  (mod (position (char (symbol-name name) 0) "XYZNOA") 3))

(defun side (name)
  "Return 1 for a face on the + side of its axis, -1 for one on the - side."
  (if (char= #\1 (char (symbol-name name) 1)) 1 -1))

(defun face (axis side)
  "Return the face of the box on AXIS and SIDE."
  (find-if (lambda (face) (and (= axis (axis face)) (= side (side face)))) *faces*))

(defun matching (n1 a1)
  "Return the matching with N1 and A1 as given, its O the vector product of A and N."
  (let* ((n (axis n1))
         (a (axis a1))
         (o1 (face (- 3 n a)
                   (* (side a1) (side n1) (if (= 1 (mod (- n a) 3)) 1 -1)))))
    (loop for face in (list n1 o1 a1)
          append (list face (face (axis face) (- (side face)))))))

(defparameter *matchings*
  (loop for n1 in *faces*
        append (loop for a1 in *faces*
                     unless (= (axis n1) (axis a1))
                       collect (matching n1 a1)))
  "The 24 proper rotations, in the order in which they are tried.")

(defun matched-face (label matching)
  "Return the face of the box that LABEL is in MATCHING."
  (nth (position label *labels*) matching))

(defun box-order (triple matching)
  "Return TRIPLE, a value each for N O A, in the order X Y Z."
  (loop with axes = (mapcar #'axis (list (first matching) (third matching) (fifth matching)))
        for axis below 3
        collect (nth (position axis axes) triple)))

(defun vector-to-box (vector matching)
  "Return VECTOR, three coordinates along N O A, along X Y Z."
  (box-order (loop for (face) on matching by #'cddr
                   for coordinate in vector
                   collect (+ 0d0 (* (side face) coordinate))) ; no -0.0 is left
             matching))

(defun capacities-to-box (six matching)
  "Return SIX, capacities along and about N O A, along and about X Y Z.  They have no sign."
  (append (box-order (subseq six 0 3) matching)
          (box-order (subseq six 3 6) matching)))

;;;; ---------------------------------------------------------------- the box

(defstruct (box (:constructor make-box (size weight u v constrained force velocity facts down
                                             mass-centre)))
  "A box: three sizes in cm; its task, six needs each of force and of velocity; facts of its own;
the direction of gravity, a unit vector, and where it acts, from the box centre."
  size weight u v constrained force velocity facts down mass-centre)

(defun cross (a b)
  "Return the vector product of A and B."
  (loop for i below 3
        for j = (mod (+ i 1) 3)
        for k = (mod (+ i 2) 3)
        collect (- (* (nth j a) (nth k b)) (* (nth k a) (nth j b)))))

(defun turned-by (quaternion vector)
  "Return VECTOR turned by QUATERNION, any but 0: q v q* / |q|^2."
  (destructuring-bind (x y z w) quaternion
    (let* ((axis (list x y z))
           (twice (mapcar (lambda (c) (* 2 c)) (cross axis vector)))
           (square (reduce #'+ (mapcar #'* quaternion quaternion))))
      (mapcar (lambda (v side along) (+ v (/ (+ (* w side) along) square)))
              vector twice (cross axis twice)))))

(defun down-of (pose)
  "Return where the world's -Z points in the frame of a box of POSE, (place quaternion) or NIL."
  (if (null pose)
      (list 0d0 0d0 -1d0)
      (destructuring-bind (x y z w) (mapcar #'double (second pose))
        (turned-by (list (- x) (- y) (- z) w) (list 0d0 0d0 -1d0)))))

(defun plain-p (box)
  "True if BOX stands on Z2 and its mass is at its centre."
  (and (equal (box-down box) '(0d0 0d0 -1d0)) (every #'zerop (box-mass-centre box))))

(defun parse-box (description)
  "Return the box of DESCRIPTION, an alist as in the paper."
  (flet ((entry (name)
           (rest (assoc name description :test #'string-equal))))
    (make-box (mapcar #'double (entry 'size))
              (double (first (entry 'weight)))
              (double (first (entry 'u)))
              (double (first (entry 'v)))
              (own (entry 'constrained))
              (mapcar #'double (first (entry 'force-needed)))
              (mapcar #'double (first (entry 'velocity-needed)))
              (facts-in-order (own (entry 'facts)))
              (down-of (entry 'pose))
              (mapcar #'double (or (entry 'centre) '(0 0 0))))))

(defun facts-in-order (facts)
  "Return FACTS, sentences, each list of faces and then the lists themselves in the order of
*FACES*."
  (flet ((place (face) (position face *faces*)))
    (let ((ordered (loop for fact in facts
                         collect (loop for part in fact
                                       collect (if (consp part)
                                                   (sort (copy-list part) #'< :key #'place)
                                                   part)))))
      (stable-sort ordered #'string<
                   :key (lambda (fact)
                          (format nil "~{~d~}" (mapcar #'place (find-if #'consp fact))))))))

(defun distance (face box)
  "Return the size of BOX along the axis of FACE."
  (nth (axis face) (box-size box)))

(defun initial-facts (box gripper)
  "Return the sentences that hold of BOX before any rule runs."
  (let ((pairs '((z2 z1) (y2 y1) (x2 x1))))
    (flet ((pairs-where (predicate test dimension)
             (loop for pair in pairs
                   when (funcall test
                                 (distance (first pair) box) (double (getf gripper dimension)))
                     collect (list predicate pair))))
      (append (loop for pair in pairs collect (list 'opposed pair))
              (pairs-where 'small #'< 'finger-width)
              (pairs-where 'narrow #'< 'finger-spread)
              (pairs-where 'large #'>= 'dist-pinch)
              (loop for face in *faces*
                    when (member face (box-constrained box))
                      collect (list 'constrained (list face)))
              (when (<= (box-u box) (double (getf gripper 'slippery-u)))
                (list (list 'slippery)))
              (box-facts box)))))

(defun oracle-initial-facts (box knowledge)
  "Return the sentences that hold of BOX, an alist, before any rule runs."
  (initial-facts (parse-box box) (knowledge-gripper knowledge)))

;;;; ---------------------------------------------------------------- one candidate

(defun forms-for (grasp matching box)
  "Return the plist of functions that compute the properties of GRASP under MATCHING."
  (funcall (grasp-forms grasp)
           (box-u box)
           (box-v box)
           (lambda (label) (distance (matched-face label matching) box))
           (lambda (label) (member (matched-face label matching) (box-constrained box)))))

(defun computed (property forms)
  "Return the list of doubles that is PROPERTY, or :FAILED after an arithmetic error."
  (handler-case (mapcar #'finite-double (funcall (getf forms property)))
    (arithmetic-error () :failed)))

(defun conditions-hold-p (forms)
  "True if the CONDITIONS among FORMS hold; an arithmetic error counts as no."
  (handler-case (funcall (getf forms :conditions))
    (arithmetic-error () nil)))

(defun grasp-centre (entries)
  "Return the grasp centre in the frame N O A for ENTRIES, the value of OFFSET, or NIL."
  (flet ((opposite-p (e1 e2)
           (<= (abs (+ e1 e2)) (* 1d-9 (+ 1 (max (abs e1) (abs e2)))))))
    (unless (eq entries :failed)
      (when (loop for (e1 e2) on entries by #'cddr always (opposite-p e1 e2))
        (loop for (e1 e2) on entries by #'cddr collect (/ (- e1 e2) 2))))))

(defun contact-point (label p q centre halves)
  "Return the contact on face LABEL at P and Q from CENTRE along the other axes, all in N O A."
  (let ((own (axis label)))
    (loop with along = (list p q)
          for axis below 3
          collect (if (= axis own)
                      (* (side label) (nth axis halves))
                      (+ (pop along) (nth axis centre))))))

(defun inside-p (point halves)
  "True if POINT is nowhere beyond HALVES, half the sizes of the box."
  (every (lambda (coordinate half) (<= (abs coordinate) (* half (+ 1 1d-9)))) point halves))

(defun contact-points (grasp forms centre halves)
  "Return the contact points in the frame N O A, or :FAILED if one is not inside its face."
  (let ((places (computed :contacts forms)))
    (if (eq places :failed)
        :failed
        (let ((points (loop for label in (grasp-contact-faces grasp)
                            for (p q) on places by #'cddr
                            collect (contact-point label p q centre halves))))
          (if (every (lambda (point) (inside-p point halves)) points)
              points
              :failed)))))

(defun moments (offset vector)
  "Return |oY| vZ + |oZ| vY and so on cyclically, for OFFSET o and VECTOR v."
  (loop for i below 3
        for j = (mod (+ i 1) 3)
        for k = (mod (+ i 2) 3)
        collect (+ (* (abs (nth j offset)) (nth k vector))
                   (* (abs (nth k offset)) (nth j vector)))))

(defun force-needs (box offset)
  "Return the six needs of force of BOX at OFFSET: the torques grow."
  (let ((forces (subseq (box-force box) 0 3))
        (torques (subseq (box-force box) 3 6)))
    (append forces (mapcar #'+ torques (moments offset forces)))))

(defun velocity-needs (box offset)
  "Return the six needs of velocity of BOX at OFFSET: the linear ones grow."
  (let ((linear (subseq (box-velocity box) 0 3))
        (angular (subseq (box-velocity box) 3 6)))
    (append (mapcar #'+ linear (moments offset angular)) angular)))

(defun gravity-load (box offset)
  "Return the six loads that the weight of BOX puts on a grasp at OFFSET."
  (let ((force (mapcar (lambda (part) (* (box-weight box) part)) (box-down box)))
        (arm (mapcar #'- (box-mass-centre box) offset)))
    (mapcar #'abs (append force (cross arm force)))))

(defun radius (capacities needs)
  "Return the least ratio of CAPACITIES to NEEDS where there is a need, NIL if there is none."
  (loop for capacity in capacities
        for need in needs
        when (plusp need)
          minimize (/ capacity need) into least and count t into needed
        finally (return (when (plusp needed) least))))

(defun quality (u-w u-t gamma)
  "Return the quality index of the radii U-W and U-T, either of which may be NIL."
  (cond ((and u-w u-t) (+ (* gamma u-t) (* (- 1 gamma) u-w)))
        (t (or u-w u-t 0d0))))

(defun try-matching (grasp matching box gamma)
  "Return the candidate, a plist, that GRASP is under MATCHING."
  (let ((forms (forms-for grasp matching box))
        (halves (loop for label in '(n1 o1 a1)
                      collect (/ (distance (matched-face label matching) box) 2)))
        (results '()))
    (flet ((finish (outcome)
             (return-from try-matching
               (list* :grasp (names (grasp-name grasp)) :matching (names matching)
                      :outcome outcome results)))
           (note (&rest more)
             (setf results (append results more))))
      (unless (conditions-hold-p forms)
        (finish :conditions))
      (let* ((centre (or (grasp-centre (computed :offset forms)) (finish :offset)))
             (offset (vector-to-box centre matching))
             (points (contact-points grasp forms centre halves))
             (wrench (computed :wrench forms))
             (twist (computed :twist forms)))
        (note :offset offset)
        (when (eq points :failed)
          (finish :fingers))
        (note :contacts (loop for point in points
                              for label in (grasp-contact-faces grasp)
                              collect (list (vector-to-box point matching)
                                            (names (matched-face label matching)))))
        (when (or (eq wrench :failed) (eq twist :failed) (notevery #'plusp wrench))
          (finish :open))
        (let* ((wrench (capacities-to-box wrench matching))
               (twist (capacities-to-box twist matching))
               (load (gravity-load box offset))
               (u-w (radius (mapcar #'- wrench load) (force-needs box offset)))
               (u-t (radius twist (velocity-needs box offset))))
          (note :wrench wrench :twist twist)
          ;; The axes share the same friction, so what they bear is shared as well.
          (when (> (reduce #'+ (mapcar #'/ load wrench)) 1)
            (finish :lifting))
          (note :q (quality u-w u-t gamma) :u-w u-w :u-t u-t)
          (finish :possible))))))

;;;; ---------------------------------------------------------------- TRY and the plan

(defun valid-p (matching grasp suggestion box)
  "True if MATCHING agrees with SUGGESTION and GRASP uses no constrained face in it."
  (and (every (lambda (face suggested) (member suggested (list '? face)))
              matching
              (or suggestion '(? ? ? ? ? ?)))
       (notany (lambda (label) (member (matched-face label matching) (box-constrained box)))
               (grasp-used grasp))))

(defun same-centre-p (grasp box matching other)
  "True if the centre of GRASP on BOX is the same place in MATCHING and in OTHER."
  (flet ((centre (matching)
           (let ((centre (grasp-centre (computed :offset (forms-for grasp matching box)))))
             (and centre (vector-to-box centre matching)))))
    (let ((one (centre matching)) (two (centre other)))
      (or (and (null one) (null two))
          (and one two (every (lambda (a b) (< (abs (- a b)) 1d-9)) one two))))))

(defun tried-p (matching grasp box tried)
  "True if MATCHING, or one that is the same grip of BOX by a symmetry of GRASP, is in TRIED."
  (or (member matching tried :test #'equal)
      (loop for positions in (grasp-symmetries grasp)
            for other = (turn matching positions)
              thereis (and (member other tried :test #'equal)
                           ;; To which side the centre lies matters only where gravity acts askew.
                           (or (plain-p box) (same-centre-p grasp box matching other))))))

(defun oracle-try (grasp-name box knowledge &key (gamma 0.5d0) (skip-equivalents t))
  "Return the candidates of one grasp on BOX, an alist, under all valid matchings."
  (loop with grasp = (find-grasp grasp-name knowledge)
        with box = (parse-box box)
        with tried = '()
        for matching in *matchings*
        when (and (valid-p matching grasp nil box)
                  (not (and skip-equivalents (tried-p matching grasp box tried))))
          collect (try-matching grasp matching box gamma)
          and do (push matching tried)))

(defun best-candidate (candidates)
  "Return the possible one of CANDIDATES with the highest Q, the first of those within 1e-9."
  (let ((possible (remove :possible candidates
                          :key (lambda (candidate) (getf candidate :outcome))
                          :test-not #'eq)))
    (flet ((q (candidate) (getf candidate :q)))
      (when possible
        (let ((highest (reduce #'max possible :key #'q)))
          (find-if (lambda (candidate) (>= (q candidate) (- highest 1d-9))) possible))))))

(defun oracle-plan (box knowledge &key (gamma 0.5d0))
  "Return the plan for BOX, an alist as in the paper, as a plist.

:VERDICT     :GRASP or :CANT; rules that run out without KEEP or CANT keep the best
:REASON      the words of the rule that said CANT, else NIL
:LOG         what the rules remembered, a list of (rule . fact)
:CANDIDATES  all that was tried, in order, each a plist of :GRASP, :MATCHING, :OUTCOME, :OFFSET,
             :CONTACTS, :WRENCH, :TWIST, :Q, :U-W, :U-T as far as it came; in the box frame
:BEST        the winner among them, or NIL"
  (let ((box (parse-box box))
        (tried (make-hash-table))
        (candidates '()))
    (flet ((try (name suggestion)
             (loop with grasp = (find-grasp name knowledge)
                   for matching in *matchings*
                   when (and (valid-p matching grasp suggestion box)
                             (not (tried-p matching grasp box (gethash grasp tried))))
                     do (push matching (gethash grasp tried))
                        (push (try-matching grasp matching box gamma) candidates))))
      (destructuring-bind (&key end reason log)
          (oracle-run-rules (knowledge-rules knowledge)
                            (initial-facts box (knowledge-gripper knowledge))
                            #'try)
        (let* ((candidates (reverse candidates))
               (best (unless (eq end :cant) (best-candidate candidates))))
          (list :verdict (if best :grasp :cant)
                :reason reason
                :log log
                :candidates candidates
                :best best))))))

;;;; ---------------------------------------------------------------- the paper's lines

(defun decimals (q)
  "Return Q with three decimals."
  (let ((thousandths (round (* 1000 (rational q)))))
    (format nil "~:[~;-~]~D.~3,'0D" (minusp thousandths)
            (floor (abs thousandths) 1000) (mod (abs thousandths) 1000))))

(defun short-decimals (q)
  "Return Q with at most three decimals, and at least one."
  (let* ((text (decimals q))
         (point (position #\. text)))
    (subseq text 0 (max (+ point 2) (1+ (position #\0 text :test-not #'char=
                                                           :from-end t))))))

(defun oracle-transcript (result)
  "Return the lines of the paper's session for RESULT, a plan: facts first, then O.K. grasps."
  (destructuring-bind (&key verdict reason log candidates best) result
    (append
     (loop for (rule . fact) in log
           collect (format nil "(RULE ~A SAYS ~{~A~^ ~})" rule fact))
     (loop for candidate in candidates
           when (eq :possible (getf candidate :outcome))
             collect (format nil "(~A IS O.K. Q=~A, MATCHING: ~A)" (getf candidate :grasp)
                             (decimals (getf candidate :q)) (getf candidate :matching)))
     (case verdict
       (:grasp (list (format nil "(BEST GRASP IS ~A WITH MATCHING ~A)"
                             (getf best :grasp) (getf best :matching))
                     (format nil "(THE QUALITY INDEX IS ~A)" (short-decimals (getf best :q)))))
       (:cant (list (format nil "(CANT~{ ~A~})" reason))))
     (list "--END--"))))
