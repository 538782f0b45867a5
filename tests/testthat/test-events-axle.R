test_that("a pendulum turns and passes on time, and rotates", {
  scene <- scene_pendulum(body_point(1), 0.5, theta0_rad = 2)
  cycle <- period_of(scene)$period_s
  events <- motion_events(trajectory(scene, seq(0, 1.1 * cycle, length.out = 5)))
  expect_equal(events$event, c("passage", "turn", "passage", "turn"))
  expect_equal(events$time_s, cycle * 1:4 / 4, tolerance = 1e-14)
  round <- scene_pendulum(body_point(1), 0.5, omega0_rad_per_s = -20)
  turn <- period_of(round)$period_s
  events <- motion_events(trajectory(round, c(0, 3.5 * turn)))
  expect_equal(events$event, rep("passage", 3))
  expect_equal(events$time_s, turn * 1:3, tolerance = 1e-14)
  # Gravity that pulls up.
  up <- scene_pendulum(body_point(1), 0.5, theta0_rad = 3, gravity_m_per_s2 = -9.80665)
  expect_equal(motion_events(trajectory(up, c(0, 1)))$time_s[1], period_of(up)$period_s / 4,
    tolerance = 1e-14)
})

test_that("an oscillator with dry friction: each event once", {
  scene <- scene_axle(1, torque_spring(4), resistance(coulomb_n_m = 0.4), theta0_rad = 1)
  events <- motion_events(trajectory(scene, seq(0, 10, 0.5)))
  # It loses 0.2 rad in each half cycle, and stops within 0.1 rad of the rest angle.
  reversals <- events$time_s[events$event %in% c("turn", "reverse", "stick")]
  expect_equal(reversals[1:4], pi / 2 * 1:4, tolerance = 1e-8)
  expect_false(anyDuplicated(round(events$time_s, 6)) > 0)
  expect_equal(nrow(motion_events(spin_up())), 0)
})

test_that("a rest that is shorter than a step is seen", {
  # Held from 2.953 s to 2.962 s: without it theta is off by 1.3e-4 rad.
  law <- torque_sinusoid(3.3979681113192317, 8.1864170738232342, -0.57490322878584266)
  scene <- scene_axle(
    4.5551598152522024, law,
    resistance(
      0.058464101256388359, 0.11297830738435297, coulomb_n_m = 0.28374935444118837,
      static_n_m = 0.36439491427066589
    ),
    theta0_rad = -0.70595936290919781, omega0_rad_per_s = 0.23590100905848863
  )
  exact <- trajectory(scene, c(0, 4.8), 1e-12)
  for (accuracy in 10^-(3:8)) {
    motion <- trajectory(scene, c(0, 4.8), accuracy)
    expect_identical(motion_events(motion)$event[1:2], c("stick", "slip"))
    expect_lte(abs(diff(c(motion$theta_rad[2], exact$theta_rad[2]))), accuracy)
  }
})

test_that("potential and kinetic energy add up", {
  scene <- scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 2, omega0_rad_per_s = 1)
  full <- augment(trajectory(scene, seq(0, 3, 0.25)))
  energy <- full$rotational_kinetic_energy_j + full$potential_energy_j
  # m g d (1 - cos 2) + I/2, I = m l^2/3: by hand.
  expect_equal(energy, rep(0.1 * 9.80665 * 0.5 * (1 - cos(2)) + 0.1 / 6, 13), tolerance = 1e-14)
  expect_equal(full$work_j, full$potential_energy_j[1] - full$potential_energy_j,
    tolerance = 1e-12)
  spring <- scene_axle(2, torque_spring(8, rest_rad = 0.5), theta0_rad = 1)
  expect_equal(augment(trajectory(spring, 0))$potential_energy_j, 1)
  expect_null(augment(spin_up())[["potential_energy_j"]])
})

test_that("an audit has the potential energy as a change", {
  energy <- function(scene, time_s) {
    a <- audit(trajectory(scene, time_s))
    expect_equal(a$verdict, rep("balanced", nrow(a)))
    terms <- a$terms[[1]]
    stats::setNames(terms$value, terms$term)
  }
  # mpmath: at K(sin^2 1) sqrt(I/(m g d)) the pendulum let go at 2 rad passes the lowest point; all
  # of m g d (1 - cos 2) is kinetic.
  scene <- scene_pendulum(body_point(1), 0.5, theta0_rad = 2)
  got <- energy(scene, c(0, period_of(scene)$period_s / 4))
  fallen <- 9.80665 * 0.5 * (1 - cos(2))
  expect_equal(got[["change of potential energy"]], -fallen, tolerance = 1e-14)
  expect_equal(got[["change of kinetic energy"]], fallen, tolerance = 1e-14)
  expect_identical(got[["work of the torque"]], 0)
  # A spring wound up by a constant torque of 3 N m, without resistance: back at the start after
  # a cycle, twice the static angle at half of it. By hand.
  wound <- scene_axle(2, torque_spring(8) + 3)
  got <- energy(wound, c(0, pi / 2))
  expect_equal(got[["change of potential energy"]], 0.5 * 8 * 0.75^2, tolerance = 1e-14)
  expect_equal(got[["work of the torque"]], 3 * 0.75, tolerance = 1e-14)
  expect_equal(got[["change of kinetic energy"]], 0, tolerance = 1e-13)
  # An edited row shows.
  x <- trajectory(scene, c(0, 0.2, 0.4))
  x$theta_rad[3] <- x$theta_rad[3] * (1 + 1e-9)
  expect_equal(audit(x)$verdict[1], "unbalanced")
  # A small change of a large energy, and a body that went round many times.
  up <- scene_axle(1, torque_gravity(1, 1e6), theta0_rad = 3.1, omega0_rad_per_s = 5e3)
  energy(up, c(0, 1e-7))
  energy(up, c(0, 10))
})

test_that("late in time a passage just before a stop is an event of its own", {
  # theta = 0.1 + (0.1 + d) cos(2 t), which passes 0 and stops at -d.
  d <- 1e-8
  scene <- scene_axle(
    1, torque_spring(4), resistance(coulomb_n_m = 0.4), theta0_rad = 0.2 + d, start_s = 1e6
  )
  events <- motion_events(trajectory(scene, 1e6 + 0:3))
  expect_equal(events$event, c("passage", "stick"))
  want <- c(acos(-0.1 / (0.1 + d)), pi) / 2
  expect_equal(events$time_s - 1e6, want, tolerance = 1e-8)
})

test_that("what reverses does so whatever the model", {
  reversals <- function(model, resistance) {
    scene <- scene_axle(1, -1, resistance, omega0_rad_per_s = 1)
    motion_events(trajectory(scene, 0:4, model = model))$event
  }
  for (model in c("axle_linear", "axle_drag", "axle_bands", "axle_rk8pd", "axle_radau")) {
    expect_identical(reversals(model, NULL), character(), info = model)
    expect_identical(reversals(model, resistance(0.1)), character(), info = model)
  }
  for (model in c("axle_drag", "axle_bands", "axle_rk8pd", "axle_radau")) {
    expect_identical(reversals(model, resistance(coulomb_n_m = 0.1)), "reverse", info = model)
  }
})
