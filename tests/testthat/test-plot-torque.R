skip_if_not_installed("ggplot2")

lines_of <- function(...) ggplot2::autoplot(...)$data

test_that("a law is drawn as the models read it", {
  # The C core's torque column of a motion under the law, at the times drawn.
  laws <- list(
    article_torque(), torque_steps(c(0, 2, 5), c(0.8, 0.3, 0)), torque_constant(2),
    torque_polynomial(c(0, 1, 3), rbind(c(0, 0, 3), c(3, -1, 0))),
    torque_sinusoid(2, 3, 0.5, from_s = 1, to_s = 4), torque_exponential(3, 0.7),
    torque_pulse(1, 0.2, 3) + torque_sinusoid(0.5, 20),
    torque_function(function(time_s) sin(time_s), breaks_s = numeric())
  )
  for (law in laws) {
    drawn <- lines_of(law, time_s = c(0, 5))
    # At the end of a pulse the drawing has the value after it.
    drawn <- drawn[drawn$at != 1.2, ]
    motion <- trajectory(scene_axle(2, law), drawn$at)
    expect_equal(drawn$value, motion$applied_torque_n_m, tolerance = 1e-9)
  }
  # Of angle and rate, at the states of a motion.
  for (law in list(torque_spring(3, 0.2), torque_gravity(1, 0.5, 0.3))) {
    motion <- trajectory(scene_axle(2, law, omega0_rad_per_s = 1), seq(0, 3, by = 0.1))
    expect_equal(
      rotdyn:::law_values(law, motion$theta_rad, NULL), motion$applied_torque_n_m,
      tolerance = 1e-12
    )
  }
  for (law in list(torque_motor(2, 30), torque_curve(c(0, 1, 3), c(2, 2.5, 0)))) {
    motion <- trajectory(scene_axle(2, law), seq(0, 3, by = 0.1))
    expect_equal(
      rotdyn:::law_values(law, motion$omega_rad_per_s, NULL), motion$applied_torque_n_m,
      tolerance = 1e-12
    )
  }
})

test_that("each variable has a panel, the range shows the law", {
  drawn <- lines_of(torque_motor(2, 300) + torque_pulse(1, 0.2, 3) + torque_spring(1))
  expect_equal(
    levels(drawn$panel),
    c("over time (s)", "over angular velocity (rad/s)", "over angle (rad)")
  )
  time <- drawn[drawn$panel == "over time (s)", ]
  expect_lt(min(time$at), 1)
  expect_gt(max(time$at), 1.2)
  expect_equal(range(time$value), c(0, 3))
  expect_equal(range(lines_of(torque_sinusoid(1, 2))$at), c(0, 3 * pi))
  expect_equal(rotdyn:::law_range(list(torque_sinusoid(1, 2)), "time"), c(0, 3 * pi))
  # A jump is upright: both sides of it are drawn.
  expect_true(all(c(1, 1.2) %in% time$at))
})

test_that("ranges are checked, functions that fail too; laws draw without a warning", {
  law <- article_torque()
  expect_error(ggplot2::autoplot(law, time_s = 1), class = "rotdyn_error_size")
  expect_error(ggplot2::autoplot(law, time_s = c(2, 1)), class = "rotdyn_error_value")
  bad <- torque_function(function(time_s) NaN, breaks_s = numeric())
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_torque")
  of_state <- torque_function(function(time_s, theta_rad, omega_rad_per_s) time_s - omega_rad_per_s)
  expect_match(ggplot2::autoplot(of_state)$labels$subtitle, "theta = 0")
  for (one in list(law, of_state, torque_motor(2, 300) + law, 0.5 * torque_spring(2))) {
    for (size in c(13, 24)) {
      expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(one, base_size = size)))
    }
  }
})

test_that("the knots of a law are marked where they are in the picture", {
  law <- torque_knots(c(0, 1, 4, 6), c(0, 0.8, 0.3, 0))
  marks <- function(...) {
    plot <- ggplot2::autoplot(law, ...)
    is_point <- vapply(plot$layers, function(layer) inherits(layer$geom, "GeomPoint"), NA)
    do.call(rbind, lapply(plot$layers[is_point], function(layer) layer$data))
  }
  expect_equal(sort(unique(marks()$at)), c(0, 1, 4, 6))
  expect_equal(sort(unique(marks(time_s = c(0.5, 5))$at)), c(1, 4))
})

test_that("a force is drawn over its time, on both sides of its breaks", {
  push <- force_function(function(time_s) if (time_s < 1) 20 else 0, breaks_s = 1)
  plot <- ggplot2::autoplot(push)
  expect_equal(plot$data$value, ifelse(plot$data$at < 1, 20, 0))
  expect_equal(range(plot$data$at), c(0, 1.25))
  expect_lt(min(abs(plot$data$at[plot$data$at < 1] - 1)), 1e-8)
  expect_match(plot$labels$alt, "0 to 20 N, over time, 0 to 1.25 s, with breaks at 1 s")
  state <- force_function(function(time_s, x_m, v_m_per_s) time_s - x_m)
  plot <- ggplot2::autoplot(state, time_s = c(2, 4))
  expect_equal(plot$data$value, plot$data$at)
  expect_match(plot$labels$subtitle, "position and velocity are 0")
  wild <- force_function(function(time_s) 1 / (time_s - time_s))
  expect_error(ggplot2::autoplot(wild), class = "rotdyn_error_value")
  bad <- push
  bad$f <- 2
  expect_error(ggplot2::autoplot(bad), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(push, 2), class = "rotdyn_error_argument")
})
