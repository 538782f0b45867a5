# Fits of scenes to records whose truth is known.

noisy <- function(x, sigma, seed) {
  set.seed(seed)
  x + stats::rnorm(length(x), 0, sigma)
}

# Motion of a scene as a record of some columns.
film_of <- function(scene, time_s, columns, sigma = 0, seed = 1) {
  motion <- trajectory(scene, time_s)
  out <- list(time_s = time_s)
  for (k in seq_along(columns)) out[[columns[k]]] <- noisy(motion[[columns[k]]], sigma, seed + k)
  as.data.frame(out)
}

bowling <- function(friction, v0) {
  scene_incline(body_sphere(6, 0.108), 0, static_friction = friction, v0_m_per_s = v0,
                omega0_rad_per_s = 0)
}

test_that("a ball that slips, then rolls", {
  film <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m", 0.01)
  fit <- fit_scene(bowling(0.2, 7), film, c("static_friction", "v0_m_per_s"))
  expect_s3_class(fit, c("rot_fit", "tbl_df"), exact = FALSE)
  expect_identical(fit$unknown, c("static_friction", "v0_m_per_s"))
  expect_true(all(abs(fit$value - c(0.12, 8)) < 3 * fit$standard_error))
  expect_true(all(fit$lower < c(0.12, 8) & fit$upper > c(0.12, 8)))
  expect_identical(fit$status, rep("determined", 2))
  # An exact record comes back, from another start.
  exact <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m")
  again <- fit_scene(bowling(0.05, 12), exact, c("static_friction", "v0_m_per_s"))
  expect_equal(again$value, c(0.12, 8), tolerance = 1e-9)
  # What follows from the fit.
  expect_equal(as_scene(fit)$static_friction, fit$value[1])
  rows <- augment(fit)
  expect_equal(rows$measured, film$x_m)
  expect_equal(rows$fitted + rows$residual, rows$measured)
  expect_equal(predict(fit, 2)$x_m, trajectory(as_scene(fit), c(0, 2))$x_m[2])
  expect_equal(stats::sd(rows$residual), 0.01, tolerance = 0.2)
  expect_equal(sqrt(diag(vcov(fit))), stats::setNames(fit$standard_error, fit$unknown))
  expect_equal(unname(coef(fit)), fit$value)
  expect_identical(unname(confint(fit)[, "lower"]), fit$lower)
  expect_identical(confint(fit, level = 0.95), confint(fit))
  expect_error(confint(fit, level = 0.68), "level = 0.68", class = "rotdyn_error_argument")
  info <- glance(fit)
  expect_identical(info$samples, 91)
  expect_identical(info$dof, 89)
  expect_true(info$converged)
  expect_output(print(fit), "static_friction +0.1[12].*noise of x_m: 0.0")
  expect_output(print(fit[c("unknown", "value")]), "tibble: 2 x 2|tibble: 2 . 2")
  expect_output(print(fit[1, ]), "static_friction")
})

test_that("standard errors are those of linear regression where the motion is linear", {
  wheel <- scene_axle(0.5, omega0_rad_per_s = 3, theta0_rad = 1)
  film <- film_of(wheel, seq(0, 5, by = 0.1), "theta_rad", 0.05)
  fit <- fit_scene(scene_axle(0.5, omega0_rad_per_s = 2, theta0_rad = 0.1), film,
                   c("theta0_rad", "omega0_rad_per_s"), noise = "white")
  line <- stats::lm(theta_rad ~ time_s, film)
  expect_equal(fit$value, unname(stats::coef(line)), tolerance = 1e-9)
  expect_equal(fit$standard_error, unname(summary(line)$coefficients[, 2]), tolerance = 1e-6)
  expect_equal(fit$lower, unname(stats::confint(line)[, 1]), tolerance = 1e-6)
  expect_equal(vcov(fit), stats::vcov(line), ignore_attr = TRUE, tolerance = 1e-6)
})

test_that("a thrown body: moments of inertia only as their ratios", {
  phone <- scene_free(c(1, 2, 2.4), c(0.1, 5, 0.2))
  rates <- paste0("omega_", c("x", "y", "z"), "_rad_per_s")
  toss <- film_of(phone, seq(0, 4, by = 0.02), rates, 0.02)
  guess <- scene_free(c(1, 1.8, 2.2), c(0.12, 4.8, 0.15))
  spins <- sprintf("omega0_rad_per_s[%d]", 1:3)
  fit <- fit_scene(guess, toss, c("body[2]", "body[3]", spins))
  truth <- c(2, 2.4, 0.1, 5, 0.2)
  expect_true(all(abs(fit$value - truth) < 4 * fit$standard_error))
  expect_true(all(fit$standard_error < 0.02))
  expect_identical(glance(fit)$samples, 603)
  all <- fit_scene(guess, toss, c("body[1]", "body[2]", "body[3]", spins))
  expect_identical(all$status, rep(c("not determined", "determined"), c(3, 3)))
  expect_true(all(is.nan(all$standard_error[1:3]) & is.nan(all$lower[1:3])))
  expect_equal(all$value[2] / all$value[1], fit$value[1], tolerance = 1e-3)
  expect_output(print(all), "body[1], body[2], body[3]: only their ratios", fixed = TRUE)
})

test_that("several records share what is not per record; offset, factor, clock, prior", {
  wheel <- function(speed, friction = 0.5, start_s = 0) {
    scene_axle(1, resistance = resistance(coulomb_n_m = friction), omega0_rad_per_s = speed)
  }
  films <- list(
    fast = film_of(wheel(3), seq(0, 8, by = 0.1), "theta_rad", 0.01, 1),
    slow = film_of(wheel(2), seq(0, 5, by = 0.1), "theta_rad", 0.01, 2)
  )
  fit <- fit_scene(wheel(2.5, 0.4), films, c("resistance$coulomb_n_m", "omega0_rad_per_s"),
                   per_record = "omega0_rad_per_s", offset = "theta_rad")
  expect_identical(fit$unknown, c("resistance$coulomb_n_m", rep("omega0_rad_per_s", 2),
                                  "offset of theta_rad"))
  expect_identical(fit$record, c(NA, "fast", "slow", NA))
  expect_true(all(abs(fit$value - c(0.5, 3, 2, 0)) < 4 * fit$standard_error))
  expect_equal(as_scene(fit, record = 2)$omega0_rad_per_s, fit$value[3])
  expect_identical(fit$unit[4], "rad")
  # The clock of a film that began later.
  late <- films$fast
  late$time_s <- late$time_s - 0.5
  late <- late[late$time_s >= 0, ]
  timed <- fit_scene(wheel(2.5, 0.4), late, "resistance$coulomb_n_m", clock = TRUE,
                     prior = list("clock of time_s" = measured(0.5, 0.2)))
  expect_identical(timed$unknown[2], "clock of time_s")
  # A known quantity: with a tight prior the value is the prior's.
  told <- fit_scene(wheel(2.5, 0.4), films$fast, c("body", "resistance$coulomb_n_m",
                    "omega0_rad_per_s"), prior = list(body = measured(1.2, 0.01)))
  expect_equal(told$value[1], 1.2, tolerance = 1e-6)
  expect_equal(told$standard_error[1], 0.01, tolerance = 0.1)
  expect_equal(told$value[2] / told$value[1], 0.5, tolerance = 0.01)
})

