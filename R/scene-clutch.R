#' Two bodies and a clutch
#'
#' \deqn{I_1 \dot\omega_1 = \tau_1(t) - T, \qquad I_2 \dot\omega_2 = \tau_2(t) + T}{
#'   I1 omega1' = tau1(t) - T,  I2 omega2' = tau2(t) + T}
#' While the clutch slips, its torque on body 2 is `T = capacity sign(omega1 - omega2)`; when the
#' speeds meet it locks, if the torque that keeps them equal, `(I2 tau1 - I1 tau2)/(I1 + I2)`, is at
#' most the static capacity, and stays locked as long as it is. Before `engage_s` its torque is 0.
#'
#' [trajectory()] gives the closed form, with the exact times of locking and slipping (events
#' `lock`, `slip`, and `reverse` where the slip passes through zero).
#'
#' @param body_1,body_2 A `rot_body` (its Izz counts), or the moment of inertia in kg m^2.
#' @param capacity_n_m Torque of the slipping clutch, at least 0.
#' @param ... Not used; names after it must be given in full.
#' @param static_capacity_n_m Largest torque that the locked clutch holds, at least `capacity_n_m`.
#' @param torque_1,torque_2 Torque on each body: one number in N m, or a [torque] law that is
#'   constant between jumps; NULL for none.
#' @param omega1_rad_per_s,omega2_rad_per_s,theta1_rad,theta2_rad State at `start_s`.
#' @param engage_s Time from which the clutch is pressed; -Inf, or any time up to `start_s`, for
#'   always.
#' @param start_s Time at which the state above holds. Earlier times are an error: the slip before
#'   locking is undetermined.
#' @return A `rot_scene_clutch`, which is a `rot_scene`. Its trajectory has the
#'   columns `r describe_columns(columns_of_motion("clutch"))`
#'   The error is a bound.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`; `rotdyn_error_torque` for a torque that is not constant between jumps.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), chapter 16 (energy of clutches).
#' @seealso [clutch_engagement()] for numbers, [scene_drive()] for any torque law,
#'   [trajectory()].
#' @concept brake
#' @concept clutch
#' @examples
#' scene_clutch(2, 3, capacity_n_m = 12, omega1_rad_per_s = 10)
#' scene_clutch(
#'   body_disk(20, 0.15), body_disk(40, 0.2), capacity_n_m = 60, static_capacity_n_m = 75,
#'   torque_1 = torque_knots(c(0, 2, 2, 5), c(30, 30, -10, -10)), torque_2 = -5,
#'   omega1_rad_per_s = 150, engage_s = 0.5
#' )
#' @export
scene_clutch <- function(body_1, body_2, capacity_n_m, ..., static_capacity_n_m = capacity_n_m,
                         torque_1 = NULL, torque_2 = NULL, omega1_rad_per_s = 0,
                         omega2_rad_per_s = 0, theta1_rad = 0, theta2_rad = 0, engage_s = -Inf,
                         start_s = 0) {
  check_no_dots(...)
  scene_of_inputs("clutch", rlang::current_env())
}

#' @export
print.rot_scene_clutch <- function(x, ...) {
  check_scene(x, rlang::current_env())
  engaged <- if (x$engage_s <= x$start_s) "engaged" else paste("engages at", x$engage_s, "s")
  cat(
    "<rot_scene> two bodies and a clutch\n",
    "  inertia   ", paste(format_si(x$moment_of_inertia_kg_m2), collapse = ", "), " kg m^2\n",
    "  clutch    ", format_si(x$capacity_n_m), " N m slipping, ",
    format_si(x$static_capacity_n_m), " N m locked, ", engaged, "\n",
    "  torque 1  ", describe_torque(x$torque_1 %||% torque_constant(0)), "\n",
    "  torque 2  ", describe_torque(x$torque_2 %||% torque_constant(0)), "\n",
    "  start     theta ", format_si(x$theta1_rad), ", ", format_si(x$theta2_rad), " rad, omega ",
    format_si(x$omega1_rad_per_s), ", ", format_si(x$omega2_rad_per_s), " rad/s at ",
    format_si(x$start_s), " s\n",
    sep = ""
  )
  invisible(x)
}
