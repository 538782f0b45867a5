#' Torque of a force, angular momentum
#'
#' \deqn{\vec\tau = \vec r \times \vec F,\quad |\tau| = r F \sin\phi, \qquad
#'   \vec L = \vec r \times m \vec v + I \vec\omega,\quad L = r m v \sin\phi + I \omega}{
#'   tau = r x F, |tau| = r F sin(phi);  L = r x m v + I omega, L = r m v sin(phi) + I omega}
#'
#' In a plane by `radius_m` and the angle from the radius to the force or to the velocity: numbers
#' or columns of length 1 or n. In space by `position_m`: vectors of three numbers. Positive is
#' right-handed: from the radius to the force.
#'
#' @param force_n Size of the force in N; in space three components.
#' @param radius_m Distance in m from the axle to the point where the force acts, or to the mass.
#' @param angle_deg Angle in degrees from the radius to the force or velocity, any sign.
#' @param body A body, or a mass in kg, >= 0 (in a plane: a column).
#' @param speed_m_per_s Speed of the centre of mass in m/s.
#' @param omega_rad_per_s Angular velocity of the body in rad/s: about its own z axis in a plane
#'   (with a body alone this is all its angular momentum), three components along its own axes in
#'   space.
#' @param position_m,velocity_m_per_s Position and velocity in space: three numbers.
#' @param about_m The point about which the moment is taken: three numbers.
#' @param ... Not used; names after it must be given in full.
#' @return Numbers in N m, or in kg m^2/s; in space three of them named x, y, z. NA and NaN are kept
#'   in columns.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 1.1 and 1.2.
#' @seealso [scene_axle()] for the motion under a torque; [moment_of_inertia()].
#' @concept torque
#' @concept lever arm
#' @concept angular momentum
#' @concept spanner
#' @concept wrench
#' @concept lever
#' @concept door
#' @examples
#' # A spanner of 0.25 m pulled with 40 N, at right angles and at 60 degrees.
#' torque_of_force(40, 0.25, c(90, 60))
#' torque_of_force(c(0, 40, 0), position_m = c(0.25, 0, 0))
#' # The wheel that it turns.
#' trajectory(scene_axle(body_disk(2, 0.25), torque_of_force(40, 0.25)), 0:2)
#' # That wheel at 10 rad/s; a planet at the perihelion; a puck that passes a post 0.3 m aside.
#' angular_momentum_of(body_disk(2, 0.25), omega_rad_per_s = 10)
#' angular_momentum_of(5.97e24, 30290, 1.471e11)
#' angular_momentum_of(0.16, velocity_m_per_s = c(20, 0, 0), position_m = c(-1, -0.3, 0))
#' @export
torque_of_force <- function(force_n, radius_m, angle_deg = 90, ..., position_m,
                            about_m = c(0, 0, 0)) {
  call <- check_no_dots(...)
  in_space <- !missing(position_m)
  check_supplied(c("force_n", if (!in_space) "radius_m"), call)
  if (!in_space) {
    if (!missing(about_m)) abort_in_space("about_m", "position_m", call)
    return(lever_column(
      list(force_n = force_n, radius_m = radius_m, angle_deg = angle_deg), 1, call
    ))
  }
  if (!missing(radius_m) || !missing(angle_deg)) {
    abort_in_plane(if (missing(radius_m)) "angle_deg" else "radius_m", "position_m", call)
  }
  moment_vector(1, check_vector(force_n, "force_n", "N", call), position_m, about_m, call)
}

