# 4 sqrt(I/(m g d)) K(sin^2(A/2)), mpmath at 40 digits.
test_that("a pendulum at any amplitude, beside the separatrix, and beyond it", {
  metre <- function(...) scene_pendulum(body_point(1), 1, ..., gravity_m_per_s2 = 1)
  got <- period_of(metre(theta0_rad = 1))
  expect_equal(got$period_s, 6.6999756643704527127, tolerance = 1e-15)
  expect_equal(got$kind, "oscillation")
  expect_equal(got$amplitude_rad, 1, tolerance = 1e-15)
  below <- period_of(metre(omega0_rad_per_s = 2 - 2^-52))
  expect_equal(below$period_s, 77.632484222713878853, tolerance = 1e-15)
  above <- period_of(metre(omega0_rad_per_s = -(2 + 2^-51)))
  expect_equal(above$period_s, 38.123094930796987896, tolerance = 1e-15)
  expect_equal(above$kind, "rotation")
  expect_equal(period_of(metre(omega0_rad_per_s = 2))$period_s, Inf)
  expect_equal(period_of(metre())$kind, "rest")
})

test_that("a damped oscillator by cycle, others none, others unknown", {
  spring <- function(c, ...) scene_axle(2, torque_spring(8), resistance(c, ...), theta0_rad = 1)
  expect_equal(period_of(spring(0.5))$period_s, 3.1477466117961310213, tolerance = 1e-15)
  expect_equal(period_of(spring(0.5))$amplitude_ratio, 0.67471268776794595834, tolerance = 1e-15)
  expect_equal(period_of(spring(8))$kind, "overdamped")
  expect_equal(period_of(spring(0, coulomb_n_m = 1))$kind, "damped")
  expect_equal(period_of(spring(0, coulomb_n_m = 1))$period_s, NaN)
  expect_equal(period_of(scene_axle(1, 2))$kind, "none")
  expect_error(period_of(scene_axle(1, torque_spring(1) + torque_sinusoid(1, 1))),
    class = "rotdyn_error_model")
  expect_error(period_of(scene_axle(1, function(t) t)), class = "rotdyn_error_model")
  expect_error(period_of(3), class = "rotdyn_error_type")
})

test_that("after a period the motion is the same", {
  scene <- scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 2, omega0_rad_per_s = 1.5)
  after <- trajectory(scene, period_of(scene)$period_s)
  expect_equal(after$theta_rad, 2, tolerance = 1e-14)
  expect_equal(after$omega_rad_per_s, 1.5, tolerance = 1e-14)
})

test_that("a top, rotors and a chain have periods", {
  # m g l/(I3 omega) of a fast top, its axis level.
  level <- attitude_from(c(1, 0, 0, pi / 2), "axis_angle")
  top <- scene_pivot(
    body_disk(0.4, 0.06), c(0, 0, 2500), pivot_m = c(0, 0, -0.04), attitude0 = level
  )
  turn <- 2 * pi * (0.5 * 0.4 * 0.06^2 * 2500) / (0.4 * 9.80665 * 0.04)
  periods <- period_of(top)
  expect_identical(periods$kind, c("precession", "nutation"))
  expect_equal(periods$period_s[1], turn, tolerance = 1e-3)
  expect_equal(periods$period_s[2], 2 * pi * 0.001 / (0.00072 * 2500), tolerance = 1e-3)
  # A vertical one: a small precession, by the smaller root of I1 W^2 - I3 w W + m g l = 0.
  upright <- scene_pivot(body_disk(0.4, 0.06), c(0, 0, 250), pivot_m = c(0, 0, -0.04))
  b <- 0.00072 * 250
  root <- (b - sqrt(b^2 - 4 * 0.001 * 0.4 * 9.80665 * 0.04)) / (2 * 0.001)
  expect_equal(period_of(upright)$period_s[1], 2 * pi / root, tolerance = 1e-9)
  expect_error(
    period_of(scene_pivot(c(1, 2, 3), c(0, 0, 6), mass_kg = 1, centre_m = c(0, 0, 0.1))),
    class = "rotdyn_error_model"
  )
  expect_error(
    period_of(update(top, resistance = resistance(damping_per_s = 0.1))),
    class = "rotdyn_error_model"
  )
  # Two equal rotors: omega^2 = 2 k/I.
  expect_equal(period_of(scene_rotors(c(2, 2), 9))$period_s, 2 * pi / 3)
  # Two equal pendulums, one below the other: omega^2 = (2 -+ sqrt(2)) g/l.
  chain <- period_of(scene_chain(c(1, 1), 1, 0.1, links = "points"))
  expect_equal(chain$period_s, 2 * pi / sqrt((2 + c(-1, 1) * sqrt(2)) * 9.80665))
  expect_identical(chain$kind, c("mode", "mode"))
  expect_error(period_of(scene_hoop(1, 1, 2)), class = "rotdyn_error_type")
})
