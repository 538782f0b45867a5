# A disk of 0.0625 kg m^2 from 20 rad/s on, sampled n times until `end`.
coasting <- function(n = 400, end = 8, coulomb = 0.075, viscous = 0.00625, quadratic = 2.5e-4,
                     omega0 = 20) {
  scene <- scene_axle(
    0.0625, NULL, resistance(viscous, quadratic, coulomb), omega0_rad_per_s = omega0
  )
  trajectory(scene, seq(0, end, length.out = n))
}
noisy <- function(motion, sigma, column = "theta_rad", seed = 1) {
  set.seed(seed)
  noise <- stats::rnorm(nrow(motion), 0, sigma)
  out <- data.frame(time_s = motion$time_s, y = motion[[column]] + noise)
  names(out)[2] <- column
  out
}
truth <- c(1.2, 0.1, 0.004)

test_that("exact data come back exact, with an error of rounding, from angles and rates", {
  for (end in c(8, 14)) { # it stops at 10.7 s
    motion <- coasting(end = end)
    for (column in c("theta_rad", "omega_rad_per_s")) {
      fit <- fit_coast_down(noisy(motion, 0, column))
      expect_identical(fit$loss, c("coulomb", "viscous", "quadratic"))
      expect_equal(fit$value, truth, tolerance = 1e-11)
      expect_lt(max(fit$standard_error / truth), 1e-10)
      expect_identical(fit$status, rep("acts", 3))
      expect_identical(fit$unit, c("rad/s^2", "1/s", "1/rad"))
    }
  }
})

test_that("the scene of a fit has the fitted motion, to 1e-14", {
  for (end in c(4, 8, 14)) {
    fit <- fit_coast_down(noisy(coasting(end = end), 0.005), inertia = 0.0625)
    motion <- trajectory(as_scene(fit), seq(0, end, length.out = 300))
    curve <- predict(fit, motion$time_s)
    expect_lt(max(abs(curve$theta_rad - motion$theta_rad)), 1e-14 * max(motion$theta_rad))
    expect_lt(max(abs(curve$omega_rad_per_s - motion$omega_rad_per_s)), 1e-14 * 20)
    moving <- motion$omega_rad_per_s > 0
    alpha <- motion$net_torque_n_m / 0.0625
    expect_equal(curve$alpha_rad_per_s2[moving], alpha[moving], tolerance = 1e-11)
  }
})

test_that("with an inertia losses are torques, and its uncertainty is apart", {
  samples <- noisy(coasting(), 0.005)
  per_inertia <- fit_coast_down(samples)
  fit <- fit_coast_down(samples, inertia = measured(0.0625, 0.00125))
  expect_equal(fit$value, per_inertia$value * 0.0625, tolerance = 1e-12)
  expect_equal(fit$standard_error, per_inertia$standard_error * 0.0625, tolerance = 1e-12)
  expect_equal(fit$u_inertia, fit$value * 0.02, tolerance = 1e-12)
  expect_identical(fit$unit, c("N m", "N m s", "N m s^2"))
  expect_false("u_inertia" %in% names(per_inertia))
})

test_that("bands are the derivatives of the motion times the covariance", {
  fit <- fit_coast_down(noisy(coasting(), 0.005))
  run <- attr(fit, "fit")$runs[[1]]
  at <- c(0, 2.5, 7.7)
  free <- c("theta0", "omega0", "coulomb", "viscous", "quadratic")
  # Central differences of the fitted motion by each parameter.
  slope <- vapply(free, function(name) {
    step <- 1e-5 * max(abs(run$p[[name]]), 0.1)
    moved <- lapply(c(-1, 1), function(side) {
      p <- run$p
      p[name] <- p[[name]] + side * step
      rows <- .Call(rotdyn:::ffi_coast_rows, run$problem, unname(p[1:7]), 0, at)[1:2]
      omega <- rows[[2]]
      alpha <- -(p[["coulomb"]] + p[["viscous"]] * omega + p[["quadratic"]] * omega^2)
      c(unlist(rows), alpha)
    })
    (moved[[2]] - moved[[1]]) / (2 * step)
  }, numeric(9))
  want <- sqrt(rowSums((slope %*% run$covariance[free, free]) * slope))
  got <- predict(fit, at)
  expect_equal(got$theta_rad_se, unname(want[1:3]), tolerance = 1e-6)
  expect_equal(got$omega_rad_per_s_se, unname(want[4:6]), tolerance = 1e-6)
  expect_equal(got$alpha_rad_per_s2_se, unname(want[7:9]), tolerance = 1e-6)
  # alpha = -(a + b omega + k omega^2): its band by differences of predict()'s own speeds.
  steps <- c(-1e-4, 1e-4)
  near <- predict(fit, 2.5 + steps)
  expect_equal(got$alpha_rad_per_s2[2], diff(near$omega_rad_per_s) / 2e-4, tolerance = 1e-7)
})

