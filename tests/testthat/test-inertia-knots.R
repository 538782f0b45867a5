test_that("an inertia that only jumps has its value before and after", {
  jump <- inertia_knots(c(1, 1), c(5, 2))
  m <- trajectory(scene_axle(jump, omega0_rad_per_s = 2), c(0, 1, 3))
  expect_equal(m$moment_of_inertia_kg_m2, c(5, 2, 2))
  expect_equal(m$omega_rad_per_s, c(2, 5, 5))
  expect_equal(audited(m)$verdict, "balanced")
  expect_error(inertia_knots(c(-1e308, 1e308), c(1, 2)), class = "rotdyn_error_value")
})

test_that("knots need times in order and inertias above 0, and print themselves", {
  expect_error(inertia_knots(c(1, 0), c(1, 2)), class = "rotdyn_error_time")
  expect_error(inertia_knots(0:1, c(1, 0)), class = "rotdyn_error_value")
  expect_error(inertia_knots(0:1, 1), class = "rotdyn_error_size")
  expect_error(inertia_knots("a", 1), class = "rotdyn_error_type")
  expect_output(print(inertia_knots(0:1, c(5, 2))), "5")
})
