# The fitted motion: parameters of a run, its rows, its scene.

coast_fit <- function(x, arg, call) {
  check_class(x, "rot_coast_fit", arg, "Make one with {.fn fit_coast_down}.", call)
  fit <- check_form(attr(x, "fit", exact = TRUE), coast_form, arg, "coast-down fit", call)
  if (!length(fit$runs)) abort_form("runs", arg, "coast-down fit", call)
  if (!all(fit$losses %in% coast_losses)) abort_form("losses", arg, "coast-down fit", call)
  fit
}

coast_form <- list(
  runs = list(.each = list(
    kind = "number", time_s = "sorted", value = "numbers=time_s", name = "text", p = "numbers:11",
    covariance = "numbers:121", factor = "numbers:121", best = "numbers:11",
    numbers = "values:15", residual = "numbers=time_s", dof = "number",
    trend = "number",
    problem = list(
      kind = "number", time_s = "sorted", value = "numbers=time_s", fitted = "numbers:11",
      start = "numbers:11", load = "numbers:3", noise = "numbers:2", threshold = "limit",
      step_s = "numbers", step_ratio = "numbers=step_s"
    )
  )),
  losses = "texts", load = list(kind = "text"), runout = "text", noise = "text", level = "number",
  pooled = list(value = "numbers", covariance = "numbers", best = "numbers", dof = "numbers")
)

# Without a row or a column of it, it is a table and no fit.
reconstruct_fit <- function(data, template) {
  whole <- identical(names(data), names(template)) && nrow(data) == nrow(template)
  if (whole) return(data)
  attr(data, "fit") <- NULL
  class(data) <- setdiff(class(data), "rot_coast_fit")
  data
}

#' @export
`[.rot_coast_fit` <- function(x, ...) {
  out <- NextMethod()
  if (is.data.frame(out)) reconstruct_fit(out, x) else out
}

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_coast_fit <- function(data, template) {
  out <- NextMethod()
  reconstruct_fit(out, template)
}

#' @exportS3Method tibble::as_tibble
as_tibble.rot_coast_fit <- function(x, ...) {
  attr(x, "fit") <- NULL
  class(x) <- setdiff(class(x), "rot_coast_fit")
  tibble::as_tibble(x, ...)
}

check_run <- function(run, fit, call) {
  n <- length(fit$runs)
  if (is.character(run) && length(run) == 1L) {
    at <- match(run, vapply(fit$runs, `[[`, "", "name"))
    if (!is.na(at)) return(at)
  }
  if (!is_number(run) || length(run) != 1L || is.na(run) || !run %in% seq_len(n)) {
    abort_rotdyn(c(
      "{.arg run} must be the number or the name of a run, 1 to {n}.",
      x = "It is {describe_value(run)}."
    ), "value", call)
  }
  as.integer(run)
}

# Of run i, with the losses of all runs: its start follows them as its own fit says.
run_parameters <- function(fit, i) {
  run <- fit$runs[[i]]
  if (length(fit$runs) == 1L) {
    return(list(p = run$best, covariance = run$covariance, factor = run$factor))
  }
  pooled <- fit$pooled
  shared <- names(pooled$value)
  unit <- if ("load" %in% shared) run$problem$load[1] / fit$runs[[1]]$problem$load[1] else 1
  scale <- stats::setNames(ifelse(shared == "load", 1 / unit, 1), shared)
  own <- setdiff(coast_parameters[run$problem$fitted > 0], shared)
  follows <- run$covariance[own, shared, drop = FALSE] %*%
    scaled_solve(run$covariance[shared, shared, drop = FALSE])
  p <- run$p
  p[shared] <- pooled$best * scale
  p[own] <- run$p[own] + as.vector(follows %*% (p[shared] - run$p[shared]))
  v <- (pooled$covariance + diag(pooled$between, length(shared))) * outer(scale, scale)
  covariance <- run$covariance
  covariance[shared, shared] <- v
  covariance[own, shared] <- follows %*% v
  covariance[shared, own] <- t(covariance[own, shared])
  covariance[own, own] <- run$covariance[own, own] +
    follows %*% (v - run$covariance[shared, shared]) %*% t(follows)
  list(p = p, covariance = covariance)
}

