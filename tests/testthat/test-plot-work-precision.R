test_that("the work-precision diagram draws without a warning", {
  skip_if_not_installed("ggplot2")
  measured <- work_precision(
    article_scene(), 0:8, accuracies = 10^-c(3, 6, 9),
    peers = list(still = function(scene, time_s, accuracy) {
      list(theta_rad = 0 * time_s, omega_rad_per_s = 0 * time_s)
    }),
    min_batch_s = 1e-4, batches = 1
  )
  for (rows in list(seq_len(nrow(measured)), 1, which(measured$model == "axle_rk8pd"))) {
    drawn <- measured[rows, ]
    expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(drawn)))
    # The points of all layers: true errors above the floor, at the floor, reported.
    at <- function(shape) {
      is_point <- vapply(built$plot$layers, function(l) inherits(l$geom, "GeomPoint"), logical(1))
      points <- Filter(nrow, built$data[is_point])
      sort(unlist(lapply(points, function(layer) layer$y[layer$shape == shape])))
    }
    # The floor is grey from one side to the other, below all that is shown above it.
    floor <- built$data[[1]]
    expect_lt(floor$xmin, min(log10(drawn$cost_s)))
    expect_gt(floor$xmax, max(log10(drawn$cost_s)))
    expect_equal(at(16), sort(log10(drawn$true_error[!drawn$floor])))
    expect_equal(at(6), sort(log10(drawn$true_error[drawn$floor])))
    expect_equal(at(1), sort(log10(drawn$error[!is.na(drawn$error)])))
  }
})

test_that("a peer without numbers has no point", {
  skip_if_not_installed("ggplot2")
  measured <- work_precision(
    article_scene(), 0:8, "axle_linear", 1e-3,
    peers = list(lost = function(scene, time_s, accuracy) {
      list(theta_rad = c(time_s[-1], NA), omega_rad_per_s = 0 * time_s)
    }),
    min_batch_s = 1e-4, batches = 1
  )
  expect_equal(measured$true_error[2], NA_real_)
  expect_equal(measured$floor[2], NA)
  drawn <- ggplot2::autoplot(measured)
  expect_silent(ggplot2::ggplot_build(drawn))
  expect_equal(as.character(drawn$data$model), "axle_linear")
})

test_that("labels of costs and accuracies", {
  expect_equal(format_cost(c(2e-5, 9.9e-4, 1e-3, 0.25, 3, NA)), c(
    "20 us", "990 us", "1 ms", "250 ms", "3 s", NA
  ))
  expect_equal(format_asked(c(1e-3, 1e-12, 1, 0.1)), c("1e-3", "1e-12", "1e+0", "1e-1"))
  expect_equal(padded(c(1, 100), 0.5, 1), c(0.1, 1e4))
  ends <- padded(5, 0, 0)
  expect_equal(ends[2] / ends[1], 10)
  expect_equal(prod(ends), 25)
})

test_that("the grey band ends at three times the error of the reference", {
  skip_if_not_installed("ggplot2")
  measured <- work_precision(
    article_scene(), 0:8, "axle_rk8pd", accuracies = 10^-c(3, 6, 9), min_batch_s = 1e-4,
    batches = 1
  )
  measured$reference_error <- measured$true_error[2] / 3
  band <- ggplot2::ggplot_build(ggplot2::autoplot(measured))$data[[1]]
  expect_equal(band$ymax, log10(measured$true_error[2]), tolerance = 1e-12)
  expect_lt(band$ymin, log10(min(measured$true_error)))
})
