# Torque laws that are not piecewise linear in time: one term each, as src/core/engine/term.h
# evaluates it. The kinds have the names there.
new_term <- function(kind, x, text, from_s = -Inf, to_s = Inf, breaks_s = c(from_s, to_s)) {
  new_torque(
    "rot_torque_term",
    kind = kind, from_s = as.double(from_s), to_s = as.double(to_s), x = as.double(x), text = text,
    breaks_s = breaks_s[is.finite(breaks_s)]
  )
}

# The term with its torque multiplied by a factor: what its constructor makes of the product, so
# that it has the same words and R code. A spring and a weight that no constructor makes keep their
# kind.
scale_term <- function(term, factor, call) {
  x <- term$x
  at <- switch(term$kind,
    polynomial = seq(4 + x[1], length(x)),
    curve = seq(2 + x[1], length(x)),
    1L
  )
  term$x[at] <- 0 + factor * x[at] # no -0
  if (!all(is.finite(term$x))) return(term)
  if (term$kind == "gravity") return(scale_gravity(term, factor, call))
  if (term$kind == "spring") return(spring_law(term$x[1], x[2]))
  x <- term$x
  n <- x[1]
  switch(term$kind,
    sinusoid = torque_sinusoid(x[1], x[2], x[3], from_s = term$from_s, to_s = term$to_s),
    exponential = torque_exponential(x[1], x[2], from_s = term$from_s, to_s = term$to_s),
    polynomial = torque_polynomial(
      x[2 + seq_len(n + 1)], matrix(x[-seq_len(n + 3)], n, byrow = TRUE)
    ),
    curve = torque_curve(x[1 + seq_len(n)], x[1 + n + seq_len(n)])
  )
}

# Of a text older than its parts: the product alone.
scale_gravity <- function(term, factor, call) {
  of <- term$parts
  if (!is.null(of)) return(gravity_law(of[1], of[2], factor * of[3], term$x[2], call))
  x <- term$x
  x[c(1, 3)] <- .Call(ffi_sum_product, factor * x[3], x[1])
  new_term("gravity", x, gravity_text(x))
}

# c(from, to) in s; either may be infinite.
check_window <- function(from_s, to_s, call) {
  window <- c(check_end(from_s, "from_s", call), check_end(to_s, "to_s", call))
  if (!(window[1] < window[2])) {
    abort_rotdyn(c(
      "{.arg from_s} must lie before {.arg to_s}.",
      x = "They are {format(window[1])} and {format(window[2])} s."
    ), "time", call)
  }
  window
}

check_end <- function(x, arg, call) {
  if (is.object(x)) x <- as_si(x, "s", arg, call)
  if (!is_number(x) || is.object(x) || length(x) != 1L || is.na(x)) {
    abort_rotdyn(
      c("{.arg {arg}} must be one time in s.", x = "It is {describe_value(x)}."), "type", call
    )
  }
  as.double(x)
}

window_text <- function(from_s, to_s) {
  if (is.finite(from_s) && is.finite(to_s)) {
    paste0(", from ", format_si(from_s), " to ", format_si(to_s), " s")
  } else if (is.finite(from_s)) {
    paste0(", from ", format_si(from_s), " s on")
  } else if (is.finite(to_s)) {
    paste0(", until ", format_si(to_s), " s")
  } else {
    ""
  }
}

