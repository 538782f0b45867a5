nut <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01))
driven <- scene_free(
  c(1, 2, 3), c(0.3, 0.2, 1), resistance = resistance(damping_per_s = 0.01),
  torque = c(0.01, 0, 0.02), attitude0 = attitude_from(c(1, 0.2, 0.3), "rotation_vector")
)

test_that("every verb takes a free body", {
  for (scene in list(nut, driven)) {
    motion <- trajectory(scene, 0:20)
    choice <- choose_model(scene, 0:20)
    expect_identical(choice$model[choice$chosen], trajectory_run(motion)$model)
    expect_identical(nrow(summary(motion)), 1L)
    expect_identical(glance(motion), summary(motion))
    again <- predict(motion, c(3.5, NA, 0))
    expect_identical(is.na(again$qw), c(FALSE, TRUE, FALSE))
    expect_lt(attitude_difference(again[3, ], motion[1, ]), 1e-15)
    expect_true(all(motion_events(motion)$event == "flip"))
    first <- time_when(motion, omega_y_rad_per_s = 0)
    expect_lt(abs(predict(motion, first$time_s)$omega_y_rad_per_s), 1e-8)
    expect_identical(nrow(motion[3:5, ]), 3L)
    expect_s3_class(motion[3:5, ], "rot_trajectory")
  }
})

test_that("the audit balances energy, each component of L in space, and the norm", {
  for (motion in list(trajectory(nut, -3:20), trajectory(driven, -3:20),
                      trajectory(scene_free(c(1, 2, 3), c(0.1, 1, 0),
                        resistance = resistance(damping_per_s = 0.2)), 0:9))) {
    report <- audit(motion)
    expect_identical(
      report$balance,
      c("energy", paste0("angular_momentum_", c("x", "y", "z")), "quaternion_norm")
    )
    expect_true(all(report$verdict == "balanced"))
    expect_true(all(report$rounding < 1e-8))
    edited <- motion
    edited$omega_x_rad_per_s[nrow(edited)] <- edited$omega_x_rad_per_s[nrow(edited)] + 1e-6
    expect_identical(audit(edited)$verdict[1], "unbalanced")
    turned <- motion
    turned$qx[1] <- turned$qx[1] + 1e-6
    expect_true("unbalanced" %in% audit(turned)$verdict)
  }
  expect_true(all(is.na(audit(trajectory(nut, double()))$verdict)))
})

test_that("damping: heat and impulse in closed form, and integrated", {
  scene <- scene_free(c(1, 2, 3), c(0.3, 1, 0.2), resistance = resistance(damping_per_s = 0.2))
  exact <- trajectory(scene, 0:10)
  expect_identical(trajectory_run(exact)$model, "free_exact")
  steps <- trajectory(scene, 0:10, model = "free_rk8pd", accuracy = 1e-11)
  expect_lt(max(attitude_difference(exact, steps)), 1e-10)
  a <- augment(exact)
  b <- augment(steps)
  expect_equal(a$dissipated_j, b$dissipated_j, tolerance = 1e-9)
  # T fades as exp(-2 gamma t).
  energy <- exact$rotational_kinetic_energy_j
  expect_equal(energy, energy[1] * exp(-0.4 * (0:10)), tolerance = 1e-14)
  expect_equal(a$dissipated_j, energy[1] - energy, tolerance = 1e-13)
  expect_equal(a$damping_impulse_y_n_m_s, b$damping_impulse_y_n_m_s, tolerance = 1e-9)
  expect_equal(
    exact$angular_momentum_x_kg_m2_per_s, 0.3 * exp(-0.2 * (0:10)), tolerance = 1e-13
  )
})

test_that("power is that of the torque, in any axes", {
  motion <- augment(trajectory(driven, seq(0, 5, 0.01)))
  work <- sum(diff(motion$time_s) * (motion$power_w[-1] + motion$power_w[-501]) / 2)
  expect_equal(motion$work_j[501], work, tolerance = 1e-5)
  knots <- data.frame(time_s = c(0, 1, 2), x_n_m = 0, y_n_m = c(0, 1, 0), z_n_m = 0)
  push <- scene_free(
    c(1, 2, 3), c(0.3, 0.2, 1), torque = knots, torque_axes = "space"
  )
  motion <- augment(trajectory(push, seq(0, 4, 0.005)))
  expect_equal(motion$torque_impulse_y_n_m_s[801], 1, tolerance = 1e-9)
  expect_lt(abs(motion$torque_impulse_x_n_m_s[801]), 1e-12)
  work <- sum(diff(motion$time_s) * (motion$power_w[-1] + motion$power_w[-801]) / 2)
  expect_equal(motion$work_j[801], work, tolerance = 1e-4)
})

test_that("what is conserved follows from what acts", {
  expect_identical(conserved(nut)$conserved, rep(TRUE, 4))
  expect_identical(conserved(driven)$conserved, rep(FALSE, 4))
  lift <- scene_free(c(1, 2, 3), c(0, 1, 0), torque = c(0, 0, 2), torque_axes = "space")
  expect_identical(conserved(lift)$conserved, c(FALSE, TRUE, TRUE, FALSE))
  # In the body's axes the torque turns with the body.
  nose <- scene_free(c(1, 2, 3), c(0, 1, 0), torque = c(0, 0, 2))
  expect_identical(conserved(nose)$conserved, rep(FALSE, 4))
  report <- audit(trajectory(lift, 0:3))
  expect_identical(report$conserved, c(FALSE, TRUE, TRUE, FALSE, NA))
  expect_true(all(report$verdict == "balanced"))
  expect_identical(
    conserved(scene_free(c(1, 2, 3), c(0, 1, 0),
      resistance = resistance(damping_per_s = 1)))$conserved, rep(FALSE, 4)
  )
})

