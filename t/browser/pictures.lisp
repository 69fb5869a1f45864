;;;; pictures.lisp -- sbcl --script t/browser/pictures.lisp DIRECTORY [COUNT] makes pictures of all
;;;; examples, of extreme boxes and of COUNT (200) random boxes, and reports, for check.mjs to see.

(require :asdf)

(defparameter *root* (merge-pathnames "../../" (make-pathname :name nil :type nil
                                                              :defaults *load-truename*)))

(asdf:initialize-source-registry
 `(:source-registry
   (:directory ,*root*)
   ,@(loop for name in '("fiveam" "alexandria" "asdf-flv" "trivial-backtrace" "cl-who")
           collect `(:directory ,(format nil "/usr/share/common-lisp/source/~a/" name)))
   :ignore-inherited-configuration))

(let ((*standard-output* (make-broadcast-stream)))
  ;; cl-who's own system file has a second system whose name ASDF does not like.
  (handler-bind ((asdf/parse-defsystem:bad-system-name #'muffle-warning))
    (asdf:load-system "supergrip/draw-test")))

(in-package :supergrip-test)

(destructuring-bind (directory &optional (count "200")) (rest sb-ext:*posix-argv*)
  (let ((folder (uiop:ensure-directory-pathname (merge-pathnames directory (uiop:getcwd))))
        (number 0))
    (flet ((draw (name box)
             (let ((plan (supergrip:plan box)))
               (supergrip-draw:draw-plan plan (in-folder folder "~a-plan.svg" name))
               (when (plusp (length (supergrip:plan-possible plan)))
                 (supergrip-draw:draw-session plan (in-folder folder "~a-session.svg" name))
                 (supergrip-draw:draw-quality plan (in-folder folder "~a-quality.svg" name))
                 (supergrip-draw:draw-section plan (in-folder folder "~a-section.svg" name)))
               plan)))
      (loop for (name . box) in (append (example-boxes) *extreme-boxes*)
            do (supergrip-draw:report (draw name box) (in-folder folder "~a.html" name)))
      (supergrip-draw:report-index (loop for (nil . box) in (example-boxes)
                                         collect (supergrip:plan box))
                                   folder :pages nil)
      (for-random-boxes (box (parse-integer count) 20261122)
        (draw (format nil "random-~3,'0d" (incf number)) box)))
    (supergrip-draw:draw-grasps (in-folder folder "grasps.svg"))
    (supergrip-draw:draw-offset (in-folder folder "offset.svg"))
    (supergrip-draw:draw-system (in-folder folder "system.svg"))))
