;;;; sbcl.lisp -- all that is needed of SBCL itself: file descriptors, signals, digits, atomic lists.
;;;;
;;;; Streams of the standard would do for none of it: they wait until a buffer is full, so a pipe
;;;; that pauses would get no answer, and they hide why a write failed.

(in-package :supergrip)

(deftype octets () '(simple-array (unsigned-byte 8) (*)))

(define-condition system-failure (error)
  ((what :initarg :what :reader system-failure-what)
   (errno :initarg :errno :reader system-failure-errno))
  (:report (lambda (condition stream)
             (format stream "~a: ~a" (system-failure-what condition)
                     (sb-int:strerror (system-failure-errno condition)))))
  (:documentation "The system could not do something to a file or a pipe."))

(define-condition read-failure (system-failure) ()
  (:documentation "Something could not be opened or read."))

(define-condition write-failure (system-failure) ()
  (:documentation "Something could not be written."))

(defun closed-pipe-p (condition)
  "True if the SYSTEM-FAILURE CONDITION says that nobody reads what is written."
  (eql (system-failure-errno condition) sb-unix:epipe))

;;; Lists that several threads share

(defmacro take-from (place)
  "Take the first element of the list in PLACE, a slot of a structure, or return NIL."
  `(sb-ext:atomic-pop ,place))

(defmacro give-to (place object)
  "Put OBJECT before the list in PLACE, a slot of a structure."
  `(sb-ext:atomic-push ,object ,place))

;;; Signals

(defvar *signal* nil "The signal that asks the program to end, :SIGINT or :SIGTERM, or NIL.")
(defvar *waiting* nil "True while the program waits for input, and so holds no record.")
(defvar *main-thread* nil)

(defun ask-to-end (signal)
  "Note that SIGNAL came.  A program that waits for input ends at once; one that is asked twice
does not wait for the record in hand."
  (let ((again *signal*))
    (setf *signal* signal)
    (cond (again (sb-ext:exit :code (signal-status signal) :abort t))
          ((not *waiting*))
          ((eq sb-thread:*current-thread* *main-thread*) (throw 'waiting nil))
          (t (sb-thread:interrupt-thread *main-thread*
                                         (lambda () (when *waiting* (throw 'waiting nil))))))))

(defun signal-status (signal)
  "Return the exit status of a program that SIGNAL ended."
  (ecase signal (:sigint 130) (:sigterm 143)))

(defun catch-signals ()
  "Let SIGINT and SIGTERM ask for an end, and writing to a closed pipe fail, not kill."
  (setf *signal* nil *waiting* nil *main-thread* sb-thread:*current-thread*)
  (loop for (number name) in `((,sb-unix:sigint :sigint) (,sb-unix:sigterm :sigterm))
        do (let ((name name))
             (sb-sys:enable-interrupt number (lambda (signal info context)
                                               (declare (ignore signal info context))
                                               (ask-to-end name)))))
  (sb-sys:enable-interrupt sb-unix:sigpipe :ignore))

;;; Files

(defconstant +is-directory+ 21 "The error number EISDIR.")

(defun open-descriptor (file)
  "Open FILE, a string, for reading; return its descriptor."
  (multiple-value-bind (descriptor errno) (sb-unix:unix-open file sb-unix:o_rdonly 0)
    (or descriptor (error 'read-failure :what "can't be opened" :errno errno))))

(defun close-descriptor (descriptor)
  (sb-unix:unix-close descriptor))

(defun terminal-p (descriptor)
  "True if DESCRIPTOR is a terminal."
  (plusp (sb-unix:unix-isatty descriptor)))

(defun read-octets (descriptor buffer start)
  "Read what there is at DESCRIPTOR, waiting if there is nothing, into BUFFER from START.
Return the end, which is START at the end of the file or if a signal asks the program to end."
  (declare (type octets buffer) (fixnum start))
  (loop
    (multiple-value-bind (count errno)
        (sb-sys:with-pinned-objects (buffer)
          (let ((place (sb-sys:sap+ (sb-sys:vector-sap buffer) start))
                (room (- (length buffer) start)))
            (unwind-protect
                 (catch 'waiting
                   (setf *waiting* t)
                   (if *signal* nil (sb-unix:unix-read descriptor place room)))
              (setf *waiting* nil))))
      (cond (*signal* (return start))
            (count (return (+ start (the fixnum count))))
            ((eql errno sb-unix:eintr))
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
                     (t (error 'write-failure :what "can't be written" :errno errno)))))))

;;; Numbers

(defun shortest-digits (number)
  "Return the shortest decimal that reads back as NUMBER, a double above 0: its digits D, a string,
and the exponent E of 0.D x 10^E."
  (multiple-value-bind (exponent digits) (sb-impl::flonum-to-digits number)
    (values digits exponent)))

;;; The process

(defun command-arguments ()
  "Return the arguments of the command line, without the program and what SBCL itself takes; :UNREADABLE
if they are no text in the locale's encoding: SBCL then has none at all."
  (if sb-ext:*posix-argv* (rest sb-ext:*posix-argv*) :unreadable))

(defun end-process (status)
  "End the process at once with STATUS; what was not written by WRITE-OCTETS is lost."
  (sb-ext:exit :code status :abort t))

(defun keep-small ()
  "Collect garbage often enough that the process stays small."
  (setf (sb-ext:bytes-consed-between-gcs)
        (min (sb-ext:bytes-consed-between-gcs) 16000000)))

(defun never-debug ()
  "Let an error that nothing handles end the process."
  (sb-ext:disable-debugger))

(defun save-program (file function)
  "Save this image as the executable FILE, which calls FUNCTION, and end.
Options of SBCL's runtime, as --dynamic-space-size, stay possible before all others."
  (sb-ext:save-lisp-and-die file :executable t :toplevel function
                                 :save-runtime-options :accept-runtime-options))
