test_that("textbook: a bucket on a well, Atwood's machine", {
  # a = g/(1 + M/(2 m)) for a disk of M; v^2 = 2 a h.
  well <- scene_hanging_mass(body_disk(2, 0.1), 0.5, 0.1)
  fallen <- when(well, theta_rad = 30)
  expect_equal(fallen$time_s, sqrt(2 * 3 / (9.80665 / 3)), tolerance = 1e-14)
  expect_equal(0.1 * fallen$omega_rad_per_s, sqrt(2 * 9.80665 / 3 * 3), tolerance = 1e-14)
  # The energy is that of both: m g h.
  expect_equal(fallen$rotational_kinetic_energy_j, 0.5 * 9.80665 * 3, tolerance = 1e-14)
  atwood <- scene_hanging_mass(0, 1.1, 0.05, counter_mass_kg = 1)
  expect_equal(0.05 * trajectory(atwood, 1)$omega_rad_per_s, 9.80665 * (1.1 - 1) / 2.1,
    tolerance = 1e-14)
  # The heavier one on the other side pulls it up.
  up <- scene_hanging_mass(0.01, 1, 0.05, counter_mass_kg = 2)
  expect_equal(trajectory(up, 2)$omega_rad_per_s, -9.80665 * 0.05 / (0.01 + 3 * 0.0025) * 2,
    tolerance = 1e-14)
})

test_that("the radius of the rope need not be that of the body; losses", {
  drum <- scene_hanging_mass(body_disk(2, 0.5), 0.5, 0.1, resistance(0.02))
  expect_equal(drum$moment_of_inertia_kg_m2, 0.25 + 0.005)
  expect_equal(stopping(drum)$terminal_omega_rad_per_s, 0.5 * 9.80665 * 0.1 / 0.02)
})

test_that("errors", {
  expect_error(scene_hanging_mass(1, 1), class = "rotdyn_error_missing")
  expect_error(scene_hanging_mass(-1, 1, 1), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass("disk", 1, 1), class = "rotdyn_error_type")
  expect_error(scene_hanging_mass(1, 0, 1), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass(1, 1, 0), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass(1, 1, 1, counter_mass_kg = -1), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass(1, 1e300, 1e300), class = "rotdyn_error_value")
})
