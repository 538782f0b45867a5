# A torque law as data. Knots: time_s, torque_n_m, outside = c(before, after). A function: f,
# breaks_s (NULL: not given), arguments (1 or 3), vectorised. A sum: laws. The others are in
# torque-terms.R.
new_torque <- function(class, ...) {
  torque <- list(...)
  class(torque) <- c(class, "rot_torque")
  torque
}

#' Torque laws
#'
#' A torque law is data and includes its breakpoints, so that no model steps over one; all but
#' `torque_function()` are evaluated in C. Laws add up: `torque_constant(1) + torque_knots(...)`.
#' The laws that have a formula are in [torque-terms].
#'
#' * `torque_constant()`: the same torque at all times.
#' * `torque_knots()`: straight lines between knots. A repeated time is a jump; at the jump itself
#'   the law has the value after it. **Outside the knots the torque is zero**: nothing is known to
#'   act there. `outside = "hold"` holds the first and the last value instead.
#' * `torque_function()`: any R function of `time_s`, or of `time_s, theta_rad, omega_rad_per_s`.
#'   It is called with one number each and returns one number. `vectorised = TRUE` says that it also
#'   takes vectors of equal length and returns one number for each element: then it is called once
#'   wherever many values are wanted. Jumps and kinks in time belong in `breaks_s`: steps end there.
#'   Where they are not given, a function of time is called at `r scan_points_of(law_resolution)`
#'   times (`r scan_points_vectorised` if it is vectorised), jumps and kinks between them are
#'   bisected, and [trajectory()] warns of them (class `rotdyn_warning_breaks`). `breaks_s =
#'   numeric()` says that there are none. A function of the angle and the rate is called along the
#'   motion that was found; where it is not what the steps believed, they are chosen anew, with ends
#'   at jumps and kinks in time, in the angle or in the rate, so that `-0.5 * sign(omega_rad_per_s)`
#'   stops a body and holds it. A change narrower than `resolution` (see [trajectory()]) may be
#'   missed, unless it lies at one of the `breaks_s`.
#'
#' A function of time alone is sampled some 30 to 300 times, one of angle and rate is called at each
#' evaluation of the integrator. The calls of the scan are counted in `rhs_calls`.
#'
#' Positive torque turns in the positive sense of the axle (right hand).
#'
#' @param torque_n_m Torque: one number, or one for each knot. Finite.
#' @param time_s Times of the knots, finite and not decreasing; or a data frame with the columns
#'   `time_s` and `torque_n_m`.
#' @param outside `"zero"` or `"hold"`: the torque before the first and after the last knot.
#' @param f A function that returns one finite number in N m.
#' @param breaks_s Times where `f` may jump or kink; NULL: not known.
#' @param vectorised Does `f` take vectors and return one number for each element? Type and length
#'   of what it returns are checked; that the numbers are those of single calls is not.
#' @param ... Not used; names after it must be given in full.
#' @return A `rot_torque`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size` and `rotdyn_error_value` for what is
#'   not finite numbers of one length, `rotdyn_error_time` for knots that go back in time,
#'   `rotdyn_error_unit`. What `f` returns is checked when it is called: `rotdyn_error_torque`;
#'   `rotdyn_error_random` if two calls with the same arguments differ, as of a law that draws
#'   random numbers.
#' @seealso [torque-terms] for motors, springs, gravity and sinusoids; [scene_axle()],
#'   [torque_of_force()], [autoplot.rot_torque()].
#' @concept moment of force
#' @concept motor
#' @concept power
#' @concept torque
#' @concept pulse
#' @examples
#' torque_knots(time_s = c(0, 1, 4, 6, 8), torque_n_m = c(0, 0.8, 0.8, 0, 0))
#' torque_knots(c(50, 50.02), c(40, 40)) # a pulse, nothing before and after
#' torque_function(function(time_s) sin(3 * time_s), breaks_s = numeric())
#' torque_function(function(time_s, theta_rad, omega_rad_per_s) -2 * sin(theta_rad))
#' @name torque
NULL

