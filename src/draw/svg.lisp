;;;; svg.lisp -- pictures: a small layer of SVG over cl-who.
;;;;
;;;; A picture is made once, and then written alone or into a page.  What it looks like is in
;;;; picture.css alone; light and dark are chosen by the reader's device.  Meaning is carried by
;;;; form, hatching and words, never by colour alone.

(in-package :supergrip-draw)

(defstruct picture
  "A drawing of WIDTH x HEIGHT units.  TITLE and DESCRIPTION are for those who can't see it; BODY is
the mark-up of what it shows."
  width height title description (body "" :type string))

(defvar *out* nil "The stream to which the mark-up of the picture being drawn goes.")

(defmacro text-of-file (name)
  "Return the text of the file NAME beside this one, as it is when this is compiled."
  (uiop:read-file-string (merge-pathnames name (or *compile-file-truename* *load-truename*))))

(defparameter +style+ (text-of-file "picture.css") "What pictures look like.")

(defparameter +patterns+
  "<defs><pattern id=\"hatch\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" ~
   patternTransform=\"rotate(45)\"><line class=\"hatch\" x1=\"0\" y1=\"0\" x2=\"0\" ~
   y2=\"7\"/></pattern></defs>"
  "The hatching of constrained faces, a format control.")

;;; Values

