skip_if_not_installed("ggplot2")

layer_of <- function(plot, geom) {
  ggplot2::ggplot_build(plot)$data[[
    which(vapply(plot$layers, function(one) inherits(one$geom, geom), NA))[1]
  ]]
}

test_that("the plot shows the numbers of the table", {
  motion <- spin_up(time_s = 0:8)
  expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(motion)))
  drawn <- ggplot2::autoplot(motion)$data
  theta <- drawn[drawn$panel == "angle (rad)", ]
  expect_few_labels(function(size) ggplot2::autoplot(motion, base_size = size))
  expect_equal(theta$value, motion$theta_rad)
  damping <- drawn[drawn$line == "damping", ]
  expect_equal(damping$value, motion$damping_torque_n_m)
})

test_that("rotors and a clutch draw without a warning, and show their numbers", {
  time <- seq(0, 2, by = 0.1)
  rotors <- trajectory(scene_rotors(c(1, 2, 1), 50, torque = c(1, 0, 0)), time, 1e-9)
  clutch <- trajectory(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)), time, 1e-9)
  for (motion in list(rotors, clutch)) {
    expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(motion)))
    expect_gt(nrow(built$data[[1]]), 0)
  }
  drawn <- ggplot2::autoplot(clutch)$data
  expect_equal(drawn$value[drawn$panel == "heat (J)"], clutch$heat_j)
  drawn <- ggplot2::autoplot(rotors)$data
  # The third rotor has no shaft behind it.
  expect_equal(sum(drawn$line == "rotor 3"), length(time))
  expect_equal(sum(drawn$line == "rotor 1"), 2 * length(time))
})

test_that("the head of a panel is broken where it is longer than the panel is wide", {
  plot <- ggplot2::autoplot(spin_up(time_s = 0:8))
  expect_length(levels(plot$data$panel), 4)
  head_of <- function(text) plot$facet$params$labeller(data.frame(panel = text))[[1]][[1]]
  # Two columns in 6.8 inches, margins of 0.4 inches beside both and one: 2.8 inches. Bold letters
  # of 9.75 points are some 5.7 points wide: 35 fit, 37 do not.
  words <- "a head of five words of letters"
  expect_identical(head_of(paste(words, "(W)")), paste(words, "(W)"))
  expect_identical(head_of(paste(words, "(W/s)")), paste0(words, "\n(W/s)"))
})

test_that("six rotors have six colours", {
  motion <- trajectory(scene_rotors(rep(1, 6), 50, torque = c(1, 0, 0, 0, 0, 0)), 0:5)
  expect_length(unique(layer_of(ggplot2::autoplot(motion), "GeomLine")$colour), 6)
})

test_that("units are converted, also of time, and unknown ones are refused", {
  motion <- spin_up(time_s = c(0, 4, 8))
  drawn <- ggplot2::autoplot(motion, units = c("degree", "rpm", "ms"))
  of <- function(panel) drawn$data[drawn$data$panel == panel, ]
  expect_equal(of("angle (degree)")$value, motion$theta_rad * 180 / pi)
  expect_equal(of("angular velocity (rpm)")$value, motion$omega_rad_per_s * 60 / (2 * pi))
  expect_equal(of("angle (degree)")$time_s, c(0, 4000, 8000))
  expect_equal(drawn$labels$x, "time (ms)")
  expect_error(ggplot2::autoplot(motion, units = "rmp"), class = "rotdyn_error_unit")
  expect_error(ggplot2::autoplot(motion, units = c("rpm", "turn/s")), class = "rotdyn_error_unit")
  expect_error(ggplot2::autoplot(motion, units = 1), class = "rotdyn_error_type")
})

test_that("panels are chosen by name or by column, in order", {
  motion <- spin_up(time_s = 0:8)
  panels <- function(...) levels(ggplot2::autoplot(motion, ...)$data$panel)
  expect_equal(panels(panels = c("torque", "angle")), c("torque (N m)", "angle (rad)"))
  expect_equal(panels(panels = "angular"), "angular velocity (rad/s)")
  expect_equal(panels(panels = "angular_momentum_kg_m2_per_s"), "angular momentum (kg m^2/s)")
  motion$square <- motion$time_s^2
  expect_equal(panels(panels = "square"), "square")
  for (bad in list("speed", "a", "")) { # "a" begins two names
    expect_error(panels(panels = bad), class = "rotdyn_error_value")
  }
  expect_error(panels(panels = 1), class = "rotdyn_error_type")
})

