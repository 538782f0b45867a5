# ---- the closed form against the article and the 40-digit tables --------------------------------

test_that("the article's spin-up at its knots", {
  motion <- trajectory(article_scene(), c(1, 4, 6, 8))
  expect_ulps(
    motion$omega_rad_per_s,
    c(5.487966211452269604, 21.64884463601268780, 15.22057591984251148, 5.827850240151794541), 2
  )
  expect_ulps(
    motion$theta_rad,
    c(1.900070392807771658, 48.23157367497356707, 88.29046683366143441, 107.8586453330170947), 2
  )
})

test_that("phi functions hold to the goals over the whole range", {
  table <- read.csv(shared("refs", "phi.csv"))
  got <- .Call(rotdyn:::ffi_phi, table$z, 6)
  goal <- c(1, 3, 3, 3, 3, 4, 6) # k = 0..6
  for (k in 0:6) {
    want <- table[[k + 2]]
    normal <- want == 0 | (abs(want) >= 2.3e-308 & is.finite(want))
    up <- normal & table$z >= 0
    expect_lte(max(ulps(got[[k + 1]][up], want[up])), goal[k + 1])
    down <- normal & table$z < 0
    expect_lte(max(ulps(got[[k + 1]][down], want[down])), goal[k + 1] + 1.5)
  }
})

test_that("a linear segment holds to the goals: state, work, heat, impulse, bounds, audit", {
  table <- read.csv(shared("refs", "fixed_axis_linear.csv"))
  for (i in seq_len(nrow(table))) {
    row <- table[i, ]
    scene <- scene_axle(
      row$I, torque_knots(c(0, row$h), c(row$tau_start, row$tau_end)), resistance(row$c),
      omega0_rad_per_s = row$omega0
    )
    motion <- suppressWarnings(trajectory(scene, c(0, row$h)))
    info <- run_of(motion)$info
    audit <- audited(motion)
    got <- c(motion$theta_rad[2], motion$omega_rad_per_s[2], audit$work_j, audit$dissipated_j)
    want <- c(row$dtheta, row$omega1, row$work, row$dissipated)
    same_sign <- row$tau_start >= 0 && row$tau_end >= 0 && row$omega0 >= 0
    # Positive data: theta, omega and W within 6 ulp, D within 12. Of mixed signs the goal is
    # 5 eps of the largest term: the bounds below are of that kind, and hold in all rows.
    if (same_sign) expect_true(all(ulps(got, want) <= c(6, 6, 6, 12)), info = i)
    expect_true(abs(got[1] - want[1]) <= info$errors[["theta"]], info = i)
    expect_true(abs(got[2] - want[2]) <= info$errors[["omega"]], info = i)
    expect_ulps(audit$torque_impulse_n_m_s, row$impulse, 2)
    expect_equal(audit$verdict, "balanced", info = i)
    expect_true(abs(got[3] - want[3]) <= audit$energy_rounding_j, info = i)
    expect_true(abs(got[4] - want[4]) <= audit$energy_rounding_j, info = i)
  }
})

# ---- extremes -----------------------------------------------------------------------------------

test_that("no resistance, next to none, and 1e300 of it", {
  torque <- torque_knots(c(0, 2, 4), c(0, 3, 0))
  at <- function(c, I = 2, t = 3) {
    motion <- trajectory(scene_axle(I, torque, resistance(c), omega0_rad_per_s = 5), t)
    c(motion$theta_rad, motion$omega_rad_per_s)
  }
  # I = 2: omega(3) = 5 + (3 + 2.25)/2, theta(3) = 15 + [t^3/4]_0^2 ... by hand: 19.375.
  expect_ulps(at(0), c(15 + 1 + 1.5 + 0.625, 7.625), 2)
  expect_ulps(at(1e-20 * 2 / 3), at(0), 1)
  # Settled: omega = tau/c, theta = (integral of tau + I omega0)/c.
  expect_ulps(at(1e300), c((5.25 + 10) / 1e300, 1.5 / 1e300), 2)
})

test_that("inertia from 1e-300 to 1e300: the same motion, scaled", {
  unit <- trajectory(scene_axle(1, article_torque(), resistance(0.5)), (0:16) / 2)
  for (power in c(-990, -300, 300, 990)) {
    factor <- 2^power
    torque <- torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0) * factor)
    scaled <- trajectory(scene_axle(factor, torque, resistance(0.5 * factor)), (0:16) / 2)
    expect_ulps(scaled$omega_rad_per_s, unit$omega_rad_per_s, 3)
    expect_ulps(scaled$theta_rad, unit$theta_rad, 3)
  }
})

