#' A chain of pendulums
#'
#' Rods or pendulums that hang one below the other from a fixed pivot and swing in a vertical plane;
#' two of them are the double pendulum. With the angle of each link from the downward vertical,
#' \deqn{\sum_j A_{ij} \left(\cos(\theta_i - \theta_j)\,\ddot\theta_j +
#'   \sin(\theta_i - \theta_j)\,\dot\theta_j^2\right) + g B_i \sin\theta_i = \tau_i,}{
#'   sum over j of A_ij (cos(theta_i - theta_j) theta_j'' + sin(theta_i - theta_j) theta_j'^2) +
#'   g B_i sin(theta_i) = tau_i,}
#' where A and B follow from lengths and masses, and \eqn{\tau_i}{tau_i} is the viscous torque of
#' the joints above and below link i, `-c (theta_i' - theta_(i-1)')` in each.
#'
#' Small swings are a sum of normal modes (`chain_modes`), exact but for what the linear equations
#' leave out, which has a bound. Beyond them the motion is integrated. A double pendulum that turns
#' over is chaotic: errors grow exponentially, the error figure with them, and the head of the
#' trajectory says from when on it tells nothing.
#'
#' @param length_m Length of each link in m, from the pivot down: 1 to 16 numbers greater than 0.
#' @param mass_kg Mass of each link in kg, greater than 0; one number for all.
#' @param theta0_rad Angle of each link from the downward vertical at `start_s`, not from the link
#'   above; one number for all.
#' @param ... Not used; names after it must be given in full.
#' @param links `"rods"`: uniform rods. `"points"`: massless rods with a point mass at the lower
#'   end.
#' @param omega0_rad_per_s Rate of each link at `start_s`; one number for all.
#' @param resistance Viscous torque in the joint above each link over the relative rate there: a
#'   `resistance(viscous_n_m_s = )` or a number in N m s, at least 0, for all, or one for each.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param start_s Time at which the state above holds; earlier times are reached backwards.
#' @return A `rot_scene_chain`, which is a `rot_scene`. Its trajectory has a row for each time and
#'   link, with the columns
#'   `r describe_columns(columns_of_motion("chain"), chain_meanings)`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (also NA, NaN,
#'   Inf, and a wrong number of masses, angles, rates or joints), `rotdyn_error_unit`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 1.4 and 6.2;
#'   Shinbrot, Grebogi, Wisdom and Yorke, Am. J. Phys. 60 (1992) 491, for the chaos.
#' @seealso [chain_modes()], [scene_pendulum()], [animate_motion()].
#' @concept double pendulum
#' @concept chaos
#' @examples
#' double <- scene_chain(c(0.3, 0.3), 0.1, c(2, 2.5), links = "points")
#' motion <- trajectory(double, time_s = 0:3)
#' motion
#' audit(motion)
#' # Small swings are exact:
#' choose_model(scene_chain(c(0.3, 0.3), 0.1, 1e-4), time_s = 0:3, accuracy = 1e-6)
#' @export
scene_chain <- function(length_m, mass_kg, theta0_rad, ..., links = c("rods", "points"),
                        omega0_rad_per_s = 0, resistance = 0, gravity_m_per_s2 = 9.80665,
                        start_s = 0) {
  scene_of_inputs("chain", check_no_dots(...))
}

#' Modes of a chain of pendulums
#'
#' The normal modes of small swings of a [scene_chain()], without damping: in each all links swing
#' at one rate, with angles in fixed proportions.
#'
#' @param scene A [scene_chain()]; its start and its joints do not count.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with a row for each mode, slowest first, and link:
#'   `r describe_columns(chain_mode_columns, chain_meanings)`
#'   Without gravity the rates are 0 and the periods Inf.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_missing`, `rotdyn_error_argument`;
#'   `rotdyn_error_range` where rates are beyond double precision.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 6.2.
#' @seealso [scene_chain()], [shaft_modes()].
#' @concept vibration
#' @examples
#' # Two equal pendulums: the rates are sqrt((2 -+ sqrt(2)) g/l).
#' chain_modes(scene_chain(c(1, 1), 1, 0, links = "points"))
#' @export
chain_modes <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene_of(scene, "chain", call)
  n <- length(scene$length_m)
  modes <- .Call(
    ffi_chain_modes, scene$length_m, rep_len(scene$mass_kg, n), as.double(scene$links == "rods"),
    scene$gravity_m_per_s2
  )
  if (is.null(modes)) {
    abort_rotdyn("The rates of the modes exceed double precision.", "range", call)
  }
  new_table(list(
    mode = rep(seq_len(n), each = n), natural_rad_per_s = rep(modes[[1]], each = n),
    period_s = rep(2 * pi / modes[[1]], each = n), link = rep(seq_len(n), n),
    relative_theta = as.vector(modes[[2]])
  ), nrow = n * n)
}
