g <- 9.80665

test_that("a spool: towards the pull, at rest, away, slipping, lifted", {
  # r/R = 1/2: critical at 60 degrees. a = T (cos - 1/2)/(m 1.5).
  spool <- function(...) spool_pull(body_disk(2, 0.1), inner_radius_m = 0.05, ...)
  x <- spool(6, c(0, 60, 90))
  expect_equal(x$acceleration_m_per_s2, 6 * c(0.5, 0, -0.5) / 3)
  expect_identical(x$motion, c("rolls towards the pull", "stays", "rolls away"))
  expect_equal(x$critical_angle_deg, rep(60, 3))
  # f = -T (cos/2 + 1/2)/1.5; N = m g - T sin.
  expect_equal(x$friction_force_n, -6 * c(1, 0.75, 0.5) / 1.5)
  expect_equal(x$normal_n, 2 * g - 6 * c(0, sqrt(0.75), 1))
  expect_equal(x$alpha_rad_per_s2, x$acceleration_m_per_s2 / 0.1)
  # With friction 0.1 at 0 degrees: f = -0.1 m g; a = (T + f)/m; I alpha = -f R - T r.
  slips <- spool(6, 0, friction = 0.1)
  expect_identical(slips$motion, "slips")
  expect_equal(slips$acceleration_m_per_s2, (6 - 0.2 * g) / 2)
  expect_equal(slips$alpha_rad_per_s2, (0.2 * g * 0.1 - 6 * 0.05) / 0.01)
  # The friction needed is where it begins.
  needed <- spool(6, 0)$friction_needed
  expect_identical(spool(6, 0, friction = needed * (1 - 1e-12))$motion, "slips")
  expect_identical(spool(6, 0, friction = needed)$motion, "rolls towards the pull")
  up <- spool(30, 80)
  expect_identical(up$motion, "lifts")
  expect_equal(c(up$normal_n, up$friction_force_n), c(0, 0))
  expect_identical(is.na(spool(c(1, NA), 0)$acceleration_m_per_s2), c(FALSE, TRUE))
})

test_that("Newton's laws hold for any spool", {
  set.seed(5)
  n <- 200
  t <- runif(n, 0, 40)
  angle <- runif(n, 0, 90)
  m <- runif(n, 0.5, 5)
  outer <- runif(n, 0.1, 1)
  inner <- outer * runif(n, 0.05, 0.95)
  beta <- runif(n, 0.1, 1)
  mu <- runif(n, 0, 1)
  bodies <- Map(function(m, r, b) body_tensor(m, diag(3) * b * m * r^2), m, outer, beta)
  x <- spool_pull(bodies, t, angle, inner, mu, radius_m = outer)
  rad <- angle * pi / 180
  expect_equal(m * x$acceleration_m_per_s2, t * cos(rad) + x$friction_force_n)
  down <- x$motion != "lifts"
  expect_equal((x$normal_n + t * sin(rad))[down], (m * g)[down])
  expect_equal(
    beta * m * outer^2 * x$alpha_rad_per_s2, -(x$friction_force_n * outer + t * inner)
  )
  expect_true(all(abs(x$friction_force_n) <= mu * x$normal_n * (1 + 1e-12)))
  # What slips moves over the floor against its friction.
  slide <- x$acceleration_m_per_s2 - outer * x$alpha_rad_per_s2
  expect_true(all(slide[x$motion == "slips"] > 0))
  rolls <- startsWith(x$motion, "rolls")
  expect_lt(max(abs(slide[rolls])), 1e-12 * max(abs(x$acceleration_m_per_s2)))
  expect_setequal(
    x$motion, c("rolls towards the pull", "rolls away", "slips", "lifts")
  )
})

test_that("a yo-yo falls as its inertia lets it", {
  # beta (R/r)^2 = 0.5 9 = 4.5.
  x <- yo_yo(body_disk(0.2, 0.03), 0.01)
  expect_equal(x$acceleration_m_per_s2, g / 5.5)
  expect_equal(x$tension_n, 0.2 * (g - g / 5.5))
  expect_equal(x$alpha_rad_per_s2, g / 5.5 / 0.01)
  # Almost all of its mass at the axis.
  light <- body_tensor(1, 1e-20 * diag(3))
  expect_within(yo_yo(light, 1, radius_m = 1)$tension_n, g * 1e-20, 1e-14)
  # beta (R/r)^2 is I/(m r^2), whatever outer radius is named.
  expect_equal(yo_yo(light, 1, radius_m = 3)$tension_n, g * 1e-20)
})

