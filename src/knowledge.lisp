;;;; knowledge.lisp -- rules and grasps, read, checked and prepared together.

(in-package :supergrip)

(defstruct (knowledge (:constructor %make-knowledge))
  "Rules and grasps, ready for use; immutable.  WARNINGS holds PROBLEMs that did not prevent it."
  (rulebase nil :type rulebase)
  (graspbase nil :type graspbase)
  (predicates #() :type simple-vector)
  (finger-width 0d0 :type double-float)
  (finger-spread 0d0 :type double-float)
  (dist-pinch 0d0 :type double-float)
  (slippery-u 0d0 :type double-float)
  (warnings '() :type list))

(defmethod print-object ((knowledge knowledge) stream)
  (print-unreadable-object (knowledge stream :type t)
    (format stream "~d rules, ~d grasps" (length (knowledge-rules knowledge))
            (length (knowledge-grasps knowledge)))))

(defun knowledge-rules (knowledge)
  "Return the rules of KNOWLEDGE, a list, in the order in which they run."
  (coerce (rulebase-rules (knowledge-rulebase knowledge)) 'list))

(defun knowledge-grasps (knowledge)
  "Return the grasps of KNOWLEDGE, a list, in the order of the file."
  (graspbase-grasps (knowledge-graspbase knowledge)))

(defun knowledge-gripper (knowledge)
  "Return the dimensions of the gripper of KNOWLEDGE, an alist from name to double, in cm
(SLIPPERY-U: a coefficient)."
  (graspbase-gripper (knowledge-graspbase knowledge)))

(defun assemble (rulebase graspbase problems)
  (flet ((size (name) (or (dimension graspbase name) 0d0)))
    (%make-knowledge :rulebase rulebase :graspbase graspbase
                     :predicates (rulebase-predicates rulebase)
                     :finger-width (size "FINGER-WIDTH") :finger-spread (size "FINGER-SPREAD")
                     :dist-pinch (size "DIST-PINCH") :slippery-u (size "SLIPPERY-U")
                     :warnings (remove :error problems :key #'problem-severity))))

(defun build-knowledge (rule-forms rule-lines rule-file grasp-forms grasp-lines grasp-file)
  "Return the knowledge of the forms of a rule and a grasp file, and the list of all problems.
LINES are tables from form to line, or NIL.  What is wrong is left out."
  (let ((graspbase nil) (rulebase nil))
    (multiple-value-bind (value problems)
        (with-problems
          (let ((*file* grasp-file) (*lines* grasp-lines) (*form* nil))
            (setf graspbase (build-graspbase grasp-forms)))
          (let ((*file* rule-file) (*lines* rule-lines) (*form* nil))
            (setf rulebase (build-rulebase rule-forms +inputs+ :client graspbase))
            (when (null rule-forms)
              (complain nil "there is no rule"))))
      (declare (ignore value))
      (values (assemble rulebase graspbase problems) problems))))

;;; Files

(defvar *kept-files* '()
  "In an executable, which may have left its directory, what READ-DATA-FILE returned for each file
that is shipped: a list of (NAME FORMS LINES PROBLEMS).")

(defun keep-shipped-files ()
  "Keep the shipped rules and grasps in the image."
  (setf *kept-files* (loop for name in '("rules.lisp" "grasps.lisp")
                           collect (cons name (multiple-value-list
                                               (read-data-file (shipped-file name)))))))

(defun shipped-file (name)
  "Return the file NAME of SUPER-GRIP itself, or the entry of *KEPT-FILES* that stands for it."
  (or (assoc name *kept-files* :test #'string=)
      (asdf:system-relative-pathname "supergrip" name)))

(defun read-data-file (file)
  "Return the forms of FILE, a table from form to line, and a list of problems."
  (if (consp file)
      (values-list (rest file))
      (read-file-forms file)))

(defun read-file-forms (file)
  (handler-case
      (with-open-file (in file :external-format '(:utf-8 :replacement #\ufffd))
        (multiple-value-bind (forms lines)
            (read-all (stream-source in :name (report-name file)))
          (values forms lines '())))
    (syntax-error (condition)
      (values '() nil (input-error-problems condition)))
    (file-error ()
      (values '() nil (list (make-file-problem file "this file can't be opened"))))
    (stream-error ()
      (values '() nil (list (make-file-problem file "this file can't be read"))))))

(defun make-file-problem (file text)
  (make-problem :file (report-name file) :text text))

(defun report-name (file)
  "Return the name of FILE as reports give it."
  (if (consp file)
      (first file)
      (file-namestring file)))

(defun read-knowledge (rules grasps)
  "Return the knowledge of the files RULES and GRASPS, and the list of all problems."
  (multiple-value-bind (rule-forms rule-lines rule-problems) (read-data-file rules)
    (multiple-value-bind (grasp-forms grasp-lines grasp-problems) (read-data-file grasps)
      (multiple-value-bind (knowledge problems)
          (build-knowledge rule-forms rule-lines (report-name rules)
                           grasp-forms grasp-lines (report-name grasps))
        ;; What follows from a file that could not be read at all is no news.
        (values knowledge (if (or rule-problems grasp-problems)
                              (append grasp-problems rule-problems)
                              problems))))))

(defun load-knowledge (&key (rules (shipped-file "rules.lisp"))
                         (grasps (shipped-file "grasps.lisp")))
  "Read the files RULES and GRASPS, by default those that are shipped, and return their knowledge.
Signals one KNOWLEDGE-ERROR that holds all that is wrong with them; restarts: RETRY reads the files
again, CONTINUE leaves out the rules and grasps that are wrong."
  (loop
    (multiple-value-bind (knowledge problems) (read-knowledge rules grasps)
      (let ((errors (errors-in problems)))
        (when (null errors)
          (return knowledge))
        (restart-case (error 'knowledge-error :problems errors)
          (retry ()
            :report "Read the rules and the grasps again.")
          (continue ()
            :report "Go on without the rules and grasps that are wrong."
            (return knowledge)))))))

(defvar *knowledge* (load-knowledge)
  "The rules and grasps that plans use if no others are given.")
