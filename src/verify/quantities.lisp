;;;; quantities.lisp -- the numbers of a box, and the classes of each that rules can tell apart.
;;;;
;;;; Nothing here knows what the preliminary assertions are.  Each number of a box is moved through
;;;; many values.  Among them are values on both sides of the gripper's dimensions, and of the
;;;; numbers that the tests of the assertions name.  Where what the rules see changes between two
;;;; values, the place is found by halving, to the last bit.

(in-package :supergrip)

(defstruct (quantity (:constructor make-quantity (row index)))
  "A number that a box gives: that of the key ROW, at INDEX if it has several.  CLASSES are the
classes that rules can tell apart: intervals (LEAST . MOST), both included, or NIL for none.
NUMBERS has a plain one of each. ATOMS is the list of what is seen differently in some of them."
  row index (classes '()) (numbers '()) (atoms '()))

(defun quantity-name (quantity)
  "Return the name of QUANTITY, as \"SIZE along X\"."
  (format nil "~a~@[ ~a~]" (box-key-key (quantity-row quantity))
          (and (quantity-index quantity) (axis-name (quantity-index quantity)))))

(defun all-quantities ()
  "Return the quantities that the keys of a box give."
  (loop for row in *box-keys*
        for type = (box-key-type row)
        append (cond ((eq type :number) (list (make-quantity row nil)))
                     ((eq type :needs) (loop for i below 6 collect (make-quantity row i)))
                     ((consp type)
                      (loop for i below (second type) collect (make-quantity row i))))))

(defun quantity-value (quantity values)
  "Return what VALUES, a plist as for MAKE-BOX, give for QUANTITY, or NIL."
  (let ((value (getf values (box-key-key (quantity-row quantity)))))
    (if (and value (quantity-index quantity))
        (aref value (quantity-index quantity))
        value)))

(defun values-with (values quantity number)
  "Return VALUES, a plist as for MAKE-BOX, with NUMBER for QUANTITY."
  (let* ((key (box-key-key (quantity-row quantity)))
         (index (quantity-index quantity))
         (old (or (getf values key)
                  (and index (key-value (quantity-row quantity)
                                        (box-key-example (quantity-row quantity)))))))
    (if index
        (let ((copy (copy-seq old)))
          (setf (aref copy index) number)
          (list* key copy values))
        (list* key number values))))

;;; The values that are tried

(defun neighbours (number)
  "Return NUMBER, a double, with the next ones below and above it."
  (if (zerop number)
      (list number)
      (multiple-value-bind (mantissa exponent sign) (integer-decode-float number)
        (loop for step from -1 to 1
              collect (* sign (scale-float (coerce (+ mantissa step) 'double-float) exponent))))))

(defun allowed-p (number row)
  "True if NUMBER is one that the key ROW takes."
  (cond ((consp (box-key-type row)) (plusp number))
        ((eq (box-key-type row) :needs) (<= 0 number 1))
        (t (>= number 0))))

(defun special-numbers (views)
  "Return the doubles at which what VIEWS see is likely to change: the dimensions of the
grippers, and the numbers that tests name."
  (remove-duplicates
   (loop for view in views
         append (mapcar #'cdr (knowledge-gripper (view-knowledge view)))
         append (loop for input in (view-inputs view)
                      for numbers = (input-row-numbers (prepared-input-row input))
                      append (remove nil (mapcar #'as-double numbers))))))

(defun probes (row special)
  "Return the values of the key ROW to be tried, in ascending order: SPECIAL ones with their
neighbours, and others in even steps."
  (let ((even (if (eq (box-key-type row) :needs)
                  (loop for i from 0 to 50 collect (/ i 50d0))
                  (cons 0d0 (loop for i from -36 to 72 collect (expt 10d0 (/ i 12)))))))
    (sort (remove-duplicates (remove-if-not (lambda (number) (allowed-p number row))
                                            (append even (mapcan #'neighbours special))))
          #'<)))

;;; Where what is seen changes

(defun seen (views values)
  "Return what VIEWS see of the box of VALUES, a list of facts; :NOTHING if a test has no value
there."
  (let ((box (make-box values nil)))
    (handler-case (loop for view in views
                        for number from 0
                        append (loop for fact in (seen-facts view box) collect (list* number fact)))
      (arithmetic-error () :nothing))))

(defun differing (a b)
  "Return what is in one of A and B alone, lists as SEEN returns them."
  (set-exclusive-or (if (listp a) a '()) (if (listp b) b '()) :test #'equal))

(defun find-bounds (quantity probes views values)
  "Return the places between PROBES at which what VIEWS see of the box of VALUES changes with
QUANTITY, a list of (BELOW . ABOVE), adjacent numbers; note in QUANTITY what changes."
  (flet ((seen-at (number) (seen views (values-with values quantity number))))
    (loop for (low high) on probes
          for before = (seen-at low) then after
          for after = (and high (seen-at high))
          while high
          unless (equal before after)
            collect (multiple-value-bind (below above)
                        (halve low high (lambda (number) (not (equal before (seen-at number)))))
                      (setf (quantity-atoms quantity)
                            (union (differing before after) (quantity-atoms quantity)
                                   :test #'equal))
                      (cons below above)))))

(defun cut (least most bounds)
  "Return the intervals from LEAST to MOST between BOUNDS, a list of (BELOW . ABOVE)."
  (loop with low = least
        for (below . above) in (sort (remove-duplicates bounds :test #'equal) #'< :key #'car)
        when (<= low below)
          collect (cons low below) into intervals
        do (setf low (max low above))
        finally (return (append intervals (list (cons low most))))))

(defun random-values (quantities state)
  "Return a plist of values for a box with random constraints, and each of QUANTITIES at random."
  (let ((values (list* :constrained (random 64 state) (plain-values))))
    (dolist (quantity quantities values)
      (when (quantity-value quantity values)
        (setf values (values-with values quantity
                                  (if (eq (box-key-type (quantity-row quantity)) :needs)
                                      (random 1d0 state)
                                      (expt 10d0 (- (random 3d0 state) 1.5d0)))))))))

(defun classify (quantities views)
  "Find the classes of QUANTITIES that VIEWS can tell apart.  What they see may depend on several
numbers at once, so besides the plain box some random ones are looked at."
  (let* ((special (special-numbers views))
         (state (seeded-state 1))
         (plain (plain-values))
         (bases (list* plain (list* :constrained 63 plain)
                       (loop repeat 3 collect (random-values quantities state)))))
    (dolist (quantity quantities quantities)
      (let ((probes (probes (quantity-row quantity) special)))
        (put-classes quantity (quantity-value quantity plain)
                     (cut (first probes) (first (last probes))
                          (loop for base in bases
                                append (find-bounds quantity probes views base))))))))

(defun put-classes (quantity plain classes)
  "Give QUANTITY its CLASSES, the one with PLAIN, a number, before the others.  If PLAIN is NIL,
a box may lack the number: that is a class of its own, NIL, if there are several."
  (flet ((plain-p (class) (and plain (<= (car class) plain (cdr class)))))
    (let ((classes (append (if plain (remove-if-not #'plain-p classes) (and (rest classes) '(nil)))
                           (remove-if #'plain-p classes))))
      (setf (quantity-classes quantity) classes
            (quantity-numbers quantity) (loop for class in classes
                                              collect (and class (class-number class plain)))))))

(defun several-numbers (quantities)
  "Return the predicates of which what is seen depends on more than one of QUANTITIES, a list of
names."
  (let ((seen '()) (several '()))
    (dolist (quantity quantities (reverse several))
      (dolist (atom (quantity-atoms quantity))
        (when (find atom seen :test #'equal)
          (pushnew (predicate-text (second atom)) several :test #'string=)))
      (setf seen (append (quantity-atoms quantity) seen)))))

;;; Numbers of a class that are short to write

(defun shortest-between (low high)
  "Return the number with the fewest digits from LOW to HIGH, doubles not below 0; the lowest such."
  (if (<= low 0d0)
      0d0
      (loop with exponent = (decimal-exponent (rational high))
            for digits from 1 to 18
            for unit = (expt 10 (- exponent digits -1))
            for value = (coerce (* unit (ceiling (rational low) unit)) 'double-float)
            when (<= low value high) return value
            finally (return low))))

(defparameter +far-below+ 1d-3 "What is no greater is where an interval is not bounded below.")
(defparameter +far-above+ 1d6 "What is no smaller is where an interval is not bounded above.")

(defun class-number (class plain)
  "Return a number of CLASS, an interval: PLAIN if that is in it, or one well inside that is short."
  (destructuring-bind (least . most) class
    (if (and plain (<= least plain most))
        plain
        (let ((most (if (>= most +far-above+) (max (* 1.5d0 least) (+ 1 least)) most)))
          (shortest-between (+ (* 0.6d0 least) (* 0.4d0 most))
                            (+ (* 0.2d0 least) (* 0.8d0 most)))))))

(defun edge-numbers (class)
  "Return numbers near both ends of CLASS, an interval; none where it is not bounded."
  (destructuring-bind (least . most) class
    (let ((near (* 1d-2 (min (- most least) (max least 1d-1)))))
      (append (and (> least +far-below+)
                   (list (shortest-between least (+ least near))))
              (and (< +far-below+ most +far-above+)
                   (list (shortest-between (max least (- most near)) most)))))))
