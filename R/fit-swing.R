#' Periods, damping and amplitudes of a measured oscillation
#'
#' Finds the swings of a record, reduces each period to that of small swings, and fits the free
#' motion to the samples.
#'
#' **Swing by swing**: the times at which the centre is passed (of a rate: the turning points), by a
#' cubic through the samples around; the amplitude A, the geometric mean of the peaks on both sides.
#' The period of small swings is, with the arithmetic-geometric mean,
#' \deqn{T_0 = T \,\mathrm{AGM}(1, \cos(A/2)) \sqrt{1 - \zeta^2}}{T0 = T AGM(1, cos(A/2))
#'   sqrt(1 - zeta^2)}
#' for a pendulum; a spring has no correction for A. The error is below \eqn{\zeta^2 A^2}{zeta^2
#' A^2} of \eqn{T_0^2}{T0^2}. From the peaks follow, for small swings, viscous and Coulomb damping
#' by half swings,
#' \eqn{A_{j+1} = \rho A_j - \delta (1 + \rho)}{A[j+1] = rho A[j] - delta (1 + rho)} with
#' \eqn{\delta = a/\omega_0^2}{delta = a/omega0^2}.
#'
#' **Free swings** are those in which no peak is higher than the one before and the period of small
#' swings is that of the higher ones, to 1.5 % (more where it scatters, at most 5 %). To the longest
#' such stretch the exact motion is fitted,
#' \deqn{\ddot\theta = -\omega_0^2 \sin\theta - 2 \gamma \dot\theta - a\,\mathrm{sgn}\,\dot\theta}{
#'   theta'' = -omega0^2 sin(theta) - 2 gamma theta' - a sgn(theta')}
#' (theta instead of sin(theta) for a spring), with an offset of the sensor. The residuals of real
#' records are correlated: their correlation time is estimated by restricted likelihood (REML), and
#' the standard errors are those for that noise. Where the motion does not fit, to a tenth of its
#' amplitude, or there is less than one and a half swings, the median of the free swings (weighted
#' by the square of their amplitudes) is returned with the error of their scatter.
#'
#' @param record A [motion_record()] with an angle or a rate.
#' @param restoring `"gravity"` for a pendulum, `"spring"` for a torsion pendulum.
#' @param ... Not used: an unknown argument is an error.
#' @param losses Damping to fit: `"viscous"`, `"coulomb"`, both, or `"none"`.
#' @param from_s,to_s The part of the record to use.
#' @param x A `rot_swing_fit`.
#' @return A list of class `rot_swing_fit`:
#'   * `period_s`: the period of small swings \eqn{T_0 = 2\pi/\omega_0}{T0 = 2 pi/omega0}, a
#'     [measured()] number;
#'   * `omega0_rad_per_s`, `omega_rad_per_s` (with damping, \eqn{\sqrt{\omega_0^2 - \gamma^2}}{
#'     sqrt(omega0^2 - gamma^2)}), `decay_per_s` (gamma), `coulomb_rad_per_s2` (a): measured numbers
#'     from the fit, NULL where there is none or the loss was not fitted;
#'   * `swings`: a tibble of `segment`, `time_s`, `period_s`, `amplitude_rad`, `period0_s`, `used`;
#'   * `damping`: `decay_per_s` and `coulomb_rad_per_s2` from the peaks, measured numbers, or NULL
#'     with fewer than five peaks;
#'   * `amplitude_rad`: the largest of the swings used; `offset`, `residual` (root mean square),
#'     `durbin_watson`, `correlation_time_s`, `white_u` (the standard error of omega0 if the noise
#'     were white), `from` (`"fit"` or `"swings"`), `restoring`, `notes`.
#' @section Errors: `rotdyn_error_size` where fewer than three passages are found,
#'   `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_missing`, `rotdyn_error_argument`, and
#'   those of [motion_record()].
#' @source Borwein and Borwein, Pi and the AGM (1987), section 1.1; for the noise Harville, J. Am.
#'   Stat. Assoc. 72, 320 (1977).
#' @seealso [inertia_torsion()] for the moment of inertia, [pool_periods()] for hand timing,
#'   [period()] for the period of a scene.
#' @concept period
#' @concept pendulum
#' @concept damping
#' @examples
#' swing <- scene_pendulum(body_rod_end(0.2, 0.6), resistance = resistance(0.002), theta0_rad = 0.8)
#' samples <- trajectory(swing, seq(0, 12, by = 0.04))
#' set.seed(1)
#' samples$theta_rad <- samples$theta_rad + rnorm(nrow(samples), sd = 0.002)
#' fit <- fit_swing(motion_record(samples, time_s = time_s, theta_rad = theta_rad))
#' fit
#' # The same without a measurement:
#' 2 * pi * sqrt(2 * 0.6 / (3 * 9.80665))
#' @export
fit_swing <- function(record, restoring = c("gravity", "spring"), ..., losses = "viscous",
                      from_s = -Inf, to_s = Inf) {
  call <- check_no_dots(...)
  check_supplied("record", call)
  restoring <- check_choice(restoring, "restoring", c("gravity", "spring"), call)
  kinds <- c("viscous", "coulomb", "none")
  if (!is.character(losses) || !length(losses) || anyNA(losses) || !all(losses %in% kinds) ||
    ("none" %in% losses && length(losses) > 1L)) {
    abort_rotdyn(c(
      "{.arg losses} must be among {.val {kinds}}.", x = "It is {describe_value(losses)}."
    ), "value", call)
  }
  record <- check_record(record, "record", call, c("theta_rad", "omega_rad_per_s"))
  limits <- c(check_limit(from_s, "from_s", call), check_limit(to_s, "to_s", call))
  kind <- if ("theta_rad" %in% names(record)) "theta_rad" else "omega_rad_per_s"
  keep <- is.finite(record[[kind]]) & record$time_s >= limits[1] & record$time_s <= limits[2]
  data <- data.frame(
    time = record$time_s[keep], y = record[[kind]][keep], segment = record$segment[keep]
  )
  swings_of(data, kind, restoring, losses, call)
}

