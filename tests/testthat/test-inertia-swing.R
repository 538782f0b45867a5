test_that("torsion and compound pendulum: closed forms, at any amplitude", {
  expect_equal(inertia_torsion(2, 3)$value, 3 / pi^2, tolerance = 1e-15)
  expect_equal(inertia_torsion(2, 3, decay_per_s = 0.5)$value, 3 / (pi^2 + 0.25),
    tolerance = 1e-15)
  rod <- body_rod_end(0.2, 0.6)
  inertia <- 0.2 * 0.6^2 / 3
  for (amplitude in c(0, 0.3, 1, 2.5)) {
    t <- period_of(scene_pendulum(rod, theta0_rad = amplitude))$period_s
    got <- inertia_compound_pendulum(t, 0.2, 0.3, amplitude_rad = amplitude)
    expect_equal(got$value / inertia, 1, tolerance = 1e-13)
    expect_equal(got$centre$value, 0.2 * 0.6^2 / 12, tolerance = 1e-12)
  }
  # Without the correction: 1.1 % at 0.3 rad.
  t <- period_of(scene_pendulum(rod, theta0_rad = 0.3))$period_s
  expect_within(inertia_compound_pendulum(t, 0.2, 0.3)$value / inertia - 1, 0.0113, 0.02)
})

# A quarter of the swing of a platform, integrated by Runge and Kutta, of the Lagrangian
# (I + m h'^2) theta'^2/2 + m g h(theta): an independent way to the period.
integrated_period <- function(inertia, m, upper, lower, wire, amplitude, g, steps = 4000) {
  h <- function(a) sqrt(wire^2 - (upper - lower)^2 - 4 * upper * lower * sin(a / 2)^2)
  rhs <- function(y) {
    height <- h(y[1])
    h1 <- -upper * lower * sin(y[1]) / height
    h2 <- -upper * lower * cos(y[1]) / height - h1^2 / height
    c(y[2], (m * g * h1 - m * h1 * h2 * y[2]^2) / (inertia + m * h1^2))
  }
  dt <- 0.27 * 2 * pi * sqrt(inertia * h(0) / (m * g * upper * lower)) / steps
  y <- c(amplitude, 0)
  t <- 0
  step <- function(y, dt) {
    k1 <- rhs(y)
    k2 <- rhs(y + dt / 2 * k1)
    k3 <- rhs(y + dt / 2 * k2)
    k4 <- rhs(y + dt * k3)
    y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
  }
  while (y[1] > 0) {
    y <- step(y, dt)
    t <- t + dt
  }
  # Back to theta = 0.
  for (round in 1:4) {
    back <- -y[1] / y[2]
    y <- step(y, back)
    t <- t + back
  }
  4 * t
}

test_that("two and three wires at 1 rad: against an integration of the motion", {
  t <- integrated_period(0.004, 0.9, 0.12, 0.05, 0.6, 1, 9.80665)
  got <- inertia_trifilar(t, 0.9, 0.6, 0.12, 0.05, amplitude_rad = 1)
  expect_equal(got$value / 0.004, 1, tolerance = 1e-10)
  got <- inertia_bifilar(t, 0.9, 0.6, 0.24, 0.10, amplitude_rad = 1)
  expect_equal(got$value / 0.004, 1, tolerance = 1e-10)
  # Small swings: I = m g R r T^2/(4 pi^2 h), with the height.
  h <- sqrt(0.6^2 - 0.07^2)
  small <- inertia_trifilar(1.5, 0.9, 0.6, 0.12, 0.05)$value
  expect_equal(small, 0.9 * 9.80665 * 0.12 * 0.05 * 1.5^2 / (4 * pi^2 * h), tolerance = 1e-13)
  expect_equal(inertia_trifilar(1.5, 0.9, height_m = h, upper_radius_m = 0.12,
    lower_radius_m = 0.05)$value, small, tolerance = 1e-14)
  # The length instead of the height is 0.7 % off.
  expect_within(0.6 / h - 1, 0.0069, 0.01)
})

test_that("wide swings and compact bodies: against an integration of the motion", {
  # 16 nodes gave 0.6 % too much at 3 rad, and 0.25 % too little for 1 cm on wires 0.4 m apart.
  t <- integrated_period(0.001, 0.5, 0.1, 0.05, 0.6, 3, 9.80665)
  got <- inertia_trifilar(t, 0.5, 0.6, 0.1, 0.05, amplitude_rad = 3)
  expect_equal(got$value / 0.001, 1, tolerance = 1e-8)
  t <- integrated_period(1e-4, 1, 0.2, 0.2, 0.25, 1, 9.80665)
  got <- inertia_bifilar(t, 1, 0.25, 0.4, 0.4, amplitude_rad = 1)
  expect_equal(got$value / 1e-4, 1, tolerance = 1e-8)
})

