#' Resistance to turning
#'
#' The torque that resists, as data. The viscous part is `-viscous_n_m_s * omega`.
#'
#' @param viscous_n_m_s Viscous coefficient in N m s (N m per rad/s), one finite number. A negative
#'   one drives: the torque then has the sign of omega, and the motion grows without bound.
#' @param quadratic_n_m_s2,coulomb_n_m,static_n_m Quadratic, sliding and static friction. This
#'   version does not have them yet: anything but 0 is an error of class `rotdyn_error_not_yet`.
#' @return A `rot_resistance`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` for what is not
#'   one finite number; `rotdyn_error_unit`; `rotdyn_error_not_yet`.
#' @examples
#' resistance(viscous_n_m_s = 0.03)
#' @export
resistance <- function(viscous_n_m_s = 0, quadratic_n_m_s2 = 0, coulomb_n_m = 0,
                       static_n_m = coulomb_n_m) {
  call <- rlang::current_env()
  viscous_n_m_s <- check_number(viscous_n_m_s, "viscous_n_m_s", "N*m*s", call)
  later <- c(
    quadratic_n_m_s2 = check_number(quadratic_n_m_s2, "quadratic_n_m_s2", "N*m*s^2", call),
    coulomb_n_m = check_number(coulomb_n_m, "coulomb_n_m", "N*m", call),
    static_n_m = check_number(static_n_m, "static_n_m", "N*m", call)
  )
  if (any(later != 0)) {
    abort_rotdyn(
      c(
        "{.arg {names(later)[later != 0]}} {?is/are} not modelled yet.",
        i = "This version has viscous resistance only. Any other law can be written as a
             {.fn torque_function} of angle and rate."
      ),
      "not_yet",
      call
    )
  }
  new_resistance(viscous_n_m_s)
}

new_resistance <- function(viscous_n_m_s) {
  x <- list(viscous_n_m_s = viscous_n_m_s)
  class(x) <- "rot_resistance"
  x
}

as_resistance <- function(x, call) {
  if (is.null(x)) {
    return(new_resistance(0))
  }
  check_class(
    x, "rot_resistance", "resistance",
    "Write {.code resistance(viscous_n_m_s = )}.", call
  )
  x
}

describe_resistance <- function(x) {
  if (x$viscous_n_m_s == 0) "none" else paste("viscous,", format_si(x$viscous_n_m_s), "N m s")
}

#' @export
print.rot_resistance <- function(x, ...) {
  cat("<rot_resistance> ", describe_resistance(x), "\n", sep = "")
  invisible(x)
}
