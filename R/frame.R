#' Motions over a rotating planet
#'
#' A body that is dropped or thrown where the ground rotates, and a Foucault pendulum, in closed
#' form for any time, beside the formulas to the first order in the rotation and what those lack.
#'
#' \deqn{\ddot r = g - 2\,\Omega \times \dot r,\qquad
#'   \mathrm{east} \approx \tfrac13 \Omega g t^3 \cos\varphi}{
#'   r'' = g - 2 Omega x r',  east = Omega g t^3 cos(latitude)/3 to the first order}
#'
#' g is the effective gravity, uniform and along the plumb line, with the centrifugal part; the
#' curvature of the ground and its own fall-off are left out. For a drop of 100 m the formula of the
#' first order lacks 2e-8 of the deflection to the east, and all of that to the south.
#'
#' The pendulum swings in
#' \deqn{\ddot\zeta + 2 i \Omega\sin\varphi\,\dot\zeta + (g/l)\,\zeta = 0,\quad
#'   \zeta = \mathrm{east} + i\,\mathrm{north},}{
#'   zeta'' + 2 i Omega sin(latitude) zeta' + (g/l) zeta = 0,  zeta = east + i north,}
#' for swings that are small beside its length; its plane turns at `-Omega sin(latitude)`. A swing
#' that is an ellipse of half axes a, b turns in addition by `3/8 sqrt(g/l) a b/l^2`: the column
#' `ellipse_rate_rad_per_s`.
#'
#' @param time_s Time since the start in s, of any sign.
#' @param height_m Height of the fall in m, at least 0.
#' @param latitude_deg Latitude in degrees, -90 to 90, north positive.
#' @param east_m_per_s,north_m_per_s,up_m_per_s Velocity at the start, over the ground.
#' @param length_m Length of the pendulum in m, greater than 0.
#' @param east_m,north_m Where the pendulum starts, from below its point.
#' @param gravity_m_per_s2 Effective acceleration of gravity, greater than 0.
#' @param rotation_rad_per_s Rate of rotation of the planet; 7.292115e-5 rad/s is the Earth's.
#' @param ... Not used: an unknown argument is an error.
#' @return Tibbles; arguments have length 1 or n. `earth_projectile()`: the arguments `time_s` and
#'   `latitude_deg`, then `r describe_columns(projectile_columns)`
#'   `earth_drop()`: `height_m`, `latitude_deg`, then `r describe_columns(drop_columns)`
#'   `foucault_pendulum()`: `time_s`, `latitude_deg`, then `r describe_columns(foucault_columns)`
#'   NA in a row gives NA in what depends on it. Errors: some roundings of the largest term; the
#'   deflections keep their digits however small they are.
#'
#'   Where the rotation is so fast that the body never falls that far, the time is NaN. A pendulum
#'   that has swung by 2^52 rad or more is somewhere: its position and velocity are NaN.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision, and where the position of the pendulum is unknown.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` with the row of
#'   the first value outside its domain, `rotdyn_error_unit`, `rotdyn_error_missing`.
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), section 39; Goldstein, Poole and Safko,
#'   Classical Mechanics, 3rd ed. (2002), section 4.10. Rotation of the Earth: IERS Conventions
#'   (2010), table 1.2.
#' @seealso [to_rotating_frame()] for any frame and any motion.
#' @concept Coriolis
#' @concept Foucault
#' @concept rotating frame
#' @concept falling east
#' @concept Foucault pendulum
#' @examples
#' # Dropped from 100 m at 45 degrees: how far to the east, and what the formula lacks of it.
#' earth_drop(height_m = 100, latitude_deg = 45)
#' # A shell at 800 m/s to the north, after 60 s:
#' earth_projectile(60, latitude_deg = 50, north_m_per_s = 800, up_m_per_s = 300)
#' # The pendulum in the Pantheon, an hour after it was let go 3 m north:
#' foucault_pendulum(3600, latitude_deg = 48.85, length_m = 67, north_m = 3)
#' @export
earth_projectile <- function(time_s, latitude_deg, east_m_per_s = 0, north_m_per_s = 0,
                             up_m_per_s = 0, gravity_m_per_s2 = 9.80665,
                             rotation_rad_per_s = 7.292115e-5, ...) {
  call <- check_no_dots(...)
  check_supplied(c("time_s", "latitude_deg"), call)
  columns <- frame_columns(list(
    time_s = time_s, latitude_deg = latitude_deg, east_m_per_s = east_m_per_s,
    north_m_per_s = north_m_per_s, up_m_per_s = up_m_per_s, gravity_m_per_s2 = gravity_m_per_s2,
    rotation_rad_per_s = rotation_rad_per_s
  ), call)
  out <- .Call(ffi_frame_projectile, unname(columns))
  n <- length(out[[1]])
  warn_beyond(lapply(out, nan_as_inf), columns, n, call)
  new_table(c(lapply(columns[1:2], rep_len, n), out), nrow = n)
}

