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

# Each law twice: for the package, and as a function of time, angle and rate with its jumps.
law_pairs <- function() {
  list(
    number = list(0.2, function(t, a, w) 0.2),
    constant = list(torque_constant(0.2), function(t, a, w) 0.2),
    knots = list(
      torque_knots(c(0, 0.1, 0.4), c(0, 1, 0)),
      function(t, a, w) if (t < 0.1) 10 * t else max(0, (0.4 - t) / 0.3), c(0.1, 0.4)
    ),
    steps = list(torque_steps(c(0, 0.2), c(1, -1)), function(t, a, w) if (t < 0.2) 1 else -1, 0.2),
    pulse = list(
      torque_pulse(0.1, 0.2, 2), function(t, a, w) if (t > 0.1 && t < 0.3) 2 else 0, c(0.1, 0.3)
    ),
    sinusoid = list(torque_sinusoid(1, 5, 0.3), function(t, a, w) cos(5 * t + 0.3)),
    exponential = list(torque_exponential(1, 2), function(t, a, w) exp(-2 * t)),
    polynomial = list(
      torque_polynomial(c(0, 1), c(1, 2)), function(t, a, w) if (t < 1) 1 + 2 * t else 0, 1
    ),
    time = list(function(time_s) cos(3 * time_s), function(t, a, w) cos(3 * t)),
    with_breaks = list(
      torque_function(function(time_s) if (time_s < 0.25) 1 else -0.5, 0.25),
      function(t, a, w) if (t < 0.25) 1 else -0.5, 0.25
    ),
    sum = list(
      torque_sinusoid(1, 5) + torque_constant(0.1) + torque_pulse(0.1, 0.2, 2),
      function(t, a, w) cos(5 * t) + 0.1 + if (t > 0.1 && t < 0.3) 2 else 0, c(0.1, 0.3)
    )
  )
}
state_law_pairs <- function() {
  g <- 9.80665
  list(
    motor = list(torque_motor(1, 10), function(t, a, w) 1 - w / 10),
    curve = list(
      torque_curve(c(-20, 0, 2, 20), c(2, 1, 0.5, 0)),
      function(t, a, w) stats::approx(c(-20, 0, 2, 20), c(2, 1, 0.5, 0), w)$y
    ),
    spring = list(torque_spring(2, 0.1), function(t, a, w) -2 * (a - 0.1)),
    gravity = list(torque_gravity(1, 0.1), function(t, a, w) -0.1 * g * sin(a)),
    state = list(
      function(time_s, theta_rad, omega_rad_per_s) time_s - theta_rad - 0.2 * omega_rad_per_s,
      function(t, a, w) t - a - 0.2 * w
    ),
    all = list(
      torque_motor(1, 10) + torque_function(function(time_s) if (time_s < 0.25) 1 else 0, 0.25) +
        torque_spring(1) + torque_steps(0.3, 0.4),
      function(t, a, w) 1 - w / 10 + (t < 0.25) - a + 0.4 * (t > 0.3), c(0.25, 0.3)
    )
  )
}

