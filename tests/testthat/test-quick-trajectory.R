# One call of C chooses and runs where nothing is to be said; the long road gives the same object.
long_road <- function(scene, time_s) {
  # A NULL that is given: the defaults, and not the quick road.
  suppressWarnings(trajectory(scene, time_s, model = NULL))
}

test_that("both roads give the same trajectory, bit for bit", {
  disk <- body_disk(2, 0.25)
  ramp <- torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
  time <- seq(0, 8, length.out = 100)
  scenes <- list(
    scene_axle(disk, ramp, resistance(0.03)), scene_axle(3, omega0_rad_per_s = 2, start_s = 4),
    scene_axle(disk, torque_sinusoid(1, 3), resistance(0.1)),
    scene_axle(disk, torque_spring(4), theta0_rad = 0.2),
    scene_axle(disk, 0.3, resistance(0.01, 0.02, 0.05, 0.06)),
    scene_axle(disk, torque_motor(2, 100), resistance(0.1)),
    scene_pendulum(body_rod_end(1, 1), theta0_rad = 2),
    scene_axle(inertia_knots(c(0, 1), c(1, 2)), omega0_rad_per_s = 1), # a column of its own
    scene_incline(body_sphere(1, 0.1), 10),
    scene_incline(
      body_sphere(6, 0.1), 3, static_friction = 0.2, v0_m_per_s = -8, omega0_rad_per_s = 0
    ),
    scene_free(c(1, 2, 3), c(0.1, 2, 0.1)), scene_free(body_box(1, 1, 2, 3), c(1, 2, 3))
  )
  for (scene in scenes) {
    quick <- quick_trajectory(scene, time)
    expect_s3_class(quick, "rot_trajectory")
    expect_identical(quick, long_road(scene, time))
    expect_identical(trajectory(scene, time), quick)
  }
})

test_that("what needs words, or more than a closed form, takes the long road", {
  disk <- body_disk(2, 0.25)
  time <- 0:3
  plain <- scene_axle(disk, 0.3)
  for (times in list(c(0, 2, 1), c(0, NA), c(0, Inf), 0:3, double(), "now", NULL)) {
    expect_null(quick_trajectory(plain, times))
  }
  scenes <- list(
    scene_axle(disk, function(time_s) 1), # an R function
    scene_hanging_mass(disk, 1, 0.25), scene_gears(c(1, 2), 3), # columns that R adds
    scene_incline(body_sphere(1, 1), 10, resistance = resistance(drag_n_s_per_m = 1)), # integrated
    scene_rotors(c(1, 2), 5, theta0_rad = c(0, 1))
  )
  for (scene in scenes) expect_null(quick_trajectory(scene, as.double(time)))
  # A body whose moment is known less well.
  rough <- body_tensor(1, diag(3) * 0.1)
  rough$error <- 1e-6
  expect_null(quick_trajectory(scene_axle(rough, 1), c(0, 1)))
  expect_error(trajectory(plain, c(0, 2, 1)), class = "rotdyn_error_time")
  expect_error(trajectory(plain), class = "rotdyn_error_missing")
  expect_error(trajectory(time_s = 1), class = "rotdyn_error_missing")
  expect_error(trajectory(1, 2), class = "rotdyn_error_type")
})

test_that("numbers that follow from the inputs may not be changed alone", {
  scene <- scene_incline(body_sphere(1, 1), 10)
  expect_s3_class(quick_trajectory(scene, c(0, 1)), "rot_trajectory")
  for (name in c("mass_kg", "moment_of_inertia_kg_m2")) {
    edited <- scene
    edited[[name]] <- 2 * edited[[name]]
    expect_error(trajectory(edited, c(0, 1)), name, class = "rotdyn_error_type")
    expect_error(conserved(edited), name, class = "rotdyn_error_type")
  }
  # Inputs are taken as they are.
  edited <- scene
  edited$incline_angle_deg <- 20
  expect_identical(
    trajectory(edited, c(0, 1))$x_m, trajectory(scene_incline(body_sphere(1, 1), 20), c(0, 1))$x_m
  )
})

test_that("a scene that was sound is looked at again once it is changed", {
  scene <- scene_axle(body_disk(2, 0.25), 0.3)
  first <- trajectory(scene, c(0, 1))
  kept <- scene
  scene$moment_of_inertia_kg_m2 <- "much"
  expect_error(trajectory(scene, c(0, 1)), class = "rotdyn_error_type")
  expect_identical(trajectory(kept, c(0, 1)), first)
  kept$body$mass_kg <- NULL
  expect_error(trajectory(kept, c(0, 1)), class = "rotdyn_error_type")
  other <- scene_axle(body_disk(2, 0.25), 0.3)
  trajectory(other, c(0, 1))
  other[["resistance"]][["viscous_n_m_s"]] <- NaN
  expect_error(trajectory(other, c(0, 1)), class = "rotdyn_error_type")
  # In a function that changes its own copy.
  change <- function(x) {
    x$theta0_rad <- Inf
    trajectory(x, c(0, 1))
  }
  fine <- scene_axle(body_disk(2, 0.25), 0.3)
  trajectory(fine, c(0, 1))
  expect_error(change(fine), class = "rotdyn_error_type")
  expect_identical(trajectory(fine, c(0, 1)), first)
})

test_that("a motion that cancels takes the long road", {
  # At rest again: of the row nothing is left, and the figure takes more times.
  scene <- scene_axle(1, torque_knots(c(0, 1, 1, 2), c(1, 1, -1, -1) * 1e3))
  late <- trajectory(scene, 2)
  error <- attr(late, "run")$info$error
  expect_null(if (error > 1e-13) rotdyn:::quick_trajectory(scene, 2))
  drag <- scene_axle(1, -1, resistance(0.3, 0.2), omega0_rad_per_s = 1e-3)
  expect_identical(trajectory(drag, c(1, 5)), trajectory(drag, c(1, 5), accuracy = 1e-9))
})

test_that("a closed form that errs by more than 1e-13 takes the long road", {
  # Forced, with little damping, late: 4e-13, which the accuracy allows.
  scene <- scene_axle(1, torque_sinusoid(1, 3), resistance(0.01))
  error <- attr(trajectory(scene, 1e4), "run")$info$error
  expect_true(error > 1e-13 && error < 1e-11)
  expect_null(quick_trajectory(scene, 1e4))
})

test_that("whole numbers are taken as the numbers they are", {
  ball <- body_sphere(1, 0.1)
  for (angle in c(1L, 7L, 20L, 33L, 60L)) {
    for (speed in c(-3L, 2L, 11L)) {
      whole <- scene_incline(ball, angle, v0_m_per_s = speed)
      expect_identical(whole, scene_incline(ball, as.double(angle), v0_m_per_s = as.double(speed)))
    }
  }
})
