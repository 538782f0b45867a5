#' Angular motion at constant angular acceleration
#'
#' Any three of the five quantities give the other two: omit two arguments. Vectors have length 1 or
#' n.
#'
#' \deqn{\omega = \omega_0 + \alpha t,\quad \theta = \omega_0 t + \tfrac12 \alpha t^2,\quad
#'   \theta = \tfrac12 (\omega_0 + \omega)\, t,\quad \omega^2 = \omega_0^2 + 2 \alpha \theta}{
#'   omega = omega0 + alpha t,  theta = omega0 t + alpha t^2/2,  theta = (omega0 + omega) t/2,
#'   omega^2 = omega0^2 + 2 alpha theta}
#'
#' For the acceleration, the angle and one of the rates there may be two motions, since the angle
#' may be passed twice, outward and on the return. Both are returned, the smaller time first; a
#' negative time is before the start.
#'
#' @param theta_rad Angle turned in the time, in rad.
#' @param omega0_rad_per_s,omega_rad_per_s Angular velocity at the start and at the end, in rad/s.
#' @param alpha_rad_per_s2 Angular acceleration in rad/s^2.
#' @param time_s Time since the start in s.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble: `r describe_columns(motion_columns)`
#'   One row for each motion. NA in a row gives NA in the missing values. Where the three values are
#'   inconsistent or do not determine the motion, the missing ones are NaN and `root` is NA, with
#'   one warning (class `rotdyn_warning_value`) that names the rows. The error is at most 0.51 ulp,
#'   with any cancellation and at any scale.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_missing` or `rotdyn_error_size` if not three are given,
#'   `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` for infinite numbers,
#'   `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 1.1.
#' @seealso [point_motion()] for a point of the body, [rad_per_s_from_rpm()] for rpm.
#' @examples
#' # A centrifuge stops from 7000 rpm in 10 s: number of turns.
#' down <- angular_motion(
#'   omega0_rad_per_s = rad_per_s_from_rpm(7000), omega_rad_per_s = 0, time_s = 10
#' )
#' turns_from_rad(down$theta_rad)
#'
#' # A decelerated body passes 1 rad twice.
#' angular_motion(theta_rad = 1, omega0_rad_per_s = 3, alpha_rad_per_s2 = -2)
#' @export
angular_motion <- function(theta_rad, omega0_rad_per_s, omega_rad_per_s, alpha_rad_per_s2, time_s,
                           ...) {
  call <- check_no_dots(...)
  columns <- list(
    theta_rad = if (!missing(theta_rad)) theta_rad,
    omega0_rad_per_s = if (!missing(omega0_rad_per_s)) omega0_rad_per_s,
    omega_rad_per_s = if (!missing(omega_rad_per_s)) omega_rad_per_s,
    alpha_rad_per_s2 = if (!missing(alpha_rad_per_s2)) alpha_rad_per_s2,
    time_s = if (!missing(time_s)) time_s
  )
  given <- !vapply(columns, is.null, logical(1))
  if (sum(given) != 3L) {
    abort_rotdyn(c(
      "Three of {.arg {names(columns)}} must be given.",
      x = if (any(given)) "Given: {.arg {names(columns)[given]}}." else "None is given."
    ), if (sum(given) < 3L) "missing" else "size", call)
  }
  for (arg in names(columns)[given]) {
    columns[[arg]] <- check_finite_or_na(columns[[arg]], arg, motion_units[[arg]], call)
  }
  check_recyclable(columns[given], call)
  values <- .Call(ffi_angular_motion, columns)
  kind <- values$kind
  values$kind <- NULL
  values$row <- as.integer(values$row)
  values$root <- as.integer(values$root)
  values$root[kind <= 0] <- NA_integer_
  warn_beyond(values[names(columns)], list(), length(kind), call)
  warn_no_motion(values$row[kind == 0], values$row[kind < 0], call)
  tibble::new_tibble(values[motion_columns], nrow = length(kind))
}

motion_units <- c(
  theta_rad = "rad", omega0_rad_per_s = "rad/s", omega_rad_per_s = "rad/s",
  alpha_rad_per_s2 = "rad/s^2", time_s = "s", radius_m = "m"
)

warn_no_motion <- function(none, many, call) {
  if (length(none) + length(many) == 0L) return(invisible())
  rows <- function(at) {
    cli::cli_vec(format(at, big.mark = ",", trim = TRUE), list("vec-trunc" = 6))
  }
  warn_rotdyn(c(
    "Some rows do not have a unique solution; their missing values are NaN.",
    x = if (length(none)) "The three values are inconsistent in row{?s} {rows(none)}.",
    x = if (length(many)) "They do not determine the motion in row{?s} {rows(many)}."
  ), "value", call)
}

check_finite_or_na <- function(x, arg, unit, call) {
  x <- check_column(x, arg, unit, call)
  bad <- which(is.infinite(x))
  if (length(bad)) {
    abort_domain(x[bad[1]], arg, unit, call, -Inf, Inf, FALSE, row = if (length(x) > 1L) bad[1])
  }
  x
}

