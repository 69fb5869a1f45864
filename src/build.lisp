;;;; build.lisp -- sbcl --script src/build.lisp [FILE] makes the executable supergrip, or FILE.

;;; The pictures, which --report needs, come along if cl-who is there.
(load (merge-pathnames (if (probe-file "/usr/share/common-lisp/source/cl-who/")
                           "draw/boot.lisp"
                           "boot.lisp")
                       *load-truename*))

(supergrip::build)
