;;;; radius.lisp -- the exact force radius, the least squeeze and the least friction, with
;;;; certificates.

(in-package :supergrip-statics)

(defun needs-nothing-p (need)
  (declare (type six need))
  (every #'zerop need))

(defun start-proof (grip need gravity &rest slots)
  "Return a proof about GRIP and the task NEED, in a frame that suits both, with SLOTS; and the
frame.  The wrenches SUPPLY and DEMAND among SLOTS are not in the frame yet; mirrors keep GRAVITY."
  (declare (type grip grip) (type six need gravity))
  (multiple-value-bind (frame a flat halves) (round-frame grip need (mirrors grip gravity))
    (let* ((rows (rows-in-frame grip frame))
           (p (apply #'make-proof :count (grip-count grip) :u (grip-friction grip)
                                  :v (grip-soft-friction grip) :coupled (grip-coupled grip)
                                  :rows rows :finder (find-in grip frame rows)
                                  :a a :flat flat :halves halves slots)))
      (into-frame frame (copy-seq (p-supply p)) 0 (p-supply p))
      (into-frame frame (copy-seq (p-demand p)) 0 (p-demand p))
      (values p frame))))

(defun needed-size (need motion)
  "Return the size of the task NEED in MOTION: the norm of their products."
  (declare (type six need motion))
  (sqrt (loop for f across need for q across motion sum (* f q f q) of-type not-negative)))

(defun cant-hold (grip gravity witness)
  "Return the values of GRIP-RADIUS for a grip that GRAVITY overcomes in the motion WITNESS."
  (let* ((length (sqrt (the not-negative (row-dot witness 0 witness))))
         (witness (scaled witness length))
         (power (+ (grip-power grip witness (make-six)) (row-dot gravity 0 witness))))
    (values (min power 0d0) (min power 0d0) witness 0)))

(defun needs-unit (need)
  "Return the power of 2 that the greatest of NEED is at least, and less than twice as much as.
Needs as small as 1e-300 have no squares; in this unit they have."
  (declare (type six need))
  (scale-float 1d0 (1- (nth-value 1 (decode-float (reduce #'max need))))))

(defun certified-radius (grip need gravity p frame budget unit)
  "Return the values of GRIP-RADIUS for a grip that holds against GRAVITY; P is the proof, in FRAME.
NEED is in UNIT, the values are not."
  (declare (type not-negative unit))
  (look-around p)
  (let* ((proved (prove p budget))
         (worst (out-of-frame frame (p-worst p)))
         (worst (scaled worst (needed-size need worst)))
         (upper (+ (grip-power grip worst (make-six)) (row-dot gravity 0 worst)))
         (upper (if (<= upper +nothing+) 0d0 upper)))
    (values (/ upper unit) (and proved (/ (min upper (p-goal p)) unit)) (scaled worst unit)
            (+ (p-evaluations p) (f-evaluations (p-finder p))))))

(defun grip-radius (grip need gravity &optional (gap 0.01d0) (absolute 0.002d0) (budget 100000))
  "Return the exact force radius of GRIP, between two numbers: see EXACT-RADIUS, whose values these
are, WORST a six; the fourth is how often the support function was computed.  NEED, of which one is
above 0, and GRAVITY are sixes, NEED without signs."
  (declare (type grip grip) (type six need gravity) (type double-float gap absolute)
           (type (and fixnum (integer 0)) budget))
  (without-float-traps
    (let* ((unit (needs-unit need))
           (need (scaled (copy-seq need) unit)))
      (multiple-value-bind (p frame)
          (start-proof grip need gravity :supply (copy-seq gravity) :gap gap
                                         :absolute (* absolute unit))
        (let ((finder (p-finder p)))
          (if (or (needs-nothing-p gravity)
                  (reaches-p finder (opposite (p-supply p))))
              (certified-radius grip need gravity p frame budget unit)
              (cant-hold grip gravity (out-of-frame frame (f-q finder)))))))))

(defun grip-squeeze (grip need gravity &optional (gap 0.01d0) (budget 100000))
  "Return the least cap on each finger's force with which GRIP does the task NEED and holds against
GRAVITY: a cap that surely does, at most 1/(1-GAP) times one below which none does, the second
value.  Both are NIL if no cap does, the first if BUDGET boxes did not do for the proof."
  (declare (type grip grip) (type six need gravity) (type double-float gap)
           (type (and fixnum (integer 0)) budget))
  (without-float-traps
    (if (needs-nothing-p need)
        ;; Without a need this is how far the grip reaches along one wrench.
        (let ((entry (if (needs-nothing-p gravity) 1d300 (grip-entry grip (opposite gravity)))))
          (if (plusp entry)
              (values (/ entry) (/ entry))
              (values nil nil)))
        ;; A cap s does it where s h(q) + gravity.q >= |F q|: h(q) >= (|F q| - gravity.q) / s.
        (let ((p (start-proof grip need gravity :demand (opposite gravity) :gap gap)))
          (look-around p)
          (let ((proved (prove p budget)))
            (if (<= (p-upper p) +nothing+)
                (values nil nil)
                (values (and proved (/ (p-goal p))) (/ (p-upper p)))))))))

(defun least-holding-friction (grip gravity gap)
  "Return the values of GRIP-LEAST-FRICTION for a grip that only holds against GRAVITY."
  (flet ((holds-p (u) (grip-holds-p (with-friction grip u) gravity)))
    (let ((most (loop for u = 1d0 then (* 8 u)
                      when (holds-p u) return u
                      when (> u +greatest-friction+) return nil)))
      (cond ((null most) (values nil nil))
            ((holds-p 0d0) (values 0d0 0d0))
            (t (loop with least = 0d0
                     until (<= (- most least) (* gap most))
                     do (let ((middle (/ (+ least most) 2)))
                          (if (holds-p middle)
                              (setf most middle)
                              (setf least middle)))
                     finally (return (values most least))))))))

(defun with-friction (grip u)
  "Return a grip like GRIP with the friction U."
  (%make-grip (grip-count grip) u (grip-soft-friction grip) (grip-coupled grip) (grip-rows grip)
              (grip-places grip)))

(defun prove-friction (p budget)
  "Prove P, which seeks friction, with BUDGET boxes; if that can't be done, with a wider gap, up to
64 times as wide.  True if it was done."
  (declare (type proof p))
  (loop repeat 4
        do (setf (p-boxes p) 0
                 (p-u p) (little-more p (p-least p)))
           (when (prove p budget) (return t))
           (setf (p-gap p) (* 4 (p-gap p))
                 (p-absolute p) (* 4 (p-absolute p)))))

(defun grip-least-friction (grip need gravity &optional (gap 0.01d0) (absolute 0.002d0)
                                                (budget 20000))
  "Return the least friction u with which GRIP, its soft friction unchanged, does the task NEED and
holds against GRAVITY: one that surely does, and one below which none does: see LEAST-FRICTION."
  (declare (type grip grip) (type six need gravity) (type double-float gap absolute)
           (type (and fixnum (integer 0)) budget))
  (without-float-traps
    (if (needs-nothing-p need)
        (least-holding-friction grip gravity (max gap 1d-9))
        (let ((p (start-proof (with-friction grip (max 0.5d0 (grip-friction grip))) need gravity
                              :supply (copy-seq gravity) :friction t :goal 1d0 :gap gap
                              :absolute absolute)))
          (setf (p-u p) (little-more p 0d0))
          (look-around p)
          (let ((proved (prove-friction p budget)))
            (if (<= (p-upper p) +nothing+)
                (values nil nil)
                (values (and proved (p-u p)) (p-least p))))))))
