test_that("published drops and pendulums come out within their digits", {
  cases <- utils::read.csv(shared("cases", "rotating_frame_published", "cases.csv"))
  want <- stats::setNames(cases$published, cases$id)
  off <- stats::setNames(cases$tol, cases$id)
  east <- function(latitude_deg, g) {
    earth_drop(100, latitude_deg, gravity_m_per_s2 = g)$deflection_east_m
  }
  expect_lte(abs(east(45, 9.81) - want[["kb100"]]), off[["kb100"]])
  expect_lte(abs(east(32, 9.8) - want[["ucsd"]]), off[["ucsd"]])
  expect_lte(abs(east(45, 9.80665) - want[["manch"]]), off[["manch"]])
  foucault <- foucault_pendulum(0, c(30, 45, 29.72), length_m = 67, gravity_m_per_s2 = 9.81)
  sidereal_day_s <- 2 * pi / 7.292115e-5
  days <- foucault$plane_turn_s / sidereal_day_s
  expect_lte(abs(days[1] - want[["fou_30"]]), off[["fou_30"]])
  expect_lte(abs(days[2] - want[["fou_45"]]), off[["fou_45"]])
  degrees <- abs(foucault$plane_rate_rad_per_s[3]) * sidereal_day_s * 180 / pi
  expect_lte(abs(degrees - want[["fou_houston"]]), off[["fou_houston"]])
  expect_lte(abs(foucault$swing_period_s[1] - want[["fou_len"]]), off[["fou_len"]])
})

test_that("drops agree with 40-digit values, and the first order lacks what it says", {
  x <- utils::read.csv(shared("refs", "coriolis_drop.csv"))
  out <- earth_projectile(
    x$t, x$latitude * 180 / pi, gravity_m_per_s2 = x$g, rotation_rad_per_s = x$Omega
  )
  expect_equal(out$east_m, x$east, tolerance = 2e-15)
  expect_equal(out$up_m, -x$down, tolerance = 1e-14)
  slow <- abs(x$Omega * x$t) < 0.1
  expect_lte(max(abs(out$north_m / x$north - 1)[slow]), 2e-15)
  drop <- earth_drop(c(1, 100, 1e4), 45)
  lacks <- abs(drop$deflection_east_m / drop$first_order_east_m - 1)
  expect_true(all(lacks <= drop$first_order_error + 4e-16))
  expect_equal(drop$fall_time_s[1], sqrt(2 / 9.80665), tolerance = 1e-9)
})

test_that("a pendulum's plane turns clockwise in the north, and swings keep their energy", {
  t <- seq(0, 86164, length.out = 400)
  swing <- foucault_pendulum(t, 48.85, 67, north_m = 3)
  # Let go over the ground: after a sixth of the turn the far points lie 60 degrees clockwise.
  sixth <- swing$plane_turn_s[1] / 6
  period <- swing$swing_period_s[1]
  near <- foucault_pendulum(round(sixth / period) * period, 48.85, 67, north_m = 3)
  expect_equal(atan2(near$east_m, near$north_m), pi / 3, tolerance = 1e-3)
  pull <- 9.80665 / 67
  energy <- swing$east_m_per_s^2 + swing$north_m_per_s^2 +
    pull * (swing$east_m^2 + swing$north_m^2)
  expect_equal(energy, rep(energy[1], 400), tolerance = 1e-12)
})

test_that("motions go into a frame and out of it", {
  puck <- data.frame(
    time_s = 0:4, x_m = 0:4 - 2, y_m = 1, vx_m_per_s = 1, vy_m_per_s = 0, who = "a"
  )
  seen <- to_rotating_frame(puck, frame = 0.5)
  expect_named(seen, c(
    names(puck), "centrifugal_x_m_per_s2", "centrifugal_y_m_per_s2", "coriolis_x_m_per_s2",
    "coriolis_y_m_per_s2", "euler_x_m_per_s2", "euler_y_m_per_s2"
  ), ignore.order = TRUE)
  back <- from_rotating_frame(seen, frame = 0.5)
  expect_equal(back$x_m, puck$x_m, tolerance = 1e-15)
  expect_equal(back$vy_m_per_s, double(5), tolerance = 1e-15)
  # At time 0 the axes agree: v' = v - omega x r
  expect_equal(c(seen$vx_m_per_s[1], seen$vy_m_per_s[1]), c(1 + 0.5, 0 + 1))
  expect_equal(seen$coriolis_x_m_per_s2[1], 2 * 0.5 * seen$vy_m_per_s[1])
  expect_equal(seen$coriolis_y_m_per_s2[1], -2 * 0.5 * seen$vx_m_per_s[1])
  expect_equal(seen$centrifugal_x_m_per_s2[1], 0.25 * -2)
})

