# Motions in closed form, with noise of known size.
noisy <- function(time, theta, sd, seed) {
  set.seed(seed)
  data.frame(time_s = time, theta_rad = theta + stats::rnorm(length(time), sd = sd))
}

test_that("a polynomial motion without noise comes back exact", {
  time <- sqrt(2) * (0:60) / 60
  exact <- data.frame(time_s = time, theta_rad = 0.3 + 2 * time - 1.7 * time^2)
  motion <- estimate_motion(exact)
  expect_equal(motion$theta_rad, exact$theta_rad, tolerance = 1e-13)
  expect_equal(motion$omega_rad_per_s, 2 - 3.4 * time, tolerance = 1e-11)
  expect_equal(motion$alpha_rad_per_s2, rep(-3.4, 61), tolerance = 1e-9)
  expect_lt(max(motion$omega_se_rad_per_s), 1e-10)
  expect_true(all(abs(motion$omega_rad_per_s - (2 - 3.4 * time)) < 6 * motion$omega_se_rad_per_s))
})

test_that("intervals hold the true rate and acceleration, and errors are of the right size", {
  time <- seq(0, 10, length.out = 500)
  held <- vapply(1:20, function(seed) {
    motion <- estimate_motion(noisy(time, 3 * sin(time), 0.01, seed), breaks = "none")
    omega <- 3 * cos(time)
    alpha <- -3 * sin(time)
    c(
      mean(omega >= motion$omega_low_rad_per_s & omega <= motion$omega_high_rad_per_s),
      mean(alpha >= motion$alpha_low_rad_per_s2 & alpha <= motion$alpha_high_rad_per_s2),
      sqrt(mean((motion$omega_rad_per_s - omega)^2)) / mean(motion$omega_se_rad_per_s)
    )
  }, double(3))
  expect_gt(mean(held[1, ]), 0.91)
  expect_lt(mean(held[1, ]), 0.99)
  expect_gt(mean(held[2, ]), 0.93)
  expect_lt(abs(mean(held[3, ]) - 1), 0.2)
})

test_that("torque, power and energy follow from the inertia", {
  time <- seq(0, 4, length.out = 200)
  record <- noisy(time, 5 * time^2, 1e-3, 3)
  motion <- estimate_motion(record, inertia = 0.2, breaks = "none")
  expect_equal(motion$net_torque_n_m, 0.2 * motion$alpha_rad_per_s2)
  expect_equal(motion$net_torque_se_n_m, 0.2 * motion$alpha_se_rad_per_s2)
  expect_equal(motion$power_w, 0.2 * motion$alpha_rad_per_s2 * motion$omega_rad_per_s)
  expect_equal(motion$rotational_kinetic_energy_j, 0.1 * motion$omega_rad_per_s^2)
  body <- estimate_motion(record, inertia = body_disk(2, 0.25), breaks = "none")
  expect_equal(body$net_torque_n_m, 0.0625 * body$alpha_rad_per_s2)
  # The applied torque works against the resistance.
  pushed <- estimate_motion(
    record, inertia = 0.2, resistance = resistance(viscous_n_m_s = 0.1), breaks = "none"
  )
  expect_equal(
    pushed$applied_torque_n_m, 0.2 * pushed$alpha_rad_per_s2 + 0.1 * pushed$omega_rad_per_s
  )
  expect_error(
    estimate_motion(record, resistance = resistance(0.1)), class = "rotdyn_error_missing"
  )
})

test_that("a motion that turns backwards is estimated as its mirror image", {
  time <- seq(0, 5, length.out = 200)
  record <- noisy(time, 4 * time + sin(time), 1e-3, 4)
  motion <- estimate_motion(record)
  record$theta_rad <- -record$theta_rad
  mirrored <- estimate_motion(record)
  expect_equal(mirrored$omega_rad_per_s, -motion$omega_rad_per_s)
  expect_equal(mirrored$alpha_se_rad_per_s2, motion$alpha_se_rad_per_s2)
})

