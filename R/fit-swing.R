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
#' A^2} of \eqn{T_0^2}{T0^2}.
#'
#' **Free swings** are those in which no peak is higher than the one before, which are outside of
#' the part in which the amplitude grows, and whose period of small swings is that of the higher
#' ones, to 1.5 % (more where it scatters, at most 5 %). To the longest such interval the exact
#' motion is fitted,
#' \deqn{\ddot\theta = -\omega_0^2 \sin\theta - 2 \gamma \dot\theta
#'   - a\,\mathrm{sgn}\,\dot\theta - k \dot\theta |\dot\theta|}{
#'   theta'' = -omega0^2 sin(theta) - 2 gamma theta' - a sgn(theta') - k theta' |theta'|}
#' (theta instead of sin(theta) for a spring), with an offset of the sensor. The period is that of
#' the motion with no loss below 0. The losses are given without a bound, to first order about that
#' motion, so that their errors are those of not knowing which act: a loss that is absent comes out
#' within its error of 0, on either side. How fast the amplitude falls by all of them
#' (`decay_at_amplitude_per_s`) is known better than each. Where only one can act, name it: its
#' error is then several times smaller.
#'
#' **Errors**: the residuals of real records are correlated: noise with a correlation time and a
#' white part is estimated by restricted likelihood (REML), and the standard errors are those for
#' that noise; larger, where the residuals at frequencies around that of the swings exceed it.
#'
#' **The law is incomplete** where the residuals of the fit still show slow changes of phase or
#' amplitude, or another form of the swing, beyond the noise at frequencies around that of the
#' swings (an F test at 0.001), or where a loss would be below 0 by more than its error. The errors
#' then include what thirds of the interval differ by, where chance does not explain it. Where the
#' motion does not fit, to a tenth of its amplitude,
#' or there is less than one and a half swings, the median of the free swings (weighted
#' by the square of their amplitudes) is returned with the error of their scatter.
#'
#' A body that is driven is not free: a record without a free swing is refused, parts in which the
#' amplitude grows are reported, and so is an amplitude that does not decay.
#'
#' @param record A [motion_record()] with an angle or a rate.
#' @param restoring `"gravity"` for a pendulum, `"spring"` for a torsion pendulum.
#' @param ... Not used: an unknown argument is an error.
#' @param losses Losses to fit: any of `"viscous"`, `"quadratic"` (drag in air at high speed) and
#'   `"coulomb"` (dry friction), or `"none"`.
#' @param from_s,to_s The part of the record to use.
#' @param x A `rot_swing_fit`.
#' @return A list of class `rot_swing_fit`:
#'   * `period_s`: the period of small swings \eqn{T_0 = 2\pi/\omega_0}{T0 = 2 pi/omega0}, a
#'     [measured()] number;
#'   * `omega0_rad_per_s`, `omega_rad_per_s` (with damping, \eqn{\sqrt{\omega_0^2 - \gamma^2}}{
#'     sqrt(omega0^2 - gamma^2)}, by the gamma of the motion), `decay_per_s` (gamma),
#'     `coulomb_rad_per_s2` (a), `quadratic_per_rad` (k): measured numbers from the fit, NULL where
#'     there is none or the loss was not fitted; a loss may be below 0 within its error;
#'   * `decay_at_amplitude_per_s`: the rate at which the amplitude falls by all losses, at the root
#'     mean square of the amplitudes, to first order: \eqn{\gamma + 4 k \omega_0 A/(3 \pi) +
#'     2 a/(\pi \omega_0 A)}{gamma + 4 k omega0 A/(3 pi) + 2 a/(pi omega0 A)};
#'   * `law_complete`, and `law_p`, the probability that a complete law leaves such residuals (NA
#'     for exact data and short records);
#'   * `swings`: a tibble of `segment`, `time_s`, `period_s`, `amplitude_rad`, `period0_s`, `used`;
#'   * `damping`: the losses from the heights of the peaks alone, by the names above, or NULL with
#'     fewer than five peaks or fewer than three more than what is fitted;
#'   * `amplitude_rad`: the largest of the swings used; `offset`, `residual` (root mean square),
#'     `durbin_watson`, `correlation_time_s`, `white_u` (the standard error of omega0 if the noise
#'     were white), `from` (`"fit"` or `"swings"`), `restoring`, `losses`, `notes`, `samples` (those
#'     of the interval) and `motion` (the fitted motion, its losses at least 0).
#' @section Errors: `rotdyn_error_size` where fewer than three passages are found,
#'   `rotdyn_error_value` also for a pendulum with amplitudes beyond pi (degrees?) and for a record
#'   without a free swing, `rotdyn_error_range` for times or values beyond 1e-60 to 1e60,
#'   `rotdyn_error_type`, `rotdyn_error_missing`, `rotdyn_error_argument`, and
#'   those of [motion_record()].
#' @source Borwein and Borwein, Pi and the AGM (1987), section 1.1; for the noise Harville, J. Am.
#'   Stat. Assoc. 72, 320 (1977).
#' @seealso [inertia_torsion()] for the moment of inertia, [pool_periods()] for hand timing,
#'   [period_of()] for the period of a scene.
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
fit_swing <- function(record, restoring = c("gravity", "spring"), ...,
                      losses = c("viscous", "quadratic", "coulomb"), from_s = -Inf, to_s = Inf) {
  call <- check_no_dots(...)
  check_supplied("record", call)
  restoring <- check_choice(restoring, "restoring", c("gravity", "spring"), call)
  kinds <- c(swing_losses, "none")
  if (!is.character(losses) || !length(losses) || anyNA(losses) || !all(losses %in% kinds) ||
    ("none" %in% losses && length(losses) > 1L)) {
    abort_rotdyn(c(
      "{.arg losses} must be among {.val {kinds}}.", x = "It is {describe_value(losses)}."
    ), "value", call)
  }
  limits <- c(check_limit(from_s, "from_s", call), check_limit(to_s, "to_s", call))
  swing_fit_of(record, "record", restoring, losses, limits, call)
}

