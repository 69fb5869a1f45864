;;;; options.lisp -- the options of the command line, one row each, and what --help says of them.

(in-package :supergrip)

(defparameter +version+ (asdf:component-version (asdf:find-system "supergrip"))
  "The version of SUPER-GRIP, a string.")

(defparameter +help+
  "usage: supergrip [OPTION]... [FILE]...

Read boxes from each FILE, or from standard input without FILE or where FILE is -, and write one
record a box to standard output, in the same order: the best of seven grasps for each.

  --input sexp|json         what boxes look like; by default as the input begins
  --format trace|sexp|json  what records look like: the paper's lines, one s-expression a line, or
                            one JSON object a line; by default as the boxes
  --format isaac|moveit|graspgen
                            in place of records, the grasps for another program (docs/formats.md):
                            all possible ones of each box, or with --all N so many
  --mjcf DIR                also write the best grasp of each box into DIR, as a model for MuJoCo
  --rules FILE              rules to use instead of those that are built in
  --grasps FILE             grasps and gripper to use instead of those that are built in
  --gripper FILE            the gripper alone, which takes the place of that of the grasps
  --hand DIR                a hand's own gripper.lisp, rules.lisp and grasps.lisp; where DIR lacks one
                            of the last two, what is built in serves
  --gamma X                 from 0, forces alone, to 1, velocities alone; 0.5 by default
  --index paper|exact       what grasps are rated by: the paper's index, or what their contacts can
                            really do, proved, which takes a thousand times as long
  --all N                   also write the N best possible grasps of each box, the best first, with all
                            that is written of the best; 1000 at most
  --refine                  also move the fingers of the three best grasps to better places, and write
                            where they went, what that gains, and how much more is possible at most;
                            about half a second a box
  --report DIR              also write a page for each box into DIR, and an index with thumbnails;
                            needs cl-who (docs/pictures.md), and keeps all plans till the end
  --check                   only read the rules and grasps, and say what is wrong with them
  --verify                  with --check: also report to standard output what is proved of the rules,
                            and where they and the grasps disagree (docs/verifying.md)
  --depth-limit N           how deep lists may nest; 32 by default, 1000 at most
  --record-limit N          the most characters of one box; 65536 by default, 1000000 at most, and
                            fewer if the heap (--dynamic-space-size) has no room for them
  --number-limit N          the most characters of one number; 40 by default, 1000 at most
  --name-limit N            the most characters of one name; 64 by default, 1000 at most
  --help                    print this, and end
  --version                 print the version, and end

Exit status:
  0    all boxes planned, also those that can't be grasped
  64   the command line is wrong
  65   a box, a rule or a grasp is not valid (its record says why)
  66   a file can't be opened or read
  69   --report, but the pictures can't be loaded, or were not there at the build: cl-who is missing
  70   an internal error, a bug in SUPER-GRIP
  74   output, a page of the report or a model was lost
  130  after SIGINT, 143 after SIGTERM
Where several apply: 70, 74, 130 or 143, 66, 65.

Examples:
  supergrip boxes.lisp > records.lisp
  supergrip --format trace boxes.lisp
  supergrip --input json < boxes.jsonl > records.jsonl
  supergrip --check --rules my-rules.lisp
  parallel --pipe -k --block 1M supergrip --input json < boxes.jsonl > records.jsonl
"
  "What --help prints.")

(define-condition usage-error (error)
  ((text :initarg :text :reader usage-error-text))
  (:report (lambda (condition stream) (write-string (usage-error-text condition) stream)))
  (:documentation "The command line is not valid."))

(defun misused (control &rest arguments)
  (error 'usage-error :text (apply #'format nil control arguments)))

(defparameter +options+
  `(("--input" :input :choice "sexp" "json")
    ("--format" :format :choice "trace" "sexp" "json"
                ,@(mapcar (lambda (writer) (string-downcase (writer-name writer))) *writers*))
    ("--mjcf" :mjcf :file)
    ("--rules" :rules :file)
    ("--grasps" :grasps :file)
    ("--gripper" :gripper :file)
    ("--hand" :hand :file)
    ("--gamma" :gamma :gamma)
    ("--index" :index :choice "paper" "exact")
    ("--all" :all :count 1000)
    ("--refine" :refine)
    ("--depth-limit" :depth-limit :count 1000)
    ("--record-limit" :record-limit :count 1000000)
    ("--number-limit" :number-limit :count 1000)
    ("--name-limit" :name-limit :count 1000)
    ("--report" :report :file)
    ("--check" :check)
    ("--verify" :verify)
    ("--help" :help)
    ("-h" :help)
    ("--version" :version))
  "Each option, its key, and what its value is, if it takes one.")

(defun parse-command-line (arguments)
  "Return a plist of the options in ARGUMENTS, a list of strings, and the list of the files."
  (let ((options '()) (files '()))
    (when (eq arguments :unreadable)
      (misused "the command line, or the name of a file in it, is not text in the locale's encoding"))
    (loop while arguments
          do (let ((argument (pop arguments)))
               (cond ((string= argument "--")
                      (setf files (append (reverse arguments) files) arguments '()))
                     ((or (string= argument "-") (not (eql 0 (search "-" argument))))
                      (push argument files))
                     (t
                      (multiple-value-bind (key value rest) (parse-option argument arguments)
                        (setf (getf options key) value
                              arguments rest))))))
    (values options (reverse files))))

(defun parse-option (argument rest)
  "Return the key and the value of the option ARGUMENT, as --gamma or --gamma=0.5, and what is left
of REST, the arguments after it."
  (let* ((equals (position #\= argument))
         (name (subseq argument 0 equals))
         (entry (assoc name +options+ :test #'string=)))
    (unless entry
      (misused "there is no option ~a~a" name (suggestion name (mapcar #'first +options+))))
    (destructuring-bind (key &optional type &rest bounds) (rest entry)
      (cond ((null type)
             (when equals (misused "~a takes no value" name))
             (values key t rest))
            (equals
             (values key (option-value name type bounds (subseq argument (1+ equals))) rest))
            ((null rest) (misused "~a needs a value" name))
            (t (values key (option-value name type bounds (first rest)) (rest rest)))))))

(defun option-value (name type bounds text)
  "Return the value of the option NAME that TEXT gives, or signal a USAGE-ERROR."
  (ecase type
    (:file (if (string= text "") (misused "~a needs the name of a file" name) text))
    (:choice (if (member text bounds :test #'string=)
                 (intern (if (string= text "sexp") "LISP" (string-upcase text)) :keyword)
                 (misused "~a is ~{~a~#[~; or ~:;, ~]~}, not ~a" name bounds text)))
    (:gamma (let ((number (text-number text)))
              (if (and number (<= 0 number 1))
                  number
                  (misused "~a is a number from 0, forces alone, to 1, velocities alone, not ~a"
                           name text))))
    (:count (let ((number (text-number text)))
              (if (and (integerp number) (<= 1 number (first bounds)))
                  number
                  (misused "~a is a whole number from 1 to ~d, not ~a" name (first bounds)
                           text))))))

(defun text-number (text)
  "Return the number that TEXT is, or NIL."
  (handler-case (let ((data (read-all (string-source text))))
                  (and (realp (first data)) (null (rest data)) (first data)))
    (syntax-error () nil)))