test_that("too few samples and turns that are not seen are refused", {
  time <- seq(0, 1, length.out = 10)
  expect_error(estimate_motion(noisy(time, time, 0.01, 1)), class = "rotdyn_error_size")
  time <- seq(0, 1, length.out = 20)
  expect_warning(estimate_motion(noisy(time, time, 0.01, 1)), class = "rotdyn_warning_size")
  time <- seq(0, 4, length.out = 41)
  fast <- noisy(time, 40 * time, 0.01, 1)
  expect_error(estimate_motion(fast), class = "rotdyn_error_value")
  expect_equal(
    estimate_motion(fast, turns = "counted")$omega_rad_per_s, rep(40, 41), tolerance = 1e-2
  )
  expect_error(estimate_motion(1:10), class = "rotdyn_error_type")
  expect_error(estimate_motion(fast, braeks = "none"), class = "rotdyn_error_argument")
})

test_that("rates give rate and acceleration, and the angle turned", {
  time <- seq(0, 10, by = 0.01)
  set.seed(5)
  record <- data.frame(
    time_s = time, omega_rad_per_s = 2 * cos(time) + stats::rnorm(length(time), sd = 0.02)
  )
  motion <- estimate_motion(record)
  off <- function(x, truth, se) sqrt(mean(((x - truth) / se)^2))
  expect_lt(off(motion$omega_rad_per_s, 2 * cos(time), motion$omega_se_rad_per_s), 1.6)
  expect_lt(off(motion$theta_rad, 2 * sin(time), pmax(motion$theta_se_rad, 1e-9)), 2.5)
  expect_equal(motion$theta_rad[1], 0)
  scaled <- estimate_motion(record, rate_scale_u = 0.02)
  expect_equal(
    scaled$omega_se_rad_per_s^2,
    motion$omega_se_rad_per_s^2 + (0.02 * motion$omega_rad_per_s)^2
  )
})

# ---- breaks --------------------------------------------------------------------------------------

# omega jumps at `at`, then keeps its rate.
struck <- function(seed, at = 2.013, jump = 6, n = 201, sd = 1e-3) {
  time <- seq(0, 4, length.out = n)
  noisy(time, 2 * time + pmax(time - at, 0) * jump, sd, seed)
}

test_that("an impact is found, with its time and jump", {
  events <- do.call(rbind, lapply(1:8, function(seed) motion_events(estimate_motion(struck(seed)))))
  expect_equal(events$event, rep("impact", 8))
  expect_lt(max(abs(events$time_s - 2.013)), 0.003)
  expect_lt(max(abs((events$time_s - 2.013) / events$time_se_s)), 4)
  expect_lt(max(abs((events$omega_jump_rad_per_s - 6) / events$omega_jump_se_rad_per_s)), 4)
  negative <- motion_events(estimate_motion(struck(1, jump = -9)))
  expect_equal(negative$omega_jump_rad_per_s, -9, tolerance = 0.01)
})

test_that("an outlier beside an impact is left out, and no break of its own", {
  for (off in -2:3) {
    record <- struck(11)
    record$theta_rad[101 + off] <- record$theta_rad[101 + off] + 0.03
    motion <- estimate_motion(record)
    expect_equal(motion_events(motion)$time_s, 2.013, tolerance = 0.005)
    expect_match(motion$flag[101 + off], "outlier")
  }
})

test_that("a switched torque and a stop are told apart", {
  time <- seq(0, 6, by = 0.02)
  switched <- noisy(time, 3 * time + pmax(time - 3.004, 0)^2 * 4, 1e-3, 2)
  events <- motion_events(estimate_motion(switched))
  expect_equal(events$event, "switch")
  expect_equal(events$time_s, 3.004, tolerance = 0.003)
  expect_equal(events$alpha_jump_rad_per_s2, 8, tolerance = 0.1)
  expect_equal(events$omega_jump_rad_per_s, 0)
  stopped <- noisy(time, -2.5 * pmin(time, 4)^2 + 20 * pmin(time, 4), 1e-3, 3)
  events <- motion_events(estimate_motion(stopped))
  expect_equal(events$event, "stop")
  expect_equal(events$time_s, 4, tolerance = 0.005)
  # Backwards as well.
  stopped$theta_rad <- -stopped$theta_rad
  expect_equal(motion_events(estimate_motion(stopped))$event, "stop")
})

