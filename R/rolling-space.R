#' Rolling in space: a coin, and a ball on a turntable
#'
#' `roll_disk()` integrates a disk that rolls on a level floor without slipping, upright or leaning:
#' a coin, a hoop. Nothing is lost; the energy is its audit. `rolling_disk_speed()` is the speed
#' above which straight upright rolling is stable. `ball_on_turntable()` is exact: the centre of the
#' ball runs on a circle.
#'
#' With e the disk's axis and d the direction from the contact to the centre,
#' \deqn{v = r\,\omega \times d,\quad I\dot\omega + \omega\times I\omega = -r\,d\times F,\quad
#'   F = m(\dot v + g\hat z),\qquad
#'   v_{min}^2 = \frac{g r\, I_t\, m r^2}{I_a (I_a + m r^2)}}{
#'   v = r omega x d,  I omega' + omega x I omega = -r d x F,  F = m (v' + g z),
#'   v_min^2 = g r It m r^2/(Ia (Ia + m r^2))}
#' which is g r/3 for a uniform disk and g r/4 for a hoop. Slower, the lean grows, and the disk
#' begins to wobble. The ball obeys
#' \deqn{\dot v = k\,\hat z \times v,\quad k = \frac{\beta}{1+\beta}\,\Omega,}{
#'   v' = k z x v,  k = beta/(1 + beta) Omega,}
#' 2/7 of the table's rate for a solid ball; the friction does the work m k Omega (r^2 - r0^2)/2.
#'
#' @param time_s Times in s, which do not decrease; the motion starts at 0, earlier times are
#'   reached backwards. Of the ball, of length 1 or n.
#' @param body A round body that rolls on its rim, such as [body_disk()] or [body_hoop()]; for
#'   `ball_on_turntable()` a ball, such as [body_sphere()]; or a list of bodies (not for
#'   `roll_disk()`). Its mass, radius and moments about its axis and across it count.
#' @param spin_rad_per_s Rate about the own axis of the disk; of the ball, about the vertical.
#' @param lean_deg Angle of the disk from upright, between -90 and 90; a positive one raises its
#'   axis. At time 0 it heads along x, and its axis is along y, or leans towards z from there.
#' @param yaw_rad_per_s,lean_rad_per_s Rates about the vertical and of the lean at time 0.
#' @param accuracy Relative accuracy wanted of the disk's attitude and angular velocity, in (0, 1].
#' @param turntable_rad_per_s Rate of the table.
#' @param x_m,y_m,vx_m_per_s,vy_m_per_s Where the ball starts, from the table's axis, and its
#'   velocity over the ground: that of the table under it is `(-Omega y, Omega x)`.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param ... Not used; names after it must be given in full.
#' @return `roll_disk()`: a tibble with `time_s` and
#'   `r describe_columns(roll_disk_columns[-1], roll_disk_meanings)`
#'   Rows after it has fallen flat are NA, and a warning of class `rotdyn_warning_truncated` says
#'   when that was. The attribute `error` has the estimated errors of attitude (rad), angular
#'   velocity (relative) and position (m).
#'   `rolling_disk_speed()`: a tibble with
#'   `r describe_columns(disk_speed_columns)`
#'   `ball_on_turntable()`: a tibble with `time_s` and
#'   `r describe_columns(turntable_columns[-1], turntable_meanings)`
#'   Without rotation the ball goes straight: the circle's radius and period are Inf, its centre
#'   NaN. NA gives NA.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_time`,
#'   `rotdyn_error_value`, `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Routh, Advanced Rigid Dynamics, 6th ed. (1905), sections 244 to 247; O'Reilly, Nonlinear
#'   Dynamics 10 (1996) 287; Weckesser, Am. J. Phys. 65 (1997) 736, for the ball.
#' @seealso [rolling_table()], [scene_incline()] for rolling in a plane.
#' @concept coin
#' @concept non-holonomic
#' @concept turntable
#' @concept bicycle wheel
#' @examples
#' # A coin that leans and goes round; its energy:
#' coin <- roll_disk(
#'   body_disk(0.006, 0.012), seq(0, 2, by = 0.1), spin_rad_per_s = 40, lean_deg = 20
#' )
#' coin[, c("time_s", "x_m", "y_m", "lean_rad", "friction_needed")]
#' diff(range(coin$kinetic_energy_j + coin$potential_energy_j))
#' rolling_disk_speed(list(body_disk(0.006, 0.012), body_hoop(1, 0.3)))
#' # The ball goes round 2/7 as fast as the table, wherever it is put:
#' ball_on_turntable(
#'   body_sphere(0.033, 0.01), 0:4, turntable_rad_per_s = 3.5, x_m = 0.3, vy_m_per_s = 0.1
#' )
#' @name roll_disk
NULL

