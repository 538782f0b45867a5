reader <- function(f, ..., scene = scene_axle(1)) {
  rotdyn:::law_reader(torque_function(f, ...), scene, rlang::current_env())
}
sample <- function(f, span = c(0, 8), breaks = double(), accuracy = 1e-9) {
  reader <- reader(f)
  sampled <- rotdyn:::sample_torque(reader, span, breaks, accuracy)
  if (!is.null(sampled)) sampled$calls <- reader$calls()
  sampled
}

# Chebyshev pieces at some times, by the cosine form.
value <- function(sampled, t) {
  x <- sampled$terms[[1]]$x
  n <- x[1]
  m <- x[2]
  breaks <- x[3:(3 + n)]
  a <- matrix(x[-seq_len(3 + n)], n, m, byrow = TRUE)
  i <- findInterval(t, breaks, rightmost.closed = TRUE)
  u <- ((t - breaks[i]) - (breaks[i + 1] - t)) / (breaks[i + 1] - breaks[i])
  rowSums(a[i, , drop = FALSE] * cos(outer(acos(pmin(1, pmax(-1, u))), 0:(m - 1))))
}

test_that("smooth laws take few samples, and the error stated holds", {
  t <- seq(0, 8, length.out = 1001)
  laws <- list(
    function(t) sin(3 * t), function(t) 0.8 * exp(-t) * t^2, function(t) 1 / (1 + t^2),
    function(t) exp(-((t - 5) / 0.01)^2), function(t) 0.3, function(t) abs(t - 2)
  )
  for (f in laws) {
    for (accuracy in c(1e-3, 1e-9, 1e-13)) {
      sampled <- sample(f, accuracy = accuracy)
      exact <- rep_len(f(t), length(t))
      expect_lte(max(abs(value(sampled, t) - exact)), sampled$error)
      expect_lte(sampled$error, max(abs(exact)) * max(accuracy, 1e-13))
    }
  }
  expect_lt(sample(sin)$calls, 200)
})

test_that("a change that begins between the last sample of a piece and its end is seen", {
  t <- seq(0.49, 0.55, length.out = 1001)
  for (begins in 0.5 - c(2e-4, 5e-5)) { # the last of 33 samples before 0.5 is at 0.49972
    f <- function(t) {
      s <- t - begins
      1 + ifelse(s > 0 & s < 0.04, 0.5 - cos(50 * pi * s) / 2, 0)
    }
    for (breaks in list(double(), 0.5, c(0.5, begins + 0.04))) {
      sampled <- sample(f, c(0, 1), breaks)
      expect_lte(max(abs(value(sampled, t) - f(t))), sampled$error)
    }
  }
  # Breaks where the law jumps stay as they are: two samples each.
  step <- function(t) ifelse(t < 2, 1, -1)
  expect_lte(sample(step, breaks = 2)$calls, 70)
})

test_that("told breaks are ends of pieces, and an untold jump is no law to sample", {
  step <- function(t) ifelse(t < 2, 1, -1)
  sampled <- sample(step, breaks = 2)
  expect_equal(value(sampled, c(0, 1.99, 2.01, 8)), c(1, 1, -1, -1), tolerance = 1e-15)
  expect_null(sample(function(t) ifelse(t < 2.1, 1, -1)))
  expect_null(sample(function(t) ifelse(t < 5, 1, NaN)))
  expect_null(sample(sin, span = c(3, 3)))
})

test_that("one call for each time, or one for all of them", {
  shapes <- integer()
  f <- function(t) {
    shapes <<- c(shapes, length(t))
    2 * t
  }
  expect_identical(reader(f)$at(c(1, 2.5)), c(2, 5))
  expect_identical(shapes, c(1L, 1L))
  expect_identical(reader(f, vectorised = TRUE)$at(c(1, 2.5)), c(2, 5))
  expect_identical(shapes, c(1L, 1L, 2L))
  g <- function(t, theta, omega) t + 10 * theta + 100 * omega
  start <- scene_axle(1, theta0_rad = 2, omega0_rad_per_s = 3)
  expect_identical(reader(g, scene = start)$at(0:1 + 0), c(320, 321))
  expect_identical(reader(g, vectorised = TRUE, scene = start)$at(0:1 + 0), c(320, 321))
  # Integers, and NA of no type.
  expect_identical(reader(function(t) 3L)$at(1), 3)
  none <- reader(function(t) rep(NA, length(t)), vectorised = TRUE)
  expect_identical(none$at(1:2), c(NA_real_, NA_real_))
})

