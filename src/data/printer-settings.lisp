;;;; printer-settings.lisp -- text that is the same whatever the user's printer is set to.

(in-package :supergrip-data)

(defvar *plain-readtable* (copy-readtable nil)
  "The standard readtable: names are printed as its case says.")

(defmacro plainly (&body body)
  "Run BODY, which makes or prints text, with the printer's standard settings.  Whether it escapes
stays as it is."
  `(let ((*print-base* 10) (*print-radix* nil) (*print-case* :upcase) (*print-circle* nil)
         (*print-pretty* nil) (*print-length* nil) (*print-level* nil) (*print-lines* nil)
         (*print-right-margin* nil) (*print-readably* nil) (*print-gensym* nil)
         (*readtable* *plain-readtable*) (*read-default-float-format* 'single-float))
     ,@body))

(defun plain-text (control &rest arguments)
  "Return what FORMAT makes of CONTROL and ARGUMENTS, whatever the printer's settings."
  (plainly (apply #'format nil control arguments)))

(defmacro define-printing ((object class) control &rest arguments)
  "Print OBJECT, of CLASS, as #<CLASS ...>, with what FORMAT makes of CONTROL and ARGUMENTS."
  `(defmethod print-object ((,object ,class) stream)
     (print-unreadable-object (,object stream :type t)
       (plainly (format stream ,control ,@arguments)))))