#' Torque laws by formula
#'
#' Laws that are evaluated in C, know their breakpoints, and add up: `torque_motor(2, 300) +
#' torque_sinusoid(0.1, 20)` is a law too, and so is `0.5 * torque_motor(2, 300)`. Where nothing but
#' viscous resistance acts besides, sums of constants, knots, steps, pulses, polynomials, sinusoids,
#' exponentials and linear motors are solved in closed form.
#'
#' * `torque_steps()`: `torque_n_m[i]` from `time_s[i]` until the next; 0 before the first; the last
#'   one stays.
#' * `torque_pulse()`: `torque_n_m` for `duration_s` from `start_s` on. Several pulses add up.
#' * `torque_polynomial()`: in piece `i`, from `breaks_s[i]` to `breaks_s[i + 1]`,
#'   `sum_j coefficients[i, j + 1] (t - breaks_s[i])^j`; 0 outside.
#' * `torque_sinusoid()`: `amplitude_n_m cos(angular_frequency_rad_per_s t + phase_rad)`.
#' * `torque_exponential()`: `torque_n_m exp(-decay_per_s (t - from_s))`, 0 before `from_s`.
#' * `torque_motor()`: `stall_torque_n_m (1 - omega / no_load_omega_rad_per_s)`, the straight
#'   torque-speed line of a direct-current motor.
#' * `torque_curve()`: linear between points of a measured torque-speed curve, constant outside.
#' * `torque_spring()`: `-stiffness_n_m_per_rad (theta - rest_rad)`.
#' * `torque_gravity()`: `-mass g distance sin(theta - rest_rad)`, the weight of a body whose centre
#'   of mass hangs `distance_m` from the axle. ([scene_pendulum()] also sets the moment of inertia
#'   about the axle.)
#'
#' @param time_s Times of the steps, finite and increasing.
#' @param torque_n_m Torque: one number for each step, pulse or point of the curve; for
#'   `torque_exponential()` one number, at `from_s`.
#' @param start_s,duration_s When each pulse begins, and how long it lasts (> 0). A pulse shorter
#'   than the resolution of double precision at that time is an error.
#' @param breaks_s Ends of the pieces, finite and increasing: one more than there are pieces.
#' @param coefficients A matrix with one row for each piece, N m s^-j in column j + 1; or a vector
#'   for one piece.
#' @param amplitude_n_m,angular_frequency_rad_per_s,phase_rad Amplitude, angular frequency, and
#'   phase at the scene's time 0.
#' @param decay_per_s Rate of decay; negative grows.
#' @param stall_torque_n_m Torque at rest.
#' @param no_load_omega_rad_per_s Angular velocity at which the motor's torque is 0: not 0, of the
#'   sign of the stall torque.
#' @param omega_rad_per_s Angular velocities of the curve's points, finite and increasing.
#' @param stiffness_n_m_per_rad Torsional stiffness, > 0.
#' @param mass_kg,distance_m Mass, and distance of the centre of mass from the axle, both >= 0.
#' @param rest_rad Angle where the spring is relaxed, or where the body hangs straight down.
#' @param gravity_m_per_s2 Acceleration of gravity.
#' @param from_s,to_s The law acts from `from_s` on and before `to_s`.
#' @param ... Not used; names after it must be given in full.
#' @return A `rot_torque`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_time` (times not in order, a pulse too short), `rotdyn_error_unit`.
#' @seealso [torque] for constants, knots and R functions.
#' @concept power
#' @concept sinusoidal torque
#' @concept exponential torque
#' @concept spring
#' @concept motor torque
#' @examples
#' torque_steps(c(0, 2, 5), c(0.8, 0.3, 0))
#' torque_polynomial(c(0, 1), c(0, 0, 3)) # 3 t^2 for a second
#' torque_motor(2, 300) + torque_sinusoid(0.1, 20)
#' torque_gravity(mass_kg = 1, distance_m = 0.5)
#' @name torque-terms
NULL

#' @rdname torque-terms
#' @export
torque_steps <- function(time_s, torque_n_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("time_s", "torque_n_m"), call)
  time_s <- check_increasing(time_s, "time_s", "s", call)
  torque_n_m <- check_finite(torque_n_m, "torque_n_m", "N*m", call)
  check_lengths(time_s, torque_n_m, call)
  n <- length(time_s)
  after <- seq_len(n)[-1]
  new_knots(
    c(time_s[1], rep(time_s[after], each = 2L)),
    c(torque_n_m[1], rbind(torque_n_m[after - 1L], torque_n_m[after])),
    c(0, torque_n_m[n])
  )
}

#' @rdname torque-terms
#' @export
torque_pulse <- function(start_s, duration_s, torque_n_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("start_s", "duration_s", "torque_n_m"), call)
  columns <- list(
    start_s = check_finite(start_s, "start_s", "s", call),
    duration_s = check_finite(duration_s, "duration_s", "s", call),
    torque_n_m = check_finite(torque_n_m, "torque_n_m", "N*m", call)
  )
  n <- check_recyclable(columns, call)
  columns <- lapply(columns, rep_len, n)
  bad <- which(!(columns$duration_s > 0))
  if (length(bad)) abort_domain(columns$duration_s[bad[1]], "duration_s", "s", call, 0, Inf, TRUE)
  end <- columns$start_s + columns$duration_s
  # The rounded duration is 0, or wrong by more than a thousandth.
  short <- which(!(abs((end - columns$start_s) - columns$duration_s) <= 1e-3 * columns$duration_s))
  if (length(short)) {
    i <- short[1]
    abort_rotdyn(c(
      "A pulse of {format(columns$duration_s[i])} s at {format(columns$start_s[i])} s is shorter
       than double precision resolves there.",
      i = "Its impulse, {format(columns$duration_s[i] * columns$torque_n_m[i])} N m s, can be
           given as a change of {.arg omega0_rad_per_s}; or start the scene closer to it."
    ), "time", call)
  }
  pulses <- lapply(seq_len(n), function(i) {
    one_pulse(columns$start_s[i], columns$duration_s[i], end[i], columns$torque_n_m[i])
  })
  add_knots(pulses)
}

