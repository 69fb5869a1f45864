;;;; Boxes for the batch: sbcl --script examples/batch.lisp examples/boxes.lisp
;;;;
;;;; The same boxes as JSON are in boxes.jsonl.

((NAME "pencil") (SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED Z2 X1)
 (FORCE-NEEDED (1 0.8 0.8 0.3 1 1)) (VELOCITY-NEEDED (0 0.8 0.8 0 0.8 0.8)))

((NAME "die") (SIZE 1.2 1.2 1.2) (WEIGHT 0.002) (U 0.4) (V 0.13) (CONSTRAINED Z2)
 (FORCE-NEEDED (0.5 0.5 1 0 0 0)) (VELOCITY-NEEDED (1 0.5 1 0 1 0.5)))

((NAME "television") (SIZE 73 8 47) (WEIGHT 0.9) (U 0.6) (V 0.2) (CONSTRAINED Z2)
 (FORCE-NEEDED (0.2 0.2 1 0.3 0 0.5)) (VELOCITY-NEEDED (0.2 0.2 0.3 0 0 1)))

((NAME "wet soap") (SIZE 8.5 5.5 2.5) (WEIGHT 0.12) (U 0.05) (V 0.02) (CONSTRAINED Z2)
 (FORCE-NEEDED (0.3 0.3 1 0.3 0.3 0.3)) (VELOCITY-NEEDED (0.5 0.5 1 0 0 0.3)))
