#' A moment of inertia that changes in time
#'
#' Piecewise linear between knots, constant outside; a repeated time is a jump. The torque changes
#' the angular momentum:
#' \deqn{\frac{d(I\omega)}{dt} = \tau}{d(I omega)/dt = torque}
#' The work of the change of inertia (a skater's arms) is in the [audit()]. In a [scene_axle()] it
#' replaces the body.
#'
#' @param time_s Times of the knots, finite and not decreasing, at least two.
#' @param moment_of_inertia_kg_m2 Moment of inertia about the axle at each, finite and > 0.
#' @param ... Not used: an unknown argument is an error.
#' @return A `rot_inertia_knots`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_time`, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 1.1: without
#'   torque I omega stays.
#' @seealso [scene_axle()], which takes it as a body; [moment_of_inertia()].
#' @concept skater
#' @concept changing moment of inertia
#' @concept figure skater
#' @concept conservation of angular momentum
#' @concept merry-go-round
#' @examples
#' skater <- inertia_knots(time_s = c(1, 2), moment_of_inertia_kg_m2 = c(5, 2))
#' scene <- scene_axle(skater, omega0_rad_per_s = 2)
#' trajectory(scene, time_s = 0:3)
#' @export
inertia_knots <- function(time_s, moment_of_inertia_kg_m2, ...) {
  call <- check_no_dots(...)
  check_supplied(c("time_s", "moment_of_inertia_kg_m2"), call)
  time_s <- check_finite(time_s, "time_s", "s", call)
  moment <- check_finite(moment_of_inertia_kg_m2, "moment_of_inertia_kg_m2", "kg*m^2", call)
  if (length(time_s) != length(moment) || length(time_s) < 2L) {
    abort_rotdyn(c(
      "Every knot needs a time and a moment of inertia, and there must be two at least.",
      x = "{.arg time_s} has length {length(time_s)}, {.arg moment_of_inertia_kg_m2} has length
           {length(moment)}."
    ), "size", call)
  }
  if (is.unsorted(time_s)) abort_rotdyn("{.arg time_s} must not go back in time.", "time", call)
  if (!is.finite(time_s[length(time_s)] - time_s[1])) {
    abort_rotdyn("The span of the knots is beyond double precision.", "value", call)
  }
  bad <- which(!(moment > 0))
  if (length(bad)) {
    abort_domain(moment[bad[1]], "moment_of_inertia_kg_m2", "kg*m^2", call, 0, Inf, TRUE)
  }
  x <- list(time_s = time_s, moment_of_inertia_kg_m2 = moment)
  class(x) <- "rot_inertia_knots"
  x
}

describe_inertia_knots <- function(x) {
  n <- length(x$time_s)
  paste0(
    "from ", format_si(x$moment_of_inertia_kg_m2[1]), " to ",
    format_si(x$moment_of_inertia_kg_m2[n]), " kg m^2, ", n, " knots from ", format_si(x$time_s[1]),
    " to ", format_si(x$time_s[n]), " s"
  )
}

#' @export
print.rot_inertia_knots <- function(x, ...) {
  check_form(x, inertia_knots_form, "x", "change of inertia", current_env())
  say("<rot_inertia_knots> ", describe_inertia_knots(x), "\n")
  invisible(x)
}
