#' Engagement of a clutch
#'
#' Two bodies with different speeds, constant torques, and a clutch of constant capacity engaged at
#' time 0: time until it locks, common speed, and heat of slip. Without torques
#' \deqn{\omega = \frac{I_1 \omega_1 + I_2 \omega_2}{I_1 + I_2}, \qquad
#'   Q = \frac{1}{2} \frac{I_1 I_2}{I_1 + I_2} (\omega_1 - \omega_2)^2}{
#'   omega = (I1 omega1 + I2 omega2)/(I1 + I2),  Q = (1/2) I1 I2/(I1 + I2) (omega1 - omega2)^2}
#' for any clutch. An infinite capacity is the instantaneous engagement.
#'
#' @param body_1,body_2 Bodies (their Izz counts), lists of bodies, or moments of inertia in kg m^2,
#'   greater than 0.
#' @param capacity_n_m Torque of the slipping clutch, at least 0; Inf for instantaneous engagement.
#' @param omega_1_rad_per_s,omega_2_rad_per_s Speeds at the start.
#' @param ... Not used; names after it must be given in full.
#' @param torque_1_n_m,torque_2_n_m Constant torques on the bodies.
#' @return A tibble with one row for each engagement (arguments have length 1 or n):
#'   `r describe_columns(engagement_columns)`
#'   If the clutch never locks, as where `locked_torque_n_m` is beyond the capacity, time and heat
#'   are infinite and the common speed is NA. NA in a row
#'   gives NA.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @seealso [scene_clutch()] for the motion itself.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), section 16-6.
#' @concept clutch
#' @concept inelastic collision of disks
#' @examples
#' clutch_engagement(
#'   body_disk(4, 1), 3, capacity_n_m = c(6, 12, Inf), omega_1_rad_per_s = 10
#' )
#' @export
clutch_engagement <- function(body_1, body_2, capacity_n_m, omega_1_rad_per_s,
                              omega_2_rad_per_s = 0, ..., torque_1_n_m = 0, torque_2_n_m = 0) {
  call <- check_no_dots(...)
  check_supplied(c("body_1", "body_2", "capacity_n_m", "omega_1_rad_per_s"), call)
  columns <- check_columns_of(
    list(
      body_1 = body_1, body_2 = body_2, capacity_n_m = capacity_n_m, torque_1_n_m = torque_1_n_m,
      torque_2_n_m = torque_2_n_m, omega_1_rad_per_s = omega_1_rad_per_s,
      omega_2_rad_per_s = omega_2_rad_per_s
    ),
    c("kg*m^2", "kg*m^2", "N*m", "N*m", "N*m", "rad/s", "rad/s"), call
  )
  n <- check_recyclable(columns, call)
  for (name in names(columns)[1:2]) {
    bad <- which(columns[[name]] <= 0 | is.infinite(columns[[name]]))
    if (length(bad)) {
      abort_domain(columns[[name]][bad[1]], name, "kg*m^2", call, 0, Inf, TRUE, row = bad[1])
    }
  }
  check_not_negative(columns$capacity_n_m, "capacity_n_m", "N*m", call)
  values <- do.call(.Call, c(list(ffi_clutch_engagement), unname(columns)))
  # Without a common speed it never locks, and has no heat.
  locks <- list(locks = ifelse(is.na(values$common_omega_rad_per_s), Inf, 1))
  columns$capacity_n_m <- 1 # may be infinite
  warn_beyond(values, c(columns, locks), n, call)
  new_table(lapply(values, rep_len, n), nrow = n)
}
