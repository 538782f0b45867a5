# Parameters of a run, as in src/core/measure/coast.h.
coast_parameters <- c(
  "theta0", "omega0", "coulomb", "viscous", "quadratic", "load", "release", "cos_1", "sin_1",
  "cos_2", "sin_2"
)
coast_losses <- c("coulomb", "viscous", "quadratic")
coast_waves <- coast_parameters[8:11]
# Units of a loss divided by the moment of inertia, and of the loss.
coast_units <- list(
  rate = c(coulomb = "rad/s^2", viscous = "1/s", quadratic = "1/rad"),
  torque = c(coulomb = "N m", viscous = "N m s", quadratic = "N m s^2")
)

#' Losses from a coast-down
#'
#' Fits the motion of a body that coasts down to measured angles, rates or pulses. With the moment
#' of inertia `I` about the axle
#' \deqn{I \dot\omega = -(\tau_c + c\,|\omega| + q\,\omega^2)\,\mathrm{sign}\,\omega + \tau}{
#'   I omega' = -(tau_c + c |omega| + q omega^2) sign(omega) + torque}
#' Without an inertia a record shows the losses over `I`: `tau_c/I` in rad/s^2, `c/I` in 1/s, `q/I`
#' in 1/rad.
#'
#' The exact solution and its exact derivatives are fitted by least squares (Gauss-Newton steps in a
#' trust region). The noise of the residuals is white, or white and an Ornstein-Uhlenbeck process,
#' whose correlation time and share are found by restricted likelihood (REML); standard errors are
#' those of the noise found. Where the size of white noise grows or falls over a run, samples weigh
#' by it. A correlation time is at most a tenth of the run: longer waves of the residuals are no
#' noise but a law that does not fit, and the print says so.
#'
#' **Intervals** are those of the fit with every loss asked for, without bounds, cut at 0; the value
#'   is the best one with no loss below 0. So the interval of a loss that is 0 begins at 0, and its
#'   value is often 0. `status` says in words what the record shows:
#' * *acts*: the interval excludes 0;
#' * *at most*: it includes 0, and `upper` is the limit;
#' * *not separable from* another loss: the two are correlated by more than 0.99, and the intervals
#'   of both include 0.
#'
#' Several runs, and the segments of a record, share the losses and have their own start and noise.
#' Where the runs differ by more than their errors, a variance between runs is added (for each loss,
#' by REML), and `glance()` gives the Birge ratio.
#'
#' @param records A [motion_record()], a data frame with `time_s` and one of `theta_rad`,
#'   `omega_rad_per_s` or `pulses`, or a list of them. Each segment is a run. Of several quantities
#'   measured the pulses are fitted, else the angles. A run begins while the body coasts.
#' @param inertia Moment of inertia about the axle in kg m^2: a number, [measured()], a body, or
#'   NULL. Its uncertainty is a common factor of all torques and is given apart, in `u_inertia`.
#' @param losses The losses that may act.
#' @param torque A torque that acts as well (positive towards positive angles) and needs an
#'   `inertia`: a constant one in N m, or a [torque law][torque_steps()] of time that is constant
#'   between its knots; or [falling_weight()].
#' @param runout `"test"` tests whether the sensor's error repeats every turn (first and second
#'   harmonic); `"fit"` fits it, `"none"` does neither.
#' @param ... Not used: an unknown argument is an error.
#' @param noise `"find"`, or `"white"` for uncorrelated residuals.
#' @param level Level of the intervals.
#' @return A tibble of class `rot_coast_fit` with a row for each loss and the columns
#'   `r describe_columns(c("loss", "value", "standard_error", "lower", "upper", "status", "unit", "u_inertia"), c(value = "the loss"))`
#'   in 1/s units without an inertia, in N m units with one
#'   (then with `u_inertia`). `glance()` gives one row, `augment()` the samples with the fitted
#'   motion, `predict()` the motion at any time and [as_scene()] the scene. Where the inertia, the
#'   mass or gravity was fitted, it is a row, too.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value` (a body at rest, one that speeds up),
#'   `rotdyn_error_size` (fewer samples than 3 more than what is fitted), `rotdyn_error_argument`
#'   (a torque without an inertia), `rotdyn_error_torque` (one that is not constant between jumps),
#'   `rotdyn_error_range` (no fit; times or values beyond 1e-60 to 1e60, an inertia whose
#'   square is no double).
#' @source Riccati's equation for the motion; Harville, J. Am. Stat. Assoc. 72, 320 (1977) for REML.
#' @seealso [loss_budget()], [retarding_torque()], [compare_laws()], [motion_record()].
#' @concept coast-down
#' @concept friction
#' @concept flywheel
#' @concept measurement
#' @examples
#' # A wheel of 0.0625 kg m^2, sampled 30 times a second, 5 mrad of noise.
#' wheel <- scene_axle(0.0625, NULL, resistance(0.006, 2e-4, 0.05), omega0_rad_per_s = 20)
#' samples <- trajectory(wheel, seq(0, 12, by = 1 / 30))
#' set.seed(1)
#' samples$theta_rad <- samples$theta_rad + rnorm(nrow(samples), 0, 0.005)
#' fit <- fit_coast_down(tibble::as_tibble(samples)[c("time_s", "theta_rad")], inertia = 0.0625)
#' fit
#' loss_budget(fit)
#' @export
fit_coast_down <- function(records, inertia = NULL, losses = c("coulomb", "viscous", "quadratic"),
                           torque = 0, runout = "test", ..., noise = "find", level = 0.95) {
  call <- check_no_dots(...)
  check_supplied("records", call)
  losses <- check_losses(losses, call)
  runout <- check_choice(runout, "runout", c("test", "fit", "none"), call)
  noise <- check_choice(noise, "noise", c("find", "white"), call)
  level <- check_level(level, call)
  if (!is.null(inertia)) {
    inertia <- as_measured(inertia, "inertia", "kg*m^2", call, lower = 0, open = TRUE)
    # Variances of torques have its square.
    square <- inertia$value^2
    if (!(square > .Machine$double.xmin && square < Inf)) {
      abort_rotdyn(c(
        "The square of {.arg inertia} is beyond double precision.",
        x = "The inertia is {format(inertia$value)} kg m^2.", i = "It is wanted in kg m^2."
      ), "range", call)
    }
  }
  load <- as_coast_load(torque, inertia, call)
  samples <- coast_samples(records, call)
  if (!length(samples)) {
    abort_rotdyn(c(
      "{.arg records} has no samples.", i = "A filter may have left none of its rows."
    ), "size", call)
  }
  runs <- lapply(seq_along(samples), function(i) {
    fit_run(samples[[i]], i, losses, load, inertia, runout, noise, call)
  })
  new_coast_fit(runs, losses, load, inertia, runout, noise, level, call)
}

