skip_if_not_installed("ggplot2")

test_that("a rolling table draws without a warning, with its speeds", {
  for (object in list(rolling_table(), rolling_table(data.frame(beta = c(1, 1))))) {
    expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(object)))
    expect_equal(nrow(built$data[[1]]), 2 * nrow(object))
  }
  race <- rolling_table()
  plot <- ggplot2::autoplot(race)
  built <- ggplot2::ggplot_build(plot)$data
  expect_equal(sort(as.double(sub(" m/s", "", built[[2]]$label))), sort(race$final_speed_m_per_s),
               tolerance = 1e-3)
  # A hoop has half of its energy in rotation: beta/(1 + beta).
  expect_equal(built[[1]]$xmax[built[[1]]$y == 1][1] - built[[1]]$xmin[built[[1]]$y == 1][1], 0.5)
  expect_match(plot$labels$alt, "hoop, 3.13 m/s")
})

test_that("the shares stand under their names", {
  race <- rolling_table()
  rows <- ggplot2::autoplot(race)$data
  n <- nrow(race)
  expect_equal(rows$share[rows$motion == "translation"], race$translational_energy_fraction)
  expect_equal(rows$share[rows$motion == "rotation"], race$rotational_energy_fraction)
  # beta/(1 + beta) of the energy turns, 1/(1 + beta) moves on.
  expect_equal(rows$share[rows$motion == "translation"], 1 / (1 + race$beta))
  expect_equal(nrow(rows), 2 * n)
})