test_that("a limit near an edge is as narrow as the record makes it", {
  time_s <- seq(0, 10, 0.1)
  from <- time_s - 5
  set.seed(3)
  noise <- stats::rnorm(101, 0, 5e-12)
  # The best friction would be -1e-13 N m.
  noise <- noise - sum(noise * from) / sum(from^2) * from + 1e-13 * from
  scene <- scene_axle(1, resistance = resistance(coulomb_n_m = 0.1), omega0_rad_per_s = 10)
  fit <- fit_scene(
    scene, data.frame(time_s = time_s, omega_rad_per_s = 10 + noise),
    c("resistance$coulomb_n_m", "omega0_rad_per_s")
  )
  expect_identical(fit$status[1], "at its lower limit")
  grown <- stats::qt(0.95, 99) * fit$standard_error[2] * sqrt(101 / sum(from^2))
  expect_within(fit$upper[1], sqrt(1e-26 + grown^2) - 1e-13, 0.01)
})

test_that("an unknown at the edge of its domain has a one-sided interval", {
  wheel <- scene_axle(1, resistance = resistance(0, 0, 0.5), omega0_rad_per_s = 3)
  film <- film_of(wheel, seq(0, 8, by = 0.05), "theta_rad", 0.01, 5)
  guess <- scene_axle(1, resistance = resistance(0, 0.01, 0.4), omega0_rad_per_s = 2.5)
  unknown <- c("resistance$quadratic_n_m_s2", "resistance$coulomb_n_m", "omega0_rad_per_s")
  held <- 0
  for (seed in 1:8) {
    film$theta_rad <- noisy(trajectory(wheel, film$time_s)$theta_rad, 0.01, seed)
    fit <- fit_scene(guess, film, unknown)
    if (fit$status[1] == "at its lower limit") {
      held <- held + 1
      expect_identical(fit$value[1], 0)
      expect_identical(fit$lower[1], 0)
      expect_true(fit$upper[1] > 0 && fit$upper[1] < 0.02)
      expect_true(is.nan(fit$standard_error[1]))
    } else {
      expect_lt(fit$lower[1], 0.01)
    }
  }
  expect_gt(held, 0)
  expect_lt(held, 8)
})

test_that("what cannot be fitted is said before", {
  film <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m", 0.01)
  fit <- function(...) fit_scene(bowling(0.2, 7), film, ...)
  expect_error(fit("mass"), class = "rotdyn_error_argument")
  expect_error(fit(c("v0_m_per_s", "v0_m_per_s")), "twice", class = "rotdyn_error_argument")
  expect_error(fit(c("v0_m_per_s", "body$mass_kg")), "no effect", class = "rotdyn_error_value")
  expect_error(fit(1), class = "rotdyn_error_type")
  expect_error(fit("v0_m_per_s", per_record = "x0_m"), class = "rotdyn_error_argument")
  expect_error(fit("v0_m_per_s", observed = "theta"), class = "rotdyn_error_argument")
  expect_error(fit("v0_m_per_s", offset = "theta_rad"), class = "rotdyn_error_argument")
  expect_error(fit("v0_m_per_s", prior = list(x0_m = measured(1, 0.1))),
               class = "rotdyn_error_argument")
  expect_error(fit("v0_m_per_s", level = 1), class = "rotdyn_error_value")
  few <- film[1:2, ]
  expect_error(fit_scene(bowling(0.2, 7), few, c("v0_m_per_s", "static_friction")),
               class = "rotdyn_error_size")
  early <- film
  early$time_s <- early$time_s - 1
  expect_error(fit_scene(bowling(0.2, 7), early, "v0_m_per_s"), "begins before",
               class = "rotdyn_error_value")
  expect_error(fit_scene(bowling(0.2, 7), film["time_s"], "v0_m_per_s"), "no column",
               class = "rotdyn_error_argument")
  expect_error(fit_scene(bowling(0.2, 7), list(), "v0_m_per_s"), "must be a data frame",
               class = "rotdyn_error_type")
  expect_error(fit_scene(bowling(0.2, 7), film["x_m"], "v0_m_per_s"),
               class = "rotdyn_error_type")
  words <- transform(film, x_m = as.character(x_m))
  expect_error(fit_scene(bowling(0.2, 7), words, "v0_m_per_s"), class = "rotdyn_error_type")
  expect_error(as_scene(fit("v0_m_per_s"), record = 2), class = "rotdyn_error_value")
})

test_that("further starts find a second minimum", {
  pendulum <- function(length) scene_pendulum(body_point(1), length, theta0_rad = 0.3)
  film <- film_of(pendulum(1), seq(0, 20, by = 0.1), "theta_rad", 0.01)
  # Cycles away from the truth the sum of squares has other minima.
  lost <- suppressWarnings(fit_scene(pendulum(2.4), film, "distance_m"))
  expect_gt(abs(lost$value - 1), 0.1)
  found <- suppressWarnings(fit_scene(pendulum(2.4), film, "distance_m", starts = 60))
  expect_equal(found$value, 1, tolerance = 1e-3)
})

test_that("profiles are straight where the problem is linear", {
  wheel <- scene_axle(0.5, omega0_rad_per_s = 3, theta0_rad = 1)
  film <- film_of(wheel, seq(0, 5, by = 0.1), "theta_rad", 0.05)
  fit <- fit_scene(wheel, film, c("theta0_rad", "omega0_rad_per_s"), noise = "white")
  rows <- profile(fit)
  expect_identical(nrow(rows), 22L)
  expect_equal(rows$rooted, rows$linear, tolerance = 1e-3)
  one <- profile(fit, "omega0_rad_per_s", points = 2)
  expect_equal(one$value, fit$value[2] + one$linear * fit$standard_error[2])
  expect_error(profile(fit, "body"), class = "rotdyn_error_argument")
})