# Where the end is rounded, the last unit of it in time carries what that takes from the impulse or
# adds to it: before, the torque is as given, and after it the impulse.
one_pulse <- function(start, duration, end, torque) {
  of_duration <- end - start
  lost <- (start - (end - of_duration)) + (duration - of_duration) # Knuth's two-sum
  if (abs(lost) <= 4 * .Machine$double.eps * duration) {
    return(new_knots(c(start, end), rep(torque, 2L), c(0, 0)))
  }
  before <- end - 2^(floor(log2(abs(end))) - 52)
  last <- torque * (1 + lost / (end - before))
  new_knots(c(start, before, before, end), rep(c(torque, last), each = 2L), c(0, 0))
}

#' @rdname torque-terms
#' @export
torque_polynomial <- function(breaks_s, coefficients, ...) {
  call <- check_no_dots(...)
  check_supplied(c("breaks_s", "coefficients"), call)
  breaks_s <- check_increasing(breaks_s, "breaks_s", "s", call)
  shape <- dim(coefficients)
  if (is.atomic(coefficients)) coefficients <- as.vector(coefficients)
  x <- check_finite(coefficients, "coefficients", "1", call)
  a <- if (is.null(shape)) matrix(x, nrow = 1L) else matrix(x, shape[1], shape[2])
  n <- length(breaks_s) - 1L
  if (nrow(a) != n || ncol(a) < 1L) {
    abort_rotdyn(c(
      "{.arg coefficients} must have one row for each piece.",
      x = "{.arg breaks_s} makes {n} piece{?s}, {.arg coefficients} has {nrow(a)} row{?s}."
    ), "size", call)
  }
  # Trailing zeros do not raise the degree.
  degree <- max(which(colSums(abs(a)) > 0), 1L)
  a <- a[, seq_len(degree), drop = FALSE]
  new_term(
    "polynomial", c(n, degree, breaks_s, t(a)),
    paste0(
      "polynomials of degree ", degree - 1L, " from ", format_si(breaks_s[1]), " to ",
      format_si(breaks_s[n + 1L]), " s, in N m"
    ),
    breaks_s = breaks_s
  )
}

#' @rdname torque-terms
#' @export
torque_sinusoid <- function(amplitude_n_m, angular_frequency_rad_per_s, phase_rad = 0, ...,
                            from_s = -Inf, to_s = Inf) {
  call <- current_env()
  check_supplied(c("amplitude_n_m", "angular_frequency_rad_per_s"), call)
  check_no_dots(...)
  window <- check_window(from_s, to_s, call)
  a <- check_number(amplitude_n_m, "amplitude_n_m", "N*m", call)
  f <- check_number(angular_frequency_rad_per_s, "angular_frequency_rad_per_s", "rad/s", call)
  phase <- check_number(phase_rad, "phase_rad", "rad", call)
  new_term(
    "sinusoid", c(a, f, phase),
    paste0(
      format_si(a), " cos(", format_si(f), " t",
      if (phase != 0) paste(if (phase < 0) " -" else " +", format_si(abs(phase))), ") N m",
      window_text(window[1], window[2])
    ),
    window[1], window[2]
  )
}

#' @rdname torque-terms
#' @export
torque_exponential <- function(torque_n_m, decay_per_s, ..., from_s = 0, to_s = Inf) {
  call <- current_env()
  check_supplied(c("torque_n_m", "decay_per_s"), call)
  check_no_dots(...)
  from_s <- check_number(from_s, "from_s", "s", call)
  window <- check_window(from_s, to_s, call)
  a <- check_number(torque_n_m, "torque_n_m", "N*m", call)
  rate <- check_number(decay_per_s, "decay_per_s", "1/s", call)
  new_term(
    "exponential", c(a, rate, from_s),
    paste0(
      format_si(a), if (rate < 0) " N m growing with " else " N m fading with ",
      format_si(abs(rate)), " /s", window_text(window[1], window[2])
    ),
    window[1], window[2]
  )
}

