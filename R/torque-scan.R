# Breakpoints of a torque function of time whose breaks are not given: looked for on an even grid,
# then bisected. The number of points is fixed, so that the same motion computed twice is the same
# to the last bit. A function of the state is called along the path that was found, by the
# integrator (src/core/engine/ode/probe.h).
#
# A jump keeps its height however short the interval; a smooth function's difference shrinks with
# it. A kink keeps its change of slope: its second difference halves with the step, that of a smooth
# function quarters. Breaks become stops of the integrator, and so do the grid points around a
# change that is steep but smooth (`guards`): a step that ends there does not pass it. What lies
# between two points of the grid is missed: the grid follows from the resolution, as the probes of
# the integrator do.

# The narrowest change of a law that is sure to be found, of the range that a motion visits.
law_resolution <- 0.005
# The spacing of probes, of that width: ROT_ODE_GAP.
probe_gap <- 0.78125
scan_points_vectorised <- 8193L
max_breaks <- 1000L

resolution_of <- function(scene) .subset2(scene, "resolution") %||% law_resolution

scan_points_of <- function(resolution) 1 + ceiling(1 / (probe_gap * resolution))

# list(stops, time_s, torque_n_m) between two times: the breaks given, or those found, with guards,
# and what was called for that.
law_breaks <- function(law, at, from, to, call, resolution = law_resolution) {
  if (to > from) check_repeats(at, from, to, call)
  if (!is.null(law$breaks_s) || law$arguments != 1L || !(to > from)) {
    return(list(stops = as.double(law$breaks_s)))
  }
  points <- scan_points_of(resolution)
  if (law$vectorised) points <- max(points, scan_points_vectorised)
  spacing <- (to - from) / (points - 1)
  scan <- scan_breaks(at, from, to, points)
  found <- length(scan$breaks)
  if (found) {
    shown <- format(utils::head(scan$breaks, 6L), digits = 7, trim = TRUE)
    warn_quickly(
      c(
        paste0(
          "The `breaks_s` of the torque function are not given; a scan found ", found, ", at ",
          paste(shown, collapse = ", "), if (found > 6L) ", ...", " s."
        ),
        "The integrator stops there.",
        paste0(
          "The function was sampled every ", format(spacing, digits = 2),
          " s: anything shorter is not resolved. Give `torque_function(f, breaks_s = )`."
        )
      ), "breaks", call
    )
  }
  list(
    stops = in_order(c(scan$breaks, scan$guards)), time_s = scan$time_s,
    torque_n_m = scan$torque_n_m
  )
}

# Breaks and guards of f (a function of many times) in [from, to], sorted, and its values.
scan_breaks <- function(f, from, to, points = scan_points_of(law_resolution)) {
  t <- seq(from, to, length.out = points)
  y <- f(t)
  if (!all(is.finite(y))) {
    return(list(breaks = double(), guards = double())) # the integrator will say where and why
  }
  at <- stands_out(abs(diff(y)), 1e-12 * max(abs(y), 1e-300))
  jumps <- vapply(at, function(i) bisect_jump(f, t[i], t[i + 1], y[i], y[i + 1]), double(1))
  smooth <- at[is.na(jumps)]
  jumps <- jumps[!is.na(jumps)]
  list(
    breaks = in_order(c(jumps, scan_kinks(f, t, y, jumps))),
    guards = in_order(unique(t[c(smooth, smooth + 1L, wider_changes(t, y, jumps))])),
    time_s = t, torque_n_m = y
  )
}

# Points around changes that are steep for a coarser grid: a pulse of eight intervals does not stand
# out among its nine neighbours, and eight long implicit steps passed it.
wider_changes <- function(t, y, jumps) {
  found <- integer()
  by <- 4L
  while (length(t) >= 18L * by) {
    k <- seq(1L, length(t), by)
    at <- stands_out(abs(diff(y[k])), 1e-12 * max(abs(y), 1e-300))
    at <- at[!vapply(at, function(i) any(jumps >= t[k[i]] & jumps <= t[k[i + 1L]]), NA)]
    found <- c(found, k[at], k[at + 1L])
    by <- 4L * by
  }
  found
}