#' @rdname torque
#' @export
torque_constant <- function(torque_n_m, ...) {
  call <- check_no_dots(...)
  if (missing(torque_n_m)) check_supplied("torque_n_m", call)
  torque_n_m <- check_number(torque_n_m, "torque_n_m", "N*m", call)
  new_knots(double(), double(), c(torque_n_m, torque_n_m))
}

#' @rdname torque
#' @export
torque_knots <- function(time_s, torque_n_m, ..., outside = c("zero", "hold")) {
  call <- environment()
  if (missing(time_s)) check_supplied("time_s", call)
  check_no_dots(...)
  if (missing(outside)) {
    outside <- "zero"
  } else {
    check_string(outside, "outside", c("zero", "hold"), call)
  }
  if (is.object(time_s) && is.data.frame(time_s) && missing(torque_n_m)) {
    for (column in c("torque_n_m", "time_s")) {
      if (is.null(time_s[[column]])) abort_missing_column(column, time_s, call)
    }
    torque_n_m <- time_s[["torque_n_m"]]
    time_s <- time_s[["time_s"]]
  }
  if (missing(torque_n_m)) check_supplied("torque_n_m", call)
  time_s <- check_finite(time_s, "time_s", "s", call)
  torque_n_m <- check_finite(torque_n_m, "torque_n_m", "N*m", call)
  n <- length(time_s)
  if (length(torque_n_m) != n) {
    abort_rotdyn(c(
      "Every knot needs a time and a torque.",
      x = "{.arg time_s} has length {n}, {.arg torque_n_m} has length {length(torque_n_m)}."
    ), "size", call)
  }
  if (n < 2L) {
    abort_rotdyn(c(
      "A piecewise-linear torque needs at least two knots.",
      x = "There {?is/are} {n}.",
      i = "The same torque at all times is {.fn torque_constant}."
    ), "size", call)
  }
  if (is.unsorted(time_s)) {
    at <- which(diff(time_s) < 0)[1]
    abort_rotdyn(c(
      "Knots must not go back in time.",
      x = "Knot {at + 1} is at {format(time_s[at + 1])} s, after one at {format(time_s[at])} s.",
      i = "Two knots at the same time make a jump."
    ), "time", call)
  }
  if (!is.finite(time_s[n] - time_s[1])) {
    abort_rotdyn("The span of the knots is beyond double precision.", "value", call)
  }
  new_knots(time_s, torque_n_m, if (outside == "hold") torque_n_m[c(1L, n)] else c(0, 0))
}

#' @rdname torque
#' @export
torque_function <- function(f, breaks_s = NULL, vectorised = FALSE, ...) {
  call <- check_no_dots(...)
  if (missing(f)) check_supplied("f", call)
  new_torque_function(f, breaks_s, vectorised, call)
}

new_torque_function <- function(f, breaks_s, vectorised, call, arg = "f") {
  if (!is.function(f)) {
    abort_rotdyn(c(
      "{.arg f} must be a function.",
      x = "It is {describe_value(f)}.",
      i = "A constant torque is {.fn torque_constant}, a tabulated one {.fn torque_knots}."
    ), "type", call)
  }
  if (!is.null(breaks_s)) breaks_s <- sort(unique(check_finite(breaks_s, "breaks_s", "s", call)))
  if (!isTRUE(vectorised) && !isFALSE(vectorised)) {
    abort_rotdyn(c(
      "{.arg vectorised} must be TRUE or FALSE.",
      x = "It is {describe_value(vectorised)}."
    ), "type", call)
  }
  new_torque(
    "rot_torque_function",
    f = f, breaks_s = breaks_s, arguments = count_arguments(f, arg, call), vectorised = vectorised
  )
}

