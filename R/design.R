# Designs: which rows a sweep has, as a rule from the number of a row to its inputs. Plain data; C
# computes the rows (src/core/design/).

#' Designs: the rows of a sweep by their number
#'
#' A design says which values the inputs of a scene have in each row of a sweep. It is a rule of
#' some hundred bytes, not a table: any row is computed at once from its number, the same in every
#' session and in any order, whatever the number of rows.
#'
#' | design | rows |
#' |---|---|
#' | `design_grid(...)` | every combination of numbers; the first input changes fastest |
#' | `design_list(data)` | the rows of a data frame |
#' | `design_random(n, ...)` | independent random rows |
#' | `design_latin(n, ...)` | a Latin hypercube: one row in each of n intervals of equal probability, for each input |
#' | `design_sobol(n, ...)` | points of Sobol's sequence, scrambled with a `seed`: evenly spread in all inputs together |
#' | `design_saltelli(n, ...)` | n pairs of Sobol points A and B, each followed by A with one input from B, for Sobol indices: n (d + 2) rows for d inputs that vary |
#'
#' Random numbers are Philox 4x32-10 of (seed, row, column), so that a row needs no row before it.
#' Sobol points are in the order of the Gray code, with 52 bits; a power of two of them is best, and
#' the print says so. They are computed for up to 64 inputs that vary, of a Saltelli design for 32.
#' Without a seed the first point, 0, is moved to \eqn{2^{-53}}{2^-53}. A Latin hypercube is not
#' optimised: its strata are permutations of the row numbers.
#'
#' @param n Number of rows, of base points for `design_saltelli()`: 1 to 2^52. For `design_rows()`:
#'   how many rows.
#' @param ... Inputs by name, each a [law][vary_laws] or a number, which is fixed; for
#'   `design_grid()` numbers, one or several. Any names will do, also paths such as
#'   `` `body$mass_kg` ``: the sweep looks for them. For other functions: not used.
#' @param seed A whole number from 0 to 2^53. The same seed gives the same rows. NULL (Sobol
#'   alone): not scrambled.
#' @param data A data frame of numbers without missing values.
#' @param design,x A design.
#' @param first Number of the first row, from 1.
#' @return `design_grid()` and so on: an object of class `rot_design`, a list of plain data: `kind`,
#'   `n`, `seed`, `inputs` and, of a [correlated][correlate] one, `correlation`.
#'
#'   `design_rows()`: a tibble with the number of the `row` and a column for each input; fewer than
#'   n rows at the end.
#' @section Units: Numbers are in SI units, as those of the scene. Objects of the units package are
#'   kept as numbers in their own unit, with the `unit` beside them in `inputs`: `design_rows()`
#'   shows these numbers, the sweep converts them.
#' @section Errors: `rotdyn_error_value` for a number of rows, a seed, a name or a value outside its
#'   domain, no input that varies, or too many; `rotdyn_error_missing` without a seed;
#'   `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_unit`, `rotdyn_error_argument`.
#' @source Salmon, Moraes, Dror and Shaw, Parallel random numbers: as easy as 1, 2, 3, SC11 (2011);
#'   Joe and Kuo, SIAM J. Sci. Comput. 30, 2635 (2008), for the direction numbers; Owen, in Monte
#'   Carlo and Quasi-Monte Carlo Methods in Scientific Computing, 299 (1995), for the scrambling;
#'   McKay, Beckman and Conover, Technometrics 21, 239 (1979); Saltelli and others, Comput. Phys.
#'   Commun. 181, 259 (2010).
#' @seealso [vary_laws] for the laws, [correlate()].
#' @concept sweep
#' @concept design of experiments
#' @concept Monte Carlo
#' @concept Latin hypercube
#' @concept quasi-random numbers
#' @examples
#' wheels <- design_sobol(2^30,
#'   mass_kg = vary_normal(2, 0.02), radius_m = vary_uniform(0.24, 0.26), seed = 42
#' )
#' wheels
#' # Any rows, at once.
#' design_rows(wheels, first = 5e8, n = 3)
#'
#' design_rows(design_grid(mass_kg = c(1, 2), radius_m = c(0.2, 0.25, 0.3)))
#' design_rows(design_list(data.frame(mass_kg = c(1, 1.5))))
#' design_random(1000, mass_kg = vary_uniform(1, 2), seed = 1)
#' design_latin(1000, mass_kg = vary_uniform(1, 2), seed = 1)
#' design_saltelli(1024, mass_kg = vary_uniform(1, 2), radius_m = vary_uniform(0.2, 0.3), seed = 1)
#' @name designs
NULL

