;;;; statics.lisp -- every WRENCH entry against a solver's, and what statics asks of all of them.

(in-package :supergrip-test)
(define-suite statics
  "Every WRENCH entry against a solver's, and what statics asks of all of them.")

(defun shipped-grasp (name)
  (supergrip::find-grasp (supergrip::knowledge-graspbase supergrip:*knowledge*) name))

(defparameter *spread* (supergrip::dimension (supergrip::knowledge-graspbase supergrip:*knowledge*)
                                             "FINGER-SPREAD")
  "The spread that ships.")

(defun graspbase-with (&rest dimensions)
  "Return the shipped grasps with other DIMENSIONS of the gripper, a plist of names and numbers."
  (let* ((forms (supergrip-data:read-all
                 (supergrip-data:string-source (file-text "grasps.lisp"))))
         (gripper (copy-list (second (third (first forms))))))
    (loop for (name number) on dimensions by #'cddr
          do (setf (second (member-if (lambda (key) (supergrip-data:name= key name)) gripper))
                   number))
    (multiple-value-bind (graspbase problems)
        (supergrip-data:with-problems
          (supergrip::build-graspbase
           (rest forms) (supergrip::build-gripper (list `(:setq :gripper (:quote ,gripper))))))
      (assert (null problems) () "~{~a~%~}" problems)
      graspbase)))

(defun wrench-entries (graspbase name size u v)
  "Return the six WRENCH entries of grasp NAME on a box of SIZE along N O A, with friction U, V,
and whether the grasping conditions hold."
  (let ((registers (copy-seq (supergrip::graspbase-registers graspbase)))
        (grasp (supergrip::find-grasp graspbase name)))
    (setf (aref registers supergrip::+u+) u
          (aref registers supergrip::+v+) v)
    (loop for length in size
          for i from supergrip::+distances+
          do (setf (aref registers i) length))
    (let ((conditions (supergrip::execute (supergrip::grasp-conditions grasp) registers)))
      (values (and (supergrip::execute (supergrip::grasp-wrench grasp) registers)
                   (loop for register across (supergrip::program-results
                                              (supergrip::grasp-wrench grasp))
                         collect (aref registers register)))
              conditions))))

(defparameter *exact*
  '(("PINCH-2-PARALLEL" t t t t t t)
    ("PINCH-3-PARALLEL" t t t t t t)
    ("PINCH-3-U-SHAPE" t t t t t t)
    ("PINCH-3-C-SHAPE" t t t t t t)
    ("PINCH-2-ADJACENT" t t t t t t)
    ("PINCH-3-ADJACENT" t t nil nil nil t)
    ("PINCH-3-CORNER" nil nil nil nil nil nil))
  "Which entries of WRENCH claim to be exact: along N O A, about N O A.  The docs/physics.md says
the same.")

(defun read-maxima ()
  "Return the solver's results, a list of plists."
  (with-open-file (in (project-file "t/axis-maxima.sexp"))
    (let ((*read-eval* nil) (*read-default-float-format* 'double-float)
          (*package* (find-package :supergrip-test)))
      (loop for entry = (read in nil) while entry collect entry))))

(defun solved-entries (maxima)
  "Return the entries that the shipped forms give where MAXIMA was computed.
Nothing is offset there, so the hand's reach must be no limit."
  (wrench-entries (graspbase-with "FINGER-SPREAD" (getf maxima :spread)
                                  "REACH-U" 1000 "REACH-C" 1000 "DIST-PINCH" 12
                                  "FINGER-WIDTH" 0.01d0)
                  (symbol-name (getf maxima :grasp))
                  (getf maxima :size) (getf maxima :u) (getf maxima :v)))

(defun wrench-faults (maxima entries exact)
  "Return a list of what is wrong with ENTRIES, six numbers, beside the solver's MAXIMA."
  (append
   (unless (or (getf maxima :closed) (some (lambda (entry) (<= entry 0)) entries))
     '("open, but all entries are above 0"))
   (loop for entry in entries
         for true in (getf maxima :axis-maxima)
         for exact-p in exact
         for axis from 0
         when (> entry (+ (* true (+ 1 1d-5)) 1d-7))
           collect (format nil "entry ~d: ~a is above the solver's ~a" axis entry true)
         when (and exact-p (> (abs (- entry true)) (+ (* 1d-5 true) 1d-7)))
           collect (format nil "entry ~d: ~a is not the solver's ~a" axis entry true))))

(test wrench-is-statics
  (let ((ratios (make-hash-table :test #'equal))
        (maxima (read-maxima)))
    (is (= 210 (length maxima)))
    (loop for (name . exact) in *exact*
          do (let ((faults (loop for entry in (remove name maxima :test-not #'string=
                                                                  :key (lambda (m) (getf m :grasp)))
                                 for entries = (solved-entries entry)
                                 append (wrench-faults entry entries exact)
                                 do (note-ratios name entry entries ratios))))
               (is (null faults) "~a:~%~{~a~%~}" name faults)))
    (print-tightness ratios)))

(defun note-ratios (name maxima entries ratios)
  (when (getf maxima :closed)
    (loop for entry in entries
          for true in (getf maxima :axis-maxima)
          for axis from 0
          do (push (/ entry true) (gethash (list name axis) ratios)))))

(defun print-tightness (ratios)
  "Print the median and the least of entry / solver for the entries that are bounds."
  (loop for (name . exact) in *exact*
        do (loop for exact-p in exact
                 for axis from 0
                 for sorted = (sort (copy-list (gethash (list name axis) ratios)) #'<)
                 unless exact-p
                   do (format t "~&   ~a ~a: bound, median ~,2f of the solver's, least ~,2f~%" name
                              (aref #("along N" "along O" "along A" "about N" "about O" "about A")
                                    axis)
                              (nth (floor (length sorted) 2) sorted) (first sorted)))))

(test friction-never-lowers-an-entry
  (let ((state (sb-ext:seed-random-state 7))
        (graspbase (supergrip::knowledge-graspbase supergrip:*knowledge*)))
    (dolist (grasp (supergrip:knowledge-grasps supergrip:*knowledge*))
      (let ((worst 0))
        (dotimes (i 3000)
          (let* ((size (loop repeat 3 collect (random-between 0.6d0 20d0 state)))
                 (u (random 2d0 state)) (v (random 0.5d0 state))
                 (more-u (+ u (random 1d0 state))) (more-v (+ v (random 0.5d0 state)))
                 (name (supergrip:grasp-name grasp)))
            (flet ((entries (u v) (wrench-entries graspbase name size u v)))
              (loop for less in (append (entries u v) (entries u v))
                    for more in (append (entries more-u v) (entries u more-v))
                    do (setf worst (max worst (- less more)))))))
        (is (<= worst 1d-9) "~a loses ~a" grasp worst)))))

(test no-friction-raises-no-error
  (let ((graspbase (supergrip::knowledge-graspbase supergrip:*knowledge*)))
    (dolist (grasp (supergrip:knowledge-grasps supergrip:*knowledge*))
      (loop for (u v) in '((0d0 0d0) (0d0 0.3d0) (0.5d0 0d0) (2d0 0d0))
            do (finishes (wrench-entries graspbase (supergrip:grasp-name grasp)
                                         '(3d0 4d0 5d0) u v))))))

(test conditions-know-what-friction-can-not-close
  (loop for (name u) in '(("PINCH-2-ADJACENT" 1d0) ("PINCH-3-ADJACENT" 1d0)
                          ("PINCH-3-CORNER" 0.7071d0))
        do (is (not (nth-value 1 (wrench-entries (supergrip::knowledge-graspbase supergrip:*knowledge*)
                                                 name '(4d0 4d0 4d0) u 0.2d0))))))
