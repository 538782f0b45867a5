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

test_that("a loss that is absent is within its error of 0, and at most something", {
  set.seed(2)
  r <- swing_record(0.5)
  r$theta_rad <- r$theta_rad + stats::rnorm(nrow(r), sd = 1e-3)
  fit <- fit_swing(r)
  for (loss in c("decay_per_s", "coulomb_rad_per_s2", "quadratic_per_rad")) {
    expect_gt(fit[[loss]]$u, 0)
    expect_lt(abs(fit[[loss]]$value), 4 * fit[[loss]]$u)
  }
  expect_output(print(fit), "at most")
  expect_match(fit$notes, "does not decay", all = FALSE)
  expect_match(fit$notes, "does not separate", all = FALSE)
  # The fitted motion has no loss below 0.
  expect_true(all(fit$motion$p[4:6] >= 0))
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
    fit <- fit_swing(r, losses = "viscous")
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
    read_motion(shared("data", "measured", "bicycle_wheel_torsional_gyro.csv")), "spring",
    losses = "viscous"
  )
  expect_equal(round(torsion$omega_rad_per_s$value, 3), 14.911)
  expect_equal(round(torsion$decay_per_s$value, 3), 0.227)
  for (u in c(torsion$omega_rad_per_s$u, torsion$decay_per_s$u)) {
    expect_gt(u, 0.0009)
    expect_lt(u, 0.008)
  }
  # The rate has parts at 1.2, 2 and 3 times the frequency: no damped harmonic motion.
  expect_false(torsion$law_complete)
  expect_within(torsion$white_u, 3e-4, 0.1)
  expect_equal(torsion$durbin_watson, 0.29, tolerance = 0.02)
  hung <- read_motion(shared("data", "measured", "bicycle_wheel_compound_pendulum_gyro.csv"))
  raw <- fit_swing(hung, "spring", losses = "viscous")
  expect_equal(round(raw$omega_rad_per_s$value, 4), 4.3962)
  expect_gt(raw$omega_rad_per_s$u, 0.0005)
  expect_lt(raw$omega_rad_per_s$u, 0.0018)
  # Finite amplitude: .26 % of I.
  small <- fit_swing(hung, losses = "viscous")
  expect_within((raw$omega_rad_per_s$value / small$omega_rad_per_s$value)^2 - 1, -0.0026, 0.02)
})

