#' Moment of inertia reflected through a gear
#'
#' The moment of inertia J of a body on a shaft with `omega_out = omega_in/ratio` is `J/ratio^2` at
#' the input.
#'
#' @param moment_of_inertia_kg_m2 Moment of inertia on the output shaft, at least 0.
#' @param ratio `omega_in/omega_out`, not 0; negative for gears that turn opposite ways. For a belt
#'   it is `radius_out/radius_in`.
#' @return Numbers in kg m^2, one for each row (arguments have length 1 or n). NA gives NA.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), section 16-7.
#' @examples
#' reflected_inertia(0.5, ratio = c(1, 5, 10))
#' @export
reflected_inertia <- function(moment_of_inertia_kg_m2, ratio) {
  call <- rlang::current_env()
  check_supplied(c("moment_of_inertia_kg_m2", "ratio"), call)
  inertia <- check_column(moment_of_inertia_kg_m2, "moment_of_inertia_kg_m2", "kg*m^2", call)
  ratio <- check_column(ratio, "ratio", "1", call)
  n <- check_recyclable(list(moment_of_inertia_kg_m2 = inertia, ratio = ratio), call)
  check_not_negative(inertia, "moment_of_inertia_kg_m2", "kg*m^2", call)
  zero <- which(ratio == 0)
  if (length(zero)) {
    abort_rotdyn(c("{.arg ratio} must not be 0.", x = "It is in row {zero[1]}."), "value", call)
  }
  # Two divisions: the square of a ratio may overflow where the result does not.
  rep_len(inertia, n) / ratio / ratio
}

#' A rigid gear train
#'
#' Shafts 1, 2, ..., n, each geared to the next with `ratio = omega_i/omega_(i+1)`. `gear_train()`
#' gives the contribution of each shaft at the first: with `N_i = omega_1/omega_i`, the product of
#' the ratios before it, inertia `J_i/N_i^2`, viscous coefficient `d_i/N_i^2`, torque `tau_i/N_i`.
#' `scene_gears()` makes a [scene_axle()] of the first shaft with their sums.
#'
#' **Efficiency.** A stage transmits the share `efficiency` of its input power, in the direction of
#' the power flow. With the first shaft rotating in the positive sense, a driving torque
#' (`tau_i/N_i > 0`) acts on it as `eta tau_i/N_i`, a load as `tau_i/(N_i eta)`, with `eta` the
#' product of the efficiencies between. Inertia and viscous torques are reflected without losses.
#'
#' @param bodies A list of `rot_body` (their Izz counts), or moments of inertia in kg m^2, one for
#'   each shaft; greater than 0.
#' @param ratios One for each stage (`n - 1`), or one for all; not 0.
#' @param ... Not used; names after it must be given in full.
#' @param efficiency Of each stage, in (0, 1]: one number or `n - 1`.
#' @param torque_n_m,viscous_n_m_s Torque and viscous coefficient (at least 0) on each shaft: one
#'   number or `n`.
#' @return `gear_train()`: a tibble with one row for each shaft:
#'   `r describe_columns(gear_columns)`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf
#'   included), `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), sections 13-13 and 16-7.
#' @examples
#' gear_train(c(0.01, 0.5), ratios = 5, efficiency = 0.9, torque_n_m = c(2, -4))
#' scene <- scene_gears(c(0.01, 0.5), ratios = 5, efficiency = 0.9, torque_n_m = c(2, -4))
#' trajectory(scene, time_s = 0:3)
#' @export
gear_train <- function(bodies, ratios, ..., efficiency = 1, torque_n_m = 0, viscous_n_m_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("bodies", "ratios"), call)
  train_of(bodies, ratios, efficiency, torque_n_m, viscous_n_m_s, call)
}

train_of <- function(bodies, ratios, efficiency, torque_n_m, viscous_n_m_s, call) {
  inertia <- check_inertias(bodies, "bodies", call)
  n <- length(inertia)
  ratios <- check_each(ratios, "ratios", "1", n - 1L, -Inf, call)
  efficiency <- check_each(efficiency, "efficiency", "1", n - 1L, 0, call)
  torque <- check_each(torque_n_m, "torque_n_m", "N*m", n, -Inf, call)
  viscous <- check_each(viscous_n_m_s, "viscous_n_m_s", "N*m*s", n, 0, call)
  if (any(ratios == 0)) abort_rotdyn("{.arg ratios} must not be 0.", "value", call)
  bad <- which(efficiency <= 0 | efficiency > 1)
  if (length(bad)) abort_domain(efficiency[bad[1]], "efficiency", "1", call, 0, 1, TRUE)
  ratio <- cumprod(c(1, ratios))
  passed <- cumprod(c(1, efficiency))
  felt <- torque / ratio
  tibble::new_tibble(list(
    shaft = seq_len(n),
    ratio_to_first = ratio,
    moment_of_inertia_kg_m2 = inertia,
    reflected_inertia_kg_m2 = inertia / ratio / ratio,
    reflected_viscous_n_m_s = viscous / ratio / ratio,
    reflected_torque_n_m = ifelse(felt > 0, felt * passed, felt / passed)
  ), nrow = n)
}

#' @rdname gear_train
#' @inheritParams scene_axle
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity of the first shaft at `start_s`.
#' @return `scene_gears()`: a `rot_scene_axle` of the first shaft.
#' @export
scene_gears <- function(bodies, ratios, ..., efficiency = 1, torque_n_m = 0, viscous_n_m_s = 0,
                        theta0_rad = 0, omega0_rad_per_s = 0, start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("bodies", "ratios"), call)
  train <- train_of(bodies, ratios, efficiency, torque_n_m, viscous_n_m_s, call)
  scene_axle(
    sum(train$reflected_inertia_kg_m2),
    sum(train$reflected_torque_n_m),
    resistance(viscous_n_m_s = sum(train$reflected_viscous_n_m_s)),
    theta0_rad,
    omega0_rad_per_s,
    start_s = start_s
  )
}
