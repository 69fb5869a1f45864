;;;; fuzz.lisp -- sbcl --script t/fuzz.lisp COUNT [SEED [PROGRAM]] fuzzes for as long as it takes.
;;;;
;;;; COUNT spoiled boxes go through PROGRAM, by default examples/batch.lisp under --script, half of
;;;; them in each notation, and COUNT / 20 spoiled rules and grasps are read.  Stops at the first
;;;; thing that is wrong, says with which seed, and leaves the files in the temporary directory.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(supergrip-boot:load-quietly "supergrip/batch")
(load (merge-pathnames "fuzzer.lisp" *load-truename*))

(defun command ()
  (if (fourth sb-ext:*posix-argv*)
      (list (fourth sb-ext:*posix-argv*))
      (list "sbcl" "--script" (uiop:native-namestring
                               (asdf:system-relative-pathname "supergrip" "examples/batch.lisp")))))

(defun check (seed what problem)
  (when problem
    (format t "seed ~d, ~a: ~a~%" seed what problem)
    (sb-ext:exit :code 1)))

(let* ((count (parse-integer (or (second sb-ext:*posix-argv*) "20000")))
       (seed (parse-integer (or (third sb-ext:*posix-argv*) "1")))
       (chunk (min 10000 (ceiling count 2)))
       (directory (uiop:ensure-directory-pathname
                   (format nil "~afuzz-~d/" (uiop:native-namestring (uiop:temporary-directory))
                           seed))))
  (ensure-directories-exist directory)
  (loop with done = 0
        while (< done count)
        do (dolist (notation '(:lisp :json))
             (check seed notation
                    (supergrip-fuzzer:fuzz-boxes (command) notation chunk seed directory)))
           (check seed "rules and grasps" (supergrip-fuzzer:fuzz-knowledge (ceiling chunk 10) seed))
           (incf done (* 2 chunk))
           (incf seed)
           (format t "~d boxes, ~d rules and grasps~%" done (floor done 20))
           (finish-output)))