test_that("an encoder's pendulum, driven, free and braked; a filmed one", {
  for (name in c("pend00-run02.csv", "pend00-run05.csv")) {
    fit <- fit_swing(read_motion(shared("data", "measured", name)))
    expect_lt(abs(fit$period_s$value - 0.611), 0.003)
    if (name == "pend00-run02.csv") {
      # Driven up to its largest amplitude: what remains is short.
      expect_match(fit$notes, "driven, not free", all = FALSE)
    } else {
      expect_false(fit$law_complete)
    }
    # The period itself is up to .665 s.
    expect_gt(max(fit$swings$period_s[fit$swings$used]), 0.66)
  }
  film <- read_motion(
    shared("data", "measured", "phy180_trial1_rawdata.txt"), headings = c("time_s", "theta_rad")
  )
  fit <- fit_swing(film)
  expect_equal(fit$period_s$value, 1.6412, tolerance = 2e-3)
  expect_false(fit$law_complete)
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

test_that("where angles are counted from changes nothing, the verdict on the law neither", {
  set.seed(3)
  t <- seq(0, 20, 0.05)
  y <- 0.2 * exp(-0.02 * t) * cos(2 * t) + stats::rnorm(length(t), sd = 0.002)
  about <- lapply(c(0, 3), function(offset) {
    glance(fit_swing(data.frame(time_s = t, theta_rad = y + offset)))
  })
  for (name in c("period_s", "period_s_se", "residual", "law_p")) {
    expect_equal(about[[2]][[name]], about[[1]][[name]], tolerance = 1e-6)
  }
})

test_that("errors are the package's own", {
  r <- swing_record(0.6, 0.01)
  expect_error(fit_swing(), class = "rotdyn_error_missing")
  expect_error(fit_swing(3), class = "rotdyn_error_type")
  expect_error(fit_swing(r, "rope"), class = "rotdyn_error_value")
  expect_error(fit_swing(r, losses = "air"), class = "rotdyn_error_value")
  expect_error(fit_swing(r, losses = c("none", "viscous")), class = "rotdyn_error_value")
  expect_error(fit_swing(r, loss = "viscous"), class = "rotdyn_error_argument")
  expect_error(fit_swing(r, to_s = 0.5), class = "rotdyn_error_size")
  r$theta_rad <- 0
  expect_error(fit_swing(r), class = "rotdyn_error_size")
  r$theta_rad <- r$time_s^2
  expect_error(fit_swing(r), class = "rotdyn_error_size")
})

test_that("the ends of a part of a record are one time each", {
  r <- swing_record(0.6, 0.01)
  for (limit in list("3", c(1, 2), NA_real_, NULL, TRUE)) {
    expect_error(fit_swing(r, from_s = limit), class = "rotdyn_error_type")
    expect_error(fit_swing(r, to_s = limit), class = "rotdyn_error_type")
  }
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
  for (part in list(1, list(1), list(decay_per_s = 1))) {
    damaged <- fit
    damaged$damping <- part
    expect_error(print(damaged), class = "rotdyn_error_type")
  }
  damaged <- fit
  damaged["omega0_rad_per_s"] <- list(NULL)
  expect_error(print(damaged), class = "rotdyn_error_type")
})

# ---- quadratic drag, counters, degrees, drives --------------------------------------------------

# theta'' = -w^2 sin(theta) - 2 g theta' - k theta' |theta'| + drive(t), by another program.
drag_record <- function(k, g = 0, theta0 = 0.8, w = 3.85, until = 30, by = 0.04, sigma = 0,
                        drive = function(t) 0) {
  skip_if_not_installed("deSolve")
  time <- seq(0, until, by = by)
  x <- deSolve::lsoda(c(theta0, 0), time, function(t, y, p) {
    list(c(y[2], -w^2 * sin(y[1]) - 2 * g * y[2] - k * y[2] * abs(y[2]) + drive(t)))
  }, NULL, rtol = 1e-12, atol = 1e-13)
  data.frame(time_s = time, theta_rad = x[, 2] + stats::rnorm(length(time), sd = sigma))
}

test_that("air drag: the quadratic loss is found, and a viscous law is called incomplete", {
  exact <- fit_swing(drag_record(0.05, 0.01))
  expect_equal(exact$quadratic_per_rad$value, 0.05, tolerance = 1e-6)
  expect_equal(exact$decay_per_s$value, 0.01, tolerance = 1e-6)
  expect_equal(exact$omega0_rad_per_s$value, 3.85, tolerance = 1e-8)
  set.seed(11)
  r <- drag_record(0.1, sigma = 5e-4)
  viscous <- fit_swing(r, losses = "viscous")
  expect_false(viscous$law_complete)
  expect_match(viscous$notes, "law is incomplete", all = FALSE)
  both <- fit_swing(r)
  expect_true(both$law_complete)
  expect_gt(both$law_p, 0.001)
  expect_lt(abs(both$period_s$value - 2 * pi / 3.85), 4 * both$period_s$u)
  expect_lt(abs(both$quadratic_per_rad$value - 0.1), 4 * both$quadratic_per_rad$u)
  # Much better known than each: the fall by both.
  expect_lt(both$decay_at_amplitude_per_s$u, 0.1 * both$decay_per_s$u)
  # The fall of the amplitude by quadratic drag at the rms amplitude, 4 k omega A/(3 pi).
  a <- sqrt(mean(both$swings$amplitude_rad^2))
  expect_equal(
    both$decay_at_amplitude_per_s$value, 4 * 0.1 * 3.85 * a / (3 * pi), tolerance = 0.02
  )
  # Quadratic drag named alone.
  one <- fit_swing(r, losses = "quadratic")
  expect_lt(abs(one$quadratic_per_rad$value - 0.1), 4 * one$quadratic_per_rad$u)
  expect_lt(one$quadratic_per_rad$u, 0.2 * both$quadratic_per_rad$u)
  expect_null(one$decay_per_s)
})

test_that("thirds of a record agree within their errors", {
  set.seed(5)
  r <- drag_record(0.1, sigma = 5e-4, until = 36)
  t0 <- lapply(0:2, function(k) fit_swing(r, from_s = 12 * k, to_s = 12 * (k + 1))$period_s)
  for (other in t0[2:3]) {
    gap <- t0[[1]] - other
    expect_lt(abs(gap$value), 4 * gap$u)
  }
})

test_that("counters: samples of exactly 0, also two in a row, long equal ones", {
  time <- seq(0, 25, by = 0.02)
  theta <- 0.3 * exp(-0.02 * time) * cos(2.2 * time)
  for (step in c(0.002, 0.02, 0.06)) {
    r <- data.frame(time_s = time, theta_rad = step * round(theta / step))
    fit <- expect_no_warning(fit_swing(r, "spring"))
    w0 <- sqrt(2.2^2 + 0.02^2)
    expect_lt(abs(fit$omega0_rad_per_s$value - w0), 4 * fit$omega0_rad_per_s$u)
    expect_lt(fit$omega0_rad_per_s$u, 0.05 * step)
  }
  # Integers, of few levels.
  r <- data.frame(time_s = time, theta_rad = round(3 * cos(2.2 * time)))
  expect_equal(fit_swing(r, "spring")$period_s$value, 2 * pi / 2.2, tolerance = 2e-3)
})

test_that("degrees given as radians are refused for a pendulum, with a remedy", {
  time <- seq(0, 20, by = 0.05)
  degrees <- 30 * exp(-0.05 * time) * cos(3 * time)
  angle <- data.frame(time_s = time, theta_rad = degrees)
  error <- expect_error(fit_swing(angle), class = "rotdyn_error_value")
  expect_match(conditionMessage(error), "theta_deg")
  rate <- data.frame(time_s = time, omega_rad_per_s = 3 * degrees)
  error <- expect_error(fit_swing(rate), class = "rotdyn_error_value")
  expect_match(conditionMessage(error), "omega_deg_per_s")
  # A torsion wire may turn that far.
  expect_equal(fit_swing(angle, "spring")$omega_rad_per_s$value, 3, tolerance = 1e-6)
  # As far as a pendulum can: 3.1 rad, of angles and of rates.
  for (rate in c(FALSE, TRUE)) {
    far <- fit_swing(swing_record(3.1, until = 20, rate = rate))
    expect_equal(far$omega0_rad_per_s$value, rod_omega0, tolerance = 1e-10)
  }
})

test_that("driven swings are refused or said", {
  # Built up at resonance: no free swing.
  resonant <- function(t) 0.05 * cos(3.85 * t)
  grows <- drag_record(0, 0.02, theta0 = 0.002, until = 40, drive = resonant)
  error <- expect_error(fit_swing(grows), class = "rotdyn_error_value")
  expect_match(conditionMessage(error), "free swing")
  # Beats: what falls is no free motion.
  beats <- drag_record(0, 0.005, theta0 = 0.3, until = 60, drive = function(t) 0.3 * cos(3.5 * t))
  fit <- fit_swing(beats)
  expect_match(fit$notes, "driven", all = FALSE)
  expect_false(fit$law_complete)
  # A steady amplitude.
  set.seed(3)
  steady <- drag_record(0, 0.2, theta0 = 0.1, until = 80, drive = function(t) 0.5 * cos(3 * t))
  steady <- steady[steady$time_s > 50, ]
  steady$theta_rad <- steady$theta_rad + stats::rnorm(nrow(steady), sd = 1e-3)
  expect_match(fit_swing(steady)$notes, "does not decay", all = FALSE)
})

test_that("long records are reduced in blocks without a loss of exactness", {
  time <- seq(0, 60, length.out = 60001)
  r <- data.frame(time_s = time, theta_rad = 0.2 * exp(-0.01 * time) * cos(2 * time))
  fit <- fit_swing(r, "spring")
  expect_equal(fit$omega_rad_per_s$value, 2, tolerance = 1e-11)
  expect_equal(fit$decay_per_s$value, 0.01, tolerance = 1e-8)
  set.seed(4)
  r$theta_rad <- r$theta_rad + stats::rnorm(nrow(r), sd = 0.01)
  fit <- fit_swing(r, "spring", losses = "viscous")
  # Of a sampled sinusoid: u(omega) = sigma/A sqrt(24/n)/T without damping.
  expect_within(fit$omega_rad_per_s$u, 0.01 / 0.15 * sqrt(24 / 60001) / 60, 0.15)
})

test_that("large swings are fitted from any part of a swing", {
  swing <- scene_pendulum(
    body_rod_end(0.2, 0.6), resistance = resistance(quadratic_n_m_s2 = 1e-4), theta0_rad = 2.75
  )
  for (from_s in c(0.4, 0.9)) {
    run <- trajectory(swing, seq(from_s, from_s + 20, by = 0.06))
    for (kind in c("theta_rad", "omega_rad_per_s")) {
      set.seed(3)
      y <- run[[kind]] + stats::rnorm(nrow(run), sd = 0.01)
      fit <- fit_swing(stats::setNames(data.frame(run$time_s, y), c("time_s", kind)))
      expect_identical(fit$from, "fit")
      expect_true(fit$law_complete)
      # A rod at its end: 2 pi sqrt(2 L/(3 g)).
      expect_equal(fit$period_s$value, 2 * pi * sqrt(1.2 / (3 * 9.80665)), tolerance = 2e-3)
    }
  }
})

test_that("a print tells the root of the mean square of the amplitudes that were used", {
  set.seed(1)
  time <- seq(0, 12, by = 0.04)
  y <- 0.5 * exp(-0.04 * time) * cos(5 * time) + stats::rnorm(length(time), sd = 0.002)
  fit <- fit_swing(data.frame(time_s = time, theta_rad = y), "spring")
  fit$swings$amplitude_rad[] <- 0.25
  fit$swings$amplitude_rad[which(fit$swings$used)[1]] <- 0.75
  used <- sum(fit$swings$used)
  size <- sqrt((0.75^2 + (used - 1) * 0.25^2) / used)
  expect_output(print(fit), format_si(size, 3), fixed = TRUE)
})

test_that("the error of a period is that of the scatter of its swings", {
  used <- data.frame(period0_s = 1.5 + c(1, -1, 1, -1, 0, 1, -1, 0) / 100, amplitude_rad = 0.2)
  found <- period_of_swings(used, list(decay_per_s = measured(0, 0)))
  expect_equal(found$value, 1.5)
  # A standard deviation of 0.0093 s; neighbours that may be correlated leave 8/3 of the eight.
  expect_equal(found$u, sqrt(6e-4 / 7) / sqrt(8 / 3), tolerance = 1e-6)
})

# A trifilar pendulum at 1.17 rad is no spring: its restoring torque bends, its period is
# T = 4 int_0^(pi/2) sqrt((I + m h'^2) (h + h_A)/(2 m g R r (1 - k^2 sin^2 phi))) dphi with
# sin(theta/2) = k sin phi.
test_that("a law that does not fit gives the period of the swings, and ends", {
  height <- function(theta) sqrt(0.6^2 - 0.07^2 - 4 * 0.006 * sin(theta / 2)^2)
  slope <- function(theta) -0.006 * sin(theta) / height(theta)
  motion <- function(x) {
    h1 <- slope(x[1])
    h2 <- (-0.006 * cos(x[1]) - h1^2) / height(x[1])
    c(x[2], 0.9 * h1 * (9.80665 - h2 * x[2]^2) / (0.002 + 0.9 * h1^2))
  }
  x <- matrix(c(1.17, 0), 2, 1500)
  for (i in 1:1499) {
    k1 <- motion(x[, i])
    k2 <- motion(x[, i] + 0.01 * k1)
    k3 <- motion(x[, i] + 0.01 * k2)
    k4 <- motion(x[, i] + 0.02 * k3)
    x[, i + 1] <- x[, i] + 0.02 / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
  }
  k <- sin(1.17 / 2)
  quarter <- stats::integrate(function(phi) {
    theta <- 2 * asin(k * sin(phi))
    sqrt((0.002 + 0.9 * slope(theta)^2) * (height(theta) + height(1.17)) /
           (2 * 0.9 * 9.80665 * 0.006 * (1 - (k * sin(phi))^2)))
  }, 0, pi / 2, rel.tol = 1e-10)
  for (seed in c(1, 3, 4)) {
    set.seed(seed)
    y <- x[1, ] + stats::rnorm(1500, sd = 1e-3)
    on.exit(setTimeLimit())
    setTimeLimit(elapsed = 60)
    fit <- fit_swing(data.frame(time_s = 0:1499 / 50, theta_rad = y), "spring")
    setTimeLimit()
    expect_false(fit$law_complete)
    expect_lt(abs(fit$period_s$value - 4 * quarter$value), 4 * fit$period_s$u)
    expect_lt(fit$period_s$u, 1e-3)
  }
})

test_that("records whose squares leave double precision are refused", {
  time_s <- 0:200 / 20
  y <- 0.5 * exp(-0.05 * time_s) * cos(5 * time_s)
  for (size in list(c(1, 1e-160), c(1e-200, 1), c(1e200, 1), c(1, 1e150))) {
    record <- data.frame(time_s = size[1] * time_s, theta_rad = size[2] * y)
    expect_error(fit_swing(record, "spring"), class = "rotdyn_error_range")
    expect_error(fit_coast_down(record), class = "rotdyn_error_range")
  }
})
