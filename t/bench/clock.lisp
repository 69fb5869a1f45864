;;;; clock.lisp -- how long functions take, and how much they cons.

(in-package :supergrip-bench)

(defvar *batch-seconds* 1/100
  "How long a batch of calls lasts at least.  Short ones are less likely to be disturbed.")

(defvar *batches* 150 "How many batches of each function are timed.")

(defstruct figure
  "A measurement: MINIMUM and MEDIAN seconds, and BYTES consed, of one call; BYTES may be NIL."
  name minimum median bytes)

(defun now ()
  "Return the time in seconds, to the microsecond: GET-INTERNAL-REAL-TIME may tick every 4 ms."
  (multiple-value-bind (seconds microseconds) (sb-ext:get-time-of-day)
    (+ seconds (/ microseconds 1000000))))

(defun seconds-of (function calls)
  "Return how many seconds CALLS calls of FUNCTION take."
  (declare (function function) (fixnum calls))
  (let ((start (now)))
    (loop repeat calls do (funcall function))
    (- (now) start)))

(defun calls-in-a-batch (function)
  "Return how many calls of FUNCTION last *BATCH-SECONDS*.  Finding out warms it up."
  (flet ((long-p (calls) (>= (seconds-of function calls) *batch-seconds*)))
    (loop for calls = 1 then (* 2 calls)
          ;; More than once: the machine may have been busy with something else.
          when (loop repeat 3 always (long-p calls)) return calls)))

(defun bytes-of (function calls)
  "Return how many bytes a call of FUNCTION conses, from CALLS calls of it.
Memory is taken by regions, so many calls are needed for a true figure."
  (declare (function function) (fixnum calls))
  (let ((before (sb-ext:get-bytes-consed)))
    (loop repeat calls do (funcall function))
    (/ (- (sb-ext:get-bytes-consed) before) calls)))

(defun figure-of (name seconds &optional bytes)
  "Return the figure NAME of SECONDS, a list of measurements of one call."
  (let ((sorted (sort (copy-list seconds) #'<)))
    (make-figure :name name :minimum (first sorted) :bytes bytes
                 :median (nth (floor (length sorted) 2) sorted))))

(defun measure-together (names functions)
  "Return a figure of each of FUNCTIONS, which have NAMES and take no arguments.
Their batches take turns, so that a busy machine is busy for all of them: ratios can be trusted
more than the figures themselves."
  (let ((calls (mapcar #'calls-in-a-batch functions))
        (seconds (make-list (length functions) :initial-element '())))
    (sb-ext:gc)
    (loop repeat *batches*
          do (setf seconds (loop for function in functions
                                 for count in calls
                                 for before in seconds
                                 collect (cons (/ (seconds-of function count) count) before))))
    (loop for name in names
          for function in functions
          for count in calls
          for measured in seconds
          collect (figure-of name measured (bytes-of function count)))))