test_that("uncertainty: shared quantities count once in a difference", {
  plate <- measured(0.512, 0.001, name = "plate")
  load <- measured(1.204, 0.001, name = "load")
  wire <- measured(0.6, 0.001, name = "wires")
  upper <- measured(0.12, 5e-4, name = "R")
  lower <- measured(0.05, 5e-4, name = "r")
  t0 <- measured(1.58, 0.002, name = "T0")
  t1 <- measured(1.21, 0.002, name = "T1")
  empty <- inertia_trifilar(t0, plate, wire, upper, lower)
  loaded <- inertia_trifilar(t1, plate + load, wire, upper, lower)
  body <- loaded - empty
  # By hand: I = c (m1 t1^2 - m0 t0^2) with c = g R r/(4 pi^2 h).
  value <- function(p, l, w, a, b, x, y) {
    9.80665 * a * b / (4 * pi^2 * sqrt(w^2 - (a - b)^2)) * ((p + l) * y^2 - p * x^2)
  }
  at <- c(0.512, 1.204, 0.6, 0.12, 0.05, 1.58, 1.21)
  u <- c(1e-3, 1e-3, 1e-3, 5e-4, 5e-4, 2e-3, 2e-3)
  slope <- vapply(seq_along(at), function(k) {
    h <- 1e-6
    (do.call(value, as.list(replace(at, k, at[k] + h))) -
      do.call(value, as.list(replace(at, k, at[k] - h)))) / (2 * h)
  }, 0)
  expect_equal(body$value, do.call(value, as.list(at)), tolerance = 1e-12)
  expect_within(body$u, sqrt(sum((slope * u)^2)), 1e-4)
  # As if they were independent the error would be another.
  expect_gt(abs(sqrt(empty$u^2 + loaded$u^2) / body$u - 1), 0.1)
  expect_setequal(loaded$contributions$input, c("T1", "plate", "load", "wires", "R", "r"))
  expect_equal(sum(loaded$contributions$share), 1, tolerance = 1e-12)
})

test_that("the result is a scene's inertia and an entry of a tensor", {
  got <- inertia_torsion(measured(2, 0.01), 3)
  expect_equal(scene_axle(got)$moment_of_inertia_kg_m2, got$value)
  body <- body_tensor(10, c(as.double(got), as.double(got), 0.2))
  expect_equal(inertia_tensor(body)[1, 1], got$value)
  body <- body_tensor(10, c(ixx = got, iyy = got, izz = measured(0.2, 0.01)))
  expect_equal(diag(inertia_tensor(body)), c(got$value, got$value, 0.2), ignore_attr = TRUE)
  expect_output(print(got), "torsion")
  expect_output(print(inertia_compound_pendulum(2, measured(1, 0.01), 0.3)), "centre of mass")
})

test_that("the bicycle wheel: published 0.05264, 0.2329 and 0.0971 without the amplitude", {
  torsion <- read_motion(shared("data", "measured", "bicycle_wheel_torsional_gyro.csv"))
  stiffness <- pi * 0.00635^4 * 77e9 / (32 * 1.05)
  about_diameter <- inertia_torsion(torsion, stiffness)
  expect_equal(about_diameter$value, 0.05264, tolerance = 2e-4)
  hung <- read_motion(shared("data", "measured", "bicycle_wheel_compound_pendulum_gyro.csv"))
  joint <- inertia_compound_pendulum(hung, 1.55, 0.296, gravity_m_per_s2 = 9.81)
  expect_equal(round(joint$value, 4), 0.2323)
  expect_equal(round(joint$centre$value, 4), 0.0965)
  # Perpendicular axes: a flat wheel has half of it about a diameter; a tyre has more.
  expect_equal(about_diameter$value / (joint$centre$value / 2), 1.09, tolerance = 0.01)
})