check_losses <- function(losses, call) {
  bad <- if (is.character(losses)) setdiff(losses, coast_losses) else "?"
  if (!is.character(losses) || !length(losses) || length(bad)) {
    abort_rotdyn(c(
      "{.arg losses} must be among {.or {.val {coast_losses}}}.",
      x = "It is {describe_value(losses)}."
    ), if (is.character(losses)) "value" else "type", call)
  }
  coast_losses[coast_losses %in% losses]
}

# ---- torques that act as well --------------------------------------------------------------------

#' A weight that unwinds from a drum
#'
#' The spin-up before a coast-down, for [fit_coast_down()]: a mass hangs from a string that unwinds
#' from a drum of radius `r`, until it reaches the floor or the string ends:
#' \deqn{(I + m r^2)\,\dot\omega = m g r - \tau_r}{(I + m r^2) omega' = m g r - losses}
#' then the body coasts. One of inertia, mass and gravity is fitted: the inertia, where
#' [fit_coast_down()] has none; else what is NA here.
#'
#' @param mass_kg Mass, or NA if it is fitted.
#' @param radius_m Radius at which the string leaves the drum.
#' @param until_s Time at which the weight ceases to pull, or NULL if it is fitted.
#' @param gravity_m_per_s2 Acceleration of gravity, or NA if it is fitted.
#' @param ... Not used: an unknown argument is an error.
#' @return A `rot_falling_weight`.
#' @section Errors: `rotdyn_error_value`, `rotdyn_error_type`, `rotdyn_error_missing`.
#' @seealso [scene_hanging_mass()] for the motion.
#' @concept flywheel
#' @concept pulley
#' @concept moment of inertia by experiment
#' @examples
#' falling_weight(mass_kg = 0.5, radius_m = 0.02)
#' @export
falling_weight <- function(mass_kg, radius_m, until_s = NULL, gravity_m_per_s2 = 9.80665, ...) {
  call <- check_no_dots(...)
  check_supplied(c("mass_kg", "radius_m"), call)
  number <- function(x, arg, unit) {
    if (length(x) == 1L && is.atomic(x) && is.na(x)) return(NA_real_)
    check_number(x, arg, unit, call, lower = 0, open = TRUE)
  }
  x <- list(
    mass_kg = number(mass_kg, "mass_kg", "kg"),
    radius_m = check_number(radius_m, "radius_m", "m", call, lower = 0, open = TRUE),
    until_s = if (is.null(until_s)) NA_real_ else check_number(until_s, "until_s", "s", call),
    gravity_m_per_s2 = number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2")
  )
  structure(x, class = "rot_falling_weight")
}

