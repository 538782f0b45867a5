#' Uncertainty of a function of measured numbers
#'
#' The combined standard uncertainty of any function, with the contribution of each quantity, the
#' effective degrees of freedom, an interval, and a check by random draws.
#' \deqn{u_i(y) = \tfrac12 \left[f(x_i + u_i) - f(x_i - u_i)\right],\quad
#'   u^2(y) = \sum_{ij} u_i(y)\, u_j(y)\, r_{ij},\quad
#'   \nu = u^4 / \sum_i u_i^4/\nu_i}{u_i(y) = (f(x_i + u_i) - f(x_i - u_i))/2,
#'   u^2(y) = sum_ij u_i(y) u_j(y) r_ij,  nu = u^4/sum u_i^4/nu_i}
#'
#' A quantity that enters several arguments (the same [measured()] object, or results that have it
#' in common) moves in all of them at once: it counts once. Quantities that are correlated through
#' `correlation` count as one in the degrees of freedom, with the fewest of theirs.
#'
#' **The check** draws the quantities from normal distributions: their standard deviation is
#' compared with u. The interval is drawn from t distributions with the degrees of freedom (JCGM
#' 101). Where an end differs from y +- t u by more than 5 % of the half width, the drawn interval
#' is reported.
#'
#' @param f A function of numbers that returns one number, or a vector of several quantities.
#' @param ... The arguments of `f`, by name or in order: [measured()] numbers, objects of the errors
#'   package, or exact numbers.
#' @param correlation Correlations of the arguments: a symmetric matrix with a row for each
#'   uncertain one, in order or with their names.
#' @param level Probability of the interval.
#' @param draws Number of draws; 0 for none.
#' @param seed Seed of the draws. The random numbers of the session stay unchanged.
#' @param x An `rot_uncertainty_budget`.
#' @return A list of class `rot_uncertainty_budget`: `value`, `u`, `dof` (one for each quantity that
#'   `f` returns), `interval` (a matrix with columns `lower` and `upper`), `interval_from`
#'   (`"formula"` or `"draws"`), `correlation` (of several results), `contributions` (a tibble:
#'   `output`, `input`, `value`, `u`, `dof`, `sensitivity`, `contribution` = u_i(y) with its sign,
#'   `share` of the variance), `draws` (a tibble: `output`, `u`, its own error `u_error`, `mean`,
#'   `lower`, `upper`, `agrees`) and `results`, the [measured()] numbers to go on with.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value` (a result that is not finite, a matrix
#'   that is no correlation), `rotdyn_error_size`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source JCGM 100:2008, clause 5.1.3 note 2 and annex G.4; JCGM 101:2008 for the draws. The
#'   example is H.2 of JCGM 100.
#' @seealso [measured()], [inertia_torsion()].
#' @concept uncertainty
#' @concept Monte Carlo
#' @concept GUM
#' @examples
#' # Resistance, reactance and impedance from five simultaneous readings.
#' readings <- cbind(
#'   v = c(5.007, 4.994, 5.005, 4.990, 4.999),
#'   i = c(19.663, 19.639, 19.640, 19.685, 19.678) / 1000,
#'   phi = c(1.0456, 1.0438, 1.0468, 1.0428, 1.0433)
#' )
#' uncertainty_budget(
#'   function(v, i, phi) c(R = v / i * cos(phi), X = v / i * sin(phi), Z = v / i),
#'   v = measured(readings[, "v"]), i = measured(readings[, "i"]),
#'   phi = measured(readings[, "phi"]),
#'   correlation = cor(readings)
#' )
#' @export
uncertainty_budget <- function(f, ..., correlation = NULL, level = 0.95, draws = 1e5, seed = 1) {
  call <- current_env()
  check_supplied("f", call)
  check_function(f, "f", call)
  level <- check_level(level, call)
  draws <- floor(check_number(draws, "draws", "1", call, lower = 0, upper = 1e8))
  seed <- check_number(seed, "seed", "1", call, lower = -2^31 + 1, upper = 2^31 - 1)
  given <- list(...)
  if (!length(given)) {
    abort_rotdyn(c(
      "{.arg ...} is empty: {.arg f} has no arguments.",
      i = "Give them as {.fn measured} numbers."
    ), "missing", call)
  }
  labels <- rlang::names2(given)
  formals <- setdiff(names(formals(args(f))), "...")
  free <- setdiff(formals, labels)
  # As R matches them, by the beginnings of names, too.
  unknown <- labels[nzchar(labels) & is.na(pmatch(labels, formals))]
  if (length(unknown) && !is.primitive(f) && !"..." %in% names(formals(f))) {
    abort_rotdyn(c(
      "{.arg f} has no argument {.arg {unknown[1]}}.", i = "It takes {.arg {formals}}."
    ), "argument", call)
  }
  blank <- which(!nzchar(labels))
  labels[blank] <- ifelse(
    seq_along(blank) <= length(free), free[seq_along(blank)], paste("argument", blank)
  )
  inputs <- Map(function(x, label) as_measured(x, label, "1", call), given, labels)
  for (k in seq_along(inputs)) {
    # A number with a name of its own keeps it in the table.
    one <- nrow(inputs[[k]]$parts) == 1L && identical(inputs[[k]]$name, inputs[[k]]$parts$name)
    if (one) inputs[[k]]$parts$name <- labels[k]
  }
  budget_of(f, inputs, names(given), correlation, level, draws, seed, call)
}

