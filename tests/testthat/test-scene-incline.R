test_that("the radius is that of the body", {
  expect_equal(scene_incline(body_sphere(6, 0.11), 0)$radius_m, 0.11)
  expect_equal(scene_incline(body_disk(2, 0.25), 0)$radius_m, 0.25)
  expect_error(
    scene_incline(body_tensor(1, c(1, 1, 1)), 0), class = "rotdyn_error_missing"
  )
  expect_error(
    scene_incline(body_sphere(1, 1e-10), 10, v0_m_per_s = 1e300), class = "rotdyn_error_value"
  )
  # A yo-yo on its shaft: beta is 50.
  wheel <- scene_incline(body_disk(2, 0.25), 90, radius_m = 0.025)
  expect_equal(wheel$moment_of_inertia_kg_m2 / 2 / 0.025^2, 50)
})

test_that("a start without omega rolls", {
  scene <- scene_incline(body_hoop(1, 0.3), 10, v0_m_per_s = 0.9)
  expect_equal(scene$omega0_rad_per_s, 3)
  motion <- trajectory(scene, 0:2)
  expect_true(all(motion$rolling))
  expect_identical(nrow(motion_events(motion)), 0L)
})

test_that("bad scenes are refused by the user's call", {
  ball <- body_sphere(1, 0.1)
  bad <- function(...) scene_incline(ball, ...)
  expect_error(scene_incline(), class = "rotdyn_error_missing")
  expect_error(scene_incline(2, 10), class = "rotdyn_error_type")
  for (angle in list(91, -91, NA_real_, NaN, Inf)) {
    expect_error(bad(angle), class = "rotdyn_error_value")
  }
  expect_error(bad("steep"), class = "rotdyn_error_type")
  expect_error(bad(10, static_friction = -0.1), class = "rotdyn_error_value")
  expect_error(bad(10, static_friction = NaN), class = "rotdyn_error_value")
  expect_error(bad(10, static_friction = 0.1, kinetic_friction = 0.2), class = "rotdyn_error_value")
  expect_error(bad(10, static_friction = 0.1, kinetic_friction = Inf), class = "rotdyn_error_value")
  expect_error(bad(10, rolling_arm_m = -1), class = "rotdyn_error_value")
  expect_error(bad(10, gravity_m_per_s2 = -9.8), class = "rotdyn_error_value")
  expect_error(bad(10, radius_m = 0), class = "rotdyn_error_value")
  expect_error(bad(10, friction = 1), class = "rotdyn_error_argument")
  # (2 + 0.4 x 0)/1.4 = 1.428571
  expect_error(bad(10, v0_m_per_s = 2, omega0_rad_per_s = 0), "1.428571",
    class = "rotdyn_error_value")
})

test_that("the print tells the scene", {
  expect_output(print(scene_incline(body_hoop(1, 0.3), 60)), "rolling needs 0.866")
})

test_that("the critical angle is the reverse of the friction needed", {
  # 45 degrees: mu (1 + beta)/beta = 1; University Physics 10-11: 60 degrees and 0.866 for a hoop.
  expect_ulps(rolling_critical_angle(1, 0.5), 45, 1)
  expect_equal(rolling_critical_angle(c(1, 0.5), c(0.8660254037844386, 0.5773502691896257)),
    c(60, 60), tolerance = 1e-14)
  expect_identical(rolling_critical_angle(c(0, 0.4), c(0.1, Inf)), c(90, 90))
  expect_ulps(rolling_critical_angle(Inf, 1), 45, 1)
  expect_identical(rolling_critical_angle(NA, 1), NA_real_)
  expect_error(rolling_critical_angle(-1, 1), class = "rotdyn_error_value")
  expect_error(rolling_critical_angle(1), class = "rotdyn_error_missing")
  expect_error(rolling_critical_angle("a", 1), class = "rotdyn_error_value")
})

