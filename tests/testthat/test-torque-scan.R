many <- function(f) function(t) rotdyn:::values_of(f, t, stop)
scan <- function(f, from = 0, to = 10) rotdyn:::scan_breaks(many(f), from, to)$breaks

test_that("jumps are found to the last bit", {
  expect_equal(scan(function(t) if (t >= pi) 1 else 0), pi, tolerance = 1e-15)
  expect_equal(scan(function(t) if (t > 2) t else -t), 2, tolerance = 1e-15)
  pulse <- function(t) if (t >= 5 && t < 5.002) 40 else 0
  expect_equal(scan(pulse), c(5, 5.002), tolerance = 1e-15)
})

test_that("kinks are found", {
  expect_equal(scan(function(t) abs(t - pi)), pi, tolerance = 1e-9)
  knots <- approxfun(c(0, 1, 4, 6, 10), c(0, 0.8, 0.8, 0, 0))
  expect_equal(scan(knots), c(1, 4, 6), tolerance = 1e-8)
})

test_that("smooth functions have none, however fast", {
  expect_length(scan(sin), 0)
  expect_length(scan(function(t) sin(200 * t)), 0)
  expect_length(scan(function(t) exp(-t) * t^3), 0)
  expect_length(scan(function(t) tanh(100 * (t - 5))), 0)
  expect_length(scan(function(t) 1 / (1 + 25 * (t - 5)^2)), 0)
  expect_length(scan(function(t) 0), 0)
  expect_length(scan(function(t) 1e-300 * t), 0)
})

test_that("a steep but smooth change is guarded, not reported", {
  bump <- function(t) 1000 * exp(-((t - 5) / 3e-4)^2)
  expect_length(scan(bump), 0)
  guards <- rotdyn:::scan_breaks(many(bump), 0, 10)$guards
  expect_true(any(guards < 5) && any(guards > 5))
  # The area of the bump, which a step of a second would pass unseen.
  expect_warning(motion <- trajectory(scene_axle(0.5, bump), c(0, 10)), NA)
  expect_equal(motion$omega_rad_per_s[2], 2 * 1000 * 3e-4 * sqrt(pi), tolerance = 1e-8)
})

test_that("an empty interval and values that are not finite are left alone", {
  expect_length(scan(sin, 1, 1), 0)
  expect_length(scan(function(t) if (t > 3) NaN else 1), 0)
})

test_that("a trajectory warns of what was found and stops there", {
  pulse <- function(t) if (t >= 50 && t < 50.02) 40 else 0
  scene <- scene_axle(body_disk(2, 0.25), pulse)
  warning <- expect_warning(motion <- trajectory(scene, 0:100), class = "rotdyn_warning_breaks")
  expect_match(conditionMessage(warning), "50")
  expect_equal(motion$omega_rad_per_s[101], 40 * (50.02 - 50) / 0.0625, tolerance = 1e-12)
  # Told, there is nothing to warn of.
  told <- scene_axle(body_disk(2, 0.25), torque_function(pulse, breaks_s = c(50, 50.02)))
  expect_silent(motion <- trajectory(told, 0:100))
  expect_equal(motion$omega_rad_per_s[101], 12.8, tolerance = 1e-9)
})
