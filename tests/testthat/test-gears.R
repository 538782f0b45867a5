test_that("inertia is reflected with the square of the ratio", {
  expect_equal(reflected_inertia(0.5, c(1, 5, -10, NA)), c(0.5, 0.02, 0.005, NA))
  expect_equal(reflected_inertia(1e-250, 1e-200), 1e150)
  expect_error(reflected_inertia(1, 0), class = "rotdyn_error_value")
  expect_error(reflected_inertia(-1, 2), class = "rotdyn_error_value")
})

test_that("a train reflects everything to the first shaft", {
  train <- gear_train(c(0.01, 0.5, 8), c(5, -2), efficiency = c(0.9, 0.8), torque = c(2, -4, -30),
    resistance = c(0.1, 0.5, 1))
  expect_named(train, gear_columns)
  expect_equal(train$ratio_to_first, c(1, 5, -10))
  expect_equal(train$reflected_inertia_kg_m2, c(0.01, 0.02, 0.08))
  expect_equal(train$reflected_viscous_n_m_s, c(0.1, 0.02, 0.01))
  # The third shaft turns backwards, so -30 N m drives: 2.4 N m reach the second, which needs 0.8.
  expect_equal(train$reflected_torque_n_m, c(2, -0.8 * 0.9, 3 * 0.72))
  # Alone, the load of 4 N m costs more than 4/5.
  alone <- gear_train(c(0.01, 0.5), 5, efficiency = 0.9, torque = c(2, -4))
  expect_equal(alone$reflected_torque_n_m, c(2, -0.8 / 0.9))
  expect_error(gear_train(1:3, c(2, 0)), class = "rotdyn_error_value")
  expect_error(gear_train(1:3, 2, efficiency = 1.1), class = "rotdyn_error_value")
  expect_error(gear_train(1:3, 1:3), class = "rotdyn_error_size")
})

test_that("the scene of a train is its first shaft", {
  scene <- scene_gears(c(0.01, 0.5), 5, torque = c(2, -4), resistance = c(0, 0.5),
    omega0_rad_per_s = 3)
  expect_s3_class(scene, "rot_scene_axle")
  expect_equal(scene$moment_of_inertia_kg_m2, 0.03)
  expect_equal(axle_resistance(scene)$viscous_n_m_s, 0.02)
  # 1.2 N m on 0.03 kg m^2 with 0.02 N m s, from 3 rad/s, 1.5 s on: 60 - 57/e
  motion <- trajectory(scene, 1.5)
  expect_equal(motion$omega_rad_per_s, 60 - 57 * exp(-1), tolerance = 1e-14)
})

# By hand: backward the load of 0.8 N m drives, and so does its own inertia of 0.02 kg m^2 brake it
# before the mesh: 0.01 a = 0.9 (-0.8 - 0.02 a), a = -0.72/0.028.
test_that("the loss takes from the side that drives, and the audit has it", {
  back <- trajectory(
    scene_gears(c(0.01, 0.5), 5, efficiency = 0.9, torque = c(0, -4)), c(0, 1, 2)
  )
  a <- 0.72 / 0.028
  expect_equal(back$omega_rad_per_s, -a * 0:2, tolerance = 1e-14)
  expect_equal(back$applied_torque_n_m, rep(-0.8, 3))
  expect_equal(back$net_torque_n_m, rep(-0.03 * a, 3), tolerance = 1e-14)
  expect_equal(back$damping_torque_n_m, rep(0.8 - 0.03 * a, 3), tolerance = 1e-13)
  found <- audit(back)
  expect_equal(found$verdict, c("balanced", "balanced"))
  expect_equal(found$supplied[1], 0.8 * 2 * a, tolerance = 1e-13)
  # A tenth of what enters the mesh: the work less the energy of the second shaft.
  terms <- found$terms[[1]]
  loss <- 0.1 * (0.8 * 2 * a - 0.02 * (2 * a)^2 / 2)
  expect_equal(terms$value[terms$term == "loss of the gears"], loss, tolerance = 1e-12)
  ledger <- augment(back)
  expect_equal(ledger$work_j, 0.8 * a * c(0, 0.5, 2), tolerance = 1e-13)
  expect_equal(ledger$dissipated_j, loss * c(0, 0.25, 1), tolerance = 1e-12)
  expect_lt(found$rounding[1], 1e-11)
})

