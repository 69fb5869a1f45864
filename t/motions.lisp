;;;; motions.lisp -- motions in words, and where the contacts of a candidate have the least to
;;;; spare.

(in-package :supergrip-test)
(define-suite motions
  "Motions in words, and where the contacts of a candidate have the least to spare.")

(test the-pencil-has-its-true-radius
  "u_w is 1.095; cone programming says 0.880."
  (let ((plan (pencil-plan)))
    (multiple-value-bind (upper lower worst)
        (supergrip:candidate-exact-radius (supergrip:plan-best plan) plan :gap 1d-3 :absolute 1d-4)
      (is (<= 0.879d0 lower 0.8803d0 upper 0.8813d0))
      (is (string= "pushed along -Y and turned about +Y"
                   (supergrip:direction-text worst
                                             (supergrip:box-force-needed
                                              (supergrip:plan-box plan))))))))

(test a-candidate-without-a-force-radius-has-no-exact-one
  (let ((plan (supergrip:plan (changed-box :force-needed '(0 0 0 0 0 0)))))
    (is (null (supergrip:candidate-exact-radius (supergrip:plan-best plan) plan))))
  (let* ((plan (supergrip:plan (plan-box-too-heavy)))
         (rejected (supergrip:plan-rejected plan)))
    (is (not (null rejected)))
    (is (notany (lambda (candidate) (supergrip:candidate-exact-radius candidate plan)) rejected))))

(test the-upper-value-is-the-power-in-the-worst-motion
  "The contacts are the candidate's, the task and the weight the box's."
  (let ((checked 0))
    (for-random-boxes (box 60 43)
      (let ((plan (supergrip:plan box)))
        (loop with need = (supergrip:box-force-needed (supergrip:plan-box plan))
              for candidate in (supergrip:plan-possible plan)
              repeat 3
              do (multiple-value-bind (upper lower worst)
                     (supergrip:candidate-exact-radius candidate plan)
                   (when (and upper (plusp upper))
                     (incf checked)
                     (is (or (null lower) (<= lower upper)))
                     (is (close-to upper (/ (spare-power (candidate-case candidate plan need) worst)
                                            (norm (mapcar #'* need worst)))
                                   1d-9)))))))
    (is (< 30 checked))))

(test a-direction-is-told-by-what-counts-in-it
  "What counts has a third of the greatest share in the wrench, which is need times motion."
  (loop for (motion need text) in
        '(((0 1 0 0 0 -1) (1 1 1 1 1 1) "pushed along +Y and turned about -Z")
          ((0 0 -2 0 0 0) (1 1 1 1 1 1) "pushed along -Z")
          ((0 0 0 0 5 0) (1 1 1 1 1 1) "turned about +Y")
          ((1 -1 0 0 0 0) (1 1 1 1 1 1) "pushed along +X and -Y")
          ((1 -1 1 0 0.3 0) (1 1 1 1 1 1) "pushed along +X, -Y and +Z")
          ((1 -1 1 1 1 1) (1 1 1 1 1 1)
           "pushed along +X, -Y and +Z and turned about +X, +Y and +Z")
          ;; The needs decide what counts: a motion along what is not needed does not.
          ((9 1 0 0 0 0.3) (0 0.2 0 0 0 1) "pushed along +Y and turned about +Z")
          ((1 1 0 0 0 0) (1 0.3 0 0 0 0) "pushed along +X")
          ;; Nothing that is needed moves: the weight alone is too much.
          ((0 0 1 0.5 0 0) (1 0 0 0 0 0) "pushed along +Z and turned about +X")
          ((1d-200 0 0 0 0 -1d-200) (1d-150 0 0 0 0 1d-150) "pushed along +X and turned about -Z"))
        do (is (string= text (supergrip:direction-text motion need)) "~s ~s" motion need)))
