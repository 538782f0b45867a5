#' Angular velocity, acceleration and torque from measurements
#'
#' From samples of an angle, of an angular velocity, or of both: angle, angular velocity and angular
#' acceleration at each sample, and with an inertia the net torque, power and kinetic energy, each
#' with a standard error and an interval. Impacts, switched torques and stops are found, and so are
#' samples that do not belong to the motion.
#'
#' The motion is an integrated Wiener process of order p: its derivative of order p - 1 changes at
#' random,
#' \deqn{\mathrm{d}\,\theta^{(p-1)} = \sqrt{q}\,\mathrm{d}W,\qquad y_i = \theta(t_i) + e_i,}{
#'   d theta^(p-1) = sqrt(q) dW,  y_i = theta(t_i) + e_i,}
#' with unknown q and unknown scatter of the samples. A square-root Kalman filter and smoother give
#' the best estimate and its covariance; q and p (3 to 5; for an angle and a rate together 3 or 4)
#' are those under which each sample is best predicted from those before it. Of angles, breaks are
#' looked for at orders 3 and 4, and order 5 is tried last. Intervals use quantiles of Student's t
#' with the samples less what the smoother uses up.
#'
#' Where the motion is smoother than the process expects (an oscillation), that q is too large. Of
#' angles, generalised cross-validation may lower it, by a factor of 18 at most. Blocks of samples
#' that are left out and interpolated tell so, too, and the bands are narrowed. Measured with
#' `make check-measurement`, a nominal 95 % of omega is 95 % for spin-ups, 96 % for stops, 97 % for
#' coast-downs and 98 % for pendulums; of alpha 96 to 99 %; in the first and last 3 % of a record 94
#' to 97 % of omega and 92 to 98 % of alpha.
#'
#' **Breaks.** At a break the rate jumps (an impact), the acceleration does (a switched torque, a
#' stop), or its derivative (a torque that begins or ceases to change steadily: a ramp; not at order
#' 3). Where a shock would explain the record better than chance (a score test above 25), its
#' time and kind are those of the largest likelihood. [motion_events()] lists them. What a time
#' that was found errs by counts in the intervals, but for impacts: estimates beside one are less
#' certain than their intervals. Rows beside a break are flagged.
#'
#' **Outliers.** A sample that is 4.5 standard deviations from what all others predict is left out,
#' unless a break explains it better.
#'
#' **Counters.** Where the angle has a resolution D (a counter, an encoder, few digits), the scatter
#' is at least `D/sqrt(12)`. Where a count repeats four times or more, the times at which it changes
#' are used instead of the counts.
#'
#' Equal counts have the same error for as long as they last, at rest throughout: the angle there is
#' known to `D/sqrt(12)`, and no better by more samples.
#'
#' **Errors that are correlated in time** are looked for as [fit_coast_down()] does: white noise and
#' an Ornstein-Uhlenbeck process, whose correlation time and share are those of the largest
#' likelihood with the smoothness of the motion (at order 5, where the likelihood of white noise is
#' exceeded by 2 in log L). It is one state more of the smoother, so that breaks, outliers and
#' intervals allow for it. Noise of one channel is, the one that shows more. The head of the print
#' says what was found, and where the correlation time is a tenth of the record, or twice the
#' smoother's memory, that intervals may not hold. Noise that is correlated over half of that memory
#' or more is not separable from the motion, and counts as motion: the head of the print gives that
#' time. Where half of the noise is that slow, bands of 95 % held 94 to 96 % of omega, but 78 % of
#' the angles of pendulums.
#'
#' **One smoothness** stands for the whole record. Where the motion is smoother, bands are wider
#' than needed: in the classes of `make check-measurement` those of 95 % held 92 to 99.9 % of
#' omega, those of 68 % held 64 to 95 %, and 67 to 99 % of alpha. A counter's angle is known but for
#' a constant within its resolution.
#'
#' **An angle and a rate** of which one is another multiple of the other (by more than a fifth, over
#' 20 parts of the record) contradict each other: a warning gives the ratio, and the print repeats
#' it.
#'
#' **What residuals do not show** (type B, to be given): the scale and bias of a gyroscope, the rate
#' and jitter of a clock. They are added to every standard error.
#'
#' @param record A `rot_record`, from [motion_record()], or a data frame that it takes
#'   without arguments: with columns `time_s` and `theta_rad`, `omega_rad_per_s` or both.
#' @param inertia Moment of inertia in kg m^2, also [measured()] with its uncertainty, or a body:
#'   about its axle. NULL for none.
#' @param resistance A [resistance()], for the torque that is applied besides it. It needs an
#'   inertia.
#' @param breaks `"find"`, `"none"`, or the times of known breaks in s, with names `impact` (omega
#'   jumps), `switch` or `stop` (its derivative jumps) or `ramp` (the derivative of that does) where
#'   that is known.
#' @param ... Not used: an unknown argument is an error.
#' @param outliers `"find"` or `"none"`.
#' @param order The order p of the process, 3, 4 or 5, or NULL: chosen.
#' @param level Coverage of the intervals.
#' @param rest_s Two times in s between which the body is at rest: the mean rate measured there is
#'   the gyroscope's bias. It is subtracted, and its error counts.
#' @param rate_scale_u,rate_bias_u_rad_per_s Standard uncertainties of the scale factor of measured
#'   rates (relative; 0.01 to 0.03 for phones) and of their bias. They count where no angle is
#'   measured.
#' @param clock_u,clock_jitter_s Standard uncertainties of the rate of the clock (relative) and of
#'   single times.
#' @param turns `"seen"`: an angle that turns by more than pi between samples is refused, since its
#'   turns are not resolved. `"counted"`: an instrument counted them.
#' @return A tibble of class `rot_estimate`, a row for each row of the record:
#'   `r describe_columns(estimate_columns)`
#'   With an inertia also `r describe_columns(estimate_torque_columns)`
#'   Each quantity has its standard error (`_se_`) and the ends of its interval (`_low_`, `_high_`).
#'   Of rates alone, the angle is that turned since the first row of the segment. `predict()` gives
#'   the same at any time, `augment()` adds the samples and their residuals, `glance()` is a row
#'   about the fit, `ggplot2::autoplot()` draws it.
#' @section Errors: those of [motion_record()]; `rotdyn_error_size` for fewer than 12 samples (below
#'   30 a warning: intervals cover 89 to 93 % of a nominal 95 %), `rotdyn_error_type`,
#'   `rotdyn_error_time` for breaks outside the record, `rotdyn_error_value` for a motion that turns
#'   by more than pi between samples.
#' @source Park and Kailath, IEEE Trans. Automat. Contr. 40, 727 (1995), for the smoother; de Jong
#'   and Penzer, J. Amer. Statist. Assoc. 93, 796 (1998), for the tests.
#' @seealso [motion_events()], [energy_loss()], [predict.rot_estimate()], [motion_record()].
#' @concept measurement
#' @concept angular acceleration
#' @concept derivative
#' @concept smoothing
#' @concept Kalman filter
#' @examples
#' # A wheel under a torque that stops at 4 s, filmed.
#' wheel <- scene_axle(
#'   body_disk(2, 0.25), torque_steps(c(0, 4), c(0.4, 0)), resistance(viscous_n_m_s = 0.02)
#' )
#' film <- trajectory(wheel, seq(0, 8, by = 1 / 30))[, c("time_s", "theta_rad")]
#' set.seed(1)
#' film$theta_rad <- film$theta_rad + stats::rnorm(nrow(film), sd = 0.005)
#' motion <- estimate_motion(film, inertia = body_disk(2, 0.25))
#' motion
#' motion_events(motion)
#' predict(motion, time_s = c(1, 3.95))[, c("omega_rad_per_s", "omega_se_rad_per_s")]
#' @export
estimate_motion <- function(record, inertia = NULL, resistance = NULL, breaks = "find", ...,
                            outliers = "find", order = NULL, level = 0.95, rest_s = NULL,
                            rate_scale_u = 0, rate_bias_u_rad_per_s = 0, clock_u = 0,
                            clock_jitter_s = 0, turns = "seen") {
  call <- check_no_dots(...)
  check_supplied("record", call)
  record <- as_record(record, call)
  asked <- list(
    inertia = estimate_inertia(inertia, call),
    level = check_number(level, "level", "1", call, lower = 0.5, upper = 0.9999),
    scale_u = check_number(rate_scale_u, "rate_scale_u", "1", call, lower = 0, upper = 1),
    bias_u = check_number(rate_bias_u_rad_per_s, "rate_bias_u_rad_per_s", "rad/s", call, lower = 0),
    clock_u = check_number(clock_u, "clock_u", "1", call, lower = 0, upper = 1)
  )
  jitter <- check_number(clock_jitter_s, "clock_jitter_s", "s", call, lower = 0)
  if (!is.null(resistance)) {
    resistance <- as_resistance(resistance, call)
    if (is.null(asked$inertia)) {
      abort_rotdyn("{.arg resistance} needs an {.arg inertia}.", "missing", call)
    }
    asked["resistance"] <- list(resistance)
  }
  find_outliers <- check_word(outliers, "outliers", c("find", "none"), call) == "find"
  check_word(turns, "turns", c("seen", "counted"), call)
  data <- estimate_data(record, call)
  if (!is.null(rest_s)) data <- subtract_bias(data, rest_s, call)
  orders <- c(3, if (data$rates_only) 5 else 4)
  if (!is.null(order)) {
    orders <- rep(check_number(order, "order", "1", call, lower = 3, upper = 5), 2)
    if (orders[1] != round(orders[1])) {
      abort_rotdyn("{.arg order} must be 3, 4 or 5.", "value", call)
    }
  }
  said <- contradiction(data, call)
  known <- known_breaks(breaks, record, call)
  fit <- fit_estimate(
    data, known, orders, identical(breaks, "find"), find_outliers, jitter, asked, call
  )
  if (turns == "seen") check_aliasing(fit, record, call)
  fit$contradiction <- said
  new_estimate(fit, call)
}

