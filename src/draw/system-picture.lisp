;;;; system-picture.lisp -- DRAW-SYSTEM: the block diagram, the paper's Figure 3.

(in-package :supergrip-draw)

(defparameter +blocks+
  '((box      24  76 190  64 "Box and task" "size, weight, friction, needs")
    (gripper  72 176 142  64 "Gripper" "grasps.lisp")
    (inputs  262  96 214 106 "Preliminary assertions" "OPPOSED, SMALL, NARROW,"
     "LARGE, CONSTRAINED," "SLIPPERY")
    (rules   262 246 214  64 "Rules" "rules.lisp")
    (chainer 524  96 196 214 "Forward chainer" "runs each rule once, in order;" "its actions:"
     "REMEMBER a fact" "TRY a grasp" "KEEP the best" "CANT: why not")
    (facts   824  96 170  64 "Assertions" "what is known so far")
    (verdict 824 226 170  84 "Plan" "the best grasp," "or why there is none")
    (grasps  262 396 214  64 "Grasps" "grasps.lisp")
    (try     524 376 196 196 "TRY, seven steps" "1 next of 24 matchings" "2 conditions"
     "3 offset, fingers" "4 wrench and twist" "5 lifting" "6 quality index" "7 store")
    (found   824 436 170  84 "POSSIBLE-GRASPS" "and those rejected," "with the reasons"))
  "Name, left, top, width, height, heading and lines of the blocks.")

(defparameter +flows+
  '(((214 108) (238 108) (238 130) (262 130))
    ((214 208) (238 208) (238 170) (262 170))
    ((476 150) (524 150))
    ((476 278) (524 278))
    ((720 118) (824 118) "remember" (0 -1))
    ((824 142) (720 142) "recall" (0 1))
    ((720 268) (824 268) "keep, can’t" (0 -1))
    ((622 310) (622 376) "try" (1 -0.5))
    ((476 428) (524 428))
    ((48 140) (48 526) (524 526))
    ((143 240) (143 492) (524 492))
    ((720 478) (824 478) "store" (0 -1))
    ((909 436) (909 310) "the best" (1 0)))
  "The points of each arrow, its word, and on which side that stands.")

(defun draw-block (x y width height heading lines)
  (draw-rectangle x y width height "block")
  (occupy (list x y width height))
  (draw-text heading (list (+ x 12) (+ y 24)) :class "bold")
  (loop for line in lines
        for below from (+ y 46) by 21
        do (draw-text line (list (+ x 12) below) :class "soft")))

(defun draw-flow (points)
  "Draw an arrow through POINTS."
  (destructuring-bind (before tip) (last points 2)
    (let* ((length (distance before tip))
           (back (along tip before (/ 9 length)))
           (across (list (/ (- (second tip) (second before)) length)
                         (/ (- (first before) (first tip)) length))))
      (draw-path (append (butlast points) (list back)) "edge")
      (draw-polygon (list tip (mapcar (lambda (p c) (+ p (* 4.5 c))) back across)
                          (mapcar (lambda (p c) (- p (* 4.5 c))) back across))
                    "contact"))))

(defun draw-levels ()
  "Draw the line between the two levels, and their names."
  (draw-line '(24 344) '(984 344) "hidden")
  (note-strokes '((24 344) (984 344)))
  (draw-text "upper level: which grasps are worth trying" '(262 335) :class "soft")
  (draw-text "lower level: which are possible, and how good" '(178 362) :class "soft"))

(defun system-picture ()
  "Return the block diagram."
  (with-picture (1008 596 "Block diagram"
                 "Box, task and gripper give preliminary assertions. The forward chainer runs the
rules on the assertions; its actions remember facts, try grasps, keep the best or say that the box
can't be grasped. TRY takes each matching of a grasp through seven steps and stores what is
possible, with its quality; the best of it is the plan.")
    (draw-heading "SUPER-GRIP" '("Rules generate, statics tests.") 1008)
    (draw-levels)
    (loop for (nil x y width height heading . lines) in +blocks+
          do (draw-block x y width height heading lines))
    (loop for flow in +flows+
          for end = (position-if #'stringp flow)
          for points = (subseq flow 0 end)
          do (draw-flow points)
             (note-strokes points)
             (when end
               (ask-for-label (nth end flow) (along (first points) (second points) 1/2)
                              :class "soft" :away 4 :toward (nth (1+ end) flow))))
    (place-labels '(8 60 992 530))))

(defun draw-system (file)
  "Draw how SUPER-GRIP works into FILE, an SVG picture: the paper's Figure 3.  Returns FILE."
  (drawing ("the block diagram") (save-picture (system-picture) file)))
