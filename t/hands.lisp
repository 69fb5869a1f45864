;;;; hands.lisp -- the hands of examples/hands/: they load, say where each number is from, and
;;;; grasp.

(in-package :supergrip-test)
(define-suite hands
  "The hands of examples/hands/: they load, say where each number is from, and grasp.")

(defparameter *hands*
  '((:gripper "paper.lisp") (:gripper "robotiq-3-finger.lisp") (:gripper "barrett-bh8-282.lisp")
    (:hand "robotiq-2f-85"))
  "The arguments of LOAD-KNOWLEDGE for each hand.")

(defun hand-path (name)
  (uiop:native-namestring (project-file (format nil "examples/hands/~a" name))))

(defun hand-knowledge (hand)
  (supergrip:load-knowledge (first hand) (hand-path (second hand))))

(defun hand-gripper-text (hand)
  (file-text (format nil "examples/hands/~a~@[/gripper.lisp~]" (second hand)
                     (eq (first hand) :hand))))

(test every-hand-of-the-folder-is-tested
  (is (equal (sort (mapcar #'second *hands*) #'string<)
             (sort (append (mapcar #'file-namestring
                                   (uiop:directory-files (project-file "examples/hands/")))
                           (loop for folder
                                 in (uiop:subdirectories (project-file "examples/hands/"))
                                 collect (first (last (pathname-directory folder)))))
                   #'string<))))

(test hands-load-without-warnings
  (dolist (hand *hands*)
    (is (null (warning-texts (hand-knowledge hand))) "~a" hand)
    (is (stringp (supergrip:knowledge-model (hand-knowledge hand))))))

(test every-number-of-a-hand-has-a-source
  (dolist (hand *hands*)
    (let ((lines (lines-of (hand-gripper-text hand))))
      (loop for (name) in (supergrip:knowledge-gripper (hand-knowledge hand))
            for line
            = (find-if (lambda (line) (eql 0 (search name (string-left-trim " " line)))) lines)
            for source = (subseq line (position #\; line))
            do (is (some (lambda (mark) (search mark source))
                         '("[M]" "[U]" "[D]" "[J]" "chosen:" "derived:" "grasps.lisp"))
                   "~a: ~a" hand line)))))

(test the-papers-hand-is-the-shipped-one
  (is (equal (supergrip:knowledge-gripper
              (supergrip:load-knowledge :gripper (hand-path "paper.lisp")))
             (append (butlast (supergrip:knowledge-gripper
                               (supergrip:load-knowledge :gripper (hand-path "paper.lisp")))
                              2)
                     '(("FINGER-FORCE" . 20d0) ("PALM-DEPTH" . 6.4d0)))))
  (loop for (name . number) in (supergrip:knowledge-gripper
                                (supergrip:load-knowledge :gripper (hand-path "paper.lisp")))
        for shipped = (getf (second (third (shipped-form "grasps.lisp" "SETQ" "GRIPPER")))
                            (find-symbol name :keyword))
        when shipped do (is (= number shipped) name)))

(defun hand-plan (hand size &key (constrained '(z2)))
  "Return the plan for a light box of SIZE on a table, lifted by HAND without any turning."
  (supergrip:plan `((size ,@size) (weight 0.05d0) (u 0.6d0) (v 0.3d0) (constrained ,@constrained)
                    (force-needed (0.1d0 0.1d0 0.1d0 0 0 0)) (velocity-needed (0 0 0 0 0 0)))
                  :knowledge (hand-knowledge hand)))

(test hands-grasp-what-they-span-and-nothing-else
  (dolist (hand *hands*)
    (let ((opening (cdr (assoc "DIST-PINCH" (supergrip:knowledge-gripper (hand-knowledge hand))
                               :test #'string=))))
      (flet ((width (plan)
               "How far apart the fingers of the best grasp are."
               (let ((contact (first (supergrip:candidate-contacts (supergrip:plan-best plan)
                                                                   plan))))
                 (elt (supergrip:box-size (supergrip:plan-box plan))
                      (position (char (getf contact :surface) 0) "XYZ")))))
        (is (= 3 (width (hand-plan hand '(20 3 10)))) "~a: across the thin side" hand)
        (is (<= (width (hand-plan hand (list 40 (- opening 0.5d0) 10))) opening) "~a" hand)
        (is (null (supergrip:plan-best (hand-plan hand (list 40 (+ opening 0.5d0) 40)))) "~a" hand)
        (is (null (supergrip:plan-best (hand-plan hand '(20 10 0.1d0)))) "~a: a card on a table"
            hand)
        (is (null (supergrip:plan-best (hand-plan hand '(20 3 10) :constrained '(x1 x2 y1 y2 z2))))
            "~a: in a slot" hand)))))

(test the-jaws-rules-are-verified
  (let* ((knowledge (hand-knowledge '(:hand "robotiq-2f-85")))
         (verification (supergrip:verify-knowledge knowledge :stream nil)))
    (is (equal '("JAW-PINCH")
               (mapcar #'supergrip:grasp-name (supergrip:knowledge-grasps knowledge))))
    ;; Their order matters, as it should.  What is slippery is refused, though a grasp may be
    ;; possible: so does the shipped GRIP2.
    (loop for finding in (remove :order (supergrip:verification-findings verification)
                                 :key #'supergrip:finding-kind)
          do (is (equal "SMOOTH" (supergrip:finding-rule finding)) "~a" finding))
    (loop for use in (supergrip:verification-rules verification)
          do (is (plusp (supergrip:rule-use-matters use)) (supergrip:rule-use-name use)))
    (is (equal "CANT GRASP NO FREE PAIR OF FACES FITS INTO THE JAW: Y1 and Y2 are 10 cm apart, no less than DIST-PINCH, 8.5"
               (supergrip:plan-reason (supergrip:plan (changed-box :size 20 10 10)
                                                      :knowledge knowledge))))))

(test a-hand-is-checked-from-the-command-line
  (multiple-value-bind (status output errors)
      (run-on "" (list (program) "--check" "--hand" (hand-path "robotiq-2f-85")))
    (is (eql 0 status))
    (is (equal "" output))
    (is (search "(Robotiq 2F-85), no mistakes" errors))))

;;; Every question, option and format, for every hand

(defparameter *bare-jaw-rules*
  "(RULE SIDES
  (IF (OPPOSED (s1 s2)) (NOT CONSTRAINED (s1)) (NOT CONSTRAINED (s2)))
  (THEN (TRY JAW (s1 s2 ? ? ? ?))))")

(defun bare-jaw (gripper opening &optional computed)
  "Return the knowledge of a jaw with GRIPPER, the text of its dimensions, that opens to OPENING; its
WRENCH is a formula, or COMPUTED."
  (values (text-knowledge
           *bare-jaw-rules*
           (format nil "(SETQ GRIPPER '(MODEL \"jaw\" ~a))
(SETQ JAW '(USED-SURFACES (N1 N2 A2) CONDITIONS ((DIST '(N1 N2)) < ~a)
  ~:[OFFSET (0 0 0 0 0 0) WRENCH (1 (* 2 u) (* 2 u) (* 2 v) 1 1)~;REACH (A 4)~]
  TWIST (1 1 1 1 1 1) CONTACTS ((N1 0 0) (N2 0 0)) PALM A2))" gripper opening computed))))

(defun jaw-without (&rest names)
  "Return the knowledge of the jaw of the folder, without its dimensions NAMES, and of its grasp
without what uses them."
  (flet ((text (file) (file-text (format nil "examples/hands/robotiq-2f-85/~a.lisp" file))))
    (let ((gripper (lines-of (text "gripper"))))
      (supergrip::build-knowledge
       (text-file (text "rules") "rules.lisp") (text-file (text "grasps") "grasps.lisp")
       (text-file (format nil "~{~a~%~}"
                          (loop for line in gripper
                                collect (if (some (lambda (name) (search (format nil " ~a " name) line))
                                                  names)
                                            (if (search "))" line) "))" "")
                                            line)))
                  "gripper.lisp")))))

(defun every-hand ()
  "Return an alist from names to knowledge: the hands of the folder, the second knowledge base, and jaws
that name few dimensions or none."
  `(,@(loop for hand in *hands* collect (cons (second hand) (hand-knowledge hand)))
    ("further-work" . ,(further-work))
    ("without palm and force" . ,(jaw-without "PALM-DEPTH" "FINGER-FORCE"))
    ("nothing" . ,(bare-jaw "" 8)) ("nothing, computed" . ,(bare-jaw "" 8 t))
    ("an opening" . ,(bare-jaw "DIST-PINCH 8" "DIST-PINCH"))
    ("an opening, computed" . ,(bare-jaw "DIST-PINCH 8 FINGER-FORCE 20" "DIST-PINCH" t))))

(defun tried-box (size u &rest clauses)
  `((size ,@size) (weight 0.2d0) (u ,u) (v 0.2d0) (constrained z2) (force-needed (1 0.8d0 0.8d0 0.3d0 1 1))
    (velocity-needed (0 0.8d0 0.8d0 0 0.8d0 0.8d0)) ,@clauses))

(defparameter *tried-boxes*
  (list (tried-box '(12 2 2) 0.8d0) (tried-box '(40 40 40) 0.8d0)
        (tried-box '(60 40 50) 0.05d0 '(units mm finger) '(pose (1 2 3) (0 0 0 1))))
  "A box that all hands hold, one that is too large for them, and one that is slippery, in mm.")

(defun fault-in (function)
  "Call FUNCTION and return the error that it signals, unless it is one of ours; else NIL."
  (handler-case (let ((*standard-output* (make-broadcast-stream))) (funcall function) nil)
    (supergrip:supergrip-error () nil)
    (error (condition) (princ-to-string condition))))

(defmacro answered (name &body body)
  "Check that BODY gives an answer, or an error of ours, for the hand NAME."
  `(let ((fault (fault-in (lambda () ,@body))))
     (is (null fault) "~a: ~s: ~a" ,name ',(first body) fault)))

(test every-question-about-a-hand-is-answered
  (loop for (name . knowledge) in (every-hand)
        for shipped = supergrip:*knowledge*
        do (let ((supergrip:*knowledge* knowledge))
             (answered name (supergrip:describe-gripper))
             (answered name (supergrip:compare-knowledge shipped knowledge *tried-boxes*))
             (dolist (grasp (supergrip:knowledge-grasps knowledge))
               (answered name (supergrip:describe-grasp grasp)))
             (dolist (rule (supergrip:knowledge-rules knowledge))
               (answered name (supergrip:describe-rule rule))))))

(test every-question-about-a-plan-is-answered-for-every-hand
  (loop for (name . knowledge) in (every-hand)
        do (dolist (box *tried-boxes*)
             (let ((plan (supergrip:plan box :knowledge knowledge))
                   (exact (supergrip:plan box :knowledge knowledge :index :exact)))
               (answered name (supergrip:explain-best plan))
               (answered name (supergrip:explain-best exact))
               (answered name (supergrip:explain-refinement plan :count 1 :regions 20))
               (answered name (supergrip:how '(constrained (z2)) plan))
               (answered name (supergrip:how '(opposed (y2 y1)) plan))
               (dolist (grasp (supergrip:knowledge-grasps knowledge))
                 (answered name (supergrip:why-not grasp plan))
                 (answered name (supergrip:why-not grasp exact)))
               (dolist (rule (supergrip:knowledge-rules knowledge))
                 (answered name (supergrip:why-not rule plan)))
               (let ((grasp (first (last (supergrip:knowledge-grasps knowledge)))))
                 (answered name (supergrip:requires grasp plan)))))))

(test every-record-and-format-is-written-for-every-hand
  (loop for (name . knowledge) in (every-hand)
        do (dolist (box *tried-boxes*)
             (dolist (index '(:paper :exact))
               (let ((plan (supergrip:plan box :knowledge knowledge :index index)))
                 (answered name (json-line (supergrip::plan-record plan :all 3)))
                 (answered name (lisp-line (supergrip::plan-record plan :all 3)))
                 (dolist (writer supergrip::*writers*)
                   (answered name (supergrip::written-plan writer plan nil)))
                 (when (supergrip:plan-best plan)
                   (answered name (supergrip::mjcf-text plan)))))))
  (loop for (name . knowledge) in (every-hand)
        for plan = (supergrip:plan (first *tried-boxes*) :knowledge knowledge)
        do (answered name (json-line (supergrip::plan-record plan :refine t)))))

(test what-a-jaw-does-not-name-does-not-part-its-fingers
  "Pads that stand opposite each other stay so."
  (let* ((plan (supergrip:plan (first *tried-boxes*)
                               :knowledge (hand-knowledge '(:hand "robotiq-2f-85"))))
         (places (mapcar (lambda (contact) (getf contact :position))
                         (supergrip:refinement-contacts (supergrip:refine plan)))))
    (is (= 2 (length places)))
    (is (close-to (first (first places)) (first (second places))))
    (is (close-to (third (first places)) (third (second places))))))