falling_weight_form <- list(
  .class = "rot_falling_weight", mass_kg = "values:1", radius_m = "number", until_s = "values:1",
  gravity_m_per_s2 = "values:1"
)

#' @export
print.rot_falling_weight <- function(x, ...) {
  check_form(x, falling_weight_form, "x", "falling weight", current_env())
  or <- function(value, unit) if (is.na(value)) "fitted" else paste(format_si(value), unit)
  say(strwrap(paste0(
    "<rot_falling_weight> mass ", or(x$mass_kg, "kg"), ", drum ", or(x$radius_m, "m"),
    ", gravity ", or(x$gravity_m_per_s2, "m/s^2"), ", until ", or(x$until_s, "s")
  ), print_width() + 1L, exdent = 2L), sep = "\n")
  invisible(x)
}

# What acts besides the losses: kind ("none", "torque", "weight"), and what of it is fitted.
as_coast_load <- function(torque, inertia, call) {
  if (inherits(torque, "rot_falling_weight")) {
    check_form(torque, falling_weight_form, "torque", "falling weight", call)
    unknown <- c(
      if (is.null(inertia)) "inertia", if (is.na(torque$mass_kg)) "mass",
      if (is.na(torque$gravity_m_per_s2)) "gravity"
    )
    if (length(unknown) > 1L) {
      abort_rotdyn(c(
        "One of the inertia, the mass and gravity can be fitted, not {length(unknown)}.",
        x = "Unknown: {unknown}."
      ), "argument", call)
    }
    return(c(list(kind = "weight", unknown = unknown), unclass(torque)))
  }
  if (is.null(torque)) torque <- 0
  if (inherits(torque, "rot_torque")) {
    law <- as_torque(torque, call)
    pieces <- torque_steps_of(law, "torque", call)
  } else {
    law <- check_number(torque, "torque", "N*m", call)
    pieces <- list(time_s = double(), torque_n_m = law)
  }
  if (all(pieces$torque_n_m == 0)) return(list(kind = "none"))
  if (is.null(inertia)) {
    abort_rotdyn(c(
      "A {.arg torque} needs the {.arg inertia}: the record shows their ratio.",
      i = "Give {.arg inertia}, or the torque of a {.fn falling_weight}."
    ), "argument", call)
  }
  list(kind = "torque", law = law, pieces = pieces)
}

# ---- samples -------------------------------------------------------------------------------------

# Runs as lists of kind (0 angles, 1 rates, 2 pulses), times, values, name.
coast_samples <- function(records, call) {
  if (is.data.frame(records)) records <- list(records)
  if (!is.list(records) || !length(records)) {
    abort_rotdyn(c(
      "{.arg records} must be a record, or a list of records.",
      x = "It is {describe_value(records)}.",
      i = "Make one with {.fn motion_record}."
    ), "type", call)
  }
  out <- list()
  for (i in seq_along(records)) {
    record <- check_record(records[[i]], "records", call)
    measured <- intersect(c("pulses", "theta_rad", "omega_rad_per_s"), names(record))[1]
    value <- as.double(record[[measured]])
    per_turn <- if (measured == "pulses") record_info(record)$pulses_per_turn %||% 1
    if (measured == "pulses") value <- 2 * pi * value / per_turn
    kind <- match(measured, c("theta_rad", "omega_rad_per_s", "pulses")) - 1
    name <- names(records)[i]
    name <- if (is.null(name) || is.na(name) || !nzchar(name)) as.character(i) else name
    segments <- split(seq_along(value), record$segment)
    for (k in seq_along(segments)) {
      rows <- segments[[k]]
      rows <- rows[!is.na(value[rows])]
      if (kind != 2) rows <- rows[without_rest(value[rows])]
      out[[length(out) + 1L]] <- list(
        kind = kind, time_s = as.double(record$time_s)[rows], value = value[rows],
        name = if (length(segments) > 1L) paste0(name, ".", k) else name,
        pulses_per_turn = per_turn
      )
    }
  }
  out
}

