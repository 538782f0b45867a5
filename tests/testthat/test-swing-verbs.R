swing_fit <- function(losses = c("viscous", "quadratic", "coulomb"), offset = 0.1) {
  set.seed(1)
  time <- seq(1, 13, by = 0.04)
  y <- 0.5 * exp(-0.04 * (time - 1)) * cos(5 * (time - 1)) + offset
  y <- y + stats::rnorm(length(time), sd = 0.002)
  fit_swing(data.frame(time_s = time, theta_rad = y), "spring", losses = losses)
}

test_that("predict: the motion without the offset, in the order of the times, with its band", {
  fit <- swing_fit("viscous")
  at <- c(12, 2, 7.5)
  got <- predict(fit, at)
  expect_named(
    got, c("time_s", "theta_rad", "theta_rad_se", "theta_rad_lower", "theta_rad_upper")
  )
  truth <- 0.5 * exp(-0.04 * (at - 1)) * cos(5 * (at - 1))
  expect_true(all(abs(got$theta_rad - truth) < 5 * got$theta_rad_se))
  expect_true(all(got$theta_rad_se < 0.001 & got$theta_rad_se > 1e-5))
  wide <- predict(fit, at, level = 0.99)
  ratio <- stats::qt(0.995, fit$motion$dof) / stats::qt(0.975, fit$motion$dof)
  expect_equal(
    wide$theta_rad_upper - wide$theta_rad, ratio * (got$theta_rad_upper - got$theta_rad)
  )
  expect_equal(predict(fit)$time_s, fit$samples$time_s)
  expect_equal(nrow(predict(fit, double())), 0)
  expect_error(predict(fit, 0.5), class = "rotdyn_error_time")
  expect_error(predict(fit, 2, level = 1), class = "rotdyn_error_value")
  expect_error(predict(fit, 2, band = 1), class = "rotdyn_error_argument")
})

test_that("augment: residuals are measured less fitted, with the scatter put in", {
  fit <- swing_fit()
  rows <- generics::augment(fit)
  expect_equal(rows$residual, rows$measured - rows$fitted)
  expect_within(stats::sd(rows$residual), 0.002, 0.1)
  expect_lt(abs(mean(rows$residual)), 5e-4)
})

test_that("glance: one row, NA for what was not fitted", {
  all <- generics::glance(swing_fit())
  expect_equal(nrow(all), 1)
  fit <- swing_fit("viscous")
  one <- generics::glance(fit)
  expect_equal(one$decay_per_s, fit$decay_per_s$value)
  expect_equal(one$period_s_se, fit$period_s$u)
  expect_true(is.na(one$quadratic_per_rad) && is.na(one$coulomb_rad_per_s2_se))
  expect_false(anyNA(all[c("quadratic_per_rad", "coulomb_rad_per_s2", "law_p")]))
  expect_true(one$complete)
})

test_that("as_scene: its trajectory is the fitted motion, at any inertia", {
  fit <- swing_fit()
  want <- predict(fit)$theta_rad
  for (inertia in list(1, 0.03, measured(0.03, 0.001))) {
    scene <- as_scene(fit, inertia = inertia)
    got <- trajectory(scene, fit$samples$time_s)$theta_rad
    expect_equal(got, want, tolerance = 1e-9)
  }
  set.seed(2)
  time <- seq(0, 15, by = 0.05)
  scene <- scene_axle(
    0.2, torque_gravity(1, 0.5), resistance(0.004, quadratic_n_m_s2 = 0.006), theta0_rad = 1.5
  )
  x <- trajectory(scene, time)
  record <- motion_record(
    data.frame(time_s = time, theta_rad = x$theta_rad + stats::rnorm(301, sd = 1e-4))
  )
  again <- trajectory(as_scene(fit_swing(record), inertia = 0.2), time)
  expect_lt(max(abs(again$theta_rad - x$theta_rad)), 2e-4)
  expect_error(as_scene(fit, inertia = -1), class = "rotdyn_error_value")
  expect_error(as_scene(1), class = "rotdyn_error_type")
})

test_that("without a fitted motion they say so", {
  fit <- swing_fit()
  fit["motion"] <- list(NULL)
  fit$from <- "swings"
  for (verb in list(predict, generics::augment, as_scene)) {
    expect_error(verb(fit), "no fitted motion", class = "rotdyn_error_value")
  }
  expect_equal(nrow(generics::glance(fit)), 1)
})

test_that("predict: the band lies evenly about the motion, by Student's quantile", {
  fit <- swing_fit("viscous")
  got <- predict(fit, c(3, 2, 9), level = 0.9)
  half <- stats::qt(0.95, fit$motion$dof) * got$theta_rad_se
  expect_equal(got$theta_rad_upper - got$theta_rad, half, tolerance = 1e-9)
  expect_equal(got$theta_rad - got$theta_rad_lower, half, tolerance = 1e-9)
})