#' @rdname earth_projectile
#' @export
earth_drop <- function(height_m, latitude_deg, gravity_m_per_s2 = 9.80665,
                       rotation_rad_per_s = 7.292115e-5, ...) {
  call <- check_no_dots(...)
  check_supplied(c("height_m", "latitude_deg"), call)
  columns <- frame_columns(list(
    height_m = height_m, latitude_deg = latitude_deg, gravity_m_per_s2 = gravity_m_per_s2,
    rotation_rad_per_s = rotation_rad_per_s
  ), call)
  time_s <- .Call(ffi_frame_fall_time, unname(columns[c(4, 2, 3, 1)]))
  n <- length(time_s)
  path <- .Call(ffi_frame_projectile, c(
    list(time_s), unname(columns[2]), list(0, 0, 0), unname(columns[3:4])
  ))
  shown <- c("deflection_east_m", "deflection_north_m", "first_order_east_m")
  warn_beyond(c(list(fall_time_s = time_s), path[shown]), columns, n, call)
  turned <- 2 * columns$rotation_rad_per_s * time_s
  new_table(c(
    lapply(columns[1:2], rep_len, n),
    list(fall_time_s = time_s), path[shown],
    # 1 - y^2/20 < 6 (y - sin y)/y^3 < 1
    list(first_order_error = rep_len(turned^2 / 20, n))
  ), nrow = n)
}

#' @rdname earth_projectile
#' @export
foucault_pendulum <- function(time_s, latitude_deg, length_m, east_m = 0, north_m = 0,
                              east_m_per_s = 0, north_m_per_s = 0, gravity_m_per_s2 = 9.80665,
                              rotation_rad_per_s = 7.292115e-5, ...) {
  call <- check_no_dots(...)
  check_supplied(c("time_s", "latitude_deg", "length_m"), call)
  columns <- frame_columns(list(
    time_s = time_s, latitude_deg = latitude_deg, length_m = length_m, east_m = east_m,
    north_m = north_m, east_m_per_s = east_m_per_s, north_m_per_s = north_m_per_s,
    gravity_m_per_s2 = gravity_m_per_s2, rotation_rad_per_s = rotation_rad_per_s
  ), call)
  out <- .Call(ffi_frame_foucault, unname(columns[c(9, 2, 8, 3:7, 1)]))
  n <- length(out[[1]])
  rate <- out$plane_rate_rad_per_s
  # The area that the swing sweeps, as seen from where its plane stands still: a b sqrt(g/l), over
  # l^2.
  over <- lapply(columns[4:7], function(x) x / columns$length_m)
  area <- over$east_m * over$north_m_per_s - over$north_m * over$east_m_per_s -
    rate * (over$east_m^2 + over$north_m^2)
  turns <- list(plane_turn_s = 2 * pi / abs(rate), ellipse_rate_rad_per_s = 3 / 8 * area)
  warn_unknown(out[1:4], columns, n, call)
  warn_beyond(c(out, turns[2]), columns, n, call)
  new_table(
    c(lapply(columns[1:2], rep_len, n), out, lapply(turns, rep_len, n)), nrow = n,
    class = "rot_foucault"
  )
}

# Where the numbers of a row are known and a column of it is NaN, its phase is not.
warn_unknown <- function(values, given, n, call) {
  lost <- Reduce(`|`, lapply(values, is.nan))
  for (x in given) lost <- lost & !is.na(x)
  if (!any(lost)) return(invisible())
  warn_rotdyn(c(
    "{.field {names(values)}} are unknown: a double has no digit of the phase.",
    x = "They are NaN in row {which(lost)[1]}."
  ), "range", call)
}

