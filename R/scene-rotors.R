#' Several rotors on one shaft
#'
#' Rotors in a line, with a piece of elastic shaft between neighbours:
#' \deqn{J_i \ddot\theta_i = \tau_i - d_i \omega_i + T_{i-1} - T_i, \qquad
#'   T_i = k_i (\theta_i - \theta_{i+1}) + c_i (\omega_i - \omega_{i+1})}{
#'   J_i theta_i'' = tau_i - d_i omega_i + T_(i-1) - T_i,
#'   T_i = k_i (theta_i - theta_(i+1)) + c_i (omega_i - omega_(i+1))}
#' with the torque `T_i` of shaft `i` on rotor `i + 1`.
#'
#' [trajectory()] solves it exactly for any stiffness: the mean motion separately, the twists in
#' modes. Where the twists are below the accuracy asked, it takes the shaft as rigid, with a bound
#' on the difference.
#'
#' @param bodies A list of `rot_body` (their Izz counts), or the moments of inertia as numbers in
#'   kg m^2; each greater than 0.
#' @param stiffness_n_m_per_rad Torsional stiffness of the shaft between neighbours: one number, or
#'   one for each of the `n - 1` pieces; at least 0 (0: a piece that only damps, or no piece).
#' @param damping_n_m_s Damping of the shaft between neighbours in N m s, likewise, at least 0.
#' @param ... Not used; names after it must be given in full.
#' @param torque Torque on each rotor from outside: `n` numbers in N m, 0 for none, or a list of `n`
#'   [torque] laws, with NULL for none.
#' @param resistance [resistance()] of the bearing of each rotor, or its viscous coefficient: one
#'   for all, or `n`.
#' @param brake NULL, or a list of `n` [brake()]s, with NULL for none.
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity of each rotor at `start_s`: one
#'   number or `n`.
#' @param start_s Time at which the state above holds.
#' @return A `rot_scene_rotors`, which is a `rot_scene`. Where a torque is not constant, a
#'   resistance not viscous, or there is a brake, the rotors are a [scene_drive()]. Its trajectory
#'   has one row for each time and rotor:
#'   `r describe_columns(columns_of_motion("rotors"))`
#'   The error is an estimate: rounding times the accumulated phase, plus the momentum residual.
#'   That of the rigid shaft is a bound.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Meirovitch, Fundamentals of Vibrations (2001), chapter 7.
#' @seealso [shaft_modes()], [scene_drive()], [trajectory()].
#' @concept torsion
#' @concept shaft
#' @concept flywheel
#' @examples
#' scene_rotors(c(1, 2), stiffness_n_m_per_rad = 1000, omega0_rad_per_s = c(1, 0.5))
#' scene_rotors(
#'   list(body_disk(4, 0.2), body_disk(1, 0.1), body_disk(6, 0.3)),
#'   stiffness_n_m_per_rad = c(800, 1200), damping_n_m_s = 0.05, torque = c(2, 0, -2)
#' )
#' # A motor on the first: a drive.
#' scene_rotors(c(1, 2), 1000, torque = list(torque_motor(5, 100), NULL))
#' @export
scene_rotors <- function(bodies, stiffness_n_m_per_rad, damping_n_m_s = 0, ..., torque = 0,
                         resistance = 0, brake = NULL, theta0_rad = 0, omega0_rad_per_s = 0,
                         start_s = 0) {
  call <- current_env()
  check_supplied(c("bodies", "stiffness_n_m_per_rad"), call)
  check_no_dots(...)
  inertia <- check_inertias(bodies, "bodies", call)
  n <- length(inertia)
  each <- function(x, arg, unit, size, lower = -Inf) {
    check_each(x, arg, unit, size, lower, call)
  }
  stiffness <- check_between(
    stiffness_n_m_per_rad, "stiffness_n_m_per_rad", "N*m/rad", n - 1L, 0, call
  )
  damping <- each(damping_n_m_s, "damping_n_m_s", "N*m*s", n - 1L, 0)
  loads <- family_loads(torque, resistance, brake, n, call)
  if (loads$is_drive) {
    return(new_drive(
      bodies, Map(coupling_shaft, stiffness, damping), torque = loads$torque,
      resistance = loads$resistance, brake = loads$brake,
      theta0_rad = each(theta0_rad, "theta0_rad", "rad", n),
      omega0_rad_per_s = each(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", n),
      start_s = start_s, call = call
    ))
  }
  finish_scene("rotors", list(
    bodies = plain_bodies(bodies, inertia) %||% inertia, stiffness_n_m_per_rad = stiffness,
    damping_n_m_s = damping, torque = loads$torque, resistance = loads$resistance,
    theta0_rad = each(theta0_rad, "theta0_rad", "rad", n),
    omega0_rad_per_s = each(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", n),
    start_s = check_number(start_s, "start_s", "s", call)
  ), call)
}

# What acts on n bodies about parallel axes: list(is_drive, torque, resistance, brake). Constant
# torques and viscous coefficients are numbers; with anything else the bodies are a drive, whose
# lists they are.
family_loads <- function(torque, resistance, brake, n, call) {
  laws <- if (is.null(torque) || (is.numeric(torque) && !is.list(torque))) {
    check_torque_each(torque %||% 0, "torque", n, call)
  } else {
    lapply(one_each(torque, "torque", n, call), as_torque, call)
  }
  if (is.list(laws) && all(vapply(laws, torque_is_constant, NA))) {
    laws <- vapply(laws, function(law) law$outside[1], 1)
  }
  terms <- if (is.list(resistance) && !is.object(resistance)) resistance else list(resistance)
  plain <- all(vapply(terms, function(one) {
    !inherits(one, "rot_resistance") ||
      all(resisting_terms(one) == "viscous_n_m_s") && isTRUE(one$viscous_n_m_s >= 0)
  }, NA))
  if (is.numeric(laws) && plain && is.null(brake)) {
    return(list(
      is_drive = FALSE, torque = laws, resistance = viscous_of_each(resistance, n, call)
    ))
  }
  if (is.numeric(laws)) laws <- lapply(laws, torque_constant)
  if (inherits(resistance, "rot_resistance") || is.numeric(resistance)) {
    resistance <- rep_len(as.list(if (is.numeric(resistance)) resistance else terms), n)
  }
  if (inherits(brake, "rot_brake") && n > 1L) {
    abort_rotdyn(c(
      "{.arg brake} must be a list with one entry for each of the {n} bodies.",
      i = "On the first alone: {.code list(brake, NULL)}."
    ), "type", call)
  }
  list(is_drive = TRUE, torque = laws, resistance = resistance, brake = brake)
}

# Moments of inertia about the axle, from a list of bodies or numbers.
check_inertias <- function(bodies, arg, call) {
  if (is.list(bodies) && !is.object(bodies)) {
    inertia <- vapply(seq_along(bodies), function(i) {
      body <- bodies[[i]]
      if (inherits(body, "rot_body")) {
        named_moment(check_body(body, call, paste0(arg, "[[", i, "]]")), c(0, 0, 1))
      } else {
        check_number(body, paste0(arg, "[[", i, "]]"), "kg*m^2", call)
      }
    }, double(1))
  } else if (inherits(bodies, "rot_body")) {
    inertia <- named_moment(check_body(bodies, call, arg), c(0, 0, 1))
  } else {
    inertia <- check_finite(bodies, arg, "kg*m^2", call)
  }
  if (!length(inertia)) abort_rotdyn("{.arg {arg}} is empty.", "size", call)
  bad <- which(!(is.finite(inertia) & inertia > 0))
  if (length(bad)) {
    body <- if (length(inertia) == 1L) arg else paste0(arg, "[[", bad[1], "]]")
    abort_rotdyn(c(
      "{.arg {body}} must have a moment of inertia about the axle, finite and greater than 0.",
      x = "It is {format(inertia[bad[1]])} kg m^2.",
      i = if (inertia[bad[1]] %in% 0 && !is.numeric(bodies)) {
        "Its mass is on the axle, or too near for double precision: give it a larger radius, or a
         place by {.fn place_body}."
      }
    ), "value", call)
  }
  inertia
}

one_inertia <- function(body, arg, call) {
  inertia <- check_inertias(body, arg, call)
  if (length(inertia) != 1L) {
    abort_rotdyn("{.arg {arg}} must be one body or one number in kg m^2.", "size", call)
  }
  inertia
}

# The bodies given, each a `rot_body` or its moment of inertia; NULL where there are moments alone.
plain_bodies <- function(bodies, inertia) {
  if (inherits(bodies, "rot_body")) return(list(bodies))
  if (!is.list(bodies) || !any(vapply(bodies, inherits, NA, "rot_body"))) return(NULL)
  unname(Map(function(body, moment) {
    if (inherits(body, "rot_body")) body else moment
  }, bodies, inertia))
}

# One number, or `size` of them.
check_each <- function(x, arg, unit, size, lower, call) {
  x <- check_finite(x, arg, unit, call)
  if (!length(x) %in% c(1L, size)) {
    abort_rotdyn(
      c(
        "{.arg {arg}} must have length {paste(unique(c(1L, max(1L, size))), collapse = ' or ')}.",
        x = "It has length {length(x)}."
      ), "size", call
    )
  }
  bad <- which(x < lower)
  if (length(bad)) abort_domain(x[bad[1]], arg, unit, call, lower, Inf, FALSE)
  rep_len(x, size)
}

# What lies between neighbours: `size` numbers, or one for all; none for a single body.
check_between <- function(x, arg, unit, size, lower, call) {
  if (size == 0L && length(x)) {
    abort_rotdyn(c(
      "{.arg bodies} must have two entries or more where {.arg {arg}} is given.",
      x = "It has one.",
      i = "For two: {.code bodies = c(1, 2)}. For one alone: {.code {arg} = numeric()}."
    ), "size", call)
  }
  check_each(x, arg, unit, size, lower, call)
}

# One torque for each body. A single number is ambiguous: on the first, or on each.
check_torque_each <- function(x, arg, size, call) {
  x <- check_finite(x, arg, "N*m", call)
  if (size > 1L && length(x) == 1L && x != 0) {
    first <- c(x, rep(0, min(size, 4L) - 1L))
    code <- paste0("c(", paste(format_si(first), collapse = ", "), if (size > 4L) ", ...", ")")
    abort_rotdyn(c(
      "{.arg {arg}} must have a torque for each of the {size} bodies.",
      x = "It is one number, {format_si(x)} N m.",
      i = "On the first alone: {.code {arg} = {code}}."
    ), "size", call)
  }
  check_each(x, arg, "N*m", size, -Inf, call)
}

#' @export
print.rot_scene_rotors <- function(x, ...) {
  check_scene(x, current_env())
  list_of <- function(values) {
    # One value where all are equal, else each in its place.
    if (length(unique(values)) == 1L) values <- values[1]
    if (!length(values)) return("none")
    shown <- format_si(values[seq_len(min(6L, length(values)))])
    paste0(paste(shown, collapse = ", "), if (length(values) > 6L) ", ...")
  }
  n <- length(x$moment_of_inertia_kg_m2)
  say(
    "<rot_scene> ", scene_title(x), "\n",
    "  inertia    ", list_of(x$moment_of_inertia_kg_m2), " kg m^2 about the shaft\n",
    "  stiffness  ", list_of(x$stiffness_n_m_per_rad), " N m/rad between neighbours\n",
    "  damping    ", list_of(x$damping_n_m_s), " N m s between neighbours, ",
    list_of(x$resistance), " N m s outside\n",
    "  torque     ", list_of(x$torque), " N m\n",
    "  start      theta ", list_of(x$theta0_rad), " rad, omega ", list_of(x$omega0_rad_per_s),
    " rad/s at ", format_si(x$start_s), " s\n"
  )
  invisible(x)
}

#' Natural frequencies of a shaft
#'
#' The angular frequencies of the twists of a [scene_rotors()] without damping, ascending, good to
#' some roundings however much rotors and springs differ. The mean motion, and each piece of shaft
#' without stiffness, has the frequency 0.
#'
#' @param scene A [scene_rotors()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble (class `rot_shaft_modes`; `ggplot2::autoplot()` draws the shapes) with one row
#'   for each mode:
#'   `r describe_columns(c("mode", "natural_rad_per_s"))`
#'   Frequencies beyond double precision are NA.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_memory`.
#' @source Meirovitch, Fundamentals of Vibrations (2001), chapter 7.
#' @seealso [scene_rotors()], [autoplot.rot_shaft_modes()], [period_of()].
#' @concept frequency
#' @concept period
#' @concept vibration
#' @examples
#' shaft_modes(scene_rotors(c(1, 2, 1), stiffness_n_m_per_rad = 500))
#' @export
shaft_modes <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_class(scene, "rot_scene_rotors", "scene", "Describe one with {.fn scene_rotors}.", call)
  check_scene(scene, call)
  result <- .Call(ffi_rotors_frequencies, scene, progress_bar("modes"))
  frequencies <- result$frequencies
  # Beyond double precision they are NA.
  if (!result$info$kind %in% c("none", "range")) {
    abort_rotdyn("The modes were not computed: {result$info$text}.", result$info$kind, call)
  }
  new_table(
    list(mode = seq_along(frequencies), natural_rad_per_s = frequencies),
    nrow = length(frequencies),
    shaft = unclass(scene)[c("moment_of_inertia_kg_m2", "stiffness_n_m_per_rad")],
    class = "rot_shaft_modes"
  )
}