# A record, or what motion_record() takes.
as_record <- function(x, call) {
  if (inherits(x, "rot_record")) return(x)
  if (!is.data.frame(x)) {
    abort_rotdyn(c(
      "{.arg record} must be a record or a data frame.",
      x = "It is {describe_value(x)}.", i = "{.fn motion_record} makes records."
    ), "type", call)
  }
  in_call(motion_record(x), call)
}

check_word <- function(x, arg, choices, call) {
  if (rlang::is_string(x) && x %in% choices) return(x)
  abort_rotdyn(
    c("{.arg {arg}} must be {.or {.val {choices}}}.", x = "It is {describe_value(x)}."),
    if (is.character(x)) "value" else "type", call
  )
}

# NULL, or value and standard uncertainty in kg m^2.
estimate_inertia <- function(inertia, call) {
  if (is.null(inertia)) return(NULL)
  if (inherits(inertia, "rot_body")) {
    check_body(inertia, call)
    return(c(value = named_moment(inertia, c(0, 0, 1)), u = 0))
  }
  if (inherits(inertia, "rot_measured")) {
    value <- check_number(inertia$value, "inertia", "kg*m^2", call, lower = 0, open = TRUE)
    return(c(value = value, u = as.double(inertia$u)))
  }
  value <- check_number(inertia, "inertia", "kg*m^2", call, lower = 0, open = TRUE)
  c(value = value, u = 0)
}

# The columns of a record as the core takes them, and what the fit needs to know of it.
estimate_data <- function(record, call) {
  about <- attr(record, "record")
  columns <- names(record)
  theta <- if ("theta_rad" %in% columns) as.double(record$theta_rad)
  omega <- if ("omega_rad_per_s" %in% columns) as.double(record$omega_rad_per_s)
  resolution <- about$resolution
  step <- c(resolution["theta_rad"], resolution["omega_rad_per_s"])
  if (is.null(theta) && is.null(omega) && "pulses" %in% columns) {
    theta <- as.double(record$pulses) * (2 * pi / (about$pulses_per_turn %||% 1))
    step[1] <- NA
  }
  if (is.null(theta) && is.null(omega)) {
    abort_rotdyn(c(
      "{.arg record} has no angle and no angular velocity about one axis.",
      i = if (has_all_rates(columns)) one_axis_remedy else
        "Positions of a mark, x and y, need a centre: {.code motion_record(centre_m = )}."
    ), "missing", call)
  }
  if (!any(!is.na(omega))) omega <- NULL
  if (!any(!is.na(theta))) theta <- NULL
  n <- nrow(record)
  samples <- sum(!is.na(theta)) + sum(!is.na(omega))
  if (samples < 12) {
    abort_rotdyn(c(
      "An estimate needs at least 12 samples.", x = "The record has {samples}.",
      i = "For so few, fit a law: {.fn fit_coast_down}, or {.fn stats::lm}."
    ), "size", call)
  }
  if (samples < 30) {
    warn_rotdyn(c(
      "The record has {samples} samples: intervals of 95 % cover 89 to 93 %.",
      i = "From 30 on they hold."
    ), "size", call)
  }
  time <- as.double(record$time_s)
  segment <- as.integer(record$segment %||% rep(1L, n))
  if (is.unsorted(segment) || any(diff(time)[diff(segment) == 0L] < 0)) {
    abort_rotdyn("The rows of {.arg record} must be in the order of time.", "time", call)
  }
  step <- unname(step)
  step[is.na(step)] <- 0
  step <- c(real_step(theta, segment, step[1]), step[2])
  data <- list(
    core = list(
      time_s = time, theta = theta, omega = omega,
      w_theta = if (!is.null(theta)) rep(1, n), w_omega = if (!is.null(omega)) rep(1, n),
      segment = segment, floor = step / sqrt(12)
    ),
    time_s = time, segment = segment, theta = theta, omega = omega, step = step,
    rates_only = is.null(theta), bias_u = 0, source = about$source
  )
  if (!is.null(theta)) data$core <- with_counts(data$core, step[1])
  data
}