test_that("where the torque goes to zero, omega keeps its digits under heavy damping", {
  # tau falls linearly to 0 at t = 1: omega = (tau + I s/c)/c with slope -s, settled long since.
  for (ratio in c(1e6, 1e12, 3e28)) {
    inertia <- 2
    scene <- scene_axle(inertia, torque_knots(c(0, 1), c(3, 0)), resistance(ratio * inertia))
    t <- 1 - c(0.5, 2^-20, 2^-40, 0)
    want <- (3 * (1 - t) + 3 / ratio) / (ratio * inertia)
    expect_ulps(trajectory(scene, t)$omega_rad_per_s, want, 3)
  }
})

test_that("millions of rows come back", {
  skip_on_cran()
  n <- or_long(1e6, 1e7)
  motion <- trajectory(article_scene(), seq(0, 8, length.out = n))
  expect_equal(nrow(motion), n)
  expect_ulps(motion$theta_rad[n], 107.8586453330170947, 2)
})

# ---- even grids from a table -------------------------------------------------------------------

# A closed form as C runs it, without a choice.
run_axle <- function(id, scene, t, laws = NULL, progress = NULL, accuracy = 1e-9, flows = 0) {
  control <- c(accuracy, 1e6, 0, 0, flows, 0, 0)
  .Call(rotdyn:::ffi_scene_run, "axle", scene, id, t, control, laws, progress)
}

# The same closed form, row by row.
row_by_row <- function(scene, t) {
  rows <- lapply(t, function(t) run_axle("axle_linear", scene, t)[[1]])
  columns <- names(rows[[1]])
  sapply(columns, function(x) vapply(rows, `[[`, double(1), x), simplify = FALSE)
}

test_that("rows from a table agree with rows one by one, within 2e-15 and their bound", {
  set.seed(1)
  for (i in 1:60) {
    knots <- c(0, sort(runif(4, 0, 10)), 10)
    sign <- if (i %% 3) 1 else sample(c(-1, 1), 6, TRUE)
    scene <- scene_axle(
      10^runif(1, -3, 3), torque_knots(knots, runif(6) * sign), resistance(10^runif(1, -3, 3)),
      omega0_rad_per_s = if (i %% 2) runif(1) else 0, theta0_rad = runif(1)
    )
    t <- seq(0, 10, length.out = sample(c(40, 257, 1000, 3001), 1))
    fast <- trajectory(scene, t)
    exact <- row_by_row(scene, t)
    info <- run_of(fast)$info
    for (column in c("theta_rad", "omega_rad_per_s")) {
      error <- max(abs(fast[[column]] - exact[[column]]))
      expect_lte(error, 2e-15 * max(abs(exact[[column]])))
      expect_lte(error, info$errors[[sub("_rad.*", "", column)]])
    }
    expect_equal(fast$applied_torque_n_m, exact$applied_torque_n_m, tolerance = 1e-15)
    # Positive data keep their digits row by row.
    if (i %% 3) expect_ulps(fast$omega_rad_per_s[-1], exact$omega_rad_per_s[-1], 16)
  }
})

test_that("times that are nearly even, in parts even, or far from zero", {
  scene <- scene_axle(2, torque_knots(c(0, 2e6), c(1, 3)), resistance(0.7), omega0_rad_per_s = 5)
  for (t in list(
    seq(0, 10, length.out = 500) * (1 + 1e-7 * sin(1:500)), c((0:99) / 10, 10 + (1:300) / 1000),
    1e6 + seq(0, 8, length.out = 1000), c(0, rep(1, 50), 2:60), sort(c((0:200) / 20, (0:200) / 20))
  )) {
    t <- sort(t)
    fast <- trajectory(scene, t)
    exact <- row_by_row(scene, t)
    expect_lte(max(ulps(fast$omega_rad_per_s, exact$omega_rad_per_s)), 16)
    expect_lte(max(ulps(fast$theta_rad, exact$theta_rad)), 16)
  }
})

# ---- invariances --------------------------------------------------------------------------------

test_that("rows depend on which other rows are asked for by their rounding at most", {
  alone <- function(t) vapply(t, function(x) trajectory(article_scene(), x)$theta_rad, double(1))
  uneven <- sort(c(cumsum(0.2 + 0.1 * sin(1:40)), 1, 4, 6, 8))
  expect_identical(trajectory(article_scene(), uneven)$theta_rad, alone(uneven))
  even <- sort(c(seq(0, 9, length.out = 101), 1, 4, 6, 8))
  together <- trajectory(article_scene(), even)
  expect_ulps(together$theta_rad, alone(even), 4)
  expect_lte(max(abs(together$theta_rad - alone(even))), run_of(together)$info$errors[["theta"]])
})

test_that("a knot on the line changes nothing", {
  split <- torque_knots(c(0, 0.5, 1, 2, 4, 6, 8), c(0, 0.4, 0.8, 0.8, 0.8, 0, 0))
  scene <- scene_axle(body_disk(2, 0.25), split, resistance(0.03))
  expect_ulps(trajectory(scene, 0:8)$theta_rad, trajectory(article_scene(), 0:8)$theta_rad, 3)
})

