test_that("the nearest known name is found, and none where nothing is similar", {
  axle <- c("body", "torque", "resistance", "theta0_rad", "omega0_rad_per_s", "start_s")
  near <- function(x, known) rotdyn:::near_names(x, known)
  expect_equal(near("Torque", axle), "torque")
  expect_equal(near("omega_deg", axle), "omega0_rad_per_s")
  expect_equal(near("theta0_deg", axle), "theta0_rad")
  expect_equal(near("speed_rpm", axle), "omega0_rad_per_s")
  expect_equal(near("times", c("scene", "time_s", "accuracy")), "time_s")
  expect_equal(near("diameter", c("mass_kg", "radius_m")), "radius_m")
  for (x in c("colour", "name", "price", "id")) expect_length(near(x, axle), 0L)
})

test_that("unknown arguments are named with the nearest known one and the unit", {
  said <- function(expr) {
    e <- expect_error(expr, class = "rotdyn_error_argument")
    gsub("[[:space:]]+", " ", cli::ansi_strip(conditionMessage(e)))
  }
  scene <- scene_axle(1, 1)
  times <- said(trajectory(scene, times = 0:3))
  expect_match(times, "times = 0:3", fixed = TRUE)
  expect_match(times, "Did you mean `time_s`", fixed = TRUE)
  expect_match(said(scene_axle(1, theta_deg = 3)), "theta0_rad.*convert_angle")
  expect_match(said(scene_axle(1, omega_rpm = 3)), "omega0_rad_per_s.*convert_angle")
  expect_match(said(body_disk(2, diameter_m = 3)), "`radius_m`.*half the diameter")
  rolling <- said(rolling_table(angle_deg = 30))
  expect_match(rolling, "incline_angle_deg")
  expect_no_match(rolling, "convert_angle")
  expect_match(said(resistance(viscosity = 1)), "viscous_n_m_s")
  expect_match(said(energy_partition(1, 1, mass_kg = 1, radius_m = 1, colour = 2)), "colour = 2")
})

test_that("every function of several arguments names unknown ones", {
  takes <- function(f) {
    names <- names(formals(f))
    length(names) < 2L || "..." %in% names
  }
  names <- setdiff(getNamespaceExports("rotdyn"), c("augment", "glance"))
  functions <- mget(names, asNamespace("rotdyn"), mode = "function")
  expect_equal(names(Filter(Negate(takes), functions)), character())
})

test_that("a column that is nearly a known one is no silent extra", {
  said <- function(expr) {
    e <- expect_error(expr, class = "rotdyn_error_argument")
    gsub("[[:space:]]+", " ", cli::ansi_strip(conditionMessage(e)))
  }
  wheel <- data.frame(moment_of_inertia_kg_m2 = c(0.05, 0.2))
  run <- function(...) spin_up_table(cbind(wheel, ...), torque_constant(1), time_s = 1)
  expect_match(said(run(viscous = 0.03)), "viscous. .*viscous_n_m_s")
  expect_match(said(run(omega0_rpm = 30)), "omega0_rad_per_s.*rpm")
  expect_match(said(rolling_table(data.frame(beta = 1, angle_deg = 10))), "incline_angle_deg")
  # Text, other quantities, results of the package, and names whose known one is given.
  expect_s3_class(run(name = "a", viscous = "none", price = 3, ixx_kg_m2 = 1), "rot_spin_up_table")
  expect_s3_class(run(viscous_n_m_s = 0.1, viscous_error = 0.01), "rot_spin_up_table")
  expect_s3_class(spin_up_table(run(), torque_constant(1), time_s = 1), "rot_spin_up_table")
  expect_s3_class(
    rolling_table(data.frame(beta = 1, angle = 10), incline_angle_deg = 5), "rot_rolling_table"
  )
  expect_s3_class(rolling_table(rolling_table()), "rot_rolling_table")
})

test_that("of many unknown names ten are looked at, of long ones none", {
  axle <- c("body", "torque", "omega0_rad_per_s")
  many <- c("Torque", paste0(strrep("x", 40), seq_len(2000), "_torqe"))
  expect_identical(expect_soon(rotdyn:::near_names(many, axle), 20), "torque")
  expect_identical(rotdyn:::near_names(strrep("torque", 1e5), axle), character())
  cut <- rotdyn:::some_names(c("a", strrep("b", 200)))
  expect_identical(cut, c("a", paste0(strrep("b", 60), "...")))
  expect_length(rotdyn:::some_names(many), 10L)
})

test_that("a table of many columns is looked through once for each word", {
  wide <- stats::setNames(rep(list(1), 5000), paste0("sensor_", 1:5000))
  wide$beta <- 0.4
  made <- expect_soon(rolling_table(tibble::new_tibble(wide, nrow = 1L)), 20)
  wide$incline_angle <- 5
  expect_error(
    rolling_table(tibble::new_tibble(wide, nrow = 1L)), "incline_angle_deg",
    class = "rotdyn_error_argument"
  )
})

test_that("messages say what another function is for, and what is missing", {
  said <- function(expr) {
    cli::ansi_strip(conditionMessage(tryCatch(expr, rotdyn_error = identity)))
  }
  expect_match(said(spin_up(3, omega_rad_per_s = 0)), "angular_motion()", fixed = TRUE)
  expect_match(said(energy_partition(1, omega_rad_per_s = 0)), "kinetic_energy()", fixed = TRUE)
  expect_match(said(angular_momentum_of(mass_kg = 1)), "takes the mass in kg", fixed = TRUE)
  expect_match(said(precession_table(mass_kg = 1)), "data.frame(mass_kg", fixed = TRUE)
  expect_match(said(body_points(mass_kg = 1, x_m = 2)), "data.frame(mass_kg", fixed = TRUE)
  expect_match(said(angular_impulse(2, time_s = 2)), "`from_s` and `to_s`", fixed = TRUE)
  expect_match(said(scene_pivot(1, 2, distance_m = 2)), "c(0, 0, -0.1)", fixed = TRUE)
  expect_match(said(scene_incline(body_sphere(1, 1), 2, friction = 0.2)), "omega0_rad_per_s = 0")
  expect_match(said(hinged_hit(body_disk(1, 1), mass_kg = 1)), "`centre_m` is missing")
  expect_match(said(disks_lock(1, 2, 3)), "It is 0 for a body at rest")
  expect_match(said(precession_table(1, distance_m = 2, omega_rad_per_s = 3)),
               "`lever_arm_m` and `spin_rad_per_s`")
  expect_match(said(point_motion(1, distance_m = 2)), "Did you mean `radius_m`", fixed = TRUE)
  # Every hint is of functions that have no such argument; a pattern is of some of them.
  for (one in asked_elsewhere) {
    for (name in setdiff(one[[1]], "scene_[a-z_]+")) {
      expect_false(any(grepl(one[[2]], names(formals(get(name))))), info = name)
    }
  }
})

test_that("a synonym is as near from either side", {
  near <- rotdyn:::word_likeness
  for (pair in list(c("angle", "theta"), c("friction", "coulomb"), c("weight", "mass"))) {
    expect_identical(near(pair[1], pair[2]), 0.8)
    expect_identical(near(pair[2], pair[1]), 0.8)
  }
  expect_identical(near("torque", "torques"), 0.95)
  expect_identical(near("angle", "mass"), 0)
})
