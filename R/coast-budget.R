# What the losses do: energy by mechanism, torque by speed, other laws, tests of the residuals.

#' Energy lost by mechanism
#'
#' Of the kinetic energy that a body lost from the first to the last sample of a run, the share of
#' each loss,
#' \deqn{s_j = p_j \int \omega^{j+1} dt \big/ \tfrac12 (\omega_0^2 - \omega_1^2)}{
#'   s_j = p_j int omega^(j+1) dt / ((omega0^2 - omega1^2)/2)}
#' with p the losses over the inertia. The shares of the values sum to 1. Their errors come from the
#' covariance of the fit; intervals are cut to 0 and 1. Where a torque acts as well, the energy is
#' what the losses took.
#'
#' @param fit A [fit_coast_down()].
#' @param ... Not used: an unknown argument is an error.
#' @param run Number or name of the run.
#' @return A tibble with a row for each loss and the columns
#'   `r describe_columns(c("loss", "share", "standard_error", "lower", "upper", "energy_j"))`
#'   `energy_j` where the inertia is known; without it `energy_over_inertia`, in (rad/s)^2.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [fit_coast_down()], [retarding_torque()].
#' @concept losses
#' @concept where the energy goes
#' @concept bearing
#' @examples
#' time_s <- 0:80 / 10
#' samples <- data.frame(time_s, omega_rad_per_s = 21 * exp(-0.1 * time_s) - 1)
#' loss_budget(fit_coast_down(samples, losses = c("coulomb", "viscous")))
#' @export
loss_budget <- function(fit, ..., run = 1) {
  call <- check_no_dots(...)
  check_supplied("fit", call)
  fit <- coast_fit(fit, "fit", call)
  i <- check_run(run, fit, call)
  at <- run_parameters(fit, i)
  of <- loss_energies(fit, i, at$p)
  total <- of$total
  share <- of$energy / total
  # d share = (d energy - share d total)/total
  d_share <- (of$d_energy - outer(share, of$d_total)) / total
  se <- band(d_share, at)
  half <- stats::qt((1 + fit$level) / 2, fit$runs[[i]]$dof) * se
  inertia <- coast_inertia(fit)
  out <- list(
    loss = fit$losses, share = share, standard_error = se,
    lower = pmin(pmax(0, share - half), share),
    upper = pmin(1, pmax(0, share + half))
  )
  if (is.na(inertia)) out$energy_over_inertia <- of$energy else out$energy_j <- of$energy * inertia
  new_table(lapply(out, unname), nrow = length(share))
}

# Energies over the inertia: of each loss, the total, and their derivatives.
loss_energies <- function(fit, i, p) {
  run <- fit$runs[[i]]
  from <- run$time_s[1]
  to <- run$time_s[length(run$time_s)]
  release <- p[["release"]]
  loaded <- any(run$problem$load != 0) || length(run$problem$step_s) > 0L
  changes <- c(run$problem$step_s, if (loaded) release)
  ends <- c(from, sort(changes[changes > from & changes < to]), to)
  ends[length(ends)] <- coast_end(fit, i, p, from, to)
  ends <- ends[c(TRUE, diff(ends) > 0)]
  rule <- gauss_rule()
  breaks <- unlist(lapply(seq_len(length(ends) - 1L), function(k) {
    seq(ends[k], ends[k + 1], length.out = 25)[-25]
  }))
  breaks <- c(breaks, ends[length(ends)])
  width <- diff(breaks)
  time <- rep(breaks[-length(breaks)], each = 12) + rep(width, each = 12) * rule$x
  weight <- rep(width, each = 12) * rule$weight
  rows <- motion_rows(fit, i, p, time)
  u <- abs(rows$omega)
  side <- sign(rows$omega)
  energy <- numeric()
  d_energy <- NULL
  for (loss in fit$losses) {
    j <- match(loss, coast_losses)
    whole <- sum(weight * u^j)
    slope <- p[[loss]] * j * colSums(weight * u^(j - 1) * side * rows$d_omega)
    slope[j + 2L] <- slope[j + 2L] + whole
    energy[loss] <- p[[loss]] * whole
    d_energy <- rbind(d_energy, slope)
  }
  if (loaded) {
    return(list(
      energy = energy, d_energy = d_energy, total = sum(energy), d_total = colSums(d_energy)
    ))
  }
  last <- motion_rows(fit, i, p, ends[length(ends)])
  d_total <- -last$omega * last$d_omega[1, ]
  d_total[2] <- d_total[2] + p[["omega0"]]
  list(
    energy = energy, d_energy = d_energy,
    total = (p[["omega0"]]^2 - last$omega^2) / 2, d_total = d_total
  )
}