# `inputs`: measured numbers; `arg_names`: how f gets them.
budget_of <- function(f, inputs, arg_names, correlation, level, draws, seed, call) {
  x <- vapply(inputs, function(i) i$value, 0)
  evaluate <- function(x) {
    y <- do.call(f, stats::setNames(as.list(x), arg_names))
    if (!is_number(y) || is.object(y) || !length(y)) {
      abort_rotdyn(
        c("{.arg f} must return numbers.", x = "It returned {describe_value(y)}."), "type", call
      )
    }
    if (is.null(names(y))) {
      names(y) <- if (length(y) == 1L) "y" else paste0("y", seq_along(y))
    }
    storage.mode(y) <- "double"
    y
  }
  y <- evaluate(unname(x))
  if (!all(is.finite(y))) {
    abort_rotdyn(
      c("{.arg f} must be finite at the values given.", x = "It is {format(y)}."), "value", call
    )
  }
  shares <- shares_matrix(inputs)
  parts <- do.call(rbind, lapply(inputs, `[[`, "parts"))
  parts <- parts[match(colnames(shares), parts$id), ]
  p <- ncol(shares)
  moved <- matrix(0, length(y), p, dimnames = list(names(y), NULL))
  for (k in seq_len(p)) {
    up <- evaluate(unname(x + shares[, k]))
    down <- evaluate(unname(x - shares[, k]))
    if (length(up) != length(y) || length(down) != length(y)) {
      abort_rotdyn("{.arg f} must always return as many numbers.", "size", call)
    }
    if (!all(is.finite(c(up, down)))) {
      abort_rotdyn(c(
        "{.arg f} is not finite within a standard uncertainty of {.arg {parts$name[k]}}."
      ), "value", call)
    }
    moved[, k] <- (up - down) / 2
  }
  r <- correlation_matrix(correlation, inputs, parts, call)
  covariance <- moved %*% r %*% t(moved)
  u <- sqrt(pmax(diag(covariance), 0))
  # Independent parts: those of correlated quantities become combinations of them.
  root <- correlation_root(r)
  own <- parts
  parts <- independent_parts(parts, r)
  latent <- moved %*% root
  results <- lapply(seq_along(y), function(j) {
    measured_from_parts(y[[j]], transform(parts, u = latent[j, ]), names(y)[j])
  })
  names(results) <- names(y)
  dof <- vapply(results, function(m) m$dof, 0)
  half <- stats::qt((1 + level) / 2, dof) * u
  interval <- cbind(lower = unname(y) - half, upper = unname(y) + half)
  rownames(interval) <- names(y)
  own_u <- unname(sqrt(colSums(shares^2)))
  from <- rep("formula", length(y))
  check <- NULL
  if (draws > 0 && p > 0) {
    check <- draw_budget(evaluate, x, shares %*% root, parts, y, u, level, draws, seed, call)
    ends <- cbind(check$lower, check$upper)
    far <- apply(abs(ends - interval), 1, max) > 0.05 * half
    far[is.na(far)] <- FALSE
    interval[far, ] <- ends[far, ]
    from[far] <- "draws"
  }
  scale <- ifelse(u > 0, u, 1)
  variance <- if (p) t(moved * (moved %*% r)) / rep(scale^2, each = p) else matrix(0, 0, length(y))
  structure(
    list(
      value = y, u = stats::setNames(u, names(y)), dof = dof, level = level, interval = interval,
      interval_from = stats::setNames(from, names(y)),
      correlation = covariance / outer(scale, scale),
      contributions = as_table(
        output = rep(names(y), each = p), input = rep(own$name, length(y)),
        value = rep(part_values(inputs, own), length(y)), u = rep(own_u, length(y)),
        dof = rep(parts$dof, length(y)),
        sensitivity = as.double(t(moved)) / rep(own_u, length(y)),
        contribution = as.double(t(moved)), share = as.double(variance)
      ),
      draws = check, results = results
    ),
    class = "rot_uncertainty_budget"
  )
}

# The value of a part that is an argument; NA for one inside derived numbers.
part_values <- function(inputs, parts) {
  vapply(parts$id, function(id) {
    own <- Filter(function(i) identical(i$parts$id, id), inputs)
    if (length(own)) own[[1]]$value else NA_real_
  }, 0, USE.NAMES = FALSE)
}

