# What holds for every constraint of the list.
test_that("the columns of a run are those that its constraint lists", {
  scenes <- list(
    scene_axle(1, 2), scene_rotors(c(1, 2), 9), scene_clutch(1, 2, 3),
    scene_drive(c(1, 2), list(coupling_shaft(5))), scene_incline(body_sphere(1, 0.1), 0.2),
    scene_free(c(1, 2, 2.5), c(1, 2, 3)),
    scene_pivot(c(1, 1, 0.5), c(0, 0, 9), mass_kg = 1, centre_m = c(0, 0, 0.1)),
    scene_hoop(0.1, 0.4, 6), scene_chain(c(1, 0.5), c(2, 1), c(1, 0))
  )
  expect_setequal(
    vapply(scenes, function(scene) constraint_of(scene)$id, ""),
    setdiff(vapply(all_constraints(), `[[`, "", "id"), "equations")
  )
  for (scene in scenes) {
    constraint <- constraint_of(scene)
    columns <- names(trajectory(scene, c(0, 1)))
    expect_true(all(constraint$columns %in% columns))
    more <- if (!is.null(constraint$more_names)) constraint$more_names(scene)
    if (isTRUE(constraint$event_rows)) more <- c(more, "event")
    expect_true(all(columns %in% c(constraint$columns, more)))
    expect_true(all(constraint$keys %in% constraint$columns))
  }
})

test_that("effects and models are those of the core's tables", {
  listed <- core_models()
  for (constraint in all_constraints()) {
    ids <- vapply(constraint$models, `[[`, "", "id")
    expect_identical(unname(ids), names(constraint$models))
    expect_setequal(ids, listed$model[listed$constraint == constraint$id])
    taken <- unique(unlist(lapply(constraint$models, `[[`, "handles")))
    expect_true(all(taken %in% names(constraint$effects)), label = constraint$id)
  }
})

test_that("rows survive a file, dplyr and a selection by their own bits", {
  times <- c(0, 1, 1 + 8 * .Machine$double.eps, 2)
  motion <- trajectory(scene_axle(2, 3, resistance(0.1)), times)
  path <- tempfile()
  on.exit(unlink(path))
  saveRDS(motion, path)
  back <- readRDS(path)
  expect_identical(as.data.frame(back), as.data.frame(motion))
  expect_equal(audit(back), audit(motion))
  expect_false(is.na(run_of(back[c(3, 2), ])$info$error))
  swapped <- back
  swapped$time_s[2:3] <- swapped$time_s[3:2] # equal to 15 digits, other rows
  expect_true(is.na(run_of(swapped)$info$error))
  skip_if_not_installed("dplyr")
  some <- dplyr::filter(back, time_s > 0.5)
  expect_s3_class(some, "rot_trajectory")
  expect_false(is.na(run_of(some)$info$error))
  expect_false(inherits(dplyr::select(back, theta_rad), "rot_trajectory"))
})

test_that("a scene that no constraint has is an error", {
  unknown <- structure(list(start_s = 0), class = c("rot_scene_of_nobody", "rot_scene"))
  expect_error(trajectory(unknown, 0), class = "rotdyn_error_type")
  expect_error(choose_model(unknown, 0), class = "rotdyn_error_type")
})

test_that("a measure of several columns is their 2-norm, unless it has a distance of its own", {
  between <- measure("m", c("x_m", "y_m"))$distance
  expect_equal(between(cbind(4, 1:2), cbind(c(1, 4), c(5, 2))), c(5, 0))
  expect_equal(measure("m", "x_m")$distance(cbind(c(1, 2)), cbind(c(0.5, 4))), c(0.5, 2))
})
