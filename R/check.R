# Checks of arguments. Each returns the value in the form used by the package, or aborts with the
# user's call. Fast where the value is valid.

`%||%` <- function(x, y) if (is.null(x)) y else x

describe_value <- function(x) {
  if (is.null(x)) return("NULL")
  if (is.function(x)) return("a function")
  if (is.atomic(x) && length(x) == 1L && !is.object(x)) {
    return(if (is.character(x)) quote_text(x) else format(x, digits = 7))
  }
  kind <- if (is.object(x)) {
    paste0("<", class(x)[1], "> object")
  } else if (is.atomic(x)) {
    paste(if (is.double(x)) "double" else typeof(x), "vector")
  } else {
    typeof(x)
  }
  article <- if (grepl("^[aeiou]", kind)) "an " else "a "
  paste0(article, kind, " of length ", length(x))
}

# For the heads of tibbles, which warn of control characters.
escape_controls <- function(x) {
  has <- grepl("[\001-\037\177]", x, useBytes = TRUE)
  x[has] <- encodeString(x[has])
  x
}

# A long text is cut: a message of 200,000 characters takes 25 s to lay out.
quote_text <- function(x) {
  bytes <- nchar(x, "bytes", keepNA = FALSE)
  if (bytes <= 200L) return(encodeString(x, quote = "\""))
  start <- if (validUTF8(x)) substr(x, 1L, 60L) else rawToChar(charToRaw(x)[1:60])
  paste0(encodeString(start, quote = "\""), " ... (", bytes, " bytes)")
}

check_function <- function(f, arg, call) {
  if (!is.function(f)) {
    abort_rotdyn(
      c("{.arg {arg}} must be a function.", x = "It is {describe_value(f)}."), "type", call
    )
  }
}

# args() is NULL for `if` and its like.
arguments_of <- function(f) {
  shape <- args(f)
  if (is.null(shape)) list() else as.list(formals(shape))
}

# Those that have no default.
required_arguments <- function(f) {
  takes <- arguments_of(f)
  setdiff(names(takes)[vapply(takes, rlang::is_missing, NA)], "...")
}

takes_arguments <- function(f, n) {
  all <- names(arguments_of(f))
  length(required_arguments(f)) <= n && (length(all) >= n || "..." %in% all)
}

# 1 for a function of time, 3 for one of time and state; else `otherwise` gets the number.
count_law_arguments <- function(f, otherwise) {
  n <- length(required_arguments(f))
  if (n == 3L) 3L else if (takes_arguments(f, 1L)) 1L else otherwise(n)
}

# The arguments of a law are given by place: those with known names must be in their places, as a
# function of theta_rad alone would be one of time. `order`: the names.
check_law_order <- function(f, order, arg, kind, call) {
  given <- required_arguments(f)
  words <- sub("_.*", "", order)
  words[nchar(words) == 1L] <- NA
  at <- match(given, order)
  at[is.na(at)] <- match(given[is.na(at)], words, incomparables = NA)
  if (all(is.na(at) | at == seq_along(given))) return(invisible(f))
  abort_rotdyn(c(
    "{.arg {arg}} must be a function of {.code {order[1]}}, or of
     {.code {toString(order)}}, in this order.",
    x = "It is one of {.code {toString(given)}}.",
    i = "What is not used is an argument, too: {.code function({toString(order)})}."
  ), kind, call)
}

# The dots must be empty; they are not evaluated. Returns the caller's frame.
check_no_dots <- function(...) {
  if (...length()) {
    abort_dots(as.list(substitute(list(...)))[-1L], rlang::caller_env(), rlang::caller_fn())
  }
  invisible(parent.frame())
}

abort_dots <- function(given, call, fn) {
  said <- vapply(given, rlang::as_label, "")
  named <- rlang::have_name(given)
  said[named] <- paste(names(given)[named], "=", said[named])
  known <- setdiff(names(formals(fn)), "...")
  near <- near_names(names(given)[named], known)
  lacks <- setdiff(Filter(function(name) {
    eval(call("missing", as.name(name)), call)
  }, intersect(required_arguments(fn), names(missing_hints))), near)
  abort_rotdyn(c(
    if (all(named)) {
      "{length(said)} unknown argument{?s}."
    } else {
      "Arguments after the first ones must be given by name."
    },
    x = "Unknown: {.code {said}}.",
    i = if (length(near)) "Did you mean {.arg {near}}?",
    unit_hints(names(given)[named], angles = !any(endsWith(near, "_deg"))),
    elsewhere_hints(rlang::call_name(rlang::frame_call(call)), names(given)[named]),
    i = if (length(lacks)) paste("{.arg {lacks[1]}} is missing.", missing_hints[[lacks[1]]]),
    i = "The arguments are {.arg {known}}."
  ), "argument", call)
}

