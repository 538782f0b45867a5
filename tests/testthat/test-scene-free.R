test_that("a scene says what it is, and its parts are checked", {
  scene <- scene_free(c(1, 2, 3), c(0.1, 0.2, 0.3))
  expect_s3_class(scene, "rot_scene")
  expect_output(print(scene), "principal moments 1, 2, 3 kg m^2", fixed = TRUE)
  expect_error(scene_free(c(1, 2), c(0, 0, 1)), class = "rotdyn_error_size")
  expect_error(scene_free(c(1, 2, 3), c(0, 1)), class = "rotdyn_error_size")
  expect_error(scene_free(c(1, 2, 3), c(0, NA, 1)), class = "rotdyn_error_value")
  expect_warning(scene_free(c(1, 1, 3), c(0, 0, 1)), class = "rotdyn_warning_inertia")
  expect_error(scene_free(c(-1, 1, 3), c(0, 0, 1)), class = "rotdyn_error_value")
  expect_error(scene_free(c(0, 0, 0), c(0, 0, 1)), class = "rotdyn_error_value")
  expect_error(scene_free(c(1, 2, 3)), class = "rotdyn_error_missing")
  expect_error(scene_free(c(1, 2, 3), c(0, 0, 1), omega = 1), class = "rotdyn_error_argument")
  expect_error(
    scene_free(c(1, 2, 3), c(0, 0, 1), torque_axes = "sky"), class = "rotdyn_error_value"
  )
  expect_error(
    scene_free(c(1, 2, 3), c(0, 0, 1), torque = 1), class = "rotdyn_error_size"
  )
  expect_error(
    scene_free(c(1, 2, 3), c(0, 0, 1), torque = function() 1), class = "rotdyn_error_type"
  )
  own <- function(time_s, size = 2) c(size, 0, 0) # as on an axle, its own business
  expect_equal(
    trajectory(scene_free(c(2, 2, 2), c(0, 0, 0), torque = own), 3)$omega_x_rad_per_s, 3
  )
  expect_error(
    scene_free(c(1, 2, 3), c(0, 0, 1), torque = data.frame(time_s = 0:1)),
    class = "rotdyn_error_type"
  )
  knots <- data.frame(time_s = c(0, 0), x_n_m = 0, y_n_m = 0, z_n_m = 1) # no span
  expect_error(scene_free(c(1, 2, 3), c(0, 0, 1), torque = knots), class = "rotdyn_error_time")
})

test_that("a rod has no spin about itself, and turns steadily across it", {
  rod <- body_rod(0.3, 2)
  expect_error(scene_free(c(0, 1, 1), c(0.1, 1, 0)), class = "rotdyn_error_value")
  expect_error(
    scene_free(c(0, 1, 1), c(0, 1, 0), torque = c(0, 1, 0)), class = "rotdyn_error_value"
  )
  moments <- diag(scene_free(rod, c(0, 0, 0))$moment_of_inertia_kg_m2)
  across <- as.double(diag(moments) > 0)
  motion <- trajectory(scene_free(rod, across * c(0.3, 0.4, 0.5)), c(0, 2))
  rate <- sqrt(sum((across * c(0.3, 0.4, 0.5))^2))
  expect_equal(motion$qw, c(1, cos(rate)), tolerance = 1e-15)
})

test_that("the attitude at the start may have any form", {
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  q <- attitude_from(turn, "matrix")
  scenes <- lapply(list(turn, q, unlist(q), unname(unlist(q))), function(attitude) {
    scene_free(c(1, 2, 3), c(0.1, 0.2, 0.3), attitude0 = attitude)
  })
  for (scene in scenes[-1]) expect_equal(scene$attitude0, scenes[[1]]$attitude0, tolerance = 1e-15)
  expect_warning(
    scene_free(c(1, 2, 3), c(0, 0, 1), attitude0 = c(qw = 1, qx = 1, qy = 0, qz = 0)),
    class = "rotdyn_warning_normalised"
  )
  expect_error(
    scene_free(c(1, 2, 3), c(0, 0, 1), attitude0 = attitude_to(q, "matrix")),
    class = "rotdyn_error_type"
  )
})

