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
  lines <- Filter(function(one) one$type == "line" && one$style == "body", frame$marks)
  out <- c(0.5, sqrt(3) / 2)
  depth <- vapply(utils::head(lines, -1), function(one) {
    drop((one$points[2, ] - one$points[1, ]) %*% out)
  }, 0)
  expect_gt(length(depth), 5)
  expect_true(all(depth < 0))
  expect_equal(sort(unique(round(-depth, 9))), c(0.04, 0.08))
})