test_that("negative omega is the mirror image; times may begin anywhere", {
  samples <- noisy(coasting(), 0.005)
  fit <- fit_coast_down(samples)
  mirrored <- transform(samples, theta_rad = -theta_rad, time_s = time_s - 1000)
  other <- fit_coast_down(mirrored)
  expect_equal(other$value, fit$value, tolerance = 1e-7)
  expect_equal(other$standard_error, fit$standard_error, tolerance = 1e-5)
})

test_that("pulses are fitted by their times", {
  motion <- coasting(end = 9)
  angles <- seq(0, max(motion$theta_rad), by = pi)
  scene <- attr(motion, "run")$scene
  times <- vapply(angles, function(x) time_when(motion, theta_rad = x)$time_s[1], 0)
  set.seed(4)
  pulses <- data.frame(t = times + stats::rnorm(length(times), 0, 2e-4))
  fit <- fit_coast_down(motion_record(pulses, time_s = t, pulses = 2))
  expect_lt(max(abs(fit$value - truth) / fit$standard_error), 3.5)
  expect_lt(max(fit$standard_error / truth), 0.05)
  expect_identical(glance(fit)$sigma_unit, "s")
})

test_that("a loss that is 0 has a limit, and no negative value", {
  found <- vapply(1:12, function(seed) {
    fit <- fit_coast_down(noisy(coasting(quadratic = 0), 0.005, seed = seed))
    expect_true(all(fit$value >= 0 & fit$lower >= 0 & fit$upper >= fit$value))
    fit$status[3] != "acts"
  }, NA)
  expect_gte(sum(found), 10)
  # All of them: a body that keeps its speed.
  set.seed(2)
  samples <- data.frame(time_s = 0:100 / 10, theta_rad = 0:100 / 2 + stats::rnorm(101, 0, 0.001))
  fit <- fit_coast_down(samples)
  expect_false(any(fit$status == "acts"))
  expect_match(fit$status[1], "not separable from viscous and quadratic")
  expect_lt(retarding_torque(fit, 5)$upper, 1e-3)
})

test_that("correlated noise is found, and the errors allow for it", {
  set.seed(5)
  motion <- coasting()
  noise <- as.vector(stats::filter(stats::rnorm(500), 0.9, "recursive"))[101:500] * 0.005
  samples <- data.frame(time_s = motion$time_s, theta_rad = motion$theta_rad + noise)
  fit <- fit_coast_down(samples)
  white <- fit_coast_down(samples, noise = "white")
  # tau = dt/-log(0.9), 0.19 s; the standard errors grow by sqrt((1 + r)/(1 - r)), 4.4.
  expect_gt(glance(fit)$correlation_time_s, 0.08)
  expect_lt(glance(fit)$correlation_time_s, 0.5)
  expect_gt(fit$standard_error[1] / white$standard_error[1], 2.5)
  expect_lt(fit$standard_error[1] / white$standard_error[1], 7)
  expect_lt(max(abs(fit$value - truth) / fit$standard_error), 3)
})

test_that("the wheelchair: figures of the record, and the law is incomplete", {
  file <- shared("data", "measured", "ngimu_wheelchair_coastdown_right.csv")
  rows <- utils::read.csv(file, check.names = FALSE)
  rows <- rows[rows[[1]] >= 9 & rows[[1]] <= 28.5, ]
  record <- motion_record(
    data.frame(t = rows[[1]], w = rows[[3]]), time_s = t, omega_deg_per_s = w
  )
  one <- fit_coast_down(record, losses = "coulomb")
  expect_equal(one$value, 0.2144, tolerance = 0.001)
  expect_true(one$standard_error > 0.001 && one$standard_error < 0.003)
  white <- fit_coast_down(record, losses = "coulomb", noise = "white")
  expect_lt(white$standard_error, 0.0004)
  two <- fit_coast_down(record, losses = c("coulomb", "quadratic"))
  expect_within(two$value, c(0.196, 8.2e-4), 0.02)
  expect_within(two$standard_error, c(0.009, 3.8e-4), 0.05)
  three <- fit_coast_down(record)
  expect_output(print(three), "The law is incomplete: without a bound the viscous loss")
  expect_false(glance(three)$complete)
})