test_that("a body turned in its own axes moves as the same body", {
  turn <- rotation_about(c(1, -2, 0.5), angle_rad = 1.1)
  moments <- c(1, 2, 2.7)
  omega <- c(0.3, 1.2, -0.4)
  own <- turn %*% diag(moments) %*% t(turn)
  times <- c(-3, 0, 1, 25)
  plain <- trajectory(scene_free(moments, omega), times)
  turned <- trajectory(
    scene_free((own + t(own)) / 2, as.vector(turn %*% omega), attitude0 = t(turn)), times
  )
  expect_equal(
    turned$angular_momentum_y_kg_m2_per_s, plain$angular_momentum_y_kg_m2_per_s, tolerance = 1e-13
  )
  expect_equal(
    turned$omega_space_z_rad_per_s, plain$omega_space_z_rad_per_s, tolerance = 1e-12
  )
  # own axes to space: the principal axes there, after the turn
  back <- attitude_compose(turned, attitude_from(turn, "matrix"))
  expect_lt(max(attitude_difference(back, plain)), 1e-12)
  expect_gt(trajectory_run(turned)$info$errors[["attitude"]], max(attitude_difference(back, plain)))
})

test_that("moments and tensors with units, and six numbers, are read or refused", {
  expect_error(scene_free(1:6 + 0, c(0, 0, 1)), class = "rotdyn_error_size")
  skip_if_not_installed("units")
  moments <- units::set_units(c(1, 2, 2.5), "kg*m^2")
  expect_identical(
    scene_free(moments, c(0, 0, 1))$moment_of_inertia_kg_m2, c(1, 2, 2.5)
  )
  expect_error(
    scene_free(units::set_units(1:6 + 0, "kg*m^2"), c(0, 0, 1)), class = "rotdyn_error_size"
  )
  expect_error(spin_stability(units::set_units(1:6 + 0, "kg*m^2")), class = "rotdyn_error")
})

