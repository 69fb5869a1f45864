;;;; registry.lisp -- tells ASDF where the tests and what they need are, each directory by name: a
;;;; search could find another ASDF.

(require :asdf)

(asdf:initialize-source-registry
 `(:source-registry
   (:directory ,(merge-pathnames "../" (make-pathname :name nil :type nil
                                                      :defaults *load-truename*)))
   ,@(loop for name in '("fiveam" "alexandria" "asdf-flv" "trivial-backtrace" "cl-who")
           collect `(:directory ,(format nil "/usr/share/common-lisp/source/~a/" name)))
   :inherit-configuration))