#' @rdname designs
#' @export
design_grid <- function(...) {
  new_design("grid", 1, list(...), NULL, current_env())
}

#' @rdname designs
#' @export
design_list <- function(data, ...) {
  call <- check_no_dots(...)
  check_supplied("data", call)
  if (!is.data.frame(data)) {
    abort_rotdyn(
      c("{.arg data} must be a data frame.", x = "It is {describe_value(data)}."), "type", call
    )
  }
  if (!nrow(data)) abort_rotdyn("{.arg data} must have at least one row.", "size", call)
  new_design("list", nrow(data), as.list(data), NULL, call)
}

#' @rdname designs
#' @export
design_random <- function(n, ..., seed) {
  call <- current_env()
  check_drawn(call)
  new_design("random", n, list(...), seed, call)
}

#' @rdname designs
#' @export
design_latin <- function(n, ..., seed) {
  call <- current_env()
  check_drawn(call)
  new_design("latin", n, list(...), seed, call)
}

#' @rdname designs
#' @export
design_sobol <- function(n, ..., seed = NULL) {
  call <- current_env()
  check_drawn(call)
  new_design("sobol", n, list(...), seed, call)
}

#' @rdname designs
#' @export
design_saltelli <- function(n, ..., seed) {
  call <- current_env()
  check_drawn(call)
  new_design("saltelli", n, list(...), seed, call)
}

#' @rdname designs
#' @export
design_rows <- function(design, first = 1, n = 6, ...) {
  call <- check_no_dots(...)
  check_supplied("design", call)
  size <- check_design(design, "design", call)
  first <- check_whole(first, "first", call, 1, size)
  n <- check_whole(n, "n", call, 0, 2^31 - 1)
  n <- min(n, size - first + 1)
  columns <- .Call(ffi_design_rows, design, first - 1, n)
  names(columns) <- names(design$inputs)
  new_table(c(list(row = first - 1 + seq_len(n)), columns), nrow = as.integer(n))
}

#' @rdname designs
#' @export
print.rot_design <- function(x, ...) {
  size <- check_design(x, "x", current_env())
  count <- function(n) format(n, big.mark = ",", scientific = FALSE)
  say("<rot_design> ", design_words[[x$kind]], ", ", count(size), " row", if (size != 1) "s",
      if (x$kind == "saltelli") paste0(" of ", count(x$n), " base points"),
      if (!is.null(x$seed)) paste0(", seed ", format(x$seed, digits = 16, scientific = FALSE)),
      if (x$kind == "sobol" && is.null(x$seed)) ", not scrambled", "\n")
  width <- max(nchar(names(x$inputs)), 10L)
  for (name in names(x$inputs)) {
    say("  ", escape_controls(name), strrep(" ", width - nchar(name)), "  ",
        law_words(x$inputs[[name]]), "\n")
  }
  if (!is.null(x$correlation)) {
    say("  correlated: ", correlation_words(x$correlation), "\n")
  }
  near <- 2^floor(log2(x$n))
  if (x$kind %in% c("sobol", "saltelli") && x$n != near) {
    say("  ", count(x$n), " is no power of two: ", count(near), " or ", count(2 * near),
        " points are spread more evenly\n")
  }
  say("  any row at once: design_rows(design, first = ", format(size, scientific = FALSE), ")\n")
  invisible(x)
}

design_words <- c(
  grid = "grid", list = "list", random = "random", latin = "Latin hypercube", sobol = "Sobol",
  saltelli = "Saltelli"
)

