;;;; build.lisp -- sbcl --script src/build.lisp [FILE] makes the executable supergrip, or FILE.

(load (merge-pathnames "boot.lisp" *load-truename*))

(let ((file (or (first (supergrip::command-arguments))
                (asdf:system-relative-pathname "supergrip" "supergrip"))))
  (supergrip::keep-shipped-files)
  (supergrip::save-program (ensure-directories-exist file) #'supergrip::main-and-end))
