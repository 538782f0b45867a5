test_that("every function returns columns of the dictionary only", {
  known <- column_table()$name
  expect_false(anyDuplicated(known) > 0)
  scene <- article_scene()
  motion <- trajectory(scene, 0:3)
  returned <- list(
    motion, summary(motion), audit(motion), predict(motion, 1), models(),
    choose_model(scene, 0:3), rolling_table(), inertia_table(),
    standard_objects(), energy_partition(0.5, 4, mass_kg = 2, radius_m = 3), column_table(),
    inertia_table(body_disk(2, 3))
  )
  for (table in returned) {
    expect_setequal(setdiff(names(table), known), character())
  }
})

test_that("so does every table about bodies, and those that a body keeps", {
  known <- column_table()$name
  corner <- rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3))
  mesh <- list(vertices = corner, faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4)))
  check <- check_inertia(data.frame(ixx = c(0.0123, 1), iyy = c(0.0145, 1), izz = c(0.213, 1)))
  bodies <- list(
    body_mesh(mesh, mass_kg = 1), body_points(corner, mass_kg = 1),
    join_bodies(body_box(1, 1, 2, 3), body_torus(1, 0.4, 0.1)),
    body_density(1000, domain_box(c(0, 0, 0), c(1, 2, 3)))
  )
  kept <- do.call(c, lapply(bodies, function(body) Filter(is.data.frame, body$detail)))
  returned <- c(
    list(
      shapes(), inertia_table(bodies), principal_axes(bodies[[1]]), check, inertia_repairs(check),
      check_mesh(mesh)
    ),
    kept
  )
  expect_gte(length(kept), 3)
  for (table in returned) {
    expect_setequal(setdiff(names(table), known), character())
  }
  skip_if_not_installed("xml2")
  links <- read_links(system.file("extdata", "arm.urdf", package = "rotdyn"))
  expect_setequal(setdiff(names(links), known), character())
})

test_that("so does every table about motion", {
  known <- column_table()$name
  scene <- scene_axle(body_disk(2, 0.25), torque_constant(1), resistance(0.1, coulomb_n_m = 0.2))
  motion <- trajectory(scene, 0:3)
  designs <- data.frame(moment_of_inertia_kg_m2 = c(0.05, 0.2))
  rotors <- scene_rotors(c(1, 2), 1000, 0.5, torque = c(3, 0))
  returned <- list(
    motion_events(motion), augment(motion), glance(motion), stopping(scene),
    spin_up_table(designs, article_torque(), time_s = 8),
    trajectory(rotors, 0:2), audit(trajectory(rotors, 0:2)), shaft_modes(rotors),
    clutch_engagement(2, 3, 6, 10), gear_train(c(0.01, 0.5), ratios = 5),
    angular_motion(theta_rad = 1, omega0_rad_per_s = 3, alpha_rad_per_s2 = -2),
    point_motion(6, 0.1, -2.5)
  )
  for (table in returned) {
    expect_setequal(setdiff(names(table), known), character())
  }
})

test_that("a name that carries a unit carries the unit of the dictionary", {
  columns <- column_table()
  suffix <- c(
    "_s" = "s", "_rad" = "rad", "_rad_per_s" = "rad/s", "_n_m" = "N m", "_j" = "J", "_kg" = "kg",
    "_deg" = "degree", "_m_per_s2" = "m/s^2", "_kg_m2" = "kg m^2", "_kg_m2_per_s" = "kg m^2/s",
    "_n_s" = "N s"
  )
  for (end in names(suffix)) {
    hit <- columns[endsWith(columns$name, end), ]
    # The longest suffix decides.
    longer <- names(suffix)[nchar(names(suffix)) > nchar(end) & endsWith(names(suffix), end)]
    for (other in longer) hit <- hit[!endsWith(hit$name, other), ]
    hit <- hit[!grepl("_(n_m|kg_m2_per|m_per|rad_per)_s$|^growth_per_s$", hit$name), ]
    if (end == "_n_m") hit <- hit[grepl("torque", hit$name), ]
    expect_true(all(hit$unit == suffix[[end]]), info = end)
  }
})

test_that("torque is never in joule", {
  torque <- column_table()
  torque <- torque[grepl("torque", torque$name) & !grepl("impulse", torque$name), ]
  expect_equal(unique(torque$unit), "N m")
})

test_that("the dictionary begins with the columns of the package, then those of constraints", {
  table <- column_table()
  own <- vapply(rotdyn:::column_list, `[[`, "", 1)
  expect_identical(head(table$name, length(own)), own)
})

test_that("the unit of a name is the longest one in which it ends", {
  expect_identical(unit_of_name("theta_rad"), "rad")
  expect_identical(unit_of_name("omega_rad_per_s"), "rad/s")
  expect_identical(unit_of_name("angular_momentum_x_kg_m2_per_s"), "kg m^2/s")
  expect_identical(unit_of_name("tilt_deg"), "degree")
  expect_identical(unit_of_name("beta"), "1")
  expect_identical(
    without_unit(c("theta_rad", "omega_rad_per_s", "tilt_deg", "beta", "l_kg_m2_per_s")),
    c("theta", "omega", "tilt", "beta", "l")
  )
})

test_that("help lists columns with their units, and meanings of a page in place of the table's", {
  meanings <- c(omega_rad_per_s = "its `rate`", other = "no")
  expect_identical(
    describe_columns(c("omega_rad_per_s", "model"), meanings),
    paste0(
      "\\itemize{\n\\item \\code{omega_rad_per_s} (rad/s): its rate\n",
      "\\item \\code{model}: name of the model, as in models()\n}"
    )
  )
  # A ratio has no unit to name.
  expect_match(describe_columns("beta"), "^\\\\itemize\\{\n\\\\item \\\\code\\{beta\\}: ")
})