# The end of the motion: the stop, where there is one within the run.
coast_end <- function(fit, i, p, from, to) {
  rests <- function(t) motion_rows(fit, i, p, t)$omega == 0
  low <- from
  high <- to
  if (!rests(to)) return(to)
  for (round in 1:12) {
    t <- seq(low, high, length.out = 33)
    first <- which(rests(t))[1]
    if (is.na(first) || first < 2L) break
    low <- t[first - 1]
    high <- t[first]
  }
  high
}

gauss_rule <- function() {
  x <- c(
    0.98156063424671925, 0.90411725637047486, 0.76990267419430469, 0.58731795428661745,
    0.36783149899818019, 0.12523340851146892
  )
  w <- c(
    0.047175336386511827, 0.10693932599531843, 0.16007832854334623, 0.20316742672306592,
    0.23349253653835481, 0.2491470458134028
  )
  list(x = 0.5 + c(-x, rev(x)) / 2, weight = c(w, rev(w)) / 2)
}

#' The retarding torque by speed
#'
#' The sum of the losses at an angular velocity, with its band. It is known well where the record
#' has samples, also where the single losses are not.
#'
#' @inheritParams loss_budget
#' @param omega_rad_per_s Speeds, >= 0; NULL for 25 over the range of the record.
#' @return A tibble with the columns
#'   `r describe_columns(c("omega_rad_per_s", "retarding_torque_n_m", "standard_error", "lower", "upper"))`
#'   Without an inertia `deceleration_rad_per_s2` takes the place of the torque.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [fit_coast_down()], [loss_budget()].
#' @concept friction torque
#' @concept braking torque
#' @concept deceleration
#' @examples
#' samples <- data.frame(time_s = 0:40 / 10, omega_rad_per_s = 10 - 0.5 * 0:40 / 10)
#' retarding_torque(fit_coast_down(samples, losses = "coulomb"), c(8, 9))
#' @export
retarding_torque <- function(fit, omega_rad_per_s = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("fit", call)
  fit <- coast_fit(fit, "fit", call)
  if (is.null(omega_rad_per_s)) {
    range <- speed_range(fit)
    omega_rad_per_s <- seq(range[1], range[2], length.out = 25)
  }
  omega_rad_per_s <- check_finite(omega_rad_per_s, "omega_rad_per_s", "rad/s", call)
  check_not_negative(omega_rad_per_s, "omega_rad_per_s", "rad/s", call)
  x <- shown_losses(fit)
  powers <- outer(omega_rad_per_s, match(fit$losses, coast_losses) - 1, `^`)
  value <- as.vector(powers %*% x$best)
  se <- band(powers, x)
  half <- stats::qt((1 + fit$level) / 2, min(x$dof)) * se
  out <- list(
    omega_rad_per_s = omega_rad_per_s, value = value, standard_error = se, lower = value - half,
    upper = value + half
  )
  names(out)[2] <-
    if (is.na(coast_inertia(fit))) "deceleration_rad_per_s2" else "retarding_torque_n_m"
  new_table(out, nrow = length(value))
}