test_that("backwards in time and forward again is where it was", {
  scene <- article_scene(omega0_rad_per_s = 3, theta0_rad = 2)
  early <- trajectory(scene, -2)
  again <- article_scene(
    omega0_rad_per_s = early$omega_rad_per_s, theta0_rad = early$theta_rad, start_s = -2
  )
  rows <- trajectory(again, c(0, 5))
  expect_equal(rows$theta_rad, trajectory(scene, c(0, 5))$theta_rad, tolerance = 1e-14)
  expect_equal(rows$omega_rad_per_s, trajectory(scene, c(0, 5))$omega_rad_per_s, tolerance = 1e-14)
})

test_that("the state is that of start_s, wherever the rows begin", {
  late <- trajectory(article_scene(start_s = 3, omega0_rad_per_s = 7), c(3, 5))
  expect_equal(late$omega_rad_per_s[1], 7)
  alone <- trajectory(article_scene(start_s = 3, omega0_rad_per_s = 7), 5)
  expect_equal(alone$theta_rad, late$theta_rad[2])
})

test_that("signs: torque, rate and angle turned round together", {
  mirrored <- scene_axle(
    body_disk(2, 0.25), torque_knots(c(0, 1, 4, 6, 8), -c(0, 0.8, 0.8, 0, 0)), resistance(0.03)
  )
  expect_identical(trajectory(mirrored, 0:8)$theta_rad, -trajectory(article_scene(), 0:8)$theta_rad)
})

test_that("a driven body grows, and beyond double precision it is an error", {
  scene <- scene_axle(2, 0, resistance(-4), omega0_rad_per_s = 3)
  expect_equal(trajectory(scene, 5)$omega_rad_per_s, 3 * exp(10), tolerance = 1e-14)
  expect_error(trajectory(scene, 1000), class = "rotdyn_error_range")
  expect_warning(
    rows <- trajectory(scene, c(1, 10, 1000), on_fail = "truncate"),
    class = "rotdyn_warning_truncated"
  )
  expect_equal(rows$time_s, c(1, 10))
})

# ---- the derived columns ------------------------------------------------------------------------

test_that("columns follow from the state: signs and factors", {
  motion <- trajectory(article_scene(omega0_rad_per_s = 2), c(0.5, 2, 5, 7))
  expect_equal(names(motion), rotdyn:::trajectory_columns)
  omega <- motion$omega_rad_per_s
  expect_equal(motion$applied_torque_n_m, c(0.4, 0.8, 0.4, 0))
  expect_equal(motion$damping_torque_n_m, -0.03 * omega)
  expect_equal(motion$net_torque_n_m, motion$applied_torque_n_m - 0.03 * omega)
  expect_equal(motion$angular_momentum_kg_m2_per_s, 0.0625 * omega)
  expect_equal(motion$rotational_kinetic_energy_j, 0.03125 * omega^2)
})

test_that("free spin turns at a constant rate", {
  motion <- trajectory(scene_axle(2, omega0_rad_per_s = 3, theta0_rad = 5, start_s = 1), c(0, 1, 4))
  expect_equal(motion$theta_rad, c(2, 5, 14))
  expect_equal(motion$omega_rad_per_s, c(3, 3, 3))
  expect_equal(motion$rotational_kinetic_energy_j, c(9, 9, 9))
  expect_equal(run_of(motion)$model, "axle_free")
})

# ---- pulses and textbook cases ------------------------------------------------------------------

test_that("a pulse of 40 N m for 0.02 s is not stepped over", {
  disk <- body_disk(2, 0.25)
  short <- torque_knots(c(50, 50.02), c(40, 40))
  long <- torque_knots(c(0, 50, 50, 50.02, 50.02, 100), c(0, 0, 40, 40, 0, 0))
  for (torque in list(short, long)) {
    for (model in c("axle_linear", "axle_rk8pd")) {
      motion <- trajectory(scene_axle(disk, torque), c(0, 100), model = model)
      expect_equal(motion$omega_rad_per_s[2], 40 * (50.02 - 50) / 0.0625, tolerance = 1e-12)
    }
  }
})

test_that("textbook: 100 kg m^2 from 500 rpm to rest in 2 min takes -43.6 N m", {
  # University Physics 1, section 10.7 (OpenStax); the torque computed to ten digits.
  omega0 <- 500 * 2 * pi / 60
  motion <- trajectory(scene_axle(100, -43.6332313, omega0_rad_per_s = omega0), 120)
  expect_equal(motion$omega_rad_per_s, 0, tolerance = 1e-6)
  expect_equal(motion$theta_rad, omega0 * 120 / 2, tolerance = 1e-8)
})

test_that("viscous coasting: omega is linear in theta", {
  scene <- scene_axle(2, resistance = resistance(0.3), omega0_rad_per_s = 7)
  motion <- trajectory(scene, 0:30)
  expect_equal(motion$omega_rad_per_s, 7 - 0.15 * motion$theta_rad, tolerance = 1e-14)
})

