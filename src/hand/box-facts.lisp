;;;; box-facts.lisp -- facts of one's own: what a box says beyond its other keys.
;;;;
;;;; The rules declare them by (INPUT ...).  A box is read without rules, so it is a plan that
;;;; checks whether the facts of its box are declared.

(in-package :supergrip)

(defstruct (box-fact (:constructor make-box-fact (words face-list spot)))
  "A fact of a box: its WORDS, one string; its FACE-LIST; and the SPOT in the description."
  (words "" :type string) (face-list 0 :type face-list) spot)

(defun box-facts (box)
  "Return the FACTS that BOX states, a new list in the shape of FACTS, with strings for names:
((\"FRAGILE\" (\"Z1\")) (\"WET\"))."
  (shown-value :facts (%box-facts box)))

(defmethod shown-value ((type (eql :facts)) facts)
  (loop for fact in facts collect (fact-list fact #'identity)))

(defun fact-list (fact name)
  "Return FACT as a description has it; NAME, a function, makes a name of a string."
  (append (loop for word in (uiop:split-string (box-fact-words fact)) collect (funcall name word))
          (and (plusp (box-fact-face-list fact))
               (list (mapcar name (face-list-names (box-fact-face-list fact)))))))

;;; Reading

(defun words-in (element)
  "Return the words, names, that ELEMENT of a fact is: a name, or a string that holds some."
  (cond ((namep element) (list element))
        ((stringp element)
         (handler-case (let ((words (read-all (string-source element))))
                         (and (every #'namep words) words))
           (syntax-error () '())))))

(defun refuse-fact (row number fact control &rest arguments)
  (complain (value-spot row number) "~a is not a fact: ~a" (value-text *notation* fact)
            (apply #'format nil control arguments)))

(defun parse-box-fact (form row number)
  "Return the box fact that FORM, the value NUMBER of the key ROW, spells; or complain."
  (let* ((elements (and (consp form) form))
         (list (let ((last (first (last elements)))) (and (consp last) last)))
         (words (mapcar #'words-in (if list (butlast elements) elements)))
         (names (loop for part in words append part)))
    (cond ((or (null words) (member '() words))
           (refuse-fact row number form "~a takes ~a" (key-name *notation* row)
                        (key-takes row)))
          ((find-if #'loose-surface-p names)
           (refuse-fact row number form "its faces belong in a list of their own, at the end: ~a"
                        (value-text *notation* (list-surfaces names list))))
          ((some #'negation-p names)
           (refuse-fact row number form "a fact can't be negated; leave it out, since what a box ~
                                       does not say is false"))
          (t
           (let ((face-list (parse-faces list row "occurs twice in one list of faces" number
                                         (length words))))
             (and face-list
                  (make-box-fact (format nil "~{~a~^ ~}" (mapcar #'symbol-name names)) face-list
                                 (value-spot row number))))))))

(defmethod parse-values ((type (eql :facts)) row values)
  (let ((said (make-hash-table :test #'equal)))
    (loop for form in values
          for number from 0
          for fact = (parse-box-fact form row number)
          for key = (and fact (format nil "~a ~d" (box-fact-words fact)
                                      (face-list-mask (box-fact-face-list fact))))
          if (and key (gethash key said))
            do (complain (value-spot row number) "the fact ~a is given twice"
                         (value-text *notation* form))
          else if key
            collect fact and do (setf (gethash key said) t))))

;;; In a plan

(defun fact-predicate (fact rulebase)
  "Return the predicate of FACT if RULEBASE declares it, with lists of as many faces; or NIL."
  (let ((predicate (find-predicate rulebase (list (box-fact-words fact)))))
    (and predicate (declared-p predicate)
         (= (predicate-arity predicate) (face-list-count (box-fact-face-list fact)))
         predicate)))

(defun assert-facts (memory box rulebase rules)
  "Put into MEMORY, one for RULEBASE, the facts of BOX, in the order of their faces: how the box
spells them does not matter.  Signals a BOX-ERROR that holds all that are not declared; RULES is the
name of the file to declare them in."
  (let ((facts (loop for fact in (%box-facts box)
                     collect (cons (fact-predicate fact rulebase)
                                   (make-face-list
                                    (sort (face-list-elements (box-fact-face-list fact)) #'<))))))
    (when (find nil facts :key #'car)
      (refuse-box (fact-problems box rulebase rules) nil (%box-line box)))
    (loop for (predicate . face-list)
            in (sort facts #'< :key (lambda (fact) (face-order (cdr fact))))
          do (put-fact memory predicate face-list))))

(defun face-order (face-list)
  "Return a number by which face lists of one length are ordered by their faces."
  (loop with number = 0
        for face in (face-list-elements face-list) do (setf number (+ (* 8 number) face))
        finally (return number)))

(defun fact-problems (box rulebase rules)
  "Return the problems of the facts of BOX that RULEBASE, of the file RULES, does not declare."
  (let ((*file* nil) (*lines* nil) (*subject* "BOX") (*place* nil))
    (nth-value 1 (with-problems
                   (dolist (fact (%box-facts box))
                     (unless (fact-predicate fact rulebase)
                       (refuse-undeclared fact rulebase rules
                                          (and (eq *notation* :lisp) (null (%box-line box))))))))))

(defun refuse-undeclared (fact rulebase rules typed)
  "Complain of FACT, which RULEBASE, of the file RULES, does not declare, and which was TYPED or
read."
  (let* ((words (cut-text (box-fact-words fact)))
         (count (face-list-count (box-fact-face-list fact)))
         (text (value-text *notation* (fact-list fact #'canonical-name)))
         (predicate (find-predicate rulebase (list (box-fact-words fact))))
         (spot (box-fact-spot fact)))
    (cond ((or (null predicate) (null (predicate-given predicate)))
           (complain spot "~a: no INPUT declares ~a~a; to allow it, add ~a to ~a~@[, or type ~
                           (edit '~a)~]"
                     text words
                     (suggestion words (map 'list #'predicate-text
                                            (remove-if-not #'declared-p
                                                           (rulebase-predicates rulebase))))
                     (input-line words count) rules
                     (and typed (input-line words count))))
          ((declared-p predicate)
           (complain spot "~a: ~a takes ~[no faces~;1 face~:;~:*~d faces~], not ~[none~:;~:*~d~]; ~
                           ~a declares it so in ~a"
                     text words (predicate-arity predicate) count
                     (form-text (input-declaration-form (predicate-given predicate))) rules))
          (t
           (complain spot "~a: ~a can't be stated as a fact: it follows from the box's other ~
                           keys and the gripper" text words)))))