# The correlations of the parts, from a matrix of the uncertain arguments.
correlation_matrix <- function(correlation, inputs, parts, call) {
  p <- nrow(parts)
  if (is.null(correlation)) return(diag(1, p, p))
  if (!is.matrix(correlation) || !is_number(correlation) || nrow(correlation) != p ||
    ncol(correlation) != p) {
    abort_rotdyn(c(
      "{.arg correlation} must be a matrix with a row and a column for each uncertain argument.",
      x = "It is {describe_value(correlation)}; {p} argument{?s} {?is/are} uncertain:
           {.arg {parts$name}}."
    ), "size", call)
  }
  several <- vapply(inputs, function(i) nrow(i$parts) > 1L, NA)
  if (any(several)) {
    abort_rotdyn(c(
      "{.arg correlation} is for quantities that were measured.",
      x = "{.arg {vapply(inputs[several], function(i) i$name, '')}} {?is a result/are results}
           with contributions of its own."
    ), "argument", call)
  }
  known <- rownames(correlation)
  if (!is.null(known) && all(parts$name %in% known)) {
    correlation <- correlation[parts$name, parts$name]
  }
  off <- max(abs(correlation - t(correlation)))
  if (anyNA(correlation) || max(abs(correlation)) > 1 + 1e-9 || off > 1e-9 ||
    max(abs(diag(correlation) - 1)) > 1e-9) {
    abort_rotdyn(c(
      "{.arg correlation} must be symmetric, with 1 on the diagonal and no element beyond 1."
    ), "value", call)
  }
  lowest <- min(eigen(correlation, symmetric = TRUE, only.values = TRUE)$values)
  if (lowest < -1e-6) {
    abort_rotdyn(c(
      "{.arg correlation} is no matrix of correlations.",
      x = "Its lowest eigenvalue is {format(lowest, digits = 2)}: a sum would have a negative
           variance."
    ), "value", call)
  }
  unname((correlation + t(correlation)) / 2)
}

# r = root root', also where r is singular.
correlation_root <- function(r) {
  if (!nrow(r) || all(r[upper.tri(r)] == 0)) return(r)
  e <- eigen(r, symmetric = TRUE)
  e$vectors %*% diag(sqrt(pmax(e$values, 0)), nrow(r))
}

# Identities and degrees of freedom of the independent combinations. A group is what is connected by
# correlations; its identities come from those of its members and their correlations.
independent_parts <- function(parts, r) {
  p <- nrow(parts)
  if (!p || all(r[upper.tri(r)] == 0)) return(parts)
  linked <- r != 0
  for (k in seq_len(p)) linked <- linked %*% linked > 0
  joint <- paste(c(parts$id, format(r[upper.tri(r)], digits = 15)), collapse = "|")
  for (k in seq_len(p)) {
    members <- linked[k, ]
    if (sum(members) == 1L) next
    parts$group[k] <- paste(parts$id[members], collapse = "|")
    parts$dof[k] <- min(parts$dof[members])
  }
  names <- parts$name
  for (k in seq_len(p)) parts$name[k] <- paste(names[linked[k, ]], collapse = ", ")
  parts$id <- paste0(joint, "#", seq_len(p))
  parts
}

draw_budget <- function(evaluate, x, shares, parts, y, u, level, draws, seed, call) {
  p <- nrow(parts)
  keep_random_numbers()
  set.seed(seed, "Mersenne-Twister", "Inversion", "Rejection")
  z <- matrix(stats::rnorm(draws * p), p)
  # t: the same scale for all of a group.
  scale <- matrix(1, p, draws)
  for (g in unique(parts$group[is.finite(parts$dof)])) {
    rows <- which(parts$group == g)
    dof <- min(parts$dof[rows])
    scale[rows, ] <- rep(sqrt(dof / stats::rchisq(draws, dof)), each = length(rows))
  }
  normal <- evaluate_draws(evaluate, x + shares %*% z, length(y), call)
  student <- if (all(scale == 1)) normal else {
    evaluate_draws(evaluate, x + shares %*% (z * scale), length(y), call)
  }
  tail <- (1 - level) / 2
  rows <- lapply(seq_along(y), function(j) {
    a <- normal[j, ][is.finite(normal[j, ])]
    b <- student[j, ][is.finite(student[j, ])]
    if (length(a) < 0.9 * draws || length(b) < 0.9 * draws) {
      return(data.frame(u = NA, u_error = NA, mean = NA, lower = NA, upper = NA, agrees = FALSE))
    }
    s <- stats::sd(a)
    # Of a standard deviation, with the kurtosis of the draws.
    fourth <- mean((a - mean(a))^4)
    error <- if (s > 0) sqrt(max(fourth - s^4, 0) / length(a)) / (2 * s) else 0
    ends <- unname(stats::quantile(b, c(tail, 1 - tail), type = 7))
    data.frame(
      u = s, u_error = error, mean = mean(a), lower = ends[1], upper = ends[2],
      agrees = abs(s - u[j]) <= 3 * error
    )
  })
  rows <- do.call(rbind, rows)
  table_from(cbind(output = names(y), rows))
}