test_that("a straight line is rejected for the roller, which is driven", {
  rows <- utils::read.csv(
    shared("data", "measured", "phyphox_roller_spinup_z_acc.csv"), check.names = FALSE
  )
  rows <- data.frame(time_s = rows[[1]], omega_rad_per_s = rows[[4]])
  expect_error(fit_coast_down(rows), "its speed grows", class = "rotdyn_error_value")
  # A constant torque and constant friction: a straight line of omega(t).
  line <- fit_coast_down(rows, inertia = 1, losses = "coulomb", torque = 5)
  expect_match(residual_tests(line)$finding[2], "incomplete")
  expect_output(print(line), "The law is incomplete")
})

test_that("readings of an encoder at rest count once", {
  motion <- coasting(end = 30) # it stops at 10.7 s
  step <- 2 * pi / 2400
  samples <- data.frame(
    time_s = motion$time_s, theta_rad = step * floor(motion$theta_rad / step) + step / 2
  )
  fit <- fit_coast_down(samples)
  expect_lt(nrow(augment(fit)), 160)
  expect_lt(max(abs(fit$value - truth) / truth), 0.01)
  # The errors of the readings that count.
  kept <- match(augment(fit)$time_s, samples$time_s)
  expect_within(glance(fit)$sigma, stats::sd((samples$theta_rad - motion$theta_rad)[kept]), 0.05)
})

test_that("shares of the energy sum to 1, and are those of the ledger", {
  fit <- fit_coast_down(noisy(coasting(end = 12), 0.005), inertia = 0.0625)
  budget <- loss_budget(fit)
  expect_equal(sum(budget$share), 1, tolerance = 1e-13)
  expect_true(all(budget$lower <= budget$share & budget$share <= budget$upper))
  ledger <- augment(trajectory(as_scene(fit), c(0, 12)))[2, ]
  want <- c(
    ledger$dissipated_coulomb_j, ledger$dissipated_viscous_j, ledger$dissipated_quadratic_j
  )
  expect_equal(budget$energy_j, want, tolerance = 1e-9)
  # Part of the way, against the same.
  fit <- fit_coast_down(noisy(coasting(end = 3), 0.005))
  scene <- as_scene(fit)
  ledger <- augment(trajectory(scene, c(0, 3)))[2, ]
  got <- loss_budget(fit)$energy_over_inertia[2]
  expect_equal(got, ledger$dissipated_viscous_j, tolerance = 1e-9)
})

test_that("a short record does not separate the losses, and still has their sum", {
  motion <- coasting(n = 200, end = 1.5)
  fit <- fit_coast_down(noisy(motion, 0.005, seed = 3))
  expect_output(print(fit), "This record does not separate")
  middle <- mean(range(motion$omega_rad_per_s))
  sum <- retarding_torque(fit, middle)
  expect_lt(sum$standard_error / sum$deceleration_rad_per_s2, 0.01)
  expect_lt(abs(sum$deceleration_rad_per_s2 - sum(truth * middle^(0:2))), 4 * sum$standard_error)
})

test_that("runs share the losses; runs that differ have a variance between them", {
  runs <- lapply(1:4, function(i) {
    noisy(coasting(omega0 = 14 + 2 * i), 0.005, seed = i)
  })
  fit <- fit_coast_down(runs)
  one <- fit_coast_down(runs[[4]])
  expect_lt(max(fit$standard_error / one$standard_error), 0.8)
  expect_lt(max(abs(fit$value - truth) / fit$standard_error), 3.5)
  expect_equal(glance(fit)$runs, 4L)
  expect_equal(glance(fit)$sigma / 0.005, 1, tolerance = 0.15)
  # The scatter that was put in.
  expect_equal(glance(one)$sigma / 0.005, 1, tolerance = 0.15)
  expect_lt(glance(fit)$birge_ratio, 2)
  # The segments of a record are runs.
  record <- motion_record(
    do.call(rbind, Map(cbind, runs, run = 1:4)), time_s = time_s, theta_rad = theta_rad,
    segment = run
  )
  expect_equal(fit_coast_down(record)$value, fit$value, tolerance = 1e-10)
  differ <- lapply(1:4, function(i) {
    noisy(coasting(coulomb = 0.0625 * (1.2 + 0.05 * c(-1, 1, 1.5, -1.5)[i])), 0.005, seed = i)
  })
  fit <- fit_coast_down(differ)
  expect_gt(glance(fit)$birge_ratio, 3)
  expect_gt(fit$standard_error[1], 0.02)
  expect_output(print(fit), "a variance between\\s+runs")
  expect_gt(glance(fit_coast_down(differ, losses = "coulomb"))$birge_ratio, 3)
  curve <- predict(fit, run = 3)
  expect_lt(max(abs(curve$theta_rad - differ[[3]]$theta_rad)), 0.5)
})

