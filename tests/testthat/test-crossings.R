test_that("zeros of many brackets at once, to the roundings of the time", {
  f <- function(x) (x - 0.1) * (x - 3) * (x - 7e5)
  zeros <- zeros_between(f, c(0, 1, 10), c(1, 10, 1e6), f(c(0, 1, 10)), f(c(1, 10, 1e6)))
  expect_equal(zeros, c(0.1, 3, 7e5), tolerance = 1e-15)
  # A jump.
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
