# From the core's fit to its table: intervals, what the record does not determine, verbs.

fit_dof <- function(found, about) {
  if (!is.character(about$noise)) return(Inf)
  noise <- matrix(found$noise, noise_numbers)
  spans <- unlist(lapply(about$records, function(r) {
    rep(diff(range(r$time_s)), length(r$series))
  }))
  n <- Map(noise_dof, noise[1L, ], spans, noise[3L, ], noise[4L, ])
  max(sum(unlist(n)) - nrow(about$parameters), 2)
}

# Standard errors within which the error is, at a level: Student's t where it is normal; more where
# a part of its variance is that of a sine of random phase. That the sine has an end is not used:
# its size is an estimate.
errors_within <- function(wave, level, dof) {
  normal <- stats::qt((1 + level) / 2, dof)
  if (wave < 0.05) return(normal)
  sine <- sqrt(2 * wave) * cos(pi * (seq_len(64) - 0.5) / 64)
  inside <- function(x) {
    mean(stats::pnorm(x - sine, sd = sqrt(1 - wave)) - stats::pnorm(-x - sine, sd = sqrt(1 - wave)))
  }
  z <- stats::uniroot(function(x) inside(x) - level, c(0, 2 + normal), tol = 1e-4)$root
  normal * max(z / stats::qnorm((1 + level) / 2), 1)
}

# Directions in which the motion does not change, in the fit's variables: columns of unit vectors,
# and which unknowns take part. Differences of motions have some ten digits.
free_directions <- function(found, about) {
  m <- nrow(about$parameters)
  moved <- found$held == 0
  r <- matrix(found$triangle, m, byrow = TRUE)[moved, moved, drop = FALSE]
  if (!length(r) || !all(is.finite(r))) return(NULL)
  length <- sqrt(colSums(r^2))
  length[length == 0] <- 1 # one that moves nothing
  parts <- svd(t(t(r) / length))
  none <- parts$d < max(parts$d) * 3e-7
  if (!any(none)) return(NULL)
  v <- matrix(0, m, sum(none))
  v[moved, ] <- parts$v[, none, drop = FALSE] / length
  v <- t(t(v) / apply(abs(v), 2L, max))
  list(v = v, takes_part = rowSums(abs(v) > 1e-3) > 0)
}

new_scene_fit <- function(about, found, call) {
  p <- about$parameters
  m <- nrow(p)
  x <- found$x
  spread <- matrix(found$covariance, m, byrow = TRUE)
  error <- sqrt(diag(spread)) * ifelse(p$log, x, 1)
  dof <- fit_dof(found, about)
  half <- sqrt(diag(spread)) * vapply(found$wave, errors_within, 0, about$level, dof)
  lower <- ifelse(p$log, x * exp(-half), x - half)
  upper <- ifelse(p$log, x * exp(half), x + half)
  status <- rep("determined", m)
  held <- found$held != 0
  free <- found$free
  lost <- if (is.null(free)) rep(FALSE, m) else free$takes_part
  failed <- found$numbers[1] != 0
  error[lost | failed | held] <- NaN
  lower[lost | failed] <- NaN
  upper[lost | failed] <- NaN
  lower <- pmax(lower, p$low)
  upper <- pmin(upper, p$high)
  status[held] <- ifelse(found$held[held] < 0, "at its lower limit", "at its upper limit")
  status[lost] <- "not determined"
  if (failed) status[] <- "not converged"
  if (is.null(found$model)) found$model <- model_of_run(about$problem$run)
  fit <- list(
    about = about, found = found, spread = spread, dof = dof, free = free, failed = failed,
    identity = new_identity()
  )
  if (!failed && any(held)) {
    edge <- edge_limits(fit, which(held), call)
    lower[held] <- edge$lower
    upper[held] <- edge$upper
  }
  if (failed) {
    warn_rotdyn(c(
      "The fit did not converge after {found$numbers[5]} steps; the best so far is returned.",
      i = "Another start, or fewer unknowns, may help: {.arg starts} tries some."
    ), "fit", call)
  }
  new_table(list(
    unknown = p$label, record = ifelse(p$record == 0L, NA_character_, vapply(p$record, function(r) {
      if (r == 0L) NA_character_ else about$records[[r]]$name
    }, "")),
    value = x, standard_error = error, lower = lower, upper = upper,
    unit = about$problem$unit, status = status
  ), nrow = m, class = "rot_fit", fit = fit)
}

