shared_csv <- function(...) {
  root <- Sys.getenv("ROTDYN_SHARED")
  path <- file.path(root, ...)
  if (!nzchar(root) || !file.exists(path)) skip("no shared reference data")
  path
}

test_that("the exact model holds the 110-digit values to 4e-15 rad", {
  table <- utils::read.csv(shared_csv("refs", "free_rigid_body.csv"))
  worst <- covered <- 0
  for (i in seq_len(nrow(table))) {
    row <- table[i, ]
    # Moments that no body has are in the table, too.
    scene <- suppressWarnings(
      scene_free(c(row$I1, row$I2, row$I3), c(row$w1, row$w2, row$w3)), "rotdyn_warning_inertia"
    )
    motion <- trajectory(scene, row$t, model = "free_exact")
    want <- list(qw = row$q0, qx = row$q1, qy = row$q2, qz = row$q3)
    off <- attitude_difference(motion, want)
    worst <- max(worst, off)
    covered <- covered + (off <= trajectory_run(motion)$info$errors[["attitude"]])
    want <- c(row$w1_t, row$w2_t, row$w3_t)
    apart <- unlist(unclass(motion)[free_rates("")]) - want
    expect_lt(sqrt(sum(apart^2)), 1e-15 * sqrt(sum(want^2)))
  }
  expect_identical(covered, 175)
  expect_lt(worst, 4e-15)
})

test_that("NASA's tumbling brick", {
  table <- utils::read.csv(
    shared_csv("cases", "nesc_atmos02_brick_torquefree", "Atmos_02_sim_01.csv")
  )
  deg <- pi / 180
  brick <- scene_free(c(0.00189422, 0.006211019, 0.007194665), c(10, 20, 30) * deg)
  motion <- trajectory(brick, table$time)
  for (k in 1:3) {
    want <- table[[paste0("bodyAngularRateWrtEi_deg_s_", c("Roll", "Pitch", "Yaw")[k])]]
    expect_lt(max(abs(motion[[free_rates("")[k]]] / deg - want)), 1e-8)
  }
  # Yaw, pitch and roll are against a frame that turns with the Earth, about north at the equator.
  angles <- utils::read.csv(
    shared_csv("cases", "nesc_atmos02_brick_torquefree", "Atmos_02_sim_04.csv")
  )
  earth <- attitude_from(
    data.frame(rx_rad = 7.292115e-5 * motion$time_s, ry_rad = 0, rz_rad = 0), "rotation_vector"
  )
  seen <- attitude_compose(attitude_inverse(earth), motion)
  want <- attitude_from(
    data.frame(
      angle_1_rad = angles$eulerAngle_deg_Yaw * deg,
      angle_2_rad = angles$eulerAngle_deg_Pitch * deg,
      angle_3_rad = angles$eulerAngle_deg_Roll * deg
    ),
    "euler", sequence = "intrinsic zyx"
  )
  expect_lt(max(attitude_difference(seen, want)) / deg, 2e-4)
})

test_that("the rigid body of the test set DETEST, B5", {
  # mpmath, 20 digits: sn, cn, dn (t | m = 0.51) at 1, 10, 20.
  y <- rbind(
    c(0.80220075305636086038, 0.59705439601078856953, 0.81963511114145289907),
    c(0.87789882041975277037, -0.47884617687270583056, 0.77906339097910344877),
    c(-0.93965707987292039619, -0.34211777540007490653, 0.74141265961999530078)
  )
  root <- sqrt(1.53)
  motion <- trajectory(scene_free(c(1, 2, 3), c(root, 0, 1)), c(1, 10, 20))
  expect_equal(motion$omega_x_rad_per_s, root * y[, 2], tolerance = 4e-15)
  expect_equal(motion$omega_y_rad_per_s, root * y[, 1], tolerance = 4e-15)
  expect_equal(motion$omega_z_rad_per_s, y[, 3], tolerance = 4e-15)
})