test_that("a vectorised law must return one number for each time", {
  for (f in list(
    function(t) sum(t), function(t) 0.3, function(t) c(t, 1), function(t) as.character(t),
    function(t) NULL, function(t) as.Date(t, origin = "1970-01-01"), function(t) t > 1
  )) {
    law <- torque_function(f, numeric(), vectorised = TRUE)
    expect_error(trajectory(scene_axle(1, law), 0:2), class = "rotdyn_error_torque")
  }
  expect_error(torque_function(sin, vectorised = NA), class = "rotdyn_error_type")
  expect_error(torque_function(sin, vectorised = c(TRUE, TRUE)), class = "rotdyn_error_type")
})

test_that("sums and multiples of vectorised laws are vectorised, others are not", {
  one <- torque_function(sin, numeric())
  all <- torque_function(cos, numeric(), vectorised = TRUE)
  state <- torque_function(function(t, theta, omega) -theta, numeric(), vectorised = TRUE)
  law <- function(torque) rotdyn:::torque_loads(torque)$law
  expect_true(law(all + 2 * all)$vectorised)
  expect_true(law(all - state)$vectorised)
  expect_false(law(all + one)$vectorised)
  both <- rotdyn:::law_reader(law(all - state), scene_axle(1, theta0_rad = 2), NULL)
  expect_identical(both$at(c(0, 1)), cos(0:1) + 2)
})

test_that("the time of a call is measured", {
  skip_if(is.nan(.Call(rotdyn:::ffi_clock_cpu)))
  busy <- torque_function(function(t) {
    until <- .Call(rotdyn:::ffi_clock_cpu) + 0.002
    while (.Call(rotdyn:::ffi_clock_cpu) < until) NULL
    0
  })
  seconds <- function(scene) {
    call_seconds(constraint_of(scene)$call_laws(scene, rlang::current_env()))
  }
  expect_gte(seconds(scene_axle(1, busy)), 0.002)
  expect_lt(seconds(scene_axle(1, busy)), 0.01)
  expect_lt(seconds(scene_axle(1, torque_function(function(t) 0))), 0.001)
  # In every scene that takes a function it counts in the predicted time.
  f <- busy$f
  g <- function(t) f(t) + c(0, 0, 0)
  friction <- coupling_clutch(torque_function(f, breaks_s = numeric()))
  slow <- list(
    scene_axle(1, busy), scene_drive(c(1, 2), list(coupling_shaft(3)), torque = list(busy, NULL)),
    scene_drive(c(1, 2), list(coupling_shaft(3)), brake = list(NULL, brake(busy))),
    scene_drive(c(1, 2), list(friction)),
    scene_incline(body_sphere(1, 0.1), 10, force = f),
    scene_incline(body_sphere(1, 0.1), 10, force = function(time_s, x_m, v_m_per_s) f(time_s)),
    scene_free(c(1, 2, 3), c(1, 1, 1), torque = g),
    scene_pivot(c(1, 1, 2), c(0, 0, 5), mass_kg = 1, centre_m = c(0, 0, 0.1), torque = g)
  )
  for (scene in slow) {
    expect_gte(seconds(scene), 0.002)
    choice <- choose_model(scene, 0:1)
    expect_gt(choice$cost_s[choice$chosen], 0.05)
  }
  quick <- list(
    scene_axle(1, 1), scene_incline(body_sphere(1, 0.1), 10), scene_free(c(1, 2, 3), c(1, 1, 1)),
    scene_drive(c(1, 2), list(coupling_shaft(3)))
  )
  for (scene in quick) {
    expect_null(constraint_of(scene)$call_laws(scene, rlang::current_env()))
  }
})

test_that("conditions of the law's own arrive as themselves", {
  expect_error(sample(function(t) stop(structure(class = c("mine", "error", "condition"),
    list(message = "no", call = NULL)))), class = "mine")
})

