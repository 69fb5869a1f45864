;;;; computations.lisp -- numbers that a function computes of other numbers, and keeps for a while.
;;;;
;;;; What forms can't say, such as what contacts can exert, is a computation.  It takes a thousand
;;;; times as long as a form, and the same numbers come again.  So it has a table of bounded size,
;;;; in which a new result replaces an old one.  No list grows.  No lock is needed, since an entry
;;;; never changes once it is there.

(in-package :supergrip)

(defconstant +bits-kept+ 10 "How many bits say where a result is kept.")
(defconstant +places-kept+ (ash 1 +bits-kept+) "How many results a computation keeps at most.")

(defstruct (computation (:copier nil))
  "COUNT numbers that FUNCTION, of a vector of doubles, returns as another, or NIL if they have no
value.  Of the numbers that it takes, NUMBERS, those at PLACES vary.  RISING are those PLACES with
which the results never fall.  COMPONENTS has an object for each result, for curves.  KEPT holds
entries: what varies, then the results, if there are any."
  (name nil :read-only t) (function nil :type function :read-only t)
  (count 0 :type fixnum :read-only t) (numbers nil :read-only t)
  (places '() :type list :read-only t) (rising '() :type list :read-only t)
  (components nil :type simple-vector)
  (kept (make-array +places-kept+ :initial-element nil) :type simple-vector :read-only t))

(define-printing (computation computation) "~a" (computation-name computation))

(defstruct (component (:constructor make-component (computation index)) (:copier nil))
  "The result of COMPUTATION that is at INDEX."
  (computation nil :type computation :read-only t) (index 0 :type fixnum :read-only t))

(define-printing (component component) "~d of ~a" (component-index component)
  (computation-name (component-computation component)))

(deftype numbers () '(simple-array double-float (*)))

(declaim (inline place-kept))
(defun place-kept (registers from)
  "Return the place in the table for the numbers that the registers FROM hold."
  (declare (type registers registers) (type register-vector from))
  (let ((hash 0))
    (declare (type (unsigned-byte 64) hash))
    (loop for register across from
          do (setf hash (ldb (byte 64 0) (* (logxor hash (double-bits (aref registers register)))
                                            #x9E3779B97F4A7C15))
                   hash (logxor hash (ash hash -29))))
    (ldb (byte +bits-kept+ 20) hash)))

(declaim (inline neighbour-place))
(defun neighbour-place (place) (logxor place 1))

(declaim (inline same-numbers-p))
(defun same-numbers-p (entry registers from)
  (declare (type numbers entry) (type registers registers) (type register-vector from))
  (loop for register across from
        for place of-type fixnum from 0
        always (= (aref entry place) (aref registers register))))

(declaim (inline entry-at))
(defun entry-at (kept place registers from)
  "Return the entry at PLACE of KEPT if it is that of the numbers in the registers FROM, or NIL."
  (declare (type simple-vector kept))
  (let ((entry (svref kept place)))
    (and entry (same-numbers-p entry registers from) entry)))

(defun keep-entry (kept place entry)
  "Keep ENTRY at PLACE of KEPT; what was there goes to the place beside it, so that a plan may ask
for two results of one place again and again.  Return ENTRY."
  (declare (type simple-vector kept))
  (let ((old (svref kept place)))
    (when old (keep-in kept (neighbour-place place) old))
    (keep-in kept place entry)))

(defun new-entry (computation registers from)
  "Return the entry of COMPUTATION for the numbers in the registers FROM, computed now."
  (declare (type register-vector from))
  (let ((numbers (copy-seq (the numbers (computation-numbers computation))))
        (key (map 'numbers (lambda (register) (aref registers register)) from)))
    (loop for place in (computation-places computation)
          for number across key
          do (setf (aref numbers place) number))
    (let ((results (funcall (computation-function computation) numbers)))
      (if (and results (every #'finite-p results))
          (concatenate 'numbers key results)
          key))))

(defun computation-step (computation next from to)
  "Return the closure that puts the results of COMPUTATION, of the numbers in the registers FROM,
into those from TO, and calls NEXT.  It returns NIL if they have no value."
  (declare (type register-vector from) (type register to) (function next))
  (let ((kept (computation-kept computation)) (count (computation-count computation))
        (width (length from)))
    (lambda (registers)
      (declare (type registers registers) (optimize speed))
      (let* ((place (place-kept registers from))
             (entry (or (entry-at kept place registers from)
                        (entry-at kept (neighbour-place place) registers from)
                        (keep-entry kept place (new-entry computation registers from)))))
        (declare (type numbers entry))
        (when (> (length entry) width)
          (dotimes (i count)
            (setf (aref registers (+ to i)) (aref entry (+ width i))))
          (funcall next registers))))))

(defun computed-results (computation numbers)
  "Return what COMPUTATION gives for NUMBERS, a list of those that vary: a list, or NIL."
  (let* ((width (length numbers)) (count (computation-count computation))
         (registers (make-array (+ width count) :element-type 'double-float))
         (from (coerce (loop for i below width collect i) 'register-vector)))
    (replace registers numbers)
    (and (funcall (the function (computation-step computation (constantly t) from width)) registers)
         (coerce (subseq registers width) 'list))))
