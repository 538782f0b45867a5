test_that("the quadrature agrees with the closed form of the linear ledger", {
  motion <- trajectory(article_scene(), c(0, 0.3, 2, 5, 8))
  whole <- audited(motion)
  rows <- augment(motion)
  last <- nrow(rows)
  expect_equal(rows$work_j[last], whole$work_j, tolerance = 1e-14)
  expect_equal(rows$dissipated_j[last], whole$dissipated_j, tolerance = 1e-14)
  expect_equal(rows$torque_impulse_n_m_s[last], whole$torque_impulse_n_m_s, tolerance = 1e-14)
  expect_equal(rows$damping_impulse_n_m_s[last], whole$damping_impulse_n_m_s, tolerance = 1e-14)
  expect_equal(rows$dissipated_viscous_j, rows$dissipated_j, tolerance = 0)
  expect_equal(rows$work_j[1], 0)
  # Row by row: what came in less what went out is the kinetic energy.
  expect_equal(rows$work_j - rows$dissipated_j, rows$rotational_kinetic_energy_j, tolerance = 1e-14)
  expect_equal(rows$power_w, rows$applied_torque_n_m * rows$omega_rad_per_s, tolerance = 0)
})

test_that("a sinusoid on a free axle does the work it should", {
  # omega = A/(I Omega) sin(Omega t); the work is the kinetic energy, the impulse the momentum.
  motion <- trajectory(scene_axle(4, torque_sinusoid(2, 3)), c(0, 0.4, 1, 7))
  speed <- 2 / (4 * 3) * sin(3 * motion$time_s)
  rows <- augment(motion)
  expect_equal(rows$work_j, 0.5 * 4 * speed^2, tolerance = 1e-13)
  expect_equal(rows$torque_impulse_n_m_s, 4 * speed, tolerance = 1e-13)
  expect_equal(rows$dissipated_j, rep(0, 4))
  expect_equal(audited(motion)$verdict, "balanced")
})

test_that("the parts of a loss are what each resistance took", {
  # Constant speed: torque = c w + q w^2 + tau_c at w = 5, so the shares are c w^2 t and so on.
  wheel <- scene_axle(
    2, 0.3 * 5 + 0.02 * 25 + 0.4, resistance(0.3, 0.02, 0.4),
    omega0_rad_per_s = 5
  )
  whole <- audited(trajectory(wheel, c(0, 10)))
  expect_equal(whole$dissipated_viscous_j, 0.3 * 25 * 10, tolerance = 1e-13)
  expect_equal(whole$dissipated_quadratic_j, 0.02 * 125 * 10, tolerance = 1e-13)
  expect_equal(whole$dissipated_coulomb_j, 0.4 * 5 * 10, tolerance = 1e-13)
  expect_equal(whole$work_j, (0.3 * 5 + 0.02 * 25 + 0.4) * 5 * 10, tolerance = 1e-13)
  expect_equal(whole$verdict, "balanced")
})

test_that("a wheel that stops gives all its energy to friction, and friction then holds it", {
  wheel <- scene_axle(
    2, torque_steps(c(0, 100), c(0, 0.3)), resistance(coulomb_n_m = 0.5),
    omega0_rad_per_s = 10
  )
  # Stops after I w/tau = 40 s, 200 rad; then 0.3 N m for 10 s is balanced.
  motion <- trajectory(wheel, c(0, 50, 110))
  expect_equal(motion$theta_rad, c(0, 200, 200), tolerance = 1e-15)
  expect_equal(motion$damping_torque_n_m, c(-0.5, 0, -0.3))
  expect_equal(motion$net_torque_n_m[2:3], c(0, 0))
  whole <- audited(motion)
  expect_equal(whole$dissipated_coulomb_j, 100, tolerance = 1e-13)
  expect_equal(whole$torque_impulse_n_m_s, 3, tolerance = 1e-13)
  expect_equal(whole$damping_impulse_n_m_s, -20 - 3, tolerance = 1e-13)
  expect_equal(whole$verdict, "balanced")
  expect_equal(as.data.frame(motion_events(motion)), data.frame(time_s = 40, event = "stick"))
})

test_that("the skater's arms do the work that her energy gains", {
  skater <- scene_axle(inertia_knots(c(1, 2), c(5, 2)), omega0_rad_per_s = 2)
  motion <- trajectory(skater, c(0, 1.5, 3))
  expect_equal(motion$omega_rad_per_s, c(2, 10 / 3.5, 5), tolerance = 1e-15)
  expect_equal(motion$moment_of_inertia_kg_m2, c(5, 3.5, 2))
  expect_equal(motion$angular_momentum_kg_m2_per_s, rep(10, 3), tolerance = 1e-15)
  # The angle over the ramp: L/(dI) log(I0/I1), over one second.
  expect_equal(motion$theta_rad[3], 2 + 10 / 3 * log(5 / 2) + 5, tolerance = 1e-15)
  whole <- audited(motion)
  expect_equal(whole$inertia_work_j, 0.5 * 100 * (1 / 2 - 1 / 5), tolerance = 1e-13)
  expect_equal(whole$work_j, 0)
  expect_equal(whole$verdict, "balanced")
})

test_that("rows out of order, one row and none", {
  motion <- trajectory(article_scene(), 0:3)
  expect_error(augment(motion[3:1, ]), class = "rotdyn_error_time")
  expect_equal(augment(motion[2, ])$work_j, 0)
  expect_equal(nrow(augment(motion[0, ])), 0L)
  expect_equal(augment(trajectory(article_scene(), c(1, 1, 2)))$work_j[2], 0)
})

