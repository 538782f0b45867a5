# Laws of inputs: quantiles against R's own, construction, units, errors, words, probabilities.

# Quantiles at the coordinates of an unscrambled Sobol sequence: multiples of 1/n.
quantiles_of <- function(law, n = 4096) {
  rows <- design_rows(design_sobol(n, u = vary_uniform(0, 1), x = law), n = n)
  # The second coordinate; alone, the law has the first.
  alone <- design_rows(design_sobol(n, x = law), n = n)$x
  list(u = rows$u, x = alone)
}

test_that("quantiles are those of R, including the ends", {
  cases <- list(
    list(vary_uniform(-1, 3), function(u) qunif(u, -1, 3)),
    list(vary_loguniform(0.01, 100), function(u) exp(qunif(u, log(0.01), log(100)))),
    list(vary_normal(3, 2), function(u) qnorm(u, 3, 2)),
    list(vary_lognormal(0.03, 1.2), function(u) qlnorm(u, log(0.03), log(1.2))),
    list(vary_triangular(1, 2, 5), function(u) {
      ifelse(u < 0.25, 1 + sqrt(4 * u), 5 - sqrt(12 * (1 - u)))
    }),
    list(vary_truncated(vary_normal(3, 2), 2.5, 6), function(u) {
      from <- pnorm(2.5, 3, 2)
      qnorm(from + u * (pnorm(6, 3, 2) - from), 3, 2)
    }),
    list(vary_truncated(vary_normal(3, 2), low = 15), function(u) {
      qnorm((1 - u) * pnorm(15, 3, 2, lower.tail = FALSE), 3, 2, lower.tail = FALSE)
    }),
    list(vary_truncated(vary_lognormal(2, 1.5), high = 2), function(u) {
      qlnorm(u / 2, log(2), log(1.5))
    }),
    list(vary_truncated(vary_uniform(0, 10), 4, 20), function(u) 4 + 6 * u)
  )
  for (case in cases) {
    got <- quantiles_of(case[[1]])
    want <- case[[2]](got$u)
    expect_lte(max(abs(got$x - want) / pmax(abs(want), 1e-3)), 2e-13)
    expect_true(all(is.finite(got$x)))
  }
})

test_that("values are drawn by their weights, the first with the smallest coordinates", {
  equal <- quantiles_of(vary_values(c(5, -0, 7, 9)), 1024)
  expect_identical(equal$x, c(5, 0, 7, 9)[floor(4 * equal$u) + 1])
  expect_identical(1 / min(equal$x), -Inf)
  weighted <- quantiles_of(vary_values(c(5, 6, 7), weights = c(1, 0, 3)), 1024)
  expect_identical(weighted$x, ifelse(weighted$u < 0.25, 5, 7))
  expect_identical(unique(quantiles_of(vary_values(4), 16)$x), 4)
})

test_that("a law is plain data that prints its parameters", {
  expect_identical(
    unclass(vary_truncated(vary_normal(2, 0.02), low = 1.9)),
    list(kind = "normal", mean = 2, sd = 0.02, at_least = 1.9)
  )
  expect_identical(format(vary_uniform(1, 2)), "uniform, 1 to 2")
  expect_identical(format(vary_loguniform(1, 2)), "log-uniform, 1 to 2")
  expect_identical(format(vary_lognormal(1, 2)), "lognormal, median 1, factor 2")
  expect_identical(format(vary_triangular(1, 2, 3)), "triangular, 1 to 3, mode 2")
  expect_identical(format(vary_values(c(1, 5), c(1, 2))), "1, 5, weighted")
  expect_identical(format(vary_values(7:1)), "7 values, 1 to 7")
  expect_identical(format(vary_values(c(1 / 3, 2))), "0.3333333, 2")
  expect_identical(
    format(vary_truncated(vary_normal(0, 1), -1, 2)), "normal, mean 0, sd 1, truncated to -1 to 2"
  )
  expect_identical(
    format(vary_truncated(vary_normal(0, 1), high = 2)),
    "normal, mean 0, sd 1, truncated to at most 2"
  )
  expect_output(print(vary_normal(2, 0.02)), "<rot_vary> normal, mean 2, sd 0.02", fixed = TRUE)
})

test_that("a truncation of a truncation is that of both", {
  law <- vary_truncated(vary_truncated(vary_normal(0, 1), -1, 2), 0, 5)
  expect_identical(law, vary_truncated(vary_normal(0, 1), 0, 2))
})