test_that("a spun-up axle is a frame", {
  wheel <- spin_up()
  still <- data.frame(time_s = c(1, 3, 6), x_m = 1, y_m = 0, z_m = 0, vx_m_per_s = 0,
                      vy_m_per_s = 0, vz_m_per_s = 0, ax_m_per_s2 = 0, ay_m_per_s2 = 0,
                      az_m_per_s2 = 0)
  seen <- to_rotating_frame(still, wheel)
  at <- predict(wheel, still$time_s)
  expect_equal(seen$x_m, cos(at$theta_rad), tolerance = 1e-14)
  expect_equal(sqrt(seen$vx_m_per_s^2 + seen$vy_m_per_s^2), at$omega_rad_per_s, tolerance = 1e-14)
  alpha <- at$net_torque_n_m / summary(wheel)$moment_of_inertia_kg_m2
  expect_equal(
    sqrt(seen$ax_m_per_s2^2 + seen$ay_m_per_s2^2), sqrt(at$omega_rad_per_s^4 + alpha^2),
    tolerance = 1e-13
  )
  table <- data.frame(theta_rad = at$theta_rad, omega_rad_per_s = at$omega_rad_per_s,
                      alpha_rad_per_s2 = alpha)
  expect_equal(to_rotating_frame(still, table), seen, tolerance = 1e-14)
})

test_that("bad input is refused with its class", {
  expect_error(earth_drop(-1, 45), class = "rotdyn_error_value")
  expect_error(earth_drop(1, 91), class = "rotdyn_error_value")
  expect_error(earth_drop(1), class = "rotdyn_error_missing")
  expect_error(earth_projectile(1:2, c(10, 20, 30)), class = "rotdyn_error_size")
  expect_error(foucault_pendulum(1, 45, 0), class = "rotdyn_error_value")
  expect_error(earth_drop("a", 45), class = "rotdyn_error_type")
  expect_identical(earth_drop(NA_real_, 45)$deflection_east_m, NA_real_)
  puck <- data.frame(time_s = 0, x_m = 1, y_m = 0)
  expect_error(to_rotating_frame(puck, "a"), class = "rotdyn_error_type")
  expect_error(to_rotating_frame(puck[-1], 1), "time_s", class = "rotdyn_error_type")
  expect_error(to_rotating_frame(puck[-3], 1), "y_m", class = "rotdyn_error_type")
  expect_error(to_rotating_frame(puck, 1, axis = c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(
    to_rotating_frame(puck, data.frame(theta_rad = 1:2, omega_rad_per_s = 1)),
    class = "rotdyn_error_size"
  )
  expect_identical(nrow(to_rotating_frame(puck[0, ], 1)), 0L)
})

test_that("phases keep their digits for years", {
  # 50 digits: mpmath.
  swing <- foucault_pendulum(c(31536000, 1e12), 48.85, 67, north_m = 3)
  expect_lt(max(abs(swing$east_m - c(-0.40247767107293567, -2.5731443538699441))), 4e-15)
  expect_lt(max(abs(swing$north_m - c(-0.60431408745295752, 0.93124443791581487))), 4e-15)
  # A point at (2, 1) from a frame that has turned by 7e8 rad.
  seen <- to_rotating_frame(data.frame(time_s = 1e9, x_m = 2, y_m = 1), frame = 0.7)
  expect_lt(abs(seen$x_m - 1.8839370196056416), 2e-15)
  expect_lt(abs(seen$y_m + 1.2044838339136862), 2e-15)
})

test_that("the ellipse of a swing from rest depends on how far it starts, not on where", {
  swing <- function(east_m, north_m) foucault_pendulum(1, 48.85, 67, east_m, north_m)
  expect_equal(
    swing(3, 4)$ellipse_rate_rad_per_s, swing(5, 0)$ellipse_rate_rad_per_s, tolerance = 1e-14
  )
  expect_equal(
    swing(0, 5)$ellipse_rate_rad_per_s, swing(5, 0)$ellipse_rate_rad_per_s, tolerance = 1e-14
  )
})

test_that("the ellipse of a swing turns by its area, seen from where its plane stands still", {
  # On the pole, rate -0.01 rad/s: 1 m by 0.02 m/s, and the frame's own turn, 0.01 x 1 m^2.
  rate <- function(spin) {
    foucault_pendulum(
      1, 90, 10, east_m = 1, north_m_per_s = 0.02, rotation_rad_per_s = spin
    )$ellipse_rate_rad_per_s
  }
  expect_equal(rate(0.01) * 1e4, 3 / 8 * 0.03 / 100 * 1e4)
  expect_equal(rate(0) * 1e4, 3 / 8 * 0.02 / 100 * 1e4)
  expect_equal(rate(-0.02) * 1e4, 0)
})

test_that("the time of a fall is that of the latitude", {
  # With a turn of 1 rad/s the depth is g (cos^2 (1 - cos 2 t)/4 + sin^2 t^2/2).
  for (latitude in c(30, 60, 90)) {
    c2 <- cos(latitude * pi / 180)^2
    depth <- function(t) 9.8 * (c2 * (1 - cos(2 * t)) / 4 + (1 - c2) * t^2 / 2)
    want <- stats::uniroot(function(t) depth(t) - 2, c(0.1, 1.5), tol = 1e-13)$root
    drop <- earth_drop(2, latitude, 9.8, rotation_rad_per_s = 1)
    expect_equal(drop$fall_time_s, want, tolerance = 1e-10)
  }
})
