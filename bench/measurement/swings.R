# Coverage of the intervals of fit_swing(): simulated swings whose period and losses are known.
#
#   Rscript bench/measurement/swings.R [records] [seed] [class ...]
#
# A line for each class and quantity: the shares of intervals at 68 % and 95 % that hold the truth,
# and the verdict: 60 to 76 % and 91 to 98.5 %, wider by two standard errors of the share where that
# is more than 1 %. Records whose law is called incomplete are counted and listed ("incomplete"):
# at most 2 % may be. The motions are those of deSolve (lsodar, 1e-12), with friction reversed at
# the turning points.

library(rotdyn)
arguments <- commandArgs(TRUE)
records <- if (length(arguments) > 0L) as.integer(arguments[1]) else 400L
seed <- if (length(arguments) > 1L) as.integer(arguments[2]) else 20261L
chosen <- arguments[-(1:2)]

# theta'' = -w^2 sin(theta) (or theta) - 2 g theta' - s a - s k theta'^2, with s kept as a state
# that changes sign where theta' is 0.
rhs <- function(t, y, p) {
  pull <- if (p$spring) y[1] else sin(y[1])
  if (y[3] == 0) return(list(c(0, 0, 0)))
  list(c(y[2], -p$w^2 * pull - 2 * p$g * y[2] - y[3] * (p$a + p$k * y[2]^2), 0))
}
turn <- function(t, y, p) {
  pull <- -p$w^2 * if (p$spring) y[1] else sin(y[1])
  y[2] <- 0
  y[3] <- if (abs(pull) > p$a) sign(pull) else 0
  y
}
true_motion <- function(p, time) {
  out <- deSolve::lsodar(
    c(p$theta, p$omega, sign(p$omega)), time, rhs, p, rtol = 1e-12, atol = 1e-13, maxsteps = 1e5,
    rootfunc = function(t, y, p) if (y[3] == 0) 1 else y[2],
    events = list(func = turn, root = TRUE)
  )
  out <- out[match(time, out[, 1]), ]
  list(theta = out[, 2], omega = out[, 3])
}

between <- function(low, high) stats::runif(1, low, high)
apart <- function(low, high) exp(stats::runif(1, log(low), log(high)))

# Unit variance.
noise <- function(kind, n) {
  ar <- function(rho) {
    e <- stats::rnorm(n) * sqrt(1 - rho^2)
    e[1] <- stats::rnorm(1)
    as.vector(stats::filter(e, rho, "recursive"))
  }
  switch(kind,
    white = stats::rnorm(n), ar = ar(between(0.3, 0.95)),
    mixed = sqrt(0.5) * stats::rnorm(n) + sqrt(0.5) * ar(0.97)
  )
}

# A record of a class. `loss` of the amplitude: its fall over the record by each loss is drawn.
design <- function(kind = "white", amplitude = c(0.1, 0.7), viscous = c(0.1, 1), quadratic = NULL,
                   coulomb = NULL, spring = FALSE, rate = FALSE, counter = FALSE,
                   swings = c(8, 30), uneven = FALSE, thirds = FALSE) {
  list(
    kind = kind, amplitude = amplitude, viscous = viscous, quadratic = quadratic,
    coulomb = coulomb, spring = spring, rate = rate, counter = counter, swings = swings,
    uneven = uneven, thirds = thirds
  )
}
classes <- list(
  "white" = design(),
  "white, uneven times" = design(uneven = TRUE),
  "white, spring" = design(spring = TRUE),
  "white, rates" = design(rate = TRUE),
  "AR(1)" = design("ar"),
  "AR(1), rates" = design("ar", rate = TRUE),
  "half slow" = design("mixed"),
  "counter" = design(counter = TRUE),
  "quadratic" = design(viscous = NULL, quadratic = c(0.2, 1), amplitude = c(0.4, 1.2)),
  "viscous and quadratic" = design(quadratic = c(0.2, 1), amplitude = c(0.4, 1.2)),
  "Coulomb" = design(viscous = NULL, coulomb = c(0.1, 0.5)),
  "all losses" = design(quadratic = c(0.1, 0.5), coulomb = c(0.05, 0.2), viscous = c(0.1, 0.5)),
  "large" = design(amplitude = c(1.5, 2.8), swings = c(8, 20)),
  "large, quadratic" = design(
    amplitude = c(1.5, 2.8), swings = c(8, 20), viscous = NULL, quadratic = c(0.1, 0.8)
  ),
  "thirds" = design(thirds = TRUE, swings = c(12, 30)),
  "thirds, quadratic" = design(
    thirds = TRUE, swings = c(12, 30), amplitude = c(0.4, 1.2), quadratic = c(0.2, 1)
  )
)

