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
test_that("a body on an incline stops where Coulomb's laws say", {
  ball <- body_sphere(1, 0.1)
  g <- 9.80665
  # It slides with v' = -mu g until it rolls, at 5/7 v0; then the rolling resistance b m g stops it:
  # v' = -g b/R/(1 + 2/5).
  mu <- 0.3
  arm <- 0.002
  v0 <- 3
  slope <- function(...) scene_incline(ball, 0, static_friction = mu, rolling_arm_m = arm, ...)
  x <- stopping(slope(v0_m_per_s = v0, omega0_rad_per_s = 0))
  # I omega' = F R - F_N b while it slides.
  rate <- (mu * g * 0.1 - g * arm) / (0.4 * 0.1^2)
  t1 <- v0 / (mu * g + 0.1 * rate)
  v1 <- v0 - mu * g * t1
  slow <- g * arm / 0.1 / 1.4
  expect_equal(x$stop_time_s, t1 + v1 / slow, tolerance = 1e-12)
  expect_equal(x$stop_x_m, v0 * t1 - mu * g * t1^2 / 2 + v1^2 / (2 * slow), tolerance = 1e-12)
  expect_equal(x$stop_theta_rad, (rate * t1^2 / 2 + v1^2 / (2 * slow) / 0.1), tolerance = 1e-12)
  expect_identical(x$terminal_v_m_per_s, 0)
  # At rest from the start; down for good; at constant speed for good.
  expect_identical(stopping(slope())$stop_time_s, 0)
  down <- stopping(scene_incline(ball, 20, static_friction = mu))
  expect_identical(c(down$stop_time_s, down$terminal_v_m_per_s), c(Inf, Inf))
  level <- stopping(
    scene_incline(ball, 0, static_friction = mu, v0_m_per_s = 7, omega0_rad_per_s = 0)
  )
  expect_equal(level$terminal_v_m_per_s, 5, tolerance = 1e-12)
  up <- stopping(scene_incline(ball, -20, static_friction = mu))
  expect_identical(up$terminal_v_m_per_s, -Inf)
})

test_that("a bead and a drive stop by dry friction", {
  # It stays where the slope is at most the friction: within atan(mu) of the bottom.
  hoop <- scene_hoop(1, 1, 0, theta0_rad = 0.35, static_friction = 0.1)
  x <- stopping(hoop)
  events <- motion_events(trajectory(hoop, c(0, 20)))
  expect_equal(x$stop_time_s, max(events$time_s))
  expect_lte(abs(tan(x$stop_theta_rad)), 0.1)
  # Rotors that dry friction stops: J omega0/tau.
  drive <- scene_drive(
    c(1, 3), coupling_gear(1), resistance = list(resistance(coulomb_n_m = 0.5), NULL),
    omega0_rad_per_s = c(6, 6)
  )
  x <- stopping(drive)
  expect_identical(x$rotor, 1:2)
  expect_equal(x$stop_time_s, c(48, 48), tolerance = 1e-9)
  expect_equal(x$stop_theta_rad, c(144, 144), tolerance = 1e-8)
  # omega' = -(1 + omega^2): atan(omega0), far within the error of 1e-9 that is asked for.
  drive <- scene_drive(
    1, resistance = list(resistance(coulomb_n_m = 1, quadratic_n_m_s2 = 1)), omega0_rad_per_s = 20
  )
  expect_equal(stopping(drive)$stop_time_s, atan(20), tolerance = 1e-11)
})

# Of what never stops: Inf, no place, and why.
never_stops <- function(scene, why) {
  expect_message(x <- stopping(scene), why, class = "rotdyn_message_stop")
  expect_true(all(x$stop_time_s == Inf) && all(is.nan(x$stop_theta_rad)))
  x
}

test_that("what never stops has the time Inf, of every scene that friction may hold", {
  never_stops(scene_hoop(1, 1, 0, theta0_rad = 0.35), "no dry friction")
  x <- never_stops(scene_drive(c(1, 3), coupling_shaft(10), omega0_rad_per_s = 1:0), "no dry")
  expect_identical(x$rotor, 1:2)
  swings <- never_stops(scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 1), "no dry friction")
  expect_identical(swings$terminal_omega_rad_per_s, NaN)
  expect_identical(stopping(scene_drive(c(1, 3), coupling_shaft(10)))$stop_time_s, c(0, 0))
  # Rotors that turn against each other: the clutch alone stops them.
  drive <- scene_drive(c(1, 1), coupling_clutch(2), omega0_rad_per_s = c(3, -3))
  expect_equal(stopping(drive)$stop_time_s, c(1.5, 1.5), tolerance = 1e-9)
})

test_that("a pendulum stops by dry friction: an axle without a closed form", {
  # Of an oscillator each half swing is 2 tau/k less: 0.05, 0.032, 0.014, and 0.004 < tau/k.
  spring <- scene_axle(
    1, torque_spring(100), resistance(coulomb_n_m = 0.9), theta0_rad = 0.05
  )
  x <- stopping(spring)
  expect_equal(x$stop_time_s, 3 * pi / 10, tolerance = 1e-8)
  expect_equal(x$stop_theta_rad, -(0.05 - 3 * 0.018), tolerance = 1e-7)
  expect_identical(x$terminal_omega_rad_per_s, 0)
  x <- stopping(scene_pendulum(
    body_rod(1, 1), 0.5, resistance = resistance(coulomb_n_m = 0.1), theta0_rad = 1
  ))
  expect_lte(abs(sin(x$stop_theta_rad)), 0.1 / (0.5 * 9.80665))
})

