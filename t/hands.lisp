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
    (is (equal "CANT GRASP NO FREE PAIR OF FACES FITS INTO THE JAW"
               (supergrip:plan-reason (supergrip:plan (changed-box :size 20 10 10)
                                                      :knowledge knowledge))))))

(test a-hand-is-checked-from-the-command-line
  (multiple-value-bind (status output errors)
      (run-on "" (list (program) "--check" "--hand" (hand-path "robotiq-2f-85")))
    (is (eql 0 status))
    (is (equal "" output))
    (is (search "(Robotiq 2F-85), no mistakes" errors))))