test_that("Atwood's machine, with the pulley's inertia and its bearing", {
  x <- atwood_machine(3, 2, body_disk(10, 0.1), bearing_torque_n_m = c(0, 0.2, 0.981, 1))
  # (g - 10 tau)/(5 + 5), and at rest where 10 tau >= g.
  expect_equal(x$acceleration_m_per_s2, c(g, g - 2, 0, 0) / 10)
  expect_identical(x$motion, c("1 goes down", "1 goes down", "stays", "stays"))
  expect_equal(x$tension_1_n, 3 * (g - x$acceleration_m_per_s2))
  # The tensions turn the pulley against its bearing: (T1 - T2) r - tau = I a/r.
  expect_equal(
    ((x$tension_1_n - x$tension_2_n) * 0.1 - c(0, 0.2))[1:2],
    (0.05 * x$acceleration_m_per_s2 / 0.1)[1:2]
  )
  swapped <- atwood_machine(2, 3, body_disk(10, 0.1), 0.2)
  expect_equal(swapped$acceleration_m_per_s2, -x$acceleration_m_per_s2[2])
  expect_identical(swapped$motion, "2 goes down")
  # The scene's motion is the same.
  scene <- scene_hanging_mass(0.05, 3, 0.1, resistance(coulomb_n_m = 0.2), counter_mass_kg = 2)
  expect_equal(
    trajectory(scene, 1)$omega_rad_per_s * 0.1, x$acceleration_m_per_s2[2], tolerance = 1e-12
  )
})

test_that("a string that hardly holds the heavier mass has all digits of its tension", {
  # m1 (2 m2 + I/r^2) g/(m1 + m2 + I/r^2), where m1 (g - a) is 0.
  x <- atwood_machine(c(1, 1e-20), c(1e-20, 1), body_tensor(1, 1e-18 * diag(3)), radius_m = 1)
  expect_within(x$tension_1_n[1], 1.02e-18 * g, 1e-14)
  expect_within(x$tension_2_n[2], 1.02e-18 * g, 1e-14)
  expect_within(x$tension_2_n[1], 2e-20 * g, 1e-14)
  # With a bearing that resists, whichever is the heavier.
  x <- atwood_machine(c(1, 1e-9), c(1e-9, 1), body_disk(2e-9, 0.1), 1e-10)
  expect_within(x$tension_1_n[1], (3e-9 * g + 1e-9) / (1 + 2e-9), 1e-14)
  expect_within(x$tension_2_n[2], x$tension_1_n[1], 1e-14)
})