test_that("the ends of a torque ramp are found, and the motion between is smoother for it", {
  # alpha grows at 6 rad/s^3 from 2 s to 5 s, else it is constant.
  time <- seq(0, 8, by = 0.01)
  alpha <- 6 * pmax(pmin(time, 5) - 2, 0)
  theta <- pmax(time - 2, 0)^3 - pmax(time - 5, 0)^3
  estimates <- function(...) {
    lapply(1:8, function(seed) estimate_motion(noisy(time, theta, 2e-3, seed), ...))
  }
  ramps <- estimates()
  for (motion in ramps) {
    events <- motion_events(motion)
    expect_equal(events$event, c("ramp", "ramp"))
    expect_lt(max(abs(events$time_s - c(2, 5)) / events$time_se_s), 4)
    expect_equal(events$omega_jump_rad_per_s, c(0, 0))
    expect_equal(events$alpha_jump_rad_per_s2, c(0, 0))
  }
  rms <- function(motion) sqrt(mean((motion$alpha_rad_per_s2 - alpha)^2))
  expect_lt(mean(vapply(ramps, rms, 0)), 0.7 * mean(vapply(estimates(breaks = "none"), rms, 0)))
  inside <- vapply(ramps, function(x) {
    mean(abs(x$alpha_rad_per_s2 - alpha) < 2 * x$alpha_se_rad_per_s2)
  }, 0)
  expect_gt(mean(inside), 0.9)
  known <- estimate_motion(noisy(time, theta, 2e-3, 1), breaks = c(ramp = 2, ramp = 5))
  expect_equal(motion_events(known)$event, c("ramp", "ramp"))
})

test_that("smooth motions have no breaks", {
  time <- seq(0, 8, by = 0.02)
  n <- vapply(1:10, function(seed) {
    nrow(motion_events(estimate_motion(noisy(time, 2 * sin(2.5 * time), 1e-3, seed))))
  }, 1L)
  expect_equal(sum(n), 0)
})

test_that("known breaks are used as they are, alone or with nothing between them", {
  record <- struck(4)
  motion <- estimate_motion(record, breaks = c(impact = 2.013))
  expect_equal(motion_events(motion)$event, "impact")
  expect_equal(motion_events(motion)$time_s, 2.013)
  off <- motion$omega_rad_per_s - ifelse(motion$time_s < 2.013, 2, 8)
  expect_lt(sqrt(mean(off^2)), 3e-3)
  # The kind is decided where it is not said.
  expect_equal(motion_events(estimate_motion(record, breaks = 2.013))$event, "impact")
  twice <- estimate_motion(record, breaks = c(2.0131, 2.0139))
  expect_equal(nrow(motion_events(twice)), 2)
  expect_true(all(is.finite(twice$omega_rad_per_s)))
  expect_true(all(is.finite(twice$omega_se_rad_per_s)))
  expect_error(estimate_motion(record, breaks = 7), class = "rotdyn_error_time")
  expect_error(estimate_motion(record, breaks = "fnd"), class = "rotdyn_error_value")
  expect_error(estimate_motion(record, breaks = c(bang = 1)), class = "rotdyn_error_value")
})

test_that("the order is chosen by what is smooth between breaks", {
  # A cord that pulls from 1 s to 4 s: exponentials between, for which order 3 is too low.
  time <- seq(0, 8, by = 1 / 30)
  omega <- 20 * (1 - exp(-0.32 * pmax(pmin(time, 4) - 1, 0))) * exp(-0.32 * pmax(time - 4, 0))
  u <- pmax(pmin(time, 4) - 1, 0)
  last <- 20 * (1 - exp(-0.96))
  theta <- 20 * u - 20 * (1 - exp(-0.32 * u)) / 0.32 +
    last * (1 - exp(-0.32 * pmax(time - 4, 0))) / 0.32
  motion <- estimate_motion(noisy(time, theta, 0.0025, 22))
  expect_equal(nrow(motion_events(motion)), 2)
  expect_gte(glance(motion)$order, 4)
  expect_lt(sqrt(mean((motion$omega_rad_per_s - omega)^2)), 0.02)
})