# ---- the integrator -----------------------------------------------------------------------------

test_that("integrated and exact agree within the estimate", {
  exact <- trajectory(article_scene(), (0:40) / 5)
  for (accuracy in c(1e-4, 1e-7, 1e-10, 1e-12)) {
    motion <- trajectory(article_scene(), (0:40) / 5, accuracy, model = "axle_rk8pd")
    expect_lte(run_of(motion)$info$error, accuracy)
    error <- max(abs(motion$omega_rad_per_s - exact$omega_rad_per_s)) / max(exact$omega_rad_per_s)
    expect_lte(error, run_of(motion)$info$error + 2e-15)
  }
})

test_that("a torque function gives what the same torque as knots gives", {
  told <- torque_function(approxfun(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)), c(1, 4, 6))
  scene <- scene_axle(body_disk(2, 0.25), told, resistance(0.03))
  motion <- trajectory(scene, 0:8)
  exact <- trajectory(article_scene(), 0:8)
  expect_equal(motion$theta_rad, exact$theta_rad, tolerance = 1e-12)
  expect_equal(motion$applied_torque_n_m, exact$applied_torque_n_m)
  expect_equal(audited(motion)$work_j, audited(exact)$work_j, tolerance = 1e-12)
})

test_that("a torque of angle and rate: a torsional oscillator", {
  # I = 2, k = 18, c = 0 in the scene: omega_n = 3; theta = cos 3t.
  spring <- torque_function(function(time_s, theta_rad, omega_rad_per_s) -18 * theta_rad, numeric())
  t <- seq(0, 20, by = 0.5)
  motion <- trajectory(scene_axle(2, spring, theta0_rad = 1), t)
  error <- max(abs(motion$theta_rad - cos(3 * t)))
  expect_lte(error, 1e-9)
  expect_lte(error, run_of(motion)$info$errors[["theta"]] * 1.1)
  expect_equal(audited(motion)$verdict, "balanced")
})

test_that("the estimate covers the error where dense rows set the steps, and where none does", {
  # A damped oscillator: theta = exp(-g t)(cos wt + g/w sin wt).
  spring <- torque_function(function(time_s, theta_rad, omega_rad_per_s) -4 * theta_rad, numeric())
  scene <- scene_axle(body_disk(2, 0.25), spring, resistance(0.01), theta0_rad = 0.2)
  g <- 0.01 / 0.0625 / 2
  w <- sqrt(64 - g^2)
  exact <- function(t) 0.2 * exp(-g * t) * (cos(w * t) + g / w * sin(w * t))
  for (accuracy in c(1e-3, 1e-6, 1e-9, 1e-12)) {
    for (step in c(0.005, 0.02, 0.05, 0.1, 1, 10)) {
      t <- seq(step, 10, by = step)
      motion <- trajectory(scene, t, accuracy)
      info <- run_of(motion)$info
      error <- max(abs(motion$theta_rad - exact(t)))
      expect_lte(error, info$errors[["theta"]])
      expect_lte(info$error, accuracy)
      balance <- suppressWarnings(audited(motion), "rotdyn_warning_time") # of one time
      expect_equal(balance$verdict, "balanced")
    }
  }
})

test_that("two loose runs that part do not bear each other out", {
  # A driven pendulum that turns over six times. At 56 s by Taylor series of order 30 in 1400 steps
  # with 40 digits, in Python's mpmath.
  scene <- scene_axle(
    1, torque_gravity(2.8186, 1, gravity_m_per_s2 = 1) + torque_sinusoid(2.5207, 0.7967),
    resistance(0.1206), theta0_rad = 1.2737
  )
  for (accuracy in c(0.01, 0.02, 0.03, 0.05)) {
    motion <- trajectory(scene, c(0, 56), accuracy)
    error <- run_of(motion)$info$errors
    expect_lte(abs(motion$theta_rad[2] - 3.8160621908253433), error[["theta"]])
    expect_lte(abs(motion$omega_rad_per_s[2] - 5.1313636262140188), error[["omega"]])
  }
})

test_that("the integrator agrees with another one", {
  skip_if_not_installed("deSolve")
  torque <- function(t) sin(3 * t) + 0.2 * t
  t <- seq(0, 10, by = 0.25)
  motion <- trajectory(scene_axle(0.7, torque_function(torque, numeric()), resistance(0.4)), t)
  other <- deSolve::ode(
    c(0, 0), t, function(t, y, p) list(c(y[2], (torque(t) - 0.4 * y[2]) / 0.7)), NULL,
    rtol = 1e-12, atol = 1e-13
  )
  expect_equal(motion$theta_rad, unname(other[, 2]), tolerance = 1e-10)
  expect_equal(motion$omega_rad_per_s, unname(other[, 3]), tolerance = 1e-10)
})