test_that("a weight that unwinds gives the inertia, the mass or gravity", {
  # I = 0.02, m r^2 = 0.5 * 0.03^2; released at 4 s.
  inertia <- 0.02
  losses <- resistance(0.0004, 0, 0.01)
  up <- scene_hanging_mass(inertia, 0.5, 0.03, resistance = losses)
  up <- trajectory(up, seq(0, 4, by = 0.02))
  last <- up[nrow(up), ]
  down <- scene_axle(
    inertia, NULL, losses, theta0_rad = last$theta_rad, omega0_rad_per_s = last$omega_rad_per_s,
    start_s = 4
  )
  down <- trajectory(down, seq(4.02, 16, by = 0.02))
  samples <- data.frame(
    time_s = c(up$time_s, down$time_s), theta_rad = c(up$theta_rad, down$theta_rad)
  )
  set.seed(6)
  samples$theta_rad <- samples$theta_rad + stats::rnorm(nrow(samples), 0, 0.005)
  two <- c("coulomb", "viscous")
  fit <- fit_coast_down(samples, losses = two, torque = falling_weight(0.5, 0.03))
  expect_identical(fit$loss, c(two, "inertia"))
  want <- c(0.01, 0.0004, inertia)
  expect_lt(max(abs(fit$value - want) / fit$standard_error), 4)
  expect_lt(max(fit$standard_error / want), 0.02)
  for (unknown in c("mass", "gravity")) {
    weight <- if (unknown == "mass") {
      falling_weight(NA, 0.03)
    } else {
      falling_weight(0.5, 0.03, gravity_m_per_s2 = NA, until_s = 4)
    }
    fit <- fit_coast_down(samples, inertia, two, torque = weight)
    expect_identical(fit$loss[3], unknown)
    want <- if (unknown == "mass") 0.5 else 9.80665
    expect_lt(abs(fit$value[3] - want) / fit$standard_error[3], 4)
    expect_lt(fit$standard_error[3] / want, 0.01)
  }
  scene <- as_scene(fit)
  expect_equal(scene$start_s, 4)
  expect_equal(trajectory(scene, 10)$theta_rad, predict(fit, 10)$theta_rad, tolerance = 1e-12)
})

test_that("a known torque acts as well", {
  scene <- scene_axle(0.0625, -0.02, resistance(0.00625, 0, 0.075), omega0_rad_per_s = 20)
  motion <- trajectory(scene, seq(0, 8, length.out = 300))
  fit <- fit_coast_down(
    noisy(motion, 0), inertia = 0.0625, losses = c("coulomb", "viscous"), torque = -0.02
  )
  expect_equal(fit$value, c(0.075, 0.00625), tolerance = 1e-9)
  expect_equal(
    trajectory(as_scene(fit), 5)$theta_rad, trajectory(scene, 5)$theta_rad, tolerance = 1e-9
  )
})

test_that("a torque in known steps acts as well: driven, braked, free", {
  torque <- torque_steps(c(0, 3, 5), c(0.2, -0.05, 0))
  scene <- scene_axle(0.0625, torque, resistance(0.00625, 2.5e-4, 0.075), omega0_rad_per_s = 2)
  motion <- trajectory(scene, seq(0, 10, length.out = 500))
  fit <- fit_coast_down(noisy(motion, 0), inertia = 0.0625, torque = torque)
  expect_equal(fit$value, c(0.075, 0.00625, 2.5e-4), tolerance = 1e-7)
  again <- trajectory(as_scene(fit), c(2, 4, 9))
  there <- predict(fit, c(2, 4, 9))
  expect_equal(there$theta_rad, again$theta_rad, tolerance = 1e-9)
  expect_equal(there$alpha_rad_per_s2, again$net_torque_n_m / 0.0625, tolerance = 1e-6)
  budget <- loss_budget(fit)
  expect_equal(sum(budget$share), 1)
  lost <- augment(trajectory(scene, c(0, 10)))[2, ]
  expect_equal(budget$energy_j[1], lost$dissipated_coulomb_j, tolerance = 1e-6)
  for (law in list(torque_knots(c(0, 4), c(0, 1)), torque_function(function(t, ...) t))) {
    expect_error(
      fit_coast_down(noisy(motion, 0), inertia = 0.0625, torque = law),
      class = "rotdyn_error_torque"
    )
  }
  expect_error(fit_coast_down(noisy(motion, 0), torque = torque), class = "rotdyn_error_argument")
})

