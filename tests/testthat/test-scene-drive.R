test_that("one number goes through the ratios", {
  scene <- scene_drive(
    c(1, 2, 3), list(coupling_shaft(10, ratio = 4), coupling_gear(-0.5)),
    theta0_rad = 8, omega0_rad_per_s = 12
  )
  expect_equal(scene$theta0_rad, c(8, 2, -4))
  expect_equal(scene$omega0_rad_per_s, c(12, 3, -6))
  expect_s3_class(scene, "rot_scene")
  expect_equal(
    scene_drive(list(body_disk(2, 1), 3), coupling_gear(2))$moment_of_inertia_kg_m2, c(1, 3)
  )
})

test_that("what is no drive is refused, in the user's own call", {
  refuses <- function(code, class) {
    condition <- expect_error(code, class = paste0("rotdyn_error_", class))
    expect_match(rlang::expr_deparse(condition$call)[1], "^(scene_drive|coupling_|brake)")
  }
  refuses(scene_drive(c(1, 2)), "size")
  refuses(scene_drive(c(1, 2), list(1)), "type")
  refuses(scene_drive(c(1, 2), "gear"), "type")
  refuses(scene_drive(c(1, 2), coupling_gear(2), torque = 3), "type")
  refuses(scene_drive(c(1, 2), coupling_gear(2), torque = list(3)), "size")
  refuses(scene_drive(c(1, 2), coupling_gear(2), torque = list("3", NULL)), "type")
  refuses(scene_drive(c(1, 2), coupling_gear(2), resistance = list("3", NULL)), "type")
  refuses(scene_drive(c(1, 2), coupling_gear(2), brake = list(3, NULL)), "type")
  refuses(scene_drive(c(1, 2), coupling_gear(2), omega0_rad_per_s = c(1, 1)), "value")
  refuses(scene_drive(c(1, 2), coupling_gear(2), theta0_rad = 1:3), "size")
  refuses(scene_drive(c(1, 2), coupling_gear(2), 5), "argument")
  refuses(scene_drive(c(1, 0), coupling_gear(2)), "value")
  refuses(scene_drive(c(1, 2), coupling_gear(1e-200), omega0_rad_per_s = 1e200), "value")
  refuses(scene_drive(c(1, 2), coupling_gear(1e200), omega0_rad_per_s = c(1, 1e200)), "value")
  refuses(coupling_gear(0), "value")
  refuses(coupling_gear(NA_real_), "value")
  refuses(coupling_shaft(-1), "value")
  refuses(coupling_shaft(), "missing")
  refuses(coupling_clutch(-1), "value")
  refuses(coupling_clutch(torque_knots(0:1, c(1, -1))), "value")
  refuses(coupling_clutch(1, static_ratio = 0.9), "value")
  refuses(brake(1, from_s = 2, to_s = 1), "time")
  refuses(brake(1, from_s = NaN), "type")
  refuses(brake("1"), "type")
})

test_that("a drive prints its rotors and couplings", {
  scene <- scene_drive(
    c(0.1, 2), coupling_clutch(12, static_ratio = 1.5, ratio = 3, from_s = 1),
    torque = list(torque_motor(5, 100), NULL), resistance = list(NULL, resistance(0.3)),
    brake = list(NULL, brake(4, to_s = 9))
  )
  shown <- capture.output(print(scene))
  expect_match(shown, "a drive of 2 rotors", all = FALSE)
  expect_match(shown, "clutch, 12 N m, 1.5 times that at rest, from 1 s, ratio 3", all = FALSE)
  expect_match(shown, "brake +4 N m, until 9 s", all = FALSE)
  expect_match(shown, "a motor, 5 N m at rest", all = FALSE)
  expect_match(shown, "viscous, 0.3 N m s", all = FALSE)
  expect_output(print(coupling_gear(-2)), "gear, ratio -2")
  expect_output(print(coupling_shaft(5, 0.1)), "shaft, 5 N m/rad, 0.1 N m s")
  expect_output(print(brake(3)), "3 N m")
})