test_that("units are kept beside the numbers", {
  skip_if_not_installed("units")
  kg <- function(x) units::set_units(x, "kg", mode = "standard")
  g <- function(x) units::set_units(x, "g", mode = "standard")
  law <- vary_normal(kg(2), g(20))
  expect_identical(unclass(law), list(kind = "normal", mean = 2, sd = 0.02, unit = "kg"))
  expect_match(format(law), "(kg)", fixed = TRUE)
  expect_identical(vary_lognormal(kg(2), 1.5)$unit, "kg")
  expect_identical(vary_values(g(c(1, 2)))$unit, "g")
  expect_equal(vary_truncated(law, low = g(1900))$at_least, 1.9)
  expect_identical(names(vary_truncated(law, low = kg(1)))[5], "unit")
  minute <- as.difftime(1, units = "mins")
  expect_identical(vary_uniform(minute, as.difftime(90, units = "secs"))$low, 60)
  error <- function(x, class) expect_error(x, class = paste0("rotdyn_error_", class))
  error(vary_normal(kg(2), 0.02), "unit")
  error(vary_normal(kg(2), units::set_units(1, "m", mode = "standard")), "unit")
  error(vary_truncated(law, low = 1.9), "unit")
  error(vary_truncated(vary_normal(0, 1), low = kg(1)), "unit")
  error(vary_lognormal(2, kg(1)), "unit")
})

test_that("measured numbers are taken by their values", {
  expect_identical(vary_normal(measured(2, 0.1), 0.02)$mean, 2)
})

test_that("impossible laws are errors", {
  error <- function(x, class = "value") expect_error(x, class = paste0("rotdyn_error_", class))
  error(vary_uniform(2, 1))
  error(vary_uniform(1, 1))
  error(vary_uniform(-1e308, 1e308))
  error(vary_uniform(1, Inf))
  error(vary_uniform(NaN, 1))
  error(vary_uniform("a", 1), "type")
  error(vary_uniform(1:2, 3), "size")
  error(vary_uniform(1), "missing")
  error(vary_uniform(1, 2, hight = 3), "argument")
  error(vary_loguniform(0, 1))
  error(vary_loguniform(2, 1))
  error(vary_normal(0, -1))
  error(vary_lognormal(0, 2))
  error(vary_lognormal(1, 0.9))
  error(vary_triangular(1, 4, 3))
  error(vary_triangular(1, 1, 1))
  error(vary_triangular(-1e308, 0, 1e308))
  error(vary_truncated(vary_normal(0, 1), 2, 1))
  error(vary_truncated(vary_normal(0, 1), 50, 51))
  error(vary_truncated(vary_normal(0, 0), 1, 2))
  error(vary_truncated(vary_uniform(0, 1), 2, 3))
  error(vary_truncated(vary_values(1:3), 2, 3))
  error(vary_truncated(3, 2, 3), "type")
  error(vary_values(double()), "size")
  error(vary_values(c(1, NA)))
  error(vary_values(1:3, 1:2), "size")
  error(vary_values(1:3, c(1, -1, 1)))
  error(vary_values(1:3, c(0, 0, 0)))
  damaged <- vary_normal(0, 1)
  damaged$sd <- NULL
  error(print(damaged), "type")
  error(format(damaged), "type")
  error(vary_truncated(damaged, 0, 1), "type")
})

test_that("the share of a law outside of a domain is a difference of R's probabilities", {
  outside <- function(law, low, high) design_probability_outside(unclass(law), low, high)
  expect_equal(outside(vary_normal(1, 2), 0, Inf), pnorm(-0.5))
  expect_equal(outside(vary_normal(1, 2), -Inf, 0), pnorm(0.5))
  expect_equal(outside(vary_normal(1, 2), 0, 4), pnorm(-0.5) + pnorm(-1.5))
  expect_equal(outside(vary_normal(10, 1), 0, Inf) / pnorm(-10), 1)
  expect_equal(outside(vary_normal(-10, 1), -Inf, 0) / pnorm(-10), 1)
  expect_equal(outside(vary_lognormal(1, exp(2)), 0, exp(2)), pnorm(-1))
  expect_equal(outside(vary_uniform(-1, 3), 0, 2), 0.5)
  expect_equal(outside(vary_loguniform(1, 100), 0, 10), 0.5)
  expect_equal(outside(vary_triangular(0, 1, 3), 0.5, Inf), 0.25 / 3)
  expect_equal(outside(vary_triangular(0, 1, 3), 2, Inf), 1 - 1 / 6)
  expect_equal(outside(vary_triangular(0, 1, 3), -1, 2), 1 / 6)
  expect_identical(outside(vary_triangular(0, 1, 3), -1, 4), 0)
  expect_equal(outside(vary_truncated(vary_normal(0, 1), 1), 0, 2), pnorm(-2) / pnorm(-1))
  expect_identical(outside(vary_truncated(vary_normal(0, 1), 1), 0, Inf), 0)
  expect_equal(outside(vary_truncated(vary_normal(0, 1), 1), 5, Inf), 1 - pnorm(-5) / pnorm(-1))
  expect_identical(outside(vary_truncated(vary_normal(0, 1), 1), -3, 0), 1)
  expect_equal(outside(vary_values(1:4, c(1, 1, 1, 7)), 2, 3), 0.8)
  expect_identical(outside(vary_normal(0, 0), 0, Inf), 0)
  expect_identical(outside(vary_lognormal(1, 1), 2, Inf), 1)
  expect_identical(outside(list(kind = "fixed", value = 3), 0, 3), 0)
  expect_identical(outside(list(kind = "column", x = c(1, 2, 3, 4)), 2, 9), 0.25)
})
