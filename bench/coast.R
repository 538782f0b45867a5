# Time of fit_coast_down(), and of nls() around an integrator (deSolve's lsoda) on the same record.
#
#   Rscript bench/coast.R
#
# A line for each: median processor time in ms, and the ratio. nls() starts at the true parameters,
# which is its best. Its derivatives are differences of what lsoda returns.

library(rotdyn)

law <- c(a = 1.2, b = 0.1, k = 0.004)
scene <- scene_axle(1, NULL, resistance(0.1, 0.004, 1.2), omega0_rad_per_s = 20)
record <- function(n, rho) {
  set.seed(1)
  motion <- trajectory(scene, seq(0, 8, length.out = n))
  e <- as.vector(stats::filter(stats::rnorm(n) * sqrt(1 - rho^2), rho, "recursive"))
  motion_record(data.frame(time_s = motion$time_s, theta_rad = motion$theta_rad + 0.005 * e))
}
milliseconds <- function(call, times = 15) {
  one <- function() {
    used <- system.time(call(), gcFirst = FALSE)
    1000 * (used[[1]] + used[[2]])
  }
  one()
  if (times == 1) return(one())
  # The clock of processes ticks in ms: several calls at a time.
  stats::median(replicate(times, mean(replicate(5, one()))))
}
white <- record(1000, 0)
correlated <- record(1000, 0.9)
ours <- c(
  white = milliseconds(function() fit_coast_down(white)),
  correlated = milliseconds(function() fit_coast_down(correlated))
)
cat(sprintf("fit_coast_down(), 1000 angles, %-11s %7.1f ms\n", names(ours), ours), sep = "")

if (requireNamespace("deSolve", quietly = TRUE)) {
  slowing <- function(t, y, p) list(c(y[2], -(p[1] + p[2] * y[2] + p[3] * y[2]^2)))
  samples <- as.data.frame(white)
  for (tolerance in c(1e-6, 1e-8, 1e-10, 1e-12)) {
    theta <- function(t, theta0, omega0, a, b, k) {
      deSolve::lsoda(
        c(theta0, omega0), t, slowing, c(a, b, k), rtol = tolerance, atol = tolerance
      )[, 2]
    }
    peer <- function() {
      found <<- tryCatch(
        stats::nls(
          theta_rad ~ theta(time_s, theta0, omega0, a, b, k), samples,
          start = list(theta0 = 0, omega0 = 20, a = 1.2, b = 0.1, k = 0.004)
        ),
        error = conditionMessage
      )
    }
    found <- NULL
    time <- milliseconds(peer, 1)
    said <- if (is.character(found)) paste("stops:", found) else "converges"
    cat(sprintf(
      "nls() around lsoda at %.0e, white %7.1f ms, ratio %4.0f, %s\n", tolerance, time,
      time / ours[["white"]], said
    ))
  }
}
