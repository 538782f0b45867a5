#' Angular impulse of a torque
#'
#' The time integral of a torque about an axis, and the change of the angular velocity that it gives
#' to a free body:
#' \deqn{H = \int \tau\,dt + \sum_i H_i,\quad \Delta\omega = H / I}{
#'   H = int tau dt + sum H_i,  Delta omega = H/I}
#' Constants, knots (sampled torques), steps, pulses, sinusoids, exponentials and polynomials are
#' integrated in closed form, R functions of time by quadrature with an estimate of its error.
#' Instantaneous torques are given by their angular impulses.
#'
#' @param torque A [torque] law, an R function of time, one number in N m, or a data frame with the
#'   columns `time_s` and `torque_n_m` (straight lines between the samples, 0 outside).
#' @param from_s,to_s The span: numbers of length 1 or n. An impulse in an instant counts from
#'   `from_s` on and before `to_s`. Infinite where the torque ends.
#' @param ... Not used; names after it must be given in full.
#' @param body A `rot_body` (its Izz counts), or the moment of inertia in kg m^2; NULL: no change of
#'   the angular velocity is given.
#' @param instants NULL, or a data frame of instantaneous torques with the columns `time_s` and
#'   `angular_impulse_n_m_s`.
#' @return A tibble, a row for each span: `r describe_columns(impulse_columns)`
#'   `angular_impulse_error_n_m_s` bounds the rounding of a closed form; with an R function it is an
#'   estimate. NA in a row gives NA. A span that ends before it begins has the negative impulse of
#'   the span turned round.
#' @section Errors: `rotdyn_error_torque` for a law that depends on the motion (motors, springs,
#'   gravity, functions of the state: their impulse is a term of [audit()]), and for an integral
#'   that is not finite: also of a function that grows as 1/time or faster towards a time in the
#'   span; `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`. A function with breaks
#'   that are not given warns, as in [torque_function()].
#' @source OpenStax, College Physics (2012), section 10.5; Halliday, Resnick and Walker,
#'   Fundamentals of Physics, section 11-7.
#' @seealso [audit()] for the impulses along a motion, [hinged_hit()], [collide()].
#' @concept impulse
#' @concept change of angular momentum
#' @concept torque
#' @concept angular momentum
#' @examples
#' # A foot kicks a lazy Susan: 2.50 N at 0.260 m for 0.150 s, a disk of 4.00 kg.
#' angular_impulse(
#'   torque_pulse(0, 0.150, 2.50 * 0.260), body = body_disk(4.00, 0.260)
#' )
#' angular_impulse(torque_sinusoid(3, 20), from_s = 0, to_s = c(0.1, 0.2, 0.3))
#' # A sampled torque and a blow:
#' samples <- data.frame(time_s = c(0, 0.1, 0.2, 0.3), torque_n_m = c(0, 4, 5, 0))
#' angular_impulse(
#'   samples, instants = data.frame(time_s = 0.15, angular_impulse_n_m_s = 0.2), body = 0.8
#' )
#' @export
angular_impulse <- function(torque, from_s = -Inf, to_s = Inf, ..., body = NULL, instants = NULL) {
  call <- current_env()
  check_supplied("torque", call)
  check_no_dots(...)
  law <- if (is.data.frame(torque)) {
    in_call(torque_knots(torque), call)
  } else {
    as_torque(torque, call)
  }
  loads <- torque_loads(law)
  check_of_time(loads, call)
  columns <- list(
    from_s = check_column(from_s, "from_s", "s", call), to_s = check_column(to_s, "to_s", "s", call)
  )
  n <- check_recyclable(columns, call)
  columns <- lapply(columns, rep_len, n)
  inertia <- if (!is.null(body)) one_inertia(body, "body", call)
  instants <- check_instants(instants, call)
  parts <- vapply(seq_len(n), function(i) {
    from <- columns$from_s[i]
    to <- columns$to_s[i]
    if (is.na(from) || is.na(to)) return(c(NA_real_, NA_real_))
    if (to < from) return(c(-1, 1) * impulse_between(loads, instants, to, from, call))
    impulse_between(loads, instants, from, to, call)
  }, numeric(2))
  out <- c(columns, list(
    angular_impulse_n_m_s = parts[1, ], angular_impulse_error_n_m_s = parts[2, ]
  ))
  if (!is.null(inertia)) out$omega_change_rad_per_s <- parts[1, ] / inertia
  warn_beyond(out["omega_change_rad_per_s"[!is.null(inertia)]], list(), n, call)
  new_table(out, nrow = n)
}

