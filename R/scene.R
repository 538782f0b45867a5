#' A body on a fixed axle
#'
#' The scene that [trajectory()] computes: `I d(omega)/dt = torque - c omega`,
#' `d(theta)/dt = omega`, with `I` the moment of inertia about the axle through the centre of mass.
#'
#' @param body A `rot_body` (see [body_disk()]), or one number: the moment of inertia about the axle
#'   in kg m^2. It must be greater than 0.
#' @param torque A torque law (see [torque_knots()]), an R function, one number in N m, or NULL for
#'   none.
#' @param resistance A [resistance()], or NULL for none.
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity at `start_s`.
#' @param ... Not used; names after it must be given in full.
#' @param start_s Time at which the state above holds. Output times do not move it: what a scene
#'   does cannot depend on when it is looked at. Times before it are reached backwards.
#' @param axis Direction of the axle in the body's own axes, any length but 0.
#' @return A `rot_scene_axle`, which is a `rot_scene`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (no inertia to
#'   turn included), `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.3.
#' @examples
#' scene_axle(
#'   body_disk(mass_kg = 2, radius_m = 0.25),
#'   torque_knots(time_s = c(0, 1, 4, 6, 8), torque_n_m = c(0, 0.8, 0.8, 0, 0)),
#'   resistance(viscous_n_m_s = 0.03)
#' )
#' @export
scene_axle <- function(body, torque = NULL, resistance = NULL, theta0_rad = 0,
                       omega0_rad_per_s = 0, ..., start_s = 0, axis = c(0, 0, 1)) {
  call <- rlang::current_env()
  if (missing(body)) {
    check_supplied("body", call)
  }
  check_no_dots(...)
  if (inherits(body, "rot_body")) {
    axis <- check_finite(axis, "axis", "1", call)
    if (length(axis) != 3L || all(axis == 0)) {
      abort_rotdyn("{.arg axis} must be three numbers, not all 0.", "value", call)
    }
    axis <- axis / max(abs(axis))
    axis <- axis / sqrt(sum(axis^2))
    inertia <- moment_about_axis(body, axis)
  } else if (is.numeric(body)) {
    inertia <- check_number(body, "body", "kg*m^2", call)
    body <- NULL
  } else {
    check_class(
      body, "rot_body", "body",
      "Make one with {.fn body_disk}, or give the moment of inertia as one number in kg m^2.", call
    )
  }
  if (!(is.finite(inertia) && inertia > 0)) {
    abort_rotdyn(
      c(
        "The body must have a moment of inertia about its axle, finite and greater than 0.",
        x = "It is {format(inertia)} kg m^2.",
        i = "Without inertia there is no equation of motion: check mass, size and {.arg axis}."
      ),
      "value",
      call
    )
  }
  scene <- list(
    body = body,
    moment_of_inertia_kg_m2 = inertia,
    axis = axis,
    torque = as_torque(torque, call),
    resistance = as_resistance(resistance, call),
    theta0_rad = check_number(theta0_rad, "theta0_rad", "rad", call),
    omega0_rad_per_s = check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
    start_s = check_number(start_s, "start_s", "s", call)
  )
  class(scene) <- c("rot_scene_axle", "rot_scene")
  scene
}

#' @export
print.rot_scene_axle <- function(x, ...) {
  body <- if (is.null(x$body)) "a body" else x$body$shape
  cat(
    "<rot_scene> ", body, " on a fixed axle\n",
    "  inertia     ", format_si(x$moment_of_inertia_kg_m2), " kg m^2 about the axle\n",
    "  torque      ", describe_torque(x$torque), "\n",
    "  resistance  ", describe_resistance(x$resistance), "\n",
    "  start       theta ", format_si(x$theta0_rad), " rad, omega ",
    format_si(x$omega0_rad_per_s), " rad/s at ", format_si(x$start_s), " s\n",
    sep = ""
  )
  invisible(x)
}
