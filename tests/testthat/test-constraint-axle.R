# 1 kg m^2 about its centre, 1 kg at 2 m: 5 kg m^2 about the axle, of which 1 is the body's own.
test_that("an uncertain moment counts for its own part of that about the axle", {
  rough <- body_tensor(1, c(1, 1, 1), centre_m = c(2, 0, 0))
  rough$error <- 0.01
  scene <- scene_axle(rough, 5, through = "origin")
  expect_equal(scene$moment_of_inertia_kg_m2, 5)
  more <- rotdyn:::with_moment(scene, 1, 1.1)
  again <- scene_axle(more$body, 5, through = "origin")
  expect_equal(again$moment_of_inertia_kg_m2, 5.5, tolerance = 1e-14)
  hung <- scene_hanging_mass(rough, 1, 0.5)
  more <- rotdyn:::with_moment(hung, 1, 1.1)
  again <- scene_hanging_mass(more$body, 1, 0.5)
  expect_equal(
    again$moment_of_inertia_kg_m2, 1.1 * hung$moment_of_inertia_kg_m2, tolerance = 1e-14
  )
})

test_that("a scene knows its torque and what resists, whoever made it", {
  torque <- function(scene) rotdyn:::axle_torque(scene)
  resists <- function(scene) rotdyn:::axle_resistance(scene)$viscous_n_m_s
  expect_identical(torque(scene_axle(1)), torque_constant(0))
  expect_identical(torque(scene_axle(1, 3)), torque_constant(3))
  expect_identical(resists(scene_axle(1)), 0)
  swing <- scene_pendulum(body_point(2), 0.5, resistance(0.25), gravity_m_per_s2 = 10)
  expect_identical(torque(swing), torque_gravity(2, 0.5, gravity_m_per_s2 = 10))
  expect_identical(resists(swing), 0.25)
  driven <- scene_pendulum(body_point(2), 0.5, torque = 3, gravity_m_per_s2 = 10)
  expect_identical(
    torque(driven), torque_gravity(2, 0.5, gravity_m_per_s2 = 10) + torque_constant(3)
  )
  well <- scene_hanging_mass(1, 3, 0.5, counter_mass_kg = 1, gravity_m_per_s2 = 10)
  expect_identical(torque(well), torque_constant(10))
  train <- scene_gears(c(1, 4), 2, torque = c(3, -2), resistance = c(0.5, 1))
  expect_identical(torque(train), torque_constant(2))
  expect_identical(resists(train), 0.75)
})

test_that("the heat of an axle is the sum of its three parts", {
  scene <- scene_axle(
    2, 1, resistance(0.3, 0.05, coulomb_n_m = 0.2), omega0_rad_per_s = 5
  )
  x <- generics::augment(trajectory(scene, c(0, 1, 3)))
  parts <- cbind(x$dissipated_viscous_j, x$dissipated_quadratic_j, x$dissipated_coulomb_j)
  expect_true(all(parts[3, ] > 0.1))
  expect_equal(x$dissipated_j, rowSums(parts), tolerance = 1e-14)
  # The work of the torque less the kinetic energy gained.
  expect_equal(
    x$dissipated_j[3], x$work_j[3] - (x$omega_rad_per_s[3]^2 - 25), tolerance = 1e-9
  )
})
