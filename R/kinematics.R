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
#' @seealso [point_motion()] for a point of the body, [convert_angle()] for rpm and degrees.
#' @concept rpm
#' @concept angular acceleration
#' @concept constant acceleration
#' @concept kinematics
#' @concept revolutions
#' @examples
#' # A centrifuge stops from 7000 rpm in 10 s: number of turns.
#' down <- angular_motion(
#'   omega0_rad_per_s = convert_angle(7000, "rpm", "rad/s"), omega_rad_per_s = 0, time_s = 10
#' )
#' convert_angle(down$theta_rad, "rad", "turn")
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
      x = if (any(given)) "Given: {.arg {names(columns)[given]}}." else "None is given.",
      i = if (sum(given) == 2L && !given[["alpha_rad_per_s2"]]) {
        "At a constant angular velocity {.arg alpha_rad_per_s2} is 0."
      }
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
  new_table(values[motion_columns], nrow = length(kind), first = names(motion_units))
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
#' Speed and acceleration of a point of a rotating body. Arguments have length 1 or n.
#'
#' \deqn{v = \omega r,\quad a_t = \alpha r,\quad a_c = \omega^2 r}{
#'   v = omega r,  a_t = alpha r (tangential),  a_c = omega^2 r (centripetal)}
#'
#' @param omega_rad_per_s Angular velocity in rad/s; or instead of it `speed_m_per_s`.
#' @param radius_m Distance from the axle in m, at least 0; or a round body, whose radius counts.
#' @param alpha_rad_per_s2 Angular acceleration in rad/s^2.
#' @param ... Not used: an unknown argument is an error.
#' @param speed_m_per_s Speed of the point in m/s, from which `omega = v/r` follows: of a wheel that
#'   rolls, the speed of its centre. The radius is then greater than 0.
#' @return A tibble of angular velocity, radius and angular acceleration, then
#'   `r describe_columns(point_columns)`
#'   NA gives NA. Error: at most 3 ulp (2 ulp for the angle). In `dplyr::mutate()` a column is
#'   `point_motion(omega, r)$centripetal_acceleration_m_per_s2`.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_value` for infinite numbers or a negative radius, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 4.9.
#' @seealso [angular_motion()], [torque_of_force()] and [angular_momentum_of()].
#' @concept centripetal acceleration
#' @concept tangential speed
#' @concept tangential acceleration
#' @concept wheel
#' @concept bicycle
#' @concept speed at the rim
#' @examples
#' point_motion(omega_rad_per_s = 6, radius_m = c(0.1, 0.2, 0.3), alpha_rad_per_s2 = -2.5)
#' # A centrifuge in units of g:
#' rate <- convert_angle(7000, "rpm", "rad/s")
#' point_motion(rate, radius_m = 0.1)$centripetal_acceleration_m_per_s2 / 9.80665
#' # The wheel of a bicycle at 5 m/s:
#' point_motion(radius_m = 0.35, speed_m_per_s = 5)$omega_rad_per_s
#' @export
point_motion <- function(omega_rad_per_s, radius_m, alpha_rad_per_s2 = 0, ..., speed_m_per_s) {
  call <- check_no_dots(...)
  by_speed <- !missing(speed_m_per_s)
  check_supplied(c(if (!by_speed) "omega_rad_per_s", "radius_m"), call)
  if (by_speed) {
    if (!missing(omega_rad_per_s)) {
      abort_rotdyn(
        "Give {.arg omega_rad_per_s} or {.arg speed_m_per_s}, not both.", "argument", call
      )
    }
    omega_rad_per_s <- omega_of_speed(speed_m_per_s, radius_m, call)
  }
  columns <- check_point_columns(
    list(
      omega_rad_per_s = omega_rad_per_s, radius_m = radius_m, alpha_rad_per_s2 = alpha_rad_per_s2
    ),
    call
  )
  n <- check_recyclable(columns, call)
  values <- .Call(
    ffi_point_motion, columns$omega_rad_per_s, columns$alpha_rad_per_s2, columns$radius_m
  )
  warn_beyond(values, columns, n, call)
  new_table(lapply(c(columns, values), rep_len, n), nrow = n, first = names(values))
}

