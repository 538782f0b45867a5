# The rolling table is in test-plot-rolling.R, trajectories in test-plot-trajectory.R.
skip_if_not_installed("ggplot2")

test_that("articles are right", {
  words <- c("annulus", "disk", "elliptic_plate", "half disk", "octahedron", "uniform rod", "urn")
  expect_equal(
    rotdyn:::with_article(words),
    c("an annulus", "a disk", "an elliptic plate", "a half disk", "an octahedron", "a uniform rod",
      "an urn")
  )
  expect_equal(
    rotdyn:::with_article(c("points", "weights", "glass", "torus", "axis")),
    c("points", "weights", "a glass", "a torus", "an axis")
  )
})

test_that("unknown arguments and letters of no size are refused by every picture", {
  objects <- list(
    spin_up(time_s = 0:2), rolling_table(), body_disk(2, 0.25),
    compare_runs(spin_up(time_s = 0:2))
  )
  for (object in objects) {
    expect_error(
      ggplot2::autoplot(object, colour = "red"), "colour", class = "rotdyn_error_argument"
    )
    expect_error(ggplot2::autoplot(object, base_size = 0), class = "rotdyn_error_value")
    expect_error(ggplot2::autoplot(object, base_size = "big"), class = "rotdyn_error_type")
    theme <- ggplot2::autoplot(object, base_size = 24)$theme
    expect_equal(theme$text$size, 24)
    expect_gt(nchar(ggplot2::autoplot(object)$labels$alt), 30)
  }
})

test_that("seven lines have seven colours, more have other types", {
  expect_equal(anyDuplicated(rotdyn:::line_colours(7)), 0)
  expect_false("#F0E442" %in% rotdyn:::line_colours(7)) # yellow on white
  pairs <- paste(rotdyn:::line_colours(20), rotdyn:::plot_types(20))
  expect_equal(anyDuplicated(pairs), 0)
})

test_that("factors of units are those of their definitions", {
  factors <- rotdyn:::plot_units
  expect_equal(90, pi / 2 * factors$rad[["degree"]])
  expect_equal(1, 2 * pi * factors$rad[["turn"]])
  expect_equal(60, 2 * pi * factors[["rad/s"]][["rpm"]])
  expect_equal(360, 2 * pi * factors[["rad/s"]][["degree/s"]])
  expect_equal(2, 7200 * factors$s[["h"]])
  expect_equal(1, 3600 * factors$J[["W h"]])
})

test_that("text is wrapped to a width, a unit stays whole", {
  lines <- strsplit(rotdyn:::wrap_text(strrep("word ", 40), 24), "\n")[[1]]
  expect_true(all(nchar(lines) * 24 * 0.5 <= 7 * 72))
  expect_equal(rotdyn:::wrap_label("angle (rad)", 10, 3), "angle (rad)")
  expect_equal(
    rotdyn:::wrap_label("angular momentum (kg m^2/s)", 18, 2.5), "angular momentum\n(kg m^2/s)"
  )
})

test_that("plot() draws what autoplot() draws, of every class that has one", {
  skip_if_not_installed("ggplot2")
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  picture <- plot(trajectory(scene_axle(2, 3), 0:4))
  expect_s3_class(picture, "ggplot")
  same <- ggplot2::autoplot(trajectory(scene_axle(2, 3), 0:4))
  expect_identical(picture$labels$alt, same$labels$alt)
  expect_s3_class(plot(scene_axle(2, 3), base_size = 20), "ggplot")
  expect_error(plot(scene_axle(2, 3), col = 2), class = "rotdyn_error_argument")
  names <- grep("^autoplot[.]rot_", ls(asNamespace("rotdyn")), value = TRUE)
  for (class in sub("autoplot.", "", names, fixed = TRUE)) {
    expect_identical(utils::getS3method("plot", class), plot_by_autoplot)
  }
})

test_that("breaks are round values within the limits, to both ends", {
  expect_identical(rotdyn:::plot_breaks(13)(c(0, 10)), c(0, 2, 4, 6, 8, 10))
  expect_identical(rotdyn:::plot_breaks(13)(c(0.2, 9.7)), c(2, 4, 6, 8))
  expect_lte(length(rotdyn:::plot_breaks(26)(c(0, 10))), 3)
})

test_that("margins grow with the letters, but less", {
  gap <- function(size) as.numeric(plot_theme(size)$plot.title$margin)[3]
  expect_gt(gap(20), gap(10))
  expect_lt(gap(20), 2 * gap(10))
})
