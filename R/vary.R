# Laws of inputs: how one input of a design varies. A law is plain data; C has its quantiles
# (src/core/design/laws.c).

#' How an input of a design varies
#'
#' Laws of the inputs of a [design][design_sobol]: a distribution, or a list of values. A plain
#' number in a design is fixed.
#'
#' | law | values |
#' |---|---|
#' | `vary_uniform(low, high)` | equally likely from `low` to `high` |
#' | `vary_loguniform(low, high)` | their logarithm is uniform; `0 < low` |
#' | `vary_normal(mean, sd)` | normal with a standard deviation `sd` of at least 0 |
#' | `vary_lognormal(median, factor)` | their logarithm is normal: 68.3 % are within the `factor`, at least 1, of the `median`, above 0 |
#' | `vary_triangular(low, mode, high)` | density that rises from `low` to `mode` and falls to `high` |
#' | `vary_truncated(law, low, high)` | one of these, restricted to an interval |
#' | `vary_values(x, weights)` | one of the numbers `x` |
#'
#' A value is the quantile \eqn{F^{-1}(u)}{F^-1(u)} of a coordinate u between 0 and 1, which are
#' never reached; of a truncated law
#' \deqn{x = F^{-1}\left(F(a) + u\,(F(b) - F(a))\right)}{x = F^-1(F(a) + u (F(b) - F(a)))}
#' counted from the upper end where that has more digits. Of `vary_values()` the first values have
#' the smallest u.
#'
#' @param low,high Limits; of `vary_truncated()` -Inf and Inf are no limit.
#' @param mean,sd Mean and standard deviation.
#' @param median,factor Median, and the factor of one standard deviation.
#' @param mode The value with the highest density.
#' @param law A law, not that of `vary_values()`.
#' @param x Numbers, finite. For `format()` and `print()`: a law.
#' @param weights Weights of them, at least 0; NULL: equal.
#' @param ... Not used: an unknown argument is an error.
#' @return An object of class `rot_vary`, a list of plain data: `kind`, the parameters by their
#'   names, `at_least` and `at_most` of a truncated law, and `unit`.
#' @section Units: A law has the unit of its input: numbers are in SI units, as those of the scene.
#'   Objects of the units package are kept as numbers with their `unit`, all in that of the first;
#'   the sweep converts them. One law has units in all numbers or in none.
#' @section Errors: `rotdyn_error_value` for parameters outside their domains, or a truncation that
#'   leaves nothing; `rotdyn_error_unit`, `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source JCGM 101:2008, Propagation of distributions using a Monte Carlo method, section 6.4;
#'   Wichura, Algorithm AS 241, Applied Statistics 37, 477 (1988), for normal quantiles.
#' @seealso [design_sobol()] and the other designs, [measured()] for uncertainty to first order.
#' @concept distribution
#' @concept tolerance
#' @concept uncertain input
#' @examples
#' vary_normal(2, 0.02)
#' vary_truncated(vary_normal(2, 0.02), low = 1.95)
#' design <- design_sobol(8,
#'   mass_kg = vary_uniform(1, 2), viscous_n_m_s = vary_lognormal(0.03, 1.2),
#'   coulomb_n_m = vary_triangular(0, 0.01, 0.02), omega0_rad_per_s = vary_loguniform(1, 100),
#'   radius_m = vary_values(c(0.2, 0.25, 0.3), weights = c(1, 2, 1)), seed = 1
#' )
#' design
#' design_rows(design)
#' @name vary_laws
NULL

#' @rdname vary_laws
#' @export
vary_uniform <- function(low, high, ...) {
  call <- check_no_dots(...)
  check_supplied(c("low", "high"), call)
  law <- new_vary("uniform", list(low = low, high = high), call)
  check_order(law, c("low", "high"), call)
  check_width(law, call)
}

#' @rdname vary_laws
#' @export
vary_loguniform <- function(low, high, ...) {
  call <- check_no_dots(...)
  check_supplied(c("low", "high"), call)
  law <- new_vary("loguniform", list(low = low, high = high), call)
  check_above(law$low, "low", 0, call)
  check_order(law, c("low", "high"), call)
}

