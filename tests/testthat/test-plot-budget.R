skip_if_not_installed("ggplot2")

test_that("shares of the variance, the largest on top, with their numbers", {
  budget <- uncertainty_budget(
    function(m, r) m * r^2, m = measured(2, 0.02), r = measured(0.5, 0.005), draws = 0
  )
  plot <- ggplot2::autoplot(budget)
  built <- ggplot2::ggplot_build(plot)
  # Relative contributions 1 % and 2 %: 20 and 80 % of the variance.
  expect_equal(sort(built$data[[1]]$xmax - pmin(built$data[[1]]$xmin, 0)), c(20, 80))
  expect_equal(levels(plot$data$input), c("m", "r"))
  expect_setequal(built$data[[3]]$label, c("20", "80"))
  expect_match(plot$labels$alt, "of y is from r, 80 %", fixed = TRUE)
  # 0.5 +- 0.5 sqrt(0.01^2 + 0.02^2)
  expect_equal(levels(plot$data$panel), "y = 0.500(11)")
})

test_that("shares have one decimal, and those below a twentieth of a percent a word", {
  # Variances as 1 : 2 : 1e-4.
  budget <- uncertainty_budget(
    function(a, b, c) a + b + c, a = measured(1, 0.1), b = measured(1, 0.1 * sqrt(2)),
    c = measured(1, 0.001), draws = 0
  )
  built <- ggplot2::ggplot_build(ggplot2::autoplot(budget))
  expect_setequal(built$data[[3]]$label, c("33.3", "66.7", "< 0.1"))
})

test_that("a panel for each result, negative shares, measured moments of inertia", {
  correlation <- matrix(c(1, -0.9, -0.9, 1), 2)
  budget <- uncertainty_budget(
    function(a, b) c(sum = a + b, a = a), a = measured(1, 0.1), b = measured(2, 0.05),
    correlation = correlation, draws = 0
  )
  plot <- ggplot2::autoplot(budget)
  built <- ggplot2::ggplot_build(plot)
  expect_equal(nrow(built$layout$layout), 2)
  expect_true(any(plot$data$percent < 0))
  expect_equal(sum(plot$data$percent[plot$data$panel == levels(plot$data$panel)[1]]), 100)
  inertia <- inertia_torsion(
    measured(1.2, 0.01, name = "period"), measured(0.3, 0.001, name = "wire")
  )
  alt <- ggplot2::autoplot(inertia)$labels$alt
  expect_match(alt, "variance of I is from period")
})

test_that("nothing uncertain, and damaged budgets", {
  exact <- uncertainty_budget(function(a) a, a = 1)
  expect_error(ggplot2::autoplot(exact), class = "rotdyn_error_value")
  budget <- uncertainty_budget(function(a) a, a = measured(1, 0.1), draws = 0)
  budget$interval <- NULL
  expect_error(ggplot2::autoplot(budget), class = "rotdyn_error_type")
  expect_error(print(budget), class = "rotdyn_error_type")
})

test_that("negative shares have a colour of their own", {
  budget <- uncertainty_budget(
    function(a, b) a + b, a = measured(1, 0.1), b = measured(2, 0.05),
    correlation = matrix(c(1, -0.9, -0.9, 1), 2), draws = 0
  )
  bars <- ggplot2::ggplot_build(ggplot2::autoplot(budget))$data[[1]]
  below <- bars$x < 0 | bars$xmin < 0
  expect_true(any(below) && !all(below))
  expect_identical(unique(bars$fill[!below]), rotdyn:::plot_colours[1])
  expect_identical(unique(bars$fill[below]), rotdyn:::plot_colours[2])
})