# The resolution of an angle whose samples it limits. Times in a round number of tenths, say, give
# exact synthetic angles a step, too: those follow a smooth curve within far less than the step
# while they move by many of them.
real_step <- function(theta, segment, step) {
  if (is.null(theta) || step == 0) return(0)
  known <- !is.na(theta)
  x <- theta[known]
  third <- diff(x, differences = 3)[diff(segment[known], 3) == 0]
  moves <- abs(diff(x))
  if (length(third) < 5 || stats::median(moves) < 3 * step) return(step)
  # White noise of s.d. D/sqrt(12) has third differences of s.d. sqrt(20) times that.
  if (stats::median(abs(third)) < 0.05 * step) 0 else step
}

# The error of a count is the same in all samples of a run of L equal counts, as far as the body is
# at rest; where it moves through the whole step, it changes over the run. An Ornstein-Uhlenbeck
# process with 1/L correlation times from sample to sample: one run at rest tells the angle to
# sqrt(2/3) of a count's s.d.
with_counts <- function(core, step) {
  if (step == 0) return(core)
  known <- which(!is.na(core$theta))
  same <- diff(core$segment[known]) == 0L & abs(diff(core$theta[known])) < step / 2
  run <- cumsum(c(TRUE, !same))
  size <- tabulate(run)[run]
  if (!any(size >= slow_run)) return(core)
  wait <- ifelse(c(FALSE, same), 1 / size, 6)
  slow <- clock <- rep(0, length(core$theta))
  slow[known] <- ifelse(size >= slow_run, sqrt(1 - white_count^2), 0)
  clock[known] <- cumsum(wait)
  core$w_theta[known] <- ifelse(size >= slow_run, white_count, 1)
  core$slow <- slow
  # Rows without a sample have the clock of the sample before.
  core$clock <- c(0, clock[known])[findInterval(seq_along(clock), known) + 1L]
  core$slow_channel <- 0
  core
}

# The part of a count's error that is white, as s.d.
white_count <- 0.1

# Do the angle and the rate measured contradict each other? The mean rates of 20 blocks of the
# record, from the angles at the ends of each and from the rates within it: they differ by more than
# a fifth of their size, and by more than four standard errors. Returns the ratio, or NULL.
contradiction <- function(data, call) {
  both <- which(!is.na(data$theta) & !is.na(data$omega))
  if (is.null(data$theta) || is.null(data$omega) || length(both) < 24L) return(NULL)
  time <- data$time_s[both]
  segment <- data$segment[both]
  block <- split(seq_along(both), list(segment, ceiling(seq_along(both) * 20 / length(both))))
  block <- Filter(function(rows) length(rows) > 3L && time[rows[1]] < time[max(rows)], block)
  if (length(block) < 3L) return(NULL)
  # Rates integrated by the trapezoidal rule, and angles, as steps in each block; their errors from
  # second differences, which a smooth motion hardly has.
  rough <- function(x) stats::mad(diff(x, differences = 2)) / sqrt(6)
  theta <- data$theta[both]
  omega <- data$omega[both]
  steps <- vapply(block, function(rows) {
    h <- diff(time[rows])
    mean <- (omega[rows][-1] + omega[rows][-length(rows)]) / 2
    c(theta[max(rows)] - theta[rows[1]], sum(h * mean), sum(h), sum(h^2))
  }, double(4))
  error <- sqrt(2 * max(rough(theta), data$step[1] / 2)^2 + rough(omega)^2 * steps[4, ])
  off <- sqrt(mean((steps[1, ] - steps[2, ])^2))
  size <- sqrt(mean(pmax(steps[1, ]^2, steps[2, ]^2)))
  if (off < 0.2 * size + 4 * sqrt(mean(error^2))) return(NULL)
  ratio <- sum(steps[1, ] * steps[2, ]) / sum(steps[1, ]^2)
  warn_rotdyn(c(
    "The angle and the rate of {.arg record} contradict each other.",
    x = "Over parts of the record the rate integrated is {format(ratio, digits = 3)} times what the
         angle turns by.",
    i = "Check units, gear ratio, axis and sign of the two; an estimate from either of them alone is
         not affected."
  ), "value", call)
  ratio
}

subtract_bias <- function(data, rest_s, call) {
  rest_s <- check_column(rest_s, "rest_s", "s", call)
  if (length(rest_s) != 2L || anyNA(rest_s) || rest_s[1] >= rest_s[2]) {
    abort_rotdyn("{.arg rest_s} must be two times in s, the earlier first.", "value", call)
  }
  at <- which(data$time_s >= rest_s[1] & data$time_s <= rest_s[2] & !is.na(data$omega))
  if (length(at) < 5L) {
    abort_rotdyn(c(
      "{.arg rest_s} must hold at least five samples of the rate.", x = "It holds {length(at)}."
    ), "value", call)
  }
  at_rest <- data$omega[at]
  bias <- mean(at_rest)
  data$omega <- data$core$omega <- data$core$omega - bias
  # Noise of a gyroscope drifts: the error of the mean from blocks of a tenth.
  block <- ceiling(seq_along(at_rest) / (length(at_rest) / min(10, length(at_rest))))
  means <- vapply(split(at_rest, block), mean, 0)
  data$bias_u <- stats::sd(means) / sqrt(length(means))
  data$bias <- bias
  data
}

no_breaks <- list(time_s = double(), segment = double(), first = double())

