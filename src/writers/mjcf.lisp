;;;; mjcf.lisp -- the best grasp of a box as a model for MuJoCo: one file a box.
;;;;
;;;; The box floats free.  The frame of the world is that of the box, and gravity points as it does
;;;; for the box.  Each finger is a ball on a slider along its contact's normal, driven by a force.
;;;; Friction is that of the box.  The units are metres, kilograms and newtons.
;;;;
;;;; Source: MuJoCo documentation, "Computation" (friction cones) and "XML Reference".

(in-package :supergrip)

(defparameter +model-kind+ "a model for MuJoCo" "What messages call the files.")

(defconstant +free-fall+ 9.80665d0 "Standard gravity, in m/s^2.")

(defun xml-text (text)
  "Return TEXT, a string, as it may stand in an attribute of XML."
  (with-output-to-string (out)
    (loop for character across (visible-text text)
          for name = (cdr (assoc character '((#\& . "&amp;") (#\< . "&lt;") (#\> . "&gt;")
                                             (#\" . "&quot;"))))
          do (if name (write-string name out) (write-char character out)))))

(defun spaced (numbers) (numbers-in-text numbers " "))

;;; How hard the fingers press

(defun normals-wrench (contacts)
  "Return the wrench of fingers at CONTACTS that all press with 1, without friction."
  (reduce (lambda (a b) (mapcar #'+ a b))
          (loop for contact in contacts
                for normal = (getf contact :normal)
                collect (append normal (cross-product (getf contact :position) normal)))))

(defun press-at-least (contacts box least wrench)
  "Return the normal forces with which the fingers at CONTACTS exert WRENCH on BOX if each presses
with at least LEAST, 0 to below 1, and uses no friction of that; NIL if they can't.  Friction force
and torque are coupled, as MuJoCo has them."
  (let* ((share (- 1d0 least))          ; what is left of each finger's force
         (rest (mapcar (lambda (whole pressed) (/ (- whole (* least pressed)) share))
                       wrench (normals-wrench contacts)))
         (forces (contact-forces (loop for contact in contacts
                                       collect (list (getf contact :position)
                                                     (getf contact :normal)))
                                 (box-friction box) (box-soft-friction box) rest :coupled t)))
    (loop for (force) in forces
          for contact in contacts
          collect (+ least (* share (max 0d0 (min 1d0 (dot-product force
                                                                   (getf contact :normal)))))))))

(defun pressing (contacts box wrench)
  "Return the normal forces, 0 to 1, with which the fingers at CONTACTS exert WRENCH on BOX, the
finger that presses least as hard as it can; NIL if they can't exert it."
  (let ((best (press-at-least contacts box 0d0 wrench)) (low 0d0) (high 1d0))
    (when best
      (loop repeat 8
            do (let* ((least (/ (+ low high) 2))
                      (forces (press-at-least contacts box least wrench)))
                 (if forces
                     (setf best forces low least)
                     (setf high least)))))
    best))

;;; The file

(defun put-model-head (plan candidate newtons line out)
  "Write what stands before the bodies to OUT; NEWTONS is the greatest force of a finger of PLAN."
  (let* ((box (plan-box plan)) (weight (box-weight box)))
    (format out "<!-- By SUPER-GRIP~@[, for the box in line ~d~].  Metres, kilograms, newtons; the ~
                 world is the frame of the box.~%     A finger presses with ~a N at most~:[: the ~
                 gripper has no FINGER-FORCE, so 1 N was taken~;~]. -->~%"
            line (number-in-text newtons) (finger-newtons plan))
    (format out "<mujoco model=\"~a\">~%  <custom>~%    <text name=\"grasp\" data=\"~a\"/>~%  ~
                 </custom>~%"
            (xml-text (or (box-name box) "box")) (xml-text (grasp-words candidate)))
    (format out "  <option timestep=\"0.001\" integrator=\"implicitfast\" gravity=\"~a\" ~
                 cone=\"elliptic\" impratio=\"100\" noslip_iterations=\"20\"/>~%"
            (spaced (mapcar (lambda (part) (if (zerop weight) 0d0 (* +free-fall+ part)))
                            (box-down box))))
    (format out "  <default>~%    <geom condim=\"4\" friction=\"~a 0\" solref=\"0.005 1\" ~
                 solimp=\"0.999 0.9999 0.0001\"/>~%  </default>~%"
            (spaced (list (box-friction box) (/ (box-soft-friction box) 100d0))))))

(defun put-mass-centre (box mass out)
  "Write to OUT how MASS, in kg, lies in BOX if its centre of mass is not its centre: as an even box
of this size turns about its centre."
  (let ((centre (metres (box-centre box))) (sizes (metres (box-size box))))
    (unless (every #'zerop centre)
      (format out "      <inertial pos=\"~a\" mass=\"~a\" diaginertia=\"~a\"/>~%" (spaced centre)
              (number-in-text mass)
              (spaced (destructuring-bind (x y z) (mapcar (lambda (size) (* size size)) sizes)
                        (mapcar (lambda (sum) (/ (* mass sum) 12))
                                (list (+ y z) (+ z x) (+ x y)))))))))

(defun put-box-body (box newtons out)
  "Write the body of BOX to OUT; a finger presses with NEWTONS at most.  A body needs a mass:
without weight it is as of a hundredth of a finger force."
  (let ((mass (/ (* newtons (if (zerop (box-weight box)) 0.01d0 (box-weight box))) +free-fall+)))
    (format out "    <body name=\"box\">~%      <freejoint name=\"box\"/>~%")
    (put-mass-centre box mass out)
    (format out "      <geom name=\"box\" type=\"box\" size=\"~a\" mass=\"~a\" contype=\"1\" ~
                 conaffinity=\"2\" rgba=\"0.8 0.6 0.4 1\"/>~%    </body>~%"
            (spaced (metres (mapcar (lambda (size) (/ size 2)) (box-size box))))
            (number-in-text mass))))

(defun tip-radius (box)
  "Return the radius of the fingertips on BOX, in cm."
  (min 0.2d0 (/ (reduce #'min (box-size box)) 10)))

(defun put-finger-body (contact radius newtons out)
  "Write the body of the finger of CONTACT, a ball of RADIUS, in cm, that touches the box, to OUT."
  (let ((name (getf contact :finger)) (normal (getf contact :normal)))
    (format out "    <body name=\"~a\" pos=\"~a\" gravcomp=\"1\">~%" name
            (spaced (metres (mapcar (lambda (place part) (- place (* radius part)))
                                    (getf contact :position) normal))))
    (format out "      <joint name=\"~a\" type=\"slide\" axis=\"~a\" damping=\"~a\"/>~%" name
            (spaced normal) (number-in-text (* 10 newtons)))
    (format out "      <geom name=\"~a\" type=\"sphere\" size=\"~a\" mass=\"~a\" contype=\"2\" ~
                 conaffinity=\"1\" rgba=\"0.3 0.3 0.3 1\"/>~%    </body>~%"
            name (number-in-text (/ radius 100d0)) (number-in-text (/ newtons 10)))))

(defun mjcf-text (plan &optional line (contacts (candidate-contacts (plan-best plan) plan)))
  "Return the best grasp of PLAN, of the box in LINE, as a model for MuJoCo; its fingers are at
CONTACTS.  The key \"hold\" has the forces of the fingers that hold the weight, the weakest as great
as can be."
  (let* ((best (plan-best plan)) (box (plan-box plan))
         (newtons (or (finger-newtons plan) 1d0)) (limit (number-in-text newtons))
         (forces (pressing contacts box (mapcar #'- (box-gravity box)))))
    (with-output-to-string (out)
      (put-model-head plan best newtons line out)
      (format out "  <worldbody>~%")
      (put-box-body box newtons out)
      (dolist (contact contacts)
        (put-finger-body contact (tip-radius box) newtons out))
      (format out "  </worldbody>~%  <actuator>~%")
      (dolist (contact contacts)
        (format out "    <motor name=\"~a\" joint=\"~:*~a\" ctrllimited=\"true\" ~
                     ctrlrange=\"0 ~a\"/>~%"
                (getf contact :finger) limit))
      (format out "  </actuator>~%  <keyframe>~%    <key name=\"hold\" ctrl=\"~a\"/>~%  ~
                   </keyframe>~%</mujoco>~%"
              (spaced (if forces
                          (mapcar (lambda (force) (* force newtons)) forces)
                          (mapcar (constantly 0d0) contacts)))))))
