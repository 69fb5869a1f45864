;;;; package.lisp -- what SUPERGRIP-DRAW exports.

(defpackage :supergrip-draw
  (:use :cl :supergrip)
  (:lock t)
  (:import-from :supergrip #:need-plan #:check-knowledge-argument #:%box-units #:*units* #:in-units
                #:with-unit #:unit-phrase #:unit-text-of #:axis-measure #:absolute-units-p)
  (:import-from :supergrip-data #:native-path #:refuse-argument #:form-text)
  (:import-from :supergrip-chainer #:face-index #:face-name #:face-axis #:face-sign
                #:opposite)
  (:documentation "Pictures of boxes, grasps and plans, as SVG, and reports, as HTML.")
  (:export
   ;; the paper's figures
   #:draw-grasps #:draw-offset #:draw-system #:draw-session #:draw-gripper
   ;; pictures of one plan
   #:draw-plan #:draw-quality #:draw-section #:draw-refinement
   ;; reports
   #:report #:report-index
   ;; what can't be drawn
   #:drawing-error #:drawing-error-what #:drawing-error-reason))
