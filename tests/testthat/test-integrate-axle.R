test_that("rows take the law's own value only where it is as small as its rounding", {
  calls <- 0
  law <- function(time_s) {
    calls <<- calls + length(time_s)
    exp(-time_s)
  }
  count <- function(times) {
    calls <<- 0
    trajectory(scene_axle(1, law), times)
    calls
  }
  # From 2e-9 to 1e-11 of its largest value: no row is read again.
  expect_identical(count(c(0, seq(20, 25, length.out = 100), 30)), count(c(0, 30)))
})

test_that("a start at rest on a jump of the angle that pushes back is refused at once", {
  calls <- 0
  valley <- function(above, below) {
    function(time_s, theta_rad, omega_rad_per_s) {
      calls <<- calls + 1
      if (theta_rad > 1) above else below
    }
  }
  start <- function(law, ...) scene_axle(1, law, theta0_rad = 1, ...)
  expect_error(
    trajectory(start(valley(-2, 1)), 0:2), "stays there.*0 N m", class = "rotdyn_error_step"
  )
  expect_lt(calls, 50)
  # Friction holds it; a law of 0 there rests; beside the jump it swings, v^2/2 = torque times way.
  held <- trajectory(start(valley(-2, 1), resistance = resistance(0, coulomb_n_m = 1.5)), 0:2)
  expect_true(all(held$omega_rad_per_s == 0))
  still <- trajectory(start(function(t, theta, omega) -sign(theta - 1)), 0:2)
  expect_true(all(still$theta_rad == 1))
  expect_true(all(audit(still)$verdict == "balanced"))
  beside <- trajectory(scene_axle(1, valley(-2, 1), theta0_rad = 0.5), c(0, 1, 1.5))
  expect_equal(beside$omega_rad_per_s, c(0, 1, 0), tolerance = 1e-9)
  # A push to one side: the last ulp of the angle, 2e-16 rad at 1 N m, takes 2e-8 s of it. And a
  # spring at the place where it is at rest but for rounding.
  away <- trajectory(start(valley(2, 1)), 1)
  expect_equal(away$omega_rad_per_s, 2, tolerance = 2e-8)
  spring <- trajectory(start(function(t, theta, omega) -1e6 * (theta - (1 + 1e-16))), 0:1)
  expect_lt(max(abs(spring$omega_rad_per_s)), 1e-9)
})
