# The attribute of an estimate.
estimate_form <- list(
  core = list(
    time_s = "numbers", theta = "values?", omega = "values?", w_theta = "values?",
    w_omega = "values?", floor = "numbers:2"
  ),
  breaks = list(time_s = "numbers", segment = "numbers=time_s", first = "numbers=time_s"),
  fit = "numbers:4", degrees = "number", process = "number", break_se_s = "numbers",
  ends = list(
    time_s = "numbers", segment = "numbers=time_s", excess = "numbers=time_s",
    reach_s = "numbers=time_s"
  ),
  samples = "number", end = "number", sought = "flag", contradiction = "number?",
  noise = list(
    .optional = TRUE, tau_s = "number", white = "number", channel = "number", gain = "number",
    at_cap = "flag"
  ),
  left_out = "flags", residual = "values",
  asked = list(
    inertia = "values?", level = "number", scale_u = "number", bias_u = "number",
    clock_u = "number"
  ),
  data = list(time_s = "numbers", rates_only = "flag", bias_u = "number"), events = "list"
)

check_estimate <- function(x, arg, call) {
  check_class(x, "rot_estimate", arg, "{.fn estimate_motion} gives one.", call)
  fit <- attr(x, "estimate")
  check_form(fit, estimate_form, arg, "estimate", call)
  n <- length(fit$core$time_s)
  ok <- is.integer(fit$core$segment) && length(fit$core$segment) == n &&
    length(fit$data$time_s) > 0L && is.integer(fit$data$segment) &&
    length(fit$data$segment) == length(fit$data$time_s) &&
    all(lengths(fit$core[c("theta", "omega", "w_theta", "w_omega")]) %in% c(0L, n)) &&
    length(fit$break_se_s) == length(fit$breaks$time_s) && fit$fit[1] %in% 2:5 &&
    all(fit$breaks$first %in% 1:3) && !is.unsorted(fit$core$segment)
  if (!ok) abort_form("parts", arg, "estimate", call)
  if (!identical(as.double(x[["time_s"]]), as.double(fit$data$time_s))) {
    abort_rotdyn(c(
      "{.arg {arg}} must have the rows that {.fn estimate_motion} gave.",
      x = "It has {nrow(x)}, of {length(fit$data$time_s)}, or other times."
    ), "value", call)
  }
  fit
}

#' A measured motion at other times
#'
#' The smoothed motion of [estimate_motion()] at any times, between samples and within gaps, with
#' its errors. Beyond the ends of the record the intervals widen; farther than the length of the
#' record, and between its segments, nothing is known.
#'
#' @param object A `rot_estimate`, from [estimate_motion()].
#' @param time_s Times in s, in any order. NA gives a row of NA.
#' @param ... Not used.
#' @param segment The segment of the record: NULL for the one that has the time, or numbers. It is
#'   needed where segments overlap in time.
#' @return A tibble with one row for each time, and the columns of the estimate without `flag`. At a
#'   break, the motion behind it.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_time` for infinite times,
#'   `rotdyn_error_value` for segments that overlap or are not there.
#' @seealso [estimate_motion()].
#' @concept interpolate
#' @concept other times
#' @examples
#' time <- seq(0, 2, by = 0.05)
#' samples <- data.frame(time_s = time, theta_rad = 3 * time^2 + sin(40 * time) / 99)
#' motion <- estimate_motion(samples)
#' predict(motion, c(0.51, 2.1))[, c("time_s", "omega_rad_per_s", "omega_se_rad_per_s")]
#' @export
predict.rot_estimate <- function(object, time_s, ..., segment = NULL) {
  call <- current_env()
  if (missing(time_s)) check_supplied("time_s", call)
  check_no_dots(...)
  fit <- check_estimate(object, "object", call)
  time_s <- check_column(time_s, "time_s", "s", call)
  if (any(is.infinite(time_s))) abort_rotdyn("{.arg time_s} must be finite.", "time", call)
  at <- segment_at(fit, time_s, segment, call)
  known <- which(!is.na(at))
  order <- known[order(at[known], time_s[known])]
  times <- list(time_s = as.double(time_s[order]), segment = as.integer(at[order]))
  rows <- fitted_rows(fit, times)$others
  out <- estimate_rows(fit, rows, times$time_s, times$segment)
  from <- rep(NA_integer_, length(time_s))
  from[order] <- seq_along(order)
  out <- lapply(out, `[`, from)
  out$time_s <- as.double(time_s)
  new_table(out, nrow = length(time_s))
}

