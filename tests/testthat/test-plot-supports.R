skip_if_not_installed("ggplot2")

arrows_of <- function(support, style = "torque") {
  marks <- Filter(function(one) one$type == "arrow" && one$style == style,
                  draw_support(support)$marks)
  lapply(marks, function(one) one$points)
}

test_that("a surface only pushes, along its normal, with friction along it", {
  surface <- support_surface(c(4, 0), normal = c(-3, 4), friction = 0.4, name = "floor")
  push <- arrows_of(surface)
  expect_length(push, 1)
  expect_equal(push[[1]][2, ], c(0, 0))
  expect_equal(diff(push[[1]])[1, ] / sqrt(sum(diff(push[[1]])^2)), c(-0.6, 0.8))
  friction <- arrows_of(surface, "resistance")
  expect_length(friction, 2)
  for (one in friction) expect_equal(sum(diff(one) * c(-3, 4)), 0)
  expect_length(arrows_of(support_surface(c(4, 0), c(0, 1)), "resistance"), 0)
  plot <- ggplot2::autoplot(surface)
  expect_match(plot$labels$alt, "Floor: a surface. push; friction, either sense; static friction")
})

test_that("the piece of the body lies across the normal, to the right without one", {
  along <- function(support) {
    piece <- Find(function(one) one$style == "body", draw_support(support)$marks)$points
    long <- diff(piece)[which.max(rowSums(diff(piece)^2)), ]
    abs(long / sqrt(sum(long^2)))
  }
  expect_equal(along(support_surface(c(4, 0), normal = c(-3, 4))), c(0.8, 0.6))
  expect_equal(along(support_roller(c(1, 2), normal = c(1, 0))), c(0, 1))
  expect_equal(along(support_pin(c(1, 2))), c(1, 0))
})

test_that("each support has the unknowns that it has in an equilibrium", {
  supports <- list(
    support_pin(c(0, 0)), support_roller(c(0, 0)), support_fixed(c(0, 0)),
    support_rod(c(0, 0), c(1, 1)), support_cable(c(0, 0), c(1, 1)), support_pin(c(0, 0, 0)),
    support_fixed(c(0, 0, 0)), support_hinge(c(0, 0, 0), "x"),
    support_hinge(c(0, 0, 0), "x", slides = TRUE), support_surface(c(0, 0, 0), c(0, 0, 1), 1)
  )
  forces <- vapply(supports, function(one) {
    ncol(support_unknowns(one, length(one$at_m) == 2L)$force)
  }, 1L)
  # As the table of their help page says.
  expect_equal(forces, c(2, 1, 2, 1, 1, 3, 3, 3, 2, 3))
  cable <- arrows_of(supports[[5]])
  expect_length(cable, 1) # a pull, to the anchor
  expect_equal(diff(cable[[1]])[1, 1], diff(cable[[1]])[1, 2])
  expect_gt(cable[[1]][2, 1], 0)
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (one in supports) {
    for (size in c(13, 24)) {
      expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(one, base_size = size)))
    }
  }
  expect_match(ggplot2::autoplot(supports[[3]])$labels$alt, "couple, either sense")
})

test_that("what is no support is refused", {
  bad <- support_pin(c(0, 0))
  bad$at_m <- "here"
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(support_pin(c(0, 0)), 2), class = "rotdyn_error_argument")
})
