
test_that("sum() adds laws up, and other summaries are refused", {
  laws <- list(torque_constant(1), torque_sinusoid(2, 3), torque_constant(-0.25))
  whole <- trajectory(scene_axle(0.5, do.call(sum, laws)), 0:3)
  parts <- trajectory(scene_axle(0.5, laws[[1]] + laws[[2]] + laws[[3]]), 0:3)
  expect_identical(whole$omega_rad_per_s, parts$omega_rad_per_s)
  expect_error(max(laws[[1]], laws[[2]]), class = "rotdyn_error_type")
})

test_that("pulses in any number add up where they overlap", {
  start <- c(0, 1, 1.5, 7, 7, 20)
  length <- c(3, 1, 0.25, 2, 1, 1)
  size <- c(1e16, 1, -1, 4, -2, 5)
  law <- torque_pulse(start, length, size)
  t <- c(0.5, 1.25, 1.6, 1.9, 2.5, 3, 5, 7, 7.5, 8, 8.5, 9, 20.5, 21.5)
  alone <- vapply(t, function(at) sum(size[start <= at & at < start + length]), 0)
  expect_identical(trajectory(scene_axle(1, law), t)$applied_torque_n_m, alone)
  n <- 300
  many <- trajectory(scene_axle(1, torque_pulse(seq_len(n), 0.5, 2) + 1), n + 1)
  expect_equal(many$omega_rad_per_s, 2 * n + 1, tolerance = 1e-15)
})

test_that("a level part of a law stays level in a sum", {
  set.seed(5)
  for (i in 1:50) {
    ends <- sort(stats::runif(2, -1, 1))
    level <- stats::rnorm(1)
    inside <- sort(stats::runif(20, ends[1], ends[2]))
    held <- torque_knots(ends, c(level, level), outside = "hold")
    sum <- torque_loads(held + torque_knots(inside, rep(0, 20)))$knots
    expect_identical(unique(sum$torque_n_m), level)
  }
})

test_that("one law of knots is taken as it is, none is no torque", {
  knots <- torque_knots(c(0, 1, 4), c(2, 3, 3), outside = "hold")
  expect_identical(torque_loads(knots)$knots, knots)
  expect_identical(rotdyn:::add_knots(list(knots)), knots)
  expect_identical(rotdyn:::add_knots(list())$outside, c(0, 0))
})

test_that("several laws of knots add up exactly, whatever cancels", {
  held <- function(value) torque_knots(c(0, 2), c(value, value))
  knots <- torque_loads(held(1e16) + held(1) + held(-1e16))$knots
  expect_identical(unique(knots$torque_n_m), 1)
  knots <- torque_loads(held(1e16) + held(0.75) + held(-1e16) + held(-0.5))$knots
  expect_identical(unique(knots$torque_n_m), 0.25)
})
