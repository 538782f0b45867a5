skip_if_not_installed("ggplot2")

test_that("a motion along a curve is drawn with its end", {
  for (motion in list(
    roll_on_curve(curve_cycloid(1), 0, 2 * pi), roll_on_curve(cos, 0.1, 3, rows = 2),
    roll_on_curve(curve_circle(0.5), 0, 2 * pi, v0_m_per_s = 3.5)
  )) {
    plot <- ggplot2::autoplot(motion)
    expect_silent(ggplot2::ggplotGrob(plot))
    expect_match(plot$labels$alt, "the body (turns|arrives|leaves the track) after")
  }
  places <- ggplot2::layer_data(plot, 3)
  expect_equal(nrow(places), 13)
  expect_error(ggplot2::autoplot(motion, size = 3), class = "rotdyn_error_argument")
})

test_that("the track lies a radius beside the path, on the side of the curve", {
  loop <- function(from, to) {
    roll_on_curve(curve_circle(0.5), from, to, body = body_sphere(0.1, 0.05), v0_m_per_s = 6)
  }
  for (motion in list(loop(0, 2 * pi), loop(0, -2 * pi))) {
    track <- ggplot2::layer_data(ggplot2::autoplot(motion), 1)
    # The circle's centre is half a metre above its lowest point.
    expect_equal(sqrt(track$x^2 + (track$y - 0.5)^2), rep(0.55, nrow(track)), tolerance = 1e-3)
  }
  hill <- track_of(0:4, rep(1, 5), 0.1, 1)
  expect_equal(hill$y, rep(0.9, 5))
  expect_equal(track_of(4:0, rep(1, 5), 0.1, -1)$y, rep(0.9, 5))
})

test_that("a curve is drawn between its ends", {
  plot <- ggplot2::autoplot(curve_cycloid(1))
  expect_equal(range(plot$data$x), c(0, 2 * pi))
  expect_equal(range(plot$data$y), c(-2, 0))
  circle <- ggplot2::autoplot(curve_circle(0.5))
  expect_equal(range(circle$data$x), c(-0.5, 0.5), tolerance = 1e-4)
  table <- curve_table(x_m = 0:4, y_m = c(2, 1.1, 0.6, 0.8, 0.4))
  plot <- ggplot2::autoplot(table)
  expect_equal(ggplot2::layer_data(plot, 2)$y, c(2, 1.1, 0.6, 0.8, 0.4))
  expect_match(plot$labels$alt, "0 to 4 m along x.*5 points of a table")
  parabola <- ggplot2::autoplot(curve_function(function(x) x^2), from = 1, to = 3)
  expect_equal(parabola$data$y, parabola$data$x^2)
  expect_error(ggplot2::autoplot(table, from = 3, to = 1), class = "rotdyn_error_value")
  bad <- table
  bad$knots <- "x"
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(table, 2), class = "rotdyn_error_argument")
})

test_that("the body is a circle of its radius at each place", {
  motion <- roll_on_curve(curve_circle(0.5), 0, 1, body = body_sphere(0.1, 0.05), v0_m_per_s = 3)
  plot <- ggplot2::autoplot(motion)
  rims <- ggplot2::layer_data(plot, 2)
  centres <- ggplot2::layer_data(plot, 4)
  expect_equal(length(unique(rims$group)), 13)
  for (k in c(1, 7, 13)) {
    rim <- rims[rims$group == k, ]
    away <- sqrt((rim$x - centres$x[k])^2 + (rim$y - centres$y[k])^2)
    expect_equal(away, rep(0.05, nrow(rim)), tolerance = 1e-3)
  }
})