#' Correlated inputs of a design
#'
#' Gives inputs of a design correlated normal scores, of which their laws take the quantiles:
#' \deqn{x_i = F_i^{-1}(\Phi(z_i)),\quad z = L\,\Phi^{-1}(u),\quad L L^T = R}{x_i =
#'   F_i^-1(Phi(z_i)),  z = L Phi^-1(u),  L L^T = R}
#' Each input keeps its law. For normal laws R is the correlation of the inputs themselves, for
#' lognormal ones that of their logarithms; for others theirs is a little smaller.
#'
#' The first of the correlated inputs keeps its coordinates, so that of a Latin hypercube or a net
#' of Sobol points only this one and those that are not correlated keep their strata.
#'
#' @param design A design: [design_random()], [design_latin()] or [design_sobol()].
#' @param matrix Correlations R: symmetric, with ones on the diagonal, positive definite, rows and
#'   columns named by inputs that vary, at least two. NULL: no correlation.
#' @param ... Not used: an unknown argument is an error.
#' @return The design, with `correlation`.
#' @section Errors: `rotdyn_error_value` for a matrix that is not positive definite, or no matrix of
#'   correlations, for names of other inputs, and for designs of other kinds; `rotdyn_error_type`,
#'   `rotdyn_error_size`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Iman and Conover, Communications in Statistics B 11, 311 (1982); Owen, Monte Carlo
#'   theory, methods and examples (2013), section 5.4.
#' @seealso [design_sobol()], [vary_laws].
#' @concept correlation
#' @concept copula
#' @examples
#' r <- matrix(c(1, 0.8, 0.8, 1), 2)
#' rownames(r) <- c("mass_kg", "radius_m")
#' discs <- design_sobol(1024, seed = 1,
#'   mass_kg = vary_normal(2, 0.02), radius_m = vary_normal(0.25, 0.001)
#' )
#' rows <- design_rows(correlate(discs, r), n = 1024)
#' cor(rows$mass_kg, rows$radius_m)
#' @export
correlate <- function(design, matrix, ...) {
  call <- check_no_dots(...)
  check_supplied(c("design", "matrix"), call)
  check_design(design, "design", call)
  if (!design$kind %in% c("random", "latin", "sobol")) {
    abort_rotdyn(c(
      "{.arg design} must be random, a Latin hypercube or Sobol points.",
      x = "It is of the kind {.val {design$kind}}."
    ), "value", call)
  }
  design$correlation <- NULL
  if (is.null(matrix)) return(design)
  given <- check_correlation(matrix, call)
  varied <- names(Filter(function(law) law$kind != "fixed", design$inputs))
  other <- setdiff(rownames(given), varied)
  if (length(other)) {
    abort_rotdyn(c(
      "{.arg matrix} must have the names of inputs that vary.",
      x = "Not among them: {.field {other}}.", i = "They are {.field {varied}}."
    ), "value", call)
  }
  names <- intersect(names(design$inputs), rownames(given))
  design$correlation <- list(inputs = names, matrix = as.double(given[names, names]))
  design
}

# ---- checks -------------------------------------------------------------------------------------

check_whole <- function(x, arg, call, lower, upper) {
  # Large ones with all digits.
  if (is.double(x) && length(x) == 1L && !is.object(x) && isTRUE(x > upper) && is.finite(x) &&
    upper > 1e6) {
    abort_rotdyn(c(
      "{.arg {arg}} must be between {whole_words(lower)} and {whole_words(upper)}.",
      x = "It is {whole_words(x)}."
    ), "value", call)
  }
  x <- check_number(x, arg, "1", call, lower = lower, upper = upper)
  if (x != round(x)) {
    abort_rotdyn("{.arg {arg}} must be a whole number: it is {format(x)}.", "value", call)
  }
  x
}

# Whole numbers with all their digits: "100000", "4503599627370496".
whole_words <- function(x) {
  vapply(x, function(one) format(one, digits = 16, scientific = abs(one) > 1e16), "")
}

