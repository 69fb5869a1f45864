;;;; report.lisp -- REPORT: one page about one plan, complete in itself; and an index of pages.

(in-package :supergrip-draw)

(defparameter +page-style+ (text-of-file "page.css") "What pages look like.")

(defmacro say (control &rest arguments)
  "Write text made by CONTROL and ARGUMENTS into the page, escaped."
  `(write-string (safe (format nil ,control ,@arguments)) *out*))

(defun units-words ()
  "Return the units of a page about a box in *UNITS*."
  (if *units*
      (format nil "Lengths in ~a, forces in ~a, torques in ~a." (unit-phrase :length)
              (unit-phrase :force) (or (unit-text-of :torque) "finger force × cm"))
      (format nil "Lengths in cm,~%forces in units of one finger’s greatest normal force, ~
                   torques in their product.")))

(defmacro with-page ((file title &optional (units '(units-words))) &body body)
  "Write an HTML page of TITLE, whose header and main parts BODY writes, to FILE; UNITS, a form,
says in which units.  Returns FILE."
  `(with-output-to (*out* ,file)
     (format *out* "<!DOCTYPE html>~%")
     (markup
       (:html :lang "en"
        (:head
         (:meta :charset "utf-8")
         (:meta :name "viewport" :content "width=device-width, initial-scale=1")
         (:title (cl-who:str (safe ,title)))
         (:style (cl-who:str +page-style+) (cl-who:str +style+)))
        (:body
         (:svg :width "0" :height "0" :style "position: absolute" :aria-hidden "true"
          (format *out* +patterns+))
         ,@body
         (:footer (:p "Box and contacts are to scale; fingers and palm are a diagram. "
                      (cl-who:str ,units))))))
     (terpri *out*)))

(defun put-figure (picture caption &optional class)
  "Write PICTURE with its CAPTION."
  (markup (:figure :class class
                   (write-picture picture *out* :inline t)
                   (when caption (markup (:figcaption (say "~a" caption)))))))

;;; Words

(defun page-title (plan)
  (let ((box (plan-box plan)))
    (if (box-name box) (box-text box) (format nil "A box, ~a" (box-text box)))))

(defun times-text (kind radius axis &optional together)
  "Return how much a grasp has of KIND, RADIUS times what is needed, AXIS being the limit, or all
axes TOGETHER."
  (format nil "~a: the grasp has ~a times what the task needs on ~:[the tightest axis, ~a~;all ~
               axes together~]."
          kind (index-text radius) together axis))

