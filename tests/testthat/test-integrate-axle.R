test_that("rows take the law's own value only where it is as small as its rounding", {
  calls <- 0
  law <- function(time_s) {
    calls <<- calls + length(time_s)
    exp(-time_s)
  }
  count <- function(times) {
    calls <<- 0
    trajectory(scene_axle(1, law), times)
    calls
  }
  # From 2e-9 to 1.3e-14 of its largest value: no row is read again.
  expect_identical(count(c(0, seq(20, 32, length.out = 100), 32)), count(c(0, 32)))
  # Another value at the instant alone.
  odd <- function(time_s) ifelse(time_s == 2, 5, time_s - 2)
  expect_lt(abs(trajectory(scene_axle(1, odd), 0:3)$applied_torque_n_m[3]), 1e-15)
})

test_that("a start at rest on a jump of the angle that pushes back is refused at once", {
  calls <- 0
  valley <- function(above, below) {
    function(time_s, theta_rad, omega_rad_per_s) {
      calls <<- calls + 1
      if (theta_rad > 1) above else below
    }
  }
  start <- function(law, ...) scene_axle(1, law, theta0_rad = 1, ...)
  expect_error(
    trajectory(start(valley(-2, 1)), 0:2), "stays there.*0 N m", class = "rotdyn_error_step"
  )
  expect_lt(calls, 50)
  # Friction holds it; a law of 0 there rests; beside the jump it swings, v^2/2 = torque times way.
  held <- trajectory(start(valley(-2, 1), resistance = resistance(0, coulomb_n_m = 1.5)), 0:2)
  expect_true(all(held$omega_rad_per_s == 0))
  still <- trajectory(start(function(t, theta, omega) -sign(theta - 1)), 0:2)
  expect_true(all(still$theta_rad == 1))
  expect_true(all(audit(still)$verdict == "balanced"))
  beside <- trajectory(scene_axle(1, valley(-2, 1), theta0_rad = 0.5), c(0, 1, 1.5))
  expect_equal(beside$omega_rad_per_s, c(0, 1, 0), tolerance = 1e-9)
  # A push to one side: the last ulp of the angle, 2e-16 rad at 1 N m, takes 2e-8 s of it. And a
  # spring at the place where it is at rest but for rounding.
  away <- trajectory(start(valley(2, 1)), 1)
  expect_equal(away$omega_rad_per_s, 2, tolerance = 2e-8)
  spring <- trajectory(start(function(t, theta, omega) -1e6 * (theta - (1 + 1e-16))), 0:1)
  expect_lt(max(abs(spring$omega_rad_per_s)), 1e-9)
})

test_that("a start at rest where terms cancel is no step too short", {
  # A torque of 0.03 N m of terms of 1 N m: the rounding of its slope is 5e-15 of the motion.
  coefficients <- rbind(
    c(-0.48764084677932834, 0.3762002102299001, -0.3792937345604985),
    c(-0.3456973735749497, -0.9158399735967073, -0.012408419582237398)
  )
  law <- torque_polynomial(c(-0.790731, 0.9724858, 2.24539), coefficients) +
    torque_gravity(7.447971239145335 / 9.80665, 1, 0.09757057021603766) +
    torque_curve(
      c(-4.090072393105202, -0.9298759027728205, 1.6813148810731788, 2.0945612714230926),
      c(-1.0365293663466921, -1.0558298300026272, -0.17003836872238506, 1.2687400690731936)
    )
  scene <- scene_axle(0.4232791638531954, law, start_s = -1.7)
  ends <- c(0.9, 1.3, 2.3, 4.2, 5.6)
  omega <- vapply(ends, function(end) {
    trajectory(scene, end, accuracy = 1e-12)$omega_rad_per_s
  }, 1)
  expect_equal(trajectory(scene, ends)$omega_rad_per_s, omega, tolerance = 1e-8)
})

test_that("a start at rest at a zero of the torque is that of any other period", {
  from <- function(start_s, time_s = 1:3) {
    law <- torque_sinusoid(1, 2 * pi, -pi / 2)
    scene <- scene_axle(1, law, resistance(quadratic_n_m_s2 = 0.1), start_s = start_s)
    trajectory(scene, start_s + time_s)$omega_rad_per_s
  }
  for (start_s in c(1, 2, 3, 17, -1, -5)) {
    expect_equal(from(start_s), from(0), tolerance = 1e-9)
    expect_equal(from(start_s, -3:-1), from(0, -3:-1), tolerance = 1e-9)
  }
  expect_equal(from(0.5), -from(0), tolerance = 1e-9)
})

