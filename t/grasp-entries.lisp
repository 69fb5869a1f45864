;;;; grasp-entries.lisp -- a grasp in each shape that it may have, in a file and typed.

(in-package :supergrip-test)
(define-suite grasp-entries "A grasp in each shape that it may have, in a file and typed.")

(defparameter *one-shape*
  "(SETQ G '(USED-SURFACES (N1 N2 A2) CONDITIONS ((U > 1) AND (V > 0) OR (NOT (CONSTRAINED O1))) OFFSET (LIST 0 0 0 0 (- U) U) WRENCH (1 (* 2 U) (* 2 U) (* 2 V) 1 1) TWIST (1 1 1 1 1 1) CONTACTS ((N1 0 0)) PALM A2))"
  "The grasp of all texts of *SHAPES*, as it is shown.")

(defparameter *shapes*
  '("(SETQ G '((USED-SURFACES (N1 N2 A2)) (CONDITIONS (u > 1) AND (v > 0) OR (NOT (CONSTRAINED O1)))
               (OFFSET (LIST 0 0 0 0 (- u) u)) (WRENCH (1 (* 2 u) (* 2 u) (* 2 v) 1 1))
               (TWIST (1 1 1 1 1 1)) (CONTACTS ((N1 0 0))) (PALM A2)))"
    ;; The paper's: the first key is bare.
    "(SETQ G '(USED-SURFACES (N1 N2 A2) (CONDITIONS (u > 1) AND (v > 0) OR (NOT (CONSTRAINED O1)))
               (OFFSET (LIST 0 0 0 0 (- u) u)) (WRENCH (1 (* 2 u) (* 2 u) (* 2 v) 1 1))
               (TWIST (1 1 1 1 1 1)) CONTACTS ((N1 0 0)) PALM A2))"
    "(SETQ G '(USED-SURFACES (N1 N2 A2)
               (CONDITIONS ((u > 1) AND (v > 0) OR (NOT (CONSTRAINED O1))))
               (OFFSET (LIST 0 0 0 0 (- u) u)) (WRENCH (1 (* 2 u) (* 2 u) (* 2 v) 1 1))
               (TWIST (1 1 1 1 1 1)) (CONTACTS (N1 0 0)) (PALM A2)))"
    "(SETQ G '((USED-SURFACES N1 N2 A2)
               CONDITIONS (u > 1) AND (v > 0) OR (NOT (CONSTRAINED O1))
               OFFSET (LIST 0 0 0 0 (- u) u) (WRENCH 1 (* 2 u) (* 2 u) (* 2 v) 1 1)
               (TWIST 1 1 1 1 1 1) CONTACTS (N1 0 0) PALM A2))")
  "One grasp in several shapes, for files and for the REPL.")

