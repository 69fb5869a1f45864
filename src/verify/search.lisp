;;;; search.lisp -- what grasps can do that rules don't know: looked for in many boxes of each
;;;; situation.
;;;;
;;;; What a grasp can do depends on sizes and friction, not only on what rules see.  So this proves
;;;; nothing: it tries every grasp in every matching, at sizes on both sides of each threshold and
;;;; between them, and at several frictions.

(in-package :supergrip)

(defparameter *search-limit* 250000 "The most boxes that are searched; of more, so many are drawn.")

(defparameter +frictions+ '(0.05d0 0.3d0 0.6d0 1.05d0 1.5d0 2.5d0)
  "The frictions that are searched, besides those on both sides of each threshold.")

;;; Which sizes and frictions

(defun compared-number (node other thing)
  "Return the number that NODE is compared with by a condition of a grasp, if NODE is what THING
says, a function, and OTHER a constant; or NIL."
  (and (funcall thing node) (constant-p other) (constant-value other)))

(defun grasp-thresholds (knowledge thing)
  "Return the numbers above 0 with which the conditions of the grasps of KNOWLEDGE compare what
THING, a function, is true of."
  (remove-duplicates
   (loop for grasp in (knowledge-grasps knowledge)
         append (loop for (node) in (grasp-comparisons grasp)
                      for (a b) = (comparison-nodes node)
                      for number = (or (compared-number a b thing) (compared-number b a thing))
                      when (and number (plusp number)) collect number))))

(defun friction-node-p (node)
  (eql (input-of node) +u+))

