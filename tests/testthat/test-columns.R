test_that("every function returns columns of the dictionary only", {
  known <- rotdyn_columns()$name
  expect_false(anyDuplicated(known) > 0)
  scene <- article_scene()
  motion <- trajectory(scene, 0:3)
  returned <- list(
    motion, summary(motion), audit(motion), predict(motion, 1), models(),
    choose_model(scene, 0:3), rolling_table(), rolling_objects(), inertia_table(),
    inertia_objects(), energy_partition(2, 3, 0.5, 4), rotdyn_columns(),
    inertia_table(body_disk(2, 3))
  )
  for (table in returned) {
    expect_setequal(setdiff(names(table), known), character())
  }
})

test_that("a name that carries a unit carries the unit of the dictionary", {
  columns <- rotdyn_columns()
  suffix <- c(
    "_s" = "s", "_rad" = "rad", "_rad_per_s" = "rad/s", "_n_m" = "N m", "_j" = "J", "_kg" = "kg",
    "_deg" = "degree", "_m_per_s2" = "m/s^2", "_kg_m2" = "kg m^2", "_kg_m2_per_s" = "kg m^2/s"
  )
  for (end in names(suffix)) {
    hit <- columns[endsWith(columns$name, end), ]
    # The longest suffix decides.
    longer <- names(suffix)[nchar(names(suffix)) > nchar(end) & endsWith(names(suffix), end)]
    for (other in longer) hit <- hit[!endsWith(hit$name, other), ]
    hit <- hit[!grepl("_(n_m|kg_m2_per|m_per|rad_per)_s$", hit$name), ]
    if (end == "_n_m") hit <- hit[grepl("torque", hit$name), ]
    expect_true(all(hit$unit == suffix[[end]]), info = end)
  }
})

test_that("torque is never in joule", {
  torque <- rotdyn_columns()
  torque <- torque[grepl("torque", torque$name) & !grepl("impulse", torque$name), ]
  expect_equal(unique(torque$unit), "N m")
})
