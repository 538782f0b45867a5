# Gyrostats and reaction wheels. Reference values: mpmath.odefun(), Taylor series at 40 digits.
off_attitude <- function(motion, q) {
  q <- matrix(q, ncol = 4, byrow = TRUE)
  q <- q / sqrt(rowSums(q^2))
  want <- data.frame(qw = q[, 1], qx = q[, 2], qy = q[, 3], qz = q[, 4])
  max(attitude_difference(motion, want))
}

test_that("a symmetric gyrostat is exact, driven or free of friction", {
  for (torque in list(NULL, 0)) {
    scene <- scene_free(
      c(2, 2, 1), c(0.3, -0.2, 1.1), rotors = rotor(c(0, 0, 1), 0.1, 20, torque)
    )
    motion <- trajectory(scene, c(1, 8))
    expect_identical(trajectory_run(motion)$model, "free_gyrostat")
    expect_lt(off_attitude(motion, c(
      0.83738313266012353307, 0.15130089609740503125, -0.057469338102073032797,
      0.522106122502456215,
      -0.1484125166484641331, 0.0065440363409930505126, 0.017449263661188870637,
      -0.9887499298043562604
    )), 4e-15)
    expect_equal(
      motion$omega_x_rad_per_s, c(0.35712723752804911858, -0.35753161355921457861),
      tolerance = 4e-15
    )
    expect_equal(motion$rotor_1_omega_rad_per_s, c(20, 20), tolerance = 1e-15)
    # J (W + omega_z), and L of body and rotor: 1 x 1.1 + 0.1 x 20.
    expect_equal(
      motion$rotor_1_angular_momentum_kg_m2_per_s, c(2.11, 2.11), tolerance = 1e-15
    )
    expect_equal(motion$angular_momentum_z_kg_m2_per_s, c(3.1, 3.1), tolerance = 1e-14)
    expect_identical(unique(audit(motion)$verdict), "balanced")
    # The swapped sense of the rotor is another motion.
    other <- scene_free(
      c(2, 2, 1), c(0.3, -0.2, 1.1), rotors = rotor(c(0, 0, 1), 0.1, -20, torque)
    )
    expect_gt(max(attitude_difference(motion, trajectory(other, c(1, 8)))), 0.1)
  }
})

test_that("the symmetric gyrostat precesses and spins as the formula says", {
  # |L|/A about L, which is fixed; c = (C w + h)/A - w about the axis.
  scene <- scene_free(c(2, 2, 1), c(0.3, 0, 1.1), rotors = rotor(c(0, 0, 1), 0.1, 20))
  t <- c(-50, 0.25, 3, 1e4)
  motion <- trajectory(scene, t)
  spin <- (1.1 + 2) / 2 - 1.1
  expect_equal(motion$omega_x_rad_per_s, 0.3 * cos(spin * t), tolerance = 1e-11)
  expect_equal(motion$omega_y_rad_per_s, 0.3 * sin(spin * t), tolerance = 1e-11)
  # The axis of symmetry goes round L evenly, at its angle.
  axis <- with(motion, cbind(
    2 * (qx * qz + qw * qy), 2 * (qy * qz - qw * qx), 1 - 2 * (qx^2 + qy^2)
  ))
  momentum <- c(0.6, 0, 3.1)
  along <- axis %*% momentum / sqrt(sum(momentum^2))
  expect_equal(as.vector(along), rep(3.1 / sqrt(sum(momentum^2)), 4), tolerance = 1e-14)
})

