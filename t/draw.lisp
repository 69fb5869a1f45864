;;;; draw.lisp -- pictures and reports: well-formed, to scale, inside their canvas, and escaped.

(in-package :supergrip-test)
(define-suite draw "Pictures and reports: well-formed, to scale, inside their canvas, and escaped.")

;;; All pictures of a test are written into one folder, and parsed in one go, by Python's parser.

(defmacro with-folder ((folder) &body body)
  "Run BODY with FOLDER bound to an empty folder that is removed afterwards."
  `(uiop:with-temporary-file (:pathname file)
     (let ((,folder (uiop:ensure-directory-pathname
                     (format nil "~a-pictures" (uiop:native-namestring file)))))
       (ensure-directories-exist ,folder)
       (unwind-protect (progn ,@body)
         (uiop:delete-directory-tree ,folder :validate t)))))

(defun parsed (folder)
  "Return what draw-check.py finds in FOLDER: for each file its name, complaints and views."
  (let ((lines (lines-of (uiop:run-program
                          (list "python3" (uiop:native-namestring (project-file "t/draw-check.py"))
                                (uiop:native-namestring folder))
                          :output :string)))
        (*read-eval* nil))
    (mapcar #'read-from-string lines)))

(defun in-folder (folder control &rest arguments)
  (merge-pathnames (apply #'format nil control arguments) folder))

(defun example-boxes ()
  "Return an alist from name to description of the boxes of the examples."
  (loop for file in (uiop:directory-files (project-file "examples/") "*.lisp")
        for box = (with-open-file (in file)
                    (let ((*package* (find-package :supergrip-user)) (*read-eval* nil))
                      (loop for form = (ignore-errors (read in nil))
                            while form
                            when (and (consp form) (symbolp (first form))
                                      (string= (first form) "SETQ")
                                       (string= (second form) "BOX"))
                              return (second (third form)))))
        when box collect (cons (pathname-name file) box)))

(defparameter *extreme-boxes*
  (flet ((box (&rest size)
           `((size ,@size) (weight 0.01) (u 0.8) (v 0.2) (constrained z2)
             (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1)))))
    `(("pole" . ,(box 200 3 3)) ("cube" . ,(box 1 1 1)) ("card" . ,(box 8.6 5.4 0.8))
      ("plate" . ,(box 300 300 1)) ("column" . ,(box 4 4 500)) ("house" . ,(box 1000 800 600))
      ("grain" . ,(box 0.01 0.01 0.01)) ("wire" . ,(box 1d5 0.7 0.7)))))

;;; An independent projection: turn the box about Z by the azimuth, then tip it by the elevation.

(defun seen-at (position azimuth elevation scale x y)
  "Return where POSITION is seen in a view whose box centre is at X Y."
  (let* ((turn (* (- -90 azimuth) pi 1/180))
         (tip (* elevation pi 1/180)))
    (destructuring-bind (a b c) position
      (let ((right (- (* a (cos turn)) (* b (sin turn))))
            (away (+ (* a (sin turn)) (* b (cos turn)))))
        (list (+ x (* scale right))
              (- y (* scale (+ (* c (cos tip)) (* away (sin tip))))))))))

(defun upward (position top)
  "Return POSITION in the frame, right-handed, whose third axis is the normal of the face TOP."
  (destructuring-bind (x y z) position
    (cdr (assoc top `(("X1" ,y ,z ,x) ("X2" ,z ,y ,(- x)) ("Y1" ,z ,x ,y) ("Y2" ,x ,z ,(- y))
                      ("Z1" ,x ,y ,z) ("Z2" ,y ,x ,(- z)))
                :test #'string=))))

(defun views-agree-p (views plan)
  "True if every contact in VIEWS is where PLAN has it."
  (let ((contacts (supergrip:candidate-contacts (supergrip:plan-best plan) plan)))
    (loop for (azimuth elevation top scale x y seen) in views
          always (or (string= top "Z1") (supergrip:box-pose (supergrip:plan-box plan)))
          always (loop for (finger u v) in seen
                       for place = (seen-at (upward (getf (nth (1- finger) contacts) :position) top)
                                            azimuth elevation scale x y)
                       always (< (+ (abs (- u (first place))) (abs (- v (second place))))
                                 0.05)))))

(defun fingers-in (view)
  (length (seventh view)))