# Required arguments, by name; `env` is the frame of the function. An unknown argument is named
# first: it may be what was meant by the missing one.
check_supplied <- function(names, env) {
  for (name in names) {
    if (eval(call("missing", as.name(name)), env)) {
      if (exists("...", env, inherits = FALSE) && eval(quote(...length()), env)) {
        given <- as.list(eval(quote(substitute(list(...))), env))[-1L]
        frame <- which(vapply(sys.frames(), identical, NA, env))
        abort_dots(given, env, sys.function(frame[length(frame)]))
      }
      abort_rotdyn(c(
        "{.arg {name}} is missing: it has no default.",
        i = if (name %in% names(missing_hints)) missing_hints[[name]]
      ), "missing", env)
    }
  }
}

is_number <- function(x) {
  is.numeric(x) && !is.factor(x)
}

# One finite number, from `lower` (excluded if `open`) to `upper`.
check_number <- function(x, arg, unit, call, lower = -Inf, upper = Inf, open = FALSE,
                         remedy = NULL) {
  if (is.double(x) && length(x) == 1L && is.null(attributes(x)) && is.finite(x) &&
    x >= lower && x <= upper && !(open && x == lower)) {
    return(x)
  }
  x <- if (is.object(x)) as_si(x, unit, arg, call) else quantity_of(x, arg, unit, call)
  if (!is_number(x) || length(x) != 1L || is.object(x)) {
    abort_rotdyn(
      c(
        "{.arg {arg}} must be one number{in_unit(unit)}.",
        x = "It is {describe_value(x)}.",
        i = if (is_number(x) && length(x) > 1L) remedy
      ),
      if (is_number(x) && !is.object(x)) "size" else "type", call
    )
  }
  if (!is.finite(x) || x < lower || x > upper || (open && x == lower)) {
    abort_domain(x, arg, unit, call, lower, upper, open)
  }
  as.double(x)
}

plain_unit <- function(unit) {
  gsub("*", " ", if (unit == "degree") "degrees" else unit, fixed = TRUE)
}

in_unit <- function(unit) {
  if (unit == "1") "" else paste0(" in ", plain_unit(unit))
}

abort_domain <- function(x, arg, unit, call, lower, upper, open, row = NULL) {
  of_unit <- if (unit == "1") "" else paste0(" ", plain_unit(unit))
  inside <- is.na(x) || (x >= lower && x <= upper && !(open && x == lower))
  domain <- if ((!is.finite(lower) && !is.finite(upper)) || (inside && is.infinite(x))) {
    "finite"
  } else if (!is.finite(upper)) {
    paste0(if (open) "greater than " else "at least ", format(lower), of_unit)
  } else if (open) {
    paste0("greater than ", format(lower), " and at most ", format(upper), of_unit)
  } else {
    paste0("between ", format(lower), " and ", format(upper), of_unit)
  }
  where <- if (is.null(row)) "" else paste0(" in row ", format(row, big.mark = ","))
  abort_rotdyn(
    c("{.arg {arg}} must be {domain}.", x = "It is {describe_value(x)}{where}."), "value", call
  )
}

# The probability of an interval: none is certain.
check_level <- function(level, call) {
  level <- check_number(level, "level", "1", call)
  if (level > 0 && level < 1) return(level)
  abort_rotdyn(
    c("{.arg level} must be between 0 and 1, without them.", x = "It is {level}."), "value", call
  )
}

# A column of doubles; NA, also logical, is allowed.
check_column <- function(x, arg, unit, call) {
  if (is.object(x)) x <- as_si(x, unit, arg, call)
  if (is.list(x) || is.character(x)) x <- quantity_of(x, arg, unit, call)
  if (is.double(x) && !is.object(x)) return(if (is.null(dim(x))) x else as.vector(x))
  if ((is_number(x) && !is.object(x)) || (is.logical(x) && all(is.na(x)))) return(as.double(x))
  abort_rotdyn(
    c("{.arg {arg}} must be numbers{in_unit(unit)}.", x = "It is {describe_value(x)}."),
    "type", call
  )
}

# Named columns, each checked in the unit at the same place.
check_columns_of <- function(columns, units, call) {
  for (i in seq_along(columns)) {
    columns[[i]] <- check_column(columns[[i]], names(columns)[i], units[[i]], call)
  }
  columns
}

check_not_negative <- function(x, arg, unit, call, open = FALSE) {
  bad <- which(if (open) x <= 0 else x < 0)
  if (length(bad)) abort_domain(x[bad[1]], arg, unit, call, 0, Inf, open, row = bad[1])
}

abort_missing_column <- function(column, data, call, hint = NULL) {
  abort_rotdyn(c(
    "The table needs a column {.field {column}}.",
    x = if (!length(data)) {
      "It has no columns."
    } else if (length(names(data))) {
      "Its columns are {.field {names(data)}}."
    } else {
      "Its columns have no names."
    },
    i = hint
  ), "type", call)
}

# Columns of length 1 or n; returns n.
check_recyclable <- function(columns, call) {
  sizes <- lengths(columns)
  others <- unique(sizes[sizes != 1L])
  if (length(others) > 1L) {
    text <- paste0("{.arg ", names(columns)[sizes != 1L], "} has ", sizes[sizes != 1L])
    abort_rotdyn(c(
      "Arguments must have the same length, or length 1.",
      stats::setNames(text, rep("x", length(text)))
    ), "size", call)
  }
  if (length(others)) others else 1L
}

