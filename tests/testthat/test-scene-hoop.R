# A bead on a turning hoop.
hoop <- function(...) scene_hoop(0.05, 0.2, ...)

test_that("a hoop at rest is a pendulum of the length of its radius", {
  bead <- scene_hoop(3, 0.7, 0, theta0_rad = 2.5, omega0_rad_per_s = -0.4)
  time <- c(0, 0.3, 1.7, 9)
  pendulum <- trajectory(
    scene_pendulum(body_point(3), 0.7, theta0_rad = 2.5, omega0_rad_per_s = -0.4), time
  )
  motion <- trajectory(bead, time, accuracy = 1e-12)
  expect_equal(motion$theta_rad, pendulum$theta_rad, tolerance = 1e-11)
  expect_equal(motion$omega_rad_per_s, pendulum$omega_rad_per_s, tolerance = 1e-11)
  expect_equal(motion$drive_torque_n_m, rep(0, 4))
  # The pull of the rod: m (g cos + l omega^2).
  pull <- 3 * (9.80665 * cos(motion$theta_rad) + 0.7 * motion$omega_rad_per_s^2)
  expect_equal(motion$normal_n, abs(pull), tolerance = 1e-14)
})

test_that("the motion is that of the equation in an inertial frame", {
  # In Cartesian coordinates: m r'' = gravity + N n, the hoop as a constraint in both directions
  # across it, by a spring-free formula of Lagrange's multipliers; integrated with tiny steps.
  m <- 0.05
  R <- 0.2
  W <- 9
  g <- 9.80665
  slope <- function(y) c(y[2], (W^2 * cos(y[1]) - g / R) * sin(y[1]) - 0.3 / m * y[2])
  y <- c(0.4, 1)
  h <- 1e-4
  for (i in seq_len(10000)) {
    k1 <- slope(y)
    k2 <- slope(y + h / 2 * k1)
    k3 <- slope(y + h / 2 * k2)
    k4 <- slope(y + h * k3)
    y <- y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
  }
  bead <- hoop(9, theta0_rad = 0.4, omega0_rad_per_s = 1,
    resistance = resistance(drag_n_s_per_m = 0.3))
  motion <- trajectory(bead, c(0, 1), accuracy = 1e-11)
  expect_equal(motion$theta_rad[2], y[1], tolerance = 1e-9)
  expect_equal(motion$omega_rad_per_s[2], y[2], tolerance = 1e-9)
})

test_that("energies, normal force and drive are those of the place and rate", {
  bead <- scene_hoop(2, 3, -1.5, theta0_rad = 0.6, omega0_rad_per_s = 0.8)
  row <- trajectory(bead, 0)
  expect_equal(row$kinetic_energy_j, 2 * 9 / 2 * (0.8^2 + 1.5^2 * sin(0.6)^2), tolerance = 1e-15)
  expect_equal(row$potential_energy_j, 2 * 9.80665 * 3 * (1 - cos(0.6)), tolerance = 1e-14)
  # dL/dt of L = m R^2 W sin^2.
  expect_equal(
    row$drive_torque_n_m, 2 * 9 * -1.5 * 2 * sin(0.6) * cos(0.6) * 0.8, tolerance = 1e-15
  )
  inward <- 2 * (9.80665 * cos(0.6) + 3 * 0.8^2 + 3 * 1.5^2 * sin(0.6)^2)
  across <- 2 * 2 * 1.5 * 3 * cos(0.6) * 0.8
  expect_equal(row$normal_n, sqrt(inward^2 + across^2), tolerance = 1e-15)
})

test_that("the lowest point is left above the critical rate only", {
  critical <- sqrt(9.80665 / 0.2)
  time <- seq(0, 7, 0.5)
  below <- trajectory(hoop(0.98 * critical, theta0_rad = 1e-6), time)
  above <- trajectory(hoop(1.1 * critical, theta0_rad = 1e-6), time)
  expect_lt(max(abs(below$theta_rad)), 1.01e-6)
  expect_gt(max(abs(above$theta_rad)), 0.1)
})

