#' Couplings and brakes of a drive
#'
#' How a rotor of a [scene_drive()] turns the next one, or is held. `ratio` is
#' `omega_i/omega_(i+1)`, negative for gears that turn opposite ways.
#'
#' * `coupling_shaft()`: a spring and a damper, behind a gear where `ratio` is not 1:
#'   `T = k (theta_i - ratio theta_(i+1)) + c (omega_i - ratio omega_(i+1))`.
#' * `coupling_clutch()`: dry friction. While it slips, `T = capacity sign(slip)` with
#'   `slip = omega_i - ratio omega_(i+1)`; at no slip it locks while the torque that keeps it so is
#'   at most `static_ratio capacity`.
#' * `coupling_gear()`: rigid, without backlash: `omega_i = ratio omega_(i+1)`. Of the power that
#'   enters it the share `efficiency` leaves it, whichever of its two shafts it comes from, as in
#'   [scene_gears()]: rotor `i + 1` takes `ratio T efficiency` where `T omega_i > 0`,
#'   `ratio T/efficiency` where `T omega_i < 0`. It is all of the power through the gear, the
#'   inertia behind it included. A loss resists either rotation: at rest it holds like dry friction
#'   in proportion to the torque that passes, so that a load may fail to drive its motor.
#' * `brake()`: a clutch to ground.
#'
#' `T` acts on rotor `i + 1` times `ratio`, on rotor `i` as `-T`; the housing takes the rest. A
#' drive of gears with a loss has no clutches: the torque of a locked clutch between two such gears
#' may have several values.
#'
#' With static above sliding friction, loads that begin at once may allow several answers: which of
#' two clutches slips, and which holds. The one that is loaded most, of what it holds, gives way
#' first, as if the loads grew.
#'
#' @param stiffness_n_m_per_rad,damping_n_m_s Stiffness and damping of the shaft at rotor `i`, at
#'   least 0.
#' @param ratio One number, not 0.
#' @param efficiency Power out of the gear over power into it, in (0, 1].
#' @param capacity_n_m Torque of the slipping clutch or brake: one number in N m, at least 0, or a
#'   torque law of the normal force in time; `torque_curve()` and functions of three arguments are
#'   called with the slip speed (0 where it sticks) as omega, with the angle of rotor `i` as theta.
#'   Below 0 it counts as 0.
#' @param static_ratio Largest torque at no slip over `capacity_n_m` at no slip, at least 1.
#' @param from_s,to_s It acts from `from_s` on and before `to_s`.
#' @param ... Not used; names after it must be given in full.
#' @return A `rot_coupling`, or a `rot_brake`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), chapter 16; Armstrong-Helouvry,
#'   Control of Machines with Friction (1991), chapter 2.
#' @seealso [scene_drive()], [scene_rotors()], [scene_clutch()], [gear_train()].
#' @concept brake
#' @concept clutch
#' @concept gear
#' @concept belt
#' @concept shaft
#' @examples
#' coupling_shaft(800, 0.05, ratio = 5)
#' coupling_clutch(torque_knots(c(0, 1), c(0, 30), outside = "hold"), static_ratio = 1.2)
#' coupling_gear(-3, efficiency = 0.97)
#' brake(12, from_s = 2, to_s = 3.5)
#' @name couplings
NULL

#' @rdname couplings
#' @export
coupling_shaft <- function(stiffness_n_m_per_rad, damping_n_m_s = 0, ratio = 1, ...) {
  call <- check_no_dots(...)
  check_supplied("stiffness_n_m_per_rad", call)
  new_coupling("shaft", list(
    stiffness_n_m_per_rad =
      check_number(stiffness_n_m_per_rad, "stiffness_n_m_per_rad", "N*m/rad", call, lower = 0),
    damping_n_m_s = check_number(damping_n_m_s, "damping_n_m_s", "N*m*s", call, lower = 0),
    ratio = check_ratio(ratio, call)
  ))
}

#' @rdname couplings
#' @export
coupling_clutch <- function(capacity_n_m, ..., static_ratio = 1, ratio = 1, from_s = -Inf,
                            to_s = Inf) {
  call <- current_env()
  check_supplied("capacity_n_m", call)
  check_no_dots(...)
  friction <- new_friction(capacity_n_m, static_ratio, from_s, to_s, call)
  new_coupling("clutch", c(friction, list(ratio = check_ratio(ratio, call))))
}