(defun check-pictures (plans folder)
  "Draw PLANS, an alist from name, and check what was drawn."
  (loop for (name . plan) in plans
        do (supergrip-draw:draw-plan plan (in-folder folder "~a.svg" name)))
  (loop for (file complaints views) in (parsed folder)
        for plan = (cdr (assoc (pathname-name file) plans :test #'string=))
        do (is (null complaints) "~a: ~a" file complaints)
           (if (eq (supergrip:plan-verdict plan) :cant)
               (is (every #'zerop (mapcar #'fingers-in views)) "~a" file)
               (let ((fingers (length (supergrip:candidate-contacts (supergrip:plan-best plan)
                                                                    plan))))
                 (is (= 4 (count fingers views :key #'fingers-in))
                     "~a: not every view shows every finger" file)
                 (is (views-agree-p views plan) "~a: a contact is not where the plan has it"
                     file)))))

(test pictures-of-examples-and-extremes
  (with-folder (folder)
    (check-pictures (loop for (name . box) in (append (example-boxes) *extreme-boxes*)
                          collect (cons name (supergrip:plan box)))
                    folder)))

(test pictures-of-random-boxes
  (with-folder (folder)
    (let ((plans '()) (held 0))
      (for-random-boxes (box 200 20261122)
        (let ((plan (supergrip:plan box)))
          (when (eq (supergrip:plan-verdict plan) :grasp) (incf held))
          (push (cons (format nil "box-~3,'0d" (length plans)) plan) plans)))
      (is (> held 10) "too few boxes can be held for this to test anything")
      (check-pictures plans folder))))

(test the-other-pictures
  (with-folder (folder)
    (supergrip-draw:draw-grasps (in-folder folder "grasps.svg"))
    (supergrip-draw:draw-offset (in-folder folder "offset.svg"))
    (supergrip-draw:draw-system (in-folder folder "system.svg"))
    (loop for (name . box) in (append (example-boxes) *extreme-boxes*)
          for plan = (supergrip:plan box)
          do (supergrip-draw:draw-session plan (in-folder folder "~a-session.svg" name))
             (supergrip-draw:draw-quality plan (in-folder folder "~a-quality.svg" name))
             (supergrip-draw:draw-section plan (in-folder folder "~a-section.svg" name))
             (supergrip-draw:report plan (in-folder folder "~a.html" name)))
    (let ((files (parsed folder)))
      (is (> (length files) 80))
      (loop for (file complaints) in files
            do (is (null complaints) "~a: ~a" file complaints)))))

(test refined-grasps-have-pictures
  (with-folder (folder)
    (let ((drawn 0) (moved 0))
      (loop for (name . box) in (append (example-boxes) *extreme-boxes*)
            for plan = (supergrip:plan box)
            while (< moved 5)
            do (let ((refinement (supergrip:refine plan :count 1 :regions 20)))
                 (when refinement
                   (let ((text (uiop:read-file-string
                                (supergrip-draw:draw-refinement
                                 refinement (in-folder folder "~a-refined.svg" name)))))
                     (incf drawn)
                     (is (search "where a finger was" text))
                     (when (supergrip:refinement-moved-p refinement)
                       (incf moved)
                       (is (search (format nil "exact Q = ~,3f"
                                           (supergrip:refinement-quality refinement))
                                   text)))))))
      (is (= 5 moved))
      (let ((files (parsed folder)))
        (is (= drawn (length files)))
        (loop for (file complaints) in files
              do (is (null complaints) "~a: ~a" file complaints))))))

(test the-offset-picture-agrees-with-the-plan
  (loop for (across along) in supergrip-draw::+offset-boxes+
        do (multiple-value-bind (candidate plan)
               (supergrip-draw::offset-plan across along supergrip:*knowledge*)
             (let ((tip (third (supergrip-draw::finger-links 1 across (/ along 2)
                                                             supergrip:*knowledge*))))
               (is (close-to (second tip) (third (supergrip:candidate-offset candidate))))
               (dolist (contact (supergrip:candidate-contacts candidate plan))
                 (is (close-to (second tip) (third (getf contact :position)))))))))

;;; What a user gives

(defparameter *hostile-name*
  (format nil "<script>alert(1)</script> ]]> &amp; \"x\" 'y' -- ~a~a~a ~a"
          (code-char 0) (code-char 27) (code-char #xfffe) (make-string 300 :initial-element #\W)))

(test hostile-names-are-escaped
  (with-folder (folder)
    (dolist (weight '(0.1 50))
      (let ((plan (supergrip:plan `((size 5 4 3) (weight ,weight) (u 0.5) (v 0.2) (constrained)
                                    (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1))
                                    (name ,*hostile-name*)))))
        (supergrip-draw:draw-plan plan (in-folder folder "~a-plan.svg" weight))
        (supergrip-draw:draw-session plan (in-folder folder "~a-session.svg" weight))
        (supergrip-draw:draw-quality plan (in-folder folder "~a-quality.svg" weight))
        (supergrip-draw:draw-section plan (in-folder folder "~a-section.svg" weight))
        (supergrip-draw:report-index (list plan) folder)
        (supergrip-draw:report plan (in-folder folder "~a-page.html" weight))))
    (loop for (file complaints) in (parsed folder)
          for text = (uiop:read-file-string (in-folder folder file))
          do (is (null complaints) "~a: ~a" file complaints)
             (is (null (search "<script" text)) file)
             (is (search "&lt;script" text) file))))

(defparameter *own-grasp*
  "(SETQ HOOK-<3
     '(USED-SURFACES (N1 N2 A1 A2) CONDITIONS (T) OFFSET (LIST 0 0 0 0 0 0)
       WRENCH (1 1 1 1 1 1) TWIST (1 1 1 1 1 1)
       CONTACTS ((N1 0 0) (A1 1/2 1/2) (N2 0 0)) PALM A2))
   (SETQ NEVER
     '(USED-SURFACES (N1 A2) CONDITIONS (1 < 0) OFFSET (LIST 0 0 0 0 0 0)
       WRENCH (1 1 1 1 1 1) TWIST (1 1 1 1 1 1)))")

(defun knowledge-with (text)
  "Return the knowledge that is loaded with the grasps in TEXT."
  (uiop:with-temporary-file (:pathname grasps :stream out)
    (write-string (file-text "grasps.lisp") out)
    (write-string text out)
    (finish-output out)
    (handler-bind ((warning #'muffle-warning))
      (supergrip:load-knowledge :grasps grasps))))

(defun own-grasp-text (name conditions &rest contacts)
  (format nil "(SETQ ~a '(USED-SURFACES (N1 N2 A1 A2) CONDITIONS (~a) OFFSET (LIST 0 0 0 0 0 0)
WRENCH (1 1 1 1 1 1) TWIST (1 1 1 1 1 1) CONTACTS (~{~a~^ ~}) PALM A2))~%" name conditions contacts))

(test grasps-of-a-user-are-drawn
  (with-folder (folder)
    (supergrip-draw:draw-grasps (in-folder folder "grasps.svg")
                                :knowledge (knowledge-with *own-grasp*))
    (destructuring-bind ((file complaints views)) (parsed folder)
      (is (null complaints) "~a: ~a" file complaints)
      (is (= 3 (fingers-in (first (last views)))))
      (let ((text (uiop:read-file-string (in-folder folder file))))
        (is (search "HOOK-&lt;3" text))
        (is (search "possible on none of the reference boxes" text))))))

(defun documented-grasp ()
  "Return the grasp that docs/languages.md has as an example."
  (let* ((text (file-text "docs/languages.md"))
         (start (search "(SETQ LATERAL" text)))
    (subseq text start (search "```" text :start2 start))))

(test reference-boxes-meet-conditions
  ;; Conditions below, at, above and between dimensions, on friction and constrained faces.
  (let ((knowledge (knowledge-with
                    (format nil "~{~a~}"
                            (cons (if (find "LATERAL" (supergrip:knowledge-grasps
                                                       supergrip:*knowledge*)
                                            :key #'supergrip:grasp-name :test #'string=)
                                      ""
                                      (documented-grasp))
                                  (loop for (name conditions)
                                        in '(("THIN" "(DIST '(N1 N2)) < 0.3")
                                             ("AT" "(DIST '(N1 N2)) = FINGER-WIDTH")
                                             ("BETWEEN" "(0.2 < (DIST '(N1 N2))) AND ((DIST '(N1 N2)) < 0.21)")
                                             ("WIDE" "(DIST '(O1 O2)) > DIST-PINCH")
                                             ("STRIP" "((DIST '(N1 N2)) < FINGER-WIDTH) AND ((DIST '(A1 A2)) > DIST-PINCH)")
                                             ("SMOOTH" "U < 0.5")
                                             ("LYING" "(CONSTRAINED O1)"))
                                        collect (own-grasp-text name conditions "(N1 0 0)"
                                                                "(N2 0 0)")))))))
    (dolist (grasp (supergrip:knowledge-grasps knowledge))
      (is (supergrip-draw::reference-candidate grasp knowledge) "~a" grasp))))

(test any-number-of-fingers-is-drawn
  (let ((knowledge (knowledge-with
                    (format nil "~a~a~a"
                            (own-grasp-text "FOUR" "T" "(N1 0 0)" "(N1 1/2 0)" "(N1 0 1/2)"
                                            "(N1 1/2 1/2)")
                            (own-grasp-text "SAME" "T" "(N1 0 0)" "(N1 0 0)" "(N1 0 0)" "(N1 0 0)"
                                        "(N1 0 0)" "(N2 0 0)" "(A1 0 0)" "(A2 0 0)")
                            (apply #'own-grasp-text "MANY" "T"
                                   (loop for i below 16
                                         collect (format nil "(N1 ~a ~a)" (/ i 16)
                                                         (/ (mod i 4) 4))))))))
    (with-folder (folder)
      (dolist (name '("FOUR" "SAME" "MANY"))
        (let ((plan (supergrip:try-grasp name (cdr (assoc "pencil" (example-boxes) :test #'string=))
                                         :knowledge knowledge)))
          (supergrip-draw:draw-plan plan (in-folder folder "~a.svg" name))
          (supergrip-draw:draw-session plan (in-folder folder "~a-session.svg" name))))
      (loop for (file complaints) in (parsed folder)
            do (is (null complaints) "~a: ~a" file complaints))))
  (is (equal '("F1" "F1 and F2" "F1, F2 and F3" "F1, F2, F3 and F4")
             (loop for end from 1 to 4
                   collect (supergrip-draw::list-text (subseq '("F1" "F2" "F3" "F4") 0 end))))))

;;; What can't be drawn

(defun sized-box (&rest size)
  `((size ,@size) (weight 0) (u 0.8) (v 0.2) (constrained)
    (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1))))

(test a-picture-needs-the-name-of-a-file
  (with-folder (folder)
    (let ((plan (supergrip:plan (sized-box 12 2 2))))
      (loop for (text file) in
            `(("7 is not the name of a file: that is a string, or a path without wild cards" 7)
              ("() is not the name of a file: that is a string, or a path without wild cards" ())
              (,(format nil "~s is a directory; a file is wanted" (namestring folder))
               ,(namestring folder)))
            do (dolist (draw (list #'supergrip-draw:draw-system #'supergrip-draw:draw-grasps
                                   (lambda (file) (supergrip-draw:draw-plan plan file))
                                   (lambda (file) (supergrip-draw:report plan file))))
                 (is (equal text (handler-case (funcall draw file)
                                   (supergrip:argument-error (condition)
                                     (princ-to-string condition)))))))
      (signals supergrip:argument-error (supergrip-draw:report-index (list plan) 7))
      (signals supergrip:no-plan-error (supergrip-draw:report-index '(7) folder))
      (signals supergrip:no-plan-error (supergrip-draw:report-index 7 folder))
      (signals supergrip:argument-error
        (supergrip-draw:draw-grasps (in-folder folder "x.svg") :knowledge nil))
      (signals supergrip:argument-error
        (supergrip-draw:draw-offset (in-folder folder "x.svg") :knowledge 7))
      (dolist (draw (list #'supergrip-draw:draw-plan #'supergrip-draw:draw-session
                          #'supergrip-draw:draw-quality #'supergrip-draw:draw-section
                          #'supergrip-draw:report))
        (signals supergrip:no-plan-error (funcall draw nil (in-folder folder "x.svg")))
        (signals supergrip:no-plan-error (funcall draw "x" (in-folder folder "x.svg")))))
    (is (null (uiop:directory-files folder)) "nothing is written")))

(test what-cannot-be-drawn-is-an-error-of-ours
  (with-folder (folder)
    (loop for size in '((0.6 1d-300 1d300) (1d300 1d300 1d300) (1d-300 1d-300 1d-300)
                        (1 1d-300 1) (1d10 1 1))
          for plan = (supergrip:plan (apply #'sized-box size))
          do (dolist (draw (list #'supergrip-draw:draw-plan #'supergrip-draw:draw-session
                                 #'supergrip-draw:draw-quality #'supergrip-draw:draw-section
                                 #'supergrip-draw:report))
               (signals supergrip-draw:drawing-error
                 (funcall draw plan (in-folder folder "x.svg")))))
    (is (null (uiop:directory-files folder)) "nothing is written"))
  (is (equal "0.6 × 1e-300 × 1e300 cm can't be drawn: sizes from 1e-6 to 1e9 cm can be"
             (handler-case (supergrip-draw:draw-plan (supergrip:plan (sized-box 0.6 1d-300 1d300))
                                                     "x.svg")
               (supergrip:supergrip-error (condition) (princ-to-string condition))))))

(test what-other-grippers-can-not-show-is-an-error-of-ours
  (flet ((knowledge (from to)
           (let* ((text (file-text "grasps.lisp"))
                  (place (search from text)))
             (uiop:with-temporary-file (:pathname grasps :stream out)
               (write-string (subseq text 0 place) out)
               (write-string to out)
               (write-string (subseq text (+ place (length from))) out)
               (finish-output out)
               (handler-bind ((warning #'muffle-warning))
                 (supergrip:load-knowledge :grasps grasps))))))
    (with-folder (folder)
      (signals supergrip-draw:drawing-error
        (supergrip-draw:draw-offset (in-folder folder "x.svg")
                                    :knowledge (knowledge "DIST-PINCH    12" "DIST-PINCH    2")))
      (signals supergrip-draw:drawing-error
        (supergrip-draw:draw-offset (in-folder folder "x.svg")
                                    :knowledge (knowledge "FINGER-LENGTH 3.2"
                                                          "FINGER-LENGTH 1e8"))))))

(defun hand (key name)
  (supergrip:load-knowledge key (uiop:native-namestring
                                 (project-file (format nil "examples/hands/~a" name)))))

(test grippers-are-drawn
  (with-folder (folder)
    (loop for name in '("paper" "robotiq-3-finger" "barrett-bh8-282")
          for knowledge = (hand :gripper (format nil "~a.lisp" name))
          do (supergrip-draw:draw-gripper (in-folder folder "~a.svg" name) :knowledge knowledge)
             (let ((text (uiop:read-file-string (in-folder folder "~a.svg" name))))
               (loop for (dimension) in (supergrip:knowledge-gripper knowledge)
                     do (is (or (search dimension text)
                                (member dimension '("REACH-C" "SLIPPERY-U" "FINGER-FORCE")
                                        :test #'string=))
                            "~a: ~a" name dimension))))
    (loop for (file complaints) in (parsed folder)
          do (is (null complaints) "~a: ~a" file complaints))))

(test a-jaw-is-drawn-but-for-what-it-has-not
  (let* ((jaw (hand :hand "robotiq-2f-85"))
         (plan (supergrip:plan (sized-box 12 2 2) :knowledge jaw)))
    (with-folder (folder)
      (supergrip-draw:draw-plan plan (in-folder folder "plan.svg"))
      (supergrip-draw:draw-grasps (in-folder folder "grasps.svg") :knowledge jaw)
      (supergrip-draw:report plan (in-folder folder "page.html"))
      (loop for (file complaints) in (parsed folder)
            do (is (null complaints) "~a: ~a" file complaints))
      (is (equal "the gripper can't be drawn: it names no FINGER-LENGTH, FINGER-DIST, FINGER-SPREAD and REACH-U"
                 (handler-case (supergrip-draw:draw-gripper (in-folder folder "x.svg")
                                                            :knowledge jaw)
                   (supergrip:supergrip-error (condition) (princ-to-string condition)))))
      (signals supergrip:no-grasp-error
        (supergrip-draw:draw-offset (in-folder folder "x.svg") :knowledge jaw)))))

(defun all-pictures (plan folder)
  "Draw all there is of PLAN into FOLDER."
  (loop for (name draw) in `(("plan.svg" ,#'supergrip-draw:draw-plan)
                             ("quality.svg" ,#'supergrip-draw:draw-quality)
                             ("section.svg" ,#'supergrip-draw:draw-section)
                             ("session.svg" ,#'supergrip-draw:draw-session)
                             ("page.html" ,#'supergrip-draw:report))
        do (funcall draw plan (in-folder folder name)))
  (let ((refinement (supergrip:refine plan :count 1 :regions 20)))
    (when refinement
      (supergrip-draw:draw-refinement refinement (in-folder folder "refinement.svg")))))

(defun few-dimensions ()
  "Return the knowledge of a jaw that names no more than its opening."
  (values (text-knowledge
           "(RULE R (IF (OPPOSED (s1 s2)) (NOT CONSTRAINED (s1)) (NOT CONSTRAINED (s2)))
                    (THEN (TRY JAW (s1 s2 ? ? ? ?))))"
           "(SETQ GRIPPER '(DIST-PINCH 8))
            (SETQ JAW '(USED-SURFACES (N1 N2 A2) CONDITIONS ((DIST '(N1 N2)) < DIST-PINCH)
                        REACH (A 4) TWIST (1 1 1 1 1 1)))")))

(test every-picture-is-drawn-for-every-hand
  (dolist (knowledge (list (hand :gripper "robotiq-3-finger.lisp") (hand :hand "robotiq-2f-85")
                           (few-dimensions)))
    (dolist (size '((12 2 2) (40 40 40)))
      (dolist (index '(:paper :exact))
        (with-folder (folder)
          (all-pictures (supergrip:plan (apply #'sized-box size) :knowledge knowledge :index index)
                        folder)
          (supergrip-draw:draw-grasps (in-folder folder "grasps.svg") :knowledge knowledge)
          (loop for (file complaints) in (parsed folder)
                do (is (null complaints) "~a, ~a: ~a" size file complaints))))))
  (with-folder (folder)
    (dolist (draw (list #'supergrip-draw:draw-gripper #'supergrip-draw:draw-offset))
      (signals supergrip:supergrip-error
        (funcall draw (in-folder folder "x.svg") :knowledge (few-dimensions))))))

(test pictures-do-not-depend-on-float-traps
  (let ((plan (supergrip:plan (sized-box 12 2 2))))
    (with-folder (folder)
      (supergrip-draw:report plan (in-folder folder "a.html"))
      (sb-int:with-float-traps-masked (:overflow :invalid :divide-by-zero :inexact)
        (supergrip-draw:report plan (in-folder folder "b.html"))
        (signals arithmetic-error
          (supergrip-draw::decimal sb-ext:double-float-positive-infinity)))
      (is (equal (uiop:read-file-string (in-folder folder "a.html"))
                 (uiop:read-file-string (in-folder folder "b.html")))))))

(test extreme-boxes-that-can-be-drawn-are
  (with-folder (folder)
    (loop for size in '((1d-6 1d-6 1d9) (1d9 1d9 1d-6) (5 1d9 5) (5 1d-6 1d9) (1d-6 1d-6 1d-6))
          for number from 1
          for plan = (supergrip:plan (apply #'sized-box size))
          do (supergrip-draw:draw-plan plan (in-folder folder "~d.svg" number))
             (supergrip-draw:report plan (in-folder folder "~d.html" number)))
    (loop for (file complaints) in (parsed folder)
          do (is (null complaints) "~a: ~a" file complaints))))

(test a-page-that-cannot-be-drawn-costs-itself-only
  (with-folder (folder)
    (let ((plans (loop for size in '((12 2 2) (0.6 1d-300 1d300) (4 4 4))
                       collect (supergrip:plan (apply #'sized-box size)))))
      (multiple-value-bind (index lost) (supergrip-draw:report-index plans folder)
        (is (= 1 lost))
        (is (= 3 (length (uiop:directory-files folder))) "two pages and the index")
        (is-true (search "No page: 0.6 &#xD7; 1e-300" (uiop:read-file-string index)))
        (is-true (search "1 page can" (uiop:read-file-string index)))))
    (loop for (file complaints) in (parsed folder)
          do (is (null complaints) "~a: ~a" file complaints))))

(test odd-names-of-files-are-taken-as-they-stand
  (with-folder (folder)
    (let ((plan (supergrip:plan (sized-box 12 2 2)))
          (outside (in-folder folder "outside")))
      (flet ((name (name) (concatenate 'string (uiop:native-namestring folder) name)))
        (dolist (name '("a[1].svg" "b*?.svg" "c\\d.svg" "no-type"))
          (supergrip-draw:draw-session plan (name name))
          (is (probe-file (uiop:parse-native-namestring (name name)))))
        (supergrip-draw:report-index (list plan) (name "r[1]"))
        (is (probe-file (uiop:parse-native-namestring (name "r[1]/index.html"))))
        ;; A link is replaced, not followed.
        (with-open-file (out outside :direction :output) (write-string "mine" out))
        (uiop:run-program (list "ln" "-s" (uiop:native-namestring outside) (name "link.svg")))
        (supergrip-draw:draw-session plan (name "link.svg"))
        (is (equal "mine" (uiop:read-file-string outside)))))))

(test numbers-for-readers
  (loop for (text number . digits) in '(("0" 0d0) ("0.08" 0.08d0) ("12" 12) ("12.3" 12.345d0)
                                        ("12.35" 12.345d0 4) ("1e300" 1d300) ("1e-300" 1d-300)
                                        ("9.99e-10" 9.99d-10) ("1e10" 9.999d9) ("−1.5" -1.5d0)
                                        ("1235" 1234.5d0) ("0.001" 0.001d0))
        do (is (equal text (apply #'supergrip-draw::quantity number digits)) "~a" number))
  (is (equal '("0.770" "0.313" "0.860" "2.000" "−0.500" "0.000")
             (mapcar (lambda (number) (supergrip-draw::fixed number 3))
                     '(0.76951d0 0.3125d0 0.8595d0 1.9996d0 -0.5d0 -0.0001d0)))))

(test reports-say-why
  (with-folder (folder)
    (let* ((plan (supergrip:plan (cdr (assoc "pencil" (example-boxes) :test #'string=))))
           (text (uiop:read-file-string (supergrip-draw:report plan (in-folder folder "p.html")))))
      (dolist (words '("PINCH-3-PARALLEL" "0.860" "CORNER (Z1 Y1 X2)" "SURFACES3" "GRIP11"))
        (is (search words text) words)))
    (loop for (name . box) in (example-boxes)
          for plan = (supergrip:plan box)
          for text = (uiop:read-file-string (supergrip-draw:report plan
                                                                   (in-folder folder "x.html")))
          do (dolist (candidate (supergrip:plan-rejected plan))
               (is (search (supergrip-draw::safe
                            (nth-value 1 (supergrip:candidate-failure candidate plan)))
                           text)
                   "~a" name)))))

;;; The true radius

(defun attribute (name text start)
  "Return the number that the attribute NAME has in TEXT, from START on."
  (let ((place (+ (search (format nil "~a='" name) text :start2 start) (length name) 2)))
    (let ((*read-default-float-format* 'double-float) (*read-eval* nil))
      (read-from-string (substitute #\Space #\' text) t nil :start place))))

(test the-true-radius-stands-beside-the-axes
  "Of the pencil's best grasp: u_w 1.095; true 0.880, of which 0.879 is proved; sure 0.575."
  (with-folder (folder)
    (flet ((shown (draw box)
             (uiop:read-file-string (funcall draw (supergrip:plan box) (in-folder folder "p")))))
      (let ((picture (shown #'supergrip-draw:draw-quality *good-box*))
            (page (shown #'supergrip-draw:report *good-box*)))
        (dolist (words '("All axes together: 0.879; surely 0.575"
                         "Least: pushed along −Y and turned about +Y"))
          (is (search (supergrip-draw::safe words) picture) words)
          (is (search (supergrip-draw::safe words) page) words))
        (dolist (words '("the contacts bear 0.879 times the forces and torques asked for; "
                         "the least to spare where the box is pushed along −Y and turned about +Y."
                         "on each axis alone already makes sure of 0.575 times."))
          (is (search (supergrip-draw::safe words) page) words)))
      (dolist (draw (list #'supergrip-draw:draw-quality #'supergrip-draw:report))
        (is (not (search "together:" (shown draw (changed-box :force-needed '(0 0 0 0 0 0))))))))))

(test the-bars-of-the-true-radius-are-to-scale
  "The bar, the one in it, the dashed line and the mark are at true, sure, u_w and 1."
  (with-folder (folder)
    (let* ((plan (pencil-plan))
           (picture (uiop:read-file-string
                     (supergrip-draw:draw-quality plan (in-folder folder "p.svg")))))
      (loop with start = 0
            for candidate in (supergrip:plan-possible plan)
            repeat 3
            do (setf start (search ">radius<" picture :start2 (1+ start)))
               (flet ((at (class name)
                        (attribute name picture
                                   (search (format nil "class='~a'" class) picture :start2 start))))
                 (let* ((left (at "have" "x")) (one (- (at "need" "x1") left)))
                   (flet ((drawn-p (radius length) (< (abs (- radius (/ length one))) 2d-3)))
                     (is (drawn-p (supergrip:candidate-exact-radius candidate plan :gap 1d-3)
                                  (at "have" "width")))
                     (is (drawn-p (supergrip:candidate-sure candidate plan) (at "sure" "width")))
                     (is (drawn-p (supergrip:candidate-force-radius candidate)
                                  (- (at "hidden" "x1") left))))))))))

(test pictures-of-exact-plans-say-what-their-numbers-are
  "u_w is the paper's; what an exact plan counts is called the exact radius, a bound of it a bound."
  (with-folder (folder)
    (let* ((plan (supergrip:plan *good-box* :index :exact))
           (best (supergrip:plan-best plan))
           (bound (find-if #'supergrip:candidate-bound-p (supergrip:plan-possible plan))))
      (flet ((shown (draw count)
               (uiop:read-file-string
                (apply draw plan (in-folder folder "p") (and count (list :count count))))))
        (let ((picture (shown #'supergrip-draw:draw-quality 20)))
          (dolist (words (list (format nil "Forces, exact radius = ~,3f, limited about Y"
                                       (supergrip:candidate-force-radius best))
                               (format nil "Forces, exact radius ≤ ~,3f"
                                       (supergrip:candidate-force-radius bound))
                               (format nil "Q ≤ ~,3f" (supergrip:candidate-quality bound))
                               "u_w = 1.095"))
            (is (search (supergrip-draw::safe words) picture) words))
          (is (not (search "Forces, u_w" picture))))
        (is (search "1.095" (shown #'supergrip-draw:draw-section nil)))
        (let ((page (shown #'supergrip-draw:report nil)))
          (is (search "times what the task needs on all axes together." page))
          (is (search (supergrip-draw::safe
                       (format nil "forces ≤ ~,3f" (supergrip:candidate-force-radius bound)))
                      page)))))))

(defun radius-in-plane (candidate plan axes)
  "Return the exact radius of CANDIDATE of PLAN for what is needed on AXES alone."
  (exact-radius-of
   (candidate-case candidate plan
                   (loop for axis below 6
                         for need in (supergrip:box-force-needed (supergrip:plan-box plan))
                         collect (if (member axis axes) need 0)))))

(test a-section-is-what-the-contacts-can-do-in-its-plane
  "The greatest circle in it, around 0 0, has the exact radius for the needs of its two axes alone."
  (let ((checked 0))
    (for-random-boxes (box 100 44)
      (let* ((plan (supergrip:plan box))
             (best (supergrip:plan-best plan))
             (worst (and best (nth-value 2 (supergrip:candidate-exact-radius best plan)))))
        (when worst
          (let* ((axes (supergrip-draw::section-axes
                        worst (supergrip:box-force-needed (supergrip:plan-box plan))))
                 (drawn (least-radius (supergrip-draw::section-points best plan axes)))
                 (radius (radius-in-plane best plan axes)))
            (is (< (abs (- radius drawn)) (+ 2d-3 (* 2d-2 radius))) "~s: ~a ~a" box radius drawn)
            (incf checked)))))
    (is (< 10 checked))))

(defun least-radius (outline)
  "Return the radius of the greatest circle around 0 0 in OUTLINE, a list of points in a round."
  (loop for (a b) on (append outline (list (first outline)))
        while b
        minimize (/ (abs (- (* (first a) (second b)) (* (first b) (second a))))
                    (supergrip-draw::distance a b))))

(test a-wrench-that-contacts-can-not-exert-is-not-called-sure
  "ONE-FINGER says that it exerts everything, and only touches the top."
  (with-folder (folder)
    (let* ((knowledge (knowledge-with (own-grasp-text "ONE-FINGER" "T" "(A1 0 0)")))
           (plan (supergrip:try-grasp "ONE-FINGER" (changed-box :constrained)
                                       :knowledge knowledge))
           (best (supergrip:plan-best plan)))
      (is (<= 0.1d0 (supergrip:candidate-sure best plan)))
      (dolist (draw (list #'supergrip-draw:draw-quality #'supergrip-draw:report))
        (let ((text (uiop:read-file-string (funcall draw plan (in-folder folder "p")))))
          (is (search "ogether: the weight is too much" text))
          (is (not (search "surely 0" text))))))))

(test facts-of-ones-own-are-shown
  (with-folder (folder)
    (let* ((knowledge (text-knowledge
                       (format nil "(INPUT FRAGILE (s1)) (INPUT WET)
                                    (RULE WET1 (IF (WET) (FRAGILE (s1)))
                                               (THEN (REMEMBER SOGGY (s1)) (CANT GRASP IT WET)))
                                    ~a" (file-text "rules.lisp"))
                       (file-text "grasps.lisp")))
           (facts '(:facts (fragile (y1)) (wet)))
           (cant (supergrip:plan (append *good-box* (list facts)) :knowledge knowledge))
           (grasp (supergrip:plan (append *good-box* (list (butlast facts))) :knowledge knowledge)))
      (flet ((shown (draw plan)
               (uiop:read-file-string (funcall draw plan (in-folder folder "p")))))
        (dolist (words '("Facts of its own</th>" "FRAGILE (Y1) and WET" "fact-6-8"
                         "href='#fact-6-8'"
                         "Facts of its own: FRAGILE (Y1), WET."))
          (is (search (substitute #\" #\' words) (substitute #\" #\' (shown #'supergrip-draw:report
                                                                            cant)))
              words))
        (is (search "cm; FRAGILE (Y1), WET<" (shown #'supergrip-draw:draw-plan cant)))
        (is (search "; FRAGILE (Y1)<" (shown #'supergrip-draw:draw-plan grasp)))
        (is (not (search "Facts of its own" (shown #'supergrip-draw:report
                                                   (supergrip:plan *good-box*)))))))))

(test an-index-leads-to-every-page
  (with-folder (folder)
    (let* ((plans (loop for (nil . box) in (example-boxes) collect (supergrip:plan box)))
           (index (supergrip-draw:report-index plans folder))
           (text (uiop:read-file-string index))
           (pages (remove "index" (uiop:directory-files folder "*.html")
                          :key #'pathname-name :test #'string=)))
      (is (= (length plans) (length pages)))
      (dolist (page pages)
        (is (search (format nil "href='~a'" (file-namestring page)) text))))))

(test exported-names-are-documented
  (do-external-symbols (name :supergrip-draw)
    (is (or (documentation name 'function) (documentation name 'type)) "~a" name)))

;;; The batch

(test the-batch-writes-a-page-a-box
  (with-folder (folder)
    (multiple-value-bind (output errors status)
        (uiop:run-program (list "sbcl" "--script"
                                (uiop:native-namestring (project-file "examples/batch.lisp"))
                                "--report" (uiop:native-namestring (in-folder folder "pages")))
                          :input (make-string-input-stream
                                  (let ((*package* (find-package :supergrip-user)))
                                    (format nil "~{~s~%~}"
                                            (mapcar #'cdr (subseq (example-boxes) 0 3)))))
                          :output :string :error-output :string :ignore-error-status t)
      (is (eql 0 status) "~a" errors)
      (is (= 3 (count #\Newline output)))
      (is (= 4 (length (uiop:directory-files (in-folder folder "pages/") "*.html")))))))

(test pages-and-pictures-are-in-the-units-of-the-box
  (let* ((knowledge (force-knowledge))
         (plan (supergrip:plan '((units mm n) (name "pen") (size 120 20 20) (weight 4) (u 0.8d0)
                                 (v 2)
                                 (constrained z2 x1) (force-needed (20 16 16 60 200 200))
                                 (velocity-needed (0 0.8d0 0.8d0 0 0.8d0 0.8d0)))
                               :knowledge knowledge)))
    (uiop:with-temporary-file (:pathname file)
      (supergrip-draw:report plan file)
      (let ((page (uiop:read-file-string file)))
        (dolist (part '("120 &#xD7; 20 &#xD7; 20 mm" "F1 on Y2 at (&#x2212;8.688, &#x2212;10, 0)"
                        "mm from the box centre" "weight 4 N" "units a mm" "20 mm"
                        "It does not fit: surely 87 %, and at most 89 %, of what is asked; weakest about Y."
                        "forces in N, torques in N mm; velocities from 0 to 1"
                        "Lengths in mm, forces in N, torques in N mm."))
          (is (search part page) "~a" part))
        (is (not (search " cm"
                         (subseq page (search "<body" page) (search "All candidates" page)))))))))
