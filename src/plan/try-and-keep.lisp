;;;; try-and-keep.lisp -- the actions TRY and KEEP, which attach the grasps to the rules.

(in-package :supergrip)

(defun constant-matchings (terms)
  "Return the set of the matchings that give the grasp-faces the faces among TERMS, six of them, NIL
for any."
  (matchings-giving (loop for term in terms
                          collect (and term (not (term-variable-p term)) (term-value term 0)))))

(defun variable-faces (terms)
  "Return what SUGGESTED-MATCHINGS needs of TERMS, six: for each that is a variable, 8 times its
number and the grasp face."
  (coerce (loop for term in terms
                for grasp-face from 0
                when (and term (term-variable-p term)) collect (+ (* 8 term) grasp-face))
          '(simple-array (unsigned-byte 8) (*))))

(declaim (inline suggested-matchings))
(defun suggested-matchings (set faces binding)
  "Return those of the matchings SET that give grasp faces the faces that variables have under
BINDING; FACES says which, see VARIABLE-FACES."
  (declare (type matching-set set) (type (simple-array (unsigned-byte 8) (*)) faces))
  (loop for face across faces
        do (setf set (logand set (aref +matchings-with+ (ldb (byte 3 0) face)
                                       (face-list-ref binding (the (integer 0 5) (ash face -3)))))))
  set)

(defun parse-suggestion (operands action)
  "Return the terms of the suggested matching in OPERANDS, NIL for each that is ?; or complain, and
return true as the second value."
  (let ((list (first operands)))
    (flet ((any-p (element) (name= element "?")))
      (multiple-value-bind (terms bad)
          (and (consp list) (parse-surfaces (remove-if #'any-p list) nil))
        (cond ((null operands) '())
              ((or (rest operands) (not (consp list)) (/= (length list) 6))
               (complain (action-form action) "a suggested matching is one list of six, for N1 N2 ~
                                               O1 O2 A1 A2, with ? for any: (? s3 s1 s2 ? s4)")
               (values nil t))
              (bad (values nil t))
              (t (loop for element in list
                       collect (if (any-p element) nil (pop terms)))))))))

(defun compile-try (action grasp)
  "Return ACTION, finished, which tries GRASP; NIL after a complaint of its suggestion."
  (multiple-value-bind (terms bad) (parse-suggestion (rest (action-operands action)) action)
    (unless bad
      (when (zerop (constant-matchings terms))
        (complain (action-form action)
                  '(:warning "no matching has these faces in these places: N O A is a proper ~
                              rotation of X Y Z")))
      (finish-action action
                     (let ((set (constant-matchings terms))
                           (faces (variable-faces terms)))
                       (lambda (memory rule binding)
                         (declare (ignore rule))
                         (try-matchings memory grasp (suggested-matchings set faces binding))
                         nil))
                     :terms terms :target grasp))))

(defmethod action-mentions ((verb (eql :try)) operands)
  (and (consp operands) (namep (first operands)) (list (first operands))))

(defmethod action-sees-p ((verb (eql :try)) action variable)
  (member variable (action-terms action)))

(defmethod describe-action ((verb (eql :try)) action)
  (destructuring-bind (grasp &optional suggestion) (action-operands action)
    (format nil "try ~a~@[ with ~{~a~^, ~}~]" grasp
            (loop for element in suggestion
                  for grasp-face across +grasp-faces+
                  unless (name= element "?") collect (format nil "~a = ~a" grasp-face element)))))

(define-action :try (action graspbase)
  (let* ((name (first (action-operands action)))
         (grasp (and (namep name) (find-grasp graspbase (symbol-name name)))))
    (unless grasp
      (parse-suggestion (rest (action-operands action)) action))
    (cond (grasp (compile-try action grasp))
          ((not (namep name))
           (complain (action-form action) "TRY names a grasp, such as (TRY PINCH-3-PARALLEL)"))
          ;; A grasp with errors was already reported.
          ((name-in name (graspbase-broken graspbase)) nil)
          (t (complain (action-form action) "TRY names ~a, which is not in the database~a" name
                       (suggestion name (mapcar #'grasp-name (graspbase-grasps graspbase))))))))

(define-action :keep (action graspbase)
  (if (and (= (length (action-operands action)) 1) (name= (first (action-operands action)) "BEST"))
      (finish-action action (lambda (memory rule binding)
                              (declare (ignore memory binding))
                              (make-stop :verdict :keep :rule rule)))
      (complain (action-form action) "KEEP is (KEEP BEST)")))

(defmethod action-sees-p ((verb (eql :keep)) action variable)
  (declare (ignore action variable))
  nil)

(defmethod describe-action ((verb (eql :keep)) action)
  (declare (ignore action))
  "keep the best grasp, and stop")
