skip_if_not_installed("ggplot2")

noisy_swing <- function(restoring = "spring") {
  set.seed(1)
  time <- seq(0, 12, by = 0.04)
  y <- 0.5 * exp(-0.04 * time) * cos(5 * time) + stats::rnorm(length(time), sd = 0.002)
  fit_swing(data.frame(time_s = time, theta_rad = y), restoring)
}

test_that("three panels: motion, residuals, periods with the interval as a band", {
  fit <- noisy_swing()
  plot <- ggplot2::autoplot(fit)
  built <- ggplot2::ggplot_build(plot)
  expect_equal(nrow(built$layout$layout), 3)
  band <- built$data[[1]]
  half <- stats::qt(0.975, fit$period_s$dof) * fit$period_s$u
  expect_equal(c(band$ymin, band$ymax), fit$period_s$value + c(-1, 1) * half)
  expect_match(plot$labels$alt, "fitted motion follows")
  expect_match(plot$labels$subtitle, "complete")
  points <- built$data[[5]]
  expect_equal(sum(points$PANEL == 2), nrow(fit$samples))
  expect_equal(points$y[points$PANEL == 2], generics::augment(fit)$residual)
})

test_that("two panels without a fitted motion; errors are ours", {
  fit <- noisy_swing()
  fit["motion"] <- list(NULL)
  fit$from <- "swings"
  fit$law_complete <- FALSE
  plot <- ggplot2::autoplot(fit)
  expect_equal(nrow(ggplot2::ggplot_build(plot)$layout$layout), 2)
  expect_match(plot$labels$subtitle, "incomplete")
  expect_error(ggplot2::autoplot(fit, size = 3), class = "rotdyn_error_argument")
  fit$swings <- NULL
  expect_error(ggplot2::autoplot(fit), class = "rotdyn_error_type")
})

test_that("swings of about the period are drawn, used or not; others only where used", {
  fit <- noisy_swing()
  drawn <- function(swings) {
    fit$swings <- swings
    built <- ggplot2::ggplot_build(ggplot2::autoplot(fit))
    sum(vapply(built$data, function(layer) {
      if (is.null(layer$shape)) 0L else sum(layer$PANEL == 3)
    }, 0L))
  }
  all <- fit$swings[is.finite(fit$swings$amplitude_rad) & is.finite(fit$swings$period0_s), ]
  all$used <- TRUE
  n <- nrow(all)
  expect_equal(drawn(all), n)
  all$used[2:3] <- FALSE
  expect_equal(drawn(all), n)
  all$period0_s[2] <- 1.5 * all$period0_s[2]
  expect_equal(drawn(all), n - 1)
  # Circles: full where used.
  shapes <- lapply(ggplot2::ggplot_build(ggplot2::autoplot(fit))$data, function(x) x$shape)
  expect_setequal(setdiff(unlist(shapes), 19), if (all(fit$swings$used)) 16 else c(1, 16))
  all$used[2] <- TRUE
  expect_equal(drawn(all), n)
})

test_that("an axis has few labels, and fewer with large letters", {
  fit <- noisy_swing()
  expect_few_labels(function(size) ggplot2::autoplot(fit, base_size = size))
})