test_that("a gyrostat of three moments is exact along each axis, after any time", {
  # Taylor series at 40 digits.
  along_z <- trajectory(
    scene_free(c(1, 2, 2.5), c(1, 0.5, -0.25), rotors = rotor("z", 0.125, 12)), c(1, 7)
  )
  expect_identical(trajectory_run(along_z)$model, "free_gyrostat")
  expect_lt(off_attitude(along_z, c(
    0.88783294934259790717,
    0.27322609473113514606,
    0.34688044749238556925,
    -0.1295149040345514815,
    0.52635880413103311063,
    0.5142139137524314835,
    0.46340884000965600651,
    0.49374356422951045822
  )), 4e-15)
  along_x <- trajectory(
    scene_free(c(1, 2, 2.5), c(1, 0.5, -0.25), rotors = rotor("x", 0.125, -6, 0)), c(1, 7)
  )
  expect_identical(trajectory_run(along_x)$model, "free_gyrostat")
  expect_lt(off_attitude(along_x, c(
    0.84079957481626997622,
    0.47961021877933529836,
    0.15052525982410069831,
    -0.20092849271844133781,
    0.32745017984265075893,
    -0.19472207242737383339,
    -0.78163560633744597271,
    0.49386787011922272129
  )), 4e-15)
  expect_equal(
    along_x$rotor_1_omega_rad_per_s, c(-6.0613163801118300865, -6.0007807178243023386),
    tolerance = 4e-15
  )
  expect_identical(unique(audit(along_x)$verdict), "balanced")
  expect_identical(unique(audit(along_z)$verdict), "balanced")
  expect_gt(abs(augment(along_z)$motor_work_j[2]), 0.05)
  # About the middle axis, with a rotor too slow to hold it: the motion repeats.
  t <- c(0, 3, 1e9)
  flips <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01), rotors = rotor("y", 0.05, 60))
  exact <- trajectory(flips, t)
  expect_lt(trajectory_run(exact)$info$error, 1e-12)
  expect_equal(exact$angular_momentum_y_kg_m2_per_s, rep(11, 3), tolerance = 1e-13)
  steps <- trajectory(flips, c(0, 3), model = "free_rk8pd", accuracy = 1e-12)
  expect_lt(max(attitude_difference(exact[1:2, ], steps)), 1e-11)
})

test_that("a rotor along no principal axis, and wheels with motors, agree with Taylor series", {
  oblique <- scene_free(
    c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = rotor(c(2, 1, 2) / 3, 0.1, 12)
  )
  motion <- trajectory(oblique, c(1, 7), accuracy = 1e-12)
  expect_lt(off_attitude(motion, c(
    0.86697247806156361985, 0.3571886804513477935, 0.31087602602147261728,
    -0.15534176929053313269,
    -0.37731371762056535552, 0.88734131387405444008, 0.2493985006230198593,
    0.089778277298044836397
  )), 1e-12)
  wheels <- scene_free(
    c(1, 2, 2.5), c(1, 0.5, -0.3), torque = c(0.1, -0.05, 0.02),
    rotors = list(
      rotor(c(1, 0, 0), 0.1, 5), rotor(c(2, 1, 2) / 3, 0.05, -3, 0.01),
      rotor(c(0, 0, -1), 0.02, 30, function(time_s) -0.04)
    )
  )
  motion <- trajectory(wheels, c(1, 5), accuracy = 1e-12)
  expect_lt(off_attitude(motion, c(
    0.81372442331919634252, 0.54249088227569038458, 0.084937283482853476593,
    -0.19063542015097239992,
    -0.60936343712161966198, -0.18357061958947484921, 0.10406100960265001111,
    -0.76429662788955138465
  )), 1e-12)
  expect_equal(
    motion$rotor_2_omega_rad_per_s, c(-2.7307273490602245822, -0.30304213823733387645),
    tolerance = 1e-12
  )
  expect_equal(
    motion$rotor_3_omega_rad_per_s, c(27.95887425650972771, 19.75778759706601277),
    tolerance = 1e-12
  )
  for (model in c("free_rk4", "free_semi_implicit", "free_euler", "free_radau")) {
    stepped <- suppressWarnings(trajectory(wheels, c(1, 5), model = model))
    said <- trajectory_run(stepped)$info$errors[["attitude"]]
    expect_lt(max(attitude_difference(stepped, motion)), 2 * said + 1e-12)
  }
})

test_that("a wheel spun up turns the body the other way, and back to rest", {
  # Motor torque u on wheel J of a body I with it: omega = -u t/(I - J).
  pulse <- data.frame(time_s = c(0, 5, 5.000001, 10), torque_n_m = c(0.02, 0.02, -0.02, -0.02))
  wheel <- rotor(c(0, 0, 1), 0.01, 0, pulse)
  motion <- trajectory(scene_free(c(4, 5, 2), c(0, 0, 0), rotors = wheel), c(0, 5, 10))
  rate <- -0.02 * 5 / 1.99
  expect_equal(motion$omega_z_rad_per_s, c(0, rate, 0), tolerance = 1e-5)
  expect_equal(motion$rotor_1_omega_rad_per_s[2], 0.1 / 0.01 - rate, tolerance = 1e-12)
  # J w t/I turned, with w the mean speed of the wheel relative to the body.
  turned <- 2 * atan2(motion$qz[3], motion$qw[3])
  expect_equal(turned, rate * 5, tolerance = 1e-5)
  expect_equal(turned, -0.01 * (motion$rotor_1_omega_rad_per_s[2] / 2) * 10 / 2, tolerance = 1e-5)
  expect_identical(unique(audit(motion)$verdict), "balanced")
  expect_lt(max(abs(motion$angular_momentum_z_kg_m2_per_s)), 1e-15)
})