#' @rdname torque_of_force
#' @export
angular_momentum_of <- function(body, speed_m_per_s, radius_m, angle_deg = 90, ...,
                                omega_rad_per_s, velocity_m_per_s, position_m,
                                about_m = c(0, 0, 0)) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  is_body <- inherits(body, "rot_body")
  if (is_body) check_body(body, call)
  if (!missing(omega_rad_per_s) && !is_body) {
    abort_rotdyn(c(
      "{.arg omega_rad_per_s} needs a body, whose moment of inertia counts.",
      x = "{.arg body} is {describe_value(body)}, a mass."
    ), "type", call)
  }
  if (!missing(velocity_m_per_s) || !missing(position_m)) {
    check_supplied(c("velocity_m_per_s", "position_m"), call)
    if (!missing(speed_m_per_s) || !missing(radius_m)) {
      abort_in_plane(if (missing(speed_m_per_s)) "radius_m" else "speed_m_per_s",
                     c("velocity_m_per_s", "position_m"), call)
    }
    mass_kg <- if (is_body) body$mass_kg else check_number(body, "body", "kg", call, lower = 0)
    velocity <- check_vector(velocity_m_per_s, "velocity_m_per_s", "m/s", call)
    out <- moment_vector(mass_kg, velocity, position_m, about_m, call)
    if (missing(omega_rad_per_s)) return(out)
    omega <- check_vector(omega_rad_per_s, "omega_rad_per_s", "rad/s", call)
    return(out + as.double(body$inertia_kg_m2 %*% omega))
  }
  if (!missing(about_m)) abort_in_space("about_m", "position_m", call)
  spin <- if (missing(omega_rad_per_s)) {
    NULL
  } else {
    rate <- check_finite_or_na(omega_rad_per_s, "omega_rad_per_s", "rad/s", call)
    moment_about_axis(body, c(0, 0, 1)) * as.double(rate)
  }
  if (!is.null(spin) && missing(speed_m_per_s) && missing(radius_m)) return(spin)
  check_supplied(c("speed_m_per_s", "radius_m"), call)
  mass_kg <- if (is_body) body$mass_kg else check_column(body, "body", "kg", call)
  check_not_negative(mass_kg, "body", "kg", call)
  columns <- list(speed_m_per_s = speed_m_per_s, radius_m = radius_m, angle_deg = angle_deg)
  orbit <- lever_column(columns, mass_kg, call)
  if (is.null(spin)) return(orbit)
  check_recyclable(list(omega_rad_per_s = spin, speed_m_per_s = orbit), call)
  orbit + spin
}

abort_in_plane <- function(given, instead, call) {
  abort_rotdyn(c(
    "{.arg {given}} describes a plane, {.arg {instead}} describe{?s/} space: give one or the other."
  ), "argument", call)
}

abort_in_space <- function(given, needs, call) {
  abort_rotdyn("{.arg {given}} needs {.arg {needs}}, a vector in space.", "argument", call)
}

# `columns`: the size of the vector, the radius, the angle.
lever_column <- function(columns, factor, call) {
  units <- c(force_n = "N", speed_m_per_s = "m/s", radius_m = "m", angle_deg = "degree")
  columns <- check_columns_of(columns, units[names(columns)], call)
  check_not_negative(columns$radius_m, "radius_m", "m", call)
  for (arg in names(columns)) {
    at <- which(is.infinite(columns[[arg]]))
    if (length(at)) {
      abort_rotdyn(
        c("{.arg {arg}} must be finite.", x = "Element {at[1]} is infinite."), "value", call
      )
    }
  }
  n <- check_recyclable(c(columns, list(mass_kg = factor)), call)
  value <- .Call(ffi_lever, factor, columns$radius_m, columns[[1]], columns$angle_deg)
  warn_beyond(list(result = value), c(columns, list(factor)), n, call)
  value
}

moment_vector <- function(factor, vector, position_m, about_m, call) {
  position_m <- check_vector(position_m, "position_m", "m", call)
  about_m <- check_vector(about_m, "about_m", "m", call)
  value <- .Call(ffi_moment, factor, position_m, about_m, vector)
  warn_beyond(list(result = value), list(factor, vector, position_m, about_m), 3L, call)
  stats::setNames(value, c("x", "y", "z"))
}