(defun grasp-text-of (knowledge &optional (name "G"))
  "Return the form of the grasp NAME of KNOWLEDGE as a text."
  (supergrip-data:form-text
   (supergrip:grasp-form (find name (supergrip:knowledge-grasps knowledge)
                               :key #'supergrip:grasp-name :test #'string=))
   nil))

(test a-grasp-has-many-shapes-in-a-file
  (dolist (shape *shapes*)
    (multiple-value-bind (knowledge problems)
        (text-knowledge "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                        (format nil "~a~%~a" *small-gripper* shape))
      ;; That one finger holds nothing is warned of.
      (is (null (supergrip-data:errors-in problems)) "~a" problems)
      (is (equal *one-shape* (grasp-text-of knowledge))))))

(test a-grasp-has-many-shapes-typed
  (dolist (shape (append *shapes*
                         (mapcar (lambda (shape)
                                   (changed shape "(LIST 0 0 0 0 (- u) u)" "`(0 0 0 0 ,(- u) ,u)"))
                                 *shapes*)
                         (list (changed (first *shapes*) "'((" "`(("))))
    (with-knowledge-restored
      (is (eq (eval-in-user shape) supergrip:*knowledge*) shape)
      (is (equal *one-shape* (grasp-text-of supergrip:*knowledge*))))))

(test conditions-need-no-list-of-their-own
  (loop for (written shown) in
        '(("T" "T")
          ("u > 1" "(U > 1)")
          ("(u > 1)" "(U > 1)")
          ("u > 1 AND 2 < v" "(U > 1 AND 2 < V)")
          ("NOT (CONSTRAINED O1)" "(NOT (CONSTRAINED O1))")
          ("(u > 1) AND NOT (CONSTRAINED O1)" "((U > 1) AND NOT (CONSTRAINED O1))")
          ("((DIST '(N1 N2)) < 3) OR u = 1" "(((DIST '(N1 N2)) < 3) OR U = 1)"))
        do (dolist (entry '("CONDITIONS ~a" "(CONDITIONS ~a)"))
             (let ((knowledge (text-knowledge
                               "" (format nil "~a (SETQ G '(USED-SURFACES (N1 A2) ~? OFFSET (0 0 0 ~
                                               0 0 0) WRENCH (1 1 1 1 1 1) TWIST (1 1 1 1 1 1)))"
                                          *small-gripper* entry (list written)))))
               (is (search (format nil "CONDITIONS ~a OFFSET" shown) (grasp-text-of knowledge)))))))

(test a-gripper-may-have-lists
  (let ((reports (knowledge-reports
                  "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                  (format nil "(SETQ GRIPPER '((FINGER-LENGTH 3) (FINGER-DIST 6) FINGER-SPREAD 2
                               (FINGER-WIDTH 1 DIST-PINCH 12) (WIDTH-HAND 8) (SLIPPERY-U 0.1)))~a"
                          (first *shapes*)))))
    (is (null reports) "~a" reports)))

;;; The paper's own listing

(defun listing (sum offset)
  "Return the paper's listing of PINCH-2-PARALLEL in its own shape: its parentheses balanced, SUM
where it has + in WRENCH, and OFFSET for the list that the scan damaged."
  (let ((text
         (part-between (file-text "t/paper-listings.txt") "(SETQ PINCH-2-PARALLEL" "(SETQ BOX")))
    (loop for (from to) in `(("(DIST '(D1 D2))" "(DIST '(O1 O2))")
                             ("(CONSTRAINED D1)" "(CONSTRAINED O1)")
                             ("(CONSTRAINED D2))))))" "(CONSTRAINED O2))))")
                             ("(/ (- DIST '(N1 N2)) FINGER-DIST) 2)"
                              "(/ (- (DIST '(N1 N2)) FINGER-DIST) 2))")
                             ("'(0 0 0 0 .(- offset) ,offset)" ,offset)
                             ("(TWIST (0.8 0.5 1 0.2 1 1)))" ") (TWIST (0.8 0.5 1 0.2 1 1))))")
                             ("(WRENCH (1
  (+ 2 u)
  (+ 2 u)
  (+ 2 v)
  (+ u (DIST '(N1 N2)))
  (+ u " ,(format nil "(WRENCH (1 ~%(~a 2 u)~:*~%(~a 2 u)~:*~%(~a 2 v)~:*~%(~a u (DIST '(N1 ~
                       N2)))~:*~%(~a u "
                  sum)))
          do (setf text (replace-once text from to)))
    text))

(defparameter *listed-offset* "(LIST 0 0 0 0 (- offset) offset)")

(defun listed-quality (knowledge)
  "Return the qualities of the listed grasp of KNOWLEDGE on the paper's box."
  (mapcar #'second (supergrip:possible-grasps
                    (supergrip:try-grasp "PINCH-2-PARALLEL" (paper-box) :knowledge knowledge))))

(test the-papers-listing-is-typed-in-its-own-shape
  (let ((qualities (listed-quality supergrip:*knowledge*)))
    (with-knowledge-restored
      (dolist (offset (list *listed-offset* "`(0 0 0 0 ,(- offset) ,offset)"))
        (is (null (warning-texts (eval-in-user (listing "*" offset)))))
        (is (equal qualities (listed-quality supergrip:*knowledge*)))
        (is (search "OFFSET) OFFSET)) WRENCH (1 (* 2 U)"
                    (grasp-text-of supergrip:*knowledge* "PINCH-2-PARALLEL"))))
      (supergrip:reload-knowledge)
      (eval-in-user (format nil "(edit '~a)" (listing "*" *listed-offset*)))
      (is (equal qualities (listed-quality supergrip:*knowledge*))))))

