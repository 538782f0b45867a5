# Torque functions of the state that jump or kink: values by hand.

law <- function(f, ...) scene_axle(1, torque_function(f), ...)

expect_covered <- function(motion, theta, omega, accuracy = 1e-9) {
  n <- nrow(motion)
  errors <- attr(motion, "run")$info$errors
  expect_lte(abs(motion$theta_rad[n] - theta), errors[["theta"]] + 4e-16 * abs(theta))
  expect_lte(abs(motion$omega_rad_per_s[n] - omega), errors[["omega"]] + 4e-16 * abs(omega))
  expect_lte(attr(motion, "run")$info$error, accuracy)
}

test_that("a jump at a rate is met exactly", {
  jump <- function(time_s, theta_rad, omega_rad_per_s) if (omega_rad_per_s < 1) 0.5 else 2
  for (model in list(NULL, "axle_radau")) {
    motion <- trajectory(law(jump), c(0, 1.5, 3), model = model)
    expect_covered(motion, 3, 3, 1e-12) # omega = 1 at 2 s, theta = 1 there
  }
})

test_that("a kink of the angle is covered", {
  stop <- function(time_s, theta_rad, omega_rad_per_s) -theta_rad - pmax(0, theta_rad)
  # Up from -1 with 1 rad/s: sin(t - pi/4) * sqrt(2), then sin(sqrt(2) u), then back below zero.
  up <- pi / 4
  over <- up + pi / sqrt(2)
  motion <- trajectory(law(stop, theta0_rad = -1, omega0_rad_per_s = 1), c(0, 1, 5))
  u <- 5 - over
  expect_covered(motion, -sqrt(2) * sin(u), -sqrt(2) * cos(u))
})

test_that("sign(omega) is dry friction: it stops, holds, and breaks loose", {
  brake <- function(time_s, theta_rad, omega_rad_per_s) -0.5 * sign(omega_rad_per_s)
  motion <- trajectory(law(brake, omega0_rad_per_s = 1), c(0, 1, 2, 3, 50))
  expect_equal(motion$omega_rad_per_s, c(1, 0.5, 0, 0, 0), tolerance = 1e-12)
  expect_covered(motion, 1, 0)
  driven <- function(time_s, theta_rad, omega_rad_per_s) sin(time_s) - 0.5 * sign(omega_rad_per_s)
  motion <- trajectory(law(driven), c(0, 0.5, 2))
  loose <- asin(0.5)
  u <- 2 - loose
  expect_identical(motion$omega_rad_per_s[2], 0)
  expect_covered(
    motion, cos(loose) * u - (sin(2) - sin(loose)) - u^2 / 4, cos(loose) - cos(2) - u / 2
  )
})

test_that("a jump at an angle that returns and returns", {
  bang <- function(time_s, theta_rad, omega_rad_per_s) -2 * sign(theta_rad)
  motion <- trajectory(law(bang, theta0_rad = 1), c(0, 5))
  expect_covered(motion, 0, -2, 1e-12)
  expect_lt(attr(motion, "run")$info$rhs_calls, 1500)
})

test_that("a narrow pulse in a long motion is not passed over", {
  pulse <- function(time_s, theta_rad, omega_rad_per_s) {
    10 * exp(-((time_s - 50.3) / 0.2)^2) - 0.02 * omega_rad_per_s
  }
  motion <- trajectory(scene_axle(2, torque_function(pulse), omega0_rad_per_s = 1), c(0, 100))
  # exp(-0.01 * 100) plus the pulse's share: 5 * 0.2 * sqrt(pi) * exp(-0.01 * 49.7 + (0.001)^2).
  omega <- exp(-1) + 5 * 0.2 * sqrt(pi) * exp(-0.01 * 49.7 + (0.01 * 0.2 / 2)^2)
  expect_lt(abs(motion$omega_rad_per_s[2] / omega - 1), 1e-9)
})

test_that("a smooth law of the state takes 290 calls a swing at 1e-9", {
  # theta is written down first; the law makes it the motion.
  law <- function(time_s, theta_rad, omega_rad_per_s) {
    theta <- 0.8 * cos(1.3 * time_s)
    -1.69 * theta + 2 * sin(theta) - 2 * sin(theta_rad) +
      0.1 * (-1.04 * sin(1.3 * time_s) - omega_rad_per_s)
  }
  time_s <- seq(0, 60, 0.25)
  for (accuracy in c(1e-8, 1e-9, 1e-12)) {
    scene <- scene_axle(1, torque_function(law, breaks_s = numeric()), theta0_rad = 0.8)
    motion <- trajectory(scene, time_s, accuracy)
    info <- attr(motion, "run")$info
    off <- max(abs(motion$theta_rad - 0.8 * cos(1.3 * time_s)))
    expect_lte(off, min(info$errors[["theta"]], 0.8 * accuracy))
    expect_covered(motion, 0.8 * cos(1.3 * 60), -1.04 * sin(1.3 * 60), accuracy)
    # 5560 by steps alone; 241 are those of the rows, some 280 probes.
    if (accuracy == 1e-9) expect_lt(info$rhs_calls, 4200)
    torque <- -1.69 * 0.8 * cos(1.3 * time_s)
    expect_lt(max(abs(motion$applied_torque_n_m - torque)), 10 * accuracy)
    expect_identical(audit(motion)$verdict, c("balanced", "balanced"))
  }
})