#' @rdname roll_disk
#' @export
roll_disk <- function(body, time_s, spin_rad_per_s = 0, ..., lean_deg = 0, yaw_rad_per_s = 0,
                      lean_rad_per_s = 0, accuracy = 1e-9, gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied(c("body", "time_s"), call)
  check_body(body, call)
  time_s <- check_times(time_s, call)
  disk <- disk_columns(body, call)
  numbers <- c(
    disk$mass_kg, disk$radius_m, disk$axial, disk$transverse,
    check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call, lower = 0),
    check_number(lean_deg, "lean_deg", "degree", call, lower = -89.9, upper = 89.9) * pi / 180,
    check_number(spin_rad_per_s, "spin_rad_per_s", "rad/s", call),
    check_number(yaw_rad_per_s, "yaw_rad_per_s", "rad/s", call),
    check_number(lean_rad_per_s, "lean_rad_per_s", "rad/s", call), check_accuracy(accuracy, call)
  )
  result <- .Call(ffi_rolling_disk, numbers, time_s, progress_bar("rolling"))
  info <- result$info
  if (info$kind != "none") failed_run(info, length(time_s), "abort", call)
  columns <- result$columns
  flat_s <- result$ledger[4]
  if (!is.nan(flat_s)) {
    late <- seq_along(time_s) > info$rows_done
    columns[-1] <- lapply(columns[-1], function(x) replace(x, late, NA_real_))
    warn_rotdyn("The disk lies flat at {format_si(flat_s)} s.", "truncated", call)
  }
  structure(
    new_table(columns, nrow = length(time_s), class = "rot_rolled_disk"),
    error = c(
      attitude_rad = result$ledger[1], omega = result$ledger[2], position_m = result$ledger[3]
    )
  )
}

# Of round bodies: moments over m r^2 about their axis and across it.
disk_columns <- function(body, call) {
  x <- columns_of_bodies(body, c("mass_kg", "radius_m", "beta"), "body", call)
  if (inherits(body, "rot_body")) body <- list(body)
  across <- vapply(body, function(one) {
    check_rolls(one, call)
    moment <- diag(one$inertia_kg_m2)
    if (abs(moment[1] - moment[2]) > 1e-9 * moment[1]) {
      abort_rotdyn("The moments of {.arg body} across its axis must be equal.", "value", call)
    }
    one$beta * (moment[[1]] / moment[[3]])
  }, double(1))
  bad <- which(!(x$mass_kg > 0 & across > 0))
  if (length(bad)) {
    abort_rotdyn(
      "The mass and the moments of inertia of {.arg body} must be greater than 0.", "value", call
    )
  }
  c(x[c("mass_kg", "radius_m")], list(axial = x$beta, transverse = across))
}

#' @rdname roll_disk
#' @export
rolling_disk_speed <- function(body, ..., gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  gravity <- check_column(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call)
  x <- c(disk_columns(body, call), list(gravity_m_per_s2 = gravity))
  n <- check_recyclable(x, call)
  bad <- which(gravity < 0 | is.infinite(gravity))
  if (length(bad)) {
    abort_domain(gravity[bad[1]], "gravity_m_per_s2", "m/s^2", call, 0, Inf, FALSE, row = bad[1])
  }
  minimum <- .Call(ffi_rolling_disk_min, x$radius_m, x$axial, x$transverse, x$gravity_m_per_s2)
  new_table(
    list(min_speed_m_per_s = minimum * x$radius_m, min_spin_rad_per_s = minimum), nrow = n
  )
}