# Smallest and largest speed while it turns.
speed_range <- function(fit) {
  speeds <- lapply(seq_along(fit$runs), function(i) {
    abs(motion_rows(fit, i, run_parameters(fit, i)$p, fit$runs[[i]]$time_s)$omega)
  })
  range(unlist(speeds))
}

#' Laws compared
#'
#' **A coast-down**: each combination of Coulomb, viscous and quadratic losses is fitted with the
#' noise that the law with all three leaves, and compared by Akaike's criterion for small samples
#' (AICc). It is advice: a law that another one beats by less than 4 is not excluded, and intervals
#' that follow from the selected law alone are too short. [fit_coast_down()] takes them from all
#' losses.
#'
#' **Fits of scenes** to the same samples, of one scene with more or fewer unknowns, or of several
#' scenes: the noise is that of the fit with the largest likelihood.
#'
#' @param fit A [fit_coast_down()], or a [fit_scene()].
#' @param ... Of a [fit_scene()]: others. Else not used: an unknown argument is an error.
#' @return A tibble with a row for each law, the best first, and the columns
#'   `r describe_columns(c("law", "parameters", "aicc_difference", "sigma", "relative_residual"))`
#'   the last but one of coast-downs, the last of scenes.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_argument` for fits of other samples,
#'   `rotdyn_error_value` for one that did not converge, `rotdyn_error_missing` for a single one.
#' @source Hurvich and Tsai, Biometrika 76, 297 (1989).
#' @seealso [fit_coast_down()], [fit_scene()].
#' @concept friction law
#' @concept model selection
#' @examples
#' time_s <- 0:80 / 10
#' set.seed(3)
#' samples <- data.frame(time_s, omega_rad_per_s = 21 * exp(-0.1 * time_s) - 1 + rnorm(81, 0, 0.02))
#' compare_laws(fit_coast_down(samples))
#' @export
compare_laws <- function(fit, ...) {
  if (missing(fit)) check_supplied("fit", current_env())
  UseMethod("compare_laws")
}

#' @export
compare_laws.default <- function(fit, ...) {
  check_class(fit, "rot_coast_fit", "fit", "Make one with {.fn fit_coast_down} or {.fn fit_scene}.",
              current_env())
}

#' @rdname compare_laws
#' @export
compare_laws.rot_coast_fit <- function(fit, ...) {
  call <- current_env()
  check_no_dots(...)
  fit <- coast_fit(fit, "fit", call)
  sets <- lapply(1:7, function(set) coast_losses[bitwAnd(set, c(1L, 2L, 4L)) > 0])
  with_losses <- function(problem, losses) {
    fitted <- stats::setNames(problem$fitted, coast_parameters)
    fitted[coast_losses] <- 0
    fitted[losses] <- 1
    problem$fitted <- unname(fitted)
    problem$start[!fitted & coast_parameters %in% coast_losses] <- 0
    problem
  }
  whole <- lapply(fit$runs, function(run) {
    unpack_run(.Call(ffi_coast_fit, with_losses(run$problem, coast_losses), 1), run$problem)
  })
  score <- function(losses) {
    parts <- vapply(seq_along(fit$runs), function(i) {
      problem <- with_losses(fit$runs[[i]]$problem, losses)
      problem$noise <- unname(whole[[i]]$numbers[c("tau_s", "white")])
      out <- .Call(ffi_coast_fit, problem, 0)
      n <- length(problem$time_s)
      squares <- out$bounded_numbers[1]
      c(n * log(squares / n), n, out$numbers[10] - length(losses), out$bounded_numbers[2])
    }, numeric(4))
    # The losses are shared; each run has its start and its sigma.
    k <- sum(parts[3, ]) + length(losses) + ncol(parts)
    n <- sum(parts[2, ])
    c(sum(parts[1, ]) + 2 * k * n / max(n - k - 1, 1), k - ncol(parts), max(parts[4, ]))
  }
  scores <- vapply(sets, score, numeric(3))
  order <- order(scores[1, ])
  as_table(
    law = vapply(sets, paste, "", collapse = " + ")[order],
    parameters = as.integer(scores[2, order]),
    aicc_difference = scores[1, order] - min(scores[1, ]),
    sigma = scores[3, order]
  )
}