(test the-papers-listing-stands-in-a-file-in-its-own-shape
  (multiple-value-bind (knowledge problems)
      (text-knowledge "(RULE R (IF (SLIPPERY)) (THEN (TRY PINCH-2-PARALLEL)))"
                      (format nil "~a~%~a" *small-gripper* (listing "+" *listed-offset*)))
    (is (equal '("grasps.lisp:21: warning: GRASP PINCH-2-PARALLEL, WRENCH: entry 2: (+ 2 U) is taken as it stands, a sum; the product (* 2 U) was probably meant"
                 "grasps.lisp:22: warning: GRASP PINCH-2-PARALLEL, WRENCH: entry 3: (+ 2 U) is taken as it stands, a sum; the product (* 2 U) was probably meant"
                 "grasps.lisp:23: warning: GRASP PINCH-2-PARALLEL, WRENCH: entry 4: (+ 2 V) is taken as it stands, a sum; the product (* 2 V) was probably meant"
                 "grasps.lisp:24: warning: GRASP PINCH-2-PARALLEL, WRENCH: entry 5: (+ U (DIST '(N1 N2))) is taken as it stands, a sum; the product (* U (DIST '(N1 N2))) was probably meant"
                 "grasps.lisp:25: warning: GRASP PINCH-2-PARALLEL, WRENCH: entry 6: (+ U (DIST '(N1 N2))) is taken as it stands, a sum; the product (* U (DIST '(N1 N2))) was probably meant")
               (mapcar #'princ-to-string problems)))
    (let* ((plan (supergrip:try-grasp "PINCH-2-PARALLEL" (paper-box) :knowledge knowledge))
           (wrench (supergrip:candidate-wrench (first (supergrip:plan-possible plan)) plan)))
      (is (close-to '(1 2.2d0 2.8d0 2.8d0 2.8d0 2.8d0) (sort (copy-list wrench) #'<))
          "sums are taken as they stand: ~a" wrench))))

;;; What is wrong in each shape

(defun shape-reports (from to)
  "Return what is said of the first of *SHAPES* in a file, FROM replaced by TO."
  (knowledge-reports "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                     (format nil "~a~%~a" *small-gripper* (changed (first *shapes*) from to))))

(test mistakes-in-every-shape-are-named
  (loop for (from to . reports) in
        '(("(CONDITIONS (u" "(CONDITION (u"
           "grasps.lisp:3: GRASP G: unknown key (CONDITION (U > 1) AND (V > 0) OR (NOT (CONSTRAINED O1))) (did you mean CONDITIONS?); keys are USED-SURFACES, CONDITIONS, OFFSET, REACH, WRENCH, TWIST, CONTACTS, PALM"
           "grasps.lisp:3: GRASP G: CONDITIONS is missing")
          ("(OFFSET (LIST 0 0 0 0 (- u) u))" ""
           "grasps.lisp:3: GRASP G: OFFSET is missing; REACH may take its place, such as REACH (A 4)")
          ("(OFFSET (LIST 0 0 0 0 (- u) u))" "(OFFSET)"
           "grasps.lisp:4: GRASP G: OFFSET has no value; a grasp is a list of keys and values in turn")
          ("(OFFSET (LIST 0 0 0 0 (- u) u))" "OFFSET"
           "grasps.lisp:3: GRASP G: OFFSET has no value; a grasp is a list of keys and values in turn")
          ("(OFFSET (LIST 0 0 0 0 (- u) u))" "(OFFSET 0)"
           "grasps.lisp:4: GRASP G, OFFSET: 0 is not a list of six entries")
          ("(LIST 0 0 0 0 (- u) u)" "'(0 0 0 0 (- u) u)"
           "grasps.lisp:4: GRASP G, OFFSET: '(0 0 0 0 (- U) U): what is quoted is not computed; write (LIST 0 0 0 0 (- U) U)")
          ("(LIST 0 0 0 0 (- u) u)" "'(0 0 0)"
           "grasps.lisp:4: GRASP G, OFFSET: 3 entries, six are needed: along N O A, about N O A (OFFSET: N1 N2 O1 O2 A1 A2)")
          ("(LIST 0 0 0 0 (- u) u)" "`(0 0 0 0 ,(- u) ,u)"
           "grasps.lisp:4:24: ` is not allowed in a name or a number: a list whose entries are computed is written (LIST 0 0 0 0 (- x) x)")
          ("(PALM A2)" "(PALM A2) (TWIST (1 1 1 1 1 1))"
           "grasps.lisp:5: GRASP G: TWIST is given twice")
          ("(PALM A2)" "(PALM A1)"
           "grasps.lisp:5: GRASP G, PALM: the palm faces A1, which is not one of USED-SURFACES")
          ("(N1 N2 A2)" "X1"
           "grasps.lisp:3: GRASP G, USED-SURFACES: (X1): USED-SURFACES are some of N1 N2 O1 O2 A1 A2")
          ("(TWIST (1 1 1 1 1 1))" "(TWIST 1 1 1 1 1 -1)"
           "grasps.lisp:5: GRASP G, TWIST: an entry is below 0, but a mobility must be 0 or more")
          ("AND (v > 0) OR (NOT (CONSTRAINED O1))" "AND"
           "grasps.lisp:3: GRASP G, CONDITIONS: ((U > 1) AND): AND stands between two tests")
          ;; The scan's parentheses: the grasp ends too early.
          ("(OFFSET (LIST 0 0 0 0 (- u) u))" "))
 (OFFSET (LIST 0 0 0 0 (- u) u)) (SETQ H '(USED-SURFACES (N1 N2 A2) CONDITIONS T OFFSET '(0 0 0 0 0 0)"
           "grasps.lisp:3: GRASP G: OFFSET is missing; REACH may take its place, such as REACH (A 4)"
           "grasps.lisp:3: GRASP G: WRENCH is missing; WRENCH FROM-CONTACTS computes it"
           "grasps.lisp:3: GRASP G: TWIST is missing; TWIST FROM-CONTACTS computes it"
           "grasps.lisp:5: OFFSET stands outside of a grasp: a ) before it is one too many"))
        do (let ((said (shape-reports from to)))
             (is (equal reports said) "~a~%gave ~{~a~%~}" to said))))

(defun typed-report (text)
  "Return what is said when TEXT is typed: the message of an error, or a warning, or the value."
  (let ((value nil))
    (or (first (warning-texts
                (setf value (error-text (setf value (eval-in-user text))))))
        (unless (equal value "no error") value))))

(test mistakes-in-what-is-typed-are-named
  (let ((before supergrip:*knowledge*))
    (loop for (from to report) in
          '(("(OFFSET (LIST 0 0 0 0 (- u) u))" "(OFFSET `(0 0 0 0 (- u) ,u))"
             "GRASP G, OFFSET: (- U) can't stand here: in a backquoted list stand numbers, and forms with a comma, as `(0 0 0 0 ,(- x) ,x)")
            ("(OFFSET (LIST 0 0 0 0 (- u) u))" "OFFSET `(0 0 0 0 ,@u)"
             "GRASP G, OFFSET: ,@U can't stand here: in a backquoted list stand numbers, and forms with a comma, as `(0 0 0 0 ,(- x) ,x)")
            ("(OFFSET (LIST 0 0 0 0 (- u) u))" "(OFFSET `(0 0 0 0 (- ,u) ,u))"
             "GRASP G, OFFSET: (- ,U) can't stand here: in a backquoted list stand numbers, and forms with a comma, as `(0 0 0 0 ,(- x) ,x)")
            ("(OFFSET (LIST 0 0 0 0 (- u) u))" "(OFFSET `(0 0 0 0 (- ,u)))"
             "GRASP G, OFFSET: ,U can't stand here: in a backquoted list stand numbers, and forms with a comma, as `(0 0 0 0 ,(- x) ,x)")
            ("(OFFSET (LIST 0 0 0 0 (- u) u))" "(OFFSET `(0 0 ,u))"
             "GRASP G, OFFSET: 3 entries, six are needed: along N O A, about N O A (OFFSET: N1 N2 O1 O2 A1 A2)")
            ("(TWIST (1 1 1 1 1 1))" "(TWIST (1 . 2))"
             "GRASP G, TWIST: dotted pairs are not read: (1 . 2)")
            ("(OFFSET (LIST 0 0 0 0 (- u) u))" ""
             "GRASP G: OFFSET is missing; REACH may take its place, such as REACH (A 4)")
            ("USED-SURFACES" "USED-SURFACE"
             "GRASP G: unknown key (USED-SURFACE (N1 N2 A2)) (did you mean USED-SURFACES?); keys are USED-SURFACES, CONDITIONS, OFFSET, REACH, WRENCH, TWIST, CONTACTS, PALM")
            ("(WRENCH (1" "(WRENCH ((FROB u)"
             "GRASP G, WRENCH: unknown operator FROB"))
          do (let ((said (typed-report (changed (first *shapes*) from to))))
               (is (eql 0 (search report (or said ""))) "~a~%gave ~a" to said)))
    (is (eq before supergrip:*knowledge*))
    (is (not (boundp (find-symbol "G" :supergrip-user))))))

