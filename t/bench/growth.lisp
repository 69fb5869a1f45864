;;;; growth.lisp -- how the cost of a plan grows: with rules, grasps, boxes and threads.

(in-package :supergrip-bench)

;;; Knowledge made larger

(defun knowledge-of (rules grasps)
  "Return the knowledge of the forms RULES and GRASPS, which must be right."
  (multiple-value-bind (knowledge problems)
      (supergrip::build-knowledge (supergrip::make-data-file :name "rules" :forms rules)
                                  (supergrip::make-data-file :name "grasps" :forms grasps))
    (when (supergrip-data:errors-in problems)
      (error "~{~a~%~}" problems))
    knowledge))

(defun shipped-grasps ()
  (supergrip::data-file-forms (supergrip::read-data-file (project-file "grasps.lisp"))))

(defun renamed (word number)
  "Return WORD with NUMBER at its end."
  (make-symbol (format nil "~a-~d" word number)))

(defun remembering-rules (rules)
  "Return those of RULES that only remember."
  (remove-if-not (lambda (rule)
                   (every (lambda (action) (string= (first action) "REMEMBER"))
                          (rest (fourth rule))))
                 rules))

(defun copy-of-rules (rules number)
  "Return RULES, which only remember, as if they were about other things: the rules and what they
remember have NUMBER at the end of their names."
  (let ((own (loop for rule in rules
                   append (loop for action in (rest (fourth rule)) collect (second action)))))
    (labels ((other (tree)
               (cond ((consp tree) (mapcar #'other tree))
                     ((member tree own :test #'string=) (renamed tree number))
                     (t tree))))
      (loop for (operator name antecedent consequent) in rules
            collect (list operator (renamed name number) (other antecedent)
                          (other consequent))))))

(defun barred-copy-of-rules (rules number)
  "Return RULES as copies that can't fire: each asks first for what nobody says."
  (loop for (operator name (if . clauses) consequent) in (copy-of-rules rules number)
        collect `(,operator ,name (,if (,(renamed 'task number)) ,@clauses) ,consequent)))

(defun rules-times (factor copier)
  "Return the shipped rules, and copies by COPIER before them until they are FACTOR times as many."
  (let* ((rules (shipped-rules))
         (sources (remembering-rules rules))
         (missing (* (1- factor) (length rules)))
         (copies (loop for number from 1
                       repeat (ceiling missing (length sources))
                       append (funcall copier sources number))))
    ;; Before the others: KEEP ends the run.
    (append (subseq copies 0 missing) rules)))

(defun grasps-times (factor)
  "Return the shipped grasp forms with FACTOR - 1 copies of each grasp."
  (let ((forms (shipped-grasps)))
    (append forms
            (loop for number from 1 below factor
                  append (loop for (operator name value) in forms
                               when (and (string= operator "SETQ") (string/= name "GRIPPER"))
                                 collect (list operator (renamed name number) value))))))

(defun tries-times (factor rules)
  "Return RULES with FACTOR - 1 copies of each TRY, for the copies of the grasps."
  (loop for (operator name antecedent (then . actions)) in rules
        collect (list operator name antecedent
                      (cons then
                            (loop for action in actions
                                  collect action
                                  when (string= (first action) "TRY")
                                    append (loop for number from 1 below factor
                                                 collect (list* (first action)
                                                                (renamed (second action) number)
                                                                (cddr action))))))))

(defun plan-function (knowledge)
  (lambda () (supergrip:plan *box* :knowledge knowledge)))

(defun growth-figures (label factors knowledge)
  "Return the figures of the plan of the pencil with what KNOWLEDGE makes of each of FACTORS."
  (measure-together (loop for factor in factors collect (format nil "~a ×~d" label factor))
                    (loop for factor in factors
                          collect (plan-function (funcall knowledge factor)))))

(defun rules-growth (label copier)
  (let ((grasps (shipped-grasps)))
    (growth-figures label '(1 10 100)
                    (lambda (factor) (knowledge-of (rules-times factor copier) grasps)))))

(defun preparing-growth ()
  "Return the figures of checking and preparing ever more rules, already read, and the grasps."
  (let ((grasps (shipped-grasps))
        (factors '(1 10 100))
        (*batches* (min *batches* 7)))
    (measure-together (loop for factor in factors collect (format nil "preparing rules, ×~d" factor))
                      (loop for factor in factors
                            collect (let ((rules (rules-times factor #'copy-of-rules)))
                                      (lambda () (knowledge-of rules grasps)))))))

(defun grasps-growth ()
  (append (growth-figures "grasps, tried as before," '(1 10)
                          (lambda (factor) (knowledge-of (shipped-rules) (grasps-times factor))))
          (growth-figures "grasps, and tried," '(1 10)
                          (lambda (factor)
                            (knowledge-of (tries-times factor (shipped-rules))
                                          (grasps-times factor))))))

;;; Boxes, and threads

(defun random-box (state)
  "Return a random box of 1 to 15 cm and a task for it."
  (flet ((needs () (loop repeat 6 collect (random 1d0 state))))
    (supergrip:parse-box
     `((size ,@(loop repeat 3 collect (+ 1 (random 14d0 state))))
       (weight ,(random 1d0 state)) (u ,(random 1.5d0 state)) (v ,(random 0.5d0 state))
       (constrained ,@(loop for face in '(x1 x2 y1 y2 z1 z2)
                            when (zerop (random 4 state)) collect face))
       (force-needed ,(needs)) (velocity-needed ,(needs))))))

(defun random-boxes (count seed)
  (let ((state (sb-ext:seed-random-state seed)))
    (loop repeat count collect (random-box state))))

(defun plan-boxes (boxes count)
  "Plan COUNT boxes, those of BOXES in turn."
  (loop repeat count
        for rest = boxes then (or (rest rest) boxes)
        do (supergrip:plan (first rest))))

(defun boxes-growth (counts)
  "Return figures per box of planning each of COUNTS boxes, and the memory in use after each."
  (let ((boxes (random-boxes 1000 1989)))
    (plan-boxes boxes 1000)
    (loop for count in counts
          collect (let* ((before (sb-ext:get-bytes-consed))
                         (seconds (/ (seconds-of (lambda () (plan-boxes boxes count)) 1) count))
                         (bytes (/ (- (sb-ext:get-bytes-consed) before) count)))
                    (figure-of (format nil "10^~d boxes, one of them" (round (log count 10)))
                               (list seconds) bytes))
          collect (progn (sb-ext:gc :full t)
                         (round (sb-kernel:dynamic-usage) (expt 2 20))))))

(defun threads-growth (count)
  "Return figures per box of planning COUNT random boxes in each of 1 and 2 threads."
  (let ((boxes (random-boxes 1000 1989)))
    (flet ((run (threads)
             (/ (seconds-of
                 (lambda ()
                   (mapc #'sb-thread:join-thread
                         (loop repeat threads
                               collect (sb-thread:make-thread #'plan-boxes
                                                              :arguments (list boxes count)))))
                 1)
                (* count threads))))
      (let ((measured (loop repeat 20 collect (list (run 1) (run 2)))))
        (list (figure-of "1 thread, one random box" (mapcar #'first measured))
              (figure-of "2 threads, one random box" (mapcar #'second measured)))))))
