value <- function(...) angular_impulse(...)$angular_impulse_n_m_s

test_that("closed forms, by hand and by mpmath", {
  # 2.50 N at 0.260 m for 0.150 s on a disk of 4.00 kg (College Physics, CP10-11): 0.721 rad/s.
  kick <- angular_impulse(torque_pulse(0, 0.150, 2.50 * 0.260), body = body_disk(4.00, 0.260))
  expect_equal(kick$omega_change_rad_per_s, 0.7211538462, tolerance = 1e-9)
  expect_equal(value(torque_constant(3), 1, 5), 12)
  expect_equal(value(3, 5, 1), -12)
  triangle <- data.frame(time_s = c(0, 1, 4, 6, 8), torque_n_m = c(0, 0.8, 0.8, 0, 0))
  expect_equal(value(triangle), 3.6)
  expect_equal(value(triangle, 0.5, 5), 0.3 + 2.4 + 0.6)
  expect_equal(value(torque_knots(triangle, outside = "hold"), -1, 10), 3.6)
  expect_equal(value(torque_steps(c(0, 2, 5), c(0.8, 0.3, 0)), -3, 9), 1.6 + 0.9)
  # mpmath, 20 digits.
  # Relative to the largest term, 3 * 0.25.
  expect_lte(
    abs(value(torque_sinusoid(3, 20, 0.4), 0.1, 0.35) - 0.033486737289071362), 0.75 * 4.4e-16
  )
  expect_ulps(value(torque_exponential(2, 1.5, from_s = 0.2), 0, 1), 0.93174105078373053, 4)
  expect_ulps(value(torque_exponential(2, 1.5), 0, Inf), 4 / 3, 2)
  expect_equal(value(torque_polynomial(c(0, 1), c(0, 0, 3))), 1, tolerance = 1e-15)
  expect_equal(
    value(torque_polynomial(c(0, 1, 3), rbind(c(1, 2), c(3, -1))), 0.5, 2), 0.5 + 0.75 + 3 - 0.5,
    tolerance = 1e-15
  )
  sum <- torque_constant(1) + 2 * torque_sinusoid(3, 20, 0.4)
  expect_equal(value(sum, 0.1, 0.35), 0.25 + 2 * 0.033486737289071362, tolerance = 2e-15)
  # A short span keeps its digits.
  expect_ulps(value(torque_sinusoid(3, 20), 1, 1 + 2^-40), 3 * cos(20 + 10 * 2^-40) * 2^-40, 2)
})

test_that("spans add up, and the error covers", {
  law <- torque_sinusoid(3, 7) + torque_pulse(c(0.2, 1.3), 0.5, c(2, -4)) +
    torque_exponential(1, 2)
  edges <- c(0, 0.3, 0.31, 1.4, 2)
  parts <- angular_impulse(law, edges[-5], edges[-1])
  whole <- angular_impulse(law, 0, 2)
  off <- abs(sum(parts$angular_impulse_n_m_s) - whole$angular_impulse_n_m_s)
  expect_lte(off, sum(parts$angular_impulse_error_n_m_s) + whole$angular_impulse_error_n_m_s)
  expect_lte(whole$angular_impulse_error_n_m_s, 5e-14)
  # The impulse is the change of angular momentum that a motion has.
  motion <- trajectory(scene_axle(0.7, law), c(0, 2))
  expect_equal(
    diff(motion$angular_momentum_kg_m2_per_s), whole$angular_impulse_n_m_s, tolerance = 1e-13
  )
})

test_that("R functions, by quadrature with an error that covers", {
  smooth <- angular_impulse(
    torque_function(function(time_s) exp(-time_s^2), breaks_s = numeric()), 0, 3
  )
  exact <- 0.88620734825952123 # sqrt(pi)/2 erf(3), mpmath
  expect_lte(
    abs(smooth$angular_impulse_n_m_s - exact), smooth$angular_impulse_error_n_m_s + 2e-16
  )
  expect_lte(smooth$angular_impulse_error_n_m_s, 1e-13)
  jump <- torque_function(function(time_s) ifelse(time_s < 0.3, 2, 5), breaks_s = 0.3,
    vectorised = TRUE)
  expect_equal(value(jump, 0, 1), 0.6 + 3.5, tolerance = 1e-14)
  expect_warning(
    found <- value(function(time_s) if (time_s < 0.3) 2 else 5, 0, 1),
    class = "rotdyn_warning_breaks"
  )
  expect_equal(found, 4.1, tolerance = 1e-12)
})

test_that("blows in an instant", {
  blows <- data.frame(time_s = c(0, 1, 2), angular_impulse_n_m_s = c(0.1, 0.2, 0.4))
  expect_equal(value(0, c(0, 1), c(1, 3), instants = blows), c(0.1, 0.6))
  hit <- angular_impulse(0, instants = blows, body = 2)
  expect_equal(hit$omega_change_rad_per_s, 0.35)
  both <- value(torque_pulse(0, 1, 3), instants = blows)
  expect_equal(both, 3.7)
})

