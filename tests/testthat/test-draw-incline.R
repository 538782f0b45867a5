test_that("an incline is drawn at its angle, with its quantities", {
  scene <- scene_incline(
    body_sphere(6, 0.11), 30, static_friction = 0.3, v0_m_per_s = -2, omega0_rad_per_s = 5,
    rolling_arm_m = 0.001
  )
  drawing <- draw_incline(scene)
  ground <- drawing$marks[[1]]$points
  # 30 degrees: the slope falls by tan(30) of its width.
  expect_equal((ground[1, 2] - ground[2, 2]) / (ground[2, 1] - ground[1, 1]), 0.5773502691896258)
  # The ball touches the slope: its lowest point along the normal lies on it.
  normal <- c(0.5, sqrt(3) / 2)
  expect_equal(min(drawing$marks[[2]]$points %*% normal), 0, tolerance = 1e-3)
  expect_true(all(
    c("alpha", "m*g", "v[0]", "omega[0]", "mu[s]", "mu[k]", "b") %in% drawing$quantities$symbol
  ))
  flat <- draw_incline(scene_incline(body_hoop(1, 0.3), 0, gravity_m_per_s2 = 0))
  expect_false("m*g" %in% flat$quantities$symbol)
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(scene), "ggplot")
})

test_that("marks on the ground hang below it, each fifth one longer", {
  scene <- scene_incline(body_sphere(6, 0.11), 30, static_friction = 0.9)
  motion <- trajectory(scene, c(0, 0.5, 1))
  frame <- incline_frames(scene, motion)[[2]]
  lines <- Filter(function(one) one$type == "line" && one$style == "shaft", frame$marks)
  out <- c(0.5, sqrt(3) / 2)
  depth <- vapply(lines, function(one) {
    drop((one$points[2, ] - one$points[1, ]) %*% out)
  }, 0)
  expect_gt(length(depth), 5)
  expect_true(all(depth < 0))
  expect_equal(sort(unique(round(-depth, 9))), c(0.04, 0.08))
})

test_that("the forces are drawn where they act, in one scale, with their values", {
  scene <- scene_incline(body_sphere(2, 0.1), 30, static_friction = 0.9)
  drawing <- draw_incline(scene)
  arrow <- function(style) {
    Filter(function(one) one$type == "arrow" && one$style == style, drawing$marks)[[1]]$points
  }
  long <- function(p) sqrt(sum((p[2, ] - p[1, ])^2))
  weight <- 2 * 9.80665
  # A ball that rolls: friction is 2/7 of the force along the slope, uphill.
  friction <- 2 / 7 * weight / 2
  value <- function(symbol) drawing$quantities$value[drawing$quantities$symbol == symbol]
  expect_equal(value("N"), value_text(weight * sqrt(3) / 2, "N"))
  expect_equal(value("F[f]"), value_text(friction, "N"))
  expect_equal(long(arrow("torque")) / long(arrow("weight")), sqrt(3) / 2)
  expect_equal(long(arrow("resistance")) / long(arrow("weight")), friction / weight)
  expect_equal(diff(arrow("resistance")) / long(arrow("resistance")), cbind(-sqrt(3) / 2, 0.5))
  # Both begin at the contact, the weight in the middle of the body.
  expect_equal(arrow("torque")[1, ], arrow("resistance")[1, ])
  circle <- drawing$marks[[2]]$points
  expect_equal(arrow("weight")[1, ], colMeans(circle[-1, ]), tolerance = 1e-6)
})