# Required arguments beside inputs in the dots.
check_drawn <- function(call) {
  hints <- c(
    n = "It is the number of rows.",
    seed = "The same seed gives the same rows, in every session: choose a whole number."
  )
  for (name in intersect(required_arguments(rlang::frame_fn(call)), names(hints))) {
    if (eval(bquote(missing(.(as.name(name)))), call)) {
      abort_rotdyn(
        c("{.arg {name}} is missing: it has no default.", i = hints[[name]]), "missing", call
      )
    }
  }
}

new_design <- function(kind, n, inputs, seed, call) {
  n <- check_whole(n, "n", call, 1, 2^52)
  if (!is.null(seed)) {
    seed <- check_whole(seed, "seed", call, 0, 2^53)
  } else if (kind %in% c("random", "latin", "saltelli")) {
    abort_rotdyn("{.arg seed} must be a number: only Sobol points need none.", "type", call)
  }
  check_input_names(inputs, kind, call)
  inputs <- Map(function(x, name) input_of(x, name, kind, call), inputs, names(inputs))
  varied <- sum(vapply(inputs, function(law) law$kind != "fixed", NA))
  levels <- pmax(lengths(lapply(inputs, `[[`, "x")), 1)
  rows <- n * switch(kind, saltelli = varied + 2, grid = prod(levels), 1)
  check_numbers_varied(kind, varied, call)
  if (rows > 2^52) {
    abort_rotdyn("A design has at most 2^52 rows: these are {format(rows)}.", "value", call)
  }
  if (kind == "grid") n <- rows
  design <- structure(c(list(kind = kind, n = n), seed = seed, list(inputs = inputs)),
                      class = "rot_design")
  check_design(design, "design", call)
  design
}

check_input_names <- function(inputs, kind, call) {
  what <- if (kind == "list") "Columns of {.arg data}" else "Inputs"
  if (!length(inputs)) {
    abort_rotdyn("A design needs at least one input.", "size", call)
  }
  names <- names(inputs)
  if (is.null(names) || anyNA(names) || !all(nzchar(names))) {
    abort_rotdyn(c(
      paste(what, "must have names."), i = "For example {.code mass_kg = vary_uniform(1, 2)}."
    ), "argument", call)
  }
  if (!is_readable_text(names)) abort_unreadable(names, "names", call)
  twice <- unique(names[duplicated(names)])
  if (length(twice)) {
    abort_rotdyn(paste(what, "must have different names: {.field {twice}} is there twice."),
                 "value", call)
  }
  if ("row" %in% names) {
    abort_rotdyn("No input may have the name {.field row}, the number of the row.", "value", call)
  }
}

check_numbers_varied <- function(kind, varied, call) {
  if (kind %in% c("grid", "list")) return(invisible())
  max_varied <- switch(kind, sobol = 64, saltelli = 32, Inf)
  if (!varied) {
    abort_rotdyn(c(
      "At least one input must vary.", i = "{.fn vary_uniform} and others are laws of an input."
    ), "value", call)
  }
  if (varied > max_varied) {
    abort_rotdyn(c(
      "This design takes up to {max_varied} inputs that vary.", x = "There are {varied}.",
      i = "{.fn design_random} and {.fn design_latin} take more."
    ), "value", call)
  }
}

# What was given for an input => its law, as plain data.
input_of <- function(x, name, kind, call) {
  if (inherits(x, "rot_vary")) {
    check_vary(x, name, call)
    if (kind == "list" || (kind == "grid" && (x$kind != "values" || !is.null(x$weights)))) {
      abort_rotdyn(c(
        "{.arg {name}} must be numbers.", x = "It is a law: {law_words(x)}.",
        i = "{.fn design_sobol} and {.fn design_random} take laws."
      ), "type", call)
    }
    return(unclass(x))
  }
  read <- read_quantities(x, name, call)
  if (anyNA(read$value)) {
    at <- which(is.na(read$value))[1]
    abort_rotdyn(
      c("{.arg {name}} must have no missing value.", x = "Element {at} is {read$value[at]}."),
      "value", call
    )
  }
  if (!length(read$value)) abort_rotdyn("{.arg {name}} must have a number.", "size", call)
  if (kind == "list") return(c(list(kind = "column", x = read$value), unit = read$unit))
  if (length(read$value) == 1L) {
    return(c(list(kind = "fixed", value = read$value), unit = read$unit))
  }
  if (kind == "grid") return(c(list(kind = "values", x = read$value), unit = read$unit))
  abort_rotdyn(c(
    "{.arg {name}} must be a law or one number.", x = "It has {length(read$value)} numbers.",
    i = "{.fn vary_values} draws from them, {.fn design_grid} combines them."
  ), "size", call)
}

