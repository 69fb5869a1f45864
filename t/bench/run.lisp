;;;; run.lisp -- sbcl --script t/bench/run.lisp [QUICK] measures SUPER-GRIP and its neighbours.
;;;;
;;;; It prints the tables of docs/speed.md.  QUICK, any word, measures short and is not accurate.

(require :asdf)

(asdf:initialize-source-registry
 `(:source-registry
   (:directory ,(merge-pathnames "../../"
                                 (make-pathname :name nil :type nil :defaults *load-truename*)))
   :ignore-inherited-configuration))

(let ((*standard-output* (make-broadcast-stream)))
  (asdf:load-system "supergrip/bench"))

;; Whatever the locale, the tables are UTF-8.
(let ((*standard-output* (sb-sys:make-fd-stream 1 :output t :external-format :utf-8
                                                  :buffering :full)))
  (uiop:symbol-call :supergrip-bench :run-benchmark :quick (second sb-ext:*posix-argv*))
  (finish-output))
