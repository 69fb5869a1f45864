;;;; tools.lisp -- what the tests of several files share: each makes what it needs when it is asked.

(in-package :supergrip-test)

;;; The project's files

(defun project-file (name)
  (asdf:system-relative-pathname "supergrip" name))

(defun file-text (name)
  (uiop:read-file-string (project-file name)))

(defun run-process (command &rest keys &key directory (environment '()) (input nil))
  "Run COMMAND, a list of strings, with ENVIRONMENT, a list of NAME=VALUE or -uNAME.
Returns its status, standard output and standard error."
  (declare (ignorable keys))
  (multiple-value-bind (output errors status)
      (uiop:run-program (append '("env") environment command)
                        :directory directory :input input :output :string :error-output :string
                        :ignore-error-status t)
    (values status output errors)))

(defun script (name)
  (list "sbcl" "--script" (uiop:native-namestring (project-file name))))

(defmacro with-text-file ((name text) &body body)
  "Run BODY with NAME bound to the name of a file that holds TEXT."
  `(uiop:with-temporary-file (:stream out :pathname ,name)
     (write-string ,text out)
     :close-stream
     (let ((,name (uiop:native-namestring ,name)))
       ,@body)))

(defun octets (text)
  "Return TEXT, a string, octets, or a list of both, as octets."
  (etypecase text
    (string (sb-ext:string-to-octets text :external-format :utf-8))
    (list (apply #'concatenate '(vector (unsigned-byte 8)) (mapcar #'octets text)))
    (vector text)))

(defun replace-once (text from to)
  "Return TEXT with the one occurrence of FROM replaced."
  (let ((place (search from text)))
    (assert (and place (not (search from text :start2 (1+ place)))) ()
            "~s must stand once in the paper's text" from)
    (concatenate 'string (subseq text 0 place) to (subseq text (+ place (length from))))))

(defun changed (text old new)
  "Return TEXT with NEW in place of the first OLD."
  (let ((start (search old text)))
    (concatenate 'string (subseq text 0 start) new (subseq text (+ start (length old))))))

(defun one-line (text) (substitute #\Space #\Newline text))

(defun repeated (count text) (format nil "~v@{~a~:*~}" count text))

;;; What is said and printed

(defun lines-of (string)
  "Return the list of the lines of STRING."
  (with-input-from-string (in string)
    (loop for line = (read-line in nil) while line collect line)))

(defmacro printed (&body body)
  "Return what BODY prints, as a list of lines."
  `(lines-of (with-output-to-string (*standard-output*) ,@body)))

(defmacro error-text (form)
  "Return the text of the SUPERGRIP-ERROR that FORM signals."
  `(handler-case (progn ,form "no error")
     (supergrip:supergrip-error (condition) (princ-to-string condition))))

(defun transcript (plan)
  (with-output-to-string (out) (supergrip:write-transcript plan out)))

;;; What is typed

(defun eval-in-user (text)
  "Return the value of the form TEXT in SUPERGRIP-USER; no warning is printed."
  (let ((*package* (find-package :supergrip-user)) (*error-output* (make-broadcast-stream)))
    (eval (read-from-string text))))

(defmacro warning-texts (form)
  "Return the texts of the problems that FORM warns of."
  `(let ((texts '()))
     (handler-bind ((supergrip:knowledge-warning
                      (lambda (warning)
                        (dolist (problem (supergrip:knowledge-warning-problems warning))
                          (push (princ-to-string problem) texts))
                        (muffle-warning warning))))
       ,form)
     (reverse texts)))

;;; Boxes

(defun part-between (text start end)
  "Return the part of TEXT from START up to END."
  (let ((from (search start text)))
    (subseq text from (search end text :start2 from))))

(defun paper-form (start end &optional repairs)
  "Return the form of the paper's text that begins with START, END coming after it; REPAIRS are
pairs of what the scan has and what is read."
  (let ((text (part-between (file-text "t/paper-listings.txt") start end)))
    (loop for (from to) in repairs
          do (setf text (replace-once text from to)))
    (first (supergrip-data:read-all (supergrip-data:string-source text)))))

(defparameter *box-repairs*
  '(("(WEIGHT 0 2)" "(WEIGHT 0.2)") ("(u 0 8)" "(u 0.8)") ("(v 0 2)" "(v 0.2)"))
  "What the scan of the box has, and how it is read.")

(defun paper-box ()
  (paper-form "(SETQ BOX" "§" *box-repairs*))

(defparameter *good-box*
  '((:size 12 2 2) (:weight 0.2d0) (:u 0.8d0) (:v 0.2d0) (:constrained :z2 :x1)
    (:force-needed (1 0.8d0 0.8d0 0.3d0 1 1)) (:velocity-needed (0 0.8d0 0.8d0 0 0.8d0 0.8d0))))

(defparameter *pencil*
  "((SIZE 12 2 2) (WEIGHT 0.2) (u 0.8) (v 0.2) (CONSTRAINED Z2 X1)
 (FORCE-NEEDED (1 0.8 0.8 0.3 1 1)) (VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8)))")

(defparameter *json-pencil*
  "{\"size\": [12, 2, 2], \"weight\": 0.2, \"u\": 0.8, \"v\": 0.2, \"constrained\": [\"Z2\",
\"X1\"],
 \"force_needed\": [1, 0.8, 0.8, 0.3, 1, 1], \"velocity_needed\": [0, 0.8, 0.8, 0, 0.8, 0.8]}")

(defun changed-box (key &rest values)
  "Return the good box with other VALUES for KEY."
  (substitute-if (cons key values) (lambda (clause) (eq (first clause) key)) *good-box*))

(defun plan-box-too-heavy ()
  (supergrip:plan-box (plan-of '(20 10 5) 0.8d0 '(z2) :weight 11)))

;;; Plans

(defun pencil-plan () (supergrip:plan (paper-box)))

(defun plan-of (size u constrained &key (weight 0.05d0) (force '(1 1 1 0.5d0 0.5d0 0.5d0))
                                     (velocity '(0 0 0 0 0 0)))
  (supergrip:plan `((size ,@size) (weight ,weight) (u ,u) (v 0.2d0) (constrained ,@constrained)
                     (force-needed ,force) (velocity-needed ,velocity))))

(defun why-not-line (plan grasp &optional matching)
  (first (printed (supergrip:why-not grasp matching plan))))

(defun plan-figures (plan)
  (list (supergrip:plan-verdict plan) (supergrip:plan-reason plan)
        (supergrip:possible-grasps plan) (length (supergrip:plan-candidates plan))))

;;; Knowledge

(defmacro with-knowledge-restored (&body body)
  `(let ((supergrip:*knowledge* supergrip:*knowledge*))
     ,@body))

(defmacro with-session ((&optional (box '(paper-box))) &body body)
  "Run BODY with BOX as the current box, no plan yet, and edits taken back after it."
  `(with-knowledge-restored
     (let ((supergrip::*box* (supergrip:parse-box ,box)) (supergrip:*plan* nil))
       ,@body)))

(defun text-file (text name)
  "Return the data file that holds TEXT."
  (handler-case
      (multiple-value-bind (forms lines comments)
          (supergrip-data:read-all (supergrip-data:string-source text :name name) :loose-names t)
        (supergrip::make-data-file :name name :forms forms :lines lines :comments comments))
    (supergrip:syntax-error (condition)
      (supergrip::make-data-file :name name
                                 :problems (supergrip:input-error-problems condition)))))

(defun text-knowledge (rules grasps)
  "Return the knowledge in the texts RULES and GRASPS, and the list of all problems."
  (supergrip::build-knowledge (text-file rules "rules.lisp") (text-file grasps "grasps.lisp")))

(defun force-grasps (&optional (newtons 20))
  "Return the text of the shipped grasps with a gripper whose FINGER-FORCE is NEWTONS."
  (changed (file-text "grasps.lisp") "'(FINGER-LENGTH"
           (format nil "'(FINGER-FORCE ~a FINGER-LENGTH" newtons)))

(defun force-knowledge (&optional (newtons 20))
  "Return the shipped knowledge with a gripper whose FINGER-FORCE is NEWTONS."
  (values (text-knowledge (file-text "rules.lisp") (force-grasps newtons))))

(defun knowledge-reports (rules grasps)
  "Return the reports of errors in the texts RULES and GRASPS."
  (mapcar #'princ-to-string
          (supergrip-data:errors-in (nth-value 1 (text-knowledge rules grasps)))))

(defparameter *small-gripper*
  "(SETQ GRIPPER '(FINGER-LENGTH 3 FINGER-DIST 6 FINGER-SPREAD 2 FINGER-WIDTH 1 DIST-PINCH 12
                   WIDTH-HAND 8 SLIPPERY-U 0.1))")

(defun grasp-text (&rest changes)
  "Return the text of a grasp G, with CHANGES, a plist from key to text, NIL to leave it out."
  (format nil "(SETQ G '(~{~a ~a~%~}))"
          (loop for (key text) on '(:used-surfaces "(N1 N2 A2)" :conditions "(T)"
                                    :offset "(LIST 0 0 0 0 0 0)"
                                    :wrench "(1 (* 2 u) (* 2 u) (* 2 v) 1 1)" :twist "(1 1 1 1 1 1)"
                                    :contacts "((N1 0 0) (N2 0 0))" :palm "A2")
                by #'cddr
                for new = (getf changes key text)
                when new append (list key new))))

(defun grasp-reports (&rest changes)
  (knowledge-reports "(RULE R (IF (SLIPPERY)) (THEN (TRY G)))"
                     (format nil "~a~%~a" *small-gripper* (apply #'grasp-text changes))))

(defparameter *good-rules*
  "(RULE OBVIOUS
  (IF (SMALL (s1 s2))
      (CONSTRAINED (s1)))
  (THEN (CANT GRASP IT)))
(RULE FIND
  (IF (OPPOSED (s1 s2))
      (NOT CONSTRAINED (s1))
      (NOT CONSTRAINED (s2)))
  (THEN (REMEMBER PARALLEL (s1 s2))
        (REMEMBER OBJECT HAS PARALLEL SURFACES)))
(RULE ACROSS
  (IF (PARALLEL (s1 s2)))
  (THEN (TRY G (s1 s2 ? ? ? ?))))
(RULE END
  (IF (OBJECT HAS PARALLEL SURFACES))
  (THEN (KEEP BEST)))
")

(defparameter *good-grasps*
  "(SETQ GRIPPER
  '(FINGER-LENGTH 3 FINGER-DIST 6 FINGER-SPREAD 2
    FINGER-WIDTH 1 DIST-PINCH 12 WIDTH-HAND 8 SLIPPERY-U 0.1))
(DEFUN HALF (x)
  (/ x 2))
(SETQ G
  '(USED-SURFACES (N1 N2 A2)
    CONDITIONS ((DIST '(N1 N2)) < DIST-PINCH)
    OFFSET (LIST 0 0 0 0 0 0)
    WRENCH (1 (* 2 u) (* 2 u)
            (* 2 v)
            (* u (DIST '(N1 N2)))
            (* u (DIST '(N1 N2))))
    TWIST (1 1 1 1 1 1)
    CONTACTS ((N1 0 0) (N2 0 0))
    PALM A2))
")

(defun rule-total () (length (supergrip:knowledge-rules supergrip:*knowledge*)))

(defun grasp-total () (length (supergrip:knowledge-grasps supergrip:*knowledge*)))

(defparameter *shipped-grasps*
  '("PINCH-2-PARALLEL" "PINCH-3-PARALLEL" "PINCH-3-U-SHAPE" "PINCH-3-C-SHAPE" "PINCH-2-ADJACENT"
    "PINCH-3-ADJACENT" "PINCH-3-CORNER")
  "The names of the seven grasps: who runs the tests may have added others.")

(defun shipped-grasps ()
  (remove-if-not (lambda (grasp)
                   (member (supergrip:grasp-name grasp) *shipped-grasps* :test #'string=))
                 (supergrip:knowledge-grasps supergrip:*knowledge*)))

(defun shipped-rules ()
  "Return the rules that are shipped, in the order of the file, without what a user has added."
  (let ((text (file-text "rules.lisp")))
    (remove-if-not (lambda (rule)
                     (search (format nil "(RULE ~a~%" (supergrip-chainer:rule-name rule)) text))
                   (supergrip:knowledge-rules supergrip:*knowledge*))))

(defun same-form-p (a b)
  (equal (supergrip-data:form-text a) (supergrip-data:form-text b)))

(defun shipped-form (file kind name)
  (find-if (lambda (form) (and (supergrip-data:name= (first form) kind)
                               (supergrip-data:name= (second form) name)))
           (supergrip-data:read-all
            (supergrip-data:string-source (file-text file)))))

;;; Random boxes, which can be had again from their seed

(defun random-between (low high state)
  "Return a double between LOW and HIGH, all magnitudes alike."
  (let ((number (exp (+ (log low) (random (log (/ high low)) state)))))
    (max low (min high number))))

(defun random-need (state)
  "Return six needs from 0 to 1, about a third of them 0."
  (loop repeat 6 collect (if (zerop (random 3 state)) 0 (/ (random 1001 state) 1000d0))))

(defun random-faces (state)
  "Return a random set of faces, each of the 64 sets alike."
  (let ((set (random 64 state)))
    (loop for face in '(x1 x2 y1 y2 z1 z2)
          for place from 0
          when (logbitp place set) collect face)))

(defun random-box (state &key (weight t))
  "Return the description of a box of 0.1 to 100 cm with any constraints and a random task.
Half of the boxes are of a size that a hand can hold."
  (let ((most (if (zerop (random 2 state)) 100d0 15d0))
        (force (random-need state))
        (velocity (random-need state)))
    (when (and (every #'zerop force) (every #'zerop velocity))
      (setf (first force) 1))
    `((size ,@(loop repeat 3 collect (random-between 0.1d0 most state)))
      (weight ,(if (and weight (plusp (random 4 state))) (random-between 0.01d0 3d0 state) 0))
      (u ,(random 2d0 state))
      (v ,(if (zerop (random 8 state)) 0 (random 0.5d0 state)))
      (constrained ,@(random-faces state))
      (force-needed ,force)
      (velocity-needed ,velocity))))

(defun random-facts (declared state)
  "Return random facts of one's own of the predicates DECLARED, a list of (NAME ARITY), in any
order."
  (shuffle (loop for (name arity) in declared
                 append (if (zerop arity)
                            (when (chance 50 state) (list (list name)))
                            (loop for faces in (remove-duplicates
                                                (loop repeat (random 5 state)
                                                      collect (subseq (shuffle '(x1 x2 y1 y2 z1 z2)
                                                                               state)
                                                                      0 arity))
                                                :test (lambda (a b)
                                                        (null (set-exclusive-or a b))))
                                  collect (list name faces))))
           state))

(defmacro for-random-boxes ((box count seed &rest keys) &body body)
  "Run BODY with BOX bound to COUNT random boxes.  The seed is printed, and chooses them."
  (let ((state (gensym "STATE")))
    `(let ((,state (sb-ext:seed-random-state ,seed)))
       (format t "~&   ~d random boxes, seed ~d~%" ,count ,seed)
       (dotimes (i ,count)
         (let ((,box (random-box ,state ,@keys)))
           ,@body)))))

(defun random-boxes (count seed &rest keys)
  (let ((boxes '()))
    (for-random-boxes (box count seed :weight (getf keys :weight t))
      (push box boxes))
    boxes))

(defun extreme-box (state)
  "Return the description of a box whose numbers are of any size that may be."
  (flet ((extreme (most) (* (expt 10d0 (- (random (* 2 most) state) most)) (+ 1 (random 9 state)))))
    (let ((most (expt 10 (random 3 state))))
      `((size ,@(loop repeat 3 collect (extreme (if (= most 100) 299 most))))
        (weight ,(extreme most)) (u ,(extreme most)) (v ,(extreme (if (= most 100) 299 most)))
        (constrained ,@(loop for face in '(x1 y1 z2) when (zerop (random 4 state)) collect face))
        (force-needed (1 1 1 1 1 ,(random 1d0 state)))
        (velocity-needed (1 1 1 1 1 ,(expt 10d0 (- (random 299 state)))))))))

(defun box-part (box key)
  "Return what the description BOX gives for KEY."
  (rest (assoc key box)))

(defun close-to (a b &optional (tolerance 1d-9))
  "True if A and B, numbers or lists of numbers, are equal within TOLERANCE, relative to 1 or more."
  (cond ((and (null a) (null b)) t)
        ((and (consp a) (consp b))
         (and (= (length a) (length b)) (every (lambda (x y) (close-to x y tolerance)) a b)))
        ((and (realp a) (realp b))
         (<= (abs (- a b)) (* tolerance (max 1 (abs a) (abs b)))))))

(defun first-fault (fault boxes)
  "Return the first of BOXES for which the function FAULT returns true, and what it returned."
  (dolist (box boxes)
    (let ((found (funcall fault box)))
      (when found
        (return (list box found))))))

;;; Random forms of grasps

(defun random-element (list state)
  (nth (random (length list) state) list))

(defun chance (percent state)
  (< (random 100 state) percent))

(defun random-form (depth variables helpers state)
  "Return a form that gives a number.  HELPERS are (NAME PARAMETERS)."
  (labels ((form () (random-form (1- depth) variables helpers state))
           (choice () (random-test (1- depth) variables helpers state)))
    (if (or (zerop depth) (chance 15 state))
        (random-element `(0 1 2 1/2 3/4 (dist '(n1 n2)) (dist '(o1 o2)) (dist '(a1 a2)) ,@variables)
                        state)
        (ecase (random 12 state)
          ((0 1 2) (list (random-element '(+ - * max min) state) (form) (form)))
          (3 (list '/ (form) (form)))
          (4 (list (random-element '(posit abs - sqrt) state) (form)))
          (5 `(expt ,(form) ,(random-element '(2 3 1/2 -1) state)))
          ((6 7) `(cond ,@(loop repeat (1+ (random 2 state)) collect (list (choice) (form)))
                        (t ,(form))))
          (8 `(if ,(choice) ,(form) ,(form)))
          ((9 10) (let ((name (random-element '(p q r) state)))
                    `(,(random-element '(let let*) state) ((,name ,(form)))
                      ,(random-form (1- depth) (adjoin name variables) helpers state))))
          (11 (if helpers
                  (destructuring-bind (name parameters) (random-element helpers state)
                    (cons name (loop repeat (length parameters) collect (form))))
                  (form)))))))

(defun random-test (depth variables helpers state)
  "Return a form that is true or false."
  (flet ((form () (random-form (max 0 (1- depth)) variables helpers state))
         (choice () (random-test (1- depth) variables helpers state)))
    (if (or (plusp depth) (chance 50 state))
        (ecase (random 6 state)
          ((0 1 2) (list (random-element '(< <= > >=) state) (form) (form)))
          (3 `(constrained ',(random-element '(n1 o1 o2 a1) state)))
          (4 (if (plusp depth)
                 (list* (random-element '(and or) state) (loop repeat 2 collect (choice)))
                 t))
          (5 (if (plusp depth) `(not ,(choice)) '(not (= u u)))))
        t)))

(defun random-six (state variables helpers)
  "Return a form that gives six numbers, most of them above 0."
  (flet ((entries ()
           (loop repeat 6
                 for form = (random-form 4 variables helpers state)
                 collect (if (chance 90 state) `(max 1/8 ,form) form))))
    (ecase (random 3 state)
      (0 (entries))
      (1 `(cond (,(random-test 2 variables helpers state) (list ,@(entries)))
                (t (list ,@(entries)))))
      (2 `(let* ((s ,(random-form 3 variables helpers state)))
            (if ,(random-test 2 (cons 's variables) helpers state)
                (list ,@(entries))
                (list s ,@(rest (entries)))))))))

(defun random-helpers (state)
  "Return the forms of a few helpers; each may call those before it."
  (let ((helpers '()))
    (loop for name in '(h1 h2 h3)
          for parameters in '((x) (x y) (x y z))
          collect `(defun ,name ,parameters
                     ,(random-form 3 (append parameters '(u v)) helpers state))
          do (push (list name parameters) helpers))))

(defun random-grasp-forms (state)
  "Return the forms of a grasp file: the shipped gripper, helpers, and a random grasp G."
  (let* ((helper-forms (random-helpers state))
         (helpers (mapcar (lambda (form) (list (second form) (third form))) helper-forms))
         (variables '(u v finger-length finger-width)))
    (flet ((form (depth) (random-form depth variables helpers state)))
      `((setq gripper '(finger-length 3 finger-dist 6 finger-spread 2 finger-width 1 dist-pinch 12
                        width-hand 8 slippery-u 1/10))
        ,@helper-forms
        (setq g '(used-surfaces (n1 n2 a2)
                  conditions ((or ,(random-test 3 variables helpers state)
                                  (or ,(random-test 3 variables helpers state) (> u 1))))
                  offset (let* ((f (min 1/8 (abs ,(form 3))))) (list 0 0 0 0 (- f) f))
                  wrench ,(random-six state variables helpers)
                  twist ,(loop repeat 6 collect `(max 0 (min 1 ,(form 2))))
                  contacts ((n1 (min 1/4 ,(form 2)) 0) (n2 0 0))
                  palm a2))))))

(defparameter *try-g* '((rule only (if (opposed (s1 s2))) (then (try g) (keep best)))))

(defun knowledge-of-grasps (forms)
  "Return the knowledge of the grasp FORMS and of one rule, or NIL if a form has no value."
  (flet ((file (forms name)
           (text-file (with-standard-io-syntax (format nil "~{~:a~%~}" forms)) name)))
    (multiple-value-bind (knowledge problems)
        (supergrip::build-knowledge (file *try-g* "rules") (file forms "grasps"))
      (if (supergrip-data:errors-in problems)
          (is (every (lambda (problem) (search "no value" (princ-to-string problem)))
                     (supergrip-data:errors-in problems))
              "~{~a~%~}" problems)
          knowledge))))

(defun with-entries (box &rest entries)
  "Return the description BOX with ENTRIES, a plist, in the place of its own."
  (loop for entry in box
        collect (let ((new (getf entries (first entry))))
                  (if new (cons (first entry) new) entry))))

(defun random-size (low high state)
  (loop repeat 3 collect (random-between low high state)))

(defun table-box (state)
  "Return the description of a random box of 1 to 15 cm, light, on a table."
  (with-entries (random-box state) 'size (random-size 1d0 15d0 state)
                'weight (list (random 0.5d0 state)) 'u (list (+ 0.3d0 (random 0.7d0 state)))
                'constrained '(z2)))

(defun household-box (state)
  "Return the description of a random box of 0.05 to 40 cm, light, with one to three faces blocked."
  (with-entries (random-box state) 'size (random-size 0.05d0 40d0 state)
                'weight (list (random 0.5d0 state)) 'u (list (+ 0.2d0 (random 0.9d0 state)))
                'constrained (case (random 3 state) (0 '(z2)) (1 '(z2 x1)) (t '(z2 x1 y2)))))

(defun rubber-box (state)
  "Return the description of a random box of 3 to 30 cm with u > 1, so that adjacent grasps close."
  (with-entries (random-box state) 'size (random-size 3d0 30d0 state)
                'weight (list (random 0.3d0 state)) 'u (list (+ 1 (random 0.7d0 state)))))

;;; Every grasp in every matching

(defparameter *everything-rules*
  "(RULE EVERYTHING
  (IF (OPPOSED (s1 s2)))
  (THEN (TRY PINCH-2-PARALLEL) (TRY PINCH-3-PARALLEL) (TRY PINCH-3-U-SHAPE) (TRY PINCH-3-C-SHAPE)
        (TRY PINCH-2-ADJACENT) (TRY PINCH-3-ADJACENT) (TRY PINCH-3-CORNER) (KEEP BEST)))"
  "One rule, in the place of the fifteen, that leaves nothing out.")

(defun with-wide-faces (grasps)
  "Return GRASPS, a text, with faces as wide in PINCH-2-PARALLEL as in the other grasps."
  (let ((printed "CONDITIONS (((DIST '(N1 N2)) < DIST-PINCH) AND
                ((DIST '(O1 O2)) > WIDTH-HAND)"))
    (replace-once grasps printed
                  (replace-once printed " AND" " AND
                ((DIST '(O1 O2)) >= FINGER-WIDTH) AND ((DIST '(A1 A2)) >= FINGER-WIDTH) AND"))))

(defun everything-knowledge (&optional (grasps (file-text "grasps.lisp")))
  "Return the knowledge that tries every grasp of GRASPS, a text, in every matching."
  (text-knowledge *everything-rules* grasps))

;;; The oracle's plan beside ours

(defparameter *oracle*
  (supergrip-oracle:load-oracle-knowledge (project-file "rules.lisp") (project-file "grasps.lisp")))

(defun log-facts (plan)
  "Return what the rules of PLAN remembered, as the oracle has it."
  (let ((rulebase (supergrip:knowledge-rulebase (supergrip:plan-knowledge plan))))
    (loop for event in (supergrip:plan-log plan)
          unless (supergrip::candidate-p event)
            collect (multiple-value-bind (predicate face-list)
                        (supergrip-chainer:event-fact event rulebase)
                      (cons (supergrip-chainer:rule-name
                             (supergrip-chainer:event-rule event rulebase))
                            (append (supergrip-chainer:predicate-words predicate)
                                    (let ((names (supergrip-chainer:face-list-names face-list)))
                                      (and names (list names)))))))))

(defun candidate-difference (candidate plan oracle)
  "Return what of CANDIDATE differs from ORACLE, a plist, or NIL."
  (flet ((differs (what ours theirs)
           (unless (close-to ours theirs)
             (return-from candidate-difference
               (format nil "~a ~a ~a ~a: ~a, by the definitions ~a" (getf oracle :grasp)
                       (getf oracle :matching) (getf oracle :outcome) what ours theirs)))))
    (unless (and (equal (supergrip:candidate-grasp candidate) (getf oracle :grasp))
                 (equal (supergrip:candidate-matching candidate) (getf oracle :matching))
                 (eq (supergrip:candidate-outcome candidate) (getf oracle :outcome)))
      (return-from candidate-difference
        (format nil "~a ~a, by the definitions ~a" candidate
                (supergrip:candidate-outcome candidate) oracle)))
    (when (eq :possible (getf oracle :outcome))
      (differs "Q" (supergrip:candidate-quality candidate) (getf oracle :q))
      (differs "u_w" (supergrip:candidate-force-radius candidate) (getf oracle :u-w))
      (differs "u_t" (supergrip:candidate-velocity-radius candidate) (getf oracle :u-t))
      (differs "offset" (supergrip:candidate-offset candidate) (getf oracle :offset))
      (differs "wrench" (supergrip:candidate-wrench candidate plan) (getf oracle :wrench))
      (differs "twist" (supergrip:candidate-twist candidate plan) (getf oracle :twist))
      (loop for contact in (supergrip:candidate-contacts candidate plan)
            for (position face) in (getf oracle :contacts)
            do (differs "contact" (getf contact :position) position)
               (unless (equal face (getf contact :surface))
                 (return-from candidate-difference "a contact on another face"))))
    nil))

(defun plan-difference (box &optional (knowledge supergrip:*knowledge*) (definitions *oracle*))
  "Return what of the plan for BOX by KNOWLEDGE differs from the DEFINITIONS, or NIL."
  (let* ((plan (supergrip:plan box :knowledge knowledge))
         (oracle (supergrip-oracle:oracle-plan box definitions))
         (best (getf oracle :best))
         (candidates (supergrip:plan-candidates plan)))
    (cond ((not (eq (supergrip:plan-verdict plan) (getf oracle :verdict))) "the verdict")
          ((not (equal (log-facts plan) (getf oracle :log))) "the log")
          ((/= (length candidates) (length (getf oracle :candidates))) "how many were tried")
          ((and best (not (and (equal (getf best :grasp) (supergrip:plan-grasp plan))
                               (equal (getf best :matching) (supergrip:plan-matching plan)))))
           "the best")
          (t (loop for candidate in candidates
                   for theirs in (getf oracle :candidates)
                   thereis (candidate-difference candidate plan theirs))))))

;;; The executable

(defvar *program* nil "The executable that the tests have made, in a directory of its own.")

(defun program ()
  "Return the name of the executable, made when it is first asked for."
  (or *program*
      (let ((file (format nil "~asupergrip-test-~36r/supergrip"
                          (uiop:native-namestring (uiop:temporary-directory))
                          (random (expt 36 8) (make-random-state t)))))
        (multiple-value-bind (status output errors)
            (run-process (append (script "src/build.lisp") (list file)))
          (unless (eql status 0)
            (error "the executable can't be made: ~a~a" output errors)))
        (setf *program* file))))

(defun remove-program ()
  (when *program*
    (uiop:delete-directory-tree (uiop:pathname-directory-pathname *program*) :validate t)
    (setf *program* nil)))

(pushnew 'remove-program sb-ext:*exit-hooks*)

(defun run-on (text command)
  "Run COMMAND with TEXT on its standard input.  Return its status, output and errors."
  (uiop:with-temporary-file (:stream out :pathname file :element-type '(unsigned-byte 8))
    (write-sequence (octets text) out)
    :close-stream
    (run-process (list* "timeout" "60" command) :input file)))

(defun answers (text &rest options)
  "Let the executable answer the boxes of TEXT.  Return its records, status and errors."
  (multiple-value-bind (status output errors)
      (run-on text (list* (program) "--format" "json" options))
    (values (mapcar #'json-record (lines-of output)) status errors)))

(defun statuses (records)
  "Return the status of each of RECORDS; where it is error, the reason."
  (loop for record in records
        collect (if (equal (getf record :status) "error")
                    (getf record :reason)
                    (getf record :status))))

(defun json-record (line)
  "Return LINE, a record in JSON, as a plist such as PLAN-RECORD makes."
  (labels ((plist (value)
             (cond ((supergrip::json-object-p value)
                    (loop for (key . member) in (supergrip::json-object-members value)
                          collect (intern (string-upcase (substitute #\- #\_ key)) :keyword)
                          collect (plist member)))
                   ((supergrip::json-array-p value)
                    (mapcar #'plist (supergrip::json-array-elements value)))
                   ((supergrip::json-literal-p value)
                    (cdr (assoc (supergrip::json-literal-text value)
                                '(("true" . t) ("false" . :false)) :test #'string=)))
                   (t value))))
    (plist (supergrip::read-json (supergrip-data:string-source line)))))

(defun lisp-record (line)
  (let ((*read-eval* nil)) (read-from-string line)))

;;; Rotations

(defun quaternion-inverse (quaternion)
  "Return the quaternion of the opposite rotation of QUATERNION, a unit quaternion."
  (destructuring-bind (x y z w) quaternion
    (list (- 0d0 x) (- 0d0 y) (- 0d0 z) w)))

;;; What contacts can really do

(defun candidate-case (candidate plan need)
  "Return the case of CANDIDATE, a possible one of PLAN, with the task NEED: (contacts u v need
gravity), what the functions of statics are asked with."
  (let ((box (supergrip:plan-box plan)))
    (list (loop for contact in (supergrip:candidate-contacts candidate plan)
                collect (list (getf contact :position) (getf contact :normal)))
          (supergrip:box-friction box) (supergrip:box-soft-friction box) need
          (supergrip:box-gravity box))))

(defun exact-radius-of (case &rest keys)
  "Return what EXACT-RADIUS says of CASE, KEYS being its keys."
  (destructuring-bind (contacts u v need gravity &rest rest) case
    (declare (ignore rest))
    (apply #'supergrip:exact-radius contacts u v need :gravity gravity keys)))
