# R's own verbs on the three fits, beside augment(), glance() and the tables.

wheel <- scene_axle(0.02, resistance = resistance(1e-3), omega0_rad_per_s = 20)
samples <- trajectory(wheel, 0:80 / 20)[c("time_s", "theta_rad")]
set.seed(1)
samples$theta_rad <- samples$theta_rad + 1e-3 * rnorm(81)
swing <- scene_pendulum(body_point(1), 0.8, resistance = resistance(0.02), theta0_rad = 0.5)
swung <- trajectory(swing, 0:200 / 20)[c("time_s", "theta_rad")]
swung$theta_rad <- swung$theta_rad + 1e-3 * rnorm(201)

coast <- fit_coast_down(samples, 0.02, losses = c("viscous", "coulomb"))
whole <- fit_scene(wheel, samples, c("resistance$viscous_n_m_s", "omega0_rad_per_s"))
pendulum <- fit_swing(swung, losses = "viscous")
fits <- list(coast, whole, pendulum)

test_that("residuals are data less fit, one for each sample", {
  for (fit in fits) {
    rows <- generics::augment(fit)
    expect_identical(residuals(fit), rows$residual)
    expect_identical(fitted(fit), rows$fitted)
    expect_identical(residuals(fit), rows$measured - rows$fitted)
    expect_identical(as.double(nobs(fit)), as.double(nrow(rows)))
    expect_lt(df.residual(fit), nobs(fit))
    expect_error(residuals(fit, 1), class = "rotdyn_error_argument")
  }
  expect_identical(df.residual(whole), 79)
})

test_that("coefficients and their intervals have the names of the unknowns", {
  expect_identical(coef(coast), stats::setNames(coast$value, coast$loss))
  expect_identical(names(coef(coast)), c("coulomb", "viscous"))
  expect_identical(coef(whole), stats::setNames(whole$value, whole$unknown))
  for (fit in list(coast, whole)) {
    ends <- confint(fit)
    expect_identical(dimnames(ends), list(names(coef(fit)), c("lower", "upper")))
    expect_identical(unname(ends), unname(cbind(fit$lower, fit$upper)))
    expect_identical(confint(fit, 2), ends[2, , drop = FALSE])
    expect_identical(confint(fit, names(coef(fit))[2]), ends[2, , drop = FALSE])
    expect_identical(confint(fit, level = 0.95), ends)
    expect_error(confint(fit, level = 0.9), "level", class = "rotdyn_error_argument")
    expect_error(confint(fit, "mass"), "mass", class = "rotdyn_error_argument")
    expect_error(confint(fit, 3), class = "rotdyn_error_argument")
  }
})

test_that("a swing's intervals are Student's, at any level", {
  expect_identical(names(coef(pendulum)), c("period_s", "omega0_rad_per_s", "decay_per_s"))
  expect_identical(coef(pendulum)[["period_s"]], pendulum$period_s$value)
  expect_identical(coef(pendulum)[["decay_per_s"]], pendulum$decay_per_s$value)
  at <- pendulum$period_s
  for (level in c(0.95, 0.5)) {
    half <- at$u * stats::qt((1 + level) / 2, at$dof)
    expect_equal(
      confint(pendulum, "period_s", level = level)[1, ],
      c(lower = at$value - half, upper = at$value + half), tolerance = 1e-14
    )
  }
  expect_identical(confint(pendulum), confint(pendulum, level = 0.95))
  expect_error(confint(pendulum, level = 1), class = "rotdyn_error_value")
  expect_error(confint(pendulum, "coulomb_rad_per_s2"), class = "rotdyn_error_argument")
})

test_that("sigma() is the standard deviation of the residuals", {
  expect_identical(sigma(coast), generics::glance(coast)$sigma)
  expect_identical(sigma(pendulum), pendulum$residual)
  expect_equal(sigma(whole), sqrt(sum(residuals(whole)^2) / 79), tolerance = 1e-6)
  for (fit in fits) {
    expect_equal(sigma(fit), stats::sd(residuals(fit)), tolerance = 0.05)
    expect_identical(nobs(fit, use.fallback = TRUE), nobs(fit))
    expect_error(sigma(fit, 1), class = "rotdyn_error_argument")
    expect_error(nobs(fit, TRUE, 1), class = "rotdyn_error_argument")
  }
  both <- trajectory(wheel, 0:80 / 20)[c("time_s", "theta_rad", "omega_rad_per_s")]
  both$theta_rad <- samples$theta_rad
  both$omega_rad_per_s <- both$omega_rad_per_s + 1e-2 * sin(2e4 * both$time_s)
  unknown <- c("resistance$viscous_n_m_s", "omega0_rad_per_s")
  expect_named(sigma(fit_scene(wheel, both, unknown)), c("theta_rad", "omega_rad_per_s"))
  two <- fit_scene(wheel, list(a = samples, b = samples), unknown)
  expect_named(sigma(two), c("theta_rad (a)", "theta_rad (b)"))
})

test_that("the summary of each fit is its row of glance()", {
  for (fit in fits) {
    expect_identical(summary(fit), generics::glance(fit))
    expect_error(summary(fit, 1), class = "rotdyn_error_argument")
  }
})

test_that("a fit predicts at times in any order, and ends a profile at a limit", {
  wheel <- scene_axle(0.05, resistance = resistance(0.02), omega0_rad_per_s = 20)
  set.seed(1)
  record <- trajectory(wheel, 0:100 / 20)[c("time_s", "theta_rad")]
  record$theta_rad <- record$theta_rad + rnorm(101, 0, 0.02)
  unknown <- c("resistance$viscous_n_m_s", "omega0_rad_per_s")
  free <- fit_scene(wheel, record, unknown)
  limit <- coef(free)[[2]] + free$standard_error[2]
  start <- scene_axle(0.05, resistance = resistance(0.02), omega0_rad_per_s = 19.9)
  fit <- fit_scene(start, record, unknown, upper = c(omega0_rad_per_s = limit))
  at <- predict(fit, c(4, NA, 1, 1))
  expect_identical(at$time_s, c(4, NA, 1, 1))
  # omega0 / k (1 - exp(-k t)), k = viscous / inertia
  k <- coef(fit)[[1]] / 0.05
  expect_equal(at$theta_rad[c(1, 3)], coef(fit)[[2]] / k * (1 - exp(-k * c(4, 1))),
               tolerance = 1e-8)
  shape <- profile(fit, "omega0_rad_per_s")
  expect_false(anyDuplicated(shape$value) > 0)
  expect_equal(shape$linear, (shape$value - coef(fit)[[2]]) / fit$standard_error[2],
               tolerance = 1e-6)
  expect_identical(max(shape$value), limit)
})

test_that("rows that repeat others are counted in the plural", {
  wheel <- scene_axle(0.05, resistance = resistance(0.02), omega0_rad_per_s = 20)
  record <- trajectory(wheel, 0:50 / 10)[c("time_s", "theta_rad")]
  record$theta_rad <- record$theta_rad + sin(7 * 1:51) / 100
  expect_warning(
    fit_scene(wheel, record[c(1:51, 1:3), ], "resistance$viscous_n_m_s"),
    "3 rows of record 1 repeat another exactly\\s+and are left out", class = "rotdyn_warning_fit"
  )
})
