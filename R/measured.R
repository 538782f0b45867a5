#' A measured number with its standard uncertainty
#'
#' `measured()` makes a number with a standard uncertainty, its degrees of freedom and an identity:
#' the same object used twice, in one calculation or in several, is one quantity. Sums (`+` and
#' `sum()`), products, powers and elementary functions of such numbers are such numbers, to first
#' order; what two of them have in common stays common, so that `x - x` is exactly 0.
#' \deqn{u^2(y) = \sum_i \sum_j \frac{\partial f}{\partial x_i} \frac{\partial f}{\partial x_j}
#'   u(x_i)\, u(x_j)\, r_{ij}}{u^2(y) = sum_ij df/dx_i df/dx_j u(x_i) u(x_j) r_ij}
#'
#' Any function of the package that takes a number takes a measured one, and uses its value.
#' [uncertainty_budget()] and the functions of [inertia_torsion()] carry its uncertainty on.
#'
#' @param value The number, in SI units; or several readings, without `u`: their mean, with u =
#'   s/sqrt(n) and n - 1 degrees of freedom. An object of the errors package keeps its identity. A
#'   [fit_scene()]: all its values with their correlations.
#' @param u Standard uncertainty (one standard deviation), at least 0.
#' @param dof Degrees of freedom of `u`, above 0; Inf where it is not from readings.
#' @param name Name in budgets; by default the expression given.
#' @param x,e1,e2 Measured numbers.
#' @param ... For `c()` and `sum()`: measured numbers and plain ones; the first is measured. For
#'   the others: not used.
#' @param na.rm Not used: no measured number is missing.
#' @param digits For `format()`: digits of the uncertainty.
#' @return `measured()`: an object of class `rot_measured`, a list with `value`, `u`, `dof`, `name`
#'   and `parts`, the independent contributions by identity; of a fit a list of them, by the names
#'   of the unknowns that have a standard error. `as.double()` gives the value, `c()` the values of
#'   several, with their names.
#'
#'   `format()`: the concise form, `127.732(71)`. NA, NaN and Inf are errors, as are `mean()`,
#'   `max()`, `round()`, `rep()` and `[`: `(a + b) / 2` is the mean of two, `list(a, b)` holds them.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source JCGM 100:2008, Guide to the expression of uncertainty in measurement, clauses 5.1 and
#'   5.2.
#' @seealso [uncertainty_budget()], [inertia_torsion()].
#' @concept uncertainty
#' @concept error propagation
#' @concept GUM
#' @examples
#' mass <- measured(1.55, 0.005, name = "mass")
#' radius <- measured(c(0.3358, 0.3361, 0.3362, 0.3359), name = "radius")
#' radius
#' mass * radius^2
#' # The same object is one quantity: nothing is left of it in a ratio.
#' mass / mass
#' @export
measured <- function(value, u, dof = Inf, name = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("value", call)
  label <- rlang::as_label(substitute(value))
  name <- if (is.null(name)) label else check_name(name, "name", call)
  several <- if (missing(u)) measured_values(value, call)
  if (!is.null(several)) return(several)
  if (inherits(value, "errors") && missing(u)) return(from_errors(value, name, call))
  value <- check_finite(value, "value", "1", call)
  if (missing(u)) {
    n <- length(value)
    if (n < 2L) {
      abort_rotdyn(c(
        "{.arg u} is missing: it has no default.",
        i = "For an exact number give 0; several readings need none."
      ), "missing", call)
    }
    if (!missing(dof)) {
      abort_rotdyn("{.arg dof} of readings is their number less one.", "argument", call)
    }
    return(new_measured(mean(value), stats::sd(value) / sqrt(n), n - 1, name))
  }
  value <- check_number(value, "value", "1", call)
  u <- check_number(u, "u", "1", call, lower = 0)
  if (!identical(dof, Inf)) dof <- check_number(dof, "dof", "1", call, lower = 0, open = TRUE)
  new_measured(value, u, dof, name)
}

