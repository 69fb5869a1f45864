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

(defun joined-nodes (node)
  "Return the nodes that NODE, an AND or an OR, joins, also within others of its kind."
  (loop for part in (node-args node)
        append (if (eq (node-kind part) (node-kind node)) (joined-nodes part) (list part))))

(defun same-in-any-order-p (list other same-p)
  "True if SAME-P holds of the elements of LIST and of OTHER, each with one of its own."
  (declare (function same-p))
  (let ((left other))
    (and (= (length list) (length other))
         (loop for element in list
               always (if (funcall same-p element (first left)) ; mostly the order is the same
                          (progn (pop left) t)
                          (let ((match (member element left :test same-p)))
                            (setf left (append (ldiff left match) (rest match)))
                            match))))))

(defun same-after-turn-function (used turn)
  "Return a function of two nodes, true if the first says after TURN what the second says now.  Of
the grasp faces USED none is constrained."
  (let ((known (make-hash-table :test #'eq)))
    (labels ((same-p (a b)
               (cond ((and (node-p a) (node-p b))
                      (and (eq (node-kind a) (node-kind b)) (same-nodes-p (node-kind a) a b)))
                     ((and (consp a) (consp b)) (same-lists-p a b))
                     (t (equal a b))))
             (same-lists-p (a b)
               (loop while (and a b)
                     always (same-p (pop a) (pop b))
                     finally (return (and (null a) (null b)))))
             (same-nodes-p (kind a b)
               (if (member kind '(:input :constant :constrained))
                   (same-parts-p kind a b)
                   (let ((seen (assoc b (gethash a known) :test #'eq)))
                     (if seen
                         (cdr seen)
                         (let ((same (same-parts-p kind a b)))
                           (push (cons b same) (gethash a known))
                           same)))))
             (same-parts-p (kind a b)
               (let ((first-a (first (node-args a))) (rest-a (rest (node-args a)))
                     (first-b (first (node-args b))) (rest-b (rest (node-args b))))
                 (case kind
                   (:input (eql (turned-register first-a turn) first-b))
                   (:constrained (if (member first-a used)
                                     (member first-b used)
                                     (eql (svref turn first-a) first-b)))
                   ((:and :or)
                    (same-in-any-order-p (joined-nodes a) (joined-nodes b) #'same-p))
                   (:let (and (same-in-any-order-p first-a first-b #'same-p)
                              (same-lists-p rest-a rest-b)))
                   (:operation
                    (and (eq first-a first-b)
                         (if (eq (arithmetic-kind first-a) :symmetric)
                             (same-in-any-order-p rest-a rest-b #'same-p)
                             (same-lists-p rest-a rest-b))))
                   (t (same-lists-p (node-args a) (node-args b)))))))
      #'same-p)))

(defun same-contact-p (contact other turn same-p)
  "True if CONTACT, a grasp face and two nodes, is after TURN where OTHER is, as SAME-P says."
  (flet ((places (contact)
           (loop for axis in (remove (floor (first contact) 2) '(0 1 2))
                 for node in (rest contact)
                 collect (cons axis node))))
    (and (eql (svref turn (first contact)) (first other))
         (loop for (axis . node) in (places contact)
               always (funcall same-p node
                               (cdr (assoc (turned-axis axis turn) (places other))))))))

(defun same-forms-p (turn used alone sixes contacts)
  "True if what a grasp that uses the faces USED says is the same after TURN: the nodes ALONE;
SIXES, lists of six nodes along and about N O A; and CONTACTS, lists of a face and two nodes."
  (let ((same-p (same-after-turn-function used turn)))
    (and (loop for node in alone always (funcall same-p node node))
         (loop for six in sixes
               always (loop for node in six
                            for place from 0
                            for other = (+ (turned-axis (mod place 3) turn) (* 3 (floor place 3)))
                            always (funcall same-p node (nth other six))))
         (same-in-any-order-p contacts contacts
                              (lambda (contact other)
                                (same-contact-p contact other turn same-p))))))