# Where a size is larger than four times the median of the nine around it.
stands_out <- function(size, floor) {
  at <- which(size > floor & size > 4 * stats::runmed(size, 9, endrule = "keep"))
  if (length(at) > 1L) at[order(-size[at])][seq_len(min(length(at), max_breaks))] else at
}

# sort.int() takes 22 us, also of what is in order, and a scan has four of them.
in_order <- function(x) if (is.unsorted(x)) sort.int(x) else x

# The first double after the jump, or NA if the difference melts away.
bisect_jump <- function(f, a, b, ya, yb) {
  height <- abs(yb - ya)
  repeat {
    m <- a + (b - a) / 2
    if (m <= a || m >= b) return(b)
    ym <- f(m)
    if (!is.finite(ym)) return(NA_real_)
    if (abs(ym - ya) > abs(yb - ym)) {
      b <- m
      yb <- ym
    } else {
      a <- m
      ya <- ym
    }
    if (abs(yb - ya) < height / 4) return(NA_real_)
  }
}

scan_kinks <- function(f, t, y, jumps) {
  at <- stands_out(abs(diff(diff(y))), 1e-9 * max(abs(y), 1e-300))
  # Next to a jump every second difference is large; the jump itself is the stop.
  near <- vapply(at, function(i) any(jumps >= t[i] & jumps <= t[i + 2]), logical(1))
  found <- vapply(at[!near], function(i) zoom_kink(f, t[i + 0:2], y[i + 0:2]), double(1))
  # A kink between two grid points is seen from both sides.
  found <- in_order(found[!is.na(found)])
  found[c(TRUE, diff(found) > 1e-3 * (t[2] - t[1]))[seq_along(found)]]
}

# Narrow an interval, given by its ends and its middle, to a kink: of the three inner points of its
# quarters the one with the largest second difference becomes the middle. NA if the second
# difference shrinks as that of a smooth function does.
zoom_kink <- function(f, t, y) {
  halvings <- 16L
  for (k in 0:halvings) {
    new <- t[-3] + (t[-1] - t[-3]) / 2
    t <- c(t[1], new[1], t[2], new[2], t[3])
    seen <- f(new)
    y <- c(y[1], seen[1], y[2], seen[2], y[3])
    bend <- abs(y[1:3] - 2 * y[2:4] + y[3:5])
    if (!all(is.finite(bend))) return(NA_real_)
    i <- which.max(bend)
    if (k == halvings - 6L) first <- bend[i]
    t <- t[i + 0:2]
    y <- y[i + 0:2]
  }
  # A jump among steep changes stands out here alone: six halvings leave all of it.
  if (bend[i] > first / 4) {
    jump <- bisect_jump(f, t[1], t[3], y[1], y[3])
    if (!is.na(jump)) return(jump)
  }
  # Six halvings leave 2^-6 of it at a kink, 2^-12 of a smooth bend; below 1e-14 is rounding.
  if (bend[i] > max(first * 2^-9, 1e-14 * abs(y))) cross_curves(f, t, y) else NA_real_
}

# Where the parabolas through three points on either side of an interval meet.
cross_curves <- function(f, t, y) {
  width <- t[3] - t[1]
  side <- f(c(t[1] - width * c(1, 0.5), t[3] + width * c(0.5, 1)))
  left <- c(y[1], 3 * y[1] - 3 * side[2] + side[1], 6 * y[1] - 8 * side[2] + 3 * side[1])
  right <- c(6 * y[3] - 8 * side[3] + 3 * side[4], 3 * y[3] - 3 * side[3] + side[4], y[3])
  # right - left at the ends and in the middle; its zero as a part of the width.
  difference <- right - left
  bend <- 2 * (difference[1] - 2 * difference[2] + difference[3])
  slope <- difference[3] - difference[1] - bend
  part <- -2 * difference[1] / (slope + sign(slope) * sqrt(max(0,
    slope^2 - 4 * bend * difference[1])))
  t[1] + width * if (is.finite(part) && part >= 0 && part <= 1) part else 0.5
}