test_that("the samples' error is not blown up where gravity only might drive away", {
  law <- torque_function(function(time_s) 0.1 * sin(time_s), breaks_s = numeric())
  hanging <- scene_pendulum(body_point(1), 1, torque = law, theta0_rad = 0.3)
  law <- torque_sinusoid(0.1, 1, -pi / 2)
  same <- scene_pendulum(body_point(1), 1, torque = law, theta0_rad = 0.3)
  t <- seq(0, 100, by = 5)
  expect_silent(m <- trajectory(hanging, t))
  truth <- trajectory(same, t, 1e-12)
  off <- max(abs(m$theta_rad - truth$theta_rad)) / max(abs(truth$theta_rad))
  expect_lte(off, run_of(m)$info$error)
  expect_lte(run_of(m)$info$error, 1e-9)
  # Upside down it does drive away: exp(sqrt(g) 4) = 2.7e5 times.
  law <- torque_function(function(time_s) 1e-6 * exp(-time_s), breaks_s = numeric())
  up <- scene_pendulum(body_point(1), 1, torque = law, theta0_rad = pi)
  m <- suppressWarnings(trajectory(up, c(0, 4), 1e-6))
  up <- scene_pendulum(body_point(1), 1, torque = torque_exponential(1e-6, 1), theta0_rad = pi)
  truth <- suppressWarnings(trajectory(up, c(0, 4), 1e-9))
  expect_lte(
    max(abs(m$theta_rad - truth$theta_rad)) / max(abs(truth$theta_rad)), run_of(m)$info$error
  )
})

test_that("a zero of a sampled law on a row is a zero", {
  for (f in list(function(t) 0.8 * t, function(t) sin(t), function(t) 0.3 * t * (2 - t))) {
    motion <- suppressWarnings(trajectory(scene_axle(0.0625, f), 0:2))
    zero <- f(0:2) == 0
    expect_true(zero[1])
    expect_identical(motion$applied_torque_n_m[zero], 0 * (0:2)[zero])
    expect_identical(motion$net_torque_n_m[zero], 0 * (0:2)[zero])
    expect_equal(motion$applied_torque_n_m, f(0:2), tolerance = 1e-14)
  }
  # At rest under dry friction, which bears it.
  held <- suppressWarnings(
    trajectory(scene_axle(1, function(t) 0.1 * t, resistance(coulomb_n_m = 1)), 0:2)
  )
  expect_identical(held$applied_torque_n_m[1], 0)
  expect_identical(held$net_torque_n_m, c(0, 0, 0))
})

test_that("a body that friction holds throughout has no error", {
  scene <- scene_axle(1, function(t) 0.1 * t, resistance(coulomb_n_m = 1))
  expect_no_warning(motion <- trajectory(scene, 0:2))
  expect_identical(motion$omega_rad_per_s, c(0, 0, 0))
  expect_identical(attr(motion, "run")$info$error, 0)
})

test_that("an error of the samples grows as the motion does", {
  scene <- scene_pendulum(body_point(1), 1, theta0_rad = pi - 1e-3)
  time_s <- c(0, 3)
  run <- function(theta_rad, omega_rad_per_s) {
    list(
      info = list(kind = "none", error = 1e-9, errors = c(theta = 0, omega = 0),
                  sizes = c(theta = 1, omega = 1)),
      columns = list(theta_rad = c(0, theta_rad), omega_rad_per_s = c(0, omega_rad_per_s))
    )
  }
  # By a constant torque of 1 N m the motion changes by `growth`.
  widened <- function(growth) {
    rotdyn:::add_sampling(
      run(1, 1), list(error = 1e-6, impulse = Inf), scene, time_s,
      function(push_n_m) run(1 + growth * push_n_m, 1 + 2 * growth * push_n_m), 1e-9
    )$info$errors
  }
  # 1e-6 N m make 1e-6 of that; a motion that grows less counts as one without growth.
  expect_equal(widened(1e4), widened(1e3) * 10, tolerance = 1e-6)
  ratio <- widened(1e4)[c("theta", "omega")] / c(1e-2, 2e-2)
  expect_true(all(ratio > 0.999 & ratio < 10))
  expect_lt(widened(0)[["theta"]], 1e-5)
  expect_gt(widened(0)[["theta"]], 1e-6)
})
