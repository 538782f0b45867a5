test_that("r F sin(phi) and r x F", {
  expect_identical(torque_of_force(40, 0.25, c(90, 30, 0, -90, 180)), c(10, 5, 0, -10, 0))
  expect_identical(torque_of_force(c(1, NA), 2), c(2, NA))
  # By hand: (2 - 0) 6 - 3 * 5, ...
  expect_identical(torque_of_force(c(4, 5, 6), position_m = c(1, 2, 3)), c(x = -3, y = 6, z = -3))
  expect_identical(torque_of_force(c(4, 5, 6), position_m = c(1, 2, 3), about_m = c(1, 2, 2)),
    c(x = -5, y = 4, z = 0))
  # A couple has the same moment about any point.
  couple <- function(p) torque_of_force(c(0, 3, 0), position_m = c(2, 0, 0),
    about_m = p) + torque_of_force(c(0, -3, 0), position_m = p, about_m = p)
  expect_equal(couple(c(0, 0, 0))[["z"]], 6)
  skip_if_not_installed("units")
  expect_identical(torque_of_force(units::set_units(1, "kN"), units::set_units(5, "cm")), 50)
})

test_that("r m v sin(phi) and r x m v", {
  expect_identical(angular_momentum_of(2, 3, 0.5, c(90, -30)), c(3, -1.5))
  # A puck on a straight line: the same all along.
  at <- function(x) angular_momentum_of(0.5, velocity_m_per_s = c(20, 0, 0),
    position_m = c(x, -0.25, 0))
  expect_identical(at(-7), c(x = 0, y = 0, z = 2.5))
  expect_identical(at(3), at(-7))
  # A rigid body of points: I omega.
  r <- c(0.3, 0.4, 0)
  v <- 7 * c(-r[2], r[1], 0)
  expect_equal(angular_momentum_of(2, velocity_m_per_s = v, position_m = r)[["z"]], 2 * 0.25 * 7,
    tolerance = 1e-15)
})

test_that("errors and warnings", {
  expect_error(torque_of_force(1), class = "rotdyn_error_missing")
  expect_error(torque_of_force(1, -1), class = "rotdyn_error_value")
  expect_error(torque_of_force(Inf, 1), class = "rotdyn_error_value")
  expect_error(torque_of_force(1:2, 1:3), class = "rotdyn_error_size")
  expect_error(torque_of_force("1", 1), class = "rotdyn_error_type")
  expect_error(torque_of_force(1, position_m = c(1, 2, 3)), class = "rotdyn_error_size")
  expect_error(angular_momentum_of(-1, 1, 1), class = "rotdyn_error_value")
  expect_error(angular_momentum_of(-1, velocity_m_per_s = c(1, 1, 1), position_m = c(1, 1, 1)),
    class = "rotdyn_error_value")
  expect_warning(torque_of_force(1e300, 1e300), class = "rotdyn_warning_range")
})