check_of_time <- function(loads, call) {
  kinds <- vapply(loads$terms, function(term) term$kind, "")
  words <- c(curve = "a torque-speed curve", spring = "a spring", gravity = "gravity")
  state <- c(
    if (loads$motor_n_m_s != 0) "a motor", unname(words[intersect(names(words), kinds)]),
    if (!is.null(loads$law) && loads$law$arguments == 3L) "a function of the state"
  )
  if (length(state)) {
    abort_rotdyn(c(
      "The angular impulse of a torque that depends on the motion needs the motion.",
      x = "{.arg torque} has {state}.",
      i = "Compute a {.fn trajectory}: {.fn audit} has the impulse of its torque."
    ), "torque", call)
  }
}

check_instants <- function(instants, call) {
  if (is.null(instants)) return(list(time_s = double(), angular_impulse_n_m_s = double()))
  if (!is.data.frame(instants)) {
    abort_rotdyn(c(
      "{.arg instants} must be a data frame of times and angular impulses.",
      x = "It is {describe_value(instants)}."
    ), "type", call)
  }
  units <- c(time_s = "s", angular_impulse_n_m_s = "N*m*s")
  lapply(stats::setNames(names(units), names(units)), function(column) {
    if (is.null(instants[[column]])) abort_missing_column(column, instants, call)
    check_finite(instants[[column]], column, units[[column]], call)
  })
}

# c(impulse, error) over from <= to.
impulse_between <- function(loads, instants, from, to, call) {
  eps <- .Machine$double.eps
  sums <- list(knots_impulse(loads$knots, from, to))
  for (term in loads$terms) {
    sums[[length(sums) + 1L]] <-
      term_impulse(term, max(from, term$from_s), min(to, term$to_s))
  }
  if (!is.null(loads$law)) sums[[length(sums) + 1L]] <- law_impulse(loads$law, from, to, call)
  inside <- instants$time_s >= from & instants$time_s < to
  sums[[length(sums) + 1L]] <- c(
    exact_total(c(list(0), as.list(instants$angular_impulse_n_m_s[inside]))), 0
  )
  values <- vapply(sums, `[`, double(1), 1L)
  total <- exact_total(as.list(values))
  error <- sum(vapply(sums, `[`, double(1), 2L)) + eps * abs(total)
  if (!is.finite(total) || is.nan(error)) {
    abort_rotdyn(c(
      "The torque has no finite angular impulse from {format(from)} to {format(to)} s.",
      i = if (!is.finite(to - from)) "Give a finite span, {.arg from_s} and {.arg to_s}." else
        "It is not finite in between: a time at which it is infinite is one of the {.arg breaks_s}
         of {.fn torque_function}."
    ), "torque", call)
  }
  c(total, error)
}

# Straight lines: the mean of the ends of each piece, within the span.
knots_impulse <- function(knots, from, to) {
  if (torque_is_zero(knots)) return(c(0, 0))
  t <- knots$time_s
  eps <- .Machine$double.eps
  if (!length(t)) return(c(1, 2 * eps * sign(knots$outside[1])) * knots$outside[1] * (to - from))
  ends <- pmin(pmax(t[c(1L, length(t))], from), to)
  outside <- function(torque, width) if (torque == 0 || width == 0) 0 else torque * width
  parts <- c(outside(knots$outside[1], ends[1] - from), outside(knots$outside[2], to - ends[2]))
  if (ends[2] > ends[1]) {
    i <- seq_len(length(t) - 1L)
    i <- i[t[i + 1L] > t[i] & t[i + 1L] > ends[1] & t[i] < ends[2]]
    lo <- pmax(t[i], ends[1])
    hi <- pmin(t[i + 1L], ends[2])
    line <- function(at) {
      width <- t[i + 1L] - t[i]
      knots$torque_n_m[i] * ((t[i + 1L] - at) / width) +
        knots$torque_n_m[i + 1L] * ((at - t[i]) / width)
    }
    first <- line(lo) * (hi - lo) / 2
    second <- line(hi) * (hi - lo) / 2
    parts <- c(parts, first, second)
  }
  total <- exact_total(as.list(parts))
  c(total, 6 * eps * sum(abs(parts)))
}

# Sinusoids, exponentials, polynomials; products, so that a short span loses no digits.
term_impulse <- function(term, from, to) {
  if (!(to > from)) return(c(0, 0))
  x <- term$x
  width <- to - from
  eps <- .Machine$double.eps
  switch(term$kind,
    sinusoid = if (is.finite(width)) .Call(ffi_sinusoid_impulse, x, from, to) else c(NaN, NaN),
    exponential = {
      z <- x[2] * width
      start <- x[1] * exp(-x[2] * (from - x[3]))
      value <- if (is.infinite(to) && x[2] > 0) start / x[2] else
        start * if (z == 0) width else -expm1(-z) / x[2]
      c(value, eps * abs(value) * (6 + 2 * abs(x[2]) * (abs(from) + abs(x[3]))))
    },
    polynomial = {
      n <- x[1]
      m <- x[2]
      breaks <- x[2 + seq_len(n + 1)]
      a <- matrix(x[-seq_len(n + 3)], n, m, byrow = TRUE)
      power <- seq_len(m)
      parts <- unlist(lapply(seq_len(n), function(i) {
        lo <- max(from, breaks[i]) - breaks[i]
        hi <- min(to, breaks[i + 1]) - breaks[i]
        if (hi > lo) c(a[i, ] * hi^power / power, -a[i, ] * lo^power / power)
      }))
      if (is.null(parts)) return(c(0, 0))
      c(exact_total(as.list(parts)), 2 * eps * (m + 4) * sum(abs(parts)))
    }
  )
}