#' @rdname couplings
#' @export
coupling_gear <- function(ratio, ..., efficiency = 1) {
  call <- check_no_dots(...)
  check_supplied("ratio", call)
  ratio <- check_ratio(ratio, call)
  efficiency <- check_number(efficiency, "efficiency", "1", call)
  if (efficiency <= 0 || efficiency > 1) {
    abort_domain(efficiency, "efficiency", "1", call, 0, 1, TRUE)
  }
  new_coupling("gear", list(ratio = ratio, efficiency = efficiency))
}

#' @rdname couplings
#' @export
brake <- function(capacity_n_m, ..., static_ratio = 1, from_s = -Inf, to_s = Inf) {
  call <- current_env()
  check_supplied("capacity_n_m", call)
  check_no_dots(...)
  friction <- new_friction(capacity_n_m, static_ratio, from_s, to_s, call)
  class(friction) <- "rot_brake"
  friction
}

check_ratio <- function(ratio, call) {
  ratio <- check_number(ratio, "ratio", "1", call)
  if (ratio == 0) abort_rotdyn("{.arg ratio} must not be 0.", "value", call)
  ratio
}

# A coupling is the list of its inputs; its class has the name of its constructor.
new_coupling <- function(kind, inputs) {
  class(inputs) <- c(paste0("rot_coupling_", kind), "rot_coupling")
  inputs
}

is_coupling <- function(x, kind) inherits(x, paste0("rot_coupling_", kind))

loses_power <- function(coupling) is_coupling(coupling, "gear") && coupling$efficiency < 1

new_friction <- function(capacity, static_ratio, from_s, to_s, call) {
  if (is.numeric(capacity)) {
    capacity <- check_number(capacity, "capacity_n_m", "N*m", call, lower = 0)
  }
  law <- as_torque(capacity, call, "capacity_n_m")
  if (inherits(law, "rot_torque_knots") && any(c(law$torque_n_m, law$outside) < 0)) {
    abort_rotdyn(c(
      "{.arg capacity_n_m} must be at least 0 N m at all knots.",
      x = "It falls to {format(min(law$torque_n_m, law$outside))} N m."
    ), "value", call)
  }
  window <- check_window(from_s, to_s, call)
  list(
    capacity_n_m = law,
    static_ratio = check_number(static_ratio, "static_ratio", "1", call, lower = 1),
    from_s = window[1], to_s = window[2]
  )
}

