test_that("rotors: work, heat and impulse by hand", {
  # Torques in proportion to the inertias: no twist, omega = t, theta = t^2 / 2.
  driven <- augment(trajectory(scene_rotors(c(1, 2), 1e3, torque = c(1, 2)), c(0, 1, 3)))
  expect_identical(utils::tail(names(driven), 4), c(
    "power_w", "work_j", "dissipated_j", "torque_impulse_n_m_s"
  ))
  expect_equal(driven$work_j, rep(3 * c(0, 1, 9) / 2, each = 2), tolerance = 1e-13)
  expect_equal(driven$power_w, c(0, 0, 1, 2, 3, 6), tolerance = 1e-13)
  expect_equal(driven$torque_impulse_n_m_s, rep(c(0, 3, 9), each = 2))
  expect_equal(driven$dissipated_j, double(6))
  # d_i = J_i / 2: omega = 4 exp(-t / 2), and K = 24 exp(-t) goes into the bearings.
  scene <- scene_rotors(c(1, 2), 1e3, resistance = c(0.5, 1), omega0_rad_per_s = 4)
  coasting <- augment(trajectory(scene, c(0, 1, 3)))
  expect_equal(
    coasting$dissipated_j, rep(24 * (1 - exp(-c(0, 1, 3))), each = 2), tolerance = 1e-12
  )
  expect_equal(coasting$work_j, double(6))
})

test_that("a clutch: work, heat and impulse by hand", {
  # Nothing is carried before 100 s: omega_1 = 10 + 5/2 t.
  open <- scene_clutch(2, 3, 12, torque = list(5, NULL), omega0_rad_per_s = c(10, 0),
    engage_s = 100)
  rows <- augment(trajectory(open, c(1, 2, 4)))
  expect_equal(rows$power_w, 5 * (10 + 2.5 * c(1, 2, 4)), tolerance = 1e-14)
  expect_equal(rows$work_j, 5 * c(0, 10 + 1.25 * 3, 30 + 1.25 * 15), tolerance = 1e-13)
  expect_equal(rows$torque_impulse_n_m_s, 5 * c(0, 1, 3))
  # Slip 10 - 10 t under 12 N m: 60 J until it locks after 1 s, 45 J of them by 0.5 s.
  slips <- augment(trajectory(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)), c(0, 0.5, 2)))
  expect_equal(slips$dissipated_j, c(0, 45, 60), tolerance = 1e-14)
})

test_that("summaries of rotors are those of the whole shaft", {
  row <- summary(trajectory(scene_rotors(c(1, 2), 1e3, torque = c(1, 2)), c(0, 1, 3)))
  expect_equal(row$moment_of_inertia_kg_m2, 3)
  expect_equal(row$max_angular_velocity_rad_per_s, 3, tolerance = 1e-13)
  expect_equal(row$max_angular_momentum_kg_m2_per_s, 9, tolerance = 1e-13)
  expect_equal(row$max_rotational_kinetic_energy_j, 13.5, tolerance = 1e-13)
})

test_that("what is no trajectory is refused", {
  motion <- spin_up(time_s = 0:1)
  for (x in list(1, NULL, "a", sin, list(), mean, quote(x), body_disk(1, 1), scene_axle(1))) {
    expect_error(augment(x), class = "rotdyn_error_type")
    expect_error(glance(x), class = "rotdyn_error_type")
  }
  for (x in list(list(), sin, 1, list(time_s = 1))) {
    forged <- structure(x, class = class(motion))
    expect_error(augment(forged), class = "rotdyn_error_type")
    expect_error(glance(forged), class = "rotdyn_error_type")
  }
})

test_that("what is no object of the package is refused in words of the package", {
  for (x in list(NULL, 3, "a", list(), data.frame(time_s = 1))) {
    expect_error(augment(x), "must be a trajectory", class = "rotdyn_error_type")
    expect_error(glance(x), "must be a trajectory", class = "rotdyn_error_type")
  }
  expect_error(augment(), class = "rotdyn_error_missing")
  error <- tryCatch(augment(NULL), error = identity)
  expect_identical(as.character(conditionCall(error))[1], "augment")
})

test_that("a motion that cannot be computed again has no work", {
  ball <- scene_incline(
    body_sphere(1, 0.1), 20, static_friction = 0.5, resistance = resistance(drag_n_s2_per_m2 = 0.1)
  )
  motion <- trajectory(ball, 0:30)
  run <- attr(motion, "run")
  attr(motion, "run") <- replace(run, c("ledger", "max_steps"), list(NULL, 1))
  expect_error(augment(motion), class = "rotdyn_error_range")
})

test_that("impulses at rows within a phase at rest are those of the torque", {
  # At most 0.2 N m holds 0.3 cos(t) for a part of each half period.
  time_s <- seq(0, 20, 0.01)
  friction <- resistance(coulomb_n_m = 0.2)
  waves <- list(
    torque_sinusoid(0.3, 1), torque_function(function(time_s) 0.3 * cos(time_s))
  )
  for (wave in waves) {
    x <- augment(trajectory(scene_axle(1, wave, friction), time_s))
    expect_true(any(x$omega_rad_per_s[-1] == 0))
    expect_equal(x$torque_impulse_n_m_s, 0.3 * sin(time_s), tolerance = 1e-11)
    expect_equal(
      x$torque_impulse_n_m_s + x$damping_impulse_n_m_s, x$omega_rad_per_s, tolerance = 1e-9
    )
  }
})

test_that("a motion of no rows has the columns without a warning", {
  body <- body_box(2, 0.2, 0.3, 0.5)
  knots <- list(time_s = c(0, 1), x_n_m = c(0, 1), y_n_m = c(0, 0), z_n_m = c(0, 0))
  for (torque in list(NULL, c(0, 0, 1), knots, function(time_s) c(0, 0, time_s))) {
    scene <- scene_free(body, c(0, 0, 0), torque = torque)
    expect_silent(none <- augment(trajectory(scene, double())))
    expect_named(none, names(augment(trajectory(scene, c(0, 1)))))
    expect_identical(nrow(none), 0L)
  }
})
