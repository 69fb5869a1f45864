;;;; rules-and-refining.lisp -- rules, trying everything, and refining, compared on the same boxes.
;;;;
;;;; sbcl --script t/study.lisp refined measures 1,000 boxes, for docs/study.md; a test measures a
;;;; few, and looks whether the page has what comes out.

(in-package :supergrip-test)
(define-suite rules-and-refining "What the page on rules, trying everything and refining says.")

(defun study-boxes (count)
  "Return COUNT boxes: of each two, one on a table and one of a household."
  (let ((state (sb-ext:seed-random-state 2026)))
    (loop for number below count
          collect (supergrip:parse-box (if (evenp number) (table-box state) (household-box state))))))

(defun exact-quality (plan)
  "Return the quality of the best grasp of PLAN by its certified exact radius, 0 for the radius
where the contacts do not hold the weight; NIL without a grasp.  The second value is true if they
hold it."
  (let ((best (supergrip:plan-best plan)))
    (when best
      (multiple-value-bind (upper lower) (supergrip:candidate-exact-radius best plan)
        (values (mixed-quality (and upper (max 0 (or lower 0)))
                               (supergrip:candidate-velocity-radius best)
                               (supergrip:plan-gamma plan))
                (or (null upper) (>= upper 0)))))))

(defun timed (function boxes)
  "Return what FUNCTION makes of each of BOXES, a list, and how many ms of processor time a box
took."
  (let* ((start (get-internal-run-time))
         (results (mapcar function boxes)))
    (values results (/ (- (get-internal-run-time) start) 1000d0 (length boxes)))))

