test_that("the core's rows are those of the axle, for both restoring torques and all losses", {
  time <- seq(2, 9, by = 0.13)
  for (restoring in c("gravity", "spring")) {
    torque <- torque_gravity(1, 9, gravity_m_per_s2 = 1)
    if (restoring == "spring") torque <- torque_spring(9)
    scene <- scene_axle(
      1, torque, resistance(0.2, coulomb_n_m = 0.1, quadratic_n_m_s2 = 0.3), theta0_rad = 1.2,
      omega0_rad_per_s = -0.5, start_s = 2
    )
    want <- trajectory(scene, time, accuracy = 1e-12)
    p <- c(1.2, -0.5, 3, 0.1, 0.1, 0.3, 0.25)
    angle <- free_motion(p, time, 2, "theta_rad", restoring)
    rate <- free_motion(p, time, 2, "omega_rad_per_s", restoring)
    expect_equal(angle$value, want$theta_rad + 0.25, tolerance = 1e-10)
    expect_equal(rate$value, want$omega_rad_per_s + 0.25, tolerance = 1e-10)
    expect_equal(angle$derivative[, 7], rep(1, length(time)))
  }
  expect_null(free_motion(c(0.1, 0, 1, -9, 0, 0, 0), c(0, 1e4), 0, "theta_rad", "spring"))
})

test_that("means of blocks are linear, and whitening inverts the noise", {
  x <- cbind(1:7, (1:7)^2)
  expect_equal(unname(block_means(x, 3)), rbind(c(2, 14 / 3), c(5, 77 / 3), c(7, 49)))
  expect_identical(block_means(x, 1), x)
  time <- cumsum(c(0, 0.1, 0.3, 0.1, 0.2, 0.1))
  v <- 0.7 * exp(-abs(outer(time, time, "-")) / 0.4) + 0.3 * diag(6)
  # More columns than the core takes at once.
  columns <- matrix(stats::rnorm(6 * 20), 6)
  want <- solve(t(chol(v)), columns)
  expect_equal(whiten(time, columns, c(tau_s = 0.4, white = 0.3)), want, tolerance = 1e-10)
})

test_that("noise with a memory is found, white noise is left white", {
  set.seed(1)
  time <- seq(0, 20, by = 0.05)
  j <- cbind(cos(time), sin(time))
  ar <- as.double(stats::arima.sim(list(ar = exp(-0.05 / 0.3)), 401))
  expect_within(find_noise(time, j, ar)[["tau_s"]], 0.3, 0.5)
  white <- replicate(20, find_noise(time, j, stats::rnorm(401))[["tau_s"]])
  expect_gte(sum(white == 0), 15)
})

test_that("the test of the law: uniform where it holds, small where phase or form differ", {
  set.seed(2)
  time <- seq(0, 30, by = 0.05)
  p <- function(extra) {
    y <- 0.3 * exp(-0.02 * time) * cos(2 * time + extra) + stats::rnorm(length(time), sd = 0.003)
    fit_swing(data.frame(time_s = time, theta_rad = y), "spring", losses = "viscous")$law_p
  }
  n <- or_long(12, 30)
  none <- replicate(n, p(0))
  # Of uniform numbers: below 0.001 at most one, of 30 above 0.5 from 7 to 23.
  expect_lte(sum(none < 0.001), 1)
  expect_true(sum(none > 0.5) >= stats::qbinom(0.002, n, 0.5))
  expect_true(sum(none > 0.5) <= stats::qbinom(0.998, n, 0.5))
  expect_lt(p(3e-5 * (time - 15)^3), 1e-6)
})

test_that("the fit ends at a minimum, also of a law that does not hold", {
  time <- seq(0, 20, by = 0.05)
  active <- c(1:4, 7)
  off <- function(y) {
    model <- function(p) free_motion(p, time, 0, "theta_rad", "spring")
    fit <- least_squares(model, y, c(0.5, 0, 1.95, 0.02, 0, 0, 0), active)
    j <- fit$now$derivative[, active]
    max(abs(crossprod(j, fit$residual)) / sqrt(colSums(j^2))) / sqrt(sum(fit$residual^2))
  }
  # The residuals are at right angles to each derivative; roundings of the sums are 1e-10.
  expect_lt(off(0.9 * cos(2 * time) / (1 + 0.1 * time)), 2e-8)
  expect_lt(off(cos(2 * time) + 0.8 * cos(5 * time)), 1e-8)
  expect_lt(off(0.5 * cos(2 * time + 0.002 * time^2)), 1e-8)
})

test_that("losses that a few swings do not separate leave the period that of one loss", {
  set.seed(6)
  errors <- replicate(30, {
    time <- seq(0, 20, by = 0.15)
    y <- exp(-0.01 * time) * cos(2 * time) + stats::rnorm(length(time), sd = 0.015)
    record <- data.frame(time_s = time, theta_rad = y)
    fits <- list(fit_swing(record, "spring"), fit_swing(record, "spring", losses = "viscous"))
    c(
      vapply(fits, function(fit) fit$omega0_rad_per_s$value, 0) - 2,
      vapply(fits, function(fit) fit$omega0_rad_per_s$u, 0),
      fits[[1]]$omega_rad_per_s$value - sqrt(4 - 1e-4),
      log(fits[[1]]$omega0_rad_per_s$u / fits[[1]]$white_u)
    )
  })
  size <- sqrt(rowMeans(errors^2))
  expect_lt(size[1], 1.15 * size[2])
  expect_lt(size[5], 1.15 * size[2])
  expect_lt(size[3], 1.3 * size[4])
  expect_gt(size[1] / size[3], 0.7)
  # The error for white noise is of the same motion: the noise is white.
  expect_lt(stats::median(abs(errors[6, ])), 0.1)
})
