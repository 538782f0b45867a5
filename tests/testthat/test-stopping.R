test_that("published and computed coast-downs", {
  cases <- utils::read.csv(shared("cases/coastdown_damping/cases.csv"))
  value <- function(id) cases$computed[cases$id == id]
  full <- stopping(scene_axle(2.5, resistance = resistance(0.004, 2e-5, 0.05),
    omega0_rad_per_s = 150))
  expect_equal(full$stop_time_s, value("cf_over_t"), tolerance = 1e-9)
  expect_equal(full$stop_theta_rad, value("cf_over_th"), tolerance = 1e-9)
  dry <- stopping(scene_axle(1.2, resistance = resistance(coulomb_n_m = 0.3),
    omega0_rad_per_s = 200))
  expect_equal(dry$stop_time_s, value("cf_pureC_t"), tolerance = 1e-15)
  expect_equal(dry$stop_theta_rad, value("cf_pureC_th"), tolerance = 1e-15)
  fan <- scene_axle(1.2, resistance = resistance(0, 3e-4), omega0_rad_per_s = 200)
  expect_equal(trajectory(fan, 10)$omega_rad_per_s, value("cf_pureq_w10"), tolerance = 1e-9)
})

test_that("terminal speeds", {
  expect_equal(stopping(scene_axle(0.1, 0.8, resistance(0, 2e-3)))$terminal_omega_rad_per_s, 20,
    tolerance = 1e-15)
  expect_equal(stopping(scene_axle(0.1, -0.8, resistance(0.04)))$terminal_omega_rad_per_s, -20,
    tolerance = 1e-15)
  expect_equal(stopping(scene_axle(1, 1))$terminal_omega_rad_per_s, Inf)
  # A motor of 2 N m at rest and 100 rad/s without load, against 1 N m: half speed.
  motor <- scene_axle(1, torque_motor(2, 100) - 1)
  expect_equal(stopping(motor)$terminal_omega_rad_per_s, 50, tolerance = 1e-15)
})

test_that("what never stops, what has stopped, and what cannot be told", {
  viscous <- stopping(scene_axle(1, resistance = resistance(0.1), omega0_rad_per_s = 3))
  expect_equal(viscous$stop_time_s, Inf)
  expect_equal(viscous$stop_theta_rad, 30, tolerance = 1e-15)
  held <- stopping(scene_axle(1, 0.2, resistance(coulomb_n_m = 0.2), theta0_rad = 4, start_s = 7))
  expect_equal(held$stop_time_s, 7)
  expect_equal(held$stop_theta_rad, 4)
  expect_error(stopping(scene_axle(1, torque_sinusoid(1, 1))), class = "rotdyn_error_model")
  expect_error(stopping(3), class = "rotdyn_error_type")
})

test_that("the terminal speed is that under the torque that acts for good", {
  terminal <- function(...) stopping(scene_axle(...))$terminal_omega_rad_per_s
  dry <- resistance(coulomb_n_m = 0.5)
  expect_equal(terminal(1, torque_pulse(5, 1, 2), dry, omega0_rad_per_s = 1), 0)
  expect_equal(terminal(1, torque_knots(c(0, 1), c(2, 2)), resistance(1)), 0)
  expect_equal(terminal(1, torque_knots(c(0, 1), c(2, 2), outside = "hold"), resistance(1)), 2)
  expect_equal(terminal(1, 0, omega0_rad_per_s = 3), 3)
  expect_equal(terminal(2, torque_pulse(1, 3, 4), omega0_rad_per_s = -1), 5)
  expect_equal(terminal(1, 1), Inf)
  # Held by static friction, though more than what slides.
  stiction <- resistance(coulomb_n_m = 0.2, static_n_m = 0.3)
  expect_equal(terminal(1, 0.25, stiction), 0)
  expect_equal(terminal(1, 0.25, stiction, omega0_rad_per_s = -1), 0)
  expect_equal(terminal(1, 0.25, stiction, omega0_rad_per_s = 1), Inf)
})

# mpmath, 50 digits: theta0 + I omega0/c, and I/q log(1 + q omega0/c).
test_that("a viscous coast-down tends to an angle", {
  tends <- function(...) stopping(scene_axle(...))$stop_theta_rad
  expect_equal(tends(0.0625, 0, resistance(0.03), omega0_rad_per_s = 30), 62.5, tolerance = 1e-15)
  expect_equal(tends(2.5, 0, resistance(0.004, 2e-5), omega0_rad_per_s = 150),
    69951.973491927833329, tolerance = 1e-15)
  expect_equal(tends(2.5, 0, resistance(0.004, 2e-5), omega0_rad_per_s = -150, theta0_rad = 1),
    -69950.973491927833329, tolerance = 1e-15)
  for (c in 10^seq(-12, 12, 3)) {
    expect_lte(abs(tends(1, 0, resistance(c), omega0_rad_per_s = 0.7) / (0.7 / c) - 1), 1e-15)
  }
  # Any impulse ends at its share of the angle, J/c, whenever it acts.
  pulse <- torque_pulse(start_s = 2, duration_s = 3, torque_n_m = 1)
  expect_equal(tends(1, pulse, resistance(0.5)), 3 / 0.5, tolerance = 1e-14)
  expect_equal(tends(1, 0, resistance(0, 1), omega0_rad_per_s = -2), -Inf)
  expect_equal(tends(1, 1, resistance(1)), NaN)
  expect_equal(tends(1, theta0_rad = 3), 3)
})
