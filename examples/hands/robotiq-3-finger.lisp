;;;; robotiq-3-finger.lisp -- the Robotiq 3-Finger Adaptive Gripper.
;;;;
;;;;   sbcl --script examples/batch.lisp --gripper examples/hands/robotiq-3-finger.lisp FILE
;;;;
;;;; Sources.  [M] Robotiq, 3-Finger Adaptive Robot Gripper, Instruction Manual, 2014.
;;;; [U] Its model of the ROS-Industrial project, robotiq_3f_gripper_visualization, the files
;;;; robotiq-3f-gripper_articulated_macro.xacro (palm) and
;;;; robotiq-3f-gripper_finger_articulated_macro.xacro (finger).
;;;; "Chosen" is what no sheet gives: measure it on your gripper.

(SETQ GRIPPER
  '(MODEL "Robotiq 3-Finger"
    FINGER-LENGTH 5.7     ; cm, [U] finger, joint_2: first link (5.0, 2.8) long.  The paper's fingers
                          ; have two equal links; the two outer ones of this finger count as one
    FINGER-DIST   9.1     ; cm, [U] palm: the bases are at -4.55 and 4.55
    FINGER-SPREAD 7.2     ; cm, [U] palm: two fingers side by side at -3.6 and 3.6
    FINGER-WIDTH  1.0     ; cm, chosen: half a fingertip, which is some 2 cm wide
    DIST-PINCH    15.5    ; cm, [M] specifications: opening 0 to 155 mm
    WIDTH-HAND    9.7     ; cm, chosen: FINGER-SPREAD and the width of a finger, 2.5
    REACH-U       8.0     ; cm, chosen: 0.78 (FINGER-DIST / 2 + FINGER-LENGTH), as the paper's hand
    REACH-C       8.0     ; cm, chosen: as REACH-U
    SLIPPERY-U    0.1     ; chosen: as grasps.lisp, for the same reason
    FINGER-FORCE  60      ; N, [M] page 47: minimum force 15 N, maximum force 60 N
    PALM-DEPTH    8.75))  ; cm, [U] palm, joint palm_tool0
