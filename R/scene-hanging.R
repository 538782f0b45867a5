#' A mass that hangs from a pulley
#'
#' A rope without mass runs over a pulley, or is wound on a drum, and does not slip. A mass hangs
#' from it, on the other side another one (Atwood's machine) or none. Shortcut for a [scene_axle()]
#' with the torque of the weights and the masses at the radius of the rope:
#' \deqn{(I + (m_1 + m_2) r^2)\, \dot\omega = (m_1 - m_2)\, g\, r + \tau_r}{
#'   (I + (m1 + m2) r^2) omega' = (m1 - m2) g r + resistance}
#'
#' theta and omega are positive where the first mass goes down: by `radius_m` theta. The tensions
#' are not the weights: with `a = radius_m alpha`,
#' \deqn{T_1 = m_1 (g - a),\quad T_2 = m_2 (g + a),\quad I\, \dot\omega = (T_1 - T_2)\, r + \tau_r}{
#'   T1 = m1 (g - a),  T2 = m2 (g + a),  I omega' = (T1 - T2) r + resistance}
#' and the applied torque of the motion is that of the rope on the pulley, `(T1 - T2) r`. Where a
#' tension is negative the rope would be slack, and the motion another one: where a resistance slows
#' down a pulley that winds a mass up. [trajectory()] and [time_when()] then warn, and the head of
#' the motion says from which time on.
#'
#' @section Columns: The motion has those of [trajectory()], with torques and kinetic energy of the
#'   pulley alone, and the angular momentum of all about the axle; and, for one mass,
#'   `r describe_columns(hanging_names_of(1))`
#'   With two masses `r describe_columns(setdiff(hanging_names_of(2), hanging_names_of(1)))`
#'   [audit()] and [conserved()] are about the pulley and the masses together.
#' @inheritParams scene_axle
#' @param body A `rot_body`, or one number: the moment of inertia of the pulley in kg m^2, >= 0.
#' @param mass_kg The mass that hangs, > 0.
#' @param radius_m Radius at which the rope leaves the pulley, > 0; NULL for that of a round body,
#'   such as [body_disk()].
#' @param counter_mass_kg The mass on the other side, >= 0.
#' @param gravity_m_per_s2 Acceleration of gravity.
#' @return A `rot_scene_hanging_mass`, which is a `rot_scene_axle`; its moment of inertia is that of
#'   all about the axle.
#' @section Errors: those of [scene_axle()]; `rotdyn_error_missing` without `radius_m` for a body
#'   that has no radius of its own about `axis`.
#' @section Warnings: `rotdyn_warning_slack`, by [trajectory()] and [time_when()], if a rope would
#'   be slack.
#' @source Kleppner and Kolenkow, An Introduction to Mechanics, 2nd ed. (2014), chapter 7: Atwood's
#'   machine with a massive pulley.
#' @seealso [time_when()] for the time at which it has gone down so far.
#' @concept pulley
#' @concept Atwood machine
#' @concept well
#' @concept bucket
#' @concept unwinding rope
#' @examples
#' # 0.5 kg on a disk of 2 kg and 0.1 m: a = g/(1 + M/(2 m)) = g/3.
#' well <- scene_hanging_mass(body_disk(2, 0.1), mass_kg = 0.5)
#' trajectory(well, 0:2)[c("time_s", "height_m", "tension_n", "applied_torque_n_m")]
#' # After 3 m:
#' time_when(well, theta_rad = 3 / 0.1)
#' # Atwood's machine with a pulley without inertia.
#' scene_hanging_mass(0, mass_kg = 1.1, radius_m = 0.05, counter_mass_kg = 1)
#' @export
scene_hanging_mass <- function(body, mass_kg, radius_m = NULL, resistance = NULL, theta0_rad = 0,
                               omega0_rad_per_s = 0, ..., counter_mass_kg = 0, start_s = 0,
                               axis = c(0, 0, 1), gravity_m_per_s2 = 9.80665) {
  call <- environment()
  check_no_dots(...)
  if (!missing(body) && is.null(radius_m)) radius_m <- pulley_radius(body, axis, call)
  scene_of_inputs("axle", call, "scene_hanging_mass")
}

# Of a body that is round about that axis.
pulley_radius <- function(body, axis, call) {
  axis <- unit_axis(as_axis(axis, call), call)
  whole <- inherits(body, "rot_body")
  parts <- if (whole) round_parts(check_body(body, call))
  about <- Filter(function(part) part$all || sqrt(sum((part$axis - axis)^2)) <= 1e-9 ||
                    sqrt(sum((part$axis + axis)^2)) <= 1e-9, parts)
  if (length(parts) != 1L || !length(about) || !is.finite(body$beta)) {
    abort_rotdyn(c(
      "{.arg radius_m} is missing: it is the body's only where that is round about {.arg axis}.",
      x = if (whole) "It is a {.val {body$shape}}." else "The body is a number."
    ), "missing", call)
  }
  rolling_radius(body, moment_about_axis(body, c(0, 0, 1)), call)
}

masses_of <- function(scene) c(scene$mass_kg, scene$counter_mass_kg)

hanging_title <- function(scene) {
  paste(if (scene$counter_mass_kg > 0) "two masses" else "a mass", "hanging from a pulley")
}

#' @export
print.rot_scene_hanging_mass <- function(x, ...) {
  check_scene(x, current_env())
  whole <- inherits(x$body, "rot_body")
  own <- if (whole) moment_about_axis(x$body, x$axis) else x$body
  masses <- masses_of(x)
  print_axle(
    x, scene_title(x), paste(describe_moment(x), "the axle, masses included"),
    paste0(describe_torque(axle_torque(x)), ", of the weights"),
    more = paste0(
      "  pulley      ", if (whole) x$body$shape else "a body", ", ", format_si(own),
      " kg m^2, rope at ", format_si(x$radius_m), " m\n",
      "  masses      ", paste(format_si(masses[masses > 0]), collapse = " and "),
      " kg, gravity ", format_si(x$gravity_m_per_s2), " m/s^2\n",
      if (!resists(axle_resistance(x)) && torque_is_zero(given_torque(x))) {
        driven <- (masses[1] - masses[2]) * x$gravity_m_per_s2 * x$radius_m^2
        paste0(
          "  falls       with ", format_si(driven / x$moment_of_inertia_kg_m2), " m/s^2",
          if (masses[2] > 0) ", the first mass down", "\n"
        )
      }
    )
  )
}

# ---- tensions and energies ----------------------------------------------------------------------

# The columns that the masses add.
hanging_names_of <- function(masses) {
  index <- if (masses == 1L) "" else c("_1", "_2")
  c("alpha_rad_per_s2", unlist(lapply(index, function(i) {
    c(
      paste0("tension", i, "_n"), paste0("height", i, "_m"),
      paste0("mass", i, "_kinetic_energy_j"), paste0("mass", i, "_potential_energy_j")
    )
  })))
}
