# Tables that the user edited: without values, with a row too many, without a column.

test_that("what has no values to draw is refused by the package", {
  skip_if_not_installed("ggplot2")
  motion <- trajectory(scene_axle(2, 1), 0:4)
  for (name in setdiff(names(motion), "time_s")) motion[[name]] <- NA_real_
  expect_error(ggplot2::autoplot(motion), "no values", class = "rotdyn_error_value")
  record <- motion_record(data.frame(time_s = 0:9, theta_rad = (0:9)^2))
  expect_error(ggplot2::autoplot(record[0, ]), "no rows", class = "rotdyn_error_value")
  points <- work_precision(scene_axle(1, torque_sinusoid(1, 1)), 0:3)
  expect_error(ggplot2::autoplot(points[0, ]), "no runs", class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(points["model"]), "accuracy", class = "rotdyn_error_type")
})

test_that("a row without a time is no base R error", {
  motion <- trajectory(scene_axle(2, 1), 0:4)
  more <- tibble::add_row(motion)
  expect_identical(summary(more)$max_angular_velocity_rad_per_s,
                   summary(motion)$max_angular_velocity_rad_per_s)
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(tibble::add_row(audit(motion))), "ggplot")
})

test_that("energies are added up over the rotors of one time, however near the next", {
  motion <- trajectory(
    scene_drive(c(1, 3), coupling_shaft(10), omega0_rad_per_s = c(2, 0)), c(0.3, 0.1 + 0.2)
  )
  # Both rows have the energy of the start, 2 J, less that of the shaft.
  expect_lt(summary(motion)$max_rotational_kinetic_energy_j, 2)
  edited <- motion
  edited$time_s[1] <- NA
  expect_no_warning(summary(edited), class = "simpleWarning")
})

test_that("an estimate with other rows or names is one no more", {
  t <- seq(0, 5, 0.05)
  x <- estimate_motion(motion_record(data.frame(time_s = t, theta_rad = 10 * t - 0.5 * t^2)))
  renamed <- x
  names(renamed)[1] <- "t"
  expect_false(inherits(renamed, "rot_estimate"))
  expect_s3_class(x[nrow(x):1, ], "tbl_df")
  more <- tibble::add_row(x)
  if (inherits(more, "rot_estimate")) {
    expect_error(predict(more, 1), "rows", class = "rotdyn_error_value")
  }
})

test_that("a motion whose times or angles are texts is one no more", {
  motion <- trajectory(scene_axle(2, 1), 0:4)
  for (name in c("time_s", "theta_rad")) {
    edited <- motion
    edited[[name]] <- as.character(edited[[name]])
    expect_false(inherits(edited, "rot_trajectory"), info = name)
    expect_error(audit(edited), class = "rotdyn_error_type")
  }
  # Rotors as a factor, for a plot of one's own, are still rotors.
  shaft <- trajectory(scene_drive(c(1, 3), coupling_shaft(10), omega0_rad_per_s = c(2, 0)), 0:2)
  shaft$rotor <- factor(shaft$rotor)
  expect_s3_class(shaft, "rot_trajectory")
})

test_that("an audit or a choice of models with columns of another kind prints as a table", {
  motion <- trajectory(scene_axle(2, 1), 0:4)
  whole <- list(audit(motion), choose_model(scene_axle(2, 1), 0:4))
  for (x in whole) {
    for (name in names(x)) {
      without <- x[setdiff(names(x), name)]
      expect_no_warning(utils::capture.output(print(without)))
      expect_match(utils::capture.output(print(x))[1], "^<rot_")
      if (!name %in% c("residual", "rounding", "error", "cost_s")) next
      x[[name]] <- as.character(x[[name]])
      expect_match(utils::capture.output(print(x)), "tibble", all = FALSE)
      x[[name]] <- as.numeric(x[[name]])
    }
  }
  skip_if_not_installed("ggplot2")
  choice <- whole[[2]]
  expect_no_warning(ggplot2::autoplot(choice[setdiff(names(choice), "reason")]))
})

test_that("tables whose names were taken print their numbers", {
  motion <- trajectory(scene_axle(1, torque = 1), 0:3)
  for (x in list(motion, glance(motion), audit(motion))) {
    suppressWarnings(names(x) <- NULL)
    expect_output(suppressWarnings(print(x)), "A tibble", fixed = TRUE)
  }
})
