test_that("units objects are converted, a wrong dimension is an error that names both", {
  skip_if_not_installed("units")
  u <- function(x, unit) units::set_units(x, unit, mode = "standard")
  expect_equal(body_disk(u(2000, "g"), u(25, "cm")), body_disk(2, 0.25))
  expect_equal(
    trajectory(article_scene(), u(c(0, 0.1), "min"))$theta_rad,
    trajectory(article_scene(), c(0, 6))$theta_rad
  )
  expect_equal(
    rolling_acceleration(0.5, u(pi / 6, "rad")), rolling_acceleration(0.5, 30),
    tolerance = 1e-15
  )
  expect_equal(torque_constant(u(2, "N*m")), torque_constant(2))
  error <- expect_error(body_disk(u(2, "s"), 1), class = "rotdyn_error_unit")
  expect_match(conditionMessage(error), "kg")
  expect_match(conditionMessage(error), "mass_kg` must be a quantity in kg")
  expect_match(conditionMessage(error), "s, has another dimension")
  expect_error(
    rolling_acceleration(u(2, "s"), 30), "must be a plain number", class = "rotdyn_error_unit"
  )
})

test_that("a difftime is a time", {
  minute <- as.difftime(c(0, 0.1), units = "mins")
  expect_equal(trajectory(article_scene(), minute)$time_s, c(0, 6))
  expect_error(body_disk(as.difftime(1, units = "secs"), 1), class = "rotdyn_error_unit")
})

test_that("hertz is not taken for rad/s", {
  skip_if_not_installed("units")
  hertz <- units::set_units(50, "Hz")
  expect_error(torque_sinusoid(1, hertz), class = "rotdyn_error_unit")
  expect_error(
    scene_axle(1, omega0_rad_per_s = units::set_units(1, "kHz")), class = "rotdyn_error_unit"
  )
  expect_equal(torque_exponential(1, units::set_units(2, "Hz"))$x[2], 2)
  expect_error(convert_angle(units::set_units(1, "Hz"), "rpm", "rad/s"),
    class = "rotdyn_error_unit")
  law <- torque_sinusoid(1, units::set_units(60, "rpm"))
  expect_equal(law$x[2], 2 * pi)
})

test_that("a forged quantity is refused", {
  skip_if_not_installed("units")
  forged <- list(
    structure(1, class = "units"), structure(1, class = "units", units = "m"),
    structure(1, class = "difftime"), structure("a", class = "difftime", units = "secs"),
    structure("a", class = "units", units = units(units::set_units(1, "m")))
  )
  for (x in forged) {
    expect_error(convert_angle(x, "degree", "rad"), class = "rotdyn_error")
    expect_error(trajectory(scene_axle(1), x), class = "rotdyn_error")
  }
})

test_that("a measured number stands for its value, a damaged one is named", {
  expect_identical(convert_angle(measured(180, 1), "degree", "rad"), pi)
  expect_identical(body_disk(measured(2, 0.1), 0.25)$mass_kg, 2)
  damaged <- measured(2, 0.1)
  damaged$u <- -1
  expect_error(body_disk(damaged, 0.25), "mass_kg", class = "rotdyn_error_type")
})