check_limit <- function(x, arg, call) {
  if (is.object(x)) x <- as_si(x, "s", arg, call)
  if (!is_number(x) || length(x) != 1L || is.na(x)) {
    abort_rotdyn(
      c("{.arg {arg}} must be one time in s.", x = "It is {describe_value(x)}."), "type", call
    )
  }
  as.double(x)
}

swings_of <- function(data, kind, restoring, losses, call) {
  parts <- lapply(unique(data$segment), function(s) {
    rows <- data$segment == s
    found <- find_swings(data$time[rows], data$y[rows], kind, restoring)
    if (!is.null(found)) found$swings$segment <- s
    found
  })
  parts <- Filter(function(p) !is.null(p), parts)
  if (!length(parts)) {
    abort_rotdyn(c(
      "The record has no whole swing.",
      x = "Fewer than three passages through its centre were found.",
      i = "{.arg from_s} and {.arg to_s} choose the part that swings."
    ), "size", call)
  }
  swings <- do.call(rbind, lapply(parts, `[[`, "swings"))
  swings <- choose_free(swings, restoring)
  if (!any(swings$sound, na.rm = TRUE)) {
    abort_rotdyn(c(
      "The record has no whole swing with samples at its passages and peaks.",
      x = "Of {nrow(swings)} swing{?s}, all have a gap at a passage, or a peak without a sample.",
      i = "Swings need some ten samples each."
    ), "size", call)
  }
  best <- longest_stretch(swings)
  # A part of a swing before the first passage and after the last belongs to the stretch.
  own <- range(data$time[data$segment == best$segment])
  if (best$from - own[1] < 0.5 * best$period) best$from <- own[1]
  if (own[2] - best$to < 0.5 * best$period) best$to <- own[2]
  part <- parts[[match(best$segment, vapply(parts, function(p) p$swings$segment[1], 0))]]
  damping <- peak_damping(part, best, swings, restoring)
  rows <- data$segment == best$segment & data$time >= best$from & data$time <= best$to
  fit <- fit_free_motion(
    data$time[rows], data$y[rows], kind, restoring, losses, best, part, damping
  )
  new_swing_fit(swings, fit, damping, kind, restoring)
}

