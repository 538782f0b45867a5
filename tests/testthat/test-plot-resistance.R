skip_if_not_installed("ggplot2")

test_that("a resistance is drawn with its parts", {
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  all <- resistance(0.03, quadratic_n_m_s2 = 0.002, coulomb_n_m = 0.1, static_n_m = 0.15)
  plot <- ggplot2::autoplot(all, largest = 20)
  drawn <- plot$data
  at <- function(part, x) {
    one <- drawn[drawn$part == part, ]
    stats::approx(one$x, one$y, x)$y
  }
  expect_equal(at("viscous", c(-20, 10)), c(-0.6, 0.3))
  expect_equal(at("quadratic", c(-20, 20)), c(-0.8, 0.8))
  expect_equal(at("dry friction", c(-20, 20)), c(-0.1, 0.1))
  expect_equal(at("together", 20), 0.1 + 0.6 + 0.8)
  dots <- ggplot2::layer_data(plot, 4)
  expect_equal(dots$y, c(-0.15, 0.15))
  for (one in list(
    all, resistance(0.03), resistance(coulomb_n_m = 2), resistance(damping_per_s = 0.1),
    resistance(drag_n_s_per_m = 1, drag_n_s2_per_m2 = 0.5), resistance(-0.1, 0.2)
  )) {
    for (size in c(13, 24)) {
      expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(one, base_size = size)))
    }
  }
  expect_match(plot$labels$alt, "dry friction 0.1, viscous 0.03, quadratic 0.002")
  expect_error(ggplot2::autoplot(resistance()), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(all, largest = 0), class = "rotdyn_error_value")
})

test_that("knots are drawn with what is before and after them", {
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  plot <- ggplot2::autoplot(inertia_knots(c(1, 2), c(5, 2)))
  expect_equal(plot$data$y, c(5, 5, 2, 2))
  expect_silent(ggplot2::ggplotGrob(plot))
  expect_match(plot$labels$alt, "from 5 to 2 kg m^2", fixed = TRUE)
})

test_that("drag along a line is drawn where a damping is given beside it", {
  plot <- ggplot2::autoplot(resistance(damping_per_s = 0.1, drag_n_s_per_m = 2), largest = 5)
  linear <- plot$data[plot$data$part == "linear", ]
  expect_equal(range(linear$y), c(-10, 10))
})