test_that("a motion that grows by e^50 keeps its relative accuracy from the first row on", {
  scene <- scene_axle(2, resistance = resistance(-1), omega0_rad_per_s = 3)
  motion <- trajectory(scene, c(0.1, 1, 10, 100), model = "axle_rk8pd")
  expect_equal(motion$omega_rad_per_s / (3 * exp(c(0.05, 0.5, 5, 50))), rep(1, 4), tolerance = 1e-8)
})

test_that("integrating backwards", {
  scene <- scene_axle(2, torque_function(cos, numeric()), resistance(0.3), omega0_rad_per_s = 1)
  exact <- function(t) { # I w' = cos t - c w
    a <- 0.15
    particular <- function(t) (a * cos(t) + sin(t)) / (2 * (a^2 + 1))
    particular(t) + (1 - particular(0)) * exp(-a * t)
  }
  motion <- trajectory(scene, c(-3, -1, 0, 2))
  expect_equal(motion$omega_rad_per_s, exact(c(-3, -1, 0, 2)), tolerance = 1e-9)
})

# ---- the boundary: whatever a torque function raises arrives as itself --------------------------

with_torque <- function(f, ..., n = 20) {
  trajectory(scene_axle(0.5, torque_function(f, breaks_s = numeric())), (0:n) / 4, ...)
}

test_that("an R error arrives with its message and call", {
  break_at_2 <- function(t) if (t > 2) stop("the bearing broke") else 1
  error <- tryCatch(with_torque(break_at_2), error = identity)
  expect_s3_class(error, "simpleError")
  expect_match(conditionMessage(error), "the bearing broke")
})

test_that("a classed condition arrives with its class and fields", {
  broken <- structure(
    class = c("bearing_broken", "error", "condition"),
    list(message = "broken", call = NULL, at = 2)
  )
  error <- tryCatch(with_torque(function(t) stop(broken)), bearing_broken = identity)
  expect_equal(error$at, 2)
  # Conditions that do not jump do not disturb.
  seen <- 0
  motion <- withCallingHandlers(
    with_torque(function(t) {
      warning("loud")
      1
    }),
    warning = function(w) {
      seen <<- seen + 1
      invokeRestart("muffleWarning")
    }
  )
  expect_gt(seen, 20)
  expect_equal(motion$omega_rad_per_s[21], 10)
})

test_that("an interrupt arrives as an interrupt", {
  skip_on_os("windows")
  skip_on_cran()
  calls <- 0
  result <- tryCatch(
    with_torque(function(t, theta, omega) {
      stopifnot(length(t) == 1L) # called for one time each
      calls <<- calls + 1
      if (calls == 50) tools::pskill(Sys.getpid(), tools::SIGINT)
      Sys.sleep(0.001)
      sin(9 * t) - theta
    }, n = 4000),
    interrupt = function(i) "interrupted"
  )
  expect_equal(result, "interrupted")
  expect_lt(calls, 4000)
})

test_that("a time limit arrives as a time limit", {
  skip_on_cran()
  on.exit(setTimeLimit())
  error <- tryCatch(
    {
      setTimeLimit(elapsed = 0.3, transient = TRUE)
      with_torque(function(t, theta, omega) {
        stopifnot(length(t) == 1L)
        Sys.sleep(0.002)
        sin(9 * t) - theta
      }, n = 40000)
    },
    error = identity
  )
  setTimeLimit()
  expect_match(conditionMessage(error), "time limit")
})

test_that("a jump out of the torque function leaves", {
  left <- (function() {
    with_torque(function(t) return_now())
    "not here"
  })
  expect_error(left(), "return_now")
  value <- callCC(function(out) with_torque(function(t) if (t > 1) out("out") else 1))
  expect_equal(value, "out")
  expect_equal(with_torque(function(t) 1)$omega_rad_per_s[21], 10) # and all is well after
})

test_that("a trajectory inside a torque function", {
  inner <- function(t) trajectory(scene_axle(2, 1), t)$omega_rad_per_s
  motion <- with_torque(inner, n = 8)
  expect_equal(motion$omega_rad_per_s[9], 2, tolerance = 1e-12) # int_0^2 t/2 dt / 0.5
})

test_that("what is not one number is an error that says when and what", {
  in_kn <- structure(1, class = "units") # a unit that would be ignored is no number
  for (bad in list(NULL, c(1, 2), "x", list(1), TRUE, factor(1), numeric(), mean, in_kn)) {
    error <- expect_error(with_torque(function(t) bad), class = "rotdyn_error_torque")
    expect_match(conditionMessage(error), "one number in N m")
    expect_error(trajectory(scene_axle(1, function(t) bad), 0:1), class = "rotdyn_error_torque")
  }
})

test_that("a torque that is not finite ends the run where it begins", {
  for (bad in list(NA, NA_real_, NaN, Inf, NA_integer_)) {
    f <- function(t) if (t > 2) bad else 1
    error <- expect_error(with_torque(f), class = "rotdyn_error_torque")
    expect_equal(error$info$time_s, 2, tolerance = 1e-6)
    expect_warning(rows <- with_torque(f, on_fail = "truncate"), class = "rotdyn_warning_truncated")
    expect_equal(rows$time_s, (0:8) / 4)
    expect_equal(rows$omega_rad_per_s, rows$time_s * 2)
  }
})

