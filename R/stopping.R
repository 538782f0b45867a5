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
#' Elsewhere the motion is computed, by the model that [trajectory()] takes, until all is at rest
#' for good: of a body on an incline, a bead on a hoop and a drive, and of an axle where the closed
#' form does not fit, such as a pendulum with friction.
#'
#' @param scene A scene of [scene_axle()], [scene_incline()], [scene_hoop()] or [scene_drive()].
#' @param ... Not used: an unknown argument is an error.
#' @return Of an axle a tibble of one row with the columns
#'   `r describe_columns(c("stop_time_s", "stop_theta_rad", "terminal_omega_rad_per_s"))`
#'   Where the body never comes to rest for good, `stop_time_s` is Inf and `stop_theta_rad` the
#'   angle that it tends to: \eqn{\theta_0 + I \omega_0 / c}{theta0 + I omega0/c} with viscous
#'   resistance, \eqn{\theta_0 + (I/q) \ln(1 + q \omega_0 / c)}{theta0 + I/q log(1 + q omega0/c)}
#'   with quadratic drag, too; infinite with quadratic drag alone; NaN where a speed is left. The
#'   terminal speed is 0 where friction holds the last torque, and infinite where nothing resists
#'   it; where in the end nothing acts at all, it is the speed left. Without a closed form the angle
#'   and the speed of what never stops are NaN.
#'
#'   Of the others the columns `stop_time_s`, when all is at rest, and the place where: `stop_x_m`
#'   and `stop_theta_rad` on an incline, `stop_theta_rad` of a bead, `rotor` and `stop_theta_rad`
#'   with a row for each rotor of a drive. On an incline also `terminal_v_m_per_s`, the speed that
#'   the body tends to, infinite where it is accelerated for good.
#'
#'   One rule holds for all: what stops has its time; what is known never to stop, because nothing
#'   holds it at rest or it is driven or swings for ever, has the time Inf and, but for the angle of
#'   an axle, the place NaN, and where the speed does not say why, a message does
#'   (`rotdyn_message_stop`); what is not known is an error (`rotdyn_error_model`).
#' @section Warnings: `rotdyn_warning_range` where the angle of a stop is beyond double precision;
#'   `rotdyn_warning_slack` where the rope of a hanging mass would have to push.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_range` where the motion to the stop is beyond
#'   double precision; `rotdyn_error_model` where it is not known whether the scene stops (a law
#'   that changes in time, or is a function; one still in motion 4^10 s after the last change of its
#'   laws, 4^30 s where at most 1000 steps lead there), and for a scene of another kind.
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
#' # A ball thrown onto a rough floor with rolling resistance; a bead with friction.
#' stopping(scene_incline(
#'   body_sphere(1, 0.1), 0, v0_m_per_s = 3, static_friction = 0.3, rolling_arm_m = 0.002
#' ))
#' stopping(scene_hoop(1, 1, 2, theta0_rad = 1, static_friction = 0.1))
#' @export
stopping <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene(scene, call)
  constraint <- constraint_of(scene)
  if (is.null(constraint$stops)) abort_nothing_rests(scene, call)
  stops <- constraint$stops(scene, call)
  warn_of_end(scene, NULL, call)
  stops
}

# ---- in closed form -----------------------------------------------------------------------------