frame_units <- c(
  time_s = "s", height_m = "m", latitude_deg = "degree", east_m_per_s = "m/s",
  north_m_per_s = "m/s", up_m_per_s = "m/s", gravity_m_per_s2 = "m/s^2",
  rotation_rad_per_s = "rad/s", length_m = "m", east_m = "m", north_m = "m"
)

# Finite columns in their domains, or NA.
frame_columns <- function(columns, call) {
  columns <- check_columns_of(columns, frame_units[names(columns)], call)
  for (name in names(columns)) {
    bad <- which(is.infinite(columns[[name]]))
    if (length(bad)) {
      abort_domain(
        columns[[name]][bad[1]], name, frame_units[[name]], call, -Inf, Inf, FALSE, row = bad[1]
      )
    }
  }
  for (name in intersect(c("gravity_m_per_s2", "length_m"), names(columns))) {
    check_not_negative(columns[[name]], name, frame_units[[name]], call, open = TRUE)
  }
  if (!is.null(columns$height_m)) check_not_negative(columns$height_m, "height_m", "m", call)
  bad <- which(abs(columns$latitude_deg) > 90)
  if (length(bad)) {
    abort_domain(columns$latitude_deg[bad[1]], "latitude_deg", "degree", call, -90, 90, FALSE,
                 row = bad[1])
  }
  check_recyclable(columns, call)
  columns
}

# ---- any frame ----------------------------------------------------------------------------------

#' A motion seen from a rotating frame
#'
#' Carries positions, velocities and accelerations of a point into a frame that rotates about an
#' axis through the origin, and out of it, row by row. The accelerations that appear in the frame
#' are columns.
#'
#' \deqn{v' = v - \omega \times r',\quad
#'   a' = a - \omega\times(\omega\times r') - 2\,\omega \times v' - \alpha \times r'}{
#'   v' = v - omega x r',  a' = a - omega x (omega x r') - 2 omega x v' - alpha x r'}
#'
#' All vectors on the right are along the axes of the frame, which agree with those of space where
#' the frame's angle is 0.
#'
#' @param motion A data frame with the columns `x_m`, `y_m`, `z_m`, and, where they matter,
#'   `vx_m_per_s`, ... and `ax_m_per_s2`, ...: all three of a kind, or none. `z` may be left out: it
#'   is 0. Other columns are kept.
#' @param frame The frame's rotation: one number, its constant rate in rad/s (then `motion` needs
#'   `time_s`, and the angle is 0 at time 0); or a data frame with the columns `theta_rad`,
#'   `omega_rad_per_s` and `alpha_rad_per_s2` (0 where there is none), one row for each row of
#'   `motion`; or a [trajectory()] of a [scene_axle()], which is computed at the times of `motion`.
#' @param axis The frame's axis: `"x"`, `"y"`, `"z"`, or three numbers.
#' @param ... Not used; names after it must be given in full.
#' @return A tibble of the columns of `motion`, with positions, velocities and accelerations of the
#'   other side (velocities and accelerations where they were given), then, where velocities were
#'   given, the columns `r describe_columns(frame_term_columns)`
#'   which are along the axes of the rotating frame on both ways. Into a frame and out of it again
#'   gives the motion back to some roundings of the largest term.
#' @section Errors: `rotdyn_error_type` (a column is missing, no motion of an axle),
#'   `rotdyn_error_size`, `rotdyn_error_value`, `rotdyn_error_unit`, `rotdyn_error_missing`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 4.9 and 4.10.
#' @seealso [earth_projectile()], [point_motion()].
#' @concept Coriolis
#' @concept centrifugal
#' @concept merry-go-round
#' @concept centrifugal force
#' @examples
#' # A puck that slides straight over a carousel, as its riders see it:
#' puck <- data.frame(time_s = 0:4, x_m = 0:4 - 2, y_m = 1, vx_m_per_s = 1, vy_m_per_s = 0)
#' seen <- to_rotating_frame(puck, frame = 0.5)
#' seen
#' from_rotating_frame(seen, frame = 0.5)
#' @export
to_rotating_frame <- function(motion, frame, axis = "z", ...) {
  call <- check_no_dots(...)
  check_supplied(c("motion", "frame"), call)
  carry(motion, frame, axis, TRUE, call)
}

#' @rdname to_rotating_frame
#' @export
from_rotating_frame <- function(motion, frame, axis = "z", ...) {
  call <- check_no_dots(...)
  check_supplied(c("motion", "frame"), call)
  carry(motion, frame, axis, FALSE, call)
}

