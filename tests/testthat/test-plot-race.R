skip_if_not_installed("ggplot2")

test_that("a race is drawn with the order of its finish in words", {
  plot <- ggplot2::autoplot(roll_race(c("hoop", "sphere")))
  expect_s3_class(plot, "ggplot")
  text <- ggplot2::get_alt_text(plot)
  expect_match(text, "sphere arrives after 0.914 s; hoop arrives after 1.09 s", fixed = TRUE)
  built <- ggplot2::ggplot_build(plot)
  # Two bodies at five times; the finish at 1 m.
  expect_identical(length(unique(built$data[[3]]$group)), 10L)
  expect_identical(unique(built$data[[2]]$xintercept), 1)
  # Later is darker, in the first colour at the end.
  expect_true(rotdyn:::plot_colours[1] %in% built$data[[3]]$fill)
  expect_s3_class(ggplot2::autoplot(roll_race(time_s = c(0, 0.5)), time_s = 0.5), "ggplot")
})

test_that("what is no race, and unknown times", {
  race <- roll_race(time_s = c(0, 0.5))
  expect_error(ggplot2::autoplot(race, time_s = 0.4), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(race, size = 1), class = "rotdyn_error_argument")
  expect_error(ggplot2::autoplot(race, 7), "Unknown: `7`", class = "rotdyn_error_argument")
  expect_error(ggplot2::autoplot(roll_race(time_s = double())), class = "rotdyn_error_value")
  bare <- race
  attr(bare, "race") <- NULL
  expect_error(ggplot2::autoplot(bare), class = "rotdyn_error_type")
  expect_error(summary(bare), class = "rotdyn_error_type")
})

test_that("of many bodies the first are drawn, and the subtitle says so", {
  few <- ggplot2::autoplot(roll_race(c("hoop", "sphere")))$labels$subtitle
  expect_no_match(few, "the first")
  many <- data.frame(name = paste("body", 1:40), beta = seq(0.1, 1, length.out = 40))
  subtitle <- ggplot2::autoplot(roll_race(many))$labels$subtitle
  expect_match(gsub("\n", " ", subtitle), "the first [0-9]+ of 40")
})
