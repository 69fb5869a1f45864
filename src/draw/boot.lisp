;;;; boot.lisp -- makes a script or a session ready to draw: (load "../src/draw/boot.lisp") loads
;;;; SUPER-GRIP and its pictures.
;;;;
;;;; The pictures need cl-who, Debian's package of this name, wherever ASDF finds it.

(load (merge-pathnames "../boot.lisp" *load-truename*))

(supergrip-boot:load-quietly "supergrip/draw" :needs '("cl-who"))
