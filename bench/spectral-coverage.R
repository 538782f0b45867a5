# How well the error figure of axle_spectral covers the true error: random smooth scenes, against
# the integrator rk8pd at 1e-13. With the package installed:
#
#   Rscript bench/spectral-coverage.R         1000 scenes, some minutes
#   Rscript bench/spectral-coverage.R 200     fewer
#
# Prints, for each accuracy, the share of scenes where the true error is at most what was reported,
# the median of reported / true, and the calls of the torque function beside rk8pd's at its own.

library(rotdyn)

between <- function(low, high) stats::runif(1, low, high)

# list(law, theta0, omega0, span, viscous)
random_scene <- function(kind) {
  a <- between(0.5, 9)
  b <- between(0, 1)
  w <- between(0.3, 3)
  mu <- between(0.2, 3)
  c <- between(0.001, 0.2)
  switch(kind,
    pendulum = list(
      law = function(t, theta, omega) -a * sin(theta) - c * omega,
      theta0 = between(-2.9, 2.9), omega0 = 0, span = between(2, 20)
    ),
    "van der Pol" = list(
      law = function(t, theta, omega) mu * (1 - theta^2) * omega - theta + b * cos(w * t),
      theta0 = between(-2, 2), omega0 = between(-1, 1), span = between(2, 20)
    ),
    fan = list(
      law = function(t, theta, omega) a * (1 + 0.3 * sin(2 * theta)) - c * omega^2,
      theta0 = 0, omega0 = between(0.5, 3), span = between(1, 8)
    ),
    Duffing = list(
      law = function(t, theta, omega) theta - theta^3 - c * omega + 0.3 * b * cos(w * t),
      theta0 = between(-1.5, 1.5), omega0 = between(-1, 1), span = between(2, 20)
    ),
    oscillator = list(
      law = function(t, theta, omega) -a * theta - c * omega + b * sin(w * t),
      theta0 = between(-1, 1), omega0 = between(-1, 1), span = between(2, 30)
    ),
    rotor = list(
      law = function(t, theta, omega) a * sin(w * t - theta) - c * omega,
      theta0 = between(-1, 1), omega0 = between(-2, 2), span = between(2, 15)
    ),
    logistic = list(
      law = function(t, theta, omega) omega * (1 - omega / a) + b * exp(-t),
      theta0 = 0, omega0 = between(0.1, 1), span = between(2, 15)
    )
  )
}

kinds <- c("pendulum", "van der Pol", "fan", "Duffing", "oscillator", "rotor", "logistic")

# A row for each accuracy; none where the reference itself is not good enough.
try_scene <- function(kind, accuracies) {
  drawn <- random_scene(kind)
  scene <- scene_axle(
    1, torque_function(drawn$law, breaks_s = numeric()),
    theta0_rad = drawn$theta0, omega0_rad_per_s = drawn$omega0
  )
  t <- seq(0, drawn$span, length.out = 101)
  truth <- trajectory(scene, t, 1e-13, model = "axle_rk8pd")
  known <- attr(truth, "run")$info
  do.call(rbind, lapply(accuracies, function(accuracy) {
    motion <- trajectory(scene, t, accuracy)
    run <- attr(motion, "run")
    off <- max(
      abs(motion$theta_rad - truth$theta_rad) / known$theta_max,
      abs(motion$omega_rad_per_s - truth$omega_rad_per_s) / known$omega_max
    )
    data.frame(
      kind = kind, accuracy = accuracy, model = run$model, off = off, said = run$info$error,
      bar = known$error, calls = run$info$rhs_calls, tolerance = run$info$tolerance
    )
  }))
}

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args)) as.integer(args[1]) else 1000L
set.seed(20)
accuracies <- 10^-c(3, 5, 7, 9, 11, 12)
rows <- suppressWarnings(do.call(
  rbind, lapply(rep_len(kinds, scenes), try_scene, accuracies = accuracies)
))
rows$covered <- rows$off <= rows$said + rows$bar
rows$kept <- rows$off <= rows$accuracy + rows$bar

# Ratios count only where the reference can tell.
summarise <- function(x) {
  told <- x$off > 3 * x$bar
  data.frame(
    runs = nrow(x),
    spectral = mean(x$model == "axle_spectral"),
    covered = mean(x$covered),
    within_accuracy = mean(x$kept),
    said_over_true = if (any(told)) stats::median((x$said / x$off)[told]) else NA,
    median_calls = stats::median(x$calls)
  )
}
table_by <- function(name) {
  parts <- split(rows, rows[[name]])
  print(do.call(rbind, lapply(parts, summarise)), digits = 3)
}
table_by("accuracy")
table_by("kind")
cat("all:", mean(rows$covered), "covered\n")
worst <- rows[rows$model == "axle_spectral", ]
worst <- worst[order(-(worst$off - worst$bar) / worst$said), ]
print(utils::head(worst, 12), digits = 3)