# Equal values at the end, of a body at rest under an encoder, are one reading: without noise they
# would lessen the noise found. The first two of them stay.
without_rest <- function(value) {
  n <- length(value)
  same <- match(FALSE, rev(value) == value[n], nomatch = n + 1L) - 1L
  seq_len(if (same > 2L) n - same + 2L else n)
}

# ---- one run -------------------------------------------------------------------------------------

fit_run <- function(run, at, losses, load, inertia, runout, noise, call) {
  fitted <- stats::setNames(numeric(11), coast_parameters)
  fitted[c("omega0", losses)] <- 1
  if (run$kind != 1) fitted["theta0"] <- 1
  if (load$kind == "weight") {
    fitted[c("load", "release")] <- c(length(load$unknown), is.na(load$until_s))
  }
  if (runout == "fit") fitted[run_waves(run, call)] <- 1
  n <- length(run$time_s)
  check_turns_at_all(run, call)
  if (n > 0L) check_magnitudes(run$time_s, run$value, call)
  if (n < sum(fitted) + 3L) {
    abort_rotdyn(c(
      "Run {run$name} has too few samples.",
      x = "It has {n}; what is fitted needs {sum(fitted) + 3}."
    ), "size", call)
  }
  speeds <- run_speeds(run)
  check_moves(run, speeds, load, call)
  first <- run_start(run, speeds, load, inertia)
  problem <- list(
    kind = run$kind, time_s = run$time_s, value = run$value, fitted = unname(fitted),
    start = first$start, load = first$load, noise = c(0, 1),
    threshold = if (noise == "find") 2 else Inf,
    step_s = as.double(load$pieces$time_s),
    step_ratio = as.double(load$pieces$torque_n_m[-1] / (inertia$value %||% 1))
  )
  out <- .Call(ffi_coast_fit, problem, 1)
  if (!is_fitted_run(out)) {
    abort_rotdyn(c(
      "No coast-down fits run {run$name}.",
      i = "Leave out the rows in which the body is pushed, held or braked."
    ), "range", call)
  }
  c(run, run_with_growing_noise(problem, out), list(speeds = speeds))
}

is_fitted_run <- function(out) {
  out$numbers[1] == 0 && all(is.finite(c(out$p, out$covariance, out$bounded)))
}

# The run with weights for a noise whose s.d. grows or falls over it, as in fit_scene(): `trend`,
# its factor from the first sample to the last. Slow noise that does so, with the weights, too, may
# be a law that does not fit: it is said, and no sample weighs less.
run_with_growing_noise <- function(problem, out) {
  t <- problem$time_s
  y <- if (problem$kind == 2) t else problem$value
  trend <- 1
  for (round in 1:4) {
    slope <- trend_of(t, out$white, y - out$residual, y)
    if (slope == 0) break
    more <- problem
    more$weight <- exp(slope * (t - mean(t))) * (problem$weight %||% 1)
    trend <- more$weight[length(t)] / more$weight[1]
    again <- .Call(ffi_coast_fit, more, 1)
    if (!is_fitted_run(again) || again$numbers[2] > 0) break
    problem <- more
    out <- again
  }
  c(unpack_run(out, problem), list(trend = trend))
}

