;;;; bits.lisp -- the rule part of a plan by hand: the fifteen shipped rules as bit code.
;;;;
;;;; What the engine learns from rules.lisp is written out here: a set of faces is six bits, the
;;;; pair p is the faces 2p and 2p+1, an edge is two free faces of two pairs, a corner one of each.
;;;; It gives the same log as the engine, event by event (see LOG-EVENT in src/chainer/).

(in-package :supergrip-bench)

(deftype face () '(integer 0 5))
(deftype face-or-end () '(integer 0 6))
(deftype faces () '(unsigned-byte 6))

(defstruct journal "EVENTS is the log of a run, the newest first." (events '() :type list))

(declaim (inline note))
(defun note (journal rule action binding)
  (declare (type journal journal) (type (integer 0 14) rule) (type (integer 0 2) action)
           (type (unsigned-byte 24) binding))
  (push (logior binding (ash action 24) (ash rule 40)) (journal-events journal)))

(defmacro binding (&rest faces)
  "FACES, forms, packed in this order."
  `(logior ,@(loop for face in faces for place from 6 by 3
                   collect `(ash 1 (the face ,face)) collect `(ash (the face ,face) ,place))))

(defmacro do-pair ((s1 s2 pair) &body body)
  "Run BODY with S1 and S2 the two faces of PAIR, in both orders."
  `(dotimes (side 2)
     (let* ((,s1 (+ (* 2 (the (integer 0 2) ,pair)) side)) (,s2 (logxor ,s1 1)))
       ,@body)))

(defmacro do-pairs ((pair set) &body body)
  `(dotimes (,pair 3)
     (when (logbitp ,pair (the (unsigned-byte 3) ,set)) ,@body)))

(defmacro do-free ((face pair free) &body body)
  "Run BODY with FACE each face of PAIR that is FREE."
  `(loop for ,face of-type face-or-end from (* 2 ,pair) below (* 2 (1+ ,pair))
         do (when (logbitp ,face ,free) ,@body)))

(defmacro do-corners ((a b c free) &body body)
  `(do-free (,a 0 ,free) (do-free (,b 1 ,free) (do-free (,c 2 ,free) ,@body))))

(defmacro do-corners-at ((s1 s3 s4 free) &body body)
  "Run BODY for the corners of S1 with two other FREE faces, S3 and S4, in both orders."
  `(do-corners (a b c ,free)
     (multiple-value-bind (d e) (case (ash ,s1 -1)
                                  (0 (values b c)) (1 (values a c)) (t (values a b)))
       (when (or (= ,s1 a) (= ,s1 b) (= ,s1 c))
         (let ((,s3 d) (,s4 e)) ,@body)
         (let ((,s3 e) (,s4 d)) ,@body)))))

(declaim (inline pairs-where))
(defun pairs-where (test)
  "Return the set of the pairs for which TEST is true."
  (loop with set = 0
        for pair below 3
        when (funcall test pair) do (setf set (logior set (ash 1 pair)))
        finally (return set)))

;;; The rules, by their number in the file

(defun availability (journal free parallel large)
  "SURFACES1 to SURFACES4."
  (declare (type faces free) (type (unsigned-byte 3) parallel large))
  (do-pairs (pair parallel) (note journal 3 0 (binding (* 2 pair) (1+ (* 2 pair)))))
  (do-pairs (pair parallel)
    (return (note journal 3 1 (binding (* 2 pair) (1+ (* 2 pair))))))
  (let ((first 0))
    (declare (type (unsigned-byte 24) first))
    (loop for s1 of-type face-or-end below 4
          do (when (logbitp s1 free)
               (loop for s2 of-type face-or-end from (* 2 (1+ (ash s1 -1))) below 6
                     do (when (logbitp s2 free)
                          (let ((edge (binding s1 s2)))
                            (when (zerop first) (setf first edge))
                            (note journal 4 0 edge))))))
    (unless (zerop first) (note journal 4 1 first)))
  (do-corners (a b c free) (note journal 5 0 (binding a b c)))
  (block one
    (do-corners (a b c free) (return-from one (note journal 5 1 (binding a b c)))))
  (do-pairs (pair (logand parallel large))
    (note journal 6 0 (binding (* 2 pair) (1+ (* 2 pair))))))

(defun poor-grasps (journal free)
  "GRIP4 or GRIP6."
  (declare (type faces free))
  (let ((corner nil))
    (dotimes (action 3)
      (do-corners (a b c free)
        (setf corner t)
        (note journal 7 action (binding a b c)) (note journal 7 action (binding a c b))
        (note journal 7 action (binding b a c)) (note journal 7 action (binding b c a))
        (note journal 7 action (binding c a b)) (note journal 7 action (binding c b a))))
    (unless corner
      (note journal 9 0 0)
      (note journal 9 1 0))))

(defun beside-wide-pairs (journal wide others)
  "GRIP5: the WIDE pairs, where there are OTHERS."
  (declare (type (unsigned-byte 3) wide others))
  (flet ((each-binding (do)
           (declare (function do))
           (do-pairs (pair wide)
             (do-pair (s1 s2 pair)
               (do-pairs (other others)
                 (funcall do (binding s1 s2 (* 2 other) (1+ (* 2 other)))))))))
    (declare (inline each-binding))
    (block one
      (each-binding (lambda (binding) (return-from one (note journal 8 0 binding)))))
    (each-binding (lambda (binding) (note journal 8 1 binding)))))

(defun narrow-faces (journal spanned small narrow)
  "GRIP7."
  (declare (type (unsigned-byte 3) spanned small narrow))
  (do-pairs (pair spanned)
    (do-pair (s1 s2 pair)
      (do-pairs (other (logandc2 narrow (logior small (ash 1 pair))))
        (do-pair (s3 s4 other)
          (let ((third (- 3 pair other)))
            (unless (logbitp third small)
              (do-pair (s5 s6 third)
                (note journal 10 0 (binding s1 s2 s3 s4 s5 s6))))))))))

(defun good-grasps (journal free spanned narrow)
  "GRIP9."
  (declare (type faces free) (type (unsigned-byte 3) spanned narrow))
  (do-pairs (pair spanned)
    (do-pair (s1 s2 pair)
      (do-pairs (other (logxor 7 (ash 1 pair)))
        (do-pair (s5 s6 other)
          (let ((third (- 3 pair other)))
            (when (and (logbitp s6 free) (not (logbitp third narrow)))
              (note journal 12 0 (binding s1 s2 s5 s6)))))))))

(defun other-cases (journal free parallel small narrow large)
  "GRIP5 and GRIP7 to GRIP10."
  (declare (type faces free) (type (unsigned-byte 3) parallel small narrow large))
  (let ((wide (logand parallel large)) (spanned (logandc2 parallel large)))
    (beside-wide-pairs journal wide spanned)
    (narrow-faces journal spanned small narrow)
    (dotimes (action 2)
      (do-pairs (pair parallel)
        (do-pair (s1 s2 pair)
          (do-corners-at (s1 s3 s4 free)
            (note journal 11 action (binding s1 s2 s3 s4))))))
    (good-grasps journal free spanned narrow)
    (when (zerop spanned)
      (dotimes (action 3)
        (do-pairs (pair wide)
          (do-pair (s1 s2 pair)
            (note journal 13 action (binding s1 s2))))))))

(defun bit-rules (box)
  "Run the fifteen rules on BOX, and return the verdict, :CANT or :KEEP, and the log."
  (let* ((journal (make-journal))
         (size (supergrip::%box-size box))
         (taken (supergrip::%box-constrained box))
         (free (logxor 63 taken)))
    (declare (type faces taken free) (type (simple-array double-float (3)) size))
    (macrolet ((pairs (test) ; pair 0 lies along Z
                 `(pairs-where (lambda (pair) (let ((distance (aref size (- 2 pair)))) ,test)))))
      (let ((small (pairs (< distance (gripper "FINGER-WIDTH"))))
            (narrow (pairs (< distance (gripper "FINGER-SPREAD"))))
            (large (pairs (>= distance (gripper "DIST-PINCH"))))
            (parallel (pairs-where (lambda (pair) (= 3 (ldb (byte 2 (* 2 pair)) free)))))
            (blocked (pairs-where (lambda (pair) (= 3 (ldb (byte 2 (* 2 pair)) taken)))))
            (touched (pairs-where (lambda (pair) (/= 0 (ldb (byte 2 (* 2 pair)) taken))))))
        (cond ((or (logtest small touched)
                   (<= (supergrip::%box-friction box) (gripper "SLIPPERY-U"))
                   (> (logcount blocked) 1))
               (values :cant (journal-events journal)))
              (t (availability journal free parallel large)
                 (if (zerop parallel)
                     (poor-grasps journal free)
                     (other-cases journal free parallel small narrow large))
                 (values :keep (journal-events journal))))))))