test_that("pictures show the record, the motion and what is left over", {
  skip_if_not_installed("ggplot2")
  film <- film_of(bowling(0.12, 8), 0:30 / 10, c("x_m", "v_m_per_s"), 0.01)
  fit <- fit_scene(bowling(0.2, 7), list(film, film), c("static_friction", "v0_m_per_s"))
  picture <- ggplot2::autoplot(fit)
  layers <- ggplot2::ggplot_build(picture)
  expect_identical(length(unique(layers$data[[2]]$PANEL)), 4L)
  expect_identical(nrow(layers$data[[2]]), 2L * 2L * 2L * 31L)
  expect_match(picture$labels$alt, "x_m, v_m_per_s")
  expect_equal(range(layers$data[[3]]$x), c(0, 3))
  # Units of the unknowns; a coefficient has none.
  expect_identical(
    fitted_labels(fit, attr(fit, "fit")), c("static_friction", "v0_m_per_s (m/s)")
  )
})

test_that("columns with units are converted", {
  skip_if_not_installed("units")
  film <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m", 0.01)
  plain <- fit_scene(bowling(0.2, 7), film, c("static_friction", "v0_m_per_s"))
  film$x_m <- units::set_units(100 * film$x_m, "cm")
  expect_equal(fit_scene(bowling(0.2, 7), film, plain$unknown)$value, plain$value,
               tolerance = 1e-9)
  film$x_m <- units::set_units(as.double(film$x_m), "kg")
  expect_error(fit_scene(bowling(0.2, 7), film, plain$unknown), class = "rotdyn_error_unit")
})

test_that("known noise: chi-squared, intervals of the normal law", {
  film <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m", 0.01)
  unknown <- c("static_friction", "v0_m_per_s")
  fit <- fit_scene(bowling(0.2, 7), film, unknown, noise = c(x_m = 0.01))
  expect_identical(glance(fit)$dof, Inf)
  expect_equal(fit$upper[2] - fit$value[2], stats::qnorm(0.975) * fit$standard_error[2],
               tolerance = 1e-3)
  # Half of the noise: half of the errors, and the sum of squares says that it is not.
  half <- fit_scene(bowling(0.2, 7), film, unknown, noise = c(x_m = 0.005))
  expect_equal(half$value, fit$value, tolerance = 1e-6)
  expect_equal(2 * half$standard_error, fit$standard_error, tolerance = 1e-5)
  size <- function(fit) {
    tests <- residual_tests(fit)
    tests[tests$test == "size", ]
  }
  rest <- augment(fit)$residual
  expect_equal(size(fit)$statistic, sum(rest^2) / 0.01^2, tolerance = 1e-6)
  expect_identical(size(fit)$finding, "as the noise given")
  expect_lt(size(half)$p_value, 1e-6)
  expect_output(print(half), "law: x_m incomplete near .* times the noise given")
  refused <- function(noise, class, text) {
    expect_error(fit_scene(bowling(0.2, 7), film, unknown, noise = noise), text, class = class)
  }
  refused(c(x_m = -1), "rotdyn_error_value", "above 0")
  refused(c(theta_rad = 1), "rotdyn_error_argument", "theta_rad")
  refused(0.1, "rotdyn_error_argument", "noise")
  refused(c(x_m = 1, x_m = 2), "rotdyn_error_argument", "x_m")
  refused("grey", "rotdyn_error_value", "grey")
})

test_that("outliers are left out and named; many are none", {
  film <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m", 0.01)
  film$x_m[c(20, 61)] <- film$x_m[c(20, 61)] + c(0.3, -0.2)
  unknown <- c("static_friction", "v0_m_per_s")
  fit <- fit_scene(bowling(0.2, 7), film, unknown)
  rows <- augment(fit)
  expect_identical(which(rows$outlier), c(20L, 61L))
  expect_equal(rows$measured, film$x_m)
  expect_equal(rows$residual, rows$measured - rows$fitted)
  expect_identical(glance(fit)$samples, 89)
  tests <- residual_tests(fit)
  expect_identical(tests$statistic[tests$test == "outliers"], 2)
  expect_output(print(fit), "outliers: x_m left out: at 0.633333, 2 s")
  clean <- film
  clean$x_m[c(20, 61)] <- NA
  without <- fit_scene(bowling(0.2, 7), clean, unknown)
  expect_equal(fit$value, without$value, tolerance = 1e-8)
  expect_equal(fit$standard_error, without$standard_error, tolerance = 1e-6)
  kept <- fit_scene(bowling(0.2, 7), film, unknown, outliers = "keep")
  expect_false(any(augment(kept)$outlier))
  expect_gt(kept$standard_error[2], 2 * fit$standard_error[2])
  many <- film
  many$x_m[seq(5, 90, by = 10)] <- many$x_m[seq(5, 90, by = 10)] + 0.3
  expect_false(any(augment(fit_scene(bowling(0.2, 7), many, unknown))$outlier))
  expect_error(fit_scene(bowling(0.2, 7), film, unknown, outliers = "mend"),
               class = "rotdyn_error_value")
})

test_that("a law that is not complete is said, with its place", {
  truth <- scene_axle(0.5, resistance = resistance(0.02, 0.01, 0.05), omega0_rad_per_s = 20)
  film <- film_of(truth, seq(0, 20, by = 0.1), "omega_rad_per_s", 0.02)
  simple <- fit_scene(scene_axle(0.5, resistance = resistance(0.1), omega0_rad_per_s = 15), film,
                      c("resistance$viscous_n_m_s", "omega0_rad_per_s"))
  full <- fit_scene(
    scene_axle(0.5, resistance = resistance(0.03, 0.003, 0.02), omega0_rad_per_s = 15), film,
    c("resistance$viscous_n_m_s", "resistance$quadratic_n_m_s2", "resistance$coulomb_n_m",
      "omega0_rad_per_s")
  )
  law <- function(fit) {
    tests <- residual_tests(fit)
    tests$finding[tests$test == "wrong law"]
  }
  expect_match(law(simple), "^incomplete near")
  expect_identical(law(full), "none found")
  expect_output(print(simple), "intervals of a law that does not fit may not hold")
  expect_no_match(paste(capture.output(print(full)), collapse = "\n"), "law:")
  ranks <- compare_laws(simple, full)
  expect_identical(ranks$law, c("full", "simple"))
  expect_identical(ranks$parameters, c(4L, 2L))
  expect_identical(ranks$aicc_difference[1], 0)
  expect_gt(ranks$aicc_difference[2], 100)
  # Root mean squares of both, by the noise of the better.
  white <- fit_scene(as_scene(simple), film, simple$unknown, noise = "white")
  # Its first samples are off together: no outliers.
  expect_false(any(augment(white)$outlier))
  rest <- vapply(list(full, white), function(fit) sqrt(sum(augment(fit)$residual^2)), 0)
  expect_equal(ranks$relative_residual[1], 1, tolerance = 0.02)
  expect_equal(ranks$relative_residual[2], rest[2] / rest[1] * sqrt(197 / 199), tolerance = 0.02)
  start <- scene_axle(0.5, resistance = resistance(0.03, 0.003, 0.02), omega0_rad_per_s = 15,
                      theta0_rad = 0.1)
  more <- compare_laws(full, again = full)
  expect_identical(more$aicc_difference, c(0, 0))
  expect_identical(sort(more$law), c("again", "full"))
  expect_error(compare_laws(full), "two fits", class = "rotdyn_error_missing")
  other <- fit_scene(start, film[1:100, ], c("resistance$viscous_n_m_s", "omega0_rad_per_s"))
  expect_error(compare_laws(full, other), "same samples", class = "rotdyn_error_argument")
})

