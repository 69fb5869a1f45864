;;;; neighbours.lisp -- CLIPS, run as a process: Debian's, and a newer one from Python's clipspy.

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

(defun clipspy-version ()
  "Return the version of Python's clipspy, or NIL if it is not installed."
  (first (process-lines '("python3" "-c" "import clips; print(clips.__version__)"))))

(defparameter *clips-sessions* 500 "How many sessions CLIPS runs in a batch.")

(defun decimal (text)
  "Return the number that TEXT, as 0.0123, spells."
  (let ((point (position #\. text)))
    (/ (parse-integer (remove #\. text))
       (expt 10 (if point (- (length text) point 1) 0)))))

(defun measured-by-clips (name lines)
  "Return the figure NAME of what (measure ...) has printed, LINES.
Signals an error unless it remembers the eleven facts of the session and tries twelve suggestions."
  (let ((prefix "seconds "))
    (unless (find-if (lambda (line) (search "remembered 11 tried 12" line)) lines)
      (error "CLIPS runs another session: ~{~a~%~}" lines))
    (figure-of name (loop for line in lines
                          for start = (search prefix line)
                          when start
                            collect (/ (decimal (subseq line (+ start (length prefix))))
                                       *clips-sessions*)))))

(defun clips-figures ()
  "Return the figures of the rule part in CLIPS, Debian's and clipspy's, as far as installed."
  (let ((rules (uiop:native-namestring (project-file "t/bench/pencil.clp")))
        (measure (format nil "(measure ~d ~d)" *batches* *clips-sessions*))
        (version (clips-version))
        (clipspy (clipspy-version)))
    (append
     (when version
       (list (measured-by-clips
              (format nil "CLIPS ~a" version)
              (process-lines '("clips") (format nil "(load ~s)~%~a~%(exit)~%" rules measure)))))
     (when clipspy
       (list (measured-by-clips
              (format nil "CLIPS 6.4, clipspy ~a" clipspy)
              (process-lines
               (list "python3" "-c" "import sys, clips
environment = clips.Environment()
environment.load(sys.argv[1])
environment.eval(sys.argv[2])" rules measure))))))))
