# The closed forms against the integrator, which has reached values by hand and of 34 digits
# (test-model-drive.R), column by column.
expect_same_motion <- function(scene, t, model, tolerance = 1e-10) {
  exact <- trajectory(scene, t)
  run <- attr(exact, "run")
  expect_equal(run$model, model)
  expect_lte(run$info$error, 1e-12)
  integrated <- trajectory(scene, t, 1e-12, "drive_rk8pd")
  for (column in columns_of_motion("drive")) {
    want <- integrated[[column]]
    got <- exact[[column]]
    expect_identical(is.na(got), is.na(want), label = column)
    if (is.double(want)) {
      size <- max(abs(want), 1e-10, na.rm = TRUE)
      expect_lt(max(abs(got - want), 0, na.rm = TRUE) / size, tolerance, label = column)
    } else {
      expect_identical(got, want, label = column)
    }
  }
  expect_true(all(audit(exact)$verdict == "balanced"))
  expect_equal(motion_events(exact), motion_events(integrated), tolerance = 1e-12)
  exact
}

test_that("gears alone are one body on an axle", {
  t <- seq(0, 4, by = 0.5)
  gears <- list(coupling_gear(5), coupling_gear(-0.3))
  expect_same_motion(
    scene_drive(
      c(0.1, 0.5, 2), gears,
      torque = list(
        torque_motor(3, 50) + torque_sinusoid(1, 3), torque_knots(c(0, 1, 2), c(0, 3, 1)), -1
      ),
      resistance = list(resistance(0.1), NULL, resistance(0.02)), theta0_rad = 1,
      omega0_rad_per_s = 2
    ), t, "drive_axle"
  )
  expect_same_motion(scene_drive(c(0.1, 0.5, 2), gears), t, "drive_axle")
  expect_same_motion(
    scene_drive(c(0.1, 0.5), coupling_gear(2), torque = list(2, torque_exponential(3, 0.5)),
                omega0_rad_per_s = -3, start_s = 1), t, "drive_axle"
  )
  # J1 + J2/25 = 0.12, 2 - 4/5 N m.
  pair <- trajectory(scene_drive(c(0.1, 0.5), coupling_gear(5), torque = list(2, -4)), c(0, 3))
  expect_equal(pair$omega_rad_per_s[3:4], c(30, 6), tolerance = 1e-15)
  expect_equal(attr(pair, "run")$error_kind, "bound")
})

test_that("one constant clutch is two bodies and a clutch", {
  t <- seq(0, 4, by = 0.25)
  expect_same_motion(
    scene_drive(
      c(0.1, 0.5, 2),
      list(coupling_gear(5), coupling_clutch(4, static_ratio = 1.3, ratio = -2, from_s = 0.6)),
      torque = list(1, torque_knots(c(0, 2, 2, 3), c(1, 1, 20, 20)), -1), theta0_rad = 1,
      omega0_rad_per_s = c(20, 4, 1)
    ), t, "drive_clutch"
  )
  motion <- expect_same_motion(
    scene_drive(c(2, 3), coupling_clutch(12), omega0_rad_per_s = c(10, 0)), t[t != 1],
    "drive_clutch"
  )
  expect_equal(motion_events(motion)$time_s, 1, tolerance = 1e-15)
  expect_equal(last(motion$coupling_heat_j[motion$rotor == 1]), 60, tolerance = 1e-15)
})

test_that("shafts and gears are rotors on one shaft", {
  t <- seq(0, 4, by = 0.5)
  expect_same_motion(
    scene_drive(
      c(0.1, 0.5, 2), list(coupling_gear(5), coupling_shaft(40, 0.2, ratio = -2)),
      torque = list(1, 2, -1), resistance = list(resistance(0.1), NULL, NULL),
      theta0_rad = c(1, 2, 3), omega0_rad_per_s = c(20, 4, 1)
    ), t, "drive_modal"
  )
  scene <- scene_drive(
    c(0.1, 0.5, 2), list(coupling_shaft(100), coupling_shaft(40)), torque = list(1, 2, -1),
    theta0_rad = c(1, 2, 3), omega0_rad_per_s = c(20, 4, 1)
  )
  motion <- expect_same_motion(scene, t, "drive_modal", 1e-9)
  same <- trajectory(
    scene_rotors(c(0.1, 0.5, 2), c(100, 40), torque = c(1, 2, -1), theta0_rad = c(1, 2, 3),
      omega0_rad_per_s = c(20, 4, 1)), t
  )
  expect_equal(motion$theta_rad, same$theta_rad, tolerance = 1e-14)
  expect_equal(motion$coupling_torque_n_m, same$shaft_torque_n_m, tolerance = 1e-12)
})

test_that("a closed form says why it does not fit", {
  choice <- function(...) choose_model(scene_drive(...), 0:2)
  reason <- function(table, model) table$reason[table$model == model]
  one <- choice(c(1, 2), coupling_gear(2), torque = list(torque_spring(3), NULL))
  expect_match(reason(one, "drive_axle"), "torques of time")
  two <- choice(c(1, 2), coupling_clutch(torque_knots(0:1, c(0, 2))), omega0_rad_per_s = c(1, 0))
  expect_match(reason(two, "drive_clutch"), "constant capacity")
  three <- choice(c(1, 2), coupling_shaft(3), torque = list(torque_sinusoid(1, 2), NULL))
  expect_match(reason(three, "drive_modal"), "torque laws")
  expect_equal(three$model[three$chosen], "drive_rk8pd")
  expect_error(
    trajectory(scene_drive(c(1, 2), coupling_shaft(3)), 0:1, model = "drive_axle"),
    class = "rotdyn_error_model"
  )
})

test_that("the verbs work on the closed forms of a drive", {
  scene <- scene_drive(
    c(0.1, 0.5), coupling_gear(5), torque = list(torque_sinusoid(2, 3), NULL),
    resistance = list(NULL, resistance(0.4)), omega0_rad_per_s = 1
  )
  motion <- trajectory(scene, seq(0, 3, by = 0.25))
  more <- generics::augment(motion)
  at <- more$rotor == 1
  kinetic <- tapply(more$rotational_kinetic_energy_j, more$time_s, sum)
  expect_equal(
    as.vector(kinetic - kinetic[1]), more$work_j[at] - more$dissipated_j[at], tolerance = 1e-12
  )
  expect_equal(predict(motion, c(1, 0.5))$theta_rad, motion$theta_rad[c(9, 10, 5, 6)],
               tolerance = 1e-14)
  expect_true(all(audit(motion[motion$time_s > 0.6, ])$verdict == "balanced"))
  wrong <- motion
  wrong$heat_j[26] <- wrong$heat_j[26] * (1 + 1e-9)
  expect_equal(audit(wrong)$verdict[1], "unbalanced")
  expect_equal(nrow(trajectory(scene, double())), 0L)
  back <- trajectory(scene, c(-1, 0, 1))
  expect_true(all(audit(back)$verdict == "balanced"))
  expect_lt(back$heat_j[2], 0)
})
