;;;; record.lisp -- the record of one box: a plist, written as one line of Lisp or of JSON.

(in-package :supergrip)

(defun contacts-and-sure (candidate plan)
  "Return what CANDIDATE-CONTACTS and CANDIDATE-SURE do of CANDIDATE, which is possible in PLAN: it
is taken through the steps again once for both."
  (with-replay (workspace candidate plan)
    (values (contacts-of candidate workspace) (sure-of candidate workspace))))

(defun plan-record (plan &key line all refine)
  "Return the record of PLAN, a plist of strings, numbers, lists and NIL:

:NAME  :LINE  the box's name, and LINE, where its description begins.
:STATUS  \"grasp\" or \"cant\".
:GRASP :MATCHING :QUALITY  of the best grasp, the faces for N1 N2 O1 O2 A1 A2.
:U-W :U-T  the radii of forces and velocities; NIL where the task needs none.
:LIMITING  (:FORCE axis :VELOCITY axis), as \"about Y\".
:OFFSET  the grasp centre from the box centre, along X Y Z.
:APPROACH  a unit vector in the box frame, from the palm to the box.
:CONTACTS  as CANDIDATE-CONTACTS has them: (:SURFACE face :POSITION p :NORMAL n :FINGER name) each.
:TRIED :POSSIBLE  how many candidates were tried, and how many of them are possible.
:REASON  why the box can't be grasped.
:SURE  the sure radius of the best grasp, CANDIDATE-SURE; NIL where the task needs no force.
:HAND  where the hand of the best grasp is: (:POSITION p :ORIENTATION quaternion :OPENING length
  :CLOSING unit vector), as CANDIDATE-HAND has it.
In exact mode also, of the best grasp (see src/plan/exact.lisp):
:BETA  (LOWER UPPER), the exact radius, LOWER certified or NIL; NIL where the task needs no force.
:SQUEEZE :FRICTION-MARGIN  CANDIDATE-SQUEEZE, CANDIDATE-FRICTION-MARGIN.
:FITS  if needs are absolute: CANDIDATE-FITS of the best grasp, T, :FALSE or NIL.
:WORLD  if the box has a POSE: :HAND in the world, see CANDIDATE-WORLD.
:ALTERNATIVES  if ALL, a number, is given: at most ALL of the possible grasps, see ALTERNATIVES.
:REFINED  if REFINE: what moving the fingers of the best grasps gives, see REFINED-PART.
:DATA  if the box has DATA: these.

Lengths are in cm, forces in finger forces: see RECORD-IN-UNITS."
  (let ((best (plan-best plan))
        (candidates (plan-candidates plan)))
    (multiple-value-bind (contacts sure) (and best (contacts-and-sure best plan))
      (list* :name (box-name (plan-box plan))
             :line line
             :status (if best "grasp" "cant")
             (append (grasp-part best contacts)
                     (list :tried (length candidates)
                           :possible (count-if #'possible-p candidates)
                           :reason (plan-reason plan))
                     (further-part best contacts sure plan)
                     (and all (list :alternatives (alternatives plan all)))
                     (and refine (list :refined (refined-part plan)))
                     (carried-part (getf (%box-others (plan-box plan)) :data)))))))

(defun carried-part (carried)
  "Return the part of a record that has CARRIED, what a box carries along; NIL for nothing."
  (and carried (list :data carried)))

(defun alternatives (plan most)
  "Return at most MOST of the possible grasps of PLAN, the best first: of each, a plist, what a
record tells of the best, from :GRASP to :CONTACTS and from :SURE on."
  (loop for candidate in (best-grasps plan most)
        collect (multiple-value-bind (contacts sure) (contacts-and-sure candidate plan)
                  (append (grasp-part candidate contacts)
                          (further-part candidate contacts sure plan)))))

(defun refined-part (plan)
  "Return what REFINE makes of PLAN, a plist, NIL without a grasp: :GRASP and :MATCHING; :QUALITY,
exact and certified, :QUALITY-BEFORE, the same before the fingers moved, and :QUALITY-BOUND, which
no legal places exceed; :BETA, the exact radius, (LOWER UPPER); :CONTACTS, :HAND and :WORLD, as in a
record, after the move."
  (let ((refinement (refine plan)))
    (when refinement
      (let* ((candidate (refinement-candidate refinement))
             (contacts (refinement-contacts refinement))
             (hand (moved-hand (contacts-hand candidate contacts (plan-box plan))
                               (refinement-shift refinement))))
        (list* :grasp (candidate-grasp candidate)
               :matching (candidate-matching candidate)
               :quality (refinement-quality refinement)
               :quality-before (refinement-quality-before refinement)
               :quality-bound (refinement-quality-bound refinement)
               :beta (refinement-radius refinement)
               :contacts contacts
               :hand hand
               (world-part hand (%box-pose (plan-box plan))))))))

(defun moved-hand (hand shift)
  "Return HAND, as CANDIDATE-HAND has it, SHIFT, along X Y Z, farther."
  (list* :position (mapcar #'+ (getf hand :position) shift)
         (loop for (key value) on hand by #'cddr
               unless (eq key :position) collect key and collect value)))

(defun further-part (best contacts sure plan)
  "Return the part of a record that tells more of the grasp BEST, with CONTACTS and the radius SURE,
of PLAN, or of none."
  (let ((hand (and best (contacts-hand best contacts (plan-box plan)))))
    (append (list :sure sure
                  :hand hand)
            (index-part (plan-index plan) best plan)
            (and (absolute-units-p (%box-units (plan-box plan)))
                 (list :fits (and best (candidate-fits best plan))))
            (world-part hand (%box-pose (plan-box plan))))))

(defun world-part (hand pose)
  "Return the part of a record that tells where HAND, or none, is in the world, if its box has a
POSE."
  (and pose (list :world (and hand (hand-in-world hand pose)))))

(defgeneric index-part (index best plan)
  (:documentation "Return the part of a record that only INDEX, a keyword, has; of the grasp BEST of
PLAN, or of none.")
  (:method (index best plan)
    (declare (ignore index best plan))
    '()))

(defmethod index-part ((index (eql :exact)) best plan)
  (list :beta (and best
                   (multiple-value-bind (upper lower) (candidate-exact-radius best plan)
                     (and upper (list lower upper))))
        :squeeze (and best (candidate-squeeze best plan))
        :friction-margin (and best (candidate-friction-margin best plan))))

(defun grasp-part (best contacts)
  "Return the part of a record that tells of the grasp BEST with CONTACTS, or of none."
  (if (null best)
      (list :grasp nil :matching nil :quality nil :u-w nil :u-t nil :limiting nil :offset nil
            :approach nil :contacts nil)
      (list :grasp (candidate-grasp best)
            :matching (candidate-matching best)
            :quality (candidate-quality best)
            :u-w (candidate-force-radius best)
            :u-t (candidate-velocity-radius best)
            :limiting (list :force (candidate-force-axis best)
                            :velocity (candidate-velocity-axis best))
            :offset (candidate-offset best)
            :approach (candidate-approach best)
            :contacts contacts)))

(defun error-record (problems &key name line (index :paper) all refine carried)
  "Return the record of a box that can't be used because of PROBLEMS: as PLAN-RECORD gives it, with
:STATUS \"error\", the problems in one :REASON, and each in :PROBLEMS as (:LINE l :COLUMN c
:TEXT t).  CARRIED is what the box carries along, or NIL."
  (list* :name name
         :line line
         :status "error"
         (append (grasp-part nil nil)
                 (list :tried 0
                       :possible 0
                       :reason (problems-reason problems)
                       :problems (loop for problem in problems
                                       collect (list :line (problem-line problem)
                                                     :column (problem-column problem)
                                                     :text (problem-text problem)))
                       :sure nil
                       :hand nil)
                 (index-part index nil nil)
                 (and all (list :alternatives nil))
                 (and refine (list :refined nil))
                 (carried-part carried))))

(defun problems-reason (problems)
  "Return PROBLEMS in one line."
  (format nil "~{~a~^; ~}" (mapcar #'problem-reason problems)))

(defun problem-reason (problem)
  "Return PROBLEM as line LINE, column COLUMN: TEXT."
  (format nil "~@[line ~d, ~]~@[column ~d: ~]~a" (problem-line problem) (problem-column problem)
          (problem-text problem)))

;;; Units

(defparameter +record-measures+
  '((:offset . :length) (:position . :length) (:opening . :length) (:squeeze . :force))
  "The keys of a record, and of what is in it, whose numbers have a unit, and what they measure.")

(defun record-in-units (record units)
  "Return RECORD with its lengths and forces in UNITS, those of the box."
  (labels ((numbers (value measure)
             (cond ((null value) nil)
                   ((consp value) (loop for part in value collect (numbers part measure)))
                   (t (in-units value measure units))))
           (walk (value)
             (cond ((atom value) value)
                   ((keywordp (first value))
                    (loop for (key value) on value by #'cddr
                          for measure = (cdr (assoc key +record-measures+))
                          collect key
                          collect (if measure (numbers value measure) (walk value))))
                   (t (mapcar #'walk value)))))
    (if units (walk record) record)))

;;; Lisp

(defun write-lisp-record (record output)
  "Put RECORD into OUTPUT as one line that READ reads, and that prints no package."
  (put-lisp record output)
  (put-octet output 10))

(defun put-lisp (value output)
  (etypecase value
    (null (put-text output "NIL"))
    ((eql t) (put-text output "T"))
    (string (put-lisp-string value output))
    (integer (put-integer output value))
    (double-float (put-double output value t))
    (carried (put-lisp-data (carried-value value) output))
    (keyword (put-octet output 58)
     (put-text output (symbol-name value)))
    (cons (put-octet output 40)
     (loop for (element . rest) on value
           do (put-lisp element output)
              (when rest (put-octet output 32)))
     (put-octet output 41))))

;;; JSON

(defun write-json-record (record output)
  "Put RECORD into OUTPUT as one line of JSON: a plist is an object, :U-W the key \"u_w\", another
list an array, NIL null, T true, :FALSE false."
  (put-json record output)
  (put-octet output 10))

(defun put-json (value output)
  (etypecase value
    (null (put-text output "null"))
    ((eql t) (put-text output "true"))
    ((eql :false) (put-text output "false"))
    (string (put-json-string value output))
    (integer (put-integer output value))
    (double-float (put-double output value))
    (carried (put-json-data (carried-value value) output))
    (cons (if (keywordp (first value))
              (put-json-object value output)
              (put-json-array value output)))))

(defun put-json-object (plist output)
  (put-octet output 123)
  (loop for (key value . rest) on plist by #'cddr
        do (put-text output (json-key key))
           (put-json value output)
           (when rest (put-octet output 44)))
  (put-octet output 125))

(defun put-json-array (list output)
  (put-octet output 91)
  (loop for (element . rest) on list
        do (put-json element output)
           (when rest (put-octet output 44)))
  (put-octet output 93))

(defun json-key (key)
  "Return KEY, a keyword of a record, as JSON, with the colon: \"u_w\":"
  (or (get key 'json-key)
      (setf (get key 'json-key)
            (format nil "\"~a\":" (substitute #\_ #\- (string-downcase key))))))