(test a-backquote-may-stand-anywhere
  (flet ((canonical (text)
           (supergrip-data:form-text
            (supergrip-data:canonical (let ((*read-default-float-format* 'double-float))
                                        (read-from-string text))))))
    (loop for (typed read) in '(("`(0 1/2 0.5 ,x ,(+ x 1))" "(LIST 0 1/2 0.5 X (+ X 1))")
                                ("(DIST `(N1 N2))" "(DIST '(N1 N2))")
                                ("`(0 0)" "'(0 0)")
                                ("(a `(,(b `(1 ,c))))" "(A (LIST (B (LIST 1 C))))"))
          do (is (equal read (canonical typed))))))

;;; Sums that were products

(defparameter *sums*
  '(("(+ 2 u)" "(* 2 U)") ("(+ u 2)" "(* U 2)") ("(+ 2 v)" "(* 2 V)") ("(+ 0.5 v)" "(* 0.5 V)")
    ("(+ u (DIST '(N1 N2)))" "(* U (DIST '(N1 N2)))")
    ("(+ (DIST '(A1 A2)) u)" "(* (DIST '(A1 A2)) U)")
    ("(+ 2 u (DIST '(N1 N2)))" "(* 2 U (DIST '(N1 N2)))") ("(+ u FINGER-DIST)" "(* U FINGER-DIST)")
    ("(MAX 1 (/ (+ 2 u) 3))" "(* 2 U)") ("(COND ((> u 1) (+ 2 u)) (T 1))" "(* 2 U)")
    ("(LET ((d (DIST '(N1 N2)))) (+ u d))" "(* U D)") ("(HALF (+ 2 u))" "(* 2 U)")
    ;; What is meant.
    ("(+ (* 2 u) v)") ("(+ 1 u)") ("(+ u 1)") ("(+ u v)") ("(+ u u)") ("(+ 1 2)") ("(+ u)")
    ("(+ (* 2 u) (DIST '(N1 N2)))") ("(+ u (/ (DIST '(N1 N2)) 2))") ("(+ (DIST '(N1 N2)) 2)")
    ("(LET ((d (* 2 v))) (+ u d))") ("(- 2 u)") ("(* 2 u)") ("(TWICE 2)"))
  "Entries of WRENCH, each with the product that it is taken for, if it is.")