test_that("the sensor's runout is found and fitted", {
  motion <- coasting(n = 600)
  samples <- noisy(motion, 0.005)
  samples$theta_rad <- samples$theta_rad + 0.02 * cos(motion$theta_rad - 1)
  fit <- fit_coast_down(samples)
  expect_output(print(fit), "repeat every turn")
  fitted <- fit_coast_down(samples, runout = "fit")
  expect_lt(max(abs(fitted$value - truth) / fitted$standard_error), 3.5)
  expect_lt(max(fitted$standard_error / fit$standard_error), 0.8)
  expect_within(stats::sd(augment(fitted)$residual), 0.005, 0.1)
})

test_that("the seven laws are compared", {
  laws <- compare_laws(fit_coast_down(noisy(coasting(quadratic = 0), 0.005)))
  expect_identical(nrow(laws), 7L)
  expect_match(laws$law[1], "coulomb + viscous", fixed = TRUE)
  expect_equal(laws$aicc_difference[1], 0)
  expect_gt(laws$aicc_difference[laws$law == "viscous"], 100)
  expect_setequal(laws$parameters, 3:5)
})

test_that("a noise that is given is taken as it is, both of its numbers", {
  fit <- fit_coast_down(noisy(coasting(), 0.005))
  problem <- coast_fit(fit, "fit", NULL)$runs[[1]]$problem
  fitted <- lapply(c(0.25, 1), function(white) {
    problem$noise <- c(0.5, white)
    .Call(rotdyn:::ffi_coast_fit, problem, 0)
  })
  expect_identical(fitted[[1]]$numbers[2:3], c(0.5, 0.25))
  expect_identical(fitted[[2]]$numbers[2:3], c(0.5, 1))
  expect_gt(abs(fitted[[1]]$numbers[7] / fitted[[2]]$numbers[7] - 1), 0.01)
})

test_that("what is no coast-down is refused, in words", {
  grows <- data.frame(time_s = 0:50, theta_rad = (0:50)^2)
  expect_error(fit_coast_down(grows), "its speed grows", class = "rotdyn_error_value")
  rest <- data.frame(time_s = 0:50, theta_rad = 0)
  expect_error(fit_coast_down(rest), "at rest", class = "rotdyn_error_value")
  rest$theta_rad <- NULL
  rest$omega_rad_per_s <- 0
  expect_error(fit_coast_down(rest), "at rest", class = "rotdyn_error_value")
  samples <- noisy(coasting(), 0.005)
  expect_error(fit_coast_down(samples[1:7, ]), class = "rotdyn_error_size")
  expect_error(fit_coast_down(samples, torque = 1), class = "rotdyn_error_argument")
  expect_error(fit_coast_down(samples, losses = "friction"), class = "rotdyn_error_value")
  expect_error(fit_coast_down(samples, losses = 3), class = "rotdyn_error_type")
  expect_error(fit_coast_down(samples, inertia = -1), class = "rotdyn_error_value")
  expect_error(fit_coast_down(), class = "rotdyn_error_missing")
  expect_error(fit_coast_down(3), class = "rotdyn_error_type")
  expect_error(fit_coast_down(samples, runout = "x"), class = "rotdyn_error_value")
  expect_error(
    fit_coast_down(samples, torque = falling_weight(NA, 0.1)), class = "rotdyn_error_argument"
  )
  fit <- fit_coast_down(samples)
  expect_error(predict(fit, -1), class = "rotdyn_error_time")
  expect_error(predict(fit, run = 2), class = "rotdyn_error_value")
  expect_error(predict(fit, run = TRUE), class = "rotdyn_error_value")
  expect_error(predict(fit, run = c(1, 1)), class = "rotdyn_error_value")
  expect_error(loss_budget(3), class = "rotdyn_error_type")
  expect_error(as_scene(3), class = "rotdyn_error_type")
})

