;;;; former-names.lisp -- names of 0.1.0 that have better ones now.  They go in 0.3.

(in-package :supergrip)

(defmacro define-former-names (&rest pairs)
  "Let each old name of PAIRS, lists of an old and a new name of a function, mean the new one."
  `(progn
     ,@(loop for (old new) in pairs
             collect `(defun ,old (&rest arguments)
                        ,(format nil "The name of ~a in 0.1.0." new)
                        (apply #',new arguments)))))

(define-former-names
  (explain-refusal explain-why-not) (advise explain-choice)
  (advice-sentence choice-sentence) (advice-force choice-force) (advice-velocity choice-velocity)
  (advice-runner-up choice-runner-up) (advice-margin choice-margin)
  (advice-changes choice-changes) (derivation-packed derivation-face-list)
  (surface-index face-index) (surface-name face-name) (surface-axis face-axis)
  (surface-sign face-sign) (pack make-face-list) (pack-mask face-list-mask)
  (pack-count face-list-count) (pack-elements face-list-elements) (pack-names face-list-names))

(deftype advice () "The name of CHOICE in 0.1.0." 'choice)
(deftype surface () "The name of FACE in 0.1.0." 'face)
(define-symbol-macro +surfaces+ +faces+)
(setf (documentation '+surfaces+ 'variable) "The name of +FACES+ in 0.1.0.")
