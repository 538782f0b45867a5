#' A body on a fixed axle
#'
#' The scene that [trajectory()] computes, with `I` the moment of inertia about the axle:
#' \deqn{\frac{d(I\omega)}{dt} = \tau + \tau_r,\quad \frac{d\theta}{dt} = \omega}{
#'   d(I omega)/dt = torque + resistance,  d(theta)/dt = omega}
#'
#' The axle is the one that the body names, unless `through` says otherwise: through the end of a
#' [body_rod_end()], at `radius_m` from a [body_point()], through the centre of mass of any other
#' body. Where [place_body()] put a body does not matter. A message of class `rotdyn_message_axle`
#' says so where `through` is not given and the centre is not on the own axis parallel to the axle.
#' Weight does not act: see [scene_pendulum()] and [torque_gravity()].
#'
#' @param body A `rot_body` (see [body_disk()]), or one number: the moment of inertia about the axle
#'   in kg m^2. It must be greater than 0. Or [inertia_knots()], where it changes in time.
#' @param torque A torque law (see [torque] and [torque-terms]) or a sum of them, an R function, one
#'   number in N m, or NULL for none.
#' @param resistance A [resistance()], or NULL for none.
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity at `start_s`.
#' @param ... Not used; names after it must be given in full.
#' @param brake NULL, or a [brake()]. It does not go with [inertia_knots()].
#' @param start_s Time at which the state above holds. It does not depend on the output times;
#'   earlier ones are reached backwards.
#' @param axis Direction of the axle in the body's own axes: `"x"`, `"y"`, `"z"`, or three numbers
#'   of any length but 0.
#' @param through A point on the axle: NULL for the axle that the body names, `"centre"` (of mass),
#'   `"origin"` (of the body's own axes), or three numbers in m in the own axes. Ignored unless
#'   `body` is a `rot_body`.
#' @return A `rot_scene_axle`, which is a `rot_scene`; with a brake a [scene_drive()] of one rotor,
#'   which has the heat of the brake.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf,
#'   no moment of inertia, a brake on an inertia that changes), `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.3.
#' @seealso [trajectory()] for the motion, [torque] and [torque-terms], [resistance()],
#'   [stopping()], [scene_pendulum()], [autoplot.rot_scene()].
#' @concept flywheel
#' @concept wheel
#' @concept disc
#' @concept fixed axis
#' @concept merry-go-round
#' @concept motor
#' @concept turntable
#' @concept pulley
#' @concept fan
#' @concept torque
#' @examples
#' scene_axle(
#'   body_disk(mass_kg = 2, radius_m = 0.25),
#'   torque_knots(time_s = c(0, 1, 4, 6, 8), torque_n_m = c(0, 0.8, 0.8, 0, 0)),
#'   resistance(viscous_n_m_s = 0.03)
#' )
#' # A rod that turns about its end.
#' scene_axle(body_rod_end(mass_kg = 1.5, length_m = 2), 0.8)
#' # A grindstone that a brake stops from 2 s on.
#' stone <- scene_axle(
#'   body_disk(50, 0.3), torque_steps(c(0, 2), c(9, 0)), brake = brake(30, from_s = 2)
#' )
#' stopping(stone)
#' @export
scene_axle <- function(body, torque = NULL, resistance = NULL, theta0_rad = 0,
                       omega0_rad_per_s = 0, ..., brake = NULL, start_s = 0, axis = c(0, 0, 1),
                       through = NULL) {
  call <- environment()
  check_no_dots(...)
  if (is.character(through) && inherits(body, "rot_body")) {
    through <- as_point(through, check_body(body, call), "through", call)
  }
  scene <- scene_of_inputs("axle", call)
  if (is.null(through)) say_axle_in_centre(scene)
  if (is.null(brake)) scene else braked_axle(scene, brake, call)
}

