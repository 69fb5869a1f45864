;;;; check-contacts.lisp -- contacts that can't be meant: nothing opposes them, or they are on no
;;;; box.
;;;;
;;;; That all contacts are on one face shows by itself.  Where a contact is may depend on the
;;;; box.  So it is looked at on many boxes that CONDITIONS allow.  It is warned of if it is beyond
;;;; an edge, or farther out than the hand is long, on all of them.  Nothing is said where
;;;; CONDITIONS allow none of them.

(in-package :supergrip)

(defun contact-forms (grasp)
  "Return the forms of the contacts of GRASP; NIL if it names none."
  (destructuring-bind (setq name (quotation list)) (grasp-definition grasp)
    (declare (ignore setq name quotation))
    (let ((entry (find-if (lambda (entry) (name= (first entry) "CONTACTS")) (split-entries list))))
      (and entry (entry-value (first entry) (second entry))))))

(defun check-opposed (grasp)
  "Warn if all contacts of GRASP are on one face: they can't pull."
  (let* ((faces (mapcar #'first (grasp-contacts grasp)))
         (face (first faces)) (other (logxor face 1)) (forms (contact-forms grasp)))
    (when (every (lambda (other) (= other face)) faces)
      (complain (or forms (grasp-definition grasp))
                '(:warning "~@[~a: ~]~[~;a single finger, on ~a, can~:;all fingers are on ~a: ~
                            they can~] push the box, and not hold it; add a finger on a face that ~
                            opposes, such as (~a 0 0)~@[, and ~a to USED-SURFACES~]")
                (and forms (form-text forms)) (length faces) (svref +grasp-faces+ face)
                (svref +grasp-faces+ other)
                (and (not (member other (grasp-used grasp))) (svref +grasp-faces+ other))))))

;;; Boxes to look at

(defun parts-of (node)
  "Return all nodes in NODE, a form of a grasp, itself included, each once."
  (let ((seen (make-hash-table :test #'eq)))
    (labels ((walk (thing)
               (cond ((consp thing) (mapc #'walk thing))
                     ((and (node-p thing) (not (gethash thing seen)))
                      (setf (gethash thing seen) t)
                      (walk (node-args thing))))))
      (walk node))
    (loop for part being the hash-keys of seen collect part)))

(defparameter +most-thresholds+ 4 "How many thresholds of CONDITIONS add to the sizes of boxes.")

(defun form-thresholds (parts)
  "Return at most +MOST-THRESHOLDS+ numbers above 0 that are constants among PARTS, nodes."
  (let ((numbers (remove-duplicates (loop for part in parts
                                          when (and (constant-p part) (plusp (constant-value part)))
                                            collect (constant-value part)))))
    (subseq numbers 0 (min +most-thresholds+ (length numbers)))))

(defun sizes-to-try (parts hand)
  "Return sizes for the edges of boxes, for a grasp with PARTS of CONDITIONS and a HAND, its
greatest dimension: from a hundredth of it to twenty times it, and both sides of thresholds; the
likely first."
  (sort (append (loop for power from -18 to 12 collect (* hand (expt 1.28d0 power)))
                (loop for number in (form-thresholds parts)
                      append (list (* 0.999d0 number) number (* 1.001d0 number))))
        #'< :key (lambda (size) (abs (log (/ size hand 0.4d0))))))

(defun map-boxes (visit registers grasp hand)
  "Call VISIT, a function without arguments, with REGISTERS holding each of many boxes in turn."
  (let* ((parts (parts-of (draft-conditions (grasp-draft grasp))))
         (sizes (sizes-to-try parts hand))
         (inputs (loop for part in parts
                       when (eq (node-kind part) :input) append (node-args part))))
    (dolist (u (if (member +u+ inputs) '(2d0 0.8d0 0.3d0) '(0.8d0)))
      (dolist (blocked (if (find :constrained parts :key #'node-kind) '(0d0 1d0) '(0d0)))
        (dolist (n sizes)
          (dolist (o sizes)
            (dolist (a sizes)
              (put-box registers grasp u blocked n o a)
              (funcall visit))))))))

(defun put-box (registers grasp u blocked n o a)
  "Put into REGISTERS a box of N, O, A cm with the friction U; BLOCKED is 1 if the faces that
GRASP does not use are constrained, else 0."
  (declare (type registers registers) (double-float u blocked n o a))
  (setf (aref registers +u+) u
        (aref registers +v+) 0.2d0
        (aref registers +distances+) n
        (aref registers (+ +distances+ 1)) o
        (aref registers (+ +distances+ 2)) a)
  (dotimes (face 6)
    (setf (aref registers (+ +blocked+ face)) (if (member face (grasp-used grasp)) 0d0 blocked))))

(defun put-centre (grasp registers centre)
  "Put the grasp centre of GRASP on the box in REGISTERS into CENTRE, a three, and its contacts into
REGISTERS.  NIL if the conditions are false, or something has no value."
  (declare (type registers registers) (type three centre))
  (let ((offset (grasp-offset grasp)))
    (and (execute (grasp-conditions grasp) registers)
         (execute offset registers)
         (dotimes (axis 3 t)
           (setf (aref centre axis)
                 (* 0.5d0 (- (aref registers (aref (program-results offset) (* 2 axis)))
                             (aref registers (aref (program-results offset) (1+ (* 2 axis))))))))
         (execute (grasp-positions grasp) registers))))

;;; Contacts that are nowhere

(defstruct stray
  "A contact that was on no box so far: its NUMBER, from 0, and its FACE; PLACES, axes and
registers in turn.  FAR is the least distance that it was out where the hand is shorter, EDGE the
least by which it was beyond an edge elsewhere, each with the axis; NIL where that never was."
  (number 0) (face 0) (places '()) (far nil) (edge nil))

(defun strays-of (grasp)
  "Return a stray for each contact of GRASP."
  (loop for (face p q) in (grasp-contacts grasp)
        for number from 0
        collect (destructuring-bind (one two) (remove (floor face 2) '(0 1 2))
                  (make-stray :number number :face face :places (list one p two q)))))

(defun worst-along (stray function)
  "Return the greatest that FUNCTION gives of the axes and the registers of STRAY, with its axis."
  (destructuring-bind (axis1 register1 axis2 register2) (stray-places stray)
    (let ((one (funcall function axis1 register1)) (two (funcall function axis2 register2)))
      (if (> two one) (cons two axis2) (cons one axis1)))))

(defun note-stray (stray registers centre most)
  "Return true if STRAY is on its face of the box in REGISTERS, at CENTRE, and no farther out than
MOST; if it is not, note by how much."
  (declare (type registers registers) (type three centre))
  (let ((out (worst-along stray (lambda (axis register)
                                  (declare (ignore axis))
                                  (abs (aref registers register)))))
        (beyond (worst-along stray (lambda (axis register)
                                     (- (abs (+ (aref centre axis) (aref registers register)))
                                        (/ (aref registers (+ +distances+ axis)) 2))))))
    (flet ((lesser (new old)
             (if (or (null old) (< (car new) (car old))) new old)))
      (cond ((> (car out) most)
             (setf (stray-far stray) (lesser out (stray-far stray)))
             nil)
            ((> (car beyond) (* 1d-9 (+ 1 (car out))))
             (setf (stray-edge stray) (lesser beyond (stray-edge stray)))
             nil)
            (t t)))))

(defun find-strays (grasp graspbase hand most)
  "Return the contacts of GRASP that are on no box that was looked at, or farther out than MOST,
strays, and how many boxes its conditions allowed.  HAND is how large boxes are about, in cm."
  (let ((registers (copy-seq (graspbase-registers graspbase)))
        (centre (make-three)) (left (strays-of grasp)) (count 0) (size (* 0.4d0 hand)))
    (without-float-traps
      (block looking
        (flet ((look ()
                 (when (put-centre grasp registers centre)
                   (incf count)
                   (setf left (remove-if (lambda (stray)
                                           (note-stray stray registers centre most))
                                         left))
                   (when (null left) (return-from looking)))))
          ;; A cube that the hand holds well mostly shows at once that all is right.
          (put-box registers grasp 0.8d0 0d0 size size size)
          (look)
          (setf left (strays-of grasp) count 0)
          (map-boxes #'look registers grasp hand))))
    (values left count)))

(defun complain-of-stray (stray form count hand)
  "Warn that STRAY, whose FORM may be NIL, is on none of COUNT boxes.  HAND is the name and the
size of the greatest dimension of the hand, or NIL."
  (let ((face (svref +grasp-faces+ (stray-face stray))))
    (if (stray-edge stray)
        (complain form '(:warning "~:[contact ~d~;~:*~a~*~]: of ~d boxes that CONDITIONS allow, on ~
                                   none is this a place of ~a that the hand reaches; at best it is ~
                                   ~a cm beyond the edge along ~a; places are lengths from the ~
                                   grasp centre, in cm")
                  (and form (form-text form)) (1+ (stray-number stray)) count face
                  (number-text (car (stray-edge stray)))
                  (svref +axis-names+ (cdr (stray-edge stray))))
        (complain form '(:warning "~:[contact ~d~;~:*~a~*~]: this is ~a cm from the grasp centre ~
                                   along ~a, and the hand's greatest dimension is ~a, ~a; places ~
                                   are lengths in cm; where a finger is that far out, let the ~
                                   gripper name how far")
                  (and form (form-text form)) (1+ (stray-number stray))
                  (number-text (car (stray-far stray))) (svref +axis-names+ (cdr (stray-far stray)))
                  (car hand) (number-text (cdr hand))))))

(defun check-places (grasp graspbase)
  "Warn of the contacts of GRASP that are on no box that was looked at."
  (let ((hand (longest-dimension (gripper-dimensions (graspbase-gripper graspbase)))))
    (multiple-value-bind (strays count)
        (if hand
            (find-strays grasp graspbase (cdr hand) (* (cdr hand) (+ 1 1d-9)))
            (find-strays grasp graspbase 10d0 most-positive-double-float))
      (when (plusp count)
        (dolist (stray strays)
          (complain-of-stray stray (nth (stray-number stray) (contact-forms grasp)) count hand))))))

(defun check-contacts (graspbase)
  "Warn of the contacts of grasps of GRASPBASE that can't be meant."
  (dolist (grasp (graspbase-grasps graspbase))
    (let ((*subject* (format nil "GRASP ~a" (grasp-name grasp))) (*place* "CONTACTS")
          (*form* (grasp-definition grasp)))
      (check-opposed grasp)
      (check-places grasp graspbase))))
