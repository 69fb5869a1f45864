;;;; package.lisp -- the statics of contacts: what fingers on a thing can really exert.
;;;;
;;;; This room knows contacts, wrenches and motions, and nothing of rules, boxes or grasps.

(defpackage :supergrip-statics
  (:use :cl :supergrip-data)
  (:implement :supergrip-statics :supergrip-data)
  (:lock t)
  (:documentation "What contacts can really exert, exactly and certified.")
  (:export
   ;; of lists, checked
   #:exact-radius #:holds-p #:contact-forces #:least-squeeze #:least-friction #:wrench-entries
   #:sure-radius
   ;; of arrays, without checks
   #:grip #:make-grip #:set-finger #:grip-count #:grip-friction #:grip-soft-friction
   #:computable-p #:same-contacts-p #:grip-coupled #:grip-power #:grip-radius #:grip-holds-p
   #:grip-closed-p #:grip-forces #:grip-squeeze
   #:grip-least-friction #:grip-entry #:grip-entries #:mobility #:find-in #:sure #:six #:make-six))
