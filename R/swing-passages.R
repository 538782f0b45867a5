# The swings of a record: passages through the centre, peaks, amplitudes; the free ones; the damping
# that their peaks show.

agm <- function(a, b) {
  for (round in 1:60) {
    mean <- (a + b) / 2
    b <- sqrt(a * b)
    done <- all(abs(mean - b) <= 2 * .Machine$double.eps * abs(mean), na.rm = TRUE)
    a <- mean
    if (done) break
  }
  a
}

# T0/T at an amplitude.
small_swing_ratio <- function(amplitude, restoring) {
  if (restoring == "spring") return(rep(1, length(amplitude)))
  agm(rep(1, length(amplitude)), cos(pmin(amplitude, pi) / 2))
}

# Passages through the centre and peaks between them, of one segment; NULL if fewer than three.
find_swings <- function(time, y, kind, restoring) {
  if (length(y) < 8L) return(NULL)
  centre <- stats::median(y)
  for (round in 1:4) {
    found <- find_passages(time, y - centre)
    if (is.null(found)) return(NULL)
    peaks <- found$peaks[is.finite(found$peaks)] + centre
    n <- length(peaks)
    if (n < 3L) break
    middle <- stats::median((peaks[-c(n, n - 1L)] + 2 * peaks[-c(1L, n)] + peaks[-(1:2)]) / 4)
    size <- max(abs(peaks - centre))
    moved <- abs(middle - centre)
    centre <- middle
    if (moved < 1e-6 * size) break
  }
  m <- length(found$passages)
  if (m < 3L) return(NULL)
  j <- seq_len(m - 2L)
  period <- found$passages[j + 2L] - found$passages[j]
  heights <- abs(found$peaks)
  peak <- sqrt(heights[j] * heights[j + 1L])
  swings <- data.frame(
    segment = 0, time_s = (found$passages[j] + found$passages[j + 2L]) / 2, period_s = period,
    amplitude_rad = peak_amplitude(peak, period, kind, restoring), from = found$passages[j],
    to = found$passages[j + 2L], first = heights[j], second = heights[j + 1L],
    first_spread = found$spreads[j], second_spread = found$spreads[j + 1L],
    peak_noise = peak_noise(heights), turns = peak * period,
    sound = found$sound[j] & found$sound[j + 1L] & found$sound[j + 2L]
  )
  list(
    swings = swings, passages = found$passages, peaks = found$peaks, peak_times = found$times,
    centre = centre, grows = find_amplification(found$times, heights)
  )
}

# The scatter of the peaks of one side, by second differences.
peak_noise <- function(heights) {
  heights <- heights[is.finite(heights)]
  if (length(heights) < 7L) return(0)
  stats::mad(diff(heights, lag = 2L, differences = 2L)) / sqrt(6)
}

# Times between which the peaks rise by more than their scatter and a twentieth; NULL for none.
find_amplification <- function(time, heights) {
  keep <- is.finite(heights)
  time <- time[keep]
  heights <- heights[keep]
  n <- length(heights)
  if (n < 5L) return(NULL)
  # The mean of neighbours, from which an offset of the centre is absent.
  level <- (heights[-n] + heights[-1]) / 2
  rise <- level - cummin(level)
  top <- which.max(rise)
  low <- which.min(level[seq_len(top)])
  if (rise[top] <= max(8 * peak_noise(heights), 0.05 * max(level)) || top - low < 2L) return(NULL)
  c(time[low], time[top + 1L])
}

# The amplitude of a swing from its peak; of a rate by the energy: peak T = 8 k K(k), k = sin(A/2),
# which increases with A.
peak_amplitude <- function(peak, period, kind, restoring) {
  if (kind == "theta_rad") return(peak)
  turns <- peak * period
  if (restoring == "spring") return(turns / (2 * pi))
  low <- numeric(length(peak))
  high <- low + pi
  for (round in 1:60) {
    middle <- (low + high) / 2
    above <- 4 * pi * sin(middle / 2) / agm(rep(1, length(middle)), cos(middle / 2)) > turns
    high <- ifelse(above, middle, high)
    low <- ifelse(above, low, middle)
  }
  (low + high) / 2
}