# ---- the swings ---------------------------------------------------------------------------------

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
    peaks <- found$peaks + centre
    n <- length(peaks)
    if (n < 3L) break
    middle <- stats::median((peaks[-c(n, n - 1L)] + 2 * peaks[-c(1L, n)] + peaks[-(1:2)]) / 4)
    size <- max(abs(found$peaks))
    moved <- abs(middle - centre)
    centre <- middle
    if (moved < 1e-6 * size) break
  }
  m <- length(found$passages)
  if (m < 3L) return(NULL)
  j <- seq_len(m - 2L)
  period <- found$passages[j + 2L] - found$passages[j]
  peak <- sqrt(abs(found$peaks[j] * found$peaks[j + 1L]))
  amplitude <- peak_amplitude(peak, period, kind, restoring)
  swings <- data.frame(
    segment = 0, time_s = (found$passages[j] + found$passages[j + 2L]) / 2, period_s = period,
    amplitude_rad = amplitude, from = found$passages[j], to = found$passages[j + 2L],
    first = abs(found$peaks[j]), second = abs(found$peaks[j + 1L]),
    sound = found$sound[j] & found$sound[j + 1L] & found$sound[j + 2L]
  )
  list(swings = swings, passages = found$passages, peaks = found$peaks, centre = centre)
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
  before <- out[turn]
  after <- out[turn + 1L]
  guess <- vapply(seq_along(turn), function(k) {
    i <- before[k]:after[k]
    at <- which(sign(y[i[-length(i)]]) != sign(y[i[-1]]) | y[i[-1]] == 0)
    i[at[(length(at) + 1L) %/% 2L]]
  }, 0L)
  rough <- time[guess] - y[guess] * (time[guess + 1L] - time[guess]) / (y[guess + 1L] - y[guess])
  half <- stats::median(diff(rough))
  if (!(half > 0)) return(NULL)
  gap <- time[guess + 1L] - time[guess]
  passages <- vapply(seq_along(rough), function(k) {
    local_root(time, y, guess[k], rough[k], half)
  }, 0)
  if (any(diff(passages) <= 0)) passages <- rough
  peaks <- vapply(seq_len(length(passages) - 1L), function(k) {
    local_peak(time, y, which(time >= passages[k] & time <= passages[k + 1L]), half)
  }, 0)
  list(
    passages = passages, peaks = peaks,
    # A peak that no sample saw, or a passage in a gap.
    sound = gap < 0.7 * half & c(is.finite(peaks), TRUE) & c(TRUE, is.finite(peaks))
  )
}