#' A drive: rotors, gears, elastic shafts, clutches and brakes
#'
#' Rotors in a chain, neighbours coupled by an elastic shaft, a friction clutch or a rigid gear (see
#' [couplings]), each under torque laws, resistance and a brake of its own:
#' \deqn{J_i \dot\omega_i = \tau_i + \tau_{r,i} + N_{i-1} T_{i-1} - T_i}{
#'   J_i omega_i' = tau_i + resistance_i + ratio_(i-1) T_(i-1) - T_i}
#' with the ratio `N_i` and the torque `T_i` of the coupling behind rotor `i`.
#'
#' Clutches, brakes and dry friction stick and slip with exact events: [motion_events()] says when
#' and where. There are closed forms for constant torques on shafts and gears, for torques of time
#' on gears alone (both with viscous resistance), and for stepped torques and one constant clutch.
#' The rest is integrated.
#'
#' @param bodies A list of `rot_body` (their Izz counts), or moments of inertia in kg m^2; each
#'   greater than 0.
#' @param couplings A list of `n - 1` [couplings], in the order of the rotors, or one for all.
#' @param ... Not used; names after it must be given in full.
#' @param torque,resistance,brake What acts on each rotor: a list of `n`, with NULL for none, or `n`
#'   numbers. A
#'   torque is a law (see [torque] and [torque-terms]), a function, or a number in N m; then a
#'   [resistance()], a [brake()]. NULL for none at all; a single rotor needs no list.
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity at `start_s`: `n` numbers, or that
#'   of the first rotor, with which the others turn at the ratios. Gears are rigid: rates that
#'   contradict their ratio are an error.
#' @param start_s Time at which the state above holds. Times before it are reached backwards where
#'   nothing sticks or slips.
#' @return A `rot_scene_drive`, which is a `rot_scene`. Its trajectory has one row for each time and
#'   rotor:
#'   `r describe_columns(columns_of_motion("drive"))`
#'   The error is an estimate, relative to the largest angle and the largest rate of all rotors.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 1.4 and 2.4
#'   (constraints); Armstrong-Helouvry, Control of Machines with Friction (1991), chapter 2; Ahuja,
#'   Magnanti and Orlin, Network Flows (1993), section 6.5 (which contacts at rest hold).
#' @seealso [couplings], [scene_rotors()], [scene_gears()], [scene_clutch()], [motion_events()].
#' @concept drive train
#' @concept brake
#' @concept gear
#' @concept bicycle
#' @concept motor
#' @concept transmission
#' @concept clutch
#' @examples
#' # A motor that drives a load through a gear and an elastic shaft.
#' geared <- scene_drive(
#'   c(0.002, 0.5), coupling_shaft(4000, 0.4, ratio = 10),
#'   torque = list(torque_sinusoid(2, 5), NULL),
#'   resistance = list(NULL, resistance(0.05, coulomb_n_m = 4))
#' )
#' trajectory(geared, time_s = seq(0, 2, by = 0.5))
#' # A clutch that is closed in 0.5 s, under a motor that weakens with speed.
#' start <- scene_drive(
#'   c(0.4, 2), coupling_clutch(torque_knots(c(0, 0.5), c(0, 60), outside = "hold")),
#'   torque = list(torque_motor(40, 200), -5), omega0_rad_per_s = c(150, 0)
#' )
#' motion_events(trajectory(start, time_s = 0:5))
#' @export
scene_drive <- function(bodies, couplings = list(), ..., torque = NULL, resistance = NULL,
                        brake = NULL, theta0_rad = 0, omega0_rad_per_s = 0, start_s = 0) {
  call <- current_env()
  check_supplied("bodies", call)
  check_no_dots(...)
  new_drive(
    bodies, couplings, torque, resistance, brake, theta0_rad, omega0_rad_per_s, start_s, call
  )
}