(test a-sum-that-was-a-product-is-warned-of
  (flet ((reports (key text)
           (mapcar #'princ-to-string
                   (nth-value 1 (text-knowledge
                                 "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                                 (format nil "~a (DEFUN HALF (x) (/ x 2)) (DEFUN TWICE (x) (+ x ~
                                              u))~%~a"
                                         *small-gripper* (grasp-text key text)))))))
    (loop for (sum product) in *sums*
          for reports = (reports :wrench (format nil "(1 ~a 1 1 1 1)" sum))
          do (is (= (if product 1 0) (length reports)) "~a: ~a" sum reports)
             (when product
               (is (eql 0 (search "grasps.lisp:6: warning: GRASP G, WRENCH: entry 2: (+ "
                                  (first reports))))
               (is (search (format nil " is taken as it stands, a sum; the product ~a was probably ~
                                        meant"
                                   product)
                           (first reports)))))
    (is (equal '("grasps.lisp:6: warning: GRASP G, WRENCH: (+ 2 U) is taken as it stands, a sum; the product (* 2 U) was probably meant")
               (reports :wrench "(LET* ((f (+ 2 u))) (LIST 1 f f f f f))")))
    (is (= 2 (length (reports :wrench "(LIST 1 (+ 2 u) (+ 2 u) 1 1 1)"))))
    (is (null (reports :twist "((+ 2 u) 1 1 1 1 1)")))
    (is (null (reports :conditions "((+ 2 u) > 1)")))))

