ball <- function(...) body_sphere(6, 0.11, ...)

test_that("a bowling ball slides, then rolls", {
  # physicsforums.com 394359: a = 1.86 m/s^2, alpha = 42.3 rad/s^2; closed form for the rest.
  lane <- scene_incline(
    ball(), 0, static_friction = 0.19, v0_m_per_s = 8.1, omega0_rad_per_s = 0,
    gravity_m_per_s2 = 9.8
  )
  motion <- trajectory(lane, c(0, 1, 1.2429031765, 3))
  expect_named(motion, incline_columns)
  expect_equal(8.1 - motion$v_m_per_s[2], 1.862, tolerance = 1e-14)
  expect_equal(motion$omega_rad_per_s[2], 42.31818182, tolerance = 1e-9)
  expect_equal(motion_events(motion)$event, "roll")
  expect_equal(motion_events(motion)$time_s, 1.242903176, tolerance = 1e-9)
  expect_equal(motion$x_m[3], 8.629299196, tolerance = 1e-9)
  expect_equal(motion$v_m_per_s[4], 5.785714286, tolerance = 1e-9)
  expect_equal(motion$rolling, c(FALSE, FALSE, TRUE, TRUE))
  # loss = (m/2) beta/(1 + beta) u^2
  expect_equal(motion$slip_heat_j[4], 3 * 0.4 / 1.4 * 8.1^2, tolerance = 1e-14)
  expect_equal(summary(motion)$roll_time_s, 1.242903176, tolerance = 1e-9)
})

test_that("a ball struck at 4/5 of its radius above the centre ends at 9/7 of the speed", {
  # omega0 = 5 v0 h/(2 R^2); BGU e_22_8_422
  struck <- scene_incline(
    ball(), 0, static_friction = 0.2, v0_m_per_s = 2, omega0_rad_per_s = 2.5 * 2 * 0.8 / 0.11
  )
  motion <- trajectory(struck, c(0, 60))
  expect_equal(motion$v_m_per_s[2], 2 * 9 / 7, tolerance = 1e-14)
})

test_that("the sphere of Drake's test, and rows of University Physics", {
  drake <- trajectory(scene_incline(
    body_sphere(0.1, 0.05), 15, static_friction = 1, kinetic_friction = 0.5,
    gravity_m_per_s2 = 9.81
  ), 1)
  expect_equal(drake$v_m_per_s, 1.813582023, tolerance = 1e-9)
  expect_equal(drake$friction_force_n, -0.07254328093, tolerance = 1e-9)
  # UP11-04, UP11-05: a = 3.5 m/s^2, 15.75 m after 3 s
  marble <- trajectory(scene_incline(body_sphere(1, 1), 30, gravity_m_per_s2 = 9.8), c(1, 3))
  expect_equal(marble$v_m_per_s[1], 3.5, tolerance = 1e-14)
  expect_equal(marble$x_m[2], 15.75, tolerance = 1e-14)
  # UP11-13, UP11-14: 8.34 m up the slope, 2.38 s
  up <- scene_incline(
    body_spherical_shell(1, 0.1), 30, v0_m_per_s = -7, gravity_m_per_s2 = 9.8
  )
  motion <- trajectory(up, c(0, 2.380952380952381, 5))
  expect_equal(motion_events(motion)$time_s, 2.380952381, tolerance = 1e-9)
  expect_equal(motion_events(motion)$event, "reverse")
  expect_equal(motion$x_m[2], -8.333333333, tolerance = 1e-9)
})

test_that("the table of slip to roll, as a user would call it", {
  table <- utils::read.csv(shared("refs/slip_to_roll.csv"), colClasses = "character")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], as.numeric)
    # A disk on a radius that gives its beta.
    scene <- scene_incline(
      body_disk(r$m, r$R * sqrt(2 * r$beta)), r$theta * 180 / pi, radius_m = r$R,
      static_friction = r$mu, v0_m_per_s = r$v0, omega0_rad_per_s = r$omega0,
      gravity_m_per_s2 = r$g
    )
    rolls <- is.finite(r$t_roll) && r$mu >= r$mu_needed_to_keep_rolling
    motion <- trajectory(scene, if (rolls) r$t_roll * c(1, 1.001) else 100)
    events <- motion_events(motion)
    expect_identical("roll" %in% events$event, rolls)
    if (!rolls) next
    expect_equal(events$time_s[events$event == "roll"], r$t_roll, tolerance = 2e-13)
    info <- run_of(motion)$info
    motion <- motion[1, ]
    # The angle in degrees, and the time, are rounded.
    size <- max(abs(r$v0), abs(r$R * r$omega0), 2 * r$g * r$t_roll)
    expect_lte(abs(motion$v_m_per_s - r$v_roll), info$errors[["v"]] + 1e-15 * size)
    expect_lte(abs(motion$omega_rad_per_s - r$omega_roll),
      info$errors[["omega"]] + 1e-15 * size / r$R)
    expect_lte(abs(motion$x_m - r$x_roll), info$errors[["x"]] + 1e-15 * size * r$t_roll)
    expect_equal(motion$slip_heat_j, r$heat, tolerance = 1e-12)
  }
})

