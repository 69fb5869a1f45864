;;;; grasps-picture.lisp -- DRAW-GRASPS: the grasp modes, the paper's Figure 1.
;;;;
;;;; Each grasp is tried on reference boxes until one can be held, and is drawn with the palm above:
;;;; so a grasp that a user has added is drawn, too, from its data.

(in-package :supergrip-draw)

;;; Reference boxes.  Their sizes come from the numbers and dimensions in the grasp's conditions,
;;; and then from all dimensions of the gripper: below, at and above each.

(defun numbers-of (form gripper)
  "Return the numbers above zero in FORM, the value of a dimension of GRIPPER for its name."
  (cond ((consp form) (append (numbers-of (first form) gripper) (numbers-of (rest form) gripper)))
        ((realp form) (and (plusp form) (list (coerce form 'double-float))))
        (t (let ((entry (and form (assoc form gripper :test #'string-equal))))
             (and entry (plusp (cdr entry)) (list (cdr entry)))))))

(defun sizes-near (numbers)
  "Return the sizes just below, at and just above each of NUMBERS, ascending."
  (sort (remove-duplicates (loop for number in numbers
                                 append (list (* 0.9d0 number) number (* 1.1d0 number))))
        #'<))

(defun with-middles (sizes)
  "Return SIZES, ascending, and what is in the middle between each and the next."
  (loop for (size next) on sizes
        collect size
        when next collect (/ (+ size next) 2)))

(defun shape-cost (size usual)
  "Return how far SIZE, three numbers, the greatest first, is from what is seen best: a box not too
long, neither too large nor too small for the fingers; USUAL is a size in the middle of all."
  (destructuring-bind (long middle short) size
    (+ (abs (- (/ long short) 1.6d0)) (abs (- (/ middle short) 1.15d0))
       (abs (- (/ long usual) 1)))))

(defun reference-sizes (sizes)
  "Return all triples that are made of SIZES, ascending, the best to look at first."
  (stable-sort (loop for (long . others) on (reverse sizes)
                     append (loop for (middle . rest) on (cons long others)
                                  append (loop for short in (cons middle rest)
                                               collect (list long middle short))))
               #'< :key (lambda (size) (shape-cost size (nth (floor (length sizes) 2) sizes)))))

(defun all-reference-sizes (grasp knowledge)
  "Return the sizes of the boxes on which GRASP of KNOWLEDGE is to be tried, in that order."
  (let* ((gripper (knowledge-gripper knowledge))
         (parts (second (third (grasp-form grasp))))
         (own (loop for (key form) on parts by #'cddr
                    when (string-equal key "CONDITIONS")
                      append (numbers-of form gripper))))
    (append (reference-sizes (with-middles (sizes-near own)))
            (reference-sizes (sizes-near (numbers-of (mapcar #'car gripper) gripper))))))

(defparameter +reference-tasks+
  (loop for constrained in '(() (:z2) (:z2 :x1) (:z1 :z2))
        append (loop for u in '(2 0.8d0 0.2d0) collect (list u constrained)))
  "Friction and constrained faces of the reference boxes, in the order in which they are tried.")

(defun reference-box (size u constrained)
  "Return the description of a reference box, whose task needs a little of all."
  `((size ,@size) (weight 0) (u ,u) (v 0.2d0) (constrained ,@constrained)
    (force-needed (0.1 0.1 0.1 0.1 0.1 0.1)) (velocity-needed (0 0 0 0 0 0))))

(defun reference-candidate (grasp knowledge)
  "Return a possible candidate of GRASP of KNOWLEDGE, and its plan; or NIL."
  (let ((sizes (all-reference-sizes grasp knowledge)) (tries 100000))
    (loop for (u constrained) in +reference-tasks+
          do (dolist (size sizes)
               (when (minusp (decf tries)) (return-from reference-candidate nil))
               (let ((plan (try-grasp (grasp-name grasp) (reference-box size u constrained)
                                      :knowledge knowledge)))
                 (when (plan-possible plan)
                   (return-from reference-candidate
                     (values (best-seen (plan-possible plan) plan) plan))))))))

(defun best-seen (candidates plan)
  "Return the one of CANDIDATES of PLAN whose contacts are seen best with the palm above."
  (let ((best nil) (most nil))
    (dolist (candidate candidates best)
      (let ((score (nth-value 1 (best-camera (list (grasp-subject candidate plan)) 26
                                             (palm-face candidate)))))
        (when (or (null most) (> score (+ most 1d-6)))
          (setf best candidate most score))))))

(defun face-namer (candidate)
  "Return a function that gives the grasp's own name of a face of the box."
  (lambda (face)
    (aref #("N1" "N2" "O1" "O2" "A1" "A2")
          (position (face-name face) (candidate-matching candidate) :test #'string=))))

(defun grasp-axes (candidate)
  "Return the vectors of N, O and A."
  (loop for (face) on (candidate-matching candidate) by #'cddr
        collect (face-normal (face-index face))))

(defun draw-grasp-axes (camera candidate point)
  "Draw the axes N O A of CANDIDATE at POINT."
  (let ((view (make-view :camera camera :scale 26 :origin point)))
    (loop for vector in (grasp-axes candidate)
          for name in '("N" "O" "A")
          for end = (project view vector)
          for way = (max 1 (distance point end))
          do (draw-axis point end)
             (draw-text name (let ((beyond (along point end (/ (+ way 9) way))))
                               (list (first beyond) (+ 4 (second beyond))))
                        :class "soft" :anchor :middle))))

(defun grasp-summary (subject)
  "Return in words which fingers oppose which, and where the palm is."
  (let* ((name (subject-namer subject))
         (by-face (loop for face in '(1 0 3 2 5 4)
                        for names = (loop for contact in (subject-contacts subject)
                                            when (= face (contact-face contact))
                                              collect (contact-finger contact))
                        when names collect (cons face names)))
         (pairs (loop for (face . names) in by-face
                      for other = (cdr (assoc (opposite face) by-face))
                      when (and other (oddp face))
                        collect (format nil "~a ~:[oppose~;opposes~] ~a"
                                        (list-text names) (null (rest names)) (list-text other)))))
    (format nil "~:[no two fingers oppose~;~:*~{~a~^, ~}~]; palm over ~a" pairs
            (funcall name (subject-palm subject)))))

(defun draw-grasp-cell (grasp knowledge x y width height)
  "Draw GRASP in a cell of a table of pictures.  Returns what it shows, in words."
  (draw-text (fitting (grasp-name grasp) "bold" (- width 16)) (list (+ x 10) (+ y 22))
             :class "bold")
  (multiple-value-bind (candidate plan) (reference-candidate grasp knowledge)
    (cond (candidate (draw-reference candidate plan x y width height))
          (t (draw-text "possible on none of the reference boxes" (list (+ x 10) (+ y 60))
                        :class "soft")
             (format nil "~a: possible on none of the reference boxes." (grasp-name grasp))))))

(defun draw-reference (candidate plan x y width height)
  (let* ((subject (grasp-subject candidate plan :namer (face-namer candidate) :labelled nil))
         (camera (best-camera (list subject) 26 (palm-face candidate)))
         (view (fit-view camera (subject-vectors subject)
                         (list (+ x 34) (+ y 60) (- width 76) (- height 108))))
         (summary (grasp-summary subject)))
    (draw-text (fitting summary "soft" (- width 20)) (list (+ x 10) (+ y 41)) :class "soft")
    (draw-grasp-axes camera candidate (list (+ x 40) (+ y height -40)))
    (occupy (list (+ x 2) (+ y height -78) 76 76))
    (draw-subject subject view)
    (place-labels (list (+ x 4) (+ y 48) (- width 8) (- height 52)))
    (format nil "~a: ~{~a~^, ~}; ~a." (candidate-grasp candidate)
            (loop for contact in (subject-contacts subject)
                  collect (format nil "finger ~a on ~a" (contact-finger contact)
                                  (funcall (subject-namer subject) (contact-face contact))))
            summary)))

(defparameter +grasp-key+
  '((key-contact 20 "contact of a finger") (key-hidden 20 "contact behind the box")
    (key-closing 30 "these fingers oppose each other")
    (key-centre 20 "grasp centre"))
  "The signs of the key to the grasps.")

(defun draw-grasps-key (x y)
  "Draw the key to the grasps in the table's last, free cell."
  (loop for sign in +grasp-key+
        for line from (+ y 60) by 26
        do (draw-key x line 400 :signs (list sign)))
  (loop for text in '("F1, F2, F3 are the fingers." "N O A are the axes of the grasp:"
                      "N1 is the face on the + side of N,"
                      "N2 the one opposed to it, and so on." "The palm is above.")
        for line from (+ y 172) by 21
        do (draw-text text (list x line) :class "soft")))

(defun grasps-picture (knowledge)
  "Return the picture of all grasps of KNOWLEDGE."
  (let* ((grasps (knowledge-grasps knowledge))
         (columns 3)
         (rows (ceiling (1+ (length grasps)) columns))
         (wide 330) (high 320)
         (width (+ 24 (* columns wide)))
         (words '()))
    (flet ((cell (i) (multiple-value-bind (row column) (floor i columns)
                       (values (+ 12 (* column wide)) (+ 72 (* row high))))))
      (let ((picture
              (with-picture (width (+ 78 (* rows high)) "Grasp modes" "")
                (draw-heading "Grasp modes" (list +scale-words+) width)
                (loop for grasp in grasps
                      for i from 0
                      do (multiple-value-bind (x y) (cell i)
                           (draw-rectangle (+ x 3) y (- wide 6) (- high 8) "frame")
                           (push (draw-grasp-cell grasp knowledge x y wide (- high 8)) words)))
                (multiple-value-bind (x y) (cell (length grasps))
                  (draw-grasps-key (+ x 16) y)))))
        (setf (picture-description picture) (format nil "~{~a~^ ~}" (reverse words)))
        picture))))

(defun draw-grasps (file &key (knowledge *knowledge*))
  "Draw all grasps of KNOWLEDGE, each on a reference box, into FILE, an SVG picture: the paper's
Figure 1.  Only the data of a grasp are used, so a new one is drawn, too.  Returns FILE."
  (drawing ("the grasp modes")
    (save-picture (grasps-picture (check-knowledge-argument knowledge)) file)))