test_that("a counter is fitted by the times at which it counts", {
  truth <- scene_axle(0.5, resistance = resistance(0.05), omega0_rad_per_s = 4)
  step <- 2 * pi / 16
  time_s <- seq(0, 30, by = 0.02)
  film <- data.frame(
    time_s = time_s, theta_rad = step * floor(trajectory(truth, time_s)$theta_rad / step)
  )
  guess <- scene_axle(0.5, resistance = resistance(0.1), omega0_rad_per_s = 3)
  unknown <- c("resistance$viscous_n_m_s", "omega0_rad_per_s")
  fit <- fit_scene(guess, film, unknown, offset = "theta_rad")
  expect_true(all(abs(fit$value[1:2] - c(0.05, 4)) < 4 * fit$standard_error[1:2]))
  # By the counts the errors are those of D/sqrt(12): ten times as large.
  expect_lt(fit$standard_error[1], 2e-4)
  expect_gt(fit$standard_error[1], 1e-6)
  expect_lt(glance(fit)$samples, 300)
})

test_that("a counter that never waits is fitted by its counts, too", {
  time_s <- seq(0, 20, by = 0.01)
  film <- data.frame(
    time_s = time_s, theta_rad = 0.05 * round((0.4 * time_s + 0.02 * time_s^2) / 0.05)
  )
  fit <- fit_scene(scene_axle(1, 0.1), film, c("torque", "omega0_rad_per_s"))
  expect_true(all(abs(fit$value - c(0.04, 0.4)) < 4 * fit$standard_error))
  expect_true(all(fit$standard_error < 1e-4))
  expect_lt(glance(fit)$samples, 400)
})

test_that("unknowns that nearly stand for each other are determined, those that do are not", {
  fit <- function(fall) { # the part of omega that is lost in the record
    film <- film_of(
      scene_axle(1, 10 * fall, resistance(2 * fall), omega0_rad_per_s = 10), 0:100 / 100,
      "omega_rad_per_s"
    )
    start <- scene_axle(1, 8 * fall, resistance(fall), omega0_rad_per_s = 10)
    suppressWarnings(fit_scene(start, film, c("torque", "resistance$viscous_n_m_s")))
  }
  # Torque and damping act alike as long as omega does not change: by 1e-4, by 1e-9 of it.
  near <- fit(1e-4)
  expect_identical(near$status, rep("determined", 2))
  expect_gt(glance(near)$condition, 1e5)
  expect_identical(fit(1e-9)$status, rep("not determined", 2))
})

test_that("what a constructor made of others follows when those vary", {
  ball <- body_sphere(6, 0.108)
  rolls <- suppressMessages(scene_incline(ball, 1, v0_m_per_s = 2))
  truth <- suppressMessages(scene_incline(ball, 1, v0_m_per_s = 3))
  film <- film_of(truth, 0:20 / 10, c("x_m", "theta_rad"))
  fit <- fit_scene(rolls, film, "v0_m_per_s")
  expect_equal(fit$value, 3, tolerance = 1e-9)
  expect_equal(as_scene(fit)$omega0_rad_per_s, fit$value / 0.108, tolerance = 1e-12)
  # The other one unknown: it has a value of its own.
  lane <- function(v, omega) {
    scene_incline(ball, 1, static_friction = 0.1, v0_m_per_s = v, omega0_rad_per_s = omega)
  }
  film <- film_of(lane(3, 10), 0:20 / 10, c("x_m", "theta_rad"))
  both <- fit_scene(suppressMessages(lane(2, NULL)), film, c("v0_m_per_s", "omega0_rad_per_s"))
  expect_equal(both$value, c(3, 10), tolerance = 1e-9)
})

test_that("a drift of residuals is judged against all windows of all widths", {
  # 8 of 64 samples by 2 of their deviations: a sum of 16, of sqrt(8) at random. Widths 4 to 64,
  # and 15 windows of 8.
  e <- rep(c(0, 2, 0), c(16, 8, 40))
  found <- scan_residuals(e)
  expect_equal(found$statistic, 16 / sqrt(8))
  expect_equal(found$p, 5 * 2 * 15 * stats::pnorm(-16 / sqrt(8)))
  # One width alone, and none.
  expect_equal(scan_residuals(rep(2, 4))$p, 2 * stats::pnorm(-4))
  expect_equal(scan_residuals(rep(2, 8))$p, 2 * 2 * stats::pnorm(-16 / sqrt(8)))
  expect_identical(scan_residuals(rep(9, 3))$p, 1)
})

test_that("digits that tremble are no counter", {
  stops <- function(coulomb, omega0) {
    scene_axle(0.5, resistance = resistance(coulomb_n_m = coulomb), omega0_rad_per_s = omega0)
  }
  time_s <- seq(0, 8, length.out = 120)
  film <- as.data.frame(trajectory(stops(0.5, 6), time_s)[c("time_s", "theta_rad")])
  set.seed(1)
  film$theta_rad <- 0.1 * round(film$theta_rad / 0.1 + stats::rnorm(120, 0, 0.5))
  fit <- fit_scene(stops(0.7, 5), film, c("resistance$coulomb_n_m", "omega0_rad_per_s"))
  expect_identical(glance(fit)$samples, 120)
  # White noise and rounding: sqrt(0.25 + 1/12) of a digit.
  expect_equal(stats::sd(augment(fit)$residual), 0.1 * sqrt(1 / 3),
               tolerance = 0.15)
  expect_true(all(abs(fit$value - c(0.5, 6)) < 3 * fit$standard_error))
})