test_that("every law about an axle moves every scene as Runge-Kutta does", {
  g <- 9.80665
  axle <- c("theta_rad", "omega_rad_per_s")
  lossy <- function(torque, w) {
    # T = torque - w' at the first gear; the share of 0.9 that passes, from whichever side it comes.
    driven <- torque / (1 + 2 / (9 * 0.9))
    if ((torque - driven) * w > 0) driven else torque / (1 + 2 * 0.9 / 9)
  }
  scenes <- list(
    axle = list(function(law) scene_axle(1, law, omega0_rad_per_s = 1), c(0, 1), axle,
                function(t, y, f) c(y[2], f(t, y[1], y[2]))),
    damped = list(
      function(law) scene_axle(2, law, resistance(0.1, 0.05, 0.3), omega0_rad_per_s = 3), c(0, 3),
      axle, function(t, y, f) {
        c(y[2], (f(t, y[1], y[2]) - 0.1 * y[2] - 0.05 * y[2]^2 - 0.3) / 2)
      }
    ),
    skater = list(
      function(law) scene_axle(inertia_knots(0:1, c(2, 1)), law, omega0_rad_per_s = 2), c(0, 2),
      axle, function(t, y, f) c(y[2], (f(t, y[1], y[2]) + y[2]) / (2 - t))
    ),
    braked = list(
      function(law) {
        scene_axle(1, law, brake = brake(0.5, from_s = 0.15, to_s = 0.35), omega0_rad_per_s = 3)
      }, c(0, 3), axle,
      function(t, y, f) c(y[2], f(t, y[1], y[2]) - 0.5 * (t > 0.15 && t < 0.35)), c(0.15, 0.35)
    ),
    pendulum = list(
      function(law) {
        scene_pendulum(body_rod(1, 1), 0.5, torque = law, theta0_rad = 0.3, omega0_rad_per_s = 1)
      }, c(0.3, 1), axle, function(t, y, f) c(y[2], 3 * (f(t, y[1], y[2]) - 0.5 * g * sin(y[1])))
    ),
    rotors = list(
      function(law) {
        scene_rotors(c(1, 2), 5, 0.1, torque = list(law, NULL), omega0_rad_per_s = c(1, 0))
      }, c(0, 0, 1, 0), axle, function(t, y, f) {
        shaft <- 5 * (y[1] - y[2]) + 0.1 * (y[3] - y[4])
        c(y[3], y[4], f(t, y[1], y[3]) - shaft, shaft / 2)
      }
    ),
    gears = list(
      function(law) scene_gears(c(1, 2), 3, torque = list(NULL, law), omega0_rad_per_s = 3),
      c(0, 3), axle, function(t, y, f) c(y[2], f(t, y[1] / 3, y[2] / 3) / 3 / (1 + 2 / 9))
    ),
    lossy = list(
      function(law) {
        scene_gears(c(1, 2), 3, efficiency = 0.9, torque = list(law, 0), omega0_rad_per_s = 3)
      }, c(0, 3), axle, function(t, y, f) c(y[2], lossy(f(t, y[1], y[2]), y[2]))
    ),
    clutch = list(
      function(law) scene_clutch(1, 2, 3, torque = list(law, NULL), omega0_rad_per_s = c(5, 0)),
      c(0, 5, 0, 0), NULL, function(t, y, f) c(y[2], f(t, y[1], y[2]) - 3, y[4], 1.5)
    ),
    drive = list(
      function(law) {
        scene_drive(
          c(1, 2), coupling_shaft(5, ratio = 2), torque = list(0.3, law),
          resistance = list(NULL, 0.2), brake = list(brake(0.4, from_s = 0.2), NULL),
          omega0_rad_per_s = c(6, 2)
        )
      }, c(0, 0, 6, 2), axle, function(t, y, f) {
        shaft <- 5 * (y[1] - 2 * y[2])
        c(y[3], y[4], 0.3 - shaft - 0.4 * (t > 0.2),
          (f(t, y[2], y[4]) + 2 * shaft - 0.2 * y[4]) / 2)
      }, 0.2
    )
  )
  for (scene in names(scenes)) {
    one <- scenes[[scene]]
    for (law in names(c(law_pairs(), state_law_pairs()))) {
      pair <- c(law_pairs(), state_law_pairs())[[law]]
      motion <- trajectory(one[[1]](pair[[1]]), c(0, 0.5))
      columns <- one[[3]] %||% if ("rotor" %in% names(motion)) axle else
        c("theta_1_rad", "omega_1_rad_per_s", "theta_2_rad", "omega_2_rad_per_s")
      got <- last_of(motion, columns)
      # A drive has angles, then rates.
      if (scene == "clutch" && "rotor" %in% names(motion)) got <- got[c(1, 3, 2, 4)]
      # Gears that are a drive have a row for each shaft.
      if (scene %in% c("gears", "lossy") && length(got) == 4L) {
        expect_equal(got[c(2, 4)], got[c(1, 3)] / 3, tolerance = 1e-12)
        got <- got[c(1, 3)]
      }
      expect_length(got, length(one[[2]]))
      breaks <- c(if (length(pair) > 2L) pair[[3]], if (length(one) > 4L) one[[5]])
      want <- rk4(function(t, y) one[[4]](t, y, pair[[2]]), one[[2]], 0, 0.5, breaks)
      # A kink of the curve at 2 rad/s is met by no step of Runge-Kutta.
      near <- if (law == "curve") 1e-5 else if (scene == "lossy") 1e-4 else 1e-8
      expect_lt(max(abs(got - want)) / max(abs(want)), near, label = paste(scene, law))
    }
  }
})