fit_of <- function(x, call, arg = "x") {
  check_class(x, "rot_fit", arg, "Make one with {.fn fit_scene}.", call)
  attr(x, "fit", exact = TRUE)
}

# The sum of squares with unknown k fixed at a value, weighed by the noise that was found; Inf where
# there is none.
fixed_squares <- function(fit, k, value) {
  problem <- fit$about$problem
  problem$start <- fit$found$x
  problem$start[k] <- problem$low[k] <- problem$high[k] <- value
  problem$logarithm[k] <- 0
  problem$given <- fit$found$noise
  found <- tryCatch(.Call(ffi_fit, problem, NULL), rotdyn_error = function(e) NULL)
  if (is.null(found) || !is.null(found$refused) || found$numbers[1] != 0) Inf else found$numbers[2]
}

# Of unknowns at an edge of their domain: the other end of a one-sided interval, where the least sum
# of squares has grown by t^2.
edge_limits <- function(fit, held, call) {
  x <- fit$found$x
  grown <- stats::qt(fit$about$level, fit$dof)^2
  lower <- upper <- x[held]
  for (i in seq_along(held)) {
    k <- held[i]
    side <- if (fit$found$held[k] < 0) 1 else -1
    base <- fixed_squares(fit, k, x[k])
    rise <- function(h) min(fixed_squares(fit, k, x[k] + side * h) - base - grown, 1e6)
    unit <- max(abs(x[k]), 1e-3)
    h <- 1e-3 * unit
    while (h < 1e12 && rise(h) < 0) h <- 2 * h
    while (h > 1e-12 * unit && rise(h / 2) > 0) h <- h / 2
    # Without a rise the record gives no limit; below 1e-12 it gives that.
    root <- if (rise(h) < 0) Inf else if (rise(h / 2) > 0) h else {
      stats::uniroot(rise, c(h / 2, h), tol = 0.01 * h)$root
    }
    if (side > 0) upper[i] <- x[k] + root else lower[i] <- x[k] - root
  }
  list(lower = lower, upper = upper)
}

# ---- words --------------------------------------------------------------------------------------

# "body[1], body[2], body[3]: only their ratios"
free_words <- function(fit) {
  if (is.null(fit$free)) return(character())
  p <- fit$about$parameters
  x <- fit$found$x
  apply(fit$free$v, 2L, function(v) {
    who <- which(abs(v) > 1e-3)
    if (length(who) == 1L) return(paste0(p$name[who], ": not at all"))
    relative <- ifelse(p$log[who], v[who], v[who] / x[who])
    relative <- relative / relative[which.max(abs(relative))]
    what <- if (all(abs(relative - 1) < 1e-3)) {
      if (length(who) == 2L) "only their ratio" else "only their ratios"
    } else if (length(who) == 2L && abs(sum(relative)) < 1e-3) {
      "only their product"
    } else {
      "only a combination"
    }
    paste0(paste(p$name[who], collapse = ", "), ": ", what)
  })
}

