#' Moment of inertia reflected through a gear
#'
#' The moment of inertia J of a body on a shaft with `omega_out = omega_in/ratio` is `J/ratio^2` at
#' the input.
#'
#' @param moment_of_inertia_kg_m2 Moment of inertia on the output shaft, at least 0.
#' @param ratio `omega_in/omega_out`, not 0; negative for gears that turn opposite ways. For a belt
#'   it is `radius_out/radius_in`.
#' @param ... Not used: an unknown argument is an error.
#' @return Numbers in kg m^2, one for each row (arguments have length 1 or n). NA gives NA,
#'   NaN gives NaN and Inf the limit of the formula.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a moment beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), section 16-7.
#' @seealso [gear_train()], [scene_gears()].
#' @concept gear
#' @examples
#' reflected_inertia(0.5, ratio = c(1, 5, 10))
#' @export
reflected_inertia <- function(moment_of_inertia_kg_m2, ratio, ...) {
  call <- check_no_dots(...)
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
  reflected <- rep_len(inertia, n) / ratio / ratio
  given <- list(inertia, ratio)
  warn_beyond(list(reflected_inertia_kg_m2 = reflected), given, n, call)
  reflected
}

#' A rigid gear train
#'
#' Shafts 1, 2, ..., n, each geared to the next with `ratio = omega_i/omega_(i+1)`. `gear_train()`
#' gives the contribution of each shaft at the first: with `N_i = omega_1/omega_i`, the product of
#' the ratios before it, inertia `J_i/N_i^2`, viscous coefficient `d_i/N_i^2`, torque `tau_i/N_i`:
#' \deqn{\sum_i \frac{J_i}{N_i^2}\, \dot\omega_1 =
#'   \sum_i \Bigl(\frac{\tau_i}{N_i} - \frac{d_i}{N_i^2}\, \omega_1\Bigr)}{
#'   sum(J_i/N_i^2) omega_1' = sum(tau_i/N_i - d_i/N_i^2 omega_1)}
#' `scene_gears()` makes a [scene_axle()] of the first shaft with their sums. Torque laws, friction,
#' elastic shafts, clutches, and the motion of each shaft: see [scene_drive()].
#'
#' **Efficiency.** Of the power that enters a mesh, the share `efficiency` leaves it, whichever of
#' its two shafts it comes from. It is all of the power through the mesh: what the inertia behind it
#' takes or gives counts, and so do viscous torques. With the torques `u_i` that shaft i gives and
#' `v_i` that shaft i + 1 takes, both at the first shaft, and \eqn{\eta}{eta} the efficiency:
#' \deqn{\frac{J_i}{N_i^2}\dot\omega_1 = \frac{\tau_i}{N_i} - \frac{d_i}{N_i^2}\omega_1
#'   + v_{i-1} - u_i,\quad v_i = \eta u_i \mbox{ where } u_i\omega_1 > 0,\quad
#'   u_i = \eta v_i \mbox{ where } u_i\omega_1 < 0}{
#'   J_i/N_i^2 omega_1' = tau_i/N_i - d_i/N_i^2 omega_1 + v_(i-1) - u_i,
#'   v_i = eta u_i where u_i omega_1 > 0,  u_i = eta v_i where u_i omega_1 < 0}
#' At constant torques the acceleration is piecewise linear in \eqn{\omega_1}{omega_1}, so that the
#' motion has a closed form. A loss resists either rotation: at rest it acts like dry friction that
#' differs between the two senses, and a train whose torques it exceeds stays at rest.
#' `reflected_torque_n_m` is for steady forward rotation, with the power flows of these torques;
#' inertia and viscous coefficients are reflected without loss.
#'
#' @param bodies A list of `rot_body` (their Izz counts), or moments of inertia in kg m^2, one for
#'   each shaft; greater than 0.
#' @param ratios One for each stage (`n - 1`), or one for all; not 0. For a single shaft:
#'   `numeric()`.
#' @param ... Not used; names after it must be given in full.
#' @param efficiency Of each stage, in (0, 1]: one number or `n - 1`.
#' @param torque Torque on each shaft: `n` numbers in N m, or 0; for `scene_gears()` also a list of
#'   `n` [torque] laws, with NULL for none.
#' @param resistance [resistance()] of each shaft, or its viscous coefficient: one for all, or `n`.
#'   `gear_train()` takes the viscous one alone.
#' @return `gear_train()`: a tibble (class `rot_gear_train`, which `ggplot2::autoplot()` draws) with
#'   one row for each shaft:
#'   `r describe_columns(gear_columns)`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf
#'   included), `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), sections 13-13 and 16-7.
#' @seealso [scene_drive()] for torque laws and elastic shafts, [reflected_inertia()],
#'   [autoplot.rot_gear_train()].
#' @concept gear
#' @concept transmission
#' @concept bicycle
#' @concept mechanical advantage
#' @examples
#' gear_train(c(0.01, 0.5), ratios = 5, efficiency = 0.9, torque = c(2, -4))
#' scene <- scene_gears(c(0.01, 0.5), ratios = 5, efficiency = 0.9, torque = c(2, -4))
#' trajectory(scene, time_s = 0:3)
#' @export
gear_train <- function(bodies, ratios, ..., efficiency = 1, torque = 0, resistance = 0) {
  call <- check_no_dots(...)
  check_supplied(c("bodies", "ratios"), call)
  train_of(bodies, ratios, efficiency, torque, resistance, call)
}

train_of <- function(bodies, ratios, efficiency, torque, resistance, call) {
  inertia <- check_inertias(bodies, "bodies", call)
  x <- check_train(
    length(inertia), ratios, efficiency, check_torque_each(torque, "torque", length(inertia), call),
    viscous_of_each(resistance, length(inertia), call), call
  )
  train <- .Call(
    ffi_train, inertia, x$ratios, x$efficiency, x$torque, x$resistance
  )
  columns <- c(list(shaft = seq_along(inertia)), train$columns)
  columns <- append(columns, list(moment_of_inertia_kg_m2 = inertia), 2L)
  warn_beyond(columns[-1], list(), length(inertia), call)
  new_table(
    columns, nrow = length(inertia), torque_n_m = x$torque, efficiency = x$efficiency,
    law = train$law, class = "rot_gear_train"
  )
}

# The arguments but for the bodies, a number for each of n shafts or for each mesh.
check_train <- function(n, ratios, efficiency, torque, resistance, call) {
  ratios <- check_between(ratios, "ratios", "1", n - 1L, -Inf, call)
  efficiency <- check_each(efficiency, "efficiency", "1", n - 1L, -Inf, call)
  if (any(ratios == 0)) abort_rotdyn("{.arg ratios} must not be 0.", "value", call)
  bad <- which(efficiency <= 0 | efficiency > 1)
  if (length(bad)) abort_domain(efficiency[bad[1]], "efficiency", "1", call, 0, 1, TRUE)
  list(
    ratios = ratios, efficiency = rep_len(efficiency, n - 1L), torque = torque,
    resistance = resistance
  )
}