# Errors are those of the function that was called.
swing_fit_of <- function(record, arg, restoring, losses, limits, call) {
  record <- check_record(record, arg, call, c("theta_rad", "omega_rad_per_s"))
  kind <- if ("theta_rad" %in% names(record)) "theta_rad" else "omega_rad_per_s"
  keep <- is.finite(record[[kind]]) & record$time_s >= limits[1] & record$time_s <= limits[2]
  data <- data.frame(
    time = as.double(record$time_s[keep]), y = as.double(record[[kind]][keep]),
    segment = record$segment[keep]
  )
  if (nrow(data)) check_magnitudes(data$time, data$y, call)
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
  swings <- do.call(rbind, lapply(parts, function(part) {
    grows <- part$grows %||% c(Inf, -Inf)
    part$swings$driven <- part$swings$time_s > grows[1] & part$swings$time_s < grows[2]
    part$swings
  }))
  check_amplitudes(swings, kind, restoring, call)
  swings <- choose_free(swings, restoring)
  if (!any(swings$sound, na.rm = TRUE)) {
    abort_rotdyn(c(
      "The record has no whole swing with samples at its passages and peaks.",
      x = "Of {nrow(swings)} swing{?s}, all have a gap at a passage, or a peak without a sample.",
      i = "Swings need some ten samples each."
    ), "size", call)
  }
  if (!any(swings$used)) abort_driven(swings, call)
  grows <- do.call(rbind, lapply(parts, `[[`, "grows"))
  best <- longest_interval(swings)
  # A part of a swing before the first passage and after the last belongs to the interval.
  own <- range(data$time[data$segment == best$segment])
  if (best$from - own[1] < 0.5 * best$period) best$from <- own[1]
  if (own[2] - best$to < 0.5 * best$period) best$to <- own[2]
  part <- parts[[match(best$segment, vapply(parts, function(p) p$swings$segment[1], 0))]]
  damping <- peak_damping(best, swings, kind, restoring, losses)
  rows <- data$segment == best$segment & data$time >= best$from & data$time <= best$to
  time <- data$time[rows]
  y <- data$y[rows]
  start <- first_parameters(time, kind, restoring, losses, best, part, swings)
  fit <- fit_free_motion(time, y, kind, restoring, losses, best, start)
  if (!is.null(fit)) fit <- judge_law(fit, time, y, kind, restoring, losses, best, part, swings)
  new_swing_fit(swings, fit, damping, list(
    kind = kind, restoring = restoring, losses = intersect(swing_losses, losses), grows = grows,
    time = time, y = y, best = best
  ))
}