#' @export
print.rot_fit <- function(x, ...) {
  fit <- attr(x, "fit", exact = TRUE)
  whole <- all(fit_columns %in% names(x)) && nrow(x) == nrow(fit$about$parameters)
  if (is.null(fit) || !whole) return(NextMethod())
  about <- fit$about
  numbers <- fit$found$numbers
  say("<rot_fit> ", setdiff(names(about$node), "scene_format")[1], ", ",
      format(numbers[4], big.mark = ","), " samples of ",
      paste(unique(unlist(lapply(about$records, function(r) names(r$series)))), collapse = ", "),
      if (length(about$records) > 1L) paste0(", ", length(about$records), " records"), "\n")
  value <- ifelse(is.nan(x$standard_error), format_each(signif(x$value, 6)),
                  vapply(seq_along(x$value), function(i) {
                    if (is.nan(x$standard_error[i])) "" else
                      with_error(x$value[i], x$standard_error[i])
                  }, ""))
  unit <- ifelse(is.na(x$unit) | x$unit == "1", "", x$unit)
  name <- ifelse(is.na(x$record), x$unknown, paste0(x$unknown, " (", x$record, ")"))
  # As many digits as show the width.
  digits <- ceiling(log10(pmax(abs(x$lower), abs(x$upper)) / (x$upper - x$lower))) + 2
  digits <- ifelse(is.finite(digits), pmin(pmax(digits, 2), 15), 4)
  ends <- function(y) vapply(seq_along(y), function(i) format(y[i], digits = digits[i]), "")
  interval <- ifelse(is.nan(x$lower) & is.nan(x$upper), "", paste0(
    "[", ends(x$lower), ", ", ends(x$upper), "]"
  ))
  status <- ifelse(x$status == "determined", "", x$status)
  lines <- paste0("  ", format(name), "  ", format(value), "  ", format(unit), "  ",
                  format(interval), "  ", status)
  say(sub(" +$", "", lines), sep = "\n")
  for (words in free_words(fit)) say("  not determined: ", words, "\n")
  noise <- noise_table(fit)
  say(paste0(
    "  noise of ", noise$column, ": ", format_each(signif(noise$sigma, 3)),
    ifelse(noise$unit == "1", "", paste0(" ", noise$unit)),
    ifelse(noise$tau_s > 0, paste0(
      ifelse(noise$white > 1, ", neighbours anticorrelated over ", ", correlated over "),
      format_each(signif(noise$tau_s, 2)), " s"
    ), ""),
    ifelse(noise$trend == 1, "", paste0(
      ", ", format_each(signif(noise$trend, 2)), " times as large at the end"
    ))
  ), sep = "\n")
  tests <- verdict_rows(fit)
  told <- tests[tests$test %in% c("wrong law", "outliers") & tests$finding != "none found", ]
  if (nrow(told)) {
    where <- if (length(about$records) > 1L) paste0(" of record ", told$record) else ""
    what <- ifelse(told$test == "wrong law", "law: ", "outliers: ")
    say(paste0("  ", what, told$column, where, " ", told$finding), sep = "\n")
  }
  if (any(told$test == "wrong law")) say("  intervals of a law that does not fit may not hold\n")
  still <- unlist(lapply(about$records, function(r) {
    size <- vapply(names(r$count), function(name) max(r$weight[[name]] %||% 1)^2, 1)
    names(size)[size >= 0.2 * length(r$time_s)]
  }))
  if (length(still)) {
    say(paste0("  equal counts of ", unique(still), " weigh as one: intervals may be too wide"),
        sep = "\n")
  }
  if (length(fit$found$others)) {
    worse <- sum(fit$found$others > misfit_of(fit$found) + 0.5)
    say("  ", length(fit$found$others), " further starts, ", worse,
        " end in other minima that fit worse\n")
  }
  say("  ", round(100 * about$level), " % intervals, condition ", format(numbers[3], digits = 2),
      ", ", numbers[5], " steps, model ", fit$found$model, "\n")
  invisible(x)
}

noise_table <- function(fit) {
  noise <- matrix(fit$found$noise, noise_numbers)
  records <- fit$about$records
  column <- unlist(lapply(records, function(r) names(r$series)))
  data.frame(
    record = rep(vapply(records, `[[`, "", "name"), vapply(records, function(r) {
      length(r$series)
    }, 0L)),
    column = column, unit = unit_of_column(column),
    n = noise[1L, ], sigma = noise[2L, ], tau_s = noise[3L, ], white = noise[4L, ],
    at_cap = noise[5L, ] > 0, gain = noise[6L, ], trend = unlist(lapply(records, function(r) {
      vapply(names(r$series), function(name) r$trend[[name]] %||% 1, 1)
    }))
  )
}