test_that("errors of counts are as correlated as the angle makes them", {
  # 1.1186 counts between samples: the error is a wave of nine samples. By the angles for many zeros
  # of the counter, and least squares by lm():
  time_s <- seq(0, 5, length.out = 150)
  count <- 0.01
  turned <- 1.1186 * count / time_s[2] * time_s
  read <- function(zero) count * (round(turned / count + zero) - zero)
  rates <- vapply((1:200 - 0.5) / 200, function(zero) {
    stats::coef(stats::lm(read(zero) ~ 0 + time_s))
  }, 0)
  expected <- stats::sd(rates)
  wheel <- scene_axle(1, omega0_rad_per_s = 0.33)
  fits <- lapply(c(0.1, 0.4, 0.7), function(zero) {
    fit_scene(wheel, data.frame(time_s, theta_rad = read(zero)), "omega0_rad_per_s")
  })
  errors <- vapply(fits, `[[`, 0, "standard_error")
  expect_equal(errors, rep(expected, 3), tolerance = 0.1)
  # Independent errors would be 4.4 times as large.
  expect_gt(count / sqrt(12) / sqrt(sum(time_s^2)), 4 * expected)
})

test_that("an error that is a wave of the counter is seldom small", {
  within <- rotdyn:::errors_within
  expect_identical(within(0, 0.95, 12), stats::qt(0.975, 12))
  # |sqrt(2) cos(phase)| is below x for the part 2/pi asin(x/sqrt(2)) of the phases.
  expect_equal(within(0.999, 0.68, Inf), sqrt(2) * sin(0.68 * pi / 2), tolerance = 0.02)
  expect_identical(within(0.999, 0.95, Inf), stats::qnorm(0.975))
  set.seed(1)
  off <- sqrt(0.6 * 2) * cos(runif(1e5, 0, 2 * pi)) + sqrt(0.4) * rnorm(1e5)
  expect_equal(mean(abs(off) < within(0.6, 0.68, Inf)), 0.68, tolerance = 0.01)
})

test_that("equal counts at rest have one error", {
  clutch <- function(capacity, omega0) {
    scene_clutch(2, 3, capacity, omega0_rad_per_s = c(omega0, 0))
  }
  rates <- paste0("omega_", 1:2, "_rad_per_s")
  unknown <- c("capacity_n_m", "omega0_rad_per_s[1]")
  # Locked after 2 s at 8 rad/s: with a zero of its own each counter is off there by the same.
  off <- vapply(1:6 / 7, function(zero) {
    film <- film_of(clutch(12, 20), seq(0, 4, length.out = 100), rates)
    for (name in rates) film[[name]] <- 0.2 * (round(film[[name]] / 0.2 + zero) - zero)
    fit <- fit_scene(clutch(10, 19), film, unknown)
    expect_output(print(fit), "weigh as one: intervals may be too wide")
    max(abs(fit$value - c(12, 20)) / fit$standard_error)
  }, double(1))
  expect_lt(max(off), 3.5)
})

test_that("errors of counts are those of motions as near as the estimate's error", {
  shafting <- function(stiffness, damping) {
    scene_drive(
      c(0.1, 2), coupling_shaft(stiffness, damping, ratio = 4),
      torque = list(torque_motor(3, 150), NULL)
    )
  }
  rates <- paste0("omega_rad_per_s[", 1:2, "]")
  time_s <- seq(0, 3, length.out = 150)
  motion <- matrix(trajectory(shafting(40, 0.8), time_s)$omega_rad_per_s, 2)
  unknown <- paste0("couplings[1]$", c("stiffness_n_m_per_rad", "damping_n_m_s"))
  # With these zeros the damping is off by 0.07; there its variance by counts is smaller.
  off <- vapply(c(9, 12:14) / 16, function(zero) {
    film <- data.frame(time_s)
    for (k in 1:2) film[[rates[k]]] <- 0.1 * (round(motion[k, ] / 0.1 + zero) - zero)
    fit <- fit_scene(shafting(30, 0.4), film, unknown)
    (fit$value - c(40, 0.8)) / fit$standard_error
  }, double(2))
  expect_lt(max(abs(off[2, ])), 1.9)
  expect_gt(min(abs(off[2, ])), 1.2)
})

test_that("a search that cannot begin says why", {
  record <- data.frame(time_s = 0:20 / 4, theta_rad = sin(0:20 / 4))
  spring <- function(omega) scene_axle(0.1, torque_spring(1), omega0_rad_per_s = omega)
  for (omega in c(1e160, 1e200)) {
    expect_error(fit_scene(spring(omega), record, "omega0_rad_per_s"), "cannot begin",
                 class = "rotdyn_error_range")
  }
  # Far from the record, but with a way there.
  expect_lt(abs(suppressWarnings(fit_scene(spring(1e60), record, "omega0_rad_per_s"))$value), 1)
})

# ---- scenes with R functions, and those that a function builds ----------------------------------

pushed <- function(law, viscous, omega0) {
  scene_axle(0.5, law, resistance(viscous, coulomb_n_m = 0.2), omega0_rad_per_s = omega0)
}
sine <- torque_sinusoid(0.3, 2)
sine_function <- function(time_s) 0.3 * cos(2 * time_s)

test_that("a law as an R function and as the core's give the same fit", {
  # It sticks at times within the record.
  film <- film_of(pushed(sine, 0.05, 2), 0:120 / 10, c("theta_rad", "omega_rad_per_s"), 0.02)
  unknown <- c("resistance$viscous_n_m_s", "omega0_rad_per_s", "resistance$coulomb_n_m")
  core <- fit_scene(pushed(sine, 0.08, 1.7), film, unknown)
  r <- fit_scene(pushed(sine_function, 0.08, 1.7), film, unknown)
  expect_gt(nrow(motion_events(trajectory(as_scene(core), c(0, 12)))), 1)
  expect_lt(max(abs(r$value - core$value) / core$standard_error), 1e-3)
  expect_equal(r$standard_error, core$standard_error, tolerance = 1e-4)
  expect_equal(augment(r)$fitted, augment(core)$fitted, tolerance = 1e-6)
  expect_identical(glance(r)$model, "axle_rk8pd")
  expect_identical(as_scene(r)$torque$f, sine_function)
  later <- predict(r, c(1, 3))
  expect_equal(later$theta_rad, predict(core, c(1, 3))$theta_rad, tolerance = 1e-6)
})

