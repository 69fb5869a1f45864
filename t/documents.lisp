;;;; documents.lisp -- what README.md and docs/ show is what happens.
;;;;
;;;; A `lisp` block that begins with the prompt * is a transcript of the REPL, and is typed again;
;;;; each document starts from nothing.  Another `lisp` block is data, and must be valid; a `json`
;;;; block is a box.  In a `console` block each line that begins with $ is a command; it runs in the
;;;; project's directory.

(in-package :supergrip-test)
(define-suite documents "What README.md and docs/ show is what happens.")

(defun documents ()
  "Return the names of README.md and of the pages in docs/."
  (cons "README.md"
        (loop for file in (uiop:directory-files (project-file "docs/") "*.md")
              collect (format nil "docs/~a" (file-namestring file)))))

(defun fenced-blocks (document language)
  "Return the blocks of DOCUMENT that are fenced as LANGUAGE, each a list of lines."
  (let ((blocks '()) (block '()) (fence nil))
    (dolist (line (lines-of (file-text document)) (nreverse blocks))
      (cond ((not (eql 0 (search "```" line))) (when fence (push line block)))
            (fence (when (string= fence language)
                     (push (reverse block) blocks))
                   (setf fence nil))
            (t (setf fence (subseq line 3) block '()))))))

(defun transcript-p (block)
  (eql 0 (search "* " (first block))))

;;; The REPL

(defun transcript-steps (block)
  "Return a list of (FORM . LINES) of BLOCK: what is typed, and what comes out."
  (let ((text (format nil "~{~a~%~}" block)) (steps '()) (position 0))
    (loop while (eql (mismatch "* " text :start2 position) 2)
          do (multiple-value-bind (form end)
                 (let ((*package* (find-package :supergrip-user)))
                   (read-from-string text t nil :start (+ position 2)))
               (let* ((next (search (format nil "~%* ") text :start2 (max 0 (1- end))))
                      (output (subseq text end (if next (1+ next) (length text)))))
                 (push (cons form (remove "" (lines-of output) :test #'string=)) steps)
                 (setf position (if next (1+ next) (length text))))))
    (nreverse steps)))

(defun typed (form)
  "Type FORM as at the REPL.  Returns the lines that it prints, warnings among them, and its value."
  (let* ((value nil)
         (lines (printed (handler-bind
                             ((warning (lambda (warning)
                                         (format t "WARNING: ~a~%" warning)
                                         (muffle-warning warning))))
                           (let ((*package* (find-package :supergrip-user)))
                             (setf value (eval form)))))))
    (values lines value)))

(defun check-transcript (block document)
  "Check that each form of BLOCK prints what DOCUMENT shows, with its value after it or without."
  (loop for (form . lines) in (transcript-steps block)
        unless (and (consp form) (eq (first form) 'in-package))
          do (multiple-value-bind (output value) (typed form)
               (let ((with-value (append output
                                         (let ((*package* (find-package :supergrip-user)))
                                           (lines-of (prin1-to-string value))))))
                 (is (or (null lines) (equal lines output) (equal lines with-value))
                     "~a: ~s gave~%~{~a~%~}" document form with-value)))))

(test documents-show-what-is-typed
  (let ((*default-pathname-defaults* (project-file "")))
    (dolist (document (documents))
      (with-knowledge-restored
        (let ((supergrip::*box* nil) (supergrip:*plan* nil))
          (dolist (block (remove-if-not #'transcript-p (fenced-blocks document "lisp")))
            (check-transcript block document)))))))

;;; Data

(defun data-text (block)
  (format nil "~%~{~a~%~}" block))

(defun data-form (text)
  (first (supergrip-data:read-all (supergrip-data:string-source text))))

(defun problems-with-box (text)
  (problem-texts (lambda ()
                   (supergrip:plan (let ((*read-default-float-format* 'double-float))
                                     (read-from-string text))))))

(defun base-text (file text)
  "Return the text of FILE without the forms that TEXT defines: who runs this may have added them."
  (let ((base (file-text file)))
    (dolist (form (supergrip-data:read-all (supergrip-data:string-source text)) base)
      (let* ((head (format nil "~%(~a ~a~%" (first form) (second form)))
             (start (search head base))
             (end (and start (search (format nil "~%~%") base :start2 (1+ start)))))
        (when start
          (setf base (concatenate 'string (subseq base 0 (1+ start))
                                  (if end (subseq base end) ""))))))))

(defun shipped-rules-and (text)
  "Return the shipped rules with TEXT before the one that ends the search."
  (let ((last ";;; Reconstructed: the end of the search"))
    (replace-once (base-text "rules.lisp" text) last (format nil "~a~%~a" text last))))

(defun shipped-grasps-and (text)
  (concatenate 'string (base-text "grasps.lisp" text) text))

(defun problems-with-data (texts)
  "Return what is wrong with TEXTS, those of a document's boxes, rules and grasps."
  (let ((rules "") (grasps ""))
    (append
     (loop for text in texts
           for form = (data-form text)
           for rule-p = (supergrip-data:name= (first form) "RULE")
           for shipped = (and rule-p (shipped-form "rules.lisp" "RULE" (second form)))
           append (cond ((consp (first form)) (problems-with-box text))
                        (shipped (unless (same-form-p shipped form)
                                   (list (format nil "~a is not as it is shipped" (second form)))))
                        (rule-p (setf rules (concatenate 'string rules text)) nil)
                        (t (setf grasps (concatenate 'string grasps text)) nil)))
     (knowledge-reports (shipped-rules-and rules) (shipped-grasps-and grasps)))))

(test documents-show-data-that-is-valid
  (dolist (document (documents))
    (let ((problems (problems-with-data
                     (mapcar #'data-text
                             (remove-if #'transcript-p (fenced-blocks document "lisp"))))))
      (is (null problems) "~a: ~{~a~%~}" document problems))))

(defun lateral-blocks ()
  "Return the texts of the grasp and the rule that docs/languages.md adds."
  (loop for block in (fenced-blocks "docs/languages.md" "lisp")
        for text = (data-text block)
        when (search "LATERAL" text) collect text))

(defun without-digits (text)
  (remove-if #'digit-char-p text))

(test a-new-grasp-takes-two-edits
  (destructuring-bind (grasp rule) (lateral-blocks)
    (let* ((grasps (shipped-grasps-and grasp))
           (rules (shipped-rules-and rule))
           (reports (mapcar #'princ-to-string
                            (nth-value 1 (text-knowledge (base-text "rules.lisp" rule)
                                                         grasps)))))
      (is (= 1 (length reports)))
      (is (search (without-digits (first reports)) (without-digits (file-text "docs/languages.md")))
          "it says ~a" (first reports))
      (multiple-value-bind (knowledge problems) (text-knowledge rules grasps)
        (is (null problems))
        (is (= 3 (count "LATERAL" (supergrip:plan-possible
                                   (supergrip:plan '((size 8.6d0 5.4d0 0.08d0) (weight 0.005d0)
                                                     (u 0.4d0) (v 0.1d0) (constrained x2)
                                                     (force-needed (1 1 1 0 0 0))
                                                     (velocity-needed (1 1 1 0 0 0)))
                                                   :knowledge knowledge))
                        :key #'supergrip:candidate-grasp :test #'string=)))))))

;;; Commands

(defun commands (block)
  "Return a list of (COMMAND . LINES) of BLOCK."
  (let ((commands '()))
    (dolist (line block)
      (if (eql 0 (search "$ " line))
          (push (list (subseq line 2)) commands)
          (push line (rest (first commands)))))
    (loop for (command . lines) in (nreverse commands)
          collect (cons command (reverse lines)))))

(defun without-space (lines)
  "Return the characters of LINES without space: a long record is shown on several lines."
  (remove-if (lambda (character) (find character '(#\Space #\Newline)))
             (format nil "~{~a~%~}" lines)))

(defun runs-here-p (command)
  "True if what COMMAND runs is there: Python may not be."
  (or (not (search "python3" command))
      (zerop (run-process '("sh" "-c" "command -v python3")))))

(test documents-show-what-commands-print
  (dolist (document (documents))
    (dolist (block (fenced-blocks document "console"))
      (loop for (command . lines) in (remove-if-not #'runs-here-p (commands block) :key #'first)
            do (multiple-value-bind (status output errors)
                   (run-process (list "sh" "-c" command) :directory (project-file ""))
                 (declare (ignore status))
                 (is (string= (without-space lines) (without-space (lines-of output)))
                     "~a: ~a printed~%~a~a" document command output errors))))))

;;; The batch

(test documents-show-boxes-in-json-that-are-valid
  (dolist (document (documents))
    (dolist (block (fenced-blocks document "json"))
      (is (equal '("grasp") (statuses (answers (format nil "~{~a~%~}" block)))) document))))

(test the-page-on-the-batch-names-every-option
  (let ((page (file-text "docs/batch.md"))
        (help (nth-value 1 (run-process (list (program) "--help")))))
    (loop for line in (lines-of help)
          for option = (string-trim " " line)
          when (eql 0 (search "--" option))
            do (is (search (subseq option 0 (position #\Space option)) page) option))))

;;; Links

(defparameter *directories* '("src/" "t/" "examples/" "docs/"))

(defun texts-between (start end text)
  "Return what stands in TEXT between each START, a string, and the next END, a character."
  (loop for place = (search start text) then (search start text :start2 to)
        for from = (and place (+ place (length start)))
        for to = (and place (position end text :start from))
        while to collect (subseq text from to)))

(defun linked-files (document)
  "Return the files that DOCUMENT names: in its links, relative to it, and between backquotes,
relative to the project, if they are in one of *DIRECTORIES*."
  (let ((text (file-text document)))
    (append
     (loop for link in (texts-between "](" #\) text)
           for name = (subseq link 0 (position #\# link))
           unless (or (search "://" link) (string= name ""))
             collect (uiop:subpathname (project-file document) name))
     (loop for directory in *directories*
           append (loop for rest in (texts-between (format nil "`~a" directory) #\` text)
                        for name = (concatenate 'string directory rest)
                        unless (find-if (lambda (c) (find c " *{<")) name)
                          collect (project-file name)))
     (loop for (room) in (rooms)
           append (loop for name in (texts-between (format nil "`~a/" room) #\` text)
                        unless (string= name "")
                          collect (project-file (format nil "src/~a/~a" room name)))))))

;;; The house

(defun component-files (component)
  "Return the names of the Lisp files of COMPONENT, packages apart, in the order of loading."
  (loop for child in (asdf:component-children component)
        for name = (asdf:component-name child)
        when (and (typep child 'asdf:cl-source-file) (string/= name "package"))
          collect name))

(defun rooms ()
  "Return a list of (ROOM . FILES), strings, as the systems have them."
  (append (loop for system
                in '("supergrip/chainer" "supergrip/statics" "supergrip" "supergrip/batch")
                append (loop for room in (asdf:component-children (asdf:find-system system))
                             when (typep room 'asdf:module)
                               collect (cons (asdf:component-name room) (component-files room))))
          (list (cons "draw" (component-files (asdf:find-system "supergrip/draw"))))))

(test the-page-on-the-house-lists-every-file
  (let ((lines (lines-of (file-text "docs/development.md"))))
    (loop for (room . files) in (rooms)
          for start = (format nil "| `~a/` |" room)
          for row = (find-if (lambda (line) (eql 0 (search start line))) lines)
          do (is (search (format nil "| ~{~a~^, ~} |" files) row) "~a: ~{~a~^, ~}" room files))))

(test each-suite-has-the-name-of-its-file
  (dolist (file (uiop:directory-files (project-file "t/") "*.lisp"))
    (dolist (line (lines-of (uiop:read-file-string file)))
      (when (eql 0 (search "(define-suite " line))
        (is (equal (pathname-name file) (second (uiop:split-string line))) "~a" file)))))

(test documents-name-files-that-are-there
  (dolist (document (documents))
    (dolist (file (linked-files document))
      (is (uiop:probe-file* file) "~a names ~a" document file))))
