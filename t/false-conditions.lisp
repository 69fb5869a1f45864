;;;; false-conditions.lisp -- the nearest miss: what is false of it, how far off, in words.

(in-package :supergrip-test)
(define-suite false-conditions "The nearest miss: what is false of it, how far off, in words.")

(defun reason-of (size u constrained &key (weight 0.1d0))
  "Return the reason that no grasp is possible, from the nearest miss on."
  (let ((reason (supergrip:plan-reason (plan-of size u constrained :weight weight))))
    (subseq reason (+ 2 (search ": " reason)))))

(test the-nearest-miss-tells-all-that-is-false-in-words
  (loop for (size u constrained . reason) in
        '(((30 20 15) 0.6d0 (z2)
           . "PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1): the narrowest free pair, Y, is 20 cm; the hand opens to 12")
          ((30 20 15) 0.72d0 (z2)
           . "PINCH-3-U-SHAPE (X1 X2 Y2 Y1 Z2 Z1): the narrowest free pair, Y, is 20 cm; the hand opens to 12")
          ((20 30 12.00001d0) 1.5d0 (x2)
           . "PINCH-3-U-SHAPE (Y1 Y2 Z2 Z1 X2 X1): the narrowest free pair, Z, is 12.00001 cm; the hand opens to 12")
          ((20 30 12) 1.5d0 (x2)
           . "PINCH-3-U-SHAPE (Y1 Y2 Z2 Z1 X2 X1): the narrowest free pair, Z, is 12 cm; the hand holds less than 12")
          ((15 20 15.9d0) 0.8d0 (x1 y1 z2)
           . "PINCH-3-CORNER (Z1 Z2 X2 X1 Y2 Y1): the finger places on Y2 and Z1 are 12.78 cm apart, the hand opens to 12; the finger places on X2 and Y2 are 12.5 cm apart, the hand opens to 12")
          ((4 4 4) 0.70710678d0 (z2 y2 x2)
           . "PINCH-3-CORNER (Z1 Z2 X1 X2 Y1 Y2): u is 0.70710678, must be > 0.707106781")
          ((4 4 4) 0.8d0 (z2 z1 y2 x2)
           . "PINCH-2-ADJACENT (Y1 Y2 X1 X2 Z2 Z1): Z2 and Z1 are 4 cm apart, the hand needs more than 8, and Z2 and Z1 are both constrained; u is 0.8, must be > 1"))
        do (is (equal reason (reason-of size u constrained))))
  (is (equal "PINCH-3-CORNER (Y2 Y1 X1 X2 Z1 Z2): the finger places on Y2 and X1 are 18.03 cm apart, the hand opens to 12; the finger places on X1 and Z1 are 16.77 cm apart, the hand opens to 12; u is 0.6, must be > 0.7071; the finger places on Z1 and Y2 are 12.5 cm apart, the hand opens to 12."
             (why-not-line (plan-of '(30 20 15) 0.6d0 '(z2)) 'pinch-3-corner))))

(defun condition-words (conditions)
  "Return what is said to be false of CONDITIONS, a list, in a grasp on the pencil, N1 being Z2."
  (with-knowledge-restored
    (handler-bind ((supergrip:knowledge-warning #'muffle-warning))
      (supergrip:edit '(defun width (a b) (+ a (* 0 b))))
      (supergrip:edit `(setq odd '(used-surfaces (o1 a1) conditions ,conditions
                                   offset (0 0 0 0 0 0) wrench (1 1 1 1 1 1) twist (1 1 1 1 1 1)
                                   contacts ((o1 0 0)) palm a1)))
      (let* ((plan (supergrip:try-grasp 'odd (paper-box)))
             (candidate (find '("Z2" "Z1") (supergrip:plan-candidates plan) :test #'equal
                              :key (lambda (candidate)
                                     (subseq (supergrip:candidate-matching candidate) 0 2)))))
        (nth-value 1 (supergrip:candidate-failure candidate plan))))))

(test false-parts-are-told-whatever-they-look-like
  ;; Z2 and Z1 are 2 cm apart, and Z2 is constrained.
  (loop for (conditions . words) in
        '((((dist '(n1 n2)) > dist-pinch) . "Z2 and Z1 are 2 cm apart, must be > 12 (DIST-PINCH)")
          ((> 1 (dist '(n1 n2))) . "Z2 and Z1 are 2 cm apart, must be < 1")
          ((finger-width > (dist '(n2 n1)))
           . "Z2 and Z1 are 2 cm apart, must be < 0.3 (FINGER-WIDTH)")
          ((not ((dist '(n1 n2)) <= dist-pinch))
           . "Z2 and Z1 are 2 cm apart, must be > 12 (DIST-PINCH)")
          ((not (or (constrained n1) (u > 0.5)))
           . "Z2 is constrained; u is 0.8, must be <= 0.5")
          ((and (not (constrained n1)) (constrained n2) (v = 0.2))
           . "Z2 is constrained; Z1 is not constrained")
          ((or (u > 1) (v > 1)) . "u is 0.8, must be > 1, and v is 0.2, must be > 1")
          (((sqrt
             (+ (* (/ (dist '(n1 n2)) 2) (/ (dist '(n1 n2)) 2)) (expt (* 1/2 (dist '(o1 o2))) 2)))
            > dist-pinch)
           . "the finger places on Z2 or Z1 and X2 are 6.083 cm apart, must be > 12 (DIST-PINCH)")
          (((width (dist '(n1 n2)) u) > width-hand)
           . "what the conditions compute from u, Z2 Z1 is 2, must be > 8 (WIDTH-HAND)")
          (((/ 1 (- u (* 4 v))) > 0) . "a form of CONDITIONS has no value")
          ((u = 0.9) . "u is 0.8, must be = 0.9")
          ((not (u = 0.8)) . "u is 0.8, must be other than 0.8"))
        do (is (equal words (condition-words conditions)) "~s: ~a" conditions
               (condition-words conditions))))

(defun conditions-fault (box)
  "Return a candidate for BOX whose faults are not what TRY found."
  (dolist (grasp (supergrip:knowledge-grasps supergrip:*knowledge*))
    (let ((plan (supergrip:try-grasp grasp box)))
      (supergrip::with-workspace (workspace plan)
        (dolist (candidate (supergrip:plan-candidates plan))
          (let ((faults (supergrip::candidate-faults candidate workspace)))
            (unless (eq (null faults)
                        (not (eq :conditions (supergrip:candidate-outcome candidate))))
              (return-from conditions-fault (princ-to-string candidate)))
            (when (and faults
                       (search "EXPT" (nth-value 1 (supergrip:candidate-failure candidate plan))))
              (return-from conditions-fault "a form"))))))))

(test what-is-false-is-what-try-found
  (is (null (first-fault #'conditions-fault (random-boxes 500 41)))))

(defun turned-box (size u constrained face-map)
  "Return the plan of a box as PLAN-OF makes it, its axes and faces as FACE-MAP, an alist, says."
  (flet ((face (face) (second (assoc face face-map))))
    (let ((axes (loop for face in '(x1 y1 z1) collect (char (string (face face)) 0))))
      (plan-of (loop for axis across "XYZ" collect (nth (position axis axes) size)) u
               (mapcar #'face constrained) :force '(1 1 1 1 1 1)))))

(defun all-figures (text)
  "Return the numbers in TEXT, sorted."
  (sort (loop with position = 0
              for start = (position-if #'digit-char-p text :start position)
              while start
              do (setf position (or (position-if-not (lambda (character)
                                                       (or (digit-char-p character)
                                                           (find character ".e")))
                                                     text :start start)
                                    (length text)))
              unless (find (char text (max 0 (1- start))) "XYZNOA-")
                collect (subseq text start position))
        #'string<))

(test a-box-turned-or-mirrored-misses-by-the-same
  (let ((maps '(((x1 y1) (x2 y2) (y1 x1) (y2 x2) (z1 z1) (z2 z2))
                ((x1 y2) (x2 y1) (y1 x1) (y2 x2) (z1 z1) (z2 z2))
                ((x1 x2) (x2 x1) (y1 y1) (y2 y2) (z1 z1) (z2 z2))
                ((x1 y1) (x2 y2) (y1 x1) (y2 x2) (z1 z2) (z2 z1))))
        (state (sb-ext:seed-random-state 43)) (misses 0))
    (is (null
         (loop repeat 1500
               for size = (loop repeat 3 collect (* 0.5d0 (1+ (random 60 state))))
               for u = (* 0.05d0 (+ 3 (random 30 state)))
               for constrained = (loop for face in '(x1 x2 y1 y2 z1 z2)
                                       when (zerop (random 3 state)) collect face)
               for reason = (supergrip:plan-reason (plan-of size u constrained
                                                            :force '(1 1 1 1 1 1)))
               when (and reason (search "MISS" reason))
                 do (incf misses)
                 and append (loop for map in maps
                                  for other = (supergrip:plan-reason
                                               (turned-box size u constrained map))
                                  unless (equal (all-figures reason) (all-figures other))
                                    collect (list size u constrained reason other)))))
    (is (> misses 300) "only ~d misses" misses)))
