test_that("every column of rotors, clutches and gears is in the dictionary", {
  env <- rlang::current_env()
  rotors <- trajectory_rotors(scene_rotors(c(1, 2), 50), c(0, 1), 1e-9, NULL, env)
  clutch <- trajectory_clutch(scene_clutch(1, 2, 3), c(0, 1), 1e-9, NULL, env)
  tables <- list(
    rotors, clutch, audit(rotors), audit(clutch), clutch_engagement(1, 2, 3, 4),
    gear_train(1:2, 3), shaft_modes(scene_rotors(c(1, 2), 50))
  )
  for (table in tables) {
    expect_setequal(setdiff(names(table), rotdyn_columns()$name), character())
  }
})

test_that("an accuracy that cannot be had is an error or a warning", {
  env <- rlang::current_env()
  clutch <- scene_clutch(1, 2, 3)
  expect_error(trajectory_clutch(clutch, 1, 1e-16, NULL, env), class = "rotdyn_error_accuracy")
  # Seven decades of stiffness, damped unevenly, for long.
  hard <- scene_rotors(c(1, 2, 3), c(1e12, 1e5), c(1, 0), theta0_rad = c(0.1, 0, 0))
  expect_warning(
    trajectory_rotors(hard, 1e4, 1e-12, NULL, env), class = "rotdyn_warning_accuracy"
  )
})
