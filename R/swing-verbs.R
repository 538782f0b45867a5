#' The fitted swing at any time
#'
#' @param object,x A [fit_swing()].
#' @param time_s Times, not before the first sample of the interval that was fitted; NULL for those
#'   of its samples.
#' @param ... Not used: an unknown argument is an error.
#' @param level Probability of the bands.
#' @return `predict()`: a tibble with `time_s` and what was measured, `theta_rad` or
#'   `omega_rad_per_s` without the sensor's offset, with its standard error (`_se`) and the ends of
#'   its band (`_lower`, `_upper`; pointwise, of the fitted motion and not of new samples). Its
#'   losses are those of the fit with none below 0.
#'   `augment()`: a row for each sample of the interval: `time_s`, `measured`, `fitted` (with the
#'   offset), `residual`. `glance()`: one row for the fit: numbers of swings and samples, period,
#'   omega0, the losses and their standard errors (NA where not fitted), residuals and the verdict
#'   on the law.
#' @section Errors: `rotdyn_error_value` of `predict()`, `augment()` and `as_scene()` where no free
#'   motion fitted (`from` is `"swings"`), `rotdyn_error_time`, `rotdyn_error_type`,
#'   `rotdyn_error_argument`.
#' @seealso [fit_swing()], [as_scene()].
#' @concept extrapolate
#' @concept other times
#' @examples
#' swing <- scene_pendulum(body_rod_end(0.2, 0.6), resistance = resistance(0.002), theta0_rad = 0.8)
#' samples <- trajectory(swing, seq(0, 12, by = 0.04))
#' set.seed(1)
#' samples$theta_rad <- samples$theta_rad + rnorm(nrow(samples), sd = 0.002)
#' fit <- fit_swing(motion_record(samples, time_s = time_s, theta_rad = theta_rad))
#' predict(fit, c(1, 2.5))
#' generics::augment(fit)
#' generics::glance(fit)
#' as_scene(fit)
#' @export
predict.rot_swing_fit <- function(object, time_s = NULL, ..., level = 0.95) {
  call <- current_env()
  check_no_dots(...)
  check_swing_motion(object, "object", call)
  level <- check_level(level, call)
  time_s <- if (is.null(time_s)) object$samples$time_s else {
    check_finite(time_s, "time_s", "s", call)
  }
  start <- object$samples$time_s[1]
  if (length(time_s) && min(time_s) < start) {
    abort_rotdyn(c(
      "{.arg time_s} must not be before the interval that was fitted.",
      x = "It has {format_si(min(time_s))} s; the interval starts at {format_si(start)} s.",
      i = "{.fn as_scene} gives the scene, which goes back in time."
    ), "time", call)
  }
  order <- order(time_s)
  back <- order(order)
  rows <- swing_rows(object, time_s[order], call)
  half <- stats::qt((1 + level) / 2, object$motion$dof) * rows$se[back]
  value <- rows$value[back] - object$motion$p[7]
  stem <- object$kind
  out <- list(time_s, value, rows$se[back], value - half, value + half)
  names(out) <- c("time_s", stem, paste0(stem, c("_se", "_lower", "_upper")))
  new_table(out, nrow = length(time_s))
}

check_swing_motion <- function(x, arg, call) {
  check_swing_fit(x, arg, call)
  if (!is.null(x$motion)) return(x)
  abort_rotdyn(c(
    "{.arg {arg}} has no fitted motion.",
    x = "No free motion fitted the record: the period is that of its swings.",
    i = "{.arg from_s}, {.arg to_s}, {.arg losses} and {.arg restoring} of {.fn fit_swing} choose
         the part and the law."
  ), "value", call)
}

# Values with the offset, and standard errors without that of the offset.
swing_rows <- function(x, time_s, call) {
  motion <- x$motion
  if (!length(time_s)) return(list(value = double(), se = double()))
  now <- free_motion(motion$p, time_s, x$samples$time_s[1], x$kind, x$restoring)
  if (is.null(now)) {
    abort_rotdyn("The motion leaves double precision before the last time.", "range", call)
  }
  k <- length(motion$active)
  derivative <- now$derivative[, motion$active, drop = FALSE]
  derivative[, motion$active == 7] <- 0
  spread <- matrix(motion$covariance, k)
  list(value = now$value, se = sqrt(pmax(rowSums((derivative %*% spread) * derivative), 0)))
}

#' @rdname predict.rot_swing_fit
#' @export
augment.rot_swing_fit <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  check_swing_motion(x, "x", call)
  fitted <- swing_rows(x, x$samples$time_s, call)$value
  new_table(list(
    time_s = x$samples$time_s, measured = x$samples$measured, fitted = fitted,
    residual = x$samples$measured - fitted
  ), nrow = length(fitted))
}

#' @export
summary.rot_swing_fit <- function(object, ...) {
  check_no_dots(...)
  glance(object)
}

#' @rdname predict.rot_swing_fit
#' @export
glance.rot_swing_fit <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  check_swing_fit(x, "x", call)
  numbers <- c(
    "period_s", "omega0_rad_per_s", "decay_per_s", "quadratic_per_rad", "coulomb_rad_per_s2",
    "decay_at_amplitude_per_s"
  )
  out <- list(
    restoring = x$restoring, from = x$from, swings = nrow(x$swings), used = sum(x$swings$used),
    samples = nrow(x$samples), amplitude_rad = x$amplitude_rad
  )
  for (name in numbers) {
    out[[name]] <- x[[name]]$value %||% NA_real_
    out[[paste0(name, "_se")]] <- x[[name]]$u %||% NA_real_
  }
  out <- c(out, list(
    dof = x$period_s$dof, residual = x$residual,
    residual_unit = if (x$kind == "theta_rad") "rad" else "rad/s",
    correlation_time_s = x$correlation_time_s, durbin_watson = x$durbin_watson,
    law_p = x$law_p, complete = x$law_complete
  ))
  new_table(out, nrow = 1L)
}

#' @rdname as_scene
#' @export
as_scene.rot_swing_fit <- function(x, ..., inertia = 1) {
  call <- current_env()
  check_no_dots(...)
  check_swing_motion(x, "x", call)
  inertia <- as_measured(inertia, "inertia", "kg*m^2", call, 0, open = TRUE)$value
  p <- x$motion$p
  law <- if (x$restoring == "spring") {
    torque_spring(inertia * p[3]^2)
  } else {
    torque_gravity(1, inertia * p[3]^2, gravity_m_per_s2 = 1)
  }
  scene_axle(
    inertia, law,
    resistance(
      viscous_n_m_s = 2 * inertia * p[4], coulomb_n_m = inertia * p[5],
      quadratic_n_m_s2 = inertia * p[6]
    ),
    theta0_rad = p[1], omega0_rad_per_s = p[2], start_s = x$samples$time_s[1]
  )
}