# Returns the number of rows.
check_design <- function(design, arg, call) {
  remedy <- "Make one with {.fn design_sobol} or another design."
  check_class(design, "rot_design", arg, remedy, call)
  size <- tryCatch(.Call(ffi_design_size, design), error = function(e) NULL)
  names <- if (!is.null(size)) names(.subset2(design, "inputs"))
  if (is.null(size) || anyNA(names) || !all(nzchar(names)) || anyDuplicated(names) ||
    !is_readable_text(names) || "row" %in% names) {
    abort_rotdyn(c(
      "{.arg {arg}} is a damaged design.", i = "Make it again with {.fn design_sobol} or another."
    ), "type", call)
  }
  size
}

# A matrix of correlations, with names on both sides.
check_correlation <- function(x, call) {
  if (!is.matrix(x) || !is.numeric(x) || is.object(x)) {
    abort_rotdyn(
      c("{.arg matrix} must be a matrix of numbers.", x = "It is {describe_value(x)}."),
      "type", call
    )
  }
  if (nrow(x) != ncol(x) || nrow(x) < 2L) {
    abort_rotdyn(c(
      "{.arg matrix} must have as many columns as rows, at least two.",
      x = "It has {nrow(x)} row{?s} and {ncol(x)} column{?s}."
    ), "size", call)
  }
  names <- rownames(x) %||% colnames(x)
  same <- is.null(colnames(x)) || identical(colnames(x), names)
  if (is.null(names) || anyNA(names) || anyDuplicated(names) || !same) {
    abort_rotdyn(c(
      "{.arg matrix} must have the names of the inputs.",
      i = "Its rows or its columns have them, once each, in the same order."
    ), "value", call)
  }
  dimnames(x) <- list(names, names)
  storage.mode(x) <- "double"
  sound <- all(is.finite(x)) && identical(unname(x), unname(t(x))) && all(diag(x) == 1) &&
    all(abs(x) <= 1)
  if (!sound) {
    abort_rotdyn(c(
      "{.arg matrix} must be one of correlations.",
      i = "They are from -1 to 1, the same on both sides of the diagonal, and 1 on it."
    ), "value", call)
  }
  lowest <- min(eigen(x, symmetric = TRUE, only.values = TRUE)$values)
  if (lowest <= 1e-14 * nrow(x)) {
    abort_rotdyn(c(
      "{.arg matrix} must be positive definite.",
      x = "Its lowest eigenvalue is {format(lowest, digits = 2)}: no inputs have such correlations."
    ), "value", call)
  }
  x
}

# "mass_kg, radius_m 0.8; ..." of the largest ones.
correlation_words <- function(correlation) {
  n <- length(correlation$inputs)
  r <- matrix(correlation$matrix, n)
  pair <- which(upper.tri(r) & r != 0, arr.ind = TRUE)
  if (!nrow(pair)) return("none")
  pair <- pair[order(-abs(r[pair])), , drop = FALSE]
  shown <- pair[seq_len(min(nrow(pair), 3L)), , drop = FALSE]
  more <- nrow(pair) - nrow(shown)
  paste0(
    paste0(correlation$inputs[shown[, 1]], ", ", correlation$inputs[shown[, 2]], " ",
           format(r[shown], digits = 3, trim = TRUE), collapse = "; "),
    if (more) paste0("; ", more, " more")
  )
}
