;;;; strength.lisp -- what the contacts of a candidate can really bear, beside u_w, in words and as
;;;; a bar.

(in-package :supergrip-draw)

(defstruct strength
  "What CANDIDATE really bears of its task, on all axes together: UPPER and LOWER, of its exact
radius, MOTION, its worst one, WORST, the same in words, and SURE, its sure radius.  All are NIL if
the task needs no force or the numbers are out of range; LOWER is if it is not proved.  SURE is if
it is above UPPER: then the grasp's WRENCH promises more than its contacts can exert.  U-W is the
paper's index of its forces."
  candidate upper lower motion worst sure u-w)

(defun force-rows (candidate plan)
  "Return (have need) on each axis for forces: gravity's load taken off, the offset's effect added."
  (mapcar #'list
          (candidate-spare candidate plan)
          (candidate-force-need candidate plan)))

(defun paper-radius (candidate plan)
  "Return u_w of CANDIDATE by the paper's index, whatever PLAN is by, or NIL if it has none."
  (and (every #'plusp (candidate-wrench candidate plan))
       (let ((ratios (loop for (have need) in (force-rows candidate plan)
                           when (plusp need) collect (/ have need))))
         (and ratios (every #'plusp ratios) (reduce #'min ratios)))))

(defun with-minus (text)
  "Return TEXT with true minus signs."
  (map 'string (lambda (char) (if (char= char #\-) +minus+ char)) text))

(defun find-strength (candidate plan)
  "Return the STRENGTH of CANDIDATE of PLAN, LOWER within 0.001 or 0.1 % of UPPER."
  (handler-case
      (multiple-value-bind (upper lower worst)
          (candidate-exact-radius candidate plan :gap 1d-3 :absolute 1d-3)
        (let ((sure (candidate-sure candidate plan))
              (need (box-force-needed (plan-box plan))))
          (make-strength :candidate candidate :upper upper :lower lower :motion worst
                         :u-w (paper-radius candidate plan)
                         :worst (and worst (with-minus (direction-text worst need)))
                         :sure (and upper (<= sure (+ upper 1d-9)) sure))))
    (argument-error () (make-strength :candidate candidate))))

(defun find-strengths (plan count)
  "Return the STRENGTHs of the COUNT best candidates of PLAN."
  (loop for candidate in (best-candidates plan count) collect (find-strength candidate plan)))

(defun shown-radius (strength)
  "Return what is proved of the exact radius of STRENGTH, or the most that it can be, or NIL."
  (or (strength-lower strength) (strength-upper strength)))

(defun true-radius-text (strength)
  "Return the exact radius of STRENGTH for a reader: \"0.880\", or NIL if there is none."
  (let ((radius (shown-radius strength)))
    (cond ((null radius) nil)
          ((minusp radius) "the weight is too much")
          (t (format nil "~:[at most ~;~]~a" (strength-lower strength) (index-text radius))))))

(defun sure-text (strength)
  "Return the sure radius of STRENGTH for a reader, or NIL if there is none."
  (and (strength-sure strength) (index-text (strength-sure strength))))

(defun strength-text (strength)
  "Return what is borne on all axes together, in words, or NIL if no force is needed."
  (let ((radius (true-radius-text strength)))
    (and radius
         (format nil "All axes together: ~a~@[; surely ~a~]" radius (sure-text strength)))))

(defun worst-lines (strength width)
  "Return where STRENGTH is least, in lines no wider than WIDTH."
  (filled (format nil "Least: ~a" (strength-worst strength)) "soft" width))

(defun strengths-height (strengths width)
  "Return how high DRAW-STRENGTH draws each of STRENGTHS, WIDTH wide: 0 if there is nothing to
draw."
  (loop for strength in strengths
        maximize (if (strength-upper strength)
                     (+ 66 (* 18 (length (worst-lines strength width))))
                     0)))

(defun strength-words (strength)
  "Return what is borne on all axes together, a sentence for those who can't see the picture, or
NIL."
  (and (strength-upper strength)
       (format nil "~a; least: ~a." (strength-text strength) (strength-worst strength))))

(defun greatest-radius (strengths)
  "Return the greatest of the radii that are to be drawn for STRENGTHS."
  (loop for strength in strengths
        maximize (max 1 (or (strength-upper strength) 0)
                      (or (strength-u-w strength) 0))))

(defun draw-strength (strength most x y width)
  "Draw what is borne on all axes together in a row like those of DRAW-ROWS, MOST being at its end:
a bar for the exact radius, in it one for the sure radius, a thick mark at 1, a dashed line at u_w."
  (let* ((left (+ x 66)) (room (- width 66 156)) (top (+ y 30))
         (u-w (strength-u-w strength)))
    (flet ((x-of (radius) (+ left (* room (/ (max 0 radius) most)))))
      (draw-text (strength-text strength) (list x (+ y 20)))
      (draw-text "radius" (list x (+ top 14)))
      (draw-rectangle left (+ top 3) (max 0.5 (- (x-of (shown-radius strength)) left)) 13 "have")
      (when (strength-sure strength)
        (draw-rectangle left (+ top 7) (max 0.5 (- (x-of (strength-sure strength)) left)) 5 "sure"))
      (when u-w
        (draw-line (list (x-of u-w) top) (list (x-of u-w) (+ top 19)) "hidden")
        (draw-text (format nil "u_w = ~a" (index-text u-w)) (list (+ left room 10) (+ top 14))
                   :class "soft"))
      (draw-line (list (x-of 1) top) (list (x-of 1) (+ top 19)) "need"))
    (loop for line in (worst-lines strength width)
          for below from (+ top 38) by 18
          do (draw-text line (list x below) :class "soft"))))
