test_that("inertia is reflected with the square of the ratio", {
  expect_equal(reflected_inertia(0.5, c(1, 5, -10, NA)), c(0.5, 0.02, 0.005, NA))
  expect_equal(reflected_inertia(1e-250, 1e-200), 1e150)
  expect_error(reflected_inertia(1, 0), class = "rotdyn_error_value")
  expect_error(reflected_inertia(-1, 2), class = "rotdyn_error_value")
})

test_that("a train reflects everything to the first shaft", {
  train <- gear_train(c(0.01, 0.5, 8), c(5, -2), efficiency = c(0.9, 0.8),
                      torque_n_m = c(2, -4, -30), viscous_n_m_s = c(0.1, 0.5, 1))
  expect_named(train, gear_columns)
  expect_equal(train$ratio_to_first, c(1, 5, -10))
  expect_equal(train$reflected_inertia_kg_m2, c(0.01, 0.02, 0.08))
  expect_equal(train$reflected_viscous_n_m_s, c(0.1, 0.02, 0.01))
  # The load of 4 N m costs more than 4/5; the third shaft turns backwards, so -30 N m drives it.
  expect_equal(train$reflected_torque_n_m, c(2, -0.8 / 0.9, 3 * 0.72))
  expect_error(gear_train(1:3, c(2, 0)), class = "rotdyn_error_value")
  expect_error(gear_train(1:3, 2, efficiency = 1.1), class = "rotdyn_error_value")
  expect_error(gear_train(1:3, 1:3), class = "rotdyn_error_size")
})

test_that("the scene of a train is its first shaft", {
  scene <- scene_gears(c(0.01, 0.5), 5, torque_n_m = c(2, -4), viscous_n_m_s = c(0, 0.5),
                       omega0_rad_per_s = 3)
  expect_s3_class(scene, "rot_scene_axle")
  expect_equal(scene$moment_of_inertia_kg_m2, 0.03)
  expect_equal(scene$resistance$viscous_n_m_s, 0.02)
  # 1.2 N m on 0.03 kg m^2 with 0.02 N m s, from 3 rad/s, 1.5 s on: 60 - 57/e
  motion <- trajectory(scene, 1.5)
  expect_equal(motion$omega_rad_per_s, 60 - 57 * exp(-1), tolerance = 1e-14)
})