# A list of measured numbers, from what has several; NULL: no such object.
measured_values <- function(x, call) UseMethod("measured_values")

measured_values.default <- function(x, call) NULL

# Identities: unique in all sessions whose objects may meet.
identities <- new.env(parent = emptyenv())
identities$count <- 0

new_identity <- function() {
  identities$count <- identities$count + 1
  paste(Sys.getpid(), format(as.double(Sys.time()), digits = 16), identities$count, sep = "-")
}

no_parts <- function() {
  data.frame(
    id = character(), name = character(), u = double(), dof = double(), group = character()
  )
}

new_measured <- function(value, u, dof, name, id = new_identity()) {
  value <- as.double(value)
  u <- as.double(u)
  dof <- as.double(dof)
  parts <- no_parts()
  if (u > 0) parts <- data.frame(id = id, name = name, u = u, dof = dof, group = id)
  structure(
    list(value = value, u = u, dof = dof, name = name, parts = parts), class = "rot_measured"
  )
}

# From a value and signed contributions of independent parts; those of one identity are added.
measured_from_parts <- function(value, parts, name, class = NULL, ...) {
  if (anyDuplicated(parts$id)) {
    total <- rowsum(parts$u, parts$id, reorder = FALSE)
    parts <- parts[!duplicated(parts$id), ]
    parts$u <- total[, 1]
  }
  parts <- parts[parts$u != 0, ]
  rownames(parts) <- NULL
  structure(
    list(
      value = value, u = root_sum(parts$u), dof = effective_dof(parts), name = name, parts = parts,
      ...
    ),
    class = c(class, "rot_measured")
  )
}

# Without overflow or underflow of squares.
root_sum <- function(x) {
  top <- max(abs(x), 0)
  if (!is.finite(top) || top == 0) return(top)
  top * sqrt(sum((x / top)^2))
}

# Welch and Satterthwaite; a correlated group counts as one quantity.
effective_dof <- function(parts) {
  top <- max(abs(parts$u), 0)
  if (top == 0) return(Inf)
  square <- rowsum((parts$u / top)^2, parts$group, reorder = FALSE)
  dof <- vapply(
    split(parts$dof, factor(parts$group, unique(parts$group))), min, 0
  )
  sum(square)^2 / sum(square^2 / dof)
}

# An object of the errors package: its id is an environment, which has one address in a session.
from_errors <- function(x, name, call) {
  if (!is.double(unclass(x)) || length(x) != 1L || !is.numeric(attr(x, "errors"))) {
    abort_rotdyn(
      c("{.arg value} must be one number.", x = "It is {describe_value(x)}."), "size", call
    )
  }
  value <- check_number(as.double(unclass(x)), "value", "1", call)
  u <- check_number(as.double(attr(x, "errors"))[1], "u", "1", call, lower = 0)
  id <- attr(x, "id")
  new_measured(
    value, u, Inf, name,
    id = if (is.environment(id)) paste("errors", rlang::env_label(id)) else new_identity()
  )
}

# An argument that may be a number, a quantity with units, one of the errors package, or measured.
as_measured <- function(x, arg, unit, call, lower = -Inf, upper = Inf, open = FALSE) {
  if (inherits(x, "errors")) x <- from_errors(x, arg, call)
  if (!inherits(x, "rot_measured")) {
    return(new_measured(check_number(x, arg, unit, call, lower, upper, open), 0, Inf, arg))
  }
  check_measured(x, arg, call)
  check_number(x$value, arg, unit, call, lower, upper, open)
  x
}

measured_form <- list(
  value = "number", u = "number", dof = "limit", name = "text", parts = "list"
)

