;;;; loader.lisp -- how boot.lisp loads a system: quietly, with progress, and whatever is damaged.

(in-package :supergrip-boot)

(define-condition missing-library (error)
  ((name :initarg :name))
  (:report (lambda (condition stream)
             (with-slots (name) condition
               (format stream "~a is missing: apt-get install ~a, or put it where ASDF looks"
                       name name))))
  (:documentation "A library that SUPER-GRIP needs is not where ASDF looks."))

(defun finder ()
  "Return a function that finds system definitions: ours here, others as ASDF was told to."
  (let ((others asdf:*system-definition-search-functions*))
    (lambda (name)
      (cond ((equal (asdf:primary-system-name name) "supergrip")
             (merge-pathnames "supergrip.asd" *root*))
            ;; ASDF looks for a newer ASDF before it does anything, and loads it.
            ((member name '("asdf" "uiop") :test #'equal) nil)
            (t (some (lambda (other) (funcall other name)) others))))))

(defvar *messages* *error-output* "Where messages go.")

(defun tell (control &rest arguments)
  "Write a line to *MESSAGES*."
  (format *messages* "~?~%" control arguments)
  (finish-output *messages*))

(defvar *shown* nil "True while *MESSAGES* shows how far work is.")

(defun progress (check &optional (start (get-internal-real-time)))
  "Return a function to be called after each file that is compiled, a CHECK as ASDF asks for.  It
calls CHECK, one more such function, or NIL.  From two seconds after START on it shows on a terminal
how many files there were."
  (let ((count 0))
    (lambda (&rest arguments)
      (incf count)
      (when (and (> (- (get-internal-real-time) start) (* 2 internal-time-units-per-second))
                 (interactive-stream-p *messages*))
        (setf *shown* t)
        (format *messages* "~cSUPER-GRIP is compiled, which is done once: ~d file~:p" #\Return
                count)
        (finish-output *messages*))
      (or (null check) (apply check arguments)))))

(defun hide-progress ()
  "Clear the line that PROGRESS has written."
  (when (shiftf *shown* nil)
    (format *messages* "~c~c[K" #\Return (code-char 27))
    (finish-output *messages*)))

(defun call-quietly (function &rest arguments)
  "Call FUNCTION, which uses ASDF, without a word, whatever the session reads and prints like."
  (let ((search (list (finder)))
        (check (progress uiop:*compile-check*)))
    (with-standard-io-syntax
      (let ((uiop:*compile-check* check)
            (asdf:*system-definition-search-functions* search)
            (*print-readably* nil) (*compile-verbose* nil) (*compile-print* nil)
            (*load-verbose* nil) (*load-print* nil))
        (handler-bind (((or warning sb-ext:compiler-note) #'muffle-warning))
          (apply function arguments))))))

(defun knowledge-error-p (condition)
  (let ((class (and (find-package :supergrip-data)
                    (find-class (find-symbol "KNOWLEDGE-ERROR" :supergrip-data) nil))))
    (and class (typep condition class))))

(defun end-script (condition hook)
  "Print CONDITION, which nothing has handled, and end the process."
  (declare (ignore hook))
  (unless (typep condition 'sb-sys:interactive-interrupt)
    (tell "~a" condition))
  (sb-ext:exit :abort t
               :code (cond ((knowledge-error-p condition) 65)
                           ((typep condition 'missing-library) 69)
                           ((typep condition 'sb-sys:interactive-interrupt) 130)
                           (t 70))))

(defun recompile (restart condition)
  "Compile again, by RESTART, the compiled file that can't be loaded because of CONDITION."
  ;; One that is not there was just replaced by another process.
  (unless (and (typep condition 'file-error)
               (not (ignore-errors (probe-file (file-error-pathname condition)))))
    (tell "a compiled file of SUPER-GRIP is damaged: ~a~%It is compiled again." condition))
  (invoke-restart restart))

(defun load-compiled (system)
  "Load SYSTEM, compiling what needs it, also a compiled file that can't be loaded.  Return true
if that can be done."
  (let ((tried '())
        (*error-output* *error-output*))
    (handler-bind
        (((or error storage-condition)
           (lambda (condition)
             (let* ((restart (find-restart 'asdf/lisp-action:try-recompiling condition))
                    (name (and restart (princ-to-string restart))))
               (cond ((knowledge-error-p condition))
                     ;; Files of three directories may have one name.
                     ((and restart (< (count name tried :test #'equal) 3))
                      (push name tried)
                      (recompile restart condition))
                     (t
                      (when tried (tell "That can't be done; the sources are loaded."))
                      ;; SBCL tells of a compilation that is left.
                      (setf *error-output* (make-broadcast-stream))
                      (return-from load-compiled nil)))))))
      (let ((sb-ext:*evaluator-mode* :interpret))
        (call-quietly #'asdf:find-system system))
      (call-quietly #'asdf:operate 'asdf:load-op system)
      t)))

(defun load-system (system)
  "Load SYSTEM: its compiled files or, if they can't be written, its sources."
  (or (load-compiled system)
      (progn
        (when (interactive-stream-p *messages*)
          (tell "Compiled files can't be kept, so the sources are loaded; this takes some ~
                 seconds."))
        (call-quietly #'asdf:operate 'asdf:load-source-op system))))

(defun find-library (name)
  "Make sure that ASDF finds the system NAME."
  (loop until (call-quietly #'asdf:find-system name nil)
        do (restart-case (error 'missing-library :name name)
             (retry ()
               :report "Look for it again, now that ASDF can find it."))))

(defun load-quietly (system &key needs)
  "Load SYSTEM, one of SUPER-GRIP, which needs the libraries NEEDS."
  (let* ((script (eq sb-ext:*invoke-debugger-hook* 'sb-debug::debugger-disabled-hook))
         (sb-ext:*invoke-debugger-hook* (if script 'end-script sb-ext:*invoke-debugger-hook*))
         (*messages* *error-output*)
         ;; A script says what is wrong once; SBCL would say in which form of this file, too.
         (*error-output* (if script (make-broadcast-stream) *error-output*)))
    (mapc #'find-library needs)
    (unwind-protect (load-system system)
      (hide-progress))))
