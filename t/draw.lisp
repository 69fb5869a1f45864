;;;; draw.lisp -- pictures and reports: well-formed, to scale, inside their canvas, and escaped.

(in-package :supergrip-test)
(in-suite all)

;;; All pictures of a test are written into one folder, and parsed in one go, by Python's parser.

(defun own-file (name)
  (asdf:system-relative-pathname "supergrip" name))

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
                          (list "python3" (uiop:native-namestring (own-file "t/draw-check.py"))
                                (uiop:native-namestring folder))
                          :output :string)))
        (*read-eval* nil))
    (mapcar #'read-from-string lines)))

(defun in-folder (folder control &rest arguments)
  (merge-pathnames (apply #'format nil control arguments) folder))

(defun example-boxes ()
  "Return an alist from name to description of the boxes of the examples."
  (loop for file in (uiop:directory-files (own-file "examples/") "*.lisp")
        for box = (with-open-file (in file)
                    (let ((*package* (find-package :supergrip-user)) (*read-eval* nil))
                      (loop for form = (ignore-errors (read in nil))
                            while form
                            when (and (consp form) (symbolp (first form)) (string= (first form) "SETQ"))
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

(defun views-agree-p (views plan)
  "True if every contact in VIEWS is where PLAN has it."
  (let ((contacts (supergrip:candidate-contacts (supergrip:plan-best plan) plan)))
    (loop for (azimuth elevation top scale x y seen) in views
          always (and (string= top "Z1")
                      (loop for (finger u v) in seen
                            for place = (seen-at (getf (nth (1- finger) contacts) :position)
                                                 azimuth elevation scale x y)
                            always (< (+ (abs (- u (first place))) (abs (- v (second place))))
                                      0.05))))))

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
             (supergrip-draw:report plan (in-folder folder "~a.html" name)))
    (let ((files (parsed folder)))
      (is (> (length files) 80))
      (loop for (file complaints) in files
            do (is (null complaints) "~a: ~a" file complaints)))))

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

(test grasps-of-a-user-are-drawn
  (with-folder (folder)
    (uiop:with-temporary-file (:pathname grasps :stream out)
      (write-string (uiop:read-file-string (own-file "grasps.lisp")) out)
      (write-string *own-grasp* out)
      (finish-output out)
      (supergrip-draw:draw-grasps (in-folder folder "grasps.svg")
                                  :knowledge (supergrip:load-knowledge :grasps grasps)))
    (destructuring-bind ((file complaints views)) (parsed folder)
      (is (null complaints) "~a: ~a" file complaints)
      (is (equal '(2 3 3 3 2 3 3 3) (mapcar #'fingers-in views)))
      (let ((text (uiop:read-file-string (in-folder folder file))))
        (is (search "HOOK-&lt;3" text))
        (is (search "possible on none of the reference boxes" text))))))

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
    (is (fboundp name))
    (is (documentation name 'function))))

;;; The batch

(test the-batch-writes-a-page-a-box
  (with-folder (folder)
    (multiple-value-bind (output errors status)
        (uiop:run-program (list "sbcl" "--script"
                                (uiop:native-namestring (own-file "examples/batch.lisp"))
                                "--report" (uiop:native-namestring (in-folder folder "pages")))
                          :input (make-string-input-stream
                                  (let ((*package* (find-package :supergrip-user)))
                                    (format nil "~{~s~%~}"
                                            (mapcar #'cdr (subseq (example-boxes) 0 3)))))
                          :output :string :error-output :string :ignore-error-status t)
      (is (eql 0 status) "~a" errors)
      (is (= 3 (count #\Newline output)))
      (is (= 4 (length (uiop:directory-files (in-folder folder "pages/") "*.html")))))))
