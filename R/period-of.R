#' The period of a motion
#'
#' In closed form: a pendulum at any amplitude and in rotation, an oscillator with a spring, a wheel
#' that turns freely, a top that precesses, the modes of a shaft and of a chain.
#'
#' \deqn{T = 4 \sqrt{I / (m g d)} \, K(\sin^2(A / 2))}{T = 4 sqrt(I/(m g d)) K(sin^2(A/2))}
#' for a pendulum of amplitude A, with the complete elliptic integral K. An oscillator
#' `I theta'' = -c theta' - k theta` has the cycle `2 pi / sqrt(k/I - (c/(2 I))^2)`, the time
#' between two passages of the rest angle in the same sense. With damping the motion itself has no
#' period: each cycle multiplies the amplitude by `amplitude_ratio`.
#'
#' A top has the mean time of a turn of its axis about the vertical, and that of a nutation; a
#' vertical one the time of a slow steady turn beside the vertical. Rotors on a shaft and a chain
#' have the periods of their modes without damping, of a chain those of small swings.
#'
#' @param scene A [scene_axle()] or [scene_pendulum()]; a [scene_pivot()] of a symmetric top, a
#'   [scene_rotors()] or a [scene_chain()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with the columns
#'   `r describe_columns(period_columns)`
#'   It has one row; of a top there are two, with the `kind` `"precession"` and `"nutation"`, of
#'   rotors and chains one for each `"mode"` with a frequency above 0, the slowest first. For a body
#'   on an axle `kind` is `"oscillation"`; `"rotation"` (the period is the time of a turn); `"rest"`
#'   (it hangs still: the period of a small swing); `"separatrix"` (it tends to the top, or is
#'   balanced there: Inf); `"damped"` (the time of a cycle; NaN where no cycle is like another: a
#'   damped pendulum, drag, dry friction); `"overdamped"` and `"none"` (NaN: nothing swings).
#'   `amplitude_rad` is NaN where there is none.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_model` where no closed form tells (a driven
#'   motion, gravity with a spring): `time_when(scene, theta_rad = 0)` gives the passages.
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), sections 11 and 25. The integral by the
#'   arithmetic-geometric mean to twice the precision, so that it holds beside the separatrix, too.
#' @seealso [precession_table()], [shaft_modes()], [chain_modes()], [flip_time()] of a free body;
#'   [time_when()], [stopping()], [motion_events()].
#' @concept period
#' @concept frequency
#' @concept pendulum
#' @concept frequency of a pendulum
#' @concept precession
#' @examples
#' # A metre stick about its end: small swings, and let go from horizontal.
#' stick <- function(angle) scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = angle)
#' period_of(stick(0))
#' period_of(stick(pi / 2))
#' # A damped pendulum has no period, but cycles: from one turning point to the next but one.
#' oiled <- scene_pendulum(body_point(1), 0.8, resistance(0.3), theta0_rad = 2)
#' period_of(oiled)$kind
#' turns <- time_when(oiled, omega_rad_per_s = 0, occurrence = "all", until_s = 12)
#' diff(turns$time_s, lag = 2)
#' turns$theta_rad
#' # A torsion pendulum in oil.
#' period_of(scene_axle(0.02, torque_spring(0.5), resistance(0.01), theta0_rad = 0.3))
#' @export
period_of <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  if (inherits(scene, "rot_scene")) {
    check_scene(scene, call)
    periods <- constraint_of(scene)$periods
    if (!is.null(periods)) return(new_table(periods(scene, call)))
  }
  check_scene_of(
    scene, "axle", call,
    "Of another scene {.code time_when(scene, ..., occurrence = \"all\")} gives the passages."
  )
  x <- .Call(ffi_axle_period, scene)
  if (!is.null(torque_loads(given_torque(scene))$law)) x$kind <- "unknown"
  if (x$kind == "unknown") {
    abort_rotdyn(c(
      "There is no closed form of the period of this motion.",
      x = "On it act: {paste(core_effects('axle', scene), collapse = ', ')}.",
      i = "{.code time_when(scene, theta_rad = 0, until_s = ...)} gives the times of its passages."
    ), "model", call)
  }
  new_table(list(
    period_s = x$period_s, kind = x$kind, amplitude_rad = x$amplitude_rad,
    amplitude_ratio = x$ratio
  ), nrow = 1L)
}

# For the `periods` of a constraint: rows without an amplitude.
periods_of_kind <- function(period_s, kind) {
  list(
    period_s = period_s, kind = rep_len(kind, length(period_s)),
    amplitude_rad = rep(NaN, length(period_s)), amplitude_ratio = rep(NaN, length(period_s))
  )
}

# Angular frequencies of modes, of which those of rigid motions are 0.
mode_periods <- function(omega) periods_of_kind(2 * pi / sort(unique(omega[omega > 0])), "mode")

pivot_periods <- function(scene, call) {
  if (!is.null(scene$torque) || !is.null(scene$resistance)) {
    abort_rotdyn(c(
      "A top under a torque, or with resistance, has no period.",
      i = "{.fn trajectory} has its motion."
    ), "model", call)
  }
  top <- table_of_tops(scene, list(given = character()), call)
  nutation <- .Call(ffi_pivot_nutation, scene) %||% rep(NA_real_, 4)
  turn <- 2 * pi * nutation[1] / abs(nutation[4])
  if (!is.finite(turn)) {
    steady <- if (top$spin_rad_per_s != 0) precession_table(scene)$slow_precession_rad_per_s
    turn <- 2 * pi / abs(steady %||% NaN)
  }
  periods_of_kind(c(turn, nutation[1]), c("precession", "nutation"))
}
