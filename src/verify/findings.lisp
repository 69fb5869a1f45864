;;;; findings.lisp -- what was found out about rules and grasps; and how far a long search has come.

(in-package :supergrip)

(defstruct finding
  "Something that was found.  KIND is a keyword; RULE, OTHER and GRASP are names of what it is
about, or NIL; SITUATIONS says in how many situations it is so, BOXES in how many of the boxes
that were searched, NIL where it is proved.  WITNESS is the smallest box that shows it, NIL if
none can; MORE a plist."
  kind rule other grasp (situations 0) (boxes nil) (witness nil) (more '()))

(defmethod print-object ((finding finding) stream)
  (print-unreadable-object (finding stream :type t)
    (plainly
      (format stream "~a~@[ ~a~]~@[ ~a~]~@[ ~a~]" (finding-kind finding) (finding-rule finding)
              (finding-other finding) (finding-grasp finding)))))

;;; Progress

(defvar *progress* nil
  "A function of a text, what is being done, and two numbers, how much of how much is; or NIL.")

(defun note-progress (text done total)
  (when *progress*
    (funcall *progress* text done total)))

(defun terminal-progress (stream)
  "Return a function for *PROGRESS* that shows on STREAM, a terminal, how far work of more than
two seconds has come; called with NIL, it takes its line away."
  (let ((due (+ (get-internal-real-time) (* 2 internal-time-units-per-second)))
        (shown nil))
    (lambda (text done total)
      (let ((now (get-internal-real-time)))
        (cond ((and (null text) shown)
               (format stream "~c~c[K" #\Return (code-char 27))
               (finish-output stream))
              ((and text (>= now due))
               (setf due (+ now (floor internal-time-units-per-second 2))
                     shown t)
               (format stream "~c~a, ~d of ~d~c[K" #\Return text done total (code-char 27))
               (finish-output stream)))))))

(defmacro with-progress (&body body)
  "Run BODY; if it takes more than two seconds, and standard error is a terminal, show how far it
has come there."
  `(let ((*progress* (or *progress*
                         (and (interactive-stream-p *error-output*)
                              (terminal-progress *error-output*)))))
     (unwind-protect (progn ,@body)
       (note-progress nil 0 0))))
