coasting <- function(sd = 1e-3, seed = 1, n = 300) {
  wheel <- scene_axle(0.05, resistance = resistance(viscous_n_m_s = 0.01), omega0_rad_per_s = 20)
  film <- trajectory(wheel, seq(0, 6, length.out = n))
  set.seed(seed)
  data.frame(time_s = film$time_s, theta_rad = film$theta_rad + stats::rnorm(n, sd = sd))
}
rate <- function(time) 20 * exp(-time / 5)

test_that("predict() gives the rows at their times, and the motion between and beyond them", {
  motion <- estimate_motion(coasting(), inertia = 0.05, breaks = "none")
  again <- predict(motion, motion$time_s)
  for (name in names(again)) expect_equal(again[[name]], motion[[name]], tolerance = 1e-7)
  between <- predict(motion, c(3.123, NA, 0.005))
  expect_equal(between$time_s, c(3.123, NA, 0.005))
  expect_true(all(
    abs(between$omega_rad_per_s - rate(between$time_s)) < 4 * between$omega_se_rad_per_s,
    na.rm = TRUE
  ))
  beyond <- predict(motion, c(6, 6.5, 7, 13))
  expect_true(all(diff(beyond$omega_se_rad_per_s[1:3]) > 0))
  expect_true(is.na(beyond$omega_rad_per_s[4]))
  expect_equal(nrow(predict(motion, double())), 0)
  expect_error(predict(motion, Inf), class = "rotdyn_error_time")
})

test_that("the energy lost has the error that many records show", {
  truth <- 0.05 * (rate(1)^2 - rate(4)^2) / 2
  got <- vapply(1:30, function(seed) {
    motion <- estimate_motion(coasting(0.01, seed), inertia = 0.05, breaks = "none")
    loss <- energy_loss(motion, 1, 4)
    c(loss$energy_loss_j, loss$energy_loss_se_j)
  }, double(2))
  z <- (got[1, ] - truth) / got[2, ]
  expect_lt(abs(mean(z)), 0.8)
  expect_gt(stats::sd(z), 0.6)
  expect_lt(stats::sd(z), 1.4)
})

test_that("energy_loss() has a sign, a seed and its own errors", {
  motion <- estimate_motion(coasting(), inertia = 0.05, breaks = "none")
  there <- energy_loss(motion, 1, 4)
  back <- energy_loss(motion, 4, 1)
  expect_equal(back$energy_loss_j, -there$energy_loss_j)
  expect_identical(energy_loss(motion, 1, 4), there)
  expect_equal(energy_loss(motion, c(1, NA), 4)$energy_loss_j, c(there$energy_loss_j, NA))
  expect_error(
    energy_loss(estimate_motion(coasting(), breaks = "none"), 1, 4),
    class = "rotdyn_error_missing"
  )
  # The interval: Student's t about the loss, at the level of the estimate.
  t <- stats::qt(0.975, check_estimate(motion, "motion", NULL)$degrees)
  expect_equal(there$energy_loss_high_j, there$energy_loss_j + t * there$energy_loss_se_j)
  expect_equal(there$energy_loss_low_j, there$energy_loss_j - t * there$energy_loss_se_j)
  # The inertia's own uncertainty is a common factor.
  sure <- energy_loss(motion, 1, 4)
  unsure <- energy_loss(
    estimate_motion(coasting(), inertia = measured(0.05, 0.005), breaks = "none"), 1, 4
  )
  expect_equal(
    unsure$energy_loss_se_j, sqrt(sure$energy_loss_se_j^2 + (0.1 * sure$energy_loss_j)^2)
  )
})

test_that("augment() adds samples and leave-one-out residuals of s.d. 1", {
  motion <- estimate_motion(coasting(n = 1000), breaks = "none")
  all <- augment(motion)
  expect_equal(all$theta_sample_rad, coasting(n = 1000)$theta_rad)
  expect_equal(stats::sd(all$theta_residual), 1, tolerance = 0.1)
  expect_s3_class(all, "rot_estimate")
  expect_false(inherits(motion[1:3, ], "rot_estimate"))
  about <- glance(motion)
  expect_equal(about$samples, 1000)
  expect_within(about$theta_scatter_rad, 1e-3, 0.1)
  expect_setequal(
    setdiff(c(names(all), names(about), names(motion_events(motion))), column_table()$name),
    character()
  )
})

test_that("print says what was found", {
  motion <- estimate_motion(coasting(), breaks = c(switch = 3))
  expect_match(paste(capture.output(print(motion)), collapse = " "), "switch at 3 s")
  expect_equal(motion_events(motion)$time_s, 3)
  expect_true(all(c("break", "") %in% motion$flag))
})