# ---- verbs --------------------------------------------------------------------------------------

#' @rdname as_scene
#' @export
as_scene.rot_fit <- function(x, ..., record = 1) {
  call <- check_no_dots(...)
  fit <- fit_of(x, call)
  r <- floor(check_number(record, "record", "1", call, 1, length(fit$about$records)))
  fitted_scene(fit$about, fit$found$x, r, call)
}

# The scene of record r with the fitted numbers x.
fitted_scene <- function(about, x, r, call) {
  p <- about$parameters
  at <- p$kind == "input" & p$record %in% c(0L, r)
  scene_of_numbers(about, stats::setNames(x[at], p$of[at]), call)
}

# The columns of record r as they are measured at other times: offset + factor * motion.
predicted_series <- function(about, x, r, time_s, call) {
  p <- about$parameters
  number <- function(kind, of, otherwise) {
    at <- which(p$kind == kind & p$of == of & p$record %in% c(0L, r))
    if (length(at)) x[at[1]] else otherwise
  }
  scene <- fitted_scene(about, x, r, call)
  motion <- motion_at(scene, time_s + number("clock", "time_s", 0))
  series <- series_of_motion(
    motion, constraint_of(scene)$index, names(about$records[[r]]$series)
  )
  Map(function(y, name) number("offset", name, 0) + number("factor", name, 1) * y, series,
      names(series))
}

# A motion at times that need not begin with the scene.
motion_at <- function(scene, time_s) {
  start <- scene$start_s %||% 0
  late <- length(time_s) > 0L && time_s[1] > start
  rows <- trajectory(scene, if (late) c(start, time_s) else time_s)
  if (late) rows[rows$time_s > start, ] else rows
}

#' @export
augment.rot_fit <- function(x, ...) {
  call <- check_no_dots(...)
  fit <- fit_of(x, call)
  at <- 0
  parts <- lapply(seq_along(fit$about$records), function(k) {
    r <- fit$about$records[[k]]
    n <- length(r$time_s)
    left <- fit$about$outliers_at
    out <- lapply(seq_along(r$series), function(c) {
      fitted <- fit$found$fitted[at + seq_len(n)]
      at <<- at + n
      data.frame(
        record = r$name, time_s = r$time_s, column = names(r$series)[c], measured = r$all[[c]],
        fitted = fitted, residual = r$all[[c]] - fitted,
        outlier = seq_len(n) %in% left$row[left$record == k & left$column == c]
      )
    })
    do.call(rbind, out)
  })
  table_from(do.call(rbind, parts))
}

#' @export
summary.rot_fit <- function(object, ...) {
  check_no_dots(...)
  glance(object)
}

#' @export
glance.rot_fit <- function(x, ...) {
  call <- check_no_dots(...)
  fit <- fit_of(x, call)
  numbers <- fit$found$numbers
  as_table(
    samples = numbers[4], unknowns = as.double(nrow(x)), dof = fit$dof, condition = numbers[3],
    converged = !fit$failed, steps = numbers[5], runs = numbers[6], model = fit$found$model
  )
}

#' @export
predict.rot_fit <- function(object, time_s, ..., record = 1) {
  call <- check_no_dots(...)
  check_supplied("time_s", call)
  scene <- as_scene.rot_fit(object, record = record)
  time_s <- check_column(time_s, "time_s", "s", call)
  stats::predict(trajectory(scene, range(scene$start_s %||% 0, time_s[is.finite(time_s)])), time_s)
}

#' @rdname fit_verbs
#' @export
coef.rot_fit <- function(object, ...) {
  fit <- fit_of(object, current_env(), "object")
  stats::setNames(fit$found$x, fit$about$parameters$name)
}

#' @export
vcov.rot_fit <- function(object, ...) {
  fit <- fit_of(object, current_env(), "object")
  p <- fit$about$parameters
  scale <- ifelse(p$log, fit$found$x, 1)
  spread <- fit$spread * outer(scale, scale)
  lost <- is.nan(object$standard_error)
  spread[lost, ] <- spread[, lost] <- NaN
  dimnames(spread) <- list(p$name, p$name)
  spread
}