# Columns beside the n rows of a table, which is the argument `arg`.
check_rows_fit <- function(columns, n, arg, call) {
  long <- lengths(columns) != 1L & lengths(columns) != n
  if (!any(long)) return(invisible())
  abort_rotdyn(c(
    "Arguments must have one number for each row of {.arg {arg}}, or one for all.",
    x = "{.arg {names(columns)[long]}} {?has/have} length {lengths(columns)[long]}, the table
         has {n} row{?s}."
  ), "size", call)
}

# A table of parameters, a scene in each row.
check_parameters <- function(parameters, call) {
  if (!is.data.frame(parameters)) {
    abort_rotdyn(
      c("{.arg parameters} must be a data frame.", x = "It is {describe_value(parameters)}."),
      "type", call
    )
  }
  twice <- names(parameters)[duplicated(names(parameters))]
  if (length(twice)) {
    abort_rotdyn(
      "{.arg parameters} has more than one column {.field {unique(twice)}}.", "value", call
    )
  }
}

# Finite doubles, for descriptions, where NA is not allowed.
check_finite <- function(x, arg, unit, call, kind = "value") {
  if (is.double(x) && is.null(attributes(x)) && all(is.finite(x))) return(x)
  x <- check_column(x, arg, unit, call)
  if (!all(is.finite(x))) {
    at <- which(!is.finite(x))[1]
    abort_rotdyn(
      c("{.arg {arg}} must be finite.", x = "Element {at} is {format(x[at])}."), kind, call
    )
  }
  attributes(x) <- NULL
  x
}

check_class <- function(x, class, arg, remedy, call) {
  if (!inherits(x, class)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a {.cls {class}} object.",
      x = "It is {describe_value(x)}.",
      i = remedy
    ), "type", call)
  }
}

# Output times: finite, not decreasing; they may repeat, and there may be none.
check_times <- function(time_s, call) {
  n <- length(time_s)
  # is.unsorted() is NA with missing values: sorted and finite at both ends means finite throughout.
  if (is.double(time_s) && is.null(attributes(time_s)) &&
    (n == 0L || (is.finite(time_s[1L]) && is.finite(time_s[n])))) {
    back <- is.unsorted(time_s)
    if (!is.na(back) && !back) return(time_s)
  }
  time_s <- check_finite(time_s, "time_s", "s", call, "time")
  if (is.unsorted(time_s)) {
    at <- which(diff(time_s) < 0)[1]
    abort_rotdyn(c(
      "{.arg time_s} must not go back in time.",
      x = "Element {at + 1} is {format(time_s[at + 1])} after {format(time_s[at])}.",
      i = "Sort it, or ask {.fn predict} for times in any order."
    ), "time", call)
  }
  time_s
}

# Time differences must be finite, too.
check_span <- function(scene, time_s, call) {
  n <- length(time_s)
  start <- .subset2(scene, "start_s")
  if (n && !(is.finite(time_s[n] - start) && is.finite(start - time_s[1]))) {
    abort_rotdyn("The span of {.arg time_s} exceeds double precision.", "time", call)
  }
}

check_accuracy <- function(accuracy, call) {
  check_number(accuracy, "accuracy", "1", call, lower = 0, upper = 1, open = TRUE)
}

# Text that R can compare and convert: not marked as bytes, and valid in its encoding.
is_readable_text <- function(x) {
  all(Encoding(x) != "bytes") && all(validEnc(x))
}

# In every locale: the small letter of I is another one in Turkish.
lower_case <- function(x) {
  chartr("ABCDEFGHIJKLMNOPQRSTUVWXYZ", "abcdefghijklmnopqrstuvwxyz", x)
}

abort_unreadable <- function(x, arg, call) {
  abort_rotdyn(c(
    "{.arg {arg}} must be text in a known encoding.",
    x = "It is {describe_value(x)}.",
    i = "{.fn iconv} or {.fn Encoding} gives it one."
  ), "type", call)
}

# A name: one string.
check_name <- function(x, arg, call) {
  if (!is.character(x) || is.object(x) || length(x) != 1L || is.na(x)) {
    abort_rotdyn(
      c("{.arg {arg}} must be one piece of text.", x = "It is {describe_value(x)}."),
      if (is.character(x) && length(x) != 1L) "size" else "type", call
    )
  }
  x
}

# As match.arg(): the first of several choices is the default.
check_choice <- function(x, arg, choices, call) {
  check_string(if (is.character(x)) x[1] else x, arg, choices, call)
}

check_string <- function(x, arg, choices, call) {
  if (!is.character(x) || length(x) != 1L || is.na(x) || !is_readable_text(x) ||
    !x %in% choices) {
    abort_rotdyn(
      c("{.arg {arg}} must be one of {.or {.val {choices}}}.", x = "It is {describe_value(x)}."),
      "value", call
    )
  }
  x
}

check_flag <- function(x, arg, call) {
  if (!is.logical(x) || length(x) != 1L || is.na(x)) {
    abort_rotdyn(
      c("{.arg {arg}} must be {.code TRUE} or {.code FALSE}.", x = "It is {describe_value(x)}."),
      "type", call
    )
  }
  x
}
