;;;; suggest.lisp -- "did you mean ...?"

(in-package :supergrip-data)

(defun swapped-p (a b i j)
  "True if the two letters of A before I are those of B before J, swapped."
  (declare (simple-string a b) (type (integer 1 1000000) i j))
  (and (> i 1) (> j 1)
       (char= (char a (1- i)) (char b (- j 2)))
       (char= (char a (- i 2)) (char b (1- j)))))

(defun edit-distance (a b most)
  "Return how many letters must be inserted, deleted, replaced or swapped to turn A into B; NIL if
more than MOST."
  (declare (simple-string a b) (type (integer 0 60) most))
  (let* ((far (1+ most))
         (columns (1+ (length b)))
         (before (make-array columns :element-type 'fixnum :initial-element far))
         (above (copy-seq before))
         (row (copy-seq before))
         (least 0))
    (declare (type (simple-array fixnum (*)) before above row) (fixnum least))
    (loop for j from 0 below (min far columns) do (setf (aref above j) j))
    (loop for i from 1 to (length a)
          do (fill row far)
             (setf least (min i far)
                   (aref row 0) least)
             ;; Farther from the diagonal the distance is more than MOST.
             (loop for j from (max 1 (- i most)) below (min columns (+ i far))
                   for same = (char= (char a (1- i)) (char b (1- j)))
                   do (setf (aref row j)
                            (min far
                                 (1+ (aref row (1- j)))
                                 (1+ (aref above j))
                                 (+ (aref above (1- j)) (if same 0 1))
                                 (if (swapped-p a b i j) (1+ (aref before (- j 2))) far))
                            least (min least (aref row j))))
             (rotatef before above row)
          while (< least far))
    (and (< least far) (< (aref above (1- columns)) far) (aref above (1- columns)))))

(defun distance-within (a b most)
  "As EDIT-DISTANCE, of what A and B do not have in common at their beginnings and ends."
  (declare (simple-string a b))
  (when (<= (abs (- (length a) (length b))) most)
    (let* ((start (or (mismatch a b) 0))
           (end-a (or (mismatch a b :from-end t :start1 start :start2 start) start))
           (end-b (+ end-a (- (length b) (length a)))))
      (edit-distance (subseq a start end-a) (subseq b start end-b) most))))

(defun suggestion (name known)
  "Return a phrase that suggests the string of KNOWN that NAME, a name or a string, was probably
meant to be, or \"\"; \"\" for what is neither."
  (let* ((text (if (and name (typep name '(or symbol string))) (string name) ""))
         (text (coerce (subseq text 0 (min 60 (length text))) 'simple-string))
         (best nil) (least 4))
    (when (and (> (length text) 2)      ; any two short names are close
               (or (null *looks-left*) (plusp *looks-left*)))
      (dolist (word known)
        (when *looks-left* (decf *looks-left*))
        (let* ((most (min (1- least) (max 1 (floor (length word) 3))))
               (distance (distance-within text (coerce word 'simple-string) most)))
          (when distance
            (setf best word least distance)
            (when (<= least 1) (return))))))
    (if best (format nil " (did you mean ~a?)" best) "")))
