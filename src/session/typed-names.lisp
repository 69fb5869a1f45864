;;;; typed-names.lisp -- what a name means that is typed: what SBCL knows of it.

(in-package :supergrip)

(defun global-name-p (name environment typed)
  "True if ENVIRONMENT, a macro's, is that of top level, and NAME is no variable but one of TYPED,
words that are typed like variables."
  (and (or (null environment)
           (sb-c::null-lexenv-p environment)
           (debugger-p environment name))
       (or (member name typed) (free-name-p name))))

(defun debugger-p (environment name)
  "True if ENVIRONMENT is that of what is typed in the debugger, and NAME is no variable there.
SBCL makes it the body of a function of the frame, in which the frame's variables are symbol
macros."
  (flet ((of-frame-p (variable)
           (and (consp (cdr variable)) (consp (cddr variable))
                (eq (third variable) 'sb-di:debug-var-value))))
    (let* ((variables (sb-c::lexenv-vars environment))
           (others (remove-if #'of-frame-p variables)))
      (and (null (sb-c::lexenv-funs environment))
           (null (sb-c::lexenv-blocks environment))
           (= (length others) 1)
           (null (symbol-package (car (first others))))
           (not (assoc name variables))))))

(defun free-name-p (name)
  "True if NAME, a symbol, is no variable, constant or symbol macro."
  (eq (sb-int:info :variable :kind name) :unknown))

(defun define-typed-word (word package form)
  "Let the name WORD, a string, mean FORM where it is typed like a variable in PACKAGE, unless it is
another package's or means something already.  Return its symbol if it means FORM."
  (let ((symbol (intern word package)))
    (when (and (eq (symbol-package symbol) package) (free-name-p symbol))
      (eval `(define-symbol-macro ,symbol ,form)))
    (and (equal (macroexpand-1 symbol) form) symbol)))

(defun typed-name (text)
  "Return the symbol that TEXT, typed in full, stands for in the current package; where that is
locked and has none, a symbol of no package."
  (cond ((find-symbol text))
        ((sb-ext:package-locked-p *package*) (make-symbol text))
        (t (intern text))))