carried_columns <- list(
  c("x_m", "y_m", "z_m"),
  c("vx_m_per_s", "vy_m_per_s", "vz_m_per_s"),
  c("ax_m_per_s2", "ay_m_per_s2", "az_m_per_s2")
)

carry <- function(motion, frame, axis, enters, call) {
  if (!is.data.frame(motion)) {
    abort_rotdyn(
      c("{.arg motion} must be a data frame.", x = "It is {describe_value(motion)}."), "type", call
    )
  }
  axis <- unit_axis(as_axis(axis, call), call)
  n <- nrow(motion)
  given <- vapply(carried_columns, function(names) any(names %in% names(motion)), NA)
  if (!given[1]) abort_missing_column("x_m", motion, call)
  if (given[3] && !given[2]) abort_missing_column("vx_m_per_s", motion, call)
  columns <- list()
  for (k in 1:3) {
    for (i in 1:3) {
      name <- carried_columns[[k]][i]
      value <- motion[[name]]
      if (is.null(value) && i < 3L && given[k]) abort_missing_column(name, motion, call)
      columns[[name]] <- if (is.null(value)) double(n) else {
        check_column(value, name, c("m", "m/s", "m/s^2")[k], call)
      }
    }
  }
  turn <- frame_rotation(frame, motion, call)
  out <- .Call(ffi_frame_carry, unname(c(columns, turn)), axis, enters)
  keep <- c(unlist(carried_columns[given]), if (given[2]) frame_term_columns)
  result <- as.list(motion)
  flat <- setdiff(keep, names(motion))
  flat <- flat[startsWith(flat, "z") | startsWith(flat, "vz") | startsWith(flat, "az")]
  # In a plane across the axis z nothing leaves it.
  drop <- if (identical(axis, c(0, 0, 1)) && length(flat)) {
    c(flat, grep("_z_", frame_term_columns, value = TRUE))
  }
  keep <- setdiff(keep, drop)
  result[keep] <- out[keep]
  new_table(result, nrow = n)
}

# list(theta, omega, alpha) of the frame for each row.
frame_rotation <- function(frame, motion, call) {
  n <- nrow(motion)
  time_s <- motion[["time_s"]]
  if (is_number(frame) || inherits(frame, "units")) {
    rate <- check_number(frame, "frame", "rad/s", call)
    if (is.null(time_s)) abort_missing_column("time_s", motion, call)
    time_s <- check_column(time_s, "time_s", "s", call)
    return(list(.Call(ffi_frame_angle, list(rate, Inf, time_s)), rate, 0))
  }
  if (inherits(frame, "rot_trajectory")) {
    if (is.null(time_s)) abort_missing_column("time_s", motion, call)
    if (!all(c("theta_rad", "omega_rad_per_s", "net_torque_n_m") %in% names(frame))) {
      abort_rotdyn("{.arg frame} must be a motion about one axle.", "type", call)
    }
    scene <- check_trajectory(frame, "frame", call)$scene
    turn <- stats::predict(frame, time_s)
    inertia <- scene$moment_of_inertia_kg_m2
    # Of a mass on a pulley the net torque is that on the pulley alone.
    alpha <- turn[["alpha_rad_per_s2"]] %||% (turn$net_torque_n_m / inertia)
    return(list(turn$theta_rad, turn$omega_rad_per_s, alpha))
  }
  if (!is.data.frame(frame)) {
    abort_rotdyn(c(
      "{.arg frame} must be a rate in rad/s, a data frame, or the motion of an axle.",
      x = "It is {describe_value(frame)}."
    ), "type", call)
  }
  names <- c("theta_rad", "omega_rad_per_s", "alpha_rad_per_s2")
  if (is.null(frame[["alpha_rad_per_s2"]])) frame$alpha_rad_per_s2 <- double(nrow(frame))
  for (name in names) if (is.null(frame[[name]])) abort_missing_column(name, frame, call)
  if (nrow(frame) != n) {
    abort_rotdyn(c(
      "{.arg frame} must have one row for each row of {.arg motion}.",
      x = "It has {nrow(frame)}, {.arg motion} has {n}."
    ), "size", call)
  }
  unname(check_columns_of(as.list(frame)[names], c("rad", "rad/s", "rad/s^2"), call))
}
