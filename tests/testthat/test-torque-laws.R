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

# Every kind of law in every scene: taken and computed, or refused with what to do instead.
test_that("torque laws by scenes", {
  of_time <- list(
    number = 0.2, constant = torque_constant(0.2), knots = torque_knots(c(0, 0.05, 1), c(0, 1, 0)),
    steps = torque_steps(c(0, 0.05), c(1, -1)), pulse = torque_pulse(0.02, 0.03, 1),
    sinusoid = torque_sinusoid(1, 5), exponential = torque_exponential(1, 2),
    polynomial = torque_polynomial(c(0, 1), c(1, 2)), time = function(time_s) cos(time_s),
    with_breaks = torque_function(function(time_s) if (time_s < 0.05) 1 else 0, 0.05),
    sum = torque_sinusoid(1, 5) + torque_constant(0.1)
  )
  of_state <- list(
    motor = torque_motor(1, 10), curve = torque_curve(c(0, 10), c(1, 0)),
    spring = torque_spring(1), gravity = torque_gravity(1, 0.1),
    state = function(time_s, theta_rad, omega_rad_per_s) -theta_rad
  )
  about_axles <- list(
    axle = function(law) scene_axle(1, law),
    pendulum = function(law) scene_pendulum(body_rod(1, 1), 0.5, torque = law),
    rotors = function(law) scene_rotors(c(1, 2), 5, torque = list(law, NULL)),
    gears = function(law) scene_gears(c(1, 2), 3, torque = list(NULL, law)),
    lossy = function(law) scene_gears(c(1, 2), 3, efficiency = 0.9, torque = list(law, 0)),
    clutch = function(law) {
      scene_clutch(1, 2, 3, torque = list(law, NULL), omega0_rad_per_s = c(1, 0))
    },
    drive = function(law) scene_drive(c(1, 2), coupling_shaft(5), torque = list(NULL, law))
  )
  in_space <- list(
    free = function(law) scene_free(c(1, 1, 2), c(0, 0, 1), torque = list(z = law)),
    pivot = function(law) {
      scene_pivot(c(1, 1, 2), c(0, 0, 9), mass_kg = 1, centre_m = c(0, 0, 1),
                  torque = list(x = law, y = 0.1))
    },
    rotor = function(law) scene_free(c(1, 1, 2), c(0, 0, 1), rotors = rotor("z", 0.1, 3, law))
  )
  runs <- function(scene, name) {
    motion <- suppressWarnings(trajectory(scene, c(0, 0.1)))
    expect_true(glance(motion)$error < 1e-6, info = name)
    expect_false(any(audit(motion)$verdict %in% "not balanced"), info = name)
  }
  for (scene in names(about_axles)) {
    for (law in names(c(of_time, of_state))) {
      runs(about_axles[[scene]](c(of_time, of_state)[[law]]), paste(scene, law))
    }
  }
  for (scene in names(in_space)) {
    for (law in names(of_time)) runs(in_space[[scene]](of_time[[law]]), paste(scene, law))
    for (law in names(of_state)[1:4]) {
      error <- expect_error(in_space[[scene]](of_state[[law]]), class = "rotdyn_error_torque")
      expect_match(conditionMessage(error), "function of", info = paste(scene, law))
    }
  }
  expect_error(scene_free(c(1, 1, 2), c(0, 0, 1), torque = torque_constant(1)), "list\\(z = ",
               class = "rotdyn_error_type")
  # Of the same size, whatever the way.
  along <- function(...) {
    trajectory(scene_free(c(1, 1, 2), c(0, 0, 1), ...), c(0, 2))$omega_z_rad_per_s[2]
  }
  expect_equal(along(torque = list(z = torque_sinusoid(1, 5))), 1 + sin(10) / 10, tolerance = 1e-9)
  expect_equal(along(torque = list(z = 0.4)), 1.4, tolerance = 1e-12)
  expect_identical(
    scene_free(c(1, 1, 2), c(0, 0, 1), torque = list(z = 0.4)),
    scene_free(c(1, 1, 2), c(0, 0, 1), torque = c(0, 0, 0.4))
  )
})

test_that("rotors, gears and clutches are drives where a law asks for it", {
  plain <- scene_rotors(c(1, 2), 5, torque = list(3, NULL), resistance = resistance(0.1))
  expect_s3_class(plain, "rot_scene_rotors")
  expect_identical(plain, scene_rotors(c(1, 2), 5, torque = c(3, 0), resistance = 0.1))
  motor <- scene_rotors(c(1, 2), 5, 0.1, torque = list(torque_motor(3, 50), NULL), brake = NULL,
                        resistance = c(0.1, 0))
  expect_identical(motor, scene_drive(
    c(1, 2), coupling_shaft(5, 0.1), torque = list(torque_motor(3, 50), NULL),
    resistance = list(resistance(0.1), NULL), theta0_rad = c(0, 0), omega0_rad_per_s = c(0, 0)
  ))
  train <- scene_gears(c(1, 2), 3, torque = list(torque_motor(3, 50), -1), omega0_rad_per_s = 6)
  expect_equal(trajectory(train, 0)$omega_rad_per_s, c(6, 2))
  held <- scene_gears(c(1, 2), 3, torque = c(1, 0), brake = list(NULL, brake(50)))
  expect_equal(trajectory(held, c(0, 5))$omega_rad_per_s, c(0, 0, 0, 0))
  # A clutch pressed later, with a sinusoid on one body: as two bodies until then.
  later <- scene_clutch(
    1, 2, 3, torque = list(torque_sinusoid(1, 2), NULL), omega0_rad_per_s = c(4, 0), engage_s = 1
  )
  expect_s3_class(later, "rot_scene_drive")
  at <- trajectory(later, c(0, 1))
  expect_equal(at$omega_rad_per_s[3], 4 + sin(2) / 2, tolerance = 1e-9)
  expect_equal(at$omega_rad_per_s[4], 0)
  expect_error(scene_clutch(1, 2, 3, torque = 5), class = "rotdyn_error_type")
  expect_error(scene_clutch(1, 2, 3, omega0_rad_per_s = 5), "2 numbers",
    class = "rotdyn_error_value")
  expect_error(scene_rotors(c(1, 2), 5, torque = list(1)), class = "rotdyn_error_size")
  expect_error(scene_rotors(c(1, 2), 5, brake = brake(3)), class = "rotdyn_error_type")
})
