;;;; transcript.lisp -- a plan in the lines of the paper's session.

(in-package :supergrip)

(defmacro do-log ((log) (candidate &body candidate-body) (event &body event-body))
  "Go through LOG, that of a plan or what an action added to it, in order: run CANDIDATE-BODY with
CANDIDATE each grasp that was tried, and EVENT-BODY with EVENT each fact that a rule remembered (see
EVENT-FACT)."
  (let ((entry (gensym "ENTRY")))
    `(dolist (,entry ,log)
       (if (candidate-p ,entry)
           (let ((,candidate ,entry)) ,@candidate-body)
           (let ((,event ,entry)) ,@event-body)))))

(defun write-event (event rulebase stream)
  "Write EVENT of a log, the fact that a rule remembered."
  (multiple-value-bind (predicate face-list) (event-fact event rulebase)
    (format stream "(RULE ~a SAYS ~a~@[ (~{~a~^ ~})~])~%"
            (rule-name (event-rule event rulebase)) (predicate-text predicate)
            (face-list-names face-list))))

(defun write-candidate (candidate stream)
  "Write the line of CANDIDATE, if it is possible."
  (when (candidate-quality candidate)
    (format stream "(~a IS O.K. Q~a~a, MATCHING: (~{~a~^ ~}))~%"
            (candidate-grasp candidate) (quality-sign candidate)
            (three-decimals (candidate-quality candidate))
            (candidate-matching candidate))))

(defun short-decimal (number)
  "Return NUMBER rounded to three decimals, zeros at the end dropped but one: 0.86, 1.0."
  (let* ((text (string-right-trim "0" (three-decimals number))))
    (if (char= (char text (1- (length text))) #\.)
        (concatenate 'string text "0")
        text)))

(defun write-verdict (plan stream)
  "Write the paper's closing lines: which grasp of PLAN is the best, or why there is none."
  (let ((stop (plan-stop plan)))
    (cond ((plan-best plan)
           (format stream "(BEST GRASP~:[~; SO FAR~] IS ~a WITH MATCHING (~{~a~^ ~}))~%"
                   (unfinished-p plan) (plan-grasp plan) (plan-matching plan))
           (format stream "(THE QUALITY INDEX IS ~a)~%" (short-decimal (plan-quality plan))))
          ((unfinished-p plan) (format stream "(~a)~%" (plan-reason plan)))
          ((and stop (eq (stop-verdict stop) :cant))
           (format stream "(RULE ~a SAYS ~a)~%" (rule-name (stop-rule stop))
                   (stop-text stop)))
          (t (format stream "(CANT GRASP: ~a)~%" (plan-reason plan))))))

(defun output-stream (stream)
  "Return STREAM, or *STANDARD-OUTPUT* if it is T; NIL, for nowhere, stays NIL."
  (cond ((eq stream t) *standard-output*)
        ((or (null stream)
             (and (streamp stream) (open-stream-p stream) (output-stream-p stream)))
         stream)
        (t (refuse-argument "~a is not a stream that can be printed to" (form-text stream)))))

(defun write-transcript (plan &optional (stream *standard-output*))
  "Write PLAN to STREAM, or nowhere if that is NIL, in the lines of the paper's session."
  (let ((rulebase (knowledge-rulebase (plan-knowledge (need-plan plan))))
        (stream (or (output-stream stream) (make-broadcast-stream))))
    (plainly
      (do-log ((plan-entries plan))
        (candidate (write-candidate candidate stream))
        (event (write-event event rulebase stream)))
      (write-verdict plan stream)
      (format stream "--END--~%"))))