find_passages <- function(time, y) {
  size <- stats::quantile(abs(y), 0.98, names = FALSE)
  if (!(size > 0)) return(NULL)
  # Noise by second differences, where they are not the motion itself.
  noise <- stats::mad(diff(y, differences = 2L)) / sqrt(6)
  level <- min(max(0.04 * size, 3 * noise), 0.3 * size)
  side <- sign(y) * (abs(y) > level)
  out <- which(side != 0)
  turn <- which(diff(side[out]) != 0)
  if (length(turn) < 3L) return(NULL)
  # Around each passage: the last sample on one side and the first on the other. Samples at 0, as
  # counters have them, lie between.
  ends <- vapply(turn, function(k) {
    i <- out[k]:out[k + 1L]
    i <- i[y[i] != 0]
    at <- which(diff(sign(y[i])) != 0)
    at <- at[(length(at) + 1L) %/% 2L]
    i[at + 0:1]
  }, c(0L, 0L))
  before <- ends[1, ]
  after <- ends[2, ]
  gap <- time[after] - time[before]
  rough <- time[before] + gap * abs(y[before]) / (abs(y[before]) + abs(y[after]))
  half <- stats::median(diff(rough))
  if (!(half > 0)) return(NULL)
  passages <- vapply(seq_along(rough), function(k) {
    local_root(time, y, before[k], after[k], rough[k], half)
  }, 0)
  if (any(diff(passages) <= 0)) passages <- rough
  first <- findInterval(passages, time, left.open = TRUE) + 1L
  last <- findInterval(passages, time)
  peaks <- vapply(seq_len(length(passages) - 1L), function(k) {
    local_peak(time, y, if (last[k + 1L] >= first[k]) first[k]:last[k + 1L], half)
  }, c(0, 0, 0))
  list(
    passages = passages, peaks = peaks[2, ], times = peaks[1, ], spreads = peaks[3, ],
    # A peak that no sample saw, or a passage in a gap.
    sound = gap < 0.7 * half & c(is.finite(peaks[2, ]), TRUE) & c(TRUE, is.finite(peaks[2, ]))
  )
}

rows_within <- function(time, from, to) {
  first <- findInterval(from, time) + 1L
  last <- findInterval(to, time, left.open = TRUE)
  if (last >= first) first:last
}

# The root of a cubic through the samples within an eighth of a period, at least two on each side.
local_root <- function(time, y, before, after, rough, half) {
  n <- length(time)
  rows <- c(
    rows_within(time, rough - 0.2 * half, rough + 0.2 * half),
    max(1L, before - 1L):min(n, after + 1L)
  )
  rows <- sort(unique(rows))
  x <- (time[rows] - rough) / half
  fit <- stats::.lm.fit(outer(x, 0:min(3L, length(rows) - 1L), `^`), y[rows])$coefficients
  power <- seq_along(fit) - 1
  s <- 0
  for (round in 1:50) {
    value <- sum(fit * s^power)
    slope <- sum(power[-1] * fit[-1] * s^(power[-1] - 1))
    step <- value / slope
    if (!is.finite(step)) return(rough)
    s <- s - step
    if (abs(step) < 1e-15) break
  }
  if (abs(s) > 0.3) rough else rough + s * half
}

# Time and value of the extreme of a quartic through the samples within a quarter of a half swing
# from the highest, and the error of the value over that of a sample. Where samples are far apart,
# the quartic of a sinusoid misses its top by 1e-3: the value is as much larger or smaller.
local_peak <- function(time, y, rows, half) {
  if (!length(rows)) return(c(NA_real_, NA_real_, NA_real_))
  top <- rows[which.max(abs(y[rows]))]
  near <- c(
    rows_within(time, time[top] - 0.25 * half, time[top] + 0.25 * half),
    max(1L, top - 2L):min(length(y), top + 2L)
  )
  near <- sort(unique(near))
  if (length(near) < 5L || diff(range(time[near])) > 1.5 * half) {
    return(c(time[top], y[top], Inf))
  }
  x <- (time[near] - time[top]) / half
  q <- qr(outer(x, 0:4, `^`), tol = 1e-12)
  if (q$rank < 5L) return(c(time[top], y[top], Inf))
  fit <- qr.coef(q, y[near])
  sign <- sign(y[top])
  value <- function(s) sign * sum(fit * s^(0:4))
  best <- stats::optimize(value, range(x), maximum = TRUE, tol = 1e-8)
  at <- best$maximum^(0:4)
  top_of_cosine <- sum(qr.coef(q, cos(pi * (x - best$maximum))) * at)
  spread <- backsolve(qr.R(q), at, transpose = TRUE)
  c(time[top] + half * best$maximum, sign * best$objective / top_of_cosine, sqrt(sum(spread^2)))
}

