#' Resistance to motion
#'
#' What resists a motion, as data: about an axle viscous drag `c`, quadratic drag `q`, sliding
#' friction `f`. While the body rotates the torque is
#' \deqn{\tau_r = -(c\,\omega + q\,\omega|\omega| + f\,\mathrm{sign}\,\omega)}{
#'   -(c omega + q omega |omega| + f sign(omega)).}
#'
#' A body at rest stays at rest while the other torques are at most `static_n_m`, and breaks loose
#' when they exceed it.
#'
#' Each scene takes some of the terms, which its help names, and refuses the others:
#'
#' | scene | terms |
#' |---|---|
#' | [scene_axle()] | `viscous_n_m_s`, `quadratic_n_m_s2`, `coulomb_n_m`, `static_n_m` |
#' | [scene_pendulum()], [scene_hanging_mass()], [scene_drive()] | those of an axle |
#' | [scene_rotors()], [scene_gears()], [scene_clutch()] | those of an axle (as a drive) |
#' | [scene_hoop()] | `drag_n_s_per_m` |
#' | [scene_chain()] | `viscous_n_m_s`, of the joints |
#' | [scene_free()], [scene_pivot()] | `damping_per_s` |
#' | [scene_incline()] | `drag_n_s_per_m`, `drag_n_s2_per_m2` |
#'
#' @param viscous_n_m_s Viscous coefficient in N m s (N m per rad/s), one finite number. A negative
#'   one drives: the motion grows without bound.
#' @param quadratic_n_m_s2 Quadratic drag in N m s^2 (N m per (rad/s)^2), >= 0.
#' @param coulomb_n_m Sliding (Coulomb) friction in N m, >= 0.
#' @param static_n_m Largest static friction in N m, at least the sliding friction.
#' @param ... Not used; names after it must be given in full.
#' @param damping_per_s Of a body in space, in 1/s: the torque `-damping L` against its angular
#'   momentum L, which then fades as `exp(-damping t)`. One finite number.
#' @param drag_n_s_per_m,drag_n_s2_per_m2 Drag on a centre of mass, `(c1 + c2 |v|) v` against the
#'   velocity: c1 in N s/m and c2 in N s^2/m^2, >= 0.
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
#' @concept air resistance
#' @concept bearing
#' @examples
#' resistance(viscous_n_m_s = 0.03)
#' resistance(quadratic_n_m_s2 = 1e-4, coulomb_n_m = 0.2, static_n_m = 0.3)
#' # How long does a brake of 0.5 N m take to stop a flywheel?
#' flywheel <- body_disk(20, 0.3)
#' stopping(scene_axle(flywheel, NULL, resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 30))
#' @export
resistance <- function(viscous_n_m_s = 0, quadratic_n_m_s2 = 0, coulomb_n_m = 0,
                       static_n_m = coulomb_n_m, ..., damping_per_s = 0, drag_n_s_per_m = 0,
                       drag_n_s2_per_m2 = 0) {
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
  new_resistance(
    viscous, quadratic, coulomb, static,
    check_number(damping_per_s, "damping_per_s", "1/s", call),
    check_number(drag_n_s_per_m, "drag_n_s_per_m", "N*s/m", call, lower = 0),
    check_number(drag_n_s2_per_m2, "drag_n_s2_per_m2", "N*s^2/m^2", call, lower = 0)
  )
}

# In the order of rot_resistance in src/core/engine/resistance.h.
new_resistance <- function(viscous_n_m_s, quadratic_n_m_s2 = 0, coulomb_n_m = 0, static_n_m = 0,
                           damping_per_s = 0, drag_n_s_per_m = 0, drag_n_s2_per_m2 = 0) {
  x <- list(
    viscous_n_m_s = viscous_n_m_s, quadratic_n_m_s2 = quadratic_n_m_s2,
    coulomb_n_m = coulomb_n_m, static_n_m = static_n_m, damping_per_s = damping_per_s,
    drag_n_s_per_m = drag_n_s_per_m, drag_n_s2_per_m2 = drag_n_s2_per_m2
  )
  class(x) <- "rot_resistance"
  x
}

