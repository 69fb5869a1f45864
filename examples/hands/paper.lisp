;;;; paper.lisp -- the hand of the paper's session, as a gripper file.
;;;;
;;;;   sbcl --script examples/batch.lisp --gripper examples/hands/paper.lisp examples/boxes.lisp
;;;;
;;;; The lengths are those of grasps.lisp, which says what the paper's session fixes of them and
;;;; what is chosen.

(SETQ GRIPPER
  '(MODEL "the paper's hand"
    FINGER-LENGTH 3.2     ; cm, grasps.lisp
    FINGER-DIST   6.05    ; cm, grasps.lisp
    FINGER-SPREAD 1.7375  ; cm, grasps.lisp
    FINGER-WIDTH  0.3     ; cm, grasps.lisp
    DIST-PINCH    12      ; cm, grasps.lisp
    WIDTH-HAND    8       ; cm, grasps.lisp
    REACH-U       4.85    ; cm, grasps.lisp
    REACH-C       4.825   ; cm, grasps.lisp
    SLIPPERY-U    0.1     ; grasps.lisp
    FINGER-FORCE  20      ; N, chosen: the paper names no force; a person pinches with some 40 N
    PALM-DEPTH    6.4))   ; cm, chosen: both links of a stretched finger, 2 x 3.2
