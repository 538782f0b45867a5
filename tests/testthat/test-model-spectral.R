law_scene <- function(f, ..., breaks = numeric(), inertia = 1) {
  scene_axle(inertia, torque_function(f, breaks_s = breaks), ...)
}

expect_spectral <- function(motion) expect_equal(run_of(motion)$model, "axle_spectral")

test_that("a pendulum of large amplitude, against Jacobi's functions", {
  # theta = 2 asin(k sn(w t + K)), k = sin(1.3), w^2 = 9.81; mpmath, 50 digits
  theta <- c(
    1.8615497430705326594, 1.8784437960800060004, 1.9115073642871626374, -0.56944738172904204184
  )
  omega <- c(
    -3.3447887064887962108, 3.2971017493674671328, 3.2024975092914196234, 5.7737425333896077918
  )
  scene <- law_scene(function(t, theta, omega) -9.81 * sin(theta), theta0_rad = 2.6)
  motion <- trajectory(scene, c(0.5, 3, 10, 20), 1e-10)
  expect_spectral(motion)
  expect_lt(max(abs(motion$theta_rad - theta)), 1e-10)
  expect_lt(max(abs(motion$omega_rad_per_s - omega)), 1e-10)
  expect_lte(run_of(motion)$info$error, 1e-10)
})

test_that("damped oscillator: rows, torques and the estimate, forwards and backwards", {
  # I = 2, k = 8, c = 0.4 in the scene: theta = exp(-g t)(cos wt + g/w sin wt)
  g <- 0.1
  w <- sqrt(4 - g^2)
  theta <- function(t) exp(-g * t) * (cos(w * t) + g / w * sin(w * t))
  omega <- function(t) -exp(-g * t) * (g^2 + w^2) / w * sin(w * t)
  scene <- law_scene(
    function(t, theta, omega) -8 * theta,
    inertia = 2, resistance = resistance(0.4), theta0_rad = 1
  )
  t <- c(-5, -5, -1.25, 0, 0.3, 2, 2, 11)
  size <- max(abs(theta(seq(-5, 11, 0.01))))
  for (accuracy in 10^-c(2, 5, 8, 11)) {
    motion <- trajectory(scene, t, accuracy)
    expect_spectral(motion)
    expect_lte(run_of(motion)$info$error, accuracy)
    expect_lte(max(abs(motion$theta_rad - theta(t))), run_of(motion)$info$theta_error)
    expect_lte(max(abs(motion$omega_rad_per_s - omega(t))), run_of(motion)$info$omega_error)
    expect_equal(motion$applied_torque_n_m, -8 * theta(t), tolerance = 100 * accuracy)
    expect_equal(motion$damping_torque_n_m, -0.4 * motion$omega_rad_per_s)
    expect_equal(motion$net_torque_n_m, motion$applied_torque_n_m + motion$damping_torque_n_m)
    expect_equal(motion$rotational_kinetic_energy_j, motion$omega_rad_per_s^2)
  }
  expect_equal(run_of(motion)$info$theta_max, size, tolerance = 0.01)
  expect_equal(audit(motion)$verdict, "balanced")
})

test_that("what acts beside the law is what it is for the integrator", {
  law <- torque_function(function(t, theta, omega) 0.3 * sin(theta - t) - 0.1 * omega^2, numeric())
  torque <- law + torque_sinusoid(0.2, 3, 1, from_s = 1, to_s = 4) + torque_spring(2, 0.5) +
    torque_gravity(0.1, 2, -0.3) + torque_motor(2, 40) + torque_exponential(0.5, 0.7, from_s = 2) +
    torque_polynomial(c(0.5, 3, 5), rbind(c(1, -1, 0.2), c(0, 0.5, -0.1))) +
    torque_knots(c(0, 2, 2, 6), c(0.1, 0.4, -0.4, 0.3), outside = "hold")
  scene <- scene_axle(0.7, torque, resistance(0.05), 0.4, 1)
  t <- c(-1, seq(0.1, 7, by = 0.3))
  motion <- trajectory(scene, t, 1e-10)
  other <- trajectory(scene, t, 1e-12, model = "axle_rk8pd")
  expect_spectral(motion)
  for (column in names(motion)) {
    expect_equal(motion[[column]], other[[column]], tolerance = 1e-9, label = column)
  }
  expect_equal(audit(motion)$verdict, "balanced")
})