#' @rdname vary_laws
#' @export
vary_normal <- function(mean, sd, ...) {
  call <- check_no_dots(...)
  check_supplied(c("mean", "sd"), call)
  law <- new_vary("normal", list(mean = mean, sd = sd), call)
  check_number(law$sd, "sd", "1", call, lower = 0)
  law
}

#' @rdname vary_laws
#' @export
vary_lognormal <- function(median, factor, ...) {
  call <- check_no_dots(...)
  check_supplied(c("median", "factor"), call)
  factor <- check_number(factor, "factor", "1", call, lower = 1)
  law <- new_vary("lognormal", list(median = median), call)
  check_above(law$median, "median", 0, call)
  new_law(c(list(kind = "lognormal", median = law$median, factor = factor), unit = law$unit))
}

#' @rdname vary_laws
#' @export
vary_triangular <- function(low, mode, high, ...) {
  call <- check_no_dots(...)
  check_supplied(c("low", "mode", "high"), call)
  law <- new_vary("triangular", list(low = low, mode = mode, high = high), call)
  check_order(law, c("low", "high"), call)
  check_width(law, call)
  check_number(law$mode, "mode", "1", call, lower = law$low, upper = law$high)
  law
}

#' @rdname vary_laws
#' @export
vary_truncated <- function(law, low = -Inf, high = Inf, ...) {
  call <- check_no_dots(...)
  check_supplied("law", call)
  check_vary(law, "law", call)
  if (law$kind == "values") {
    abort_rotdyn(c(
      "{.arg law} must be a distribution.", x = "It is a list of values.",
      i = "Choose those within the limits."
    ), "value", call)
  }
  low <- check_truncation(low, "low", law$unit, call)
  high <- check_truncation(high, "high", law$unit, call)
  if (low >= high) {
    abort_rotdyn(
      "{.arg low} must be below {.arg high}: {format(low)} is not below {format(high)}.",
      "value", call
    )
  }
  law$at_least <- limit_or_null(max(low, law$at_least %||% -Inf))
  law$at_most <- limit_or_null(min(high, law$at_most %||% Inf))
  law <- new_law(unclass(law)[c(setdiff(names(law), "unit"), intersect("unit", names(law)))])
  if (!is_law_sound(law)) {
    abort_rotdyn(c(
      "The truncation must leave some of the law.",
      x = "Between the limits it has no probability: {law_words(law)}."
    ), "value", call)
  }
  law
}

#' @rdname vary_laws
#' @export
vary_values <- function(x, weights = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  read <- read_quantities(x, "x", call)
  values <- check_finite(read$value, "x", "1", call)
  if (!length(values)) abort_rotdyn("{.arg x} must have at least one number.", "size", call)
  if (!is.null(weights)) {
    weights <- check_finite(weights, "weights", "1", call)
    if (length(weights) != length(values)) {
      abort_rotdyn(c(
        "{.arg weights} must have a number for each of {.arg x}.",
        x = "It has {length(weights)} for {length(values)}."
      ), "size", call)
    }
    check_not_negative(weights, "weights", "1", call)
    if (!(sum(weights) > 0) || !is.finite(sum(weights))) {
      abort_rotdyn("{.arg weights} must have a finite sum above 0.", "value", call)
    }
  }
  new_law(c(list(kind = "values", x = values), weights = list(weights)[!is.null(weights)],
            unit = read$unit))
}

#' @rdname vary_laws
#' @export
format.rot_vary <- function(x, ...) {
  check_vary(x, "x", current_env())
  law_words(x)
}

#' @rdname vary_laws
#' @export
print.rot_vary <- function(x, ...) {
  check_vary(x, "x", current_env())
  say("<rot_vary> ", law_words(x), "\n")
  invisible(x)
}

# ---- construction -------------------------------------------------------------------------------

# Elements that are NULL are absent.
new_law <- function(x) structure(x[!vapply(x, is.null, NA)], class = "rot_vary")

