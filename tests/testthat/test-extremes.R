# The truth is inst/extdata/extremes.csv.gz: 40 digits, by tools/extremes.py (mpmath). Every case is
# right to the error that the run reports, or an error of the package.

extreme_cases <- function() {
  path <- system.file("extdata", "extremes.csv.gz", package = "rotdyn")
  cases <- utils::read.csv(path, colClasses = "character")
  text <- c("case", "group", "expect", "law", "x")
  cases[setdiff(names(cases), text)] <- lapply(cases[setdiff(names(cases), text)], as.numeric)
  cases$x <- lapply(strsplit(cases$x, ";"), as.numeric)
  cases
}

extreme_law <- function(law, x) {
  odd <- x[c(TRUE, FALSE)]
  even <- x[c(FALSE, TRUE)]
  switch(law,
    constant = torque_constant(x),
    knots = torque_knots(odd, even),
    steps = torque_steps(odd, even),
    pulse = torque_pulse(x[1], x[2], x[3]),
    sinusoid = torque_sinusoid(x[1], x[2], x[3]),
    exponential = torque_exponential(x[1], x[2], from_s = x[3]),
    motor = torque_motor(x[1], x[2]),
    pendulum = torque_gravity(x, 1, gravity_m_per_s2 = 1),
    oscillator = torque_spring(x[1]) + torque_sinusoid(x[2], x[3]),
    stiff = torque_function(function(time_s, theta_rad, omega_rad_per_s) -x * theta_rad, numeric()),
    skater = NULL
  )
}

extreme_scene <- function(one) {
  x <- one$x[[1]]
  body <- if (one$law == "skater") inertia_knots(x[c(1, 3)], x[c(2, 4)]) else one$I
  scene_axle(
    body, extreme_law(one$law, x),
    resistance(one$c, one$q, one$coulomb, one$static), one$theta0, one$omega0, start_s = one$start
  )
}

# How far off, over what the run says; the truth as a double is off by half an ulp itself, and below
# 2.2e-308 a double has fewer digits.
times_reported <- function(motion, one) {
  info <- run_of(motion)$info
  off <- function(got, want, error) {
    allowed <- error + 2^-53 * abs(want) + 2^-1073
    abs(got - want) / allowed
  }
  max(
    off(motion$theta_rad, one$theta, info$errors[["theta"]]),
    off(motion$omega_rad_per_s, one$omega, info$errors[["omega"]])
  )
}

test_that("no silent wrong answer: every extreme is right to its error, or refused", {
  cases <- extreme_cases()
  expect_gt(nrow(cases), 150)
  for (i in seq_len(nrow(cases))) {
    one <- cases[i, ]
    warned <- FALSE
    run <- function() {
      withCallingHandlers(
        trajectory(extreme_scene(one), one$t),
        rotdyn_warning_accuracy = function(w) {
          warned <<- TRUE
          rlang::cnd_muffle(w)
        }
      )
    }
    if (one$expect == "value") {
      motion <- run()
      expect_lte(times_reported(motion, one), if (one$law == "stiff") 1.5 else 1, label = one$case)
      expect_equal(warned, summary(motion)$error > 1e-9, label = one$case)
    } else {
      expect_error(run(), class = paste0("rotdyn_error_", one$expect), label = one$case)
    }
  }
})