test_that("a clutch that locks under any law of time keeps the angular momentum", {
  for (law in names(law_pairs())) {
    pair <- law_pairs()[[law]]
    motion <- trajectory(
      scene_clutch(1, 2, 3, torque = list(pair[[1]], NULL), omega0_rad_per_s = c(3, 0)), c(0, 1.5)
    )
    impulse <- rk4(function(t, y) pair[[2]](t, 0, 0), 0, 0, 1.5, c(pair[3][[1]], 1))
    rates <- if ("rotor" %in% names(motion)) last_of(motion, "omega_rad_per_s") else
      last_of(motion, c("omega_1_rad_per_s", "omega_2_rad_per_s"))
    expect_equal(rates, rep((3 + impulse) / 3, 2), tolerance = 1e-8, label = law)
  }
})

test_that("every law of time moves bodies in space as Runge-Kutta does", {
  euler <- function(moments) function(w, torque) (torque - cross3(w, moments * w)) / moments
  moments <- c(1, 1.5, 2)
  space <- c("omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s")
  start <- c(0.3, 0.2, 1)
  attitude <- as.double(diag(3))
  scenes <- list(
    body_axes = list(
      function(law) scene_free(moments, start, torque = list(z = law)), start,
      function(t, y, f) euler(moments)(y, c(0, 0, f(t, 0, 0)))
    ),
    space_axes = list(
      function(law) scene_free(moments, start, torque = list(x = law), torque_axes = "space"),
      c(start, attitude), function(t, y, f) {
        turn <- matrix(y[4:12], 3)
        c(euler(moments)(y[1:3], as.double(t(turn) %*% c(f(t, 0, 0), 0, 0))),
          as.double(turn %*% skew(y[1:3])))
      }
    ),
    pivot = list(
      function(law) {
        scene_pivot(moments, start, mass_kg = 1, centre_m = c(0, 0, 0.2),
                    torque = list(x = law, y = 0.1))
      }, c(start, attitude), function(t, y, f) {
        turn <- matrix(y[4:12], 3)
        weight <- as.double(t(turn) %*% c(0, 0, -9.80665))
        c(euler(moments)(y[1:3], cross3(c(0, 0, 0.2), weight) + c(f(t, 0, 0), 0.1, 0)),
          as.double(turn %*% skew(y[1:3])))
      }
    ),
    # J (W' + w_z') = u; the body without the rotor's J takes -u.
    rotor = list(
      function(law) scene_free(moments, start, rotors = rotor("z", 0.1, 3, law)), c(start, 3),
      function(t, y, f) {
        u <- f(t, 0, 0)
        momentum <- moments * y[1:3] + c(0, 0, 0.1 * y[4])
        across <- -cross3(y[1:3], momentum)
        rate <- c(across[1] / moments[1], across[2] / moments[2], (across[3] - u) / 1.9)
        c(rate, u / 0.1 - rate[3])
      }
    ),
    # Driven: W stays.
    driven = list(
      function(law) {
        scene_free(moments, start, torque = list(y = law), rotors = rotor("z", 0.1, 3))
      }, start, function(t, y, f) {
        (c(0, f(t, 0, 0), 0) - cross3(y, moments * y + c(0, 0, 0.3))) / moments
      }
    )
  )
  for (scene in names(scenes)) {
    one <- scenes[[scene]]
    for (law in names(law_pairs())) {
      pair <- law_pairs()[[law]]
      got <- last_of(trajectory(one[[1]](pair[[1]]), c(0, 0.5)), space)
      want <- rk4(function(t, y) one[[3]](t, y, pair[[2]]), one[[2]], 0, 0.5, pair[3][[1]])[1:3]
      expect_lt(max(abs(got - want)) / max(abs(want)), 1e-8, label = paste(scene, law))
    }
  }
  # Functions of the state, in body axes and in space.
  law <- function(time_s, omega_rad_per_s, attitude) c(time_s, -omega_rad_per_s[3], attitude[2])
  got <- last_of(trajectory(scene_free(moments, start, torque = law), c(0, 0.5)), space)
  want <- rk4(function(t, y) {
    turn <- y[4:7]
    w <- y[1:3]
    c(euler(moments)(w, c(t, -w[3], turn[2])), 0.5 * c(
      -sum(turn[2:4] * w), turn[1] * w + cross3(turn[2:4], w)
    ))
  }, c(start, 1, 0, 0, 0), 0, 0.5)[1:3]
  expect_lt(max(abs(got - want)), 1e-8)
})