# Numbers in one unit, or all without.
new_vary <- function(kind, numbers, call) {
  read <- Map(function(x, arg) read_quantity(x, arg, call), numbers, names(numbers))
  units <- unlist(lapply(read, `[[`, "unit"))
  if (length(units) && length(units) < length(read)) {
    plain <- setdiff(names(read), names(units))
    abort_rotdyn(c(
      "The numbers of a law must all have a unit, or none.",
      x = "{.arg {plain}} {?has/have} none, {.arg {names(units)}} {?has/have} one."
    ), "unit", call)
  }
  unit <- if (length(units)) units[[1L]]
  values <- Map(function(x, arg) {
    check_number(if (is.null(unit)) x else as_si(x, unit, arg, call), arg, "1", call)
  }, numbers, names(numbers))
  new_law(c(list(kind = kind), values, unit = unit))
}

# The unit of a quantity, as text of the units package, or NULL.
unit_of <- function(x, arg, call) {
  if (inherits(x, "difftime")) return("s")
  if (!inherits(x, "units")) return(NULL)
  need_package("units", "An argument with units", call)
  if (!is.numeric(unclass(x)) || !inherits(attr(x, "units"), "symbolic_units")) {
    abort_quantity(x, arg, call)
  }
  tryCatch(units::deparse_unit(x), error = function(e) abort_quantity(x, arg, call))
}

# A number and its unit, which the design keeps beside it.
read_quantity <- function(x, arg, call) {
  unit <- unit_of(x, arg, call)
  list(value = check_number(if (is.null(unit)) x else as_si(x, unit, arg, call), arg, "1", call),
       unit = unit)
}

# The same for several; NaN and infinities are for the caller to judge.
read_quantities <- function(x, arg, call) {
  unit <- unit_of(x, arg, call)
  value <- check_column(if (is.null(unit)) x else as_si(x, unit, arg, call), arg, "1", call)
  attributes(value) <- NULL
  list(value = value, unit = unit)
}

check_vary <- function(law, arg, call) {
  check_class(law, "rot_vary", arg, "Make one with {.fn vary_normal} or another law.", call)
  if (!is_law_sound(law)) {
    abort_rotdyn(c(
      "{.arg {arg}} is a damaged law.", i = "Make it again with {.fn vary_normal} or another."
    ), "type", call)
  }
  law
}

# The core judges: a design with this input alone.
is_law_sound <- function(law) {
  design <- list(kind = "random", n = 1, seed = 1, inputs = list(x = unclass(law)))
  tryCatch(identical(.Call(ffi_design_size, design), 1) && law$kind != "fixed",
           error = function(e) FALSE)
}

check_above <- function(x, arg, lower, call) {
  check_number(x, arg, "1", call, lower = lower, open = TRUE)
}

check_order <- function(law, names, call) {
  ends <- unlist(unclass(law)[names])
  if (ends[1] >= ends[2]) {
    abort_rotdyn(c(
      "{.arg {names[1]}} must be below {.arg {names[2]}}.",
      x = "{format(ends[[1]])} is not below {format(ends[[2]])}.",
      i = if (ends[1] == ends[2]) "A plain number is fixed."
    ), "value", call)
  }
  law
}

check_width <- function(law, call) {
  if (is.finite(law$high - law$low)) return(law)
  abort_rotdyn("The range from {.arg low} to {.arg high} exceeds double precision.", "value", call)
}

# A limit of a truncation: infinite ones have no unit.
check_truncation <- function(x, arg, unit, call) {
  if (is.numeric(x) && length(x) == 1L && !is.object(x) && is.infinite(x)) return(as.double(x))
  read <- read_quantity(x, arg, call)
  if (is.null(unit) && is.null(read$unit)) return(read$value)
  if (is.null(unit) || is.null(read$unit)) {
    abort_rotdyn(c(
      "{.arg {arg}} must have a unit where the law has one, and only there.",
      x = if (is.null(unit)) "The law has none." else "The law is in {unit}."
    ), "unit", call)
  }
  check_number(as_si(x, unit, arg, call), arg, "1", call)
}