test_that("a kink of a torque-speed curve next to a row is seen", {
  # omega = 2 + t up to the point at 3 rad/s: the kink comes at t = 1, a thousandth after a row.
  curve <- torque_curve(c(-10, 3, 4), c(1, 1, -2))
  m <- trajectory(scene_axle(1, curve, omega0_rad_per_s = 2), c(0, 0.999, 2))
  expect_equal(run_of(m)$model, "axle_bands")
  a <- audited(m)
  expect_equal(a$verdict, "balanced")
  # After it omega = 3 + (1 - exp(-3 s))/3.
  expect_equal(a$torque_impulse_n_m_s, 1 + (1 - exp(-3)) / 3, tolerance = 1e-14)
  g <- augment(m)
  expect_equal(g$torque_impulse_n_m_s[3], 1 + (1 - exp(-3)) / 3, tolerance = 1e-14)
})

# By hand: the impulse J = 0.5 passes; with I = 1, c = 10, rate 2 the heat is c int omega^2 with
# omega = (exp(-2 t) - exp(-10 t))/8: 10/64 (1/4 - 2/12 + 1/20) = 1/48.
test_that("a transient in a long span is not missed", {
  x <- trajectory(scene_axle(1, torque_exponential(1, 2), resistance(10)), c(0, 1e5))
  a <- audited(x)
  expect_equal(a$work_j, 1 / 48, tolerance = 1e-12)
  expect_equal(a$dissipated_j, 1 / 48, tolerance = 1e-12)
  expect_equal(a$verdict, "balanced")
  expect_equal(augment(x)$work_j, c(0, 1 / 48), tolerance = 1e-12)
  # The work of the pulse is taken from a short span, where nothing can be missed.
  scene <- scene_axle(1, torque_steps(c(0, 1, 2), c(0, 5, 0)), resistance(0.1, 0.01))
  short <- audited(trajectory(scene, c(0, 2)))
  long <- audited(trajectory(scene, c(0, 1e5)))
  expect_equal(long$work_j, short$work_j, tolerance = 1e-12)
  expect_equal(long$dissipated_j, long$work_j, tolerance = 1e-9)
  expect_equal(long$verdict, "balanced")
})

test_that("transients are found wherever they begin, in whichever model", {
  pulse <- function(at) torque_steps(c(0, at, at + 1), c(0, 5, 0))
  scenes <- list(
    scene_axle(2, pulse(7e4), resistance(3, 0.1), omega0_rad_per_s = 4),
    scene_axle(2, pulse(7e4), resistance(3, 0.1, 0.2), omega0_rad_per_s = 4),
    scene_axle(2, pulse(7e4) + torque_exponential(2, 30, from_s = 9e4), resistance(3)),
    scene_axle(2, pulse(7e4) + torque_spring(1e-3, 0.5), resistance(30), omega0_rad_per_s = 4),
    scene_axle(2, pulse(7e4) + torque_motor(2, 50), resistance(3, 0.5)),
    scene_axle(2, pulse(7e4), resistance(3), omega0_rad_per_s = 4, start_s = 5e4)
  )
  for (scene in scenes) {
    times <- c(max(scene$start_s, 0), 6.9e4, 8e4, 1e5)
    x <- trajectory(scene, times[c(1, 4)])
    expect_equal(audited(x)$verdict, "balanced")
    expect_equal(
      augment(x)$dissipated_j[2], augment(trajectory(scene, times))$dissipated_j[4],
      tolerance = 1e-9
    )
    expect_gt(augment(x)$dissipated_j[2], 0.1)
  }
})

test_that("an audit has a budget, and what is not finite is no verdict", {
  fast <- suppressWarnings(
    spin_up(torque = torque_exponential(1, 2), omega0_rad_per_s = 1e200, time_s = c(0, 8))
  )
  expect_equal(expect_soon(audit(fast)$verdict[1], 20), NA_character_)
  # 5e7 periods: more panels than there may be.
  long <- trajectory(scene_axle(1, torque_sinusoid(1, 3), resistance(0.1)), c(0, 1e8))
  expect_equal(audit(long)$verdict, c(NA_character_, NA))
})

test_that("stops within a rounding of their times are within the balance", {
  # Two short pulses: after each a stop, where the friction changes from its limit to 0.
  pulses <- rbind(
    c(2.29555272927973, 0.00405580219044843, 3.72185097641009, 0.00231779895691631),
    c(1.50983240250498, 0.00155384394646219, 3.08047870642812, 0.0179872556566587)
  )
  for (i in 1:2) {
    for (torque_n_m in seq(0.4, 3, 0.13)) {
      at <- pulses[i, ]
      law <- torque_pulse(at[1], at[2], torque_n_m) + torque_pulse(at[3], at[4], 1.3)
      for (coulomb_n_m in c(0.07, 0.31, 0.77)) {
        scene <- scene_axle(1, law, resistance(coulomb_n_m = coulomb_n_m))
        balance <- audit(trajectory(scene, seq(0, 10, 0.05)))
        expect_true(all(balance$verdict == "balanced"))
        impulse <- balance[balance$balance == "angular_momentum", ]
        expect_lt(impulse$rounding, 2e-14)
      }
    }
  }
})
