skip_if_not_installed("ggplot2")

two_segments <- function(n) {
  time <- c(seq_len(n), n + 10 * n + seq_len(n)) / 50
  motion_record(
    data.frame(time_s = time, theta_rad = 2 * time, omega_rad_per_s = 2, s = rep(1:2, each = n)),
    time_s = time_s, theta_rad = theta_rad, omega_rad_per_s = omega_rad_per_s, segment = s
  )
}

test_that("angle and rate have panels, few samples are points, with what was read", {
  plot <- ggplot2::autoplot(two_segments(20))
  built <- ggplot2::ggplot_build(plot)
  expect_equal(nrow(built$layout$layout), 2)
  expect_s3_class(plot$layers[[1]]$geom, "GeomPoint")
  expect_match(plot$labels$subtitle, "40 samples in 2 segments")
  expect_match(plot$labels$subtitle, "50 Hz")
  expect_match(plot$labels$alt, "angular velocity")
  expect_few_labels(function(size) ggplot2::autoplot(two_segments(20), base_size = size))
})

test_that("the subtitle names the file", {
  file <- text_file(c("t (s),theta (rad)", paste(0:19 / 10, 2 * 0:19 / 10, sep = ",")))
  plot <- ggplot2::autoplot(read_motion(file))
  expect_match(plot$labels$subtitle, paste("20 samples from", basename(file)), fixed = TRUE)
})

test_that("no line joins segments or the sides of a missing value", {
  record <- two_segments(300)
  built <- ggplot2::ggplot_build(ggplot2::autoplot(record))
  line <- built$data[[1]]
  apart <- tapply(line$x, list(line$PANEL, line$group), function(x) max(diff(x)))
  expect_lt(max(apart, na.rm = TRUE), 0.021)
  expect_identical(unique(line$colour), rotdyn:::plot_colours[1])
  record$theta_rad[100] <- NA
  line <- ggplot2::ggplot_build(ggplot2::autoplot(record))$data[[1]]
  expect_equal(length(unique(line$group[line$PANEL == 1])), 3)
})

test_that("units are converted", {
  record <- two_segments(20)
  built <- ggplot2::ggplot_build(ggplot2::autoplot(record, units = c("degree", "rpm")))
  dots <- built$data[[1]]
  expect_equal(dots$y[dots$PANEL == 1], record$theta_rad * 180 / pi)
  expect_equal(dots$y[dots$PANEL == 2], record$omega_rad_per_s * 30 / pi)
  expect_error(ggplot2::autoplot(record, unit = "rpm"), class = "rotdyn_error_argument")
})