(defun of-sorted (share numbers)
  (let ((sorted (sort (copy-list numbers) #'<)))
    (nth (floor (* share (1- (length sorted)))) sorted)))

(defstruct way
  "A way to choose grasps.  NAME in the table; for each box: TRIED, how many candidates, and
QUALITY, exact, or NIL; HELD, how many weights are held; TIME, ms a box."
  name tried quality held time)

(defun way-of-plans (name boxes knowledge index)
  "Return the way NAME of planning BOXES by KNOWLEDGE and INDEX, and its plans."
  (multiple-value-bind (plans time)
      (timed (lambda (box) (supergrip:plan box :knowledge knowledge :index index)) boxes)
    (let ((qualities (mapcar (lambda (plan) (multiple-value-list (exact-quality plan))) plans)))
      (values (make-way :name name :time time
                        :tried (mapcar (lambda (plan) (length (supergrip:plan-candidates plan))) plans)
                        :quality (mapcar #'first qualities) :held (count-if #'second qualities))
              plans))))

(defun way-of-refining (name way plans)
  "Return the way NAME, which refines the best grasps of PLANS, those of WAY; and the refinements."
  (multiple-value-bind (refinements time)
      (timed (lambda (plan) (supergrip:refine plan :count 1)) plans)
    (values (make-way :name name :time (+ (way-time way) time) :tried (way-tried way)
                      :quality (loop for r in refinements
                                     collect (and r (supergrip:refinement-quality r)))
                      :held (loop for r in refinements
                                  count (and r (or (null (supergrip:refinement-radius r))
                                                   (>= (second (supergrip:refinement-radius r))
                                                       0)))))
            (remove nil refinements))))

(defun ways (boxes)
  "Return the five ways to choose grasps for BOXES, and the refinements of the last."
  (let ((rules supergrip:*knowledge*) (everything (everything-knowledge)))
    (multiple-value-bind (paper plans) (way-of-plans "rules, paper's index" boxes rules :paper)
      (multiple-value-bind (refined refinements)
          (way-of-refining "rules, paper's index, refined" paper plans)
        (values (list paper
                      (way-of-plans "everything, paper's index" boxes everything :paper)
                      (way-of-plans "rules, exact index" boxes rules :exact)
                      (way-of-plans "everything, exact index" boxes everything :exact)
                      refined)
                refinements)))))

(defun way-parts (ways)
  "Return for each of WAYS its qualities as parts of those of the fourth, the best unrefined ones,
for the boxes where all ways have a grasp."
  (let ((rows (remove-if-not (lambda (row) (and (notany #'null row) (plusp (fourth row))))
                             (apply #'mapcar #'list (mapcar #'way-quality ways)))))
    (loop for k below (length ways)
          collect (loop for row in rows collect (/ (nth k row) (fourth row))))))

(defun print-ways (ways)
  "Print a line for each of WAYS."
  (format t "| way | candidates a box | boxes with a grasp | hold the weight | part of the best exact ~
             Q: mean | 10 % are below | within 1 % or above |~%")
  (format t "| --- | --- | --- | --- | --- | --- | --- |~%")
  (loop for way in ways
        for parts in (way-parts ways)
        do (format t "| ~a | ~,1f | ~d | ~d | ~,3f | ~,2f | ~d of ~d |~%" (way-name way)
                   (/ (reduce #'+ (way-tried way)) (length (way-tried way)))
                   (count-if #'identity (way-quality way)) (way-held way)
                   (/ (reduce #'+ parts) (length parts)) (of-sorted 0.1 parts)
                   (count-if (lambda (part) (>= part 0.99)) parts) (length parts))))

(defun print-gains (refinements)
  "Print what REFINEMENTS have gained: of those that have a radius."
  (let* ((all (remove nil refinements :key #'supergrip:refinement-radius))
         (radii (loop for r in all collect (or (first (supergrip:refinement-radius r)) 0)))
         (qualities (loop for r in all
                          for before = (supergrip:refinement-quality-before r)
                          when (plusp before) collect (/ (supergrip:refinement-quality r) before))))
    (flet ((line (what numbers)
             (format t "| ~a |~{ ~,2f |~}~%" what
                     (mapcar (lambda (share) (of-sorted share numbers)) '(0 0.25 0.5 0.75 0.9 1)))))
      (format t "| of ~d refined grasps | least | 25 % | median | 75 % | 90 % | greatest |~%"
              (length all))
      (format t "| --- | --- | --- | --- | --- | --- | --- |~%")
      (line "Q refined / Q before" qualities)
      (line "radius refined / radius before"
            (loop for r in all for radius in radii
                  for before = (or (first (supergrip:refinement-radius-before r)) 0)
                  when (plusp before) collect (/ radius before)))
      (line "bound of Q / Q refined"
            (loop for r in all
                  collect (/ (supergrip:refinement-quality-bound r) (supergrip:refinement-quality r))))
      (format t "~%Fingers moved in ~d of ~d.~%The search from the plan's own places alone came ~
                 within 2 % of the final radius in ~d of ~d.~%"
              (count-if #'supergrip:refinement-moved-p all) (length all)
              (loop for r in all for radius in radii
                    count (>= (supergrip:refinement-radius-nearby r) (* 0.98 radius)))
              (length all)))))

(defun print-study (count)
  "Print the tables of docs/study.md for COUNT boxes.  Return the ways and the refinements."
  (multiple-value-bind (ways refinements) (ways (study-boxes count))
    (print-ways ways)
    (terpri)
    (print-gains refinements)
    (values ways refinements)))

(defun print-times (ways)
  (format t "~%| way | ms a box |~%| --- | --- |~%")
  (dolist (way ways)
    (format t "| ~a | ~,3f |~%" (way-name way) (way-time way))))

;;; Refined grasps and a grid of placements

(defun grid-placements (freedom around)
  "Return the legal placements of FREEDOM on the finest grid that has at most 5,000.  Where fingers
must stay close together on a large face, a grid of the face may have none; then it covers a part of
it, near the placement AROUND."
  (let ((supergrip::+most-scanned+ 5000))
    (loop for part in '(1 1/4 1/16)
          thereis (loop with near = (supergrip::freedom-near freedom around part)
                        with finest = nil
                        for count from 2 to 16 by 2
                        for grid = (supergrip::lattice near count)
                        while (or grid (null finest))
                        do (setf finest grid)
                        finally (return finest)))))

(defun grid-ratio (refinement)
  "Return by how much the best placement on a grid of up to 5,000 legal ones is better than
REFINEMENT: the ratio of the radii, certified; and how many placements the grid has.  The cuts that
were found may rule placements out: no placement is better than its cuts say."
  (let* ((candidate (supergrip:refinement-candidate refinement))
         (plan (supergrip:refinement-plan refinement))
         (base (supergrip::knowledge-graspbase (supergrip:plan-knowledge plan)))
         (placement (supergrip::placement-of (supergrip:refinement-contacts refinement))))
    (supergrip::with-replay (workspace candidate plan)
      (multiple-value-bind (refining unit) (supergrip::start-refining candidate workspace base)
        (let* ((grid (grid-placements (supergrip::r-freedom refining) placement))
               (ours (* unit (first (supergrip:refinement-radius refinement)))) (best ours))
          (supergrip::ask refining placement 0.01d0 1d-3 3000)
          (dolist (placement grid)
            (when (> (supergrip::cuts-radius refining placement) (* 1.001d0 best))
              (let ((lower (nth-value 1 (supergrip::ask refining placement 2d-3 1d-4 30000))))
                (when (and lower (> lower best)) (setf best lower)))))
          (values (/ best ours) (length grid)))))))

(defun print-grid (count seed)
  "Print how the best placement on a grid compares with COUNT refined grasps, of four kinds of
boxes, made from SEED."
  (let ((ratios '()) (sizes '()) (times '()) (state (sb-ext:seed-random-state seed)))
    (loop for number from 0
          until (= (length ratios) count)
          do (let* ((maker (nth (mod number 4) '(random-box table-box household-box rubber-box)))
                    (plan (supergrip:plan (funcall maker state)))
                    (start (get-internal-run-time))
                    (refinement (supergrip:refine plan :count 1)))
               (when (and refinement (supergrip:refinement-radius refinement)
                          (plusp (or (first (supergrip:refinement-radius refinement)) 0)))
                 (push (/ (- (get-internal-run-time) start) 1000d0) times)
                 (multiple-value-bind (ratio size) (grid-ratio refinement)
                   (push ratio ratios) (push size sizes)))))
    (flet ((line (what numbers)
             (format t "| ~a |~{ ~,3f |~}~%" what
                     (mapcar (lambda (share) (of-sorted share numbers)) '(0 0.25 0.5 0.75 0.9 1)))))
      (format t "| of ~d refined grasps | least | 25 % | median | 75 % | 90 % | greatest |~%" count)
      (format t "| --- | --- | --- | --- | --- | --- | --- |~%")
      (line "best of the grid / refined" ratios)
      (line "placements in the grid" sizes)
      (line "ms to refine" times)
      (format t "~%The best of the grid is within 2 % in ~d of ~d.~%"
              (count 1.02d0 ratios :test #'>=) count))))

;;; What the page shows

(test the-page-on-the-study-has-what-comes-out
  (let ((page (file-text "docs/study.md")))
    (dolist (line (printed (print-study 6)))
      (is (search line page) "docs/study.md lacks: ~a" line))))