# scene_drive(), for other constructors too: `call` is the user's.
new_drive <- function(bodies, couplings, torque, resistance, brake, theta0_rad, omega0_rad_per_s,
                      start_s, call) {
  inertia <- check_inertias(bodies, "bodies", call)
  n <- length(inertia)
  each <- function(x, arg, check) lapply(one_each(x, arg, n, call), check, call)
  some <- function(x, none) if (!all(vapply(x, none, NA))) x
  finish_scene("drive", list(
    bodies = plain_bodies(bodies, inertia) %||% inertia,
    couplings = check_couplings(couplings, n, call),
    torque = some(each(torque, "torque", as_torque), torque_is_none),
    resistance = some(each(resistance, "resistance", as_resistance), Negate(resists)),
    brake = some(each(brake, "brake", as_brake), is.null),
    theta0_rad = one_or_each(theta0_rad, "theta0_rad", "rad", n, call),
    omega0_rad_per_s = one_or_each(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", n, call),
    start_s = check_number(start_s, "start_s", "s", call)
  ), call)
}

check_couplings <- function(couplings, n, call) {
  if (inherits(couplings, "rot_coupling")) couplings <- rep(list(couplings), n - 1L)
  if (!is.list(couplings) || is.object(couplings)) {
    abort_rotdyn(c(
      "{.arg couplings} must be a list of couplings.",
      x = "It is {describe_value(couplings)}.",
      i = "See {.help rotdyn::couplings}."
    ), "type", call)
  }
  if (length(couplings) != n - 1L) {
    abort_rotdyn(c(
      "{.arg couplings} must have one coupling less than there are rotors.",
      x = "{.arg bodies} has length {n}, {.arg couplings} length {length(couplings)}."
    ), "size", call)
  }
  for (i in seq_along(couplings)) {
    check_class(
      couplings[[i]], "rot_coupling", paste0("couplings[[", i, "]]"),
      "Make one with {.fn coupling_shaft}, {.fn coupling_clutch} or {.fn coupling_gear}.", call
    )
    check_form(couplings[[i]], coupling_form, paste0("couplings[[", i, "]]"), "coupling", call)
  }
  unname(couplings)
}

# n numbers, or the first, which the others follow.
one_or_each <- function(x, arg, unit, n, call) {
  x <- check_finite(x, arg, unit, call)
  if (!length(x) %in% c(1L, n)) {
    abort_rotdyn(
      c("{.arg {arg}} must have length 1 or {n}.", x = "It has length {length(x)}."), "size", call
    )
  }
  x
}

# A list of n, from NULL, from a list, or from what acts on a single rotor.
one_each <- function(x, arg, n, call) {
  if (is.null(x)) return(rep(list(NULL), n))
  if (is.numeric(x) && !is.object(x) && length(x) == n) x <- as.list(x)
  if (!is.list(x) || is.object(x)) {
    if (n == 1L) return(list(x))
    abort_rotdyn(c(
      "{.arg {arg}} must be a list with one entry for each rotor.",
      x = "It is {describe_value(x)}.",
      i = "What acts on the first of two rotors alone: {.code list({arg}, NULL)}."
    ), "type", call)
  }
  if (length(x) != n) {
    abort_rotdyn(c(
      "{.arg {arg}} must have one entry for each of the {n} rotors.",
      x = "It has {length(x)}."
    ), "size", call)
  }
  unname(x)
}

as_brake <- function(x, call) {
  if (!is.null(x)) {
    check_class(x, "rot_brake", "brake", "Make one with {.fn brake}.", call)
    check_form(x, brake_form, "brake", "brake", call)
  }
  x
}

describe_friction <- function(x) {
  paste0(
    sub("^constant, ", "", describe_torque(x$capacity_n_m)),
    if (x$static_ratio > 1) paste0(", ", format_si(x$static_ratio), " times that at rest"),
    acting_text(x)
  )
}

# When a brake or a clutch acts, after what it is.
acting_text <- function(x) {
  paste0(
    if (is.finite(x$from_s)) paste0(", from ", format_si(x$from_s), " s"),
    if (is.finite(x$to_s)) paste0(", until ", format_si(x$to_s), " s")
  )
}

describe_coupling <- function(x) {
  ratio <- paste("ratio", format_si(x$ratio))
  if (is_coupling(x, "gear")) {
    loss <- if (loses_power(x)) paste0(", efficiency ", format_si(x$efficiency))
    return(paste0("gear, ", ratio, loss))
  }
  what <- if (is_coupling(x, "clutch")) {
    paste("clutch,", describe_friction(x))
  } else {
    paste0(
      "shaft, ", format_si(x$stiffness_n_m_per_rad), " N m/rad",
      if (x$damping_n_m_s != 0) paste0(", ", format_si(x$damping_n_m_s), " N m s")
    )
  }
  if (x$ratio == 1) what else paste0(what, ", ", ratio)
}

#' @export
print.rot_coupling <- function(x, ...) {
  check_form(x, coupling_form, "x", "coupling", current_env())
  say("<rot_coupling> ", describe_coupling(x), "\n")
  invisible(x)
}

#' @export
print.rot_brake <- function(x, ...) {
  check_form(x, brake_form, "x", "brake", current_env())
  say("<rot_brake> ", describe_friction(x), "\n")
  invisible(x)
}

#' @export
print.rot_scene_drive <- function(x, ...) {
  check_scene(x, current_env())
  n <- length(x$moment_of_inertia_kg_m2)
  say("<rot_scene> ", scene_title(x), " from ", format_si(x$start_s), " s\n")
  for (i in seq_len(min(n, 8L))) {
    torque <- x$torque[[i]]
    resistance <- x$resistance[[i]]
    say(
      "  rotor ", i, "  ", format_si(x$moment_of_inertia_kg_m2[i]), " kg m^2, theta ",
      format_si(x$theta0_rad[i]), " rad, omega ", format_si(x$omega0_rad_per_s[i]), " rad/s\n",
      if (!is.null(torque) && !torque_is_zero(torque)) {
        c("    torque      ", describe_torque(torque), "\n")
      },
      if (!is.null(resistance) && describe_resistance(resistance) != "none") {
        c("    resistance  ", describe_resistance(resistance), "\n")
      },
      if (!is.null(x$brake[[i]])) c("    brake       ", describe_friction(x$brake[[i]]), "\n"),
      if (i < n) c("  ", describe_coupling(x$couplings[[i]]), "\n")
    )
  }
  if (n > 8L) say("  ...\n")
  invisible(x)
}
