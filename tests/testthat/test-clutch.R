test_that("an engagement has its textbook time, speed and heat", {
  table <- clutch_engagement(2, 3, c(6, 12, Inf), 10)
  expect_named(table, engagement_columns)
  expect_equal(table$lock_time_s, c(2, 1, 0), tolerance = 1e-15)
  expect_equal(table$common_omega_rad_per_s, c(4, 4, 4), tolerance = 1e-15)
  # (1/2) I1 I2/(I1 + I2) dw^2, whatever the capacity.
  expect_equal(table$heat_j, c(60, 60, 60), tolerance = 1e-15)
})

test_that("torques help or hinder it, and some clutches never lock", {
  # Driven with 5 N m on body 1: 10 - 5/2 = 7.5 rad/s^2.
  table <- clutch_engagement(2, 3, 12, 10, torque_1_n_m = c(5, 20, NA))
  expect_equal(table$lock_time_s, c(10 / 7.5, Inf, NA), tolerance = 1e-15)
  expect_equal(table$common_omega_rad_per_s, c(4 + 10 / 7.5, NA, NA), tolerance = 1e-15)
  expect_equal(table$heat_j, c(80, Inf, NA), tolerance = 1e-15)
  expect_equal(table$locked_torque_n_m, c(3, 12, NA))
  expect_error(clutch_engagement(0, 3, 12, 10), class = "rotdyn_error_value")
  expect_error(clutch_engagement(2, 3, -1, 10), class = "rotdyn_error_value")
  expect_error(clutch_engagement(2:3, 1:3, 1, 10), class = "rotdyn_error_size")
})

test_that("the table agrees with the motion", {
  scene <- scene_clutch(0.3, 1.7, 4, torque = list(1, -2), omega0_rad_per_s = c(30, -5))
  row <- clutch_engagement(0.3, 1.7, 4, 30, -5, torque_1_n_m = 1, torque_2_n_m = -2)
  motion <- trajectory(scene, row$lock_time_s + 1, 1e-9)
  expect_equal(motion$heat_j, row$heat_j, tolerance = 1e-14)
  expect_equal(motion$omega_1_rad_per_s, row$common_omega_rad_per_s - 1 / 2, tolerance = 1e-14)
})

test_that("an engagement beyond plain products is found, or said", {
  # Reduced inertia 1e-300: 1/2 1e-300 (1e300)^2 J, in 1e-300 1e300/1e300 s; 1e-300 rad/s remain.
  x <- clutch_engagement(1e-300, 1e300, 1e300, 1e300)
  expect_within(x$heat_j, 5e299, 1e-14)
  expect_within(x$lock_time_s, 1e-300, 1e-14)
  expect_within(x$common_omega_rad_per_s, 1e-300, 1e-14)
  # The same engagement in other units: inertia 2^k, rate 2^m, torque 2^(k + 2 m).
  engage <- function(k, m) {
    x <- clutch_engagement(3 * 2^k, 5 * 2^k, 7 * 2^(k + 2 * m), 4 * 2^m, -2^m,
                           torque_1_n_m = 2^(k + 2 * m), torque_2_n_m = -3 * 2^(k + 2 * m))
    c(x$lock_time_s * 2^m, x$common_omega_rad_per_s / 2^m, x$heat_j / 2^(k + 2 * m),
      x$locked_torque_n_m / 2^(k + 2 * m))
  }
  plain <- engage(0, 0)
  for (k in c(-900, -500, 400)) expect_equal(engage(k, 250), plain, tolerance = 1e-14)
  # By hand: torque 7 against 1 (5) + 3 (3) over 8; slip 5.
  expect_equal(plain[4], (5 * 1 + 3 * 3) / 8)
  expect_equal(plain[1], 5 / ((7 - 14 / 8) * (1 / 3 + 1 / 5)))
  expect_warning(clutch_engagement(1e308, 1e308, 1e308, 1e308), class = "rotdyn_warning_range")
  expect_silent(clutch_engagement(1, 1, 1, 1, torque_1_n_m = 1e300)) # never locks
})

test_that("a clutch that cannot hold the speeds equal does not lock", {
  # The torque on body 1 carries its speed through that of body 2.
  got <- clutch_engagement(1, 2, 1, 1, 4, torque_1_n_m = 300)
  expect_identical(got$lock_time_s, Inf)
  expect_identical(got$heat_j, Inf)
  expect_true(is.na(got$common_omega_rad_per_s))
  expect_equal(got$locked_torque_n_m, 200)
  scene <- scene_clutch(1, 2, 1, torque = list(300, 0), omega0_rad_per_s = c(1, 4))
  expect_false(any(trajectory(scene, seq(0, 0.03, by = 0.003))$locked))
  # Equal speeds from the start.
  expect_identical(clutch_engagement(1, 2, 0.1, 1, 1, torque_1_n_m = 30)$lock_time_s, Inf)
  expect_identical(clutch_engagement(1, 2, 20, 1, 1, torque_1_n_m = 30)$lock_time_s, 0)
  expect_identical(clutch_engagement(1, 2, 19, 1, 1, torque_1_n_m = 30)$lock_time_s, Inf)
  expect_identical(clutch_engagement(1, 2, 19, 1, 1, torque_1_n_m = 3e100)$lock_time_s, Inf)
  # Without capacity there is no lock; the heat of slip has no end.
  expect_identical(clutch_engagement(1, 2, 0, 4, 1)$heat_j, Inf)
})