test_that("a span of a few roundings of the time is one step", {
  start_s <- 3 * 0.1
  scene <- scene_pendulum(body_point(1), 1, resistance(0.1), theta0_rad = 1, start_s = start_s)
  rows <- trajectory(scene, c(0.3, 1))
  later <- trajectory(scene, c(start_s, 1))
  expect_equal(rows$theta_rad, later$theta_rad, tolerance = 1e-12)
})

test_that("two torques that vanish at rest let a motion fade, which never reverses", {
  # (t in s) omega' = -0.3 omega below 1 rad/s, and drag: omega = 1/((1 + k) exp(0.3 t) - k).
  still <- torque_curve(c(-1, 0, 1), c(0.1, 0, -0.1)) + torque_curve(c(-1, 0, 1), c(0.2, 0, -0.2))
  scene <- scene_axle(1, still, resistance(quadratic_n_m_s2 = 0.1), omega0_rad_per_s = 1)
  time_s <- c(1, 10, 50, 300, 1000)
  motion <- trajectory(scene, time_s)
  k <- 0.1 / 0.3
  expect_equal(motion$omega_rad_per_s, 1 / ((1 + k) * exp(0.3 * time_s) - k), tolerance = 1e-9)
  expect_true(all(motion$omega_rad_per_s > 0))
  expect_identical(nrow(motion_events(motion)), 0L)
})

test_that("what is at rest where nothing drives it stays there, at once", {
  both <- resistance(0.1, quadratic_n_m_s2 = 0.1)
  dry <- resistance(0.1, 0.1, 1)
  scenes <- list(
    scene_pendulum(body_point(1), 1, both), scene_pendulum(body_point(1), 1, dry),
    scene_axle(1, torque_spring(1), both), scene_axle(1, torque_gravity(1, 1), both),
    scene_axle(1, torque_curve(-1:1, 1:-1), both), scene_axle(1, torque_sinusoid(0.1, 2), dry),
    scene_drive(c(1, 2), coupling_shaft(10), resistance = list(both, NULL)),
    scene_drive(c(1, 2), coupling_clutch(10)), scene_incline(body_sphere(1, 0.1), 0),
    scene_hoop(1, 1, 0, static_friction = 0.1), scene_hoop(1, 1, 2), scene_chain(c(1, 1), 1, 0)
  )
  for (scene in scenes) {
    motion <- trajectory(scene, 0:3)
    expect_identical(glance(motion)$error, 0)
    expect_lt(glance(motion)$steps, 1000)
    rates <- grep("omega|v_m_per_s", names(motion), value = TRUE)
    expect_true(all(unlist(unclass(motion)[rates]) == 0))
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
  # Past a turning point an overdamped motion fades without events.
  slow <- trajectory(scene_pendulum(body_point(1), 1, resistance(10, 0.1), theta0_rad = 1), 200)
  expect_identical(nrow(motion_events(slow)), 0L)
})

test_that("the torques of a row that breaks loose are those that accelerate it", {
  laws <- list(
    0.5, -0.5, torque_sinusoid(0.5, 1), function(time_s) -0.5 * cos(time_s), torque_spring(0.5, 1)
  )
  for (law in laws) {
    rows <- trajectory(scene_axle(2, law, resistance(coulomb_n_m = 0.2)), c(0, 1e-6))
    expect_equal(rows$net_torque_n_m[1], 2 * rows$omega_rad_per_s[2] / 1e-6, tolerance = 1e-5)
    expect_equal(abs(rows$damping_torque_n_m[1]), 0.2, tolerance = 1e-12)
  }
})

test_that("slow motions where terms cancel: solved, with the rounding of the terms in the figure", {
  # Taylor series of 40 digits (mpmath 1.3.0): 9.80665 sin(0.5) N m, rounded, against gravity.
  last <- c("1e-6" = -4.8721552238711864e-7, "1e-9" = -4.8721544059130996e-10)
  for (start in names(last)) {
    scene <- scene_axle(
      1, torque_gravity(2, 0.5) + 4.7015584581529071, theta0_rad = 0.5,
      omega0_rad_per_s = as.numeric(start)
    )
    expect_warning(motion <- trajectory(scene, c(0, 5, 10)), class = "rotdyn_warning_accuracy")
    off <- abs(motion$omega_rad_per_s[3] - last[[start]])
    figure <- glance(motion)$error * as.numeric(start)
    expect_lt(off, figure)
    # The terms are rounded by 4e-16 N m each.
    expect_lt(figure, 1e-14)
    expect_lt(trajectory_run(motion)$info$rhs_calls, 1e5)
  }
})