test_that("symmetric bodies: Kane's closed form, and both senses of precession", {
  table <- utils::read.csv(shared_csv("cases", "symmetric_torquefree_kane_eth", "kane_values.csv"))
  motion <- trajectory(scene_free(c(0.04, 0.04, 0.02), c(2, 3, 4)), table$t)
  want <- list(qw = table$e0, qx = table$e1, qy = table$e2, qz = table$e3)
  expect_lt(max(attitude_difference(motion, want)), 2e-12) # printed from an integration
  expect_equal(motion$omega_x_rad_per_s, table$wx, tolerance = 1e-12)
  # I = (3, 3, 9), L = (0, 5, 7): -14/9 rad/s; I = (3, 9, 9), L = (7, 0, 5): +14/9.
  t <- c(0.3, 2, 11)
  disk <- suppressWarnings(scene_free(c(3, 3, 9), c(0, 5 / 3, 7 / 9)), "rotdyn_warning_inertia")
  short <- trajectory(disk, t)
  expect_equal(3 * short$omega_x_rad_per_s, 5 * sin(-14 / 9 * t), tolerance = 1e-13)
  tall <- trajectory(scene_free(c(3, 9, 9), c(7 / 3, 0, 5 / 9)), t)
  expect_equal(9 * tall$omega_y_rad_per_s, 5 * sin(14 / 9 * t), tolerance = 1e-13)
  # Equal moments about the axes of the spin: constant.
  flat <- trajectory(scene_free(c(2, 3, 3), c(0, 4 / 3, 5 / 3)), t)
  expect_identical(flat$omega_y_rad_per_s, rep(4 / 3, 3))
  # Orekit: against constant spin 5e-6 rad at 0.1 s, 5e-4 at 1 s.
  sat <- trajectory(scene_free(c(3, 4, 5) / 8, c(0.05, 0, 0.04)), c(0.1, 1))
  spin <- attitude_from(cbind(0.05 * c(0.1, 1), 0, 0.04 * c(0.1, 1)), "rotation_vector")
  expect_equal(attitude_difference(sat, spin), c(5e-6, 5e-4), tolerance = 1e-3)
})

test_that("a torque that a function returns", {
  steady <- scene_free(c(1, 2, 2.5), c(0.1, 0, 0.3), torque = c(0.02, 0, 0.01))
  same <- scene_free(c(1, 2, 2.5), c(0.1, 0, 0.3), torque = function(t) c(0.02, 0, 0.01))
  t <- c(0, 3, 7)
  a <- trajectory(steady, t, accuracy = 1e-11)
  b <- trajectory(same, t, accuracy = 1e-11)
  expect_identical(trajectory_run(a)$model, "free_rk8pd")
  expect_lt(max(attitude_difference(a, b)), 1e-10)
  # Against the spin: the torque -c omega of the body's own rates.
  drag <- scene_free(
    c(2, 2, 2), c(0, 0, 3),
    torque = function(time_s, omega_rad_per_s, attitude) {
      stopifnot(abs(sum(attitude^2) - 1) < 1e-12)
      -0.5 * omega_rad_per_s
    }
  )
  slow <- trajectory(drag, c(0, 4))
  expect_equal(slow$omega_z_rad_per_s[2], 3 * exp(-1), tolerance = 1e-9)
  bad <- scene_free(c(1, 2, 3), c(0, 0, 1), torque = function(t) "much")
  expect_error(trajectory(bad, 0:1), class = "rotdyn_error_torque")
  stops <- scene_free(c(1, 2, 3), c(0, 0, 1), torque = function(t) stop("enough"))
  expect_error(trajectory(stops, 0:1), "enough")
  expect_error(trajectory(bad, 0:1, model = "free_exact"), class = "rotdyn_error_model")
})