test_that("bands are wider at an end where the motion is rougher than elsewhere", {
  # An exponential: all its derivatives are largest at the start.
  time <- seq(0, 12, length.out = 800)
  theta <- 30 * (1 - exp(-time / 3))
  alpha <- -30 / 9 * exp(-time / 3)
  first <- time < 0.36
  inside <- vapply(1:20, function(seed) {
    motion <- estimate_motion(noisy(time, theta, 3e-3, seed), breaks = "none")
    mean((abs(motion$alpha_rad_per_s2 - alpha) < 2 * motion$alpha_se_rad_per_s2)[first])
  }, 0)
  # .73 without.
  expect_gt(mean(inside), 0.85)
  steady <- estimate_motion(noisy(time, 0.3 * time^2, 3e-3, 1))
  expect_lt(max(0, attr(steady, "estimate")$ends$excess), 3)
})

test_that("bands of an oscillation are narrowed by what blocks left out tell, others are not", {
  time <- seq(0, 10, length.out = 1500)
  # `lambda`: that of the likelihood, before cross-validation lowers it.
  share <- function(theta, sd, lambda = NULL) {
    vapply(1:5, function(seed) {
      motion <- estimate_motion(noisy(time, theta, sd, seed), breaks = "none", order = 4)
      fit <- attr(motion, "estimate")
      if (is.null(lambda)) return(fit$process)
      fit$fit[2] <- lambda
      process_share(fit)
    }, 0)
  }
  swings <- share(2 * sin(3 * time), 2e-3, 10^-6.52)
  expect_lt(mean(swings), 0.8)
  expect_gte(min(swings), 0.3)
  expect_equal(share(3 * time^2, 0.01), rep(1, 5))
  motion <- estimate_motion(noisy(time, 2 * sin(3 * time), 2e-3, 6), breaks = "none")
  off <- (motion$omega_rad_per_s - 6 * cos(3 * time)) / motion$omega_se_rad_per_s
  expect_lt(sqrt(mean(off^2)), 1.15)
  again <- predict(motion, time)
  expect_equal(again$omega_se_rad_per_s, motion$omega_se_rad_per_s, tolerance = 1e-6)
})

test_that("an oscillation has the order and smoothness that predict between samples", {
  time <- seq(0, 10, length.out = 1500)
  error <- vapply(1:5, function(seed) {
    motion <- estimate_motion(noisy(time, 2 * sin(3 * time), 0.02, seed), breaks = "none")
    sqrt(mean((motion$alpha_rad_per_s2 + 18 * sin(3 * time))^2))
  }, 0)
  # By the likelihood of orders 3 and 4 alone .34.
  expect_lt(mean(error), 0.28)
})

test_that("the error of the time of a stop that was found counts, that of a known one does not", {
  time <- seq(0, 10, by = 0.01)
  omega <- ifelse(time < 6, -(6 - time), 0)
  theta <- ifelse(time < 6, (6 - time)^2 / 2, 0)
  near <- abs(time - 6) < 0.3
  inside <- function(...) {
    rowMeans(vapply(1:10, function(seed) {
      motion <- estimate_motion(noisy(time, theta, 2e-3, seed), ...)
      c(
        held = mean((abs(motion$omega_rad_per_s - omega) < 2 * motion$omega_se_rad_per_s)[near]),
        se = mean(motion$omega_se_rad_per_s[near])
      )
    }, c(0, 0)))
  }
  found <- inside()
  known <- inside(breaks = c(stop = 6))
  expect_gt(found["held"], 0.85)
  expect_gt(known["held"], 0.85)
  expect_gt(found["se"], 1.1 * known["se"])
})

# ---- traps ---------------------------------------------------------------------------------------

