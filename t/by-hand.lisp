;;;; by-hand.lisp -- TRY and KEEP, typed: one TRY for rules and for users.

(in-package :supergrip-test)
(define-suite by-hand "TRY and KEEP, typed: one TRY for rules and for users.")

(defun names-and-matchings (candidates)
  (loop for candidate in candidates
        collect (cons (supergrip:candidate-grasp candidate)
                      (supergrip:candidate-matching candidate))))

(defun figures (candidates)
  (loop for candidate in candidates
        collect (list (supergrip:candidate-grasp candidate)
                      (supergrip:candidate-matching candidate)
                      (supergrip:candidate-outcome candidate)
                      (supergrip:candidate-quality candidate))))

(test try-prints-what-is-possible-and-returns-what-it-tried
  (with-session ()
    (let* ((tried '())
           (lines (printed (setf tried (supergrip:try 'pinch-3-parallel)))))
      (is (equal '("(PINCH-3-PARALLEL IS O.K. Q=0.860, MATCHING: (Y2 Y1 X2 X1 Z2 Z1))"
                   "(PINCH-3-PARALLEL IS O.K. Q=0.646, MATCHING: (Y2 Y1 Z2 Z1 X1 X2))")
                 lines))
      (is (equal tried (supergrip:plan-candidates)))
      (is (= 3 (length (supergrip:candidate-contacts (first tried))))))
    (is (equal '("(PINCH-3-U-SHAPE IS O.K. Q=0.770, MATCHING: (X1 X2 Y2 Y1 Z2 Z1))")
               (printed (supergrip:try 'pinch-3-u-shape '(? x2 y2 y1 ? z1)))))
    (let ((supergrip::*traced* '("PINCH-3-CORNER")))
      (is (equal "  (PINCH-3-CORNER FAILS AT OPEN, MATCHING: (Z1 Z2 X2 X1 Y2 Y1)): open: the contacts don't close on this shape; needs u > 0.9864, has 0.8"
                 (first (printed (supergrip:try 'pinch-3-corner))))))
    (let ((failed '()))
      (is (equal '("(PINCH-3-CORNER IS NOT O.K., NEAREST MATCHING: (Z1 Z2 X2 X1 Y2 Y1): open: the contacts don't close on this shape; needs u > 0.9864, has 0.8)")
                 (printed (setf failed (supergrip:try 'pinch-3-corner)))))
      (is (equal '(:open :open) (mapcar #'supergrip:candidate-outcome failed))))
    (is (equal '("(BEST GRASP IS PINCH-3-PARALLEL WITH MATCHING (Y2 Y1 X2 X1 Z2 Z1))"
                 "(THE QUALITY INDEX IS 0.86)")
               (printed (is (eq (supergrip:plan-best supergrip:*plan*)
                                (supergrip:keep 'best))))))))

(test a-list-begins-after-a-run-of-rules-and-with-another-box
  (with-session ()
    (flet ((try (&rest arguments) (apply #'supergrip:try (append arguments '(:stream nil))))
           (possible () (length (supergrip:possible-grasps))))
      (supergrip:forward-chain :stream nil)
      (try 'pinch-2-parallel)
      (is (= 2 (possible)))
      (try 'pinch-3-parallel)
      (is (equal '("PINCH-3-PARALLEL" "PINCH-3-PARALLEL" "PINCH-2-PARALLEL" "PINCH-2-PARALLEL")
                 (mapcar #'first (supergrip:possible-grasps))))
      (setf (supergrip::current-box) (paper-box))
      (try 'pinch-3-u-shape)
      (is (= 6 (possible)) "the same box is no other box")
      (setf (supergrip::current-box) (changed-box :weight 0.3d0))
      (try 'pinch-2-parallel)
      (is (= 2 (possible)))
      (try 'pinch-3-parallel :box (paper-box))
      (try 'pinch-3-c-shape :box (paper-box))
      (is (= 4 (possible)) "another box, given with the grasp, is kept to")
      (try 'pinch-3-parallel)
      (is (= 2 (possible)))
      (supergrip:forward-chain :stream nil)
      (is (< 2 (possible)))
      (try 'pinch-2-parallel)
      (is (= 2 (possible))))))

(test what-is-tried-again-is-printed-again-and-kept-once
  (with-session ()
    (let ((once (printed (supergrip:try 'pinch-2-parallel))))
      (supergrip:try 'pinch-3-parallel :stream nil)
      (is (equal once (printed (supergrip:try "pinch-2-parallel"))))
      (is (equal (reverse once)             ; as it is asked for, though turned it is the same
                 (append (printed (supergrip:try 'pinch-2-parallel '(? ? z2 z1 ? ?)))
                         (printed (supergrip:try 'pinch-2-parallel '(y2 ? x2 ? ? ?))))))
      (is (= 4 (length (supergrip:plan-candidates))))
      (is (equal '("(PINCH-2-PARALLEL IS O.K. Q=0.325, MATCHING: (Y1 Y2 X1 X2 Z2 Z1))")
                 (printed (supergrip:try 'pinch-2-parallel '(y1 y2 x1 x2 z2 z1)))))
      (is (= 4 (length (supergrip:plan-candidates))))
      (supergrip:try 'pinch-2-parallel :stream nil)
      (is (= 4 (length (remove-duplicates (names-and-matchings (supergrip:plan-candidates))
                                          :test #'equal)))))))

(test all-that-was-tried-is-of-the-knowledge-and-gamma-in-force
  (with-session ()
    (flet ((best () (list (supergrip:plan-grasp) (supergrip:plan-gamma supergrip:*plan*))))
      (mapc (lambda (grasp) (supergrip:try grasp :stream nil)) '(pinch-3-parallel pinch-3-u-shape))
      (is (equal '("PINCH-3-PARALLEL" 0.5d0) (best)))
      (supergrip:try 'pinch-3-c-shape :gamma 1 :stream nil)
      (is (equal '("PINCH-3-PARALLEL" 1d0) (best)))
      (is (every (lambda (candidate)
                   (= (supergrip:candidate-quality candidate)
                      (supergrip:candidate-velocity-radius candidate)))
                 (supergrip:plan-possible)))
      (supergrip:edit `(setq pinch-3-parallel
                             ',(subst 0 0.8 (supergrip:grasp 'pinch-3-parallel))))
      (supergrip:try 'pinch-3-c-shape :stream nil)
      (is (equal '("PINCH-3-U-SHAPE" 0.5d0) (best)))
      (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
        (mapc #'supergrip:forget '(grip8 pinch-3-u-shape)))
      (supergrip:try 'pinch-3-parallel :stream nil)
      (is (notany (lambda (name) (equal name "PINCH-3-U-SHAPE"))
                  (mapcar #'first (supergrip:possible-grasps))) "what is gone is left out"))))

(test names-and-suggestions-are-spelled-in-any-way
  (with-session ()
    (supergrip:forward-chain :stream nil)
    (destructuring-bind (name quality matching) (first (supergrip:possible-grasps))
      (declare (ignore quality))
      (let ((lines (printed (supergrip:try name matching))))
        (is (= 1 (length lines)))
        (dolist (spelled (list matching '(:y2 #:y1 "x2" |x1| z2 "Z1") "y2 y1 x2 x1 z2 z1"
                               "(? ? ? X1 ? Z1)" '(? "?" :? #:x1 ? z1)))
          (is (equal lines (printed (supergrip:try name spelled)))))
        (dolist (spelled (list '|pinch-3-parallel| :pinch-3-parallel
                               (supergrip:grasp 'pinch-3-parallel)
                               (second (supergrip:knowledge-grasps supergrip:*knowledge*))))
          (is (equal lines (printed (supergrip:try spelled matching)))))))
    (is (equal (printed (supergrip:why-not 'pinch-3-c-shape))
               (printed (supergrip:why-not (supergrip:grasp "Pinch-3-C-Shape")))))
    (dolist (name '(best "best" :best |best|))
      (is (= 2 (length (printed (supergrip:keep name))))))))

(test what-can-not-be-tried-is-told
  (with-session ()
    (loop for (text . arguments) in
          '(("there is no grasp PINCH-9; grasps are PINCH-2-PARALLEL, PINCH-3-PARALLEL, PINCH-3-U-SHAPE, PINCH-3-C-SHAPE, PINCH-2-ADJACENT, PINCH-3-ADJACENT, PINCH-3-CORNER"
             pinch-9)
            ("(? S3 S1 S2 ? S4) is not a suggested matching: that is six faces, for N1 N2 O1 O2 A1 A2, with ? for any, such as (? X2 Y2 Y1 ? Z1)"
             pinch-3-u-shape (? s3 s1 s2 ? s4))
            ("(X1) is not a suggested matching: that is six faces, for N1 N2 O1 O2 A1 A2, with ? for any, such as (? X2 Y2 Y1 ? Z1)"
             pinch-3-u-shape (x1))
            ("no matching has (X1 Y1 ? ? ? ?): N O A must be a proper rotation of X Y Z, N1 opposite N2, and so on"
             pinch-3-u-shape (x1 y1 ? ? ? ?))
            ("the six faces go in one list: (try 'PINCH-3-U-SHAPE '(Y2 Y1 X2 X1 Z2 Z1))"
             pinch-3-u-shape y2 y1 x2 x1 z2 z1)
            ("the six faces go in one list: (try 'PINCH-3-U-SHAPE '(? X2 ? ? ? ?))"
             pinch-3-u-shape ? "x2" :gamma 1)
            ("0.3 is not a key of TRY: keys are :BOX, :KNOWLEDGE, :GAMMA, :INDEX, :STREAM; a value goes after its key, as in (try 'pinch-3-parallel :gamma 0.3)"
             pinch-3-u-shape nil 0.3)
            ("TRACE is not a key of TRY: keys are :BOX, :KNOWLEDGE, :GAMMA, :INDEX, :STREAM"
             pinch-3-u-shape nil :trace 3)
            ("there is no value after the key :GAMMA of TRY" pinch-3-u-shape :gamma))
          do (is (equal text (error-text (apply #'supergrip:try arguments)))))
    (is (null supergrip:*plan*))
    (is (equal "WORST can't be kept: only the best can, by (keep 'best)"
               (error-text (supergrip:keep 'worst))))
    (signals supergrip:gamma-error (supergrip:try 'pinch-3-corner :gamma 2))
    (signals supergrip:box-error (supergrip:try 'pinch-3-corner :box 3))
    (signals supergrip:no-plan-error (supergrip:keep 'best))
    (setf supergrip::*box* nil)
    (signals supergrip:no-box-error (supergrip:try 'pinch-3-corner))))

(test where-nothing-is-possible-keep-says-why
  (with-session ((changed-box :constrained 'y1 'y2 'z1 'z2 'x1))
    (is (equal '("(PINCH-3-PARALLEL IS NOT O.K.: EVERY MATCHING ASKED FOR WOULD USE A CONSTRAINED FACE)")
               (printed (is (null (supergrip:try 'pinch-3-parallel))))))
    (is (equal '("(CANT GRASP: WHAT WAS TRIED WOULD USE A CONSTRAINED FACE)")
               (printed (is (null (supergrip:keep 'best))))))
    (is (equal "RULE GRIP9 did not run: PINCH-3-PARALLEL was tried without rules."
               (first (printed (supergrip:why-not 'grip9)))))
    (supergrip:try 'pinch-2-parallel)
    (is (equal "RULE GRIP9 did not run: PINCH-3-PARALLEL, PINCH-2-PARALLEL were tried without rules."
               (first (printed (supergrip:why-not 'grip9))))))
  (with-session ()
    (is (null (supergrip:try 'pinch-3-parallel '(? ? ? ? ? z2))) "it would use Z2")))

(defun some-faces-of-a-matching (state)
  "Return a suggestion with some faces of a random matching."
  (loop for face in (supergrip::matching-names (svref supergrip::+matchings+ (random 24 state)))
        collect (if (chance 70 state) "?" face)))

(test what-is-typed-is-the-try-of-the-rules
  (let ((state (sb-ext:seed-random-state 61)) (tried 0))
    (format t "~&   600 random boxes, seed 61~%")
    (dotimes (i 60)
      (let* ((grasp (random-element *shipped-grasps* state))
             (suggestion (some-faces-of-a-matching state))
             (knowledge (text-knowledge
                         (format nil "(RULE R (IF (OPPOSED (X1 X2))) (THEN (TRY ~a ~a)))" grasp
                                 suggestion)
                         (file-text "grasps.lisp"))))
        (dotimes (j 10)
          (let* ((box (random-box state))
                 (plan (supergrip:plan box :knowledge knowledge))
                 (supergrip:*plan* nil)
                 (lines (printed
                          (is (equal (figures (supergrip:plan-candidates plan))
                                     (figures (supergrip:try grasp suggestion :box box)))))))
            (incf tried (length (supergrip:plan-candidates plan)))
            (when (supergrip:plan-best plan)
              (is (equal lines (butlast (lines-of (transcript plan))
                                        3))))))))
    (is (< 400 tried))))

(test an-unfinished-run-is-no-verdict
  (with-session ()
    (let ((supergrip::*breaks* '()) (seen '()))
      (mapc #'supergrip:break-on '(grip8 grip11))
      (handler-bind
          ((supergrip:chain-break
             (lambda (condition)
               (declare (ignore condition))
               (push (list (supergrip:plan-verdict) (supergrip:plan-grasp)
                           (printed (supergrip:keep 'best))
                           (first (printed (supergrip:why-not 'pinch-3-parallel)))
                           (last (lines-of (transcript supergrip:*plan*)) 2))
                     seen)
               (supergrip:try 'pinch-2-parallel :stream nil) ; is no part of the run
               (invoke-restart 'continue))))
        (supergrip:forward-chain :stream nil))
      (is (equal '((:unfinished nil ("(THE RUN IS NOT OVER)") "PINCH-3-PARALLEL: no rule tried it."
                    ("(THE RUN IS NOT OVER)" "--END--"))
                   (:unfinished "PINCH-3-PARALLEL"
                    ("(BEST GRASP SO FAR IS PINCH-3-PARALLEL WITH MATCHING (Y2 Y1 X2 X1 Z2 Z1))"
                     "(THE QUALITY INDEX IS 0.86)")
                    "PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1): it is the best grasp so far."
                    ("(THE QUALITY INDEX IS 0.86)" "--END--")))
                 (reverse seen)))
      (is (eq :grasp (supergrip:plan-verdict)))
      (is (= 6 (length (supergrip:plan-candidates)))))))

(test the-session-of-the-papers-user
  (with-knowledge-restored
    (let ((supergrip::*box* nil) (supergrip:*plan* nil))
      (check-transcript (lines-of (file-text "t/paper-user.txt")) "t/paper-user.txt"))))