(defun fingers-words (subject)
  "Return which fingers are on which face."
  (let ((contacts (subject-contacts subject)))
    (list-text
     (loop for face in (remove-duplicates (mapcar #'contact-face contacts) :from-end t)
           for names = (loop for contact in contacts
                             when (= face (contact-face contact))
                               collect (contact-finger contact))
           collect (format nil "finger~p ~a on ~a" (length names) (list-text names)
                           (face-name face))))))

(defun verdict-words (plan)
  "Return the verdict of PLAN, a list of sentences."
  (let ((best (plan-best plan)))
    (if (null best)
        (list "It can’t be grasped." (format nil "~a." (string-right-trim "." (plan-reason plan))))
        (let ((subject (grasp-subject best plan))
              (next (second (plan-possible plan))))
          (remove nil
                  (list (format nil "Hold it with ~a: ~a, the palm over ~a."
                                (candidate-grasp best) (fingers-words subject)
                                (face-name (subject-palm subject)))
                        (format nil "The quality index is ~a~@[; the next best, ~a~]."
                                (index-text (candidate-quality best))
                                (and next (format nil "~a, has ~a" (candidate-grasp next)
                                                  (at-most-text next (candidate-quality next)))))
                        (and (demand-on best plan)
                             (with-minus (demand-text (demand-on best plan))))
                        (and (candidate-force-axis best)
                             (times-text "Forces" (candidate-force-radius best)
                                         (candidate-force-axis best)
                                         (eq (plan-index plan) :exact)))
                        (and (candidate-velocity-axis best)
                             (times-text "Velocities" (candidate-velocity-radius best)
                                         (candidate-velocity-axis best)))))))))

(defun weak-text (kind radius)
  "Return what a RADIUS below 1 of KIND means, or NIL for one that is not below."
  (and radius (< radius 1)
       (format nil "~a: ~a is below 1, so by the index, on its tightest axis, the grasp has less ~
                    than the task may need." kind (index-text radius))))

(defun together-text (plan)
  "Return what the best grasp of PLAN bears on all axes together, or NIL if no force is needed."
  (let* ((strength (find-strength (plan-best plan) plan))
         (radius (true-radius-text strength)))
    (cond ((null radius) nil)
          ((minusp (strength-upper strength))
           (format nil "Together: ~a for the contacts." radius))
          (t (format nil "Together, and in any direction, the contacts bear ~a times the forces ~
                          and torques asked for; they have the least to spare where the box is ~
                          ~a.~@[ Their strength on each axis alone already makes sure of ~a ~
                          times.~]"
                     radius (strength-worst strength) (sure-text strength))))))

(defun put-meaning (plan)
  "Write in plain words what the quality index of PLAN and its radii mean."
  (let ((best (plan-best plan)))
    (when best
      (markup
        (:p :class "soft"
            (say "The quality index Q compares the grasps of one task: higher is better.  It ~
                  is neither a percentage nor a probability, and says nothing across tasks.  A ~
                  radius of 1 is just enough, by the index, on the tightest axis alone.~@[  ~
                  ~a~]~@[  ~a~]~@[  ~a~]"
                 (and (eq (plan-index plan) :paper) ; else what follows says it
                      (weak-text "Forces" (candidate-force-radius best)))
                 (weak-text "Velocities" (candidate-velocity-radius best))
                 (together-text plan)))))))

;;; The box

(defun put-given (box gamma)
  "Write the table of what is known of BOX."
  (markup
    (:table
     (:caption "What was given")
     (:tbody
      (loop for (name value) in
            `(("Size along X, Y, Z" ,(size-text (box-size box)))
              ("Weight" ,(format nil "~a ~a" (quantity (in-units (box-weight box) :force) 4)
                                  (unit-phrase :force)))
              ,@(and (box-pose box)
                     `(("Down, in the box frame" ,(down-text box))))
              ,@(and (notevery #'zerop (box-centre box))
                     `(("Centre of mass" ,(with-unit (place-text (box-centre box)) :length))))
              ("Friction u" ,(quantity (box-friction box) 4))
              ("Soft finger v" ,(with-unit (quantity (in-units (box-soft-friction box) :length) 4)
                                   :length))
              ("Constrained faces" ,(if (box-constrained box)
                                        (list-text (box-constrained box))
                                        "none"))
              ,@(and (box-facts box) `(("Facts of its own" ,(list-text (fact-texts box)))))
              ("Selection parameter γ" ,(quantity gamma 4)))
            do (markup (:tr (:th :scope "row" (say "~a" name)) (:td (say "~a" value)))))))))

(defun needs-caption ()
  "Return the caption of the table of needs, of a box in *UNITS*."
  (if (absolute-units-p *units*)
      (format nil "What the task needs: forces in ~a, torques in ~a; velocities from 0 to 1"
              (unit-phrase :force) (unit-phrase :torque))
      "What the task needs, from 0 to 1"))

(defun put-needs (box)
  "Write the table of what the task of BOX needs."
  (markup
    (:table
     (:caption (say "~a" (needs-caption)))
     (:thead (:tr (:th :scope "col" "Axis") (:th :scope "col" "Force or torque")
                  (:th :scope "col" "Velocity or rotation")))
     (:tbody
      (loop for axis in +axis-names+
            for number from 0
            for force in (box-force-needed box)
            for velocity in (box-velocity-needed box)
            do (markup (:tr (:th :scope "row" (say "~a" axis))
                            (:td (say "~a" (quantity (in-units force (axis-measure number)) 4)))
                            (:td (say "~a" (quantity velocity 4))))))))))

;;; Pictures that fit a telephone

(defun put-key (signs)
  "Write what SIGNS mean (see +KEY+)."
  (markup
    (:ul :class "key"
         (loop for (sign wide text) in signs
               do (markup
                    (:li (when (plusp wide)
                           (format *out* "<svg class=\"sg\" width=\"~d\" height=\"20\" ~
                                          aria-hidden=\"true\">" (+ wide 6))
                           (let ((*obstacles* '()) (*strokes* '()))
                             (funcall sign (+ 3 (/ wide 2)) 10))
                           (format *out* "</svg> "))
                         (say "~a" text)))))))

(defun main-picture (subject title description)
  (with-picture (440 370 title description)
    (draw-main-view subject '(6 6 428 358))))

(defparameter +flat-room+ '(64 30 216 150) "Where a flat view of the page has box and hand.")

(defun flat-scale (subject)
  "Return the scale in which SUBJECT is seen whole from each of the three sides."
  (loop for (azimuth elevation) in +flat-views+
        minimize (view-scale (fit-view (flat-camera azimuth elevation) (subject-vectors subject)
                                       +flat-room+))))

(defun flat-picture (subject index)
  "Return SUBJECT seen from one of the three sides, all in one scale."
  (destructuring-bind (azimuth elevation words names) (nth index +flat-views+)
    (declare (ignore words))
    (let ((camera (flat-camera azimuth elevation)) (area '(2 2 296 196))
          (caption (flat-caption subject index)))
      (with-picture (300 200 (format nil "Seen ~a" caption)
                             (if (subject-palm subject) (fingers-text subject) "The box alone."))
        (draw-text caption '(10 20) :class "soft")
        (draw-axes camera '(20 176) names 20)
        (occupy '(2 140 56 58))
        (draw-subject subject (fit-view camera (subject-vectors subject) +flat-room+
                                         (flat-scale subject))
                      :small t)
        (place-labels area)))))

(defun put-hand (plan)
  "Write the pictures of the best grasp of PLAN, or of the box alone."
  (let* ((best (plan-best plan)) (load (weight-text (plan-box plan)))
         (subject (if best
                      (grasp-subject best plan :load load)
                      (box-subject (plan-box plan) :load load))))
    (markup
      (:div :class "hand"
            (:div :class "main"
                  (put-figure (main-picture subject (page-title plan)
                                            (if best
                                                (candidate-description best plan subject)
                                                (constrained-text (plan-box plan))))
                              nil)
                  (when best (markup (:p :class "soft" (say "~a" (fingers-text subject)))))
                  (put-key +key+))
            (dotimes (i 3) (put-figure (flat-picture subject i) nil))))))

(defun put-best (plan)
  "Write the pictures of the three best grasps of PLAN, and of what they have against what is
needed."
  (let* ((strengths (find-strengths plan 3))
         (candidates (mapcar #'strength-candidate strengths))
         (high (+ 18 (quality-height strengths 350)))
         (subjects (loop for candidate in candidates collect (grasp-subject candidate plan)))
         (camera (best-camera subjects))
         (scale (cell-scale camera subjects 366 364)))
    (markup
      (:h3 "How they hold it")
      (:div :class "row"
            (loop for candidate in candidates
                  for subject in subjects
                  for place from 1
                  do (put-figure
                      (with-picture (366 372 (candidate-title candidate)
                                             (candidate-description candidate plan subject))
                        (draw-session-cell candidate subject place camera scale 0 4 366 364))
                      nil)))
      (:h3 "What they have, against what the task needs")
      (:div :class "row"
            (loop for strength in strengths
                  for candidate in candidates
                  for place from 1
                  do (put-figure
                      (with-picture (374 high (candidate-title candidate)
                                         (quality-words strength plan))
                        (draw-candidate-quality strength strengths plan place 12 12 350))
                      nil)))
      (put-key +quality-key+))))

;;; Candidates

(defun candidate-words (candidate plan)
  "Return what became of CANDIDATE."
  (multiple-value-bind (step sentence) (candidate-failure candidate plan)
    (let ((force (candidate-force-radius candidate))
          (velocity (candidate-velocity-radius candidate)))
      (if step
          (format nil "~(~a~): ~a" step sentence)
          (format nil "~@[forces ~a~]~:[~;, ~]~@[velocities ~a~]"
                  (and force (radius-words (at-most-text candidate force)
                                           (candidate-force-axis candidate)))
                  (and force velocity)
                  (and velocity (radius-words (index-text velocity)
                                              (candidate-velocity-axis candidate))))))))

(defun radius-words (radius axis)
  (format nil "~a, limited ~a" radius axis))

(defun put-candidates (plan)
  "Write the table of all candidates of PLAN, the possible ones first, the best on top."
  (markup
    (:table :class "candidates"
     (:caption (say "~d tried, ~d possible. A candidate is a grasp in one matching; faces in the ~
                     order N1 N2 O1 O2 A1 A2." (length (plan-candidates plan))
                    (length (plan-possible plan))))
     (:thead (:tr (:th :scope "col" "Grasp and matching") (:th :scope "col" "Q")
                  (:th :scope "col" "Radii and limits, or the step failed and why")))
     (:tbody
      (dolist (candidate (append (plan-possible plan) (plan-rejected plan)))
        (markup
          (:tr :class (and (eq candidate (plan-best plan)) "best")
               (:th :scope "row" (say "~a" (candidate-grasp candidate))
                    (:span :class "face" (say "~{~a~^ ~}" (candidate-matching candidate))))
               (:td :class "number"
                    (say "~:[not possible~;~:*~a~]" (and (candidate-quality candidate)
                                                               (at-most-text
                                                                candidate
                                                                (candidate-quality candidate)))))
               (:td (say "~a" (candidate-words candidate plan))))))))))

;;; Facts and rules

(defun rulebase-of (plan) (knowledge-rulebase (plan-knowledge plan)))

(defun fact-id (predicate face-list)
  "Return the id of a fact in the page."
  (format nil "fact-~d-~d" (supergrip-chainer:predicate-index predicate)
          (supergrip-chainer:face-list-mask face-list)))

(defun fact-text (predicate face-list)
  (format nil "~a~@[ (~{~a~^ ~})~]" (supergrip-chainer:predicate-text predicate)
          (supergrip-chainer:face-list-names face-list)))

(defun rule-id (rule)
  (format nil "rule-~d" (supergrip-chainer:rule-index rule)))

(defun remembered-facts (plan)
  "Return the facts that rules of PLAN remembered, in order: lists of event, predicate and faces."
  (loop for event in (plan-events plan)
        collect (cons event (multiple-value-list
                             (supergrip-chainer:event-fact event (rulebase-of plan))))))

(defun given-facts (plan)
  "Return the facts that were there before any rule of PLAN ran: lists of predicate and faces."
  (let ((made (mapcar (lambda (fact) (apply #'fact-id (rest fact))) (remembered-facts plan)))
        (memory (plan-memory plan)))
    (loop for predicate across (supergrip-chainer:rulebase-predicates (rulebase-of plan))
          append (loop for face-list in (supergrip-chainer:facts memory predicate)
                       unless (member (fact-id predicate face-list) made :test #'string=)
                         collect (list predicate face-list)))))

(defun put-antecedents (event plan)
  "Write, for EVENT, what made its rule fire, each fact a link to where it comes from."
  (let ((rule (supergrip-chainer:event-rule event (rulebase-of plan)))
        (binding (supergrip-chainer:event-binding event)))
    (loop for clause in (supergrip-chainer:rule-clauses rule)
          for first = t then nil
          for predicate = (supergrip-chainer:clause-predicate clause)
          for face-list = (supergrip-chainer:instantiate (supergrip-chainer:clause-terms clause)
                                                      binding)
          do (say "~:[, ~;~]" first)
             (if (supergrip-chainer:clause-negated clause)
                 (say "not ~a" (fact-text predicate face-list))
                 (markup (:a :href (format nil "#~a" (fact-id predicate face-list))
                             (say "~a" (fact-text predicate face-list))))))))

(defun put-facts (plan)
  "Write what was known at first, and what each rule added, with its reasons."
  (markup
    (:h3 "Known before any rule ran")
    (:ul :class "facts"
         (loop for (predicate face-list) in (given-facts plan)
               do (markup (:li :id (fact-id predicate face-list)
                               (say "~a" (fact-text predicate face-list))))))
    (:h3 "What the rules added, in order")
    (if (remembered-facts plan)
        (markup
          (:ol :class "facts"
               (loop for (event predicate face-list) in (remembered-facts plan)
                     for rule = (supergrip-chainer:event-rule event (rulebase-of plan))
                     do (markup (:li :id (fact-id predicate face-list)
                                     (:strong (say "~a" (fact-text predicate face-list)))
                                     (:br)
                                     "by "
                                     (:a :href (format nil "#~a" (rule-id rule))
                                         (say "~a" (supergrip-chainer:rule-name rule)))
                                     ", since "
                                     (put-antecedents event plan))))))
        (markup (:p "Nothing.")))
    (put-stop plan)))

(defun put-stop (plan)
  "Write which rule ended the run."
  (let ((stop (plan-stop plan)))
    (when stop
      (let ((rule (supergrip-chainer:stop-rule stop)))
        (markup (:p "The run was ended by "
                    (:a :href (format nil "#~a" (rule-id rule))
                        (say "~a" (supergrip-chainer:rule-name rule)))
                    (say ": ~:[the best was kept~;~:*CANT ~{~a~^ ~}~]."
                         (supergrip-chainer:stop-words stop))))))))

(defun rule-lines (rule)
  "Return the text of RULE, a clause or an action a line."
  (destructuring-bind (name conditions actions) (rest (supergrip-chainer:rule-form rule))
    (flet ((text (form) (form-text form nil)))
      (format nil "(RULE ~a~%  (IF ~{~a~^~%      ~})~%  (THEN ~{~a~^~%        ~}))" (text name)
              (mapcar #'text (rest conditions)) (mapcar #'text (rest actions))))))

(defun put-rules (plan)
  "Write the rules, each as it stands in its file."
  (loop for rule in (knowledge-rules (plan-knowledge plan))
        do (markup (:pre :id (rule-id rule) (say "~a" (rule-lines rule))))))

;;; The page

(defun put-changes (plan)
  "Write which single need, friction or weight would have to change for the choice to change."
  (let ((changes (choice-changes (explain-choice plan))))
    (if changes
        (markup (:ul (loop for change in (subseq changes 0 (min 5 (length changes)))
                           do (markup (:li (say "~{If ~a were ~a, not ~a: ~a.~}"
                                                (change-words change)))))))
        (markup (:p "No single need, friction or weight would.")))))

(defun report (plan file)
  "Write a page about PLAN to FILE, HTML complete in itself: the box, the verdict in words,
pictures, what would change the choice, all candidates with the reasons of those that failed, and
what the rules found, each fact linked to the rule and to the facts that made it.  Needs
no network and no script.  Returns FILE."
  (drawing ((need-plan plan)) (write-page plan file)))

(defun write-page (plan file)
  (with-page (file (format nil "SUPER-GRIP: ~a" (page-title plan)))
    (:header
     (:h1 (say "~a" (page-title plan)))
     (:p :class "verdict" (say "~{~a~^ ~}" (verdict-words plan)))
     (put-meaning plan))
    (:main
     (:h2 (say "~:[The box~;The grasp~]" (plan-best plan)))
     (put-hand plan)
     (:h2 "Box and task")
     (:div :class "pair"
           (put-given (plan-box plan) (plan-gamma plan))
           (put-needs (plan-box plan)))
     (when (plan-possible plan)
       (markup (:h2 "The best few")
               (put-best plan)))
     (:h2 "What would change the choice")
     (put-changes plan)
     (:h2 "All candidates")
     (if (plan-candidates plan)
         (put-candidates plan)
         (markup (:p "No grasp was tried.")))
     (:h2 "Facts")
     (put-facts plan)
     (:h2 "Rules")
     (put-rules plan))))

;;; The index

(defun slug (plan number)
  "Return the name of the file of PLAN, the NUMBERth, without folder."
  (let* ((name (or (box-name (plan-box plan)) "box"))
         (letters (map 'string (lambda (char)
                                 (if (and (< (char-code char) 128) (alphanumericp char))
                                     (char-downcase char)
                                     #\-))
                       (subseq name 0 (min 40 (length name))))))
    (format nil "~4,'0d-~a.html" number letters)))

(defun thumbnail (plan)
  "Return a small picture of PLAN without words."
  (drawing ((need-plan plan))
    (let* ((best (plan-best plan))
           (subject (if best (grasp-subject best plan) (box-subject (plan-box plan))))
           (camera (best-camera (list subject))))
      (with-picture (260 200 (page-title plan)
                             (if best
                                 (candidate-description best plan subject)
                                 (plan-reason plan)))
        (draw-subject subject (fit-view camera (subject-vectors subject) '(14 14 232 172))
                      :small t)
        (place-labels '(2 2 256 196))))))

(defun verdict-text (plan)
  (if (plan-best plan)
      (candidate-title (plan-best plan))
      "can’t be grasped"))

(defun put-card (plan number problem)
  "Write what the index says of PLAN, the NUMBERth; PROBLEM says why it has no page, or is NIL."
  (markup
    (:li (if problem
             (markup (:p (:strong (say "~a" (page-title plan))) (:br)
                         (say "~a" (verdict-text plan)) (:br)
                         (say "No page: ~a." problem)))
             (markup (:a :href (slug plan number)
                         (write-picture (thumbnail plan) *out* :inline t)
                         (:strong (say "~a" (page-title plan)))
                         (:br)
                         (say "~a" (verdict-text plan))))))))

(defun page-problem (plan file)
  "Write the page of PLAN to FILE, if that is not NIL.  Return NIL, or why it can't be drawn."
  (handler-case (progn (thumbnail plan)
                       (when file (report plan file))
                       nil)
    (drawing-error (condition) (princ-to-string condition))))

(defun report-index (plans directory &key (pages t))
  "Write index.html into DIRECTORY: a thumbnail and the verdict of each of PLANS, in their order,
each linked to its page; and, unless PAGES is NIL, these pages, too.  Where a page can't be drawn,
the index says why.  Returns the index's name, and the number of pages that can't be drawn."
  (let* ((directory (native-path directory :directory t))
         (plans (mapcar #'need-plan (if (listp plans) plans (list plans))))
         (problems (loop for plan in plans
                         for number from 1
                         collect (page-problem plan (and pages (merge-pathnames
                                                                (slug plan number) directory)))))
         (lost (count-if #'identity problems)))
    (values
     (with-page ((merge-pathnames "index.html" directory) "SUPER-GRIP: all boxes"
                 (if (some (lambda (plan) (%box-units (plan-box plan))) plans)
                     "Each box in its own units."
                     (units-words)))
       (:header
        (:h1 "All boxes")
        (:p :class "verdict"
            (say "~d box~:*~[es~;~:;es~], ~d can be grasped~[~:;; ~:*~d page~:p can’t be drawn~]."
                 (length plans) (count :grasp plans :key #'plan-verdict) lost)))
       (:main
        (:ul :class "cards"
             (loop for plan in plans
                   for problem in problems
                   for number from 1
                   do (put-card plan number problem)))))
     lost)))
