# The normal form of a torque law, as the models read it.
#   knots      time_s, torque_n_m, outside: all constants, knots, steps, pulses and motors at rest
#   motor_n_m_s  slope of the motors' torque over omega, >= 0 where it falls
#   terms      the other terms, evaluated in C
#   law        one R function of them all, or NULL
torque_loads <- function(torque) {
  if (inherits(torque, "rot_torque_knots")) {
    return(list(knots = torque, motor_n_m_s = 0, terms = list(), law = NULL))
  }
  laws <- if (inherits(torque, "rot_torque_sum")) torque$laws else list(torque)
  is <- function(class) laws[vapply(laws, inherits, logical(1), class)]
  motors <- is("rot_torque_motor")
  stall <- lapply(motors, function(m) new_knots(double(), double(), rep(m$stall_torque_n_m, 2L)))
  list(
    knots = add_knots(c(is("rot_torque_knots"), stall)),
    motor_n_m_s = sum(
      vapply(motors, function(m) m$stall_torque_n_m / m$no_load_omega_rad_per_s, double(1))
    ),
    terms = is("rot_torque_term"),
    law = add_functions(is("rot_torque_function"))
  )
}

new_knots <- function(time_s, torque_n_m, outside) {
  torque <- list(time_s = time_s, torque_n_m = torque_n_m, outside = outside)
  class(torque) <- c("rot_torque_knots", "rot_torque")
  torque
}

# The sum is piecewise linear between the knots of all laws. Values before and after each knot are
# added separately, so that jumps stay jumps.
add_knots <- function(laws) {
  if (length(laws) == 0L) return(new_knots(double(), double(), c(0, 0)))
  if (length(laws) == 1L) return(laws[[1]])
  times <- sort(unique(unlist(lapply(laws, function(law) law$time_s))))
  outside <- exact_total(lapply(laws, function(law) law$outside))
  if (length(times) == 0L) return(new_knots(double(), double(), outside))
  total <- total_sides(laws, times)
  n <- length(times)
  # A value held outside needs no knot; where the torque ends, its last value is kept.
  before <- c(FALSE, rep(TRUE, n - 1L))
  after <- total[, 1] != total[, 2] | !before
  if (n > 1L && outside[2] == 0) after[n] <- FALSE
  keep <- rbind(before, after)
  new_knots(rep(times, each = 2L)[keep], t(total)[keep], outside)
}

# Two columns: the sum of the laws just before and just after each time. A law that is zero outside
# its knots adds to no other time: torque_pulse(seq_len(4000), 0.5, 1) takes 0.8 s, not 6.4 s.
total_sides <- function(laws, times) {
  n <- length(times)
  sum <- rest <- double(2L * n)
  for (law in laws) {
    at <- seq_len(n)
    if (length(law$time_s) && all(law$outside == 0)) {
      ends <- match(range(law$time_s), times)
      at <- seq(ends[1], ends[2])
    }
    x <- as.vector(knot_sides(law, times[at]))
    at <- c(at, at + n)
    step <- add_exactly(sum[at], x)
    sum[at] <- step$sum
    rest[at] <- rest[at] + step$rest
  }
  matrix(if (all(is.finite(rest))) sum + rest else sum, n, 2L)
}

# Knuth's two-sum.
add_exactly <- function(a, b) {
  sum <- a + b
  far <- sum - a
  list(sum = sum, rest = (a - (sum - far)) + (b - far))
}

# Compensated sum (Neumaier): 1e16 + 1 - 1e16 is 1.
exact_total <- function(parts) {
  sum <- parts[[1]]
  rest <- 0 * sum
  for (x in parts[-1]) {
    step <- add_exactly(sum, x)
    sum <- step$sum
    rest <- rest + step$rest
  }
  if (all(is.finite(rest))) sum + rest else sum
}

# Two columns: the torque just before and just after each time.
knot_sides <- function(law, times) {
  t <- law$time_s
  tau <- law$torque_n_m
  n <- length(t)
  if (n == 0L) return(matrix(law$outside[1], length(times), 2L))
  first <- findInterval(times, t, left.open = TRUE) + 1L # the first knot at or after
  last <- findInterval(times, t) # the last knot at or before
  line <- function(i) { # between knots i and i + 1
    width <- t[i + 1L] - t[i]
    mean <- tau[i] * ((t[i + 1L] - times) / width) + tau[i + 1L] * ((times - t[i]) / width)
    # The two shares are 1 within rounding: a level would become a slope of one unit of it.
    ifelse(tau[i] == tau[i + 1L], tau[i], mean)
  }
  on_knot <- first <= n & t[pmin(first, n)] == times
  inside <- !on_knot & last >= 1L & last < n
  between <- double(length(times))
  between[inside] <- line(pmin(pmax(last, 1L), n - 1L))[inside]
  out <- ifelse(last == 0L, law$outside[1], ifelse(last >= n, law$outside[2], between))
  before <- ifelse(on_knot, ifelse(first == 1L, law$outside[1], tau[pmin(first, n)]), out)
  after <- ifelse(on_knot, ifelse(last == n, law$outside[2], tau[pmax(last, 1L)]), out)
  cbind(before, after)
}

