;;;; package.lisp -- the benchmark: what it measures, and beside what.

(defpackage :supergrip-bench
  (:use :cl)
  (:export #:run-benchmark)
  (:documentation "The benchmark of SUPER-GRIP."))
