;;;; false-conditions.lisp -- which parts of a grasp's conditions are false, and by how much, in
;;;; words.

(in-package :supergrip)

;;; Nodes

(defun node-comparison (node) (first (node-args node)))
(defun comparison-nodes (node) (rest (node-args node)))

(defun comparison-operands (node grasp registers)
  "Return the values of the two operands of NODE, a comparison in the conditions of GRASP, on
REGISTERS, which hold what box and matching give.  NIL if one has no value."
  (declare (type registers registers))
  (let* ((program (cdr (assoc node (grasp-comparisons grasp) :test #'eq)))
         (results (program-results program)))
    (and (has-value-p program registers)
         (values (aref registers (aref results 0)) (aref registers (aref results 1))))))

(defun has-value-p (program registers)
  "Run PROGRAM on REGISTERS.  True if it has a value."
  (handler-case (execute program registers)
    (arithmetic-error () nil)))

(defun body-of (node)
  "Return the node whose value NODE has."
  (if (eq (node-kind node) :let) (body-of (second (node-args node))) node))

(defun operands-of (node name)
  "Return the operands of NODE if it is the operation NAME, or NIL."
  (let ((node (body-of node)))
    (and (eq (node-kind node) :operation)
         (eq (first (node-args node)) (find-operator name))
         (rest (node-args node)))))

(defun input-of (node)
  "Return the register of NODE if it is what the box gives, or NIL."
  (let ((node (body-of node)))
    (and (eq (node-kind node) :input) (first (node-args node)))))

;;; Faults

(defstruct fault
  "A part of conditions that is false.  NODE is the test, which should be false if NEGATED.  NUMBERS
are the two that it compares; ALTERNATIVES, of parts of which one would do, a list of the faults of
each.  SHORTFALL is how far off it is: 0 to 1, relative; 1 where that can't be said."
  node negated (numbers '()) (alternatives '()) (shortfall 1))

(defun relative-difference (a b)
  "Return by how much the doubles A and B differ, 0 to 1, relative to the greater."
  (declare (double-float a b))
  (let ((most (max (abs a) (abs b))))
    (if (zerop most) 0d0 (min 1d0 (abs (- (/ a most) (/ b most)))))))

(defun faults (node negated grasp registers)
  "Return the faults of NODE, a test of GRASP that should be true, or false if NEGATED, on
REGISTERS, which hold what box and matching give: all that would have to change for it to be as it
should."
  (flet ((fault-if (false &rest more)
           (and false (list (apply #'make-fault :node node :negated negated more))))
         (joined (all) (joined-faults node negated all grasp registers)))
    (node-case (:test node)
      (:true () (fault-if negated))
      (:false () (fault-if (not negated)))
      (:not (test) (faults test (not negated) grasp registers))
      (:and () (joined (not negated)))
      (:or () (joined negated))
      (:constrained (grasp-face)
        (fault-if (eq negated (= 1d0 (aref registers (+ +blocked+ grasp-face))))))
      (:comparison ()
        (multiple-value-bind (a b) (comparison-operands node grasp registers)
          (if a
              (fault-if (eq negated (comparison-true-p (node-comparison node) a b))
                        :numbers (list a b) :shortfall (relative-difference a b))
              (fault-if t)))))))

(defun joined-faults (node negated all grasp registers)
  "Return the faults of NODE, which joins tests: of each, if ALL must be as they should, else of
one."
  (if all
      (loop for test in (node-args node) append (faults test negated grasp registers))
      (let ((alternatives (loop for test in (node-args node)
                                for faults = (or (faults test negated grasp registers)
                                                 (return-from joined-faults '()))
                                append (or (flat-alternatives faults) (list faults)))))
        (list (make-fault :node node :negated negated :alternatives alternatives
                          :shortfall (loop for faults in alternatives
                                           minimize (worst-shortfall faults)))))))

(defun flat-alternatives (faults)
  (and (null (rest faults)) (fault-alternatives (first faults))))

(defun worst-shortfall (faults)
  (loop for fault in faults maximize (fault-shortfall fault)))

(defun candidate-faults (candidate workspace)
  "Return the faults of the conditions of CANDIDATE, the worst first; WORKSPACE is at its box."
  (let ((grasp (%candidate-grasp candidate)))
    (place-box workspace (%candidate-matching candidate))
    (stable-sort (faults (draft-conditions (grasp-draft grasp)) nil grasp
                         (workspace-registers workspace))
                 #'> :key #'fault-shortfall)))

;;; What is compared

(defun distance-axis (node)
  "Return the axis, 0 to 2, if NODE is the distance of two opposite faces, or NIL."
  (let ((register (input-of node)))
    (and register (<= +distances+ register (+ +distances+ 2)) (- register +distances+))))

(defun half-axis (node)
  "Return the axis if NODE is half the distance of two opposite faces, or NIL."
  (flet ((half (a b number)
           (and (constant-p b) (= (constant-value b) number) (distance-axis a))))
    (destructuring-bind (&optional a b) (or (operands-of node "/") (operands-of node "*"))
      (cond ((null b) nil)
            ((operands-of node "/") (half a b 2))
            (t (or (half a b 0.5d0) (half b a 0.5d0)))))))

(defun places-axes (node)
  "Return the axes of the two faces if NODE is how far apart their middles are, or NIL."
  (flet ((square (node)
           (destructuring-bind (&optional a b) (operands-of node "*")
             (and b (eql (half-axis a) (half-axis b)) (half-axis a)))))
    (let* ((sum (first (operands-of node "SQRT")))
           (squares (and sum (operands-of sum "+")))
           (axes (mapcar #'square squares)))
      (and (= (length axes) 2) (notany #'null axes) axes))))

(defun plain-operand-p (node)
  "True if NODE is something of the box that has a name in words."
  (or (input-of node) (places-axes node)))

;;; In words

(defun face-of (grasp-face matching)
  (face-name (svref (matching-faces matching) grasp-face)))

(defun touched-face (axis grasp matching)
  "Return the name of the face on AXIS that a finger of GRASP touches, or those of both faces."
  (let ((grasp-faces (remove-duplicates (loop for (grasp-face) in (grasp-contacts grasp)
                                        when (= axis (floor grasp-face 2)) collect grasp-face))))
    (format nil "~{~a~^ or ~}" (loop for grasp-face
                                     in (or grasp-faces (list (* 2 axis) (1+ (* 2 axis))))
                                     collect (face-of grasp-face matching)))))

(defun input-names (node matching)
  "Return in words what of the box NODE is computed from."
  (let ((seen (make-hash-table :test #'eq)) (registers '()))
    (labels ((walk (thing)
               (cond ((consp thing) (mapc #'walk thing))
                     ((not (node-p thing)))
                     ((input-of thing) (pushnew (input-of thing) registers))
                     ((not (gethash thing seen))
                      (setf (gethash thing seen) t)
                      (walk (node-args thing))))))
      (walk node))
    (loop for register in (sort registers #'<)
          collect (cond ((= register +u+) "u")
                        ((= register +v+) "v")
                        (t (axis-faces (- register +distances+) matching))))))

(defun axis-faces (axis matching)
  (format nil "~a ~a" (face-of (* 2 axis) matching) (face-of (1+ (* 2 axis)) matching)))

(defun operand-measure (node)
  "Return what NODE, an operand, measures, or NIL: that is not known of what conditions compute."
  (and (or (distance-axis node) (places-axes node) (eql (input-of node) +v+))
       :length))

(defun operand-words (node figure grasp matching)
  "Return in words that NODE, an operand, is FIGURE."
  (let ((axis (distance-axis node)) (places (places-axes node)) (input (input-of node)))
    (cond (axis (format nil "~a and ~a are ~a apart" (face-of (* 2 axis) matching)
                        (face-of (1+ (* 2 axis)) matching) (with-unit figure :length)))
          (places (format nil "the finger places on ~{~a~^ and ~} are ~a apart"
                          (loop for axis in places collect (touched-face axis grasp matching))
                          (with-unit figure :length)))
          (input (format nil "~:[v~;u~] is ~a" (= input +u+) figure))
          ((constant-p node) (format nil "the number ~a" figure))
          (t (format nil "what the conditions compute from ~{~a~^, ~}~@[, in ~a,~] is ~a"
                     (input-names node matching) (and *units* "cm") figure)))))

(defparameter +demands+
  '(("DIST-PINCH" ("<" "<=") "the hand opens to ~a" "the hand holds less than ~a")
    ("FINGER-WIDTH" (">" ">=") "a fingertip needs ~a" "a fingertip needs more than ~a")
    ("FINGER-SPREAD" (">" ">=") "two fingers side by side need ~a"
     "two fingers side by side need more than ~a")
    ("WIDTH-HAND" (">" ">=") "the hand needs more than ~a" "the hand needs more than ~a"))
  "What a comparison of a distance with a dimension of the gripper asks, in words; and if the two
are equal.")

(defun demand-words (node number op figure other form)
  "Return in words that NODE, which is NUMBER, must be OP, a string, as against FIGURE, the value of
FORM; OTHER is its node.  NUMBER and FIGURE are texts."
  (let* ((name (and (namep form) (constant-p other) (symbol-name form)))
         (demand (and (or (distance-axis node) (places-axes node))
                      (find-if (lambda (row) (and (equal name (first row))
                                                  (member op (second row) :test #'string=)))
                               +demands+))))
    (if demand
        (format nil (if (string= number figure) (fourth demand) (third demand)) figure)
        (format nil "must be ~a ~a~@[ (~a)~]" op figure name))))

(defun operand-forms (form)
  "Return the forms of the two operands of the comparison FORM, infix or prefix."
  (if (named-comparison (first form)) (rest form) (list (first form) (third form))))

(defun demanded-comparison (comparison negated turned)
  "Return in words what is asked for, where COMPARISON should not hold if NEGATED, with its operands
exchanged if TURNED."
  (let ((comparison (if turned (find-operator (comparison-mirror comparison)) comparison)))
    (if negated
        (or (comparison-opposite comparison) (format nil "not ~a" (operator-name comparison)))
        (operator-name comparison))))

(defun turned-p (node)
  "True if NODE, a comparison, is told from the side of its second operand."
  (destructuring-bind (a b) (comparison-nodes node)
    (and (comparison-mirror (node-comparison node)) (not (plain-operand-p a))
         (or (plain-operand-p b) (constant-p a)))))

(defun comparison-parts (fault)
  "Return the operand that the FAULT of a comparison is about, its value, what is asked of it (as
\"<\"), and the other operand, its value and its form."
  (destructuring-bind (a b) (comparison-nodes (fault-node fault))
    (let* ((comparison (node-comparison (fault-node fault)))
           (turned (turned-p (fault-node fault)))
           (nodes (if turned (list b a) (list a b)))
           (numbers (if turned (reverse (fault-numbers fault)) (fault-numbers fault)))
           (forms (operand-forms (node-form (fault-node fault)))))
      (values (first nodes) (first numbers)
              (demanded-comparison comparison (fault-negated fault) turned)
              (second nodes) (second numbers) (if turned (first forms) (second forms))))))

(defun comparison-words (fault grasp matching)
  (multiple-value-bind (node number op other other-number form) (comparison-parts fault)
    (destructuring-bind (text other-text)
        (texts-in-units (operand-measure node) number other-number)
      (format nil "~a, ~a" (operand-words node text grasp matching)
              (demand-words node text op other-text other form)))))

(defun fault-words (fault grasp matching)
  "Return FAULT of GRASP in MATCHING in words, with its figures."
  (let ((node (fault-node fault)))
    (cond ((fault-alternatives fault) (alternatives-words fault grasp matching))
          ((eq (node-kind node) :constrained)
           (format nil "~a is ~:[not ~;~]constrained" (face-of (first (node-args node)) matching)
                   (fault-negated fault)))
          ((fault-numbers fault) (comparison-words fault grasp matching))
          ((eq (node-kind node) :comparison) "a form of CONDITIONS has no value")
          (t (format nil "~a ~:[is never true~;is always true~]" (form-text (node-form node) 60)
                     (fault-negated fault))))))

(defun constrained-face (faults matching)
  "Return the name of the face if FAULTS say no more than that one is constrained, or NIL."
  (let ((node (fault-node (first faults))))
    (and (null (rest faults)) (eq (node-kind node) :constrained) (fault-negated (first faults))
         (face-of (first (node-args node)) matching))))

(defun alternatives-words (fault grasp matching)
  "Return in words that none of the alternatives of FAULT is as it should be."
  (let ((faces '()) (others '()))
    (dolist (faults (fault-alternatives fault))
      (let ((face (constrained-face faults matching)))
        (if face
            (push face faces)
            (push (faults-words faults grasp matching) others))))
    (when faces
      (push (format nil "~{~a~#[~; and ~:;, ~]~} ~[~;is~;are both~:;are all~] constrained"
                    (reverse faces) (length faces))
            others))
    (format nil "~{~a~^, and ~}" (reverse others))))

(defparameter +most-faults+ 8 "How many faults of one candidate are told.")

(defun faults-words (faults grasp matching)
  "Return FAULTS in words."
  (let ((left (- (length faults) +most-faults+)))
    (format nil "~{~a~^; ~}~[~:;; and ~:*~d more~]"
            (loop for fault in faults repeat +most-faults+
                  collect (fault-words fault grasp matching))
            (max 0 left))))

(defun describe-condition-failure (candidate workspace)
  "Return all that is false in the conditions of CANDIDATE, the worst first."
  (faults-words (or (candidate-faults candidate workspace)
                    (return-from describe-condition-failure "a form of CONDITIONS has no value"))
                (%candidate-grasp candidate) (%candidate-matching candidate)))

;;; A miss that one thing explains

(defun clear-p (faults)
  "True if FAULTS are one comparison of something that has a name with a number."
  (and faults (null (rest faults)) (fault-numbers (first faults))
       (let ((node (fault-node (first faults))))
         (destructuring-bind (a b) (comparison-nodes node)
           (if (turned-p node)
               (and (plain-operand-p b) (constant-p a))
               (and (plain-operand-p a) (constant-p b)))))))

(defun free-widths (box)
  "Return the sizes of BOX along the axes whose two faces are free."
  (loop for axis below 3
        for faces = (loop for face below 6 when (= axis (face-axis face)) collect face)
        when (notany (lambda (face) (logbitp face (%box-constrained box))) faces)
          collect (aref (%box-size box) axis)))

(defun too-wide-text (candidate workspace)
  "Return that the narrowest free pair of faces is too wide for CANDIDATE, if that is why it
failed."
  (let ((faults (candidate-faults candidate workspace)))
    (when (clear-p faults)
      (multiple-value-bind (node number op other limit form) (comparison-parts (first faults))
        (let ((axis (distance-axis node)))
          (when (and axis (member op '("<" "<=") :test #'string=)
                     (= number (reduce #'min (free-widths (workspace-box workspace))
                                       :initial-value most-positive-double-float)))
            (destructuring-bind (text limit-text) (texts-in-units :length number limit)
              (format nil "the narrowest free pair, ~a, is ~a; ~a"
                      (char "XYZ" (aref (matching-axes (%candidate-matching candidate)) axis))
                      (with-unit text :length)
                      (demand-words node text op limit-text other form)))))))))
