test_that("torques about a point, by row", {
  loads <- forces(
    load_force(c(40, 0), c(0, 0.3)), load_force(50, c(0.25, 0), angle_deg = 90),
    brake = load_couple(-3)
  )
  # By hand: -0.3 40, 0.25 50.
  out <- force_torques(loads)
  expect_equal(out$torque_about_n_m, c(-12, 12.5, -3))
  expect_equal(out$lever_arm_m, c(0.3, 0.25, NA))
  expect_equal(out$load, c("force", "force", "brake"))
  # About (0.25, 0.3) neither force has an arm.
  expect_equal(force_torques(loads, c(0.25, 0.3))$torque_about_n_m, c(0, 0, -3))
  # In space: r x F = (4 1 - 0 (-2), 0 5 - (-2) 1, (-2) (-2) - 4 5).
  space <- force_torques(load_force(c(5, -2, 1), c(-2, 4, 0)))
  expect_equal(
    unlist(space[c("torque_about_x_n_m", "torque_about_y_n_m", "torque_about_z_n_m")]),
    c(4, 2, -16), ignore_attr = TRUE
  )
  expect_equal(space$lever_arm_m, sqrt(4^2 + 2^2 + 16^2) / sqrt(30))
})

test_that("a resultant is a force, a couple, a wrench or nothing", {
  # Two parallel forces: 30 N and 10 N at 0 and 4 m act as 40 N at 1 m.
  two <- resultant(data.frame(x_m = c(0, 4), y_m = 0, fx_n = 0, fy_n = c(-30, -10)))
  expect_equal(two$kind, "force")
  expect_equal(c(two$fy_n, two$torque_n_m, two$axis_x_m, two$couple_n_m), c(-40, -40, 1, 0))
  couple <- resultant(forces(load_force(c(0, 3), c(2, 0)), load_force(c(0, -3), c(7, 1))))
  expect_equal(couple$kind, "couple")
  expect_equal(c(couple$torque_n_m, couple$couple_n_m), c(-15, -15))
  expect_true(is.na(couple$axis_x_m))
  expect_equal(resultant(load_force(c(0, 0), c(1, 1)))$kind, "none")
  # 3 along x at (1, 0, 2) and 4 along y: the torque (0, 6, 0) has 6 4/5 along the force.
  wrench <- resultant(data.frame(
    x_m = c(0, 1), y_m = 0, z_m = c(0, 2), fx_n = c(0, 3), fy_n = c(4, 0), fz_n = 0
  ))
  expect_equal(wrench$kind, "wrench")
  expect_equal(c(wrench$force_n, wrench$couple_n_m, wrench$pitch_m), c(5, 4.8, 0.96))
  # F x tau/F^2 = (3, 4, 0) x (0, 6, 0)/25.
  expect_equal(c(wrench$axis_x_m, wrench$axis_y_m, wrench$axis_z_m), c(0, 0, 18 / 25))
})

test_that("about any point of the central axis the torque is the couple along the force", {
  set.seed(4)
  for (i in 1:50) {
    n <- sample(2:6, 1)
    table <- data.frame(
      x_m = rnorm(n), y_m = rnorm(n), z_m = rnorm(n), fx_n = rnorm(n), fy_n = rnorm(n),
      fz_n = rnorm(n), torque_x_n_m = rnorm(n)
    )
    one <- resultant(table, rnorm(3))
    at <- resultant(table, c(one$axis_x_m, one$axis_y_m, one$axis_z_m))
    force <- c(at$fx_n, at$fy_n, at$fz_n)
    torque <- c(at$torque_x_n_m, at$torque_y_n_m, at$torque_z_n_m)
    expect_equal(torque, one$couple_n_m * force / sqrt(sum(force^2)), tolerance = 1e-12)
    expect_equal(at$pitch_m, one$pitch_m, tolerance = 1e-10)
  }
})

test_that("sums that cancel keep their digits", {
  # 1e16 + 1 - 1e16 is 0 in plain sums.
  table <- data.frame(x_m = c(1e8, 1, 1e8), y_m = 0, fx_n = 0, fy_n = c(1e16, 1, -1e16))
  one <- resultant(table)
  expect_identical(c(one$fy_n, one$torque_n_m), c(1, 1))
  expect_gte(one$force_error_n, 1)
  # The kind is that of the numbers, not of their rounding.
  third <- data.frame(x_m = 0:2, y_m = 0, fx_n = 0, fy_n = c(0.1, 0.2, -0.3))
  expect_equal(resultant(third)$kind, "couple")
  huge <- load_force(c(1e300, 0), c(0, 1e-300))
  expect_equal(resultant(huge)$torque_n_m, -1, tolerance = 1e-15)
  expect_warning(resultant(load_force(c(1e300, 0), c(0, 1e300))), class = "rotdyn_warning_range")
})