# What a motor gives to a stage, less what its own shaft keeps, enters the mesh; the second shaft
# has the energy that leaves it.
test_that("a mesh lets through the share of the power that its efficiency says, either way", {
  for (eta in c(0.3, 0.9, 0.99)) {
    driven <- trajectory(
      scene_gears(c(0.01, 0.5), 5, efficiency = eta, torque = c(2, 0)), c(0, 3)
    )
    first <- 0.5 * 0.01 * driven$omega_rad_per_s[2]^2
    second <- 0.5 * 0.5 * driven$omega_2_rad_per_s[2]^2
    expect_equal(second, eta * (2 * driven$theta_rad[2] - first), tolerance = 1e-13)
    # Power from the second shaft: its torque's work less its energy enters.
    back <- trajectory(
      scene_gears(c(0.01, 0.5), 5, efficiency = eta, torque = c(0, 7)), c(0, 3)
    )
    first <- 0.5 * 0.01 * back$omega_rad_per_s[2]^2
    second <- 0.5 * 0.5 * back$omega_2_rad_per_s[2]^2
    expect_equal(first, eta * (7 * back$theta_2_rad[2] - second), tolerance = 1e-13)
    # The first shaft braked at 2 N m, the inertia behind drives through the mesh.
    braked <- trajectory(
      scene_gears(c(0.01, 0.5), 5, efficiency = eta, torque = c(-2, 0), omega0_rad_per_s = 50),
      c(0, 0.3)
    )
    change <- function(x, i) x[[i]][2]^2 - x[[i]][1]^2
    first <- 0.5 * 0.01 * change(braked, "omega_rad_per_s")
    second <- 0.5 * 0.5 * change(braked, "omega_2_rad_per_s")
    expect_equal(first + 2 * diff(braked$theta_rad), -eta * second, tolerance = 1e-12)
  }
})

# An independent way: of all sets of power flows, the one whose mesh torques agree with it, by
# linear equations in the acceleration and the mesh torques; integrated by lsoda.
flows_of <- function(omega, sense, J, N, tau, d, eta) {
  n <- length(J)
  for (code in seq_len(2^(n - 1)) - 1) {
    forward <- bitwAnd(code, 2^(seq_len(n - 1) - 1)) > 0
    pass <- ifelse(forward, eta, 1 / eta)
    A <- cbind(J / N^2, matrix(0, n, n - 1))
    for (i in seq_len(n - 1)) A[i + 0:1, 1 + i] <- c(1, -pass[i])
    x <- solve(A, tau / N - d / N^2 * omega)
    power <- x[-1] * sense
    if (all(ifelse(forward, power >= -1e-12, power <= 1e-12))) return(x[1])
  }
  stop("no power flows agree")
}

test_that("trains with losses move as an independent integration", {
  skip_if_not_installed("deSolve")
  set.seed(7)
  compared <- curves <- 0
  for (i in 1:40) {
    n <- sample(2:4, 1)
    J <- runif(n, 0.05, 1)
    ratios <- sample(c(-3, -2, 0.5, 2), n - 1, TRUE)
    N <- cumprod(c(1, ratios))
    tau <- round(rnorm(n), 2) * 3
    d <- runif(n, 0, 0.3) * sample(0:1, n, TRUE)
    eta <- runif(n - 1, 0.4, 0.98)
    sense <- sample(c(-1, 1), 1)
    scene <- scene_gears(
      J, ratios, efficiency = eta, torque = tau, resistance = d, omega0_rad_per_s = sense * 20
    )
    curves <- curves + "curve" %in% core_effects("axle", scene)
    times <- c(0, 0.2, 0.7, 1.5, 4)
    motion <- trajectory(scene, times)
    fine <- trajectory(scene, seq(0, 4, by = 0.01))
    moving <- times < c(fine$time_s[fine$omega_rad_per_s * sense <= 0], Inf)[1]
    if (sum(moving) < 2) next
    truth <- deSolve::lsoda(
      c(0, sense * 20), times[moving], function(t, y, p) {
        list(c(y[2], flows_of(y[2], sense, J, N, tau, d, eta)))
      }, NULL, rtol = 1e-11, atol = 1e-10, maxsteps = 1e5
    )
    expect_equal(motion$omega_rad_per_s[moving], unname(truth[, 3]), tolerance = 1e-8)
    expect_equal(motion$theta_rad[moving], unname(truth[, 2]), tolerance = 1e-8)
    expect_equal(audit(motion)$verdict, c("balanced", "balanced"))
    # The bearings' heat is theirs alone: the integral of the sum of d_i omega_i^2.
    heat <- cumsum(c(0, 0.01 * (fine$omega_rad_per_s[-1]^2 + fine$omega_rad_per_s[-401]^2) / 2))
    expect_equal(
      augment(motion)$dissipated_viscous_j[5], sum(d / N^2) * heat[401], tolerance = 1e-2
    )
    compared <- compared + 1
  }
  expect_gte(compared, 20)
  expect_gte(curves, 5) # power flows that change with the rate
})

