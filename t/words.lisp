;;;; words.lisp -- the paper's lists, typed: data for the user, in the user's symbols.

(in-package :supergrip-test)
(define-suite words "The paper's lists, typed: data for the user, in the user's symbols.")

(defun typed-value (text)
  "Return the value of TEXT, typed in SUPERGRIP-USER, as it prints."
  (let ((value (eval-in-user text)) (*package* (find-package :supergrip-user))
        (*print-pretty* nil))
    (prin1-to-string value)))

(test words-show-the-lists-of-the-paper
  (with-session ()
    (supergrip:forward-chain :stream nil)
    (loop for (word value) in
          '(("possible-grasps"
             "((PINCH-3-PARALLEL 0.86 (Y2 Y1 X2 X1 Z2 Z1)) (PINCH-3-U-SHAPE 0.77034885 (X1 X2 Y2 Y1 Z2 Z1)) (PINCH-3-C-SHAPE 0.7686782 (Y1 Y2 X1 X2 Z2 Z1)) (PINCH-3-PARALLEL 0.6460169 (Y2 Y1 Z2 Z1 X1 X2)) (PINCH-3-C-SHAPE 0.43621135 (Y2 Y1 Z2 Z1 X1 X2)) (PINCH-3-U-SHAPE 0.3107437 (Z2 Z1 Y1 Y2 X1 X2)))")
            ("(rest (member 'constrained assertions :key #'first))"
             "((PARALLEL (Y2 Y1)) (OBJECT HAS PARALLEL SURFACES) (ADJACENT (Z1 Y2) (Z1 Y1) (Z1 X2) (Y2 X2) (Y1 X2)) (OBJECT HAS ADJACENT SURFACES) (CORNER (Z1 Y2 X2) (Z1 Y1 X2)) (OBJECT HAS FREE CORNERS))")
            ("(subseq assertions 0 3)"
             "((OPPOSED (Z2 Z1) (Y2 Y1) (X2 X1)) (LARGE (X2 X1)) (CONSTRAINED (Z2) (X1)))")
            ("(first rules)"
             "(RULE GRIP1 (IF (SMALL (S1 S2)) (CONSTRAINED (S1))) (THEN (CANT GRASP TOO SMALL TO PICK UP)))")
            ("(subseq grasps 0 2)" "(PINCH-2-PARALLEL PINCH-3-PARALLEL)")
            ("(subseq gripper 0 6)" "(FINGER-LENGTH 3.2 FINGER-DIST 6.05 FINGER-SPREAD 1.7375)")
            ("(getf pinch-2-parallel 'wrench)"
             "(1 (* 2 U) (* 2 U) (* 2 V) (* U (DIST (QUOTE (N1 N2)))) (* U (DIST (QUOTE (N1 N2)))))")
            ("(getf pinch-2-parallel 'twist)" "(0.8 0.5 1 0.2 1 1)")
            ("(equal (list possible-grasps assertions rules grasps gripper)
                     (list possible-grasps (assertions) (rules) (grasps) (gripper)))" "T")
            ("(possible-grasps)"
             "((\"PINCH-3-PARALLEL\" 0.8600000000000001d0 (\"Y2\" \"Y1\" \"X2\" \"X1\" \"Z2\" \"Z1\")) (\"PINCH-3-U-SHAPE\" 0.7703488372093023d0 (\"X1\" \"X2\" \"Y2\" \"Y1\" \"Z2\" \"Z1\")) (\"PINCH-3-C-SHAPE\" 0.7686781609195402d0 (\"Y1\" \"Y2\" \"X1\" \"X2\" \"Z2\" \"Z1\")) (\"PINCH-3-PARALLEL\" 0.6460168748589009d0 (\"Y2\" \"Y1\" \"Z2\" \"Z1\" \"X1\" \"X2\")) (\"PINCH-3-C-SHAPE\" 0.43621134020618557d0 (\"Y2\" \"Y1\" \"Z2\" \"Z1\" \"X1\" \"X2\")) (\"PINCH-3-U-SHAPE\" 0.31074370155038755d0 (\"Z2\" \"Z1\" \"Y1\" \"Y2\" \"X1\" \"X2\")))"))
          do (is (equal value (typed-value word)) "~a is ~a" word (typed-value word)))
    (let ((*read-default-float-format* 'double-float))
      (is (equal "0.8600000000000001" (typed-value "(second (first possible-grasps))")))
      (is (equal "(0.8 0.5 1 0.2 1 1)" (typed-value "(getf pinch-2-parallel 'twist)"))))
    (supergrip:try 'pinch-2-parallel '(y2 ? x2 ? ? ?) :stream nil)
    (is (equal "((PINCH-2-PARALLEL 0.325 (Y2 Y1 X2 X1 Z2 Z1)))" (typed-value "possible-grasps")))
    (is (equal "((OPPOSED (Z2 Z1) (Y2 Y1) (X2 X1)) (LARGE (X2 X1)) (CONSTRAINED (Z2) (X1)))"
               (typed-value "assertions")))
    (setf supergrip:*plan* nil)
    (is (equal "there is no plan yet: call (forward-chain) first"
               (error-text (eval-in-user "assertions"))))))