test_that("an uphill launch with back-spin: rows do not depend on each other", {
  up <- scene_incline(
    ball(), 20, static_friction = 0.3, kinetic_friction = 0.05, v0_m_per_s = -8.1,
    omega0_rad_per_s = 30, rolling_arm_m = 0.005
  )
  time <- seq(0, 8, by = 0.25)
  motion <- trajectory(up, time)
  expect_equal(motion_events(motion)$event, c("roll", "reverse"))
  expect_identical(trajectory(up, time[20])$x_m, motion$x_m[20])
  expect_identical(predict(motion, time[c(9, 3)])$v_m_per_s, motion$v_m_per_s[c(9, 3)])
  expect_lte(run_of(motion)$info$error, 1e-13)
  expect_true(all(audit(motion)$verdict == "balanced"))
  # A rate that is wrong shows.
  motion$v_m_per_s[33] <- motion$v_m_per_s[33] * (1 + 1e-6)
  expect_equal(audit(motion)$verdict[1:2], c("unbalanced", "unbalanced"))
})

test_that("audits balance, friction stays in its cone, in random scenes", {
  set.seed(13)
  for (i in 1:60) {
    mu <- stats::runif(1, 0, 0.8)
    scene <- scene_incline(
      body_disk(stats::runif(1, 0.1, 9), 0.2), stats::runif(1, -70, 70), static_friction = mu,
      kinetic_friction = mu * stats::runif(1, 0.5, 1),
      rolling_arm_m = sample(c(0, 0.01, 0.1), 1), v0_m_per_s = stats::rnorm(1, 0, 4),
      omega0_rad_per_s = stats::rnorm(1, 0, 30), start_s = -1
    )
    motion <- trajectory(scene, seq(-1, 4, length.out = 41))
    expect_true(all(audit(motion)$verdict == "balanced"))
    normal <- scene$mass_kg * 9.80665 * cos(scene$incline_angle_deg * pi / 180)
    expect_lte(max(abs(motion$friction_force_n)), mu * normal * (1 + 1e-13))
    expect_true(all(motion$friction_force_n * motion$slip_speed_m_per_s <= 0))
    ledger <- augment(motion)
    expect_equal(ledger$dissipated_j, motion$slip_heat_j + motion$rolling_heat_j)
    expect_equal(ledger$work_j, -motion$potential_energy_j + motion$potential_energy_j[1],
      tolerance = 1e-12)
  }
})

test_that("before the start, and no rows", {
  scene <- scene_incline(ball(), 10, start_s = 1)
  expect_error(trajectory(scene, 0:2), class = "rotdyn_error_time")
  none <- trajectory(scene, double())
  expect_identical(nrow(none), 0L)
  expect_true(all(is.na(audit(none)$verdict)))
  expect_identical(nrow(augment(none)), 0L)
})

test_that("every verb knows the incline", {
  scene <- scene_incline(ball(), 10, static_friction = 0.2, rolling_arm_m = 1e-3)
  expect_equal(choose_model(scene, 0:3)$model, "incline_exact")
  motion <- trajectory(scene, 0:3)
  known <- rotdyn_columns()$name
  for (table in list(motion, summary(motion), augment(motion), work_precision(scene, 0:3))) {
    expect_setequal(setdiff(names(table), c(known, "x_error", "v_error")), character())
  }
  expect_s3_class(generics::glance(motion), "tbl_df")
  expect_error(trajectory(scene, 0:3, accuracy = 1e-16), class = "rotdyn_error_accuracy")
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(motion), "ggplot")
})
