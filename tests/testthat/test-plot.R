test_that("a trajectory and a rolling table draw without a warning", {
  skip_if_not_installed("ggplot2")
  for (object in list(spin_up(), rolling_table(), rolling_table(data.frame(beta = c(1, 1))))) {
    expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(object)))
    expect_gt(nrow(built$data[[1]]), 0)
  }
})

test_that("the plot shows the numbers of the table", {
  skip_if_not_installed("ggplot2")
  motion <- spin_up(time_s = 0:8)
  drawn <- ggplot2::autoplot(motion)$data
  theta <- drawn[drawn$panel == "angle (rad)", ]
  expect_equal(theta$value, motion$theta_rad)
  damping <- drawn[drawn$line == "damping", ]
  expect_equal(damping$value, motion$damping_torque_n_m)
})
