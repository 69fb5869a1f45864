;;;; rooms.lisp -- sbcl --script t/rooms.lisp shows which room of src/ uses which, and checks it.
;;;;
;;;; The rooms are the directories of src/, in the order in which the systems load them.  A room may
;;;; use those above it only, and inside a room no file may use, however indirectly, one that uses
;;;; it.  Who uses what is SBCL's own cross reference.

(require :sb-introspect)
(load (merge-pathnames "registry.lisp" *load-truename*))

(defpackage :supergrip-rooms (:use :cl))
(in-package :supergrip-rooms)

(defparameter *systems*
  '("supergrip/chainer" "supergrip/statics" "supergrip" "supergrip/batch" "supergrip/draw"))

(let ((*standard-output* (make-broadcast-stream)))
  (handler-bind ((asdf/parse-defsystem:bad-system-name #'muffle-warning))
    (dolist (system *systems*)
      (when (asdf:find-system system nil)
        (asdf:load-system system)))))

(defparameter *source* (truename (asdf:system-relative-pathname "supergrip" "src/")))

(defparameter *files* (make-hash-table :test #'equal) "What FILE-OF has answered.")

(defun file-of (pathname)
  "Return the name of the file PATHNAME below src/, as \"hand/box.lisp\", or NIL if it is
elsewhere."
  (flet ((look ()
           (let* ((pathname (and pathname (probe-file pathname)))
                  (name (and pathname (enough-namestring pathname *source*))))
             (and name (string/= name (namestring pathname)) name))))
    (multiple-value-bind (file found) (gethash pathname *files*)
      (if found file (setf (gethash pathname *files*) (look))))))

(defun files ()
  "Return the files of all systems in the order in which they are loaded."
  (let ((files '()))
    (labels ((walk (component)
               (if (typep component 'asdf:parent-component)
                   (mapc #'walk (asdf:component-children component))
                   (when (typep component 'asdf:cl-source-file)
                     (pushnew (file-of (asdf:component-pathname component)) files
                              :test #'equal)))))
      (dolist (system *systems*)
        (let ((system (asdf:find-system system nil)))
          (when system (walk system)))))
    (remove nil (reverse files))))

(defun room-of (file)
  "Return the room of FILE; files that lie flat in src/ have one together, before all others."
  (let ((slash (position #\/ file)))
    (if slash (subseq file 0 slash) "(src)")))

;;; Who uses what

(defun file-of-function (function)
  "Return the file that FUNCTION, compiled, comes from, or NIL if it is elsewhere."
  (let ((source (ignore-errors (sb-introspect:find-definition-source function))))
    (and source (file-of (sb-introspect:definition-source-pathname source)))))

(defun ours-p (symbol)
  (let ((package (symbol-package symbol)))
    (and package (eql 0 (search "SUPERGRIP" (package-name package))))))

(defun our-symbols ()
  (let ((symbols '()))
    (dolist (package (list-all-packages) symbols)
      (when (eql 0 (search "SUPERGRIP" (package-name package)))
        (do-symbols (symbol package)
          (when (and (ours-p symbol) (eq (symbol-package symbol) package))
            (pushnew symbol symbols)))))))

(defun home (symbol kinds)
  "Return the file that defines SYMBOL as one of KINDS, or NIL."
  (dolist (kind kinds)
    (dolist (source (ignore-errors
                     (sb-introspect:find-definition-sources-by-name symbol kind)))
      (let ((file (file-of (sb-introspect:definition-source-pathname source))))
        (when file (return-from home file))))))

(defparameter *kinds*
  '((:calls :function :generic-function :structure-accessor)
    (:macroexpands :macro :symbol-macro)
    (:references :variable :constant)
    (:binds :variable)
    (:sets :variable))
  "Each cross reference of SBCL, and what kinds of definition it is about.")

(defun map-functions (visit)
  "Call VISIT with each compiled function of this Lisp."
  (sb-vm:map-allocated-objects
   (lambda (object type size)
     (declare (ignore size))
     (when (= type sb-vm:code-header-widetag)
       (dotimes (number (sb-kernel:code-n-entries object))
         (funcall visit (sb-kernel:%code-entry-point object number)))))
   :all))

(defun map-uses (visit)
  "Call VISIT with each compiled function, a kind of reference and the name that it refers to.
SB-INTROSPECT:WHO-CALLS and its like would look through all functions for each name."
  (map-functions
   (lambda (function)
     (let ((references (sb-kernel:%simple-fun-xrefs function)))
       (when references
         (sb-c:map-packed-xref-data (lambda (kind name number)
                                      (declare (ignore number))
                                      (funcall visit function kind name))
                                    references))))))

(defun edges ()
  "Return a list of (USER USED SYMBOL), two files and why, each pair of files once for each symbol."
  (let ((homes (make-hash-table :test #'equal))
        (edges (make-hash-table :test #'equal))
        (ours (make-hash-table)))
    (dolist (symbol (our-symbols)) (setf (gethash symbol ours) t))
    (flet ((home-of (kind symbol)
             (let ((key (list kind symbol)))
               (if (nth-value 1 (gethash key homes))
                   (gethash key homes)
                   (setf (gethash key homes) (home symbol (rest (assoc kind *kinds*))))))))
      (map-uses
       (lambda (function kind symbol)
         (when (and (symbolp symbol) (gethash symbol ours))
           (let ((used (home-of kind symbol)) (user (file-of-function function)))
             (when (and used user (string/= user used))
               (setf (gethash (list user used symbol) edges) t)))))))
    (loop for edge being the hash-keys of edges collect edge)))

;;; What is wrong

(defun uphill (edges order)
  "Return those of EDGES that go from a room to one that comes later in ORDER, a list of rooms."
  (remove-if (lambda (edge)
               (>= (position (room-of (first edge)) order :test #'string=)
                   (position (room-of (second edge)) order :test #'string=)))
             edges))

(defun reachable (file edges)
  "Return the files that FILE uses by EDGES, however indirectly."
  (let ((seen '()) (left (list file)))
    (loop while left
          do (let ((next (pop left)))
               (loop for (user used) in edges
                     when (and (string= user next) (not (member used seen :test #'string=)))
                       do (push used seen)
                          (push used left))))
    seen))

(defun cycles (files edges)
  "Return the files that are part of a cycle inside their room."
  (let ((inside (remove-if-not (lambda (edge)
                                 (string= (room-of (first edge)) (room-of (second edge))))
                               edges)))
    (remove-if-not (lambda (file) (member file (reachable file inside) :test #'string=))
                   files)))

;;; In print

(defun print-table (rooms edges)
  "Print how many files of each room, a row, use how many names of each room, a column."
  (format t "~10a~{~9@a~}~%" "uses" rooms)
  (dolist (user rooms)
    (format t "~10a~{~9@a~}~%" user
            (loop for used in rooms
                  for count = (count-if (lambda (edge)
                                          (and (string= user (room-of (first edge)))
                                               (string= used (room-of (second edge)))))
                                        edges)
                  collect (if (zerop count) "." count)))))

(defun run ()
  "Print the table and what is wrong; return true if nothing is."
  (let* ((files (files))
         (rooms (remove-duplicates (mapcar #'room-of files) :test #'string= :from-end t))
         (edges (remove-if-not (lambda (edge) (and (member (first edge) files :test #'string=)
                                                   (member (second edge) files :test #'string=)))
                               (edges)))
         (uphill (uphill edges rooms))
         (cycles (cycles files edges)))
    (format t "~d files, ~d edges between files~%~%" (length files)
            (length (remove-duplicates edges :test (lambda (a b) (equal (subseq a 0 2)
                                                                        (subseq b 0 2))))))
    (print-table rooms edges)
    (terpri)
    (loop for (user used symbol) in (sort (copy-list uphill) #'string< :key #'first)
          do (format t "up: ~a uses ~a of ~a~%" user symbol used))
    (dolist (file cycles)
      (format t "cycle: ~a~%" file))
    (format t "~d up, ~d in cycles~%" (length uphill) (length cycles))
    (and edges (null uphill) (null cycles))))

(sb-ext:exit :code (if (run) 0 1) :abort nil)