# v/r, for radii greater than 0.
omega_of_speed <- function(speed_m_per_s, radius_m, call) {
  given <- list(
    speed_m_per_s = check_finite_or_na(speed_m_per_s, "speed_m_per_s", "m/s", call),
    radius_m = check_finite_or_na(radius_m, "radius_m", "m", call)
  )
  check_recyclable(given, call)
  check_not_negative(given$radius_m, "radius_m", "m", call, open = TRUE)
  omega <- given$speed_m_per_s / given$radius_m
  beyond <- is.infinite(omega)
  if (any(beyond, na.rm = TRUE)) {
    abort_rotdyn("The angular velocity exceeds double precision.", "range", call)
  }
  omega
}

check_point_columns <- function(columns, call) {
  for (arg in names(columns)) {
    columns[[arg]] <- check_finite_or_na(columns[[arg]], arg, motion_units[[arg]], call)
    attributes(columns[[arg]]) <- NULL
  }
  check_not_negative(columns$radius_m, "radius_m", "m", call)
  columns
}

#' Units of angles and angular velocities
#'
#' Degrees, turns and rpm to radians and rad/s, and back. The factors have 106 bits, so the error is
#' at most 0.51 ulp (of `deg * pi / 180` in base R: 2 ulp).
#'
#' @param x Numbers, or a `units` object.
#' @param from,to Units of x and of the result: of an angle `"rad"`, `"degree"`, `"turn"`; of an
#'   angular velocity `"rad/s"`, `"degree/s"`, `"turn/s"`, `"rpm"` (turns per minute). `"deg"`,
#'   `"rev"`, plurals, and `"rad_per_s"` as in names of arguments, are the same.
#' @param ... Not used: an unknown argument is an error.
#' @return Doubles. NA stays NA; infinite values are unchanged.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_unit` (an angle to an
#'   angular velocity, too), `rotdyn_error_value` for an unknown unit.
#' @source NIST Special Publication 811 (2008), appendix B.8.
#' @seealso [rotation_about()], [angular_motion()]. `units` objects are accepted wherever a unit
#'   is in the name of an argument.
#' @concept degrees
#' @concept rpm
#' @concept revolutions
#' @examples
#' convert_angle(c(33 + 1 / 3, 45, 78), "rpm", "rad/s")
#' convert_angle(540, "degree", "turn")
#' @export
convert_angle <- function(x, from, to, ...) {
  call <- check_no_dots(...)
  check_supplied(c("x", "from", "to"), call)
  from <- check_angle_unit(from, "from", call)
  to <- check_angle_unit(to, "to", call)
  is_rate <- function(unit) unit == "rpm" || endsWith(unit, "/s")
  if (is_rate(from) != is_rate(to)) {
    kind <- function(unit) if (is_rate(unit)) "an angular velocity" else "an angle"
    abort_rotdyn(
      "{.val {from}} is the unit of {kind(from)}, {.val {to}} that of {kind(to)}.", "unit", call
    )
  }
  x <- check_column(x, "x", from, call)
  # The factors of angles are those of rates, too; rpm has its own.
  ends <- if ("rpm" %in% c(from, to)) c(from, to) else sub("/s$", "", c(from, to))
  place <- match(paste(ends, collapse = " "), angle_factors)
  out <- if (!is.na(place)) {
    .Call(ffi_convert_angle, x, place - 1)
  } else {
    # Rational parts of a turn: one product or one quotient.
    parts <- angle_parts[c(from, to)]
    if (from == to) x else if (parts[2] > parts[1]) x * (parts[[2]] / parts[[1]]) else
      x / (parts[[1]] / parts[[2]])
  }
  attributes(out) <- NULL
  warn_beyond(list(result = out), list(x = x), length(out), call)
  out
}

check_angle_unit <- function(x, arg, call) {
  known <- c("rad", names(angle_parts)[1:2], "rad/s", names(angle_parts)[3:5])
  if (is.character(x) && length(x) == 1L && !is.na(x) && is_readable_text(x)) {
    x <- sub("_per_s$", "/s", x) # as in names of arguments
    x <- sub("^(radian|degree|turn)s", "\\1", x)
    x <- sub("^radian", "rad", sub("^(rev|revolution)s?(?=/|$)", "turn", x, perl = TRUE))
    x <- sub("^deg(?=/|$)", "degree", x, perl = TRUE)
  }
  check_string(x, arg, known, call)
}

# In the order of ROT_ANGLE_UNIT_LIST of src/core/tables/kinematics.h.
angle_factors <- c("degree rad", "rad degree", "turn rad", "rad turn", "rpm rad/s", "rad/s rpm")
# Of a turn, of a turn per second.
angle_parts <- c(degree = 360, turn = 1, "degree/s" = 360, "turn/s" = 1, rpm = 60)