check_measured <- function(x, arg, call) {
  check_class(x, "rot_measured", arg, "Make one with {.fn measured}.", call)
  check_form(unclass(x), measured_form, arg, "measured number", call)
  parts <- x$parts
  fits <- is.data.frame(parts) && setequal(names(parts), names(no_parts())) &&
    is.numeric(parts$u) && all(is.finite(parts$u)) && is.numeric(parts$dof) &&
    !anyNA(parts$dof) && all(parts$dof > 0) && is.character(parts$id) && is.character(parts$group)
  if (!fits || x$u < 0) {
    abort_rotdyn(c(
      "{.arg {arg}} is a damaged measured number.", i = "Make it again with {.fn measured}."
    ), "type", call)
  }
  x
}

# Rows: numbers; columns: contributions of the parts that any of them has.
shares_matrix <- function(given) {
  ids <- unique(unlist(lapply(given, function(x) x$parts$id)))
  out <- matrix(0, length(given), length(ids), dimnames = list(NULL, ids))
  for (i in seq_along(given)) out[i, given[[i]]$parts$id] <- given[[i]]$parts$u
  out
}

#' @rdname measured
#' @export
as.double.rot_measured <- function(x, ...) check_measured(x, "x", current_env())$value

#' @rdname measured
#' @export
c.rot_measured <- function(...) {
  call <- current_env()
  values <- lapply(list(...), function(x) {
    if (inherits(x, "rot_measured")) check_measured(x, "...", call)$value else x
  })
  unlist(values)
}

#' @rdname measured
#' @export
format.rot_measured <- function(x, digits = 2, ...) {
  call <- current_env()
  check_measured(x, "x", call)
  digits <- floor(check_number(digits, "digits", "1", call, lower = 1, upper = 15))
  format_concise(x$value, x$u, digits)
}

#' @rdname measured
#' @export
print.rot_measured <- function(x, ...) {
  check_measured(x, "x", current_env())
  say(x$name, " = ", format(x), if (is.finite(x$dof) && x$u > 0) {
    paste0("  (", format(x$dof, digits = 3), " degrees of freedom)")
  }, "\n")
  invisible(x)
}

# 127.732(71): the digits in brackets are those of the uncertainty, in the last places shown.
format_concise <- function(value, u, digits = 2) {
  if (!is.finite(u) || u <= 0) return(format(value, digits = 10))
  # Sixteen digits of the value are all there are; below 1e-290 powers of ten are no doubles.
  if (u < 1e-14 * abs(value) || u < 1e-290 || max(u, abs(value)) > 1e290) {
    return(paste(format(value, digits = 15), "+-", format(u, digits = digits)))
  }
  place <- floor(log10(u)) - digits + 1
  # Beyond the exponents of double precision, or with more digits than a number has.
  if (abs(place) > 290 || !isTRUE(abs(value) < 1e290) || abs(value) > 1e15 * u) {
    return(paste(format(value, digits = 15), "+-", format(u, digits = digits)))
  }
  # 0.0996 with two digits is 0.10.
  if (round(u / 10^place) >= 10^digits) place <- place + 1
  top <- if (value == 0) place else max(floor(log10(abs(value))), place)
  if (top >= 6 || top < -4) {
    shift <- top
    mantissa <- format_concise(value / 10^shift, u / 10^shift, digits)
    return(paste0(mantissa, "e", shift))
  }
  decimals <- max(-place, 0)
  shown <- formatC(round(value, decimals), format = "f", digits = decimals)
  inside <- if (place < 0) {
    # A point where the uncertainty has digits before it: 12.3(1.5).
    if (u >= 1) formatC(u, format = "f", digits = decimals) else format(round(u / 10^place))
  } else {
    format(round(u / 10^place) * 10^place, scientific = FALSE)
  }
  paste0(shown, "(", inside, ")")
}

