# What an audit of an incline allows for rounding, in units of rounding of its largest term.
allowed <- function(motion) {
  a <- audit(motion)
  expect_true(all(a$verdict == "balanced"))
  size <- vapply(a$terms, function(terms) max(abs(terms$value)), 0)
  a$rounding / size / .Machine$double.eps
}

test_that("audits of exact inclines allow for some roundings, not for more", {
  ball <- body_sphere(2, 0.1)
  times <- seq(0, 3, by = 0.1)
  scenes <- list(
    slips = scene_incline(ball, 20, static_friction = 0.1, kinetic_friction = 0.05),
    begins_to_roll = scene_incline(
      ball, 20, v0_m_per_s = 5, static_friction = 0.6, kinetic_friction = 0.5
    ),
    rolling_resistance = scene_incline(
      ball, 10, v0_m_per_s = 2, omega0_rad_per_s = 20, static_friction = 0.6,
      kinetic_friction = 0.5, rolling_arm_m = 1e-3
    )
  )
  for (name in names(scenes)) {
    expect_lt(max(allowed(trajectory(scenes[[name]], times))), 400, label = name)
  }
})

test_that("rolling resistance holds a body until friction turns it with more", {
  scene <- scene_incline(body_sphere(2, 0.1), 20, static_friction = 0.6, rolling_arm_m = 0.02)
  resists <- 0.02 * 2 * 9.80665 * cos(20 * pi / 180)
  turning <- function(friction_n) {
    at_rest <- list(
      v_m_per_s = 0, omega_rad_per_s = 0, friction_force_n = friction_n, rolling = FALSE,
      slip_speed_m_per_s = 0
    )
    rotdyn:::slopes_incline(at_rest, scene)$omega_rad_per_s
  }
  expect_identical(turning(-0.9 * resists / 0.1), 0)
  expect_equal(turning(-1.5 * resists / 0.1), 0.5 * resists)
  expect_equal(turning(1.5 * resists / 0.1), -0.5 * resists)
})

test_that("the time scales of an incline: v/g, m/c", {
  time_scales <- function(..., speed = 3, turning = 0) {
    scene <- scene_incline(body_sphere(2, 0.1), 10, ...)
    sizes <- c(x = 0, v = speed, theta = 0, omega = turning)
    rotdyn:::constraint_of(scene)$time_scales(scene, sizes, NULL)$fades_s
  }
  expect_equal(time_scales(), 3 / 9.80665)
  expect_equal(time_scales(turning = 50), 5 / 9.80665)
  expect_equal(time_scales(resistance = resistance(drag_n_s_per_m = 40)), 2 / 40)
  expect_equal(time_scales(resistance = resistance(drag_n_s2_per_m2 = 40)), 2 / (40 * 3))
})

test_that("rolling resistance slows a body that turns, also where friction is the smaller", {
  scene <- scene_incline(body_sphere(2, 0.1), 20, static_friction = 0.6, rolling_arm_m = 0.02)
  resists <- 0.02 * 2 * 9.80665 * cos(20 * pi / 180)
  turning <- function(friction_n, omega) {
    sliding <- list(
      v_m_per_s = 0, omega_rad_per_s = omega, friction_force_n = friction_n, rolling = FALSE,
      slip_speed_m_per_s = 1
    )
    rotdyn:::slopes_incline(sliding, scene)$omega_rad_per_s
  }
  expect_equal(turning(-0.5 * resists / 0.1, 3), -0.5 * resists)
  expect_equal(turning(-0.5 * resists / 0.1, -3), 1.5 * resists)
  expect_equal(turning(2 * resists / 0.1, 3), -3 * resists)
})

test_that("a rolling body that drag alone slows fades to the last and never reverses", {
  scene <- scene_incline(
    body_sphere(1.3, 0.1), 0, v0_m_per_s = 3, omega0_rad_per_s = 30,
    resistance = resistance(drag_n_s_per_m = 0.2)
  )
  time_s <- c(1, 100, 350, 1000)
  motion <- trajectory(scene, time_s)
  # m + I/r^2 = 7 m/5.
  expect_equal(
    motion$v_m_per_s, 3 * exp(-0.2 * time_s / (1.3 * 1.4)), tolerance = 1e-9
  )
  expect_true(all(motion$v_m_per_s >= 0))
  late <- trajectory(scene, c(time_s, 1e5, 1e6))
  expect_identical(glance(late)$model, "incline_radau")
  expect_identical(nrow(motion_events(motion)) + nrow(motion_events(late)), 0L)
})