#' @rdname roll_disk
#' @export
ball_on_turntable <- function(body, time_s, turntable_rad_per_s, x_m, y_m = 0, vx_m_per_s = 0,
                              vy_m_per_s = 0, ..., spin_rad_per_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("body", "time_s", "turntable_rad_per_s", "x_m"), call)
  ball <- columns_of_bodies(body, c("mass_kg", "radius_m", "beta"), "body", call)
  mass_kg <- ball$mass_kg
  radius_m <- ball$radius_m
  beta <- ball$beta
  units <- c(
    time_s = "s", turntable_rad_per_s = "rad/s", x_m = "m", y_m = "m", vx_m_per_s = "m/s",
    vy_m_per_s = "m/s", mass_kg = "kg", radius_m = "m", beta = "1", spin_rad_per_s = "rad/s"
  )
  x <- check_columns_of(mget(names(units)), units, call)
  n <- check_recyclable(x, call)
  for (name in names(x)) {
    open <- name %in% c("mass_kg", "radius_m")
    bad <- which(is.infinite(x[[name]]) | (open & x[[name]] <= 0) |
      (name == "beta" & x[[name]] < 0))
    if (length(bad)) {
      low <- if (open || name == "beta") 0 else -Inf
      abort_domain(x[[name]][bad[1]], name, units[[name]], call, low, Inf, open, row = bad[1])
    }
    x[[name]] <- rep_len(x[[name]], n)
  }
  table <- x$turntable_rad_per_s
  k <- x$beta / (1 + x$beta) * table
  whole <- k * x$time_s
  angle <- .Call(ffi_frame_angle, list(table, x$beta, x$time_s)) # less double turns
  # sin(kt)/k and (1 - cos(kt))/k, without cancellation and at k = 0.
  along <- x$time_s * ifelse(whole == 0, 1, sin(angle) / whole)
  aside <- x$time_s * ifelse(whole == 0, 0, 2 * sin(angle / 2)^2 / whole)
  vx <- x$vx_m_per_s * cos(angle) - x$vy_m_per_s * sin(angle)
  vy <- x$vy_m_per_s * cos(angle) + x$vx_m_per_s * sin(angle)
  dx <- along * x$vx_m_per_s - aside * x$vy_m_per_s
  dy <- along * x$vy_m_per_s + aside * x$vx_m_per_s
  at_x <- x$x_m + dx
  at_y <- x$y_m + dy
  inertia <- x$beta * x$mass_kg * x$radius_m^2
  energy <- function(px, py, vx, vy) {
    wx <- (table * px - vy) / x$radius_m
    wy <- (table * py + vx) / x$radius_m
    0.5 * x$mass_kg * (vx^2 + vy^2) + 0.5 * inertia * (wx^2 + wy^2 + x$spin_rad_per_s^2)
  }
  now <- energy(at_x, at_y, vx, vy)
  # r^2 - r0^2 as a product.
  work <- 0.5 * x$mass_kg * k * table * (dx * (at_x + x$x_m) + dy * (at_y + x$y_m))
  speed <- sqrt(x$vx_m_per_s^2 + x$vy_m_per_s^2)
  out <- list(
    time_s = x$time_s, x_m = at_x, y_m = at_y, vx_m_per_s = vx, vy_m_per_s = vy,
    omega_x_rad_per_s = (table * at_x - vy) / x$radius_m,
    omega_y_rad_per_s = (table * at_y + vx) / x$radius_m,
    omega_z_rad_per_s = x$spin_rad_per_s,
    circle_x_m = ifelse(k == 0, NaN, x$x_m - x$vy_m_per_s / k),
    circle_y_m = ifelse(k == 0, NaN, x$y_m + x$vx_m_per_s / k),
    circle_radius_m = ifelse(k == 0, Inf, speed / abs(k)),
    circle_period_s = 2 * pi / abs(k), kinetic_energy_j = now, work_j = work,
    energy_residual_j = now - energy(x$x_m, x$y_m, x$vx_m_per_s, x$vy_m_per_s) - work
  )
  # Without rotation the circle has no centre.
  numbers <- out[!startsWith(names(out), "circle_")]
  warn_beyond(lapply(numbers, nan_as_inf), x, n, call)
  new_table(out, nrow = n, class = "rot_turntable")
}
