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
test_that("rotors and a clutch draw without a warning, and show their numbers", {
  skip_if_not_installed("ggplot2")
  time <- seq(0, 2, by = 0.1)
  rotors <- trajectory(scene_rotors(c(1, 2, 1), 50, torque_n_m = c(1, 0, 0)), time, 1e-9)
  clutch <- trajectory(scene_clutch(2, 3, 12, omega1_rad_per_s = 10), time, 1e-9)
  for (motion in list(rotors, clutch)) {
    expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(motion)))
    expect_gt(nrow(built$data[[1]]), 0)
  }
  drawn <- ggplot2::autoplot(clutch)$data
  expect_equal(drawn$value[drawn$panel == "heat (J)"], clutch$heat_j)
  drawn <- ggplot2::autoplot(rotors)$data
  expect_equal(sum(drawn$line == "rotor 3"), length(time))
  expect_equal(sum(drawn$line == "rotor 1"), 2 * length(time))
})
