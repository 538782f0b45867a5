torque_at <- function(torque, t) {
  motion <- trajectory(scene_axle(1, torque), t)
  motion$applied_torque_n_m
}

test_that("knots: straight lines, zero outside, the last knot belongs to the law", {
  torque <- torque_knots(c(1, 3), c(2, 6))
  expect_equal(torque_at(torque, c(0, 1, 1.5, 2, 3, 3.1)), c(0, 2, 3, 4, 6, 0))
  held <- torque_knots(c(1, 3), c(2, 6), outside = "hold")
  expect_equal(torque_at(held, c(0, 1, 2, 3, 4)), c(2, 2, 4, 6, 6))
})

test_that("a repeated time is a jump, and at the jump the value after it", {
  torque <- torque_knots(c(0, 2, 2, 4), c(1, 1, 5, 5))
  expect_equal(torque_at(torque, c(1.9, 2, 2.1)), c(1, 5, 5))
})

test_that("knots a rounding apart", {
  t1 <- 1
  t2 <- 1 + 2^-52
  torque <- torque_knots(c(0, t1, t2, 3), c(0, 0, 4, 4))
  motion <- trajectory(scene_axle(2, torque), c(0, 3))
  expect_equal(motion$omega_rad_per_s[2], 4, tolerance = 1e-15)
})

test_that("a constant, a number, a function and nothing at all are torques of a scene", {
  expect_equal(torque_at(torque_constant(3), c(-5, 5)), c(3, 3))
  expect_equal(scene_axle(1, 3)$torque, torque_constant(3))
  expect_null(scene_axle(1)$torque)
  expect_null(scene_axle(1, 0)$torque)
  expect_s3_class(scene_axle(1, function(t) t)$torque, "rot_torque_function")
})

test_that("impossible torques are errors", {
  expect_error(torque_knots(c(0, 2, 1), c(0, 0, 0)), class = "rotdyn_error_time")
  expect_error(torque_knots(c(0, 1), 1), class = "rotdyn_error_size")
  expect_error(torque_knots(1, 1), class = "rotdyn_error_size")
  expect_error(torque_knots(numeric(), numeric()), class = "rotdyn_error_size")
  expect_error(torque_knots(c(0, NA), c(1, 1)), class = "rotdyn_error_value")
  expect_error(torque_knots(c(0, 1), c(1, Inf)), class = "rotdyn_error_value")
  expect_error(torque_knots(c(-1.7e308, 1.7e308), c(1, 1)), class = "rotdyn_error_value")
  expect_error(torque_knots(0:1, 0:1, outside = "repeat"), class = "rotdyn_error_value")
  expect_error(torque_constant(NA), class = "rotdyn_error")
  expect_error(torque_function(2), class = "rotdyn_error_type")
  expect_error(torque_function(function(a, b) 1), class = "rotdyn_error_torque")
  expect_error(torque_function(function() 1), class = "rotdyn_error_torque")
  expect_error(scene_axle(1, "a"), class = "rotdyn_error_type")
})

test_that("functions of one and of three arguments, with defaults and primitives", {
  count <- function(f) torque_function(f)$arguments
  expect_equal(count(function(t) 1), 1)
  expect_equal(count(function(t, scale = 2) 1), 1)
  expect_equal(count(function(t, theta, omega) 1), 3)
  expect_equal(count(sin), 1)
})

test_that("torque laws print in a line", {
  expect_snapshot({
    article_torque()
    torque_constant(0.5)
    torque_knots(c(0, 1, 1, 2), c(0, 0, 3, 3), outside = "hold")
    torque_function(function(t) t)
    torque_function(function(t, theta, omega) -theta, breaks_s = c(1, 2))
  })
})

test_that("knots from a data frame", {
  table <- data.frame(time_s = c(1, 3), torque_n_m = c(2, 6))
  expect_equal(torque_knots(table), torque_knots(c(1, 3), c(2, 6)))
  expect_error(torque_knots(data.frame(time_s = 1:2)), class = "rotdyn_error_type")
  expect_error(torque_knots(1:2), class = "rotdyn_error_missing")
})

test_that("a function without a list of arguments is refused without a warning", {
  expect_silent(expect_error(torque_function(`if`), class = "rotdyn_error_torque"))
})

test_that("a law of the state is called with numbers alone, at rest and beyond the doubles too", {
  seen <- 0
  watched <- function(torque) {
    function(time_s, theta_rad, omega_rad_per_s) {
      if (!is.finite(theta_rad) || !is.finite(omega_rad_per_s)) seen <<- seen + 1
      torque(time_s, theta_rad, omega_rad_per_s)
    }
  }
  still <- watched(function(t, theta, omega) -theta)
  motion <- trajectory(scene_axle(1, still), 0:10)
  expect_identical(motion$theta_rad, double(11))
  trajectory(scene_axle(1, watched(function(t, theta, omega) sin(t) * omega)), 10)
  trajectory(scene_drive(1, torque = watched(function(t, theta, omega) -theta)), 10)
  # omega = 1/(1 - t) leaves the doubles at 1 s.
  expect_error(
    trajectory(scene_axle(1, watched(function(t, theta, omega) omega^2), omega0_rad_per_s = 1), 2),
    class = "rotdyn_error"
  )
  expect_error(
    trajectory(scene_axle(1, watched(function(t, theta, omega) 1e3 * exp(omega))), 2),
    class = "rotdyn_error"
  )
  expect_identical(seen, 0)
})

test_that("of what a law returns NA is a number that is not finite, other logicals are none", {
  run <- function(value) {
    law <- function(time_s, theta_rad, omega_rad_per_s) if (time_s > 0.5) value else 1
    trajectory(scene_axle(1, torque_function(law, breaks_s = 0.5)), 0:2)
  }
  for (value in list(NA, NA_integer_, NaN, Inf)) {
    expect_error(run(value), "gave no finite number", class = "rotdyn_error_torque")
  }
  for (value in list(TRUE, c(1, 2), c(NA, NA), "1", NULL, factor(1))) {
    expect_error(run(value), "must return one number", class = "rotdyn_error_torque")
  }
})

test_that("a brake or a resistance in the place of a torque is said", {
  expect_error(scene_axle(1, brake(2)), "resistance = resistance\\(coulomb_n_m = \\)",
               class = "rotdyn_error_type")
  expect_error(scene_axle(1, resistance(2)), "given by name", class = "rotdyn_error_type")
  expect_error(scene_axle(1, 2, brake(2)), "resistance = resistance\\(coulomb_n_m = \\)",
               class = "rotdyn_error_type")
})
