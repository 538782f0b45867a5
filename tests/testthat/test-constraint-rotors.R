motion_of <- function(scene, time_s, accuracy = 1e-9, model = NULL) {
  trajectory(scene, time_s, accuracy, model)
}

test_that("the motion is that of the 40-digit table", {
  table <- read.csv(shared("refs", "coupled_rotors.csv"), colClasses = "character")
  numbers <- function(x) as.numeric(strsplit(x, ";")[[1]])
  for (i in seq_len(nrow(table))) {
    row <- table[i, ]
    scene <- scene_rotors(
      numbers(row$J), numbers(row$k), numbers(row$c), omega0_rad_per_s = numbers(row$omega0)
    )
    motion <- motion_of(scene, as.numeric(row$t), 1e-11, "rotors_modal")
    expect_lte(max(abs(motion$theta_rad - numbers(row$dtheta))), 2e-15)
    # sqrt(k/J) t is 1e5 in row 2: a phase known to a rounding would cost 1e-11.
    expect_lte(max(abs(motion$omega_rad_per_s - numbers(row$omega))), 1e-14)
  }
})

test_that("even rows share an exponential where ten digits will do, and only there", {
  # Damped unevenly, so that there is no closed form of single modes.
  scene <- scene_rotors(
    c(1, 0.4, 2), c(300, 450), c(0.2, 0), resistance = c(0, 0.3, 0.05),
    omega0_rad_per_s = c(1, 2, -1)
  )
  time <- seq(0, 20, by = 0.01)
  omega <- function(accuracy, time) {
    suppressWarnings(
      motion_of(scene, time, accuracy, "rotors_modal"), classes = "rotdyn_warning_accuracy"
    )$omega_rad_per_s
  }
  each <- unlist(lapply(time[c(2, 700, 2001)], function(t) omega(1e-10, t)))
  rows <- as.vector(outer(1:3, 3 * (c(2, 700, 2001) - 1), "+"))
  expect_identical(omega(1e-12, time)[rows], each)
  expect_false(identical(omega(1e-10, time)[rows], each))
  expect_equal(omega(1e-10, time)[rows], each, tolerance = 1e-10)
})

test_that("rows are in long form, by time then rotor", {
  scene <- scene_rotors(c(1, 2, 3), 50, theta0_rad = c(0.1, 0, 0))
  motion <- motion_of(scene, c(0, 1))
  expect_named(motion, columns_of_motion("rotors"))
  expect_equal(motion$time_s, c(0, 0, 0, 1, 1, 1))
  expect_equal(motion$rotor, c(1L, 2L, 3L, 1L, 2L, 3L))
  expect_equal(motion$shaft_torque_n_m[1:3], c(5, 0, NA), tolerance = 1e-14)
  expect_equal(motion$angular_momentum_kg_m2_per_s, c(1, 2, 3) * motion$omega_rad_per_s)
  expect_equal(nrow(motion_of(scene, double())), 0L)
})

test_that("the motion agrees with an integrator of another house", {
  skip_if_not_installed("deSolve")
  J <- c(1, 0.4, 2)
  k <- c(30, 45)
  c <- c(0.2, 0)
  d <- c(0, 0.3, 0.05)
  tau <- c(1, 0, -0.4)
  theta0 <- c(0.2, -0.1, 0)
  omega0 <- c(1, 2, -1)
  slope <- function(t, y, p) {
    theta <- y[1:3]
    omega <- y[4:6]
    shaft <- k * -diff(theta) + c * -diff(omega)
    list(c(omega, (tau - d * omega + c(0, shaft) - c(shaft, 0)) / J))
  }
  time <- seq(0, 5, by = 0.25)
  other <- deSolve::ode(c(theta0, omega0), time, slope, NULL, rtol = 1e-11, atol = 1e-12)
  scene <- scene_rotors(J, k, c, torque = tau, resistance = d, theta0_rad = theta0,
    omega0_rad_per_s = omega0)
  motion <- motion_of(scene, time)
  expect_equal(motion$theta_rad, c(t(other[, 2:4])), tolerance = 1e-8)
  expect_equal(motion$omega_rad_per_s, c(t(other[, 5:7])), tolerance = 1e-8)
  expect_equal(attr(motion, "run")$error_kind, "estimate")
})

test_that("a stiff shaft is rigid when that is good enough, and the bound holds", {
  scene <- scene_rotors(c(1, 2), 1e10, torque = c(3, 0))
  time <- 1:5
  rigid <- motion_of(scene, time, 1e-4)
  exact <- motion_of(scene, time, 1e-9)
  expect_equal(attr(rigid, "run")$model, "rotors_rigid")
  expect_equal(attr(exact, "run")$model, "rotors_modal")
  expect_equal(rigid$omega_rad_per_s, rep(1 * time, each = 2))
  expect_equal(rigid$shaft_torque_n_m[1], 2) # what it takes to turn 2 kg m^2 at 1 rad/s^2
  run <- attr(rigid, "run")
  expect_lte(max(abs(rigid$omega_rad_per_s - exact$omega_rad_per_s)), run$info$errors[["omega"]])
  expect_lte(max(abs(rigid$theta_rad - exact$theta_rad)), run$info$errors[["theta"]])
  expect_error(motion_of(scene, time, 1e-9, "rotors_rigid"), class = "rotdyn_error_model")
  expect_error(motion_of(scene, time, 1e-9, "axle_free"), class = "rotdyn_error_model")
  soft <- scene_rotors(c(1, 2), 0, torque = c(3, 0))
  expect_equal(attr(motion_of(soft, time, 1), "run")$model, "rotors_modal")
})

