test_that("a collision is drawn before and after, in one scale", {
  skip_if_not_installed("ggplot2")
  hits <- list(
    ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, 0.75, 0.5),
    hinged_hit(body_rod(2, 1.2), 0.6, 1.1, 0.05, 30, 0.4), disks_lock(1, 3, 60, 0),
    rims_meet(1, 3, 60, 0, radius_1_m = 0.1, radius_2_m = 0.2),
    collide(body_rod(1, 1), velocity_1_m_per_s = c(0, 0, -3), normal = c(0, 0, 1),
      arm_1_m = c(-0.4, 0, -0.3), attitude_1 = rotation_about("y", angle_rad = -atan(0.75))),
    collide(body_sphere(1, 0.1), body_sphere(2, 0.1), velocity_1_m_per_s = c(0, 3, 0),
      normal = c(0.2, -1, 0.1))
  )
  for (hit in hits) {
    plot <- ggplot2::autoplot(hit)
    expect_silent(built <- ggplot2::ggplot_build(plot))
    expect_match(plot$labels$alt, "Before: .* After: ")
  }
  bounce <- hits[[1]]
  expect_few_labels(function(size) ggplot2::autoplot(bounce, base_size = size))
  plot <- ggplot2::autoplot(bounce)
  expect_match(plot$labels$alt, "Before: the ball: 20.6 m/s, 300 rad/s", fixed = TRUE)
  arrows <- Filter(function(data) "arrow" %in% names(data) || nrow(data) == 2L,
    lapply(seq_along(plot$layers), function(i) ggplot2::layer_data(plot, i)))
  moves <- Filter(function(data) all(c("xend", "yend") %in% names(data)), arrows)
  moves <- moves[[length(moves)]]
  expect_equal(
    (moves$xend - moves$x) / (moves$xend[1] - moves$x[1]), c(1, bounce$vx_m_per_s / 20),
    tolerance = 1e-12
  )
  expect_equal(plot$labels$x, "x from the contact (m)")
  expect_equal(ggplot2::autoplot(hits[[5]])$labels$y, "z (m)")
  expect_error(ggplot2::autoplot(bounce, row = 2), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(bounce, scale = 2), class = "rotdyn_error_argument")
  gone <- ball_bounce(body_sphere(1, 0.1), NA, -1)
  expect_error(ggplot2::autoplot(gone), class = "rotdyn_error_value")
})
