;;;; from-contacts.lisp -- parts of a grasp that are derived: its offset from how far the hand
;;;; reaches, its WRENCH and TWIST from its contacts.
;;;;
;;;; WRENCH FROM-CONTACTS gives twelve entries: along and about N O A, then the same against them,
;;;; since gravity has one direction.  Contacts are given about the grasp centre.

(in-package :supergrip)

(defparameter +axis-names+ #("N" "O" "A"))

(defstruct placement
  "Where a grasp puts the hand, as far as its description is read: the grasp faces USED, that of the
PALM, CONTACTS as PARSE-CONTACTS returns them, and OFFSET, a node of six, in SCOPE."
  (used '() :type list) palm (contacts '() :type list) offset scope)

;;; Words in place of forms: one row each

(defvar *part-words* '() "Lists of a key, a word that may be its value, what it gives, and a
function of a placement and the form that returns the node, or NIL after a complaint.")

(defmacro define-part-word ((key word) gives (placement form) &body body)
  "Let WORD be a value of KEY of a grasp; BODY returns its node.  GIVES says what it is, for
DESCRIBE-GRASP."
  `(setf *part-words* (with-row (list '(,key ,word) ,gives
                                      (lambda (,placement ,form)
                                        (declare (ignorable ,form))
                                        ,@body))
                                *part-words* #'first)))

(defun part-word (key value)
  "Return the row of VALUE, a word of KEY, or NIL."
  (and (namep value)
       (find-if (lambda (row) (and (string= key (first (first row)))
                                   (name= value (second (first row)))))
                *part-words*)))

(defun part-words (key)
  "Return the words that may be the value of KEY."
  (loop for ((row-key word)) in *part-words* when (string= key row-key) collect word))

(defun words-hint (key)
  "Return the phrase that says which words KEY may have, \"; WRENCH FROM-CONTACTS computes it\"."
  (format nil "~{; ~a ~a computes it~}" (loop for word in (part-words key) append (list key word))))

(defun lone-word (value)
  "Return the name that VALUE is, or that is all of the list VALUE; or NIL."
  (cond ((namep value) value)
        ((and (consp value) (namep (first value)) (null (rest value))) (first value))))

(defun constant-reach (reach scope)
  "Return the number that REACH, a number or a form in SCOPE, is for every box; NIL if it is none,
or is wrong, which is complained of elsewhere."
  (let ((node (values (with-problems (parse-form reach scope :number)))))
    (and node (constant-p node) (constant-value node))))

(defun check-reach (axis reach scope)
  "Complain if REACH, along AXIS, is the same for every box and not above 0; warn if it is above all
lengths of the gripper in SCOPE.  Return true if it is good."
  (let ((number (constant-reach reach scope)) (name (svref +axis-names+ axis))
        (hand (longest-dimension (loop for (name . node) in (scope-dimensions scope)
                                       collect (cons name (constant-value node))))))
    (cond ((null number) t)
          ((not (plusp number))
           (complain reach "the reach along ~a is ~a, but must be above 0" name
                     (if (realp reach)
                         (form-text reach)
                         (format nil "~a, ~a" (form-text reach) (number-text number)))))
          ((and hand (> number (cdr hand)))
           (complain *form* '(:warning "the reach along ~a is ~a cm, and the hand's greatest ~
                                        dimension is ~a, ~a; where the hand reaches that far, let ~
                                        the gripper name how far")
                     name (if (realp reach) (form-text reach) (number-text number)) (car hand)
                     (number-text (cdr hand)))
           t)
          (t t))))

(defun within-form-p (name form)
  "True if NAME, a string, stands in the list FORM."
  (and (consp form)
       (some (lambda (part) (or (name= part name) (within-form-p name part))) form)))

(defun buried-word (key value)
  "Return the word of KEY that stands within the list VALUE, where no word may, or NIL."
  (find-if (lambda (word) (within-form-p word value)) (part-words key)))

(defun complain-of-word (key value)
  "Complain that VALUE, a name or the list of one, is no value of KEY."
  (complain value "~a is not a list of six entries~a~a" (form-text value)
            (suggestion (lone-word value) (part-words key)) (words-hint key)))

;;; Nodes

(defun six-entries (node)
  "Return the six nodes of numbers of NODE, which gives six."
  (node-case (:six node)
    (:list (&rest entries) entries)
    (:let (nodes body)
      (loop for entry in (six-entries body) collect (let-node nodes entry (node-form node))))
    (:cond (&rest clauses)
      (let ((values (loop for (nil value) in clauses collect (six-entries value))))
        (loop for i below 6
              collect (make-node :kind :cond :form (node-form node)
                                 :args (loop for (test) in clauses
                                             for entries in values
                                             collect (list test (nth i entries)))))))
    (:computed () (error "OFFSET is not computed"))))

(defun number-node (operator a b scope)
  "Return the node of OPERATOR, a name, on A and B, nodes or numbers."
  (flet ((node-of (x) (if (realp x) (constant-node scope x) x)))
    (operation-node (find-operator operator) (list (node-of a) (node-of b)) *form* scope)))

(defun centre-nodes (placement)
  "Return the nodes of the grasp centre along N O A from the box centre."
  (let ((scope (placement-scope placement)))
    (loop for (plus minus) on (six-entries (placement-offset placement)) by #'cddr
          collect (number-node "*" 0.5d0 (number-node "-" plus minus scope) scope))))

(defun face-node (grasp-face placement)
  "Return the node of the place of GRASP-FACE on its axis, from the grasp centre."
  (let ((axis (floor grasp-face 2)) (scope (placement-scope placement)))
    (number-node "-" (number-node "*" (if (evenp grasp-face) 0.5d0 -0.5d0)
                                  (input-node (+ +distances+ axis)) scope)
                 (nth axis (centre-nodes placement)) scope)))

(defun contact-nodes (placement)
  "Return the nodes of the places of the contacts along N O A, from the grasp centre: three each."
  (loop for (grasp-face p q) in (placement-contacts placement)
        for others = (list p q)
        append (loop for axis below 3
                     collect (if (= axis (floor grasp-face 2))
                                 (face-node grasp-face placement)
                                 (pop others)))))

(defun computed-node (name count function nodes form &optional rising)
  "Return the node of the COUNT numbers that FUNCTION computes of those of NODES, a vector; NIL if
one of them is NIL.  They never fall as one of the nodes RISING rises."
  (unless (member nil nodes)
    (flet ((varies-p (node) (not (constant-p node))))
      (let* ((varying (remove-if-not #'varies-p nodes))
             (numbers (map 'numbers (lambda (node) (if (constant-p node) (constant-value node) 0d0))
                           nodes))
             (computation (make-computation
                           :name name :function function :count count :numbers numbers
                           :places (loop for node in nodes for place from 0
                                         when (varies-p node) collect place)
                           :rising (loop for node in varying collect (and (member node rising) t))
                           :components (make-array count))))
        (dotimes (i count)
          (setf (svref (computation-components computation) i) (make-component computation i)))
        (make-node :kind :computed :args (cons computation varying) :form form)))))

;;; What the statics compute

(defun inward-normal (grasp-face)
  "Return the inward normal of GRASP-FACE along N O A, a three."
  (let ((normal (make-three)))
    (setf (aref normal (floor grasp-face 2)) (if (evenp grasp-face) -1d0 1d0))
    normal))

(defun contact-normals (placement)
  (loop for (grasp-face) in (placement-contacts placement) collect (inward-normal grasp-face)))

(define-part-word ("WRENCH" "FROM-CONTACTS")
    "WRENCH is what the contacts exert, exactly, each way along and about N O A."
    (placement form)
  (let ((normals (contact-normals placement)) (u (input-node +u+)) (v (input-node +v+)))
    (computed-node "WRENCH FROM-CONTACTS" 12
                   (lambda (numbers) (grip-entries (grip-of numbers normals)))
                   (list* u v (contact-nodes placement))
                   form (list u v))))

(defun grip-of (numbers normals)
  "Return the grip of u, v and the places of fingers in NUMBERS, three each, with the inward
NORMALS."
  (declare (type numbers numbers))
  (let ((grip (make-grip (length normals) (aref numbers 0) (aref numbers 1))))
    (loop for normal of-type three in normals
          for index from 0
          for place = (+ 2 (* 3 index))
          do (set-finger grip index
                         (aref numbers place) (aref numbers (+ place 1)) (aref numbers (+ place 2))
                         (aref normal 0) (aref normal 1) (aref normal 2)))
    grip))

(define-part-word ("TWIST" "FROM-CONTACTS")
    "TWIST is how well two-link fingers at the contacts move the box."
    (placement form)
  (let ((scope (placement-scope placement)) (palm (placement-palm placement))
        (normals (contact-normals placement)))
    (flet ((dimension-node (name)
             (or (cdr (assoc name (scope-variables scope) :test #'string=))
                 (complain form "TWIST FROM-CONTACTS needs ~a of the gripper" name))))
      (computed-node "TWIST FROM-CONTACTS" 6
                     (let ((approach (inward-normal palm)))
                       (lambda (numbers) (mobility-of numbers normals approach)))
                     (list* (number-node "*" (if (evenp palm) 1d0 -1d0)
                                         (face-node palm placement) scope)
                            (dimension-node "FINGER-LENGTH") (dimension-node "FINGER-DIST")
                            (contact-nodes placement))
                     form))))

(defun mobility-of (numbers normals approach)
  "Return the mobility, a vector of six, for NUMBERS: how far the palm's face is, a finger's length,
the distance of the bases, and the places of the fingers, three each."
  (declare (type numbers numbers))
  (coerce (mobility (loop for place from 3 below (length numbers) by 3
                          collect (subseq numbers place (+ place 3)))
                    normals approach (aref numbers 0) (aref numbers 1) (aref numbers 2))
          'numbers))

;;; How far the hand reaches

(defun pair-names (axis)
  "Return the names of the two grasp faces of AXIS, 0 to 2."
  (list (svref +grasp-faces+ (* 2 axis)) (svref +grasp-faces+ (1+ (* 2 axis)))))

(defun distance-form (axis)
  `(:dist (:quote ,(pair-names axis))))

(defparameter +reach-word+ "FROM-FINGERS" "The word that may stand in place of a length in REACH.")

(defun complain-of-axis (name value)
  "Complain that NAME, in the REACH VALUE, is no axis; what is a face was meant to be its axis."
  (let ((face (and (namep name) (grasp-face-index name))))
    (complain value "~a is not an axis~@[ (did you mean ~a?)~]: REACH is along N, O or A"
              (form-text name) (and face (svref +axis-names+ (floor face 2))))))

(defun reach-entries (value)
  "Return the list of (AXIS . REACH) that VALUE, axes and reaches in turn, gives; or complain."
  (if (or (not (listp value)) (oddp (length value)))
      (complain value "~a: REACH gives axes and lengths in turn, such as (N 4.85 A 4.85) or (A ~
                       ~a)~a"
                (form-text value) +reach-word+
                (suggestion (lone-word value) (list +reach-word+)))
      (let ((entries (loop for (name reach) on value by #'cddr
                           collect (cons (and (namep name)
                                              (position name +axis-names+ :test #'name=))
                                         reach))))
        (loop for (axis . reach) in entries
              for (name) on value by #'cddr
              do (cond ((null axis)
                        (return (complain-of-axis name value)))
                       ((/= 1 (count axis entries :key #'car))
                        (return (complain value "the reach along ~a is given twice" name))))
              finally (return entries)))))

(defun side-reached (axis placement)
  "Return the grasp face that the hand comes over along AXIS, or complain: that of the palm, or the
one used."
  (let* ((faces (list (* 2 axis) (1+ (* 2 axis)))) (names (pair-names axis))
         (used (intersection faces (placement-used placement))))
    (cond ((find (placement-palm placement) faces))
          ((= 1 (length used)) (first used))
          (t (complain *form* "the hand does not come over ~a or ~a, since ~:[neither is~;both ~
                               are~] used; leave the reach along ~a out"
                       (first names) (second names) used (svref +axis-names+ axis))))))

(defun finger-reach-form (axis placement)
  "Return the form of the offset along AXIS that the links of two opposed fingers leave, or
complain.  The outer link lies along the face; the inner one adds depth where the box is narrower
than the distance between the bases.  Source: the paper, OFFSET of PINCH-2-PARALLEL."
  (let* ((faces (remove-duplicates (mapcar #'first (placement-contacts placement))))
         (pairs (loop for other below 3
                      when (and (/= other axis)
                                (subsetp (list (* 2 other) (1+ (* 2 other))) faces))
                        collect other)))
    (if (/= 1 (length pairs))
        (complain *form* "FROM-FINGERS along ~a needs fingers on two opposite faces of one other ~
                          axis; write a length instead"
                  (svref +axis-names+ axis))
        (let ((closing (distance-form (first pairs))))
          `(:let* ((:r (:/ (:- ,closing :finger-dist) 2))
                   (:depth (:sqrt (:- (:expt :finger-length 2) (:expt :r 2)))))
                  (:posit (:- (:/ ,(distance-form axis) 2) :finger-length
                              (:cond ((:> :finger-dist ,closing) :depth)
                                     (:t 0)))))))))

(defun missing-reach-form (axis reach placement)
  "Return the form of what half the box along AXIS has more than REACH, or NIL after a complaint."
  (let ((names (mapcar #'car (scope-variables (placement-scope placement)))))
    (cond ((name= reach +reach-word+) (finger-reach-form axis placement))
          ((and (namep reach) (not (name-in reach names)))
           (complain reach "~a is not a length~a; a reach is ~a, a number, or a form of the ~
                            gripper's dimensions"
                     reach (suggestion reach (cons +reach-word+ names)) +reach-word+))
          ((within-form-p +reach-word+ reach)
           (complain reach "~a: ~a stands alone, in place of a length" (form-text reach)
                     +reach-word+))
          ((check-reach axis reach (placement-scope placement))
           `(:posit (:- (:/ ,(distance-form axis) 2) ,reach))))))

(defun reach-form (value placement)
  "Return the form of the OFFSET that REACH VALUE leaves, or NIL after a complaint."
  (let* ((entries (reach-entries value))
         (sides (loop for (axis) in entries collect (side-reached axis placement)))
         (forms (loop for (axis . reach) in entries
                      collect (missing-reach-form axis reach placement)))
         (names (loop for (axis) in entries collect (nth axis '(:n :o :a)))))
    (and entries (notany #'null sides) (notany #'null forms)
         `(:let ,(mapcar #'list names forms)
                (:list ,@(loop for face below 6
                               for place = (position (floor face 2) sides
                                                     :key (lambda (side) (floor side 2)))
                               for name = (and place (nth place names))
                               collect (cond ((null place) 0)
                                             ((eql face (nth place sides)) name)
                                             (t `(:- ,name)))))))))