(defun quantity-thresholds (quantity knowledge)
  "Return the thresholds of QUANTITY that the grasps of KNOWLEDGE have."
  (case (box-key-key (quantity-row quantity))
    (:size (grasp-thresholds knowledge #'distance-axis))
    (:u (grasp-thresholds knowledge #'friction-node-p))))

(defun class-numbers (class plain thresholds extra)
  "Return the numbers of CLASS, an interval, that are searched: PLAIN, if it is in it; those near
its ends, on both sides of THRESHOLDS and between; and EXTRA ones."
  (let ((parts (cut (car class) (cdr class)
                    (loop for number in thresholds
                          for (below at above) = (neighbours number)
                          when (and (<= (car class) below) (<= above (cdr class)))
                            append (list (cons below at) (cons at above))))))
    (remove-duplicates
     (append (loop for part in parts
                   collect (class-number part plain)
                   append (edge-numbers part))
             (remove-if-not (lambda (number) (<= (car class) number (cdr class))) extra)))))

(defun searched-numbers (quantity class knowledge)
  "Return the numbers of QUANTITY in CLASS that are searched."
  (if class
      (class-numbers class (quantity-value quantity (plain-values))
                     (quantity-thresholds quantity knowledge)
                     (and (eq (box-key-key (quantity-row quantity)) :u) +frictions+))
      '(nil)))

(defun searched-quantities (domain)
  "Return the quantities of DOMAIN that are varied in a search: sizes, friction, and what rules
see."
  (remove-if-not (lambda (quantity)
                   (or (member (box-key-key (quantity-row quantity)) '(:size :u))
                       (member quantity (domain-digits domain))))
                 (domain-quantities domain)))

;;; The boxes of a situation

(defun choices (domain situation knowledge)
  "Return a list of (QUANTITY . NUMBERS): what is varied within SITUATION of DOMAIN."
  (loop for quantity in (searched-quantities domain)
        collect (cons quantity (searched-numbers quantity
                                                 (index-class domain (situation-index situation)
                                                              quantity)
                                                 knowledge))))

(defun all-searched (domain knowledge)
  "Return an alist from the keys of the quantities that are varied to all their numbers, in order."
  (let ((numbers '()))
    (dolist (quantity (searched-quantities domain) (reverse numbers))
      (let* ((key (box-key-key (quantity-row quantity)))
             (entry (or (assoc key numbers) (first (push (list key) numbers)))))
        (dolist (class (quantity-classes quantity))
          (setf (rest entry)
                (sort (remove-duplicates
                       (append (rest entry)
                               (remove nil (searched-numbers quantity class knowledge))))
                      #'<)))))))

(defun count-choices (choices)
  (reduce #'* choices :key (lambda (choice) (length (rest choice)))))

(defun chosen-box (choices values index)
  "Return the box that differs from VALUES as CHOICES say: of their combinations the one that
INDEX, a number below COUNT-CHOICES, stands for; 0 is that of the first of each."
  (loop for (quantity . numbers) in choices
        for count = (length numbers)
        for number = (nth (mod index count) numbers)
        do (setf index (floor index count))
           (when number
             (setf values (values-with values quantity number))))
  (make-box values nil))

(defun call-with-boxes (choices values count function)
  "Call FUNCTION with the boxes that differ from VALUES as CHOICES say: with all, or with COUNT
that are drawn if there are more; the first is always among them."
  (let ((all (count-choices choices)))
    (if (<= all count)
        (dotimes (index all)
          (funcall function (chosen-box choices values index)))
        (loop with state = (seeded-state *situation-seed*)
              repeat count
              for index = 0 then (random all state)
              do (funcall function (chosen-box choices values index))))))

;;; What is found

(defstruct (hunt (:constructor make-hunt (knowledge memory gamma)))
  "A search: MEMORY is one to try grasps in, BOXES how many boxes were searched, FOUND a table
from what findings are about to findings, LAST one from findings to the situation that they
counted last."
  knowledge memory gamma (boxes 0)
  (found (make-hash-table :test #'equal)) (last (make-hash-table :test #'eq)))

(defun note-found (hunt kind rule grasp situation box &key other loss (boxes 1))
  "Note that in BOX of SITUATION there is what KIND says about RULE and GRASP, names, and OTHER.
LOSS is by how much it is worse, if that can be said; BOXES how many boxes show it."
  (let* ((key (list kind rule grasp other))
         (finding (or (gethash key (hunt-found hunt))
                      (setf (gethash key (hunt-found hunt))
                            (make-finding :kind kind :rule rule :grasp grasp :other other
                                          :boxes 0 :witness box)))))
    (incf (finding-boxes finding) boxes)
    (when (plainer-p box (finding-witness finding))
      (setf (finding-witness finding) box))
    (when (and loss (> loss (getf (finding-more finding) :loss 0)))
      (setf (getf (finding-more finding) :loss) loss
            (getf (finding-more finding) :worst) box))
    (unless (eq situation (gethash finding (hunt-last hunt)))
      (setf (gethash finding (hunt-last hunt)) situation)
      (incf (finding-situations finding) (situation-weight situation)))))

(defun try-everything (hunt box)
  "Return the possible candidates of all grasps of HUNT in all matchings on BOX."
  (let* ((memory (hunt-memory hunt)) (knowledge (hunt-knowledge hunt)))
    (clear-memory memory (knowledge-rulebase knowledge))
    (start-workspace (memory-client memory) box (hunt-gamma hunt))
    (dolist (grasp (graspbase-grasps (knowledge-graspbase knowledge)))
      (try-matchings memory grasp +all-matchings+))
    (remove-if-not #'possible-p (memory-log memory))))

(defun better-candidate (a b)
  "Return the one of the candidates A and B, or NIL, with the higher quality."
  (if (and a (or (null b) (> (%candidate-quality a) (%candidate-quality b)))) a b))

(defun suggested-p (candidate tried)
  "True if the rules suggest CANDIDATE, or an equivalent one: TRIED is that of their answer."
  (logbitp (matching-index (%candidate-matching candidate))
           (aref tried (grasp-index (%candidate-grasp candidate)))))

(defun judge-box (hunt situation box possible)
  "Note what is wrong with what the rules answer in SITUATION for BOX, where POSSIBLE is all that is
possible."
  (let* ((answer (situation-answer situation))
         (tried (answer-tried answer))
         (best (reduce #'better-candidate possible :initial-value nil))
         (suggested (remove-if-not (lambda (candidate) (suggested-p candidate tried)) possible))
         (chosen (reduce #'better-candidate suggested :initial-value nil)))
    (flet ((note (kind rule &rest more)
             (apply #'note-found hunt kind rule (candidate-grasp best) situation box more)))
      (cond ((null best))
            ((answer-cant answer)
             (note :refused (rule-name (stop-rule (situation-stop situation)))))
            ((silent-p situation) (note :nothing-suggested nil))
            ((null chosen) (note :all-fail nil))
            ((> (%candidate-quality best) (+ (%candidate-quality chosen) +tie+))
             (note :worse nil :other (candidate-grasp chosen)
                              :loss (- (%candidate-quality best) (%candidate-quality chosen))))))))

(defun hunt-in (hunt situation choices count)
  "Search the boxes of SITUATION that CHOICES give, COUNT at most."
  (let* ((grasps (length (answer-tried (situation-answer situation))))
         (ever (make-array grasps :initial-element 0))
         (first nil) (before (hunt-boxes hunt)))
    (call-with-boxes
     choices (box-values-of (situation-box situation)) count
     (lambda (box)
       (let ((possible (try-everything hunt box)))
         (unless first (setf first box))
         (incf (hunt-boxes hunt))
         (dolist (candidate possible)
           (let ((grasp (%candidate-grasp candidate)))
             (setf (svref ever (grasp-index grasp))
                   (logior (svref ever (grasp-index grasp))
                           (aref (grasp-same grasp)
                                 (matching-index (%candidate-matching candidate)))))))
         (judge-box hunt situation box possible))))
    (unless (answer-cant (situation-answer situation))
      (note-vain hunt situation ever first (- (hunt-boxes hunt) before)))))

(defun note-vain (hunt situation ever box boxes)
  "Note which rules suggest in SITUATION only what was possible in none of its BOXES boxes, BOX
the first: EVER holds what was possible, a set of matchings for each grasp."
  (let ((suggested (make-hash-table :test #'equal)))
    (loop for (rule action . set) in (situation-done situation)
          for grasp = (action-target action)
          for key = (and grasp (list (rule-name rule) (grasp-name grasp)))
          unless (or (null grasp) (zerop set))
            do (setf (gethash key suggested)
                     (or (gethash key suggested)
                         (logtest set (svref ever (grasp-index grasp))))))
    (loop for (rule grasp) being the hash-keys of suggested using (hash-value ever-p)
          do (unless ever-p
               (note-found hunt :vain rule grasp situation box :boxes boxes)))))

(defun search-grasps (knowledge domain situations gamma)
  "Search boxes of each of SITUATIONS of DOMAIN, and return the findings, how many boxes were
searched, and how many there would be."
  (let* ((hunt (make-hunt knowledge (new-memory knowledge) gamma))
         (choices (loop for situation in situations
                        collect (choices domain situation knowledge)))
         (total (reduce #'+ choices :key #'count-choices)))
    (loop for situation in situations
          for some in choices
          for number from 1
          for all = (count-choices some)
          do (note-progress "situations searched" number (length situations))
             (hunt-in hunt situation some
                      (if (<= total *search-limit*) all (ceiling (* all *search-limit*) total))))
    (values (loop for finding being the hash-values of (hunt-found hunt) collect finding)
            (hunt-boxes hunt) total)))