test_that("torques in space axes turn with the body", {
  # About the axis of the spin of a symmetric body, space and body axes agree.
  at <- attitude_from(c(0.4, 0, 0), "rotation_vector")
  axis <- unlist(attitude_turn(at, c(0, 0, 1)))
  space <- scene_free(
    c(2, 2, 3), c(0, 0, 1), attitude0 = at, torque = 0.3 * axis, torque_axes = "space"
  )
  body <- scene_free(c(2, 2, 3), c(0, 0, 1), attitude0 = at, torque = c(0, 0, 0.3))
  a <- trajectory(space, 0:5)
  b <- trajectory(body, 0:5)
  expect_lt(max(attitude_difference(a, b)), 1e-8)
  expect_equal(a$omega_z_rad_per_s, 1 + 0.1 * (0:5), tolerance = 1e-9)
})

test_that("steps of fixed length run where they are named, and say what they are worth", {
  scene <- scene_free(c(1, 2, 3), c(0.3, 2, 0.4))
  t <- seq(-2, 10, by = 0.5)
  choice <- choose_model(scene, t, accuracy = 1)
  steppers <- c("free_euler", "free_semi_implicit", "free_rk4", "free_split")
  expect_false(any(choice$applies[choice$model %in% steppers]))
  expect_match(choice$reason[choice$model == "free_rk4"], "only where it is named")
  exact <- trajectory(scene, t)
  for (id in steppers) {
    motion <- trajectory(scene, t, model = id, accuracy = 1, step_s = 0.002)
    run <- trajectory_run(motion)
    expect_identical(c(run$model, run$info$method), c(id, sub("^free_", "", id)))
    off <- max(attitude_difference(motion, exact))
    expect_lte(off, 1.1 * run$info$errors[["attitude"]])
    expect_match(tibble::tbl_sum(motion)[["Steps"]], "0.002 s")
    # The same steps, asked later.
    expect_identical(predict(motion, 3.5)$qx, motion$qx[motion$time_s == 3.5])
    expect_identical(audit(motion)$balance[1], "energy")
  }
  # Where no step is asked: 1/64 of a turn at the rate of the start.
  motion <- trajectory(scene, t, model = "free_rk4", accuracy = 1e-3)
  expect_equal(trajectory_run(motion)$info$step_s, 2 * pi / sqrt(0.09 + 4 + 0.16) / 64)
  expect_equal(augment(motion)$dissipated_j, rep(0, length(t)))
  expect_warning(trajectory(scene, t, model = "free_rk4"), class = "rotdyn_warning_accuracy")
  expect_error(trajectory(scene, t, step_s = 0.1), class = "rotdyn_error_model")
  expect_error(
    trajectory(scene, t, model = "free_rk4", step_s = 0), class = "rotdyn_error_value"
  )
  pushed <- scene_free(c(1, 2, 3), c(0.3, 2, 0.4), torque = function(t) c(sin(t), 0, 0.1))
  expect_error(trajectory(pushed, t, model = "free_split"), class = "rotdyn_error_model")
  motion <- trajectory(pushed, t, model = "free_rk4", accuracy = 1, step_s = 0.01)
  want <- trajectory(pushed, t, accuracy = 1e-11)
  expect_lt(max(attitude_difference(motion, want)), 1e-7)
  expect_identical(audit(motion)$verdict, rep("balanced", 5))
  expect_error(
    trajectory(scene, 1e5, model = "free_rk4", accuracy = 1, max_steps = 100),
    class = "rotdyn_error_budget"
  )
})

test_that("a torque function may jump more often than 32 times", {
  law <- function(time_s) c(0, 0, sign(sin(4.9 * time_s)))
  motion <- trajectory(
    scene_free(c(1, 1, 1), c(0, 0, 0), torque = law), seq(0, 40, by = 2)
  )
  turn <- (4.9 * motion$time_s / pi) %% 2
  triangle <- (1 - abs(1 - turn)) * pi / 4.9
  expect_equal(motion$omega_z_rad_per_s, triangle, tolerance = 1e-12)
})