# Amplitudes that no pendulum has: angles in degrees, or a body that turns over.
check_amplitudes <- function(swings, kind, restoring, call) {
  if (restoring == "spring") return(invisible())
  # Of a rate 8 k K(k) at 3.13 rad.
  beyond <- if (kind == "theta_rad") swings$first > pi & swings$second > pi else swings$turns > 52
  beyond <- beyond & swings$sound
  beyond[is.na(beyond)] <- FALSE
  if (!any(beyond) || sum(beyond) < min(2L, sum(swings$sound))) return(invisible())
  size <- max(swings$first[beyond])
  degrees <- if (kind == "theta_rad") "theta_deg" else "omega_deg_per_s"
  abort_rotdyn(c(
    "A pendulum cannot swing that far.",
    x = if (kind == "theta_rad") {
      "The angle swings to {format_si(size, 3)} rad from its centre, beyond pi."
    } else {
      "The rate swings to {format_si(size, 3)} rad/s: no amplitude below pi has that with this
       period."
    },
    i = "If these are degrees, make the record with {.code motion_record({degrees} = )}.",
    i = "A torsion pendulum needs {.code restoring = \"spring\"}; {.arg from_s} leaves out rows in
         which the pendulum turns over."
  ), "value", call)
}

# ---- free swings --------------------------------------------------------------------------------

# No peak higher than the one before by more than 2 % or its scatter, not in a part that grows, the
# amplitude at least a twentieth of the largest, the period of small swings that of the higher ones:
# to 1.5 %, or to 5 times its scatter and at most 5 %.
choose_free <- function(swings, restoring) {
  swings$period0_s <- swings$period_s * small_swing_ratio(swings$amplitude_rad, restoring)
  decays <- swings$sound & is.finite(swings$amplitude_rad) &
    (restoring == "spring" | swings$amplitude_rad < pi) &
    swings$second <= swings$first + pmax(0.02 * swings$first, 4 * swings$peak_noise) &
    swings$second > 0.2 * swings$first
  peak <- sqrt(swings$first * swings$second)
  high <- swings$amplitude_rad > 0.05 * max(swings$amplitude_rad[swings$sound], 0, na.rm = TRUE) &
    peak > 4 * swings$peak_noise
  free <- decays & high & !swings$driven
  free[is.na(free)] <- FALSE
  if (any(free)) {
    # Where the centre is off or a brake acts, low swings suffer first: the higher half says what
    # the period is, and its scatter from swing to swing what belongs to it.
    tops <- free & swings$amplitude_rad >= stats::median(swings$amplitude_rad[free])
    middle <- stats::median(swings$period0_s[tops])
    noise <- if (sum(tops) > 3L) stats::mad(diff(swings$period0_s[tops])) / middle else 0.01
    window <- min(max(0.015, 5 * noise), 0.05)
    free <- free & abs(swings$period0_s / middle - 1) < window
  }
  swings$used <- free
  swings
}

# The longest interval of free swings in a row, of one segment.
longest_interval <- function(swings) {
  new <- c(TRUE, diff(swings$segment) != 0)
  run <- cumsum(!swings$used | new)
  size <- tapply(swings$used, run, sum)
  at <- which(run == as.integer(names(size)[which.max(size)]) & swings$used)
  list(
    rows = at, segment = swings$segment[at[1]], from = swings$from[at[1]],
    to = swings$to[at[length(at)]], period = stats::median(swings$period_s[at]),
    period0 = stats::median(swings$period0_s[at]), amplitude = max(swings$amplitude_rad[at])
  )
}

# ---- damping from the peaks ---------------------------------------------------------------------