# The root of a cubic through the samples within an eighth of a period, at least two on each side.
local_root <- function(time, y, i, rough, half) {
  n <- length(time)
  rows <- which(abs(time - rough) < 0.2 * half)
  rows <- sort(unique(c(rows, max(1L, i - 1L):min(n, i + 2L))))
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

# The extreme of a quartic through the samples within a quarter of a half swing from the highest.
local_peak <- function(time, y, rows, half) {
  if (!length(rows)) return(NA_real_)
  top <- rows[which.max(abs(y[rows]))]
  near <- which(abs(time - time[top]) < 0.25 * half)
  near <- sort(unique(c(near, max(1L, top - 2L):min(length(y), top + 2L))))
  if (length(near) < 5L || diff(range(time[near])) > 1.5 * half) return(y[top])
  x <- (time[near] - time[top]) / half
  fit <- stats::.lm.fit(outer(x, 0:4, `^`), y[near])$coefficients
  sign <- sign(y[top])
  value <- function(s) sign * sum(fit * s^(0:4))
  sign * stats::optimize(value, range(x), maximum = TRUE, tol = 1e-8)$objective
}

# ---- free swings --------------------------------------------------------------------------------

# No peak higher than the one before by more than 2 %, the amplitude at least a twentieth of the
# largest, the period of small swings that of the higher ones: to 1.5 %, or to 5 times its scatter
# and at most 5 %.
choose_free <- function(swings, restoring) {
  swings$period0_s <- swings$period_s * small_swing_ratio(swings$amplitude_rad, restoring)
  decays <- swings$sound & is.finite(swings$amplitude_rad) & swings$amplitude_rad < pi &
    swings$second <= 1.02 * swings$first & swings$second > 0.2 * swings$first
  high <- swings$amplitude_rad > 0.05 * max(swings$amplitude_rad[swings$sound], 0, na.rm = TRUE)
  free <- decays & high
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

# The longest stretch of free swings in a row, of one segment.
longest_stretch <- function(swings) {
  if (!any(swings$used)) swings$used <- swings$sound
  new <- c(TRUE, diff(swings$segment) != 0 | abs(swings$from[-1] - (swings$from[-nrow(swings)] +
    diff(swings$from))) > 0)
  run <- cumsum(!swings$used | new)
  size <- tapply(swings$used, run, sum)
  at <- which(run == as.integer(names(size)[which.max(size)]) & swings$used)
  if (!length(at)) at <- which.max(swings$amplitude_rad)
  list(
    rows = at, segment = swings$segment[at[1]], from = swings$from[at[1]],
    to = swings$to[at[length(at)]], period = stats::median(swings$period_s[at]),
    period0 = stats::median(swings$period0_s[at]), amplitude = max(swings$amplitude_rad[at])
  )
}

# Viscous and Coulomb damping from the peaks of the stretch: A_j = rho^j (A_0 - A_e) + A_e with
# A_e = -delta (1 + rho)/(1 - rho). Least squares; NULL with fewer than five peaks.
peak_damping <- function(part, best, swings, restoring) {
  none <- NULL
  at <- best$rows
  a <- c(swings$first[at], swings$second[at[length(at)]])
  # Of a rate: amplitudes by the same ratio as those of the swings.
  scale <- stats::median(swings$amplitude_rad[at] / sqrt(swings$first[at] * swings$second[at]))
  a <- a * scale
  n <- length(a)
  if (n < 5L || any(a <= 0)) return(none)
  j <- seq_len(n) - 1
  rho <- exp(stats::coef(stats::lm(log(a) ~ j))[[2]])
  rho <- min(max(rho, 0.2), 1 - 1e-9)
  p <- c(a[1], -log(rho), 0)
  # Parameters: first amplitude, viscous rate a half swing g, Coulomb delta.
  model <- function(p) {
    x <- numeric(n)
    x[1] <- p[1]
    r <- exp(-p[2])
    for (k in seq_len(n - 1L)) x[k + 1L] <- r * x[k] - p[3] * (1 + r)
    x
  }
  jacobian <- function(p) {
    vapply(1:3, function(k) {
      h <- c(1e-6 * a[1], 1e-6, 1e-6 * a[1])[k]
      (model(replace(p, k, p[k] + h)) - model(replace(p, k, p[k] - h))) / (2 * h)
    }, double(n))
  }
  for (round in 1:30) {
    q <- qr(jacobian(p))
    if (q$rank < 3L) return(none)
    step <- qr.coef(q, a - model(p))
    p <- p + step
    if (!all(is.finite(p)) || p[2] < -1) return(none)
    if (max(abs(step) / c(a[1], 1, a[1])) < 1e-12) break
  }
  sigma2 <- sum((a - model(p))^2) / (n - 3)
  u <- sqrt(sigma2 * diag(chol2inv(qr.R(q))))
  half <- best$period / 2
  omega0 <- 2 * pi / best$period0
  list(
    decay_per_s = new_measured(p[2] / half, u[2] / half, n - 3, "decay"),
    coulomb_rad_per_s2 = new_measured(p[3] * omega0^2, u[3] * omega0^2, n - 3, "coulomb")
  )
}

# ---- the fit of the motion ----------------------------------------------------------------------

# Parameters: theta and omega at the first sample, omega0, gamma, a, offset; NULL where no fit.
fit_free_motion <- function(time, y, kind, restoring, losses, best, part, damping) {
  n <- length(y)
  if (n < 8L || best$to - best$from < 1.4 * best$period) return(NULL)
  omega0 <- 2 * pi / best$period0
  gamma <- max(damping$decay_per_s$value, 0)
  start <- time[1]
  first <- which(part$passages >= best$from - 1e-9 * best$period)[1]
  slope <- sign(part$peaks[first] - part$centre)
  ago <- omega0 * small_swing_ratio(best$amplitude, restoring) * (start - part$passages[first])
  speed <- if (restoring == "spring") omega0 * best$amplitude else {
    2 * omega0 * sin(min(best$amplitude, 3.1) / 2)
  }
  # At the first passage of the stretch theta (of a rate: omega) is 0; `ago` is the phase since.
  state <- if (kind == "theta_rad") {
    slope * c(best$amplitude * sin(ago), speed * cos(ago))
  } else {
    slope * c(-best$amplitude * cos(ago), speed * sin(ago))
  }
  p <- c(state, omega0, gamma, 0, part$centre)
  free <- c(TRUE, TRUE, TRUE, "viscous" %in% losses, "coulomb" %in% losses, TRUE)
  if (!free[4]) p[4] <- 0
  if (free[5]) p[5] <- max(damping$coulomb_rad_per_s2$value, 0)
  model <- function(p) {
    p[4:5] <- pmax(p[4:5], 0)
    free_motion(p, time, kind, restoring)
  }
  fit <- least_squares(model, y, p, free, positive = 4:5)
  if (is.null(fit)) return(NULL)
  rms <- sqrt(mean(fit$residual^2))
  size <- sqrt(2) * stats::sd(y)
  if (rms > 0.1 * size) return(NULL)
  white <- fit$jacobian
  scatter <- sqrt(sum(fit$residual^2) / max(n - ncol(white), 1))
  dw <- sum(diff(fit$residual)^2) / sum(fit$residual^2)
  # Rounding is no noise with a correlation.
  exact <- scatter < 1e-9 * size
  noise <- if (exact) NULL else correlated_noise(time, white, fit$residual)
  # Residuals of 2 % that last for half a swing are another law: driven, braked, a play.
  if (!is.null(noise) && noise$tau_s > best$period / 2 && rms > 0.02 * size) return(NULL)
  covariance <- function(j, s) {
    q <- qr(j)
    if (q$rank < ncol(j)) return(matrix(NA_real_, ncol(j), ncol(j)))
    s^2 * chol2inv(qr.R(q))
  }
  u_white <- covariance(white, scatter)
  u <- if (is.null(noise)) u_white else noise$covariance
  estimate <- fit$p
  if (!is.null(noise)) {
    # The minimum for that noise: one or two steps from that for white noise.
    for (round in 1:3) {
      r <- y - model(estimate)
      j <- fit$derive(estimate)
      w <- whiten_ou(time, cbind(j, r), noise$tau_s)
      k <- ncol(w)
      q <- qr(w[, -k, drop = FALSE])
      if (q$rank < k - 1L) break
      step <- qr.coef(q, w[, k])
      estimate[fit$active] <- estimate[fit$active] + step
      s2 <- sum(qr.resid(q, w[, k])^2) / (n - k + 1)
      u <- s2 * chol2inv(qr.R(q))
    }
    estimate[4:5] <- pmax(estimate[4:5], 0)
  }
  # A loss held at 0 has the standard error of the fit without the bound.
  held <- NULL
  if (length(fit$at_bound)) {
    j <- cbind(fit$derive(estimate), fit$derive(estimate, fit$at_bound))
    w <- if (is.null(noise)) j else whiten_ou(time, j, noise$tau_s)
    e <- y - model(estimate)
    if (!is.null(noise)) e <- whiten_ou(time, cbind(e), noise$tau_s)
    held <- sqrt(diag(covariance(w, sqrt(sum(e^2) / (n - ncol(w))))))[-seq_along(fit$active)]
  }
  names <- c("theta", "omega", "omega0", "gamma", "coulomb", "offset")[fit$active]
  dimnames(u) <- dimnames(u_white) <- list(names, names)
  # Rounding of the numbers.
  floor <- 4 * .Machine$double.eps
  list(
    p = stats::setNames(estimate, c("theta", "omega", "omega0", "gamma", "coulomb", "offset")),
    covariance = u, white = sqrt(u_white["omega0", "omega0"]), rms = rms, durbin_watson = dw,
    tau_s = if (is.null(noise)) 0 else noise$tau_s, at_cap = isTRUE(noise$at_cap),
    dof = n - length(names), floor = floor * estimate[3], at_bound = fit$at_bound, held_u = held
  )
}

# theta or omega of the free motion by the models of the axle.
free_motion <- function(p, time, kind, restoring) {
  law <- if (restoring == "spring") torque_spring(p[3]^2) else {
    torque_gravity(1, p[3]^2, gravity_m_per_s2 = 1)
  }
  scene <- scene_axle(
    1, law, resistance(viscous_n_m_s = 2 * p[4], coulomb_n_m = p[5]), theta0_rad = p[1],
    omega0_rad_per_s = p[2], start_s = time[1]
  )
  trajectory(scene, time, accuracy = 1e-11)[[kind]] + p[6]
}

# Levenberg and Marquardt with central differences. `positive`: parameters that stop at 0, where
# they are held if they would go below. NULL where it fails.
least_squares <- function(model, y, p, free, positive) {
  safe <- function(p) tryCatch(suppressWarnings(model(p)), error = function(e) NULL)
  size <- stats::sd(y)
  scale <- pmax(abs(p), c(size, size, abs(p[3]), 0.01 * p[3], 0.001 * p[3]^2, size))
  active <- which(free)
  derive <- function(p, active) {
    vapply(active, function(k) {
      h <- 1e-5 * scale[k]
      # On the side where the parameter is positive.
      low <- if (k %in% positive && p[k] < h) 0 else h
      up <- safe(replace(p, k, p[k] + h))
      down <- safe(replace(p, k, p[k] - low))
      if (is.null(up) || is.null(down)) rep(NA_real_, length(y)) else (up - down) / (h + low)
    }, double(length(y)))
  }
  value <- safe(p)
  if (is.null(value)) return(NULL)
  r <- y - value
  damp <- 1e-3
  at_bound <- integer()
  for (round in 1:60) {
    j <- derive(p, active)
    if (!all(is.finite(j))) return(NULL)
    norm <- sqrt(colSums(j^2))
    norm[norm == 0] <- 1
    done <- FALSE
    for (try in 1:12) {
      a <- rbind(sweep(j, 2, norm, "/"), diag(sqrt(damp), length(active)))
      step <- qr.coef(qr(a), c(r, rep(0, length(active)))) / norm
      if (!all(is.finite(step))) return(NULL)
      new <- p
      new[active] <- p[active] + step
      new[positive] <- pmax(new[positive], 0)
      value <- safe(new)
      better <- !is.null(value) && sum((y - value)^2) <= sum(r^2) * (1 + 1e-14)
      if (better) {
        gain <- 1 - sum((y - value)^2) / sum(r^2)
        change <- max(abs(new - p) / scale)
        p <- new
        r <- y - value
        damp <- max(damp / 10, 1e-14)
        done <- change < 1e-13 || (gain < 1e-13 && change < 1e-7)
        break
      }
      damp <- damp * 10
      if (try == 12L) done <- TRUE
    }
    held <- intersect(active[p[active] == 0], positive)
    if (length(held) && round > 3L) {
      at_bound <- c(at_bound, held)
      active <- setdiff(active, held)
    }
    if (done) break
  }
  list(
    p = p, residual = r, jacobian = derive(p, active), active = active, at_bound = at_bound,
    derive = function(p, which = active) derive(p, which)
  )
}

# Columns whitened for noise with the correlation exp(-|t - t'|/tau).
whiten_ou <- function(time, x, tau) {
  n <- length(time)
  a <- exp(-diff(time) / tau)
  x[-1, ] <- (x[-1, , drop = FALSE] - a * x[-n, , drop = FALSE]) / sqrt(1 - a^2)
  x
}

# The correlation time by restricted likelihood, from a fifth of the spacing to a tenth of the
# record, and the covariance of the parameters; NULL where white noise is as likely.
correlated_noise <- function(time, j, r) {
  n <- length(r)
  p <- ncol(j)
  likelihood <- function(log_tau) {
    tau <- exp(log_tau)
    w <- whiten_ou(time, cbind(j, r), tau)
    q <- qr(w[, seq_len(p), drop = FALSE])
    if (q$rank < p) return(Inf)
    e <- qr.resid(q, w[, p + 1L])
    sum(log(1 - exp(-2 * diff(time) / tau))) + 2 * sum(log(abs(diag(qr.R(q))))) +
      (n - p) * log(sum(e^2))
  }
  spacing <- stats::median(diff(time))
  range <- log(c(spacing / 5, max((time[n] - time[1]) / 10, spacing)))
  grid <- seq(range[1], range[2], length.out = 12)
  values <- vapply(grid, likelihood, 0)
  k <- which.min(values)
  around <- grid[c(max(k - 1, 1), min(k + 1, 12))]
  best <- stats::optimize(likelihood, around, tol = 1e-3)
  # At a fifth of the spacing the correlation is exp(-5): white. 3.84 is the 95 % point of chi^2.
  if (!is.finite(best$objective) || likelihood(range[1]) - best$objective < 3.84) return(NULL)
  tau <- exp(best$minimum)
  w <- whiten_ou(time, cbind(j, r), tau)
  q <- qr(w[, seq_len(p), drop = FALSE])
  s2 <- sum(qr.resid(q, w[, p + 1L])^2) / (n - p)
  list(tau_s = tau, covariance = s2 * chol2inv(qr.R(q)), at_cap = best$minimum > range[2] - 0.01)
}

# ---- the result ---------------------------------------------------------------------------------

new_swing_fit <- function(swings, fit, damping, kind, restoring) {
  used <- swings[swings$used, ]
  notes <- character()
  if (!nrow(used)) {
    used <- swings[swings$sound, ]
    notes <- "no swing decays freely: all are used"
  }
  out <- list(
    omega0_rad_per_s = NULL, omega_rad_per_s = NULL, decay_per_s = NULL, coulomb_rad_per_s2 = NULL
  )
  if (is.null(fit)) {
    # The error of a passage counts less in a high swing. Neighbours share passages and drift: their
    # correlation reduces the number of independent ones.
    t0 <- used$period0_s
    weight <- used$amplitude_rad^2 / sum(used$amplitude_rad^2)
    n <- length(t0)
    zeta <- max(damping$decay_per_s$value, 0) * stats::median(t0) / (2 * pi)
    shrink <- sqrt(1 - min(zeta, 0.5)^2)
    # The median: swings that a brake slows, or that are driven, are off to one side.
    mean <- weighted_median(t0, weight)
    off <- t0 - mean
    r1 <- if (n > 3L) min(max(sum(off[-1] * off[-n]) / sum(off^2), 0.5), 0.99) else 0.5
    independent <- max(n * (1 - r1) / (1 + r1), 1)
    scatter <- sqrt(sum(weight * off^2) * n / max(n - 1, 1))
    u <- if (n > 2L) scatter / sqrt(independent) else max(scatter, 0.02 * mean)
    period <- new_measured(mean * shrink, u, max(independent - 1, 1), "period")
    notes <- c(notes, paste(
      "the median of the swings: no free motion fits (driven, braked, or another law); the error",
      "is that of their scatter"
    ))
  } else {
    p <- fit$p
    u <- function(name) {
      if (!name %in% rownames(fit$covariance)) return(0)
      max(sqrt(fit$covariance[name, name]), fit$floor)
    }
    omega0 <- new_measured(p[["omega0"]], u("omega0"), fit$dof, "omega0")
    period <- 2 * pi / omega0
    period$name <- "period"
    gamma <- NULL
    # omega0 and gamma are not independent.
    if ("gamma" %in% rownames(fit$covariance)) {
      pair <- c("omega0", "gamma")
      joint <- measured_pair(p[pair], fit$covariance[pair, pair], fit$dof, fit$floor)
      omega0 <- joint$omega0
      gamma <- joint$gamma
      period <- 2 * pi / omega0
      period$name <- "period"
      out$decay_per_s <- gamma
    } else if (4L %in% fit$at_bound) {
      out$decay_per_s <- new_measured(0, fit$held_u[match(4L, fit$at_bound)], fit$dof, "gamma")
    }
    if ("coulomb" %in% rownames(fit$covariance)) {
      out$coulomb_rad_per_s2 <- new_measured(p[["coulomb"]], u("coulomb"), fit$dof, "coulomb")
    } else if (5L %in% fit$at_bound) {
      out$coulomb_rad_per_s2 <-
        new_measured(0, fit$held_u[match(5L, fit$at_bound)], fit$dof, "coulomb")
    }
    out$omega0_rad_per_s <- omega0
    damped <- if (is.null(gamma)) omega0 else sqrt(omega0^2 - gamma^2)
    damped$name <- "omega"
    out$omega_rad_per_s <- damped
    if (fit$at_cap) {
      notes <- c(notes, paste(
        "the residuals are correlated over a tenth of the stretch: the law of the motion is",
        "incomplete"
      ))
    }
  }
  shown <- c("segment", "time_s", "period_s", "amplitude_rad", "period0_s", "used")
  structure(
    c(list(period_s = period), out, list(
      swings = tibble::as_tibble(swings[shown]),
      damping = damping,
      amplitude_rad = max(used$amplitude_rad),
      offset = if (is.null(fit)) NA_real_ else fit$p[["offset"]],
      residual = if (is.null(fit)) NA_real_ else fit$rms,
      durbin_watson = if (is.null(fit)) NA_real_ else fit$durbin_watson,
      correlation_time_s = if (is.null(fit)) NA_real_ else fit$tau_s,
      white_u = if (is.null(fit)) NA_real_ else fit$white,
      from = if (is.null(fit)) "swings" else "fit", kind = kind, restoring = restoring,
      notes = notes
    )),
    class = "rot_swing_fit"
  )
}

weighted_median <- function(x, weight) {
  order <- order(x)
  below <- cumsum(weight[order]) - weight[order] / 2
  if (length(x) < 2L) return(x)
  stats::approx(below, x[order], sum(weight) / 2, rule = 2, ties = "ordered")$y
}

# Two numbers with a covariance, as combinations of independent parts.
measured_pair <- function(value, covariance, dof, floor) {
  u <- pmax(sqrt(diag(covariance)), floor)
  r <- covariance[1, 2] / prod(sqrt(diag(covariance)))
  if (!is.finite(r)) r <- 0
  id <- c(new_identity(), new_identity())
  part <- function(k, u) data.frame(id = id[k], name = names(value)[k], u = u, dof = dof,
    group = id[1])
  list(
    omega0 = measured_from_parts(value[[1]], part(1, u[1]), names(value)[1]),
    gamma = measured_from_parts(
      value[[2]], rbind(part(1, r * u[2]), part(2, sqrt(max(1 - r^2, 0)) * u[2])), names(value)[2]
    )
  )
}

swing_fit_form <- list(
  .class = "rot_swing_fit", restoring = "text", kind = "text", from = "text", notes = "texts",
  damping = "list?", residual = "values:1", correlation_time_s = "values:1", white_u = "values:1",
  swings = list(
    time_s = "numbers", period_s = "values=time_s", amplitude_rad = "values=time_s",
    period0_s = "values=time_s", used = "flags=time_s"
  )
)

check_swing_fit <- function(x, arg, call) {
  check_form(x, swing_fit_form, arg, "fit of a swing", call)
  check_measured(x$period_s, arg, call)
  names <- c("omega0_rad_per_s", "omega_rad_per_s", "decay_per_s", "coulomb_rad_per_s2")
  for (part in c(x[names], x$damping[names[3:4]])) {
    if (!is.null(part)) check_measured(part, arg, call)
  }
  needed <- c(
    if (x$from == "fit") lapply(names[1:2], function(name) x[[name]]),
    if (!is.null(x$damping)) lapply(names[3:4], function(name) x$damping[[name]])
  )
  if (any(vapply(needed, is.null, NA))) abort_form("", arg, "fit of a swing", call)
  x
}

# A loss at its bound is only limited from above.
print_loss <- function(name, x, unit) {
  if (is.null(x)) return(invisible())
  print_field(name, paste(if (x$value > 0) format(x) else {
    paste("at most", format_si(stats::qt(0.975, x$dof) * x$u, 2))
  }, unit))
}

#' @rdname fit_swing
#' @export
print.rot_swing_fit <- function(x, ...) {
  check_swing_fit(x, "x", rlang::current_env())
  used <- sum(x$swings$used)
  shown <- x$swings$amplitude_rad[if (used) x$swings$used else TRUE]
  cat(
    "<rot_swing_fit> ", if (x$restoring == "gravity") "a pendulum" else "an oscillator", ", ",
    used, " free swings of ", nrow(x$swings), ", amplitudes ",
    paste(format_si(range(shown), 3), collapse = " to "),
    " rad\n", sep = ""
  )
  print_field("period", paste0(format(x$period_s), " s of small swings"))
  if (x$from == "fit") {
    print_field("omega", paste0(
      format(x$omega_rad_per_s), " rad/s",
      if (x$restoring == "gravity") " of small swings, with damping" else ", with damping"
    ))
    print_loss("decay", x$decay_per_s, "1/s")
    print_loss("coulomb", x$coulomb_rad_per_s2, "rad/s^2")
    print_field("residuals", paste0(
      format_si(x$residual, 2), if (x$kind == "theta_rad") " rad" else " rad/s",
      if (isTRUE(x$correlation_time_s > 0)) {
        paste0(
          ", correlated over ", format_si(x$correlation_time_s, 2), " s: errors are ",
          format(x$omega0_rad_per_s$u / x$white_u, digits = 2), " times those for white noise"
        )
      }
    ))
  }
  d <- x$damping
  if (!is.null(d)) {
    print_field("peaks", paste0(
      "decay ", format(d$decay_per_s), " 1/s and Coulomb ", format(d$coulomb_rad_per_s2), " rad/s^2"
    ))
  }
  for (note in x$notes) print_field("note", note)
  invisible(x)
}