test_that("what a fit says", {
  expect_snapshot(print(fit_coast_down(noisy(coasting(), 0.005), measured(0.0625, 0.001))))
  expect_snapshot(print(fit_coast_down(noisy(coasting(n = 200, end = 1.5), 0.005, seed = 3))))
  expect_snapshot(print(fit_coast_down(noisy(coasting(quadratic = 0), 0.005, seed = 3))))
  expect_snapshot(print(falling_weight(NA, 0.1)))
})

test_that("a part of a fit is a table, and a damaged one is refused", {
  fit <- fit_coast_down(noisy(coasting(), 0.005))
  expect_s3_class(fit[3:1, ], "rot_coast_fit")
  for (part in list(fit[1, ], fit[c("loss", "value")], tibble::as_tibble(fit))) {
    expect_false(inherits(part, "rot_coast_fit"))
    expect_s3_class(part, "tbl_df")
    expect_null(attr(part, "fit"))
  }
  damaged <- fit
  attr(damaged, "fit")$runs[[1]]$p <- "x"
  for (f in list(print, loss_budget, predict, augment, glance, as_scene, compare_laws)) {
    expect_error(f(damaged), "not a valid coast-down fit", class = "rotdyn_error_type")
  }
})

test_that("its columns are those of the dictionary, and it has a picture", {
  fit <- fit_coast_down(noisy(coasting(), 0.005), inertia = 0.0625)
  known <- column_table()$name
  for (table in list(fit, loss_budget(fit), retarding_torque(fit), compare_laws(fit),
                     residual_tests(fit))) {
    expect_setequal(setdiff(names(table), known), character())
  }
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(fit), "ggplot")
})

test_that("what repeats every turn is not testable in one or two pulses a turn", {
  scene <- attr(coasting(), "run")$scene
  angles <- function(per_turn) {
    0.4 + 2 * pi * seq_len(floor(110 * per_turn / (2 * pi))) / per_turn
  }
  # The passage of each angle is found once for all records.
  all <- sort(unique(unlist(lapply(c(3, 4, 6, 1, 2), angles))))
  met <- vapply(all, function(x) time_when(scene, theta_rad = x)$time_s[1], 0)
  pulses <- function(per_turn, seed, uneven = 0) {
    angle <- angles(per_turn)
    wave <- uneven * cos(2 * pi * seq_along(angle) / per_turn - 1)
    set.seed(seed)
    times <- met[match(angle, all)]
    rate <- stats::approx(times[-1], diff(angle) / diff(times), times, rule = 2)$y
    times <- times + wave / rate + stats::rnorm(length(times), 0, 2e-4)
    motion_record(data.frame(t = times), time_s = t, pulses = per_turn)
  }
  runout <- function(fit) {
    tests <- residual_tests(fit)
    tests$finding[tests$test == "runout"]
  }
  for (per_turn in 1:2) {
    fit <- fit_coast_down(pulses(per_turn, per_turn))
    expect_identical(runout(fit), "not testable: one or two pulses a turn")
    expect_true(is.na(glance(fit)$runout_p))
    expect_false(any(grepl("every turn", capture.output(print(fit)))))
    expect_error(
      fit_coast_down(pulses(per_turn, 1), runout = "fit"), class = "rotdyn_error_value"
    )
  }
  # Three or more show it, and only where it is: chance says so in 1 of 100.
  for (per_turn in c(3, 4, 6)) {
    clean <- vapply(1:5, function(seed) runout(fit_coast_down(pulses(per_turn, seed))), "")
    expect_lte(sum(clean != "none found"), 1)
    uneven <- pulses(per_turn, 1, uneven = 0.05)
    expect_identical(runout(fit_coast_down(uneven)), "repeats every turn")
    fit <- fit_coast_down(uneven, runout = "fit")
    waves <- attr(fit, "fit")$runs[[1]]$p[c("cos_1", "sin_1")]
    expect_within(sqrt(sum(waves^2)), 0.05, 0.15)
    expect_lt(max(abs(fit$value - truth) / fit$standard_error), 4)
  }
})

