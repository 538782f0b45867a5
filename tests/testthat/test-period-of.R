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

test_that("every constraint that swings has its periods", {
  of <- function(scene) suppressWarnings(period_of(scene))
  # Two rotors: omega^2 = k (1/J1 + 1/J2).
  pair <- of(scene_rotors(c(1, 3), 48))
  expect_identical(pair$kind, "mode")
  expect_equal(pair$period_s, 2 * pi / 8)
  # The same behind a gear: J2/4 and k/4 to the first shaft.
  geared <- scene_drive(c(0.5, 2, 12), list(coupling_gear(2), coupling_shaft(192)))
  expect_equal(of(geared)$period_s, 2 * pi / 8)
  # A double pendulum of equal point masses: omega^2 = (2 -+ sqrt(2)) g/l.
  expect_equal(
    of(scene_chain(c(1, 1), 1, 0.1, links = "points"))$period_s,
    2 * pi / sqrt((2 + c(-1, 1) * sqrt(2)) * 9.80665), tolerance = 1e-12
  )
  # A bead beside the axis: omega^2 = W^2 - (g/R)^2/W^2, on both sides.
  bead <- of(scene_hoop(1, 1, 5))
  expect_identical(bead$kind, rep("small swing", 2))
  expect_equal(bead$period_s, rep(2 * pi / sqrt(25 - 9.80665^2 / 25), 2), tolerance = 1e-12)
  # A symmetric body wobbles with (I3 - I1)/I1 omega3; a steady spin turns.
  wobble <- of(scene_free(c(2, 2, 3), c(0.1, 0, 4)))
  expect_identical(wobble$kind, "wobble")
  expect_equal(wobble$period_s, 2 * pi / (0.5 * 4), tolerance = 1e-12)
  expect_equal(of(scene_free(c(1, 2, 2.5), c(0, 0, 4)))$period_s, pi / 2)
  expect_identical(of(scene_free(c(1, 2, 2.5), c(0, 4, 0)))$kind, "rotation")
  # The flips of a tumbling body, twice.
  nut <- scene_free(c(1, 2, 2.5), c(0.01, 4, 0.01))
  expect_identical(of(nut)$period_s, 2 * flip_time(nut))
  # A fast top: precession m g l/(I3 omega), nutation I3 omega/I1 to the first order.
  top <- of(scene_pivot(
    body_disk(2, 0.25), c(0, 0, 600), pivot_m = c(0, 0, -0.1),
    attitude0 = attitude_from(c(1, 0, 0, 0.3), "axis_angle")
  ))
  expect_identical(top$kind, c("precession", "nutation"))
  expect_equal(top$period_s[1], 2 * pi * 0.0625 * 600 / (2 * 9.80665 * 0.1), tolerance = 1e-3)
  expect_equal(top$period_s[2], 2 * pi * 0.05125 / (0.0625 * 600), tolerance = 1e-3)
  expect_gt(top$amplitude_rad[2], 0)
  refused <- function(scene) expect_error(period_of(scene), class = "rotdyn_error_model")
  refused(scene_incline(body_disk(1, 0.1), 20))
  refused(scene_clutch(1, 2, 3, omega0_rad_per_s = c(1, 0)))
  refused(scene_drive(c(1, 2), coupling_clutch(2)))
  refused(scene_drive(c(1, 2), coupling_gear(2)))
  refused(scene_free(c(1, 2, 2.5), c(0, 1, 2), torque = c(1, 0, 0)))
})

test_that("a vertical top has the slow precession beside the vertical", {
  upright <- scene_pivot(body_disk(0.4, 0.06), c(0, 0, 250), pivot_m = c(0, 0, -0.04))
  # The smaller root of I1 W^2 - I3 w W + m g l = 0.
  b <- 0.00072 * 250
  root <- (b - sqrt(b^2 - 4 * 0.001 * 0.4 * 9.80665 * 0.04)) / (2 * 0.001)
  expect_equal(period_of(upright)$period_s[1], 2 * pi / root, tolerance = 1e-9)
  # z'' - i a z' - g z = 0 beside the vertical, a = I3 w/I1, g = m g l/I1: it nods in
  # 2 pi/sqrt(a^2 - 4 g).
  nods <- 2 * pi / sqrt((b / 0.001)^2 - 4 * 0.4 * 9.80665 * 0.04 / 0.001)
  expect_equal(period_of(upright)$period_s[2], nods, tolerance = 1e-12)
  expect_identical(period_of(upright)$amplitude_rad, c(NaN, 0))
  # One that hangs still and does not spin is a pendulum; one that spins too slowly falls.
  still <- period_of(scene_pivot(body_disk(0.4, 0.06), c(0, 0, 0), pivot_m = c(0, 0, 0.04)))
  expect_identical(still$kind, "rest")
  expect_equal(still$period_s, 2 * pi * sqrt(0.001 / (0.4 * 9.80665 * 0.04)), tolerance = 1e-12)
  expect_error(
    period_of(update(upright, omega0_rad_per_s = c(0, 0, 1))), "does not sleep",
    class = "rotdyn_error_model"
  )
})

