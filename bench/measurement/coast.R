# Coverage of the intervals of fit_coast_down(): simulated coast-downs whose losses are known.
#
#   Rscript bench/measurement/coast.R [records] [seed]
#
# A line for each design: the share of intervals at 95 % that hold the true loss (Coulomb, viscous,
# quadratic), the bounds asked for, and the verdict. For some a line to compare. White noise: .92 to
# .98; correlated: .89 to .98. With fewer than 500 records the bounds are wider by two standard
# errors of the share.

library(rotdyn)
arguments <- commandArgs(TRUE)
records <- if (length(arguments) > 0L) as.integer(arguments[1]) else 500L
seed <- if (length(arguments) > 1L) as.integer(arguments[2]) else 20261L

law <- c(coulomb = 0.5, viscous = 0.06, quadratic = 0.003)
scene <- function(p) {
  scene_axle(1, NULL, resistance(p[[2]], p[[3]], p[[1]]), omega0_rad_per_s = 20)
}
stop_s <- stopping(scene(law))$stop_time_s

# Unit variance: "white", AR(1) with a coefficient, or half white and half slow (0.3 s).
noise <- function(kind, n, dt) {
  ar <- function(rho) {
    e <- stats::rnorm(n) * sqrt(1 - rho^2)
    e[1] <- stats::rnorm(1)
    as.vector(stats::filter(e, rho, "recursive"))
  }
  switch(kind,
    white = stats::rnorm(n), ar5 = ar(0.5), ar9 = ar(0.9),
    mixed = sqrt(0.5) * stats::rnorm(n) + sqrt(0.5) * ar(exp(-dt / 0.3))
  )
}

design <- function(name, what, end, n, sigma, kind = "white", p = law, per_turn = 1) {
  list(name = name, what = what, end = end, n = n, sigma = sigma, kind = kind, p = p,
       per_turn = per_turn)
}
full <- 0.95 * stop_s
designs <- list(
  design("full, 100 angles", "angle", full, 100, 0.005),
  design("full, 1000 angles", "angle", full, 1000, 0.005),
  design("4 s, 100 angles", "angle", 4, 100, 0.005),
  design("4 s, 1000 angles", "angle", 4, 1000, 0.005),
  design("4 s, 200 angles, after BIC", "angle", 4, 200, 0.005),
  design("full, 100 rates", "rate", full, 100, 0.02),
  design("4 s, 1000 rates", "rate", 4, 1000, 0.02),
  design("full, pulses, 1 a turn", "pulse", full, NA, 5e-4),
  design("4 s, pulses, 4 a turn", "pulse", 4, NA, 2e-4, per_turn = 4),
  design("stop inside, 400 angles", "angle", 1.2 * stop_s, 400, 0.005),
  design("no quadratic, 400 angles", "angle", 8, 400, 0.005, p = replace(law, 3, 0)),
  design("8 s, 400 angles, AR(1) 0.5", "angle", 8, 400, 0.005, "ar5"),
  design("8 s, 400 angles, AR(1) 0.9", "angle", 8, 400, 0.005, "ar9"),
  design("8 s, 400 angles, half slow", "angle", 8, 400, 0.005, "mixed"),
  design("full, 1000 angles, AR(1) 0.9", "angle", full, 1000, 0.005, "ar9"),
  design("4 s, 400 angles, AR(1) 0.5", "angle", 4, 400, 0.005, "ar5"),
  design("full, 400 rates, AR(1) 0.9", "rate", full, 400, 0.02, "ar9")
)

# The law that the Bayesian criterion (BIC) selects, and whether its own intervals cover: shown for
# one design, to compare.
after_selection <- function(data, p) {
  sets <- lapply(1:7, function(set) names(law)[bitwAnd(set, c(1L, 2L, 4L)) > 0])
  fits <- lapply(sets, function(set) fit_coast_down(data, losses = set, noise = "white"))
  n <- nrow(data)
  bic <- vapply(seq_along(fits), function(i) {
    n * log(sum(augment(fits[[i]])$residual^2) / n) + (length(sets[[i]]) + 2) * log(n)
  }, 0)
  best <- fits[[which.min(bic)]]
  at <- match(best$loss, names(law))
  inside <- p == 0 # a loss left out is taken for 0
  inside[at] <- best$lower <= p[at] & p[at] <= best$upper
  inside
}