test_that("a body at rest for half the record of a counter keeps honest errors", {
  step <- 2 * pi / 600
  time <- seq(0, 8, by = 0.02)
  truth <- pmax(time - 4, 0)^2 * 1.5
  counts <- floor(truth / step + 0.3) + 0.5 - 0.3
  record <- motion_record(
    data.frame(t = time, c = floor(truth / step + 0.3)), time_s = "t", counts = "c",
    counts_per_turn = 600
  )
  motion <- estimate_motion(record)
  expect_gte(glance(motion)$theta_scatter_rad, step / sqrt(12) * 0.999)
  omega <- pmax(time - 4, 0) * 3
  inside <- omega >= motion$omega_low_rad_per_s & omega <= motion$omega_high_rad_per_s
  expect_gt(mean(inside), 0.9)
  expect_true(all(is.finite(motion$alpha_se_rad_per_s2)))
})

test_that("a slow counter is read by the times of its edges", {
  step <- 2 * pi / 36
  time <- seq(0, 10, length.out = 1000)
  held <- vapply(seq(0, 0.9, by = 0.15), function(phase) {
    truth <- 2 * sin(2.2 * time + phase)
    record <- data.frame(time_s = time, theta_rad = step * (floor(truth / step) + 0.5))
    motion <- estimate_motion(record)
    omega <- 4.4 * cos(2.2 * time + phase)
    expect_lt(sqrt(mean((motion$omega_rad_per_s - omega)^2)), 0.09)
    expect_equal(nrow(augment(motion)), 1000)
    mean(abs(motion$omega_rad_per_s - omega) < 2 * motion$omega_se_rad_per_s)
  }, 0)
  expect_gt(mean(held), 0.9)
})

test_that("a counter is read by its edges where it is slow, by its counts elsewhere", {
  # From rest to 8 rad/s: the first count lasts 64 samples, the last ones half a sample.
  step <- 2 * pi / 96
  time <- seq(0, 6, length.out = 1500)
  omega <- 8 * (1 - (1 + time) * exp(-time))
  truth <- 8 * (time - 2 + (2 + time) * exp(-time))
  record <- data.frame(time_s = time, theta_rad = step * round(truth / step + 0.2))
  record$theta_rad[c(700, 1100)] <- record$theta_rad[c(700, 1100)] + 1
  motion <- estimate_motion(record)
  off <- motion$omega_rad_per_s - omega
  # By counts alone 0.0068 rad/s.
  expect_lt(sqrt(mean(off[time > 0.5]^2)), 0.005)
  expect_gt(mean(abs(off) < 2 * motion$omega_se_rad_per_s), 0.89)
  expect_equal(which(motion$flag == "outlier"), c(700L, 1100L))
  expect_false(anyNA(augment(motion)$theta_residual))
  expect_equal(nrow(motion_events(motion)), 0)
})

test_that("gaps widen the errors and are flagged; segments share the scatter and nothing else", {
  time <- seq(0, 10, by = 0.02)
  record <- noisy(time, 3 * sin(time), 2e-3, 6)
  gap <- record[time < 4 | time > 4.5, ]
  motion <- estimate_motion(gap)
  expect_equal(sum(grepl("gap", motion$flag)), 2)
  inside <- predict(motion, c(3, 4.25))
  expect_gt(inside$omega_se_rad_per_s[2], inside$omega_se_rad_per_s[1])
  expect_lt(abs(inside$omega_rad_per_s[2] - 3 * cos(4.25)), 4 * inside$omega_se_rad_per_s[2])
  record$segment <- rep(1:2, c(250, 251))
  record$theta_rad[251:501] <- record$theta_rad[251:501] + 100
  both <- estimate_motion(record)
  expect_equal(both$omega_rad_per_s[c(100, 400)], 3 * cos(time[c(100, 400)]), tolerance = 0.02)
  expect_true(is.na(predict(both, 4.99)$omega_rad_per_s))
})

test_that("a range of 1e8 times the noise is no trouble", {
  time <- seq(0, 10, by = 0.02)
  record <- noisy(time, 1e5 * time + 1e3 * sin(time), 1e-3, 7)
  motion <- estimate_motion(record, turns = "counted")
  off <- (motion$omega_rad_per_s - 1e5 - 1e3 * cos(time)) / motion$omega_se_rad_per_s
  expect_lt(sqrt(mean(off^2)), 2)
})

