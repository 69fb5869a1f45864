;;;; try-steps.lisp -- a step of TRY is one row, and why a candidate fails it is one, too.

(in-package :supergrip-test)
(define-suite try-steps "A step of TRY is one row, and why a candidate fails it is one, too.")

(test a-step-of-try-is-one-row
  (let ((supergrip::*steps* supergrip::*steps*))
    (supergrip::define-step warmth :cold (candidate workspace)
      (not (equal "PINCH-3-PARALLEL" (supergrip:candidate-grasp candidate))))
    (is (equal "it fails the step COLD"
               (supergrip::failure-text :cold nil nil nil))
        "what no row says")
    (supergrip::define-failure :cold (candidate workspace)
      :why (format nil "~a has cold fingers" (supergrip:candidate-grasp candidate))
      :shortfalls '(1/2))
    (unwind-protect
         (let* ((plan (supergrip:plan (paper-box)))
                (cold (find :cold (supergrip:plan-candidates plan)
                            :key #'supergrip:candidate-outcome)))
           (is (equal "PINCH-3-U-SHAPE" (supergrip:plan-grasp plan)))
           (is (equal "PINCH-3-PARALLEL" (supergrip:candidate-grasp cold)))
           (is (search "it has cold fingers"
                       (substitute-text "it" "PINCH-3-PARALLEL"
                                        (with-output-to-string (*standard-output*)
                                          (supergrip:why-not "PINCH-3-PARALLEL" plan)))))
           (is (eq cold (supergrip::nearest-miss (list cold) plan))))
      (dolist (generic (list #'supergrip::failure-text #'supergrip::failure-shortfalls))
        (let ((method (find-if (lambda (method)
                                 (equal '(eql :cold)
                                        (let ((first (first (sb-mop:method-specializers method))))
                                          (and (typep first 'sb-mop:eql-specializer)
                                               (list 'eql (sb-mop:eql-specializer-object first))))))
                               (sb-mop:generic-function-methods generic))))
          (when method (remove-method generic method)))))))

(defun substitute-text (new old text)
  "Return TEXT with NEW for the last OLD."
  (let ((place (search old text :from-end t)))
    (if place
        (concatenate 'string (subseq text 0 place) new (subseq text (+ place (length old))))
        text)))