test_that("what is zero is left out, and a net torque that is another one", {
  drawn <- function(...) ggplot2::autoplot(trajectory(scene_axle(2, ...), 0:3))$data
  free <- drawn(omega0_rad_per_s = 2)
  expect_false("torque (N m)" %in% free$panel)
  driven <- drawn(3)
  expect_setequal(as.character(driven$line), c(" ", "applied"))
  coasting <- drawn(resistance = resistance(0.1), omega0_rad_per_s = 2)
  expect_setequal(as.character(coasting$line), c(" ", "damping"))
  # At rest nothing is left but the first panel; a panel asked for is drawn all the same.
  expect_equal(levels(drawn()$panel), "angle (rad)")
  still <- ggplot2::autoplot(trajectory(scene_axle(2), 0:3), panels = "torque")
  expect_equal(levels(still$data$panel), "torque (N m)")
  expect_silent(ggplot2::ggplot_build(still))
})

test_that("a skater's I and L are shown", {
  scene <- scene_axle(inertia_knots(c(1, 2), c(5, 2)), omega0_rad_per_s = 2)
  motion <- trajectory(scene, seq(0, 3, by = 0.5))
  drawn <- ggplot2::autoplot(motion)$data
  expect_equal(
    drawn$value[drawn$panel == "moment of inertia (kg m^2)"], c(5, 5, 5, 3.5, 2, 2, 2)
  )
  expect_equal(drawn$value[drawn$panel == "angular momentum (kg m^2/s)"], rep(10, 7))
  expect_false("angular momentum (kg m^2/s)" %in% ggplot2::autoplot(spin_up())$data$panel)
})

test_that("events are marked at their times, on the line", {
  # I omega0/tau = 2 * 10/0.5 = 40 s.
  wheel <- scene_axle(2, resistance = resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
  motion <- trajectory(wheel, 0:60)
  plot <- ggplot2::autoplot(motion, panels = "angular velocity", units = "min")
  expect_equal(unique(layer_of(plot, "GeomVline")$xintercept), 40 / 60)
  mark <- layer_of(plot, "GeomPoint")
  expect_equal(c(mark$x, mark$y), c(40 / 60, 0))
  expect_match(plot$labels$alt, "stick at 0.6667 min")
  # Rows that end before it show none.
  expect_no_match(ggplot2::autoplot(motion[motion$time_s < 30, ])$labels$alt, "Events")
})

test_that("several runs are lines of their own: by name, by column, and bound together", {
  wheel <- function(c) scene_axle(body_annulus(2, 0.25, 0.2), 0.8, resistance(viscous_n_m_s = c))
  time <- seq(0, 10, by = 0.5)
  free <- trajectory(wheel(0), time)
  damped <- trajectory(wheel(0.03), time)
  runs <- compare_runs(free = free, damped = damped)
  expect_s3_class(runs, "rot_runs")
  expect_equal(levels(runs$run), c("free", "damped"))
  expect_equal(runs$omega_rad_per_s, c(free$omega_rad_per_s, damped$omega_rad_per_s))
  expect_equal(compare_runs(list(free = free, damped = damped)), runs)
  expect_equal(levels(compare_runs(free, damped)$run), c("run 1", "run 2"))
  plot <- ggplot2::autoplot(runs, panels = "angular velocity")
  expect_match(plot$labels$title, "^An annulus")
  lines <- layer_of(plot, "GeomLine")
  expect_length(unique(lines$group), 2)
  expect_length(unique(lines$colour), 2)
  # No line goes back in time: a wedge would.
  expect_true(all(tapply(lines$x, lines$group, function(x) all(diff(x) > 0))))
  if (requireNamespace("dplyr", quietly = TRUE)) {
    bound <- dplyr::bind_rows(a = free, b = damped, .id = "case")
    for (plot in list(
      ggplot2::autoplot(bound), ggplot2::autoplot(bound, by = "case"),
      ggplot2::autoplot(dplyr::bind_rows(free, damped))
    )) {
      lines <- layer_of(plot, "GeomLine")
      expect_true(all(tapply(lines$x, list(lines$group, lines$PANEL), function(x) {
        all(diff(x) > 0)
      }), na.rm = TRUE))
    }
    expect_equal(levels(ggplot2::autoplot(bound)$data$run), c("a", "b"))
    expect_error(ggplot2::autoplot(bound, by = "colour"), class = "rotdyn_error_value")
  }
})

test_that("runs of other kinds, and what is no trajectory, are refused", {
  wheel <- spin_up(time_s = 0:2)
  clutch <- trajectory(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)), 0:2)
  expect_error(compare_runs(wheel, clutch), class = "rotdyn_error_value")
  expect_error(compare_runs(a = wheel, a = wheel), class = "rotdyn_error_value")
  expect_error(compare_runs(a = wheel, b = 3), class = "rotdyn_error_type")
  expect_error(compare_runs(), class = "rotdyn_error_missing")
})

