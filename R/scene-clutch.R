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
#' @param torque Torque on each body: two numbers in N m, or a list of two [torque] laws, with NULL
#'   for none.
#' @param resistance,brake NULL, or a list of two [resistance()]s and [brake()]s, with NULL for
#'   none.
#' @param theta0_rad,omega0_rad_per_s Angles and angular velocities of the two bodies at `start_s`:
#'   two numbers each.
#' @param engage_s Time from which the clutch is pressed; -Inf, or any time up to `start_s`, for
#'   always.
#' @param start_s Time at which the state above holds. Earlier times are an error: the slip before
#'   locking is undetermined.
#' @return A `rot_scene_clutch`, which is a `rot_scene`. Where a torque is not constant between
#'   jumps, or with a resistance or a brake, the bodies are a [scene_drive()] with a clutch (which
#'   is pressed from `engage_s` on, too). Its trajectory has the
#'   columns `r describe_columns(columns_of_motion("clutch"))`
#'   The error is a bound.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), chapter 16 (energy of clutches).
#' @seealso [clutch_engagement()] for numbers, [scene_drive()] for any torque law,
#'   [trajectory()].
#' @concept brake
#' @concept clutch
#' @examples
#' scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0))
#' scene_clutch(
#'   body_disk(20, 0.15), body_disk(40, 0.2), capacity_n_m = 60, static_capacity_n_m = 75,
#'   torque = list(torque_steps(c(0, 2, 5), c(30, -10, 0)), -5), omega0_rad_per_s = c(150, 0),
#'   engage_s = 0.5
#' )
#' @export
scene_clutch <- function(body_1, body_2, capacity_n_m, ..., static_capacity_n_m = capacity_n_m,
                         torque = NULL, resistance = NULL, brake = NULL, theta0_rad = 0,
                         omega0_rad_per_s = 0, engage_s = -Inf, start_s = 0) {
  call <- current_env()
  check_no_dots(...)
  if (is.numeric(torque) && length(torque) == 2L && !is.object(torque)) torque <- as.list(torque)
  stepped <- is.null(torque) || !is.list(torque) || is.object(torque) || length(torque) != 2L
  if (!stepped) {
    torque <- lapply(unname(torque), as_torque, call)
    stepped <- all(vapply(torque, torque_is_stepped, NA))
    if (all(vapply(torque, torque_is_none, NA))) torque <- NULL
  }
  plain <- function(x) is.null(x) || (is.list(x) && !is.object(x) && all(vapply(x, is.null, NA)))
  if (stepped && plain(resistance) && plain(brake)) return(scene_of_inputs("clutch", call))
  check_supplied(c("body_1", "body_2", "capacity_n_m"), call)
  capacity <- check_number(capacity_n_m, "capacity_n_m", "N*m", call, lower = 0)
  static <- check_number(static_capacity_n_m, "static_capacity_n_m", "N*m", call, lower = capacity)
  # One rate for both would be a clutch that never slips: a slip of the pen, refused likewise above.
  both_of <- function(x, arg) {
    if (length(x) == 2L || identical(x, 0)) return(rep_len(x, 2))
    abort_rotdyn(
      "{.arg {arg}} must have 2 numbers, one for each body; it has {length(x)}.", "value", call
    )
  }
  new_drive(
    list(body_1, body_2),
    coupling_clutch(
      capacity, static_ratio = if (capacity > 0) static / capacity else 1, from_s = engage_s
    ),
    torque = torque, resistance = resistance, brake = brake,
    theta0_rad = both_of(theta0_rad, "theta0_rad"),
    omega0_rad_per_s = both_of(omega0_rad_per_s, "omega0_rad_per_s"),
    start_s = start_s, call = call
  )
}

# Constant between jumps.
torque_is_stepped <- function(torque) {
  loads <- torque_loads(torque)
  if (length(loads$terms) || !is.null(loads$law) || loads$motor_n_m_s != 0) return(FALSE)
  knots <- loads$knots
  n <- length(knots$time_s)
  n < 2L || all(diff(knots$time_s) == 0 | diff(knots$torque_n_m) == 0)
}

#' @export
print.rot_scene_clutch <- function(x, ...) {
  check_scene(x, current_env())
  both <- function(values) paste(format_si(rep_len(values, 2)), collapse = ", ")
  engaged <- if (x$engage_s <= x$start_s) "engaged" else paste("engages at", x$engage_s, "s")
  say(
    "<rot_scene> ", scene_title(x), "\n",
    "  inertia   ", paste(format_si(x$moment_of_inertia_kg_m2), collapse = ", "), " kg m^2\n",
    "  clutch    ", format_si(x$capacity_n_m), " N m slipping, ",
    format_si(x$static_capacity_n_m), " N m locked, ", engaged, "\n",
    "  torque 1  ", describe_torque(x$torque[[1]] %||% torque_constant(0)), "\n",
    "  torque 2  ", describe_torque(x$torque[[2]] %||% torque_constant(0)), "\n",
    "  start     theta ", both(x$theta0_rad), " rad, omega ", both(x$omega0_rad_per_s),
    " rad/s at ", format_si(x$start_s), " s\n"
  )
  invisible(x)
}