resistance_terms <- c(
  viscous_n_m_s = "N*m*s", quadratic_n_m_s2 = "N*m*s^2", coulomb_n_m = "N*m", static_n_m = "N*m",
  damping_per_s = "1/s", drag_n_s_per_m = "N*s/m", drag_n_s2_per_m2 = "N*s^2/m^2"
)

# As an argument: NULL, or a resistance with terms of which the scene takes these; a number is the
# viscous one.
as_resistance <- function(x, call, takes = names(resistance_terms)[1:4]) {
  if (is.null(x)) return(new_resistance(0))
  if (is.numeric(x) && takes[1] == "viscous_n_m_s") {
    return(new_resistance(check_number(x, "resistance", "N*m*s", call)))
  }
  remedy <- if (inherits(x, "rot_brake")) resistance_remedy(x) else
    paste0("Write {.code resistance(", takes[1], " = )}.")
  check_class(x, "rot_resistance", "resistance", remedy, call)
  check_form(x, resistance_form, "resistance", "resistance", call)
  given <- setdiff(resisting_terms(x), takes)
  if (!length(given)) return(x)
  abort_rotdyn(c(
    "{.arg resistance} has {cli::qty(length(given))}{?a term/terms} that this scene does not take:
     {.field {given}}.",
    i = "It takes {.field {takes}}.",
    i = if (all(given %in% names(resistance_terms)[1:4]) && identical(takes, "viscous_n_m_s")) {
      "{.fn scene_drive} takes the others, too."
    }
  ), "value", call)
}

resisting_terms <- function(x) {
  names(resistance_terms)[vapply(names(resistance_terms), function(name) x[[name]] != 0, NA)]
}

resists <- function(resistance) length(resisting_terms(resistance)) > 0L

# A term of the resistance of a scene, 0 where it has none.
resistance_term <- function(scene, name) .subset2(scene, "resistance")[[name]] %||% 0

# A viscous coefficient for each of n bodies: from numbers, a resistance for all, or a list with one
# of these or NULL for each. n NULL: the core counts.
viscous_of_each <- function(x, n, call, arg = "resistance") {
  number <- function(one) {
    if (is.numeric(one)) return(check_number(one, arg, "N*m*s", call, lower = 0))
    viscous <- as_resistance(one, call, "viscous_n_m_s")$viscous_n_m_s
    check_number(viscous, "viscous_n_m_s", "N*m*s", call, lower = 0)
  }
  all <- function(x) if (is.null(n)) x else rep_len(x, n)
  if (is.null(x)) return(all(0))
  if (is.numeric(x) && (!is.object(x) || inherits(x, "units"))) {
    if (!is.null(n)) return(check_each(x, arg, "N*m*s", n, 0, call))
    x <- check_finite(x, arg, "N*m*s", call)
    check_not_negative(x, arg, "N*m*s", call)
    return(x)
  }
  if (!is.list(x) || is.object(x)) return(all(number(x)))
  if (!is.null(n) && length(x) != n) {
    abort_rotdyn(c(
      "{.arg {arg}} must have one entry for each of the {n} bodies.", x = "It has {length(x)}."
    ), "size", call)
  }
  vapply(unname(x), number, double(1))
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
    },
    if (x$damping_per_s != 0) paste("damping,", format_si(x$damping_per_s), "1/s"),
    if (x$drag_n_s_per_m != 0) paste("drag,", format_si(x$drag_n_s_per_m), "N s/m"),
    if (x$drag_n_s2_per_m2 != 0) paste("quadratic drag,", format_si(x$drag_n_s2_per_m2),
      "N s^2/m^2")
  )
  if (length(parts)) paste(parts, collapse = "; ") else "none"
}

#' @export
print.rot_resistance <- function(x, ...) {
  check_form(x, resistance_form, "x", "resistance", current_env())
  say("<rot_resistance> ", describe_resistance(x), "\n")
  invisible(x)
}
