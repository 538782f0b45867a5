# The constructor of pendulums. Their motion is that of a body on an axle: R/constraint-axle.R.

#' A pendulum: a body that hangs from an axle
#'
#' Shortcut for a [scene_axle()] with [torque_gravity()]: the moment of inertia about the axle is
#' that about the centre of mass plus `m d^2` (parallel axes).
#' \deqn{(I_g + m d^2)\,\ddot\theta = -m g d \sin\theta + \tau + \tau_r}{
#'   (I_g + m d^2) theta'' = -m g d sin(theta) + torque + resistance}
#' `theta` is 0 where it hangs
#' straight down. Without resistance the motion is known in closed form at any amplitude.
#'
#' @inheritParams scene_axle
#' @inheritParams torque-terms
#' @param body A `rot_body`; a point mass is [body_point()].
#' @param distance_m Distance of the centre of mass from the axle, >= 0. NULL for the axle that the
#'   body names: the end of a [body_rod_end()], the axis of a [body_point()] at its `radius_m`.
#' @param torque Any other torque law, or NULL.
#' @return A `rot_scene_pendulum`, which is a `rot_scene_axle`.
#' @section Errors: those of [scene_axle()].
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), section 11.
#' @seealso [period_of()] at any amplitude, [time_when()] for passages, [torque_gravity()],
#'   [scene_axle()].
#' @concept pendulum
#' @concept period
#' @concept swing
#' @concept grandfather clock
#' @examples
#' # A metre stick about its end, let go from horizontal.
#' pendulum <- scene_pendulum(body_rod_end(0.1, 1), theta0_rad = pi / 2)
#' trajectory(pendulum, time_s = seq(0, 2, by = 0.5))
#' @export
scene_pendulum <- function(body, distance_m = NULL, resistance = NULL, theta0_rad = 0,
                           omega0_rad_per_s = 0, ..., torque = NULL, start_s = 0,
                           axis = c(0, 0, 1), gravity_m_per_s2 = 9.80665) {
  call <- environment()
  check_no_dots(...)
  check_supplied("body", call)
  if (!inherits(body, "rot_body")) abort_no_pendulum(body, call)
  if (is.null(distance_m)) check_names_axle(body, axis, call)
  scene_of_inputs("axle", call, "scene_pendulum")
}

abort_no_pendulum <- function(body, call) {
  check_class(
    body, "rot_body", "body",
    if (is.numeric(body)) {
      paste0(
        "A point mass in kg is {.code body_point(", format_si(body[1]), ")}. In other scenes a ",
        "number is a moment of inertia; a pendulum needs a mass."
      )
    } else {
      "Make one with {.fn body_rod} or {.fn body_point}."
    }, call
  )
}

# The axle that the body names must miss its centre of mass.
check_names_axle <- function(body, axis, call) {
  check_body(body, call)
  if (nzchar(axis_shape(body))) {
    off <- as.double(.subset2(body, "centre_m")) - named_point(body)
    axis <- unit_axis(as_axis(axis, call), call)
    if (any(off - sum(off * axis) * axis != 0)) return()
  }
  abort_rotdyn(c(
    "{.arg distance_m} is missing: the axle passes through no point that this body names.",
    i = "Give the distance of the centre of mass from the axle.",
    i = "{.fn body_rod_end}, and {.fn body_point} with a {.arg radius_m}, name their axle."
  ), "missing", call)
}

#' @export
print.rot_scene_pendulum <- function(x, ...) {
  check_scene(x, current_env())
  print_axle(x, scene_title(x), paste0(
    describe_moment(x), " the axle, ", format_si(x$distance_m), " m from the centre of mass"
  ))
}