abort_driven <- function(swings, call) {
  sound <- swings[swings$sound, ]
  abort_rotdyn(c(
    "The record has no free swing: a period is that of the body only where nothing drives it.",
    x = if (any(sound$driven)) {
      "Its amplitude grows from {format_si(min(sound$first[sound$driven]), 3)} to
       {format_si(max(sound$second[sound$driven]), 3)}."
    } else {
      "No swing follows the one before with a lower peak and the same period of small swings."
    },
    i = "{.arg from_s} and {.arg to_s} choose the part that swings freely."
  ), "value", call)
}

# Parameters to begin with: the state at the first sample from the phase since a passage.
first_parameters <- function(time, kind, restoring, losses, best, part, swings) {
  omega0 <- 2 * pi / best$period0
  first <- which(part$passages >= best$from - 1e-9 * best$period)[1]
  slope <- sign(part$peaks[first] - 0)
  # At the first passage of the interval theta (of a rate: omega) is 0. From there to the first
  # sample without losses: backward in time theta (of a rate: omega) has the other sign.
  angle <- kind == "theta_rad"
  peak <- if (angle) abs(part$peaks[first]) else NA
  amplitude <- if (isTRUE(peak > 0)) peak else best$amplitude
  if (restoring != "spring") amplitude <- min(amplitude, 3.1)
  speed <- omega0 * if (restoring == "spring") amplitude else 2 * sin(amplitude / 2)
  passage <- slope * if (angle) c(0, speed) else c(-amplitude, 0)
  since <- time[1] - part$passages[first]
  state <- vapply(c("theta_rad", "omega_rad_per_s"), function(what) {
    free_motion(c(passage, omega0, 0, 0, 0, 0), abs(since), 0, what, restoring)$value %||% NA_real_
  }, 0)
  if (anyNA(state)) {
    state <- passage
  } else if (since < 0) {
    state <- state * if (angle) c(-1, 1) else c(1, -1)
  }
  state <- unname(state)
  p <- c(state, omega0, 0, 0, 0, part$centre)
  heights <- swings$amplitude_rad[best$rows]
  if (length(heights) > 1L && length(losses) && losses[1] != "none") {
    rate <- -stats::coef(stats::lm(log(heights) ~ swings$time_s[best$rows]))[[2]]
    rate <- min(max(rate, 0), 0.3 * omega0)
    loss <- intersect(swing_losses, losses)[1]
    middle <- stats::median(heights)
    p[3 + match(loss, swing_losses)] <- switch(loss,
      viscous = rate, coulomb = rate * pi * omega0 * middle / 2,
      quadratic = rate * 3 * pi / (4 * omega0 * middle)
    )
  }
  p
}

# The verdict. Where residuals show another law, thirds of the interval show by how much what is
# fitted depends on the part; where they do so for half a swing and by 2 %, nothing is fitted.
judge_law <- function(fit, time, y, kind, restoring, losses, best, part, swings) {
  below <- intersect(rownames(fit$covariance), swing_losses)
  score <- fit$p[below] / sqrt(diag(fit$covariance)[below])
  limit <- stats::qt(0.9995, fit$dof)
  fit$below <- if (!fit$exact) below[score < -limit]
  wrong <- isTRUE(fit$law_p < 0.001)
  fit$complete <- !wrong && !length(fit$below)
  fit$reasons <- c(
    if (wrong) paste0(
      "phase, amplitude or form of the swings differ from it (p = ",
      format(fit$law_p, digits = 1), ")"
    ),
    if (length(fit$below)) paste("without a bound the", fit$below[1], "loss would be below 0")
  )
  if (fit$complete) return(fit)
  slow <- wrong || fit$noise[["tau_s"]] > best$period / 2
  if (slow && fit$rms > 0.02 * fit$size) return(NULL)
  fit$between <- between_thirds(fit, time, y, kind, restoring, losses, best)
  add <- names(fit$between)
  diag(fit$covariance)[add] <- diag(fit$covariance)[add] + fit$between
  if (any(fit$between > 0)) fit$dof <- min(fit$dof, 2)
  fit
}