test_that("breaks that are told are ends of panels", {
  # A push of 1 N m that turns to -2 at 1.3 s; omega(3) = 1.3 - 2 x 1.7.
  push <- function(t, theta, omega) ifelse(t < 1.3, 1, -2)
  motion <- trajectory(law_scene(push, breaks = 1.3), c(1, 1.3, 3))
  expect_spectral(motion)
  expect_equal(motion$omega_rad_per_s, c(1, 1.3, -2.1), tolerance = 1e-13)
  expect_equal(motion$theta_rad[3], 1.3^2 / 2 + 1.3 * 1.7 - 1.7^2, tolerance = 1e-13)
  expect_equal(motion$applied_torque_n_m, c(1, -2, -2))
  # Found, with one warning.
  seen <- 0
  found <- withCallingHandlers(
    trajectory(scene_axle(1, push), c(1, 3)),
    rotdyn_warning_breaks = function(w) {
      seen <<- seen + 1
      invokeRestart("muffleWarning")
    }
  )
  expect_equal(seen, 1)
  expect_equal(found$omega_rad_per_s, c(1, -2.1), tolerance = 1e-12)
})

test_that("a law that is not smooth in the state goes to the integrator", {
  wall <- function(t, theta, omega) -9 * theta - ifelse(theta > 0.5, 400 * (theta - 0.5), 0)
  calls <- 0
  counted <- function(t, theta, omega) {
    calls <<- calls + length(t)
    wall(t, theta, omega)
  }
  motion <- trajectory(law_scene(counted, theta0_rad = -1), seq(0, 30, 0.5), 1e-9)
  expect_equal(run_of(motion)$model, "axle_rk8pd")
  expect_equal(summary(motion)$rhs_calls, calls, tolerance = 1e-3) # rows' own torques beside
  named <- trajectory(law_scene(wall, theta0_rad = -1), seq(0, 30, 0.5), 1e-9, "axle_rk8pd")
  expect_equal(motion$theta_rad, named$theta_rad)
  expect_equal(predict(motion, 7)$theta_rad, predict(named, 7)$theta_rad)
})

test_that("every evaluated point is counted, with vectors and one by one", {
  points <- 0
  vector_law <- function(t, theta, omega) {
    points <<- points + length(t)
    -sin(theta) - 0.1 * omega
  }
  scene <- law_scene(vector_law, theta0_rad = 2)
  together <- trajectory(scene, 0:20)
  expect_equal(summary(together)$rhs_calls, points)
  integrated <- trajectory(scene, 0:20, model = "axle_rk8pd")
  expect_lt(summary(together)$rhs_calls, summary(integrated)$rhs_calls / 4)

  points <- 0
  scalar_law <- function(t, theta, omega) {
    if (length(t) > 1) stop("one at a time")
    points <<- points + 1
    -sin(theta) - 0.1 * omega
  }
  single <- trajectory(law_scene(scalar_law, theta0_rad = 2), 0:20)
  expect_spectral(single)
  expect_equal(summary(single)$rhs_calls, points)
  expect_equal(single$theta_rad, together$theta_rad, tolerance = 1e-9)
})

test_that("whatever the law raises arrives as itself", {
  broken <- structure(
    class = c("bearing_broken", "error", "condition"), list(message = "broken", call = NULL)
  )
  expect_error(
    trajectory(law_scene(function(t, theta, omega) if (any(t > 2)) stop(broken) else -theta), 0:9),
    class = "bearing_broken"
  )
  expect_equal(
    callCC(function(out) {
      jump <- function(t, theta, omega) if (any(t > 1)) out("out") else 0 * t + 1
      trajectory(law_scene(jump), 0:9)
    }),
    "out"
  )
  expect_error(
    trajectory(law_scene(function(t, theta, omega) if (any(t > 1)) "x" else 0 * t), 0:9),
    class = "rotdyn_error_torque"
  )
  # Not finite from 2 s on: the integrator keeps the rows before.
  error <- expect_error(
    trajectory(law_scene(function(t, theta, omega) ifelse(t > 2, NaN, 1)), 0:9),
    class = "rotdyn_error_torque"
  )
  expect_equal(error$info$time_s, 2, tolerance = 1e-6)
})