# The segment of each time, NA where none reaches it.
segment_at <- function(fit, time_s, segment, call) {
  starts <- tapply(fit$data$time_s, fit$data$segment, min)
  ends <- tapply(fit$data$time_s, fit$data$segment, max)
  names <- as.integer(names(starts))
  if (!is.null(segment)) {
    segment <- check_column(segment, "segment", "1", call)
    if (!length(segment) %in% c(1L, length(time_s)) || !all(segment %in% c(names, NA))) {
      abort_rotdyn(c(
        "{.arg segment} must be a segment of the record, one or one for each time.",
        i = "They are {.val {names}}."
      ), "value", call)
    }
    which <- match(rep_len(segment, length(time_s)), names)
    span <- (ends - starts)[which]
    far <- time_s < starts[which] - span | time_s > ends[which] + span
    return(ifelse(far, NA, names[which]))
  }
  overlap <- length(starts) > 1L && any(sort(starts)[-1] < ends[order(starts)][-length(ends)])
  if (overlap) {
    abort_rotdyn(c(
      "The segments of the record overlap in time.", i = "Give {.arg segment}: {.val {names}}."
    ), "value", call)
  }
  vapply(time_s, function(t) {
    if (is.na(t)) return(NA_integer_)
    inside <- which(t >= starts & t <= ends)
    if (length(inside)) return(names[inside[1]])
    first <- which.min(starts)
    last <- which.max(ends)
    if (t < starts[first] && t >= 2 * starts[first] - ends[first]) return(names[first])
    if (t > ends[last] && t <= 2 * ends[last] - starts[last]) return(names[last])
    NA_integer_
  }, 1L)
}

#' @export
summary.rot_estimate <- function(object, ...) {
  check_no_dots(...)
  glance(object)
}

#' @rdname estimate_motion
#' @param x A `rot_estimate`.
#' @export
glance.rot_estimate <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  fit <- check_estimate(x, "x", call)
  scatter <- estimate_scatter(fit)
  new_table(list(
    samples = fit$samples, outliers = sum(fit$left_out), breaks = length(fit$breaks$time_s),
    order = fit$fit[1], log10_smoothness = log10(fit$fit[2]),
    smoothness = smoothness_words[fit$end + 1],
    theta_scatter_rad = scatter[1], omega_scatter_rad_per_s = scatter[2],
    correlation_time_s = fit$noise$tau_s %||% 0, white_share = fit$noise$white %||% 1,
    degrees = fit$degrees,
    level = fit$asked$level
  ), nrow = 1L)
}

smoothness_words <- c("within range", "polynomial", "joins the samples")

# Scatter of the samples in rad and rad/s, NA for what was not measured.
estimate_scatter <- function(fit) {
  h <- diff(fit$core$time_s)[diff(fit$core$segment) == 0L]
  sigma <- fit$fit[4]
  c(
    if (is.null(fit$core$theta)) NA_real_ else sigma,
    if (is.null(fit$core$omega)) NA_real_ else sigma * fit$fit[3] / mean(h)
  )
}

#' @rdname estimate_motion
#' @export
augment.rot_estimate <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  fit <- check_estimate(x, "x", call)
  if (nrow(x) != length(fit$data$time_s) || !identical(x[["time_s"]], fit$data$time_s)) {
    abort_rotdyn("The rows of {.arg x} are not those of its record.", "value", call)
  }
  parts <- estimate_residuals(fit)
  x[names(parts)] <- parts
  x
}

