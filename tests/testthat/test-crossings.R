test_that("zeros of many brackets at once, to the roundings of the time", {
  f <- function(x) (x - 0.1) * (x - 3) * (x - 7e5)
  zeros <- zeros_between(f, c(0, 1, 10), c(1, 10, 1e6), f(c(0, 1, 10)), f(c(1, 10, 1e6)))
  expect_equal(zeros, c(0.1, 3, 7e5), tolerance = 1e-15)
  # A jump.
  # The zero of a line: the middle, a point of the curve through three, the zero itself.
  calls <- 0
  line <- function(x) {
    calls <<- calls + 1
    x - 0.3
  }
  expect_equal(zeros_between(line, 0, 2, -0.3, 1.7), 0.3, tolerance = 1e-15)
  expect_equal(calls, 3)
  expect_equal(zeros_between(function(x) sign(x - pi), 0, 10, -1, 1), pi, tolerance = 1e-15)
  expect_equal(zeros_between(function(x) x, double(), double(), double(), double()), double())
})

test_that("extremes without a slope, and the largest around", {
  read <- function(t) list(x = sin(t))
  at <- extremes_by_values(read, "x", 0:9, sin(0:9))
  expect_equal(at, pi * c(0.5, 1.5, 2.5), tolerance = 1e-7)
  expect_equal(around(c(1, 5, 2, 0, 0), 1L), c(5, 5, 5, 2, 0))
})

test_that("a passage, a touch, a stay", {
  read <- function(t) list(x = pmax(0, cos(t)))
  got <- passages(read, NULL, "x", 0, c(0, 1, pi / 2, 3, 4, 3 * pi / 2, 6, 7, 8), 1e-15)
  expect_equal(got$direction, c("reached", "reached"))
  read <- function(t) list(x = cos(t))
  got <- passages(read, NULL, "x", 0, seq(0, 8, 0.25), 1e-15)
  expect_equal(got$time_s, pi * c(0.5, 1.5, 2.5), tolerance = 1e-15)
  expect_equal(got$direction, c("down", "up", "down"))
})

# passages.csv: 40 digits by tools/passages.py. Amplitudes from 1e-300 rad to the last double below
# pi, both sides of the separatrix, dampings from none to 1e12 times the critical one, stops under
# every resistance.
references <- function() {
  x <- utils::read.csv(test_path("passages.csv"), colClasses = "character")
  x[-1] <- lapply(x[-1], as.double)
  split(x, x$kind)
}

expect_digits <- function(got, want, row) {
  error <- max(abs(ifelse(got == want, 0, got / want - 1)))
  expect_true(isTRUE(error <= 1e-14), info = paste(c(error, unlist(row)), collapse = " "))
}

test_that("pendulums of any amplitude: passages and periods to 1e-14", {
  for (row in split(references()$pendulum, seq_len(nrow(references()$pendulum)))) {
    scene <- scene_axle(
      row$inertia, torque_gravity(1, row$k, gravity_m_per_s2 = 1), theta0_rad = row$theta0,
      omega0_rad_per_s = row$omega0
    )
    got <- expect_no_warning(time_when(scene, theta_rad = row$value))
    expect_digits(c(got$time_s, period_of(scene)$period_s), c(row$time_s, row$second), row)
  }
})

test_that("oscillators of any damping: passages and cycles to 1e-14", {
  for (row in split(references()$oscillator, seq_len(nrow(references()$oscillator)))) {
    scene <- scene_axle(
      row$inertia, torque_spring(row$k), resistance(row$c), theta0_rad = row$theta0,
      omega0_rad_per_s = row$omega0
    )
    got <- if (row$value == 1) time_when(scene, theta_rad = 0) else
      time_when(scene, theta_rad = 0, occurrence = "all", until_s = 1.001 * row$time_s)
    cycle <- period_of(scene)$period_s
    if (is.nan(cycle)) cycle <- Inf # overdamped
    expect_equal(nrow(got), row$value)
    expect_digits(c(got$time_s[row$value], cycle), c(row$time_s, row$second), row)
  }
})

test_that("stopping times and angles to 1e-14", {
  for (row in split(references()$stop, seq_len(nrow(references()$stop)))) {
    got <- stopping(scene_axle(
      row$inertia, resistance = resistance(row$c, row$q, row$f), omega0_rad_per_s = row$omega0
    ))
    expect_digits(c(got$stop_time_s, got$stop_theta_rad), c(row$time_s, row$second), row)
  }
})

test_that("a change of sign is seen between the smallest numbers", {
  expect_equal(rotdyn:::changes_sign(c(1e-300, -1e-300, 0, 5e-324, -5e-324)),
    c(TRUE, FALSE, FALSE, TRUE))
})

test_that("times are graded from the start on, both ways, and from each break to the next", {
  graded <- rotdyn:::graded_times
  away <- 0.25 * 2^(-1:8)
  expect_equal(graded(0, 0, 0.25, 0, 100), away)
  expect_equal(sort(graded(0, 0, 0.25, -100, 0)), sort(-away))
  both <- graded(0, 0, 0.25, -100, 100)
  expect_equal(sort(both), sort(c(-away, away)))
  part <- 0.25 * 2^(-1:7)
  expect_equal(sort(graded(c(0, 40), 0, 0.25, 0, 100)), sort(c(part, 40 + part)))
  # From within: the time since the break counts.
  expect_equal(sort(graded(c(0, 100), 0, 0.25, 10, 90)), away)
  expect_identical(graded(0, 0, Inf, 0, 100), double())
})