(defun symbols-in (form)
  (cond ((null form) '())
        ((symbolp form) (list form))
        ((consp form) (append (symbols-in (car form)) (symbols-in (cdr form))))))

(test lists-have-the-symbols-of-the-current-package
  (with-session ()
    (supergrip:forward-chain :stream nil)
    (dolist (name '(:supergrip-test-user :supergrip-user :keyword))
      (let* ((*package* (find-package name))
             (lists (list (supergrip:assertions) (supergrip:rules) (supergrip:grasps)
                          (supergrip:gripper) (supergrip:grasp 'pinch-3-corner))))
        (is (every (lambda (symbol) (eq symbol (find-symbol (symbol-name symbol))))
                   (symbols-in lists)))))
    (let ((*package* (find-package :supergrip-data))) ; is locked
      (is (equal "PINCH-2-PARALLEL" (string (first (supergrip:grasps))))))))

(test what-is-shown-is-data
  (with-session ()
    (let* ((*package* (find-package :supergrip-user))
           (plan (supergrip:forward-chain :stream nil))
           (rules (supergrip:rules)) (gripper (supergrip:gripper))
           (grasps (loop for name in (supergrip:grasps)
                         collect (list name (supergrip:grasp name)))))
      (mapc #'eval rules)
      (loop for (name plist) in (cons (list 'gripper gripper) grasps)
            do (supergrip:edit `(setq ,name ',plist)))
      (is (equal rules (supergrip:rules)))
      (is (equal gripper (supergrip:gripper)))
      (is (equal (figures (supergrip:plan-candidates plan))
                 (figures (supergrip:plan-candidates (supergrip:forward-chain :stream nil)))))
      (let ((lines (printed (mapc #'supergrip:how (supergrip:assertions)))))
        (dolist (line '("(OPPOSED (X2 X1)): input, opposite faces of the box"
                        "(CORNER (Z1 Y1 X2)): RULE SURFACES3 with S1 = Z1, S2 = Y1, S3 = X2"
                        "(OBJECT HAS FREE CORNERS): RULE SURFACES3 with S1 = Z1, S2 = Y2, S3 = X2"))
          (is (member line lines :test #'string=))))
      (dolist (rule (supergrip:rules))
        (is (equal (printed (supergrip:describe-rule (second rule)))
                   (printed (supergrip:describe-rule rule)))))
      (let ((supergrip::*breaks* '()))
        (is (equal '("GRIP1") (supergrip:break-on (first (supergrip:rules))))))
      (loop for (name nil matching) in (supergrip::typed-possible-grasps)
            do (is (= 1 (length (printed (supergrip:try name matching)))))))))

(test words-are-the-users-to-bind
  (loop for (value text) in
        '((10 "(let ((rules 1) (grasps 2) (gripper 3) (assertions 4)) (+ rules grasps gripper assertions))")
          (3 "(loop for possible-grasps from 1 to 3 finally (return (1- possible-grasps)))")
          (1 "(flet ((rules () 1)) (rules))")
          (5 "(let ((try 1) (keep 1) (grasp 3)) (+ try keep grasp))")
          (7 "(let ((pinch-3-parallel 7)) (setq pinch-3-parallel 7) pinch-3-parallel)")
          (6 "(progn (setq try 1 keep 2 grasp 3) (+ try keep grasp))"))
        do (is (equal value (eval-in-user text)) "~a" text))
  (dolist (word '(supergrip:possible-grasps supergrip:assertions supergrip:rules supergrip:grasps
                  supergrip:grasp supergrip:gripper supergrip:try supergrip:keep))
    (is (eq word (macroexpand-1 word)) "elsewhere, ~a is a word like others" word)))

(test a-grasp-that-is-added-is-a-word
  (with-session ()
    (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
      (eval-in-user "(setq typed-grasp '(used-surfaces (n1 n2 a2) conditions (u > 0)
                       offset (0 0 0 0 0 0) wrench (1 1 1 1 1 1) twist (1 1 1 1 1 0.5)))")
      (is (equal "(1 1 1 1 1 0.5)" (typed-value "(getf typed-grasp 'twist)")))
      (is (equal "TYPED-GRASP" (typed-value "(first (last grasps))")))
      (eval-in-user "(setq typed-grasp (subst 0.25 0.5 typed-grasp))")
      (is (equal "(1 1 1 1 1 0.25)" (typed-value "(getf typed-grasp 'twist)")))
      (eval-in-user "(defun shorter-fingers () (setq gripper (substitute 3 3.2 gripper)))")
      (eval-in-user "(shorter-fingers)")
      (is (equal "3" (typed-value "(second gripper)")))
      (eval-in-user "(setq finger-length (+ 0.5 finger-length))")
      (is (equal "(3.5 8.0)" (typed-value "(list finger-length width-hand)")))
      (eval-in-user "(setq finger-length 3)")
      (is (= 3 (cdr (assoc "FINGER-LENGTH" (supergrip:knowledge-gripper supergrip:*knowledge*)
                           :test #'string=))))
      (eval-in-user "(forget 'typed-grasp)")
      (is (search "there is no grasp TYPED-GRASP" (error-text (eval-in-user "typed-grasp"))))
      (eval-in-user "(defvar variable-of-the-user 3)")
      (supergrip:edit `(setq variable-of-the-user ',(supergrip:grasp 'pinch-2-parallel)))
      (supergrip:edit `(setq list ',(supergrip:grasp 'pinch-2-parallel)))
      (is (eql 3 (eval-in-user "variable-of-the-user")))
      (is (equal (supergrip:grasp 'pinch-2-parallel) (supergrip:grasp 'variable-of-the-user)))
      (is (equal (supergrip:grasp 'pinch-2-parallel) (supergrip:grasp 'list))))))

(test what-is-not-quoted-is-understood-or-told-of
  (with-session ()
    (let ((quoted (printed (eval-in-user "(progn (try 'pinch-3-parallel) (keep 'best))"))))
      (is (equal quoted (printed (eval-in-user "(progn (try pinch-3-parallel) (keep best))"))))
      (is (equal "WORST can't be kept: only the best can, by (keep 'best)"
                 (error-text (eval-in-user "(let ((best 'worst)) (keep best))")))))
    (loop for (text . typed)
            in '(("the quote is missing: write '(Y2 Y1 X2 X1 Z2 Z1)"
                  . "(try 'pinch-3-parallel (y2 y1 x2 x1 z2 z1))")
                 ("the quote is missing: write '(? X2 Y2 Y1 ? Z1)"
                  . "(why-not 'pinch-3-u-shape (? x2 y2 y1 ? z1))"))
          do (is (equal text (error-text (eval-in-user typed)))))))

(test words-that-only-show-can-not-be-set
  (let ((before supergrip:*knowledge*))
    (dolist (word '("possible-grasps" "assertions" "rules" "grasps"))
      (is (equal (format nil "~:@(~a~) shows what SUPER-GRIP holds, and can't be set: give your ~
                              variable another name"
                         word)
                 (error-text (eval-in-user (format nil "(setq ~a '(1 2))" word))))))
    (signals supergrip:supergrip-error (eval-in-user "(setq pinch-2-parallel 7)"))
    (is (eq before supergrip:*knowledge*))))

(test at-a-stop-words-show-what-is-known-now
  (with-session ((changed-box :weight 0.3d0))
    (supergrip:forward-chain :stream nil)
    (let ((supergrip::*breaks* '()) (seen '()))
      (mapc #'supergrip:break-on '(grip1 (adjacent (y2 z1)) grip9))
      (handler-bind
          ((supergrip:chain-break
             (lambda (condition)
               (declare (ignore condition))
               (push (list (typed-value "(mapcar #'first assertions)")
                           (typed-value "(length possible-grasps)"))
                     seen)
               (invoke-restart 'continue))))
        (supergrip:forward-chain (paper-box) :stream nil))
      (is (equal '(("(OPPOSED LARGE CONSTRAINED)" "0")
                   ("(OPPOSED LARGE CONSTRAINED PARALLEL OBJECT ADJACENT)" "0")
                   ("(OPPOSED LARGE CONSTRAINED PARALLEL OBJECT ADJACENT OBJECT CORNER OBJECT)"
                    "4"))
                 (reverse seen))))
    (is (equal "6" (typed-value "(length possible-grasps)")))))

(defun typed-in-debugger (text)
  "Return the value of TEXT, typed in the debugger, as it prints."
  (let ((*package* (find-package :supergrip-user)) (*print-pretty* nil))
    (handler-bind ((warning #'muffle-warning))
      (prin1-to-string (sb-di:eval-in-frame (sb-di:top-frame) (read-from-string text))))))

(test setq-in-the-debugger-is-at-top-level
  (with-session ()
    (typed-in-debugger "(setq stopped-grasp '(used-surfaces (n1 n2 a2) conditions (u > 0)
                          offset (0 0 0 0 0 0) wrench (1 1 1 1 1 1) twist (1 1 1 1 1 0.5)))")
    (is (equal "(1 1 1 1 1 0.5)" (typed-in-debugger "(getf stopped-grasp 'twist)")))
    (is (equal "STOPPED-GRASP" (typed-value "(first (last grasps))")))
    (typed-in-debugger "(setq finger-length 3.5)")
    (is (equal "3.5" (typed-in-debugger "finger-length")))
    (let ((knowledge supergrip:*knowledge*))
      (is (equal "(USED-SURFACES 1)"
                 (typed-in-debugger "(let (x) (setq x '(used-surfaces 1)) x)")))
      (typed-in-debugger "(defun set-from-a-function () (setq y '(used-surfaces 1)))")
      (is (equal "(USED-SURFACES 1)" (typed-value "(set-from-a-function)")))
      (is (eq knowledge supergrip:*knowledge*)))))
