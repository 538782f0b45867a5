skip_if_not_installed("ggplot2")

reach <- function(plot, panel, column) {
  unname(range(plot$data[plot$data$panel == panel, column]))
}

test_that("a domain reaches as far as its sizes say, about its centre", {
  plot <- ggplot2::autoplot(domain_cylinder(0.5, 2, inner_radius_m = 0.4, centre_m = c(1, 0, 3)))
  expect_equal(reach(plot, "y over x", "across"), c(0.5, 1.5), tolerance = 1e-3)
  expect_equal(reach(plot, "z over x", "up"), c(2, 4))
  rings <- plot$data[plot$data$panel == "y over x", ]
  expect_equal(
    range(sqrt((rings$across - 1)^2 + rings$up^2)), c(0.4, 0.5), tolerance = 1e-9
  )
  expect_match(plot$labels$alt, "radius 0.5 m, length 2 m, inner radius 0.4 m.*2 to 4 m along z")
  ball <- ggplot2::autoplot(domain_ellipsoid(3, 2, 1))
  expect_equal(reach(ball, "z over y", "across"), c(-2, 2), tolerance = 1e-3)
  expect_equal(reach(ball, "z over y", "up"), c(-1, 1))
  box <- ggplot2::autoplot(domain_box(c(0, 0, 0), c(1, 2, 3)))
  expect_equal(reach(box, "z over y", "up"), c(0, 3))
  half <- ggplot2::autoplot(domain_cylinder(1, 1, angle_rad = c(0, pi)))
  expect_equal(reach(half, "y over x", "up"), c(0, 1), tolerance = 1e-3)
})

test_that("walls are drawn by their two faces, with lines all around", {
  lines_of <- function(domain) {
    wires <- domain_wires(domain, NULL)
    split(as.data.frame(wires$points), wires$wire)
  }
  span <- function(x) diff(range(x))
  lines <- lines_of(domain_cylinder(0.5, 2, inner_radius_m = 0.4))
  upright <- Filter(function(one) span(one$z) > 1.9, lines)
  angle <- vapply(upright, function(one) atan2(one$y[1], one$x[1]) %% (2 * pi), 0)
  expect_equal(sort(unique(round(angle * 4 / pi) %% 8)), 0:7)
  expect_equal(angle, round(angle * 4 / pi) * pi / 4, ignore_attr = TRUE)
  radius <- function(one) sqrt(one$x^2 + one$y^2)
  rings <- Filter(function(one) span(one$z) == 0 && span(radius(one)) < 1e-9, lines)
  expect_setequal(round(vapply(rings, function(one) radius(one)[1], 0), 9), c(0.4, 0.5))
})

test_that("a map is drawn by its points, a predicate by its cells", {
  map <- domain_map(
    function(u, v, w) list(2 * u, v, w + 5), function(u, v, w) 2 + 0 * u, c(0, 0, 0), c(1, 1, 1)
  )
  plot <- ggplot2::autoplot(map)
  expect_equal(reach(plot, "z over x", "across"), c(0, 2))
  expect_equal(reach(plot, "z over x", "up"), c(5, 6))
  ball <- domain_inside(function(x, y, z) x^2 + y^2 + z^2 < 1, rep(-1, 3), rep(1, 3))
  cells <- ggplot2::autoplot(ball)
  one <- cells$data[cells$data$panel == "y over x", ]
  expect_true(all(one$across^2 + one$up^2 < 1))
  expect_false(any(duplicated(one[c("across", "up")])))
  # The shadow has the area of a circle.
  expect_equal(nrow(one) * (2 / 48)^2, pi, tolerance = 0.02)
})

test_that("what cannot be drawn is refused", {
  nothing <- domain_inside(function(x, y, z) x > 5, rep(-1, 3), rep(1, 3))
  expect_error(ggplot2::autoplot(nothing), class = "rotdyn_error_value")
  # A map that leaves the doubles elsewhere than where it was checked.
  moved <- domain_map(
    function(u, v, w) list(u, v, w), function(u, v, w) 1 + 0 * u, c(0, 0, 0), c(1, 1, 1)
  )
  for (map in list(function(u, v, w) list(u, v / 0, w), function(u, v, w) list(u, v))) {
    moved$map <- map
    expect_error(
      ggplot2::autoplot(moved), "no finite points", class = "rotdyn_error_value"
    )
  }
  bad <- domain_ball(1)
  bad$chart <- "x"
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(domain_ball(1), 2), class = "rotdyn_error_argument")
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (size in c(13, 24)) {
    expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(domain_ball(1), base_size = size)))
  }
})
