# Derived inputs: formulas of other inputs, checked and translated to a program that C runs
# (src/core/design/formula.c). A formula is data: its text alone makes it again, and nothing of it
# is evaluated by R.

# Functions and operators of a formula, with their numbers of arguments; pmin() and pmax() take two
# or more.
formula_calls <- list(
  `+` = 1:2, `-` = 1:2, `*` = 2, `/` = 2, `^` = 2, sqrt = 1, exp = 1, log = 1, sin = 1, cos = 1,
  tan = 1, abs = 1, pmin = 2:99, pmax = 2:99, `<` = 2, `<=` = 2, `>` = 2, `>=` = 2, `==` = 2,
  `!=` = 2, ifelse = 3
)

# A one-sided formula or its text, and the names of the inputs => list(text, op, arg, constant):
# canonical text, codes of the operations, indices from 0, constants.
derived_input <- function(x, inputs, arg, call) {
  expression <- formula_expression(x, arg, call)
  program <- new.env(parent = emptyenv())
  program$op <- program$arg <- integer()
  program$constant <- double()
  codes <- names(.Call(ffi_formula_operations))
  emit <- function(name, index = 0L) {
    program$op <- c(program$op, match(name, codes) - 1L)
    program$arg <- c(program$arg, as.integer(index))
  }
  text <- translate_formula(expression, list(
    inputs = inputs, emit = emit, arg = arg, call = call,
    constant = function(x) {
      program$constant <- c(program$constant, x)
      emit("constant", length(program$constant) - 1L)
    }
  ))
  result <- list(text = text$text, op = program$op, arg = program$arg, constant = program$constant)
  check_depth(result, arg, call)
  result
}

# Values of n rows; `columns`: those of the inputs, in the order of their names.
derived_values <- function(program, columns, n) {
  .Call(ffi_formula_rows, program, unname(columns), as.double(n))
}

# ---- reading ------------------------------------------------------------------------------------

formula_expression <- function(x, arg, call) {
  if (inherits(x, "formula") && is.call(x)) {
    if (length(x) == 2L) return(x[[2L]])
    abort_rotdyn(c(
      "{.arg {arg}} must be a formula without a left side.",
      i = "For example {.code {arg} = ~ mass_kg * radius_m^2 / 2}."
    ), "value", call)
  }
  if (!is.character(x) || is.object(x) || length(x) != 1L || is.na(x)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a formula or its text.", x = "It is {describe_value(x)}.",
      i = "For example {.code {arg} = ~ mass_kg * radius_m^2 / 2}."
    ), "type", call)
  }
  if (!is_readable_text(x)) abort_unreadable(x, arg, call)
  parsed <- if (nchar(x, "bytes") <= 10000L) {
    tryCatch(parse(text = x, keep.source = FALSE), error = function(e) NULL)
  }
  if (length(parsed) != 1L) {
    abort_rotdyn(
      c("{.arg {arg}} must be one expression.", x = "It is {quote_text(x)}."), "value", call
    )
  }
  parsed[[1L]]
}

# "body$mass_kg" of a name or of a path; NULL of anything else.
input_name <- function(x) {
  if (is.name(x)) return(as.character(x))
  if (!is.call(x) || !identical(x[[1L]], quote(`$`)) || length(x) != 3L) return(NULL)
  from <- input_name(x[[2L]])
  last <- if (is.name(x[[3L]]) || is.character(x[[3L]])) as.character(x[[3L]])
  if (is.null(from) || length(last) != 1L) NULL else paste0(from, "$", last)
}

# ---- translation --------------------------------------------------------------------------------

# Precedence of operators in R, lowest first; a sign has 4, a name, a number or a call 6.
formula_precedence <- c(
  `<` = 1, `<=` = 1, `>` = 1, `>=` = 1, `==` = 1, `!=` = 1, `+` = 2, `-` = 2, `*` = 3, `/` = 3,
  `^` = 5
)