# 1: f(time_s). 3: f(time_s, theta_rad, omega_rad_per_s). Arguments with a default are f's own.
count_arguments <- function(f, arg, call) {
  check_law_order(f, c("time_s", "theta_rad", "omega_rad_per_s"), arg, "torque", call)
  count_law_arguments(f, function(n) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a function of {.code time_s}, or of
       {.code time_s, theta_rad, omega_rad_per_s}.",
      x = "It has {n} argument{?s} without a default."
    ), "torque", call)
  })
}

# The torque argument of a scene as a law.
as_torque <- function(x, call, arg = "torque") {
  if (inherits(x, "rot_torque")) {
    check_form(x, torque_form, arg, "torque law", call)
  } else if (is.null(x)) {
    torque_constant(0)
  } else if (is.function(x)) {
    new_torque_function(x, NULL, FALSE, call, arg)
  } else if (is.numeric(x)) {
    torque_constant(check_number(x, arg, "N*m", call))
  } else {
    abort_rotdyn(c(
      "{.arg {arg}} must be a torque law, a function, or one number in N m.",
      x = "It is {describe_value(x)}.",
      i = if (inherits(x, c("rot_resistance", "rot_brake"))) resistance_remedy(x) else
        "Laws are {.fn torque_constant}, {.fn torque_knots} and others that begin with
         {.code torque_}."
    ), "type", call)
  }
}

torque_is_zero <- function(torque) {
  inherits(torque, "rot_torque_knots") &&
    all(.subset2(torque, "outside") == 0) && all(.subset2(torque, "torque_n_m") == 0)
}

# What no law at all is, too.
torque_is_none <- function(torque) {
  torque_is_zero(torque) && !length(.subset2(torque, "time_s"))
}

# The law in one line.
describe_torque <- function(torque) {
  if (inherits(torque, "rot_torque_sum")) {
    laws <- vapply(torque$laws, describe_torque, character(1))
    return(paste(laws, collapse = "\n              + "))
  }
  if (inherits(torque, "rot_torque_term")) return(torque$text)
  if (inherits(torque, "rot_torque_motor")) {
    return(paste0(
      "a motor, ", format_si(torque$stall_torque_n_m), " N m at rest, nothing at ",
      format_si(torque$no_load_omega_rad_per_s), " rad/s"
    ))
  }
  if (inherits(torque, "rot_torque_function")) {
    breaks <- if (is.null(torque$breaks_s)) {
      "breaks not given"
    } else {
      n <- length(torque$breaks_s)
      paste(n, if (n == 1L) "break" else "breaks")
    }
    return(paste0(
      "an R function of ", if (torque$arguments == 3L) "time, angle and rate" else "time",
      ", in N m (", breaks, ")"
    ))
  }
  n <- length(torque$time_s)
  if (n == 0L) return(paste("constant,", format_si(torque$outside[1]), "N m"))
  jumps <- sum(diff(torque$time_s) == 0)
  outside <- if (all(torque$outside == 0)) "zero" else "held"
  paste0(
    "straight lines between ", n, " knots from ", format_si(torque$time_s[1]), " to ",
    format_si(torque$time_s[n]), " s",
    if (jumps) paste0(", ", jumps, if (jumps == 1) " jump" else " jumps"), ", ",
    paste(unique(format_si(range(torque$torque_n_m))), collapse = " to "), " N m, ",
    outside, " outside"
  )
}

#' @export
print.rot_torque <- function(x, ...) {
  check_form(x, torque_form, "x", "torque law", current_env())
  say("<rot_torque> ", describe_torque(x), "\n")
  invisible(x)
}

# Of a resistance, or a brake of a drive, in the place of something else.
resistance_remedy <- function(x) {
  if (inherits(x, "rot_brake")) {
    "A brake that drags all the time is {.code resistance = resistance(coulomb_n_m = )};
     one that is applied and let go is {.code brake = brake(...)}, of an axle, gears, rotors, a
     clutch or a drive."
  } else {
    "What resists is given by name: {.code resistance = resistance(...)}."
  }
}