known_breaks <- function(breaks, record, call) {
  if (rlang::is_string(breaks) && breaks %in% c("find", "none")) return(no_breaks)
  if (is.character(breaks)) {
    abort_rotdyn(c(
      "{.arg breaks} must be {.val find}, {.val none}, or times in s.",
      x = "It is {describe_value(breaks)}."
    ), "value", call)
  }
  said <- names(breaks) %||% rep("", length(breaks))
  kinds <- c("impact", "switch", "stop", "ramp")
  unknown <- setdiff(said, c("", kinds))
  if (length(unknown)) {
    abort_rotdyn(c(
      "Names of {.arg breaks} must be {.or {.val {kinds}}}.",
      x = "There is {.val {unknown[1]}}."
    ), "value", call)
  }
  time <- check_column(breaks, "breaks", "s", call)
  if (!length(time)) return(no_breaks)
  if (anyNA(time)) abort_rotdyn("{.arg breaks} must not be missing.", "time", call)
  starts <- tapply(record$time_s, record$segment, min)
  ends <- tapply(record$time_s, record$segment, max)
  segment <- vapply(time, function(t) which(t > starts & t < ends)[1], 1L)
  if (anyNA(segment)) {
    abort_rotdyn(c(
      "{.arg breaks} must lie within the record.",
      x = "{format(time[is.na(segment)][1])} s does not."
    ), "time", call)
  }
  order <- order(segment, time)
  first <- c(impact = 1, switch = 2, stop = 2, ramp = 3)[said]
  list(
    time_s = as.double(time)[order],
    segment = as.double(names(starts)[segment])[order],
    first = unname(ifelse(is.na(first), 0, first))[order]
  )
}

# ---- the fit -------------------------------------------------------------------------------------

fit_estimate <- function(data, breaks, orders, find, outliers, jitter, asked, call) {
  maximum <- if (find) min(100, length(data$time_s) %/% 10) else 0
  progress <- progress_bar("samples")
  run <- function(core, breaks, maximum = 0, outliers = FALSE, orders. = orders) {
    out <- .Call(ffi_smooth_fit, core, breaks, c(orders., maximum, outliers), progress)
    if (is.character(out)) {
      abort_rotdyn("The smoothness of the record could not be estimated.", out, call)
    }
    out
  }
  edges <- edges_of(data)
  core <- if (is.null(edges)) data$core else edges$core
  # Known times of unknown kind: the likelihood decides, one after the other.
  for (i in which(breaks$first == 0)) {
    value <- vapply(1:2, function(first) {
      tried <- breaks
      tried$first[i] <- first
      tried$first[tried$first == 0] <- 1
      out <- run(core, tried, orders. = rep(orders[1], 2))
      out$fit[5] + log(length(core$time_s)) * out$fit[8]
    }, 0)
    breaks$first[i] <- which.min(value)
  }
  if (!is.null(edges)) {
    # Two passes: the rate says how well an edge is placed in its interval.
    for (pass in 1:2) {
      out <- run(core, breaks)
      core <- weigh_edges(edges, smooth_at(core, breaks, out$fit)$omega)
    }
  }
  found <- run(core, breaks, maximum, outliers)
  if (outliers && (sum(found$left_out) > 0.03 * found$fit[7] || is_heavy(core, found))) {
    found <- run(heavy_tails(core, found, run), breaks, maximum, outliers)
  }
  rounding <- 64 * .Machine$double.eps * max(abs(c(core$theta, core$omega)), na.rm = TRUE)
  noise <- if (is.null(core$slow) && found$fit[4] > rounding) {
    correlated_noise(leave_out(core, matrix(found$left_out, length(core$time_s))), found, data)
  }
  if (!is.null(noise)) {
    # Breaks and outliers again: what is correlated was taken for them.
    core <- with_noise(core, noise)
    found <- run(core, breaks, maximum, outliers)
  }
  breaks <- found[c("time_s", "segment", "first")]
  left <- matrix(found$left_out, length(core$time_s))
  if (jitter > 0 && !is.null(core$theta)) {
    # The rate turns an error of the time into one of the angle. What scatter remains besides that
    # is known after some passes.
    first <- core$w_theta
    for (pass in 1:20) {
      sigma <- found$fit[4]
      rows <- smooth_at(leave_out(core, left), breaks, found$fit)
      core$w_theta <- sqrt(first^2 + (rows$omega * jitter / sigma)^2)
      found <- run(leave_out(core, left), breaks)
      if (abs(log(found$fit[4] / sigma)) < 0.01) break
    }
  }
  core <- leave_out(core, left)
  last_order <- if (orders[1] == orders[2]) orders[2] else 5
  # The errors of edges are not white: bands of a slow counter held 89 % with it.
  slow <- !is.null(edges) && mean(!is.na(edges$interval)) > 0.5
  fit <- found$fit
  if (!slow) fit <- .Call(ffi_smooth_refine, core, breaks, fit, last_order, progress)
  if (is.character(fit)) {
    abort_rotdyn("The smoothness of the record could not be estimated.", fit, call)
  }
  if (!is.null(edges)) {
    left_rows <- matrix(FALSE, length(data$time_s), 2)
    left_rows[edges$row[left[, 1]], 1] <- TRUE
    left <- left_rows
  }
  list(
    core = core, breaks = breaks, fit = fit[1:4], objective = fit[5], end = fit[6],
    samples = fit[7], sought = find, left_out = left, data = data, asked = asked, noise = noise,
    edges = !is.null(edges), rows = ifelse(is.na(edges$interval), edges$row, NA)
  )
}

# ---- correlated errors --------------------------------------------------------------------------

# The errors of a channel as white noise and an Ornstein-Uhlenbeck process: tau_s and the share
# `white` of the variance, as the coast-down fit has them.
with_noise <- function(core, noise) {
  w <- if (noise$channel == 0) "w_theta" else "w_omega"
  core$slow <- sqrt(1 - noise$white) * ifelse(is.finite(core[[w]]), core[[w]], 0)
  core$clock <- core$time_s / noise$tau_s
  core$slow_channel <- noise$channel
  core[[w]] <- sqrt(noise$white) * core[[w]]
  core
}

# Twice the log likelihood that correlated errors must gain.
noise_threshold <- 4

