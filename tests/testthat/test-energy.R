test_that("energies by hand: m = 2, r = 3, beta = 0.5, v = 4", {
  table <- energy_partition(0.5, 4, mass_kg = 2, radius_m = 3)
  expect_equal(table$translational_kinetic_energy_j, 16)
  expect_equal(table$rotational_kinetic_energy_j, 8)
  expect_equal(table$total_kinetic_energy_j, 24)
  expect_equal(table$moment_of_inertia_kg_m2, 9)
  expect_equal(table$omega_rad_per_s, 4 / 3)
  expect_equal(table$rotational_energy_fraction, 1 / 3)
})

test_that("the two parts are I omega^2/2 and m v^2/2", {
  table <- energy_partition(c(1, 0.4), -6, mass_kg = c(2, 5), radius_m = c(3, 0.7))
  expect_equal(
    table$rotational_kinetic_energy_j,
    table$moment_of_inertia_kg_m2 * table$omega_rad_per_s^2 / 2
  )
  expect_equal(table$translational_kinetic_energy_j, table$mass_kg * table$speed_m_per_s^2 / 2)
  expect_equal(
    table$rotational_energy_fraction,
    table$rotational_kinetic_energy_j / table$total_kinetic_energy_j
  )
})

test_that("NA in, NA out; what is impossible is an error; lengths recycle as a tibble's", {
  expect_equal(energy_partition(c(0.5, NA), 4, mass_kg = 2,
    radius_m = 3)$rotational_kinetic_energy_j, c(8, NA))
  expect_equal(nrow(energy_partition(0.5, 4, mass_kg = numeric(), radius_m = 3)), 0)
  expect_error(energy_partition(1, 1, mass_kg = 1, radius_m = 0), class = "rotdyn_error_value")
  expect_error(energy_partition(1, 1, mass_kg = -1, radius_m = 1), class = "rotdyn_error_value")
  expect_error(energy_partition(-1, 1, mass_kg = 1, radius_m = 1), class = "rotdyn_error_value")
  expect_error(energy_partition(1, 1, mass_kg = 1:2, radius_m = 1:3), class = "rotdyn_error_size")
})

test_that("textbook: stopping a 40 kg solid cylinder that rolls at 6 m/s takes 1080 J", {
  # University Physics 1, section 11.1 (OpenStax).
  expect_equal(energy_partition(0.5, 6, mass_kg = 40, radius_m = 0.2)$total_kinetic_energy_j, 1080)
})

test_that("an energy that is a double is found; what is beyond is said", {
  x <- suppressWarnings(energy_partition(1e-300, 1e10, mass_kg = 1e300, radius_m = 1))
  expect_equal(x$rotational_kinetic_energy_j, 5e19, tolerance = 1e-14)
  expect_warning(energy_partition(0.5, 1e200, mass_kg = 1e200, radius_m = 1e200),
    class = "rotdyn_warning_range")
  expect_silent(energy_partition(1, 1, mass_kg = NA, radius_m = 1))
})

test_that("kinetic energy of what turns, flies, or does both", {
  expect_identical(kinetic_energy(body_disk(2, 0.5), c(2, NA)), c(0.5, NA))
  expect_identical(kinetic_energy(0.25, 2), 0.5)
  # m v^2/2 + I omega^2/2.
  expect_identical(kinetic_energy(body_disk(2, 0.5), 2, 3), 9.5)
  expect_identical(kinetic_energy(0.25, 2, 3, mass_kg = 2), 9.5)
  # On its axle: about the end; in flight: about the centre of mass.
  rod <- body_rod_end(3, 2)
  expect_equal(kinetic_energy(rod, 1), 2)
  expect_equal(kinetic_energy(rod, 1, 1), 0.5 + 1.5)
  # A body that rolls, as energy_partition() has it.
  ball <- body_sphere(2, 0.1)
  expect_equal(kinetic_energy(ball, 30, 3), energy_partition(ball, 3)$total_kinetic_energy_j)
  expect_error(kinetic_energy(0.25, 2, 3), class = "rotdyn_error_missing")
  expect_error(kinetic_energy(body_disk(2, 0.5), 2, mass_kg = 3), class = "rotdyn_error_argument")
  expect_error(kinetic_energy(-1, 2), class = "rotdyn_error_value")
  expect_error(kinetic_energy(1, 2, 3, mass_kg = -1), class = "rotdyn_error_value")
  expect_error(kinetic_energy(1:2, 1:3), class = "rotdyn_error_size")
  expect_error(kinetic_energy(1), class = "rotdyn_error_missing")
  expect_warning(kinetic_energy(1, 1e200), class = "rotdyn_warning_range")
})