test_that("an audit balances, and finds an edited row", {
  time <- seq(0, 3, by = 0.1)
  scenes <- list(
    scene_rotors(c(1, 2), 1000, omega0_rad_per_s = c(1, 0.5)),
    scene_rotors(c(1, 2, 0.5), c(1e8, 3e3), c(10, 0), torque = c(5, 0, -1)),
    scene_rotors(c(1, 2, 0.5), c(1e3, 0), 0.5, resistance = c(0.2, 0, 0.7), theta0_rad = 1:3)
  )
  for (scene in scenes) {
    motion <- motion_of(scene, time)
    balance <- audited(motion)
    expect_equal(balance$verdict, "balanced")
    expect_lte(balance$energy_rounding_j, 1e-6 * (1 + abs(balance$work_j) + balance$dissipated_j))
    rows <- nrow(motion)
    motion$omega_rad_per_s[rows] <- motion$omega_rad_per_s[rows] + 1e-3
    expect_equal(audited(motion)$verdict, "unbalanced")
    expect_true(is.na(attr(motion, "run")$info$error))
  }
  stiff <- scene_rotors(c(1, 2), 1e12, resistance = c(0.3, 0), torque = c(2, 2))
  rigid <- motion_of(stiff, time, 1e-3)
  expect_equal(attr(rigid, "run")$model, "rotors_rigid")
  expect_gt(audited(rigid)$dissipated_j, 1)
  expect_equal(audited(rigid)$verdict, "balanced")
  # Rows of a rotor are missing: no balance can be drawn.
  expect_true(is.na(audited(rigid[rigid$rotor == 1, ])$verdict))
  expect_true(is.na(audited(rigid[0, ])$verdict))
  expect_output(print(audit(rigid)), "balanced.*kinetic energy")
})

test_that("the class stands while the keys do", {
  motion <- motion_of(scene_rotors(c(1, 2), 10, omega0_rad_per_s = c(1, 0)), 0:3)
  expect_s3_class(motion[3:4, ], "rot_trajectory")
  expect_false(is.na(attr(motion[3:4, ], "run")$info$error))
  expect_false(inherits(motion[, 1:2], "rot_trajectory"))
  expect_false(inherits(tibble::as_tibble(motion), "rot_trajectory"))
  expect_match(names(tibble::tbl_sum(motion))[1], "rotdyn trajectory")
})

# The twist of two rotors of 1 and 2 kg m^2 turns at sqrt(75): theirs is the exact cosine (mpmath).
test_that("a start that is not 0 rounds no phase away", {
  scene <- scene_rotors(c(1, 2), 50, omega0_rad_per_s = c(1, -0.5), start_s = 0.1)
  x <- trajectory(scene, 1e5)
  expect_equal(x$omega_rad_per_s, 0.85745157918235499526 * c(1, -0.5), tolerance = 1e-14)
  expect_lte(run_of(x)$info$error, 1e-13)
  # The same with dampers that couple the modes: to what is stated of the phase.
  shift <- function(start) {
    scene <- scene_rotors(c(1, 2, 0.3), c(50, 4e3), c(1e-7, 0), resistance = c(0, 1e-6, 0),
      omega0_rad_per_s = c(1, -0.5, 0), start_s = start)
    suppressWarnings(trajectory(scene, start + 4096)) # the angle stays near 0
  }
  far <- shift(2^20)
  near <- shift(0)
  expect_lte(max(abs(far$omega_rad_per_s - near$omega_rad_per_s)), 1e-13)
  # 4096 s after 0.1 s: the difference of the doubles, at twice the rate of the fast mode.
  odd <- trajectory(scene_rotors(c(1, 2), 50, omega0_rad_per_s = c(1, -0.5), start_s = 1 / 3),
                    1e5 + 1 / 3)
  phase <- (1e5 + 1 / 3) - 1e5 - 1 / 3 # what rounding took from the time
  even <- trajectory(scene_rotors(c(1, 2), 50, omega0_rad_per_s = c(1, -0.5)), 1e5)
  moved <- even$omega_rad_per_s + phase * c(-1, 0.5) * 50 *
    (even$theta_rad[1] - even$theta_rad[2])
  expect_equal(odd$omega_rad_per_s, moved, tolerance = 1e-13)
})