#' Tests of a fit's residuals
#'
#' What would make the losses or their errors wrong: correlated residuals (the errors allow for
#' them), a correlation time at its cap or a loss clearly below 0 (the law is incomplete), an error
#' of the sensor that repeats every turn, runs that differ. What repeats every turn does not show in
#' one or two pulses a turn. The findings are those that the print of the fit names.
#'
#' Of a [fit_scene()] each observed column of each record is tested for: correlation; a law that
#' does not fit (a correlation time at its cap, or sums of residuals over windows of 4, 8, 16, ...
#' samples that chance does not explain), with the time at which residuals are largest; outliers
#' that were left out; and, where the noise was given, its size.
#'
#' @param fit A [fit_coast_down()], or a [fit_scene()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with a row for each test and run, and the columns
#'   `r describe_columns(c("run", "test", "statistic", "p_value", "finding"))`
#'   or `record` and `column` instead of `run`.
#' @section Errors: `rotdyn_error_type`.
#' @seealso [fit_coast_down()], [fit_scene()].
#' @concept autocorrelation
#' @concept white noise
#' @concept goodness of fit
#' @examples
#' samples <- data.frame(time_s = 0:40 / 10, omega_rad_per_s = 10 - 0.5 * 0:40 / 10)
#' residual_tests(fit_coast_down(samples, losses = "coulomb"))
#' @export
residual_tests <- function(fit, ...) {
  if (missing(fit)) check_supplied("fit", current_env())
  UseMethod("residual_tests")
}

#' @export
residual_tests.default <- function(fit, ...) {
  check_class(fit, "rot_coast_fit", "fit", "Make one with {.fn fit_coast_down} or {.fn fit_scene}.",
              current_env())
}

#' @rdname residual_tests
#' @export
residual_tests.rot_coast_fit <- function(fit, ...) {
  call <- current_env()
  check_no_dots(...)
  fit <- coast_fit(fit, "fit", call)
  below <- loss_below(fit)
  rows <- lapply(fit$runs, function(run) {
    x <- run$numbers
    p <- runout_p(run)
    watson <- durbin_watson(run$residual)
    law <- c(
      if (has_long_waves(run)) "waves longer than a tenth of the run",
      if (!is.null(below)) paste("without a bound the", below$loss, "loss is below 0")
    )
    data.frame(
      run = run$name,
      test = c("correlation", "wrong law", "runout"),
      statistic = c(x[["gain"]], x[["tau_s"]], x[["runout_f"]]),
      p_value = c(
        if (x[["gain"]] > 0) stats::pchisq(x[["gain"]], 2, lower.tail = FALSE) else NA_real_,
        NA_real_, p
      ),
      finding = c(
        if (x[["tau_s"]] > 0) {
          "correlated: the errors allow for it"
        } else if (are_alike(fit, watson)) {
          paste0("alike (Durbin-Watson ", format(watson, digits = 2), "): errors are too small")
        } else {
          "white"
        },
        if (length(law)) paste0("incomplete: ", paste(law, collapse = "; ")) else "none found",
        if (is.na(p)) {
          if (few_pulses(run)) "not testable: one or two pulses a turn" else "not tested"
        } else if (p < 0.01) {
          "repeats every turn"
        } else {
          "none found"
        }
      )
    )
  })
  out <- do.call(rbind, rows)
  if (length(fit$runs) > 1L) {
    p <- fit$pooled$p
    out <- rbind(out, data.frame(
      run = "all", test = "runs differ", statistic = fit$pooled$birge, p_value = p,
      finding = if (p < 0.05) "differ: a variance between runs is added" else "none found"
    ))
  }
  table_from(out)
}