test_that("every force moves a body on an incline as Runge-Kutta does", {
  ball <- body_sphere(2, 0.1)
  g <- 9.80665
  forces <- list(
    number = list(3, function(t, x, v) 3),
    time = list(function(time_s) 5 * cos(4 * time_s), function(t, x, v) 5 * cos(4 * t)),
    breaks = list(
      force_function(function(time_s) if (time_s < 0.2) 5 else -5, 0.2),
      function(t, x, v) if (t < 0.2) 5 else -5, 0.2
    ),
    state = list(function(time_s, x_m, v_m_per_s) time_s - 2 * x_m - v_m_per_s,
                 function(t, x, v) t - 2 * x - v)
  )
  for (name in names(forces)) {
    one <- forces[[name]]
    # Rolling: 1.4 m v' = m g sin(a) + F. Slipping: the kinetic friction of 0.1 opposes the slip.
    rolls <- trajectory(scene_incline(ball, 20, force = one[[1]], v0_m_per_s = 1), c(0, 0.5))
    want <- rk4(function(t, y) {
      c(y[2], (g * sinpi(20 / 180) + one[[2]](t, y[1], y[2]) / 2) / 1.4)
    }, c(0, 1), 0, 0.5, one[3][[1]])
    expect_lt(max(abs(last_of(rolls, c("x_m", "v_m_per_s")) - want)), 1e-8, label = name)
    slips <- trajectory(scene_incline(
      ball, 5, force = one[[1]], v0_m_per_s = 4, omega0_rad_per_s = 0, static_friction = 0.1,
      resistance = resistance(drag_n_s_per_m = 0.3, drag_n_s2_per_m2 = 0.05)
    ), c(0, 0.3))
    want <- rk4(function(t, y) {
      normal <- 0.1 * g * cospi(5 / 180)
      drag <- (0.3 + 0.05 * abs(y[2])) * y[2]
      c(y[2], g * sinpi(5 / 180) - normal + (one[[2]](t, y[1], y[2]) - drag) / 2,
        2.5 * normal / 0.1)
    }, c(0, 4, 0), 0, 0.3, one[3][[1]])
    expect_lt(
      max(abs(last_of(slips, c("x_m", "v_m_per_s", "omega_rad_per_s")) - want)), 1e-8,
      label = name
    )
  }
})

