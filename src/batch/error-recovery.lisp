;;;; error-recovery.lisp -- going on after an error in a record.

(in-package :supergrip)

(defun skip-record (source)
  "Skip what is left of a record in which READ-DATUM has found an error: as far as the parenthesis
that closes it or, outside all parentheses, as far as the next one or the end of the line."
  (end-record source)
  (loop for character = (peek source)
        while character
        until (and (zerop (source-depth source)) (null (source-inside source))
                   (char= character #\())
        do (next source)
           (when (skip-character source character)
             (return))))

(defun skip-character (source character)
  "Note what CHARACTER, just skipped, opens or closes; true if it ends the record."
  (case (source-inside source)
    (:string (case character
               (#\\ (when (peek source) (next source)))
               (#\" (setf (source-inside source) nil)))
     nil)
    (t (case character
         (#\Newline (setf (source-inside source) nil)
          (zerop (source-depth source)))
         (t (unless (source-inside source)
              (skip-delimiter source character)))))))

(defun skip-delimiter (source character)
  (case character
    (#\" (setf (source-inside source) :string)
     nil)
    (#\; (setf (source-inside source) :comment)
     nil)
    (#\( (incf (source-depth source))
     nil)
    (#\) (and (plusp (source-depth source))
              (zerop (decf (source-depth source)))))))