# The noise of largest likelihood with the breaks found, smoothness found with it, or NULL for white
# noise. A long record tells from a part of it.
correlated_noise <- function(core, found, data) {
  breaks <- found[c("time_s", "segment", "first")]
  n <- length(core$time_s)
  if (n > 20000) {
    rows <- seq_len(20000) + (n - 20000) %/% 2
    vectors <- c("time_s", "theta", "omega", "w_theta", "w_omega", "segment")
    core[vectors] <- lapply(core[vectors], function(x) x[rows])
    inside <- breaks$time_s > core$time_s[1] & breaks$time_s < core$time_s[20000]
    breaks <- lapply(breaks, `[`, inside & breaks$segment %in% core$segment)
  }
  h <- diff(core$time_s)[diff(core$segment) == 0L]
  h <- stats::median(h[h > 0])
  spans <- tapply(core$time_s, core$segment, function(t) diff(range(t)))
  cap <- max(0.1 * max(spans), 2 * h)
  both <- !is.null(core$theta) && !is.null(core$omega)
  order <- 5
  value <- function(core, x) {
    .Call(ffi_smooth_objective, core, breaks, c(order, 10^x[3], exp(x[4]), 1))[1]
  }
  # Smoothness without correlation, by the same search.
  start <- c(NA, NA, log10(found$fit[2]) * order / found$fit[1], log(found$fit[3]))
  descend <- function(f, x, free) {
    g <- function(y) {
      x[free] <- y
      f(x)
    }
    if (length(free) == 1L) {
      best <- stats::optimize(g, x[free] + c(-8, 3), tol = 0.02)
      x[free] <- best$minimum
      return(list(x = x, value = best$objective))
    }
    best <- stats::optim(
      x[free], g, control = list(maxit = 150, reltol = 1e-6, parscale = c(1, 1, 1, 0.3)[free])
    )
    x[free] <- best$par
    list(x = x, value = best$value)
  }
  alone <- descend(function(x) value(core, x), start, if (both) 3:4 else 3)
  white <- alone$value
  at_white <- alone$x[3]
  best <- NULL
  for (channel in c(if (!is.null(core$theta)) 0, if (!is.null(core$omega)) 1)) {
    f <- function(x) {
      tau <- min(max(exp(x[1]), 0.25 * h), cap)
      share <- 1 / (1 + exp(-min(max(x[2], -7), 7)))
      out <- abs(x[1] - log(tau)) + max(abs(x[2]) - 7, 0)
      noise <- list(tau_s = tau, white = share, channel = channel)
      if (abs(x[3]) > 60) return(1e300)
      out <- out + value(with_noise(core, noise), x)
      if (is.finite(out)) out else 1e300
    }
    grid <- expand.grid(
      tau = log(pmin(c(1.5, 5, 15, 40) * h, cap)), share = c(-2, 0),
      lambda = at_white - c(0, 2, 4, 7)
    )
    tried <- apply(grid, 1, function(x) f(c(x, start[4])))
    # From the best of each correlation time.
    from <- vapply(split(seq_along(tried), grid$tau), function(i) i[which.min(tried[i])], 1L)
    from <- from[order(tried[from])]
    from <- from[tried[from] < min(white + 8, min(tried) + 30)]
    at <- list(value = Inf)
    for (i in from) {
      x <- c(unlist(grid[i, ], use.names = FALSE), start[4])
      one <- descend(f, x, if (both) 1:4 else 1:3)
      if (one$value < at$value) at <- one
    }
    gain <- white - at$value
    if (gain < noise_threshold || (!is.null(best) && gain <= best$gain)) next
    best <- list(
      tau_s = min(max(exp(at$x[1]), 0.25 * h), cap), white = 1 / (1 + exp(-at$x[2])),
      channel = channel, gain = gain, at_cap = exp(at$x[1]) > 0.95 * cap
    )
  }
  best
}

# Degrees of freedom: of the slow part of the noise a record has as many independent samples as its
# mean would show, as in coast_dof().
noise_degrees <- function(fit, used) {
  n <- fit$samples
  noise <- fit$noise
  if (is.null(noise)) {
    # The scatter of a counter that shows its resolution alone is known.
    known <- fit$fit[4] <= 1.001 * fit$core$floor[1]
    return(max(n - used, if (known) 30 else 1))
  }
  numbers <- c(tau_s = noise$tau_s, white = noise$white, free = fit$fit[1])
  max(coast_dof(sort(fit$core$time_s), numbers), 2)
}

leave_out <- function(core, left) {
  if (!is.null(core$theta)) core$w_theta[left[, 1]] <- Inf
  if (!is.null(core$omega)) core$w_omega[left[, 2]] <- Inf
  core
}

# The smoothed columns at the samples.
smooth_at <- function(core, breaks, fit) {
  .Call(ffi_smooth_rows, core, breaks, fit[1:4], no_times)$samples
}

# Outliers that inflate the scatter hide: most residuals are small for it, some are large.
is_heavy <- function(core, found) {
  core <- leave_out(core, matrix(found$left_out, length(core$time_s)))
  fit <- found$fit[1:4]
  e <- .Call(ffi_smooth_rows, core, found[c("time_s", "segment", "first")], fit, no_times)$residual
  e <- abs(e[!is.na(e)])
  stats::median(e) < 0.5 && mean(e > 3) > 0.02
}

# Many outliers hide each other: weights of Student's t with 4 degrees of freedom first; what is
# beyond 4.5 s.d. under them is left out.
heavy_tails <- function(core, found, run) {
  breaks <- found[c("time_s", "segment", "first")]
  channels <- c(theta = "w_theta", omega = "w_omega")
  channels <- channels[!vapply(core[channels], is.null, NA)]
  first <- core[channels]
  for (round in 1:6) {
    fit <- run(core, breaks)$fit
    rows <- smooth_at(core, breaks, fit)
    h <- diff(core$time_s)[diff(core$segment) == 0L]
    square <- list(
      w_theta = function() (core$theta - rows$theta)^2 + rows$v00,
      w_omega = function() ((core$omega - rows$omega)^2 + rows$v11) * (mean(h) / fit[3])^2
    )
    for (w in channels) {
      e <- square[[w]]() / fit[4]^2
      core[[w]] <- first[[w]] * ifelse(is.na(e), 1, sqrt((4 + e) / 5))
      if (round == 6) {
        core[[w]] <- ifelse(!is.na(e) & e > 4.5^2 * first[[w]]^2, Inf, first[[w]])
      }
    }
  }
  core
}

# ---- counters -----------------------------------------------------------------------------------

# Runs of at least so many equal counts are slow: less than 0.3 steps of the counter between
# samples. There the times at which the count changes tell more than the counts.
slow_run <- 4L

