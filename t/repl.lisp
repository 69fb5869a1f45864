;;;; repl.lisp -- what may be typed at the REPL, and what is left to the user.

(in-package :supergrip-test)
(define-suite repl "What may be typed at the REPL, and what is left to the user.")

(defpackage :supergrip-test-user
  (:use :cl :supergrip)
  (:documentation "A package as a user might have."))

(defun exported-words ()
  "Return what a user's package gets from SUPER-GRIP, but for special variables."
  (remove-if (lambda (word) (char= #\* (char (symbol-name word) 0)))
             (loop for word being the external-symbols of :supergrip collect word)))

(defun binding-forms (word)
  "Return forms that bind WORD as a variable in all ways."
  `((let ((,word 1)) (declare (fixnum ,word)) (setq ,word 2) ,word)
    (let* ((,word 1)) (incf ,word))
    (dolist (,word '(1)) (print ,word)) (dotimes (,word 2) (print ,word))
    (do ((,word 1 (1+ ,word))) ((> ,word 2)))
    (loop for ,word in '(1) collect ,word)
    (loop with ,word = 1 for (nil . rest) on '(2) collect (list ,word rest))
    (lambda (,word &key (other ,word)) (list ,word other))
    (lambda (&optional ,word) ,word)
    (destructuring-bind (,word . rest) '(1) (list ,word rest))
    (multiple-value-bind (,word) 1 ,word)
    (handler-case 1 (error (,word) ,word))
    (with-output-to-string (,word) (print 1 ,word))
    (flet ((own (,word) ,word)) (own 1)) (labels ((own (,word) ,word)) (own 1))
    (macrolet ((own (,word) ,word)) (own 1))
    (symbol-macrolet ((,word 1)) ,word)
    (block ,word (return-from ,word 1))))

(defun complaint-of-compiling (form)
  "Return what the compiler says of FORM, or an empty string."
  (with-output-to-string (*error-output*)
    (multiple-value-bind (function warnings failure)
        (handler-bind ((sb-ext:compiler-note #'muffle-warning))
          (compile nil `(lambda () ,form)))
      (declare (ignore function warnings))
      (when failure (format *error-output* "~&failed: ~s" form)))))

