skip_if_not_installed("ggplot2")

designs <- expand.grid(
  moment_of_inertia_kg_m2 = seq(0.05, 0.5, by = 0.05), viscous_n_m_s = c(0, 0.03, 0.3)
)
table <- spin_up_table(designs, article_torque(), time_s = 8)

test_that("what varies most is across, the other colours", {
  plot <- ggplot2::autoplot(table)
  expect_equal(plot$labels$x, "moment of inertia (kg m^2)")
  drawn <- plot$data
  expect_equal(levels(drawn$key), c("0", "0.03", "0.3"))
  final <- drawn[drawn$panel == "final omega (rad/s)", ]
  expect_few_labels(function(size) ggplot2::autoplot(table, base_size = size))
  expect_equal(final$value, table$final_omega_rad_per_s)
  expect_equal(final$across, table$moment_of_inertia_kg_m2)
  for (size in c(13, 24)) {
    expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(table, base_size = size)))
  }
})

test_that("columns are chosen by name, unknown ones refused", {
  plot <- ggplot2::autoplot(table, x = "viscous_n_m_s", colour = FALSE, panels = "final_theta_rad")
  expect_equal(plot$labels$x, "viscous (N m s)")
  expect_equal(levels(plot$data$panel), "final theta (rad)")
  expect_error(ggplot2::autoplot(table, x = "viscous"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(table, panels = "speed"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(table[0, ]), class = "rotdyn_error_value")
})

test_that("names are across where no number varies, rows where nothing does", {
  named <- data.frame(name = c("a", "b"), moment_of_inertia_kg_m2 = 1)
  expect_equal(ggplot2::autoplot(spin_up_table(named, 1, time_s = 2))$labels$x, "name")
  same <- data.frame(moment_of_inertia_kg_m2 = c(1, 1))
  plot <- ggplot2::autoplot(spin_up_table(same, 1, time_s = 2))
  expect_equal(plot$labels$x, "row")
  expect_silent(ggplot2::ggplotGrob(plot))
})

test_that("what does not vary, or is across, has no colours", {
  wheels <- data.frame(moment_of_inertia_kg_m2 = 1:3, viscous_n_m_s = 0.1)
  one <- spin_up_table(wheels, 1, time_s = 2)
  expect_identical(nlevels(ggplot2::autoplot(one)$data$key), 1L)
  expect_false("0.1" %in% levels(ggplot2::autoplot(one)$data$key))
})

test_that("inclines show the heat of slipping where there is some", {
  rows <- data.frame(
    mass_kg = 2, radius_m = 0.1, beta = 0.4, incline_angle_deg = c(10, 40), static_friction = 0.2
  )
  panels <- function(rows) levels(ggplot2::autoplot(incline_table(rows, time_s = 2))$data$panel)
  expect_true(any(grepl("heat", panels(rows))))
  rows$static_friction <- 5
  expect_false(any(grepl("heat", panels(rows))))
})

test_that("a third parameter has lines of its own, by their type", {
  designs <- expand.grid(
    moment_of_inertia_kg_m2 = seq(0.05, 0.5, by = 0.05), viscous_n_m_s = c(0, 0.03, 0.3),
    coulomb_n_m = c(0, 0.2)
  )
  plot <- ggplot2::autoplot(spin_up_table(designs, torque_constant(0.8), time_s = 8))
  lines <- ggplot2::layer_data(plot, 1)
  each <- split(lines, list(lines$PANEL, lines$group))
  expect_length(each, 2 * 6)
  # One value for each place: no line jumps between two sets.
  for (one in each) expect_false(any(duplicated(one$x)))
  expect_length(unique(lines$linetype), 2)
  expect_match(plot$labels$alt, "types of line by coulomb \\(N m\\)")
})