test_that("what is of no such scene, or is not known, is refused", {
  refused <- function(scene) expect_error(stopping(scene), class = "rotdyn_error_model")
  refused(scene_free(c(1, 2, 3), c(1, 0, 0)))
  refused(scene_chain(c(1, 1), 1, 0.1))
  refused(scene_incline(body_sphere(1, 0.1), 0, force = function(t) sin(t)))
  dry <- resistance(coulomb_n_m = 1)
  refused(scene_drive(1, torque = list(torque_sinusoid(3, 1)), resistance = dry))
  # A law that ends: J omega = 1 to 2 s, then less 1 N m.
  ends <- scene_axle(2, torque_sinusoid(2, 0, to_s = 2), dry)
  expect_equal(stopping(ends)$stop_time_s, 4, tolerance = 1e-9)
  expect_error(stopping(3), class = "rotdyn_error_type")
})

test_that("a stop is found as late as few steps lead there", {
  # 1 rad/s less 1e-12 rad/s^2.
  late <- stopping(scene_drive(1e6, brake = list(brake(1e-6)), omega0_rad_per_s = 1))
  expect_equal(late$stop_time_s, 1e12, tolerance = 1e-9)
  expect_equal(late$stop_theta_rad, 5e11, tolerance = 1e-9)
  for (torque in c(2, 1 + 1e-7)) {
    driven <- scene_drive(1, torque = torque, resistance = resistance(coulomb_n_m = 1))
    never_stops(driven, "more than all friction")
  }
})

test_that("a drive that swings or is driven on is known without a search", {
  dry <- resistance(coulomb_n_m = 5)
  drive <- function(...) scene_drive(c(0.5, 0.2), coupling_shaft(800), ...)
  swings <- drive(torque = list(1, NULL), brake = list(brake(5), NULL), omega0_rad_per_s = c(3, 3))
  expect_soon(never_stops(swings, "no friction holds rotor 2, and nothing damps it"), 20)
  driven <- drive(torque = list(20, NULL), resistance = list(dry, dry))
  expect_soon(never_stops(driven, "more than all friction"), 20)
  # At rest from the start, though rotor 2 would swing on.
  rests <- stopping(drive(torque = list(1, NULL), resistance = list(dry, NULL)))
  expect_identical(rests$stop_time_s, c(0, 0))
  # A gear, a damper or the friction of the neighbour across a gear: it may stop.
  goes_on <- drive_goes_on
  held <- list(dry, NULL)
  expect_null(goes_on(scene_drive(c(1, 1), coupling_gear(2), resistance = held)))
  expect_null(goes_on(scene_drive(c(1, 1), coupling_shaft(9, 0.1), resistance = held)))
  expect_null(goes_on(scene_drive(
    c(1, 1), coupling_shaft(9), resistance = list(dry, resistance(0.1))
  )))
  expect_null(goes_on(scene_drive(
    c(1, 1, 1), list(coupling_shaft(9), coupling_gear(2)), resistance = list(dry, NULL, dry)
  )))
  expect_match(goes_on(scene_drive(
    c(1, 1, 1), list(coupling_gear(2), coupling_shaft(9)), resistance = list(dry, NULL, NULL)
  )), "rotor 3")
})

test_that("drag alone stops no body on an incline: its terminal speed", {
  roll <- function(angle_deg, ..., force = NULL) {
    scene <- scene_incline(
      body_sphere(1.3, 0.1), angle_deg, v0_m_per_s = 3, omega0_rad_per_s = 30,
      static_friction = 0.5, resistance = resistance(...), force = force
    )
    x <- stopping(scene)
    expect_identical(c(x$stop_time_s, x$stop_x_m), c(Inf, NaN))
    x$terminal_v_m_per_s
  }
  expect_identical(roll(0, drag_n_s_per_m = 0.2), 0)
  expect_identical(roll(0, drag_n_s2_per_m2 = 0.2), 0)
  # Where drag balances gravity, or the force.
  weight_n <- 1.3 * 9.80665 * sin(pi / 18)
  expect_equal(roll(10, drag_n_s_per_m = 0.2), weight_n / 0.2, tolerance = 1e-9)
  expect_equal(roll(10, drag_n_s2_per_m2 = 0.2), sqrt(weight_n / 0.2), tolerance = 1e-9)
  expect_equal(roll(0, drag_n_s2_per_m2 = 0.2, force = 1), sqrt(5), tolerance = 1e-9)
  expect_identical(roll(10), Inf)
  expect_equal(roll(0), 3, tolerance = 1e-12)
})

test_that("a brake or a clutch that is released ends no motion", {
  refused <- function(scene) expect_error(stopping(scene), class = "rotdyn_error_model")
  refused(scene_axle(1, 1, brake = brake(5, to_s = 100)))
  # It fades for ever.
  refused(scene_axle(
    2, NULL, resistance(0.1), omega0_rad_per_s = 50, brake = brake(1, from_s = 1, to_s = 2)
  ))
  never_stops(
    scene_drive(1, torque = 1, brake = brake(torque_knots(c(0, 50, 100), c(5, 5, 0)))), "rotor 1"
  )
  refused(scene_drive(
    c(1, 1), coupling_clutch(2, to_s = 100), torque = c(1, 0),
    resistance = list(NULL, resistance(coulomb_n_m = 3))
  ))
  # One that is put on later: 50 - 2 t from 3 s on.
  late <- stopping(scene_axle(1, NULL, omega0_rad_per_s = 50, brake = brake(2, from_s = 3)))
  expect_equal(late$stop_time_s, 28, tolerance = 1e-9)
  # Released at rest, where nothing drives.
  rests <- stopping(scene_axle(1, NULL, omega0_rad_per_s = 4, brake = brake(2, to_s = 10)))
  expect_equal(rests$stop_time_s, 2, tolerance = 1e-9)
})
