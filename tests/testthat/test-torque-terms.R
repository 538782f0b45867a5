# The torque that the core sees: a trajectory of nothing, read off its torque column.
torque_of <- function(law, t, omega = 0) {
  scene <- scene_axle(1e9, law, omega0_rad_per_s = omega, start_s = min(t))
  trajectory(scene, t)$applied_torque_n_m
}

test_that("steps hold until the next, and the last one stays", {
  law <- torque_steps(c(0, 2, 5), c(0.8, 0.3, -0.1))
  expect_equal(
    torque_of(law, c(-1, 0, 1.9, 2, 4.9, 5, 100)), c(0, 0.8, 0.8, 0.3, 0.3, -0.1, -0.1),
    tolerance = 0
  )
  expect_error(torque_steps(c(1, 1), c(2, 3)), class = "rotdyn_error_time")
  expect_error(torque_steps(c(1, 2), 3), class = "rotdyn_error_size")
})

test_that("pulses add up, and one too short to be is refused", {
  law <- torque_pulse(c(1, 2), 2, c(3, 0.5))
  expect_equal(torque_of(law, c(0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5)),
    c(0, 3, 3, 3.5, 3.5, 0.5, 0.5, 0.5, 0), tolerance = 0)
  expect_error(torque_pulse(1e9, 1e-9, 3), class = "rotdyn_error_time")
  expect_error(torque_pulse(1, 0, 3), class = "rotdyn_error_value")
  # Impulse 3 N m x 2 s on 4 kg m^2.
  motion <- trajectory(scene_axle(4, torque_pulse(1, 2, 3)), 10)
  expect_equal(motion$omega_rad_per_s, 1.5, tolerance = 1e-15)
})

test_that("knots add up with their jumps", {
  law <- torque_knots(c(0, 1, 1, 3), c(0, 2, 5, 5)) +
    torque_knots(c(-1, 2), c(1, 4), outside = "hold") + 1
  t <- c(-2, -1, -0.5, 0.5, 1, 1.5, 2.5, 4)
  own <- c(0, 0, 0, 1, 5, 5, 5, 0)
  held <- c(1, 1, 1.5, 2.5, 3, 3.5, 4, 4)
  expect_equal(torque_of(law, t), own + held + 1, tolerance = 1e-15)
})

test_that("laws of any kind add up, are scaled and subtracted", {
  law <- 2 * torque_sinusoid(1.5, 3, 0.5, from_s = 1) - torque_exponential(0.7, 2, from_s = 0) / 2
  t <- c(-1, 0, 0.5, 1, 2)
  expected <- ifelse(t >= 1, 3 * cos(3 * t + 0.5), 0) - ifelse(t >= 0, 0.35 * exp(-2 * t), 0)
  expect_equal(torque_of(law, t), expected, tolerance = 1e-15)
  law <- torque_polynomial(c(0, 1, 3), rbind(c(1, 2, 3), c(-1, 0, 0.5)))
  expect_equal(torque_of(law, c(-0.1, 0, 0.5, 1, 2, 3)), c(0, 1, 2.75, -1, -0.5, 0),
    tolerance = 1e-15)
  expect_equal(torque_of(-law, 0.5), -2.75)
  expect_error(law * law, class = "rotdyn_error_type")
  expect_error(law^2, class = "rotdyn_error_type")
})

test_that("torques of speed and angle are what they say", {
  expect_equal(torque_of(torque_motor(2, 300), 0, 150), 1)
  curve <- torque_curve(c(0, 100, 200), c(3, 2, 0))
  expect_equal(torque_of(curve, 0, 50), 2.5)
  expect_equal(torque_of(curve, 0, 150), 1)
  expect_equal(torque_of(curve, 0, 500), 0)
  expect_equal(torque_of(2 * curve, 0, 50), 5)
  at <- function(law, theta) {
    trajectory(scene_axle(1, law, theta0_rad = theta), 0)$applied_torque_n_m
  }
  expect_equal(at(torque_spring(3, 0.5), 2), -4.5)
  expect_equal(at(torque_gravity(2, 0.5, gravity_m_per_s2 = 10), pi / 6), -5, tolerance = 1e-15)
  expect_equal(at(torque_gravity(2, 0.5, pi / 2, gravity_m_per_s2 = 10), 0), 10, tolerance = 1e-15)
  expect_equal(at(torque_gravity(2, 0), 1), 0)
})

