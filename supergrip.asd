;;;; supergrip.asd -- the systems of SUPER-GRIP.

#-sbcl (error "SUPER-GRIP needs SBCL; this is ~a." (lisp-implementation-type))

(defsystem "supergrip"
  :description "An expert system that chooses the best grasp of a three-fingered gripper on a box."
  :version "0.2.0"
  :author "The SUPER-GRIP developers"
  :license "MIT"
  :depends-on ("supergrip/chainer" "supergrip/statics")
  :pathname "src/"
  :serial t
  :components ((:file "package")
               (:module "hand"
                :serial t
                :components ((:file "numbers-in-print")
                             (:file "matchings")
                             (:file "rotations")
                             (:file "units")
                             (:file "box")
                             (:file "box-keys")
                             (:file "pose")
                             (:file "read-box")
                             (:file "operators")
                             (:file "read-gripper")
                             (:file "read-forms")
                             (:file "computations")
                             (:file "compile-forms")
                             (:file "grasp-entries")
                             (:file "from-contacts")
                             (:file "same-forms")
                             (:file "read-grasps")
                             (:file "check-contacts")
                             (:file "preliminary-assertions")
                             (:file "box-facts")
                             (:file "box-for-gripper")))
               (:module "plan"
                :serial t
                :components ((:file "quality")
                             (:file "try-steps")
                             (:file "try")
                             (:file "try-and-keep")
                             (:file "knowledge")
                             (:file "plan")
                             (:file "candidate")
                             (:file "hand-frame")
                             (:file "exact")))
               (:module "refine"
                :serial t
                :components ((:file "places")
                             (:file "cuts")
                             (:file "climb")
                             (:file "scan")
                             (:file "bound")
                             (:file "refine")))
               (:module "why"
                :serial t
                :components ((:file "answers")
                             (:file "motions")
                             (:file "false-conditions")
                             (:file "failures")
                             (:file "derivation")
                             (:file "why-not-rule")
                             (:file "how")
                             (:file "why-not-grasp")
                             (:file "questions")
                             (:file "curves")
                             (:file "candidate-curves")
                             (:file "reason")
                             (:file "remedy")
                             (:file "least-change")
                             (:file "demand")
                             (:file "choice")
                             (:file "requires")
                             (:file "refined-fingers")
                             (:file "describe")))
               (:module "verify"
                :serial t
                :components ((:file "findings")
                             (:file "views")
                             (:file "quantities")
                             (:file "situations")
                             (:file "rule-answers")
                             (:file "proof")
                             (:file "search")
                             (:file "verify")
                             (:file "changes")))
               (:module "session"
                :serial t
                :components ((:file "transcript")
                             (:file "trace")
                             (:file "repl")
                             (:file "by-hand")
                             (:file "typed-names")
                             (:file "words")
                             (:file "edit")
                             (:file "compare")
                             (:file "former-names")))
               (:static-file "boot.lisp"))
  :in-order-to ((test-op (test-op "supergrip/test"))))

(defsystem "supergrip/batch"
  :description "Many boxes in, one record a box out, in one process; and the command line."
  :version "0.2.0"
  :license "MIT"
  :depends-on ("supergrip")
  :pathname "src/"
  :serial t
  :components ((:module "writers"
                :serial t
                :components ((:file "text")
                             (:file "writers")
                             (:file "isaac")
                             (:file "moveit")
                             (:file "graspgen")
                             (:file "mjcf")))
               (:module "batch"
                :serial t
                :components ((:file "system")
                             (:file "json")
                             (:file "json-boxes")
                             (:file "input-buffer")
                             (:file "output-buffer")
                             (:file "carried-data")
                             (:file "record")
                             (:file "error-recovery")
                             (:file "batch")
                             (:file "options")
                             (:file "main")))
               (:static-file "build.lisp"))
  :in-order-to ((test-op (test-op "supergrip/test"))))

(defsystem "supergrip/draw"
  :description "Pictures of boxes, grasps and plans, as SVG, and reports, as HTML."
  :version "0.2.0"
  :license "MIT"
  :depends-on ("supergrip" "cl-who")
  :pathname "src/draw/"
  :serial t
  :components ((:file "package")
               (:file "numbers")
               (:file "geometry")
               (:static-file "picture.css")
               (:file "occupied-places")
               (:file "svg")
               (:file "labels")
               (:file "subject")
               (:file "scene")
               (:file "pictures")
               (:file "plan-picture")
               (:file "grasps-picture")
               (:file "offset-picture")
               (:file "gripper-picture")
               (:file "session-picture")
               (:file "strength")
               (:file "quality-picture")
               (:file "section-picture")
               (:file "system-picture")
               (:static-file "page.css")
               (:file "report")
               (:static-file "boot.lisp"))
  :in-order-to ((test-op (test-op "supergrip/draw-test"))))

