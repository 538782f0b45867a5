skip_if_not_installed("ggplot2")

turned <- function() {
  place_body(body_box(10, 0.4, 0.6, 1), rotation = rotation_about("z", angle_deg = 30))
}

test_that("a tensor is its nine elements in their places", {
  tensor <- inertia_tensor(turned())
  plot <- ggplot2::autoplot(tensor)
  tiles <- plot$data
  for (i in 1:3) for (j in 1:3) {
    axes <- c("x", "y", "z")
    one <- tiles[tiles$row == axes[i] & tiles$column == axes[j], ]
    expect_equal(one$value, unclass(tensor)[i, j], tolerance = 1e-12)
    expect_equal(one$name, paste0("I[", axes[i], axes[j], "]"))
  }
  # x is above y above z, as in the matrix.
  built <- ggplot2::layer_data(plot, 1)
  expect_equal(built$y[tiles$row == "x" & tiles$column == "x"], 3, ignore_attr = TRUE)
  expect_match(plot$labels$alt, "Ixy 0.07217.*Izz 0.4333")
  expect_match(plot$labels$subtitle, "minus the integrals")
  plus <- ggplot2::autoplot(inertia_tensor(turned(), products = "positive"))
  expect_match(plus$labels$subtitle, "plus the integrals")
  bad <- tensor
  attr(bad, "products") <- 3
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(tensor, 2), class = "rotdyn_error_argument")
})

test_that("principal axes are drawn along their directions", {
  axes <- principal_axes(turned())
  drawing <- draw_principal(axes)
  lines <- Filter(function(one) one$style == "torque", drawing$marks)
  expect_length(lines, 6) # both ends of three
  flat <- view_of_space() %*% t(cbind(axes$x, axes$y, axes$z))
  for (one in lines) {
    way <- diff(one$points)[1, ]
    crossed <- abs(way[1] * flat[2, ] - way[2] * flat[1, ])
    expect_lt(min(crossed), 1e-9)
  }
  key <- drawing$quantities
  expect_equal(key$name[key$symbol == "I[1]"], "0.4333 kg m^2")
  expect_match(key$value[key$symbol == "I[2]"], "along \\(-?0.5, -?0.866, 0\\)")
  disk <- ggplot2::autoplot(principal_axes(body_disk(2, 0.25)))
  expect_match(disk$labels$alt, "plate.*0.03125 kg m\\^2 axis not unique.*along \\(0, 0, 1\\)")
  expect_error(ggplot2::autoplot(axes[1:2, ]), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(axes["x"]), class = "rotdyn_error_type")
  bad <- axes
  bad$x <- "x"
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  bad <- axes
  bad$unique <- as.double(bad$unique)
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (body in list(turned(), body_disk(1, 1), body_sphere(1, 1), body_rod(1, 1))) {
    for (size in c(13, 24)) {
      plot <- ggplot2::autoplot(principal_axes(body), base_size = size)
      expect_silent(ggplot2::ggplotGrob(plot))
    }
  }
})