test_that("a falling rod: rates, hinge, tip, and where a chimney breaks", {
  x <- falling_rod(body_rod(1000, 20), c(0, 30, 90), start_angle_deg = 0)
  drop <- 1 - c(1, sqrt(0.75), 0)
  expect_equal(x$omega_rad_per_s^2, 3 * g / 20 * drop)
  expect_equal(x$alpha_rad_per_s2, 1.5 * g / 20 * c(0, 0.5, 1))
  # Flat: the tip has 1.5 g down and 3 g towards the hinge.
  expect_equal(x$tip_fall_m_per_s2[3], 1.5 * g)
  expect_equal(x$tip_acceleration_m_per_s2[3], g * sqrt(1.5^2 + 9))
  expect_equal(x$hinge_along_n[3], -1.5 * 1000 * g)
  expect_equal(x$hinge_across_n[3], 250 * g)
  # Before: of its height 20 cos(angle) twice the derivative by time.
  angle <- pi / 6
  expect_equal(
    x$tip_fall_m_per_s2[2],
    20 * (x$alpha_rad_per_s2[2] * sin(angle) + x$omega_rad_per_s[2]^2 * cos(angle))
  )
  # The rod pulls at its hinge beyond cos = 3/5.
  push <- falling_rod(body_rod_end(1, 1), acos(0.6) * 180 / pi + c(-1e-6, 1e-6))$hinge_along_n
  expect_true(push[1] > 0 && push[2] < 0)
  # The moment at x, from the weight above x and its acceleration.
  moment <- function(at, angle) {
    alpha <- 1.5 * g / 20 * sin(angle)
    above <- function(f) stats::integrate(f, at, 20, rel.tol = 1e-10)$value
    above(function(s) 50 * (g * sin(angle) - alpha * s) * (s - at))
  }
  size <- function(at) abs(moment(at, pi / 6))
  worst <- stats::optimize(size, c(0, 20), maximum = TRUE, tol = 1e-6)
  expect_equal(worst$maximum, x$break_at_m[2], tolerance = 1e-5)
  expect_equal(worst$objective, x$bending_moment_n_m[2], tolerance = 1e-9)
  # Started late it is slower; a pendulum's energy: 1/6 m l^2 omega^2 = m g l/2 drop.
  late <- falling_rod(body_rod(3, 2), 90, start_angle_deg = 30)
  expect_equal(late$omega_rad_per_s^2 * 4 / 6, g * sqrt(0.75))
  # A start nearly where it is now keeps its digits: omega^2 = (3 g/l) sin(theta) d.
  close <- falling_rod(body_rod(3, 2), 45 + 1e-9, start_angle_deg = 45)
  step <- ((45 + 1e-9) - 45) * pi / 180
  expect_within(close$omega_rad_per_s^2, 1.5 * g * sin(pi / 4) * step, 1e-9)
})

test_that("textbook: rods and cords", {
  rows <- published("openstax_rotation")
  is <- function(id, got) expect_published(got, rows[[id]])
  flat <- falling_rod(body_rod(1, 1), 90, start_angle_deg = 90, gravity_m_per_s2 = 9.8)
  is("UP10-50", flat$tip_fall_m_per_s2)
  hinged <- falling_rod(body_rod(1, 2), 90, start_angle_deg = 30, gravity_m_per_s2 = 9.8)
  is("UP10-35", hinged$omega_rad_per_s * 2)
  weight <- scene_hanging_mass(6, 40 / 9.8, 0.25, gravity_m_per_s2 = 9.8)
  fallen <- time_when(weight, theta_rad = 5 / 0.25)
  is("UP10-72", trajectory(weight, fallen$time_s[1])$omega_rad_per_s)
  # A block on a rough incline turns a pulley: its pull is a torque, its mass an inertia.
  pulley <- moment_of_inertia(body_disk(1, 0.5), "z") + 3 * 0.5^2
  pull <- 3 * 9.8 * (sinpi(45 / 180) - 0.4 * cospi(45 / 180))
  is("UP10-49", trajectory(scene_axle(pulley, torque_of_force(pull, 0.5)), 1)$omega_rad_per_s * 0.5)
})

test_that("errors and columns", {
  disk <- body_disk(1, 1)
  rod <- body_rod(1, 1)
  expect_error(spool_pull(disk, 1, 91, 0.5), class = "rotdyn_error_value")
  expect_error(spool_pull(disk, 1, 0, 1), class = "rotdyn_error_value")
  expect_error(spool_pull(disk, 1, 0), class = "rotdyn_error_missing")
  expect_error(yo_yo(disk, 0), class = "rotdyn_error_value")
  expect_error(yo_yo(1, 1), class = "rotdyn_error_type")
  expect_error(yo_yo(body_box(1, 1, 1, 1), 1), class = "rotdyn_error_missing")
  expect_error(atwood_machine(1:2, 1:3, disk), class = "rotdyn_error_size")
  expect_error(falling_rod(rod, 10, start_angle_deg = 20), class = "rotdyn_error_value")
  expect_error(falling_rod(rod, 10, end_deg = 20), class = "rotdyn_error_argument")
  expect_error(falling_rod(disk, 10), class = "rotdyn_error_value")
  known <- column_table()$name
  for (table in list(
    spool_pull(disk, 1, 0, 0.5), yo_yo(disk, 1), atwood_machine(1, 1, disk), falling_rod(rod, 1)
  )) expect_identical(setdiff(names(table), known), character())
})
