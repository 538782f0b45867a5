test_that("the rules are exact for polynomials, up to degree 22 and 13", {
  powers <- function(t) outer(t, 0:22, `^`)
  exact <- function(from, to) (to^(1:23) - from^(1:23)) / 1:23
  panels <- panel_integrals(powers, c(-1, 0.25), c(1, 2))
  expect_equal(panels$value, rbind(exact(-1, 1), exact(0.25, 2)), tolerance = 1e-14)
  expect_equal(panels$error[2, 1:14], rep(0, 14), tolerance = 1e-14)
  # Of a constant the integral of |f| is the integral of f.
  expect_equal(panels$size[, 1], c(2, 1.75), tolerance = 1e-15)
})

test_that("panels are halved until the error is below rounding, each integrand in its column", {
  rates <- function(t) cbind(exp(t), cos(40 * t), sqrt(abs(t - 0.3)))
  edges <- c(0, 0.1, 0.7, 2)
  found <- integrate_panels(rates, edges[-4], edges[-1])
  root <- function(t) sign(t - 0.3) * 2 / 3 * abs(t - 0.3)^1.5
  exact <- cbind(diff(exp(edges)), diff(sin(40 * edges)) / 40, diff(root(edges)))
  expect_equal(found$value, exact, tolerance = 1e-13)
  expect_true(all(abs(found$value - exact) <= found$error + 1e-15 * found$size))
})

test_that("an integrand of two signs has the size of its absolute value", {
  found <- integrate_panels(function(t) cbind(t), -1, 1)
  expect_equal(c(found$value), 0, tolerance = 1e-16)
  expect_equal(c(found$size), 1, tolerance = 0.02)
})

test_that("what is not finite, or never converges, ends by a budget", {
  evaluated <- 0
  rates <- function(f) function(t) {
    evaluated <<- evaluated + length(t)
    cbind(f(t))
  }
  out <- rotdyn:::integrate_panels(rates(function(t) rep(NaN, length(t))), 0, 1)
  expect_true(is.nan(out$value))
  expect_equal(evaluated, 15)
  set.seed(1)
  evaluated <- 0
  out <- rotdyn:::integrate_panels(rates(function(t) stats::runif(length(t))), 0, 1)
  expect_lt(evaluated, 15 * 2.1e5)
  expect_lt(abs(out$value - 0.5), out$error)
})

test_that("an integrand that is no number in one panel leaves the others alone", {
  rates <- function(t) cbind(ifelse(t < 1, NaN, t), t)
  parts <- rotdyn:::integrate_panels(rates, c(0, 1), c(1, 2))
  expect_true(is.nan(parts$value[1, 1]))
  expect_equal(parts$value[2, ], c(1.5, 1.5), tolerance = 1e-15)
  expect_equal(parts$value[1, 2], 0.5, tolerance = 1e-15)
})

test_that("many integrals that are halved a few times are within the budget", {
  # An integral each, with a corner that a panel does not meet.
  n <- 30000
  from <- seq_len(n) - 1
  out <- rotdyn:::integrate_panels(function(t) cbind(abs(t - floor(t) - 0.5)), from, from + 1)
  expect_false(isTRUE(out$spent))
  expect_equal(range(out$value), c(0.25, 0.25), tolerance = 1e-12)
})
