#' The periods of a motion
#'
#' In closed form: a pendulum at any amplitude and in rotation, an oscillator with a spring, a wheel
#' that turns freely; the modes of rotors on shafts, of a drive and of a chain; the small swings of
#' a bead on a hoop; the wobble of a free body; precession and nutation of a top.
#'
#' \deqn{T = 4 \sqrt{I / (m g d)} \, K(\sin^2(A / 2))}{T = 4 sqrt(I/(m g d)) K(sin^2(A/2))}
#' for a pendulum of amplitude A, with the complete elliptic integral K. An oscillator
#' `I theta'' = -c theta' - k theta` has the cycle `2 pi / sqrt(k/I - (c/(2 I))^2)`, the time
#' between two passages of the rest angle in the same sense. With damping the motion itself has no
#' period: each cycle multiplies the amplitude by `amplitude_ratio`.
#'
#' A mode is a swing in which all parts pass rest together, of small amplitude and without damping.
#' A free body wobbles: its angular velocity in its own axes repeats after the time between two
#' flips, twice. The axis of a top goes around the vertical (precession, by the mean rate) and nods
#' (nutation). A vertical top that sleeps or hangs has those beside the vertical: the slow
#' precession, and a nutation of amplitude 0. A body with a fixed point that swings in a plane is a
#' pendulum.
#'
#' @param scene A scene of [scene_axle()], [scene_pendulum()], [scene_gears()], [scene_rotors()],
#'   [scene_drive()] without clutches, [scene_chain()], [scene_hoop()], [scene_free()] or
#'   [scene_pivot()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with the columns below, one row for a body on an axle, one for each mode or
#'   periodic part of the others:
#'   `r describe_columns(period_columns)`
#'   `kind` is `"oscillation"`; `"rotation"` (the period is the time of a turn); `"rest"` (it hangs
#'   still: the period of a small swing); `"separatrix"` (it tends to the top, or is balanced there:
#'   Inf); `"damped"` (the time of a cycle; NaN where no cycle is like another: a damped pendulum,
#'   drag, dry friction); `"overdamped"` and `"none"` (NaN: nothing swings); of the other scenes
#'   `"mode"` (slowest first; turning as a whole is none), `"small swing"` (about each place where a
#'   bead may rest, lowest angle first), `"wobble"`, `"precession"` and `"nutation"`.
#'   `amplitude_rad` is NaN where there is none: of modes and small swings, which have any, and of
#'   precession; of a nutation it is half of the way between its two inclinations.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_model` where there is no closed form (a
#'   driven motion, gravity with a spring, a tumbling body with a torque) and where nothing swings
#'   (an incline, a clutch): [time_when()] gives the passages.
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), sections 11 and 25. The integral by the
#'   arithmetic-geometric mean to twice the precision, so that it holds beside the separatrix, too.
#'   Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 5.6, 5.7 and 6.2.
#' @seealso [time_when()], [stopping()], [motion_events()], [shaft_modes()], [chain_modes()],
#'   [flip_time()], [precession_table()].
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
#' # A double pendulum: two modes. A tumbling box.
#' period_of(scene_chain(c(1, 1), 1, 0.1))
#' period_of(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)))
#' @export
period_of <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene(scene, call)
  constraint <- constraint_of(scene)
  if (is.null(constraint$periods)) {
    abort_rotdyn(c(
      "Nothing swings in this scene: it has no period.",
      x = "It is {.obj_type_friendly {scene}}.",
      i = "{.fn time_when} and {.fn motion_events} give the times of what happens."
    ), "model", call)
  }
  found <- constraint$periods(scene, call)
  n <- length(found$period_s)
  new_table(list(
    period_s = found$period_s, kind = rep_len(found$kind, n),
    amplitude_rad = rep_len(found$amplitude_rad %||% NaN, n),
    amplitude_ratio = rep_len(found$amplitude_ratio %||% NaN, n)
  ), nrow = n)
}

abort_no_period <- function(scene, call, remedy) {
  effects <- unname(core_effects(constraint_of(scene)$id, scene))
  abort_rotdyn(c(
    "There is no closed form of the period of this motion.",
    x = if (length(effects)) "On it act: {paste(effects, collapse = ', ')}.",
    i = remedy
  ), "model", call)
}

# About the stable ones of positions of rest.
small_swings <- function(rests) {
  list(period_s = 2 * pi / rests$swing_rad_per_s[rests$stable], kind = "small swing")
}

# Natural rates as periods; a rate of 0 turns as a whole.
periods_of_modes <- function(rates) list(period_s = 2 * pi / rates[rates %in% 0 == FALSE],
  kind = "mode")