(test words-of-ours-are-bound-like-others
  (let ((*package* (find-package :supergrip-test-user))
        (words (exported-words)))
    (is (< 100 (length words)))
    (dolist (word words)
      (is (equal "" (complaint-of-compiling `(list ,@(binding-forms word))))))
    (is (equal "" (complaint-of-compiling
                   '(list (flet ((supergrip:box () 1)) (supergrip:box))
                     (labels ((supergrip:box () 1)) (supergrip:box))
                     (macrolet ((supergrip:box () 1)) (supergrip:box))))))))

(test functions-of-ours-are-not-redefined
  (let ((*package* (find-package :supergrip-user))
        (plan #'supergrip:plan))
    (flet ((locked-p (form)
             (handler-case (handler-bind ((warning #'muffle-warning))
                             (eval form)
                             nil)
               (sb-ext:package-lock-violation () t))))
      (dolist (form '((defun supergrip:plan (x) x) (defmacro supergrip:rule (x) x)
                      (defun supergrip::start-plan () 1)
                      (defun supergrip-chainer:recall () 1) (defun supergrip-data:form-text () 1)
                      (defvar supergrip:plan 1) (defstruct supergrip:candidate a)
                      (setf (symbol-function 'supergrip:forward-chain) #'car)))
        (is (locked-p form) "~s" form))
      (is (eq plan #'supergrip:plan)))
    (is (every #'sb-ext:package-locked-p
               '(:supergrip :supergrip-chainer :supergrip-data)))
    (is (notany #'sb-ext:package-locked-p '(:supergrip-user :supergrip-words)))))

(test forward-chain-takes-what-is-meant
  (let ((supergrip:*plan* nil) (supergrip::*box* nil))
    (flet ((best (&rest arguments)
             (supergrip:plan-grasp (apply #'supergrip:forward-chain arguments))))
      (is (equal "PINCH-3-PARALLEL" (best (paper-box) :stream nil)))
      (is (equal "PINCH-3-PARALLEL" (best :box (paper-box) :stream nil)))
      (is (equal '() (printed (best (paper-box) :trace nil))))
      (is (equal (printed (best (paper-box))) (printed (best (paper-box) :stream t)))))
    (loop for (text . arguments) in
          `(("T is not a trace level: levels go from 0 (nothing) to 4 (everything)" :trace t)
            ("-1 is not a trace level: levels go from 0 (nothing) to 4 (everything)" :trace -1)
            ("RULES is not knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in force"
             :knowledge rules)
            ("there is no box yet: set one with (setq box '((SIZE 12 2 2) (WEIGHT 0.2) ...))"
             :box nil)
            ("BOX: 3 is not a box description: it is a list such as ((SIZE 12 2 2) (WEIGHT 0.2) ...)"
             3))
          do (is (equal text (error-text (apply #'supergrip:forward-chain
                                                (append arguments
                                                        (unless (or (member :box arguments)
                                                                    (oddp (length arguments)))
                                                          (list :box (paper-box)))))))))))

(test arguments-that-can-not-be-used-are-told-of
  (let ((supergrip::*breaks* '()) (supergrip::*traced* '())
        (plan (supergrip:plan (paper-box))))
    (loop for (text function . arguments) in
          `(("RULES is not a key of FORWARD-CHAIN: keys are :BOX, :KNOWLEDGE, :GAMMA, :INDEX, :MARGIN, :STREAM, :TRACE, :STEP"
             supergrip:forward-chain :box ,(paper-box) rules 3)
            ("0.3 is not a key of FORWARD-CHAIN: keys are :BOX, :KNOWLEDGE, :GAMMA, :INDEX, :MARGIN, :STREAM, :TRACE, :STEP; a value goes after its key, as in (forward-chain box :gamma 0.3)"
             supergrip:forward-chain ,(paper-box) 0.3)
            ("there is no value after the key :GAMMA of FORWARD-CHAIN" supergrip:forward-chain
             :gamma)
            ("GRIP8 is not knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in force; (describe-rule name) shows one rule"
             supergrip:rules grip8)
            ("PINCH-2-PARALLEL is not knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in force; (grasp name) shows one grasp"
             supergrip:grasps pinch-2-parallel)
            ("FINGER-DIST is not knowledge: LOAD-KNOWLEDGE returns it, *KNOWLEDGE* is in force; (getf (gripper) name) gives one dimension"
             supergrip:gripper finger-dist)
            ("GRASPS is not a stream that can be printed to"
             supergrip:forward-chain ,(paper-box) :stream grasps)
            ("3 is not a stream that can be printed to" supergrip:write-transcript ,plan 3)
            ("3 is not the name of a file: that is a string, or a path without wild cards"
             supergrip:load-knowledge :rules 3)
            ("() is not the name of a file: that is a string, or a path without wild cards"
             supergrip:load-knowledge :grasps ())
            ("3 is not a break: a break is the name of a rule or a grasp, or a fact, such as (PARALLEL (Y2 Y1))" supergrip:unbreak 3)
            ("COLOUR is not a key of a box: keys are SIZE, WEIGHT, U, V, CONSTRAINED, FORCE-NEEDED, VELOCITY-NEEDED, NAME, FACTS, UNITS, MASS, DATA, POSE, CENTRE"
             supergrip:box-value ,(supergrip:plan-box plan) :colour))
          do (is (equal text (error-text (apply function arguments)))))
    (is (search "is not the name of a file"
                (error-text (supergrip:reload-knowledge :rules #p"*.lisp"))))
    (is (equal "" (with-output-to-string (*standard-output*)
                    (supergrip:write-transcript plan nil))))))

(test breaks-on-facts-are-named-in-any-way
  (let ((supergrip:*plan* nil) (supergrip::*breaks* '()) (stops 0))
    (is (= 1 (length (supergrip:break-on '("corner" ("z1" "y2" "x2"))))))
    (is (= 1 (length (supergrip:break-on '(corner (x2 y2 z1))))))
    (handler-bind ((supergrip:chain-break (lambda (condition)
                                            (incf stops)
                                            (invoke-restart (find-restart 'continue condition)))))
      (supergrip:forward-chain (paper-box) :stream nil))
    (is (= 1 stops))
    (is (null (supergrip:unbreak '(corner ("Y2" x2 :z1)))))))

(test questions-at-a-stop-are-about-the-run-in-hand
  (let ((supergrip:*plan* (supergrip:plan (plan-box-too-heavy)))
        (supergrip::*breaks* '())
        (answers '()))
    (supergrip:break-on 'grip4)
    (supergrip:break-on '(corner (z1 y2 x2)))
    (handler-bind
        ((supergrip:chain-break
           (lambda (condition)
             (declare (ignore condition))
             (push (list (printed (supergrip:how '(corner (z1 y1 x2))))
                         (printed (supergrip:why-not 'surfaces3))
                         (printed (supergrip:why-not 'grip4))
                         (let ((last (first (last (let ((*standard-output*
                                                          (make-broadcast-stream)))
                                                    (supergrip:rule-counts))))))
                           (list (first last) (fourth last)))
                         (princ-to-string supergrip:*plan*)
                         (error-text (supergrip:explain-best)))
                   answers)
             (invoke-restart 'continue))))
      (supergrip:forward-chain (paper-box) :stream nil))
    (destructuring-bind (at-grip4 at-corner) answers
      (is (equal "(CORNER (Z1 Y1 X2)) is not known." (first (first at-corner))))
      (is (eql 0 (search "(CORNER (Z1 Y1 X2)): RULE SURFACES3" (first (first at-grip4)))))
      (is (eql 0 (search "RULE SURFACES3 did fire" (first (second at-corner)))))
      (is (equal "RULE GRIP4 has not run yet: the run is now in RULE SURFACES3."
                 (first (third at-corner))))
      (is (equal "RULE GRIP4 has not run yet: the run is now before RULE GRIP4."
                 (first (third at-grip4))))
      (is (equal '("SURFACES3" 1) (fourth at-corner)))
      (is (equal '("SURFACES4" 0) (fourth at-grip4)))
      (is (equal "#<PLAN THE RUN IS NOT OVER>" (fifth at-grip4)))
      (is (equal "the run is not over, so there is no best grasp yet" (sixth at-grip4))))
    (is (equal "PINCH-3-PARALLEL" (supergrip:plan-grasp)) "then it is the plan")
    (is (equal '("RULE GRIP4 did not fire: clause 1, (OBJECT HAS NO PARALLEL SURFACES), fails.")
               (subseq (printed (supergrip:why-not 'grip4)) 0 1)))))

(defun warning-of (function)
  "Return the text of the first warning of FUNCTION, or NIL."
  (handler-case (let ((*standard-output* (make-broadcast-stream)))
                  (funcall function)
                  nil)
    (warning (condition) (princ-to-string condition))))

(test what-is-outdated-is-told-of
  (with-session ()
    (flet ((told (text)
             (loop for question in (list (lambda () (supergrip:how '(parallel (y2 y1))))
                                         (lambda () (supergrip:why-not 'grip8))
                                         #'supergrip:explain-best #'supergrip:possible-grasps
                                         #'supergrip:assertions #'supergrip:rule-counts
                                         #'supergrip:plan-grasp
                                         (lambda () (supergrip:requires 'grip8))
                                         (lambda () (supergrip:keep 'best))
                                         (lambda () (eval-in-user "possible-grasps")))
                   do (is (equal text (warning-of question))))))
      (supergrip:forward-chain :stream nil)
      (told nil)
      (setf (supergrip::current-box) (changed-box :weight 0.3d0))
      (told "the box changed after this plan was made; (forward-chain) makes a new one")
      (is (null (warning-of (lambda () (supergrip:why-not 'grip8 nil supergrip:*plan*)))))
      (setf (supergrip::current-box) (paper-box))
      (told nil)
      (supergrip:edit '(setq finger-length 3.1))
      (setf (supergrip::current-box) (changed-box :weight 0.3d0))
      (told "the box and the knowledge changed after this plan was made; (forward-chain) makes a new one")
      (supergrip:try 'pinch-3-parallel :stream nil)
      (told nil)
      (let ((supergrip:*gamma* 1))
        (told "gamma changed after this plan was made; (try ...) makes a new one"))
      (supergrip:forward-chain (paper-box) :gamma 0.3 :stream nil)
      (told nil))))

(test reports-are-not-cut
  (let ((*print-length* 2) (*print-level* 1) (*print-lines* 1) (*print-right-margin* 20)
        (*print-pretty* t) (*print-base* 2) (*print-case* :downcase))
    (dolist (class '(supergrip:argument-error supergrip:box-error supergrip:knowledge-error
                     supergrip:no-grasp-error supergrip:no-rule-error supergrip:no-fact-error
                     supergrip:gamma-error supergrip:no-plan-error))
      (is (subtypep class 'supergrip:supergrip-error)))
    (with-session ()
      (is (equal "there is no grasp PINCH-9; grasps are PINCH-2-PARALLEL, PINCH-3-PARALLEL, PINCH-3-U-SHAPE, PINCH-3-C-SHAPE, PINCH-2-ADJACENT, PINCH-3-ADJACENT, PINCH-3-CORNER"
                 (error-text (supergrip:try 'pinch-9))))
      (is (search "GRIP11, PINCH-2-PARALLEL" (progn (supergrip:forward-chain :stream nil)
                                                   (error-text (supergrip:why-not 'grip99)))))
      (setf (supergrip::current-box) (changed-box :weight 0.3d0))
      (is (equal "the box changed after this plan was made; (forward-chain) makes a new one"
                 (warning-of #'supergrip:plan-grasp)))
      (is (= 6 (length (lines-of (error-text (supergrip:parse-box '((size 1) (weight 1)))))))))))

(test a-box-that-is-refused-leaves-the-current-one
  (let ((former (supergrip::current-box)))
    (unwind-protect
         (flet ((told (text)
                  (search text (error-text (setf (supergrip::current-box) '((:size 1 2)))))))
           (setf supergrip::*box* nil)
           (is (not (told "current box")))
           (setf (supergrip::current-box) (paper-box))
           (is (told (format nil "~%The current box stays as it was.")))
           (is (equal '(12d0 2d0 2d0) (supergrip:box-size (supergrip::current-box)))))
      (setf supergrip::*box* former))))