# The variance of the mean of thirds beyond that of their errors, where chance does not explain it.
between_thirds <- function(fit, time, y, kind, restoring, losses, best) {
  names <- c("omega0", intersect(rownames(fit$covariance), swing_losses))
  cuts <- time[1] + (time[length(time)] - time[1]) * 0:3 / 3
  parts <- lapply(1:3, function(i) {
    rows <- time >= cuts[i] & time <= cuts[i + 1]
    if (sum(rows) < 12L || cuts[2] - cuts[1] < 1.5 * best$period) return(NULL)
    model <- swing_model(time[rows], time[1], kind, restoring, best)
    active <- match(rownames(fit$covariance), swing_parameters)
    third <- least_squares(model, y[rows], unname(fit$p), active)
    if (is.null(third)) return(NULL)
    settle(time[rows], y[rows], third$p, active, fit$noise, model, 1L)
  })
  # Too short for thirds: the fit's own error, tenfold.
  if (any(vapply(parts, is.null, NA))) return(99 * diag(fit$covariance)[names])
  values <- vapply(parts, function(part) {
    stats::setNames(part$p, swing_parameters)[names]
  }, double(length(names)))
  errors <- vapply(parts, function(part) {
    out <- stats::setNames(rep(NA_real_, 7), swing_parameters)
    out[part$active] <- diag(part$covariance)
    out[names]
  }, double(length(names)))
  values <- matrix(values, length(names))
  errors <- matrix(errors, length(names))
  scatter <- apply(values, 1, stats::var)
  inner <- rowMeans(errors, na.rm = TRUE)
  # 3 is the 95 % point of chi^2/2.
  between <- ifelse(scatter > 3 * inner, (scatter - inner) / 3, 0)
  stats::setNames(ifelse(is.finite(between), between, 0), names)
}

# ---- the result ---------------------------------------------------------------------------------

new_swing_fit <- function(swings, fit, damping, about) {
  used <- swings[swings$used, ]
  out <- list(
    omega0_rad_per_s = NULL, omega_rad_per_s = NULL, decay_per_s = NULL, coulomb_rad_per_s2 = NULL,
    quadratic_per_rad = NULL, decay_at_amplitude_per_s = NULL
  )
  amplitude <- sqrt(mean(used$amplitude_rad^2))
  if (is.null(fit)) {
    period <- period_of_swings(used, damping)
  } else {
    u <- sqrt(diag(fit$covariance))
    correlation <- fit$covariance / outer(u, u)
    correlation[!is.finite(correlation)] <- 0
    u["omega0"] <- max(u["omega0"], fit$floor)
    numbers <- measured_jointly(fit$p, u, correlation, fit$dof)
    out$omega0_rad_per_s <- numbers$omega0
    period <- 2 * pi / numbers$omega0
    period$name <- "period"
    for (loss in intersect(about$losses, names(numbers))) {
      out[[swing_parts[[loss]]]] <- numbers[[loss]]
    }
    omega <- numbers$omega0
    # By the loss of the motion: the square of one without a bound is a bias.
    if (!is.null(numbers$viscous) && fit$best[["viscous"]] > 0) {
      viscous <- numbers$viscous
      viscous$value <- fit$best[["viscous"]]
      omega <- sqrt(numbers$omega0^2 - viscous^2)
    }
    omega$name <- "omega"
    out$omega_rad_per_s <- omega
    out$decay_at_amplitude_per_s <- decay_at(numbers, amplitude, about$losses)
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
      correlation_time_s = if (is.null(fit)) NA_real_ else fit$noise[["tau_s"]],
      white_u = if (is.null(fit)) NA_real_ else fit$white,
      law_complete = if (is.null(fit)) FALSE else fit$complete,
      law_p = if (is.null(fit)) NA_real_ else fit$law_p,
      from = if (is.null(fit)) "swings" else "fit", kind = about$kind,
      restoring = about$restoring, losses = about$losses,
      notes = as.character(swing_notes(swings, fit, out, about, amplitude)),
      samples = as_table(time_s = about$time, measured = about$y),
      motion = if (!is.null(fit)) {
        list(
          p = unname(fit$best), active = as.double(fit$best_active),
          covariance = as.double(fit$best_covariance), dof = fit$dof
        )
      }
    )),
    class = "rot_swing_fit"
  )
}

