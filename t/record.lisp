;;;; record.lisp -- what a record says, and that both notations say the same.

(in-package :supergrip-test)
(define-suite record "What a record says, and that both notations say the same.")

(defun written (record writer)
  "Return what WRITER, a function, writes for RECORD."
  (uiop:with-temporary-file (:pathname file)
    (with-open-file (out file :direction :output :if-exists :supersede)
      (let ((output (supergrip::make-output (sb-sys:fd-stream-fd out))))
        (funcall writer record output)
        (supergrip::flush-output output)))
    (uiop:read-file-string file :external-format :utf-8)))

(defun lisp-line (record) (written record #'supergrip::write-lisp-record))
(defun json-line (record) (written record #'supergrip::write-json-record))

(test the-pencil-has-its-record
  (let* ((plan (supergrip:plan (cons '(:name "pencil") *good-box*)))
         (record (supergrip::plan-record plan :line 3)))
    (loop for (key value) in
          '((:name "pencil") (:line 3) (:status "grasp") (:grasp "PINCH-3-PARALLEL")
            (:matching ("Y2" "Y1" "X2" "X1" "Z2" "Z1")) (:u-t 0.625d0)
            (:limiting (:force "about Y" :velocity "about Y")) (:offset (0d0 0d0 0d0))
            (:approach (0d0 0d0 -1d0)) (:tried 6) (:possible 6) (:reason nil))
          do (is (equalp value (getf record key)) "~a" key))
    (is (close-to 0.86d0 (getf record :quality)))
    (is (close-to 0.5752262775582044d0 (getf record :sure)))
    (is (= 3 (length (getf record :contacts))))
    (is (equal '(:surface "Y2" :position (-0.86875d0 -1d0 0d0) :normal (0d0 1d0 0d0) :finger "F1")
               (first (getf record :contacts))))
    (is (equal (supergrip:candidate-hand (supergrip:plan-best plan) plan) (getf record :hand)))))

(test what-is-sure-is-never-above-what-the-contacts-can-do
  "A sure radius is at most the exact one of the same contacts, at the box's own weight."
  (let ((checked 0))
    (for-random-boxes (box 150 42)
      (let* ((plan (supergrip:plan box))
             (best (supergrip:plan-best plan))
             (sure (and best (supergrip:candidate-sure best plan))))
        (is (eql sure (and best (getf (supergrip::plan-record plan) :sure))))
        (if (and best (supergrip:candidate-force-radius best))
            (let ((upper (exact-radius-of
                          (candidate-case best plan
                                          (supergrip:box-force-needed (supergrip:plan-box plan))))))
              (incf checked)
              (is (<= -1d-9 sure (+ upper 1d-9)) "~s: ~a ~a" box sure upper))
            (is (null sure)))))
    (is (< 20 checked))))

(test both-notations-read-back-as-the-record
  (for-random-boxes (box 300 41)
    (let ((record (supergrip::plan-record (supergrip:plan box) :line 1)))
      (is (equal record (lisp-record (lisp-line record))) "~s" box)
      (is (equal record (json-record (json-line record))) "~s" box))))

(test numbers-print-shortest-and-read-back
  (let ((state (sb-ext:seed-random-state 7)))
    (flet ((digits (number) (json-line (list :x number))))
      (loop for (number text) in
            '((0d0 "0.0") (1d0 "1.0") (-12.5d0 "-12.5") (0.1d0 "0.1") (1d22 "1.0e22")
              (1d21 "1.0e21") (123456789012345680d0 "123456789012345680.0")
              (1d-5 "0.00001") (1.5d-7 "1.5e-7") (1d-300 "1.0e-300")
              (1.7976931348623157d308 "1.7976931348623157e308"))
            do (is (equal (format nil "{\"x\":~a}~%" text) (digits number)) "~a" number))
      (is (loop repeat 2000
                always (let ((number (* (if (zerop (random 2 state)) 1 -1)
                                        (random-between 1d-140 1d140 state))))
                         (and (eql number (getf (json-record (digits number)) :x))
                              (eql number
                                   (getf (lisp-record (lisp-line (list :x number))) :x)))))))))

(test digits-that-are-kept-are-those-of-their-own-number
  "More numbers than are kept, each twice in one record."
  (let* ((state (sb-ext:seed-random-state 8))
         (numbers (loop repeat 1000 collect (random-between 1d-3 1d3 state)))
         (record (list :x (append numbers (reverse numbers)))))
    (is (equal record (json-record (json-line record))))
    (is (equal record (lisp-record (lisp-line record))))))

(test text-of-any-kind-and-length-goes-through-the-buffer
  (let ((plain (make-string 150000 :initial-element #\a)))
    (dolist (text (list plain (coerce plain 'simple-base-string)
                        (make-string 50000 :initial-element (code-char #x20ac))
                        (let ((text (copy-seq plain)))
                          (loop for place from 65530 below 65540
                                do (setf (char text place) (code-char #x1f600)))
                          text)
                        (make-array 7 :element-type 'character :displaced-to plain)))
      (is (string= text (written text (lambda (text output)
                                        (supergrip::put-text output text))))))))

(test any-name-is-one-line-in-both-notations
  (dolist (name (list "" "a\"b\\c" (format nil "a~%b~cc~cd" #\Return (code-char 0)) "café"
                      (string (code-char #x1f600))))
    (let ((record (list :name name)))
      (is (= 1 (count #\Newline (lisp-line record))))
      (is (= 1 (count #\Newline (json-line record))))
      (is (equal record (json-record (json-line record))))
      (unless (find #\Newline name)
        (is (equal record (lisp-record (lisp-line record))))))))

(test the-records-of-errors-say-where-and-what
  (let ((record (supergrip::error-record
                 (list (supergrip-data:make-problem :line 2 :column 7 :text "it is wrong"))
                 :name "x" :line 1)))
    (is (equal "error" (getf record :status)))
    (is (equal "line 2, column 7: it is wrong" (getf record :reason)))
    (is (equal '((:line 2 :column 7 :text "it is wrong")) (getf record :problems)))
    (is (equal record (json-record (json-line record))))
    (is (equal record (lisp-record (lisp-line record))))))

;;; Alternatives

(test alternatives-are-the-best-grasps-with-all-that-is-told-of-the-best
  (for-random-boxes (box 60 43)
    (let* ((plan (supergrip:plan box))
           (record (supergrip::plan-record plan :all 3))
           (alternatives (getf record :alternatives)))
      (is (= (if (supergrip:plan-best plan) (min 3 (length (supergrip:plan-possible plan))) 0)
             (length alternatives)))
      (is (eq :alternatives (first (last record 2))))
      (is (equal record (json-record (json-line record))))
      (when alternatives
        (loop for (key value) on (first alternatives) by #'cddr
              do (is (equal value (getf record key)) "~a" key)))
      (loop for (one other) on alternatives
            while other do (is (>= (+ (getf one :quality) 1d-9) (getf other :quality))))
      (when alternatives
        (is (null (set-difference
                   (loop for (key) on record by #'cddr collect key)
                   (append '(:name :line :status :tried :possible :reason :alternatives)
                           (loop for (key) on (first alternatives) by #'cddr collect key))))
            "an alternative lacks a key")))))

(test alternatives-in-exact-mode-are-no-bounds
  (for-random-boxes (box 40 44)
    (let* ((supergrip::*certified* 3)
           (plan (supergrip:plan box :index :exact))
           (grasps (supergrip::best-grasps plan 3))
           (alone (let ((supergrip::*certified* 1)) (supergrip:plan box :index :exact))))
      (is (notany #'supergrip:candidate-bound-p grasps))
      (is (equal (supergrip:plan-matching alone) (supergrip:plan-matching plan)))
      (is (eql (supergrip:plan-quality alone) (supergrip:plan-quality plan)))
      (dolist (candidate (set-difference (supergrip:plan-possible plan) grasps))
        (is (<= (supergrip:candidate-quality candidate)
                (supergrip:candidate-quality (first (last grasps)))))))))

(test a-box-without-a-grasp-has-no-alternatives
  (is (null (getf (supergrip::plan-record (supergrip:plan (changed-box :weight 1000)) :all 2)
                  :alternatives)))
  (is (member :alternatives (supergrip::error-record (list (supergrip-data:make-problem :text "bad"))
                                                     :all 2))))
