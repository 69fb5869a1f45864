;;;; The pictures of docs/, and a report on the pencil:
;;;;
;;;;   sbcl --script examples/figures.lisp [DIRECTORY]
;;;;
;;;; draws them into DIRECTORY, by default docs/ of this repository.  Needs cl-who.

(load (merge-pathnames "../src/draw/boot.lisp" *load-truename*))
(in-package :supergrip-user)

(defparameter *pencil*
  '((SIZE 12 2 2)
    (WEIGHT 0.2)
    (u 0.8)
    (v 0.2)
    (CONSTRAINED Z2 X1)
    (FORCE-NEEDED (1 0.8 0.8 0.3 1 1))
    (VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8))
    (NAME "pencil")))

(defparameter *credit-card*
  '((SIZE 8.6 5.4 0.08)
    (WEIGHT 0.005)
    (u 0.4)
    (v 0.13)
    (CONSTRAINED X2)
    (FORCE-NEEDED (1 0.3 0.3 0.3 0 0.3))
    (VELOCITY-NEEDED (1 0.3 0.3 0 0 0.5))
    (NAME "credit card over the edge of a table")))

(defparameter *carton*
  '((SIZE 7 7 20)
    (WEIGHT 0.4)
    (u 0.6)
    (v 0.2)
    (CONSTRAINED Y2 Z2)
    (FORCE-NEEDED (0.3 1 0.6 0.2 0.2 0.2))
    (VELOCITY-NEEDED (0.3 1 0.5 0.5 0 0.3))
    (POSE (60 0 90) (0.353553391 -0.353553391 -0.612372436 0.612372436))
    (CENTRE 0 0 -1)
    (NAME "carton on a chute")))

(defparameter *toy-block*
  '((SIZE 4 4 4)
    (WEIGHT 0.04)
    (u 0.5)
    (v 0.17)
    (CONSTRAINED Z2)
    (FORCE-NEEDED (0.5 0.5 1 0.2 0.2 0.4))
    (VELOCITY-NEEDED (1 1 0.7 0 0 0.3))
    (NAME "toy block")))

(let* ((given (second sb-ext:*posix-argv*))
       (directory (if given
                      (uiop:ensure-directory-pathname (merge-pathnames given (uiop:getcwd)))
                      (merge-pathnames "docs/" supergrip::*home*)))
       (pencil (supergrip:plan *pencil*)))
  (flet ((file (name) (merge-pathnames name directory)))
    (dolist (file (list (supergrip-draw:draw-grasps (file "grasps.svg"))
                        (supergrip-draw:draw-offset (file "offset.svg"))
                        (supergrip-draw:draw-gripper
                         (file "gripper.svg")
                         :knowledge (supergrip:load-knowledge
                                     :gripper (merge-pathnames "examples/hands/robotiq-3-finger.lisp"
                                                               supergrip::*home*)))
                        (supergrip-draw:draw-system (file "system.svg"))
                        (supergrip-draw:draw-session pencil (file "session.svg"))
                        (supergrip-draw:draw-plan pencil (file "pencil.svg"))
                        (supergrip-draw:draw-plan (supergrip:plan *credit-card*)
                                                  (file "credit-card.svg"))
                        (supergrip-draw:draw-plan (supergrip:plan *carton*) (file "carton.svg"))
                        (supergrip-draw:draw-quality pencil (file "quality.svg"))
                        (supergrip-draw:draw-section pencil (file "section.svg"))
                        (supergrip-draw:draw-refinement
                         (supergrip:refine (supergrip:plan *toy-block*) :count 1)
                         (file "refinement.svg"))
                        (supergrip-draw:report pencil (file "pencil.html"))))
      (format t "~a~%" (file-namestring file)))))