test_that("work_precision() measures the attitude by its angle", {
  table <- work_precision(driven, 0:3, accuracies = c(1e-4, 1e-8), models = "free_rk8pd",
                          batches = 1, min_batch_s = 1e-3)
  expect_true(all(c("attitude_error", "omega_error", "angular_momentum_error") %in% names(table)))
  expect_true(all(table$attitude_error <= table$accuracy))
  expect_false(any(table$covered %in% FALSE))
})

test_that("motions and scenes are drawn", {
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(trajectory(nut, seq(0, 20, 0.1))), "ggplot")
  expect_s3_class(ggplot2::autoplot(audit(trajectory(nut, 0:3))), "ggplot")
})

test_that("an uncertain body says what that does to the attitude", {
  rough <- body_density(
    function(x, y, z) ifelse(x^2 + y^2 + z^2 < 0.01, 1500, 1000),
    domain_box(-c(0.1, 0.2, 0.3), c(0.1, 0.2, 0.3)),
    method = "monte_carlo", max_evaluations = 2e4
  )
  expect_gt(rough$error, 1e-14)
  motion <- trajectory(scene_free(rough, c(0.1, 2, 0.1)), 0:3)
  expect_gt(trajectory_run(motion)$body$effect, 0)
})

# The largest allowance of a motion's balances, over the size of what is balanced of that unit.
allowed <- function(motion) {
  a <- audit(motion)
  size <- vapply(a$terms, function(terms) sum(abs(terms$value)), 0)
  size <- unname(tapply(size, a$unit, max)[a$unit])
  list(all = all(a$verdict == "balanced"), most = max((a$rounding / size)[a$unit != "1"]))
}

test_that("correct forced motions are balanced at every accuracy, by allowances of its size", {
  # Impulses err by more than the momentum does: 4.4 times what was allowed without their own error.
  scene <- scene_free(c(1, 1.5, 2), c(8, 1, 5), torque = c(-2, -12, -2))
  for (accuracy in 10^-(3:12)) {
    got <- allowed(trajectory(scene, c(0, 1), accuracy))
    expect_true(got$all)
    expect_lt(got$most, 3 * accuracy + 1e-12)
  }
  # An impulse is wrong by a ten-thousandth: seen.
  motion <- trajectory(scene, c(0, 1), 1e-8)
  motion$omega_x_rad_per_s[2] <- motion$omega_x_rad_per_s[2] * (1 + 1e-5)
  expect_true("unbalanced" %in% audit(motion)$verdict)
})

test_that("an error of omega far below that of the attitude does not unbalance a correct motion", {
  # The distance of the two runs said 8e-12 for an error of 1e-10 (against a run at 1e-13): the
  # residual was 2.7 times what was allowed.
  pulse <- data.frame(
    time_s = c(0.5871, 0.7016, 0.9863, 1.128), x_n_m = c(0.3413, 0.04663, -0.2326, 0.827),
    y_n_m = c(0.2044, 0.01732, -0.9261, -1.149), z_n_m = c(0.7414, 0.7439, 0.04029, 0.7297)
  )
  scene <- scene_free(
    c(1.354, 0.9843, 1.342), c(2.411, -1.175, -3.176), torque = pulse, torque_axes = "space",
    attitude0 = attitude_from(c(qw = 0.5055, qx = 0.3377, qy = 0.7664, qz = 0.2074) /
      sqrt(0.5055^2 + 0.3377^2 + 0.7664^2 + 0.2074^2), "quaternion", order = "wxyz")
  )
  motion <- trajectory(scene, c(0, 2.005, 2.564, 2.801, 2.984), 1e-4)
  got <- allowed(motion)
  expect_true(got$all)
  expect_lt(got$most, 1e-4)
  motion$omega_x_rad_per_s[5] <- motion$omega_x_rad_per_s[5] * (1 + 1e-7)
  expect_identical(audit(motion)$verdict[1], "unbalanced")
})

test_that("a torque that is a function is called with each row's time, rates and attitude", {
  rows <- data.frame(
    time_s = c(0, 2), omega_x_rad_per_s = 1:2, omega_y_rad_per_s = 3:4, omega_z_rad_per_s = 5:6,
    qw = c(1, 0.5), qx = c(0, 0.5), qy = c(0, -0.5), qz = c(0, 0.5)
  )
  seen <- list()
  law <- function(time_s, omega, attitude) {
    seen[[length(seen) + 1L]] <<- list(time_s, omega, attitude)
    c(time_s, omega[2], attitude[3])
  }
  got <- rotdyn:::free_torque_at(list(torque = law), rows)
  expect_equal(got, rbind(c(0, 3, 0), c(2, 4, -0.5)), ignore_attr = TRUE)
  expect_equal(seen[[2]], list(2, c(2, 4, 6), c(0.5, 0.5, -0.5, 0.5)))
  once <- rotdyn:::free_torque_at(list(torque = function(time_s) c(time_s, 1, 0)), rows)
  expect_equal(once, rbind(c(0, 1, 0), c(2, 1, 0)), ignore_attr = TRUE)
})
