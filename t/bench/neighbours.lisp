;;;; neighbours.lisp -- other programs, run as processes: CLIPS, and a script of ours.

(in-package :supergrip-bench)

(defun process-lines (command &optional (input ""))
  "Return the lines that COMMAND, a list of strings, prints, or NIL if it can't be run."
  (ignore-errors
   (with-input-from-string (in input)
     (uiop:split-string (uiop:run-program command :input in :output :string)
                        :separator '(#\Newline)))))

(defun clips-version ()
  "Return the version of `clips`, as it prints it, or NIL if it is not installed."
  (let ((line (find-if (lambda (line) (search "CLIPS (" line))
                       (process-lines '("clips") (format nil "(exit)~%")))))
    (when line
      (let ((start (1+ (position #\( line))))
        (subseq line start (position #\Space line :start start))))))

(defparameter *clips-sessions* 500 "How many sessions CLIPS runs in a batch.")

(defun decimal (text)
  "Return the number that TEXT, as 0.0123, spells."
  (let ((point (position #\. text)))
    (/ (parse-integer (remove #\. text))
       (expt 10 (if point (- (length text) point 1) 0)))))

(defun clips-figure ()
  "Return the figure of the rule part in CLIPS, or NIL if it is not installed.
Signals an error unless it remembers the eleven facts of the session and tries ten suggestions."
  (let* ((program (format nil "(load ~s)~%(measure ~d ~d)~%(exit)~%"
                          (uiop:native-namestring (project-file "t/bench/pencil.clp"))
                          *batches* *clips-sessions*))
         (lines (process-lines '("clips") program))
         (prefix "seconds "))
    (flet ((seconds (line)
             (/ (decimal (subseq line (+ (search prefix line) (length prefix))))
                *clips-sessions*)))
      (when lines
        (unless (find-if (lambda (line) (search "remembered 11 tried 10" line)) lines)
          (error "CLIPS runs another session: ~{~a~%~}" lines))
        (figure-of (format nil "CLIPS ~a" (clips-version))
                   (loop for line in lines when (search prefix line) collect (seconds line)))))))

(defun start-up-figure ()
  "Return the figure of the pencil session as a process, everything compiled."
  (let ((command (list "sbcl" "--script"
                       (uiop:native-namestring (project-file "examples/pencil.lisp")))))
    (flet ((run ()
             (seconds-of (lambda () (uiop:run-program command :output nil)) 1)))
      (run)
      (figure-of "`sbcl --script examples/pencil.lisp`" (loop repeat *batches* collect (run))))))
