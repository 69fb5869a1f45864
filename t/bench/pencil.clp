;;; pencil.clp -- the upper level of the pencil session in CLIPS, for the benchmark.
;;;
;;; The fifteen rules as one would write them in CLIPS: salience gives their order, a list of
;;; faces is kept in the order of the faces, and TRY and KEEP only count and halt.

(defglobal ?*tried* = 0)

(deffunction try-grasp (?grasp $?matching) (bind ?*tried* (+ ?*tried* 1)))

(deffacts faces
  (face Z2 0) (face Z1 1) (face Y2 2) (face Y1 3) (face X2 4) (face X1 5))

(deffacts pencil
  (opposed Z2 Z1) (opposed Y2 Y1) (opposed X2 X1)
  (constrained Z2) (constrained X1))

;;; (1) obvious cases

(defrule GRIP1 (declare (salience 150))
  (small ?s1 ?s2)
  (or (constrained ?s1) (constrained ?s2))
  => (halt))

(defrule GRIP2 (declare (salience 140))
  (slippery)
  => (halt))

(defrule GRIP3 (declare (salience 130))
  (opposed ?s1 ?s2) (constrained ?s1) (constrained ?s2)
  (opposed ?s3&~?s1 ?s4) (constrained ?s3) (constrained ?s4)
  => (halt))

;;; (2) availability of surfaces

(defrule SURFACES1 (declare (salience 120))
  (opposed ?s1 ?s2)
  (not (constrained ?s1))
  (not (constrained ?s2))
  => (assert (parallel ?s1 ?s2) (parallel-surfaces)))

(defrule SURFACES2 (declare (salience 110))
  (face ?s1 ?i)
  (face ?s2 ?j&:(< ?i ?j))
  (not (opposed ?s1 ?s2))
  (not (constrained ?s1))
  (not (constrained ?s2))
  => (assert (adjacent ?s1 ?s2) (adjacent-surfaces)))

(defrule SURFACES3 (declare (salience 100))
  (adjacent ?s1 ?s2)
  (adjacent ?s1 ?s3)
  (adjacent ?s2 ?s3)
  => (assert (corner ?s1 ?s2 ?s3) (free-corners)))

(defrule SURFACES4 (declare (salience 90))
  (parallel ?s1 ?s2)
  (large ?s1 ?s2)
  => (assert (wide ?s1 ?s2)))

;;; (3) poor grasps

(defrule GRIP4 (declare (salience 80))
  (not (parallel-surfaces))
  (corner ?s1 ?s2 ?s3)
  => (try-grasp PINCH-3-CORNER ?s1 any ?s2 any ?s3 any)
     (try-grasp PINCH-2-ADJACENT) (try-grasp PINCH-3-ADJACENT) (halt))

(defrule GRIP5 (declare (salience 70))
  (or (wide ?s1 ?s2) (wide ?s2 ?s1))
  (parallel ?s3 ?s4)
  (not (wide ?s3 ?s4))
  => (assert (other-parallel-surfaces))
     (try-grasp PINCH-3-CORNER ?s1 any any any any any))

(defrule GRIP6 (declare (salience 60))
  (not (free-corners))
  (not (parallel-surfaces))
  => (try-grasp PINCH-2-ADJACENT) (try-grasp PINCH-3-ADJACENT) (halt))

;;; (4) other cases

(defrule GRIP7 (declare (salience 50))
  (or (parallel ?s1 ?s2) (parallel ?s2 ?s1))
  (not (wide ?s1 ?s2)) (not (wide ?s2 ?s1))
  (or (narrow ?s3&~?s1&~?s2 ?s4) (narrow ?s4 ?s3&~?s1&~?s2))
  (not (small ?s3 ?s4)) (not (small ?s4 ?s3))
  (or (opposed ?s5&~?s1&~?s2&~?s3&~?s4 ?s6) (opposed ?s6 ?s5&~?s1&~?s2&~?s3&~?s4))
  (not (small ?s5 ?s6)) (not (small ?s6 ?s5))
  => (try-grasp PINCH-2-PARALLEL ?s1 ?s2 ?s3 ?s4 ?s5 ?s6))

(defrule GRIP8 (declare (salience 40))
  (or (parallel ?s1 ?s2) (parallel ?s2 ?s1))
  (or (corner ?s1 ?s3 ?s4) (corner ?s1 ?s4 ?s3)
      (corner ?s3 ?s1 ?s4) (corner ?s4 ?s1 ?s3)
      (corner ?s3 ?s4 ?s1) (corner ?s4 ?s3 ?s1))
  => (try-grasp PINCH-3-U-SHAPE any ?s3 ?s1 ?s2 any ?s4)
     (try-grasp PINCH-3-C-SHAPE ?s1 ?s2 any ?s3 any ?s4))

(defrule GRIP9 (declare (salience 30))
  (or (parallel ?s1 ?s2) (parallel ?s2 ?s1))
  (not (wide ?s1 ?s2)) (not (wide ?s2 ?s1))
  (or (opposed ?s5&~?s1&~?s2 ?s6) (opposed ?s6 ?s5&~?s1&~?s2))
  (not (constrained ?s6))
  (opposed ?s3&~?s1&~?s2&~?s5&~?s6 ?s4)
  (not (narrow ?s3 ?s4)) (not (narrow ?s4 ?s3))
  => (try-grasp PINCH-3-PARALLEL ?s1 ?s2 any any ?s5 ?s6))

(defrule GRIP10 (declare (salience 20))
  (or (wide ?s1 ?s2) (wide ?s2 ?s1))
  (not (other-parallel-surfaces))
  => (try-grasp PINCH-3-CORNER ?s1 any any any any any)
     (try-grasp PINCH-2-ADJACENT) (try-grasp PINCH-3-ADJACENT))

(defrule GRIP11 (declare (salience 10))
  (parallel-surfaces)
  => (halt))

;;; The measurement: seconds of each batch, then what the last session knew and tried.

(deffunction sessions (?count)
  (loop-for-count (?i 1 ?count) do (reset) (run)))

(deffunction remembered ()
  (bind ?count 0)
  (progn$ (?fact (get-fact-list))
    (if (member$ (fact-relation ?fact)
                 (create$ parallel adjacent corner wide
                          parallel-surfaces adjacent-surfaces other-parallel-surfaces free-corners))
     then (bind ?count (+ ?count 1))))
  ?count)

(deffunction measure (?batches ?count)
  (sessions 200)
  (loop-for-count (?i 1 ?batches) do
    (printout t "seconds " (timer (sessions ?count)) crlf))
  (printout t "remembered " (remembered) " tried " ?*tried* crlf))
