rod_inertia <- 0.2 * 0.6^2 / 3
rod_omega0 <- sqrt(3 * 9.80665 / (2 * 0.6))
swing_record <- function(theta0, zeta = 0, by = 0.03, until = 12, rate = FALSE, coulomb = 0) {
  scene <- scene_pendulum(
    body_rod_end(0.2, 0.6),
    resistance = resistance(2 * zeta * rod_omega0 * rod_inertia, coulomb_n_m = coulomb),
    theta0_rad = theta0
  )
  x <- trajectory(scene, seq(0, until, by = by), accuracy = 1e-12)
  if (rate) {
    motion_record(x, time_s = time_s, omega_rad_per_s = omega_rad_per_s)
  } else {
    motion_record(x, time_s = time_s, theta_rad = theta_rad)
  }
}

test_that("exact records come back exact: undamped to 2.5 rad, of angles and of rates", {
  for (amplitude in c(0.05, 1, 2.5)) {
    for (rate in c(FALSE, TRUE)) {
      fit <- fit_swing(swing_record(amplitude, rate = rate))
      expect_equal(fit$omega0_rad_per_s$value / rod_omega0, 1, tolerance = 1e-13)
      expect_lt(fit$omega0_rad_per_s$u, 1e-12)
      expect_equal(max(fit$swings$amplitude_rad), amplitude, tolerance = 0.01)
    }
  }
})

test_that("damped: I errs by less than zeta^2 A^2, from the fit and swing by swing", {
  for (zeta in c(0.01, 0.05)) {
    for (amplitude in c(0.3, 1)) {
      fit <- fit_swing(swing_record(amplitude, zeta))
      bound <- zeta^2 * amplitude^2
      expect_lt(abs((fit$omega0_rad_per_s$value / rod_omega0)^-2 - 1), bound * 1e-3)
      expect_equal(fit$decay_per_s$value, zeta * rod_omega0, tolerance = 1e-8)
      swings <- fit$swings[fit$swings$used, ]
      swing_i <- (swings$period0_s * sqrt(1 - zeta^2) * rod_omega0 / (2 * pi))^2
      expect_lt(max(abs(swing_i[1:4] - 1)), bound)
    }
  }
})

test_that("viscous and Coulomb damping, from the fit and from the peaks", {
  fit <- fit_swing(
    swing_record(0.4, 0.01, coulomb = 0.002), losses = c("viscous", "coulomb"), to_s = 9
  )
  a <- 0.002 / rod_inertia
  expect_equal(fit$coulomb_rad_per_s2$value, a, tolerance = 1e-6)
  expect_equal(fit$decay_per_s$value, 0.01 * rod_omega0, tolerance = 1e-6)
  expect_equal(fit$omega0_rad_per_s$value, rod_omega0, tolerance = 1e-8)
  # A spring: the recursion of the peaks is exact; the quartics are not.
  scene <- scene_axle(1, torque_spring(25), resistance(0.1, coulomb_n_m = 0.1), theta0_rad = 1)
  x <- trajectory(scene, seq(0, 12, by = 0.01))
  fit <- fit_swing(motion_record(x, time_s = time_s, theta_rad = theta_rad), "spring")
  expect_equal(fit$damping$decay_per_s$value, 0.05, tolerance = 0.01)
  expect_equal(fit$damping$coulomb_rad_per_s2$value, 0.1, tolerance = 0.01)
})

test_that("a loss of 0 is at most something", {
  set.seed(2)
  r <- swing_record(0.5)
  r$theta_rad <- r$theta_rad + stats::rnorm(nrow(r), sd = 1e-3)
  fit <- fit_swing(r, losses = c("viscous", "coulomb"))
  zero <- c(fit$decay_per_s$value, fit$coulomb_rad_per_s2$value) == 0
  expect_true(any(zero))
  expect_gt(min(fit$decay_per_s$u, fit$coulomb_rad_per_s2$u), 0)
  expect_output(print(fit), "at most")
})

test_that("correlated residuals: the errors cover", {
  set.seed(3)
  base <- swing_record(0.3, 0.01, by = 0.02, until = 10)
  n <- or_long(20, 60)
  inside <- vapply(seq_len(n), function(k) {
    r <- base
    r$theta_rad <- r$theta_rad + as.double(
      stats::arima.sim(list(ar = 0.9), nrow(r), sd = 2e-3, n.start = 100)
    )
    fit <- fit_swing(r)
    c(
      abs(fit$omega0_rad_per_s$value - rod_omega0) < 2 * fit$omega0_rad_per_s$u,
      abs(fit$omega0_rad_per_s$value - rod_omega0) < 2 * fit$white_u
    )
  }, c(NA, NA))
  # Of 60 trials of .94 at least 52 in 99.8 % of the cases.
  expect_gte(sum(inside[1, ]), stats::qbinom(0.002, n, 0.94))
  expect_lt(sum(inside[2, ]), 0.75 * n)
})