# The parts of a fit in C, by name.
unpack_run <- function(out, problem) {
  numbers <- stats::setNames(out$numbers, c(
    "status", "tau_s", "white", "gain", "logdet", "at_cap", "squares", "sigma", "condition", "free",
    "iterations", "runout_f", "runout_columns", "runout_1", "runout_2"
  ))
  list(
    problem = problem, p = stats::setNames(out$p, coast_parameters),
    covariance = matrix(out$covariance, 11, dimnames = list(coast_parameters, coast_parameters)),
    factor = matrix(out$factor, 11, byrow = TRUE, dimnames = list(coast_parameters, NULL)),
    best = stats::setNames(out$bounded, coast_parameters),
    numbers = numbers, residual = out$residual, dof = coast_dof(problem$time_s, numbers)
  )
}

coast_dof <- function(time_s, numbers) {
  n <- noise_dof(
    length(time_s), diff(range(time_s)), numbers[["tau_s"]], numbers[["white"]]
  )
  max(n - numbers[["free"]], 2)
}

# The harmonics of a turn that m pulses a turn show: those below m/2.
run_waves <- function(run, call) {
  per_turn <- run$pulses_per_turn %||% Inf
  if (per_turn > 4) return(coast_waves)
  if (per_turn > 2) return(coast_waves[1:2])
  abort_rotdyn(c(
    "{.arg runout} cannot be fitted to {per_turn} pulse{?s} a turn.",
    x = "What repeats every turn is the same at each of them.",
    i = "It takes three pulses a turn."
  ), "value", call)
}

few_pulses <- function(run) isTRUE(run$pulses_per_turn <= 2)

# Mean speeds in blocks of the run, with their standard errors as far as neighbours tell.
run_speeds <- function(run) {
  n <- length(run$time_s)
  blocks <- max(2L, min(8L, n %/% 4L))
  last <- (n * seq_len(blocks)) %/% blocks
  first <- c(1L, last[-blocks] + 1L)
  of_block <- function(i) {
    rows <- first[i]:last[i]
    t <- run$time_s[rows]
    y <- run$value[rows]
    middle <- sum(t) / length(t)
    if (run$kind == 1) return(c(sum(y) / length(y), length(y), middle))
    spread <- sum((t - middle)^2) # the slope of the angles by regression
    c(sum((t - middle) * y) / spread, spread, middle)
  }
  found <- vapply(seq_len(blocks), of_block, numeric(3))
  scatter <- 0
  if (run$kind == 1) {
    scatter <- stats::mad(diff(run$value)) / sqrt(2)
  } else if (run$kind == 0 && n > 3L) {
    gap <- diff(run$time_s)
    even <- abs(diff(gap)) <= 0.1 * gap[-1]
    if (any(even)) scatter <- stats::mad(diff(run$value, differences = 2L)[even]) / sqrt(6)
  }
  list(time_s = found[3, ], speed = found[1, ], error = scatter / sqrt(found[2, ]))
}

check_turns_at_all <- function(run, call) {
  value <- run$value
  if (!length(value) || any(value != value[1])) return(invisible())
  if (run$kind == 1 && value[1] != 0) {
    abort_rotdyn(c(
      "Run {run$name} does not slow down: all its samples are {format(value[1])} rad/s.",
      i = "A loss needs a record in which the rate changes by more than a digit."
    ), "value", call)
  }
  abort_rotdyn(c(
    "Run {run$name} is at rest: all its samples are {format(value[1])}.",
    i = "A coast-down needs a body that turns."
  ), "value", call)
}

check_moves <- function(run, speeds, load, call) {
  if (load$kind != "none") return(invisible())
  size <- abs(speeds$speed)
  k <- length(size)
  gain <- size[-1] - size[-k]
  error <- sqrt(speeds$error[-1]^2 + speeds$error[-k]^2)
  grows <- gain > 6 * error & gain > 0.05 * max(size)
  if (!any(grows)) return(invisible())
  i <- which(grows)[1]
  abort_rotdyn(c(
    "Run {run$name} does not coast: its speed grows.",
    x = "It is {format_si(size[i], 4)} rad/s about {format_si(speeds$time_s[i], 4)} s, and
         {format_si(size[i + 1], 4)} rad/s about {format_si(speeds$time_s[i + 1], 4)} s.",
    i = "Leave out the rows in which the body is driven, or give the {.arg torque} that drives it."
  ), "value", call)
}