# Without a torque the motion is that of free_exact: a law that only looks must see its attitudes.
test_that("laws of torques and of motors are called with the attitude, not its inverse", {
  seen <- NULL
  look <- function(value) function(time_s, omega_rad_per_s, attitude) {
    seen <<- rbind(seen, c(time_s, omega_rad_per_s, attitude))
    value
  }
  q0 <- attitude_from(c(1, 2, -1, 0.9), "axis_angle")
  moments <- c(1, 2, 2.5)
  omega0 <- c(1, 0.5, 2)
  scenes <- list(
    scene_free(moments, omega0, attitude0 = q0, torque = look(c(0, 0, 0))),
    # No momentum of its own, no torque: it turns with the body.
    scene_free(
      moments, omega0, attitude0 = q0, rotors = rotor(c(0, 0, 1), 1e-9, 0, torque = look(0))
    )
  )
  # With products of inertia: the law is called in the body's axes, not in the principal ones.
  tensor <- matrix(c(3, 0.4, -0.3, 0.4, 4, 0.5, -0.3, 0.5, 5), 3)
  scenes <- c(scenes, list(
    scene_free(tensor, omega0, attitude0 = q0, torque = look(c(0, 0, 0)))
  ))
  for (scene in scenes) {
    seen <- NULL
    trajectory(scene, c(0, 2), 1e-10)
    seen <- seen[order(seen[, 1]), ]
    seen <- seen[!duplicated(seen[, 1]), ]
    inertia <- if (identical(scene, scenes[[3]])) tensor else moments
    free <- trajectory(scene_free(inertia, omega0, attitude0 = q0), seen[, 1])
    q <- as.matrix(as.data.frame(free)[c("qw", "qx", "qy", "qz")])
    expect_gt(nrow(seen), 50)
    expect_lt(max(1 - abs(rowSums(q * seen[, 5:8]))), 1e-6)
    omega <- as.matrix(as.data.frame(free)[sprintf("omega_%s_rad_per_s", c("x", "y", "z"))])
    expect_lt(max(abs(omega - seen[, 2:4])), 2e-3)
  }
})

test_that("any disturbance of the spin about the middle axis is followed to the end", {
  # In quadruple precision: bench/coverage/free.c, `free truth`.
  want <- c(qw = 0, qx = -0.99903063930357305, qy = 0, qz = 0.044020242306171083)
  motion <- trajectory(scene_free(c(1, 2, 3), c(1e-90, 1, 1e-90)), 12345.5)
  last <- motion[nrow(motion), ]
  expect_lt(attitude_difference(want, last), 3e-15)
  expect_lt(attr(motion, "run")$info$errors[["attitude"]], 2e-14)
  # Each decade less takes log(10)/lambda more on either side, lambda = 1/sqrt(3).
  time_s <- vapply(c(1e-200, 1e-300), function(by) {
    flip_time(c(1, 2, 3), c(by, 1, 0))
  }, 0)
  expect_equal(diff(time_s), 200 * log(10) * sqrt(3), tolerance = 1e-12)
})

test_that("steps of order 1 report at least their error", {
  set.seed(20)
  least <- most <- 1
  for (k in 1:40) {
    scene <- scene_free(
      c(1, 1.6, 2) * stats::runif(1, 0.5, 2), stats::runif(3, -2, 2),
      torque = stats::runif(3, -1, 1)
    )
    # The estimate is of the time in front of a row, too.
    true <- trajectory(scene, seq(0, 1, 0.02), 1e-12)
    for (model in c("free_euler", "free_semi_implicit")) {
      motion <- suppressWarnings(trajectory(scene, true$time_s, model = model, step_s = 0.005))
      ratio <- attr(motion, "run")$info$errors[["attitude"]] /
        max(attitude_difference(true, motion))
      least <- min(least, ratio)
      most <- max(most, ratio)
    }
  }
  expect_gte(least, 1)
  expect_lt(most, 1.6)
})

