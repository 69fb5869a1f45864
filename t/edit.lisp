;;;; edit.lisp -- knowledge that is changed while at work, and what an edit has changed.

(in-package :supergrip-test)
(define-suite edit "Knowledge that is changed while at work, and what an edit has changed.")

(test continue-after-a-bad-edit-keeps-what-was
  (let ((before supergrip:*knowledge*))
    (with-knowledge-restored
      (handler-bind ((supergrip:knowledge-error #'continue))
        (supergrip:edit '(rule grip9 (if (parallel (s1))) (then (keep best)))))
      (is (eq before supergrip:*knowledge*)))))

(test an-edit-comes-into-force-at-once
  (with-knowledge-restored
    (let ((before (pencil-plan)))
      (supergrip:edit '(rule grip9 (if (parallel (s1 s2)) (large (s1 s2)))
                        (then (try pinch-3-parallel (s1 s2 ? ? ? ?)))))
      (is (equal "PINCH-3-U-SHAPE" (supergrip:plan-grasp (pencil-plan))))
      (is (= (length (supergrip:knowledge-rules (supergrip:plan-knowledge before))) (rule-total)))
      (is (equal "PINCH-3-PARALLEL" (supergrip:plan-grasp before)))
      (is (= 6 (length (supergrip:plan-candidates before))) "plans made before keep theirs")))
  (is (equal "PINCH-3-PARALLEL" (supergrip:plan-grasp (pencil-plan)))))

(test a-new-rule-goes-before-the-last
  (with-knowledge-restored
    (supergrip:rule grip12 (if (parallel (s1 s2))) (then (try pinch-2-parallel (s1 s2 ? ? ? ?))))
    (is (equal '("GRIP12" "GRIP11")
               (mapcar #'supergrip-chainer:rule-name
                       (last (supergrip:knowledge-rules supergrip:*knowledge*) 2))))
    (is (= 8 (length (supergrip:plan-candidates (pencil-plan)))))
    (supergrip:edit '(rule early (if (slippery)) (then (cant do))) :before 'grip2)
    (is (equal "EARLY" (supergrip-chainer:rule-name
                        (second (supergrip:knowledge-rules supergrip:*knowledge*)))))
    (supergrip:edit '(rule early (if (slippery)) (then (cant do it))) :before 'grip1)
    (is (equal '("EARLY" "GRIP1" "GRIP2")
               (mapcar #'supergrip-chainer:rule-name
                       (subseq (supergrip:knowledge-rules supergrip:*knowledge*) 0 3)))
        "a rule that is there moves")
    (signals supergrip:no-rule-error
      (supergrip:edit '(rule early (if (slippery)) (then (cant do))) :before 'grip99))))

(test names-in-an-edit-may-be-strings
  (with-knowledge-restored
    (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
      (supergrip:edit '(input "fragile" ("s1")))
      (supergrip:edit '("input" "very dry")))
    (is (equal '((("FRAGILE") 1) (("VERY" "DRY") 0))
               (supergrip:declared-inputs supergrip:*knowledge*)))
    (supergrip:edit '("rule" "grip12"
                      ("if" ("parallel" ("s1" "s2")) ("fragile" ("s1")) ("not very dry"))
                      ("then" ("try" "pinch-2-parallel" ("s1" "s2" "?" "?" "?" "?")))))
    (is (equal "(RULE GRIP12 (IF (PARALLEL (S1 S2)) (FRAGILE (S1)) (NOT VERY DRY)) (THEN (TRY PINCH-2-PARALLEL (S1 S2 ? ? ? ?))))"
               (supergrip-data:form-text
                (supergrip-chainer:rule-form
                 (find "GRIP12" (supergrip:knowledge-rules supergrip:*knowledge*)
                       :key #'supergrip-chainer:rule-name :test #'string=)))))))

(test a-refused-declaration-is-told-of-once
  (loop for (form . text)
          in '(((input dry 3) . "INPUT DRY: (INPUT DRY 3): a sentence is made of words, and may end in one list of surfaces")
               ((input fragile (z1))
                . "INPUT FRAGILE: a declaration holds for all surfaces: (INPUT FRAGILE (S1))")
               ((input not dry) . "INPUT NOT DRY: a negation can't be declared: what the input does not say is false"))
        do (is (equal (list text "The knowledge in force stays as it was.")
                      (lines-of (error-text (supergrip:edit form)))))))

(test rules-and-grasps-are-forgotten
  (let ((before supergrip:*knowledge*) (rules (rule-total)) (grasps (grasp-total)))
    (with-knowledge-restored
      (is (search "TRY names PINCH-3-CORNER, which is not in the database"
                  (handler-case (supergrip:forget 'pinch-3-corner)
                    (supergrip:knowledge-error (condition) (princ-to-string condition)))))
      (is (eq before supergrip:*knowledge*) "rules try it")
      (handler-bind ((supergrip:knowledge-warning
                      #'muffle-warning)) ; nothing tries the corner grasp
        (mapc #'supergrip:forget '(grip4 "GRIP5" grip10)))
      (supergrip:forget 'pinch-3-corner)
      (is (= (- rules 3) (rule-total)))
      (is (= (- grasps 1) (grasp-total)))
      (is (equal "PINCH-3-PARALLEL" (supergrip:plan-grasp (pencil-plan))))
      (signals supergrip:no-rule-error (supergrip:forget 'grip4)))))

(test a-broken-edit-leaves-the-last-good-knowledge
  (let ((before supergrip:*knowledge*))
    (let ((report (handler-case
                      (supergrip:edit '(rule grip9 (if (parallel (s1))) (then (frob))))
                    (supergrip:knowledge-error (condition) (princ-to-string condition)))))
      (is (equal '("RULE GRIP9, clause 1: PARALLEL takes 2 surfaces; here it has 1"
                   "RULE GRIP9, action 1: FROB is not an action; actions are REMEMBER, CANT, TRY, KEEP"
                   "The knowledge in force stays as it was.")
                 (remove-if (lambda (line) (search "warning" line))
                            (lines-of report)))))
    (is (eq before supergrip:*knowledge*))))

(test a-grasp-is-edited-by-setq
  (with-knowledge-restored
    (let ((before supergrip:*knowledge*))
      (eval-in-user "(setq pinch-2-parallel
                            '(used-surfaces (n1 n2 a2)
                              conditions ((dist '(n1 n2)) < 1)
                              offset (list 0 0 0 0 0 0)
                              wrench (1 1 1 1 1 1) twist (1 1 1 1 1 1)))")
      (is (null (supergrip:possible-grasps (supergrip:try-grasp "PINCH-2-PARALLEL" (paper-box)))))
      (is (= (length (supergrip:knowledge-grasps before)) (grasp-total)))))
  (let ((x 1))
    (supergrip-user:setq x 2)
    (is (= 2 x) "anything else is set as ever")))

(test setq-is-setq-where-a-variable-is-meant
  (let ((knowledge supergrip:*knowledge*))
    (loop for (value text) in
          '(((a . b) "(setq x '(a . b))")
            ((used-surfaces . b) "(setq x '(used-surfaces . b))")
            ((a b) "(setq x '(a b))")
            ((a used-surfaces) "(setq x '(a used-surfaces))")
            (nil "(setq)")
            (2 "(setq x 1 y 2)")
            ((a b) "(let ((gripper 1)) (setq gripper '(a b)) gripper)")
            ((a b) "(funcall (lambda (gripper) (setq gripper '(a b)) gripper) 1)")
            ((used-surfaces 1) "(let (x) (setq x '(used-surfaces 1)) x)")
            ((used-surfaces 1) "(symbol-macrolet ((x y)) (setq x '(used-surfaces 1)) y)")
            ((a b) "(progn (defvar *gripper*) (setq *gripper* '(a b)) *gripper*)")
            ((a . b) "(let ((box 1)) (setq box '(a . b)) box)")
            (t "(eq 'cl:setq (first (macroexpand-1 '(setq x 1))))"))
          do (is (equal (prin1-to-string value)
                        (let ((value (eval-in-user text))
                              (*package* (find-package :supergrip-user)))
                          (prin1-to-string value)))
                     "~a" text))
    (is (eq t (eval-in-user "(progn (setq x '#1=(a . #1#)) (eq x (cdr x)))")))
    (is (eq knowledge supergrip:*knowledge*))))

(test a-quote-that-was-forgotten-is-missed
  (loop for (text form) in
        '(("(setq box '(...))" "(setq box ((SIZE 12 2 2) (WEIGHT 0.2)))")
          ("(setq lateral '(...))" "(setq lateral (USED-SURFACES (N1 N2)))")
          ("(setq gripper '(...))" "(setq gripper (FINGER-LENGTH 3))"))
        do (is (equal (format nil "the quote is missing: write ~a" text)
                      (error-text (eval-in-user form))))))

(defun dimension (name)
  (cdr (assoc name (supergrip:knowledge-gripper supergrip:*knowledge*) :test #'string=)))

(test setq-of-a-dimension-edits-the-gripper
  (with-knowledge-restored
    (eval-in-user "(setq finger-length 4)")
    (is (= 4 (dimension "FINGER-LENGTH")))
    (eval-in-user "(setq finger-length (- 5 1) Finger-Dist 9.262)")
    (is (= 9.262d0 (dimension "FINGER-DIST")))
    (is (equal (file-text "t/pencil-session.txt") (transcript (pencil-plan)))
        "another hand that prints the same session")
    (is (equal "GRIPPER: DIST-PINCH is 20, but fingers of two links of 4 cm that start 9.262 cm apart open to 17.26 at most
The knowledge in force stays as it was."
               (error-text (eval-in-user "(setq dist-pinch 20)"))))
    (eval-in-user "(setq dist-pinch 20 finger-length 6)")
    (is (= 20 (dimension "DIST-PINCH")) "what stands in one SETQ takes effect together")
    (supergrip:edit '(setq reach-u 5))
    (is (= 5 (dimension "REACH-U")))
    (is (= 2 (eval-in-user "(let ((finger-length 1)) (setq finger-length 2) finger-length)")))
    (is (= 6 (dimension "FINGER-LENGTH")))))

(test setq-of-what-is-not-valid-sets-nothing
  (let ((before supergrip:*knowledge*))
    (loop for (typed report)
            in '(("(setq finger-length '(3))" "GRIPPER, FINGER-LENGTH: a number is wanted, not (3)")
                 ("(setq finger-length -3)"
                  "GRIPPER: FINGER-LENGTH is -3; a dimension is a number from 0")
                 ("(setq finger-lenght 3)" "FINGER-LENGHT is not a dimension of the gripper (did you mean FINGER-LENGTH?); (cl:setq finger-lenght 3) sets a variable")
                 ("(setq finger-lenght (/ 6 2))" "FINGER-LENGHT is not a dimension")
                 ("(setq x 1 finger-lenght 3)" "FINGER-LENGHT is not a dimension")
                 ("(setq pinch-2-parallel 5)"
                  "GRASP PINCH-2-PARALLEL: a list '(USED-SURFACES (N1 N2 A2) ...) is wanted, not 5")
                 ("(setq pinch-2-parallel '(a b))"
                  "PINCH-2-PARALLEL is not a grasp: its list has none of the keys")
                 ("(setq pinch-2-parallel nil)" "GRASP PINCH-2-PARALLEL: a list '(USED-SURFACES (N1 N2 A2) ...) is wanted, not ()")
                 ("(setq gripper 5)" "GRIPPER: a list '(FINGER-LENGTH 3.2 ...) is wanted, not 5")
                 ("(setq gripper '(a . b))" "GRIPPER: dotted pairs are not read: (A . B)")
                 ("(setq lateral '(((used-surfaces n1) (conditions t))))"
                  "LATERAL is not a grasp: its list has none of the keys")
                 ("(setq gripper '(finger-length))" "GRIPPER: FINGER-LENGTH has no number after it")
                 ("(setq griper '(finger-length 3 finger-dist 6))"
                  "GRIPER is not a grasp (did you mean GRIPPER?)")
                 ("(setq griper '((finger-length 3) (finger-dist 6)))"
                  "GRIPER is not a grasp (did you mean GRIPPER?)")
                 ("(setq lateral '(conditions (t) twist (1 1 1 1 1 1)))"
                  "GRASP LATERAL: USED-SURFACES is missing")
                 ("(setq lateral '((conditions t) (twist 1 1 1 1 1 1)))"
                  "GRASP LATERAL: USED-SURFACES is missing")
                 ("(setq lateral '((used-surfaces n1)))" "GRASP LATERAL: CONDITIONS is missing")
                 ("(setq lateral (list 'used-surfaces '(n1 n2) 'offset 0))"
                  "GRASP LATERAL: CONDITIONS is missing")
                 ("(setq lateral `(used-surfaces (,'n1 n2)))"
                  "GRASP LATERAL: CONDITIONS is missing")
                 ("(setq x 1 lateral '(used-surfaces (n1 n2)))"
                  "GRASP LATERAL: CONDITIONS is missing")
                 ("(setq lateral ((used-surfaces (n1 n2)) (offset 0)))"
                  "the quote is missing: write (setq lateral '(...))")
                 ("(setq lateral (conditions (t) offset 0))"
                  "the quote is missing: write (setq lateral '(...))"))
          do (let ((said (error-text (eval-in-user typed))))
               (is (eql 0 (search report said)) "~a~%gave ~a" typed said)))
    (is (eq before supergrip:*knowledge*))
    (loop for name in '("lateral" "griper" "gripper" "finger-lenght" "finger-length")
          do (is (not (boundp (find-symbol (string-upcase name) :supergrip-user))) name))))

(test setq-sets-what-looks-like-nothing-known
  (let ((before supergrip:*knowledge*))
    (loop for (typed value)
            in '(("(setq x '(offset wrench))" "(OFFSET WRENCH)")
                 ("(setq x '(finger-length finger-dist))" "(FINGER-LENGTH FINGER-DIST)")
                 ("(setq x '(palm tree))" "(PALM TREE)")
                 ("(setq x (list 1 2))" "(1 2)")
                 ("(setq finger-lenght 'a)" "A")
                 ("(setq x 1 y `(,x 2))" "(1 2)"))
          do (is (equal value (let ((value (eval-in-user typed))
                                    (*package* (find-package :supergrip-user)))
                                (prin1-to-string value)))))
    (is (eq before supergrip:*knowledge*))
    (mapc (lambda (name) (makunbound (find-symbol name :supergrip-user)))
          '("X" "Y" "FINGER-LENGHT"))))

(test setq-edits-in-any-package-that-imports-it
  (with-knowledge-restored
    (let ((package (make-package (gensym "USER") :use '(:cl :supergrip))))
      (unwind-protect
           (let ((*package* package))
             (shadowing-import 'supergrip-user:setq)
             (eval (read-from-string "(setq finger-length 4)"))
             (is (= 4 (dimension "FINGER-LENGTH")))
             (eval (read-from-string "(setq pinch-2-parallel
               '((used-surfaces (n1 n2 a2)) (conditions (dist '(n1 n2)) < 1)
                 (offset `(0 0 0 0 ,(- u) ,u)) (wrench 1 1 1 1 1 1) (twist 1 1 1 1 1 1)))"))
             (is (null (supergrip:possible-grasps
                        (supergrip:try-grasp "PINCH-2-PARALLEL" (paper-box))))))
        (delete-package package)))))

(test knowledge-is-read-again
  (with-knowledge-restored
    (uiop:with-temporary-file (:stream out :pathname rules :keep nil)
      (write-string *good-rules* out)
      :close-stream
      (uiop:with-temporary-file (:stream out :pathname grasps :keep nil)
        (write-string *good-grasps* out)
        :close-stream
        (supergrip:reload-knowledge :rules rules :grasps grasps)
        (is (= 4 (length (supergrip:knowledge-rules supergrip:*knowledge*))))
        (with-open-file (out rules :direction :output :if-exists :supersede)
          (write-string "(RULE" out))
        (signals supergrip:knowledge-error (supergrip:reload-knowledge))
        (is (= 4 (length (supergrip:knowledge-rules supergrip:*knowledge*))))))))

(test comparing-knowledge-tells-what-an-edit-changed
  (with-knowledge-restored
    (let ((old supergrip:*knowledge*)
          (boxes (list (paper-box) (cons '(name "soap") (changed-box :u 0.05)))))
      (supergrip:edit '(rule grip9 (if (parallel (s1 s2)) (large (s1 s2)))
                        (then (try pinch-3-parallel (s1 s2 ? ? ? ?)))))
      (is (equal '("12 x 2 x 2 cm: PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1) Q=0.770, was PINCH-3-PARALLEL (Y2 Y1 X2 X1 Z2 Z1) Q=0.860"
                   "1 of 2 boxes differs: 0 in verdict, 1 in grasp, 0 in quality.")
                 (printed (supergrip:compare-knowledge old supergrip:*knowledge* boxes)))))))

(test comparing-takes-knowledge-and-boxes
  (let ((knowledge supergrip:*knowledge*))
    (is (equal "3 is not knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in force"
               (error-text (supergrip:compare-knowledge knowledge 3 (list (paper-box))))))
    (is (equal "(A . B) is not a list of boxes"
               (error-text (supergrip:compare-knowledge knowledge knowledge '(a . b)))))
    (is (search "is not a list of boxes"
                (error-text (let ((boxes (list (paper-box))))
                              (setf (cdr boxes) boxes)
                              (supergrip:compare-knowledge knowledge knowledge boxes)))))))
