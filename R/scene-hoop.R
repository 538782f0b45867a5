#' A bead on a hoop that turns
#'
#' A bead slides along a circular hoop of radius R, which turns at the constant rate
#' \eqn{\Omega}{W} about its vertical diameter. With the angle theta from the lowest point
#' \deqn{\ddot\theta = \left(\Omega^2\cos\theta - \frac gR\right)\sin\theta - \frac cm\dot\theta -
#'   \frac{\mu N}{mR}\,\mathrm{sign}\,\dot\theta}{
#'   theta'' = (W^2 cos(theta) - g/R) sin(theta) - c theta'/m - mu N/(m R) sign(theta')}
#' with the normal force of the wire, in the plane of the hoop and across it,
#' \deqn{N = m\sqrt{(g\cos\theta + R\dot\theta^2 + R\Omega^2\sin^2\theta)^2 +
#'   (2\Omega R\cos\theta\,\dot\theta)^2}.}{
#'   N = m sqrt((g cos(theta) + R theta'^2 + R W^2 sin(theta)^2)^2 + (2 W R cos(theta) theta')^2).}
#' The lowest point is stable up to \eqn{\Omega^2 = g/R}{W^2 = g/R}; above it the bead rests at
#' \eqn{\cos\theta = g/(R\Omega^2)}{cos(theta) = g/(R W^2)} on either side: a pitchfork bifurcation,
#' see [hoop_equilibria()]. With static friction mu the bead stays where the force along the hoop is
#' at most mu N (event `stick`).
#'
#' @param mass_kg Mass of the bead in kg, greater than 0.
#' @param radius_m Radius of the hoop in m, greater than 0.
#' @param hoop_omega_rad_per_s Angular velocity of the hoop about its vertical diameter, of either
#'   sign.
#' @param ... Not used; names after it must be given in full.
#' @param theta0_rad,omega0_rad_per_s Angle from the lowest point and its rate at `start_s`.
#' @param resistance NULL, or `resistance(drag_n_s_per_m = )`: viscous drag c along the hoop, the
#'   force `-c v` at `v = R theta'`.
#' @param static_friction,kinetic_friction Coefficients of dry friction between bead and hoop, at
#'   least 0; the kinetic one is at most the static one.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param start_s Time at which the state above holds; earlier times are reached backwards.
#' @return A `rot_scene_hoop`, which is a `rot_scene`. Its trajectory has the columns
#'   `r describe_columns(columns_of_motion("hoop"))`
#'   `theta_rad` counts from the lowest point. The error figure is an estimate. [audit()] balances
#'   the energy, with the work of the drive that keeps the hoop turning; the energy seen from the
#'   hoop, with the centrifugal potential; and the angular momentum about the vertical axis.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (also NA, NaN,
#'   Inf), `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), exercise 2.18; Strogatz,
#'   Nonlinear Dynamics and Chaos (1994), section 3.5, for the bifurcation.
#' @seealso [hoop_equilibria()], [scene_pendulum()], [animate_motion()].
#' @concept centrifugal
#' @concept bifurcation
#' @examples
#' # A hoop of 0.2 m that turns at 9 rad/s: the bead leaves the lowest point.
#' bead <- scene_hoop(
#'   0.05, 0.2, 9, theta0_rad = 0.01, resistance = resistance(drag_n_s_per_m = 0.05)
#' )
#' motion <- trajectory(bead, time_s = 0:8)
#' motion
#' hoop_equilibria(bead)
#' audit(motion)
#' @export
scene_hoop <- function(mass_kg, radius_m, hoop_omega_rad_per_s, ..., theta0_rad = 0,
                       omega0_rad_per_s = 0, resistance = NULL, static_friction = 0,
                       kinetic_friction = static_friction, gravity_m_per_s2 = 9.80665,
                       start_s = 0) {
  scene_of_inputs("hoop", check_no_dots(...))
}
