;;;; paper.lisp -- what the paper prints: its session, its rules, its grasp and its box.

(in-package :supergrip-test)
(define-suite paper "What the paper prints: its session, its rules, its grasp and its box.")

(test the-four-printed-rules-ship-as-printed
  ;; Section Implementation, High-Level Rules: no repair is needed.
  (loop for (name end) in '(("GRIP1" "(RULE SURFACES1") ("SURFACES1" "(RULE GRIP6")
                            ("GRIP6" "(RULE GRIP8") ("GRIP8" "(SETQ PINCH"))
        for printed = (paper-form (format nil "(RULE ~a" name) end)
        do (is (same-form-p printed (shipped-form "rules.lisp" "RULE" name)) name)))

(defparameter *grasp-repairs*
  '(;; The scan reads a product as a sum; O as D; and its parentheses and dots are damaged.
    ("(+ 2 u)
  (+ 2 u)" "(* 2 u)
  (* 2 u)")
    ("(+ 2 v)" "(* 2 v)")
    ("(+ u (DIST '(N1 N2)))
  (+ u (DIST '(N1 N2))))" "(* u (DIST '(N1 N2)))
  (* u (DIST '(N1 N2))))")
    ("(DIST '(D1 D2))" "(DIST '(O1 O2))")
    ("(CONSTRAINED D1)" "(CONSTRAINED O1)")
    ("(CONSTRAINED D2)" "(CONSTRAINED O2)")
    ("(/ (- DIST '(N1 N2)) FINGER-DIST) 2)" "(/ (- (DIST '(N1 N2)) FINGER-DIST) 2))")
    ("'(0 0 0 0 .(- offset) ,offset)" "(LIST 0 0 0 0 (- offset) offset)")
    ;; The listing becomes a property list.
    ("(CONDITIONS ((DIST" "CONDITIONS (((DIST")
    ("(CONSTRAINED O2))))))" "(CONSTRAINED O2))))")
    ("(OFFSET (LET*" "OFFSET (LET*")
    ("offset)))

(WRENCH (1" "offset))

WRENCH (1")
    ("(DIST '(N1 N2))))

(TWIST (0.8 0.5 1 0.2 1 1)))" "(DIST '(N1 N2))))

TWIST (0.8 0.5 1 0.2 1 1)))"))
  "What the scan of PINCH-2-PARALLEL has, and how it is read.")

(test the-printed-grasp-ships-as-repaired
  (let* ((shipped (second (third (shipped-form "grasps.lisp" "SETQ" "PINCH-2-PARALLEL"))))
         (printed (second (third (paper-form "(SETQ PINCH-2-PARALLEL" "(SETQ BOX"
                                             *grasp-repairs*)))))
    (is (= 10 (length printed)))
    (is (same-form-p printed (subseq shipped 0 10)))
    (is (equal '("CONTACTS" "PALM") (mapcar #'symbol-name (list (nth 10 shipped) (nth 12 shipped))))
        "only CONTACTS and PALM are added")
    (is (null (nthcdr 14 shipped)))))

(defparameter *session-repairs*
  '(("OBJECT HAS ADJACENT SURFACES))" "OBJECT HAS ADJACENT SURFACES)")
    ("OBJECT HAS FREE CORNERS))" "OBJECT HAS FREE CORNERS)"))
  "What the scan of the session has, and how it is read.")

(test the-printed-session-comes-out
  (let ((printed
         (part-between (file-text "t/paper-listings.txt") "(RULE SURFACES1 SAYS PAR" "§ end")))
    (loop for (from to) in *session-repairs*
          do (setf printed (replace-once printed from to)))
    (is (equal printed (transcript (supergrip:plan (paper-box)))))
    (is (equal printed (file-text "t/pencil-session.txt")))))

(test the-printed-listing-is-a-valid-grasp-as-it-stands
  ;; Without CONTACTS and PALM, which are ours, the fingers stand in the middle of the faces.
  (let* ((gripper (shipped-form "grasps.lisp" "SETQ" "GRIPPER"))
         (printed (paper-form "(SETQ PINCH-2-PARALLEL" "(SETQ BOX" *grasp-repairs*))
         (graspbase (multiple-value-bind (value problems)
                        (supergrip-data:with-problems
                          (supergrip::build-graspbase
                           (list printed) (supergrip::build-gripper (list gripper))))
                      (is (null problems))
                      value))
         (grasp (first (supergrip::graspbase-grasps graspbase))))
    (is (equal '(0 1) (mapcar #'first (supergrip::grasp-contacts grasp))))
    (is (= 5 (supergrip::grasp-palm grasp)))))

(test the-unprinted-candidates-of-the-session
  ;; RECONSTRUCTION, section 2: what the paper does not print must not be possible, or not tried.
  (flet ((possible (grasp)
           (supergrip:possible-grasps (supergrip:try-grasp grasp (paper-box)))))
    (is (null (possible "PINCH-3-CORNER")) "open at u = 0.8")
    (is (equal '(0.325 0.258)
               (mapcar (lambda (entry) (/ (round (second entry) 0.001d0) 1000.0))
                       (possible "PINCH-2-PARALLEL")))
        "possible, so the rule that tries it must not fire")))

(defun grasps-with (&rest dimensions)
  "Return the forms of the shipped grasp file with DIMENSIONS, a plist by name, of another gripper."
  (loop for form in (supergrip-data:read-all
                     (supergrip-data:string-source (file-text "grasps.lisp")))
        collect (if (supergrip::gripper-form-p form)
                    (list (first form) (second form)
                          (list :quote
                                (loop for (name number) on (second (third form)) by #'cddr
                                      collect name
                                      collect (getf dimensions
                                                    (intern (symbol-name name) :keyword) number))))
                    form)))

(test other-hands-print-the-same-session
  ;; RECONSTRUCTION, section 5: the session binds FINGER-LENGTH and FINGER-DIST only jointly.
  (flet ((session (&rest dimensions)
           (transcript
            (supergrip:plan (paper-box)
                             :knowledge (supergrip::build-knowledge
                                         (supergrip::read-data-file
                                          (supergrip::shipped-file "rules.lisp"))
                                         (supergrip::make-data-file
                                          :name "grasps.lisp"
                                          :forms (apply #'grasps-with dimensions)))))))
    (let ((printed (file-text "t/pencil-session.txt")))
      (is (equal printed (session :finger-length 3 :finger-dist 4.705d0 :dist-pinch 10.5d0)))
      (is (equal printed (session :finger-length 4 :finger-dist 9.262d0)))
      (is (equal printed (session :finger-length 5 :finger-dist 11.9075d0)))
      (is (not (equal printed (session :finger-length 4)))))))

(defun session-of (gripper)
  "Return the paper's session by a GRIPPER that differs from the shipped one: a list of texts, what
stands in grasps.lisp and what is to stand there."
  (let ((grasps (file-text "grasps.lisp")))
    (loop for (from to) in gripper do (setf grasps (replace-once grasps from to)))
    (transcript (supergrip:plan (paper-box)
                                :knowledge (text-knowledge (file-text "rules.lisp") grasps)))))

(test other-grippers-print-the-same-session
  ;; docs/reconstruction.md: the session binds FINGER-LENGTH and FINGER-DIST only jointly.
  (let ((session (file-text "t/pencil-session.txt")))
    (loop for (length distance pinch) in '(("3.0" "4.705" "10.5") ("4.0" "9.262" "12")
                                           ("5.0" "11.9077" "12"))
          do (is (equal session (session-of `(("FINGER-LENGTH 3.2"
                                               ,(format nil "FINGER-LENGTH ~a" length))
                                              ("FINGER-DIST   6.05"
                                               ,(format nil "FINGER-DIST ~a" distance))
                                              ("DIST-PINCH    12"
                                               ,(format nil "DIST-PINCH ~a" pinch)))))
                 "FINGER-LENGTH ~a" length))
    (is (not (equal session (session-of '(("FINGER-LENGTH 3.2" "FINGER-LENGTH 3.201"))))))))