test_that("numbers given to the torque function are its own to keep", {
  kept <- list()
  with_torque(function(t) {
    kept[[length(kept) + 1L]] <<- t
    1
  }, n = 2)
  expect_gt(length(unique(unlist(kept))), 10)
})

test_that("the step budget", {
  fast <- function(t) sin(1e4 * t)
  error <- expect_error(with_torque(fast, max_steps = 50), class = "rotdyn_error_budget")
  expect_gt(error$info$time_s, 0)
  expect_warning(
    rows <- with_torque(fast, max_steps = 1000, on_fail = "truncate"),
    class = "rotdyn_warning_truncated"
  )
  expect_lt(nrow(rows), 21)
})

test_that("a run is a named list, with its measures by name", {
  scene <- scene_axle(2, 3, resistance(coulomb_n_m = 1), omega0_rad_per_s = -4)
  run <- run_axle("axle_drag", scene, c(0, 8))
  expect_named(run, c("columns", "info", "ledger", "events", "event_rows"))
  expect_named(run$columns, rotdyn:::trajectory_columns)
  expect_named(run$info, c(
    "kind", "text", "time_s", "rows_done", "steps", "rejected", "rhs_calls", "error", "tolerance",
    "method", "errors", "sizes"
  ))
  expect_named(run$info$errors, c("theta", "omega"))
  # -4 rad/s braked at 2 rad/s^2, then 1 rad/s^2 for 6 s.
  expect_equal(run$info$sizes, c(theta = 14, omega = 6))
  expect_equal(run$events, list(time_s = 2, event = "reverse"))
  expect_equal(
    run$info$error, .Call(rotdyn:::ffi_error_figure, run$info$errors, run$info$sizes)
  )
  expect_null(run_axle("axle_free", scene_axle(1), 1)$events)
  ledger <- run_axle("axle_linear", scene_axle(1, 2), c(0, 1), flows = 1)$ledger
  expect_equal(diff(ledger[, "work_j"]), 2)
  expect_error(.Call(rotdyn:::ffi_error_figure, c(1, 2), 1), "internal")
})

test_that("a wrong .Call is an R error", {
  expect_error(run_axle("axle_none", scene_axle(1), 1), "internal")
  expect_error(run_axle(1, scene_axle(1), 1), "internal")
  expect_error(run_axle("axle_free", scene_axle(1), 1L), "internal")
  expect_error(.Call(rotdyn:::ffi_phi, "a", 1), "internal")
  expect_error(.Call(rotdyn:::ffi_phi, 1, 99), "internal")
  expect_error(.Call(rotdyn:::ffi_rolling_table, c(1, 2), c(1, 2, 3), 1, 1, NULL), "internal")
})

test_that("a damaged scene is an R error", {
  broken <- list(NULL, "a", 1L, double(), c(1, 2, 3, 4, 5), list(1), environment())
  damage <- function(scene, path, run) {
    for (value in broken) {
      # Not given: the default.
      if (is.null(value) && (length(path) == 1L || path[1] == "resistance")) next
      bad <- unclass(scene)
      bad[[path]] <- value
      expect_error(run(bad), "internal", info = paste(path, collapse = " "))
    }
    expect_type(run(scene), "list")
  }
  axle <- scene_axle(
    inertia_knots(c(0, 1), c(1, 2)), torque_knots(0:2, c(0, 1, 0)) + torque_spring(1),
    resistance(0.1)
  )
  run <- function(scene) run_axle("axle_oscillator", scene, 1)
  for (path in list(
    "start_s", "theta0_rad", "omega0_rad_per_s", c("resistance", "viscous_n_m_s"),
    c("resistance", "quadratic_n_m_s2"), c("resistance", "coulomb_n_m"),
    c("resistance", "static_n_m"), c("body", "time_s"), c("body", "moment_of_inertia_kg_m2")
  )) {
    damage(axle, path, run)
  }
  for (path in c("kind", "from_s", "to_s", "x")) {
    bad <- axle
    for (value in broken) {
      bad$torque$laws[[2]][[path]] <- value
      expect_error(run(bad), "internal", info = path)
    }
  }
  control <- c(1e-9, 1e4, 0, 0, 0, 0, 0)
  run_by_table <- function(scene) {
    id <- sub("rot_scene_", "", class(scene)[1])
    function(scene) {
      model <- c(rotors = "rotors_modal", clutch = "clutch_exact")[[id]]
      .Call(rotdyn:::ffi_scene_run, id, scene, model, 1, control, list(), NULL)
    }
  }
  rotors <- scene_rotors(c(1, 2), 1000, 0.5)
  for (path in c("bodies", "stiffness_n_m_per_rad")) damage(rotors, path, run_by_table(rotors))
  clutch <- scene_clutch(1, 2, 3, omega0_rad_per_s = c(10, 0))
  for (path in c("body_1", "body_2", "capacity_n_m")) damage(clutch, path, run_by_table(clutch))
})