test_that("smoothness at the ends of its range is said", {
  time <- seq(0, 10, by = 0.05)
  line <- estimate_motion(noisy(time, 3 * time, 0.01, 8))
  expect_equal(glance(line)$smoothness, "polynomial")
  expect_match(paste(capture.output(print(line)), collapse = " "), "polynomial of the time")
  wild <- estimate_motion(noisy(time, 0.2 * sin(15 * time), 1e-6, 9))
  expect_match(glance(wild)$smoothness, "joins")
})

test_that("type B of a gyroscope and of a clock is added, and a bias is measured at rest", {
  time <- seq(0, 20, by = 0.01)
  set.seed(10)
  rates <- ifelse(time < 5, 0, 2 * sin(time - 5))
  record <- data.frame(
    time_s = time, omega_rad_per_s = rates + 0.03 + stats::rnorm(length(time), sd = 0.01)
  )
  motion <- estimate_motion(record, rest_s = c(0, 5))
  expect_lt(abs(motion$omega_rad_per_s[200]), 0.01)
  plain <- estimate_motion(record)
  # The bias's error turns the angle more and more.
  added <- sqrt(motion$theta_se_rad[2001]^2 - plain$theta_se_rad[2001]^2) / 20
  expect_gt(added, 0.01 / sqrt(500) / 4)
  expect_lt(added, 0.01 / sqrt(500) * 4)
  slow <- estimate_motion(record, clock_u = 0.01)
  expect_equal(
    slow$alpha_se_rad_per_s2^2,
    plain$alpha_se_rad_per_s2^2 + (0.02 * plain$alpha_rad_per_s2)^2
  )
  expect_error(estimate_motion(record, rest_s = 3), class = "rotdyn_error_value")
})

test_that("an angle and a rate together are better than each, with the bands of both", {
  time <- seq(0, 8, by = 0.02)
  set.seed(12)
  record <- data.frame(
    time_s = time, theta_rad = 3 * sin(time) + stats::rnorm(401, sd = 0.02),
    omega_rad_per_s = 3 * cos(time) + stats::rnorm(401, sd = 0.05)
  )
  both <- estimate_motion(record)
  angle <- estimate_motion(record[, 1:2])
  rate <- estimate_motion(record[, c(1, 3)])
  expect_lt(mean(both$omega_se_rad_per_s), mean(angle$omega_se_rad_per_s))
  expect_lt(mean(both$omega_se_rad_per_s), mean(rate$omega_se_rad_per_s) * 1.01)
  about <- glance(both)
  expect_within(about$theta_scatter_rad, 0.02, 0.15)
  expect_within(about$omega_scatter_rad_per_s, 0.05, 0.15)
  expect_gt(mean(abs(both$omega_rad_per_s - 3 * cos(time)) < 2 * both$omega_se_rad_per_s), 0.8)
})

test_that("jitter of the clock widens the scatter where the body is fast", {
  time <- seq(0, 8, by = 0.02)
  set.seed(13)
  late <- time + stats::rnorm(401, sd = 1e-3)
  record <- data.frame(time_s = time, theta_rad = 20 * late - late^2 + stats::rnorm(401, sd = 5e-3))
  motion <- estimate_motion(record, clock_jitter_s = 1e-3)
  omega <- 20 - 2 * time
  expect_gt(mean(abs(motion$omega_rad_per_s - omega) < 2.1 * motion$omega_se_rad_per_s), 0.8)
  expect_lt(abs(log(glance(motion)$theta_scatter_rad / 5e-3)), 0.3)
})

test_that("degrees of freedom are the samples less what the motion takes", {
  time <- seq(0, 10, length.out = 300)
  motion <- estimate_motion(noisy(time, 2 * time - 0.3 * time^2, 0.01, 2), breaks = "none")
  # Three numbers make the parabola, the smoother takes some more.
  expect_lt(glance(motion)$degrees, 300 - 3 + 0.5)
  expect_gt(glance(motion)$degrees, 300 - 30)
})

