;;;; read-inputs.lisp -- INPUT declares a sentence that the input may say.
;;;;
;;;; What nothing declares can't be told from a slip of the pen, neither in a rule nor in the input.

(in-package :supergrip-chainer)

(defun input-form-p (form)
  "True if FORM is (INPUT ...)."
  (part-p form "INPUT"))

(defun input-words (form)
  "Return the words, names, of the sentence that FORM, (INPUT ...), declares."
  (remove-if-not #'namep (rest form)))

(defun input-subject (form)
  "Return what reports call FORM, (INPUT ...)."
  (format nil "INPUT~{ ~a~}" (input-words form)))

(defun parse-input (form)
  "Enter the predicate that FORM, (INPUT word... (s1 ...)), declares; or complain."
  (let* ((*subject* (input-subject form)) (*place* nil) (*form* form)
         (*variables* '())
         (words (mapcar #'symbol-name (input-words form)))
         (surfaces (find-if #'consp (rest form)))
         (known (gethash (words-text words) *predicates*)))
    (cond ((some #'negation-p (input-words form))
           (complain form "a negation can't be declared: what the input does not say is false"))
          ((and known (declared-p known))
           (complain form "~a declares it already"
                     (form-text (input-declaration-form (predicate-given known)))))
          (known
           (complain form "it is a preliminary assertion, which holds or not whatever the input ~
                           says"))
          ((find-if #'face-index (remove-if-not #'namep surfaces))
           (complain form "a declaration holds for all surfaces: ~a"
                     (input-line (words-text words) (length surfaces))))
          (t (parse-sentence (rest form) form t
                             (make-input-declaration :form form :comment (form-comment form)))))))
