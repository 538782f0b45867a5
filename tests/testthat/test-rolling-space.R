g <- 9.80665

test_that("a ball on a turntable runs on a circle, 2/7 as fast as the table", {
  t <- seq(0, 20, by = 0.5)
  x <- ball_on_turntable(
    body_sphere(0.3, 0.02), t, turntable_rad_per_s = 3.5, x_m = 0.3, y_m = -0.1,
    vx_m_per_s = 0.05, vy_m_per_s = 0.2, spin_rad_per_s = 4
  )
  # k = 1 rad/s: centre at r0 + z x v0, radius |v0|.
  expect_equal(x$circle_x_m, rep(0.1, length(t)))
  expect_equal(x$circle_y_m, rep(-0.05, length(t)))
  expect_equal(sqrt((x$x_m - 0.1)^2 + (x$y_m + 0.05)^2), rep(sqrt(0.0425), length(t)))
  expect_equal(x$circle_period_s, rep(2 * pi, length(t)))
  expect_equal(x$x_m, 0.1 + 0.2 * cos(t) + 0.05 * sin(t))
  # The contact moves as the table under it: v - r omega x z = Omega z x r.
  expect_equal(x$vx_m_per_s - 0.02 * x$omega_y_rad_per_s, -3.5 * x$y_m)
  expect_equal(x$vy_m_per_s + 0.02 * x$omega_x_rad_per_s, 3.5 * x$x_m)
  expect_lt(max(abs(x$energy_residual_j)), 1e-14 * max(x$kinetic_energy_j))
  expect_gt(diff(range(x$work_j)), 0.01)
  # A shell: (2/3)/(5/3) = 2/5.
  shell <- ball_on_turntable(body_spherical_shell(1, 0.1), 1, 5, 0.2, vy_m_per_s = 0.1)
  expect_equal(shell$circle_period_s, pi)
  ball <- body_sphere(1, 0.02)
  still <- ball_on_turntable(ball, 2, 0, 0.2, vx_m_per_s = 0.5)
  expect_equal(still$x_m, 1.2)
  expect_identical(still$circle_radius_m, Inf)
  expect_identical(is.na(ball_on_turntable(ball, c(1, NA), 1, 0.2)$x_m), c(FALSE, TRUE))
  expect_error(ball_on_turntable(0.02, 1, 1, 0.2), class = "rotdyn_error_type")
  expect_error(ball_on_turntable(ball, 1, 1), class = "rotdyn_error_missing")
  expect_error(ball_on_turntable(ball, 1, Inf, 0.2), class = "rotdyn_error_value")
  expect_error(
    ball_on_turntable(body_sphere(0, 0.02), 1, 1, 0.2), "mass_kg", class = "rotdyn_error_value"
  )
  given <- list(time_s = 1, turntable_rad_per_s = 1, x_m = 0.2, y_m = 0, vx_m_per_s = 0,
                vy_m_per_s = 0, spin_rad_per_s = 0)
  for (name in names(given)) {
    endless <- replace(given, name, list(c(1, -Inf)))
    expect_error(
      do.call(ball_on_turntable, c(list(ball), endless)), paste0(name, ".*must be finite"),
      class = "rotdyn_error_value"
    )
  }
})

test_that("the least speed of a disk and of a hoop", {
  x <- rolling_disk_speed(list(body_disk(2, 0.3), body_hoop(1, 0.3)))
  expect_equal(x$min_speed_m_per_s^2, g * 0.3 / c(3, 4))
  expect_equal(x$min_spin_rad_per_s, x$min_speed_m_per_s / 0.3)
  expect_error(rolling_disk_speed(0.3), class = "rotdyn_error_type")
  expect_error(rolling_disk_speed(body_cylinder(0, 1, 1)), class = "rotdyn_error_value")
  # A long cylinder: It = m (r^2/4 + l^2/12).
  long <- rolling_disk_speed(body_cylinder(3, 0.1, 0.6))
  expect_equal(long$min_speed_m_per_s^2, g * 0.1 * (0.25 + 3) / (0.5 * 1.5))
})

