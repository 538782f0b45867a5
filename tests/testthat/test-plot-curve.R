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
  places <- ggplot2::layer_data(plot, 2)
  expect_equal(nrow(places), 13)
  expect_error(ggplot2::autoplot(motion, size = 3), class = "rotdyn_error_argument")
})
