test_that("a hoop is drawn with its axis, bead and quantities", {
  skip_if_not_installed("ggplot2")
  bead <- scene_hoop(0.05, 0.2, -9, theta0_rad = 1, omega0_rad_per_s = 2,
    resistance = resistance(drag_n_s_per_m = 0.1), static_friction = 0.2)
  drawing <- draw_hoop(bead)
  expect_true(all(c("R", "Omega", "theta", "m*g", "c", "mu[s]") %in% drawing$quantities$symbol))
  fills <- Filter(function(one) one$type == "fill", drawing$marks)
  middle <- colMeans(fills[[length(fills)]]$points[-1, ])
  expect_equal(middle, c(sin(1), -cos(1)), tolerance = 1e-6)
  expect_match(ggplot2::autoplot(bead)$labels$alt, "radius of the hoop 0.2 m")
})

test_that("frames show the hoop turned and the bead on it", {
  bead <- scene_hoop(0.05, 0.2, 2, theta0_rad = 1)
  motion <- trajectory(bead, c(0, pi / 4, pi / 2))
  frames <- hoop_frames(bead, motion)
  width <- vapply(frames, function(one) diff(range(one$marks[[2]]$points[, 1])), 0)
  expect_equal(width, 2 * abs(cos(2 * motion$time_s)), tolerance = 1e-3)
  skip_if_not_installed("gifski")
  skip_if_not_installed("ggplot2")
  film <- animate_motion(motion, tempfile(fileext = ".gif"), frames_per_s = 2, width_px = 100)
  expect_gt(file.size(film), 1000)
})