test_that("the laws of a drive are called at the start of their own rotor", {
  seen <- list()
  law <- torque_function(function(time_s, theta_rad, omega_rad_per_s) {
    seen[[length(seen) + 1L]] <<- c(theta_rad[1], omega_rad_per_s[1])
    0 * time_s
  }, vectorised = TRUE)
  pair <- function(...) {
    scene_drive(c(1, 2), coupling_gear(2), ..., theta0_rad = 8, omega0_rad_per_s = 12)
  }
  invisible(choose_model(pair(torque = list(NULL, law)), 1))
  expect_identical(unique(seen), list(c(4, 6)))
  seen <- list()
  invisible(trajectory(pair(torque = list(law, NULL)), 1))
  expect_identical(seen[[1]], c(8, 12))
  seen <- list()
  invisible(choose_model(pair(brake = list(NULL, brake(law))), 1))
  expect_identical(unique(seen), list(c(0, 0)))
})

test_that("rates of gears agree within rounding, or are refused", {
  pair <- function(off) scene_drive(c(1, 2), coupling_gear(2), omega0_rad_per_s = c(1, 0.5 + off))
  expect_identical(pair(2e-13)$omega0_rad_per_s, c(1, 0.5 + 2e-13))
  expect_error(pair(2e-12), "agree with the gears", class = "rotdyn_error_value")
})

test_that("what follows from the arguments of a drive is not changed by hand", {
  scene <- scene_drive(c(1, 2), coupling_gear(2), omega0_rad_per_s = 4)
  for (name in c(
    "moment_of_inertia_kg_m2", "ratio_to_first", "omega0_rad_per_s"
  )) {
    forged <- scene
    forged[[name]][2] <- 1.5 * forged[[name]][2]
    expect_error(trajectory(forged, 1), name, class = "rotdyn_error_type")
  }
})

test_that("an efficiency lies above 0 and is at most 1", {
  expect_equal(coupling_gear(2, efficiency = 1)$efficiency, 1)
  for (wrong in c(0, -0.5, 1.001, 1.5)) {
    expect_error(coupling_gear(2, efficiency = wrong), "efficiency", class = "rotdyn_error_value")
  }
})

test_that("meshed rotors hold until the torque exceeds the friction of all, seen at the first", {
  # Rotor 1 turns twice as fast: dry friction of 2 N m at rotor 2 is 1 N m at rotor 1, beside its 1.
  motion <- function(torque) {
    trajectory(scene_drive(
      c(1, 1), coupling_gear(2), torque = list(torque, NULL),
      resistance = list(resistance(coulomb_n_m = 1), resistance(coulomb_n_m = 2))
    ), 1)
  }
  held <- motion(1.99)
  expect_identical(held$theta_rad, c(0, 0))
  # At rest the two share the load by their capacities; the mesh gives what rotor 2 takes.
  expect_equal(held$damping_torque_n_m, -1.99 * c(1, 2) / 2)
  expect_equal(held$coupling_torque_n_m[1], 1.99 / 2)
  # Beyond: (T - 2)/(J1 + J2/4), half of it squared.
  slips <- motion(2.5)
  expect_equal(slips$theta_rad, 0.5 / 1.25 / 2 * c(1, 0.5), tolerance = 1e-9)
  expect_equal(slips$damping_torque_n_m, c(-1, -2))
})

test_that("static friction alone holds a rotor of a drive", {
  motion <- function(torque) {
    trajectory(scene_drive(
      c(1, 2), coupling_shaft(5), torque = list(torque, NULL),
      resistance = list(resistance(static_n_m = 0.4), NULL)
    ), 0:2)
  }
  expect_true(all(motion(0.39)$theta_rad == 0))
  expect_gt(motion(0.41)$theta_rad[5], 0)
})

test_that("dry friction that holds a train acts against the torque on every body of it", {
  for (efficiency in c(1, 0.9)) {
    held <- trajectory(scene_drive(
      list(1, 2), coupling_gear(2, efficiency = efficiency), torque = list(0.5, NULL),
      resistance = list(resistance(coulomb_n_m = 1), resistance(coulomb_n_m = 1))
    ), 1)
    expect_identical(held$omega_rad_per_s, c(0, 0))
    # Each gives the same part of what it could.
    expect_equal(held$damping_torque_n_m[1], held$damping_torque_n_m[2], tolerance = 1e-12)
    expect_lt(held$damping_torque_n_m[1], 0)
    expect_equal(
      held$applied_torque_n_m[1] + held$damping_torque_n_m[1], held$coupling_torque_n_m[1],
      tolerance = 1e-12
    )
  }
})
