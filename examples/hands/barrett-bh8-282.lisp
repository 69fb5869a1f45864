;;;; barrett-bh8-282.lisp -- the BarrettHand BH8-282.
;;;;
;;;;   sbcl --script examples/batch.lisp --gripper examples/hands/barrett-bh8-282.lisp FILE
;;;;
;;;; Sources.  [U] The model of the hand in the repository jhu-lcsr/barrett_model, models/hand.urdf.xacro.
;;;; [D] Barrett Technology, data sheet of the BH8-series, quoted at second hand: compare it with the
;;;; sheet of your hand.
;;;; "Chosen" is what no sheet gives: measure it on your hand.

(SETQ GRIPPER
  '(MODEL "BarrettHand BH8-282"
    FINGER-LENGTH 5.8     ; cm, [U] the outer link: its tip's axis at 5.05, its radius 0.65, less the
                          ; pad's slope.  The inner one has 7.0; both count as the shorter
    FINGER-DIST   10.0    ; cm, [U] the knuckles are 5.0 from the middle on either side
    FINGER-SPREAD 5.0     ; cm, [U] the axes of spread are at -2.5 and 2.5
    FINGER-WIDTH  0.65    ; cm, chosen: half a fingertip, whose radius is 0.65 [U]
    DIST-PINCH    20      ; cm, derived: with outer links upright an inner one leans out by 33.75
                          ; degrees (outer: 45 degrees and a third of it [U]), so 2 (5.0 + 7.0 cos
                          ; 33.75), less 2 x 0.8 for the links' thickness
    WIDTH-HAND    7.4     ; cm, [U] FINGER-SPREAD and the width of a finger, 2.4
    REACH-U       8.4     ; cm, chosen: 0.78 (FINGER-DIST / 2 + FINGER-LENGTH), as the paper's hand
    REACH-C       8.4     ; cm, chosen: as REACH-U
    SLIPPERY-U    0.1     ; chosen: as grasps.lisp, for the same reason
    FINGER-FORCE  15      ; N, [D] finger force at the tip, active
    PALM-DEPTH    12.0))  ; cm, [U] bhand_grasp_joint
