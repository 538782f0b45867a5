test_that("a free body is drawn as the ellipsoid of its second moments", {
  scene <- scene_free(
    c(1, 2, 2.5), c(0, 0, 2), torque = c(1, 0, 0), resistance = resistance(damping_per_s = 0.1)
  )
  drawing <- draw_free(scene)
  expect_true(all(c("I[1]", "omega", "L", "tau", "gamma") %in% drawing$quantities$symbol))
  # omega along z of the body, which is up: its arrow is vertical, and L lies on it.
  arrows <- Filter(function(one) one$type == "arrow", drawing$marks)
  expect_equal(arrows[[1]]$points[2, 1], 0)
  expect_equal(arrows[[2]]$points[2, 1], 0)
  # Turned by a quarter about x, z points along -y: left in the view, and a little up.
  turned <- draw_free(scene_free(
    c(1, 2, 2.5), c(0, 0, 2), attitude0 = rotation_about("x", angle_deg = 90)
  ))
  tip <- Filter(function(one) one$type == "arrow", turned$marks)[[1]]$points[2, ]
  expect_equal(tip[2] / tip[1], -tan(pi / 6) * sin(25 * pi / 180))
  expect_lt(tip[1], -1)
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(scene), "ggplot")
})

test_that("no name of an axis is at an arrow or at another name", {
  drawing <- draw_free(scene_free(body_box(2, 0.5, 0.9, 1.3), c(1, 2, 3)))
  at <- as.matrix(drawing$labels[c("x", "y")])
  expect_gt(min(dist(at)), 0.3)
  arrows <- Filter(function(one) one$type == "arrow", drawing$marks)
  along <- do.call(rbind, lapply(arrows, function(one) {
    outer(0:20 / 20, one$points[2, ]) + outer(20:0 / 20, one$points[1, ])
  }))
  names <- at[grepl("^I", drawing$labels$symbol), ]
  expect_gt(min(as.matrix(dist(rbind(names, along)))[1:3, -(1:3)]), 0.3)
  # At rest there are no arrows.
  expect_equal(nrow(draw_free(scene_free(c(1, 2, 2.5), c(0, 0, 0)))$labels), 3)
})
