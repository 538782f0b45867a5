skip_if_not_installed("ggplot2")

test_that("paths in a plane are drawn, with their ends in words", {
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  coin <- roll_disk(body_disk(0.5, 0.04), seq(0, 2, 0.05), spin_rad_per_s = 20, lean_deg = 10)
  table <- ball_on_turntable(body_sphere(0.1, 0.02), 0:9 / 5, 5, x_m = 0.1, vy_m_per_s = 0.2)
  swing <- foucault_pendulum(seq(0, 3600, 20), 49, length_m = 67, east_m = 3)
  for (one in list(coin, table, swing)) {
    for (size in c(13, 24)) {
      expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(one, base_size = size)))
    }
    expect_match(ggplot2::autoplot(one)$labels$alt, "from above[.] A path from \\(.*\\) m to \\(")
    expect_error(ggplot2::autoplot(one[1, ]), class = "rotdyn_error_value")
    expect_error(ggplot2::autoplot(one["time_s"]), class = "rotdyn_error_type")
    expect_error(ggplot2::autoplot(one, colour = 1), class = "rotdyn_error_argument")
  }
  plot <- ggplot2::autoplot(coin)
  path <- ggplot2::layer_data(plot, 2)
  expect_equal(path$x, coin$contact_x_m)
  rims <- ggplot2::layer_data(plot, 1)
  expect_equal(max(table(rims$group)), 181)
  # A rim is as wide as the disk where it is seen from above.
  one <- rims[rims$group == 1, ]
  expect_equal(max(stats::dist(one[c("x", "y")])), 2 * 0.04, tolerance = 1e-3)
  # A ball goes round its circle.
  circle <- ggplot2::layer_data(ggplot2::autoplot(table), 1)
  expect_equal(mean(range(circle$x)), table$circle_x_m[1])
  # A swing of some minutes is a line: its axes have scales of their own.
  short <- foucault_pendulum(seq(0, 60, 0.5), 49, length_m = 67, east_m = 3)
  expect_match(ggplot2::autoplot(short)$labels$subtitle, "its own scale")
  expect_null(ggplot2::autoplot(swing)$labels$subtitle)
})

test_that("a place of which a coordinate is missing is left out", {
  places <- data.frame(x = c(1, NA, 3, 4), y = c(1, 2, NA, 4))
  expect_equal(path_rows(places, c("x", "y"), rlang::current_env()), list(x = c(1, 4), y = c(1, 4)))
})
