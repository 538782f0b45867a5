test_that("the gyroscopes of the article precess at m g l/(I3 omega3)", {
  file <- system.file("extdata", "gyroscope_cases.csv", package = "rotdyn")
  out <- precession_table(utils::read.csv(file))
  # Products of the decimal figures, by hand.
  expect_equal(out$gravity_torque_n_m, c(0.392266, 0.980665, 2.353596), tolerance = 1e-15)
  expect_equal(out$spin_angular_momentum_kg_m2_per_s, c(1, 1.8, 2.4), tolerance = 1e-15)
  expect_equal(
    out$precession_rad_per_s, c(0.392266, 0.980665 / 1.8, 0.980665), tolerance = 1e-15
  )
  expect_equal(
    out$precession_period_s, c(16.017664817189322, 11.532718668376311, 6.407065926875728),
    tolerance = 1e-15
  )
  expect_identical(out$formula_error, c(0, 0, 0))
  expect_false("nutation_period_s" %in% names(out))
})

test_that("tops at an angle: exact rates, what the formula lacks, the nutation", {
  x <- utils::read.csv(shared("refs", "heavy_top_scalar.csv"))
  out <- precession_table(
    data.frame(
      mass_kg = x$Mgl, lever_arm_m = 1, moment_of_inertia_kg_m2 = x$I3,
      spin_rad_per_s = x$omega3, transverse_moment_kg_m2 = x$I1,
      axis_angle_deg = x$theta0 * 180 / pi
    ),
    gravity_m_per_s2 = 1
  )
  expect_equal(out$slow_precession_rad_per_s, x$steady_slow, tolerance = 1e-15)
  tilted <- x$theta0 != pi / 2
  expect_equal(
    out$fast_precession_rad_per_s[tilted], x$steady_fast[tilted], tolerance = 2e-15
  )
  expect_true(all(is.nan(out$fast_precession_rad_per_s[!tilted])))
  expect_equal(out$precession_rad_per_s, x$gyro_approx, tolerance = 1e-15)
  expect_equal(out$nutation_period_s, x$nutation_period_released, tolerance = 4e-15)
  expect_equal(cos(out$lowest_angle_deg * pi / 180), x$cos_theta_low, tolerance = 1e-14)
  expect_equal(
    out$mean_precession_rad_per_s * out$nutation_period_s, x$precession_per_nutation_released,
    tolerance = 4e-15
  )
  price <- 4 * x$I1 * x$Mgl * cos(x$theta0) / (x$I3 * x$omega3)^2
  expect_true(all(out$formula_error <= abs(price)))
})

test_that("the least spin of a sleeping top divides the stable from the falling", {
  spin <- sleeping_top_spin(0.002, 0.0042, mass_kg = 0.5, lever_arm_m = 0.08)
  expect_equal(spin, 2 * sqrt(0.0042 * 0.5 * 0.08 * 9.80665) / 0.002, tolerance = 1e-15)
  top <- function(factor) {
    precession_table(
      data.frame(
        mass_kg = 0.5, lever_arm_m = 0.08, moment_of_inertia_kg_m2 = 0.002,
        spin_rad_per_s = factor * spin
      ),
      axis_angle_deg = 0.01, transverse_moment_kg_m2 = 0.0042
    )$lowest_angle_deg
  }
  expect_lt(top(1.05), 0.05)
  expect_gt(top(0.95), 10)
  expect_identical(sleeping_top_spin(0.002, 0.0042, 0.5, -0.08), 0)
})

test_that("bad tops are refused with the row", {
  top <- data.frame(
    mass_kg = 1, lever_arm_m = 0.1, moment_of_inertia_kg_m2 = 0.01, spin_rad_per_s = c(9, 0)
  )
  expect_error(precession_table(top), "row 2", class = "rotdyn_error_value")
  expect_error(precession_table(top[-4]), class = "rotdyn_error_type")
  expect_error(precession_table(1), class = "rotdyn_error_type")
  expect_error(precession_table(), class = "rotdyn_error_missing")
  expect_error(precession_table(top[1, ], axis_angle_deg = 181), class = "rotdyn_error_value")
  expect_error(precession_table(top[1, ], axis_angle_deg = 1:2), class = "rotdyn_error_size")
  expect_error(
    precession_table(top[1, ], transverse_moment_kg_m2 = 0.004), "half",
    class = "rotdyn_error_value"
  )
  expect_error(precession_table(top[1, ], radius_m = 9), class = "rotdyn_error_argument")
  top$spin_rad_per_s[2] <- NA
  out <- precession_table(top)
  expect_identical(out$precession_rad_per_s[2], NA_real_)
  expect_false(is.na(out$precession_rad_per_s[1]))
  expect_identical(nrow(precession_table(top[0, ])), 0L)
})