test_that("a rotor stabilises the spin about the middle axis, in its own sense only", {
  least <- function(speed) {
    scene <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01), rotors = rotor(c(0, 1, 0), 0.05, speed))
    min(trajectory(scene, seq(0, 20, by = 0.1), accuracy = 1e-6)$omega_y_rad_per_s)
  }
  # (I2 - I3) Omega + h > 0: h = J W of more than 4.
  expect_lt(least(0), -3.9)
  expect_gt(least(120), 3.99)
  expect_gt(least(90), 3.99)
  expect_lt(least(60), 3)
  # The other way h must be less than -(I2 - I1) Omega = -4.
  expect_lt(least(-60), 3)
})

test_that("energy and momentum balance with torques, damping and motors", {
  scene <- scene_free(
    c(1, 2, 2.5), c(1, 0.5, -0.3), torque = c(0.1, 0, 0.05), torque_axes = "space",
    resistance = resistance(damping_per_s = 0.01), start_s = 1,
    rotors = list(
      rotor(c(1, 0, 0), 0.1, 5), rotor(c(0, 1, 1), 0.05, -3, 0.01),
      rotor(c(0, 0, 1), 0.03, 7, function(time_s, omega_rad_per_s, attitude) {
        -0.2 * omega_rad_per_s[3]
      })
    )
  )
  motion <- trajectory(scene, c(-1, 0, 1, 4, 9))
  found <- audit(motion)
  expect_identical(unique(found$verdict), "balanced")
  more <- augment(motion)
  energy <- motion$rotational_kinetic_energy_j
  expect_equal(
    energy - energy[1], more$work_j + more$motor_work_j - more$dissipated_j, tolerance = 1e-10
  )
  expect_gt(max(abs(more$motor_work_j)), 0.5)
  expect_false(conserved(scene)$conserved[1])
  # Without outer torques all of L stays, whatever the motors do.
  closed <- scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = scene$rotors)
  expect_identical(conserved(closed)$conserved, c(FALSE, TRUE, TRUE, TRUE))
  free <- scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = rotor(c(0, 1, 1), 0.05, -3, 0))
  expect_true(all(conserved(free)$conserved))
  motion <- trajectory(free, seq(0, 9, by = 3), accuracy = 1e-12)
  expect_lt(diff(range(motion$rotational_kinetic_energy_j)), 1e-11)
  # Balances need the rotors' columns.
  lacks <- audit(motion[names(motion) != "rotor_1_omega_rad_per_s"])
  expect_identical(is.na(lacks$verdict), lacks$balance != "quaternion_norm")
})

test_that("the splitting takes rotors of constant momentum", {
  rotors <- list(rotor(c(2, 1, 2) / 3, 0.1, 12), rotor(c(0, 0, 1), 0.05, -3, 0))
  scene <- scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = rotors)
  t <- c(0, 2, 5)
  split <- suppressWarnings(trajectory(scene, t, model = "free_split"))
  exact <- trajectory(scene, t, accuracy = 1e-12)
  said <- trajectory_run(split)$info$errors[["attitude"]]
  expect_lt(said, 1e-3)
  expect_lt(max(attitude_difference(split, exact)), 2 * said)
  expect_identical(unique(audit(split)$verdict), "balanced")
  motors <- scene_free(
    c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = rotor(c(2, 1, 2) / 3, 0.05, -3, 0)
  )
  expect_error(trajectory(motors, t, model = "free_split"), class = "rotdyn_error")
  choice <- choose_model(scene, 0:2)
  expect_identical(choice$model[choice$chosen], "free_rk8pd")
  expect_match(choice$reason[choice$model == "free_gyrostat"], "not along a principal axis")
})