test_that("what a scene does not take is refused with the scene or the argument that does", {
  rod <- body_rod_end(1, 1)
  disk <- body_disk(1, 0.1)
  refused <- list(
    list(quote(scene_hanging_mass(disk, 1, torque = 1)), "scene_axle\\(torque"),
    list(quote(scene_hoop(1, 1, 2, torque = 1)), "scene_axle"),
    list(quote(scene_chain(c(1, 1), 1, 0.1, torque = 1)), "scene_pendulum\\(torque"),
    list(quote(scene_incline(disk, 20, torque = 1)), "`force`"),
    list(quote(scene_axle(1, force = 1)), "torque_of_force"),
    list(quote(scene_axle(1, torque = brake(1))), "`brake = brake\\(...\\)`"),
    list(quote(scene_axle(1, resistance = brake(1))), "`brake = brake\\(...\\)`"),
    list(quote(scene_axle(1, torque = resistance(1))), "resistance = resistance"),
    list(quote(scene_axle(inertia_knots(0:1, 1:2), brake = brake(1))), "coulomb_n_m"),
    list(quote(scene_incline(disk, 20, force = torque_constant(1))), "force_function"),
    list(quote(scene_free(disk, c(0, 0, 1), torque = torque_motor(1, 2))), "list\\(z = "),
    list(quote(scene_free(disk, c(0, 0, 1), torque = list(z = torque_motor(1, 2)))), "torque\\$z")
  )
  for (name in c("scene_pendulum(rod", "scene_hanging_mass(disk, 1", "scene_hoop(1, 1, 2",
                 "scene_chain(1, 1, 0.1", "scene_incline(disk, 20", "scene_free(disk, c(0, 0, 1)",
                 "scene_pivot(disk, c(0, 0, 1)")) {
    refused <- c(refused, list(list(str2lang(paste0(name, ", brake = brake(1))")), "scene_gears")))
  }
  for (one in refused) {
    error <- expect_error(eval(one[[1]]), class = "rotdyn_error")
    expect_match(gsub("\\s+", " ", conditionMessage(error)), one[[2]], info = deparse(one[[1]]))
  }
})

test_that("a function of other arguments is refused with the name that it was given by", {
  two <- function(a, b) 1
  for (one in list(
    list(quote(scene_axle(1, torque = two)), "`torque`"),
    list(quote(scene_axle(1, two)), "`torque`"), list(quote(spin_up(torque = two)), "`torque`"),
    list(quote(scene_pendulum(body_rod_end(1, 1), torque = two)), "`torque`"),
    list(quote(scene_rotors(c(1, 2), 5, torque = list(NULL, two))), "`torque"),
    list(quote(scene_gears(c(1, 2), 5, torque = list(NULL, two))), "`torque"),
    list(quote(scene_drive(c(1, 2), coupling_shaft(5), torque = list(NULL, two))), "`torque"),
    list(quote(scene_clutch(1, 2, 3, torque = list(NULL, two))), "`torque"),
    list(quote(scene_free(c(1, 1, 2), c(0, 0, 1), torque = list(z = two))), "`torque\\$z`"),
    list(quote(angular_impulse(two, 0, 1)), "`torque`"),
    list(quote(brake(two)), "`capacity_n_m`"), list(quote(coupling_clutch(two)), "`capacity_n_m`"),
    list(quote(torque_function(two)), "`f`"), list(quote(brake("a")), "`capacity_n_m`")
  )) {
    error <- expect_error(eval(one[[1]]), class = "rotdyn_error")
    expect_match(conditionMessage(error), paste0("^", one[[2]]), info = deparse(one[[1]]))
  }
})

test_that("arguments of a law in another order are refused: they are given by place", {
  for (one in list(
    quote(scene_axle(1, function(theta_rad) -theta_rad)),
    quote(scene_axle(1, function(omega) -omega)),
    quote(torque_function(function(theta_rad, omega_rad_per_s, time_s) -theta_rad)),
    quote(scene_rotors(c(1, 2), 5, torque = list(NULL, function(omega_rad_per_s) 1))),
    quote(scene_free(c(1, 1, 2), c(0, 0, 1), torque = function(omega_rad_per_s) c(0, 0, 1))),
    quote(scene_free(c(1, 1, 2), c(0, 0, 1), torque = function(t, attitude, omega) c(0, 0, 1))),
    quote(rotor("z", 1, 2, function(attitude) 1)),
    quote(scene_incline(body_sphere(1, 0.1), 20, force = function(v_m_per_s) -v_m_per_s)),
    quote(force_function(function(time_s, v_m_per_s, x_m) -v_m_per_s))
  )) {
    error <- expect_error(eval(one), class = "rotdyn_error")
    expect_match(conditionMessage(error), "in this order", info = deparse(one))
  }
  # Names of one's own are taken by place.
  expect_s3_class(scene_axle(1, function(t, a, w) -a), "rot_scene_axle")
  expect_s3_class(scene_axle(1, function(t, theta, omega, k = 2) -k * theta), "rot_scene_axle")
})
