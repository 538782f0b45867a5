#' Stopping time and terminal speed
#'
#' In closed form, where the torque is constant between its steps and the resistance is any of
#' viscous, quadratic and dry friction:
#' \deqn{I \dot\omega = \tau - c\,\omega - q\,\omega|\omega| - \tau_c\,\mathrm{sign}\,\omega}{
#'   I omega' = torque - c omega - q omega |omega| - tau_c sign(omega)}
#' With viscous resistance alone a body never stops: its stopping time is Inf, the
#' angle finite. With dry friction it stops, and stays at rest while the torque is at most the
#' static friction.
#'
#' @param scene A [scene_axle()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble of one row with the columns
#'   `r describe_columns(c("stop_time_s", "stop_theta_rad", "terminal_omega_rad_per_s"))`
#'   Where the body never comes to rest for good, `stop_time_s` is Inf and `stop_theta_rad` the
#'   angle that it tends to: \eqn{\theta_0 + I \omega_0 / c}{theta0 + I omega0/c} with viscous
#'   resistance, \eqn{\theta_0 + (I/q) \ln(1 + q \omega_0 / c)}{theta0 + I/q log(1 + q omega0/c)}
#'   with quadratic drag, too; infinite with quadratic drag alone; NaN where a speed is left. The
#'   terminal speed is 0 where friction holds the last torque, and infinite where nothing resists
#'   it; where in the end nothing acts at all, it is the speed left.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_model` where the closed form does not fit
#'   (see [choose_model()], model `axle_drag`).
#' @source Riccati's equation; Armstrong-Helouvry, Control of Machines with Friction (1991), chapter
#'   2.
#' @seealso [time_when()], [motion_events()], [resistance()].
#' @concept brake
#' @concept coast-down
#' @concept terminal speed
#' @concept friction
#' @concept braking
#' @examples
#' # A flywheel that coasts down: J = 2.5 kg m^2, dry, viscous and quadratic losses.
#' losses <- resistance(0.004, 2e-5, coulomb_n_m = 0.05)
#' stopping(scene_axle(2.5, resistance = losses, omega0_rad_per_s = 150))
#' # Viscous losses alone: no time, but an angle, I omega/c = 2.5 * 150/0.004 rad.
#' stopping(scene_axle(2.5, resistance = resistance(0.004), omega0_rad_per_s = 150))
#' # A fan: terminal speed where the drag balances the torque, sqrt(0.8/2e-3) = 20 rad/s.
#' stopping(scene_axle(0.1, 0.8, resistance(quadratic_n_m_s2 = 2e-3)))
#' @export
stopping <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene_of(scene, "axle", call)
  fit <- core_pick("axle", scene, scene$start_s, 1, model = "axle_drag")
  # At the start alone, all may be left out.
  left_out <- fit$dropped[[1]]$effects
  why_not <- fit$reason %||% if (length(left_out)) {
    paste("it leaves out", effects_in_words(left_out, constraint_of(scene)))
  }
  if (!is.null(why_not)) {
    abort_rotdyn(c(
      "There is no closed form of when this scene stops: {why_not}.",
      i = "{.fn trajectory} and {.fn motion_events} show it."
    ), "model", call)
  }
  x <- .Call(ffi_axle_stopping, scene)
  as_table(
    stop_time_s = x[1], stop_theta_rad = x[2],
    terminal_omega_rad_per_s = if (is.finite(x[1])) 0 else terminal_omega(scene, x[3], call)
  )
}

# Under the torque that acts for good, of a body that does not stay at rest; `omega`: where it
# resists.
terminal_omega <- function(scene, omega, call) {
  knots <- torque_loads(axle_torque(scene))$knots
  resists <- c("viscous", "motor", "quadratic", "friction") %in% core_effects("axle", scene)
  if (knots$outside[2] != 0 || any(resists)) return(omega)
  end <- max(scene$start_s, knots$time_s)
  drag <- constraint_of(scene)$models$axle_drag
  drag$run(scene, end, 1e-9, 1e6, call, TRUE)$columns$omega_rad_per_s
}
