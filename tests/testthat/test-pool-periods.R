test_that("37 student groups: two miscounted, an error between groups", {
  all <- utils::read.csv(shared("data", "measured", "unipi_pendulum_hand_timed_odd.csv"))
  ten <- all[all$oscillations == 10, ]
  got <- pool_periods(ten$time_s, swings = 10, group = ten$group)
  expect_equal(got$groups$group[got$groups$status == "miscounted"], c(9, 35))
  expect_true(all(got$groups$status %in% c("used", "miscounted")))
  expect_equal(got$period_s$value, 1.7594, tolerance = 3e-4)
  expect_gte(got$between_s, 0.004)
  expect_equal(got$birge_ratio, 2.4, tolerance = 0.05)
  # At least that of the scatter between 35 groups.
  expect_gt(got$period_s$u, 0.0009)
  expect_output(print(got), "miscounted")
})

test_that("the error between groups is that of the truth: coverage of the mean", {
  set.seed(8)
  inside <- replicate(300, {
    group <- rep(1:12, each = 5)
    t <- 10 * (1.5 + stats::rnorm(12, sd = 0.006)[group]) + stats::rnorm(60, sd = 0.03)
    p <- pool_periods(t, 10, group)$period_s
    abs(p$value - 1.5) < stats::qt(0.975, p$dof) * p$u
  })
  expect_gt(mean(inside), 0.91)
  expect_lt(mean(inside), 0.99)
})

test_that("exact readings, one group, one reading each", {
  got <- pool_periods(c(10, 10.1, 9.9), 5)
  expect_equal(got$period_s$value, 2)
  expect_gte(got$between_s, 0.03 / 5)
  got <- pool_periods(c(2, 2.01, 1.99, 2.02), 1, group = 1:4, type_b_s = 0)
  expect_equal(got$period_s$value, 2.005)
  expect_equal(got$period_s$u, stats::sd(c(2, 2.01, 1.99, 2.02)) / 2, tolerance = 1e-6)
})

test_that("pivots along a rod: k, g, and the one that does not fit", {
  d <- seq(0.1, 0.5, by = 0.05)
  t <- 2 * pi * sqrt((1 / 12 + d^2) / (9.81 * d))
  exact <- fit_pivots(t, d)
  expect_equal(exact$gyration_square_m2$value, 1 / 12, tolerance = 1e-9)
  expect_equal(exact$gravity_m_per_s2$value, 9.81, tolerance = 1e-9)
  known <- fit_pivots(t, d, gravity_m_per_s2 = 9.81)
  expect_identical(known$gravity_m_per_s2$value, 9.81)
  expect_identical(known$gravity_m_per_s2$u, 0)
  expect_equal(known$gyration_square_m2$value, 1 / 12, tolerance = 1e-9)
  set.seed(4)
  noisy <- t * (1 + stats::rnorm(9, sd = 1e-3))
  noisy[4] <- noisy[4] * 1.03
  got <- fit_pivots(noisy, d)
  expect_equal(which(got$pivots$status == "outlier"), 4L)
  expect_lt(abs(got$gravity_m_per_s2$value - 9.81), 4 * got$gravity_m_per_s2$u)
})

test_that("the compound pendulum of Catania: the outlier is d1", {
  readings <- utils::read.csv(shared("data", "measured",
    "catania_exp4_compound_pendulum_periods.csv"))
  places <- utils::read.csv(shared("data", "measured",
    "catania_exp4_compound_pendulum_distances.csv"))
  # Half swings in ms; the rod of 1 m has its centre at 50 cm.
  period <- 2 * as.double(tapply(readings$time, readings$distance, mean)[places$dimension]) / 1000
  got <- fit_pivots(period, places$value / 100 - 0.5)
  expect_equal(which(got$pivots$status == "outlier"), 1L)
  expect_gt(got$pivots$residual[1], 5)
})

test_that("errors are the package's own", {
  expect_error(pool_periods(), class = "rotdyn_error_missing")
  expect_error(pool_periods(1), class = "rotdyn_error_size")
  expect_error(pool_periods(c(1, -1)), class = "rotdyn_error_value")
  expect_error(pool_periods(c(1, 2), group = 1), class = "rotdyn_error_size")
  expect_error(pool_periods(c(1, 2), groups = 1:2), class = "rotdyn_error_argument")
  expect_error(fit_pivots(1:3, 1:2), class = "rotdyn_error_size")
  expect_error(fit_pivots(1:3, 1:3), class = "rotdyn_error_size")
  expect_error(fit_pivots(rep(1, 5), rep(0.3, 5)), class = "rotdyn_error_value")
})

test_that("a pivot that alone determines a coefficient has no deleted residual", {
  # Errors of the distances so large that one pivot has all of the weight.
  got <- expect_no_warning(
    fit_pivots(c(1.92, 3.07, 3.26, 4.05), c(2.03, 1.39, 3.38, 5), distance_u_m = 2.16,
               period_u_s = 0.37)
  )
  expect_false(any(is.nan(got$pivots$residual)))
  sharp <- expect_no_warning(fit_pivots(
    c(2, 2.1, 2.3), c(1, 1.2, 1.4), period_u_s = c(1e-12, 1, 1), gravity_m_per_s2 = 9.81
  ))
  expect_identical(is.na(sharp$pivots$residual), c(TRUE, FALSE, FALSE))
})

test_that("errors that give no weights are refused, not taken by qr()", {
  d <- c(0.1, 0.2, 0.3, 0.4)
  period <- 2 * pi * sqrt((0.1 + d^2) / (9.81 * d))
  for (u in list(1e-300, c(0, 0, 0, 0.001))) {
    expect_error(fit_pivots(period, d, period_u_s = u), "Each pivot", class = "rotdyn_error_value")
    expect_error(fit_pivots(period, d, distance_u_m = u), class = "rotdyn_error_value")
  }
  # An error of the other kind is enough.
  mixed <- fit_pivots(period, d, period_u_s = c(0, 0, 0, 1e-3), distance_u_m = c(1, 1, 1, 0) / 1e3)
  expect_equal(mixed$gravity_m_per_s2$value, 9.81, tolerance = 1e-9)
  expect_error(fit_pivots(period, d, gravity_m_per_s2 = 1e-300), class = "rotdyn_error_value")
  expect_error(fit_pivots(period, d * 1e-300), class = "rotdyn_error_value")
})