# theta, omega, alpha at times, and the derivatives of each by the 11 parameters.
motion_rows <- function(fit, i, p, time_s) {
  run <- fit$runs[[i]]
  load <- run$problem$load
  n <- length(time_s)
  out <- .Call(ffi_coast_rows, run$problem, unname(p[1:7]), run$time_s[1], time_s)
  derivative <- function(x) cbind(matrix(x, n, 7, byrow = TRUE), matrix(0, n, 4))
  d_theta <- derivative(out$d_theta)
  d_omega <- derivative(out$d_omega)
  acts <- (any(load != 0) | length(run$problem$step_s) > 0) & time_s <= p[["release"]]
  sum <- 1 + load[2] * (if (load[3] > 0) p[["load"]] else 1)
  share <- ifelse(acts, 1 / sum, 1)
  # A sample at the time of a step has the torque before it.
  step <- findInterval(time_s, run$problem$step_s, left.open = TRUE)
  torque <- c(load[1], run$problem$step_ratio)[step + 1L]
  drive <- ifelse(acts, torque * p[["load"]] / sum, 0)
  side <- sign(out$omega)
  u <- abs(out$omega)
  rests <- u == 0 & abs(drive) <= share * p[["coulomb"]]
  side[u == 0] <- sign(drive)[u == 0]
  law <- p[["coulomb"]] + u * (p[["viscous"]] + p[["quadratic"]] * u)
  alpha <- ifelse(rests, 0, drive - side * share * law)
  d_alpha <- -share * (p[["viscous"]] + 2 * p[["quadratic"]] * u) * d_omega
  d_alpha[, 3:5] <- d_alpha[, 3:5] - side * share * cbind(1, u, u^2)
  if (load[3] > 0) {
    d_alpha[, 6] <- d_alpha[, 6] + ifelse(acts, (torque + side * load[2] * law) / sum^2, 0)
  } else {
    d_alpha[, 6] <- d_alpha[, 6] + ifelse(acts, torque / sum, 0)
  }
  d_alpha[rests, ] <- 0
  list(
    theta = out$theta, omega = out$omega, alpha = alpha, d_theta = d_theta, d_omega = d_omega,
    d_alpha = d_alpha
  )
}

# Standard errors of sums of parameters; through the factor they keep their digits where the
# parameters are nearly dependent.
band <- function(derivative, spread) {
  if (!is.null(spread$factor)) return(sqrt(rowSums((derivative %*% spread$factor)^2)))
  sqrt(pmax(0, rowSums((derivative %*% spread$covariance) * derivative)))
}