# Each unknown is a sum of independent parts, the columns of the covariance's factor.
measured_values.rot_fit <- function(x, call) {
  fit <- fit_of(x, call, "value")
  p <- fit$about$parameters
  factor <- matrix(fit$found$factor, nrow(p), byrow = TRUE)
  known <- which(!is.nan(x$standard_error))
  if (!length(known)) {
    abort_rotdyn("{.arg value} has no unknown with a standard error.", "value", call)
  }
  id <- fit$identity
  lapply(stats::setNames(known, p$name[known]), function(k) {
    scale <- if (p$log[k]) fit$found$x[k] else 1
    parts <- data.frame(
      id = paste0(id, "-", seq_len(nrow(p))), name = p$name[k], u = scale * factor[k, ],
      dof = fit$dof, group = id
    )
    measured_from_parts(fit$found$x[k], parts, p$name[k])
  })
}

#' Profiles of a fit
#'
#' How well the records are fitted with one unknown held at other values and all others fitted
#' again: the check of an interval where the problem is not linear.
#'
#' @param fitted A [fit_scene()].
#' @param which Unknowns: numbers of rows, or paths; NULL: all that have a standard error.
#' @param ... Not used: an unknown argument is an error.
#' @param points How many values on each side, up to 2.5 standard errors.
#' @return A tibble with a row for each value and the columns
#'   `r describe_columns(profile_columns, profile_meanings)`
#' @section Errors: `rotdyn_error_argument`, `rotdyn_error_type`, `rotdyn_error_value`.
#' @source Bates and Watts, Nonlinear Regression Analysis and Its Applications (1988), chapter 6.
#' @seealso [fit_scene()].
#' @concept likelihood
#' @examples
#' pendulum <- scene_pendulum(body_point(1), 0.8, theta0_rad = 0.5)
#' set.seed(1)
#' film <- trajectory(pendulum, 0:40 / 10)[c("time_s", "theta_rad")]
#' film$theta_rad <- film$theta_rad + rnorm(41, 0, 0.02)
#' profile(fit_scene(pendulum, film, c("distance_m", "theta0_rad")), "distance_m", points = 2)
#' @export
profile.rot_fit <- function(fitted, which = NULL, ..., points = 5) {
  call <- check_no_dots(...)
  fit <- fit_of(fitted, call, "fitted")
  p <- fit$about$parameters
  points <- floor(check_number(points, "points", "1", call, 1, 1000))
  known <- base::which(!is.nan(fitted$standard_error))
  at <- if (is.null(which)) known else if (is.numeric(which)) which else match(which, p$name)
  odd <- is.na(at) | !at %in% known
  if (any(odd)) {
    abort_rotdyn(c(
      "{.arg which} must be unknowns that have a standard error.",
      x = "It is {describe_value(which)}; these are {.or {.val {p$name[known]}}}."
    ), "argument", call)
  }
  rows <- lapply(at, function(k) {
    t <- seq(-2.5, 2.5, length.out = 2 * points + 1)
    step <- t * fitted$standard_error[k]
    value <- if (p$log[k]) fit$found$x[k] * exp(step / fit$found$x[k]) else fit$found$x[k] + step
    # It ends at a limit.
    limit <- if (p$log[k]) fit$found$x[k] * log(c(p$low[k], p$high[k]) / fit$found$x[k]) else
      c(p$low[k], p$high[k]) - fit$found$x[k]
    t <- pmin(pmax(t, limit[1] / fitted$standard_error[k]), limit[2] / fitted$standard_error[k])
    value <- pmin(pmax(value, p$low[k]), p$high[k])
    squares <- vapply(value, function(x) fixed_squares(fit, k, x), double(1))
    # One of them is the fit itself.
    data.frame(unknown = p$name[k], value = value, linear = t,
               rooted = sign(t) * sqrt(pmax(squares - squares[points + 1], 0)))[!duplicated(t), ]
  })
  table_from(do.call(rbind, rows))
}
