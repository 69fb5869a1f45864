;;;; views.lisp -- what rules can see of a box: the preliminary assertions that they test.

(in-package :supergrip)

(defstruct (view (:constructor %make-view (knowledge inputs predicates memory)))
  "What the rules of KNOWLEDGE see of a box: INPUTS are the preliminary assertions, prepared, that
they test; PREDICATES are those of INPUTS, and of the facts of a box's own that they test; MEMORY is
one to assert all that in."
  knowledge inputs predicates memory)

(defun declared-only (box knowledge)
  "Return BOX without the facts of its own that KNOWLEDGE does not declare."
  (let ((declared (remove-if-not (lambda (fact)
                                   (fact-predicate fact (knowledge-rulebase knowledge)))
                                 (%box-facts box))))
    (if (equal declared (%box-facts box))
        box
        (box-with box (find-key :facts) declared))))

(defun tested-p (predicate knowledge)
  "True if a rule of KNOWLEDGE tests PREDICATE."
  (loop for rule in (knowledge-rules knowledge)
          thereis (find predicate (rule-clauses rule) :key #'clause-predicate)))

(defun make-view (knowledge)
  "Return the view that the rules of KNOWLEDGE have."
  (let ((inputs (remove-if-not (lambda (input)
                                 (tested-p (prepared-input-predicate input) knowledge))
                               (knowledge-inputs knowledge))))
    (%make-view knowledge inputs
                (append (mapcar #'prepared-input-predicate inputs)
                        (tested-declarations knowledge))
                (make-memory (knowledge-rulebase knowledge)))))

(defun tested-declarations (knowledge)
  "Return the predicates that KNOWLEDGE declares by INPUT and that a rule of it tests."
  (remove-if-not (lambda (predicate)
                   (and (declared-p predicate) (tested-p predicate knowledge)))
                 (coerce (rulebase-predicates (knowledge-rulebase knowledge)) 'list)))

(defun look (view box)
  "Return the memory of VIEW, which holds what its rules see of BOX."
  (let ((memory (view-memory view)) (knowledge (view-knowledge view)))
    (clear-memory memory (knowledge-rulebase knowledge))
    (assert-box memory (view-inputs view) box)
    (when (%box-facts box)
      (assert-facts memory (declared-only box knowledge) (knowledge-rulebase knowledge)
                    "the rules"))
    memory))

(defun seen-facts (view box)
  "Return what the rules of VIEW see of BOX: a list of (PREDICATE . FACE-LIST), in the order in
which a plan asserts them."
  (loop with memory = (look view box)
        for predicate in (view-predicates view)
        append (loop for fact in (facts memory predicate) collect (cons predicate fact))))

(defun opaque-p (rule)
  "True if nothing is known of what an action of RULE does: one that a user has defined."
  (notevery (lambda (action)
              (member (action-verb action) '("REMEMBER" "CANT" "TRY" "KEEP") :test #'string=))
            (rule-actions rule)))

;;; Boxes, made from a plist of values

(defparameter +plain-values+
  `(:size ,(make-array 3 :element-type 'double-float :initial-element 4d0)
    :weight 0.1d0 :u 0.5d0 :v 0.2d0 :constrained 0
    :force-needed ,(make-array 6 :element-type 'double-float :initial-element 1d0)
    :velocity-needed ,(make-array 6 :element-type 'double-float :initial-element 1d0))
  "What a box has where nothing else is asked for: a cube of 4 cm, light, free on all sides; a
task that needs all alike.")

(defun plain-values ()
  "Return a plist of the values of a plain box: a new list, without the keys that a box may lack."
  (loop for row in *box-keys*
        for key = (box-key-key row)
        unless (box-key-optional row)
          collect key
          and collect (getf +plain-values+ key (key-value row (box-key-example row)))))

(defun box-description (box)
  "Return the description of BOX, a list that PARSE-BOX makes the same box of."
  (loop for row in *box-keys*
        for value = (measured-value row (funcall (box-key-reader row) box)
                                    (lambda (number measure)
                                      (in-units number measure (%box-units box))))
        unless (or (box-key-instead row) (and (null value) (box-key-optional row)))
          collect (cons (box-key-key row) (described-values (box-key-type row) value))))

(defgeneric described-values (type value)
  (:documentation "Return the list of what follows, in a description, a key whose type is TYPE and
whose value is VALUE: what PARSE-VALUES takes.")
  (:method (type value)
    (declare (ignore type))
    (if (listp value) value (list value)))
  (:method ((type (eql :number)) value)
    (list (plain-real value)))
  (:method ((type cons) value)
    (map 'list #'plain-real value))
  (:method ((type (eql :needs)) value)
    (list (map 'list #'plain-real value)))
  (:method ((type (eql :place)) value)
    (map 'list #'plain-real value))
  (:method ((type (eql :pose)) value)
    (loop for numbers in (shown-value :pose value) collect (mapcar #'plain-real numbers)))
  (:method ((type (eql :units)) value)
    (list (canonical-name (unit-name (units-length value)))
          (canonical-name (unit-name (units-force value)))))
  (:method ((type (eql :data)) value)
    (carried-value value))
  (:method ((type (eql :facts)) value)
    (loop for fact in value collect (fact-list fact #'canonical-name)))
  (:method ((type (eql :faces)) value)
    (loop for face from 5 downto 0
          when (logbitp face value) collect (canonical-name (face-name face)))))

(defun box-text (box)
  "Return the description of BOX as it is typed, in one line."
  (form-text (box-description box) nil))

(defun number-length (number)
  "Return about how many digits NUMBER, a double, takes to write."
  (loop for digits from 1 to 4
        for scaled = number then (* 10 scaled)
        when (or (> scaled 1d9) (= scaled (ffloor scaled)))
          return (if (>= number 10) (1+ digits) digits)
        finally (return 9)))

(defun box-length (box)
  "Return how much there is to say of BOX: constrained faces and facts first, then digits."
  (let ((length (* 1000 (+ (logcount (%box-constrained box)) (length (%box-facts box))))))
    (dolist (row *box-keys* length)
      (let ((value (funcall (box-key-reader row) box)))
        (typecase value
          (double-float (incf length (number-length value)))
          ((simple-array double-float (*))
           (loop for number across value do (incf length (number-length number)))))))))

(defun plainer-p (box other)
  "True if there is less to say of BOX than of OTHER."
  (< (box-length box) (box-length other)))