#' @rdname torque-terms
#' @export
torque_motor <- function(stall_torque_n_m, no_load_omega_rad_per_s, ...) {
  call <- check_no_dots(...)
  check_supplied(c("stall_torque_n_m", "no_load_omega_rad_per_s"), call)
  stall <- check_number(stall_torque_n_m, "stall_torque_n_m", "N*m", call)
  fast <- check_number(no_load_omega_rad_per_s, "no_load_omega_rad_per_s", "rad/s", call)
  slope <- stall / fast
  if (!is.finite(slope) || slope < 0) {
    abort_rotdyn(c(
      "A motor's torque must fall with its speed.",
      x = "The stall torque is {format(stall)} N m, the no-load speed {format(fast)} rad/s.",
      i = "Both must have the same sign, and the speed must not be 0."
    ), "value", call)
  }
  new_torque("rot_torque_motor", stall_torque_n_m = stall, no_load_omega_rad_per_s = fast)
}

#' @rdname torque-terms
#' @export
torque_curve <- function(omega_rad_per_s, torque_n_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("omega_rad_per_s", "torque_n_m"), call)
  omega <- check_increasing(omega_rad_per_s, "omega_rad_per_s", "rad/s", call)
  torque_n_m <- check_finite(torque_n_m, "torque_n_m", "N*m", call)
  check_lengths(omega, torque_n_m, call)
  n <- length(omega)
  new_term(
    "curve", c(n, omega, torque_n_m),
    paste0(
      "a torque-speed curve of ", n, " points from ", format_si(omega[1]), " to ",
      format_si(omega[n]), " rad/s, ",
      paste(unique(format_si(range(torque_n_m))), collapse = " to "), " N m"
    )
  )
}

#' @rdname torque-terms
#' @export
torque_spring <- function(stiffness_n_m_per_rad, rest_rad = 0, ...) {
  call <- check_no_dots(...)
  check_supplied("stiffness_n_m_per_rad", call)
  k <- check_number(
    stiffness_n_m_per_rad, "stiffness_n_m_per_rad", "N*m/rad", call, lower = 0, open = TRUE
  )
  rest <- check_number(rest_rad, "rest_rad", "rad", call)
  spring_law(k, rest)
}

# A stiffness below 0 is a spring multiplied by a number; without one there is no torque.
spring_law <- function(k, rest) {
  if (k == 0) return(new_knots(double(), double(), c(0, 0)))
  new_term("spring", c(k, rest), paste0(
    if (k < 0) "minus ", "a spring, ", format_si(abs(k)), " N m/rad about ", format_si(rest), " rad"
  ))
}

#' @rdname torque-terms
#' @export
torque_gravity <- function(mass_kg, distance_m, rest_rad = 0, ..., gravity_m_per_s2 = 9.80665) {
  call <- current_env()
  check_supplied(c("mass_kg", "distance_m"), call)
  check_no_dots(...)
  m <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  d <- check_number(distance_m, "distance_m", "m", call, lower = 0)
  g <- check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call)
  gravity_law(m, d, g, check_number(rest_rad, "rest_rad", "rad", call), call)
}

# `parts`: what the constructor makes it of again.
gravity_law <- function(m, d, g, rest, call) {
  largest <- .Call(ffi_sum_product, 0, c(m, d, g)) # over a long time its rounding counts
  if (!is.finite(largest[1])) {
    abort_rotdyn("The weight's torque is beyond double precision.", "value", call)
  }
  if (largest[1] == 0) return(new_knots(double(), double(), c(0, 0)))
  x <- c(largest[1], rest, largest[2])
  term <- new_term("gravity", x, gravity_text(x))
  term$parts <- c(m, d, g)
  term
}

gravity_text <- function(x) {
  paste0("gravity, at most ", format_si(abs(x[1])), " N m, hanging at ", format_si(x[2]), " rad")
}

check_lengths <- function(x, torque_n_m, call) {
  if (length(torque_n_m) != length(x)) {
    abort_rotdyn(c(
      "{.arg torque_n_m} must have one number for each point.",
      x = "There are {length(x)} points and {length(torque_n_m)} torques."
    ), "size", call)
  }
}

check_increasing <- function(x, arg, unit, call) {
  x <- check_finite(x, arg, unit, call)
  minimum <- if (arg == "breaks_s" || arg == "omega_rad_per_s") 2L else 1L
  if (length(x) < minimum) {
    abort_rotdyn(
      c("{.arg {arg}} must have at least {minimum} element{?s}.", x = "It has {length(x)}."),
      "size", call
    )
  }
  if (is.unsorted(x, strictly = TRUE)) {
    at <- which(diff(x) <= 0)[1]
    abort_rotdyn(
      c(
        "{.arg {arg}} must increase.",
        x = "Element {at + 1} is {format(x[at + 1])} after {format(x[at])}."
      ), if (unit == "s") "time" else "value", call
    )
  }
  x
}