passed <- 0
failed <- 0
for (d in designs) {
  set.seed(seed)
  motion <- scene(d$p)
  if (d$what == "pulse") {
    turned <- trajectory(motion, d$end)$theta_rad
    angle <- seq(0.4, turned, by = 2 * pi / d$per_turn)
    time_s <- vapply(angle, function(x) time_when(motion, theta_rad = x)$time_s[1], 0)
  } else {
    time_s <- seq(0, d$end, length.out = d$n)
    rows <- trajectory(motion, time_s)
    exact <- if (d$what == "angle") rows$theta_rad else rows$omega_rad_per_s
  }
  n <- length(time_s)
  inside <- selected <- matrix(NA, records, 3)
  selects <- grepl("after BIC", d$name)
  slow <- grepl("^8 s", d$name)
  for (i in seq_len(records)) {
    e <- d$sigma * noise(d$kind, n, time_s[2] - time_s[1])
    record <- if (d$what == "pulse") {
      motion_record(
        data.frame(t = time_s + e), time_s = t, pulses = d$per_turn
      )
    } else {
      data <- data.frame(time_s, exact + e)
      names(data)[2] <- if (d$what == "angle") "theta_rad" else "omega_rad_per_s"
      data
    }
    fit <- fit_coast_down(record)
    inside[i, ] <- fit$lower <= d$p & d$p <= fit$upper
    if (selects) selected[i, ] <- after_selection(record, d$p)
    if (slow) {
      white <- fit_coast_down(record, noise = "white")
      selected[i, ] <- white$lower <= d$p & d$p <= white$upper
    }
  }
  share <- colMeans(inside)
  bounds <- if (d$kind == "white") c(0.92, 0.98) else c(0.89, 0.98)
  # A loss of 0 has a one-sided interval, whose nominal coverage is .975; that it cannot be negative
  # keeps the others nearer to the truth, too (.980 and .984 in 500 records).
  top <- if (any(d$p == 0)) 1 else bounds[2]
  slack <- if (records < 500) 2 * sqrt(0.05 / records) else 0
  holds <- all(share >= bounds[1] - slack & share <= top + slack)
  if (holds) passed <- passed + 1 else failed <- failed + 1
  cat(sprintf(
    "%s - %-30s %s  (%.2f to %.2f)\n", if (holds) "ok" else "not ok", d$name,
    paste(sprintf("%.3f", share), collapse = " "), bounds[1], bounds[2]
  ))
  if (selects || slow) {
    cat(sprintf(
      "       %s %s\n",
      if (slow) "errors of white noise cover" else "the law selected by BIC covers",
      paste(sprintf("%.3f", colMeans(selected)), collapse = " ")
    ))
  }
}
# A million samples, once: the noise and the law.
set.seed(seed)
long <- c(coulomb = 0.005, viscous = 0.002, quadratic = 1e-5)
time_s <- seq(0, 1000, length.out = 1e6)
motion <- scene_axle(1, NULL, resistance(long[[2]], long[[3]], long[[1]]), omega0_rad_per_s = 50)
theta_rad <- trajectory(motion, time_s)$theta_rad + stats::rnorm(1e6, sd = 0.005)
fit <- fit_coast_down(data.frame(time_s, theta_rad))
off <- max(abs(fit$value - long) / fit$standard_error)
holds <- abs(generics::glance(fit)$sigma / 0.005 - 1) < 0.01 && off < 4.5
if (holds) passed <- passed + 1 else failed <- failed + 1
cat(sprintf(
  "%s - %-30s noise %.5f (0.005), losses off by %.1f standard errors (4.5)\n",
  if (holds) "ok" else "not ok", "1e6 angles, 1000 s", generics::glance(fit)$sigma, off
))
cat(sprintf("coast: %d passed, %d failed\n", passed, failed))
quit(status = failed > 0)
