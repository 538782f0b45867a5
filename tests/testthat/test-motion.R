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