# Emits the operations of an expression, operands first; returns its text and its precedence.
translate_formula <- function(x, to, depth = 0L) {
  # A level takes some 50 kB of the C stack.
  if (depth > 40L) abort_formula("is nested too deeply.", to)
  x <- without_parentheses(x)
  if (is.numeric(x) && length(x) == 1L && !is.object(x) && is.finite(x)) {
    to$constant(as.double(x))
    # A negative one, which no text has, reads back as a sign and a number.
    return(list(text = .Call(ffi_text_numbers, as.double(x)), level = if (1 / x < 0) 4 else 6))
  }
  name <- input_name(x)
  if (!is.null(name)) return(translate_name(name, to))
  if (!is.call(x)) {
    abort_formula("has a part that is neither a number nor an input: {.code {deparse(x)[1]}}.", to,
                  x = x)
  }
  f <- if (is.name(x[[1L]])) as.character(x[[1L]]) else ""
  if (!f %in% names(formula_calls)) {
    said <- if (nzchar(f)) f else deparse(x[[1L]])[1]
    abort_formula("uses {.code {said}}, which is not allowed.", to, said = said, allowed = TRUE)
  }
  given <- check_formula_call(f, x, to)
  if (f %in% names(formula_precedence)) {
    return(if (length(given) == 1L) translate_sign(f, given, to, depth) else
      translate_operators(x, to, depth))
  }
  texts <- character()
  for (i in seq_along(given)) {
    texts[i] <- translate_formula(given[[i]], to, depth + 1L)$text
    if (f %in% c("pmin", "pmax") && i > 1L) to$emit(f)
  }
  if (!f %in% c("pmin", "pmax")) to$emit(f)
  list(text = paste0(f, "(", toString(texts), ")"), level = 6)
}

without_parentheses <- function(x) {
  while (is.call(x) && identical(x[[1L]], quote(`(`)) && length(x) == 2L) x <- x[[2L]]
  x
}

check_formula_call <- function(f, x, to) {
  given <- as.list(x)[-1L]
  if (!is.null(names(given)) || !length(given) %in% formula_calls[[f]] ||
    any(vapply(given, identical, NA, quote(expr = )))) {
    abort_formula("calls {.code {f}} with other arguments than it takes here, which have no names.",
                  to, f = f)
  }
  given
}

translate_name <- function(name, to) {
  at <- match(name, to$inputs)
  if (!is.na(at)) {
    to$emit("input", at - 1L)
    return(list(text = if (grepl("^[A-Za-z.][A-Za-z0-9._]*$", name) && make.names(name) == name)
      name else paste0("`", gsub("([\\`])", "\\\\\\1", name), "`"), level = 6))
  }
  if (name == "pi") {
    to$constant(pi)
    return(list(text = "pi", level = 6))
  }
  near <- near_names(name, to$inputs)
  of_keep <- to$arg == "keep"
  abort_formula(
    "refers to {.field {name}}, which is no {what}.", to, name = name, near = near,
    what = if (of_keep) "input or output" else "input", hints = c(
      i = if (length(near)) "Did you mean {.field {near}}?",
      i = if (of_keep) "Inputs and outputs are {.field {inputs}}." else
        "The inputs are {.field {inputs}}."
    )
  )
}

translate_sign <- function(f, given, to, depth) {
  inner <- translate_formula(given[[1L]], to, depth + 1L)
  if (f == "-") to$emit("negate")
  list(text = paste0(f, in_parentheses(inner, inner$level < 5)), level = 4)
}

# Operators with two sides. A sum of many terms is a chain on the left, which is followed by a loop.
translate_operators <- function(x, to, depth) {
  chain <- list()
  while (is.call(x) && length(x) == 3L && is.name(x[[1L]]) &&
    as.character(x[[1L]]) %in% names(formula_precedence)) {
    given <- check_formula_call(as.character(x[[1L]]), x, to)
    chain <- c(chain, list(list(f = as.character(x[[1L]]), right = given[[2L]])))
    x <- without_parentheses(given[[1L]])
  }
  left <- translate_formula(x, to, depth + 1L)
  for (link in rev(chain)) {
    right <- translate_formula(link$right, to, depth + 1L)
    to$emit(link$f)
    left <- join_operands(link$f, left, right)
  }
  left
}

# a - (b - c) and (a^b)^c: one side alone may have the same level; a < b < c has no meaning.
join_operands <- function(f, left, right) {
  level <- formula_precedence[[f]]
  text <- paste0(
    in_parentheses(left, left$level < level + (f == "^" || level == 1)),
    if (f == "^") f else paste0(" ", f, " "),
    in_parentheses(right, right$level < level + (f != "^"))
  )
  list(text = text, level = level)
}

in_parentheses <- function(part, needed) {
  if (needed) paste0("(", part$text, ")") else part$text
}

check_depth <- function(program, arg, call) {
  operands <- .Call(ffi_formula_operations)[program$op + 1L]
  if (max(cumsum(1L - operands)) > 32L) {
    abort_rotdyn("{.arg {arg}} is a formula that is nested too deeply.", "value", call)
  }
}

# `problem`: the rest of the sentence, with values by their names in the dots.
abort_formula <- function(problem, to, ..., hints = NULL, allowed = FALSE) {
  env <- list2env(list(..., arg = to$arg, inputs = to$inputs, functions = names(formula_calls)))
  parent.env(env) <- environment()
  abort_rotdyn(c(
    paste("The formula of {.arg {arg}}", problem), hints,
    i = if (allowed) "Formulas take inputs, numbers, {.code pi} and {.code {functions}}."
  ), "value", to$call, .envir = env)
}