#' The fitted motion at any time
#'
#' @param object,x A [fit_coast_down()].
#' @param time_s Times, not before the run's first sample; NULL for those of its samples.
#' @param ... Not used: an unknown argument is an error.
#' @param run Number or name of the run.
#' @param level Level of the bands; NULL for that of the fit.
#' @return `predict()`: a tibble with time, angle, angular velocity and acceleration, each with its
#'   standard error and the ends of its band (pointwise, of the fitted motion, not of new samples).
#'   `augment()`: a row for each sample of every run, with the fitted value and the residual.
#'   `glance()`: one row for the fit.
#' @section Errors: `rotdyn_error_time`, `rotdyn_error_value`, `rotdyn_error_type`.
#' @seealso [fit_coast_down()], [as_scene()].
#' @concept extrapolate
#' @concept other times
#' @examples
#' samples <- data.frame(time_s = 0:40 / 10, omega_rad_per_s = 10 - 0.5 * 0:40 / 10)
#' set.seed(2)
#' samples$omega_rad_per_s <- samples$omega_rad_per_s + rnorm(41, 0, 0.02)
#' fit <- fit_coast_down(samples, losses = c("coulomb", "viscous"))
#' predict(fit, c(1, 2.5))
#' generics::glance(fit)
#' @export
predict.rot_coast_fit <- function(object, time_s = NULL, ..., run = 1, level = NULL) {
  call <- current_env()
  check_no_dots(...)
  fit <- coast_fit(object, "object", call)
  i <- check_run(run, fit, call)
  level <- if (is.null(level)) fit$level else check_level(level, call)
  time_s <- if (is.null(time_s)) fit$runs[[i]]$time_s else check_finite(time_s, "time_s", "s", call)
  start <- fit$runs[[i]]$time_s[1]
  if (length(time_s) && min(time_s) < start) {
    abort_rotdyn(c(
      "{.arg time_s} must not be before the run, which starts at {format_si(start)} s.",
      x = "It has {format_si(min(time_s))} s.",
      i = "{.fn as_scene} gives the scene, which goes back in time."
    ), "time", call)
  }
  order <- order(time_s)
  at <- run_parameters(fit, i)
  rows <- motion_rows(fit, i, at$p, time_s[order])
  back <- order(order)
  quantile <- stats::qt((1 + level) / 2, fit$runs[[i]]$dof)
  out <- list(time_s = time_s)
  names <- c(theta = "theta_rad", omega = "omega_rad_per_s", alpha = "alpha_rad_per_s2")
  for (name in names(names)) {
    # Rates show no angle: theta is counted from the first sample.
    value <- rows[[name]][back]
    se <- band(rows[[paste0("d_", name)]], at)[back]
    stem <- names[[name]]
    out[[stem]] <- value
    out[[paste0(stem, "_se")]] <- se
    out[[paste0(stem, "_lower")]] <- value - quantile * se
    out[[paste0(stem, "_upper")]] <- value + quantile * se
  }
  new_table(out, nrow = length(time_s))
}

#' @rdname predict.rot_coast_fit
#' @export
augment.rot_coast_fit <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  fit <- coast_fit(x, "x", call)
  parts <- lapply(seq_along(fit$runs), function(i) {
    run <- fit$runs[[i]]
    p <- run_parameters(fit, i)$p
    rows <- motion_rows(fit, i, p, run$time_s)
    data.frame(
      run = run$name, time_s = run$time_s, measured = run$value, fitted = run_fitted(run, p, rows),
      residual = run_residual(run, p, rows), omega_rad_per_s = rows$omega
    )
  })
  table_from(do.call(rbind, parts))
}

# What the sensor's runout adds to the angle, and its slope.
run_wave <- function(run, p, theta) {
  w <- p[coast_waves]
  list(
    add = w[[1]] * cos(theta) + w[[2]] * sin(theta) + w[[3]] * cos(2 * theta) +
      w[[4]] * sin(2 * theta),
    slope = -w[[1]] * sin(theta) + w[[2]] * cos(theta) - 2 * w[[3]] * sin(2 * theta) +
      2 * w[[4]] * cos(2 * theta)
  )
}

# In the units measured: of pulses the angle.
run_fitted <- function(run, p, rows) {
  # A pulse comes at its own angle.
  wave <- run_wave(run, p, if (run$kind == 2) run$value else rows$theta)
  if (run$kind == 1) rows$omega * (1 + wave$slope) else rows$theta + wave$add
}

# Data minus fit: of pulses in seconds.
run_residual <- function(run, p, rows) {
  residual <- run$value - run_fitted(run, p, rows)
  if (run$kind == 2) -residual / rows$omega else residual
}

#' @export
summary.rot_coast_fit <- function(object, ...) {
  check_no_dots(...)
  glance(object)
}

#' @rdname predict.rot_coast_fit
#' @export
glance.rot_coast_fit <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  fit <- coast_fit(x, "x", call)
  first <- fit$runs[[1]]
  number <- function(name) vapply(fit$runs, function(run) run$numbers[[name]], 0)
  size <- vapply(fit$runs, function(run) length(run$time_s), 0L)
  as_table(
    runs = length(fit$runs), samples = sum(size), dof = min(fit$pooled$dof),
    sigma = sqrt(sum(number("sigma")^2 * size) / sum(size)),
    sigma_unit = c("rad", "rad/s", "s")[first$kind + 1],
    correlation_time_s = max(number("tau_s")), white_share = min(number("white")),
    durbin_watson = min(vapply(fit$runs, function(run) durbin_watson(run$residual), 0)),
    condition_number = max(number("condition")),
    runout_p = min(vapply(fit$runs, runout_p, 0)), birge_ratio = fit$pooled$birge,
    complete = !length(law_faults(fit))
  )
}