test_that("two rows of a torque table at one time make a jump", {
  # A ball under 2 N m until 1 s, then 6 N m until 3 s: L by hand.
  table <- data.frame(
    time_s = c(0, 1, 1, 3, 3), x_n_m = 0, y_n_m = 0, z_n_m = c(2, 2, 6, 6, 1)
  )
  scene <- scene_free(c(2, 2, 2), c(0, 0, 0), torque = table)
  for (model in c("free_rk8pd", "free_radau")) {
    motion <- trajectory(scene, c(0, 0.5, 1, 2, 3, 4), model = model)
    expect_equal(motion$angular_momentum_z_kg_m2_per_s, c(0, 1, 2, 8, 14, 14), tolerance = 1e-9)
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
  motion <- trajectory(scene, c(0, 0.5, 1, 2, 3, 4))
  expect_equal(augment(motion)$power_w, c(2, 2, 6, 6, 1, 0) * c(0, 0.5, 1, 4, 7, 7),
    tolerance = 1e-9)
  # The same as a step of two functions, and as a motor of a rotor.
  motor <- data.frame(time_s = c(0, 1, 1, 3), torque_n_m = c(2, 2, 6, 6))
  wheel <- rotor(c(0, 0, 1), 0.01, 0, motor)
  driven <- trajectory(scene_free(c(4, 4, 2), c(0, 0, 0), rotors = wheel), c(0, 1, 2, 3))
  expect_equal(driven$angular_momentum_z_kg_m2_per_s, double(4), tolerance = 1e-9)
  expect_equal(driven$omega_z_rad_per_s, -c(0, 2, 8, 14) / 1.99, tolerance = 1e-9)
  expect_error(
    scene_free(c(1, 2, 3), c(0, 0, 1), torque = table[5:1, ]), class = "rotdyn_error_time"
  )
  skip_if_not_installed("yyjsonr")
  expect_equal(read_scene(write_scene(scene))$knots, scene$knots)
})

test_that("attitudes of unit length come back from text with their bits", {
  skip_if_not_installed("yyjsonr")
  # Of many, scaling to unit length again would change the last bit of some.
  set.seed(1)
  for (i in 1:100) {
    q <- stats::rnorm(4)
    scene <- scene_free(c(1, 2, 3), c(0, 0, 1), attitude0 = q / sqrt(sum(q^2)))
    expect_identical(read_scene(write_scene(scene))$attitude0, scene$attitude0)
  }
})

test_that("the length of an attitude at the start has one rule", {
  of <- function(attitude) scene_free(c(1, 2, 3), c(0, 0, 1), attitude0 = attitude)$attitude0
  half <- sqrt(0.5)
  said <- "rotdyn_warning_normalised"
  for (long in list(c(2, 2, 0, 0), c(qw = 2, qx = 2, qy = 0, qz = 0), c(1, 1, 0, 0) * 1e-9,
                    c(1, 1, 0, 0) * half * (1 + 1e-9))) {
    expect_warning(q <- of(long), class = said)
    expect_equal(q, c(half, half, 0, 0), tolerance = 1e-15)
  }
  expect_no_warning(of(c(1, 1, 0, 0) * half * (1 + 1e-13)))
  turn <- rotation_about("x", angle_deg = 90)
  expect_warning(q <- of(turn * (1 + 1e-8)), class = said)
  expect_equal(q, c(half, half, 0, 0), tolerance = 1e-8)
  expect_error(of(turn * (1 + 1e-5)), class = "rotdyn_error_value")
  expect_error(of(-turn), "reflection", class = "rotdyn_error_value")
  expect_error(of(c(0, 0, 0, 0)), class = "rotdyn_error_value")
  expect_error(of(c(1, Inf, 0, 0)), class = "rotdyn_error_value")
  expect_error(of(c(1, NA, 0, 0)), class = "rotdyn_error_value")
  expect_error(of(1:3), class = "rotdyn_error_type")
  expect_error(of("x"), class = "rotdyn_error_type")
})

test_that("moments that a body just has, and just has not", {
  # A sum of two moments may exceed the third by rounding alone.
  expect_no_warning(scene_free(c(1, 1, 2 * (1 + 1e-13)), c(0, 0, 1)))
  expect_warning(
    scene_free(c(1, 1, 2 * (1 + 1e-10)), c(0, 0, 1)), class = "rotdyn_warning_inertia"
  )
})

test_that("steps of a run through the start are those of its longer half", {
  scene <- scene_free(c(1, 2, 3), c(0.1, 1, 0.2))
  step <- function(time_s) {
    motion <- suppressWarnings(trajectory(scene, time_s, 1, model = "free_split"))
    attr(motion, "run")$info$step_s
  }
  expect_identical(step(c(-10, 0, 0.1)), step(c(-10, -1)))
  expect_identical(step(c(-0.1, 0, 10)), step(c(1, 10)))
})

test_that("a law reads the attitude from body to space", {
  # A torque constant in space, given in body axes: L_x = 0.1 t whatever the body does.
  law <- function(time_s, omega_rad_per_s, attitude) {
    w <- attitude[1]
    x <- attitude[2]
    y <- attitude[3]
    z <- attitude[4]
    0.1 * c(1 - 2 * (y^2 + z^2), 2 * (x * y - w * z), 2 * (x * z + w * y))
  }
  quarter <- c(cos(pi / 8), sin(pi / 8), 0, 0)
  scene <- scene_free(c(2, 2, 2), c(0, 1, 2), attitude0 = quarter, torque = law)
  motion <- trajectory(scene, c(0, 1, 3))
  momentum <- motion$angular_momentum_x_kg_m2_per_s
  expect_equal(momentum - momentum[1], c(0, 0.1, 0.3), tolerance = 1e-8)
})

test_that("an attitude is numbers: no text, no object of another class", {
  start <- function(attitude0) scene_free(c(1, 2, 2.5), c(0, 0, 1), attitude0 = attitude0)
  for (wrong in list(c("1", "0", "0", "0"), structure(c(1, 0, 0, 0), class = "other"))) {
    expect_error(start(wrong), "attitude0", class = "rotdyn_error")
  }
})

test_that("steps of fixed length balance over rows on both sides of the start", {
  set.seed(5)
  for (i in 1:40) {
    body <- scene_free(
      stats::runif(3, 0.5, 1), stats::rnorm(3), resistance = resistance(damping_per_s = 0.3),
      start_s = -1
    )
    shown <- audit(trajectory(body, c(-2.2, -1, 0.3, 1.5), model = "free_rk4", accuracy = 1))
    expect_identical(shown$verdict, rep("balanced", 5))
  }
})