test_that("no train creates energy, whichever way it turns", {
  set.seed(4)
  for (i in 1:40) {
    n <- sample(2:4, 1)
    torque <- round(rnorm(n), 2) * 3
    scene <- scene_gears(
      runif(n, 0.01, 1), ratios = sample(c(-5, -2, 0.5, 2, 7), n - 1L, TRUE),
      efficiency = runif(n - 1L, 0.4, 1), torque = torque, resistance = runif(n, 0, 0.1),
      omega0_rad_per_s = rnorm(1, sd = 3), start_s = 1
    )
    x <- trajectory(scene, c(1, 1.1, 1.7, 3, 9))
    expect_equal(audit(x)$verdict, c("balanced", "balanced"))
    # What the torques outside do is their sum times the angle; the loss takes from it.
    work <- sum(torque / cumprod(c(1, scene$ratios))) * (x$theta_rad[5] - x$theta_rad[1])
    expect_equal(augment(x)$work_j[5], work, tolerance = 1e-12)
    expect_true(all(diff(augment(x)$dissipated_coulomb_j) >= -1e-12))
    integrated <- trajectory(scene, c(1, 1.1, 1.7, 3, 9), model = "axle_rk8pd")
    expect_equal(integrated$omega_rad_per_s, x$omega_rad_per_s, tolerance = 1e-8)
    expect_equal(audit(integrated)$verdict, c("balanced", "balanced"))
  }
})

test_that("a train whose loss exceeds its torques stays at rest, and one without loss has none", {
  locked <- scene_gears(
    c(0.01, 0.5, 0.2), c(50, -20), efficiency = 0.5, torque = c(1, -4, 3000)
  )
  x <- trajectory(locked, 0:3)
  expect_equal(x$omega_rad_per_s, rep(0, 4))
  expect_equal(x$applied_torque_n_m, rep(1 - 0.08 - 3, 4))
  expect_equal(x$net_torque_n_m, rep(0, 4))
  expect_output(print(locked), "gears +loss of")
  expect_output(print(locked), "by a mesh of efficiency 0.5", fixed = TRUE)
  without <- scene_gears(c(1, 2), 3, torque = c(1, 0))
  expect_no_match(paste(capture.output(print(without)), collapse = "\n"), "loss of")
  lossless <- trajectory(scene_gears(c(1, 2), 3, torque = c(1, 0)), 1)
  expect_equal(run_of(lossless)$model, "axle_linear")
})

test_that("a gear train prints its shafts with their ratios", {
  scene <- scene_gears(c(0.01, 0.5, 2), ratios = c(5, -2), torque = c(1, 0, 0))
  shown <- capture.output(print(scene))
  expect_equal(shown[1], "<rot_scene> a gear train of 3 shafts")
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
  e <- expect_error(scene_gears(c(1, 9), 3, torque = 2), class = "rotdyn_error_size")
  expect_match(conditionMessage(e), "c(2, 0)", fixed = TRUE)
  expect_equal(scene_gears(c(1, 9), 3, torque = 0)$torque, c(0, 0))
  e <- expect_error(scene_gears(c(1, 9), ratios = c(1, 3)), class = "rotdyn_error_size")
  expect_match(conditionMessage(e), "length 1.", fixed = TRUE)
  expect_no_match(conditionMessage(e), "or")
})

test_that("every shaft of a train has its angle and rate", {
  scene <- scene_gears(
    c(0.01, 0.5, 2), ratios = c(5, -2), torque = c(2, 0, 0), theta0_rad = 1
  )
  x <- trajectory(scene, 0:3)
  # By hand: alpha = 2/(0.01 + 0.5/25 + 2/100) = 40, N = 5 and -10.
  expect_equal(x$omega_2_rad_per_s, 40 * 0:3 / 5, tolerance = 1e-15)
  expect_equal(x$omega_3_rad_per_s, -40 * 0:3 / 10, tolerance = 1e-15)
  expect_equal(x$theta_3_rad, -(1 + 20 * (0:3)^2) / 10, tolerance = 1e-15)
  expect_equal(predict(x, 0.5)$theta_2_rad, (1 + 20 * 0.25) / 5, tolerance = 1e-15)
  # omega_3 = -4 t
  got <- time_when(scene, omega_3_rad_per_s = -2)
  expect_equal(got$time_s, 0.5, tolerance = 1e-14)
  expect_equal(got$direction, "down")
  expect_error(time_when(scene, omega_4_rad_per_s = 1), class = "rotdyn_error_value")
  expect_null(trajectory(scene_axle(1), 0:1)[["omega_2_rad_per_s"]])
  forged <- scene
  forged$ratios[1] <- 7
  expect_error(trajectory(forged, 1), class = "rotdyn_error_type")
  skip_if_not_installed("units")
  again <- time_when(scene, omega_3_rad_per_s = units::set_units(-60 / pi, "rpm"))
  expect_equal(again$time_s, 0.5, tolerance = 1e-14)
})

