;;;; Many boxes in, one record a box out: sbcl --script examples/batch.lisp [OPTION]... [FILE]...
;;;;
;;;; See --help, and README.md, Batch.  The executable supergrip does the same and starts faster.

(load (merge-pathnames "../src/boot.lisp" *load-truename*))

(supergrip::main-and-end)