test_that("every verb takes a body with rotors", {
  wheel <- rotor(c(0, 1, 1), 0.05, -3, data.frame(time_s = c(0, 2, 3), torque_n_m = c(0, 1, 0)))
  other <- rotor(c(1, 0, 0), 0.1, 9)
  scene <- scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = list(wheel, other))
  expect_output(print(scene), "motor by 3\\s+knots")
  expect_output(print(wheel), "0.05 kg m^2", fixed = TRUE)
  choice <- choose_model(scene, 0:5)
  expect_identical(choice$model[choice$chosen], "free_rk8pd")
  expect_match(choice$reason[choice$model == "free_exact"], "rotors")
  motion <- trajectory(scene, seq(0, 5, by = 0.5))
  expect_identical(names(motion)[16:19], paste0(
    "rotor_", rep(1:2, each = 2), c("_omega_rad_per_s", "_angular_momentum_kg_m2_per_s")
  ))
  later <- predict(motion, time_s = c(0.25, 3.3))
  expect_equal(
    later$rotor_1_omega_rad_per_s,
    trajectory(scene, c(0.25, 3.3))$rotor_1_omega_rad_per_s, tolerance = 1e-9
  )
  expect_s3_class(summary(motion), "tbl_df")
  expect_true(is.na(summary(motion)$flip_time_s))
  at <- time_when(motion, rotor_1_omega_rad_per_s = 10)
  expect_equal(
    trajectory(scene, at$time_s[1])$rotor_1_omega_rad_per_s, 10, tolerance = 1e-7
  )
  expect_identical(nrow(motion_events(motion)), 0L)
  cost <- suppressWarnings(work_precision(scene, 0:2, accuracies = 1e-6))
  expect_true("free_rk8pd" %in% cost$model)
  expect_error(polhode(scene), class = "rotdyn_error_value")
  drawing <- draw_free(scene)
  expect_true(all(c("W[1]", "W[2]") %in% drawing$quantities$symbol))
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(scene), "ggplot")
  expect_s3_class(ggplot2::autoplot(motion), "ggplot")
})

test_that("scenes with rotors are written and read", {
  wheels <- list(
    rotor(c(0, 3, 4), 0.05, -3, data.frame(time_s = c(0, 2, 3), torque_n_m = c(0, 1, 0))),
    rotor(c(1, 0, 0), 0.1, 9), rotor(c(1, -1, 2), 0.1, 9, 0), rotor(c(1, 1, 1), 0.1, 9, -0.5)
  )
  scene <- scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = wheels)
  expect_identical(scene$breaks_s, c(0, 2, 3))
  skip_if_not_installed("yyjsonr")
  again <- read_scene(write_scene(scene))
  expect_identical(again, scene)
  expect_identical(scene_hash(again), scene_hash(scene))
  of_function <- scene_free(
    c(1, 2, 2.5), c(0, 0, 1), rotors = rotor(c(1, 0, 0), 0.1, 9, function(time_s) 0)
  )
  expect_error(write_scene(of_function), class = "rotdyn_error_scene")
})

test_that("a data frame has a rotor in each row", {
  table <- data.frame(
    axis_x = c(1, 0), axis_y = 0, axis_z = c(0, 2), moment_of_inertia_kg_m2 = 0.1,
    omega_rad_per_s = 4:5
  )
  scene <- scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = table)
  expect_identical(
    scene$rotors, list(rotor(c(1, 0, 0), 0.1, 4), rotor(c(0, 0, 1), 0.1, 5))
  )
  table$torque_n_m <- c(NA, 0.5)
  expect_identical(
    scene_free(c(1, 2, 2.5), c(1, 0.5, -0.3), rotors = table)$rotors[[2]],
    rotor(c(0, 0, 1), 0.1, 5, 0.5)
  )
  expect_null(scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = table[0, ])$rotors)
  expect_error(
    scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = table[-1]), class = "rotdyn_error_type"
  )
})

test_that("bad rotors are refused", {
  expect_error(rotor(c(0, 0, 0), 1, 1), class = "rotdyn_error_value")
  expect_error(rotor(c(0, 1), 1, 1), class = "rotdyn_error_value")
  expect_error(rotor(c(0, NA, 1), 1, 1), class = "rotdyn_error_value")
  expect_error(rotor(c(0, 0, 1), 0, 1), class = "rotdyn_error_value")
  expect_error(rotor(c(0, 0, 1), -1, 1), class = "rotdyn_error_value")
  expect_error(rotor(c(0, 0, 1), 1), class = "rotdyn_error_missing")
  expect_error(rotor(c(0, 0, 1), 1, Inf), class = "rotdyn_error_value")
  expect_error(rotor(c(0, 0, 1), 1, 1, "a"), class = "rotdyn_error_type")
  expect_error(rotor(c(0, 0, 1), 1, 1, function(a, b) 1), class = "rotdyn_error_type")
  expect_error(
    rotor(c(0, 0, 1), 1, 1, data.frame(time_s = c(1, 0), torque_n_m = 1)),
    class = "rotdyn_error_time"
  )
  expect_error(rotor(c(0, 0, 1), 1, 1, speed = 3), class = "rotdyn_error_argument")
  # The body includes the rotors.
  expect_error(
    scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = rotor(c(1, 0, 0), 1.5, 1, 0)),
    class = "rotdyn_error_value"
  )
  expect_warning(
    scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = rotor(c(1, 0, 0), 1.5, 1)),
    class = "rotdyn_warning_inertia"
  )
  expect_error(
    scene_free(c(0, 1, 1), c(0, 0, 1), rotors = rotor(c(0, 1, 0), 0.5, 1)),
    class = "rotdyn_error_value"
  )
  expect_error(scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = 3), class = "rotdyn_error_type")
  one <- rotor(c(1, 0, 0), 0.01, 1)
  expect_identical(rotor("x", 0.01, 1), one)
  expect_error(
    scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = rep(list(one), 17)), class = "rotdyn_error_size"
  )
  forged <- one
  forged$axis <- c(1, 0)
  expect_error(
    scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = forged), class = "rotdyn_error_type"
  )
  wrong <- scene_free(
    c(1, 2, 2.5), c(0, 0, 1), rotors = rotor(c(1, 0, 0), 0.1, 9, function(time_s) "a")
  )
  expect_error(trajectory(wrong, 0:1), class = "rotdyn_error_torque")
  undefined <- scene_free(
    c(1, 2, 2.5), c(0, 0, 1), rotors = rotor(c(1, 0, 0), 0.1, 9, function(time_s) NaN)
  )
  expect_error(trajectory(undefined, 0:1), class = "rotdyn_error")
})