test_that("a sign that is swapped is found out", {
  # theta'' = theta grows, theta'' = -theta does not.
  grow <- trajectory(law_scene(function(t, theta, omega) theta, theta0_rad = 1), c(-2, 0, 3), 1e-10)
  expect_equal(grow$theta_rad, cosh(c(-2, 0, 3)), tolerance = 1e-10)
  expect_equal(grow$omega_rad_per_s, sinh(c(-2, 0, 3)), tolerance = 1e-10)
  expect_lte(max(abs(grow$theta_rad - cosh(c(-2, 0, 3)))), run_of(grow)$info$theta_error)
})

test_that("the integration matrices are exact for polynomials", {
  for (n in c(8L, 12L, 32L)) {
    m <- rotdyn:::spectral_matrices(n)
    expect_lt(max(abs(rotdyn:::legendre(m$x, n)[, n + 1L])), 1e-14)
    for (k in 0:(n - 1L)) {
      power <- m$x^k
      expect_equal(
        as.vector(m$once %*% power), (m$x^(k + 1) - (-1)^(k + 1)) / (k + 1), tolerance = 1e-12
      )
      end <- c(2 / (k + 1) * (k %% 2 == 0)) # int_-1^1 x^k
      expect_equal(as.vector(m$end[2, ] %*% power), end, tolerance = 1e-12)
    }
  }
})

test_that("models that do not fit say so", {
  reason <- function(...) {
    table <- choose_model(scene_axle(...), 0:3)
    table$reason[table$model == "axle_spectral"]
  }
  law <- torque_function(function(t, theta, omega) -theta, numeric())
  expect_match(reason(1, torque_function(cos, numeric())), "R function of time, angle and rate")
  expect_match(reason(1, law, resistance(0, 0.1)), "quadratic")
  expect_match(reason(1, law), "fewest|least|long panels")
})

test_that("no rows, and rows at the start alone", {
  scene <- law_scene(function(t, theta, omega) 3 - theta, theta0_rad = 1)
  expect_equal(nrow(trajectory(scene, numeric())), 0L)
  still <- trajectory(scene, c(0, 0))
  expect_equal(still$theta_rad, c(1, 1))
  expect_equal(still$applied_torque_n_m, c(2, 2))
})

test_that("slopes guessed far too steep do not pass a wrong root", {
  # In this one a guessed panel at 24.9 s was once accepted because a steep slope made Newton's step
  # small: the motion was 9 times its own size off.
  a <- 7.7691891220165417
  b <- 0.42636767914518714
  w <- 2.6566230308962986
  c <- 0.036806770579423762
  start <- c(0.45646798610687256, 0.51147967111319304)
  law <- function(t, theta, omega) -a * theta - c * omega + b * sin(w * t)
  motion <- trajectory(
    law_scene(law, theta0_rad = start[1], omega0_rad_per_s = start[2]), seq(0, 29.2, 0.1), 1e-3
  )
  expect_spectral(motion)
  # theta = particular + exp(-g t)(p cos kt + q sin kt)
  g <- c / 2
  k <- sqrt(a - g^2)
  d <- (a - w^2)^2 + (c * w)^2
  particular <- function(t) b * ((a - w^2) * sin(w * t) - c * w * cos(w * t)) / d
  p <- start[1] + b * c * w / d
  q <- (start[2] + g * p - b * (a - w^2) * w / d) / k
  exact <- function(t) particular(t) + exp(-g * t) * (p * cos(k * t) + q * sin(k * t))
  expect_lte(max(abs(motion$theta_rad - exact(motion$time_s))), run_of(motion)$info$theta_error)
  expect_lte(run_of(motion)$info$error, 1e-3)
})
