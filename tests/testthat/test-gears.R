test_that("inertia is reflected with the square of the ratio", {
  expect_equal(reflected_inertia(0.5, c(1, 5, -10, NA)), c(0.5, 0.02, 0.005, NA))
  expect_equal(reflected_inertia(1e-250, 1e-200), 1e150)
  expect_error(reflected_inertia(1, 0), class = "rotdyn_error_value")
  expect_error(reflected_inertia(-1, 2), class = "rotdyn_error_value")
})

test_that("a train reflects everything to the first shaft", {
  train <- gear_train(c(0.01, 0.5, 8), c(5, -2), efficiency = c(0.9, 0.8),
                      torque_n_m = c(2, -4, -30), viscous_n_m_s = c(0.1, 0.5, 1))
  expect_named(train, gear_columns)
  expect_equal(train$ratio_to_first, c(1, 5, -10))
  expect_equal(train$reflected_inertia_kg_m2, c(0.01, 0.02, 0.08))
  expect_equal(train$reflected_viscous_n_m_s, c(0.1, 0.02, 0.01))
  # The load of 4 N m costs more than 4/5; the third shaft turns backwards, so -30 N m drives it.
  expect_equal(train$reflected_torque_n_m, c(2, -0.8 / 0.9, 3 * 0.72))
  expect_error(gear_train(1:3, c(2, 0)), class = "rotdyn_error_value")
  expect_error(gear_train(1:3, 2, efficiency = 1.1), class = "rotdyn_error_value")
  expect_error(gear_train(1:3, 1:3), class = "rotdyn_error_size")
})

test_that("the scene of a train is its first shaft", {
  scene <- scene_gears(c(0.01, 0.5), 5, torque_n_m = c(2, -4), viscous_n_m_s = c(0, 0.5),
                       omega0_rad_per_s = 3)
  expect_s3_class(scene, "rot_scene_axle")
  expect_equal(scene$moment_of_inertia_kg_m2, 0.03)
  expect_equal(scene$resistance$viscous_n_m_s, 0.02)
  # 1.2 N m on 0.03 kg m^2 with 0.02 N m s, from 3 rad/s, 1.5 s on: 60 - 57/e
  motion <- trajectory(scene, 1.5)
  expect_equal(motion$omega_rad_per_s, 60 - 57 * exp(-1), tolerance = 1e-14)
})

# By hand: forward 0.8 N m load over the efficiency, backward it drives. 0.72/0.03 = 24 rad/s^2.
test_that("the loss takes from the side that drives, and the audit has it", {
  back <- trajectory(
    scene_gears(c(0.01, 0.5), 5, efficiency = 0.9, torque_n_m = c(0, -4)), c(0, 1, 2)
  )
  expect_equal(back$omega_rad_per_s, c(0, -24, -48), tolerance = 1e-14)
  expect_equal(back$applied_torque_n_m, rep(-0.8, 3))
  expect_equal(back$net_torque_n_m, rep(-0.72, 3))
  a <- audit(back)
  expect_equal(a$verdict, c("balanced", "balanced"))
  expect_equal(a$supplied[1], 38.4, tolerance = 1e-13)
  terms <- a$terms[[1]]
  expect_equal(terms$value[terms$term == "loss of the gears"], 3.84, tolerance = 1e-13)
  ledger <- augment(back)
  expect_equal(ledger$work_j, c(0, 9.6, 38.4), tolerance = 1e-13)
  expect_equal(ledger$dissipated_j, c(0, 0.96, 3.84), tolerance = 1e-13)
})

test_that("no train creates energy, whichever way it turns", {
  set.seed(4)
  for (i in 1:40) {
    n <- sample(2:4, 1)
    torque <- round(rnorm(n), 2) * 3
    scene <- scene_gears(
      runif(n, 0.01, 1), ratios = sample(c(-5, -2, 0.5, 2, 7), n - 1L, TRUE),
      efficiency = runif(n - 1L, 0.4, 1), torque_n_m = torque, viscous_n_m_s = runif(n, 0, 0.1),
      omega0_rad_per_s = rnorm(1, sd = 3), start_s = 1
    )
    x <- trajectory(scene, c(1, 1.1, 1.7, 3, 9))
    expect_equal(audit(x)$verdict, c("balanced", "balanced"))
    # What the torques outside do is their sum times the angle; the loss takes from it.
    work <- scene$gears$applied_n_m * (x$theta_rad[5] - x$theta_rad[1])
    expect_equal(augment(x)$work_j[5], work, tolerance = 1e-12)
    expect_true(all(diff(augment(x)$dissipated_coulomb_j) >= -1e-12))
    integrated <- trajectory(scene, c(1, 1.1, 1.7, 3, 9), model = "axle_rk8pd")
    expect_equal(integrated$omega_rad_per_s, x$omega_rad_per_s, tolerance = 1e-8)
    expect_equal(audit(integrated)$verdict, c("balanced", "balanced"))
  }
})

