;;;; same-forms.lisp -- whether the forms of a grasp say the same after a turn of the hand.
;;;;
;;;; A turn exchanges faces and axes of the grasp.  A form that tells them apart, as one that asks
;;;; for CONSTRAINED O1 alone, may say something else then.  Forms are compared as they are written,
;;;; but for the order of sums, products, AND and OR.  So what looks different is taken for
;;;; different, and the grasp is tried both ways.

(in-package :supergrip)

(defun turned-register (register turn)
  "Return what REGISTER, that of an input, is after TURN."
  (if (<= +distances+ register (+ 2 +distances+))
      (+ +distances+ (turned-axis (- register +distances+) turn))
      register))

(defun turned-axis (axis turn)
  "Return the axis, 0 to 2, whose place AXIS takes after TURN."
  (floor (svref turn (* 2 axis)) 2))

(defun of-kind-keys (kind node key)
  "Return the keys, by the function KEY, of what NODE, an AND or an OR, whichever KIND is, joins."
  (loop for part in (node-args node)
        append (if (eq (node-kind part) kind)
                   (of-kind-keys kind part key)
                   (list (funcall key part)))))

(defun node-key-function (known used turn)
  "Return a function that returns the number of a node after TURN, the same for nodes that say the
same.  KNOWN is a table of what has numbers; of the grasp faces USED none is constrained."
  (let ((numbers (make-hash-table :test #'eq)))
    (labels ((number-of (what)
               (or (gethash what known) (setf (gethash what known) (hash-table-count known))))
             (key (thing)
               (cond ((node-p thing) (or (gethash thing numbers)
                                         (setf (gethash thing numbers) (number-of (parts thing)))))
                     ((consp thing) (mapcar #'key thing))
                     (t thing)))
             (parts (node)
               (let ((kind (node-kind node)) (first (first (node-args node))))
                 (case kind
                   (:input (list kind (turned-register first turn)))
                   (:constrained (if (member first used)
                                     (list :false)
                                     (list kind (svref turn first))))
                   ((:and :or) (cons kind (sort (of-kind-keys kind node #'key) #'<)))
                   (:let (list kind (sort (mapcar #'key first) #'<)
                               (key (second (node-args node)))))
                   (:operation
                    (let ((keys (mapcar #'key (rest (node-args node)))))
                      (list* kind first (if (eq (arithmetic-kind first) :symmetric)
                                            (sort keys #'<)
                                            keys))))
                   (t (cons kind (mapcar #'key (node-args node))))))))
      #'key)))

(defun same-forms-p (turn used alone sixes contacts)
  "True if what a grasp that uses the faces USED says is the same after TURN: the nodes ALONE;
SIXES, lists of six nodes along and about N O A; and CONTACTS, lists of a face and two nodes."
  (let* ((known (make-hash-table :test #'equal)) (nothing #(0 1 2 3 4 5))
         (now (node-key-function known used nothing)) (then (node-key-function known used turn)))
    (flet ((contact-keys (key turn)
             (loop for (face . nodes) in contacts
                   collect (cons (svref turn face)
                                 (sort (loop for axis in (remove (floor face 2) '(0 1 2))
                                             for node in nodes
                                             collect (cons (turned-axis axis turn)
                                                           (funcall key node)))
                                       #'< :key #'car)))))
      (and (loop for node in alone always (equal (funcall now node) (funcall then node)))
           (loop for six in sixes
                 always (loop for node in six
                              for place from 0
                              for other = (+ (turned-axis (mod place 3) turn) (* 3 (floor place 3)))
                              always (equal (funcall then node) (funcall now (nth other six)))))
           (null (set-exclusive-or (contact-keys now nothing) (contact-keys then turn)
                                   :test #'equal))))))
