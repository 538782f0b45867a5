#' The period of a motion
#'
#' In closed form: a pendulum at any amplitude and in rotation, an oscillator with a spring, a wheel
#' that turns freely.
#'
#' \deqn{T = 4 \sqrt{I / (m g d)} \, K(\sin^2(A / 2))}{T = 4 sqrt(I/(m g d)) K(sin^2(A/2))}
#' for a pendulum of amplitude A, with the complete elliptic integral K. An oscillator
#' `I theta'' = -c theta' - k theta` has the cycle `2 pi / sqrt(k/I - (c/(2 I))^2)`, the time
#' between two passages of the rest angle in the same sense. With damping the motion itself has no
#' period: each cycle multiplies the amplitude by `amplitude_ratio`.
#'
#' @param scene A [scene_axle()] or [scene_pendulum()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble of one row with the columns
#'   `r describe_columns(period_columns)`
#'   `kind` is `"oscillation"`; `"rotation"` (the period is the time of a turn); `"rest"` (it hangs
#'   still: the period of a small swing); `"separatrix"` (it tends to the top, or is balanced there:
#'   Inf); `"damped"` (the time of a cycle; NaN where no cycle is like another: a damped pendulum,
#'   drag, dry friction); `"overdamped"` and `"none"` (NaN: nothing swings). `amplitude_rad` is NaN
#'   where there is none.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_model` where no closed form tells (a driven
#'   motion, gravity with a spring): `time_when(scene, theta_rad = 0)` gives the passages.
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), sections 11 and 25. The integral by the
#'   arithmetic-geometric mean to twice the precision, so that it holds beside the separatrix, too.
#' @seealso [time_when()], [stopping()], [motion_events()].
#' @concept period
#' @concept frequency
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
  check_scene_of(scene, "axle", call, "Describe one with {.fn scene_pendulum} or {.fn scene_axle}.")
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
