;;;; repl.lisp -- SUPER-GRIP at the REPL: (setq box '(...)), then (forward-chain).

(in-package :supergrip)

(defun current-box ()
  "Return the box that was set last, or NIL."
  *box*)

(defun (setf current-box) (description)
  "Check DESCRIPTION and make it the box of FORWARD-CHAIN.  On a BOX-ERROR the former one stays."
  (handler-bind ((box-error (lambda (condition)
                              (when *box*
                                (setf (input-error-consequence condition)
                                      "The current box stays as it was.")))))
    (setf *box* (box-of description))))

(define-symbol-macro box (current-box))

(defun forward-chain (&rest arguments)
  "Choose the best grasp for the box, print what the rules say, what is possible and what is best,
and return the plan, which *PLAN* also holds.

ARGUMENTS are keys and values: :BOX a box or a description of one, by default what (setq box ...)
gave, which may also stand first, without its key; :KNOWLEDGE, by default what is in force; :GAMMA
weighs velocities (1) against forces (0); :INDEX is :PAPER or :EXACT, :MARGIN a factor of the
weight (see PLAN); :STREAM is where to print, NIL for not at all; :TRACE says how much to print
(see *TRACE-LEVEL*); :STEP, if true, stops in the debugger before each rule."
  (apply #'chain-box
         (checked-keys (if (or (null arguments) (keywordp (first arguments)))
                           arguments
                           (cons :box arguments))
                       'forward-chain '(:box :knowledge :gamma :index :margin :stream :trace :step)
                       "(forward-chain box :gamma 0.3)")))

(defun chain-box (&key ((:box given) *box*) (knowledge *knowledge*) (gamma *gamma*)
                    (index :paper) margin (stream *standard-output*) ((:trace level) *trace-level*)
                    step)
  "Do what FORWARD-CHAIN does."
  (let ((given (box-at-margin (or given (error 'no-box-error)) margin))
        (level (check-trace-level level))
        (knowledge (check-knowledge-argument knowledge))
        (stream (output-stream stream)))
    (if (or step *traced* *breaks* (> level 1))
        (make-last (traced-plan given knowledge gamma index level step
                                (if (and stream (or (plusp level) *traced*))
                                    stream
                                    (make-broadcast-stream))))
        (progn
          (make-last (plan given :knowledge knowledge :gamma gamma :index index))
          (when (and stream (= level 1))
            (write-transcript *plan* stream))))
    *plan*))

(defun possible-grasps (&optional (plan (last-plan)))
  "Return the paper's list POSSIBLE-GRASPS of PLAN, the best first: for each possible grasp its
name, its quality and its matching."
  (loop for candidate in (plan-possible (need-plan plan))
        collect (list (candidate-grasp candidate) (candidate-quality candidate)
                      (candidate-matching candidate))))