# Samples and their leave-one-out residuals in standard deviations.
estimate_residuals <- function(fit) {
  out <- list()
  n <- length(fit$data$time_s)
  rows <- .Call(ffi_smooth_rows, fit$core, fit$breaks, fit$fit, list(
    time_s = fit$data$time_s, segment = fit$data$segment
  ))
  rows <- rows$others
  scatter <- estimate_scatter(fit)
  residual <- function(y, x, variance, sigma, of) {
    if (length(of) != n) of <- rep(NA_real_, n)
    ifelse(is.na(of), (y - x) / sqrt(variance + sigma^2), of)
  }
  whole <- if (length(fit$residual) == 2L * n) matrix(fit$residual, n) else matrix(NA_real_, n, 2)
  if (!is.null(fit$data$theta)) {
    out$theta_sample_rad <- fit$data$theta
    out$theta_residual <- residual(
      fit$data$theta, rows$theta, rows$v00, scatter[1], whole[, 1]
    )
  }
  if (!is.null(fit$data$omega)) {
    out$omega_sample_rad_per_s <- fit$data$omega
    out$omega_residual <- residual(
      fit$data$omega, rows$omega, rows$v11, scatter[2], whole[, 2]
    )
  }
  out
}

#' Energy that a measured motion lost
#'
#' The difference of the rotational kinetic energies at two times, with its standard error by the
#' simulation smoother: motions are drawn from what the samples leave possible. The energies at two
#' times have errors that depend on each other; the scatter of the draws has it all.
#'
#' \deqn{\Delta E = \tfrac12 I\,(\omega_1^2 - \omega_2^2)}{dE = I/2 (omega_1^2 - omega_2^2)}
#'
#' @param estimate A `rot_estimate`, from [estimate_motion()], with an inertia.
#' @param from_s,to_s The two times in s, one or as many of each. Outside the record, or in
#'   different segments, the result is NA.
#' @param ... Not used: an unknown argument is an error.
#' @param draws Number of draws, at least 50.
#' @param seed Seed of the draws, a whole number of at least 0. R's random numbers are not used.
#' @return A tibble with the columns `r describe_columns(energy_loss_columns)`
#'   The interval is that of the estimate's `level`. A gain of energy is negative.
#' @section Errors: `rotdyn_error_missing` without an inertia, `rotdyn_error_type`,
#'   `rotdyn_error_size`, `rotdyn_error_value`.
#' @source Fruehwirth-Schnatter, J. Time Ser. Anal. 15, 183 (1994); Durbin and Koopman, Biometrika
#'   89, 603 (2002).
#' @seealso [estimate_motion()], [energy_partition()].
#' @concept energy loss
#' @concept kinetic energy
#' @examples
#' wheel <- scene_axle(0.05, resistance = resistance(viscous_n_m_s = 0.01), omega0_rad_per_s = 20)
#' film <- trajectory(wheel, seq(0, 5, by = 0.02))[, c("time_s", "theta_rad")]
#' set.seed(2)
#' film$theta_rad <- film$theta_rad + stats::rnorm(nrow(film), sd = 0.005)
#' energy_loss(estimate_motion(film, inertia = 0.05), from_s = c(0, 1), to_s = c(1, 5))
#' @export
energy_loss <- function(estimate, from_s, to_s, ..., draws = 200, seed = 1) {
  call <- check_no_dots(...)
  if (!missing(estimate)) check_no_losses(estimate, call)
  check_supplied(c("estimate", "from_s", "to_s"), call)
  fit <- check_estimate(estimate, "estimate", call)
  if (is.null(fit$asked$inertia)) {
    abort_rotdyn(c(
      "{.arg estimate} has no inertia.", i = "Give it to {.fn estimate_motion}: {.arg inertia}."
    ), "missing", call)
  }
  draws <- check_number(draws, "draws", "1", call, lower = 50, upper = 1e5)
  seed <- check_seed(seed, call)
  columns <- check_columns_of(list(from_s = from_s, to_s = to_s), c("s", "s"), call)
  n <- check_recyclable(columns, call)
  from_s <- rep_len(columns$from_s, n)
  to_s <- rep_len(columns$to_s, n)
  if (any(is.infinite(c(from_s, to_s)))) {
    abort_rotdyn("{.arg from_s} and {.arg to_s} must be finite.", "time", call)
  }
  at <- segment_at(fit, c(from_s, to_s), NULL, call)
  from <- at[seq_len(n)]
  known <- which(!is.na(from) & !is.na(at[n + seq_len(n)]) & from == at[n + seq_len(n)])
  loss <- se <- low <- high <- rep(NA_real_, n)
  if (length(known)) {
    time <- c(from_s[known], to_s[known])
    segment <- rep(from[known], 2)
    order <- order(segment, time)
    times <- list(time_s = time[order], segment = as.integer(segment[order]))
    omega <- .Call(ffi_smooth_draws, fit$core, fit$breaks, fit$fit, times, c(floor(draws), seed))
    omega <- matrix(omega, length(time))
    omega[order, ] <- omega
    mean <- .Call(ffi_smooth_rows, fit$core, fit$breaks, fit$fit, times)$others$omega
    mean[order] <- mean
    m <- length(known)
    inertia <- fit$asked$inertia[["value"]]
    of <- function(x) inertia * (x[seq_len(m)]^2 - x[m + seq_len(m)]^2) / 2
    drawn <- matrix(apply(omega, 2, of), m)
    # What the residuals do not show: scale factors of omega and of the inertia, bias.
    share <- 2 * fit$asked$clock_u
    bias <- 0
    if (fit$data$rates_only) {
      share <- sqrt(share^2 + (2 * fit$asked$scale_u)^2)
      bias <- sqrt(fit$asked$bias_u^2 + fit$data$bias_u^2) *
        inertia * (mean[seq_len(m)] - mean[m + seq_len(m)])
    }
    share <- sqrt(share^2 + (fit$asked$inertia[["u"]] / inertia)^2)
    loss[known] <- of(mean)
    random <- apply(drawn, 1, stats::sd)
    se[known] <- sqrt(random^2 + (share * of(mean))^2 + bias^2)
    t <- stats::qt((1 + fit$asked$level) / 2, fit$degrees)
    low[known] <- loss[known] - t * se[known]
    high[known] <- loss[known] + t * se[known]
  }
  new_table(list(
    from_s = as.double(from_s), to_s = as.double(to_s), energy_loss_j = loss,
    energy_loss_se_j = se, energy_loss_low_j = low, energy_loss_high_j = high
  ), nrow = n)
}

