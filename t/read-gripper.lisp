;;;; read-gripper.lisp -- the gripper: what it must name, its own file, the folder of a hand, edits.

(in-package :supergrip-test)
(define-suite read-gripper
  "The gripper: what it must name, its own file, the folder of a hand, edits.")

(defparameter *jaw-rules*
  "(RULE FIND (IF (OPPOSED (s1 s2)) (NOT CONSTRAINED (s1)) (NOT CONSTRAINED (s2)) (NOT LARGE (s1 s2)))
  (THEN (TRY CLAMP (s1 s2 ? ? ? ?)) (KEEP BEST)))")

(defun clamp-text (wrench)
  "Return the text of the grasp CLAMP, whose torque about N is WRENCH."
  (format nil "(DEFUN TWICE (x) (* 2 x FINGER-SPREAD))
(SETQ CLAMP
 '(USED-SURFACES (N1 N2 A2)
   CONDITIONS ((DIST '(N1 N2)) < DIST-PINCH)
   OFFSET (LIST 0 0 0 0 0 0)
   WRENCH (1 (* 2 u) (* 2 u) ~a 1 1)
   TWIST (1 1 1 1 1 1) CONTACTS ((N1 0 0) (N2 0 0)) PALM A2))" wrench))

(defun gripper-knowledge (gripper &key (rules *jaw-rules*) (grasps (clamp-text "1")))
  "Return the knowledge of the text GRIPPER, as a file of its own, and the reports of all problems."
  (multiple-value-bind (knowledge problems)
      (supergrip::build-knowledge (text-file rules "rules.lisp") (text-file grasps "grasps.lisp")
                                  (text-file gripper "jaw.lisp"))
    (values knowledge (mapcar #'princ-to-string problems))))

(defun gripper-reports (gripper &rest keys)
  (nth-value 1 (apply #'gripper-knowledge gripper keys)))

(defparameter *jaw* "(SETQ GRIPPER
  '(MODEL \"Jaw 1\" DIST-PINCH 8.5 PAD 2))")

(test a-gripper-names-what-is-used-and-no-more
  (multiple-value-bind (knowledge reports) (gripper-knowledge *jaw*)
    (is (null reports))
    (is (equal "Jaw 1" (supergrip:knowledge-model knowledge)))
    (is (equal '(("DIST-PINCH" . 8.5d0) ("PAD" . 2d0)) (supergrip:knowledge-gripper knowledge)))
    (is (equal "CLAMP" (supergrip:plan-grasp (supergrip:plan (paper-box) :knowledge knowledge))))
    (is (null (supergrip:plan-grasp
               (supergrip:plan (changed-box :size 12 9 9) :knowledge knowledge)))))
  (is (null (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 8.5))"))
      "a helper that no grasp calls uses FINGER-SPREAD"))

(test what-may-be-misspelt-or-in-mm-is-warned-of
  (is (equal '("jaw.lisp:1: warning: GRIPPER: nothing uses PALM-DEPHT (did you mean PALM-DEPTH?)")
             (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 8.5 PALM-DEPHT 8))")))
  (is (null (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 8.5 PALM-DEPHT 8 PALM-DEPTH 8))"))
      "what is there can't be meant")
  (is (null (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 8.5 FINGR-WIDTH 1))"
                             :grasps (clamp-text "FINGR-WIDTH")))
      "a grasp uses it")
  (is (equal '("jaw.lisp:1: warning: GRIPPER: DIST-PINCH is 85 cm: dimensions count in cm, not in mm")
             (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 85))"))))

(test a-dimension-that-is-missing-is-named-with-its-users
  (flet ((missing (name users line)
           (format nil "jaw.lisp:1: GRIPPER: ~a is missing: ~a; add it with your hand's number, ~
                         as  ~a"
                   name users line)))
    (is (equal (list (missing "DIST-PINCH" "GRASP CLAMP, grasps.lisp:4, uses it, and 1 other does"
                              "DIST-PINCH 12 ; cm, the opening of the hand"))
               (gripper-reports "(SETQ GRIPPER '(PAD 2))")))
    (is (equal (list (missing "FINGER-SPREAD" "RULE A, rules.lisp:1, uses it for NARROW"
                              "FINGER-SPREAD 1.738 ; cm, between the two fingers that work side by side"))
               (gripper-reports *jaw* :rules (format nil "(RULE A (IF (NOT NARROW (s1 s2)))
 (THEN (CANT X)))~%~a" *jaw-rules*))))
    (is (equal (list (missing "FINGER-SPREAD" "GRASP CLAMP, grasps.lisp:1, uses it"
                              "FINGER-SPREAD 1.738 ; cm, between the two fingers that work side by side"))
               (gripper-reports *jaw* :grasps (clamp-text "(TWICE v)")))
        "by a helper")
    (is (equal (list (missing "PAD" "GRASP CLAMP, grasps.lisp:7, uses it" "PAD 3.5"))
               (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 8))"
                                :grasps (format nil "(SETQ GRIPPER '(DIST-PINCH 9 PAD 3.5)) ~%~a"
                                                (clamp-text "(* PAD v)"))))
        "what the gripper that is replaced has is known, too"))
  (is (search "unknown name PAD; known are U, V, the gripper's dimensions (jaw.lisp:1), a helper's"
              (first (gripper-reports "(SETQ GRIPPER '(DIST-PINCH 8))"
                                       :grasps (clamp-text "(* PAD v)"))))))

(test a-gripper-of-its-own-file-is-the-gripper
  (let ((grasps (format nil "(SETQ GRIPPER '(DIST-PINCH BAD))~%~a" (clamp-text "1"))))
    (is (null (gripper-reports *jaw* :grasps grasps)) "the other is not looked at"))
  (loop for (gripper report) in
        `(("" "jaw.lisp: GRIPPER: there is no (SETQ GRIPPER '(...))")
          (,(format nil "~a (SETQ GRIPPER '(DIST-PINCH 1))" *jaw*)
           "jaw.lisp:2: GRIPPER: the gripper is given twice")
          (,(format nil "~a (DEFUN F (x) x)" *jaw*)
           "jaw.lisp:2: a gripper file holds (SETQ GRIPPER '(...)) alone, not (DEFUN F (X) X); rules and grasps have files of their own")
          ("(SETQ GRIPPER '(MODEL JAW DIST-PINCH 8))"
           "jaw.lisp:1: GRIPPER: MODEL is the name of the hand, a string of at most 100 characters such as \"2F-85\", not JAW")
          ("(SETQ GRIPPER '(MODEL \"\" DIST-PINCH 8))"
           "jaw.lisp:1: GRIPPER: MODEL is the name of the hand, a string of at most 100 characters such as \"2F-85\", not \"\"")
          ("(SETQ GRIPPER '(DIST-PINCH \"8\"))"
           "jaw.lisp:1: GRIPPER: DIST-PINCH has no number after it")
          ("(SETQ GRIPPER '(DIST-PINCH 8 FINGER-FORCE 0))"
           "jaw.lisp:1: GRIPPER: FINGER-FORCE is 0; a finger that exerts no force holds nothing")
          ("(SETQ GRIPPER" "jaw.lisp:1:1: this parenthesis is never closed"))
        do (is (equal report (first (gripper-reports gripper :grasps (clamp-text "v")))) gripper)))

(test what-uses-a-missing-dimension-is-left-out
  (let ((knowledge (gripper-knowledge "(SETQ GRIPPER '(FINGER-WIDTH 1))"
                                      :rules (format nil "(RULE A (IF (SMALL (s1 s2))) (THEN (CANT ~
                                                          X)))~%~a"
                                                     *jaw-rules*))))
    (is (equal '("A") (mapcar #'supergrip-chainer:rule-name (supergrip:knowledge-rules knowledge))))
    (is (null (supergrip:knowledge-grasps knowledge)))
    (is (eq :cant (supergrip:plan-verdict (supergrip:plan (paper-box) :knowledge knowledge))))))

(test a-threshold-that-the-gripper-lacks-is-never-reached
  (let ((knowledge (gripper-knowledge *jaw*)))
    (is (equal '("NARROW (S1 S2) is a preliminary assertion; its threshold is FINGER-SPREAD, which the gripper lacks, so it never holds."
                 "It is tested by no rule.")
               (printed (supergrip:describe-input 'narrow :knowledge knowledge))))
    (is (notany (lambda (assertion) (member "SLIPPERY" assertion :test #'equal))
                (supergrip:plan-assertions
                 (supergrip:plan (changed-box :u 0) :knowledge knowledge))))))

(test a-gripper-is-described
  (is (equal '("Jaw 1 is from jaw.lisp." "DIST-PINCH 8.5 cm, the opening of the hand."
               "  Used by CLAMP, FIND." "PAD 2." "  Used by no rule and no grasp."
               "FINGER-FORCE 60 N, the greatest normal force of a finger."
               "  Used by boxes with forces in N or LBF, or with a mass.")
             (printed (supergrip:describe-gripper
                       :knowledge (gripper-knowledge "(SETQ GRIPPER '(MODEL \"Jaw 1\" DIST-PINCH 8.5
                                                       PAD 2 FINGER-FORCE 60))"))))))

(test a-gripper-may-have-no-dimension
  (let* ((knowledge (gripper-knowledge "(SETQ GRIPPER '(MODEL \"none\"))"
                                       :rules "(RULE A (IF (OPPOSED (s1 s2))) (THEN (TRY CLAMP) (KEEP BEST)))"
                                       :grasps (changed (clamp-text "1")
                                                        "((DIST '(N1 N2)) < DIST-PINCH)" "(T)")))
         (plan (supergrip:plan (paper-box) :knowledge knowledge)))
    (is (equal "CLAMP" (supergrip:plan-grasp plan)))
    (finishes (printed (supergrip:explain-best plan)))
    (finishes (supergrip:verify-knowledge knowledge :stream nil))))

;;; Files and folders

(defmacro with-hand-folder ((name &rest files) &body body)
  "Run BODY with NAME bound to a new folder, a string with / at its end, that holds FILES, each a
list of a name and a text."
  `(let* ((directory (uiop:ensure-directory-pathname
                      (format nil "~asupergrip-~36r"
                              (uiop:native-namestring (uiop:temporary-directory))
                              (random (expt 36 8) (make-random-state t)))))
          (,name (uiop:native-namestring directory)))
     (ensure-directories-exist directory)
     (unwind-protect
          (progn
            (loop for (file text) in (list ,@(loop for file in files collect `(list ,@file)))
                  do (write-text-file (concatenate 'string ,name file) text))
            ,@body)
       (uiop:delete-directory-tree directory :validate t))))

(defun write-text-file (file text)
  (with-open-file (out file :direction :output :if-exists :supersede)
    (write-string text out)))

(test a-gripper-file-replaces-the-gripper-alone
  (with-text-file (gripper (format nil "(SETQ GRIPPER '~a)"
                                   (supergrip-data:form-text
                                    (substitute 6d0 12 (supergrip:gripper)))))
    (let ((knowledge (supergrip:load-knowledge :gripper gripper)))
      (is (equal 6d0 (cdr (assoc "DIST-PINCH" (supergrip:knowledge-gripper knowledge)
                                 :test #'string=))))
      (is (= (rule-total) (length (supergrip:knowledge-rules knowledge))))
      (is (= (grasp-total) (length (supergrip:knowledge-grasps knowledge)))))))

(test a-folder-holds-a-hand
  (with-hand-folder (hand ("gripper.lisp" *jaw*) ("grasps.lisp" (clamp-text "1"))
                     ("rules.lisp" *jaw-rules*))
    (flet ((names (&rest arguments)
             (let ((knowledge (apply #'supergrip:load-knowledge arguments)))
               (list (supergrip:knowledge-model knowledge)
                     (length (supergrip:knowledge-rules knowledge))))))
      (is (equal '("Jaw 1" 1) (names :hand hand)))
      (is (equal '("Jaw 1" 1) (names :hand (string-right-trim "/" hand))))
      (is (equal '("Jaw 1" 1) (names :hand (pathname hand))))
      (with-text-file (other "(SETQ GRIPPER '(MODEL \"Jaw 2\" DIST-PINCH 8))")
        (is (equal '("Jaw 2" 1) (names :hand hand :gripper other)) "a file that is named wins")))
    (delete-file (concatenate 'string hand "gripper.lisp"))
    (is (equal (list (format nil "~agrasps.lisp: GRIPPER: there is no (SETQ GRIPPER '(...)) here, ~
                                  and no gripper file is given" hand))
               (problem-texts (lambda () (supergrip:load-knowledge :hand hand)))))))

(test a-folder-may-lack-rules-and-grasps
  (with-hand-folder (hand ("gripper.lisp" (format nil "(SETQ GRIPPER '~a)"
                                             (supergrip-data:form-text (supergrip:gripper)))))
    (let ((knowledge (supergrip:load-knowledge :hand hand)))
      (is (= (rule-total) (length (supergrip:knowledge-rules knowledge))))
      (is (= (grasp-total) (length (supergrip:knowledge-grasps knowledge)))))))

(test the-grippers-own-file-is-read-again
  (with-knowledge-restored
    (with-hand-folder (hand ("gripper.lisp" *jaw*) ("grasps.lisp" (clamp-text "1"))
                       ("rules.lisp" *jaw-rules*))
      (let ((gripper (concatenate 'string hand "gripper.lisp")))
        (flet ((opening ()
                 (cdr (assoc "DIST-PINCH" (supergrip:knowledge-gripper supergrip:*knowledge*)
                             :test #'string=))))
          (supergrip:reload-knowledge :hand hand)
          (is (= 8.5d0 (opening)))
          (write-text-file gripper "(SETQ GRIPPER '(DIST-PINCH 7))")
          (supergrip:reload-knowledge)
          (is (= 7 (opening)))
          (write-text-file gripper "(SETQ GRIPPER '(PAD 7))")
          (is (eql 0 (search (format nil "~a:1: GRIPPER: DIST-PINCH is missing: GRASP CLAMP, ~
                                          ~agrasps.lisp:4," gripper hand)
                             (first (problem-texts #'supergrip:reload-knowledge)))))
          (is (= 7 (opening)) "the former stays")
          (supergrip:reload-knowledge :hand nil)
          (is (= 12 (opening)) "the shipped one is back")
          (is (= (grasp-total) (length (supergrip:knowledge-grasps supergrip:*knowledge*)))))))))

(test what-is-typed-changes-the-grippers-own-file
  (with-knowledge-restored
    (setf supergrip:*knowledge* (gripper-knowledge *jaw*))
    (flet ((typed-gripper () (eval-in-user "(progn gripper)"))
           (user (text) (eval-in-user (format nil "'~a" text))))
      (eval-in-user "(setq dist-pinch 9)")
      (is (equal (user "(model \"Jaw 1\" dist-pinch 9 pad 2)") (typed-gripper)))
      (eval-in-user "(setq finger-force 60 clamp '(used-surfaces (n1 n2 a2) conditions (t)
                       offset (list 0 0 0 0 0 0) wrench (1 u u v 1 1) twist (1 1 1 1 1 1)))")
      (is (equal (user "(model \"Jaw 1\" dist-pinch 9 pad 2 finger-force 60)") (typed-gripper))
          "a dimension that it lacked is added")
      (is (equal 1 (length (supergrip:knowledge-grasps supergrip:*knowledge*))))
      (eval-in-user "(setq gripper '(model \"Jaw 2\" dist-pinch 7))")
      (is (equal "Jaw 2" (supergrip:knowledge-model supergrip:*knowledge*)))
      (is (eql 0 (search "GRIPPER: DIST-PINCH is missing: RULE FIND, rules.lisp:1, uses it for LARGE"
                         (error-text (eval-in-user "(setq gripper '(finger-width 7))"))))))))

;;; The command line

(test the-command-line-takes-hands
  (with-hand-folder (hand ("gripper.lisp" *jaw*) ("grasps.lisp" (clamp-text "1"))
                     ("rules.lisp" *jaw-rules*) ("other.lisp" "(SETQ GRIPPER '(DIST-PINCH 1))"))
    (flet ((file (name) (concatenate 'string hand name)))
      (is (equal "CLAMP" (getf (first (answers *pencil* "--hand" hand)) :grasp)))
      (is (equal "cant" (getf (first (answers *pencil* "--hand" hand "--gripper"
                                              (file "other.lisp")))
                              :status)))
      (loop for (status report . options) in
            `((0 ,(format nil "1 rule and 1 grasp, the gripper of ~agripper.lisp (Jaw 1), no ~
                               mistakes~%"
                          hand)
                 "--hand" ,hand)
              (65 "FINGER-LENGTH is missing: GRASP PINCH-2-PARALLEL, grasps.lisp:"
                  "--gripper" ,(file "gripper.lisp"))
              (66 "none.lisp: can't be opened" "--gripper" ,(file "none.lisp"))
              (66 "gripper.lisp: can't be opened: Not a directory" "--hand" ,(file "other.lisp"))
              (66 "no-such-hand/gripper.lisp: can't be opened" "--hand" ,(file "no-such-hand")))
            do (multiple-value-bind (given output errors)
                   (run-on "" (list* (program) "--check" options))
                 (is (equal "" output))
                 (is (eql status given) "~a: ~a" options given)
                 (is (search report errors) "~a: ~a" options errors))))))
