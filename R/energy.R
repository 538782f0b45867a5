#' Translational and rotational kinetic energy of a rolling body
#'
#' For a body that rolls with a given speed of its centre:
#' \deqn{K_{trans} = \frac{m v^2}{2}, \qquad K_{rot} = \beta\,\frac{m v^2}{2}, \qquad
#'   \beta = \frac{I}{m r^2}}{
#'   K_trans = m v^2/2,  K_rot = beta m v^2/2,  beta = I/(m r^2)}
#'
#' @param body A round body such as [body_sphere()], or a list of bodies; or names of shapes such as
#'   `"hoop"` or numbers, `beta` (at least 0), with `mass_kg` and `radius_m` beside them.
#' @param speed_m_per_s Speed of the centre: a column of length 1 or n.
#' @param mass_kg,radius_m Mass (at least 0) and radius (greater than 0) where `body` has none.
#'   Without them energies or the angular velocity are NA; the fractions depend on beta alone.
#' @param ... Not used; names after it must be given in full.
#' @return A tibble with one row for each body: mass, radius, beta and speed, then
#'   `r describe_columns(energy_columns)`
#'   NA in a row gives NA in the values that depend on it. Products have at most four roundings.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Koenig's theorem: Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002),
#'   section 1.2.
#' @seealso [kinetic_energy()] of a body that need not roll, [rolling_table()],
#'   [augment.rot_trajectory()].
#' @concept kinetic energy
#' @concept energy fraction
#' @examples
#' energy_partition(body_sphere(0.2, 0.05), speed_m_per_s = 3)
#' energy_partition(c(1, 0.5, 0.4), speed_m_per_s = 3, mass_kg = 1, radius_m = 0.1)
#' energy_partition(c("hoop", "disk"), 3)[c("beta", "rotational_energy_fraction")]
#' @export
energy_partition <- function(body, speed_m_per_s, ..., mass_kg = NULL, radius_m = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("body", "speed_m_per_s"), call)
  are_bodies <- inherits(body, "rot_body") ||
    (is.list(body) && any(vapply(body, inherits, NA, "rot_body")))
  known <- if (are_bodies) {
    if (!is.null(mass_kg) || !is.null(radius_m)) {
      abort_rotdyn(
        "{.arg {if (is.null(mass_kg)) 'radius_m' else 'mass_kg'}} is known of a body.", "argument",
        call
      )
    }
    columns_of_bodies(body, c("mass_kg", "radius_m", "beta"), "body", call)
  } else {
    list(
      mass_kg = mass_kg %||% NA_real_, radius_m = radius_m %||% NA_real_,
      beta = check_column(body, "body", "1", call)
    )
  }
  columns <- check_columns_of(
    c(known, list(speed_m_per_s = speed_m_per_s)), c("kg", "m", "1", "m/s"), call
  )
  n <- check_recyclable(columns, call)
  check_not_negative(columns$mass_kg, "mass_kg", "kg", call)
  check_not_negative(columns$beta, "beta", "1", call)
  check_not_negative(columns$radius_m, "radius_m", "m", call, open = TRUE)
  values <- .Call(
    ffi_energy_partition, columns$mass_kg, columns$radius_m, columns$beta, columns$speed_m_per_s
  )
  warn_beyond(values, columns, n, call)
  fractions <- list(
    rotational_energy_fraction = .Call(ffi_rolling_value, 3L, columns["beta"])[[1]],
    translational_energy_fraction = .Call(ffi_rolling_value, 4L, columns["beta"])[[1]]
  )
  new_table(
    lapply(c(columns, values, fractions), rep_len, n), nrow = n,
    first = grep("_energy_", names(c(values, fractions)), value = TRUE)
  )
}

#' Kinetic energy of a body
#'
#' Of a body that turns about an axle, flies, or does both:
#' \deqn{K = \frac{m v^2}{2} + \frac{I \omega^2}{2}}{K = m v^2/2 + I omega^2/2}
#' with the speed v of the centre of mass. The moment of inertia I of a body is that about its own z
#' axis through the centre of mass; of one that turns about an axle in place, that about the axle
#' that it names (the end of a [body_rod_end()]).
#'
#' @param body A `rot_body`, or moments of inertia in kg m^2, at least 0.
#' @param omega_rad_per_s Angular velocity in rad/s.
#' @param speed_m_per_s Speed of the centre of mass in m/s; 0 for a body on an axle.
#' @param ... Not used: an unknown argument is an error.
#' @param mass_kg Mass in kg where `body` is a moment of inertia and has a speed.
#' @return Energies in J. Arguments have length 1 or n; NA gives NA.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 1.2.
#' @seealso [energy_partition()] for a body that rolls, [angular_momentum_of()],
#'   [moment_of_inertia()].
#' @concept rotational energy
#' @concept flywheel
#' @concept kinetic energy
#' @concept energy
#' @examples
#' kinetic_energy(body_disk(2, 0.25), omega_rad_per_s = c(10, 20))
#' # A flywheel of 3 kg m^2 at 3000 rpm; a boomerang that flies and turns.
#' kinetic_energy(3, convert_angle(3000, "rpm", "rad/s"))
#' kinetic_energy(0.08, omega_rad_per_s = 60, speed_m_per_s = 15, mass_kg = 1)
#' @export
kinetic_energy <- function(body, omega_rad_per_s, speed_m_per_s = 0, ..., mass_kg = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("body", "omega_rad_per_s"), call)
  flies <- !identical(speed_m_per_s, 0)
  if (inherits(body, "rot_body")) {
    check_body(body, call)
    if (!is.null(mass_kg)) abort_rotdyn("{.arg mass_kg} is known of a body.", "argument", call)
    inertia <- if (flies) moment_about_axis(body, c(0, 0, 1)) else named_moment(body, c(0, 0, 1))
    mass_kg <- body$mass_kg
  } else {
    inertia <- check_column(body, "body", "kg*m^2", call)
    if (flies && is.null(mass_kg)) {
      abort_rotdyn(c(
        "{.arg mass_kg} is missing: a moment of inertia that moves needs its mass.",
        i = "A body has one, such as {.fn body_disk}."
      ), "missing", call)
    }
  }
  columns <- check_columns_of(
    list(
      body = inertia, mass_kg = mass_kg %||% 0, omega_rad_per_s = omega_rad_per_s,
      speed_m_per_s = speed_m_per_s
    ),
    c("kg*m^2", "kg", "rad/s", "m/s"), call
  )
  n <- check_recyclable(columns, call)
  check_not_negative(columns$body, "body", "kg*m^2", call)
  check_not_negative(columns$mass_kg, "mass_kg", "kg", call)
  turning <- 0.5 * columns$body * columns$omega_rad_per_s^2
  out <- if (flies) turning + 0.5 * columns$mass_kg * columns$speed_m_per_s^2 else turning
  attributes(out) <- NULL
  warn_beyond(list(result = out), columns, n, call)
  out
}