test_that("errors that are correlated in time are recognised and allowed for", {
  time <- seq(0, 12, length.out = 600)
  wheel <- scene_axle(0.0625, resistance = resistance(0.01, 2e-4), omega0_rad_per_s = 20)
  run <- trajectory(wheel, time)
  held <- vapply(1:6, function(seed) {
    set.seed(seed)
    e <- stats::rnorm(600) * c(1, rep(sqrt(1 - 0.9^2), 599)) * 0.01
    theta <- run$theta_rad + as.vector(stats::filter(e, 0.9, "recursive"))
    motion <- estimate_motion(data.frame(time_s = time, theta_rad = theta))
    about <- glance(motion)
    # exp(-h/tau) = 0.9: tau is 9.5 spacings.
    expect_gt(about$correlation_time_s, 2 * time[2])
    expect_lt(about$white_share, 0.5)
    expect_match(paste(names(tibble::tbl_sum(motion)), collapse = " "), "Noise")
    expect_lt(about$outliers + about$breaks, 2)
    c(
      mean(abs(motion$omega_rad_per_s - run$omega_rad_per_s) < 2 * motion$omega_se_rad_per_s),
      about$theta_scatter_rad
    )
  }, double(2))
  # 0.35 to 0.6 where white noise is assumed.
  expect_gt(mean(held[1, ]), 0.85)
  expect_within(stats::median(held[2, ]), 0.01, 0.4)
  white <- estimate_motion(noisy(seq(0, 10, by = 0.02), 3 * sin(seq(0, 10, by = 0.02)), 2e-3, 6))
  expect_identical(glance(white)$correlation_time_s, 0)
  expect_false(any(grepl("Noise", names(tibble::tbl_sum(white)))))
})

test_that("errors without a white part leave its share at the bound of the search", {
  # The likelihood is flat below a share of exp(-7) = 0.0009: nothing there may be made up.
  time <- 0.02 * (0:399)
  keep <- exp(-0.02 / 0.3)
  shares <- vapply(c(3, 4), function(seed) {
    set.seed(seed)
    e <- stats::filter(stats::rnorm(400, sd = 0.01 * sqrt(1 - keep^2)), keep, "recursive")
    theta <- 0.3 * time + 0.1 * time^2 + as.vector(e)
    about <- glance(estimate_motion(data.frame(time_s = time, theta_rad = theta)))
    expect_gt(about$correlation_time_s, 0.1)
    about$white_share
  }, 0)
  expect_true(all(shares > 0.9 * exp(-7) & shares < 0.05))
})

test_that("the smoother with correlated errors is the exact one: generalised least squares", {
  # theta = a polynomial and lambda times the covariance of the process of order 3,
  # int_0^min(s, t) (s - u)^2 (t - u)^2 du / 4, in spacings.
  set.seed(1)
  n <- 60
  time <- cumsum(stats::runif(n, 0.05, 0.15))
  theta <- 5 * sin(time) + stats::rnorm(n)
  w <- stats::runif(n, 0.3, 0.8)
  slow <- stats::runif(n, 0.3, 1)
  clock <- cumsum(stats::runif(n, 0.05, 0.8))
  core <- list(
    time_s = time, theta = theta, omega = NULL, w_theta = w, w_omega = NULL,
    segment = rep(1L, n), floor = c(0, 0), slow = slow, clock = clock, slow_channel = 0
  )
  got <- .Call(ffi_smooth_rows, core, no_breaks, c(3, 1e-4, 1, 1), no_times)$samples
  s <- (time - time[1]) / mean(diff(time))
  low <- outer(s, s, pmin)
  apart <- abs(outer(s, s, `-`))
  covariance <- 1e-4 * (low^5 / 20 + apart * low^4 / 8 + apart^2 * low^3 / 12)
  expect_equal(covariance[5, 9] * 4e4, stats::integrate(function(u) {
    (s[5] - u)^2 * (s[9] - u)^2
  }, 0, s[5], rel.tol = 1e-12)$value, tolerance = 1e-9)
  x <- outer(s, 0:2, `^`)
  v <- covariance + diag(w^2) + outer(slow, slow) * exp(-abs(outer(clock, clock, `-`)))
  inverse <- solve(v)
  spread <- solve(t(x) %*% inverse %*% x)
  b <- spread %*% t(x) %*% inverse %*% theta
  mean <- x %*% b + covariance %*% inverse %*% (theta - x %*% b)
  a <- x - covariance %*% inverse %*% x
  variance <- diag(covariance - covariance %*% inverse %*% covariance + a %*% spread %*% t(a))
  expect_lt(max(abs(got$theta - mean) / sqrt(variance)), 1e-6)
  expect_equal(got$v00, variance, tolerance = 1e-5)
})

