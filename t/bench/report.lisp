;;;; report.lisp -- measures everything and prints it in tables, as docs/speed.md has them.

(in-package :supergrip-bench)

(defun machine ()
  "Return the processor's name, how many there are, and the Lisp."
  (let ((models (ignore-errors
                 (loop for line in (uiop:read-file-lines "/proc/cpuinfo")
                       when (eql 0 (search "model name" line))
                         collect (string-trim " " (subseq line (1+ (position #\: line))))))))
    (format nil "~a, ~d processor~:p, ~a ~a" (or (first models) (machine-type)) (length models)
            (lisp-implementation-type) (lisp-implementation-version))))

(defun today ()
  (multiple-value-bind (second minute hour day month year) (get-decoded-time)
    (declare (ignore second minute hour))
    (format nil "~d-~2,'0d-~2,'0d" year month day)))

(defun three-digits (number)
  "Return NUMBER, above 0, with three digits or more."
  (cond ((>= number 100) (format nil "~:d" (round number)))
        ((>= number 10) (format nil "~,1f" number))
        ((>= number 1) (format nil "~,2f" number))
        (t (format nil "~,3f" number))))

(defun time-text (seconds)
  "Return SECONDS with three digits and a unit."
  (let ((number (float seconds 1d0)))
    (flet ((text (value unit)
             (format nil "~a ~a" (three-digits value) unit)))
      (cond ((>= number 1) (text number "s"))
            ((>= number 1d-3) (text (* number 1d3) "ms"))
            (t (text (* number 1d6) "µs"))))))

(defun print-head (title)
  (format t "~%| ~a | minimum | median | bytes | ratio |~%| --- | --- | --- | --- | --- |~%" title))

(defun print-figures (figures &optional (unit (first figures)))
  "Print a line for each of FIGURES; the ratio is that of its minimum to the minimum of UNIT, which
a busy machine disturbs least."
  (dolist (figure figures)
    (format t "| ~a | ~a | ~a | ~:[~;~:*~:d~] | ~a |~%" (figure-name figure)
            (time-text (figure-minimum figure)) (time-text (figure-median figure))
            (and (figure-bytes figure) (round (figure-bytes figure)))
            (three-digits (float (/ (figure-minimum figure) (figure-minimum unit)) 1d0))))
  (finish-output))

(defun plan-figures ()
  (let ((task (box-task *box*)) (out (new-six)))
    (measure-together
     '("whole plan" "the same by the floor" "the same by the reference engine")
     (list (lambda () (supergrip:plan *box*))
           (lambda () (pencil-qualities task out))
           (lambda () (supergrip-oracle:oracle-plan *pencil* *oracle*))))))

(defun rule-figures ()
  (let ((rules (rules-function (rules-alone (shipped-rules)))))
    (measure-together
     '("rule part" "the same by bit code" "the same by the reference engine")
     (list (lambda () (funcall rules *box*))
           (lambda () (bit-rules *box*))
           (oracle-rules-function)))))

(defun part-figures ()
  (let ((plan (supergrip:plan *box*)))
    (measure-together
     '("TRY part, six candidates" "one form, a WRENCH"
       "reading and preparing rules and grasps")
     (list (try-function plan) (form-function plan) #'supergrip:load-knowledge))))

(defun print-sessions ()
  (print-head "pencil session")
  (let ((plan (plan-figures)))
    (print-figures plan)
    (print-figures (part-figures) (first plan)))
  (let ((rules (rule-figures)))
    (print-figures rules)
    (print-figures (clips-figures) (first rules))))

(defun print-processes (times)
  (print-head "processes")
  (let ((*batches* (min *batches* 7)))
    (with-executable (executable)
      (print-figures (start-up-figures executable))
      (print-figures (batch-figures executable times)))))

(defun print-growth (boxes)
  (print-head "growth, whole plan of the pencil unless said")
  (print-figures (rules-growth "rules that can't fire," #'barred-copy-of-rules))
  (print-figures (rules-growth "rules that fire," #'copy-of-rules))
  (print-figures (preparing-growth))
  (let ((grasps (grasps-growth)))
    (print-figures (subseq grasps 0 2))
    (print-figures (subseq grasps 2)))
  (let ((figures (boxes-growth boxes)))
    (print-figures (remove-if #'numberp figures))
    (print-figures (threads-growth (min 30000 (first (last boxes)))))
    (format t "~%Memory in use after each number of boxes, MB: ~{~a~^, ~}~%"
            (remove-if-not #'numberp figures))))

(defun print-radii (times)
  "Print what the exact radius of 100 random grasps costs, the least of TIMES runs of each."
  (let ((seconds '()) (evaluations '()) (certified 0) (unit (support-seconds)))
    (dolist (grasp (random-grasps 100 1))
      (multiple-value-bind (time count lower) (radius-figures grasp times)
        (push time seconds)
        (push count evaluations)
        (when lower (incf certified))))
    (flet ((print-line (name text list)
             (let ((sorted (sort (copy-list list) #'<)))
               (format t "| ~a |~{ ~a |~}~%" name
                       (loop for place in '(49 89 99)
                             collect (funcall text (nth place sorted)))))))
      (format t "~%| exact radius, 100 random grasps, six needs, 1 % | median | 90 % | greatest |~%~
                 | --- | --- | --- | --- |~%")
      (print-line "time of a radius" #'time-text seconds)
      (print-line "support functions computed" (lambda (n) (format nil "~:d" n)) evaluations)
      (print-line "time of a radius / time of one support function" #'three-digits
                  (mapcar (lambda (time) (float (/ time unit) 1d0)) seconds))
      (format t "~%~d of 100 are certified; one support function takes ~a.~%" certified
              (time-text unit)))))

(defun run-benchmark (&key quick)
  "Measure all, print tables.  QUICK: short batches, for a try of the benchmark itself."
  (let ((*batches* (if quick 5 150)))
    (check-floor)
    (check-bits (random-boxes 1000 5))
    (format t "~a, ~a~%Times are of one call; a ratio is that of minima, to the first line of ~
               its group.~%" (today) (machine))
    (print-sessions)
    (print-radii (if quick 1 7))
    (print-processes (if quick 1 20))
    (print-growth (if quick '(1000 10000) '(1000 10000 100000 1000000)))))