#' @rdname measured
#' @export
Ops.rot_measured <- function(e1, e2) {
  call <- current_env()
  if (missing(e2)) {
    check_measured(e1, "e1", call)
    if (!.Generic %in% c("+", "-")) abort_operator(.Generic, call)
    sign <- if (.Generic == "-") -1 else 1
    parts <- e1$parts
    parts$u <- sign * parts$u
    return(measured_from_parts(sign * e1$value, parts, paste0(.Generic, e1$name)))
  }
  a <- as_measured(e1, "e1", "1", call)
  b <- as_measured(e2, "e2", "1", call)
  x <- a$value
  y <- b$value
  if (.Generic %in% c("==", "!=", "<", ">", "<=", ">=")) return(get(.Generic)(x, y))
  slope <- switch(.Generic,
    "+" = c(1, 1),
    "-" = c(1, -1),
    "*" = c(y, x),
    "/" = c(1, -x / y), # of what is divided by y below
    "^" = c(
      if (y == 0) 0 else y * x^(y - 1), if (nrow(b$parts)) x^y * log(x) else 0
    ),
    abort_operator(.Generic, call)
  )
  labels <- c(
    if (inherits(e1, "rot_measured")) a$name else format(x),
    if (inherits(e2, "rot_measured")) b$name else format(y)
  )
  unit <- if (.Generic == "/") y else 1
  a$parts$u <- a$parts$u / unit * slope[1]
  b$parts$u <- b$parts$u / unit * slope[2]
  combine_parts(get(.Generic)(x, y), rbind(a$parts, b$parts), paste(labels[1], .Generic, labels[2]),
    call)
}

#' @rdname measured
#' @export
Math.rot_measured <- function(x, ...) {
  call <- current_env()
  v <- check_measured(x, "x", call)$value
  base <- list(...)
  if (.Generic == "log" && length(base)) {
    base <- check_number(base[[1]], "base", "1", call, lower = 0, open = TRUE)
    x$parts$u <- x$parts$u / (v * log(base))
    value <- suppressWarnings(log(v, base))
    return(combine_parts(value, x$parts, paste0("log(", x$name, ", ", format(base), ")"), call))
  }
  # What is no number is an error below, not a warning of R.
  slope <- suppressWarnings(switch(.Generic,
    sqrt = 0.5 / sqrt(v), exp = exp(v), log = 1 / v, sin = cos(v), cos = -sin(v),
    tan = 1 / cos(v)^2, asin = 1 / sqrt(1 - v^2), acos = -1 / sqrt(1 - v^2), atan = 1 / (1 + v^2),
    # At 0 it has no derivative.
    abs = if (v == 0) NaN else sign(v),
    abort_operator(.Generic, call)
  ))
  x$parts$u <- x$parts$u * slope
  value <- suppressWarnings(get(.Generic)(v))
  combine_parts(value, x$parts, paste0(.Generic, "(", x$name, ")"), call)
}

#' @rdname measured
#' @export
mean.rot_measured <- function(x, ...) abort_operator("mean", current_env())

#' @rdname measured
#' @export
rep.rot_measured <- function(x, ...) abort_operator("rep", current_env())

#' @rdname measured
#' @export
`[.rot_measured` <- function(x, ...) abort_operator("[", current_env())

#' @rdname measured
#' @export
Summary.rot_measured <- function(..., na.rm = FALSE) {
  call <- current_env()
  if (.Generic != "sum") abort_operator(.Generic, call)
  given <- list(...)
  terms <- lapply(given, as_measured, "...", "1", call)
  label <- vapply(given, function(x) {
    if (inherits(x, "rot_measured")) x$name else format(as.double(x))
  }, "")
  combine_parts(
    sum(vapply(terms, `[[`, 0, "value")), do.call(rbind, lapply(terms, `[[`, "parts")),
    paste(label, collapse = " + "), call
  )
}

combine_parts <- function(value, parts, name, call) {
  if (!is.finite(value) || !all(is.finite(parts$u))) {
    abort_rotdyn(c(
      "The value or its uncertainty is not finite.", x = "It is {.code {name}}."
    ), "value", call)
  }
  measured_from_parts(value, parts, name)
}

abort_operator <- function(operator, call) {
  abort_rotdyn(c(
    "{.code {operator}} is not defined for measured numbers.",
    i = "{.fn uncertainty_budget} takes any function."
  ), "type", call)
}
