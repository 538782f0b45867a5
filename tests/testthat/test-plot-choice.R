skip_if_not_installed("ggplot2")

test_that("the models that apply stand at their cost and error, the chosen one is marked", {
  choice <- choose_model(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 0.3), time_s = 0:10)
  plot <- ggplot2::autoplot(choice)
  applies <- choice[choice$applies, ]
  expect_setequal(plot$data$model, applies$model)
  drawn <- plot$data[match(applies$model, plot$data$model), ]
  expect_equal(drawn$cost, applies$cost_s)
  expect_equal(drawn$error, applies$error)
  expect_equal(drawn$chosen, applies$chosen)
  built <- ggplot2::layer_data(plot, 1)
  expect_equal(10^built$x, plot$data$cost)
  expect_equal(10^built$y, plot$data$error)
  expect_equal(unique(built$colour[plot$data$chosen]), plot_colours[2])
  expect_match(plot$labels$title, "axle_pendulum")
  expect_match(plot$labels$alt, "Error over cost of 3 models. Chosen: axle_pendulum.*7 more do not")
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (size in c(13, 24)) {
    expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(choice, base_size = size)))
  }
  expect_error(ggplot2::autoplot(choice[!choice$applies, ]), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(choice["model"]), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(choice, 2), class = "rotdyn_error_argument")
  choice$error <- "x"
  expect_error(ggplot2::autoplot(choice), class = "rotdyn_error_type")
})
