# Values of torque laws at many times, angles or rates, without a scene.

# What a law depends on.
law_variable <- function(law) {
  if (inherits(law, "rot_torque_motor")) return("omega")
  if (!inherits(law, "rot_torque_term")) return("time")
  switch(law$kind, curve = "omega", spring = , gravity = "theta", "time")
}

# The law at many values of its variable: knots after a jump, terms as src/core/engine/term.h has
# them.
law_values <- function(law, at, call) {
  if (inherits(law, "rot_torque_knots")) return(knot_sides(law, at)[, 2L])
  if (inherits(law, "rot_torque_motor")) {
    return(law$stall_torque_n_m * (1 - at / law$no_load_omega_rad_per_s))
  }
  if (inherits(law, "rot_torque_function")) {
    return(vapply(at, function(t) {
      value <- if (law$arguments == 3L) law$f(t, 0, 0) else law$f(t)
      value <- if (length(value) == 1L) check_torques(value, 1L, call) else NA
      if (!is.finite(value)) abort_torque_value(value, t, call)
      value
    }, double(1)))
  }
  x <- law$x
  value <- switch(law$kind,
    sinusoid = x[1] * cos(x[2] * at + x[3]),
    exponential = x[1] * exp(-x[2] * (at - x[3])),
    polynomial = polynomial_values(x, at),
    curve = {
      n <- x[1]
      stats::approx(x[2:(n + 1)], x[(n + 2):(2 * n + 1)], at, rule = 2)$y
    },
    spring = -x[1] * (at - x[2]),
    gravity = -x[1] * sin(at - x[2])
  )
  if (law_variable(law) == "time") value[at < law$from_s | at >= law$to_s] <- 0
  value
}

polynomial_values <- function(x, at) {
  n <- x[1]
  degree <- x[2]
  breaks <- x[2 + seq_len(n + 1)]
  a <- matrix(x[-seq_len(n + 3)], n, degree, byrow = TRUE)
  piece <- findInterval(at, breaks)
  inside <- piece >= 1 & piece <= n
  value <- double(length(at))
  since <- at[inside] - breaks[piece[inside]]
  for (j in rev(seq_len(degree))) value[inside] <- value[inside] * since + a[piece[inside], j]
  value
}

breaks_of_law <- function(law) {
  own <- if (inherits(law, "rot_torque_knots")) law$time_s else law$breaks_s
  as.double(own[is.finite(own)])
}

# Of a law or a sum of laws that depends on the time alone.
torque_of_time <- function(torque, time_s) {
  sum(vapply(laws_of(torque), law_values, double(1), time_s, NULL))
}

laws_of <- function(torque) if (inherits(torque, "rot_torque_sum")) torque$laws else list(torque)

breaks_of_torque <- function(torque) unlist(lapply(laws_of(torque), breaks_of_law))

torque_is_constant <- function(torque) {
  inherits(torque, "rot_torque_knots") && !length(torque$time_s)
}

check_law_of_time <- function(torque, arg, call) {
  for (law in laws_of(torque)) {
    state <- law_variable(law) != "time" ||
      (inherits(law, "rot_torque_function") && law$arguments == 3L)
    if (state) {
      abort_rotdyn(c(
        "{.arg {arg}} must be a law of the time alone.",
        x = "It is {describe_torque(law)}.",
        i = "A torque that depends on the state is a function of {.code time_s}, and of
             {.code omega_rad_per_s} and {.code attitude} of the body."
      ), "torque", call)
    }
  }
  invisible(torque)
}
