# Random records of known motions: the truth is the package's closed form.

seconds <- c("spin-up" = 8, "coast-down" = 12, "stop" = 12, "pendulum" = 10)

# Angle, rate and acceleration at times. The sizes vary by up to a third of those of the article.
true_motion <- function(class, time, vary = stats::runif(3, 0.75, 1.33)) {
  disk <- body_disk(2, 0.25)
  scene <- switch(class,
    "spin-up" = scene_axle(
      disk, torque_knots(c(0, 1, 4, 6, 8), 0.8 * vary[1] * c(0, 1, 1, 0, 0)),
      resistance(viscous_n_m_s = 0.03 * vary[2])
    ),
    "coast-down" = scene_axle(
      disk, resistance = resistance(0.01 * vary[1], 2e-4 * vary[2]), omega0_rad_per_s = 20 * vary[3]
    ),
    "stop" = scene_axle(
      disk, resistance = resistance(0.01 * vary[1], coulomb_n_m = 0.1 * vary[2]),
      omega0_rad_per_s = 20 * vary[3]
    ),
    "pendulum" = scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 2 * vary[1]^(1 / 2))
  )
  run <- trajectory(scene, time)
  omega <- run$omega_rad_per_s
  alpha <- switch(class,
    "pendulum" = -1.5 * 9.80665 * sin(run$theta_rad),
    run$net_torque_n_m / 0.0625
  )
  list(theta = run$theta_rad, omega = omega, alpha = alpha)
}

# Times: even, or uneven by up to 0.4 spacings.
random_times <- function(n, span, uneven) {
  h <- span / (n - 1)
  time <- (seq_len(n) - 1) * h
  if (uneven) time <- time + c(0, stats::runif(n - 2, -0.4, 0.4), 0) * h
  time
}

# A record with white or quantised noise and a share of outliers of 5 to 60 sigma.
random_record <- function(class, n = round(stats::runif(1, 40, 2000)),
                          sigma = exp(stats::runif(1, log(1e-3), log(0.02))),
                          uneven = stats::runif(1) < 0.5, quantised = stats::runif(1) < 0.5,
                          outliers = 0.02) {
  time <- random_times(n, seconds[[class]], uneven)
  truth <- true_motion(class, time)
  step <- sigma * sqrt(12)
  theta <- if (quantised) {
    step * round((truth$theta + stats::runif(1, 0, step)) / step)
  } else {
    truth$theta + stats::rnorm(n, sd = sigma)
  }
  wrong <- which(stats::runif(n) < outliers)
  size <- sample(c(-1, 1), length(wrong), TRUE) * stats::runif(length(wrong), 5, 60) * sigma
  theta[wrong] <- theta[wrong] + if (quantised) step * round(size / step) else size
  list(
    class = class, n = n, sigma = sigma, uneven = uneven, quantised = quantised, wrong = wrong,
    truth = truth, data = data.frame(time_s = time, theta_rad = theta)
  )
}

# ---- breaks -----------------------------------------------------------------------------------

break_times <- list("impact" = 4.013, "step" = c(3.007, 6.011), "stop" = 6.874)
break_seconds <- c("impact" = 8, "step" = 9, "stop" = 12)

broken_motion <- function(class, time) {
  # A run from its start time on.
  axle <- function(..., torque = 0, loss, time_s) {
    trajectory(scene_axle(0.0625, torque = torque, resistance = loss, ...), time_s)
  }
  if (class == "impact") {
    loss <- resistance(viscous_n_m_s = 0.01)
    at <- break_times$impact
    before <- axle(loss = loss, omega0_rad_per_s = 10, time_s = c(time[time < at], at))
    k <- nrow(before)
    after <- axle(
      loss = loss, theta0_rad = before$theta_rad[k],
      omega0_rad_per_s = before$omega_rad_per_s[k] + 6, time_s = time[time >= at] - at
    )
    list(
      theta = c(before$theta_rad[-k], after$theta_rad),
      omega = c(before$omega_rad_per_s[-k], after$omega_rad_per_s)
    )
  } else if (class == "step") {
    run <- axle(
      torque = torque_steps(c(0, break_times$step), c(0, 0.8, 0)), omega0_rad_per_s = 5,
      loss = resistance(viscous_n_m_s = 0.03), time_s = time
    )
    list(theta = run$theta_rad, omega = run$omega_rad_per_s)
  } else {
    # I omega' = -c omega - tau: at rest after (I/c) log(1 + c omega0/tau), 6.874 s.
    omega0 <- 10 * (exp(6.874 * 0.16) - 1)
    run <- axle(
      omega0_rad_per_s = omega0, loss = resistance(0.01, coulomb_n_m = 0.1), time_s = time
    )
    list(theta = run$theta_rad, omega = run$omega_rad_per_s)
  }
}

broken_record <- function(class, outliers = 0, sigma = 1e-3, rate_hz = 50) {
  time <- seq(0, break_seconds[[class]], by = 1 / rate_hz)
  truth <- broken_motion(class, time)
  n <- length(time)
  theta <- truth$theta + stats::rnorm(n, sd = sigma)
  wrong <- which(stats::runif(n) < outliers)
  size <- sample(c(-1, 1), length(wrong), TRUE) * stats::runif(length(wrong), 5, 60)
  theta[wrong] <- theta[wrong] + size * sigma
  list(
    class = class, truth = truth, wrong = wrong, at = break_times[[class]],
    data = data.frame(time_s = time, theta_rad = theta)
  )
}

# What was found of the breaks of a record: errors of the times in spacings (NA: not found within
# 5), breaks too many, and the error of omega over that with the times given.
found_breaks <- function(record, spacing_s = 0.02) {
  motion <- estimate_motion(record$data)
  given <- estimate_motion(record$data, breaks = record$at)
  at <- motion_events(motion)$time_s
  off <- vapply(record$at, function(t) if (length(at)) min(abs(at - t)) else Inf, 0) / spacing_s
  near <- vapply(at, function(t) min(abs(record$at - t)) < 5 * spacing_s, NA)
  rmse <- function(x) sqrt(mean((x$omega_rad_per_s - record$truth$omega)^2))
  list(
    off = ifelse(off < 5, off, NA), extra = sum(!near) + max(0, sum(near) - length(record$at)),
    found = rmse(motion), given = rmse(given), events = motion_events(motion)
  )
}

# ---- gyroscopes ---------------------------------------------------------------------------------

# 10 s of rates at 100 Hz with noise of 0.05 or 0.005 rad/s.
rate_record <- function(class, sigma = sample(c(0.05, 0.005), 1)) {
  time <- seq(0, seconds[[class]], by = 0.01)
  truth <- true_motion(class, time)
  list(
    class = class, truth = truth,
    data = data.frame(
      time_s = time, omega_rad_per_s = truth$omega + stats::rnorm(length(time), sd = sigma)
    )
  )
}
