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
