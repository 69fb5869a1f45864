;;;; read-grasps.lisp -- the grasp file: helper functions and grasps, checked.

(in-package :supergrip)

(defstruct grasp
  "A grasp mode.  DEFINITION is the form that was read, USED the list of the grasp faces that it
uses, PALM the one that the palm faces, CONTACTS a list of (GRASP-FACE P Q), P and Q being
registers; PLACES holds the same as axes (0 to 2) and registers in turn, without the axes that the
faces are normal to.  The other parts are PROGRAMs; COMPARISONS is an alist from the comparisons in
CONDITIONS to those of their operands.  DRAFT has the nodes of all parts.
USABLE holds, for each set of constrained faces, the set of the matchings that use none of them;
SAME, for each matching, the set of those that are the same grasp on a box that stands upright,
itself included; SAME-LYING such sets where gravity is along X, Y and Z; SAME-CENTRE, of those of
them whose grasp centre is surely the same place of the box."
  (name "" :type string :read-only t) (index 0 :type fixnum :read-only t)
  (definition nil :read-only t) (draft nil :read-only t)
  (used '() :type list :read-only t) (palm 0 :type fixnum :read-only t)
  (conditions nil :type program :read-only t) (comparisons '() :type list :read-only t)
  (offset nil :type program :read-only t) (positions nil :type program :read-only t)
  (contacts '() :type list :read-only t) (places nil :type register-vector :read-only t)
  (wrench nil :type program :read-only t) (twist nil :type program :read-only t)
  (usable nil :type (matching-sets 64) :read-only t)
  (same nil :type (matching-sets 24) :read-only t)
  (same-lying #() :type simple-vector :read-only t)
  (same-centre nil :type (matching-sets 24) :read-only t))

(defun grasp-form (grasp)
  "Return the form that defines GRASP, (SETQ name '(key value ...)), in whatever shape it was read."
  (destructuring-bind (setq name (quotation list)) (grasp-definition grasp)
    (copy-tree (list setq name (list quotation (canonical-entries list))))))

(defun grasp-properties (grasp)
  "Return the property list that defines GRASP, (key value ...)."
  (second (third (grasp-form grasp))))

(define-printing (grasp grasp) "~a" (grasp-name grasp))

(defstruct graspbase
  "The gripper, the grasps, and the registers that their programs start from.  USES are
the DIMENSION-USEs of grasps, ROWS those of all known dimensions (see +DIMENSIONS+)."
  (gripper (make-gripper) :type gripper :read-only t)
  (uses '() :type list :read-only t) (rows '() :type list :read-only t)
  (grasps '() :type list :read-only t)
  (broken '() :type list :read-only t)  ; names of grasps that were left out
  (registers (make-array +inputs-end+ :element-type 'double-float) :type registers :read-only t))

(define-printing (graspbase graspbase) "~d grasp~:p" (length (graspbase-grasps graspbase)))

(defun find-grasp (graspbase name)
  "Return the grasp of GRASPBASE that has NAME, or NIL."
  (find name (graspbase-grasps graspbase) :key #'grasp-name :test #'string-equal))

(defun dimension (graspbase name)
  "Return the gripper's dimension NAME, a string, as a double."
  (gripper-dimension (graspbase-gripper graspbase) name))

;;; Helper functions

(defparameter +most-helpers+ 1000 "The most helpers that a grasp file may have.")

(defun parse-helper (form scope)
  "Add the helper of FORM, (DEFUN name (parameter...) form), to SCOPE, or complain."
  (let* ((name (and (consp (rest form)) (namep (second form)) (second form)))
         (parameters (and (= (length form) 4) (listp (third form)) (third form)))
         (*subject* (format nil "DEFUN ~a" (if name name "without a name"))))
    (cond ((or (null name) (/= (length form) 4) (not (listp (third form)))
               (notevery #'namep parameters))
           (complain form "a helper is (DEFUN name (parameter...) form)"))
          ((nthcdr +most-helpers+ (scope-functions scope))
           (let ((*subject* nil))
             (complain form "more than ~d helpers" +most-helpers+)))
          ((or (find-operator (symbol-name name))
               (assoc name (scope-functions scope) :test #'name=))
           (complain form "~a is already an operator" name))
          (t
           (let ((inner (copy-scope scope)))
             (dolist (parameter parameters)
               (setf inner (bind-variable inner (symbol-name parameter)
                                          ;; Any number will do: the form is only checked.
                                          (input-node +u+))))
             (if (counting-steps (form) (parse-form (fourth form) inner :number))
                 (push (list* (symbol-name name) (mapcar #'symbol-name parameters) (fourth form))
                       (scope-functions scope))
                 (push (symbol-name name) (scope-broken scope))))))))

;;; Grasps

(defun grasp-entries (list form)
  "Return those entries of LIST that have a value, each a list of its key, the value and the form
that it begins with, complaining of unknown, repeated, empty and missing ones."
  (let ((entries '()))
    (loop for (key parts place) in (split-entries list)
          do (cond ((not (name-in key +grasp-keys+))
                    (complain place "unknown key ~a~a; keys are ~{~a~^, ~}" (form-text key)
                              (suggestion (if (consp key) (first key) key) +grasp-keys+)
                              +grasp-keys+))
                   ((assoc key entries :test #'name=) (complain place "~a is given twice" key))
                   (t (unless parts
                        (complain place "~a has no value; a grasp is a list of keys and values in ~
                                         turn" key))
                      (push (list key (entry-value key parts) place (consp parts)) entries))))
    (check-missing entries form)
    (remove nil entries :key #'fourth)))

(defun check-missing (entries form)
  "Complain of the keys that ENTRIES of a grasp lack, and of two of which one is enough."
  (flet ((given-p (key) (assoc key entries :test #'string=)))
    (dolist (key '("USED-SURFACES" "CONDITIONS"))
      (unless (given-p key) (complain form "~a is missing" key)))
    (cond ((not (given-p "REACH"))
           (unless (given-p "OFFSET")
             (complain form "OFFSET is missing; REACH may take its place, such as REACH (A 4)"))
           (dolist (key '("WRENCH" "TWIST"))
             (unless (given-p key)
               (complain form "~a is missing~a" key (words-hint key)))))
          ((given-p "OFFSET")
           (complain (third (given-p "REACH"))
                     "REACH stands in place of OFFSET; give one of them")))))

(defun parse-used (value)
  (let ((grasp-faces (and (consp value) (mapcar #'grasp-face-index value))))
    (cond ((or (null grasp-faces) (member nil grasp-faces))
           (complain value "~a: USED-SURFACES are some of N1 N2 O1 O2 A1 A2" (form-text value)))
          ((/= (length grasp-faces) (length (remove-duplicates grasp-faces)))
           (complain value "~a: the same surface twice" (form-text value)))
          (t grasp-faces))))

(defun parse-palm (entry used)
  "Return the grasp face of the palm: by default the used face of A.  USED is NIL if it is wrong
itself."
  (let ((grasp-face (if entry
                  (grasp-face-index (second entry))
                  (find-if (lambda (grasp-face) (member grasp-face used)) '(5 4)))))
    (cond ((null grasp-face)
           (complain *form* (if entry "~a: PALM is one of N1 N2 O1 O2 A1 A2"
                              "PALM is missing, and no face of A is used~*")
                     (and entry (form-text (second entry)))))
          ((and used (not (member grasp-face used)))
           (complain *form* "the palm faces ~a, which is not one of USED-SURFACES"
                     (svref +grasp-faces+ grasp-face)))
          (t grasp-face))))

(defun parse-contact (contact used scope)
  "Return (GRASP-FACE NODE NODE) of CONTACT, (FACE P Q), or NIL after a complaint."
  (let ((grasp-face (and (consp contact) (grasp-face-index (first contact)))))
    (cond ((or (null grasp-face) (/= (length contact) 3))
           (complain contact "~a is not a contact: one of N1 N2 O1 O2 A1 A2, and its place on it ~
                              along the two other axes, such as (N1 0 0)" (form-text contact)))
          ((and used (not (member grasp-face used)))
           (complain contact "a finger is on ~a, which is not one of USED-SURFACES"
                     (svref +grasp-faces+ grasp-face)))
          (t (let ((place (parse-forms (rest contact) scope :number)))
               (and place (cons grasp-face place)))))))

(defparameter +most-contacts+ 50 "The most contacts that a grasp may have.")

(defun middle-contacts (grasp-faces)
  "Return the forms of one contact in the middle of each of GRASP-FACES."
  (loop for grasp-face in grasp-faces collect (list (svref +grasp-faces+ grasp-face) 0 0)))

(defun parse-contacts (entry used palm scope)
  "Return the contacts, by default one in the middle of each used face but the palm's."
  (let ((contacts (if entry
                      (and (listp (second entry)) (second entry))
                      (middle-contacts (remove palm used)))))
    (cond ((null contacts) (complain *form* "CONTACTS lists no contact"))
          ((nthcdr +most-contacts+ contacts)
           (complain *form* "CONTACTS lists more than ~d contacts" +most-contacts+))
          (t (loop for (contact . others) on contacts
                   for number from 1
                   for other = (position contact others :test #'equal)
                   when other
                     do (complain *form* '(:warning "contacts ~d and ~d are at the same place: ~
                                                     their forces add up")
                                  number (+ number 1 other)))
             (let ((parsed (loop for contact in contacts
                                 collect (parse-contact contact used scope))))
               (and (notany #'null parsed) parsed))))))

(defstruct draft
  "A grasp whose forms are checked and are nodes still."
  (name nil :read-only t) (form nil :read-only t)
  (comment nil :read-only t) (used nil :read-only t) (palm nil :read-only t)
  (conditions nil :read-only t) (offset nil :read-only t) (contacts nil :read-only t)
  (wrench nil :read-only t) (twist nil :read-only t)
  (derived '() :read-only t))           ; what the form does not say: forms and sentences

(defun parse-conditions (form scope)
  "Return the node of FORM, the grasping conditions; warn if they never hold."
  (let ((node (parse-form form scope :test)))
    (when (and node (eq (test-value node) :false))
      (complain form '(:warning "these conditions are false for every box")))
    node))

(defun parse-wrench (form scope)
  "Return the node of FORM, the six entries; warn of sums that were probably products."
  (let ((*sums* t))
    (parse-form form scope :six)))

(defun negative-node-p (node) (and (constant-p node) (minusp (constant-value node))))

(defun parse-twist (form scope)
  "Return the node of FORM, the mobility; complain of an entry below zero."
  (let ((node (parse-form form scope :six)))
    (if (and node (some (lambda (entries) (some #'negative-node-p entries)) (entry-lists node)))
        (complain form "an entry is below 0, but a mobility must be 0 or more")
        node)))

(defun parse-grasp (name plist form scope)
  "Return the draft of the grasp NAME, whose description is PLIST, or NIL after a complaint."
  (if (notany #'begins-entry-p plist)
      (complain form "~a is not a grasp~a: its list has none of the keys ~{~a~^, ~}" name
                (suggestion name '("GRIPPER")) +grasp-keys+)
      (parse-grasp-parts name plist form scope)))

(defmacro with-entry ((key entry) &body body)
  "Run BODY, which reads the value of KEY, whose ENTRY says where it stands."
  (let ((the-entry (gensym "ENTRY")))
    `(let* ((,the-entry ,entry) (*place* ,key) (*form* (placed (third ,the-entry))))
       (counting-steps ((second ,the-entry)) ,@body))))

(defun complain-of-offset-word (value)
  "Complain that VALUE, a name or the list of one, is no OFFSET."
  (complain value "~a is not a list of six entries; REACH may take the place of OFFSET, such as ~
                   REACH (A ~a)" (form-text value) +reach-word+))

(defun parse-offset (offset reach placement)
  "Return the node of what the entries OFFSET or REACH give, and the form that REACH leaves."
  (cond (offset (with-entry ("OFFSET" offset)
                  (if (lone-word (second offset))
                      (complain-of-offset-word (second offset))
                      (parse-form (second offset) (placement-scope placement) :six))))
        (reach (with-entry ("REACH" reach)
                 (let ((form (reach-form (second reach) placement)))
                   (and form
                        (values (parse-form form (placement-scope placement) :six) form)))))))

(defun parse-capacity (key given placement parse)
  "Return the node of KEY, WRENCH or TWIST, whose entry GIVEN, a function, gives; FROM-CONTACTS
stands for one that is absent beside REACH.  PARSE is a function of any other value and a scope."
  (let ((entry (funcall given key)))
    (when (or entry (funcall given "REACH"))
      (with-entry (key entry)
        (let ((value (if entry (second entry) :from-contacts)))
          (cond ((and (not (lone-word value)) (buried-word key value))
                 (complain value "~a: ~a stands alone, in place of six entries" (form-text value)
                           (buried-word key value)))
                ((not (lone-word value)) (funcall parse value (placement-scope placement)))
                ((not (part-word key value)) (complain-of-word key value))
                ((and (placement-palm placement) (placement-contacts placement)
                      (placement-offset placement))
                 (funcall (third (part-word key value)) placement value))))))))

(defun derived-parts (given offset-form wrench twist contacts)
  "Return what the entries GIVEN, a function of a key, leave to be derived: lists of a key and a
form, and sentences."
  (append (and offset-form (list (list "OFFSET" offset-form)))
          (and (not (funcall given "CONTACTS"))
               (list (list "CONTACTS" (middle-contacts (mapcar #'first contacts)))))
          (loop for (key node) in (list (list "WRENCH" wrench) (list "TWIST" twist))
                when (eq (node-kind node) :computed)
                  collect (second (part-word key (node-form node))))))

(defun parse-grasp-parts (name plist form scope)
  (let* ((*subject* (format nil "GRASP ~a" name)) (*form* form)
         (entries (grasp-entries plist form))
         (scope (copy-scope scope)))
    (setf (scope-grasp scope) (symbol-name name))
    (flet ((given (key) (assoc key entries :test #'string=)))
      (macrolet ((part (key form)
                   `(and (given ,key)
                         (let ((value (second (given ,key))))
                           (with-entry (,key (given ,key)) ,form)))))
        (let* ((used (part "USED-SURFACES" (parse-used value)))
               (palm (and (or used (given "PALM"))
                          (with-entry ("PALM" (given "PALM")) (parse-palm (given "PALM") used))))
               (contacts (and (or (and used palm) (given "CONTACTS"))
                              (with-entry ("CONTACTS" (given "CONTACTS"))
                                (parse-contacts (given "CONTACTS") used palm scope))))
               (conditions (part "CONDITIONS" (parse-conditions value scope)))
               (placement (make-placement :used used :palm palm :contacts contacts :scope scope)))
          (multiple-value-bind (offset offset-form)
              (and (or (given "OFFSET") (and used palm contacts))
                   (parse-offset (given "OFFSET") (given "REACH") placement))
            (setf (placement-offset placement) offset)
            (let ((wrench (parse-capacity "WRENCH" #'given placement #'parse-wrench))
                  (twist (parse-capacity "TWIST" #'given placement #'parse-twist)))
              (and used palm contacts conditions offset wrench twist
                   (not (uses-absent-p (symbol-name name) scope))
                   (make-draft :name (symbol-name name) :form form :comment (form-comment form)
                               :used used :palm palm :contacts contacts :conditions conditions
                               :offset offset :wrench wrench :twist twist
                               :derived (derived-parts #'given offset-form wrench twist
                                                       contacts))))))))))

;;; From drafts to grasps

(defun carried-onto-itself (grasp-faces turn)
  (null (set-exclusive-or grasp-faces
                          (mapcar (lambda (grasp-face) (svref turn grasp-face)) grasp-faces))))

(defun allowed-turn-p (kind turn used fingers)
  "True if a grasp that uses the grasp faces USED, with FINGERS, those of its contacts, is the same
after TURN as far as the paper's index can tell, which takes the lesser of two directions."
  (and (carried-onto-itself used turn)
       (carried-onto-itself (remove-duplicates fingers) turn)
       (or (eq kind :half-turn)
           ;; Another axis takes the place of each, so the fingers must be as many.
           (loop for grasp-face in fingers
                 always (= (count grasp-face fingers) (count (svref turn grasp-face) fingers))))))

(defun kept-centre-p (kind offset)
  "True if a turn of KIND surely leaves a grasp centre that OFFSET, a node, gives where it is: the
coordinates that the turn changes are always 0."
  (loop for entries in (entry-lists offset)
        always (every #'zero-node-p (if (eq kind :half-turn) (subseq entries 0 4) entries))))

(defun computed-p (node) (eq (node-kind node) :computed))

(defun same-draft-p (draft kind turn)
  "True if the forms of DRAFT surely say the same after TURN, of KIND.  What is computed follows
from the contacts.  A half-turn may exchange these, as far as six entries can tell."
  (flet ((entries (node) (if (computed-p node) '() (list (six-entries node)))))
    (let ((offset (six-entries (draft-offset draft))) (contacts (draft-contacts draft))
          (half (eq kind :half-turn)))
      (same-forms-p turn (draft-used draft)
                    (cons (draft-conditions draft)
                          (and half (loop for (nil . nodes) in contacts append nodes)))
                    (append (list (append (loop for (plus) on offset by #'cddr collect plus)
                                          (loop for (nil minus) on offset by #'cddr
                                                collect minus)))
                            (entries (draft-wrench draft)) (entries (draft-twist draft)))
                    (if half '() contacts)))))

(defun contact-points (contacts &optional mirrors)
  "Return where CONTACTS are, lists of a grasp face and two lengths, after mirrors along the axes
MIRRORS.  A length that varies is equal to itself alone, and not to its mirror image."
  (flet ((place-of (node mirrored)
           (cond ((not (constant-p node)) (list (and mirrored t) node))
                 (mirrored (- 0d0 (constant-value node)))
                 (t (+ 0d0 (constant-value node))))))
    (loop for (face . places) in contacts
          for axis = (floor face 2)
          collect (cons (if (member axis mirrors) (logxor face 1) face)
                        (loop for other in (remove axis '(0 1 2))
                              for node in places
                              collect (place-of node (member other mirrors)))))))

(defun mirrored-p (contacts mirrors)
  "True if mirrors along the axes MIRRORS surely leave CONTACTS what they are."
  (null (set-exclusive-or (contact-points contacts) (contact-points contacts mirrors)
                          :test #'equalp)))

(defun in-the-middle-p (contact)
  "True if CONTACT is surely in the middle of its face, but for the offset."
  (every #'zero-node-p (rest contact)))

(defun same-anyhow-p (draft kind)
  "True if a turn of KIND leaves the grasp of DRAFT the same wherever gravity points.  Six entries
of WRENCH are good both ways, twelve are not: the contacts must come where others were.  A
third-turn moves the palm, which a TWIST that is computed tells apart."
  (let ((contacts (draft-contacts draft)))
    (and (or (not (computed-p (draft-wrench draft)))
             (if (eq kind :half-turn)
                 (mirrored-p contacts '(0 1))
                 (every #'in-the-middle-p contacts)))
         (or (eq kind :half-turn) (not (computed-p (draft-twist draft)))))))

(defun same-lying-p (draft kind matching axis)
  "True if a turn of KIND leaves the grasp of DRAFT in MATCHING the same where gravity is along the
box's AXIS, 0 to 2.  A half-turn about that axis does; so does one that exchanges up and down if the
contacts are mirror images."
  (let ((vertical (position axis (matching-axes matching) :end 3)))
    (or (same-anyhow-p draft kind)
        (and (eq kind :half-turn)
             (or (= vertical 2) (mirrored-p (draft-contacts draft) (list vertical)))))))

(defun allowed-turns (draft)
  "Return those of +TURNS+ after which the grasp of DRAFT is the same, as far as its faces and its
forms show."
  (remove-if-not (lambda (row)
                   (destructuring-bind (kind turn sets) row
                     (declare (ignore sets))
                     (and (allowed-turn-p kind turn (draft-used draft)
                                          (mapcar #'first (draft-contacts draft)))
                          (same-draft-p draft kind turn))))
                 +turns+))

(defun same-matchings (turns same-p)
  "Return, for each matching, the set of those of TURNS of it that are the same grasp, as SAME-P, a
function of the kind of a turn and a matching, says."
  (let ((sets (make-array 24 :element-type 'matching-set)))
    (loop for matching across +matchings+
          do (setf (aref sets (matching-index matching))
                   (reduce #'logior
                           (loop for (kind nil sets) in turns
                                 when (funcall same-p kind matching)
                                   collect (svref sets (matching-index matching)))
                           :initial-value (ash 1 (matching-index matching)))))
    sets))

(defun same-where-gravity-is (draft turns axis)
  "Return, for each matching of the grasp of DRAFT, the set of those of its TURNS that are the same
grasp where gravity is along the box's AXIS, 0 to 2."
  (same-matchings turns (lambda (kind matching) (same-lying-p draft kind matching axis))))

(defun usable-matchings (used)
  "Return, for each set of box faces, the set of the matchings in which none of the grasp faces USED
has one of them."
  (let ((sets (make-array 64 :element-type 'matching-set :initial-element +all-matchings+)))
    (dotimes (faces 64 sets)
      (dotimes (face 6)
        (when (logbitp face faces)
          (dolist (grasp-face used)
            (setf (aref sets faces)
                  (logandc2 (aref sets faces) (aref +matchings-with+ grasp-face face)))))))))

(defun contact-places (contacts registers)
  "Return the PLACES of a grasp with CONTACTS, whose positions will be in REGISTERS, two for each."
  (coerce (loop for (grasp-face) in contacts
                append (loop for axis in (remove (floor grasp-face 2) '(0 1 2))
                             collect axis collect (pop registers)))
          'register-vector))

(defun finish-grasp (draft index layout)
  "Return the grasp of DRAFT, the one with INDEX, its forms ready to run on the registers of
LAYOUT."
  (let* ((contacts (draft-contacts draft))
         (fingers (mapcar #'first contacts))
         (conditions (draft-conditions draft))
         (positions (numbers-program (loop for (nil . place) in contacts append place) layout))
         (places (coerce (program-results positions) 'list))
         (turns (allowed-turns draft))
         (same (coerce (loop for axis below 3 collect (same-where-gravity-is draft turns axis))
                       'vector)))
    (make-grasp
     :name (draft-name draft) :index index :definition (draft-form draft)
     :draft draft :used (draft-used draft) :palm (draft-palm draft)
     :conditions (test-program conditions layout)
     :comparisons (comparison-programs conditions layout)
     :offset (six-program (draft-offset draft) layout)
     :positions positions
     :places (contact-places contacts places)
     :contacts (loop for grasp-face in fingers
                     for (p q) on places by #'cddr
                     collect (list grasp-face p q))
     :wrench (six-program (draft-wrench draft) layout)
     :twist (six-program (draft-twist draft) layout)
     :usable (usable-matchings (draft-used draft))
     :same (svref same 2) :same-lying same
     :same-centre (same-matchings turns
                                  (lambda (kind matching)
                                    (declare (ignore matching))
                                    (and (kept-centre-p kind (draft-offset draft))
                                         (same-anyhow-p draft kind)))))))

;;; The file

(defun global-scope (gripper rows)
  "Return the scope of a grasp file with GRIPPER.  Of the dimensions ROWS, those that it lacks are
known all the same, so that no form is blamed for them."
  (let ((scope (make-scope :gripper-place (gripper-place gripper))))
    (flet ((entry (name number) (cons name (constant-node scope number))))
      (setf (scope-dimensions scope)
            (loop for (name . number) in (gripper-dimensions gripper) collect (entry name number))
            (scope-absent scope)
            (loop for (name number) in rows
                  unless (gripper-dimension gripper name) collect (entry name number))
            (scope-variables scope)
            (list* (cons "U" (input-node +u+)) (cons "V" (input-node +v+))
                   (append (scope-dimensions scope) (scope-absent scope)))
            (scope-globals scope) (scope-variables scope)))
    scope))

(defun uses-absent-p (grasp scope)
  "True if GRASP, a name, uses a dimension that the gripper lacks."
  (loop for entry in (scope-absent scope)
          thereis (find grasp (gethash entry (scope-uses scope))
                        :key #'dimension-use-user :test #'string=)))

(defun dimension-uses (scope)
  "Return the DIMENSION-USEs that were noted in SCOPE, in order."
  (loop for entry in (append (scope-dimensions scope) (scope-absent scope))
        append (reverse (gethash entry (scope-uses scope)))))

(defun build-graspbase (forms gripper)
  "Return the graspbase of FORMS, those of a grasp file, in their order, and of GRIPPER.  Forms that
are wrong are left out after a complaint (see WITH-PROBLEMS)."
  (let* ((rows (known-dimensions forms))
         (scope (global-scope gripper rows))
         (drafts '()) (broken '())
         (names (make-hash-table :test #'equal)))
    (dolist (form forms)
      (let ((*form* form))
        (cond ((gripper-form-p form))
              ((part-p form "DEFUN") (parse-helper form scope))
              ((and (consp form) (begins-entry-p form))
               (complain form "~a stands outside of a grasp: a ) before it is one too many"
                         (first form)))
              (t (multiple-value-bind (name plist) (definition-form form)
                   (let ((draft (and name (parse-grasp name plist form scope))))
                     (cond ((null draft)
                            (when (and (consp form) (consp (rest form)) (namep (second form)))
                              (push (symbol-name (second form)) broken)))
                           ((gethash (draft-name draft) names)
                            (let ((*subject* (format nil "GRASP ~a" name)))
                              (complain form "an earlier grasp has this name")))
                           (t (setf (gethash (draft-name draft) names) t)
                              (push draft drafts)))))))))
    (let* ((layout (scope-layout scope))
           (grasps (loop for draft in (reverse drafts)
                         for index from 0
                         collect (finish-grasp draft index layout))))
      (make-graspbase :gripper gripper :uses (dimension-uses scope) :rows rows :grasps grasps
                      :broken broken :registers (make-registers layout)))))