# The error of a passage counts less in a high swing. Neighbours share passages and drift: their
# correlation reduces the number of independent ones.
period_of_swings <- function(used, damping) {
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
  new_measured(mean * shrink, u, max(independent - 1, 1), "period")
}

# The rate at which an amplitude falls, by all losses together, to first order in them.
decay_at <- function(numbers, amplitude, losses) {
  parts <- list(
    viscous = numbers$viscous,
    quadratic = if (!is.null(numbers$quadratic)) {
      numbers$quadratic * (4 * numbers$omega0$value * amplitude / (3 * pi))
    },
    coulomb = if (!is.null(numbers$coulomb)) {
      numbers$coulomb * (2 / (pi * numbers$omega0$value * amplitude))
    }
  )
  parts <- Filter(Negate(is.null), parts)
  if (!length(parts)) return(NULL)
  sum <- Reduce(`+`, parts)
  sum$name <- "decay"
  sum
}

swing_notes <- function(swings, fit, out, about, amplitude) {
  grows <- about$grows
  together <- out$decay_at_amplitude_per_s
  c(
    if (is.null(fit)) paste(
      "the law is incomplete: no free motion fits (driven, braked, or another law); the period is",
      "the median of the swings, with the error of their scatter"
    ),
    if (!is.null(fit) && !fit$complete) {
      paste0("the law is incomplete: ", paste(fit$reasons, collapse = "; "))
    },
    if (any(fit$between > 0)) "the errors include what thirds of the interval differ by",
    if (length(grows)) paste0(
      "the amplitude grows from ", format_si(grows[1, 1], 4), " to ", format_si(grows[1, 2], 4),
      " s: there the body is driven, not free"
    ),
    if (!is.null(together) && together$value < 3 * together$u) paste(
      "the amplitude does not decay beyond its error: a body that is driven steadily looks the",
      "same, and has the period of its drive"
    ),
    inseparable_losses(fit)
  )
}

# Losses that only act together in this record.
inseparable_losses <- function(fit) {
  if (is.null(fit)) return(NULL)
  losses <- intersect(swing_losses, rownames(fit$covariance))
  if (length(losses) < 2L || fit$exact) return(NULL)
  u <- sqrt(diag(fit$covariance)[losses])
  r <- correlations(fit$covariance[losses, losses])
  weak <- fit$p[losses] < stats::qt(0.975, fit$dof) * u
  pair <- which(upper.tri(r) & abs(r) > 0.95 & outer(weak, weak, `|`), arr.ind = TRUE)
  if (!nrow(pair)) return(NULL)
  names <- losses[sort(unique(as.vector(pair)))]
  paste0(
    "this record does not separate ", paste(names, collapse = ", "),
    ": `losses` names those that can act"
  )
}

weighted_median <- function(x, weight) {
  order <- order(x)
  below <- cumsum(weight[order]) - weight[order] / 2
  if (length(x) < 2L) return(x)
  stats::approx(below, x[order], sum(weight) / 2, rule = 2, ties = "ordered")$y
}

# Numbers with a joint covariance, as combinations of independent parts.
measured_jointly <- function(value, u, correlation, dof) {
  names <- names(u)
  k <- length(u)
  root <- correlation_root(correlation)
  id <- vapply(seq_len(k), function(i) new_identity(), "")
  out <- lapply(seq_len(k), function(i) {
    measured_from_parts(value[[names[i]]], data.frame(
      id = id, name = names, u = u[[i]] * root[i, ], dof = dof, group = id[1]
    ), names[i])
  })
  stats::setNames(out, names)
}