# All draws in one call where f takes vectors, else one by one.
evaluate_draws <- function(evaluate, x, outputs, call) {
  draws <- ncol(x)
  quiet <- function(expr) tryCatch(suppressWarnings(expr), error = function(e) NULL)
  one <- function(k) quiet(evaluate(unname(x[, k]))) %||% rep(NA_real_, outputs)
  f_vector <- function() {
    y <- quiet(evaluate(lapply(seq_len(nrow(x)), function(i) x[i, ])))
    if (length(y) != outputs * draws) return(NULL)
    y <- matrix(y, outputs, byrow = TRUE)
    some <- unique(round(seq(1, draws, length.out = 5)))
    same <- vapply(some, function(k) isTRUE(all.equal(unname(one(k)), y[, k])), NA)
    if (all(same)) y
  }
  f_vector() %||% matrix(vapply(seq_len(draws), one, double(outputs)), outputs)
}

# Restores the session's random numbers when the calling function ends.
keep_random_numbers <- function(frame = parent.frame()) {
  world <- globalenv()
  seed <- world[[".Random.seed"]]
  kind <- RNGkind()
  restore <- function() {
    do.call(RNGkind, as.list(kind))
    if (is.null(seed)) {
      if (exists(".Random.seed", world, inherits = FALSE)) rm(".Random.seed", envir = world)
    } else {
      assign(".Random.seed", seed, envir = world)
    }
  }
  do.call(on.exit, list(substitute(f(), list(f = restore)), add = TRUE), envir = frame)
}

budget_form <- list(
  .class = "rot_uncertainty_budget", value = "numbers", u = "numbers=value", dof = "limits=value",
  level = "number", interval_from = "texts=value", correlation = "values", interval = "values",
  contributions = list(
    output = "texts", input = "texts=output", value = "values=output", u = "values=output",
    contribution = "values=output", share = "values=output"
  )
)

check_budget <- function(x, arg, call) {
  check_class(
    x, "rot_uncertainty_budget", arg, "Make one with {.fn uncertainty_budget}.", call
  )
  check_form(x, budget_form, arg, "uncertainty budget", call)
  n <- length(x$value)
  whole <- n > 0L && length(names(x$value)) == n && identical(dim(x$interval), c(n, 2L)) &&
    identical(dim(x$correlation), c(n, n)) && all(x$contributions$output %in% names(x$value))
  if (!whole) abort_form("value", arg, "uncertainty budget", call)
  x
}

#' @rdname uncertainty_budget
#' @export
print.rot_uncertainty_budget <- function(x, ...) {
  check_budget(x, "x", current_env())
  several <- length(x$value) > 1L
  for (j in seq_along(x$value)) {
    say(
      names(x$value)[j], " = ", format_concise(x$value[[j]], x$u[[j]]),
      if (is.finite(x$dof[[j]])) {
        paste0(", ", format(x$dof[[j]], digits = 3), " degrees of freedom")
      },
      "; ", format(100 * x$level), " % interval ",
      paste(format_si(x$interval[j, ], 6), collapse = " to "),
      if (x$interval_from[[j]] == "draws") " (from draws: the formula's differs)", "\n"
    )
    rows <- x$contributions[x$contributions$output == names(x$value)[j], ]
    rows <- rows[order(-abs(rows$contribution)), ]
    if (!several && nrow(rows)) {
      shown <- cbind(
        input = rows$input, value = format_si(rows$value, 7), u = format_si(rows$u, 2),
        contribution = format_si(rows$contribution, 2),
        share = paste(round(100 * rows$share, 1), "%")
      )
      lines <- apply(rbind(colnames(shown), shown), 2, format, justify = "right")
      say(paste0("  ", apply(lines, 1, paste, collapse = "  "), "\n"))
    }
  }
  if (several) {
    r <- x$correlation
    pairs <- which(upper.tri(r), arr.ind = TRUE)
    say("correlations: ", paste0(
      rownames(r)[pairs[, 1]], " ", colnames(r)[pairs[, 2]], " ", format(r[pairs], digits = 3),
      collapse = ", "
    ), "\n")
  }
  if (!is.null(x$draws)) {
    say("draws: u = ", paste(format_si(x$draws$u, 4), collapse = ", "), if (all(x$draws$agrees)) {
      " (agrees)"
    } else {
      " (differs: the function is curved within the uncertainties)"
    }, "\n")
  }
  invisible(x)
}
