# Motions in closed form, with noise of known size.
noisy <- function(time, theta, sd, seed) {
  set.seed(seed)
  data.frame(time_s = time, theta_rad = theta + stats::rnorm(length(time), sd = sd))
}

test_that("a polynomial motion without noise comes back exact", {
  time <- sqrt(2) * (0:60) / 60
  exact <- data.frame(time_s = time, theta_rad = 0.3 + 2 * time - 1.7 * time^2)
  motion <- estimate_motion(exact)
  expect_equal(motion$theta_rad, exact$theta_rad, tolerance = 1e-13)
  expect_equal(motion$omega_rad_per_s, 2 - 3.4 * time, tolerance = 1e-11)
  expect_equal(motion$alpha_rad_per_s2, rep(-3.4, 61), tolerance = 1e-9)
  expect_lt(max(motion$omega_se_rad_per_s), 1e-10)
  expect_true(all(abs(motion$omega_rad_per_s - (2 - 3.4 * time)) < 6 * motion$omega_se_rad_per_s))
})

test_that("intervals hold the true rate and acceleration, and errors are of the right size", {
  time <- seq(0, 10, length.out = 500)
  held <- vapply(1:20, function(seed) {
    motion <- estimate_motion(noisy(time, 3 * sin(time), 0.01, seed), breaks = "none")
    omega <- 3 * cos(time)
    alpha <- -3 * sin(time)
    c(
      mean(omega >= motion$omega_low_rad_per_s & omega <= motion$omega_high_rad_per_s),
      mean(alpha >= motion$alpha_low_rad_per_s2 & alpha <= motion$alpha_high_rad_per_s2),
      sqrt(mean((motion$omega_rad_per_s - omega)^2)) / mean(motion$omega_se_rad_per_s)
    )
  }, double(3))
  expect_gt(mean(held[1, ]), 0.91)
  expect_lt(mean(held[1, ]), 0.99)
  expect_gt(mean(held[2, ]), 0.93)
  expect_lt(abs(mean(held[3, ]) - 1), 0.2)
})

test_that("torque, power and energy follow from the inertia", {
  time <- seq(0, 4, length.out = 200)
  record <- noisy(time, 5 * time^2, 1e-3, 3)
  motion <- estimate_motion(record, inertia = 0.2, breaks = "none")
  expect_equal(motion$net_torque_n_m, 0.2 * motion$alpha_rad_per_s2)
  expect_equal(motion$net_torque_se_n_m, 0.2 * motion$alpha_se_rad_per_s2)
  expect_equal(motion$power_w, 0.2 * motion$alpha_rad_per_s2 * motion$omega_rad_per_s)
  expect_equal(motion$rotational_kinetic_energy_j, 0.1 * motion$omega_rad_per_s^2)
  body <- estimate_motion(record, inertia = body_disk(2, 0.25), breaks = "none")
  expect_equal(body$net_torque_n_m, 0.0625 * body$alpha_rad_per_s2)
  # The applied torque works against the resistance.
  pushed <- estimate_motion(
    record, inertia = 0.2, resistance = resistance(viscous_n_m_s = 0.1), breaks = "none"
  )
  expect_equal(
    pushed$applied_torque_n_m, 0.2 * pushed$alpha_rad_per_s2 + 0.1 * pushed$omega_rad_per_s
  )
  expect_error(
    estimate_motion(record, resistance = resistance(0.1)), class = "rotdyn_error_missing"
  )
})

test_that("a motion that turns backwards is estimated as its mirror image", {
  time <- seq(0, 5, length.out = 200)
  record <- noisy(time, 4 * time + sin(time), 1e-3, 4)
  motion <- estimate_motion(record)
  record$theta_rad <- -record$theta_rad
  mirrored <- estimate_motion(record)
  expect_equal(mirrored$omega_rad_per_s, -motion$omega_rad_per_s)
  expect_equal(mirrored$alpha_se_rad_per_s2, motion$alpha_se_rad_per_s2)
})

test_that("too few samples and turns that are not seen are refused", {
  time <- seq(0, 1, length.out = 10)
  expect_error(estimate_motion(noisy(time, time, 0.01, 1)), class = "rotdyn_error_size")
  time <- seq(0, 1, length.out = 20)
  expect_warning(estimate_motion(noisy(time, time, 0.01, 1)), class = "rotdyn_warning_size")
  time <- seq(0, 4, length.out = 41)
  fast <- noisy(time, 40 * time, 0.01, 1)
  expect_error(estimate_motion(fast), class = "rotdyn_error_value")
  expect_equal(
    estimate_motion(fast, turns = "counted")$omega_rad_per_s, rep(40, 41), tolerance = 1e-2
  )
  expect_error(estimate_motion(1:10), class = "rotdyn_error_type")
  expect_error(estimate_motion(fast, braeks = "none"), class = "rotdyn_error_argument")
})

test_that("rates give rate and acceleration, and the angle turned", {
  time <- seq(0, 10, by = 0.01)
  set.seed(5)
  record <- data.frame(
    time_s = time, omega_rad_per_s = 2 * cos(time) + stats::rnorm(length(time), sd = 0.02)
  )
  motion <- estimate_motion(record)
  off <- function(x, truth, se) sqrt(mean(((x - truth) / se)^2))
  expect_lt(off(motion$omega_rad_per_s, 2 * cos(time), motion$omega_se_rad_per_s), 1.6)
  expect_lt(off(motion$theta_rad, 2 * sin(time), pmax(motion$theta_se_rad, 1e-9)), 2.5)
  expect_equal(motion$theta_rad[1], 0)
  scaled <- estimate_motion(record, rate_scale_u = 0.02)
  expect_equal(
    scaled$omega_se_rad_per_s^2,
    motion$omega_se_rad_per_s^2 + (0.02 * motion$omega_rad_per_s)^2
  )
})