test_that("a turned body with rotors moves as the same body", {
  turn <- rotation_about(c(1, -2, 0.5), angle_rad = 1.1)
  own <- turn %*% diag(c(2, 2, 1)) %*% t(turn)
  omega <- c(0.3, -0.2, 1.1)
  times <- c(-3, 0, 1, 25)
  plain <- trajectory(scene_free(c(2, 2, 1), omega, rotors = rotor(c(0, 0, 1), 0.1, 20)), times)
  turned <- trajectory(scene_free(
    (own + t(own)) / 2, as.vector(turn %*% omega), attitude0 = t(turn),
    rotors = rotor(as.vector(turn %*% c(0, 0, 1)), 0.1, 20)
  ), times)
  back <- attitude_compose(turned, attitude_from(turn, "matrix"))
  off <- max(attitude_difference(back, plain))
  expect_lt(off, 1e-11)
  expect_gt(trajectory_run(turned)$info$errors[["attitude"]], off)
})

test_that("a rotor may have most of the moment about its axis, and not more", {
  expect_s3_class(
    scene_free(c(1, 1, 1), c(0, 0, 1), rotors = rotor("z", 0.9, 1, 0)), "rot_scene_free"
  )
  expect_error(
    scene_free(c(1, 1, 1), c(0, 0, 1), rotors = rotor("z", 1.1, 1, 0)), "more moment",
    class = "rotdyn_error_value"
  )
})

test_that("rotors that are none are refused by name", {
  expect_error(
    scene_free(c(1, 2, 2.5), c(0, 0, 1), rotors = list(1)), "made of .*rotor",
    class = "rotdyn_error_type"
  )
})

test_that("the angular momentum of several rotors is the sum of J W a", {
  scene <- scene_free(
    c(1, 2, 2.5), c(1, 0, 0),
    rotors = list(rotor(c(0, 0, 1), 0.1, 20), rotor(c(1, 0, 0), 0.2, -3))
  )
  expect_equal(rotor_momentum(scene), c(-0.6, 0, 2))
})

test_that("what a body has without its rotors may be little, not less than rounding", {
  wheeled <- function(left) {
    scene <- scene_free(c(1, 2, 2.5), omega0_rad_per_s = c(0, 0, 1), rotors = rotor(
      c(0, 0, 1), 2.5 * (1 - left), omega_rad_per_s = 3, torque = 1e-12
    ))
    suppressWarnings(trajectory(scene, 0))
  }
  for (left in c(1e-3, 1e-8, 1e-11)) {
    expect_equal(wheeled(left)$omega_z_rad_per_s, 1, tolerance = 1e-15 / left)
  }
  expect_error(wheeled(1e-13), "without them", class = "rotdyn_error_value", ignore.case = TRUE)
})

test_that("the closed form holds close to a tumbling past both ends of the rotor's axis", {
  beside <- function(omega_x) {
    glance(trajectory(
      scene_free(c(1, 3, 2), c(omega_x, 0, 1), rotors = rotor(c(0, 0, 1), 0.2, 1e-12)), c(0, 50)
    ))
  }
  near <- beside(1e-5)
  expect_equal(near$model, "free_gyrostat")
  expect_lt(near$error, 1e-12)
  # At both ends themselves it has no digits: the motion is integrated.
  expect_equal(beside(1e-7)$model, "free_rk8pd")
})