test_that("a phase of 1e9 and the mean of a shaft that is nearly at rest keep their digits", {
  # Two rotors, undamped: omega_1 - omega_2 is A cos(nu t + phi). The period by two precisions.
  J <- c(1.1905868685113814, 0.27111185837787166)
  scene <- scene_rotors(J, 2^26, omega0_rad_per_s = c(0.27111185837787166, -1.1905868685113814))
  x <- suppressWarnings(trajectory(scene, 2^16))
  # No momentum: the mean stays.
  expect_lte(abs(sum(J * x$omega_rad_per_s)), 1e-15)
  expect_lte(abs(sum(J * x$theta_rad)), 1e-11)
})

test_that("sixty rotors are as exact as the three that they consist of", {
  set.seed(2)
  n <- 60
  own <- seq_len(n) %% 3 != 0 # no shaft behind each third
  inertia <- 1 + runif(n)
  stiffness <- 100 * (1 + runif(n)) * own
  damping <- 0.5 * runif(n) * own
  losses <- runif(n)
  start <- runif(n)
  torque <- runif(n)
  of <- function(i) {
    scene <- scene_rotors(
      inertia[i], stiffness[utils::head(i, -1)], damping[utils::head(i, -1)], torque = torque[i],
      resistance = losses[i], omega0_rad_per_s = start[i]
    )
    trajectory(scene, c(0.5, 7), model = "rotors_modal")
  }
  whole <- of(seq_len(n))
  parts <- do.call(rbind, lapply(split(seq_len(n), (seq_len(n) - 1) %/% 3), function(i) {
    tibble::tibble(time_s = of(i)$time_s, rotor = rep(i, 2), theta_rad = of(i)$theta_rad,
                   omega_rad_per_s = of(i)$omega_rad_per_s)
  }))
  parts <- parts[order(parts$time_s, parts$rotor), ]
  errors <- run_of(whole)$info$errors
  for (measure in c("theta", "omega")) {
    column <- c(theta = "theta_rad", omega = "omega_rad_per_s")[[measure]]
    expect_lte(max(abs(whole[[column]] - parts[[column]])), errors[[measure]])
    expect_lte(errors[[measure]], 1e-13 * max(abs(parts[[column]])))
  }
})

test_that("many rotors can be interrupted, their modes too", {
  n <- 400
  limited <- function(expr) {
    # Before the limit is set: one that ends in a finalizer is lost.
    gc()
    setTimeLimit(elapsed = 0.3, transient = TRUE)
    on.exit(setTimeLimit(elapsed = Inf))
    expr()
  }
  interrupted <- function(expr) {
    message <- gettext("reached elapsed time limit", domain = "R")
    expect_soon(expect_error(limited(expr), message, fixed = TRUE), 60)
  }
  set.seed(1)
  scene <- scene_rotors(
    1 + runif(n), 100 * (1 + runif(n - 1)), damping_n_m_s = runif(n - 1), resistance = runif(n),
    omega0_rad_per_s = runif(n)
  )
  interrupted(function() shaft_modes(scene))
  interrupted(function() trajectory(scene, 0:3))
})

test_that("rotors drift under a torque, and where they turn as a whole", {
  drifts <- function(torque, omega0) {
    scene <- scene_rotors(c(1, 2), 5, torque = torque, omega0_rad_per_s = omega0)
    rotdyn:::rotors_time_scales(scene, c(theta = 1, omega = 1), "rotors_modes")$drifts
  }
  expect_true(drifts(c(0, 3), c(0, 0)))
  expect_true(drifts(c(0, 0), c(1, 1)))
  expect_true(drifts(c(1, 0), c(1, 1)))
  expect_false(drifts(c(0, 0), c(2, -1)))
  expect_false(drifts(c(0, 0), c(0, 0)))
})

test_that("rotors before the start: from there the motion comes back to it", {
  at_0 <- list(theta_rad = c(0.1, 0, 0), omega_rad_per_s = c(1, 2, 3))
  scene <- function(theta, omega, start) {
    scene_rotors(
      1:3, c(50, 80), c(0.3, 0.2), resistance = c(0.2, 0, 0.7), torque = c(1, 0, -0.5),
      theta0_rad = theta, omega0_rad_per_s = omega, start_s = start
    )
  }
  early <- trajectory(scene(at_0$theta_rad, at_0$omega_rad_per_s, 0), -0.7)
  expect_equal(glance(early)$model, "rotors_modal")
  back <- trajectory(scene(early$theta_rad, early$omega_rad_per_s, -0.7), 0)
  expect_equal(back$theta_rad, at_0$theta_rad, tolerance = 1e-13)
  expect_equal(back$omega_rad_per_s, at_0$omega_rad_per_s, tolerance = 1e-13)
})

test_that("sums over the rotors count a time that is asked for twice once", {
  s <- scene_rotors(c(1, 2), 10, omega0_rad_per_s = c(1, 0))
  twice <- glance(trajectory(s, c(0, 0, 1)))
  expect_equal(twice$max_angular_momentum_kg_m2_per_s, 1)
  expect_equal(twice$max_rotational_kinetic_energy_j, 0.5)
})
