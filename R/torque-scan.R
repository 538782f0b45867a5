# Breakpoints of a torque function that did not tell its own: looked for on a grid, then bisected.
#
# A jump keeps its height however short the interval; a smooth function's difference shrinks with
# it. A kink keeps its change of slope: its second difference halves with the step, a smooth one's
# quarters. Breaks become stops of the integrator. So do the grid points around a change that is
# steep but smooth (`guards`): steps that end there cannot pass it unseen. What lies between two
# points of the grid is missed.

scan_points <- 8193L
most_breaks <- 1000L

# Breaks and guards of f (a function of time that takes a vector) in [from, to], sorted.
scan_breaks <- function(f, from, to) {
  none <- list(breaks = double(), guards = double())
  if (!(to > from)) {
    return(none)
  }
  t <- seq(from, to, length.out = scan_points)
  y <- f(t)
  if (!all(is.finite(y))) {
    return(none) # the integrator will say where and why
  }
  at <- steep_steps(y)
  jumps <- vapply(at, function(i) bisect_jump(f, t[i], t[i + 1], y[i], y[i + 1]), double(1))
  smooth <- at[is.na(jumps)]
  jumps <- jumps[!is.na(jumps)]
  list(
    breaks = sort(unique(c(jumps, scan_kinks(f, t, y, jumps)))),
    guards = sort(unique(t[c(smooth, smooth + 1L)]))
  )
}

# Larger than `factor` times the median of the nine around it.
stands_out <- function(size, factor, floor) {
  around <- stats::runmed(size, 9, endrule = "keep")
  at <- which(size > factor * around & size > floor)
  at[order(-size[at])][seq_len(min(length(at), most_breaks))]
}

# Grid intervals over which the function changes much more than around.
steep_steps <- function(y) {
  height <- abs(diff(y))
  stands_out(height, 4, 1e-12 * max(abs(y), 1e-300))
}

# The first double after the jump, or NA if the difference melts away.
bisect_jump <- function(f, a, b, ya, yb) {
  height <- abs(yb - ya)
  repeat {
    m <- a + (b - a) / 2
    if (m <= a || m >= b) {
      return(b)
    }
    ym <- f(m)
    if (!is.finite(ym)) {
      return(NA_real_)
    }
    if (abs(ym - ya) > abs(yb - ym)) {
      b <- m
      yb <- ym
    } else {
      a <- m
      ya <- ym
    }
    if (abs(yb - ya) < height / 4) {
      return(NA_real_)
    }
  }
}

scan_kinks <- function(f, t, y, jumps) {
  bend <- abs(diff(diff(y)))
  floor <- 1e-9 * max(abs(y), 1e-300)
  at <- stands_out(bend, 4, floor)
  # Next to a jump every second difference is large; the jump itself is the stop.
  near <- vapply(at, function(i) any(jumps >= t[i] & jumps <= t[i + 2]), logical(1))
  found <- vapply(at[!near], function(i) zoom_kink(f, t[i], t[i + 2]), double(1))
  # A kink between two grid points is seen from both sides.
  found <- sort(found[!is.na(found)])
  found[c(TRUE, diff(found) > 2 * (t[2] - t[1]))[seq_along(found)]]
}

# Narrow the interval to a kink: of its three inner points the one with the largest second
# difference stays in the middle. NA if the second difference shrinks as a smooth function's does.
zoom_kink <- function(f, a, b) {
  bend_at <- function(x) abs(diff(diff(f(x))))
  first <- NULL
  halvings <- 0L
  repeat {
    x <- seq(a, b, length.out = 5)
    bend <- bend_at(x)
    if (!all(is.finite(bend))) {
      return(NA_real_)
    }
    i <- which.max(bend)
    if (is.null(first)) {
      first <- bend[i]
    }
    # Per halving: 1/2 for a kink, 1/4 for a smooth bend. Judge after twelve, before rounding does.
    if (halvings == 12L) {
      return(if (bend[i] > first * 2^-17) cross_slopes(f, x[i], x[i + 2]) else NA_real_)
    }
    a <- x[i]
    b <- x[i + 2]
    halvings <- halvings + 1L
  }
}

# Where the straight lines from either side meet; the interval is so short that they are straight.
cross_slopes <- function(f, a, b) {
  h <- b - a
  left <- (f(a) - f(a - h)) / h
  right <- (f(b + h) - f(b)) / h
  x <- a + (f(b) - f(a) - right * h) / (left - right)
  if (is.finite(x) && x >= a && x <= b) x else a + h / 2
}

abort_torque_value <- function(value, time_s, call) {
  abort_rotdyn(
    c(
      "The torque function must return one number in N m.",
      x = "At {format(time_s, digits = 17)} s it returned {describe_value(value)}."
    ),
    "torque",
    call
  )
}

# Breaks the user told, or those that a scan finds, with a warning.
torque_breaks <- function(torque, scene, time_s, complain, call) {
  if (!is.null(torque$breaks_s)) {
    return(torque$breaks_s)
  }
  at <- function(t) {
    values_of(torque$f, t, complain, if (torque$arguments == 3L) scene)
  }
  scan <- scan_breaks(at, min(scene$start_s, time_s), max(scene$start_s, time_s))
  breaks <- scan$breaks
  if (length(breaks)) {
    shown <- cli::cli_vec(format(breaks, digits = 7, trim = TRUE), list("vec-trunc" = 6))
    warn_rotdyn(
      c(
        "The torque function was not told its {.arg breaks_s}; a scan found {length(breaks)}.",
        i = "At {shown} s. The integrator stops there.",
        i = "Breaks closer than {format(diff(range(scene$start_s, time_s)) / (scan_points - 1),
             digits = 2)} s may be missed: to be sure, give
             {.code torque_function(f, breaks_s = )}."
      ),
      "breaks",
      call
    )
  }
  sort(c(breaks, scan$guards))
}
