;;;; verify.lisp -- what VERIFY-KNOWLEDGE and COMPARE-KNOWLEDGE say about rules is what their
;;;; boxes show.

(in-package :supergrip-test)
(define-suite verify "What is said about all situations is what the boxes show.")

;;; Knowledge, and mutants of it

(defvar *grasps-text* (file-text "grasps.lisp"))

(defun rule-forms-knowledge (forms)
  "Return the knowledge of the rule FORMS and the grasps of *GRASPS-TEXT*, and true if it is valid."
  (multiple-value-bind (knowledge problems)
      (supergrip::build-knowledge (supergrip::make-data-file :name "rules.lisp" :forms forms)
                                  (text-file *grasps-text* "grasps.lisp"))
    (values knowledge (null (supergrip-data:errors-in problems)))))

(defun forms-in (text)
  (supergrip-data:read-all (supergrip-data:string-source text)))

(defun shipped-rule-forms () (forms-in (file-text "rules.lisp")))

(defun shipped-knowledge () (rule-forms-knowledge (shipped-rule-forms)))

(defun rule-named (name forms)
  (find name forms :key #'second :test #'string=))

(defun with-clauses (rule clauses)
  "Return the form RULE with CLAUSES instead of its own."
  (destructuring-bind (rule-word name (if-word . old) then) rule
    (declare (ignore old))
    (list rule-word name (cons if-word clauses) then)))

(defun negated (clause)
  (cond ((supergrip-data:name= (first clause) "NOT") (rest clause))
        ((find-if (lambda (word) (supergrip-data:name= word "NO")) clause)
         (remove-if (lambda (word) (supergrip-data:name= word "NO")) clause))
        (t (cons (supergrip-data:canonical-name "NOT") clause))))

(defun with-exchanged (list i j)
  (let ((copy (copy-list list)))
    (rotatef (nth i copy) (nth j copy))
    copy))

(defun mutant (forms state)
  "Return the rule FORMS after one random change: a clause dropped, negated, or exchanged with
another, or two rules exchanged."
  (let* ((rule (random-element forms state))
         (clauses (rest (third rule)))
         (count (length clauses))
         (place (random count state)))
    (flet ((changed (clauses) (substitute (with-clauses rule clauses) rule forms)))
      (ecase (random 4 state)
        (0 (if (= count 1)
               (mutant forms state)
               (changed (append (subseq clauses 0 place) (nthcdr (1+ place) clauses)))))
        (1 (changed (substitute (negated (nth place clauses)) (nth place clauses) clauses)))
        (2 (changed (with-exchanged clauses place (random count state))))
        (3 (with-exchanged forms (random (length forms) state) (random (length forms) state)))))))

(defun valid-mutant (forms state)
  "Return the knowledge of a mutant of FORMS that is valid."
  (loop (multiple-value-bind (knowledge valid) (rule-forms-knowledge (mutant forms state))
          (when valid (return knowledge)))))

;;; Answers by plans, without any of what is tested

(defun plan-answer (box knowledge)
  "Return what the plan for BOX shows of the answer of the rules of KNOWLEDGE: the words with
which they refuse it, or the list of what was tried, in order."
  (let* ((plan (supergrip:plan box :knowledge knowledge))
         (stop (supergrip:plan-stop plan)))
    (if (and stop (eq (supergrip-chainer:stop-verdict stop) :cant))
        (supergrip-chainer:stop-words stop)
        (loop for candidate in (supergrip:plan-candidates plan)
              collect (list (supergrip:candidate-grasp candidate)
                            (supergrip:candidate-matching candidate))))))

(defun sizes-and-frictions ()
  "Return a size of each class that the shipped assertions can tell apart, and a friction."
  (flet ((dimension (name)
           (cdr (assoc name (supergrip:knowledge-gripper (shipped-knowledge)) :test #'string=))))
    (let ((width (dimension "FINGER-WIDTH")) (spread (dimension "FINGER-SPREAD"))
          (opening (dimension "DIST-PINCH")) (slippery (dimension "SLIPPERY-U")))
      (values (list (/ width 2) (/ (+ width spread) 2) (/ (+ spread opening) 2) (+ opening 3))
              (list (/ slippery 2) (+ slippery 0.4d0))))))

(defun situation-boxes ()
  "Return a box of each situation that the shipped rules can tell apart."
  (let ((boxes '()))
    (multiple-value-bind (sizes frictions) (sizes-and-frictions)
      (dolist (x sizes (reverse boxes))
        (dolist (y sizes)
          (dolist (z sizes)
            (dolist (u frictions)
              (dotimes (set 64)
                (push (simple-box x y z u set) boxes)))))))))

(defun simple-box (x y z u set)
  (supergrip:parse-box
   `((size ,x ,y ,z) (weight 0.1d0) (u ,u) (v 0.2d0)
     (constrained ,@(loop for face in '(z2 z1 y2 y1 x2 x1)
                          for bit from 0
                          when (logbitp bit set) collect face))
     (force-needed (1 1 1 1 1 1)) (velocity-needed (1 1 1 1 1 1)))))

(defun plan-answers (knowledge boxes)
  (loop for box in boxes collect (plan-answer box knowledge)))

(defun compare-situations (old new)
  (supergrip:compare-knowledge old new :situations :stream nil))

(defun shown-p (difference)
  "True if the plans of DIFFERENCE, whose box is read back, show what it says."
  (let* ((box (read-back (supergrip:difference-box difference)))
         (old (known-answer box (supergrip:difference-old difference)))
         (new (known-answer box (supergrip:difference-new difference)))
         (refused (lambda (answer) (stringp (first answer))))
         (same (same-tried-p old new (supergrip:knowledge-grasps
                                      (supergrip:plan-knowledge
                                       (supergrip:difference-old difference))))))
    (ecase (supergrip:difference-what difference)
      (:cant (and (not (equal old new)) (or (funcall refused old) (funcall refused new))))
      (:tried (and (not same) (notany refused (list old new))))
      (:order (and same (not (equal old new)))))))

(defun known-answer (box plan)
  "Return the answer for BOX of the knowledge of PLAN, without facts that this does not declare."
  (plan-answer (supergrip::declared-only box (supergrip:plan-knowledge plan))
               (supergrip:plan-knowledge plan)))

(defun same-tried-p (old new grasps)
  "True if OLD and NEW, answers, hold the same or equivalent matchings of the same GRASPS."
  (flet ((sets (answer)
           (let ((sets '()))
             (loop for (name matching) in answer
                   for grasp = (find name grasps :key #'supergrip:grasp-name
                                                           :test #'string=)
                   for index = (position matching supergrip::+matchings+ :test #'equal
                                         :key #'supergrip::matching-names)
                   do (setf (getf sets grasp)
                            (logior (getf sets grasp 0)
                                    (aref (supergrip::grasp-same grasp) index))))
             (loop for grasp in grasps collect (getf sets grasp 0)))))
    (or (equal old new)
        (and (not (stringp (first old))) (not (stringp (first new)))
             (equal (sets old) (sets new))))))

(defun read-back (box)
  "Return the box that the text of BOX is read as."
  (supergrip:parse-box (first (supergrip-data:read-all
                               (supergrip-data:string-source (supergrip::box-text box))))))

(defun mutant-fault (old old-answers boxes state)
  "Compare OLD, whose OLD-ANSWERS for BOXES are known, with a random mutant.  Return what is
wrong with what COMPARE-KNOWLEDGE says, or NIL; and true if the mutant changes an answer."
  (let* ((new (valid-mutant (shipped-rule-forms) state))
         (differences (compare-situations old new))
         (changed (count nil (mapcar #'equal old-answers (plan-answers new boxes)))))
    (values (cond ((and (plusp changed) (null differences)) "a mutant without a witness")
                  ((and differences (zerop changed)) "a witness without a change")
                  ((/= changed (reduce #'+ differences :key #'supergrip:difference-situations))
                   "a wrong count")
                  ((notevery #'shown-p differences) "a witness that shows nothing"))
            (plusp changed))))

(test comparing-situations-finds-every-mutant
  (let* ((state (sb-ext:seed-random-state 12))
         (old (shipped-knowledge))
         (boxes (situation-boxes))
         (old-answers (plan-answers old boxes)))
    (format t "~&   20 mutants, seed 12~%")
    (is (null (compare-situations old old)))
    (is (null (loop repeat 20 for fault = (mutant-fault old old-answers boxes state)
                    when fault collect fault)))))

(test comparing-situations-is-told-in-words
  (let ((old (text-knowledge *good-rules* *good-grasps*))
        (new (text-knowledge (replace-once *good-rules* "PARALLEL (s1 s2)))" "LARGE (s1 s2)))")
                             *good-grasps*)))
    (is (equal '("tried no longer: G: 272 situations, as"
                 "tried in other matchings: G: 90 situations, as"
                 "The rules answer something else in 362 of 1728 situations.")
               (remove-if (lambda (line) (eql 0 (search "  ((SIZE" line)))
                          (printed (supergrip:compare-knowledge old new :situations)))))))

(defparameter *lateral*
  "(SETQ LATERAL '(USED-SURFACES (N1 N2) CONDITIONS (T) OFFSET (LIST 0 0 0 0 0 0)
                   WRENCH (1 1 1 1 1 1) TWIST (1 1 1 1 1 1) CONTACTS ((N1 0 0) (N2 0 0)) PALM A2))
")

(test comparing-situations-finds-other-thresholds-and-grasps
  (let ((old (shipped-knowledge)))
    (flet ((with-grasps (text)
             (text-knowledge (file-text "rules.lisp") text)))
      (let ((differences (compare-situations
                          old (with-grasps (replace-once (file-text "grasps.lisp")
                                                         "DIST-PINCH    12" "DIST-PINCH    11")))))
        (is (plusp (length differences)))
        (is (every #'shown-p differences))
        (is (every (lambda (difference)
                     (find-if (lambda (size) (<= 11 size 12))
                              (supergrip:box-size (supergrip:difference-box difference))))
                   differences)))
      (is (null (compare-situations old (with-grasps (concatenate 'string *lateral*
                                                                  (file-text "grasps.lisp")))))
          "another grasp before the others, which no rule tries"))))

;;; VERIFY-KNOWLEDGE

(defun verified (knowledge &optional (boxes 1000))
  "Return the verification of KNOWLEDGE, for which no more than some BOXES are searched."
  (let ((supergrip::*search-limit* boxes))
    (supergrip:verify-knowledge knowledge :stream nil)))

(defun findings-of (kind verification)
  (remove kind (supergrip:verification-findings verification)
          :key #'supergrip:finding-kind :test-not #'eq))

(defun uses-fault (verification forms)
  "Return the first RULE-USE of VERIFICATION, of the rules FORMS, that is wrong by a comparison with
the rules without that rule, which uses no rotations; or NIL."
  (flet ((without (name)
           (rule-forms-knowledge (remove (rule-named name forms) forms))))
    (find-if-not (lambda (use)
                   (= (supergrip:rule-use-matters use)
                      (reduce #'+ (remove :order (compare-situations
                                                  (supergrip:verification-knowledge verification)
                                                  (without (supergrip:rule-use-name use)))
                                          :key #'supergrip:difference-what)
                              :key #'supergrip:difference-situations)))
                 (supergrip:verification-rules verification))))

(test situations-are-counted-and-so-are-rules
  (let* ((forms (shipped-rule-forms))
         (knowledge (shipped-knowledge))
         (verification (verified knowledge)))
    (is (= (length (situation-boxes)) (supergrip:verification-situations verification)))
    (is (< (/ (length (situation-boxes)) 24) (supergrip:verification-kinds verification)
           (/ (length (situation-boxes)) 8)))
    (is (null (supergrip:verification-seed verification)))
    (is (null (uses-fault verification forms)))))

(test what-rules-answer-is-what-plans-try
  (let* ((knowledge (shipped-knowledge))
         (runner (supergrip::make-runner knowledge))
         (grasps (supergrip:knowledge-grasps knowledge)))
    (flet ((told (answer)
             (or (supergrip::answer-cant answer)
                 (loop for (grasp . matching) in (supergrip::answer-order answer)
                       collect (list (supergrip:grasp-name (nth grasp grasps))
                                     (supergrip::matching-names
                                      (svref supergrip::+matchings+ matching)))))))
      (is (null (find-if-not (lambda (box)
                               (equal (plan-answer box knowledge)
                                      (told (supergrip::run-runner runner box))))
                             (situation-boxes)))))))

(defun possible-plan-p (grasp box knowledge)
  (supergrip:plan-best (supergrip:try-grasp grasp box :knowledge knowledge)))

(defun finding-shown-p (finding forms)
  "True if the plan for the witness of FINDING, which is read back, shows it.  FORMS are those of
the rules."
  (let* ((knowledge (rule-forms-knowledge forms))
         (box (read-back (supergrip:finding-witness finding)))
         (plan (supergrip:plan box :knowledge knowledge))
         (rule (rule-named (supergrip:finding-rule finding) forms))
         (grasp (supergrip:finding-grasp finding))
         (stop (supergrip:plan-stop plan)))
    (flet ((without () (rule-forms-knowledge (remove rule forms)))
           (moved ()
             (let* ((others (remove rule forms))
                    (tail (member (supergrip:finding-other finding) others
                                  :key #'second :test #'string=)))
               (rule-forms-knowledge (append (ldiff others tail) (list rule) tail))))
           (of-grasp (name)
             (remove name (supergrip:plan-candidates plan)
                     :key #'supergrip:candidate-grasp :test-not #'string=)))
      (ecase (supergrip:finding-kind finding)
        ((:redundant :subsumed) (equal (plan-answer box knowledge) (plan-answer box (without))))
        (:shadowed (member (supergrip-chainer:rule-name (supergrip-chainer:stop-rule stop))
                           (supergrip:finding-other finding) :test #'string=))
        (:order (set-exclusive-or (plan-answer box knowledge) (plan-answer box (moved))
                                  :test #'equal))
        (:silent (and (null (supergrip:plan-candidates plan))
                      (not (stringp (first (plan-answer box knowledge))))))
        (:nothing-suggested (and (null (supergrip:plan-candidates plan))
                                 (possible-plan-p grasp box knowledge)))
        (:all-fail (and (supergrip:plan-candidates plan) (null (supergrip:plan-best plan))
                        (possible-plan-p grasp box knowledge)))
        (:worse (and (string= (supergrip:finding-other finding) (supergrip:plan-grasp plan))
                     (> (supergrip:plan-quality
                         (supergrip:try-grasp grasp box :knowledge knowledge))
                        (supergrip:plan-quality plan))))
        (:refused (and (string= (supergrip:finding-rule finding)
                                (supergrip-chainer:rule-name (supergrip-chainer:stop-rule stop)))
                       (possible-plan-p grasp box knowledge)))
        (:vain (and (of-grasp grasp)
                    (notany #'supergrip:candidate-quality (of-grasp grasp))))))))

(test every-finding-is-shown-by-its-box
  (let* ((forms (shipped-rule-forms))
         (findings (supergrip:verification-findings (verified (shipped-knowledge) 1000000))))
    (is (< 10 (length findings)))
    (dolist (finding findings)
      (is (finding-shown-p finding forms) "~a for ~a" finding
          (supergrip::box-text (supergrip:finding-witness finding))))))

(test random-rules-are-verified
  (format t "~&   4 random rule bases, seed 5~%")
  (let ((state (sb-ext:seed-random-state 5)))
    (dotimes (i 4)
      (let* ((forms (mapcar #'supergrip-data:canonical (random-rules state)))
             (verification (verified (rule-forms-knowledge forms))))
        (is (null (uses-fault verification forms)))
        (dolist (finding (supergrip:verification-findings verification))
          (when (and (supergrip:finding-witness finding)
                     (not (eq :vain (supergrip:finding-kind finding))))
            (is (finding-shown-p finding forms) "~a" finding)))))))

(defun text-with (text &optional (before "END") (rules *good-rules*))
  "Return the text of RULES with the rules of TEXT before the rule BEFORE."
  (replace-once rules (format nil "(RULE ~a~%" before) (format nil "~a~%(RULE ~a~%" text before)))

(defun finding-line (rule text)
  "Return what the report says of RULE, which never fires or can be left out, in the rules of TEXT."
  (let* ((forms (forms-in text))
         (verification (verified (rule-forms-knowledge forms)))
         (finding (find-if (lambda (finding)
                             (and (equal rule (supergrip:finding-rule finding))
                                  (member (supergrip:finding-kind finding)
                                          '(:never :shadowed :subsumed :redundant))))
                           (supergrip:verification-findings verification))))
    (when finding
      (when (supergrip:finding-witness finding)
        (is (finding-shown-p finding forms)))
      (list (supergrip:finding-kind finding) (supergrip::finding-text finding)))))

(test rules-that-can-be-done-without-are-found
  (let ((*grasps-text* *good-grasps*)
        (parts "(RULE SOME (IF (PARALLEL (s1 s2)) (NARROW (s1 s2))) (THEN (TRY G (s1 s2 ? ? ? ?))))
                (RULE REST (IF (PARALLEL (s1 s2)) (NOT NARROW (s1 s2)))
                           (THEN (TRY G (s1 s2 ? ? ? ?))))"))
    (is (equal '(:redundant "END") (finding-line "END" *good-rules*)))
    (is (null (finding-line "ACROSS" *good-rules*)))
    (is (equal '(:never "NEW: clause 2 never holds together with those before it")
               (finding-line "NEW" (text-with "(RULE NEW (IF (SMALL (s1 s2)) (LARGE (s1 s2)))
                                                         (THEN (CANT DO)))"))))
    (is (equal '(:shadowed "NEW: OBVIOUS")
               (finding-line "NEW" (text-with "(RULE NEW (IF (SMALL (s1 s2)) (CONSTRAINED (s2)))
                                                         (THEN (TRY G)))"))))
    (is (equal '(:subsumed "SOME: ACROSS") (finding-line "SOME" (text-with parts))))
    (is (equal '(:redundant "ACROSS; but then not also SOME, REST")
               (finding-line "ACROSS" (text-with parts))))))

(defun forms-with (text)
  "Return the forms of the shipped rules with those of TEXT before the last."
  (let ((forms (shipped-rule-forms)))
    (append (butlast forms) (forms-in text) (last forms))))

(test a-face-that-a-rule-names-is-no-longer-like-the-others
  (let* ((forms (forms-with "(RULE TABLE
                                (IF (CONSTRAINED (Z2)) (NOT CONSTRAINED (Z1)) (WIDE (s1 s2)))
                                (THEN (TRY PINCH-2-ADJACENT (Z1 ? ? ? ? ?))))"))
         (knowledge (rule-forms-knowledge forms))
         (verification (verified knowledge))
         (use (find "TABLE" (supergrip:verification-rules verification)
                    :key #'supergrip:rule-use-name :test #'string=)))
    (is (< (supergrip:verification-kinds (verified (shipped-knowledge)))
           (supergrip:verification-kinds verification)))
    (is (plusp (supergrip:rule-use-matters use)))
    (is (= (supergrip:rule-use-matters use)
           (reduce #'+ (compare-situations knowledge
                                           (rule-forms-knowledge (remove (rule-named "TABLE" forms)
                                                                       forms)))
                   :key #'supergrip:difference-situations)))))

(test thresholds-come-from-the-table-of-assertions
  (let ((supergrip::*inputs* supergrip::*inputs*))
    (supergrip::define-input "TALL" (:pair distance) (length "WIDTH-HAND")
      (> distance length)
      "tall")
    (supergrip::define-input "HEAVY" (:box box) ()
      (<= 1.25 (supergrip:box-weight box) 1.26)
      "heavy")
    (supergrip::define-input "RED" (:box box) ()
      (equal "red" (supergrip:box-name box))
      "red")
    (supergrip::define-input "FLAT" (:box box) ()
      (> (first (supergrip:box-size box)) (* 3 (third (supergrip:box-size box))))
      "flat")
    (flet ((verification (clause)
             (verified (rule-forms-knowledge
                        (forms-with (format nil "(RULE NEW (IF ~a) (THEN (REMEMBER NEW)))"
                                            clause)))))
           (situations (sizes others) (* 64 2 (expt sizes 3) others)))
      (let ((sizes (length (sizes-and-frictions))))
        (is (= (situations sizes 1)
               (supergrip:verification-situations (verification "(LARGE (s1 s2))"))))
        (is (= (situations (1+ sizes) 1)
               (supergrip:verification-situations (verification "(TALL (s1 s2))"))))
        (is (= (situations sizes 2)
               (supergrip:verification-situations (verification "(HEAVY)"))))
        (is (equal '("RED") (supergrip:verification-unseen (verification "(RED)"))))
        (let ((flat (verification "(FLAT)")))
          (is (equal '("FLAT") (supergrip:verification-several flat)))
          (is (< (situations sizes 1) (supergrip:verification-situations flat)
                 (situations sizes 2))))))))

(test declared-facts-multiply-the-situations
  (let* ((*grasps-text* *good-grasps*)
         (base (supergrip:verification-situations (verified (rule-forms-knowledge
                                                             (forms-in *good-rules*)))))
         (supergrip::*situation-sample* 500)
         (wet "(INPUT WET) (INPUT UNTESTED (s1))
               (RULE NEW (IF (WET) (SMALL (s1 s2))) (THEN (CANT DO)))")
         (fragile "(INPUT FRAGILE (s1))
                   (RULE NEW (IF (FRAGILE (s1)) (PARALLEL (s1 s2))) (THEN (CANT DO)))")
         (broken "(INPUT BROKEN (s1 s2)) (RULE NEW (IF (BROKEN (s1 s2))) (THEN (CANT DO)))"))
    (flet ((knowledge (text) (rule-forms-knowledge (forms-in (text-with text)))))
      (let ((wet (knowledge wet)) (fragile (knowledge fragile)) (good (knowledge "")))
        (is (= (* 2 base) (supergrip:verification-situations (verified wet))))
        (dolist (new (list wet fragile))
          (let ((differences (compare-situations good new)))
            (is (plusp (length differences)))
            (is (every (lambda (difference)
                         (= 1 (length (supergrip:box-facts (supergrip:difference-box difference)))))
                       differences))
            (is (every #'shown-p differences))))
        (is (eql 1 (supergrip:verification-seed (verified (knowledge broken)))))))))

(test of-too-many-situations-some-are-drawn
  (let* ((supergrip::*situation-limit* 8000) (supergrip::*situation-sample* 300)
         (supergrip::*search-limit* 2000)
         (lines (printed (supergrip:verify-knowledge (shipped-knowledge)))))
    (is (search "They can tell more than 8000 situations apart." (first lines)))
    (is (search "drawn with the seed 1; nothing is proved" (first lines)))))

(test boxes-are-described-as-they-are-read
  (for-random-boxes (box 50 5)
    (let ((box (supergrip:parse-box (cons '(name "a b") box))))
      (is (equal (supergrip::box-description box)
                 (supergrip::box-description (read-back box)))))))

(test thresholds-may-be-of-any-size
  (flet ((searched (key &rest changes)
           (let ((text (format nil "~a~%~a" *small-gripper* (apply #'grasp-text changes))))
             (rest (assoc key (supergrip:verification-numbers
                               (verified (text-knowledge *good-rules* text))))))))
    (is (find 0.5d0 (searched :size :conditions "((DIST '(N1 N2)) > 0)")))
    (is (find 7777d0 (searched :size :conditions "((DIST '(N1 N2)) < 7777)")))
    (is (find 0.777d0 (searched :u :conditions "((u > 0.777) AND (u > 0) AND (u > -1))")))))

(test long-work-shows-how-far-it-is
  (let ((lines (with-output-to-string (out)
                 (let ((supergrip::*progress* (supergrip::terminal-progress out)))
                   (supergrip::note-progress "rules" 1 10)
                   (sleep 2.01)
                   (supergrip::note-progress "rules" 2 10)
                   (supergrip::note-progress nil 0 0)))))
    (is (equal (format nil "~crules, 2 of 10~c[K~c~c[K" #\Return (code-char 27) #\Return
                       (code-char 27))
               lines))))