test_that("the bicycle wheel: published 14.9109 and 4.39626 rad/s, with larger errors", {
  torsion <- fit_swing(
    read_motion(shared("data", "measured", "bicycle_wheel_torsional_gyro.csv")), "spring"
  )
  expect_equal(round(torsion$omega_rad_per_s$value, 3), 14.911)
  expect_equal(round(torsion$decay_per_s$value, 3), 0.227)
  for (u in c(torsion$omega_rad_per_s$u, torsion$decay_per_s$u)) {
    expect_gt(u, 0.0009)
    expect_lt(u, 0.0014)
  }
  expect_equal(torsion$white_u, 3e-4, tolerance = 0.1)
  expect_equal(torsion$durbin_watson, 0.29, tolerance = 0.02)
  hung <- read_motion(shared("data", "measured", "bicycle_wheel_compound_pendulum_gyro.csv"))
  raw <- fit_swing(hung, "spring")
  expect_equal(round(raw$omega_rad_per_s$value, 4), 4.3962)
  expect_gt(raw$omega_rad_per_s$u, 0.0005)
  expect_lt(raw$omega_rad_per_s$u, 0.0009)
  # Finite amplitude: .26 % of I.
  small <- fit_swing(hung)
  expect_equal((raw$omega_rad_per_s$value / small$omega_rad_per_s$value)^2 - 1, -0.0026,
    tolerance = 0.02)
})

test_that("an encoder's pendulum, driven, free and braked; a filmed one", {
  for (name in c("pend00-run02.csv", "pend00-run05.csv")) {
    fit <- fit_swing(read_motion(shared("data", "measured", name)))
    expect_lt(abs(fit$period_s$value - 0.611), 0.003)
    expect_equal(fit$from, "swings")
    # The period itself is up to .665 s.
    expect_gt(max(fit$swings$period_s[fit$swings$used]), 0.66)
  }
  film <- read_motion(
    shared("data", "measured", "phy180_trial1_rawdata.txt"), headings = c("time_s", "theta_rad")
  )
  fit <- fit_swing(film)
  expect_equal(fit$period_s$value, 1.6412, tolerance = 1e-3)
  expect_gt(fit$period_s$u, 5e-4)
})

test_that("an offset, a gap, two segments, a part of the record", {
  r <- swing_record(0.6, 0.01)
  r$theta_rad <- r$theta_rad + 0.2
  fit <- fit_swing(r)
  expect_equal(fit$offset, 0.2, tolerance = 1e-9)
  expect_equal(fit$omega0_rad_per_s$value, rod_omega0, tolerance = 1e-9)
  gap <- r[r$time_s < 4 | r$time_s > 6, ]
  expect_equal(fit_swing(gap)$period_s$value, 2 * pi / rod_omega0, tolerance = 1e-6)
  two <- r
  two$segment[two$time_s > 5] <- 2L
  fit <- fit_swing(two)
  expect_equal(unique(fit$swings$segment), 1:2)
  expect_equal(fit$omega0_rad_per_s$value, rod_omega0, tolerance = 1e-8)
  expect_lt(max(fit_swing(r, from_s = 3, to_s = 8)$swings$time_s), 8)
})

test_that("errors are the package's own", {
  r <- swing_record(0.6, 0.01)
  expect_error(fit_swing(), class = "rotdyn_error_missing")
  expect_error(fit_swing(3), class = "rotdyn_error_type")
  expect_error(fit_swing(r, "rope"), class = "rotdyn_error_value")
  expect_error(fit_swing(r, losses = "air"), class = "rotdyn_error_value")
  expect_error(fit_swing(r, loss = "viscous"), class = "rotdyn_error_argument")
  expect_error(fit_swing(r, to_s = 0.5), class = "rotdyn_error_size")
  r$theta_rad <- 0
  expect_error(fit_swing(r), class = "rotdyn_error_size")
  r$theta_rad <- r$time_s^2
  expect_error(fit_swing(r), class = "rotdyn_error_size")
})

test_that("swings of which no one has its passages and peaks sampled", {
  # A passage lies within 0.7 of half a swing between two samples: 2.2 a period are too few.
  time <- seq(0, 30, by = 1 / 2.2)
  sparse <- motion_record(
    data.frame(time_s = time, theta_rad = 0.3 * cos(2 * pi * time + 0.4)), "time_s", "theta_rad"
  )
  expect_error(expect_no_warning(fit_swing(sparse)), class = "rotdyn_error_size")
})

test_that("a damaged fit is refused", {
  fit <- fit_swing(swing_record(0.6, 0.01))
  for (part in list(1, list(), list(decay_per_s = measured(1, 0.1)))) {
    damaged <- fit
    damaged$damping <- part
    expect_error(print(damaged), "no fit of a swing", class = "rotdyn_error_type")
  }
  damaged <- fit
  damaged["omega0_rad_per_s"] <- list(NULL)
  expect_error(print(damaged), class = "rotdyn_error_type")
})
