;;;; simulate.lisp -- the part of t/simulate.py in Lisp; no part of the tests.
;;;;
;;;; sbcl --script t/simulate.lisp COUNT SEED INDEX DIR [refine]
;;;;
;;;; Plans random boxes by INDEX, paper or exact, until COUNT of their best grasps have a certified
;;;; radius above 1.05, friction force and torque of a fingertip sharing its friction, as in MuJoCo.
;;;; Writes the model of each into DIR, and a line of JSON to standard output: what loads are tried,
;;;; and how hard the fingers press against each.  Newtons and metres; a finger presses with 1 N at
;;;; most.
;;;; With refine, only grasps whose fingers REFINE moves count, and both are tried: as planned, and
;;;; with the fingers moved.

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

(defstruct hold
  "CONTACTS, plists, that hold BOX, of the model in FILE; RADIUS, that of their task, certified, and
WORST, the motion in which they have least to spare, the friction force and the torque of a
fingertip sharing its friction; EXACT, the same with these independent, as is the default."
  contacts box radius worst file exact)

(defun hold-of (contacts box &key (coupled t))
  "Return the HOLD of CONTACTS on BOX, without EXACT, or NIL without a certified radius."
  (let ((need (supergrip:box-force-needed box)))
    (unless (every #'zerop need)
      (multiple-value-bind (upper lower worst)
          (supergrip:exact-radius (loop for contact in contacts
                                        collect (list (getf contact :position)
                                                      (getf contact :normal)))
                                  (supergrip:box-friction box) (supergrip:box-soft-friction box)
                                  need :coupled coupled :gravity (supergrip:box-gravity box))
        (declare (ignore upper))
        (when lower
          (make-hold :contacts contacts :box box :radius lower :worst worst))))))

(defun hold-of-both (contacts box)
  "Return the HOLD of CONTACTS on BOX, or NIL without both certified radii."
  (let ((hold (hold-of contacts box)))
    (and hold
         (setf (hold-exact hold) (hold-of contacts box :coupled nil))
         hold)))

(defun hold-of-best (plan)
  "Return the HOLD of the best grasp of PLAN, or NIL without one."
  (let ((best (supergrip:plan-best plan)))
    (when best
      (hold-of-both (supergrip:candidate-contacts best plan) (supergrip:plan-box plan)))))

(defun hold-of-refined (plan)
  "Return the HOLD of the best grasp of PLAN with its fingers moved, or NIL if none has moved."
  (let ((refinement (supergrip:refine plan :count 1)))
    (when (supergrip:refinement-moved-p refinement)
      (hold-of-both (supergrip:refinement-contacts refinement) (supergrip:plan-box plan)))))

(defun index-radius (plan)
  "Return u_w of the best grasp of PLAN, made by any index: the least of (has - load) / need."
  (let ((best (supergrip:plan-best plan)))
    (loop for has in (supergrip:candidate-wrench best plan)
          for load in (supergrip:candidate-load best plan)
          for need in (supergrip:candidate-force-need best plan)
          when (plusp need) minimize (/ (- has load) need))))

(defun directions (hold)
  "Return the wrenches of the task of HOLD that are tried, each with its name: along and about the
axes, both ways, and the one against which it has least to spare in its worst motion."
  (let* ((need (supergrip:box-force-needed (hold-box hold))) (worst (hold-worst hold))
         (length (sqrt (reduce #'+ (mapcar (lambda (n q) (expt (* n q) 2)) need worst)))))
    (append
     (loop for axis below 6
           for n in need
           for name in '("X" "Y" "Z" "about X" "about Y" "about Z")
           when (plusp n)
             append (loop for (sign way) in '((1 "+") (-1 "-"))
                          collect (cons (format nil "~a~a" way name)
                                        (loop for i below 6
                                              collect (if (= i axis) (* sign n) 0d0)))))
     (list (cons "worst" (mapcar (lambda (n q) (/ (* n n q) length)) need worst))))))

(defun press (hold wrench)
  "Return how hard the fingers of HOLD press to exert WRENCH beside the weight; of what they can't
exert, the largest part that they can, if they can hold the weight."
  (let* ((contacts (hold-contacts hold)) (box (hold-box hold))
         (gravity (supergrip:box-gravity box)))
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

(defun put-loads (hold radius directions)
  "Write the loads of RADIUS in DIRECTIONS, and how the fingers of HOLD press against each."
  (loop for ((name . direction) . others) on directions
        for wrench = (mapcar (lambda (d) (* radius d)) direction)
        do (format t "{\"name\": ~s, \"load\": " name)
           ;; Against what the fingers exert, in N and N m.
           (put-numbers (loop for w in wrench for k below 6 collect (if (< k 3) (- w) (/ w -100))))
           (format t ", \"press\": ")
           (put-numbers (press hold wrench))
           (format t "}~:[~;, ~]" others)))

(defun put-try (what hold radius directions)
  "Write that HOLD is tried by the loads of RADIUS in DIRECTIONS, and WHAT this is called."
  (format t "{\"what\": ~s, \"model\": ~s, \"asked\": ~f, \"can\": ~f, \"loads\": ["
          what (hold-file hold) radius (hold-radius hold))
  (put-loads hold radius directions)
  (format t "]}"))

(defun try-gravity (what hold)
  "Return the arguments of PUT-TRY for HOLD under gravity alone."
  (list (format nil "~agravity" what) hold 0d0 '(("gravity" 0d0 0d0 0d0 0d0 0d0 0d0))))

(defun try-task (what hold radius &optional (from hold))
  "Return the arguments of PUT-TRY for HOLD under the task at 90 % of RADIUS, in the directions of
FROM.  WHAT are two parts of its name."
  (list (format nil "~athe task at 90 % of ~a" (first what) (second what)) hold (* 0.9d0 radius)
        (directions from)))

(defun tries-planned (plan hold)
  "Return what is tried with HOLD, the best grasp of PLAN."
  (list (try-gravity "" hold)
        (try-task '("" "the radius") hold (hold-radius hold))
        (try-task '("" "u_w") hold (index-radius plan))))

(defun tries-refined (hold refined)
  "Return what is tried with HOLD and with REFINED, its fingers moved."
  (append
   (loop for (what one) in `(("as planned: " ,hold) ("refined: " ,refined))
         collect (try-gravity what one)
         collect (try-task (list what "its radius") one (hold-radius one))
         collect (try-task (list what "its radius by default") one (hold-radius (hold-exact one))
                           (hold-exact one)))
   (list (try-task '("refined: " "the radius as planned") refined (hold-radius hold)))))

(defun write-model (plan hold directory name)
  "Write the model of HOLD of PLAN into DIRECTORY, and keep its name."
  (setf (hold-file hold) (format nil "~a/~a.xml" directory name))
  (with-open-file (out (hold-file hold) :direction :output :if-exists :supersede
                                        :external-format :utf-8)
    (write-string (supergrip::mjcf-text plan nil (hold-contacts hold)) out)))

(defun put-case (number plan hold refined directory)
  "Write the line of the case NUMBER: HOLD, the best grasp of PLAN, and REFINED, or NIL."
  (write-model plan hold directory number)
  (when refined (write-model plan refined directory (format nil "~d-refined" number)))
  (format t "{\"case\": ~d, \"grasp\": ~s, \"radius\": ~f, ~@[\"refined\": ~f, ~]\"u_w\": ~f, ~
             \"tries\": ["
          number (supergrip:plan-grasp plan) (hold-radius hold)
          (and refined (hold-radius refined)) (index-radius plan))
  (loop for (try . others) on (if refined (tries-refined hold refined) (tries-planned plan hold))
        do (apply #'put-try try)
           (format t "~:[~;, ~]" others))
  (format t "]}~%")
  (finish-output))

(defun run (count seed index directory refine)
  (let ((state (sb-ext:seed-random-state seed)) (found 0) (planned 0) (grasped 0)
        (*read-default-float-format* 'double-float))
    (loop while (< found count)
          do (let* ((plan (supergrip:plan (a-box state) :index index))
                    (hold (hold-of-best plan)))
               (incf planned)
               (when (supergrip:plan-best plan) (incf grasped))
               (when (and hold (> (hold-radius hold) 1.05d0))
                 (let ((refined (and refine (hold-of-refined plan))))
                   (when (or refined (not refine))
                     (put-case (incf found) plan hold refined directory))))))
    (format *error-output* "~d boxes, seed ~d: ~d with a grasp, ~d with a radius above 1.05~:[~; ~
                            whose fingers moved~]~%"
            planned seed grasped found refine)))

(destructuring-bind (count seed index directory &optional refine) (rest sb-ext:*posix-argv*)
  (run (parse-integer count) (parse-integer seed) (intern (string-upcase index) :keyword)
       directory (equal refine "refine")))