draw <- function(d) {
  w <- apart(1.5, 12)
  amplitude <- do.call(between, as.list(d$amplitude))
  swings <- do.call(between, as.list(d$swings))
  span <- swings * 2 * pi / w
  # The fall of log amplitude over the record by each loss, to first order.
  fall <- function(range) if (is.null(range)) 0 else between(range[1], range[2])
  p <- list(
    w = w, g = fall(d$viscous) / span, spring = d$spring,
    k = fall(d$quadratic) / span * 3 * pi / (4 * w * amplitude),
    a = fall(d$coulomb) / span * pi * w * amplitude / 2
  )
  # Begins anywhere in a swing.
  start <- between(0, 2 * pi)
  p$theta <- amplitude * cos(start)
  p$omega <- w * sqrt(if (d$spring) amplitude^2 - p$theta^2 else {
    2 * (cos(p$theta) - cos(amplitude))
  }) * sign(sin(start))
  n <- round(swings * between(15, 40))
  time <- seq(0, span, length.out = n)
  if (d$uneven) time <- sort(c(0, span, between(0, 1e-9) + stats::runif(n - 2, 0, span)))
  truth <- true_motion(p, time)
  y <- if (d$rate) truth$omega else truth$theta
  size <- max(abs(y))
  if (d$counter) {
    step <- size / apart(8, 200)
    # A small noise of its own, as every sensor has.
    y <- step * round((y + 0.05 * step * stats::rnorm(n)) / step + between(-0.5, 0.5))
  } else {
    y <- y + size * apart(5e-4, 0.02) * noise(d$kind, n) + between(-0.1, 0.1)
  }
  p$t0 <- 2 * pi / w
  list(p = p, data = stats::setNames(
    data.frame(time, y), c("time_s", if (d$rate) "omega_rad_per_s" else "theta_rad")
  ))
}

# Error over standard error, and the quantiles at 68 and 95 %.
score <- function(x, truth) {
  if (is.null(x)) return(c(NA, NA))
  off <- abs(x$value - truth)
  c(off <= stats::qt(0.84134, x$dof) * x$u, off <= stats::qt(0.975, x$dof) * x$u)
}

passed <- 0
failed <- 0
report <- function(name, inside, n) {
  share <- colMeans(inside, na.rm = TRUE)
  slack <- pmax(2 * sqrt(c(0.6827 * 0.3173, 0.95 * 0.05) / n), 0.01) - 0.01
  holds <- share[1] >= 0.60 - slack[1] && share[1] <= 0.76 + slack[1] &&
    share[2] >= 0.91 - slack[2] && share[2] <= 0.985 + slack[2]
  if (holds) passed <<- passed + 1 else failed <<- failed + 1
  cat(sprintf(
    "%s - %-46s %.3f %.3f\n", if (holds) "ok" else "not ok", name, share[1], share[2]
  ))
}

for (name in names(classes)) {
  if (length(chosen) && !name %in% chosen) next
  set.seed(seed)
  d <- classes[[name]]
  spring <- if (d$spring) "spring" else "gravity"
  rows <- lapply(seq_len(records), function(i) {
    at <- draw(d)
    fit <- fit_swing(at$data, spring)
    p <- at$p
    # The first third and the last: their difference is 0.
    pair <- c(NA, NA)
    if (d$thirds) {
      cut <- max(at$data$time_s) / 3
      first <- fit_swing(at$data, spring, to_s = cut)
      last <- fit_swing(at$data, spring, from_s = 2 * cut)
      pair <- score(first$period_s - last$period_s, 0)
    }
    list(
      period = score(fit$period_s, p$t0), viscous = score(fit$decay_per_s, p$g),
      quadratic = score(fit$quadratic_per_rad, p$k),
      coulomb = score(fit$coulomb_rad_per_s2, p$a), thirds = pair,
      peaks = score(fit$damping$decay_per_s, p$g),
      complete = fit$law_complete, fitted = fit$from == "fit"
    )
  })
  for (what in c("period", "viscous", "quadratic", "coulomb", "thirds", "peaks")) {
    inside <- do.call(rbind, lapply(rows, `[[`, what))
    n <- sum(!is.na(inside[, 1]))
    if (n > 20L) report(paste0(name, ": ", what), inside, n)
  }
  incomplete <- mean(!vapply(rows, `[[`, NA, "complete"))
  fitted <- mean(vapply(rows, `[[`, NA, "fitted"))
  holds <- incomplete <= 0.02 + 2 * sqrt(0.02 / records)
  if (holds) passed <- passed + 1 else failed <- failed + 1
  cat(sprintf(
    "%s - %-46s %.3f (fitted %.3f)\n", if (holds) "ok" else "not ok", paste0(name, ": incomplete"),
    incomplete, fitted
  ))
}
cat(sprintf("swings: %d passed, %d failed\n", passed, failed))
quit(status = failed > 0)
