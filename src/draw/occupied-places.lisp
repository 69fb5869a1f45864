;;;; occupied-places.lisp -- the parts of a picture on which no word may be put.

(in-package :supergrip-draw)

(defvar *obstacles* '() "Rectangles (x y width height) that no label may touch.")
(defvar *words* '() "Those of them that are words, which no leader may cut.")
(defvar *areas* '() "Convex outlines that no label may touch.")
(defvar *strokes* '() "Lines that labels had better not cross: two ends, and half the width.")
(defvar *leaders* '() "The same of lines from labels to what they name.")
(defvar *labels* '() "Labels that wait for their place, the latest first.")

(defun occupy (rectangle)
  "Keep RECTANGLE clear of labels."
  (push rectangle *obstacles*))

(defun occupy-around (point radius)
  "Keep the place around POINT clear of labels."
  (occupy (list (- (first point) radius) (- (second point) radius) (* 2 radius) (* 2 radius))))

(defun occupy-area (outline)
  "Keep the convex OUTLINE clear of labels."
  (push outline *areas*))

(defun note-strokes (points &optional (width 1))
  "Have labels avoid the line of WIDTH through POINTS."
  (loop for (a b) on points while b do (push (list a b (* 0.5d0 width)) *strokes*)))