test_that("equilibria are those of the pitchfork", {
  critical <- sqrt(9.80665 / 0.2)
  expect_equal(hoop_equilibria(hoop(critical))$theta_rad, c(0, pi))
  three <- hoop_equilibria(hoop(-9))
  angle <- acos(9.80665 / 0.2 / 81)
  expect_equal(three$theta_rad, c(-angle, 0, angle, pi), tolerance = 1e-15)
  expect_equal(three$stable, c(TRUE, FALSE, TRUE, FALSE))
  expect_equal(three$swing_rad_per_s[1], 9 * sin(angle), tolerance = 1e-15)
  expect_equal(three$growth_per_s[c(2, 4)], sqrt(c(81 - 49.03325, 81 + 49.03325)))
  # A small swing about it has that period.
  period <- 2 * pi / three$swing_rad_per_s[3]
  motion <- trajectory(hoop(-9, theta0_rad = angle + 1e-5), c(0, period / 2, period))
  expect_within(motion$theta_rad - angle, c(1, -1, 1) * 1e-5, 1e-4)
  # A start there stays: the angle is a double, the rest drifts by its rounding.
  still <- trajectory(hoop(9, theta0_rad = angle), c(0, 5))
  expect_lt(abs(still$theta_rad[2] - angle), 1e-14)
  expect_error(hoop_equilibria(scene_axle(1)), class = "rotdyn_error_type")
})

test_that("dry friction holds the bead where the force along the hoop is at most mu N", {
  # At 9 rad/s, theta = 1: |(W^2 cos - g/R) sin| over g/R cos + W^2 sin^2.
  along <- abs((81 * cos(1) - 49.03325) * sin(1))
  needed <- along / (49.03325 * cos(1) + 81 * sin(1)^2)
  held <- trajectory(hoop(9, theta0_rad = 1, static_friction = 1.0001 * needed), 0:3)
  expect_equal(held$theta_rad, rep(1, 4))
  loose <- trajectory(hoop(9, theta0_rad = 1, static_friction = 0.9999 * needed,
                           kinetic_friction = 0.5 * needed), 0:3)
  expect_gt(abs(loose$theta_rad[4] - 1), 1e-3)
  expect_equal(motion_events(loose)$event[1], "stick")
})

test_that("kinetic friction brakes a bead on a level turn as its equation says", {
  # Without gravity and turn N = m R omega^2: omega' = -mu omega^2, omega = w0/(1 + mu w0 t).
  bead <- scene_hoop(0.3, 0.5, 0, omega0_rad_per_s = 4, static_friction = 0.25,
                     gravity_m_per_s2 = 0)
  motion <- trajectory(bead, c(0, 1, 10), accuracy = 1e-11)
  expect_equal(motion$omega_rad_per_s, 4 / (1 + 0.25 * 4 * c(0, 1, 10)), tolerance = 1e-10)
  expect_equal(motion$theta_rad, log1p(c(0, 1, 10)) / 0.25, tolerance = 1e-10)
})

test_that("audits balance, and find what was edited", {
  for (bead in list(
    hoop(9, theta0_rad = 1, resistance = resistance(drag_n_s_per_m = 0.02)),
    hoop(-4, theta0_rad = 3, static_friction = 0.2),
    hoop(7, omega0_rad_per_s = 20), hoop(0, theta0_rad = 2)
  )) {
    motion <- trajectory(bead, seq(0, 3, 0.5))
    expect_equal(audit(motion)$verdict, rep("balanced", 3))
    # What is explained is next to what the error figure says, not above.
    size <- max(abs(motion$kinetic_energy_j) + abs(motion$potential_energy_j))
    expect_lt(max(audit(motion)$rounding[1:2]), 1e-7 * size)
    motion$omega_rad_per_s[7] <- motion$omega_rad_per_s[7] + 1e-5
    expect_equal(audit(motion)$verdict[1:2], rep("unbalanced", 2))
    motion$theta_rad[7] <- motion$theta_rad[7] + 0.1
    expect_true("unbalanced" %in% audit(motion)$verdict)
  }
  ledger <- augment(trajectory(hoop(9, theta0_rad = 1,
    resistance = resistance(drag_n_s_per_m = 0.02)), 0:3))
  expect_equal(
    diff(ledger$kinetic_energy_j + ledger$potential_energy_j),
    diff(ledger$work_j) - diff(ledger$dissipated_j), tolerance = 1e-9
  )
  expect_equal(9 * ledger$torque_impulse_n_m_s, ledger$work_j, tolerance = 1e-12)
})

test_that("conserved() says what a hoop conserves", {
  expect_equal(conserved(hoop(9))$conserved, c(FALSE, TRUE, FALSE))
  expect_equal(conserved(hoop(9, resistance = resistance(drag_n_s_per_m = 1)))$conserved,
    c(FALSE, FALSE, FALSE))
  expect_equal(conserved(hoop(0))$conserved, c(TRUE, TRUE, TRUE))
  expect_equal(conserved(hoop(0, static_friction = 1))$conserved, c(FALSE, FALSE, TRUE))
})

