# The torque on body 1 in each interval, of a clutch that holds nothing.
torques_between <- function(torque, time_s) {
  motion <- trajectory(scene_clutch(2, 3, 0, torque = list(torque, NULL)), time_s)
  2 * diff(motion$omega_1_rad_per_s) / diff(time_s)
}

test_that("stepped torques are taken apart at their jumps", {
  step <- torque_knots(c(0, 2, 2, 5), c(30, 30, -10, -10))
  expect_equal(torques_between(step, c(0, 1, 2, 3, 5, 8)), c(30, 30, -10, -10, 0))
  expect_equal(torques_between(-5, 0:2), c(-5, -5))
  held <- torque_knots(c(1, 1), c(4, 7), outside = "hold")
  expect_equal(torques_between(held, 0:3), c(4, 7, 7))
})

test_that("a clutch keeps what it was given, and what follows from it", {
  body <- body_disk(20, 0.15)
  scene <- scene_clutch(body, 2, 60, torque = list(NULL, -5))
  expect_identical(scene$body_1, body)
  expect_identical(scene$moment_of_inertia_kg_m2, c(20 * 0.15^2 / 2, 2))
  expect_identical(scene$static_capacity_n_m, 60)
  expect_null(scene$torque_1)
  skip_if_not_installed("yyjsonr")
  expect_identical(read_scene(write_scene(scene)), scene)
  # A rod about its end, wherever that is; a point about its axis.
  rod <- scene_clutch(body_rod_end(3, 2), place_body(body_rod_end(3, 2), c(1, 0, 0)), 1)
  expect_equal(rod$moment_of_inertia_kg_m2, c(4, 4))
  expect_equal(scene_clutch(body_point(3, 2), 1, 1)$moment_of_inertia_kg_m2, c(12, 1))
  scene$moment_of_inertia_kg_m2[2] <- 3
  expect_error(trajectory(scene, 1), "moment_of_inertia_kg_m2", class = "rotdyn_error_type")
})

test_that("what is no clutch is refused", {
  expect_error(scene_clutch(0, 3, 12), class = "rotdyn_error_value")
  expect_error(scene_clutch(c(1, 2), 3, 12), class = "rotdyn_error_size")
  expect_error(scene_clutch(2, 3, -1), class = "rotdyn_error_value")
  expect_error(scene_clutch(2, 3, 12, static_capacity_n_m = 11), class = "rotdyn_error_value")
  expect_error(scene_clutch(2, 3), class = "rotdyn_error_missing")
  expect_error(
    scene_clutch(2, 3, 12, torque = list(torque_knots(0:1, 0:1), 1:2)), class = "rotdyn_error_size"
  )
  expect_error(
    scene_clutch(2, 3, 12, torque = list(NULL, "a")), class = "rotdyn_error_type"
  )
})

test_that("a clutch prints itself", {
  expect_output(
    print(scene_clutch(2, 3, 12, static_capacity_n_m = 15, engage_s = 1)),
    "two bodies and a clutch.*12 N m slipping, 15 N m locked, engages at 1 s"
  )
  expect_output(
    print(scene_clutch(2, 3, 12, torque = list(torque_constant(5), torque_constant(-7)))),
    "torque 1  constant, 5 N m\n  torque 2  constant, -7 N m"
  )
})

test_that("a sum of laws that is constant between jumps will do", {
  expect_equal(torques_between(torque_constant(1) + torque_pulse(1, 1, 2), 0:3), c(1, 3, 1))
})

test_that("numbers near the end of double precision end in an error of ours or a motion", {
  for (omega in c(1e300, 1e-300)) {
    got <- tryCatch(
      suppressWarnings(
        trajectory(scene_clutch(1e300, 1e300, 1e300, omega0_rad_per_s = c(omega, 0)), c(0, 1))
      ),
      error = identity
    )
    expect_true(inherits(got, c("rot_trajectory", "rotdyn_error")))
  }
})

test_that("each body has its own angle and rate, whatever the clutch's torques", {
  for (resistance in list(NULL, list(resistance(0.1), NULL))) {
    scene <- scene_clutch(1, 2, 1, resistance = resistance, theta0_rad = c(0.1, 0.3),
                          omega0_rad_per_s = c(4, 5))
    expect_identical(scene$theta0_rad, c(0.1, 0.3))
    expect_identical(scene$omega0_rad_per_s, c(4, 5))
    # At rest at 0 where nothing is said.
    rest <- trajectory(scene_clutch(1, 2, 1, resistance = resistance), 0)
    states <- as.data.frame(rest)[grep("^(theta|omega)_", names(rest))]
    expect_true(all(states == 0) && length(states) >= 2L)
    for (x in list(1, 1:3, numeric())) {
      expect_error(scene_clutch(1, 2, 1, resistance = resistance, theta0_rad = x), "2 numbers",
                   class = "rotdyn_error_value")
      expect_error(scene_clutch(1, 2, 1, resistance = resistance, omega0_rad_per_s = x),
                   "2 numbers", class = "rotdyn_error_value")
    }
  }
})

test_that("torques that are not constant between jumps make it a drive", {
  expect_s3_class(scene_clutch(2, 3, 12, torque = list(torque_knots(0:1, c(4, 4)), NULL)),
                  "rot_scene_clutch")
  for (torque in list(torque_knots(0:1, c(0, 5)), torque_knots(0:2, c(0, 5, 0)))) {
    expect_s3_class(scene_clutch(2, 3, 12, torque = list(torque, NULL)), "rot_scene_drive")
  }
})