test_that("fixed steps report at least their error at a row where two runs agree", {
  # A swing: the rates of two runs cross, as their attitudes do.
  swing <- scene_pivot(c(1, 1, 1), c(0.5, 0, 0), mass_kg = 1, centre_m = c(0, 0, -1))
  for (end_s in c(2.04, 2.54)) {
    true <- trajectory(swing, c(0, end_s), 1e-11)
    motion <- suppressWarnings(
      trajectory(swing, c(0, end_s), model = "pivot_euler", step_s = 0.02)
    )
    errors <- attr(motion, "run")$info$errors
    expect_gte(errors[["attitude"]], attitude_difference(true[2, ], motion[2, ]))
    expect_gte(errors[["omega"]], abs(true$omega_x_rad_per_s - motion$omega_x_rad_per_s)[2])
  }
})

test_that("fixed steps that lose the rates know nothing of the attitude", {
  ball <- scene_free(
    c(0.6, 0.6, 0.6), c(0.01, 0, 0), torque = function(time_s) c(1, -2, 0.5) * sin(time_s)
  )
  true <- trajectory(ball, c(0, 1.2), 1e-10)
  motion <- suppressWarnings(trajectory(ball, c(0, 1.2), model = "free_euler", step_s = 1.2))
  expect_gte(
    attr(motion, "run")$info$errors[["attitude"]], attitude_difference(true[2, ], motion[2, ])
  )
})

test_that("a body at rest in equilibrium has no error", {
  hanging <- scene_pivot(c(1, 1.2, 0.5), c(0, 0, 0), mass_kg = 1, centre_m = c(0, 0, -0.1))
  expect_no_warning(motion <- trajectory(hanging, c(0, 0.5, 2)))
  expect_identical(motion$omega_x_rad_per_s, c(0, 0, 0))
  expect_lt(glance(motion)$error, 1e-14)
})

test_that("columns of another number are refused by the C boundary", {
  three <- list(1, 2, 3)
  expect_error(.Call(ffi_free_flips, three[1:2], three), "internal: no columns")
  expect_error(.Call(ffi_free_flips, three, three[1:2]), "internal: no columns")
  expect_error(.Call(ffi_free_flips, c(1, 2, 3), three), "internal: no columns")
  expect_error(.Call(ffi_free_flips, three, c(1, 2, 3)), "internal: no columns")
})

test_that("rounding that two runs have in common counts as error", {
  scene <- scene_free(
    c(0x1.ec5efe23p-1, 0x1.29f5922ep-1, 0x1.7cb136cp-1),
    c(0x1.213e2040e99f8p+0, 0x1.041ee00ebf0cfp+2, 0x1.63d458561196fp+2)
  )
  run <- trajectory(scene, 0x1.d2f86ac64f31ep+5, model = "free_rk8pd", accuracy = 1e-10)
  # Taylor series of 34 digits
  omega <- c(-3.38283439647076337, 6.260834241910560345, -0.10956488032242905)
  error <- max(abs(c(run$omega_x_rad_per_s, run$omega_y_rad_per_s, run$omega_z_rad_per_s) - omega))
  expect_lt(error, trajectory_run(run)$info$errors[["omega"]])
})

test_that("a body that hangs in equilibrium within rounding stays there", {
  scene <- scene_pivot(
    c(1, 1.2, 0.5), c(0, 0, 0),
    mass_kg = 1, centre_m = c(0.06, 0, -0.08),
    attitude0 = rotation_about("y", angle_rad = atan2(0.06, 0.08))
  )
  run <- expect_silent(trajectory(scene, c(0, 1, 1e6)))
  expect_lt(glance(run)$error, 1e-14)
  expect_identical(run$qw, rep(run$qw[1], 3))
  expect_identical(run$omega_y_rad_per_s, c(0, 0, 0))
})
