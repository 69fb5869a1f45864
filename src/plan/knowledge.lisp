;;;; knowledge.lisp -- rules and grasps, read, checked and prepared together.

(in-package :supergrip)

(defstruct (knowledge (:constructor %make-knowledge))
  "Rules and grasps, ready for use; immutable, but for SPARE, scratch space that plans give back
(see START-PLAN).  INPUTS are the preliminary assertions, prepared; USES the DIMENSION-USEs of rules
and grasps.  RULE-FILE, GRASP-FILE and GRIPPER-FILE, which is NIL if the
gripper is that of the grasp file, are what they were made of, COMPLAINTS the PROBLEMs that did not
prevent it."
  (rule-file nil :read-only t)
  (grasp-file nil :read-only t)
  (gripper-file nil :read-only t)
  (rulebase nil :type rulebase :read-only t)
  (graspbase nil :type graspbase :read-only t)
  (inputs '() :type list :read-only t)
  (uses '() :type list :read-only t)
  (complaints '() :type list :read-only t)
  (spare '() :type list))

(defun knowledge-warnings (knowledge)
  "Return the PROBLEMs of KNOWLEDGE that did not prevent its use."
  (copy-list (knowledge-complaints knowledge)))

(define-printing (knowledge knowledge) "~d rule~:p, ~d grasp~:p"
  (length (knowledge-rules knowledge)) (length (knowledge-grasps knowledge)))

(defun knowledge-rules (knowledge)
  "Return the rules of KNOWLEDGE, a list, in the order in which they run."
  (coerce (rulebase-rules (knowledge-rulebase knowledge)) 'list))

(defun knowledge-grasps (knowledge)
  "Return the grasps of KNOWLEDGE, a new list, in the order of the file."
  (copy-list (graspbase-grasps (knowledge-graspbase knowledge))))

(defun knowledge-gripper (knowledge)
  "Return the dimensions of the gripper of KNOWLEDGE, a new alist from name to double, in cm
(SLIPPERY-U: a coefficient; FINGER-FORCE, if it is there: N)."
  (copy-alist (gripper-dimensions (graspbase-gripper (knowledge-graspbase knowledge)))))

(defun knowledge-model (knowledge)
  "Return the MODEL of the gripper of KNOWLEDGE, a string, or NIL."
  (gripper-model (graspbase-gripper (knowledge-graspbase knowledge))))

(defun gripper-source (knowledge)
  "Return the data file that has the gripper of KNOWLEDGE."
  (or (knowledge-gripper-file knowledge) (knowledge-grasp-file knowledge)))

(defun declared-inputs (knowledge)
  "Return what the rule file of KNOWLEDGE declares by (INPUT ...), in the order of the file: a new
list of (WORDS COUNT).  WORDS is a list of strings, COUNT how many faces each list of such a fact
has."
  (loop for predicate across (rulebase-predicates (knowledge-rulebase knowledge))
        when (declared-p predicate)
          collect (list (copy-list (predicate-words predicate)) (predicate-arity predicate))))

(defstruct data-file
  "A rule, grasp or gripper file that was read: its PATH, if it is one, its NAME in reports, its
FORMS, LINES, a table from form to line, COMMENTS, one from form to comment, and the PROBLEMS of
reading it."
  (path nil) (name nil) (forms '() :type list) (lines nil) (comments nil) (problems '() :type list))

(defmacro with-data-file ((file) &body body)
  "Run BODY with what it complains of placed in the data file FILE."
  `(let ((*file* (data-file-name ,file)) (*lines* (data-file-lines ,file))
         (*comments* (data-file-comments ,file)) (*form* nil))
     ,@body))

(defun build-grasps (grasp-file gripper-file)
  "Return the graspbase of GRASP-FILE and, if that is not NIL, of the gripper in GRIPPER-FILE."
  (with-plain-floats
    (let* ((source (or gripper-file grasp-file))
           (gripper (with-data-file (source)
                      (build-gripper (data-file-forms source) :alone gripper-file))))
      (with-data-file (grasp-file)
        (build-graspbase (data-file-forms grasp-file) gripper)))))

(defun threshold-uses (forms)
  "Return the DIMENSION-USEs of the rules FORMS: of the thresholds of the preliminary assertions
that they test."
  (loop for (rule words clause) in (tested-sentences forms)
        for row = (find words *inputs* :key #'input-row-name :test #'string=)
        when (and row (input-row-dimension row))
          collect (make-dimension-use :dimension (input-row-dimension row) :kind "RULE" :user rule
                                      :place (form-place-text clause) :assertion words)))

(defun build-rules (rule-file graspbase)
  "Return the rulebase of RULE-FILE, whose rules try the grasps of GRASPBASE, and its
DIMENSION-USEs.  Rules that test a threshold that the gripper lacks are left out."
  (with-data-file (rule-file)
    (let* ((forms (data-file-forms rule-file))
           (uses (threshold-uses forms))
           (lame (remove-if (lambda (use) (dimension graspbase (dimension-use-dimension use)))
                            uses)))
      (flet ((build (forms)
               (build-rulebase forms (input-predicates) :client graspbase))
             (lame-p (form)
               (and (part-p form "RULE")
                    (find (second form) lame :key #'dimension-use-user :test #'name=))))
        (let ((rulebase (build forms)))
          (values (if lame
                      ;; What follows from their absence is no news.
                      (values (with-problems (build (remove-if #'lame-p forms))))
                      rulebase)
                  uses))))))

(defun build-knowledge (rule-file grasp-file &optional gripper-file)
  "Return the knowledge in RULE-FILE, GRASP-FILE and, if that is not NIL, GRIPPER-FILE, data files,
and the list of all problems.  What is wrong is left out."
  (multiple-value-bind (make problems)
      (with-problems
        (let ((graspbase (build-grasps grasp-file gripper-file)))
          (multiple-value-bind (rulebase uses) (build-rules rule-file graspbase)
            (let ((uses (append (graspbase-uses graspbase) uses)))
              (with-data-file ((or gripper-file grasp-file))
                (check-dimensions (graspbase-gripper graspbase) uses (graspbase-rows graspbase)))
              (check-knowledge graspbase rulebase rule-file grasp-file)
              (lambda (problems)
                (%make-knowledge :rulebase rulebase :graspbase graspbase :uses uses
                                 :rule-file rule-file :grasp-file grasp-file
                                 :gripper-file gripper-file
                                 :inputs (prepare-inputs rulebase graspbase)
                                 :complaints (warnings-in problems)))))))
    ;; What follows from a file that could not be read at all is no news.
    (let ((problems (or (loop for file in (list gripper-file grasp-file rule-file)
                              append (and file (data-file-problems file)))
                        problems)))
      (values (funcall make problems) problems))))

;;; Knowledge with a change

(defun edited-file (file edit)
  "Return the data file FILE with the forms that EDIT, a function, makes of its own."
  (let ((copy (copy-data-file file)))
    (setf (data-file-forms copy) (funcall edit (data-file-forms file)))
    copy))

(defun with-dimension (name value forms)
  "Return FORMS, those of the file that has the gripper, with VALUE for its dimension NAME."
  (flet ((changed (form)
           (let ((list (flat-list (second (third form)))))
             `(,(first form) ,(second form)
               (:quote ,(append (loop for (key old) on list by #'cddr
                                      collect key
                                      collect (if (name= key name) value old))
                                (unless (loop for (key) on list by #'cddr thereis (name= key name))
                                  (list name value))))))))
    (loop for form in forms
          collect (if (gripper-form-p form) (changed form) form))))

;;; What can't be meant

(defun check-knowledge (graspbase rulebase rule-file grasp-file)
  "Warn of what is valid in rules and grasps but can't be meant."
  (with-data-file (rule-file)
    (when (null (rule-forms rule-file))
      (complain nil "there is no rule"))
    (check-rules (data-file-forms rule-file) (input-predicates)))
  (with-data-file (grasp-file)
    (check-contacts graspbase))
  ;; Where a rule was left out, that nothing tries a grasp is no news.
  (when (= (length (rulebase-rules rulebase)) (length (rule-forms rule-file)))
    (with-data-file (grasp-file)
      (check-tried graspbase (data-file-forms rule-file)))))

(defun rule-forms (rule-file)
  "Return the forms of RULE-FILE that declare no input."
  (remove-if #'input-form-p (data-file-forms rule-file)))

(defun tried-names (form)
  "Return the names of the grasps that the rule FORM tries."
  (loop for action in (rest (find-if (lambda (part) (part-p part "THEN")) form))
        when (and (consp action) (namep (first action)))
          append (mapcar #'symbol-name (action-mentions (verb-key (first action))
                                                        (rest action)))))

(defun check-tried (graspbase rule-forms)
  "Warn of grasps that no rule tries."
  (let ((tried (make-hash-table :test #'equal)))
    (dolist (form rule-forms)
      (when (part-p form "RULE")
        (dolist (name (tried-names form)) (setf (gethash name tried) t))))
    (dolist (grasp (graspbase-grasps graspbase))
      (unless (gethash (grasp-name grasp) tried)
        (let ((*subject* (format nil "GRASP ~a" (grasp-name grasp))))
          (complain (grasp-definition grasp) '(:warning "no rule tries it")))))))

;;; Files

(defvar *kept-files* '()
  "In an executable, which may have left its directory, the data files of what is shipped.")

(defun keep-shipped-files ()
  "Keep the shipped rules and grasps in the image."
  (setf *kept-files* (loop for name in '("rules.lisp" "grasps.lisp")
                           for file = (read-data-file (shipped-file name))
                           do (setf (data-file-path file) nil)
                           collect file)))

(defparameter *home* (asdf:system-source-directory "supergrip")
  "The directory of SUPER-GRIP, as it was loaded: later ASDF might find another.")

(defun shipped-file (name)
  "Return the path of the file NAME of SUPER-GRIP itself, or the data file that was kept of it."
  (or (find name *kept-files* :key #'data-file-name :test #'string=)
      (merge-pathnames name *home*)))

(defun data-file-of (file)
  "Return the data file, not read yet, that FILE, a path, is at this moment; or FILE itself if it is
one.  Its name in reports is FILE as it was given, but a shipped file goes by its own name."
  (if (data-file-p file)
      file
      (let ((path (native-path file)))
        (make-data-file :path (uiop:ensure-absolute-pathname (merge-pathnames path) #'uiop:getcwd)
                        :name (cond ((stringp file) file)
                                    ((equal path (shipped-file (file-namestring path)))
                                     (file-namestring path))
                                    (t (native-name path)))))))

(defun read-data-file (file)
  "Return the data file of FILE, a path or a data file, read anew if it has a path; what prevents
its being read is among its problems."
  (let* ((file (data-file-of file)) (path (data-file-path file)) (name (data-file-name file)))
    (flet ((unusable (problems)
             (make-data-file :path path :name name :problems problems)))
      (handler-case
          (if path
              (multiple-value-bind (forms lines comments)
                  (read-all (file-source (file-text (native-name path)) name) :loose-names t)
                (make-data-file :path path :name name :forms forms :lines lines
                                :comments comments))
              file)
        (syntax-error (condition)
          (unusable (input-error-problems condition)))
        (system-failure (condition)
          (unusable (list (make-problem :file name
                                        :text (format nil "this file ~a" condition)))))))))

(defun file-source (text name)
  "Return a source that reads TEXT, that of the file NAME.  Signals a SYNTAX-ERROR if it can't be
read."
  (cond ((utf-16-p text 0 (length text))
         (refuse-syntax (list :file name)
                        "this file is UTF-16, but must be UTF-8; iconv -f UTF-16 -t UTF-8 converts ~
                         it"))
        ((> (length text) (room-for (length text)))
         (refuse-syntax (list :file name)
                        "this file is longer than the ~d characters that the heap has room for; ~
                         --dynamic-space-size makes the heap larger"
                        (room-for (length text))))
        (t (string-source text :name name))))

(defun accept-knowledge (make &optional told)
  "Return the knowledge that MAKE, a function that returns it and a list of problems, makes.
Signals a KNOWLEDGE-ERROR with all of them if one is an error; warns if there are only warnings.
Those that were TOLD before are not told again."
  (multiple-value-bind (knowledge problems) (funcall make)
    (let ((news (remove-if (lambda (problem) (member problem told :test #'equalp)) problems)))
      (cond ((errors-in news)
             (error 'knowledge-error :problems news))
            (news
             (warn 'knowledge-warning :problems news))))
    knowledge))

(defun accept-files (read)
  "Return the knowledge that READ makes, as ACCEPT-KNOWLEDGE does, with the restarts RETRY, which
calls READ again, and CONTINUE, which goes on without the rules and grasps that are wrong."
  (loop
    (restart-case (return (accept-knowledge read))
      (retry ()
        :report "Read the rules and the grasps again.")
      (continue ()
        :report "Go on without the rules and grasps that are wrong."
        (return (values (funcall read)))))))

(defun hand-file (hand name)
  "Return the file NAME of the folder HAND, as a path or as a string, as HAND is; and true if it is
there."
  (let ((file (if (stringp hand)
                  (format nil "~a/~a" (string-right-trim "/" hand) name)
                  (merge-pathnames name (native-path hand :directory t)))))
    (values file (probe-file (native-path file)))))

(defun knowledge-file (name hand)
  "Return the file NAME of the folder HAND, or, if that is NIL or lacks it, the one that is
shipped."
  (multiple-value-bind (file there) (and hand (hand-file hand name))
    (if there file (shipped-file name))))

(defun hand-gripper (hand)
  "Return the file gripper.lisp of the folder HAND; NIL if it lacks that and has grasps.lisp, which
may hold the gripper, too."
  (multiple-value-bind (gripper there) (hand-file hand "gripper.lisp")
    (and (or there (not (nth-value 1 (hand-file hand "grasps.lisp"))))
         gripper)))

(defun load-knowledge (&key hand
                         (rules (knowledge-file "rules.lisp" hand))
                         (grasps (knowledge-file "grasps.lisp" hand))
                         (gripper (and hand (hand-gripper hand))))
  "Read the files RULES and GRASPS, by default those that are shipped, and return their knowledge.
GRIPPER is a file that holds a gripper alone, which takes the place of the one in GRASPS.  HAND is a
folder that holds what belongs to one hand: gripper.lisp, rules.lisp and grasps.lisp; where it lacks
one of the last two, the shipped one serves.  Where it lacks the first, grasps.lisp has the gripper.

Signals one KNOWLEDGE-ERROR that holds all that is wrong with them; restarts: RETRY reads the files
again, CONTINUE leaves out the rules and grasps that are wrong.  What is valid but can't be meant is
a KNOWLEDGE-WARNING."
  (let ((files (mapcar #'data-file-of (list* rules grasps (and gripper (list gripper))))))
    (accept-files (lambda () (apply #'build-knowledge (mapcar #'read-data-file files))))))

(defvar *knowledge* (load-knowledge)
  "The rules and grasps that plans use if no others are given.")