test_that("a counter at rest is known to its resolution", {
  step <- 2 * pi / 64
  time <- seq(0, 10, by = 0.01)
  truth <- pmin(pmax(0, 3 * (time - 3)), 9) # at rest, 3 rad/s, at rest
  motion <- estimate_motion(
    data.frame(time_s = time, theta_rad = step * floor(truth / step + 0.3))
  )
  expect_identical(motion_events(motion)$event[1:2], c("impact", "impact"))
  expect_equal(motion_events(motion)$time_s, c(3, 6), tolerance = 0.01)
  rest <- time < 2.9 | time > 6.1
  band <- motion$theta_high_rad - motion$theta_low_rad
  # 2 x 1.96 step/sqrt(12) is 1.13 steps: 4 steps and omega to 1.8 rad/s before.
  expect_lt(max(band[rest]), 1.5 * step)
  expect_gt(stats::median(band[rest]), 0.75 * step)
  expect_lt(max(motion$omega_se_rad_per_s[rest]), 0.1)
  expect_lt(max(abs(motion$omega_rad_per_s[rest])), 0.05)
  # One step in the whole record: its size is the resolution.
  once <- data.frame(time_s = time, theta_rad = step * (time > 5))
  expect_equal(attr(motion_record(once), "record")$resolution[["theta_rad"]], step)
  once <- estimate_motion(once)
  expect_within(glance(once)$theta_scatter_rad, step / sqrt(12), 1e-6)
  expect_equal(glance(once)$outliers, 0)
})

test_that("an angle and a rate that contradict each other are flagged", {
  time <- seq(0, 10, by = 0.01)
  set.seed(1)
  record <- function(factor, bias = 0) {
    data.frame(
      time_s = time, theta_rad = sin(time) + stats::rnorm(1001, 0, 1e-3),
      omega_rad_per_s = factor * cos(time) + bias + stats::rnorm(1001, 0, 0.01)
    )
  }
  for (factor in c(5, 0.2, -1)) {
    warning <- NULL
    motion <- withCallingHandlers(estimate_motion(record(factor), breaks = "none"),
      rotdyn_warning_value = function(w) {
        warning <<- conditionMessage(w)
        invokeRestart("muffleWarning")
      }
    )
    expect_match(warning, "contradict")
    expect_equal(attr(motion, "estimate")$contradiction, factor, tolerance = 0.02)
    expect_true("Contradiction" %in% names(tibble::tbl_sum(motion)))
  }
  expect_no_warning(motion <- estimate_motion(record(1.03, 0.01), breaks = "none"))
  expect_false("Contradiction" %in% names(tibble::tbl_sum(motion)))
})

test_that("the help names every kind of break that is taken", {
  record <- data.frame(time_s = 0:60 / 10, theta_rad = sin(0:60 / 10))
  error <- expect_error(
    estimate_motion(record, breaks = c(bang = 1)), class = "rotdyn_error_value"
  )
  kinds <- c("impact", "switch", "stop", "ramp")
  for (kind in kinds) expect_match(conditionMessage(error), kind)
  page <- file.path(Sys.getenv("ROTDYN_ROOT", file.path("..", "..")), "man", "estimate_motion.Rd")
  skip_if_not(file.exists(page))
  text <- paste(readLines(page), collapse = " ")
  described <- regmatches(text, regexpr("item[{]breaks[}].*?known[.][}]", text, perl = TRUE))
  for (kind in kinds) expect_match(described, paste0("code{", kind, "}"), fixed = TRUE)
})
