test_that("passages and peaks of a sampled sinusoid, also with samples at 0", {
  time <- seq(0, 10, by = 0.1)
  found <- find_passages(time, 2 * cos(2 * pi * time / 2.5 + 0.3))
  want <- (0.5 * pi - 0.3 + pi * 0:7) * 2.5 / (2 * pi)
  expect_equal(found$passages, want, tolerance = 1e-4)
  expect_equal(abs(found$peaks), rep(2, 7), tolerance = 1e-3)
  expect_equal(found$times, (want[-1] + want[-8]) / 2, tolerance = 1e-3)
  expect_true(all(found$sound))
  # Counts: two samples of 0 at a passage, in a row.
  counts <- c(rep(c(3, 2, 0, 0, -2, -3, -2, 0, 0, 2), 6), 3)
  found <- find_passages(seq_along(counts) - 1, counts)
  expect_equal(found$passages, seq(2.5, by = 5, length.out = 12), tolerance = 1e-6)
})

test_that("growth is found where it exceeds the scatter, and only there", {
  set.seed(1)
  time <- 1:40
  flat <- 1 + stats::rnorm(40, sd = 0.02)
  expect_null(find_amplification(time, flat))
  expect_null(find_amplification(time, flat * exp(-time / 30)))
  grown <- find_amplification(time, flat + pmin(pmax(time - 10, 0), 20) / 10)
  expect_lt(grown[1], 13)
  expect_gt(grown[2], 28)
  # An offset of the centre makes neighbours differ, no more.
  expect_null(find_amplification(time, 1 + 0.2 * (-1)^time))
})

test_that("the peaks of exact motions show the losses, with errors that cover the quartics'", {
  losses <- list(
    decay_per_s = resistance(0.1), coulomb_rad_per_s2 = resistance(coulomb_n_m = 0.2),
    quadratic_per_rad = resistance(quadratic_n_m_s2 = 0.05)
  )
  truth <- c(0.05, 0.2, 0.05)
  for (i in 1:3) {
    scene <- scene_axle(1, torque_spring(25), losses[[i]], theta0_rad = 1)
    x <- trajectory(scene, seq(0, 12, by = 0.02))
    for (rate in c(FALSE, TRUE)) {
      record <- x[c("time_s", if (rate) "omega_rad_per_s" else "theta_rad")]
      kind <- names(swing_parts)[match(names(losses)[i], swing_parts)]
      found <- fit_swing(record, "spring", losses = kind)$damping[[names(losses)[i]]]
      expect_equal(found$value, truth[i], tolerance = 0.01)
      expect_lt(abs(found$value - truth[i]), 5 * found$u)
    }
  }
})

test_that("a torsion pendulum may swing beyond half a turn", {
  x <- trajectory(scene_axle(1, torque_spring(25), resistance(0.05), theta0_rad = 7), 0:700 / 50)
  fit <- fit_swing(x[c("time_s", "theta_rad")], "spring", losses = "viscous")
  expect_equal(fit$damping$decay_per_s$value, 0.025, tolerance = 1e-4)
  expect_gt(fit$swings$amplitude_rad[fit$swings$used][1], pi)
})

test_that("columns times correlations of the first order, on either side of 0", {
  x <- cbind(c(1, -2, 0.5, 3), c(0, 1, 1, -1))
  for (rho in c(-0.7, 0, 0.4)) {
    expect_equal(correlated_first_order(x, rho), rho^abs(outer(1:4, 1:4, "-")) %*% x)
  }
})

test_that("slow noise moves peaks to one side: the error of a loss is that, not the heights'", {
  set.seed(5)
  scores <- replicate(40, {
    time <- seq(0, 60, by = 0.1)
    slow <- as.vector(stats::filter(stats::rnorm(601, sd = 0.24), 0.97, "recursive"))
    y <- exp(-0.01 * time) * cos(2 * time) + 0.01 * slow
    found <- fit_swing(data.frame(time_s = time, theta_rad = y), "spring", losses = "viscous")
    (found$damping$decay_per_s$value - 0.01) / found$damping$decay_per_s$u
  })
  expect_gt(sqrt(mean(scores^2)), 0.75)
  expect_lt(sqrt(mean(scores^2)), 1.3)
})
