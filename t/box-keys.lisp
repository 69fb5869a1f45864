;;;; box-keys.lisp -- a key of a box is one row, in both notations.

(in-package :supergrip-test)
(define-suite box-keys "A key of a box is one row, in both notations.")

(defun json-box (text)
  "Return the box that TEXT, JSON, describes."
  (let ((supergrip::*notation* :json))
    (supergrip::canonical-box
     (supergrip::json-description (supergrip::read-json (supergrip-data:string-source text)))
     nil 1)))

(test a-key-of-a-box-is-one-row
  (let ((supergrip::*box-keys* supergrip::*box-keys*)
        (with-keys "((SIZE 12 2 2) (WEIGHT 0.2) (U 0.8) (V 0.2) (CONSTRAINED) (FRAGILE Z1 Z2)
                     (COLOUR \"red\") (TEMPERATURE 21) (FORCE-NEEDED (1 0 0 0 0 0))
                     (VELOCITY-NEEDED (0 0 0 0 0 0)))")
        (json "{\"size\": [12, 2, 2], \"weight\": 0.2, \"u\": 0.8, \"v\": 0.2, \"constrained\": [],
                \"fragile\": [\"Z1\", \"z2\"], \"colour\": \"red\", \"temperature\": 21,
                \"force_needed\": [1, 0, 0, 0, 0, 0], \"velocity_needed\": [0, 0, 0, 0, 0, 0]}"))
    (is (= 3 (length (problem-texts (lambda () (json-box json))))) "unknown so far")
    (supergrip:define-box-key :colour :text "a colour" ("blue") :optional t)
    (supergrip:define-box-key :fragile :faces "faces that break" (:z1) :optional t)
    (supergrip:define-box-key :temperature :number "degrees from 0" (20))
    (dolist (box (list (supergrip:parse-box (read-from-string with-keys)) (json-box json)))
      (is (equal "red" (supergrip:box-value box :colour)))
      (is (eql #b11 (supergrip:box-value box :fragile)))
      (is (eql 21d0 (supergrip:box-value box :temperature)))
      (is (equal '(12d0 2d0 2d0) (supergrip:box-size box))))
    (is (equal '("line 1: BOX: TEMPERATURE is missing; it takes degrees from 0: (TEMPERATURE 20)")
               (mapcar (lambda (text) (format nil "line 1: ~a" text))
                       (problem-texts (lambda () (supergrip:parse-box (paper-box)))))))
    (is (search "\"fragile\" takes faces that break: \"fragile\": [\"Z1\"]"
                (first (problem-texts
                        (lambda () (json-box (changed json "[\"Z1\", \"z2\"]"
                                             "7")))))))))