test_that("the tests of residuals find what the print finds", {
  time_s <- seq(0, 8, by = 0.02)
  set.seed(1)
  found <- function(samples, ...) {
    fit <- fit_coast_down(samples, ...)
    tests <- residual_tests(fit)
    said <- paste(capture.output(print(fit)), collapse = " ")
    expect_identical(
      any(grepl("incomplete", tests$finding[tests$test == "wrong law"])),
      grepl("law is incomplete", said)
    )
    expect_identical(any(grepl("alike", tests$finding)), grepl("are alike", said))
    expect_identical(glance(fit)$complete, !grepl("law is incomplete", said))
    paste(tests$finding, collapse = " ")
  }
  speeds_up <- data.frame(
    time_s, theta_rad = 20 * time_s + 0.05 * time_s^2 + stats::rnorm(401, 0, 0.002)
  )
  expect_match(found(speeds_up, losses = "coulomb"), "the coulomb loss is below 0")
  expect_match(found(noisy(coasting(), 0.005), losses = "coulomb"), "waves longer")
  slow <- as.vector(stats::filter(stats::rnorm(400, 0, 0.005), 0.9, "recursive"))
  samples <- coasting()
  samples <- data.frame(time_s = samples$time_s, theta_rad = samples$theta_rad + slow)
  expect_match(found(samples, noise = "white"), "alike .Durbin-Watson")
  expect_match(found(samples), "correlated: the errors allow for it")
  expect_match(found(noisy(coasting(), 0.005)), "white none found none found")
})

test_that("a loss whose estimate is far below 0 keeps a limit that the record can show", {
  time_s <- seq(0, 8, by = 0.02)
  set.seed(2)
  samples <- data.frame(
    time_s, theta_rad = 20 * time_s + 0.05 * time_s^2 + stats::rnorm(401, 0, 0.002)
  )
  fit <- fit_coast_down(samples, losses = "coulomb")
  expect_identical(fit$value, 0)
  # The limit of an estimate at one standard error below 0, by the t of 398 degrees of freedom.
  # Of a parabola's curvature in n samples over T: 2 sigma sqrt(180/n)/T^2.
  expect_within(fit$standard_error, 2 * 0.002 * sqrt(180 / 401) / 64, 0.1)
  expect_within(fit$upper, (stats::qt(0.975, 398) - 1) * fit$standard_error, 1e-12)
  expect_match(paste(capture.output(print(fit)), collapse = "\n"), "at most 4.1e-05")
})

test_that("a record that is mostly rest is fitted from the rows that turn", {
  for (end in c(100, 1000)) { # it stops at 10.7 s
    fit <- fit_coast_down(noisy(coasting(4000, end), 0.005))
    expect_lt(max(abs(fit$value - truth) / fit$standard_error), 4)
    expect_within(glance(fit)$sigma, 0.005, 0.05)
  }
})

test_that("variances between runs by REML: 0 of equal ones, half the squared difference of two", {
  spread <- list(matrix(1e-4), matrix(1e-4))
  expect_identical(between_variances(list(1, 1), spread), 0)
  expect_equal(between_variances(list(1, 2), spread), 0.5 - 1e-4, tolerance = 1e-3)
})

test_that("alpha of a motion under a weight is the slope of its omega, whatever is unknown", {
  inertia <- 0.02
  up <- scene_hanging_mass(inertia, 0.5, 0.03, resistance = resistance(0.0004, 0, 0.01))
  up <- trajectory(up, seq(0, 4, by = 0.02))
  samples <- data.frame(time_s = up$time_s, theta_rad = up$theta_rad)
  for (unknown in c("inertia", "mass", "gravity")) {
    weight <- switch(unknown,
      inertia = falling_weight(0.5, 0.03, until_s = 4),
      mass = falling_weight(NA, 0.03, until_s = 4),
      gravity = falling_weight(0.5, 0.03, gravity_m_per_s2 = NA, until_s = 4)
    )
    moment <- if (unknown == "inertia") NULL else inertia
    fit <- attr(fit_coast_down(samples, moment, c("coulomb", "viscous"), torque = weight), "fit")
    p <- rotdyn:::run_parameters(fit, 1)$p
    p[c("coulomb", "viscous", "load")] <- c(0.4, 0.02, 1.25 * p[["load"]])
    at <- c(0.5, 1.7, 3.1)
    h <- 1e-4
    rows <- function(time, p) rotdyn:::motion_rows(fit, 1, p, time)
    slope <- (rows(at + h, p)$omega - rows(at - h, p)$omega) / (2 * h)
    expect_equal(rows(at, p)$alpha, slope, tolerance = 1e-6)
    for (k in c("coulomb", "viscous", "load")) {
      d <- 1e-5 * p[[k]]
      more <- less <- p
      more[[k]] <- p[[k]] + d
      less[[k]] <- p[[k]] - d
      expect_equal(
        rows(at, p)$d_alpha[, match(k, names(p))], (rows(at, more)$alpha - rows(at, less)$alpha) /
          (2 * d), tolerance = 1e-4
      )
    }
  }
})

