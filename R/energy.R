#' Translational and rotational kinetic energy of a rolling body
#'
#' For a body that rolls with a given speed of its centre:
#' \deqn{K_{trans} = \frac{m v^2}{2}, \qquad K_{rot} = \beta\,\frac{m v^2}{2}, \qquad
#'   \beta = \frac{I}{m r^2}}{
#'   K_trans = m v^2/2,  K_rot = beta m v^2/2,  beta = I/(m r^2)}
#'
#' @param mass_kg,radius_m,beta,speed_m_per_s Mass (at least 0), radius (greater than 0), `beta` (at
#'   least 0) and speed: columns of length 1 or n.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with one row for each body: the four arguments, then
#'   `r describe_columns(energy_columns)`
#'   NA in a row gives NA in the values that depend on it. Products have at most four roundings.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Koenig's theorem: Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002),
#'   section 1.2.
#' @seealso [rolling_table()], [rotational_energy_fraction()], [augment.rot_trajectory()].
#' @concept kinetic energy
#' @examples
#' energy_partition(mass_kg = 1, radius_m = 0.1, beta = c(1, 0.5, 0.4), speed_m_per_s = 3)
#' @export
energy_partition <- function(mass_kg, radius_m, beta, speed_m_per_s, ...) {
  call <- check_no_dots(...)
  check_supplied(c("mass_kg", "radius_m", "beta", "speed_m_per_s"), call)
  columns <- check_columns_of(
    list(mass_kg = mass_kg, radius_m = radius_m, beta = beta, speed_m_per_s = speed_m_per_s),
    c("kg", "m", "1", "m/s"), call
  )
  n <- check_recyclable(columns, call)
  check_not_negative(columns$mass_kg, "mass_kg", "kg", call)
  check_not_negative(columns$beta, "beta", "1", call)
  check_not_negative(columns$radius_m, "radius_m", "m", call, open = TRUE)
  values <- .Call(
    ffi_energy_partition, columns$mass_kg, columns$radius_m, columns$beta, columns$speed_m_per_s
  )
  warn_beyond(values, columns, n, call)
  fraction <- rotational_energy_fraction(columns$beta)
  tibble::new_tibble(
    lapply(c(columns, values, list(rotational_energy_fraction = fraction)), rep_len, n), nrow = n
  )
}