test_that("routines are registered, and nothing else is found", {
  routines <- getDLLRegisteredRoutines("rotdyn")$.Call
  expect_true(all(startsWith(names(routines), "ffi_")))
  expect_false(is.loaded("rot_axle_linear", PACKAGE = "rotdyn"))
})

test_that("the progress function is called, no more than 20 times a second", {
  skip_on_cran()
  told <- double()
  law <- list(
    quote(f(NULL)), list2env(list(f = function(t) {
      Sys.sleep(0.002)
      sin(9 * t)
    }), parent = baseenv()),
    stop
  )
  start <- proc.time()[[3]]
  run_axle(
    "axle_rk8pd", scene_axle(1, function(t) 0), c(0, 1, 2), list(torque = list(law)),
    function(fraction) told <<- c(told, fraction)
  )
  elapsed <- proc.time()[[3]] - start
  expect_gt(length(told), 1)
  expect_lte(length(told), 20 * elapsed + 1)
  expect_true(all(told >= 0 & told <= 1))
})

test_that("a stiff integration shows the transient that it starts with", {
  # Rows within 1e-14 s of the start, with c/I up to 1e12, against the closed form.
  t <- sort(c(10^seq(-14, 1, by = 0.25), seq(0, 10, by = 0.5)))
  for (c in 10^c(4, 8, 12)) {
    scene <- scene_axle(1, torque_sinusoid(c, 1), resistance(c), 0, 5)
    exact <- trajectory(scene, t)
    stiff <- trajectory(scene, t, model = "axle_radau")
    info <- run_of(stiff)$info
    expect_lte(max(abs(stiff$omega_rad_per_s - exact$omega_rad_per_s)), info$errors[["omega"]])
    expect_lte(max(abs(stiff$theta_rad - exact$theta_rad)), info$errors[["theta"]])
    expect_lte(info$error, 1e-9)
  }
  # omega is gone long before the first row.
  gone <- trajectory(
    scene_axle(2e5, NULL, resistance(4.5e40), 1, 352), c(1e-12, 1),
    model = "axle_radau", accuracy = 1e-8
  )
  expect_equal(gone$omega_rad_per_s, c(0, 0))
})

test_that("the error of the integrator covers the kinks of a torque curve", {
  set.seed(4)
  missed <- 0
  for (i in 1:60) {
    knots <- sample(3:6, 1)
    scene <- scene_axle(
      runif(1, 0.2, 2),
      torque_curve(sort(runif(knots, 0, 30)), sort(runif(knots, 0, 5), decreasing = TRUE)),
      resistance(viscous_n_m_s = runif(1, 0, 0.1), quadratic_n_m_s2 = runif(1, 0, 0.01))
    )
    time_s <- seq(0, 10, length.out = 20)
    rough <- trajectory(scene, time_s, accuracy = 1e-9, model = "axle_rk8pd")
    # The kinks keep 1e-13 from being reached; what is reached is far better than 1e-9.
    fine <- suppressWarnings(trajectory(scene, time_s, accuracy = 1e-13, model = "axle_rk8pd"))
    off <- max(abs(rough$omega_rad_per_s - fine$omega_rad_per_s)) / max(fine$omega_rad_per_s)
    missed <- missed + (off > summary(rough)$error)
  }
  expect_lte(missed, 3)
})

test_that("Radau's impulses go with its states, from stop to stop", {
  scene <- scene_axle(
    1, torque_sinusoid(2, 2), resistance(viscous_n_m_s = 0.05, coulomb_n_m = 0.8),
    omega0_rad_per_s = 1
  )
  run <- trajectory(scene, seq(0, 6, by = 0.1), accuracy = 1e-8, model = "axle_radau")
  balance <- audited(run)
  expect_lt(abs(balance$momentum_residual_kg_m2_per_s), 1e-13)
  expect_equal(balance$verdict, "balanced")
})

test_that("the same call gives the same bits, wherever its columns come to lie", {
  scene <- article_scene()
  time_s <- seq(0, 8, by = 0.01)
  kept <- list()
  runs <- lapply(1:20, function(i) {
    # Vectors of odd lengths move what is allocated next.
    kept[[i]] <<- numeric(1000 + i)
    motion <- trajectory(scene, time_s)
    c(motion$theta_rad, motion$omega_rad_per_s, audited(motion)$momentum_residual_kg_m2_per_s)
  })
  for (run in runs[-1]) expect_identical(run, runs[[1]])
})