test_that("a coin rolls straight, on a circle, wobbles, and falls", {
  straight <- roll_disk(body_disk(1, 0.5), c(-1, 0, 2), spin_rad_per_s = 6)
  expect_equal(straight$x_m, c(-3, 0, 6))
  expect_equal(straight$normal_n, rep(g, 3))
  # A steady circle: the spin that belongs to a lean and a yaw.
  lean <- 25 * pi / 180
  spin <- -(g / 0.3 * sin(lean) / (3 * cos(lean)) + 1.25 * 3 * sin(lean)) / 1.5
  circle <- roll_disk(
    body_disk(1, 0.3), seq(0, 2 * pi / 3, length.out = 9), lean_deg = 25, yaw_rad_per_s = 3,
    spin_rad_per_s = spin
  )
  expect_lt(max(abs(circle$lean_rad - lean)), 1e-9)
  # After a turn it is back.
  expect_equal(unlist(circle[9, c("x_m", "y_m")]), unlist(circle[1, c("x_m", "y_m")]),
               tolerance = 1e-8)
  wobble <- roll_disk(body_disk(0.01, 0.02), seq(0, 5, by = 0.05), 30, lean_deg = 20,
    yaw_rad_per_s = 5)
  energy <- wobble$kinetic_energy_j + wobble$potential_energy_j
  expect_lt(diff(range(energy)), 1e-7 * energy[1])
  expect_gt(diff(range(wobble$lean_rad)), 0.1)
  expect_lt(attr(wobble, "error")[["attitude_rad"]], 1e-7)
  # The contact is at rest: it moves along the floor as the place of contact changes, not the disk.
  expect_equal(wobble$z_m, 0.02 * cos(wobble$lean_rad))
  expect_warning(
    fall <- roll_disk(body_disk(1, 0.5), seq(0, 2, by = 0.1), lean_deg = 17),
    class = "rotdyn_warning_truncated"
  )
  expect_identical(is.na(fall$x_m[21]), TRUE)
  expect_identical(is.na(fall$x_m[1]), FALSE)
  coin <- body_disk(1, 0.1)
  expect_error(roll_disk(body_box(1, 1, 1, 1), 0:1), class = "rotdyn_error")
  expect_error(roll_disk(coin, 0:1, lean_deg = 90), class = "rotdyn_error_value")
  expect_error(roll_disk(coin, 1:0), class = "rotdyn_error_time")
  expect_error(roll_disk(coin), class = "rotdyn_error_missing")
  expect_error(roll_disk(0.1, 0:1), class = "rotdyn_error_type")
  expect_error(roll_disk(coin, 0:1, tilt = 3), class = "rotdyn_error_argument")
})

test_that("a ball on a turntable keeps its phase", {
  ball <- ball_on_turntable(body_sphere(1, 0.02), c(1e6, 1e13), 3.5, x_m = 0.3, vy_m_per_s = 0.1)
  expect_lt(max(abs(ball$x_m - c(0.29367521275470222, 0.29574781870349880))), 1e-16)
  expect_lt(max(abs(ball$y_m - c(-0.034999350213414997, -0.028850566953214669))), 1e-16)
})

test_that("the error of a disk's place covers what rounding does to its heading", {
  # Upright it rolls straight: x = r omega t.
  for (end in c(10, 300)) {
    disk <- roll_disk(body_disk(1, 0.3), c(0, end), spin_rad_per_s = 20, accuracy = 1e-12)
    off <- sqrt((disk$x_m[2] - 6 * end)^2 + disk$y_m[2]^2)
    said <- attr(disk, "error")[["position_m"]]
    expect_lt(off, said)
    expect_lt(said, 1e-15 * 6 * end * 20 * end)
  }
})

test_that("the time at which a disk lies flat is told, where it does, and only there", {
  # From rest it turns about the tangent: lean'' = 4 g/(5 r) sin(lean).
  start <- 17 * pi / 180
  rate <- 4 * g / (5 * 0.5)
  # lean = start + s^2 takes the root out of the start.
  flat <- stats::integrate(function(s) {
    2 * s / sqrt(2 * rate * (cos(start) - cos(start + s^2)))
  }, 0, sqrt(pi / 2 - start), rel.tol = 1e-10)$value
  said <- expect_warning(
    roll_disk(body_disk(1, 0.5), seq(0, 2, by = 0.1), lean_deg = 17),
    class = "rotdyn_warning_truncated"
  )
  told <- as.numeric(sub(".* at ([0-9.]+) s.*", "\\1", conditionMessage(said)))
  expect_equal(told, flat, tolerance = 1e-3)
  expect_no_warning(roll_disk(body_disk(1, 0.5), c(0, 2), spin_rad_per_s = 6))
})

test_that("the errors that a rolling disk states cover, and are not far above", {
  coin <- function(accuracy) {
    roll_disk(body_disk(0.01, 0.02), seq(0, 5, by = 0.05), 30, lean_deg = 20, yaw_rad_per_s = 5,
      accuracy = accuracy)
  }
  fine <- coin(1e-12)
  rates <- paste0("omega_space_", c("x", "y", "z"), "_rad_per_s")
  farthest <- function(x, columns) {
    max(sqrt(rowSums((as.matrix(x[columns]) - as.matrix(fine[columns]))^2)))
  }
  for (accuracy in c(1e-3, 1e-5, 1e-7, 1e-9)) {
    x <- coin(accuracy)
    off <- c(
      2 * farthest(x, c("qw", "qx", "qy", "qz")),
      farthest(x, rates) / max(sqrt(rowSums(as.matrix(fine[rates])^2))),
      farthest(x, c("x_m", "y_m", "z_m"))
    )
    expect_true(all(off <= attr(x, "error")), info = format(accuracy))
    expect_true(all(attr(x, "error") < 300 * off), info = format(accuracy))
  }
})
