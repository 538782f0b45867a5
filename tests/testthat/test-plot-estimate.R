skip_if_not_installed("ggplot2")

struck_motion <- function(inertia = NULL, bad = 50) {
  time <- seq(0, 4, by = 0.02)
  set.seed(1)
  record <- data.frame(
    time_s = time, theta_rad = 2 * time + pmax(time - 2.013, 0) * 6 + stats::rnorm(201, sd = 1e-3)
  )
  record$theta_rad[bad] <- record$theta_rad[bad] + 0.1
  estimate_motion(record, inertia = inertia)
}

test_that("the picture has four panels with bands, breaks, samples and crosses", {
  plot <- ggplot2::autoplot(struck_motion())
  built <- ggplot2::ggplot_build(plot)
  expect_equal(nrow(built$layout$layout), 4)
  expect_match(plot$labels$alt, "impact at 2.013 s")
  expect_match(plot$labels$subtitle, "; 1 sample left out")
  expect_match(
    ggplot2::autoplot(struck_motion(bad = c(50, 150)))$labels$subtitle, "; 2 samples left out"
  )
  geoms <- vapply(plot$layers, function(layer) class(layer$geom)[1], "")
  expect_true(all(c("GeomRibbon", "GeomLine", "GeomVline", "GeomPoint") %in% geoms))
  crosses <- built$data[[6]]
  expect_equal(crosses$x, c(0.98, 0.98))
  # No line across the break.
  line <- built$data[[5]]
  expect_equal(length(unique(line$group)), 2)
})

test_that("segments are drawn apart, lines and bands", {
  time <- c(0:40, 140:180) / 20
  set.seed(2)
  record <- motion_record(
    data.frame(t = time, a = 2 * time + stats::rnorm(82, sd = 1e-3), s = rep(1:2, each = 41)),
    time_s = t, theta_rad = a, segment = s
  )
  built <- ggplot2::ggplot_build(ggplot2::autoplot(estimate_motion(record, breaks = "none")))
  for (layer in built$data[4:5]) { # the band, the line
    expect_gt(nrow(layer), 100)
    apart <- tapply(layer$x, list(layer$PANEL, layer$group), function(x) max(diff(x)))
    expect_lt(max(apart, na.rm = TRUE), 0.06)
  }
})

test_that("units and a torque are drawn where asked for", {
  plot <- ggplot2::autoplot(struck_motion(0.2), units = c("degree", "rpm"))
  levels <- levels(plot$data$panel)
  expect_match(levels[1], "degree")
  expect_match(levels[2], "rpm")
  expect_match(levels[3], "net torque")
  # Without its column the acceleration is drawn.
  without <- struck_motion(0.2)
  without$net_torque_n_m <- NULL
  expect_match(levels(ggplot2::autoplot(without)$data$panel)[3], "angular acceleration")
  fit <- struck_motion()
  expect_few_labels(function(size) ggplot2::autoplot(fit, base_size = size))
  expect_error(ggplot2::autoplot(struck_motion(), unit = "rpm"), class = "rotdyn_error_argument")
})

test_that("no band is drawn where a row may lie on either side of a break", {
  time <- seq(0, 4, by = 0.02)
  set.seed(3)
  record <- data.frame(
    time_s = time, theta_rad = 2 * time + 3 * pmax(time - 2, 0)^2 + stats::rnorm(201, sd = 0.002)
  )
  estimate <- estimate_motion(record)
  fit <- attr(estimate, "estimate")
  rows <- ggplot2::autoplot(estimate)$data
  none <- !is.na(rows$low) & rows$low == rows$high
  expect_equal(fit$breaks$time_s, 2, tolerance = 0.02)
  near <- abs(rows$time - fit$breaks$time_s) < 2 * fit$break_se_s
  expect_true(any(near))
  expect_identical(none, near & !is.na(rows$low))
})
