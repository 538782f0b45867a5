#' Resistance to rotation
#'
#' The torque that resists rotation, as data: viscous drag `c`, quadratic drag `q`, sliding friction
#' `f`. While the body rotates it is
#' \deqn{\tau_r = -(c\,\omega + q\,\omega|\omega| + f\,\mathrm{sign}\,\omega)}{
#'   -(c omega + q omega |omega| + f sign(omega)).}
#'
#' A body at rest stays at rest while the other torques are at most `static_n_m`, and breaks loose
#' when they exceed it.
#'
#' @param viscous_n_m_s Viscous coefficient in N m s (N m per rad/s), one finite number. A negative
#'   one drives: the motion grows without bound.
#' @param quadratic_n_m_s2 Quadratic drag in N m s^2 (N m per (rad/s)^2), >= 0.
#' @param coulomb_n_m Sliding (Coulomb) friction in N m, >= 0.
#' @param static_n_m Largest static friction in N m, at least the sliding friction.
#' @param ... Not used: an unknown argument is an error.
#' @return A `rot_resistance`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` unless each
#'   is one finite number in range; `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 1.5
#'   (dissipation); Armstrong-Helouvry, Control of Machines with Friction (1991), chapter 2 (dry
#'   friction).
#' @seealso [scene_axle()] takes it, [stopping()] and [time_when()] for the coast-down, [brake()]
#'   for a brake with an on-time, [clutch_engagement()].
#' @concept brake
#' @concept friction
#' @concept drag
#' @concept damping
#' @examples
#' resistance(viscous_n_m_s = 0.03)
#' resistance(quadratic_n_m_s2 = 1e-4, coulomb_n_m = 0.2, static_n_m = 0.3)
#' # How long does a brake of 0.5 N m take to stop a flywheel?
#' flywheel <- body_disk(20, 0.3)
#' stopping(scene_axle(flywheel, NULL, resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 30))
#' @export
resistance <- function(viscous_n_m_s = 0, quadratic_n_m_s2 = 0, coulomb_n_m = 0,
                       static_n_m = coulomb_n_m, ...) {
  call <- check_no_dots(...)
  viscous <- check_number(viscous_n_m_s, "viscous_n_m_s", "N*m*s", call)
  if (nargs() == 1L && !missing(viscous_n_m_s)) {
    return(new_resistance(viscous)) # half the time of the usual call
  }
  quadratic <- check_number(quadratic_n_m_s2, "quadratic_n_m_s2", "N*m*s^2", call, lower = 0)
  coulomb <- check_number(coulomb_n_m, "coulomb_n_m", "N*m", call, lower = 0)
  static <- check_number(static_n_m, "static_n_m", "N*m", call, lower = 0)
  if (static < coulomb) {
    abort_rotdyn(c(
      "{.arg static_n_m} must be at least {.arg coulomb_n_m}.",
      x = "They are {format(static)} and {format(coulomb)} N m.",
      i = "A body that breaks loose would stop at once otherwise."
    ), "value", call)
  }
  new_resistance(viscous, quadratic, coulomb, static)
}

new_resistance <- function(viscous_n_m_s, quadratic_n_m_s2 = 0, coulomb_n_m = 0, static_n_m = 0) {
  x <- list(
    viscous_n_m_s = viscous_n_m_s, quadratic_n_m_s2 = quadratic_n_m_s2,
    coulomb_n_m = coulomb_n_m, static_n_m = static_n_m
  )
  class(x) <- "rot_resistance"
  x
}

as_resistance <- function(x, call) {
  if (is.null(x)) return(new_resistance(0))
  if (!inherits(x, "rot_resistance")) {
    check_class(
      x, "rot_resistance", "resistance",
      "Write {.code resistance(viscous_n_m_s = )}.", call
    )
  }
  check_form(x, resistance_form, "resistance", "resistance", call)
}

resists <- function(resistance) {
  any(vapply(
    c("viscous_n_m_s", "quadratic_n_m_s2", "coulomb_n_m", "static_n_m"),
    function(part) resistance[[part]] != 0, NA
  ))
}

describe_resistance <- function(x) {
  parts <- c(
    if (x$viscous_n_m_s != 0) paste("viscous,", format_si(x$viscous_n_m_s), "N m s"),
    if (x$quadratic_n_m_s2 != 0) paste("quadratic,", format_si(x$quadratic_n_m_s2), "N m s^2"),
    if (x$static_n_m != 0) {
      paste0(
        "dry, ", format_si(x$coulomb_n_m), " N m sliding",
        if (x$static_n_m > x$coulomb_n_m) paste0(" and ", format_si(x$static_n_m), " N m static")
      )
    }
  )
  if (length(parts)) paste(parts, collapse = "; ") else "none"
}

#' @export
print.rot_resistance <- function(x, ...) {
  check_form(x, resistance_form, "x", "resistance", rlang::current_env())
  cat("<rot_resistance> ", describe_resistance(x), "\n", sep = "")
  invisible(x)
}
