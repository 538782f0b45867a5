sample <- function(f, span = c(0, 8), breaks = double(), accuracy = 1e-9) {
  rotdyn:::sample_torque(f, span, breaks, accuracy)
}

# Chebyshev pieces at some times, by the cosine form.
value <- function(sampled, t) {
  x <- sampled$term$x
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

test_that("told breaks are ends of pieces, and an untold jump is no law to sample", {
  step <- function(t) ifelse(t < 2, 1, -1)
  sampled <- sample(step, breaks = 2)
  expect_equal(value(sampled, c(0, 1.99, 2.01, 8)), c(1, 1, -1, -1), tolerance = 1e-15)
  expect_null(sample(function(t) ifelse(t < 2.1, 1, -1)))
  expect_null(sample(function(t) ifelse(t < 5, 1, NaN)))
  expect_null(sample(sin, span = c(3, 3)))
})

test_that("a function that takes one time only is called one by one", {
  f <- function(t) if (t < 2) 1 else t - 1
  expect_equal(rotdyn:::values_of(f, 0:7, stop), c(1, 1, 1, 2, 3, 4, 5, 6))
  # One that takes a vector but means something else by it.
  total <- function(t) sum(t)
  expect_equal(rotdyn:::values_of(total, 0:7, stop), as.double(0:7))
  expect_identical(rotdyn:::values_of(function(t) sin(t), 0:9, stop), sin(0:9))
})

test_that("what takes vectors is told from its text, without trying", {
  takes <- rotdyn:::takes_vectors
  helper <- function(x) x^2
  amplitude <- 3
  expect_true(takes(function(t) amplitude * sin(3 * t) + helper(t)))
  expect_true(takes(function(t) {
    u <- t - 1
    ifelse(u < 0, 0, exp(-u))
  }))
  expect_true(takes(sin))
  expect_false(takes(sum))
  expect_false(takes(function(t) if (t > 1) 1 else 0))
  expect_false(takes(function(t) t > 1 && t < 2))
  expect_false(takes(function(t) max(t, 2)))
  expect_false(takes(approxfun(0:1, 0:1)))
  expect_false(takes(function(t) stats::approx(0:1, 0:1, t)$y))
  `*` <- function(a, b) if (a > b) a else b # not the one of R
  expect_false(takes(function(t) 2 * t))
  deep <- function(t) deep(t)
  expect_false(takes(deep))
})

test_that("conditions of the law's own arrive as themselves", {
  expect_error(sample(function(t) stop(structure(class = c("mine", "error", "condition"),
    list(message = "no", call = NULL)))), class = "mine")
})

test_that("the samples' error is not blown up where gravity only might drive away", {
  law <- torque_function(function(time_s) 0.1 * sin(time_s), breaks_s = numeric())
  hanging <- scene_pendulum(1, 1, torque = law, theta0_rad = 0.3)
  same <- scene_pendulum(1, 1, torque = torque_sinusoid(0.1, 1, -pi / 2), theta0_rad = 0.3)
  t <- seq(0, 100, by = 5)
  expect_silent(m <- trajectory(hanging, t))
  truth <- trajectory(same, t, 1e-12)
  off <- max(abs(m$theta_rad - truth$theta_rad)) / max(abs(truth$theta_rad))
  expect_lte(off, run_of(m)$info$error)
  expect_lte(run_of(m)$info$error, 1e-9)
  # Upside down it does drive away: exp(sqrt(g) 4) = 2.7e5 times.
  law <- torque_function(function(time_s) 1e-6 * exp(-time_s), breaks_s = numeric())
  up <- scene_pendulum(1, 1, torque = law, theta0_rad = pi)
  m <- suppressWarnings(trajectory(up, c(0, 4), 1e-6))
  up <- scene_pendulum(1, 1, torque = torque_exponential(1e-6, 1), theta0_rad = pi)
  truth <- suppressWarnings(trajectory(up, c(0, 4), 1e-9))
  expect_lte(
    max(abs(m$theta_rad - truth$theta_rad)) / max(abs(truth$theta_rad)), run_of(m)$info$error
  )
})
