;;;; simulate.lisp -- the part of t/simulate.py in Lisp; no part of the tests.
;;;;
;;;; sbcl --script t/simulate.lisp COUNT SEED INDEX DIR
;;;;
;;;; Plans random boxes by INDEX, paper or exact, until COUNT of their best grasps have a certified
;;;; radius above 1.05, friction force and torque of a fingertip sharing its friction, as in MuJoCo.
;;;; Writes the model of each into DIR, and a line of JSON to standard output: what loads are tried,
;;;; and how hard the fingers press against each.  Newtons and metres; a finger presses with 1 N at
;;;; most.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(let ((*standard-output* (make-broadcast-stream)))
  (asdf:load-system "supergrip/batch"))

(defpackage :supergrip-simulate (:use :cl))
(in-package :supergrip-simulate)

;;; Boxes

(defun between (low high state) (+ low (random (- high low) state)))

(defun a-box (state)
  "Return the description of a box that a hand may hold, of a plausible weight, and a task."
  (flet ((chance (percent) (< (random 100 state) percent)))
    `((size ,@(loop repeat 3 collect (exp (between 0d0 (log 16d0) state))))
      (weight ,(if (chance 10) 0 (between 0.02d0 1d0 state)))
      (u ,(between 0.25d0 1.4d0 state)) (v ,(if (chance 10) 0 (between 0d0 0.6d0 state)))
      (constrained ,@(when (chance 60) '(z2)) ,@(when (chance 20) '(x1)) ,@(when (chance 10) '(y2)))
      (force-needed ,(loop repeat 6 collect (if (chance 35) 0 (between 0d0 1d0 state))))
      (velocity-needed ,(loop repeat 6 collect (if (chance 50) 0 (random 1d0 state)))))))

;;; What is tried

(defun cases-of (best plan)
  "Return contacts, u and v of BEST of PLAN, for the functions of exact statics."
  (let ((box (supergrip:plan-box plan)))
    (values (loop for contact in (supergrip:candidate-contacts best plan)
                  collect (list (getf contact :position) (getf contact :normal)))
            (supergrip:box-friction box) (supergrip:box-soft-friction box))))

(defun radius-of (best plan)
  "Return the certified radius of BEST of PLAN, coupled, or NIL, and the worst motion."
  (let ((need (supergrip:box-force-needed (supergrip:plan-box plan))))
    (unless (every #'zerop need)
      (multiple-value-bind (contacts u v) (cases-of best plan)
        (multiple-value-bind (upper lower worst)
            (supergrip:exact-radius contacts u v need :coupled t
                                    :gravity (supergrip:box-gravity (supergrip:plan-box plan)))
          (declare (ignore upper))
          (values lower worst))))))

(defun index-radius (best plan)
  "Return u_w of BEST of PLAN, whatever index PLAN was made by: the least of (has - load) / need."
  (loop for has in (supergrip:candidate-wrench best plan)
        for load in (supergrip:candidate-load best plan)
        for need in (supergrip:candidate-force-need best plan)
        when (plusp need) minimize (/ (- has load) need)))

(defun directions (need worst)
  "Return the wrenches of the task ellipsoid NEED that are tried, each with its name: along and
about the axes, both ways, and the one against which the contacts have least to spare in the motion
WORST."
  (append
   (loop for axis below 6
         for n in need
         for name in '("X" "Y" "Z" "about X" "about Y" "about Z")
         when (plusp n)
           append (loop for (sign way) in '((1 "+") (-1 "-"))
                        collect (cons (format nil "~a~a" way name)
                                      (loop for i below 6 collect (if (= i axis) (* sign n) 0d0)))))
   (let ((length (sqrt (reduce #'+ (mapcar (lambda (n q) (expt (* n q) 2)) need worst)))))
     (list (cons "worst" (mapcar (lambda (n q) (/ (* n n q) length)) need worst))))))

(defun press (best plan wrench)
  "Return how hard the fingers of BEST of PLAN press to exert WRENCH beside the weight; of what they
can't exert, the largest part that they can, if they can hold the weight."
  (let ((contacts (supergrip:candidate-contacts best plan)) (box (supergrip:plan-box plan))
        (gravity (supergrip:box-gravity (supergrip:plan-box plan))))
    (flet ((forces (part)
             (supergrip::pressing contacts box
                                  (mapcar (lambda (w g) (- (* part w) g)) wrench gravity))))
      (or (forces 1d0)
          (let ((best (forces 0d0)) (low 0d0) (high 1d0))
            (loop repeat 10
                  do (let* ((part (/ (+ low high) 2)) (found (forces part)))
                       (if found (setf best found low part) (setf high part))))
            (or best (mapcar (constantly 1d0) contacts)))))))

;;; Output

(defun put-numbers (numbers)
  (format t "[~{~f~^, ~}]" (mapcar (lambda (number) (coerce number 'double-float)) numbers)))

(defun put-loads (key best plan radius directions)
  "Write the loads at RADIUS in DIRECTIONS, and how BEST of PLAN presses against each, under KEY."
  (format t ", ~s: [" key)
  (loop for ((name . direction) . others) on directions
        for wrench = (mapcar (lambda (d) (* radius d)) direction)
        do (format t "{\"name\": ~s, \"load\": " name)
           ;; Against what the fingers exert, in N and N m.
           (put-numbers (loop for w in wrench for k below 6 collect (if (< k 3) (- w) (/ w -100))))
           (format t ", \"press\": ")
           (put-numbers (press best plan wrench))
           (format t "}~:[~;, ~]" others))
  (format t "]"))

(defun put-case (number best plan radius worst file)
  "Write the line of the case NUMBER, whose model is FILE."
  (let ((uw (index-radius best plan))
        (ways (directions (supergrip:box-force-needed (supergrip:plan-box plan)) worst)))
    (format t "{\"case\": ~d, \"model\": ~s, \"grasp\": ~s, \"radius\": ~f, \"u_w\": ~f" number file
            (supergrip:candidate-grasp best) radius uw)
    (put-loads "task" best plan (* 0.9d0 radius) ways)
    (put-loads "index" best plan (* 0.9d0 uw) ways)
    (format t "}~%")
    (finish-output)))

(defun run (count seed index directory)
  (let ((state (sb-ext:seed-random-state seed)) (found 0) (planned 0) (grasped 0)
        (*read-default-float-format* 'double-float))
    (loop while (< found count)
          do (let* ((plan (supergrip:plan (a-box state) :index index))
                    (best (supergrip:plan-best plan)))
               (incf planned)
               (multiple-value-bind (radius worst) (when best (radius-of best plan))
                 (when best (incf grasped))
                 (when (and radius (> radius 1.05d0))
                   (let ((file (format nil "~a/~d.xml" directory (incf found))))
                     (with-open-file (out file :direction :output :if-exists :supersede
                                               :external-format :utf-8)
                       (write-string (supergrip::mjcf-text plan) out))
                     (put-case found best plan radius worst file))))))
    (format *error-output* "~d boxes, seed ~d: ~d with a grasp, ~d with a radius above 1.05~%"
            planned seed grasped found)))

(destructuring-bind (count seed index directory) (rest sb-ext:*posix-argv*)
  (run (parse-integer count) (parse-integer seed) (intern (string-upcase index) :keyword)
       directory))
