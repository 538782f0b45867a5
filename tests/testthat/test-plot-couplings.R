skip_if_not_installed("ggplot2")

at_time <- function(plot, kind, t) {
  one <- plot$data[plot$data$kind == kind & plot$data$panel == "over time (s)", ]
  stats::approx(one$at, one$value, t)$y
}

test_that("a brake is drawn over its time and over the rate, with what it holds at rest", {
  plot <- ggplot2::autoplot(brake(12, static_ratio = 1.5, from_s = 2, to_s = 3.5))
  expect_equal(at_time(plot, "slipping", c(1.9, 2.5, 3.6)), c(0, 12, 0))
  expect_equal(at_time(plot, "at rest, at most", c(1.9, 2.5, 3.6)), c(0, 18, 0))
  over <- plot$data[plot$data$panel == "over the angular velocity (rad/s)", ]
  expect_equal(over$value, 12 * sign(over$side))
  expect_equal(ggplot2::layer_data(plot, 4)$y, c(-18, 18))
  expect_match(plot$labels$alt, "at most 12 N m, and over the angular velocity; dots at 18 N m")
  alone <- ggplot2::autoplot(brake(5))
  expect_false("at rest, at most" %in% alone$data$kind)
  expect_equal(max(alone$data$value), 5)
})

test_that("a clutch follows its capacity, over the slip", {
  law <- torque_knots(c(0, 1), c(0, 30), outside = "hold")
  plot <- ggplot2::autoplot(coupling_clutch(law, static_ratio = 1.2))
  expect_equal(at_time(plot, "slipping", c(0.5, 1.05)), c(15, 30))
  expect_true("over the slip (rad/s)" %in% levels(plot$data$panel))
  expect_match(plot$labels$alt, "^A clutch.*dots at 36 N m")
})

test_that("a gear turns its second rotor as its ratio says", {
  wheels <- function(coupling) {
    drawing <- draw_coupling(coupling, is_coupling(coupling, "shaft"), coupling$ratio)
    boxes <- Filter(function(one) one$type == "fill" && one$style == "shaft", drawing$marks)
    arrows <- Filter(function(one) one$type == "arrow", drawing$marks)
    list(
      heights = vapply(boxes, function(one) diff(range(one$points[, 2])), 0),
      way = vapply(arrows, function(one) sign(diff(one$points[c(1, 61), 1])), 0),
      key = drawing$quantities, springs = sum(vapply(drawing$marks, function(one) {
        one$style == "spring"
      }, NA))
    )
  }
  turned <- wheels(coupling_gear(-3, efficiency = 0.97))
  expect_equal(turned$heights[2] / turned$heights[1], 3)
  expect_equal(turned$way[1], -turned$way[2])
  expect_equal(turned$key$value[turned$key$name == "efficiency"], "0.97")
  alike <- wheels(coupling_shaft(800, 0.05, ratio = 5))
  expect_equal(alike$heights[2] / alike$heights[1], 5)
  expect_equal(alike$way[1], alike$way[2])
  expect_equal(alike$springs, 1)
  expect_match(
    ggplot2::autoplot(coupling_shaft(800, 0.05, ratio = 5))$labels$alt,
    "stiffness 800 N m/rad; damping 0.05 N m s; rates without twist 1 to 1/5"
  )
})

test_that("a rotor has its angular velocity along its axis, in its sense", {
  view <- view_of_space()
  arrow <- function(rate) {
    drawing <- draw_rotor(rotor(c(0, 0, 1), 0.02, rate))
    one <- Find(function(one) one$type == "arrow" && one$style == "speed", drawing$marks)
    diff(one$points)
  }
  up <- arrow(300)
  expect_equal(up[1] / up[2], view[1, 3] / view[2, 3])
  expect_gt(up[2], 0)
  expect_equal(arrow(-300), -up)
  plot <- ggplot2::autoplot(rotor("x", 0.02, -300, 0.1))
  expect_match(plot$labels$alt, "rate relative to the body -300 rad/s; angular momentum -6 kg")
  expect_match(plot$labels$alt, "motor 0.1 N m")
})

test_that("they draw in letters of any size; what is damaged is refused", {
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (one in list(brake(5), coupling_gear(2), coupling_shaft(0), rotor("z", 1, 0))) {
    for (size in c(13, 24)) {
      expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(one, base_size = size)))
    }
    expect_error(ggplot2::autoplot(one, colour = 2), class = "rotdyn_error_argument")
    for (name in intersect(names(one), c("ratio", "static_ratio", "axis"))) one[[name]] <- "x"
    expect_error(ggplot2::autoplot(one), class = "rotdyn_error_type")
  }
})