# By hand in 50 digits: the second shaft drives, stops after 0.043 s; backward, -6.3 N m and
# 7.1/1.6/0.71 N m nearly cancel.
test_that("the error of a train covers the rounding of its sums", {
  scene <- scene_gears(
    c(0.66, 0.07), 1.6, efficiency = 0.71, torque = c(-6.3, 7.1), omega0_rad_per_s = 0.2
  )
  motion <- trajectory(scene, c(0.5, 2))
  errors <- attr(motion, "run")$info$errors
  expect_lte(
    max(abs(motion$theta_rad - c(-0.003155408506263239627, -0.1327365909490490662))),
    errors[["theta"]]
  )
  expect_lte(
    max(abs(motion$omega_rad_per_s - c(-0.03270193114993280305, -0.1400729787737816324))),
    errors[["omega"]]
  )
  expect_lt(attr(motion, "run")$info$error, 1e-12)
  still <- trajectory(scene_gears(c(1, 2), 3, efficiency = 0.5, torque = c(1, -3)), 0:1)
  expect_equal(attr(still, "run")$info$error, 0)
})

# In 40 digits: the second shaft is driven at first, and drives below 2.22 rad/s; the two phases by
# their exponentials.
test_that("the error of a train covers where a power flow changes its direction", {
  truth <- list(
    "0.1" = c(4.2107103928026378795, 2.8397021731923089169, 2.1533370799108014698,
              1.8430412666064132679),
    "1e-11" = c(4.2350022102589418064, 2.8773170844902260592, 2.1707373220602401251,
                1.8572460815084532088),
    "1e-13" = c(4.2350022102612401056, 2.8773170844938528302, 2.1707373220619541164,
                1.8572460815097501079)
  )
  for (loss in names(truth)) {
    motion <- trajectory(scene_gears(
      c(1, 1), 1, efficiency = 1 - as.numeric(loss), torque = c(0, 2), resistance = c(0.1, 1),
      omega0_rad_per_s = 5
    ), c(0.5, 2, 4, 8))
    error <- attr(motion, "run")$info$errors[["omega"]]
    expect_lt(error, 1e-13)
    expect_lte(max(abs(motion$omega_rad_per_s - truth[[loss]])), error)
  }
})

# In 40 digits, as above: two power flows change their direction at 6.0692 and 6.0683 rad/s.
test_that("the error of a train covers two changes of power flows that lie close together", {
  motion <- trajectory(scene_gears(
    c(0.75, 0.73, 1.68), c(1, 1), efficiency = 1 - c(1e-5, 1e-8), torque = c(3.7, 2.8, -6.6),
    resistance = c(1.43, 1.26, 0.75), omega0_rad_per_s = 10
  ), c(0.2, 0.5, 1, 2))
  truth <- c(
    8.0378055416486358, 5.7902528407416813, 3.347565346436594, 1.1077875061826499
  )
  error <- attr(motion, "run")$info$errors[["omega"]]
  expect_lt(error, 1e-13)
  expect_lte(max(abs(motion$omega_rad_per_s - truth)), error)
})

test_that("one torque is of one shaft, and 0 of all", {
  expect_error(
    scene_gears(list(1, 1), ratios = 2, torque = 1), "for each of the 2", class = "rotdyn_error"
  )
  expect_identical(scene_gears(list(1, 1), ratios = 2, torque = 0)$omega0_rad_per_s, 0)
})

test_that("an efficiency is above 0 and at most 1", {
  for (wrong in c(0, 1.01, -0.5)) {
    expect_error(
      scene_gears(list(1, 1, 1), ratios = c(2, 2), efficiency = c(0.9, wrong)),
      "efficiency.*greater than 0 and at most 1", class = "rotdyn_error_value"
    )
  }
})