limit_or_null <- function(x) if (is.finite(x)) x

# ---- words --------------------------------------------------------------------------------------

law_words <- function(law) {
  number <- function(x) format(x, digits = 7)
  text <- switch(law$kind,
    fixed = number(law$value),
    column = count_words(law$x, "given"),
    values = paste0(count_words(law$x, "values"), if (!is.null(law$weights)) ", weighted"),
    uniform = paste("uniform,", number(law$low), "to", number(law$high)),
    loguniform = paste("log-uniform,", number(law$low), "to", number(law$high)),
    normal = paste0("normal, mean ", number(law$mean), ", sd ", number(law$sd)),
    lognormal = paste0("lognormal, median ", number(law$median), ", factor ",
                       number(law$factor)),
    triangular = paste0("triangular, ", number(law$low), " to ", number(law$high), ", mode ",
                        number(law$mode))
  )
  limits <- if (!is.null(law$at_least) && !is.null(law$at_most)) {
    paste(", truncated to", number(law$at_least), "to", number(law$at_most))
  } else if (!is.null(law$at_least)) {
    paste(", truncated to at least", number(law$at_least))
  } else if (!is.null(law$at_most)) {
    paste(", truncated to at most", number(law$at_most))
  }
  paste0(text, sub("^ ,", ",", limits %||% ""), if (!is.null(law$unit)) paste0(" (", law$unit, ")"))
}

# "5, 7, 9"; "12 values, 1 to 7".
count_words <- function(x, kind) {
  if (length(x) <= 5L && kind == "values") return(toString(vapply(x, format, "", digits = 7)))
  several <- length(x) > 1L
  paste0(format(length(x), big.mark = ","), if (kind == "given") " given number" else " value",
         if (several) "s", ", ", format(min(x), digits = 7),
         if (several) paste(" to", format(max(x), digits = 7)))
}

# ---- probabilities ------------------------------------------------------------------------------

# Share of a law's probability below `low` and above `high`.
design_probability_outside <- function(law, low, high) {
  x <- switch(law$kind, fixed = law$value, column = , values = law$x, normal = ,
              lognormal = if (is_point(law)) law$mean %||% law$median)
  if (!is.null(x)) {
    weights <- law$weights %||% rep(1, length(x))
    return(sum(weights[x < low | x > high]) / sum(weights))
  }
  from <- law$at_least %||% -Inf
  to <- law$at_most %||% Inf
  outside <- law_mass(law, from, max(min(low, to), from)) +
    law_mass(law, min(max(high, from), to), to)
  min(outside / law_mass(law, from, to), 1)
}

# A law without width.
is_point <- function(law) identical(law$sd, 0) || identical(law$factor, 1)

# Probability between two places, without truncation: by the tail that is smaller.
law_mass <- function(law, from, to) {
  upper <- law_tail(law, from, FALSE) < 0.5
  abs(law_tail(law, to, !upper) - law_tail(law, from, !upper))
}

# Probability below (lower) or above x.
law_tail <- function(law, x, lower) {
  switch(law$kind,
    uniform = stats::punif(x, law$low, law$high, lower.tail = lower),
    loguniform = stats::punif(log(max(x, 0)), log(law$low), log(law$high), lower.tail = lower),
    normal = stats::pnorm(x, law$mean, law$sd, lower.tail = lower),
    lognormal = stats::plnorm(x, log(law$median), log(law$factor), lower.tail = lower),
    triangular = triangular_tail(law, x, lower)
  )
}

triangular_tail <- function(law, x, lower) {
  if (x <= law$low) return(if (lower) 0 else 1)
  if (x >= law$high) return(if (lower) 1 else 0)
  width <- law$high - law$low
  rises <- x < law$mode
  part <- if (rises) (x - law$low)^2 / (law$mode - law$low) else
    (law$high - x)^2 / (law$high - law$mode)
  if (rises == lower) part / width else 1 - part / width
}