# A record in which slow runs are replaced by their edges: the angle between two counts, in the
# middle of the interval. Counts stay where a run has no edge on a side, or lasts; that in the
# middle stays where the angle turns back. NULL where nothing is slow, and where noise makes the
# count flicker.
edges_of <- function(data) {
  step <- data$step[1]
  if (data$rates_only || !is.null(data$omega) || step == 0) return(NULL)
  known <- which(!is.na(data$theta))
  runs <- counter_runs(data$theta[known] / step, data$segment[known])
  if (is.null(runs)) return(NULL)
  time <- data$time_s[known]
  part <- function(rows, interval, weight, slow = 0) {
    data.frame(
      time = time[rows], theta = data$theta[known][rows], segment = data$segment[known][rows],
      interval = rep_len(interval, length(rows)), weight = rep_len(weight, length(rows)),
      slow = rep_len(slow, length(rows)), row = known[rows]
    )
  }
  a <- runs$last[runs$edge]
  edges <- part(a + 1L, time[a + 1L] - time[a], 1)
  edges$time <- (time[a] + time[a + 1L]) / 2
  edges$theta <- (data$theta[known][a] + data$theta[known][a + 1L]) / 2
  lasts <- time[runs$last] - time[runs$first]
  bounded <- runs$slow & runs$edge & runs$edge_before &
    lasts < 5 * stats::median(lasts[runs$slow])
  # Beside an edge the count is off by half a step: for as long as the run on its other side.
  n <- length(runs$size)
  off <- function(is_edge, beside) {
    ifelse(runs$slow & is_edge, pmin(beside, runs$size %/% 2L), 0L)
  }
  from <- runs$first + off(runs$edge_before, c(0L, runs$size[-n]))
  to <- runs$last - off(runs$edge, c(runs$size[-1], 0L))
  run <- rep(seq_len(n), runs$size)
  rows <- seq_along(known)
  keep <- !bounded[run] & rows >= from[run] & rows <= to[run]
  # Likelihoods leave out the first six samples of a segment: they must have the weight of samples.
  thin <- runs$starts & runs$slow & runs$size < length(known) / 8
  keep <- keep & (!thin[run] | (rows - runs$first[run]) %% pmax(runs$size[run] %/% 4L, 1L) == 0L)
  at_rest <- (runs$slow & !thin & to - from + 1L >= slow_run)[run[keep]]
  middle <- ((runs$first + runs$last) %/% 2L)[bounded & runs$turns]
  kept <- part(
    rows[keep], NA_real_, ifelse(at_rest, white_count, 1),
    ifelse(at_rest, sqrt(1 - white_count^2), 0)
  )
  out <- rbind(edges, kept, part(middle, NA_real_, 1))
  if (nrow(out) < 12L || (nrow(edges) < 8L && all(runs$slow))) return(NULL)
  out <- out[order(out$segment, out$time), ]
  list(
    core = list(
      time_s = out$time, theta = out$theta, omega = NULL, w_theta = out$weight,
      w_omega = NULL, segment = as.integer(out$segment), floor = data$core$floor,
      slow = if (any(out$slow > 0)) out$slow,
      clock = stats::approx(
        seq_along(data$time_s), data$core$clock, out$row, rule = 2, ties = "ordered"
      )$y, slow_channel = 0
    ),
    interval = out$interval, row = out$row, step = step
  )
}

# Runs of equal counts: first and last sample, size, whether a run starts a segment, is slow, turns
# back (the count goes where it came from), and whether there is an edge behind and before it.
counter_runs <- function(count, segment) {
  jump <- diff(count)
  new_segment <- diff(segment) != 0L
  last <- c(which(abs(jump) > 0.5 | new_segment), length(count))
  n <- length(last)
  first <- c(1L, last[-n] + 1L)
  size <- last - first + 1L
  slow <- size >= slow_run
  if (sum(slow) < 2L) return(NULL)
  behind <- jump[last] # NA at the end
  behind[new_segment[last]] <- NA
  before <- c(NA, behind[-n])
  by_one <- function(x) !is.na(x) & abs(x) < 1.5
  turns <- by_one(before) & by_one(behind) & before * behind < 0
  # A few samples off by a step, and back: noise or an outlier, no edges.
  blip <- turns & !slow
  edge <- by_one(behind) & (slow | c(slow[-1], FALSE)) & !(blip | c(blip[-1], FALSE))
  if (sum(blip) > max(1, 0.1 * sum(edge)) + 0.02 * length(count)) return(NULL)
  list(
    first = first, last = last, size = size, starts = is.na(before), slow = slow, turns = turns,
    edge = edge, edge_before = c(FALSE, edge[-n])
  )
}

# An edge lies anywhere in its interval: s.d. |omega| dt/sqrt(12), at most that of a count.
weigh_edges <- function(edges, omega) {
  core <- edges$core
  w <- pmin(abs(omega) * edges$interval / edges$step, 1)
  core$w_theta <- ifelse(is.na(w), core$w_theta, pmax(w, 0.02))
  core
}

no_times <- list(time_s = double(), segment = NULL)

# Angles that turn by more than half a turn between neighbouring samples.
check_aliasing <- function(fit, record, call) {
  data <- fit$data
  if (is.null(data$theta) || !is.null(data$omega)) return(invisible())
  said <- attr(record, "record")$columns
  counted <- said$column %in% c("theta_rad", "pulses") & grepl("count|turn|^1$", said$unit)
  if (any(counted) || is.null(record[["theta_rad"]])) return(invisible())
  times <- data[c("time_s", "segment")]
  rows <- .Call(ffi_smooth_rows, fit$core, fit$breaks, fit$fit, times)$others
  h <- diff(data$time_s)
  h[diff(data$segment) != 0L] <- Inf
  usual <- stats::median(h[is.finite(h)])
  turned <- pmin(abs(rows$omega[-1]), abs(rows$omega[-length(rows$omega)])) * h
  at <- which(turned > pi & h <= 1.5 * usual)
  if (!length(at)) return(invisible())
  abort_rotdyn(c(
    "The body turns by more than half a turn between two samples.",
    x = "At {format(data$time_s[at[1]], digits = 4)} s by about
         {format(turned[at[1]], digits = 3)} rad.",
    i = "A film cannot tell its turns and its sense: sample faster, or measure the rate, too.",
    i = "If the instrument counted the turns, say {.code turns = \"counted\"}."
  ), "value", call)
}

# ---- the table -----------------------------------------------------------------------------------

new_estimate <- function(fit, call) {
  times <- if (fit$edges) fit$data[c("time_s", "segment")] else no_times
  fit$process <- process_share(fit)
  fit$break_se_s <- time_errors(fit)
  rows <- fitted_rows(fit, times)
  fit$ends <- rows$ends
  fit$degrees <- noise_degrees(fit, rows$used)
  fit$residual <- rows$residual
  if (fit$edges) {
    # Of samples; an edge belongs to none.
    fit$residual <- rep(NA_real_, 2 * length(fit$data$time_s))
    own <- !is.na(fit$rows)
    fit$residual[fit$rows[own]] <- rows$residual[seq_along(fit$rows)][own]
  }
  at <- if (fit$edges) rows$others else rows$samples
  fit$events <- estimate_events(fit, at)
  out <- estimate_rows(fit, at, fit$data$time_s, fit$data$segment)
  out$flag <- estimate_flags(fit)
  new_table(
    out, nrow = length(fit$data$time_s), class = "rot_estimate", estimate = fit
  )
}

