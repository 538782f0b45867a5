#' A mass that hangs from a pulley
#'
#' A rope without mass runs over a pulley, or is wound on a drum, and does not slip. A mass hangs
#' from it, on the other side another one (Atwood's machine) or none. Shortcut for a [scene_axle()]
#' with the torque of the weights and the masses at the radius of the rope:
#' \deqn{(I + (m_1 + m_2) r^2)\, \dot\omega = (m_1 - m_2)\, g\, r + \tau_r}{
#'   (I + (m1 + m2) r^2) omega' = (m1 - m2) g r + resistance}
#'
#' theta and omega are positive where the first mass goes down: by `radius_m` theta. The moment of
#' inertia of the scene is that of all, and so are its energy and angular momentum. The rope stays
#' taut while the mass accelerates downward with less than g; where the resistance slows down a
#' pulley that winds the mass up, look at `gravity_m_per_s2 - radius_m * alpha`.
#'
#' @inheritParams scene_axle
#' @param body A `rot_body`, or one number: the moment of inertia of the pulley in kg m^2, >= 0.
#' @param mass_kg The mass that hangs, > 0.
#' @param radius_m Radius at which the rope leaves the pulley, > 0.
#' @param counter_mass_kg The mass on the other side, >= 0.
#' @param gravity_m_per_s2 Acceleration of gravity.
#' @return A `rot_scene_axle`.
#' @section Errors: those of [scene_axle()].
#' @source Kleppner and Kolenkow, An Introduction to Mechanics, 2nd ed. (2014), chapter 7: Atwood's
#'   machine with a massive pulley.
#' @seealso [when()] for the time at which it has gone down so far.
#' @concept pulley
#' @concept Atwood machine
#' @examples
#' # 0.5 kg on a disk of 2 kg and 0.1 m: a = g/(1 + M/(2 m)) = g/3.
#' well <- scene_hanging_mass(body_disk(2, 0.1), mass_kg = 0.5, radius_m = 0.1)
#' trajectory(well, 0:2)
#' # After 3 m:
#' when(well, theta_rad = 3 / 0.1)
#' # Atwood's machine with a pulley without inertia.
#' scene_hanging_mass(0, mass_kg = 1.1, radius_m = 0.05, counter_mass_kg = 1)
#' @export
scene_hanging_mass <- function(body, mass_kg, radius_m, resistance = NULL, theta0_rad = 0,
                               omega0_rad_per_s = 0, ..., counter_mass_kg = 0, start_s = 0,
                               axis = c(0, 0, 1), gravity_m_per_s2 = 9.80665) {
  call <- rlang::current_env()
  check_supplied(c("body", "mass_kg", "radius_m"), call)
  check_no_dots(...)
  mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0, open = TRUE)
  counter_mass_kg <- check_number(counter_mass_kg, "counter_mass_kg", "kg", call, lower = 0)
  radius_m <- check_number(radius_m, "radius_m", "m", call, lower = 0, open = TRUE)
  gravity_m_per_s2 <- check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call)
  axis <- unit_axis(as_axis(axis, call), call)
  if (inherits(body, "rot_body")) {
    own <- moment_about_axis(check_body(body, call), axis)
  } else {
    if (!is.numeric(body)) {
      check_class(
        body, "rot_body", "body",
        "Make one with {.fn body_disk}, or give the moment of inertia in kg m^2.", call
      )
    }
    own <- check_number(body, "body", "kg*m^2", call, lower = 0)
    body <- NULL
  }
  product <- function(first, ...) .Call(ffi_sum_product, first, c(...))
  with_first <- product(own, mass_kg, radius_m, radius_m)[1]
  inertia <- product(with_first, counter_mass_kg, radius_m, radius_m)
  check_turns(inertia[1], call, computed = TRUE)
  weight <- product(0, mass_kg - counter_mass_kg, gravity_m_per_s2, radius_m)[1]
  if (!is.finite(weight)) {
    abort_rotdyn("The torque of the weight exceeds double precision.", "value", call)
  }
  scene <- new_scene_axle(
    body, inertia[1], NULL, axis, torque_constant(weight), as_resistance(resistance, call),
    check_number(theta0_rad, "theta0_rad", "rad", call),
    check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
    check_number(start_s, "start_s", "s", call)
  )
  # For the drawing.
  scene$rope <- list(mass_kg = c(mass_kg, counter_mass_kg), radius_m = radius_m)
  scene$given <- list(body = own, gravity_m_per_s2 = gravity_m_per_s2) # for the text
  scene
}
