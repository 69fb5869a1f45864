;;;; options.lisp -- the options of the command line, one row each, and what --help says of them.

(in-package :supergrip)

(defparameter +version+ (asdf:component-version (asdf:find-system "supergrip"))
  "The version of SUPER-GRIP, a string.")

(defparameter +help+
  "usage: supergrip [OPTION]... [FILE]...

Read boxes from each FILE, and write one record for each box to standard output, in the same order:
the best grasp, or why there is none.  Without FILE, or where FILE is -, read standard input.

  --input sexp|json         the notation of boxes; by default the input's beginning decides
  --format trace|sexp|json  the notation of records: the paper's lines, one s-expression a line, or
                            one JSON object a line; by default the notation of the boxes
  --format isaac|moveit|graspgen
                            write grasps for another program in place of records
                            (docs/formats.md): all possible grasps of each box, or the N best with
                            --all N
  --mjcf DIR                also write the best grasp of each box into DIR, as a model for MuJoCo
  --rules FILE              rules to use instead of those that are built in
  --grasps FILE             grasps and gripper to use instead of those that are built in
  --gripper FILE            gripper to use instead of the one in the file of grasps
  --hand DIR                take gripper.lisp, rules.lisp and grasps.lisp from the folder DIR; if it
                            has no rules.lisp or grasps.lisp, the one that is built in is used
  --gamma X                 the share of velocities in the quality, from 0 (forces alone) to 1
                            (velocities alone); 0.5 by default
  --margin X                multiply weights, and needs in N or lbf, by X
  --index paper|exact       rate grasps by the paper's index, or by what their contacts can really
                            do, with proof; exact takes a thousand times as long
  --all N                   also write the N best possible grasps of each box, the best first, each
                            with the same details as the best; N is at most 1000
  --refine                  also move the fingers of the three best grasps to better places; write
                            the new places, the gain, and a bound of what any places could gain;
                            takes some tenths of a second a box
  --report DIR              also write a page for each box into DIR, and an index with thumbnails;
                            needs cl-who (docs/pictures.md), and keeps all plans in memory
  --check                   only read the rules and grasps, and say what is wrong with them
  --verify                  with --check: also report what is proved of the rules, and where rules
                            and grasps disagree, to standard output (docs/verifying.md)
  --depth-limit N           how deep lists may nest; 32 by default, 1000 at most
  --record-limit N          the most characters of one box; 65536 by default, 1000000 at most, and
                            fewer if the heap (--dynamic-space-size) has no room for them
  --number-limit N          the most characters of one number; 40 by default, 1000 at most
  --name-limit N            the most characters of one name; 64 by default, 1000 at most
  --help                    print this, and end
  --version                 print the version, and end

Exit status:
  0    every box was planned; some may have no grasp
  64   the command line is wrong
  65   a box, a rule or a grasp is not valid (its record says why)
  66   a file can't be opened or read
  69   --report can't draw: cl-who is missing, or was missing when the executable was built
  70   an internal error, a bug in SUPER-GRIP
  74   output, a page of the report or a model could not be written
  130  after SIGINT, 143 after SIGTERM
If several apply, the first of 70, 74, 130 or 143, 66, 65 is returned.

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
    ("--margin" :margin :factor)
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
      (misused "the command line, or the name of a file in it, is not text in the ~
                locale's encoding"))
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
                 (misused "~a must be ~{~a~#[~; or ~:;, ~]~}, not ~a" name bounds text)))
    (:gamma (let ((number (text-number text)))
              (if (and number (<= 0 number 1))
                  number
                  (misused "~a must be a number from 0 (forces alone) to 1 (velocities alone), ~
                            not ~a" name text))))
    (:factor (let ((number (text-number text)))
               (if (and number (plusp number))
                   number
                   (misused "~a must be a number above 0, not ~a" name text))))
    (:count (let ((number (text-number text)))
              (if (and (integerp number) (<= 1 number (first bounds)))
                  number
                  (misused "~a must be a whole number from 1 to ~d, not ~a" name (first bounds)
                           text))))))

(defun text-number (text)
  "Return the number that TEXT is, or NIL."
  (handler-case (let ((data (read-all (string-source text))))
                  (and (realp (first data)) (null (rest data)) (first data)))
    (syntax-error () nil)))
