;;;; input-buffer.lisp -- the characters of a descriptor, as soon as they are there, for the data
;;;; reader.
;;;;
;;;; Octets are decoded as UTF-8; what is not UTF-8 becomes U+FFFD.  The reader gets them in pieces.
;;;; A piece ends before each line that starts a record.  A record that is still open there has lost
;;;; a parenthesis or a quote; the reader is then told that the input ends, so that the mistake
;;;; affects no other record.

(in-package :supergrip)

(defstruct (input (:constructor make-input (descriptor before-waiting)))
  "A descriptor being read.  BEFORE-WAITING is called before each wait for octets.  The characters
from PLACE to END of CHARACTERS are not given to the reader yet.  NOTATION is :LISP or :JSON, NIL
until it is known.  OPEN is true while a record is being read, CUT once a line that starts another
one has ended it."
  (descriptor 0 :type fixnum)
  (before-waiting nil :type function)
  (octets (make-array 65536 :element-type '(unsigned-byte 8)) :type octets)
  (octets-end 0 :type fixnum)
  (characters (make-string (* 2 65536)) :type (simple-array character (*)))
  (place 0 :type fixnum)
  (end 0 :type fixnum)
  (at-end nil)
  (line-start t)
  (notation nil)
  (open nil)
  (cut nil))

(defun input-source (input name)
  "Return a source that reads INPUT.  NAME is used in reports."
  (make-source (input-characters input) 0 :name name :refill (lambda () (next-piece input))))

;;; Octets to characters

(declaim (inline sequence-length))
(defun sequence-length (octet)
  "Return how many octets the UTF-8 sequence that begins with OCTET has; 0 if none begins so."
  (declare (type (unsigned-byte 8) octet))
  (cond ((< octet #x80) 1)
        ((< octet #xc2) 0)
        ((< octet #xe0) 2)
        ((< octet #xf0) 3)
        ((< octet #xf5) 4)
        (t 0)))

(defun decode-sequence (octets start end length)
  "Return the code of the sequence of LENGTH octets at START, or NIL, and how many octets of it are
valid; as many as END allows are looked at."
  (declare (type octets octets) (fixnum start end) (type (integer 2 4) length))
  (let ((code (ldb (byte (- 7 length) 0) (aref octets start)))
        (least (ecase length (2 #x80) (3 #x800) (4 #x10000))))
    (declare (type (unsigned-byte 32) code))
    (loop for count of-type fixnum from 1 below length
          for place of-type fixnum = (+ start count)
          do (unless (and (< place end) (= (logand #xc0 (aref octets place)) #x80))
               (return-from decode-sequence (values nil count)))
             (setf code (logior (ash code 6) (logand #x3f (aref octets place))))
             ;; The first two octets tell what is too long, a surrogate or out of range.
             (when (= count 1)
               (let ((low (ash code (* 6 (- length 2)))))
                 (when (or (< (logior low (1- (ash 1 (* 6 (- length 2))))) least)
                           (<= #xd800 low #xdfff)
                           (> low #x10ffff))
                   (return-from decode-sequence (values nil 1))))))
    (values code length)))

(defun decode (input)
  "Turn octets of INPUT into characters, as many as there is room for; keep the beginning of a
sequence whose rest may still come."
  (declare (type input input))
  (let* ((octets (input-octets input))
         (octets-end (input-octets-end input))
         (characters (input-characters input))
         (end (input-end input))
         (start 0))
    (declare (type octets octets) (type (simple-array character (*)) characters)
             (fixnum octets-end end start))
    (loop while (< start octets-end)
          do (let* ((octet (aref octets start))
                    (length (sequence-length octet)))
               (cond ((= length 1)
                      (setf (schar characters end) (code-char octet))
                      (incf start))
                     ((= length 0)
                      (setf (schar characters end) (code-char #xfffd))
                      (incf start))
                     (t
                      (multiple-value-bind (code count)
                          (decode-sequence octets start octets-end length)
                        (declare (fixnum count))
                        (when (and (null code) (= (+ start count) octets-end)
                                   (not (input-at-end input)))
                          (return))
                        (setf (schar characters end) (code-char (or code #xfffd)))
                        (incf start count))))
               (incf end)))
    (replace octets octets :start2 start :end2 octets-end)
    (setf (input-octets-end input) (- octets-end start)
          (input-end input) end)))

(defun more-characters (input)
  "Move the characters that the reader has not got to the front, and get some more; false at the
end."
  (let ((characters (input-characters input))
        (before (- (input-end input) (input-place input))))
    (replace characters characters :start2 (input-place input) :end2 (input-end input))
    (setf (input-place input) 0 (input-end input) before)
    (loop until (or (input-at-end input) (> (input-end input) before))
          do (funcall (input-before-waiting input))
             (let ((end (read-octets (input-descriptor input) (input-octets input)
                                     (input-octets-end input))))
               (setf (input-at-end input) (= end (input-octets-end input))
                     (input-octets-end input) end))
             (decode input))
    (> (input-end input) before)))

;;; The notation

(defun blank-before-box-p (character)
  "True if CHARACTER tells nothing of the notation: it is blank, or stands in UTF-16."
  (find character (load-time-value (coerce (list #\Space #\Newline #\Return #\Tab #\Page +mark+
                                                 +separator+ (code-char 0) (code-char #xfffd))
                                           'simple-string))))

(defun line-notation (characters place end)
  "Return :JSON or :LISP if what begins at PLACE of CHARACTERS is a box in it, or NIL."
  (flet ((next (place)
           (position-if-not #'blank-before-box-p characters :start (min end (1+ place)) :end end)))
    (let ((second (next place)))
      (when second
        (case (schar characters place)
          (#\{ (and (find (schar characters second) "\"}") :json))
          (#\[ (and (find (schar characters second) "{]") :json))
          (#\' (and (char= (schar characters second) #\() :lisp))
          (#\( (and (or (char= (schar characters second) #\()
                        (eql (string-lessp "SETQ" characters :start2 second :end2 end) 4))
                    :lisp)))))))

(defun first-notation (characters start end)
  "Return the notation of the first line of CHARACTERS between START and END that begins a box, so
that a comment or a line of a log does not matter; or NIL."
  (loop for place = (position-if-not #'blank-before-box-p characters :start start :end end)
        while place
        thereis (line-notation characters place end)
        do (setf start (or (position #\Newline characters :start place :end end) end))))

(defun told-notation (input source)
  "Return the notation of what SOURCE, which reads INPUT, holds: :LISP or :JSON."
  (let ((first (skip-to-json source)))
    ;; What SOURCE did not take yet is looked at first.
    (when first
      (setf (input-place input) (source-position source)
            (source-end source) (source-position source)))
    (loop
      (let ((told (first-notation (input-characters input) (input-place input) (input-end input))))
        (when (or told
                  (>= (- (input-end input) (input-place input)) 65536)
                  (not (more-characters input)))
          (return (or told (if (member first '(#\{ #\[)) :json :lisp))))))))

;;; Pieces

(defun record-start-p (input)
  "True if the line at the place of INPUT starts a record: with (( or (SETQ, in JSON with {.
The second value is true if more characters are needed to tell."
  (let ((characters (input-characters input))
        (place (after-marks input (input-place input)))
        (end (input-end input)))
    (flet ((begins (prefix)
             (let ((count (min (length prefix) (- end place))))
               (and (string-equal prefix characters :end1 count
                                                    :start2 place :end2 (+ place count))
                    (if (= count (length prefix)) :yes :maybe)))))
      (let ((answers (ecase (input-notation input)
                       (:json (list (begins "{")))
                       (:lisp (list (begins "((") (begins "(SETQ"))))))
        (values (and (member :yes answers) t)
                (and (member :maybe answers) t))))))

(defun after-marks (input place)
  "Return PLACE, or the one after the marks and separators that stand there.  Only so many are
looked at, since the buffer could not hold any number of them."
  (let ((end (min (input-end input) (+ place 1000))))
    (or (position-if-not (lambda (character)
                           (or (char= character +mark+) (char= character +separator+)))
                         (input-characters input) :start place :end end)
        end)))

(defun record-starts-p (input)
  "True if the line at the place of INPUT starts a record; gets more characters if it must."
  (loop
    (multiple-value-bind (yes maybe) (record-start-p input)
      (cond (yes (return t))
            ((not maybe) (return nil))
            ((not (more-characters input)) (return nil))))))

(defun piece-end (input)
  "Return where the piece that begins at the place of INPUT ends: before a line that may start a
record (as long as the notation is not known, any may), or where the characters end."
  (let* ((characters (input-characters input))
         (end (input-end input))
         (first (ecase (input-notation input) (:json #\{) (:lisp #\() ((nil) nil))))
    (declare (type (simple-array character (*)) characters) (fixnum end))
    (loop for place of-type fixnum from (input-place input) below end
          do (when (and (char= (schar characters place) #\Newline)
                        (or (null first)
                            (= (1+ place) end)
                            (char= (schar characters (1+ place)) first)
                            (/= (1+ place) (after-marks input (1+ place)))))
               (return (1+ place)))
          finally (return end))))

(defun next-piece (input)
  "Return the characters of INPUT, the end and the start of the next piece of them; or NIL at the
end, and where a line that starts a record ends the one that is open."
  (cond ((and (= (input-place input) (input-end input)) (not (more-characters input)))
         nil)
        ((and (input-open input) (input-line-start input) (record-starts-p input))
         (setf (input-cut input) t)
         nil)
        (t
         (let ((start (input-place input))
               (end (piece-end input)))
           (setf (input-place input) end
                 (input-line-start input)
                 (char= (schar (input-characters input) (1- end)) #\Newline))
           (values (input-characters input) end start)))))
