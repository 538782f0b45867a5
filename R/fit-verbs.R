# What R's own fits answer to: coefficients, their intervals, residuals and counts, of fit_scene(),
# fit_coast_down() and fit_swing().

#' The verbs of R's own fits
#'
#' `coef()`, `confint()`, `residuals()`, `fitted()`, `nobs()`, `sigma()` and `df.residual()` of a
#' [fit_scene()], a [fit_coast_down()] or a [fit_swing()], as of [stats::nls()].
#'
#' @param object The fit.
#' @param parm Unknowns by name or number; NULL: all.
#' @param level Probability of the intervals. NULL: that of the fit; of a swing 0.95. A fit whose
#'   intervals are made with it takes no other.
#' @param use.fallback Not used: the argument of [stats::nobs()].
#' @param ... Not used: an unknown argument is an error.
#' @return `coef()`: numbers with names, in SI units. `confint()`: a matrix with a row for each and
#'   the columns `lower` and `upper`. `residuals()` (data less fit) and `fitted()`: numbers, one for
#'   each sample in the order of `augment()`; residuals of pulses are times. `nobs()`: the number of
#'   samples; `df.residual()`: the degrees of freedom of the noise. `sigma()`: the standard
#'   deviation of the residuals in the unit measured, as `glance()` or the print gives it: NA for a
#'   swing that no free motion fitted; of a [fit_scene()] with several columns or records one for
#'   each, with names.
#' @section Errors: `rotdyn_error_argument` for an unknown argument, unknown or another level,
#'   `rotdyn_error_value` where no free motion fitted a swing and for a level outside 0 to 1.
#' @seealso [fit_scene()] with `vcov()` and [profile()], [fit_coast_down()], [fit_swing()];
#'   `augment()` for residuals with their times.
#' @concept residuals
#' @concept confidence interval
#' @examples
#' wheel <- scene_axle(0.02, resistance = resistance(1e-3), omega0_rad_per_s = 20)
#' set.seed(1)
#' record <- trajectory(wheel, 0:80 / 20)[c("time_s", "theta_rad")]
#' record$theta_rad <- record$theta_rad + rnorm(81, 0, 1e-3)
#' fit <- fit_coast_down(record, 0.02, losses = "viscous")
#' coef(fit)
#' confint(fit)
#' sd(residuals(fit))
#' nobs(fit)
#' sigma(fit)
#' @name fit_verbs
NULL

# Of what has the wanted columns in augment() and glance().
fit_column <- function(verb, name) {
  force(name)
  function(object, ...) {
    check_no_dots(...)
    verb(object)[[name]]
  }
}

#' @rdname fit_verbs
#' @export
residuals.rot_fit <- fit_column(augment, "residual")
#' @export
residuals.rot_coast_fit <- residuals.rot_fit
#' @export
residuals.rot_swing_fit <- residuals.rot_fit

#' @rdname fit_verbs
#' @export
fitted.rot_fit <- fit_column(augment, "fitted")
#' @export
fitted.rot_coast_fit <- fitted.rot_fit
#' @export
fitted.rot_swing_fit <- fitted.rot_fit

#' @rdname fit_verbs
#' @importFrom stats nobs
#' @export
nobs.rot_fit <- function(object, use.fallback = FALSE, ...) {
  check_no_dots(...)
  glance(object)$samples
}
#' @export
nobs.rot_coast_fit <- nobs.rot_fit
#' @export
nobs.rot_swing_fit <- nobs.rot_fit

#' @rdname fit_verbs
#' @export
df.residual.rot_fit <- fit_column(glance, "dof")
#' @export
df.residual.rot_coast_fit <- df.residual.rot_fit
#' @export
df.residual.rot_swing_fit <- df.residual.rot_fit

# As the print names it; a number alone where one column of one record was fitted.
#' @rdname fit_verbs
#' @importFrom stats sigma
#' @export
sigma.rot_fit <- function(object, ...) {
  call <- check_no_dots(...)
  noise <- noise_table(fit_of(object, call, "object"))
  if (nrow(noise) == 1L) return(noise$sigma)
  several <- length(unique(noise$record)) > 1L
  stats::setNames(noise$sigma, paste0(noise$column, if (several) paste0(" (", noise$record, ")")))
}
#' @export
sigma.rot_coast_fit <- fit_column(glance, "sigma")
#' @export
sigma.rot_swing_fit <- fit_column(glance, "residual")

#' @export
coef.rot_coast_fit <- function(object, ...) {
  call <- check_no_dots(...)
  coast_fit(object, "object", call)
  stats::setNames(object$value, object$loss)
}

#' @export
coef.rot_swing_fit <- function(object, ...) {
  call <- check_no_dots(...)
  vapply(swing_numbers(object, call), `[[`, 0, "value")
}

# The fitted numbers of a swing: <rot_measured> by name.
swing_numbers <- function(fit, call) {
  check_swing_fit(fit, "object", call)
  names <- c("period_s", "omega0_rad_per_s", unname(swing_parts))
  Filter(Negate(is.null), unclass(fit)[names])
}

#' @rdname fit_verbs
#' @export
confint.rot_fit <- function(object, parm = NULL, level = NULL, ...) {
  call <- check_no_dots(...)
  fit <- fit_of(object, call, "object")
  check_fit_level(level, fit$about$level, "fit_scene", call)
  interval_rows(object$lower, object$upper, fit$about$parameters$name, parm, call)
}

#' @export
confint.rot_coast_fit <- function(object, parm = NULL, level = NULL, ...) {
  call <- check_no_dots(...)
  fit <- coast_fit(object, "object", call)
  check_fit_level(level, fit$level, "fit_coast_down", call)
  interval_rows(object$lower, object$upper, object$loss, parm, call)
}

#' @export
confint.rot_swing_fit <- function(object, parm = NULL, level = NULL, ...) {
  call <- check_no_dots(...)
  numbers <- swing_numbers(object, call)
  level <- check_level(level %||% 0.95, call)
  value <- vapply(numbers, `[[`, 0, "value")
  half <- vapply(numbers, function(x) x$u * stats::qt((1 + level) / 2, x$dof), 0)
  interval_rows(value - half, value + half, names(numbers), parm, call)
}

# The intervals of a fit are no multiples of a standard error: they have the level of the fit.
check_fit_level <- function(level, own, verb, call) {
  if (is.null(level) || isTRUE(all.equal(level, own))) return()
  abort_rotdyn(c(
    "The intervals of this fit have the level {own}.",
    i = "Another one is an argument of {.fn {verb}}: {.code level = {level}}."
  ), "argument", call)
}

interval_rows <- function(lower, upper, names, parm, call) {
  out <- cbind(lower = lower, upper = upper)
  rownames(out) <- names
  if (is.null(parm)) return(out)
  at <- if (is.numeric(parm)) match(parm, seq_along(names)) else match(parm, names)
  if (anyNA(at)) {
    abort_rotdyn(c(
      "{.arg parm} must be unknowns of the fit.",
      x = "It is {describe_value(parm)}; these are {.or {.val {names}}}."
    ), "argument", call)
  }
  out[at, , drop = FALSE]
}