test_that("verbs work on a hoop", {
  bead <- hoop(9, theta0_rad = 0.01, resistance = resistance(drag_n_s_per_m = 0.05))
  motion <- trajectory(bead, 0:4)
  expect_equal(predict(motion, 2.5)$theta_rad, trajectory(bead, c(0, 2.5, 4))$theta_rad[2],
               tolerance = 1e-8)
  one <- summary(motion)
  fine <- trajectory(bead, seq(0, 4, 1e-3))
  expect_equal(one$max_omega_rad_per_s, max(fine$omega_rad_per_s), tolerance = 1e-5)
  expect_equal(one$final_theta_rad, motion$theta_rad[5])
  up <- time_when(bead, theta_rad = 0.5)
  expect_equal(predict(motion, up$time_s[1])$theta_rad, 0.5, tolerance = 1e-8)
  expect_equal(as.character(choose_model(bead, 0:4)$model[1]), "hoop_rk8pd")
  stiff <- hoop(1, theta0_rad = 1, resistance = resistance(drag_n_s_per_m = 1e6))
  expect_equal(as.character(choose_model(stiff, 0:4)$model[1]), "hoop_radau")
  # Down a viscous hoop: theta' = -(g/R - W^2 cos) sin m/c.
  slow <- trajectory(stiff, c(0, 4))
  expect_within(slow$theta_rad[2] - 1, -4 * (49.03325 - cos(1)) * sin(1) * 0.05 / 1e6, 1e-5)
  back <- trajectory(hoop(9, theta0_rad = 0.3, start_s = 2), c(0, 2))
  expect_equal(
    trajectory(hoop(9, theta0_rad = back$theta_rad[1], omega0_rad_per_s = back$omega_rad_per_s[1]),
               2)$theta_rad, 0.3, tolerance = 1e-7
  )
})

test_that("a hoop is refused where it is none, and its text comes back", {
  expect_snapshot(error = TRUE, {
    scene_hoop(0.05, 0.2)
    hoop(Inf)
    hoop(1, theta0_rad = "up")
    hoop(1, static_friction = 0.1, kinetic_friction = 0.2)
    scene_hoop(1e300, 1e10, 1)
    hoop(1, 2)
  })
  expect_snapshot(print(hoop(9, static_friction = 0.1)))
  bead <- scene_hoop(0.05, 0.2, 1e-310, theta0_rad = -0, static_friction = 0.3)
  skip_if_not_installed("yyjsonr")
  expect_identical(scene_hash(read_scene(write_scene(bead))), scene_hash(bead))
  expect_identical(read_scene(write_scene(bead)), bead)
  bead$radius_m <- "wide"
  expect_error(trajectory(bead, 0:1), class = "rotdyn_error_type")
  bead$radius_m <- NULL
  expect_error(trajectory(bead, 0:1), class = "rotdyn_error_type")
})

test_that("inputs of a hoop may have units", {
  skip_if_not_installed("units")
  one <- scene_hoop(units::set_units(50, "g"), units::set_units(20, "cm"),
                    units::set_units(60, "rpm"))
  expect_equal(unlist(unclass(one)[1:3], use.names = FALSE), c(0.05, 0.2, 2 * pi))
})

test_that("a missing integer is missing", {
  expect_error(scene_hoop(NA_integer_, 1, 1), "It is NA", class = "rotdyn_error_value")
  expect_identical(scene_hoop(1L, 1L, 2L), scene_hoop(1, 1, 2))
})

test_that("the unit of time changes neither a bit of the motion nor its error figure", {
  motion <- function(power) {
    s <- 2^power
    scene <- scene_hoop(
      0.65, 0.39, 3.6 / s,
      theta0_rad = -1.1, omega0_rad_per_s = 0.0175 / s,
      resistance = resistance(drag_n_s_per_m = 0.089 / s), static_friction = 0.39,
      kinetic_friction = 0.3, gravity_m_per_s2 = 9.80665 / s^2, start_s = s
    )
    trajectory(scene, s * seq(1, 5, by = 0.25))
  }
  whole <- motion(0)
  for (power in c(-100, -60, -40, 60, 100)) {
    other <- motion(power)
    expect_identical(other$theta_rad, whole$theta_rad)
    expect_identical(other$omega_rad_per_s * 2^power, whole$omega_rad_per_s)
    expect_identical(summary(other)$error, summary(whole)$error)
  }
})

test_that("the print of a bead says what resists it", {
  bead <- scene_hoop(0.1, 0.2, 5, resistance = resistance(drag_n_s_per_m = 0.1))
  expect_output(print(bead), "resistance +drag, 0.1 N s/m\n")
})
