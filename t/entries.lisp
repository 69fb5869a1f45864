;;;; entries.lisp -- how far a grip reaches along each axis, against a solver's values.

(in-package :supergrip-test)
(define-suite entries "How far a grip reaches along each axis, against a solver's values.")

(defun grip-at (contacts u v)
  "Return the grip of CONTACTS, a list of (position inward-normal)."
  (let ((grip (supergrip-statics:make-grip (length contacts) (coerce u 'double-float)
                                           (coerce v 'double-float))))
    (loop for (position normal) in contacts
          for index from 0
          do (apply #'supergrip-statics:set-finger grip index
                    (mapcar (lambda (number) (coerce number 'double-float))
                            (append position normal))))
    grip))

(defun twelve-of (contacts u v)
  "Return what CONTACTS surely exert along and against each axis, and what surely nothing exceeds."
  (multiple-value-bind (least most) (supergrip-statics:grip-entries (grip-at contacts u v))
    (values (coerce least 'list) (coerce most 'list))))

(defun both-ways (twelve)
  "Return the lesser of both ways, six numbers."
  (mapcar #'min (subseq twelve 0 6) (nthcdr 6 twelve)))

(test entries-are-the-solver-s
  (let ((widest 0))
    (dolist (maxima (read-maxima))
      (multiple-value-bind (least most)
          (twelve-of (getf maxima :contacts) (getf maxima :u) (getf maxima :v))
        (if (getf maxima :closed)
            (loop for low in (both-ways least)
                  for high in (both-ways most)
                  for true in (getf maxima :axis-maxima)
                  do (setf widest (max widest (/ (- high low) high)))
                     (is (<= (- low (* 1d-6 true)) true (+ high (* 1d-6 true)))
                         "~a: ~a to ~a, not ~a" (getf maxima :grasp) low high true))
            (is (every #'zerop least)))))
    ;; How far the two numbers are apart, relatively.
    (is (< 0 widest 1d-7) "~a" widest)))

(test entries-have-two-directions
  ;; Two fingers press on X1, one on X2; nobody pulls.
  (multiple-value-bind (least most)
      (twelve-of '(((1 1 0) (-1 0 0)) ((1 -1 0) (-1 0 0)) ((-1 0 0) (1 0 0))) 0.5 0.1)
    (is (nearly-p 1 (first least)))
    (is (nearly-p 2 (seventh least)))
    ;; The other way of an axis is its mirror image.
    (loop for k from 1 below 6
          do (is (= (nth k most) (nth (+ k 6) most))))))

(defun nearly-p (expected number)
  (< (abs (- number expected)) 1d-5))

(test more-friction-never-takes-from-an-entry
  "However much it is: one finger presses on X1, one on X2, and one more on X1."
  (let ((before nil))
    (dolist (u '(0.5d0 2 1000 1d4 1d5 1d6 1d9 1d18 1d60))
      (multiple-value-bind (least most)
          (twelve-of '(((2 1 0) (-1 0 0)) ((-2 0.3d0 1) (1 0 0)) ((2 0.3d0 0.3d0) (-1 0 0))) u 0.2d0)
        (is (loop for low in least for high in most always (<= (* 0.99999d0 high) low high)))
        (is (every #'plusp least))
        (is (every (lambda (now before) (>= now (* 0.99999d0 before))) least (or before least))
            "u ~a" u)
        (setf before least)))))

(test a-bound-is-an-exertion
  ;; What is certified, cone programming of another kind confirms: CONTACT-FORCES finds the forces.
  (dolist (maxima (every-nth 9 (remove nil (read-maxima) :key (lambda (m) (getf m :closed)))))
    (let ((contacts (getf maxima :contacts)) (u (getf maxima :u)) (v (getf maxima :v)))
      (loop for entry in (twelve-of contacts u v)
            for place from 0
            for wrench = (loop for k below 6
                               collect (cond ((/= k (mod place 6)) 0)
                                             ((< place 6) entry)
                                             (t (- entry))))
            do (is-true (supergrip:contact-forces contacts u v (mapcar (lambda (w) (* w 0.99999d0))
                                                                       wrench)))))))

(test entries-are-those-of-the-other-method
  ;; GRIP-ENTRY goes from outside to the same number, along one wrench after another.
  (let ((state (sb-ext:seed-random-state 3)) (closed 0))
    (loop repeat 40
          do (let* ((contacts (loop repeat 4
                                    collect (let ((axis (random 3 state))
                                                  (sign (if (zerop (random 2 state)) 1 -1)))
                                              (list (loop for k below 3
                                                          collect (if (= k axis)
                                                                      (* sign 2)
                                                                      (- (random 4d0 state) 2)))
                                                    (loop for k below 3
                                                          collect (if (= k axis) (- sign) 0))))))
                    (grip (grip-at contacts 0.6 (if (zerop (random 3 state)) 0 0.2))))
               (multiple-value-bind (least most) (supergrip-statics:grip-entries grip)
                 (when (plusp (aref least 0))
                   (incf closed)
                   (dotimes (place 12)
                     (let* ((way (make-array 6 :element-type 'double-float :initial-element 0d0))
                            (entry (progn (setf (aref way (mod place 6)) (if (< place 6) 1d0 -1d0))
                                          (supergrip-statics:grip-entry grip way))))
                       (is (<= (- (aref least place) 1d-5) entry (+ (aref most place) 1d-5))
                           "~a: ~a to ~a, not ~a" contacts (aref least place) (aref most place)
                           entry)))))))
    (is (> closed 5))))

(test what-is-too-large-has-no-entries
  (is (every #'zerop (twelve-of '(((1 0 0) (-1 0 0)) ((-1 0 0) (1 0 0))) 1d80 0.1))))
