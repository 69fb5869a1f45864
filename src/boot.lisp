;;;; boot.lisp -- makes a script or a session ready: (load "../src/boot.lisp") loads SUPER-GRIP.
;;;;
;;;; Compiled files are kept where ASDF keeps them, and compiled again if they are damaged.  Where
;;;; that can't be written, or there is no home directory, the sources are loaded instead, which
;;;; takes a few seconds.  What takes more than two seconds shows on a terminal how far it is.
;;;;
;;;; The session stays as it was: ASDF keeps its configuration, and an error offers its restarts.
;;;; Only where the debugger is off, as in a script, does an error end the process, with a message
;;;; and a status: 65 rules or grasps are not valid, 69 a library is missing, 70 anything else.

#-sbcl (error "SUPER-GRIP needs SBCL; this is ~a." (lisp-implementation-type))

(require :asdf)

(defpackage :supergrip-boot
  (:use :cl)
  (:export #:load-quietly #:missing-library))

(in-package :supergrip-boot)

(defparameter *root*
  (merge-pathnames "../" (make-pathname :name nil :type nil :defaults *load-truename*))
  "The directory of SUPER-GRIP.")

;;; At the REPL, where this file was loaded, an example loads it again.
(unless (fboundp 'load-quietly)
  ;; To compile these functions for each script would take longer than they do.
  (let ((sb-ext:*evaluator-mode* :interpret))
    (load (merge-pathnames "src/loader.lisp" *root*))))

(load-quietly "supergrip")

(in-package :cl-user)