test_that("loads: weights, lines, couples", {
  expect_equal(load_weight(2, c(1, 3), gravity_m_per_s2 = 10)$fy_n, -20)
  expect_equal(load_weight(2, c(1, 3, 5), gravity_m_per_s2 = 10)$fz_n, -20)
  # An even load of 100 N/m on 3 m: 300 N in the middle.
  even <- resultant(load_line(100, c(1, 0), c(4, 0)))
  expect_equal(c(even$fy_n, even$torque_n_m), c(-300, -750))
  # From 0 to 300 N/m: 450 N at 2/3 of the length; the sides of a trapezium add.
  slope <- resultant(load_line(c(0, 300), c(0, 0), c(3, 0)))
  expect_equal(c(slope$fy_n, slope$torque_n_m), c(-450, -900))
  both <- resultant(load_line(c(100, 300), c(0, 0), c(3, 0)))
  # int (100 + 200 x/3) x dx = 450 + 600.
  expect_equal(c(both$fy_n, both$torque_n_m), c(-600, -1050))
  expect_equal(nrow(forces()), 0)
  expect_equal(load_force(10, c(0, 0), angle_deg = 30)$fy_n, 5)
  expect_identical(forces(list(a = load_couple(1), load_couple(2)))$load, c("a", "couple"))
  skip_if_not_installed("units")
  expect_equal(load_force(units::set_units(1, "kN") |> rep(2), c(0, 0))$fx_n, 1000)
})

test_that("errors of loads", {
  expect_error(load_force(1, c(0, 0)), class = "rotdyn_error_size")
  expect_error(load_force(c(1, 2, 3), c(0, 0)), class = "rotdyn_error_size")
  expect_error(load_force(c(1, NA), c(0, 0)), class = "rotdyn_error_value")
  expect_error(load_weight(-1, c(0, 0)), class = "rotdyn_error_value")
  expect_error(load_couple(c(1, 2)), class = "rotdyn_error_size")
  expect_error(load_couple(1, c(0, 0, 0)), class = "rotdyn_error_size")
  expect_error(load_line(1:3, c(0, 0), c(1, 0)), class = "rotdyn_error_size")
  expect_error(
    forces(load_couple(1), load_force(c(1, 2, 3), c(0, 0, 0))), class = "rotdyn_error_size"
  )
  expect_error(forces(1), class = "rotdyn_error_type")
  expect_error(forces(data.frame(x_m = 1)), class = "rotdyn_error_type")
  expect_error(
    resultant(data.frame(x_m = 1, y_m = 0, fx_n = Inf, fy_n = 0)), class = "rotdyn_error_value"
  )
  for (load in list(1:2, c("a", NA), cbind(c("a", "b"), c("c", "d")), list("a", "b"))) {
    table <- data.frame(x_m = 0:1, y_m = 0, fx_n = 1, fy_n = 0)
    table$load <- load
    expect_error(resultant(table), "load must be names", class = "rotdyn_error_type")
  }
  expect_error(resultant(load_couple(1), c(0, 0, 0)), class = "rotdyn_error_size")
  expect_error(resultant(list()), class = "rotdyn_error_size")
  expect_error(load_weight(1e308, c(0, 0)), class = "rotdyn_error_range")
  expect_error(load_force(at_m = c(0, 0)), class = "rotdyn_error_missing")
})

# Rows of the textbook in the domains of torque: the row's inputs in its own units, and the
# published answer within its digits.
test_that("textbook: torques and what they do", {
  rows <- published("openstax_rotation")
  is <- function(id, got) expect_published(got, rows[[id]])
  vector <- force_torques(load_force(c(5, -2, 1), c(-2, 4, 0)))
  is("UP10-40", vector$torque_about_z_n_m)
  is("UP10-41", vector$torque_about_x_n_m)
  expect_equal(torque_of_force(c(5, -2, 1), position_m = c(-2, 4, 0))[["z"]], -16)
  disk <- body_disk(50, 1.5)
  is("UP10-43", torque_of_force(250, 1.5) / moment_of_inertia(disk, "z"))
  child <- moment_of_inertia(disk, "z") + 18 * 1.25^2
  is("UP10-44", torque_of_force(250, 1.5) / child)
  stone <- forces(
    pull = load_force(c(0, 180), c(0.28, 0)), brake = load_force(c(0, -20), c(0.015, 0))
  )
  is("UP10-46", resultant(stone)$torque_n_m / moment_of_inertia(body_disk(75, 0.28), "z"))
  slows <- angular_motion(
    omega0_rad_per_s = convert_angle(500, "rpm", "rad/s"), omega_rad_per_s = 0, time_s = 120
  )
  is("UP10-47", 100 * slows$alpha_rad_per_s2)
  # A rod on its remaining string: the weight turns it about that end.
  rod <- load_weight(1, c(0.5, 0), gravity_m_per_s2 = 9.8)
  end <- resultant(rod)$torque_n_m / moment_of_inertia(body_rod_end(1, 1), "z", through = "origin")
  is("UP10-50", -end * 1)
  earth <- moment_of_inertia(body_sphere(5.979e24, 6.376e6), "z")
  turn <- function(hours) 2 * pi / (hours * 3600)
  slow <- torque_of_force(4e7, 6.376e6) / earth
  is("CP10-06", (turn(24) - turn(28)) / slow)
  is("UP11-20",
    angular_momentum_of(15, velocity_m_per_s = c(0, -2000, 0),
      position_m = c(25e3, 25e3, 0))[["z"]])
})