swing_fit_form <- list(
  .class = "rot_swing_fit", restoring = "text", kind = "text", from = "text", notes = "texts",
  losses = "texts", damping = "list?", residual = "values:1", correlation_time_s = "values:1",
  white_u = "values:1", law_complete = "flag", law_p = "values:1", amplitude_rad = "values:1",
  durbin_watson = "values:1", offset = "values:1",
  swings = list(
    time_s = "numbers", period_s = "values=time_s", amplitude_rad = "values=time_s",
    period0_s = "values=time_s", used = "flags=time_s"
  ),
  samples = list(time_s = "sorted", measured = "numbers=time_s"),
  motion = list(
    .optional = TRUE, p = "numbers:7", active = "numbers", covariance = "numbers", dof = "number"
  )
)

check_swing_fit <- function(x, arg, call) {
  check_class(x, "rot_swing_fit", arg, "Make one with {.fn fit_swing}.", call)
  check_form(x, swing_fit_form, arg, "fit of a swing", call)
  check_measured(x$period_s, arg, call)
  losses <- unname(swing_parts)
  names <- c("omega0_rad_per_s", "omega_rad_per_s", "decay_at_amplitude_per_s", losses)
  for (part in c(x[names], x$damping[losses])) {
    if (!is.null(part)) check_measured(part, arg, call)
  }
  fitted <- x$from == "fit"
  motion <- x$motion
  ok <- fitted == !is.null(motion) && length(x$samples$time_s) > 0L &&
    (!fitted || !is.null(x$omega0_rad_per_s) && !is.null(x$omega_rad_per_s)) &&
    (is.null(motion) || all(motion$active %in% 1:7) && motion$p[3] > 0 &&
      length(motion$covariance) == length(motion$active)^2) &&
    (is.null(x$damping) || all(vapply(x$damping, inherits, NA, "rot_measured")))
  if (!ok) abort_form("", arg, "fit of a swing", call)
  x
}

# A loss that may be 0 is only limited from above.
print_loss <- function(name, x, unit) {
  if (is.null(x)) return(invisible())
  half <- stats::qt(0.975, x$dof) * x$u
  print_field(name, paste(if (x$value > half) format(x) else {
    paste("at most", format_si(max(x$value, 0) + half, 2))
  }, unit))
}

#' @rdname fit_swing
#' @export
print.rot_swing_fit <- function(x, ...) {
  check_swing_fit(x, "x", current_env())
  used <- sum(x$swings$used)
  shown <- x$swings$amplitude_rad[if (used) x$swings$used else TRUE]
  say(
    "<rot_swing_fit> ", if (x$restoring == "gravity") "a pendulum" else "an oscillator", ", ",
    used, " free swings of ", nrow(x$swings), ", amplitudes ",
    paste(format_si(range(shown), 3), collapse = " to "),
    " rad\n"
  )
  print_field("period", paste0(format(x$period_s), " s of small swings"))
  if (x$from == "fit") {
    print_field("omega", paste0(
      format(x$omega_rad_per_s), " rad/s",
      if (x$restoring == "gravity") " of small swings, with damping" else ", with damping"
    ))
    print_loss("viscous", x$decay_per_s, "1/s")
    print_loss("quadratic", x$quadratic_per_rad, "1/rad")
    print_loss("coulomb", x$coulomb_rad_per_s2, "rad/s^2")
    together <- x$decay_at_amplitude_per_s
    if (length(x$losses) > 1L && !is.null(together)) {
      print_field("together", paste0(
        format(together), " 1/s at ",
        format_si(sqrt(mean(x$swings$amplitude_rad[x$swings$used]^2)), 3), " rad"
      ))
    }
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
  if (length(d)) {
    units <- c(decay_per_s = "1/s", coulomb_rad_per_s2 = "rad/s^2", quadratic_per_rad = "1/rad")
    words <- names(swing_parts)[match(names(d), swing_parts)]
    print_field("peaks", paste0(
      words, " ", vapply(d, format, ""), " ", units[names(d)], collapse = ", "
    ))
  }
  for (note in x$notes) print_field("note", note)
  invisible(x)
}
