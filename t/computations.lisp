;;;; computations.lisp -- results that are kept for a while.

(in-package :supergrip-test)
(define-suite computations "Results that are kept for a while.")

(defun counted-computation (function)
  "Return a computation of one number of one other by FUNCTION, and a function that tells how often
FUNCTION was called."
  (let ((count 0))
    (values (supergrip::make-computation
             :name "TEST" :count 1 :places '(0) :rising '(nil) :components #()
             :numbers (doubles-of 0)
             :function (lambda (numbers)
                         (incf count)
                         (let ((result (funcall function (aref numbers 0))))
                           (and result (doubles-of result)))))
            (lambda () count))))

(test what-is-kept-is-not-computed-again
  (multiple-value-bind (computation calls) (counted-computation #'sqrt)
    (loop repeat 3 do (is (equal '(3d0) (supergrip::computed-results computation '(9d0)))))
    (is (= 1 (funcall calls)))
    (is (equal '(2d0) (supergrip::computed-results computation '(4d0))))
    (is (= 2 (funcall calls)))))

(test what-has-no-value-is-kept-too
  (multiple-value-bind (computation calls) (counted-computation (constantly nil))
    (loop repeat 3 do (is (null (supergrip::computed-results computation '(9d0)))))
    (is (= 1 (funcall calls)))))

(test results-that-are-kept-are-bounded
  (let ((computation (counted-computation (lambda (x) (* 2 x)))))
    (dotimes (i 5000)
      (let ((x (/ i 7d0)))
        (assert (equal (list (* 2 x)) (supergrip::computed-results computation (list x))))))
    (let ((kept (supergrip::computation-kept computation)))
      (is (= supergrip::+places-kept+ (length kept)))
      ;; Most places are used, so the numbers are spread well.
      (is (> (count nil kept :test-not #'eq) (* 0.9 (length kept)))))))

(test threads-share-what-is-kept
  (let* ((computation (counted-computation (lambda (x) (+ x 1))))
         (threads (loop for seed below 4
                        collect (let ((state (sb-ext:seed-random-state seed)))
                                  (sb-thread:make-thread
                                   (lambda ()
                                     (loop repeat 20000
                                           for x = (coerce (random 3000 state) 'double-float)
                                           always (equal (list (+ x 1))
                                                         (supergrip::computed-results
                                                          computation (list x))))))))))
    (is (every #'identity (mapcar #'sb-thread:join-thread threads)))))
