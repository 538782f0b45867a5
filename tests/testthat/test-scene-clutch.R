test_that("stepped torques are taken apart at their jumps", {
  scene <- scene_clutch(2, 3, 12, torque_1 = torque_knots(c(0, 2, 2, 5), c(30, 30, -10, -10)),
                        torque_2 = -5)
  expect_equal(unname(scene$steps[[1]]), list(c(0, 2, 5), c(0, 30, -10, 0)))
  expect_equal(unname(scene$steps[[2]]), list(double(), -5))
  held <- scene_clutch(2, 3, 12, torque_1 = torque_knots(c(1, 1), c(4, 7), outside = "hold"))
  expect_equal(unname(held$steps[[1]]), list(1, c(4, 7)))
})

test_that("what is no clutch is refused", {
  expect_error(scene_clutch(0, 3, 12), class = "rotdyn_error_value")
  expect_error(scene_clutch(c(1, 2), 3, 12), class = "rotdyn_error_size")
  expect_error(scene_clutch(2, 3, -1), class = "rotdyn_error_value")
  expect_error(scene_clutch(2, 3, 12, static_capacity_n_m = 11), class = "rotdyn_error_value")
  expect_error(scene_clutch(2, 3), class = "rotdyn_error_missing")
  expect_error(
    scene_clutch(2, 3, 12, torque_1 = torque_knots(0:1, 0:1)), class = "rotdyn_error_torque"
  )
  expect_error(
    scene_clutch(2, 3, 12, torque_2 = function(time_s) 1), class = "rotdyn_error_torque"
  )
})

test_that("a clutch prints itself", {
  expect_output(
    print(scene_clutch(2, 3, 12, static_capacity_n_m = 15, engage_s = 1)),
    "two bodies and a clutch.*12 N m slipping, 15 N m locked, engages at 1 s"
  )
})

test_that("a sum of laws that is constant between jumps will do", {
  one <- scene_clutch(1, 1, 1, torque_1 = torque_constant(1) + torque_pulse(1, 1, 2))
  expect_equal(unname(one$steps[[1]]), list(c(1, 2), c(1, 3, 1)))
})

test_that("numbers near the end of double precision end in an error of ours or a motion", {
  for (omega in c(1e300, 1e-300)) {
    got <- tryCatch(
      suppressWarnings(
        trajectory(scene_clutch(1e300, 1e300, 1e300, omega1_rad_per_s = omega), c(0, 1))
      ),
      error = identity
    )
    expect_true(inherits(got, c("rot_trajectory", "rotdyn_error")))
  }
})
