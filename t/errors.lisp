;;;; errors.lisp -- bad boxes and bad knowledge: refused, with everything that is wrong named.

(in-package :supergrip-test)
(define-suite errors "Bad boxes and bad knowledge: refused, with everything that is wrong named.")

(defun box-reports (form)
  (problem-texts (lambda () (supergrip:parse-box form))))

(test bad-values-in-a-box-are-refused
  (loop for (key . values) in
        '((:size 12 2) (:size 12 2 2 2) (:size 12 2 0) (:size 12 -2 2) (:size (12 2 2))
          (:size 12 2 "2") (:size) (:size 12 2 wide)
          (:weight -0.1) (:weight) (:weight 0.1 0.2) (:weight heavy)
          (:u -0.1) (:u "0.8") (:u) (:v -1) (:v 0.2 0.2)
          (:force-needed 1 1 1 1 1 1) (:force-needed (1 1 1 1 1)) (:force-needed (1 1 1 1 1 1 1))
          (:force-needed (1 1 1 1 1 1.1)) (:force-needed (1 1 1 1 1 -0.1)) (:force-needed)
          (:velocity-needed (1 1 1 1 1 x)) (:velocity-needed ()))
        do (let ((reports (box-reports (apply #'changed-box key values))))
             (is (= 1 (length reports)) "~s ~s: ~s" key values reports)
             (is (search (format nil "BOX: (~a" key) (first reports)))
             (is (search "takes" (first reports)) "the report says what is valid"))))

(test other-mistakes-in-a-box-are-named
  (loop for (form report) in
        `((12 "BOX: 12 is not a box description: it is a list such as ((SIZE 12 2 2) (WEIGHT 0.2) ...)")
          (((size 12 2 2))
           "BOX: WEIGHT is missing; it takes one number, 0 or more, in finger forces: (WEIGHT 0.2)")
          (,(cons '(:size 1 1 1) *good-box*) "BOX: SIZE is given twice")
          (,(cons '(:frction 1) *good-box*) "BOX: unknown key FRCTION")
          (,(cons '(:wieght 1) *good-box*) "BOX: unknown key WIEGHT (did you mean WEIGHT?)")
          (,(cons :size *good-box*) "BOX: SIZE is not a part of a box description: its parts are lists such as (SIZE 12 2 2)")
          (,(changed-box :constrained :z3)
           "BOX: Z3 is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2")
          (,(changed-box :constrained '(:z2))
           "BOX: (Z2) is not a surface of a box: surfaces are X1 X2 Y1 Y2 Z1 Z2")
          (,(changed-box :constrained :z2 :q :x9) "BOX: Q is not a surface of a box")
          (,(changed-box :constrained :z2 :z2) "BOX: Z2 is constrained twice")
          (,(remove :constrained *good-box* :key #'first) "BOX: CONSTRAINED is missing")
          (,(cons '(:name pencil) *good-box*)
           "BOX: (NAME PENCIL) is not valid: NAME takes one string: (NAME \"pencil\")")
          (((size 1 1 1) (weight 0) (u 0) (v 0) (constrained) (force-needed (0 0 0 0 0 0))
            (velocity-needed (0 0 0 0 0 0)))
           "BOX: the task needs nothing: FORCE-NEEDED and VELOCITY-NEEDED are all 0"))
        do (let ((reports (box-reports form)))
             (is (eql 0 (search report (or (first reports) ""))) "~s~%gave ~s" form reports))))

(test what-readers-of-a-box-return-may-stand-in-a-box
  (flet ((constrained (&rest faces)
           (supergrip:box-constrained
            (supergrip:parse-box (apply #'changed-box :constrained faces)))))
    (is (equal '("Z2" "X1") (constrained "Z2" "x1")))
    (is (equal '("Z2" "X1") (apply #'constrained (constrained 'z2 '|x1|)))))
  (is (search "\"Z3\" is not a surface" (first (box-reports (changed-box :constrained "Z3"))))))

(test all-mistakes-in-a-box-come-at-once
  (is (= 3 (length (box-reports (changed-box :constrained :z2 :q :x9 :z2)))))
  (is (= 4 (length (box-reports '((size 1 1) (weight -1) (u 1) (v 1) (constrained q)
                                  (force-needed (2 2 2 2 2 2))
                                  (velocity-needed (0 0 0 0 0 1))))))))

(test good-boxes-in-all-their-forms
  (let ((box (supergrip:parse-box *good-box*)))
    (is (equalp '(12d0 2d0 2d0) (supergrip:box-size box)))
    (is (equal '("Z2" "X1") (supergrip:box-constrained box)))
    (dolist (form (list (reverse *good-box*)
                        (list 'setq 'box (list 'quote *good-box*))
                        (list 'quote *good-box*)
                        '((size 12 2 2) (weight 0.2) (u 0.8) (v 0.2) (constrained x1 z2)
                          (force-needed (1 0.8 0.8 0.3 1 1))
                          (velocity-needed (0 0.8 0.8 0 0.8 0.8)))))
      (is (equalp box (supergrip:parse-box form)) "~s" form)))
  (dolist (name '(nil :nil))
    (is (null (supergrip:box-name (supergrip:parse-box (cons (list :name name) *good-box*))))))
  (is (equal "a box" (supergrip:box-name (supergrip:parse-box (cons '(name "a box") *good-box*)))))
  (is (zerop (supergrip:box-weight (supergrip:parse-box (changed-box :weight 0)))))
  (is (zerop (supergrip:box-friction (supergrip:parse-box (changed-box :u 0)))))
  (is (null (supergrip:box-constrained (supergrip:parse-box (changed-box :constrained))))))

(test a-bad-box-leaves-the-former-one
  (let ((supergrip::*box* nil))
    (signals supergrip:no-box-error (supergrip:forward-chain))
    (setf supergrip:box *good-box*)
    (signals supergrip:box-error (setf supergrip:box '((size 1))))
    (is (equalp '(12d0 2d0 2d0) (supergrip:box-size supergrip:box)))))

;;; Knowledge

(test a-small-knowledge-base-is-good
  (is (null (grasp-reports)))
  (is (null (grasp-reports :contacts nil :palm nil)))
  (is (null (grasp-reports :conditions "((DIST '(N1 N2)) < 3 AND (u > 1) OR (NOT (CONSTRAINED O1)))"
                           :offset "(LET* ((x 1)) (COND ((> x u) (LIST 0 0 0 0 0 0))
                                                        (T (LIST 0 0 0 0 (- x) x))))"))))

(test mistakes-in-grasps-are-named
  ;; Those that t/spoiled.lisp does not have.
  (loop for (key text report) in
        '((:conditions "((DIST '(N1 N2)) < FINGER-LENGHT)"
           "GRASP G, CONDITIONS: unknown name FINGER-LENGHT (did you mean FINGER-LENGTH?)")
          (:conditions "(AND)" "GRASP G, CONDITIONS: AND joins no tests")
          (:wrench "(1 1 1 1 1 (SQRT -1))" "GRASP G, WRENCH: (SQRT -1) has no value")
          (:twist "(1 1 1 1 1 1 1)" "GRASP G, TWIST: 7 entries, six are needed"))
        do (let ((reports (grasp-reports key text)))
             (is (search report (or (first reports) "")) "~s~%gave ~s" report reports)
             (is (eql 0 (search "grasps.lisp:" (first reports))))))
  (is (search "GRASP G, PALM: PALM is missing, and no face of A is used"
              (first (grasp-reports :used-surfaces "(N1 N2)" :palm nil))))
  (is (equal '("grasps.lisp:10: GRASP G: an earlier grasp has this name")
             (knowledge-reports "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                                (format nil "~a~%~a~:*~a" *small-gripper* (grasp-text))))))

(defmacro without-warnings (&body body)
  `(handler-bind ((warning #'muffle-warning)) ,@body))

(test nothing-is-half-loaded
  (without-warnings (spoil-and-mend)))

(defun spoil-and-mend ()
  (uiop:with-temporary-file (:stream out :pathname rules :keep nil)
    (format out "(RULE A (IF (SLIPPERY)) (THEN (CANT X)))~%(RULE B (IF (SMALL (s1))) (THEN ~
                 (FROB)))")
    :close-stream
    (let ((before supergrip:*knowledge*))
      (handler-case (supergrip:load-knowledge :rules rules)
        (supergrip:knowledge-error (condition)
          (is (= 2 (length (supergrip-data:errors-in
                          (supergrip:input-error-problems condition)))))
          (is (search (format nil "~a:2: RULE B, clause 1:" (uiop:native-namestring rules))
                      (princ-to-string condition)))))
      (is (eq before supergrip:*knowledge*)))
    (let ((knowledge (handler-bind ((supergrip:knowledge-error #'continue))
                       (supergrip:load-knowledge :rules rules))))
      (is (equal '("A")
                 (mapcar #'supergrip-chainer:rule-name (supergrip:knowledge-rules knowledge)))
          "CONTINUE leaves out what is wrong"))
    (let ((tries 0))
      (is (= 1 (length (supergrip:knowledge-rules
                        (handler-bind ((supergrip:knowledge-error
                                         (lambda (condition)
                                           (declare (ignore condition))
                                           (incf tries)
                                           (with-open-file (out rules :direction :output
                                                                      :if-exists :supersede)
                                             (format out
                                                     "(RULE A (IF (SLIPPERY)) (THEN (CANT X)))"))
                                           (supergrip:retry))))
                          (supergrip:load-knowledge :rules rules)))))
          "RETRY reads the mended file")
      (is (= 1 tries)))))

(test a-file-that-is-not-there-is-named
  (loop for (file report) in
        '(("/no/such/rules.lisp" "can't be opened: No such file or directory")
          ("no-such-[1]*.lisp" "can't be opened: No such file or directory")
          (#p"/no/such/rules.lisp" "can't be opened: No such file or directory")
          ("/" "can't be opened: Is a directory"))
        do (is (equal (list (format nil "~a: this file ~a" file report))
                      (problem-texts (lambda () (supergrip:load-knowledge :rules file)))))))

(test a-relative-path-means-one-file
  (let ((directory (uiop:ensure-directory-pathname
                    (format nil "~asupergrip-~36r"
                            (uiop:native-namestring (uiop:temporary-directory))
                            (random (expt 36 8) (make-random-state t))))))
    (ensure-directories-exist (merge-pathnames "k1/" directory))
    (unwind-protect
         (let ((supergrip:*knowledge* supergrip:*knowledge*))
           (flet ((put (rule)
                    (with-open-file (out (merge-pathnames "k1/r.lisp" directory)
                                         :direction :output :if-exists :supersede)
                      (format out "(RULE ~a (IF (SLIPPERY)) (THEN (CANT X)))" rule)))
                  (names ()
                    (mapcar #'supergrip-chainer:rule-name
                            (supergrip:knowledge-rules supergrip:*knowledge*))))
             (without-warnings
               (put "A")
               (let ((*default-pathname-defaults* directory))
                 (supergrip:reload-knowledge :rules "k1/r.lisp"))
               (is (equal '("A") (names)))
               (put "B")
               (supergrip:reload-knowledge)
               (is (equal '("B") (names)) "the same file, from another directory"))
             (put "B)")
             (is (eql 0 (search "k1/r.lisp:1:"
                                (first (problem-texts #'supergrip:reload-knowledge)))))))
      (uiop:delete-directory-tree directory :validate t))))

(test a-spoiled-file-names-line-and-column
  (uiop:with-temporary-file (:stream out :pathname file :keep nil)
    (format out "(SETQ GRIPPER '(FINGER-LENGTH 3)))~%")
    :close-stream
    (is (equal (list (format nil "~a:1:34: a closing parenthesis too many"
                             (uiop:native-namestring file)))
               (problem-texts (lambda () (supergrip:load-knowledge :grasps file))))))
  (uiop:with-temporary-file (:stream out :pathname file :external-format :utf-16le)
    (write-string (file-text "rules.lisp") out)
    :close-stream
    (is (equal (list (format nil "~a: this file is UTF-16, but must be UTF-8; iconv -f UTF-16 -t ~
                                  UTF-8 converts it"
                             (uiop:native-namestring file)))
               (problem-texts (lambda () (supergrip:load-knowledge :rules file)))))))

(test arithmetic-in-a-form-rejects-the-candidate
  (flet ((failure (&rest changes)
           (let* ((text (format nil "~a~%~a" *small-gripper* (apply #'grasp-text changes)))
                  (knowledge (text-knowledge "" text))
                  (plan (supergrip:try-grasp "G" '((size 4 4 4) (weight 0.1d0) (u 0) (v 0.2d0)
                                                   (constrained) (force-needed (1 1 1 1 1 1))
                                                   (velocity-needed (1 1 1 1 1 1)))
                                             :knowledge knowledge))
                  (candidate (first (supergrip:plan-candidates plan))))
             (multiple-value-list (supergrip:candidate-failure candidate plan)))))
    (is (equal '(:conditions "u is 0, must be > 1") (failure :conditions "(u > 1)")))
    (is (equal '(:conditions "a form of CONDITIONS has no value")
               (failure :conditions "((/ 1 u) > 1)")))
    (is (equal '(:offset "the fingers can't reach: a root or a quotient of OFFSET has no value")
               (failure :offset "(LIST 0 0 0 0 0 (SQRT (- u 1)))")))
    (is (equal '(:offset "OFFSET's entries for two opposite faces are not opposite numbers")
               (failure :offset "(LIST 0 0 0 0 1 1)")))
    (is (equal '(:fingers "a finger on Z2 would stand at 3 cm along O, beyond the edge at 2")
               (failure :contacts "((N1 3 0) (N2 0 0))")))
    (is (equal '(:open "open: the contacts don't close on this shape; needs u > 0, has 0")
               (failure)))
    (is (equal '(:open "a form of WRENCH has no value")
               (failure :wrench "(1 1 1 1 1 (EXPT u -1))")))
    (is (equal '(:lifting "it can't hold the weight: the load along Z is 0.1, the grasp bears 0.01")
               (failure :wrench "(0.01 0.01 0.01 0.01 0.01 0.01)")))))

(test every-exported-name-is-defined-and-documented
  (dolist (package '(:supergrip :supergrip-chainer :supergrip-data))
    (do-external-symbols (symbol package)
      (is (or (documentation symbol 'function) (documentation symbol 'variable)
              (documentation symbol 'type)
              (documentation symbol 'structure)
              (accessor-of-documented-structure-p symbol)
              (member symbol '(supergrip:box)))
          "~a" symbol))))

(defun accessor-of-documented-structure-p (symbol)
  "True if SYMBOL is an accessor or the constructor of a structure that has a docstring."
  (and (fboundp symbol)
       (let ((name (symbol-name symbol)))
         (loop for structure being the symbols of (symbol-package symbol)
                 thereis (and (documentation structure 'structure)
                              (or (eql 0 (search (format nil "~a-" structure) name))
                                  (equal name (format nil "MAKE-~a" structure))))))))

(defun doubling-helpers (count)
  "Return the text of COUNT helpers, a line each, that each call the last one twice."
  (format nil "(DEFUN F0 (x) (* x u))~%~:{(DEFUN F~d (x) (+ (F~d x) (F~d (+ x 1))))~%~}"
          (loop for i from 1 below count collect (list i (1- i) (1- i)))))

(test forms-have-a-limit
  (flet ((reports (helpers wrench)
           (knowledge-reports "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                              (format nil "~a~%~a~a" *small-gripper* (doubling-helpers helpers)
                                      (grasp-text :wrench wrench)))))
    (is (null (reports 10 "((F9 1) 1 1 1 1 1)")))
    ;; The helper that goes too far is named, and nobody who calls it.
    (is (equal '("grasps.lisp:13: DEFUN F10: more than 8000 steps; each call of a helper counts as all steps of the helper")
               (reports 20 "((F19 1) 1 1 1 1 1)")))
    (is (equal '("grasps.lisp:16: GRASP G, WRENCH: more than 8000 steps; each call of a helper counts as all steps of the helper")
               (reports 10 "((F9 1) (F9 2) (F9 3) 1 1 1)"))))
  (is (equal '("grasps.lisp:5: GRASP G2, WRENCH: more than 16000 different numbers in one file")
             (knowledge-reports
              "(RULE R (IF (SLIPPERY)) (THEN (TRY G0)))"
              (format nil "~a~%~:{(SETQ G~d '(USED-SURFACES (N1 N2 A2) CONDITIONS (u > 0) ~
                                    OFFSET (0 0 0 0 0 0) WRENCH ((+ u~{ ~d~}) 1 1 1 1 1) ~
                                    TWIST (1 1 1 1 1 1)))~%~}"
                      *small-gripper*
                      (loop for i below 3
                            collect (list i (loop for n from (* i 7000) repeat 7000
                                                  collect n))))))))