durbin_watson <- function(r) {
  total <- sum(r^2)
  if (total > 0) sum(diff(r)^2) / total else 2
}

runout_p <- function(run) {
  x <- run$numbers
  if (is.na(x[["runout_f"]])) return(NA_real_)
  stats::pf(
    x[["runout_f"]], x[["runout_columns"]],
    length(run$time_s) - x[["free"]] - x[["runout_columns"]], lower.tail = FALSE
  )
}

#' The scene of a fit
#'
#' `as_scene()` turns a fit into the scene whose [trajectory()] is the fitted motion.
#'
#' @param x A [fit_scene()], a [fit_coast_down()] or a [fit_swing()].
#' @param ... Not used: an unknown argument is an error.
#' @param run Number or name of the run whose start the scene has.
#' @param inertia Of a swing: moment of inertia about the axle in kg m^2, a number or [measured()];
#'   a swing determines torques over it only.
#' @param record Of a [fit_scene()]: number of the record whose own unknowns the scene has.
#' @return Of a [fit_scene()] its scene with the fitted inputs, else a [scene_axle()]. Without an
#'   inertia its moment is 1 kg m^2, and the losses are those over the inertia. It begins at the
#'   run's first sample; where a weight was unwound, at its end.
#'   Of a swing: with the torque of a spring or of gravity, from the first sample of the interval
#'   fitted; angles are from the centre, without the sensor's offset.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [fit_coast_down()], [fit_swing()].
#' @concept fitted scene
#' @concept from a fit to a scene
#' @examples
#' samples <- data.frame(time_s = 0:40 / 10, omega_rad_per_s = 10 - 0.5 * 0:40 / 10)
#' scene <- as_scene(fit_coast_down(samples, inertia = 0.02, losses = "coulomb"))
#' stopping(scene)
#' @export
as_scene <- function(x, ...) {
  if (missing(x)) check_supplied("x", current_env())
  UseMethod("as_scene")
}

#' @export
as_scene.default <- function(x, ...) {
  check_class(
    x, "rot_coast_fit", "x",
    "Make one with {.fn fit_scene}, {.fn fit_coast_down} or {.fn fit_swing}.", current_env()
  )
}

#' @rdname as_scene
#' @export
as_scene.rot_coast_fit <- function(x, ..., run = 1) {
  call <- current_env()
  check_no_dots(...)
  fit <- coast_fit(x, "x", call)
  i <- check_run(run, fit, call)
  p <- run_parameters(fit, i)$p
  start <- fit$runs[[i]]$time_s[1]
  theta <- p[["theta0"]]
  omega <- p[["omega0"]]
  if (fit$load$kind == "weight") {
    at <- .Call(
      ffi_coast_rows, fit$runs[[i]]$problem, unname(p[1:7]), start, max(start, p[["release"]])
    )
    start <- max(start, p[["release"]])
    theta <- at$theta
    omega <- at$omega
  }
  inertia <- coast_inertia(fit)
  if (is.na(inertia)) inertia <- 1
  scene_axle(
    inertia, if (fit$load$kind == "torque") fit$load$law,
    resistance(
      viscous_n_m_s = p[["viscous"]] * inertia, quadratic_n_m_s2 = p[["quadratic"]] * inertia,
      coulomb_n_m = p[["coulomb"]] * inertia
    ),
    theta0_rad = theta, omega0_rad_per_s = omega, start_s = start
  )
}

# Given or fitted; NA where there is none.
coast_inertia <- function(fit) {
  unknown <- load_unknown(fit)
  if (identical(unknown$name, "inertia")) return(unknown$value)
  if (is.null(fit$inertia)) NA_real_ else fit$inertia$value
}
