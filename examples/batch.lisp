;;;; Many boxes in, one record a box out: sbcl --script examples/batch.lisp [OPTION]... [FILE]...
;;;;
;;;; See --help, and docs/batch.md.  The executable supergrip does the same and starts faster.

;;; A signal ends the script from here on; SBCL itself would end with status 0 or 1.
#+sbcl (sb-sys:enable-interrupt sb-unix:sigterm :default)
#+sbcl (sb-sys:enable-interrupt sb-unix:sigint :default)

(load (merge-pathnames "../src/boot.lisp" *load-truename*))
(supergrip-boot:load-quietly "supergrip/batch")

(supergrip::main-and-end)
