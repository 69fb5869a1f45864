;;;; boot.lisp -- makes a script ready to draw: (load "../src/draw/boot.lisp") loads SUPER-GRIP and
;;;; its pictures quietly.
;;;;
;;;; The pictures need cl-who, Debian's package of this name.

(load (merge-pathnames "../boot.lisp" *load-truename*))

(let ((cl-who (probe-file "/usr/share/common-lisp/source/cl-who/")))
  (unless cl-who
    (format *error-output* "The pictures need cl-who: apt-get install cl-who~%")
    (finish-output *error-output*)
    (sb-ext:exit :code 69 :abort t))
  (supergrip-boot:load-quietly "supergrip/draw" cl-who))