test_that("a train whose loss exceeds its torques stays at rest, and one without loss has none", {
  locked <- scene_gears(
    c(0.01, 0.5, 0.2), c(50, -20), efficiency = 0.5, torque_n_m = c(1, -4, 3000)
  )
  x <- trajectory(locked, 0:3)
  expect_equal(x$omega_rad_per_s, rep(0, 4))
  expect_equal(x$applied_torque_n_m, rep(1 - 0.08 - 3, 4))
  expect_equal(x$net_torque_n_m, rep(0, 4))
  expect_output(print(locked), "gears +loss of")
  expect_null(scene_gears(c(1, 2), 3, torque_n_m = c(1, 0))$gears)
  lossless <- trajectory(scene_gears(c(1, 2), 3, torque_n_m = c(1, 0)), 1)
  expect_equal(run_of(lossless)$model, "axle_linear")
})

test_that("a gear train prints its shafts with their ratios", {
  scene <- scene_gears(c(0.01, 0.5, 2), ratios = c(5, -2), torque_n_m = c(1, 0, 0))
  shown <- capture.output(print(scene))
  expect_equal(shown[1], "<rot_scene> a gear train")
  expect_match(shown[2], "^  shaft 1     0.01 kg m\\^2, ratio to the first 1$")
  expect_match(shown[3], "^  shaft 2     0.5 kg m\\^2, ratio to the first 5$")
  expect_match(shown[4], "^  shaft 3     2 kg m\\^2, ratio to the first -10$")
  expect_match(shown, "inertia     0.05 kg m\\^2 about the first shaft", all = FALSE)
  expect_equal(capture.output(print(scene_axle(1)))[1], "<rot_scene> a body on a fixed axle")
})

test_that("a ratio that nothing uses, and a torque that stands for several, are refused", {
  expect_error(scene_gears(20, 60), class = "rotdyn_error_size")
  expect_error(gear_train(20, 60), class = "rotdyn_error_size")
  expect_equal(scene_gears(20, numeric())$moment_of_inertia_kg_m2, 20)
  e <- expect_error(scene_gears(c(1, 9), 3, torque_n_m = 2), class = "rotdyn_error_size")
  expect_match(conditionMessage(e), "c(2, 0)", fixed = TRUE)
  expect_equal(scene_gears(c(1, 9), 3, torque_n_m = 0)$torque$outside, c(0, 0))
  e <- expect_error(scene_gears(c(1, 9), ratios = c(1, 3)), class = "rotdyn_error_size")
  expect_match(conditionMessage(e), "length 1.", fixed = TRUE)
  expect_no_match(conditionMessage(e), "or")
})

test_that("every shaft of a train has its angle and rate", {
  scene <- scene_gears(
    c(0.01, 0.5, 2), ratios = c(5, -2), torque_n_m = c(2, 0, 0), theta0_rad = 1
  )
  x <- trajectory(scene, 0:3)
  # By hand: alpha = 2/(0.01 + 0.5/25 + 2/100) = 40, N = 5 and -10.
  expect_equal(x$omega_2_rad_per_s, 40 * 0:3 / 5, tolerance = 1e-15)
  expect_equal(x$omega_3_rad_per_s, -40 * 0:3 / 10, tolerance = 1e-15)
  expect_equal(x$theta_3_rad, -(1 + 20 * (0:3)^2) / 10, tolerance = 1e-15)
  expect_equal(predict(x, 0.5)$theta_2_rad, (1 + 20 * 0.25) / 5, tolerance = 1e-15)
  # omega_3 = -4 t
  got <- when(scene, omega_3_rad_per_s = -2)
  expect_equal(got$time_s, 0.5, tolerance = 1e-14)
  expect_equal(got$direction, "down")
  expect_error(when(scene, omega_4_rad_per_s = 1), class = "rotdyn_error_value")
  expect_null(trajectory(scene_axle(1), 0:1)[["omega_2_rad_per_s"]])
  forged <- scene
  forged$train$ratio_to_first <- NULL
  expect_error(trajectory(forged, 1), class = "rotdyn_error_type")
  skip_if_not_installed("units")
  again <- when(scene, omega_3_rad_per_s = units::set_units(-60 / pi, "rpm"))
  expect_equal(again$time_s, 0.5, tolerance = 1e-14)
})

# By hand in 40 digits (mpmath): backward, -6.3 N m and 7.1/1.6/0.71 N m nearly cancel.
test_that("the error of a train covers the rounding of its sums", {
  scene <- scene_gears(
    c(0.66, 0.07), 1.6, efficiency = 0.71, torque_n_m = c(-6.3, 7.1), omega0_rad_per_s = 0.2
  )
  motion <- trajectory(scene, c(0.5, 2))
  errors <- attr(motion, "run")$info$errors
  expect_lte(
    max(abs(motion$theta_rad - c(-0.003209704445708827266, -0.1348414898182801409))),
    errors[["theta"]]
  )
  expect_lte(
    max(abs(motion$omega_rad_per_s - c(-0.03319666952397363122, -0.1423123776394547870))),
    errors[["omega"]]
  )
  expect_lt(attr(motion, "run")$info$error, 1e-12)
  still <- trajectory(scene_gears(c(1, 2), 3, efficiency = 0.5, torque_n_m = c(1, -3)), 0:1)
  expect_equal(attr(still, "run")$info$error, 0)
})