test_that("numbers of a law and of equations are fitted through `build`", {
  spring <- function(p) {
    law <- function(time_s, theta_rad, omega_rad_per_s) -p$stiffness * theta_rad
    scene_axle(0.01, law, theta0_rad = p$start)
  }
  known <- function(p) scene_axle(0.01, torque_spring(p[[1]]), theta0_rad = p[[2]])
  film <- film_of(known(c(2, 1)), 0:60 / 60, "theta_rad", 0.01)
  core <- fit_scene(known(c(2.2, 0.9)), film, c("torque$stiffness_n_m_per_rad", "theta0_rad"))
  unknown <- c(stiffness = 2.2, start = 0.9)
  law <- fit_scene(records = film, unknown = unknown, build = spring, lower = c(stiffness = 0))
  hand <- function(p) {
    scene_equations(
      function(theta_rad, omega_rad_per_s) c(omega_rad_per_s, -100 * p$stiffness * theta_rad),
      start = c(theta_rad = p$start, omega_rad_per_s = 0)
    )
  }
  own <- fit_scene(records = film, unknown = unknown, build = hand)
  for (fit in list(law, own)) {
    expect_identical(fit$unknown, names(unknown))
    expect_identical(fit$unit, rep(NA_character_, 2))
    expect_lt(max(abs(fit$value - core$value) / core$standard_error), 1e-3)
    expect_equal(fit$standard_error, core$standard_error, tolerance = 1e-4)
    expect_equal(augment(fit)$fitted, augment(core)$fitted, tolerance = 1e-6)
    expect_equal(predict(fit, 0.5)$theta_rad, predict(core, 0.5)$theta_rad, tolerance = 1e-6)
  }
  # A lower limit of 0: of the logarithm, as of inputs of scenes.
  expect_equal(law$lower, core$lower, tolerance = 1e-5)
  expect_identical(as_scene(own)$start[["theta_rad"]], own$value[2])
  expect_output(print(own), "scene_equations.*stiffness +2[.]0.*model equations_")
  expect_identical(names(profile(law, "start"))[2], "value")
  plans <- list(longer = planned_record(0:90 / 30, "theta_rad"))
  known <- lapply(list(law, core), function(fit) fit_design(fit, plans))
  expect_equal(known[[1]]$planned_error, known[[2]]$planned_error, tolerance = 1e-4)
})

test_that("states of equations are inputs of fits and sweeps", {
  orbit <- function(speed) {
    scene_equations(
      function(x, y, vx, vy) c(vx, vy, -c(x, y) / (x^2 + y^2)^1.5),
      start = c(x = 1, y = 0, vx = 0, vy = speed), positions = c("x", "y"),
      conserved = list(moment = function(x, y, vx, vy) x * vy - y * vx)
    )
  }
  expect_identical(sweep_inputs(orbit(1.1))$input, c(paste0("start[", 1:4, "]"), "start_s"))
  expect_identical(sweep_inputs(orbit(1.1))$value, c(1, 0, 0, 1.1, 0))
  outputs <- sweep_outputs(orbit(1))$output
  expect_true(all(c("final_x", "max_abs_vy", "balanced", "error") %in% outputs))
  expect_false(any(c("supplied_j", "lost_j") %in% outputs))
  film <- film_of(orbit(1.1), 0:60 / 8, c("x", "y"), 0.01)
  fit <- fit_scene(orbit(1.05), film, "start[4]")
  expect_lt(abs(fit$value - 1.1), 3 * fit$standard_error)
  # The period of an orbit gives the speed to 2 pi / (3 a T) of the time's error; the noise alone.
  expect_lt(fit$standard_error, 5e-4)
  plan <- sweep_plan(orbit(1), 2, design_list(tibble::tibble("start[4]" = c(0.9, 1.2))))
  rows <- sweep_run(plan)
  expect_identical(rows$final_x[2], trajectory(orbit(1.2), c(0, 2))$x[2])
})

test_that("an error of a user's function is the user's, a refused step is shorter", {
  film <- film_of(scene_axle(2, 1), 0:20 / 10, "theta_rad", 0.01)
  heavy <- function(p) scene_axle(p$inertia, 1)
  # A step from 40 kg m^2 ends below 0, which the constructor refuses.
  fit <- fit_scene(records = film, unknown = c(inertia = 40), build = heavy, noise = "white")
  expect_lt(abs(fit$value - 2), 3 * fit$standard_error)
  refused <- function(code, class, text) expect_error(code, text, class = class)
  build <- function(build, unknown = c(inertia = 2), ...) {
    fit_scene(records = film, unknown = unknown, build = build, ...)
  }
  refused(build(function(p) stop("mine")), "simpleError", "mine")
  calls <- 0
  later <- function(p) {
    calls <<- calls + 1
    if (calls > 3) stop("mine, later")
    heavy(p)
  }
  refused(build(later), "simpleError", "mine, later")
  expect_identical(calls, 4)
  refused(build(heavy, c(inertia = -2)), "rotdyn_error_value", "greater than 0")
  refused(build(function(p) 3), "rotdyn_error_type", "must return a scene")
  refused(build("heavy"), "rotdyn_error_type", "must be a function")
  refused(build(heavy, 2), "rotdyn_error_type", "named numbers")
  refused(build(heavy, c(inertia = NaN)), "rotdyn_error_value", "unknown")
  refused(build(heavy, lower = c(mass = 1)), "rotdyn_error_argument", "inertia")
  refused(build(heavy, lower = c(inertia = 3)), "rotdyn_error_value", "outside")
  refused(build(heavy, lower = c(inertia = 3), upper = c(inertia = 1)), "rotdyn_error_value",
          "above its lower")
  refused(build(heavy, upper = c(inertia = "1")), "rotdyn_error_type", "must be numbers")
  refused(fit_scene(scene_axle(2, 1), film, "body", build = heavy), "rotdyn_error_argument",
          "only one")
  refused(build(function(p) scene_axle(2 + 0 * p$inertia, 1)), "rotdyn_error_value", "no effect")
})

test_that("limits narrow the domain of an input", {
  film <- film_of(bowling(0.12, 8), 0:90 / 30, "x_m", 0.01)
  unknown <- c("static_friction", "v0_m_per_s")
  free <- fit_scene(bowling(0.2, 7), film, unknown)
  wide <- fit_scene(bowling(0.2, 7), film, unknown, upper = c(static_friction = 1))
  expect_identical(wide$value, free$value)
  held <- fit_scene(bowling(0.2, 7), film, unknown, lower = c(static_friction = 0.15))
  expect_identical(held$value[1], 0.15)
  expect_identical(held$status[1], "at its lower limit")
})

test_that("a record that begins after the scene is a motion from the scene's start", {
  # With dry friction nothing can run backwards to an earlier time.
  wheel <- function(friction) {
    scene_axle(1, 0, resistance(coulomb_n_m = friction), omega0_rad_per_s = 9, start_s = 5)
  }
  film <- film_of(wheel(0.5), 6 + 0:40 / 4, "theta_rad")
  fit <- fit_scene(wheel(0.3), film, "resistance$coulomb_n_m", accuracy = 1e-12)
  expect_equal(fit$value, 0.5, tolerance = 1e-8)
})

