;;;; sbcl.lisp -- what the core needs of SBCL itself: atomic lists, floating point modes, file names.

(in-package :supergrip-data)

;;; Lists that several threads share

(defmacro take-from (place)
  "Take the first element of the list in PLACE, a slot of a structure, or return NIL."
  `(sb-ext:atomic-pop ,place))

(defmacro give-to (place object)
  "Put OBJECT before the list in PLACE, a slot of a structure."
  `(sb-ext:atomic-push ,object ,place))

;;; Floating point

(defconstant +float-flags+ (dpb -1 sb-vm:float-sticky-bits 0)
  "The bits of the floating point modes that only say what happened.")

(defconstant +harmless-modes+
  (logior +float-flags+
          (dpb (logior sb-vm:float-overflow-trap-bit sb-vm:float-invalid-trap-bit
                       sb-vm:float-divide-by-zero-trap-bit)
               sb-vm:float-traps-byte 0))
  "The bits on which no plan depends: flags, and the traps of operations without a value, which fail
with or without a trap.")

(declaim (inline call-with-float-modes))
(defun call-with-float-modes (kept function)
  "Call FUNCTION with the bits KEPT of the floating point modes as they are, and the others 0."
  (let ((modes (sb-vm:floating-point-modes)))
    (if (zerop (logandc2 modes kept))   ; setting them costs ten times as much
        (funcall function)
        (unwind-protect
             (progn (setf (sb-vm:floating-point-modes) (logand modes kept))
                    (funcall function))
          (setf (sb-vm:floating-point-modes) modes)))))

(defmacro with-float-modes ((kept) &body body)
  (let ((function (gensym "BODY")))
    `(flet ((,function () ,@body))
       (declare (dynamic-extent #',function))
       (call-with-float-modes ,kept #',function))))

(defmacro with-plain-floats (&body body)
  "Run BODY with numbers rounded to the nearest and no trap for inexact or tiny ones, whatever the
caller has set."
  `(with-float-modes (+harmless-modes+) ,@body))

(defmacro without-float-traps (&body body)
  "As WITH-PLAIN-FLOATS; where an operation has no value, it gives an infinity or a NaN."
  `(with-float-modes (+float-flags+) ,@body))

;;; File names

(defun native-path (file &key directory)
  "Return the path of FILE: a path, or its name as the system has it, a string in which no character
but / means anything.  If DIRECTORY is true, it is a directory, with or without a / at its end."
  (if (stringp file)
      (sb-ext:parse-native-namestring file nil *default-pathname-defaults*
                                      :as-directory directory)
      (if directory (uiop:ensure-directory-pathname file) (pathname file))))

;;; The compiler

(defun global-name-p (name environment typed)
  "True if ENVIRONMENT, a macro's, is that of top level, and NAME is no variable but one of TYPED, words
that are typed like variables."
  (and (or (null environment) (sb-c::null-lexenv-p environment))
       (or (member name typed) (eq (sb-int:info :variable :kind name) :unknown))))