test_that("records of a platform whose swings are wide and decay", {
  # theta'' of the platform by Lagrange's equation, with a viscous loss; Runge-Kutta of order 4.
  record_of <- function(amplitude, decay_per_s) {
    h <- function(theta) sqrt(0.6^2 - 0.07^2 - 2 * 0.12 * 0.05 * (1 - cos(theta)))
    rhs <- function(y) {
      h1 <- -0.12 * 0.05 * sin(y[1]) / h(y[1])
      h2 <- (-0.12 * 0.05 * cos(y[1]) - h1^2) / h(y[1])
      pull <- 0.9 * h1 * (9.80665 - h2 * y[2]^2)
      c(y[2], pull / (0.002 + 0.9 * h1^2) - 2 * decay_per_s * y[2])
    }
    y <- matrix(c(amplitude, 0), 2, 1001)
    for (i in 1:1000) {
      k1 <- rhs(y[, i])
      k2 <- rhs(y[, i] + 0.01 * k1)
      k3 <- rhs(y[, i] + 0.01 * k2)
      k4 <- rhs(y[, i] + 0.02 * k3)
      y[, i + 1] <- y[, i] + 0.02 / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    }
    noise <- 1e-4 * sin(1:1001 * 12.9898 + 1e4 * sin(1:1001))
    motion_record(data.frame(time_s = 0:1000 / 50, theta_rad = y[1, ] + noise))
  }
  # By a spring's fit with all losses they were 1.3 % too small, 4 % too small, 0.7 % too large.
  for (one in list(c(0.75, 0), c(1.4, 0), c(0.75, 0.03))) {
    got <- inertia_trifilar(record_of(one[1], one[2]), 0.9, 0.6, 0.12, 0.05)
    expect_equal(got$value / 0.002, 1, tolerance = 5e-5)
    expect_lt(abs(got$value - 0.002), 5 * got$u)
  }
})

test_that("a record of a platform at its amplitude", {
  t <- integrated_period(0.004, 0.9, 0.12, 0.05, 0.6, 0.5, 9.80665)
  time <- seq(0, 8, by = 0.02)
  r <- motion_record(
    data.frame(time, a = 0.5 * cos(2 * pi * time / t)), time_s = time, theta_rad = a
  )
  got <- inertia_trifilar(r, 0.9, 0.6, 0.12, 0.05)
  expect_equal(got$value / 0.004, 1, tolerance = 2e-3)
  expect_equal(got$amplitude_rad, 0.5, tolerance = 1e-3)
})

test_that("errors are the package's own", {
  expect_error(inertia_torsion(2), class = "rotdyn_error_missing")
  expect_error(inertia_torsion("a", 2), class = "rotdyn_error_type")
  expect_error(inertia_torsion(-2, 2), class = "rotdyn_error_value")
  expect_error(inertia_torsion(2, 2, 3), class = "rotdyn_error_argument")
  expect_error(inertia_compound_pendulum(0.2, 1, 0.3), class = "rotdyn_error_value")
  expect_error(inertia_trifilar(2, 1, upper_radius_m = 0.1, lower_radius_m = 0.1),
    class = "rotdyn_error_missing")
  expect_error(inertia_trifilar(2, 1, 0.5, 0.1, 0.1, height_m = 0.4),
    class = "rotdyn_error_argument")
  expect_error(inertia_trifilar(2, 1, 0.1, 0.3, 0.1), class = "rotdyn_error_value")
  expect_error(inertia_bifilar(2, 1, 0.2, 0.3, 0.3, amplitude_rad = 2),
    class = "rotdyn_error_value")
  x <- trajectory(scene_pendulum(body_rod_end(1, 1), theta0_rad = 1), seq(0, 9, by = 0.05))
  fit <- fit_swing(motion_record(x, time_s = time_s, theta_rad = theta_rad))
  expect_error(inertia_torsion(fit, 1), class = "rotdyn_error_value")
})

test_that("errors of a record are those of the function that was called", {
  flat <- motion_record(data.frame(time_s = 0:20 / 10, theta_rad = 0:20 / 100))
  calls <- list(
    function() inertia_compound_pendulum(flat, 1, 0.3), function() inertia_torsion(flat, 0.2),
    function() inertia_trifilar(flat, 1, 0.6, 0.1, 0.05)
  )
  names <- c("inertia_compound_pendulum", "inertia_torsion", "inertia_trifilar")
  for (i in 1:3) {
    error <- expect_error(calls[[i]](), class = "rotdyn_error_size")
    expect_equal(as.character(conditionCall(error)[[1]]), names[i])
  }
})

test_that("numbers typed in have the names of their arguments, and a print fits 80 columns", {
  i <- inertia_compound_pendulum(measured(1.3, 0.001), measured(0.29, 0.001), measured(0.4, 0.001))
  expect_setequal(i$contributions$input, c("period_s", "mass_kg", "distance_m"))
  period <- measured(1.3, 0.001)
  named <- inertia_torsion(measured(period$value, 0.001, name = "T"), measured(2, 0.01))
  expect_true("T" %in% named$contributions$input)
  expect_lte(max(nchar(capture.output(print(i)))), 80)
})

test_that("numbers beyond double precision name the function called", {
  for (call in expression(
    inertia_torsion(1e-200, 2), inertia_compound_pendulum(1e-200, 1, 1),
    inertia_bifilar(1e-200, 1, 1, 1, 1)
  )) {
    error <- rlang::catch_cnd(eval(call), "rotdyn_error")
    expect_s3_class(error, "rotdyn_error_value")
    expect_identical(rlang::call_name(error$call), rlang::call_name(call))
  }
})
