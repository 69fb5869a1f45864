;;;; system.lisp -- what the batch needs of SBCL and the system: descriptors, signals, the process.
;;;;
;;;; Lisp's own streams do not serve: they wait until a buffer is full, so a pipe that pauses would
;;;; get no answer; and they hide why a write failed.

(in-package :supergrip)

(deftype octets () '(simple-array (unsigned-byte 8) (*)))

(defun closed-pipe-p (condition)
  "True if the SYSTEM-FAILURE CONDITION says that nobody reads what is written."
  (eql (system-failure-errno condition) sb-unix:epipe))

;;; Signals
;;;
;;; SIGINT and SIGTERM end the program, with 130 and 143.  *WHEN-ASKED* says when: at once, by a
;;; throw where there is something to put in order; or after the record in hand, while there is one.

(defconstant +patience+ 3 "How many seconds the record in hand may take after a signal.")

(defvar *signal* nil "The signal that asks the program to end, :SIGINT or :SIGTERM, or NIL.")
(defvar *when-asked* :exit
  "What a signal does: :EXIT, end the process; :THROW, to the tag SIGNALLED; :NOTE, set *SIGNAL*.")
(defvar *main-thread* nil)

(defun ask-to-end (signal)
  "Let SIGNAL end the program, as *WHEN-ASKED* says.  A program that is asked twice ends at once."
  (if (eq sb-thread:*current-thread* *main-thread*)
      (let ((again *signal*))
        (setf *signal* signal)
        (ecase (if again :exit *when-asked*)
          (:exit (end-process (signal-status signal)))
          (:throw (throw 'signalled nil))
          (:note (set-alarm +patience+))))
      (sb-thread:interrupt-thread *main-thread* (lambda () (ask-to-end signal)))))

(defun signal-status (signal)
  "Return the exit status of a program that SIGNAL ended."
  (ecase signal (:sigint 130) (:sigterm 143)))

(defun set-alarm (seconds)
  "Let SIGALRM come after so many SECONDS."
  (sb-alien:alien-funcall
   (sb-alien:extern-alien "alarm" (function sb-alien:unsigned sb-alien:unsigned)) seconds))

(defun catch-signal (number function)
  "Let FUNCTION be called without arguments when the signal NUMBER comes."
  (sb-sys:enable-interrupt number (lambda (signal info context)
                                    (declare (ignore signal info context))
                                    (funcall function))))

(defun catch-signals ()
  "Let SIGINT and SIGTERM end the program, and writing to a closed pipe fail, not kill."
  (setf *main-thread* sb-thread:*current-thread*)
  (catch-signal sb-unix:sigint (lambda () (ask-to-end :sigint)))
  (catch-signal sb-unix:sigterm (lambda () (ask-to-end :sigterm)))
  ;; What had to be finished before the end takes too long.
  (catch-signal sb-unix:sigalrm (lambda () (when *signal* (ask-to-end *signal*))))
  (sb-sys:enable-interrupt sb-unix:sigpipe :ignore))

(defmacro unless-signalled (&body body)
  "Return what BODY returns; or NIL, at once, if a signal comes or came: *SIGNAL* tells."
  `(catch 'signalled
     (let ((*when-asked* :throw))
       (if *signal* nil (progn ,@body)))))

;;; Files

(defun make-directory (name mode)
  "Make the directory NAME, a string, and return NIL; or return the system's error number."
  (multiple-value-bind (made errno) (sb-unix:unix-mkdir name mode)
    (if made nil errno)))

(defun make-directories (name)
  "Make the directory NAME, a string, and those above it, where they are not there."
  (let* ((name (string-right-trim "/" name))
         (slash (position #\/ name :from-end t))
         (errno (make-directory name #o777)))
    (when (and (eql errno sb-unix:enoent) slash (plusp slash))
      (make-directories (subseq name 0 slash))
      (setf errno (make-directory name #o777)))
    (unless (member errno (list nil sb-unix:eexist sb-unix:enoent))
      (error 'write-failure :what "can't be made" :errno errno))))

(defun prepare-file (file)
  "Make the directories above FILE, a string, and make sure that it can be written."
  (let ((slash (position #\/ file :from-end t)))
    (when (and slash (plusp slash))
      (make-directories (subseq file 0 slash))))
  (multiple-value-bind (descriptor errno)
      (sb-unix:unix-open file (logior sb-unix:o_wronly sb-unix:o_creat) #o666)
    (if descriptor
        (close-descriptor descriptor)
        (error 'write-failure :what "can't be written" :errno errno))))

(defun write-file (file text)
  "Put TEXT, as UTF-8, in the place of FILE, a string: nobody sees a half of it, and a link that
stands there is replaced, not followed."
  (let ((new (concatenate 'string file ".new"))
        (octets (coerce (sb-ext:string-to-octets text :external-format :utf-8) 'octets))
        (done nil))
    (flet ((check (result &optional errno)
             (or result (error 'write-failure :what "can't be written" :errno errno))))
      (sb-unix:unix-unlink new)
      (unwind-protect
           (let ((descriptor (multiple-value-call #'check
                               (sb-unix:unix-open new (logior sb-unix:o_wronly sb-unix:o_creat
                                                              sb-unix:o_excl)
                                                  #o666))))
             (unwind-protect (write-octets descriptor octets (length octets))
               (close-descriptor descriptor))
             (multiple-value-call #'check (sb-unix:unix-rename new file))
             (setf done t))
        (unless done (sb-unix:unix-unlink new))))))

(defun check-access (name mode)
  "Return NIL if MODE, 4 to read, 2 to write, 1 to search, is allowed to us for NAME, a string; or
the system's error number."
  (if (zerop (sb-alien:alien-funcall
              (sb-alien:extern-alien "access"
                                     (function sb-alien:int sb-alien:c-string sb-alien:int))
              name mode))
      nil
      (sb-alien:get-errno)))

(defun check-readable (file)
  "Signal a READ-FAILURE unless FILE, a string, is a file that can be read.  It is not opened: a
pipe can be opened once."
  (let ((errno (check-access file 4)))
    (cond (errno (error 'read-failure :what "can't be opened" :errno errno))
          ((directory-p file)
           (error 'read-failure :what "can't be opened" :errno +is-directory+)))))

(defun check-writable (directory)
  "Signal a WRITE-FAILURE unless files can be made in DIRECTORY, a string."
  (let ((errno (check-access (concatenate 'string directory "/") 3)))
    (when errno
      (error 'write-failure :what "can't be written" :errno errno))))

(defun close-descriptor (descriptor)
  (sb-unix:unix-close descriptor))

(defun terminal-p (descriptor)
  "True if DESCRIPTOR is a terminal."
  (plusp (sb-unix:unix-isatty descriptor)))

(defun wait-for (descriptor direction)
  "Wait until DESCRIPTOR, a non-blocking one, is ready for :INPUT or :OUTPUT."
  (sb-sys:wait-until-fd-usable descriptor direction nil nil))

(defun read-octets (descriptor buffer start)
  "Read what there is at DESCRIPTOR, waiting if there is nothing, into BUFFER from START.
Return the end, which is START at the end of the file or if a signal asks the program to end."
  (declare (type octets buffer) (fixnum start))
  (loop
    (multiple-value-bind (count errno)
        (sb-sys:with-pinned-objects (buffer)
          (let ((place (sb-sys:sap+ (sb-sys:vector-sap buffer) start))
                (room (- (length buffer) start)))
            (unless-signalled (sb-unix:unix-read descriptor place room))))
      (cond (*signal* (return start))
            (count (return (+ start (the fixnum count))))
            ((eql errno sb-unix:eintr))
            ((eql errno sb-unix:eagain)
             (unless-signalled (wait-for descriptor :input)))
            (t (error 'read-failure :what "can't be read" :errno errno))))))

(defun write-octets (descriptor buffer end)
  "Write the first END octets of BUFFER to DESCRIPTOR."
  (declare (type octets buffer) (fixnum end))
  (let ((start 0))
    (declare (fixnum start))
    (loop while (< start end)
          do (multiple-value-bind (count errno)
                 (sb-unix:unix-write descriptor buffer start (- end start))
               (cond (count (incf start (the fixnum count)))
                     ((eql errno sb-unix:eintr))
                     ((eql errno sb-unix:eagain) (wait-for descriptor :output))
                     (t (error 'write-failure :what "can't be written" :errno errno)))))))

;;; Numbers

(defun shortest-digits (number)
  "Return the shortest decimal that reads back as NUMBER, a double above 0: its digits D, a string,
and the exponent E of 0.D x 10^E."
  (multiple-value-bind (exponent digits) (sb-impl::flonum-to-digits number)
    (values digits exponent)))

;;; The process

(defun command-arguments ()
  "Return the arguments of the command line, without the program and what SBCL itself takes;
:UNREADABLE if they are no text in the locale's encoding: SBCL then has none at all."
  (if sb-ext:*posix-argv* (rest sb-ext:*posix-argv*) :unreadable))

(defun end-process (status)
  "End the process at once with STATUS; what was not written by WRITE-OCTETS is lost."
  (sb-ext:exit :code status :abort t))

(defun keep-small ()
  "Collect garbage often enough that the process stays small."
  (setf (sb-ext:bytes-consed-between-gcs)
        (min (sb-ext:bytes-consed-between-gcs) 16000000)))

(defun never-debug (report)
  "Let an error that nothing handles end the process, with the status that REPORT, a function,
returns for it; and SIGINT, if SBCL still handles it."
  (setf sb-ext:*invoke-debugger-hook*
        (lambda (condition hook)
          (declare (ignore hook))
          (end-process (if (typep condition 'sb-sys:interactive-interrupt)
                           (signal-status :sigint)
                           (funcall report condition))))))

(defun save-program (file function)
  "Save this image as the executable FILE, which calls FUNCTION, and end.
Options of SBCL's runtime, as --dynamic-space-size, stay possible before all others."
  ;; While SBCL starts, and collects garbage, its own handlers are in force: that of SIGTERM would
  ;; leave with 0 or, asked twice, with 1; that of SIGINT signals a condition, which SBCL may make
  ;; an error of a hook.
  (flet ((end-at (signal)
           (lambda (number info context)
             (declare (ignore number info context))
             (end-process (signal-status signal)))))
    (sb-ext:without-package-locks
      (setf (fdefinition 'sb-unix::sigterm-handler) (end-at :sigterm)
            (fdefinition 'sb-unix::sigint-handler) (end-at :sigint))))
  ;; Before SBCL makes other threads, which SIGTERM could come to.
  (push #'catch-signals sb-ext:*init-hooks*)
  (sb-ext:save-lisp-and-die file :executable t :toplevel function
                                 :save-runtime-options :accept-runtime-options))
