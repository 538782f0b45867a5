test_that("the path of an axis on the sphere, what lies behind apart", {
  skip_if_not_installed("ggplot2")
  tilted <- attitude_from(c(1, 0, 0, 1), "axis_angle")
  wheel <- scene_pivot(
    c(0.02, 0.02, 0.03), c(0, 0, 30), mass_kg = 2, centre_m = c(0, 0, 0.1), attitude0 = tilted
  )
  path <- axis_path(trajectory(wheel, seq(0, 3, by = 0.01)))
  plot <- ggplot2::autoplot(path)
  expect_s3_class(plot, "ggplot")
  expect_match(plot$labels$alt, "angle to the vertical 57.3 to 6[0-9.]+ degrees")
  # Points seen on the front are within the unit circle, and on the side of the reader.
  data <- lapply(plot$layers, function(layer) layer$data)
  on_path <- do.call(rbind, Filter(function(d) any(grepl("^path", d$part)), data))
  expect_lte(max(sqrt(on_path$x^2 + on_path$y^2)), 1 + 1e-12)
  up <- 25 * pi / 180
  toward <- c(cos(pi / 6) * cos(up), sin(pi / 6) * cos(up), sin(up))
  tip <- as.matrix(path[axis_path_columns[1:3]])
  expect_identical(sum(on_path$seen), sum(tip %*% toward >= 0))
  expect_error(ggplot2::autoplot(path[-2]), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(path[0, ]), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(path, size = 2), class = "rotdyn_error_argument")
})

test_that("the polhode lies on the ellipsoid, between the branches of the separatrix", {
  skip_if_not_installed("ggplot2")
  plot <- ggplot2::autoplot(polhode(scene_free(c(1, 2, 3), c(0.3, 4, 0.3))))
  expect_match(plot$labels$alt, "round the axis of the largest moment")
  # L^2 = 64.90 and 2 T I2 = 64.72 there, 65.62 and 66.16 here: which is larger decides.
  other <- ggplot2::autoplot(polhode(scene_free(c(1, 2, 3), c(0.9, 4, 0.3))))
  expect_match(other$labels$alt, "round the axis of the least moment")
  # Own axes that are not principal: the same picture.
  turned <- matrix(c(1.5, 0.5, 0, 0.5, 1.5, 0, 0, 0, 2.5), 3)
  expect_s3_class(ggplot2::autoplot(polhode(scene_free(turned, c(0.3, 1, 2)))), "ggplot")
  ball <- ggplot2::autoplot(polhode(scene_free(c(1, 1, 1), c(0, 0, 2))))
  expect_s3_class(ball, "ggplot")
  # Changed columns: a trajectory no more.
  expect_error(
    ggplot2::autoplot(polhode(scene_free(c(0, 1, 1), c(0, 1, 1)))), class = "rotdyn_error_value"
  )
})

test_that("the separatrix has the energy and the momentum of a turn about the middle axis", {
  skip_if_not_installed("ggplot2")
  seen <- NULL
  # What would be drawn, in three dimensions.
  space <- asNamespace("rotdyn")
  drawing <- space$surface_plot
  put <- function(f) {
    unlockBinding("surface_plot", space)
    assign("surface_plot", f, envir = space)
  }
  on.exit(put(drawing))
  put(function(shape, grid, paths, ..., dashed = NULL) seen <<- dashed)
  moments <- c(1, 2, 2.5)
  omega <- c(0.3, 4, 0.3)
  ggplot2::autoplot(polhode(scene_free(moments, omega)))
  energy <- sum(moments * omega^2)
  size <- sqrt(energy / min(moments))
  expect_length(seen, 2)
  for (curve in seen) {
    at <- curve * size
    expect_equal(as.vector(at^2 %*% moments), rep(energy, nrow(at)))
    expect_equal(as.vector(at^2 %*% moments^2), rep(energy * 2, nrow(at)))
  }
})