axle_stops <- function(scene, call) {
  fit <- core_pick("axle", scene, scene$start_s, 1, model = "axle_drag")
  # At the start alone, all may be left out.
  left_out <- fit$dropped[[1]]$effects
  why_not <- fit$reason %||% if (length(left_out)) {
    paste("it leaves out", effects_in_words(left_out, constraint_of(scene)))
  }
  if (!is.null(why_not)) {
    found <- stops_at_rest(stop_theta_rad = "theta_rad")(scene, call)
    found$terminal_omega_rad_per_s <- if (is.finite(found$stop_time_s)) 0 else NaN
    return(found)
  }
  x <- .Call(ffi_axle_stopping, scene)
  if (is.na(x[1])) {
    abort_rotdyn(c(
      "The motion to the stop exceeds double precision.",
      i = "Start slower, or with more resistance."
    ), "range", call)
  }
  if (is.finite(x[1])) warn_beyond(list(stop_theta_rad = x[2]), list(), 1L, call)
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

# ---- by the motion itself -----------------------------------------------------------------------

# Of a scene that dry friction or a brake stops; `...`: columns of the place, by the names of the
# answer. `goes_on`: a function of a scene, why it never rests once it moves; or NULL. What never
# rests has Inf and no place, and a message says why; what is not known is an error.
stops_at_rest <- function(..., goes_on = nothing_holds) {
  place <- c(...)
  function(scene, call) {
    constraint <- constraint_of(scene)
    why <- goes_on(scene)
    found <- rest_of_motion(scene, "omega_rad_per_s", call, if (is.null(why)) 30 else 0)
    if (is.null(found)) {
      if (is.null(why)) abort_no_stop(call)
      inform_quickly(paste0("It never stops: ", why, "."), "stop")
    }
    row <- unclass(found$row %||% suppressWarnings(
      compute_trajectory(scene, scene$start_s, 1e-9, NULL, "abort", 1e6, call)
    ))
    at <- stats::setNames(row[place], names(place))
    if (is.null(found)) at[] <- NaN
    do.call(as_table, c(row[constraint$index], stop_time_s = found$time_s %||% Inf, at))
  }
}

# Why nothing holds a scene at rest, or NULL.
nothing_holds <- function(scene) {
  if (!any(c("friction", "brake") %in% core_effects(constraint_of(scene)$id, scene))) {
    "no dry friction or brake holds it at rest"
  }
}

# The time from which a motion that ends at rest is at rest, and its row: NULL if it is not seen to
# end so in 4^10 s beyond the last change of a law, 4^30 s where few steps lead there. `rates`: the
# columns that are 0 at rest; `last`: 30, or as many such times as are looked at.
rest_of_motion <- function(scene, rates, call, last = 30) {
  changes <- last_change(list(
    scene[["torque"]], scene[["force"]], scene[["brake"]], scene[["couplings"]]
  ))
  if (changes == Inf) {
    abort_rotdyn(c(
      "What drives this scene changes in time, or is a function: no stop is known to be for good.",
      i = "{.fn trajectory} and {.fn motion_events} show its stops."
    ), "model", call)
  }
  run <- function(time_s, max_steps = 1e6) {
    suppressWarnings(compute_trajectory(scene, time_s, 1e-9, NULL, "abort", max_steps, call))
  }
  for (k in 0:last) {
    motion <- tryCatch(
      run(max(scene$start_s, changes) + 4^k, if (k < 10) 1e6 else 1e4),
      rotdyn_error_budget = function(e) NULL,
      # A speed that fades is lost in the resolution of a late time.
      rotdyn_error_step = function(e) NULL
    )
    if (is.null(motion)) return(NULL)
    if (all(vapply(rates, function(name) all(motion[[name]] == 0), NA))) {
      at <- rest_begins(
        run, sort(unique(c(scene$start_s, trajectory_run(motion)$events$time_s))), rates
      )
      return(if (!is.na(at)) list(time_s = at, row = run(at)))
    }
    # The next is four times as long, and may take 1e6.
    if (trajectory_run(motion)$info$steps > if (k < 10) 2.5e5 else 1000) return(NULL)
  }
  NULL
}

# The first of the times of events from which on the body is at rest at them and between them. NA:
# it moves at the last one. A speed that fades becomes 0 by underflow, long after the last event.
rest_begins <- function(run, events, rates) {
  time_s <- sort(c(events, (events[-1] + events[-length(events)]) / 2))
  rows <- run(time_s)
  still <- Reduce(`&`, lapply(rates, function(name) {
    size <- abs(matrix(rows[[name]], ncol = length(time_s)))
    colSums(size > 1e-6 * max(size)) == 0
  }))
  from <- max(0, which(!still)) + 1
  events[events >= time_s[from]][1]
}

# Of laws: the time of the last knot, -Inf where nothing changes in time, Inf where it goes on.
last_change <- function(law) {
  if (inherits(law, "rot_torque_sum")) law <- law$laws
  if (inherits(law, "rot_torque_knots")) return(max(-Inf, law$time_s))
  if (inherits(law, c("rot_brake", "rot_coupling"))) {
    limits <- c(law$from_s, law$to_s)
    return(max(-Inf, limits[is.finite(limits)], last_change(law[["capacity_n_m"]])))
  }
  if (inherits(law, "rot_torque_term")) {
    if (law$kind %in% c("spring", "gravity", "curve")) return(-Inf)
    return(if (law$kind == "polynomial") max(law$breaks_s) else law$to_s)
  }
  if (inherits(law, "rot_torque_motor") || is.null(law) || is.numeric(law)) return(-Inf)
  if (is.function(law) || inherits(law, "rot_torque") || !is.list(law)) return(Inf)
  max(-Inf, vapply(law, last_change, double(1)))
}

abort_nothing_rests <- function(scene, call) {
  abort_rotdyn(c(
    "{.fn stopping} is of scenes that friction may hold at rest: axles, inclines, hoops, drives.",
    x = "It is {.obj_type_friendly {scene}}.",
    i = "{.fn trajectory} and {.fn motion_events} show the motion."
  ), "model", call)
}

abort_no_stop <- function(call) {
  abort_rotdyn(c(
    "This scene is not seen to stop, in 1e6 s at least.",
    i = "{.fn trajectory} and {.fn motion_events} show the motion."
  ), "model", call)
}
