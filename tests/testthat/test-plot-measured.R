skip_if_not_installed("ggplot2")

test_that("the curve is the distribution of the number", {
  plot <- ggplot2::autoplot(measured(5, 0.2, name = "mass"))
  top <- plot$data[which.max(plot$data$y), ]
  expect_equal(top$x, 5)
  expect_equal(top$y, stats::dnorm(0) / 0.2)
  expect_equal(plot$data$y, stats::dnorm(plot$data$x, 5, 0.2), tolerance = 1e-9)
  expect_equal(range(ggplot2::layer_data(plot, 1)$x), 5 + c(-1, 1) * stats::qnorm(0.975) * 0.2)
  expect_equal(range(ggplot2::layer_data(plot, 2)$x), c(4.8, 5.2))
  expect_match(plot$labels$alt, "mass = 5.00\\(20\\).*95 % between 4.60801 and 5.39199")
  few <- measured(c(0.3358, 0.3361, 0.3362, 0.3359), name = "radius")
  plot <- ggplot2::autoplot(few)
  expect_equal(
    range(ggplot2::layer_data(plot, 1)$x), few$value + c(-1, 1) * stats::qt(0.975, 3) * few$u
  )
  expect_match(plot$labels$subtitle, "3 degrees of freedom")
})

test_that("an exact number and a damaged one are refused", {
  expect_error(ggplot2::autoplot(measured(1, 0)), class = "rotdyn_error_value")
  bad <- measured(1, 0.1)
  bad$u <- "x"
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(measured(1, 0.1), 2), class = "rotdyn_error_argument")
})
