;;;; spoiled.lisp -- a table of spoiled rule and grasp files, and all that is said of each.

(in-package :supergrip-test)
(define-suite spoiled "A table of spoiled rule and grasp files, and all that is said of each.")

(defparameter *spoiled*
  '((:RULES "(RULE END" "hello (RULE END"
     "rules.lisp:14: HELLO is not a rule: a rule file holds (RULE name (IF clause...) (THEN action...)) and (INPUT sentence)")
    (:RULES "(RULE END" "
12 (RULE END"
     "rules.lisp:15: 12 is not a rule: a rule file holds (RULE name (IF clause...) (THEN action...)) and (INPUT sentence)")
    (:GRASPS "(DEFUN HALF" "() (DEFUN HALF"
     "grasps.lisp:4: a grasp file holds (SETQ GRIPPER '(...)), (DEFUN name (parameter...) form) and (SETQ grasp '(...)), not ()")
    (:RULES "(RULE END" "(RULES END"
     "rules.lisp:14: (RULES END (IF (OBJECT HAS PARALLEL SURFACES)) (THEN (KEEP BEST))) is not a rule: a rule file holds (RULE name (IF clause...) (THEN action...)) and (INPUT sentence)")
    (:RULES "(THEN (KEEP BEST)))" "(THEN (KEEP BEST))"
     "rules.lisp:14:1: this parenthesis is never closed")
    (:RULES "(THEN (KEEP BEST)))" "(THEN (KEEP BEST))))"
     "rules.lisp:16:22: a closing parenthesis too many")
    (:RULES "(RULE END" "#.(RULE END"
     "rules.lisp:14:1: # is not allowed in a name or a number")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (PARALLEL (s1 2)))"
     "rules.lisp:12: RULE ACROSS, clause 1: 2 is not a surface")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (PARALLEL (s1 s2) NEARLY))"
     "rules.lisp:12: RULE ACROSS, clause 1: (PARALLEL (S1 S2) NEARLY): a sentence is made of words, and may end in one list of surfaces"
     "rules.lisp:12: warning: RULE ACROSS, clause 1: nothing provides PARALLEL NEARLY, so the rule can never fire; if a box is to say it, add (INPUT PARALLEL NEARLY (S1 S2))")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (NOT NOT PARALLEL (s1 s2)))"
     "rules.lisp:12: RULE ACROSS, clause 1: (NOT NOT PARALLEL (S1 S2)) is negated twice")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (NOT))"
     "rules.lisp:12: RULE ACROSS, clause 1: an empty sentence")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (CORNER (s1 s2 s3 s4 s5 s6)) (SMALL (s7 s8)))"
     "rules.lisp:12: RULE ACROSS, clause 2: more than six variables: a box has six surfaces"
     "rules.lisp:12: warning: RULE ACROSS, clause 1: nothing provides CORNER, so the rule can never fire; if a box is to say it, add (INPUT CORNER (S1 S2 S3 S4 S5 S6))")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRIES G (s1 s2 ? ? ? ?))"
     "rules.lisp:13: RULE ACROSS, action 1: TRIES is not an action; actions are REMEMBER, CANT, TRY, KEEP")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRY H (s1 s2 ? ? ? ?))"
     "rules.lisp:13: RULE ACROSS, action 1: TRY names H, which is not in the database")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRY)"
     "rules.lisp:13: RULE ACROSS, action 1: TRY names a grasp, such as (TRY PINCH-3-PARALLEL)")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRY G (s1 s2))"
     "rules.lisp:13: RULE ACROSS, action 1: a suggested matching is one list of six, for N1 N2 O1 O2 A1 A2, with ? for any: (? s3 s1 s2 ? s4)")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRY G (s1 s3 ? ? ? ?))"
     "rules.lisp:13: RULE ACROSS, action 1: the variable S3 occurs in no clause of IF")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRY G (s1 s1 ? ? ? ?))"
     "rules.lisp:13: RULE ACROSS, action 1: the same surface twice in (S1 S1): lists of surfaces hold distinct ones")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "TRY"
     "rules.lisp:11: RULE ACROSS, action 1: TRY is not an action: an action is a list that begins with REMEMBER, CANT, TRY, KEEP")
    (:RULES "(REMEMBER PARALLEL (s1 s2))" "(REMEMBER)"
     "rules.lisp:9: RULE FIND, action 1: an empty sentence"
     "rules.lisp:12: warning: RULE ACROSS, clause 1: nothing provides PARALLEL, so the rule can never fire; if a box is to say it, add (INPUT PARALLEL (S1 S2))")
    (:RULES "(KEEP BEST)" "(KEEP ALL)"
     "rules.lisp:16: RULE END, action 1: KEEP is (KEEP BEST)")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (PARALEL (s1 s2)))"
     "rules.lisp:12: warning: RULE ACROSS, clause 1: nothing provides PARALEL (did you mean PARALLEL?), so the rule can never fire")
    (:RULES "(IF (OBJECT HAS PARALLEL SURFACES))" "(IF (OBJECT HAS NO PARALEL SURFACES))"
     "rules.lisp:15: warning: RULE END, clause 1: nothing provides OBJECT HAS PARALEL SURFACES (did you mean OBJECT HAS PARALLEL SURFACES?), so this always holds")
    (:RULES "(CONSTRAINED (s1)))
  (THEN (CANT" "(PARALLEL (s1 s2)))
  (THEN (CANT"
     "rules.lisp:3: warning: RULE OBVIOUS, clause 2: PARALLEL is tested here, but RULE FIND, which derives it, comes later; rules run in order, each once")
    (:RULES "(CONSTRAINED (s1)))
  (THEN (CANT" "(NOT PARALLEL (s1 s2)))
  (THEN (CANT"
     "rules.lisp:3: warning: RULE OBVIOUS, clause 2: the absence of PARALLEL is tested here, but RULE FIND, which derives it, comes later; rules run in order, each once")
    (:RULES "(IF (PARALLEL (s1 s2)))" "(IF (PARALLEL (s1 s2)) (NOT PARALLEL (s2 s1)))"
     "rules.lisp:12: warning: RULE ACROSS, clause 2: this contradicts clause 1, so the rule can never fire")
    (:RULES "(REMEMBER PARALLEL (s1 s2))"
            "(REMEMBER PARALLEL (s1 s2)) (REMEMBER OBJECT HAS PARALLEL SURFACE)"
     "rules.lisp:9: warning: RULE FIND, action 2: no rule tests OBJECT HAS PARALLEL SURFACE (did you mean OBJECT HAS PARALLEL SURFACES?)")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(REMEMBER DONE)"
     "grasps.lisp:6: warning: GRASP G: no rule tries it")
    (:GRASPS "(SETQ GRIPPER" "(SETQ GRIPER"
     "grasps.lisp: GRIPPER: there is no (SETQ GRIPPER '(...)) here, and no gripper file is given"
     "grasps.lisp:1: GRIPER is not a grasp (did you mean GRIPPER?): its list has none of the keys USED-SURFACES, CONDITIONS, OFFSET, REACH, WRENCH, TWIST, CONTACTS, PALM")
    (:GRASPS "FINGER-LENGTH 3" "FINGER-LENGTH"
     "grasps.lisp:1: GRIPPER: FINGER-LENGTH has no number after it")
    (:GRASPS "DIST-PINCH 12" ""
     "grasps.lisp:1: GRIPPER: DIST-PINCH is missing: GRASP G, grasps.lisp:8, uses it; add it with your hand's number, as  DIST-PINCH 12 ; cm, the opening of the hand")
    (:GRASPS "FINGER-LENGTH 3" "FINGER-LENGTH -3"
     "grasps.lisp:1: GRIPPER: FINGER-LENGTH is -3; a dimension is a number from 0")
    (:GRASPS "FINGER-LENGTH 3" "FINGER-LENGTH 3 FINGER-LENGTH 4"
     "grasps.lisp:1: GRIPPER: FINGER-LENGTH is given twice")
    (:GRASPS "FINGER-LENGTH 3" "FINGER-LENGTH 3 U 0.5"
     "grasps.lisp:1: GRIPPER: U can't be a dimension: it means something else in a form")
    (:GRASPS "DIST-PINCH 12" "DIST-PINCH 12.5"
     "grasps.lisp:1: GRIPPER: DIST-PINCH is 12.5, but fingers of two links of 3 cm that start 6 cm apart open to 12 at most")
    (:GRASPS "FINGER-WIDTH 1" "FINGER-WIDTH 3"
     "grasps.lisp:1: GRIPPER: FINGER-WIDTH is 3, more than FINGER-SPREAD, 2")
    (:GRASPS "FINGER-SPREAD 2" "FINGER-SPREAD 13"
     "grasps.lisp:1: GRIPPER: FINGER-SPREAD is 13, more than DIST-PINCH, 12")
    (:RULES "(PARALLEL (s1 s2))" "(PARALLEL s1 s2)"
     "rules.lisp:12: RULE ACROSS, clause 1: surfaces go in a list of their own, at the end: (PARALLEL (S1 S2))")
    (:RULES "(TRY G (s1 s2 ? ? ? ?))" "(TRY G (X1 Y1 ? ? ? ?))"
     "rules.lisp:13: warning: RULE ACROSS, action 1: no matching has these faces in these places: N O A is a proper rotation of X Y Z")
    (:GRASPS "(DEFUN HALF (x)" "(SETQ GRIPPER '(FINGER-LENGTH 3)) (DEFUN HALF (x)"
     "grasps.lisp:4: GRIPPER: the gripper is given twice")
    (:GRASPS "(DEFUN HALF (x)" "(DEFUN HALF x"
     "grasps.lisp:4: DEFUN HALF: a helper is (DEFUN name (parameter...) form)")
    (:GRASPS "(DEFUN HALF (x)" "(DEFUN SQRT (x)"
     "grasps.lisp:4: DEFUN SQRT: SQRT is already an operator")
    (:GRASPS "(/ x 2)" "(/ y 2)"
     "grasps.lisp:5: DEFUN HALF: unknown name Y; known are U, V, the gripper's dimensions, a helper's parameters and what LET* binds")
    (:GRASPS "(/ x 2)" "(HALF x)"
     "grasps.lisp:5: DEFUN HALF: unknown operator HALF in (HALF X); operators are + - * / SQRT EXPT MIN MAX ABS POSIT DIST COND IF LET LET*")
    (:GRASPS "(DEFUN HALF (x)" "(DEFINE HALF (x)"
     "grasps.lisp:4: a grasp file holds (SETQ GRIPPER '(...)), (DEFUN name (parameter...) form) and (SETQ grasp '(...)), not (DEFINE HALF (X) (/ X 2))")
    (:GRASPS "(SETQ G
  '(" "(SETQ G
  ("
     "grasps.lisp:6: a grasp file holds (SETQ GRIPPER '(...)), (DEFUN name (parameter...) form) and (SETQ grasp '(...)), not (SETQ G (USED-SURFACES (N1 N2 A2) CONDITIONS ((DIST '(N1 N2)) < DIST-PINCH) OFFSET (LIST 0 0 0 0 0 0) WRENCH (1 (* 2 U) (* 2 U) (* 2 V) (* U (DIST '(N1 N2))) (* U (DIST '(N1 N2)))) TWIST (1 1 1 1 1...")
    (:GRASPS "USED-SURFACES (N1 N2 A2)" ""
     "grasps.lisp:6: GRASP G: USED-SURFACES is missing")
    (:GRASPS "USED-SURFACES" "USED-SURFACE"
     "grasps.lisp:7: GRASP G: unknown key USED-SURFACE (did you mean USED-SURFACES?); keys are USED-SURFACES, CONDITIONS, OFFSET, REACH, WRENCH, TWIST, CONTACTS, PALM"
     "grasps.lisp:6: GRASP G: USED-SURFACES is missing")
    (:GRASPS "USED-SURFACES (N1 N2 A2)" "USED-SURFACES (N1 N2 X1)"
     "grasps.lisp:7: GRASP G, USED-SURFACES: (N1 N2 X1): USED-SURFACES are some of N1 N2 O1 O2 A1 A2")
    (:GRASPS "USED-SURFACES (N1 N2 A2)" "USED-SURFACES (N1 N1 A2)"
     "grasps.lisp:7: GRASP G, USED-SURFACES: (N1 N1 A2): the same surface twice")
    (:GRASPS "PALM A2" "PALM A2 PALM A2"
     "grasps.lisp:6: GRASP G: PALM is given twice")
    (:GRASPS "PALM A2" "PALM"
     "grasps.lisp:6: GRASP G: PALM has no value; a grasp is a list of keys and values in turn")
    (:GRASPS "PALM A2" "PALM A1"
     "grasps.lisp:6: GRASP G, PALM: the palm faces A1, which is not one of USED-SURFACES")
    (:GRASPS "PALM A2" "PALM TOP"
     "grasps.lisp:6: GRASP G, PALM: TOP: PALM is one of N1 N2 O1 O2 A1 A2")
    (:GRASPS "((N1 0 0) (N2 0 0))" "((N1 0 0) (O2 0 0))"
     "grasps.lisp:15: GRASP G, CONTACTS: a finger is on O2, which is not one of USED-SURFACES")
    (:GRASPS "((N1 0 0) (N2 0 0))" "((N1 0) (N2 0 0))"
     "grasps.lisp:15: GRASP G, CONTACTS: (N1 0) is not a contact: one of N1 N2 O1 O2 A1 A2, and its place on it along the two other axes, such as (N1 0 0)")
    (:GRASPS "((N1 0 0) (N2 0 0))" "((N1 0 0) (N2 0 0) (N1 0 0))"
     "grasps.lisp:15: warning: GRASP G, CONTACTS: contacts 1 and 3 are at the same place: their forces add up")
    (:GRASPS "((N1 0 0) (N2 0 0))" "()"
     "grasps.lisp:6: GRASP G, CONTACTS: CONTACTS lists no contact")
    (:GRASPS "(LIST 0 0 0 0 0 0)" "(LIST 0 0 0 0 0)"
     "grasps.lisp:9: GRASP G, OFFSET: 5 entries, six are needed: along N O A, about N O A (OFFSET: N1 N2 O1 O2 A1 A2)")
    (:GRASPS "(LIST 0 0 0 0 0 0)" "0"
     "grasps.lisp:6: GRASP G, OFFSET: 0 is not a list of six entries")
    (:GRASPS "(* 2 v)" ""
     "grasps.lisp:10: GRASP G, WRENCH: 5 entries, six are needed: along N O A, about N O A (OFFSET: N1 N2 O1 O2 A1 A2)")
    (:GRASPS "(* 2 v)" "(* 2 w)"
     "grasps.lisp:11: GRASP G, WRENCH: unknown name W; known are U, V, the gripper's dimensions, a helper's parameters and what LET* binds")
    (:GRASPS "(* 2 v)" "(SIN v)"
     "grasps.lisp:11: GRASP G, WRENCH: unknown operator SIN (did you mean MIN?) in (SIN V); operators are + - * / SQRT EXPT MIN MAX ABS POSIT DIST COND IF LET LET* HALF")
    (:GRASPS "(* 2 v)" "(SQRT 2 v)"
     "grasps.lisp:11: GRASP G, WRENCH: SQRT takes 1 argument, here 2: (SQRT 2 V)")
    (:GRASPS "(* 2 v)" "(/ 2 0)"
     "grasps.lisp:11: GRASP G, WRENCH: (/ 2 0) has no value")
    (:GRASPS "(* 2 v)" "\"2v\""
     "grasps.lisp:10: GRASP G, WRENCH: \"2v\" is not a number, a name or an operation")
    (:GRASPS "(* 2 v)" "(COND ((> v 0) 1))"
     "grasps.lisp:11: GRASP G, WRENCH: the last clause of COND must be (T ...), or a case has no value")
    (:GRASPS "(* 2 v)" "(IF (> v 0) 1)"
     "grasps.lisp:11: GRASP G, WRENCH: IF is (IF test then else)")
    (:GRASPS "(* 2 v)" "(LET* ((x)) 1)"
     "grasps.lisp:11: GRASP G, WRENCH: (X) is not a binding, such as (r (/ (DIST '(N1 N2)) 2))")
    (:GRASPS "(* 2 v)" "(DIST '(N1 A1))"
     "grasps.lisp:11: GRASP G, WRENCH: (DIST '(N1 A1)): DIST takes two opposite faces, such as (DIST '(N1 N2))")
    (:GRASPS "(* 2 v)" "(HALF)"
     "grasps.lisp:11: GRASP G, WRENCH: HALF takes 1 argument, here 0: (HALF)")
    (:GRASPS "(* 2 v)" "(EVAL (QUIT))"
     "grasps.lisp:11: GRASP G, WRENCH: unknown operator EVAL in (EVAL (QUIT)); operators are + - * / SQRT EXPT MIN MAX ABS POSIT DIST COND IF LET LET* HALF")
    (:GRASPS "(* 2 v)" "1e999"
     "grasps.lisp:11:13: 1e999 is out of range: numbers lie between 1e-300 and 1e300, or are 0")
    (:GRASPS "(1 1 1 1 1 1)" "(1 1 1 1 1 -1)"
     "grasps.lisp:14: GRASP G, TWIST: an entry is below 0, but a mobility must be 0 or more")
    (:GRASPS "((DIST '(N1 N2)) < DIST-PINCH)" "((DIST '(N1 N2)) < DIST-PINCH AND)"
     "grasps.lisp:8: GRASP G, CONDITIONS: ((DIST '(N1 N2)) < DIST-PINCH AND): AND stands between two tests")
    (:GRASPS "((DIST '(N1 N2)) < DIST-PINCH)" "((DIST '(N1 N2)) LESS DIST-PINCH)"
     "grasps.lisp:8: GRASP G, CONDITIONS: ((DIST '(N1 N2)) LESS DIST-PINCH) is not a test: write (a < b), and join tests by AND and OR")
    (:GRASPS "((DIST '(N1 N2)) < DIST-PINCH)" "(CONSTRAINED Z1)"
     "grasps.lisp:8: GRASP G, CONDITIONS: (CONSTRAINED Z1): CONSTRAINED takes one of N1 N2 O1 O2 A1 A2")
    (:GRASPS "((DIST '(N1 N2)) < DIST-PINCH)" "(NOT T T)"
     "grasps.lisp:8: GRASP G, CONDITIONS: (NOT T T): NOT takes one test")
    (:GRASPS "((DIST '(N1 N2)) < DIST-PINCH)" "(FINGER-LENGTH > DIST-PINCH)"
     "grasps.lisp:8: warning: GRASP G, CONDITIONS: these conditions are false for every box")
    (:GRASPS "(* 2 v)" "(LET* 1 2 3)"
     "grasps.lisp:11: GRASP G, WRENCH: LET* is written (LET* ((name form)...) form)")
    (:GRASPS "(* 2 v)" "(COND (T 0 1))"
     "grasps.lisp:11: GRASP G, WRENCH: (T 0 1) is not a clause of COND, such as (T 0)")
    (:GRASPS "(* 2 v)" "(COND)"
     "grasps.lisp:11: GRASP G, WRENCH: COND has no clause")
    (:GRASPS "((DIST '(N1 N2)) < DIST-PINCH)" "(< 1 2 3)"
     "grasps.lisp:8: GRASP G, CONDITIONS: (< 1 2 3): < compares two numbers")
    (:GRASPS "FINGER-LENGTH 3" "FINGER-LENGTH 3 4"
     "grasps.lisp:1: GRIPPER: 4 is not the name of a dimension"))
  "Which of the two texts is spoiled, what in it is replaced, by what, and all reports.")

(defun spoiled-reports (file from to)
  "Return the reports on the good texts, FROM replaced by TO in the rules or the grasps."
  (flet ((text (which good)
           (if (eq file which)
               (let ((place (search from good)))
                 (concatenate 'string (subseq good 0 place) to
                              (subseq good (+ place (length from)))))
               good)))
    (mapcar #'princ-to-string
            (nth-value 1 (text-knowledge (text :rules *good-rules*)
                                         (text :grasps *good-grasps*))))))

(test the-good-files-are-good
  (is (null (nth-value 1 (text-knowledge *good-rules* *good-grasps*)))))

(test the-shipped-knowledge-has-no-warning
  (is (null (supergrip:knowledge-warnings supergrip:*knowledge*))))

(test every-mistake-is-named-with-its-line
  (is (>= (length *spoiled*) 40))
  (loop for (file from to . reports) in *spoiled*
        do (is (equal reports (spoiled-reports file from to)) "~s for ~s" to from)))

(test rules-and-grasps-have-limits
  (flet ((reports (rules grasps)
           (mapcar #'princ-to-string
                   (supergrip-data:errors-in (nth-value 1 (text-knowledge rules grasps)))))
         (repeat (count text) (format nil "~v@{~a ~:*~}" count text)))
    (is (equal '("rules.lisp:1: RULE R: more than 500 clauses")
               (reports (format nil "(RULE R (IF ~a) (THEN (KEEP BEST)))" (repeat 501 "(SLIPPERY)"))
                        *good-grasps*)))
    (is (equal '("grasps.lisp:15: GRASP G, CONTACTS: CONTACTS lists more than 50 contacts")
               (reports *good-rules*
                        (replace-once *good-grasps* "((N1 0 0)"
                                      (format nil "(~a" (repeat 51 "(N1 0 0)"))))))
    (let ((reports (reports (format nil "(RULE R (IF ~a) (THEN (KEEP BEST)))"
                                    (repeat 400 "(SMALL)"))
                            *good-grasps*)))
      (is (= 21 (length reports)))
      (is (equal "rules.lisp:1: RULE R: and 380 more problems" (first (last reports)))))))

(test several-mistakes-are-all-reported
  (let ((reports (mapcar #'princ-to-string
                         (nth-value 1 (text-knowledge
                                       (replace-once (replace-once *good-rules* "(KEEP BEST)"
                                                                   "(KEEP IT)")
                                                     "(SMALL (s1 s2))" "(SMALL (s1))")
                                       (replace-once *good-grasps* "PALM A2" "PALM A1"))))))
    (is (equal '("grasps.lisp:6: GRASP G, PALM: the palm faces A1, which is not one of USED-SURFACES"
                 "rules.lisp:2: RULE OBVIOUS, clause 1: SMALL takes 2 surfaces; here it has 1"
                 "rules.lisp:16: RULE END, action 1: KEEP is (KEEP BEST)")
               reports)))
  (is (equal '("grasps.lisp:6: GRASP G, PALM: A9: PALM is one of N1 N2 O1 O2 A1 A2"
               "grasps.lisp:15: GRASP G, CONTACTS: (N1 0) is not a contact: one of N1 N2 O1 O2 A1 A2, and its place on it along the two other axes, such as (N1 0 0)")
             (mapcar #'princ-to-string
                     (nth-value 1 (text-knowledge
                                   *good-rules*
                                   (replace-once (replace-once *good-grasps* "PALM A2" "PALM A9")
                                                 "((N1 0 0) (N2 0 0))" "((N1 0) (N2 0 0))")))))))