test_that("print says what bands do not hold: slow errors, a constant of a counter", {
  lines <- function(record) tibble::tbl_sum(estimate_motion(record, breaks = "none"))
  slow <- function(record) {
    as.numeric(sub("^.*over ([0-9.e-]+) s or more.*$", "\\1", lines(record)[["Slow errors"]]))
  }
  record <- coasting(n = 300)
  first <- slow(record)
  stretched <- slow(transform(record, time_s = 50 * time_s))
  expect_equal(stretched / first, 50, tolerance = 0.1) # two digits are printed
  # An error as slow as that passes the smoother, a fast one does not.
  wave <- function(period_s) 3e-4 * sin(2 * pi * record$time_s / period_s)
  passes <- function(period_s) {
    shaken <- transform(record, theta_rad = theta_rad + wave(period_s))
    both <- lapply(list(record, shaken), estimate_motion, breaks = "none", order = 4)
    stats::sd(both[[2]]$theta_rad - both[[1]]$theta_rad) / stats::sd(wave(period_s))
  }
  half <- passes(2 * pi * first)
  expect_gt(half, 0.4) # 0.53 to 0.61 with four seeds; 0.99 at twice the time, 0.2 at half
  expect_lt(half, 0.8)
  # Of a polynomial all of the record is averaged: no noise slower than a tenth of it is looked for.
  set.seed(1)
  expect_equal(slow(transform(record, theta_rad = 2 * time_s^2 + stats::rnorm(300) / 1e3)), 0.6)
  expect_match(lines(record)[["Bands"]], "wide where the motion is smoother")
  expect_false("Resolution" %in% names(lines(record)))
  counted <- transform(record, theta_rad = 0.05 * floor(theta_rad / 0.05))
  expect_match(lines(counted)[["Resolution"]], "^0.05 rad: .*but for a constant")
})

test_that("noise that is far slower than the motion is said to spoil the intervals", {
  motion <- estimate_motion(coasting(), breaks = "none")
  words <- function(tau_s) {
    attr(motion, "estimate")$noise <- list(
      tau_s = tau_s, white = 0, channel = 0, gain = 9, at_cap = FALSE
    )
    tibble::tbl_sum(motion)[["Noise"]]
  }
  # The smoother's memory is some 0.37 s.
  expect_match(words(0.9), "intervals may not hold")
  expect_no_match(words(0.6), "intervals may not hold")
})

test_that("a forged estimate is refused", {
  motion <- estimate_motion(coasting(), breaks = "none")
  fit <- attr(motion, "estimate")
  fit$core$theta <- "a"
  attr(motion, "estimate") <- fit
  expect_error(predict(motion, 1), class = "rotdyn_error")
  motion <- estimate_motion(coasting(), breaks = 2.5)
  fit <- attr(motion, "estimate")
  fit$breaks$first <- 9 + 0 * fit$breaks$first
  attr(motion, "estimate") <- fit
  expect_error(predict(motion, 1), class = "rotdyn_error_type")
})

test_that("segments that overlap in time need a number", {
  one <- coasting(n = 60)
  two <- coasting(seed = 2, n = 60)
  both <- motion_record(
    rbind(cbind(one, run = 1), cbind(two, run = 2)), time_s = "time_s", theta_rad = "theta_rad",
    segment = "run"
  )
  motion <- estimate_motion(both)
  expect_error(predict(motion, 2), class = "rotdyn_error_value")
  each <- predict(motion, c(2, 2), segment = 1:2)
  expect_equal(each$segment, 1:2)
  expect_lt(max(abs(each$omega_rad_per_s - rate(2)) / each$omega_se_rad_per_s), 4)
  expect_error(predict(motion, 2, segment = 3), class = "rotdyn_error_value")
})

test_that("the loss of a collision is said to be a column of it", {
  expect_error(energy_loss(disks_lock(1, 3, 60, 0)), "friction_loss_j", class = "rotdyn_error_type")
})

test_that("glance tells the smoothness that was fitted", {
  time <- seq(0, 4, by = 0.02)
  set.seed(4)
  estimate <- estimate_motion(data.frame(
    time_s = time, theta_rad = 2 * sin(2 * time) + stats::rnorm(201, sd = 0.01)
  ))
  fit <- attr(estimate, "estimate")
  one <- generics::glance(estimate)
  expect_equal(one$order, fit$fit[1])
  expect_equal(10^one$log10_smoothness, fit$fit[2])
})

test_that("scale and zero of the rates have their part in the error of an energy", {
  time_s <- seq(0, 6, by = 0.02)
  set.seed(4)
  film <- data.frame(
    time_s = time_s, omega_rad_per_s = rate(time_s) + stats::rnorm(length(time_s), sd = 0.01)
  )
  error <- function(...) {
    motion <- estimate_motion(film, inertia = 0.05, breaks = "none", ...)
    energy_loss(motion, 1, 4)$energy_loss_se_j^2
  }
  plain <- error()
  # K = I omega^2/2: by a zero that is off by u it is off by I u times the fall of omega.
  zero <- sqrt(error(rate_bias_u_rad_per_s = 0.02) - plain)
  expect_equal(zero / (0.05 * 0.02 * (rate(1) - rate(4))), 1, tolerance = 0.01)
  scale <- sqrt(error(rate_scale_u = 0.01) - plain)
  expect_equal(scale / (0.01 * 0.05 * (rate(1)^2 - rate(4)^2)), 1, tolerance = 0.01)
})