(test a-warning-is-told-once
  (with-knowledge-restored
    (loop repeat 2
          do (is (= 5 (length (warning-texts (eval-in-user (listing "+" *listed-offset*)))))
                 "what is typed again is told again"))
    (is (null (warning-texts (supergrip:edit '(setq finger-length 4)))))
    (is (= 5 (length (supergrip:knowledge-warnings supergrip:*knowledge*))))))

;;; NOT inside a sentence

(test not-may-stand-inside-a-sentence
  (with-knowledge-restored
    (let ((plan (pencil-plan)))
      (loop for (from to) in '(("GRIP4" "(rule grip4 (if (object has not parallel surfaces) (corner (s1 s2 s3))) (then (try pinch-3-corner (s1 ? s2 ? s3 ?))))")
                               ("GRIP6" "(rule grip6 (if (object has not free corners) (object not has parallel surfaces)) (then (try pinch-2-adjacent) (try pinch-3-adjacent) (keep best)))")
                               ("SURFACES1" "(rule surfaces1 (if (opposed (s1 s2)) (constrained not (s1)) (not constrained (s2))) (then (remember parallel (s1 s2)) (remember object has parallel surfaces)))"))
            do (eval-in-user to)
               (is (equal (transcript plan) (transcript (pencil-plan))) "~a" from))
      (let ((lines (printed (supergrip:describe-rule 'grip6))))
        (is (equal "  (IF (OBJECT HAS NOT FREE CORNERS)" (second lines)))
        (is (search "In words: if nothing says that OBJECT HAS FREE CORNERS, and nothing says that OBJECT HAS PARALLEL SURFACES, then"
                    (seventh lines))))
      (is (equal "RULE GRIP6 did not fire: clause 1, (OBJECT HAS NOT FREE CORNERS), fails."
                 (first (printed (supergrip:why-not 'grip6 nil (pencil-plan)))))))))
