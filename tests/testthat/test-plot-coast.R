# omega = 20 exp(-0.1 t) - 4 (1 - exp(-0.1 t)): 0.4 rad/s^2 of dry friction, a rate of 0.1/s.
coasting <- function(time_s, noise = 0) {
  omega <- 24 * exp(-0.1 * time_s) - 4
  set.seed(1)
  data.frame(time_s, omega_rad_per_s = omega + stats::rnorm(length(time_s), 0, noise))
}

test_that("a coast-down's panels: the motion with its samples, residuals, the torque by speed", {
  skip_if_not_installed("ggplot2")
  samples <- coasting(0:80 / 10, 0.02)
  fit <- fit_coast_down(samples, losses = c("coulomb", "viscous"))
  plot <- ggplot2::autoplot(fit)
  built <- ggplot2::ggplot_build(plot)$data
  panels <- levels(plot$data$panel)
  expect_match(panels[1], "angular velocity (rad/s), by time (s)", fixed = TRUE)
  expect_match(panels[2], "residual (rad/s)", fixed = TRUE)
  expect_match(panels[3], "deceleration (rad/s^2)", fixed = TRUE)
  expect_few_labels(function(size) ggplot2::autoplot(fit, base_size = size))
  line <- plot$data[plot$data$panel == panels[1], ]
  expect_equal(range(line$x), c(0, 8))
  expect_lt(max(abs(line$y - coasting(line$x)$omega_rad_per_s)), 0.02)
  expect_true(all(line$lower < line$y & line$y < line$upper))
  # The deceleration a + b omega, positive for a body that slows down.
  torque <- plot$data[plot$data$panel == panels[3], ]
  expect_lt(max(abs(torque$y - (0.4 + 0.1 * torque$x))), 0.05)
  expect_true(all(torque$lower <= torque$y & torque$y <= torque$upper))
  points <- plot$layers[[2]]$data
  expect_equal(points$y[points$panel == panels[1]], samples$omega_rad_per_s)
  expect_equal(
    points$y[points$panel == panels[2]],
    samples$omega_rad_per_s - predict(fit, samples$time_s)$omega_rad_per_s
  )
  expect_match(plot$labels$alt, "falls from 20 to 6.78 rad/s", fixed = TRUE)
})

test_that("panels have some four values on their axes, fewer in large letters", {
  skip_if_not_installed("ggplot2")
  x <- fit_coast_down(trajectory(
    scene_axle(0.0625, NULL, resistance(0.00625, 2.5e-4, 0.075), omega0_rad_per_s = 20),
    seq(0, 8, length.out = 100)
  ))
  breaks <- function(base_size) {
    built <- ggplot2::ggplot_build(ggplot2::autoplot(x, base_size = base_size))
    lengths(lapply(built$layout$panel_scales_y, function(scale) {
      Filter(is.finite, scale$get_breaks())
    }))
  }
  expect_true(all(breaks(13) %in% 3:6))
  expect_true(all(breaks(26) %in% 1:4))
})

test_that("with a moment of inertia the last panel is a torque; runs are chosen", {
  skip_if_not_installed("ggplot2")
  fit <- fit_coast_down(
    coasting(0:80 / 10, 0.02), losses = c("coulomb", "viscous"), inertia = 0.5
  )
  plot <- ggplot2::autoplot(fit, run = 1)
  panels <- levels(plot$data$panel)
  expect_match(panels[3], "retarding torque (N m)", fixed = TRUE)
  torque <- plot$data[plot$data$panel == panels[3], ]
  expect_lt(max(abs(torque$y - 0.5 * (0.4 + 0.1 * torque$x))), 0.03)
  expect_error(ggplot2::autoplot(fit, run = 2), class = "rotdyn_error_value")
})

test_that("a falling weight is drawn with its torque, what is fitted is said", {
  skip_if_not_installed("ggplot2")
  plot <- ggplot2::autoplot(falling_weight(0.5, 0.02, until_s = 3, gravity_m_per_s2 = 10))
  expect_match(plot$labels$alt, "weight 5 N; torque, at most 0.1 N m; pulls until 3 s")
  expect_match(
    ggplot2::autoplot(falling_weight(NA, 0.02))$labels$alt,
    "mass is fitted.*weight is fitted.*until a time that is fitted"
  )
  bad <- falling_weight(0.5, 0.02)
  bad$radius_m <- "x"
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(falling_weight(1, 1), 2), class = "rotdyn_error_argument")
})
