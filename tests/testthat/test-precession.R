test_that("the gyroscopes of the article precess at m g l/(I3 omega3)", {
  out <- precession_table()
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
  least <- function(lever_arm_m) {
    precession_table(
      data.frame(mass_kg = 0.5, lever_arm_m, moment_of_inertia_kg_m2 = 0.002, spin_rad_per_s = 1),
      transverse_moment_kg_m2 = 0.0042
    )$sleeping_spin_rad_per_s
  }
  spin <- least(0.08)
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
  expect_identical(least(-0.08), 0)
})

test_that("bad tops are refused with the row", {
  top <- data.frame(
    mass_kg = 1, lever_arm_m = 0.1, moment_of_inertia_kg_m2 = 0.01, spin_rad_per_s = c(9, 0)
  )
  expect_error(precession_table(top), "row 2", class = "rotdyn_error_value")
  for (name in c("moment_of_inertia_kg_m2", "transverse_moment_kg_m2", "mass_kg")) {
    bad <- top
    bad$transverse_moment_kg_m2 <- 2e-3
    bad[[name]][2] <- if (name == "mass_kg") -1 else 0
    expect_error(precession_table(bad), paste0(name, ".*row 2"), class = "rotdyn_error_value")
  }
  expect_error(precession_table(top[-4]), class = "rotdyn_error_type")
  expect_error(precession_table(1), class = "rotdyn_error_type")
  expect_error(precession_table(top[1, ], axis_angle_deg = 181), class = "rotdyn_error_value")
  expect_error(precession_table(top[1, ], axis_angle_deg = 1:2), class = "rotdyn_error_size")
  expect_error(
    precession_table(top[1, ], transverse_moment_kg_m2 = 0.004), "half",
    class = "rotdyn_error_value"
  )
  # A flat body has exactly half.
  expect_no_error(precession_table(top[1, ], transverse_moment_kg_m2 = 0.005))
  expect_error(precession_table(top[1, ], radius_m = 9), class = "rotdyn_error_argument")
  top$spin_rad_per_s[2] <- NA
  out <- precession_table(top)
  expect_identical(out$precession_rad_per_s[2], NA_real_)
  expect_false(is.na(out$precession_rad_per_s[1]))
  expect_identical(nrow(precession_table(top[0, ])), 0L)
})

test_that("bodies and scenes are tops, too", {
  # A cone on its tip: I3 = 3 m R^2/10, I1 about the tip 3 m (R^2/4 + h^2)/5, centre at 3 h/4.
  cone <- body_cone(0.5, 0.04, 0.1)
  top <- place_body(cone, c(0, 0, 0.1), rotation_about("x", angle_deg = 180))
  by_body <- precession_table(top, axis_angle_deg = 30, spin_rad_per_s = 500)
  by_hand <- precession_table(
    data.frame(
      mass_kg = 0.5, lever_arm_m = 0.075, moment_of_inertia_kg_m2 = 0.3 * 0.5 * 0.04^2,
      spin_rad_per_s = 500
    ),
    axis_angle_deg = 30, transverse_moment_kg_m2 = 0.6 * 0.5 * (0.04^2 / 4 + 0.1^2)
  )
  expect_equal(by_body[names(by_hand)], by_hand, tolerance = 1e-13)
  scene <- scene_pivot(
    top, c(0, 0, 500), attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  )
  by_scene <- precession_table(scene)
  expect_equal(by_scene[names(by_hand)], by_hand, tolerance = 1e-13)
  expect_equal(by_scene$axis_angle_deg, 30, tolerance = 1e-14)
  both <- precession_table(list(scene, update(scene, gravity_m_per_s2 = 1.6)))
  expect_equal(both$precession_rad_per_s[2] / both$precession_rad_per_s[1], 1.6 / 9.80665)
  # A wheel held beside its centre.
  wheel <- precession_table(body_hoop(2, 0.3), spin_rad_per_s = c(20, 40), lever_arm_m = 0.1)
  expect_equal(wheel$precession_rad_per_s, 9.80665 * 0.1 / (0.09 * c(20, 40)))
  expect_equal(wheel$sleeping_spin_rad_per_s[1],
               2 * sqrt((0.09 + 0.02) * 2 * 9.80665 * 0.1) / 0.18)
  expect_error(precession_table(body_hoop(2, 0.3)), class = "rotdyn_error_missing")
  expect_error(precession_table(body_box(1, 1, 2, 3), spin_rad_per_s = 1, lever_arm_m = 1),
               class = "rotdyn_error_value")
  expect_error(precession_table(scene, gravity_m_per_s2 = 1), class = "rotdyn_error_argument")
  expect_error(precession_table(scene_pivot(body_box(1, 1, 2, 3), c(0, 0, 1),
    pivot_m = c(0, 0, 1))),
               class = "rotdyn_error_model")
})