test_that("a motion without rows, and one of one row, draw", {
  motion <- spin_up(time_s = 0:2)
  expect_silent(ggplot2::ggplot_build(ggplot2::autoplot(motion[1, ])))
  expect_error(ggplot2::autoplot(motion[0, ]), class = "rotdyn_error_value")
})

test_that("the axes of a small motion are scaled to it, and its title is the scene's", {
  swing <- trajectory(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1e-5), seq(0, 5, 0.01))
  plot <- ggplot2::autoplot(swing)
  expect_equal(plot$labels$title, "A pendulum: a rod on a fixed axle")
  expect_equal(levels(plot$data$panel)[1], "angle (1e-6 rad)")
  one <- plot$data[plot$data$panel == "angle (1e-6 rad)", ]
  expect_equal(one$value, 1e6 * swing$theta_rad)
  by_law <- scene_axle(2, torque_gravity(3, 0.5), theta0_rad = 1)
  expect_equal(
    ggplot2::autoplot(trajectory(by_law, 0:3))$labels$title, "A pendulum: a body on a fixed axle"
  )
  # A nutation of 1 degree about 60 degrees has an axis without 0, constants have one with it.
  top <- scene_pivot(
    c(0.02, 0.02, 0.03), c(0, 0, 60), mass_kg = 2, centre_m = c(0, 0, 0.1),
    attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle")
  )
  plot <- ggplot2::autoplot(trajectory(top, seq(0, 2, 0.01)))
  zeros <- plot$layers[[1]]$data$panel
  expect_false("inclination (rad)" %in% zeros)
  expect_true("energy (J)" %in% zeros)
  range <- ggplot2::ggplot_build(plot)$layout$panel_params[[1]]$y.range
  expect_gt(range[1], 1)
})

test_that("a torque that jumps at an event is drawn as a jump", {
  skip_if_not_installed("ggplot2")
  torque <- function(scene, time_s, panel) {
    lines <- ggplot2::autoplot(trajectory(scene, time_s))$data
    lines[lines$panel == panel, ]
  }
  # It locks at 10/7.5 s, between two rows, and at a row.
  clutch <- scene_clutch(1, 2, 5, omega0_rad_per_s = c(10, 0))
  for (time_s in list(seq(0, 3, 0.1), c(0, 1, 10 / 7.5, 2, 3))) {
    line <- torque(clutch, time_s, "torque of the clutch (N m)")
    expect_false(is.unsorted(line$time_s))
    at <- abs(line$time_s - 10 / 7.5) < 1e-12
    expect_equal(range(line$value[at]), c(0, 5), tolerance = 1e-12)
    expect_equal(line$value[line$time_s < 1.3], rep(5, sum(line$time_s < 1.3)))
  }
  # What a spring does is no jump.
  swing <- scene_axle(1, torque_spring(1), resistance(coulomb_n_m = 0.01), theta0_rad = 1)
  line <- torque(swing, seq(0, 20, 0.1), "torque (N m)")
  times <- table(line$time_s[line$line == "applied"])
  expect_identical(max(times), 1L)
  expect_gt(max(table(line$time_s[line$line == "damping"])), 1L)
})

test_that("runs of two kinds are named by their constructors", {
  swing <- trajectory(scene_pendulum(body_point(1), 0.5, theta0_rad = 1), 0:2)
  expect_error(compare_runs(spin_up(), swing), "scene_axle.*scene_pendulum",
               class = "rotdyn_error_value")
})