test_that("rows on a grid that begins after the stop, and on both sides of it", {
  scene <- scene_axle(2, resistance = resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
  expect_identical(trajectory(scene, c(50, 1e12))$theta_rad, c(200, 200))
  expect_identical(trajectory(scene, c(50, 1e12))$omega_rad_per_s, c(0, 0))
})

test_that("a stop after less time than a double can tell leaves no row unwritten", {
  brake <- resistance(coulomb_n_m = 1e300)
  motion <- trajectory(scene_axle(1e-300, 0, brake, 7, -10), c(1e-290, 1, 2))
  expect_identical(motion$theta_rad, c(7, 7, 7))
  expect_identical(motion$omega_rad_per_s, c(0, 0, 0))
})

test_that("a motor's slope is a quotient: where the sum drives, its rounding is in the bound", {
  # mpmath, 50 digits: exp((1 - 1/3) 600) and so on, from the doubles 1, 3, -1.
  cases <- extreme_cases()
  one <- cases[cases$law == "motor", ]
  motion <- suppressWarnings(trajectory(extreme_scene(one), one$t)) # of its energy
  expect_lte(times_reported(motion, one), 1)
  expect_gt(summary(motion)$error, 1e-14)
})

test_that("the phase of a wave of 1e21 rad/s is lost, and the bound says so", {
  scene <- scene_axle(17.8, torque_sinusoid(1, 3.3e21), start_s = -0.00148)
  motion <- suppressWarnings(trajectory(scene, c(50, 152)))
  expect_gt(summary(motion)$error, 1e-11)
})

test_that("sums keep what cancellation leaves", {
  torque <- torque_constant(1e16) + torque_constant(1) - torque_constant(1e16)
  expect_identical(trajectory(scene_axle(1, torque), 2)$omega_rad_per_s, 2)
})

test_that("what no double holds is refused at the door", {
  expect_error(1e300 * torque_constant(1e300), class = "rotdyn_error_value")
  expect_error(1e300 * torque_motor(1e300, 1), class = "rotdyn_error_value")
  expect_error(torque_constant(1) / 0, class = "rotdyn_error_value")
  expect_error(scene_axle(body_disk(1e-200, 1e-60)), class = "rotdyn_error_value")
  steep <- torque_curve(c(0, 1e-300), c(1e300, -1e300))
  expect_error(trajectory(scene_axle(1, steep), 1), class = "rotdyn_error_range")
})

test_that("an implicit method does not damp what grows", {
  scene <- scene_axle(0.5, resistance = resistance(3e57), omega0_rad_per_s = 6)
  expect_error(
    trajectory(scene, -0.07, 1e-8, model = "axle_radau", max_steps = 1e4), class = "rotdyn_error"
  )
})

test_that("a moment of inertia that only jumps", {
  jump <- inertia_knots(c(1, 1), c(4, 2))
  motion <- trajectory(scene_axle(jump, omega0_rad_per_s = 3), c(0, 1, 2))
  expect_identical(motion$moment_of_inertia_kg_m2, c(4, 2, 2))
  expect_identical(motion$omega_rad_per_s, c(3, 6, 6))
})

test_that("a line of any steepness leads to the edge, and the edge tells what comes then", {
  for (steep in 10^c(6, 14, 20, 28)) {
    up <- trajectory(scene_axle(1, torque_curve(c(-1, 1), c(steep, 20))), c(0.5, 3))
    expect_equal(up$omega_rad_per_s, c(11, 61), tolerance = 100 / steep + 1e-14)
    # From -1 to -2 at once; then omega' = -201 - omega.
    push <- torque_knots(c(1, 1), c(-200, 0), outside = "hold") +
      torque_curve(c(-2, -1), c(-1, -steep))
    down <- trajectory(scene_axle(1, push, resistance(1), 0, -1.2), 0.5)
    expect_equal(down$omega_rad_per_s, -201 + 199 * exp(-0.5), tolerance = 100 / steep + 1e-14)
  }
})

test_that("drops and pendulums of any size follow their scaling laws", {
  # h times 4^k, Omega over 2^k: times times 2^k, lengths times 4^k, all of them exact.
  drop <- earth_drop(100, 45)
  for (k in c(-300, 300)) {
    scaled <- earth_drop(100 * 4^k, 45, rotation_rad_per_s = 7.292115e-5 / 2^k)
    expect_identical(scaled$fall_time_s, drop$fall_time_s * 2^k)
    expect_identical(scaled$deflection_east_m, drop$deflection_east_m * 4^k)
  }
  # At a height near 0 the Earth stands still; at one of 1e160 m the fall along its axis is left.
  expect_equal(earth_drop(5e-324, 45)$fall_time_s / sqrt(2 * 2^-1074) * sqrt(9.80665), 1)
  expect_equal(earth_drop(1e160, 45)$fall_time_s, sqrt(2e160 / 9.80665) / sinpi(1 / 4))
  expect_warning(far <- foucault_pendulum(1e160, 45, 10, 1), class = "rotdyn_warning_range")
  expect_identical(c(far$east_m, far$north_m_per_s), c(NaN, NaN))
  expect_equal(far$swing_period_s, foucault_pendulum(0, 45, 10, 1)$swing_period_s)
  short <- foucault_pendulum(0, 45, 1e-310, 1e-312, gravity_m_per_s2 = 10)
  expect_equal(short$swing_period_s / (2 * pi * sqrt(1e-310) / sqrt(10)), 1)
  expect_equal(
    foucault_pendulum(0, 45, 1e200, 1e198, 1e198)$ellipse_rate_rad_per_s,
    foucault_pendulum(0, 45, 10, 0.1, 0.1)$ellipse_rate_rad_per_s
  )
  expect_warning(
    rod <- falling_rod(body_rod_end(1, 1e-310), 90), "alpha", class = "rotdyn_warning_range"
  )
  expect_equal(rod$omega_rad_per_s / sqrt(1e-310)^-1, sqrt(3 * 9.80665), tolerance = 1e-14)
})

test_that("a stop at an angle beyond double precision has its time", {
  wheel <- scene_axle(2, omega0_rad_per_s = 1e160, resistance = resistance(coulomb_n_m = 4))
  expect_warning(found <- stopping(wheel), "stop_theta_rad", class = "rotdyn_warning_range")
  expect_equal(found$stop_time_s, 5e159)
  expect_identical(found$stop_theta_rad, Inf)
})

test_that("what squares or sums of numbers would lose is kept or named", {
  # Relative uncertainties of 1e-10 and 1e-2.
  ratio <- measured(1, 1e-10) / measured(1e-170, 1e-172)
  expect_equal(ratio$value, 1e170)
  expect_equal(abs(ratio$parts$u), c(1e160, 1e168))
  expect_identical(energy_partition(body_sphere(1, 1e-160), 1)$radius_m, 1e-160)
  quarter <- attitude_from(c(1, 0, 0, pi / 4), "axis_angle")
  turned <- attitude_turn(quarter, c(1e308, 1.2e308, 1.2e308))
  expect_equal(unlist(turned) / 1e308, c(x = 1, y = 0, z = 1.2 * sqrt(2)))
  expect_warning(attitude_turn(quarter, c(0, 1.7e308, 1.7e308)), class = "rotdyn_warning_range")
  plan <- sweep_plan(
    scene_axle(1, theta0_rad = 1), 1, design_grid(theta0_rad = c(1, 1.2, 1.4) * 1e308),
    outputs = "final_theta_rad"
  )
  expect_warning(summary(sweep_run(plan)), "mean", class = "rotdyn_warning_range")
})

test_that("closed forms say which numbers are beyond double precision", {
  beyond <- function(expr) expect_warning(expr, class = "rotdyn_warning_range")
  beyond(yo_yo(body_disk(1, 0.1), 0.01, gravity_m_per_s2 = 1.7e308))
  beyond(atwood_machine(1.7e308, 1, body_disk(1, 0.1)))
  beyond(spool_pull(body_disk(1e-310, 0.1), 1, 20, 0.05, 0.3))
  beyond(ball_on_turntable(body_sphere(1, 0.1), 1, 1, 1e160))
  beyond(angular_impulse(torque_pulse(1, 1, 2), body = 1e-310))
  beyond(roll_race(list(body_disk(1, 0.1)), 20, 1.7e308, frames = 3))
  expect_error(inertia_bifilar(1, 2, 1, 1.7e308, 0.2), class = "rotdyn_error_range")
  # A ball at rest on a table at rest, and a pull at which nothing presses on the floor: no warning.
  expect_silent(ball_on_turntable(body_sphere(1, 0.1), 1, 0, 1))
  expect_silent(spool_pull(body_disk(1, 0.1), 100, 80, 0.05))
})

test_that("a motion that no budget can finish is refused at once", {
  refused <- function(scene, time_s = 0:1) {
    expect_soon(
      expect_error(trajectory(scene, time_s), "turns", class = "rotdyn_error_budget"), 20
    )
  }
  refused(scene_hoop(1, 1e-160, 2, theta0_rad = 1))
  refused(scene_hoop(1, 1, 2, theta0_rad = 1, gravity_m_per_s2 = 1e300))
  refused(scene_hoop(1, 1, 1e80, theta0_rad = 1))
  refused(scene_hoop(1, 1, 2, theta0_rad = 1), c(0, 1e80))
  refused(suppressWarnings(scene_free(c(1e-160, 1.5, 2), c(1, 1, 0.1))))
  refused(scene_free(c(1, 1.5, 2), c(1, 1, 0.1), torque = c(1e160, 0, 0)))
  refused(scene_pendulum(
    body_rod(1, 1), 0.5, resistance(0.1), theta0_rad = 1, gravity_m_per_s2 = 1e80
  ))
  # At rest it takes no steps, with friction it comes to rest.
  bead <- trajectory(scene_hoop(1, 1, 2, theta0_rad = 0), c(0, 1e80))
  expect_identical(bead$theta_rad, c(0, 0))
  slows <- scene_hoop(1, 1, 2, theta0_rad = 1, static_friction = 0.1)
  expect_identical(trajectory(slows, c(0, 1e80))$omega_rad_per_s[2], 0)
})

test_that("impulses and engagements are right where squares or sums are no doubles", {
  # (1 + e) v/d = 2/1.7e308 is the change of rate; J d = I times it, J itself is none.
  hit <- hinged_hit(body_rod_end(1, 1), 0.5, 1.7e308, 1, 2)
  expect_equal(hit$omega_rad_per_s * 1e308, 2 / 1.7)
  expect_equal(hit$hinge_impulse_n_s * 1e308, 0.5 * 2 / 1.7)
  expect_equal(hit$particle_v_m_per_s, 2)
  # A particle without inertia stays at the body at rest.
  hit <- hinged_hit(body_rod_end(1, 1), 0.5, 1, 5e-324, 2)
  expect_equal(hit$particle_v_m_per_s, 0)
  expect_equal(hit$impulse_n_s, 1e-323)
  # The clutch locks at the mean speed, after a time that is no double.
  expect_warning(
    locked <- clutch_engagement(1, 2, 5e-324, 4), "lock_time_s", class = "rotdyn_warning_range"
  )
  expect_equal(locked$common_omega_rad_per_s, 4 / 3)
  expect_equal(locked$heat_j, 16 / 3)
  small <- clutch_engagement(5e-324, 5e-324, 1e-310, 4)
  expect_equal(small$common_omega_rad_per_s, 2)
  expect_silent(slips <- clutch_engagement(1, 2, 5e-324, 0, torque_1_n_m = 1))
  expect_identical(slips$lock_time_s, Inf)
  expect_warning(
    earth_projectile(1e160, 45, 1), "north_m,", class = "rotdyn_warning_range"
  )
  race <- suppressWarnings(
    roll_race(list(body_disk(1, 0.1)), 20, 1, gravity_m_per_s2 = 1.7e308, frames = 3)
  )
  expect_identical(race$theta_rad[1], 0)
  expect_error(
    energy_partition(body_sphere(1, 1e-170), 1), "body.*too near for double precision",
    class = "rotdyn_error_value"
  )
})

test_that("a top's rates and a curve's sizes beyond double precision are named", {
  wheel <- function(...) precession_table(body_hoop(2, 0.3), lever_arm_m = 0.1, ...)
  expect_warning(wheel(spin_rad_per_s = 1e-310), "rad_per_s", class = "rotdyn_warning_range")
  expect_warning(
    wheel(spin_rad_per_s = 20, gravity_m_per_s2 = 5e-324), "period",
    class = "rotdyn_warning_range"
  )
  expect_silent(wheel(spin_rad_per_s = 20, gravity_m_per_s2 = 0))
  top <- function(spin, angle) {
    precession_table(data.frame(
      mass_kg = 1, lever_arm_m = 0.1, moment_of_inertia_kg_m2 = 0.5,
      transverse_moment_kg_m2 = 1, spin_rad_per_s = spin, axis_angle_deg = angle
    ))
  }
  # A fast top's axis moves in proportion to its angle.
  small <- top(10, c(1e-10, 1e-80, 1e-160))
  expect_equal(small$mean_precession_rad_per_s, rep(small$mean_precession_rad_per_s[1], 3))
  expect_equal(
    small$lowest_angle_deg / c(1e-10, 1e-80, 1e-160), rep(small$lowest_angle_deg[1] / 1e-10, 3)
  )
  # A slow one is a pendulum: it passes the bottom, half a turn on, in each period.
  slow <- top(c(1e-160, -1e-160), 30)
  expect_equal(slow$mean_precession_rad_per_s * slow$nutation_period_s, c(pi, -pi))
  bowl <- function(a, to = 2, ...) {
    summary(roll_on_curve(function(x) a * (x - 2)^2, 0, to, v0_m_per_s = 1, rows = 3, ...))
  }
  for (a in c(1e160, 1e300)) expect_error(bowl(a), class = "rotdyn_error_range")
  for (to in c(5e-324, 1e-310)) expect_error(bowl(0.5, to), class = "rotdyn_error_range")
  for (r in c(1e-310, 1e160)) {
    expect_error(
      roll_on_curve(curve_cycloid(r), 0.1, 3, v0_m_per_s = 1), class = "rotdyn_error_range"
    )
  }
  expect_equal(bowl(0.5, friction = 1.7e308)$time_s, bowl(0.5)$time_s)
  # A level track: its heights are subnormal.
  expect_equal(expect_soon(bowl(5e-324)$time_s, 20), 2)
})

test_that("a shaft of any stiffness turns as a gear", {
  driven <- function(coupling) {
    scene <- scene_drive(
      c(0.002, 0.5), coupling, torque = list(torque_sinusoid(2, 5), 0),
      resistance = list(NULL, resistance(0.05))
    )
    trajectory(scene, 0:1)
  }
  rigid <- driven(coupling_gear(10))
  for (stiffness in c(1e20, 1e80)) { # a budget ended where rounding ended the implicit steps
    run <- driven(coupling_shaft(stiffness, 0.4, ratio = 10))
    errors <- run_of(run)$info$errors + run_of(rigid)$info$errors
    expect_lt(max(abs(run$theta_rad - rigid$theta_rad)), errors[["theta"]])
    expect_lt(max(abs(run$omega_rad_per_s - rigid$omega_rad_per_s)), errors[["omega"]])
  }
})

test_that("runs far beyond a budget end early", {
  skip_on_cran()
  ends_early <- function(run, class) {
    run <- rlang::enquo(run)
    # Up to 11 units, and 200 or more to the end of a budget.
    expect_soon(expect_error(rlang::eval_tidy(run), class = class), 60)
  }
  clutch <- function(...) {
    scene <- scene_drive(
      c(1, 2), coupling_clutch(3), torque = list(torque_motor(2, 1), NULL), resistance = list(...),
      omega0_rad_per_s = c(1, 0)
    )
    trajectory(scene, c(0, 1e80))
  }
  ends_early(clutch(resistance(0.1), resistance(0, 0.1)), "rotdyn_error_budget")
  ends_early(clutch(NULL, resistance(1, 0.1)), "rotdyn_error_budget")
  chain <- scene_chain(
    c(1, 1e-80, 1), 1, resistance = resistance(0.1), theta0_rad = c(0.1, 0.2, 0.3)
  )
  ends_early(trajectory(chain, c(0, 1)), "rotdyn_error_budget")
  ends_early(roll_disk(body_disk(1, 0.1), c(0, 1), spin_rad_per_s = 1e80), "rotdyn_error_budget")
  ends_early(roll_on_curve(curve_cycloid(1), 0, 1e80), "rotdyn_error_range")
})