test_that("a record of one rate does not slow down", {
  even <- data.frame(time_s = 0:50 / 10, omega_rad_per_s = 5)
  expect_error(fit_coast_down(even, 0.02), "does not slow down", class = "rotdyn_error_value")
  even$omega_rad_per_s <- 0
  expect_error(fit_coast_down(even, 0.02), "is at rest", class = "rotdyn_error_value")
})

test_that("noise that grows over a run: samples weigh by it", {
  law <- c(0.5, 0.06, 0.003)
  time_s <- seq(0, 8, length.out = 200)
  angles <- function(p) {
    wheel <- scene_axle(1, NULL, resistance(p[2], p[3], p[1]), omega0_rad_per_s = p[4])
    p[5] + trajectory(wheel, time_s)$theta_rad
  }
  sd_rad <- 0.002 * 8^(time_s / 8)
  p <- c(law, 20, 0)
  slopes <- vapply(1:5, function(k) {
    h <- 1e-5 * (seq_along(p) == k)
    (angles(p + h) - angles(p - h)) / 2e-5
  }, time_s)
  expected <- sqrt(diag(solve(crossprod(slopes / sd_rad))))[1:3]
  set.seed(3)
  record <- data.frame(time_s, theta_rad = angles(p) + rnorm(200, 0, sd_rad))
  fit <- fit_coast_down(record)
  expect_equal(fit$standard_error / expected, rep(1, 3), tolerance = 0.15)
  expect_true(all(abs(fit$value - law) < 3 * fit$standard_error))
  expect_output(print(fit), "times as large at the end")
  # Noise that does not grow has no weights.
  record$theta_rad <- angles(p) + rnorm(200, 0, 0.002)
  even <- attr(fit_coast_down(record), "fit")
  expect_null(even$runs[[1]]$problem$weight)
  # Correlated noise that grows is said.
  slow <- stats::filter(rnorm(200), 0.8, "recursive")
  record$theta_rad <- angles(p) + sd_rad * as.vector(slow)
  slow <- fit_coast_down(record)
  expect_null(attr(slow, "fit")$runs[[1]]$problem$weight)
  expect_output(print(slow), "Correlated noise grows or falls")
})

test_that("anticorrelated noise has fewer degrees of freedom than samples", {
  # e_i - a e_(i-1) has the correlation -a/(1 + a^2) of neighbours and none of others: the
  # coefficient has the variance (1 - a^2)/n, and the power at frequency 0 goes as (1 - a)^2.
  a <- 0.5
  n <- 400
  decay <- 1e-6
  tau <- -0.02 / log(decay)
  dof <- rotdyn:::noise_dof(n, 0.02 * (n - 1), tau, 1 + a / (1 + a^2) / decay)
  expect_equal(dof, 2 * ((1 - a) / (2 * sqrt((1 - a^2) / n)))^2, tolerance = 1e-4)
  expect_identical(rotdyn:::noise_dof(n, 8, 0, 1), n)
})

test_that("of slow noise a run has the samples that its mean shows, of white noise all", {
  dof <- function(tau, white) rotdyn:::noise_dof(100, 99, tau, white)
  expect_equal(dof(11, 0), 99 / 22)
  expect_equal(dof(11, 1 - 1e-9), 100, tolerance = 1e-6)
  # Half of the power at low frequency is slow, with tau = 1/2 of a sample: 99 and 100 samples.
  expect_equal(dof(0.5, 0.5), 4 / (1 / 99 + 1 / 100))
})

test_that("a record without rows, and an inertia whose square is no double, are errors", {
  data <- data.frame(time_s = 0:20, omega_rad_per_s = 20 - 0:20 / 2)
  record <- motion_record(data)
  expect_error(fit_coast_down(record[0, ]), "no samples", class = "rotdyn_error_size")
  for (inertia in c(1e300, 1e-300)) {
    expect_error(fit_coast_down(record, inertia), "square", class = "rotdyn_error_range")
  }
})