test_that("the friction that a scene needs, and what it does without it", {
  # University Physics, example 11.1: a hoop on 60 degrees needs 0.87; with 0.5 it slides:
  # a = g (sin 60 - 0.5 cos 60), alpha = 0.5 g cos 60/R
  hoop <- friction_needed(scene_incline(
    body_hoop(1, 0.3), 60, static_friction = 0.5, gravity_m_per_s2 = 9.8
  ))
  expect_equal(hoop$friction_needed, sqrt(3) / 2, tolerance = 1e-15)
  expect_identical(hoop$from_rest, "slides")
  expect_equal(hoop$critical_angle_deg, 45, tolerance = 1e-15)
  expect_equal(hoop$acceleration_m_per_s2, 9.8 * (sqrt(3) / 2 - 0.25), tolerance = 1e-15)
  expect_equal(hoop$alpha_rad_per_s2, 0.5 * 9.8 * 0.5 / 0.3, tolerance = 1e-15)
  # A body exactly at its critical angle rolls, a little beyond it slides.
  for (mu in c(0.1, 0.3, 0.7, 2)) {
    angle <- rolling_critical_angle(0.4, mu)
    at <- function(angle) {
      friction_needed(scene_incline(body_sphere(1, 0.1), angle, static_friction = mu))$from_rest
    }
    expect_identical(
      c(at(angle), at(-angle), at(angle * (1 + 1e-13))), c("rolls", "rolls", "slides")
    )
  }
  # With an arm b: (beta tan + b/R)/(1 + beta), and the angle where that is mu.
  arm <- scene_incline(body_sphere(1, 0.1), 20, static_friction = 0.3, rolling_arm_m = 0.005)
  needs <- friction_needed(arm)
  expect_equal(needs$friction_needed, (0.4 * tan(pi / 9) + 0.05) / 1.4, tolerance = 1e-14)
  expect_equal(needs$critical_angle_deg, atan((0.3 * 1.4 - 0.05) / 0.4) * 180 / pi,
    tolerance = 1e-14)
  at <- function(angle) {
    friction_needed(scene_incline(
      body_sphere(1, 0.1), angle, static_friction = 0.3, rolling_arm_m = 0.005
    ))$from_rest
  }
  critical <- needs$critical_angle_deg
  expect_identical(at(critical * (1 - 1e-12)), "rolls")
  expect_identical(at(critical * (1 + 1e-12)), "slides")
  expect_identical(at(2), "rests") # tan 2 degrees = 0.035 is less than b/R
  expect_identical(friction_needed(scene_incline(body_hoop(1, 1), 0))$from_rest, "rests")
  expect_identical(friction_needed(scene_incline(body_hoop(1, 1), 90))$friction_needed, Inf)
  expect_setequal(setdiff(names(hoop), column_table()$name), character())
  expect_error(friction_needed(), class = "rotdyn_error_missing")
  expect_error(friction_needed(scene_axle(1)), class = "rotdyn_error_type")
  expect_error(friction_needed(scene_incline(body_hoop(1, 1), 9,
    resistance = resistance(drag_n_s_per_m = 1))),
    class = "rotdyn_error_value")
})

test_that("a gravity that has lost digits is refused: its motion was 8e-14 off", {
  ball <- body_sphere(1, 0.1)
  expect_error(
    scene_incline(ball, 10, gravity_m_per_s2 = 1e-310), "have all their digits",
    class = "rotdyn_error_value"
  )
  expect_error(
    scene_incline(body_sphere(1e-10, 0.1), 10, gravity_m_per_s2 = 1e-300),
    "have all their digits", class = "rotdyn_error_value"
  )
  # The smallest that is taken, against gravity 2^200 times as large.
  near <- trajectory(scene_incline(ball, 10, gravity_m_per_s2 = 2^-1000), c(0, 2^990))
  far <- trajectory(scene_incline(ball, 10, gravity_m_per_s2 = 2^-800), c(0, 2^890))
  expect_equal(near$x_m[2] / far$x_m[2], 1, tolerance = 1e-14)
  expect_identical(audit(near)$verdict, rep("balanced", 3))
})

test_that("a start that rolls is said where a body could slip", {
  ball <- body_sphere(6, 0.11)
  start <- function(...) scene_incline(ball, 0, v0_m_per_s = 7, ...)
  expect_message(
    start(static_friction = 0.1), "rolls from the start", class = "rotdyn_message_start"
  )
  expect_no_message(start())
  expect_no_message(start(static_friction = 0.1, omega0_rad_per_s = NULL))
  expect_no_message(start(static_friction = 0.1, omega0_rad_per_s = 0))
  expect_no_message(scene_incline(ball, 20, static_friction = 0.1))
})

test_that("a radius is the body's own where beta agrees to nine digits, else that of beta", {
  body <- list(beta = 0.5, mass_kg = 2, size_m = c(radius_m = 0.3), shape = "x")
  radius <- function(r) rotdyn:::rolling_radius(body, 0.5 * 2 * r^2, NULL)
  expect_identical(radius(0.3 * (1 + 1e-10)), 0.3)
  expect_equal(radius(0.3 * (1 + 1e-7)), 0.3 * (1 + 1e-7), tolerance = 1e-14)
  expect_equal(radius(0.2), 0.2, tolerance = 1e-14)
})

test_that("a critical angle of what is missing is missing", {
  expect_identical(
    rolling_critical_angle(c(NA, 1, NA), c(0.5, NA, NA)), rep(NA_real_, 3)
  )
  # Also beside a body that never slides, or friction that always holds: 90 degrees.
  found <- rolling_critical_angle(c(NaN, 1, NA, 0), c(0.5, NaN, Inf, NA))
  expect_true(identical(found, rep(NA_real_, 4))) # NA, which expect_identical() takes NaN for
})

test_that("a short step at the start of a narrow change of the force counts in the error", {
  # One equation, M v' = force(x): time and speed by quadrature (bench/coverage/narrow.R).
  force <- function(time_s, x_m, v_m_per_s) {
    x <- (x_m - 0.7817807942237649) / 0.00048590010021773249
    8.5844745627178991 + 1.0388291619305179 *
      sin(5.9305652111070231 * x_m / (1.1105295455788777 * 0.85624484609245577)) +
      ifelse(abs(x) < 1, 21.515330956746972 * (1 + cos(pi * x)) / 2, 0)
  }
  scene <- scene_incline(
    body_sphere(9.8140794524494286 / 1.4, 0.1), 0, static_friction = 1e6, kinetic_friction = 1e6,
    v0_m_per_s = 1.1105295455788777, force = force
  )
  motion <- trajectory(
    scene, c(0, 0.85624484609245577), 1e-11, "incline_radau", resolution = 1 / 2000
  )
  off <- abs(motion$v_m_per_s[2] / 1.8758410207619349 - 1)
  expect_lte(off, summary(motion)$error)
})
