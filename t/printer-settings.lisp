;;;; printer-settings.lisp -- texts whatever the printer is set to, names in any form, bounded
;;;; answers.

(in-package :supergrip-test)
(define-suite printer-settings "Texts whatever the printer is set to, names in any form, bounded answers.")

(defmacro with-odd-printer (&body body)
  "Run BODY with the printer as no text of ours may show it."
  `(let ((*print-base* 2) (*print-radix* t) (*print-case* :downcase) (*print-circle* t)
         (*print-pretty* t) (*print-length* 1) (*print-level* 1) (*print-lines* 1)
         (*print-right-margin* 10) (*read-default-float-format* 'long-float)
         (*readtable* (copy-readtable nil)))
     (setf (readtable-case *readtable*) :invert)
     ,@body))

(defun all-texts ()
  "Return what the functions that print and the conditions say of the pencil."
  (let* ((plan (pencil-plan))
         (texts '()))
    (flet ((note (text) (push text texts)))
      (macrolet ((say (&rest forms)
                   `(progn ,@(loop for form in forms collect `(note (printed ,form)))))
                 (complain (&rest forms)
                   `(progn ,@(loop for form in forms collect `(note (error-text ,form))))))
        (say (supergrip:forward-chain :box (paper-box) :trace 4)
             (supergrip:forward-chain :box (plan-box-too-heavy) :trace 4)
             (supergrip:how '(corner (z1 y1 x2)) plan) (supergrip:how '(wide (y2 y1)) plan)
             (supergrip:why-not 'grip10 nil plan) (supergrip:why-not 'pinch-2-parallel nil plan)
             (supergrip:explain-best plan) (supergrip:rule-counts plan)
             (supergrip:describe-rule 'surfaces4) (supergrip:describe-grasp 'pinch-2-adjacent)
             (supergrip:compare-knowledge supergrip:*knowledge* supergrip:*knowledge*
                                          (list (paper-box) (paper-box))))
        (complain (supergrip:parse-box '((size 12 2) (weight -10) (u 0.8) (constrained z2 q)))
                  (supergrip:parse-box '((size 12 2 2) (wieght 1/10)))
                  (supergrip:plan (paper-box) :gamma 10)
                  (supergrip:how '(paralel (y2 y1)) plan) (supergrip:why-not 'grip12 nil plan)
                  (supergrip:try-grasp 12 (paper-box)) (supergrip:plan-reason 12)))
      (note (problem-texts (lambda ()
                             (supergrip:edit '(rule grip20 (if (paralel (s1 s2)) (small (s1)))
                                               (then (try nothing) (keep 10)))))))
      (note (mapcar #'princ-to-string (supergrip:plan-possible plan)))
      (note (princ-to-string (supergrip:plan-best plan)))
      (note (princ-to-string (plan-of '(8 5 3) 0.05d0 '(z2)))))
    texts))

(test texts-do-not-show-how-the-printer-is-set
  ;; The name of a type in #<...> is the user's.
  (flet ((of-type-apart (texts)
           (mapcar (lambda (text) (if (stringp text) (string-upcase text)
                                      (mapcar #'string-upcase text)))
                   texts)))
    (loop for plain in (of-type-apart (all-texts))
          for odd in (of-type-apart (with-odd-printer (all-texts)))
          do (is (equal plain odd)))
    (is (equal (nthcdr 3 (all-texts)) (nthcdr 3 (with-odd-printer (all-texts)))))))

(test names-may-be-strings-or-symbols-of-any-package
  (let ((plan (pencil-plan)))
    (flet ((best-p (name &optional matching)
             (eq :chosen (supergrip:not-chosen-kind
                          (supergrip:explain-why-not name matching plan)))))
      (is (best-p (supergrip:plan-grasp plan) (supergrip:plan-matching plan)))
      (is (best-p "pinch-3-parallel" "y2 y1 x2 x1 z2 z1"))
      (is (best-p :pinch-3-parallel "(Y2 Y1 X2 X1 Z2 Z1)"))
      (is (best-p '|pinch-3-parallel| '(:y2 #:y1 "x2" x1 |z2| z1)))
      (is (best-p (supergrip::find-grasp (supergrip::knowledge-graspbase supergrip:*knowledge*)
                                         "PINCH-3-PARALLEL"))))
    (is (equal (printed (supergrip:how '(parallel (y2 y1)) plan))
               (printed (supergrip:how "(parallel (y2 y1))" plan))))
    (is (equal (printed (supergrip:how '(parallel (y2 y1)) plan))
               (rest (printed (supergrip:why-not '("PARALLEL" ("Y2" "y1")) plan)))))
    (is (equal (printed (supergrip:how '(object has free corners) plan))
               (printed (supergrip:how "object has free corners" plan))))
    (is (equal (printed (supergrip:describe-rule 'grip9))
               (printed (supergrip:describe-rule "grip9"))))
    (unwind-protect (is (equal '("GRIP9" "PINCH-3-CORNER")
                               (sort (progn (supergrip:trace-rule "grip9")
                                            (supergrip:trace-grasp :pinch-3-corner))
                                     #'string<)))
      (is (null (supergrip:untrace-rule '|grip9| "pinch-3-corner"))))
    (with-knowledge-restored
      (supergrip:edit '(rule grip0 (if (small (s1 s2))) (then (cant hold))) :before "grip2")
      (is (equal "GRIP0" (supergrip-chainer:rule-name
                          (second (supergrip:knowledge-rules supergrip:*knowledge*))))))))

(test what-is-no-name-no-fact-and-no-plan-is-told
  (let ((plan (pencil-plan)) (circle (list 'x1)))
    (setf (cdr circle) circle)
    (loop for (text report)
            in `(("3 is not a name: rules and grasps are named by symbols or strings"
                  ,(error-text (supergrip:why-not 3 nil plan)))
                 ("GRIP9 is a rule: only a grasp has a matching"
                  ,(error-text (supergrip:why-not 'grip9 '(x1 x2 y1 y2 z1 z2) plan)))
                 ("(A . B) is not a fact that could be known: dotted pairs are not read: (A . B); a fact is a list, such as (PARALLEL (Y2 Y1))"
                  ,(error-text (supergrip:why-not '(a . b) nil plan)))
                 ("(OPPOSED (Y2 Y1) (X2 X1)) is not a fact that could be known: ask about one list of surfaces at a time"
                  ,(error-text (supergrip:explain-fact '(opposed (y2 y1) (x2 x1)) plan)))
                 ("there is no grasp 3; grasps are PINCH-2-PARALLEL, PINCH-3-PARALLEL, PINCH-3-U-SHAPE, PINCH-3-C-SHAPE, PINCH-2-ADJACENT, PINCH-3-ADJACENT, PINCH-3-CORNER"
                  ,(error-text (supergrip:try-grasp 3 (paper-box))))
                 ("3 is not a plan: FORWARD-CHAIN, PLAN and TRY-GRASP return plans"
                  ,(error-text (supergrip:explain-best 3))))
          do (is (equal text report)))
    (is (search "a circular one" (error-text (supergrip:how circle plan))))
    (dolist (matching (list circle '(x1 x2 . y1) 7 "x1 (" '(1 2 3 4 5 6)))
      (is (eq :no-matching (supergrip:not-chosen-kind
                            (supergrip:explain-why-not 'pinch-3-parallel matching plan)))))))

(test the-current-box-and-plan-are-what-is-meant
  (let ((supergrip::*box* (supergrip:parse-box (paper-box))) (supergrip:*plan* (pencil-plan)))
    (is (equal "PINCH-3-CORNER"
               (caar (supergrip::plan-tries (supergrip:try-grasp "PINCH-3-CORNER")))))
    (is (= 0.25d0 (supergrip:plan-gamma (supergrip:try-grasp 'pinch-3-corner :gamma 1/4))))
    (is (= 6 (length (supergrip:plan-candidates)) (length (supergrip:plan-possible))))
    (is (equal "PINCH-3-PARALLEL" (supergrip:plan-grasp)))
    (is (= 3 (length (supergrip:candidate-contacts (supergrip:plan-best supergrip:*plan*))))))
  (let ((supergrip::*box* nil) (supergrip:*plan* nil))
    (signals supergrip:no-box-error (supergrip:try-grasp "PINCH-3-CORNER"))
    (signals supergrip:no-plan-error (supergrip:plan-candidates)))
  (dolist (one (list (paper-box) `(setq box ',(paper-box)) (supergrip:parse-box (paper-box))))
    (is (equal '("0 of 1 box differs: 0 in verdict, 0 in grasp, 0 in quality.")
               (printed (supergrip:compare-knowledge supergrip:*knowledge* supergrip:*knowledge*
                                                     one))))))

(test descriptions-are-in-full-and-count-any-fingers
  (let ((lines (printed (supergrip:describe-grasp 'pinch-3-corner))))
    (is (notany (lambda (line) (search "..." line)) lines))
    (is (every (lambda (line) (< (length line) 100))
               (subseq lines 0 (position-if (lambda (line) (search "PALM A1" line)) lines)))))
  (with-knowledge-restored
    (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
      (supergrip:edit '(setq rake '(used-surfaces (n1 n2 a2) conditions (u > 0)
                                    offset (0 0 0 0 0 0) wrench (1 1 1 1 1 1) twist (1 1 1 1 1 1)
                                    contacts ((n1 0 0) (n1 0 0) (n1 0 0) (n1 0 0) (n2 0 0))
                                    palm a2)))
      (is (find "In words: four fingers on N1, a finger on N2; the palm over A2; N1 N2 A2 must be free."
                (printed (supergrip:describe-grasp 'rake)) :test #'string=))
      (is (search "RAKE: four fingers on Y2, a finger on Y1"
                  (first (printed (supergrip:explain-best
                                   (supergrip:try-grasp 'rake (paper-box))))))))))

(defun chain-plan (count)
  "Return a plan by a chain of COUNT rules, each of which needs what the last one said."
  (let ((rules (format nil "(RULE A0 (IF (OPPOSED (S1 S2))) (THEN (REMEMBER P0 (S1 ~
                            S2))))~%~:{(RULE A~d (IF (P~d (S1 S2))) (THEN (REMEMBER P~d (S1 ~
                            S2))))~%~}"
                       (loop for i from 1 to count collect (list i (1- i) i)))))
    (supergrip:plan (paper-box) :knowledge (text-knowledge rules (file-text "grasps.lisp")))))

(test how-a-long-chain-led-to-a-fact-is-told-in-part
  (let* ((plan (chain-plan 30000))
         (lines (printed (supergrip:how '(p30000 (y2 y1)) plan))))
    (is (= 52 (length lines)))
    (is (equal "(P29950 (Y2 Y1)): ask (how '(P29950 (Y2 Y1)))"
               (string-left-trim " " (nth 50 lines))))
    (is (equal "29951 more derived facts in this tree are left out." (nth 51 lines)))
    (is (> 1000 (length (error-text (supergrip:why-not 'a30001 nil plan)))))))