# The sum of several R functions is one; it needs the state if one of them does.
add_functions <- function(laws) {
  if (length(laws) < 2L) return(if (length(laws)) laws[[1]])
  of_state <- vapply(laws, function(law) law$arguments == 3L, logical(1))
  parts <- lapply(laws, function(law) law$f)
  f <- if (any(of_state)) {
    function(time_s, theta_rad, omega_rad_per_s) {
      total <- 0
      for (i in seq_along(parts)) {
        total <- total + if (of_state[i]) {
          parts[[i]](time_s, theta_rad, omega_rad_per_s)
        } else {
          parts[[i]](time_s)
        }
      }
      total
    }
  } else {
    function(time_s) Reduce(`+`, lapply(parts, function(part) part(time_s)))
  }
  given <- lapply(laws, function(law) law$breaks_s)
  breaks <- if (!any(vapply(given, is.null, logical(1)))) sort(unique(as.double(unlist(given))))
  new_torque(
    "rot_torque_function",
    f = f, breaks_s = breaks, arguments = if (any(of_state)) 3L else 1L,
    vectorised = all(vapply(laws, function(law) law$vectorised, logical(1)))
  )
}

#' @export
Ops.rot_torque <- function(e1, e2) {
  call <- rlang::caller_env()
  is_law <- function(x) inherits(x, "rot_torque")
  unsupported <- function() {
    abort_rotdyn(c(
      "{.code {(.Generic)}} is not defined for torque laws.",
      i = "They add up, and a number multiplies them."
    ), "type", call)
  }
  if (missing(e2)) {
    e1 <- as_torque(e1, call)
    return(switch(.Generic, `+` = e1, `-` = scale_torque(e1, -1, call), unsupported()))
  }
  if (.Generic %in% c("+", "-")) {
    e1 <- as_torque(e1, call)
    e2 <- as_torque(e2, call)
    return(sum_torques(e1, if (.Generic == "-") scale_torque(e2, -1, call) else e2))
  }
  if (.Generic == "*" && !(is_law(e1) && is_law(e2))) {
    law <- as_torque(if (is_law(e1)) e1 else e2, call)
    return(scale_torque(law, check_number(if (is_law(e1)) e2 else e1, "factor", "1", call), call))
  }
  if (.Generic == "/" && is_law(e1) && !is_law(e2)) {
    e1 <- as_torque(e1, call)
    factor <- 1 / check_number(e2, "divisor", "1", call)
    if (!is.finite(factor)) {
      abort_rotdyn("A torque law cannot be divided by {format(e2)}.", "value", call)
    }
    return(scale_torque(e1, factor, call))
  }
  unsupported()
}

# sum() of laws is a law; other summaries are errors.
#' @export
Summary.rot_torque <- function(..., na.rm = FALSE) {
  call <- rlang::caller_env()
  if (.Generic != "sum") {
    abort_rotdyn(c(
      "{.fn {(.Generic)}} is not defined for torque laws.",
      i = "They add up: {.fn sum}, or {.code +}."
    ), "type", call)
  }
  do.call(sum_torques, lapply(list(...), as_torque, call = call))
}

sum_torques <- function(...) {
  laws <- list(...)
  flat <- lapply(laws, function(law) if (inherits(law, "rot_torque_sum")) law$laws else list(law))
  new_torque("rot_torque_sum", laws = unlist(flat, recursive = FALSE))
}

scale_torque <- function(law, factor, call) {
  if (inherits(law, "rot_torque_sum")) {
    law$laws <- lapply(law$laws, scale_torque, factor, call)
  } else if (inherits(law, "rot_torque_knots")) {
    law$torque_n_m <- 0 + factor * law$torque_n_m # no -0
    law$outside <- 0 + factor * law$outside
  } else if (inherits(law, "rot_torque_motor")) {
    if (factor < 0) {
      abort_rotdyn(c(
        "A motor cannot be multiplied by {format(factor)}: its torque would rise with its speed.",
        i = "One that turns the other way is
             {.code torque_motor({format_si(factor * law$stall_torque_n_m)},
             {format_si(-law$no_load_omega_rad_per_s)})}."
      ), "value", call)
    }
    law$stall_torque_n_m <- 0 + factor * law$stall_torque_n_m
  } else if (inherits(law, "rot_torque_term")) {
    law <- scale_term(law, factor, call)
  } else {
    f <- law$f
    law$f <- if (law$arguments == 3L) {
      function(time_s, theta_rad, omega_rad_per_s) factor * f(time_s, theta_rad, omega_rad_per_s)
    } else {
      function(time_s) factor * f(time_s)
    }
  }
  numbers <- unlist(unclass(law)[c("torque_n_m", "outside", "stall_torque_n_m", "x")])
  if (!all(is.finite(c(factor, numbers)))) {
    abort_rotdyn(
      "The torque multiplied by {format(factor)} is beyond double precision.", "value", call
    )
  }
  law
}

# Torque i + 1 holds from time i on.
torque_steps_of <- function(torque, arg, call) {
  refuse <- function() {
    abort_rotdyn(c(
      "{.arg {arg}} must be constant between jumps.",
      x = "It is {describe_torque(torque)}.",
      i = "A jump is two knots at one time, as in
           {.code torque_knots(c(0, 2, 2, 5), c(30, 30, -10, -10))}."
    ), "torque", call)
  }
  loads <- torque_loads(torque)
  if (length(loads$terms) || !is.null(loads$law) || loads$motor_n_m_s != 0) refuse()
  time <- loads$knots$time_s
  value <- loads$knots$torque_n_m
  n <- length(time)
  outside <- loads$knots$outside
  if (n == 0L) return(list(time_s = double(), torque_n_m = outside[1]))
  distinct <- which(diff(time) > 0)
  if (any(value[distinct] != value[distinct + 1L])) refuse()
  list(time_s = time[c(distinct, n)], torque_n_m = c(outside[1], value[distinct], outside[2]))
}