test_that("an infinite sample is refused, a missing one is none", {
  wheel <- scene_axle(0.02, resistance = resistance(1e-3), omega0_rad_per_s = 20)
  record <- trajectory(wheel, 0:40 / 10)[c("time_s", "omega_rad_per_s")]
  unknown <- "resistance$viscous_n_m_s"
  record$omega_rad_per_s[3:5] <- c(NA, NaN, NA)
  expect_identical(glance(fit_scene(wheel, record, unknown))$samples, 38)
  record$omega_rad_per_s[4] <- Inf
  expect_error(fit_scene(wheel, record, unknown), "Row 4 is infinite", class = "rotdyn_error_value")
})

test_that("known noise is that of each observed column", {
  both <- as.data.frame(trajectory(bowling(0.12, 8), 0:90 / 30))[c("time_s", "x_m", "v_m_per_s")]
  for (noise in list(c(x_m = 0.01), c(x_m = 0.01, x_m = 0.01))) {
    expect_error(
      fit_scene(bowling(0.2, 7), both, "v0_m_per_s", noise = noise), "each of .*v_m_per_s",
      class = "rotdyn_error_argument"
    )
  }
})

test_that("a vector of inputs stands for its elements, a record of three rates is fitted", {
  rates <- paste0("omega_", c("x", "y", "z"), "_rad_per_s")
  tumbling <- trajectory(scene_free(c(1, 2.1, 2.5), c(0.3, 5.2, 0.1)), 0:100 / 50)
  sheet <- as.data.frame(tumbling)[c("time_s", rates)]
  names(sheet) <- c("Time (s)", "Gyroscope x (rad/s)", "Gyroscope y (rad/s)", "Gyroscope z (rad/s)")
  phone <- scene_free(c(1, 2, 2.4), c(0.1, 5, 0.2))
  record <- motion_record(sheet, axis = "all")
  fit <- fit_scene(phone, record, c("body[2]", "body[3]", "omega0_rad_per_s"))
  expect_identical(fit$unknown, c("body[2]", "body[3]", paste0("omega0_rad_per_s[", 1:3, "]")))
  expect_equal(fit$value, c(2.1, 2.5, 0.3, 5.2, 0.1), tolerance = 1e-6)
  each <- fit_scene(
    phone, list(record, record), c("body[2]", "body[3]", "omega0_rad_per_s"),
    per_record = "omega0_rad_per_s"
  )
  expect_length(each$value, 8)
  expect_error(
    fit_scene(phone, record, c("omega0_rad_per_s", "omega0_rad_per_s[1]")), "twice",
    class = "rotdyn_error_argument"
  )
  expect_error(fit_scene(phone, record, "omega0"), class = "rotdyn_error_argument")
  expect_error(
    fit_scene(phone, motion_record(sheet, axis = "y"), "body[2]"), "axis = \"all\"",
    class = "rotdyn_error_argument"
  )
})

test_that("an unknown without effect is refused, though rounding depends on it", {
  pendulum <- scene_pendulum(body_rod_end(0.2, 0.6), theta0_rad = 0.8)
  axle <- scene_axle(body_disk(2, 0.25), omega0_rad_per_s = 3)
  for (seed in 1:4) {
    set.seed(seed)
    swing <- film_of(pendulum, 0:100 / 20, "theta_rad")
    swing$theta_rad <- swing$theta_rad + rnorm(101, 0, 0.01)
    spin <- film_of(axle, 0:100 / 20, "theta_rad")
    spin$theta_rad <- spin$theta_rad + rnorm(101, 0, 0.01)
    for (unknown in list("body$mass_kg", c("body$mass_kg", "theta0_rad"))) {
      expect_error(fit_scene(pendulum, swing, unknown), "body\\$mass_kg.*no effect",
                   class = "rotdyn_error_value")
      expect_error(fit_scene(axle, spin, unknown), "body\\$mass_kg.*no effect",
                   class = "rotdyn_error_value")
    }
  }
  # A small effect is one.
  light <- scene_axle(body_disk(2, 0.25), resistance = resistance(1e-6), omega0_rad_per_s = 3)
  film <- film_of(light, 0:100 / 20, "theta_rad")
  fit <- fit_scene(update(light, resistance = resistance(2e-6)), film, "resistance$viscous_n_m_s")
  expect_equal(fit$value / 1e-6, 1, tolerance = 1e-4)
})

test_that("a prior without uncertainty is refused", {
  pendulum <- scene_pendulum(body_rod_end(0.2, 0.6), theta0_rad = 0.8)
  swing <- film_of(pendulum, 0:100 / 20, "theta_rad")
  for (prior in list(0.7, measured(0.7, 0))) {
    unknown <- c("body$length_m", "theta0_rad")
    expect_error(
      fit_scene(pendulum, swing, unknown, prior = list(theta0_rad = prior)),
      "above 0 for.*theta0_rad", class = "rotdyn_error_value"
    )
  }
})

test_that("a row that is there twice counts once", {
  pendulum <- scene_pendulum(body_rod_end(0.2, 0.6), theta0_rad = 0.8)
  set.seed(5)
  swing <- film_of(pendulum, 0:100 / 20, "theta_rad")
  swing$theta_rad <- swing$theta_rad + rnorm(101, 0, 0.01)
  once <- fit_scene(pendulum, swing, "body$length_m")
  expect_warning(twice <- fit_scene(pendulum, rbind(swing, swing[3:7, ]), "body$length_m"),
                 "5 rows of record 1 repeat", class = "rotdyn_warning_fit")
  expect_identical(twice$standard_error, once$standard_error)
  expect_identical(glance(twice)$samples, glance(once)$samples)
  # Two readings at one time are two.
  swing$theta_rad[51] <- swing$theta_rad[50]
  swing$time_s[51] <- swing$time_s[50] + 1e-9
  expect_silent(fit_scene(pendulum, swing, "body$length_m"))
})

test_that("a search that strays to motions of millions of steps comes back", {
  swing <- function(theta, viscous, distance) {
    scene_pendulum(
      body_rod(0.3, 0.5), distance_m = distance, theta0_rad = theta,
      resistance = resistance(viscous)
    )
  }
  set.seed(1)
  record <- trajectory(swing(1, 0.003, 0.25), seq(0, 8, 0.04))[c("time_s", "theta_rad")]
  record$theta_rad <- record$theta_rad + rnorm(201, 0, 0.01)
  fit <- fit_scene(
    swing(-0.718, 0.018, 1.243), record,
    c("theta0_rad", "resistance$viscous_n_m_s", "distance_m")
  )
  expect_true(all(abs(coef(fit) - c(1, 0.003, 0.25)) < 4 * sqrt(diag(vcov(fit)))))
})

