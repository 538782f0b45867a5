test_that("every column of rotors, clutches and gears is in the dictionary", {
  rotors <- trajectory(scene_rotors(c(1, 2), 50), c(0, 1), 1e-9)
  clutch <- trajectory(scene_clutch(1, 2, 3), c(0, 1), 1e-9)
  tables <- list(
    rotors, clutch, audit(rotors), audit(clutch), clutch_engagement(1, 2, 3, 4),
    gear_train(1:2, 3), shaft_modes(scene_rotors(c(1, 2), 50))
  )
  for (table in tables) {
    expect_setequal(setdiff(names(table), rotdyn_columns()$name), character())
  }
})

test_that("an accuracy that cannot be had is an error or a warning", {
  clutch <- scene_clutch(1, 2, 3)
  expect_error(trajectory(clutch, 1, 1e-16), class = "rotdyn_error_accuracy")
  # Seven decades of stiffness, damped unevenly, for long.
  hard <- scene_rotors(c(1, 2, 3), c(1e12, 1e5), c(1, 0), theta0_rad = c(0.1, 0, 0))
  expect_warning(
    trajectory(hard, 1e4, 1e-12), class = "rotdyn_warning_accuracy"
  )
})

test_that("predict() gives other times, in any order", {
  scene <- scene_rotors(c(1, 2), 100, torque_n_m = c(1, 0))
  m <- trajectory(scene, c(0, 0.5, 1))
  p <- predict(m, c(1, NA, 0.5))
  expect_equal(p$rotor, rep(1:2, 3))
  expect_equal(p$omega_rad_per_s, m$omega_rad_per_s[c(5:6, NA, NA, 3:4)], tolerance = 1e-13)
  clutch <- scene_clutch(2, 3, 12, omega1_rad_per_s = 10)
  m <- trajectory(clutch, 0:4)
  expect_equal(predict(m, c(4, 2)), tibble::as_tibble(m)[c(5, 3), ])
  expect_error(predict(m, -1), class = "rotdyn_error_time")
})

test_that("motion_events() knows a clutch, and audit() rows that are no numbers", {
  # Slip of 10 rad/s at 12 (1/2 + 1/3) = 10 rad/s^2: it locks after 1 s.
  m <- trajectory(scene_clutch(2, 3, 12, omega1_rad_per_s = 10), 0:4)
  expect_equal(motion_events(m), tibble::tibble(time_s = 1, event = "lock"))
  m$time_s <- "a"
  expect_error(audit(m), class = "rotdyn_error_type")
})