test_that("a law that makes no sense is refused", {
  expect_error(torque_motor(2, 0), class = "rotdyn_error_value")
  expect_error(torque_motor(2, -3), class = "rotdyn_error_value")
  expect_error(torque_curve(c(1, 1), c(2, 2)), class = "rotdyn_error_value")
  expect_error(torque_spring(0), class = "rotdyn_error_value")
  expect_error(torque_gravity(-1, 2), class = "rotdyn_error_value")
  expect_error(torque_sinusoid(1, 2, from_s = 3, to_s = 3), class = "rotdyn_error_time")
  expect_error(torque_polynomial(c(0, 1), matrix(1, 2, 2)), class = "rotdyn_error_size")
  expect_error(torque_polynomial(c(0, Inf), 1), class = "rotdyn_error_value")
  expect_snapshot({
    torque_motor(2, 300) + torque_sinusoid(0.1, 20, -0.5, to_s = 4)
    torque_polynomial(c(0, 1, 2), rbind(1, 2))
    torque_curve(c(0, 100), c(3, 0))
    torque_gravity(1, 0.5)
    2 * torque_exponential(1, -0.5)
  })
})

test_that("a window takes any kind of time", {
  skip_if_not_installed("units")
  minute <- units::set_units(1, "min")
  law <- torque_sinusoid(1, 2, from_s = minute)
  expect_equal(c(law$from_s, law$to_s), c(60, Inf))
  law <- torque_exponential(1, 2, from_s = 30L, to_s = as.difftime(1, units = "mins"))
  expect_equal(c(law$from_s, law$to_s), c(30, 60))
  expect_equal(
    trajectory(scene_axle(1, torque_sinusoid(1, 2, from_s = 1L, to_s = 2L)), 0:3)$omega_rad_per_s,
    c(0, 0, (sin(4) - sin(2)) / 2, (sin(4) - sin(2)) / 2)
  )
  expect_error(torque_sinusoid(1, 2, from_s = factor(1)), class = "rotdyn_error_type")
  expect_error(torque_sinusoid(1, 2, to_s = units::set_units(1, "m")), class = "rotdyn_error_unit")
  expect_error(torque_sinusoid(1, 2, from_s = 1:2), class = "rotdyn_error_type")
})

test_that("a law is not divided by nothing", {
  expect_error(torque_constant(1) / 0, class = "rotdyn_error_value")
  expect_error(torque_motor(1, 2) / 1e-320, class = "rotdyn_error_value")
})

# A row inside the pulse is that of the constant torque: 10 t, whatever its end is rounded to.
test_that("rows inside a pulse have the torque given, and after it the impulse", {
  inside <- trajectory(scene_axle(1, torque_pulse(1000.1, 0.1, 10), start_s = 1000.1), 1000.15)
  expect_equal(inside$applied_torque_n_m, 10, tolerance = 0)
  expect_equal(inside$omega_rad_per_s, 10 * (1000.15 - 1000.1), tolerance = 4e-15)
  for (duration in c(1e-9, 0.1, 1 / 3)) {
    x <- trajectory(
      scene_axle(1, torque_pulse(1000.1, duration, 10), start_s = 1000.1),
      1000.1 + c(duration / 2, 1)
    )
    half <- (1000.1 + duration / 2) - 1000.1
    expect_equal(x$applied_torque_n_m, c(10, 0))
    expect_equal(x$omega_rad_per_s, 10 * c(half, duration), tolerance = 4e-15)
  }
  before <- trajectory(
    scene_axle(1, torque_pulse(-1000.1, 0.3, c(10, -4)), start_s = -1000.1), c(-1000, 0)
  )
  expect_equal(before$omega_rad_per_s[2], 6 * 0.3, tolerance = 4e-15)
  expect_equal(before$applied_torque_n_m[1], 6)
})

test_that("a sum of products has twice the digits", {
  twice <- function(first, ...) .Call(rotdyn:::ffi_sum_product, first, c(...))
  expect_identical(twice(1e17, 1, 1), c(1e17, 1))
  expect_identical(twice(0, 1 + 2^-30, 1 + 2^-30), c(1 + 2^-29, 2^-60))
  expect_identical(twice(-1, 1 + 2^-30, 1 + 2^-30), c(2^-29 + 2^-60, 0))
})