# The smoothed columns at the samples and at times. The covariance is that of the samples' scatter
# and of the process, lambda dP/d(lambda); `process` says how much of the latter there is, `ends`
# how much more at the ends.
fitted_rows <- function(fit, times) {
  rows <- .Call(ffi_smooth_rows, fit$core, fit$breaks, fit$fit, times)
  if (is.null(fit$ends)) fit$ends <- rough_ends(fit, rows$rough)
  rows$ends <- fit$ends
  first <- rows
  rows <- add_time_errors(rows, fit, times)
  if (fit$process == 1 && !length(fit$ends$time_s)) return(rows)
  step <- 0.05
  more <- .Call(
    ffi_smooth_rows, fit$core, fit$breaks, fit$fit * c(1, exp(step), 1, 1), times
  )
  for (part in c("samples", "others")) {
    at <- if (part == "samples") fit$core else times
    share <- fit$process - 1
    for (i in seq_along(fit$ends$time_s)) {
      far <- (at$time_s - fit$ends$time_s[i]) / fit$ends$reach_s[i]
      here <- is.null(at$segment) | at$segment == fit$ends$segment[i]
      share <- share + ifelse(here, fit$ends$excess[i] * exp(-far^2), 0)
    }
    for (v in c("v00", "v01", "v02", "v11", "v12", "v22")) {
      slope <- (more[[part]][[v]] - first[[part]][[v]]) / step
      rows[[part]][[v]] <- rows[[part]][[v]] + share * slope
    }
  }
  rows
}

# The time over which the smoother takes its means.
smoother_memory_s <- function(fit) {
  h <- mean(diff(fit$core$time_s)[diff(fit$core$segment) == 0L])
  fit$fit[2]^(-0.5 / fit$fit[1]) * h
}

# Ends of segments where the motion is rougher than the process expects: an exponential is, where it
# is steep. The scores of shocks in the last state are 1 on average: the excess of their mean, over
# four times the smoother's memory, above 1. Without it bands of alpha hold 75 % at ends of
# coast-downs. At order 5 the mean has few shocks, so two standard errors are added: 80 to 86 %
# without.
rough_ends <- function(fit, rough) {
  core <- fit$core
  segment <- core$segment %||% rep(1L, length(core$time_s))
  memory <- smoother_memory_s(fit)
  out <- list(time_s = double(), segment = double(), excess = double(), reach_s = double())
  few <- if (fit$fit[1] < 5) 1 else 3
  for (s in unique(segment)) {
    time <- core$time_s[segment == s]
    for (end in unique(range(time))) {
      near <- segment == s & abs(core$time_s - end) <= 4 * memory
      struck <- any(fit$breaks$segment == s & abs(fit$breaks$time_s - end) <= 4 * memory)
      excess <- few * min(mean(rough[near], na.rm = TRUE), 10) - 1
      if (struck || !is.finite(excess) || excess <= 0) next
      out <- Map(c, out, c(end, s, excess, 2 * memory))
    }
  }
  out
}

# The standard error of the time of each ramp and switch that was found, 0 for impacts: those move
# the motion of the samples beside them alone. Without it bands of records with a stop held 93 %.
time_errors <- function(fit) {
  moves <- fit$breaks$first >= 2 & fit$sought
  if (!any(moves)) return(double(length(moves)))
  se <- .Call(ffi_smooth_breaks, fit$core, fit$breaks, fit$fit)$time_error_s
  ifelse(moves & is.finite(se), se, 0)
}

# What the rows change by when a break is moved by its standard error, added to their variances.
add_time_errors <- function(rows, fit, times) {
  for (i in which(fit$break_se_s > 0)) {
    moved <- fit$breaks
    moved$time_s[i] <- moved$time_s[i] + fit$break_se_s[i]
    if (is.unsorted(order(moved$segment, moved$time_s))) next
    other <- .Call(ffi_smooth_rows, fit$core, moved, fit$fit, times)
    for (part in c("samples", "others")) {
      d <- lapply(c("theta", "omega", "alpha"), function(x) other[[part]][[x]] - rows[[part]][[x]])
      for (j in 1:3) {
        for (k in j:3) {
          v <- paste0("v", j - 1, k - 1)
          rows[[part]][[v]] <- rows[[part]][[v]] + d[[j]] * d[[k]]
        }
      }
    }
  }
  rows
}

# How far the motion departs from what is interpolated over blocks left out, over what the process
# expects (as variances). An oscillation is smoother than a Wiener process of its size: 0.3 to 0.7
# for pendulums, whose bands of omega held 98.6 to 99 % before and 97.8 to 98.4 % now. Used where at
# least 30 blocks tell, one standard error up, so that bands are not made too narrow by chance.
process_share <- function(fit) {
  core <- fit$core
  n <- length(core$time_s)
  if (is.null(core$theta) || !is.null(core$omega)) return(1)
  if (!is.null(core$slow) && mean(core$slow > 0) > 0.5) return(1)
  # A counter that is slow most of the time.
  if (fit$edges && mean(is.na(fit$rows)) > 0.5) return(1)
  size <- max(3, round(6 * fit$fit[2]^(-0.5 / fit$fit[1])))
  if (n < 30 * size) return(1)
  block <- (seq_len(n) - 1) %/% size
  used <- is.finite(core$w_theta) & !is.na(core$theta)
  # The sample in the middle of each block; not those at ends or beside a break.
  middle <- pmin(unique(block) * size + (size + 1) %/% 2, n)
  low <- pmax(middle - size, 1)
  high <- pmin(middle + size, n)
  inside <- core$segment[low] == core$segment[high] & used[middle] & middle > size &
    middle <= n - size
  for (t in fit$breaks$time_s) {
    inside <- inside & (core$time_s[high] < t | core$time_s[low] > t)
  }
  square <- expected <- double()
  for (half in 0:1) {
    left <- core
    left$w_theta[block %% 2 == half & block > 0 & block < max(block)] <- Inf
    rows <- .Call(ffi_smooth_rows, left, fit$breaks, fit$fit, no_times)$samples
    at <- middle[inside & (unique(block) %% 2 == half)]
    scatter <- fit$fit[4]^2 * (core$w_theta[at]^2 + (core$slow %||% numeric(n))[at]^2)
    square <- c(square, (core$theta[at] - rows$theta[at])^2 - scatter)
    expected <- c(expected, rows$v00[at])
  }
  blocks <- length(square)
  if (blocks < 30) return(1)
  share <- max(mean(square / expected), 0.1)
  min(1, max(0.3, share * (1 + sqrt(2 / blocks)) + 2 / blocks))
}

