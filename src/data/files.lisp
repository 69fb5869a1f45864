;;;; files.lisp -- names and texts of files, with the system's reason where something can't be done.

(in-package :supergrip-data)

;;; File names

(defun native-path (file &key directory)
  "Return the path of FILE: a path, or its name as the system has it, a string in which no character
but / means anything.  If DIRECTORY is true, it is a directory, with or without a / at its end."
  (cond ((stringp file)
         (sb-ext:parse-native-namestring file nil *default-pathname-defaults*
                                         :as-directory directory))
        ((and (pathnamep file) (not (wild-pathname-p file)))
         (if directory (uiop:ensure-directory-pathname file) file))
        (t (refuse-argument "~a is not the name of a file: that is a string, or a path without ~
                             wild cards"
                            (form-text file)))))

;;; Files, with the system's reason where something can't be done

(define-condition system-failure (error)
  ((what :initarg :what :reader system-failure-what)
   (errno :initarg :errno :reader system-failure-errno))
  (:report (lambda (condition stream)
             (format stream "~a: ~a" (system-failure-what condition)
                     (sb-int:strerror (system-failure-errno condition)))))
  (:documentation "The system could not do something to a file or a pipe."))

(define-condition read-failure (system-failure) ()
  (:documentation "Something could not be opened or read."))

(define-condition write-failure (system-failure) ()
  (:documentation "Something could not be written."))

(defun native-name (file)
  "Return the name of FILE, a path or a string, as the system has it."
  (if (stringp file) file (sb-ext:native-namestring file)))

(defconstant +is-directory+ 21 "The error number EISDIR.")
(defconstant +input-output+ 5 "The error number EIO.")

(defun open-descriptor (file)
  "Open FILE, a string, for reading; return its descriptor."
  (multiple-value-bind (descriptor errno)
      (if (directory-p file)
          (values nil +is-directory+)
          (sb-unix:unix-open file sb-unix:o_rdonly 0))
    (or descriptor (error 'read-failure :what "can't be opened" :errno errno))))

(defun directory-p (name)
  "True if NAME, a string, is that of a directory."
  (let ((mode (nth-value 3 (sb-unix:unix-stat name))))
    (and mode (= (logand mode #o170000) #o040000))))

(defun decoded (octets end)
  "Return the text of OCTETS, UTF-8, up to END.  What is not UTF-8 becomes U+FFFD."
  (declare (type (simple-array (unsigned-byte 8) (*)) octets) (fixnum end) (optimize speed))
  (if (loop for place below end always (< (aref octets place) 128))
      ;; Most files are ASCII.  Decoding would take a tenth of the time in which they are read.
      (let ((text (make-string end)))
        (dotimes (place end text)
          (setf (schar text place) (code-char (aref octets place)))))
      (coerce (sb-ext:octets-to-string octets :end end
                                              :external-format '(:utf-8 :replacement #\ufffd))
              '(simple-array character (*)))))

(defun file-text (file)
  "Return the text of FILE, a string, or its beginning if it is far too long for the heap.  Octets
that are not UTF-8 become U+FFFD.  Signals a READ-FAILURE."
  (let ((octets (make-array 65536 :element-type '(unsigned-byte 8)))
        (end 0))
    (with-open-stream (in (sb-sys:make-fd-stream (open-descriptor file) :buffering :full
                                                 :element-type '(unsigned-byte 8)))
      (handler-case
          (loop for new = (read-sequence octets in :start end)
                until (= new end)
                do (setf end new)
                   (when (> end (room-for end))
                     (return))
                   (when (= end (length octets))
                     (setf octets (replace (make-array (* 2 end) :element-type '(unsigned-byte 8))
                                           octets))))
        (stream-error () (error 'read-failure :what "can't be read" :errno +input-output+))))
    (decoded octets end)))