# By panels between the breaks, given or found.
law_impulse <- function(law, from, to, call) {
  if (!(to > from)) return(c(0, 0))
  if (!is.finite(to - from)) {
    abort_rotdyn(c(
      "The angular impulse of an R function needs a finite span.",
      x = "The span is from {format(from)} to {format(to)} s.",
      i = "Give {.arg from_s} and {.arg to_s}."
    ), "torque", call)
  }
  reader <- law_reader(law, list(theta0_rad = 0, omega0_rad_per_s = 0), call)
  stops <- law_breaks(law, reader$at, from, to, call)$stops
  edges <- unique(c(from, stops[stops > from & stops < to], to))
  # Eight panels between two breaks: a pulse that one rule would step over is smaller than these.
  edges <- unique(unlist(Map(function(a, b) seq(a, b, length.out = 9L), edges[-length(edges)],
                             edges[-1])))
  n <- length(edges)
  f <- function(t) cbind(reader$at(t))
  parts <- integrate_panels(f, edges[-n], edges[-1])
  size <- sum(parts$size)
  at <- parts$unresolved
  rest <- vapply(worst_panels(f, at), function(i) {
    singular_part(f, at$from[i], at$to[i], size, call)
  }, double(2))
  c(
    sum(parts$value, rest[1, ]), sum(parts$error, rest[2, ]) + .Machine$double.eps * size
  )
}

# Of these panels, 16 with the largest errors at most: the error of the others counts as it is.
worst_panels <- function(f, at) {
  if (length(at$from) <= 16L) return(seq_along(at$from))
  order(-panel_integrals(f, at$from, at$to)$error)[1:16]
}

# A panel with a jump or a pole in it or at its end: halved on, to what doubles resolve, always the
# half with the larger error. What the other halves hold falls with each halving if the integral
# converges: as 2^-(1 - p) by a pole |t - t0|^-p. Returns c(value, error) less those of the panel.
singular_part <- function(f, from, to, size, call) {
  whole <- panel_integrals(f, from, to)
  value <- error <- 0
  held <- double()
  repeat {
    middle <- from + (to - from) / 2
    tried <- panel_integrals(f, c(from, middle), c(middle, to))
    if (!all(is.finite(tried$value))) {
      if (length(held) < 4L) abort_pole(from, to, call)
      break # a node met the pole: the panel before
    }
    halves <- tried
    k <- if (halves$error[1] > halves$error[2]) 1L else 2L
    value <- value + halves$value[3L - k]
    error <- error + halves$error[3L - k] + halves$noise[3L - k]
    held <- c(held, halves$size[3L - k])
    if (k == 1L) to <- middle else from <- middle
    if (halves$error[k] <= 1e-17 * size) break
    if (to - from < 1024 * .Machine$double.eps * max(abs(c(from, to))) || to - from < 1e-305) break
  }
  n <- length(held)
  last <- halves$size[k]
  value <- value + halves$value[k]
  error <- error + halves$error[k] + halves$noise[k]
  if (halves$error[k] > 1e-17 * size && n >= 4L) {
    # Means of several halvings: the place lies now in the near, now in the far half.
    m <- min(8L, n %/% 2L)
    falls <- sum(held[n - seq_len(m) + 1L]) / sum(held[n - m - seq_len(m) + 1L])
    if (!(falls < 0.98^m)) abort_pole(from, to, call)
    each <- falls^(1 / m)
    error <- error + abs(last - mean(held[n - seq_len(m) + 1L]) * each / (1 - each))
  }
  if (error > 0.1 * size) abort_pole(from, to, call) # too few halvings to tell
  c(value - whole$value, error - whole$error - whole$noise)
}

abort_pole <- function(from, to, call) {
  abort_rotdyn(c(
    "The torque has no finite angular impulse that quadrature finds.",
    x = "Near {format(from + (to - from) / 2, digits = 7)} s it grows as 1/time or faster, or is not
         finite.",
    i = "End the span before it. If the impulse is finite, the place is one of the
         {.arg breaks_s} of {.fn torque_function}."
  ), "torque", call)
}