(defsystem "supergrip/chainer"
  :description "The upper level alone: the data reader, and an s-expression forward chainer."
  :version "0.2.0"
  :license "MIT"
  :pathname "src/"
  :serial t
  :components ((:module "data"
                :serial t
                :components ((:file "package")
                             (:file "sbcl")
                             (:file "printer-settings")
                             (:file "error-reports")
                             (:file "suggest")
                             (:file "names")
                             (:file "files")
                             (:file "numbers")
                             (:file "reader")))
               (:module "chainer"
                :serial t
                :components ((:file "package")
                             (:file "faces")
                             (:file "facts")
                             (:file "define-action")
                             (:file "read-rules")
                             (:file "read-inputs")
                             (:file "symmetry")
                             (:file "match")
                             (:file "rulebase")
                             (:file "run")
                             (:file "remember-and-cant")
                             (:file "observe")
                             (:file "check-rules"))))
  :in-order-to ((test-op (test-op "supergrip/chainer-test"))))

(defsystem "supergrip/statics"
  :description "What contacts can really exert: exact statics, with certificates."
  :version "0.2.0"
  :license "MIT"
  :depends-on ("supergrip/chainer")
  :pathname "src/"
  :serial t
  :components ((:module "statics"
                :serial t
                :components ((:file "package")
                             (:file "contacts")
                             (:file "round-frame")
                             (:file "nearest-wrench")
                             (:file "proof")
                             (:file "radius")
                             (:file "sure-radius")
                             (:file "pure-wrench")
                             (:file "entries")
                             (:file "mobility")
                             (:file "exact-statics"))))
  :in-order-to ((test-op (test-op "supergrip/test"))))

(defsystem "supergrip/chainer-test"
  :description "The tests of the upper level, which need nothing of the lower."
  :license "MIT"
  :depends-on ("supergrip/chainer" "fiveam")
  :pathname "t/"
  :serial t
  :components ((:file "package")
               (:file "reader")
               (:file "chainer"))
  :perform (test-op (operation system) (symbol-call :supergrip-test :run-tests)))

(defsystem "supergrip/test"
  :description "All tests."
  :license "MIT"
  :depends-on ("supergrip/test-tools")
  :pathname "t/"
  :serial t
  :components ((:file "paper")
               (:file "statics")
               (:file "rules")
               (:file "properties")
               (:file "plan")
               (:file "errors")
               (:file "rotations")
               (:file "pose")
               (:file "preliminary-assertions")
               (:file "box-facts")
               (:file "try-steps")
               (:file "engines")
               (:file "forms")
               (:file "exact-statics")
               (:file "entries")
               (:file "mobility")
               (:file "computations")
               (:file "from-contacts")
               (:file "check-contacts")
               (:file "exact")
               (:file "hand-frame")
               (:file "refined-places")
               (:file "refine")
               (:file "read-gripper")
               (:file "grasp-entries")
               (:file "curves")
               (:file "same-forms")
               (:file "spoiled")
               (:file "explain")
               (:file "reason")
               (:file "remedy")
               (:file "requires")
               (:file "motions")
               (:file "rules-and-refining")
               (:file "printer-settings")
               (:file "false-conditions")
               (:file "repl")
               (:file "by-hand")
               (:file "words")
               (:file "edit")
               (:file "verify")
               (:file "json")
               (:file "box-keys")
               (:file "units")
               (:file "record")
               (:file "carried-data")
               (:file "schemas")
               (:file "scripts")
               (:file "fuzzer")
               (:file "batch")
               (:file "main")
               (:file "formats")
               (:file "hands")
               (:file "client")
               (:file "documents")
               (:static-file "formats.py")
               (:static-file "simulate.lisp")
               (:static-file "simulate.py")
               (:static-file "fuzz.lisp")
               (:static-file "run.lisp")
               (:static-file "alone"))
  :perform (test-op (operation system) (symbol-call :supergrip-test :run-tests)))

(defsystem "supergrip/oracle"
  :description "The reference engine, which shares nothing with SUPER-GRIP."
  :license "MIT"
  :pathname "t/"
  :components ((:file "oracle")))

(defsystem "supergrip/bench"
  :description "The benchmark: sbcl --script t/bench/run.lisp."
  :license "MIT"
  :depends-on ("supergrip/batch" "supergrip/oracle")
  :pathname "t/"
  :serial t
  :components ((:module "bench"
                :serial t
                :components ((:file "package")
                             (:file "clock")
                             (:file "floor")
                             (:file "bits")
                             (:file "sessions")
                             (:file "neighbours")
                             (:file "growth")
                             (:file "contacts")
                             (:file "processes")
                             (:file "report")
                             (:static-file "pencil.clp")
                             (:static-file "run.lisp")))))

(defsystem "supergrip/test-tools"
  :description "What the tests of several files share."
  :license "MIT"
  :depends-on ("supergrip/batch" "supergrip/chainer-test" "supergrip/oracle")
  :pathname "t/"
  :components ((:file "tools")))

(defsystem "supergrip/draw-test"
  :description "The tests of the pictures and reports; python3 parses them."
  :license "MIT"
  :depends-on ("supergrip/draw" "supergrip/test-tools")
  :pathname "t/"
  :serial t
  :components ((:file "draw")
               (:static-file "draw-check.py"))
  :perform (test-op (operation system) (symbol-call :supergrip-test :run-tests)))