# A table that has the answer.
check_no_losses <- function(x, call) {
  known <- if (is.data.frame(x) && !inherits(x, "rot_estimate")) {
    grep("(_loss|dissipated)_j$", names(x), value = TRUE)
  }
  if (length(known)) {
    abort_rotdyn(c(
      "{.arg estimate} must be what {.fn estimate_motion} returned: a measured motion.",
      x = "It is {describe_value(x)}.",
      i = "What it lost is its column {.field {known}}."
    ), "type", call)
  }
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_estimate <- function(x, ...) {
  size <- c("A measured motion" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)))
  fit <- attr(x, "estimate")
  if (is.null(fit) || !is.null(.Call(ffi_form_fault, fit, estimate_form))) return(size)
  scatter <- estimate_scatter(fit)
  said <- c(
    if (!is.na(scatter[1])) paste(format_si(signif(scatter[1], 3)), "rad"),
    if (!is.na(scatter[2])) paste(format_si(signif(scatter[2], 3)), "rad/s")
  )
  left <- sum(fit$left_out)
  events <- fit$events
  end <- if (fit$end == 1) {
    "the record is a polynomial of the time"
  } else if (fit$end == 2) {
    "the motion changes from sample to sample: sample faster"
  }
  c(
    size, "Scatter of a sample" = paste(said, collapse = ", "),
    "Process" = paste0("order ", fit$fit[1], ", ", format(round(fit$degrees)),
                       " degrees of freedom"),
    "Bands" = band_words,
    if (!is.null(fit$noise)) c("Noise" = noise_words(fit)),
    "Slow errors" = paste(
      "those correlated over", format_si(signif(separable_s(fit), 2)),
      "s or more count as motion"
    ),
    if (fit$core$floor[1] > 0) {
      c("Resolution" = paste(
        format_si(signif(sqrt(12) * fit$core$floor[1], 3)),
        "rad: the angle of a counter is known but for a constant within it"
      ))
    },
    if (!is.null(fit$contradiction)) {
      c("Contradiction" = paste(
        "the rate is", format(fit$contradiction, digits = 3), "times that of the angle:",
        "intervals do not hold"
      ))
    },
    if (!is.null(end)) c("Smoothness" = end),
    if (left > 0) c("Left out" = paste0(left, " sample", if (left > 1) "s")),
    if (NROW(events)) {
      c("Breaks" = paste(
        paste0(events$event, " at ", format(signif(events$time_s, 5), trim = TRUE), " s")[
          seq_len(min(4, nrow(events)))
        ],
        collapse = ", "
      ))
    }
  )
}

