;;;; formats.lisp -- grasps in the formats of other programs, and models, one file a box.

(in-package :supergrip-test)
(define-suite formats "Grasps in the formats of other programs, and models, one file a box.")

(defun python ()
  "Return the Python that the checks in Python run by: that of the environment's PYTHON, or
python3."
  (or (uiop:getenv "PYTHON") "python3"))

(defun written-as (format plan &optional most)
  (supergrip::written-plan (supergrip::find-writer format) plan most))

(test what-others-read-is-read-by-others
  "Random boxes in all formats, read by PyYAML, numpy and MuJoCo as far as they are there."
  (if (zerop (run-process (list "sh" "-c" (format nil "~a -c 'import numpy'" (python)))))
      (multiple-value-bind (status output errors)
          (run-process (list (python) (uiop:native-namestring (project-file "t/formats.py"))
                             "--boxes" "36" "--program" (program)))
        (is (eql 0 status) "~a~a" output errors)
        (is (search "agree" output)))
      (skip "no numpy")))

(test the-pencil-in-each-format
  (let ((plan (supergrip:plan (cons '(:name "pencil") *good-box*))))
    (is (equal (list "---" "format: isaac_grasp" "format_version: 1.0" "" "object_frame: \"pencil\""
                     "gripper_frame: \"palm\"" "" "grasps:"
                     "  \"grasp_0\":  # PINCH-3-PARALLEL Y2 Y1 X2 X1 Z2 Z1"
                     "    confidence: 0.4623655913978495" "    position: [0.0, 0.0, 0.0]")
               (subseq (lines-of (written-as :isaac plan 1)) 0 11)))
    (is (search "[[0.0, -1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 0.0, "
                (written-as :graspgen plan 1)))
    (let ((moveit (written-as :moveit plan 2)))
      (is (= 2 (count "---" (lines-of moveit) :test #'string=)))
      (is (search "id: \"pencil: PINCH-3-PARALLEL Y2 Y1 X2 X1 Z2 Z1\"" moveit))
      (is (search "desired_distance: 0.06
  min_distance: 0.01" moveit) "its fingertips are 1 cm below the top"))
    (let ((model (supergrip::mjcf-text plan 3)))
      (is (search "for the box in line 3" model))
      (is (search "no FINGER-FORCE, so 1 N was taken" model))
      (is (search "<key name=\"hold\" ctrl=\"" model)))))

(test how-a-box-lies-is-in-its-model
  (let* ((plan (supergrip:plan (list* '(:pose (0 0 50) (1 0 0 0)) '(:centre 1 0 0.5d0) *good-box*)))
         (model (supergrip::mjcf-text plan)))
    (is (search "gravity=\"0.0 0.0 9.80665\"" model) "it stands on its head")
    (is (search "<inertial pos=\"0.01 0.0 0.005\"" model))
    (is (search "post_grasp_retreat:
  direction: {header: {frame_id: \"\"}, vector: {x: 0.0, y: 0.0, z: -1.0}}"
                (written-as :moveit plan 1)))
    (is (not (search "<inertial" (supergrip::mjcf-text (pencil-plan)))))
    (is (search "gravity=\"0.0 0.0 0.0\""
                (supergrip::mjcf-text (supergrip:plan (changed-box :weight 0)))))))

(test a-model-may-have-its-fingers-elsewhere
  (let* ((plan (pencil-plan))
         (contacts (supergrip:candidate-contacts (supergrip:plan-best plan) plan))
         (moved (substitute (list* :position '(-1 -1 0) (first contacts)) (first contacts) contacts)))
    (is (equal (supergrip::mjcf-text plan) (supergrip::mjcf-text plan nil contacts)))
    (let ((model (supergrip::mjcf-text plan nil moved)))
      (is (search "<body name=\"F1\" pos=\"-0.01 -0.012 0.0\"" model))
      (is (search "<body name=\"F2\" pos=\"0.0086875 -0.012 0.0\"" model)))))

(test fingers-press-as-hard-as-they-can-and-hold-the-weight
  "By statics alone: what the fingers press holds the weight, and none can press more than its
share."
  (let ((checked 0))
    (for-random-boxes (box 40 45)
      (let* ((plan (supergrip:plan box :index :exact)) (best (supergrip:plan-best plan)))
        (when best
          (let* ((contacts (supergrip:candidate-contacts best plan))
                 (box (supergrip:plan-box plan))
                 (weight (map 'list #'- (supergrip::gravity-on box)))
                 (forces (supergrip::pressing contacts box weight)))
            (when forces
              (incf checked)
              (is (every (lambda (force) (<= 0 force 1)) forces))
              (let ((more (+ (reduce #'min forces) 0.01d0)))
                (is (or (>= more 0.99d0)
                        (null (supergrip::press-at-least contacts box more weight))))))))))
    (is (< 5 checked))
    (is (close-to '(0.5d0 0.5d0 1d0)
                  (let ((plan (pencil-plan)))
                    (supergrip::pressing
                     (supergrip:candidate-contacts (supergrip:plan-best plan) plan)
                     (supergrip:plan-box plan) '(0 0 0.2d0 0 0 0)))
                  1d-2))))

(test confidence-is-the-certified-radius-in-exact-mode
  (let ((exact (supergrip:plan *good-box* :index :exact))
        (paper (supergrip:plan *good-box*)))
    (flet ((confidence (plan) (supergrip::confidence (supergrip:plan-best plan) plan)))
      (is (= (confidence exact) (supergrip:candidate-force-radius (supergrip:plan-best exact))))
      (is (= 1 (confidence (supergrip:plan (changed-box :force-needed '(0.1d0 0 0 0 0 0))
                                           :index :exact))))
      (is (close-to (/ 0.86d0 1.86d0) (confidence paper)))
      (let* ((knowledge (text-knowledge (file-text "rules.lisp")
                                        (replace-once (file-text "grasps.lisp") "'(FINGER-LENGTH"
                                                      "'(FINGER-FORCE 10 FINGER-LENGTH")))
             (absolute (supergrip:plan '((:units :cm :n) (:size 12 2 2) (:weight 2) (:u 0.8d0)
                                         (:v 0.2d0) (:constrained :z2 :x1)
                                         (:force-needed (10 8 8 3 10 10))
                                         (:velocity-needed (0 0.8d0 0.8d0 0 0.8d0 0.8d0)))
                                       :knowledge knowledge)))
        (is (close-to (confidence exact) (confidence absolute)))
        (is (search "mass=\"0.203" (supergrip::mjcf-text absolute)) "2 N")
        (is (search "ctrlrange=\"0 10.0\"" (supergrip::mjcf-text absolute)))))))

(test a-box-without-a-grasp-is-told-and-its-document-is-empty
  (let ((pencil (one-line *pencil*)))
    (with-text-file (boxes (format nil "~a~%((NAME \"a \\\"b\\\"\") ~a~%((NAME \"c\") (SIZE 1))~%"
                                   pencil
                                   (subseq (changed pencil "0.2" "1000") 1)))
      (flet ((written (format)
               (destructuring-bind (status output errors)
                   (shell (format nil "\"$0\" --format ~a --all 1 \"$1\"" format) boxes)
                 (is (eql 65 status))
                 (let ((notes (remove-if-not (lambda (line) (search "no grasp for" line))
                                             (lines-of errors))))
                   (is (= 2 (length notes)) "~a" errors)
                   (is (eql 0 (search "supergrip: line 2, \"a \\\"b\\\"\": no grasp for "
                                      (first notes))))
                   (is (search "WEIGHT is missing" (second notes))))
                 output)))
        (let ((isaac (lines-of (written "isaac"))))
          (is (= 3 (count "---" isaac :test #'string=)))
          (is (= 2 (count "grasps: {}" isaac :test #'string=)))
          (is (find "object_frame: \"a \\\"b\\\"\"" isaac :test #'string=)))
        (is (= 3 (count "---" (lines-of (written "moveit")) :test #'string=)))
        (is (= 3 (length (lines-of (written "graspgen")))))))))

(test palms-inside-the-box-are-told-of
  (let* ((knowledge (supergrip:load-knowledge
                     :gripper (project-file "examples/hands/robotiq-3-finger.lisp")))
         (tall '((size 20 8.5 30) (weight 0.08) (u 0.6) (v 0.32) (constrained z2)
                 (force-needed (0.1 0.1 0.1 0.2 0.2 0.2)) (velocity-needed (0 0 0 0 0 0))))
         (plan (supergrip:plan tall :knowledge knowledge))
         (pencil (supergrip:plan (paper-box) :knowledge knowledge)))
    (dolist (candidate (supergrip:plan-possible plan))
      ;; The palm's own place, which the formats write, against the face that it is over.
      (let* ((axis (position-if-not #'zerop (supergrip:candidate-approach candidate)))
             (hand (supergrip:candidate-hand candidate plan))
             (place (abs (* 100 (nth axis (supergrip::palm-position hand candidate plan))))))
        (is (close-to (max 0 (- (/ (nth axis '(20 8.5 30)) 2) place))
                      (supergrip::palm-inside candidate plan)))))
    (is (search " inside the box, up to " (supergrip::palms-inside-text
                                           (supergrip:plan-possible plan) plan)))
    (let ((inside (find-if (lambda (candidate) (plusp (supergrip::palm-inside candidate plan)))
                           (supergrip:plan-possible plan))))
      (is (eql 0 (search "1 of 1 palm lies inside the box, up to "
                         (supergrip::palms-inside-text (list inside) plan)))))
    (is (null (supergrip::palms-inside-text (supergrip:plan-possible pencil) pencil)))
    (is (null (supergrip::palms-inside-text (supergrip:plan-possible (supergrip:plan tall))
                                            (supergrip:plan tall)))
        "the shipped gripper names no PALM-DEPTH")))

(test models-have-safe-names-of-their-own
  (let ((names '("a b" "A/B" "../../x" "" "..." "a-b-2" "café" "a b")))
    (with-text-file (boxes (format nil "~{((NAME ~s) ~a~%~}"
                                   (loop for name in names
                                         collect name
                                         collect (subseq (one-line *pencil*) 1))))
      (destructuring-bind (status output errors)
          (shell "mkdir \"$0.models\"; ln -s \"$1\" \"$0.models/caf.xml\"
                  \"$0\" --mjcf \"$0.models/in\" \"$1\" > /dev/null
                  mv \"$0.models/caf.xml\" \"$0.models/in\"
                  \"$0\" --mjcf \"$0.models/in/\" \"$1\" > /dev/null
                  cd \"$0.models\"; find . -type f | sort; head -c 4 in/caf.xml; rm -r \"$0.models\""
                 boxes)
        (declare (ignore status))
        (is (equal "" errors))
        (is (equal '("./in/a-b-2-2.xml" "./in/a-b-2.xml" "./in/a-b-3.xml" "./in/a-b.xml"
                     "./in/box-2.xml" "./in/box.xml" "./in/caf.xml" "./in/x.xml" "<!--")
                   (sort (lines-of output) #'string<)))))))

(test models-that-can-t-be-written-give-74
  (with-text-file (boxes *pencil*)
    (destructuring-bind (status output errors)
        (shell "touch \"$0.file\"; \"$0\" --mjcf \"$0.file\" \"$1\" 2>&1; echo $?
                mkdir -p \"$0.full/box.xml\"; \"$0\" --mjcf \"$0.full\" \"$1\" 2>&1 > /dev/null; echo $?
                rm -r \"$0.file\" \"$0.full\""
               boxes)
      (declare (ignore status errors))
      (is (= 2 (count "74" (lines-of output) :test #'string=)) "~a" output)
      (is (search "box.xml: can't be written" output)))))