test_that("NA, and errors of the package's own", {
  expect_identical(value(1, c(0, NA), 1), c(1, NA))
  expect_error(angular_impulse(1), class = "rotdyn_error_torque")
  expect_error(angular_impulse(torque_sinusoid(1, 2)), class = "rotdyn_error_torque")
  expect_error(angular_impulse(function(time_s) 1), class = "rotdyn_error_torque")
  expect_error(angular_impulse(torque_motor(1, 10), 0, 1), class = "rotdyn_error_torque")
  expect_error(angular_impulse(torque_spring(1), 0, 1), "spring", class = "rotdyn_error_torque")
  expect_error(
    angular_impulse(function(time_s, theta_rad, omega_rad_per_s) 1, 0, 1),
    class = "rotdyn_error_torque"
  )
  expect_error(angular_impulse(1, 0:1, 1:3), class = "rotdyn_error_size")
  expect_error(angular_impulse("a", 0, 1), class = "rotdyn_error_type")
  expect_error(angular_impulse(1, 0, 1, body = -1), class = "rotdyn_error_value")
  expect_error(angular_impulse(1, 0, 1, instants = 3), class = "rotdyn_error_type")
  expect_error(
    angular_impulse(1, 0, 1, instants = data.frame(time_s = 1)), class = "rotdyn_error_type"
  )
  expect_error(angular_impulse(), class = "rotdyn_error_missing")
  expect_identical(dim(angular_impulse(1, double(), 1, body = 2)), c(0L, 5L))
  expect_error(angular_impulse(data.frame(time_s = 1:2), 0, 1), class = "rotdyn_error_type")
  expect_setequal(
    setdiff(names(angular_impulse(1, 0, 1, body = 1)), column_table()$name), character()
  )
})

test_that("a torque that grows as 1/time or faster has no impulse; slower, it has one", {
  skip_on_cran() # exhaustive: `make test` runs it
  of <- function(f, from, to, breaks_s = numeric()) {
    angular_impulse(torque_function(f, breaks_s = breaks_s), from, to)
  }
  expect_error(angular_impulse(function(t) 1 / t, 0, 1), "1/time", class = "rotdyn_error_torque")
  expect_error(of(function(t) t^-1.2, 0, 1), class = "rotdyn_error_torque")
  expect_error(of(function(t) 1 / (t - 0.3), 0, 1), class = "rotdyn_error_torque")
  expect_error(of(function(t) 1 / (t - 0.5), 0, 1), class = "rotdyn_error_torque") # no mean value
  expect_error(of(function(t) 1 / (t - 1000.3), 1000, 1001), class = "rotdyn_error_torque")
  expect_error(of(tan, 0, 3), class = "rotdyn_error_torque")
  # Closed forms: t^-p has the integral 1/(1 - p).
  for (p in c(0.5, 0.9)) {
    found <- of(function(t) t^-p, 0, 1)
    expect_equal(found$angular_impulse_n_m_s, 1 / (1 - p), tolerance = 1e-14)
    expect_lte(found$angular_impulse_error_n_m_s, 1e-11)
  }
  inside <- of(function(t) abs(t - 0.3)^-0.5, 0, 1)
  off <- abs(inside$angular_impulse_n_m_s - 2 * (sqrt(0.3) + sqrt(0.7)))
  expect_lte(off, inside$angular_impulse_error_n_m_s)
  expect_lte(inside$angular_impulse_error_n_m_s, 1e-5)
  tall <- of(function(t) 1 / t, 1e-300, 1)
  expect_equal(tall$angular_impulse_n_m_s, 300 * log(10), tolerance = 1e-12)
  expect_lte(tall$angular_impulse_error_n_m_s, 1e-8)
})

test_that("the error of a constant torque is its rounding, and no more", {
  for (torque in c(5, -5)) {
    x <- angular_impulse(torque_constant(torque), 2, 4.5)
    expect_equal(x$angular_impulse_n_m_s, 2.5 * torque)
    expect_gt(x$angular_impulse_error_n_m_s, 0)
    expect_lt(x$angular_impulse_error_n_m_s, 5 * .Machine$double.eps * 12.5)
  }
})

test_that("errors name the call, and what a function lacks is a finite span", {
  called <- function(expr) rlang::call_name(rlang::catch_cnd(expr, "rotdyn_error")$call)
  for (table in list(
    data.frame(time_s = 0:1, torque_n_m = "a"), data.frame(time_s = 1:0, torque_n_m = 1),
    data.frame(time_s = 0:1)
  )) {
    expect_identical(called(angular_impulse(table)), "angular_impulse")
  }
  expect_error(
    angular_impulse(function(time_s) exp(-time_s^2), -Inf, Inf), "R function needs a finite span",
    class = "rotdyn_error_torque"
  )
})

test_that("the error of a sinusoid's impulse is a few roundings of it, at any time", {
  # mpmath, 80 digits, as the sum of two doubles.
  known <- rbind(
    c(3.0, 20.0, 0.4, 0.1, 0.35, 0.03348673728907136, 2.2313597584511404e-18),
    c(2.0, 3.0, 0.5, 0.0, 100000000.0, -0.28969368488201047, -2.6283315321191995e-18),
    c(2.0, 3.0, 0.5, -100000000.0, 100000000.0, -0.5143242868826713, 2.1373360096925267e-17),
    c(5.0, 7.0, -1.0, 12345.678, 1000000.0, 0.38372128995861565, -2.5984335534156764e-17),
    c(0.7, -2.0, 1.0, -3.0, 1000000000000000.0, 0.20274152164308845, 3.896716910706852e-18)
  )
  for (i in seq_len(nrow(known))) {
    x <- known[i, ]
    got <- angular_impulse(torque_sinusoid(x[1], x[2], x[3]), x[4], x[5])
    error <- got$angular_impulse_error_n_m_s
    expect_lte(abs((got$angular_impulse_n_m_s - x[6]) - x[7]), error)
    phases <- 2^-98 * abs(x[1] / x[2]) * (abs(x[2]) * max(abs(x[4:5])) + abs(x[3]) + 1)
    expect_lte(error, 16 * 2^-53 * abs(x[6]) + phases)
  }
})
