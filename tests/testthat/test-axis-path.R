test_that("the axis of a gyroscope in steady precession goes round on a circle", {
  # Horizontal axis: torque/L is exact. 2 N m over 1 kg m^2 x 40 rad/s, with that rate to start.
  rate <- 2 / 40
  across <- attitude_from(c(1, 0, 0, pi / 2), "axis_angle")
  wheel <- scene_pivot(
    c(0.7, 0.7, 1), c(0, rate, 40), mass_kg = 1, centre_m = c(0, 0, 2), gravity_m_per_s2 = 1,
    attitude0 = across
  )
  t <- seq(0, 200, by = 5)
  path <- axis_path(trajectory(wheel, t))
  expect_identical(names(path), c("time_s", axis_path_columns))
  expect_equal(path$axis_inclination_rad, rep(pi / 2, length(t)), tolerance = 1e-12)
  # It begins along -y, and goes on beyond a turn.
  expect_equal(path$axis_azimuth_rad, -pi / 2 + rate * t, tolerance = 1e-11)
  expect_equal(path$axis_x, sin(rate * t), tolerance = 1e-11)
})

test_that("any axis, any quaternions, and what is missing", {
  q <- data.frame(qw = c(1, sqrt(0.5), NA), qx = 0, qy = c(0, sqrt(0.5), 0), qz = 0)
  z <- axis_path(q)
  expect_identical(names(z), axis_path_columns)
  expect_equal(z$axis_x, c(0, 1, NA))
  expect_equal(z$axis_inclination_rad, c(0, pi / 2, NA))
  expect_identical(is.nan(z$axis_azimuth_rad[1]), TRUE)
  expect_equal(axis_path(q, c(2, 0, 0))$axis_z, c(0, -1, NA))
  expect_equal(axis_path(q, "y")$axis_y, c(1, 1, NA))
  # (1, 2, 2)/3 is as far from z as acos(2/3), above atan(2).
  slant <- axis_path(q[1, ], c(1, 2, 2))
  expect_equal(slant$axis_inclination_rad, acos(2 / 3))
  expect_equal(slant$axis_azimuth_rad, atan(2))
  expect_error(axis_path(q[1:3]), class = "rotdyn_error_type")
  expect_error(axis_path(1), class = "rotdyn_error_type")
  expect_error(axis_path(q, "w"), class = "rotdyn_error_value")
  expect_error(axis_path(q, c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(axis_path(q, axes = "z"), class = "rotdyn_error_argument")
  expect_error(axis_path(), class = "rotdyn_error_missing")
  expect_identical(nrow(axis_path(q[0, ])), 0L)
})