#' Motion of a point of a rotating body
#'
#' Speed and acceleration of a point of a rotating body. `point_motion()` returns a tibble, the
#' other functions vectors, for use in `dplyr::mutate()`. Arguments have length 1 or n.
#'
#' | function | value |
#' |---|---|
#' | `tangential_speed()` | `omega r` |
#' | `tangential_acceleration()` | `alpha r` |
#' | `centripetal_acceleration()` | `omega^2 r` |
#'
#' @param omega_rad_per_s Angular velocity in rad/s.
#' @param alpha_rad_per_s2 Angular acceleration in rad/s^2.
#' @param radius_m Distance from the axle in m, at least 0.
#' @param ... Not used: an unknown argument is an error.
#' @return `point_motion()`: a tibble of the arguments, then `r describe_columns(point_columns)`
#'   The others: doubles. NA gives NA. Error: at most 3 ulp (2 ulp for the angle).
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_value` for infinite numbers or a negative radius, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 4.9.
#' @seealso [angular_motion()], [torque_of_force()] and [angular_momentum_of_point()].
#' @concept centripetal
#' @concept tangential
#' @examples
#' point_motion(omega_rad_per_s = 6, alpha_rad_per_s2 = -2.5, radius_m = c(0.1, 0.2, 0.3))
#' # A centrifuge in units of g:
#' centripetal_acceleration(rad_per_s_from_rpm(7000), radius_m = 0.1) / 9.80665
#' @export
point_motion <- function(omega_rad_per_s, alpha_rad_per_s2, radius_m, ...) {
  call <- check_no_dots(...)
  check_supplied(setdiff(names(formals()), "..."), call)
  columns <- check_point_columns(
    list(
      omega_rad_per_s = omega_rad_per_s, alpha_rad_per_s2 = alpha_rad_per_s2, radius_m = radius_m
    ),
    call
  )
  n <- check_recyclable(columns, call)
  values <- .Call(ffi_point_motion, columns[[1]], columns[[2]], columns[[3]])
  warn_beyond(values, columns, n, call)
  tibble::new_tibble(lapply(c(columns, values), rep_len, n), nrow = n)
}

#' @rdname point_motion
#' @export
tangential_speed <- function(omega_rad_per_s, radius_m, ...) {
  check_no_dots(...)
  one_point_column(
    list(omega_rad_per_s = omega_rad_per_s, radius_m = radius_m), "tangential_speed_m_per_s"
  )
}

#' @rdname point_motion
#' @export
tangential_acceleration <- function(alpha_rad_per_s2, radius_m, ...) {
  check_no_dots(...)
  one_point_column(
    list(alpha_rad_per_s2 = alpha_rad_per_s2, radius_m = radius_m),
    "tangential_acceleration_m_per_s2"
  )
}

#' @rdname point_motion
#' @export
centripetal_acceleration <- function(omega_rad_per_s, radius_m, ...) {
  check_no_dots(...)
  one_point_column(
    list(omega_rad_per_s = omega_rad_per_s, radius_m = radius_m),
    "centripetal_acceleration_m_per_s2"
  )
}

# The other quantity does not affect the column wanted.
one_point_column <- function(columns, wanted, call = parent.frame()) {
  check_supplied(setdiff(names(formals(sys.function(-1L))), "..."), call)
  columns <- check_point_columns(columns, call)
  n <- check_recyclable(columns, call)
  values <- .Call(
    ffi_point_motion, columns$omega_rad_per_s %||% 0, columns$alpha_rad_per_s2 %||% 0,
    columns$radius_m
  )[wanted]
  warn_beyond(values, columns, n, call)
  values[[1]]
}

check_point_columns <- function(columns, call) {
  for (arg in names(columns)) {
    columns[[arg]] <- check_finite_or_na(columns[[arg]], arg, motion_units[[arg]], call)
    attributes(columns[[arg]]) <- NULL
  }
  check_not_negative(columns$radius_m, "radius_m", "m", call)
  columns
}

#' Units of angles
#'
#' Degrees, turns and rpm to radians and rad/s, and back. The factors have 106 bits, so the error is
#' at most 0.51 ulp (of `deg * pi / 180` in base R: 2 ulp).
#'
#' @param angle_deg,angle_rad,turns Angles in degrees, radians, full turns.
#' @param omega_rpm,omega_rad_per_s Angular velocities in turns per minute, rad/s.
#' @return Doubles. NA stays NA; infinite values are unchanged.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_unit`.
#' @seealso [rotation_about()], [angular_motion()]. `units` objects are accepted wherever a unit
#'   is in the name of an argument.
#' @concept degrees
#' @concept rpm
#' @examples
#' rad_per_s_from_rpm(c(33 + 1 / 3, 45, 78))
#' turns_from_rad(rad_from_deg(540))
#' @name angle_units
NULL

#' @rdname angle_units
#' @export
rad_from_deg <- function(angle_deg) {
  convert_angle(angle_deg, "angle_deg", "degree", 0)
}

#' @rdname angle_units
#' @export
deg_from_rad <- function(angle_rad) {
  convert_angle(angle_rad, "angle_rad", "rad", 1)
}

#' @rdname angle_units
#' @export
rad_from_turns <- function(turns) {
  convert_angle(turns, "turns", "turn", 2)
}

#' @rdname angle_units
#' @export
turns_from_rad <- function(angle_rad) {
  convert_angle(angle_rad, "angle_rad", "rad", 3)
}

#' @rdname angle_units
#' @export
rad_per_s_from_rpm <- function(omega_rpm) {
  convert_angle(omega_rpm, "omega_rpm", "rpm", 4)
}

#' @rdname angle_units
#' @export
rpm_from_rad_per_s <- function(omega_rad_per_s) {
  convert_angle(omega_rad_per_s, "omega_rad_per_s", "rad/s", 5)
}

# `place` in ROT_ANGLE_UNIT_LIST of src/core/tables/kinematics.h, from 0.
convert_angle <- function(x, arg, unit, place, call = parent.frame()) {
  if (missing(x)) check_supplied(arg, call)
  .Call(ffi_convert_angle, check_column(x, arg, unit, call), place)
}
