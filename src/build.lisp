;;;; build.lisp -- sbcl --script src/build.lisp [FILE] makes the executable supergrip, or FILE.

(load (merge-pathnames "boot.lisp" *load-truename*))
(supergrip-boot:load-quietly "supergrip/batch")

;;; The pictures, which --report needs, come along if cl-who is there.
(handler-case (load (merge-pathnames "draw/boot.lisp" *load-truename*))
  (supergrip-boot:missing-library () nil))

(in-package :supergrip)
(build)