# Its figure is judged by bench/measurement/noise.R.
band_words <- paste(
  "one smoothness for the whole record: wide where the motion is smoother, those of 68 % hold up",
  "to 99 %"
)

# The smoother takes errors for motion that are correlated over half of its memory or more, or over
# a tenth of the record.
separable_s <- function(fit) {
  time_s <- fit$core$time_s
  segment <- fit$core$segment
  if (length(segment) != length(time_s)) segment <- rep(1L, length(time_s))
  span_s <- max(tapply(time_s, segment, function(t) diff(range(t))))
  min(smoother_memory_s(fit) / 2, span_s / 10)
}

noise_words <- function(fit) {
  noise <- fit$noise
  slow <- 1 - noise$white
  both <- !is.null(fit$core$theta) && !is.null(fit$core$omega)
  paste0(
    if (both) c("of angles ", "of rates ")[noise$channel + 1],
    if (slow < 0.95) paste0(round(100 * slow), " % of its variance "),
    "correlated over ", format_si(signif(noise$tau_s, 2)), " s",
    if (noise$at_cap) {
      ", a tenth of the record or more: intervals may not hold"
    } else if (noise$tau_s > 2 * smoother_memory_s(fit)) {
      ", far slower than the motion: intervals may not hold"
    }
  )
}

#' @export
`names<-.rot_estimate` <- function(x, value) reconstruct_estimate(NextMethod(), x)

#' @export
`[.rot_estimate` <- function(x, ...) reconstruct_estimate(NextMethod(), x)

# Rows or columns that change leave a plain tibble: predict() would speak of another record.
reconstruct_estimate <- function(x, from) {
  same <- is.data.frame(x) && nrow(x) == nrow(from) && all(names(from) %in% names(x)) &&
    identical(x[["time_s"]], from[["time_s"]])
  if (same) return(x)
  attr(x, "estimate") <- NULL
  class(x) <- setdiff(class(x), "rot_estimate")
  x
}

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_estimate <- function(data, template) {
  attr(data, "estimate") <- attr(template, "estimate")
  class(data) <- class(template)
  reconstruct_estimate(data, template)
}

#' @export
motion_events.rot_estimate <- function(x, ...) {
  check_no_dots(...)
  check_estimate(x, "x", current_env())$events
}