(defun clean (text)
  "Return TEXT with the characters that XML does not allow replaced by U+FFFD."
  (substitute-if-not #\Replacement_character
                     (lambda (char)
                       (let ((code (char-code char)))
                         (or (member code '(9 10 13)) (<= 32 code 126) (<= 160 code #xd7ff)
                             (<= #xe000 code #xfffd) (<= #x10000 code #x10ffff))))
                     text))

(defun safe (text)
  "Return TEXT, of whatever origin, escaped for mark-up."
  (cl-who:escape-string (clean text)))

(defun px (number)
  "Return NUMBER as the text of a coordinate, rounded to 1/100."
  (multiple-value-bind (whole part) (truncate (round (* 100 (check-coordinate number))) 100)
    (format nil "~:[~;-~]~d~[~:;.~:*~2,'0d~]" (or (minusp whole) (minusp part)) (abs whole)
            (abs part))))

(defun points-text (points)
  (format nil "~{~a~^ ~}" (loop for (x y) in points collect (format nil "~a,~a" (px x) (px y)))))

;;; Elements

(defmacro markup (&body body)
  "Write BODY, cl-who's notation, to *OUT*."
  `(cl-who:with-html-output (*out*) ,@body))

(defun draw-line (a b class)
  "Draw a line from the point A to B."
  (markup (:line :class class :x1 (px (first a)) :y1 (px (second a))
                 :x2 (px (first b)) :y2 (px (second b)))))

(defun draw-path (points class)
  "Draw an open line through POINTS."
  (markup (:polyline :class class :points (points-text points))))

(defun draw-polygon (points class &key fill)
  "Draw a closed outline; FILL, if given, takes the place of its fill."
  (markup (:polygon :class class :points (points-text points)
                    :style (and fill (format nil "fill: ~a; fill-opacity: 1" fill)))))

(defun draw-hatching (points)
  "Hatch the outline of POINTS."
  (markup (:polygon :points (points-text points) :fill "url(#hatch)")))

(defun draw-circle (centre radius class &key title)
  "Draw a circle, with a TITLE for those who point at it or can't see it."
  (markup (:circle :class class :cx (px (first centre)) :cy (px (second centre)) :r (px radius)
                   (when title (markup (:title (cl-who:str (safe title))))))))

(defun draw-rectangle (x y width height class)
  "Draw a rectangle whose upper left corner is X Y."
  (markup (:rect :class class :x (px x) :y (px y) :width (px width) :height (px height))))

(defmacro with-group ((&key class title description) &body body)
  "Draw BODY as a group with a TITLE and a DESCRIPTION for those who can't see it."
  `(markup (:g :class ,class
               ,@(and title `((markup (:title (cl-who:str (safe ,title))))))
               ,@(and description `((markup (:desc (cl-who:str (safe ,description))))))
               ,@body)))

;;; Text.  Its width is reckoned, on the wide side, since no font is at hand.

(defun character-width (char)
  "Return the width of CHAR as a part of the font's size, as in a wide sans-serif."
  (cond ((find char "ijl.,:;'|!()[] ") 0.40)
        ((find char "frtI-/") 0.45)
        ((find char "mwMW%@") 0.98)
        ((upper-case-p char) 0.72)
        ((< (char-code char) 127) 0.65)
        ((< (char-code char) #x2000) 0.75)
        (t 1.05)))

(defun class-size (class)
  "Return the font's size of the CLASS of a text."
  (if (search "heading" class) 20 13))

(defun text-width (text class)
  "Return the width of TEXT, reckoned on the wide side."
  (* (class-size class) (if (or (search "bold" class) (search "heading" class)) 1.08 1)
     (reduce #'+ (map 'list #'character-width text))))

(defun fitting (text class width)
  "Return TEXT, cut if it is wider than WIDTH."
  ;; No character is narrower than 1/3 of the font's size: what is beyond that is not looked at.
  (let ((text (subseq text 0 (min (length text)
                                  (ceiling (* 3 (max 1 width)) (class-size class))))))
    (loop for end from (length text) downto 0
          for cut = (if (= end (length text))
                        text
                        (format nil "~a…" (string-right-trim " " (subseq text 0 end))))
          when (<= (text-width cut class) width) return cut
          finally (return "…"))))

(defun filled (text class width)
  "Return the list of the lines of TEXT, none wider than WIDTH if its words allow it."
  (let ((lines '()) (line nil))
    (dolist (word (uiop:split-string (substitute #\Space #\Newline text) :separator " "))
      (let ((longer (if line (format nil "~a ~a" line word) word)))
        (cond ((and line (> (text-width longer class) width))
               (push line lines)
               (setf line word))
              (t (setf line longer)))))
    (mapcar (lambda (line) (fitting line class width))
            (reverse (if line (cons line lines) lines)))))

(defun text-box (text point class anchor)
  "Return the rectangle that TEXT takes, whose baseline is at POINT."
  (let ((width (text-width text class)) (size (class-size class)))
    (list (- (first point) (ecase anchor (:start 0) (:middle (/ width 2)) (:end width)))
          (- (second point) (* 0.95 size)) width (* 1.25 size))))

(defun draw-text (text point &key (class "plain") (anchor :start))
  "Write TEXT at POINT, the start, middle or end of its baseline, and keep its place clear."
  (let ((place (text-box text point class anchor)))
    (occupy place)
    (push place *words*))
  (markup (:text :class class :x (px (first point)) :y (px (second point))
                 :text-anchor (unless (eq anchor :start) (string-downcase anchor))
                 (cl-who:str (safe text)))))

;;; Pictures

(defmacro with-picture ((width height title description) &body body)
  "Return the picture of WIDTH x HEIGHT that BODY draws."
  `(let ((*obstacles* '()) (*words* '()) (*areas* '()) (*strokes* '()) (*leaders* '())
         (*labels* '()))
     (make-picture :width ,width :height ,height :title ,title :description ,description
                   :body (with-output-to-string (*out*) ,@body))))

(defvar *pictures-written* 0 "How many pictures are in the page so far: their ids differ by it.")

(defun write-picture (picture stream &key inline)
  "Write PICTURE to STREAM as an SVG 1.1 document, or, if INLINE, as part of an HTML page that has
the style and the patterns."
  (let ((id (format nil "p~d" (incf *pictures-written*)))
        (width (px (picture-width picture))) (height (px (picture-height picture))))
    (unless inline
      (format stream "<?xml version=\"1.0\" encoding=\"UTF-8\"?>~%"))
    (format stream "<svg class=\"sg\" xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" ~
                    width=\"~a\" height=\"~a\" viewBox=\"0 0 ~a ~a\"~
                    ~@[ role=\"img\" aria-labelledby=\"~a-title ~:*~a-desc\"~]>~%"
            width height width height (and inline id))
    (format stream "<title id=\"~a-title\">~a</title>~%<desc id=\"~a-desc\">~a</desc>~%"
            id (safe (picture-title picture)) id (safe (picture-description picture)))
    (unless inline
      (format stream "<style type=\"text/css\">~a</style>~%" +style+)
      (format stream +patterns+))
    (format stream "<rect class=\"paper\" width=\"~a\" height=\"~a\"/>~%~a~%</svg>~%"
            width height (picture-body picture))))

(defun path-of (file)
  "Return the path of FILE, a path, or a string that is taken as it stands."
  (let ((path (native-path file)))
    (if (pathname-name path)
        path
        (refuse-argument "~a is a directory; a file is wanted" (form-text file)))))

(defun call-writing (file function)
  "Call FUNCTION with a stream of UTF-8 text, and put what it wrote in the place of FILE: nobody
sees a half of it, and a link that stands there is replaced, not followed."
  (let* ((path (merge-pathnames (path-of file)))
         (new (make-pathname :name (format nil "~a.new" (pathname-name path)) :defaults path))
         (done nil))
    (ensure-directories-exist path)
    (ignore-errors (delete-file new))
    (unwind-protect
         (progn
           (with-open-file (stream new :direction :output :if-exists :error
                                       :external-format :utf-8)
             (let ((*pictures-written* 0))
               (funcall function stream)))
           (rename-file new path)
           (setf done t))
      (unless done (ignore-errors (delete-file new))))))

(defmacro with-output-to ((stream file) &body body)
  "Run BODY with STREAM bound to FILE, opened for UTF-8 text, and return FILE."
  (let ((name (gensym "FILE")))
    `(let ((,name ,file))
       (call-writing ,name (lambda (,stream) ,@body))
       ,name)))

(defun save-picture (picture file)
  "Write PICTURE to FILE, an SVG document, and return FILE."
  (with-output-to (stream file)
    (write-picture picture stream)))