test_that("a body that swings in a plane about its fixed point is a pendulum", {
  of <- function(moments, omega, line, angle, centre = c(0, 0, 0.3)) {
    scene_pivot(
      moments, omega, mass_kg = 0.5, centre_m = centre,
      attitude0 = attitude_from(c(line, angle), "axis_angle")
    )
  }
  # 4 sqrt(I/G) K(sin(A/2)), K by the arithmetic-geometric mean.
  period <- function(moment, amplitude_rad) {
    a <- 1
    b <- cos(amplitude_rad / 2)
    for (i in 1:8) {
      mean <- (a + b) / 2
      b <- sqrt(a * b)
      a <- mean
    }
    2 * pi / a * sqrt(moment / (0.5 * 9.80665 * 0.3))
  }
  even <- c(0.05, 0.05, 0.002)
  for (scene in list(
    of(even, c(0, 0, 0), c(1, 0, 0), pi / 3), of(even, c(0, 0, 0), c(0.6, -0.8, 0), pi / 3),
    of(c(0.05, 0.06, 0.02), c(0, 0, 0), c(1, 0, 0), pi / 3),
    of(c(0.002, 0.05, 0.05), c(0, 0, 0), c(0, 1, 0), -pi / 6, c(0.3, 0, 0))
  )) {
    got <- period_of(scene)
    expect_identical(got$kind, "oscillation")
    expect_equal(got$amplitude_rad, 2 * pi / 3, tolerance = 1e-14)
    expect_equal(got$period_s, period(0.05, 2 * pi / 3), tolerance = 1e-14)
    events <- motion_events(trajectory(scene, c(0, 2)))
    expect_equal(events$time_s[events$event == "lowest"][1], got$period_s / 4, tolerance = 1e-9)
  }
  # Over the top: the time of a turn is that of the axle with the same moment.
  round <- of(even, c(30, 0, 0), c(1, 0, 0), pi / 3)
  axle <- scene_axle(0.05, torque_gravity(0.5, 0.3), theta0_rad = 2 * pi / 3, omega0_rad_per_s = 30)
  expect_equal(period_of(round), period_of(axle), tolerance = 1e-14)
  # Balanced it stays, and needs for ever to come back from the next position.
  expect_identical(period_of(of(even, c(0, 0, 0), c(0, 0, 1), 0))$kind, "separatrix")
  # Off the plane no closed form is known.
  for (scene in list(
    of(c(0.05, 0.06, 0.02), c(0, 0, 0), c(0.6, 0.8, 0), pi / 3),
    of(c(0.05, 0.06, 0.02), c(0, 1, 0), c(1, 0, 0), pi / 3),
    of(even, c(0, 0, 0), c(1, 0, 0), pi / 3, c(0.1, 0, 0.3))
  )) {
    expect_error(period_of(scene), "swing about a horizontal", class = "rotdyn_error_model")
  }
})

test_that("a top nods by the amplitude that its motion shows", {
  top <- scene_pivot(
    c(0.02, 0.02, 0.03), c(0, 0, 60), mass_kg = 2, centre_m = c(0, 0, 0.1),
    attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle")
  )
  got <- period_of(top)
  expect_identical(got$kind, c("precession", "nutation"))
  # The angle of the body's axis to the vertical over one nutation: cos = 1 - 2 (qx^2 + qy^2).
  motion <- trajectory(top, seq(0, got$period_s[2], length.out = 2001))
  polar <- acos(1 - 2 * (motion$qx^2 + motion$qy^2))
  expect_equal(got$amplitude_rad[2], diff(range(polar)) / 2, tolerance = 1e-6)
  expect_identical(got$amplitude_rad[1], NaN)
  # It turns by the azimuth of the axis in that time, so often as it nods.
  azimuth <- function(m) atan2(
    2 * (m$qy * m$qz - m$qw * m$qx), 2 * (m$qx * m$qz + m$qw * m$qy)
  )
  turned <- diff(azimuth(motion[c(1, nrow(motion)), ])) %% (2 * pi)
  expect_equal(2 * pi / got$period_s[1], min(turned, 2 * pi - turned) / got$period_s[2],
               tolerance = 1e-6)
})

test_that("a top or a body on which more acts has no period of a closed form", {
  q <- attitude_from(c(1, 0, 0, 1), "axis_angle")
  top <- function(...) {
    scene_pivot(c(1, 1, 0.5), c(0, 0, 6), mass_kg = 1, centre_m = c(0, 0, 1), attitude0 = q, ...)
  }
  nutation <- function(scene) summary(trajectory(scene, 0:1))$nutation_period_s
  expect_gt(nutation(top()), 1)
  for (scene in list(
    top(resistance = resistance(damping_per_s = 0.1)), top(torque = c(0, 0, 1)),
    top(torque = c(1, 0, 0)), top(torque = function(time_s) c(0, 0, sin(time_s))),
    top(rotors = rotor("z", 0.01, 300, torque = 0.5))
  )) {
    expect_error(period_of(scene), class = "rotdyn_error_model")
    expect_true(is.na(nutation(scene)))
  }
  expect_gt(nutation(top(rotors = rotor("z", 0.01, 300))), 0)
  flips <- function(...) {
    summary(trajectory(scene_free(c(1, 2, 2.9), c(0.01, 4, 0.01), ...), c(0, 1)))$flip_time_s
  }
  expect_gt(flips(), 6)
  expect_true(is.na(flips(resistance = resistance(damping_per_s = 0.1))))
  expect_true(is.na(flips(torque = c(5, 0, 0))))
})
