;;;; gripper.lisp -- the Robotiq 2F-85, a parallel jaw.
;;;;
;;;;   sbcl --script examples/batch.lisp --hand examples/hands/robotiq-2f-85 FILE
;;;;
;;;; Sources.  [M] Robotiq, 2F-85 and 2F-140 Instruction Manual, section 6, specifications.
;;;; [U] Its model of the ROS-Industrial project, robotiq_2f_85_gripper_visualization.
;;;; [J] Its model for MuJoCo, in the collection MuJoCo Menagerie, 2f85.xml.
;;;;
;;;; Two pads need two fingers' dimensions only: nothing is said of spread, links or reach.

(SETQ GRIPPER
  '(MODEL "Robotiq 2F-85"
    DIST-PINCH    8.5     ; cm, [M] stroke: 85 mm
    FINGER-WIDTH  0.5     ; cm, chosen: the least width of a face that a pad of 2.2 x 3.75 cm [U] holds
    FINGER-DEPTH  4.5     ; cm, chosen: from the middle of the pads to the palm
    WIDTH-HAND    2.7     ; cm, chosen: a finger's width, with 0.25 on either side of its pad of 2.2 [U]
    SLIPPERY-U    0.1     ; chosen: as the shipped hand's
    FINGER-FORCE  235     ; N, [M] grip force: 20 to 235 N
    PALM-DEPTH    14.9))  ; cm, [J] the site "pinch" is at 14.5 in the base, which is at 0.38 in the mount