# A mass that coasts without loss: theta = omega0 t, by weighted least squares of a closed form.
test_that("noise that grows tenfold: samples weigh by it, intervals hold the truth", {
  time_s <- 0:400 / 50
  coast <- scene_axle(1, theta0_rad = 0.1, omega0_rad_per_s = 2)
  score <- NULL
  for (seed in 1:60) {
    set.seed(seed)
    theta_rad <- 0.1 + 2 * time_s + 0.002 * rnorm(401) * 10^(time_s / 8)
    fit <- fit_scene(
      coast, data.frame(time_s, theta_rad), c("theta0_rad", "omega0_rad_per_s")
    )
    score <- cbind(score, (fit$value - c(0.1, 2)) / fit$standard_error)
  }
  weight <- 0.002 * 10^(time_s / 8)
  x <- cbind(1, time_s) / weight
  expect_equal(fit$standard_error, unname(sqrt(diag(solve(crossprod(x))))), tolerance = 0.15)
  expect_true(all(abs(rowMeans(score^2) - 1) < 4 * sqrt(2 / 60)))
  expect_equal(nrow(attr(fit, "fit")$about$outliers_at) %||% 0L, 0L)
  expect_output(print(fit), "times as large\\s+at the end")
  # The law with another unknown has the same samples and weights.
  compared <- compare_laws(fit, fit_scene(coast, data.frame(time_s, theta_rad), "theta0_rad"))
  expect_identical(compared$aicc_difference[1], 0)
})

test_that("neighbours that are anticorrelated make errors smaller", {
  time_s <- 0:400 / 50
  coast <- scene_axle(1, omega0_rad_per_s = 2)
  set.seed(1)
  e <- rnorm(402)
  theta_rad <- 2 * time_s + 0.01 * (e[-1] - 0.6 * e[-402])
  fit <- fit_scene(coast, data.frame(time_s, theta_rad), "omega0_rad_per_s")
  # The power of this noise at frequency 0 is (1 - 0.6)^2.
  expect_equal(fit$standard_error, 0.004 / sqrt(sum(time_s^2)), tolerance = 0.4)
  expect_output(print(fit), "neighbours anticorrelated")
})

test_that("counts that are rounded down are said, those that are rounded are not", {
  time_s <- 0:400 / 50
  disk <- scene_axle(0.0625, resistance = resistance(0.01, 2e-4), omega0_rad_per_s = 20)
  theta <- trajectory(disk, time_s)$theta_rad
  unknown <- c("resistance$viscous_n_m_s", "omega0_rad_per_s")
  step <- 2 * pi / 36
  down <- data.frame(time_s, theta_rad = step * floor(theta / step))
  expect_warning(fit_scene(disk, down, unknown), "rounded down", class = "rotdyn_warning_fit")
  expect_no_warning(fit_scene(disk, down, unknown, offset = "theta_rad"))
  nearest <- data.frame(time_s, theta_rad = step * round(theta / step))
  expect_no_warning(fit_scene(disk, nearest, unknown))
})

test_that("counts are whole numbers whatever zero is subtracted from them", {
  time_s <- 0:119 / 20
  count <- floor(30 * exp(-time_s / 3) + 2 * time_s)
  decimals <- 0.2 * (count + 7) - 0.137
  expect_gt(length(unique(diff(decimals))), length(unique(diff(count))))
  series <- list(omega_rad_per_s = decimals)
  own <- by_edges(list(time_s = time_s, series = series))
  whole <- by_edges(list(time_s = time_s, series = list(omega_rad_per_s = count)))
  expect_identical(own$weight, whole$weight)
})

test_that("a speed of a whole number of counts a sample has one error, as a rest has", {
  # From 0.7 to 1.3 counts a sample: within an eighth of 1 for a quarter of the record.
  count <- round(0.7 * 0:120 + 0.3 * (0:120)^2 / 120)
  middle <- 49:73
  expect_true(all(weight_of_counts(count)[middle] > 4))
  # 2.5 counts a sample: the errors average out.
  expect_identical(weight_of_counts(floor(2.5 * 0:120)), rep(1, 121))
})

test_that("a limit that any change exceeds is that change", {
  rest <- data.frame(time_s = 0:200 / 20, theta_rad = 1)
  pendulum <- scene_pendulum(body_rod(0.3, 0.5), distance_m = 0.25, theta0_rad = 0.5)
  # It stays at 1 rad where it is held at its centre.
  fit <- fit_scene(pendulum, rest, c("theta0_rad", "distance_m"))
  expect_identical(fit$value[2], 0)
  expect_lt(fit$upper[2], 1e-12)
})

test_that("of a computed motion the state is fitted, of several rows for each time, too", {
  wheel <- scene_axle(0.05, torque = 0.8, resistance = resistance(viscous_n_m_s = 0.02))
  motion <- trajectory(wheel, seq(0, 4, 0.1))
  expect_message(
    fit <- fit_scene(wheel, motion, unknown = "torque"), "theta_rad, omega_rad_per_s",
    class = "rotdyn_message_fit"
  )
  # A sample of an angle and one of a rate for each time, and none of what is computed from them.
  expect_match(utils::capture.output(print(fit))[1], "82 samples of theta_rad, omega_rad_per_s$")
  expect_no_message(fit_scene(wheel, motion, "torque", observed = "net_torque_n_m"))
  expect_no_message(fit_scene(wheel, as.data.frame(motion)[c(1, 3)], "torque"))

  shaft <- scene_drive(list(0.1, 0.2), coupling_shaft(50, 0.1), torque = list(1, NULL))
  motion <- trajectory(shaft, seq(0, 1, 0.05))
  stiffness <- grep("stiffness", sweep_inputs(shaft)$input, value = TRUE)
  wide <- data.frame(time_s = seq(0, 1, 0.05))
  angles <- c("theta_rad[1]" = 1e-3, "theta_rad[2]" = 1e-3)
  for (k in 1:2) wide[[paste0("theta_rad[", k, "]")]] <- motion$theta_rad[motion$rotor == k]
  expect_message(both <- fit_scene(shaft, motion, stiffness, noise = c(
    angles, "omega_rad_per_s[1]" = 1e9, "omega_rad_per_s[2]" = 1e9
  )), class = "rotdyn_message_fit")
  alone <- fit_scene(shaft, wide, stiffness, noise = angles)
  expect_equal(both$value, alone$value, tolerance = 1e-6)
  expect_equal(both$standard_error, alone$standard_error, tolerance = 1e-4)
  expect_error(fit_scene(shaft, motion[-3, ], stiffness), "rotor", class = "rotdyn_error_value")
})
