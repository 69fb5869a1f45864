;;;; grasp-entries.lisp -- the list of a grasp is split into its entries, in any shape it may have.
;;;;
;;;; What is shown is keys and values in turn: (USED-SURFACES (N1 N2 A2) CONDITIONS ...).  As in the
;;;; paper, a key may also stand in parentheses with its value, (WRENCH (1 u ...)); and a value of
;;;; several parts needs no list of its own: (CONDITIONS (u > 1) AND (v > 0)).

(in-package :supergrip)

(defparameter +grasp-keys+
  '("USED-SURFACES" "CONDITIONS" "OFFSET" "REACH" "WRENCH" "TWIST" "CONTACTS" "PALM")
  "The keys of a grasp.  REACH may stand in place of OFFSET; WRENCH and TWIST may then be absent.
The last two may be absent.")

(defun begins-entry-p (part &optional (keys +grasp-keys+))
  "True if PART is one of KEYS, or a list that begins with one."
  (name-in (if (consp part) (first part) part) keys))

(defun joins-tests-p (part)
  "True if PART, of conditions without a list of their own, has a part of theirs after it."
  (or (connective-p part) (named-comparison part) (name= part "NOT")))

(defun take-value (parts)
  "Return the parts of the value that PARTS begin with, and the other parts.  A value is one part,
and more as long as something joins them."
  (let ((taken '()))
    (loop while (and parts (not (begins-entry-p (first parts))))
          do (push (pop parts) taken)
          while (or (joins-tests-p (first taken)) (joins-tests-p (first parts))))
    (values (reverse taken) parts)))

(defun split-entries (list)
  "Return the entries of LIST, that of a grasp: each a list of its key, which may be none at all,
the list of the parts of its value, and the form that it begins with."
  (loop while list
        collect (let ((part (pop list)))
                  (cond ((and (consp part) (begins-entry-p part))
                         (list (first part) (rest part) part))
                        ((namep part)
                         (multiple-value-bind (value others) (take-value list)
                           (setf list others)
                           (list part value (or (find-if #'consp value) part))))
                        (t (list part '() part))))))

(defun entry-value (key parts)
  "Return the value of KEY that has PARTS: a lone surface or contact is a list of one."
  (let ((part (first parts)))
    (if (or (rest parts)
            (and (name= key "USED-SURFACES") (namep part))
            (and (name= key "CONTACTS") (consp part) (namep (first part))))
        parts
        part)))

(defun canonical-entries (list)
  "Return LIST, that of a grasp, as keys and values in turn."
  (loop for (key parts) in (split-entries list)
        collect key collect (entry-value key parts)))