# A drive of one rotor.
braked_axle <- function(scene, brake, call) {
  check_class(brake, "rot_brake", "brake", "Describe one with {.fn brake}.", call)
  if (!is.null(changing_inertia(scene))) {
    abort_rotdyn(c(
      "A {.arg brake} does not go with a moment of inertia that changes in time.",
      i = "A brake that always acts is {.code resistance(coulomb_n_m = )}."
    ), "value", call)
  }
  body <- .subset2(scene, "body")
  scene_drive(
    # About this axle, which a drive does not know.
    if (inherits(body, "rot_body")) scene$moment_of_inertia_kg_m2 else body,
    torque = if (!is.null(scene$torque)) list(scene$torque),
    resistance = if (!is.null(scene$resistance)) list(scene$resistance), brake = list(brake),
    theta0_rad = scene$theta0_rad, omega0_rad_per_s = scene$omega0_rad_per_s,
    start_s = scene$start_s
  )
}

# The user may have meant the own axis parallel to the axle, where that misses the centre of mass.
say_axle_in_centre <- function(scene) {
  body <- .subset2(scene, "body")
  if (!inherits(body, "rot_body")) return(invisible())
  off <- off_own_axis(body, .subset2(scene, "axis"))
  if (off == 0) return(invisible())
  cli::cli_inform(
    c(
      "The axle is taken through the centre of mass, {format_si(off)} m from the body's own axis.",
      i = "{.code through = \"centre\"} says that it is meant; {.code through = \"origin\"} takes
           the own axis instead."
    ),
    class = c("rotdyn_message_axle", "rotdyn_message")
  )
}

# Distance in m of the centre of mass from the own axis of that direction: 0 within rounding, and of
# a body that names its axle.
off_own_axis <- function(body, axis) {
  centre <- as.double(.subset2(body, "centre_m"))
  if (all(centre == 0) || nzchar(axis_shape(body))) return(0)
  off <- centre - sum(centre * axis) * axis
  size <- sqrt(sum(diag(body$second_moment_kg_m2)) / body$mass_kg)
  if (!is.finite(size)) size <- 0
  if (max(abs(off)) <= 16 * .Machine$double.eps * (size + max(abs(centre)))) return(0)
  sqrt(sum(off^2))
}

# How the moment of inertia changes in time, or NULL.
changing_inertia <- function(scene) {
  body <- .subset2(scene, "body")
  if (inherits(body, "rot_inertia_knots")) body
}

# A scene of 1 kg m^2 at rest, for questions about what acts.
bare_axle <- function(torque, start_s, resistance = NULL) {
  structure(
    list(
      body = 1, torque = torque, resistance = resistance, theta0_rad = 0, omega0_rad_per_s = 0,
      start_s = start_s, axis = c(0, 0, 1), moment_of_inertia_kg_m2 = 1
    ),
    class = c("rot_scene_axle", "rot_scene")
  )
}

# The law of all torques on the axle, and what resists: each constructor's record says.
axle_torque <- function(scene) constraint_of(scene)$torque(scene)
axle_resistance <- function(scene) constraint_of(scene)$resistance(scene)

given_torque <- function(scene) .subset2(scene, "torque") %||% torque_constant(0)
given_resistance <- function(scene) .subset2(scene, "resistance") %||% new_resistance(0)

#' @export
print.rot_scene_axle <- function(x, ...) {
  check_scene(x, current_env())
  body <- .subset2(x, "body")
  turns <- changing_inertia(x)
  print_axle(
    x, scene_title(x),
    inertia = if (is.null(turns)) {
      about <- if (inherits(body, "rot_body")) describe_point(body, x$through)
      paste0(describe_moment(x), " the axle", if (length(about)) paste0(", ", about))
    } else {
      describe_inertia_knots(turns)
    }
  )
}

describe_moment <- function(x) paste(format_si(x$moment_of_inertia_kg_m2), "kg m^2 about")

# A scene on an axle: a title, and what stands in its lines; `more`: in front of them.
print_axle <- function(x, title, inertia, torque = describe_torque(axle_torque(x)), more = NULL,
                       gears = NULL) {
  say(
    "<rot_scene> ", title, "\n",
    more,
    "  inertia     ", inertia, "\n",
    "  torque      ", torque, "\n",
    "  resistance  ", describe_resistance(axle_resistance(x)), "\n",
    if (!is.null(gears)) c("  gears       ", gears, "\n"),
    "  start       theta ", format_si(x$theta0_rad), " rad, omega ",
    format_si(x$omega0_rad_per_s), " rad/s at ", format_si(x$start_s), " s\n"
  )
  invisible(x)
}