# Columns at times, with what the residuals do not show.
estimate_rows <- function(fit, rows, time_s, segment) {
  data <- fit$data
  asked <- fit$asked
  first <- match(segment, data$segment)
  v <- rows[c("v00", "v01", "v02", "v11", "v12", "v22")]
  add <- function(v, g0, g1, g2) {
    list(
      v00 = v$v00 + g0^2, v01 = v$v01 + g0 * g1, v02 = v$v02 + g0 * g2, v11 = v$v11 + g1^2,
      v12 = v$v12 + g1 * g2, v22 = v$v22 + g2^2
    )
  }
  if (data$rates_only) {
    bias <- sqrt(asked$bias_u^2 + data$bias_u^2)
    v <- add(v, asked$scale_u * rows$theta, asked$scale_u * rows$omega, asked$scale_u * rows$alpha)
    v <- add(v, bias * (time_s - data$time_s[first]), bias, 0)
  }
  v <- add(v, 0, asked$clock_u * rows$omega, 2 * asked$clock_u * rows$alpha)
  t <- stats::qt((1 + asked$level) / 2, fit$degrees)
  out <- list(time_s = time_s)
  put <- function(out, stem, unit, value, variance, low = -Inf) {
    se <- sqrt(pmax(variance, 0))
    name <- function(what) paste0(stem, what, "_", unit)
    out[[name("")]] <- value
    out[[name("_se")]] <- se
    out[[name("_low")]] <- pmax(value - t * se, low)
    out[[name("_high")]] <- value + t * se
    out
  }
  out <- put(out, "theta", "rad", rows$theta, v$v00)
  out <- put(out, "omega", "rad_per_s", rows$omega, v$v11)
  out <- put(out, "alpha", "rad_per_s2", rows$alpha, v$v22)
  if (!is.null(asked$inertia)) {
    inertia <- asked$inertia[["value"]]
    u <- asked$inertia[["u"]]
    out <- put(
      out, "net_torque", "n_m", inertia * rows$alpha, inertia^2 * v$v22 + (u * rows$alpha)^2
    )
    # The applied torque tau = I alpha + d(omega), and its slope d'(omega).
    drag <- estimate_drag(asked$resistance, rows$omega)
    tau <- inertia * rows$alpha + drag$torque
    tau_v <- inertia^2 * v$v22 + 2 * inertia * drag$slope * v$v12 + drag$slope^2 * v$v11 +
      (u * rows$alpha)^2
    if (!is.null(asked$resistance)) out <- put(out, "applied_torque", "n_m", tau, tau_v)
    # Product of two normal numbers, to all orders.
    both <- inertia * v$v12 + drag$slope * v$v11
    power_v <- tau^2 * v$v11 + rows$omega^2 * tau_v + 2 * tau * rows$omega * both +
      tau_v * v$v11 + both^2
    out <- put(out, "power", "w", tau * rows$omega, power_v)
    energy_v <- inertia^2 * (rows$omega^2 * v$v11 + v$v11^2 / 2) + (u * rows$omega^2 / 2)^2
    out <- put(
      out, "rotational_kinetic_energy", "j", inertia * rows$omega^2 / 2, energy_v, low = 0
    )
  }
  out$segment <- segment
  out
}

# Torque of the resistance against omega, and its derivative.
estimate_drag <- function(resistance, omega) {
  if (is.null(resistance)) return(list(torque = 0 * omega, slope = 0 * omega))
  list(
    torque = resistance$viscous_n_m_s * omega +
      resistance$quadratic_n_m_s2 * omega * abs(omega) + resistance$coulomb_n_m * sign(omega),
    slope = resistance$viscous_n_m_s + 2 * resistance$quadratic_n_m_s2 * abs(omega)
  )
}

estimate_flags <- function(fit) {
  time <- fit$data$time_s
  segment <- fit$data$segment
  n <- length(time)
  flag <- rep("", n)
  say <- function(flag, rows, word) {
    rows <- unique(rows[rows >= 1 & rows <= n])
    flag[rows] <- ifelse(flag[rows] == "", word, paste(flag[rows], word, sep = ", "))
    flag
  }
  samples <- cbind(
    if (!is.null(fit$data$theta)) !is.na(fit$data$theta),
    if (!is.null(fit$data$omega)) !is.na(fit$data$omega)
  )
  flag <- say(flag, which(rowSums(fit$left_out) > 0), "outlier")
  flag <- say(flag, which(rowSums(samples) == 0), "no sample")
  h <- diff(time)
  inside <- diff(segment) == 0L
  usual <- stats::median(h[inside])
  for (i in seq_along(fit$breaks$time_s)) {
    near <- segment == fit$breaks$segment[i] & abs(time - fit$breaks$time_s[i]) <= usual
    flag <- say(flag, which(near), "break")
  }
  gaps <- which(inside & h > 5 * usual)
  say(flag, c(gaps, gaps + 1L), "gap")
}

# Is the body at rest behind a break, and was it not before? Over 25 rows or to the next break; a
# time that is off by a part of a spacing leaves them some rate.
rests_behind <- function(fit, rows, i, alpha_jump) {
  here <- which(fit$data$segment == fit$breaks$segment[i])
  time <- fit$data$time_s[here]
  at <- fit$breaks$time_s[i]
  spacing <- stats::median(diff(time))
  next_s <- min(c(fit$breaks$time_s[-seq_len(i)][fit$breaks$segment[-seq_len(i)] ==
    fit$breaks$segment[i]], Inf))
  behind <- utils::head(here[time > at & time < next_s], 27)[-(1:2)]
  before <- utils::tail(here[time < at], 12)
  still <- function(rows_at) {
    t <- stats::qt(0.995, fit$degrees)
    abs(rows$omega[rows_at]) <= pmax(t * sqrt(rows$v11[rows_at]), abs(alpha_jump) * spacing)
  }
  length(behind) > 2L && mean(still(behind)) > 0.9 && length(before) > 0L && !still(before[1])
}

# The breaks: kind, time, jumps with standard errors.
estimate_events <- function(fit, rows) {
  n <- length(fit$breaks$time_s)
  jumps <- if (n) .Call(ffi_smooth_breaks, fit$core, fit$breaks, fit$fit)
  jumps <- lapply(jumps, function(x) replace(x, is.nan(x), NA_real_))
  column <- function(name) if (n) jumps[[name]] else double()
  root <- function(name) sqrt(pmax(column(name), 0))
  rests <- vapply(seq_len(n), function(i) rests_behind(fit, rows, i, jumps$alpha_jump[i]), NA)
  first <- as.double(fit$breaks$first)
  event <- rep("impact", n)
  event[first == 2] <- ifelse(rests[first == 2], "stop", "switch")
  event[first == 3] <- "ramp"
  clean <- function(x, from = 2) replace(x, first >= from, 0)
  new_table(list(
    time_s = as.double(fit$breaks$time_s), time_se_s = column("time_error_s"), event = event,
    omega_jump_rad_per_s = clean(column("omega_jump")),
    omega_jump_se_rad_per_s = clean(root("v11")),
    alpha_jump_rad_per_s2 = clean(column("alpha_jump"), 3),
    alpha_jump_se_rad_per_s2 = clean(root("v22"), 3),
    segment = as.integer(fit$breaks$segment)
  ), nrow = n)
}
