#' Torque of a force, angular momentum of a point
#'
#' \deqn{\vec\tau = \vec r \times \vec F,\quad |\tau| = r F \sin\phi, \qquad
#'   \vec L = \vec r \times m \vec v,\quad |L| = r m v \sin\phi}{
#'   tau = r x F, |tau| = r F sin(phi);  L = r x m v, |L| = r m v sin(phi)}
#'
#' `torque_of_force()` and `angular_momentum_of_point()` take the angle from the radius to the
#' force, or to the velocity: numbers or columns of length 1 or n. `torque_vector()` and
#' `angular_momentum_vector()` take vectors in space. Positive is right-handed: from the radius to
#' the force.
#'
#' @param force_n Size of the force in N; three components for `torque_vector()`.
#' @param radius_m Distance in m from the axle to the point where the force acts, or to the mass.
#' @param angle_deg Angle in degrees from the radius to the force or velocity, any sign.
#' @param mass_kg Mass in kg, >= 0.
#' @param speed_m_per_s Speed in m/s.
#' @param position_m,velocity_m_per_s Position and velocity: three numbers.
#' @param about_m The point about which the moment is taken: three numbers.
#' @param ... Not used: an unknown argument is an error.
#' @return Numbers in N m, or in kg m^2/s; of the vectors, three of them named x, y, z. NA and NaN
#'   are kept in columns.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 1.1.
#' @seealso [scene_axle()] for the motion under a torque; [moment_of_inertia()].
#' @concept torque
#' @concept lever arm
#' @concept angular momentum
#' @examples
#' # A spanner of 0.25 m pulled with 40 N, at right angles and at 60 degrees.
#' torque_of_force(40, 0.25, c(90, 60))
#' torque_vector(force_n = c(0, 40, 0), position_m = c(0.25, 0, 0))
#' # The wheel that it turns.
#' trajectory(scene_axle(body_disk(2, 0.25), torque_of_force(40, 0.25)), 0:2)
#' # A planet at the perihelion; a puck that passes a post 0.3 m aside.
#' angular_momentum_of_point(5.97e24, 30290, 1.471e11)
#' angular_momentum_vector(0.16, velocity_m_per_s = c(20, 0, 0), position_m = c(-1, -0.3, 0))
#' @export
torque_of_force <- function(force_n, radius_m, angle_deg = 90, ...) {
  call <- check_no_dots(...)
  check_supplied(c("force_n", "radius_m"), call)
  lever_column(list(force_n = force_n, radius_m = radius_m, angle_deg = angle_deg), 1, call)
}

#' @rdname torque_of_force
#' @export
torque_vector <- function(force_n, position_m, about_m = c(0, 0, 0), ...) {
  call <- check_no_dots(...)
  check_supplied(c("force_n", "position_m"), call)
  moment_vector(1, check_vector(force_n, "force_n", "N", call), position_m, about_m, call)
}

#' @rdname torque_of_force
#' @export
angular_momentum_of_point <- function(mass_kg, speed_m_per_s, radius_m, angle_deg = 90, ...) {
  call <- check_no_dots(...)
  check_supplied(c("mass_kg", "speed_m_per_s", "radius_m"), call)
  mass_kg <- check_column(mass_kg, "mass_kg", "kg", call)
  check_not_negative(mass_kg, "mass_kg", "kg", call)
  columns <- list(speed_m_per_s = speed_m_per_s, radius_m = radius_m, angle_deg = angle_deg)
  lever_column(columns, mass_kg, call)
}

#' @rdname torque_of_force
#' @export
angular_momentum_vector <- function(mass_kg, velocity_m_per_s, position_m, about_m = c(0, 0, 0),
                                    ...) {
  call <- check_no_dots(...)
  check_supplied(c("mass_kg", "velocity_m_per_s", "position_m"), call)
  mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  velocity <- check_vector(velocity_m_per_s, "velocity_m_per_s", "m/s", call)
  moment_vector(mass_kg, velocity, position_m, about_m, call)
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
