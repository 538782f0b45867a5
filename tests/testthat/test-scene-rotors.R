test_that("numbers recycle, bodies count with their Izz", {
  scene <- scene_rotors(list(body_disk(2, 3), 0.7, body_rod(12, 1)), 100, c(1, 2))
  expect_equal(scene$moment_of_inertia_kg_m2, c(9, 0.7, 1))
  expect_equal(scene$stiffness_n_m_per_rad, c(100, 100))
  expect_equal(scene$damping_n_m_s, c(1, 2))
  expect_equal(scene$torque, c(0, 0, 0))
  expect_s3_class(scene, "rot_scene")
})

test_that("what is no shaft is refused", {
  expect_error(scene_rotors(c(1, 0), 10), class = "rotdyn_error_value")
  expect_error(scene_rotors(double(), 10), class = "rotdyn_error_size")
  expect_error(scene_rotors(c(1, 2), -10), class = "rotdyn_error_value")
  expect_error(scene_rotors(c(1, 2, 3), c(1, 2, 3)), class = "rotdyn_error_size")
  expect_error(scene_rotors(c(1, 2), 1, resistance = -1), class = "rotdyn_error_value")
  expect_error(scene_rotors(c(1, 2), 1, omega0_rad_per_s = NA), class = "rotdyn_error_value")
  expect_error(scene_rotors(list("a", 2), 1), class = "rotdyn_error_type")
  expect_error(scene_rotors(c(1, 2)), class = "rotdyn_error_missing")
  expect_error(shaft_modes(scene_axle(1)), class = "rotdyn_error_type")
})

test_that("frequencies are those of the textbook", {
  # Two rotors: sqrt(k (1/J1 + 1/J2)); three equal ones: sqrt(k/J), sqrt(3 k/J).
  expect_equal(
    shaft_modes(scene_rotors(c(2, 3), 60))$natural_rad_per_s, c(0, sqrt(50)), tolerance = 1e-15
  )
  expect_equal(
    shaft_modes(scene_rotors(c(2, 2, 2), 18))$natural_rad_per_s, c(0, 3, sqrt(27)),
    tolerance = 1e-15
  )
  # A missing piece leaves two zeros.
  expect_equal(
    shaft_modes(scene_rotors(c(2, 3, 1), c(60, 0)))$natural_rad_per_s, c(0, 0, sqrt(50)),
    tolerance = 1e-15
  )
})

test_that("a scene of rotors prints itself", {
  expect_output(
    print(scene_rotors(c(1, 2, 4), c(800, 1200), 0.05, torque = c(2, 0, -2))),
    "3 rotors on one shaft.*1, 2, 4 kg m\\^2.*800, 1200 N m/rad"
  )
})

test_that("a shaft to nowhere, and a torque that stands for several, are refused", {
  expect_error(scene_rotors(20, 60), class = "rotdyn_error_size")
  expect_error(scene_rotors(c(1, 2), 60, torque = 2), class = "rotdyn_error_size")
})

test_that("the print has each torque in its place", {
  shown <- capture.output(print(scene_rotors(c(1, 2, 3), 100, torque = c(0, 1, 0))))
  expect_match(shown, "torque     0, 1, 0 N m", fixed = TRUE, all = FALSE)
  expect_match(shown, "stiffness  100 N m/rad", fixed = TRUE, all = FALSE)
})

test_that("a body with its mass on the axle is named, with a remedy", {
  wheels <- list(body_disk(1, 1), body_disk(1, 0))
  expect_error(
    scene_rotors(wheels, 2), "(?s)bodies\\[\\[2\\]\\]` must have.*give it a larger\\s+radius",
    perl = TRUE, class = "rotdyn_error_value"
  )
  expect_error(
    scene_rotors(c(1, 0), 2), "bodies\\[\\[2\\]\\]` must have", class = "rotdyn_error_value"
  )
  expect_error(
    angular_impulse(1, 0, 1, body = body_point(1)), "`body` must have", class = "rotdyn_error_value"
  )
})

test_that("the row at the start is the initial state", {
  scene <- scene_rotors(list(1, 2), 1000, omega0_rad_per_s = c(3, 0), theta0_rad = c(0.1, 0))
  for (time_s in list(0, seq(0, 1, by = 0.01))) {
    expect_silent(motion <- trajectory(scene, time_s))
    expect_identical(motion$omega_rad_per_s[1:2], c(3, 0))
    expect_identical(motion$theta_rad[1:2], c(0.1, 0))
  }
})
