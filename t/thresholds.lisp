;;;; thresholds.lisp -- sbcl --script t/thresholds.lisp [BOXES [SEED [PLACES]]]
;;;;
;;;; Compares what EXPLAIN-BEST and REQUIRES say of random boxes with a scan of each value, PLACES
;;;; each way, that is refined by halving; no part of the tests, which do so with a few boxes.

(load (merge-pathnames "registry.lisp" *load-truename*))

(let ((*standard-output* (make-broadcast-stream)))
  (handler-bind ((warning #'muffle-warning))
    (asdf:load-system "supergrip/test")))

(in-package :supergrip-test)

(destructuring-bind (&optional (count 10000) (seed 1) (places 200))
    (mapcar #'parse-integer (rest sb-ext:*posix-argv*))
  (let ((state (sb-ext:seed-random-state seed)) (faults 0))
    (loop for number from 1 to count
          for upright = (funcall (if (zerop (mod number 4)) #'even-box #'random-box) state)
          for box = (if (zerop (mod number 3)) (laid upright state) upright)
          for supergrip:*gamma* = (random-element '(0 0.3d0 0.5d0 1) state)
          for fault = (scan-fault box places state)
          do (when fault
               (incf faults)
               (format t "~s~%  ~s~%" box fault))
             (when (zerop (mod number 500))
               (format t "~d boxes, ~d faults~%" number faults)
               (finish-output)))
    (format t "~d boxes, seed ~d, ~d places each way: ~d faults~%" count seed places faults)
    (sb-ext:exit :code (if (zerop faults) 0 1))))
