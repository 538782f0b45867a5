# The 40-digit tables through the front door: what a user types, against numbers from elsewhere.
reference <- function(name) utils::read.csv(shared(paste0("refs/", name)), colClasses = "character")
number <- function(x) as.numeric(x)

# Error of a row relative to the largest value on the way, and whether the run's bound covers it.
expect_row <- function(motion, theta, omega) {
  info <- run_of(motion)$info
  eps <- .Machine$double.eps / 2
  expect_lte(abs(motion$theta_rad - theta), info$errors[["theta"]] + eps * abs(theta))
  expect_lte(abs(motion$omega_rad_per_s - omega), info$errors[["omega"]] + eps * abs(omega))
}

test_that("sinusoidal torque", {
  table <- reference("fixed_axis_sinus.csv")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], number)
    scene <- scene_axle(
      r$I, torque_sinusoid(r$A, r$Omega, r$phase), resistance(r$c), 0, r$omega0
    )
    expect_row(trajectory(scene, r$t, 1e-13), r$dtheta, r$omega)
  }
})

test_that("exponential torque", {
  table <- reference("fixed_axis_expon.csv")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], number)
    scene <- scene_axle(r$I, torque_exponential(r$A, r$lambda), resistance(r$c), 0, r$omega0)
    expect_row(trajectory(scene, r$t, 1e-13), r$dtheta, r$omega)
  }
})

test_that("linear torque", {
  table <- reference("fixed_axis_linear.csv")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], number)
    scene <- scene_axle(
      r$I, torque_knots(c(0, r$h), c(r$tau_start, r$tau_end)), resistance(r$c), 0, r$omega0
    )
    motion <- suppressWarnings(trajectory(scene, r$h, 1e-13))
    expect_row(motion, r$dtheta, r$omega1)
  }
})

test_that("quadratic drag", {
  table <- reference("quad_drag.csv")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], number)
    scene <- scene_axle(1, r$a, resistance(r$b, r$k), 0, r$omega0)
    expect_row(trajectory(scene, r$t, 1e-11), r$dtheta, r$omega)
    if (r$a < 0) { # the same deceleration as dry friction: it stays at rest
      dry <- scene_axle(1, 0, resistance(r$b, r$k, -r$a), 0, r$omega0)
      expect_ulps(stopping(dry)$stop_time_s, r$t_stop, 4)
    }
  }
})

test_that("a moment of inertia that changes", {
  table <- reference("variable_inertia.csv")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], number)
    scene <- scene_axle(
      inertia_knots(c(0, r$t), c(r$I0, r$I1)), r$tau,
      omega0_rad_per_s = r$L0 / r$I0
    )
    motion <- trajectory(scene, r$t, 1e-12)
    # L0/I0 is rounded once on the way in.
    eps <- .Machine$double.eps
    expect_lte(abs(motion$theta_rad - r$dtheta),
      run_of(motion)$info$errors[["theta"]] + eps * abs(r$L0 / r$I0 * r$t))
    expect_lte(abs(motion$omega_rad_per_s - r$omega1),
      run_of(motion)$info$errors[["omega"]] + eps * abs(r$L0 / r$I1))
  }
})

test_that("coupled rotors", {
  table <- reference("coupled_rotors.csv")
  split <- function(x) as.numeric(strsplit(x, ";")[[1]])
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], split)
    scene <- scene_rotors(r$J, r$k, r$c, omega0_rad_per_s = r$omega0)
    motion <- suppressWarnings(trajectory(scene, r$t, 1e-9, model = "rotors_modal"))
    info <- attr(motion, "run")$info
    expect_lte(max(abs(motion$theta_rad - r$dtheta)), info$errors[["theta"]])
    expect_lte(max(abs(motion$omega_rad_per_s - r$omega)), info$errors[["omega"]])
    expect_lte(max(abs(motion$omega_rad_per_s - r$omega)), 1e-11)
  }
})

test_that("the Modelica library's pendulum and its wheel with drag", {
  rows <- utils::read.csv(shared("cases/modelica_damped_pendulum/reference.csv"))
  # (I + m r^2) phi'' = -d phi' - m g r cos(phi), phi from the horizontal.
  scene <- scene_axle(
    0.001 + 1 * 0.5^2, torque_gravity(1, 0.5, rest_rad = -pi / 2), resistance(0.1)
  )
  motion <- trajectory(scene, rows$time)
  expect_lte(max(abs(motion$theta_rad - rows$rev.phi)), 6e-6)
  expect_lte(max(abs(motion$omega_rad_per_s - rows$rev.w)), 3e-5)

  rows <- utils::read.csv(shared("cases/modelica_torque_step_quadratic_drag/reference.csv"))
  wheel <- scene_axle(1 + 1, torque_steps(0.1, 10), resistance(quadratic_n_m_s2 = 0.4))
  motion <- trajectory(wheel, rows$time)
  expect_lte(max(abs(motion$theta_rad - rows$inertia.phi)), 1e-5)
  expect_lte(max(abs(motion$omega_rad_per_s - rows$inertia.w)), 5e-6)
  exact <- 5 * tanh(pmax(rows$time - 0.1, 0))
  expect_lte(max(abs(motion$omega_rad_per_s - exact)), 5e-15)
})