test_that("a start from rest is no event, whichever model runs", {
  brake <- resistance(coulomb_n_m = 2)
  events <- function(torque, model) {
    as.list(motion_events(trajectory(scene_axle(1, torque, brake), 0:10, model = model)))
  }
  for (model in c("axle_drag", "axle_rk8pd")) {
    none <- list(time_s = numeric(), event = character())
    expect_identical(events(torque_constant(1), model), none)
    expect_identical(events(torque_constant(3), model), none)
  }
  for (model in list(NULL, "axle_rk8pd")) {
    later <- events(torque_knots(c(0, 10), c(0, 10)), model)
    expect_equal(later, list(time_s = 2, event = "slip"))
  }
})

# References: mpmath, 60 digits, of the doubles given.
test_that("a pendulum keeps the digits of products of its numbers over a long time", {
  covered <- function(x, theta, omega) {
    info <- run_of(x)$info
    expect_lte(abs(x$theta_rad - theta), info$errors[["theta"]])
    expect_lte(abs(x$omega_rad_per_s - omega), info$errors[["omega"]])
    expect_lte(info$error, 1e-14)
  }
  law <- torque_gravity(0.3, 0.7)
  covered(trajectory(scene_axle(1, law, theta0_rad = 1), 1e8),
          0.78305838919908771639, -0.83297031596623563464)
  # A product is of the same constructor, by the rounded product of gravity.
  covered(trajectory(scene_axle(1, 0.9 * law, theta0_rad = 1), 1e8),
          0.44457557992886646516, 1.1591905601115219363)
  covered(trajectory(scene_pendulum(body_point(0.3), 0.7, theta0_rad = 1), 1e8),
          0.97233509366284915466, 0.80398030638076660787)
})

test_that("the torque of gravity keeps its digits after many turns", {
  scene <- scene_axle(1, torque_gravity(0.3, 0.7), omega0_rad_per_s = 50)
  x <- trajectory(scene, 1e7)
  # By energy: omega^2/2 - G cos(theta) is kept, so |sin| follows from omega.
  g <- 0.3 * 0.7 * 9.80665
  cosine <- 1 + (x$omega_rad_per_s - 50) * (x$omega_rad_per_s + 50) / (2 * g)
  expect_equal(abs(x$applied_torque_n_m), g * sqrt(1 - cosine^2), tolerance = 1e-9)
})

test_that("a step budget beyond integers is no budget of 0", {
  law <- torque_function(function(time_s, theta_rad, omega_rad_per_s) -theta_rad, numeric())
  motion <- trajectory(scene_axle(1, law, theta0_rad = 1), c(0, 5), max_steps = 1e20)
  expect_equal(motion$theta_rad[2], cos(5), tolerance = 1e-8)
})

test_that("a held body breaks loose at the first chance, not at a later one", {
  torque <- torque_sinusoid(5.571808, 4.475096, phase_rad = 2.414795)
  scene <- scene_axle(
    2.590008, torque, resistance(viscous_n_m_s = 0.05169305, coulomb_n_m = 5.211664),
    omega0_rad_per_s = 2.344284
  )
  # The torque reaches the friction from below, backward, before its trough at a phase of 3 pi.
  loose <- (3 * pi - acos(5.211664 / 5.571808) - 2.414795) / 4.475096
  for (accuracy in c(1e-4, 1e-8, 1e-11)) {
    for (model in c("axle_rk8pd", "axle_radau")) {
      events <- motion_events(trajectory(scene, c(0, 5, 10, 20), accuracy, model))
      expect_identical(events$event[1:3], c("stick", "slip", "stick"))
      expect_equal(events$time_s[2], loose, tolerance = 1e-13)
      expect_identical(nrow(events), 55L) # each half wave of the torque
    }
  }
})

# By extrapolated midpoint steps in quadruple precision. Starts that differ by 1e-16 are
# 1e-2 apart after 200 s.
test_that("the error of a chaotic pendulum is that of the growth, and it is said", {
  scene <- scene_axle(
    1, torque_gravity(1, 1, gravity_m_per_s2 = 1) + torque_sinusoid(1.5, 2 / 3), resistance(0.5),
    theta0_rad = 0.2
  )
  time_s <- c(50, 100, 150, 200)
  theta <- c(
    -28.27830237669608655, -45.94647587703181014, -47.15344007121573714, -54.92523489351971654
  )
  for (accuracy in c(1e-6, 1e-9, 1e-12)) {
    for (n in 1:4) {
      motion <- suppressWarnings(trajectory(scene, time_s[1:n], accuracy))
      error <- attr(motion, "run")$info$errors[["theta"]]
      expect_lte(max(abs(motion$theta_rad - theta[1:n])), 3 * error)
    }
  }
  expect_warning(trajectory(scene, 200, 1e-12), class = "rotdyn_warning_accuracy")
})

test_that("an angle beyond double precision is an error, where the rate is not", {
  slows <- scene_axle(1, NULL, resistance(coulomb_n_m = 1e-10), omega0_rad_per_s = 1e200)
  expect_error(trajectory(slows, c(0, 1e150)), class = "rotdyn_error_range")
})
