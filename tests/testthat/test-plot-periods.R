skip_if_not_installed("ggplot2")

timed <- function() {
  times <- c(
    17.63, 17.48, 17.59, 17.64, 17.71, 17.69, 17.66, 17.74, 17.52, 17.49, 17.55, 17.50,
    15.82, 15.86, 15.79, 15.80
  )
  pool_periods(times, swings = 10, group = rep(c("A", "B", "C", "D"), each = 4))
}

test_that("groups with both errors, the pooled period as a line and a band", {
  pooled <- timed()
  plot <- ggplot2::autoplot(pooled)
  built <- ggplot2::ggplot_build(plot)
  half <- stats::qt(0.975, pooled$period_s$dof) * pooled$period_s$u
  expect_equal(
    c(built$data[[1]]$xmin, built$data[[1]]$xmax), pooled$period_s$value + c(-1, 1) * half
  )
  wide <- built$data[[3]]
  thick <- built$data[[4]]
  # The miscounted group is beyond the plot.
  expect_equal(nrow(wide), 3)
  expect_equal((thick$xend - thick$x) / 2, pooled$groups$u_s[1:3])
  total <- sqrt(pooled$groups$u_s[1:3]^2 + pooled$between_s^2)
  expect_equal((wide$xend - wide$x) / 2, total)
  expect_equal(built$data[[6]]$label, "1.582 s, miscounted")
  expect_match(plot$labels$alt, "group D")
  # The miscounted one in the second colour, as a cross.
  points <- built$data[[5]]
  expect_identical(sum(points$colour == rotdyn:::plot_colours[2]), 1L)
  expect_identical(points$shape[points$colour == rotdyn:::plot_colours[2]], 4)
})

test_that("miscounted groups stand beyond the others, on their own side", {
  times <- c(
    15.82, 15.86, 15.79, 15.80, 17.63, 17.48, 17.59, 17.64, 17.71, 17.69, 17.66, 17.74, 17.52,
    17.49, 17.55, 17.50, 19.42, 19.38, 19.41, 19.39
  )
  pooled <- pool_periods(times, swings = 10, group = rep(LETTERS[1:5], each = 4))
  expect_equal(which(pooled$groups$status != "used"), c(1, 5))
  plot <- ggplot2::autoplot(pooled)
  bars <- ggplot2::layer_data(plot, 3)
  at <- plot$data$x[match(LETTERS[1:5], plot$data$group)]
  expect_equal(at[2:4], pooled$groups$period_s[2:4])
  # A quarter of the width of bars and band from their ends.
  band <- ggplot2::layer_data(plot, 1)
  ends <- range(bars$x, bars$xend, band$xmin, band$xmax)
  expect_equal(at[c(1, 5)], ends + c(-0.25, 0.25) * diff(ends))
})

test_that("one group, and damaged tables", {
  one <- pool_periods(c(1.7, 1.72, 1.69))
  expect_s3_class(ggplot2::ggplot_build(ggplot2::autoplot(one)), "ggplot_built")
  damaged <- timed()
  damaged$groups$status <- NULL
  expect_error(ggplot2::autoplot(damaged), class = "rotdyn_error_type")
  expect_error(print(damaged), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(timed(), 3), class = "rotdyn_error_argument")
})

test_that("pivots and the fitted line are drawn, what was left out is a cross", {
  d <- c(0.1, 0.2, 0.3, 0.4, 0.45, 0.5)
  times <- 2 * pi * sqrt((1 / 12 + d^2) / (9.81 * d)) * (1 + c(2, -1, 60, -2, 1, 1) / 1000)
  fit <- fit_pivots(times, d)
  plot <- ggplot2::autoplot(fit)
  expect_equal(plot$data$x, d)
  expect_equal(plot$data$y, times)
  expect_equal(plot$data$used, d != 0.3)
  line <- ggplot2::layer_data(plot, 1)
  k2 <- fit$gyration_square_m2$value
  expect_equal(line$y^2 * fit$gravity_m_per_s2$value * line$x / (4 * pi^2), k2 + line$x^2)
  expect_match(plot$labels$alt, "g = 9.821\\(35\\) m/s\\^2. Left out: the pivot at 0.3 m.")
  bad <- fit
  bad$pivots <- NULL
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  bad <- fit
  bad$gravity_m_per_s2 <- 9.81
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(fit, 2), class = "rotdyn_error_argument")
})