# Losses by least squares on the peaks of the interval alone: those of the exact motion that starts
# at the first peak, each by its spread. NULL with fewer than five peaks, or three more than what is
# fitted. The error is that of the scatter, with the correlation of neighbours.
peak_damping <- function(best, swings, kind, restoring, losses) {
  at <- best$rows
  a <- c(swings$first[at], swings$second[at[length(at)]])
  spread <- c(swings$first_spread[at], swings$second_spread[at[length(at)]])
  n <- length(a)
  losses <- intersect(swing_losses, losses)
  k <- length(losses) + 2L
  seen <- sum(is.finite(spread))
  if (seen < max(5L, k + 3L) || !all(is.finite(a)) || any(a <= 0)) return(NULL)
  weight <- stats::median(spread) / spread
  omega0 <- 2 * pi / best$period0
  rate <- kind == "omega_rad_per_s"
  flags <- as.double(c(restoring == "spring", rate))
  side <- (-1)^(seq_len(n) - 1)
  # p: the first peak, the losses, the offset of the centre. A rate starts at its passage, a little
  # after its own extreme.
  at <- 3L + match(losses, swing_losses)
  model <- function(p) {
    state <- numeric(6)
    state[1 + rate] <- p[1]
    state[3] <- omega0
    state[at] <- p[1 + seq_along(losses)]
    found <- .Call(ffi_swing_extremes, state, flags, c(0, (n + 2) * best$period), n - 1)
    m <- length(found$value)
    if (found$status != 0 || !all(is.finite(found$value))) return(NULL)
    derivative <- matrix(0, n, k)
    derivative[1, 1] <- 1
    derivative[seq_len(m) + 1L, -k] <-
      matrix(found$derivative, ncol = 6, byrow = TRUE)[, c(1L + rate, at)] * sign(found$value)
    derivative[, k] <- side
    list(
      value = c(p[1], abs(found$value), rep(0, n - 1L - m)) + side * p[k], derivative = derivative
    )
  }
  rho <- stats::coef(stats::lm(log(a) ~ seq_along(a)))[[2]]
  scales <- c(
    viscous = omega0 / pi, coulomb = omega0^2 * best$amplitude / 4,
    quadratic = 3 / (8 * best$amplitude)
  )[losses]
  scales <- c(a[1], scales, a[1])
  p <- c(a[1], numeric(length(losses)), 0)
  if (length(losses)) p[2] <- max(-rho, 0) * scales[[2]]
  for (round in 1:12) {
    now <- model(p)
    if (is.null(now)) return(NULL)
    r <- weight * (a - now$value)
    q <- qr(weight * sweep(now$derivative, 2, scales, "*"), tol = 1e-10)
    if (q$rank < k) return(NULL)
    step <- qr.coef(q, r)
    # No farther than the model's own range.
    step <- step / max(1, abs(step) / 0.5)
    p <- p + step * scales
    if (max(abs(step)) < 1e-9) break
  }
  now <- model(p)
  if (is.null(now)) return(NULL)
  r <- weight * (a - now$value)
  free <- seen - k
  # Slow noise raises a peak and lowers the next: its heights are correlated below 0, which a loss
  # averages. The covariance is that of least squares under noise of the first order.
  rho1 <- if (sum(r^2) > 0) sum(r[-1] * r[-n]) / sum(r^2) + k / seen else 0
  rho1 <- min(max(rho1, -0.9), 0.9)
  solver <- t(backsolve(qr.R(q), t(qr.Q(q))))
  by_noise <- sqrt(sum(r^2) / free * colSums(solver * correlated_first_order(solver, rho1)))
  # The quartics err by some 1e-5 of a peak.
  by_quartics <- 1e-5 * a[1] * sqrt(colSums(solver^2))
  u <- scales * pmax(by_noise, by_quartics)
  free <- max(free * (1 - abs(rho1)) / (1 + abs(rho1)), 1)
  out <- lapply(seq_along(losses), function(i) {
    new_measured(p[[1 + i]], u[1 + i], free, swing_parts[[losses[i]]])
  })
  stats::setNames(out, unlist(swing_parts[losses], use.names = FALSE))
}

# (columns x, rho) => R x, with R[i, j] = rho^|i - j|.
correlated_first_order <- function(x, rho) {
  back <- rev(seq_len(nrow(x)))
  forth <- function(x) apply(x, 2, stats::filter, rho, "recursive")
  forth(x) + forth(x[back, , drop = FALSE])[back, , drop = FALSE] - x
}