# The rows in which a body turns by the first half of its way: of a long record most may be rest,
# which says nothing of the speed at the start.
half_turned <- function(run) {
  n <- length(run$time_s)
  path_rad <- if (run$kind == 1) {
    cumsum(c(0, diff(run$time_s) * (run$value[-1] + run$value[-n]) / 2))
  } else {
    run$value - run$value[1]
  }
  path_rad <- abs(path_rad)
  match(TRUE, path_rad >= max(path_rad) / 2, nomatch = n)
}

# Parameters to start from, and T/I, J/I, whether J/I is multiplied, of the load.
run_start <- function(run, speeds, load, inertia) {
  start <- numeric(11)
  names(start) <- coast_parameters
  n <- length(run$time_s)
  t <- run$time_s - run$time_s[1]
  part <- seq_len(min(n, max(6L, min(n %/% 3L, half_turned(run)))))
  start["load"] <- 1
  # Beyond the record: nothing is released.
  start["release"] <- run$time_s[n] + 1
  if (run$kind == 1) {
    slope <- stats::.lm.fit(cbind(1, t[part]), run$value[part])$coefficients
    start["omega0"] <- slope[1]
    change <- slope[2]
  } else {
    slope <- stats::.lm.fit(cbind(1, t[part], t[part]^2), run$value[part])$coefficients
    start[c("theta0", "omega0")] <- slope[1:2]
    change <- 2 * slope[3]
  }
  ratios <- c(0, 0, 0)
  if (load$kind == "none") {
    turns <- if (start[["omega0"]] < 0) -1 else 1
    # Half of what would stop it within the record: pulses need a body that turns.
    stops <- 0.5 * abs(start[["omega0"]]) / max(t[n], .Machine$double.xmin)
    start["coulomb"] <- max(0, -change * turns)
    if (run$kind == 2) start["coulomb"] <- min(start["coulomb"], stops)
  } else if (load$kind == "torque") {
    pieces <- load$pieces
    ratios <- c(pieces$torque_n_m[1] / inertia$value, 0, 0)
    now <- pieces$torque_n_m[findInterval(run$time_s[1], pieces$time_s) + 1L] / inertia$value
    start["coulomb"] <- max(0, now - change)
  } else {
    weight <- weight_start(run, speeds, load, inertia)
    ratios <- weight$ratios
    start[c("omega0", "coulomb", "release")] <- weight$start
  }
  list(start = unname(start), load = ratios)
}

# Spin-up and coast-down as straight lines of omega(t): their slopes give a first inertia (or mass,
# or gravity).
weight_start <- function(run, speeds, load, inertia) {
  t <- run$time_s
  n <- length(t)
  if (run$kind == 1) {
    omega <- run$value
    at <- t
  } else {
    wide <- max(1L, n %/% 40L)
    i <- seq_len(n - wide)
    omega <- (run$value[i + wide] - run$value[i]) / (t[i + wide] - t[i])
    at <- (t[i + wide] + t[i]) / 2
  }
  turns <- if (abs(max(omega)) >= abs(min(omega))) 1 else -1
  peak <- if (is.na(load$until_s)) at[which.max(turns * omega)] else load$until_s
  line <- function(rows) {
    if (sum(rows) < 2L) return(c(0, 0))
    stats::.lm.fit(cbind(1, at[rows] - t[1]), omega[rows])$coefficients
  }
  before <- line(at <= peak)
  after <- line(at > peak & turns * omega > 0.05 * max(turns * omega))
  up <- abs(before[2])
  down <- max(0, -turns * after[2])
  r <- load$radius_m
  g <- load$gravity_m_per_s2
  m <- load$mass_kg
  scales <- 1
  if (identical(load$unknown, "mass")) {
    m <- inertia$value * (up + down) / max(r * (g - r * up), 1e-3 * r * g)
  } else if (identical(load$unknown, "gravity")) {
    g <- ((inertia$value + m * r^2) * up + inertia$value * down) / (m * r)
    scales <- 0
  }
  moment <- if (is.null(inertia)) {
    m * r * max(g - r * up, 1e-3 * g) / max(up + down, 1e-12)
  } else {
    inertia$value
  }
  list(
    ratios = c(turns * m * g * r / moment, m * r^2 / moment, scales),
    start = c(before[1], down, peak)
  )
}
